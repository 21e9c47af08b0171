r"""Bridges at given places between rupture and contact, in a coordinate in which the branch is smooth.

With D_c the rupture distance, the coordinate is :math:`q = \sqrt{1 - D/D_c}`: 0 at rupture, 1 at contact. A force curve
has a vertical tangent at rupture as a function of D, and none as a function of q.

A small volume spreads fast when the solids move apart: then the force falls within a distance d of contact much shorter
than D_c. The stretched coordinate, with asinh(D/d) in the place of D, is smooth in such a curve as well.
"""

import math

import numpy as np
from numpy.typing import NDArray

from .._jit import kernel
from .branches import begin, force_of
from .equilibrium import Solids, balance_at, fold, is_limited_by_second, solve_suction, suction_state, swapped
from .middle import CURVATURE, SEPARATION, VOLUME, Vector, Vectors, correct, measure
from .path import FOLD, PITCHFORK, TARGET, Curve, Walk, set_out, walk

Rows = NDArray[np.float64]

_MOST_STEPS = 6
_NEAR = 0.25  # largest step, over the way from the fold: the other branch is at 2
_LAST_STEP = 1e-8  # over the way from the fold


@kernel
def stretch_of(volume: float, solids: Solids) -> float:
    """Distance d from contact in which the force of a small volume falls: √(2V/πR̄)."""
    return math.sqrt((solids.k1 + solids.k2) * volume / math.pi)


@kernel
def separation_at(q: float, rupture: float, stretch: float) -> float:
    """D at a coordinate q, stretched by the length d; an infinite d does not stretch."""
    if math.isinf(stretch):
        return rupture * (1.0 - q * q)
    return stretch * math.sinh(math.asinh(rupture / stretch) * (1.0 - q * q))


@kernel
def weight_of(q: Vector, j: int, first: int, stop: int, i: int) -> float:
    """Lagrange's weight at q[i] of bridge j among those from first to stop; number -1 is the fold, at q = 0."""
    weight, place = 1.0, q[j] if j >= 0 else 0.0
    for k in range(first, stop):
        if k != j:
            other = q[k] if k >= 0 else 0.0
            weight *= (q[i] - other) / (place - other)
    return weight


@kernel
def _arc_foretold(q: Vector, i: int, top: float, arcs: Vector) -> float:
    """Wetted arc at q[i], ascending, by the polynomial through those of up to three bridges before it."""
    first = max(i - 3, -1)
    foretold = 0.0
    for j in range(first, i):
        foretold += weight_of(q, j, first, i, i) * (arcs[j] if j >= 0 else top)
    return foretold


@kernel
def _arc_near(guess: float, top: float, separation: float, curvature: float, solids: Solids) -> float:
    """Wetted arc on the stable branch by Newton's method from a good guess; NaN if it is not so good."""
    arc = guess
    for _ in range(_MOST_STEPS):
        balance = balance_at(arc, curvature, solids)
        step = (balance.separation - separation) / balance.rate
        if not (balance.rate < 0.0 and abs(step) < _NEAR * (arc - top)):
            return math.nan
        arc -= step
        if abs(step) < _LAST_STEP * (arc - top):  # convergence is quadratic
            return arc
    return math.nan


@kernel
def suction_fractions(curvature: float, solids: Solids, q: Vector, values: Rows) -> float:
    """Force λ and volume V at each q under the curvature H ≥ 0; returns the rupture distance, NaN if there is none."""
    values[:] = math.nan
    if is_limited_by_second(curvature, solids):
        solids = swapped(solids)
    top = fold(curvature, solids)
    if math.isnan(top):
        return math.nan
    rupture = balance_at(top, curvature, solids).separation
    arcs = np.empty(q.size)
    for i in range(q.size):
        separation = rupture * (1.0 - q[i] * q[i])
        arcs[i] = _arc_near(_arc_foretold(q, i, top, arcs), top, separation, curvature, solids)
        if math.isnan(arcs[i]):
            arcs[i] = solve_suction(separation, curvature, solids, False)
        if arcs[i] > 0.0:
            state = suction_state(arcs[i], curvature, solids)
            values[i, 0], values[i, 1] = state.force, state.volume
    return rupture


@kernel
def _foretold(q: Vector, i: int, passed: Vectors, separation: float, curve: Curve) -> tuple[Vector, bool]:
    """Bridge at q[i] by Newton's method from what the three bridges above it foretell, and whether that went well."""
    guess = np.zeros(4)
    for j in range(i + 1, i + 4):
        guess += weight_of(q, j, i + 1, i + 4, i) * passed[j]
    z = guess.copy()
    effort = correct(z, curve.solids, curve.held, curve.value, SEPARATION, separation, z)
    moved = np.max(np.abs(guess - passed[i + 1]))
    to_other_branch = 2.0 * q[i] / (q[i + 1] - q[i])  # in units of what was moved: it is at -q
    return z, not math.isnan(effort) and np.max(np.abs(z - guess)) < min(0.2, 0.25 * to_other_branch) * moved


@kernel
def walk_branch(curve: Curve, stretch: float, q: Vector, passed: Vectors) -> Walk:
    """Bridges at each q, ascending, on the way from contact to where the branch first loses stability: the walk's end.

    NaN where a bridge, and all that are nearer to rupture, could not be reached.
    """
    passed[:] = math.nan
    first = begin(curve)
    if first.event != TARGET:
        return first
    z = first.z
    top = walk(z, set_out(z, curve, 1.0), curve, math.inf, 1.0, True)
    if top.event not in (FOLD, PITCHFORK):
        return top
    rupture = measure(top.z, curve.solids).values[SEPARATION]
    for i in range(q.size - 1, -1, -1):  # from contact, as all stable bridges are reached
        separation = separation_at(q[i], rupture, stretch)
        is_met = False
        if i + 3 < q.size:
            following, is_met = _foretold(q, i, passed, separation, curve)
        if not is_met:
            way = walk(z, set_out(z, curve, 1.0), curve, separation, 1.0, False)
            if way.event != TARGET:
                return top
            following = way.z
        z = following
        passed[i] = z
    return top


@kernel
def note_branch(passed: Vectors, values: Rows) -> None:
    """Force λ and curvature H of the bridges of a branch."""
    for i in range(passed.shape[0]):
        values[i, 0], values[i, 1] = force_of(passed[i]), passed[i, 3] * math.exp(-passed[i, 2])


@kernel
def volume_fractions(volume: float, solids: Solids, q: Vector, values: Rows) -> float:
    """Force λ and curvature H at each q, ascending, at the volume; returns where the bridge first loses stability."""
    curve = Curve(solids, VOLUME, volume, SEPARATION)
    passed = np.empty((q.size, 4))
    top = walk_branch(curve, math.inf, q, passed)
    note_branch(passed, values)
    is_end = top.event == FOLD or top.event == PITCHFORK
    return measure(top.z, solids).values[SEPARATION] if is_end else math.nan


@kernel
def fractions_range(held: int, pairs: Rows, q: Rows, rupture: Vector, values: Rows, start: int, stop: int) -> None:
    """Rows of ``pairs`` are (H or V, k1, θ1, k2, θ2); ``values`` has for each row and q the force, and V or H."""
    for i in range(start, stop):
        solids = Solids(pairs[i, 1], pairs[i, 2], pairs[i, 3], pairs[i, 4])
        if held == CURVATURE:
            rupture[i] = suction_fractions(pairs[i, 0], solids, q[i], values[i])
        else:
            rupture[i] = volume_fractions(pairs[i, 0], solids, q[i], values[i])
