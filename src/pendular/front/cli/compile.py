"""The command that compiles ahead of use, in the build of a container for one."""

import typer

from ...ground.compile import has_compiler
from ._app import app, compiling_shown, warnings_in_one_line

__all__ = ["compile_kernels"]


@app.command("compile", epilog="\b\nExample:\n  PENDULAR_CACHE_DIR=/opt/pendular pendular compile")
def compile_kernels() -> None:
    """Compile the solver ahead of its first use, once on a machine: for the build of a container."""
    if not has_compiler():
        raise ValueError("compile: numba is not installed; pip install numba")
    from ...ground.native import folder
    from ..ahead import compile_ahead

    with warnings_in_one_line(), compiling_shown():
        for ready in compile_ahead():
            typer.echo(f"ready: {ready}")
    typer.echo(f"machine code: {folder()}")
