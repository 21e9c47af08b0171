"""Quantities beyond force and liquid that a table file may hold: polynomials in the cells of the table."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..exact.state import State
from .arrays import FORCE, evaluate
from .binary import Channel
from .build import cells_of
from .cuts import chebyshev, controls_at
from .kernels import Q0, Q1, Q_COUNT, Q_FIRST, Q_SHIFT, U0, U1, U_COUNT, U_FIRST, U_SHIFT, X0, X1, Grid
from .measure import NEAREST_RUPTURE, SAFETY, SEED, all_cells, between, exact_states, own_rows, position
from .polynomial import CONTROL_TERMS, LANES, SIZE_TERMS, cells_from
from .samples import pairs_of
from .task import Task, refuse_dry

__all__ = ["Filled", "fill", "known"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


def _of_bridge(unit: str, radius: int, bound_of: str = "its value at contact") -> Channel:
    return Channel(unit, bound_of, 1.0, True, 0, radius, 0)


_SHARED = {
    "neck_radius": _of_bridge("m", 1),
    "across_tensor": _of_bridge("m2", 2),
    "axial_tensor": _of_bridge("m2", 2),
    "area": _of_bridge("m2", 2),
}
# Of solids that are wetted alike, the angle on either is no smooth function of |s|, as their table is: the mean of
# the two is, and their difference, smaller minus larger solid, over s.
_ANGLES = {
    1: {"half_filling_mean": _of_bridge("rad", 0, "1 rad"), "half_filling_slope": _of_bridge("rad", 0, "2 rad over s")},
    2: {"half_filling1": _of_bridge("rad", 0, "1 rad"), "half_filling2": _of_bridge("rad", 0, "1 rad")},
}


def known(sides: int) -> dict[str, Channel]:
    """The quantities of tables of so many sides."""
    return _SHARED | _ANGLES[sides]


class Filled(NamedTuple):
    """A quantity of a table: what it is, its error, and its coefficients, as those of the force."""

    name: str
    channel: Channel
    bound: float
    coefficients: Floats


def fill(grid: Grid, task: Task, names: Sequence[str]) -> list[Filled]:
    """Fill the cells of a table with quantities, from exact bridges, and measure their errors.

    Raises
    ------
    ValueError
        If some bridge has no such quantity, as one that pushes has no neck, or there are no bridges.
    """
    if not names:
        return []
    if task.is_dry:
        refuse_dry(task.angles)
    rows = own_rows(grid)
    coefficients = np.concatenate([cells_of(_values(grid, task, row, names), task.tolerance) for row in rows], 1)
    channels, worst = known(grid.sides), np.zeros(len(names))
    for places in all_cells(grid, rows, np.random.default_rng(SEED)):
        control, size, q = position(grid, task, places)
        s = task.s_of(size)
        pairs = pairs_of(task, control, size, places.cell[:, 0] // grid.cells)
        states, separation, _ = exact_states(task, pairs, np.column_stack([q, np.ones(len(q))]), NEAREST_RUPTURE)
        gap = separation[:, :-1]
        with np.errstate(divide="ignore"):
            radii = 1.0 / pairs[:, 1], 1.0 / pairs[:, 3]
        each = [np.repeat(operand, q.shape[1]) for operand in (control, *radii)]
        for i, name in enumerate(names):
            polynomial = np.empty(gap.size)
            evaluate(
                FORCE, grid._replace(force=cells_from(coefficients[i])), (gap.ravel(), *each, np.ones(1)), polynomial
            )
            found = polynomial.reshape(gap.shape) / (2.0 * math.pi)
            worst[i] = max(worst[i], _error(channels[name], found, _taken(states, s, name), s))
    filled = zip(names, SAFETY * worst, coefficients, strict=True)
    return [Filled(name, channels[name], float(bound), numbers) for name, bound, numbers in filled]


def _error(channel: Channel, found: Floats, exact: Floats, s: Floats) -> float:
    """Largest error on curves; the exact values end in that at contact."""
    errors = np.abs(found - exact[:, :-1])
    if channel.bound_of == "1 rad":
        return float(errors.max())
    if channel.bound_of == "2 rad over s":  # equal spheres have no difference
        is_unequal = s > 0.0
        return float((0.5 * s[is_unequal, None] * errors[is_unequal]).max(initial=0.0))
    return float((errors / exact[:, -1:]).max())


def _values(grid: Grid, task: Task, row: int, names: Sequence[str]) -> Floats:
    """Values at the interpolation points of the cells of a row: (quantities, 1, size, q, x, y, t)."""
    line, cut = grid.lines[row], grid.cuts[row]
    control = controls_at(chebyshev(CONTROL_TERMS), line[X0], line[X1])
    size = np.full((cut[U_COUNT], SIZE_TERMS), task.sizes[0])
    if line[U1] != 0.0:
        size = (_places(cut[[U_SHIFT, U_FIRST, U_COUNT]], SIZE_TERMS) - line[U0]) / line[U1]
    q = (_places(cut[[Q_SHIFT, Q_FIRST, Q_COUNT]], LANES) - line[Q0]) / line[Q1]
    shape = (*size.shape, control.size)
    controls, sizes = (np.broadcast_to(each, shape).ravel() for each in (control, size[..., None]))
    pairs = pairs_of(task, controls, sizes, np.full(controls.size, row // grid.cells))
    states = exact_states(task, pairs, np.broadcast_to(q.ravel(), (controls.size, q.size))).states
    values = np.stack([_taken(states, task.s_of(sizes), name) for name in names])
    for name in _lacking(values, names):
        raise ValueError(f"channels: {name!r} is not there for some bridges of this table; one that pushes has no neck")
    return np.transpose(values.reshape(len(names), *shape, *q.shape), (0, 1, 4, 3, 2, 5))[:, None]


def _places(cut: Integers, terms: int) -> Floats:
    """Interpolation points in all cells of a cut, as the number w."""
    shift, first, count = cut
    return between(np.arange(count)[:, None], chebyshev(terms), shift, first)


def _taken(states: Floats, s: Floats, name: str) -> Floats:
    """A quantity of states, (curves, q)."""
    angle1, angle2 = (states[..., State._fields.index(field)] for field in ("filling1", "filling2"))
    if name in ("half_filling1", "half_filling2"):
        return angle1 if name == "half_filling1" else angle2
    if name == "half_filling_mean":
        return 0.5 * (angle1 + angle2)
    if name == "half_filling_slope":
        with np.errstate(divide="ignore", invalid="ignore"):
            return (angle1 - angle2) / s[:, None]
    return states[..., State._fields.index(name)]


def _lacking(values: Floats, names: Sequence[str]) -> Iterator[str]:
    return (name for name, each in zip(names, values, strict=True) if np.isnan(each).any())
