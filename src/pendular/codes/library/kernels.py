"""What the library answers: a pair and a bridge as rows of numbers, in any consistent units; kernels for C to call."""

import math

import numpy as np
from numpy.typing import NDArray

from ...ask.domain import is_in_domain, length_unit, reduced
from ...ask.problem import LIKELY_BETWEEN_PLANES
from ...exact.algebra import Four
from ...exact.answers import stored_from
from ...exact.batch import FAILED, FOUND, NO_BRIDGE, RUPTURE, STABLE, answer_one
from ...exact.follow import BRANCH_ENDS
from ...exact.morph import Task
from ...exact.state import State
from ...ground.compile import kernel
from ...ground.linkable import Array, Constant, Count, Function, Integer, Real

__all__ = [
    "BAD_INPUT",
    "FAILED",
    "FOUND",
    "FUNCTIONS",
    "NO_BRIDGE",
    "PAIR",
    "PAIRS",
    "STATES",
    "Floats",
    "end_of_branch",
    "in_units",
    "is_fit",
    "likely_separation",
    "task_of",
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
def task_of(control: int, separation: float, held: float, length: float, pair: Floats) -> Task:
    """The question in a unit of length."""
    value = reduced(control, held, length, pair[4])
    return Task(separation / length, value, length / pair[0], pair[2], length / pair[1], pair[3], control)


@kernel
def _answered(
    asked: int, warm: int, control: int, separation: float, held: float, pairs: Floats, states: Floats, i: int
) -> int:
    """Answer the question of a row; with ``warm`` from the bridge that its state holds, if that leads there."""
    pair, state = pairs[i], states[i]
    if not is_fit(control, separation, held, pair):
        state[:] = math.nan
        return BAD_INPUT
    length = length_unit(control, held, pair[0], pair[1])
    task = task_of(control, separation, held, length, pair)
    status = FAILED
    if warm and state[_MIDDLE] > 0.0 and state[_LENGTH] > 0.0:
        turn = state[_CURVATURE] * state[_LENGTH]
        near = Four(math.log(state[_MIDDLE] / length), state[_SLOPE], math.log(state[_LENGTH] / length), turn)
        status = stored_from(near, task, state)
    if status != FOUND:
        status = answer_one(asked, BRANCH_ENDS, task, states[:0], state)  # of which no walk is recorded
    if status == FOUND:
        in_units(state, length, pair[4])
    return status


@kernel
def likely_separation(held: float, pair: Floats) -> float:
    """A separation at which a bridge is likely: contact, but two planes are never in touch."""
    is_apart = min(pair[0], pair[1]) == math.inf and held > 0.0
    return LIKELY_BETWEEN_PLANES * held ** (1.0 / 3.0) if is_apart else 0.0


@kernel
def end_of_branch(asked: int, control: int, held: float, pairs: Floats, states: Floats, i: int) -> int:
    """Answer the question of a row for an end of its stable branch; the status."""
    return _answered(asked, 0, control, likely_separation(held, pairs[i]), held, pairs, states, i)


@kernel
def bridge(warm: int, control: int, separation: float, held: float, pairs: Floats, states: Floats) -> int:
    """The stable bridge of a pair at a separation that holds a suction or a volume; the status."""
    return _answered(STABLE, warm, control, separation, held, pairs, states, 0)


@kernel
def rupture(control: int, held: float, pairs: Floats, states: Floats) -> int:
    """The bridge at the end of its stable branch; the status."""
    return end_of_branch(RUPTURE, control, held, pairs, states, 0)


@kernel
def bridges(
    warm: int, control: int, separation: Floats, held: Floats, pairs: Floats, states: Floats, statuses: Integers
) -> int:
    """Answer rows as `bridge` does; the largest status."""
    worst = FOUND
    for i in range(statuses.size):
        status = _answered(STABLE, warm, control, float(separation[i]), float(held[i]), pairs, states, i)
        statuses[i] = status
        worst = max(worst, status)
    return worst


@kernel
def ruptures(control: int, held: Floats, pairs: Floats, states: Floats, statuses: Integers) -> int:
    """Answer rows as `rupture` does; the largest status."""
    worst = FOUND
    for i in range(statuses.size):
        status = end_of_branch(RUPTURE, control, float(held[i]), pairs, states, i)
        statuses[i] = status
        worst = max(worst, status)
    return worst


PAIRS, STATES, _STATUSES = Array(len(PAIR)), Array(len(State._fields)), Array(kind="int32")
_ONE = (Integer(), Real(), Real(), PAIRS, STATES)
_ROWS = (Integer(), Count(), Array(), Array(), PAIRS, STATES, _STATUSES)

FUNCTIONS = (
    Function("pendular_bridge", bridge, (Constant(0), *_ONE)),
    Function("pendular_bridge_near", bridge, (Constant(1), *_ONE)),
    Function("pendular_rupture", rupture, (Integer(), Real(), PAIRS, STATES)),
    Function("pendular_bridges", bridges, (Constant(0), *_ROWS)),
    Function("pendular_bridges_near", bridges, (Constant(1), *_ROWS)),
    Function("pendular_ruptures", ruptures, (Integer(), Count(), Array(), PAIRS, STATES, _STATUSES)),
)
