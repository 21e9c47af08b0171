"""Forces of the bridges between neighbours, in one compiled pass, and what is asked less often.

A bridge has a record: the force polynomial of its pair at its control and in the cell of the table where it was last
looked at. It is made anew when the bridge leaves the cell, or when its control or its radii change. Between two such
events a force is a square root and a polynomial of one variable.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import kernel
from ...packing.forces import distance_of
from ...table import Grid, kernels
from ...table.slices import slice_at
from .neighbours import MIRROR, Candidates

__all__ = [
    "CONTROL",
    "SUM",
    "Bridges",
    "Liquid",
    "add_forces",
    "add_others",
    "end",
    "energies",
    "enlarged",
    "form",
    "no_bridges",
    "put",
    "separations",
    "virials",
    "volumes",
]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Indices = NDArray[np.int32]

NO_BRIDGE = -1
SUM, TOUCHING = range(2)  # columns of the heads, which suffice for a bridge of grains that overlap
RUPTURE, OFFSET, SLOPE, CONTROL = range(4)  # columns of the records, before eight coefficients
_FIRST, _COLUMNS = 8, 16
_EDGE = 1.0 + 1e-9
_ROUNDING = 1.0 + 1e-12
_BELOW_RUPTURE = 1.0 - 1e-12


class Liquid(NamedTuple):
    """What is the same for all bridges."""

    grid: Grid
    surface_tension: float
    formation_distance: float
    cutoff: float  # no bridge reaches farther, between centres


class Bridges(NamedTuple):
    """Which candidates hold a bridge, and a row for each that does."""

    slot: Indices  # (candidates,): row of the bridge, or NO_BRIDGE
    candidate: Indices  # (slots,): NO_BRIDGE if the row is free
    ends: Indices  # (slots, 3): first, second and target of the candidate
    heads: Floats  # (slots, 2): sum of the radii, NaN for a record to be made, and force at contact
    records: Floats  # (slots, _COLUMNS)


def no_bridges(candidates: int, slots: int) -> Bridges:
    """Candidates without bridges, and free rows."""
    free = np.full(slots, NO_BRIDGE, np.int32)
    ends, heads = np.zeros((slots, 3), np.int32), np.full((slots, 2), math.nan)
    return Bridges(np.full(candidates, NO_BRIDGE, np.int32), free, ends, heads, np.empty((slots, _COLUMNS)))


def enlarged(bridges: Bridges, lacking: int) -> tuple[Bridges, Integers]:
    """Bridges with more free rows, and these, the last first."""
    rows = len(bridges.candidate)
    more = no_bridges(0, lacking + rows // 4)
    grown = Bridges(
        bridges.slot,
        np.concatenate([bridges.candidate, more.candidate]),
        np.concatenate([bridges.ends, more.ends]),
        np.concatenate([bridges.heads, more.heads]),
        np.concatenate([bridges.records, more.records]),
    )
    return grown, np.arange(len(grown.candidate) - 1, rows - 1, -1)


@kernel
def put(pairs: Candidates, bridges: Bridges, candidate: int, slot: int) -> None:
    """Let a candidate have the bridge in a row."""
    bridges.slot[candidate], bridges.candidate[slot] = slot, candidate
    bridges.ends[slot, 0] = pairs.first[candidate]
    bridges.ends[slot, 1] = pairs.second[candidate]
    bridges.ends[slot, 2] = pairs.target[candidate]


@kernel
def form(pairs: Candidates, bridges: Bridges, candidates: Integers, slots: Integers, control: Floats) -> None:
    """Let candidates have new bridges in free rows."""
    for k in range(candidates.size):
        put(pairs, bridges, candidates[k], slots[k])
        bridges.heads[slots[k], SUM] = math.nan
        bridges.records[slots[k], CONTROL] = control[k]


@kernel
def end(bridges: Bridges, candidates: Integers) -> Integers:
    """Let the bridges of candidates break; rows that are free then."""
    freed = np.empty(candidates.size, np.int64)
    for k in range(candidates.size):
        freed[k] = bridges.slot[candidates[k]]
        bridges.slot[candidates[k]] = bridges.candidate[freed[k]] = NO_BRIDGE
    return freed


@kernel
def _make(liquid: Liquid, radius1: float, radius2: float, separation: float, bridges: Bridges, slot: int) -> None:
    """Fill the record of a bridge; its forces are NaN outside the range of the table or of the neighbour list."""
    control, tension, record = bridges.records[slot, CONTROL], liquid.surface_tension, bridges.records[slot]
    pair, place, rupture = kernels.find(liquid.grid, control, radius1, radius2, tension)
    bridges.heads[slot, SUM] = radius1 + radius2
    bridges.heads[slot, TOUCHING] = kernels.force(liquid.grid, 0.0, control, radius1, radius2, tension)
    record[RUPTURE] = rupture
    if not radius1 + radius2 + rupture <= liquid.cutoff * _ROUNDING:
        bridges.heads[slot, TOUCHING] = record[RUPTURE] = math.nan
    elif separation < rupture:
        series = record[_FIRST:]
        q = kernels.q_of(separation, rupture)
        record[OFFSET], record[SLOPE] = slice_at(liquid.grid, place, q, series)
        series *= 2.0 * math.pi * tension * pair.radius


@kernel
def _from_record(bridges: Bridges, slot: int, sum_of_radii: float, separation: float) -> float:
    """Force of a bridge by its record: 0.0 from the rupture distance on, NaN if the record is not of this place."""
    if bridges.heads[slot, SUM] != sum_of_radii:
        return math.nan
    if separation <= 0.0:
        return bridges.heads[slot, TOUCHING]
    rupture = bridges.records[slot, RUPTURE]
    if separation >= rupture:
        return 0.0
    t = bridges.records[slot, OFFSET] + bridges.records[slot, SLOPE] * math.sqrt(1.0 - separation / rupture)
    if not abs(t) <= _EDGE:
        return math.nan
    total = 0.0
    for k in range(_COLUMNS - 1, _FIRST - 1, -1):
        total = total * t + bridges.records[slot, k]
    return total


@kernel
def _attraction(
    liquid: Liquid, radius1: float, radius2: float, separation: float, bridges: Bridges, slot: int
) -> float:
    """Force of a bridge: 0.0 from the rupture distance on, NaN outside the range of the table."""
    pull = _from_record(bridges, slot, radius1 + radius2, separation)
    if math.isnan(pull):
        _make(liquid, radius1, radius2, separation, bridges, slot)
        pull = _from_record(bridges, slot, radius1 + radius2, separation)
    return pull


@kernel
def add_forces(
    bridges: Bridges, x: Floats, radius: Floats, force: Floats, broken: Integers, stale: Integers
) -> tuple[int, int]:
    """Set the forces on the local atoms, as far as the records tell them, without those of mirrors.

    Returns how many candidates are listed whose bridges broke, and how many whose records are of another place.
    """
    breaks, others = 0, 0
    force[:] = 0.0
    # Unsigned indices need no look whether they count from the end, which takes as long as all the rest.
    for row in range(bridges.candidate.size):
        slot = np.uintp(row)
        to = bridges.ends[slot, 2]
        if bridges.candidate[slot] < 0 or to == MIRROR:
            continue
        i, j = np.uintp(bridges.ends[slot, 0]), np.uintp(bridges.ends[slot, 1])
        dx, dy, dz = x[j, 0] - x[i, 0], x[j, 1] - x[i, 1], x[j, 2] - x[i, 2]
        distance = math.sqrt(dx * dx + dy * dy + dz * dz)
        sum_of_radii = radius[i] + radius[j]
        if distance <= sum_of_radii == bridges.heads[slot, SUM]:  # most bridges; a call takes as long as all the rest
            pull = bridges.heads[slot, TOUCHING]
        else:
            pull = _from_record(bridges, int(slot), sum_of_radii, distance - sum_of_radii)
        if pull == 0.0:
            broken[breaks] = bridges.candidate[slot]
            breaks += 1
            continue
        if math.isnan(pull):
            stale[others] = bridges.candidate[slot]
            others += 1
            continue
        pull /= distance
        dx, dy, dz = dx * pull, dy * pull, dz * pull
        force[i, 0] += dx
        force[i, 1] += dy
        force[i, 2] += dz
        if to >= 0:
            target = np.uintp(to)
            force[target, 0] -= dx
            force[target, 1] -= dy
            force[target, 2] -= dz
    return breaks, others


@kernel
def add_others(
    some: Integers,
    pairs: Candidates,
    bridges: Bridges,
    liquid: Liquid,
    x: Floats,
    radius: Floats,
    force: Floats,
    broken: Integers,
    breaks: int,
) -> tuple[int, int]:
    """Add the forces of bridges whose records may have to be made, and go on with the list of those that broke.

    Without such a list others have found them to stand. Returns its length, and a bridge outside the table or -1.
    """
    outside = -1
    for c in some:
        i, j, slot = pairs.first[c], pairs.second[c], bridges.slot[c]
        if slot < 0:
            continue
        distance = distance_of(x, i, j)
        separation = distance - (radius[i] + radius[j])
        pull = _attraction(liquid, radius[i], radius[j], separation, bridges, slot)
        if pull == 0.0 and broken.size:
            broken[breaks] = c
            breaks += 1
            continue
        if pull == 0.0:  # the distances that two ranks find differ by rounding
            separation = _BELOW_RUPTURE * bridges.records[slot, RUPTURE]
            pull = _attraction(liquid, radius[i], radius[j], separation, bridges, slot)
        if not math.isfinite(pull / distance):
            outside = c
            continue
        for k in range(3):
            part = pull / distance * (x[j, k] - x[i, k])
            force[i, k] += part
            if pairs.target[c] >= 0:
                force[pairs.target[c], k] -= part
    return breaks, outside


@kernel
def separations(some: Integers, pairs: Candidates, x: Floats, radius: Floats, out: Floats) -> None:
    """Gap, and the two radii, of some candidates."""
    for row in range(some.size):
        i, j = pairs.first[some[row]], pairs.second[some[row]]
        out[row, 0] = distance_of(x, i, j) - (radius[i] + radius[j])
        out[row, 1], out[row, 2] = radius[i], radius[j]


@kernel
def energies(pairs: Candidates, bridges: Bridges, liquid: Liquid, x: Floats, radius: Floats, by_atom: Floats) -> None:
    """Energy of the bridges, half of it for each atom."""
    by_atom[:] = 0.0
    for c in range(pairs.first.size):
        if bridges.slot[c] < 0:
            continue
        i, j, target = pairs.first[c], pairs.second[c], pairs.target[c]
        control = bridges.records[bridges.slot[c], CONTROL]
        separation = distance_of(x, i, j) - (radius[i] + radius[j])
        half = 0.5 * kernels.energy(liquid.grid, separation, control, radius[i], radius[j], liquid.surface_tension)
        by_atom[i] += half
        if target >= 0:
            by_atom[target] += half


@kernel
def volumes(pairs: Candidates, bridges: Bridges, liquid: Liquid, x: Floats, radius: Floats) -> float:
    """Liquid in the bridges that this rank decides about."""
    total = 0.0
    for c in range(pairs.first.size):
        if bridges.slot[c] < 0 or pairs.target[c] == MIRROR:
            continue
        i, j = pairs.first[c], pairs.second[c]
        held = bridges.records[bridges.slot[c], CONTROL]
        if not liquid.grid.is_volume:
            separation = distance_of(x, i, j) - (radius[i] + radius[j])
            held = kernels.liquid(liquid.grid, separation, held, radius[i], radius[j], liquid.surface_tension)
        total += held
    return total


@kernel
def virials(pairs: Candidates, bridges: Bridges, liquid: Liquid, x: Floats, radius: Floats, by_atom: Floats) -> None:
    """Virial of the bridges (xx, yy, zz, xy, xz, yz), half of it for each atom."""
    by_atom[:] = 0.0
    for c in range(pairs.first.size):
        if bridges.slot[c] < 0:
            continue
        i, j, target = pairs.first[c], pairs.second[c], pairs.target[c]
        distance = distance_of(x, i, j)
        separation = distance - (radius[i] + radius[j])
        pull = _attraction(liquid, radius[i], radius[j], separation, bridges, bridges.slot[c])
        for m in range(6):
            a, b = (m, m) if m < 3 else (max(m - 4, 0), min(m - 2, 2))
            half = -0.5 * pull / distance * (x[j, a] - x[i, a]) * (x[j, b] - x[i, b])
            by_atom[i, m] += half
            if target >= 0:
                by_atom[target, m] += half
