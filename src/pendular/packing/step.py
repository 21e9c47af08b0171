"""One step of all bridges on all threads: a run of contacts after another, in the order of their particles.

Bridges of a run are found, then put beside those of the runs before and added up.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .adding import Bridges, Part, Sums, add_up
from .finding import CHUNK, Found, Question, find, room_of, run_length

__all__ = ["Step", "take_step"]

Floats = NDArray[np.float64]

_SPARE = 1.125  # room for bridges, over those that are expected


class Step(NamedTuple):
    """What bridges do in a step."""

    bridges: Bridges
    force: Floats  # (3 particles,)
    virial: Floats  # (3, 3); NaN or infinite if a position or a radius is none, or a bridge outside of the table


def take_step(asked: Question) -> Step | None:
    """Answer a question, or None if a pair is none or out of order, or if a bridge of the step before has no contact.

    Sums do not depend on the runs.
    """
    contacts, run = asked.contacts, max(1, min(run_length(), asked.contacts))
    room, bridges, sums = room_of(run), _room_for(asked.former_control.size, contacts), _sums_of(asked)
    count = kept = lowest = fresh = 0
    for first in range(0, max(1, contacts), run):
        found = find(asked, room, first, min(run, contacts - first))
        if (found.kept < 0).any():
            return None
        part = _part_of(asked, found, lowest, fresh, first + run)
        stood = count + int(found.stood.sum())
        if stood > bridges.control.size:
            bridges = _moved(bridges, count, _room_for(stood * contacts // min(first + run, contacts), contacts))
        add_up(found, bridges, count, sums, part)
        count, kept, lowest, fresh = stood, kept + int(found.kept.sum()), part.complete, max(fresh, part.end)
    if kept < asked.former_control.size:
        return None
    for array, numbers in zip(bridges, (2, 1, 1, 1), strict=True):
        array.resize(numbers * count, refcheck=False)
    xx, yy, zz, xy, yz, zx = sums.virial.sum(axis=0).tolist()
    return Step(bridges, sums.force, np.array([(xx, xy, zx), (xy, yy, yz), (zx, yz, zz)]))


def _sums_of(asked: Question) -> Sums:
    """Room for sums over bridges."""
    chunks = -(-asked.radii.size // CHUNK)
    return Sums(asked.positions, asked.radii, np.empty_like(asked.positions), np.empty((chunks, 6)))


def _part_of(asked: Question, found: Found, lowest: int, fresh: int, following: int) -> Part:
    """Particles that bridges may join, where a following contact is the first of the next run."""
    particles = asked.radii.size
    if following >= asked.contacts:
        return Part(lowest, fresh, particles, particles)
    low = int(asked.pairs[2 * following : 2 * following + 2].min())
    complete = min(max(lowest, low // CHUNK * CHUNK), particles)  # the following pair may be none
    return Part(lowest, fresh, complete, max(complete, int(found.highest.max()) + 1))


def _room_for(bridges: int, contacts: int) -> Bridges:
    """Room for about so many bridges, and no more than contacts."""
    count = min(int(_SPARE * bridges) + CHUNK, contacts)
    return Bridges(np.empty(2 * count, np.int64), np.empty(count), np.empty(count), np.empty(count))


def _moved(bridges: Bridges, count: int, room: Bridges) -> Bridges:
    """The first bridges in a larger room."""
    room.pairs[: 2 * count] = bridges.pairs[: 2 * count]
    for old, new in zip(bridges[1:], room[1:], strict=True):
        new[:count] = old[:count]
    return room
