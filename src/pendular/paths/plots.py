"""Picture of a path: the force as the solids or the liquid are changed, the contact angles and the contact radii."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..ground.colours import ACCENT, FAINT, HAIR, INK, LIQUID_EDGE
from ..ground.units import scale_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .result import BridgePath

__all__ = ["path_figure"]

Floats = NDArray[np.float64]

# What lines do, and how a piece is drawn on which they do it: of two lines the one that moves tells.
_COLOURS = {"pinned": HAIR, "free": INK, "advancing": LIQUID_EDGE, "receding": ACCENT}
_WORDS = {"pinned": "lines pinned", "free": "lines free", "advancing": "advancing", "receding": "receding"}
_UNITS = {"separation": "m", "volume": "m^3", "suction": "Pa"}
_ALIKE = 1e-6  # relative difference of both solids that is not seen
_SAME = 1e-9  # relative change of what is not changed along a path
_MOST_ARROWS = 6
_DECADES = 20.0  # largest over least, from which on an axis is logarithmic


def path_figure(bridges: BridgePath, *, title: str = "", subtitle: str = "") -> Figure:
    """Draw a path: the force, and beside it contact angles and radii of both solids.

    Parameters
    ----------
    bridges : BridgePath
        From `pendular.path`.
    title, subtitle : str
        Two lines above the picture.

    Returns
    -------
    matplotlib.figure.Figure
        Tied to no window.
    """
    from matplotlib.figure import Figure

    drawing = Figure(figsize=(9.2, 4.6), facecolor="white")
    top = 0.84 if title else 0.95
    large = drawing.add_axes((0.085, 0.13, 0.47, top - 0.13))
    upper = drawing.add_axes((0.645, 0.13 + 0.53 * (top - 0.13), 0.335, 0.47 * (top - 0.13)))
    lower = drawing.add_axes((0.645, 0.13, 0.335, 0.47 * (top - 0.13)), sharex=upper)
    drawing.text(0.02, 0.955, title, size=12, weight="bold", color=INK, va="center")
    drawing.text(0.02, 0.905, subtitle, size=9, color=FAINT, va="center")
    name = _along(bridges)
    axis = scale_of(float(np.nanmax(np.abs(getattr(bridges, name)))), _UNITS[name])
    force = scale_of(float(np.nanmax(np.abs(bridges.force))), "N")
    radius = scale_of(float(np.nanmax(bridges.contact_radius)), "m")
    places = _with_end(bridges, getattr(bridges, name), name) * axis.factor
    forces = _with_end(bridges, bridges.force, "force") * force.factor
    doings = _doings(bridges)
    _draw(large, places, forces, doings, True)
    angles = np.rad2deg(_with_end(bridges, bridges.contact_angle, "contact_angle"))
    radii = _with_end(bridges, bridges.contact_radius, "contact_radius") * radius.factor
    for axes, values in ((upper, angles), (lower, radii)):
        alike = np.allclose(values[:, 0], values[:, 1], rtol=_ALIKE)
        for solid in (0,) if alike else (0, 1):
            _draw(axes, places, values[:, solid], [pair[solid : solid + 1] for pair in doings], False, solid)
    words = f"{name} ({axis.unit})"
    large.set_xlabel(words, color=FAINT)
    lower.set_xlabel(words, color=FAINT)
    large.set_ylabel(f"force ({force.unit})", color=FAINT)
    upper.set_ylabel("contact angle (°)", color=FAINT)
    lower.set_ylabel(f"contact radius ({radius.unit})", color=FAINT)
    upper.tick_params(labelbottom=False)
    if places.min() > 0.0 and places.max() > _DECADES * places.min():
        for axes in (large, upper, lower):
            _make_logarithmic(axes)
        upper.tick_params(labelbottom=False)
    if not all(np.allclose(values[:, 0], values[:, 1], rtol=_ALIKE) for values in (angles, radii)):
        upper.set_title("first solid ——   second – –", size=9, color=FAINT, loc="right")
    _tell(large, doings, None if bridges.rupture is None else (places[-1], forces[-1]))
    return drawing


def _make_logarithmic(axes: Axes) -> None:
    """Decades on the axis, with 1, 2 and 5 of each written as they are."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _place: f"{value:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def _along(bridges: BridgePath) -> str:
    """What is changed along a path: the separation, or what is held."""
    separation = np.asarray(bridges.separation)[np.asarray(bridges.exists)]
    moves = np.ptp(separation) > _SAME * np.max(np.abs(separation))
    return "separation" if moves else bridges.control


def _with_end(bridges: BridgePath, values: Any, name: str) -> Floats:
    """A field at all steps that hold a bridge, and as it broke."""
    known: Floats = np.asarray(values)[np.asarray(bridges.exists)]
    if bridges.rupture is None:
        return known
    return np.concatenate([known, np.asarray(getattr(bridges.rupture, name))[None]])


def _doings(bridges: BridgePath) -> list[tuple[str, ...]]:
    """What both lines do at these places."""
    steps = [tuple(both) for both in bridges.line[np.asarray(bridges.exists)].tolist()]
    return steps if bridges.rupture is None else [*steps, tuple(bridges.rupture.line.tolist())]


def _doing(both: tuple[str, ...]) -> str:
    return next(word for word in ("receding", "advancing", "free", "pinned") if word in both)


def _draw(axes: Axes, x: Floats, y: Floats, doings: list[tuple[str, ...]], is_loop: bool, solid: int = 0) -> None:
    """Pieces in the colours of what the lines do; arrows tell the way round a loop."""
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set(color=HAIR, lw=0.8)
    axes.tick_params(labelcolor=FAINT, labelsize=9, width=0.8, length=3, color=HAIR)
    first, style = 0, "-" if solid == 0 else (0, (4, 2))
    for word, steps in groupby(_doing(both) for both in doings[1:]):
        last = first + len(list(steps))
        here = slice(first, last + 1)
        axes.plot(x[here], y[here], ls=style, color=_COLOURS[word], lw=2.0, solid_capstyle="round")
        first = last
    if is_loop and len(x) > 1:
        _draw_arrows(axes, x, y, doings)


def _draw_arrows(axes: Axes, x: Floats, y: Floats, doings: list[tuple[str, ...]]) -> None:
    """Arrow heads at places spread evenly over the drawn length."""
    scale = np.hypot(np.diff(x) / (np.ptp(x) or 1.0), np.diff(y) / (np.ptp(y) or 1.0))
    way = np.concatenate([[0.0], np.cumsum(scale)])
    for place in (np.arange(_MOST_ARROWS) + 0.5) / _MOST_ARROWS * way[-1]:
        i = int(np.clip(np.searchsorted(way, place), 1, len(x) - 1))
        share = (place - way[i - 1]) / (way[i] - way[i - 1]) if way[i] > way[i - 1] else 0.5
        tip = (x[i - 1] + share * (x[i] - x[i - 1]), y[i - 1] + share * (y[i] - y[i - 1]))
        tail = (tip[0] - 1e-3 * (x[i] - x[i - 1]), tip[1] - 1e-3 * (y[i] - y[i - 1]))
        colour = _COLOURS[_doing(doings[i])]
        axes.annotate("", tip, tail, arrowprops={"arrowstyle": "-|>", "color": colour, "mutation_scale": 14})
    axes.plot(x[0], y[0], "o", ms=5.0, mfc="white", mec=INK, mew=1.2, zorder=5)


def _tell(axes: Axes, doings: list[tuple[str, ...]], end: tuple[float, float] | None) -> None:
    """The legend, and the mark of the rupture."""
    axes.axhline(0.0, color=HAIR, lw=0.6, zorder=1)
    met = {_doing(both) for both in doings[1:]}
    for word, colour in _COLOURS.items():
        if word in met:
            axes.plot([], [], color=colour, lw=2.0, label=_WORDS[word])
    axes.plot([], [], "o", ms=5.0, mfc="white", mec=INK, mew=1.2, label="start")
    if end is not None:
        axes.plot(*end, "o", ms=6.5, mfc="white", mec=ACCENT, mew=1.8, zorder=5, label="the bridge breaks")
    axes.legend(frameon=False, fontsize=9, loc="best", labelcolor=INK)
