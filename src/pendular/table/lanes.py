"""The polynomial of a cell in the lanes of a vector, for Numba: it writes the instructions.

The compiler does not find them by itself: it may not reorder sums.
"""

from collections.abc import Callable, Iterable
from itertools import islice
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic, overload
from numpy.typing import NDArray

from ..ground.compile import compiled, rebound
from .polynomial import (
    HIGH_CELL,
    LANES,
    LOW_CELL,
    MOST_HIGH,
    RUPTURE_SIZE_TERMS,
    TERMS,
    Cells,
    in_three,
    in_two,
    rate_in_three,
)

Floats = NDArray[np.float64]


def _splat(builder: Any, value: Any, count: int) -> Any:
    kind = ir.VectorType(value.type, count)
    first = builder.insert_element(ir.Constant(kind, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    return _shuffle(builder, first, [0] * count)


def _shuffle(builder: Any, vector: Any, lanes: list[int]) -> Any:
    kind = ir.VectorType(ir.IntType(32), len(lanes))
    return builder.shuffle_vector(vector, vector, ir.Constant(kind, lanes))


def multiply_add(builder: Any, a: Any, b: Any, c: Any) -> Any:
    """Instruction a b + c, rounded once where the machine can."""
    kind = a.type
    is_vector = isinstance(kind, ir.VectorType)
    number = "f32" if (kind.element if is_vector else kind) == ir.FloatType() else "f64"
    suffix = f"v{kind.count}{number}" if is_vector else number
    function = cgutils.get_or_insert_function(  # type: ignore[no-untyped-call]
        builder.module, ir.FunctionType(kind, [kind, kind, kind]), f"llvm.fmuladd.{suffix}"
    )
    return builder.call(function, [a, b, c])


def _rows(context: Any, builder: Any, kind: Any, array: Any, cell: Any, count: int) -> list[Any]:
    """Coefficients of a cell as so many vectors, one lane for each power of the last variable."""
    data = context.make_array(kind)(context, builder, array).data
    vectors = builder.bitcast(data, ir.VectorType(data.type.pointee, LANES).as_pointer())
    first = builder.mul(cell, ir.Constant(ir.IntType(64), count))
    places = [builder.add(first, ir.Constant(ir.IntType(64), number)) for number in range(count)]
    return [builder.load(builder.gep(vectors, [place]), align=kind.dtype.bitwidth // 8) for place in places]


def _in_y(builder: Any, total: Any, rows: Iterable[Any], y: Any) -> Any:
    """Add Σ_j y^j c_jk in lane k, the highest power first, to what is there."""
    for row in rows:
        total = row if total is None else multiply_add(builder, total, y, row)
    return total


def _in_both(builder: Any, low: list[Any], high: list[Any], x: Any, y: Any) -> Any:
    """Σ_i x^i Σ_j y^j c_ijk in lane k, the highest powers first; what single precision holds is summed in it."""
    xs, ys = _splat(builder, x, LANES), _splat(builder, y, LANES)
    single_ys = _splat(builder, builder.fptrunc(y, ir.FloatType()), LANES)
    lows, highs, total = iter(low), iter(high), None
    for terms in TERMS:
        highest = _in_y(builder, None, islice(highs, min(terms, MOST_HIGH)), single_ys)
        of_y = _in_y(builder, builder.fpext(highest, ys.type), islice(lows, max(terms - MOST_HIGH, 0)), ys)
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


def _of_pair(typing_context: Any, coefficients: Any, cell: Any, x: Any, y: Any) -> Any:
    """The polynomial of a rupture distance: (coefficients, cell, x, y)."""
    signature = types.float64(coefficients, types.int64, types.float64, types.float64)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        array, cell, x, y = arguments
        rows = _rows(context, builder, signature.args[0], array, cell, RUPTURE_SIZE_TERMS)
        return _sum(builder, _in_y(builder, None, rows, _splat(builder, y, LANES)), x)

    return signature, generate


def _of_bridge(ending: Callable[..., Any]) -> Any:
    """The polynomial of a force: (low, high, cell, x, y, t)."""

    def polynomial(typing_context: Any, low: Any, high: Any, cell: Any, x: Any, y: Any, t: Any) -> Any:
        signature = types.float64(low, high, types.int64, types.float64, types.float64, types.float64)

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            low, high, cell, x, y, t = arguments
            low_rows = _rows(context, builder, signature.args[0], low, cell, LOW_CELL // LANES)
            high_rows = _rows(context, builder, signature.args[1], high, cell, HIGH_CELL // LANES)
            return ending(builder, _in_both(builder, low_rows, high_rows, x, y), t)

        return signature, generate

    return polynomial


_vector_in_two: Any = intrinsic(_of_pair)
_vector_in_three, _vector_rate = intrinsic(_of_bridge(_sum)), intrinsic(_of_bridge(_rate))


@overload(in_two)
def _in_two(coefficients: Floats, cell: int, x: float, y: float) -> Callable[..., float]:
    return rebound(in_two, compiled)


@overload(in_two, target="cpu")
def _in_two_on_cpu(coefficients: Floats, cell: int, x: float, y: float) -> Callable[..., float]:
    def in_two(coefficients: Floats, cell: int, x: float, y: float) -> float:
        return _vector_in_two(coefficients, cell, x, y)

    return in_two


@overload(in_three)
def _in_three_anywhere(cells: Cells, cell: int, x: float, y: float, t: float) -> Callable[..., float]:
    return rebound(in_three, compiled)


@overload(in_three, target="cpu")
def _in_three_on_cpu(cells: Cells, cell: int, x: float, y: float, t: float) -> Callable[..., float]:
    def in_three(cells: Cells, cell: int, x: float, y: float, t: float) -> float:
        return _vector_in_three(cells.low, cells.high, cell, x, y, t)

    return in_three


@overload(rate_in_three)
def _rate_in_three(cells: Cells, cell: int, x: float, y: float, t: float) -> Callable[..., float]:
    return rebound(rate_in_three, compiled)


@overload(rate_in_three, target="cpu")
def _rate_in_three_on_cpu(cells: Cells, cell: int, x: float, y: float, t: float) -> Callable[..., float]:
    def rate_in_three(cells: Cells, cell: int, x: float, y: float, t: float) -> float:
        return _vector_rate(cells.low, cells.high, cell, x, y, t)

    return rate_in_three
