"""The command that writes the plug-in for LAMMPS."""

from pathlib import Path
from typing import Annotated

import typer

from ._app import compiling_shown
from .export import export

__all__ = ["lammps"]


@export.command(epilog="\b\nExample:\n  pendular export lammps --out plugin --build")
def lammps(
    out: Annotated[Path, typer.Option(help="Write the sources into this folder: plugin.", metavar="DIR")],
    build: Annotated[
        bool, typer.Option("--build", help="Build it with g++, against the LAMMPS that this Python has.")
    ] = False,
) -> None:
    """Exact bridges inside LAMMPS: a plug-in as sources, with the one line that builds it."""
    from ...codes import lammps as plugin

    with compiling_shown():
        if build:
            made = plugin.build(out)
            typer.echo(f"{made}: put this into the input of LAMMPS\n\n  plugin load {made}")
            return
        written = plugin.write(out)
    typer.echo(f"{out}: {len(written)} files. Build the plug-in there:\n\n  cd {out} && {plugin.build_line()}")
