r"""Whether the liquid of a bridge slips to one side: the ladder of equations for the modes that shift or tilt it.

Such a displacement u(s) cos α solves the equation of the second variation where it comes from a motion of the whole
meniscus: a shift across the axis, :math:`t = \cos\varphi`, or a turn about a point of it, :math:`r = x\cos\varphi +
Y\sin\varphi`. With both contact circles held, then one free, then both, the determinants of what is asked at the ends
count the directions in which the energy falls; the pair (t, r) turns one way all along, which counts those of held
circles. Modes that go twice or more about the axis cost more than these.
"""

import math

import numpy as np

from ..algebra import Four, determinant
from ..clearance import radius_range
from ..equations import Held, System, curvature_of, force_of
from ..meridian import End
from ..solids.edge import Side
from .surfaces import Surface, contact_with

_SAMPLES = 257


def _motion(end: End, side: float, place: float, curvature: float) -> tuple[Four, Four, Four]:
    """Rates of ln Y, of the place and of the outward slope of an end in a turn, a shift, and slides along the arc."""
    cosine, sine, radius = end.cos_slope, side * end.sin_slope, end.radius
    bend = curvature + cosine / radius
    first, second = (1.0, 0.0) if side < 0.0 else (0.0, 1.0)
    grown = Four(place / radius, 1.0 / radius, first * sine / radius, second * sine / radius)
    along = Four(-radius, 0.0, first * cosine, second * cosine)
    tilted = Four(side, 0.0, side * first * bend, side * second * bend)
    return grown, along, tilted


def _mixed(a: float, x: Four, b: float, y: Four) -> Four:
    return Four(a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2], a * x[3] + b * y[3])


def _freed(end: End, side: float, surface: Surface, motion: tuple[Four, Four, Four]) -> tuple[Four, Four]:
    """Rates of the contact equation and of the distance from the solid."""
    grown, along, tilted = motion
    contact = contact_with(surface, end.radius, end.cos_slope, end.sin_slope)
    missed = _mixed(contact.mismatch_by_radius, grown, contact.mismatch_by_slope, tilted)
    if isinstance(surface, Side):  # a cone that is ever so steep
        return missed, _mixed(0.0, along, -side, grown)
    lift = _mixed(contact.height_by_radius, grown, contact.height_by_slope, tilted)
    return missed, _mixed(1.0, along, -side, lift)


def _between_held_circles(z: Four, system: System) -> int:
    """Directions that lead down while both contact circles are held: half turns of (t, r) along the arc."""
    force, curvature = force_of(z), curvature_of(z)
    least, most = radius_range(z, system)
    if min(force / least - 0.5 * curvature * least, force / most - 0.5 * curvature * most) > 0.0:
        return 0
    length = math.exp(z.log_length)
    shares = np.linspace(-1.0, 1.0, _SAMPLES)
    turn = z.turn * shares
    middle = math.exp(z.log_radius) * np.exp(1j * z.slope)
    zeta = middle * np.exp(1j * turn) + 1j * length * shares * np.exp(0.5j * turn) * np.sinc(0.5 * turn / np.pi)
    across = zeta / np.abs(zeta)
    steps = 0.5 * (across.real[1:] + across.real[:-1]) * length * 2.0 / (_SAMPLES - 1)
    place = np.concatenate([[0.0], np.cumsum(steps)])
    angle = np.unwrap(np.arctan2(place * across.real + zeta.imag, across.real))
    return max(math.ceil(abs(angle[-1] - angle[0]) / math.pi) - 1, 0)


def sideways_directions(z: Four, system: System, held: Held) -> int:
    """Directions to one side in which the energy falls."""
    curvature = curvature_of(z)
    first, second = system.first, system.second
    motion1, motion2 = _motion(first, -1.0, 0.0, curvature), _motion(second, 1.0, system.length.value, curvature)
    free1, free2 = _freed(first, -1.0, held.first, motion1), _freed(second, 1.0, held.second, motion2)
    both_held = determinant(motion1[0], motion1[1], motion2[0], motion2[1])
    one_free = determinant(free1[0], free1[1], motion2[0], motion2[1])
    both_free = determinant(free1[0], free1[1], free2[0], free2[1])
    count = _between_held_circles(z, system)
    return count + (1 if both_held * one_free < 0.0 else 0) + (1 if one_free * both_free < 0.0 else 0)
