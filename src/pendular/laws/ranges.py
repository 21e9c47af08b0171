"""Which questions a law does not cover, and where they leave the ranges of its variables."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._record import Law, Quantity

__all__ = ["Outside", "Uncovered", "asked_ranges", "asked_solids", "first_outside", "first_uncovered"]

_SLACK = 1e-12  # of an angle of 40° in radians, say

Floats = NDArray[np.float64]


class Outside(NamedTuple):
    """A value outside the range of its variable."""

    name: str
    value: float
    low: float
    high: float


class Uncovered(NamedTuple):
    """Two solids of which a law does not speak."""

    argument: str  # of `Pair`
    value: str
    rule: str  # what the law covers


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


def first_uncovered(
    law: Law, quantity: Quantity, contact_angle1: ArrayLike, contact_angle2: ArrayLike, size_ratio: ArrayLike
) -> Uncovered | None:
    """Find the first two solids of which a law does not speak, if there are any.

    Examples
    --------
    >>> from pendular.laws import laws
    >>> first_uncovered(laws["zhao2020"], "force", 0.2, 0.3, 1.0)
    Uncovered(argument='contact_angle', value='(0.2, 0.3) rad', rule='equal angles only')
    >>> first_uncovered(laws["zhao2020"], "force", 0.2, 0.2, np.inf) is None
    True
    """
    solids = law.solids[quantity]
    first, second, ratio = (
        np.ravel(values) for values in np.broadcast_arrays(contact_angle1, contact_angle2, size_ratio)
    )
    (limits,) = (variable for variable in law.variables if variable.name == "contact_angle")
    beyond = (np.minimum(first, second) < limits.low) | (np.maximum(first, second) >= limits.high)
    checks = [
        (beyond, "contact_angle", f"angles from {limits.low:g} to below {limits.high:.6g} rad"),
        ((first != second) & (solids.angles in ("equal", "zero")), "contact_angle", solids.angle_words),
        ((first != 0.0) & (solids.angles == "zero"), "contact_angle", solids.angle_words),
        (np.isinf(ratio) & (solids.plane == "none"), "radius", solids.size_words),
    ]
    for is_uncovered, argument, rule in checks:
        if np.any(is_uncovered):
            row = int(np.argmax(is_uncovered))
            angles = f"({first[row]:.6g}, {second[row]:.6g}) rad"
            return Uncovered(argument, angles if argument == "contact_angle" else "inf, a plane,", rule)
    return None


def asked_ranges(law: Law) -> dict[str, tuple[float, float]]:
    """Ranges in which a law answers without a warning: the stated ones, and solids that it need not take as equal."""
    return {"size_ratio": (1.0, 1.0), "angle_difference": (0.0, 0.0), **law.valid}


def asked_solids(
    law: Law, quantity: Quantity, contact_angle1: ArrayLike, contact_angle2: ArrayLike, size_ratio: ArrayLike
) -> dict[str, Floats]:
    """Values of the variables of `asked_ranges` for pairs; a ratio and a difference that a law knows do not count.

    Examples
    --------
    >>> from pendular.laws import laws
    >>> asked_solids(laws["lambert2008"], "force", [0.0], [0.5], [2.0])["angle_difference"]
    array([0.5])
    >>> asked_solids(laws["asymptotic"], "force", [0.0], [0.5], [2.0])["angle_difference"]
    array([0.])
    """
    solids = law.solids[quantity]
    first, second, ratio = (np.asarray(value, np.float64) for value in (contact_angle1, contact_angle2, size_ratio))
    is_mean = np.where(np.isinf(ratio), solids.plane == "mean", solids.spheres == "mean") | ("size_ratio" in law.valid)
    return {
        "contact_angle": np.stack(np.broadcast_arrays(first, second)),
        "size_ratio": np.where(is_mean, ratio, 1.0),
        "angle_difference": np.abs(first - second) * solids.angles.startswith("mean"),
    }
