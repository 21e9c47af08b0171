"""Legacy files of VTK, text or binary: the points and what is told at them. YADE's exporter writes such files."""

from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from .columns import size_of
from .found import Found

__all__ = ["read"]

_TYPES = {
    "float": "f4", "double": "f8", "unsigned_char": "u1", "char": "i1", "unsigned_short": "u2", "short": "i2",
    "unsigned_int": "u4", "int": "i4", "unsigned_long": "u8", "long": "i8", "vtktypeint64": "i8", "vtkidtype": "i4",
}  # fmt: skip
_WIDE = {"VECTORS": 3, "NORMALS": 3, "TENSORS": 9, "TENSORS6": 6, "GLOBAL_IDS": 1, "PEDIGREE_IDS": 1}


def read(path: Path) -> Found:
    """Grains at the points of a grid or of poly data, with a radius or diameter at each.

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
        If it is damaged or has no points.

    References
    ----------
    .. [1] VTK documentation, VTK File Formats, https://docs.vtk.org/en/latest/vtk_file_formats/
    """
    with path.open("rb") as file:
        file.readline()
        file.readline()
        mode = file.readline().strip()
        if mode not in (b"ASCII", b"BINARY"):
            raise ValueError(f"its third line is {mode[:40]!r} where ASCII or BINARY is needed")
        found = _Told(file, mode == b"BINARY")
        while found.radii is None and (line := file.readline()):
            found.take(line.decode("latin-1").split())
    if found.points is None:
        raise ValueError("it has no POINTS")
    return Found(found.points.reshape(-1, 3), found.radii)


class _Told:
    """What the lines of a file have told so far."""

    def __init__(self, file: IO[bytes], binary: bool) -> None:
        self.file, self.binary = file, binary
        self.points: NDArray[np.float64] | None = None
        self.radii: NDArray[np.float64] | None = None
        self.at_points = 0  # how many values the next arrays have; 0 where they are not those of points

    def take(self, words: list[str]) -> None:
        """Take in what a line begins."""
        try:
            match words:
                case ["POINTS", count, kind]:
                    self.points = self.numbers("POINTS", kind, 3 * int(count))
                case [("POINT_DATA" | "CELL_DATA") as where, count]:
                    self.at_points = int(count) if where == "POINT_DATA" else 0
                case [("CELLS" | "VERTICES" | "LINES" | "POLYGONS"), _, count] if self.binary:
                    self._pass_over_cells(int(count))
                case [name, *_, kind] if name in _WIDE and self.at_points and kind.lower() in _TYPES:
                    self.numbers(name, kind, self.at_points * _WIDE[name])
                case ["SCALARS", name, kind, *components]:
                    self.file.readline()  # LOOKUP_TABLE
                    self._array(name, kind, int((components or ["1"])[0]))
                case [name, components, count, kind] if kind.lower() in _TYPES:  # of a FIELD
                    self._array(name, kind, int(components), int(count))
        except ValueError as error:
            if "invalid literal" in str(error) or "string or file" in str(error):  # of int and of NumPy
                raise ValueError(f"its line {' '.join(words)[:60]!r} is damaged: {error}") from error
            raise

    def numbers(self, name: str, kind: str, count: int) -> NDArray[np.float64]:
        """Read the next numbers."""
        if kind.lower() not in _TYPES:
            raise ValueError(f"its {name} are of an unknown type {kind!r}")
        numbers = ">" + _TYPES[kind.lower()] if self.binary else float
        found = np.fromfile(self.file, numbers, count, "" if self.binary else " ")
        if found.size != count:
            raise ValueError(f"it ends within its {name}")
        return found.astype(float, copy=False)

    def _array(self, name: str, kind: str, components: int, count: int | None = None) -> None:
        if not self.at_points and count is None:  # of cells, which say their number in another line
            return
        values = self.numbers(name, kind, components * (self.at_points if count is None else count))
        size = size_of([name])
        if self.at_points and size is not None and values.size == self.at_points:
            self.radii = values * size[1]

    def _pass_over_cells(self, count: int) -> None:
        """Leave out binary numbers that could look like lines; the arrays of newer files have lines of their own."""
        here = self.file.tell()
        if not self.file.readline().startswith(b"OFFSETS"):
            self.file.seek(here + 4 * count)
