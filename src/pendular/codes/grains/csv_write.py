"""Grains and bridges as tables of text, with names and units."""

from pathlib import Path

import numpy as np

from ...ground.files import whole
from ...packing.heap import Packing
from .bridge_table import UNITS, Bridges, quantities

__all__ = ["bridges_beside", "write"]


def bridges_beside(path: Path) -> Path:
    """Where the table of bridges stands: ``heap_bridges.csv`` beside ``heap.csv``."""
    return path.with_name(f"{path.stem}_bridges{path.suffix}")


def write(path: Path, heap: Packing, bridges: Bridges | None) -> None:
    """Write one table of the grains and, if there are bridges, one of them beside it; every digit is kept.

    Parameters
    ----------
    path : Path
        Of the table of grains.
    heap : Packing
        The grains; a table does not hold the cell.
    bridges : record, optional
        As a wetted heap has them.
    """
    _table(path, "x [m],y [m],z [m],radius [m]", np.column_stack([heap.positions, heap.radii]), "%.17g")
    if bridges is None:
        return
    head = ["first", "second", "image_a", "image_b", "image_c", *(f"{name} [{unit}]" for name, unit in UNITS.items())]
    columns = np.column_stack([bridges.pairs, bridges.image, *quantities(bridges).values()])
    _table(bridges_beside(path), ",".join(head), columns, ["%d"] * 5 + ["%.17g"] * len(UNITS))


def _table(path: Path, head: str, rows: "np.ndarray", form: str | list[str]) -> None:
    with whole(path) as draft:
        np.savetxt(draft, rows, fmt=form, delimiter=",", header=head, comments="", encoding="utf-8")
