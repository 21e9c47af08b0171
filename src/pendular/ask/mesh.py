"""The surfaces of a bridge and its two solids as triangles."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["SHOWN_OF_A_PLANE", "SURFACES", "Mesh", "Outline", "meniscus_rings", "outline_of_sphere", "steps", "turned"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

SURFACES = ("liquid_gas", "wetted1", "wetted2", "dry1", "dry2")
_LIQUID_GAS, _WETTED1, _WETTED2, _DRY1, _DRY2 = range(5)

_MOST = 1000  # strips of the meniscus
SHOWN_OF_A_PLANE = 4.0  # radius, over the contact radius


class Mesh(NamedTuple):
    """Triangles of a bridge and its solids, as `Bridge.mesh` makes them; surfaces meet in common points.

    A surface is a number in ``SURFACES``: 0 is that between liquid and gas, 1 and 2 are the wetted parts of the solids,
    3 and 4 their dry parts. Of 0, 1 and 2, which enclose the liquid, the corners go counterclockwise seen from outside
    of it; of 3 and 4 seen from outside of the solid, which they enclose with its wetted part. A plane is shown out to
    four times the contact radius.
    """

    points: Floats  # (n, 3), [m]: the axis is x, the facing poles of the solids lie at x = 0 and x = D
    triangles: Ints  # (m, 3), indices of points
    surface: Ints  # (m,), index in SURFACES


def meniscus_rings(length: float, radius: float, around: int) -> int:
    """Number of rings of a meniscus: as far apart as points of a ring, and turned by no more; its turn is below π."""
    strips = max(length / radius, math.pi) * around / (2.0 * math.pi)
    return 1 + min(math.ceil(strips), _MOST)


class Outline(NamedTuple):
    """Depths behind the pole of a solid, and radii, of its rings inside the contact circle and outside of it."""

    inner: Floats
    outer: Floats


def turned(meniscus: Floats, outlines: tuple[Outline, Outline], separation: float, around: int) -> Mesh:
    """Mesh of a bridge whose meridian is turned about the axis.

    Parameters
    ----------
    meniscus : array of shape (2, rings)
        Places on the axis and radii, from the first solid to the second, [m].
    outlines : tuple of two Outline
        Of the solids, [m].
    separation : float
        Gap from pole to pole, [m].
    around : int
        Points of a ring.

    Returns
    -------
    Mesh
    """
    wetted, dry = [], []
    for solid, (inner, outer) in enumerate(outlines):
        away = [[-1.0], [1.0]] if solid == 0 else [[1.0], [1.0]]  # from the other solid
        pole = [[0.0 if solid == 0 else separation], [0.0]]
        wetted.append(inner * away + pole)
        dry.append(outer * away + pole)
    inside, across, beyond = [each.shape[1] for each in wetted], meniscus.shape[1], dry[0].shape[1]
    liquid = np.arange(sum(inside) + across)
    first, last = inside[0], inside[0] + across - 1  # contact circles
    behind = liquid.size + np.arange(beyond + dry[1].shape[1])
    chains = (
        (liquid, np.repeat([_WETTED1, _LIQUID_GAS, _WETTED2], [inside[0], across - 1, inside[1]])),
        (np.append(behind[:beyond][::-1], first), np.full(beyond, _DRY1)),
        (np.append(last, behind[beyond:]), np.full(dry[1].shape[1], _DRY2)),
    )
    return _joined(np.concatenate([wetted[0], meniscus, wetted[1][:, ::-1], *dry], axis=1), chains, around)


def outline_of_sphere(radius: float, filling: float, contact: float, around: int) -> Outline:
    """Outline of a sphere with its half-filling angle, or of a plane with its contact circle."""
    shares = np.linspace(0.0, 1.0, around // 6, endpoint=False)
    if math.isinf(radius):
        within = contact * shares
        without = contact * np.exp(steps(0.0, math.log(SHOWN_OF_A_PLANE), around))
        return Outline(np.stack([np.zeros_like(within), within]), np.stack([np.zeros_like(without), without]))
    within = filling * shares
    # in ln tan(δ/2) triangles are as high as wide, at any distance from the poles
    first, last = math.log(math.tan(0.5 * filling)), -math.log(math.tan(math.pi / around))
    without = np.append(2.0 * np.arctan(np.exp(steps(first, max(first, last), around))), math.pi)
    inner, outer = (
        np.stack([2.0 * radius * np.sin(0.5 * turn) ** 2, radius * np.sin(turn)]) for turn in (within, without)
    )
    outer[1, -1] = 0.0  # the far pole is a point
    return Outline(inner, outer)


def steps(start: float, stop: float, around: int) -> Floats:
    """Even steps to an end, without the start, about as long as those of a ring."""
    count = math.ceil((stop - start) * around / (2.0 * math.pi))
    return np.linspace(start, stop, count + 1)[1:]


def _joined(rings: Floats, chains: tuple[tuple[Ints, Ints], ...], around: int) -> Mesh:
    """Points of rings, one for a ring without a radius, and the triangles between those that follow on a chain."""
    turn = 2.0 * math.pi * np.arange(around) / around
    is_point = rings[1] == 0.0
    starts = np.concatenate([[0], np.cumsum(np.where(is_point, 1, around))])
    points = np.concatenate(
        [
            [[x, 0.0, 0.0]] if y == 0.0 else np.column_stack([np.full(around, x), y * np.cos(turn), y * np.sin(turn)])
            for x, y in rings.T
        ]
    )
    here = np.arange(around)
    there = (here + 1) % around
    triangles, surface = [], []
    for chain, surfaces in chains:
        for one, other, name in zip(chain[:-1], chain[1:], surfaces, strict=True):
            a, b = starts[one] + here * ~is_point[one], starts[other] + here * ~is_point[other]
            c, d = starts[other] + there * ~is_point[other], starts[one] + there * ~is_point[one]
            if not is_point[one]:
                triangles.append(np.column_stack([a, d, b]))
                surface.append(np.full(around, name))
            if not is_point[other]:
                triangles.append(np.column_stack([d, c, b]))
                surface.append(np.full(around, name))
    return Mesh(points, np.concatenate(triangles), np.concatenate(surface))
