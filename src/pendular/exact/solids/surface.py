"""A smooth surface of revolution of any kind, as one flat record; a solid is told by one of its surfaces."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import kernel

Profile = NDArray[np.float64]  # rows of a spline, as `drawn` lays them out

# Kinds of surfaces. A solid is named by one: the flat end of a cylinder by its edge, a cone behind a cap by the cone.
SPHERE, CONE, PARABOLOID, DRAWN, EDGE, RING, SIDE = range(7)

NO_PROFILE: Profile = np.empty((0, 7))


class Surface(NamedTuple):
    """A surface with its contact angle. What its kind does not have is 0."""

    kind: int
    contact_angle: float
    cos_angle: float
    sin_angle: float
    curvature: float  # of a sphere, 0 for a plane; of a paraboloid at its tip
    size: float  # radius of the tip of a cone, of an edge, a ring or a side; unit of length of a profile
    cos_slope: float  # of a cone, against the plane across the axis
    sin_slope: float
    height: float  # of the contact line behind the end of a cylinder, where it is known
    profile: Profile  # without a row where it is not drawn


@kernel
def is_pinning(surface: Surface) -> bool:
    """Whether a line is pinned on it: an edge, or a ring, which holds the line whatever the angles."""
    return surface.kind == EDGE or surface.kind == RING


@kernel
def surface_of(
    kind: int, curvature: float, size: float, half_angle: float, contact_angle: float, profile: Profile
) -> Surface:
    """Surface of a kind; the half angle is that of a cone."""
    cos_slope, sin_slope = (math.sin(half_angle), math.cos(half_angle)) if kind == CONE else (0.0, 0.0)
    cosine, sine = math.cos(contact_angle), math.sin(contact_angle)
    return Surface(kind, contact_angle, cosine, sine, curvature, size, cos_slope, sin_slope, 0.0, profile)


@kernel
def as_kind(surface: Surface, kind: int, curvature: float, size: float) -> Surface:
    """Another surface of the same solid."""
    return Surface(
        kind,
        surface.contact_angle,
        surface.cos_angle,
        surface.sin_angle,
        curvature,
        size,
        surface.cos_slope,
        surface.sin_slope,
        0.0,
        surface.profile,
    )


@kernel
def with_height(side: Surface, height: float) -> Surface:
    """The side of a cylinder, with the height of its contact line."""
    return Surface(
        side.kind, side.contact_angle, side.cos_angle, side.sin_angle, side.curvature, side.size, side.cos_slope,
        side.sin_slope, height, side.profile,
    )  # fmt: skip
