"""A heap as an image: grains and bridges to scale, seen from afar, the nearer before the farther."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import compiled, kernel
from .wetted import Wet

__all__ = ["LIGHT", "SHADE", "View", "image_of", "inside_of", "meridians_of", "shape_of", "view_of"]

Floats = NDArray[np.float64]

_ANGLES = math.radians(35.0), math.radians(25.0)  # by which the heap is turned, and looked down upon
_MARGIN = 1.02
LIGHT = np.array([-0.45, 0.55, 0.70])
SHADE = 0.45  # brightness of what turns away from the light
_RIM, _RIM_SHADE = 0.08, 0.85  # a rim sets grains apart
_DENSITY = 0.5  # pixels between points of a meniscus
_DEPTH_OF_FILM = 0.5  # pixels by which a point may lie behind another one


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
    seen, radii = inside_of(w) @ axes[:2].T, w.heap.radii[:, None]
    low, high = (seen - radii).min(axis=0), (seen + radii).max(axis=0)
    middle, size = 0.5 * (low + high), _MARGIN * (high - low)
    return View(axes, middle - 0.5 * size, size)


def shape_of(view: View, pixels: int) -> tuple[int, int]:
    """Columns and rows of an image with so many pixels along its longer side."""
    columns, rows = (max(1, math.ceil(pixels * length / view.size.max())) for length in view.size)
    return columns, rows


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
    columns, rows = shape_of(view, pixels)
    depth = np.full((rows, columns), -np.inf)
    image = np.broadcast_to(colours[2], (rows, columns, 3)).copy()
    centres = inside_of(w)
    places = (centres @ view.axes.T - np.append(view.low, 0.0)) / pixel
    light = LIGHT / np.linalg.norm(LIGHT)
    for place, radius in zip(places, w.heap.radii / pixel, strict=True):
        compiled(_draw_ball)(depth, image, place, radius, colours[0], light)
    ends, control, chosen = meridians_of(w, centres)
    meridians = np.stack([ends[0], control, ends[1]], axis=1) / pixel
    first = w.bridges.pairs[chosen, 0]
    axes = w.bridges.normal[chosen] @ view.axes.T
    poles = places[first] + (w.heap.radii[first] / pixel)[:, None] * axes
    for row in range(len(chosen)):
        compiled(_draw_meniscus)(depth, image, poles[row], axes[row], meridians[row], colours[1], light)
    return image


def meridians_of(w: Wet, centres: Floats) -> tuple[tuple[Floats, Floats], Floats, NDArray[np.intp]]:
    """Both ends of meridians, along the axis from the first pole and away from it, and the control point between.

    The meridian is a parabola that leaves both solids at their contact angles: to the eye it is the true one. Bridges
    that leave the cell are left out.
    """
    first, second = w.bridges.pairs.T
    at_wall = second >= w.heap.count
    arm = centres[np.where(at_wall, first, second)] - centres[first]
    chosen = np.flatnonzero(at_wall | (np.linalg.norm(arm, axis=1) < 1.001 * w.bridges.length))
    pairs, filling = w.bridges.pairs[chosen], w.bridges.half_filling_angle[chosen]
    angles = w._setting.angles[w._setting.kind[pairs]]
    radii = w._setting.radii[pairs]
    finite = np.isfinite(radii)
    bulk = np.where(finite, radii, 0.0)
    circle = np.where(finite, bulk * np.sin(filling), np.sqrt(w.bridges.wetted_area[chosen] / np.pi))
    height = 2.0 * bulk * np.sin(0.5 * filling) ** 2
    gap = np.maximum(w.bridges.separation[chosen], 0.0)
    ends = np.stack([-height[:, 0], circle[:, 0]], axis=-1), np.stack([gap + height[:, 1], circle[:, 1]], axis=-1)
    return ends, _control_point(ends, filling + angles), chosen


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


def inside_of(w: Wet) -> Floats:
    """Centres inside the cell."""
    fractions = w.heap.positions @ np.linalg.inv(w.heap.box)
    return np.asarray(w.heap.positions - np.where(w.heap.periodic, np.floor(fractions), 0.0) @ w.heap.box)


@kernel
def _brightness(x: float, y: float, z: float, light: Floats) -> float:
    """Of a surface by its normal to the right, up and to the eye."""
    return SHADE + (1.0 - SHADE) * max(0.0, x * light[0] + y * light[1] + z * light[2])


@kernel
def _draw_ball(depth: Floats, image: Floats, place: Floats, radius: float, colour: Floats, light: Floats) -> None:
    """Draw a grain; lengths in pixels."""
    rows, columns = depth.shape
    for row in range(max(0, math.floor(place[1] - radius)), min(rows, math.ceil(place[1] + radius) + 1)):
        for column in range(max(0, math.floor(place[0] - radius)), min(columns, math.ceil(place[0] + radius) + 1)):
            x, y = column + 0.5 - place[0], row + 0.5 - place[1]
            rest = radius * radius - x * x - y * y
            if rest <= 0.0:
                continue
            bulge = math.sqrt(rest)
            if place[2] + bulge <= depth[row, column]:
                continue
            depth[row, column] = place[2] + bulge
            bright = _brightness(x / radius, y / radius, bulge / radius, light)
            if rest < _RIM * radius * radius:
                bright *= _RIM_SHADE
            for k in range(3):
                image[row, column, k] = bright * colour[k]


@kernel
def _draw_meniscus(
    depth: Floats, image: Floats, pole: Floats, axis: Floats, meridian: Floats, colour: Floats, light: Floats
) -> None:
    """Draw a surface of revolution point by point; lengths in pixels, directions as they are seen."""
    rows, columns = depth.shape
    across = np.array([-axis[1], axis[0], 0.0]) if abs(axis[2]) < 0.9 else np.array([0.0, -axis[2], axis[1]])
    across /= math.sqrt(across[0] ** 2 + across[1] ** 2 + across[2] ** 2)
    other = np.cross(axis, across)
    (x0, y0), (x1, y1), (x2, y2) = meridian[0], meridian[1], meridian[2]
    along = max(4, math.ceil((math.hypot(x1 - x0, y1 - y0) + math.hypot(x2 - x1, y2 - y1)) / _DENSITY))
    around = max(8, math.ceil(2.0 * math.pi * max(y0, y2) / _DENSITY))
    for i in range(along + 1):
        t = i / along
        far = (1 - t) * (1 - t) * x0 + 2 * t * (1 - t) * x1 + t * t * x2
        wide = (1 - t) * (1 - t) * y0 + 2 * t * (1 - t) * y1 + t * t * y2
        rise, run = (1 - t) * (y1 - y0) + t * (y2 - y1), (1 - t) * (x1 - x0) + t * (x2 - x1)
        steep = math.hypot(rise, run)
        if steep == 0.0:
            continue
        for j in range(around):
            c, s = math.cos(2.0 * math.pi * j / around), math.sin(2.0 * math.pi * j / around)
            spoke = c * across + s * other
            normal = (run * spoke - rise * axis) / steep
            if normal[2] < 0.0:
                continue
            place = pole + far * axis + wide * spoke
            column, row = math.floor(place[0]), math.floor(place[1])
            if 0 <= column < columns and 0 <= row < rows and place[2] > depth[row, column] - _DEPTH_OF_FILM:
                depth[row, column] = max(depth[row, column], place[2])
                bright = _brightness(normal[0], normal[1], normal[2], light)
                for k in range(3):
                    image[row, column, k] = bright * colour[k]
