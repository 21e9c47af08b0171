"""What can be asked of a bridge: contact with both solids, separation, volume, curvature, each with its rates.

A question is a choice of four of these equations; their matrix of rates gives Newton's step, the tangent of a curve of
bridges, the stiffness and the stability.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from .algebra import Four
from .meridian import End, Row, ends_of, measure_arc
from .solids import Contact, Solid, contact_with

SUCTION, VOLUME = 0, 1  # what is held


class Held(NamedTuple):
    """Two solids and what is held constant between them: H, or V/π."""

    first: Solid
    second: Solid
    control: int  # SUCTION or VOLUME
    value: float


class System(NamedTuple):
    """All equations at one meridian."""

    contact1: Row  # zero where the meridian meets solid 1 at its contact angle
    contact2: Row
    separation: Row  # D = X - h1 - h2
    volume: Row  # V/π
    first_gap: Row  # X - h1
    length: Row  # X
    first: End
    second: End


@kernel
def _rates(by_radius: float, by_slope: float, end: End) -> Four:
    """Rates of a quantity that depends on ln Y and ψ of an end."""
    a, b = end.growth, end.tilt
    return Four(
        by_radius * a[0] + by_slope * b[0],
        by_radius * a[1] + by_slope * b[1],
        by_radius * a[2] + by_slope * b[2],
        by_radius * a[3] + by_slope * b[3],
    )


@kernel
def _less(row: Row, value: float, rates: Four) -> Row:
    old = row.rates
    return Row(row.value - value, Four(old[0] - rates[0], old[1] - rates[1], old[2] - rates[2], old[3] - rates[3]))


@kernel
def _less_height(row: Row, contact: Contact, end: End) -> Row:
    return _less(row, contact.height, _rates(contact.height_by_radius, contact.height_by_slope, end))


@kernel
def _less_cap(row: Row, contact: Contact, end: End) -> Row:
    return _less(row, contact.cap, _rates(contact.cap_by_radius, contact.cap_by_slope, end))


@kernel
def system_at(z: Four, held: Held, fine: bool, with_volume: bool) -> System:
    """All equations at a meridian; without the volume its row holds nothing."""
    length, liquid = measure_arc(z, fine, with_volume)
    first, second = ends_of(z)
    return system_of(length, liquid, first, second, held, with_volume)


@kernel
def system_of(length: Row, liquid: Row, first: End, second: End, held: Held, with_volume: bool) -> System:
    """All equations at an arc with its length, its volume of revolution and its ends, in any four numbers."""
    contact1 = contact_with(held.first, first.radius, first.cos_slope, first.sin_slope)
    contact2 = contact_with(held.second, second.radius, second.cos_slope, second.sin_slope)
    return system_between(length, liquid, first, second, contact1, contact2, with_volume)


@kernel
def system_between(
    length: Row, liquid: Row, first: End, second: End, contact1: Contact, contact2: Contact, with_volume: bool
) -> System:
    """The same where it is known what the contact circles amount to."""
    first_gap = _less_height(length, contact1, first)
    if with_volume:
        liquid = _less_cap(_less_cap(liquid, contact1, first), contact2, second)
    return System(
        Row(contact1.mismatch, _rates(contact1.mismatch_by_radius, contact1.mismatch_by_slope, first)),
        Row(contact2.mismatch, _rates(contact2.mismatch_by_radius, contact2.mismatch_by_slope, second)),
        _less_height(first_gap, contact2, second),
        liquid,
        first_gap,
        length,
        first,
        second,
    )


@kernel
def curvature_of(z: Four) -> float:
    """H = ω/ℓ."""
    return z.turn * math.exp(-z.log_length)


@kernel
def curvature_rates(z: Four) -> Four:
    """Rates of ℓH: those of H, scaled."""
    return Four(0.0, 0.0, -z.turn, 1.0)


@kernel
def force_of(z: Four) -> float:
    """λ = Ym cos φm + H Ym²/2, the first integral of the Young-Laplace equation."""
    radius = math.exp(z.log_radius)
    return radius * (math.cos(z.slope) + 0.5 * curvature_of(z) * radius)


@kernel
def force_rates(z: Four) -> Four:
    """Rates of λ."""
    radius = math.exp(z.log_radius)
    bent = 0.5 * curvature_of(z) * radius * radius
    across = radius * math.cos(z.slope)
    return Four(
        across + 2.0 * bent, -radius * math.sin(z.slope), -bent, 0.5 * radius * radius * math.exp(-z.log_length)
    )


@kernel
def held_row(z: Four, system: System, held: Held) -> Row:
    """Relative miss of what is held, and its rates."""
    if held.control == SUCTION:
        length = math.exp(z.log_length)
        target = held.value * length
        return Row(z.turn - target, Four(0.0, 0.0, -target, 1.0))
    return volume_row(system, held)


@kernel
def volume_row(system: System, held: Held) -> Row:
    """Relative miss of a volume that is held, and its rates."""
    rates = system.volume.rates
    unit = 1.0 / held.value
    return Row(
        system.volume.value * unit - 1.0, Four(rates[0] * unit, rates[1] * unit, rates[2] * unit, rates[3] * unit)
    )


@kernel
def first_row(z: Four, system: System, symmetric: bool) -> Row:
    """The first contact; between mirror images the second says the same, and the symmetry takes its place."""
    return Row(z.slope, Four(0.0, 1.0, 0.0, 0.0)) if symmetric else system.contact1
