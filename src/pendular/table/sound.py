"""Whether what was read from a file is a table: compiled kernels do not look whether a cell is there."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .kernels import CELLS, Q0, Q1, Q_COUNT, Q_FIRST, Q_SHIFT, SIZE_CELLS, U0, U1, U_COUNT, U_FIRST, U_SHIFT, X0, X1
from .polynomial import CELL, RUPTURE_CELL

__all__ = ["CUT", "LINE", "MOST_ROWS", "Unsound", "refuse_unsound", "require"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

LINE, CUT = 6, 8  # numbers of a row
MOST_ROWS = 1 << 24
_MOST_NUMBER = 1e38  # which single precision holds
_LEAST_SHIFT, _MOST_SHIFT, _EXPONENTS = 33, 52, 2047
_RATIO_LIMIT, _ANGLE_LIMIT = 1.001, 3.1415926535898  # a little above 1 and π
_CUTS = "has cells that do not cover its range one after another"


class Unsound(ValueError):
    """What is wrong with a file, as the end of a sentence."""


def require(is_so: object, fault: str) -> None:
    """Refuse a file for a fault."""
    if not is_so:
        raise Unsound(fault)


def refuse_unsound(description: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Refuse a description and arrays that are none of a table."""
    theta = np.array(description["contact_angle"], float)
    low, high = (float(end) for end in description["reduced"])
    ratio = [float(end) for end in description["radius_ratio"]]
    least, most, least_ratio, largest_ratio = (float(end) for end in description["range"])
    errors, (shift, first, rows) = [float(error) for error in description["bound"]], description["cut"]
    require(
        theta.shape == (2,)
        and np.all((theta >= 0.0) & (theta < _ANGLE_LIMIT))
        and 0.0 < low <= high < math.inf
        and 1.0 <= ratio[0] <= ratio[1]
        and 0.0 < least <= most < math.inf
        and 0.0 <= least_ratio <= largest_ratio < _RATIO_LIMIT
        and 0.0 < float(description["tolerance"]) < 1.0
        and len(errors) == 4
        and all(error >= 0.0 for error in errors)
        and all(isinstance(number, int) for number in (shift, first, rows))
        and 1 <= rows <= MOST_ROWS,
        "has a number in its header that is out of range",
    )
    lines, cuts, sides = arrays["lines"], arrays["cuts"], 1 if theta[0] == theta[1] else 2
    coefficients = [arrays[name] for name in ("rupture", "force", "liquid")]
    cells = [array.size // size for array, size in zip(coefficients, (RUPTURE_CELL, CELL, CELL), strict=True)]
    are_laid_out = (
        (lines.shape, cuts.shape) == ((sides * rows, LINE), (sides * rows, CUT))
        and cuts.dtype == np.int64
        and all(array.dtype == np.float64 for array in (lines, *coefficients))
        and [array.shape for array in coefficients] == [(cells[0] * RUPTURE_CELL,), *2 * [(cells[1] * CELL,)]]
    )
    require(are_laid_out, "has arrays that are not laid out as it says")
    require(all(np.isfinite(array).all() for array in (lines, *coefficients)), "has a number that is not finite")
    most = max(np.abs(array).max(initial=0.0) for array in coefficients)
    require(most < _MOST_NUMBER, f"has a coefficient of {most:g}, too large for any bridge")
    _refuse_wrong_cuts(description, lines, cuts, (cells[0], cells[1]))


def _cell(w: Floats, shift: Integers, first: Integers) -> Integers:
    """Cell of positive numbers, -1 of others."""
    return np.where(w > 0.0, (w.view(np.int64) >> shift) - first, -1)


def _are_cuts(shift: Integers, first: Integers, count: Integers) -> np.bool_:
    """Whether bits from first on, shifted, are ends of so many cells, all of them finite and positive numbers."""
    is_cut = (shift >= _LEAST_SHIFT) & (shift <= _MOST_SHIFT) & (first >= 0) & (count >= 1)
    octaves = _EXPONENTS << (_MOST_SHIFT - np.clip(shift, _LEAST_SHIFT, _MOST_SHIFT))
    return np.all(is_cut & (first < octaves) & (count < octaves - first))


def _refuse_wrong_cuts(description: Mapping[str, Any], lines: Floats, cuts: Integers, cells: tuple[int, int]) -> None:
    """Each row shares the cells of the one before, or begins where that ends, and covers the sizes and all q."""
    shift, first, rows = (np.array([number], np.int64) for number in description["cut"])
    parts = [cuts[:, [U_SHIFT, U_FIRST, U_COUNT]].T, cuts[:, [Q_SHIFT, Q_FIRST, Q_COUNT]].T]
    is_right = _are_cuts(shift, first, rows) and all(_are_cuts(*part) for part in parts)
    require(is_right, _CUTS)
    ends = np.array(description["range"], float)
    control = _cell(ends[:2], shift, first)
    s = (1.0 - ends[2:]) / (1.0 + ends[2:])
    power = 1.0 if len(lines) > rows else 2.0 / 3.0 if description["control"] == "volume" else 2.0
    sizes = np.abs(s) ** power  # by rounding s may be a little below 0
    w_sizes = lines[:, U0, None] + lines[:, U1, None] * sizes
    w_q = lines[:, Q0, None] + lines[:, Q1, None] * np.array([0.0, 1.0])
    is_right = np.all((control >= 0) & (control < rows))
    for w, (w_shift, w_first, count) in zip((w_sizes, w_q), parts, strict=True):
        cell = _cell(w, w_shift[:, None], w_first[:, None])
        is_right &= np.all((cell >= 0) & (cell < count[:, None]))
    is_right &= np.all((lines[:, Q1] != 0.0) & (lines[:, X0] > 0.0) & (lines[:, X1] >= 0.0))
    is_shared = np.concatenate([[False], (cuts[1:] == cuts[:-1]).all(axis=1)])
    own = cuts[~is_shared]
    counts = np.column_stack([own[:, U_COUNT], own[:, U_COUNT] * own[:, Q_COUNT]])
    starts = np.concatenate([[[0, 0]], np.cumsum(counts, axis=0)])
    is_right &= np.array_equal(own[:, [SIZE_CELLS, CELLS]], starts[:-1])
    is_right &= np.array_equal(starts[-1], cells)
    require(is_right, _CUTS)
