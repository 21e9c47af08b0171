"""Whole bridges at a given suction: one equation, D(λ; H) = D, its fold and its two branches.

For a given curvature H = Δp/γ ≥ 0 and axial force λ = F/(2πγ) the contact circle on each solid is a closed form
and so is the arc between them, hence the separation D. The coordinate along the curve is not λ itself but the
wetted arc ``a`` on the solid that limits λ (dλ/da vanishes where that solid is about half immersed, D does not
care): the curve D(a) rises from a = 0 on the unstable branch, has its only maximum at the rupture distance, and
falls on the stable branch.

All kernels are reduced: γ = 1, lengths in any one unit.
"""

import math
from typing import NamedTuple

from .._jit import kernel
from .contact import Contact, cap_volume, contact_at, force_at, force_rate, wetted_arc_of, wetted_area
from .meridian import NeckArc, arc_across, arc_from_neck, arc_length_from_neck, middle_between

_MAX_STEPS = 60
_SMALL_SUCTION = 0.1  # HY below which the closed form of the volume loses more than a digit


class Solids(NamedTuple):
    """Two solids: curvature k = 1/R (0 for a plane) and contact angle, each."""

    k1: float
    theta1: float
    k2: float
    theta2: float


class State(NamedTuple):
    """An equilibrium bridge, reduced (γ = 1). All NaN where there is none."""

    separation: float  # D
    curvature: float  # H
    force: float  # λ
    volume: float  # V
    area: float  # liquid-gas
    tensor: float  # n11, one of the two equal transverse components
    stiffness: float  # dλ/dD with the given control held
    neck_radius: float  # Y0 of the surface
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
    stable: float  # 1 if stable under the given control


class Side(NamedTuple):
    """One solid and the arc from the neck to it."""

    contact: Contact
    arc: NeckArc
    gap: float  # X - h, from the neck to the pole of the solid
    gap_rate: float  # its rate per wetted arc of this solid, at fixed H
    force_rate: float  # M = dλ/da


class Balance(NamedTuple):
    """The bridge of curvature H that wets the arc a of solid 1."""

    separation: float  # D
    rate: float  # dD/da
    force: float  # λ
    wetted_arc2: float
    first: Side
    second: Side


@kernel
def are_equal(solids: Solids) -> bool:
    """Whether the two solids are mirror images, so that one side of the bridge is the other."""
    return solids.k1 == solids.k2 and solids.theta1 == solids.theta2


@kernel
def swapped(solids: Solids) -> Solids:
    """The same pair, seen from the other side."""
    return Solids(solids.k2, solids.theta2, solids.k1, solids.theta1)


@kernel
def largest_force(curvature: float, k: float, theta: float) -> float:
    """Largest λ that a surface of curvature H can exert on a solid: where its two contact circles merge."""
    if k == 0.0:
        return math.inf
    half = 0.5 / k
    center = half * (math.cos(theta) + half * curvature)
    return center + math.hypot(center, half * math.sin(theta))


@kernel
def is_limited_by_second(curvature: float, solids: Solids) -> bool:
    """Whether solid 2 limits λ, so that the wetted arc on it is the coordinate to use."""
    return largest_force(curvature, solids.k2, solids.theta2) < largest_force(curvature, solids.k1, solids.theta1)


@kernel
def _side_at(wetted_arc: float, curvature: float, k: float, theta: float) -> Side:
    """One side of a bridge, from the wetted arc of its solid.

    ∂(X - h)/∂λ = ∂X/∂λ - Y (k/M)(1 + cos ψ/r) at fixed H, with r = cos ψ + HY; multiplied by M = dλ/da it is
    regular where M vanishes.
    """
    contact = contact_at(wetted_arc, k, theta)
    arc = arc_from_neck(curvature, contact.radius, contact.sin_slope, contact.cos_slope)
    rate = force_rate(contact, curvature, k)
    slope_part = k * contact.radius * (1.0 + contact.cos_slope / (contact.cos_slope + curvature * contact.radius))
    return Side(contact, arc, arc.length - contact.sagitta, rate * arc.length_rate - slope_part, rate)


@kernel
def balance_at(wetted_arc: float, curvature: float, solids: Solids) -> Balance:
    """The bridge of curvature H ≥ 0 for a given wetted arc on solid 1; NaN where there is none."""
    first = _side_at(wetted_arc, curvature, solids.k1, solids.theta1)
    force = force_at(first.contact, curvature)
    if not force > 0.0:
        return Balance(math.nan, math.nan, math.nan, math.nan, first, first)
    if are_equal(solids):
        return Balance(2.0 * first.gap, 2.0 * first.gap_rate, force, wetted_arc, first, first)
    wetted_arc2 = wetted_arc_of(force, curvature, solids.k2, solids.theta2)
    second = _side_at(wetted_arc2, curvature, solids.k2, solids.theta2)
    rate = first.gap_rate + second.gap_rate * first.force_rate / second.force_rate
    return Balance(first.gap + second.gap, rate, force, wetted_arc2, first, second)


@kernel
def _scale_at_rupture(curvature: float, solids: Solids) -> float:
    """Rough wetted arc at rupture, from its limits for large and small H: where to start looking."""
    spread = 0.0
    for theta in (solids.theta1, solids.theta2):
        spread += 0.25 * abs(0.5 * math.pi - theta + math.sin(theta) * math.cos(theta))
    mean_k = 0.5 * (solids.k1 + solids.k2)
    return 1.0 / ((curvature * curvature * mean_k / (spread + 0.01)) ** (1.0 / 3.0) + 1.5 * solids.k1 + 0.5 * solids.k2)


@kernel
def _is_rising(wetted_arc: float, curvature: float, solids: Solids) -> bool:
    return balance_at(wetted_arc, curvature, solids).rate > 0.0


@kernel
def fold(curvature: float, solids: Solids) -> float:
    """Wetted arc of solid 1 at the fold, dD/da = 0: the rupture under suction control. NaN if there is none."""
    low = high = _scale_at_rupture(curvature, solids)
    for _ in range(_MAX_STEPS):  # a bracket: dD/da > 0 at low, not at high
        if _is_rising(low, curvature, solids):
            break
        high = low
        low *= 0.6
    else:
        return math.nan
    for _ in range(_MAX_STEPS):
        if not _is_rising(high, curvature, solids):
            break
        low = high
        high *= 1.5
    return _stationary_arc(low, high, curvature, solids)


@kernel
def _stationary_arc(low: float, high: float, curvature: float, solids: Solids) -> float:
    """Root of dD/da between two arcs that bracket it: regula falsi with the Illinois rule."""
    rate_low = balance_at(low, curvature, solids).rate
    rate_high = balance_at(high, curvature, solids).rate
    last_side = 0
    for _ in range(2 * _MAX_STEPS):
        if math.isnan(rate_high):  # beyond the domain: only pull the upper end in
            middle = 0.5 * (low + high)
        else:
            middle = low + (high - low) * (rate_low / (rate_low - rate_high))
        rate = balance_at(middle, curvature, solids).rate
        if rate == 0.0 or middle in (low, high):
            return middle
        if rate > 0.0:
            low, rate_low = middle, rate
            if last_side > 0:
                rate_high *= 0.5
            last_side = 1
        else:
            high, rate_high = middle, rate
            if last_side < 0:
                rate_low *= 0.5
            last_side = -1
        if high - low < 1e-15 * high:
            break
    return low if abs(rate_low) < abs(rate_high) else high


@kernel
def _first_arc(separation: float, curvature: float, solids: Solids) -> float:
    """Start of the search on the stable branch: a torus whose second curvature is 1/Y, at most 75° of filling."""
    mean_k2 = solids.k1 + solids.k2
    slopes = solids.k1 * math.sin(solids.theta1) + solids.k2 * math.sin(solids.theta2) + 0.5 * mean_k2
    room = math.cos(solids.theta1) + math.cos(solids.theta2) - curvature * separation
    largest = 1.3 / solids.k1
    if not room > 0.0:
        return largest
    return min(2.0 * room / (slopes + math.sqrt(slopes * slopes + 2.0 * curvature * mean_k2 * room)), largest)


@kernel
def _newton_from_above(separation: float, curvature: float, solids: Solids) -> float:
    """Wetted arc on the stable branch by Newton's method in a², from the thick side; NaN if that fails.

    D is nearly linear in a² and concave, so the steps are few and approach the root from above. Fails beyond the
    fold (dD/da changes sign), and rarely at low suction, where the start may lie where D is not concave.
    """
    arc = _first_arc(separation, curvature, solids)
    for _ in range(_MAX_STEPS):
        balance = balance_at(arc, curvature, solids)
        if not balance.rate < 0.0:
            return math.nan
        step = (balance.separation - separation) / balance.rate
        square = 1.0 - 2.0 * step / arc
        if not square > 0.0:
            return math.nan
        correction = math.sqrt(square)
        arc *= correction
        if solids.k1 * arc > math.pi:  # a sphere has no more than that to wet
            return math.nan
        if abs(correction - 1.0) < 1e-9:
            return arc
    return math.nan


@kernel
def _between(low: float, high: float, separation: float, curvature: float, solids: Solids) -> float:
    """Wetted arc between two that enclose the separation: Newton's method kept inside by bisection."""
    sign = 1.0 if balance_at(low, curvature, solids).separation > separation else -1.0
    arc = 0.5 * (low + high)
    for _ in range(3 * _MAX_STEPS):
        balance = balance_at(arc, curvature, solids)
        excess = balance.separation - separation
        if sign * excess > 0.0:
            low = arc
        else:
            high = arc
        following = arc - excess / balance.rate
        if abs(following - arc) < 1e-15 * arc:
            return following
        arc = following if low < following < high else 0.5 * (low + high)
        if arc in (low, high):
            return arc
    return math.nan


@kernel
def solve_suction(separation: float, curvature: float, solids: Solids, unstable: bool) -> float:
    """Wetted arc of solid 1 at the separation D under the curvature H, on one of the two branches.

    Returns
    -------
    float
        The arc; zero beyond rupture (no bridge); NaN if the search failed.
    """
    if not unstable:
        arc = _newton_from_above(separation, curvature, solids)
        if not math.isnan(arc):
            return arc
    top = fold(curvature, solids)
    if math.isnan(top):
        return 0.0
    if balance_at(top, curvature, solids).separation < separation:
        return 0.0
    other = top
    for _ in range(_MAX_STEPS):
        other = 0.5 * other if unstable else other + 0.25 * top
        if not balance_at(other, curvature, solids).separation > separation:
            break
    else:
        return 0.0 if unstable else math.nan
    return (
        _between(other, top, separation, curvature, solids)
        if unstable
        else _between(top, other, separation, curvature, solids)
    )


@kernel
def suction_state(wetted_arc: float, curvature: float, solids: Solids) -> State:
    """Everything about the bridge that wets the arc a of solid 1 under the curvature H (H ≥ 0)."""
    balance = balance_at(wetted_arc, curvature, solids)
    (first, arc1, _, _, rate1), (second, arc2, _, _, _) = balance.first, balance.second
    middle = middle_between(
        curvature,
        arc1.neck_radius,
        arc_length_from_neck(curvature, first.radius, first.sin_slope, first.cos_slope),
        arc_length_from_neck(curvature, second.radius, second.sin_slope, second.cos_slope),
    )
    if curvature * min(first.radius, second.radius) > _SMALL_SUCTION:
        rotated = arc1.volume + arc2.volume
    else:
        rotated = arc_across(middle.y, middle.slope, middle.phase, are_equal(solids)).volume * middle.half_length**3
    return State(
        balance.separation,
        curvature,
        balance.force,
        rotated - cap_volume(first) - cap_volume(second),
        arc1.area + arc2.area,
        math.pi * balance.force * (arc1.length + arc2.length) - 0.5 * curvature * rotated,
        rate1 / balance.rate,
        arc1.neck_radius,
        1.0 if first.sin_slope > 0.0 and second.sin_slope > 0.0 else 0.0,
        first.radius,
        second.radius,
        solids.k1 * wetted_arc,
        solids.k2 * balance.wetted_arc2,
        wetted_area(first),
        wetted_area(second),
        middle.y * middle.half_length,
        middle.slope,
        middle.half_length,
        1.0 if balance.rate < 0.0 else 0.0,
    )


@kernel
def mirrored(state: State) -> State:
    """The same bridge with its two solids named in the other order."""
    return State(
        state.separation,
        state.curvature,
        state.force,
        state.volume,
        state.area,
        state.tensor,
        state.stiffness,
        state.neck_radius,
        state.neck_inside,
        state.radius2,
        state.radius1,
        state.filling2,
        state.filling1,
        state.wetted_area2,
        state.wetted_area1,
        state.middle_radius,
        -state.middle_slope,
        state.half_length,
        state.stable,
    )
