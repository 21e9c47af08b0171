"""Command for adsorbed films: how thick they are, and the bridge between them."""

from typing import Annotated, Any

import typer

from ...ground.units import read, show
from ..options import Question
from ._app import print_answer, question_command

__all__ = ["film"]

_MEANINGS = {
    "film_thickness": "on each solid",
    "condensation_separation": "gap of the solids below which the bridge has less energy than films",
    "rupture_separation": "gap of the solids at which the bridge breaks",
}
_UNITS = dict.fromkeys(_MEANINGS, "m")


@question_command("--radius 1um --radius2 plane --humidity 90% --hamaker 1e-20J --separation 2nm")
def film(
    question: Question,
    separation: Annotated[str, typer.Option(help="Gap between the solids: 2nm.", metavar="LENGTH")],
    thickness: Annotated[str | None, typer.Option(help="Of the film on each solid: 1nm,", metavar="LENGTH")] = None,
    hamaker: Annotated[
        str | None,
        typer.Option(help="or the constant A of its disjoining pressure A/(6 pi t^3): 1e-20J.", metavar="ENERGY"),
    ] = None,
) -> None:
    """A bridge between solids with adsorbed films, at a suction or a humidity, and where it condenses.

    The bridge is told as that between the films: its separation is theirs.
    """
    from ...ask.face import bridge, rupture
    from ...ask.film import condensation_separation, film_thickness, filmed
    from ...ask.liquid import suction_from_humidity
    from ...show import text as report

    if question.picture is not None:
        raise ValueError("plot: a bridge between films is not drawn")
    if "volume" in question.control:
        raise ValueError("volume: films are in balance at a suction or a humidity; write one of these in its place")
    if (thickness is None) == (hamaker is None):
        raise ValueError("thickness: a film has one, 1nm, or a constant, --hamaker 1e-20J; write one of the two")
    gap = read("separation", separation, "m", "2nm")
    held = question.held
    suction = held["suction"] if "suction" in held else suction_from_humidity(held["humidity"], question.liquid)
    if hamaker is not None:
        films: dict[str, Any] = {"hamaker_constant": read("hamaker", hamaker, "J", "1e-20J")}
        deep = film_thickness(suction, films["hamaker_constant"])
    else:
        deep = read("thickness", str(thickness), "m", "1nm")
        films = {"thickness": deep}
    thick, shift = filmed(question.pair, deep)
    between = question._replace(pair=thick)
    answer, end = between.put_to(bridge, gap - shift), between.put_to(rupture)
    places = {
        "film_thickness": deep,
        "condensation_separation": condensation_separation(question.pair, **held, liquid=question.liquid, **films),
        "rupture_separation": end.separation + shift,
    }
    if question.form == "json":
        typer.echo(report.json_text({**places, **report.plain_fields(answer), "units": _UNITS | report.UNITS}))
    elif question.form == "csv":
        told = [report.Column(name, "m", value) for name, value in places.items()]
        typer.echo(report.csv_text([*told, *report.columns(answer)]), nl=False)
    else:
        rows = {name.replace("_", " "): (show(float(value), "m"), _MEANINGS[name]) for name, value in places.items()}
        print_answer(question, report.state_table(answer, rows))
