"""What a question about a pair leads to: a bridge or the end of a branch, checked before it is stored."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import Four
from .curve import Curve, Stance
from .ends import just_before, lower_end, quick_end, stable_bridge, unstable_bridge, upper_end
from .equations import SUCTION, Held
from .follow import Nodes, Walk
from .guess import guess_at
from .locate import ARRIVED, ENDED, FOLD, LOST, PITCHFORK
from .morph import Task, held_of
from .newton import newton_to
from .search import is_symmetric
from .state import UNSTABLE_DIRECTIONS, Description, describe

Rows = NDArray[np.float64]

# What is asked: the bridge on the stable branch, beyond it, the end of the stable branch, its lower end.
STABLE, UNSTABLE, RUPTURE, LOWER_END = 0, 1, 2, 3
FOUND, NO_BRIDGE, FAILED = 0, 1, 2

MET = 1e-13  # largest miss of the end of a branch, over the length of the arc, that is the end itself
_ROUNDING = 1e-15  # of a sum of cosines
LARGEST_MISS = 1e-10  # of the equations of an answer
_MISS_WHERE_CLOSED = 1e-8  # where a contact circle has nearly closed, its slope is known no better
_MOST_STEPS = 14


class Answer(NamedTuple):
    """A bridge that answers a question, or where the search for it ended."""

    stance: Stance
    curve: Curve
    event: int  # at the end of a branch; ARRIVED on the way
    status: int


@kernel
def store(description: Description, allowed: float, row: Rows) -> int:
    """Store a state in a row, if it is a bridge that holds what it should."""
    if not description.miss <= allowed:
        return FAILED
    if not description.is_bridge:
        return NO_BRIDGE
    for j, value in enumerate(description.state):
        row[j] = value
    return FOUND


@kernel
def store_end(end: Answer, row: Rows) -> int:
    """Store where a search ended.

    At the end of a branch the index and the slope are the signs of rounding errors: what is stored is that of the
    branch which ends there, and at a fold the force falls, or at a lower end rises, infinitely fast.
    """
    allowed = _MISS_WHERE_CLOSED if end.event == ENDED else LARGEST_MISS
    status = store(describe(end.stance.z, end.curve.held, end.curve.symmetric), allowed, row)
    row[UNSTABLE_DIRECTIONS] = float(end.stance.unstable)
    return status


@kernel
def end_of(walk: Walk, is_known: bool) -> Answer:
    """The end of a branch at which a walk arrived."""
    is_end = is_known and (walk.event == FOLD or walk.event == PITCHFORK or walk.event == ENDED)
    return Answer(walk.stance, walk.curve, walk.event, FOUND if is_end else FAILED)


@kernel
def bridge_of(walk: Walk, separation: float) -> Answer:
    """The bridge at a separation at which a walk arrived, or that of the end of the branch, if it is there."""
    miss = abs(walk.stance.separation - separation) * math.exp(-walk.stance.z.log_length)
    if walk.event == LOST:
        status = FAILED
    elif walk.event == ARRIVED:
        status = FOUND if miss <= LARGEST_MISS else FAILED
    else:
        status = FOUND if miss <= MET else NO_BRIDGE
    return Answer(walk.stance, walk.curve, walk.event, status)


@kernel
def answer_at_end(asked: int, limit: int, task: Task) -> Answer:
    """What a few leaps to the end of the branch tell: rupture, or a bridge next to it or not before it; else FAILED."""
    walk, is_known = quick_end(task, limit)
    if asked == RUPTURE:
        return _apart(end_of(walk, is_known))
    if not is_known:
        return Answer(walk.stance, walk.curve, LOST, FAILED)
    if task.separation >= walk.stance.separation:
        return bridge_of(walk, task.separation)
    stance, is_found = just_before(walk, task.separation)
    return Answer(stance, walk.curve, ARRIVED, FOUND if is_found else FAILED)


@kernel
def _apart(end: Answer) -> Answer:
    """Rupture of solids that hold a bridge apart."""
    holds_apart = end.status != FOUND or end.stance.separation >= 0.0
    return end if holds_apart else Answer(end.stance, end.curve, end.event, NO_BRIDGE)


@kernel
def answer_to(asked: int, limit: int, task: Task, nodes: Nodes) -> Answer:
    """The bridge, or the end of a branch, that a question asks for."""
    if asked == STABLE:
        return bridge_of(stable_bridge(task, limit, nodes), task.separation)
    if asked == UNSTABLE:
        walk, is_known = unstable_bridge(task, limit, nodes)
        if not is_known:
            return Answer(walk.stance, walk.curve, LOST, FAILED)
        return bridge_of(walk, task.separation)
    if asked == LOWER_END:
        walk, is_known = lower_end(task, limit, nodes)
        end = end_of(walk, is_known)
        return Answer(end.stance, end.curve, end.event, NO_BRIDGE) if walk.event == ARRIVED else end
    walk, is_known = upper_end(task, limit, nodes)
    return _apart(end_of(walk, is_known))


@kernel
def holds_nothing_between(held: Held) -> bool:
    """Whether no stable bridge is possible at any separation.

    Under suction the solids have to be wetted; and no catenoid, of suction 0, runs out along a plane.
    """
    if held.control != SUCTION or held.value < 0.0:
        return False
    one, other = held.first, held.second
    floods = one.curvature + one.contact_angle == 0.0 or other.curvature + other.contact_angle == 0.0
    return not one.cos_angle + other.cos_angle > _ROUNDING or (held.value == 0.0 and floods)


@kernel
def holds_nothing(task: Task) -> bool:
    """Whether no stable bridge is possible at any separation."""
    return task.control == SUCTION and holds_nothing_between(held_of(task))


@kernel
def stored_from(guess: Four, task: Task, unstable: float, row: Rows) -> int:
    """Store the bridge with so many unstable directions, if Newton's method leads to it from a guess."""
    held = held_of(task)
    z, is_met = newton_to(guess, task.separation, held, _MOST_STEPS)
    if not is_met:
        return FAILED
    description = describe(z, held, is_symmetric(task))
    if description.state.unstable_directions != unstable or not description.is_bridge:
        return FAILED
    return store(description, LARGEST_MISS, row)


@kernel
def directly_stored(task: Task, row: Rows) -> int:
    """Store the stable bridge, if Newton's method leads to it from the closed guess."""
    return stored_from(guess_at(held_of(task), task.separation), task, 0.0, row)
