"""Where a function changes its sign, closed in by the Illinois rule.

A secant through both ends; an end that stays for a second time counts half, so that both move. Source: M. Dowell and
P. Jarratt, BIT 11 (1971) 168, https://doi.org/10.1007/BF01934364.
"""

from typing import NamedTuple

from ..ground.compile import kernel

MOST_NARROWINGS = 80
_NARROWEST = 1e-14  # of its upper end


class Bracket(NamedTuple):
    """Two lengths, and values of opposite signs there or parts of them."""

    low: float
    high: float
    at_low: float
    at_high: float
    side: int = 0  # of the end that moved last: 1 for the lower, -1 for the upper


@kernel
def secant_of(bracket: Bracket) -> float:
    """Where the secant vanishes."""
    low, high, at_low, at_high, _side = bracket
    return low + (high - low) * at_low / (at_low - at_high)


@kernel
def narrowed(bracket: Bracket, middle: float, value: float) -> Bracket:
    """A bracket with an end moved to a length between its ends."""
    low, high, at_low, at_high, side = bracket
    if (value > 0.0) == (at_low > 0.0):
        return Bracket(middle, high, value, at_high * (0.5 if side > 0 else 1.0), 1)
    return Bracket(low, middle, at_low * (0.5 if side < 0 else 1.0), value, -1)


@kernel
def is_narrow(bracket: Bracket) -> bool:
    """Whether a bracket is as narrow as numbers are apart, about."""
    return bracket.high - bracket.low < _NARROWEST * bracket.high
