"""A given amount of liquid in equilibrium: the suction that all bridges share."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.root import root_between
from .answers import Answers, answers_at
from .history import Step, members_of, pairs_at
from .neighbours import Neighbours
from .setting import Setting
from .state import State, standing_of

__all__ = ["LEAST_REDUCED_SUCTION", "Equilibrium", "equilibrium_of"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

# ΔpR/γ with the largest grain. What bridges hold there is the most that is tried: they have met long before.
LEAST_REDUCED_SUCTION = 1e-2
_MOST_REDUCED_SUCTION = 1e12
_STEP = math.log(4.0)


class Equilibrium(NamedTuple):
    """Pairs that hold the liquid, at their common suction."""

    pairs: Neighbours
    step: Step
    suction: float  # [Pa]
    unheld: float  # what no suction holds, [m³]


def equilibrium_of(setting: Setting, amount: float, start: State | bool) -> Equilibrium:
    """Distribute an amount of liquid over the bridges of a heap.

    Parameters
    ----------
    setting : Setting
        The heap.
    amount : float
        Liquid, [m³].
    start : State or bool
        Which pairs held a bridge before; all of them, or none.

    Returns
    -------
    Equilibrium

    Notes
    -----
    The liquid that bridges hold falls with the suction, in steps where one breaks or condenses. In such a step a
    broken bridge leaves its liquid to the others, at a lower suction; a new one takes its liquid from them, at a higher
    one.
    """
    unit = setting.liquid.surface_tension / float(setting.heap.radii.max())
    least = math.log(LEAST_REDUCED_SUCTION * unit)
    most = math.log(_MOST_REDUCED_SUCTION * unit)
    low = min(math.log(10.0 * unit), most)
    while True:
        pairs = pairs_at(setting, "suction", math.exp(low))
        before = _before(start, pairs)
        if _held(setting, pairs, before, low)[0] >= amount or low <= least:
            break
        low = max(low - _STEP, least)
    held, step = _held(setting, pairs, before, low)
    if not held > amount:
        return Equilibrium(pairs, step, math.exp(low), amount - held)
    if amount == 0.0:
        return Equilibrium(pairs, _only(step, np.zeros_like(before)), math.inf, 0.0)
    high = low + _STEP
    while _held(setting, pairs, before, high)[0] > amount and high < most:
        high += _STEP
    if high >= most:
        return Equilibrium(pairs, _only(step, np.zeros_like(before)), math.inf, amount)
    return _between(setting, pairs, before, amount, low, high)


def _before(start: State | bool, pairs: Neighbours) -> Bools:
    if isinstance(start, State):
        return standing_of(start, pairs).has
    return np.full(len(pairs.gap), start)


def _held(setting: Setting, pairs: Neighbours, before: Bools, log_suction: float) -> tuple[float, Step]:
    """Liquid in the bridges at a suction that was approached without a detour."""
    answers = answers_at(setting, pairs, "suction", np.array([math.exp(log_suction)]))
    members = members_of(setting, pairs, answers, before)
    return float(np.sum(answers.volume[members])), Step(answers, members)


def _between(setting: Setting, pairs: Neighbours, before: Bools, amount: float, low: float, high: float) -> Equilibrium:
    """Equilibrium between two suctions, at which the bridges hold more and less than the amount."""
    place = root_between(lambda at: _held(setting, pairs, before, at)[0] / amount - 1.0, low, high, 1e-13)
    width = 1e-12
    wet, dry = (_held(setting, pairs, before, place + side)[1] for side in (-width, width))
    # Of what differs on the two sides of a step, a broken bridge is gone and a condensed one stays.
    for members in (dry.members | (wet.members & ~before), dry.members):
        found = _of_set(setting, pairs, members, amount, place)
        if found is not None:
            return found
    raise ArithmeticError(f"no suction was found at which bridges hold {amount:.6g} m^3")


def _of_set(setting: Setting, pairs: Neighbours, members: Bools, amount: float, place: float) -> Equilibrium | None:
    """Suction at which given bridges hold an amount, near a place; none where one of them breaks before."""
    few = pairs.taken(members)

    def answers_of(at: float) -> Answers:
        return answers_at(setting, few, "suction", np.array([math.exp(at)]))

    def excess(at: float) -> float:
        found = answers_of(at)
        return float(np.sum(found.volume[found.exists])) / amount - 1.0

    low, high, step = place - 1e-12, place + 1e-12, 1e-6
    while excess(low) < 0.0 and step < 20.0:
        low, step = low - step, 4.0 * step
    step = 1e-6
    while excess(high) > 0.0 and step < 20.0:
        high, step = high + step, 4.0 * step
    if not excess(low) >= 0.0 >= excess(high):
        return None
    at = root_between(excess, low, high, 1e-15)
    found = answers_of(at)
    if not found.exists.all():
        return None
    volume = found.volume * (amount / np.sum(found.volume))  # the last digits, of the root and of a table
    return Equilibrium(few, Step(found._replace(volume=volume), np.ones(len(volume), bool)), math.exp(at), 0.0)


def _only(step: Step, members: Bools) -> Step:
    return Step(step.answers, members)
