"""Pictures: a pair of solids to scale with its bridge, and the force curve to which the bridge belongs."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .bridges import Bridge, Pair
from .units import Scale, scale_of, show

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["FORMATS", "draw_curve", "draw_pair", "figure", "save"]

FORMATS = (".svg", ".png", ".pdf")

Floats = NDArray[np.float64]
Point = tuple[float, float]

_INK, _FAINT, _HAIR = "#22303c", "#6f7b85", "#9aa4ac"
_GRAIN, _GRAIN_EDGE = "#eee9df", "#a99f8d"
_LIQUID, _LIQUID_EDGE = "#b3d4ea", "#1d6496"
_ACCENT = "#c2452d"
_SIZE = (9.6, 4.1)  # in
_ASPECT = 1.34  # width over height of the picture of the pair

# Where a label may stand beside its point, the best first, and how it is aligned there.
_PLACES = ((1, 0), (1, 1), (-1, 1), (1, -1), (-1, -1), (-1, 0))
_SIDES = {1: "bottom", 0: "center", -1: "top"}

# A meniscus that is thinner than this part of its radius would be a hairline: its edge is drawn instead.
_THINNEST = 0.05


def figure(
    pair: Pair,
    bridge: Bridge | None,
    curve: Bridge,
    rupture: Bridge,
    *,
    separation: float = 0.0,
    instability: Bridge | None = None,
    title: str = "",
    subtitle: str = "",
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
    instability : Bridge, optional
        The state at which the stable branch ends, where that comes before the fold.
    title, subtitle : str
        Two lines above the picture.

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

    drawing = Figure(figsize=_SIZE, facecolor="white")
    width, height = _SIZE
    tall = 0.8
    left = drawing.add_axes((0.02, 0.04, tall * _ASPECT * height / width, tall))
    right = drawing.add_axes((0.56, 0.14, 0.42, tall - 0.1))
    drawing.text(0.02, 0.95, title, size=12, weight="bold", color=_INK, va="center")
    drawing.text(0.02, 0.89, subtitle, size=9, color=_FAINT, va="center")
    if bridge is not None:
        draw_pair(left, pair, bridge, separation)
    else:
        draw_pair(left, pair, rupture, float(rupture.separation) if rupture.exists else 0.0)
    draw_curve(right, curve, rupture, bridge, separation=separation, instability=instability)
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

    undated = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    with matplotlib.rc_context({"svg.hashsalt": "pendular"}):
        drawing.savefig(path, dpi=200, metadata=undated.get(path.suffix.lower()))


class _Window(NamedTuple):
    """What is seen of the plane of the meridian: centre and half height, [m], and how it is turned."""

    x: float
    y: float
    half_height: float
    upright: Literal[-1, 0, 1]  # axis of the pair: 0 lies, 1 stands with the first solid below, -1 with the second

    @property
    def reach(self) -> Point:
        """Half extents along the axis of the pair and across it, in half heights."""
        return (1.0, _ASPECT) if self.upright else (_ASPECT, 1.0)

    def place(self, x: Floats | float, y: Floats | float) -> tuple[Floats, Floats]:
        """Points of the meridian plane in the picture, in half heights from its centre.

        What lies far outside is pulled to just beyond the frame: drawing libraries lose their way in coordinates
        that are a million times the picture.
        """
        along, across = (np.asarray(x) - self.x) / self.half_height, (np.asarray(y) - self.y) / self.half_height
        along = np.clip(along, -1.2 * self.reach[0], 1.2 * self.reach[0])
        across = np.clip(across, -1.2 * self.reach[1], 1.2 * self.reach[1])
        return (across, self.upright * along) if self.upright else (along, across)

    @property
    def shows_axis(self) -> bool:
        """Whether the axis of the pair is in sight."""
        return abs(self.y) < self.half_height * self.reach[1]


class _Scene(NamedTuple):
    """What is drawn, [m]: the facing poles of the solids lie at x = 0 and x = gap on the axis y = 0."""

    radii: Point
    gap: float
    x: Floats  # meridian; empty where there is no bridge
    y: Floats


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
    scene = _scene(pair, bridge, separation)
    overview = _overview(scene)
    window = _near(scene, overview) if scene.x.size else overview
    _draw_scene(axes, scene, window)
    _draw_scale(axes, window)
    (_draw_measures if window.shows_axis else _tell_distance)(axes, scene, window)
    if window is not overview:
        _draw_card(axes, scene, overview, window)


def _scene(pair: Pair, bridge: Bridge, separation: float) -> _Scene:
    first, second = pair.radii
    radii = float(first), float(second)
    if not bridge.exists:
        return _Scene(radii, separation, np.empty(0), np.empty(0))
    profile = bridge.profile(161)
    return _Scene(radii, separation, profile.x, profile.y)


def _overview(scene: _Scene) -> _Window:
    """Window on both solids; of a plane, and of a far larger sphere, on the part next to the other solid."""
    small = min(scene.radii)
    depths = [2.0 * min(radius, 2.5 * small) if math.isfinite(radius) else 0.6 * small for radius in scene.radii]
    widest = scene.y.max(initial=min(max(scene.radii), 2.0 * small))
    along, across = 0.5 * (sum(depths) + scene.gap), float(widest)
    upright = _upright(scene.radii)
    half_height = max(along, across / _ASPECT) if upright else max(across, along / _ASPECT)
    return _Window(0.5 * (scene.gap + depths[1] - depths[0]), 0.0, 1.08 * half_height, upright)


def _upright(radii: Point) -> Literal[-1, 0, 1]:
    """A plate lies below the sphere; two spheres stand side by side."""
    if math.isinf(radii[0]):
        return 1
    return -1 if math.isinf(radii[1]) else 0


def _near(scene: _Scene, overview: _Window) -> _Window:
    """Window on the bridge, or on its edge if it is too thin; the overview itself if that is near enough."""
    thickness, widest = float(np.ptp(scene.x)), float(scene.y.max())
    middle, upright = 0.5 * float(scene.x.min() + scene.x.max()), overview.upright
    if max(thickness, float(np.ptp(scene.y))) < _THINNEST * widest:
        return _Window(middle, float(scene.y.mean()), 1.6 * thickness, upright)
    # upright, the gap's label stands on one side of the bridge and the card on the other
    half_height = max((2.1 if upright else 2.2) * widest, 1.2 * thickness)
    if half_height > 0.65 * overview.half_height:
        return overview
    return _Window(middle + 0.3 * upright * half_height, 0.0, half_height, upright)  # more of the sphere than the plate


def _draw_scene(axes: Axes, scene: _Scene, window: _Window, line_width: float = 1.0) -> None:
    """Solids, liquid and meniscus in a window."""
    axes.set(xlim=(-_ASPECT, _ASPECT), ylim=(-1.0, 1.0), xticks=[], yticks=[], aspect="equal")
    axes.spines[:].set_visible(False)
    axes.fill(*window.place(*_mirrored(scene.x, scene.y)), color=_LIQUID, lw=0, zorder=1)
    for radius, pole, side in ((scene.radii[0], 0.0, -1.0), (scene.radii[1], scene.gap, 1.0)):
        outline = window.place(*_outline(radius, pole, side, window))
        axes.fill(*outline, facecolor=_GRAIN, edgecolor=_GRAIN_EDGE, lw=line_width, zorder=2)
    for side in (1.0, -1.0):
        meniscus = window.place(scene.x, side * scene.y)
        axes.plot(*meniscus, color=_LIQUID_EDGE, lw=2.0 * line_width, solid_capstyle="round", zorder=4)


def _mirrored(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Closed outline of a body of revolution from its upper half."""
    return np.concatenate([x, x[::-1]]), np.concatenate([y, -y[::-1]])


def _outline(radius: float, pole: float, side: float, window: _Window) -> tuple[Floats, Floats]:
    """Closed outline of a solid with its pole at x = ``pole`` and its body to the ``side``, fine in the window."""
    margin = 1.5 * window.half_height * window.reach[1]
    if math.isinf(radius):
        far = pole + side * 4.0 * window.half_height
        return _mirrored(np.array([pole, far]), np.full(2, window.y + margin))
    seen = np.arcsin(np.clip(np.linspace(window.y - margin, window.y + margin, 121) / radius, 0.0, 1.0))
    turn = np.union1d(np.linspace(0.0, math.pi, 91), seen)
    return _mirrored(pole + side * 2.0 * radius * np.sin(0.5 * turn) ** 2, radius * np.sin(turn))


def _draw_measures(axes: Axes, scene: _Scene, window: _Window) -> None:
    """Axis of symmetry, contact circles seen from the side, and the gap between the poles."""
    beyond = 2.0 * window.half_height
    axis = window.place(np.array([-beyond, beyond]), np.zeros(2))
    axes.plot(*axis, color=_HAIR, lw=0.7, ls=(0, (12, 3, 2, 3)), zorder=3)
    for end in (0, -1) if scene.x.size else ():
        circle = window.place(np.full(2, scene.x[end]), np.array([-scene.y[end], scene.y[end]]))
        axes.plot(*circle, color=_LIQUID_EDGE, lw=0.8, ls=(0, (4, 3)), zorder=3)
    far = (-0.5 if window.upright else -0.8) * window.half_height * window.reach[1]
    for pole in (0.0, scene.gap):
        axes.plot(*window.place(np.full(2, pole), np.array([0.0, far])), color=_INK, lw=0.6, zorder=5)
    u, v = (float(c) for c in window.place(0.5 * scene.gap, 1.03 * far))
    sides = ("right", "center") if window.upright else ("center", "top")
    axes.text(u, v, _gap_label(scene), size=9, color=_INK, ha=sides[0], va=sides[1], zorder=6)


def _tell_distance(axes: Axes, scene: _Scene, window: _Window) -> None:
    """In words, how far away the axis is that lies out of sight, and the gap on it."""
    arrow = {"arrowstyle": "-|>", "color": _INK, "lw": 0.9}
    towards = (-1.22, 0.0) if window.upright else (0.0, -0.93)
    axes.annotate("", towards, (0.7 * towards[0], 0.7 * towards[1]), arrowprops=arrow, zorder=6)
    label = f"axis {_number(float(scene.y.min()), 'm')} away\n{_gap_label(scene)} there"
    axes.text(1.27, -0.93, label, size=9, color=_INK, ha="right", va="bottom", linespacing=1.5, zorder=6)


def _gap_label(scene: _Scene) -> str:
    return f"$D$ = {_number(scene.gap, 'm')}"


def _draw_scale(axes: Axes, window: _Window) -> None:
    """Bar of a round length, about a fifth of the width."""
    wanted = 0.5 * window.half_height
    decade = 10.0 ** math.floor(math.log10(wanted))
    length = max(step * decade for step in (1.0, 2.0, 5.0) if step * decade <= wanted)
    start, level = 0.07 - _ASPECT, -0.93
    end = start + length / window.half_height
    axes.plot([start, end], [level, level], color=_INK, lw=2.0, solid_capstyle="butt", zorder=6)
    place = (0.5 * (start + end), level + 0.04)
    axes.text(*place, show(length, "m"), size=9, color=_INK, ha="center", va="bottom", zorder=6)


def _draw_card(axes: Axes, scene: _Scene, overview: _Window, window: _Window) -> None:
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
    card.spines[:].set(visible=True, color=_GRAIN_EDGE, lw=0.6)
    u, v = (float(c) for c in overview.place(window.x, window.y))
    half = max(window.half_height / overview.half_height, 0.05)  # smaller than that it could not be seen
    frame = (u - _ASPECT * half, v - half), 2.0 * _ASPECT * half, 2.0 * half
    card.add_patch(Rectangle(*frame, fill=False, edgecolor=_INK, lw=0.9, zorder=5))


def draw_curve(
    axes: Axes,
    curve: Bridge,
    rupture: Bridge,
    bridge: Bridge | None = None,
    *,
    separation: float = 0.0,
    instability: Bridge | None = None,
) -> None:
    """Draw force against separation: stable states as a line, unstable ones dashed; rupture and present state marked.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
        Where to draw.
    curve, rupture, bridge, separation, instability
        As for `figure`.
    """
    if not rupture.exists:
        axes.text(0.5, 0.5, "no bridge between solids apart", transform=axes.transAxes, ha="center", color=_FAINT)
        axes.set_axis_off()
        return
    gap, force = _scales(curve, separation)
    x, y = np.asarray(curve.separation) * gap.factor, np.asarray(curve.force) * force.factor
    stable = np.asarray(curve.stable)
    now = separation * gap.factor, 0.0 if bridge is None else float(bridge.force) * force.factor
    _frame(axes, np.append(x, now[0]), np.append(y, now[1]))
    axes.set_xlabel(f"separation ({gap.unit})", color=_FAINT)
    axes.set_ylabel(f"force{', attraction positive' if y.min() < 0.0 else ''} ({force.unit})", color=_FAINT)
    _draw_branches(axes, x, y, stable)

    taken = [axes.transData.transform(_dense(x, y))]

    def mark(state: Bridge, text: str, colour: str) -> None:
        place = float(state.separation) * gap.factor, float(state.force) * force.factor
        axes.plot(*place, "o", ms=6.5, mfc="white", mec=colour, mew=1.8, zorder=5)
        _label(axes, f"{text}{_number(float(state.separation), 'm')}", place, taken, color=colour)

    mark(rupture, "rupture\n", _ACCENT)
    if bridge is not None:
        axes.plot(*now, "o", ms=7.5, mfc=_INK, mec="white", mew=1.2, zorder=6)
        state = _number(float(bridge.force), "N") if bridge.exists else "no bridge"
        _label(axes, f"{state} at {_number(separation, 'm')}", now, taken, color=_INK, weight="bold")
    if instability is not None:
        mark(instability, "stable to ", _LIQUID_EDGE)
    fold = int(np.argmax(x))
    for name, run in (("stable", np.flatnonzero(stable[:fold])), ("unstable", np.arange(fold, x.size))):
        if run.size:
            _label(axes, name, _halfway(axes, x[run], y[run]), taken, color=_LIQUID_EDGE, style="italic")


def _scales(curve: Bridge, separation: float) -> tuple[Scale, Scale]:
    """Units of the two axes."""
    longest = max(float(np.max(curve.separation)), abs(separation))
    return scale_of(longest, "m"), scale_of(float(np.max(np.abs(curve.force))), "N")


def _frame(axes: Axes, x: Floats, y: Floats) -> None:
    """Limits around the curve and the zeros, with room for labels on the right."""
    left, right, low, high = min(0.0, x.min()), x.max(), min(0.0, y.min()), max(0.0, y.max())
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set(color=_HAIR, lw=0.8)
    axes.tick_params(labelcolor=_FAINT, labelsize=9, width=0.8, length=3, color=_HAIR)
    axes.locator_params(nbins=6)
    axes.set_xlim(1.08 * left, right + 0.28 * (right - left))
    axes.set_ylim(low - 0.04 * (high - low), high + 0.08 * (high - low))
    if low < 0.0:
        axes.axhline(0.0, color=_HAIR, lw=0.6, zorder=1)


def _draw_branches(axes: Axes, x: Floats, y: Floats, stable: NDArray[np.bool_]) -> None:
    axes.plot(x, np.where(stable, y, np.nan), color=_LIQUID_EDGE, lw=2.2, solid_capstyle="round", zorder=3)
    unstable = ~stable
    unstable[1:] |= ~stable[:-1]  # so that the dashes begin where the line ends
    unstable[:-1] |= ~stable[1:]
    axes.plot(x, np.where(unstable, y, np.nan), color=_LIQUID_EDGE, lw=1.4, ls=(0, (4, 2.2)), zorder=3)


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
