r"""Contact with a convex solid of revolution that is given by how it rises away from its tip.

With a(Y) the slope of the surface against the plane across the axis, h(Y) its depth behind the tip and δ = π/2 - θ - ψ
the slope that the meridian asks for, a meridian meets the solid at its contact angle where

.. math:: \sin(a(Y) - \delta) = 0, \qquad Y h' = Y\tan a, \quad (V_{cap}/\pi)' = Y^2 h' .
"""

import math
from typing import NamedTuple

from ...ground.compile import kernel
from .sphere import Contact


class Rise(NamedTuple):
    """A convex solid at the distance Y from its axis."""

    cos_slope: float
    sin_slope: float
    bend: float  # Y da/dY
    height: float  # h
    lift: float  # Y dh/dY
    cap: float  # volume over π between the tip and the circle


@kernel
def contact_on(rise: Rise, radius: float, cosine: float, sine: float) -> Contact:
    """What a contact circle of radius Y amounts to, whose meridian asks for the slope with a cosine and a sine."""
    mismatch = rise.sin_slope * cosine - rise.cos_slope * sine
    along = rise.cos_slope * cosine + rise.sin_slope * sine
    square = radius * radius
    return Contact(mismatch, rise.bend * along, along, rise.height, rise.lift, 0.0, rise.cap, square * rise.lift, 0.0)


@kernel
def cap_of_sphere(radius: float, height: float) -> float:
    """Volume over π of the cap of a sphere."""
    return height * (3.0 * radius * radius + height * height) / 6.0


@kernel
def band_of_cone(inner: float, outer: float, slant: float) -> float:
    """Area of a cone between two radii, with the sine of the half angle of the cone."""
    return math.pi * (outer * outer - inner * inner) / slant
