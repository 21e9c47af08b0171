"""Tables on a GPU: the scalar kernels in Numba's simulator against those of the processor, and compiled for a GPU."""

import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pendular as pl
from on_cuda import GAMMA, NAMES, PAGE_ASKS, kernel_arguments
from pendular.ground.compile import compiled
from pendular.packing.forces import contact_energy
from pendular.table import kernels
from pendular.table.polynomial import CELL, LANES, RUPTURE_CELL, by_halves, in_three, in_two

SCRIPT = Path(__file__).parent / "on_cuda.py"
SIMULATOR = {"NUMBA_ENABLE_CUDASIM": "1", "NUMBA_DISABLE_JIT": "1"}
SEED = 20261123
COUNT = 48
SHARED = 24
MOST_SPILLS = 96  # bytes that a kernel may write to the memory of a thread
TABLES = {
    "suction": {"contact_angle": 0.35, "reduced": (1.0, 1e4), "tolerance": 1e-7},
    "two_angles": {"contact_angle": (0.2, 0.9), "reduced": (10.0, 1e3), "tolerance": 1e-6},
    "volume": {
        "contact_angle": 0.35,
        "control": "volume",
        "reduced": (1e-3, 2e-3),
        "radius_ratio": (1.0, 2.0),
        "tolerance": 1e-5,
    },
}


def run(task, folder, *more, **environment):
    """One task in a process of its own."""
    return subprocess.run(
        [sys.executable, "-W", "error", str(SCRIPT), task, str(folder), *more],
        env=os.environ | {"PYTHONPATH": str(SCRIPT.parents[1])} | environment,
        check=False,
        capture_output=True,
        text=True,
    )


def run_on_device(task, folder, *more):
    """The same on a GPU, if there is one."""
    done = run(task, folder, *more)
    if "CUDA_ERROR" in done.stderr or "CudaSupportError" in done.stderr:
        pytest.skip("no GPU is here")
    return done


def contacts(table, random):
    """Gaps in an overlap, up to rupture and beyond; then a plane, NaN in each place, and controls out of range."""
    radius1 = 10.0 ** random.uniform(-6, -4, COUNT)
    radius2 = radius1 * random.uniform(1.0, 2.0, COUNT) ** random.choice([-1, 1], COUNT)
    mean = 2.0 * radius1 * radius2 / (radius1 + radius2)
    reduced = np.exp(random.uniform(*np.log(table.reduced), COUNT))
    control = reduced * mean**3 if table.control == "volume" else reduced * GAMMA / mean
    rupture = table.rupture_distance(control, radius1, radius2, GAMMA)
    separation = random.uniform(-0.1, 1.1, COUNT) * rupture
    radius1[6:8] = math.inf, math.nan
    control[8:11] = math.nan, 1e9 * control[9], -control[10]
    separation[11:14] = math.nan, math.inf, 0.0
    return separation, control, radius1, radius2


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Tables and contacts, for processes that compile nothing for this processor."""
    path = tmp_path_factory.mktemp("cuda")
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    for name, options in TABLES.items():
        table = pl.tabulate(**options)
        table.save(path / f"{name}.npz")
        np.savez(path / f"{name}.contacts.npz", *contacts(table, random))
    pl.tabulate(**PAGE_ASKS).save(path / "page.npz")
    return path


@pytest.fixture(scope="module")
def simulated(folder):
    done = run("simulate", folder, **SIMULATOR)
    assert done.returncode == 0, done.stderr
    return {name: dict(np.load(folder / f"{name}.answers.npz")) for name in TABLES}


@pytest.mark.parametrize("asked", NAMES)
@pytest.mark.parametrize("name", TABLES)
def test_answers_are_those_of_the_processor(name, asked, simulated, folder):
    grid = pl.load_table(folder / f"{name}.npz").grid
    rows = np.column_stack(list(np.load(folder / f"{name}.contacts.npz").values())).tolist()
    one = getattr(kernels, asked)
    expected = [one(grid, *kernel_arguments(asked, (*row, GAMMA))) for row in rows]
    found = simulated[name][asked]
    np.testing.assert_allclose(found, expected, rtol=1e-12, err_msg="the two sum in another order, no more")
    assert np.array_equal(found == 0.0, np.equal(expected, 0.0))
    assert np.isfinite(found).sum() > COUNT / 2
    assert np.isnan(found[7:11]).all()


@pytest.fixture(scope="module")
def shared(folder):
    """Contacts, no whole number of warps, half in cells of their own and half all in one; and their answers."""
    asked = {}
    for name in TABLES:
        arguments = np.array(list(np.load(folder / f"{name}.contacts.npz").values()))
        table = pl.load_table(folder / f"{name}.npz")
        asked[name, "apart"] = arguments[:, :SHARED]
        one = arguments[:, 20]
        asked[name, "alike"] = np.repeat(one[:, None], SHARED, axis=1)
        asked[name, "alike"][0] = table.rupture_distance(*one[1:], GAMMA) * np.linspace(0.5, 0.51, SHARED)
        np.savez(folder / f"{name}.shared.npz", arguments=np.hstack([asked[name, "apart"], asked[name, "alike"]]))
    done = run("share", folder, **SIMULATOR)
    assert done.returncode == 0, done.stderr
    found = {name: dict(np.load(folder / f"{name}.by_warps.npz")) for name in TABLES}
    return asked, found


@pytest.mark.parametrize("asked", NAMES)
@pytest.mark.parametrize("name", TABLES)
def test_threads_that_share_contacts_answer_as_one_does(name, asked, shared, folder):
    grid = pl.load_table(folder / f"{name}.npz").grid
    rows = np.hstack([shared[0][name, kind] for kind in ("apart", "alike")]).T.tolist()
    one = getattr(kernels, asked)
    expected = [one(grid, *kernel_arguments(asked, (*row, GAMMA))) for row in rows]
    np.testing.assert_array_equal(shared[1][name][asked], expected)
    assert np.isfinite(expected[:SHARED]).sum() > SHARED / 3
    assert np.isfinite(expected[SHARED:]).all()


def test_lanes_are_read_by_pairs_as_they_were_packed(folder):
    """The instructions that a GPU runs, made for this processor."""
    packed_lanes = pytest.importorskip("pendular.table.packed")
    numba = pytest.importorskip("numba")
    grid = pl.load_table(folder / "two_angles.npz").grid
    packed = packed_lanes.pack(grid)
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)

    @numba.njit(error_model="numpy")
    def lane_of_force(coefficients, start, x, y):
        return packed_lanes.force_lane(packed_lanes.force_rows(coefficients, start), x, y)

    @numba.njit(error_model="numpy")
    def lane_of_rupture(coefficients, start, y):
        return packed_lanes.rupture_lane(packed_lanes.rupture_rows(coefficients, start), y)

    for cell in random.integers(0, grid.rupture.size // RUPTURE_CELL, 20).tolist():
        x, y, t = random.uniform(-1.0, 1.0, 3).tolist()
        lanes = tuple(lane_of_force(packed.force, cell * CELL + 2 * lane, x, y) for lane in range(LANES))
        expected = in_three(grid.force, cell, x, y, t)
        assert compiled(by_halves)(lanes, t) == pytest.approx(expected, rel=1e-14)
        lanes = tuple(lane_of_rupture(packed.rupture, cell * RUPTURE_CELL + 2 * lane, y) for lane in range(LANES))
        expected = compiled(in_two)(grid.rupture, cell, x, y)
        assert compiled(by_halves)(lanes, x) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("name", TABLES)
def test_a_kernel_of_ones_own_may_ask(name, simulated):
    answers = simulated[name]
    np.testing.assert_array_equal(answers["own_kernel"], answers["force"] + 1e-9 * answers["stiffness"])
    assert np.isfinite(answers["own_kernel"]).sum() > COUNT / 2


def test_the_page_does_what_it_shows(folder):
    done = run("page", folder, **SIMULATOR)
    assert done.returncode == 0, done.stderr


def grains(table, random):
    """Grains that overlap or lie apart by up to the rupture distance, moved a little, and their pairs in two orders."""
    radii = random.uniform(45e-6, 52e-6, 12)
    control = 1.4e-3 * 50e-6**3 if table.control == "volume" else 50.0 * GAMMA / 50e-6
    positions = random.uniform(0.0, 200e-6, (12, 3))
    first, second = np.triu_indices(12, 1)
    gap = np.linalg.norm(positions[first] - positions[second], axis=1) - radii[first] - radii[second]
    pairs = np.column_stack([first, second])[gap < 40e-6]
    other, moves = random.permutation(pairs), random.uniform(-30e-6, 30e-6, (12, 3))
    return pairs, positions, positions + moves, other, radii, np.array(control), np.array(3e-6)


@pytest.mark.parametrize("kind", ["alone", "shared", "device"])
def test_a_step_is_that_of_the_processor(kind, folder, tmp_path):
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    asked = {}
    for name in ("suction", "volume"):
        shutil.copy(folder / f"{name}.npz", tmp_path)
        asked[name] = grains(pl.load_table(folder / f"{name}.npz"), random)
        np.savez(tmp_path / f"{name}.grains.npz", *asked[name])
    done = run_on_device("step", tmp_path, kind) if kind == "device" else run("step", tmp_path, kind, **SIMULATOR)
    assert done.returncode == 0, done.stderr
    for name, (pairs, positions, moved, _, radii, control, reach) in asked.items():
        table, found = pl.load_table(folder / f"{name}.npz"), np.load(tmp_path / f"{name}.step.{kind}.npz")
        step = pl.contact_forces(table, pairs, positions, radii, control, GAMMA, formation_distance=reach)
        energy = contact_energy(table, step.state, positions, radii, GAMMA)
        np.testing.assert_allclose(found["energy"], energy, rtol=1e-12)
        next_step = pl.contact_forces(table, pairs, moved, radii, control, GAMMA, state=step.state)
        assert 0 < len(next_step.attraction) < len(step.attraction) < len(pairs)
        for key, expected in (
            ("force", step.force), ("virial", step.virial), ("moved", next_step.force),
            ("summed", next_step.force), ("moved_virial", next_step.virial),
        ):  # fmt: skip
            np.testing.assert_allclose(found[key], expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())
        assert np.isfinite(found["stood"]).sum() == len(step.attraction)
        assert np.isfinite(found["stands"]).sum() == len(next_step.attraction)
        np.testing.assert_allclose(np.sort(found["attraction"])[-len(step.attraction) :], np.sort(step.attraction))


def solver_contacts(held, random):
    """Planes, equal and unequal spheres of any angles, up to rupture and beyond; then rows that are no question."""
    radius1 = 10.0 ** random.uniform(-6, -4, COUNT)
    radius2 = radius1 * random.uniform(1.0, 5.0, COUNT) ** random.choice([-1, 0, 1], COUNT)
    radius2[:4] = math.inf
    angle1, angle2 = random.uniform(0.0, 1.5, (2, COUNT))
    mean = 2.0 / (1.0 / radius1 + 1.0 / radius2)
    reduced = 10.0 ** (random.uniform(-9, 0, COUNT) if held == "volume" else random.uniform(-1, 6, COUNT))
    control = reduced * mean**3 if held == "volume" else reduced * GAMMA / mean
    pair, liquid = pl.Pair((radius1, radius2), (angle1, angle2)), pl.Liquid(surface_tension=GAMMA)
    separation = random.uniform(-0.02, 1.1, COUNT) * pl.rupture(pair, **{held: control}, liquid=liquid).separation
    control[6], separation[7], angle2[8], angle1[9] = math.nan, math.inf, math.nan, 4.0
    return separation, control, radius1, radius2, angle1, angle2


@pytest.mark.parametrize("kind", ["simulated", "device"])
def test_the_solver_is_that_of_the_processor(kind, tmp_path):
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    asked = {held: solver_contacts(held, random) for held in ("suction", "volume")}
    for held, arguments in asked.items():
        np.savez(tmp_path / f"solver.{held}.npz", *arguments)
    done = run_on_device("solve", tmp_path) if kind == "device" else run("solve", tmp_path, **SIMULATOR)
    assert done.returncode == 0, done.stderr
    for held, arguments in asked.items():
        found = np.load(tmp_path / f"solver.{held}.npy")
        assert np.isnan(found[6:10]).all()
        gap, control, *solids = (np.delete(argument, slice(6, 10)) for argument in arguments)
        pair = pl.Pair((solids[0], solids[1]), (solids[2], solids[3]))
        exact = pl.bridge(pair, gap, **{held: control}, liquid=pl.Liquid(surface_tension=GAMMA))
        np.testing.assert_allclose(np.delete(found, slice(6, 10)), exact.force, rtol=1e-9)
        assert 0 < np.count_nonzero(exact.force) < exact.force.size
        for name, values in np.load(tmp_path / f"solver.{held}.fields.npz").items():
            is_number = values.dtype == float
            assert np.isnan(values[..., 6:10]).all() if is_number else not values[..., 6:10].any()
            expected = getattr(exact, name)
            others = np.delete(values, slice(6, 10), axis=-1)
            scale = np.nanmax(np.abs(expected)) if is_number else 1.0
            np.testing.assert_allclose(
                others, np.moveaxis(expected, -1, 0) if expected.ndim == 2 else expected, rtol=1e-8, atol=1e-9 * scale
            )


def test_a_device_gives_what_the_processor_does(folder, tmp_path):
    there = tmp_path / "there"
    shutil.copytree(folder, there)
    done = run_on_device("simulate", there)
    assert done.returncode == 0, done.stderr
    for name in TABLES:
        grid = pl.load_table(folder / f"{name}.npz").grid
        rows = np.column_stack(list(np.load(folder / f"{name}.contacts.npz").values())).tolist()
        for asked, found in np.load(there / f"{name}.answers.npz").items():
            if asked in NAMES:
                expected = [getattr(kernels, asked)(grid, *kernel_arguments(asked, (*row, GAMMA))) for row in rows]
                np.testing.assert_allclose(found, expected, rtol=1e-12)


@pytest.mark.long
@pytest.mark.parametrize("capability", ["9.0", "7.5"])  # the newest, the oldest
def test_all_kernels_compile_for_a_gpu(capability, folder):
    done = run("compile", folder, capability)
    if "is not installed" in done.stderr:
        pytest.skip(done.stderr.strip())
    assert done.returncode == 0, done.stderr
    target = f".target sm_{capability.replace('.', '')}"
    for name, code in json.loads((folder / f"code.{capability}.json").read_text()).items():
        assert target in code["ptx"]
        assert code["ptx"].count(".entry") == 1
        assert ".extern .func" not in code["ptx"], "calls what no GPU has"
        print(name, {key: value for key, value in code.items() if key != "ptx"})
        if "spilled" in code:  # the assembler is here
            assert code["spilled"] <= MOST_SPILLS, name
        if "spilled" in code and code["shares"]:
            assert code["wide_loads"] >= (RUPTURE_CELL if "rupture" in name else CELL) / LANES / 2, name


def test_nothing_loads_it_unasked():
    code = "import sys, pendular, pendular.table.table; assert 'numba.cuda' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
