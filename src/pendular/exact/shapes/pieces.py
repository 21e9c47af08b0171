"""The smooth pieces of a solid, in order away from its tip, and which of them a contact circle lies on."""

import math
from typing import NamedTuple

from ..meridian import End
from ..solids import Solid, solid_of
from ..solids.cone import cone_of, where_begins
from ..solids.drawn import Spline, drawn_of
from ..solids.edge import Edge, Side, edge_of, side_of
from ..solids.paraboloid import paraboloid_of
from .surfaces import Surface, asked_slope


class Piece(NamedTuple):
    """A smooth surface, and the radii between which it belongs to the solid."""

    surface: Surface
    inner: float = 0.0
    outer: float = math.inf


_FLAT = 1e-15  # slope of a cone that is a plane, to rounding

Body = tuple[Piece, ...]


def body_of_sphere(radius: float, contact_angle: float) -> Body:
    """A sphere; of an infinite radius, a plane."""
    return (Piece(solid_of(1.0 / radius, contact_angle)),)


def body_of_cone(half_angle: float, tip_radius: float, contact_angle: float) -> Body:
    """A cone, behind its cap if it has one."""
    if math.cos(half_angle) < _FLAT:
        return body_of_sphere(math.inf, contact_angle)
    cone = cone_of(half_angle, tip_radius, contact_angle)
    if tip_radius == 0.0:
        return (Piece(cone),)
    start, _depth = where_begins(cone)
    return (Piece(solid_of(1.0 / tip_radius, contact_angle), outer=start), Piece(cone, inner=start))


def body_of_paraboloid(tip_radius: float, contact_angle: float) -> Body:
    """A paraboloid."""
    return (Piece(paraboloid_of(tip_radius, contact_angle)),)


def body_of_disc(radius: float, pinned: bool, contact_angle: float) -> Body:
    """The flat end of a cylinder: its face, its edge, and its side; or the edge alone."""
    edge = Piece(edge_of(radius, contact_angle, pinned))
    face, side = Piece(solid_of(0.0, contact_angle), outer=radius), Piece(side_of(radius, contact_angle))
    return (edge,) if pinned else (face, edge, side)


def body_of_drawn(spline: Spline, unit: float, contact_angle: float) -> Body:
    """A solid that is drawn up to a radius, in a unit of length."""
    return (Piece(drawn_of(spline, unit, contact_angle), outer=float(spline.knots[-1]) / unit),)


def rooms(piece: Piece, end: End, height: float) -> tuple[float, float]:
    """How far a contact circle lies from the inner and the outer end of a piece, positive on it.

    On the side of a cylinder its height behind the end is told by ``height``.
    """
    surface = piece.surface
    if isinstance(surface, Side):
        return height / surface.radius, math.inf
    if isinstance(surface, Edge):
        if surface.is_held:
            return math.inf, math.inf
        slope = asked_slope(surface, end.cos_slope, end.sin_slope)
        return slope, 0.5 * math.pi - slope
    inner = end.radius / piece.inner - 1.0 if piece.inner > 0.0 else math.inf
    outer = 1.0 - end.radius / piece.outer
    return inner, outer


def is_flat(body: Body) -> bool:
    """Whether a solid has a flat end, of which two leave no room for liquid in contact."""
    surface = body[0].surface
    return isinstance(surface, Edge) or (isinstance(surface, Solid) and surface.curvature == 0.0)
