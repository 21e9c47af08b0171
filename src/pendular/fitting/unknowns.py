"""What may be free in a fit: its unit, what of the question it moves, and the variable in which it is sought.

An angle is sought by its cosine, in which the force is regular at 0; what is positive by its logarithm; a humidity by
the logarithm of its suction; all else in a unit of its own.
"""

import math
from collections.abc import Mapping
from typing import Literal, NamedTuple

from ..ask.domain import DEEPEST_OVERLAP, LEAST_VOLUME, MOST_SUCTION, MOST_VOLUME
from ..ask.liquid import Liquid, suction_from_humidity
from ..ground.check import in_range, scalar

__all__ = ["NAMES", "UNITS", "Kind", "Unknown", "first_offset", "inner", "outer", "slope", "unknown_of"]

Kind = Literal["cosine", "log", "humidity", "linear"]

UNITS = {
    "contact_angle": "rad",
    "contact_angle1": "rad",
    "contact_angle2": "rad",
    "volume": "m^3",
    "suction": "Pa",
    "humidity": "",
    "surface_tension": "N/m",
    "radius": "m",
    "radius1": "m",
    "radius2": "m",
    "offset": "m",
    "force_zero": "N",
    "force_scale": "",
    "base_slope": "N/m",
    "evaporation_rate": "m^3/s",
}
NAMES = tuple(UNITS)

_SINGLE = ("1", "2")
_FARTHEST = 1e3  # of a positive number from its guess, as a factor
_WETS = 1.0 - 1e-12  # cosine of an angle of nothing
_INSIDE = 1.01  # factor from the ends of the domain of the solver, for differences
_STRAIGHT = math.pi * (1.0 - 1e-9)  # largest contact angle


class Unknown(NamedTuple):
    """One number that is free."""

    name: str
    kind: Kind
    moves: tuple[str, ...]  # of the question
    scale: float  # of a linear one, in its unit
    start: float
    low: float
    high: float
    constant: float = 1.0  # of a humidity: its suction is -constant ln h

    @property
    def unit(self) -> str:
        """SI unit."""
        return UNITS[self.name]


def inner(unknown: Unknown, value: float) -> float:
    """The variable in which a value is sought.

    Examples
    --------
    >>> angle = Unknown("contact_angle", "cosine", ("contact_angle1", "contact_angle2"), 1.0, 0.3, 0.0, 3.0)
    >>> inner(angle, 0.0), round(outer(angle, inner(angle, 0.3)), 12)
    (1.0, 0.3)
    """
    if unknown.kind == "cosine":
        return math.cos(value)
    if unknown.kind == "log":
        return math.log(value)
    if unknown.kind == "humidity":
        return math.log(-unknown.constant * math.log(value))
    return value / unknown.scale


def outer(unknown: Unknown, variable: float) -> float:
    """The value of a variable."""
    if unknown.kind == "cosine":
        return 0.0 if variable > _WETS else min(math.acos(max(-1.0, variable)), _STRAIGHT)
    if unknown.kind == "log":
        return math.exp(variable)
    if unknown.kind == "humidity":
        return math.exp(-math.exp(variable) / unknown.constant)
    return variable * unknown.scale


def slope(unknown: Unknown, value: float) -> float:
    """Rate of the value in its variable; infinite for an angle of 0."""
    if unknown.kind == "cosine":
        return -math.inf if value == 0.0 else -1.0 / math.sin(value)
    if unknown.kind == "log":
        return value
    if unknown.kind == "humidity":
        return value * math.log(value)
    return unknown.scale


def unknown_of(
    name: str,
    question: Mapping[str, float],
    liquid: Liquid,
    scales: Mapping[str, float],
    bounds: tuple[float, float] | None,
) -> Unknown:
    """Unknown of a name, from its guess in the question, between the bounds that are given, or where it has a meaning.

    ``scales`` holds a size of each linear one, and ``least``, the smallest separation.
    """
    kind, moves = _kind_of(name), _moved_by(name, question)
    constant = float(suction_from_humidity(math.exp(-1.0), liquid)) if kind == "humidity" else 1.0
    guess = math.exp(-question["suction"] / constant) if kind == "humidity" else question[moves[0]]
    if name == "suction" and not guess > 0.0:
        kind = "linear"
    scale = scales.get(name, abs(guess) or 1.0)
    low, high = _domain(name, kind, guess, question, scales, scale)
    if bounds is not None:
        ends = _pair_of(f"bounds[{name}]", bounds, UNITS[name])
        low, high = max(ends[0], low), min(ends[1], high)
    in_range(name, guess, low, high, unit=UNITS[name])
    if not low < high:
        raise ValueError(f"bounds[{name}]: {bounds!r} leave no room")
    return Unknown(name, kind, moves, scale, guess, low, high, constant)


def _pair_of(name: str, value: object, unit: str) -> tuple[float, float]:
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise ValueError(f"{name}: {value!r} is not a pair (low, high)")
    return scalar(f"{name}[0]", value[0], unit), scalar(f"{name}[1]", value[1], unit)


def _kind_of(name: str) -> Kind:
    if name.startswith("contact_angle"):
        return "cosine"
    if name == "humidity":
        return "humidity"
    if name in ("offset", "force_zero", "base_slope", "evaporation_rate"):
        return "linear"
    return "log"


def _moved_by(name: str, question: Mapping[str, float]) -> tuple[str, ...]:
    """Numbers of the question that an unknown stands for; those of both solids have to be one number."""
    if name == "humidity":
        return ("suction",)
    if name not in ("contact_angle", "radius"):
        if name.startswith("radius") and math.isinf(question[name]):
            raise ValueError(f"free: {name!r} is that of a plane, which is infinite")
        return (name,)
    both = tuple(f"{name}{solid}" for solid in _SINGLE)
    first, second = (question[one] for one in both)
    if name == "radius" and math.isinf(first) != math.isinf(second):
        return (both[0] if math.isinf(second) else both[1],)
    if math.isinf(first) and name == "radius":
        raise ValueError("free: 'radius' is that of two planes, which is infinite")
    if first != second:
        raise ValueError(f"free: {name!r} is {first:.6g} and {second:.6g}; free {both[0]!r} or {both[1]!r}, or both")
    return both


def first_offset(question: Mapping[str, float], scales: Mapping[str, float]) -> float:
    """Guess of an offset: none, or where no bridge is as near, contact at the first point.

    Examples
    --------
    >>> first_offset({"radius1": 1e-6, "radius2": 1e-6}, {"offset": 1e-6, "least": -2e-6})
    2e-06
    """
    return 0.0 if _least_offset(question, scales) <= 0.0 else max(-scales["least"], _least_offset(question, scales))


def _least_offset(question: Mapping[str, float], scales: Mapping[str, float]) -> float:
    """The offset at which the first point is as near as bridges are known."""
    smaller, span = min(question["radius1"], question["radius2"]), scales["offset"]
    closest = scales.get("closest")
    if closest is None:
        closest = -0.99 * DEEPEST_OVERLAP * smaller if math.isfinite(smaller) else 1e-3 * span
    return max(closest - scales["least"], -10.0 * span - abs(scales["least"]))


def _domain(
    name: str, kind: Kind, guess: float, question: Mapping[str, float], scales: Mapping[str, float], scale: float
) -> tuple[float, float]:
    """Where a value has a meaning and the solver an answer."""
    if kind == "cosine":
        return 0.0, _STRAIGHT
    if kind == "humidity":
        return 1e-6, 1.0 - 1e-12
    smaller = min(question["radius1"], question["radius2"])
    if name == "offset":
        return _least_offset(question, scales), 10.0 * scale + max(-scales["least"], 0.0)
    if kind == "linear":
        return -100.0 * scale, 100.0 * scale
    low, high = guess / _FARTHEST, guess * _FARTHEST
    if math.isfinite(smaller):
        mean = 2.0 / (1.0 / question["radius1"] + 1.0 / question["radius2"])
        if name == "volume":
            low, high = max(low, _INSIDE * LEAST_VOLUME * mean**3), min(high, MOST_VOLUME * mean**3 / _INSIDE)
        if name == "suction":
            high = min(high, MOST_SUCTION * question["surface_tension"] / mean / _INSIDE)
    return low, high
