"""Frames of HOOMD-blue in its format GSD."""

from pathlib import Path

import numpy as np

from .found import Found, optional

__all__ = ["read"]


def read(path: Path, frame: int) -> Found:
    """Grains of a frame; their numbers have single precision.

    Parameters
    ----------
    path : Path
        Of the file.
    frame : int
        From 0 on, or from the end by -1 and below.

    Returns
    -------
    Found
        Without radii where the file stores no diameters: the 1 that its library then gives is not taken for one.

    Raises
    ------
    ValueError
        Without gsd, or if the frame is not there.

    References
    ----------
    .. [1] GSD documentation, HOOMD schema, https://gsd.readthedocs.io/en/stable/schema-hoomd.html
    """
    hoomd = optional("gsd.hoomd")
    with hoomd.open(path, mode="r") as file:
        count = len(file)
        if not -count <= frame < count:
            raise ValueError(f"frame {frame} is not among its {count} frames")
        number = frame % count
        stored = any(file.file.chunk_exists(frame=at, name="particles/diameter") for at in {0, number})
        told = file[number]
    lx, ly, lz, xy, xz, yz = np.asarray(told.configuration.box, float)
    cell = np.array([[lx, 0.0, 0.0], [xy * ly, ly, 0.0], [xz * lz, yz * lz, lz]])
    radii = np.asarray(told.particles.diameter, float) / 2.0 if stored else None
    return Found(np.asarray(told.particles.position, float).reshape(-1, 3), radii, cell, np.ones(3, bool))
