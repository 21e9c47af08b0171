"""Formats that other libraries read: of atoms by ase, of meshes by meshio."""

from pathlib import Path

import numpy as np

from .columns import size_of
from .found import Found, optional

__all__ = ["read_ase", "read_meshio"]


def read_ase(path: Path, frame: int) -> Found:
    """Grains of a frame of a format that ase knows, like extended XYZ with a column ``radius``.

    Parameters
    ----------
    path : Path
        Of the file.
    frame : int
        From 0 on, or from the end by -1 and below.

    Returns
    -------
    Found

    Raises
    ------
    ValueError
        Without ase, or if the frame is not there.
    """
    io = optional("ase.io")
    formats = optional("ase.io.formats")
    try:
        atoms = io.read(path, index=frame)
    except formats.UnknownFileTypeError as error:
        raise ValueError("its format is not known; name the columns of a text, like x y z r") from error
    except (IndexError, StopIteration) as error:
        raise ValueError(f"it has no frame {frame}, or is cut off") from error
    except Exception as error:  # it raises whatever its readers meet
        raise ValueError(f"ase cannot read it: {' '.join(str(error).split()) or type(error).__name__}") from error
    size = size_of(list(atoms.arrays))
    radii = None if size is None else np.asarray(list(atoms.arrays.values())[size[0]], float) * size[1]
    cell = np.array(atoms.cell) if atoms.cell.rank == 3 else None
    return Found(np.asarray(atoms.positions, float), radii, cell, np.asarray(atoms.pbc, bool))


def read_meshio(path: Path) -> Found:
    """Grains at the points of a mesh of a format that meshio knows, with radii at the points.

    Parameters
    ----------
    path : Path
        Of the file.

    Returns
    -------
    Found

    Raises
    ------
    ValueError
        Without meshio, or if it cannot read the file.
    """
    meshio = optional("meshio")
    try:
        mesh = meshio.read(path)
    except (Exception, SystemExit) as error:  # it raises whatever its readers meet, and leaves the program for some
        raise ValueError(f"meshio cannot read it: {' '.join(str(error).split())}") from error
    size = size_of(list(mesh.point_data))
    radii = None if size is None else np.asarray(list(mesh.point_data.values())[size[0]], float).ravel() * size[1]
    return Found(np.asarray(mesh.points, float), radii)
