"""The library as files: its header, and what is linked with it."""

from importlib.resources import files
from pathlib import Path
from string import Template

from ... import __version__
from ...ground.compile import has_compiler
from ...ground.linkable import linkable, processor
from ...ground.linking import linker, shared_library
from ..folder import write_folder
from .archive import archive
from .kernels import FAILED, FUNCTIONS

__all__ = ["HEADER", "SHARED", "STATIC", "header", "static_files", "write"]

HEADER, STATIC, SHARED = "pendular.h", "libpendular.a", "libpendular.so"


def header() -> str:
    """Text of the header for this machine."""
    text = (files(__package__) / HEADER).read_text(encoding="utf-8")
    return Template(text).substitute(version=__version__, processor=processor())


def static_files() -> dict[str, bytes]:
    """The header and the static library, by their names."""
    if not has_compiler():
        raise ValueError("library: needs numba, which compiles it; pip install numba")
    names = [function.name for function in FUNCTIONS]
    return {HEADER: header().encode(), STATIC: archive("pendular.o", linkable(FUNCTIONS, FAILED), names)}


def write(folder: Path) -> list[Path]:
    """Write the header, the static library, and with a C compiler the shared one, into a folder.

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
        If Numba is not installed, or a file cannot be written.
    """
    contents = static_files()
    if (compiler := linker()) is not None:
        contents[SHARED] = shared_library(compiler, SHARED, [linkable(FUNCTIONS, FAILED)])
    return write_folder(folder, contents)
