"""The exact solver and the laws as WebAssembly modules for JavaScript: the files that a page needs.

One module answers spheres and planes, which most ask, and the laws; a second one all other solids.
"""

import json
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from string import Template

from ... import __version__
from ...exact.batch import MOST_NODES
from ...exact.state import State
from ...ground.compile import has_compiler
from ...ground.linkable import Function
from ...ground.webassembly import linker, module_of
from ..folder import write_folder
from ..library.kernels import FAILED
from . import solids
from .functions import functions

__all__ = [
    "MODULE", "PACKAGED", "PACKAGED_SOLIDS", "SCRIPT", "SOLIDS_MODULE", "SOLIDS_SCRIPT", "SOLIDS_TYPES", "TYPES",
    "module", "script", "solids_module", "solids_script", "write",
]  # fmt: skip

MODULE, SCRIPT, TYPES = "pendular.wasm", "pendular.mjs", "pendular.d.mts"
SOLIDS_MODULE, SOLIDS_SCRIPT, SOLIDS_TYPES = "solids.wasm", "solids.mjs", "solids.d.mts"
PACKAGED = Path(__file__).with_name(MODULE)  # in a wheel that brings machine code
PACKAGED_SOLIDS = Path(__file__).with_name(SOLIDS_MODULE)


def write(folder: Path) -> list[Path]:
    """Write the modules, and what JavaScript and TypeScript need to call them, into a folder.

    Parameters
    ----------
    folder : Path
        Made if it is not there. Files of the same names in it are replaced.

    Returns
    -------
    list of Path
        What was written.

    Raises
    ------
    ValueError
        If the package has no module, and Numba or the linker ``wasm-ld`` that make it are not installed, or a file
        cannot be written.
    """
    texts = {name: _text(name).encode() for name in (SCRIPT, TYPES, SOLIDS_SCRIPT, SOLIDS_TYPES)}
    return write_folder(folder, {MODULE: module(), SOLIDS_MODULE: solids_module(), **texts})


def module() -> bytes:
    """The module: that of the package, else made here, or kept from when it was.

    Raises
    ------
    ValueError
        If it is not in the package, and what makes it is not installed.
    """
    return _made(PACKAGED, functions())


def solids_module() -> bytes:
    """The module for other solids than spheres and planes, from where the first is.

    Raises
    ------
    ValueError
        If it is not in the package, and what makes it is not installed.
    """
    return _made(PACKAGED_SOLIDS, solids.functions())


def _made(packaged: Path, known: Sequence[Function]) -> bytes:
    if packaged.exists():
        return packaged.read_bytes()
    if not has_compiler():
        raise ValueError("wasm: needs numba, which compiles it; pip install numba")
    if (found := linker()) is None:
        raise ValueError("wasm: needs wasm-ld, which links it; apt-get install lld, or brew install lld")
    return module_of(known, FAILED, found)


def script() -> str:
    """The module of JavaScript that loads and asks it."""
    return _text(SCRIPT)


def solids_script() -> str:
    """The same for other solids."""
    return _text(SOLIDS_SCRIPT)


def _text(name: str) -> str:
    """A file of this package, with the names of a state as the solver has them."""
    text = (files(__package__) / name).read_text(encoding="utf-8")
    told = {
        "version": __version__,
        "fields": json.dumps(State._fields),
        "most_nodes": MOST_NODES,
        "kinds": json.dumps(solids.KINDS),
        "room": json.dumps(solids.ROOM),
        "pair_numbers": len(solids.PAIR),
    }
    return Template(text).safe_substitute(told)
