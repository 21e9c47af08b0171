"""The command that compiles ahead of use, in the build of a container for one."""

import os
import time
from pathlib import Path
from typing import Annotated

import typer

from ...ground.files import in_one_line
from ._app import app, warnings_in_one_line

__all__ = ["compile_kernels"]


@app.command("compile", epilog="\b\nExample:\n  pendular compile --folder /opt/pendular")
def compile_kernels(
    folder: Annotated[
        Path | None,
        typer.Option(
            help="Keep it here; processes find it there by the variable PENDULAR_CACHE_DIR. Else in the user's cache.",
            metavar="DIR",
        ),
    ] = None,
) -> None:
    """Machine code for many bridges, made ahead of time: in the build of a container, or before a cluster starts."""
    from ...ground.compile import has_compiler

    if not has_compiler():
        raise ValueError("compile: numba is not installed; pip install numba")
    if folder is not None:
        with in_one_line("folder", folder):
            folder.mkdir(parents=True, exist_ok=True)
        os.environ["PENDULAR_CACHE_DIR"] = str(folder.resolve())
    from ...ground.native import folder as place
    from ..ahead import Made, compile_ahead

    def told(made: Made) -> None:
        typer.echo(f"{made.name:56} {f'{made.seconds:6.1f} s' if made.seconds else 'there already'}")

    start = time.perf_counter()
    with warnings_in_one_line():
        for _ in compile_ahead(told):
            pass
    files = list(place().glob("*.o"))
    size = sum(file.stat().st_size for file in files) / 1e6
    typer.echo(f"{len(files)} files, {size:.1f} MB, in {place()}, after {time.perf_counter() - start:.0f} s")
