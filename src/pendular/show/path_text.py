"""Paths as text: a table for people, columns for machines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..ground.units import show
from .text import UNITS as BRIDGE_UNITS
from .text import Column, columns, plain_fields, table_of

if TYPE_CHECKING:
    from rich.table import Table

    from ..paths import BridgePath

__all__ = ["UNITS", "path_columns", "path_facts", "path_lines", "path_table"]

UNITS = {**BRIDGE_UNITS, "contact_angle": "rad", "line": "", "work": "J", "dissipated": "J"}

_ALIKE = 1e-9  # relative difference of both solids that is none
_OWN = ("contact_angle", "line", "work", "dissipated")
_COMMON = ("separation", "force", "volume", "suction")
_MOST_ROWS = 30  # in a table for people


def path_columns(bridges: BridgePath) -> list[Column]:
    """All that is known of the steps of a path, those of two solids taken apart."""
    own = [
        Column(f"{name}_{solid + 1}", unit, values[..., solid])
        for name, unit, values in (("contact_angle", "rad", bridges.contact_angle), ("line", "", bridges.line))
        for solid in (0, 1)
    ]
    energies = [Column(name, "J", getattr(bridges, name)) for name in ("work", "dissipated")]
    return [*columns(bridges), *own, *energies]


def path_facts(bridges: BridgePath) -> dict[str, Any]:
    """A path as plain data, with the bridge as it broke."""
    facts = {**plain_fields(bridges), **{name: getattr(bridges, name) for name in _OWN}, "ending": bridges.ending}
    facts["rupture"] = None if bridges.rupture is None else path_facts(bridges.rupture)
    return facts


def path_table(bridges: BridgePath, steps: int) -> Table:
    """Table of the bridges of a path, thinned out so that both ends of each leg of so many steps stay."""
    exists = np.asarray(bridges.exists)
    parts = [part for part in range(1, steps + 1) if steps % part == 0]
    stride = next((part for part in parts if exists.size <= _MOST_ROWS * part), steps)
    kept = np.flatnonzero(exists & (np.arange(exists.size) % stride == 0))
    told = [Column(name, UNITS[name], np.asarray(getattr(bridges, name))[kept]) for name in _COMMON]
    told = [column for column in told if column.name == "force" or _varies(column.values)]
    both = ("angle", "rad", bridges.contact_angle[kept]), ("radius", "m", bridges.contact_radius[kept])
    if all(np.allclose(values[:, 0], values[:, 1], rtol=_ALIKE) for _, _, values in both):
        told += [Column(f"contact_{name}", unit, values[:, 0]) for name, unit, values in both]
    else:
        told += [Column(f"{name}_{i + 1}", unit, values[:, i]) for name, unit, values in both for i in (0, 1)]
    told.append(Column("dissipated", "J", np.asarray(bridges.dissipated)[kept]))
    lines = [dict.fromkeys(pair) for pair in bridges.line[kept].tolist()]
    return table_of(told, "lines", [", ".join(words) for words in lines])


def _varies(values: Any) -> bool:
    return bool(np.ptp(values) > _ALIKE * np.max(np.abs(values)))


def path_lines(bridges: BridgePath) -> str:
    """What a path comes to, in a line or two."""
    last = np.flatnonzero(bridges.exists)[-1]
    work, lost = (show(float(np.ravel(values)[last]), "J") for values in (bridges.work, bridges.dissipated))
    spent = f"work {work}, of which {lost} dissipated"
    if bridges.rupture is None:
        return spent
    end = bridges.rupture
    held = show(float(getattr(end, bridges.control)), "Pa" if bridges.control == "suction" else "m^3")
    broken = f"breaks at {show(float(end.separation), 'm')}, {bridges.control} {held}: {bridges.ending}"
    return f"{broken}\n{spent} up to the step before"
