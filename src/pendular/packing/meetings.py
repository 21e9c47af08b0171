"""Where bridges on one grain or one wall meet: there the pendular state ends."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import compiled, kernel
from ..ground.rows import entry, over_rows
from .heap import Packing
from .neighbours import Neighbours, find_neighbours
from .shape import FILLING_1, FILLING_2, WETTED_2

__all__ = ["Marks", "Meetings", "mark_meetings", "meetings_of"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Bools = NDArray[np.bool_]

_CHUNK = 16384
_ROUNDING = 1e-12  # of the cosine of an angle


class Meetings(NamedTuple):
    """Two bridges meet on a grain where their half-filling angles add up to the angle between them.

    On a wall they meet where their contact circles do; it counts for both grains.
    """

    grains: float  # share of the grains on which bridges meet, or whose bridge meets another on a wall
    liquid: float  # share of the liquid in such bridges
    pairs: int  # of bridges that meet

    @property
    def any(self) -> bool:
        """Whether some meet, so that every other number is that of bridges which overlap."""
        return self.pairs > 0


class Marks(NamedTuple):
    """Where bridges meet."""

    grains: Bools
    bridges: Bools
    pairs: int


def meetings_of(heap: Packing, bridges: Neighbours, normals: Floats, shape: Floats, volume: Floats) -> Meetings:
    """Meetings of the bridges of a heap.

    Parameters
    ----------
    heap : Packing
        The grains.
    bridges : Neighbours
        Pairs that hold one.
    normals, shape, volume : ndarray
        (n, 3) from the first to the second, (n, 7) columns of `shape`, (n,).

    Returns
    -------
    Meetings
    """
    if not len(bridges.pairs):
        return Meetings(0.0, 0.0, 0)
    marks = mark_meetings(heap, bridges, normals, shape)
    share = float(np.sum(volume[marks.bridges]) / np.sum(volume))
    return Meetings(float(np.count_nonzero(marks.grains)) / heap.count, share, marks.pairs)


def mark_meetings(heap: Packing, bridges: Neighbours, normals: Floats, shape: Floats) -> Marks:
    """Which grains and bridges are in a meeting; arguments as for :func:`meetings_of`."""
    pairs = bridges.pairs
    first, order = compiled(_ends_by_grain)(pairs, heap.count)
    count = np.zeros(heap.count, np.int64)
    meets = np.zeros(len(pairs), bool)
    filling = shape[:, FILLING_1 : FILLING_2 + 1]
    over_rows(_meeting_range, heap.count, _CHUNK, first, order, normals, filling, count, meets)
    grains, number = count > 0, int(np.sum(count))
    for wall in range(heap.count, heap.count + len(heap.walls)):
        there = np.flatnonzero(pairs[:, 1] == wall)
        if len(there) == 0:
            continue
        overlaps = _overlaps_on_wall(heap, wall - heap.count, pairs[there, 0], shape[there, WETTED_2])
        meets[there[overlaps]] = True
        grains[pairs[there[overlaps], 0]] = True
        number += len(overlaps)
    return Marks(grains, meets, number)


def _overlaps_on_wall(heap: Packing, number: int, grains: NDArray[np.int32], area: Floats) -> Integers:
    """Pairs of contact circles on a wall that overlap, (n, 2): as spheres about the same centres would."""
    wall, centres = heap.walls[number], heap.positions[grains]
    feet = centres - ((centres - wall.point) @ wall.normal)[:, None] * wall.normal
    circles = Packing(feet, np.sqrt(area / math.pi), heap.cell, heap.periodic)
    if heap.cell is not None:  # large circles may meet images of themselves
        width = 1.0 / np.linalg.norm(np.linalg.inv(heap.cell), axis=0)
        times = np.where(heap.periodic, np.ceil(4.0 * circles.radii.max() / width), 1.0)
        circles = circles.repeated(tuple(times.astype(int).tolist()))
    found = find_neighbours(circles, lambda first, second: 0.0 * first).pairs
    found = np.sort(found.astype(np.int64) % len(grains), axis=1)
    return np.unique(found, axis=0)


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
                if 1.0 - 0.5 * together * together > cosine + _ROUNDING:  # less than its cosine, and sooner found
                    continue
                if together >= math.pi or math.cos(together) <= cosine + _ROUNDING:
                    count[grain] += 1
                    meets[a] = True
                    meets[b] = True
