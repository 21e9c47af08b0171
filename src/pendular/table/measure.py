"""The error of a table: a search for the worst place, on exact bridges that it was not made from.

The error of an interpolation in three coordinates is largest where the errors along each of them are, near the ends of
a cell and between its nodes. So bridges are compared in all cells, most of them near ends and many at corners. From
the worst places the search goes on by random steps in the cell, ever smaller ones. A place that is worse still may be
left, hence the factor in what is stated.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..exact.batch import RUPTURE as END
from ..exact.batch import STABLE, answer
from ..exact.branch import stretches_of
from ..exact.equations import SUCTION, VOLUME
from ..exact.state import State
from .arrays import FORCE, LIQUID, RUPTURE, evaluate
from .cuts import controls_at
from .kernels import (
    CELLS,
    Q0,
    Q1,
    Q_COUNT,
    Q_FIRST,
    Q_SHIFT,
    U0,
    U1,
    U_COUNT,
    U_FIRST,
    U_SHIFT,
    X0,
    X1,
    Grid,
)
from .samples import pairs_of
from .task import Task

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

SAFETY = 1.75  # the stated bound over the largest error that the search finds
SEED = 20260
NEAREST_RUPTURE = 1.0 - 4e-6  # D/D_c
_CORNERS = np.array([[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]])  # of a cell of control and size
_CURVES, _LEAST_CURVES = 8, 4000  # in each cell of control and size; in all, where there are few cells
_PLACES = 16  # on a curve
_AT_ENDS = 0.3  # share of the coordinates that are one of the two ends of a cell
_SCALE = np.array([1.0, 0.6, 0.3])  # q at which the largest force of a curve is looked for
_WORST, _STEPS, _WIDTHS = 200, 8, (0.3, 0.1, 0.03, 0.01)  # of the search from the worst places; widths in half cells
_CURVES_AT_ONCE = 8192
_COLUMNS = [State._fields.index(name) for name in ("force", "volume", "curvature")]


class Bound(NamedTuple):
    """Largest errors that a search found, times ``SAFETY``."""

    force: float  # over the largest force of the bridge, mostly that at contact; up to 1 - D/D_c = 4e-6
    rupture: float  # of the rupture distance, relative
    liquid: float  # of the volume, over that at contact; of the suction, over γ√(R̄/V)
    bridges: int  # number of bridges that were compared


class Places(NamedTuple):
    """Places in cells: one on each curve, or a row of them in the last axis of what belongs to q."""

    cell: Integers  # (curves, 2): row of the headers, and cell of the size among those of the row
    q_cell: Integers  # among those of the row
    pair: Floats  # (curves, 2): control and size, in coordinates of the cell from -1 to 1
    t: Floats  # q, likewise

    def taken(self, chosen: Integers) -> "Places":
        """Some of the curves."""
        return Places(self.cell[chosen], self.q_cell[chosen], self.pair[chosen], self.t[chosen])


class Errors(NamedTuple):
    """Errors on curves: of the rupture distance, and at the places of each curve."""

    rupture: Floats  # (curves,)
    force: Floats  # (curves, places)
    liquid: Floats


class Measured(NamedTuple):
    """What a search of each part of a table found."""

    errors: Floats  # (parts, 3): largest of force, rupture distance and liquid, times ``SAFETY``
    bridges: Integers  # that were compared

    @property
    def bound(self) -> Bound:
        """Of all parts."""
        force, rupture, liquid = self.errors.max(axis=0).tolist()
        return Bound(force, rupture, liquid, int(self.bridges.sum()))

    def but_for(self, other: "Measured", parts: Integers) -> "Measured":
        """It with some parts as another search found them."""
        errors, bridges = self.errors.copy(), self.bridges.copy()
        errors[parts], bridges[parts] = other.errors[parts], other.bridges[parts]
        return Measured(errors, bridges)


def measure(grid: Grid, task: Task, parts: Integers, searched: Integers | None = None) -> Measured:
    """Search the parts of a table, or some of them, for their largest errors; each row has the number of its part."""
    random, rows = np.random.default_rng(SEED), own_rows(grid)
    if searched is not None:
        rows = rows[np.isin(parts[rows], searched)]
    count = 1 + int(parts.max())
    errors, bridges = np.zeros((count, len(Bound._fields) - 1)), np.zeros(count, np.int64)
    starts: list[list[tuple[Floats, Places]]] = [[] for _ in errors.T]
    for places in all_cells(grid, rows, random):
        found, part = _errors(grid, task, places), parts[places.cell[:, 0]]
        np.add.at(bridges, part, found.force.shape[1])
        for kind, each in enumerate((found.force, found.rupture[:, None], found.liquid)):
            np.maximum.at(errors[:, kind], part, each.max(axis=1))
            starts[kind].append(_worst_of(each, places))
    for kind, some in enumerate(starts):
        error, places = np.concatenate([each for each, _ in some]), _joined([each for _, each in some])
        chosen = np.argsort(-error)[:_WORST]
        reached = _climb(grid, task, kind, error[chosen], places.taken(chosen), random)
        part = parts[places.cell[chosen, 0]]
        np.maximum.at(errors[:, kind], part, reached)
        np.add.at(bridges, part, _STEPS * len(_WIDTHS))
    return Measured(SAFETY * errors, bridges)


def _joined(parts: list[Places]) -> Places:
    cell, q_cell, pair, t = (np.concatenate(fields) for fields in zip(*parts, strict=True))
    return Places(cell, q_cell, pair, t)


def _coordinates(random: np.random.Generator, shape: tuple[int, ...]) -> Floats:
    """Random places in a cell, dense near its ends, and many at them."""
    inside = np.cos(math.pi * random.uniform(size=shape))
    return np.where(random.uniform(size=shape) < _AT_ENDS, np.sign(inside), inside)


def own_rows(grid: Grid) -> Integers:
    """Of the rows that share their cells, one; in the order of the cells."""
    return np.unique(grid.cuts[:, CELLS], return_index=True)[1]


def all_cells(grid: Grid, rows: Integers, random: np.random.Generator) -> Iterator[Places]:
    """Curves at the corners and in all cells of control and size, with places in all cells of q in turn; in parts."""
    sizes = grid.cuts[rows, U_COUNT]
    each = max(_CURVES, -(-_LEAST_CURVES // int(sizes.sum())))
    cell = np.column_stack(
        [np.repeat(rows, sizes * each), np.concatenate([np.repeat(np.arange(cells), each) for cells in sizes])]
    )
    turn = np.tile(np.arange(each), int(sizes.sum()))
    for start in range(0, len(cell), _CURVES_AT_ONCE):
        part = slice(start, start + _CURVES_AT_ONCE)
        count = len(cell[part])
        q_cell = (turn[part, None] * _PLACES + np.arange(_PLACES)) % grid.cuts[cell[part, 0], Q_COUNT, None]
        pair = _coordinates(random, (count, 2))
        is_corner = turn[part] < len(_CORNERS)
        pair[is_corner] = _CORNERS[turn[part][is_corner]]
        yield Places(cell[part], q_cell, pair, _coordinates(random, (count, _PLACES)))


def _worst_of(errors: Floats, places: Places) -> tuple[Floats, Places]:
    """The largest errors, not two on one curve, and their places."""
    along = errors.argmax(axis=1)
    largest = np.take_along_axis(errors, along[:, None], 1)[:, 0]
    chosen = np.argsort(-largest)[:_WORST]
    at = np.column_stack([chosen, along[chosen]])
    kept = places.taken(chosen)._replace(q_cell=places.q_cell[at[:, 0], at[:, 1]], t=places.t[at[:, 0], at[:, 1]])
    return largest[chosen], kept


def _climb(grid: Grid, task: Task, kind: int, error: Floats, places: Places, random: np.random.Generator) -> Floats:
    """Go from each place to a worse one in its cell, by random steps; return the errors there."""
    for width in _WIDTHS:
        tried = places.taken(np.repeat(np.arange(error.size), _STEPS))
        pair, t = (np.clip(at + random.normal(0.0, width, at.shape), -1.0, 1.0) for at in (tried.pair, tried.t))
        tried = tried._replace(pair=pair, t=t)
        found = _errors(grid, task, tried._replace(q_cell=tried.q_cell[:, None], t=t[:, None]))
        errors = (found.force[:, 0], found.rupture, found.liquid[:, 0])[kind].reshape(-1, _STEPS)
        best = np.arange(len(errors)) * _STEPS + errors.argmax(axis=1)
        is_worse = errors.max(axis=1) > error
        error = np.maximum(error, errors.max(axis=1))
        places = places._replace(
            pair=np.where(is_worse[:, None], pair[best], places.pair), t=np.where(is_worse, t[best], places.t)
        )
    return error


def between(cell: Integers, place: Floats, shift: Integers, first: Integers) -> Floats:
    """The number w at a coordinate in a cell."""
    low, high = (((first + cell + side) << shift).view(np.float64) for side in (0, 1))
    return np.asarray(low + 0.5 * (high - low) * (1.0 + place))


def position(grid: Grid, task: Task, places: Places) -> tuple[Floats, Floats, Floats]:
    """Control, size and q of places, inside the range that is tabulated."""
    row, size_cell = places.cell.T
    line, cut = grid.lines[row], grid.cuts[row]
    control = np.clip(controls_at(places.pair[:, 0], line[:, X0], line[:, X1]), task.low, task.high)
    size = np.full(control.size, task.sizes[0])
    if task.sizes[1] > task.sizes[0]:
        w = between(size_cell, places.pair[:, 1], cut[:, U_SHIFT], cut[:, U_FIRST])
        size = np.clip((w - line[:, U0]) / line[:, U1], *task.sizes)
    w = between(places.q_cell, places.t, cut[:, Q_SHIFT, None], cut[:, Q_FIRST, None])
    return control, size, np.clip((w - line[:, Q0, None]) / line[:, Q1, None], 0.0, 1.0)


class Truth(NamedTuple):
    """Exact bridges on curves; NaN where there is none."""

    states: Floats  # (curves, q, fields)
    separation: Floats  # (curves, q)
    rupture: Floats  # (curves,)


def exact_states(task: Task, pairs: Floats, q: Floats, nearest: float = 1.0) -> Truth:
    """Exact bridges of pairs, each at its own row of q, up to a share of the rupture distance."""
    held = VOLUME if task.is_volume else SUCTION
    rupture = answer(END, held, np.column_stack([np.zeros(len(pairs)), pairs]))[0][:, 0]
    bend = rupture / stretches_of(pairs) if task.is_volume else np.zeros(len(pairs))
    share = (1.0 - q * q) / (1.0 + bend[:, None] * q * q)
    gap = rupture[:, None] * np.minimum(share, nearest)
    states, _ = answer(STABLE, held, np.column_stack([gap.ravel(), np.repeat(pairs, q.shape[1], axis=0)]))
    return Truth(states.reshape(*q.shape, -1), gap, rupture)


def _errors(grid: Grid, task: Task, places: Places) -> Errors:
    """Errors of a table at places; where it holds no bridge and there is one, the error of the liquid is infinite."""
    control, size, q = position(grid, task, places)
    pairs = pairs_of(task, control, size, places.cell[:, 0] // grid.cells)
    all_q = np.column_stack([q, np.broadcast_to(_SCALE, (control.size, _SCALE.size))])
    states, gap, rupture = exact_states(task, pairs, all_q, NEAREST_RUPTURE)
    force, volume, curvature = np.moveaxis(states[..., _COLUMNS], -1, 0)
    exact_liquid = curvature if task.is_volume else volume
    with np.errstate(divide="ignore"):
        radius1, radius2 = 1.0 / pairs[:, 1], 1.0 / pairs[:, 3]

    def answers(asked: int, columns: int) -> Floats:
        each = [np.repeat(operand, columns) for operand in (control, radius1, radius2)]
        out = np.empty(control.size * columns)
        evaluate(asked, grid, (gap[:, :columns].ravel(), *each, np.ones(1)), out)
        return out.reshape(-1, columns)

    columns = q.shape[1]
    contact = exact_liquid[:, columns, None]  # the first of the places of the scale
    largest = np.abs(force).max(axis=1, keepdims=True)
    unit = 1.0 / np.sqrt(control[:, None]) if task.is_volume else contact
    of_force = np.abs(answers(FORCE, columns) / (2.0 * math.pi) - force[:, :columns]) / largest
    of_liquid = np.abs(answers(LIQUID, columns) - exact_liquid[:, :columns]) / unit
    of_rupture = np.abs(answers(RUPTURE, 1)[:, 0] / rupture - 1.0)
    return Errors(*(np.where(np.isnan(errors), math.inf, errors) for errors in (of_rupture, of_force, of_liquid)))
