"""Kernels as functions of C: one object file for the linker of any program, that needs neither Python nor Numba.

Each kernel is compiled as in `native`. Around it goes a function with a name and arguments of C, which lays out arrays
as the kernel wants them; all else is hidden in the file. A kernel raises nothing, so that no error has to be told.
"""

import hashlib
import math
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from . import native
from .objects import context_of_files, unlinked
from .stamp import source_stamp
from .wrapping import array_of, call_of

__all__ = [
    "Array",
    "Constant",
    "Count",
    "Function",
    "Integer",
    "Real",
    "Room",
    "kept_or_made",
    "linkable",
    "llvm_text",
    "processor",
]


class Constant(NamedTuple):
    """An integer that a kernel is given, and C is not asked for."""

    value: int


class Integer(NamedTuple):
    """``int`` in C."""


class Real(NamedTuple):
    """``double`` in C."""


class Count(NamedTuple):
    """``size_t`` in C: the rows of the arrays that follow, which tell the kernel how many there are."""


class Array(NamedTuple):
    """A pointer to the first number in C; one row where no count is given."""

    columns: int = 0  # of an array of two axes
    kind: str = "float64"  # or int32, which is int


class Room(NamedTuple):
    """So many numbers on the stack for a kernel to work on; C is not asked for them."""

    size: int


Argument = Constant | Integer | Real | Count | Array | Room


class Function(NamedTuple):
    """A function of C: a kernel that returns a status or a number, and where its arguments come from in their order."""

    name: str
    kernel: Callable[..., int | float]
    arguments: Sequence[Argument]
    returns: Integer | Real = Integer()


def linkable(functions: Sequence[Function], failed: int) -> bytes:
    """Object file with functions of C for this processor; a kernel that broke off, against all reason, has failed."""
    return kept_or_made(functions, failed, "", lambda: _compiled(functions, failed))


def kept_or_made(functions: Sequence[Function], failed: int, target: str, compile: Callable[[], bytes]) -> bytes:
    """What was made of functions for a target, made if it is not there."""
    kernel = functions[0].kernel
    types = f"{target} {failed} {[(f.name, f.kernel.__name__, *f.arguments, f.returns) for f in functions]}"
    types += f" {_source_of(functions)}"
    return native.kept(kernel, types) or native.made(kernel, types, compile)


def _source_of(functions: Sequence[Function]) -> str:
    """Hash of all source that the kernels can take anything from."""
    files = sorted({function.kernel.__code__.co_filename for function in functions})
    return hashlib.sha256(" ".join(source_stamp(Path(file)) for file in files).encode()).hexdigest()


def processor() -> str:
    """The processor and the system that such a file is for."""
    import llvmlite.binding as llvm

    return f"{llvm.get_host_cpu_name()}, {llvm.get_process_triple()}"


def llvm_text(functions: Sequence[Function], failed: int) -> str:
    """The same as text for LLVM, not optimised yet, for any other processor."""
    return str(_library_of(functions, failed).text())


def _compiled(functions: Sequence[Function], failed: int) -> bytes:
    from numba.core.compiler_lock import global_compiler_lock

    with global_compiler_lock:
        code: bytes = _library_of(functions, failed).emit_native_object()
    return code


def _library_of(functions: Sequence[Function], failed: int) -> Any:
    from numba.core.compiler_lock import global_compiler_lock

    context = context_of_files()
    library = context.codegen().create_library("functions of C")
    module = context.create_module("functions of C")
    with global_compiler_lock:
        for function in functions:
            dispatcher = unlinked(function.kernel)
            signature = tuple(_type_of(argument) for argument in function.arguments if not isinstance(argument, Count))
            dispatcher.compile(signature)
            result = dispatcher.overloads[signature]
            library.add_linking_library(result.library)
            _write(context, module, function, result.fndesc, failed)
        library.add_ir_module(module)
        library.finalize()
        library.hide_all_but([function.name for function in functions])
    return library


def _type_of(argument: Argument) -> Any:
    """Type of Numba that the kernel is given."""
    from numba import types

    if isinstance(argument, Room):
        return types.Array(types.float64, 1, "C")
    if isinstance(argument, Array):
        return types.Array(getattr(types, argument.kind), 2 if argument.columns else 1, "C")
    return types.float64 if isinstance(argument, Real) else types.int64


def _write(context: Any, module: Any, function: Function, inner: Any, failed: int) -> None:
    """Write the function of C that calls a kernel; a number is NaN where the kernel broke off."""
    from llvmlite import ir

    returned = _c_type_of(function.returns)
    asked = [_c_type_of(argument) for argument in function.arguments if not isinstance(argument, Constant | Room)]
    outer = ir.Function(module, ir.FunctionType(returned, asked), function.name)
    builder = ir.IRBuilder(outer.append_basic_block())
    given, count, values = iter(outer.args), ir.Constant(ir.IntType(64), 1), []
    for argument in function.arguments:
        if isinstance(argument, Count):
            count = next(given)
        else:
            values.append(_value_of(context, builder, argument, given, count))
    ended, answer = call_of(context, builder, inner, values)
    if isinstance(function.returns, Integer):
        answer = builder.trunc(answer, returned)
    otherwise = failed if isinstance(function.returns, Integer) else math.nan
    builder.ret(builder.select(ended.is_error, ir.Constant(returned, otherwise), answer))


def _c_type_of(argument: Argument) -> Any:
    from llvmlite import ir

    if isinstance(argument, Array):
        return (ir.DoubleType() if argument.kind == "float64" else ir.IntType(32)).as_pointer()
    if isinstance(argument, Real):
        return ir.DoubleType()
    return ir.IntType(64 if isinstance(argument, Count) else 32)


def _value_of(context: Any, builder: Any, argument: Argument, given: Iterator[Any], count: Any) -> Any:
    """What the kernel is given for what C gives next."""
    from llvmlite import ir

    whole = ir.IntType(64)
    if isinstance(argument, Constant):
        return ir.Constant(whole, argument.value)
    if isinstance(argument, Integer):
        return builder.sext(next(given), whole)
    if isinstance(argument, Room):
        rows, place = ir.Constant(whole, argument.size), builder.alloca(ir.DoubleType(), argument.size)
        return _array(context, builder, argument, place, [rows], 8)
    if not isinstance(argument, Array):
        return next(given)
    shape = [count, ir.Constant(whole, argument.columns)] if argument.columns else [count]
    return _array(context, builder, argument, next(given), shape, 8 if argument.kind == "float64" else 4)


def _array(context: Any, builder: Any, argument: Argument, place: Any, shape: list[Any], size: int) -> Any:
    """An array of a kernel in the memory at a place, with elements of so many bytes."""
    from llvmlite import ir

    whole = ir.IntType(64)
    strides = [*(builder.mul(whole(size), columns) for columns in shape[1:]), whole(size)]
    return array_of(context, builder, _type_of(argument), place, shape, strides)
