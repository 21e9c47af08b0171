"""The polynomial of a cell: eight coefficients, those of the powers of the last variable, lie side by side.

On the processor eight lanes of a vector hold them; elsewhere, as on a GPU, a loop goes through them. The compiler does
not find the vector instructions by itself: it may not reorder sums.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload
from numpy.typing import NDArray

from .._jit import kernel

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


def in_two(coefficients: Floats, start: int, x: float, y: float) -> float:
    """Σ_k x^k Σ_j y^j c_jk, the highest power of y first."""
    total = 0.0
    for k in range(LANES - 1, -1, -1):
        of_y = 0.0
        for j in range(RUPTURE_SIZE_TERMS):
            of_y = of_y * y + coefficients[start + j * LANES + k]
        total = total * x + of_y
    return total


def in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
    """Σ_k t^k Σ_i x^i Σ_j y^j c_ijk with i + j < 6, the highest powers of x and y first."""
    total = 0.0
    for k in range(LANES - 1, -1, -1):
        total = total * t + _lane(coefficients, start + k, x, y)
    return total


def rate_in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
    """Rate of `in_three` in t."""
    rate = 0.0
    for k in range(LANES - 1, 0, -1):
        rate = rate * t + k * _lane(coefficients, start + k, x, y)
    return rate


def _splat(builder: Any, value: Any, count: int) -> Any:
    kind = ir.VectorType(ir.DoubleType(), count)
    first = builder.insert_element(ir.Constant(kind, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    return _shuffle(builder, first, [0] * count)


def _shuffle(builder: Any, vector: Any, lanes: list[int]) -> Any:
    kind = ir.VectorType(ir.IntType(32), len(lanes))
    return builder.shuffle_vector(vector, vector, ir.Constant(kind, lanes))


def _multiply_add(builder: Any, a: Any, b: Any, c: Any) -> Any:
    kind = a.type
    suffix = f"v{kind.count}f64" if isinstance(kind, ir.VectorType) else "f64"
    function = cgutils.get_or_insert_function(  # type: ignore[no-untyped-call]
        builder.module, ir.FunctionType(kind, [kind, kind, kind]), f"llvm.fmuladd.{suffix}"
    )
    return builder.call(function, [a, b, c])


def _lanes(builder: Any, rows: Any, x: Any, y: Any, terms: tuple[int, ...]) -> Any:
    """Σ_i x^i Σ_j y^j c_ijk in lane k, with so many terms in y for each power of x."""
    xs, ys = _splat(builder, x, LANES), _splat(builder, y, LANES)
    total, number = None, 0
    for terms_y in terms:
        of_y = None
        for _ in range(terms_y):
            row = builder.load(builder.gep(rows, [ir.Constant(ir.IntType(64), number)]), align=8)
            of_y = row if of_y is None else _multiply_add(builder, of_y, ys, row)
            number += 1
        total = of_y if total is None else _multiply_add(builder, total, xs, of_y)
    return total


def _sum(builder: Any, lanes: Any, t: Any) -> Any:
    """Σ_k t^k lane_k, by halves: the upper lanes times a power of t are added to the lower ones."""
    powers = [t]
    while 2 ** len(powers) < LANES:
        powers.append(builder.fmul(powers[-1], powers[-1]))
    for power in reversed(powers):
        half = lanes.type.count // 2
        low, high = (_shuffle(builder, lanes, list(range(start, start + half))) for start in (0, half))
        lanes = _multiply_add(builder, high, _splat(builder, power, half), low)
    return builder.extract_element(lanes, ir.Constant(ir.IntType(32), 0))


def _rate(builder: Any, lanes: Any, t: Any) -> Any:
    """Σ_k k t^(k-1) lane_k: lane k goes to k - 1, and lane 0 to the last, where it is multiplied by 0."""
    factors = ir.Constant(lanes.type, [float(k) for k in range(1, LANES)] + [0.0])
    return _sum(builder, builder.fmul(_shuffle(builder, lanes, [*range(1, LANES), 0]), factors), t)


def _vectorised(terms: tuple[int, ...], ending: Callable[..., Any]) -> Any:
    """A polynomial with fixed numbers of terms, written out: (coefficients, start, x, y, t)."""

    def polynomial(typing_context: Any, coefficients: Any, start: Any, x: Any, y: Any, t: Any) -> Any:
        signature = types.float64(coefficients, types.int64, types.float64, types.float64, types.float64)

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            coefficients, start, x, y, t = arguments
            data = context.make_array(signature.args[0])(context, builder, coefficients).data
            kind = ir.VectorType(ir.DoubleType(), LANES)
            rows = builder.bitcast(builder.gep(data, [start]), kind.as_pointer())
            return ending(builder, _lanes(builder, rows, x, y, terms), t)

        return signature, generate

    return intrinsic(polynomial)


_FORCE_TERMS = tuple(range(LEAST_SIZE_TERMS, SIZE_TERMS + 1))
_vector_in_two = _vectorised((RUPTURE_SIZE_TERMS,), _sum)
_vector_in_three = _vectorised(_FORCE_TERMS, _sum)
_vector_rate = _vectorised(_FORCE_TERMS, _rate)


@overload(in_two)
def _in_two(coefficients: Floats, start: int, x: float, y: float) -> Callable[..., float]:
    return in_two


@overload(in_two, target="cpu")
def _in_two_on_cpu(coefficients: Floats, start: int, x: float, y: float) -> Callable[..., float]:
    def in_two(coefficients: Floats, start: int, x: float, y: float) -> float:
        return _vector_in_two(coefficients, start, 0.0, y, x)

    return in_two


@overload(in_three)
def _in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> Callable[..., float]:
    return in_three


@overload(in_three, target="cpu")
def _in_three_on_cpu(coefficients: Floats, start: int, x: float, y: float, t: float) -> Callable[..., float]:
    def in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
        return _vector_in_three(coefficients, start, x, y, t)

    return in_three


@overload(rate_in_three)
def _rate_in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> Callable[..., float]:
    return rate_in_three


@overload(rate_in_three, target="cpu")
def _rate_in_three_on_cpu(coefficients: Floats, start: int, x: float, y: float, t: float) -> Callable[..., float]:
    def rate_in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
        return _vector_rate(coefficients, start, x, y, t)

    return rate_in_three
