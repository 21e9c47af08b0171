"""The options that all commands share, read into what they ask: a pair, a liquid, and what is held constant."""

import math
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from typer import Option

from ..ground.units import Forms, Values, read, read_angle, read_angles, read_fractions, read_values, show
from .solids import FORMS, describe_solid, read_size, read_solid

# NumPy and all that needs it are imported by those who use it: the help is shown without.
if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from ..ask.face import Bridge, Pair
    from ..ask.liquid import Liquid
    from ..ask.shapes import Shape

__all__ = [
    "SEPARATIONS",
    "Question",
    "describe_course",
    "describe_liquid",
    "in_terms_of_options",
    "read_contact_angle",
    "read_filling_angle",
    "read_form",
    "read_liquid",
    "read_question",
    "sweep_length",
]

SEPARATIONS = Forms("1um", "0:8um:5", "1um,2um,5um")
_FILLING_ANGLES = Forms("30", "10:60:6", "10deg,20deg,30deg")
_SUCTIONS = Forms("20kPa", "1:20kPa:5", "1kPa,5kPa,20kPa")
_VOLUMES = Forms("5pL", "1:5pL:5", "1pL,2pL,5pL")
_HUMIDITIES = Forms("90%", "50%:90%:5", "50%,80%,90%")

_ROOM_TEMPERATURE = "20degC"
_FREEZING_POINT = 273.15  # 0 °C, [K]

_CONTROL_WORDS = {"humidity": "relative humidity"}
_MOST_TOLD = 5  # values of a course

# Where the library calls an argument otherwise than the option, and what it advises to a programmer.
_OPTIONS = {
    "half_filling_angle": "half-filling-angle",
    "surface_tension": "surface-tension",
    "molar_volume": "molar-volume",
    "name": "liquid",
    "force_error": "force-error",
    "jump_in": "jump-in",
    "hamaker_constant": "hamaker",
    "contact_angle": "contact-angle",
    "contact_line": "contact-line",
    "advancing_angle": "advancing-angle",
    "receding_angle": "receding-angle",
}
_ADVICE = {
    "make Liquid(surface_tension=...)": "give surface-tension in place of the name",
    "pass surface_tension=...": "give surface-tension as well",
    "give it to Liquid(...)": "give molar-volume as well",
    "exactly one of suction, volume, humidity is needed": (
        "write one of --suction 20kPa, --volume 5pL, --humidity 90%"
    ),
    "contact_line '": "contact-line '",
    "give a separation near to the one that is meant as well": "write --separation near to the one that is meant, too",
    "; write (angle, None) or (None, angle)": "",
    "(None, angle) names the other": "--half-filling-angle2 names the other",
    "(angle, None) names the other": "--half-filling-angle names the other",
    "ask bridge(branch='unstable')": "ask pendular bridge --branch unstable",
    "advancing_angle and receding_angle": "advancing-angle and receding-angle",
    "reduced_suction and reduced_volume": "reduced-suction and reduced-volume",
}


class Question(NamedTuple):
    """What is asked by the options that all commands share."""

    pair: "Pair"
    liquid: "Liquid"
    control: dict[str, Values]  # suction, volume or humidity, and its SI value, or those of a sweep
    title: str
    subtitle: str
    form: str  # of the answer: table, json or csv
    picture: Path | None

    def put_to(self, function: "Callable[..., Bridge]", *args: "ArrayLike", **options: Any) -> "Bridge":
        """Ask one of the three functions of the library."""
        return function(self.pair, *args, **self.control, liquid=self.liquid, **options)

    @property
    def has_stable_bridges(self) -> bool:
        """Whether there are any: two planes have none under suction."""
        if "volume" in self.control or self.pair.shape is not None:
            return True
        return any(math.isfinite(radius) for radius in map(float, self.pair.radii))

    @property
    def held(self) -> dict[str, float]:
        """The control with its one value; ValueError for a sweep."""
        one = {}
        for name, values in self.control.items():
            if isinstance(values, list):
                raise ValueError(
                    f"{name}: {len(values)} values are given where one is needed; bridge and rupture take a sweep"
                )
            one[name] = values
        return one

    def of_one_value(self) -> "Question":
        """Return itself, where a sweep of the control has no answer; ValueError for one."""
        return self._replace(control=dict(self.held))

    def lower_end(self) -> "Bridge | None":
        """Where the stable bridges begin, if that is not at contact."""
        from ..ask.face import ConvergenceWarning, rupture

        with warnings.catch_warnings():
            if self.pair.shape is not None:  # a branch that runs on to where it is not answered is drawn as far
                warnings.simplefilter("ignore", ConvergenceWarning)
            end = self.put_to(rupture, end="lower")
        return end if end.exists else None

    def later_fold(self, end: "Bridge") -> "Bridge | None":
        """The fold of the symmetric bridges, if the liquid slides to one of two equal solids before it."""
        from ..ask.face import rupture

        fold = self.put_to(rupture, limit="fold")
        # Where nothing comes first both are the same point.
        return fold if fold.separation > end.separation * (1.0 + 1e-9) else None

    def draw(
        self,
        end: "Bridge",
        state: "Bridge | None" = None,
        separation: float = 0.0,
        *,
        states: "Bridge | None" = None,
        stacked: bool = False,
    ) -> "Figure":
        """Picture of the pair and its force curve, with the state if there is one, else as the pair ruptures.

        The states on the curve may be known already.
        """
        from ..ask.face import curve
        from ..show.picture import figure

        return figure(
            self.pair,
            state,
            self.put_to(curve) if states is None else states,
            end,
            separation=separation,
            lower_end=self.lower_end(),
            title=self.title,
            subtitle=self.subtitle,
            stacked=stacked,
        )


def _text(help_text: str, kind: str) -> Any:
    return Option(help=help_text, metavar=kind)


def read_question(
    radius: Annotated[str | None, _text("Radius of both solids, or of the first: 50um,", "LENGTH")] = None,
    diameter: Annotated[str | None, _text("or the diameter: 100um.", "LENGTH")] = None,
    radius2: Annotated[str | None, _text("Radius of the second solid, if another: 5um, or plane,", "LENGTH")] = None,
    diameter2: Annotated[str | None, _text("or its diameter: 10um.", "LENGTH")] = None,
    solid: Annotated[str | None, _text(f"In place of a radius, another solid: {FORMS}.", "SOLID")] = None,
    solid2: Annotated[str | None, _text("In place of the radius of the second: disc:1mm.", "SOLID")] = None,
    contact_angle: Annotated[str, _text("Contact angle: 20 or 20deg, 0.35rad.", "ANGLE")] = "0",
    contact_angle2: Annotated[str | None, _text("Contact angle on the second solid, if another: 60.", "ANGLE")] = None,
    suction: Annotated[str | None, _text("Held constant: gas minus liquid pressure, 20kPa,", "PRESSURE")] = None,
    volume: Annotated[str | None, _text("or volume of the liquid, 5pL or 5000um^3,", "VOLUME")] = None,
    humidity: Annotated[str | None, _text("or relative humidity, 90% or 0.9.", "FRACTION")] = None,
    liquid: Annotated[str | None, _text("Liquid: ethanol; if not given, water.", "NAME")] = None,
    temperature: Annotated[str | None, _text("Of the liquid: 25degC; if not given, 20degC.", "TEMPERATURE")] = None,
    surface_tension: Annotated[
        str | None, _text("Measured, of that liquid or of one without a name: 72.8mN/m.", "TENSION")
    ] = None,
    molar_volume: Annotated[
        str | None, _text("For humidity, of a liquid without a name: 18cm^3/mol.", "MOLAR VOLUME")
    ] = None,
    as_json: Annotated[bool, Option("--json", help="Print JSON, in SI units.")] = False,
    as_csv: Annotated[bool, Option("--csv", help="Print CSV, in SI units.")] = False,
    plot: Annotated[
        Path | None, Option(help="Draw a picture of the answer: bridge.svg, .png or .pdf.", metavar="FILE")
    ] = None,
) -> Question:
    """Read the shared options, with one line of error for what cannot be meant."""
    from ..ask.face import Pair

    form = read_form(as_json, as_csv, plot)
    solids = _solids((radius, diameter, solid), (radius2, diameter2, solid2))
    second = contact_angle if contact_angle2 is None else contact_angle2
    degrees = read_contact_angle("contact-angle", contact_angle), read_contact_angle("contact-angle2", second)
    control = _control(suction, volume, humidity)
    wetting = read_liquid(liquid, temperature, surface_tension, molar_volume, is_humid=humidity is not None)
    return Question(
        pair=Pair(solids, (math.radians(degrees[0]), math.radians(degrees[1]))),
        liquid=wetting,
        control=control,
        title=_describe_solids(solids, degrees),
        subtitle=f"{describe_liquid(wetting)}  ·  {_describe_control(control)}",
        form=form,
        picture=plot,
    )


def sweep_length(**values: Values) -> int | None:
    """Number of points of all the sweeps among some options; None without a sweep.

    Raises
    ------
    ValueError
        If two of them differ.

    Examples
    --------
    >>> sweep_length(separation=[0.0, 1e-6, 2e-6], suction=2e4)
    3
    """
    lengths = {name: len(several) for name, several in values.items() if isinstance(several, list)}
    if len(set(lengths.values())) > 1:
        (name, length), *others = lengths.items()
        told = " and ".join(f"{other} of {another}" for another, other in others)
        raise ValueError(f"{name}: {length} values beside {told}; sweeps go side by side and need as many")
    return next(iter(lengths.values()), None)


def in_terms_of_options(message: str) -> str:
    """Message of the library as one who knows only the options understands it.

    Examples
    --------
    >>> in_terms_of_options("surface_tension: 0.0 N/m is not > 0")
    'surface-tension: 0.0 N/m is not > 0'
    """
    name, colon, reason = message.partition(": ")
    for to_programmers, to_all in _ADVICE.items():
        reason = reason.replace(to_programmers, to_all)
    bare, bracket, index = name.partition("[")
    return _OPTIONS.get(bare, bare) + bracket + index + colon + reason


def read_form(as_json: bool, as_csv: bool, plot: Path | None) -> str:
    """Form of the answer: table, json or csv; a picture must be of a known format."""
    if as_json and as_csv:
        raise ValueError("json: given together with csv; one of the two is needed")
    if plot is not None:
        from ..show.picture import FORMATS

        if plot.suffix.lower() not in FORMATS:
            raise ValueError(f"plot: '{plot}' does not end in one of {', '.join(FORMATS)}")
    return "json" if as_json else "csv" if as_csv else "table"


_Given = tuple[str | None, str | None, str | None]  # radius, diameter, solid


def _solids(first: _Given, second: _Given) -> "tuple[float | Shape, float | Shape]":
    """Both solids, each from whatever it is given by; the second is as the first without."""
    one, other = _solid(first, ""), _solid(second, "2")
    if one is None:
        raise ValueError("radius: missing; write --radius 50um, or --diameter 100um")
    return one, one if other is None else other


def _solid(given: _Given, ending: str) -> "float | Shape | None":
    radius, diameter, solid = given
    names = [f"{name}{ending}" for name, text in zip(("radius", "diameter", "solid"), given, strict=True) if text]
    if len(names) > 1:
        raise ValueError(f"{names[1]}: given together with {names[0]}; one of the two is needed")
    if solid is not None:
        return read_solid(f"solid{ending}", solid)
    if diameter is not None:
        return 0.5 * read_size(f"diameter{ending}", diameter, "100um")
    return None if radius is None else read_size(f"radius{ending}", radius, "50um")


def read_contact_angle(name: str, text: str) -> float:
    """Contact angle in degrees, in [0, 180).

    Examples
    --------
    >>> read_contact_angle("contact-angle", "4rad")
    Traceback (most recent call last):
        ...
    ValueError: contact-angle: '4rad' is not in [0, 180) degrees; write it like 20, 20deg or 0.35rad
    """
    degrees = read_angle(name, text)
    if not 0.0 <= degrees < 180.0:
        raise ValueError(f"{name}: {text!r} is not in [0, 180) degrees; write it like 20, 20deg or 0.35rad")
    return degrees


def read_filling_angle(first: str | None, second: str | None) -> tuple[int, Values] | None:
    """Solid that a half-filling angle is given for, 0 or 1, and the angle in radians; None if none is given.

    Examples
    --------
    >>> solid, angle = read_filling_angle(None, "30")
    >>> solid, round(angle, 4)
    (1, 0.5236)
    """
    if first is not None and second is not None:
        raise ValueError("half-filling-angle2: given together with half-filling-angle; one of the two is needed")
    name, text = ("half-filling-angle", first) if second is None else ("half-filling-angle2", second)
    if text is None:
        return None
    degrees = read_angles(name, text, _FILLING_ANGLES)
    for one in degrees if isinstance(degrees, list) else [degrees]:
        if not 0.0 < one < 180.0:
            raise ValueError(f"{name}: {one:.6g}° of {text!r} is not in (0, 180) degrees; write it like 30")
    angle = [math.radians(one) for one in degrees] if isinstance(degrees, list) else math.radians(degrees)
    return (0 if second is None else 1), angle


def _control(suction: str | None, volume: str | None, humidity: str | None) -> dict[str, Values]:
    """Read what is held constant; that it is one thing is for the library to say."""
    control: dict[str, Values] = {}
    if suction is not None:
        control["suction"] = read_values("suction", suction, "Pa", _SUCTIONS)
    if volume is not None:
        control["volume"] = read_values("volume", volume, "m^3", _VOLUMES)
    if humidity is not None:
        control["humidity"] = read_fractions("humidity", humidity, _HUMIDITIES)
    return control


def read_liquid(
    name: str | None, temperature: str | None, surface_tension: str | None, molar_volume: str | None, *, is_humid: bool
) -> "Liquid":
    """Return a liquid by its name, with measured numbers in the place of known ones; or of measured numbers alone."""
    from ..ask.liquid import Liquid

    tension = None if surface_tension is None else read("surface-tension", surface_tension, "N/m", "72.8mN/m")
    kelvin = read("temperature", _ROOM_TEMPERATURE if temperature is None else temperature, "K", _ROOM_TEMPERATURE)
    if molar_volume is not None and not is_humid:
        raise ValueError("molar-volume: has no effect without humidity")
    volume = None if molar_volume is None else read("molar-volume", molar_volume, "m^3/mol", "18cm^3/mol")
    if name is None and (tension is not None or volume is not None):
        if volume is None and temperature is not None and not is_humid:
            raise ValueError("temperature: has no effect beside surface-tension; give one of the two")
        return _nameless(tension, volume, kelvin, is_humid=is_humid)
    if name in (None, "water"):
        found = Liquid.water(kelvin, surface_tension=tension)
    else:
        found = Liquid.named(str(name), kelvin, surface_tension=tension)
    if volume is None:
        return found
    return Liquid(found.surface_tension, temperature=found.temperature, name=found.name, molar_volume=volume)


def _nameless(tension: float | None, volume: float | None, kelvin: float, *, is_humid: bool) -> "Liquid":
    """Liquid of measured numbers, of which humidity needs more than any other control."""
    from ..ask.liquid import Liquid

    if tension is None:
        raise ValueError("surface-tension: missing beside molar-volume; write it like 72.8mN/m, or name the liquid")
    if volume is None and is_humid:
        raise ValueError(
            "surface-tension: not enough for humidity; name the liquid as well, or write its molar-volume, "
            "like 18cm^3/mol"
        )
    return Liquid(tension, temperature=None if volume is None else kelvin, molar_volume=volume)


def _describe_solids(solids: "tuple[float | Shape, float | Shape]", degrees: tuple[float, float]) -> str:
    first, second = (f"{angle:.4g}°" for angle in degrees)
    angles = f"contact angle {first}" if first == second else f"contact angles {first} and {second}"
    one, other = solids
    if isinstance(one, float) and isinstance(other, float):
        words = _describe_radii(one, other)
    else:
        words = describe_solid(one)
        words += " on both sides" if one == other else f" and {describe_solid(other)}"
    return f"{words[0].upper()}{words[1:]}, {angles}"


def _describe_radii(one: float, other: float) -> str:
    if math.isinf(one) and math.isinf(other):
        return "two plates"
    if math.isinf(one):
        return f"plate and sphere of radius {show(other, 'm', 4)}"
    if math.isinf(other):
        return f"sphere of radius {show(one, 'm', 4)} on a plate"
    if one == other:
        return f"two spheres of radius {show(one, 'm', 4)}"
    return f"spheres of radius {show(one, 'm', 4)} and {show(other, 'm', 4)}"


def describe_liquid(liquid: "Liquid") -> str:
    """Liquid in a few words."""
    tension = show(liquid.surface_tension, "N/m", 4)
    if liquid.temperature is None:
        return f"surface tension {tension}"
    return f"{liquid.name or 'liquid'} at {liquid.temperature - _FREEZING_POINT:.4g} °C, {tension}"


def _describe_control(control: dict[str, Values]) -> str:
    return " and ".join(
        f"{_CONTROL_WORDS.get(name, name)} {_one_of_control(name, values)}"
        if not isinstance(values, list)
        else f"{len(values)} values of {_CONTROL_WORDS.get(name, name)}, "
        f"{_one_of_control(name, values[0])} to {_one_of_control(name, values[-1])}"
        for name, values in control.items()
    )


def describe_course(name: str, values: Values) -> str:
    """What goes from one value to the next.

    Examples
    --------
    >>> describe_course("separation", [5e-6, 1e-6, 2e-5])
    'separation 5 µm to 1 µm to 20 µm'
    """
    each = [_one_of_control(name, one) for one in (values if isinstance(values, list) else [values])]
    few = each if len(each) <= _MOST_TOLD else [each[0], "…", each[-1]]
    return f"{_CONTROL_WORDS.get(name, name)} {' to '.join(few)}"


def _one_of_control(name: str, value: float) -> str:
    units = {"suction": "Pa", "volume": "m^3", "separation": "m"}
    return show(value, units[name]) if name in units else f"{100.0 * value:.6g} %"
