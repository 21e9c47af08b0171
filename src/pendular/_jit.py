"""The one compile decorator of the kernels, and how a kernel over rows runs on all threads.

Every kernel is a scalar function of floats, compiled lazily, cached on disk, without fastmath, and with
NumPy's error model: a division by zero gives inf or NaN, as NaN marks "outside the domain" throughout.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numba import get_num_threads, njit
from numpy.typing import NDArray

__all__ = ["element", "in_chunks", "kernel", "summing_kernel"]

# Sums may be added up in any order, several at once; NaN, infinity and every other rule of arithmetic stay.
_ANY_ORDER = {"reassoc", "contract"}

_HOME = Path(__file__).parent


@cache
def _stamp_of(*folders: str) -> tuple[float, int]:
    """Latest change and total size of the files in folders of kernels."""
    stats = [path.stat() for folder in folders for path in (_HOME / folder).glob("*.py")]
    return max(stat.st_mtime for stat in stats), sum(stat.st_size for stat in stats)


def _folders_of(file: Path) -> tuple[str, ...]:
    """Folders whose kernels one in this file may use."""
    if file.parent == _HOME / "exact":
        return ("exact",)
    shared = ("exact", "solids", "laws", "table")
    return shared if file.parent.name in shared else (*shared, "", str(file.parent))


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a kernel, free of the interpreter's lock, and outdate its cached code when a kernel it may use changes.

    Numba looks only at the file of the function itself, and would go on using machine code that contains the
    former version of a kernel from another file. The exact solver uses no other folder; all else may use all, and what
    is outside of these also the files of the package itself and those beside its own.
    """
    return _compiled(function, False)


def summing_kernel(function: Callable[..., Any]) -> Any:
    """Compile a kernel whose loop adds up many terms, in the lanes of the processor."""
    return _compiled(function, _ANY_ORDER)


def _compiled(function: Callable[..., Any], fastmath: bool | set[str]) -> Any:
    dispatcher = njit(cache=True, error_model="numpy", nogil=True, fastmath=fastmath)(function)
    cache_file = getattr(getattr(dispatcher, "_cache", None), "_cache_file", None)  # absent with the compiler off
    if cache_file is not None:
        cache_file._source_stamp = _stamp_of(*_folders_of(Path(function.__code__.co_filename)))
    return dispatcher


@kernel
def element(operand: NDArray[np.float64], i: int) -> float:
    """Element i of an operand that is as long as the result or has one element for all."""
    return operand[min(i, operand.size - 1)]


def in_chunks(range_kernel: Callable[..., None], count: int, chunk: int, *arguments: Any) -> None:
    """Run a kernel that ends in ``(start, stop)`` over ``count`` rows, by chunks on as many threads as Numba has.

    Each row is computed by the same code wherever it runs, so the results do not depend on the threads. Compiled
    code needs no twin for that, as ``prange`` would.
    """
    starts = range(0, count, chunk)
    if len(starts) <= 1 or get_num_threads() == 1:
        range_kernel(*arguments, 0, count)
        return
    range_kernel(*arguments, 0, 0)  # compile or load it once, not in every thread
    with ThreadPoolExecutor(get_num_threads()) as pool:
        for _ in pool.map(lambda start: range_kernel(*arguments, start, min(count, start + chunk)), starts):
            pass
