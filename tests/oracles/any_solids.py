r"""Bridges between any two solids of revolution, made by integrating the Young-Laplace equation; nothing is shared.

In arc length, :math:`X' = \cos\phi, Y' = \sin\phi, \phi' = H + \cos\phi/Y`. A meridian starts on the first solid at its
contact angle, or at any slope on an edge, and ends where it meets the second solid at its own, or on its edge. Their
gap, the volume, the areas and the force follow. How many directions lead down is the second variation of the energy,

.. math:: \delta^2\Omega/2\pi\gamma = \int Y (u'^2 + m^2u^2/Y^2 - (\kappa_1^2 + \kappa_2^2) u^2) ds
          + \sum Y \chi u^2 , \quad \chi = (k + \kappa_1\cos\theta)/\sin\theta ,

with k the curvature of the meridian of a solid, and u = 0 on an edge, in polynomials.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.integrate import quad, solve_ivp

NODES, WEIGHTS = np.polynomial.legendre.leggauss(200)
DEGREE = 60


@dataclass(frozen=True)
class Solid:
    """A solid: depth behind its tip, its slope and the curvature of its meridian against the radius."""

    angle: float
    depth: Callable[[float], float] | None
    steepness: Callable[[float], float] | None  # dh/dY
    bend: Callable[[float], float] | None  # d²h/dY²
    edge: float = math.inf  # radius of the edge on which the line is pinned, if there is no slope
    corners: tuple[float, ...] = ()
    behind: float = 0.0  # height of the line on the side of a cylinder of the radius of the edge

    @property
    def is_edge(self):
        """Whether a line is pinned on it."""
        return self.depth is None

    def slope(self, radius):
        """Angle of the surface against the plane across the axis."""
        return math.atan(self.steepness(radius))

    def height(self, radius):
        """Depth of a contact circle behind the tip."""
        return 0.0 if self.is_edge else self.depth(radius)

    def curvature(self, radius):
        """Of its meridian."""
        return 0.0 if self.behind else self.bend(radius) / (1.0 + self.steepness(radius) ** 2) ** 1.5

    def _integral(self, function, radius):
        corners = [corner for corner in self.corners if corner < radius]
        ends = [0.0, *corners, radius]
        return sum(quad(function, low, high, epsabs=0.0, epsrel=1e-13, limit=200)[0] for low, high in pairwise(ends))

    def cap(self, radius):
        """Volume between the tip and the contact circle."""
        if self.behind:
            return math.pi * self.edge**2 * self.behind
        return 0.0 if self.is_edge else math.pi * self._integral(lambda y: y * y * self.steepness(y), radius)

    def wetted(self, radius):
        """Area within a contact circle."""
        if self.is_edge or self.behind:
            return math.pi * radius * (radius + 2.0 * self.behind)
        return 2.0 * math.pi * self._integral(lambda y: y * math.hypot(1.0, self.steepness(y)), radius)


def sphere(radius, angle):
    k = 1.0 / radius
    return Solid(
        angle,
        lambda y: k * y * y / (1.0 + math.sqrt(1.0 - (k * y) ** 2)),
        lambda y: k * y / math.sqrt(1.0 - (k * y) ** 2),
        lambda y: k / (1.0 - (k * y) ** 2) ** 1.5,
    )


def plane(angle):
    return Solid(angle, lambda y: 0.0, lambda y: 0.0, lambda y: 0.0)


def cone(half_angle, angle, tip_radius=0.0):
    start, rate = tip_radius * math.cos(half_angle), 1.0 / math.tan(half_angle)
    if tip_radius == 0.0:
        return Solid(angle, lambda y: rate * y, lambda y: rate, lambda y: 0.0)
    cap = sphere(tip_radius, angle)
    return Solid(
        angle,
        lambda y: cap.depth(y) if y < start else cap.depth(start) + rate * (y - start),
        lambda y: cap.steepness(y) if y < start else rate,
        lambda y: cap.bend(y) if y < start else 0.0,
        corners=(start,),
    )


def paraboloid(tip_radius, angle):
    return Solid(angle, lambda y: 0.5 * y * y / tip_radius, lambda y: y / tip_radius, lambda y: 1.0 / tip_radius)


def edge(radius, angle):
    return Solid(angle, None, None, None, edge=radius)


def side(radius, angle, height):
    """The side of a cylinder, with the line at a height behind its end; it may be the first solid only."""
    return Solid(angle, lambda y: height, lambda y: math.inf, lambda y: 0.0, edge=radius, behind=height)


@dataclass(frozen=True)
class Made:
    """A bridge made from the equation."""

    solids: tuple[Solid, Solid]
    suction: float
    gap: float
    volume: float
    force: float  # over 2π
    area: float
    tensor: tuple[float, float]
    wetted: tuple[float, float]
    radii: tuple[float, float]
    slopes: tuple[float, float]  # of the meridian against the axis, outwards
    length: float  # of the arc
    arc: Callable  # place, radius and slope at arc lengths

    @property
    def energy(self):
        """Surface energy, against dry solids."""
        return self.area - sum(math.cos(s.angle) * w for s, w in zip(self.solids, self.wetted, strict=True))

    def is_outside(self):
        """Whether the meridian stays outside of both solids, and its ends lie on the sides that face each other."""
        s = np.linspace(0.0, self.length, 400)[1:-1]
        x, y, _ = self.arc(s)[:3]
        x = x - self.solids[0].height(self.radii[0])
        for solid, place in ((self.solids[0], x), (self.solids[1], self.gap - x)):
            for a, b in zip(place, y, strict=True):
                if solid.is_edge or solid.behind:
                    inside = a < 0.0 and b < solid.edge
                else:
                    try:
                        inside = a < -solid.depth(b)
                    except ValueError:  # wider than a sphere
                        inside = False
                if inside:
                    return False
        return True

    def directions_down(self, *, volume_held, mode=0):
        """Negative eigenvalues of the second variation."""
        s = 0.5 * self.length * (NODES + 1.0)
        _, y, phi = self.arc(s)[:3]
        across = np.cos(phi) / y
        bend = self.suction + across
        each = np.eye(DEGREE)
        values = np.polynomial.legendre.legval(NODES, each)
        slopes = np.polynomial.legendre.legval(NODES, np.polynomial.legendre.legder(each)) * 2.0 / self.length
        weight = WEIGHTS * 0.5 * self.length * y
        form = (slopes * weight) @ slopes.T + (values * weight * (mode**2 / y**2 - bend**2 - across**2)) @ values.T
        held = []
        for share, solid, radius, slope in zip((-1.0, 1.0), self.solids, self.radii, self.slopes, strict=True):
            at_end = np.polynomial.legendre.legval(share, each)
            if solid.is_edge:
                held.append(at_end)
                continue
            turned = self.suction + math.cos(slope) / radius
            stiffness = (solid.curvature(radius) + turned * math.cos(solid.angle)) / math.sin(solid.angle)
            form += radius * stiffness * np.outer(at_end, at_end)
        if volume_held:
            held.append(values @ weight)
        if held:
            free = np.linalg.svd(np.array(held))[2][len(held) :]
            form = free @ form @ free.T
        return int(np.sum(np.linalg.eigvalsh(form) < 0.0))


def make(first, second, radius, suction, slope=None, *, longest=6.0, number=0):
    """The bridge that leaves the first solid at a radius; ``slope`` there if it is an edge; None if it meets nothing.

    Of several ends on the second solid that with a ``number`` is taken.
    """
    outward = slope if first.is_edge else 0.5 * math.pi - first.angle - first.slope(radius)

    def path(_s, state):
        _x, y, phi = state
        return [math.cos(phi), math.sin(phi), suction + math.cos(phi) / y]

    def rates(_s, state):
        _x, y, phi, _volume, _area, _across, _axial = state
        c, s = math.cos(phi), math.sin(phi)
        sums = [math.pi * y * y * c, 2.0 * math.pi * y, math.pi * y * c * c, 2.0 * math.pi * y * s * s]
        return [c, s, suction + c / y, *sums]

    def meets(_s, state):
        y, phi = state[1], state[2]
        if second.is_edge:
            return y / second.edge - 1.0
        try:
            return phi - (0.5 * math.pi - second.angle - second.slope(y))
        except ValueError:
            return math.nan

    def closes(_s, state):
        return state[1] - 1e-3 * radius

    def winds(_s, state):
        return 4.0 - abs(state[2])

    def run(function, stop, start, **options):
        return solve_ivp(function, (0.0, stop), start, "DOP853", atol=1e-15 * radius, **options)

    closes.terminal = winds.terminal = True
    start = [0.0, radius, -outward]
    events = (meets, closes, winds)
    found = run(path, longest * radius, start, rtol=1e-8, events=events, max_step=0.01 * longest * radius).t_events[0]
    ends = [s for s in found if s > 1e-4 * longest * radius]
    if len(ends) <= number:
        return None
    a, b = ends[number], ends[number] * (1.0 + 1e-6)
    at_a, at_b = (meets(s, run(path, s, start, rtol=1e-13).y[:, -1]) for s in (a, b))
    for _ in range(4):  # the secant rule
        if at_a == at_b or abs(at_a) < 1e-15:
            break
        a, b, at_b = a - at_a * (b - a) / (at_b - at_a), a, at_a
        at_a = meets(a, run(path, a, start, rtol=1e-13).y[:, -1])
    last = run(rates, a, [*start, 0.0, 0.0, 0.0, 0.0], rtol=1e-13, dense_output=True)
    x, y, phi, volume, area, across, axial = last.y[:, -1]
    return Made(
        solids=(first, second),
        suction=suction,
        gap=x - first.height(radius) - second.height(y),
        volume=volume - first.cap(radius) - second.cap(y),
        force=radius * math.cos(outward) + 0.5 * suction * radius**2,
        area=area,
        tensor=(across, axial),
        wetted=(first.wetted(radius), second.wetted(y)),
        radii=(radius, y),
        slopes=(outward, phi),
        length=a,
        arc=last.sol,
    )
