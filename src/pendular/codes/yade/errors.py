"""Errors that YADE makes with tables: against the exact solution, between the rows and at rupture."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import reader
from .exact import exact_rows, exact_rupture
from .files import Table
from .tables import REACH

__all__ = ["Errors", "RuptureErrors", "measure", "measure_rupture", "measure_to", "row_errors"]

Floats = NDArray[np.float64]

_SUCTIONS, _FRACTIONS, _RUPTURES = 120, 81, 400  # points at which the errors in YADE are measured
_LEAST_SUCTION = 1e-3
_DIGIT = 1e-9  # beside the end of a block, where the rupture gap in YADE jumps


class Errors(NamedTuple):
    """Largest errors of a set of bridges, over the values at contact at the same suction."""

    volume: float
    force: float
    delta1: float  # [degrees]
    delta2: float
    nn11: float  # over the liquid-gas area
    nn33: float


class RuptureErrors(NamedTuple):
    """Relative errors of the gap at which YADE breaks a bridge: the most negative and the most positive."""

    low: float
    high: float

    @property
    def largest(self) -> float:
        """The larger magnitude of the two."""
        return max(abs(self.low), abs(self.high))


def measure(tables: Sequence[Table], ratio: float, contact_angle: float, reach: float = REACH) -> Errors:
    """Errors that YADE makes with a set of tables at one ratio, against the exact solution.

    Parameters
    ----------
    tables : sequence of Table
        The set, by ascending ratio; one table is enough at its own ratio.
    ratio : float
        R2/R1.
    contact_angle : float
        θ of both spheres, [rad].
    reach : float
        Largest gap over the rupture distance, at most 0.98.

    Returns
    -------
    Errors
        The largest over all suctions that the tables hold.

    Examples
    --------
    >>> from pendular.codes.yade.tables import make_table
    >>> table = make_table(1.0, 0.0, tolerance=1e-2, reduced_suction=10.0)
    >>> measure([table], 1.0, 0.0).force < 1e-2
    True
    """
    return measure_to((reach,), tables, ratio, contact_angle)[0]


def measure_to(
    reaches: Sequence[float], tables: Sequence[Table], ratio: float, contact_angle: float
) -> tuple[Errors, ...]:
    """Errors as `measure` has them, to each of some gaps over the rupture distance, at most 0.98."""
    suctions = np.append(0.0, np.geomspace(_LEAST_SUCTION, _last_suction(tables, ratio), _SUCTIONS))[:, None]
    fractions = np.linspace(0.0, REACH, _FRACTIONS)
    gaps = exact_rupture(ratio, contact_angle, suctions) * fractions
    exact = exact_rows(ratio, contact_angle, gaps, suctions)
    asked = np.broadcast_arrays(np.float64(ratio), gaps, suctions)
    found = reader.interpolate(tables, *(values.ravel() for values in asked)).reshape(exact.shape)
    errors = _errors(found, exact, exact[:, :1])
    return tuple(_largest(errors[:, fractions <= reach]) for reach in reaches)


def measure_rupture(tables: Sequence[Table], ratio: float, contact_angle: float) -> RuptureErrors:
    """Errors of the gap at which YADE breaks a bridge, at one ratio and over all suctions that the tables hold.

    Parameters
    ----------
    tables, ratio, contact_angle
        As for `measure`.

    Returns
    -------
    RuptureErrors

    Examples
    --------
    >>> from pendular.codes.yade.tables import make_table
    >>> measure_rupture([make_table(1.0, 0.0, reduced_suction=10.0)], 1.0, 0.0).largest < 0.01
    True
    """
    last = _last_suction(tables, ratio)
    spread = np.append(0.0, np.geomspace(_LEAST_SUCTION, last, _RUPTURES))
    ends = np.concatenate([table.last_suctions for table in reader.tables_about(tables, ratio)])
    ends = ends[(ends >= 0.0) & (ends < last)]
    suctions = np.concatenate([spread, ends, ends * (1.0 + _DIGIT)])
    errors = reader.rupture(tables, ratio, suctions) / exact_rupture(ratio, contact_angle, suctions) - 1.0
    return RuptureErrors(float(errors.min()), float(errors.max()))


def _last_suction(tables: Sequence[Table], ratio: float) -> float:
    """Suction up to which the tables about a ratio hold a bridge at contact."""
    return float(min(table.last_suctions[0] for table in reader.tables_about(tables, ratio)))


def row_errors(table: Table, contact_angle: float) -> tuple[Errors | None, int]:
    """Largest errors of the rows where there is a bridge, and the number of rows where there is none.

    Parameters
    ----------
    table : Table
        In any order.
    contact_angle : float
        θ of both spheres, [rad].

    Returns
    -------
    Errors or None
        None if there is no bridge at any row.
    int
    """
    rows = np.concatenate(table.blocks)
    rows = rows[(rows[:, 0] >= 0.0) & (rows[:, 1] >= 0.0)]
    exact = exact_rows(table.ratio, contact_angle, rows[:, 0], rows[:, 1])
    exists = exact[:, 3] > 0.0
    strays = int(np.count_nonzero(~exists))
    if strays == len(rows):
        return None, strays
    contact = exact_rows(table.ratio, contact_angle, 0.0, rows[exists, 1])
    return _largest(_errors(rows[exists], exact[exists], contact)), strays


def _errors(found: Floats, exact: Floats, contact: Floats) -> Floats:
    """Errors of rows in the fields of `Errors`, on the last axis; the larger angle is the first, as YADE takes it."""
    found, exact = found[..., 2:], exact[..., 2:]
    angles = np.s_[..., 2:4]
    errors = np.abs(found - exact)
    errors[angles] = np.abs(np.sort(found[angles]) - np.sort(exact[angles]))[..., ::-1]
    errors[..., :2] /= contact[..., 2:4]
    errors[..., 4:] /= (2.0 * contact[..., 6] + contact[..., 7])[..., None]
    return errors


def _largest(errors: Floats) -> Errors:
    return Errors(*map(float, errors.reshape(-1, errors.shape[-1]).max(axis=0)))
