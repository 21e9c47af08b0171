"""A heap as an image: grains and bridges to scale, seen from afar, the nearer before the farther."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .wetted import Wet

__all__ = ["View", "image_of", "menisci_of", "view_of"]

Floats = NDArray[np.float64]

_ANGLES = math.radians(35.0), math.radians(25.0)  # by which the heap is turned, and looked down upon
_MARGIN = 1.02
_LIGHT = np.array([-0.45, 0.55, 0.70])
_SHADE = 0.45  # brightness of what turns away from the light
_POINTS_A_BRIDGE = 4_000_000  # in all, of the surfaces of the menisci


class View(NamedTuple):
    """How space is seen: rows of ``axes`` point to the right, up and to the eye."""

    axes: Floats
    low: Floats  # corner of the image, (2,), [m]
    size: Floats  # of the image, (2,), [m]


def view_of(w: Wet) -> View:
    """Whole heap, from obliquely above."""
    turn, tilt = _ANGLES
    right = np.array([math.cos(turn), math.sin(turn), 0.0])
    back = np.array([-math.sin(turn), math.cos(turn), 0.0])
    up = np.array([0.0, 0.0, math.cos(tilt)]) + math.sin(tilt) * back
    axes = np.array([right, up, np.cross(right, up)])
    seen, radii = _inside(w) @ axes[:2].T, w.heap.radii[:, None]
    low, high = (seen - radii).min(axis=0), (seen + radii).max(axis=0)
    middle, size = 0.5 * (low + high), _MARGIN * (high - low)
    return View(axes, middle - 0.5 * size, size)


def image_of(w: Wet, view: View, pixels: int, colours: tuple[Floats, Floats, Floats]) -> Floats:
    """Image of a heap.

    Parameters
    ----------
    w : Wet
        The heap.
    view : View
        Of :func:`view_of`.
    pixels : int
        Along the longer side.
    colours : three of (3,)
        Of grains, liquid and ground, from 0 to 1.

    Returns
    -------
    ndarray, (rows, columns, 3)
        The first row is the lowest.
    """
    pixel = float(view.size.max()) / pixels
    columns, rows = (max(1, math.ceil(length / pixel)) for length in view.size)
    depth = np.full((rows, columns), -np.inf)
    image = np.broadcast_to(colours[2], (rows, columns, 3)).copy()
    centres = _inside(w)
    places = (centres @ view.axes.T - np.append(view.low, 0.0)) / pixel
    for place, radius in zip(places, w.heap.radii / pixel, strict=True):
        _draw_ball(depth, image, place, float(radius), colours[0])
    surface, normals = menisci_of(w, max(8, min(4000, _POINTS_A_BRIDGE // max(1, len(w.bridges)))), pixel)
    seen = (surface @ view.axes.T - np.append(view.low, 0.0)) / pixel
    _draw_points(depth, image, seen, _brightness(normals @ view.axes.T), colours[1])
    return image


def menisci_of(w: Wet, most: int, spacing: float) -> tuple[Floats, Floats]:
    """Points on the menisci and their normals, no farther apart than a spacing, at most so many a bridge.

    The meridian is a parabola that leaves both solids at their contact angles: to the eye it is the true one.
    """
    bridges = w.bridges
    if not len(bridges):
        return np.empty((0, 3)), np.empty((0, 3))
    radii = w._setting.radii[bridges.pairs]
    angles = w._setting.angles[w._setting.kind[bridges.pairs]]
    filling = bridges.half_filling_angle
    circle = np.sqrt(bridges.wetted_area / np.pi)
    finite = np.isfinite(radii)
    bulk = np.where(finite, radii, 0.0)
    circle = np.where(finite, bulk * np.sin(filling), circle)
    height = 2.0 * bulk * np.sin(0.5 * filling) ** 2
    gap = np.maximum(bridges.separation, 0.0)
    ends = np.stack([-height[:, 0], circle[:, 0]], axis=-1), np.stack([gap + height[:, 1], circle[:, 1]], axis=-1)
    control = _control_point(ends, filling + angles)
    around = int(np.clip(2.0 * np.pi * circle.max() / spacing, 8, 2.0 * math.sqrt(most)))
    along = int(np.clip(np.max(ends[1][:, 0] - ends[0][:, 0]) / spacing * 1.5, 3, max(3, most // around)))
    t = np.linspace(0.0, 1.0, along)[:, None, None]
    meridian = (1 - t) ** 2 * ends[0] + 2 * t * (1 - t) * control + t**2 * ends[1]  # (along, bridges, 2)
    slope = (1 - t) * (control - ends[0]) + t * (ends[1] - control)
    steep = np.linalg.norm(slope, axis=-1, keepdims=True)
    slope = slope / np.where(steep > 0.0, steep, 1.0)
    axis = bridges.normal
    helper = np.where(np.abs(axis[:, :1]) < 0.7, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    across = np.cross(axis, helper)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    other = np.cross(axis, across)
    turn = 2.0 * np.pi * np.arange(around)[:, None, None] / around
    spoke = np.cos(turn) * across + np.sin(turn) * other  # (around, bridges, 3)
    pole = _inside(w)[bridges.pairs[:, 0]] + bulk[:, :1] * axis
    points = pole + meridian[:, None, :, :1] * axis + meridian[:, None, :, 1:] * spoke
    normals = slope[:, None, :, :1] * spoke - slope[:, None, :, 1:] * axis
    return points.reshape(-1, 3), normals.reshape(-1, 3)


def _control_point(ends: tuple[Floats, Floats], lean: Floats) -> Floats:
    """Where the tangents at the two contact lines meet; the middle where they do not before the axis."""
    first = np.stack([np.sin(lean[:, 0]), -np.cos(lean[:, 0])], axis=-1)
    second = np.stack([-np.sin(lean[:, 1]), -np.cos(lean[:, 1])], axis=-1)
    span = ends[1] - ends[0]
    cross = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        far = (span[:, 0] * second[:, 1] - span[:, 1] * second[:, 0]) / cross
        control = ends[0] + far[:, None] * first
    good = np.isfinite(far) & (far > 0.0) & (control[:, 1] > 0.0)
    good &= (control[:, 0] >= ends[0][:, 0]) & (control[:, 0] <= ends[1][:, 0])
    return np.where(good[:, None], control, 0.5 * (ends[0] + ends[1]))


def _inside(w: Wet) -> Floats:
    """Centres inside the cell."""
    fractions = w.heap.positions @ np.linalg.inv(w.heap.box)
    return np.asarray(w.heap.positions - np.where(w.heap.periodic, np.floor(fractions), 0.0) @ w.heap.box)


def _brightness(normals: Floats) -> Floats:
    """Of a surface by its normal to the right, up and to the eye."""
    light = _LIGHT / np.linalg.norm(_LIGHT)
    return np.asarray(_SHADE + (1.0 - _SHADE) * np.clip(normals @ light, 0.0, 1.0))


def _draw_ball(depth: Floats, image: Floats, place: Floats, radius: float, colour: Floats) -> None:
    """A grain, in pixels."""
    rows, columns = depth.shape
    left, right = max(0, math.floor(place[0] - radius)), min(columns, math.ceil(place[0] + radius) + 1)
    low, high = max(0, math.floor(place[1] - radius)), min(rows, math.ceil(place[1] + radius) + 1)
    if left >= right or low >= high:
        return
    x = (np.arange(left, right) + 0.5 - place[0])[None, :]
    y = (np.arange(low, high) + 0.5 - place[1])[:, None]
    rest = radius * radius - x * x - y * y
    bulge = np.sqrt(np.maximum(rest, 0.0))
    window = depth[low:high, left:right]
    nearer = (rest > 0.0) & (place[2] + bulge > window)
    if not nearer.any():
        return
    window[nearer] = (place[2] + bulge)[nearer]
    normals = np.stack(np.broadcast_arrays(x, y, bulge), axis=-1)[nearer] / radius
    bright = _brightness(normals) * np.where(rest[nearer] < 0.08 * radius * radius, 0.85, 1.0)  # a rim sets grains apart
    image[low:high, left:right][nearer] = bright[:, None] * colour


def _draw_points(depth: Floats, image: Floats, places: Floats, bright: Floats, colour: Floats) -> None:
    """Points of a surface, in pixels."""
    rows, columns = depth.shape
    column, row = np.floor(places[:, :2]).astype(np.int64).T
    seen = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    pixel, height, bright = (row * columns + column)[seen], places[seen, 2], bright[seen]
    order = np.lexsort((height, pixel))
    pixel, height, bright = pixel[order], height[order], bright[order]
    last = np.append(pixel[1:] != pixel[:-1], True)[: len(pixel)]
    pixel, height, bright = pixel[last], height[last], bright[last]
    nearer = height > depth.ravel()[pixel] - 0.5
    image.reshape(-1, 3)[pixel[nearer]] = bright[nearer, None] * colour
