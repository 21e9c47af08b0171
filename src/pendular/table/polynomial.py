"""The polynomial of a cell: eight coefficients, those of the powers of the last variable, lie side by side.

A loop goes through them here, as on a GPU. On the processor eight lanes of a vector hold them: `lanes`.
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


@kernel_written_in("pendular.table.lanes")
def in_two(coefficients: Floats, start: int, x: float, y: float) -> float:
    """Σ_k x^k Σ_j y^j c_jk, the highest power of y first."""
    total = 0.0
    for k in range(LANES - 1, -1, -1):
        of_y = 0.0
        for j in range(RUPTURE_SIZE_TERMS):
            of_y = of_y * y + coefficients[start + j * LANES + k]
        total = total * x + of_y
    return total


@kernel_written_in("pendular.table.lanes")
def in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
    """Σ_k t^k Σ_i x^i Σ_j y^j c_ijk with i + j < 6, the highest powers of x and y first."""
    total = 0.0
    for k in range(LANES - 1, -1, -1):
        total = total * t + _lane(coefficients, start + k, x, y)
    return total


@kernel_written_in("pendular.table.lanes")
def rate_in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
    """Rate of `in_three` in t."""
    rate = 0.0
    for k in range(LANES - 1, 0, -1):
        rate = rate * t + k * _lane(coefficients, start + k, x, y)
    return rate
