"""What is known of many pairs at once: exactly, or from tables."""

import math
from functools import lru_cache
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._jit import in_chunks
from ..bridges import bridge
from ..pair import Pair
from ..table import Table, tabulate
from .setting import Setting
from .shape import AREA, COLUMNS, LEAST_SUCTION, POTENTIAL, shape_range

__all__ = ["Answers", "Ends", "answers_at", "ends_of", "uses_table"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
ControlName = Literal["suction", "volume"]

_CHUNK = 65536
_FEW = 20000  # pairs for which the exact answer costs less than a table
_MOST_TABLES = 12
_OCTAVES = 4  # the range of a table is a whole number of these, so that few tables serve many suctions
_USUAL = {"suction": (1.0, 256.0), "volume": (2.0**-24, 2.0**-8)}  # reduced control that any table covers
_LIMITS = {"suction": (1e-2, 1e8), "volume": (1e-9, 1.0)}
_RATIOS = (1.0, 1.25, 2.0, 4.0, 16.0, math.inf)  # of radii, up to which a table goes
_EQUAL = 1.0 + 1e-12
_SWAPPED = [0, 2, 1, 4, 3, 5, 6, 7]  # columns of a shape with its solids exchanged


class Ends(NamedTuple):
    """Two bodies a row, and the gap between them."""

    gap: Floats  # [m], negative in an overlap
    radius1: Floats
    radius2: Floats
    kind1: NDArray[np.int32]
    kind2: NDArray[np.int32]

    def taken(self, chosen: NDArray[np.intp] | Bools) -> "Ends":
        """Some of the rows."""
        gap, radius1, radius2 = (part[chosen] for part in self[:3])
        return Ends(gap, radius1, radius2, self.kind1[chosen], self.kind2[chosen])


class Answers(NamedTuple):
    """Bridges between the bodies: the force is 0 and all else NaN where there is none."""

    force: Floats  # [N]
    volume: Floats  # [m³]
    suction: Floats  # [Pa]
    shape: Floats  # (n, 8), columns of `shape`

    @property
    def exists(self) -> Bools:
        """Whether there is a bridge."""
        return np.asarray(self.force != 0.0)

    def taken(self, chosen: NDArray[np.intp] | Bools) -> "Answers":
        """Some of the rows."""
        return Answers(*(part[chosen] for part in self))


def ends_of(setting: Setting, pairs: NDArray[np.int32], gap: Floats) -> Ends:
    """Bodies of pairs."""
    radii = setting.radii
    first, second = pairs.T
    return Ends(gap, radii[first], radii[second], setting.kind[first], setting.kind[second])


def uses_table(setting: Setting, rows: int) -> bool:
    """Whether so many pairs are answered from a table."""
    kinds = len(setting.angles)
    return setting.method == "table" or (
        setting.method == "auto" and rows > _FEW and kinds * (kinds + 1) // 2 <= _MOST_TABLES
    )


def answers_at(setting: Setting, ends: Ends, control: ControlName, values: Floats) -> Answers:
    """Bridges at a suction or of a volume each; grains that overlap count as touching.

    Parameters
    ----------
    setting : Setting
        Liquid, angles, method.
    ends : Ends
        The pairs.
    control : {"suction", "volume"}
        What is held.
    values : ndarray, (1,) or (n,)
        [Pa] or [m³].

    Returns
    -------
    Answers
    """
    rows = len(ends.gap)
    found = Answers(np.zeros(rows), np.full(rows, np.nan), np.full(rows, np.nan), np.full((rows, COLUMNS), np.nan))
    if rows == 0:
        return found
    by_table = np.zeros(rows, bool)
    if uses_table(setting, rows):
        by_table = _from_tables(setting, ends, control, values, found)
    rest = np.flatnonzero(~by_table)
    for start in range(0, len(rest), _CHUNK):
        _exactly(setting, ends, control, values, rest[start : start + _CHUNK], found)
    overlap = np.minimum(ends.gap, 0.0)
    found.shape[:, POTENTIAL] += found.force * overlap  # so that the force is its rate
    return found


def _exactly(
    setting: Setting, ends: Ends, control: ControlName, values: Floats, rows: NDArray[np.intp], found: Answers
) -> None:
    """Fill rows by the exact solver."""
    part = ends.taken(rows)
    pair = Pair((part.radius1, part.radius2), (setting.angles[part.kind1], setting.angles[part.kind2]))
    held = values if values.size == 1 else values[rows]
    suction, volume = (held, None) if control == "suction" else (None, held)
    b = bridge(pair, np.maximum(part.gap, 0.0), suction=suction, volume=volume, liquid=setting.liquid)
    found.force[rows], found.volume[rows], found.suction[rows] = b.force, b.volume, b.suction
    found.shape[rows, AREA], found.shape[rows, POTENTIAL] = b.liquid_gas_area, b.grand_potential
    found.shape[rows, 1:3], found.shape[rows, 3:5], found.shape[rows, 5:7] = (
        b.half_filling_angle,
        b.wetted_area,
        b.capillary_tensor,
    )


def _from_tables(setting: Setting, ends: Ends, control: ControlName, values: Floats, found: Answers) -> Bools:
    """Fill what tables cover, and tell which rows these are."""
    small = np.minimum(ends.radius1, ends.radius2)
    large = np.maximum(ends.radius1, ends.radius2)
    derjaguin = 2.0 / (1.0 / small + 1.0 / large)
    tension = setting.liquid.surface_tension
    reduced = values * derjaguin / tension if control == "suction" else values / derjaguin**3
    low, high = _LIMITS[control]
    covered = (reduced >= low) & (reduced <= high)
    if control == "suction":
        covered &= values * small >= LEAST_SUCTION * tension
    group = np.minimum(ends.kind1, ends.kind2) * len(setting.angles) + np.maximum(ends.kind1, ends.kind2)
    group = 2 * group + np.isinf(large)
    for number in np.unique(group[covered]):
        chosen = covered & (group == number)
        rows = np.flatnonzero(chosen)
        part = ends.taken(rows)
        ratio = float(np.max(large[rows] / small[rows]))
        span = float(reduced[rows].min()), float(reduced[rows].max())
        kinds = divmod(int(number) // 2, len(setting.angles))
        angles = float(setting.angles[kinds[0]]), float(setting.angles[kinds[1]])
        table = _table_over(angles, control, span, ratio)
        held = values if values.size == 1 else values[rows]
        _ask(table, part, part.kind1 > part.kind2, held, tension, rows, found)
    if control == "volume":
        unsure = covered & found.exists & ~(found.suction * small >= LEAST_SUCTION * tension)
        covered &= ~unsure
    return covered


def _ask(
    table: Table, part: Ends, swapped: Bools, held: Floats, tension: float, rows: NDArray[np.intp], found: Answers
) -> None:
    """Fill rows from a table and the geometry that follows."""
    radius1 = np.where(swapped, part.radius2, part.radius1)
    radius2 = np.where(swapped, part.radius1, part.radius2)
    gap = np.maximum(part.gap, 0.0)
    asked = (gap, held, radius1, radius2, tension)
    force = table.force(*asked)
    other = table.volume(*asked) if table.control == "suction" else table.suction(*asked)
    suction, volume = (held, other) if table.control == "suction" else (other, np.broadcast_to(held, other.shape))
    exists = force != 0.0
    shape = np.empty((len(rows), COLUMNS))
    arrays = tuple(np.ascontiguousarray(each) for each in (gap, suction, force, volume, radius1, radius2))
    in_chunks(shape_range, len(rows), _CHUNK, *arrays, *table.contact_angle, tension, shape)
    if swapped.any():
        shape[swapped] = shape[swapped][:, _SWAPPED]
    shape[~exists] = np.nan
    found.force[rows], found.shape[rows] = force, shape
    found.volume[rows] = np.where(exists, volume, np.nan)
    found.suction[rows] = np.where(exists, suction, np.nan)


def _table_over(angles: tuple[float, float], control: ControlName, span: tuple[float, float], ratio: float) -> Table:
    """A table that covers a range of the reduced control, of the usual size where that is enough."""
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
) -> Table:
    """A table, made once and kept."""
    low, high = _LIMITS[control]
    reduced = max(low, 2.0 ** (_OCTAVES * ends[0])), min(high, 2.0 ** (_OCTAVES * ends[1]))
    return tabulate(angles, control, reduced=reduced, radius_ratio=ratios)
