"""How many threads share the rows of a question."""

import os
import sys
from contextlib import suppress

__all__ = ["thread_count"]

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
