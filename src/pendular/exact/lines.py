r"""Contact lines that stay on their solid until an angle is reached: other equations in the place of contact.

A line that is pinned on a circle of radius r has

.. math:: Y/r - 1 = 0 ,

while its angle θ = π/2 - δ - ψ lies between the receding and the advancing one; at one of these it slides, outwards or
inwards, by the equation of contact at that angle. The cap below a pinned line is what it is; so the ladder of stability
holds with these rows as it stands, since a rung that would free a pinned line changes nothing.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from .algebra import Four, dot
from .equations import Held, System, system_between
from .meridian import End, Row, ends_of, measure_arc
from .solids import (
    Contact,
    Solid,
    contact_with,
    half_filling_angle,
    half_filling_cosine,
    half_filling_sine,
    solid_of,
    wetted_area,
)

# What a line does; a free one has one angle for both ways.
PINNED, ADVANCING, RECEDING, FREE = 0, 1, 2, 3


class Ring(NamedTuple):
    """A contact circle that a line has on its solid."""

    filling: float  # δ, 0 on a plane
    radius: float
    height: float  # of the cap below it
    cap: float  # its volume over π


class Line(NamedTuple):
    """A contact line: its solid at both angles, what it does, and what it has dissipated."""

    advancing: Solid
    receding: Solid
    cosine: float  # of the angle that counts in the energy
    mode: int
    limit: int  # 1 at the advancing angle, -1 at the receding one, 0 between them
    ring: Ring  # where it is pinned, or was last
    dissipated: float  # over the surface tension


class Lines(NamedTuple):
    """Both contact lines of a bridge."""

    first: Line
    second: Line
    symmetric: bool  # kept mirror images


@kernel
def slid_on(line: Line) -> Solid:
    """The solid at the angle at which its line slides."""
    return line.receding if line.mode == RECEDING else line.advancing


@kernel
def _contact_of(line: Line, end: End) -> Contact:
    if line.mode == PINNED:
        ring = line.ring
        growth = end.radius / ring.radius
        return Contact(growth - 1.0, growth, 0.0, ring.height, 0.0, 0.0, ring.cap, 0.0, 0.0)
    return contact_with(slid_on(line), end.radius, end.cos_slope, end.sin_slope)


@kernel
def system_on(z: Four, lines: Lines, fine: bool, with_volume: bool) -> System:
    """All equations at a meridian between two lines."""
    length, liquid = measure_arc(z, fine, with_volume)
    first, second = ends_of(z)
    contact1, contact2 = _contact_of(lines.first, first), _contact_of(lines.second, second)
    return system_between(length, liquid, first, second, contact1, contact2, with_volume)


@kernel
def first_row_on(z: Four, system: System, lines: Lines) -> Row:
    """The row of the first line; between mirror images the second says the same, and the symmetry takes its place."""
    return Row(z.slope, Four(0.0, 1.0, 0.0, 0.0)) if lines.symmetric else system.contact1


@kernel
def angle_of(line: Line, end: End) -> float:
    """The contact angle at a line."""
    if line.mode != PINNED:
        return slid_on(line).contact_angle
    angle = 0.5 * math.pi - line.ring.filling - math.atan2(end.sin_slope, end.cos_slope)
    return angle if angle > -0.5 * math.pi else angle + 2.0 * math.pi


@kernel
def angle_rate(line: Line, end: End, along: Four) -> float:
    """Rate of the contact angle along a direction."""
    return -dot(end.tilt, along) if line.mode == PINNED else 0.0


@kernel
def motion_of(line: Line, end: End, along: Four) -> float:
    """Rate of the way of a line along its solid, outwards."""
    if line.mode == PINNED:
        return 0.0
    solid, contact = slid_on(line), _contact_of(line, end)
    widening, tilting = dot(end.growth, along), dot(end.tilt, along)
    rising = contact.height_by_radius * widening + contact.height_by_slope * tilting
    cosine = half_filling_cosine(solid, end.cos_slope, end.sin_slope)
    return cosine * end.radius * widening + half_filling_sine(solid, end.cos_slope, end.sin_slope) * rising


@kernel
def _ring_on(solid: Solid, end: End) -> Ring:
    contact = contact_with(solid, end.radius, end.cos_slope, end.sin_slope)
    filling = half_filling_angle(solid, end.radius, end.cos_slope, end.sin_slope)
    return Ring(filling, end.radius, contact.height, contact.cap)


@kernel
def line_at(curvature: float, angle: float, advancing: float, receding: float, end: End) -> Line:
    """A line at rest where a bridge ends at an angle, which counts in the energy as well."""
    solid = solid_of(curvature, angle)
    limit = 1 if angle >= advancing else (-1 if angle <= receding else 0)
    mode = FREE if advancing == receding else PINNED
    outer, inner = solid_of(curvature, advancing), solid_of(curvature, receding)
    return Line(outer, inner, solid.cos_angle, mode, limit, _ring_on(solid, end), 0.0)


@kernel
def _placed(line: Line, end: End) -> Line:
    """A line with its ring as it is, and with what it has dissipated on its way there."""
    if line.mode == PINNED:
        return line
    solid = slid_on(line)
    ring = _ring_on(solid, end)
    more = wetted_area(ring.radius, ring.height) - wetted_area(line.ring.radius, line.ring.height)
    dissipated = line.dissipated + (line.cosine - solid.cos_angle) * more
    return Line(line.advancing, line.receding, line.cosine, line.mode, line.limit, ring, dissipated)


@kernel
def placed(lines: Lines, first: End, second: End) -> Lines:
    """Both lines with their rings as they are."""
    return Lines(_placed(lines.first, first), _placed(lines.second, second), lines.symmetric)


@kernel
def with_limit(line: Line, limit: int) -> Line:
    """A line that is told where its angle is."""
    return Line(line.advancing, line.receding, line.cosine, line.mode, limit, line.ring, line.dissipated)


@kernel
def set_sliding(line: Line, slides: bool) -> Line:
    """A line that slides, if it is at one of its angles, or stays."""
    mode = line.mode
    if mode != FREE:
        mode = PINNED
        if slides and line.limit != 0:
            mode = ADVANCING if line.limit > 0 else RECEDING
    return Line(line.advancing, line.receding, line.cosine, mode, line.limit, line.ring, line.dissipated)


@kernel
def has_choice(line: Line) -> bool:
    """Whether a line may slide or stay."""
    return line.mode != FREE and line.limit != 0


@kernel
def held_at(lines: Lines, first: End, second: End, control: int, value: float) -> Held:
    """The solids at the contact angles as they are, and what is held between them."""
    return Held(
        solid_of(lines.first.advancing.curvature, angle_of(lines.first, first)),
        solid_of(lines.second.advancing.curvature, angle_of(lines.second, second)),
        control,
        value,
    )
