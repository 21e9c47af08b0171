"""Sliders: which value belongs to a position, and how it is written in the field beside it."""

import math
from typing import Literal, NamedTuple

from ...ask.liquid import humidity_from_suction
from ...ground.units import show
from ...show.text import UNITS
from .answer import Answer

__all__ = ["Track", "held_instead", "track_of", "value_of", "written"]

_ZERO_CELSIUS = 273.15  # [K]
_UNITS = {**UNITS, "radius": "m", "radius2": "m", "surface_tension": "N/m"}


class Track(NamedTuple):
    """A slider from one value to another in equal steps of the value, of its logarithm, or of that of 1 - value."""

    low: float
    high: float
    steps: int
    spacing: Literal["linear", "logarithmic", "complement"] = "linear"

    def value(self, position: float) -> float:
        """Value at a position, 0 to ``steps``.

        Examples
        --------
        >>> Track(10.0, 1e5, 400, "logarithmic").value(100)
        100.0
        """
        part = position / self.steps
        if self.spacing == "linear":
            return self.low + (self.high - self.low) * part
        if self.spacing == "logarithmic":
            return self.low * math.pow(self.high / self.low, part)
        return 1.0 - (1.0 - self.low) * math.pow((1.0 - self.high) / (1.0 - self.low), part)

    def position(self, value: float) -> float:
        """Position of a value; one beyond an end has its thumb at the end.

        Examples
        --------
        >>> Track(10.0, 1e5, 400, "logarithmic").position(-1.0)
        0.0
        """
        if value <= self.low or not value < self.high:
            return 0.0 if value <= self.low else float(self.steps)
        if self.spacing == "linear":
            part = (value - self.low) / (self.high - self.low)
        elif self.spacing == "logarithmic":
            part = math.log(value / self.low) / math.log(self.high / self.low)
        else:
            part = math.log((1.0 - value) / (1.0 - self.low)) / math.log((1.0 - self.high) / (1.0 - self.low))
        return part * self.steps


_RADIUS = Track(1e-8, 1e-2, 600, "logarithmic")
_ANGLE = Track(0.0, 170.0, 170)
_FIXED = {
    "radius": _RADIUS,
    "radius2": _RADIUS,
    "contact_angle": _ANGLE,
    "contact_angle2": _ANGLE,
    "temperature": Track(_ZERO_CELSIUS, _ZERO_CELSIUS + 100.0, 200),
    "surface_tension": Track(1e-3, 1.0, 300, "logarithmic"),
    "suction": Track(10.0, 1e8, 350, "logarithmic"),
    "humidity": Track(0.5, 1.0 - 1e-6, 285, "complement"),
}
_VOLUME_STAR = 1e-8, 1.0  # over the cube of the Derjaguin radius
_BETWEEN_PLANES = 0.1, 1e5  # over the cube of the gap
_BEYOND = 1.25  # over the rupture distance
_NO_RUPTURE_STAR = 0.2  # over the Derjaguin radius, where solids hold no bridge apart


def track_of(name: str, answer: Answer) -> Track:
    """Slider of a field, or of a control; those of volume and separation depend on what is shown."""
    if name in _FIXED:
        return _FIXED[name]
    mean_radius = float(answer.question.pair.derjaguin_radius)
    if name == "volume":
        are_planes = math.isinf(mean_radius)
        (low, high), unit = (_BETWEEN_PLANES, answer.separation) if are_planes else (_VOLUME_STAR, mean_radius)
        return Track(low * unit**3, high * unit**3, 320, "logarithmic")
    end = answer.rupture
    return Track(0.0, _BEYOND * float(end.separation) if end.exists else _NO_RUPTURE_STAR * mean_radius, 250)


def value_of(name: str, answer: Answer) -> float:
    """Value of a field, or of the control, in the unit of its slider."""
    pair, liquid = answer.question.pair, answer.question.liquid
    (radius1, radius2), (angle1, angle2) = pair.radii, pair.contact_angles
    values: dict[str, float] = {
        "radius": float(radius1),
        "radius2": float(radius2),
        "contact_angle": math.degrees(angle1),
        "contact_angle2": math.degrees(angle2),
        "temperature": liquid.temperature or _ZERO_CELSIUS,
        "surface_tension": liquid.surface_tension,
        "separation": answer.separation,
        **answer.question.held,
    }
    return values[name]


def held_instead(control: str, answer: Answer) -> float:
    """Value of another control at which the bridge is the same; the middle of its slider if there is no bridge."""
    state = answer.state
    if not state.exists or (control == "humidity" and not state.suction > 0.0):
        track = track_of(control, answer)
        return track.value(track.steps // 2)
    if control == "humidity":
        return float(humidity_from_suction(state.suction, answer.question.liquid))
    return float(getattr(state, control))


def written(name: str, value: float, digits: int = 3) -> str:
    """Value of a field, or of a control, as a person would write it into the field.

    Examples
    --------
    >>> written("radius", 5.0119e-5), written("humidity", 0.99876543), written("temperature", 298.15)
    ('50.1 µm', '99.877 %', '25 °C')
    """
    if name == "humidity":
        dryness = float(f"{1.0 - value:.{digits}g}")
        return f"{100.0 * (1.0 - dryness):.12g} %"
    if name == "temperature":
        return f"{value - _ZERO_CELSIUS:.4g} °C"
    if name.startswith("contact_angle"):
        return f"{value:.4g}°"
    return show(value, _UNITS[name], digits)
