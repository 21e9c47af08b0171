"""The function of a law over rows: in plain Python if they are few, by machine code if they are many.

A law of this package is a kernel. One from outside may be one too, or a function that its author compiled with Numba,
or plain Python, which is always asked row by row.
"""

import hashlib
from functools import cache, partial
from itertools import repeat
from types import FunctionType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import compiled, is_kernel, kernel
from ..ground.rows import element, entry, over_rows
from ._record import Kernel

__all__ = ["evaluate"]

Array = NDArray[np.float64]
Operands = tuple[Array, ...]

_COST = 5e-6  # of a plain answer, [s]
_MANY = 100_000  # rows for which a loop around a compiled function of someone else is compiled
_ARGUMENTS_OF_FORCE = 6
_CHUNK = 65536  # rows that one thread takes at a time


def evaluate(function: Kernel, operands: Operands, out: Array) -> None:
    """Fill an array with a function of rows; an operand of one element counts for all."""
    if is_kernel(function):
        over_rows(_loop_over(function), out.size, _CHUNK, operands, out, plainly=partial(_fill, function))
        return
    if hasattr(function, "py_func") and out.size > _MANY:
        try:
            compiled(_loop_around(function))(operands, out, 0, out.size)
        except (ArithmeticError, ValueError):  # it was compiled with the rules of Python
            _fill(function, operands, out)
        return
    _fill(function, operands, out)


def _fill(function: Kernel, operands: Operands, out: Array, *_range: int) -> None:
    """Fill an array row by row."""
    columns = (repeat(operand.item()) if operand.size == 1 else operand.tolist() for operand in operands)
    for i, *row in zip(range(out.size), *columns, strict=False):
        out[i] = answer_of(function, row)


def answer_of(function: Kernel, row: list[float]) -> float:
    """Answer for one row, NaN where Python's arithmetic has none."""
    try:
        answer = function(*row)
    except (ArithmeticError, ValueError):
        return float("nan")
    return float("nan") if isinstance(answer, complex) else answer


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
def _loop_over(function: Any) -> Any:
    """Make the loop for a kernel.

    It counts as code of the file of the law: machine code on disk is stamped by that file and what it imports, and a
    change of the loop itself changes its name.
    """
    return entry(plain_cost=_COST)(_loop(function, function))


@cache
def _loop_around(function: Any) -> Any:
    """Make the loop for a function that Numba has compiled."""
    return kernel(_loop(function, function.py_func))


def _loop(function: Any, source: Any) -> Any:
    code = (_force_loop if source.__code__.co_argcount == _ARGUMENTS_OF_FORCE else _pair_loop).__code__
    digest = hashlib.sha256(code.co_code + repr((code.co_consts, code.co_names)).encode()).hexdigest()[:8]
    scope = {"__name__": source.__module__, "scalar": function, "element": element}
    return FunctionType(
        code.replace(co_filename=source.__code__.co_filename), scope, f"{source.__name__}_rows_{digest}"
    )
