"""Bridges along a path of loads, whose contact lines stay until their angles are reached, and then slide.

The only door for paths: each goes from point to point, exactly however far apart they are.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import entry, over_rows
from .algebra import Four
from .answers import FAILED, FOUND, LARGEST_MISS, NO_BRIDGE
from .carrying import ARRIVED, CLOSES, FOLD, LOST, PITCHFORK, TOUCHES, UNSTABLE, carried
from .clearance import is_clear, opening_of
from .equations import SUCTION, VOLUME, force_of, held_row
from .lines import FREE, Lines, angle_of, first_row_on, held_at, line_at, system_on
from .loading import Load, load_between
from .meridian import End, ends_of
from .search import are_alike
from .stability import ladder_at
from .state import Description, State, figure_of, state_of

__all__ = [
    "ARRIVED",
    "CLOSES",
    "END_FIELDS",
    "FOLD",
    "LINE_FIELDS",
    "LOST",
    "PITCHFORK",
    "TOUCHES",
    "UNSTABLE",
    "Walked",
    "walk_paths",
]

Vector = NDArray[np.float64]
Rows = NDArray[np.float64]
Cubes = NDArray[np.float64]
Statuses = NDArray[np.int8]

LINE_FIELDS = ("angle1", "angle2", "mode1", "mode2", "dissipated1", "dissipated2")
END_FIELDS = (
    "event",
    "step",
    "share",
)  # what ended a path, ARRIVED if nothing did; the step, and the share of its load

_UPRIGHT = 1e-9  # cosine of the slope of a meridian that leaves its ring at a right angle to the axis
_SAME = 1e-12  # difference of two cosines that are one


@kernel
def _sideways(first: End, second: End, z: Four, lines: Lines, fallback: float) -> float:
    """1 if the liquid does not slip to one side.

    Lines that resist both ways hold it as pinned ones do: until the normals at both ends of the meridian meet on the
    axis, where a rotation about that point moves neither line. A meridian without an overhang never comes there.
    """
    if lines.first.mode == FREE or lines.second.mode == FREE:
        return fallback
    if min(first.cos_slope, second.cos_slope) > -_UPRIGHT:
        return 1.0
    system = system_on(z, lines, True, False)
    crossing = (
        system.length.value * first.cos_slope * second.cos_slope
        + second.radius * second.sin_slope * first.cos_slope
        + first.radius * first.sin_slope * second.cos_slope
    )
    return 1.0 if crossing * force_of(z) > 0.0 else 0.0


@kernel
def _describe(z: Four, lines: Lines, load: Load, value: float) -> Description:
    """Everything about a bridge between lines, that holds a value; the miss is that of the lines and of the value."""
    system = system_on(z, lines, True, True)
    held = held_at(lines, system.first, system.second, load.control, value)
    held_back = held_row(z, system, held)
    ladder = ladder_at(z, system)
    unstable = ladder.at_suction if load.control == SUCTION else ladder.at_volume
    state = state_of(figure_of(z), system, held, first_row_on(z, system, lines), held_back, unstable)
    sideways = _sideways(system.first, system.second, z, lines, state.sideways_stable)
    state = State(
        state.separation, state.curvature, state.force, state.volume, state.area, state.across_tensor,
        state.axial_tensor, state.stiffness, state.neck_radius, state.neck_inside, state.radius1, state.radius2,
        state.filling1, state.filling2, state.wetted_area1, state.wetted_area2, state.middle_radius,
        state.middle_slope, state.half_length, state.unstable_directions, sideways,
    )  # fmt: skip
    is_bridge = opening_of(z, system, held) > 0.0 and is_clear(z, system, held)
    return Description(state, is_bridge, max(abs(system.contact1.value), abs(system.contact2.value)))


@kernel
def _record(z: Four, lines: Lines, load: Load, value: float, row: Vector, told: Vector) -> int:
    """Store a bridge and what its lines do; whether it is one."""
    description = _describe(z, lines, load, value)
    if not description.miss <= LARGEST_MISS:
        return LOST
    if not description.is_bridge:
        return TOUCHES
    for j, number in enumerate(description.state):
        row[j] = number
    first, second = ends_of(z)
    told[0], told[1] = angle_of(lines.first, first), angle_of(lines.second, second)
    told[2], told[3] = float(lines.first.mode), float(lines.second.mode)
    told[4], told[5] = lines.first.dissipated, lines.second.dissipated
    return ARRIVED


@kernel
def _walk(
    control: int, pair: Vector, points: Rows, z: Four, states: Rows, told: Rows, statuses: Statuses, end: Vector
) -> None:
    """Carry a bridge from point to point; the row after the last holds the bridge as it broke."""
    first, second = ends_of(z)
    one = line_at(float(pair[0]), float(pair[1]), float(pair[2]), float(pair[3]), first)
    other = line_at(float(pair[4]), float(pair[5]), float(pair[6]), float(pair[7]), second)
    alike = (
        are_alike(one.advancing, other.advancing)
        and are_alike(one.receding, other.receding)
        and abs(one.cosine - other.cosine) < _SAME
    )
    lines = Lines(one, other, alike)
    count = statuses.size
    unit = math.pi if control == VOLUME else 1.0
    for i in range(count):
        before = max(i - 1, 0)
        start = (float(points[before, 0]), float(points[before, 1]) / unit)
        target = (float(points[i, 0]), float(points[i, 1]) / unit)
        load = load_between(z, control, start, target)
        event, share = ARRIVED, 1.0
        if start != target:
            leg = carried(z, lines, load)
            event, z, lines, share = leg.event, leg.z, leg.lines, leg.share
        value = target[1] if event == ARRIVED else start[1] + share * load.more_value
        row = i if event == ARRIVED else count
        stored = _record(z, lines, load, value, states[row], told[row])
        if event == ARRIVED and stored == ARRIVED:
            statuses[i] = FOUND
            continue
        event = stored if event == ARRIVED else event
        statuses[i:] = FAILED if event == LOST else NO_BRIDGE
        end[0], end[1], end[2] = float(event), float(i), share
        return
    end[0], end[1], end[2] = float(ARRIVED), float(count), 0.0


@entry(plain_cost=0.3)
def path_range(
    control: int,
    pairs: Rows,
    points: Cubes,
    meridians: Rows,
    states: Cubes,
    told: Cubes,
    statuses: Rows,
    ends: Rows,
    start: int,
    stop: int,
) -> None:
    """Paths for the rows from start to stop."""
    for i in range(start, stop):
        a, b, c, d = meridians[i]
        z = Four(float(a), float(b), float(c), float(d))
        _walk(control, pairs[i], points[i], z, states[i], told[i], statuses[i], ends[i])


class Walked(NamedTuple):
    """Paths as they went; states and lines have one more step than a path, the bridge as it broke."""

    states: Any
    told: Any  # what the lines do, as LINE_FIELDS
    statuses: Any
    end: Any  # how and where it ended, as END_FIELDS


def walk_paths(control: int, pairs: Rows, points: Cubes, meridians: Rows) -> Walked:
    """Carry bridges along paths.

    A row of ``pairs`` is (k, starting, advancing, receding angle) of both solids; ``points`` are (D, H or V) of every
    step of every path, the first that of a meridian in ``meridians``, a row of four numbers.
    """
    count, steps = points.shape[:2]
    states = np.full((count, steps + 1, len(State._fields)), math.nan)
    told = np.full((count, steps + 1, len(LINE_FIELDS)), math.nan)
    statuses = np.full((count, steps), NO_BRIDGE, np.int8)
    ends = np.zeros((count, len(END_FIELDS)))
    over_rows(path_range, count, 16, control, pairs, points, meridians, states, told, statuses, ends)
    return Walked(states, told, statuses, ends)
