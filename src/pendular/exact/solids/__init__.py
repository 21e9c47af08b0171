"""Solids that a bridge may hold on to, one file a shape.

A shape says where a meridian meets it at the contact angle (an equation with its rates), how high the wetted cap is,
how much of the solid lies in it, and how much area is wetted. A sphere and a plane are one shape.
"""

from .sphere import (
    Contact,
    Solid,
    contact_with,
    depth_inside,
    half_filling_angle,
    half_filling_cosine,
    half_filling_sine,
    solid_of,
    wetted_area,
)

__all__ = [
    "Contact",
    "Solid",
    "contact_with",
    "depth_inside",
    "half_filling_angle",
    "half_filling_cosine",
    "half_filling_sine",
    "solid_of",
    "wetted_area",
]
