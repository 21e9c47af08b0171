"""Bridges that keep their own liquid: births, ruptures, and where the liquid of a broken one goes."""

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .answers import Answers, answers_at
from .history import pairs_at
from .neighbours import Neighbours
from .setting import Setting
from .state import State, standing_of

__all__ = ["RULES", "Rule", "Undrained", "undrained_of"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Rule = Literal["shared", "lost"]

RULES: tuple[Rule, ...] = ("shared", "lost")


class Undrained(NamedTuple):
    """Pairs that hold a bridge, and the liquid that left or entered."""

    pairs: Neighbours
    answers: Answers
    supplied: float  # to new bridges, [m³]
    released: float  # lost to the outside
    unheld: float  # left on grains without another bridge


def undrained_of(setting: Setting, volume: float, start: State | bool, rule: Rule) -> Undrained:
    """Bridges of given volumes.

    Parameters
    ----------
    setting : Setting
        The heap.
    volume : float
        Of each bridge that forms, [m³]; with 0 none forms.
    start : State or bool
        Bridges that stand already; or whether all pairs within the rupture distance hold one, or those in contact.
    rule : {"shared", "lost"}
        The liquid of a broken bridge: half for each of the two grains, which divides it evenly among its other bridges;
        a grain without one, or a wall, leaves its half to the partner, and what neither takes is unheld. Or lost.

    Returns
    -------
    Undrained
    """
    stood = start.volume if isinstance(start, State) else np.empty(0)
    largest = max(volume, 2.0 * float(stood.max(initial=0.0)))
    pairs = pairs_at(setting, "volume", largest)
    unheld = start.unheld if isinstance(start, State) else 0.0
    held = np.zeros(len(pairs.gap))
    if isinstance(start, State):
        standing = standing_of(start, pairs)
        held[standing.has] = start.volume[standing.bridge[standing.has]]
    forms = (setting.touching(pairs.gap) if start is not True else np.ones(len(held), bool)) & (held == 0.0)
    held[forms] = volume
    is_new = forms & (held > 0.0)
    members = held > 0.0
    pairs, held, is_new = pairs.taken(members), held[members], is_new[members]
    stands = _stands(setting, pairs, held, is_new)  # a pair too far apart for a new bridge never had one
    pairs, held, is_new = pairs.taken(stands), held[stands], is_new[stands]
    supplied, released = float(np.sum(held[is_new])), 0.0
    ends, liquid = np.empty((0, 2), np.int32), np.empty(0)
    if isinstance(start, State):
        ends, liquid = start.pairs[standing.gone], start.volume[standing.gone]
    while True:
        if rule == "lost":
            released += float(np.sum(liquid))
        else:
            unheld += _share(setting.heap.count, pairs, held, ends, liquid)
        answers = answers_at(setting, pairs, "volume", held)
        stands = answers.exists
        ends, liquid = pairs.pairs[~stands], held[~stands]
        pairs, held, answers = pairs.taken(stands), held[stands], answers.taken(stands)
        if stands.all():
            return Undrained(pairs, answers._replace(volume=held), supplied, released, unheld)


def _stands(setting: Setting, pairs: Neighbours, held: Floats, is_new: Bools) -> Bools:
    """Whether a pair is near enough for its bridge, of the new ones; the others stood before."""
    stands = np.ones(len(held), bool)
    stands[is_new] = answers_at(setting, pairs.taken(is_new), "volume", held[is_new]).exists
    return stands


def _share(grains: int, pairs: Neighbours, held: Floats, ends: NDArray[np.integer], liquid: Floats) -> float:
    """Add the liquid of broken bridges to the others of their grains; return what no bridge takes."""
    bodies = max(grains, int(pairs.pairs.max(initial=0)) + 1, int(ends.max(initial=0)) + 1)
    number = np.bincount(pairs.pairs.ravel(), minlength=bodies)
    number[grains:] = 0  # walls take nothing
    takes = number[ends] > 0
    count = takes.sum(axis=1)
    portion = np.where(takes, (liquid / np.maximum(count, 1))[:, None], 0.0)
    each = np.bincount(ends.ravel(), weights=portion.ravel(), minlength=bodies) / np.maximum(number, 1)
    held += each[pairs.pairs].sum(axis=1)
    return float(np.sum(liquid[count == 0]))
