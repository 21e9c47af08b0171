"""A table as one binary file that any language reads: its bytes are told in `docs/reference/table_format.md`."""

import math
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.files import in_one_line, whole
from .polynomial import CELL, RUPTURE_CELL
from .sound import CUT, LINE, MOST_ROWS, refuse_unsound, require

__all__ = ["CHANNELS", "MAGIC", "SUFFIX", "Channel", "is_binary", "load", "packed", "save", "told_channels", "unpacked"]

Description = dict[str, Any]
Arrays = dict[str, NDArray[Any]]

SUFFIX = ".bridges"
MAGIC = b"\x89BRIDGE\n"
_BYTE_ORDER, _VERSION = 0x01020304, 2
_HEADER = np.dtype(
    [
        ("magic", "S8"), ("byte_order", "<u4"), ("version", "<u4"), ("size", "<u8"),
        ("control", "<u4"), ("sides", "<u4"), ("rows", "<u4"), ("channels", "<u4"),
        ("shift", "<i4"), ("first", "<i4"), ("size_cells", "<u4"), ("cells", "<u4"),
        ("contact_angle", "<f8", 2), ("reduced", "<f8", 2), ("radius_ratio", "<f8", 2), ("range", "<f8", 4),
        ("tolerance", "<f8"), ("bridges", "<u8"), ("writer", "S24"),
    ]
)  # fmt: skip
_CHANNEL = np.dtype(
    [
        ("name", "S24"), ("unit", "S16"), ("bound_of", "S40"), ("factor", "<f8"), ("bound", "<f8"),
        ("is_of_bridge", "<i4"), ("tension", "<i4"), ("radius", "<i4"), ("control", "<i4"),
    ]
)  # fmt: skip
_CHECKSUM = 4  # [bytes]
_ALIGNMENT = 64  # of the coefficients, [bytes]
_CONTROLS = ("suction", "volume")
_MOST_CHANNELS, _MOST_CELLS = 16, (1 << 31) - 1


class Channel(NamedTuple):
    """A quantity of a file: its polynomial times factor · γ^tension · R̄^radius · c*^(control/2)."""

    unit: str
    bound_of: str  # what the bound of the error is relative to
    factor: float
    is_of_bridge: bool  # else of the pair and the control alone
    tension: int
    radius: int
    control: int


CHANNELS = {
    "rupture_distance": Channel("m", "itself", 1.0, False, 0, 1, 0),
    "force": Channel("N", "the largest force of the bridge", 2.0 * math.pi, True, 1, 1, 0),
    "volume": Channel("m3", "the volume at contact", 1.0, True, 0, 3, -4),
    "suction": Channel("Pa", "gamma sqrt(Rm/volume)", 1.0, True, 1, -1, -1),
}


def _names(control: str) -> tuple[str, str, str]:
    """The first channels of a file, in their order."""
    return "rupture_distance", "force", "suction" if control == "volume" else "volume"


# -- writing ---------------------------------------------------------------------------------------------------------


More = tuple[str, Channel, float, NDArray[np.float64]]  # name, bound and coefficients of a further channel


def save(
    path: Path, description: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]], more: Sequence[More] = ()
) -> None:
    """Write what `storage.save` writes in the binary format, and further channels."""
    content = packed(description, arrays, more)
    with in_one_line("path", path), whole(path) as draft:
        draft.write_bytes(content)


def packed(description: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]], more: Sequence[More] = ()) -> bytes:
    """Bytes of the file of a table, with further channels."""
    force, rupture, liquid, bridges = description["bound"]
    names = _names(description["control"])
    known = [(name, CHANNELS[name], bound) for name, bound in zip(names, (rupture, force, liquid), strict=True)]
    known += [(name, channel, bound) for name, channel, bound, _ in more]
    channels = [(name, *channel[:3], bound, *channel[3:]) for name, channel, bound in known]
    rows = (
        np.array(channels, _CHANNEL).tobytes()
        + arrays["lines"].astype("<f8").tobytes()
        + arrays["cuts"].astype("<i4").tobytes()
    )
    padding = bytes(-(_HEADER.itemsize + len(rows)) % _ALIGNMENT)
    numbers = [*(arrays[name] for name in ("rupture", "force", "liquid")), *(numbers for *_, numbers in more)]
    coefficients = b"".join(array.astype("<f8").tobytes() for array in numbers)
    parts = rows + padding + coefficients
    shift, first, count = description["cut"]
    writer = description["version"][: _HEADER["writer"].itemsize - 1]
    header = np.array(
        (
            MAGIC, _BYTE_ORDER, _VERSION, _HEADER.itemsize + len(parts) + _CHECKSUM,
            _CONTROLS.index(description["control"]), len(arrays["lines"]) // count, count, len(channels),
            shift, first, arrays["rupture"].size // RUPTURE_CELL, arrays["force"].size // CELL,
            description["contact_angle"], description["reduced"], [float(r) for r in description["radius_ratio"]],
            description["range"], description["tolerance"], bridges, writer,
        ),
        _HEADER,
    ).tobytes()  # fmt: skip
    return header + parts + zlib.crc32(header + parts).to_bytes(_CHECKSUM, "little")


# -- reading ---------------------------------------------------------------------------------------------------------


def is_binary(path: Path) -> bool:
    """Whether a file begins like one of the binary format."""
    with in_one_line("path", path, "read"), path.open("rb") as file:
        return file.read(len(MAGIC)) == MAGIC


def load(path: Path) -> tuple[Description, Arrays]:
    """Read a file back, and refuse it unless it is whole."""
    with in_one_line("path", path, "read"):
        content = path.read_bytes()
    try:
        return unpacked(content)
    except ValueError as error:
        raise ValueError(f"path: '{path}' {error}") from error


def told_channels(path: Path) -> list[tuple[str, float, str]]:
    """Name, bound of the error, and what that is relative to, of each channel of a whole file."""
    content = path.read_bytes()
    count = int(np.frombuffer(content, _HEADER, 1)[0]["channels"])
    channels = np.frombuffer(content, _CHANNEL, count, _HEADER.itemsize)
    return [(each["name"].decode(), float(each["bound"]), each["bound_of"].decode()) for each in channels]


def unpacked(content: bytes) -> tuple[Description, Arrays]:
    """Description and arrays of the bytes of a file; a ValueError says what is wrong with them.

    Channels beyond the first three are passed over.
    """
    _refuse_damaged(content)
    header = np.frombuffer(content, _HEADER, 1)[0]
    _refuse_wrong_header(header)
    control = _CONTROLS[header["control"]]
    start = _HEADER.itemsize + int(header["channels"]) * _CHANNEL.itemsize
    require(start < len(content), _SIZE)
    channels = np.frombuffer(content, _CHANNEL, header["channels"], _HEADER.itemsize)
    _refuse_wrong_channels(channels, _names(control))
    rows, size_cells, cells = (int(header[name]) for name in ("rows", "size_cells", "cells"))
    rows *= int(header["sides"])
    cuts_start = start + rows * LINE * 8
    end = cuts_start + rows * CUT * 4
    start_of = [end + -end % _ALIGNMENT]
    for channel in channels:
        start_of.append(start_of[-1] + 8 * (cells * CELL if channel["is_of_bridge"] else size_cells * RUPTURE_CELL))
    require(start_of[-1] + _CHECKSUM == len(content), _SIZE)
    lines = np.frombuffer(content, "<f8", rows * LINE, start).reshape(rows, LINE)
    cuts = np.frombuffer(content, "<i4", rows * CUT, cuts_start).reshape(rows, CUT)
    numbers = np.frombuffer(content, "<f8", (start_of[-1] - start_of[0]) // 8, start_of[0])
    require(np.isfinite(numbers).all(), "has a number that is not finite")
    coefficients = np.split(numbers, [(at - start_of[0]) // 8 for at in start_of[1:4]])
    arrays = {"lines": lines, "cuts": cuts} | dict(zip(("rupture", "force", "liquid"), coefficients[:3], strict=True))
    kinds = {name: np.int64 if name == "cuts" else np.float64 for name in arrays}
    rupture, force, liquid = channels["bound"][:3].tolist()
    description = {
        "contact_angle": header["contact_angle"].tolist(),
        "control": control,
        "reduced": header["reduced"].tolist(),
        "radius_ratio": header["radius_ratio"].tolist(),
        "tolerance": float(header["tolerance"]),
        "bound": [force, rupture, liquid, int(header["bridges"])],
        "version": header["writer"].decode(),
        "cut": [int(header[name]) for name in ("shift", "first", "rows")],
        "range": header["range"].tolist(),
    }
    arrays = {name: array.astype(kinds[name]) for name, array in arrays.items()}
    refuse_unsound(description, arrays)
    return description, arrays


_SIZE = "is shorter or longer than it says"


def _refuse_damaged(content: bytes) -> None:
    """Magic, order of bytes, version, size and checksum."""
    require(content.startswith(MAGIC), "is not a table of bridges")
    require(len(content) >= _HEADER.itemsize + _CHECKSUM, _SIZE)
    header = np.frombuffer(content, _HEADER, 1)[0]
    require(header["byte_order"] == _BYTE_ORDER, "has another order of bytes than this format")
    require(header["version"] == _VERSION, f"has version {header['version']} of the format, known is {_VERSION}")
    require(header["size"] == len(content), _SIZE)
    checksum = int.from_bytes(content[-_CHECKSUM:], "little")
    require(zlib.crc32(memoryview(content)[:-_CHECKSUM]) == checksum, "is damaged: its checksum does not agree")


def _is_text(text: bytes, room: int) -> bool:
    """Whether a field, without the zeros at its end, is of printable ASCII and shorter than its room."""
    return 0 < len(text) < room and all(32 <= byte < 127 for byte in text)


def _refuse_wrong_header(header: np.void) -> None:
    """What the layout of the file depends on."""
    theta = header["contact_angle"]
    require(
        header["control"] < len(_CONTROLS)
        and header["sides"] == (1 if theta[0] == theta[1] else 2)
        and 1 <= header["rows"] <= MOST_ROWS
        and len(_names("suction")) <= header["channels"] <= _MOST_CHANNELS
        and max(header["size_cells"], header["cells"]) <= _MOST_CELLS
        and _is_text(header["writer"], _HEADER["writer"].itemsize),
        "has a number in its header that is out of range",
    )


def _refuse_wrong_channels(channels: NDArray[np.void], names: tuple[str, str, str]) -> None:
    texts = ("name", "unit", "bound_of")
    is_described = (
        all(_is_text(channel[text], _CHANNEL[text].itemsize) for channel in channels for text in texts)
        and len(set(channels["name"].tolist())) == len(channels)
        and np.isfinite(channels["factor"]).all()
        and (channels["bound"] >= 0.0).all()
        and np.isin(channels["is_of_bridge"], (0, 1)).all()
    )
    for name, channel in zip(names, channels, strict=False):
        known = CHANNELS[name]
        found = (channel["factor"], *(int(channel[field]) for field in Channel._fields[3:]))
        is_described = is_described and channel["name"] == name.encode() and found == known[2:]
    require(is_described, "has a channel that is not described as it has to be")
