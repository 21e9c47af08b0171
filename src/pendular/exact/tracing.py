"""Whole curves: from contact or the lower end to rupture, and down the unstable branch, as states to be drawn."""

import math

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import moved, unit_vector
from .answers import (
    FAILED,
    FOUND,
    LARGEST_MISS,
    NO_BRIDGE,
    Answer,
    bridge_of,
    end_of,
    store,
    store_end,
)
from .clearance import radius_range
from .curve import Curve, corrected, set_out
from .ends import lower_end, stable_bridge, upper_end
from .equations import system_at
from .follow import NOTHING, Nodes, back_from, beyond, follow, recorded
from .locate import ARRIVED, FOLD, LOST, PITCHFORK
from .morph import Task, held_of
from .search import are_planes, at_separation, is_symmetric
from .state import STIFFNESS, UNSTABLE_DIRECTIONS, describe

Rows = NDArray[np.float64]

_WIDEST = 0.2  # gap between planes where their curve begins, over the rupture distance
_THREAD = 0.03  # thinnest circle of a drawn bridge over the widest of its branch


@kernel
def _spread(nodes: Nodes, count: int, curve: Curve, states: Rows, skips_first: bool) -> None:
    """States evenly spaced over the recorded nodes, without the last of them, or without the first."""
    rows = states.shape[0]
    for i in range(rows):
        place = (count - 1) * (i + (1.0 if skips_first else 0.0)) / rows
        node = min(int(place), count - 2)
        before = recorded(nodes, node)
        step = moved(recorded(nodes, node + 1), -1.0, before)
        z = moved(before, place - node, step)
        if 0.0 < place - node < 1.0:
            z, _steps, _way = corrected(z, curve, unit_vector(step))
        store(describe(z, curve.held, curve.symmetric), LARGEST_MISS, states[i])


@kernel
def _first_of(task: Task, limit: int, nodes: Nodes) -> Answer:
    """Where a curve begins: the bridge at contact, or the lower end of the stable branch.

    Bridges between planes grow without bounds towards contact: it begins at some of the rupture distance.
    """
    walk, is_known = lower_end(task, limit, nodes)
    if is_known and walk.event == ARRIVED:
        separation = 0.0
        if are_planes(task):
            top, is_known = upper_end(task, limit, nodes)
            separation = _WIDEST * top.stance.separation if is_known else math.nan
        return bridge_of(stable_bridge(at_separation(task, separation), limit, nodes), separation)
    return end_of(walk, is_known)


@kernel
def _thins_out(nodes: Nodes, count: int, curve: Curve) -> int:
    """How many of the nodes of an unstable branch are drawn: up to a thread of liquid."""
    widest = 0.0
    for i in range(count):
        z = recorded(nodes, i)
        least, most = radius_range(z, system_at(z, curve.held, False, False))
        widest = max(widest, most)
        if least < _THREAD * widest and i > 1:
            return i
    return count


@kernel
def trace(limit: int, task: Task, states: Rows, nodes: Nodes) -> int:
    """A whole curve: from contact, or the lower end, to the end of the stable branch, and down the unstable one."""
    states[:] = math.nan
    first = _first_of(task, limit, nodes)
    if first.status != FOUND:
        return first.status
    middle = states.shape[0] // 2
    held, symmetric = held_of(task), is_symmetric(task)
    if first.event == ARRIVED:
        stance, curve = set_out(first.stance.z, held, symmetric, 1.0)
    else:
        stance, curve = back_from(first.stance, first.curve)
    walk = follow(stance, curve, math.nan, limit, nodes)
    if walk.event not in (FOLD, PITCHFORK) or not walk.stance.separation > 0.0:
        return FAILED if walk.event == LOST else NO_BRIDGE
    _spread(nodes, walk.nodes, walk.curve, states[:middle], False)
    store_end(end_of(walk, True), states[middle])
    if walk.event == FOLD:
        states[middle, STIFFNESS] = -math.inf
    if first.event == FOLD:
        states[0, STIFFNESS], states[0, UNSTABLE_DIRECTIONS] = math.inf, 0.0
    if first.event == ARRIVED and not are_planes(task):
        states[0, 0] = 0.0  # contact, which the solver meets to rounding
    stance, curve = beyond(walk)
    down = follow(stance, curve, 0.0, NOTHING, nodes)
    count = _thins_out(nodes, down.nodes, down.curve)
    if count > 1:
        _spread(nodes, count, down.curve, states[middle + 1 :], True)
    return FOUND
