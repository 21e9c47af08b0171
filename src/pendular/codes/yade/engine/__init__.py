"""Exact bridges in YADE from Python: a module for its interpreter, and the loop over neighbours in C."""

import tempfile
from importlib.resources import files
from pathlib import Path

from ....ground.linking import linker, run
from ...c_header import table_header
from ...folder import write_folder

__all__ = ["OPTIONS", "SHARED", "write"]

SHARED = "libpendular_yade.so"
OPTIONS = ("-std=c99", "-O3", "-march=native", "-shared", "-fPIC")
_MODULE, _LOOP, _EVALUATOR = "pendular_yade.py", "pendular_yade.c", "pendular_table.h"


def write(folder: Path) -> list[Path]:
    """Write the module ``pendular_yade``, its loop in C, and with a C compiler the library that is made of it.

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
        If a file cannot be written, or the compiler fails.
    """
    contents = {name: (files(__package__) / name).read_bytes() for name in (_MODULE, _LOOP)}
    contents[_EVALUATOR] = table_header().encode()
    if (compiler := linker()) is not None:
        contents[SHARED] = _compiled(compiler, contents)
    return write_folder(folder, contents)


def _compiled(compiler: str, contents: dict[str, bytes]) -> bytes:
    """Shared library of the loop, for this processor."""
    with tempfile.TemporaryDirectory() as name:
        write_folder(Path(name), contents)
        command = [compiler, *OPTIONS, "-o", SHARED, _LOOP, "-lm"]
        run(command, f"engine: {compiler} cannot make {SHARED}", name)
        return (Path(name) / SHARED).read_bytes()
