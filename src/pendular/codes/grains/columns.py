"""Which columns of a table are the centres and the sizes of grains, by their names."""

import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .found import Found, in_order

__all__ = ["Columns", "choose", "grains", "size_of"]

# A name as it occurs, in lower case: of the axes the letter is put in the place of {}, or its number in that of {n}.
_CENTRE = (
    *("{}", "pos_{}", "position_{}", "pos{}", "{}_position", "points:{n}", "points_{n}", "coordinates:{n}"),
    *("position:{n}", "position_{n}", "center_{}", "centre_{}", "{}c", "centroid-{n}"),
)
_SIZES = {"r": 1.0, "radius": 1.0, "radii": 1.0, "rad": 1.0, "d": 0.5, "diameter": 0.5, "diam": 0.5, "diameters": 0.5}
_IDS = ("id", "particleid", "particle_id", "particle id", "grain")
_UNIT = re.compile(r"(.*?)\s*[\[(]\s*([^\])]+?)\s*[\])]")


class Columns(NamedTuple):
    """Places of the columns that are read, and what their numbers mean."""

    centre: tuple[int, int, int]
    size: int | None
    to_radius: float  # 0.5 where the size is a diameter
    ids: int | None
    unit: str | None

    @property
    def places(self) -> list[int]:
        """Of all columns that are read, in the order in which `grains` wants them."""
        return [*self.centre, *(place for place in (self.size, self.ids) if place is not None)]


def choose(names: Sequence[str]) -> Columns:
    """Columns of the centres, the radii or diameters, and the numbers of the grains.

    Parameters
    ----------
    names : sequence of str
        Of all columns, in the file's order; a unit may follow in brackets.

    Returns
    -------
    Columns

    Raises
    ------
    ValueError
        If there are no centres, or the units differ.

    Examples
    --------
    >>> choose(["id", "type", "x", "y", "z", "Diameter"])
    Columns(centre=(2, 3, 4), size=5, to_radius=0.5, ids=0, unit=None)
    >>> choose(["x [mm]", "y [mm]", "z [mm]", "r [mm]"]).unit
    'mm'
    """
    parts = [_UNIT.fullmatch(name.strip().strip('"')) for name in names]
    bare = [part[1] if part else name.strip().strip('"') for part, name in zip(parts, names, strict=True)]
    lower = [name.lower() for name in bare]
    centre = _centre(lower)
    if centre is None:
        raise ValueError(f"it has no columns x, y and z but {', '.join(map(repr, bare[:12]))}")
    size = size_of(bare)
    read = [*centre, *([] if size is None else [size[0]])]
    units = {part[2] if part else None for part in (parts[place] for place in read)}
    if len(units) > 1:
        raise ValueError(f"its columns are in several units: {', '.join(sorted(str(unit) for unit in units))}")
    place, factor = (None, 1.0) if size is None else size
    return Columns(centre, place, factor, next((lower.index(name) for name in _IDS if name in lower), None), *units)


def size_of(names: Sequence[str]) -> tuple[int, float] | None:
    """Place of the radius or diameter among names, and the factor that makes it a radius.

    Examples
    --------
    >>> size_of(["velocity", "Radius"]), size_of(["diameter"]), size_of(["mass"])
    ((1, 1.0), (0, 0.5), None)
    """
    lower = [name.lower() for name in names]
    return next(((lower.index(name), factor) for name, factor in _SIZES.items() if name in lower), None)


def grains(table: NDArray[np.float64], columns: Columns) -> Found:
    """Grains of the rows of a table that holds the chosen columns only."""
    radii = None if columns.size is None else table[:, 3] * columns.to_radius
    ids = None if columns.ids is None else table[:, -1]
    return Found(*in_order(ids, np.ascontiguousarray(table[:, :3]), radii), unit=columns.unit)


def _centre(lower: list[str]) -> tuple[int, int, int] | None:
    for pattern in _CENTRE:
        names = [pattern.format(axis, n=n) for n, axis in enumerate("xyz")]
        if all(name in lower for name in names):
            x, y, z = (lower.index(name) for name in names)
            return x, y, z
    return None
