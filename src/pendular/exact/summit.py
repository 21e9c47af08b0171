"""Rupture in algebraic numbers: leaps from a bridge next to it to where the separation is largest, proven and stored.

The end is a fold, or between mirror images the pitchfork at which the liquid slides to one side. What is neither beyond
doubt is left to the rest of the solver.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import Four, dot, largest, minors, moved, normal, scaled, solve4, unit_vector
from .arc import Arc, arc_after, is_fit
from .direct import all_stored, extrema_of, kept, newton_on, start_of, system_at_arc
from .equations import SUCTION, VOLUME, Held, curvature_rates, volume_row
from .follow import BRANCH_ENDS
from .guess import rupture_guess
from .locate import FOLD, LOST, PITCHFORK
from .meridian import Row
from .newton import held_target
from .stability import ladder_of
from .state import STIFFNESS

Rows = NDArray[np.float64]

_NEXT_TO_RUPTURE = 0.85  # of the estimate, where to start
_MOST_STARTS, _MOST_STEPS = 4, 10
_NEARLY = 0.05  # last Newton step to where the leaps begin
_MOST_LEAPS = 30
_FIRST_LEAP, _LONGEST_LEAP, _SHORTEST_LEAP = 0.1, 0.25, 1e-7
_LAST_TO_FOLD, _LAST_TO_PITCHFORK = 3e-10, 1e-12
_LEAST_SECANT = 1e-5  # leap below which the rate is that of the one before: rounding, and ways back, would spoil it
_LAST_WAY = 1e-11  # back to the curve, from where the end is seen
_LARGEST_WAY = 0.5  # back to the curve, over the leap
_LEAST_COSINE = 0.9
_FLAT = 1e-7  # where the signs of the ladder are those of rounding errors


class Look(NamedTuple):
    """A point near a curve of bridges that hold one thing."""

    way: Four  # back to the curve
    tangent: Four
    slope: float  # dD/ds over τ
    separation: float
    unstable: int
    margin: float  # of a symmetric bridge against sliding: it changes its sign there; else 1


@kernel
def _look(arc: Arc, held: Held, symmetric: bool, hand: float) -> Look:
    system = system_at_arc(arc, held, True)
    first = Row(arc.slope, Four(0.0, 1.0, 0.0, 0.0)) if symmetric else system.contact1
    if held.control == SUCTION:
        rates, target = curvature_rates(Four(0.0, 0.0, 0.0, arc.eta)), 0.0
    else:
        row = volume_row(system, held)
        rates, target = row.rates, held_target(row, held)
    along = scaled(hand, unit_vector(normal(minors(first.rates, system.contact2.rates), rates)))
    way, _det = solve4(
        first.rates, system.contact2.rates, rates, along, -first.value, -system.contact2.value, target, 0.0
    )
    necks, bulges = extrema_of(arc, system)
    ladder = ladder_of(system, arc.eta, int(necks + bulges), held.control == VOLUME)
    return Look(
        way,
        along,
        dot(along, system.separation.rates) / arc.half_width,
        system.separation.value,
        ladder.at_suction if held.control == SUCTION else ladder.at_volume,
        system.contact2.rates.slope if symmetric else 1.0,
    )


@kernel
def _beside(held: Held) -> tuple[Arc, float, bool]:
    """A bridge next to rupture, about, its separation, and whether one was found."""
    separation, arc = _NEXT_TO_RUPTURE * rupture_guess(held), Arc(1.0, 0.0, 1.0, 0.0)
    for _ in range(_MOST_STARTS):
        met = newton_on(start_of(held, separation, 1.0), separation, held, _MOST_STEPS, _NEARLY, 0.0, False)
        arc = met.arc
        if met.is_met:
            return arc, separation, True
        separation *= 0.75
    return arc, separation, False


@kernel
def summit_of(held: Held, symmetric: bool, stops_at: int) -> tuple[Arc, int]:
    """The end of the stable branch, and whether it is a FOLD or a PITCHFORK beyond doubt; else LOST."""
    base, separation, is_near = _beside(held)
    event, start = FOLD, base
    hand, along, value, margin = 1.0, Four(0.0, 0.0, 0.0, 0.0), math.nan, 1.0
    bend = Four(0.0, 0.0, 0.0, 0.0)  # rate of the tangent along the curve
    step, rate, last, leap = 0.0, 0.0, _LAST_TO_FOLD, 0
    while leap < _MOST_LEAPS:
        there = kept(arc_after(base, moved(along, 0.5 * step, bend), step), held)
        if not (is_near and is_fit(there)):
            break
        ahead = _look(there, held, symmetric, hand)
        leap += 1
        at_ahead = ahead.slope if event == FOLD else ahead.margin
        if leap == 1:
            if ahead.unstable != 0 or not largest(ahead.way) < 2.0 * _NEARLY:
                break
            if event == FOLD:
                hand, margin = math.copysign(1.0, ahead.slope), ahead.margin
                at_ahead = abs(at_ahead)
                along = scaled(hand, ahead.tangent)
            else:
                along = ahead.tangent
            base, value, step = kept(arc_after(there, ahead.way, 1.0), held), at_ahead, _FIRST_LEAP
            continue
        after = (1 if ahead.slope < 0.0 else 0) + (1 if ahead.margin * margin < 0.0 else 0)
        if not (
            largest(ahead.way) < _LARGEST_WAY * abs(step) + 1e-7
            and dot(ahead.tangent, along) > _LEAST_COSINE
            and (ahead.unstable == after or abs(at_ahead) < _FLAT)
        ):
            step *= 0.5
            if not abs(step) > _SHORTEST_LEAP:
                break
            continue
        sign = 1.0 if event == FOLD else math.copysign(1.0, margin)
        if abs(step) > _LEAST_SECANT:
            rate = (at_ahead - value) / step
            bend = scaled(1.0 / step, moved(ahead.tangent, -1.0, along))
        onward = -at_ahead / rate if rate * sign < 0.0 else math.copysign(_LONGEST_LEAP, at_ahead * sign)
        base, along, value = kept(arc_after(there, ahead.way, 1.0), held), ahead.tangent, at_ahead
        if abs(onward) < last and largest(ahead.way) < _LAST_WAY:
            end = kept(arc_after(base, along, onward), held)
            if event == PITCHFORK or ahead.margin * margin > 0.0:
                return end, event if ahead.separation > separation else LOST
            if stops_at != BRANCH_ENDS:
                break
            event, last, base, along = PITCHFORK, _LAST_TO_PITCHFORK, start, Four(0.0, 0.0, 0.0, 0.0)
            bend, step, leap = Four(0.0, 0.0, 0.0, 0.0), 0.0, 0
            continue
        step = max(-_LONGEST_LEAP, min(_LONGEST_LEAP, onward))
    return base, LOST


@kernel
def summit_stored(held: Held, symmetric: bool, stops_at: int, row: Rows) -> bool:
    """Store the bridge at rupture, where that is beyond doubt; at a fold the force falls infinitely fast."""
    arc, event = summit_of(held, symmetric, stops_at)
    if event == LOST or not all_stored(arc, held, symmetric, True, row):
        return False
    if event == FOLD:
        row[STIFFNESS] = -math.inf
    return True
