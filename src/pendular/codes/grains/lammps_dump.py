"""Dumps of LAMMPS and LIGGGHTS, as text: frames with named columns in a box that may be tilted."""

from pathlib import Path
from typing import IO, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import rows
from .columns import size_of
from .found import Found, in_order
from .lammps_data import LENGTHS

__all__ = ["read"]

Floats = NDArray[np.float64]

# Of the centres: as they are, unwrapped, and in parts of the box. LAMMPS writes one of these.
_CENTRES = (("x", "y", "z"), ("xu", "yu", "zu"))
_SCALED = (("xs", "ys", "zs"), ("xsu", "ysu", "zsu"))
_ITEMS = {"TIMESTEP": 1, "TIME": 1, "UNITS": 1, "NUMBER OF ATOMS": 1, "BOX BOUNDS": 3}  # and how many lines they have


class _Frame(NamedTuple):
    """Where the rows of a frame begin, and what stands before them."""

    start: int
    step: int
    atoms: int
    columns: list[str]
    box: Floats  # (3, 3), its vectors as rows
    origin: Floats  # (3,)
    periodic: NDArray[np.bool_]
    units: str | None
    whole: bool


def read(path: Path, frame: int) -> Found:
    """Grains of a frame, by their numbers where the file has them.

    Parameters
    ----------
    path : Path
        Of a text, packed by gzip or not.
    frame : int
        From 0 on, or from the end by -1 and below.

    Returns
    -------
    Found

    Raises
    ------
    ValueError
        If the frame is not there, not whole, or has no centres.

    Notes
    -----
    The bounds in the head of a tilted box are those of the upright box around it [1]_.

    References
    ----------
    .. [1] LAMMPS documentation, commands ``dump`` and Howto ``triclinic``, https://docs.lammps.org/dump.html
    """
    with rows.opened(path) as lines:
        found = _frame(lines, frame)
        lines.seek(found.start)
        return _grains(lines, found)


def _frame(lines: IO[bytes], wanted: int) -> _Frame:
    """Head of the frame that is asked for, of those that are kept only as long as one of them may be it."""
    last: list[_Frame] = []
    count = 0
    try:
        while (found := _head(lines)) is not None:
            count += 1
            last = [*last, found][-max(1, -wanted) :]
            if count - 1 == wanted:
                return found
    except EOFError as error:
        raise ValueError(f"it is cut off in frame {count}: {error}") from error
    if wanted >= 0 or count < -wanted:
        raise ValueError(f"frame {wanted} is not among its {count} frames")
    if not last[0].whole:
        raise ValueError(f"its last frame ends before all of its {last[0].atoms} grains; frame=-2 is whole")
    return last[0]


def _head(lines: IO[bytes]) -> _Frame | None:
    """Head of the next frame, with its rows passed over; None at the end of the file."""
    told: dict[str, list[str]] = {}
    while line := lines.readline().decode("utf-8", "replace").strip():
        name = line.removeprefix("ITEM: ")
        if name.startswith("ATOMS"):
            return _described(lines, told, name.split()[1:])
        item = next((item for item in _ITEMS if name.startswith(item)), None)
        if not line.startswith("ITEM: ") or item is None:
            raise ValueError(f"its head is damaged or not that of a dump of atoms: {line[:60]!r}")
        values = [lines.readline().decode("utf-8", "replace").strip() for _ in range(_ITEMS[item])]
        told[item] = [name.removeprefix(item).strip(), *values]
    if told:
        raise ValueError("it ends within the head of a frame")
    return None


def _described(lines: IO[bytes], told: dict[str, list[str]], columns: list[str]) -> _Frame:
    missing = [item for item in ("NUMBER OF ATOMS", "BOX BOUNDS") if item not in told]
    if missing:
        raise ValueError(f"a frame of it does not tell {missing[0]}")
    try:
        count, step = int(told["NUMBER OF ATOMS"][1]), int(told.get("TIMESTEP", ["", "0"])[1])
        box, origin = _box(told["BOX BOUNDS"])
    except (ValueError, IndexError) as error:
        raise ValueError(f"the head of a frame is damaged: {error}") from error
    flags = [word for word in told["BOX BOUNDS"][0].split() if len(word) == 2 and set(word) <= set("pfsm")]
    if len(flags) != 3:
        raise ValueError("its line BOX BOUNDS does not tell which directions are periodic; write it with pp or ff each")
    periodic = np.array([flag == "pp" for flag in flags])
    units = told["UNITS"][1] if "UNITS" in told else None
    start = lines.tell()
    return _Frame(start, step, count, columns, box, origin, periodic, units, rows.passed_over(lines, count))


def _box(told: list[str]) -> tuple[Floats, Floats]:
    """Vectors of the box as rows, and its corner."""
    head, numbers = told[0], np.array([line.split() for line in told[1:]], float)
    if "abc" in head:  # a general one
        return numbers[:, :3], numbers[:, 3]
    low, high = numbers[:, 0].copy(), numbers[:, 1].copy()
    xy, xz, yz = numbers[:, 2] if numbers.shape[1] == 3 else (0.0, 0.0, 0.0)
    low -= min(0.0, xy, xz, xy + xz), min(0.0, yz), 0.0
    high -= max(0.0, xy, xz, xy + xz), max(0.0, yz), 0.0
    (lx, ly, lz) = high - low
    return np.array([[lx, 0.0, 0.0], [xy, ly, 0.0], [xz, yz, lz]]), low


def _grains(lines: IO[bytes], frame: _Frame) -> Found:
    names = frame.columns
    centre = next((triple for triple in (*_CENTRES, *_SCALED) if set(triple) <= set(names)), None)
    if centre is None:
        raise ValueError(f"it has no columns x, y and z, nor scaled ones, but {', '.join(names)}")
    size = size_of(names)
    places = [*(names.index(name) for name in centre), *([] if size is None else [size[0]])]
    places += [names.index("id")] if "id" in names else []
    table = rows.read(lines, places, frame.atoms)
    positions = table[:, :3] @ frame.box + frame.origin if centre in _SCALED else np.ascontiguousarray(table[:, :3])
    radii = None if size is None else table[:, 3] * size[1]
    ids = table[:, -1] if "id" in names else None
    unit = None if frame.units is None else LENGTHS.get(frame.units)
    return Found(*in_order(ids, positions, radii), frame.box, frame.periodic, unit)
