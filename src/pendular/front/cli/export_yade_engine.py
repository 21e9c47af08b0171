"""The command that writes what gives YADE exact bridges without its own tables."""

from pathlib import Path
from typing import Annotated

import typer

from .export import export

__all__ = ["yade_engine"]


@export.command(
    epilog="\b\nExample:\n  pendular export yade-engine --out engine\n"
    "  pendular export table --contact-angle 20 --out w.bridges"
)
def yade_engine(
    out: Annotated[Path, typer.Option(help="Write the module into this folder: engine.", metavar="DIR")],
) -> None:
    """Bridges of any sizes, flat walls and both controls for YADE: a module for its Python that reads a table file."""
    from ...codes.yade.engine import SHARED, write

    written = write(out)
    told = [f"{path}: {path.stat().st_size / 1e3:.0f} kB" for path in written]
    if not any(path.name == SHARED for path in written):
        told.append(f"{SHARED}: not written, for there is no C compiler (cc, gcc or clang) to make it")
    typer.echo("\n".join(told))
