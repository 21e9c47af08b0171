"""The paraboloid h = Y²/(2r) with the radius r of curvature at its tip."""

import math
from typing import NamedTuple

from ...ground.compile import kernel
from .rise import Rise


class Paraboloid(NamedTuple):
    """A paraboloid with its contact angle."""

    contact_angle: float
    cos_angle: float
    sin_angle: float
    curvature: float  # 1/r


@kernel
def paraboloid_of(tip_radius: float, contact_angle: float) -> Paraboloid:
    """Paraboloid of a radius of curvature at its tip."""
    return Paraboloid(contact_angle, math.cos(contact_angle), math.sin(contact_angle), 1.0 / tip_radius)


@kernel
def rise_of_paraboloid(solid: Paraboloid, radius: float) -> Rise:
    """The paraboloid at a distance from its axis: tan a = Y/r."""
    steepness = solid.curvature * radius
    cosine = 1.0 / math.sqrt(1.0 + steepness * steepness)
    height = 0.5 * steepness * radius
    return Rise(
        cosine,
        steepness * cosine,
        steepness * cosine * cosine,
        height,
        2.0 * height,
        0.5 * height * radius * radius,
    )


@kernel
def wetted_of_paraboloid(solid: Paraboloid, radius: float) -> float:
    """Area within a circle, 2πr²((1 + (Y/r)²)^(3/2) - 1)/3, without cancellation."""
    root = math.hypot(1.0, solid.curvature * radius)
    return 2.0 * math.pi * radius * radius * (root * root + root + 1.0) / (3.0 * (root + 1.0))
