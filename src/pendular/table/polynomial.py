"""The polynomial of a cell: eight coefficients, those of the powers of the last variable, lie side by side.

They are taken one after another here, as on a GPU. On the processor eight lanes of a vector hold them: `lanes`. The
order of the sums is the same in both, and in `codes/pendular_table.h`.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel, kernel_written_in

__all__ = [
    "CELL", "CONTROL_TERMS", "LANES", "LEAST_SIZE_TERMS", "RUPTURE_CELL", "RUPTURE_SIZE_TERMS", "SIZE_TERMS",
    "aligned", "in_three", "in_two", "rate_in_three",
]  # fmt: skip

Floats = NDArray[np.float64]

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


@kernel_written_in("pendular.table.lanes")
def in_two(coefficients: Floats, start: int, x: float, y: float) -> float:
    """Σ_k x^k Σ_j y^j c_jk, the highest power of y first, and the powers of x by halves."""
    x2 = x * x
    x4 = x2 * x2
    a = _pair_lane(coefficients, start, y) + x4 * _pair_lane(coefficients, start + 4, y)
    b = _pair_lane(coefficients, start + 1, y) + x4 * _pair_lane(coefficients, start + 5, y)
    c = _pair_lane(coefficients, start + 2, y) + x4 * _pair_lane(coefficients, start + 6, y)
    d = _pair_lane(coefficients, start + 3, y) + x4 * _pair_lane(coefficients, start + 7, y)
    return (a + x2 * c) + x * (b + x2 * d)


@kernel_written_in("pendular.table.lanes")
def in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
    """Σ_k t^k Σ_i x^i Σ_j y^j c_ijk with i + j < 6, the highest powers of x and y first, and those of t by halves."""
    t2 = t * t
    t4 = t2 * t2
    a = _lane(coefficients, start, x, y) + t4 * _lane(coefficients, start + 4, x, y)
    b = _lane(coefficients, start + 1, x, y) + t4 * _lane(coefficients, start + 5, x, y)
    c = _lane(coefficients, start + 2, x, y) + t4 * _lane(coefficients, start + 6, x, y)
    d = _lane(coefficients, start + 3, x, y) + t4 * _lane(coefficients, start + 7, x, y)
    return (a + t2 * c) + t * (b + t2 * d)


@kernel_written_in("pendular.table.lanes")
def rate_in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
    """Rate of `in_three` in t, by halves."""
    t2 = t * t
    t4 = t2 * t2
    a = _lane(coefficients, start + 1, x, y) + t4 * (5.0 * _lane(coefficients, start + 5, x, y))
    b = 2.0 * _lane(coefficients, start + 2, x, y) + t4 * (6.0 * _lane(coefficients, start + 6, x, y))
    c = 3.0 * _lane(coefficients, start + 3, x, y) + t4 * (7.0 * _lane(coefficients, start + 7, x, y))
    d = 4.0 * _lane(coefficients, start + 4, x, y)
    return (a + t2 * c) + t * (b + t2 * d)
