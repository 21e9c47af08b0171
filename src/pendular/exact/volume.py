"""A bridge of a volume by Newton's method, for one row or for one in each lane.

Nothing here decides by a branch, so that lanes may disagree.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from ..ground.lanes import choose, every
from .algebra import largest_of
from .arc import (
    LEAST_ROOM,
    Arc,
    arc_after,
    chosen,
    crowded_at,
    force_on,
    has_room,
    ratio_of,
    sums_at,
    system_on,
)
from .clearance import extrema_between, is_beyond_doubt
from .equations import Held, System, volume_row
from .newton import (
    LONGEST_STEP,
    MOST_STEPS,
    NEARLY_HELD,
    NO_STEP,
    is_fine_step,
    left_after,
    nodes_of_step,
    step_to,
)
from .stability import directions_of


class Met(NamedTuple):
    """Where Newton's method ended."""

    arc: Arc
    system: System  # of the step before
    is_met: bool


@kernel
def volume_target(excess: float) -> float:
    """Right side of the held row, V/V0 ln(V0/V) where the volume is not far too small: ln x by (x - 1)/(x + 1)."""
    s = excess / choose(excess > -1.0, 2.0 + excess, 1.0)
    square = s * s
    logarithm = 2.0 * s * (1.0 + square * (1.0 / 3.0 + square * (0.2 + square / 7.0)))
    return -choose(excess > NEARLY_HELD - 1.0, (1.0 + excess) * logarithm, excess)


@kernel
def met_at_volume(arc: Arc, separation: float, held: Held, left: float, is_near: bool) -> Met:
    """From a guess to the bridge at a separation, but for what is left; from a bridge near by on fine nodes at once."""
    is_met, before = arc.radius < 0.0, math.nan * arc.radius
    for step in range(MOST_STEPS):
        is_fine = is_fine_step(step, is_near)
        x, weight = nodes_of_step(step, is_near)
        sums = crowded_at(arc, x, weight, True) if is_fine else sums_at(arc, x, weight, True)
        system = system_on(arc, held, sums, True)
        row = volume_row(system, held)
        change = step_to(separation, system, row.rates, volume_target(row.value))
        size = max(largest_of(change), NO_STEP)
        arc = chosen(is_met, arc, arc_after(arc, change, LONGEST_STEP / max(size, LONGEST_STEP)))
        if is_fine:
            is_met = is_met | (left_after(size, before) < left)
            if every(is_met):
                break
        before = size
    return Met(arc, system, is_met)


@kernel
def is_stable_at_volume(met: Met, held: Held) -> bool:
    """Whether Newton's method ended beyond doubt on a stable bridge."""
    arc, first, second = met.arc, met.system.first, met.system.second
    curvature, ratio = arc.eta / arc.half_width, ratio_of(arc)
    necks, bulges = extrema_between(first, second)
    _at_suction, unstable = directions_of(met.system, arc.eta, necks + bulges, True)
    return (
        met.is_met
        & has_room(arc, LEAST_ROOM)
        & (abs(unstable) < 0.5)
        & is_beyond_doubt(first, second, held, necks, bulges, force_on(arc), curvature, ratio, arc.half_width)
    )
