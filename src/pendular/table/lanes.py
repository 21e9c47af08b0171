"""The polynomial of a cell in the lanes of a vector, for Numba: it writes the instructions.

The compiler does not find them by itself: it may not reorder sums.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload
from numpy.typing import NDArray

from ..ground.compile import compiled, rebound
from .polynomial import LANES, LEAST_SIZE_TERMS, RUPTURE_SIZE_TERMS, SIZE_TERMS, in_three, in_two, rate_in_three

Floats = NDArray[np.float64]


def _splat(builder: Any, value: Any, count: int) -> Any:
    kind = ir.VectorType(ir.DoubleType(), count)
    first = builder.insert_element(ir.Constant(kind, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    return _shuffle(builder, first, [0] * count)


def _shuffle(builder: Any, vector: Any, lanes: list[int]) -> Any:
    kind = ir.VectorType(ir.IntType(32), len(lanes))
    return builder.shuffle_vector(vector, vector, ir.Constant(kind, lanes))


def multiply_add(builder: Any, a: Any, b: Any, c: Any) -> Any:
    """Instruction a b + c, rounded once where the machine can."""
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
            of_y = row if of_y is None else multiply_add(builder, of_y, ys, row)
            number += 1
        total = of_y if total is None else multiply_add(builder, total, xs, of_y)
    return total


def _sum(builder: Any, lanes: Any, t: Any) -> Any:
    """Σ_k t^k lane_k, by halves: the upper lanes times a power of t are added to the lower ones."""
    powers = [t]
    while 2 ** len(powers) < LANES:
        powers.append(builder.fmul(powers[-1], powers[-1]))
    for power in reversed(powers):
        half = lanes.type.count // 2
        low, high = (_shuffle(builder, lanes, list(range(start, start + half))) for start in (0, half))
        lanes = multiply_add(builder, high, _splat(builder, power, half), low)
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
    return rebound(in_two, compiled)


@overload(in_two, target="cpu")
def _in_two_on_cpu(coefficients: Floats, start: int, x: float, y: float) -> Callable[..., float]:
    def in_two(coefficients: Floats, start: int, x: float, y: float) -> float:
        return _vector_in_two(coefficients, start, 0.0, y, x)

    return in_two


@overload(in_three)
def _in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> Callable[..., float]:
    return rebound(in_three, compiled)


@overload(in_three, target="cpu")
def _in_three_on_cpu(coefficients: Floats, start: int, x: float, y: float, t: float) -> Callable[..., float]:
    def in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
        return _vector_in_three(coefficients, start, x, y, t)

    return in_three


@overload(rate_in_three)
def _rate_in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> Callable[..., float]:
    return rebound(rate_in_three, compiled)


@overload(rate_in_three, target="cpu")
def _rate_in_three_on_cpu(coefficients: Floats, start: int, x: float, y: float, t: float) -> Callable[..., float]:
    def rate_in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> float:
        return _vector_rate(coefficients, start, x, y, t)

    return rate_in_three
