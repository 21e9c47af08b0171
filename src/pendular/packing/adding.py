"""What bridges do to the particles of a step: their pulls added up, and the virial.

Sums are those of bridges in their order, for one particle, and of particles in a chunk: they do not depend on the
number of threads, to the last bit. Each thread has particles of its own, and looks at all bridges that may be theirs.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import Own, copy_part, entry, over_rows
from ..ground.threads import thread_count
from .contacts import arm_of, place_of
from .finding import CHUNK, WINDOW, Found

__all__ = ["Bridges", "Part", "Sums", "add_up"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class Bridges(NamedTuple):
    """Bridges that stand, side by side."""

    pairs: Integers  # (2 bridges,)
    control: Floats
    separation: Floats
    attraction: Floats


class Sums(NamedTuple):
    """What is summed up over bridges, and where the particles are."""

    positions: Floats  # (3 particles,)
    radii: Floats
    force: Floats  # (3 particles,)
    virial: Floats  # (chunks of particles, 6): xx, yy, zz, xy, yz, zx; not finite where a position or a radius is none


class Part(NamedTuple):
    """Particles that bridges of a run may join."""

    lowest: int  # where a chunk begins
    fresh: int  # first one that has no force yet
    complete: int  # first one that later runs may join
    end: int


class _Pulls(NamedTuple):
    """Room of a thread for the forces of a window of bridges on their first particles."""

    x: Floats
    y: Floats
    z: Floats


def _pulls() -> _Pulls:
    return _Pulls(np.empty(WINDOW), np.empty(WINDOW), np.empty(WINDOW))


@kernel
def _pull(found: Found, positions: Floats, pulls: _Pulls, begin: int, count: int) -> None:
    """Forces of bridges on their first particles."""
    pairs, attraction = found.pairs[2 * begin : 2 * (begin + count)], found.attraction[begin : begin + count]
    for i in range(count):
        pulls.x[i], pulls.y[i], pulls.z[i] = arm_of(positions, pairs[2 * i], pairs[2 * i + 1])
    for i in range(count):
        x, y, z = pulls.x[i], pulls.y[i], pulls.z[i]
        pull = attraction[i] / math.sqrt(x * x + y * y + z * z)
        pulls.x[i], pulls.y[i], pulls.z[i] = pull * x, pull * y, pull * z


@kernel
def _add(found: Found, force: Floats, pulls: _Pulls, begin: int, count: int, start: int, stop: int) -> tuple[int, int]:
    """Add pulls to those particles that lie from start to stop.

    Return how many bridges have their smaller particle before these, and how many have it among them.
    """
    pairs = found.pairs[2 * begin : 2 * (begin + count)]
    before = among = 0
    for i in range(count):
        first, second = pairs[2 * i], pairs[2 * i + 1]
        if start <= first < stop:
            x, y, z = place_of(first)
            force[x] += pulls.x[i]
            force[y] += pulls.y[i]
            force[z] += pulls.z[i]
        if start <= second < stop:
            x, y, z = place_of(second)
            force[x] -= pulls.x[i]
            force[y] -= pulls.y[i]
            force[z] -= pulls.z[i]
        low = min(first, second)
        before += low < start
        among += start <= low < stop
    return before, among


@kernel
def _put(found: Found, bridges: Bridges, begin: int, place: int, count: int) -> None:
    """Put bridges in their places."""
    copy_part(found.pairs, 2 * begin, bridges.pairs, 2 * place, 2 * count)
    copy_part(found.control, begin, bridges.control, place, count)
    copy_part(found.separation, begin, bridges.separation, place, count)
    copy_part(found.attraction, begin, bridges.attraction, place, count)


@kernel
def _take(found: Found, bridges: Bridges, place: int, sums: Sums, pulls: _Pulls, start: int, stop: int) -> None:
    """Put bridges in their places, from one on, and add up their pulls: those of the particles from start to stop."""
    for chunk in range(found.stood.size):
        first = chunk * CHUNK
        end = first + found.stood[chunk]
        for begin in range(first, end if found.highest[chunk] >= start else first, WINDOW):
            if min(found.pairs[2 * begin], found.pairs[2 * begin + 1]) >= stop:
                return  # bridges are in the order of the smaller
            count = min(WINDOW, end - begin)
            _pull(found, sums.positions, pulls, begin, count)
            before, among = _add(found, sums.force, pulls, begin, count, start, stop)
            _put(found, bridges, begin + before, place + begin - first + before, among)
        place += found.stood[chunk]


@kernel
def _virial_of(sums: Sums, virial: Floats, start: int, stop: int) -> None:
    """Sum of forces times places, from the first particle on, over a chunk of particles."""
    positions, force = sums.positions, sums.force
    xx = yy = zz = xy = yz = zx = 0.0
    x0, y0, z0 = positions[0], positions[1], positions[2]
    for i in range(start, stop):
        at_x, at_y, at_z = place_of(i)
        x, y, z = positions[at_x] - x0, positions[at_y] - y0, positions[at_z] - z0
        f, g, h = force[at_x], force[at_y], force[at_z]
        xx, yy, zz = xx + f * x, yy + g * y, zz + h * z
        xy, yz, zx = xy + (f * y + g * x), yz + (g * z + h * y), zx + (h * x + f * z)
    virial[0], virial[1], virial[2], virial[3], virial[4], virial[5] = xx, yy, zz, 0.5 * xy, 0.5 * yz, 0.5 * zx


@kernel
def _are_radii(radii: Floats, start: int, stop: int) -> bool:
    are_radii = True
    for i in range(start, stop):
        are_radii &= (radii[i] > 0.0) & (radii[i] < math.inf)
    return are_radii


@entry(plain_cost=2e-5)
def _add_range(
    found: Found, bridges: Bridges, place: int, sums: Sums, pulls: _Pulls, part: Part, start: int, stop: int
) -> None:
    """Take bridges to particles, counted from the lowest one of a part on, and sum up the virials of those that end."""
    first, end = part.lowest + start, part.lowest + stop
    sums.force[3 * max(first, part.fresh) : 3 * max(end, part.fresh)] = 0.0
    _take(found, bridges, place, sums, pulls, first, end)
    for begin in range(first, min(end, part.complete), CHUNK):
        virial, last = sums.virial[begin // CHUNK], min(begin + CHUNK, sums.radii.size)
        _virial_of(sums, virial, begin, last)
        if not _are_radii(sums.radii, begin, last):
            virial[0] = math.nan


def add_up(found: Found, bridges: Bridges, place: int, sums: Sums, part: Part) -> None:
    """Put bridges in their places, from one on, and add up their pulls on a part of the particles."""
    particles = part.end - part.lowest
    share = CHUNK * -(-particles // (CHUNK * thread_count()))
    over_rows(_add_range, particles, share, found, bridges, place, sums, Own(_pulls), part)
