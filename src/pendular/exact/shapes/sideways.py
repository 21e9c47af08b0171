r"""Whether the liquid of a bridge slips to one side: the ladder of equations for the modes that shift or tilt it.

Such a displacement u(s) cos α solves the equation of the second variation where it comes from a motion of the whole
meniscus: a shift across the axis, :math:`t = \cos\varphi`, or a turn about a point of it, :math:`r = x\cos\varphi +
Y\sin\varphi`. With both contact circles held, then one free, then both, the determinants of what is asked at the ends
count the directions in which the energy falls; the pair (t, r) turns one way all along, which counts those of held
circles. Modes that go twice or more about the axis cost more than these.
"""

import math

from ...ground.compile import kernel
from .. import clearance
from ..algebra import Four, determinant
from ..equations import Held, curvature_of, force_of
from ..meridian import End, middle_of, place_after, turn_of
from ..solids.surface import SIDE, Surface
from .retold import retold
from .side import AnySystem
from .surfaces import contact_with

_STEPS = 256

_radius_range = retold(clearance.radius_range)


@kernel
def _motion(end: End, side: float, place: float, curvature: float) -> tuple[Four, Four, Four]:
    """Rates of ln Y, of the place and of the outward slope of an end in a turn, a shift, and slides along the arc."""
    cosine, sine, radius = end.cos_slope, side * end.sin_slope, end.radius
    bend = curvature + cosine / radius
    first, second = (1.0, 0.0) if side < 0.0 else (0.0, 1.0)
    grown = Four(place / radius, 1.0 / radius, first * sine / radius, second * sine / radius)
    along = Four(-radius, 0.0, first * cosine, second * cosine)
    tilted = Four(side, 0.0, side * first * bend, side * second * bend)
    return grown, along, tilted


@kernel
def _mixed(a: float, x: Four, b: float, y: Four) -> Four:
    return Four(a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2], a * x[3] + b * y[3])


@kernel
def _freed(end: End, side: float, surface: Surface, motion: tuple[Four, Four, Four]) -> tuple[Four, Four]:
    """Rates of the contact equation and of the distance from the solid."""
    grown, along, tilted = motion
    contact = contact_with(surface, end.radius, end.cos_slope, end.sin_slope)
    missed = _mixed(contact.mismatch_by_radius, grown, contact.mismatch_by_slope, tilted)
    if surface.kind == SIDE:  # a cone that is ever so steep
        return missed, _mixed(0.0, along, -side, grown)
    lift = _mixed(contact.height_by_radius, grown, contact.height_by_slope, tilted)
    return missed, _mixed(1.0, along, -side, lift)


@kernel
def _between_held_circles(z: Four, system: AnySystem) -> int:
    """Directions that lead down while both contact circles are held: half turns of (t, r) along the arc."""
    force, curvature = force_of(z), curvature_of(z)
    least, most = _radius_range(z, system)
    if min(force / least - 0.5 * curvature * least, force / most - 0.5 * curvature * most) > 0.0:
        return 0
    middle, length = middle_of(z), math.exp(z.log_length)
    place = cosine_before = angle_before = turned = 0.0
    for i in range(_STEPS + 1):
        share = 2.0 * i / _STEPS - 1.0
        zeta = place_after(middle, length, share, turn_of(z.turn * share)).zeta
        cosine = zeta.real / math.hypot(zeta.real, zeta.imag)
        if i > 0:
            place += (cosine + cosine_before) * length / _STEPS
        angle = math.atan2(place * cosine + zeta.imag, cosine)
        if i > 0:
            change = angle - angle_before
            turned += change - 2.0 * math.pi * math.floor(change / (2.0 * math.pi) + 0.5)
        cosine_before, angle_before = cosine, angle
    return max(math.ceil(abs(turned) / math.pi) - 1, 0)


@kernel
def sideways_directions(z: Four, system: AnySystem, held: Held) -> int:
    """Directions to one side in which the energy falls."""
    curvature = curvature_of(z)
    first, second = system.first, system.second
    motion1, motion2 = _motion(first, -1.0, 0.0, curvature), _motion(second, 1.0, system.length.value, curvature)
    free1, free2 = _freed(first, -1.0, held.first, motion1), _freed(second, 1.0, held.second, motion2)  # type: ignore
    both_held = determinant(motion1[0], motion1[1], motion2[0], motion2[1])
    one_free = determinant(free1[0], free1[1], motion2[0], motion2[1])
    both_free = determinant(free1[0], free1[1], free2[0], free2[1])
    count = _between_held_circles(z, system)
    return count + (1 if both_held * one_free < 0.0 else 0) + (1 if one_free * both_free < 0.0 else 0)
