"""Export of capillary bridges for YADE: ten tables, the points of `CapillarityEngine`, and a note on both."""

import math
from pathlib import Path
from typing import NamedTuple

from ...ground.files import in_one_line, whole
from .audit import Audit, audit_between, audit_table
from .files import RATIOS, table_name, write_points, write_table
from .points import make_points
from .tables import REDUCED_SUCTION, TOLERANCE, make_table

__all__ = ["Export", "export"]


class Export(NamedTuple):
    """What was written, and what YADE will make of it."""

    audit: Audit
    points: int
    points_path: Path
    points_size: int  # [bytes]
    note_path: Path


def export(
    folder: Path,
    contact_angle: float,
    *,
    suffix: str = "",
    tolerance: float = TOLERANCE,
    reduced_suction: float = REDUCED_SUCTION,
) -> Export:
    """Write a set for one contact angle: ``M(r=1)`` to ``M(r=10)``, ``capillaryfile.txt`` and ``bridges.txt``.

    Parameters
    ----------
    folder : Path
        Where YADE is started; it is made if it is not there.
    contact_angle : float
        θ of both spheres, [rad], below π/2.
    suffix : str
        YADE's `suffCapFiles`; it ends the names of the tables and the stems of the other two.
    tolerance : float
        Largest error of the force in YADE to 0.98 of the rupture distance, over the force at contact, at the ten
        ratios.
    reduced_suction : float
        u R2/γ up to which the tables reach.

    Returns
    -------
    Export

    Raises
    ------
    ValueError
        For bad input, or if the folder cannot be written to.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     done = export(Path(folder), 0.35, suffix="_th20", tolerance=0.02, reduced_suction=10.0)
    ...     len(list(Path(folder).iterdir())), done.audit.is_within(0.02)
    (12, True)
    """
    with in_one_line("out", folder, "written to"):
        folder.mkdir(parents=True, exist_ok=True)
    tables = [
        make_table(ratio, contact_angle, tolerance=tolerance, reduced_suction=reduced_suction) for ratio in RATIOS
    ]
    points = make_points(contact_angle, reduced_suction=reduced_suction)
    points_path, note_path = (folder / f"{stem}{suffix}.txt" for stem in ("capillaryfile", "bridges"))
    with in_one_line("out", folder, "written to"):
        sizes = [write_table(folder / table_name(table.ratio, suffix), table) for table in tables]
        points_size = write_points(points_path, points)
    files = [
        audit_table(table_name(table.ratio, suffix), size, table, contact_angle)
        for table, size in zip(tables, sizes, strict=True)
    ]
    audit = Audit(contact_angle, tuple(files), audit_between(tables, contact_angle), tuple(tables))
    with in_one_line("out", folder, "written to"), whole(note_path) as draft:
        draft.write_text(_note(contact_angle, suffix, tolerance, reduced_suction), encoding="utf-8")
    return Export(audit, len(points), points_path, points_size, note_path)


def _note(contact_angle: float, suffix: str, tolerance: float, reduced_suction: float) -> str:
    """What cannot be said inside the files, which have no place for it."""
    ratios = ", ".join(f"{ratio:g}" for ratio in RATIOS)
    return f"""Capillary bridges for YADE, from the exact solution of the Young-Laplace equation

contact angle       {math.degrees(contact_angle):g} degrees, on both spheres
reduced suction     0 to {reduced_suction:g}
surface tension     any: all numbers are reduced
tables              {table_name(1.0, suffix)} to {table_name(10.0, suffix)}; ratios R2/R1 = {ratios}
columns             D/R2  u R2/gamma  V/R2^3  F/(2 pi gamma R2)  delta1  delta2  nn11/R2^2  nn33/R2^2
tolerance           {tolerance:g} of the force at contact, to 0.98 of the rupture distance
points              capillaryfile{suffix}.txt
columns             u R2/gamma  F/(gamma R2)  D/R2  V/R2^3  S/R2^2  0  delta1  delta2  R1/R2  ending

R2 is the larger radius, u the suction, gamma the surface tension; delta1 is the half-filling angle of the smaller
sphere, delta2 of the larger one, in degrees; 3 is the axis. S counts the liquid-gas and the dry area.
"""
