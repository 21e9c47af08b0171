"""The command that writes a table as the binary file that particle codes read."""

import math
from pathlib import Path
from typing import Annotated

import typer

from ...ground.files import in_one_line, whole
from ._app import compiling_shown
from ._tables import Angle, Ratios, SecondAngle, Volumes, tabulated
from .export import export

__all__ = ["table"]


@export.command(
    epilog="\b\nExample:\n  pendular export table --contact-angle 20 --out w.bridges --header pendular_table.h\n"
    "  pendular export table --contact-angle 20 --reduced-volume 1e-3 0.015 --radius-ratio 1 1.2 --tolerance 1e-4 "
    "--out v.bridges"
)
def table(
    contact_angle: Angle,
    out: Annotated[Path, typer.Option(help="Write the table here: w.bridges.", metavar="FILE")],
    contact_angle2: SecondAngle = None,
    reduced_suction: Annotated[
        tuple[float, float] | None,
        typer.Option(help="Range of suction x mean radius / surface tension; else 1e-2 to 1e8.", metavar="MIN MAX"),
    ] = None,
    reduced_volume: Volumes = None,
    radius_ratio: Ratios = (1.0, math.inf),
    tolerance: Annotated[
        float | None,
        typer.Option(
            help="Largest error of the force, over that at contact; else 1e-8, or 1e-7 where the volume is held.",
            metavar="NUMBER",
        ),
    ] = None,
    channel: Annotated[
        list[str] | None,
        typer.Option(
            help="Hold this as well, may be repeated: neck_radius, area, across_tensor, axial_tensor, and "
            "half_filling_mean, half_filling_slope, or half_filling1, half_filling2 of two contact angles.",
            metavar="NAME",
        ),
    ] = None,
    header: Annotated[
        Path | None,
        typer.Option(help="Write what reads it in C, C++ and CUDA as well: pendular_table.h.", metavar="FILE"),
    ] = None,
) -> None:
    """Force, stiffness, energy, rupture distance and volume (or suction) as one binary file, for any particle code."""
    from ...ground.check import one_of
    from ...table.binary import SUFFIX, told_channels
    from ...table.channels import known

    if out.suffix != SUFFIX:
        raise ValueError(f"out: '{out}' does not end in {SUFFIX}")
    if not out.parent.is_dir():
        raise ValueError(f"out: '{out.parent}' is not a folder to write to")
    sides = 1 if contact_angle2 in (None, contact_angle) else 2
    for name in channel or ():
        one_of("channel", name, tuple(known(sides)))
    made = tabulated(contact_angle, contact_angle2, reduced_suction, reduced_volume, radius_ratio, tolerance)
    from ...codes.c_header import bound_lines, table_header

    with compiling_shown():
        made.save(out, channels=channel or ())
    told = [f"{out}: {out.stat().st_size / 1e6:.2f} MB", *bound_lines(made)]
    further = told_channels(out)[3:]
    told += [f"                 {name} {bound:.1e} of {bound_of}" for name, bound, bound_of in further]
    if header is not None:
        with in_one_line("header", header), whole(header) as draft:
            draft.write_text(table_header(), encoding="utf-8")
        told.append(f"{header}: reads it")
    typer.echo("\n".join(told))
