"""Grains as points and bridges as lines in XML files of VTK, for ParaView, PyVista and OVITO."""

from pathlib import Path
from typing import IO, Any
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from ...ground.files import whole
from ...packing.heap import Packing
from .bridge_table import UNITS, Bridges, Ends, ends_of, quantities

__all__ = ["write"]

_TYPES = {"f8": "Float64", "i8": "Int64", "u1": "UInt8"}
_VERTEX, _LINE = 1, 3  # types of cells
Array = NDArray[Any]


def write(path: Path, heap: Packing, bridges: Bridges | None) -> None:
    """Write poly data to ``.vtp``, an unstructured grid to ``.vtu``.

    Points have their ``radius``; a bridge that leaves the cell or meets a wall ends at a point of its own, of radius 0
    and with ``end_of_bridge`` 1. Lines have the quantities of their bridge, which are NaN at the grains. The cell and
    its periodic directions are field data.

    Parameters
    ----------
    path : Path
        Of the file.
    heap : Packing
        The grains.
    bridges : record, optional
        As a wetted heap has them.

    References
    ----------
    .. [1] VTK documentation, VTK File Formats, https://docs.vtk.org/en/latest/vtk_file_formats/
    """
    ends = Ends(np.empty((0, 3)), np.empty((0, 2), np.int64)) if bridges is None else ends_of(heap, bridges)
    with whole(path) as draft, draft.open("wb") as file:
        _File(file).write(path.suffix.lower() == ".vtu", heap, bridges, ends)


class _File:
    """A file whose numbers follow its text, each array at its offset."""

    def __init__(self, file: IO[bytes]) -> None:
        self.file, self.arrays, self.offset = file, list[Array](), 0

    def write(self, is_grid: bool, heap: Packing, bridges: Bridges | None, ends: Ends) -> None:
        """Write all."""
        kind = "UnstructuredGrid" if is_grid else "PolyData"
        grains, lines = heap.count, len(ends.lines)
        points = np.concatenate([heap.positions, ends.points])
        counts = (
            f'NumberOfCells="{grains + lines}"'
            if is_grid
            else f'NumberOfVerts="{grains}" NumberOfLines="{lines}" NumberOfStrips="0" NumberOfPolys="0"'
        )
        text = [
            '<?xml version="1.0"?>',
            f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">',
            f"<{kind}>",
            *self._frame(heap),
            f'<Piece NumberOfPoints="{len(points)}" {counts}>',
            "<Points>", self._array("points", points), "</Points>",
            '<PointData Scalars="radius">',
            self._array("radius", np.concatenate([heap.radii, np.zeros(len(ends.points))])),
            self._array("end_of_bridge", np.repeat([0, 1], [grains, len(ends.points)]).astype(np.uint8)),
            "</PointData>",
            "<CellData>", *self._of_bridges(grains, bridges), "</CellData>",
            *(self._grid(grains, ends.lines) if is_grid else self._poly_data(grains, ends.lines)),
            "</Piece>", f"</{kind}>",
            '<AppendedData encoding="raw">', "_",
        ]  # fmt: skip
        self.file.write("\n".join(text).encode())
        for array in self.arrays:
            self.file.write(np.uint64(array.nbytes).tobytes())
            self.file.write(np.ascontiguousarray(array).data)
        self.file.write(b"\n</AppendedData>\n</VTKFile>\n")

    def _array(self, name: str, array: Array, extra: str = "") -> str:
        """Line that tells of an array, which is kept to be written later."""
        little = np.ascontiguousarray(array, array.dtype.newbyteorder("<"))
        kind = _TYPES[little.dtype.str[1:]]
        components = f' NumberOfComponents="{little.shape[1]}"' if little.ndim == 2 else ""
        place = f'format="appended" offset="{self.offset}"'
        line = f'<DataArray type="{kind}" Name={quoteattr(name)}{components}{extra} {place}/>'
        self.arrays.append(little)
        self.offset += 8 + little.nbytes
        return line

    def _frame(self, heap: Packing) -> list[str]:
        if heap.cell is None:
            return []
        cell = self._array("cell", heap.cell, ' NumberOfTuples="3"')
        periodic = self._array("periodic", heap.periodic.astype(np.uint8), ' NumberOfTuples="3"')
        return ["<FieldData>", cell, periodic, "</FieldData>"]

    def _of_bridges(self, grains: int, bridges: Bridges | None) -> list[str]:
        if bridges is None:
            return []
        blank = np.full(grains, np.nan)
        columns = quantities(bridges)
        return [self._array(name, np.concatenate([blank, columns[name]])) for name in UNITS]

    def _grid(self, grains: int, lines: NDArray[np.int64]) -> list[str]:
        connectivity = np.concatenate([np.arange(grains), lines.ravel()])
        offsets = np.cumsum(np.repeat([1, 2], [grains, len(lines)]))
        types = np.repeat([_VERTEX, _LINE], [grains, len(lines)]).astype(np.uint8)
        arrays = {"connectivity": connectivity, "offsets": offsets, "types": types}
        return ["<Cells>", *(self._array(name, array) for name, array in arrays.items()), "</Cells>"]

    def _poly_data(self, grains: int, lines: NDArray[np.int64]) -> list[str]:
        verts = self._array("connectivity", np.arange(grains)), self._array("offsets", np.arange(1, grains + 1))
        ends = self._array("connectivity", lines.ravel()), self._array("offsets", 2 * np.arange(1, len(lines) + 1))
        return ["<Verts>", *verts, "</Verts>", "<Lines>", *ends, "</Lines>"]
