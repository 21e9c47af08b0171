"""Quantities as people write and read them: ``50um`` into SI numbers, and SI numbers into ``50 µm``."""

import math
import re
from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

__all__ = [
    "Forms",
    "Scale",
    "Values",
    "read",
    "read_angle",
    "read_angles",
    "read_fraction",
    "read_fractions",
    "read_values",
    "scale_of",
    "show",
]

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

# Units that are written most for an SI unit: the base, the rest, and its power; the decades of what has no prefix.
_USUAL = {
    "m": [("m", "", 1, 0)],
    "m^3": [("m", "^3", 3, 0), ("L", "", 1, -3), ("l", "", 1, -3)],
    "Pa": [("Pa", "", 1, 0), ("bar", "", 1, 5)],
    "N/m": [("N", "/m", 1, 0)],
    "m^3/mol": [("m", "^3/mol", 3, 0)],
}
_DECADES = {"": 0, "f": -15, "p": -12, "n": -9, "u": -6, "µ": -6, "μ": -6, "m": -3, "c": -2, "k": 3, "M": 6}


Values = float | list[float]  # of one option: a value, or those of a sweep

_POINTS, _MOST_POINTS = 11, 100_000  # of a sweep that does not say how many, and of any


class Forms(NamedTuple):
    """Well-formed values of an option, for the messages."""

    value: str
    sweep: str
    values: str


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
        instead = f"per cent have their sign, {text.strip()}%" if number < 100.0 else "write it like 90% or 0.9"
        raise ValueError(f"{name}: {text!r} is above 1; {instead}")
    return number / 100.0 if own_unit else number


def read_values(name: str, text: str, unit: str, forms: Forms) -> Values:
    """Quantity with its unit, or a sweep of such, as SI numbers.

    Parameters
    ----------
    name : str
        What it is, for the messages.
    text : str
        As for :func:`read`; or ``first:last`` or ``first:last:points`` with equal steps, 11 points if not told, where
        the unit of one end will do for both; or quantities with commas between.
    unit : str
        The SI unit in which it is wanted.
    forms : Forms
        Well-formed quantities of this kind, for the messages.

    Returns
    -------
    float or list of float
        [unit].

    Raises
    ------
    ValueError
        As by :func:`read`, and for a sweep of another form or with less than 2 or more than 100000 points.

    Examples
    --------
    >>> lengths = Forms("1um", "0:8um:5", "1um,2um,5um")
    >>> read_values("separation", "0:8um:5", "m", lengths)
    [0.0, 2e-06, 4e-06, 6e-06, 8e-06]
    >>> read_values("separation", "500nm,1um", "m", lengths), read_values("separation", "1um", "m", lengths)
    ([5e-07, 1e-06], 1e-06)
    """
    return _read_all(name, text, forms, lambda part: read(name, part, unit, forms.value), _sharing_units(name, forms))


def read_fractions(name: str, text: str, forms: Forms) -> Values:
    """Pure number or a sweep of such, as such or in per cent, in the forms of :func:`read_values`.

    Examples
    --------
    >>> read_fractions("humidity", "50%:90%:3", Forms("90%", "50%:90%:5", "50%,90%"))
    [0.5, 0.7, 0.9]
    """

    def ends_of(first: str, last: str) -> tuple[str, str]:
        if ("%" in first) != ("%" in last):  # 0.5:90% might begin at a half or at half a per cent
            raise ValueError(f"{name}: {text!r} has a % at one end only; write it like {forms.sweep}")
        return first, last

    return _read_all(name, text, forms, lambda part: read_fraction(name, part), ends_of)


def read_angles(name: str, text: str, forms: Forms) -> Values:
    """Angle or a sweep of such in degrees, in the forms of :func:`read_values`; a bare number is in degrees already.

    Examples
    --------
    >>> read_angles("half-filling-angle", "10:30:3", Forms("30", "10:60:6", "10deg,20deg"))
    [10.0, 20.0, 30.0]
    """
    return _read_all(name, text, forms, lambda part: read_angle(name, part), _sharing_units(name, forms))


def _sharing_units(name: str, forms: Forms) -> Callable[[str, str], tuple[str, str]]:
    """How the unit of one end of a sweep does for both."""

    def ends_of(first: str, last: str) -> tuple[str, str]:
        own_units = (_split(name, first, forms.value)[1], _split(name, last, forms.value)[1])
        return first + ("" if own_units[0] else own_units[1]), last + ("" if own_units[1] else own_units[0])

    return ends_of


def _read_all(
    name: str,
    text: str,
    forms: Forms,
    read_one: Callable[[str], float],
    ends_of: Callable[[str, str], tuple[str, str]],
) -> Values:
    """Read a value, a sweep or a list; ``ends_of`` gives the ends of a sweep the units that they share."""
    if ":" not in text and "," not in text:
        return read_one(text)
    is_sweep = ":" in text
    parts = [part.strip() for part in text.split(":" if is_sweep else ",")]
    if not all(parts) or (is_sweep and len(parts) > 3) or (is_sweep and "," in text):
        raise ValueError(
            f"{name}: {text!r} is neither a value, {forms.value}, nor a sweep, first:last:points, {forms.sweep}, "
            f"nor a list, {forms.values}"
        )
    if not is_sweep:
        return [_read_listed(name, text, part, forms, read_one) for part in parts]
    last, first = (
        read_one(end) for end in reversed(ends_of(parts[0], parts[1]))
    )  # the last one has the unit, as typed
    steps = (_count(name, text, parts[2], forms) if len(parts) == 3 else _POINTS) - 1
    inner = (float(f"{first + (last - first) * i / steps:.15g}") for i in range(1, steps))
    return [first, *inner, last]


def _read_listed(name: str, text: str, part: str, forms: Forms, read_one: Callable[[str], float]) -> float:
    """Read one of a list; zero has its unit there, too, for 0,5um is rather a half with a comma than two lengths."""
    if forms.value[-1] != "%" and not _split(name, part, forms.value)[1]:
        raise ValueError(
            f"{name}: {part!r} in {text!r} has no unit; write a list like {forms.values}, and decimals with a point"
        )
    return read_one(part)


def _count(name: str, text: str, count: str, forms: Forms) -> int:
    if not count.isdecimal() or not 2 <= int(count) <= _MOST_POINTS:
        raise ValueError(
            f"{name}: {count!r} in {text!r} is not a number of points from 2 to {_MOST_POINTS}; "
            f"write it like {forms.sweep}"
        )
    return int(count)


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
    decades = _usual(unit).get(own_unit)
    if decades is not None:
        in_unit = number * 10.0**decades if decades >= 0 else number / 10.0**-decades
        return float(f"{in_unit:.15g}")
    if unit == "K" and own_unit == "degC":
        return float(f"{number + 273.15:.15g}")
    if unit == own_unit == "deg":
        return number
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
def _usual(unit: str) -> dict[str, int]:
    """Powers of ten of the units that are written most, in an SI unit; pint, which takes a second, knows all others."""
    found = {unit: 0}
    for base, rest, power, decades in _USUAL.get(unit, ()):
        for prefix, exponent in _DECADES.items():
            found[f"{prefix}{base}{rest}"] = power * exponent + decades
    return found


@cache
def _registry() -> Any:
    """Pint's registry: reading its definitions takes most of a second."""
    import pint

    return pint.UnitRegistry()
