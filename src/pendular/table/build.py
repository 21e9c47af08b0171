"""A table is built: its cells are chosen, filled with exact bridges, and its error is measured on others."""

from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._jit import in_chunks
from ..exact.fractions import fractions_range
from ..exact.middle import CURVATURE, VOLUME
from .cuts import Cut, chebyshev, choose, interpolation_error, octave_of, shifted_bits, to_powers
from .kernels import Grid
from .polynomial import CONTROL_TERMS, LANES, RUPTURE_SIZE_TERMS, SIZE_TERMS

Floats = NDArray[np.float64]

_CHUNK = 64  # curves that one thread takes at a time
_MANTISSA = 52
_SHARE = 0.25  # of the tolerance for one coordinate
_RUPTURE_SHARES = {False: 0.003, True: 0.03}  # of the tolerance, under suction and at constant volume, relative
_TRIAL_Q = np.array([0.02, 0.2, 0.5, 0.8, 1.0])  # the last one is contact
_FINEST_CONTROL = 6  # as a power of two: cells to an octave
_STEPS_BACK = 16
_SLACK = 1.0 + 1e-12  # of the ranges: radii at the limit are on either side of it by rounding
_ROUNDING = 3e-3  # of the tolerance, to which coefficients are rounded: it makes the file small


class Task(NamedTuple):
    """What is tabulated."""

    angles: tuple[float, float]
    is_volume: bool
    low: float
    high: float
    low_ratio: float
    high_ratio: float
    tolerance: float

    @property
    def rupture_tolerance(self) -> float:
        """For one coordinate, relative; small, as a bridge near rupture feels the square root of the error."""
        return _RUPTURE_SHARES[self.is_volume] * self.tolerance

    @property
    def sides(self) -> int:
        """Two if it matters which of the solids is the smaller."""
        return 1 if self.angles[0] == self.angles[1] else 2

    @property
    def sizes(self) -> tuple[float, float]:
        """Range of the size variable u."""
        low, high = ((1.0 - 1.0 / ratio) / (1.0 + 1.0 / ratio) for ratio in (self.low_ratio, self.high_ratio))
        return (low * low, high * high) if self.sides == 1 else (low, high)


class Octave(NamedTuple):
    """The cuts that serve one octave of the control."""

    exponent: int
    parts: int  # 2^parts cells of the control
    size: Cut
    q: Cut
    choices: tuple[int, int]  # numbers of the two cuts in the list of candidates


class Curves(NamedTuple):
    """Exact bridges: for each curve the rupture distance, and at each of its q the force and the liquid."""

    rupture: Floats  # (curves,)
    values: Floats  # (curves, q, 2)


def exact_curves(task: Task, control: Floats, size: Floats, side: int, q: Floats) -> Curves:
    """Solve for the curves at controls and sizes, all at the same q."""
    control, size = (np.ravel(numbers) for numbers in np.broadcast_arrays(control, size))
    s = np.sqrt(np.maximum(size, 0.0)) if task.sides == 1 else size
    larger = 1.0 - s if side == 0 else 1.0 + s
    angle1, angle2 = (np.full(control.size, angle) for angle in task.angles)
    pairs = np.column_stack([control, 2.0 - larger, angle1, larger, angle2])
    order = np.argsort(q)
    ascending = np.broadcast_to(q[order], (control.size, q.size))
    found = Curves(np.empty(control.size), np.empty((control.size, q.size, 2)))
    held = VOLUME if task.is_volume else CURVATURE
    in_chunks(fractions_range, control.size, _CHUNK, held, pairs, ascending, *found)
    values = np.empty_like(found.values)
    values[:, order] = found.values
    return Curves(found.rupture, values)


def _ruptures(task: Task, control: Floats, size: Floats) -> Floats:
    """D_c, one column a side."""
    no_q = np.empty(0)
    return np.column_stack([exact_curves(task, control, size, side, no_q).rupture for side in range(task.sides)])


def _forces(task: Task, control: Floats, size: Floats) -> Floats:
    """Forces at the trial q, those of one side after those of the other."""
    return np.concatenate(
        [exact_curves(task, control, size, side, _TRIAL_Q).values[..., 0] for side in range(task.sides)], axis=1
    )


def _error(
    task: Task,
    pairs: Callable[[Floats], tuple[Floats, Floats]],
    points: Callable[[Floats], Floats],
    terms: tuple[int, int],
) -> float:
    """Error of the interpolation in a coordinate of the pairs, in units of the tolerance for it."""
    middle = pairs(points(np.zeros(1)).ravel())
    smallest = _ruptures(task, *middle).min()
    of_rupture = interpolation_error(lambda along: _ruptures(task, *pairs(along)), points, terms[0]).max() / smallest
    contact = _forces(task, *middle)[:, len(_TRIAL_Q) - 1 :: len(_TRIAL_Q)].min()
    of_force = interpolation_error(lambda along: _forces(task, *pairs(along)), points, terms[1]).max() / contact
    return float(max(of_rupture / task.rupture_tolerance, of_force / _SHARE / task.tolerance))


def _size_error(task: Task, control: float, cut: Cut) -> float:
    terms = (RUPTURE_SIZE_TERMS, SIZE_TERMS)
    return _error(task, lambda size: (np.full_like(size, control), size), cut.points, terms)


def _control_error(task: Task, exponent: int, parts: int) -> float:
    """The same for the control, in the first and widest cell of an octave, at the ends of the range of sizes."""
    low, width = 2.0**exponent, 2.0 ** (exponent - parts)

    def points(t: Floats) -> Floats:
        return (low + 0.5 * width * (1.0 + t))[None]

    def error(size: float) -> float:
        return _error(task, lambda control: (control, np.full_like(control, size)), points, (LANES, CONTROL_TERMS))

    return max(error(size) for size in set(task.sizes))


def _q_error(task: Task, controls: tuple[float, float], cut: Cut) -> float:
    """The same for q, at three sizes."""
    low, high = task.sizes
    pairs = np.meshgrid(controls, np.unique([low, 0.5 * (low + high), high]))

    def forces(q: Floats) -> Floats:
        found = [
            exact_curves(task, pairs[0], pairs[1], side, np.append(q, 1.0)).values[..., 0] for side in range(task.sides)
        ]
        force = np.concatenate(found)
        return (force / force[:, -1:])[:, :-1].T

    return float(interpolation_error(forces, cut.points, LANES).max() / _SHARE / task.tolerance)


def _cut_octave(task: Task, exponent: int, before: Octave | None) -> Octave:
    """Choose the cuts for an octave, beginning a little below those of the one before."""
    controls = (max(task.low, 2.0**exponent), min(task.high, 2.0 ** (exponent + 1)))
    after = (0, 0) if before is None else tuple(max(0, choice - _STEPS_BACK) for choice in before.choices)
    parts = 0
    while parts < _FINEST_CONTROL and _control_error(task, exponent, parts) > 1.0:
        parts += 1
    size, size_choice = choose(
        lambda cut: all(_size_error(task, control, cut) < 1.0 for control in controls), *task.sizes, after[0]
    )
    q, q_choice = choose(lambda cut: _q_error(task, controls, cut) < 1.0, 0.0, 1.0, after[1])
    return Octave(exponent, parts, size, q, (size_choice, q_choice))


def _powers(values: Floats, axis: int) -> Floats:
    """Coefficients of powers from values at the interpolation points along an axis."""
    return np.moveaxis(np.tensordot(to_powers(values.shape[axis]), values, (1, axis)), 0, axis)


def _rounded(coefficients: Floats, precision: Floats) -> Floats:
    """Coefficients rounded to a power of two below the precision, one for each cell, the first axis."""
    unit = np.exp2(np.floor(np.log2(precision))).reshape(-1, *(1,) * (coefficients.ndim - 1))
    return np.round(coefficients / unit) * unit


def _controls(edges: Floats, terms: int) -> Floats:
    """Interpolation points between the edges of the cells of the control: (cells, terms)."""
    return edges[:-1, None] + 0.5 * np.diff(edges)[:, None] * (1.0 + chebyshev(terms))


def _fill_rupture(task: Task, edges: Floats, octave: Octave, side: int) -> Floats:
    """Coefficients of the rupture distance in the size cells of the control cells, given by their edges."""
    control = _controls(edges, LANES)
    size = octave.size.points(chebyshev(RUPTURE_SIZE_TERMS))  # (size cells, y)
    pairs = np.broadcast_arrays(control[:, None, None, :], size[None, :, :, None])
    rupture = exact_curves(task, pairs[0], pairs[1], side, np.empty(0)).rupture.reshape(pairs[0].shape)
    coefficients = _powers(_powers(rupture, 2), 3)[:, :, ::-1].reshape(-1, RUPTURE_SIZE_TERMS, LANES)
    return _rounded(coefficients, _ROUNDING * task.rupture_tolerance * np.abs(coefficients[:, -1, 0])).ravel()


def _fill_values(task: Task, edges: Floats, octave: Octave, side: int) -> Floats:
    """Coefficients of force and liquid, (2, all), in the cells of size and q of the control cells."""
    control = _controls(edges, CONTROL_TERMS)
    size = octave.size.points(chebyshev(SIZE_TERMS))
    pairs = np.broadcast_arrays(control[:, None, :, None], size[None, :, None, :])
    q = octave.q.points(chebyshev(LANES))  # (q cells, t)
    found = exact_curves(task, pairs[0], pairs[1], side, q.ravel()).values
    slow = np.sqrt(pairs[0].ravel()) if task.is_volume else np.square(pairs[0].ravel())
    found[..., 1] *= slow[:, None]
    values = np.moveaxis(found.reshape(*pairs[0].shape, *q.shape, 2), (6, 4), (0, 3))  # (2, row, size, q, x, y, t)
    coefficients = _powers(_powers(_powers(values, 4), 5), 6)[:, :, :, :, ::-1, ::-1]
    cells = coefficients.reshape(2, -1, CONTROL_TERMS, SIZE_TERMS, LANES)
    largest = np.abs(values).max(axis=(2, 3, 4, 5, 6))  # of a control cell: at contact
    precision = np.repeat(_ROUNDING * task.tolerance * largest, cells.shape[1] // largest.shape[1], axis=1)
    return np.stack([_rounded(cells[i], precision[i]).ravel() for i in range(2)])


def build_grid(task: Task) -> Grid:
    """Choose the cells and fill them with exact bridges."""
    octaves: list[Octave] = []
    for exponent in range(octave_of(task.low), octave_of(task.high) + 1):
        octaves.append(_cut_octave(task, exponent, octaves[-1] if octaves else None))
    return fill_grid(task, octaves)


def fill_grid(task: Task, octaves: list[Octave]) -> Grid:
    """Fill the cells of the octaves."""
    finest = max(octave.parts for octave in octaves)
    lines, cuts, rupture, values = [], [], [], []
    size_cells = cells = 0
    for side in range(task.sides):
        for octave in octaves:
            edges = 2.0**octave.exponent * (1.0 + np.arange(2**octave.parts + 1) / 2**octave.parts)
            rupture.append(_fill_rupture(task, edges, octave, side))
            values.append(_fill_values(task, edges, octave, side))
            size, q = octave.size, octave.q
            for low, high in pairwise(edges):
                line = [(low + high) / (low - high), 2.0 / (high - low), size.w0, size.w1, q.w0, q.w1]
                cut = [size.shift, size.first, size.cells, q.shift, q.first, q.cells, size_cells, cells]
                shared = 2 ** (finest - octave.parts)
                lines += shared * [line]
                cuts += shared * [cut]
                size_cells += size.cells
                cells += size.cells * q.cells
    force, liquid = np.concatenate(values, axis=1)
    shift = _MANTISSA - finest
    return Grid(
        np.array(lines), np.array(cuts, np.int64), np.concatenate(rupture), force, liquid,
        shift, shifted_bits(2.0 ** octaves[0].exponent, shift), len(octaves) << finest,
        task.low / _SLACK, task.high * _SLACK, 1.0 / task.high_ratio / _SLACK, _SLACK / task.low_ratio,
        task.sides, task.is_volume,
    )  # fmt: skip
