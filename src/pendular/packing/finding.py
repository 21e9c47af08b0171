"""Which contacts hold a bridge in a step, and what it does: contacts are measured, and the table is asked.

Contacts are in the order of their particles. A window of them at a time passes through the first cache: it is
measured, compared with the bridges of the step before, and those that have or form one are asked for.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import Own, element, entry, over_rows
from ..ground.threads import thread_count
from ..table.arrays import FORCE, answer_block, block_room
from ..table.kernels import Grid
from .contacts import arm_of, ends_of, first_from, key_of

__all__ = ["CHUNK", "Found", "Question", "find", "room_of", "run_length"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

CHUNK = 16384  # contacts whose bridges lie together
WINDOW = 128  # contacts in the first cache
_RUN = 48  # chunks whose bridges lie in 32 MB, the most that the C library keeps at hand for the next step
_CALLS = 8  # chunks of a thread in a run, at least: to start takes as long as some thousand contacts
_BEYOND = 1 << 62  # behind the key of any pair


class Question(NamedTuple):
    """What is asked about contacts."""

    grid: Grid
    pairs: Integers  # (2 contacts,)
    former_pairs: Integers  # (2 bridges,): those of the step before
    former_control: Floats
    positions: Floats  # (3 particles,)
    radii: Floats
    reach: float  # of new bridges
    given: Floats  # control of new bridges, or of all: one for all contacts, or one for each
    tension: float

    @property
    def contacts(self) -> int:
        """How many there are."""
        return self.pairs.size // 2


class Found(NamedTuple):
    """Bridges of a run of contacts: those of a chunk lie together, from the place of its first contact on."""

    pairs: Integers  # (2 contacts,)
    control: Floats
    separation: Floats
    attraction: Floats  # NaN outside the range of the table
    stood: Integers  # (chunks,): bridges that stand
    kept: Integers  # bridges of the step before that have a contact, -1 where a contact is none or out of order
    highest: Integers  # last particle of the contacts


class _Room(NamedTuple):
    """Room of a thread for a window of contacts, and for the bridges among them."""

    key: Integers  # of a contact
    radii: Floats  # sum of the two
    gap: Floats
    former_key: Integers  # of bridges of the step before
    contact: Integers  # of a bridge: its number in the window
    former: Integers  # its number among those of the step before, -1 if it is new
    control: Floats
    numbers: Floats
    cells: Integers


def _room() -> _Room:
    key, former_key, contact, former = np.empty((4, WINDOW + 1), np.int64)
    radii, gap, control = np.empty((3, WINDOW))
    return _Room(key, radii, gap, former_key, contact, former, control, *block_room(WINDOW))


def run_length() -> int:
    """Contacts of a run."""
    return CHUNK * max(_RUN, _CALLS * thread_count())


def room_of(contacts: int) -> Found:
    """Room for the bridges of so many contacts."""
    rows, counts = np.empty((5, contacts)), np.empty((3, -(-contacts // CHUNK)), np.int64)  # as one block each
    return Found(rows[:2].reshape(-1).view(np.int64), *rows[2:], *counts)


@kernel
def _measure(asked: Question, room: _Room, last_key: int, begin: int, count: int) -> int:
    """Measure contacts, and return the last particle of them, or -1 where one is none or out of order."""
    pairs, radii, highest = asked.pairs[2 * begin : 2 * (begin + count)], asked.radii, -1
    for i in range(count):
        low, high = ends_of(pairs, i)
        key = low * radii.size + high
        if not (low >= 0 and low != high and high < radii.size and key > last_key):
            return -1
        last_key, highest = key, max(highest, high)
        x, y, z = arm_of(asked.positions, low, high)
        room.key[i], room.radii[i], room.gap[i] = key, radii[low] + radii[high], x * x + y * y + z * z
    are_apart = True
    for i in range(count):
        distance = math.sqrt(room.gap[i])
        are_apart &= distance > 0.0
        room.gap[i] = distance - room.radii[i]
    return highest if are_apart else -1


@kernel
def _read_former(asked: Question, room: _Room, bridge: int, last_key: int) -> None:
    """Keys of the bridges of the step before, from one on: as many as may have a contact in the window, and one more.

    A contact moves on by one bridge at most: no more are looked at.
    """
    pairs, particles = asked.former_pairs[2 * bridge :], asked.radii.size
    bridges = pairs.size // 2
    for i in range(min(bridges, WINDOW + 1)):
        low, high = ends_of(pairs, i)
        is_pair = low >= 0 and high < particles  # the key of another one may be that of a pair
        room.former_key[i] = low * particles + high if is_pair else _BEYOND
        if room.former_key[i] > last_key:
            return
    if bridges <= WINDOW:
        room.former_key[bridges] = _BEYOND


@kernel
def _collect(asked: Question, room: _Room, count: int) -> tuple[int, int]:
    """Collect the contacts of a window that had a bridge or form one: how many had, and how many there are."""
    kept = bridges = 0
    for i in range(count):
        had = room.key[i] == room.former_key[kept]  # no branches: which have a bridge cannot be foretold
        room.contact[bridges], room.former[bridges] = i, kept if had else -1
        bridges += had | (room.gap[i] <= asked.reach)
        kept += had
    return kept, bridges


@kernel
def _ask(asked: Question, room: _Room, begin: int, former: int, bridges: int) -> None:
    """Ask the table for the bridges of a window."""
    pairs, radii, held = asked.pairs[2 * begin :], asked.radii, asked.former_control[former:]
    for i in range(bridges):
        contact = room.contact[i]
        is_held = asked.grid.is_volume and room.former[i] >= 0
        control = held[room.former[i]] if is_held else element(asked.given, begin + contact)
        room.control[i] = room.numbers[1, i] = control
        room.numbers[0, i], room.numbers[4, i] = room.gap[contact], asked.tension
        room.numbers[2, i], room.numbers[3, i] = radii[pairs[2 * contact]], radii[pairs[2 * contact + 1]]
    answer_block(FORCE, asked.grid, room.numbers, room.cells, bridges)


@kernel
def _write(asked: Question, found: Found, room: _Room, begin: int, bridges: int, place: int) -> int:
    """Write down those bridges of a window that stand, from a place on, and return how many."""
    pairs, end, stood = asked.pairs[2 * begin :], place + bridges, 0
    written, control = found.pairs[2 * place : 2 * end], found.control[place:end]
    separation, attraction = found.separation[place:end], found.attraction[place:end]
    for i in range(bridges):
        contact = room.contact[i]
        written[2 * stood], written[2 * stood + 1] = pairs[2 * contact], pairs[2 * contact + 1]
        control[stood], separation[stood], attraction[stood] = room.control[i], room.numbers[0, i], room.numbers[-1, i]
        stood += room.numbers[-1, i] != 0.0  # exactly, from rupture on
    return stood


@kernel
def _find_in_chunk(
    asked: Question, found: Found, room: _Room, start: int, stop: int, place: int
) -> tuple[int, int, int]:
    """Find the bridges of a chunk of contacts: how many stand, how many had a contact, and the last particle."""
    particles = asked.radii.size
    last_key = key_of(asked.pairs, start - 1, particles) if start > 0 else -1
    begin_former = first_from(asked.former_pairs, key_of(asked.pairs, start, particles), particles)
    former, stood, highest = begin_former, 0, -1
    for begin in range(start, stop, WINDOW):
        count = min(WINDOW, stop - begin)
        last = _measure(asked, room, last_key, begin, count)
        if last < 0:
            return 0, -1, -1
        highest, last_key = max(highest, last), room.key[count - 1]
        _read_former(asked, room, former, last_key)
        kept, bridges = _collect(asked, room, count)
        _ask(asked, room, begin, former, bridges)
        stood += _write(asked, found, room, begin, bridges, place + stood)
        former += kept
    return stood, former - begin_former, highest


@entry(plain_cost=1e-4, patience=1.0)
def _find_range(asked: Question, found: Found, room: _Room, first: int, start: int, stop: int) -> None:
    """Find the bridges of contacts, counted from a first one on, chunk by chunk."""
    for place in range(start, stop, CHUNK):
        begin, end, chunk = first + place, first + min(place + CHUNK, stop), place // CHUNK
        counts = _find_in_chunk(asked, found, room, begin, end, place)
        found.stood[chunk], found.kept[chunk], found.highest[chunk] = counts


def find(asked: Question, room: Found, first: int, contacts: int) -> Found:
    """Measure a run of contacts, and ask the table for their bridges; what is found lies in the room."""
    chunks = -(-contacts // CHUNK)
    found = room._replace(stood=room.stood[:chunks], kept=room.kept[:chunks], highest=room.highest[:chunks])
    over_rows(_find_range, contacts, CHUNK, asked, found, Own(_room), first)
    return found
