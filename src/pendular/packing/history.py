"""Which pairs hold a bridge: what stood before, what touches, what condenses, and what breaks."""

from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from .answers import Answers, answers_at
from .heap import Packing
from .neighbours import Neighbours, ReachTable, reach_table, within
from .setting import Setting, reach_at
from .solids import check_overlaps, solid_volume_of

__all__ = ["Step", "members_of", "pairs_at", "reach_of", "solid_volume_at", "step_at"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


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


def pairs_at(setting: Setting, control: str, value: float) -> Neighbours:
    """Pairs that are within reach at a suction, [Pa], or of a volume, [m³]."""
    asked = reach_table(setting.heap, reach_at(setting, control, value))
    known = _searched(setting.heap, asked)
    near = known.near
    if asked.most < known.reach.most:
        near = near.taken(near.gap <= asked.most)
    return near


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
        near = within(heap, asked)
        check_overlaps(heap, near)
        known = Search(asked, near, solid_volume_of(heap, near))
        _SEARCHED[heap] = known
    return known


def members_of(setting: Setting, near: Neighbours, answers: Answers, before: Bools | bool) -> Bools:
    r"""Pairs that hold a bridge now.

    A bridge that stood before stands up to its rupture. A new one forms where the bodies touch, and by condensation
    where its grand potential is not above that of the dry bodies, Ω ≤ 0.
    """
    if before is True:
        return answers.exists
    forms = setting.touching(near.gap)
    if setting.condensation:
        with np.errstate(invalid="ignore"):
            forms |= answers.potential <= 0.0
    return answers.exists & (forms | before)


def step_at(setting: Setting, near: Neighbours, suction: float, before: Bools | bool) -> Step:
    """All pairs at a suction, from those that held a bridge before."""
    answers = answers_at(setting, near, "suction", np.array([suction]))
    return Step(answers, members_of(setting, near, answers, before))
