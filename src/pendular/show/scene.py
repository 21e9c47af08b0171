"""What is seen of a pair of solids and its bridge: the meridian, the outlines, and a window on them."""

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ask.face import Bridge, Pair
from ..ask.shapes import Disc, Shape

__all__ = [
    "ASPECT",
    "Scene",
    "Window",
    "far_window",
    "mirrored",
    "near_window",
    "outlines_of",
    "round_length",
    "scene_of",
]

Floats = NDArray[np.float64]
Point = tuple[float, float]

ASPECT = 1.34  # width over height of the picture of the pair

_SEEN = 1.5  # of a solid without an end, over the contact radius

# A meniscus that is thinner than this part of its radius would be a hairline: its edge is drawn instead.
_THINNEST = 0.05


class Window(NamedTuple):
    """What is seen of the plane of the meridian: centre and half height, [m], and how it is turned."""

    x: float
    y: float
    half_height: float
    upright: Literal[-1, 0, 1]  # axis of the pair: 0 lies, 1 stands with the first solid below, -1 with the second

    @property
    def reach(self) -> Point:
        """Half extents along the axis of the pair and across it, in half heights."""
        return (1.0, ASPECT) if self.upright else (ASPECT, 1.0)

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


class Scene(NamedTuple):
    """What is drawn, [m]: the facing poles of the solids lie at x = 0 and x = gap on the axis y = 0."""

    radii: Point  # of other solids than spheres, of what is seen of them
    gap: float
    x: Floats  # meridian; empty where there is no bridge
    y: Floats
    solids: tuple[float | Shape, float | Shape]


def scene_of(pair: Pair, bridge: Bridge, separation: float) -> Scene:
    """Solids at a separation, with the bridge between them if it exists."""
    first, second = (solid if isinstance(solid, Shape) else float(solid) for solid in pair.solids)
    widest = float(np.max(bridge.contact_radius)) if bridge.exists else separation
    radii = _seen_of(first, widest), _seen_of(second, widest)
    if not bridge.exists:
        return Scene(radii, separation, np.empty(0), np.empty(0), (first, second))
    profile = bridge.profile(161)
    return Scene(radii, separation, profile.x, profile.y, (first, second))


def _seen_of(solid: float | Shape, widest: float) -> float:
    """Radius of a sphere, or of as much of another solid as is of interest beside a contact circle."""
    if isinstance(solid, Disc):
        return solid.radius
    return _SEEN * widest if isinstance(solid, Shape) else solid


def far_window(scene: Scene) -> Window:
    """Window on both solids; of planes, and of a far larger sphere, on the part next to the other solid."""
    small = min(scene.radii)
    if math.isinf(small):
        small = max(scene.gap, float(scene.y.max(initial=0.0)))
    depths = [2.0 * min(radius, 2.5 * small) if math.isfinite(radius) else 0.6 * small for radius in scene.radii]
    widest = scene.y.max(initial=min(max(scene.radii), 2.0 * small))
    along, across = 0.5 * (sum(depths) + scene.gap), float(widest)
    upright = _upright(scene.radii)
    half_height = max(along, across / ASPECT) if upright else max(across, along / ASPECT)
    return Window(0.5 * (scene.gap + depths[1] - depths[0]), 0.0, 1.08 * half_height, upright)


def _upright(radii: Point) -> Literal[-1, 0, 1]:
    """A plate lies below the sphere; two spheres stand side by side."""
    if math.isinf(radii[0]):
        return 1
    return -1 if math.isinf(radii[1]) else 0


def near_window(scene: Scene, overview: Window) -> Window:
    """Window on the bridge, or on its edge if it is too thin; the overview itself if that is near enough."""
    thickness, widest = float(np.ptp(scene.x)), float(scene.y.max())
    middle, upright = 0.5 * float(scene.x.min() + scene.x.max()), overview.upright
    if max(thickness, float(np.ptp(scene.y))) < _THINNEST * widest:
        return Window(middle, float(scene.y.mean()), 1.6 * thickness, upright)
    # upright, the gap's label stands on one side of the bridge and the card on the other
    half_height = max((2.1 if upright else 2.2) * widest, 1.2 * thickness)
    if half_height > 0.65 * overview.half_height:
        return overview
    return Window(middle + 0.3 * upright * half_height, 0.0, half_height, upright)  # more of the sphere than the plate


def mirrored(x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Closed outline of a body of revolution from its upper half."""
    return np.concatenate([x, x[::-1]]), np.concatenate([y, -y[::-1]])


def outlines_of(scene: Scene, window: Window) -> list[tuple[Floats, Floats]]:
    """Closed outlines of both solids, fine in the window."""
    first, second = scene.solids
    return [_outline_of(first, 0.0, -1.0, window), _outline_of(second, scene.gap, 1.0, window)]


def _outline_of(solid: float | Shape, pole: float, side: float, window: Window) -> tuple[Floats, Floats]:
    """Closed outline of a solid with its pole at x = ``pole`` and its body to the ``side``."""
    margin = 1.5 * window.half_height * window.reach[1]
    far = 4.0 * window.half_height
    if isinstance(solid, Shape):
        depth, height = solid.outline(np.array(far if isinstance(solid, Disc) else window.y + margin), 241)
        return mirrored(pole + side * np.append(depth, max(far, depth[-1])), np.append(height, height[-1]))
    radius = solid
    if math.isinf(radius):
        return mirrored(np.array([pole, pole + side * far]), np.full(2, window.y + margin))
    seen = np.arcsin(np.clip(np.linspace(window.y - margin, window.y + margin, 121) / radius, 0.0, 1.0))
    turn = np.union1d(np.linspace(0.0, math.pi, 91), seen)
    return mirrored(pole + side * 2.0 * radius * np.sin(0.5 * turn) ** 2, radius * np.sin(turn))


def round_length(window: Window) -> float:
    """Length of the bar of scale, [m]: 1, 2 or 5 times a power of ten, about a fifth of the width."""
    wanted = 0.5 * window.half_height
    decade = 10.0 ** math.floor(math.log10(wanted))
    return max(step * decade for step in (1.0, 2.0, 5.0) if step * decade <= wanted)
