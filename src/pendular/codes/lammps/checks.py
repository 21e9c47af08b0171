"""What a LAMMPS simulation must be like for the coupler."""

import math
from typing import Any

import numpy as np

from ...ground.check import scalar
from ...table import Table
from .ranks import largest

__all__ = ["check_box", "check_radius", "check_run", "control_of", "reach_of"]


def check_run(lammps: Any, table: Table, fix: str) -> None:
    """Refuse settings under which the forces would be wrong."""
    units = lammps.extract_global("units")
    if units != "si":
        raise ValueError(f"units: {units!r} is not 'si'")
    if lammps.extract_setting("newton_pair"):
        raise ValueError("newton: is on for pairs, and forces on ghost atoms would be lost; use 'newton off'")
    if not lammps.extract_setting("radius_flag"):
        raise ValueError("atom_style: its atoms have no radius; use 'atom_style sphere'")
    ids = lammps.numpy.extract_atom("id", nelem=lammps.extract_setting("nlocal"))
    if np.min(ids, initial=1) < 1:
        raise ValueError("atom_modify: atoms have no ids; leave out 'id no'")
    if lammps.has_id("fix", fix) or lammps.has_id("compute", fix):
        raise ValueError(f"fix: the name {fix!r} is taken")
    if table.contact_angle[0] != table.contact_angle[1]:
        raise ValueError("table: its contact angles differ, and a pair of atoms has no order")
    if lammps.extract_setting("world_size") > 1 and not lammps.has_mpi4py:
        raise ValueError("lmp: runs on several ranks; 'pip install mpi4py' so that they can talk")


def reach_of(table: Table, lammps: Any, control: float, tension: float, formation_distance: float) -> float:
    """Largest distance of two centres that bear a bridge, by the atoms that there are; 0 without atoms."""
    world = lammps.get_mpi_comm() if lammps.extract_setting("world_size") > 1 else None
    radii = lammps.numpy.extract_atom("radius", nelem=lammps.extract_setting("nlocal"))
    radius = largest(world, float(np.max(radii, initial=0.0)))
    if radius == 0.0:
        return 0.0
    rupture = float(table.rupture_distance(control, radius, radius, tension))
    return 2.0 * radius + max(rupture, formation_distance)


def check_radius(radius: float, formation_distance: float, cutoff: float) -> None:
    """Refuse a largest radius with which bridges could form beyond the neighbour list."""
    reach = 2.0 * radius + formation_distance
    if reach > cutoff:
        raise ValueError(f"cutoff: bridges form at up to {reach:.6g} m between centres, beyond {cutoff:.6g} m")


def check_box(lammps: Any, cutoff: float) -> None:
    """Refuse a box in which two atoms could have two bridges, through two of their images."""
    low, high, xy, yz, xz, periodic, _ = lammps.extract_box()
    x, y, z = (top - bottom for bottom, top in zip(low, high, strict=True))
    normal = math.hypot(y * z, xy * z, xy * yz - y * xz)  # to the edges along y and z, as long as their parallelogram
    widths = (x * y * z / normal, y * z / math.hypot(z, yz), z)
    for k in range(lammps.extract_setting("dimension")):
        if periodic[k] and widths[k] < 2.0 * cutoff:
            raise ValueError(
                f"box: its width of {widths[k]:.6g} m along {'xyz'[k]} is less than twice the cutoff of {cutoff:.6g} m"
            )


def control_of(table: Table, value: float) -> float:
    """Suction or volume that is wanted."""
    return scalar(table.control, value, "Pa" if table.control == "suction" else "m**3")
