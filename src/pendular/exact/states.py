"""How an answer is stored: a status, and a state as a row of numbers."""

import math

import numpy as np
from numpy.typing import NDArray

from .._jit import kernel
from .equilibrium import Solids, State, mirrored, suction_state

FOUND, NO_BRIDGE, FAILED = 0, 1, 2
_SEPARATION, _STIFFNESS, _HALF_LENGTH, _STABLE = (
    State._fields.index(name) for name in ("separation", "stiffness", "half_length", "stable")
)
_MET = 1e-9  # largest miss of a separation, over half the length of the meridian


@kernel
def store(state: State, row: NDArray[np.float64]) -> None:
    """Store a state in a row, in the order of its fields."""
    for i, value in enumerate(state):
        row[i] = value


@kernel
def store_suction(
    wetted_arc: float, curvature: float, solids: Solids, is_swapped: bool, row: NDArray[np.float64]
) -> int:
    """Store the state at a wetted arc; ``is_swapped`` tells that the two solids change places in the row."""
    state = suction_state(wetted_arc, curvature, solids)
    if not state.half_length > 0.0:  # inside the overlap of two solids there is no room for a meniscus
        row[:] = math.nan
        return NO_BRIDGE
    store(mirrored(state) if is_swapped else state, row)
    return FOUND


@kernel
def keep_if_met(status: int, separation: float, row: NDArray[np.float64]) -> int:
    """Status of a stored state, FAILED if it is not at the separation that was asked: no plausible number instead."""
    if status == FOUND and not abs(row[_SEPARATION] - separation) <= _MET * row[_HALF_LENGTH]:
        row[:] = math.nan
        return FAILED
    return status


@kernel
def mark_fold(row: NDArray[np.float64], is_stable: bool) -> None:
    """Make a stored state the end of its stable branch, where the force falls infinitely fast.

    What the solver found are the signs of rounding errors; ``is_stable`` tells of the branch that ends here.
    """
    row[_STIFFNESS] = -math.inf
    row[_STABLE] = 1.0 if is_stable else 0.0
