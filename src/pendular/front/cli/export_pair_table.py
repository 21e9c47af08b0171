"""The command that writes force and energy of one pair for LAMMPS."""

from pathlib import Path
from typing import Annotated

import typer

from ...ground.files import in_one_line, whole
from ...ground.units import read, show
from ..options import Question
from ._app import question_command
from .export import export

__all__ = ["pair_table"]


@question_command(
    "--radius 50um --contact-angle 20 --suction 20kPa --out bridge.table",
    to_file_of=export,
)
def pair_table(
    question: Question,
    out: Annotated[Path, typer.Option(help="Write the table here: bridge.table.", metavar="FILE")],
    keyword: Annotated[str, typer.Option(help="Name of the table in the file.", metavar="NAME")] = "BRIDGE",
    overlap: Annotated[
        str | None,
        typer.Option(help="Depth at which the table begins; else a tenth of the smaller radius.", metavar="LENGTH"),
    ] = None,
    points: Annotated[int, typer.Option(help="Rows, at least 10.")] = 1000,
) -> None:
    """Force and energy of one pair of grains over their distance, for LAMMPS' pair_style table."""
    from ...codes import pair_table as tables

    if not keyword or len(keyword.split()) != 1:
        raise ValueError(f"keyword: {keyword!r} is not one word")
    depth = None if overlap is None else read("overlap", overlap, "m", "5um")
    table = tables.pair_table(question.pair, **question.held, liquid=question.liquid, overlap=depth, points=points)
    text = tables.pair_table_text(table, keyword, question.title, question.subtitle)
    with in_one_line("out", out), whole(out) as draft:
        draft.write_text(text, encoding="utf-8")
    first, last = (show(float(table.distance[i]), "m") for i in (0, -1))
    typer.echo(f"{out}: {points} rows from {first} to {last}, centre to centre; the bridge breaks at the last one")
    typer.echo(f"error of the force between the rows: {100.0 * table.error:.2g} % of the force at contact")
    typer.echo(f"pair_style table linear {points}")
    typer.echo(f"pair_coeff 1 1 {out} {keyword} {float(table.distance[-1])!r}")
