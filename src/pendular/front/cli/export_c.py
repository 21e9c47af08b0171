"""The command that writes the answers of a table as a C header."""

import math
from pathlib import Path
from typing import Annotated

import typer

from ...ground.files import in_one_line, whole
from ._tables import Angle, Ratios, SecondAngle, Volumes, tabulated
from .export import export

__all__ = ["c"]

_SUCTIONS, _TOLERANCE = (0.1, 1e4), 1e-6


@export.command(
    epilog="\b\nExample:\n  pendular export c --contact-angle 20 --out bridge.h\n"
    "  pendular export c --contact-angle 20 --reduced-volume 1e-3 0.015 --radius-ratio 1 1.2 --tolerance 1e-4 --out b.h"
)
def c(
    contact_angle: Angle,
    out: Annotated[Path, typer.Option(help="Write the header here: bridge.h.", metavar="FILE")],
    contact_angle2: SecondAngle = None,
    reduced_suction: Annotated[
        tuple[float, float] | None,
        typer.Option(help="Range of suction x mean radius / surface tension; else 0.1 to 1e4.", metavar="MIN MAX"),
    ] = None,
    reduced_volume: Volumes = None,
    radius_ratio: Ratios = (1.0, math.inf),
    tolerance: Annotated[
        float, typer.Option(help="Largest error of the force, over that at contact.", metavar="NUMBER")
    ] = _TOLERANCE,
    prefix: Annotated[str, typer.Option(help="Begins all names in the header.", metavar="NAME")] = "pendular_",
) -> None:
    """Force, stiffness, rupture distance and volume (or suction) of bridges as one C header, for any particle code."""
    suctions = _SUCTIONS if reduced_suction is None and reduced_volume is None else reduced_suction
    table = tabulated(contact_angle, contact_angle2, suctions, reduced_volume, radius_ratio, tolerance)
    from ...codes.c_header import bound_lines, c_header

    text = c_header(table, prefix=prefix)
    with in_one_line("out", out), whole(out) as draft:
        draft.write_text(text, encoding="utf-8")
    typer.echo("\n".join([f"{out}: {len(text) / 1e6:.2f} MB", *bound_lines(table)]))
