"""The decorators of the kernels, without a compiler."""

from collections.abc import Callable
from typing import Any, TypeVar

from numpy.typing import NDArray

__all__ = ["constants", "in_chunks", "kernel", "summing_kernel"]

Kernel = TypeVar("Kernel", bound=Callable[..., Any])


def kernel(function: Kernel) -> Kernel:
    """Leave a kernel as it is."""
    return function


summing_kernel = kernel


def constants(values: NDArray[Any]) -> list[float]:
    """Numbers that a kernel looks up: plain floats, which cost a third of NumPy's."""
    numbers: list[float] = values.tolist()
    return numbers


def in_chunks(range_kernel: Callable[..., None], count: int, chunk: int, *arguments: Any) -> None:
    """Run a kernel that ends in ``(start, stop)`` over ``count`` rows."""
    range_kernel(*arguments, 0, count)
