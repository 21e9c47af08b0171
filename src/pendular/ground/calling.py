"""Calls into machine code of entries: how Python lays arguments out, and the function that takes them up again.

A word of eight bytes stands for a number, or for an array, whose interface it points to: NumPy tells there in C where
an array lies. A tuple is its members. The words lie in a row, which one pointer tells, as each argument of a call
through ctypes takes a quarter of a microsecond.
"""

import ctypes
import struct
from collections.abc import Callable
from operator import index
from typing import Any

import numpy as np

from .wrapping import array_of, call_of

__all__ = ["Native", "types_of", "write_caller"]

_FUNCTION = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_char_p, ctypes.c_int64, ctypes.c_int64)
_NAMES = (bool, int, float)  # of numbers: those of NumPy are as these
_SHAPE, _STRIDES, _DATA = 5, 6, 7  # places in `PyArrayInterface`
_types: dict[tuple[Any, ...], str] = {}  # spelled, of arguments as they were before

_prototype = ctypes.PYFUNCTYPE(ctypes.c_void_p, ctypes.py_object, ctypes.c_char_p)
_address_in = _prototype(("PyCapsule_GetPointer", ctypes.pythonapi))  # that of `pythonapi` has the types of anyone


def types_of(arguments: tuple[Any, ...]) -> str:
    """Spell the types of arguments: what decides on the machine code."""
    kinds: list[Any] = []
    _note_kinds(arguments, kinds)
    key = tuple(kinds)
    if key not in _types:
        _types[key] = _spelled(arguments)
    return _types[key]


def _note_kinds(arguments: tuple[Any, ...], kinds: list[Any]) -> None:
    """Note what their types are spelled from, and more: that takes a tenth of the time."""
    for argument in arguments:
        kinds.append(type(argument))
        if isinstance(argument, np.ndarray):
            kinds += (argument.dtype, argument.ndim, argument.flags.num)
        elif isinstance(argument, tuple):
            _note_kinds(argument, kinds)
    kinds.append(None)


def _spelled(arguments: Any) -> str:
    if isinstance(arguments, np.ndarray):
        layout = "C" if arguments.flags.c_contiguous else "F" if arguments.flags.f_contiguous else "A"
        return f"{arguments.dtype.str}{arguments.ndim}{layout}{'' if arguments.flags.writeable else 'r'}"
    if isinstance(arguments, tuple):
        return f"{type(arguments).__name__}({','.join(map(_spelled, arguments))})"
    return next((name.__name__ for name in _NAMES if isinstance(arguments, name)), type(arguments).__name__)


class Native:
    """Machine code of an entry at an address as a function, for arguments of the types that it was made for."""

    def __init__(self, address: int, name: str) -> None:
        self._code, self._name = _FUNCTION(address), name

    def __call__(self, *arguments: Any) -> None:
        """Answer rows: the last two arguments are start and stop."""
        self.of_rows(arguments[:-2])(*arguments[-2:])

    def of_rows(self, arguments: tuple[Any, ...]) -> Callable[[int, int], None]:
        """It as a function of start and stop alone: the other arguments are laid out once for many calls."""
        form: list[str] = []
        words: list[Any] = []
        interfaces: list[Any] = []
        _lay_out(arguments, form, words, interfaces)
        laid_out = struct.pack("".join(form), *words)

        def call(start: int, stop: int, _kept_alive: Any = (arguments, interfaces)) -> None:
            if self._code(laid_out, start, stop) != 0:
                raise RuntimeError(f"{self._name} failed")

        return call


def _lay_out(arguments: tuple[Any, ...], form: list[str], words: list[Any], interfaces: list[Any]) -> None:
    """Append the words of arguments, and the interfaces that they point to."""
    for argument in arguments:
        if isinstance(argument, np.ndarray):
            interface = argument.__array_struct__
            interfaces.append(interface)
            form.append("q")
            words.append(_address_in(interface, None))
        elif isinstance(argument, tuple):
            _lay_out(argument, form, words, interfaces)
        elif isinstance(argument, float):
            form.append("d")
            words.append(argument)
        else:
            form.append("q")
            words.append(index(argument))


def write_caller(context: Any, module: Any, symbol: str, kernel: Any) -> None:
    """Write the function of LLVM that `Native` calls: it takes up what is laid out, and tells the kernel's status."""
    from llvmlite import ir

    word = ir.IntType(64)
    outer = ir.Function(module, ir.FunctionType(ir.IntType(32), [word.as_pointer(), word, word]), symbol)
    builder = ir.IRBuilder(outer.append_basic_block())
    laid_out, start, stop = outer.args
    places = iter(range(1 << 16))

    def next_word() -> Any:
        return builder.load(builder.gep(laid_out, [ir.Constant(word, next(places))]))

    values = [_taken_up(context, builder, kind, next_word) for kind in kernel.argtypes[:-2]]
    ended, _ = call_of(context, builder, kernel, [*values, start, stop])
    builder.ret(ended.code)


def _taken_up(context: Any, builder: Any, kind: Any, next_word: Callable[[], Any]) -> Any:
    """A value of a type, from the words to come."""
    from llvmlite import ir
    from numba import types

    if isinstance(kind, types.Array):
        return _array_at(context, builder, kind, next_word())
    if isinstance(kind, types.Float):
        return builder.bitcast(next_word(), ir.DoubleType())
    if isinstance(kind, types.Integer | types.Boolean):
        return builder.trunc(next_word(), context.get_value_type(kind))
    return context.make_tuple(builder, kind, [_taken_up(context, builder, part, next_word) for part in kind])


def _array_at(context: Any, builder: Any, kind: Any, interface: Any) -> Any:
    """The array whose interface lies at an address."""
    from llvmlite import ir

    byte, int_, many = ir.IntType(8), ir.IntType(32), ir.IntType(64).as_pointer()
    told = ir.LiteralStructType([int_, int_, byte, int_, int_, many, many, byte.as_pointer()])  # `PyArrayInterface`
    found = builder.load(builder.inttoptr(interface, told.as_pointer()))
    extents = [
        [builder.load(builder.gep(builder.extract_value(found, place), [int_(axis)])) for axis in range(kind.ndim)]
        for place in (_SHAPE, _STRIDES)
    ]
    return array_of(context, builder, kind, builder.extract_value(found, _DATA), *extents)
