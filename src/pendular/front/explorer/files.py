"""The page as files: one of HTML that holds all, style, words, solver and laws, and one that keeps it when offline.

All is in one file so that it opens from a disk as well, where browsers load no modules.
"""

import base64
import hashlib
import json
import re
from importlib.resources import files
from pathlib import Path
from urllib.parse import quote

from ... import __version__
from ...codes import wasm
from ...codes.folder import write_folder
from ...ground import colours
from .records import records

__all__ = ["page_files", "write_page"]

# Each after those that it imports.
_MODULES = ("units", "liquids", "view", "answer", "tracks", "picture", "chart", "map", "words", "main")
_IMPORT = re.compile(r"^import [^;]*;\n", re.MULTILINE)
_EXPORT = re.compile(r"^export (?=async |const |function )", re.MULTILINE)
_HOLE = re.compile(r"\{(\w+)\}")


def page_files() -> dict[str, bytes]:
    """Files of the page by their names.

    Raises
    ------
    ValueError
        If the package has no module of the solver, and it cannot be made here.
    """
    logo = _text("logo.svg").strip()
    page = _filled(
        "index.html",
        icon=quote(logo),
        logo=logo,
        style=_filled("style.css", palette=_palette()),
        script=_script(wasm.module()),
        version=__version__,
    ).encode()
    digest = hashlib.sha256(page).hexdigest()[:16]
    return {"index.html": page, "offline.js": _filled("offline.js", digest=digest).encode()}


def write_page(folder: Path) -> list[Path]:
    """Write the page into a folder, which is made if it is not there."""
    return write_folder(folder, page_files())


def _script(module: bytes) -> str:
    """All modules as one, which browsers load from a disk as well."""
    known = json.dumps(records(), ensure_ascii=False)  # with Infinity, which is a number in JavaScript
    encoded = base64.b64encode(module).decode()
    own = (_text(f"{name}.mjs") for name in _MODULES)
    parts = [
        wasm.script(),
        f"const RECORDS = {known};",
        f'const MODULE = Uint8Array.from(atob("{encoded}"), (letter) => letter.charCodeAt(0));',
        *own,
    ]
    return "\n".join(_EXPORT.sub("", _IMPORT.sub("", part)) for part in parts).replace("</", "<\\/")


def _text(name: str) -> str:
    return (files(__package__) / "static" / name).read_text(encoding="utf-8")


def _filled(name: str, **parts: str) -> str:
    """A file with its holes filled; braces around anything else stay."""
    return _HOLE.sub(lambda found: parts.get(found[1], found[0]), _text(name))


def _palette() -> str:
    """Colours of the pictures for the style sheet."""
    names = ("INK", "FAINT", "HAIR", "GRAIN", "GRAIN_EDGE", "LIQUID", "LIQUID_EDGE", "ACCENT")
    return " ".join(f"--{name.lower().replace('_', '-')}: {getattr(colours, name)};" for name in names)
