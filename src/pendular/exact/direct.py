"""The straight way to a bridge: from the closed guess by Newton's method in algebraic numbers, proven and stored.

It answers nearly all bridges that are asked. What it does not answer beyond doubt it leaves to the rest of the solver.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import Four, largest
from .arc import (
    HALF_A_TURN,
    Arc,
    arc_after,
    force_on,
    force_rates_on,
    half_length_of,
    is_fit,
    kept,
    meridian_of,
    ratio_of,
    room_of,
    sums_of,
    system_on,
)
from .clearance import extrema_between, is_beyond_doubt
from .equations import SUCTION, VOLUME, Held, System, curvature_rates, volume_row
from .guess import start_at_suction, start_at_volume
from .meridian import Row, extreme_phases
from .newton import LONGEST_STEP, NO_STEP, held_target, left_after, step_to
from .stability import ladder_of
from .state import HALF_LENGTH, Figure, State, miss_of, sideways_of, state_of
from .suction import beyond_fold

Rows = NDArray[np.float64]

FORCE_ALONE, ALL, FORCE_TO_GO_ON = 0, 1, 2  # what is stored of a bridge; the last with its meridian

_MOST_STEPS = 12
_WIDENED = (1.0, 1.35, 1.82, 2.46)  # of the contact circles of the guess under suction, next to a fold
_COARSE_STEP = 1e-3  # from which on all nodes are used
_LEFT, _LEFT_OF_FORCE = 1e-14, 1e-11  # largest change that would follow
_LARGEST_MISS = 1e-10
_SEPARATION, _CURVATURE, _FORCE, _UNSTABLE, _SIDEWAYS, _MIDDLE, _SLOPE = map(
    State._fields.index,
    ("separation", "curvature", "force", "unstable_directions", "sideways_stable", "middle_radius", "middle_slope"),
)


class Met(NamedTuple):
    """Where Newton's method ended."""

    arc: Arc
    system: System  # of the step before
    is_met: bool


@kernel
def start_of(held: Held, separation: float, widened: float) -> Arc:
    """The arc of the closed guess."""
    if held.control == SUCTION:
        start = start_at_suction(held, separation, widened == 1.0, widened)
    else:
        start = start_at_volume(held, separation)
    half = 0.5 * start.turn
    square = half * half
    stretch = (1.0 - square / 15.0) / (1.0 - 0.4 * square)  # tan x over x, to four digits
    width = start.half_length * stretch
    eta = held.value * width if held.control == SUCTION else start.turn * stretch
    return Arc(start.middle * start.cos_tilt, start.tan_tilt, width, eta)


@kernel
def _change_at_suction(system: System, eta: float, separation: float) -> Four:
    """Newton's step with H held: η grows with τ."""
    one, other, gap = system.contact1.rates, system.contact2.rates, system.separation.rates
    a, b, c = one[0], one[1], one[2] + eta * one[3]
    d, e, f = other[0], other[1], other[2] + eta * other[3]
    g, h, i = gap[0], gap[1], gap[2] + eta * gap[3]
    across0, across1, across2 = b * f - c * e, c * d - a * f, a * e - b * d
    inverse = 1.0 / (across0 * g + across1 * h + across2 * i)
    at1, at2, at_gap = -system.contact1.value, -system.contact2.value, separation - system.separation.value
    by_width = ((d * h - e * g) * at1 + (b * g - a * h) * at2 + across2 * at_gap) * inverse
    return Four(
        ((e * i - f * h) * at1 + (c * h - b * i) * at2 + across0 * at_gap) * inverse,
        ((f * g - d * i) * at1 + (a * i - c * g) * at2 + across1 * at_gap) * inverse,
        by_width,
        eta * by_width,
    )


@kernel
def system_at_arc(arc: Arc, held: Held, fine: bool) -> System:
    """The equations that what is held asks for."""
    with_volume = held.control == VOLUME
    return system_on(arc, held, sums_of(arc, room_of(arc), fine, with_volume), with_volume)


@kernel
def newton_on(arc: Arc, separation: float, held: Held, most: int, enough: float, left: float, fine: bool) -> Met:
    """From a guess to the bridge at a separation, but for what is left, or until a step was small enough.

    From a bridge near by the fine nodes are used at once.
    """
    before, is_met = math.nan, False
    for _ in range(most):
        system = system_at_arc(arc, held, fine)
        if held.control == VOLUME:
            row = volume_row(system, held)
            change = step_to(separation, system, row.rates, held_target(row, held))
        else:
            change = _change_at_suction(system, arc.eta, separation)
        size = largest(change)
        if not size < 1e6:
            break
        arc = kept(arc_after(arc, change, LONGEST_STEP / max(size, LONGEST_STEP)), held)
        if size < enough or (fine and left_after(size, before) < left):
            is_met = is_fit(arc)
            break
        if not is_fit(arc):
            break
        fine, before = fine or size < _COARSE_STEP, max(size, NO_STEP)
    return Met(arc, system, is_met)


@kernel
def extrema_of(arc: Arc, system: System) -> tuple[float, float]:
    """Numbers of necks and bulges."""
    if abs(arc.eta) > HALF_A_TURN:
        necks, bulges = extreme_phases(meridian_of(arc))
        return float(necks), float(bulges)
    return extrema_between(system.first, system.second)


@kernel
def _is_bridge(arc: Arc, system: System, held: Held, necks: float, bulges: float) -> bool:
    """Whether the arc is beyond doubt a bridge that enters neither solid."""
    force, curvature = force_on(arc), arc.eta / arc.half_width
    ratio = ratio_of(arc)
    return is_beyond_doubt(system.first, system.second, held, necks, bulges, force, curvature, ratio, arc.half_width)


@kernel
def _unstable_of(arc: Arc, system: System, held: Held) -> int:
    """Unstable directions under what is held."""
    necks, bulges = extrema_of(arc, system)
    ladder = ladder_of(system, arc.eta, int(necks + bulges), held.control == VOLUME)
    return ladder.at_suction if held.control == SUCTION else ladder.at_volume


@kernel
def met_on(arc: Arc, is_near: bool, separation: float, held: Held, wanted: int) -> Met:
    """Where Newton's method leads from an arc."""
    left = _LEFT if wanted == ALL else _LEFT_OF_FORCE
    return newton_on(arc, separation, held, _MOST_STEPS, 0.0, left, is_near)


@kernel
def _stored(met: Met, separation: float, held: Held, symmetric: bool, wanted: int, row: Rows) -> bool:
    """Store the stable bridge that Newton's method met, or of it the force alone."""
    if not met.is_met:
        return False
    if wanted == ALL:
        return all_stored(met.arc, held, symmetric, False, row)
    store_force(met.arc, separation, held, wanted, row)
    necks, bulges = extrema_of(met.arc, met.system)
    return _unstable_of(met.arc, met.system, held) == 0 and _is_bridge(met.arc, met.system, held, necks, bulges)


@kernel
def store_force(arc: Arc, separation: float, held: Held, wanted: int, row: Rows) -> None:
    """Store the force of a stable bridge, and what goes with it."""
    force = force_on(arc)
    row[:] = math.nan
    row[_SEPARATION], row[_CURVATURE], row[_FORCE] = separation, arc.eta / arc.half_width, force
    row[_UNSTABLE], row[_SIDEWAYS] = 0.0, sideways_of(force, held)
    if wanted == FORCE_TO_GO_ON:
        row[_MIDDLE], row[_SLOPE] = arc.radius * math.sqrt(1.0 + arc.slope**2), math.atan(arc.slope)
        row[HALF_LENGTH] = half_length_of(arc)


@kernel
def all_stored(arc: Arc, held: Held, symmetric: bool, is_end: bool, row: Rows) -> bool:
    """Store everything about a stable bridge, measured anew; at the end of its branch the ladder tells nothing."""
    tau, square = arc.half_width, arc.half_width * arc.half_width
    sums = sums_of(arc, room_of(arc), True, True)
    system = system_on(arc, held, sums, True)
    necks, bulges = extrema_of(arc, system)
    if not (_is_bridge(arc, system, held, necks, bulges) and (is_end or _unstable_of(arc, system, held) == 0)):
        return False
    figure = Figure(
        arc.radius * math.sqrt(1.0 + arc.slope * arc.slope),
        math.atan(arc.slope),
        half_length_of(arc),
        arc.eta / tau,
        force_on(arc),
        force_rates_on(arc),
        ratio_of(arc),
        int(necks),
        int(bulges),
        math.pi * square * sums.across,
        2.0 * math.pi * square * sums.axial,
    )
    if held.control == SUCTION:
        held_back = Row(0.0, curvature_rates(Four(0.0, 0.0, 0.0, arc.eta)))
    else:
        held_back = volume_row(system, held)
    if not miss_of(system, held, held_back.value, figure.middle_radius, figure.half_length) <= _LARGEST_MISS:
        return False
    first = Row(arc.slope, Four(0.0, 1.0, 0.0, 0.0)) if symmetric else system.contact1
    state = state_of(figure, system, held, first, held_back, 0)
    for j, value in enumerate(state):
        row[j] = value
    return True


@kernel
def straight_stored(near: Arc, separation: float, held: Held, symmetric: bool, wanted: int, row: Rows) -> bool:
    """Store the stable bridge to which Newton's method leads, or of it the force alone.

    From an arc near by, if its radius is above 0, else from the closed guess.
    """
    start, is_near = near, near.radius > 0.0
    for widened in _WIDENED:
        if not is_near:
            start = start_of(held, separation, widened)
        met = met_on(start, is_near, separation, held, wanted)
        if _stored(met, separation, held, symmetric, wanted, row):
            return True
        if held.control == SUCTION and met.is_met and _unstable_of(met.arc, met.system, held) == 1:
            met = met_on(beyond_fold(met.arc, held), False, separation, held, wanted)
            if _stored(met, separation, held, symmetric, wanted, row):
                return True
        if held.control == VOLUME and not is_near:
            break
        is_near = False
    return False
