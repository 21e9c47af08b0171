"""Files ``.data`` of MercuryDPM: frames of a line with the domain, then a row a grain."""

from pathlib import Path
from typing import IO

import numpy as np

from . import rows
from .found import Found

__all__ = ["looks_like", "read"]

_CENTRE_AND_RADIUS = (0, 1, 2, 6)  # x y z vx vy vz radius, angles, spins, a number


def looks_like(start: str) -> bool:
    r"""Whether a text begins with a whole number, a time and six bounds, and a row of a grain follows.

    Examples
    --------
    >>> looks_like("1 0.5 0 0 0 1 1 1\n" + "0.5 " * 13 + "0\n")
    True
    """
    first, _, rest = start.partition("\n")
    words, row = first.split(), rest.partition("\n")[0].split()
    return len(words) == 8 and words[0].isdigit() and len(row) >= 14


def read(path: Path, frame: int) -> Found:
    """Grains of a frame, in a box that repeats nowhere: the file does not tell where.

    Parameters
    ----------
    path : Path
        Of a text of three dimensions (format 14).
    frame : int
        From 0 on, or from the end by -1 and below.

    Returns
    -------
    Found

    Raises
    ------
    ValueError
        If the frame is not there or damaged.

    References
    ----------
    .. [1] T. Weinhart et al., Comput. Phys. Commun. 249 (2020) 107129, doi 10.1016/j.cpc.2019.107129; source of
       ``DPMBase::outputXBallsData``.
    """
    with rows.opened(path) as lines:
        starts: list[tuple[int, int, list[float]]] = []
        while frame < 0 or len(starts) <= frame:
            head = _head(lines, len(starts))
            if head is None:
                break
            starts.append((lines.tell(), *head))
            if not rows.passed_over(lines, head[0]) and frame not in (-1, len(starts) - 1):
                break
        try:
            start, count, bounds = starts[frame]
        except IndexError:
            raise ValueError(f"frame {frame} is not among its {len(starts)} frames") from None
        lines.seek(start)
        table = rows.read(lines, _CENTRE_AND_RADIUS, count)
    cell = np.diag(np.subtract(bounds[3:], bounds[:3]))
    return Found(np.ascontiguousarray(table[:, :3]), table[:, 3], cell, np.zeros(3, bool))


def _head(lines: IO[bytes], frame: int) -> tuple[int, list[float]] | None:
    words = lines.readline().split()
    if not words:
        return None
    try:
        count, _, *bounds = int(words[0]), *map(float, words[1:])
    except ValueError:
        bounds = []
    if len(bounds) != 6:
        raise ValueError(f"the head of frame {frame} is not a number of grains, a time and six bounds")
    return count, bounds
