"""Pictures: laws beside the exact force with their errors below, and the error of a law over its domain."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.colours import FAINT, GRAIN, GRAIN_EDGE, HAIR, INK, LIQUID
from ..ground.look import dress
from ..ground.units import Scale, scale_of, show
from ..laws import laws
from .error_maps import ErrorMap
from .one_pair import Comparison, LawAnswer
from .sample import NO_BRIDGE
from .words import percent

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["comparison_figure", "map_figure", "style_of"]

Floats = NDArray[np.float64]

# Colours that the colour-blind tell apart (muted scheme of P. Tol, its pale ones darker), and with them dashes.
_COLOURS = ("#332288", "#cc6677", "#117733", "#aa4499", "#2a9d8a", "#c46a12", "#3f8fc4")
_DASHES: tuple[Any, ...] = ("-", (0, (6, 1.6)), (0, (5, 1.5, 1.2, 1.5)), (0, (1.4, 1.2)))

_SIZE = (6.2, 7.4)  # in, the widest whose labels can be read on a phone
_LEFT, _WIDTH = 0.115, 0.46
_UPPER, _LOWER = (0.56, 0.33), (0.1, 0.4)  # bottom and height of the two panels
_WIDEST = 1.1  # of the axis of separation, over the rupture distance
_LINEAR = 0.5  # per cent, about up to which the axis of errors is linear
_LIST, _COLUMN = (1.06, 1.16), 1.9  # beside a panel: where samples of the lines begin and end, where numbers end
_DIGITS = 9  # to which two laws are alike, as some are where the angle is zero: names decide then
_STEP = 0.078, 0.064  # between the rows of the two lists, over the height of their panels


class _Style(NamedTuple):
    colour: str
    dashes: Any


def style_of(name: str) -> _Style:
    """How a law is drawn, the same in all pictures."""
    names = list(laws)
    place = names.index(name) if name in names else len(names)  # one that is not registered
    return _Style(_COLOURS[place % len(_COLOURS)], _DASHES[place % len(_DASHES)])


def comparison_figure(comparison: Comparison, *, title: str = "", subtitle: str = "") -> Figure:
    """Draw exact force and laws against separation, and below them the relative errors, with the names of the laws.

    Parameters
    ----------
    comparison : Comparison
        From `compare`.
    title, subtitle : str
        Two lines above the picture.

    Returns
    -------
    matplotlib.figure.Figure
        Tied to no window; see `pendular.show.picture.save`.
    """
    from matplotlib.figure import Figure

    drawing = Figure(figsize=_SIZE, facecolor="white")
    drawing.text(0.02, 0.967, title, size=12, weight="bold", color=INK, va="center")
    drawing.text(0.02, 0.933, subtitle, size=9, color=FAINT, va="center")
    upper = drawing.add_axes((_LEFT, _UPPER[0], _WIDTH, _UPPER[1]))
    lower = drawing.add_axes((_LEFT, _LOWER[0], _WIDTH, _LOWER[1]))
    gap = scale_of(float(comparison.separation[-1]), "m")
    for axes in (upper, lower):
        _dress(axes, comparison, gap)
    _draw_forces(upper, comparison, gap)
    _draw_errors(lower, comparison, gap)
    return drawing


def _dress(axes: Axes, comparison: Comparison, gap: Scale) -> None:
    end = float(comparison.separation[-1]) * gap.factor
    axes.set_xlim(0.0, _WIDEST * end)
    axes.axvline(end, color=HAIR, lw=0.8, ls=(0, (4, 3)), zorder=1)
    dress(axes)


def _draw_forces(axes: Axes, comparison: Comparison, gap: Scale) -> None:
    x, force = comparison.separation * gap.factor, scale_of(float(np.max(np.abs(comparison.force))), "N")
    exact = comparison.force * force.factor
    axes.plot(x, exact, color=LIQUID, lw=7.0, solid_capstyle="round", zorder=2)
    axes.annotate("exact", (x[-1], exact[-1]), (9, 4), textcoords="offset points", size=9, color=FAINT)
    for answer in comparison.laws:
        _plot(axes, answer, x, np.where(answer.error == NO_BRIDGE, np.nan, answer.force) * force.factor)
    low, high = min(0.0, exact.min()), max(0.0, exact.max())
    axes.set_ylim(low - 0.02 * (high - low), high + 0.3 * (high - low))
    axes.set_ylabel(f"force ({force.unit})", color=FAINT)
    axes.tick_params(labelbottom=False)
    _mark_ruptures(axes, comparison, gap)
    _list_ruptures(axes, comparison)


def _mark_ruptures(axes: Axes, comparison: Comparison, gap: Scale) -> None:
    """Rupture distances by the laws, as marks on the axis of separation."""
    for answer in comparison.laws:
        place = answer.rupture_separation * gap.factor
        if place < axes.get_xlim()[1]:
            axes.plot(place, 0.0, "v", ms=6.0, mfc=style_of(answer.name).colour, mec="white", mew=0.7, zorder=5)
    end = float(comparison.separation[-1])
    axes.annotate(
        f"rupture\n{show(end, 'm', 4)}",
        (end * gap.factor, 1.0),
        (-5, -2),
        xycoords=("data", "axes fraction"),
        textcoords="offset points",
        size=9,
        color=FAINT,
        ha="right",
        va="top",
    )


def _draw_errors(axes: Axes, comparison: Comparison, gap: Scale) -> None:
    x = comparison.separation * gap.factor
    axes.set_yscale("asinh", linear_width=_LINEAR)
    axes.axhline(0.0, color=LIQUID, lw=5.0, zorder=1)
    for answer in comparison.laws:
        _plot(axes, answer, x, np.where(answer.judged & (answer.error != NO_BRIDGE), 100.0 * answer.error, np.nan))
    shown = np.concatenate([100.0 * answer.error[answer.judged] for answer in comparison.laws])
    largest = np.nanmax(np.abs(shown), initial=_LINEAR)
    axes.set_ylim(-1.25 * min(largest, 100.0), 1.25 * largest)
    ticks = [sign * size for size in (1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0) for sign in (-1.0, 1.0)]
    low, high = axes.get_ylim()
    axes.set_yticks([0.0, *(tick for tick in sorted(ticks) if low <= tick <= high)])
    axes.set_yticks([], minor=True)
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:+g}".replace("-", "\N{MINUS SIGN}") if value else "0")
    axes.set_ylabel("error of the force (%)", color=FAINT)
    axes.set_xlabel(f"separation ({gap.unit})", color=FAINT)
    _list_forces(axes, comparison, x)


def _plot(axes: Axes, answer: LawAnswer, x: Floats, y: Floats) -> None:
    """Line of a law; a point where it speaks of a single separation."""
    style = style_of(answer.name)
    if np.count_nonzero(~np.isnan(y)) == 1:
        axes.plot(x, y, "D", ms=5.0, mfc=style.colour, mec="white", mew=0.7, zorder=4, clip_on=False)
        return
    axes.plot(x, y, color=style.colour, ls=style.dashes, lw=_weight(answer), zorder=3)


def _weight(answer: LawAnswer) -> float:
    return 1.1 if answer.converted else 1.7


def _list_forces(axes: Axes, comparison: Comparison, x: Floats) -> None:
    """Names of the lines in the order in which they end, tied to their ends, with the largest error of each."""
    drawn = [answer for answer in comparison.laws if not np.isnan(answer.largest_error)]
    ends = {answer.name: _end(axes, answer, x) for answer in drawn}
    drawn.sort(key=lambda answer: (-round(ends[answer.name][1], _DIGITS), answer.name))
    heights = _spread([ends[answer.name][1] for answer in drawn])
    _head(axes, "largest error", "force, to 0.9 of rupture")
    reaching = max((end[0] for end in ends.values()), default=0.0)
    for answer, height in zip(drawn, heights, strict=True):
        style, end = style_of(answer.name), ends[answer.name]
        if end[0] > 0.9 * reaching:  # a line that ends earlier would be tied across all others
            tie: dict[str, Any] = {"color": style.colour, "lw": 0.5, "alpha": 0.6, "clip_on": False}
            axes.plot([end[0], _LIST[0]], [end[1], height], transform=axes.transAxes, **tie)
        sample: dict[str, Any] = {"color": style.colour, "ls": style.dashes, "lw": _weight(answer), "clip_on": False}
        if comparison.fraction[_last(answer)] == 0.0:
            sample |= {"marker": "D", "ms": 5.0, "mec": "white", "mew": 0.7, "ls": "none", "markevery": [1]}
        axes.plot(_LIST, [height, height], transform=axes.transAxes, **sample)
        _row(axes, height, answer, percent(answer.largest_error, signed=False))
    if any(answer.converted for answer in drawn):
        other = "volume" if comparison.control == "suction" else "suction"
        note = f"grey: laws at constant {other},\nasked with the exact {other}"
        under: dict[str, Any] = {"size": 8, "color": FAINT, "va": "center", "ha": "right"}
        axes.text(_COLUMN, -0.155, note, transform=axes.transAxes, **under)


def _list_ruptures(axes: Axes, comparison: Comparison) -> None:
    """Names of the marks in their order, with the error of each rupture distance."""
    known = [answer for answer in comparison.laws if not np.isnan(answer.rupture_error)]
    known.sort(key=lambda answer: (-round(answer.rupture_error, _DIGITS), answer.name))
    _head(axes, "error", "rupture distance")
    for height, answer in zip(1.0 - _STEP[0] * np.arange(len(known)), known, strict=False):
        mark: dict[str, Any] = {
            "ms": 6.0,
            "mfc": style_of(answer.name).colour,
            "mec": "white",
            "mew": 0.7,
            "clip_on": False,
        }
        axes.plot(_LIST[1] - 0.02, height, "v", transform=axes.transAxes, **mark)
        _row(axes, float(height), answer, percent(answer.rupture_error))


def _head(axes: Axes, right: str, left: str) -> None:
    style: dict[str, Any] = {"transform": axes.transAxes, "size": 8, "color": FAINT, "va": "bottom"}
    axes.text(_LIST[1] + 0.015, 1.06, left, **style)
    axes.text(_COLUMN, 1.06, right, ha="right", **style)


def _row(axes: Axes, height: float, answer: LawAnswer, number: str) -> None:
    style: dict[str, Any] = {
        "transform": axes.transAxes,
        "size": 9,
        "color": FAINT if answer.converted else INK,
        "va": "center",
    }
    axes.text(_LIST[1] + 0.015, height, answer.name, **style)
    axes.text(_COLUMN, height, number, ha="right", **style)


def _last(answer: LawAnswer) -> int:
    """Index of the last error that is drawn; of a law without any bridge, the last one it gives."""
    known = ~np.isnan(answer.error) & answer.judged
    drawn = known & (answer.error != NO_BRIDGE)
    return int(np.flatnonzero(drawn if drawn.any() else known)[-1])


def _end(axes: Axes, answer: LawAnswer, x: Floats) -> tuple[float, float]:
    """Where a line ends, in parts of the panel."""
    last = _last(answer)
    low, high = axes.get_ylim()
    value = np.clip(100.0 * answer.error[last], low, high)
    place = axes.transAxes.inverted().transform(axes.transData.transform((x[last], value)))
    return float(place[0]), float(place[1])


def _spread(wanted: list[float]) -> list[float]:
    """Heights in falling order, as near to the wanted ones as rows of text can stand."""
    step, count = _STEP[1], len(wanted)
    step = min(step, 1.0 / max(count - 1, 1))
    lowest = [(count - 1 - i) * step for i in range(count)]
    heights: list[float] = []
    for height, floor in zip(wanted, lowest, strict=True):
        ceiling = heights[-1] - step if heights else 1.0
        heights.append(min(max(height, floor), ceiling))
    return heights


def map_figure(found: ErrorMap) -> Figure:
    """Draw the error of a law over its control and the contact angle, with the range stated for it.

    Parameters
    ----------
    found : ErrorMap
        From `error_map`.

    Returns
    -------
    matplotlib.figure.Figure
        Tied to no window; see `pendular.show.picture.save`.
    """
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.figure import Figure

    drawing = Figure(figsize=(5.6, 4.2), facecolor="white")
    axes = drawing.add_axes((0.1, 0.14, 0.7, 0.67))
    drawing.text(0.02, 0.95, found.law, size=12, weight="bold", color=INK, va="center")
    told = f"error of the {found.in_words}, two equal spheres"
    drawing.text(0.02, 0.89, told, size=9, color=FAINT, va="center")
    has_bridge = ~np.isnan(found.error) & (found.error != NO_BRIDGE)
    levels = _levels(100.0 * np.abs(found.error[has_bridge]))
    x, y = found.control_star, np.degrees(found.contact_angle)
    for mask, colour in ((found.error == NO_BRIDGE, GRAIN_EDGE), (np.isnan(found.error), GRAIN)):
        axes.pcolormesh(x, y, np.where(mask, 1.0, np.nan).T, cmap=ListedColormap([colour]), rasterized=True)
    shown = np.where(has_bridge, 100.0 * found.error, np.nan)
    norm = BoundaryNorm(levels, 256, extend="both")
    filled = axes.pcolormesh(x, y, shown.T, cmap="PuOr_r", norm=norm, rasterized=True)
    axes.set(xscale="log", xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    axes.set_xlabel({"suction": "reduced suction $H^*$", "volume": "reduced volume $V^*$"}[found.control], color=FAINT)
    axes.set_ylabel("contact angle (°)", color=FAINT)
    axes.tick_params(labelcolor=FAINT, labelsize=9, width=0.8, length=3, color=HAIR)
    axes.spines[:].set(color=HAIR, lw=0.8)
    _outline_range(axes, found)
    bar = drawing.colorbar(filled, cax=drawing.add_axes((0.83, 0.14, 0.026, 0.67)), ticks=levels)
    bar.ax.set_yticklabels([f"{level:+g} %".replace("-", "\N{MINUS SIGN}") for level in levels])
    bar.ax.tick_params(labelcolor=FAINT, labelsize=8.5, color=HAIR)
    bar.outline.set_edgecolor(HAIR)
    return drawing


def _levels(sizes: Floats) -> list[float]:
    """Borders of the bands, per cent, up to a round error that few exceed, and 100 at most."""
    typical = float(np.quantile(sizes, 0.95)) if sizes.size else 1.0
    decade = 10.0 ** np.floor(np.log10(max(typical, 1e-12)))
    top = min(next(step * decade for step in (1.0, 2.0, 5.0, 10.0) if step * decade >= typical), 100.0)
    positive = [part * top for part in (0.02, 0.05, 0.1, 0.2, 0.5, 1.0)]
    return [-level for level in reversed(positive)] + positive


def _outline_range(axes: Axes, found: ErrorMap) -> None:
    """Range stated for the law, as far as it lies in the map, and what the signs mean."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Rectangle

    valid = laws[found.law].valid
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    first, last = np.clip(valid.get(f"{found.control}_star", (0.0, np.inf)), left, right)
    least, most = np.clip(np.degrees(valid.get("contact_angle", (0.0, np.pi))), low, high)
    style: dict[str, Any] = {"fill": False, "edgecolor": INK, "lw": 1.6, "ls": (0, (4, 2))}
    axes.add_patch(Rectangle((first, least), last - first, most - least, clip_on=False, zorder=5, **style))
    signs: list[tuple[Artist, str]] = [(Line2D([], [], color=INK, lw=1.6, ls=style["ls"]), "range stated for the law")]
    for mask, colour, meaning in (
        (found.error == NO_BRIDGE, GRAIN_EDGE, "no bridge by the law"),
        (np.isnan(found.error), GRAIN, "outside its domain"),
    ):
        if mask.any():
            signs.append((Rectangle((0, 0), 1, 1, facecolor=colour), meaning))
    key: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (-0.01, 1.0), "frameon": False, "ncols": 3}
    key |= {"columnspacing": 1.0, "handlelength": 1.6, "handletextpad": 0.5}
    axes.legend(*zip(*signs, strict=True), fontsize=8, labelcolor=FAINT, borderaxespad=0.3, **key)
