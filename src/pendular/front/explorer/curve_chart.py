"""A quantity against the separation: both branches, rupture, the present state, and laws laid over the force."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...ask.face import Bridge
from ...ground.colours import ACCENT, FAINT, HAIR, INK, LIQUID_EDGE
from ...ground.units import Scale, scale_of, show
from ...show.text import UNITS
from .answer import Answer

__all__ = ["curve_chart", "law_style"]

Floats = NDArray[np.float64]

# One colour and dash for each law, by its place in the registry; told apart without colours as well.
_LAW_COLOURS = ("#b07d00", "#5b4a91", "#2f7d5b", "#a23b72", "#5c5c5c", "#7a4a2b")
_LAW_DASHES = ("solid", "dot", "dashdot", "longdash")

_FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif"
_ROOM = 0.36  # right of the rupture point for its label, over the rupture distance
_OUTER = 0.04  # of the states at either end are left out of the range of what grows without bound at rupture


def law_style(place: int) -> tuple[str, str]:
    """Colour and dash of the law at a place of the registry."""
    count = len(_LAW_COLOURS)
    return _LAW_COLOURS[place % count], _LAW_DASHES[(place + place // count) % len(_LAW_DASHES)]


def curve_chart(answer: Answer, places: dict[str, int]) -> dict[str, Any]:
    """Figure for Plotly.

    Parameters
    ----------
    answer : Answer
        With the quantity to draw in its view.
    places : dict
        Place of each law in the registry, for its colour.
    """
    name = answer.view.plot
    if not answer.rupture.exists:
        return _empty("no bridge between solids apart")
    values = np.asarray(getattr(answer.curve, name))
    gap = scale_of(max(float(np.nanmax(answer.curve.separation)), abs(answer.separation)), "m")
    low, high = _range(name, values)
    if name == "force" and not answer.state.exists:
        low, high = min(low, 0.0), max(high, 0.0)
    if answer.state.exists and answer.separation < 0.0:  # before the curve begins
        here = float(getattr(answer.state, name))
        low, high = min(low, here), max(high, here)
    scale = scale_of(max(abs(low), abs(high)), UNITS[name])
    lines = _branches(answer.curve, values, gap, scale)
    if name == "force":
        lines += _laws(answer, gap, scale, places)
    marks = _marks(answer, name, gap, scale)
    reach = float(answer.rupture.separation) * gap.factor
    furthest = max(reach, (answer.separation - 0.2 * float(answer.rupture.separation)) * gap.factor)
    layout = _layout(f"separation ({gap.unit})", f"{name.replace('_', ' ')} ({scale.unit})")
    layout["xaxis"]["range"] = [min(0.0, 1.05 * answer.separation * gap.factor), furthest + _ROOM * reach]
    layout["yaxis"]["range"] = _with_room(low * scale.factor, high * scale.factor)
    layout["annotations"] = _words(answer, name, values, gap, scale)
    return {"data": lines + marks, "layout": layout, "config": {"displayModeBar": False}}


def _range(name: str, values: Floats) -> tuple[float, float]:
    """Lowest and highest value to be seen, zero among them."""
    if name == "stiffness":  # infinite at the fold
        low, high = np.nanpercentile(values[np.isfinite(values)], [100.0 * _OUTER, 100.0 * (1.0 - 3.0 * _OUTER)])
    else:
        low, high = np.nanmin(values), np.nanmax(values)
    return min(0.0, float(low)), max(0.0, float(high))


def _with_room(low: float, high: float) -> list[float]:
    room = 0.06 * (high - low) or 1.0
    return [low - (room if low < 0.0 else 0.0), high + room]


def _branches(curve: Bridge, values: Floats, gap: Scale, scale: Scale) -> list[dict[str, Any]]:
    x, y = np.asarray(curve.separation) * gap.factor, values * scale.factor
    stable = np.asarray(curve.stable)
    unstable = ~stable
    unstable[1:] |= ~stable[:-1]  # so that the dashes begin where the line ends
    unstable[:-1] |= ~stable[1:]
    hover = f"%{{x:.4g}} {gap.unit}, %{{y:.4g}} {scale.unit}"
    shared = {"mode": "lines", "x": x, "showlegend": False}
    return [
        {
            **shared,
            "y": np.where(unstable, y, np.nan),
            "line": {"color": LIQUID_EDGE, "width": 1.6, "dash": "5px,3px"},
            "hovertemplate": f"unstable: {hover}<extra></extra>",
        },
        {
            **shared,
            "y": np.where(stable, y, np.nan),
            "line": {"color": LIQUID_EDGE, "width": 2.6},
            "hovertemplate": f"stable: {hover}<extra></extra>",
        },
    ]


def _laws(answer: Answer, gap: Scale, scale: Scale, places: dict[str, int]) -> list[dict[str, Any]]:
    lines = []
    for one in answer.laws:
        if not np.isfinite(one.force).any():
            continue
        colour, dash = law_style(places[one.law.name])
        lines.append(
            {
                "mode": "lines",
                "name": one.law.name,
                "x": one.separation * gap.factor,
                "y": one.force * scale.factor,
                "line": {"color": colour, "width": 1.7, "dash": dash},
                "hovertemplate": f"{one.law.name}: %{{x:.4g}} {gap.unit}, %{{y:.4g}} {scale.unit}<extra></extra>",
            }
        )
    return lines


def _marks(answer: Answer, name: str, gap: Scale, scale: Scale) -> list[dict[str, Any]]:
    """Points of their own: rupture, a lower end of the stable bridges, and the present state."""
    marks = [(answer.rupture, "rupture", {"color": "white", "size": 8, "line": {"color": ACCENT, "width": 2}})]
    if answer.lower_end is not None:
        marks.append(
            (answer.lower_end, "begins at", {"color": "white", "size": 8, "line": {"color": LIQUID_EDGE, "width": 2}})
        )
    now = {"color": INK, "size": 11, "line": {"color": "white", "width": 1.5}}
    points = [(float(state.separation), float(getattr(state, name)), words, style) for state, words, style in marks]
    height = float(getattr(answer.state, name))
    if name == "force" or answer.state.exists:
        points.append((answer.separation, height, "now", now))
    return [
        {
            "mode": "markers",
            "x": [x * gap.factor],
            "y": [y * scale.factor],
            "marker": style,
            "showlegend": False,
            "cliponaxis": False,
            "hovertemplate": f"{words}: %{{x:.4g}} {gap.unit}, %{{y:.4g}} {scale.unit}<extra></extra>",
        }
        for x, y, words, style in points
        if np.isfinite(y)
    ]


def _words(answer: Answer, name: str, values: Floats, gap: Scale, scale: Scale) -> list[dict[str, Any]]:
    """Name of the rupture point, and of the two branches."""
    end = answer.rupture
    height = float(getattr(end, name))
    found = []
    if np.isfinite(height):
        text = f"rupture<br>{show(float(end.separation), 'm', 4)}"
        found.append(_note(float(end.separation) * gap.factor, height * scale.factor, text, ACCENT))
    return found


def _note(x: float, y: float, text: str, colour: str) -> dict[str, Any]:
    return {
        "x": x,
        "y": y,
        "text": text,
        "showarrow": False,
        "font": {"color": colour, "size": 12},
        "bgcolor": "rgba(255,255,255,0.75)",  # where the line of a law passes
        "align": "left",
        "xanchor": "left",
        "yanchor": "bottom",
        "xshift": 9,
        "yshift": -8,
    }


def _empty(text: str) -> dict[str, Any]:
    layout = _layout("", "")
    layout["xaxis"]["visible"] = layout["yaxis"]["visible"] = False
    layout["annotations"] = [
        {"text": text, "showarrow": False, "font": {"color": FAINT, "size": 14}, "xref": "paper", "yref": "paper"}
    ]
    return {"data": [], "layout": layout, "config": {"displayModeBar": False}}


def _layout(x: str, y: str) -> dict[str, Any]:
    axis = {
        "showgrid": False,
        "zeroline": False,
        "linecolor": HAIR,
        "ticks": "outside",
        "ticklen": 4,
        "tickcolor": HAIR,
        "tickfont": {"color": FAINT, "size": 12},
        "fixedrange": True,
        "nticks": 7,
        "ticklabeloverflow": "allow",  # to look for overflow costs a fifth of the time of drawing
    }
    return {
        "xaxis": {**axis, "title": {"text": x, "font": {"color": FAINT, "size": 13}, "standoff": 8}},
        "yaxis": {
            **axis,
            "title": {"text": y, "font": {"color": FAINT, "size": 13}, "standoff": 8},
            "zeroline": True,
            "zerolinecolor": HAIR,
            "zerolinewidth": 1,
        },
        "font": {"family": _FONT, "color": INK},
        "margin": {"l": 56, "r": 6, "t": 10, "b": 48},
        "hovermode": "closest",
        "dragmode": False,
        "showlegend": True,
        "legend": {"x": 1, "xanchor": "right", "y": 1, "bgcolor": "rgba(255,255,255,0.8)", "font": {"size": 12}},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
    }
