"""What is known of many pairs at once: exactly, or from tables.

Force, volume and potential are found for all pairs, the whole geometry for those that hold a bridge.
"""

import math
import warnings
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ask.face import Bridge, bridge
from ..ask.pair import Pair
from ..ground.rows import element, entry, over_rows
from ..table import Table, ToleranceWarning, tabulate
from ..table.kernels import Grid, cell_of, find, gap_of, liquid_unit, q_of
from ..table.polynomial import in_three
from .neighbours import Neighbours
from .setting import Setting
from .shape import COLUMNS, LEAST_SUCTION, potential_of, shape_range

__all__ = ["Answers", "answers_at", "geometry_of", "uses_table"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Rows = NDArray[np.intp]
ControlName = Literal["suction", "volume"]

_CHUNK = 65536
_FEW = 20000  # pairs for which the exact answer costs less than a table
_MOST_TABLES = 12
_OCTAVES = 4  # the range of a table is a whole number of these, so that few tables serve many suctions
_USUAL = {"suction": (1.0, 256.0), "volume": (2.0**-24, 2.0**-8)}  # reduced control that any table covers
_LIMITS = {"suction": (1e-2, 1e8), "volume": (1e-9, 1.0)}
_RATIOS = (1.0, 1.25, 2.0, 4.0, 16.0, math.inf)  # of radii, up to which a table goes
_EQUAL = 1.0 + 1e-12


class Answers(NamedTuple):
    """Bridges between the bodies of pairs: the force is 0 and all else NaN where there is none."""

    control: ControlName  # what was held
    force: Floats  # (n,), [N]
    volume: Floats  # (n,), [m³]
    suction: Floats  # (n,), or (1,) for all, [Pa]
    potential: Floats  # (n,), grand potential; in an overlap it goes on with the force of contact, [J]
    shape: Floats | None  # (n, 7), columns of `shape`, if they are known already

    @property
    def exists(self) -> Bools:
        """Whether there is a bridge."""
        return np.asarray(self.force != 0.0)

    def taken(self, chosen: Rows | Bools) -> "Answers":
        """Some of the rows."""
        rows = np.flatnonzero(chosen) if chosen.dtype == np.bool_ else chosen
        if len(rows) == len(self.force) and chosen.dtype == np.bool_:
            return self
        return Answers(
            self.control,
            self.force[rows],
            self.volume[rows],
            self.suction if self.suction.size == 1 else self.suction[rows],
            self.potential[rows],
            None if self.shape is None else self.shape[rows],
        )


def uses_table(setting: Setting, rows: int) -> bool:
    """Whether so many pairs are answered from a table."""
    kinds = len(setting.angles)
    return setting.method == "table" or (
        setting.method == "auto" and rows > _FEW and kinds * (kinds + 1) // 2 <= _MOST_TABLES
    )


def answers_at(setting: Setting, near: Neighbours, control: ControlName, values: Floats) -> Answers:
    """Bridges at a suction or of a volume each; grains that overlap count as touching.

    Parameters
    ----------
    setting : Setting
        Liquid, angles, method.
    near : Neighbours
        The pairs.
    control : {"suction", "volume"}
        What is held.
    values : ndarray, (1,) or (n,)
        [Pa] or [m³].

    Returns
    -------
    Answers
    """
    rows = len(near.gap)
    if rows == 0 or not uses_table(setting, rows):
        return _exactly(setting, near, control, values)
    is_common = control == "suction" and values.size == 1
    suction = np.empty(0) if is_common else np.empty(rows)
    found = Answers(control, np.empty(rows), np.empty(rows), suction, np.empty(rows), None)
    rest = _from_tables(setting, near, control, values, found)
    if rest.size:
        few = _exactly(setting, near.taken(rest), control, values if values.size == 1 else values[rest])
        found.force[rest], found.volume[rest], found.potential[rest] = few.force, few.volume, few.potential
        if not is_common:
            found.suction[rest] = few.suction
    return found._replace(suction=values) if is_common else found


def geometry_of(setting: Setting, near: Neighbours, answers: Answers) -> Floats:
    """Columns of `shape` for pairs that hold a bridge, (n, 7)."""
    if answers.shape is not None:
        return answers.shape
    out = np.empty((len(near.gap), COLUMNS))
    over_rows(
        shape_range, len(out), _CHUNK,
        near.pairs, near.gap, setting.radii, setting.kind, np.cos(setting.angles), np.sin(setting.angles),
        answers.suction, answers.force, answers.volume, setting.liquid.surface_tension, out,
    )  # fmt: skip
    unsure = np.flatnonzero(~_is_sure(setting, near, answers.suction))
    if unsure.size:
        held = answers.suction if answers.control == "suction" else answers.volume
        few = _exactly(setting, near.taken(unsure), answers.control, held if held.size == 1 else held[unsure])
        out[unsure] = few.shape
    return out


def _is_sure(setting: Setting, near: Neighbours, suction: Floats) -> Bools:
    """Whether the force tells the half-filling angles."""
    least = LEAST_SUCTION * setting.liquid.surface_tension
    if float(suction.min(initial=math.inf)) * float(setting.heap.radii.min()) >= least:
        return np.ones(len(near.gap), bool)
    return np.asarray(suction * _radii(setting, near).min(axis=1) >= least)


def _radii(setting: Setting, near: Neighbours) -> Floats:
    return np.asarray(setting.radii[near.pairs])


def _exactly(setting: Setting, near: Neighbours, control: ControlName, values: Floats) -> Answers:
    """Answers of the exact solver."""
    rows = len(near.gap)
    force, volume, suction, potential = np.empty((4, rows))
    shape = np.empty((rows, COLUMNS))
    for start in range(0, rows, _CHUNK):
        part = slice(start, start + _CHUNK)
        radii, kinds = setting.radii[near.pairs[part]], setting.kind[near.pairs[part]]
        pair = Pair((radii[:, 0], radii[:, 1]), (setting.angles[kinds[:, 0]], setting.angles[kinds[:, 1]]))
        held = values if values.size == 1 else values[part]
        under, of = (held, None) if control == "suction" else (None, held)
        b = bridge(pair, np.maximum(near.gap[part], 0.0), suction=under, volume=of, liquid=setting.liquid)
        force[part], volume[part], suction[part], shape[part] = b.force, b.volume, b.suction, _columns_of(b)
        potential[part] = b.grand_potential + b.force * np.minimum(near.gap[part], 0.0)
    return Answers(control, force, volume, suction, potential, shape)


def _columns_of(b: Bridge) -> Floats:
    return np.column_stack([b.liquid_gas_area, b.half_filling_angle, b.wetted_area, b.capillary_tensor])


def _from_tables(setting: Setting, near: Neighbours, control: ControlName, values: Floats, found: Answers) -> Rows:
    """Fill what tables cover, and return the other rows."""
    heap, tension = setting.heap, setting.liquid.surface_tension
    small, large = float(heap.radii.min()), float(heap.radii.max())
    low, high = _LIMITS[control]
    everywhere = np.empty(0, np.intp)
    if control == "suction" and values.size == 1 and len(setting.angles) == 1 and not heap.walls:
        span = float(values[0]) * small / tension, float(values[0]) * large / tension
        if span[0] >= max(LEAST_SUCTION, low) and span[1] <= high:
            angle = float(setting.angles[0])
            table = _table_over((angle, angle), control, span, large / small)
            if table is not None:
                _ask(table, setting, near, values, everywhere, found)
                return everywhere
    radii = _radii(setting, near)
    smaller, larger = radii.min(axis=1), radii.max(axis=1)
    derjaguin = 2.0 / (1.0 / smaller + 1.0 / larger)
    reduced = values * derjaguin / tension if control == "suction" else values / derjaguin**3
    covered = (reduced >= low) & (reduced <= high)
    if control == "suction":
        covered &= values * smaller >= LEAST_SUCTION * tension
    kinds = setting.kind[near.pairs].astype(np.int64)
    group = 2 * (kinds.min(axis=1) * len(setting.angles) + kinds.max(axis=1)) + np.isinf(larger)
    for number in np.unique(group[covered]):
        rows = np.flatnonzero(covered & (group == number))
        ratio = float(np.max(larger[rows] / smaller[rows]))
        first, second = divmod(int(number) // 2, len(setting.angles))
        angles = float(setting.angles[first]), float(setting.angles[second])
        table = _table_over(angles, control, (float(reduced[rows].min()), float(reduced[rows].max())), ratio)
        if table is None:
            covered[rows] = False
        else:
            _ask(table, setting, near, values, rows, found)
    return np.flatnonzero(~covered)


def _ask(table: Table, setting: Setting, near: Neighbours, values: Floats, rows: Rows, found: Answers) -> None:
    """Fill rows from a table, all of them for an empty list."""
    over_rows(
        _table_range, rows.size or len(near.gap), _CHUNK,
        table.grid, *table.contact_angle, near.pairs, near.gap, setting.radii, setting.kind, setting.angles, rows,
        values, setting.liquid.surface_tension, found.force, found.volume, found.suction, found.potential,
    )  # fmt: skip


@entry(plain_cost=0.0001)
def _table_range(
    grid: Grid,
    angle1: float,
    angle2: float,
    pairs: NDArray[np.int32],
    gaps: Floats,
    radii: Floats,
    kind: NDArray[np.int32],
    angles: Floats,
    rows: Rows,
    values: Floats,
    tension: float,
    forces: Floats,
    volumes: Floats,
    suctions: Floats,
    potentials: Floats,
    start: int,
    stop: int,
) -> None:
    """Force, volume, suction and potential of the rows from start to stop."""
    cosines, sines = (math.cos(angle1), math.cos(angle2)), (math.sin(angle1), math.sin(angle2))
    for number in range(start, stop):
        row = rows[number] if rows.size else number
        i, j = pairs[row, 0], pairs[row, 1]
        if angle1 != angle2 and angles[kind[i]] == angle2:
            i, j = j, i
        held = element(values, row)
        pair, place, rupture, bend = find(grid, held, radii[i], radii[j], tension)
        forces[row], volumes[row], potentials[row] = 0.0, math.nan, math.nan
        if suctions.size:
            suctions[row] = math.nan
        if gap_of(gaps[row]) >= rupture:
            continue
        cell, t = cell_of(grid, place, q_of(gaps[row], rupture, bend))
        force = 2.0 * math.pi * tension * pair.radius * in_three(grid.force, cell, place.x, place.y, t)
        unit = liquid_unit(grid, pair.control, pair.radius, tension)
        other = unit * in_three(grid.liquid, cell, place.x, place.y, t)
        volume, suction = (held, other) if grid.is_volume else (other, held)
        forces[row], volumes[row] = force, volume
        if suctions.size:
            suctions[row] = suction
        potentials[row] = potential_of(gaps[row], suction, force, volume, radii[i], radii[j], cosines, sines, tension)


def _table_over(
    angles: tuple[float, float], control: ControlName, span: tuple[float, float], ratio: float
) -> Table | None:
    """Table that covers a range of the reduced control, of the usual size where that is enough; None if it fails."""
    low, high = min(span[0], _USUAL[control][0]), max(span[1], _USUAL[control][1])
    ends = math.floor(math.log2(low) / _OCTAVES), math.ceil(math.log2(high) / _OCTAVES)
    if math.isinf(ratio):
        ratios = (math.inf, math.inf)
    else:
        ratios = (1.0, next(limit for limit in _RATIOS if ratio <= limit * _EQUAL))
    return _table_of(angles, control, ends, ratios)


@lru_cache(maxsize=32)
def _table_of(
    angles: tuple[float, float], control: ControlName, ends: tuple[int, int], ratios: tuple[float, float]
) -> Table | None:
    """Table, made once and kept; none where bridges slide to one side or are too large, as some volumes do."""
    low, high = _LIMITS[control]
    reduced = max(low, 2.0 ** (_OCTAVES * ends[0])), min(high, 2.0 ** (_OCTAVES * ends[1]))
    with warnings.catch_warnings():
        warnings.simplefilter("error", ToleranceWarning)
        try:
            return tabulate(angles, control, reduced=reduced, radius_ratio=ratios)
        except (ToleranceWarning, ValueError):
            if control == "suction":
                raise
            return None
