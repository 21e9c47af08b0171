"""The plug-in for LAMMPS as files: its sources, what they include and link, and how they are built."""

from importlib.resources import files
from pathlib import Path
from string import Template

from ... import __version__
from ...ground.files import in_one_line, whole
from ...ground.linkable import processor
from ..c_header import table_header
from ..library.write import static_files

__all__ = ["PLUGIN", "build_line", "write"]

PLUGIN = "pendularplugin.so"
_README, _TABLE = "README.md", "pendular_table.h"
_HEADERS = "import sys, lammps; print(f'-I{lammps.__path__[0]}/include/lammps -I{sys.prefix}/include')"


def build_line() -> str:
    """Command that builds the plug-in in its folder, against the LAMMPS that Python has."""
    return (
        f'g++ -std=c++17 -O3 -march=native -fPIC -shared $(python -c "{_HEADERS}") *.cpp libpendular.a -o {PLUGIN} -lm'
    )


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
    contents = static_files() | {name: text.encode() for name, text in _texts().items()}
    with in_one_line("out", folder):
        folder.mkdir(parents=True, exist_ok=True)
    written = [folder / name for name in contents]
    for path in written:
        with in_one_line("out", path), whole(path) as draft:
            draft.write_bytes(contents[path.name])
    return written


def _texts() -> dict[str, str]:
    """Text of each file, by its name."""
    sources = (files(__package__) / "plugin").iterdir()
    texts = {source.name: source.read_text(encoding="utf-8") for source in sources if source.is_file()}
    told = {"version": __version__, "processor": processor(), "line": build_line()}
    texts[_README] = Template(texts[_README]).substitute(told)
    return {_TABLE: table_header()} | dict(sorted(texts.items()))
