"""How a coordinate is cut into cells: equal parts of octaves, and the polynomial that interpolates in each."""

import math
from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .kernels import logarithmic

Floats = NDArray[np.float64]
Points = Callable[[Floats], Floats]  # coordinates of places from -1 to 1 in cells: (cells, places)

_MANTISSA = 52
_MOST_OCTAVES, _MOST_PARTS = 30, 3
_TRIALS_PER_CELL = 6
_ALMOST = 2.0  # times the least error
_MARGIN, _MOST_MARGIN = 2e-12, 0.1  # of the range, and of w: what lies at the limits, but for rounding, has a cell


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
        return self._points_in(np.arange(self.cells), t)

    def end_points(self, t: Floats) -> Floats:
        """The same in the first and the last cell."""
        return self._points_in(np.array([0, self.cells - 1]), t)

    def _points_in(self, cells: NDArray[np.int64], t: Floats) -> Floats:
        low, high = (((self.first + cells + side) << self.shift).view(np.float64)[:, None] for side in (0, 1))
        w = low + 0.5 * (high - low) * (1.0 + t)
        return (w - self.w0) / self.w1 if self.w1 else np.full_like(w, self.only)


def cut_of(low: float, high: float, octaves: int, parts: int, is_reversed: bool) -> Cut:
    """Return the cut of a range with its fine end at the low side, or at the high side if reversed."""
    if low == high:
        return Cut(0.75, 0.0, 1, 0, low)
    margin = min(_MARGIN / (high - low), _MOST_MARGIN)
    smallest = 2.0**-octaves + margin
    start, end = (high, low) if is_reversed else (low, high)
    w1 = (1.0 - margin - smallest) / (end - start)
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


def control_line(low: float, high: float) -> tuple[float, float]:
    """x₀ and x₁ of a cell of the control, with which x runs from -1 to 1."""
    middle = math.sqrt(low * high)
    return middle, 1.0 / logarithmic(high, middle)


def controls_at(x: Floats, middle: Floats, scale: Floats) -> Floats:
    """Controls at coordinates from -1 to 1 in cells."""
    y = x / scale
    return np.asarray(middle * (2.0 * y + np.sqrt(1.0 + 3.0 * y * y)) / (1.0 - y))


def chebyshev(count: int) -> Floats:
    """Interpolation points in (-1, 1)."""
    points: Floats = np.cos(np.pi * (np.arange(count, dtype=float) + 0.5) / count)
    return points


@cache
def to_powers(count: int) -> Floats:
    """Matrix from values at the interpolation points to coefficients of the powers 0, 1, 2..."""
    return np.asarray(np.linalg.inv(np.vander(chebyshev(count), increasing=True)), np.float64)


@cache
def to_chebyshev(count: int) -> Floats:
    """Matrix from values at the interpolation points to coefficients of Chebyshev polynomials."""
    points = np.polynomial.chebyshev.chebvander(chebyshev(count), count - 1)
    return np.asarray(np.linalg.inv(points), np.float64)


def truncated(values: Floats) -> Floats:
    """Values at the interpolation points of the last two axes without the products of high Chebyshev polynomials.

    Of T_i(x) T_j(y) those with i + j below the length of the last axis are kept; the others are as small as what the
    interpolation leaves out along one axis.
    """
    terms_x, terms_y = values.shape[-2:]
    to_x, to_y = (np.polynomial.chebyshev.chebvander(chebyshev(terms), terms - 1) for terms in (terms_x, terms_y))
    coefficients = to_chebyshev(terms_x) @ values @ to_chebyshev(terms_y).T
    coefficients[..., np.add.outer(np.arange(terms_x), np.arange(terms_y)) >= terms_y] = 0.0
    kept: Floats = to_x @ coefficients @ to_y.T
    return kept


def _between(count: int) -> Floats:
    """Places between the interpolation points, where their error is largest; not quite the ends: q = 0 is a fold."""
    places: Floats = 0.98 * np.cos(np.pi * np.arange(count + 1) / count)
    return places


def interpolation_error(values: Callable[[Floats], Floats], points: Points, terms: int) -> Floats:
    """Largest error of the interpolation in cells, for each column of the values at given coordinates."""
    nodes, trials = points(chebyshev(terms)), points(_between(_TRIALS_PER_CELL))
    found = values(np.concatenate([nodes.ravel(), trials.ravel()]))
    at_nodes = found[: nodes.size].reshape(*nodes.shape, -1)
    at_trials = found[nodes.size :].reshape(*trials.shape, -1)
    interpolate = np.vander(_between(_TRIALS_PER_CELL), terms, increasing=True) @ to_powers(terms)
    worst: Floats = np.abs(np.einsum("tn,cnk->ctk", interpolate, at_nodes) - at_trials).max(axis=(0, 1))
    return worst


def choose(error: Callable[[Points], float], low: float, high: float, after: int = 0) -> tuple[Cut, int]:
    """Return the cut with the fewest cells in which the error is below 1, and its number in the list.

    A cut that is not good mostly shows it in one of its two cells at the ends. If even the finest cuts do, none is
    good, and of those with one cell to an octave the first is taken that is almost as good as the best one.
    """
    candidates = _candidates()
    if low == high:
        return cut_of(low, high, *candidates[0]), 0
    if min(error(cut_of(low, high, *finest).end_points) for finest in candidates[-2:]) < 1.0:
        for number, candidate in enumerate(candidates[after:], after):
            cut = cut_of(low, high, *candidate)
            if error(cut.end_points) < 1.0 and error(cut.points) < 1.0:
                return cut, number
    whole = {number: cut_of(low, high, *cut) for number, cut in enumerate(candidates) if cut[1] == 0}
    errors = {number: error(cut.end_points) for number, cut in whole.items()}
    least = min(errors.values())
    number = next(number for number, found in errors.items() if not found > _ALMOST * least)
    return whole[number], number


def octave_of(value: float) -> int:
    """Exponent of the power of two at or below a number."""
    return math.frexp(value)[1] - 1


def shifted_bits(value: float, shift: int) -> int:
    """Leading bits of a floating-point number, which number the cells."""
    return int(np.float64(value).view(np.int64)) >> shift
