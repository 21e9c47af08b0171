"""Curves of equilibria, followed from one bridge to the next at a given suction, volume or separation.

A curve is followed by its tangent and corrected by Newton's method; a fold is where the driven quantity stands still,
and the curve goes on through it to the other branch.
"""

import math
from typing import NamedTuple

import numpy as np

from .._jit import kernel
from .contact import force_rate
from .equilibrium import Solids, are_equal
from .middle import Measure, Vector, correct, end_at, measure, solve4, unit_of

_FIRST_STEP, _LONGEST_STEP, _SHORTEST_STEP = 0.1, 0.5, 1e-9
_MOST_EFFORT = 6.0  # Newton steps back to the curve, and cosine of its turn, that a step may cost
_LEAST_COSINE = 0.9
_NOWHERE = 1e-12  # a target so near, in its unit, that there is no way to walk
_MAX_PATH = 400


class Curve(NamedTuple):
    """A curve of equilibria between two solids: one quantity held at its value, another driven along it."""

    solids: Solids
    held: int
    value: float
    driven: int


class Heading(NamedTuple):
    """Direction of a curve at a point."""

    tangent: Vector  # of unit length
    hand: float  # sign of the determinant of the equations and the tangent; the same along the whole curve


@kernel
def heading_at(found: Measure, z: Vector, curve: Curve, like: Vector) -> Heading:
    """Direction of the curve at z, on the side of a given vector."""
    matrix, tangent = np.empty((4, 4)), np.zeros(4)
    matrix[0], matrix[1] = found.rates[0], found.rates[1]
    matrix[2] = found.rates[curve.held] / unit_of(curve.held, z, curve.value)
    matrix[3] = like
    tangent[3] = 1.0
    hand = 1.0 if solve4(matrix, tangent) > 0.0 else -1.0
    return Heading(tangent / np.sqrt(np.dot(tangent, tangent)), hand)


# What ends a walk: the driven quantity meets its target; it turns back; the two contact circles of one λ merge,
# which is where a mirror-symmetric bridge first gives way to an antisymmetric mode; there is nothing to walk on, or to;
# the walk failed.
TARGET, FOLD, PITCHFORK, ABSENT, LOST = 0, 1, 2, 3, 4


class Walk(NamedTuple):
    """The end of a walk: why, where, and in which direction the curve goes on."""

    event: int
    z: Vector
    tangent: Vector


@kernel
def _slope(z: Vector, tangent: Vector, curve: Curve) -> float:
    """Rate of the driven quantity along the curve, in its unit."""
    found = measure(z, curve.solids)
    exact = heading_at(found, z, curve, tangent).tangent
    return np.dot(found.rates[curve.driven], exact) / unit_of(curve.driven, z, found.values[curve.driven])


@kernel
def antisymmetric_margin(z: Vector, solids: Solids) -> float:
    """Sin ψ ∂λ/∂a|_H at the contacts: positive where a mirror-symmetric bridge withstands the antisymmetric mode.

    That mode is the axial shift of the surface; it is neutral where the two contact circles of one λ merge. In a
    cylinder both factors vanish, and their product touches zero without a change of sign.
    """
    contact = end_at(z, 1.0, solids.k2, solids.theta2).contact
    return contact.sin_slope * force_rate(contact, z[3] * math.exp(-z[2]), solids.k2)


@kernel
def _sought(event: int, z: Vector, tangent: Vector, curve: Curve, target: float) -> float:
    """The function whose zero is the event."""
    if event == PITCHFORK:
        return antisymmetric_margin(z, curve.solids)
    if event == FOLD:
        return _slope(z, tangent, curve)
    return (measure(z, curve.solids).values[curve.driven] - target) / unit_of(curve.driven, z, target)


@kernel
def stride(z: Vector, tangent: Vector, step: float, curve: Curve) -> tuple[Vector, float]:
    """The point of the curve one step along the tangent, and the Newton steps it took (NaN: failed, or leapt)."""
    following = z + step * tangent
    goal = np.dot(tangent, following)
    effort = correct(following, curve.solids, curve.held, curve.value, -1, goal, tangent)
    if not np.max(np.abs(following - z)) < 2.0 * abs(step):  # on some other curve
        effort = math.nan
    return following, effort


@kernel
def _locate(event: int, z: Vector, tangent: Vector, step: float, curve: Curve, target: float) -> tuple[Vector, bool]:
    """The event between the point z and one step further, by the Illinois rule on the length of the step."""
    low, high = 0.0, step
    at_low = _sought(event, z, tangent, curve, target)
    last, effort = stride(z, tangent, step, curve)
    at_high = _sought(event, last, tangent, curve, target)
    side = 0
    for _ in range(60):
        middle = low + (high - low) * at_low / (at_low - at_high)
        if not low < middle < high:
            break
        last, effort = stride(z, tangent, middle, curve)
        if math.isnan(effort):
            return last, False
        value = _sought(event, last, tangent, curve, target)
        if abs(value) < 1e-14:
            break
        if (value > 0.0) == (at_low > 0.0):
            low, at_low = middle, value
            at_high *= 0.5 if side > 0 else 1.0
            side = 1
        else:
            high, at_high = middle, value
            at_low *= 0.5 if side < 0 else 1.0
            side = -1
        if high - low < 1e-15 * step:
            break
    return last, not math.isnan(effort)


@kernel
def _meets_pitchfork(z: Vector, following: Vector, solids: Solids) -> bool:
    """Whether a mirror-symmetric bridge loses its antisymmetric stability in between."""
    return are_equal(solids) and antisymmetric_margin(z, solids) > 0.0 > antisymmetric_margin(following, solids)


@kernel
def set_out(z: Vector, curve: Curve, going: float) -> Vector:
    """Tangent of the curve at z, in the direction in which the driven quantity grows (going > 0) or falls."""
    found = measure(z, curve.solids)
    rates = going * found.rates[curve.driven]
    return heading_at(found, z, curve, rates / np.sqrt(np.dot(rates, rates))).tangent


@kernel
def _exactly_at(z: Vector, curve: Curve, target: float) -> Vector:
    """The point of the curve where the driven quantity has its target, from a point very near to it."""
    exact = z.copy()
    effort = correct(exact, curve.solids, curve.held, curve.value, curve.driven, target, z)
    return z if math.isnan(effort) else exact  # next to a fold the located point is the better one


@kernel
def _event_within(
    z: Vector, tangent: Vector, step: float, following: Vector, slope: float, curve: Curve, target: float, going: float
) -> tuple[int, Vector]:
    """First fold or target on a step, whose end has a given slope: ABSENT if none, LOST if it could not be located."""
    reach, last = step, following
    if going * slope < 0.0:
        last, located = _locate(FOLD, z, tangent, step, curve, target)
        if not located:
            return LOST, z
        reach = np.dot(tangent, last - z)
    if going * (measure(last, curve.solids).values[curve.driven] - target) >= 0.0:
        last, located = _locate(TARGET, z, tangent, reach, curve, target)
        return (TARGET, _exactly_at(last, curve, target)) if located else (LOST, z)
    return (FOLD, last) if going * slope < 0.0 else (ABSENT, z)


@kernel
def walk(start: Vector, tangent: Vector, curve: Curve, target: float, going: float, pitchfork: bool) -> Walk:
    """Follow a curve until the driven quantity, which grows (going > 0) or falls, meets its target or turns back.

    With ``pitchfork`` the walk also ends at the antisymmetric instability. The step is a tangent and Newton's method
    back to the curve; it shrinks where that is hard, where the curve bends, and where the step has leapt to another
    curve: two solids that are almost mirror images have two that nearly touch, told apart by their hand.
    """
    z, step = start, _FIRST_STEP
    found = measure(z, curve.solids)
    if going * (target - found.values[curve.driven]) < _NOWHERE * unit_of(curve.driven, z, target):
        return Walk(TARGET, _exactly_at(z, curve, target), tangent)
    hand = heading_at(found, z, curve, tangent).hand
    for _ in range(_MAX_PATH):
        if step < _SHORTEST_STEP:
            break
        following, effort = stride(z, tangent, step, curve)
        if not effort <= _MOST_EFFORT:
            step *= 0.5
            continue
        ahead = measure(following, curve.solids)
        turned, hand_ahead = heading_at(ahead, following, curve, tangent)
        if np.dot(turned, tangent) < _LEAST_COSINE or hand_ahead != hand:
            step *= 0.5
            continue
        slope = np.dot(ahead.rates[curve.driven], turned)
        event, point = _event_within(z, tangent, step, following, slope, curve, target, going)
        end = following if event == ABSENT else point  # what comes after the fold is on the other branch
        if pitchfork and event != LOST and _meets_pitchfork(z, end, curve.solids):
            point, located = _locate(PITCHFORK, z, tangent, np.dot(tangent, end - z), curve, target)
            event = PITCHFORK if located else LOST
        if event == LOST:
            step *= 0.5
        elif event != ABSENT:
            return Walk(event, point, turned)
        else:
            z, tangent = following, turned
            step = min(step * (1.6 if effort <= 3.0 else 1.0), _LONGEST_STEP)
    return Walk(LOST, z, tangent)
