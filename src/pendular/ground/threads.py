"""How many threads share the rows of a question, and those that help."""

import os
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cache

__all__ = ["helpers", "thread_count"]

_SETTINGS = ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS")


def thread_count() -> int:
    """Threads to run on: as set in Numba, by ``NUMBA_NUM_THREADS`` or ``OMP_NUM_THREADS``, else all there are."""
    if numba := sys.modules.get("numba"):
        with suppress(AttributeError):  # it is just being imported
            return int(numba.get_num_threads())
    for name in _SETTINGS:
        with suppress(ValueError):
            return max(1, int(os.environ.get(name, "")))
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@cache
def helpers(count: int) -> ThreadPoolExecutor:
    """So many threads that help those who ask. They are kept, as to start one takes as long as thousands of rows."""
    return ThreadPoolExecutor(count, "pendular")


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=helpers.cache_clear)  # a child has none of its parent's threads
