"""The numbers of a fit as people read them: angles in degrees, an error to two digits, its value to the same."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..ground.units import scale_of
from .rules import UNITS

if TYPE_CHECKING:
    from rich.console import RenderableType

    from .controls import Controls
    from .result import Fit

__all__ = ["controls_table", "fit_table", "value_words"]


def value_words(fit: Fit, name: str) -> tuple[str, str]:
    """Value and error of a free number, as texts with their units.

    Examples
    --------
    >>> _rounded(0.50213, 0.0123, 57.29578, "°")
    ('28.77°', '± 0.70°')
    """
    value, error = fit.values[name], fit.errors[name]
    if name.startswith("contact_angle"):
        factor, unit = 180.0 / math.pi, "°"
    elif not UNITS[name]:
        factor, unit = 1.0, ""
    else:
        size = max(abs(value), error if math.isfinite(error) else 0.0)
        factor, unit = _scale(size, UNITS[name])
    if name in fit.upper:
        places = max(1 - math.floor(math.log10(factor * fit.upper[name])), 0)
        return f"{factor * value:.{places}f}{unit}", f"below {factor * fit.upper[name]:.{places}f}{unit} (95 %)"
    return _rounded(value, error, factor, unit)


def _scale(size: float, unit: str) -> tuple[float, str]:
    base, slash, rest = unit.partition("/")
    if slash and rest == "s":
        found = scale_of(size, base)
        return found.factor, f" {found.unit}/s"
    found = scale_of(size, unit)
    return found.factor, f" {found.unit}"


def _rounded(value: float, error: float, factor: float, unit: str) -> tuple[str, str]:
    """Value and error to the second digit of the error."""
    if not math.isfinite(error):
        return f"{factor * value:.4g}{unit}", "not fixed by these data"
    if error == 0.0:
        return f"{factor * value:.6g}{unit}", f"± 0{unit}"
    places = 1 - math.floor(math.log10(factor * error))
    if places > 12:
        return f"{factor * value:.12g}{unit}", f"± {factor * error:.2g}{unit}"
    if places < 0:
        return f"{round(factor * value, places):.0f}{unit}", f"± {round(factor * error, places):.0f}{unit}"
    return f"{factor * value:.{places}f}{unit}", f"± {factor * error:.{places}f}{unit}"


def fit_table(fit: Fit) -> RenderableType:
    """Table of the numbers found, how well the curve is met, and what one has to know, for people."""
    from rich.console import Group
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), show_header=False)
    table.add_column(style="bold", no_wrap=True)
    table.add_column(no_wrap=True, justify="right")
    table.add_column(no_wrap=True)
    for name in fit.free:
        table.add_row(name.replace("_", " "), *value_words(fit, name))
    table.add_row("", "", "")
    if math.isfinite(fit.rupture_separation):
        factor, unit = _scale(fit.rupture_separation, "m")
        measured = ""
        if fit.measured_rupture is not None:
            place, error = (factor * part for part in fit.measured_rupture)
            measured = f"measured {place:.4g} ± {error:.2g}{unit}"
        table.add_row("rupture", f"{factor * fit.rupture_separation:.4g}{unit}", measured)
    factor, unit = _scale(fit.rms, "N")
    largest = float(abs(fit.force).max())
    table.add_row(
        "residuals, rms", f"{factor * fit.rms:.3g}{unit}", f"{100.0 * fit.rms / largest:.2g} % of the largest force"
    )
    pairs = [
        f"{fit.free[i]} and {fit.free[j]} {fit.correlation[i, j]:+.3f}".replace("_", " ")
        for i in range(len(fit.free))
        for j in range(i)
        if math.isfinite(fit.correlation[i, j])
    ]
    lines = [f"{fit.force.size} points, {fit.degrees_of_freedom} degrees of freedom, chi² {fit.chi_square:.4g}"]
    if pairs:
        lines.append(f"correlation: {'; '.join(pairs)}")
    return Group(table, "", *lines, *(f"note: {note}" for note in fit.notes))


def controls_table(found: Controls) -> RenderableType:
    """Both controls side by side."""
    from rich.console import Group

    parts: list[RenderableType] = []
    for name, fit in (("volume", found.volume), ("suction", found.suction)):
        parts += [f"constant {name}", fit_table(fit), ""]
    return Group(*parts, found.told)
