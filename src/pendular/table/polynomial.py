"""The polynomial of a cell: eight coefficients, those of the powers of the last variable, lie side by side.

They are taken one after another here. On the processor eight lanes of a vector hold them, and on a GPU eight threads:
`lanes`, `packed`. The order of the sums is the same in all, and in `codes/pendular_table.h`.

Of a force the terms x^i y^j with i + j ≥ 3 are so small that single precision holds their coefficients: a cell takes 13
lines of the cache in place of 20. The lanes of a vector sum these terms in it too, which changes a force by less than a
thousandth of the bound of its error.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel, kernel_written_in

__all__ = [
    "CELL", "CONTROL_TERMS", "HIGH_CELL", "LANES", "LOW_CELL", "MOST_HIGH", "POWERS", "RUPTURE_CELL",
    "RUPTURE_SIZE_TERMS", "SIZE_TERMS", "TERMS", "Cells", "Lanes", "aligned", "by_halves", "cell_count", "cells_from",
    "coefficients_of", "in_three", "in_two", "rate_by_halves", "rate_in_three",
]  # fmt: skip

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Lanes = tuple[float, float, float, float, float, float, float, float]  # one for each power of the last variable

LANES = 8  # powers of the last variable: q for a force, the control for a rupture distance
CONTROL_TERMS, SIZE_TERMS = 5, 6  # powers of the control and of the size variable in a force: x^i y^j with i + j < 6
LEAST_SIZE_TERMS = SIZE_TERMS - CONTROL_TERMS + 1  # at the highest power of the control
RUPTURE_SIZE_TERMS = 8  # powers of the size variable in a rupture distance
POWERS = tuple((i, j) for i in range(CONTROL_TERMS) for j in range(SIZE_TERMS) if i + j < SIZE_TERMS)[::-1]
CELL = len(POWERS) * LANES  # coefficients of a force, or of what goes with it
RUPTURE_CELL = RUPTURE_SIZE_TERMS * LANES

TERMS = tuple(range(LEAST_SIZE_TERMS, SIZE_TERMS + 1))  # of each power of x, the highest first
MOST_HIGH = 3  # of those terms, the first: i + j ≥ 3, which single precision holds
_ARE_HIGH = np.array([place < MOST_HIGH for terms in TERMS for place in range(terms)])
HIGH_CELL = int(_ARE_HIGH.sum()) * LANES
LOW_CELL = CELL - HIGH_CELL

_CACHE_LINE = 64  # [bytes]: eight coefficients


def aligned(array: NDArray[Any]) -> NDArray[Any]:
    """Copy an array to where eight coefficients lie in one line of the cache: half as many reads."""
    room = np.empty(array.nbytes + _CACHE_LINE, np.uint8)
    start = -room.ctypes.data % _CACHE_LINE
    copy = room[start : start + array.nbytes].view(array.dtype).reshape(array.shape)
    copy[...] = array
    return copy


class Cells(NamedTuple):
    """Coefficients of a force, or of what goes with it: those of a cell lie together, in the order of the powers."""

    low: Floats
    high: Singles


def cells_from(coefficients: Floats) -> Cells:
    """Cells from all coefficients, cell by cell."""
    rows = coefficients.reshape(-1, len(POWERS), LANES)
    low, high = rows[:, ~_ARE_HIGH], rows[:, _ARE_HIGH].astype(np.float32)
    return Cells(aligned(low.reshape(-1)), aligned(high.reshape(-1)))


def coefficients_of(cells: Cells) -> Floats:
    """All coefficients, cell by cell."""
    rows = np.empty((cell_count(cells), len(POWERS), LANES))
    rows[:, ~_ARE_HIGH] = cells.low.reshape(len(rows), -1, LANES)
    rows[:, _ARE_HIGH] = cells.high.reshape(len(rows), -1, LANES)
    return rows.reshape(-1)


def cell_count(cells: Cells) -> int:
    """Number of cells."""
    return int(cells.low.size) // LOW_CELL


@kernel
def _lane(cells: Cells, cell: int, lane: int, x: float, y: float) -> float:
    """Σ_i x^i Σ_j y^j c_ij with i + j < 6, the highest powers first."""
    total, low, high = 0.0, cell * LOW_CELL + lane, cell * HIGH_CELL + lane
    for i in range(CONTROL_TERMS):
        of_y = 0.0
        for place in range(LEAST_SIZE_TERMS + i):
            if place < MOST_HIGH:
                of_y = of_y * y + np.float64(cells.high[high])
                high += LANES
            else:
                of_y = of_y * y + cells.low[low]
                low += LANES
        total = total * x + of_y
    return total


@kernel
def _pair_lane(coefficients: Floats, start: int, y: float) -> float:
    """Σ_j y^j c_j, the highest power first."""
    total = 0.0
    for j in range(RUPTURE_SIZE_TERMS):
        total = total * y + coefficients[start + j * LANES]
    return total


@kernel
def by_halves(lanes: Lanes, t: float) -> float:
    """Σ_k t^k lane_k: the upper half times a power of t is added to the lower one, three times."""
    t2 = t * t
    t4 = t2 * t2
    a, b = lanes[0] + t4 * lanes[4], lanes[1] + t4 * lanes[5]
    c, d = lanes[2] + t4 * lanes[6], lanes[3] + t4 * lanes[7]
    return (a + t2 * c) + t * (b + t2 * d)


@kernel
def rate_by_halves(lanes: Lanes, t: float) -> float:
    """Rate of `by_halves` in t."""
    t2 = t * t
    t4 = t2 * t2
    a, b = lanes[1] + t4 * (5.0 * lanes[5]), 2.0 * lanes[2] + t4 * (6.0 * lanes[6])
    c, d = 3.0 * lanes[3] + t4 * (7.0 * lanes[7]), 4.0 * lanes[4]
    return (a + t2 * c) + t * (b + t2 * d)


@kernel
def _pair_lanes(coefficients: Floats, start: int, y: float) -> Lanes:
    return (
        _pair_lane(coefficients, start, y), _pair_lane(coefficients, start + 1, y),
        _pair_lane(coefficients, start + 2, y), _pair_lane(coefficients, start + 3, y),
        _pair_lane(coefficients, start + 4, y), _pair_lane(coefficients, start + 5, y),
        _pair_lane(coefficients, start + 6, y), _pair_lane(coefficients, start + 7, y),
    )  # fmt: skip


@kernel
def _lanes(cells: Cells, cell: int, x: float, y: float) -> Lanes:
    return (
        _lane(cells, cell, 0, x, y), _lane(cells, cell, 1, x, y), _lane(cells, cell, 2, x, y),
        _lane(cells, cell, 3, x, y), _lane(cells, cell, 4, x, y), _lane(cells, cell, 5, x, y),
        _lane(cells, cell, 6, x, y), _lane(cells, cell, 7, x, y),
    )  # fmt: skip


@kernel_written_in("pendular.table.lanes")
def in_two(coefficients: Floats, cell: int, x: float, y: float) -> float:
    """Σ_k x^k Σ_j y^j c_jk, the highest power of y first, and the powers of x by halves."""
    return by_halves(_pair_lanes(coefficients, cell * RUPTURE_CELL, y), x)


@kernel_written_in("pendular.table.lanes")
def in_three(cells: Cells, cell: int, x: float, y: float, t: float) -> float:
    """Σ_k t^k Σ_i x^i Σ_j y^j c_ijk with i + j < 6, the highest powers of x and y first, and those of t by halves."""
    return by_halves(_lanes(cells, cell, x, y), t)


@kernel_written_in("pendular.table.lanes")
def rate_in_three(cells: Cells, cell: int, x: float, y: float, t: float) -> float:
    """Rate of `in_three` in t, by halves."""
    return rate_by_halves(_lanes(cells, cell, x, y), t)
