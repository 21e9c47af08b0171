"""What YADE makes of its tables: its interpolation, emulated as it is coded.

The law finds the two ratios about R2/R1, in each table the two blocks about D*, in each block the two rows about u*,
and is linear in all three. What it does not find counts as zeros, and zeros are mixed with what it does find.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...ground.check import broadcast, in_range, quantity
from .files import COLUMNS, Table

__all__ = ["YadeBridge", "interpolate", "interpolate_table", "rupture", "table_rupture", "tables_about", "yade_bridge"]

Floats = NDArray[np.float64]


class YadeBridge(NamedTuple):
    """A bridge as YADE's law reports it, SI units; all zeros where it has none."""

    force: Floats  # |fCap|, [N]
    volume: Floats  # vMeniscus, [m³]
    delta1: Floats  # Delta1, the larger of the two half-filling angles, at most 90, [degrees]
    delta2: Floats
    nn11: Floats  # [m²]
    nn33: Floats


def yade_bridge(
    tables: Sequence[Table],
    radius1: ArrayLike,
    radius2: ArrayLike,
    separation: ArrayLike,
    *,
    suction: ArrayLike,
    surface_tension: float,
) -> YadeBridge:
    r"""Bridge that `Law2_ScGeom_CapillaryPhys_Capillarity` finds in a set of tables.

    .. math:: F = 2\pi\gamma R_2\,F^*\!\left(\frac{R_2}{R_1}, \frac{D}{R_2}, \frac{u R_2}{\gamma}\right)

    Parameters
    ----------
    tables : sequence of Table
        The set, by ascending ratio from 1.
    radius1, radius2 : array_like
        Radii of the two spheres in any order, [m].
    separation : array_like
        D, [m]; an overlap counts as contact.
    suction : array_like
        u = p_gas - p_liquid, [Pa]; zero and less give no force, as in YADE.
    surface_tension : float
        γ, [N/m].

    Returns
    -------
    YadeBridge
        Arrays of the shape to which the arguments broadcast.

    Raises
    ------
    ValueError
        For bad input.

    Examples
    --------
    >>> rows = np.array([[0.0, 0.0, 0.2, 0.7, 40.0, 40.0, 0.1, 0.1], [0.0, 2.0, 0.1, 0.9, 30.0, 30.0, 0.1, 0.1]])
    >>> table = Table(1.0, (rows, rows + [0.1, 0, 0, 0, 0, 0, 0, 0]))
    >>> found = yade_bridge([table], 1.0, 1.0, [0.05, 0.2], suction=1.0, surface_tension=1.0)
    >>> (found.force / (2 * np.pi)).round(12)
    array([0.8, 0. ])
    """
    gamma = float(in_range("surface_tension", quantity("surface_tension", surface_tension, "N/m"), 0.0, brackets="()"))
    first, second, gap, held = broadcast(
        radius1=in_range("radius1", quantity("radius1", radius1, "m"), 0.0, brackets="()", unit="m"),
        radius2=in_range("radius2", quantity("radius2", radius2, "m"), 0.0, brackets="()", unit="m"),
        separation=quantity("separation", separation, "m"),
        suction=quantity("suction", suction, "Pa"),
    )
    large = np.maximum(first, second)
    ratio, gap_star, suction_star = (
        large / np.minimum(first, second),
        np.maximum(gap, 0.0) / large,
        held * large / gamma,
    )
    found = interpolate(tables, *map(np.ravel, (ratio, gap_star, suction_star))).reshape(*large.shape, -1)
    found[suction_star <= 0.0] = 0.0
    volume, force, delta1, delta2, nn11, nn33 = np.moveaxis(found[..., 2:], -1, 0)
    return YadeBridge(
        2.0 * np.pi * gamma * large * force,
        large**3 * volume,
        np.minimum(np.maximum(delta1, delta2), 90.0),
        np.minimum(delta1, delta2),
        large**2 * nn11,
        large**2 * nn33,
    )


def interpolate(tables: Sequence[Table], ratio: Floats, gap_star: Floats, suction_star: Floats) -> Floats:
    """Rows of `COLUMNS` between the tables, linear in the ratio; zeros above the last ratio.

    Parameters
    ----------
    tables : sequence of Table
        By ascending ratio.
    ratio, gap_star, suction_star : ndarray, shape (n,)
        R2/R1, D/R2 >= 0 and u R2/γ.

    Returns
    -------
    ndarray, shape (n, 8)
        The first two columns are interpolated like the others. NaN where YADE crashes.
    """
    result = np.zeros((len(ratio), len(COLUMNS)))
    first, weight = _between(np.array([table.ratio for table in tables]), ratio)
    for i in np.unique(first[first < len(tables)]):
        points = np.flatnonzero(first == i)
        asked = gap_star[points], suction_star[points]
        lower, upper = (interpolate_table(tables[k], *asked) for k in (max(i - 1, 0), i))
        result[points] = (1.0 - weight[points]) * lower + weight[points] * upper
    return result


def interpolate_table(table: Table, gap_star: Floats, suction_star: Floats) -> Floats:
    """Rows of `COLUMNS` from one table, linear in the gap; zeros above its last block.

    Parameters
    ----------
    table : Table
        In any order; what YADE makes of disorder is emulated too.
    gap_star, suction_star : ndarray, shape (n,)
        D/R2 and u R2/γ.

    Returns
    -------
    ndarray, shape (n, 8)
        NaN where YADE crashes, below the first block.
    """
    first, weight = _between(table.gaps, gap_star)
    count = len(table.blocks)
    lower, upper = (_in_blocks(table, np.clip(k, 0, count - 1), suction_star) for k in (first - 1, first))
    return np.where((first < count)[:, None], (1.0 - weight) * lower + weight * upper, 0.0)


def _between(nodes: Floats, at: Floats) -> tuple[NDArray[np.intp], Floats]:
    """First node not below each point, and its weight against the node before it: NaN below all nodes, 0 above."""
    first = np.searchsorted(np.maximum.accumulate(nodes), at, side="left")
    above = nodes[np.minimum(first, len(nodes) - 1)]
    below = np.where(first > 0, nodes[first - 1], np.nan)
    with np.errstate(invalid="ignore", divide="ignore"):
        weight = np.where(at == above, 1.0, (at - below) / (above - below))
    return first, np.where(first < len(nodes), weight, 0.0)[:, None]


def _in_blocks(table: Table, chosen: NDArray[np.intp], suction_star: Floats) -> Floats:
    """Rows between the rows of a block, one for each point; zeros above its last row.

    YADE takes the first row but the very first whose suction is not less, and is linear from the row before it: that
    extrapolates below the first.
    """
    rows = np.concatenate(table.blocks)
    ends = np.cumsum([len(block) for block in table.blocks])
    highest = np.concatenate([np.maximum.accumulate(np.append(-np.inf, block[1:, 1])) for block in table.blocks])
    low = ends[chosen] - np.array([len(block) for block in table.blocks])[chosen] + 1
    stop = high = ends[chosen]
    for _ in range(int(high.size and (high - low).max()).bit_length()):
        middle = (low + high) // 2
        is_below = (low < high) & (highest[np.minimum(middle, len(rows) - 1)] < suction_star)
        low, high = np.where(is_below, middle + 1, low), np.where(is_below | (low >= high), high, middle)
    upper = rows[np.minimum(low, len(rows) - 1)]
    lower = rows[low - 1]
    with np.errstate(invalid="ignore", divide="ignore"):
        weight = ((suction_star - lower[:, 1]) / (upper[:, 1] - lower[:, 1]))[:, None]
        between = np.where(suction_star[:, None] == upper[:, 1:2], upper, lower + weight * (upper - lower))
    return np.where((low < stop)[:, None], between, 0.0)


def table_rupture(table: Table, suction_star: Floats) -> Floats:
    """Gap D* at which a bridge that is drawn out breaks in YADE: where its volume first becomes zero.

    Parameters
    ----------
    table : Table
        Blocks of ascending gap.
    suction_star : ndarray, shape (n,)
        u R2/γ.

    Returns
    -------
    ndarray, shape (n,)
        A gap of a block, as a cell with one missing row ends at its upper block; 0 where there is nothing at contact.
    """
    holds = table.last_suctions[:, None] >= suction_star
    empty = ~(holds[:-1] | holds[1:])  # cells between two blocks without a row
    first = np.where(empty.any(axis=0), empty.argmax(axis=0), len(table.blocks) - 1)
    return np.where(holds[0], table.gaps[first], 0.0)


def tables_about(tables: Sequence[Table], ratio: float) -> Sequence[Table]:
    """Tables that YADE takes for a ratio: the one of that ratio, the two about it, or none above the last."""
    ratios = np.array([table.ratio for table in tables])
    i = int(np.searchsorted(ratios, ratio))
    is_node = i < len(tables) and ratios[i] == ratio
    return tables[i : i + 1] if is_node or i == len(tables) else tables[max(i - 1, 0) : i + 1]


def rupture(tables: Sequence[Table], ratio: float, suction_star: Floats) -> Floats:
    """Gap D* at which a bridge breaks in YADE; between two tables the one with the larger gap decides.

    Parameters
    ----------
    tables : sequence of Table
        By ascending ratio.
    ratio : float
        R2/R1.
    suction_star : ndarray, shape (n,)
        u R2/γ.

    Returns
    -------
    ndarray, shape (n,)
        0 above the last ratio.
    """
    gaps = [table_rupture(table, suction_star) for table in tables_about(tables, ratio)]
    return np.max(gaps, axis=0) if gaps else np.zeros(len(suction_star))
