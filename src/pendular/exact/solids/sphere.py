"""The sphere of radius R = 1/k, and the plane, k = 0.

With δ the half-filling angle and ψ the outward slope of the meridian, δ = π/2 - θ - ψ, a meridian meets the solid at
its contact angle θ where

    kY - sin δ = 0 ,

and the wetted cap has the height h = kY²/(1 + cos δ) and the volume π h (3Y² + h²)/6.
"""

import math
from typing import NamedTuple

from ...ground.compile import kernel
from ...ground.lanes import choose

_ROUNDING = 1e-13  # of a sine
_PAST_EQUATOR = -0.5  # cos δ below which h = (1 - cos δ)/k is the accurate form


class Solid(NamedTuple):
    """A sphere or a plane with its contact angle."""

    curvature: float  # k = 1/R, 0 for a plane
    contact_angle: float  # θ
    cos_angle: float
    sin_angle: float


class Contact(NamedTuple):
    """Contact equation, height h and cap volume over π, each with its rates in ln Y and in ψ."""

    mismatch: float
    mismatch_by_radius: float
    mismatch_by_slope: float
    height: float
    height_by_radius: float
    height_by_slope: float
    cap: float
    cap_by_radius: float
    cap_by_slope: float


@kernel
def solid_of(curvature: float, contact_angle: float) -> Solid:
    """Solid of a curvature and a contact angle."""
    return Solid(curvature, contact_angle, math.cos(contact_angle), math.sin(contact_angle))


@kernel
def contact_with(solid: Solid, radius: float, cos_slope: float, sin_slope: float) -> Contact:
    """What a contact circle of radius Y, with the outward slope ψ, amounts to."""
    k = solid.curvature
    sine = half_filling_sine(solid, cos_slope, sin_slope)
    cosine = half_filling_cosine(solid, cos_slope, sin_slope)
    turned = k * radius
    is_past = (cosine < _PAST_EQUATOR) & (k > 0.0)
    over, inverse = 1.0 / choose(k > 0.0, k, 1.0), 1.0 / max(1.0 + cosine, 1.0 + _PAST_EQUATOR)
    height = choose(is_past, (1.0 - cosine) * over, turned * radius * inverse)
    by_radius = choose(is_past, 0.0, 2.0 * height)
    by_slope = choose(is_past, -sine * over, -height * sine * inverse)
    square = radius * radius
    lifted = 0.5 * (square + height * height)
    return Contact(
        turned - sine,
        turned,
        cosine,
        height,
        by_radius,
        by_slope,
        height * (3.0 * square + height * height) / 6.0,
        lifted * by_radius + height * square,
        lifted * by_slope,
    )


@kernel
def half_filling_sine(solid: Solid, cos_slope: float, sin_slope: float) -> float:
    """Sine of δ, from the slope alone."""
    return solid.cos_angle * cos_slope - solid.sin_angle * sin_slope


@kernel
def half_filling_cosine(solid: Solid, cos_slope: float, sin_slope: float) -> float:
    """Cosine of δ."""
    return solid.sin_angle * cos_slope + solid.cos_angle * sin_slope


@kernel
def half_filling_angle(solid: Solid, radius: float, cos_slope: float, sin_slope: float) -> float:
    """δ in (-π, π]; 0 on a plane, π on its wrong side."""
    sine = half_filling_sine(solid, cos_slope, sin_slope)
    cosine = half_filling_cosine(solid, cos_slope, sin_slope)
    if solid.curvature == 0.0:
        return 0.0 if cosine > 0.0 else math.pi
    # at the contact sin δ is kY, which has all digits where δ is small
    return math.atan2(solid.curvature * radius if sine > -_ROUNDING else sine, cosine)


@kernel
def wetted_area(radius: float, height: float) -> float:
    """Liquid-solid area, π (Y² + h²): a cap on a sphere, a disc on a plane."""
    return math.pi * (radius * radius + height * height)


@kernel
def depth_inside(solid: Solid, place: float, radius: float) -> float:
    """How far a point lies inside a solid whose pole is at 0 and whose body at negative places; negative outside."""
    return -place - 0.5 * solid.curvature * (place * place + radius * radius)
