"""Where a law says nothing, or is asked outside the range that its authors state."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from ..laws import Law
from ..laws.ranges import first_outside
from .words import limit_words, variable_words

__all__ = ["outside_range", "why_silent"]


def outside_range(law: Law, asked: dict[str, ArrayLike]) -> str:
    """Name the first variable that leaves the stated range of a law; empty if none does.

    Parameters
    ----------
    law : Law
        With the range, `Law.valid`.
    asked : dict
        Values of the variables by their names.

    Examples
    --------
    >>> from pendular.laws import laws
    >>> outside_range(laws["zhao2020"], {"suction_star": [0.5, 10.0], "contact_angle": 0.3})
    'H* = 0.5 is not >= 1'
    """
    return _first_outside(law.valid, asked)


def why_silent(law: Law, asked: dict[str, ArrayLike]) -> str:
    """Give the reason why a law says nothing for some values of its variables.

    Parameters
    ----------
    law : Law
        With limits of its variables, and its rules for two different solids.
    asked : dict
        Values of the variables by their names.

    Examples
    --------
    >>> from pendular.laws import laws
    >>> why_silent(laws["zhao2020"], {"contact_angle": 1.6})
    'θ = 91.67° is not in 0 to 90°'
    """
    limits = {variable.name: (variable.low, variable.high) for variable in law.variables}
    gaps = {name: ends for name, ends in law.valid.items() if name == "separation_star"}
    beyond = _first_outside(limits, asked) or _first_outside(gaps, asked)
    return beyond or f"outside the domain of its formula: {law.angle_rule}; {law.size_rule}"


def _first_outside(ranges: Mapping[str, tuple[float, float]], asked: dict[str, ArrayLike]) -> str:
    outside = first_outside(ranges, asked)
    if outside is None:
        return ""
    name, value, low, high = outside
    inside = "" if np.isinf(high) else "in "
    return f"{variable_words(name, value)} is not {inside}{limit_words(name, low, high)}"
