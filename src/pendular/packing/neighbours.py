"""Pairs of grains that are near enough for a bridge, with the periodic image: a list of cells for each class of sizes.

Grains are sorted into classes within a factor of two in radius, each with a grid of its own. A grain looks for partners
of its own class and of the larger ones, so that a few large grains do not make small ones search far.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import Own, entry, over_rows
from .heap import Packing

__all__ = [
    "Neighbours",
    "Reach",
    "ReachTable",
    "Sizes",
    "arms_of",
    "find_neighbours",
    "reach_table",
    "sizes_of",
    "within",
]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Reach = Callable[[Floats, Floats], Floats]  # largest gap of a bridge between spheres of these radii; inf is a wall

_CLASS = 2.0  # largest over smallest radius of a class
_CHUNK = 16384  # grains that one thread takes at a time
_BINS_A_GRAIN = 4


class Neighbours(NamedTuple):
    """Pairs whose gap is within the reach of a bridge, in the order of their indices."""

    pairs: NDArray[np.int32]  # (n, 2), ascending; grains + k stands for wall k
    image: NDArray[np.int32]  # (n, 3), cells between the second and its nearest image
    gap: Floats  # (n,), negative in an overlap, [m]

    def taken(self, chosen: NDArray[np.bool_] | Integers) -> "Neighbours":
        """Some of the pairs."""
        rows = np.flatnonzero(chosen) if chosen.dtype == np.bool_ else chosen
        if len(rows) == len(self.gap) and chosen.dtype == np.bool_:
            return self
        return Neighbours(self.pairs[rows], self.image[rows], self.gap[rows])


class Sizes(NamedTuple):
    """Classes of radii."""

    of_grain: Integers  # class of each grain, 0 for the smallest
    least: Floats  # smallest and largest radius in each
    most: Floats


class ReachTable(NamedTuple):
    """Largest gaps of bridges, between classes of sizes and at walls."""

    sizes: Sizes
    gaps: Floats  # (classes, classes), [m]
    at_wall: float  # 0 without walls

    @property
    def most(self) -> float:
        """The largest of all."""
        return max(float(self.gaps.max()), self.at_wall)

    def covers(self, other: "ReachTable") -> bool:
        """Whether no gap of another one is larger."""
        return bool(np.all(self.gaps >= other.gaps)) and self.at_wall >= other.at_wall


class Frame(NamedTuple):
    """Where grains lie in fractions of the cell."""

    positions: Floats  # inside the cell along periodic directions
    fractions: Floats
    wraps: Integers  # cells by which a position was moved
    cell: Floats
    width: Floats  # of the cell, across its faces
    periodic: NDArray[np.bool_]


class Bins(NamedTuple):
    """Grains of a class, bin by bin."""

    first: Integers  # number of grains before each bin
    grains: Integers
    positions: Floats  # of these grains, side by side as the search needs them
    radii: Floats
    shape: Integers  # bins along each direction


def sizes_of(radii: Floats) -> Sizes:
    """Classes of radii, each within a factor of two; those without a grain are left out."""
    low, high = float(radii.min()), float(radii.max())
    count = max(1, math.ceil(math.log(high / low) / math.log(_CLASS) - 1e-9))
    if count == 1:
        return Sizes(np.zeros(len(radii), np.int64), np.array([low]), np.array([high]))
    place = np.minimum((np.log(radii / low) / math.log(high / low) * count).astype(np.int64), count - 1)
    present, of_grain = np.unique(place, return_inverse=True)
    ends = [(radii[of_grain == k].min(), radii[of_grain == k].max()) for k in range(len(present))]
    least, most = np.array(ends).T
    return Sizes(of_grain.astype(np.int64), least, most)


def reach_table(heap: Packing, reach: Reach) -> ReachTable:
    """Reach of bridges in a heap.

    Parameters
    ----------
    heap : Packing
        The grains.
    reach : callable
        Largest gap of a bridge, [m], at arrays of two radii, [m]; it does not fall with either.

    Returns
    -------
    ReachTable
    """
    sizes = sizes_of(heap.radii)
    gaps = np.asarray(reach(*np.meshgrid(sizes.most, sizes.most, indexing="ij")))
    at_wall = float(np.max(reach(sizes.most, np.full(len(sizes.most), np.inf)))) if heap.walls else 0.0
    return ReachTable(sizes, gaps, at_wall)


def find_neighbours(heap: Packing, reach: Reach) -> Neighbours:
    """All pairs within the reach of their classes; arguments as for :func:`reach_table`, the rest of :func:`within`."""
    return within(heap, reach_table(heap, reach))


def within(heap: Packing, reach: ReachTable) -> Neighbours:
    """All pairs within the reach of their classes.

    Parameters
    ----------
    heap : Packing
        The grains.
    reach : ReachTable
        Largest gaps.

    Returns
    -------
    Neighbours

    Raises
    ------
    ValueError
        Where the cell is smaller than twice the reach, so that two images of a grain could be partners of one.
    """
    sizes, gaps = reach.sizes, reach.gaps
    distances = sizes.most[:, None] + sizes.most + gaps
    frame = _frame_of(heap)
    _refuse_small_cell(frame, float(distances.max()))
    members = [np.flatnonzero(sizes.of_grain == k) for k in range(len(sizes.most))]
    found = []
    for b, large in enumerate(members):
        bins = _bins_of(frame, heap.radii, large, float(distances[: b + 1, b].max()))
        for a in range(b + 1):
            own = bins.grains if a == b else members[a]
            found.append(_pairs_of(frame, heap.radii, own, bins, a == b, float(gaps[a, b])))
    found.extend(_at_wall(heap, k, reach.at_wall) for k in range(len(heap.walls)))
    pairs, image, gap = found[0] if len(found) == 1 else (np.concatenate(parts) for parts in zip(*found, strict=True))
    order = np.argsort(pairs[:, 0].astype(np.int64) * (heap.count + len(heap.walls)) + pairs[:, 1])
    return Neighbours(pairs[order], image[order], gap[order])


def arms_of(heap: Packing, neighbours: Neighbours) -> tuple[Floats, Floats]:
    """Unit vectors from the first centre to the second, or to the nearest point of the wall, (n, 3), and distances."""
    normals, lengths = np.empty((len(neighbours.gap), 3)), np.empty(len(neighbours.gap))
    walls = np.array([[*wall.point, *wall.normal] for wall in heap.walls]).reshape(-1, 6)
    over_rows(
        _arm_range, len(lengths), _CHUNK,
        heap.positions, heap.box, walls, neighbours.pairs, neighbours.image, normals, lengths,
    )  # fmt: skip
    return normals, lengths


@entry(plain_cost=2e-06)
def _arm_range(
    positions: Floats,
    cell: Floats,
    walls: Floats,
    pairs: NDArray[np.int32],
    image: NDArray[np.int32],
    normals: Floats,
    lengths: Floats,
    start: int,
    stop: int,
) -> None:
    """Directions and distances from start to stop."""
    for row in range(start, stop):
        i, j = pairs[row, 0], pairs[row, 1]
        if j < positions.shape[0]:
            for k in range(3):
                shift = 0.0
                for m in range(3):
                    shift += image[row, m] * cell[m, k]
                normals[row, k] = positions[j, k] - positions[i, k] + shift
        else:
            wall = walls[j - positions.shape[0]]
            height = 0.0
            for k in range(3):
                height += (positions[i, k] - wall[k]) * wall[3 + k]
            for k in range(3):
                normals[row, k] = -height * wall[3 + k]
        length = math.sqrt(normals[row, 0] ** 2 + normals[row, 1] ** 2 + normals[row, 2] ** 2)
        lengths[row] = length
        for k in range(3):
            normals[row, k] /= length


def _frame_of(heap: Packing) -> Frame:
    """Positions inside the cell and their fractions of it, from 0 to 1 along open directions, too."""
    cell = heap.box
    inverse = np.linalg.inv(cell)
    fractions = heap.positions @ inverse
    wraps = np.where(heap.periodic, np.floor(fractions), 0.0)
    low = np.where(heap.periodic, 0.0, fractions.min(axis=0))
    span = np.where(heap.periodic, 1.0, np.maximum(fractions.max(axis=0) - low, 1e-300))
    width = span / np.linalg.norm(inverse, axis=0)
    positions = heap.positions - wraps @ cell
    return Frame(
        np.ascontiguousarray(positions),
        (fractions - wraps - low) / span,
        wraps.astype(np.int64),
        cell,
        width,
        heap.periodic,
    )


def _refuse_small_cell(frame: Frame, distance: float) -> None:
    for k in np.flatnonzero(frame.periodic):
        if frame.width[k] < 2.0 * distance:
            raise ValueError(
                f"cell: its width of {frame.width[k]:.6g} m along direction {k} is less than twice the reach of a "
                f"bridge between centres, {2.0 * distance:.6g} m; put several side by side with Packing.repeated"
            )


def _bins_of(frame: Frame, radii: Floats, members: Integers, distance: float) -> Bins:
    """Grains of a class in bins at least as wide as the distance."""
    shape = np.maximum(np.floor(np.minimum(frame.width / distance, 1e6)), 1.0)
    excess = np.prod(shape) / (_BINS_A_GRAIN * len(members) + 64.0)
    if excess > 1.0:
        shape = np.maximum(np.floor(shape / np.cbrt(excess)), 1.0)
        while np.prod(shape) > 8.0 * (_BINS_A_GRAIN * len(members) + 64.0):  # a heap that is flat or a chain
            shape = np.maximum(np.floor(shape / 2.0), 1.0)
    counts = shape.astype(np.int64)
    place = np.minimum((frame.fractions[members] * counts).astype(np.int64), counts - 1)
    number = (place[:, 0] * counts[1] + place[:, 1]) * counts[2] + place[:, 2]
    first = np.zeros(int(np.prod(counts)) + 1, np.int64)
    np.cumsum(np.bincount(number, minlength=len(first) - 1), out=first[1:])
    grains = members[np.argsort(number, kind="stable")]
    return Bins(first, grains, frame.positions[grains], radii[grains], counts)


def _pairs_of(
    frame: Frame, radii: Floats, own: Integers, bins: Bins, is_same: bool, gap: float
) -> tuple[NDArray[np.int32], NDArray[np.int32], Floats]:
    """Pairs of grains with those in the bins."""
    counts = np.zeros(len(own) + 1, np.int64)
    room = Own(lambda: np.empty(3, np.int64)), Own(lambda: np.empty(3))
    none = np.empty((0, 2), np.int32), np.empty((0, 3), np.int32), np.empty(0)
    over_rows(_search_range, len(own), _CHUNK, frame, radii, own, bins, is_same, gap, counts, False, *none, *room)
    first = np.concatenate([[0], np.cumsum(counts[:-1])])
    total = int(first[-1])
    found = np.empty((total, 2), np.int32), np.empty((total, 3), np.int32), np.empty(total)
    over_rows(_search_range, len(own), _CHUNK, frame, radii, own, bins, is_same, gap, first, True, *found, *room)
    return found


@kernel
def _wrapped(place: int, count: int, is_periodic: bool) -> tuple[int, int]:
    """Bin and image of a place next to the bins; an open direction has none beyond: image 2."""
    if 0 <= place < count:
        return place, 0
    if not is_periodic:
        return 0, 2
    return (place + count, -1) if place < 0 else (place - count, 1)


@entry(plain_cost=0.0001)
def _search_range(
    frame: Frame,
    radii: Floats,
    own: Integers,
    bins: Bins,
    is_same: bool,
    most: float,
    counts: Integers,
    is_filling: bool,
    pairs: NDArray[np.int32],
    image: NDArray[np.int32],
    gaps: Floats,
    home: Integers,
    moved: Floats,
    start: int,
    stop: int,
) -> None:
    """Count the partners of the grains from start to stop, or write them down from the number in ``counts`` on.

    ``home`` and ``moved`` have room for a bin and a place.
    """
    shape, cell = bins.shape, frame.cell
    for row in range(start, stop):
        i = own[row]
        number = counts[row]
        for k in range(3):
            home[k] = min(np.int64(frame.fractions[i, k] * shape[k]), shape[k] - 1)
        for turn in range(27):
            x, image_x = _wrapped(home[0] + turn // 9 - 1, shape[0], frame.periodic[0])
            y, image_y = _wrapped(home[1] + turn // 3 % 3 - 1, shape[1], frame.periodic[1])
            z, image_z = _wrapped(home[2] + turn % 3 - 1, shape[2], frame.periodic[2])
            if image_x == 2 or image_y == 2 or image_z == 2:
                continue
            bin_of = (x * shape[1] + y) * shape[2] + z
            for k in range(3):
                shift = image_x * cell[0, k] + image_y * cell[1, k] + image_z * cell[2, k]
                moved[k] = shift - frame.positions[i, k]
            for place in range(bins.first[bin_of], bins.first[bin_of + 1]):
                squared = 0.0
                for k in range(3):
                    squared += (bins.positions[place, k] + moved[k]) ** 2
                allowed = radii[i] + bins.radii[place] + most
                if squared > allowed * allowed:
                    continue
                j = bins.grains[place]
                if is_same and j <= i:
                    continue
                if is_filling:
                    sign = 1 if i < j else -1
                    pairs[number, 0], pairs[number, 1] = min(i, j), max(i, j)
                    image[number, 0] = sign * (image_x - frame.wraps[j, 0] + frame.wraps[i, 0])
                    image[number, 1] = sign * (image_y - frame.wraps[j, 1] + frame.wraps[i, 1])
                    image[number, 2] = sign * (image_z - frame.wraps[j, 2] + frame.wraps[i, 2])
                    gaps[number] = math.sqrt(squared) - (radii[i] + bins.radii[place])
                number += 1
        if not is_filling:
            counts[row] = number


def _at_wall(heap: Packing, k: int, most: float) -> tuple[NDArray[np.int32], NDArray[np.int32], Floats]:
    """Grains near a wall."""
    wall = heap.walls[k]
    gap = (heap.positions - wall.point) @ wall.normal - heap.radii
    near = np.flatnonzero(gap <= most)
    pairs = np.column_stack([near, np.full(len(near), heap.count + k)]).astype(np.int32)
    return pairs, np.zeros((len(near), 3), np.int32), gap[near]
