"""The command that writes the cohesion model for LIGGGHTS."""

from pathlib import Path
from typing import Annotated

import typer

from .export import export

__all__ = ["liggghts"]


@export.command(
    epilog="\b\nExample:\n  pendular export liggghts --out model\n"
    "  pendular export table --contact-angle 20 --out pendular.bridges\n  make -C model"
)
def liggghts(
    out: Annotated[Path, typer.Option(help="Write the sources into this folder: model.", metavar="DIR")],
) -> None:
    """A cohesion model for LIGGGHTS 3.8 that reads a table of exact bridges: its sources and a Makefile."""
    from ...codes.liggghts import write

    typer.echo("\n".join(f"{path}: {path.stat().st_size / 1e3:.0f} kB" for path in write(out)))
