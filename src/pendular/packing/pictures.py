"""Pictures of a heap: its retention, its stress, and its grains and bridges to scale."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..ground.colours import ACCENT, FAINT, GRAIN, HAIR, INK, LIQUID_EDGE
from ..ground.look import COLUMN, dress, head_height, write_head
from ..ground.units import scale_of, show
from .rendering import image_of, view_of
from .retention import Retention, Walk
from .scene import scene_image
from .wetted import Wet

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["draw_heap", "draw_retention"]

Floats = NDArray[np.float64]

_PIXELS = 1400
_PANELS = 6.6  # in, of those of a retention
_ROWS = ((4.3, 2.2), (3.2, 1.0), (0.5, 2.1))  # lower edge and height of each, [in]
_LIQUID = "#3f86bd"
_STYLES = {"drying": (LIQUID_EDGE, "-"), "wetting": (ACCENT, "-")}


def draw_retention(curves: Retention, title: str = "", subtitle: str = "") -> Figure:
    """Draw saturation against suction and stress against saturation, with the pendular limit.

    Parameters
    ----------
    curves : Retention
        Of ``retention_of``.
    title, subtitle : str
        Above the picture.

    Returns
    -------
    Figure
    """
    from matplotlib.figure import Figure

    height = _PANELS + head_height(title, subtitle)
    figure = Figure(figsize=(COLUMN, height), facecolor="white")
    left, below, right = (figure.add_axes((0.16, low / height, 0.8, high / height)) for low, high in _ROWS)
    below.sharex(left)
    scale = scale_of(float(curves.suction.max()), "Pa")
    stress = scale_of(float(np.nanmax(curves.walks[0].values["suction_stress"])), "Pa")
    drying = curves.walks[0].values["saturation"]
    for walk in curves.walks[::-1]:
        _draw_walk(left, curves.suction * scale.factor, walk.values["saturation"], walk)
        _draw_walk(below, curves.suction * scale.factor, walk.values["saturation"] / drying, walk)
        _draw_walk(right, walk.values["saturation"], walk.values["suction_stress"] * stress.factor, walk)
    left.set(xscale="log", yscale="log", ylabel="saturation")
    left.tick_params(labelbottom=False)
    below.set(xlabel=f"suction, {scale.unit}", ylabel="over drying")
    right.set(xscale="log", xlabel="saturation", ylabel=f"suction stress, {stress.unit}")
    right.set_ylim(bottom=0.0)
    _mark_limit(left, below, right, curves, scale.factor)
    for axes in (left, below, right):
        dress(axes)
    left.legend(frameon=False, fontsize=9, labelcolor=INK, loc="lower left")
    write_head(figure, title, subtitle)
    return figure


def _draw_walk(axes: Axes, x: Floats, y: Floats, walk: Walk) -> None:
    is_main = np.isnan(walk.turns_at)
    colour, line = _STYLES[walk.name.split(" ")[0]]
    axes.plot(
        x, y, line if is_main else "--", color=colour, linewidth=1.8 if is_main else 1.2, label=walk.name,
        marker="" if len(x) > 12 else "o", markersize=3,
    )  # fmt: skip


def _mark_limit(left: Axes, below: Axes, right: Axes, curves: Retention, factor: float) -> None:
    """Shade where bridges meet: what is drawn there is that of bridges which overlap."""
    limits = [limit for limit in curves.limits.values() if np.isfinite(limit)]
    if not limits:
        return
    limit, drying = max(limits), curves.walks[0]
    least = curves.suction[0] * factor
    for axes in (left, below):
        axes.axvspan(least, limit * factor, color=HAIR, alpha=0.18, linewidth=0)
    left.set_xlim(least, curves.suction[-1] * factor)
    known = drying.values["saturation"]
    at = float(np.exp(np.interp(np.log(limit), np.log(curves.suction), np.log(known))))
    right.axvspan(at, float(known.max()), color=HAIR, alpha=0.18, linewidth=0)
    right.set_xlim(float(np.nanmin([walk.values["saturation"] for walk in curves.walks])), float(known.max()))
    for axes, place in ((left, limit * factor), (below, limit * factor), (right, at)):
        axes.axvline(place, color=INK, linewidth=0.8)
    left.annotate(
        f"bridges meet\nbelow {show(limit, 'Pa', 3)}", (limit * factor, 0.98), (4, 0), ("data", "axes fraction"),
        "offset points", color=INK, fontsize=8.5, va="top",
    )  # fmt: skip
    right.annotate(
        f"bridges meet\nabove {100 * at:.3g} %", (at, 0.04), (-4, 0), ("data", "axes fraction"),
        "offset points", color=INK, fontsize=8.5, va="bottom", ha="right",
    )  # fmt: skip


def draw_heap(w: Wet, title: str = "", subtitle: str = "") -> Figure:
    """Draw grains and bridges to scale: by PyVista where it is installed and can draw, else by means of our own.

    Parameters
    ----------
    w : Wet
        The heap.
    title, subtitle : str
        Above the picture.

    Returns
    -------
    Figure
        With an image: bridges that leave the cell are left out.
    """
    from matplotlib.colors import to_rgb
    from matplotlib.figure import Figure

    view = view_of(w)
    grain, liquid, ground = (np.array(to_rgb(colour)) for colour in (GRAIN, _LIQUID, "white"))
    image = scene_image(w, view, _PIXELS, (grain, liquid, ground))
    if image is None:
        image = np.clip(image_of(w, view, _PIXELS, (grain, liquid, ground)), 0.0, 1.0)
    width = 7.0
    height = width * image.shape[0] / image.shape[1]
    figure = Figure(figsize=(width, height + 0.9), facecolor="white")
    share = height / (height + 0.9)
    axes = figure.add_axes((0.0, 0.0, 1.0, share))
    axes.imshow(image, origin="lower", extent=(0.0, view.size[0], 0.0, view.size[1]), interpolation="antialiased")
    axes.set_axis_off()
    bar = _round(0.2 * float(view.size[0]))
    x, y = 0.03 * float(view.size[0]), 0.03 * float(view.size[1])
    axes.plot([x, x + bar], [y, y], color=INK, linewidth=2.0, solid_capstyle="butt")
    axes.text(x + 0.5 * bar, y + 0.012 * float(view.size[1]), show(bar, "m"), color=INK, fontsize=9, ha="center")
    axes.set(xlim=(0.0, view.size[0]), ylim=(0.0, view.size[1]))
    figure.text(0.03, share + 0.65 * (1 - share), title, color=INK, fontsize=12, weight="bold", va="center")
    figure.text(0.03, share + 0.25 * (1 - share), subtitle, color=FAINT, fontsize=9, va="center")
    return figure


def _round(length: float) -> float:
    """The largest of 1, 2 and 5 with a power of ten up to a length."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(max(step * power for step in (1.0, 2.0, 5.0) if step * power <= length * (1 + 1e-9)))
