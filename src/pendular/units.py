"""Quantities as people write and read them: ``50um`` into SI numbers, and SI numbers into ``50 µm``."""

import math
import re
from functools import cache
from typing import Any, NamedTuple

__all__ = ["Scale", "read", "read_angle", "read_fraction", "scale_of", "show"]

_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[+-]?inf|nan)\s*(.*?)\s*", re.IGNORECASE)
_PREFIXES = {-24: "y", -21: "z", -18: "a", -15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}

# SI units as they are shown: the base that carries the prefix, the rest, its power, and its size in the SI unit.
_SHOWN = {
    "m": ("m", "", 1, 1.0),
    "m^2": ("m", "²", 2, 1.0),
    "m^3": ("L", "", 1, 1e-3),  # a picolitre is easier to imagine than a thousand cubic micrometres
    "Pa": ("Pa", "", 1, 1.0),
    "N": ("N", "", 1, 1.0),
    "N/m": ("N", "/m", 1, 1.0),
    "J": ("J", "", 1, 1.0),
}


class Scale(NamedTuple):
    """A unit with an SI prefix, and the factor that brings SI numbers into it."""

    factor: float
    unit: str


def read(name: str, text: str, unit: str, example: str) -> float:
    """Quantity with its unit as an SI number.

    Parameters
    ----------
    name : str
        What it is, for the messages.
    text : str
        A number and a unit, with or without a space; zero needs no unit, but for a temperature.
    unit : str
        The SI unit in which it is wanted.
    example : str
        A well-formed quantity of this kind, for the messages.

    Returns
    -------
    float
        [unit].

    Raises
    ------
    ValueError
        If there is no number, no unit, an unknown unit or one of another dimension.

    Examples
    --------
    >>> read("radius", "50um", "m", "50um"), read("temperature", "25 degC", "K", "25degC")
    (5e-05, 298.15)
    >>> read("separation", "0", "m", "1um")
    0.0
    >>> read("radius", "50", "m", "50um")
    Traceback (most recent call last):
        ...
    ValueError: radius: '50' has no unit; write it like 50um
    """
    number, own_unit = _split(name, text, example)
    if not own_unit:
        if number == 0.0 and unit != "K":  # the same in all units, but for temperatures
            return 0.0
        raise ValueError(f"{name}: {text!r} has no unit; write it like {example}")
    return _convert(name, text, number, own_unit, unit, example)


def read_angle(name: str, text: str) -> float:
    """Angle in degrees, where a bare number is in degrees already.

    Examples
    --------
    >>> read_angle("contact-angle", "20"), round(read_angle("contact-angle", "0.35 rad"), 3)
    (20.0, 20.054)
    """
    number, own_unit = _split(name, text, "20deg")
    return number if not own_unit else _convert(name, text, number, own_unit, "deg", "20deg")


def read_fraction(name: str, text: str) -> float:
    """Pure number, as such or in per cent.

    Examples
    --------
    >>> read_fraction("humidity", "90%"), read_fraction("humidity", "0.9")
    (0.9, 0.9)
    """
    number, own_unit = _split(name, text, "90%")
    if own_unit not in ("", "%"):
        raise ValueError(f"{name}: {text!r} is not a pure number; write it like 90% or 0.9")
    if not own_unit and number > 1.0:
        raise ValueError(f"{name}: {text!r} is above 1; write it like 90% or 0.9")
    return number / 100.0 if own_unit else number


def scale_of(value: float, unit: str) -> Scale:
    """Unit with the SI prefix in which a value is a number from 1 to 1000, or nearly so.

    Parameters
    ----------
    value : float
        A typical or the largest value, [unit].
    unit : str
        SI unit; volumes are shown in litres, and what has no prefix keeps its own.

    Returns
    -------
    Scale
        SI number times ``factor`` is the number in ``unit``.

    Examples
    --------
    >>> scale_of(5e-5, "m")
    Scale(factor=1000000.0, unit='µm')
    """
    if unit not in _SHOWN:
        return Scale(180.0 / math.pi, "°") if unit == "rad" else Scale(1.0, unit)
    base, rest, power, size = _SHOWN[unit]
    amount = abs(value) / size
    decades = math.log10(amount) if math.isfinite(amount) and amount > 0.0 else 0.0
    # Of a value that rounds up to 1000 the next prefix is meant.
    exponent = 3 * math.floor((decades + 1e-9) / (3 * power))
    exponent = min(max(exponent, min(_PREFIXES)), max(_PREFIXES))
    return Scale(10.0 ** (-exponent * power) / size, _PREFIXES[exponent] + base + rest)


def show(value: float, unit: str, digits: int = 5) -> str:
    """Value with unit and SI prefix, for people.

    Parameters
    ----------
    value : float
        [unit].
    unit : str
        SI unit; radians are shown in degrees.
    digits : int
        Significant digits.

    Returns
    -------
    str
        A dash for what is not a number.

    Examples
    --------
    >>> show(1.3e-15, "m^3"), show(-2.5e-6, "N"), show(0.0, "N")
    ('1.3 pL', '-2.5 µN', '0 N')
    """
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return f"{value}"
    rounded = float(f"{value:.{digits}g}")
    factor, shown_unit = scale_of(rounded, unit)
    number = _plain_digits(rounded * factor, digits)
    return number + shown_unit if shown_unit == "°" else f"{number} {shown_unit}".rstrip()


def _plain_digits(number: float, digits: int) -> str:
    """Shortest text of a number with so many digits, without an exponent where that stays short."""
    text = f"{number:.{digits}g}"
    return f"{float(text):.0f}" if "e+" in text and abs(number) < 1e9 else text


def _split(name: str, text: str, example: str) -> tuple[float, str]:
    match = _NUMBER.fullmatch(text)
    if match is None:
        raise ValueError(f"{name}: {text!r} does not begin with a number; write it like {example}")
    return float(match[1]), match[2]


def _convert(name: str, text: str, number: float, own_unit: str, unit: str, example: str) -> float:
    import pint

    try:
        converted = float(_registry().Quantity(number, own_unit).to(unit).magnitude)
        return float(f"{converted:.15g}")  # 50 µm are 5e-05 m, not 4.9999999999999996e-05
    except pint.DimensionalityError:
        reason = f"is not a quantity in {unit}"
    except Exception:  # pint's parser lets errors of several kinds through, also of Python's own
        reason = f"has the unknown unit {own_unit!r}"
    raise ValueError(f"{name}: {text!r} {reason}; write it like {example}")


@cache
def _registry() -> Any:
    """Pint's registry: reading its definitions takes most of a second."""
    import pint

    return pint.UnitRegistry()
