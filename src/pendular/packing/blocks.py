"""Heaps beyond one machine's memory: blocks of grains with a halo, worked on one by one or by Dask.

A block answers for the grains that lie in it and for the bridges of which the grain with the smaller number does. It
sees the grains around it that a bridge can reach. What blocks add up is what one block of all grains
gives, to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ask.liquid import Liquid
from ..ground.check import in_range, instance, one_of, scalar, whole_number
from .answers import answers_at, geometry_of
from .heap import Packing
from .history import members_of
from .meetings import mark_meetings
from .neighbours import arms_of, reach_table, within
from .setting import reach_at, setting_of
from .shape import AREA, FILLING_1, FILLING_2
from .solids import check_overlaps, solid_volume_of
from .stress import stress_sum

__all__ = ["Part", "Totals", "wet_in_blocks"]

Floats = NDArray[np.float64]
Source = Callable[[Floats, Floats], tuple[Floats, Floats, NDArray[np.int64]]]


class Part(NamedTuple):
    """Sums over a block."""

    grains: int
    bridges: int
    liquid: float  # [m³]
    area: float  # [m²]
    stress: Floats  # Σ F l n ⊗ n, (3, 3), [J]
    solid: float  # [m³]
    meeting_grains: int
    ends: int  # of bridges on its grains


@dataclass(frozen=True)
class Totals:
    """A wetted heap without its bridges one by one."""

    grains: int
    bridges: int
    liquid_volume: float  # [m³]
    saturation: float
    water_content: float
    porosity: float
    stress: Floats  # (3, 3), tension positive, [Pa]
    suction: float  # [Pa]
    interface_area: float  # [1/m]
    coordination: float
    meeting_grains: float  # share of grains on which bridges meet

    @property
    def suction_stress(self) -> float:
        """Mean extra pressure on the grains, [Pa]."""
        return float(np.trace(self.stress)) / 3.0

    @property
    def chi(self) -> float:
        """Suction stress over suction."""
        return self.suction_stress / self.suction


def wet_in_blocks(
    source: Packing | Source,
    contact_angle: float,
    *,
    suction: float,
    liquid: Liquid,
    blocks: tuple[int, int, int],
    cell: Floats | None = None,
    radius_range: tuple[float, float] | None = None,
    path: Literal["drying", "wetting"] = "drying",
    formation_distance: float = 0.0,
    condensation: bool = True,
    method: Literal["auto", "exact", "table"] = "auto",
    client: Any = None,
) -> Totals:
    """Wet a heap block by block, in memory that does not grow with the heap.

    Parameters
    ----------
    source : Packing or callable
        The grains in an upright cell that is periodic in all directions. A function is asked with the lower and the
        upper corner of a box, [m], (3,) each, and returns centres, radii and numbers of the grains that lie in it,
        from the lower corner on and up to the upper one without it.
    contact_angle : float
        On all grains, [rad].
    suction : float
        [Pa], > 0.
    liquid : Liquid
        Surface tension.
    blocks : three int
        Along each direction; each block is at least twice as wide as its halo, the reach of a bridge.
    cell, radius_range : array_like, (3,) and (2,)
        Lengths of the cell, and smallest and largest radius, [m], where the source is a function.
    path, formation_distance, condensation, method
        As for :func:`wet`.
    client : distributed.Client, optional
        Workers to share the blocks; else they are worked on here, one after another.

    Returns
    -------
    Totals
        Record of grains, bridges, liquid_volume, saturation, water_content, porosity, stress, suction, interface_area,
        coordination, meeting_grains, suction_stress and chi, as those of :class:`Wet`.

    Raises
    ------
    ValueError
        For bad input, blocks that are narrower than the halo, walls or a cell that is not upright and periodic.

    Examples
    --------
    >>> import pendular as pl
    >>> heap = pl.Packing([(0, 0, 0)], 1.0, cell=(2, 2, 2)).repeated((8, 8, 8))
    >>> total = wet_in_blocks(heap, 0.0, suction=100.0, liquid=pl.Liquid(surface_tension=1.0), blocks=(2, 2, 2))
    >>> f"{total.saturation:.5e} {total.suction_stress:.5f}"
    '3.51444e-04 1.48916'
    """
    one_of("path", path, ("drying", "wetting"))
    asked = in_range("suction", scalar("suction", suction, "Pa"), 0.0, brackets="(]", unit="Pa")
    if not isinstance(blocks, tuple | list) or len(blocks) != 3:
        raise ValueError(f"blocks: {blocks!r} is not three numbers")
    counts = np.array([whole_number("blocks", count, 1) for count in blocks])
    lengths, sizes, ask = _source_of(source, cell, radius_range)
    rules = {"formation_distance": formation_distance, "condensation": condensation, "method": method}
    extremes = Packing(np.array([(0.0, 0.0, 0.0), (9.0 * sizes[1], 0.0, 0.0)]), np.array(sizes))
    setting = setting_of(extremes, contact_angle, liquid, formation_distance, condensation, method)
    reach = 2.0 * sizes[1] + reach_table(extremes, reach_at(setting, "suction", asked)).most
    width = lengths / counts
    for k in range(3):
        if width[k] < 2.0 * reach:
            raise ValueError(
                f"blocks: {counts[k]} along direction {k} are narrower than twice their halo of {reach:.3g} m"
            )
    task = _Task(lengths, width, counts, reach, contact_angle, asked, liquid, path == "drying", rules, ask)
    corners = list(product(*(range(count) for count in counts)))
    if client is None:
        parts: Iterator[Part] = (_part_of(task, corner) for corner in corners)
    else:
        parts = (future.result() for future in _submitted(client, task, corners))
    return _added(parts, task)


class _Task(NamedTuple):
    """What all blocks share."""

    lengths: Floats
    width: Floats
    counts: NDArray[np.int64]
    reach: float  # between centres of grains that hold a bridge
    angle: float
    suction: float
    liquid: Liquid
    is_drying: bool
    rules: dict[str, Any]
    ask: Source


def _source_of(source: Packing | Source, cell: Any, radius_range: Any) -> tuple[Floats, tuple[float, float], Source]:
    """Lengths of the cell, smallest and largest radius, and the grains of a box."""
    if callable(source):
        if cell is None or radius_range is None:
            raise ValueError("source: a function needs cell and radius_range beside it")
        return np.asarray(cell, float), (float(radius_range[0]), float(radius_range[1])), source
    instance("source", source, Packing)
    cell = source.box
    if (
        source.cell is None
        or np.count_nonzero(cell - np.diag(np.diag(cell)))
        or not source.periodic.all()
        or source.walls
    ):
        raise ValueError("source: the cell is not upright and periodic in all directions, without walls")
    lengths = np.diag(cell)
    inside = source.positions - np.floor(source.positions / lengths) * lengths
    numbers = np.arange(source.count)

    def grains_in(low: Floats, high: Floats) -> tuple[Floats, Floats, NDArray[np.int64]]:
        chosen = np.flatnonzero(np.all((inside >= low) & (inside < high), axis=1))
        return inside[chosen], source.radii[chosen], numbers[chosen]

    return lengths, (float(source.radii.min()), float(source.radii.max())), grains_in


def _submitted(client: Any, task: _Task, corners: list[tuple[int, ...]]) -> Iterator[Any]:
    """Results of the blocks, with no more than a few of them under way for each worker."""
    waiting: list[Any] = []
    at_once = 2 * max(1, len(client.scheduler_info()["workers"]))
    shared = client.scatter(task, broadcast=True)
    for corner in corners:
        waiting.append(client.submit(_part_of, shared, corner, pure=False))
        if len(waiting) >= at_once:
            yield waiting.pop(0)
    yield from waiting


def _halo(task: _Task, corner: tuple[int, ...]) -> tuple[Floats, Floats, NDArray[np.int64], NDArray[np.bool_]]:
    """Grains of a block and around it: centres beside each other, radii, numbers, and which lie in the block."""
    low, high = np.array(corner) * task.width, (np.array(corner) + 1) * task.width
    high = np.where(np.array(corner) + 1 == task.counts, task.lengths, high)
    margin = task.reach
    found: list[tuple[Floats, Floats, NDArray[np.int64], NDArray[np.bool_]]] = []
    spans = [_spans(low[k], high[k], margin, task.lengths[k], task.counts[k] == 1) for k in range(3)]
    for choice in product(*spans):
        start, stop, shift = (np.array(values) for values in zip(*choice, strict=True))
        centres, radii, numbers = task.ask(start, stop)
        is_own = np.full(len(radii), bool(np.all(shift == 0.0)))
        is_own &= np.all((centres >= low) & (centres < high), axis=1)
        found.append((centres + shift, radii, numbers, is_own))
    centres, radii, numbers, is_own = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return centres, radii, numbers, is_own


def _spans(low: float, high: float, margin: float, length: float, is_alone: bool) -> list[tuple[float, float, float]]:
    """Parts of a cell within a margin of a block: from, to, and by how much they are moved to lie beside it."""
    if is_alone:
        return [(0.0, length, 0.0), (length - margin, length, -length), (0.0, margin, length)]
    start, stop = low - margin, high + margin
    spans = [(max(start, 0.0), min(stop, length), 0.0)]
    if start < 0.0:
        spans.append((start + length, length, -length))
    if stop > length:
        spans.append((0.0, stop - length, length))
    return spans


def _part_of(task: _Task, corner: tuple[int, ...]) -> Part:
    """Sums over one block."""
    centres, radii, numbers, is_own = _halo(task, corner)
    if not is_own.any():
        return Part(0, 0, 0.0, 0.0, np.zeros((3, 3)), 0.0, 0, 0)
    heap = Packing(centres, radii)
    setting = setting_of(heap, task.angle, task.liquid, **task.rules)
    near = within(heap, reach_table(heap, reach_at(setting, "suction", task.suction)))
    near = near.taken(is_own[near.pairs[:, 0]] | is_own[near.pairs[:, 1]])
    answers = answers_at(setting, near, "suction", np.array([task.suction]))
    check_overlaps(heap, near)
    members = members_of(setting, near, answers, task.is_drying)
    counted = is_own[_lower(near.pairs, numbers)]
    solid = 4.0 / 3.0 * math.pi * float(np.sum(radii[is_own] ** 3))
    lenses = solid_volume_of(heap, near.taken(counted)) - 4.0 / 3.0 * math.pi * float(np.sum(radii**3))
    held, answers, counted = near.taken(members), answers.taken(members), counted[members]
    shape = geometry_of(setting, held, answers)
    normals, lengths = arms_of(heap, held)
    count, _ = mark_meetings(heap.count, held.pairs, normals, shape[:, FILLING_1 : FILLING_2 + 1])
    return Part(
        int(np.count_nonzero(is_own)),
        int(np.count_nonzero(counted)),
        float(np.sum(answers.volume[counted])),
        float(np.sum(shape[counted, AREA])),
        stress_sum(answers.force[counted], normals[counted], lengths[counted]),
        solid + lenses,
        int(np.count_nonzero(count[is_own])),
        int(np.count_nonzero(is_own[held.pairs])),
    )


def _lower(pairs: NDArray[np.int32], numbers: NDArray[np.int64]) -> NDArray[np.int32]:
    """Grain of each pair that has the smaller number in the whole heap."""
    first, second = pairs.T
    return np.where(numbers[first] < numbers[second], first, second)


def _added(parts: Iterator[Part], task: _Task) -> Totals:
    total = Part(0, 0, 0.0, 0.0, np.zeros((3, 3)), 0.0, 0, 0)
    for part in parts:
        sums: list[Any] = [mine + theirs for mine, theirs in zip(list[Any](total), part, strict=True)]
        total = Part(*sums)
    volume = float(np.prod(task.lengths))
    pores = volume - total.solid
    return Totals(
        total.grains,
        total.bridges,
        total.liquid,
        total.liquid / pores,
        total.liquid / volume,
        pores / volume,
        total.stress / volume,
        task.suction,
        total.area / volume,
        total.ends / max(1, total.grains),
        total.meeting_grains / max(1, total.grains),
    )
