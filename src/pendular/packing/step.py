"""One step of all bridges on all threads: two passes over the contacts and one over the particles.

Contacts are in the order of their particles. The first pass measures them, finds which held a bridge, and asks the
table, a block of bridges at a time; the second puts together those that stand; the third adds up. Sums are those of
bridges in their order, for one particle, and of particles in a chunk: they do not depend on the number of threads, to
the last bit.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import Own, element, entry, over_rows
from ..ground.threads import thread_count
from ..table.arrays import BLOCK, FORCE, answer_block, block_room
from ..table.kernels import Grid

__all__ = ["CHUNK", "Bridges", "Found", "Question", "add_up", "distance_of", "ends_of", "find", "put_together"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

CHUNK = 16384  # contacts whose bridges lie together, or particles whose virials are added up
_CALLS = 8  # of a thread in a pass: to lay out the arguments of one takes as long as some hundred contacts
_BEYOND = 1 << 62


class Question(NamedTuple):
    """What is asked about contacts."""

    grid: Grid
    pairs: Integers
    former_pairs: Integers  # bridges of the step before
    former_control: Floats
    positions: Floats
    radii: Floats
    reach: float  # of new bridges
    given: Floats  # control of new bridges, or of all: one for all contacts, or one for each
    tension: float


class Found(NamedTuple):
    """Bridges that stand: those of a chunk of contacts lie together, from the place of its first one on."""

    contact: Integers
    control: Floats
    separation: Floats
    attraction: Floats  # NaN outside the range of the table
    counts: Integers  # (chunks, 3): how many there are, how many bridges of before have a contact, and if one is none

    @property
    def is_faulty(self) -> bool:
        """Whether a contact is none, or not after the one before it, or of two with one centre."""
        return bool(self.counts[:, 2].any())

    @property
    def kept(self) -> int:
        """How many bridges of the step before have a contact, in their order."""
        return int(self.counts[:, 1].sum())


class Bridges(NamedTuple):
    """Bridges that stand, side by side."""

    pairs: Integers
    control: Floats
    separation: Floats
    attraction: Floats
    ends: Integers  # (chunks + 1,): where those of a chunk of contacts begin and end
    highest: Integers  # (chunks,): last particle that one of them joins, -1 if there is none


class _Room(NamedTuple):
    """Room of a thread for a block of bridges."""

    contact: Integers
    former: Integers
    control: Floats
    numbers: Floats
    cells: Integers


def _room() -> _Room:
    return _Room(np.empty(BLOCK, np.int64), np.empty(BLOCK, np.int64), np.empty(BLOCK), *block_room())


@kernel
def ends_of(pairs: Integers, contact: int) -> tuple[int, int]:
    """Particles of a contact, in ascending order."""
    first, second = pairs[contact, 0], pairs[contact, 1]
    return (first, second) if first < second else (second, first)


@kernel
def _arm_of(positions: Floats, first: int, second: int) -> tuple[float, float, float]:
    """From one centre to another."""
    return (
        positions[second, 0] - positions[first, 0],
        positions[second, 1] - positions[first, 1],
        positions[second, 2] - positions[first, 2],
    )


@kernel
def distance_of(positions: Floats, first: int, second: int) -> float:
    """Between two centres."""
    x, y, z = _arm_of(positions, first, second)
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
def _ask_block(asked: Question, found: Found, room: _Room, count: int, place: int) -> int:
    """Ask the table for a block of bridges, write down those that stand from a place on, and return the next place."""
    for i in range(count):
        is_held = asked.grid.is_volume and room.former[i] >= 0
        held = asked.former_control[room.former[i]] if is_held else element(asked.given, room.contact[i])
        room.control[i] = room.numbers[1, i] = held
        room.numbers[4, i] = asked.tension
    answer_block(FORCE, asked.grid, room.numbers, room.cells, count)
    for i in range(count):
        attraction = room.numbers[-1, i]
        found.contact[place], found.control[place] = room.contact[i], room.control[i]
        found.separation[place], found.attraction[place] = room.numbers[0, i], attraction
        place += attraction != 0.0  # exactly, from rupture on
    return place


@kernel
def _find_at(asked: Question, found: Found, room: _Room, start: int, stop: int) -> None:
    """Find the bridges of a chunk of contacts, up to one that is none."""
    pairs, radii, counts = asked.pairs, asked.radii, found.counts[start // CHUNK]
    place, kept, contact = start, 0, start
    last_low, last_high = ends_of(pairs, start - 1) if start > 0 else (-1, -1)
    low, high = ends_of(pairs, start)
    bridge = _first_from(asked.former_pairs, low, high)
    at_low, at_high = _ends_or_beyond(asked.former_pairs, bridge)
    while contact < stop:
        count = 0
        while contact < stop and count < BLOCK:
            first, second = pairs[contact, 0], pairs[contact, 1]
            low, high = ends_of(pairs, contact)
            is_pair = low >= 0 and low != high and high < radii.size and _precedes(last_low, last_high, low, high)
            distance = distance_of(asked.positions, first, second) if is_pair else 0.0
            if not distance > 0.0:
                counts[2] = 1
                return
            last_low, last_high = low, high
            gap = distance - (radii[first] + radii[second])
            was = (at_low == low) & (at_high == high)  # no branches: which have a bridge cannot be foretold
            room.contact[count], room.former[count] = contact, bridge if was else -1
            room.numbers[0, count], room.numbers[2, count], room.numbers[3, count] = gap, radii[first], radii[second]
            bridge += was
            kept += was
            count += was | (gap <= asked.reach)
            at_low, at_high = _ends_or_beyond(asked.former_pairs, bridge)
            contact += 1
        place = _ask_block(asked, found, room, count, place)
    counts[0], counts[1] = place - start, kept


@entry(plain_cost=1e-4, patience=1.0)
def _find_range(asked: Question, found: Found, room: _Room, start: int, stop: int) -> None:
    """Find the bridges of contacts, chunk by chunk."""
    for begin in range(start, stop, CHUNK):
        _find_at(asked, found, room, begin, min(begin + CHUNK, stop))


def _at_a_time(count: int) -> int:
    """Contacts that one thread takes at a time: some chunks."""
    return CHUNK * max(count // (CHUNK * _CALLS * thread_count()), 1)


def find(asked: Question) -> Found:
    """Measure contacts, and ask the table for their bridges."""
    count = len(asked.pairs)
    rows = np.empty((4, count))  # in one block, as the system keeps it at hand for the next step
    found = Found(rows[0].view(np.int64), rows[1], rows[2], rows[3], np.zeros((-(-count // CHUNK), 3), np.int64))
    over_rows(_find_range, count, _at_a_time(count), asked, found, Own(_room))
    return found


@kernel
def _put_at(pairs: Integers, found: Found, bridges: Bridges, start: int) -> None:
    """Put the bridges of a chunk of contacts in their place."""
    chunk = start // CHUNK
    begin, end, highest = bridges.ends[chunk], bridges.ends[chunk + 1], -1
    for bridge in range(begin, end):
        row = start + bridge - begin
        first, second = pairs[found.contact[row], 0], pairs[found.contact[row], 1]
        bridges.pairs[bridge, 0], bridges.pairs[bridge, 1] = first, second
        bridges.control[bridge], bridges.separation[bridge] = found.control[row], found.separation[row]
        bridges.attraction[bridge] = found.attraction[row]
        highest = max(highest, first, second)
    bridges.highest[chunk] = highest


@entry(plain_cost=3e-6)
def _put_range(pairs: Integers, found: Found, bridges: Bridges, start: int, stop: int) -> None:
    """Put the bridges of contacts in their places, chunk by chunk."""
    for begin in range(start, stop, CHUNK):
        _put_at(pairs, found, bridges, begin)


def put_together(pairs: Integers, found: Found) -> Bridges:
    """Bridges that stand, in the order of their contacts."""
    ends = np.concatenate([np.zeros(1, np.int64), np.cumsum(found.counts[:, 0])])
    count = int(ends[-1])
    bridges = Bridges(
        np.empty((count, 2), np.int64), np.empty(count), np.empty(count), np.empty(count),
        ends, np.empty(len(found.counts), np.int64),
    )  # fmt: skip
    over_rows(_put_range, len(pairs), _at_a_time(len(pairs)), pairs, found, bridges)
    return bridges


@kernel
def _add_pulls(bridges: Bridges, positions: Floats, force: Floats, start: int, stop: int) -> None:
    """Add the pulls of all bridges to the particles from start to stop."""
    for chunk in range(bridges.highest.size):
        if bridges.highest[chunk] < start:
            continue
        for bridge in range(bridges.ends[chunk], bridges.ends[chunk + 1]):
            first, second = bridges.pairs[bridge, 0], bridges.pairs[bridge, 1]
            if first >= stop and second >= stop:
                return  # bridges are in the order of the smaller
            is_first, is_second = start <= first < stop, start <= second < stop
            if is_first or is_second:
                x, y, z = _arm_of(positions, first, second)
                pull = bridges.attraction[bridge] / math.sqrt(x * x + y * y + z * z)
                x, y, z = pull * x, pull * y, pull * z
                if is_first:
                    force[first, 0] += x
                    force[first, 1] += y
                    force[first, 2] += z
                if is_second:
                    force[second, 0] -= x
                    force[second, 1] -= y
                    force[second, 2] -= z


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


@entry(plain_cost=2e-5)
def _add_up_range(bridges: Bridges, positions: Floats, force: Floats, virial: Floats, start: int, stop: int) -> None:
    """Forces on the particles from start to stop, and their virial, chunk by chunk."""
    force[start:stop] = 0.0
    _add_pulls(bridges, positions, force, start, stop)
    for begin in range(start, stop, CHUNK):
        _virial_of(force, positions, virial[begin // CHUNK], begin, min(begin + CHUNK, stop))


def add_up(bridges: Bridges, positions: Floats) -> tuple[Floats, Floats]:
    """Force on each particle, and the virial, which is that of the forces: they add up to none.

    Each thread has particles of its own, and looks at all bridges that may be theirs.
    """
    force, chunks = np.empty_like(positions), -(-len(positions) // CHUNK)
    parts = np.zeros((chunks, 3, 3))
    share = CHUNK * -(-chunks // thread_count())
    over_rows(_add_up_range, len(positions), share, bridges, positions, force, parts)
    virial = parts.sum(axis=0)
    return force, 0.5 * (virial + virial.T)
