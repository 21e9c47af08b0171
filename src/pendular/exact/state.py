"""Everything about a bridge, from the four numbers of its meridian."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import Four, dot, minors, normal, ratio
from .clearance import is_clear, opening_of
from .equations import SUCTION, Held, System, curvature_of, first_row, force_of, force_rates, held_row, system_at
from .meridian import Row, extreme_phases, middle_of, tensor_of
from .solids import contact_with, half_filling_angle, wetted_area
from .stability import ladder_at

Rows = NDArray[np.float64]

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
def state_in(row: Rows) -> State:
    """The state in a row."""
    return State(
        row[0], row[1], row[2], row[3], row[4], row[5], row[6], row[7], row[8], row[9], row[10], row[11], row[12],
        row[13], row[14], row[15], row[16], row[17], row[18], row[19], row[20],
    )  # fmt: skip


STIFFNESS, HALF_LENGTH, UNSTABLE_DIRECTIONS = (
    State._fields.index(name) for name in ("stiffness", "half_length", "unstable_directions")
)


class Figure(NamedTuple):
    """What an arc amounts to beside its equations, in whatever numbers it is given."""

    middle_radius: float
    middle_slope: float
    half_length: float
    curvature: float  # H
    force: float  # λ
    force_rates: Four
    ratio: float  # |1 + Hζ|, the same all along
    necks: int  # strictly inside
    bulges: int
    across: float  # n11
    axial: float  # n33


@kernel
def figure_of(z: Four) -> Figure:
    """What a meridian amounts to beside its equations."""
    middle, curvature = middle_of(z), curvature_of(z)
    necks, bulges = extreme_phases(z)
    across, axial = tensor_of(z)
    return Figure(
        math.exp(z.log_radius),
        z.slope,
        math.exp(z.log_length),
        curvature,
        force_of(z),
        force_rates(z),
        math.hypot(1.0 + curvature * middle.real, curvature * middle.imag),
        necks,
        bulges,
        across,
        axial,
    )


@kernel
def sideways_of(force: float, held: Held) -> float:
    """1 if the liquid does not slip to one side."""
    return 1.0 if force >= 0.0 or held.first.curvature + held.second.curvature == 0.0 else 0.0


@kernel
def state_of(figure: Figure, system: System, held: Held, row: Row, held_back: Row, unstable: int) -> State:
    """The state of a figure; ``row`` is the first contact or what stands for it, ``held_back`` what is held."""
    first, second, force = system.first, system.second, figure.force
    contact1 = contact_with(held.first, first.radius, first.cos_slope, first.sin_slope)
    contact2 = contact_with(held.second, second.radius, second.cos_slope, second.sin_slope)
    tangent = normal(minors(row.rates, system.contact2.rates), held_back.rates)
    return State(
        system.separation.value,
        figure.curvature,
        force,
        math.pi * system.volume.value,
        2.0 * figure.across + figure.axial,
        figure.across,
        figure.axial,
        ratio(dot(figure.force_rates, tangent), dot(system.separation.rates, tangent)),
        # √(1 + 2Hλ) in the place of the ratio would lose half the digits of a cylinder, where it is 0
        2.0 * force / (1.0 + figure.ratio) if force > 0.0 else math.nan,
        1.0 if force > 0.0 and figure.necks > 0 else 0.0,
        first.radius,
        second.radius,
        half_filling_angle(held.first, first.radius, first.cos_slope, first.sin_slope),
        half_filling_angle(held.second, second.radius, second.cos_slope, second.sin_slope),
        wetted_area(first.radius, contact1.height),
        wetted_area(second.radius, contact2.height),
        figure.middle_radius,
        figure.middle_slope,
        figure.half_length,
        float(unstable),
        sideways_of(force, held),
    )


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
def miss_of(system: System, held: Held, held_miss: float, radius: float, length: float) -> float:
    """Largest miss of the contact equations and of what is held, for an arc of a radius and half a length."""
    first, second = system.first.radius, system.second.radius
    # a small circle is as uncertain as its place on a long arc; so is the volume of a film, a difference of large ones
    place = _ROUNDING * (radius + length)
    widest = max(first, second)
    swept = 0.0 if held.control == SUCTION else 2.0 * _ROUNDING * widest * widest * length / held.value
    contacts = max(_beyond(place / first, system.contact1.value), _beyond(place / second, system.contact2.value))
    return max(contacts, _beyond(swept, held_miss))


@kernel
def describe(z: Four, held: Held, symmetric: bool) -> Description:
    """Everything about a bridge, measured anew from its four numbers."""
    system = system_at(z, held, True, True)
    held_back = held_row(z, system, held)
    ladder = ladder_at(z, system)
    unstable = ladder.at_suction if held.control == SUCTION else ladder.at_volume
    figure = figure_of(z)
    state = state_of(figure, system, held, first_row(z, system, symmetric), held_back, unstable)
    miss = miss_of(system, held, held_back.value, figure.middle_radius, figure.half_length)
    return Description(state, opening_of(z, system, held) > 0.0 and is_clear(z, system, held), miss)
