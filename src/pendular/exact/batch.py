"""The exact solver over arrays: the only door for many questions at once.

A row of ``questions`` is a :class:`Task` without its control: D, H or V, k1, θ1, k2, θ2; a row of ``states`` holds the
fields of :class:`State`.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.lanes import lanes
from ..ground.rows import Own, entry, over_rows
from .abreast import (
    ROOM_ABREAST,
    answer_abreast,
    ask_end_in_lane,
    ask_in_lane,
    ask_no_end,
    ask_nothing,
    asked_in_lane,
    cosines_in_lane,
    ends_abreast,
    found_in_lane,
)
from .algebra import Four
from .answers import (
    FAILED,
    FOUND,
    LOWER_END,
    MET,
    NO_BRIDGE,
    RUPTURE,
    STABLE,
    UNSTABLE,
    Answer,
    answer_at_end,
    answer_to,
    directly_stored,
    holds_nothing,
    holds_nothing_between,
    store_end,
)
from .arc import NOWHERE, Arc, arc_through
from .direct import ALL, FORCE_ALONE, FORCE_TO_GO_ON, all_stored, start_of, store_force, straight_stored
from .equations import SUCTION, VOLUME, Held
from .filling import MOST_FOUND, SEVERAL, Filling, store_filling
from .follow import BRANCH_ENDS
from .locate import ARRIVED, FOLD
from .meridian import lay_meridian
from .morph import Task, held_of
from .nucleus import nucleus_stored
from .search import are_alike, are_planes, is_symmetric
from .solids import Solid
from .state import HALF_LENGTH, STIFFNESS, State
from .summit import end_stored, summit_stored
from .tracing import trace

__all__ = [
    "ABREAST",
    "ALL",
    "FAILED",
    "FORCE_ALONE",
    "FORCE_TO_GO_ON",
    "FOUND",
    "LOWER_END",
    "NOWHERE",
    "NO_BRIDGE",
    "OPEN",
    "ROOM_ABREAST",
    "RUPTURE",
    "SEVERAL",
    "STABLE",
    "UNSTABLE",
    "Arc",
    "Held",
    "Solid",
    "abreast_status",
    "answer",
    "answer_abreast",
    "answer_filling",
    "answer_rest",
    "arc_through",
    "ask_abreast",
    "ask_end_abreast",
    "ask_no_end",
    "ask_nothing",
    "cosines_in_lane",
    "draw",
    "ends_abreast",
    "found_in_lane",
    "lay",
    "rest_stored",
    "straight_status",
    "summit_status",
]

Rows = NDArray[np.float64]
Numbers = NDArray[np.float64]  # of one axis
Statuses = NDArray[np.int8]

OPEN = -1  # status of a row that a part of the solver leaves to the whole of it

_BEYOND = 1e-9  # over the length of the arc, of a separation that is beyond rupture for certain
MOST_NODES = 1200
_CHUNK = 1024  # bridges that one thread takes at a time: some milliseconds, against which its start is nothing


def _room_for_nodes() -> Rows:
    return np.empty((MOST_NODES, 4))


ABREAST = Own(partial(np.empty, ROOM_ABREAST))  # room of a thread for rows abreast


def _room_for_found() -> Rows:
    return np.empty((MOST_FOUND, 4))


@kernel
def task_of(row: Rows, control: int) -> Task:
    """The task in a row of questions."""
    value = float(row[1]) / math.pi if control == VOLUME else float(row[1])
    return Task(float(row[0]), value, float(row[2]), float(row[3]), float(row[4]), float(row[5]), control)


@kernel
def _can_hold(task: Task) -> bool:
    """Whether a stable bridge is possible at all."""
    return _can_hold_between(held_of(task))


@kernel
def straight_status(wanted: int, near: Arc, separation: float, held: Held, row: Rows) -> int:
    """Store the stable bridge, or of it the force alone, to which the straight way leads, else OPEN."""
    if not _can_hold_between(held):
        return NO_BRIDGE
    symmetric = are_alike(held.first, held.second)
    return FOUND if straight_stored(near, separation, held, symmetric, wanted, row) else OPEN


@kernel
def _can_hold_between(held: Held) -> bool:
    """Whether a stable bridge is possible at all."""
    planes = held.control == SUCTION and held.first.curvature + held.second.curvature == 0.0
    return not planes and not holds_nothing_between(held)


@kernel
def ask_abreast(room: Numbers, lane: int, near: Arc, separation: float, held: Held, is_near: bool) -> int:
    """Ask for a stable bridge in a lane; where all start from an arc near by, one that has none does from its guess.

    The status is OPEN until the lanes are answered.
    """
    if not _can_hold_between(held):
        ask_nothing(room, lane, held.control)
        return NO_BRIDGE
    start = start_of(held, separation, 1.0) if is_near and not near.radius > 0.0 else near
    ask_in_lane(room, lane, separation, held, start)
    return OPEN


@kernel
def abreast_status(room: Numbers, lane: int, wanted: int, near: Arc, control: int, row: Rows) -> int:
    """Store the stable bridge that was found in a lane, or what the straight way leads to by itself, else OPEN."""
    separation, held = asked_in_lane(room, lane, control)
    arc = found_in_lane(room, lane)
    if arc.radius > 0.0:
        if wanted != ALL:
            store_force(arc, separation, held, wanted, row)
            return FOUND
        if all_stored(arc, held, are_alike(held.first, held.second), False, row):
            return FOUND
    return straight_status(wanted, near, separation, held, row)


@kernel
def ask_end_abreast(room: Numbers, lane: int, task: Task) -> None:
    """Ask for a rupture in a lane, if there can be one."""
    if _can_hold(task):
        ask_end_in_lane(room, lane, held_of(task))
    else:
        ask_no_end(room, lane, task.control)


@kernel
def summit_status(asked: int, limit: int, task: Task, found: Arc, row: Rows) -> int:
    """Store a rupture that is beyond doubt, or tell that no bridge is beyond it; else OPEN.

    The arc found there is taken if its radius is above 0.
    """
    if not _can_hold(task):
        return NO_BRIDGE
    held, symmetric = held_of(task), is_symmetric(task)
    is_stored = found.radius > 0.0 and end_stored(found, FOLD, held, symmetric, row)
    if not (is_stored or summit_stored(held, symmetric, limit, row)):
        return OPEN
    if asked == RUPTURE:
        return FOUND if row[0] >= 0.0 else NO_BRIDGE
    beyond = (task.separation - row[0]) / row[HALF_LENGTH]
    if abs(beyond) <= MET:
        return FOUND
    return NO_BRIDGE if beyond > _BEYOND else OPEN


@kernel
def _end_stored(asked: int, limit: int, task: Task, row: Rows) -> int:
    """Store what Newton's method finds from a guess, or leaps to rupture, or tell that no bridge is; else OPEN."""
    if not _can_hold(task):
        return NO_BRIDGE
    if asked == STABLE and directly_stored(task, row) == FOUND:
        return FOUND
    end = answer_at_end(asked, limit, task)
    status = _stored(asked, end, row) if end.status == FOUND else end.status
    return OPEN if status == FAILED or (status != FOUND and end.event == ARRIVED) else status


@kernel
def _stored(asked: int, end: Answer, row: Rows) -> int:
    """Store where a search ended; at a fold the force changes infinitely fast."""
    status = store_end(end, row)
    if end.event == FOLD:
        row[STIFFNESS] = math.inf if asked == LOWER_END else -math.inf
    return status


@kernel
def _bridge_stored(asked: int, limit: int, task: Task, nodes: Rows, row: Rows) -> int:
    """Store what is asked, by every way to find it."""
    if task.control == SUCTION and are_planes(task):
        return nucleus_stored(task, nodes, row) if asked == UNSTABLE else NO_BRIDGE
    if holds_nothing(task):
        return NO_BRIDGE
    end = answer_to(asked, limit, task, nodes[:0])
    if end.status == FOUND:
        return _stored(asked, end, row)
    return _under_pressure(end.status, task)


@kernel
def _under_pressure(status: int, task: Task) -> int:
    """The status of a search: under pressure most pairs hold no bridge, and one that exists is found."""
    return NO_BRIDGE if status == FAILED and task.control == SUCTION and task.value < 0.0 else status


@kernel
def rest_stored(asked: int, limit: int, task: Task, nodes: Rows, row: Rows) -> int:
    """Store the answer to a question that the straight way has left open, by each part after those that are sooner."""
    status = summit_status(asked, limit, task, NOWHERE, row) if asked in (STABLE, RUPTURE) else OPEN
    if status == OPEN and asked in (STABLE, RUPTURE):
        status = _end_stored(asked, limit, task, row)
    if status == OPEN:
        status = _bridge_stored(asked, limit, task, nodes, row)
    return _ended(status, row)


@kernel
def _ended(status: int, row: Rows) -> int:
    """The status; a row without an answer is NaN."""
    if status != FOUND:
        row[:] = math.nan
    return status


@entry(plain_cost=5e-4, patience=4.0)
def stable_range(
    wanted: int, control: int, questions: Rows, states: Rows, statuses: Statuses, room: Numbers, start: int, stop: int
) -> None:
    """Stable bridges of the rows to which the straight way leads; others stay OPEN."""
    width = lanes()
    for begin in range(start, stop, width):
        count = min(width, stop - begin)
        for lane in range(width):
            if lane < count:
                task = task_of(questions[begin + lane], control)
                statuses[begin + lane] = ask_abreast(room, lane, NOWHERE, task.separation, held_of(task), False)
            else:
                ask_nothing(room, lane, control)
        answer_abreast(room, control, wanted, False)
        for lane in range(count):
            i = begin + lane
            status = int(statuses[i])
            if status == OPEN:
                status = abreast_status(room, lane, wanted, NOWHERE, control, states[i])
            statuses[i] = _ended(status, states[i])


@entry(plain_cost=4e-3, patience=4.0)
def summit_range(
    asked: int,
    limit: int,
    control: int,
    questions: Rows,
    states: Rows,
    statuses: Statuses,
    room: Numbers,
    start: int,
    stop: int,
) -> None:
    """Ruptures of the rows that are beyond doubt, and bridges that are asked beyond them; others stay OPEN."""
    width = lanes()
    for begin in range(start, stop, width):
        for lane in range(width):
            ask_end_abreast(room, lane, task_of(questions[min(begin + lane, stop - 1)], control))
        ends_abreast(room, control)
        for i in range(begin, min(begin + width, stop)):
            found = found_in_lane(room, i - begin)
            status = summit_status(asked, limit, task_of(questions[i], control), found, states[i])
            statuses[i] = _ended(status, states[i])


@entry(plain_cost=5e-3, patience=4.0)
def end_range(
    asked: int, limit: int, control: int, questions: Rows, states: Rows, statuses: Statuses, start: int, stop: int
) -> None:
    """Answer the rows whose branch ends where leaps from a guess lead: ruptures, and bridges next to or not before it.

    Others stay OPEN.
    """
    for i in range(start, stop):
        statuses[i] = _ended(_end_stored(asked, limit, task_of(questions[i], control), states[i]), states[i])


@entry(plain_cost=0.05, patience=15.0)
def bridge_range(
    asked: int,
    limit: int,
    control: int,
    questions: Rows,
    states: Rows,
    statuses: Statuses,
    nodes: Rows,
    start: int,
    stop: int,
) -> None:
    """Answer the rows from start to stop."""
    for i in range(start, stop):
        status = _bridge_stored(asked, limit, task_of(questions[i], control), nodes, states[i])
        statuses[i] = _ended(status, states[i])


def answer(
    asked: int, control: int, questions: Rows, limit: int = BRANCH_ENDS, wanted: int = ALL
) -> tuple[Rows, Statuses]:
    """Answer rows of questions on all threads: their states and statuses.

    Where the force of stable bridges is wanted alone, the states of most hold little more than that.

    Parts of the solver, soon compiled, answer nearly all; rows that one leaves open are asked of the next, and the last
    is the whole.
    """
    states, statuses = np.empty((len(questions), len(State._fields))), np.full(len(questions), OPEN, np.int8)
    if asked == STABLE:
        _over_open(stable_range, (wanted, control), questions, states, statuses, ABREAST)
    _answer_open(asked, control, questions, limit, states, statuses)
    return states, statuses


def answer_rest(asked: int, control: int, questions: Rows, limit: int) -> tuple[Rows, Statuses]:
    """Answer rows of questions that the straight way has left open."""
    states, statuses = np.empty((len(questions), len(State._fields))), np.full(len(questions), OPEN, np.int8)
    _answer_open(asked, control, questions, limit, states, statuses)
    return states, statuses


def _answer_open(asked: int, control: int, questions: Rows, limit: int, states: Rows, statuses: Statuses) -> None:
    asking = (questions, states, statuses)
    if asked in (STABLE, RUPTURE):
        _over_open(summit_range, (asked, limit, control), *asking, ABREAST)
        _over_open(end_range, (asked, limit, control), *asking)
    _over_open(bridge_range, (asked, limit, control), *asking, Own(_room_for_nodes))


def _over_open(
    function: Callable[..., None], given: tuple[int, ...], questions: Rows, states: Rows, statuses: Statuses, *room: Own
) -> None:
    """Run an entry over the rows that are open."""
    rows = np.flatnonzero(statuses == OPEN)
    if not rows.size:
        return
    part = questions, states, statuses
    if rows.size < len(statuses):
        part = questions[rows], np.empty((rows.size, states.shape[1])), np.empty(rows.size, np.int8)
    plainly = partial(_plainly, function, *part[1:])
    over_rows(function, rows.size, _CHUNK, *given, *part, *room, plainly=plainly)
    if rows.size < len(statuses):
        states[rows], statuses[rows] = part[1:]


def _plainly(function: Callable[..., None], states: Rows, statuses: Statuses, *asking: Any) -> None:
    """Answer the rows one by one in plain Python.

    Where its arithmetic has no answer, as 1/0, the whole solver has failed, and a part of it leaves the row open.
    """
    for i in range(len(statuses)):
        try:
            function(*asking[:-2], i, i + 1)
        except (ArithmeticError, ValueError):
            states[i, :], statuses[i] = math.nan, FAILED if function is bridge_range else OPEN


@entry(plain_cost=0.5)
def curve_range(
    limit: int,
    control: int,
    questions: Rows,
    states: NDArray[np.float64],
    statuses: Statuses,
    nodes: Rows,
    start: int,
    stop: int,
) -> None:
    """Whole curves for the rows from start to stop; ``states`` has an axis of points before that of the fields."""
    for i in range(start, stop):
        task = task_of(questions[i], control)
        status = NO_BRIDGE if holds_nothing(task) else trace(limit, task, states[i], nodes)
        statuses[i] = _ended(_under_pressure(status, task), states[i])


def draw(control: int, questions: Rows, points: int, limit: int = BRANCH_ENDS) -> tuple[NDArray[np.float64], Statuses]:
    """Whole curves for rows of questions, on all threads: (rows, points, fields), and the status of each point."""
    count = len(questions)
    states, statuses = np.empty((count, points, len(State._fields))), np.empty(count, np.int8)
    over_rows(curve_range, count, 1, limit, control, questions, states, statuses, Own(_room_for_nodes))
    each = np.repeat(statuses[:, None], points, axis=1)
    each[(each == FOUND) & np.isnan(states[..., 0])] = NO_BRIDGE
    return states, each


@entry(plain_cost=0.2)
def filling_range(
    asked: int,
    limit: int,
    control: int,
    solid: int,
    angles: NDArray[np.float64],
    questions: Rows,
    states: Rows,
    separations: Rows,
    statuses: Statuses,
    nodes: Rows,
    found: Rows,
    start: int,
    stop: int,
) -> None:
    """Bridges that have a half-filling angle, for the rows from start to stop."""
    for i in range(start, stop):
        task, angle = task_of(questions[i], control), float(angles[i])
        status = NO_BRIDGE
        if not holds_nothing(task):
            filling = Filling(solid, angle, math.sin(angle), math.cos(angle))
            status = store_filling(asked, limit, task, filling, nodes, found, states[i], separations[i])
            status = _under_pressure(status, task)
        statuses[i] = _ended(status, states[i])


def answer_filling(
    asked: int, control: int, solid: int, angles: NDArray[np.float64], questions: Rows, limit: int = BRANCH_ENDS
) -> tuple[Rows, Statuses, Rows]:
    """Bridges that have a half-filling angle on a solid, 0 or 1: their states and statuses.

    The separation in a row of questions is NaN, or near to that of the bridge that is meant. The separations of all
    bridges with the angle are the third result; where there are several and none is meant, the status is SEVERAL.
    """
    count = len(questions)
    states, statuses = np.empty((count, len(State._fields))), np.empty(count, np.int8)
    separations = np.full((count, MOST_FOUND), math.nan)
    asking = (asked, limit, control, solid, angles, questions, states, separations, statuses)
    over_rows(filling_range, count, 16, *asking, Own(_room_for_nodes), Own(_room_for_found))
    return states, statuses, separations


@entry(plain_cost=5e-3)
def meridian_range(arcs: Rows, place: Rows, radius: Rows, start: int, stop: int) -> None:
    """Meridians of the rows from start to stop, as radius and slope in the middle, half the length, and H."""
    for i in range(start, stop):
        middle, slope, length, curvature = arcs[i]
        if middle > 0.0 and math.isfinite(middle):
            z = Four(math.log(middle), float(slope), math.log(length), float(curvature * length))
            lay_meridian(z, place[i], radius[i])


def lay(arcs: Rows, points: int) -> tuple[Rows, Rows]:
    """Place on the axis from the first end, and radius, of so many points along meridians; NaN where there is none."""
    place, radius = np.full((2, len(arcs), points), math.nan)
    over_rows(meridian_range, len(arcs), _CHUNK, arcs, place, radius)
    return place, radius
