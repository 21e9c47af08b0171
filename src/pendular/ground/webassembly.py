"""Kernels as functions of a WebAssembly module, for browsers and all else that runs one.

They are the functions of C of `linkable`, compiled by LLVM for another processor. The module takes elementary functions
from its host, as JavaScript has them, and nothing else; `__heap_base` tells from where on its memory is free.
"""

import re
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from .linkable import Function, kept_or_made, llvm_text
from .linking import run

__all__ = ["linker", "module_of"]

_TRIPLE = "wasm32-unknown-unknown"
_LAYOUT = "e-m:e-p:32:32-p10:8:8-p20:8:8-i64:64-i128:128-n32:64-S128-ni:1:10:20"
_FEATURES = "+sign-ext,+nontrapping-fptoint"  # in all browsers since 2020
_STACK = 1 << 18  # bytes


def linker() -> str | None:
    """Program that links WebAssembly, None if there is none."""
    return shutil.which("wasm-ld")


def module_of(functions: Sequence[Function], failed: int, linker: str) -> bytes:
    """Module with functions, linked by ``wasm-ld``; a kernel that broke off, against all reason, has failed.

    Raises
    ------
    ValueError
        If it cannot be linked.
    """
    code = kept_or_made(functions, failed, _TRIPLE, lambda: _object_of(llvm_text(functions, failed)))
    return _linked(code, [function.name for function in functions], linker)


def _object_of(text: str) -> bytes:
    """Object file of a text for LLVM, whatever processor it was written for."""
    import llvmlite.binding as llvm

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    text = re.sub(r"^target triple = .*", f'target triple = "{_TRIPLE}"', text, flags=re.MULTILINE)
    text = re.sub(r"^target datalayout = .*", f'target datalayout = "{_LAYOUT}"', text, flags=re.MULTILINE)
    module = llvm.parse_assembly(text)
    machine = llvm.Target.from_triple(_TRIPLE).create_target_machine(opt=3, features=_FEATURES)
    builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options(speed_level=3))
    builder.getModulePassManager().run(module, builder)
    code: bytes = machine.emit_object(module)
    return code


def _linked(code: bytes, names: Sequence[str], linker: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        part, made = Path(folder, "part.o"), Path(folder, "module.wasm")
        part.write_bytes(code)
        exports = [f"--export={name}" for name in (*names, "__heap_base")]
        options = ["--no-entry", "--allow-undefined", "--strip-all", "-z", f"stack-size={_STACK}", *exports]
        run([linker, *options, "-o", made, part], f"wasm: {linker} cannot link the module")
        return made.read_bytes()
