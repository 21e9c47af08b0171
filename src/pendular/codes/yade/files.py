"""Files in which YADE keeps capillary bridges: ten tables ``M(r=...)``, and the points of ``capillaryfile.txt``.

All numbers are reduced with the larger radius R2 and the surface tension γ, so a file serves every size and every
liquid of one contact angle.
"""

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.files import in_one_line, whole

__all__ = [
    "COLUMNS",
    "POINT_COLUMNS",
    "RATIOS",
    "Reading",
    "Table",
    "parse_table",
    "read_points",
    "read_table",
    "table_name",
    "write_points",
    "write_table",
]

Floats = NDArray[np.float64]

# The ten names that `Law2_ScGeom_CapillaryPhys_Capillarity` opens.
RATIOS = (1.0, 1.1, 1.25, 1.5, 1.75, 2.0, 3.0, 4.0, 5.0, 10.0)

# D/R2, u R2/γ, V/R2³, F/(2πγR2), half-filling angles of the smaller and the larger sphere in degrees, and the integrals
# of n n over the meniscus over R2², 3 along the axis.
COLUMNS = ("D*", "u*", "V*", "F*", "delta1", "delta2", "nn11*", "nn33*")

# u R2/γ, F/(γR2), D/R2, V/R2³, (liquid-gas and dry area)/R2², unused, half-filling angles, R1/R2, 1 at the last bridge.
POINT_COLUMNS = ("u*", "F+", "D*", "V*", "S*", "arc", "delta1", "delta2", "R", "ending")

_OLD_COLUMNS = 6
_HEADER_LINES = 2


class Table(NamedTuple):
    """One file ``M(r=...)``: blocks of equal gap, each with a row of `COLUMNS` for every suction."""

    ratio: float  # R2/R1, larger over smaller radius
    blocks: tuple[Floats, ...]  # (rows, 8)

    @property
    def gaps(self) -> Floats:
        """D* of the blocks; YADE takes it from the last row of each."""
        return np.array([block[-1, 0] for block in self.blocks])

    @property
    def last_suctions(self) -> Floats:
        """Largest u* at which YADE finds something in each block; minus infinity where it never does."""
        return np.array([block[1:, 1].max() if len(block) > 1 else -np.inf for block in self.blocks])


class Reading(NamedTuple):
    """What a file holds, and what is wrong with it."""

    table: Table | None  # None if nothing can be made of it
    faults: tuple[str, ...]


def table_name(ratio: float, suffix: str = "") -> str:
    """Name of the file of a ratio; the suffix is YADE's `suffCapFiles`.

    Examples
    --------
    >>> table_name(1.0), table_name(1.25, "_th20")
    ('M(r=1)', 'M(r=1.25)_th20')
    """
    return f"M(r={ratio:g}){suffix}"


def write_table(path: Path, table: Table) -> int:
    """Write one table as YADE reads it.

    Parameters
    ----------
    path : Path
        File to write, with a name of `table_name`.
    table : Table
        Blocks of ascending gap from 0, rows of ascending suction from 0.

    Returns
    -------
    int
        Bytes written.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    blank = "\t0" * (len(COLUMNS) - 1)
    parts = [f"{table.ratio:.10g}\n{len(table.blocks)}\n"]
    for block in table.blocks:
        parts += [f"{len(block)}{blank}\n", _lines(block)]
    with whole(path) as draft:
        return draft.write_text("".join(parts), encoding="ascii")


def _lines(rows: Floats) -> str:
    """Rows of eight digits, tabs between and a newline after each."""
    return ("\t".join(["%.8g"] * rows.shape[1]) + "\n") * len(rows) % tuple(rows.ravel().tolist())


def read_table(path: Path) -> Table:
    """Read one table in which nothing is wrong.

    Parameters
    ----------
    path : Path
        A file ``M(r=...)``.

    Returns
    -------
    Table

    Raises
    ------
    ValueError
        Naming the file and its first fault, or why it cannot be read.
    """
    with in_one_line("path", path, "read"):
        text = path.read_text(encoding="ascii", errors="replace")
    reading = parse_table(text)
    if reading.table is None or reading.faults:
        raise ValueError(f"{path.name}: {reading.faults[0]}")
    return reading.table


def parse_table(text: str) -> Reading:
    r"""Make of a file's text what YADE makes of it, and say what is wrong with it.

    Parameters
    ----------
    text : str
        A whole file.

    Returns
    -------
    Reading
        Without a table where YADE would crash, or read numbers in the wrong places.

    Examples
    --------
    >>> row = "0 {} 0.1 0.5 20 20 0.1 0.2"
    >>> parse_table("\n".join(["1", "1", "2 0 0 0 0 0 0 0", row.format(0), row.format(1)])).faults
    ()
    >>> parse_table("\n".join(["1", "1", "2 0 0 0 0 0 0 0", row.format(0.5), row.format(1)])).faults
    ('block 1: the first row is at u* = 0.5, not 0',)
    """
    lines = text.splitlines()
    try:
        ratio, count = float(lines[0]), int(lines[1])
    except (IndexError, ValueError):
        return Reading(None, ("the first two lines are not the ratio and the number of blocks",))
    if not ratio >= 1.0:
        return Reading(None, (f"the ratio {ratio:g} in the first line is below 1",))
    blocks: list[Floats] = []
    faults: list[str] = []
    at = _HEADER_LINES
    while len(blocks) < count and at < len(lines):
        wanted = re.match(r"\s*(\d+)(\s|$)", lines[at])
        rows = 0 if wanted is None else int(wanted[1])
        if rows == 0:
            return Reading(None, (f"line {at + 1}: a block of '{lines[at].strip()[:20]}' rows, at which YADE crashes",))
        block = _block(lines[at + 1 : at + 1 + rows], rows)
        if block is None:
            return Reading(None, (_reason(lines[at + 1 : at + 1 + rows], at + 2, rows),))
        blocks.append(block)
        at += 1 + rows
    if len(blocks) < count:
        faults.append(f"{count} blocks are announced, {len(blocks)} found")
    left = sum(1 for line in lines[at:] if line.strip())
    if left:
        faults.append(f"{count} blocks are announced and {left} more lines follow, which YADE ignores")
    if not blocks:
        return Reading(None, (*faults, "no block"))
    table = Table(ratio, tuple(blocks))
    return Reading(table, (*faults, *_disorder(table)))


def _block(lines: Sequence[str], rows: int) -> Floats | None:
    """Rows of a block, or None if they are not that many rows of eight numbers."""
    if len(lines) != rows:
        return None
    try:
        block = np.loadtxt(lines, ndmin=2, comments=None)
    except ValueError:
        return None
    return block if block.shape == (rows, len(COLUMNS)) and bool(np.all(np.isfinite(block))) else None


def _reason(lines: Sequence[str], number: int, rows: int) -> str:
    """Why a block cannot be read; ``number`` is the line of its first row."""
    for i, line in enumerate(lines):
        words = line.split()
        if len(words) == _OLD_COLUMNS:
            return (
                f"line {number + i}: six columns, the format before nn11 and nn33, at which YADE crashes; export anew"
            )
        if _block([line], 1) is None:
            return f"line {number + i}: '{line.strip()[:40]}' is not a row of {len(COLUMNS)} numbers"
    return f"line {number + len(lines)}: the file ends {rows - len(lines)} rows before its block"


def _disorder(table: Table) -> Iterable[str]:
    """Faults of order and completeness, each with what YADE makes of it."""
    gaps = table.gaps
    if gaps[0] != 0.0:
        yield f"the first block is at D* = {gaps[0]:g}, not 0: YADE crashes below it"
    for i in np.flatnonzero(np.diff(gaps) <= 0.0).tolist():
        yield f"block {i + 2}: D* = {gaps[i + 1]:g} does not ascend from {gaps[i]:g}: YADE may crash"
    for i, block in enumerate(table.blocks, 1):
        suctions = block[:, 1]
        if len(block) == 1:
            yield f"block {i}: a single row, in which YADE finds nothing"
        if suctions[0] != 0.0:
            yield f"block {i}: the first row is at u* = {suctions[0]:g}, not 0"
        if np.any(np.diff(suctions) <= 0.0):
            yield f"block {i}: u* does not ascend: YADE takes wrong rows"
        if np.any(block[:, 0] != block[-1, 0]):
            yield f"block {i}: D* differs within the block; YADE takes {block[-1, 0]:g}, that of the last row"


def write_points(path: Path, points: Floats) -> int:
    """Write the points of `CapillarityEngine`, without a newline at the end, which would store the last one twice.

    Parameters
    ----------
    path : Path
        File to write, of any name.
    points : ndarray, shape (n, 10)
        Rows of `POINT_COLUMNS`.

    Returns
    -------
    int
        Bytes written.
    """
    with whole(path) as draft:
        return draft.write_text(_lines(points)[:-1], encoding="ascii")


def read_points(path: Path) -> Floats:
    """Read the points of `CapillarityEngine`.

    Parameters
    ----------
    path : Path
        A file like ``capillaryfile.txt``.

    Returns
    -------
    ndarray, shape (n, 10)

    Raises
    ------
    ValueError
        If it is not made of rows of ten numbers, or cannot be read.
    """
    with in_one_line("path", path, "read"):
        text = path.read_text(encoding="ascii", errors="replace")
    rows = [line.split() for line in text.splitlines() if line.strip()]
    wrong = [i for i, row in enumerate(rows, 1) if len(row) != len(POINT_COLUMNS)]
    if wrong or not rows:
        raise ValueError(f"{path.name}: row {wrong[0] if wrong else 1} is not made of {len(POINT_COLUMNS)} numbers")
    try:
        return np.array(rows, dtype=np.float64)
    except ValueError as error:
        raise ValueError(f"{path.name}: {error}") from error
