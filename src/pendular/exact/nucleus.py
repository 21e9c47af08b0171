"""The bridge between two planes under suction: a nucleus, which dries up or floods the gap at the least change.

No bridge between planes is stable at a suction: shifted along the planes it is the same, and of the modes of a shift
that one, neutral, is the lowest; so one of the modes about the axis lies below. Sought is the bridge with that one
unstable direction. Its shape follows from the product HD alone.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import Four, moved
from .answers import FOUND, NO_BRIDGE, stored_from
from .curve import set_out
from .equations import VOLUME, curvature_of, system_at
from .follow import BRANCH_ENDS, FOLDS, Nodes, beyond, follow, recorded
from .guess import guess_at_suction
from .locate import FOLD, PITCHFORK
from .morph import Task, held_of
from .search import anchor, is_symmetric

Rows = NDArray[np.float64]

_WIDENED = (1.0, 1.35, 0.74, 1.8, 0.55)  # of the contact circles of the guess
_UNSTABLE = 1.0  # directions of a nucleus
_NARROWEST = 1e-3  # gap over V^(1/3) down to which the shapes are looked through


@kernel
def _stored_between(nodes: Nodes, last: int, task: Task, row: Rows) -> bool:
    """Store the nucleus, if its HD lies between those of two shapes of a walk."""
    held, product = held_of(task), task.value * task.separation
    z, before = recorded(nodes, 0), math.nan
    for i in range(last):
        previous, z = z, recorded(nodes, i)
        separation = system_at(z, held, True, False).separation.value
        excess = curvature_of(z) * separation - product
        if excess * before <= 0.0:
            share = before / (before - excess)
            near = moved(previous, share, moved(z, -1.0, previous))
            scale = math.log(task.separation / system_at(near, held, True, False).separation.value)
            grown = Four(near.log_radius + scale, near.slope, near.log_length + scale, near.turn)
            if stored_from(grown, task, _UNSTABLE, row) == FOUND:
                return True
        before = excess
    return False


@kernel
def nucleus_stored(task: Task, nodes: Nodes, row: Rows) -> int:
    """Store the bridge of two planes at a separation and a suction."""
    held = held_of(task)
    for widened in _WIDENED:
        if stored_from(guess_at_suction(held, task.separation, widened), task, _UNSTABLE, row) == FOUND:
            return FOUND
    # through all shapes, at one volume, from a wide bridge in a narrow gap to those beyond rupture
    shape = Task(0.3, 1.0 / math.pi, 0.0, task.angle1, 0.0, task.angle2, VOLUME)
    start, is_stable = anchor(shape, nodes)
    if not is_stable:
        return NO_BRIDGE
    for going in (-1.0, 1.0):
        stance, curve = set_out(start.z, held_of(shape), is_symmetric(shape), going)
        walk = follow(stance, curve, _NARROWEST if going < 0.0 else math.nan, BRANCH_ENDS, nodes)
        if _stored_between(nodes, walk.nodes, task, row):
            return FOUND
        if going > 0.0 and (walk.event == FOLD or walk.event == PITCHFORK):
            stance, curve = beyond(walk)
            walk = follow(stance, curve, 0.0, FOLDS, nodes)
            if _stored_between(nodes, walk.nodes, task, row):
                return FOUND
    return NO_BRIDGE
