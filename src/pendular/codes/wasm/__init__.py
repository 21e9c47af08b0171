"""The exact solver and the laws as a WebAssembly module for JavaScript: the files that a page needs."""

import json
from importlib.resources import files
from pathlib import Path
from string import Template

from ... import __version__
from ...exact.batch import MOST_NODES
from ...exact.state import State
from ...ground.compile import has_compiler
from ...ground.webassembly import linker, module_of
from ..folder import write_folder
from ..library.kernels import FAILED
from .functions import functions

__all__ = ["MODULE", "PACKAGED", "SCRIPT", "TYPES", "module", "script", "write"]

MODULE, SCRIPT, TYPES = "pendular.wasm", "pendular.mjs", "pendular.d.mts"
PACKAGED = Path(__file__).with_name(MODULE)  # in a wheel that brings machine code


def write(folder: Path) -> list[Path]:
    """Write the module, and what JavaScript and TypeScript need to call it, into a folder.

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
    return write_folder(folder, {MODULE: module(), SCRIPT: script().encode(), TYPES: _text(TYPES).encode()})


def module() -> bytes:
    """The module: that of the package, else made here, or kept from when it was.

    Raises
    ------
    ValueError
        If it is not in the package, and what makes it is not installed.
    """
    if PACKAGED.exists():
        return PACKAGED.read_bytes()
    if not has_compiler():
        raise ValueError("wasm: needs numba, which compiles it; pip install numba")
    if (found := linker()) is None:
        raise ValueError("wasm: needs wasm-ld, which links it; apt-get install lld, or brew install lld")
    return module_of(functions(), FAILED, found)


def script() -> str:
    """The module of JavaScript that loads and asks it."""
    return _text(SCRIPT)


def _text(name: str) -> str:
    """A file of this package, with the names of a state as the solver has them."""
    text = (files(__package__) / name).read_text(encoding="utf-8")
    told = {"version": __version__, "fields": json.dumps(State._fields), "most_nodes": MOST_NODES}
    return Template(text).safe_substitute(told)
