"""What is written of bridges: their ends in space, and one column for each quantity."""

from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ...packing.heap import Packing

__all__ = ["UNITS", "Bridges", "Ends", "ends_of", "quantities"]

Floats = NDArray[np.float64]

UNITS = {"separation": "m", "force": "N", "volume": "m3", "suction": "Pa"}


class Bridges(Protocol):
    """Bridges of a heap, one row each, as a wetted heap has them."""

    @property
    def pairs(self) -> NDArray[np.integer]:
        """Grains, (n, 2); a number from the grains on is a wall."""

    @property
    def image(self) -> NDArray[np.integer]:
        """Cells between the second and its nearest image, (n, 3)."""


class Ends(NamedTuple):
    """Lines between centres: those that leave the cell or meet a wall end at points of their own."""

    points: Floats  # (ends, 3), after those of the grains, [m]
    lines: NDArray[np.int64]  # (n, 2), numbers of points


def ends_of(heap: Packing, bridges: Bridges) -> Ends:
    """Points and lines that draw the bridges.

    Parameters
    ----------
    heap : Packing
        The grains.
    bridges : record
        With ``pairs`` and ``image``.

    Returns
    -------
    Ends
    """
    pairs, image = np.asarray(bridges.pairs, np.int64), np.asarray(bridges.image, np.int64)
    at_wall = pairs[:, 1] >= heap.count
    apart = at_wall | np.any(image != 0, axis=1)
    start = heap.positions[pairs[:, 0]]
    end = heap.positions[np.where(at_wall, 0, pairs[:, 1])]
    if heap.cell is not None:
        end = end + image @ heap.cell
    for k, wall in enumerate(heap.walls):
        here = pairs[:, 1] == heap.count + k
        end[here] = start[here] - ((start[here] - wall.point) @ wall.normal)[:, None] * wall.normal
    lines = pairs.copy()
    lines[apart, 1] = heap.count + np.arange(np.count_nonzero(apart))
    return Ends(end[apart], lines)


def quantities(bridges: Bridges) -> dict[str, Floats]:
    """Separation, force, volume and suction, one value a bridge, in SI units."""
    count = len(bridges.pairs)
    return {name: np.broadcast_to(np.asarray(getattr(bridges, name), float), count) for name in UNITS}
