"""Machine code in the package itself: one shared library of entries, where a wheel was built with it.

It is made for a processor that stands for nearly all of its kind, so that it runs where the wheel is installed: without
Numba, and loaded in a millisecond. A kernel is found in it by a name that has the hash of its source, so that code of
another source is never used.
"""

import ctypes
import platform
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from . import stamp
from .calling import Native
from .linking import linker, shared_library

__all__ = ["FILE", "PROCESSOR", "load", "name_of", "write"]

FILE = Path(__file__).with_name("machine_code.so")

# With AVX2 and fused multiplication: all of Intel and AMD since about 2015.
PROCESSOR = {"x86_64": "x86-64-v3", "AMD64": "x86-64-v3"}.get(platform.machine(), "generic")

_RUNS_HERE = """
int pendular_runs_here(void)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
#else
    return 1;
#endif
}
"""


def name_of(function: Callable[..., Any], types: str) -> str:
    """Name of the machine code of a kernel for some types in the package."""
    source = stamp.source_stamp(Path(function.__code__.co_filename))
    return stamp.name_of(function, source, PROCESSOR, function.__module__, types)


def load(function: Callable[..., Any], types: str) -> Native | None:
    """Machine code of a kernel for some types, None if the package has none that runs here."""
    library = _library()
    if library is None:
        return None
    name = name_of(function, types)
    try:
        found = getattr(library, name)
    except AttributeError:
        return None
    address = ctypes.cast(found, ctypes.c_void_p).value
    assert address is not None
    return Native(address, name)


@cache
def _library() -> ctypes.CDLL | None:
    with suppress(OSError):
        library = ctypes.CDLL(str(FILE))
        if library.pendular_runs_here():
            return library
    return None


def write(path: Path, objects: Iterable[bytes]) -> None:
    """Write the library of kernels, of their object files.

    Raises
    ------
    ValueError
        If there is no C compiler, or it cannot link them.
    """
    compiler = linker()
    if compiler is None:
        raise ValueError("library: needs a C compiler, cc, gcc or clang, that links it")
    path.write_bytes(shared_library(compiler, path.name, objects, _RUNS_HERE))
