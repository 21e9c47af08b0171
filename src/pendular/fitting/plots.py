"""Picture of a fit: the curve as measured, the bridge that fits it, what is left, and the numbers found."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..ground.colours import ACCENT, FAINT, HAIR, INK, LIQUID, LIQUID_EDGE
from ..ground.look import COLUMN, dress, head_height, write_head
from ..ground.units import Scale, scale_of
from .words import value_words

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .result import Fit

__all__ = ["fit_figure"]

Floats = NDArray[np.float64]

_WIDTH, _CURVE, _RESIDUALS = COLUMN, 2.9, 1.6  # in, of the picture and of its two panels
_ROW, _IN_A_ROW = 0.62, 3  # in, of a row of numbers; numbers in it
_FINE = 400  # points of the line
_BEFORE_RUPTURE = 1e-4  # root of the way before rupture, over the curve, to which a line goes
_BEYOND = 0.04  # of the picture to the right of rupture


def fit_figure(fit: Fit, *, title: str = "", subtitle: str = "") -> Figure:
    """Draw a fit: the force against the separation as measured, and the residuals beneath.

    Parameters
    ----------
    fit : Fit
        From `pendular.fit`.
    title, subtitle : str
        Two lines above the picture.

    Returns
    -------
    matplotlib.figure.Figure
        Tied to no window.
    """
    from matplotlib.figure import Figure

    above = head_height(title, subtitle)
    height = above + _ROW * math.ceil(len(fit.free) / _IN_A_ROW) + _CURVE + _RESIDUALS
    drawing = Figure(figsize=(_WIDTH, height), facecolor="white")
    upper = drawing.add_axes((0.135, (_RESIDUALS + 0.05) / height, 0.84, (_CURVE - 0.25) / height))
    lower = drawing.add_axes((0.135, 0.45 / height, 0.84, (_RESIDUALS - 0.55) / height), sharex=upper)
    write_head(drawing, title, subtitle)
    length = scale_of(float(np.max(np.abs(fit.separation))), "m")
    strength = scale_of(float(np.max(np.abs(fit.force))), "N")
    _draw_curve(upper, fit, length, strength)
    _draw_residuals(lower, fit, length)
    _write_numbers(drawing, fit, above)
    upper.tick_params(labelbottom=False)
    lower.set_xlabel(f"separation as measured ({length.unit})", color=FAINT)
    return drawing


def _frame(axes: Axes) -> None:
    dress(axes)
    axes.axhline(0.0, color=HAIR, lw=0.6, zorder=1)


def _draw_curve(axes: Axes, fit: Fit, length: Scale, strength: Scale) -> None:
    """Points with their errors, and the line up to its rupture."""
    _frame(axes)
    x, y = fit.separation * length.factor, fit.force * strength.factor
    error = fit.force_error * strength.factor
    style: dict[str, Any] = {
        "fmt": "o",
        "ms": 3.5,
        "mfc": "white",
        "mec": INK,
        "mew": 0.8,
        "ecolor": HAIR,
        "elinewidth": 0.8,
    }
    axes.errorbar(x, y, error, label="measured", zorder=3, **style)
    end = fit.rupture_separation
    last = end if math.isfinite(end) else float(fit.separation.max())
    way = np.linspace(1.0, _BEFORE_RUPTURE, _FINE) ** 2  # dense towards rupture, where the force falls fastest
    places = last - (last - float(fit.separation.min())) * way
    if "evaporation_rate" in fit.values:
        order = np.argsort(fit.separation)
        axes.plot(x[order], fit.fitted[order] * strength.factor, color=LIQUID_EDGE, lw=2.0, label="fitted", zorder=4)
    else:
        line = fit.predicted(places) * strength.factor
        axes.plot(places * length.factor, line, color=LIQUID_EDGE, lw=2.0, label="fitted", zorder=4)
        if math.isfinite(end):
            axes.plot(
                end * length.factor,
                line[-1],
                "o",
                ms=6.5,
                mfc="white",
                mec=ACCENT,
                mew=1.8,
                zorder=5,
                label="its rupture",
            )
    if fit.measured_rupture is not None:
        place, width = (part * length.factor for part in fit.measured_rupture)
        broken = fit.separation > fit.measured_rupture[0]
        axes.plot(x[broken], fit.fitted[broken] * strength.factor, color=LIQUID_EDGE, lw=2.0, zorder=4)
        axes.axvspan(place - width, place + width, color=LIQUID, alpha=0.6, lw=0, zorder=0, label="rupture as measured")
    axes.set_ylabel(f"force ({strength.unit})", color=FAINT)
    axes.locator_params(nbins=6)
    axes.margins(x=_BEYOND)
    axes.legend(frameon=False, fontsize=9, loc="best", labelcolor=INK)


def _draw_residuals(axes: Axes, fit: Fit, length: Scale) -> None:
    """What is left, in units of its error."""
    _frame(axes)
    left = fit.residuals / fit.force_error
    axes.axhspan(-1.0, 1.0, color=LIQUID, alpha=0.35, lw=0, zorder=0)
    axes.plot(fit.separation * length.factor, left, "o", ms=3.0, mfc="white", mec=INK, mew=0.8, zorder=3)
    most = 1.15 * max(float(np.max(np.abs(left))), 2.0)
    axes.set_ylim(-most, most)
    axes.set_ylabel("residual / error", color=FAINT)


def _write_numbers(drawing: Figure, fit: Fit, top: float) -> None:
    """The values with their errors, side by side above the curve, from a distance to the upper edge, [in]."""
    height = drawing.get_figheight()
    for i, name in enumerate(fit.free):
        value, error = value_words(fit, name)
        row, column = divmod(i, _IN_A_ROW)
        x, y = 0.03 + column / _IN_A_ROW, top + _ROW * row
        drawing.text(x, 1.0 - y / height, name.replace("_", " "), size=9, color=FAINT, va="top")
        drawing.text(x, 1.0 - (y + 0.17) / height, value, size=10.5, weight="bold", color=INK, va="top")
        drawing.text(x, 1.0 - (y + 0.37) / height, error, size=9, color=FAINT, va="top")
