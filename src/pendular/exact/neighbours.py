"""Curves of bridges of one volume for many similar pairs, each found from that of a neighbour.

A walk from contact finds the first curve. The next ones differ little from it: Newton's method takes the fold of a
neighbour to the fold of the curve, and from there on every bridge is foretold by how much the ones nearer to the fold
have moved. What is found has to be the same branch: it has the same orientation, it moved little compared with the way
to the other branch, and the fold is a maximum of the separation. Wherever that fails, the curve is walked.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._jit import kernel
from .equilibrium import Solids, are_equal
from .fractions import note_branch, separation_at, stretch_of, suction_fractions, walk_branch, weight_of
from .middle import CURVATURE, SEPARATION, VOLUME, Measure, Vector, Vectors, measure, solve4, unit_of
from .path import FOLD, PITCHFORK, Curve, Heading, antisymmetric_margin, heading_at

Rows = NDArray[np.float64]

BLOCK = 64  # curves that are found from each other
_MOST_STEPS = 10
_LAST_CHANGE = 1e-8  # quadratic convergence: the change after this one would be of the order of its square
_FARTHEST = 0.3  # largest change of a fold between neighbours
_LEAST_COSINE = 0.8  # of the turn of the curve at the fold
_NEAR = 0.25  # largest miss of a foretold bridge, over its way from the fold: the other branch is at 2
_DIFFERENCE = 1e-5


class Fold(NamedTuple):
    """The end of a branch, where the separation is largest."""

    rupture: float  # NaN if it was not found
    z: Vector
    gradient: Vector  # of the slope at the fold, in z
    heading: Heading


class Branch(NamedTuple):
    """A curve from its fold to contact."""

    fold: Fold
    passed: Vectors  # the bridges at the places that are asked
    orientation: float  # sign of the determinant of the equations of a bridge at its volume and separation


@kernel
def _equations(found: Measure, z: Vector, curve: Curve, matrix: Vectors, right: Vector) -> None:
    """Newton's equations for a bridge that holds what the curve holds; the fourth one is left open."""
    for i in range(2):
        matrix[i], right[i] = found.rates[i], -found.values[i]
    unit = unit_of(curve.held, z, curve.value)
    matrix[2], right[2] = found.rates[curve.held] / unit, (curve.value - found.values[curve.held]) / unit


@kernel
def _slope_at(z: Vector, curve: Curve, like: Vector) -> tuple[float, Heading, Measure]:
    """Rate of D along the curve through a point, in units of ℓ."""
    found = measure(z, curve.solids)
    heading = heading_at(found, z, curve, like)
    return np.dot(found.rates[SEPARATION], heading.tangent) / math.exp(z[2]), heading, found


@kernel
def _gradient_at(z: Vector, curve: Curve, like: Vector) -> Vector:
    """Rates of the slope, by differences."""
    gradient = np.empty(4)
    for i in range(4):
        moved = z.copy()
        moved[i] += _DIFFERENCE
        above = _slope_at(moved, curve, like)[0]
        moved[i] -= 2.0 * _DIFFERENCE
        gradient[i] = (above - _slope_at(moved, curve, like)[0]) / (2.0 * _DIFFERENCE)
    return gradient


@kernel
def _fold_near(known: Fold, curve: Curve) -> Fold:
    """Fold of a curve by Newton's method from that of a neighbour, with Broyden's update of the gradient."""
    z, gradient = known.z.copy(), known.gradient.copy()
    matrix, change = np.empty((4, 4)), np.empty(4)
    last, last_slope = np.zeros(4), 0.0
    rupture = math.nan
    for step in range(_MOST_STEPS):
        slope, heading, found = _slope_at(z, curve, known.heading.tangent)
        if step > 0:
            gradient += (slope - last_slope - np.dot(gradient, last)) / np.dot(last, last) * last
        _equations(found, z, curve, matrix, change)
        matrix[3], change[3] = gradient, -slope
        solve4(matrix, change)
        size = np.max(np.abs(change))
        if not size < 0.5:
            break
        z += change
        if size < _LAST_CHANGE:
            rupture = found.values[SEPARATION] + np.dot(found.rates[SEPARATION], change)
            break
        last[:] = change
        last_slope = slope
    is_same = (
        rupture > 0.0
        and heading.hand == known.heading.hand
        and np.dot(heading.tangent, gradient) < 0.0
        and np.dot(heading.tangent, known.heading.tangent) > _LEAST_COSINE
        and np.max(np.abs(z - known.z)) < _FARTHEST
    )
    return Fold(rupture if is_same else math.nan, z, gradient, heading)


@kernel
def _settle(z: Vector, curve: Curve, separation: float) -> float:
    """Newton's method, in place, to the bridge at a separation: determinant of the equations, NaN if it failed."""
    matrix, change = np.empty((4, 4)), np.empty(4)
    for _ in range(_MOST_STEPS):
        found = measure(z, curve.solids)
        _equations(found, z, curve, matrix, change)
        unit = math.exp(z[2])
        matrix[3], change[3] = found.rates[SEPARATION] / unit, (separation - found.values[SEPARATION]) / unit
        determinant = solve4(matrix, change)
        size = np.max(np.abs(change))
        if not size < 0.5:
            return math.nan
        z += change
        if size < _LAST_CHANGE:
            return determinant
    return math.nan


@kernel
def _foretold_change(q: Vector, i: int, at_fold: Vector, changes: Vectors) -> Vector:
    """Change of the bridge at q[i], ascending, by the polynomial through the changes of up to three before it."""
    first = max(i - 3, -1)
    foretold = np.zeros(4)
    for j in range(first, i):
        foretold += weight_of(q, j, first, i, i) * (changes[j] if j >= 0 else at_fold)
    return foretold


@kernel
def _withstands(z: Vector, solids: Solids) -> bool:
    """Whether a bridge of mirror images withstands the antisymmetric mode, which may end a branch before its fold."""
    return not are_equal(solids) or antisymmetric_margin(z, solids) > 0.0


@kernel
def _branch_near(known: Branch, curve: Curve, stretch: float, q: Vector) -> Branch:
    """Curve found from a neighbour; its rupture is NaN if that failed."""
    fold = _fold_near(known.fold, curve)
    passed, changes = np.empty((q.size, 4)), np.empty((q.size, 4))
    is_good = fold.rupture > 0.0 and _withstands(fold.z, curve.solids)
    i = 0
    while is_good and i < q.size:
        passed[i] = known.passed[i] + _foretold_change(q, i, fold.z - known.fold.z, changes)
        foretold = passed[i].copy()
        determinant = _settle(passed[i], curve, separation_at(q[i], fold.rupture, stretch))
        miss, way = np.max(np.abs(passed[i] - foretold)), np.max(np.abs(foretold - fold.z))
        is_good = determinant * known.orientation > 0.0 and miss < _NEAR * way and _withstands(passed[i], curve.solids)
        changes[i] = passed[i] - known.passed[i]
        i += 1
    return Branch(fold if is_good else Fold(math.nan, fold.z, fold.gradient, fold.heading), passed, known.orientation)


@kernel
def _branch_walked(curve: Curve, stretch: float, q: Vector) -> tuple[Branch, bool]:
    """Curve found by a walk from contact, and whether others can be found from it."""
    passed = np.empty((q.size, 4))
    top = walk_branch(curve, stretch, q, passed)
    _, heading, found = _slope_at(top.z, curve, top.tangent)
    rupture = found.values[SEPARATION] if top.event == FOLD or top.event == PITCHFORK else math.nan
    fold = Fold(rupture, top.z, _gradient_at(top.z, curve, heading.tangent), heading)
    matrix, right = np.empty((4, 4)), np.empty(4)
    at_contact = measure(passed[-1], curve.solids)
    _equations(at_contact, passed[-1], curve, matrix, right)
    matrix[3] = at_contact.rates[SEPARATION]
    return Branch(fold, passed, solve4(matrix, right)), top.event == FOLD and not np.isnan(passed).any()


class Known(NamedTuple):
    """The curves of a block that others can be found from, row by row."""

    usable: NDArray[np.bool_]
    folds: Rows  # z, the gradient of the slope, the tangent, and the hand
    passed: NDArray[np.float64]  # (rows, q, 4)
    orientations: Vector


@kernel
def _remember(known: Known, row: int, branch: Branch) -> None:
    fold = branch.fold
    known.usable[row] = True
    known.folds[row, :4], known.folds[row, 4:8], known.folds[row, 8:12] = fold.z, fold.gradient, fold.heading.tangent
    known.folds[row, 12] = fold.heading.hand
    known.passed[row], known.orientations[row] = branch.passed, branch.orientation


@kernel
def _recall(known: Known, row: int) -> Branch:
    fold = known.folds[row]
    heading = Heading(fold[8:12], fold[12])
    return Branch(Fold(math.nan, fold[:4], fold[4:8], heading), known.passed[row], known.orientations[row])


@kernel
def _nearest(known: Known, pairs: Rows, i: int, steepness: float) -> int:
    """The known row nearest to a row, in volume and in curvature of the solids; -1 if there is none."""
    nearest, least = -1, math.inf
    for j in range(i):
        if known.usable[j]:
            away = (0.25 * math.log(pairs[i, 0] / pairs[j, 0])) ** 2 + (steepness * (pairs[i, 1] - pairs[j, 1])) ** 2
            if away < least:
                nearest, least = j, away
    return nearest


@kernel
def _solve_block(pairs: Rows, q: Vector, rupture: Vector, values: Rows) -> int:
    """Curves of one volume, each from a neighbour where that goes well; returns how many were walked."""
    rows = pairs.shape[0]
    known = Known(np.zeros(rows, np.bool_), np.empty((rows, 13)), np.empty((rows, q.size, 4)), np.empty(rows))
    walked = 0
    for i in range(rows):
        solids = Solids(pairs[i, 1], pairs[i, 2], pairs[i, 3], pairs[i, 4])
        curve = Curve(solids, VOLUME, pairs[i, 0], SEPARATION)
        stretch = stretch_of(pairs[i, 0], solids)
        is_found = False
        tried = -1
        for steepness in (1.0, 8.0):
            neighbour = _nearest(known, pairs, i, steepness)
            if neighbour >= 0 and neighbour != tried and not is_found:
                branch = _branch_near(_recall(known, neighbour), curve, stretch, q)
                is_found = branch.fold.rupture > 0.0
                tried = neighbour
        if not is_found:
            branch, is_found = _branch_walked(curve, stretch, q)
            walked += 1
        if is_found:
            _remember(known, i, branch)
        rupture[i] = branch.fold.rupture
        note_branch(branch.passed, values[i])
    return walked


@kernel
def blocks_range(
    held: int,
    pairs: Rows,
    q: Vector,
    rupture: Vector,
    values: NDArray[np.float64],
    walked: NDArray[np.int64],
    start: int,
    stop: int,
) -> None:
    """Curves at the same q, ascending, for the blocks from start to stop; ``walked`` counts per block.

    Rows of ``pairs`` are (H or V, k1, θ1, k2, θ2), neighbours next to each other; at a given volume q is stretched.
    ``values`` has for each row and q the force, and V or H.
    """
    for block in range(start, stop):
        rows = slice(block * BLOCK, min((block + 1) * BLOCK, rupture.size))
        if held == CURVATURE:
            for i in range(rows.start, rows.stop):
                solids = Solids(pairs[i, 1], pairs[i, 2], pairs[i, 3], pairs[i, 4])
                rupture[i] = suction_fractions(pairs[i, 0], solids, q, values[i])
        else:
            walked[block] = _solve_block(pairs[rows], q, rupture[rows], values[rows])
