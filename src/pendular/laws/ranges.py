"""Where values leave the ranges of the variables of a law."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

__all__ = ["Outside", "first_outside"]

_SLACK = 1e-12  # of an angle of 40° in radians, say


class Outside(NamedTuple):
    """A value outside the range of its variable."""

    name: str
    value: float
    low: float
    high: float


def first_outside(ranges: Mapping[str, tuple[float, float]], asked: Mapping[str, ArrayLike]) -> Outside | None:
    """Find the first variable that leaves its range, if any does; what has no range is not looked at.

    Examples
    --------
    >>> first_outside({"suction_star": (1.0, np.inf)}, {"suction_star": [10.0, 0.5]})
    Outside(name='suction_star', value=0.5, low=1.0, high=inf)
    """
    for name, values in asked.items():
        low, high = ranges.get(name, (-np.inf, np.inf))
        array = np.ravel(np.asarray(values, np.float64))
        bad = array[(array < low - _SLACK * abs(low)) | (array > high + _SLACK * abs(high))]
        if bad.size:
            return Outside(name, float(bad[0]), low, high)
    return None
