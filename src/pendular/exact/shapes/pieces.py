"""The smooth pieces of a solid, in order away from its tip, and which of them a contact circle lies on.

A solid is told by one surface: a sphere, a paraboloid and one that is drawn are that alone; behind its cap begins a
cone, beside its face and its side the edge of a cylinder.
"""

import math
from typing import NamedTuple

from ...ground.compile import kernel
from ..meridian import End
from ..solids.cone import where_begins
from ..solids.drawn import reach_of
from ..solids.surface import CONE, DRAWN, EDGE, RING, SIDE, SPHERE, Profile, Surface, as_kind, is_pinning, surface_of
from .surfaces import asked_slope, is_plane

MOST_PIECES = 3

_FLAT = 1e-15  # slope of a cone that is a plane, to rounding


class Piece(NamedTuple):
    """A smooth surface, and the radii between which it belongs to the solid."""

    surface: Surface
    inner: float
    outer: float


@kernel
def solid_from(kind: int, size: float, half_angle: float, contact_angle: float, profile: Profile) -> Surface:
    """Solid of a kind: its size is a radius, that of the tip where it has one, or the unit of length of a profile.

    A plane is a sphere of an infinite radius.
    """
    if kind == CONE and math.cos(half_angle) < _FLAT:
        return surface_of(SPHERE, 0.0, math.inf, 0.0, contact_angle, profile)
    curvature = 1.0 / size if size > 0.0 else 0.0
    return surface_of(kind, curvature, size, half_angle, contact_angle, profile)


@kernel
def pieces_of(solid: Surface) -> int:
    """Number of its pieces."""
    if solid.kind == EDGE:
        return 3
    return 2 if solid.kind == CONE and solid.size > 0.0 else 1


@kernel
def piece_of(solid: Surface, number: int) -> Piece:
    """One of its pieces."""
    if solid.kind == CONE and solid.size > 0.0:
        start, _depth = where_begins(solid)
        if number == 0:
            return Piece(as_kind(solid, SPHERE, solid.curvature, 0.0), 0.0, start)
        return Piece(solid, start, math.inf)
    if solid.kind == EDGE and number != 1:
        if number == 0:
            return Piece(as_kind(solid, SPHERE, 0.0, 0.0), 0.0, solid.size)
        return Piece(as_kind(solid, SIDE, 0.0, solid.size), 0.0, math.inf)
    return Piece(solid, 0.0, reach_of(solid) if solid.kind == DRAWN else math.inf)


class Rooms(NamedTuple):
    """How far a contact circle lies from the inner and the outer end of a piece, positive on it."""

    inner: float
    outer: float


@kernel
def rooms_on(piece: Piece, end: End, height: float) -> Rooms:
    """The room of a contact circle on a piece; on the side of a cylinder ``height`` tells how far behind the end."""
    surface = piece.surface
    if surface.kind == SIDE:
        return Rooms(height / surface.size, math.inf)
    if surface.kind == RING:
        return Rooms(math.inf, math.inf)
    if surface.kind == EDGE:
        slope = asked_slope(surface, end.cos_slope, end.sin_slope)
        return Rooms(slope, 0.5 * math.pi - slope)
    inner = end.radius / piece.inner - 1.0 if piece.inner > 0.0 else math.inf
    return Rooms(inner, 1.0 - end.radius / piece.outer)


@kernel
def has_ends(piece: Piece) -> bool:
    """Whether a contact circle can come to an end of a piece."""
    kind = piece.surface.kind
    return kind in (SIDE, EDGE) or piece.inner > 0.0 or piece.outer < math.inf


@kernel
def is_flat(solid: Surface) -> bool:
    """Whether a solid has a flat end, of which two leave no room for liquid in contact."""
    return is_pinning(solid) or is_plane(solid)


@kernel
def are_alike(solid: Surface, other: Surface) -> bool:
    """Whether two solids are the same."""
    alike = (
        solid.kind == other.kind
        and solid.contact_angle == other.contact_angle
        and solid.curvature == other.curvature
        and solid.size == other.size
        and solid.cos_slope == other.cos_slope
        and solid.sin_slope == other.sin_slope
        and solid.profile.shape[0] == other.profile.shape[0]
    )
    if alike:
        for i in range(solid.profile.shape[0]):
            for k in range(5):
                alike = alike and solid.profile[i, k] == other.profile[i, k]
    return alike
