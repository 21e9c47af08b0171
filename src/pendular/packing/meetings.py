"""Where bridges on one grain meet: there the pendular state ends."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import compiled, kernel
from ..ground.rows import entry, over_rows

__all__ = ["Meetings", "mark_meetings", "meetings_of"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_CHUNK = 16384
_ROUNDING = 1e-12  # of the cosine of an angle


class Meetings(NamedTuple):
    """Two bridges on one grain meet where their half-filling angles add up to the angle between them."""

    grains: float  # share of the grains on which bridges meet
    liquid: float  # share of the liquid in such bridges
    pairs: int  # of bridges that meet

    @property
    def any(self) -> bool:
        """Whether some meet, so that every other number is that of bridges which overlap."""
        return self.pairs > 0


def meetings_of(grains: int, pairs: NDArray[np.int32], normals: Floats, filling: Floats, volume: Floats) -> Meetings:
    """Meetings of the bridges of a heap.

    Parameters
    ----------
    grains : int
        Their number; bodies from there on are walls.
    pairs, normals, filling, volume : ndarray
        (n, 2), (n, 3) from the first to the second, (n, 2), (n,).

    Returns
    -------
    Meetings
    """
    if not len(pairs) or not grains:
        return Meetings(0.0, 0.0, 0)
    count, meets = mark_meetings(grains, pairs, normals, filling)
    share = float(np.sum(volume[meets]) / np.sum(volume))
    return Meetings(float(np.count_nonzero(count)) / grains, share, int(np.sum(count)))


def mark_meetings(
    grains: int, pairs: NDArray[np.int32], normals: Floats, filling: Floats
) -> tuple[Integers, NDArray[np.bool_]]:
    """Meetings on each grain, and whether a bridge is in one."""
    first, order = compiled(_ends_by_grain)(pairs, grains)
    count = np.zeros(grains, np.int64)
    meets = np.zeros(len(pairs), bool)
    over_rows(_meeting_range, grains, _CHUNK, first, order, normals, filling, count, meets)
    return count, meets


@kernel
def _ends_by_grain(pairs: NDArray[np.int32], grains: int) -> tuple[Integers, Integers]:
    """Ends of bridges on each grain, numbered 2 x bridge + side, and the number of ends before each grain."""
    first = np.zeros(grains + 1, np.int64)
    for bridge in range(pairs.shape[0]):
        for side in range(2):
            if pairs[bridge, side] < grains:
                first[pairs[bridge, side] + 1] += 1
    for grain in range(grains):
        first[grain + 1] += first[grain]
    place, order = first[:-1].copy(), np.empty(first[grains], np.int64)
    for bridge in range(pairs.shape[0]):
        for side in range(2):
            grain = pairs[bridge, side]
            if grain < grains:
                order[place[grain]] = 2 * bridge + side
                place[grain] += 1
    return first, order


@entry(plain_cost=5e-06)
def _meeting_range(
    first: Integers,
    order: Integers,
    normals: Floats,
    filling: Floats,
    count: Integers,
    meets: NDArray[np.bool_],
    start: int,
    stop: int,
) -> None:
    """Count the meetings on the grains from start to stop, and mark the bridges; threads mark with the same value."""
    for grain in range(start, stop):
        for x in range(first[grain], first[grain + 1]):
            a, side_a = order[x] // 2, order[x] % 2
            for y in range(x + 1, first[grain + 1]):
                b, side_b = order[y] // 2, order[y] % 2
                cosine = 0.0
                for k in range(3):
                    cosine += normals[a, k] * normals[b, k]
                if side_a != side_b:
                    cosine = -cosine
                together = filling[a, side_a] + filling[b, side_b]
                if together >= math.pi or math.cos(together) <= cosine + _ROUNDING:
                    count[grain] += 1
                    meets[a] = True
                    meets[b] = True
