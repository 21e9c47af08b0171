"""The cone of half angle β, a surface of the slope a = π/2 - β, behind a tip or a spherical cap that it touches.

A cap of radius ρ reaches out to ρ cos β; beyond that h = (Y - ρ cos β)/tan β + ρ (1 - sin β) behind its pole.
"""

import math
from typing import NamedTuple

from ...ground.compile import kernel
from .rise import Rise, band_of_cone, cap_of_sphere


class Cone(NamedTuple):
    """The conical part of a cone, with its contact angle."""

    contact_angle: float
    cos_angle: float
    sin_angle: float
    cos_slope: float
    sin_slope: float
    tip_radius: float


@kernel
def cone_of(half_angle: float, tip_radius: float, contact_angle: float) -> Cone:
    """Cone of a half angle."""
    cosine, sine = math.sin(half_angle), math.cos(half_angle)
    return Cone(contact_angle, math.cos(contact_angle), math.sin(contact_angle), cosine, sine, tip_radius)


@kernel
def where_begins(cone: Cone) -> tuple[float, float]:
    """Radius and depth of the circle in which the cap goes over into the cone."""
    sine = cone.sin_slope
    return cone.tip_radius * sine, cone.tip_radius * sine * sine / (1.0 + cone.cos_slope)


@kernel
def rise_of_cone(cone: Cone, radius: float) -> Rise:
    """The cone at a distance from its axis."""
    start, depth = where_begins(cone)
    steepness = cone.sin_slope / cone.cos_slope
    climb = (radius - start) * steepness
    cap = cap_of_sphere(start, depth) + climb * (radius * radius + radius * start + start * start) / 3.0
    return Rise(cone.cos_slope, cone.sin_slope, 0.0, depth + climb, radius * steepness, cap)


@kernel
def wetted_of_cone(cone: Cone, radius: float) -> float:
    """Area of the cone and its cap within a circle."""
    start, depth = where_begins(cone)
    return 2.0 * math.pi * cone.tip_radius * depth + band_of_cone(start, radius, cone.cos_slope)
