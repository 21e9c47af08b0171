"""The polynomial of a cell on a GPU: eight threads share a contact, each with one power of the last variable.

Coefficients are packed so that a thread reads those of two rows by one load of 16 bytes, and eight threads a line of
the cache. A warp holds 32 contacts, one a thread. The eight contacts of eight threads are taken one after another by
all of them, and the eight times eight values then change places, so that each thread adds up those of its own contact,
in the order of `polynomial`: the answer is that of one thread alone. Where the contacts of each eight threads lie in
one cell, as they mostly do if contacts are sorted by cells, its coefficients are read once.
"""

from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba.extending import intrinsic, overload
from numpy.typing import NDArray

from ..ground.device import cuda, types
from .kernels import Grid
from .lanes import multiply_add
from .polynomial import CELL, LANES, RUPTURE_CELL, RUPTURE_SIZE_TERMS, TERMS, coefficients_of

__all__ = ["Packed", "lanes_in_three", "lanes_in_two", "pack"]

Floats = NDArray[np.float64]

WHOLE_WARP = 0xFFFFFFFF
_RUPTURE_TERMS = (RUPTURE_SIZE_TERMS,)
_TWO = 2  # coefficients in a load
_HALVINGS = LANES.bit_length() - 1


class Packed(NamedTuple):
    """Coefficients of a table as a GPU reads them: of each cell, two rows of a lane lie side by side."""

    rupture: Floats
    force: Floats
    liquid: Floats


def pack(grid: Grid) -> Packed:
    """Coefficients of a table in that order."""
    force, liquid = (_packed(coefficients_of(cells), CELL) for cells in (grid.force, grid.liquid))
    return Packed(_packed(grid.rupture, RUPTURE_CELL), force, liquid)


def _packed(coefficients: Floats, cell: int) -> Floats:
    rows = coefficients.reshape(-1, cell // LANES // _TWO, _TWO, LANES)
    return np.ascontiguousarray(rows.swapaxes(2, 3)).reshape(-1)


def _rows_in(packed: Floats, start: int, count: int) -> tuple[float, ...]:
    return tuple(packed[start + row // _TWO * _TWO * LANES + row % _TWO] for row in range(count))


def force_rows(packed: Floats, start: int) -> tuple[float, ...]:
    """Coefficients of one lane of a force, which starts at a place."""
    return _rows_in(packed, start, sum(TERMS))


def rupture_rows(packed: Floats, start: int) -> tuple[float, ...]:
    """Coefficients of one lane of a rupture distance."""
    return _rows_in(packed, start, sum(_RUPTURE_TERMS))


def _lane_of(rows: tuple[float, ...], x: float, y: float, terms: tuple[int, ...]) -> float:
    total, row = 0.0, 0
    for terms_y in terms:
        of_y = 0.0
        for _ in range(terms_y):
            of_y = of_y * y + rows[row]
            row += 1
        total = total * x + of_y
    return total


def force_lane(rows: tuple[float, ...], x: float, y: float) -> float:
    """Σ_i x^i Σ_j y^j c_ij of one lane."""
    return _lane_of(rows, x, y, TERMS)


def rupture_lane(rows: tuple[float, ...], y: float) -> float:
    """Σ_j y^j c_j of one lane."""
    return _lane_of(rows, 0.0, y, _RUPTURE_TERMS)


def _read_by_pairs(count: int) -> Any:
    """So many rows of a lane, by loads of 16 bytes: (packed, start)."""

    def read(typing_context: Any, packed: Any, start: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            packed, start = arguments
            data = context.make_array(signature.args[0])(context, builder, packed).data
            kind = ir.VectorType(ir.DoubleType(), _TWO)
            pairs = builder.bitcast(builder.gep(data, [start]), kind.as_pointer())
            rows = []
            for number in range(count // _TWO):
                place = builder.gep(pairs, [ir.Constant(ir.IntType(64), number * LANES)])
                pair = builder.load(place, align=_TWO * 8)
                rows += [builder.extract_element(pair, ir.Constant(ir.IntType(32), k)) for k in range(_TWO)]
            return context.make_tuple(builder, signature.return_type, rows)

        return types.Tuple([types.float64] * count)(packed, types.int64), generate

    return intrinsic(read)


def _written_out(terms: tuple[int, ...]) -> Any:
    """A lane with fixed numbers of terms: (rows, x, y)."""

    def lane(typing_context: Any, rows: Any, x: Any, y: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            rows, x, y = arguments
            total, number = None, 0
            for terms_y in terms:
                of_y = None
                for _ in range(terms_y):
                    row = builder.extract_value(rows, number)
                    of_y = row if of_y is None else multiply_add(builder, of_y, y, row)
                    number += 1
                total = of_y if total is None else multiply_add(builder, total, x, of_y)
            return total

        return types.float64(rows, types.float64, types.float64), generate

    return intrinsic(lane)


_force_rows, _rupture_rows = _read_by_pairs(sum(TERMS)), _read_by_pairs(sum(_RUPTURE_TERMS))
_force_lane, _rupture_lane = _written_out(TERMS), _written_out(_RUPTURE_TERMS)


overload(force_rows)(lambda packed, start: lambda packed, start: _force_rows(packed, start))
overload(rupture_rows)(lambda packed, start: lambda packed, start: _rupture_rows(packed, start))
overload(force_lane)(lambda rows, x, y: lambda rows, x, y: _force_lane(rows, x, y))
overload(rupture_lane)(lambda rows, y: lambda rows, y: _rupture_lane(rows, 0.0, y))


@cuda.jit(device=True)
def _transpose(values: Any) -> None:
    """Value k of thread j becomes value j of thread k, of eight: halves change places, then quarters, then eighths."""
    distance = LANES
    for _ in range(_HALVINGS):
        distance //= 2
        is_upper = cuda.laneid & distance != 0
        for low in range(LANES):
            if low & distance == 0:
                high = low + distance
                sent = cuda.selp(is_upper, values[low], values[high])
                got = cuda.shfl_xor_sync(WHOLE_WARP, sent, distance)
                values[low] = cuda.selp(is_upper, got, values[low])
                values[high] = cuda.selp(is_upper, values[high], got)


@cuda.jit(device=True)
def _is_alike(cell: int) -> bool:
    """Whether the contacts of each eight threads of a warp lie in one cell."""
    first = cuda.shfl_sync(WHOLE_WARP, cell, cuda.laneid & ~(LANES - 1))
    return cuda.all_sync(WHOLE_WARP, cell == first)


@cuda.jit(device=True)
def lanes_in_three(packed: Floats, cell: int, x: float, y: float, lanes: Any) -> None:
    """Fill the polynomial of a contact in the last variable; all threads of a warp ask together."""
    eight, own = cuda.laneid & ~(LANES - 1), _TWO * (cuda.laneid & (LANES - 1))
    small = np.int32(cell)  # half the registers to hand on
    if _is_alike(small):
        rows = force_rows(packed, small * CELL + own)
        for contact in range(LANES):
            at_x = cuda.shfl_sync(WHOLE_WARP, x, eight + contact)
            lanes[contact] = force_lane(rows, at_x, cuda.shfl_sync(WHOLE_WARP, y, eight + contact))
    else:
        for contact in range(LANES):
            start = cuda.shfl_sync(WHOLE_WARP, small, eight + contact) * CELL + own
            at_x = cuda.shfl_sync(WHOLE_WARP, x, eight + contact)
            at_y = cuda.shfl_sync(WHOLE_WARP, y, eight + contact)
            lanes[contact] = force_lane(force_rows(packed, start), at_x, at_y)
    _transpose(lanes)


@cuda.jit(device=True)
def lanes_in_two(packed: Floats, cell: int, y: float, lanes: Any) -> None:
    """Fill the polynomial of the rupture distance of a contact; all threads of a warp ask together."""
    eight, own = cuda.laneid & ~(LANES - 1), _TWO * (cuda.laneid & (LANES - 1))
    small = np.int32(cell)
    if _is_alike(small):
        rows = rupture_rows(packed, small * RUPTURE_CELL + own)
        for contact in range(LANES):
            lanes[contact] = rupture_lane(rows, cuda.shfl_sync(WHOLE_WARP, y, eight + contact))
    else:
        for contact in range(LANES):
            start = cuda.shfl_sync(WHOLE_WARP, small, eight + contact) * RUPTURE_CELL + own
            at_y = cuda.shfl_sync(WHOLE_WARP, y, eight + contact)
            lanes[contact] = rupture_lane(rupture_rows(packed, start), at_y)
    _transpose(lanes)
