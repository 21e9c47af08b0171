"""The command that writes the exact solver as a library for C."""

from pathlib import Path
from typing import Annotated

import typer

from ._app import compiling_shown
from .export import export

__all__ = ["library"]


@export.command(epilog="\b\nExample:\n  pendular export library --out lib\n  gcc main.c -I lib lib/libpendular.a -lm")
def library(
    out: Annotated[Path, typer.Option(help="Write header and libraries into this folder: lib.", metavar="DIR")],
) -> None:
    """The exact solver as a static and a shared library with a C header, for programs without Python."""
    from ...codes.library.write import SHARED, write

    with compiling_shown():
        written = write(out)
    told = [f"{path}: {path.stat().st_size / 1e3:.0f} kB" for path in written]
    if not any(path.name == SHARED for path in written):
        told.append(f"{SHARED}: not written, for there is no C compiler (cc, gcc or clang) to link it")
    typer.echo("\n".join(told))
