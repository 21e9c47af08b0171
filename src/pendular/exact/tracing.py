"""Whole force curves: from contact to the fold and down the unstable branch, as states ready to be drawn."""

import math

import numpy as np
from numpy.typing import NDArray

from .._jit import kernel
from .branches import begin, path_state, pinches_off
from .equilibrium import Solids, fold, is_limited_by_second, solve_suction, swapped
from .middle import SEPARATION, Vector, Vectors, correct, measure
from .path import FOLD, LOST, TARGET, Curve, heading_at, set_out, stride, walk
from .states import FAILED, FOUND, NO_BRIDGE, mark_fold, store, store_suction

Rows = NDArray[np.float64]

_THINNEST_ARC = 0.03  # wetted arc over the one at the fold where the unstable branch ends
_STEP = 0.05  # length of the steps of a traced curve
_MOST_STEPS = 400


@kernel
def _thins_out(z: Vector, solids: Solids) -> bool:
    """Whether a drawn unstable branch has come to its end: a thread of liquid, or solids in contact again."""
    return pinches_off(z, solids) or measure(z, solids).values[SEPARATION] < 0.0


@kernel
def _record(start: Vector, heading: Vector, curve: Curve, end: Vector, nodes: Vectors) -> int:
    """Steps along a curve to the end point, or to where it thins out if that is NaN; returns their number."""
    z, tangent = start, heading
    nodes[0] = start
    for i in range(1, nodes.shape[0]):
        left = np.sqrt(np.dot(end - z, end - z))
        if left < _STEP:
            nodes[i] = end
            return i + 1
        following, effort = stride(z, tangent, _STEP, curve)
        if math.isnan(effort) or (math.isnan(left) and _thins_out(following, curve.solids)):
            return i
        tangent = heading_at(measure(following, curve.solids), following, curve, tangent).tangent
        z = following
        nodes[i] = z
    return nodes.shape[0]


@kernel
def _spread(nodes: Vectors, count: int, curve: Curve, states: Rows, before_fold: bool) -> None:
    """States evenly spaced over the recorded nodes; after the fold the first node is left out, it is the fold."""
    rows = states.shape[0]
    if count < 2:
        return
    for i in range(rows):
        place = (count - 1) * (i / (rows - 1) if before_fold else (i + 1) / rows)
        node = min(int(place), count - 2)
        step = nodes[node + 1] - nodes[node]
        heading = step / np.sqrt(np.dot(step, step))
        z = nodes[node] + (place - node) * step
        correct(z, curve.solids, curve.held, curve.value, -1, np.dot(heading, z), heading)
        store(path_state(z, heading, curve, before_fold), states[i])


@kernel
def suction_curve(curvature: float, solids: Solids, states: Rows) -> int:
    """Contact, fold and unstable branch at one curvature H ≥ 0, evenly spaced in the wetted arc."""
    is_swapped = is_limited_by_second(curvature, solids)
    if is_swapped:
        solids = swapped(solids)
    top = fold(curvature, solids)
    thick = math.nan if math.isnan(top) else solve_suction(0.0, curvature, solids, False)
    if not thick > 0.0:
        states[:] = math.nan
        return NO_BRIDGE
    at_fold = states.shape[0] // 2
    for i in range(at_fold):
        store_suction(thick + (top - thick) * i / at_fold, curvature, solids, is_swapped, states[i])
    rest = states.shape[0] - 1 - at_fold
    for i in range(at_fold, states.shape[0]):
        thinning = (1.0 - _THINNEST_ARC) * (i - at_fold) / max(rest, 1)
        store_suction(top * (1.0 - thinning), curvature, solids, is_swapped, states[i])
    states[0, 0] = 0.0  # contact, which the solver meets to rounding
    mark_fold(states[at_fold], True)
    return FOUND


@kernel
def path_curve(held: int, value: float, solids: Solids, states: Rows) -> int:
    """Contact, fold and unstable branch at one volume, or one curvature H < 0, evenly spaced along the path."""
    curve = Curve(solids, held, value, SEPARATION)
    first = begin(curve)
    states[:] = math.nan
    if first.event != TARGET:
        return FAILED if first.event == LOST else NO_BRIDGE
    tangent = set_out(first.z, curve, 1.0)
    top = walk(first.z, tangent, curve, math.inf, 1.0, False)
    if top.event != FOLD:
        return FAILED
    at_fold = states.shape[0] // 2
    nodes = np.empty((_MOST_STEPS, 4))
    count = _record(first.z, tangent, curve, top.z, nodes)
    _spread(nodes, count, curve, states[: at_fold + 1], True)
    count = _record(top.z, top.tangent, curve, np.full(4, math.nan), nodes)
    _spread(nodes, count, curve, states[at_fold + 1 :], False)
    states[0, 0] = 0.0  # contact, which the solver meets to rounding
    mark_fold(states[at_fold], path_state(top.z, top.tangent, curve, True).stable > 0.0)
    return FOUND
