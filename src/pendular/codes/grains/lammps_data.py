"""Data files of LAMMPS, as ``write_data`` writes and ``read_data`` reads them."""

import re
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from . import rows
from .found import Found, in_order

__all__ = ["LENGTHS", "looks_like", "read"]

Floats = NDArray[np.float64]

# Place of x and of the diameter in a row, by the style of the atoms, without images.
_STYLES: dict[str, tuple[int, int | None]] = {
    "sphere": (4, 2),
    "bpm/sphere": (5, 3),
    "hybrid": (2, None),
    "atomic": (2, None),
    "charge": (3, None),
    "bond": (3, None),
    "angle": (3, None),
    "molecular": (3, None),
    "full": (4, None),
}
_HYBRID_COLUMNS = {"sphere": 2, "bond": 1, "angle": 1, "molecular": 1, "charge": 1, "atomic": 0}
_COUNT = re.compile(r"(\d+)\s+atoms\b")
_UNITS = re.compile(r"units = (\w+)")
# Of the styles of units that have one.
LENGTHS = {"si": "m", "cgs": "cm", "micro": "um", "nano": "nm", "real": "angstrom", "metal": "angstrom"}


def looks_like(start: str) -> bool:
    r"""Whether a text begins as a data file does.

    Examples
    --------
    >>> looks_like("LAMMPS description\n\n 8000 atoms\n1 atom types\n")
    True
    """
    return any(_COUNT.match(line.strip()) for line in start.splitlines()[1:40])


def read(path: Path) -> Found:
    """Grains by their numbers, in a box that repeats in all directions: the file does not tell, and LAMMPS takes it so.

    Parameters
    ----------
    path : Path
        Of a text, packed by gzip or not.

    Returns
    -------
    Found

    Raises
    ------
    ValueError
        If it does not tell the style of its atoms, or is damaged.

    References
    ----------
    .. [1] LAMMPS documentation, command ``read_data``, https://docs.lammps.org/read_data.html
    """
    with rows.opened(path) as lines:
        first = lines.readline().decode("utf-8", "replace")
        count, box, style = _head(lines)
        x, diameter = _places(style)
        lines.readline()  # empty
        table = rows.read(lines, [x, x + 1, x + 2, 0, *([] if diameter is None else [diameter])], count)
    units = _UNITS.search(first)
    radii = None if diameter is None else table[:, 4] / 2.0
    ordered = in_order(table[:, 3], np.ascontiguousarray(table[:, :3]), radii)
    return Found(*ordered, box, np.ones(3, bool), LENGTHS.get(units[1]) if units else None)


def _head(lines: IO[bytes]) -> tuple[int, Floats, str]:
    """Number of grains, vectors of the box and style of the atoms; the line of the section is the last one read."""
    count, told = None, dict.fromkeys(("xlo xhi", "ylo yhi", "zlo zhi", "xy xz yz", "avec", "bvec", "cvec"), "")
    for raw in lines:
        line, _, comment = raw.decode("utf-8", "replace").strip().partition("#")
        line = line.strip()
        if line == "Atoms":
            if count is None:
                raise ValueError("its head does not tell how many atoms there are")
            return count, _box(told), comment.strip()
        if found := _COUNT.fullmatch(line):
            count = int(found[1])
        for name in told:
            if line.endswith(" " + name):
                told[name] = line.removesuffix(name)
    raise ValueError("it has no section Atoms")


def _box(told: dict[str, str]) -> Floats:
    try:
        if told["avec"]:
            return np.array([told[name].split() for name in ("avec", "bvec", "cvec")], float).reshape(3, 3)
        bounds = np.array([told[f"{axis}lo {axis}hi"].split() for axis in "xyz"], float).reshape(3, 2)
        xy, xz, yz = (float(word) for word in (told["xy xz yz"] or "0 0 0").split())
    except ValueError as error:
        raise ValueError(f"its box is damaged: {error}") from error
    lx, ly, lz = bounds[:, 1] - bounds[:, 0]
    return np.array([[lx, 0.0, 0.0], [xy, ly, 0.0], [xz, yz, lz]])


def _places(style: str) -> tuple[int, int | None]:
    """Of x and the diameter; a hybrid style has its common columns first and then those of its parts."""
    name, *parts = style.split() or [""]
    if name not in _STYLES:
        known = ", ".join(_STYLES)
        raise ValueError(f"its section Atoms does not tell a known style ({known}); write it like: Atoms  # sphere")
    x, diameter = _STYLES[name]
    if name != "hybrid":
        return x, diameter
    if not parts:  # LAMMPS writes the word alone
        raise ValueError(
            "its section Atoms tells no parts of the hybrid style; write it like: Atoms  # hybrid bond sphere"
        )
    if "sphere" not in parts:
        return x, None
    before = parts[: parts.index("sphere")]
    unknown = [part for part in before if part not in _HYBRID_COLUMNS]
    if unknown:
        raise ValueError(f"the columns of style {unknown[0]} in a hybrid one are not known")
    return x, 5 + sum(_HYBRID_COLUMNS[part] for part in before)
