"""What lies within a step along a curve of bridges: a fold, a pitchfork, the bridge at a separation."""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from .algebra import Four, dot, largest, moved, solve4
from .bracket import MOST_NARROWINGS, Bracket, is_narrow, narrowed, secant_of
from .curve import MOST_CORRECTIONS, Curve, Stance, stance_after, stance_at, with_unstable
from .equations import VOLUME, first_row, held_row, system_at

# Events along a curve, and how it may end.
ARRIVED, FOLD, PITCHFORK, ENDED, LOST = 0, 1, 2, 3, 4

_LAST_CHANGE = 1e-5  # in the last steps to a bridge
_VANISHES = 1e-14


@kernel
def _excess(event: int, stance: Stance, target: float) -> float:
    """What vanishes at an event."""
    if event == PITCHFORK:
        return stance.margin
    if event == FOLD:
        return stance.slope
    return (stance.separation - target) * math.exp(-stance.z.log_length)


@kernel
def locate(event: int, start: Stance, low: float, high: float, target: float, curve: Curve) -> tuple[Stance, bool]:
    """The event between two lengths of a step, by the Illinois rule, and whether the curve was kept to on the way."""
    first, is_met = (start, True) if low == 0.0 else stance_after(start, low, curve)
    best, is_met_there = stance_after(start, high, curve)
    bracket = Bracket(low, high, _excess(event, first, target), _excess(event, best, target), 0)
    least = math.inf
    is_met = is_met and is_met_there
    for _ in range(MOST_NARROWINGS):
        middle = secant_of(bracket)
        if not (is_met and bracket.low < middle < bracket.high):
            break
        stance, is_met = stance_after(start, middle, curve)
        value = _excess(event, stance, target)
        if abs(value) < least:
            best, least = stance, abs(value)
        bracket = narrowed(bracket, middle, value)
        if abs(value) < _VANISHES or is_narrow(bracket):
            break
    return best, is_met


@kernel
def _change_to(target: float, z: Four, curve: Curve) -> Four:
    """Newton's step to the bridge of a curve at a separation."""
    held = curve.held
    system = system_at(z, held, True, held.control == VOLUME)
    first, row = first_row(z, system, curve.symmetric), held_row(z, system, held)
    change, _det = solve4(
        first.rates,
        system.contact2.rates,
        system.separation.rates,
        row.rates,
        -first.value,
        -system.contact2.value,
        target - system.separation.value,
        -row.value,
    )
    return change


@kernel
def arrived(start: Stance, low: float, high: float, target: float, curve: Curve, unstable: int) -> Stance:
    """The bridge at the target between two lengths of a step; its stability is that of its neighbours."""
    near, _is_met = locate(ARRIVED, start, low, high, target, curve)
    z, size = near.z, _LAST_CHANGE
    for _ in range(MOST_CORRECTIONS):  # next to a fold, where separations are all the same, none is of use
        change = _change_to(target, z, curve)
        if not largest(change) < 0.5 * size:
            break
        z, size = moved(z, 1.0, change), largest(change)
    return with_unstable(stance_at(z, curve), unstable)


@kernel
def encloses(before: Stance, after: Stance, target: float) -> bool:
    """Whether a separation lies between those of two bridges."""
    return (before.separation - target) * (after.separation - target) <= 0.0 and before.separation != target


class Stretch(NamedTuple):
    """A step along a curve, cut where an event lies within it."""

    event: int  # FOLD, PITCHFORK, or ARRIVED if none does; ENDED or LOST where there is no step, or none to be trusted
    reach: float  # length up to the event, or of the step
    end: Stance  # there


@kernel
def stretch_to(start: Stance, after: Stance, step: float, curve: Curve) -> Stretch:
    """The first event within a step."""
    if start.slope * after.slope < 0.0:
        event = FOLD
    elif start.margin * after.margin < 0.0:
        event = PITCHFORK
    else:
        return Stretch(ARRIVED, step, after)
    end, is_met = locate(event, start, 0.0, step, 0.0, curve)
    return Stretch(event if is_met else LOST, dot(start.tangent, moved(end.z, -1.0, start.z)), end)
