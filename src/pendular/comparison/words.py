"""Numbers of the comparison in words, the same in tables, pictures and pages."""

import math

from .sample import NO_BRIDGE

__all__ = ["SYMBOLS", "limit_words", "number", "percent", "range_words", "size_words", "variable_words"]

SYMBOLS = {"suction": "H*", "volume": "V*"}  # of what laws are asked with

_VARIABLES = {
    "suction_star": "H*",
    "volume_star": "V*",
    "contact_angle": "θ",
    "size_ratio": "size ratio",
    "angle_difference": "difference of the angles",
    "separation_star": "D*",
}
_ANGLES = ("contact_angle", "angle_difference")


def percent(error: float, *, signed: bool = True) -> str:
    """Relative error in per cent, with two digits.

    Parameters
    ----------
    error : float
        (law - exact)/exact.
    signed : bool
        Whether a plus is written; if not, it is the size of an error. Exactly -1, or a size of 1, is no bridge.

    Returns
    -------
    str
        A dash for what is not known.

    Examples
    --------
    >>> percent(0.01234), percent(2.468), percent(-1.0), percent(0.5, signed=False), percent(1e-9)
    ('+1.2 %', '+247 %', 'no bridge', '50 %', '+1.0e−7 %')
    """
    if math.isnan(error):
        return "–"
    if error == (NO_BRIDGE if signed else -NO_BRIDGE):
        return "no bridge"
    value = 100.0 * error
    rounded = float(f"{value:.2g}")  # 9.96 has two digits as 10
    sign = "+" if signed else ""
    digits = max(0, 1 - math.floor(math.log10(abs(rounded)))) if rounded else 0
    text = f"{value:{sign}.{digits}f}" if digits < 6 else f"{value:{sign}.1e}".replace("e-0", "e-")
    return text.replace("-", "\N{MINUS SIGN}") + " %"


def number(value: float) -> str:
    """Control or ratio, as short as it can be written: 0.01, 100, 1e4, 1e-5.

    Examples
    --------
    >>> number(0.01), number(100.0), number(1e4), number(1e-5), number(13.7483)
    ('0.01', '100', '1e4', '1e-5', '13.75')
    """
    if value and math.isfinite(value) and not 1e-3 <= abs(value) < 1e4:
        mantissa, exponent = f"{value:.3e}".split("e")
        return f"{float(mantissa):g}e{int(exponent)}"
    return f"{value:.4g}"


def range_words(low: float, high: float) -> str:
    """Range, where an infinite end is none.

    Examples
    --------
    >>> range_words(10.0, 1e4), range_words(10.0, math.inf), range_words(-math.inf, math.inf)
    ('10 to 1e4', '>= 10', 'any')
    """
    if low == high:
        return number(low)
    if math.isinf(high):
        return "any" if math.isinf(low) else f">= {number(low)}"
    return f"{number(low)} to {number(high)}"


def size_words(smaller_over_larger: float) -> str:
    """Ratio of two radii.

    Examples
    --------
    >>> size_words(1.0), size_words(0.25), size_words(0.0)
    ('equal spheres', 'radii 1 : 4', 'sphere on a plane')
    """
    if smaller_over_larger == 1.0:
        return "equal spheres"
    return f"radii 1 : {number(1.0 / smaller_over_larger)}" if smaller_over_larger else "sphere on a plane"


def variable_words(name: str, value: float) -> str:
    """Variable of a law with its value.

    Examples
    --------
    >>> variable_words("suction_star", 13.7483), variable_words("contact_angle", 0.35)
    ('H* = 13.75', 'θ = 20.05°')
    """
    return f"{_VARIABLES[name]} = {number(_degrees(name, value))}{_unit(name)}"


def limit_words(name: str, low: float, high: float) -> str:
    """Range of a variable of a law.

    Examples
    --------
    >>> limit_words("contact_angle", 0.0, math.radians(40.0)), limit_words("suction_star", 1e4, math.inf)
    ('0 to 40°', '>= 1e4')
    """
    return range_words(*(value if math.isinf(value) else _degrees(name, value) for value in (low, high))) + _unit(name)


def _degrees(name: str, value: float) -> float:
    return math.degrees(value) if name in _ANGLES else value


def _unit(name: str) -> str:
    return "°" if name in _ANGLES else ""
