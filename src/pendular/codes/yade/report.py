"""What an audit says to a person: tables, and a line for every fault."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from .audit import MIDDLE, RUPTURE_TOLERANCE, Audit, FileAudit
from .errors import RuptureErrors
from .tables import REACH

if TYPE_CHECKING:
    from rich.table import Table as Sheet

__all__ = ["LEGEND", "between_sheet", "fault_lines", "file_sheet", "row_sheet", "verdict"]

LEGEND = f"""\
force, volume: largest error over the value at contact under the same suction; in YADE to {REACH:g} of rupture
angles: half-filling; tensor: over the liquid-gas area; rupture: of the gap at which the bridge breaks, from ... to"""

_MOST_FAULTS = 4  # of one file that are told


def file_sheet(audit: Audit) -> Sheet:
    """Table of the files: what each holds, and its errors in YADE.

    Parameters
    ----------
    audit : Audit
        Of a set.

    Returns
    -------
    rich.table.Table
    """
    errors = [f"{name}\nin YADE" for name in ("force", "volume", "angles", "tensor", "rupture")]
    sheet = _sheet("file", "blocks", "rows", "MB", "to u*", *errors)
    for file in audit.files:
        cells = [file.name, f"{file.blocks}", f"{file.rows}", f"{file.size / 1e6:.2f}", _number(file.reduced_suction)]
        found = file.in_yade
        cells += (
            ["-"] * 4
            if found is None
            else [
                *map(_percent, (found.force, found.volume)),
                _degrees(max(found.delta1, found.delta2)),
                _percent(max(found.nn11, found.nn33)),
            ]
        )
        sheet.add_row(*cells, _span(file.rupture))
    return sheet


def row_sheet(audit: Audit) -> Sheet:
    """Table of the errors of the rows, by their columns.

    Parameters
    ----------
    audit : Audit
        Of a set whose rows were checked.

    Returns
    -------
    rich.table.Table
    """
    sheet = _sheet("file", "volume", "force", "delta1", "delta2", "nn11", "nn33")
    for file in audit.files:
        found = file.at_rows
        cells = (
            ["-"] * 6
            if found is None
            else [
                *map(_percent, (found.volume, found.force)),
                *map(_degrees, (found.delta1, found.delta2)),
                *map(_percent, (found.nn11, found.nn33)),
            ]
        )
        sheet.add_row(file.name, *cells)
    return sheet


def between_sheet(audit: Audit) -> Sheet:
    """Table of the errors in the middle between two ratios, where YADE mixes two tables.

    Parameters
    ----------
    audit : Audit
        Of a whole set.

    Returns
    -------
    rich.table.Table
    """
    heads = (f"force\nto {MIDDLE:g}", f"force\nto {REACH:g}", f"volume\nto {REACH:g}", "rupture\nin YADE")
    sheet = _sheet("R2/R1", *heads)
    for mixed in audit.between:
        errors = (mixed.inner.force, mixed.in_yade.force, mixed.in_yade.volume)
        sheet.add_row(f"{mixed.ratio:.3g}", *map(_percent, errors), _span(mixed.rupture))
    return sheet


def fault_lines(audit: Audit) -> Iterator[str]:
    """What is wrong in the files, one line each; further faults of the same file are counted.

    Parameters
    ----------
    audit : Audit
        Of a set.

    Yields
    ------
    str
    """
    for file in audit.files:
        for fault in _faults(file):
            yield f"{file.name}: {fault}"


def verdict(audit: Audit, tolerance: float) -> str:
    """Whether the ten files are in order and within the tolerances, in words.

    Parameters
    ----------
    audit : Audit
        Of a set.
    tolerance : float
        Of the force.

    Returns
    -------
    str
    """
    limits = f"force within {_percent(tolerance)} of contact, rupture within {_percent(RUPTURE_TOLERANCE)}"
    if audit.is_within(tolerance):
        return f"all ten tables in order: {limits}"
    faulty = sum(bool(file.faults) for file in audit.files)
    return f"NOT in order: {faulty} of {len(audit.files)} files have faults" if faulty else f"NOT within: {limits}"


def _faults(file: FileAudit) -> Iterator[str]:
    yield from file.faults[:_MOST_FAULTS]
    if len(file.faults) > _MOST_FAULTS:
        yield f"{len(file.faults) - _MOST_FAULTS} more"
    if file.strays:
        yield f"{file.strays} of {file.rows} rows are at gaps and suctions where there is no bridge"


def _sheet(*heads: str) -> Sheet:
    from rich.table import Table as Sheet

    sheet = Sheet(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="bold")
    for i, head in enumerate(heads):
        sheet.add_column(head, justify="right" if i else "left", vertical="bottom", no_wrap=True)
    return sheet


def _degrees(error: float) -> str:
    return f"{_two_digits(error)}°"


def _percent(error: float) -> str:
    return f"{_two_digits(100.0 * error)} %"


def _span(errors: RuptureErrors | None) -> str:
    if errors is None:
        return "-"
    low, high = (("+" if error >= 0.0 else "\N{MINUS SIGN}") + _two_digits(100.0 * abs(error)) for error in errors)
    return f"{low} to {high} %"


def _two_digits(value: float) -> str:
    return f"{value:.2g}" if value < 99.5 else f"{value:.0f}"


def _number(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.4g}"
