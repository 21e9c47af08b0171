"""Command for a bridge that is changed step by step: a path of separations, suctions or volumes."""

import math
from itertools import pairwise
from typing import Annotated, Any

import typer

from ...ground.units import Values, read_values
from ..options import (
    SEPARATIONS,
    Question,
    describe_course,
    describe_liquid,
    read_contact_angle,
    sweep_length,
)
from ._app import print_answer, question_command, save_picture

__all__ = ["path"]


def _angle(help_text: str) -> Any:
    return typer.Option(help=help_text, metavar="ANGLE")


@question_command(
    "--radius 50um --contact-angle 60 --volume 1pL --separation 5um,1um,20um --advancing-angle 60 --receding-angle 30 "
    "--plot loop.svg",
    takes_sweeps=True,
)
def path(
    question: Question,
    separation: Annotated[
        str,
        typer.Option(help="Gap from surface to surface, from one place to the next: 5um,1um,20um.", metavar="LENGTH"),
    ],
    steps: Annotated[int, typer.Option(help="Steps from one place to the next.")] = 20,
    contact_line: Annotated[
        str | None,
        typer.Option(
            help="What contact lines do: wetting, pinned, or hysteresis; if not given, hysteresis where an angle at "
            "which they slide is, else wetting.",
            metavar="NAME",
        ),
    ] = None,
    advancing_angle: Annotated[str | None, _angle("Angle at which lines slide outwards: 60.")] = None,
    advancing_angle2: Annotated[str | None, _angle("That on the second solid, if another.")] = None,
    receding_angle: Annotated[str | None, _angle("Angle at which lines slide inwards: 30.")] = None,
    receding_angle2: Annotated[str | None, _angle("That on the second solid, if another.")] = None,
) -> None:
    """A bridge pulled, pushed, fed or dried along a path, with contact-angle hysteresis.

    Suction, volume or humidity may go from one value to the next as well, 5kPa,50kPa, beside one separation or as many.
    The bridge starts with the contact angle.
    """
    from ...ground.check import whole_number
    from ...paths import path as carried
    from ...show import path_text as report
    from ...show.text import csv_text, json_text, with_asked

    whole_number("steps", steps, 1)
    gap = read_values("separation", separation, "m", SEPARATIONS)
    if sweep_length(separation=gap, **question.control) is None:
        raise ValueError("separation: a path goes from place to place; write it like 5um,1um,20um")
    angles = {
        "advancing_angle": _both("advancing-angle", advancing_angle, advancing_angle2),
        "receding_angle": _both("receding-angle", receding_angle, receding_angle2),
    }
    slides = any(value is not None for value in angles.values())
    lines: Any = contact_line or ("hysteresis" if slides else "wetting")
    gaps = _between(gap, steps)
    control = {name: _between(values, steps) for name, values in question.control.items()}
    found = carried(question.pair, gaps, **control, contact_line=lines, liquid=question.liquid, **angles)
    course = (describe_course(name, values) for name, values in {**question.control, "separation": gap}.items())
    words = [describe_liquid(question.liquid), *course, *_in_words(angles)]
    asked = question._replace(subtitle="  ·  ".join(words))
    if question.picture is not None:
        save_picture(found.plot(title=asked.title, subtitle=asked.subtitle), question.picture)
    known = with_asked(found, separation=gaps, **control)
    if question.form == "json":
        typer.echo(json_text({**report.path_facts(known), "units": report.UNITS}))
    elif question.form == "csv":
        typer.echo(csv_text(report.path_columns(known)), nl=False)
    else:
        print_answer(asked, report.path_table(found, steps))
        typer.echo(f"\n{report.path_lines(found)}")


def _between(values: Values, steps: int) -> Values:
    """All values from each to the next; a single one as it is."""
    if not isinstance(values, list):
        return values
    import numpy as np

    legs = [np.linspace(first, last, steps + 1)[1:] for first, last in pairwise(values)]
    return [values[0], *np.concatenate(legs).tolist()]


def _both(name: str, first: str | None, second: str | None) -> tuple[float, float] | None:
    """Angles of both solids, [rad]."""
    if first is None:
        if second is not None:
            raise ValueError(f"{name}2: given without {name}")
        return None
    degrees = read_contact_angle(name, first), read_contact_angle(f"{name}2", first if second is None else second)
    return math.radians(degrees[0]), math.radians(degrees[1])


def _in_words(angles: dict[str, tuple[float, float] | None]) -> list[str]:
    """The angles at which lines slide."""
    words = []
    for name, both in angles.items():
        if both is not None:
            first, second = (f"{math.degrees(one):.4g}°" for one in both)
            words.append(f"{name.partition('_')[0]} {first if first == second else f'{first} and {second}'}")
    return words
