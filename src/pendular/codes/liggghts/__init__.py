"""A cohesion model for LIGGGHTS, which reads a table of exact bridges: the files that build it."""

from importlib.resources import files
from pathlib import Path

from ..c_header import headers
from ..folder import write_folder

__all__ = ["FILES", "write"]

FILES = ("cohesion_model_pendular.h", "pendular_films.h", "pendular_walls.h", "main.cpp", "Makefile")


def write(folder: Path) -> list[Path]:
    """Write the cohesion model ``pendular``, what builds it against an installed LIGGGHTS, and what reads the tables.

    Parameters
    ----------
    folder : Path
        Made if it is not there. Files of the same names in it are replaced.

    Returns
    -------
    list of Path
        What was written: the model, the program, its ``Makefile``, ``pendular_table.h`` and ``pendular_viscous.h``.

    Raises
    ------
    ValueError
        If a file cannot be written.

    Examples
    --------
    >>> from tempfile import mkdtemp
    >>> [path.name for path in write(Path(mkdtemp()))][:3]
    ['cohesion_model_pendular.h', 'pendular_films.h', 'pendular_walls.h']
    """
    own = {name: (files(__package__) / name).read_bytes() for name in FILES}
    return write_folder(folder, own | headers())
