"""Commands that carry bridges into other people's particle codes."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..options import read_contact_angle, read_form
from ._app import app, compiling_shown, help_if_alone, print_page, save_picture

if TYPE_CHECKING:
    from rich.console import RenderableType

    from ...codes.yade import Audit

__all__ = ["export", "yade"]

_BEYOND = 1  # exit status where an error is larger than the tolerance, or a file has a fault

export = typer.Typer(
    name="export", rich_markup_mode=None, help="Bridges for particle codes: tables and files that they read."
)
app.add_typer(export)


@export.callback(
    invoke_without_command=True, epilog="\b\nExample:\n  pendular export yade --contact-angle 20 --out tables"
)
def _start(context: typer.Context) -> None:
    """Bridges for particle codes: the files that they read."""
    help_if_alone(context)


@export.command(
    epilog="\b\nExample:\n  pendular export yade --contact-angle 20 --out tables --suffix _th20\n"
    "  pendular export yade --check tables --suffix _th20 --plot error.png"
)
def yade(
    contact_angle: Annotated[
        str | None, typer.Option(help="Contact angle on both spheres: 20 or 20deg, 0.35rad.", metavar="ANGLE")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Write a set of tables into this folder,", metavar="DIR")] = None,
    check: Annotated[
        Path | None, typer.Option(help="or measure the errors of the set that is in it.", metavar="DIR")
    ] = None,
    suffix: Annotated[str, typer.Option(help="End of the file names, suffCapFiles in YADE: _th20.")] = "",
    tolerance: Annotated[
        float, typer.Option(help="Largest error of the force in YADE, over the force at contact.", metavar="NUMBER")
    ] = 1e-3,
    reduced_suction: Annotated[
        float | None,
        typer.Option(help="To write: largest suction x larger radius / surface tension; else 1e4.", metavar="NUMBER"),
    ] = None,
    plot: Annotated[
        Path | None, typer.Option(help="Draw the error in YADE: error.svg, .png or .pdf.", metavar="FILE")
    ] = None,
) -> None:
    """Tables for YADE's capillary laws, with the error that YADE will make; or a check of tables."""
    theta = None if contact_angle is None else _acute("contact-angle", contact_angle)
    read_form(False, False, plot)
    if (out is None) == (check is None):
        raise ValueError("out: give a folder to write to, or one to check")
    with compiling_shown():
        if check is not None:
            if reduced_suction is not None:
                raise ValueError("reduced-suction: has no effect beside check; the tables have their own")
            _check(check, suffix, theta, tolerance, plot)
        elif theta is None:
            raise ValueError("contact-angle: missing; write it like 20")
        elif out is not None:
            _write(out, suffix, theta, tolerance, 1e4 if reduced_suction is None else reduced_suction, plot)


def _acute(name: str, text: str) -> float:
    """Contact angle below 90°, beyond which no suction holds a bridge apart, [rad]."""
    degrees = read_contact_angle(name, text)
    if degrees >= 90.0:
        raise ValueError(f"{name}: {degrees:.10g} deg is not in [0, 90); no suction holds a bridge apart beyond it")
    return math.radians(degrees)


def _write(out: Path, suffix: str, theta: float, tolerance: float, reduced_suction: float, plot: Path | None) -> None:
    from ...codes.yade import export as write

    done = write(out, theta, suffix=suffix, tolerance=tolerance, reduced_suction=reduced_suction)
    files = f"10 tables, {done.points_path.name} with {done.points} points ({done.points_size / 1e6:.1f} MB)"
    told = f"{_angle(done.audit)}  ·  {files}, {done.note_path.name}"
    _show(f"YADE tables written to {out}", told, done.audit, tolerance, plot)


def _check(folder: Path, suffix: str, theta: float | None, tolerance: float, plot: Path | None) -> None:
    from ...codes.yade import audit, folder_texts

    found = audit(folder_texts(folder, suffix), theta)
    told = _angle(found) if theta is not None else f"{_angle(found)}, as the rows at contact have it"
    _show(f"YADE tables in {folder}", told, found, tolerance, plot)


def _angle(audit: "Audit") -> str:
    return f"contact angle {math.degrees(audit.contact_angle):.4g}°"


def _show(title: str, told: str, audit: "Audit", tolerance: float, plot: Path | None) -> None:
    """Print and draw an audit, and leave with a status that tells whether all is within the tolerance."""
    from rich.console import Group

    from ...codes.yade.picture import audit_figure
    from ...codes.yade.report import LEGEND, between_sheet, fault_lines, file_sheet, row_sheet, verdict

    if plot is not None:
        if not audit.tables:
            raise ValueError("plot: there is nothing to draw, as no table can be read")
        save_picture(audit_figure(audit), plot)
    parts: list[RenderableType] = [file_sheet(audit)]
    if any(file.at_rows is not None for file in audit.files):
        parts += ["", "errors of the rows themselves:", row_sheet(audit)]
    if audit.between:
        parts += ["", "between the ten ratios, where YADE mixes two tables:", between_sheet(audit)]
    parts += ["", LEGEND]
    faults = list(fault_lines(audit))
    parts += ["", *faults] if faults else []
    print_page(title, told, Group(*parts, "", verdict(audit, tolerance)), plot)
    if not audit.is_within(tolerance):
        raise typer.Exit(_BEYOND)
