"""A table as one small file: a NumPy archive with a description and a checksum."""

import hashlib
import io
import json
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from tokenize import TokenError
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ground.files import in_one_line, whole
from .polynomial import CELL, RUPTURE_CELL
from .sound import Unsound, refuse_unsound, require

__all__ = ["load", "save"]

_FORMAT = 3
_CELLS = {"rupture": RUPTURE_CELL, "force": CELL, "liquid": CELL}
_LARGEST = 2.0**61  # of a whole number
_POWER = "_power"  # of two, by which the whole numbers of an array are multiplied, one a cell
_DESCRIPTION = "description"
_CONTROLS = ("suction", "volume")
# What reading an archive with wrong bytes raises; RuntimeError of those that name an encryption or a compression.
_DAMAGES = (
    KeyError, ValueError, TypeError, AttributeError, OverflowError, EOFError, MemoryError, RuntimeError,
    zipfile.BadZipFile, zlib.error, TokenError,
)  # fmt: skip


def _shuffled(array: NDArray[Any]) -> NDArray[np.uint8]:
    """Bytes of equal weight side by side: those of rounded coefficients are mostly zero, and compress well."""
    return np.ascontiguousarray(array.reshape(-1).view(np.uint8).reshape(-1, array.itemsize).T)


def _unshuffled(planes: NDArray[np.uint8], kind: str, shape: list[int]) -> NDArray[Any]:
    return np.ascontiguousarray(planes.T).reshape(-1).view(kind).reshape(shape)


def _wholes(array: NDArray[Any], cell: int) -> tuple[NDArray[np.int64], NDArray[np.int16]] | None:
    """Rounded coefficients as whole numbers times a power of two of each cell; none if they are not rounded.

    The numbers of a place in all cells lie side by side, signs in the last bit: the high bytes are zero, and pack well.
    """
    if not np.isfinite(array).all() or array.size % cell:
        return None
    cells = array.reshape(-1, cell)
    mantissa, exponent = np.frexp(cells)
    whole = np.ldexp(mantissa, 53).astype(np.int64)
    last_bit = np.frexp((whole & -whole).astype(float))[1] - 1
    power = np.where(cells == 0.0, np.iinfo(np.int16).max, exponent - 53 + last_bit).min(axis=1, initial=0)
    numbers = np.ldexp(cells, -power[:, None])
    if np.abs(numbers).max(initial=0.0) > _LARGEST:
        return None
    signed = numbers.astype(np.int64)
    return np.ascontiguousarray(((signed << 1) ^ (signed >> 63)).T), power.astype(np.int16)


def _floats(numbers: NDArray[np.int64], power: NDArray[np.int16]) -> NDArray[np.float64]:
    signed = (numbers >> 1) ^ -(numbers & 1)
    return np.ldexp(signed.T.astype(float), power[:, None].astype(np.int64)).reshape(-1)


def _checksum(description: str, arrays: Mapping[str, NDArray[Any]]) -> str:
    digest = hashlib.sha256(description.encode())
    for name in sorted(arrays):
        digest.update(name.encode())
        digest.update(np.ascontiguousarray(arrays[name]).tobytes())
    return digest.hexdigest()


def save(path: Path, description: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write a description, of plain values, and arrays."""
    stored: dict[str, NDArray[Any]] = {}
    for name, array in arrays.items():
        wholes = _wholes(array, _CELLS[name]) if name in _CELLS else None
        if wholes is None:
            stored[name] = array
        else:
            stored[name], stored[name + _POWER] = wholes
    kinds = {name: [array.dtype.str, list(array.shape)] for name, array in stored.items()}
    text = json.dumps({"format": _FORMAT, "arrays": kinds, **description}, sort_keys=True)
    stamp = {"text": text, "sha256": _checksum(text, stored)}
    packed = {name: _shuffled(array) for name, array in stored.items()}
    with in_one_line("path", path), whole(path) as draft, draft.open("wb") as file:
        np.savez_compressed(file, **{_DESCRIPTION: np.array(json.dumps(stamp))}, **packed)  # type: ignore[arg-type]


def _unpacked(content: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    with np.load(io.BytesIO(content), allow_pickle=False) as packed:
        stamp = json.loads(str(packed[_DESCRIPTION]))
        description = json.loads(stamp["text"])
        require(description["format"] == _FORMAT, f"has format {description['format']}, known is {_FORMAT}")
        stored = {name: _unshuffled(packed[name], kind, shape) for name, (kind, shape) in description["arrays"].items()}
    require(_checksum(stamp["text"], stored) == stamp["sha256"], "is damaged: its checksum does not agree")
    arrays = {name: array for name, array in stored.items() if not name.endswith(_POWER)}
    for name in arrays:
        if name + _POWER in stored:
            arrays[name] = _floats(arrays[name], stored[name + _POWER])
    require(description["control"] in _CONTROLS, "has a control that is neither suction nor volume")
    refuse_unsound(description, arrays)
    return description, arrays


def load(path: Path) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Read a file back, and refuse it unless it is whole, and holds a table."""
    with in_one_line("path", path, "read"):
        content = path.read_bytes()
    try:
        return _unpacked(content)
    except Unsound as fault:
        raise ValueError(f"path: '{path}' {fault}") from fault
    except _DAMAGES as error:
        raise ValueError(f"path: '{path}' is not a table, or damaged") from error
