"""Shared libraries of object files, by the C compiler of the machine."""

import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path

__all__ = ["linker", "run", "shared_library"]

_COMPILERS = ("cc", "gcc", "clang")


def linker() -> str | None:
    """C compiler that links shared libraries, None if there is none."""
    return next(filter(None, map(shutil.which, _COMPILERS)), None)


def shared_library(compiler: str, name: str, objects: Iterable[bytes], source: str = "") -> bytes:
    """Shared library of object files, and of a text in C.

    Parameters
    ----------
    compiler : str
        Path of the C compiler.
    name : str
        By which programs look for the library.
    objects : iterable of bytes
        Contents of the object files.
    source : str, optional
        What is compiled with them.

    Raises
    ------
    ValueError
        If it cannot be linked.
    """
    with tempfile.TemporaryDirectory() as folder:
        text, made = Path(folder, "source.c"), Path(folder, name)
        text.write_text(source, encoding="utf-8")
        parts = []
        for number, content in enumerate(objects):
            parts.append(Path(folder, f"{number}.o"))
            parts[-1].write_bytes(content)
        naming = "install_name" if sys.platform == "darwin" else "soname"
        options = ["-O2", "-fPIC", "-shared", f"-Wl,-{naming},{name}"]
        command = [compiler, *options, "-o", str(made), str(text), *map(str, parts), "-lm"]
        run(command, f"library: {compiler} cannot link {name}")
        return made.read_bytes()


def run(command: Sequence[str | Path], failure: str, folder: str | None = None) -> None:
    """Run a compiler or linker, in a folder.

    Raises
    ------
    ValueError
        If it fails: in one line, with what it said last.
    """
    done = subprocess.run(command, cwd=folder, check=False, capture_output=True, text=True)
    if done.returncode != 0:
        reason = (done.stderr.strip().splitlines() or ["no reason told"])[-1]
        raise ValueError(f"{failure}: {reason}")
