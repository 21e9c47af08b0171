"""Many stable bridges at once, from SI numbers to SI fields in one pass over the rows.

What the straight way of the solver does not answer is asked of the rest of it, in rows of their own.
"""

import math
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..exact import batch
from ..exact.batch import FOUND, OPEN
from ..exact.equations import SUCTION, VOLUME
from ..exact.state import State, state_in
from ..ground.compile import kernel
from ..ground.lanes import lanes
from ..ground.rows import Own, element, entry, over_rows
from .domain import is_in_domain, length_unit, reduced
from .fields import TO_GO_ON, Room, asks_for_force_alone, bridge_of, fill, leave_empty, restore_rows, room_for
from .liquid import Liquid
from .pair import Pair
from .problem import LIMITS, Control, Limit, reduce, warn_of_failures
from .result import Bridge

Floats = NDArray[np.float64]
Statuses = NDArray[np.int8]

_CHUNK = 4096  # bridges that one thread takes at a time: some milliseconds
_OWN = Own(partial(np.empty, len(State._fields))), batch.ABREAST  # of each thread
BAD = 3  # status of a row that is no question


@entry(plain_cost=5e-4, patience=4.0)
def fields_range(
    wanted: int,
    control: int,
    separation: Floats,
    values: Floats,
    radius1: Floats,
    radius2: Floats,
    angle1: Floats,
    angle2: Floats,
    tension: float,
    near: Floats,
    room: Room,
    statuses: Statuses,
    row: Floats,
    abreast: Floats,
    start: int,
    stop: int,
) -> None:
    """Fields of the stable bridges to which the straight way leads; others stay OPEN.

    Columns of ``near``, if it has any, are bridges to start from: radius and slope in the middle, half a length,
    suction.
    """
    known1 = known2 = math.nan
    cosine1 = sine1 = cosine2 = sine2 = math.nan
    width, is_near = lanes(), near.shape[1] > 0
    for begin in range(start, stop, width):
        count = min(width, stop - begin)
        for lane in range(width):
            i = begin + min(lane, count - 1)  # beyond the end the last one is asked again
            gap, held = element(separation, i), element(values, i)
            first, second = element(radius1, i), element(radius2, i)
            one, other = element(angle1, i), element(angle2, i)
            if one != known1:
                known1, cosine1, sine1 = one, math.cos(one), math.sin(one)
            if other != known2:
                known2, cosine2, sine2 = other, math.cos(other), math.sin(other)
            if not is_in_domain(control, gap, held, first, second, tension):
                statuses[i] = BAD
                batch.ask_nothing(abreast, lane, control)
                continue
            unit = length_unit(control, held, first, second)
            one_solid, other_solid = (
                batch.Solid(unit / first, one, cosine1, sine1),
                batch.Solid(unit / second, other, cosine2, sine2),
            )
            kept = batch.Held(one_solid, other_solid, control, reduced(control, held, unit, tension))
            arc = _arc_near(near, i, unit, tension)
            statuses[i] = batch.ask_abreast(abreast, lane, arc, gap / unit, kept, is_near)
        batch.answer_abreast(abreast, control, wanted, is_near)
        for lane in range(count):
            i = begin + lane
            gap, held = element(separation, i), element(values, i)
            unit = length_unit(control, held, element(radius1, i), element(radius2, i))
            if statuses[i] == OPEN:
                is_found = batch.found_in_lane(abreast, lane).radius > 0.0
                arc = batch.NOWHERE if is_found else _arc_near(near, i, unit, tension)
                statuses[i] = batch.abreast_status(abreast, lane, wanted, arc, control, row)
            if statuses[i] == FOUND:
                cosines = batch.cosines_in_lane(abreast, lane)
                fill(room, i, state_in(row), control, gap, held, unit, tension, cosines[0], cosines[1])
            else:
                leave_empty(room, i, statuses[i])


@kernel
def _arc_near(near: Floats, i: int, unit: float, tension: float) -> batch.Arc:
    """The bridge to start from, if there is one."""
    if near.shape[1] > 0 and near[0, i] > 0.0:
        return batch.arc_through(near[0, i] / unit, near[1, i], near[2, i] / unit, near[3, i] * unit / tension)
    return batch.NOWHERE


def _plainly(room: Room, statuses: Statuses, *asking: Any) -> None:
    """Answer rows one by one in plain Python; where its arithmetic has no answer, as 1/0, a row stays OPEN."""
    given: tuple[Any, ...] = asking[:-2]
    for i in range(len(statuses)):
        try:
            fields_range(*(*given, i, i + 1))
        except (ArithmeticError, ValueError):
            statuses[i] = OPEN
            leave_empty(room, i, OPEN)


def _operand(array: Any, shape: tuple[int, ...]) -> Floats:
    """An argument as rows: one for all, or one each."""
    if array.size == 1:
        return np.reshape(array, 1)
    if array.shape == shape:
        return np.ascontiguousarray(array).reshape(-1)
    return np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1)


def many_bridges(
    pair: Pair,
    control: Control,
    liquid: Liquid,
    separation: Floats,
    limit: Limit,
    fields: tuple[str, ...] | None,
    near: Bridge | None,
) -> Bridge | None:
    """Stable bridges of an array of questions; None if there is but one question."""
    radii, angles = pair.radii, pair.contact_angles
    given = [np.asarray(each) for each in (separation, control.value, *radii, *angles)]
    try:
        shape = np.broadcast_shapes(*(each.shape for each in given))
    except ValueError:
        shape = reduce(pair, control, liquid, separation).shape  # which names them
    if not shape:
        return None
    rows = math.prod(shape)
    held = VOLUME if control.name == "volume" else SUCTION
    wanted = batch.ALL
    if asks_for_force_alone(fields, control.name):
        wanted = batch.FORCE_ALONE if near is None else batch.FORCE_TO_GO_ON
    operands = [_operand(each, shape) for each in given]
    start = _columns_of(near, shape)
    if near is not None and fields is not None:
        fields = (*fields, *TO_GO_ON)
    room, statuses = room_for(rows, fields), np.empty(rows, np.int8)
    tension = float(liquid.surface_tension)
    asking = (wanted, held, *operands, tension, start, room, statuses, *_OWN)
    over_rows(fields_range, rows, _CHUNK, *asking, plainly=partial(_plainly, room, statuses))
    if rows and statuses.max() == BAD:
        reduce(pair, control, liquid, separation)  # which says what is wrong
    left = np.flatnonzero((statuses == OPEN) | (statuses == BAD))
    if left.size:
        _fill_rest(operands, control, liquid, held, limit, left, room, statuses)
    warn_of_failures(statuses)
    return bridge_of(room, shape, radii, tension, fields)


def _columns_of(near: Bridge | None, shape: tuple[int, ...]) -> Floats:
    """Where to start from, a column for each row; none without bridges near by."""
    if near is None:
        return np.empty((4, 0))
    if np.shape(near.force) != shape:
        raise ValueError(f"near: bridges of shape {np.shape(near.force)} are not of that of the question, {shape}")
    if np.any(near.exists) and not np.any(near._meridian[..., 0] > 0.0):
        raise ValueError(
            "near: these bridges do not know their meridians; ask for all fields, or give near to them too"
        )
    columns = np.empty((4, math.prod(shape)))
    columns[:3] = np.moveaxis(near._meridian, -1, 0).reshape(3, -1)
    columns[3] = np.ravel(near.suction)
    return columns


def _fill_rest(
    operands: list[Floats],
    control: Control,
    liquid: Liquid,
    held: int,
    limit: Limit,
    left: NDArray[np.intp],
    room: Room,
    statuses: Statuses,
) -> None:
    """Ask the rest of the solver, and fill the rows that it answers."""
    gap, value, radius1, radius2, angle1, angle2 = (
        np.full(left.size, operand[0]) if operand.size == 1 else operand[left] for operand in operands
    )
    pair = Pair((radius1, radius2), (angle1, angle2))
    problem = reduce(pair, control._replace(value=value), liquid, gap)
    states, found = batch.answer_rest(batch.STABLE, held, problem.rows, LIMITS[limit])
    statuses[left] = found
    restore_rows(room, left, held, gap, value, problem.length, angle1, angle2, liquid.surface_tension, states, found)
