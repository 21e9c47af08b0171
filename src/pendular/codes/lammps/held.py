"""Bridges on their way from one neighbour list to the next, and from rank to rank."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import compiled, kernel
from ...packing.forces import BridgeState
from .forces import CONTROL, Bridges, no_bridges, put
from .neighbours import MIRROR, Candidates, find_pairs, tags_of
from .ranks import added_up, gathered

__all__ = ["Held", "held_by", "held_in", "placed", "shared", "state_of"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Indices = NDArray[np.int32]

_SPARE = 64  # records for bridges that will form


class Held(NamedTuple):
    """Bridges by the tags of their atoms."""

    tags: Integers  # (bridges, 2)
    control: Floats  # (bridges,)
    slot: Integers  # (bridges,): of the record on this rank, or -1


@kernel
def _decided(pairs: Candidates, bridges: Bridges) -> Integers:
    """Candidates with a bridge that this rank decides about."""
    out = np.empty(pairs.first.size, np.int64)
    count = 0
    for c in range(pairs.first.size):
        if bridges.slot[c] >= 0 and pairs.target[c] != MIRROR:
            out[count] = c
            count += 1
    return out[:count]


def held_by(pairs: Candidates, bridges: Bridges) -> Held:
    """Bridges that this rank decides about."""
    some = compiled(_decided)(pairs, bridges)
    slot = bridges.slot[some]
    return Held(compiled(tags_of)(pairs, some), bridges.records[slot, CONTROL], slot.astype(np.int64))


def held_in(state: BridgeState) -> Held:
    """Bridges of a state."""
    return Held(np.sort(state.pairs, 1), state.control, np.full(len(state.pairs), -1))


def state_of(held: Held, world: Any) -> BridgeState:
    """Bridges of all ranks, in the order of their tags."""
    rows = gathered(world, np.column_stack([held.tags, held.control]))
    rows = rows[np.lexsort((rows[:, 1], rows[:, 0]))]
    return BridgeState(rows[:, :2].astype(np.int64), rows[:, 2].copy())


@kernel
def _has_both(tags: Integers, atoms: Indices) -> NDArray[np.bool_]:
    """Whether both atoms of a bridge are on this rank."""
    both = np.empty(tags.shape[0], np.bool_)
    for row in range(tags.shape[0]):
        low, high = tags[row, 0], tags[row, 1]
        both[row] = high < atoms.size and atoms[low] >= 0 and atoms[high] >= 0
    return both


def shared(held: Held, atoms: Indices, world: Any) -> tuple[Held, int]:
    """Bridges of this rank, then those that join two ranks or have moved to another; the number of the first."""
    if world is None:
        return held, len(held.control)
    here = compiled(_has_both)(held.tags, atoms)
    rows = gathered(world, np.column_stack([held.tags[~here], held.control[~here]]))
    tags = np.concatenate([held.tags[here], rows[:, :2].astype(np.int64)])
    slot = np.concatenate([held.slot[here], np.full(len(rows), -1)])
    return Held(tags, np.concatenate([held.control[here], rows[:, 2]]), slot), int(here.sum())


@kernel
def _carry(former: Indices, held: Held, pairs: Candidates, old: Bridges, new: Bridges) -> None:
    """Give the candidates that had a bridge a record, in their order, and copy what there is."""
    count = 0
    for c in range(former.size):
        bridge = former[c]
        if bridge < 0:
            continue
        put(pairs, new, c, count)
        slot = held.slot[bridge]
        if slot >= 0:
            new.heads[count] = old.heads[slot]
            new.records[count] = old.records[slot]
        new.records[count, CONTROL] = held.control[bridge]
        count += 1


def placed(
    held: Held, own: int, pairs: Candidates, x: Floats, atoms: Indices, old: Bridges, world: Any
) -> tuple[Bridges, Integers]:
    """Bridges among new candidates, and which of those held are nowhere: told on one rank, if several look for them."""
    found = compiled(find_pairs)(pairs, x, atoms, held.tags)
    here = np.flatnonzero(found >= 0)
    former = np.full(pairs.first.size, -1, np.int32)
    former[found[here]] = here
    new = no_bridges(pairs.first.size, here.size + _SPARE)
    compiled(_carry)(former, held, pairs, old, new)
    nowhere = found < 0
    if world is not None:
        nowhere[own:] = added_up(world, (found[own:] >= 0).astype(np.float64)) == 0.0
        if world.rank > 0:
            nowhere[own:] = False
    return new, np.flatnonzero(nowhere)
