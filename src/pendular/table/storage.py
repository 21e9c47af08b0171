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
from .sound import Unsound, refuse_unsound, require

__all__ = ["load", "save"]

_FORMAT = 2
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


def _checksum(description: str, arrays: Mapping[str, NDArray[Any]]) -> str:
    digest = hashlib.sha256(description.encode())
    for name in sorted(arrays):
        digest.update(name.encode())
        digest.update(np.ascontiguousarray(arrays[name]).tobytes())
    return digest.hexdigest()


def save(path: Path, description: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write a description, of plain values, and arrays of eight-byte numbers."""
    kinds = {name: [array.dtype.str, list(array.shape)] for name, array in arrays.items()}
    text = json.dumps({"format": _FORMAT, "arrays": kinds, **description}, sort_keys=True)
    stamp = {"text": text, "sha256": _checksum(text, arrays)}
    packed = {name: _shuffled(array) for name, array in arrays.items()}
    with in_one_line("path", path), whole(path) as draft, draft.open("wb") as file:
        np.savez_compressed(file, **{_DESCRIPTION: np.array(json.dumps(stamp))}, **packed)  # type: ignore[arg-type]


def _unpacked(content: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    with np.load(io.BytesIO(content), allow_pickle=False) as packed:
        stamp = json.loads(str(packed[_DESCRIPTION]))
        description = json.loads(stamp["text"])
        arrays = {name: _unshuffled(packed[name], kind, shape) for name, (kind, shape) in description["arrays"].items()}
    require(description["format"] == _FORMAT, f"has format {description['format']}, known is {_FORMAT}")
    require(_checksum(stamp["text"], arrays) == stamp["sha256"], "is damaged: its checksum does not agree")
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
