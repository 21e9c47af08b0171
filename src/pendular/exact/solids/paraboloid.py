"""The paraboloid h = Y²/(2r) with the radius r of curvature at its tip."""

import math

from ...ground.compile import kernel
from .rise import Rise
from .surface import Surface


@kernel
def rise_of_paraboloid(solid: Surface, radius: float) -> Rise:
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
def wetted_of_paraboloid(solid: Surface, radius: float) -> float:
    """Area within a circle, 2πr²((1 + (Y/r)²)^(3/2) - 1)/3, without cancellation."""
    root = math.hypot(1.0, solid.curvature * radius)
    return 2.0 * math.pi * radius * radius * (root * root + root + 1.0) / (3.0 * (root + 1.0))
