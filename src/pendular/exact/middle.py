"""Bridges of every shape, by the middle of their meridian.

Past an inflection, through a cylinder, or with a bulge, neither λ nor a wetted arc orders the bridges. The middle of
the meridian does: its radius Ym and slope φm, half its arc length ℓ and the phase ω = Hℓ determine the arc
(:func:`~pendular.exact.meridian.arc_across`), two equations say that it meets the solids at their contact
angles, two more hold what is controlled. All four are smooth wherever a bridge exists.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._jit import kernel
from .contact import Contact, cap_volume
from .equilibrium import Solids, are_equal
from .meridian import arc_across, point_and_rates

Vector = NDArray[np.float64]  # (ln Ym, φm, ln ℓ, ω)
Vectors = NDArray[np.float64]

# What can be held or driven along a path; also the rows of the measure after the two contact equations.
SEPARATION, VOLUME, CURVATURE = 2, 3, 4

_MAX_NEWTON = 12
_LAST_CHANGE = 1e-8  # quadratic convergence: the change after this one would be of the order of its square


class Measure(NamedTuple):
    """What a point of the (Ym, φm, ℓ, ω) space amounts to, with the rates of each row."""

    values: Vector  # two contact equations (zero at equilibrium), D, V, H
    rates: NDArray[np.float64]  # (5, 4)


class End(NamedTuple):
    """One end of the arc against its solid; the rates are with respect to (ln Ym, φm, ln ℓ, ω)."""

    contact: Contact
    mismatch: float  # kY - sin δ, with δ = π/2 - θ - ψ from the slope
    mismatch_rates: Vector
    sagitta_rates: Vector
    cap_rates: Vector


@kernel
def end_at(z: Vector, side: float, k: float, theta: float) -> End:
    """The end at arc length side·ℓ (side = -1 for solid 1, +1 for solid 2)."""
    half_length = math.exp(z[2])
    y = math.exp(z[0] - z[2])
    zeta, to_y, to_phase = point_and_rates(complex(y * math.cos(z[1]), y * math.sin(z[1])), z[3], side)
    size = abs(zeta)
    radius = half_length * size
    cos_slope, sin_slope = zeta.real / size, side * zeta.imag / size  # of ψ, outwards
    cos_theta, sin_theta = math.cos(theta), math.sin(theta)
    cos_filling = sin_theta * cos_slope + cos_theta * sin_slope
    sin_filling = cos_theta * cos_slope - sin_theta * sin_slope

    # Numba's division of complex numbers raises where this one gives NaN: at Y = 0, where a thin bridge ends.
    inverse = complex(cos_slope / size, -side * sin_slope / size)
    relative = np.empty((4, 2))  # δY/Y and δψ
    for column, change in ((0, to_y), (1, 1j * to_y), (3, to_phase)):
        ratio = change * inverse
        relative[column, 0] = ratio.real
        relative[column, 1] = side * ratio.imag
    relative[2, 0] = 1.0 - relative[0, 0]  # y = Ym/ℓ, and Y is measured in ℓ
    relative[2, 1] = -relative[0, 1]

    past_equator = k > 0.0 and cos_filling < -0.5
    sagitta = (1.0 - cos_filling) / k if past_equator else k * radius * radius / (1.0 + cos_filling)
    contact = Contact(radius, sagitta, cos_filling, sin_slope, cos_slope)
    mismatch_rates, sagitta_rates, cap_rates = np.empty(4), np.empty(4), np.empty(4)
    for i in range(4):
        grow, turn = relative[i, 0], relative[i, 1]
        mismatch_rates[i] = k * radius * grow + cos_filling * turn
        if past_equator:
            sagitta_rates[i] = -sin_filling * turn / k
        else:
            sagitta_rates[i] = sagitta * (2.0 * grow - sin_filling * turn / (1.0 + cos_filling))
        cap_rates[i] = (
            0.5 * math.pi * (radius * radius + sagitta * sagitta) * sagitta_rates[i]
            + math.pi * sagitta * radius * radius * grow
        )
    return End(contact, k * radius - sin_filling, mismatch_rates, sagitta_rates, cap_rates)


@kernel
def measure(z: Vector, solids: Solids) -> Measure:
    """Contact mismatches, D, V and H of an arc, with their rates of change."""
    symmetric = are_equal(solids)
    half_length, y = math.exp(z[2]), math.exp(z[0] - z[2])
    first = end_at(z, -1.0, solids.k1, solids.theta1)
    second = end_at(z, 1.0, solids.k2, solids.theta2)
    across = arc_across(y, z[1], z[3], symmetric)
    cube = half_length**3

    values, rates = np.empty(5), np.zeros((5, 4))
    values[0], rates[0] = first.mismatch, first.mismatch_rates
    if symmetric:  # the second contact says the same as the first; the mirror symmetry takes its place
        values[1], rates[1, 1] = z[1], 1.0
    else:
        values[1], rates[1] = second.mismatch, second.mismatch_rates
    values[SEPARATION] = half_length * across.length - first.contact.sagitta - second.contact.sagitta
    values[VOLUME] = cube * across.volume - cap_volume(first.contact) - cap_volume(second.contact)
    values[CURVATURE] = z[3] / half_length
    length_rates, volume_rates = across.length_rates, across.volume_rates
    for i, column in ((0, 0), (1, 1), (2, 3)):
        rates[SEPARATION, column] = half_length * length_rates[i]
        rates[VOLUME, column] = cube * volume_rates[i]
    rates[SEPARATION, 2] = half_length * (across.length - length_rates[0])
    rates[VOLUME, 2] = cube * (3.0 * across.volume - volume_rates[0])
    for i in range(4):
        rates[SEPARATION, i] -= first.sagitta_rates[i] + second.sagitta_rates[i]
        rates[VOLUME, i] -= first.cap_rates[i] + second.cap_rates[i]
    rates[CURVATURE, 2] = -values[CURVATURE]
    rates[CURVATURE, 3] = 1.0 / half_length
    return Measure(values, rates)


@kernel
def solve4(matrix: NDArray[np.float64], right: Vector) -> float:
    """Solve four linear equations in place, by elimination with row pivots; returns the determinant."""
    determinant = 1.0
    for column in range(4):
        pivot = column
        for row in range(column + 1, 4):
            if abs(matrix[row, column]) > abs(matrix[pivot, column]):
                pivot = row
        if pivot != column:
            for i in range(4):
                matrix[column, i], matrix[pivot, i] = matrix[pivot, i], matrix[column, i]
            right[column], right[pivot] = right[pivot], right[column]
            determinant = -determinant
        determinant *= matrix[column, column]
        for row in range(column + 1, 4):
            factor = matrix[row, column] / matrix[column, column]
            for i in range(column, 4):
                matrix[row, i] -= factor * matrix[column, i]
            right[row] -= factor * right[column]
    for row in range(3, -1, -1):
        for i in range(row + 1, 4):
            right[row] -= matrix[row, i] * right[i]
        right[row] /= matrix[row, row]
    return determinant


@kernel
def unit_of(row: int, z: Vector, value: float) -> float:
    """The size that a deviation of a row is measured in: ℓ for D, the volume itself, 1/ℓ for H."""
    if row == SEPARATION:
        return math.exp(z[2])
    return value if row == VOLUME else math.exp(-z[2])


@kernel
def correct(z: Vector, solids: Solids, held: int, held_value: float, fourth: int, goal: float, along: Vector) -> float:
    """Newton's method, in place, to an equilibrium with one quantity held.

    The fourth equation is another row equal to its goal or, for a negative row number, the hyperplane along·z = goal.
    Returns the number of steps, NaN if it did not converge.
    """
    for step in range(_MAX_NEWTON):
        found = measure(z, solids)
        matrix, right = np.empty((4, 4)), np.empty(4)
        for i in range(2):
            matrix[i], right[i] = found.rates[i], -found.values[i]
        unit = unit_of(held, z, held_value)
        matrix[2], right[2] = found.rates[held] / unit, (held_value - found.values[held]) / unit
        if fourth >= 0:
            unit = unit_of(fourth, z, goal)
            matrix[3], right[3] = found.rates[fourth] / unit, (goal - found.values[fourth]) / unit
        else:
            matrix[3], right[3] = along, goal - np.dot(along, z)
        solve4(matrix, right)
        size = np.max(np.abs(right))
        if not size < 2.0:
            return math.nan
        z += right
        if size < _LAST_CHANGE:
            return step + 1.0
    return math.nan
