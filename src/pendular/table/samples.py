"""Exact bridges of one octave of the control as Chebyshev series, which answer for all that lies between them.

A table has many more nodes than it takes to know the bridges: they are analytic in the logarithm of the control, in the
size of the pair, and in the coordinate q of :mod:`~pendular.exact.branch`, stretched at a constant volume: those of
the table. Series of some ten to forty terms reach far below the tolerance of the table.
"""

import math
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..exact.branch import branches
from ..exact.equations import SUCTION, VOLUME
from ..ground.compile import kernel
from ..ground.rows import Own, entry, over_rows
from .cuts import chebyshev, to_chebyshev
from .task import Task

Floats = NDArray[np.float64]

_CHUNK, _SAMPLED_CHUNK = 64, 1024  # curves that one thread takes at a time
_SIZE_TERMS = 12
_CONTROL_TERMS, _Q_TERMS = (2, 1), (8, 3)  # at least, and more for each digit of the tolerance
_MORE = 1.5  # times as many, where they are too few
_TAIL = 0.02  # of the tolerance: what the last terms may be
_MOST_Q_TERMS = 108
_SHIFTS = {False: 1.0, True: 1e-3}  # next to a pitchfork the bridges of a volume change fast before rupture
_SPAN, _SLOWEST, _NO_TERM = 8, 0.99, 1e-300  # terms over which the fall of a series is measured
_MOST_HALVINGS = {False: 14, True: 10}  # of the panels at the ends, under suction and at a constant volume
_INNER_WIDTH = 1.0 / 32.0  # least one of other panels, over the range


class Curves(NamedTuple):
    """Exact bridges: for each curve the rupture distance, and at each of its q the force and the liquid."""

    rupture: Floats  # (curves,)
    values: Floats  # (curves, q, 2)


class Sample(NamedTuple):
    """Chebyshev coefficients of an octave of the control, in panels of the size; a kernel evaluates them."""

    exponent: float  # of the octave
    edges: Floats  # (panels + 1,)
    rupture: Floats  # (panels, size, control)
    values: Floats  # (panels, size, control, force or liquid, p of q)
    shift: float  # of q before its root is taken


def pairs_of(task: Task, control: Floats, size: Floats, side: int | NDArray[np.int64]) -> Floats:
    """Rows of (control, k1, θ1, k2, θ2) in units of R̄."""
    s = task.s_of(size)
    larger = np.where(np.equal(side, 0), 1.0 - s, 1.0 + s)
    angle1, angle2 = (np.full(control.size, angle) for angle in task.angles)
    return np.column_stack([control, 2.0 - larger, angle1, larger, angle2])


def exact_curves(task: Task, control: Floats, size: Floats, side: int, q: Floats) -> Curves:
    """Solve for the curves at controls and sizes, all at the same q."""
    order = np.argsort(q)
    held = VOLUME if task.is_volume else SUCTION
    rupture, found = branches(held, task.is_volume, pairs_of(task, control, size, side), q[order], _CHUNK)
    values = np.empty_like(found)
    values[:, order] = found
    return Curves(rupture, values)


def _to_series(values: Floats, axis: int) -> Floats:
    """Chebyshev coefficients from values at the interpolation points along an axis."""
    return np.moveaxis(np.tensordot(to_chebyshev(values.shape[axis]), values, (1, axis)), 0, axis)


def _terms(task: Task, numbers: tuple[int, int]) -> int:
    """Number of terms that the tolerance takes."""
    return numbers[0] + round(-numbers[1] * math.log10(task.tolerance))


class Domain(NamedTuple):
    """What a sample covers: an octave of the control, one solid or the other the smaller."""

    exponent: int
    side: int


class Panels(NamedTuple):
    """Series in panels of the size; their last terms along each coordinate, in units of the tolerance."""

    rupture: Floats
    values: Floats
    size_tails: Floats
    control_tails: Floats
    q_tails: Floats


class Terms(NamedTuple):
    """Numbers of terms along two coordinates."""

    control: int
    q: int


def _tails(task: Task, of_rupture: Floats, of_values: Floats, units: tuple[Floats, Floats], axis: int) -> Floats:
    """Largest of the last two terms along an axis, of each panel."""
    if of_rupture.shape[axis] == 1:
        return np.zeros(of_rupture.shape[0])
    last = [np.abs(np.take(of, [-2, -1], axis)).reshape(len(of), -1).max(axis=1) for of in (of_rupture, of_values)]
    tails: Floats = np.maximum(last[0] / units[0] / task.rupture_tolerance, last[1] / units[1] / task.tolerance)
    return tails


def _shift(task: Task) -> float:
    """Shift of q: the smaller, the finer do its series see the places before rupture."""
    return _SHIFTS[task.is_volume]


def _q_at(z: Floats, shift: float) -> Floats:
    """Places q from 0 to 1 where p = √(q + shift) is a number from -1 to 1 in its range."""
    least, most = math.sqrt(shift), math.sqrt(1.0 + shift)
    return np.asarray((least + 0.5 * (most - least) * (1.0 + z)) ** 2 - shift)


def _rest(series: Floats) -> Floats:
    """About the sum of the terms in q that are not there, of each panel, from how they fall.

    The last ones do not tell: interpolation takes from them the first of those that are not there.
    """
    size = np.abs(series).max(axis=(1, 2))
    here, before = (size[:, -start : -start + _SPAN // 2].max(axis=1) for start in (_SPAN, 2 * _SPAN))
    fall = np.minimum(here / np.maximum(before, _NO_TERM), _SLOWEST)
    return np.asarray(here * fall / (1.0 - fall ** (1.0 / _SPAN)))


def _solve_panels(task: Task, domain: Domain, edges: Floats, terms: Terms) -> Panels:
    """Series of the bridges in panels, given by their ends: (panels, 2)."""
    size_terms = 1 if task.sizes[0] == task.sizes[1] else _SIZE_TERMS
    control = np.exp2(domain.exponent + 0.5 + 0.5 * chebyshev(terms.control))
    along = edges.mean(axis=1)[:, None] + 0.5 * np.diff(edges) * chebyshev(size_terms)
    q = _q_at(chebyshev(terms.q)[::-1], _shift(task))
    shape = (*along.shape, control.size)
    controls, sizes = (np.broadcast_to(each, shape).ravel() for each in (control, along[..., None]))
    found = exact_curves(task, controls, sizes, domain.side, q)
    rupture = found.rupture.reshape(shape)
    values = np.moveaxis(found.values.reshape(*shape, q.size, 2), 4, 3)[..., ::-1]
    units = rupture.min(axis=(1, 2)), np.abs(values[..., 0, :]).max(axis=3).min(axis=(1, 2))
    of_rupture = _to_series(_to_series(rupture, 1), 2)
    of_values = _to_series(_to_series(_to_series(values, 1), 2), 4)
    of_size, of_control = (_tails(task, of_rupture, of_values[:, :, :, 0], units, axis) for axis in (1, 2))
    of_q = _rest(of_values[:, :, :, 0]) / units[1] / task.tolerance
    return Panels(of_rupture, of_values, of_size, of_control, of_q)


def _halve(task: Task, domain: Domain, edges: Floats, terms: Terms) -> tuple[Floats, Panels]:
    """Panels, halved until their series are short enough, or too thin to be of use in the cells of a table."""
    start, stop = edges[0], edges[-1]
    waiting = np.column_stack([edges[:-1], edges[1:]])
    done: list[tuple[float, ...]] = []
    while waiting.size:
        panels = _solve_panels(task, domain, waiting, terms)
        width, middle = np.diff(waiting)[:, 0], waiting.mean(axis=1)
        from_end = np.minimum(middle - start, stop - middle)
        thinnest = (stop - start) * 0.5 ** _MOST_HALVINGS[task.is_volume]
        least = np.maximum(thinnest, np.minimum(_INNER_WIDTH * (stop - start), 0.25 * from_end))
        is_good = (panels.size_tails < _TAIL) | (width <= 1.001 * least)
        done += [(waiting[i, 0], *(field[i] for field in panels)) for i in np.flatnonzero(is_good)]
        halved, middle = waiting[~is_good], middle[~is_good, None]
        waiting = np.concatenate([np.hstack([halved[:, :1], middle]), np.hstack([middle, halved[:, 1:]])])
    done.sort(key=lambda panel: panel[0])
    firsts, *fields = zip(*done, strict=True)
    return np.array([*firsts, stop]), Panels(*(np.array(field) for field in fields))


def sample_octave(task: Task, exponent: int, side: int, before: Sample | None) -> Sample:
    """Solve for the bridges of an octave, in the panels of the octave before, and halves of them."""
    domain = Domain(exponent, side)
    terms = Terms(*(_terms(task, numbers) for numbers in (_CONTROL_TERMS, _Q_TERMS)))
    edges = np.array(task.sizes)
    if before is not None:
        edges, terms = before.edges, terms._replace(q=before.values.shape[4])
    edges, panels = _halve(task, domain, edges, terms)
    while panels.q_tails.max() > _TAIL and terms.q < _MOST_Q_TERMS:
        terms = terms._replace(q=min(_MOST_Q_TERMS, int(_MORE * terms.q)))
        edges, panels = _halve(task, domain, edges, terms)
    if panels.control_tails.max() > _TAIL:
        edges, panels = _halve(task, domain, edges, terms._replace(control=2 * terms.control))
    return Sample(float(exponent), edges, panels.rupture, panels.values, _shift(task))


@kernel
def _fill_chebyshev(x: float, out: Floats) -> None:
    """Chebyshev polynomials of x."""
    for k in range(out.size):
        out[k] = 1.0 if k == 0 else (x if k == 1 else 2.0 * x * out[k - 1] - out[k - 2])


@entry(plain_cost=1e-3, patience=0.5)
def _sampled_range(
    sample: Sample,
    control: Floats,
    size: Floats,
    q: Floats,
    rupture: Floats,
    values: Floats,
    of_size: Floats,
    of_control: Floats,
    series: Floats,
    start: int,
    stop: int,
) -> None:
    """Curves at controls and sizes, from the series, with room for a polynomial of each."""
    terms = series.shape[1]
    force, liquid = series[0], series[1]
    least, most = math.sqrt(sample.shift), math.sqrt(1.0 + sample.shift)
    last = sample.edges.size - 2
    for i in range(start, stop):
        panel = 0
        while panel < last and size[i] > sample.edges[panel + 1]:
            panel += 1
        width = sample.edges[panel + 1] - sample.edges[panel]
        y = 2.0 * (size[i] - sample.edges[panel]) / width - 1.0 if width > 0.0 else 0.0
        _fill_chebyshev(y, of_size)
        _fill_chebyshev(2.0 * (math.log2(control[i]) - sample.exponent) - 1.0, of_control)
        force[:] = 0.0
        liquid[:] = 0.0
        rupture[i] = 0.0
        for j in range(of_size.size):
            for k in range(of_control.size):
                weight = of_size[j] * of_control[k]
                rupture[i] += weight * sample.rupture[panel, j, k]
                for n in range(terms):
                    force[n] += weight * sample.values[panel, j, k, 0, n]
                    liquid[n] += weight * sample.values[panel, j, k, 1, n]
        for n in range(q.size):
            z = 2.0 * (math.sqrt(max(q[n], 0.0) + sample.shift) - least) / (most - least) - 1.0
            for c in range(2):
                b1, b2 = 0.0, 0.0
                for k in range(terms - 1, 0, -1):
                    b1, b2 = 2.0 * z * b1 - b2 + series[c, k], b1
                values[i, n, c] = z * b1 - b2 + series[c, 0]


def curves_of(sample: Sample, control: Floats, size: Floats, q: Floats) -> Curves:
    """Curves at controls and sizes, all at the same q, from the sample of their octave."""
    control, size = (np.ravel(numbers) for numbers in np.broadcast_arrays(control, size))
    found = Curves(np.empty(control.size), np.empty((control.size, q.size, 2)))
    _, of_size, of_control = sample.rupture.shape
    terms = sample.values.shape[4] if q.size > 0 else 0
    room = (Own(partial(np.empty, shape)) for shape in (of_size, of_control, (2, terms)))
    over_rows(_sampled_range, control.size, _SAMPLED_CHUNK, sample, control, size, q, *found, *room)
    return found
