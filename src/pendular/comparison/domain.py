"""Where a law says nothing, or is asked outside the range that its authors state."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from ..laws import Law, Quantity
from ..laws.ranges import asked_ranges, asked_solids, first_outside, first_uncovered
from .words import limit_words, variable_words

__all__ = ["outside_range", "why_silent"]


def outside_range(law: Law, asked: dict[str, ArrayLike]) -> str:
    """Name the first variable that leaves the stated range of a law; empty if none does.

    Parameters
    ----------
    law : Law
        With the range, `Law.valid`, and its means of two solids that differ.
    asked : dict
        Values of the variables by their names, the two contact angles as a pair of numbers.

    Examples
    --------
    >>> from pendular.laws import laws
    >>> outside_range(laws["zhao2020"], {"suction_star": [0.5, 10.0], "contact_angle": (0.3, 0.3), "size_ratio": 1.0})
    'H* = 0.5 is not >= 1'
    >>> outside_range(laws["lian1993"], {"volume_star": 0.01, "contact_angle": (0.3, 0.3), "size_ratio": 2.0})
    'size ratio = 2 is not 1'
    """
    solids = asked_solids(law, law.gives[0], *_solids(asked))
    return _first_outside(asked_ranges(law), {**asked, **solids})


def why_silent(law: Law, asked: dict[str, ArrayLike], quantity: Quantity) -> str:
    """Give the reason why a law says nothing for some values of its variables.

    Parameters
    ----------
    law : Law
        With limits of its variables, and the solids that it covers.
    asked : dict
        Values of the variables by their names, the two contact angles as a pair of numbers.
    quantity : {"force", "rupture", "rupture_work"}
        Of which the law says nothing.

    Examples
    --------
    >>> from pendular.laws import laws
    >>> why_silent(laws["zhao2020"], {"contact_angle": (0.2, 0.3), "size_ratio": 1.0}, "force")
    'for equal angles only'
    """
    uncovered = first_uncovered(law, quantity, *_solids(asked))
    if uncovered is not None:
        return f"for {uncovered.rule}"
    limits = {variable.name: (variable.low, variable.high) for variable in law.variables}
    gaps = {name: ends for name, ends in law.valid.items() if name == "separation_star"}
    return _first_outside(limits, asked) or _first_outside(gaps, asked) or "outside the domain of its formula"


def _solids(asked: dict[str, ArrayLike]) -> tuple[ArrayLike, ArrayLike, ArrayLike]:
    first, second = np.asarray(asked["contact_angle"])
    return first, second, asked["size_ratio"]


def _first_outside(ranges: Mapping[str, tuple[float, float]], asked: Mapping[str, ArrayLike]) -> str:
    outside = first_outside(ranges, asked)
    if outside is None:
        return ""
    name, value, low, high = outside
    inside = "" if low == high or np.isinf(high) else "in "
    return f"{variable_words(name, value)} is not {inside}{limit_words(name, low, high)}"
