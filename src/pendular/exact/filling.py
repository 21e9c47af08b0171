"""Bridges with a half-filling angle that is asked: where the branches of what is held meet it.

The stable branch, or what leaves it at its ends, is followed; between two of its points, where the angle passes the one
that is asked, Newton's method finds the bridge with the angle in the place of the separation. So all bridges are found,
of which at a volume there may be several.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import Four, dot, largest, moved, solve4, unit_vector
from .answers import FAILED, FOUND, LARGEST_MISS, NO_BRIDGE, STABLE, store
from .curve import Curve, Stance, corrected, set_out, stance_at
from .equations import VOLUME, Held, System, first_row, held_row, system_at
from .follow import BRANCH_ENDS, FOLDS, Nodes, Walk, beyond, follow, just_after, recorded
from .locate import FOLD, LOST, PITCHFORK
from .meridian import Row
from .morph import Task, held_of
from .search import anchor, is_symmetric
from .solids import half_filling_angle
from .state import UNSTABLE_DIRECTIONS, describe

Rows = NDArray[np.float64]

SEVERAL = 3  # a status: more than one bridge has the angle
MOST_FOUND = 6  # bridges of one question
_DEEPEST = -0.5  # separation to which a branch is followed, in an overlap
_LEAST_COSINE = 0.7  # of δ, from which on its sine tells it with all digits
_MOST_HALVINGS, _FEW_SECANTS, _MOST_STEPS = 60, 5, 12
_LAST_STEP = 1e-10  # of Newton's method, after which there is nothing left but rounding
_SAME = 1e-7  # distance of two meridians that are one


class Filling(NamedTuple):
    """A half-filling angle that is asked."""

    solid: int  # 0 or 1
    angle: float  # δ
    sine: float
    cosine: float


@kernel
def _angle_and_rate(z: Four, system: System, held: Held, filling: Filling, along: Four) -> tuple[float, float]:
    """δ less the one that is asked, and its rate along a direction."""
    end, solid = (system.first, held.first) if filling.solid == 0 else (system.second, held.second)
    angle = half_filling_angle(solid, end.radius, end.cos_slope, end.sin_slope)
    return angle - filling.angle, -dot(end.tilt, along)


@kernel
def filling_row(system: System, held: Held, filling: Filling) -> Row:
    """Miss of the half-filling angle, and its rates: of kY = sin δ where that is the sharper."""
    end, solid = (system.first, held.first) if filling.solid == 0 else (system.second, held.second)
    if abs(filling.cosine) > _LEAST_COSINE:
        return Row(math.log(solid.curvature * end.radius / filling.sine), end.growth)
    sine = solid.cos_angle * end.cos_slope - solid.sin_angle * end.sin_slope
    cosine = solid.sin_angle * end.cos_slope + solid.cos_angle * end.sin_slope
    past = math.atan2(sine * filling.cosine - cosine * filling.sine, cosine * filling.cosine + sine * filling.sine)
    tilt = end.tilt
    return Row(past, Four(-tilt[0], -tilt[1], -tilt[2], -tilt[3]))


@kernel
def _settled(z: Four, curve: Curve, filling: Filling) -> tuple[Four, bool]:
    """Newton's method to the bridge with the angle, and whether it was reached without a leap."""
    held, way = curve.held, 0.0
    for _ in range(_MOST_STEPS):
        system = system_at(z, held, True, held.control == VOLUME)
        first, row = first_row(z, system, curve.symmetric), held_row(z, system, held)
        angle = filling_row(system, held, filling)
        change, _det = solve4(
            first.rates,
            system.contact2.rates,
            angle.rates,
            row.rates,
            -first.value,
            -system.contact2.value,
            -angle.value,
            -row.value,
        )
        size = largest(change)
        way += size
        if not way < 0.5:
            return z, False
        z = moved(z, 1.0, change)
        if size < _LAST_STEP:
            return z, True
    return z, False


class Piece(NamedTuple):
    """A step along a curve between two of its points."""

    start: Four
    step: Four
    along: Four  # its direction


@kernel
def _look(piece: Piece, share: float, curve: Curve, filling: Filling) -> tuple[Four, float, float]:
    """The point of the curve at a share of a piece, δ less the one that is asked there, and its rate."""
    z = moved(piece.start, share, piece.step)
    if 0.0 < share < 1.0:
        z, _steps, _way = corrected(z, curve, piece.along)
    stance = stance_at(z, curve)
    value, rate = _angle_and_rate(z, system_at(z, curve.held, True, False), curve.held, filling, stance.tangent)
    return z, value, rate


@kernel
def _crossing(piece: Piece, low: float, at_low: float, high: float, curve: Curve, filling: Filling) -> Four:
    """A point of the curve near to where the angle is the one that is asked, between two shares of a piece."""
    z, at_high, _rate = _look(piece, high, curve, filling)
    for _ in range(_FEW_SECANTS):
        share = low + (high - low) * at_low / (at_low - at_high)
        if not low < share < high:
            share = 0.5 * (low + high)
        z, value, _rate = _look(piece, share, curve, filling)
        if (value > 0.0) == (at_low > 0.0):
            low, at_low = share, value
            at_high *= 0.5
        else:
            high, at_high = share, value
            at_low *= 0.5
    return z


@kernel
def _turning(piece: Piece, rate: float, curve: Curve, filling: Filling) -> tuple[float, float]:
    """Where within a piece the angle is an extremum, and what it is there, less the one that is asked."""
    low, high, value = 0.0, 1.0, 0.0
    for _ in range(_MOST_HALVINGS):
        share = 0.5 * (low + high)
        _z, value, here = _look(piece, share, curve, filling)
        if (here > 0.0) == (rate > 0.0):
            low = share
        else:
            high = share
        if high - low < 1e-9:
            break
    return 0.5 * (low + high), value


@kernel
def _keep(z: Four, found: Nodes, count: int) -> int:
    """Store a meridian that is not there yet."""
    for i in range(count):
        other = recorded(found, i)
        if largest(Four(z[0] - other[0], z[1] - other[1], z[2] - other[2], z[3] - other[3])) < _SAME:
            return count
    if count < found.shape[0]:
        found[count, 0], found[count, 1], found[count, 2], found[count, 3] = z[0], z[1], z[2], z[3]
        return count + 1
    return count


@kernel
def _gather(nodes: Nodes, last: int, curve: Curve, filling: Filling, found: Nodes, count: int) -> int:
    """Add the bridges with the angle that lie between the first points of a curve: how many there are now."""
    if last < 1:
        return count
    held = curve.held
    stance = stance_at(recorded(nodes, 0), curve)
    value, rate = _angle_and_rate(stance.z, system_at(stance.z, held, True, False), held, filling, stance.tangent)
    for i in range(1, last):
        before, at_before, rate_before = stance.z, value, rate
        stance = stance_at(recorded(nodes, i), curve)
        value, rate = _angle_and_rate(stance.z, system_at(stance.z, held, True, False), held, filling, stance.tangent)
        step = moved(stance.z, -1.0, before)
        if not dot(step, step) > 0.0:
            continue
        piece = Piece(before, step, unit_vector(step))
        if at_before * value <= 0.0:
            if at_before == 0.0 and i > 1:
                continue  # stored as the end of the piece before
            near = _crossing(piece, 0.0, at_before, 1.0, curve, filling)
            z, is_met = _settled(near, curve, filling)
            if is_met:
                count = _keep(z, found, count)
        elif rate_before * rate < 0.0 and at_before * rate_before < 0.0:
            share, at_turn = _turning(piece, rate_before, curve, filling)
            if at_turn * value < 0.0:
                near = _crossing(piece, 0.0, at_before, share, curve, filling)
                z, is_met = _settled(near, curve, filling)
                if is_met:
                    count = _keep(z, found, count)
                near = _crossing(piece, share, at_turn, 1.0, curve, filling)
                z, is_met = _settled(near, curve, filling)
                if is_met:
                    count = _keep(z, found, count)
    return count


@kernel
def _mirrored(filling: Filling) -> Filling:
    return Filling(1 - filling.solid, filling.angle, filling.sine, filling.cosine)


@kernel
def _gather_beyond(walk: Walk, target: float, filling: Filling, nodes: Nodes, found: Nodes, count: int) -> int:
    """Add the bridges with the angle on the branches that leave the stable one at its end, up to their own folds."""
    stance, curve = beyond(walk)
    onward = follow(stance, curve, target, FOLDS, nodes)
    count = _gather(nodes, onward.nodes, onward.curve, filling, found, count)
    if walk.event != PITCHFORK:
        return count
    # of the two curves from a pitchfork, mirror images, one was followed: the other has its angles exchanged
    first = count
    count = _gather(nodes, onward.nodes, onward.curve, _mirrored(filling), found, count)
    for i in range(first, count):
        found[i, 1] = -found[i, 1]
    # and mirror images that have lost the stability against sliding stay symmetric up to their fold
    end, after = walk.stance, just_after(walk.stance, walk.curve)
    stance = Stance(end.z, end.tangent, end.separation, after.slope, after.unstable, after.margin, end.opening)
    onward = follow(stance, walk.curve, math.nan, FOLDS, nodes)
    return _gather(nodes, onward.nodes, onward.curve, filling, found, count)


@kernel
def gathered(asked: int, limit: int, task: Task, filling: Filling, nodes: Nodes, found: Nodes) -> tuple[int, int]:
    """Store the meridians of all bridges that have an angle: how many, and whether all of the branch was seen."""
    held, symmetric = held_of(task), is_symmetric(task)
    start, is_stable = anchor(task, nodes)
    if not is_stable:
        return 0, FAILED
    count, status = 0, FOUND
    for going in (1.0, -1.0):
        target = math.nan if going > 0.0 else _DEEPEST
        stance, curve = set_out(start.z, held, symmetric, going)
        if stance.separation <= target:
            continue
        walk = follow(stance, curve, target, limit, nodes)
        if walk.event == LOST:
            status = FAILED
        if asked == STABLE:
            count = _gather(nodes, walk.nodes, walk.curve, filling, found, count)
        elif walk.event == FOLD or walk.event == PITCHFORK:
            onward = _DEEPEST if going > 0.0 else math.nan
            count = _gather_beyond(walk, onward, filling, nodes, found, count)
    return count, status


@kernel
def store_filling(
    asked: int, limit: int, task: Task, filling: Filling, nodes: Nodes, found: Nodes, row: Rows, separations: Rows
) -> int:
    """Store the bridge that has an angle; of several the one nearest to the separation of the task, if that is given.

    The separations of all are stored, too.
    """
    separations[:] = math.nan
    start = task
    if math.isnan(task.separation):
        start = Task(0.0, task.value, task.curvature1, task.angle1, task.curvature2, task.angle2, task.control)
    count, status = gathered(asked, limit, start, filling, nodes, found)
    bridges, best, nearest = 0, -1, math.inf
    held = held_of(task)
    symmetric = is_symmetric(task)
    for i in range(count):
        z = recorded(found, i)
        if store(describe(z, held, symmetric and abs(z.slope) < _SAME), LARGEST_MISS, row) != FOUND:
            continue
        separations[bridges] = row[0]
        bridges += 1
        away = 0.0 if math.isnan(task.separation) else abs(row[0] - task.separation)
        if away < nearest:
            best, nearest = i, away
    if math.isnan(task.separation):
        if bridges > 1:
            return SEVERAL
        if status != FOUND:  # of a branch that was lost on the way there may be more
            return FAILED
    if bridges == 0:
        return NO_BRIDGE if status == FOUND else FAILED
    z = recorded(found, best)
    store(describe(z, held, symmetric and abs(z.slope) < _SAME), LARGEST_MISS, row)
    if asked == STABLE and limit == BRANCH_ENDS:
        row[UNSTABLE_DIRECTIONS] = 0.0
    elif asked != STABLE:
        row[UNSTABLE_DIRECTIONS] = max(1.0, row[UNSTABLE_DIRECTIONS])
    return FOUND
