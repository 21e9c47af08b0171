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
from . import rules

__all__ = ["NAMES", "Kind", "Unknown", "first_offset", "inner", "outer", "slope", "unknown_of"]

Kind = Literal["cosine", "log", "humidity", "linear"]

NAMES = tuple(rules.UNITS)

_SINGLE = ("1", "2")


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
        return rules.UNITS[self.name]


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
        return 0.0 if variable > rules.WETS else min(math.acos(max(-1.0, variable)), rules.STRAIGHT)
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
        ends = _pair_of(f"bounds[{name}]", bounds, rules.UNITS[name])
        low, high = max(ends[0], low), min(ends[1], high)
    in_range(name, guess, low, high, unit=rules.UNITS[name])
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
        closest = (
            -rules.JUST_TOUCHING * DEEPEST_OVERLAP * smaller if math.isfinite(smaller) else rules.PLANES_APART * span
        )
    return max(closest - scales["least"], -rules.FARTHEST_OFFSET * span - abs(scales["least"]))


def _domain(
    name: str, kind: Kind, guess: float, question: Mapping[str, float], scales: Mapping[str, float], scale: float
) -> tuple[float, float]:
    """Where a value has a meaning and the solver an answer."""
    if kind == "cosine":
        return 0.0, rules.STRAIGHT
    if kind == "humidity":
        return rules.HUMIDITIES
    smaller = min(question["radius1"], question["radius2"])
    if name == "offset":
        return _least_offset(question, scales), rules.FARTHEST_OFFSET * scale + max(-scales["least"], 0.0)
    if kind == "linear":
        return -rules.FARTHEST_LINEAR * scale, rules.FARTHEST_LINEAR * scale
    low, high = guess / rules.FARTHEST, guess * rules.FARTHEST
    if math.isfinite(smaller):
        mean = 2.0 / (1.0 / question["radius1"] + 1.0 / question["radius2"])
        if name == "volume":
            low, high = max(low, rules.INSIDE * LEAST_VOLUME * mean**3), min(high, MOST_VOLUME * mean**3 / rules.INSIDE)
        if name == "suction":
            high = min(high, MOST_SUCTION * question["surface_tension"] / mean / rules.INSIDE)
    return low, high
