"""Lattices of equal grains, whose heaps have closed answers."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import in_range, one_of, scalar, whole_number
from .heap import Packing

__all__ = ["lattice_packing"]

Floats = NDArray[np.float64]


class _Lattice(NamedTuple):
    """A cell in distances of nearest centres, and where in it centres are, in fractions."""

    cell: tuple[float, float, float]
    centres: list[tuple[float, float, float]]


_CORNER, _MIDDLE = (0.0, 0.0, 0.0), (0.5, 0.5, 0.5)
_FACES = [(0.0, 0.5, 0.5), (0.5, 0.0, 0.5), (0.5, 0.5, 0.0)]
_LATTICES = {
    "simple_cubic": _Lattice((1.0, 1.0, 1.0), [_CORNER]),
    "body_centred_cubic": _Lattice((2.0 / 3.0**0.5,) * 3, [_CORNER, _MIDDLE]),
    "face_centred_cubic": _Lattice((2.0**0.5,) * 3, [_CORNER, *_FACES]),
    "hexagonal": _Lattice(
        (1.0, 3.0**0.5, (8.0 / 3.0) ** 0.5),
        [_CORNER, (0.5, 0.5, 0.0), (0.5, 1.0 / 6.0, 0.5), (0.0, 2.0 / 3.0, 0.5)],
    ),
}


def lattice_packing(kind: str, cells: ArrayLike, radius: float, *, gap: float = 0.0) -> Packing:
    """Packing of equal grains on a lattice, periodic in all directions.

    Parameters
    ----------
    kind : str
        ``"simple_cubic"``, ``"body_centred_cubic"``, ``"face_centred_cubic"`` or ``"hexagonal"`` (close-packed), of 1,
        2, 4 and 4 grains a cell.
    cells : int or three of them
        Cells along each direction.
    radius : float
        [m].
    gap : float
        Between nearest grains, [m]; more than minus the radius.

    Returns
    -------
    Packing
        Touching grains meet to rounding. Solid fractions without a gap: π/6, π√3/8, π/(3√2), π/(3√2).

    Raises
    ------
    ValueError
        For another kind, fewer than one cell, or a length out of range.

    Examples
    --------
    >>> heap = lattice_packing("face_centred_cubic", 3, 50e-6)
    >>> heap.count, round(heap.count * 4 / 3 * np.pi * 50e-6**3 / heap.volume, 6)
    (108, 0.74048)
    """
    one_of("kind", kind, tuple(_LATTICES))
    counts = _counts(cells)
    size = float(in_range("radius", scalar("radius", radius, "m"), 0.0, brackets="()", unit="m"))
    spacing = 2.0 * size + float(in_range("gap", scalar("gap", gap, "m"), -size, brackets="(]", unit="m"))
    lattice = _LATTICES[kind]
    cell = spacing * np.array(lattice.cell)
    places = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), axis=-1).reshape(-1, 1, 3)
    positions = ((places + np.array(lattice.centres)) * cell).reshape(-1, 3)
    return Packing(positions, np.full(len(positions), size), counts * cell)


def _counts(cells: ArrayLike) -> NDArray[np.int64]:
    given = np.atleast_1d(np.asarray(cells, dtype=object))
    if given.shape not in ((1,), (3,)):
        raise ValueError(f"cells: {cells!r} is not one or three whole numbers")
    return np.broadcast_to([whole_number("cells", value, 1) for value in given], 3)
