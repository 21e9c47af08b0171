"""Calls into machine code of kernels, as compiled code of Numba makes them: a status comes back, arguments lie flat.

A number is laid out as it is, an array as its owner (none), size, address, shape and strides, a tuple as its members.
"""

import ctypes
from collections.abc import Callable, Iterator
from numbers import Integral
from typing import Any

import numpy as np

__all__ = ["Native", "caller", "types_of"]

Native = Callable[..., None]

_ANSWERS = (ctypes.c_void_p, ctypes.c_void_p)
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


def caller(address: int, name: str) -> Native:
    """Machine code at an address as a function, for arguments of the types of its first call."""
    typed: list[Callable[..., int]] = []
    nothing, error = ctypes.c_void_p(), ctypes.c_void_p()
    answers = (ctypes.byref(nothing), ctypes.byref(error))

    def call(*arguments: Any) -> None:
        if not typed:
            typed.append(ctypes.CFUNCTYPE(ctypes.c_int32, *_ANSWERS, *_layout(arguments))(address))
        if typed[0](*answers, *_flat(arguments)) != 0:
            raise RuntimeError(f"{name} failed")

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
