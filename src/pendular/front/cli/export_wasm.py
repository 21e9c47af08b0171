"""The command that writes the exact solver for JavaScript."""

from pathlib import Path
from typing import Annotated

import typer

from ._app import compiling_shown
from .export import export

__all__ = ["wasm"]


@export.command(epilog="\b\nExample:\n  pendular export wasm --out page")
def wasm(
    out: Annotated[Path, typer.Option(help="Write module and script into this folder: page.", metavar="DIR")],
) -> None:
    """The exact solver as a WebAssembly module with a script for JavaScript: for pages, without a server."""
    from ...codes.wasm import write

    with compiling_shown():
        written = write(out)
    typer.echo("\n".join(f"{path}: {path.stat().st_size / 1e3:.0f} kB" for path in written))
