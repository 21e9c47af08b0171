"""Heaps beyond one machine's memory: blocks of grains with a halo, worked on one by one or by Dask.

A block answers for the grains that lie in it and for the bridges of which the grain with the smaller number does. It
sees the grains around it that a bridge can reach. What blocks add up is what one block of all grains
gives, to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.face import bridge
from ..ask.liquid import Liquid
from ..ask.pair import Pair
from ..ground.check import angle, in_range, instance, one_of, quantity, scalar, whole_number
from .answers import answers_at, geometry_of
from .heap import Packing, Wall, cell_of, periodic_of, wall_of
from .history import members_of
from .meetings import mark_meetings
from .neighbours import arms_of, reach_table, within
from .setting import Setting, reach_at, setting_of
from .shape import AREA
from .solids import check_overlaps, solid_volume_of
from .stress import stress_sum

__all__ = ["Part", "Totals", "wet_in_blocks"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
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
    contact_angle: ArrayLike,
    *,
    suction: float,
    liquid: Liquid,
    blocks: tuple[int, int, int],
    cell: Floats | None = None,
    periodic: bool | Sequence[bool] = True,
    walls: Sequence[Wall] = (),
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
        The grains, in an upright cell or in none. A function is asked with the lower and the upper corner of a box,
        [m], (3,) each, and returns centres, radii and numbers of the grains that lie in it, from the lower corner on
        and up to the upper one without it. Along directions that do not repeat the outermost boxes have no end.
    contact_angle : float or array_like, (grains + walls,)
        On all bodies, or on each grain by its number and then each wall, [rad].
    suction : float
        [Pa], > 0.
    liquid : Liquid
        Surface tension.
    blocks : three int
        Along each direction; each block is at least twice as wide as its halo, the reach of a bridge.
    cell, periodic, walls, radius_range : optional
        Where the source is a function: lengths of the cell, [m], (3,), the directions that repeat, the walls, and the
        smallest and the largest radius, [m].
    path, formation_distance, condensation, method
        As for :func:`wet`; ``"auto"`` decides for each block.
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
        For bad input, blocks that are narrower than the halo, or a cell that is not upright.

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
    frame = _frame_of(source, cell, periodic, walls, radius_range)
    angles = _angles_of(source, frame, contact_angle)
    one = Packing(np.zeros((1, 3)), np.array(frame.largest))
    setting = setting_of(one, float(angles.flat[0]), liquid, formation_distance, condensation, method)
    margin = _halo_width(setting._replace(angles=np.unique(angles)), asked, bool(frame.walls))
    width = frame.lengths / counts
    for k in range(3):
        if (frame.periodic[k] or counts[k] > 1) and width[k] < 2.0 * margin:
            raise ValueError(
                f"blocks: {counts[k]} along direction {k} are narrower than twice their halo of {margin:.3g} m"
            )
    rules = {"formation_distance": formation_distance, "condensation": condensation, "method": method}
    task = _Task(frame, width, counts, margin, angles, asked, liquid, path == "drying", rules)
    corners = list(product(*(range(count) for count in counts)))
    if client is None:
        parts: Iterator[Part] = (_part_of(task, corner) for corner in corners)
    else:
        parts = (future.result() for future in _submitted(client, task, corners))
    return _added(parts, task)


class _Frame(NamedTuple):
    """Where the grains are."""

    origin: Floats
    lengths: Floats  # of the cell, or of the box around the grains
    periodic: Bools
    walls: tuple[Wall, ...]
    largest: float  # radius
    ask: Source


class _Task(NamedTuple):
    """What all blocks share."""

    frame: _Frame
    width: Floats
    counts: NDArray[np.int64]
    margin: float  # of the halo
    angles: Floats  # one, or of each grain and then each wall
    suction: float
    liquid: Liquid
    is_drying: bool
    rules: dict[str, Any]


def _frame_of(source: Packing | Source, cell: Any, periodic: Any, walls: Any, radius_range: Any) -> _Frame:
    if callable(source):
        if cell is None or radius_range is None:
            raise ValueError("source: a function needs cell and radius_range beside it")
        box, repeats = cell_of(cell), periodic_of(periodic)
        planes = tuple(wall_of(i, wall, box, repeats) for i, wall in enumerate(walls))
        largest = float(np.max(in_range("radius_range", quantity("radius_range", radius_range, "m"), 0.0, unit="m")))
        return _Frame(np.zeros(3), _lengths_of(box), repeats, planes, largest, source)
    instance("source", source, Packing)
    given = {"cell": cell, "radius_range": radius_range, "walls": walls or None}
    for name, value in given.items():
        if value is not None:
            raise ValueError(f"{name}: has no effect beside a Packing, which has its own")
    lengths, radii = _lengths_of(source.box), source.radii
    origin = np.zeros(3) if source.cell is not None else (source.positions - radii[:, None]).min(axis=0)
    inside = source.positions - np.where(source.periodic, np.floor(source.positions / lengths) * lengths, 0.0)
    inside = np.where(source.periodic & (inside >= lengths), 0.0, inside)  # by rounding
    numbers = np.arange(source.count)

    def grains_in(low: Floats, high: Floats) -> tuple[Floats, Floats, NDArray[np.int64]]:
        chosen = np.flatnonzero(np.all((inside >= low) & (inside < high), axis=1))
        return inside[chosen], radii[chosen], numbers[chosen]

    return _Frame(origin, lengths, source.periodic, source.walls, float(radii.max()), grains_in)


def _lengths_of(box: Floats) -> Floats:
    lengths = np.diag(box)
    if np.count_nonzero(box - np.diag(lengths)) or np.any(lengths <= 0.0):
        raise ValueError("cell: it is not upright, as blocks need it")
    return lengths


def _angles_of(source: Packing | Source, frame: _Frame, contact_angle: ArrayLike) -> Floats:
    """Contact angle of all bodies, or of each grain and then each wall."""
    angles = angle("contact_angle", contact_angle)
    grains = len(angles) - len(frame.walls) if angles.ndim == 1 else 0
    if angles.ndim == 0 or (grains > 0 and grains == (grains if callable(source) else source.count)):
        return angles
    walls = f" and {len(frame.walls)} walls" if frame.walls else ""
    raise ValueError(
        f"contact_angle: an array of shape {angles.shape} is not one angle nor one for each of the grains{walls}"
    )


def _halo_width(setting: Setting, suction: float, has_walls: bool) -> float:
    """Largest distance between centres of grains that hold a bridge, or whose bridges meet on a wall."""
    radius = setting.heap.radii
    margin = float(2.0 * radius[0] + reach_at(setting, "suction", suction)(radius, radius)[0])
    if has_walls:
        angles = np.unique(np.quantile(setting.angles, (0.0, 0.5, 1.0)))
        pairs = Pair((radius[0], np.inf), (angles, angles[:, None]))
        circle = bridge(pairs, 0.0, suction=suction, liquid=setting.liquid).contact_radius
        margin = max(margin, 2.1 * float(np.nan_to_num(circle[..., 1]).max()))
    return margin


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


def _halo(task: _Task, corner: tuple[int, ...]) -> tuple[Floats, Floats, NDArray[np.int64], Bools]:
    """Grains of a block and around it: centres beside each other, radii, numbers, and which lie in the block."""
    frame, place = task.frame, np.array(corner)
    low = frame.origin + place * task.width
    high = np.where(place + 1 == task.counts, frame.origin + frame.lengths, low + task.width)
    low = np.where(~frame.periodic & (place == 0), -np.inf, low)
    high = np.where(~frame.periodic & (place + 1 == task.counts), np.inf, high)
    found: list[tuple[Floats, Floats, NDArray[np.int64], Bools]] = []
    spans = [_spans(task, k, low[k], high[k]) for k in range(3)]
    for choice in product(*spans):
        start, stop, shift = (np.array(values) for values in zip(*choice, strict=True))
        centres, radii, numbers = frame.ask(start, stop)
        is_own = np.full(len(radii), bool(np.all(shift == 0.0)))
        is_own &= np.all((centres >= low) & (centres < high), axis=1)
        found.append((centres + shift, radii, numbers, is_own))
    centres, radii, numbers, is_own = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return centres, radii, numbers, is_own


def _spans(task: _Task, k: int, low: float, high: float) -> list[tuple[float, float, float]]:
    """Parts of the heap within the halo of a block: from, to, and by how much they are moved to lie beside it."""
    margin, length = task.margin, float(task.frame.lengths[k])
    if not task.frame.periodic[k]:
        return [(low - margin, high + margin, 0.0)]
    if task.counts[k] == 1:
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
    walls = task.frame.walls
    heap = Packing(centres, radii, walls=walls)
    setting = setting_of(heap, _angles_in(task, numbers), task.liquid, **task.rules)
    near = within(heap, reach_table(heap, reach_at(setting, "suction", task.suction)))
    is_own = np.concatenate([is_own, np.zeros(len(walls), bool)])  # of all bodies now
    is_at_wall = near.pairs[:, 1] >= heap.count
    near = near.taken(is_own[near.pairs].any(axis=1) | is_at_wall)
    answers = answers_at(setting, near, "suction", np.array([task.suction]))
    check_overlaps(heap, near, numbers)
    members = members_of(setting, near, answers, task.is_drying)
    counted = is_own[_lower(near.pairs, numbers)]
    solid = 4.0 / 3.0 * math.pi * float(np.sum(radii[is_own[: heap.count]] ** 3))
    lenses = solid_volume_of(heap, near.taken(counted)) - 4.0 / 3.0 * math.pi * float(np.sum(radii**3))
    held, answers, counted = near.taken(members), answers.taken(members), counted[members]
    shape = geometry_of(setting, held, answers)
    normals, lengths = arms_of(heap, held)
    marks = mark_meetings(heap, held, normals, shape)
    return Part(
        int(np.count_nonzero(is_own)),
        int(np.count_nonzero(counted)),
        float(np.sum(answers.volume[counted])),
        float(np.sum(shape[counted, AREA])),
        stress_sum(answers.force[counted], normals[counted], lengths[counted]),
        solid + lenses,
        int(np.count_nonzero(marks.grains & is_own[: heap.count])),
        int(np.count_nonzero(is_own[held.pairs])),
    )


def _angles_in(task: _Task, numbers: NDArray[np.int64]) -> Floats:
    """Contact angles of grains by their numbers in the whole heap, and of the walls."""
    if task.angles.ndim == 0:
        return task.angles
    grains = len(task.angles) - len(task.frame.walls)
    if int(numbers.max()) >= grains:
        raise ValueError(
            f"contact_angle: none for grain {int(numbers.max())}, the last of {grains} is grain {grains - 1}"
        )
    return np.concatenate([task.angles[numbers], task.angles[grains:]])


def _lower(pairs: NDArray[np.int32], numbers: NDArray[np.int64]) -> NDArray[np.int32]:
    """Grain of each pair that has the smaller number in the whole heap."""
    first, second = pairs.T
    grains = len(numbers)
    return np.where((second >= grains) | (numbers[first] < numbers[np.minimum(second, grains - 1)]), first, second)


def _added(parts: Iterator[Part], task: _Task) -> Totals:
    total = Part(0, 0, 0.0, 0.0, np.zeros((3, 3)), 0.0, 0, 0)
    for part in parts:
        sums: list[Any] = [mine + theirs for mine, theirs in zip(list[Any](total), part, strict=True)]
        total = Part(*sums)
    volume = float(np.prod(task.frame.lengths))
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
