"""Machine code of kernels ahead of time: object files on disk, loaded without Numba in milliseconds.

Numba compiles a kernel for the types of its arguments to an object file, which llvmlite's linker loads. The kernel is
called as compiled code of Numba calls it: a status comes back, and arguments are laid out flat: numbers as they are, an
array as its owner (none), size, address, shape and strides, a tuple as its members. The file is made by the Numba that
is installed, so that both agree on this; its name has a stamp of all that enters it, and its content one of itself.
"""

import ctypes
import gc
import hashlib
import json
import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from functools import cache
from numbers import Integral
from pathlib import Path
from typing import Any

import numpy as np

from .compile import fastmath_of, rebound
from .files import alone, whole
from .stamp import stamp_of

__all__ = ["build", "context_of_files", "folder", "kept", "load", "made", "notices", "unlinked"]

Native = Callable[..., None]

notices: list[Callable[[], AbstractContextManager[Any]]] = []  # what tells whoever waits while a kernel is compiled

_LOCKS = "building.lock"  # in the folder of machine code
_PATIENCE = 300.0  # with another process that compiles the same, [s]
_SEAL = hashlib.sha256().digest_size
_ANSWERS = (ctypes.c_void_p, ctypes.c_void_p)
_loaded: dict[tuple[Callable[..., None], str], Native] = {}  # by kernel and types
_building = threading.Lock()  # threads of a process compile one after the other in any case
_NUMBERS = {bool: ctypes.c_int8, float: ctypes.c_double, Integral: ctypes.c_int64}


def load(function: Callable[..., None], arguments: tuple[Any, ...]) -> Native | None:
    """Machine code of a kernel that returns nothing, for arguments of these types, None if there is no whole file."""
    kind = function, _types_of(arguments)
    if kind not in _loaded:
        content = kept(*kind)
        if content is None:
            return None
        _loaded[kind] = _linked(content)
    return _loaded[kind]


def build(function: Callable[..., None], arguments: tuple[Any, ...]) -> Native:
    """Compile a kernel for arguments of these types, keep its machine code where that can be done, and load it."""
    kind = function, _types_of(arguments)
    content = made(*kind, lambda: _compiled(function, arguments))
    if kind not in _loaded:
        _loaded[kind] = _linked(content)
    return _loaded[kind]


def made(function: Callable[..., Any], types: str, compile: Callable[[], bytes]) -> bytes:
    """Compile what is of a kernel for some types, and keep it where that can be done.

    Of processes that begin at once one compiles, and the others wait for it.
    """
    path = _path_of(function, types)
    with ExitStack() as told:
        told.enter_context(_building)
        for notice in notices:
            told.enter_context(notice())
        told.enter_context(alone(folder() / _LOCKS, path.name, _PATIENCE))
        content = kept(function, types)
        if content is None:
            told.enter_context(_without_collector())
            content = compile()
            with suppress(OSError), whole(path) as draft:
                draft.write_bytes(hashlib.sha256(content).digest() + content)
    return content


# -- the file --------------------------------------------------------------------------------------------------------


def kept(function: Callable[..., Any], types: str) -> bytes | None:
    """What was made of a kernel for some types, None if there is no whole file."""
    try:
        sealed = _path_of(function, types).read_bytes()
    except OSError:
        return None
    digest, content = sealed[:_SEAL], sealed[_SEAL:]
    return content if hashlib.sha256(content).digest() == digest else None


def _path_of(function: Callable[..., Any], types: str) -> Path:
    source = Path(function.__code__.co_filename)
    key = hashlib.sha256(f"{stamp_of(source)} {_processor()} {function.__module__} {types}".encode()).hexdigest()
    return folder() / f"{function.__name__}-{key[:24]}.o"


@cache
def folder() -> Path:
    """Where machine code is kept: ``PENDULAR_CACHE_DIR``, else in the user's own folder for such files."""
    if chosen := os.environ.get("PENDULAR_CACHE_DIR"):
        return Path(chosen)
    if sys.platform == "win32":
        home = os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local"
    elif sys.platform == "darwin":
        home = Path.home() / "Library" / "Caches"
    else:
        home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(home) / "pendular"


@cache
def _processor() -> str:
    import llvmlite.binding as llvm

    features = llvm.get_host_cpu_features().flatten()
    return f"{llvm.get_process_triple()} {llvm.get_host_cpu_name()} {features}"


# -- types and the layout of arguments -------------------------------------------------------------------------------


def _types_of(arguments: Any) -> str:
    """Spell the types of arguments: what decides on the machine code."""
    if isinstance(arguments, np.ndarray):
        layout = "C" if arguments.flags.c_contiguous else "A"
        return f"{arguments.dtype.str}{arguments.ndim}{layout}{'' if arguments.flags.writeable else 'r'}"
    if isinstance(arguments, tuple):
        return f"{type(arguments).__name__}({','.join(map(_types_of, arguments))})"
    return type(arguments).__name__


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


# -- linking ---------------------------------------------------------------------------------------------------------

_engines: list[Any] = []  # they own the code


@cache
def _engine() -> Any:
    import llvmlite.binding as llvm

    with suppress(RuntimeError):  # newer versions do that by themselves
        llvm.initialize()
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    machine = llvm.Target.from_default_triple().create_target_machine(jit=True)
    return llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)


def _linked(content: bytes) -> Native:
    """Load the content of a file: a line that names the kernel's symbol, then the object."""
    import llvmlite.binding as llvm

    head, _, code = content.partition(b"\n")
    symbol = json.loads(head)["symbol"]
    engine = _engine()
    engine.add_object_file(llvm.ObjectFileRef.from_data(code))
    engine.finalize_object()
    address = engine.get_function_address(symbol)
    typed: list[Callable[..., int]] = []  # by the arguments of the first call: all others have their types
    nothing, error = ctypes.c_void_p(), ctypes.c_void_p()
    answers = (ctypes.byref(nothing), ctypes.byref(error))

    def call(*arguments: Any) -> None:
        if not typed:
            typed.append(ctypes.CFUNCTYPE(ctypes.c_int32, *_ANSWERS, *_layout(arguments))(address))
        if typed[0](*answers, *_flat(arguments)) != 0:
            raise RuntimeError(f"{symbol} failed")

    return call


# -- compiling -------------------------------------------------------------------------------------------------------


def _compiled(function: Callable[..., None], arguments: tuple[Any, ...]) -> bytes:
    """Symbol and object of a kernel for arguments of these types."""
    from numba import typeof
    from numba.core.compiler_lock import global_compiler_lock

    dispatcher = unlinked(function)
    signature = tuple(typeof(argument) for argument in arguments)
    dispatcher.compile(signature)
    result = dispatcher.overloads[signature]
    head = json.dumps({"symbol": result.fndesc.llvm_func_name})
    with global_compiler_lock:
        code: bytes = result.library.emit_native_object()
    return head.encode() + b"\n" + code


@cache
def unlinked(function: Callable[..., Any]) -> Any:
    """Dispatcher of a kernel whose code is for a file alone: nothing of it is loaded into this process."""
    from numba import njit
    from numba.core.compiler import Compiler

    class AheadOfTime(Compiler):
        def __init__(self, typing_context: Any, _context: Any, *rest: Any) -> None:
            super().__init__(typing_context, context_of_files(), *rest)
            self.state.flags.no_compile = True

        def compile_extra(self, function: Any) -> Any:
            result = super().compile_extra(function)
            result = result._replace(entry_point=[].append)  # something of its own that stands for the function
            self.state.targetctx.insert_user_function(result.entry_point, result.fndesc, [result.library])
            return result

    options: dict[str, Any] = {
        "error_model": "numpy",
        "nogil": True,
        "fastmath": fastmath_of(function),
        "no_cpython_wrapper": True,
        "no_cfunc_wrapper": True,
        "_nrt": False,  # a kernel owns no memory
        "pipeline_class": AheadOfTime,
    }
    return njit(**options)(rebound(function, unlinked))


@cache
def context_of_files() -> Any:
    """Context in which code is optimised once, when it is whole: Numba would do it for each kernel and its callers."""
    from numba.core.codegen import AOTCodeLibrary, AOTCPUCodegen
    from numba.core.registry import cpu_target

    class Library(AOTCodeLibrary):
        def _optimize_functions(self, module: Any) -> None:
            module.data_layout = self._codegen._data_layout

        def _optimize_final_module(self) -> None:
            pass

        def hide_all_but(self, names: set[str]) -> None:
            module = self._final_module
            for value in (*module.functions, *module.global_variables):
                if not value.is_declaration and value.name not in names:
                    value.linkage = "internal"

        def emit_native_object(self) -> Any:
            self._ensure_finalized()
            super()._optimize_functions(self._final_module)
            super()._optimize_final_module()
            return super().emit_native_object()

    class Codegen(AOTCPUCodegen):
        _library_class = Library

    return cpu_target.target_context.subtarget(_internal_codegen=Codegen("pendular", cpu_name="host"), aot_mode=True)


@contextmanager
def _without_collector() -> Iterator[None]:
    """Spare the compiler, which drops nothing that it makes, the search for what it might have dropped."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
