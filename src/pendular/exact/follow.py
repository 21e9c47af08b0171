"""Following a curve of bridges that hold one thing, along its tangent, over folds and pitchforks.

A step that cannot be trusted is made shorter. A curve ends where a contact circle closes.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import Four, dot, moved
from .curve import CLOSED, Curve, Stance, corrected, stance_after, stance_at, stride, with_unstable
from .locate import ARRIVED, ENDED, FOLD, LOST, PITCHFORK, Stretch, arrived, encloses, stretch_to

Nodes = NDArray[np.float64]

# What a walk stops at, beside its target.
NOTHING, FOLDS, BRANCH_ENDS = 0, 1, 2

_FIRST_STEP, _LONGEST_STEP, _SHORTEST_STEP = 0.05, 0.3, 1e-10
_MOST_STEPS = 1000
_NEARLY_CLOSED = 1e-2  # where a curve that cannot be followed on ends all the same: the circle closes in a fold
_FORK_STEP = 0.02  # of the slope in the middle, away from a pitchfork
_PROBE = 1e-3  # way beyond a fold to where the signs of the ladder are certain
_ROUNDING = 1e-30
_FLAT = 1e-6  # slope of a fold


class Walk(NamedTuple):
    """Where a walk ended, and how."""

    event: int
    stance: Stance
    curve: Curve
    nodes: int  # recorded
    going: float  # sign of the slope before the end


@kernel
def _next(stance: Stance, step: float, curve: Curve) -> tuple[Stance, Stretch, float, float]:
    """The longest step up to a given one that can be trusted, its events, its length, and that to try next.

    The length is 0 where there is none: the curve has ended, or was lost.
    """
    reason = ENDED if stance.opening < _NEARLY_CLOSED else LOST
    while step >= _SHORTEST_STEP:
        after, trusted, longer = stride(stance, step, curve)
        if trusted and after.opening >= CLOSED:
            stretch = stretch_to(stance, after, step, curve)
            trusted = stretch.event != LOST
            if trusted and stretch.end.opening >= CLOSED:
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
def _record(nodes: Nodes, count: int, z: Four) -> int:
    """Store a point in the next row, if there is one: the number of rows filled."""
    if count < nodes.shape[0]:
        nodes[count, 0], nodes[count, 1], nodes[count, 2], nodes[count, 3] = z[0], z[1], z[2], z[3]
        return count + 1
    return count


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
        if encloses(stance, stretch.end, target):
            found = arrived(stance, 0.0, stretch.reach, target, curve, stance.unstable)
            return Walk(ARRIVED, found, curve, _record(nodes, count, found.z), going)
        if stretch.event != ARRIVED:
            count = _record(nodes, count, stretch.end.z)
            if stops_at == BRANCH_ENDS or (stops_at == FOLDS and stretch.event == FOLD):
                end = with_unstable(stretch.end, stance.unstable)
                return Walk(stretch.event, end, curve, count, going)
            if encloses(stretch.end, after, target):
                found = arrived(stance, stretch.reach, step, target, curve, after.unstable)
                return Walk(ARRIVED, found, curve, _record(nodes, count, found.z), going)
        stance = after
        count = _record(nodes, count, stance.z)
    return Walk(LOST, stance, curve, count, going)


@kernel
def just_after(stance: Stance, curve: Curve) -> Stance:
    """A bridge so little further that nothing happens in between, where the signs of the ladder are certain."""
    return stance_after(stance, _PROBE, curve)[0]


@kernel
def beyond(walk: Walk) -> tuple[Stance, Curve]:
    """Where a curve goes on after the fold, or the pitchfork, at which a walk ended.

    The slope and the stability at the event itself are the signs of rounding errors: they are taken from a point
    beyond it, and beyond a pitchfork that is next to a fold. From a pitchfork two curves without symmetry start, mirror
    images of each other: one of them.
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
    after, slope = just_after(stance, curve), -walk.going * _ROUNDING
    return (
        Stance(stance.z, stance.tangent, stance.separation, slope, after.unstable, after.margin, stance.opening),
        curve,
    )


@kernel
def back_from(end: Stance, curve: Curve) -> tuple[Stance, Curve]:
    """Where a curve goes on from the end of a stable branch, back along that branch."""
    back = Curve(curve.held, curve.symmetric, -curve.hand)
    stance = stance_at(end.z, back)
    slope = stance.slope if abs(stance.slope) > _FLAT else math.copysign(_ROUNDING, -_slope_before(stance, back))
    return Stance(stance.z, stance.tangent, stance.separation, slope, 0, 0.0, stance.opening), back


@kernel
def _slope_before(stance: Stance, curve: Curve) -> float:
    return stance_after(stance, -_PROBE, curve)[0].slope
