"""What the library answers: a pair and a bridge as rows of numbers, in any consistent units; kernels for C to call."""

import math

import numpy as np
from numpy.typing import NDArray

from ...ask.domain import is_in_domain, length_unit, reduced
from ...ask.problem import LIKELY_BETWEEN_PLANES
from ...exact import batch
from ...exact.batch import FAILED, FOUND, NO_BRIDGE, RUPTURE, STABLE
from ...exact.follow import BRANCH_ENDS
from ...exact.morph import Task, held_of
from ...exact.state import State
from ...ground.compile import kernel
from ...ground.lanes import lanes
from ...ground.linkable import Array, Constant, Count, Function, Integer, Real, Room

__all__ = [
    "BAD_INPUT",
    "FAILED",
    "FOUND",
    "FUNCTIONS",
    "IN_TURN",
    "NO_BRIDGE",
    "PAIR",
    "PAIRS",
    "ROWS",
    "STATES",
    "Floats",
    "Integers",
    "bridge",
    "end_of_branch",
    "in_units",
    "is_fit",
    "likely_separation",
    "question_of",
]

Floats = NDArray[np.float64]
Integers = NDArray[np.int32]

BAD_INPUT = 3  # a status beside those of the solver
PAIR = ("radius1", "radius2", "contact_angle1", "contact_angle2", "surface_tension")  # numbers of a row

_ALONG = ("separation", "neck_radius", "radius1", "radius2", "middle_radius", "half_length")
_ACROSS = ("area", "across_tensor", "axial_tensor", "wetted_area1", "wetted_area2")
_LENGTHS, _AREAS = (tuple(State._fields.index(name) for name in names) for names in (_ALONG, _ACROSS))
_CURVATURE, _FORCE, _VOLUME, _STIFFNESS, _MIDDLE, _SLOPE, _LENGTH = (
    State._fields.index(name)
    for name in ("curvature", "force", "volume", "stiffness", "middle_radius", "middle_slope", "half_length")
)


@kernel
def is_fit(control: int, separation: float, held: float, pair: Floats) -> bool:
    """Whether a question is one: what `ask.problem` refuses is none, nor is what is not a number."""
    radius1, radius2, tension = pair[0], pair[1], pair[4]
    is_pair = radius1 > 0.0 and radius2 > 0.0 and 0.0 < tension < math.inf
    is_pair = is_pair and 0.0 <= pair[2] < math.pi and 0.0 <= pair[3] < math.pi
    return is_pair and is_in_domain(control, separation, held, radius1, radius2, tension)


@kernel
def in_units(state: Floats, length: float, tension: float) -> None:
    """Turn a reduced state into one in the units of the question."""
    area = length * length
    for i in _LENGTHS:
        state[i] *= length
    for i in _AREAS:
        state[i] *= area
    state[_CURVATURE] /= length
    state[_FORCE] *= 2.0 * math.pi * tension * length
    state[_STIFFNESS] *= 2.0 * math.pi * tension
    state[_VOLUME] *= area * length


@kernel
def question_of(control: int, separation: float, held: float, pair: Floats) -> tuple[Task, float]:
    """The question in a unit of length, and that unit."""
    length = length_unit(control, held, pair[0], pair[1])
    value = reduced(control, held, length, pair[4])
    return Task(separation / length, value, length / pair[0], pair[2], length / pair[1], pair[3], control), length


@kernel
def _near(warm: int, state: Floats, length: float) -> batch.Arc:
    """The bridge that a state holds, in a unit of length; none if the question is not to start from it."""
    middle, half = state[_MIDDLE] / length, state[_LENGTH] / length
    if warm and middle > 0.0 and half > 0.0:
        return batch.arc_through(middle, state[_SLOPE], half, state[_CURVATURE] * length)
    return batch.NOWHERE


@kernel
def _ended(status: int, asked: int, task: Task, length: float, pairs: Floats, states: Floats, i: int) -> int:
    """Answer the question of a row if it is open yet, in its own units; the status."""
    if status == batch.OPEN:
        status = batch.rest_stored(asked, BRANCH_ENDS, task, states[:0], states[i])  # no walk is recorded
    if status == FOUND:
        in_units(states[i], length, pairs[i, 4])
    else:
        states[i, :] = math.nan
    return status


@kernel
def likely_separation(held: float, pair: Floats) -> float:
    """A separation at which a bridge is likely: contact, but two planes are never in touch."""
    is_apart = min(pair[0], pair[1]) == math.inf and held > 0.0
    return LIKELY_BETWEEN_PLANES * held ** (1.0 / 3.0) if is_apart else 0.0


@kernel
def end_of_branch(asked: int, control: int, held: float, pairs: Floats, states: Floats, i: int) -> int:
    """Answer the question of a row for an end of its stable branch; the status."""
    likely = likely_separation(held, pairs[i])
    if not is_fit(control, likely, held, pairs[i]):
        states[i, :] = math.nan
        return BAD_INPUT
    task, length = question_of(control, likely, held, pairs[i])
    return _ended(batch.OPEN, asked, task, length, pairs, states, i)


@kernel
def bridge(warm: int, control: int, separation: float, held: float, pairs: Floats, states: Floats) -> int:
    """The stable bridge of a pair at a separation that holds a suction or a volume; the status.

    With ``warm`` it is sought from the bridge that the state holds, if that leads there.
    """
    if not is_fit(control, separation, held, pairs[0]):
        states[0, :] = math.nan
        return BAD_INPUT
    task, length = question_of(control, separation, held, pairs[0])
    near = _near(warm, states[0], length)
    status = batch.straight_status(batch.ALL, near, task.separation, held_of(task), states[0])
    return _ended(status, STABLE, task, length, pairs, states, 0)


@kernel
def rupture(control: int, held: float, pairs: Floats, states: Floats) -> int:
    """The bridge at the end of its stable branch; the status."""
    return end_of_branch(RUPTURE, control, held, pairs, states, 0)


@kernel
def bridges(
    warm: int,
    control: int,
    separation: Floats,
    held: Floats,
    pairs: Floats,
    states: Floats,
    statuses: Integers,
    abreast: Floats,
) -> int:
    """Answer rows as `bridge` does, as many abreast as the processor takes; the largest status."""
    worst, width = FOUND, lanes()
    for begin in range(0, statuses.size, width):
        count = min(width, statuses.size - begin)
        for lane in range(width):
            i = begin + lane
            if lane < count and is_fit(control, float(separation[i]), float(held[i]), pairs[i]):
                task, length = question_of(control, float(separation[i]), float(held[i]), pairs[i])
                near = _near(warm, states[i], length)
                statuses[i] = batch.ask_abreast(abreast, lane, near, task.separation, held_of(task), warm != 0)
            else:
                batch.ask_nothing(abreast, lane, control)
                if lane < count:
                    statuses[i] = BAD_INPUT
        batch.answer_abreast(abreast, control, batch.ALL, warm != 0)
        for lane in range(count):
            i = begin + lane
            task, length = question_of(control, float(separation[i]), float(held[i]), pairs[i])
            status = int(statuses[i])
            if status == batch.OPEN:
                is_found = batch.found_in_lane(abreast, lane).radius > 0.0
                near = batch.NOWHERE if is_found else _near(warm, states[i], length)
                status = batch.abreast_status(abreast, lane, batch.ALL, near, control, states[i])
            statuses[i] = _ended(status, STABLE, task, length, pairs, states, i)
            worst = max(worst, int(statuses[i]))
    return worst


@kernel
def ruptures(control: int, held: Floats, pairs: Floats, states: Floats, statuses: Integers, abreast: Floats) -> int:
    """Answer rows as `rupture` does, as many abreast as the processor takes; the largest status."""
    worst, width = FOUND, lanes()
    for begin in range(0, statuses.size, width):
        for lane in range(width):
            i = min(begin + lane, statuses.size - 1)
            if is_fit(control, likely_separation(float(held[i]), pairs[i]), float(held[i]), pairs[i]):
                task, length = question_of(control, 0.0, float(held[i]), pairs[i])
                batch.ask_end_abreast(abreast, lane, task)
                statuses[i] = batch.OPEN
            else:
                batch.ask_no_end(abreast, lane, control)
                statuses[i] = BAD_INPUT
        batch.ends_abreast(abreast, control)
        for i in range(begin, min(begin + width, statuses.size)):
            task, length = question_of(control, likely_separation(float(held[i]), pairs[i]), float(held[i]), pairs[i])
            status = int(statuses[i])
            if status == batch.OPEN:
                found = batch.found_in_lane(abreast, i - begin)
                status = batch.summit_status(RUPTURE, BRANCH_ENDS, task, found, states[i])
            statuses[i] = _ended(status, RUPTURE, task, length, pairs, states, i)
            worst = max(worst, int(statuses[i]))
    return worst


PAIRS, STATES, STATUSES = Array(len(PAIR)), Array(len(State._fields)), Array(kind="int32")
_ONE = (Integer(), Real(), Real(), PAIRS, STATES)
ROWS = (Integer(), Count(), Array(), Array(), PAIRS, STATES, STATUSES)
_ROOM = Room(batch.ROOM_ABREAST)

IN_TURN = (
    Function("pendular_bridge", bridge, (Constant(0), *_ONE)),
    Function("pendular_bridge_near", bridge, (Constant(1), *_ONE)),
    Function("pendular_rupture", rupture, (Integer(), Real(), PAIRS, STATES)),
)
FUNCTIONS = (
    *IN_TURN,
    Function("pendular_bridges", bridges, (Constant(0), *ROWS, _ROOM)),
    Function("pendular_bridges_near", bridges, (Constant(1), *ROWS, _ROOM)),
    Function("pendular_ruptures", ruptures, (Integer(), Count(), Array(), PAIRS, STATES, STATUSES, _ROOM)),
)
