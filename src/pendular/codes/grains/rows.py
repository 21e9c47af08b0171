"""Rows of numbers in a text, of which only the columns that are wanted are kept."""

import gzip
import re
import warnings
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice, takewhile
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

__all__ = ["opened", "passed_over", "read"]

_ODD = re.compile(r"(.*?)(?: at row (\d+).*)?", re.DOTALL)  # what NumPy says of a row


def opened(path: Path) -> IO[bytes]:
    """File to be read by lines, unpacked on the way where gzip packed it."""
    with path.open("rb") as file:
        packed = file.read(2) == b"\x1f\x8b"
    return gzip.open(path, "rb") if packed else path.open("rb")  # type: ignore[return-value]


def read(
    lines: IO[bytes], columns: Sequence[int], count: int | None = None, delimiter: str | None = None
) -> NDArray[np.float64]:
    """Columns of the next rows.

    Parameters
    ----------
    lines : file
        Where the rows begin.
    columns : sequence of int
        Places of those that are kept, in the order in which they are wanted.
    count : int, optional
        Rows; without it all to the end. What comes after them stays to be read.
    delimiter : str, optional
        Between columns; white space without it.

    Returns
    -------
    ndarray, (rows, columns)

    Raises
    ------
    ValueError
        If a row is damaged or there are fewer of them.
    """
    rows = lines if count is None else _whole(islice(lines, count))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # of a text without a row
            table = np.loadtxt(rows, usecols=tuple(columns), delimiter=delimiter, ndmin=2, comments="#")
    except (ValueError, EOFError) as error:
        if isinstance(error, EOFError):
            raise ValueError(f"it is cut off: {error}") from error
        told = _ODD.fullmatch(str(error))
        reason, row = (told[1], told[2]) if told else (str(error), None)
        counted_from_0 = reason.startswith("could not convert")
        where = f" {int(row) + counted_from_0}" if row else ""
        raise ValueError(f"row{where} of its grains is damaged: {reason}") from error
    if count is not None and len(table) != count:
        raise ValueError(f"it ends after {len(table)} of {count} grains")
    return table.reshape(-1, len(columns))


def passed_over(lines: IO[bytes], count: int) -> bool:
    """Whether there were that many lines to pass over."""
    return sum(1 for _ in islice(lines, count)) == count


def _whole(lines: Iterable[bytes]) -> Iterator[bytes]:
    """Lines up to one that a program was not done with: its last number may lack digits."""
    return takewhile(lambda line: line.endswith(b"\n"), lines)
