r"""Where a bridge condenses on approach: the separation at which it costs nothing.

At constant suction a bridge is worth having as soon as its grand potential is below that of dry solids, Ω < 0. Since
:math:`d\Omega/dD = F`, Newton's method from contact climbs to Ω(D) = 0 without passing it.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ..exact import batch
from ..exact.state import State
from .model import Data, Model, beside, problem_of

__all__ = ["formation_at"]

Floats = NDArray[np.float64]

_MOST_STEPS, _MET = 30, 1e-12  # steps, and the last of them over the smaller radius


def formation_at(model: Model, data: Data, variables: Floats, *, with_rates: bool) -> tuple[float, Floats]:
    """Separation at which a bridge condenses, [m], and its rates in the variables, by differences.

    It is 0 where solids do not condense any.
    """
    base = np.asarray(variables, dtype=np.float64)
    asked, wide = beside(model, base) if with_rates else (base[None, :], np.empty(0))
    contact = np.zeros(1)
    problems = [problem_of(model, model.at(row), contact, data.last_time) for row in asked]
    rows = np.concatenate([problem.rows for problem in problems])
    for _ in range(_MOST_STEPS):
        states, _statuses = batch.answer(batch.STABLE, problems[0].held, rows)
        state = State(*states.T)
        dry = np.cos(rows[:, 3]) * state.wetted_area1 + np.cos(rows[:, 5]) * state.wetted_area2
        potential = state.area - dry + state.curvature * state.volume
        step = np.nan_to_num(-potential / (2.0 * math.pi * state.force))
        rows[:, 0] = np.maximum(rows[:, 0] + step, 0.0)
        if np.max(np.abs(step)) < _MET:
            break
    distance = rows[:, 0] * np.array([problem.length.item() for problem in problems])
    count = base.size
    rates = (distance[1 : count + 1] - distance[count + 1 :]) / wide if with_rates else np.zeros(count)
    return float(distance[0]), rates
