"""What a law is asked with under the control that it does not know: the suction or the volume of the exact bridge.

A law belongs to one control, but a force at a separation does not depend on what is held. Under the other control the
exact solver turns the given suction into the volume of the bridge, or the volume into its suction, and the law is asked
with that, wherever the bridge is the one that this volume or this suction would hold. Every bridge that a suction holds
is held by its volume too; one of given volume outlives the rupture distance of its suction, and from there on no law at
constant suction speaks of it.
"""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..exact.equations import SUCTION
from .problem import Problem, control_name, derjaguin_radius, solve

__all__ = ["States", "other_control_star"]

Floats = NDArray[np.float64]

_SAME = 1e-6  # by how much the forces of two answers for one bridge may differ


class States(Protocol):
    """Exact stable bridges of a problem, in SI units; NaN where there is none."""

    @property
    def force(self) -> float | Floats: ...  # noqa: D102
    @property
    def suction(self) -> float | Floats: ...  # noqa: D102
    @property
    def volume(self) -> float | Floats: ...  # noqa: D102


def other_control_star(problem: Problem, exact: States) -> Floats:
    """Reduced volume of stable bridges at given suction, or suction at given volume: V* or H*, one a row.

    NaN where there is no bridge, and where no law of the other control speaks of it: where its suction would not hold
    it, or is a pressure.
    """
    if control_name(problem) == "suction":
        return np.ravel(exact.volume) / derjaguin_radius(problem) ** 3
    reduced = np.ravel(exact.suction) * problem.length / problem.surface_tension
    is_suction = reduced > 0.0
    rows = problem.rows.copy()
    rows[:, 1] = np.where(is_suction, reduced, 1.0)
    drained = solve(problem._replace(rows=rows, held=SUCTION), "stable")
    is_held = is_suction & np.isclose(np.ravel(drained.force), np.ravel(exact.force), rtol=_SAME, atol=0.0)
    held: Floats = np.where(is_held, reduced, np.nan) * derjaguin_radius(problem) / problem.length
    return held
