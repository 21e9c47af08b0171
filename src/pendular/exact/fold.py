"""Leaps along a curve of bridges to where its stable branch ends, for one row or for one in each lane.

The end is a fold, or between mirror images the pitchfork at which the liquid slides to one side.

Newton's method leads from a guess to the curve; then each leap ends where those before it foretell the end of the
branch. Nothing here decides by a branch of the code, so that lanes may disagree.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from ..ground.lanes import choose, every
from .algebra import Four, dot, largest_of, minors, moved, normal, scaled, solve4, unit_vector
from .arc import (
    W8,
    W16,
    W24,
    W48,
    X8,
    X16,
    X24,
    X48,
    Arc,
    arc_after,
    chosen,
    crowded_at,
    force_rates_on,
    kept,
    system_on,
)
from .equations import SUCTION, VOLUME, Held, System, curvature_rates, volume_row
from .locate import FOLD
from .meridian import Row
from .newton import LONGEST_STEP
from .stability import directions_of
from .volume import volume_target

_COARSE_LOOKS, _MIDDLE_LOOKS, _LOOKS_TO_CURVE = 3, 5, 6
FEW_LOOKS = 12  # that nearly all need, on fewer nodes
_NEARLY = 0.1  # way back to the curve, from where leaps begin
_LEAST_FIRST, _LONGEST_FIRST, _LONGEST_LEAP = 0.02, 0.25, 0.4
_GROWTH = 2.0  # of a leap, over the last
_LARGEST_WAY = 0.5  # back to the curve, over the leap
_LEFT_OF_WAY = 2.0  # by its square: back to the curve, after a way back
_CERTAIN_WAY = 1e-7  # back to the curve, which is that of rounding
_LEAST_COSINE = 0.9
_FLAT = 1e-7  # what vanishes at the end, where the signs of the ladder are those of rounding errors
_LEAST_SECANT = 1e-5  # leap below which the rate is that of the one before: rounding, and ways back, would spoil it
_CLEAR = 2.0  # change of the slope, over the ways back, that tells how fast it falls
_APART = 0.25  # two leaps over the last one, where they foretell the next together
_LAST, _LAST_WAY = 1e-15, 1e-11  # left to the fold, as it is foretold, and way back to the curve, at its end


class Look(NamedTuple):
    """A point near a curve of bridges that hold one thing."""

    way: Four  # back to the curve
    tangent: Four
    slope: float  # dD/ds over τ
    separation: float
    unstable: float  # directions
    margin: float  # of a symmetric bridge against sliding: it changes its sign there; else 1


class Base(NamedTuple):
    """The last bridge that was reached."""

    arc: Arc
    tangent: Four
    vanishing: float  # at the end: the slope, or the margin
    way: float  # back to the curve, that was made


class Leap(NamedTuple):
    """From one bridge to the next: its length, and how the slope and the tangent changed over it."""

    length: float
    rate: float
    bend: Four


class Met(NamedTuple):
    """Where the leaps ended."""

    arc: Arc
    is_met: bool
    has_forked: bool  # a fold, but beyond the pitchfork


@kernel
def look_at(arc: Arc, system: System, extrema: float, held: Held, symmetric: bool) -> Look:
    """An arc near a curve, with its equations and the number of extrema of its radius."""
    own, second = system.contact1, system.contact2
    first = Row(
        choose(symmetric, arc.slope, own.value),
        _either(symmetric, Four(0.0, 1.0, 0.0, 0.0), own.rates),
    )
    if held.control == SUCTION:
        nothing = 0.0 * arc.eta  # in lanes, if that is in lanes
        curvature = curvature_rates(Four(nothing, nothing, nothing, arc.eta))
        rates, target = Four(nothing, nothing, curvature[2], nothing + curvature[3]), nothing
    else:
        row = volume_row(system, held)
        rates, target = row.rates, volume_target(row.value)
    along = unit_vector(normal(minors(first.rates, second.rates), rates))
    way, _det = solve4(first.rates, second.rates, rates, along, -first.value, -second.value, target, 0.0)
    at_suction, at_volume = directions_of(system, arc.eta, extrema, held.control == VOLUME)
    return Look(
        way,
        along,
        dot(along, system.separation.rates) / arc.half_width,
        system.separation.value,
        at_suction if held.control == SUCTION else at_volume,
        choose(symmetric, second.rates.slope, 1.0),
    )


@kernel
def end_met(event: int, start: Arc, fall: float, held: Held, symmetric: bool, most: int) -> Met:
    """From about a bridge, in so many looks at most, to the FOLD or the PITCHFORK at the end of its stable branch.

    A fold is found from just beyond it, too. What is told of the end is about how fast falls what vanishes there.
    """
    nothing, with_volume = 0.0 * start.radius, held.control == VOLUME
    nowhere = Four(nothing, nothing, nothing, nothing)
    base, last = Base(kept(start, held), nowhere, nothing, nothing), Leap(nothing, nothing, nowhere)
    step, bend, hand, margin, index = nothing, nowhere, nothing, nothing, nothing
    is_on = is_met = has_forked = start.radius < 0.0
    last_nodes = (X24, W24) if most == FEW_LOOKS else (X48, W48)
    for look in range(most):
        x, weight = (X8, W8) if look < _COARSE_LOOKS else (X16, W16) if look < _MIDDLE_LOOKS else last_nodes
        there = kept(arc_after(base.arc, moved(base.tangent, 0.5 * step, bend), step), held)
        system = system_on(there, held, crowded_at(there, x, weight, with_volume), with_volume)
        ahead = look_at(there, system, extrema_on(there), held, symmetric)
        hand = choose(is_on, hand, choose(ahead.slope < 0.0, -1.0, 1.0))
        tangent, slope, back = scaled(hand, ahead.tangent), hand * ahead.slope, largest_of(ahead.way)
        # on the curve where the way back is short, on the stable branch or that beyond its end
        is_beyond = _but_not(abs(ahead.unstable - 1.0) < 0.5, symmetric)
        nearly = _NEARLY if look <= _LOOKS_TO_CURVE else 0.0
        begins = _but_not((back < nearly) & ((abs(ahead.unstable) < 0.5) | is_beyond), is_on)
        margin, index = choose(begins, ahead.margin, margin), choose(begins, ahead.unstable, index)
        vanishing = slope if event == FOLD else ahead.margin * choose(margin < 0.0, -1.0, 1.0)
        # along it, where no leap went astray, the index changes at the end alone
        passed = choose(slope < 0.0, 1.0 - index, index) + choose(ahead.margin * margin < 0.0, 1.0, 0.0)
        is_right = (
            is_on
            & (back < _LARGEST_WAY * abs(step) + _LEFT_OF_WAY * base.way * base.way + _CERTAIN_WAY)
            & (dot(tangent, base.tangent) > _LEAST_COSINE)
            & ((abs(ahead.unstable - passed) < 0.5) | (abs(vanishing) < _FLAT))
        )
        is_astray = _but_not(is_on, is_right)
        # what two leaps foretell of the next
        change = vanishing - base.vanishing
        tells = is_right & (abs(step) > _LEAST_SECANT) & (abs(change) > _CLEAR * (back + base.way))
        inverse = 1.0 / choose(tells, step, 1.0)
        leap = Leap(step, change * inverse, scaled(inverse, moved(tangent, -1.0, base.tangent)))
        share = _share_of(leap.length, last.length)
        rate = leap.rate + share * (leap.rate - last.rate)
        rate = choose(tells, choose(rate < 0.0, rate, leap.rate), last.rate)
        bend = _either(tells, moved(leap.bend, share, moved(leap.bend, -1.0, last.bend)), bend)
        last = Leap(
            choose(tells, leap.length, last.length),
            choose(begins, -fall, choose(tells, leap.rate, last.rate)),
            _either(tells, leap.bend, last.bend),
        )
        falls = rate < 0.0
        farthest = choose(vanishing < 0.0, -_LONGEST_LEAP, _LONGEST_LEAP)
        onward = choose(falls, -vanishing / choose(falls, rate, 1.0), farthest)
        shrunk = abs(onward) / choose(is_on, abs(step), 1.0)
        # next to a fold the separation does not tell what is left; next to a pitchfork it does
        left = abs(onward) * shrunk * math.sqrt(shrunk) if event == FOLD else abs(onward)
        is_last = is_right & falls & (left < _LAST) & (back < _LAST_WAY)
        longest = min(_LONGEST_LEAP, _GROWTH * abs(step))
        onward_kept = max(-longest, min(longest, onward))
        first = max(_LEAST_FIRST, min(_LONGEST_FIRST, vanishing / fall))
        step = choose(is_on, choose(is_right, onward_kept, 0.5 * step), choose(begins, first, 0.0))
        nearer = arc_after(there, ahead.way, LONGEST_STEP / max(back, LONGEST_STEP))
        end = choose(is_last, onward, 0.0)
        reached = kept(arc_after(nearer, moved(tangent, 0.5 * end, bend), end), held)
        base = Base(
            chosen(is_met | is_astray, base.arc, reached),
            _either(is_astray, base.tangent, tangent),
            choose(is_astray, base.vanishing, vanishing),
            choose(is_astray, base.way, back),
        )
        if event == FOLD:  # with the stability the force is lost, or before it the symmetry
            is_last = is_last & (dot(tangent, force_rates_on(there)) * (1.0 - 2.0 * index) < 0.0)
            has_forked = has_forked | (is_last & (ahead.margin * margin < 0.0))
            is_last = is_last & (ahead.margin * margin > 0.0)
        is_met, is_on = is_met | is_last, is_on | begins
        if every(is_met | has_forked) or (look == _LOOKS_TO_CURVE and every(_but_not(hand * hand > 0.0, is_on))):
            break
    return Met(base.arc, is_met & (base.arc.radius > 0.0), has_forked)


@kernel
def _share_of(length: float, before: float) -> float:
    """The share of the change from one leap to the next by which the one to come will change."""
    both = length + before
    is_known = (abs(before) > 0.0) & (abs(both) > _APART * abs(length))
    return choose(is_known, length / choose(is_known, both, 1.0), 0.0)


@kernel
def extrema_on(arc: Arc) -> float:
    """Number of necks and bulges strictly inside an arc: the sine of its slope is a square polynomial in v, scaled."""
    real, h = arc.radius / arc.half_width, 0.5 * arc.eta
    imag = real * arc.slope
    linear, square = 1.0 + 2.0 * h * real, h * h * imag
    first, last = imag - linear - square, imag + linear - square
    # its own extremum lies inside, on the other side of zero
    turns = (abs(linear) < 2.0 * abs(square)) & (first * (4.0 * imag * square + linear * linear) * square < 0.0)
    return choose(first * last < 0.0, 1.0, choose(turns, 2.0, 0.0))


@kernel
def _but_not(condition: bool, other: bool) -> bool:
    """Whether the first condition holds alone."""
    return choose(other, 0.0, choose(condition, 1.0, 0.0)) > 0.5


@kernel
def _either(condition: bool, one: Four, other: Four) -> Four:
    return Four(
        choose(condition, one[0], other[0]),
        choose(condition, one[1], other[1]),
        choose(condition, one[2], other[2]),
        choose(condition, one[3], other[3]),
    )
