"""Bridges of a running LAMMPS: stepped, asked and saved."""

from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...ground.check import as_path
from ...ground.compile import compiled
from ...ground.files import in_one_line, whole
from ...packing.forces import BridgeState
from ...table import Table
from . import forces
from .approach import Approach
from .checks import check_box, check_radius, control_of, reach_of
from .failures import stop_with
from .forces import CONTROL, SUM, Bridges, Liquid, enlarged, no_bridges
from .held import held_by, held_in, placed, shared, state_of
from .neighbours import (
    ELSEWHERE,
    MIRROR,
    Candidates,
    candidates_of,
    find_pairs,
    list_index,
    local_atoms,
    no_candidates,
    tags_of,
)
from .ranks import added_up, first_failure, gathered, largest
from .stores import EVENT, HELD, LARGER, SEPARATION, SMALLER, Supply, may_form, settle
from .tallies import Tallies

__all__ = ["Coupling"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_EVENTS, _FAILURE = 1, 2  # what a rank has to tell the others in a step
_NONE = np.empty(0, np.int64)
_NO_EVENTS = np.empty((0, EVENT))


class Coupling:
    """Bridges in a running LAMMPS, made by :func:`couple`.

    What is read from it is of the last step and of all ranks. Under MPI every rank has to read it.
    """

    def __init__(self, lammps: Any, table: Table, liquid: Liquid, supply: Supply, state: BridgeState, fix: str) -> None:
        self._lammps, self._table, self._liquid, self._supply = lammps, table, liquid, supply
        self._world = lammps.get_mpi_comm() if lammps.extract_setting("world_size") > 1 else None
        self._tallies = Tallies(lammps, fix, self._world)
        self._given: BridgeState | None = state  # until the first list, in which its bridges find their places
        self._pairs = no_candidates()
        self._bridges, self._free = no_bridges(0, 0), _NONE
        self._lost = _NO_EVENTS  # bridges of atoms that are gone

    @property
    def control(self) -> float:
        """Suction in all bridges, [Pa], or the volume that a new one takes, [m³]. Set it between two runs."""
        return self._supply.control

    @control.setter
    def control(self, value: float) -> None:
        held = control_of(self._table, value)
        liquid = self._liquid
        reach = reach_of(self._table, self._lammps, held, liquid.surface_tension, liquid.formation_distance)
        if reach > liquid.cutoff:
            raise ValueError(
                f"{self._table.control}: bridges reach {reach:.6g} m between centres, beyond the cutoff of "
                f"{liquid.cutoff:.6g} m"
            )
        self._supply = self._supply._replace(control=held)
        if self._table.control == "volume":
            return
        self._bridges.records[:, CONTROL] = held
        self._bridges.heads[:, SUM] = np.nan
        if self._given is not None:
            self._given = self._given._replace(control=np.full(len(self._given.pairs), held))

    @property
    def cutoff(self) -> float:
        """How far the neighbour list has to reach, between centres, [m]."""
        return self._liquid.cutoff

    @property
    def bridges(self) -> BridgeState:
        """Ids of the atoms that each bridge joins, the smaller first, in order; and its suction or volume."""
        return state_of(held_by(self._pairs, self._bridges), self._world) if self._given is None else self._given

    @property
    def stores(self) -> Floats:
        """Liquid on the particles, by their ids, [m³]; empty if they were given none."""
        return self._supply.stores.copy()

    @property
    def liquid(self) -> float:
        """Liquid in all bridges, [m³]."""
        return self._sum(compiled(forces.volumes)(*self._now()))

    @property
    def energy(self) -> float:
        """Potential of all bridges, [J], as :func:`pendular.contact_energy` has it."""
        return self._sum(self._energies().sum())

    def save(self, path: str | PathLike[str]) -> None:
        """Write the bridges and the stores for a restart by ``couple(..., state=path)``.

        Parameters
        ----------
        path : path
            Of a file of NumPy, which ends in ``.npz``; the first rank writes it.
        """
        pairs, control = self.bridges
        if self._world is None or self._world.rank == 0:
            place = as_path("path", path)
            with in_one_line("path", place), whole(place) as draft, draft.open("wb") as file:
                np.savez(file, pairs=pairs, control=control, stores=self._supply.stores)

    def step(self, _caller: Any, step: int, _local: int, _tags: Any, _positions: Any, force: Floats) -> None:
        """What LAMMPS calls for the forces of a step; no exception may leave it."""
        events, failure = _NO_EVENTS, None
        try:
            if self._given is not None or self._lammps.extract_setting("neigh_ago") == 0:
                self._take_list()
            events = self._add_forces(force)
        except Exception as error:  # of any kind: it would be printed and forgotten
            failure = error
        told = largest(self._world, _FAILURE if failure else _EVENTS if self._concerns_others(events) else 0)
        if told == _FAILURE:
            force[:] = 0.0
            stop_with(self._lammps, first_failure(self._world, failure))
            return
        try:
            if told == _EVENTS:
                events = gathered(self._world, events)
            if len(events) or self._mirrors.size:
                self._change(events, force)
            self._tallies.hand_over(step, self._energies, self._virials)
        except Exception as error:
            stop_with(self._lammps, error)

    def _take_list(self) -> None:
        """Read the new neighbour list and find the bridges in it."""
        lammps, world = self._lammps, self._world
        index = list_index(lammps)
        check_box(lammps, self._liquid.cutoff)
        local, count = lammps.extract_setting("nlocal"), lammps.extract_setting("nall")
        self._x = lammps.numpy.extract_atom("x", nelem=count, dim=3)
        self._radius = lammps.numpy.extract_atom("radius", nelem=count)
        # Of all ranks: one that raised alone would leave the others waiting for what it has to tell.
        radius = largest(world, float(self._radius.max(initial=0.0)))
        check_radius(radius, self._liquid.formation_distance, self._liquid.cutoff)
        tags = lammps.numpy.extract_atom("id", nelem=count).astype(np.int64)
        highest = int(tags.max(initial=0))
        if self._supply.stores.size and largest(world, highest) >= self._supply.stores.size:
            raise ValueError(f"stores: there is none for atom {int(largest(world, highest))}")
        self._atoms = compiled(local_atoms)(tags, local, highest + 1)
        pairs = candidates_of(lammps, index, tags, local, self._atoms)
        is_given = self._given is not None
        if self._given is not None:
            held, own = held_in(self._given), 0
        else:
            held, own = shared(held_by(self._pairs, self._bridges), self._atoms, world)
        bridges, nowhere = placed(held, own, pairs, self._x, self._atoms, self._bridges, world)
        self._pairs, self._bridges, self._given = pairs, bridges, None
        self._free = np.arange(len(bridges.heads) - 1, int((bridges.slot >= 0).sum()) - 1, -1)
        self._mirrors = np.flatnonzero(pairs.target == MIRROR)
        self._broken, self._stale = np.empty((2, pairs.first.size), np.int64)
        self._approach = Approach(pairs, self._x, self._radius)
        if is_given and nowhere.size:
            first, second = held.tags[nowhere[0]]
            raise ValueError(f"state: atoms {first} and {second} have a bridge but are no neighbours")
        self._lost = np.zeros((nowhere.size, EVENT))
        self._lost[:, :SEPARATION] = held.tags[nowhere]
        self._lost[:, SEPARATION], self._lost[:, HELD] = np.nan, held.control[nowhere]

    def _add_forces(self, force: Floats) -> Floats:
        """Forces of the bridges that stand; those that form and break are returned as events."""
        bridges, broken, stale = self._bridges, self._broken, self._stale
        breaks, others = compiled(forces.add_forces)(bridges, self._x, self._radius, force, broken, stale)
        if others:
            breaks = self._add_others(stale[:others], force, broken, breaks)
        near = self._approach.near(bridges, self._liquid.formation_distance, self._x, self._radius)
        if not near.size and not breaks and not len(self._lost):
            return _NO_EVENTS
        formed, ended = self._events(near), self._events(broken[:breaks])
        compiled(may_form)(self._liquid, self._supply, formed)
        outside = np.flatnonzero(np.isinf(formed[:, HELD]))
        if outside.size:
            self._refuse(int(near[outside[0]]))
        ended[:, SEPARATION] = np.nan
        ended[:, HELD] = bridges.records[bridges.slot[broken[:breaks]], CONTROL]
        lost, self._lost = self._lost, _NO_EVENTS
        return np.concatenate([formed[np.isfinite(formed[:, HELD])], ended, lost])

    def _add_others(self, some: Integers, force: Floats, broken: Integers, breaks: int) -> int:
        """Add the forces of bridges whose records may have to be made; returns how many are listed as broken then."""
        breaks, outside = compiled(forces.add_others)(
            some, self._pairs, self._bridges, self._liquid, self._x, self._radius, force, broken, breaks
        )
        if outside >= 0:
            self._refuse(outside)
        return int(breaks)

    def _events(self, some: Integers) -> Floats:
        """Events of some candidates, without what they hold."""
        rows = np.zeros((some.size, EVENT))
        rows[:, :SEPARATION] = compiled(tags_of)(self._pairs, some)
        compiled(forces.separations)(some, self._pairs, self._x, self._radius, rows[:, SEPARATION:HELD])
        return rows

    def _concerns_others(self, events: Floats) -> bool:
        """Whether other ranks have to know of events: they keep the same stores, or have one of the atoms."""
        if self._world is None or not len(events):
            return False
        if self._supply.stores.size:
            return True
        found = compiled(find_pairs)(self._pairs, self._x, self._atoms, events[:, :SEPARATION].astype(np.int64))
        return bool((self._pairs.target[found[found >= 0]] == ELSEWHERE).any())

    def _change(self, events: Floats, force: Floats) -> None:
        """Let bridges break and form, and add the forces of the latter and of those that other ranks decide about."""
        pairs = self._pairs
        if self._supply.stores.size:
            events = events[np.lexsort((events[:, LARGER], events[:, SMALLER]))]  # the same order on all ranks
            compiled(settle)(self._liquid, self._supply, events)
            events = events[np.isfinite(events[:, HELD])]
        found = compiled(find_pairs)(pairs, self._x, self._atoms, events[:, :SEPARATION].astype(np.int64))
        events, found = events[found >= 0], found[found >= 0]
        breaks = np.isnan(events[:, SEPARATION])
        broken, formed = found[breaks], found[~breaks]
        self._free = np.concatenate([self._free, compiled(forces.end)(self._bridges, broken)])
        self._approach.watch(broken)
        rows = self._rows(formed.size)  # which may replace the bridges by an enlarged copy
        compiled(forces.form)(pairs, self._bridges, formed, rows, events[~breaks, HELD])
        some = np.concatenate([formed[pairs.target[formed] != MIRROR], self._mirrors])
        self._add_others(some, force, _NONE, 0)

    def _rows(self, count: int) -> Integers:
        """Free rows for new bridges."""
        lacking = count - self._free.size
        if lacking > 0:
            self._bridges, added = enlarged(self._bridges, lacking)
            self._free = np.concatenate([added, self._free])
        self._free, taken = np.split(self._free, [self._free.size - count])
        return taken[::-1].copy()

    def _now(self) -> tuple[Candidates, Bridges, Liquid, Floats, Floats]:
        """Arguments of the kernels that look at all bridges."""
        if self._given is not None:
            raise ValueError("coupling: LAMMPS has made no step yet; use 'run 0'")
        return self._pairs, self._bridges, self._liquid, self._x, self._radius

    def _energies(self) -> Floats:
        """By local atom, [J]."""
        energy = np.empty(self._pairs.start.size)
        compiled(forces.energies)(*self._now(), energy)
        return energy

    def _virials(self) -> Floats:
        """By local atom, [J]."""
        virial = np.empty((self._pairs.start.size, 6))
        compiled(forces.virials)(*self._now(), virial)
        return virial

    def _sum(self, value: float) -> float:
        return float(added_up(self._world, np.array([value]))[0])

    def _refuse(self, candidate: int) -> None:
        """Say why a pair has no place in the table."""
        i, j, slot = (array[candidate] for array in (self._pairs.first, self._pairs.second, self._bridges.slot))
        held = self._bridges.records[slot, CONTROL] if slot >= 0 else self._supply.control
        radius1, radius2, tension = float(self._radius[i]), float(self._radius[j]), self._liquid.surface_tension
        who = f"atoms {self._pairs.tags[i]} and {self._pairs.tags[j]}"
        try:
            reach = radius1 + radius2 + float(self._table.rupture_distance(held, radius1, radius2, tension))
        except ValueError as error:
            raise ValueError(f"{who}: {error}") from None
        if reach > self._liquid.cutoff:
            raise ValueError(
                f"{who}: their bridge reaches {reach:.6g} m between centres, beyond the cutoff of "
                f"{self._liquid.cutoff:.6g} m"
            )
        raise ValueError(f"{who}: have the same centre, or one that is not a number")
