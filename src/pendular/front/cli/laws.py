"""Commands for the laws: what is known of them, and how far they are from the exact solution."""

import math
from pathlib import Path
from runpy import run_path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..options import read_form, read_question
from ._app import app, print_answer, print_page, question_command, save_picture

if TYPE_CHECKING:
    from ...comparison import Comparison, ErrorMap
    from ...laws import Law

__all__ = ["compare", "laws"]

_FORMS = ("as_json", "as_csv", "plot")
_Range = tuple[float, float]


def _range(help_text: str) -> Any:
    return typer.Option(help=help_text, metavar="FROM TO")


@app.command(epilog="\b\nExample:\n  pendular laws zhao2020")
def laws(
    name: Annotated[str | None, typer.Argument(help="Law of which all is told; without one, the list of them.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Published closed forms: formula, range, source and measured errors."""
    from ...comparison import tables
    from ...ground.check import one_of
    from ...laws import laws as registry
    from ...show.text import json_text

    if name is not None:
        one_of("law", name, tuple(registry))
    chosen = registry.values() if name is None else [registry[name]]
    if as_json:
        found = {law.name: _law_facts(law) for law in chosen}
        typer.echo(json_text(found if name is None else found[name]))
    elif name is None:
        print_page(
            "Laws", "closed forms for capillary bridges; pendular laws NAME tells all of one", tables.laws_table(chosen)
        )
    else:
        print_page(registry[name].name, registry[name].title, tables.law_page(registry[name]))


def _law_facts(law: "Law") -> dict[str, Any]:
    """Record of a law as plain data, with its measured errors."""
    from ...comparison.measured import FRACTIONS, measured_errors

    words = ("name", "title", "control", "gives", "formula", "valid", "valid_text", "angle_rule", "size_rule")
    sources = ("reference", "doi", "equations", "provenance", "errata")
    measured = measured_errors(law)
    return {
        **{field: getattr(law, field) for field in (*words, *sources)},
        "variables": [vars(variable) for variable in law.variables],
        "measured_errors": {
            f"{law.control}_star": measured.control_star,
            "contact_angle_degrees": measured.contact_angle,
            "smaller_over_larger_radius": measured.smaller_over_larger,
            "fraction_of_rupture": FRACTIONS,
            **measured.errors._asdict(),
        },
    }


@question_command(
    "--radius 50um --contact-angle 20 --volume 1pL --plot laws.svg\n"
    "  pendular compare --map zhao2020 --fraction 0.9 --plot map.png\n"
    "  pendular compare --recommend --reduced-volume 1e-4 1e-2 --contact-angle-range 0 40\n"
    "  pendular compare --radius 50um --volume 1pL --law laws.py:my_law",
    has_other_uses=True,
)
def compare(
    shared: dict[str, Any],
    map_of: Annotated[
        str | None,
        typer.Option("--map", help="Instead: map of the error of a law over H* or V* and angle.", metavar="LAW"),
    ] = None,
    fraction: Annotated[
        float | None, typer.Option(help="For the map: separation over rupture distance, 0.5.", metavar="NUMBER")
    ] = None,
    recommend: Annotated[
        bool, typer.Option("--recommend", help="Instead: rank the laws by their largest error over the ranges below.")
    ] = False,
    reduced_suction: Annotated[_Range | None, _range("H* = suction x R/surface tension, 10 1e4,")] = None,
    reduced_volume: Annotated[_Range | None, _range("or V* = volume/R^3, 1e-4 1e-2; R = 2 R1 R2/(R1+R2).")] = None,
    contact_angle_range: Annotated[_Range | None, _range("Contact angles in degrees, 0 40; else 0.")] = None,
    ratio_range: Annotated[_Range | None, _range("Larger over smaller radius, 1 8; inf is a plane; else 1.")] = None,
    up_to: Annotated[
        float | None, typer.Option(help="Largest separation over rupture distance, 0.9.", metavar="NUMBER")
    ] = None,
    own: Annotated[
        list[str] | None,
        typer.Option(
            "--law", help="A law of yours beside the others: a record in a file of Python.", metavar="FILE:NAME"
        ),
    ] = None,
) -> None:
    """Laws side by side with the exact solution: for a pair, as a map, or ranked."""
    for place in own or ():
        _register(place)
    ranges = {
        "reduced_suction": reduced_suction,
        "reduced_volume": reduced_volume,
        "contact_angle_range": contact_angle_range,
        "ratio_range": ratio_range,
        "up_to": up_to,
    }
    if map_of is not None:
        _refuse(_asked(shared) | {"recommend": recommend or None} | ranges, "map")
        _show_map(map_of, fraction, shared)
    elif recommend:
        _refuse(_asked(shared) | {"fraction": fraction, "plot": shared["plot"]}, "recommend")
        _show_recommendation(ranges, shared)
    else:
        _refuse({"fraction": fraction}, None, "map")
        _refuse(ranges, None, "recommend")
        _show_comparison(shared)


def _register(place: str) -> None:
    """Run a file of Python, and register the law that it holds under a name."""
    from ...ground.files import in_one_line
    from ...laws import register

    file, colon, name = place.rpartition(":")
    if not (colon and file and name):
        raise ValueError(f"law: {place!r} is not FILE:NAME, like laws.py:my_law")
    with in_one_line("law", Path(file), "read"):
        try:
            found = run_path(file)
        except OSError:
            raise
        except Exception as error:
            raise ValueError(f"law: {file} fails with {type(error).__name__}: {error}") from error
    if name not in found:
        raise ValueError(f"law: {file} has no {name}")
    register(found[name])


def _asked(shared: dict[str, Any]) -> dict[str, Any]:
    """What was given of the shared options that ask for a pair; they have defaults."""
    import inspect

    defaults = {name: p.default for name, p in inspect.signature(read_question).parameters.items()}
    return {n: value for n, value in shared.items() if n not in _FORMS and value != defaults[n]}


def _refuse(options: dict[str, Any], beside: str | None, needed: str = "") -> None:
    """Refuse options that have no effect, rather than not to heed them."""
    for name, value in options.items():
        if value is not None:
            place = f"beside {beside}" if beside else f"without {needed}"
            raise ValueError(f"{name.replace('_', '-')}: has no effect {place}")


def _show_comparison(shared: dict[str, Any]) -> None:
    from ...comparison import compare, plots, tables
    from ...show.text import csv_text, json_text

    question = read_question(**shared).of_one_value()
    held: dict[str, Any] = {**question.control}
    found = compare(question.pair, **held, liquid=question.liquid)
    if question.picture is not None:
        save_picture(plots.comparison_figure(found, title=question.title, subtitle=question.subtitle), question.picture)
    if question.form == "json":
        typer.echo(json_text(_comparison_facts(found)))
    elif question.form == "csv":
        typer.echo(csv_text(_comparison_columns(found)), nl=False)
    else:
        print_answer(question, tables.comparison_table(found))


def _comparison_facts(found: "Comparison") -> dict[str, Any]:
    laws = {answer.name: answer._asdict() for answer in found.laws}
    kept = found._asdict()
    del kept["pair"]
    return {**kept, "laws": laws}


def _comparison_columns(found: "Comparison") -> list[Any]:
    """Exact states, then force and error of every law that gives a force."""
    from ...show.text import Column

    exact = [("separation", "m"), ("force", "N"), ("suction", "Pa"), ("volume", "m^3")]
    columns = [Column("fraction", "", found.fraction)]
    columns += [Column(name, unit, getattr(found, name)) for name, unit in exact]
    for answer in found.laws:
        if not math.isnan(answer.largest_error):
            columns += [Column(answer.name, "N", answer.force), Column(f"{answer.name} error", "", answer.error)]
    return columns


def _show_map(law: str, fraction: float | None, shared: dict[str, Any]) -> None:
    from ...comparison import error_map, plots, tables
    from ...show.text import csv_text, json_text

    form, picture = read_form(*(shared[name] for name in _FORMS)), shared["plot"]
    found = error_map(law, fraction=fraction)
    if picture is not None:
        save_picture(plots.map_figure(found), picture)
    if form == "json":
        typer.echo(json_text(found._asdict()))
    elif form == "csv":
        typer.echo(csv_text(_map_columns(found)), nl=False)
    else:
        print_page(law, f"error of the {found.in_words}, two equal spheres", tables.map_table(found), picture)


def _map_columns(found: "ErrorMap") -> list[Any]:
    from ...show.text import Column

    rows, columns = found.error.shape
    return [
        Column(f"{found.control}_star", "", found.control_star.repeat(columns)),
        Column("contact_angle", "rad", list(found.contact_angle) * rows),
        Column("error", "", found.error.ravel()),
    ]


def _show_recommendation(ranges: dict[str, Any], shared: dict[str, Any]) -> None:
    from ...comparison import Ranked, recommend, tables
    from ...show.text import Column, csv_text, json_text

    form = read_form(*(shared[name] for name in _FORMS))
    degrees = ranges["contact_angle_range"] or (0.0, 0.0)
    last = ranges["up_to"]
    found = recommend(
        reduced_suction=ranges["reduced_suction"],
        reduced_volume=ranges["reduced_volume"],
        contact_angle=[math.radians(angle) for angle in degrees],
        size_ratio=ranges["ratio_range"] or (1.0, 1.0),
        **({} if last is None else {"up_to": last}),
    )
    if form == "json":
        typer.echo(json_text(found._asdict() | {"ranked": [law._asdict() for law in found.ranked]}))
    elif form == "csv":
        typer.echo(
            csv_text([Column(name, "", [getattr(law, name) for law in found.ranked]) for name in Ranked._fields]),
            nl=False,
        )
    else:
        print_page("Recommendation", tables.sample_words(found), tables.recommendation_table(found))
