"""One step of all bridges on all threads: three passes, two over the contacts and one over the particles.

Contacts are in the order of their particles. The first pass measures them and finds which held a bridge; the second
asks the table; the third adds up. Sums are those of contacts in their order, for one particle or in a chunk: they do
not depend on the number of threads, to the last bit.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import Own, element, entry, over_rows
from ..ground.threads import thread_count
from ..table.arrays import FORCE, block_range, block_room
from ..table.kernels import Grid

__all__ = ["Bridges", "Look", "add_up", "ask", "distance_of", "ends_of", "look"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

CHUNK = 16384  # contacts that one thread takes at a time
_BEYOND = 1 << 62


class Look(NamedTuple):
    """Contacts, measured."""

    separation: Floats  # NaN of a pair that is none
    former: Integers  # bridge of the step before, or -1
    held: Integers  # by chunks, how many have a bridge now
    kept: int  # how many had one
    is_faulty: bool  # a pair is none, or not after the one before it, or of two with one centre


class Bridges(NamedTuple):
    """Bridges that stand."""

    pairs: Integers
    control: Floats
    separation: Floats
    attraction: Floats
    pull: Floats  # attraction over the distance of the centres


@kernel
def ends_of(pairs: Integers, contact: int) -> tuple[int, int]:
    """Particles of a contact, in ascending order."""
    first, second = pairs[contact, 0], pairs[contact, 1]
    return (first, second) if first < second else (second, first)


@kernel
def distance_of(positions: Floats, first: int, second: int) -> float:
    """Between two centres."""
    x = positions[second, 0] - positions[first, 0]
    y = positions[second, 1] - positions[first, 1]
    z = positions[second, 2] - positions[first, 2]
    return math.sqrt(x * x + y * y + z * z)


@kernel
def _precedes(low: int, high: int, other_low: int, other_high: int) -> bool:
    return low < other_low or (low == other_low and high < other_high)


@kernel
def _first_from(pairs: Integers, low: int, high: int) -> int:
    """First of ordered pairs that does not precede another."""
    begin, end = 0, pairs.shape[0]
    while begin < end:
        middle = (begin + end) // 2
        at_low, at_high = ends_of(pairs, middle)
        if _precedes(at_low, at_high, low, high):
            begin = middle + 1
        else:
            end = middle
    return begin


@kernel
def _ends_or_beyond(pairs: Integers, bridge: int) -> tuple[int, int]:
    """Particles of a bridge, or behind the last one numbers that no particle has."""
    return ends_of(pairs, bridge) if bridge < pairs.shape[0] else (_BEYOND, _BEYOND)


@kernel
def _look_at(
    pairs: Integers,
    former_pairs: Integers,
    positions: Floats,
    radii: Floats,
    reach: float,
    separation: Floats,
    former: Integers,
    start: int,
    stop: int,
) -> tuple[int, int, int]:
    """Measure a chunk of contacts; how many hold a bridge, how many held one, and how many are no contacts."""
    held, kept, faults = 0, 0, 0
    last_low, last_high = ends_of(pairs, start - 1) if start > 0 else (-1, -1)
    low, high = ends_of(pairs, start)
    bridge = _first_from(former_pairs, low, high)
    at_low, at_high = _ends_or_beyond(former_pairs, bridge)
    for contact in range(start, stop):
        first, second = pairs[contact, 0], pairs[contact, 1]
        low, high = ends_of(pairs, contact)
        former[contact], separation[contact] = -1, math.nan
        is_pair = low >= 0 and low != high and high < radii.size and _precedes(last_low, last_high, low, high)
        distance = distance_of(positions, first, second) if is_pair else 0.0
        if not distance > 0.0:
            faults += 1
            continue
        last_low, last_high = low, high
        separation[contact] = distance - (radii[first] + radii[second])
        while _precedes(at_low, at_high, low, high):
            bridge += 1
            at_low, at_high = _ends_or_beyond(former_pairs, bridge)
        was = (at_low == low) & (at_high == high)  # no branches: whether it was cannot be foretold
        former[contact] = bridge if was else -1
        bridge += was
        kept += was
        held += was | (separation[contact] <= reach)
        at_low, at_high = _ends_or_beyond(former_pairs, bridge)
    return held, kept, faults


@entry(plain_cost=4e-6)
def _look_range(
    pairs: Integers,
    former_pairs: Integers,
    positions: Floats,
    radii: Floats,
    reach: float,
    separation: Floats,
    former: Integers,
    counts: Integers,
    start: int,
    stop: int,
) -> None:
    """Measure contacts, chunk by chunk."""
    for begin in range(start, stop, CHUNK):
        end = min(begin + CHUNK, stop)
        held, kept, faults = _look_at(pairs, former_pairs, positions, radii, reach, separation, former, begin, end)
        counts[begin // CHUNK, 0], counts[begin // CHUNK, 1], counts[begin // CHUNK, 2] = held, kept, faults


def look(pairs: Integers, former_pairs: Integers, positions: Floats, radii: Floats, reach: float) -> Look:
    """Measure contacts, and find which of them held one of the ordered bridges of the step before."""
    separation, former = np.empty(len(pairs)), np.empty(len(pairs), np.int64)
    counts = np.zeros((-(-len(pairs) // CHUNK), 3), np.int64)
    over_rows(_look_range, len(pairs), CHUNK, pairs, former_pairs, positions, radii, reach, separation, former, counts)
    held, kept, faults = counts.T
    return Look(separation, former, held, int(kept.sum()), bool(faults.any()))


class _Question(NamedTuple):
    """What a table is asked about contacts that are measured."""

    grid: Grid
    pairs: Integers
    former: Integers
    separation: Floats
    reach: float
    given: Floats  # control of new bridges, or of all
    former_control: Floats
    radii: Floats
    tension: Floats


class _Rows(NamedTuple):
    """Rows of bridges that are being filled: those of a chunk of contacts lie together, from its offset on."""

    pairs: Integers
    control: Floats
    separation: Floats
    attraction: Floats
    pull: Floats
    offset: Integers  # (chunks,)
    standing: Integers  # (chunks,): how many


class _Room(NamedTuple):
    """Room of a thread."""

    chosen: Integers
    radius1: Floats
    radius2: Floats
    numbers: Floats
    cells: Integers


def _room() -> _Room:
    return _Room(np.empty(CHUNK, np.int64), np.empty(CHUNK), np.empty(CHUNK), *block_room())


@kernel
def _ask_at(asked: _Question, rows: _Rows, room: _Room, start: int, stop: int) -> None:
    """Fill the bridges of a chunk of contacts, and close the gaps of those that break."""
    pairs, former, separation, radii = asked.pairs, asked.former, asked.separation, asked.radii
    chunk = start // CHUNK
    begin, count = rows.offset[chunk], 0
    for contact in range(start, stop):  # no branches: which have a bridge cannot be foretold
        room.chosen[count] = contact
        count += (former[contact] >= 0) | (separation[contact] <= asked.reach)
    for i in range(count):
        contact, bridge = room.chosen[i], begin + i
        kept, first, second = former[contact], pairs[contact, 0], pairs[contact, 1]
        is_held = asked.grid.is_volume and kept >= 0
        rows.pairs[bridge, 0], rows.pairs[bridge, 1] = first, second
        rows.control[bridge] = asked.former_control[kept] if is_held else element(asked.given, contact)
        rows.separation[bridge] = separation[contact]
        room.radius1[i], room.radius2[i] = radii[first], radii[second]
    end = begin + count
    radius1, radius2 = room.radius1[:count], room.radius2[:count]
    operands = rows.separation[begin:end], rows.control[begin:end], radius1, radius2, asked.tension
    block_range(FORCE, asked.grid, operands, rows.attraction[begin:end], room.numbers, room.cells, 0, count)
    standing = begin
    for bridge in range(begin, end):
        attraction = rows.attraction[bridge]
        if attraction == 0.0:  # exactly, from rupture on
            continue
        gap = rows.separation[bridge]
        rows.pairs[standing, 0], rows.pairs[standing, 1] = rows.pairs[bridge, 0], rows.pairs[bridge, 1]
        rows.control[standing], rows.separation[standing] = rows.control[bridge], gap
        rows.attraction[standing] = attraction
        rows.pull[standing] = attraction / (gap + (room.radius1[bridge - begin] + room.radius2[bridge - begin]))
        standing += 1
    rows.standing[chunk] = standing - begin


@entry(plain_cost=1e-4, patience=1.0)
def _ask_range(asked: _Question, rows: _Rows, room: _Room, start: int, stop: int) -> None:
    """Fill the bridges of contacts, chunk by chunk."""
    for begin in range(start, stop, CHUNK):
        _ask_at(asked, rows, room, begin, min(begin + CHUNK, stop))


def ask(
    grid: Grid,
    pairs: Integers,
    seen: Look,
    reach: float,
    given: Floats,
    former_control: Floats,
    radii: Floats,
    tension: float,
) -> Bridges:
    """Ask a table for the bridges of contacts; NaN where it holds none such. Suctions are those that are given."""
    offset = np.cumsum(seen.held) - seen.held
    most = int(seen.held.sum())
    rows = _Rows(
        np.empty((most, 2), np.int64), np.empty(most), np.empty(most), np.empty(most), np.empty(most),
        offset, np.zeros_like(offset),
    )  # fmt: skip
    asked = _Question(
        grid, pairs, seen.former, seen.separation, reach, given, former_control, radii, np.array([tension])
    )
    over_rows(_ask_range, len(pairs), CHUNK, asked, rows, Own(_room))
    return Bridges(
        _closed(rows.pairs, rows), _closed(rows.control, rows), _closed(rows.separation, rows),
        _closed(rows.attraction, rows), _closed(rows.pull, rows),
    )  # fmt: skip


def _closed(column: NDArray[Any], rows: _Rows) -> NDArray[Any]:
    """What stands of a column, without the gaps at the ends of chunks: it moves up in its place."""
    end = 0
    for start, count in zip(rows.offset.tolist(), rows.standing.tolist(), strict=True):
        if start > end:
            column[end : end + count] = column[start : start + count]
        end += count
    return column[:end]


@entry(plain_cost=2e-5)
def _add_up_range(pairs: Integers, positions: Floats, pull: Floats, force: Floats, start: int, stop: int) -> None:
    """Add the pulls of all bridges to the particles from start to stop: each thread looks at all that may be theirs."""
    for bridge in range(pairs.shape[0]):
        first, second = pairs[bridge, 0], pairs[bridge, 1]
        if first >= stop and second >= stop:
            break  # bridges are in the order of the smaller
        is_first, is_second = start <= first < stop, start <= second < stop
        if is_first or is_second:
            for k in range(3):
                part = pull[bridge] * (positions[second, k] - positions[first, k])
                if is_first:
                    force[first, k] += part
                if is_second:
                    force[second, k] -= part


@kernel
def _virial_of(force: Floats, positions: Floats, virial: Floats, start: int, stop: int) -> None:
    """Sum of forces times places, from the first particle on, over a chunk of particles."""
    xx = xy = xz = yx = yy = yz = zx = zy = zz = 0.0
    x0, y0, z0 = positions[0, 0], positions[0, 1], positions[0, 2]
    for i in range(start, stop):
        x, y, z = positions[i, 0] - x0, positions[i, 1] - y0, positions[i, 2] - z0
        f, g, h = force[i, 0], force[i, 1], force[i, 2]
        xx, xy, xz = xx + f * x, xy + f * y, xz + f * z
        yx, yy, yz = yx + g * x, yy + g * y, yz + g * z
        zx, zy, zz = zx + h * x, zy + h * y, zz + h * z
    whole = ((xx, xy, xz), (yx, yy, yz), (zx, zy, zz))
    for k in range(3):
        for m in range(3):
            virial[k, m] = whole[k][m]


@entry(plain_cost=3e-6)
def _virial_range(force: Floats, positions: Floats, virial: Floats, start: int, stop: int) -> None:
    """Virial of the particles from start to stop, chunk by chunk."""
    for begin in range(start, stop, CHUNK):
        _virial_of(force, positions, virial[begin // CHUNK], begin, min(begin + CHUNK, stop))


def add_up(bridges: Bridges, positions: Floats) -> tuple[Floats, Floats]:
    """Force on each particle, and the virial, which is that of the forces: they add up to none."""
    force = np.zeros_like(positions)
    share = -(-len(positions) // thread_count())
    over_rows(_add_up_range, len(positions), share, bridges.pairs, positions, bridges.pull, force)
    parts = np.zeros((-(-len(positions) // CHUNK), 3, 3))
    over_rows(_virial_range, len(positions), CHUNK, force, positions, parts)
    virial = parts.sum(axis=0)
    return force, 0.5 * (virial + virial.T)
