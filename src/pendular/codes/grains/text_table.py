"""Tables as text, with or without names of columns: xyzr, CSV, and the export of YADE."""

import re
from pathlib import Path
from typing import IO

from . import rows
from .columns import Columns, choose, grains
from .found import Found

__all__ = ["read"]

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?|nan|[+-]?inf", re.IGNORECASE)
_BARE = {3: ["x", "y", "z"], 4: ["x", "y", "z", "r"]}  # names of a table without any, by its columns
_YADE = "format "
_UNIT_APART = re.compile(r"\s+(?=[\[(])")


def read(path: Path) -> Found:
    """Grains of a table, one row each.

    Parameters
    ----------
    path : Path
        Of a text, packed by gzip or not. Names of the columns stand in the first line or in a comment before the
        numbers; YADE writes ``#format x_y_z_r``. Without names there are three or four columns, x, y, z and radius.

    Returns
    -------
    Found

    Raises
    ------
    ValueError
        If the columns are not known or a row is damaged.

    References
    ----------
    .. [1] YADE documentation, ``yade.export.text`` and ``textExt``, https://yade-dem.org/doc/yade.export.html
    """
    with rows.opened(path) as lines:
        head, first, start = _head(lines)
        delimiter = _delimiter(first or (head[-1] if head else ""))
        columns = _columns(head, first.split(delimiter), delimiter)
        lines.seek(start)
        return grains(rows.read(lines, columns.places, None, delimiter), columns)


def _head(lines: IO[bytes]) -> tuple[list[str], str, int]:
    """Lines before the numbers, the first row of numbers, and where that begins."""
    head: list[str] = []
    while True:
        start = lines.tell()
        raw = lines.readline()
        line = raw.decode("utf-8-sig", "replace").strip()
        if not raw:
            raise ValueError("it holds no row of numbers")
        if line and not line.startswith("#") and _NUMBER.fullmatch(re.split(r"[\s,;]", line)[0]):
            return head, line, start
        if line:
            head.append(line.lstrip("# "))
        if len(head) > 200:
            raise ValueError("it is not a table: no row of numbers in its first 200 lines")


def _delimiter(line: str) -> str | None:
    return next((mark for mark in (";", ",", "\t") if mark in line), None)


def _columns(head: list[str], first: list[str], delimiter: str | None) -> Columns:
    told = next((line.removeprefix(_YADE) for line in head if line.startswith(_YADE)), None)
    if told is not None:
        return choose(told.split()[0].split("_"))
    if head:
        line = _UNIT_APART.sub("", head[-1])
        marks = (delimiter, *(mark for mark in (",", ";", "\t", None) if mark != delimiter))
        splits = [[word for word in line.split(mark) if word.strip()] for mark in marks]
        names = next((split for split in splits if len(split) == len(first)), None)
        if names is not None:
            return choose(names)
    if len(first) not in _BARE:
        raise ValueError(
            f"it has {len(first)} columns and no line of as many names; name them in its first line, like x y z r"
        )
    return choose(_BARE[len(first)])
