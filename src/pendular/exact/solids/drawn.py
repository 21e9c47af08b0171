r"""A convex solid that is drawn: its depth h(Y) behind the tip is a cubic spline, whose integrals are known.

A row of its profile holds a knot y, the coefficients of :math:`h = c_0 + c_1 t + c_2 t^2 + c_3 t^3` with t = Y - y,
and, up to the knot, the volume over π between the tip and the circle, :math:`\int y^2 h' dy`, and the area
:math:`2\pi\int y\sqrt{1 + h'^2}\,dy`. The last row is that of the end, beyond which nothing is known.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import constants, kernel
from .rise import Rise
from .surface import Profile, Surface

Floats = NDArray[np.float64]

_NODES, _WEIGHTS = map(constants, np.polynomial.legendre.leggauss(12))


def profile_of(knots: Floats, coefficients: Floats) -> Profile:
    """Rows of a spline, from the coefficients of each piece, that of the highest power first, as SciPy has them."""
    rows = np.empty((knots.size, 7))
    rows[:, 0] = knots
    rows[:-1, 1:5] = coefficients[::-1].T
    step = knots[-1] - knots[-2]
    c0, c1, c2, c3 = rows[-2, 1:5]
    end = c0 + step * (c1 + step * (c2 + step * c3)), c1 + step * (2.0 * c2 + 3.0 * step * c3), c2 + 3.0 * step * c3, c3
    rows[-1, 1:5] = end
    rows[0, 5:] = 0.0
    for i in range(knots.size - 1):
        step = float(knots[i + 1] - knots[i])
        rows[i + 1, 5] = rows[i, 5] + _cap_within(rows, i, step)
        rows[i + 1, 6] = rows[i, 6] + _area_within(rows, i, step)
    return rows


@kernel
def _row_of(profile: Profile, at: float) -> int:
    """The row from which a radius is reached."""
    low, high = 0, profile.shape[0] - 1
    while high - low > 1:
        middle = (low + high) // 2
        if profile[middle, 0] <= at:
            low = middle
        else:
            high = middle
    return low


@kernel
def _cap_within(profile: Profile, i: int, step: float) -> float:
    """Volume over π, ∫y²h' dy, from a knot on."""
    y, c1, c2, c3 = float(profile[i, 0]), float(profile[i, 2]), float(profile[i, 3]), float(profile[i, 4])
    square = y * y
    first = square * c1
    second = square * c2 + y * c1
    third = square * c3 + (4.0 * y * c2 + c1) / 3.0
    fourth = 1.5 * y * c3 + 0.5 * c2
    return step * (first + step * (second + step * (third + step * (fourth + step * 0.6 * c3))))


@kernel
def _area_within(profile: Profile, i: int, step: float) -> float:
    """Area from a knot on, by Gauss's rule."""
    y, c1, c2, c3 = float(profile[i, 0]), float(profile[i, 2]), float(profile[i, 3]), float(profile[i, 4])
    half, total = 0.5 * step, 0.0
    for k in range(len(_NODES)):
        t = half * (1.0 + _NODES[k])
        total += _WEIGHTS[k] * (y + t) * math.hypot(1.0, c1 + t * (2.0 * c2 + 3.0 * t * c3))
    return 2.0 * math.pi * half * total


@kernel
def rise_of_drawn(solid: Surface, radius: float) -> Rise:
    """The solid at a distance from its axis."""
    profile, unit = solid.profile, solid.size
    at = radius / unit
    i = _row_of(profile, at)
    t = at - float(profile[i, 0])
    c0, c1 = float(profile[i, 1]), float(profile[i, 2])
    c2, c3 = float(profile[i, 3]), float(profile[i, 4])
    steepness, bend = c1 + t * (2.0 * c2 + 3.0 * t * c3), (2.0 * c2 + 6.0 * t * c3) * at
    square = 1.0 + steepness * steepness
    cosine = 1.0 / math.sqrt(square)
    depth = (c0 + t * (c1 + t * (c2 + t * c3))) * unit
    cap = (float(profile[i, 5]) + _cap_within(profile, i, t)) * (unit * unit * unit)
    return Rise(cosine, steepness * cosine, bend / square, depth, radius * steepness, cap)


@kernel
def wetted_of_drawn(solid: Surface, radius: float) -> float:
    """Area within a circle."""
    at = radius / solid.size
    i = _row_of(solid.profile, at)
    area = float(solid.profile[i, 6]) + _area_within(solid.profile, i, at - float(solid.profile[i, 0]))
    return area * (solid.size * solid.size)


@kernel
def reach_of(solid: Surface) -> float:
    """Radius at which what is known of it ends."""
    return float(solid.profile[solid.profile.shape[0] - 1, 0]) * solid.size
