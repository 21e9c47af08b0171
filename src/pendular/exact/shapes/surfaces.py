"""What the kernels ask of a solid, asked of a surface of any kind."""

import math
from typing import Any

from ..solids import Contact, Solid, half_filling_cosine, half_filling_sine, sphere
from ..solids.cone import Cone, rise_of_cone, wetted_of_cone
from ..solids.edge import Edge, Side, contact_with_edge, contact_with_side, leaves_freely
from ..solids.paraboloid import Paraboloid, rise_of_paraboloid, wetted_of_paraboloid
from ..solids.rise import Rise, cap_of_sphere, contact_on

_AWAY = math.pi  # slope asked of a surface on its wrong side


Surface = Any  # a Solid, a Cone, a Paraboloid, an Edge, a Side, or one that is drawn


def rise_of(surface: Surface, radius: float) -> Rise:
    """The rise of a surface that is neither a sphere nor an edge."""
    if isinstance(surface, Cone):
        return rise_of_cone(surface, radius)
    if isinstance(surface, Paraboloid):
        return rise_of_paraboloid(surface, radius)
    rise: Rise = surface.rise(radius)
    return rise


def contact_with(surface: Surface, radius: float, cos_slope: float, sin_slope: float) -> Contact:
    """What a contact circle of radius Y, with the outward slope ψ, amounts to."""
    if isinstance(surface, Solid):
        return sphere.contact_with(surface, radius, cos_slope, sin_slope)
    if isinstance(surface, Edge):
        return contact_with_edge(surface, radius)
    cosine = half_filling_cosine(surface, cos_slope, sin_slope)
    sine = half_filling_sine(surface, cos_slope, sin_slope)
    if isinstance(surface, Side):
        return contact_with_side(surface, cosine, sine)
    return contact_on(rise_of(surface, radius), radius, cosine, sine)


def half_filling_angle(surface: Surface, radius: float, cos_slope: float, sin_slope: float) -> float:
    """Slope of the surface at its contact circle against the plane across the axis; π on its wrong side.

    On an edge it is that of the surface, between the faces, on which the meridian would have the contact angle; on one
    that holds the line whatever the angles, 0.
    """
    if isinstance(surface, Solid):
        return sphere.half_filling_angle(surface, radius, cos_slope, sin_slope)
    if isinstance(surface, Edge):
        if not leaves_freely(cos_slope, sin_slope):
            return _AWAY
        return 0.0 if surface.is_held else max(asked_slope(surface, cos_slope, sin_slope), 0.0)
    if isinstance(surface, Side):
        return asked_slope(surface, cos_slope, sin_slope)
    rise = rise_of(surface, radius)
    cosine, sine = half_filling_cosine(surface, cos_slope, sin_slope), half_filling_sine(surface, cos_slope, sin_slope)
    is_right = rise.cos_slope * cosine + rise.sin_slope * sine > 0.0
    return math.atan2(rise.sin_slope, rise.cos_slope) if is_right else _AWAY


def asked_slope(surface: Surface, cos_slope: float, sin_slope: float) -> float:
    """δ = π/2 - θ - ψ: the slope of a surface on which the meridian would have the contact angle."""
    return math.atan2(
        half_filling_sine(surface, cos_slope, sin_slope), half_filling_cosine(surface, cos_slope, sin_slope)
    )


def depth_inside(surface: Surface, place: float, radius: float) -> float:
    """How far, about, a point lies inside a solid whose tip is at 0 and whose body at negative places."""
    if isinstance(surface, Solid):
        return sphere.depth_inside(surface, place, radius)
    if isinstance(surface, Edge | Side):
        return min(-place, surface.radius - radius)
    return -place - rise_of(surface, radius).height


def shape_at(surface: Surface, radius: float) -> Rise:
    """The rise of a surface that is no edge; near the equator of a sphere it is held back."""
    if isinstance(surface, Solid):
        sine = min(surface.curvature * radius, 0.97)
        cosine = math.sqrt(1.0 - sine * sine)
        height = sine * radius / (1.0 + cosine)
        return Rise(cosine, sine, sine / cosine, height, radius * sine / cosine, cap_of_sphere(radius, height))
    return rise_of(surface, radius)


def wetted_area(surface: Surface, radius: float) -> float:
    """Liquid-solid area within a contact circle on a surface that is neither a sphere nor an edge."""
    if isinstance(surface, Side):
        return math.pi * radius * (radius + 2.0 * surface.height)
    if isinstance(surface, Cone):
        return wetted_of_cone(surface, radius)
    if isinstance(surface, Paraboloid):
        return wetted_of_paraboloid(surface, radius)
    area: float = surface.wetted(radius)
    return area
