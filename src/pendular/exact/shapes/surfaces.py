"""What the kernels ask of a solid, asked of a surface of any kind."""

import math

from ...ground.compile import kernel
from ..solids import Contact, Solid, half_filling_cosine, half_filling_sine, sphere
from ..solids.cone import rise_of_cone, wetted_of_cone
from ..solids.drawn import rise_of_drawn, wetted_of_drawn
from ..solids.edge import contact_with_edge, contact_with_side, leaves_freely
from ..solids.paraboloid import rise_of_paraboloid, wetted_of_paraboloid
from ..solids.rise import Rise, cap_of_sphere, contact_on
from ..solids.surface import CONE, DRAWN, PARABOLOID, RING, SIDE, SPHERE, Surface, is_pinning

_AWAY = math.pi  # slope asked of a surface on its wrong side
_NEARLY_EQUATOR = 0.97  # sine of the slope of a sphere where its rise is held back


@kernel
def _sphere_of(surface: Surface) -> Solid:
    """A surface that is a sphere or a plane, as one."""
    return Solid(surface.curvature, surface.contact_angle, surface.cos_angle, surface.sin_angle)


@kernel
def _cosine(surface: Surface, cos_slope: float, sin_slope: float) -> float:
    return half_filling_cosine(_sphere_of(surface), cos_slope, sin_slope)


@kernel
def _sine(surface: Surface, cos_slope: float, sin_slope: float) -> float:
    return half_filling_sine(_sphere_of(surface), cos_slope, sin_slope)


@kernel
def rise_of(surface: Surface, radius: float) -> Rise:
    """The rise of a surface that is neither a sphere nor an edge."""
    if surface.kind == CONE:
        return rise_of_cone(surface, radius)
    if surface.kind == PARABOLOID:
        return rise_of_paraboloid(surface, radius)
    return rise_of_drawn(surface, radius)


@kernel
def contact_with(surface: Surface, radius: float, cos_slope: float, sin_slope: float) -> Contact:
    """What a contact circle of radius Y, with the outward slope ψ, amounts to."""
    if surface.kind == SPHERE:
        return sphere.contact_with(_sphere_of(surface), radius, cos_slope, sin_slope)
    if is_pinning(surface):
        return contact_with_edge(surface, radius)
    cosine, sine = _cosine(surface, cos_slope, sin_slope), _sine(surface, cos_slope, sin_slope)
    if surface.kind == SIDE:
        return contact_with_side(surface, cosine, sine)
    return contact_on(rise_of(surface, radius), radius, cosine, sine)


@kernel
def half_filling_angle(surface: Surface, radius: float, cos_slope: float, sin_slope: float) -> float:
    """Slope of the surface at its contact circle against the plane across the axis; π on its wrong side.

    On an edge it is that of the surface, between the faces, on which the meridian would have the contact angle; on a
    ring, 0.
    """
    if surface.kind == SPHERE:
        return sphere.half_filling_angle(_sphere_of(surface), radius, cos_slope, sin_slope)
    if is_pinning(surface):
        if not leaves_freely(cos_slope, sin_slope):
            return _AWAY
        return 0.0 if surface.kind == RING else max(asked_slope(surface, cos_slope, sin_slope), 0.0)
    if surface.kind == SIDE:
        return asked_slope(surface, cos_slope, sin_slope)
    rise = rise_of(surface, radius)
    cosine, sine = _cosine(surface, cos_slope, sin_slope), _sine(surface, cos_slope, sin_slope)
    is_right = rise.cos_slope * cosine + rise.sin_slope * sine > 0.0
    return math.atan2(rise.sin_slope, rise.cos_slope) if is_right else _AWAY


@kernel
def asked_slope(surface: Surface, cos_slope: float, sin_slope: float) -> float:
    """δ = π/2 - θ - ψ: the slope of a surface on which the meridian would have the contact angle."""
    return math.atan2(_sine(surface, cos_slope, sin_slope), _cosine(surface, cos_slope, sin_slope))


@kernel
def depth_inside(surface: Surface, place: float, radius: float) -> float:
    """How far, about, a point lies inside a solid whose tip is at 0 and whose body at negative places."""
    if surface.kind == SPHERE:
        return sphere.depth_inside(_sphere_of(surface), place, radius)
    if is_pinning(surface) or surface.kind == SIDE:
        return min(-place, surface.size - radius)
    return -place - rise_of(surface, radius).height


@kernel
def shape_at(surface: Surface, radius: float) -> Rise:
    """The rise of a surface that is no edge; near the equator of a sphere it is held back."""
    if surface.kind == SPHERE:
        sine = min(surface.curvature * radius, _NEARLY_EQUATOR)
        cosine = math.sqrt(1.0 - sine * sine)
        height = sine * radius / (1.0 + cosine)
        return Rise(cosine, sine, sine / cosine, height, radius * sine / cosine, cap_of_sphere(radius, height))
    return rise_of(surface, radius)


@kernel
def wetted_area(surface: Surface, radius: float, as_on_a_sphere: float) -> float:
    """Liquid-solid area within a contact circle, given that of a cap of the same height."""
    if surface.kind == SIDE:
        return math.pi * radius * (radius + 2.0 * surface.height)
    if surface.kind == CONE:
        return wetted_of_cone(surface, radius)
    if surface.kind == PARABOLOID:
        return wetted_of_paraboloid(surface, radius)
    return wetted_of_drawn(surface, radius) if surface.kind == DRAWN else as_on_a_sphere


@kernel
def is_plane(surface: Surface) -> bool:
    """Whether it is a plane, on all of which a line lies alike."""
    return surface.kind == SPHERE and surface.curvature == 0.0
