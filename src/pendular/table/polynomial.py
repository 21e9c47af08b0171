"""The polynomial of a cell, in plain kernels and as vector instructions that take eight coefficients at a time.

Coefficients of eight powers of the last variable lie side by side. The plain form runs anywhere a kernel runs; the
vector form serves the loops over arrays, where the compiler does not find these instructions by itself: it may not
reorder sums. Both add in the same order up to the fused multiply-add.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numpy.typing import NDArray

from .._jit import kernel

Floats = NDArray[np.float64]

LANES = 8  # powers of the last variable: q for a force, the control for a rupture distance
CONTROL_TERMS, SIZE_TERMS = 5, 6  # powers of the control and of the size variable in a force
RUPTURE_SIZE_TERMS = 8  # powers of the size variable in a rupture distance
CELL = CONTROL_TERMS * SIZE_TERMS * LANES  # coefficients of a force, or of what goes with it
RUPTURE_CELL = RUPTURE_SIZE_TERMS * LANES


@kernel
def in_two(coefficients: Floats, start: int, x: float, y: float) -> float:
    """Σ_k x^k Σ_j y^j c_jk, the highest power of y first."""
    total = 0.0
    for k in range(LANES - 1, -1, -1):
        term = 0.0
        for j in range(RUPTURE_SIZE_TERMS):
            term = term * y + coefficients[start + j * LANES + k]
        total = total * x + term
    return total


@kernel
def in_three(coefficients: Floats, start: int, x: float, y: float, t: float) -> tuple[float, float]:
    """Σ_k t^k Σ_i x^i Σ_j y^j c_ijk, the highest powers of x and y first, and its rate in t."""
    total, rate = 0.0, 0.0
    for k in range(LANES - 1, -1, -1):
        of_x = 0.0
        for i in range(CONTROL_TERMS):
            of_y = 0.0
            for j in range(SIZE_TERMS):
                of_y = of_y * y + coefficients[start + (i * SIZE_TERMS + j) * LANES + k]
            of_x = of_x * x + of_y
        rate = rate * t + total
        total = total * t + of_x
    return total, rate


def _splat(builder: Any, value: Any, count: int) -> Any:
    kind = ir.VectorType(ir.DoubleType(), count)
    first = builder.insert_element(ir.Constant(kind, ir.Undefined), value, ir.Constant(ir.IntType(32), 0))
    return builder.shuffle_vector(first, first, ir.Constant(ir.VectorType(ir.IntType(32), count), [0] * count))


def _multiply_add(builder: Any, a: Any, b: Any, c: Any) -> Any:
    kind = a.type
    suffix = f"v{kind.count}f64" if isinstance(kind, ir.VectorType) else "f64"
    function = cgutils.get_or_insert_function(  # type: ignore[no-untyped-call]
        builder.module, ir.FunctionType(kind, [kind, kind, kind]), f"llvm.fmuladd.{suffix}"
    )
    return builder.call(function, [a, b, c])


def _of_lanes(builder: Any, lanes: Any, x: Any) -> Any:
    """Σ_k x^k lane_k, by halves: the upper lanes times a power of x are added to the lower ones."""
    powers = [x]
    while 2 ** len(powers) < LANES:
        powers.append(builder.fmul(powers[-1], powers[-1]))
    for power in reversed(powers):
        half = lanes.type.count // 2
        kind = ir.VectorType(ir.IntType(32), half)
        low, high = (
            builder.shuffle_vector(lanes, lanes, ir.Constant(kind, list(range(start, start + half))))
            for start in (0, half)
        )
        lanes = _multiply_add(builder, high, _splat(builder, power, half), low)
    return builder.extract_element(lanes, ir.Constant(ir.IntType(32), 0))


def _vectorised(terms_x: int, terms_y: int) -> Callable[..., Any]:
    """Σ_k t^k Σ_i x^i Σ_j y^j c_ijk for fixed numbers of terms, written out."""

    def polynomial(typing_context: Any, coefficients: Any, start: Any, x: Any, y: Any, t: Any) -> Any:
        signature = types.float64(coefficients, types.int64, types.float64, types.float64, types.float64)

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            coefficients, start, x, y, t = arguments
            data = context.make_array(signature.args[0])(context, builder, coefficients).data
            kind = ir.VectorType(ir.DoubleType(), LANES)
            rows = builder.bitcast(builder.gep(data, [start]), kind.as_pointer())
            xs, ys = _splat(builder, x, LANES), _splat(builder, y, LANES)
            total = None
            for i in range(terms_x):
                of_y = None
                for j in range(terms_y):
                    place = builder.gep(rows, [ir.Constant(ir.IntType(64), i * terms_y + j)])
                    row = builder.load(place, align=8)
                    of_y = row if of_y is None else _multiply_add(builder, of_y, ys, row)
                total = of_y if total is None else _multiply_add(builder, total, xs, of_y)
            return _of_lanes(builder, total, t)

        return signature, generate

    return intrinsic(polynomial)


vector_in_two = _vectorised(1, RUPTURE_SIZE_TERMS)  # (coefficients, start, anything, y, x)
vector_in_three = _vectorised(CONTROL_TERMS, SIZE_TERMS)  # (coefficients, start, x, y, t)
