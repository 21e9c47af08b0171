"""Bridges of a given volume, and bridges under pressure (H < 0), reached by walking from one that is easy to find.

A short bridge between solids that nearly touch is close to a cylinder of liquid with a circular meniscus: Newton's
method takes it from there. From that bridge one walks (:mod:`~pendular.exact.path`) to the wanted volume, then to
the wanted separation. What is met on the way before the first fold is the stable branch, what comes after it the
unstable one: of the several equilibria that one volume and separation can have, these are the two that meet.
"""

import math

import numpy as np

from .._jit import kernel
from .contact import Contact, cap_volume, wetted_area
from .equilibrium import Solids, State, are_equal, solve_suction, suction_state
from .meridian import arc_across
from .middle import CURVATURE, SEPARATION, VOLUME, Vector, correct, end_at, measure
from .path import ABSENT, FOLD, LOST, TARGET, Curve, Walk, antisymmetric_margin, heading_at, set_out, walk

# Thinnest over widest circle of a bridge: where an unstable branch that cannot be followed on has come to its end, and
# where there is no liquid left, though Newton's method may still find numbers.
_THINNEST, _NOTHING = 0.03, 1e-9
_SHORT_RADIUS = 0.3  # largest contact radius, over the smaller solid's, of the bridge that is guessed


@kernel
def _cylinder_volume(radius: float, solids: Solids) -> float:
    """Liquid between touching solids inside a cylinder."""
    volume = 0.0
    for k in (solids.k1, solids.k2):
        sagitta = k * radius * radius / (1.0 + math.sqrt(1.0 - k * k * radius * radius))
        volume += math.pi * radius * radius * sagitta - cap_volume(Contact(radius, sagitta, 0.0, 0.0, 0.0))
    return volume


@kernel
def _cylinder_radius(volume: float, solids: Solids) -> float:
    """Radius of the cylinder that holds a volume of liquid, at most the short radius."""
    low, high = 0.0, _SHORT_RADIUS / max(solids.k1, solids.k2)
    for _ in range(80):
        middle = 0.5 * (low + high) if low > 0.0 else 1e-3 * high
        if _cylinder_volume(middle, solids) > volume:
            high = middle
        else:
            low = middle
    return high


@kernel
def _short_bridge(radius: float, solids: Solids) -> Vector:
    """Guess of a short bridge between touching solids: contact circles of one radius, a circular meridian."""
    slopes = np.empty(2)
    height = 0.0
    for i, k, theta in ((0, solids.k1, solids.theta1), (1, solids.k2, solids.theta2)):
        slopes[i] = 0.5 * math.pi - math.asin(k * radius) - theta
        height += k * radius * radius / (1.0 + math.sqrt(1.0 - k * k * radius * radius))
    turn = 0.5 * (slopes[0] + slopes[1])  # of the slope over half the arc
    slope = 0.5 * (slopes[1] - slopes[0])
    half_length = 0.5 * height / math.cos(slope)
    sagitta = 0.0
    if abs(turn) > 1e-6:
        half_length *= turn / math.sin(turn)
        sagitta = half_length * (1.0 - math.cos(turn)) / turn
    middle = max(radius - sagitta, 0.3 * radius)
    return np.array([math.log(middle), slope, math.log(half_length), turn - math.cos(slope) * half_length / middle])


@kernel
def _start(volume: float, solids: Solids) -> tuple[Vector, float]:
    """A short bridge at contact, and its volume: the wanted one if that is small enough. NaN if none."""
    radius = _cylinder_radius(volume, solids)
    for _ in range(8):
        held = min(volume, _cylinder_volume(radius, solids))
        z = _short_bridge(radius, solids)
        if not math.isnan(correct(z, solids, VOLUME, held, SEPARATION, 0.0, z)):
            return z, held
        radius *= 0.5
    return z, math.nan


@kernel
def _of_volume(volume: float, solids: Solids) -> Walk:
    """The bridge of the volume at contact."""
    z, held = _start(volume, solids)
    if math.isnan(held):
        return Walk(LOST, z, z)
    if held == volume:
        return Walk(TARGET, z, z)
    filling = Curve(solids, SEPARATION, 0.0, VOLUME)
    going = 1.0 if volume > held else -1.0
    return walk(z, set_out(z, filling, going), filling, volume, going, False)


@kernel
def _of_curvature(curvature: float, solids: Solids) -> Walk:
    """The bridge of the curvature H < 0 at contact; ABSENT where the liquid would engulf a solid first."""
    first = max(solids.k1, solids.k2)  # a suction that every pair with a bridge at contact has one at
    nowhere = Walk(ABSENT, np.full(4, math.nan), np.full(4, math.nan))
    arc = solve_suction(0.0, first, solids, False)
    if not arc > 0.0:
        return nowhere
    state = suction_state(arc, first, solids)
    z = np.array(
        [math.log(state.middle_radius), state.middle_slope, math.log(state.half_length), first * state.half_length]
    )
    easing = Curve(solids, SEPARATION, 0.0, CURVATURE)
    reached = walk(z, set_out(z, easing, -1.0), easing, curvature, -1.0, False)
    return reached if reached.event == TARGET else nowhere


@kernel
def begin(curve: Curve) -> Walk:
    """The bridge on the curve at contact."""
    if curve.held == VOLUME:
        return _of_volume(curve.value, curve.solids)
    return _of_curvature(curve.value, curve.solids)


@kernel
def force_of(z: Vector) -> float:
    """λ = Y cos φ + HY²/2 in the middle of the arc."""
    radius = math.exp(z[0])
    return radius * (math.cos(z[1]) + 0.5 * z[3] * math.exp(z[0] - z[2]))


@kernel
def _neck_radius(z: Vector) -> float:
    """Smallest radius of the whole surface, Y0 = 2λ/(1 + q); NaN for a repulsive one, which has no neck."""
    force = force_of(z)
    if force < 0.0:
        return math.nan
    h = z[3] * math.exp(z[0] - z[2])
    q = math.hypot(1.0 + h * math.cos(z[1]), h * math.sin(z[1]))  # √(1 + 2Hλ) would lose half the digits at q = 0
    return 2.0 * force / (1.0 + q)


@kernel
def _has_neck_inside(z: Vector) -> bool:
    """Whether the phase of a neck (0 modulo 2π) lies between the two ends of an attractive bridge."""
    if not force_of(z) > 0.0:
        return False
    y, slope, phase = math.exp(z[0] - z[2]), z[1], abs(z[3])
    if phase < 1e-8:
        return abs(y * math.sin(slope)) < 1.0
    h = z[3] * y
    middle = abs(math.atan2(h * math.sin(slope), 1.0 + h * math.cos(slope)))
    return middle < phase or 2.0 * math.pi - middle < phase


@kernel
def slenderness(z: Vector, solids: Solids) -> float:
    """Thinnest circle of a bridge, its neck between the solids or a contact circle, over its widest contact circle."""
    radius1 = end_at(z, -1.0, solids.k1, solids.theta1).contact.radius
    radius2 = end_at(z, 1.0, solids.k2, solids.theta2).contact.radius
    thinnest = min(radius1, radius2)
    if _has_neck_inside(z):
        thinnest = min(thinnest, _neck_radius(z))
    return thinnest / max(radius1, radius2)


@kernel
def pinches_off(z: Vector, solids: Solids) -> bool:
    """Whether a bridge hangs by a thread."""
    return not slenderness(z, solids) > _THINNEST


@kernel
def find(separation: float, curve: Curve, unstable: bool) -> Walk:
    """The bridge on the curve at a separation, before the first fold or after it.

    Returns
    -------
    Walk
        It ends in TARGET at the bridge; in FOLD or ABSENT if the branch does not reach the separation; in LOST if
        the walk failed.
    """
    first = begin(curve)
    if first.event != TARGET:
        return first
    z = first.z
    if not unstable:
        going = 1.0 if separation > 0.0 else -1.0
        return walk(z, set_out(z, curve, going), curve, separation, going, False)
    top = walk(z, set_out(z, curve, 1.0), curve, math.inf, 1.0, False)
    if top.event != FOLD:
        return top
    if measure(top.z, curve.solids).values[SEPARATION] < separation:
        return top
    down = walk(top.z, top.tangent, curve, separation, -1.0, False)
    if not slenderness(down.z, curve.solids) > (_THINNEST if down.event == LOST else _NOTHING):
        return Walk(ABSENT, down.z, down.tangent)
    return down


@kernel
def find_limit(curve: Curve, pitchfork: bool) -> Walk:
    """The end of the stable branch: the fold, or with ``pitchfork`` the antisymmetric instability if that is first."""
    first = begin(curve)
    if first.event != TARGET:
        return first
    return walk(first.z, set_out(first.z, curve, 1.0), curve, math.inf, 1.0, pitchfork)


@kernel
def _is_stable(z: Vector, curve: Curve, force: float) -> bool:
    """Stability of a bridge that comes before the first fold of its curve.

    Under pressure control nothing else can come first. At a given volume a repulsive bridge (λ < 0) slips sideways:
    the sideways shift of the surface, cos φ, is neutral inside, and its boundary term at each solid is 2kλ/Y times
    a positive number. A mirror-symmetric bridge has an exact criterion against the antisymmetric mode.
    """
    if curve.held != VOLUME:
        return True
    if force < 0.0:
        return False
    # In a cylinder the margin is zero up to rounding, and the bridge is stable.
    return not are_equal(curve.solids) or (abs(z[3]) < math.pi and antisymmetric_margin(z, curve.solids) > -1e-12)


@kernel
def path_state(z: Vector, tangent: Vector, curve: Curve, before_fold: bool) -> State:
    """Everything about a bridge on a curve, z its point and tangent the direction of the curve there."""
    solids = curve.solids
    found = measure(z, solids)
    direction = heading_at(found, z, curve, tangent).tangent
    middle_radius, slope, half_length, phase = math.exp(z[0]), z[1], math.exp(z[2]), z[3]
    curvature = phase / half_length
    square = middle_radius * middle_radius
    force = force_of(z)
    force_rates = np.array(
        [
            middle_radius * math.cos(slope) + curvature * square,
            -middle_radius * math.sin(slope),
            -0.5 * curvature * square,
            0.5 * square / half_length,
        ]
    )
    first = end_at(z, -1.0, solids.k1, solids.theta1).contact
    second = end_at(z, 1.0, solids.k2, solids.theta2).contact
    across = arc_across(middle_radius / half_length, slope, phase, are_equal(solids))
    return State(
        found.values[SEPARATION],
        curvature,
        force,
        found.values[VOLUME],
        across.area * half_length**2,
        across.tensor * half_length**2,
        np.dot(force_rates, direction) / np.dot(found.rates[SEPARATION], direction),
        _neck_radius(z),
        1.0 if _has_neck_inside(z) else 0.0,
        first.radius,
        second.radius,
        math.atan2(solids.k1 * first.radius, first.cos_filling) if solids.k1 > 0.0 else 0.0,
        math.atan2(solids.k2 * second.radius, second.cos_filling) if solids.k2 > 0.0 else 0.0,
        wetted_area(first),
        wetted_area(second),
        middle_radius,
        slope,
        half_length,
        1.0 if before_fold and _is_stable(z, curve, force) else 0.0,
    )
