"""Pictures: a pair of solids to scale with its bridge, and the force curve to which the bridge belongs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ask.face import Bridge, Pair
from ..ground.colours import ACCENT, FAINT, GRAIN, GRAIN_EDGE, HAIR, INK, LIQUID, LIQUID_EDGE
from ..ground.files import whole
from ..ground.look import dress
from ..ground.units import Scale, scale_of, show
from .scene import ASPECT, Scene, Window, far_window, mirrored, near_window, outlines_of, round_length, scene_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["FORMATS", "draw_curve", "draw_pair", "figure", "save"]

FORMATS = (".svg", ".png", ".pdf")

Floats = NDArray[np.float64]
Point = tuple[float, float]


class _Layout(NamedTuple):
    """Where things stand in a picture, in parts of it."""

    size: Point  # in
    pair: Point  # lower left corner
    pair_height: float
    curve: tuple[float, float, float, float]  # lower left corner, width and height
    words: Point  # height of title and subtitle
    title_size: float  # pt


_BESIDE = _Layout((9.6, 4.1), (0.02, 0.04), 0.8, (0.56, 0.14, 0.42, 0.7), (0.95, 0.89), 12.0)
_STACKED = _Layout((5.0, 7.5), (0.03, 0.454), 0.468, (0.115, 0.075, 0.855, 0.35), (0.975, 0.945), 9.5)

# Where a label may stand beside its point, the best first, and how it is aligned there.
_PLACES = ((1, 0), (1, 1), (-1, 1), (1, -1), (-1, -1), (-1, 0))
_SIDES = {1: "bottom", 0: "center", -1: "top"}


def figure(
    pair: Pair,
    bridge: Bridge | None,
    curve: Bridge,
    rupture: Bridge,
    *,
    separation: float = 0.0,
    lower_end: Bridge | None = None,
    title: str = "",
    subtitle: str = "",
    stacked: bool = False,
) -> Figure:
    """Draw a pair with its bridge, to scale, beside the force curve.

    Parameters
    ----------
    pair : Pair
        One pair: its radii and angles are single numbers.
    bridge : Bridge or None
        The present state, which need not exist; without one the pair is drawn as it ruptures.
    curve : Bridge
        All states at the same control, from `pendular.curve`.
    rupture : Bridge
        From `pendular.rupture`, at the fold.
    separation : float
        At which the present state was asked for, [m].
    lower_end : Bridge, optional
        Where the stable bridges begin, if that is not at contact.
    title, subtitle : str
        Two lines above the picture.
    stacked : bool
        Whether the pair stands above the curve, as fits a phone or one column of a journal.

    Returns
    -------
    matplotlib.figure.Figure
        Tied to no window; see `save`.

    Examples
    --------
    >>> import pendular as pl
    >>> grains, water = pl.Pair(radius=50e-6, contact_angle=0.35), pl.Liquid(surface_tension=0.0728)
    >>> held = {"suction": 20e3, "liquid": water}
    >>> now, all_states, end = pl.bridge(grains, 1e-6, **held), pl.curve(grains, **held), pl.rupture(grains, **held)
    >>> picture = figure(grains, now, all_states, end, separation=1e-6)
    >>> [axes.get_xlabel() for axes in picture.axes]
    ['', 'separation (µm)']
    """
    from matplotlib.figure import Figure

    layout = _STACKED if stacked else _BESIDE
    width, height = layout.size
    drawing = Figure(figsize=layout.size, facecolor="white")
    of_pair = drawing.add_axes((*layout.pair, layout.pair_height * ASPECT * height / width, layout.pair_height))
    of_curve = drawing.add_axes(layout.curve)
    drawing.text(layout.pair[0], layout.words[0], title, size=layout.title_size, weight="bold", color=INK, va="center")
    drawing.text(layout.pair[0], layout.words[1], subtitle, size=9, color=FAINT, va="center")
    if bridge is not None:
        draw_pair(of_pair, pair, bridge, separation)
    else:
        draw_pair(of_pair, pair, rupture, float(rupture.separation) if rupture.exists else 0.0)
    draw_curve(of_curve, curve, rupture, bridge, separation=separation, lower_end=lower_end)
    return drawing


def save(drawing: Figure, path: Path) -> None:
    """Write a figure in the format of the path's suffix; the same figure gives the same bytes.

    Parameters
    ----------
    drawing : matplotlib.figure.Figure
        From `figure`.
    path : Path
        Ending in one of `FORMATS`.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    import matplotlib

    form = path.suffix.lower().removeprefix(".")
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}
    with matplotlib.rc_context({"svg.hashsalt": "pendular"}), whole(path) as draft:
        drawing.savefig(draft, format=form, dpi=200, metadata=undated.get(form))


def draw_pair(axes: Axes, pair: Pair, bridge: Bridge, separation: float) -> None:
    """Draw two solids to scale, as near as the bridge between them asks for; a small card shows them from afar.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw; its frame and ticks vanish.
    pair : Pair
        The solids.
    bridge : Bridge
        The bridge, of single numbers; where it does not exist the solids stand alone.
    separation : float
        Of the solids, [m].
    """
    scene = scene_of(pair, bridge, separation)
    overview = far_window(scene)
    window = near_window(scene, overview) if scene.x.size else overview
    _draw_scene(axes, scene, window)
    _draw_scale(axes, window)
    (_draw_measures if window.shows_axis else _tell_distance)(axes, scene, window)
    if window is not overview:
        _draw_card(axes, scene, overview, window)


def _draw_scene(axes: Axes, scene: Scene, window: Window, line_width: float = 1.0) -> None:
    """Solids, liquid and meniscus in a window."""
    axes.set(xlim=(-ASPECT, ASPECT), ylim=(-1.0, 1.0), xticks=[], yticks=[], aspect="equal")
    axes.spines[:].set_visible(False)
    axes.fill(*window.place(*mirrored(scene.x, scene.y)), color=LIQUID, lw=0, zorder=1)
    for outline in outlines_of(scene, window):
        axes.fill(*window.place(*outline), facecolor=GRAIN, edgecolor=GRAIN_EDGE, lw=line_width, zorder=2)
    for side in (1.0, -1.0):
        meniscus = window.place(scene.x, side * scene.y)
        axes.plot(*meniscus, color=LIQUID_EDGE, lw=2.0 * line_width, solid_capstyle="round", zorder=4)


def _draw_measures(axes: Axes, scene: Scene, window: Window) -> None:
    """Axis of symmetry, contact circles seen from the side, and the gap between the poles."""
    beyond = 2.0 * window.half_height
    axis = window.place(np.array([-beyond, beyond]), np.zeros(2))
    axes.plot(*axis, color=HAIR, lw=0.7, ls=(0, (12, 3, 2, 3)), zorder=3)
    for end in (0, -1) if scene.x.size else ():
        circle = window.place(np.full(2, scene.x[end]), np.array([-scene.y[end], scene.y[end]]))
        axes.plot(*circle, color=LIQUID_EDGE, lw=0.8, ls=(0, (4, 3)), zorder=3)
    far = (-0.5 if window.upright else -0.8) * window.half_height * window.reach[1]
    for pole in (0.0, scene.gap):
        axes.plot(*window.place(np.full(2, pole), np.array([0.0, far])), color=INK, lw=0.6, zorder=5)
    u, v = (float(c) for c in window.place(0.5 * scene.gap, 1.03 * far))
    sides = ("right", "center") if window.upright else ("center", "top")
    axes.text(u, v, _gap_label(scene), size=9, color=INK, ha=sides[0], va=sides[1], zorder=6)


def _tell_distance(axes: Axes, scene: Scene, window: Window) -> None:
    """In words, how far away the axis is that lies out of sight, and the gap on it."""
    arrow = {"arrowstyle": "-|>", "color": INK, "lw": 0.9}
    towards = (-1.22, 0.0) if window.upright else (0.0, -0.93)
    axes.annotate("", towards, (0.7 * towards[0], 0.7 * towards[1]), arrowprops=arrow, zorder=6)
    label = f"axis {_number(float(scene.y.min()), 'm')} away\n{_gap_label(scene)} there"
    axes.text(1.27, -0.93, label, size=9, color=INK, ha="right", va="bottom", linespacing=1.5, zorder=6)


def _gap_label(scene: Scene) -> str:
    return f"$D$ = {_number(scene.gap, 'm')}"


def _draw_scale(axes: Axes, window: Window) -> None:
    """Bar of a round length, about a fifth of the width."""
    length = round_length(window)
    start, level = 0.07 - ASPECT, -0.93
    end = start + length / window.half_height
    axes.plot([start, end], [level, level], color=INK, lw=2.0, solid_capstyle="butt", zorder=6)
    place = (0.5 * (start + end), level + 0.04)
    axes.text(*place, show(length, "m"), size=9, color=INK, ha="center", va="bottom", zorder=6)


def _draw_card(axes: Axes, scene: Scene, overview: Window, window: Window) -> None:
    """Small picture of the whole pair in the corner that is deepest inside a solid, with the window marked in it."""
    from matplotlib.patches import Rectangle

    size, inset = 0.27, 0.025
    near, far = inset, 1.0 - size - inset
    if window.upright:
        corner = (far, near if window.shows_axis else far)
    else:
        corner = (near if scene.radii[0] >= scene.radii[1] else far, far)
    card = axes.inset_axes((*corner, size, size))
    _draw_scene(card, scene, overview, line_width=0.5)
    card.spines[:].set(visible=True, color=GRAIN_EDGE, lw=0.6)
    u, v = (float(c) for c in overview.place(window.x, window.y))
    half = max(window.half_height / overview.half_height, 0.05)  # smaller than that it could not be seen
    frame = (u - ASPECT * half, v - half), 2.0 * ASPECT * half, 2.0 * half
    card.add_patch(Rectangle(*frame, fill=False, edgecolor=INK, lw=0.9, zorder=5))


def draw_curve(
    axes: Axes,
    curve: Bridge,
    rupture: Bridge,
    bridge: Bridge | None = None,
    *,
    separation: float = 0.0,
    lower_end: Bridge | None = None,
) -> None:
    """Draw force against separation: stable states as a line, unstable ones dashed; rupture and present state marked.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw.
    curve, rupture, bridge, separation, lower_end
        As for `figure`.
    """
    if not rupture.exists:
        axes.text(0.5, 0.5, "no bridge between solids apart", transform=axes.transAxes, ha="center", color=FAINT)
        axes.set_axis_off()
        return
    gap, force = _scales(curve, separation)
    x, y = np.asarray(curve.separation) * gap.factor, np.asarray(curve.force) * force.factor
    stable = np.asarray(curve.stable)
    now = separation * gap.factor, 0.0 if bridge is None else float(bridge.force) * force.factor
    _frame(axes, np.append(x, now[0]), np.append(y, now[1]))
    axes.set_xlabel(f"separation ({gap.unit})", color=FAINT)
    axes.set_ylabel(f"force{', attraction positive' if y.min() < 0.0 else ''} ({force.unit})", color=FAINT)
    _draw_branches(axes, x, y, stable)

    taken = [axes.transData.transform(_dense(x, y))]

    def mark(state: Bridge, text: str, colour: str) -> None:
        place = float(state.separation) * gap.factor, float(state.force) * force.factor
        axes.plot(*place, "o", ms=6.5, mfc="white", mec=colour, mew=1.8, zorder=5)
        _label(axes, f"{text}{_number(float(state.separation), 'm')}", place, taken, color=colour)

    mark(rupture, "rupture\n", ACCENT)
    if bridge is not None:
        axes.plot(*now, "o", ms=7.5, mfc=INK, mec="white", mew=1.2, zorder=6)
        state = _number(float(bridge.force), "N") if bridge.exists else "no bridge"
        _label(axes, f"{state} at {_number(separation, 'm')}", now, taken, color=INK, weight="bold")
    if lower_end is not None:
        mark(lower_end, "begins at ", LIQUID_EDGE)
    fold = int(np.argmax(x))
    for name, run in (("stable", np.flatnonzero(stable[:fold])), ("unstable", np.arange(fold, x.size))):
        if run.size:
            _label(axes, name, _halfway(axes, x[run], y[run]), taken, color=LIQUID_EDGE, style="italic")


def _scales(curve: Bridge, separation: float) -> tuple[Scale, Scale]:
    """Units of the two axes."""
    longest = max(float(np.max(curve.separation)), abs(separation))
    return scale_of(longest, "m"), scale_of(float(np.max(np.abs(curve.force))), "N")


def _frame(axes: Axes, x: Floats, y: Floats) -> None:
    """Limits around the curve and the zeros, with room for labels on the right."""
    left, right, low, high = min(0.0, x.min()), x.max(), min(0.0, y.min()), max(0.0, y.max())
    dress(axes)
    axes.locator_params(nbins=6)
    axes.set_xlim(1.08 * left, right + 0.28 * (right - left))
    axes.set_ylim(low - 0.04 * (high - low), high + 0.08 * (high - low))
    if low < 0.0:
        axes.axhline(0.0, color=HAIR, lw=0.6, zorder=1)


def _draw_branches(axes: Axes, x: Floats, y: Floats, stable: NDArray[np.bool_]) -> None:
    axes.plot(x, np.where(stable, y, np.nan), color=LIQUID_EDGE, lw=2.2, solid_capstyle="round", zorder=3)
    unstable = ~stable
    unstable[1:] |= ~stable[:-1]  # so that the dashes begin where the line ends
    unstable[:-1] |= ~stable[1:]
    axes.plot(x, np.where(unstable, y, np.nan), color=LIQUID_EDGE, lw=1.4, ls=(0, (4, 2.2)), zorder=3)


def _dense(x: Floats, y: Floats) -> NDArray[np.float64]:
    """Points of a line, close enough for a label not to slip between them."""
    fine = np.linspace(0.0, x.size - 1.0, 20 * x.size)
    return np.column_stack([np.interp(fine, np.arange(x.size), c) for c in (x, y)])


def _halfway(axes: Axes, x: Floats, y: Floats) -> Point:
    """Point in the middle of a line, as it is seen."""
    steps = np.diff(axes.transData.transform(np.column_stack([x, y])), axis=0)
    way = np.concatenate([[0.0], np.cumsum(np.hypot(*steps.T))])
    middle = int(np.searchsorted(way, 0.5 * way[-1]))
    return float(x[middle]), float(y[middle])


def _label(axes: Axes, text: str, point: Point, taken: list[Floats], **style: Any) -> None:
    """Write beside a point, on the side where it hides least of what is taken; then its own place is taken too."""
    frame = axes.get_window_extent()
    written = axes.annotate(text, point, (0, 0), textcoords="offset points", size=9.5, zorder=7, **style)

    def cost_beside(across: int, up: int) -> int:
        written.set(position=(9 * across, 7 * up), ha="left" if across > 0 else "right", va=_SIDES[up])
        box = written.get_window_extent()
        outside = int(box.x0 < frame.x0 or box.x1 > frame.x1 + 20 or box.y0 < frame.y0 or box.y1 > frame.y1)
        hidden = sum(int(box.padded(3.0).count_contains(places)) for places in taken)
        return hidden + 1000 * outside

    best = min(_PLACES, key=lambda place: cost_beside(*place))
    cost_beside(*best)
    box = written.get_window_extent()
    u, v = np.meshgrid(np.linspace(box.x0, box.x1, 20), np.linspace(box.y0, box.y1, 5))
    taken.append(np.column_stack([u.ravel(), v.ravel()]))


def _number(value: float, unit: str) -> str:
    """Quantity as text in a picture, with a minus sign of the length of a plus."""
    return show(value, unit, 4).replace("-", "\N{MINUS SIGN}")
