"""Answers of a heap as text: tables for people, JSON and CSV for machines."""

from __future__ import annotations

import csv
import io
import json
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..ground.units import show
from .retention import QUANTITIES, Retention
from .wetted import Wet

if TYPE_CHECKING:
    from rich.console import RenderableType

__all__ = ["curves_csv", "curves_json", "curves_table", "state_csv", "state_json", "state_table"]

_ROWS = 12  # of curves, for people
_NAMES = (
    "saturation",
    "water_content",
    "mass_ratio",
    "suction_stress",
    "chi",
    "interface_area",
    "coordination",
    "contacts",
)


def state_table(w: Wet, limit: float, with_stress: bool, friction_angle: float | None) -> RenderableType:
    """One state, for people; ``limit`` is the suction below which bridges meet."""
    from rich.table import Table

    table = Table.grid(padding=(0, 3))
    for name, value, meaning in _state_rows(w, limit, friction_angle):
        table.add_row(name, value, meaning)
    if with_stress:
        table.add_row("")
        _add_stress(table, w)
    return table


def _state_rows(w: Wet, limit: float, friction_angle: float | None) -> list[tuple[str, str, str]]:
    meetings = w.meetings
    rows = [
        ("suction", show(w.suction, "Pa", 4), "common to all bridges"),
        ("porosity", f"{w.porosity:.4f}", f"{w.heap.count} grains"),
        ("saturation", _percent(w.saturation), "liquid over pores"),
        ("water content", _percent(w.water_content), "liquid over the whole volume"),
    ]
    if math.isfinite(w.mass_ratio):
        rows.append(("mass ratio", _percent(w.mass_ratio), "liquid over grains"))
    rows += [
        ("suction stress", show(w.suction_stress, "Pa", 4), "mean capillary stress, tension positive"),
        ("χ", f"{w.chi:.4g}", "suction stress over suction"),
        ("interface", f"{w.interface_area:.4g} 1/m", "menisci over the whole volume"),
        ("bridges", f"{w.coordination:.3f} a grain", f"{len(w.bridges)}, of which {w.contacts:.3f} a grain touch"),
    ]
    if friction_angle is not None:
        rows.append(("cohesion", show(w.cohesion(friction_angle), "Pa", 4), "suction stress x tan φ"))
    if w.unheld > 0.0:
        rows.append(("unheld", show(w.unheld, "m^3", 4), "liquid that no bridge takes"))
    if limit > 0.0:
        rows.append(("pendular limit", show(limit, "Pa", 4), "suction below which bridges meet"))
    if w.is_pendular:
        rows.append(("pendular", "yes", "no two bridges meet"))
    else:
        told = (
            f"bridges meet on {_percent(meetings.grains)} of the grains, with {_percent(meetings.liquid)} of the liquid"
        )
        rows.append(("pendular", "no", f"{told}: all numbers are those of overlapping bridges"))
    error = w.table_error
    if error.bridges:
        rows.append(("error", f"{error.force:.1e}", f"of forces from a table; {error.volume:.1e} of volumes"))
    return rows


def _add_stress(table: Any, w: Wet) -> None:
    """Add rows of the stress and its shares."""
    shares = w.stress_shares
    parts = {"stress": w.stress, "  liquid": shares.liquid, "  menisci": shares.surface, "  grains": shares.contact}
    rounding = 1e-12 * float(np.abs(w.stress).max())
    for name, tensor in parts.items():
        for k in range(3):
            numbers = "  ".join(f"{value if abs(value) > rounding else 0.0:12.5g}" for value in tensor[k])
            table.add_row(name if k == 0 else "", numbers, "Pa" if k == 0 else "")


def state_json(w: Wet, limit: float, friction_angle: float | None) -> str:
    """One state, for machines; ``limit`` is the suction below which bridges meet."""
    shares = w.stress_shares
    answer: dict[str, Any] = {
        "suction": w.suction,
        "porosity": w.porosity,
        "grains": w.heap.count,
        "bridges": len(w.bridges),
    }
    answer |= {name: getattr(w, name) for name in _NAMES}
    answer |= {
        "stress": w.stress,
        "stress_shares": {"liquid": shares.liquid, "surface": shares.surface, "contact": shares.contact},
        "fabric": w.fabric,
        "meetings": w.meetings._asdict(),
        "book": w.book._asdict(),
        "pendular_limit": limit,
        "is_pendular": w.is_pendular,
    }
    if friction_angle is not None:
        answer["cohesion"] = w.cohesion(friction_angle)
    return json.dumps(_plain(answer), indent=2, allow_nan=False)


def state_csv(w: Wet) -> str:
    """Bridges, one a row."""
    b = w.bridges
    columns: dict[str, Any] = {
        "first": b.pairs[:, 0], "second": b.pairs[:, 1], "image_1": b.image[:, 0], "image_2": b.image[:, 1],
        "image_3": b.image[:, 2], "separation": b.separation, "force": b.force, "volume": b.volume,
        "suction": b.suction, "liquid_gas_area": b.liquid_gas_area, "half_filling_angle_1": b.half_filling_angle[:, 0],
        "half_filling_angle_2": b.half_filling_angle[:, 1],
    }  # fmt: skip
    return _csv(columns)


def curves_table(curves: Retention) -> RenderableType:
    """Some rows of the main curves, and the pendular limit, for people."""
    from rich.console import Group
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2))
    for name in (
        "suction",
        "S_r drying",
        "S_r wetting",
        "suction stress",
        "(wetting)",
        "χ",
        "(wetting)",
        "bridges meet",
    ):
        table.add_column(name, justify="right")
    drying, wetting = curves.walks[:2]
    for k in np.unique(np.linspace(0, len(curves.suction) - 1, _ROWS).astype(int)):
        table.add_row(
            show(float(curves.suction[k]), "Pa", 3),
            *(_percent(walk.values["saturation"][k]) for walk in (drying, wetting)),
            *(show(float(walk.values["suction_stress"][k]), "Pa", 4) for walk in (drying, wetting)),
            *(f"{walk.values['chi'][k]:.4g}" for walk in (drying, wetting)),
            _percent(drying.values["meeting_grains"][k]) if drying.values["meeting_grains"][k] else "",
        )
    return Group(f"porosity {curves.porosity:.4f}", *_limits(curves), "", table)


def _limits(curves: Retention) -> list[str]:
    lines = []
    for name, limit in curves.limits.items():
        if math.isfinite(limit):
            lines.append(f"pendular limit on {name}: bridges meet below {show(limit, 'Pa', 4)}")
    met = all(walk.values["meeting_grains"][-1] > 0 for walk in curves.walks[:2])
    return lines or [f"bridges meet {'at all' if met else 'at none of'} these suctions"]


def curves_json(curves: Retention) -> str:
    """All curves, for machines."""
    walks = {walk.name: {**walk.values, "stress": walk.stress} for walk in curves.walks}
    answer = {"suction": curves.suction, "porosity": curves.porosity, "pendular_limit": curves.limits, "paths": walks}
    return json.dumps(_plain(answer), indent=2, allow_nan=False)


def curves_csv(curves: Retention) -> str:
    """All curves, one row a path and suction."""
    rows = [(walk, k) for walk in curves.walks for k in np.flatnonzero(np.isfinite(walk.values["saturation"]))]
    columns: dict[str, Any] = {
        "path": [walk.name for walk, _ in rows],
        "suction": [float(curves.suction[k]) for _, k in rows],
    }
    columns |= {name: [float(walk.values[name][k]) for walk, k in rows] for name in QUANTITIES}
    for i, j in ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)):
        columns[f"stress_{i + 1}{j + 1}"] = [float(walk.stress[k, i, j]) for walk, k in rows]
    return _csv(columns)


def _csv(columns: dict[str, Any]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    listed = [values.tolist() if isinstance(values, np.ndarray) else values for values in columns.values()]
    writer.writerows(zip(*listed, strict=True))
    return text.getvalue()


def _percent(share: float) -> str:
    return f"{100.0 * share:.4g} %"


def _plain(value: Any) -> Any:
    """Value of plain Python, with null for what is not a number."""
    if isinstance(value, dict):
        return {name: _plain(item) for name, item in value.items()}
    if isinstance(value, (np.ndarray, list, tuple)):
        return [_plain(item) for item in (value.tolist() if isinstance(value, np.ndarray) else value)]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value
