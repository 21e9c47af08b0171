"""The library as files: its header, and what is linked with it."""

import shutil
import subprocess
import tempfile
from importlib.resources import files
from pathlib import Path
from string import Template

from ... import __version__
from ...ground.compile import has_compiler
from ...ground.files import in_one_line, whole
from ...ground.linkable import linkable, processor
from .archive import archive
from .kernels import FAILED, FUNCTIONS

__all__ = ["HEADER", "SHARED", "STATIC", "header", "linker", "write"]

HEADER, STATIC, SHARED = "pendular.h", "libpendular.a", "libpendular.so"
_LINKERS = ("cc", "gcc", "clang")


def header() -> str:
    """Text of the header for this machine."""
    text = (files(__package__) / HEADER).read_text(encoding="utf-8")
    return Template(text).substitute(version=__version__, processor=processor())


def linker() -> str | None:
    """C compiler that links the shared library, None if there is none."""
    return next(filter(None, map(shutil.which, _LINKERS)), None)


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
    if not has_compiler():
        raise ValueError("library: needs numba, which compiles it; pip install numba")
    code = linkable(FUNCTIONS, FAILED)
    contents = {
        HEADER: header().encode(),
        STATIC: archive("pendular.o", code, [function.name for function in FUNCTIONS]),
    }
    if (compiler := linker()) is not None:
        contents[SHARED] = _shared(compiler, code)
    with in_one_line("out", folder):
        folder.mkdir(parents=True, exist_ok=True)
    written = [folder / name for name in contents]
    for path in written:
        with in_one_line("out", path), whole(path) as draft:
            draft.write_bytes(contents[path.name])
    return written


def _shared(compiler: str, code: bytes) -> bytes:
    """Shared library of an object file."""
    with tempfile.TemporaryDirectory() as name:
        source, made = Path(name) / "pendular.o", Path(name) / SHARED
        source.write_bytes(code)
        command = [compiler, "-shared", f"-Wl,-soname,{SHARED}", "-o", str(made), str(source), "-lm"]
        done = subprocess.run(command, check=False, capture_output=True, text=True)
        if done.returncode != 0:
            reason = (done.stderr.strip().splitlines() or ["no reason told"])[-1]
            raise ValueError(f"library: {compiler} cannot link {SHARED}: {reason}")
        return made.read_bytes()
