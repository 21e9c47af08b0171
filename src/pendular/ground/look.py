"""How pictures look: their width, their axes, and the colours of what is held and of contact angles."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from .colours import ACCENT, FAINT, HAIR, INK, LIQUID_EDGE

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["COLUMN", "HELD", "TITLE", "angle_colour", "dress", "head_height", "panels", "write_head"]

COLUMN = 4.4  # in: on a phone of 360 pixels, and 85 mm wide in an article of two columns, its letters are 7 points high

TITLE: Mapping[str, Any] = {"loc": "left", "size": 10, "color": INK}  # of a panel
HELD = {"suction": LIQUID_EDGE, "volume": ACCENT, "humidity": "#2f7d5b"}

_TITLE_LETTERS, _SUBTITLE_LETTERS = 44, 60  # in a column
_TITLE_LINE, _SUBTITLE_LINE, _MARGIN = 0.2, 0.18, 0.1  # in
_ANGLES = ((0.0, "#5b4a91"), (45.0, "#b0417c"), (90.0, "#c77d20"), (180.0, "#5d7a1f"))  # degrees


def angle_colour(degrees: float) -> str:
    """Colour of a contact angle, the same in all pictures: violet at 0°, ochre at 90°, green at 180°.

    Parameters
    ----------
    degrees : float
        From 0 to 180.

    Examples
    --------
    >>> angle_colour(0.0), angle_colour(20.0)
    ('#5b4a91', '#814688')
    """
    for (low, first), (high, last) in pairwise(_ANGLES):
        if low <= degrees <= high:
            share = (degrees - low) / (high - low)
            parts = [(int(first[i : i + 2], 16), int(last[i : i + 2], 16)) for i in (1, 3, 5)]
            return "#" + "".join(f"{round(a + share * (b - a)):02x}" for a, b in parts)
    raise ValueError(f"degrees: {degrees:g} is not in [0, 180]")


def panels(*heights: float, width: float = COLUMN, share_x: bool = False) -> tuple[Figure, list[Axes]]:
    """Panels one above the other, dressed alike.

    Parameters
    ----------
    *heights : float
        Of each panel with its labels, [in].
    width : float
        [in].
    share_x : bool
        Whether all have the horizontal axis of the last.

    Returns
    -------
    Figure, list of Axes
        From above.
    """
    from matplotlib.figure import Figure

    drawing = Figure(figsize=(width, sum(heights)), facecolor="white", layout="constrained")
    rows = drawing.subplots(len(heights), 1, height_ratios=heights, sharex=share_x, squeeze=False)[:, 0]
    for axes in rows:
        dress(axes)
    return drawing, list(rows)


def dress(axes: Axes) -> None:
    """Give axes two quiet lines, and faint numbers and labels."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set(color=HAIR, lw=0.8)
    axes.tick_params(which="both", labelcolor=FAINT, labelsize=9, width=0.8, length=3, color=HAIR)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set(color=FAINT, size=10)
        axis.get_offset_text().set(color=FAINT, size=9)


def head_height(title: str, subtitle: str) -> float:
    """What title and subtitle take of a picture that is as wide as a column, [in]."""
    lines = _lines(title, subtitle)
    return 2.0 * _MARGIN + _TITLE_LINE * len(lines[0]) + _SUBTITLE_LINE * len(lines[1])


def write_head(drawing: Figure, title: str, subtitle: str) -> None:
    """Write title and subtitle at the upper edge of a picture that is as wide as a column, in lines that fit."""
    height = drawing.get_figheight()
    titles, subtitles = _lines(title, subtitle)
    low = _MARGIN + _TITLE_LINE * len(titles)
    drawing.text(0.03, 1.0 - _MARGIN / height, "\n".join(titles), size=10.5, weight="bold", color=INK, va="top")
    drawing.text(0.03, 1.0 - (low + 0.02) / height, "\n".join(subtitles), size=9, color=FAINT, va="top")


def _lines(title: str, subtitle: str) -> tuple[list[str], list[str]]:
    return textwrap.wrap(title, _TITLE_LETTERS), textwrap.wrap(subtitle, _SUBTITLE_LETTERS)
