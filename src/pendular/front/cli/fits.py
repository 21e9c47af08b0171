"""Command for a measured curve: the bridge that fits it best."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ...ground.units import Forms, read, read_fraction, read_values
from ..options import Question, describe_liquid, read_contact_angle
from ._app import need_extra, print_answer, question_command, save_picture

if TYPE_CHECKING:
    from ...fitting import Fit

__all__ = ["fit"]

_PLACES = Forms("0.3mm", "0.3mm,5um", "0.3mm,5um")
_BOUNDS = {"m": "5um", "m^3": "5nL", "Pa": "20kPa", "N": "1uN", "N/m": "72.8mN/m", "m^3/s": "1pL/s"}  # well-formed


def _text(help_text: str, kind: str) -> Any:
    return typer.Option(help=help_text, metavar=kind)


@question_command(
    "curve.csv --radius 1mm --volume 10nL --free contact-angle,volume,offset --plot fit.svg\n"
    "  pendular fit curve.csv --radius 1mm --volume 10nL --rupture jump --control both"
)
def fit(
    question: Question,
    curve: Annotated[
        Path,
        typer.Argument(help="Measured curve: a table with units in its header, or a force curve of an instrument."),
    ],
    free: Annotated[
        str | None,
        _text(
            "What is fitted: contact-angle, contact-angle1, contact-angle2, volume, suction, humidity, "
            "surface-tension, radius, radius1, radius2, offset, force-zero, force-scale, base-slope, evaporation-rate.",
            "NAMES",
        ),
    ] = None,
    columns: Annotated[str | None, _text("Names of the columns of separation and force: gap,F.", "NAMES")] = None,
    units: Annotated[str | None, _text("Their units, where the file tells none: um,nN.", "UNITS")] = None,
    attraction: Annotated[str, _text("Sign of an attraction in a table: positive, negative.", "SIGN")] = "positive",
    segment: Annotated[str, _text("Of a force curve of an instrument: retract, approach.", "NAME")] = "retract",
    index: Annotated[int, typer.Option(help="Which curve of such a file.")] = 0,
    rupture: Annotated[
        str | None, _text("Where the bridge broke, as a datum: 0.3mm, 0.3mm,5um with its error, end, jump.", "LENGTH")
    ] = None,
    jump_in: Annotated[
        str | None, _text("Where the bridge formed on approach, at a suction, as a datum: 5nm or 5nm,1nm.", "LENGTH")
    ] = None,
    force_error: Annotated[
        str | None, _text("Standard error of the forces: 1nN; else the residuals tell.", "FORCE")
    ] = None,
    bounds: Annotated[
        list[str] | None,
        _text("Bounds of what is free: contact-angle=0:40, volume=5nL:20nL. May be repeated.", "NAME=LOW:HIGH"),
    ] = None,
    loss: Annotated[str, _text("linear, or one that heeds outliers less: soft_l1, huber, cauchy.", "NAME")] = "linear",
    starts: Annotated[int, typer.Option(help="From how many places the search begins.")] = 5,
    method: Annotated[str, _text("exact, or a law: what it would have made of the curve.", "NAME")] = "exact",
    control: Annotated[
        str, _text("given, or both: which of constant volume and constant suction fits better.", "NAME")
    ] = "given",
) -> None:
    """Contact angle, volume, contact point and more from a measured curve of the force, with errors."""
    from ...codes.measured_curve import read_curve
    from ...fitting import fit as fitted
    from ...fitting import fit_controls
    from ...fitting.words import controls_table, fit_table
    from ...ground.check import one_of

    need_extra("fit", "scipy")
    one_of("control", control, ("given", "both"))
    measured = read_curve(
        curve,
        columns=_two("columns", columns, "gap,F"),
        units=_two("units", units, "um,nN"),
        attraction=attraction,
        segment=segment,
        index=index,
    )
    error = measured.force_error if force_error is None else read("force-error", force_error, "N", "1nN")
    names = None if free is None else tuple(name.strip().replace("-", "_") for name in free.split(","))
    options: dict[str, Any] = {
        "liquid": question.liquid,
        "free": names,
        "force_error": error,
        "rupture": rupture if rupture in ("end", "jump") else _place("rupture", rupture),
        "jump_in": _place("jump-in", jump_in),
        "time": measured.time,
        "bounds": dict(_bound(text) for text in bounds or ()) or None,
        "loss": loss,
        "starts": starts,
        "method": method,
    }
    options |= question.control
    if control == "both":
        both = fit_controls(measured.separation, measured.force, question.pair, **options)
        better = both.suction if both.better == "suction" else both.volume
        facts = {
            "better": both.better,
            "odds": both.odds,
            "volume": _facts(both.volume),
            "suction": _facts(both.suction),
        }
        _show(question, better, facts, controls_table(both))
    else:
        found = fitted(measured.separation, measured.force, question.pair, **options)
        _show(question, found, _facts(found), fit_table(found))


def _show(question: Question, found: "Fit", facts: dict[str, Any], table: Any) -> None:
    from ...fitting.plots import fit_figure
    from ...show.text import csv_text, json_text

    if question.picture is not None:
        save_picture(
            fit_figure(found, title=question.title.partition(",")[0], subtitle=_subtitle(found)), question.picture
        )
    if question.form == "json":
        typer.echo(json_text(facts))
    elif question.form == "csv":
        typer.echo(csv_text(_columns(found)), nl=False)
    else:
        print_answer(question, table)


def _subtitle(found: "Fit") -> str:
    by = "exact bridges" if found.method == "exact" else f"law {found.method}"
    held = next(iter(found.held))
    return f"{describe_liquid(found.liquid)}  ·  {found.force.size} points, fitted by {by} at constant {held}"


def _facts(found: "Fit") -> dict[str, Any]:
    """A fit as plain data, with the units of its numbers."""
    from ...fitting.rules import UNITS

    named = (
        "values",
        "errors",
        "upper",
        "notes",
        "correlation",
        "covariance",
        "rupture_separation",
        "measured_rupture",
    )
    rest = ("method", "held", "chi_square", "degrees_of_freedom", "criterion", "rms", "converged")
    units = {name: UNITS[name] for name in found.free}
    return {name: getattr(found, name) for name in (*named, *rest)} | {"units": units}


def _columns(found: "Fit") -> list[Any]:
    """The curve, the fit and what is left."""
    from ...show.text import Column

    units = {"separation": "m", "force": "N", "force_error": "N", "fitted": "N", "residuals": "N"}
    return [Column(name, unit, getattr(found, name)) for name, unit in units.items()]


def _two(name: str, text: str | None, example: str) -> tuple[str, str] | None:
    if text is None:
        return None
    parts = [part.strip() for part in text.split(",")]
    if len(parts) != 2 or not all(parts):
        raise ValueError(f"{name}: {text!r} is not two names with a comma between; write it like {example}")
    return parts[0], parts[1]


def _place(name: str, text: str | None) -> Any:
    """A length, or one and its standard error, where the bridge broke or formed."""
    if text is None:
        return None
    values = read_values(name, text, "m", _PLACES)
    if isinstance(values, list) and len(values) != 2:
        raise ValueError(f"{name}: {text!r} is not a length, or one and its error; write it like {_PLACES.values}")
    return tuple(values) if isinstance(values, list) else values


def _bound(text: str) -> tuple[str, tuple[float, float]]:
    """Name and bounds of what is free."""
    from ...fitting.rules import UNITS
    from ...ground.check import one_of

    option, equals, ends = text.partition("=")
    name = option.strip().replace("-", "_")
    one_of("bounds", name, tuple(UNITS))
    low, colon, high = ends.partition(":")
    if not equals or not colon:
        raise ValueError(f"bounds: {text!r} is not NAME=LOW:HIGH; write it like contact-angle=0:40")
    return name, (_end(name, low), _end(name, high))


def _end(name: str, text: str) -> float:
    """One end of some bounds, in SI units."""
    from ...fitting.rules import UNITS

    if name.startswith("contact_angle"):
        return math.radians(read_contact_angle("bounds", text))
    if UNITS[name]:
        return read("bounds", text, UNITS[name], _BOUNDS[UNITS[name]])
    if name == "humidity":
        return read_fraction("bounds", text)
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"bounds: {text!r} is not a number") from None
