"""Rows of a question, answered in the way that is soonest: plain Python, or machine code on all threads.

Plain Python answers a few rows in milliseconds. Loading machine code takes a tenth of a second, making it most of a
minute. A process that keeps asking changes over once it has spent on plain answers what the change would cost.
"""

from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import wait
from contextlib import contextmanager
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import background, native
from .calling import Native
from .compile import Kernel, has_compiler, kernel
from .threads import helpers, thread_count

__all__ = ["ENTRIES", "Own", "by_machine_code", "copy_part", "element", "entry", "over_rows"]

_LOADING = 0.15  # of machine code, [s]
_PATIENCE = 3.0  # on plain answers before an entry is compiled that tells no other, [s]

Told = Callable[[Callable[..., None], float], None]  # an entry, and the time that its machine code took to make, [s]

ENTRIES: list[Callable[..., None]] = []  # all kernels that arrays call
_costs: dict[Any, float] = {}  # of a row in plain Python, [s]
_patience: dict[Any, float] = {}  # on plain answers before it is compiled, [s]
_spent: dict[Any, float] = {}  # on plain answers so far, [s]
_always: list[Told] = []  # one for each time that machine code was asked for, whatever it costs


@kernel
def element(operand: NDArray[np.float64], i: int) -> float:
    """Element i of an operand that is as long as the result or has one element for all."""
    return float(operand[min(i, operand.size - 1)])


@kernel
def copy_part(source: NDArray[Any], begin: int, target: NDArray[Any], place: int, count: int) -> None:
    """Copy elements, or the one that counts for all; an assignment to a slice would take memory of its own."""
    written = target[place : place + count]
    if source.size == 1:
        for i in range(count):
            written[i] = source[0]
    else:
        read = source[begin : begin + count]
        for i in range(count):
            written[i] = read[i]


class Own(NamedTuple):
    """An argument that each thread has for itself."""

    make: Callable[[], Any]


def entry(plain_cost: float, patience: float | None = None) -> Callable[[Kernel], Kernel]:
    """Mark a kernel that answers rows: it ends in ``(start, stop)``, and returns and allocates nothing.

    Parameters
    ----------
    plain_cost : float
        Time that a row takes in plain Python, [s].
    patience : float, optional
        Time to spend in plain Python before it is compiled, [s]: the more, the longer that takes and the less often it
        will be asked again.
    """

    def mark(function: Kernel) -> Kernel:
        ENTRIES.append(function)
        _costs[function], _spent[function] = plain_cost, 0.0
        if patience is not None:
            _patience[function] = patience
        return kernel(function)

    return mark


def over_rows(
    function: Callable[..., None],
    count: int,
    chunk: int,
    *arguments: Any,
    plainly: Callable[..., None] | None = None,
) -> None:
    """Run an entry over ``count`` rows, by chunks that threads share; ``plainly`` takes its place in plain Python.

    Each row is computed by the same code wherever it runs, so the results do not depend on the threads.
    """
    example = (*_owned(arguments), 0, count)
    code = _machine_code(function, count, example)
    if code is None:
        start = perf_counter()
        with np.errstate(all="ignore"):  # NaN and infinity are answers, as in machine code
            (plainly or function)(*example)
        _spent[function] += perf_counter() - start
        return
    left = deque(range(0, count, chunk))
    threads = min(thread_count(), len(left)) if len(left) > 1 else 1
    if threads == 1:
        code(*example)
        return

    def take(part: Callable[[int, int], None]) -> None:
        while True:
            try:
                start = left.popleft()
            except IndexError:
                return
            part(start, min(count, start + chunk))

    pool = helpers(threads - 1)
    taking = [pool.submit(take, code.of_rows(_owned(arguments))) for _ in range(threads - 1)]
    try:
        take(code.of_rows(example[:-2]))  # this thread takes its part
    finally:
        left.clear()  # after an error or an interrupt
        begun = [other for other in taking if not other.cancel()]  # the others help someone else
        wait(begun)
    for other in begun:
        other.result()


def _tell_nobody(_function: Callable[..., None], _seconds: float) -> None:
    pass


@contextmanager
def by_machine_code(told: Told = _tell_nobody) -> Iterator[None]:
    """Answer by machine code however few the rows, and make it where there is none: what is done ahead of use."""
    _always.append(told)
    try:
        yield
    finally:
        _always.pop()


def _owned(arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    return tuple(argument.make() if isinstance(argument, Own) else argument for argument in arguments)


def _machine_code(function: Callable[..., None], count: int, arguments: tuple[Any, ...]) -> Native | None:
    """Machine code of an entry, if it pays: None to run it as it stands."""
    if _always and has_compiler():
        return _made(function, arguments)
    ahead = _spent[function] + count * _costs[function]
    if ahead < _LOADING:
        return None
    code = native.load(function, arguments)
    if code is None and has_compiler():
        if ahead > _patience.get(function, _PATIENCE):
            return native.build(function, arguments)
        background.compile_all()
    return code


def _made(function: Callable[..., None], arguments: tuple[Any, ...]) -> Native | None:
    """Machine code of an entry for this processor, made if it is not there, and told of."""
    code, start, took = native.load_own(function, arguments), perf_counter(), 0.0
    if code is None:
        code = native.build(function, arguments)
        took = perf_counter() - start
    _always[-1](function, took)
    return code
