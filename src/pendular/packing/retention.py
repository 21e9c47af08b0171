"""Retention of a heap: water and stress against suction, on drying, on wetting, and between."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.liquid import Liquid
from ..ground.check import in_range, quantity
from ..ground.units import show
from .answers import Answers, answers_at, geometry_of
from .heap import Packing
from .history import members_of, pairs_at, reach_of
from .limit import limit_between
from .neighbours import Neighbours
from .setting import Setting, setting_of
from .wet import Outcome, wetted_of
from .wetted import Wet

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["QUANTITIES", "Retention", "Walk", "retention", "retention_of"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Progress = Callable[[float], None]

# What is told at each suction, with its unit and meaning.
QUANTITIES = {
    "saturation": ("", "liquid over pores"),
    "water_content": ("", "liquid over the cell"),
    "suction_stress": ("Pa", "tr σ/3"),
    "chi": ("", "suction stress over suction"),
    "interface_area": ("1/m", "menisci over the cell"),
    "coordination": ("", "bridges a grain"),
    "meeting_grains": ("", "share of grains whose bridges meet"),
    "meeting_liquid": ("", "share of liquid in bridges that meet"),
}


class Walk(NamedTuple):
    """A path of suctions through the states of a heap."""

    name: str
    starts_wet: bool  # on the main drying branch, or on the main wetting branch
    turns_at: float  # suction at which it leaves that branch, [Pa]; NaN on a main one
    values: dict[str, Floats]  # of each of QUANTITIES, (suctions,); NaN where the path does not go
    stress: Floats  # (suctions, 3, 3), [Pa]


class Retention(NamedTuple):
    """Curves of a heap."""

    suction: Floats  # ascending, [Pa]
    walks: tuple[Walk, ...]  # main drying, main wetting, then the others
    limits: dict[str, float]  # suction below which bridges meet on each main branch, [Pa]; NaN outside the range
    porosity: float


def retention(
    heap: Packing,
    contact_angle: ArrayLike,
    suctions: ArrayLike,
    *,
    liquid: Liquid,
    reversals: ArrayLike | None = None,
    formation_distance: float = 0.0,
    condensation: bool = True,
    method: Literal["auto", "exact", "table"] = "auto",
) -> xr.Dataset:
    """Retention curves: main drying, main wetting, and scanning curves between them.

    Parameters
    ----------
    heap, contact_angle, liquid, formation_distance, condensation, method
        As for :func:`wet`.
    suctions : array_like
        [Pa], > 0, in any order.
    reversals : array_like, optional
        Suctions at which scanning curves leave the main ones, [Pa]; the middle one of ``suctions`` by default, none for
        an empty list. At each, drying turns to wetting, and wetting to drying.

    Returns
    -------
    xarray.Dataset
        Over ``path`` and ``suction``: saturation, water_content, suction_stress, chi, interface_area, coordination,
        meeting_grains, meeting_liquid, and stress over two axes more; NaN where a scanning curve does not go.
        ``pendular_limit`` over ``path`` is the suction below which bridges meet.

    Raises
    ------
    ValueError
        As :func:`wet`.

    Examples
    --------
    >>> import pendular as pl
    >>> edge = 4 / 3**0.5
    >>> heap = pl.Packing([(0, 0, 0), (edge / 2,) * 3], 1.0, cell=3 * (edge,)).repeated((3, 3, 3))
    >>> r = retention(heap, 0.0, [0.5, 1.0, 10.0], liquid=pl.Liquid(surface_tension=1.0), reversals=[])
    >>> r.coordination.sel(path="drying").values.tolist()
    [14.0, 8.0, 8.0]
    """
    setting = setting_of(heap, contact_angle, liquid, formation_distance, condensation, method)
    return dataset_of(retention_of(setting, suctions, reversals))


def retention_of(
    setting: Setting, suctions: ArrayLike, reversals: ArrayLike | None, progress: Progress | None = None
) -> Retention:
    """Curves of a heap as plain arrays; ``progress`` is told the share of the work that is done."""
    at = np.unique(in_range("suctions", quantity("suctions", suctions, "Pa"), 0.0, brackets="(]", unit="Pa"))
    turns = _turns(reversals, at)
    pairs = pairs_at(setting, "suction", float(at[0]))
    follow = _Follower(setting, pairs, at, turns, progress)
    walks = follow.all()
    return Retention(at, walks, {walk.name: _limit(setting, at, walk) for walk in walks[:2]}, follow.porosity)


def dataset_of(curves: Retention) -> xr.Dataset:
    """Curves as labelled arrays."""
    import xarray as xr

    walks = curves.walks
    data: dict[str, Any] = {
        name: (
            ("path", "suction"),
            np.array([walk.values[name] for walk in walks]),
            {"units": unit, "long_name": meaning},
        )
        for name, (unit, meaning) in QUANTITIES.items()
    }
    data["stress"] = (
        ("path", "suction", "i", "j"),
        np.array([walk.stress for walk in walks]),
        {"units": "Pa", "long_name": "capillary stress, tension positive"},
    )
    data["pendular_limit"] = (
        "path",
        np.array([curves.limits.get(walk.name, np.nan) for walk in walks]),
        {"units": "Pa", "long_name": "suction below which bridges meet"},
    )
    coordinates = {
        "path": [walk.name for walk in walks],
        "suction": ("suction", curves.suction, {"units": "Pa"}),
        "reversal": ("path", np.array([walk.turns_at for walk in walks]), {"units": "Pa"}),
        "starts": ("path", ["wet" if walk.starts_wet else "dry" for walk in walks]),
    }
    return xr.Dataset(data, coordinates, {"porosity": curves.porosity})


def _turns(reversals: ArrayLike | None, suctions: Floats) -> Floats:
    if reversals is None:
        return suctions[len(suctions) // 2 : len(suctions) // 2 + 1] if len(suctions) > 2 else np.empty(0)
    if np.size(reversals) == 0:
        return np.empty(0)
    given = np.unique(quantity("reversals", reversals, "Pa"))
    return in_range("reversals", given, float(suctions[0]), float(suctions[-1]), unit="Pa")


class _Follower:
    """Follows all paths at once, so that the bridges at a suction are found once for all of them.

    Rising suctions serve drying, falling ones wetting. The state of a main branch at a suction is that of a wet or a
    dry start.
    """

    def __init__(
        self, setting: Setting, pairs: Neighbours, suctions: Floats, turns: Floats, progress: Progress | None
    ) -> None:
        self.setting, self.pairs, self.suctions, self.progress = setting, pairs, suctions, progress
        self.walks = [
            _new_walk("drying", True, np.nan, len(suctions)),
            _new_walk("wetting", False, np.nan, len(suctions)),
        ]
        self.turned = [
            _new_walk(
                f"{'wetting' if wet else 'drying'} from {show(float(turn), 'Pa', 4)}", wet, float(turn), len(suctions)
            )
            for turn in turns
            for wet in (True, False)
        ]
        self.falls = bool(len(turns))
        self.done = 0
        self.porosity = np.nan

    def all(self) -> tuple[Walk, ...]:
        count = len(self.pairs.gap)
        everything, nothing = np.ones(count, bool), np.zeros(count, bool)
        members = {walk.name: self._turn(walk) for walk in self.turned}
        rising = [walk for walk in self.turned if not walk.starts_wet]
        falling = [walk for walk in self.turned if walk.starts_wet]
        members |= {"drying": everything}
        for k in range(len(self.suctions)):
            members["wetting"] = nothing
            on_the_way = [walk for walk in rising if self.suctions[k] >= walk.turns_at]
            self._visit(k, [*self.walks, *on_the_way], members)
        for k in range(len(self.suctions))[::-1]:
            on_the_way = [walk for walk in falling if self.suctions[k] <= walk.turns_at]
            if on_the_way:
                self._visit(k, on_the_way, members)
        return (*self.walks, *self.turned)

    def _turn(self, walk: Walk) -> Bools:
        """Pairs that hold a bridge where a path leaves its main branch."""
        chosen, members = self._members_at(walk.turns_at, np.full(len(self.pairs.gap), walk.starts_wet))[:2]
        full = np.zeros(len(chosen), bool)
        full[chosen] = members
        return full

    def _members_at(self, suction: float, before: Bools) -> tuple[Bools, Bools, Answers, Neighbours]:
        chosen = self.pairs.gap <= reach_of(self.setting, suction)
        near = self.pairs.taken(chosen)
        answers = answers_at(self.setting, near, "suction", np.array([suction]))
        return chosen, members_of(self.setting, near, answers, before[chosen]), answers, near

    def _visit(self, k: int, walks: Sequence[Walk], members: dict[str, Bools]) -> None:
        """One suction, for all paths that pass it."""
        suction = float(self.suctions[k])
        chosen, _, answers, near = self._members_at(suction, members[walks[0].name])
        chosen[chosen] = answers.exists
        near, answers = near.taken(answers.exists), answers.taken(answers.exists)
        answers = answers._replace(shape=geometry_of(self.setting, near, answers))
        last, told = np.zeros(0, bool), None
        for walk in walks:
            now = members_of(self.setting, near, answers, members[walk.name][chosen])
            full = np.zeros(len(chosen), bool)
            full[chosen] = now
            members[walk.name] = full
            if told is None or not np.array_equal(now, last):
                outcome = Outcome(near.taken(now), answers.taken(now), suction, 0.0, 0.0, 0.0)
                last, told = now, wetted_of(self.setting, outcome, False, None, is_checked=False)
            self._note(walk, k, told)
        self.done += 1
        if self.progress is not None:
            self.progress(min(1.0, self.done / (len(self.suctions) * (2 if self.falls else 1))))

    def _note(self, walk: Walk, k: int, w: Wet) -> None:
        self.porosity = w.porosity
        walk.stress[k] = w.stress
        for name in QUANTITIES:
            share = {"meeting_grains": "grains", "meeting_liquid": "liquid"}.get(name)
            walk.values[name][k] = getattr(w.meetings, share) if share else getattr(w, name)


def _name_of(starts_wet: bool, turn: float) -> str:
    """Name of a scanning curve."""
    return f"{'wetting' if starts_wet else 'drying'} from {show(turn, 'Pa', 4)}"


def _new_walk(name: str, starts_wet: bool, turns_at: float, count: int) -> Walk:
    values = {quantity: np.full(count, np.nan) for quantity in QUANTITIES}
    return Walk(name, starts_wet, turns_at, values, np.full((count, 3, 3), np.nan))


def _limit(setting: Setting, suctions: Floats, walk: Walk) -> float:
    """Suction below which bridges meet on a main branch, NaN if it is not between two of the suctions."""
    meets = walk.values["meeting_grains"] > 0.0
    if meets.all() or not meets.any():
        return np.nan
    last = int(np.flatnonzero(meets)[-1])
    return limit_between(setting, float(suctions[last]), float(suctions[last + 1]), walk.starts_wet)
