"""The command that opens the explorer page."""

from typing import Annotated

import typer

from ._app import app, compiling_shown

__all__ = ["explore"]


@app.command(epilog="\b\nExample:\n  pendular explore --port 8081 --no-browser")
def explore(
    port: Annotated[int, typer.Option(help="Port to listen on.", min=1, max=65535)] = 8080,
    host: Annotated[str, typer.Option(help="Address to listen on; by default of this machine only.")] = "127.0.0.1",
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page in a browser.")] = True,
) -> None:
    """A page with sliders, which computes in the browser: the pair drawn to scale, its curves, its numbers."""
    from ..explorer.server import serve

    with compiling_shown():
        serve(host, port, open_browser=browser)
