"""Pairs of particles in lists, as kernels see them: numbers lie flat, two for a pair and three for a centre."""

import math

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel

__all__ = ["arm_of", "distance_of", "ends_of", "first_from", "key_of", "place_of"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_ONE, _TWO, _THREE = np.uint64(1), np.uint64(2), np.uint64(3)


@kernel
def ends_of(pairs: Integers, contact: int) -> tuple[int, int]:
    """Particles of a contact, in ascending order."""
    first, second = pairs[2 * contact], pairs[2 * contact + 1]
    return (first, second) if first < second else (second, first)


@kernel
def key_of(pairs: Integers, contact: int, particles: int) -> int:
    """One number for a pair, which ascends with its smaller, then its larger index."""
    low, high = ends_of(pairs, contact)
    return low * particles + high


@kernel
def first_from(pairs: Integers, key: int, particles: int) -> int:
    """First of ordered pairs that does not precede another."""
    begin, end = 0, pairs.size // 2
    while begin < end:
        middle = (begin + end) // 2
        if key_of(pairs, middle, particles) < key:
            begin = middle + 1
        else:
            end = middle
    return begin


@kernel
def place_of(particle: int) -> tuple[np.uint64, np.uint64, np.uint64]:
    """Where the three numbers of a particle lie. Unsigned places need no test for one from the end."""
    place = _THREE * np.uint64(particle)
    return place, place + _ONE, place + _TWO


@kernel
def arm_of(positions: Floats, first: int, second: int) -> tuple[float, float, float]:
    """From one centre to another."""
    x, y, z = place_of(first)
    to_x, to_y, to_z = place_of(second)
    return positions[to_x] - positions[x], positions[to_y] - positions[y], positions[to_z] - positions[z]


@kernel
def distance_of(positions: Floats, first: int, second: int) -> float:
    """Between two centres."""
    x, y, z = arm_of(positions, first, second)
    return math.sqrt(x * x + y * y + z * z)
