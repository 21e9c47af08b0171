"""The page as files: one of HTML with style, words, solver, laws and fit, one of the heap, and one for use offline.

Nothing is a module for the browser, which loads none from a disk: the pair is in the file of HTML, the view of a heap
in a plain script that is loaded when it is first asked for, as is the solver of other solids than spheres and planes.
"""

import base64
import hashlib
import json
import re
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path
from typing import Any
from urllib.parse import quote

from ... import __version__
from ...codes import wasm
from ...codes.folder import write_folder
from ...ground import colours
from .heap_records import heap_records, packings
from .records import records

__all__ = ["as_one", "module_of_page", "page_files", "write_page"]

# Each after those that it imports.
_MODULES = (
    *("units", "kinds", "liquids", "view", "answer", "tracks", "picture", "chart", "map", "words", "fields", "views"),
    *("general", "curve_text", "fit_chart", "fit_words", "fit_panel", "solids_panel", "main"),
)
_HEAP_MODULES = (
    *("grains", "pairs", "wetted", "curves", "space", "raster", "scene"),
    *("heap_view", "heap_answer", "retention_chart", "heap_words", "heap_hands", "heap_picture", "own_grains", "heap"),
)
# Those of the worker that fits, which the page reads when it needs them.
_FIT_MODULES = (
    *("general", "linear", "least_squares", "fit_unknowns", "fit_model", "fit_errors", "fit_search", "fit_worker"),
)
_OF_A_FIT = ("domain", "fitting")  # records
_IMPORT = re.compile(r"^import [^;]*;\n", re.MULTILINE)
_SHARED = re.compile(r"^import \{([^}]*)\} from \"\.\./(\w+)\.mjs\";\n", re.MULTILINE)
_EXPORT = re.compile(r"^export (?=async |const |function )", re.MULTILINE)
_HOLE = re.compile(r"\{(\w+)\}")


SOLIDS = "solids.js"


def page_files() -> dict[str, bytes | Callable[[], bytes]]:
    """Files of the page by their names; one that few ask for is made when it is.

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
        fit=_fit_script(),
        script=_script(wasm.module()),
        version=__version__,
    ).encode()
    heap = _heap_script().encode()
    digest = hashlib.sha256(page + heap).hexdigest()[:16]
    return {
        "index.html": page,
        "heap.js": heap,
        SOLIDS: _solids,
        "offline.js": _filled("offline.js", digest=digest).encode(),
    }


def _solids() -> bytes:
    """The script that brings the solver of other solids."""
    return f'globalThis.PENDULAR_SOLIDS = "{base64.b64encode(wasm.solids_module()).decode()}";\n'.encode()


def write_page(folder: Path) -> list[Path]:
    """Write the page into a folder, which is made if it is not there."""
    contents = {name: content if isinstance(content, bytes) else content() for name, content in page_files().items()}
    return write_folder(folder, contents)


def _script(module: bytes) -> str:
    """All modules of the pair as one, which browsers load from a disk as well."""
    encoded = base64.b64encode(module).decode()
    return as_one(
        wasm.script(),
        wasm.solids_script(),
        _told("RECORDS", records()),
        f'const MODULE = Uint8Array.from(atob("{encoded}"), (letter) => letter.charCodeAt(0));',
        f"const SHARED = () => ({{ {_shared_names()} }});",
        *map(module_of_page, _MODULES),
    )


def _fit_script() -> str:
    """The modules of the worker that fits as one; it is sent the bytes of the solver.

    It is no module, which a page from a disk may not start as a worker.
    """
    known = records()
    solver = wasm.script().replace("import.meta.url", "location.href")
    told = _told("RECORDS", {name: known[name] for name in _OF_A_FIT})
    return as_one('"use strict";', solver, told, *map(module_of_page, _FIT_MODULES))


def _heap_script() -> str:
    """All modules of the heap as a plain script: one function of what they take from the page."""
    told = {**heap_records(), "html": _text("heap/heap.html"), "style": _text("heap/heap.css")}
    body = as_one(_told("HEAP_RECORDS", told), _told("PACKINGS", packings()), *_heap_modules())
    head = f"window.explorer.makeHeap = ({{ {_shared_names()} }}) => {{"
    return f'"use strict";\n{head}\n{body}\nreturn makeHeap();\n}};\n'


def _heap_modules() -> list[str]:
    return [module_of_page(f"heap/{name}") for name in _HEAP_MODULES]


def _shared_names() -> str:
    """What the modules of the heap import from those of the page."""
    found = [names for text in _heap_modules() for names, _ in _SHARED.findall(text)]
    return ", ".join(sorted({name.strip() for names in found for name in names.split(",") if name.strip()}))


def as_one(*parts: str) -> str:
    """Modules as one script, each after those that it imports, for a page that opens from a disk as well."""
    return "\n".join(_EXPORT.sub("", _IMPORT.sub("", part)) for part in parts).replace("</", "<\\/")


def _told(name: str, known: Any) -> str:
    """Records as JavaScript, where an infinite number is one."""
    return f"const {name} = {json.dumps(known, ensure_ascii=False, separators=(',', ':'))};"


def module_of_page(name: str) -> str:
    """A module of the page."""
    return _text(f"{name}.mjs")


def _text(name: str) -> str:
    return (files(__package__) / "static" / name).read_text(encoding="utf-8")


def _filled(name: str, **parts: str) -> str:
    """A file with its holes filled; braces around anything else stay."""
    return _HOLE.sub(lambda found: parts.get(found[1], found[0]), _text(name))


def _palette() -> str:
    """Colours of the pictures for the style sheet."""
    names = ("INK", "FAINT", "HAIR", "GRAIN", "GRAIN_EDGE", "LIQUID", "LIQUID_EDGE", "ACCENT")
    return " ".join(f"--{name.lower().replace('_', '-')}: {getattr(colours, name)};" for name in names)
