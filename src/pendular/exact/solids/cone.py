"""The cone of half angle β, a surface of the slope a = π/2 - β, behind a tip or a spherical cap that it touches.

A cap of radius ρ reaches out to ρ cos β; beyond that h = (Y - ρ cos β)/tan β + ρ (1 - sin β) behind its pole.
"""

import math

from ...ground.compile import kernel
from .rise import Rise, band_of_cone, cap_of_sphere
from .surface import Surface


@kernel
def where_begins(cone: Surface) -> tuple[float, float]:
    """Radius and depth of the circle in which the cap goes over into the cone."""
    sine = cone.sin_slope
    return cone.size * sine, cone.size * sine * sine / (1.0 + cone.cos_slope)


@kernel
def rise_of_cone(cone: Surface, radius: float) -> Rise:
    """The cone at a distance from its axis."""
    start, depth = where_begins(cone)
    steepness = cone.sin_slope / cone.cos_slope
    climb = (radius - start) * steepness
    cap = cap_of_sphere(start, depth) + climb * (radius * radius + radius * start + start * start) / 3.0
    return Rise(cone.cos_slope, cone.sin_slope, 0.0, depth + climb, radius * steepness, cap)


@kernel
def wetted_of_cone(cone: Surface, radius: float) -> float:
    """Area of the cone and its cap within a circle."""
    start, depth = where_begins(cone)
    return 2.0 * math.pi * cone.size * depth + band_of_cone(start, radius, cone.cos_slope)
