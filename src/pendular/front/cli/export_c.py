"""The command that writes the answers of a table as a C header."""

import math
import warnings
from pathlib import Path
from typing import Annotated, Literal

import typer

from ...ground.files import in_one_line, whole
from ..options import read_contact_angle
from ._app import compiling_shown
from .export import export

__all__ = ["c"]

_SUCTIONS, _RATIOS, _TOLERANCE = (0.1, 1e4), (1.0, math.inf), 1e-6


@export.command(
    epilog="\b\nExample:\n  pendular export c --contact-angle 20 --out bridge.h\n"
    "  pendular export c --contact-angle 20 --reduced-volume 1e-3 0.015 --radius-ratio 1 1.2 --tolerance 1e-4 --out b.h"
)
def c(
    contact_angle: Annotated[str, typer.Option(help="Contact angle: 20 or 20deg, 0.35rad.", metavar="ANGLE")],
    out: Annotated[Path, typer.Option(help="Write the header here: bridge.h.", metavar="FILE")],
    contact_angle2: Annotated[
        str | None, typer.Option(help="Contact angle on the second solid, if another: 60.", metavar="ANGLE")
    ] = None,
    reduced_suction: Annotated[
        tuple[float, float] | None,
        typer.Option(help="Range of suction x mean radius / surface tension; else 0.1 to 1e4.", metavar="MIN MAX"),
    ] = None,
    reduced_volume: Annotated[
        tuple[float, float] | None,
        typer.Option(help="Or hold the volume: range of volume / cube of mean radius.", metavar="MIN MAX"),
    ] = None,
    radius_ratio: Annotated[
        tuple[float, float], typer.Option(help="Range of larger over smaller radius.", metavar="MIN MAX")
    ] = _RATIOS,
    tolerance: Annotated[
        float, typer.Option(help="Largest error of the force, over that at contact.", metavar="NUMBER")
    ] = _TOLERANCE,
    prefix: Annotated[str, typer.Option(help="Begins all names in the header.", metavar="NAME")] = "pendular_",
) -> None:
    """Force, stiffness, rupture distance and volume (or suction) of bridges as one C header, for any particle code."""
    second = contact_angle if contact_angle2 is None else contact_angle2
    angles = tuple(
        math.radians(read_contact_angle(name, text))
        for name, text in (("contact-angle", contact_angle), ("contact-angle2", second))
    )
    if reduced_volume is not None and reduced_suction is not None:
        raise ValueError("reduced-volume: given together with reduced-suction; one of the two is held")
    control: Literal["suction", "volume"] = "suction" if reduced_volume is None else "volume"
    reduced = reduced_volume or reduced_suction or _SUCTIONS
    with compiling_shown():
        _write(out, angles, control, reduced, radius_ratio, tolerance, prefix)


def _write(
    out: Path,
    angles: tuple[float, ...],
    control: Literal["suction", "volume"],
    reduced: tuple[float, float],
    ratios: tuple[float, float],
    tolerance: float,
    prefix: str,
) -> None:
    from ...codes.c_header import bound_lines, c_header
    from ...table import ToleranceWarning, tabulate

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ToleranceWarning)  # the lines below say what was reached
        table = tabulate(angles, control, reduced=reduced, radius_ratio=ratios, tolerance=tolerance)
    text = c_header(table, prefix=prefix)
    with in_one_line("out", out), whole(out) as draft:
        draft.write_text(text, encoding="utf-8")
    typer.echo("\n".join([f"{out}: {len(text) / 1e6:.2f} MB", *bound_lines(table)]))
