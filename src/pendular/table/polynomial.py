"""The polynomial of a cell: eight coefficients, those of the powers of the last variable, lie side by side.

They are taken one after another here. On the processor eight lanes of a vector hold them, and on a GPU eight threads:
`lanes`, `packed`. The order of the sums is the same in all, and in `codes/pendular_table.h`.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel, kernel_written_in

__all__ = [
    "CELL", "CONTROL_TERMS", "LANES", "LEAST_SIZE_TERMS", "RUPTURE_CELL", "RUPTURE_SIZE_TERMS", "SIZE_TERMS",
    "Lanes", "aligned", "by_halves", "in_three", "in_two", "rate_by_halves", "rate_in_three",
]  # fmt: skip

Floats = NDArray[np.float64]
Lanes = tuple[float, float, float, float, float, float, float, float]  # one for each power of the last variable

LANES = 8  # powers of the last variable: q for a force, the control for a rupture distance
CONTROL_TERMS, SIZE_TERMS = 5, 6  # powers of the control and of the size variable in a force: x^i y^j with i + j < 6
LEAST_SIZE_TERMS = SIZE_TERMS - CONTROL_TERMS + 1  # at the highest power of the control
RUPTURE_SIZE_TERMS = 8  # powers of the size variable in a rupture distance
CELL = sum(range(LEAST_SIZE_TERMS, SIZE_TERMS + 1)) * LANES  # coefficients of a force, or of what goes with it
RUPTURE_CELL = RUPTURE_SIZE_TERMS * LANES

_CACHE_LINE = 64  # [bytes]: eight coefficients


def aligned(array: NDArray[Any]) -> NDArray[Any]:
    """Copy an array to where eight coefficients lie in one line of the cache: half as many reads."""
    room = np.empty(array.nbytes + _CACHE_LINE, np.uint8)
    start = -room.ctypes.data % _CACHE_LINE
    copy = room[start : start + array.nbytes].view(array.dtype).reshape(array.shape)
    copy[...] = array
    return copy


@kernel
def _lane(coefficients: Floats, start: int, x: float, y: float) -> float:
    """Σ_i x^i Σ_j y^j c_ij with i + j < 6, the highest powers first."""
    total = 0.0
    row = 0
    for i in range(CONTROL_TERMS):
        of_y = 0.0
        for _ in range(LEAST_SIZE_TERMS + i):
            of_y = of_y * y + coefficients[start + row * LANES]
            row += 1
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
def _lanes(coefficients: Floats, start: int, x: float, y: float) -> Lanes:
    return (
        _lane(coefficients, start, x, y), _lane(coefficients, start + 1, x, y),
        _lane(coefficients, start + 2, x, y), _lane(coefficients, start + 3, x, y),
        _lane(coefficients, start + 4, x, y), _lane(coefficients, start + 5, x, y),
        _lane(coefficients, start + 6, x, y), _lane(coefficients, start + 7, x, y),
    )  # fmt: skip


@kernel_written_in("pendular.table.lanes")
def in_two(coefficients: Floats, start: int, x: float, y: float) -> float:
    """Σ_k x^k Σ_j y^j c_jk, the highest power of y first, and the powers of x by halves."""
    return by_halves(_pair_lanes(coefficients, start, y), x)


@kernel_written_in("pendular.table.lanes")
def in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
    """Σ_k t^k Σ_i x^i Σ_j y^j c_ijk with i + j < 6, the highest powers of x and y first, and those of t by halves."""
    return by_halves(_lanes(coefficients, start, x, y), t)


@kernel_written_in("pendular.table.lanes")
def rate_in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
    """Rate of `in_three` in t, by halves."""
    return rate_by_halves(_lanes(coefficients, start, x, y), t)
