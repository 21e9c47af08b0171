"""The server of the page: it hands out files, on this machine only unless told otherwise, and computes nothing."""

import gzip
import webbrowser
from collections.abc import Callable, Mapping
from functools import cached_property
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import urlsplit

import typer

from .files import page_files

__all__ = ["serve", "server_of"]

_TYPES = {"html": "text/html; charset=utf-8", "js": "text/javascript; charset=utf-8"}


class _File:
    """A file, which may be made when it is first asked for."""

    def __init__(self, name: str, content: bytes | Callable[[], bytes]) -> None:
        self.kind = _TYPES[name.rpartition(".")[2]]
        self._content = content

    @cached_property
    def content(self) -> bytes:
        """What it holds."""
        return self._content if isinstance(self._content, bytes) else self._content()

    @cached_property
    def packed(self) -> bytes:
        """The same in fewer bytes."""
        return gzip.compress(self.content)


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
        If the port cannot be used, or the page cannot be made.
    """
    with server_of(host, port, page_files()) as server:
        address = f"http://{host}:{port}/"
        typer.echo(f"Pendular explorer at {address} (Ctrl+C ends it)")
        if open_browser:
            webbrowser.open(address)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            typer.echo()


def server_of(host: str, port: int, contents: Mapping[str, bytes | Callable[[], bytes]]) -> ThreadingHTTPServer:
    """Server of files by their names, of which ``index.html`` answers the bare address.

    Raises
    ------
    ValueError
        If the port cannot be used.
    """
    known = {f"/{name}": _File(name, content) for name, content in contents.items()}
    known["/"] = known["/index.html"]
    try:
        return ThreadingHTTPServer((host, port), lambda *request: _Answer(known, *request))
    except OSError as error:
        reason = str(error.strerror).partition(" (")[0]
        raise ValueError(f"port: {port} of {host} cannot be used: {reason}; choose another") from error


class _Answer(BaseHTTPRequestHandler):
    """One of the files, packed for a browser that takes it so."""

    protocol_version = "HTTP/1.1"

    def __init__(self, known: Mapping[str, _File], *request: Any) -> None:
        self._known = known
        super().__init__(*request)

    def do_GET(self) -> None:
        found = self._known.get(urlsplit(self.path).path)
        if found is None:
            self.send_error(404)
            return
        is_packed = "gzip" in self.headers.get("Accept-Encoding", "")
        try:
            content = found.packed if is_packed else found.content
        except ValueError as error:
            self.send_error(500, str(error))
            return
        self.send_response(200)
        self.send_header("Content-Type", found.kind)
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Cache-Control", "no-cache")
        if is_packed:
            self.send_header("Content-Encoding", "gzip")
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, format: str, *words: Any) -> None:
        """Say nothing about what is asked."""
