"""Commands for one pair: a bridge, its rupture, its force curve."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from ...ground.units import Values, read_values, show
from ..options import SEPARATIONS, Question, read_filling_angle, sweep_length
from ._app import print_answer, question_command, save_picture

if TYPE_CHECKING:
    from ...ask.face import Bridge
    from ...show.text import Column

__all__ = ["bridge", "curve", "rupture"]

_END_NAMES = {"lower_end": "begins at", "fold": "symmetric to"}
_END_MEANINGS = {
    "lower_end": "below, the drop swallows the better wetted solid",
    "fold": "fold of the symmetric bridges; before it the liquid slides to one of the solids",
}
_SMOOTH = 201  # states of a curve that is drawn
_SWEPT = ("force", "volume", "suction", "neck_radius")  # what the table of a sweep tells beside the separations


@question_command(
    "--radius 50um --contact-angle 20 --suction 20kPa --separation 1um --plot bridge.svg\n"
    "  pendular bridge --diameter 100um --volume 5pL --separation 0:8um:5 --csv",
    takes_sweeps=True,
)
def bridge(
    question: Question,
    separation: Annotated[
        str | None,
        typer.Option(
            help="Gap from surface to surface: 1um; a sweep, 0:8um:5; or a list, 1um,2um,5um.", metavar="LENGTH"
        ),
    ] = None,
    half_filling_angle: Annotated[
        str | None,
        typer.Option(
            help="In its place: half-filling angle on the first solid, 30 or 10:60:6. Of several bridges with it a "
            "separation chooses the nearest.",
            metavar="ANGLE",
        ),
    ] = None,
    half_filling_angle2: Annotated[
        str | None, typer.Option(help="Or half-filling angle on the second solid.", metavar="ANGLE")
    ] = None,
    branch: Annotated[str, typer.Option(help="Which of two bridges: stable, or unstable.")] = "stable",
    mesh: Annotated[
        Path | None,
        typer.Option(
            help="Write the surfaces of liquid and solids: .vtu, .stl, .obj, .ply, or .fe for Surface Evolver.",
            metavar="FILE",
        ),
    ] = None,
) -> None:
    """Force, shape and energies of a bridge, and its rupture distance.

    Suction, volume or humidity may be a sweep, too: 1:20kPa:5 are five suctions, beside one or five separations.
    """
    from ...ask import face as bridges
    from ...show import text as report

    asked = _asked(separation, half_filling_angle, half_filling_angle2)
    length = sweep_length(**asked.values, **question.control)
    _refuse_picture_of_sweep(question)
    if mesh is not None and length is not None:
        raise ValueError("mesh: holds one bridge, not a sweep")
    answer = _with_asked(question.put_to(bridges.bridge, branch=branch, **asked.arguments), asked, question)
    end = question.put_to(bridges.rupture) if question.has_stable_bridges else None
    _draw(question, end, *_place_of(answer, asked))
    if mesh is not None:
        from ...codes.mesh_files import write_mesh

        write_mesh(mesh, question.pair, answer)
    limits = [] if end is None else [report.spread("rupture_separation", "m", end.separation, answer)]
    if question.form == "json":
        typer.echo(_json(question, answer, *limits))
    elif question.form == "csv":
        typer.echo(_csv(question, answer, *limits), nl=False)
    elif length is not None:
        columns = [
            report.column_of("separation", answer),
            *(limit._replace(name="rupture_distance") for limit in limits),
        ]
        if asked.solid is not None:
            columns.insert(0, report.Column("half_filling_angle", "rad", answer.half_filling_angle[..., asked.solid]))
        _print_sweep(question, answer, *columns)
    else:
        more = {}
        if end is not None:
            more["rupture distance"] = (show(float(end.separation), "m"), "separation at which the bridge breaks")
        print_answer(question, report.state_table(answer, more))
        if mesh is not None:
            typer.echo(f"\nmesh: {mesh}")


@question_command(
    "--radius 50um --radius2 plane --contact-angle 50 --volume 5pL\n"
    "  pendular rupture --radius 50um --suction 1:20kPa:5",
    takes_sweeps=True,
)
def rupture(question: Question) -> None:
    """Rupture distance, and the bridge as it breaks.

    Suction, volume or humidity may be a sweep, 1:20kPa:5, or a list, 1kPa,5kPa,20kPa.
    """
    from ...ask import face as bridges
    from ...show import text as report

    _refuse_picture_of_sweep(question)
    end = report.with_asked(question.put_to(bridges.rupture), **question.control)
    _draw(question, end)
    if sweep_length(**question.control) is not None:
        _print_ruptures(question, end)
        return
    others = {"lower_end": question.lower_end(), "fold": question.later_fold(end)}
    known = {name: state for name, state in others.items() if state is not None}
    if question.form == "json":
        fields = {name: None if state is None else report.plain_fields(state) for name, state in others.items()}
        typer.echo(report.json_text({**report.plain_fields(end), **fields, "units": report.UNITS}))
    elif question.form == "csv":
        rows = (
            [report.Column("limit", "", name), *report.columns(state)]
            for name, state in {"rupture": end, **known}.items()
        )
        typer.echo(report.csv_text(*rows), nl=False)
    else:
        more = {
            _END_NAMES[name]: (show(float(state.separation), "m"), _END_MEANINGS[name]) for name, state in known.items()
        }
        print_answer(question, report.rupture_table(end, more))


def _print_ruptures(question: Question, end: "Bridge") -> None:
    """Print the ends of a sweep of bridges; a volume may have two, and the lower is told by its separation."""
    from ...ask import face as bridges
    from ...show import text as report

    limits = []
    if "volume" in question.control:
        lower = question.put_to(bridges.rupture, end="lower")
        limits.append(report.spread("lower_separation", "m", lower.separation, end))
    if question.form == "json":
        typer.echo(_json(question, end, *limits))
    elif question.form == "csv":
        typer.echo(_csv(question, end, *limits), nl=False)
    else:
        distances = report.column_of("separation", end)._replace(name="rupture_distance")
        _print_sweep(question, end, distances, *(limit._replace(name="begins_at") for limit in limits))


@question_command("--radius 50um --radius2 5um --contact-angle 20 --humidity 90% --temperature 25degC --csv")
def curve(
    question: Question,
    points: Annotated[int, typer.Option(help="Number of states, at least 5.")] = 201,
) -> None:
    """Bridges from contact to rupture, and the unstable ones."""
    from ...ask import face as bridges
    from ...show import text as report

    states, end = question.put_to(bridges.curve, points=points), question.put_to(bridges.rupture)
    _draw(question, end, states=states if points >= _SMOOTH else None)
    if question.form == "json":
        typer.echo(report.json_text({**report.plain_fields(states), "units": report.UNITS}))
    elif question.form == "csv":
        typer.echo(report.csv_text(report.columns(states)), nl=False)
    else:
        print_answer(question, report.curve_table(states) if end.exists else "no bridge between solids apart")


class _Asked(NamedTuple):
    """What tells which bridge is meant: a separation, or a half-filling angle on a solid."""

    values: dict[str, Values]  # of the options, in SI units
    solid: int | None  # 0 or 1, with an angle

    @property
    def arguments(self) -> dict[str, Any]:
        """Arguments of the library."""
        if self.solid is None:
            return dict(self.values)
        angle = self.values["half_filling_angle"]
        named = {"half_filling_angle": (angle, None) if self.solid == 0 else (None, angle)}
        return {**self.values, **named}


def _asked(separation: str | None, first: str | None, second: str | None) -> _Asked:
    """Read what tells which bridge is meant."""
    filling = read_filling_angle(first, second)
    values: dict[str, Values] = {}
    if separation is not None:
        values["separation"] = read_values("separation", separation, "m", SEPARATIONS)
    elif filling is None:
        raise ValueError("separation: missing; write --separation 1um, or --half-filling-angle 30")
    if filling is None:
        return _Asked(values, None)
    return _Asked({**values, "half_filling_angle": filling[1]}, filling[0])


def _place_of(answer: "Bridge", asked: _Asked) -> "tuple[Bridge, float] | tuple[()]":
    """Bridge and separation of one state to draw; nothing of several, or of an angle that no bridge has."""
    gap = asked.values.get("separation") if asked.solid is None else answer.separation
    if sweep_length(**asked.values) is not None or not isinstance(gap, float) or math.isnan(gap):
        return ()
    return answer, gap


def _with_asked(answer: "Bridge", asked: _Asked, question: Question) -> "Bridge":
    """Answer that tells what was asked also where there is no bridge."""
    from ...show import text as report

    values: dict[str, Any] = dict(question.control)
    if asked.solid is None:
        values["separation"] = asked.values["separation"]
    else:
        values["half_filling_angle"] = report.on_solid(asked.values["half_filling_angle"], asked.solid, answer)
    return report.with_asked(answer, **values)


def _json(question: Question, answer: "Bridge", *more: "Column") -> str:
    """Fields of an answer and further columns, under their names."""
    from ...show import text as report

    extra = [*_humidity(question, answer), *more]
    fields = {**report.plain_fields(answer), **{column.name: column.values for column in extra}}
    units = {**report.UNITS, **{column.name: column.unit for column in extra}}
    return report.json_text({**fields, "units": units})


def _csv(question: Question, answer: "Bridge", *more: "Column") -> str:
    """Fields of an answer and further columns, one row a point."""
    from ...show import text as report

    return report.csv_text([*_humidity(question, answer), *report.columns(answer), *more])


def _print_sweep(question: Question, answer: "Bridge", *separations: "Column") -> None:
    """Print some fields of an answer as a table, one row a point."""
    from ...show import text as report

    columns = [*_humidity(question, answer), *separations, *(report.column_of(name, answer) for name in _SWEPT)]
    print_answer(question, report.sweep_table(columns, answer))


def _humidity(question: Question, answer: "Bridge") -> "list[Column]":
    """Column of the humidity where that is held, of which the fields of a bridge know the suction only."""
    from ...show import text as report

    return [report.spread(name, "", values, answer) for name, values in question.control.items() if name == "humidity"]


def _refuse_picture_of_sweep(question: Question) -> None:
    """Refuse to draw bridges of several controls, whose curves differ, and those without stable ones beside them."""
    if question.picture is not None and not question.has_stable_bridges:
        raise ValueError("plot: draws a bridge beside the stable ones, of which two planes under suction have none")
    if question.picture is not None and sweep_length(**question.control) is not None:
        raise ValueError(f"plot: draws the bridges of one {', '.join(question.control)}, not of a sweep of it")


def _draw(
    question: Question,
    end: "Bridge | None",
    state: "Bridge | None" = None,
    separation: float = 0.0,
    *,
    states: "Bridge | None" = None,
) -> None:
    """Draw the picture, if one is wanted."""
    if question.picture is not None and end is not None:
        save_picture(question.draw(end, state, separation, states=states), question.picture)
