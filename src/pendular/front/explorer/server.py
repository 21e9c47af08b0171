"""The server of the page: on this machine only unless told otherwise, with all that it needs in the package."""

import socket
from pathlib import Path

import typer
from nicegui import app, run, ui
from starlette.requests import Request

from ...ground import colours
from .answer import answer_to
from .page import Explorer
from .view import View

__all__ = ["serve"]

_HERE = Path(__file__).parent
_LOGO = (_HERE / "logo.svg").read_text(encoding="utf-8")
_STYLE = (_HERE / "style.css").read_text(encoding="utf-8")
_SCRIPT = (_HERE / "page.js").read_text(encoding="utf-8")
_TITLE = "Pendular explorer"
_ADVANCE = "The solver is being prepared. The first time on a machine it is compiled, which takes about a minute."

# What has to be compiled, or read from the disk, before an answer comes at once.
_WARMING = (
    View(laws=("zhao2020",)),
    View(control="volume", value="5 pL", laws=("zhao2020",)),
    View(liquid="ethanol", radius2="plane", control="humidity", value="99 %"),
)


def serve(host: str, port: int, *, open_browser: bool) -> None:
    """Serve the page until it is interrupted.

    Parameters
    ----------
    host : str
        Address to listen on.
    port : int
        Port to listen on.
    open_browser : bool
        Whether to show the page at once.

    Raises
    ------
    ValueError
        If the port cannot be used.
    """
    _refuse_taken(host, port)
    ready: list[bool] = []

    async def prepare() -> None:
        try:
            await run.io_bound(_warm_up)
        finally:
            ready.append(True)

    @ui.page("/", title=_TITLE)
    async def explorer(request: Request) -> None:
        ui.add_css(_palette() + _STYLE)
        ui.add_head_html(f"<script>{_SCRIPT}</script>")
        ui.colors(primary=colours.LIQUID_EDGE)
        _lay_out_head()
        parameters = dict(request.query_params)
        with ui.element("div").classes("explorer") as body:
            if ready:
                Explorer(parameters)
                return
            notice = ui.label(_ADVANCE).classes("advance").props("role=status")

        def look() -> None:
            if ready:
                timer.deactivate()
                notice.delete()
                with body:
                    Explorer(parameters)

        timer = ui.timer(0.2, look)

    app.on_startup(prepare)
    app.on_startup(lambda: typer.echo(f"Pendular explorer at http://{host}:{port}/ (Ctrl+C ends it)"))
    ui.run(
        host=host,
        port=port,
        title=_TITLE,
        favicon=_LOGO,
        language="en-GB",
        show=open_browser,
        reload=False,
        tailwind=False,
        binding_refresh_interval=None,
        show_welcome_message=False,
    )


def _refuse_taken(host: str, port: int) -> None:
    try:
        with socket.create_server((host, port)):
            pass
    except OSError as error:
        reason = str(error.strerror).partition(" (")[0]
        raise ValueError(f"port: {port} of {host} cannot be used: {reason}; choose another") from error


def _warm_up() -> None:
    for view in _WARMING:
        answer_to(view)


def _palette() -> str:
    """Colours of the pictures for the style sheet."""
    names = ("INK", "FAINT", "HAIR", "GRAIN", "GRAIN_EDGE", "LIQUID", "LIQUID_EDGE", "ACCENT")
    lines = (f"--{name.lower().replace('_', '-')}: {getattr(colours, name)};" for name in names)
    return f":root {{ {' '.join(lines)} }}\n"


def _lay_out_head() -> None:
    with ui.element("header"):
        ui.html(_LOGO, sanitize=False).classes("logo")
        ui.html("Pendular", sanitize=False, tag="h1")
        ui.html("a capillary bridge, exactly", sanitize=False, tag="p")
