"""From a bridge of an easy problem to one of a hard problem, along a curve in the space of both.

With t from 0 to 1 the angles, the curvatures, the separation and what is held go from those of the easy problem to
those of the hard one. The curve of solutions (z, t) is followed by steps along its tangent; after each the component
that changes most along the curve is kept, and Newton's method finds the other four. So t may turn back on the way.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from .algebra import Four, dot, largest, moved, solve4
from .equations import VOLUME, Held, held_row, system_at
from .solids import solid_of

_FIRST_STEP, _LONGEST_STEP, _SHORTEST_STEP = 0.05, 0.3, 1e-8
_MOST_STEPS, _MOST_CORRECTIONS = 400, 7
_LARGEST_CORRECTION = 0.4
_LEAST_COSINE = 0.95
_SMALL_CORRECTION = 1e-8
_FARTHEST_BACK = -3.0  # in t
_MOST_TURN = 6.3
_FARTHEST = 40.0
_DIFFERENCE = 1e-6
_ALONG_T = 4


class Task(NamedTuple):
    """A bridge that is sought: two solids, a separation, and H or V/π."""

    separation: float  # D
    value: float  # H, or V/π
    curvature1: float
    angle1: float
    curvature2: float
    angle2: float
    control: int  # SUCTION or VOLUME


class Point(NamedTuple):
    """A point of the space of bridges and problems, or a step in it."""

    z: Four
    t: float


class Misses(NamedTuple):
    """The four equations at a point: values, rates in z, and rates in t."""

    values: Four
    row0: Four
    row1: Four
    row2: Four
    row3: Four
    by_t: Four


@kernel
def _mixed(a: float, b: float, t: float) -> float:
    return a + t * (b - a)


@kernel
def held_of(task: Task) -> Held:
    """What is held in a task."""
    return Held(
        solid_of(task.curvature1, task.angle1), solid_of(task.curvature2, task.angle2), task.control, task.value
    )


@kernel
def _task_between(easy: Task, hard: Task, t: float) -> Task:
    value = _mixed(easy.value, hard.value, t)
    if hard.control == VOLUME:
        value = math.exp(_mixed(math.log(easy.value), math.log(hard.value), t))
    return Task(
        _mixed(easy.separation, hard.separation, t),
        value,
        _mixed(easy.curvature1, hard.curvature1, t),
        _mixed(easy.angle1, hard.angle1, t),
        _mixed(easy.curvature2, hard.curvature2, t),
        _mixed(easy.angle2, hard.angle2, t),
        hard.control,
    )


@kernel
def _values(z: Four, task: Task) -> tuple[Four, Four, Four, Four, Four]:
    """The four equations of a task, and the rates of each."""
    held = held_of(task)
    system = system_at(z, held, True, task.control == VOLUME)
    row = held_row(z, system, held)
    inverse = math.exp(-z.log_length)
    miss = (system.separation.value - task.separation) * inverse
    rates = system.separation.rates
    return (
        Four(system.contact1.value, system.contact2.value, miss, row.value),
        system.contact1.rates,
        system.contact2.rates,
        Four(rates[0] * inverse, rates[1] * inverse, rates[2] * inverse - miss, rates[3] * inverse),
        row.rates,
    )


@kernel
def _misses(point: Point, easy: Task, hard: Task) -> Misses:
    values, row0, row1, row2, row3 = _values(point.z, _task_between(easy, hard, point.t))
    ahead = _values(point.z, _task_between(easy, hard, point.t + _DIFFERENCE))[0]
    by_t = Four(
        (ahead[0] - values[0]) / _DIFFERENCE,
        (ahead[1] - values[1]) / _DIFFERENCE,
        (ahead[2] - values[2]) / _DIFFERENCE,
        (ahead[3] - values[3]) / _DIFFERENCE,
    )
    return Misses(values, row0, row1, row2, row3, by_t)


@kernel
def _replaced(row: Four, index: int, value: float) -> Four:
    return Four(
        value if index == 0 else row[0],
        value if index == 1 else row[1],
        value if index == 2 else row[2],
        value if index == 3 else row[3],
    )


@kernel
def _solved(misses: Misses, kept: int, right: Four) -> Point:
    """The step with the given right side that leaves one component as it is: in the four others."""
    g = misses.by_t
    if kept == _ALONG_T:
        x, _ = solve4(misses.row0, misses.row1, misses.row2, misses.row3, right[0], right[1], right[2], right[3])
        return Point(x, 0.0)
    x, _ = solve4(
        _replaced(misses.row0, kept, g[0]),
        _replaced(misses.row1, kept, g[1]),
        _replaced(misses.row2, kept, g[2]),
        _replaced(misses.row3, kept, g[3]),
        right[0],
        right[1],
        right[2],
        right[3],
    )
    return Point(_replaced(x, kept, 0.0), x[kept])


@kernel
def _tangent(misses: Misses, kept: int, like: Point) -> Point:
    """Unit tangent of the curve of solutions, in the sense of another one."""
    if kept == _ALONG_T:
        g = misses.by_t
        step = _solved(misses, kept, Four(-g[0], -g[1], -g[2], -g[3]))
        x, t = step.z, 1.0
    else:
        column = Four(-misses.row0[kept], -misses.row1[kept], -misses.row2[kept], -misses.row3[kept])
        step = _solved(misses, kept, column)
        x, t = _replaced(step.z, kept, 1.0), step.t
    size = math.sqrt(dot(x, x) + t * t)
    sign = 1.0 if dot(x, like.z) + t * like.t >= 0.0 else -1.0
    factor = sign / size
    return Point(Four(x[0] * factor, x[1] * factor, x[2] * factor, x[3] * factor), t * factor)


@kernel
def _steepest(direction: Point) -> int:
    """The component that changes most."""
    index, most = _ALONG_T, abs(direction.t)
    for i in range(4):
        if abs(direction.z[i]) > most:
            index, most = i, abs(direction.z[i])
    return index


@kernel
def morph(start: Four, easy: Task, hard: Task) -> tuple[Four, bool]:
    """The bridge of the hard task to which that of the easy one leads, and whether it was reached."""
    point, direction, step = Point(start, 0.0), Point(Four(0.0, 0.0, 0.0, 0.0), 1.0), _FIRST_STEP
    direction = _tangent(_misses(point, easy, hard), _ALONG_T, direction)
    for _ in range(_MOST_STEPS):
        if step < _SHORTEST_STEP:
            break
        kept = _steepest(direction)
        length, is_last = step, False
        if direction.t > 0.0 and point.t < 1.0 <= point.t + step * direction.t:
            length, kept, is_last = (1.0 - point.t) / direction.t, _ALONG_T, True
        ahead = Point(moved(point.z, length, direction.z), 1.0 if is_last else point.t + length * direction.t)
        way, steps = 0.0, _MOST_CORRECTIONS
        misses = _misses(ahead, easy, hard)
        for corrections in range(1, _MOST_CORRECTIONS + 1):
            v = misses.values
            change = _solved(misses, kept, Four(-v[0], -v[1], -v[2], -v[3]))
            size = math.sqrt(dot(change.z, change.z) + change.t * change.t)
            if not size < 2.0:
                way = math.inf
                break
            ahead = Point(moved(ahead.z, 1.0, change.z), ahead.t + change.t)
            way += size
            if size < _SMALL_CORRECTION:
                steps = corrections
                break
            misses = _misses(ahead, easy, hard)
        else:
            way = math.inf
        if not way < _LARGEST_CORRECTION * length + _SMALL_CORRECTION:
            step *= 0.4
            continue
        turned = _tangent(misses, kept, direction)
        cosine = dot(turned.z, direction.z) + turned.t * direction.t
        if not cosine > _LEAST_COSINE:
            step *= 0.4
            continue
        if is_last:
            return ahead.z, True
        z = ahead.z
        if abs(z.turn) > _MOST_TURN or largest(z) > _FARTHEST or ahead.t < _FARTHEST_BACK:
            break
        point, direction = ahead, turned
        if steps <= 3:
            step = min(_LONGEST_STEP, 1.6 * step)
    return point.z, False
