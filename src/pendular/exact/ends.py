"""Where the stable branch of a pair ends: rupture above, and at some volumes a lower end; and what lies beyond.

Bridges of one suction or volume are stable from contact, or from a lower end where the drop would rather swallow the
better wetted solid, up to rupture. Both ends are folds, or for mirror images a pitchfork, where the liquid slides to
one side. From each an unstable branch leaves.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from .algebra import Four, distance, dot, largest, minors, moved, normal, scaled, solve4, unit_vector
from .curve import Curve, Stance, corrected, set_out, stance_at, stance_of, with_unstable
from .equations import Held, first_row, held_row, system_at
from .follow import BRANCH_ENDS, FOLDS, NOTHING, Nodes, Walk, back_from, beyond, follow
from .guess import guess_at, rupture_guess
from .locate import ARRIVED, FOLD, LOST, PITCHFORK
from .morph import Task, held_of
from .newton import held_target, newton_to
from .search import anchor, are_planes, is_symmetric

_NEXT_TO_RUPTURE = 0.85  # of the estimate, where to start
_MOST_STARTS, _MOST_STEPS = 4, 14
_MOST_LEAPS = 40
_FIRST_LEAP, _LONGEST_LEAP, _SHORTEST_LEAP = 0.1, 0.25, 1e-7
_FINE_LEAP, _LAST_LEAP = 1e-3, 1e-5  # to the end; the secant rule and Newton's make of the last one its square
_SETTLING, _MOST_SETTLING, _AT_THE_END = 1e-4, 6, 1e-12
_LEAST_COSINE = 0.9
_FLAT = 1e-7  # where the signs of the ladder are those of rounding errors
_THERE = 1e-13  # miss of a separation, over ℓ, that is none
_SETTLED = 1e-13  # miss of the equations of a bridge that rounding leaves
_BACK = 1e-3  # way from the end of a branch that tells how the separation falls
NEAR = 0.25  # largest miss of a foretold bridge, over its way from the last that is known
_NOWHERE = Four(0.0, 0.0, 0.0, 0.0)


@kernel
def walk_from_anchor(task: Task, going: float, target: float, stops_at: int, nodes: Nodes) -> tuple[Walk, bool]:
    """Walk from a stable bridge, up (going > 0) or down, and whether there was one to start from."""
    stance, is_stable = anchor(task, nodes)
    stance, curve = set_out(stance.z, held_of(task), is_symmetric(task), going)
    if not is_stable:
        return Walk(LOST, stance, curve, 0, going), False
    if abs(stance.separation - target) < _THERE * math.exp(stance.z.log_length):
        return Walk(ARRIVED, stance, curve, 0, going), True
    return follow(stance, curve, target, stops_at, nodes[:0]), True


class Glance(NamedTuple):
    """A point near a curve: the way back to it, and where it goes there."""

    way: Four
    stance: Stance  # of the point itself


@kernel
def _glance(z: Four, curve: Curve, fine: bool) -> Glance:
    """One look at a point near a curve."""
    held = curve.held
    system = system_at(z, held, fine, True)
    first, row = first_row(z, system, curve.symmetric), held_row(z, system, held)
    along = unit_vector(normal(minors(first.rates, system.contact2.rates), row.rates))
    way, _det = solve4(
        first.rates,
        system.contact2.rates,
        row.rates,
        along,
        -first.value,
        -system.contact2.value,
        held_target(row, held),
        0.0,
    )
    return Glance(way, stance_of(z, system, scaled(curve.hand, along), 1.0, curve))  # of its opening the end is asked


@kernel
def _is_in_order(stance: Stance, margin: float) -> bool:
    """Whether a point lies on the stable piece of a curve, or on the one after its end."""
    after = (1 if stance.slope < 0.0 else 0) + (1 if stance.margin * margin < 0.0 else 0)
    return stance.unstable == after


@kernel
def _vanishes(event: int, stance: Stance) -> float:
    return stance.margin if event == PITCHFORK else stance.slope


@kernel
def _settled(event: int, z: Four, curve: Curve) -> tuple[Stance, bool]:
    """The end of a branch from a point very near to it."""
    near = stance_at(z, curve)
    z, steps, _way = corrected(z, curve, near.tangent)
    stance = stance_at(z, curve)
    value, step = _vanishes(event, stance), _SETTLING
    for _ in range(_MOST_SETTLING):
        z, steps, _way = corrected(moved(stance.z, step, stance.tangent), curve, stance.tangent)
        ahead = stance_at(z, curve)
        at_ahead = _vanishes(event, ahead)
        onward = -at_ahead * step / (at_ahead - value)
        stance, value, step = ahead, at_ahead, onward
        if steps == 0 or not abs(onward) < 1e-2:
            return stance, False
        if abs(onward) < _AT_THE_END:
            return stance, True
    return stance, abs(step) < 1e-9


@kernel
def _leap_to(event: int, start: Stance, curve: Curve) -> tuple[Stance, bool]:
    """The fold or the pitchfork at the end of a stable branch by the secant rule, from a stable bridge on it."""
    base, at_base, step = start, _vanishes(event, start), _FIRST_LEAP
    sign = 1.0 if at_base > 0.0 else -1.0
    fine = False
    for _ in range(_MOST_LEAPS):
        way, ahead = _glance(moved(base.z, step, base.tangent), curve, fine)
        at_ahead = _vanishes(event, ahead)
        if not (
            largest(way) < 0.5 * abs(step) + 1e-7
            and dot(ahead.tangent, base.tangent) > _LEAST_COSINE
            and (_is_in_order(ahead, start.margin) or abs(at_ahead) < _FLAT)
        ):
            step *= 0.5
            if not abs(step) > _SHORTEST_LEAP:
                return base, False
            continue
        rate = (at_ahead - at_base) / step
        onward = -at_ahead / rate if rate * sign < 0.0 else math.copysign(_LONGEST_LEAP, at_ahead * sign)
        z = moved(ahead.z, 1.0, way)
        if fine and abs(onward) < _LAST_LEAP and largest(way) < _LAST_LEAP:
            return _settled(event, moved(z, onward, ahead.tangent), curve)
        fine = abs(onward) < _FINE_LEAP
        base = Stance(z, ahead.tangent, ahead.separation, ahead.slope, ahead.unstable, ahead.margin, ahead.opening)
        at_base = at_ahead
        step = max(-_LONGEST_LEAP, min(_LONGEST_LEAP, onward))
        if abs(step) < _SHORTEST_LEAP:
            step = math.copysign(_SHORTEST_LEAP, step)
    return base, False


@kernel
def quick_end(task: Task, stops_at: int) -> tuple[Walk, bool]:
    """Rupture by leaps from a stable bridge next to it, and whether that went well."""
    held, symmetric = held_of(task), is_symmetric(task)
    separation, is_met = _NEXT_TO_RUPTURE * rupture_guess(held), False
    start, curve = Stance(_NOWHERE, _NOWHERE, 0.0, 0.0, 0, 0.0, 0.0), Curve(held, symmetric, 1.0)
    for _ in range(_MOST_STARTS):
        z, is_met = newton_to(guess_at(held, separation), separation, held, _MOST_STEPS)
        if is_met:
            start, curve = set_out(z, held, symmetric, 1.0)
            is_met = start.unstable == 0 and start.opening > 0.0
            if is_met:
                break
        separation *= 0.75
    if not is_met:
        return Walk(LOST, start, curve, 0, 1.0), False
    end, is_found = _leap_to(FOLD, start, curve)
    event = FOLD
    if is_found and stops_at == BRANCH_ENDS and end.margin * start.margin < 0.0:
        end, is_found = _leap_to(PITCHFORK, start, curve)
        event = PITCHFORK
    has_forked = event == FOLD and end.margin * start.margin < 0.0
    is_found = is_found and end.separation > start.separation and end.opening > 0.0
    return Walk(event, with_unstable(end, 1 if has_forked else 0), curve, 0, 1.0), is_found


@kernel
def before_end(walk: Walk, separation: float) -> Four:
    """Meridian at a separation just before the end of a branch, along its tangent: the separation is a parabola."""
    end = walk.stance
    bend = (stance_at(moved(end.z, -_BACK, end.tangent), walk.curve).slope - end.slope) / _BACK
    fall = (end.separation - separation) * math.exp(-end.z.log_length)
    slope = max(end.slope, 0.0)
    square = slope * slope + 2.0 * bend * fall
    return moved(end.z, -2.0 * fall / (slope + math.sqrt(square)), end.tangent) if square > 0.0 else end.z


@kernel
def has_stalled(z: Four, separation: float, held: Held) -> bool:
    """Whether a meridian is a bridge to rounding, which is what Newton's method ends in next to a fold."""
    system = system_at(z, held, True, True)
    contacts = max(abs(system.contact1.value), abs(system.contact2.value))
    gap = abs(system.separation.value - separation) * math.exp(-z.log_length)
    return max(contacts, gap, abs(held_row(z, system, held).value)) < _SETTLED


@kernel
def just_before(walk: Walk, separation: float) -> tuple[Stance, bool]:
    """The stable bridge at a separation next to the end of a branch, and whether it was found."""
    guess = before_end(walk, separation)
    z, is_met = newton_to(guess, separation, walk.curve.held, _MOST_STEPS)
    way, miss = distance(guess, walk.stance.z), distance(z, guess)
    stance = stance_at(z, walk.curve)
    is_met = is_met or has_stalled(z, separation, walk.curve.held)
    return stance, is_met and miss < NEAR * way and stance.unstable == 0 and stance.opening > 0.0


@kernel
def upper_end(task: Task, stops_at: int, nodes: Nodes) -> tuple[Walk, bool]:
    """Rupture: the end of the stable branch, or its fold."""
    walk, is_found = quick_end(task, stops_at)
    if is_found:
        return walk, True
    return walk_from_anchor(task, 1.0, math.nan, stops_at, nodes)


@kernel
def lower_end(task: Task, stops_at: int, nodes: Nodes) -> tuple[Walk, bool]:
    """The end of the stable branch towards contact; the walk arrives if the branch goes on to D = 0.

    Between two planes it goes on without end, wider and wider.
    """
    if are_planes(task):
        stance, is_found = anchor(task, nodes)
        return Walk(ARRIVED, stance, Curve(held_of(task), is_symmetric(task), 1.0), 0, -1.0), is_found
    walk, is_found = walk_from_anchor(task, -1.0, 0.0, stops_at, nodes)
    if is_found and walk.stance.separation <= 0.0:
        return Walk(ARRIVED, walk.stance, walk.curve, walk.nodes, walk.going), True
    return walk, is_found


@kernel
def unstable_bridge(task: Task, stops_at: int, nodes: Nodes) -> tuple[Walk, bool]:
    """The bridge at a separation beyond the end of the stable branch: after rupture, else after the lower end."""
    top, is_found = upper_end(task, stops_at, nodes)
    if not is_found or top.event not in (FOLD, PITCHFORK):
        return top, is_found
    if task.separation >= top.stance.separation:
        if top.event == FOLD:
            return top, True
        # mirror images that have lost the stability against sliding stay symmetric up to their fold
        return walk_from_anchor(task, 1.0, task.separation, FOLDS, nodes)
    stance, curve = beyond(top)
    walk = follow(stance, curve, task.separation, NOTHING, nodes[:0])
    if walk.event == ARRIVED:
        return walk, True
    # the lower end may be a fold of overlapping solids, and the branch that leaves it lead up to a gap
    bottom, _ = walk_from_anchor(task, -1.0, math.nan, stops_at, nodes)
    if bottom.event != FOLD or task.separation < bottom.stance.separation:
        return walk, True
    stance, curve = beyond(bottom)
    other = follow(stance, curve, task.separation, NOTHING, nodes[:0])
    return (other if other.event == ARRIVED else walk), True


@kernel
def stable_bridge(task: Task, stops_at: int, nodes: Nodes) -> Walk:
    """The stable bridge of a task: the walk arrives there, or at the end of the branch beyond which there is none."""
    top, is_found = upper_end(task, stops_at, nodes)
    if is_found and (top.event == FOLD or top.event == PITCHFORK):
        if task.separation >= top.stance.separation:
            return top
        stance, curve = back_from(top.stance, top.curve)
        walk = follow(stance, curve, task.separation, stops_at, nodes[:0])
        if walk.event == ARRIVED:
            return walk
    walk, _is_found = walk_from_anchor(task, 1.0, task.separation, stops_at, nodes)
    if walk.event == ARRIVED or walk.stance.separation < task.separation:
        return walk
    walk, _is_found = walk_from_anchor(task, -1.0, task.separation, stops_at, nodes)
    return walk
