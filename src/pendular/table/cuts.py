"""How a coordinate is cut into cells: equal parts of octaves, and the polynomial that interpolates in each."""

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .kernels import edge

Floats = NDArray[np.float64]

_MANTISSA = 52
_MOST_OCTAVES, _MOST_PARTS = 14, 3
_TRIALS_PER_CELL = 6
_ROUNDING = 1e-14  # of w, which must not fall out of its first cell


class Cut(NamedTuple):
    """The cells of a coordinate from low to high: w = w₀ + w₁·coordinate runs from 2^-octaves to 1, or back."""

    w0: float
    w1: float
    octaves: int
    parts: int  # 2^parts cells to an octave
    only: float  # the coordinate of a range that is one point

    @property
    def shift(self) -> int:
        """Of the bits of w."""
        return _MANTISSA - self.parts

    @property
    def first(self) -> int:
        """Shifted bits of the first cell."""
        return shifted_bits(2.0**-self.octaves, self.shift)

    @property
    def cells(self) -> int:
        """Number of cells."""
        return self.octaves << self.parts

    def points(self, t: Floats) -> Floats:
        """Coordinates of the places t, from -1 to 1, in all cells: (cells, places)."""
        edges = np.array([edge(cell, self.shift, self.first) for cell in range(self.cells + 1)])
        w = edges[:-1, None] + 0.5 * np.diff(edges)[:, None] * (1.0 + t)
        return (w - self.w0) / self.w1 if self.w1 else np.full_like(w, self.only)


def cut_of(low: float, high: float, octaves: int, parts: int, is_reversed: bool) -> Cut:
    """Return the cut of a range with its fine end at the low side, or at the high side if reversed."""
    smallest = 2.0**-octaves + _ROUNDING
    start, end = (high, low) if is_reversed else (low, high)
    if low == high:
        return Cut(smallest, 0.0, 1, 0, low)
    w1 = (1.0 - smallest) / (end - start)
    return Cut(smallest - w1 * start, w1, octaves, parts, math.nan)


@cache
def _candidates() -> tuple[tuple[int, int, bool], ...]:
    """Octaves, parts and direction of all cuts, from few cells to many."""
    cuts = [
        (octaves, parts, is_reversed)
        for octaves in range(1, _MOST_OCTAVES + 1)
        for parts in range(_MOST_PARTS + 1)
        for is_reversed in (False, True)
        if (octaves, parts) == (1, 0) or octaves << parts > 1
    ]
    return tuple(sorted(cuts, key=lambda cut: (cut[0] << cut[1], cut[0])))


def chebyshev(count: int) -> Floats:
    """Interpolation points in (-1, 1)."""
    points: Floats = np.cos(np.pi * (np.arange(count, dtype=float) + 0.5) / count)
    return points


@cache
def to_powers(count: int) -> Floats:
    """Matrix from values at the interpolation points to coefficients of the powers 0, 1, 2..."""
    return np.asarray(np.linalg.inv(np.vander(chebyshev(count), increasing=True)), np.float64)


def _between(count: int) -> Floats:
    """Places between the interpolation points, where their error is largest; not quite the ends: q = 0 is a fold."""
    places: Floats = 0.98 * np.cos(np.pi * np.arange(count + 1) / count)
    return places


def interpolation_error(values: Callable[[Floats], Floats], points: Callable[[Floats], Floats], terms: int) -> Floats:
    """Largest error of the interpolation in cells, for each column of the values at given coordinates.

    ``points`` has the coordinates of places from -1 to 1 in all cells, as `Cut.points`.
    """
    nodes, trials = points(chebyshev(terms)), points(_between(_TRIALS_PER_CELL))
    found = values(np.concatenate([nodes.ravel(), trials.ravel()]))
    at_nodes = found[: nodes.size].reshape(*nodes.shape, -1)
    at_trials = found[nodes.size :].reshape(*trials.shape, -1)
    interpolate = np.vander(_between(_TRIALS_PER_CELL), terms, increasing=True) @ to_powers(terms)
    worst: Floats = np.abs(np.einsum("tn,cnk->ctk", interpolate, at_nodes) - at_trials).max(axis=(0, 1))
    return worst


def choose(is_good: Callable[[Cut], bool], low: float, high: float, after: int = 0) -> tuple[Cut, int]:
    """Return the cut with the fewest cells that is good, and its number in the list; the last one if none is."""
    for number in range(after, len(_candidates())):
        cut = cut_of(low, high, *_candidates()[number])
        if low == high or is_good(cut):
            break
    return cut, number


def octave_of(value: float) -> int:
    """Exponent of the power of two at or below a number."""
    return math.frexp(value)[1] - 1


def shifted_bits(value: float, shift: int) -> int:
    """Leading bits of a floating-point number, which number the cells."""
    return int(np.float64(value).view(np.int64)) >> shift
