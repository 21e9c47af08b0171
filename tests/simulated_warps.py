"""Threads of a warp that hand on numbers to one another, in Numba's simulator, which has none of that.

Threads run as threads of Python. Each step of a warp is a barrier of its 32 threads on both sides of an exchange, so a
thread that leaves its warp makes the test hang, as a GPU would.
"""

import sys
import threading
from collections import defaultdict

from numba import cuda
from numba.cuda.simulator import kernelapi

WARP = 32
PATIENCE = 60.0  # [s]


class _Warp:
    def __init__(self):
        self.barrier = threading.Barrier(WARP)
        self.sent = [None] * WARP


_making = threading.Lock()
_warps = defaultdict(_Warp)


def _exchanged(value):
    """What all threads of this one's warp sent."""
    thread = threading.current_thread()
    with _making:
        warp = _warps[thread._manager, thread.thread_id // WARP]
    warp.sent[thread.thread_id % WARP] = value
    warp.barrier.wait(PATIENCE)
    sent = list(warp.sent)
    warp.barrier.wait(PATIENCE)
    return sent


def _lane():
    return threading.current_thread().thread_id % WARP


def _shfl_sync(self, mask, value, lane):
    return _exchanged(value)[lane]


def _shfl_xor_sync(self, mask, value, distance):
    return _exchanged(value)[_lane() ^ distance]


def _shfl_down_sync(self, mask, value, distance):
    sent, lane = _exchanged(value), _lane()
    return sent[lane + distance if lane + distance < WARP else lane]


def _all_sync(self, mask, value):
    return all(_exchanged(value))


def _any_sync(self, mask, value):
    return any(_exchanged(value))


def let_warps_exchange():
    """Give the simulator what it lacks."""
    sys.setswitchinterval(1e-5)
    for function in (_shfl_sync, _shfl_xor_sync, _shfl_down_sync, _all_sync, _any_sync):
        name = function.__name__.removeprefix("_")
        setattr(kernelapi.FakeCUDAModule, name, function)
        setattr(cuda, name, function)
