"""How the figures look: one set of colours, marks and helpers for all of them.

Exact bridges are marks, what the article says about them is a line, and colour tells the cases of a panel apart.
"""

from collections.abc import Iterable, Sequence
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from pendular.ground import look
from pendular.ground.colours import ACCENT, INK

Floats = NDArray[np.float64]
Place = Literal["best", "lower left", "lower right", "center right", "upper right"]

ANGLES = {0.0: 4, 20.0: 5, 40.0: 6}  # cases of contact angles, whose colours are those of all pictures
COLOURS = ("#1d6496", "#c2452d", "#8a6d1f", "#5b4a91", *map(look.angle_colour, ANGLES))
MARKS = ("o", "s", "^", "D", "o", "s", "^")
_PANEL = (4.5, 3.7)  # in

SEPARATION, PART = "$S^*$", "$S^*/S^*_{crit}$"
SUCTION, FORCE = "$H^*$", "$\\lambda^*$"
PRODUCT = "$2S^*_{crit}\\,H^*$"


def panels(
    titles: Sequence[str], x: str, y: str | Sequence[str], *, x_scale: str = "linear"
) -> tuple[Figure, list[Axes]]:
    """Panels side by side, dressed alike; one panel needs no letter."""
    figure = Figure(figsize=(_PANEL[0] * len(titles), _PANEL[1]), facecolor="white", layout="constrained")
    row = list(figure.subplots(1, len(titles), squeeze=False)[0])
    names = [y] * len(titles) if isinstance(y, str) else y
    for letter, axes, title, name in zip("abcd", row, titles, names, strict=False):
        dress(axes, x, name, x_scale=x_scale)
        axes.set_title(f"({letter}) {title}" if len(titles) > 1 else title, loc="left", size=10, color=INK)
    return figure, row


def dress(axes: Axes, x: str, y: str, *, x_scale: str = "linear") -> None:
    """Labels and quiet axes."""
    look.dress(axes)
    axes.set_xlabel(x, color=INK, size=11)
    axes.set_ylabel(y, color=INK, size=11)
    axes.set_xscale(x_scale)
    if x_scale == "linear":
        axes.locator_params(axis="x", nbins=6)
        axes.ticklabel_format(axis="x", scilimits=(-2, 4), useMathText=True)


def marks(axes: Axes, x: Floats, y: Floats, case: int, *, size: float = 4.6) -> None:
    """Exact bridges."""
    colour = COLOURS[case]
    axes.plot(x, y, MARKS[case], ms=size, mfc="white", mec=colour, mew=1.1, ls="none", zorder=3)


def line(axes: Axes, x: Floats, y: Floats, case: int, *, dashed: bool = False) -> None:
    """What a formula says."""
    style = (0, (4, 2.2)) if dashed else "-"
    axes.plot(x, y, color=COLOURS[case], lw=1.5, ls=style, zorder=2, solid_capstyle="round")


def key_of_angles(
    axes: Axes, angles: Iterable[float], kinds: Sequence[tuple[str, str]] = (), place: Place = "best"
) -> None:
    """Legend of contact angles."""
    _key(axes, {ANGLES[degrees]: f"θ = {degrees:g}°" for degrees in angles}, kinds, place)


def key(axes: Axes, cases: Iterable[str], kinds: Sequence[tuple[str, str]] = (), place: Place = "best") -> None:
    """Legend: one entry for each case, then one for each kind of sign ("o" a mark, "-" a line, "--" dashes)."""
    _key(axes, dict(enumerate(cases)), kinds, place)


def _key(axes: Axes, cases: dict[int, str], kinds: Sequence[tuple[str, str]], place: Place) -> None:
    entries = [
        (Line2D([], [], color=COLOURS[i], marker=MARKS[i], ms=4.6, mfc="white", lw=1.5), case)
        for i, case in cases.items()
    ]
    entries += [(_sign(sign), text) for sign, text in kinds]
    handles, labels = [handle for handle, _ in entries], [label for _, label in entries]
    axes.legend(handles, labels, loc=place, frameon=False, fontsize=9, labelcolor=INK)


def point(axes: Axes, x: float, y: float, text: str, offset: tuple[float, float] = (9, 0)) -> None:
    """A point of its own name."""
    axes.plot(x, y, "o", ms=6.5, mfc="white", mec=ACCENT, mew=1.8, zorder=5)
    side = "left" if offset[0] >= 0 else "right"
    axes.annotate(
        text, (x, y), offset, textcoords="offset points", size=9, color=ACCENT, ha=side, va="center", zorder=6
    )


def _sign(sign: str) -> Line2D:
    if sign in MARKS:
        return Line2D([], [], color=INK, marker=sign, ms=4.6, mfc="white", ls="none")
    return Line2D([], [], color=INK, lw=1.5, ls=sign)
