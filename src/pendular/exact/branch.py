r"""Bridges at given places of a stable branch, in a coordinate in which the branch is smooth.

With D_c the rupture distance, the coordinate is :math:`q = \sqrt{1 - D/D_c}`: 0 at rupture, 1 at contact. A force curve
has a vertical tangent at rupture as a function of D, and none as a function of q.

A small volume spreads fast when the solids move apart: then the force falls within a distance d of contact much shorter
than D_c. The stretched coordinate :math:`q = \sqrt{(1 - D/D_c)/(1 + D/d)}` keeps away from the places D = ±id, where
such a curve is singular.
"""

import math
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import Own, entry, over_rows
from .algebra import Four, distance
from .ends import NEAR, before_end, has_stalled, quick_end, stable_bridge, upper_end
from .equations import SUCTION, Held, curvature_of, force_of, system_at
from .follow import BRANCH_ENDS, Nodes, Walk, recorded
from .locate import ARRIVED, FOLD, PITCHFORK
from .morph import Task, held_of
from .newton import newton_to
from .search import at_separation
from .stability import ladder_at

Vector = NDArray[np.float64]
Rows = NDArray[np.float64]

STRETCH = 0.7  # the singular places are farthest from q = 0 to 1

_MOST_STEPS = 6


@kernel
def stretch_of(volume: float, curvatures: float) -> float:
    """Distance d from contact: of the √(2V/πR̄) in which the force of a small volume falls, with k1 + k2 = 2/R̄."""
    return STRETCH * math.sqrt(curvatures * volume / math.pi)


def stretches_of(pairs: Rows) -> Vector:
    """That distance for rows of (V, k1, θ1, k2, θ2)."""
    return np.asarray(STRETCH * np.sqrt((pairs[:, 1] + pairs[:, 3]) * pairs[:, 0] / math.pi))


@kernel
def separation_at(q: float, rupture: float, stretch: float) -> float:
    """D at a coordinate q, stretched by the length d; an infinite d does not stretch."""
    return rupture * (1.0 - q * q) / (1.0 + rupture / stretch * q * q)


@kernel
def _foretold(q: Vector, i: int, end: Four, passed: Nodes) -> Four:
    """Meridian at q[i], ascending, by the polynomial through up to three before it; the first is the end, at q = 0."""
    first = max(i - 3, -1)
    a = b = c = d = 0.0
    for j in range(first, i):
        place = q[j] if j >= 0 else 0.0
        weight = 1.0
        for k in range(first, i):
            if k != j:
                other = q[k] if k >= 0 else 0.0
                weight *= (q[i] - other) / (place - other)
        if j >= 0:
            a, b, c, d = (
                a + weight * passed[j, 0],
                b + weight * passed[j, 1],
                c + weight * passed[j, 2],
                d + weight * passed[j, 3],
            )
        else:
            a, b, c, d = a + weight * end[0], b + weight * end[1], c + weight * end[2], d + weight * end[3]
    return Four(a, b, c, d)


@kernel
def _is_stable(z: Four, held: Held) -> bool:
    ladder = ladder_at(z, system_at(z, held, True, True))
    return (ladder.at_suction if held.control == SUCTION else ladder.at_volume) == 0


@kernel
def _walked(first: int, walk: Walk, q: Vector, stretch: float, values: Rows, nodes: Nodes) -> int:
    """Fill in the stable bridges from a number on, each foretold by those nearer to rupture; where that came to."""
    held, end = walk.curve.held, walk.stance.z
    for i in range(first, q.size):
        separation = separation_at(q[i], walk.stance.separation, stretch)
        guess = before_end(walk, separation) if i == 0 else _foretold(q, i, end, nodes)
        z, is_met = newton_to(guess, separation, held, _MOST_STEPS)
        is_met = is_met or has_stalled(z, separation, held)
        last = end if i == 0 else recorded(nodes, i - 1)
        if not (is_met and distance(z, guess) < NEAR * distance(guess, last) and _is_stable(z, held)):
            return i
        _fill(i, z, held, values, nodes)
    return q.size


@kernel
def _fill(i: int, z: Four, held: Held, values: Rows, nodes: Nodes) -> None:
    """Store a bridge: its meridian, force λ, and V or H."""
    nodes[i, 0], nodes[i, 1], nodes[i, 2], nodes[i, 3] = z[0], z[1], z[2], z[3]
    values[i, 0] = force_of(z)
    values[i, 1] = math.pi * system_at(z, held, True, True).volume.value if held.control == SUCTION else curvature_of(z)


@kernel
def fill_branch(task: Task, q: Vector, stretch: float, values: Rows, nodes: Nodes) -> float:
    """Force λ, and V or H, of the stable bridges at each q, ascending; returns the rupture distance, NaN if none.

    Every bridge is found from the ones nearer to rupture; where that does not lead to a stable one near by, it is
    sought.
    """
    values[:] = math.nan
    walk, is_found = upper_end(task, BRANCH_ENDS, nodes)
    if not (is_found and (walk.event in (FOLD, PITCHFORK)) and walk.stance.separation > 0.0):
        return math.nan
    rupture, i = walk.stance.separation, 0
    while i < q.size:
        i = _walked(i, walk, q, stretch, values, nodes)
        if i == q.size:
            break
        sought = stable_bridge(at_separation(task, separation_at(q[i], rupture, stretch)), BRANCH_ENDS, nodes[:0])
        if sought.event != ARRIVED:
            break
        _fill(i, sought.stance.z, held_of(task), values, nodes)
        i += 1
    return rupture


@kernel
def _branch_of(row: Vector, control: int, stretched: bool) -> tuple[Task, float]:
    """Task of a row of pairs, and the length by which it is stretched."""
    value, k1, angle1, k2, angle2 = row
    stretch = stretch_of(value, k1 + k2) if stretched else math.inf
    if control != SUCTION:
        value /= math.pi
    return Task(0.0, value, k1, angle1, k2, angle2, control), stretch


@entry(plain_cost=0.04)
def foretold_range(
    control: int,
    stretched: bool,
    pairs: Rows,
    q: Vector,
    rupture: Vector,
    values: NDArray[np.float64],
    is_open: NDArray[np.bool_],
    nodes: Nodes,
    start: int,
    stop: int,
) -> None:
    """Branches all of whose bridges are where those nearer to rupture foretell them; others stay open."""
    for i in range(start, stop):
        task, stretch = _branch_of(pairs[i], control, stretched)
        walk, is_found = quick_end(task, BRANCH_ENDS)
        rupture[i], is_open[i] = walk.stance.separation, True
        if is_found and rupture[i] > 0.0:
            reached = _walked(0, walk, q, stretch, values[i], nodes)
            is_open[i] = reached < q.size


@entry(plain_cost=0.1, patience=10.0)
def branch_range(
    control: int,
    stretched: bool,
    pairs: Rows,
    q: Vector,
    rupture: Vector,
    values: NDArray[np.float64],
    nodes: Nodes,
    start: int,
    stop: int,
) -> None:
    """Branches for the rows from start to stop, wherever they lead."""
    for i in range(start, stop):
        task, stretch = _branch_of(pairs[i], control, stretched)
        rupture[i] = fill_branch(task, q, stretch, values[i], nodes)


def branches(control: int, stretched: bool, pairs: Rows, q: Vector, chunk: int) -> tuple[Vector, NDArray[np.float64]]:
    """Branches at the same q, ascending: the rupture distance of each row, and at each q the force, and V or H.

    Rows of ``pairs`` are (H or V, k1, θ1, k2, θ2). Those that are not foretold are left to the whole solver.
    """
    rupture, values = np.empty(len(pairs)), np.empty((len(pairs), q.size, 2))
    is_open, room = np.zeros(len(pairs), bool), Own(partial(np.empty, (q.size, 4)))
    over_rows(foretold_range, len(pairs), chunk, control, stretched, pairs, q, rupture, values, is_open, room)
    left = np.flatnonzero(is_open)
    if left.size:
        part = np.empty(left.size), np.empty((left.size, q.size, 2))
        over_rows(branch_range, left.size, chunk, control, stretched, pairs[left], q, *part, room)
        rupture[left], values[left] = part
    return rupture, values
