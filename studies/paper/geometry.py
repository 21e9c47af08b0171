"""Fig. 1: the geometry of a bridge between two unequal spheres, from an exact bridge, with its symbols."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc

from pendular.ground.colours import ACCENT, GRAIN, GRAIN_EDGE, HAIR, INK, LIQUID

from . import sample
from .style import COLOURS

_RATIO, _DEGREES, _VOLUME, _GAP = 1.35, 20.0, 0.35, 0.42
Point = tuple[float, float]


def geometry() -> Figure:
    """Fig. 1: the larger sphere on the left, the neck at X = 0."""
    states = sample.state(_GAP, _DEGREES, _RATIO, volume=_VOLUME)
    shape = states.profile(201)
    neck = int(np.argmin(shape.y))
    x, y = shape.x[neck] - shape.x, shape.y  # mirrored: the smaller sphere comes first
    small, large = (float(radius) for radius in sample.radii_of(_RATIO))
    gap_s, gap_l = float(shape.x[neck]), float(_GAP - shape.x[neck])

    figure = Figure(figsize=(9.0, 5.0), facecolor="white", layout="constrained")
    axes = figure.subplots()
    axes.set(aspect="equal", xlim=(-2.4, 2.0), ylim=(-1.08, 1.2))
    axes.set_axis_off()
    axes.fill(np.append(x, x[::-1]), np.append(y, -y[::-1]), color=LIQUID, lw=0)
    for side, radius, gap, filling, name in (
        (1.0, small, gap_s, states.half_filling_angle[0], "s"),
        (-1.0, large, gap_l, states.half_filling_angle[1], "L"),
    ):
        _sphere(axes, side, radius, gap, float(filling), name)
    for sign in (1.0, -1.0):
        axes.plot(x, sign * y, color=COLOURS[0], lw=2.2, zorder=4)
    _axes_of_coordinates(axes)
    _arrow(axes, (0.0, 0.0), (0.0, float(y[neck])), "$Y_0$", (6, 0))
    axes.annotate(
        "$Y(X)$",
        (float(x[120]), float(y[120])),
        (float(x[120]) - 0.05, 0.93),
        size=11,
        color=COLOURS[0],
        ha="center",
        arrowprops={"arrowstyle": "-", "color": COLOURS[0], "lw": 0.6},
    )
    for left, right, level, text in (
        (-gap_l, 0.0, -0.8, "$S_L$"),
        (0.0, gap_s, -0.8, "$S_s$"),
        (-gap_l, gap_s, -0.93, "$2S$"),
    ):
        _width(axes, left, right, level, text)
    return figure


def _sphere(axes: Axes, side: float, radius: float, gap: float, filling: float, name: str) -> None:
    """One sphere with its centre, radius, half-filling angle, contact circle and contact angle."""
    turn = np.linspace(0.0, 2.0 * np.pi, 361)
    centre = side * (gap + radius)
    axes.fill(centre + radius * np.cos(turn), radius * np.sin(turn), fc=GRAIN, ec=GRAIN_EDGE, lw=1.0, zorder=2)
    contact = (centre - side * radius * np.cos(filling), radius * np.sin(filling))
    _arrow(axes, (centre, 0.0), contact, "", (0, 0))
    middle = (0.5 * (centre + contact[0]), 0.5 * contact[1])
    axes.annotate(f"$R_{name}$", middle, (side * 8, 8), textcoords="offset points", size=11, color=INK, ha="center")
    axes.plot([contact[0]] * 2, [-contact[1], contact[1]], color=COLOURS[0], lw=0.8, ls=(0, (4, 3)), zorder=3)
    axes.plot(*contact, "o", ms=4.5, color=COLOURS[0], zorder=6)
    axes.annotate(
        f"$(X_{{c{name}}},\\,Y_{{c{name}}})$",
        contact,
        (side * 46, 30),
        textcoords="offset points",
        size=11,
        color=INK,
        ha="center",
        arrowprops={"arrowstyle": "-", "color": HAIR, "lw": 0.6},
    )
    _angle(axes, (centre, 0.0), 0.5 * radius, 180.0 if side > 0.0 else 0.0, -side * np.degrees(filling), INK)
    axes.text(
        centre - side * 0.6 * radius * np.cos(0.5 * filling),
        0.6 * radius * np.sin(0.5 * filling),
        f"$\\delta_{name}$",
        size=11,
        color=INK,
        ha="center",
        va="center",
        zorder=6,
    )
    _contact_angle(axes, contact, side, np.degrees(filling))


def _contact_angle(axes: Axes, contact: Point, side: float, filling: float) -> None:
    """Tangents to the sphere and to the liquid, and the angle between them through the liquid."""
    on_sphere = 270.0 - filling if side > 0.0 else 270.0 + filling  # downwards along the sphere, where the liquid is
    on_liquid = on_sphere - side * _DEGREES
    for direction in (on_sphere, on_liquid):
        way = np.deg2rad(direction)
        axes.plot(
            [contact[0], contact[0] + 0.42 * np.cos(way)],
            [contact[1], contact[1] + 0.42 * np.sin(way)],
            color=ACCENT,
            lw=0.9,
            zorder=5,
        )
    _angle(axes, contact, 0.34, on_sphere, -side * _DEGREES, ACCENT)
    way = np.deg2rad(on_sphere - 0.5 * side * _DEGREES)
    axes.text(
        contact[0] + 0.25 * np.cos(way),
        contact[1] + 0.25 * np.sin(way),
        "$\\theta$",
        size=10,
        color=ACCENT,
        ha="center",
        va="center",
        zorder=6,
    )


def _angle(axes: Axes, centre: Point, radius: float, start: float, turn: float, colour: str) -> None:
    low, high = sorted((start, start + turn))
    axes.add_patch(Arc(centre, 2 * radius, 2 * radius, theta1=low, theta2=high, color=colour, lw=0.9, zorder=5))


def _axes_of_coordinates(axes: Axes) -> None:
    """The axis of symmetry and the radial axis through the neck."""
    arrow = {"arrowstyle": "-|>", "color": INK, "lw": 0.8}
    for end, start, name, place in (
        ((1.98, 0.0), (-2.4, 0.0), "$X$", (1.95, -0.1)),
        ((0.0, 1.2), (0.0, -1.0), "$Y$", (0.08, 1.14)),
    ):
        axes.annotate("", end, start, arrowprops=arrow, zorder=3)
        axes.text(*place, name, size=11, color=INK, ha="center")


def _arrow(axes: Axes, start: Point, end: Point, text: str, offset: Point) -> None:
    axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 0.9, "shrinkA": 0, "shrinkB": 0})
    quarter = (0.75 * start[0] + 0.25 * end[0], 0.75 * start[1] + 0.25 * end[1])
    axes.annotate(text, quarter, offset, textcoords="offset points", size=11, color=INK, va="center", zorder=6)


def _width(axes: Axes, left: float, right: float, level: float, text: str) -> None:
    """A dimension line below the spheres' facing poles."""
    for end in (left, right):
        axes.plot([end, end], [0.0, level - 0.03], color=INK, lw=0.5, zorder=5)
    arrow = {"arrowstyle": "<|-|>", "color": INK, "lw": 0.7, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 6}
    axes.annotate("", (right, level), (left, level), arrowprops=arrow, zorder=6)
    axes.text(
        0.5 * (left + right),
        level,
        text,
        size=10,
        color=INK,
        ha="center",
        va="center",
        zorder=7,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
    )
