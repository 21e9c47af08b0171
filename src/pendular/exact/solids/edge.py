"""The edge of the flat end of a cylinder, and its side.

On the edge a contact line is pinned: Y/R - 1 takes the place of the contact angle. On the side the slope is a right
angle, cos δ = 0, and Y = R as well; how far behind the end the line lies, the meridian does not tell.
"""

import math
from typing import NamedTuple

from ...ground.compile import kernel
from .sphere import Contact


class Side(NamedTuple):
    """The side of a cylinder, with its contact angle."""

    contact_angle: float
    cos_angle: float
    sin_angle: float
    radius: float
    height: float = 0.0  # of the contact line behind the end, where it is known


class Edge(NamedTuple):
    """A sharp edge, with the contact angle of the faces on both sides of it."""

    contact_angle: float
    cos_angle: float
    sin_angle: float
    radius: float
    is_held: bool  # whatever the angles: it neither recedes over the face nor advances over the side


@kernel
def edge_of(radius: float, contact_angle: float, is_held: bool) -> Edge:
    """The edge of a disc."""
    return Edge(contact_angle, math.cos(contact_angle), math.sin(contact_angle), radius, is_held)


@kernel
def contact_with_edge(edge: Edge, radius: float) -> Contact:
    """What a contact circle of radius Y amounts to: it lies on the edge where Y/R - 1 = 0."""
    share = radius / edge.radius
    return Contact(share - 1.0, share, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def side_of(radius: float, contact_angle: float) -> Side:
    """The side of a cylinder."""
    return Side(contact_angle, math.cos(contact_angle), math.sin(contact_angle), radius)


@kernel
def contact_with_side(side: Side, cosine: float, sine: float) -> Contact:
    """What a contact circle amounts to, whose meridian asks for the slope with a cosine and a sine."""
    return Contact(cosine, 0.0, sine, side.height, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def leaves_freely(cos_slope: float, sin_slope: float) -> bool:
    """Whether a meridian of the outward slope ψ leaves the edge of a flat cylinder away from it: -π < ψ < π/2."""
    return cos_slope > 0.0 or sin_slope < 0.0
