"""The command that writes the plug-in for LAMMPS."""

from pathlib import Path
from typing import Annotated

import typer

from ._app import compiling_shown
from .export import export

__all__ = ["lammps"]


@export.command(epilog="\b\nExample:\n  pendular export lammps --out lammps-pendular")
def lammps(
    out: Annotated[Path, typer.Option(help="Write the sources into this folder: lammps-pendular.", metavar="DIR")],
) -> None:
    """Exact bridges inside LAMMPS: a plug-in as sources, with the one line that builds it."""
    from ...codes.lammps.write import build_line, write

    with compiling_shown():
        written = write(out)
    typer.echo(f"{out}: {len(written)} files. Build the plug-in there:\n\n  cd {out} && {build_line()}")
