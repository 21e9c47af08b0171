"""The exact solver over arrays: one range kernel for each kind of question.

A row of ``questions`` is ``(D, value, k1, θ1, k2, θ2)`` with the value of H or of V; the answer is a row of ``states``,
the fields of :class:`~pendular.exact.equilibrium.State`, and a status.
"""

import math

import numpy as np
from numpy.typing import NDArray

from .._jit import kernel
from .branches import find, find_limit, path_state
from .equilibrium import Solids, fold, is_limited_by_second, solve_suction, swapped
from .middle import SEPARATION
from .path import FOLD, LOST, PITCHFORK, TARGET, Curve
from .states import FAILED, FOUND, NO_BRIDGE, keep_if_met, mark_fold, store, store_suction

Rows = NDArray[np.float64]
Statuses = NDArray[np.int8]

# What is asked: the bridge on the stable branch, on the unstable one, the fold, the first loss of stability.
STABLE, UNSTABLE, AT_FOLD, AT_INSTABILITY = 0, 1, 2, 3


@kernel
def _solids(row: Rows) -> Solids:
    return Solids(row[2], row[3], row[4], row[5])


@kernel
def suction_range(asked: int, questions: Rows, states: Rows, statuses: Statuses, start: int, stop: int) -> None:
    """Bridges or folds at given curvatures H ≥ 0, for the rows from start to stop."""
    for i in range(start, stop):
        separation, curvature = questions[i, 0], questions[i, 1]
        solids = _solids(questions[i])
        is_swapped = is_limited_by_second(curvature, solids)
        if is_swapped:
            solids = swapped(solids)
        if asked in (STABLE, UNSTABLE):
            arc = solve_suction(separation, curvature, solids, asked == UNSTABLE)
        else:
            arc = fold(curvature, solids)
            arc = 0.0 if math.isnan(arc) else arc
        if arc > 0.0:
            statuses[i] = store_suction(arc, curvature, solids, is_swapped, states[i])
            if asked in (AT_FOLD, AT_INSTABILITY):
                mark_fold(states[i], True)
            else:
                statuses[i] = keep_if_met(statuses[i], separation, states[i])
        else:
            states[i, :] = math.nan
            statuses[i] = NO_BRIDGE if arc == 0.0 else FAILED


@kernel
def path_range(asked: int, held: int, questions: Rows, states: Rows, statuses: Statuses, start: int, stop: int) -> None:
    """Bridges, folds or instabilities at given volumes, or curvatures H < 0, for the rows from start to stop."""
    for i in range(start, stop):
        curve = Curve(_solids(questions[i]), held, questions[i, 1], SEPARATION)
        if asked in (STABLE, UNSTABLE):
            end = find(questions[i, 0], curve, asked == UNSTABLE)
            found = end.event == TARGET
        else:
            end = find_limit(curve, asked == AT_INSTABILITY)
            found = end.event in (FOLD, PITCHFORK)
        if found:
            state = path_state(end.z, end.tangent, curve, asked != UNSTABLE)
            store(state, states[i])
            statuses[i] = FOUND
            if end.event == FOLD:
                mark_fold(states[i], state.stable > 0.0)
            elif end.event == TARGET:
                statuses[i] = keep_if_met(FOUND, questions[i, 0], states[i])
        else:
            states[i, :] = math.nan
            statuses[i] = FAILED if end.event == LOST else NO_BRIDGE
