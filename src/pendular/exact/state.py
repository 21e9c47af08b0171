"""Everything about a bridge, from the four numbers of its meridian."""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from .algebra import Four, dot, minors, normal, ratio
from .clearance import is_clear, opening_of
from .equations import SUCTION, Held, curvature_of, first_row, force_of, force_rates, held_row, system_at
from .meridian import extreme_phases, middle_of, tensor_of
from .solids import contact_with, half_filling_angle, wetted_area
from .stability import ladder_at

_ROUNDING = 2e-15  # of places along an arc, over its size


class State(NamedTuple):
    """An equilibrium bridge, reduced (γ = 1). All NaN where there is none."""

    separation: float  # D
    curvature: float  # H
    force: float  # λ
    volume: float  # V
    area: float  # liquid-gas
    across_tensor: float  # n11 = π∫Y cos²φ ds, one of the two equal components across the axis
    axial_tensor: float  # n33 = 2π∫Y sin²φ ds
    stiffness: float  # dλ/dD with the given control held
    neck_radius: float  # Y0 of the surface; NaN for one that pushes, which has no neck
    neck_inside: float  # 1 if the neck lies between the solids
    radius1: float  # contact circles
    radius2: float
    filling1: float  # half-filling angles, 0 on a plane
    filling2: float
    wetted_area1: float
    wetted_area2: float
    middle_radius: float  # the meridian, for drawing: radius and slope in the middle of its arc,
    middle_slope: float
    half_length: float  # and half its arc length
    unstable_directions: float  # axisymmetric ones, under the given control
    sideways_stable: float  # 1 if the liquid does not slip to one side; between planes it lies anywhere alike


@kernel
def neck_of(z: Four) -> tuple[float, bool]:
    """Neck radius Y0 = 2λ/(1 + q), and whether the neck lies between the solids: NaN for a bridge that pushes."""
    force = force_of(z)
    if not force > 0.0:
        return math.nan, False
    middle, curvature = middle_of(z), curvature_of(z)
    # √(1 + 2Hλ) would lose half the digits at q = 0, a cylinder
    q = math.hypot(1.0 + curvature * middle.real, curvature * middle.imag)
    return 2.0 * force / (1.0 + q), extreme_phases(z)[0] > 0


class Description(NamedTuple):
    """A state, and what tells whether it answers a question."""

    state: State
    is_bridge: bool  # contact circles on the right side of the solids, a meniscus that enters neither
    miss: float  # largest one of the contact equations and, relative to it, of what is held; rounding is no miss


@kernel
def _beyond(rounding: float, miss: float) -> float:
    """How far a miss exceeds what rounding leaves."""
    return max(abs(miss) - rounding, 0.0)


@kernel
def describe(z: Four, held: Held, symmetric: bool) -> Description:
    """Everything about a bridge, measured anew from its four numbers."""
    system = system_at(z, held, True, True)
    first, second = system.first, system.second
    contact1 = contact_with(held.first, first.radius, first.cos_slope, first.sin_slope)
    contact2 = contact_with(held.second, second.radius, second.cos_slope, second.sin_slope)
    held_back = held_row(z, system, held)
    row = first_row(z, system, symmetric)
    tangent = normal(minors(row.rates, system.contact2.rates), held_back.rates)
    ladder = ladder_at(z, system)
    force = force_of(z)
    across, axial = tensor_of(z)
    neck, neck_inside = neck_of(z)
    state = State(
        system.separation.value,
        curvature_of(z),
        force,
        math.pi * system.volume.value,
        2.0 * across + axial,
        across,
        axial,
        ratio(dot(force_rates(z), tangent), dot(system.separation.rates, tangent)),
        neck,
        1.0 if neck_inside else 0.0,
        first.radius,
        second.radius,
        half_filling_angle(held.first, first.radius, first.cos_slope, first.sin_slope),
        half_filling_angle(held.second, second.radius, second.cos_slope, second.sin_slope),
        wetted_area(first.radius, contact1.height),
        wetted_area(second.radius, contact2.height),
        math.exp(z.log_radius),
        z.slope,
        math.exp(z.log_length),
        float(ladder.at_suction if held.control == SUCTION else ladder.at_volume),
        1.0 if force >= 0.0 or held.first.curvature + held.second.curvature == 0.0 else 0.0,
    )
    # a small circle is as uncertain as its place on a long arc; so is the volume of a film, a difference of large ones
    length = math.exp(z.log_length)
    place = _ROUNDING * (math.exp(z.log_radius) + length)
    widest = max(first.radius, second.radius)
    swept = 0.0 if held.control == SUCTION else 2.0 * _ROUNDING * widest * widest * length / held.value
    contacts = max(
        _beyond(place / first.radius, system.contact1.value), _beyond(place / second.radius, system.contact2.value)
    )
    miss = max(contacts, _beyond(swept, held_back.value))
    return Description(state, opening_of(z, system, held) > 0.0 and is_clear(z, system, held), miss)
