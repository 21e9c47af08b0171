"""Picture of the errors that YADE makes with a set of tables."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ...ground.colours import ACCENT, FAINT, HAIR, INK, LIQUID_EDGE
from . import reader
from .audit import MIDDLE, Audit
from .errors import measure
from .exact import exact_rows, exact_rupture
from .files import RATIOS, Table
from .tables import REACH

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["audit_figure"]

Floats = NDArray[np.float64]

_SIZE = (11.0, 7.6)  # in
_COLUMNS = 5
_LEAST_SUCTION = 1e-2
_MAP = (160, 140)  # suctions, gaps
_HIGHEST = 1.15  # of the rupture distance, to which a map reaches
_ERRORS = (1e-5, 1.0)  # from the palest to the darkest


def audit_figure(audit: Audit) -> Figure:
    """Draw the error of the force in YADE as a map for every table, and below it the errors between their ratios.

    Parameters
    ----------
    audit : Audit
        Of a set of which some tables can be read.

    Returns
    -------
    matplotlib.figure.Figure
        Tied to no window; see `pendular.show.picture.save`.
    """
    from matplotlib.figure import Figure

    drawing = Figure(figsize=_SIZE, facecolor="white")
    title = f"Error of the capillary force in YADE, contact angle {math.degrees(audit.contact_angle):.4g}°"
    drawing.text(0.02, 0.967, title, size=12, weight="bold", color=INK, va="center")
    told = "over the force at contact under the same suction; the line is the gap at which YADE breaks the bridge"
    drawing.text(0.02, 0.935, told, size=9, color=FAINT, va="center")
    _draw_maps(drawing, audit)
    if audit.between:
        _draw_between(drawing.add_axes((0.075, 0.075, 0.53, 0.2)), audit)
    return drawing


def _draw_maps(drawing: Figure, audit: Audit) -> None:
    grid = drawing.add_gridspec(2, _COLUMNS, left=0.075, right=0.9, bottom=0.4, top=0.87, wspace=0.1, hspace=0.28)
    image: Any = None
    for i, table in enumerate(audit.tables[: len(RATIOS)]):
        axes = drawing.add_subplot(grid[divmod(i, _COLUMNS)])
        image = _draw_map(axes, table, audit.contact_angle)
        is_lowest = i + _COLUMNS >= len(audit.tables)
        axes.tick_params(labelleft=i % _COLUMNS == 0, labelbottom=is_lowest)
    bar = drawing.colorbar(image, cax=drawing.add_axes((0.92, 0.4, 0.012, 0.47)), extend="min")
    bar.outline.set_visible(False)
    bar.ax.tick_params(labelcolor=FAINT, labelsize=8, color=HAIR)
    bar.ax.yaxis.set_major_formatter(lambda value, _: f"{100.0 * value:g} %")
    drawing.text(0.4875, 0.345, "reduced suction u R2/γ", size=9, color=FAINT, ha="center")
    drawing.text(0.018, 0.635, "gap over rupture distance", size=9, color=FAINT, va="center", rotation=90)


def _draw_map(axes: Axes, table: Table, contact_angle: float) -> Any:
    """Error over suction and gap; where one of the two has no bridge, what the other makes of it."""
    from matplotlib import colormaps
    from matplotlib.colors import LogNorm

    suctions = np.geomspace(_LEAST_SUCTION, max(float(table.last_suctions[0]), 10.0 * _LEAST_SUCTION), _MAP[0])
    fractions = np.linspace(0.0, _HIGHEST, _MAP[1])
    ruptures = exact_rupture(table.ratio, contact_angle, suctions)
    gaps = fractions[:, None] * ruptures
    exact = exact_rows(table.ratio, contact_angle, gaps, suctions)[..., 3]
    found = reader.interpolate_table(table, gaps.ravel(), np.broadcast_to(suctions, gaps.shape).ravel())
    error = np.abs(found[:, 3].reshape(gaps.shape) - exact) / exact[0]
    shown = np.maximum(error, 1e-3 * _ERRORS[0])
    colours = colormaps["YlGnBu"].with_extremes(under="white")
    image = axes.pcolormesh(suctions, fractions, shown, norm=LogNorm(*_ERRORS), cmap=colours, rasterized=True)
    axes.plot(suctions, reader.table_rupture(table, suctions) / ruptures, color=ACCENT, lw=1.1)
    axes.set(xscale="log", xlim=(suctions[0], suctions[-1]), ylim=(0.0, _HIGHEST))
    axes.set_xticks([1e-1, 1e1, 1e3], ["0.1", "10", "1000"])
    axes.set_title(f"R2/R1 = {table.ratio:g}", size=9, color=INK, loc="left", pad=3.0)
    _dress(axes)
    return image


def _draw_between(axes: Axes, audit: Audit) -> None:
    """Errors against the ratio: small at the ten, large where YADE mixes two tables."""
    ratios = [table.ratio for table in audit.tables]
    inner = [measure([table], table.ratio, audit.contact_angle, MIDDLE).force for table in audit.tables]
    reached = [math.nan if file.in_yade is None else file.in_yade.force for file in audit.files]
    broken = [math.nan if file.rupture is None else file.rupture.largest for file in audit.files]
    x = _woven(ratios, [mixed.ratio for mixed in audit.between])
    lines = (
        (f"force to {REACH:g} of rupture", LIQUID_EDGE, _woven(reached, [m.in_yade.force for m in audit.between])),
        (f"force to {MIDDLE:g}", INK, _woven(inner, [mixed.inner.force for mixed in audit.between])),
        ("rupture distance", ACCENT, _woven(broken, [mixed.rupture.largest for mixed in audit.between])),
    )
    for i, (name, colour, errors) in enumerate(lines):
        axes.plot(x, errors, color=colour, lw=1.2, marker="o", ms=3.5, mec="white", mew=0.6, clip_on=False)
        axes.text(1.03, 0.9 - 0.16 * i, name, transform=axes.transAxes, size=9, color=colour, va="center")
    axes.set(xscale="log", yscale="log", xlim=(1.0, ratios[-1]))
    axes.set_xticks(ratios, [f"{ratio:g}" for ratio in ratios])
    axes.set_xticks([], minor=True)
    axes.yaxis.set_major_formatter(lambda value, _: f"{100.0 * value:g} %")
    axes.set_xlabel("R2/R1; the ticks are the tables, between them YADE mixes two", color=FAINT, size=9)
    axes.set_ylabel("largest error", color=FAINT, size=9)
    axes.spines[["top", "right"]].set_visible(False)
    _dress(axes)


def _woven(outer: list[float], between: list[float]) -> Floats:
    """Values at the tables and in the middles between them, in turn."""
    woven = np.empty(len(outer) + len(between))
    woven[::2], woven[1::2] = outer, between
    return woven


def _dress(axes: Axes) -> None:
    axes.tick_params(labelcolor=FAINT, labelsize=8, width=0.8, length=3, color=HAIR)
    axes.tick_params(which="minor", length=0)
    for spine in axes.spines.values():
        spine.set(color=HAIR, lw=0.8)
