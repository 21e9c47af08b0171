"""The pair with its bridge, to scale, as SVG that is light enough to be redrawn while a slider moves."""

import html

import numpy as np
from numpy.typing import NDArray

from ...ground.units import show
from ...show.scene import ASPECT, Scene, Window, far_window, mirrored, near_window, outline_of, round_length, scene_of
from .answer import Answer

__all__ = ["pair_svg"]

Floats = NDArray[np.float64]

_HALF = 100.0  # half the height of the drawing, in its own units
_CARD = 0.27  # width of the small card over that of the picture
_TIGHTER = 0.82  # than a window for a bridge as wide as this one is in contact only
_TOO_FAR = 1.4  # over the rupture distance: beyond, the window on the bridge would lose a solid


def pair_svg(answer: Answer) -> str:
    """Solids, liquid, gap and a bar of scale; a card in a corner shows the pair from afar."""
    scene = scene_of(answer.question.pair, answer.state, answer.separation)
    overview, window = _windows(answer, scene)
    parts = [_body(scene, window), _measures(scene, window) if window.shows_axis else _distance(scene), _bar(window)]
    if window != overview:
        parts.append(_card(scene, overview, window))
    wide = ASPECT * _HALF
    return (
        f'<svg viewBox="{-wide:g} {-_HALF:g} {2 * wide:g} {2 * _HALF:g}" role="img" '
        f'aria-label="{html.escape(_in_words(answer))}">{"".join(parts)}</svg>'
    )


def _windows(answer: Answer, scene: Scene) -> tuple[Window, Window]:
    """Views from afar and from near, which stay while the separation changes."""
    end = answer.rupture
    if end.exists and scene.gap < _TOO_FAR * end.separation:
        # As wide as the bridge is in contact, and as long as it is at rupture.
        last = scene_of(answer.question.pair, end, float(end.separation))
        widest = float(np.max(answer.curve.contact_radius[0]))
        largest = last._replace(y=last.y * (_TIGHTER * widest / last.y.max()))
        overview = far_window(largest)
        window = near_window(largest, overview)
        if window.shows_axis:
            shift = 0.5 * (scene.gap - largest.gap)
            return overview._replace(x=overview.x + shift), window._replace(x=window.x + shift)
    overview = far_window(scene)
    return overview, near_window(scene, overview) if scene.x.size else overview


def _in_words(answer: Answer) -> str:
    bridge = "a bridge" if answer.state.exists else "no bridge"
    return f"{answer.question.title}, {bridge} at a separation of {show(answer.separation, 'm')}"


def _body(scene: Scene, window: Window) -> str:
    """Solids, liquid and meniscus in a window."""
    solids = "".join(
        _shape("polygon", "solid", window, *outline_of(radius, pole, side, window))
        for radius, pole, side in ((scene.radii[0], 0.0, -1.0), (scene.radii[1], scene.gap, 1.0))
    )
    if not scene.x.size:
        return solids
    menisci = "".join(_shape("polyline", "meniscus", window, scene.x, side * scene.y) for side in (1.0, -1.0))
    return _shape("polygon", "liquid", window, *mirrored(scene.x, scene.y)) + solids + menisci


def _shape(tag: str, name: str, window: Window, x: Floats, y: Floats) -> str:
    u, v = window.place(x, y)
    places = np.round(np.column_stack([_HALF * u, -_HALF * v]), 2)
    # What lies out of sight is pulled to the frame, where most of its points coincide.
    moves = np.append(True, np.any(places[1:] != places[:-1], axis=1))
    points = " ".join(f"{across:g},{down:g}" for across, down in places[moves].tolist())
    return f'<{tag} class="{name}" points="{points}"/>'


def _measures(scene: Scene, window: Window) -> str:
    """Axis of symmetry, contact circles seen from the side, and the gap between the poles."""
    beyond = 2.0 * window.half_height
    parts = [_shape("polyline", "axis", window, np.array([-beyond, beyond]), np.zeros(2))]
    for end in (0, -1) if scene.x.size else ():
        rim = np.array([-scene.y[end], scene.y[end]])
        parts.append(_shape("polyline", "rim", window, np.full(2, scene.x[end]), rim))
    far = (-0.5 if window.upright else -0.8) * window.half_height * window.reach[1]
    for pole in (0.0, scene.gap):
        parts.append(_shape("polyline", "measure", window, np.full(2, pole), np.array([0.0, far])))
    u, v = (float(c) for c in window.place(0.5 * scene.gap, 1.03 * far))
    place, anchor = ((u, v - 0.03), "end") if window.upright else ((u, v - 0.08), "middle")
    return "".join(parts) + _text(*place, _gap(scene), anchor)


def _distance(scene: Scene) -> str:
    """In words, how far away the axis is that lies out of sight, and the gap on it."""
    return _text(1.28, -0.83, f"axis {show(float(scene.y.min()), 'm', 4)} away", "end") + _text(
        1.28, -0.93, f"{_gap(scene)} there", "end"
    )


def _gap(scene: Scene) -> str:
    return f"D = {show(scene.gap, 'm', 4)}".replace("-", "\N{MINUS SIGN}")


def _bar(window: Window) -> str:
    """Bar of a round length, with its length."""
    length = round_length(window)
    start, level = _HALF * (0.07 - ASPECT), 0.93 * _HALF
    end = start + _HALF * length / window.half_height
    line = f'<path class="bar" d="M{start:.2f} {level:g}H{end:.2f}"/>'
    return line + _text(0.5 * (start + end) / _HALF, -0.89, show(length, "m"), "middle")


def _text(u: float, v: float, words: str, anchor: str) -> str:
    return f'<text x="{_HALF * u:.2f}" y="{-_HALF * v:.2f}" text-anchor="{anchor}">{words}</text>'


def _card(scene: Scene, overview: Window, window: Window) -> str:
    """The pair from afar in a corner deep inside a solid, with the window marked in it."""
    at_right = bool(window.upright) or scene.radii[0] < scene.radii[1]
    at_bottom = window.upright and window.shows_axis
    inset = 0.05 * _HALF
    wide, high = ASPECT * _HALF, _HALF
    across = (1.0 - _CARD) * wide - inset
    down = (1.0 - _CARD) * high - inset
    u, v = (float(c) for c in overview.place(window.x, window.y))
    half = max(window.half_height / overview.half_height, 0.05)  # smaller than that it could not be seen
    frame = (
        f'<rect class="frame" x="{_HALF * (u - ASPECT * half):.2f}" y="{-_HALF * (v + half):.2f}" '
        f'width="{2 * ASPECT * half * _HALF:.2f}" height="{2 * half * _HALF:.2f}"/>'
    )
    place = f"translate({across if at_right else -across:.2f} {down if at_bottom else -down:.2f}) scale({_CARD})"
    sheet = f'x="{-wide:g}" y="{-high:g}" width="{2 * wide:g}" height="{2 * high:g}"'
    return (
        f'<g transform="{place}"><clipPath id="card"><rect {sheet}/></clipPath><rect class="card" {sheet}/>'
        f'<g clip-path="url(#card)">{_body(scene, overview)}{frame}</g><rect class="edge" {sheet}/></g>'
    )
