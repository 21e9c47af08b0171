"""The exact solver over arrays: the only door for many questions at once.

A row of ``questions`` is a :class:`Task` without its control: D, H or V, k1, θ1, k2, θ2; a row of ``states`` holds the
fields of :class:`State`.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._jit import in_chunks, kernel
from .algebra import moved, unit_vector
from .clearance import radius_range
from .ends import lower_end, stable_bridge, unstable_bridge, upper_end
from .equations import SUCTION, VOLUME, system_at
from .follow import (
    ARRIVED,
    BRANCH_ENDS,
    ENDED,
    FOLD,
    LOST,
    NOTHING,
    PITCHFORK,
    Curve,
    Nodes,
    Stance,
    Walk,
    back_from,
    beyond,
    corrected,
    follow,
    recorded,
    set_out,
)
from .guess import guess_at
from .morph import Task, held_of
from .newton import newton_to
from .search import at_separation, is_symmetric
from .state import Description, State, describe

Rows = NDArray[np.float64]
Statuses = NDArray[np.int8]

# What is asked: the bridge on the stable branch, beyond it, the end of the stable branch, its lower end.
STABLE, UNSTABLE, RUPTURE, LOWER_END = 0, 1, 2, 3
FOUND, NO_BRIDGE, FAILED = 0, 1, 2

_MET = 1e-13  # largest miss of the end of a branch, over the length of the arc, that is the end itself
_ROUNDING = 1e-15  # of a sum of cosines
_LARGEST_MISS = 1e-10  # of the equations of an answer
_MISS_WHERE_CLOSED = 1e-8  # where a contact circle has nearly closed, its slope is known no better
_MOST_STEPS = 14
_THREAD = 0.03  # thinnest circle of a drawn bridge over the widest of its branch
_MOST_NODES = 1200
_CHUNK = 1024  # bridges that one thread takes at a time: some milliseconds, against which its start is nothing
_STIFFNESS, _INDEX = State._fields.index("stiffness"), State._fields.index("unstable_directions")


@kernel
def task_of(row: Rows, control: int) -> Task:
    """The task in a row of questions."""
    value = float(row[1]) / math.pi if control == VOLUME else float(row[1])
    return Task(float(row[0]), value, float(row[2]), float(row[3]), float(row[4]), float(row[5]), control)


class End(NamedTuple):
    """A bridge that answers a question, or where the search for it ended."""

    stance: Stance
    curve: Curve
    event: int  # at the end of a branch; ARRIVED on the way
    status: int


@kernel
def _store(description: Description, allowed: float, row: Rows) -> int:
    """Store a state in a row, if it is a bridge that holds what it should."""
    if not description.miss <= allowed:
        return FAILED
    if not description.is_bridge:
        return NO_BRIDGE
    for j, value in enumerate(description.state):
        row[j] = value
    return FOUND


@kernel
def _store_end(end: End, row: Rows) -> int:
    """Store where a search ended.

    At the end of a branch the index and the slope are the signs of rounding errors: what is stored is that of the
    branch which ends there, and at a fold the force falls, or at a lower end rises, infinitely fast.
    """
    allowed = _MISS_WHERE_CLOSED if end.event == ENDED else _LARGEST_MISS
    status = _store(describe(end.stance.z, end.curve.held, end.curve.symmetric), allowed, row)
    row[_INDEX] = float(end.stance.unstable)
    return status


@kernel
def _end_of(walk: Walk, is_known: bool) -> End:
    """The end of a branch at which a walk arrived."""
    is_end = is_known and (walk.event == FOLD or walk.event == PITCHFORK or walk.event == ENDED)
    return End(walk.stance, walk.curve, walk.event, FOUND if is_end else FAILED)


@kernel
def _bridge_of(walk: Walk, separation: float) -> End:
    """The bridge at a separation at which a walk arrived, or that of the end of the branch, if it is there."""
    miss = abs(walk.stance.separation - separation) * math.exp(-walk.stance.z.log_length)
    if walk.event == LOST:
        status = FAILED
    elif walk.event == ARRIVED:
        status = FOUND if miss <= _LARGEST_MISS else FAILED
    else:
        status = FOUND if miss <= _MET else NO_BRIDGE
    return End(walk.stance, walk.curve, walk.event, status)


@kernel
def _answer(asked: int, limit: int, task: Task, nodes: Nodes) -> End:
    if asked == STABLE:
        return _bridge_of(stable_bridge(task, limit, nodes), task.separation)
    if asked == UNSTABLE:
        walk, is_known = unstable_bridge(task, limit, nodes)
        if not is_known:
            return End(walk.stance, walk.curve, LOST, FAILED)
        return _bridge_of(walk, task.separation)
    if asked == LOWER_END:
        walk, is_known = lower_end(task, limit, nodes)
        end = _end_of(walk, is_known)
        return End(end.stance, end.curve, end.event, NO_BRIDGE) if walk.event == ARRIVED else end
    walk, is_known = upper_end(task, limit, nodes)
    end = _end_of(walk, is_known)
    return End(end.stance, end.curve, end.event, NO_BRIDGE) if walk.stance.separation < 0.0 else end


@kernel
def _holds_nothing(task: Task) -> bool:
    """Whether no stable bridge is possible at any separation: under suction the solids have to be wetted."""
    wetting = math.cos(task.angle1) + math.cos(task.angle2)
    return task.control == SUCTION and task.value >= 0.0 and not wetting > _ROUNDING


@kernel
def _directly(task: Task, row: Rows) -> int:
    """Store the stable bridge, if Newton's method leads to it from a guess."""
    held = held_of(task)
    z, is_met = newton_to(guess_at(held, task.separation), task.separation, held, _MOST_STEPS)
    if not is_met:
        return FAILED
    description = describe(z, held, is_symmetric(task))
    if description.state.unstable_directions != 0.0 or not description.is_bridge:
        return FAILED
    return _store(description, _LARGEST_MISS, row)


@kernel
def bridge_range(
    asked: int, limit: int, control: int, questions: Rows, states: Rows, statuses: Statuses, start: int, stop: int
) -> None:
    """Answer the rows from start to stop."""
    nodes = np.empty((0, 4))
    for i in range(start, stop):
        task = task_of(questions[i], control)
        status = NO_BRIDGE
        if not _holds_nothing(task):
            status = _directly(task, states[i]) if asked == STABLE else FAILED
            if status != FOUND:
                end = _answer(asked, limit, task, nodes)
                status = end.status
                if status == FOUND:
                    status = _store_end(end, states[i])
                    if end.event == FOLD:
                        states[i, _STIFFNESS] = math.inf if asked == LOWER_END else -math.inf
                elif status == FAILED and control == SUCTION and task.value < 0.0:
                    status = NO_BRIDGE  # under pressure most pairs hold no bridge; one that exists is found
        statuses[i] = status
        if status != FOUND:
            states[i, :] = math.nan


def answer(asked: int, control: int, questions: Rows, limit: int = BRANCH_ENDS) -> tuple[Rows, Statuses]:
    """Answer rows of questions on all threads: their states and statuses."""
    count = len(questions)
    states, statuses = np.empty((count, len(State._fields))), np.empty(count, np.int8)
    in_chunks(bridge_range, count, _CHUNK, asked, limit, control, questions, states, statuses)
    return states, statuses


@kernel
def _spread(nodes: Nodes, count: int, curve: Curve, states: Rows, skips_first: bool) -> None:
    """States evenly spaced over the recorded nodes, without the last of them, or without the first."""
    rows = states.shape[0]
    for i in range(rows):
        place = (count - 1) * (i + (1.0 if skips_first else 0.0)) / rows
        node = min(int(place), count - 2)
        before = recorded(nodes, node)
        step = moved(recorded(nodes, node + 1), -1.0, before)
        z = moved(before, place - node, step)
        if 0.0 < place - node < 1.0:
            z, _steps, _way = corrected(z, curve, unit_vector(step))
        _store(describe(z, curve.held, curve.symmetric), _LARGEST_MISS, states[i])


@kernel
def _first_of(task: Task, limit: int, nodes: Nodes) -> End:
    """Where a curve begins: the bridge at contact, or the lower end of the stable branch."""
    walk, is_known = lower_end(task, limit, nodes)
    if is_known and walk.event == ARRIVED:
        return _bridge_of(stable_bridge(at_separation(task, 0.0), limit, nodes), 0.0)
    return _end_of(walk, is_known)


@kernel
def _thins_out(nodes: Nodes, count: int, curve: Curve) -> int:
    """How many of the nodes of an unstable branch are drawn: up to a thread of liquid."""
    widest = 0.0
    for i in range(count):
        z = recorded(nodes, i)
        least, most = radius_range(z, system_at(z, curve.held, False, False))
        widest = max(widest, most)
        if least < _THREAD * widest and i > 1:
            return i
    return count


@kernel
def trace(limit: int, task: Task, states: Rows, nodes: Nodes) -> int:
    """A whole curve: from contact, or the lower end, to the end of the stable branch, and down the unstable one."""
    states[:] = math.nan
    first = _first_of(task, limit, nodes)
    if first.status != FOUND:
        return first.status
    middle = states.shape[0] // 2
    held, symmetric = held_of(task), is_symmetric(task)
    if first.event == ARRIVED:
        stance, curve = set_out(first.stance.z, held, symmetric, 1.0)
    else:
        stance, curve = back_from(first.stance, first.curve)
    walk = follow(stance, curve, math.nan, limit, nodes)
    if walk.event not in (FOLD, PITCHFORK) or not walk.stance.separation > 0.0:
        return FAILED if walk.event == LOST else NO_BRIDGE
    _spread(nodes, walk.nodes, walk.curve, states[:middle], False)
    _store_end(_end_of(walk, True), states[middle])
    if walk.event == FOLD:
        states[middle, _STIFFNESS] = -math.inf
    if first.event == FOLD:
        states[0, _STIFFNESS], states[0, _INDEX] = math.inf, 0.0
    if first.event == ARRIVED:
        states[0, 0] = 0.0  # contact, which the solver meets to rounding
    stance, curve = beyond(walk)
    down = follow(stance, curve, 0.0, NOTHING, nodes)
    count = _thins_out(nodes, down.nodes, down.curve)
    if count > 1:
        _spread(nodes, count, down.curve, states[middle + 1 :], True)
    return FOUND


@kernel
def curve_range(
    limit: int,
    control: int,
    questions: Rows,
    states: NDArray[np.float64],
    statuses: Statuses,
    start: int,
    stop: int,
) -> None:
    """Whole curves for the rows from start to stop; ``states`` has an axis of points before that of the fields."""
    nodes = np.empty((_MOST_NODES, 4))
    for i in range(start, stop):
        task = task_of(questions[i], control)
        status = NO_BRIDGE if _holds_nothing(task) else trace(limit, task, states[i], nodes)
        if status == FAILED and control == SUCTION and task.value < 0.0:
            status = NO_BRIDGE
        statuses[i] = status
        if status != FOUND:
            states[i] = math.nan


def draw(control: int, questions: Rows, points: int, limit: int = BRANCH_ENDS) -> tuple[NDArray[np.float64], Statuses]:
    """Whole curves for rows of questions, on all threads: (rows, points, fields), and the status of each point."""
    count = len(questions)
    states, statuses = np.empty((count, points, len(State._fields))), np.empty(count, np.int8)
    in_chunks(curve_range, count, 1, limit, control, questions, states, statuses)
    each = np.repeat(statuses[:, None], points, axis=1)
    each[(each == FOUND) & np.isnan(states[..., 0])] = NO_BRIDGE
    return states, each
