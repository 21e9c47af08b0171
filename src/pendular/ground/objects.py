"""Object files of kernels, by Numba: code is put together first and optimised once, and nothing of it is loaded."""

from collections.abc import Callable, Collection, Mapping
from functools import cache, partial
from typing import Any

from .calling import write_caller
from .compile import fastmath_of, rebound

__all__ = ["HOST", "Entry", "context_of_files", "object_of", "object_of_all", "unlinked"]

HOST = "host"  # this processor, for LLVM

Entry = tuple[Callable[..., None], tuple[Any, ...]]  # a kernel, and arguments of the types that it is compiled for


def object_of(function: Callable[..., None], arguments: tuple[Any, ...], symbol: str, processor: str) -> bytes:
    """Object file of a kernel for arguments of these types, in which it alone can be found, by the name of a symbol."""
    return object_of_all({symbol: (function, arguments)}, processor)


def object_of_all(entries: Mapping[str, Entry], processor: str) -> bytes:
    """The same of many kernels by their symbols; what they share is in it once."""
    from numba import typeof
    from numba.core.compiler_lock import global_compiler_lock

    context = context_of_files(processor)
    library = context.codegen().create_library("entries")
    module = context.create_module("callers")
    with global_compiler_lock:
        for symbol, (function, arguments) in entries.items():
            dispatcher = unlinked(function, processor)
            signature = tuple(typeof(argument) for argument in arguments)
            dispatcher.compile(signature)
            result = dispatcher.overloads[signature]
            library.add_linking_library(result.library)
            write_caller(context, module, symbol, result.fndesc)
        library.add_ir_module(module)
        library.finalize()
        library.hide_all_but(entries)
        code: bytes = library.emit_native_object()
    return code


@cache
def unlinked(function: Callable[..., Any], processor: str = HOST) -> Any:
    """Dispatcher of a kernel whose code is for a file alone: nothing of it is loaded into this process."""
    from numba import njit
    from numba.core.compiler import Compiler

    class AheadOfTime(Compiler):
        def __init__(self, typing_context: Any, _context: Any, *rest: Any) -> None:
            super().__init__(typing_context, context_of_files(processor), *rest)
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
    return njit(**options)(rebound(function, partial(unlinked, processor=processor)))


@cache
def context_of_files(processor: str = HOST) -> Any:
    """Context in which code is optimised once, when it is whole: Numba would do it for each kernel and its callers."""
    from numba.core.codegen import AOTCodeLibrary, AOTCPUCodegen
    from numba.core.registry import cpu_target

    class Library(AOTCodeLibrary):
        def _optimize_functions(self, module: Any) -> None:
            module.data_layout = self._codegen._data_layout

        def _optimize_final_module(self) -> None:
            pass

        def hide_all_but(self, names: Collection[str]) -> None:
            """Hide all but a few functions."""
            module = self._final_module
            for value in (*module.functions, *module.global_variables):
                if value.name not in names and not value.is_declaration:
                    value.linkage = "internal"

        def text(self) -> str:
            return str(self._final_module)

        def emit_native_object(self) -> Any:
            self._ensure_finalized()
            super()._optimize_functions(self._final_module)
            super()._optimize_final_module()
            return super().emit_native_object()

    class Codegen(AOTCPUCodegen):
        _library_class = Library

    return cpu_target.target_context.subtarget(_internal_codegen=Codegen("pendular", cpu_name=processor), aot_mode=True)
