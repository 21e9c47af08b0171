"""The options that all commands share, read into what they ask: a pair, a liquid, and what is held constant."""

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from typer import Option

from .units import read, read_angle, read_fraction, show

# NumPy and all that needs it are imported by those who use it: the help is shown without.
if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from .bridges import Bridge, Pair
    from .liquid import Liquid

__all__ = ["Question", "in_terms_of_options", "read_form", "read_question"]

_PLANE = ("inf", "plane", "plate")
_ROOM_TEMPERATURE = "20degC"
_FREEZING_POINT = 273.15  # 0 °C, [K]

# Where the library calls an argument otherwise than the option, and what it advises to a programmer.
_OPTIONS = {"radius[0]": "radius", "radius[1]": "radius2", "surface_tension": "surface-tension", "name": "liquid"}
_ADVICE = re.compile(r"; give (it|its numbers) to Liquid\(\.\.\.\)")


class Question(NamedTuple):
    """What is asked by the options that all commands share."""

    pair: "Pair"
    liquid: "Liquid"
    control: dict[str, float]  # suction, volume or humidity, and its SI value
    title: str
    subtitle: str
    form: str  # of the answer: table, json or csv
    picture: Path | None

    def put_to(self, function: "Callable[..., Bridge]", *args: "ArrayLike", **options: Any) -> "Bridge":
        """Ask one of the three functions of the library."""
        return function(self.pair, *args, **self.control, liquid=self.liquid, **options)

    def instability(self, end: "Bridge") -> "Bridge | None":
        """Where the bridge loses its stability, if that is before the fold `end`: at constant volume only."""
        from .bridges import rupture

        if "volume" not in self.control:
            return None
        first = self.put_to(rupture, limit="stability")
        # Where nothing comes first both are the same point, found along two ways.
        return first if first.separation < end.separation * (1.0 - 1e-9) else None

    def draw(
        self, end: "Bridge", state: "Bridge | None" = None, separation: float = 0.0, *, stacked: bool = False
    ) -> "Figure":
        """Picture of the pair and its force curve, with the state if there is one, else as the pair ruptures."""
        from .bridges import curve
        from .plot import figure

        return figure(
            self.pair,
            state,
            self.put_to(curve),
            end,
            separation=separation,
            instability=self.instability(end),
            title=self.title,
            subtitle=self.subtitle,
            stacked=stacked,
        )


def _text(help_text: str, kind: str) -> Any:
    return Option(help=help_text, metavar=kind)


def read_question(
    radius: Annotated[str, _text("Radius of both solids, or of the first: 50um.", "LENGTH")],
    radius2: Annotated[str | None, _text("Radius of the second solid: 5um, or plane.", "LENGTH")] = None,
    contact_angle: Annotated[str, _text("Contact angle: 20 or 20deg, 0.35rad.", "ANGLE")] = "0",
    contact_angle2: Annotated[str | None, _text("Contact angle on the second solid, if another: 60.", "ANGLE")] = None,
    suction: Annotated[str | None, _text("Held constant: gas minus liquid pressure, 20kPa,", "PRESSURE")] = None,
    volume: Annotated[str | None, _text("or volume of the liquid, 5pL or 5000um^3,", "VOLUME")] = None,
    humidity: Annotated[str | None, _text("or relative humidity, 90% or 0.9.", "FRACTION")] = None,
    liquid: Annotated[str | None, _text("Liquid: ethanol; if not given, water.", "NAME")] = None,
    temperature: Annotated[str | None, _text("Of the liquid: 25degC; if not given, 20degC.", "TEMPERATURE")] = None,
    surface_tension: Annotated[str | None, _text("Instead of the name of a liquid: 72.8mN/m.", "TENSION")] = None,
    as_json: Annotated[bool, Option("--json", help="Print JSON, in SI units.")] = False,
    as_csv: Annotated[bool, Option("--csv", help="Print CSV, in SI units.")] = False,
    plot: Annotated[
        Path | None, Option(help="Draw a picture of the answer: bridge.svg, .png or .pdf.", metavar="FILE")
    ] = None,
) -> Question:
    """Read the shared options, with one line of error for what cannot be meant."""
    from .bridges import Pair

    form = read_form(as_json, as_csv, plot)
    radii = _radius("radius", radius), _radius("radius2", radius if radius2 is None else radius2)
    second = contact_angle if contact_angle2 is None else contact_angle2
    degrees = _degrees("contact-angle", contact_angle), _degrees("contact-angle2", second)
    control = _control(suction, volume, humidity)
    if humidity is not None and surface_tension is not None:
        raise ValueError("surface-tension: not enough for humidity, which needs the density of a liquid given by name")
    wetting = _liquid(liquid, temperature, surface_tension)
    return Question(
        pair=Pair(radii, (math.radians(degrees[0]), math.radians(degrees[1]))),
        liquid=wetting,
        control=control,
        title=_describe_solids(radii, degrees),
        subtitle=f"{_describe_liquid(wetting)}  ·  {_describe_control(control)}",
        form=form,
        picture=plot,
    )


def in_terms_of_options(message: str) -> str:
    """Message of the library as one who knows only the options understands it.

    Examples
    --------
    >>> in_terms_of_options("radius[1]: -1.0 m is not > 0")
    'radius2: -1.0 m is not > 0'
    """
    name, colon, reason = message.partition(": ")
    return _OPTIONS.get(name, name) + colon + _ADVICE.sub("", reason)


def read_form(as_json: bool, as_csv: bool, plot: Path | None) -> str:
    """Form of the answer: table, json or csv; a picture must be of a known format."""
    if as_json and as_csv:
        raise ValueError("json: given together with csv; one of the two is needed")
    if plot is not None:
        from .plot import FORMATS

        if plot.suffix.lower() not in FORMATS:
            raise ValueError(f"plot: '{plot}' does not end in one of {', '.join(FORMATS)}")
    return "json" if as_json else "csv" if as_csv else "table"


def _radius(name: str, text: str) -> float:
    return math.inf if text.strip().lower() in _PLANE else read(name, text, "m", "50um")


def _degrees(name: str, text: str) -> float:
    degrees = read_angle(name, text)
    if not 0.0 <= degrees < 180.0:
        raise ValueError(f"{name}: {degrees:.10g} deg is not in [0, 180)")
    return degrees


def _control(suction: str | None, volume: str | None, humidity: str | None) -> dict[str, float]:
    """Read what is held constant; that it is one thing is for the library to say."""
    control = {}
    if suction is not None:
        control["suction"] = read("suction", suction, "Pa", "20kPa")
    if volume is not None:
        control["volume"] = read("volume", volume, "m^3", "5pL")
    if humidity is not None:
        control["humidity"] = read_fraction("humidity", humidity)
    return control


def _liquid(name: str | None, temperature: str | None, surface_tension: str | None) -> "Liquid":
    from .liquid import Liquid

    if surface_tension is None:
        kelvin = read("temperature", _ROOM_TEMPERATURE if temperature is None else temperature, "K", _ROOM_TEMPERATURE)
        return Liquid.water(kelvin) if name in (None, "water") else Liquid.named(str(name), kelvin)
    if name is not None or temperature is not None:
        unwanted = "temperature" if name is None else "liquid"
        raise ValueError(f"{unwanted}: has no effect beside surface-tension; give one of the two")
    return Liquid(surface_tension=read("surface-tension", surface_tension, "N/m", "72.8mN/m"))


def _describe_solids(radii: tuple[float, float], degrees: tuple[float, float]) -> str:
    first, second = (f"{angle:.4g}°" for angle in degrees)
    angles = f"contact angle {first}" if first == second else f"contact angles {first} and {second}"
    if math.isinf(radii[0]):
        solids = f"Plate and {show(radii[1], 'm', 4)} sphere"
    elif math.isinf(radii[1]):
        solids = f"{show(radii[0], 'm', 4)} sphere on a plate"
    elif radii[0] == radii[1]:
        solids = f"Two {show(radii[0], 'm', 4)} spheres"
    else:
        solids = f"Spheres of {show(radii[0], 'm', 4)} and {show(radii[1], 'm', 4)}"
    return f"{solids}, {angles}"


def _describe_liquid(liquid: "Liquid") -> str:
    tension = show(liquid.surface_tension, "N/m", 4)
    if liquid.temperature is None:
        return f"surface tension {tension}"
    return f"{liquid.name} at {liquid.temperature - _FREEZING_POINT:.4g} °C, {tension}"


def _describe_control(control: dict[str, float]) -> str:
    units = {"suction": "Pa", "volume": "m^3"}
    return " and ".join(
        f"{name} {show(value, units[name])}" if name in units else f"relative humidity {100.0 * value:.6g} %"
        for name, value in control.items()
    )
