"""A table is built from samples of exact bridges: its cells are chosen, and filled."""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .cuts import (
    Cut,
    Points,
    chebyshev,
    choose,
    control_line,
    controls_at,
    cut_of,
    interpolation_error,
    octave_of,
    shifted_bits,
    to_powers,
    truncated,
)
from .kernels import Grid
from .polynomial import (
    CELL,
    CONTROL_TERMS,
    LANES,
    POWERS,
    RUPTURE_CELL,
    RUPTURE_SIZE_TERMS,
    SIZE_TERMS,
    aligned,
    cells_from,
    coefficients_of,
)
from .samples import Sample, curves_of, sample_octave
from .task import Task

Floats = NDArray[np.float64]
Samples = tuple[Sample, ...]  # of one octave, one a side
Pairs = Callable[[Floats], tuple[Floats, Floats]]  # controls and sizes at places of one coordinate

_MANTISSA = 52
# The last one is contact; next to it the force of a small volume falls fast.
_TRIAL_Q = np.array([0.0, 0.003, 0.02, 0.2, 0.5, 0.8, 0.92, 0.97, 0.99, 0.997, 1.0])
_TRIAL_SIZES = np.array([0.0, 0.05, 0.15, 0.3, 0.5, 0.9, 0.99, 1.0])  # over the range; dense where bridges vary most
_FINEST_CONTROL = 6  # as a power of two: cells to an octave
_STEPS_BACK = 16
_SLACK = 1.0 + 1e-12  # of the ranges: radii at the limit are on either side of it by rounding
_ROUNDING = 1e-2  # of the tolerance, to which coefficients are rounded: it makes the file small


class Octave(NamedTuple):
    """The cuts that serve one octave of the control."""

    exponent: int
    parts: int  # 2^parts cells of the control
    size: Cut
    q: Cut
    choices: tuple[int, int]  # numbers of the two cuts in the list of candidates
    edges: Floats  # of the cells of the control
    rupture: list[Floats]  # coefficients, of each side
    values: list[Floats]  # of force and liquid


def _columns(samples: Samples, control: Floats, size: Floats, q: Floats) -> tuple[Floats, Floats]:
    """D_c, and the forces at each q, of pairs (points, columns), sides side by side: (points, columns)."""
    found = [curves_of(sample, control, size, q) for sample in samples]
    shape = np.broadcast_shapes(control.shape, size.shape)
    return (
        np.concatenate([curves.rupture.reshape(shape) for curves in found], axis=1),
        np.concatenate([curves.values[..., 0].reshape(shape[0], -1) for curves in found], axis=1),
    )


def _trials_of(task: Task, exponent: int) -> tuple[Floats, Floats]:
    """Controls at the ends of an octave, as far as it is in the range, and sizes from end to end of the range."""
    controls = max(task.low, 2.0**exponent), min(task.high, 2.0 ** (exponent + 1))
    low, high = task.sizes
    return np.unique(controls), np.unique(low + (high - low) * _TRIAL_SIZES)


def _units(task: Task, samples: Samples, exponent: int) -> tuple[float, float]:
    """What the tolerance allows of D_c and of the force, along one coordinate."""
    pairs = np.meshgrid(*_trials_of(task, exponent))
    found = [curves_of(sample, *pairs, _TRIAL_Q) for sample in samples]
    rupture = min(curves.rupture.min() for curves in found)
    force = min(np.abs(curves.values[..., 0]).max(axis=1).min() for curves in found)
    return task.rupture_tolerance * float(rupture), task.share * task.tolerance * float(force)


def _error(samples: Samples, units: tuple[float, float], pairs: Pairs, points: Points, terms: tuple[int, int]) -> float:
    """Error of the interpolation of D_c and of the force in a coordinate of the pairs, in units of the tolerance."""

    def ruptures(along: Floats) -> Floats:
        return _columns(samples, *pairs(along[:, None]), np.empty(0))[0]

    def forces(along: Floats) -> Floats:
        return _columns(samples, *pairs(along[:, None]), _TRIAL_Q)[1]

    of_rupture = interpolation_error(ruptures, points, terms[0]).max()
    of_force = interpolation_error(forces, points, terms[1]).max()
    return float(max(of_rupture / units[0], of_force / units[1]))


def _control_error(samples: Samples, units: tuple[float, float], exponent: int, parts: int, sizes: Floats) -> float:
    """The same for the control, in the first and the last cell of an octave."""
    edges = _edges(exponent, parts)
    lines = np.array([control_line(*ends) for ends in (edges[:2], edges[-2:])])

    def points(t: Floats) -> Floats:
        return controls_at(t, *lines.T[..., None])

    return _error(samples, units, lambda control: (control, sizes), points, (LANES, CONTROL_TERMS))


def _q_error(task: Task, samples: Samples, controls: Floats, sizes: Floats, points: Points) -> float:
    """The same for q."""
    pairs = np.meshgrid(controls, sizes)

    def forces(q: Floats) -> Floats:
        force = np.concatenate([curves_of(sample, *pairs, q).values[..., 0] for sample in samples])
        return (force / np.abs(force).max(axis=1, keepdims=True)).T

    return float(interpolation_error(forces, points, LANES).max() / task.share / task.tolerance)


def build_octave(task: Task, samples: Samples, exponent: int, before: Octave | None) -> Octave:
    """Choose the cuts for an octave, beginning a little below those of another, and fill the cells."""
    controls, sizes = _trials_of(task, exponent)
    units = _units(task, samples, exponent)
    after = (0, 0) if before is None else tuple(max(0, choice - _STEPS_BACK) for choice in before.choices)
    parts = 0
    while parts < _FINEST_CONTROL and _control_error(samples, units, exponent, parts, sizes) > 1.0:
        parts += 1

    def size_error(points: Points) -> float:
        terms = (RUPTURE_SIZE_TERMS, SIZE_TERMS)
        return _error(samples, units, lambda size: (controls, size), points, terms)

    size, size_choice = choose(size_error, *task.sizes, after[0])
    q, q_choice = choose(lambda points: _q_error(task, samples, controls, sizes, points), 0.0, 1.0, after[1])
    edges = _edges(exponent, parts)
    return Octave(
        exponent, parts, size, q, (size_choice, q_choice), edges,
        [_fill_rupture(task, edges, size, sample) for sample in samples],
        [_fill_values(task, edges, size, q, sample) for sample in samples],
    )  # fmt: skip


def _powers(values: Floats, axis: int) -> Floats:
    """Coefficients of powers from values at the interpolation points along an axis."""
    return np.moveaxis(np.tensordot(to_powers(values.shape[axis]), values, (1, axis)), 0, axis)


def _rounded(coefficients: Floats, precision: Floats) -> Floats:
    """Coefficients rounded to a power of two below the precision, one for each cell, the first axis."""
    unit = np.exp2(np.floor(np.log2(np.where(precision > 0.0, precision, 1.0)))).reshape(
        -1, *(1,) * (coefficients.ndim - 1)
    )
    return np.round(coefficients / unit) * unit + 0.0  # without -0.0


def _edges(exponent: int, parts: int) -> Floats:
    """Ends of the cells of the control in an octave."""
    return np.asarray(2.0**exponent * (1.0 + np.arange(2**parts + 1) / 2**parts))


def _controls(edges: Floats, terms: int) -> Floats:
    """Interpolation points between the edges of the cells of the control: (cells, terms)."""
    lines = np.array([control_line(*ends) for ends in pairwise(edges)])
    return controls_at(chebyshev(terms), *lines.T[..., None])


def _fill_rupture(task: Task, edges: Floats, cut: Cut, sample: Sample) -> Floats:
    """Coefficients of the rupture distance in the size cells of the control cells, given by their edges."""
    control = _controls(edges, LANES)
    size = cut.points(chebyshev(RUPTURE_SIZE_TERMS))  # (size cells, y)
    pairs = np.broadcast_arrays(control[:, None, None, :], size[None, :, :, None])
    rupture = curves_of(sample, pairs[0], pairs[1], np.empty(0)).rupture.reshape(pairs[0].shape)
    coefficients = _powers(_powers(rupture, 2), 3)[:, :, ::-1].reshape(-1, RUPTURE_SIZE_TERMS, LANES)
    return _rounded(coefficients, _ROUNDING * task.rupture_tolerance * np.abs(coefficients[:, -1, 0])).ravel()


def _fill_values(task: Task, edges: Floats, size_cut: Cut, q_cut: Cut, sample: Sample) -> Floats:
    """Coefficients of force and liquid, (2, all), in the cells of size and q of the control cells."""
    control = _controls(edges, CONTROL_TERMS)
    size = size_cut.points(chebyshev(SIZE_TERMS))
    pairs = np.broadcast_arrays(control[:, None, :, None], size[None, :, None, :])
    q = q_cut.points(chebyshev(LANES))  # (q cells, t)
    found = curves_of(sample, pairs[0], pairs[1], q.ravel()).values
    slow = np.sqrt(pairs[0].ravel()) if task.is_volume else np.square(pairs[0].ravel())
    found[..., 1] *= slow[:, None]
    values = np.moveaxis(found.reshape(*pairs[0].shape, *q.shape, 2), (6, 4), (0, 3))  # (2, row, size, q, x, y, t)
    return cells_of(values, task.tolerance)


def cells_of(values: Floats, tolerance: float) -> Floats:
    """Coefficients of quantities, (quantities, all), from values: (quantities, row, size, q, x, y, t)."""
    shortened = np.moveaxis(truncated(np.moveaxis(values, (4, 5), (-2, -1))), (-2, -1), (4, 5))
    coefficients = _powers(_powers(_powers(shortened, 4), 5), 6)
    cells = coefficients[:, :, :, :, *np.transpose(POWERS)].reshape(len(values), -1, len(POWERS), LANES)
    largest = np.abs(values).max(axis=(2, 3, 4, 5, 6))  # of a control cell: at contact
    precision = np.repeat(_ROUNDING * tolerance * largest, cells.shape[1] // largest.shape[1], axis=1)
    held = [cells_from(_rounded(*each)) for each in zip(cells, precision, strict=True)]
    return np.stack([coefficients_of(each) for each in held])


def octaves_of_rows(grid: Grid, count: int) -> NDArray[np.int64]:
    """Number of the octave, of so many, in which each row lies; the first and the last row of a side are one more."""
    row = np.arange(len(grid.lines)) % grid.cells
    return np.clip((row - 1) * count // (grid.cells - 2), 0, count - 1)


def sample_range(task: Task) -> list[Samples]:
    """Solve for the bridges of all octaves of the control, from thin bridges to thick ones, which have more panels."""
    last = max(octave_of(task.low), octave_of(float(np.nextafter(task.high, 0.0))))
    exponents = range(octave_of(task.low), last + 1)
    samples: list[Samples] = []
    for exponent in exponents if task.is_volume else reversed(exponents):
        before = samples[-1] if samples else (None, None)
        samples.append(tuple(sample_octave(task, exponent, side, before[side]) for side in range(task.sides)))
    return samples if task.is_volume else samples[::-1]


def empty_grid(task: Task) -> Grid:
    """The grid of pairs that hold no bridge: one cell, and the rupture distance is 0."""
    size, q = (cut_of(*ends, 1, 0, is_reversed=False) for ends in (task.sizes, (0.0, 1.0)))
    first, last = octave_of(task.low), octave_of(task.high)
    rows = last - first + 3  # with one before and one after, for what lies at the limits but for rounding
    line = [1.0, 0.0, size.w0, size.w1, q.w0, q.w1]
    cut = [size.shift, size.first, size.cells, q.shift, q.first, q.cells, 0, 0]
    return _grid_of(
        task, task.sides * rows * [line], task.sides * rows * [cut], np.zeros(RUPTURE_CELL), np.zeros((2, CELL)),
        _MANTISSA, first, rows,
    )  # fmt: skip


def _grid_of(
    task: Task,
    lines: list[list[float]],
    cuts: list[list[int]],
    rupture: Floats,
    values: Floats,
    shift: int,
    exponent: int,
    rows: int,
) -> Grid:
    """The grid of a task, from its headers and coefficients; its rows begin at an octave."""
    return Grid(
        np.array(lines), np.array(cuts, np.int64), aligned(rupture), cells_from(values[0]), cells_from(values[1]),
        shift, shifted_bits(2.0**exponent, shift) - 1, rows,
        task.low / _SLACK, task.high * _SLACK, 1.0 / task.high_ratio / _SLACK, _SLACK / task.low_ratio,
        task.sides, task.is_volume,
    )  # fmt: skip


def join(task: Task, octaves: list[Octave]) -> Grid:
    """The grid of all octaves."""
    finest = max(octave.parts for octave in octaves)
    headers, rupture, values = [], [], []
    size_cells = cells = 0
    for side in range(task.sides):
        rows = []
        for octave in octaves:
            rupture.append(octave.rupture[side])
            values.append(octave.values[side])
            size, q = octave.size, octave.q
            for low, high in pairwise(octave.edges):
                line = [*control_line(low, high), size.w0, size.w1, q.w0, q.w1]
                cut = [size.shift, size.first, size.cells, q.shift, q.first, q.cells, size_cells, cells]
                rows += 2 ** (finest - octave.parts) * [(line, cut)]
                size_cells += size.cells
                cells += size.cells * q.cells
        rows = [rows[0], *rows, rows[-1]]  # for what lies at the limits but for rounding
        headers += rows
    lines, cuts = (list(each) for each in zip(*headers, strict=True))
    coefficients = np.concatenate(rupture), np.concatenate(values, axis=1)
    return _grid_of(task, lines, cuts, *coefficients, _MANTISSA - finest, octaves[0].exponent, len(rows))
