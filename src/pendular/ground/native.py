"""Machine code of kernels: that of the package, else object files in a folder of the user, loaded in milliseconds.

An object file is made by Numba for the processor that runs it, and loaded by llvmlite's linker without Numba. Its name
has a stamp of all that enters it, and its content one of itself.
"""

import gc
import hashlib
import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import Any

from . import packaged
from .calling import Native, types_of
from .compile import has_compiler
from .files import alone, whole
from .objects import HOST, Entry, object_of
from .stamp import name_of, stamp_of

__all__ = ["build", "folder", "for_the_package", "kept", "load", "load_own", "made", "notices"]

notices: list[Callable[[], AbstractContextManager[Any]]] = []  # what tells whoever waits while a kernel is compiled

_LOCKS = "building.lock"  # in the folder of machine code
_PATIENCE = 300.0  # with another process that compiles the same, [s]
_SEAL = hashlib.sha256().digest_size
_loaded: dict[tuple[Callable[..., None], str], Native] = {}  # what was made here, by kernel and types
_packaged: dict[tuple[Callable[..., None], str], Native] = {}  # what the package has
_building = threading.Lock()  # threads of a process compile one after the other in any case
_for_the_package: list[dict[str, Entry]] = []  # what is asked of it, by name, while none is made for this processor


def load(function: Callable[..., None], arguments: tuple[Any, ...]) -> Native | None:
    """Machine code of a kernel that returns nothing, for arguments of these types, None if there is none.

    What was made for this processor comes before what the package has for all of its kind.
    """
    kind = function, types_of(arguments)
    if (known := _loaded.get(kind) or _packaged.get(kind) or _own(kind)) is not None:
        return known
    if (code := packaged.load(*kind)) is not None:
        _packaged[kind] = code
    return code


def load_own(function: Callable[..., None], arguments: tuple[Any, ...]) -> Native | None:
    """Machine code of a kernel that was made here, None if there is no whole file."""
    return _own((function, types_of(arguments)))


def _own(kind: tuple[Callable[..., None], str]) -> Native | None:
    if kind not in _loaded:
        content = _kept_here(*kind)
        if content is None:
            return None
        _loaded[kind] = _linked(_name_of(*kind), content)
    return _loaded[kind]


def build(function: Callable[..., None], arguments: tuple[Any, ...]) -> Native:
    """Compile a kernel for arguments of these types, keep its machine code where that can be done, and load it."""
    kind = function, types_of(arguments)
    if _for_the_package:
        name = packaged.name_of(*kind)
        _for_the_package[-1][name] = function, arguments
        content = object_of(function, arguments, name, packaged.PROCESSOR)
    else:
        name = _name_of(*kind)
        content = made(*kind, lambda: object_of(function, arguments, name, HOST))
    if kind not in _loaded:
        _loaded[kind] = _linked(name, content)
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


@contextmanager
def for_the_package() -> Iterator[dict[str, Entry]]:
    """Make all machine code for the processor of the package, and collect entries by the names that they have there."""
    _for_the_package.append({})
    try:
        yield _for_the_package[-1]
    finally:
        _for_the_package.pop()


# -- the file --------------------------------------------------------------------------------------------------------


def kept(function: Callable[..., Any], types: str) -> bytes | None:
    """What was made of a kernel for some types, None if there is no whole file."""
    try:
        sealed = _path_of(function, types).read_bytes()
    except OSError:
        return None
    digest, content = sealed[:_SEAL], sealed[_SEAL:]
    return content if hashlib.sha256(content).digest() == digest else None


def _kept_here(function: Callable[..., None], types: str) -> bytes | None:
    """What was made of a kernel, if anything was: to find the name of a file takes a tenth of a second."""
    if _for_the_package or not has_compiler() or not any(folder().glob(f"{function.__name__}_*.o")):
        return None
    return kept(function, types)


def _path_of(function: Callable[..., Any], types: str) -> Path:
    return folder() / f"{_name_of(function, types)}.o"


def _name_of(function: Callable[..., Any], types: str) -> str:
    """Name of the machine code of a kernel for some types on this processor."""
    return name_of(function, stamp_of(Path(function.__code__.co_filename)), _processor(), function.__module__, types)


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


# -- linking ---------------------------------------------------------------------------------------------------------

_linkages: list[Any] = []  # they own the code
_linking = threading.Lock()  # there is one linker, and it wants another name for each


@cache
def _linker() -> Any:
    """A linker that puts each file in one place: code finds what else is in its file no further than 2 GB away."""
    import llvmlite.binding as llvm

    with suppress(RuntimeError):  # newer versions do that by themselves
        llvm.initialize()
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    machine = llvm.Target.from_default_triple().create_target_machine(jit=True)
    by_jit_link = sys.platform != "win32"  # experimental for its files
    return llvm.create_lljit_compiler(machine, use_jit_link=by_jit_link, suppress_errors=True)  # they are raised


def _linked(name: str, content: bytes) -> Native:
    """Load an object file, and find the code of a name in it."""
    import llvmlite.binding as llvm

    library = llvm.JITLibraryBuilder().add_object_img(content).add_current_process().export_symbol(name)
    with _linking:
        linkage = library.link(_linker(), f"{name}.{len(_linkages)}")
        _linkages.append(linkage)
    return Native(linkage[name], name)


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
