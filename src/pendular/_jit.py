"""The one compile decorator of the kernels, and how a kernel over rows runs on all threads.

Every kernel is a scalar function of floats, compiled lazily, cached on disk, without fastmath, and with
NumPy's error model: a division by zero gives inf or NaN, as NaN marks "outside the domain" throughout.
"""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numba import get_num_threads, njit
from numpy.typing import NDArray

from ._cache import keep_on_disk

__all__ = ["constants", "element", "in_chunks", "kernel", "summing_kernel"]

# Sums may be added up in any order, several at once; NaN, infinity and every other rule of arithmetic stay.
_ANY_ORDER = {"reassoc", "contract"}


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a kernel, free of the interpreter's lock, and keep its code until a source that enters it changes."""
    return _compiled(function, False)


def summing_kernel(function: Callable[..., Any]) -> Any:
    """Compile a kernel whose loop adds up many terms, in the lanes of the processor."""
    return _compiled(function, _ANY_ORDER)


def _compiled(function: Callable[..., Any], fastmath: bool | set[str]) -> Any:
    dispatcher = njit(error_model="numpy", nogil=True, fastmath=fastmath)(function)
    if dispatcher is not function:  # it is with the compiler off
        keep_on_disk(dispatcher)
    return dispatcher


def constants(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Numbers that a kernel looks up."""
    return values


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
