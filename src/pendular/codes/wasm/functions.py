"""What the module answers beside the functions of the library: whole curves, outlines to draw, and the laws."""

import math
from collections.abc import Iterator

from ...exact.algebra import Four
from ...exact.answers import LOWER_END, holds_nothing
from ...exact.equations import VOLUME
from ...exact.follow import BRANCH_ENDS
from ...exact.meridian import lay_meridian
from ...exact.morph import held_of
from ...exact.sensitivities import Rates, rates_at
from ...exact.state import State
from ...exact.tracing import trace
from ...ground.compile import kernel
from ...ground.linkable import Array, Count, Function, Integer, Real
from ...laws import Quantity
from ...laws._registry import house_laws
from ..library import kernels
from ..library.kernels import BAD_INPUT, FOUND, NO_BRIDGE, PAIRS, STATES, Floats, Integers, in_units, is_fit

__all__ = ["ASKED", "functions"]

_NODE = 4  # numbers of a place on the way along a branch
ASKED: tuple[Quantity, ...] = ("force", "rupture")  # of a law
_SEPARATION, _MIDDLE, _SLOPE, _LENGTH, _CURVATURE = (
    State._fields.index(name) for name in ("separation", "middle_radius", "middle_slope", "half_length", "curvature")
)


@kernel
def bridges(control: int, separation: Floats, held: Floats, pairs: Floats, states: Floats, statuses: Integers) -> int:
    """Bridges of rows one after the other, as wide vectors would double the module; the largest status."""
    worst = FOUND
    for i in range(statuses.size):
        row = slice(i, i + 1)
        statuses[i] = kernels.bridge(0, control, float(separation[i]), float(held[i]), pairs[row], states[row])
        worst = max(worst, int(statuses[i]))
    return worst


@kernel
def lower_end(control: int, held: float, pairs: Floats, states: Floats) -> int:
    """The bridge at which the stable branch begins, if that is not at contact; the status."""
    return kernels.end_of_branch(LOWER_END, control, held, pairs, states, 0)


@kernel
def curve(control: int, held: float, pairs: Floats, states: Floats, nodes: Floats) -> int:
    """Bridges from contact, or the lower end, to rupture in the middle, and down the unstable branch; the status."""
    pair = pairs[0]
    states[:] = math.nan
    likely = kernels.likely_separation(held, pair)
    if not is_fit(control, likely, held, pair):
        return BAD_INPUT
    task, length = kernels.question_of(control, likely, held, pair)
    status = NO_BRIDGE if holds_nothing(task) else trace(BRANCH_ENDS, task, states, nodes)
    if status == FOUND:
        for i in range(states.shape[0]):
            in_units(states[i], length, pair[4])
    return status


@kernel
def force_rates(control: int, held: float, pairs: Floats, states: Floats, rates: Floats) -> int:
    """Rates of the force of the bridge that a state holds; those in the radii are in their logarithms."""
    pair, state, found = pairs[0], states[0], rates[0]
    found[:] = math.nan
    if not is_fit(control, float(state[_SEPARATION]), held, pair):
        return BAD_INPUT
    if not (state[_MIDDLE] > 0.0 and state[_LENGTH] > 0.0):
        return NO_BRIDGE
    task, length = kernels.question_of(control, float(state[_SEPARATION]), held, pair)
    turn = state[_CURVATURE] * state[_LENGTH]
    z = Four(math.log(state[_MIDDLE] / length), state[_SLOPE], math.log(state[_LENGTH] / length), turn)
    reduced = rates_at(z, held_of(task))
    unit = 2.0 * math.pi * pair[4] * length
    found[0] = unit * reduced.separation / length
    found[1] = unit * reduced.held * (1.0 / (length * length * length) if control == VOLUME else length / pair[4])
    found[2] = -unit * reduced.curvature1 * task.curvature1
    found[3] = unit * reduced.cos_angle1
    found[4] = -unit * reduced.curvature2 * task.curvature2
    found[5] = unit * reduced.cos_angle2
    return FOUND


@kernel
def meridian(arc: Floats, place: Floats, radius: Floats) -> int:
    """Place from the first end and radius along the arc with a middle radius, slope, half length and curvature."""
    middle, slope, length, curvature = arc[0], arc[1], arc[2], arc[3]
    if not (middle > 0.0 and length > 0.0):
        return NO_BRIDGE
    lay_meridian(Four(math.log(middle), slope, math.log(length), curvature * length), place, radius)
    return FOUND


def functions() -> tuple[Function, ...]:
    """All functions of the module, the laws of this package among them."""
    branch = (Integer(), Real(), PAIRS)
    drawn = (
        Function("pendular_bridges", bridges, kernels.ROWS),
        Function("pendular_lower_end", lower_end, (*branch, STATES)),
        Function("pendular_curve", curve, (*branch, Count(), STATES, Count(), Array(_NODE))),
        Function("pendular_force_rates", force_rates, (*branch, STATES, Array(len(Rates._fields)))),
        Function("pendular_meridian", meridian, (Array(), Count(), Array(), Array())),
    )
    return (*kernels.IN_TURN, *drawn, *_laws())


def _laws() -> Iterator[Function]:
    for law in house_laws():
        for quantity in ASKED:
            if (function := law.kernels.get(quantity)) is not None:
                count = function.__code__.co_argcount
                yield Function(f"law_{law.name}_{quantity}", function, (Real(),) * count, Real())
