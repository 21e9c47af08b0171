r"""Random bridges made from the Young–Laplace equation, of which the library is then asked.

A bridge is made from its meniscus outwards: a contact circle on solid 1 (R1 = 1, γ = 1), a contact angle and a
curvature H give the meridian; where it is cut, solid 2 is put so that it meets it at a contact angle. So each is a
bridge for certain, whatever solver is asked for it: of any size ratio, bulging or necked, stable or not.

Its unstable directions are the negative eigenvalues of the second variation of the energy, counted by the zeros of a
Jacobi field along the meridian: with the normal displacement u,

.. math:: Ju = -u'' - \frac{\sin\psi}{Y} u' - \Big(\kappa_1^2 + \kappa_2^2 - \frac{m^2}{Y^2}\Big) u , \qquad
          u' = \rho_1 u \text{ at the start}, \; u' = -\rho_2 u \text{ at the end}, \quad
          \rho = \frac{1}{R\sin\theta} + \psi'\cot\theta

there are as many as the solution from the first condition has zeros, and one more if it misses the second from below. A
held volume takes one away where the volume that answers a pressure grows against it. m = 1 is a shift of the liquid to
one side.

Uses SciPy's integrator, and nothing of the solver.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

_STEEPEST = 0.98 * math.pi / 2.0  # slope of the ends; a steeper meridian is as good as one that turns back
_THINNEST = 1e-4  # neck over the first contact circle, where an integration ends


class Made(NamedTuple):
    """A bridge, with the number of directions in which its energy falls."""

    second_radius: float
    angles: tuple[float, float]
    filling: float  # half-filling angle on solid 1
    arc_length: float
    suction: float  # H
    separation: float
    volume: float
    force: float
    down_at_suction: int
    down_at_volume: int
    sideways_stable: bool

    def down(self, control: str) -> int:
        """Unstable axisymmetric directions with a quantity held."""
        return self.down_at_suction if control == "suction" else self.down_at_volume


def integrate(radius, place, slope, suction, length):
    """Meridian from a point over an arc length, or one whole turn, densely: Y, z, ψ and ∫πY² dz."""

    def rates(_, state):
        cosine = math.cos(state[2])
        return math.sin(state[2]), cosine, suction + cosine / state[0], math.pi * state[0] ** 2 * cosine

    def closes_up(_, state):
        return state[0] - _THINNEST * radius

    def has_turned(_, state):  # no bridge does: it would run through itself
        return abs(state[2] - slope) - 2.0 * math.pi

    closes_up.terminal = has_turned.terminal = True
    return solve_ivp(
        rates,
        (0.0, length),
        (radius, place, slope, 0.0),
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
        dense_output=True,
        events=(closes_up, has_turned),
    )


def sagitta(radius, filling):
    """Height of a wetted cap; 0 on a plane."""
    return 0.0 if math.isinf(radius) else 2.0 * radius * math.sin(0.5 * filling) ** 2


def cap_volume(radius, filling):
    """Volume of a wetted cap; 0 on a plane."""
    height = sagitta(radius, filling)
    return 0.0 if height == 0.0 else math.pi * height**2 * (3.0 * radius - height) / 3.0


def force_of(radius, slope, suction):
    """F = 2π (Y cos ψ + HY²/2)."""
    return 2.0 * math.pi * (radius * math.cos(slope) + 0.5 * suction * radius**2)


# -- draws ----------------------------------------------------------------------------------------------------------


def _enters_a_solid(meridian, end, second_radius, separation):
    radius, place = meridian.sol(np.linspace(0.0, end, 60)[1:-1])[:2]
    if np.any(np.hypot(radius, place + 1.0) < 1.0 - 1e-9):
        return True
    if math.isinf(second_radius):
        return bool(np.any(place > separation + 1e-9))
    center = separation + second_radius
    return bool(np.any(np.hypot(radius, place - center) < second_radius * (1.0 - 1e-9)))


def _mirrored_end(meridian):
    """Where to cut between equal solids: the mirror image of the start about a point where the slope is zero."""
    grid = np.linspace(0.0, meridian.t[-1], 400)
    slopes = meridian.sol(grid)[2]
    turns = np.flatnonzero(slopes[1:] * slopes[:-1] < 0.0)
    if turns.size == 0:
        return None
    first = turns[0]
    end = 2.0 * brentq(lambda s: meridian.sol(s)[2], grid[first], grid[first + 1], xtol=1e-14)
    return end if end <= meridian.t[-1] else None


def _second_solid(rng, angles, lowest, highest, radius, slope, largest_ratio):
    """A sphere or a plane that meets the end of a meridian: radius, contact angle, half-filling angle, or None."""
    if rng.random() < 0.15:
        angle = math.pi / 2.0 - slope
        return (math.inf, angle, 0.0) if lowest <= angle <= highest else None
    filling = math.pi / 2.0 - angles[1] - slope
    if not 0.005 < filling < 2.8:
        return None
    second = radius / math.sin(filling)
    return (second, angles[1], filling) if 1.0 / largest_ratio < second < largest_ratio else None


def draw(rng, lowest, highest, largest_ratio=1000.0):
    """One random bridge with contact angles between two, or None."""
    angles = np.where(rng.random(2) < 0.15, lowest, rng.uniform(lowest, highest, 2))
    equal = rng.random() < 0.25
    filling = math.exp(rng.uniform(math.log(0.01), math.log(2.4)))
    radius, place, slope = math.sin(filling), math.cos(filling) - 1.0, filling + angles[0] - math.pi / 2.0
    suction = rng.choice((-1.0, 1.0)) * 10.0 ** rng.uniform(-2.0, 1.5) / radius if rng.random() < 0.9 else 0.0
    share = rng.uniform(0.02, 1.0)
    if abs(slope) > _STEEPEST:
        return None
    meridian = integrate(radius, place, slope, suction, 6.0 * min(radius, 1.0) + 2.0 / (abs(suction) + 1.0))
    end = _mirrored_end(meridian) if equal else share * meridian.t[-1]
    if end is None:
        return None
    last_radius, last_place, last_slope, inside = meridian.sol(end)
    if equal:
        other = (1.0, angles[0], filling)
    else:
        other = _second_solid(rng, angles, lowest, highest, last_radius, last_slope, largest_ratio)
    if other is None:
        return None
    second, second_angle, second_filling = other
    separation = last_place - sagitta(second, second_filling)
    volume = inside - cap_volume(1.0, filling) - cap_volume(second, second_filling)
    runs_back = np.any(np.abs(meridian.sol(np.linspace(0.0, end, 40))[2]) > math.pi / 2.0)
    if separation < 0.0 or volume <= 0.0 or abs(last_slope) > _STEEPEST or runs_back:
        return None
    if _enters_a_solid(meridian, end, second, separation):
        return None
    bridge = Made(
        float(second),
        (float(angles[0]), float(second_angle)),
        filling,
        float(end),
        float(suction),
        float(separation),
        float(volume),
        force_of(radius, slope, suction),
        0,
        0,
        False,
    )
    at_suction, at_volume, sideways = unstable_directions(bridge)
    return bridge._replace(down_at_suction=at_suction, down_at_volume=at_volume, sideways_stable=sideways == 0)


def made_bridges(seed, count, lowest, highest):
    """So many random bridges with contact angles between two, [rad]."""
    rng = np.random.default_rng(seed)
    while count:
        bridge = draw(rng, lowest, highest)
        if bridge is not None:
            count -= 1
            yield bridge


# -- stability --------------------------------------------------------------------------------------------------------


class Arc(NamedTuple):
    """A meridian from a contact circle on solid 1, with what it meets at both ends."""

    radius: float
    slope: float
    suction: float
    length: float
    angles: tuple[float, float]
    radii: tuple[float, float]  # of the solids


def count_down(arc, mode):
    """Unstable directions of a mode at fixed suction, and whether a held volume takes one away."""
    suction = arc.suction

    def rates(_, v):
        radius, slope, u, u_slope, forced, forced_slope = v[0], v[2], v[3], v[4], v[5], v[6]
        cosine, sine = math.cos(slope), math.sin(slope)
        bend = suction + cosine / radius
        stiffness = bend**2 + (cosine / radius) ** 2 - (mode / radius) ** 2
        return (
            sine,
            cosine,
            bend,
            u_slope,
            -sine / radius * u_slope - stiffness * u,
            forced_slope,
            -sine / radius * forced_slope - stiffness * forced - 1.0,
            radius * u,
            radius * forced,
        )

    def spring(v, solid):
        angle = arc.angles[solid]
        return 1.0 / (arc.radii[solid] * math.sin(angle)) + (suction + math.cos(v[2]) / v[0]) / math.tan(angle)

    start = (arc.radius, 0.0, arc.slope)
    is_wetted = [angle == 0.0 for angle in arc.angles]  # a wetted solid holds the line: u = 0 there
    first = (0.0, 1.0) if is_wetted[0] else (1.0, spring(start, 0))
    solution = solve_ivp(
        rates,
        (0.0, arc.length),
        (*start, *first, 0.0, 0.0, 0.0, 0.0),
        method="DOP853",
        rtol=1e-10,
        atol=1e-13,
        dense_output=True,
    )
    u = solution.sol(np.linspace(0.0, arc.length, 400))[3]
    last = solution.y[:, -1]
    count = int(np.sum(u[1:] * u[:-1] < 0.0))
    if is_wetted[1]:
        miss, forced_miss = last[3], last[5]
    else:
        stiffness = spring(last, 1)
        miss, forced_miss = last[4] + stiffness * last[3], last[6] + stiffness * last[5]
        count += int(miss * last[3] < 0.0)
    answering = last[8] - forced_miss / miss * last[7]  # ∫Yu ds of the u with Ju = 1
    return count, bool(answering < 0.0)


def unstable_directions(bridge):
    """Axisymmetric unstable directions at fixed suction, at fixed volume, and sideways ones."""
    radius, slope = math.sin(bridge.filling), bridge.filling + bridge.angles[0] - math.pi / 2.0
    arc = Arc(radius, slope, bridge.suction, bridge.arc_length, bridge.angles, (1.0, bridge.second_radius))
    at_suction, takes_one = count_down(arc, 0)
    return at_suction, at_suction - takes_one, count_down(arc, 1)[0]


# -- answers ----------------------------------------------------------------------------------------------------------


def _nearest(meridian, radius, place):
    """Arc lengths at which a meridian comes near to a point, refined along the arc."""
    coarse = np.linspace(0.0, meridian.t[-1], 1000)
    state = meridian.sol(coarse)
    miss = np.hypot(state[0] - radius, state[1] - place)
    is_least = np.r_[True, miss[1:] < miss[:-1]] & np.r_[miss[:-1] <= miss[1:], True]
    least = np.flatnonzero(is_least)
    for k in least[np.argsort(miss[least])[:3]]:
        fine = np.linspace(max(coarse[k] - coarse[1], 0.0), min(coarse[k] + coarse[1], meridian.t[-1]), 201)
        state = meridian.sol(fine)
        arc = fine[np.argmin(np.hypot(state[0] - radius, state[1] - place))]
        for _ in range(8):
            state = meridian.sol(arc)
            ahead = (state[0] - radius) * math.sin(state[2]) + (state[1] - place) * math.cos(state[2])
            arc = min(max(arc - ahead, 0.0), meridian.t[-1])
        yield meridian.sol(arc)


def can_be_integrated(answer) -> bool:
    """Whether the integrator passes the thinnest place of a meridian."""
    radii = np.asarray(answer.contact_radius)
    neck = float(answer.neck_radius) if bool(answer.neck_inside) else math.inf
    return min(neck, radii.min()) > 1e-3 * radii.max() and min(neck, radii[1]) > 2.0 * _THINNEST * radii[0]


def miss_of(answer, second_radius, angles) -> float:
    """Largest relative miss of an answer's own numbers when its meniscus is integrated from solid 1 to solid 2."""
    radius, last_radius = (float(value) for value in answer.contact_radius)
    filling, last_filling = (float(value) for value in answer.half_filling_angle)
    suction, slope = float(answer.suction), filling + angles[0] - math.pi / 2.0
    start = -sagitta(1.0, filling)
    target = float(answer.separation) + sagitta(second_radius, last_filling)
    length = 4.0 * (abs(target - start) + radius + last_radius)
    scale = max(radius, last_radius, abs(target - start))
    caps = cap_volume(1.0, filling) + cap_volume(second_radius, last_filling)
    force = force_of(radius, slope, suction)
    force_miss = abs(force - float(answer.force)) / (2.0 * math.pi * radius * (1.0 + abs(suction) * radius))
    least = math.inf
    for state in _nearest(integrate(radius, start, slope, suction, length), last_radius, target):
        place_miss = math.hypot(state[0] - last_radius, state[1] - target) / scale
        angle_miss = abs(math.remainder(state[2] - (math.pi / 2.0 - angles[1] - last_filling), 2.0 * math.pi))
        volume = float(answer.volume)
        volume_miss = abs(state[3] - caps - volume) / (abs(volume) + 1e-3 * scale**3)
        least = min(least, max(place_miss, angle_miss, volume_miss, force_miss))
    return least
