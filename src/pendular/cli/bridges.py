"""Commands for one pair: a bridge, its rupture, its force curve."""

from typing import TYPE_CHECKING, Annotated

import typer

from ..question import Question
from ..units import read, show
from ._app import print_answer, question_command, save_picture

if TYPE_CHECKING:
    from ..bridges import Bridge

__all__ = ["bridge", "curve", "rupture"]


@question_command("--radius 50um --contact-angle 20 --suction 20kPa --separation 1um --plot bridge.svg")
def bridge(
    question: Question,
    separation: Annotated[str, typer.Option(help="Gap from surface to surface: 1um.", metavar="LENGTH")],
    branch: Annotated[str, typer.Option(help="Which of two bridges: stable, or unstable.")] = "stable",
) -> None:
    """Force, shape and energies of a bridge, and its rupture distance."""
    from .. import bridges, report

    gap = read("separation", separation, "m", "1um")
    answer = question.put_to(bridges.bridge, gap, branch=branch)
    end = question.put_to(bridges.rupture)
    _draw(question, end, answer, gap)
    if question.form == "json":
        found = {**report.plain_fields(answer), "rupture_separation": end.separation}
        units = {**report.UNITS, "rupture_separation": "m"}
        typer.echo(report.json_text({**found, "units": units}))
    elif question.form == "csv":
        limit = report.Column("rupture_separation", "m", end.separation)
        typer.echo(report.csv_text([*report.columns(answer), limit]), nl=False)
    else:
        rupture_distance = (show(float(end.separation), "m"), "separation at which the bridge breaks")
        print_answer(question, report.state_table(answer, {"rupture distance": rupture_distance}))


@question_command("--radius 50um --radius2 plane --contact-angle 50 --volume 5pL")
def rupture(question: Question) -> None:
    """Rupture distance, and the bridge as it breaks."""
    from .. import bridges, report

    end = question.put_to(bridges.rupture)
    _draw(question, end)
    earlier = question.instability(end)
    if question.form == "json":
        limit = None if earlier is None else report.plain_fields(earlier)
        typer.echo(report.json_text({**report.plain_fields(end), "stability_limit": limit, "units": report.UNITS}))
    elif question.form == "csv":
        limits = {"fold": end, "stability": earlier}
        rows = (
            [report.Column("limit", "", name), *report.columns(state)]
            for name, state in limits.items()
            if state is not None
        )
        typer.echo(report.csv_text(*rows), nl=False)
    else:
        more = {}
        if earlier is not None:
            more["stable to"] = (show(float(earlier.separation), "m"), "then the liquid slides to one of the solids")
        print_answer(question, report.rupture_table(end, more))


@question_command("--radius 50um --radius2 5um --contact-angle 20 --humidity 90% --temperature 25degC --csv")
def curve(
    question: Question,
    points: Annotated[int, typer.Option(help="Number of states, at least 5.")] = 201,
) -> None:
    """Bridges from contact to rupture, and the unstable ones."""
    from .. import bridges, report

    states, end = question.put_to(bridges.curve, points=points), question.put_to(bridges.rupture)
    _draw(question, end)
    if question.form == "json":
        typer.echo(report.json_text({**report.plain_fields(states), "units": report.UNITS}))
    elif question.form == "csv":
        typer.echo(report.csv_text(report.columns(states)), nl=False)
    else:
        print_answer(question, report.curve_table(states) if end.exists else "no bridge between solids apart")


def _draw(question: Question, end: "Bridge", state: "Bridge | None" = None, separation: float = 0.0) -> None:
    """Draw the picture, if one is wanted."""
    if question.picture is not None:
        save_picture(question.draw(end, state, separation), question.picture)
