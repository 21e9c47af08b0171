"""Audit of a set of YADE tables: faults of its files, errors of its rows, and what YADE makes of them."""

import itertools
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...ground.files import in_one_line
from .errors import Errors, RuptureErrors, measure, measure_rupture, measure_to, row_errors
from .files import RATIOS, Table, parse_table, table_name
from .tables import REACH

__all__ = [
    "MIDDLE",
    "RUPTURE_TOLERANCE",
    "Audit",
    "FileAudit",
    "MixedAudit",
    "audit",
    "audit_between",
    "audit_table",
    "contact_angle_of",
    "folder_texts",
]

RUPTURE_TOLERANCE = 0.01
MIDDLE = 0.8  # of the rupture distance: between two ratios, one of the two tables ends not far beyond

_ROUGHNESS = 0.5  # of a contact angle of 0 in the rows of a table, [degrees]


class FileAudit(NamedTuple):
    """One file of a set."""

    name: str
    ratio: float  # NaN where it could not be read
    size: int  # [bytes]
    faults: tuple[str, ...]
    blocks: int
    rows: int
    reduced_suction: float  # u R2/γ at which it ends at contact
    at_rows: Errors | None  # None where the rows were not checked
    strays: int  # rows where there is no bridge
    in_yade: Errors | None  # to 0.98 of the rupture distance; None where YADE crashes or finds nothing
    rupture: RuptureErrors | None


class MixedAudit(NamedTuple):
    """What YADE makes of a set between two of its ratios."""

    ratio: float
    inner: Errors  # to 0.8 of the rupture distance
    in_yade: Errors  # to 0.98
    rupture: RuptureErrors


class Audit(NamedTuple):
    """A set of tables."""

    contact_angle: float  # [rad]
    files: tuple[FileAudit, ...]
    between: tuple[MixedAudit, ...]  # empty if the set is not whole
    tables: tuple[Table, ...]  # those that could be read

    def is_within(self, tolerance: float) -> bool:
        """Whether no file has a fault, the force is within a tolerance at their ratios, and rupture within 1 %."""
        return all(
            not file.faults
            and file.in_yade is not None
            and file.rupture is not None
            and file.in_yade.force <= tolerance
            and file.rupture.largest <= RUPTURE_TOLERANCE
            for file in self.files
        )


def contact_angle_of(table: Table) -> float:
    r"""Contact angle for which a table was made, from the balance of forces on the small sphere.

    .. math:: F^* = \frac{\sin\delta_1}{r}\sin(\delta_1 + \theta) + \frac{u^*}{2}\frac{\sin^2\delta_1}{r^2}

    Parameters
    ----------
    table : Table
        With rows at contact.

    Returns
    -------
    float
        θ, to a hundredth of a degree, [rad]: the median over the rows at contact.

    Raises
    ------
    ValueError
        If it is not in [0, 90) degrees.

    Examples
    --------
    >>> from pendular.codes.yade.tables import make_table
    >>> round(math.degrees(contact_angle_of(make_table(2.0, math.radians(20), reduced_suction=10.0))), 6)
    20.0
    """
    rows = table.blocks[0]
    filling = np.deg2rad(rows[:, 4:6].max(axis=1))
    radius = np.sin(filling) / table.ratio
    with np.errstate(invalid="ignore", divide="ignore"):
        angles = np.rad2deg(np.arcsin((rows[:, 3] - 0.5 * rows[:, 1] * radius**2) / radius) - filling)
    angles = angles[np.isfinite(angles)]
    degrees = round(float(np.median(angles)), 2) if angles.size else math.nan
    if not -_ROUGHNESS <= degrees < 90.0:
        raise ValueError(f"contact-angle: missing; the rows at contact speak of {degrees:g} deg")
    return math.radians(max(degrees, 0.0))


def folder_texts(folder: Path, suffix: str = "") -> dict[str, str | None]:
    """Texts of the ten files of a set by name; None is a missing file.

    Parameters
    ----------
    folder : Path
        Where the files are.
    suffix : str
        YADE's `suffCapFiles`, which ends each name.

    Returns
    -------
    dict

    Raises
    ------
    ValueError
        If none of them is there, or one cannot be read.
    """
    paths = [folder / table_name(ratio, suffix) for ratio in RATIOS]
    if not any(path.is_file() for path in paths):
        raise ValueError(f"check: no file like '{paths[0].name}' in '{folder}'")
    texts: dict[str, str | None] = {}
    for path in paths:
        with in_one_line("check", path, "read"):
            texts[path.name] = path.read_text("ascii", "replace") if path.is_file() else None
    return texts


def audit(texts: Mapping[str, str | None], contact_angle: float | None = None) -> Audit:
    """Audit of a set of tables: what is wrong in the files, and how far rows and interpolation are from the truth.

    Parameters
    ----------
    texts : mapping
        Texts of the files by name and ascending ratio, from `folder_texts`.
    contact_angle : float, optional
        θ of both spheres, [rad]. By default the one for which the first table that can be read was made.

    Returns
    -------
    Audit

    Raises
    ------
    ValueError
        If no table can be read and the contact angle is not given.
    """
    readings = {name: None if text is None else parse_table(text) for name, text in texts.items()}
    tables = [reading.table for reading in readings.values() if reading is not None and reading.table is not None]
    if contact_angle is None:
        if not tables:
            reasons = (f"{name}: {reading.faults[0]}" for name, reading in readings.items() if reading is not None)
            raise ValueError(f"check: no table can be read: {next(reasons)}")
        contact_angle = contact_angle_of(tables[0])
    files: list[FileAudit] = []
    last_ratio = 0.0
    for name, reading in readings.items():
        size = len(texts[name] or "")
        if reading is None or reading.table is None:
            faults = ("missing: YADE goes on without any force",) if reading is None else reading.faults
            files.append(FileAudit(name, math.nan, size, faults, 0, 0, math.nan, None, 0, None, None))
            continue
        table = reading.table
        if not files and table.ratio != 1.0:
            faults = (*reading.faults, f"the first ratio is {table.ratio:g}, not 1: YADE crashes below it")
        elif table.ratio <= last_ratio:
            faults = (*reading.faults, f"the ratio {table.ratio:g} does not ascend: YADE takes wrong files")
        else:
            faults = reading.faults
        errors, strays = row_errors(table, contact_angle)
        file = audit_table(name, size, table, contact_angle, faults)
        files.append(file._replace(at_rows=errors, strays=strays))
        last_ratio = table.ratio
    return Audit(contact_angle, tuple(files), audit_between(tables, contact_angle), tuple(tables))


def audit_table(name: str, size: int, table: Table, contact_angle: float, faults: tuple[str, ...] = ()) -> FileAudit:
    """Audit of one table without its rows.

    Parameters
    ----------
    name, size, faults
        Of its file.
    table : Table
        What it holds.
    contact_angle : float
        θ of both spheres, [rad].

    Returns
    -------
    FileAudit
    """
    errors = rupture = None
    if _can_be_run(table):
        errors = measure([table], table.ratio, contact_angle)
        rupture = measure_rupture([table], table.ratio, contact_angle)
    count, last = sum(map(len, table.blocks)), float(table.last_suctions[0])
    return FileAudit(name, table.ratio, size, faults, len(table.blocks), count, last, None, 0, errors, rupture)


def _can_be_run(table: Table) -> bool:
    """Whether YADE neither crashes with a table nor finds nothing at contact."""
    gaps = table.gaps
    return bool(gaps[0] == 0.0 and np.all(np.diff(gaps) > 0.0) and table.last_suctions[0] > 0.0)


def audit_between(tables: Sequence[Table], contact_angle: float) -> tuple[MixedAudit, ...]:
    """Errors in the geometric middle of each two ratios of a whole set; none of a set that YADE would not read.

    Parameters
    ----------
    tables : sequence of Table
        The set.
    contact_angle : float
        θ of both spheres, [rad].

    Returns
    -------
    tuple of MixedAudit
    """
    ratios = [table.ratio for table in tables]
    if len(tables) < len(RATIOS) or ratios != sorted(set(ratios)) or not all(map(_can_be_run, tables)):
        return ()
    return tuple(_mixed(tables, math.sqrt(lower * upper), contact_angle) for lower, upper in itertools.pairwise(ratios))


def _mixed(tables: Sequence[Table], ratio: float, contact_angle: float) -> MixedAudit:
    inner, reached = measure_to((MIDDLE, REACH), tables, ratio, contact_angle)
    return MixedAudit(ratio, inner, reached, measure_rupture(tables, ratio, contact_angle))
