"""Bridges of the plug-in in a running LAMMPS against exact bridges, against contact lists, and against conservation."""

import math
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from mpi4py import MPI  # isort: skip  # noqa: F401  # before LAMMPS, which then finds the library

import numpy as np
import pytest

import pendular as pl
from lammps_scripts import wet_grains
from lammps_scripts.wet_grains import RADIUS, by_id, film_of, found_in, grains, opened, rows_of, simulation
from pendular.front.cli import main
from pendular.packing.forces import BridgeState, contact_energy, contact_forces

pytestmark = pytest.mark.skipif(shutil.which("g++") is None, reason="no g++ to build the plug-in: apt-get install g++")

SCRIPT = Path(wet_grains.__file__)
ANGLE, TENSION = math.radians(20.0), 0.0728
WATER = pl.Liquid(surface_tension=TENSION)
HELD = {"suction": 2e4, "volume": 2e-15}  # [Pa] and [m³], for grains of about 0.1 mm
RANGES = {"suction": ((1.0, 1e3), (1, 4), 1e-6), "volume": ((1e-4, 1e-2), (1, 1.5), 1e-5)}
ID1, ID2, SEPARATION, FORCE, VOLUME, SUCTION, ENERGY, RUPTURE = range(8)  # columns of the compute


class Tables(dict):
    """One table for each control, made when first asked for, and its file."""

    def __init__(self, folder):
        self.folder = folder

    def __missing__(self, control):
        reduced, radius_ratio, tolerance = RANGES[control]
        self[control] = pl.tabulate(ANGLE, control, reduced=reduced, radius_ratio=radius_ratio, tolerance=tolerance)
        self[control].save(self.file(control))
        return self[control]

    def file(self, control):
        return self.folder / f"{control}.bridges"

    def law(self, control, held=None, more=""):
        """Words of the input."""
        self[control]
        value = HELD[control] if held is None else held
        return f"{self.file(control)} {control} {value} surface_tension {TENSION} {more}"


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    return Tables(tmp_path_factory.mktemp("tables"))


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """What the command writes."""
    folder = tmp_path_factory.mktemp("plugin") / "lammps-pendular"
    with pytest.raises(SystemExit) as end:
        main(["export", "lammps", "--out", str(folder)])
    assert end.value.code == 0
    return folder


@pytest.fixture(scope="module")
def plugin(sources):
    """The plug-in, built by the one line of its README, without a warning about its own sources."""
    (line,) = re.findall(r"^g\+\+ .*$", (sources / "README.md").read_text(encoding="utf-8"), re.MULTILINE)
    strict = line.replace("g++ ", "g++ -Wall -Wextra -Werror=return-type ", 1)
    python = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        strict, shell=True, cwd=sources, env=os.environ | {"PATH": python}, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    own = {path.name for path in sources.iterdir()}
    warned = [text for text in re.findall(r"^(\S+?):\d+:\d+: warning", done.stderr, re.MULTILINE) if text in own]
    assert not warned, done.stderr
    return sources / "pendularplugin.so"


def new_seed():
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    return seed


TWO_GRAINS = """
    units {units}
    atom_style sphere
    atom_modify map array
    newton {newton}
    boundary p p p
    region box block 0 {box!r} 0 {box!r} 0 {box!r}
    create_box 2 box
    fix film all property/atom d_film
    create_atoms {types[0]} single {x1!r} {middle!r} {middle!r}
    create_atoms {types[1]} single {x2!r} {middle!r} {middle!r}
    set atom 1 diameter {d1!r} density 2500
    set atom 2 diameter {d2!r} density 2500
    pair_style hybrid/overlay granular pendular {style}
    pair_coeff * * granular hooke {stiffness!r} 0 tangential linear_nohistory 0.0 0.0 damping velocity
    comm_modify vel yes
    neighbor {skin!r} bin
    timestep {step!r}
    thermo_modify norm no
    group moved id 2
    compute bridges all pendular/bridges id1 id2 separation force volume suction energy rupture_distance
"""


def two_grains(plugin, law, radii, gap, *, start=300e-6, unit=1.0, types=(1, 1), style="", newton="on", units="si"):
    """LAMMPS with two grains along x, which meet across the edge of the box if they start near it."""
    box = 1e-3
    text = TWO_GRAINS.format(
        box=box * unit, middle=box * unit / 2, x1=start * unit, x2=(start + sum(radii) + gap) % box * unit,
        d1=2 * radii[0] * unit, d2=2 * radii[1] * unit, skin=2e-5 * unit, types=types, style=style, newton=newton,
        units=units, stiffness=300.0, step=1e-8,
    )  # fmt: skip
    lmp = opened(plugin)
    lmp.commands_string(text)
    for line in [law] if isinstance(law, str) else law:
        lmp.command(f"pair_coeff {line}" if re.match(r"[\d*]+ [\d*]+ ", line) else f"pair_coeff * * pendular {line}")
    return lmp


def forces(lmp):
    """By id; no contact pushes where the gap is not negative."""
    return by_id(lmp, "f", 3)


def move(lmp, way):
    """Put the second grain elsewhere, and look."""
    lmp.command(f"displace_atoms moved move {float(way)!r} 0 0 units box")
    lmp.command("run 0")


# Forces --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("start", [300e-6, 900e-6], ids=["inside", "across the edge"])
@pytest.mark.parametrize(
    ("source", "control", "ratio"),
    [
        ("table", "suction", 1.0),
        ("table", "suction", 2.7),
        ("table", "volume", 1.3),
        ("exact", "suction", 2.7),
        ("exact", "volume", 1.0),
    ],
)
def test_forces_of_two_grains_are_exact(plugin, tables, source, control, ratio, start, newton):
    radii, held = (50e-6, 50e-6 * ratio), {"suction": 2e4, "volume": 5e-16}[control]
    known = {control: held, "liquid": WATER}
    pair = pl.Pair(radii, ANGLE)
    end, contact = float(pl.rupture(pair, **known).separation), pl.bridge(pair, 0.0, **known).force
    gaps = np.concatenate([[0.0], np.linspace(0.001, 0.999, 25) * end, [1.001 * end, 0.4 * end]])
    law = f"exact contact_angle 20 {control} {held} surface_tension {TENSION}"
    tolerance = 3 * RANGES[control][2] if source == "table" else 1e-9
    lmp = two_grains(plugin, tables.law(control, held) if source == "table" else law, radii, -1e-12, start=start,
                     newton=newton)  # fmt: skip
    lmp.command("run 0")
    for gap, step in zip(gaps, np.diff(gaps, prepend=-1e-12), strict=True):
        move(lmp, step)
        # No bridge beyond rupture, and on the way back none without contact.
        stands = gap < end and gap != gaps[-1]
        exact = pl.bridge(pair, gap, **known)
        expected = float(exact.force) if stands else 0.0
        force, rows = forces(lmp), rows_of(lmp)
        assert force[0, 0] == pytest.approx(expected, abs=tolerance * contact + 300 * 1e-18)
        assert force[0, 0] == -force[1, 0]
        assert not force[:, 1:].any()
        assert rows[:, :2].tolist() == ([[1, 2]] if stands else [])
        if stands:
            assert rows[0, SEPARATION] == pytest.approx(gap, abs=1e-15)
            assert rows[0, FORCE] == pytest.approx(expected, abs=tolerance * contact)
            assert rows[0, RUPTURE] == pytest.approx(end, rel=1e-6)
            assert rows[0, VOLUME] == pytest.approx(float(exact.volume), rel=1e-4)
            assert rows[0, SUCTION] == pytest.approx(float(exact.suction), rel=1e-4, abs=1e-3 * TENSION / 50e-6)
            assert lmp.get_thermo("pe") == pytest.approx(rows[0, ENERGY], rel=1e-13)
    lmp.close()


def test_contact_angles_of_two_materials(plugin, tmp_path):
    """One angle for each of two types, by the solver and by a table, whichever grain comes first."""
    radii, angles, suction = {1: 50e-6, 2: 80e-6}, {1: 10.0, 2: 50.0}, 2e4
    pl.tabulate((math.radians(10.0), math.radians(50.0)), reduced=(5.0, 50.0), radius_ratio=(1, 2)).save(
        tmp_path / "t.bridges"
    )
    mixed = f"suction {suction} surface_tension {TENSION}"
    same = [f"{t} {t} pendular exact contact_angle {angles[t]} {mixed}" for t in (1, 2)]
    for source in ("exact contact_angle 10 50", str(tmp_path / "t.bridges")):
        for types in ((1, 1), (1, 2), (2, 1), (2, 2)):
            laws = [*same, f"1 2 pendular {source} {mixed}"]
            lmp = two_grains(plugin, laws, [radii[t] for t in types], -1e-12, types=types)
            lmp.command("run 0")
            move(lmp, 1e-6)
            pair = pl.Pair(tuple(radii[t] for t in types), tuple(math.radians(angles[t]) for t in types))
            exact = pl.bridge(pair, 1e-6, suction=suction, liquid=WATER).force
            assert forces(lmp)[0, 0] == pytest.approx(float(exact), rel=1e-7)
            lmp.close()


def step_of_the_list(table, lmp, box, radii, state, held):
    """A step of the contact list: force on each grain, virial, energy and bridges.

    Each contact has two grains of its own, so that one across the edge of the box is as any other.
    """
    positions = by_id(lmp, "x", 3)
    first, second = np.triu_indices(len(positions), 1)
    arm = positions[second] - positions[first]
    arm -= box * np.round(arm / box)
    near = np.flatnonzero(np.linalg.norm(arm, axis=1) < 2.4 * RADIUS)
    first, second, arm = first[near], second[near], arm[near]
    centres, sizes = np.empty((2 * near.size, 3)), np.empty(2 * near.size)
    centres[0::2], centres[1::2] = positions[first], positions[first] + arm
    sizes[0::2], sizes[1::2] = radii[first], radii[second]
    ids = list(zip((first + 1).tolist(), (second + 1).tolist(), strict=True))
    rows = {pair: row for row, pair in enumerate(ids)}
    before = np.array([rows[pair] for pair in state], int)
    own = BridgeState(np.stack([2 * before, 2 * before + 1], 1), np.array(list(state.values())))
    pairs = np.arange(2 * near.size).reshape(-1, 2)
    found = contact_forces(table, pairs, centres, sizes, held, TENSION, state=own, formation_distance=1e-6)
    force = np.zeros(positions.shape)
    np.add.at(force, first, found.force[0::2])
    np.add.at(force, second, found.force[1::2])
    bridged = found.state.pairs[:, 0] // 2
    bridges = dict(zip([ids[row] for row in bridged], found.state.control.tolist(), strict=True))
    return force, found.virial, contact_energy(table, found.state, centres, sizes, TENSION), bridges


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_every_step_of_a_packing_is_that_of_its_contact_list(plugin, tables, control, newton):
    radii, positions, velocities, box = state = grains(new_seed(), cells=5)
    lmp = simulation(plugin, state, tables.law(control, more="formation 1e-6"), newton=newton)
    lmp.commands_string("""
        pair_coeff * * granular hooke 1e-30 0 tangential linear_nohistory 0.0 0.0 damping velocity
        compute tensor all pressure NULL pair
        compute each all stress/atom NULL pair
        compute stress all reduce sum c_each[*]
        compute potential all pe/atom pair
        compute energy all reduce sum c_potential
        thermo 1
        thermo_style custom step pe press c_tensor[*] c_stress[*] c_energy c_bridges c_bridges[*]
    """)
    bridges, formed, broken, builds = {}, 0, 0, 0
    for step in range(250):
        lmp.command("run 1 pre no" if step else "run 0")
        before = bridges
        force, virial, energy, bridges = step_of_the_list(tables[control], lmp, box, radii, before, HELD[control])
        rows = rows_of(lmp)
        assert {(int(row[0]), int(row[1])) for row in rows} == set(bridges)
        formed, broken = formed + len(bridges.keys() - before), broken + len(before.keys() - bridges)
        builds += lmp.extract_setting("neigh_ago") == 0
        strongest, found = np.abs(force).max(), forces(lmp)
        np.testing.assert_allclose(found, force, atol=1e-9 * strongest)
        assert np.abs(found.sum(axis=0)).max() < 1e-12 * strongest * len(radii)
        assert lmp.get_thermo("pe") == pytest.approx(energy, rel=1e-9)
        expected = virial[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        scale = 1e-9 * np.abs(virial).max()
        assert lmp.numpy.extract_compute("energy", 0, 0) == pytest.approx(energy, rel=1e-9)
        np.testing.assert_allclose(lmp.numpy.extract_compute("tensor", 0, 1) * box**3, expected, atol=scale)
        np.testing.assert_allclose(lmp.numpy.extract_compute("stress", 0, 1), -expected, atol=scale)
        number, liquid, of_all = lmp.numpy.extract_compute("bridges", 0, 1)
        assert number == lmp.numpy.extract_compute("bridges", 0, 0) == len(bridges)
        assert liquid == pytest.approx(rows[:, VOLUME].sum(), rel=1e-12)
        assert of_all == pytest.approx(energy, rel=1e-9)
    print(f"{formed} formed, {broken} broke, {builds} lists")
    assert formed > len(bridges) > 100
    assert broken > 5
    assert builds > 5
    assert not by_id(lmp, "torque", 3).any()
    lmp.close()
