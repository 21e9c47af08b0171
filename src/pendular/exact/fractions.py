"""Bridges at given fractions of the way from rupture to contact, in the coordinate in which the branch is smooth.

With D_c the rupture distance, the coordinate is q = √(1 - D/D_c): 0 at rupture, 1 at contact. A force curve has a
vertical tangent at rupture as a function of D, and none as a function of q.
"""

import math

import numpy as np
from numpy.typing import NDArray

from .._jit import kernel
from .branches import begin, force_of
from .equilibrium import Solids, balance_at, fold, is_limited_by_second, solve_suction, suction_state, swapped
from .middle import CURVATURE, SEPARATION, VOLUME, Vector, correct, measure
from .path import FOLD, PITCHFORK, TARGET, Curve, set_out, walk

Rows = NDArray[np.float64]


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
    for i in range(q.size):
        arc = solve_suction(rupture * (1.0 - q[i] * q[i]), curvature, solids, False)
        if arc > 0.0:
            state = suction_state(arc, curvature, solids)
            values[i, 0], values[i, 1] = state.force, state.volume
    return rupture


@kernel
def _foretold(q: Vector, i: int, passed: Rows, separation: float, curve: Curve) -> tuple[Vector, bool]:
    """Bridge at q[i] by Newton's method from what the three bridges above it foretell, and whether that went well."""
    guess = np.zeros(4)
    for j in range(i + 1, i + 4):  # Lagrange
        weight = 1.0
        for k in range(i + 1, i + 4):
            if k != j:
                weight *= (q[i] - q[k]) / (q[j] - q[k])
        guess += weight * passed[j]
    z = guess.copy()
    effort = correct(z, curve.solids, curve.held, curve.value, SEPARATION, separation, z)
    moved = np.max(np.abs(guess - passed[i + 1]))
    to_other_branch = 2.0 * q[i] / (q[i + 1] - q[i])  # in units of what was moved: it is at -q
    return z, not math.isnan(effort) and np.max(np.abs(z - guess)) < min(0.2, 0.25 * to_other_branch) * moved


@kernel
def volume_fractions(volume: float, solids: Solids, q: Vector, values: Rows) -> float:
    """Force λ and curvature H at each q, ascending, at the volume; returns where the bridge first loses stability."""
    values[:] = math.nan
    curve = Curve(solids, VOLUME, volume, SEPARATION)
    first = begin(curve)
    if first.event != TARGET:
        return math.nan
    z = first.z
    top = walk(z, set_out(z, curve, 1.0), curve, math.inf, 1.0, True)
    if top.event not in (FOLD, PITCHFORK):
        return math.nan
    rupture = measure(top.z, solids).values[SEPARATION]
    passed = np.empty((q.size, 4))
    for i in range(q.size - 1, -1, -1):  # from contact, as all stable bridges are reached
        separation = rupture * (1.0 - q[i] * q[i])
        is_met = False
        if i + 3 < q.size:
            following, is_met = _foretold(q, i, passed, separation, curve)
        if not is_met:
            way = walk(z, set_out(z, curve, 1.0), curve, separation, 1.0, False)
            if way.event != TARGET:
                return rupture
            following = way.z
        z = following
        passed[i] = z
        values[i, 0], values[i, 1] = force_of(z), z[3] * math.exp(-z[2])
    return rupture


@kernel
def fractions_range(held: int, pairs: Rows, q: Rows, rupture: Vector, values: Rows, start: int, stop: int) -> None:
    """Rows of ``pairs`` are (H or V, k1, θ1, k2, θ2); ``values`` has for each row and q the force, and V or H."""
    for i in range(start, stop):
        solids = Solids(pairs[i, 1], pairs[i, 2], pairs[i, 3], pairs[i, 4])
        if held == CURVATURE:
            rupture[i] = suction_fractions(pairs[i, 0], solids, q[i], values[i])
        else:
            rupture[i] = volume_fractions(pairs[i, 0], solids, q[i], values[i])
