"""The function of a law over rows: one by one in plain Python if they are few, by a compiled loop if they are many.

Compiling or loading one costs seconds, a plain answer microseconds. A function that nobody compiled is always asked
plainly.
"""

import hashlib
import math
from collections import defaultdict
from functools import cache
from importlib import import_module
from itertools import repeat
from time import perf_counter
from types import FunctionType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._jit import element, in_chunks, kernel
from ._record import Kernel

__all__ = ["evaluate"]

Array = NDArray[np.float64]
Operands = tuple[Array, ...]

_PATIENCE = 1.0  # [s] of plain answers by a function in a process, before it is compiled or loaded
_LEAST_COST = 1e-6  # [s] of a plain answer
_ARGUMENTS_OF_FORCE = 6
_CHUNK = 65536  # rows that one thread takes at a time
_HOUSE = __package__
_PLAIN = f"{_HOUSE.rpartition('.')[0]}._plain.laws"

_spent: defaultdict[Kernel, float] = defaultdict(float)  # [s]


def evaluate(function: Kernel, operands: Operands, out: Array) -> None:
    """Fill an array with a function of rows; an operand of one element counts for all."""
    if not hasattr(function, "py_func"):
        _fill(function, operands, out)
        return
    left = _PATIENCE - _spent[function]
    if out.size * _LEAST_COST < left:
        start = perf_counter()
        is_filled = _fill(_plain(function), operands, out, start + left)
        _spent[function] += perf_counter() - start
        if is_filled:
            return
    try:
        in_chunks(_loop_over(function), out.size, _CHUNK, operands, out)
    except (ArithmeticError, ValueError):  # of a kernel that was compiled with the rules of Python
        _fill(function, operands, out)


def _fill(function: Kernel, operands: Operands, out: Array, until: float = math.inf) -> bool:
    """Fill an array row by row, and tell whether there was time for all."""
    columns = (repeat(operand.item()) if operand.size == 1 else operand.tolist() for operand in operands)
    for i, *row in zip(range(out.size), *columns, strict=False):
        out[i] = _answer(function, row)
        if perf_counter() > until:
            return False
    return True


def _answer(function: Kernel, row: list[float]) -> float:
    """Answer for one row, NaN where Python's arithmetic has none."""
    try:
        answer = function(*row)
    except (ArithmeticError, ValueError):
        return math.nan
    return math.nan if isinstance(answer, complex) else answer


@cache
def _plain(function: Kernel) -> Kernel:
    """Return the source of a law of this folder as it is imported without the compiler; any other function itself."""
    home, _, module = (getattr(function, "__module__", None) or "").rpartition(".")
    if home != _HOUSE or not hasattr(function, "py_func"):
        return function
    plain: Kernel = getattr(import_module(f"{_PLAIN}.{module}"), function.__name__)
    return plain


def scalar(*row: float) -> float:
    """Stand in the loops below for the function of a law."""
    raise NotImplementedError


def _force_loop(x: Operands, out: Array, start: int, stop: int) -> None:
    for i in range(start, stop):
        out[i] = scalar(
            element(x[0], i), element(x[1], i), element(x[2], i), element(x[3], i), element(x[4], i), element(x[5], i)
        )


def _pair_loop(x: Operands, out: Array, start: int, stop: int) -> None:
    for i in range(start, stop):
        out[i] = scalar(element(x[0], i), element(x[1], i), element(x[2], i), element(x[3], i), element(x[4], i))


@cache
def _loop_over(function: Any) -> Kernel:
    """Compile the loop for a compiled function.

    The loop counts as code of the file of the law: machine code on disk is stamped by that file and what it imports,
    and a change of the loop itself changes its name.
    """
    source = function.py_func
    code = (_force_loop if source.__code__.co_argcount == _ARGUMENTS_OF_FORCE else _pair_loop).__code__
    digest = hashlib.sha256(code.co_code + repr((code.co_consts, code.co_names)).encode()).hexdigest()[:8]
    scope = {"__name__": source.__module__, "scalar": function, "element": element}
    loop = FunctionType(
        code.replace(co_filename=source.__code__.co_filename), scope, f"{source.__name__}_rows_{digest}"
    )
    compiled: Kernel = kernel(loop)
    return compiled
