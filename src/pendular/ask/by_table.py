"""A public question answered from a table of the exact answer: for very many bridges of one pair of contact angles."""

from dataclasses import replace
from functools import lru_cache
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..ground.check import plain
from ..table import Table, tabulate
from .problem import Problem, control_name, control_si, derjaguin_radius, partial_bridge
from .result import Bridge

Floats = NDArray[np.float64]


def bridge_by_table(problem: Problem) -> Bridge:
    """Force, stiffness, volume and suction at a separation."""
    separation = problem.rows[:, 0] * problem.length
    overlapping = np.flatnonzero(separation < 0.0)
    if overlapping.size:
        value = separation[overlapping[0]]
        raise ValueError(f"separation: {value:.6g} m is not >= 0, where method 'table' ends; 'exact' knows overlaps")
    force, stiffness, other = np.empty((3, separation.size))
    for chosen, table, arguments in _tables(problem):
        asked = (separation[chosen], *arguments)
        force[chosen], stiffness[chosen] = table.force(*asked), table.stiffness(*asked)
        other[chosen] = (table.volume if table.control == "suction" else table.suction)(*asked)
    exists = (force != 0.0) & ~np.isnan(force)
    unit = 2.0 * np.pi * problem.surface_tension * derjaguin_radius(problem)
    answer = partial_bridge(problem, separation, force / unit, exists)
    name = "volume" if control_name(problem) == "suction" else "suction"
    known: dict[str, Any] = {name: other, "stiffness": stiffness}
    return replace(answer, **{field: plain(value.reshape(problem.shape)) for field, value in known.items()})


def rupture_by_table(problem: Problem) -> Bridge:
    """Rupture distance: the end of the stable branch."""
    distance = np.empty(len(problem.rows))
    for chosen, table, arguments in _tables(problem):
        distance[chosen] = table.rupture_distance(*arguments)
    return partial_bridge(problem, distance, np.full(distance.shape, np.nan), distance > 0.0)


def _tables(problem: Problem) -> list[tuple[NDArray[np.bool_], Table, tuple[Floats, Floats, Floats, Floats]]]:
    """Rows of each pair of contact angles, its table, and control, radii and surface tension of these rows."""
    k1, angle1, k2, angle2 = problem.rows[:, 2:].T
    name, length, held = control_name(problem), problem.length, control_si(problem)
    with np.errstate(divide="ignore"):
        radius1, radius2 = length / k1, length / k2
    found = []
    for angles in np.unique(np.column_stack([angle1, angle2]), axis=0).tolist():
        chosen = (angle1 == angles[0]) & (angle2 == angles[1])
        tension = np.full(int(np.count_nonzero(chosen)), problem.surface_tension)
        found.append((chosen, _table_of(*angles, name), (held[chosen], radius1[chosen], radius2[chosen], tension)))
    return found


@lru_cache(maxsize=16)
def _table_of(angle1: float, angle2: float, control: Literal["suction", "volume"]) -> Table:
    """The table over the default ranges: made once for each pair of contact angles, and kept."""
    return tabulate((angle1, angle2), control)
