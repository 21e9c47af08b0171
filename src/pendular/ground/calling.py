"""Calls into machine code of kernels, as compiled code of Numba makes them: a status comes back, arguments lie flat.

A number is laid out as it is, an array as its owner (none), size, address, shape and strides, a tuple as its members.
"""

import ctypes
from collections.abc import Callable, Iterator
from numbers import Integral
from typing import Any

import numpy as np

__all__ = ["Native", "types_of"]

_ANSWERS = (ctypes.c_void_p, ctypes.c_void_p)
_ROWS = (ctypes.c_int64, ctypes.c_int64)  # start and stop
_NAMES = (bool, int, float)  # of numbers: those of NumPy are as these
_NUMBERS = {bool: ctypes.c_int8, float: ctypes.c_double, Integral: ctypes.c_int64}


def types_of(arguments: Any) -> str:
    """Spell the types of arguments: what decides on the machine code."""
    if isinstance(arguments, np.ndarray):
        layout = "C" if arguments.flags.c_contiguous else "A"
        return f"{arguments.dtype.str}{arguments.ndim}{layout}{'' if arguments.flags.writeable else 'r'}"
    if isinstance(arguments, tuple):
        return f"{type(arguments).__name__}({','.join(map(types_of, arguments))})"
    return next((name.__name__ for name in _NAMES if isinstance(arguments, name)), type(arguments).__name__)


class Native:
    """Machine code of an entry at an address as a function, for arguments of the types of its first call."""

    def __init__(self, address: int, name: str) -> None:
        self._address, self._name = address, name
        self._typed: Callable[..., int] | None = None

    def __call__(self, *arguments: Any) -> None:
        """Answer rows: the last two arguments are start and stop."""
        self.of_rows(arguments[:-2])(*arguments[-2:])

    def of_rows(self, arguments: tuple[Any, ...]) -> Callable[[int, int], None]:
        """It as a function of start and stop alone: the other arguments are laid out once for many calls."""
        code = self._typed
        if code is None:
            kinds = (*_ANSWERS, *_layout(arguments), *_ROWS)
            code = self._typed = ctypes.CFUNCTYPE(ctypes.c_int32, *kinds)(self._address)
        nothing, error = ctypes.c_void_p(), ctypes.c_void_p()
        flat = (ctypes.byref(nothing), ctypes.byref(error), *_flat(arguments))

        def call(start: int, stop: int, _kept_alive: tuple[Any, ...] = arguments) -> None:
            if code(*flat, start, stop) != 0:
                raise RuntimeError(f"{self._name} failed")

        return call


def _flat(arguments: tuple[Any, ...]) -> list[Any]:
    """Arguments as they are laid out: what owns an array is nobody, as code that returns nothing keeps none."""
    flat: list[Any] = []
    for argument in arguments:
        if isinstance(argument, np.ndarray):
            address = argument.__array_interface__["data"][0]
            flat += None, None, argument.size, argument.itemsize, address, *argument.shape, *argument.strides
        elif isinstance(argument, tuple):
            flat += _flat(argument)
        else:
            flat.append(float(argument) if isinstance(argument, float) else int(argument))
    return flat


def _layout(arguments: tuple[Any, ...]) -> Iterator[Any]:
    """Types of what `_flat` gives."""
    for argument in arguments:
        if isinstance(argument, np.ndarray):
            yield from (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p)
            yield from (ctypes.c_int64,) * (2 * argument.ndim)
        elif isinstance(argument, tuple):
            yield from _layout(argument)
        else:
            kind = next(kind for kind in _NUMBERS if isinstance(argument, kind))
            yield _NUMBERS[kind]
