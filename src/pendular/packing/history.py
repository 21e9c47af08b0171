"""Which pairs hold a bridge: what stood before, what touches, what condenses, and what breaks."""

from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from .answers import Answers, Ends, answers_at, ends_of
from .heap import Packing
from .neighbours import Neighbours, ReachTable, find_neighbours, reach_table
from .setting import Setting, reach_at
from .shape import POTENTIAL
from .solids import check_overlaps, solid_volume_of

__all__ = ["Pairs", "Step", "members_of", "pairs_at", "reach_of", "solid_volume_at", "step_at"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


class Pairs(NamedTuple):
    """Pairs within reach of a bridge."""

    near: Neighbours
    ends: Ends
    touching: Bools  # near enough for a bridge to form at once

    def taken(self, chosen: Bools) -> "Pairs":
        """Some of them."""
        return Pairs(self.near.taken(chosen), self.ends.taken(chosen), self.touching[chosen])


class Step(NamedTuple):
    """Pairs at one suction: what a bridge would be, and whether the pair holds one."""

    answers: Answers
    members: Bools


class Search(NamedTuple):
    """Pairs of a heap, and what the grains fill."""

    reach: ReachTable
    near: Neighbours
    solid_volume: float  # [m³]


# The last search in a heap serves again while no wider reach is asked.
_SEARCHED: "WeakKeyDictionary[Packing, Search]" = WeakKeyDictionary()


def pairs_at(setting: Setting, control: str, value: float) -> Pairs:
    """Pairs that are within reach at a suction, [Pa], or of a volume, [m³]."""
    asked = reach_table(setting.heap, reach_at(setting, control, value))
    known = _searched(setting.heap, asked)
    near = known.near
    if asked.most < known.reach.most:
        near = near.taken(near.gap <= asked.most)
    ends = ends_of(setting, near.pairs, near.gap)
    return Pairs(near, ends, setting.touching(near.gap, ends.radius1, ends.radius2))


def reach_of(setting: Setting, suction: float) -> float:
    """Largest gap of a bridge in the heap at a suction, [m]."""
    return reach_table(setting.heap, reach_at(setting, "suction", suction)).most


def solid_volume_at(heap: Packing) -> float:
    """Of the grains, overlaps counted once, [m³]."""
    known = _SEARCHED.get(heap)
    return (known or _searched(heap, reach_table(heap, lambda radius1, radius2: 0.0 * radius1))).solid_volume


def _searched(heap: Packing, asked: ReachTable) -> Search:
    """Pairs of a heap within a reach or a wider one."""
    known = _SEARCHED.get(heap)
    if known is None or not known.reach.covers(asked):
        near = find_neighbours(heap, asked)
        check_overlaps(heap, near)
        known = Search(asked, near, solid_volume_of(heap, near))
        _SEARCHED[heap] = known
    return known


def members_of(setting: Setting, pairs: Pairs, answers: Answers, before: Bools) -> Bools:
    r"""Pairs that hold a bridge now.

    A bridge that stood before stands up to its rupture. A new one forms where the bodies touch, and by condensation
    where its grand potential is not above that of the dry bodies, Ω ≤ 0.
    """
    forms = pairs.touching
    if setting.condensation:
        with np.errstate(invalid="ignore"):
            forms = forms | (answers.shape[:, POTENTIAL] <= 0.0)
    return answers.exists & (before | forms)


def step_at(setting: Setting, pairs: Pairs, suction: float, before: Bools) -> Step:
    """All pairs at a suction, from those that held a bridge before."""
    answers = answers_at(setting, pairs.ends, "suction", np.array([suction]))
    return Step(answers, members_of(setting, pairs, answers, before))
