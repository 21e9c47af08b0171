"""XML files of VTK, .vtu and .vtp, as YADE, LIGGGHTS and MercuryDPM write: the points and what is told at them."""

import base64
import binascii
import lzma
import re
import zlib
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from .columns import size_of
from .found import Found

__all__ = ["read"]

_TYPES = {"Float32": "f4", "Float64": "f8"}
_TYPES |= {f"Int{8 * size}": f"i{size}" for size in (1, 2, 4, 8)} | {
    f"UInt{8 * size}": f"u{size}" for size in (1, 2, 4, 8)
}
_UNPACK: dict[str, Callable[[bytes], bytes]] = {
    "vtkZLibDataCompressor": zlib.decompress,
    "vtkLZMADataCompressor": lzma.decompress,
}
_APPENDED = re.compile(rb'<AppendedData[^>]*?encoding="(\w+)"[^>]*>\s*_')


def read(path: Path) -> Found:
    """Grains at the points of all pieces, with a radius or diameter at each.

    Parameters
    ----------
    path : Path
        Of an unstructured grid or poly data, its numbers as text, inline or appended, packed or not.

    Returns
    -------
    Found

    Raises
    ------
    ValueError
        If it is damaged, packed in a way that Python does not know, or holds no points.

    References
    ----------
    .. [1] VTK documentation, VTK File Formats, https://docs.vtk.org/en/latest/vtk_file_formats/
    """
    content = path.read_bytes()
    start = _APPENDED.search(content)
    head = content if start is None else content[: start.start()] + b"</VTKFile>"
    try:
        root = ElementTree.fromstring(head)
    except ElementTree.ParseError as error:
        raise ValueError(f"it is cut off or damaged: {error}") from error
    file = _Numbers(root, b"" if start is None else memoryview(content)[start.end() :], start[1] if start else b"")
    pieces = root.findall("./*/Piece")
    points, sizes, ends = [], [], []
    for piece in pieces:
        count = int(piece.get("NumberOfPoints", "0"))
        told = piece.find("./Points/DataArray")
        if count == 0 or told is None:
            continue
        points.append(file.of(told, 3 * count).reshape(-1, 3))
        arrays = piece.findall("./PointData/DataArray")
        size = size_of([array.get("Name", "") for array in arrays])
        if size is not None:
            sizes.append(file.of(arrays[size[0]], count) * size[1])
        ends += [file.of(array, count) for array in arrays if array.get("Name") == "end_of_bridge"]
    if not points:
        raise ValueError("it holds no points")
    centres, radii = np.concatenate(points), np.concatenate(sizes) if len(sizes) == len(points) else None
    if ends and radii is not None:  # a heap that was written with its bridges
        own = np.concatenate(ends) == 0.0
        centres, radii = centres[own], radii[own]
    return Found(centres, radii, *_frame(root, file))


def _frame(root: ElementTree.Element, file: "_Numbers") -> tuple[NDArray[np.float64] | None, NDArray[np.bool_] | None]:
    """Cell and periodic directions, where a heap was written with them."""
    told = {array.get("Name"): array for array in root.findall("./*/FieldData/DataArray")}
    if not {"cell", "periodic"} <= set(told):
        return None, None
    return file.of(told["cell"], 9).reshape(3, 3), file.of(told["periodic"], 3) != 0.0


class _Numbers:
    """The arrays of one file, in the one encoding that its head tells."""

    def __init__(self, root: ElementTree.Element, appended: "memoryview | bytes", encoding: bytes) -> None:
        self.order = ">" if root.get("byte_order") == "BigEndian" else "<"
        self.header = np.dtype(self.order + {"UInt64": "u8"}.get(root.get("header_type", "UInt32"), "u4"))
        self.compressor = root.get("compressor")
        if self.compressor is not None and self.compressor not in _UNPACK:
            raise ValueError(f"it is packed by {self.compressor}; write it with zlib or unpacked")
        self.appended, self.raw = appended, encoding == b"raw"

    def of(self, array: ElementTree.Element, count: int) -> NDArray[np.float64]:
        """Numbers of a data array."""
        name, kind, form = array.get("Name", "points"), array.get("type", ""), array.get("format", "ascii")
        if kind not in _TYPES:
            raise ValueError(f"its array {name} is of an unknown type {kind!r}")
        try:
            if form == "ascii":
                values = np.array((array.text or "").split(), float)
            elif form == "appended":
                values = self._decoded(self.appended[int(array.get("offset", "0")) :], kind, self.raw)
            else:
                values = self._decoded((array.text or "").strip().encode(), kind, False)
        except (ValueError, IndexError, zlib.error, lzma.LZMAError, binascii.Error) as error:
            raise ValueError(f"its array {name} is damaged: {error}") from error
        if values.size != count:
            raise ValueError(f"its array {name} has {values.size} numbers where {count} are told")
        return values

    def _decoded(self, data: "memoryview | bytes", kind: str, raw: bool) -> NDArray[np.float64]:
        numbers = np.dtype(self.order + _TYPES[kind])
        if self.compressor is None:
            size = int(self._header(data, 1, raw)[0])
            whole = self._bytes(data, self.header.itemsize + size, raw)[self.header.itemsize :]
            return np.frombuffer(whole, numbers).astype(float)
        blocks = int(self._header(data, 1, raw)[0])
        sizes = self._header(data, 3 + blocks, raw)[3:]
        skipped = self.header.itemsize * (3 + blocks)
        if raw:
            packed = self._bytes(data, skipped + int(sizes.sum()), True)[skipped:]
        else:  # the head is encoded by itself
            packed = self._bytes(data[4 * -(-skipped // 3) :], int(sizes.sum()), False)
        ends = np.cumsum(sizes)
        parts = [bytes(packed[int(end - size) : int(end)]) for end, size in zip(ends, sizes, strict=True)]
        return np.frombuffer(b"".join(map(_UNPACK[self.compressor], parts)), numbers).astype(float)

    def _header(self, data: "memoryview | bytes", count: int, raw: bool) -> NDArray[np.int64]:
        found = self._bytes(data, count * self.header.itemsize, raw)
        return np.frombuffer(found, self.header, count).astype(np.int64)

    @staticmethod
    def _bytes(data: "memoryview | bytes", size: int, raw: bool) -> "memoryview | bytes":
        found = data[:size] if raw else base64.b64decode(bytes(data[: 4 * -(-size // 3)]))[:size]
        if len(found) < size:
            raise ValueError("it ends within its numbers")
        return found
