"""Following a curve of bridges that hold one thing, along its tangent, with the rule of folds.

Along a curve of bridges at one suction or one volume the separation turns where, and only where, the number of unstable
directions changes, by one. A step that breaks this rule has leapt to another curve: it is halved. A bridge between
mirror images is kept symmetric; it may lose its symmetry as well, at a pitchfork, where an antisymmetric direction
becomes unstable and the separation does not turn.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import Four, dot, largest, minors, moved, normal, scaled, solve4, unit_vector
from .clearance import opening_of
from .equations import SUCTION, VOLUME, Held, System, first_row, held_row, system_at
from .stability import ladder_at

Nodes = NDArray[np.float64]

# How a walk ended.
ARRIVED, FOLD, PITCHFORK, ENDED, LOST = 0, 1, 2, 3, 4
# What a walk stops at, beside its target.
NOTHING, FOLDS, BRANCH_ENDS = 0, 1, 2

_FIRST_STEP, _LONGEST_STEP, _SHORTEST_STEP = 0.05, 0.3, 1e-10
_MOST_STEPS = 1000
_MOST_CORRECTIONS = 6
_LARGEST_CORRECTION = 0.4  # over the step
_LEAST_COSINE = 0.95  # of the turn of the tangent in a step
_SMALL_CORRECTION = 1e-9
_CLOSED = 1e-6  # contact circle over ℓ at which it has closed
_NEARLY_CLOSED = 1e-2  # where a curve that cannot be followed on ends all the same: the circle closes in a fold
_FORK_STEP = 0.02  # of the slope in the middle, away from a pitchfork
_LAST_CHANGE = 1e-5  # in the last steps to a bridge
_PROBE = 1e-3  # way beyond a fold to where the signs of the ladder are certain
_ROUNDING = 1e-30
_FLAT = 1e-6  # slope of a fold


class Stance(NamedTuple):
    """A bridge on a curve, and where the curve goes from it."""

    z: Four
    tangent: Four
    separation: float
    slope: float  # dD/ds over ℓ
    unstable: int  # directions in which the energy falls, under what is held
    margin: float  # of a symmetric bridge against the antisymmetric direction: it changes its sign there; else 1
    opening: float  # the smaller contact circle over ℓ; negative past the far pole of a solid, or for an arc wound up


class Curve(NamedTuple):
    """A curve of bridges that hold one thing, and the sense in which it is followed."""

    held: Held
    symmetric: bool  # kept so, between mirror images
    hand: float


class Walk(NamedTuple):
    """Where a walk ended, and how."""

    event: int
    stance: Stance
    curve: Curve
    nodes: int  # recorded
    going: float  # sign of the slope before the end


@kernel
def stance_at(z: Four, curve: Curve) -> Stance:
    """The bridge at a point of a curve."""
    held, symmetric = curve.held, curve.symmetric
    system = system_at(z, held, True, True)
    rows = minors(first_row(z, system, symmetric).rates, system.contact2.rates)
    tangent = scaled(curve.hand, unit_vector(normal(rows, held_row(z, system, held).rates)))
    return stance_of(z, system, tangent, opening_of(z, system, held), curve)


@kernel
def stance_of(z: Four, system: System, tangent: Four, opening: float, curve: Curve) -> Stance:
    """The bridge at a point whose system and tangent are known."""
    ladder = ladder_at(z, system)
    return Stance(
        z,
        tangent,
        system.separation.value,
        dot(tangent, system.separation.rates) * math.exp(-z.log_length),
        ladder.at_suction if curve.held.control == SUCTION else ladder.at_volume,
        system.contact2.rates.slope if curve.symmetric else 1.0,
        opening,
    )


@kernel
def set_out(z: Four, held: Held, symmetric: bool, going: float) -> tuple[Stance, Curve]:
    """A bridge, and the curve through it followed so that D grows (going > 0) or falls at first."""
    curve = Curve(held, symmetric, 1.0)
    stance = stance_at(z, curve)
    if stance.slope * going < 0.0:
        curve = Curve(held, symmetric, -1.0)
        stance = stance_at(z, curve)
    return stance, curve


@kernel
def corrected(z: Four, curve: Curve, along: Four) -> tuple[Four, int, float]:
    """Newton's method back to the curve in the plane normal to a direction: the point, the steps, the way moved.

    Steps are 0 where it failed.
    """
    held = curve.held
    way = 0.0
    for step in range(1, _MOST_CORRECTIONS + 1):
        system = system_at(z, held, True, held.control == VOLUME)
        first, row = first_row(z, system, curve.symmetric), held_row(z, system, held)
        change, _ = solve4(
            first.rates,
            system.contact2.rates,
            row.rates,
            along,
            -first.value,
            -system.contact2.value,
            -row.value,
            0.0,
        )
        size = math.sqrt(dot(change, change))
        if not size < 2.0:
            return z, 0, way
        z = moved(z, 1.0, change)
        way += size
        if size < _SMALL_CORRECTION:
            return z, step, way
    return z, 0, way


@kernel
def _obeys(before: Stance, after: Stance) -> bool:
    """The rule of folds."""
    folds = before.slope * after.slope < 0.0
    forks = before.margin * after.margin < 0.0
    if folds and forks:
        return False
    return abs(after.unstable - before.unstable) == (1 if folds or forks else 0)


@kernel
def stride(start: Stance, step: float, curve: Curve) -> tuple[Stance, bool, bool]:
    """One step along a curve: where it leads, whether it can be trusted, and whether the next may be longer."""
    z, steps, way = corrected(moved(start.z, step, start.tangent), curve, start.tangent)
    if steps == 0 or way > _LARGEST_CORRECTION * step:
        return start, False, False
    after = stance_at(z, curve)
    cosine = dot(start.tangent, after.tangent)
    trusted = after.opening < _CLOSED or (cosine > _LEAST_COSINE and _obeys(start, after))
    return after, trusted, steps <= 3 and cosine > 0.99


@kernel
def _excess(event: int, stance: Stance, target: float) -> float:
    """What vanishes at an event."""
    if event == PITCHFORK:
        return stance.margin
    if event == FOLD:
        return stance.slope
    return (stance.separation - target) * math.exp(-stance.z.log_length)


@kernel
def _locate(event: int, start: Stance, low: float, high: float, target: float, curve: Curve) -> Stance:
    """The event between two lengths of a step, by the Illinois rule."""
    first = start if low == 0.0 else _stance_after(start, low, curve)
    best = _stance_after(start, high, curve)
    at_low, at_high = _excess(event, first, target), _excess(event, best, target)
    least, side = math.inf, 0
    for _ in range(80):
        middle = low + (high - low) * at_low / (at_low - at_high)
        if not low < middle < high:
            break
        stance = _stance_after(start, middle, curve)
        value = _excess(event, stance, target)
        if abs(value) < least:
            best, least = stance, abs(value)
        if (value > 0.0) == (at_low > 0.0):
            low, at_low = middle, value
            at_high *= 0.5 if side > 0 else 1.0
            side = 1
        else:
            high, at_high = middle, value
            at_low *= 0.5 if side < 0 else 1.0
            side = -1
        if abs(value) < 1e-14 or high - low < 1e-14 * high:
            break
    return best


@kernel
def _stance_after(start: Stance, step: float, curve: Curve) -> Stance:
    z, _steps, _way = corrected(moved(start.z, step, start.tangent), curve, start.tangent)
    return stance_at(z, curve)


@kernel
def _arrived(start: Stance, low: float, high: float, target: float, curve: Curve, unstable: int) -> Stance:
    """The bridge at the target between two lengths of a step; its stability is that of its neighbours."""
    near = _locate(ARRIVED, start, low, high, target, curve)
    z, size = near.z, _LAST_CHANGE
    for _ in range(_MOST_CORRECTIONS):  # next to a fold, where separations are all the same, none is of use
        change = _change_to(target, z, curve)
        if not largest(change) < 0.5 * size:
            break
        z, size = moved(z, 1.0, change), largest(change)
    return with_unstable(stance_at(z, curve), unstable)


@kernel
def _change_to(target: float, z: Four, curve: Curve) -> Four:
    """Newton's step to the bridge of a curve at a separation."""
    held = curve.held
    system = system_at(z, held, True, held.control == VOLUME)
    first, row = first_row(z, system, curve.symmetric), held_row(z, system, held)
    change, _det = solve4(
        first.rates,
        system.contact2.rates,
        system.separation.rates,
        row.rates,
        -first.value,
        -system.contact2.value,
        target - system.separation.value,
        -row.value,
    )
    return change


@kernel
def with_unstable(stance: Stance, unstable: int) -> Stance:
    """A stance whose stability is known from its neighbours: next to a fold its own is the sign of a rounding error."""
    return Stance(stance.z, stance.tangent, stance.separation, stance.slope, unstable, stance.margin, stance.opening)


@kernel
def _encloses(before: Stance, after: Stance, target: float) -> bool:
    return (before.separation - target) * (after.separation - target) <= 0.0 and before.separation != target


@kernel
def _record(nodes: Nodes, count: int, z: Four) -> int:
    """Store a point in the next row, if there is one: the number of rows filled."""
    if count < nodes.shape[0]:
        nodes[count, 0], nodes[count, 1], nodes[count, 2], nodes[count, 3] = z[0], z[1], z[2], z[3]
        return count + 1
    return count


class Stretch(NamedTuple):
    """A step along a curve, cut where an event lies within it."""

    event: int  # FOLD, PITCHFORK, or ARRIVED if none does; ENDED or LOST where there is no step
    reach: float  # length up to the event, or of the step
    end: Stance  # there


@kernel
def _stretch_to(start: Stance, after: Stance, step: float, curve: Curve) -> Stretch:
    """The first event within a step."""
    if start.slope * after.slope < 0.0:
        event = FOLD
    elif start.margin * after.margin < 0.0:
        event = PITCHFORK
    else:
        return Stretch(ARRIVED, step, after)
    end = _locate(event, start, 0.0, step, 0.0, curve)
    return Stretch(event, dot(start.tangent, moved(end.z, -1.0, start.z)), end)


@kernel
def _next(stance: Stance, step: float, curve: Curve) -> tuple[Stance, Stretch, float, float]:
    """The longest step up to a given one that can be trusted, its events, its length, and that to try next.

    The length is 0 where there is none: the curve has ended, or was lost.
    """
    reason = ENDED if stance.opening < _NEARLY_CLOSED else LOST
    while step >= _SHORTEST_STEP:
        after, trusted, longer = stride(stance, step, curve)
        if trusted and after.opening >= _CLOSED:
            stretch = _stretch_to(stance, after, step, curve)
            if stretch.end.opening >= _CLOSED:
                return after, stretch, step, min(_LONGEST_STEP, 1.6 * step) if longer else step
        if trusted:
            reason = ENDED
        step *= 0.4
    return stance, Stretch(reason, 0.0, stance), 0.0, 0.0


@kernel
def recorded(nodes: Nodes, row: int) -> Four:
    """The point in a row."""
    return Four(float(nodes[row, 0]), float(nodes[row, 1]), float(nodes[row, 2]), float(nodes[row, 3]))


@kernel
def follow(stance: Stance, curve: Curve, target: float, stops_at: int, nodes: Nodes) -> Walk:
    """Follow a curve until D meets its target, or what it stops at, or the curve itself ends.

    ``stops_at`` is NOTHING, FOLDS, or BRANCH_ENDS: folds and pitchforks. The points passed are stored in ``nodes``, as
    far as it reaches.
    """
    following, going = _FIRST_STEP, 0.0
    count = _record(nodes, 0, stance.z)
    for _ in range(_MOST_STEPS):
        going = 1.0 if stance.slope > 0.0 else -1.0
        after, stretch, step, following = _next(stance, following, curve)
        if step == 0.0:
            return Walk(stretch.event, stance, curve, count, going)
        if _encloses(stance, stretch.end, target):
            found = _arrived(stance, 0.0, stretch.reach, target, curve, stance.unstable)
            return Walk(ARRIVED, found, curve, _record(nodes, count, found.z), going)
        if stretch.event != ARRIVED:
            count = _record(nodes, count, stretch.end.z)
            if stops_at == BRANCH_ENDS or (stops_at == FOLDS and stretch.event == FOLD):
                end = with_unstable(stretch.end, stance.unstable)
                return Walk(stretch.event, end, curve, count, going)
            if _encloses(stretch.end, after, target):
                found = _arrived(stance, stretch.reach, step, target, curve, after.unstable)
                return Walk(ARRIVED, found, curve, _record(nodes, count, found.z), going)
        stance = after
        count = _record(nodes, count, stance.z)
    return Walk(LOST, stance, curve, count, going)


@kernel
def just_after(stance: Stance, curve: Curve) -> Stance:
    """A bridge so little further that nothing happens in between, where the signs of the ladder are certain."""
    return _stance_after(stance, _PROBE, curve)


@kernel
def beyond(walk: Walk) -> tuple[Stance, Curve]:
    """Where a curve goes on after the fold, or the pitchfork, at which a walk ended.

    The slope and the stability at the event itself are the signs of rounding errors: they are taken from a point
    beyond it. From a pitchfork two curves without symmetry start, mirror images of each other: one of them.
    """
    stance, curve = walk.stance, walk.curve
    if walk.event == PITCHFORK:
        held = curve.held
        curve = Curve(held, False, 1.0)
        away = Four(0.0, 1.0, 0.0, 0.0)
        z, _steps, _way = corrected(moved(stance.z, _FORK_STEP, away), curve, away)
        after = stance_at(z, curve)
        if dot(after.tangent, away) < 0.0:
            curve = Curve(held, False, -1.0)
            after = stance_at(z, curve)
        return after, curve
    unstable = just_after(stance, curve).unstable
    slope = -walk.going * _ROUNDING
    return Stance(stance.z, stance.tangent, stance.separation, slope, unstable, stance.margin, stance.opening), curve


@kernel
def back_from(end: Stance, curve: Curve) -> tuple[Stance, Curve]:
    """Where a curve goes on from the end of a stable branch, back along that branch."""
    back = Curve(curve.held, curve.symmetric, -curve.hand)
    stance = stance_at(end.z, back)
    slope = stance.slope if abs(stance.slope) > _FLAT else math.copysign(_ROUNDING, -_slope_before(stance, back))
    return Stance(stance.z, stance.tangent, stance.separation, slope, 0, 0.0, stance.opening), back


@kernel
def _slope_before(stance: Stance, curve: Curve) -> float:
    return _stance_after(stance, -_PROBE, curve).slope
