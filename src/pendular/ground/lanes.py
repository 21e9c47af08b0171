"""Several rows at once: a kernel of floats, called with lanes, answers as many rows as a vector of the processor holds.

Plain Python, and a GPU, whose threads are its lanes, take one row at a time: there a number is a float, and what is
here says what is meant. On the processor it is a vector, in which every operation is done to all lanes: `vectors`. So a
kernel for lanes decides by `choose`, and goes on until `every` lane is done.
"""

import numpy as np
from numpy.typing import NDArray

from .compile import kernel_written_in

__all__ = ["choose", "every", "lanes", "lanes_of", "put_lanes"]

Floats = NDArray[np.float64]


@kernel_written_in("pendular.ground.vectors")
def lanes() -> int:
    """How many rows are answered at once."""
    return 1


@kernel_written_in("pendular.ground.vectors")
def lanes_of(array: Floats, start: int) -> float:
    """Numbers of an array from a start."""
    return float(array[start])


@kernel_written_in("pendular.ground.vectors")
def put_lanes(array: Floats, start: int, numbers: float) -> None:
    """Store numbers in an array from a start."""
    array[start] = numbers


@kernel_written_in("pendular.ground.vectors")
def choose(condition: bool, number: float, other: float) -> float:
    """The first number where the condition holds, else the other; both are computed."""
    return number if condition else other


@kernel_written_in("pendular.ground.vectors")
def every(condition: bool) -> bool:
    """Whether a condition holds in all lanes."""
    return condition
