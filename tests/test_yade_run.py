"""YADE itself, run with the tables that are written for it.

    apt-get install -y --no-install-recommends yade && uv run --group test pytest -m yade

A crash of YADE leaves no answer, and a missing table is a mere warning of its: what counts are the forces that it
reports.
"""

import json
import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import pendular as pl
from pendular.codes import yade

pytestmark = [
    pytest.mark.yade,
    pytest.mark.long,
    pytest.mark.skipif(
        shutil.which("yade") is None,
        reason="YADE is not installed: apt-get install -y --no-install-recommends yade",
    ),
]

SCRIPTS = Path(__file__).parent / "yade_scripts"
GAMMA = 0.073
SMALL = 1e-4  # radius of the smaller sphere, [m]
ANGLES = {"": 0.0, "_th20": math.radians(20), "_th60": math.radians(60)}  # by the suffix of the tables
TOLERANCES = {"": 4e-3, "_th20": 1e-3, "_th60": 4e-3}
SUCTIONS = (1.0, 300.0, 5e3, 3e5)  # [Pa]; reduced 1e-3 to 4e3


def run(script, folder, **files):
    """Run a script in a folder with some files of JSON beside it, and return what it found."""
    for name, content in files.items():
        (folder / f"{name}.json").write_text(json.dumps(content))
    done = subprocess.run(
        ["yade", "-n", "-x", str(SCRIPTS / script)],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    found = folder / "found.json"
    assert found.is_file(), f"YADE ended with {done.returncode}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}"
    answer = json.loads(found.read_text())
    found.unlink()
    return answer


@pytest.fixture(scope="module")
def tables(tmp_path_factory):
    """Folder with a set for each contact angle."""
    folder = tmp_path_factory.mktemp("tables")
    for suffix, theta in ANGLES.items():
        yade.export(folder, theta, suffix=suffix, tolerance=TOLERANCES[suffix])
    return folder


@pytest.fixture(scope="module")
def bridges(tables):
    """For each suffix: ratios, fractions of the rupture distance, bridges as YADE reports them, and where they are."""
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    ratios = [*yade.RATIOS, 1.3, 7.0, 10.5]
    cases, asked = [], {}
    for suffix, theta in ANGLES.items():
        # The gaps are laid for one suction and asked at all: at the others they are in and beyond the bridge as well.
        held = random.permutation(np.repeat(SUCTIONS, 4))[: len(ratios)]
        pair = pl.Pair((SMALL, SMALL * np.array(ratios)), theta)
        ruptures = pl.rupture(pair, suction=held, liquid=pl.Liquid(GAMMA)).separation
        fractions = np.concatenate([[-0.01, 0.0], random.uniform(0.0, 1.0, 8), [0.98, 1.03]])
        gaps = np.asarray(ruptures)[:, None] * fractions
        pairs = [
            {"radius1": SMALL, "radius2": SMALL * ratio, "separations": row.tolist()}
            for ratio, row in zip(ratios, gaps, strict=True)
        ]
        cases.append({"suffix": suffix, "pairs": pairs, "suctions": SUCTIONS, "surface_tension": GAMMA})
        asked[suffix] = np.array(ratios), gaps.T
    found = iter(run("two_grains.py", tables, cases=cases))
    answers = {}
    for suffix, (radii, gaps) in asked.items():
        rows = [next(found) for _ in range(len(SUCTIONS) * gaps.size)]
        answers[suffix] = radii, gaps, np.array(rows).reshape(len(SUCTIONS), *gaps.shape, 6)
    return answers


@pytest.mark.parametrize("suffix", ANGLES)
def test_the_emulation_is_yade_to_rounding(suffix, tables, bridges):
    ratios, gaps, found = bridges[suffix]
    read = [yade.read_table(tables / yade.table_name(ratio, suffix)) for ratio in yade.RATIOS]
    suctions = np.array(SUCTIONS)[:, None, None]
    emulated = yade.yade_bridge(read, SMALL, SMALL * ratios, gaps, suction=suctions, surface_tension=GAMMA)
    # 5e-13 off, the rounding of gaps that YADE computes from positions
    for i, name in enumerate(emulated._fields):
        np.testing.assert_allclose(found[..., i], emulated[i], rtol=1e-10, atol=0.0, err_msg=name)
    assert 0.05 < np.mean(found[..., 0] == 0.0) < 0.7


@pytest.mark.parametrize("suffix", ANGLES)
def test_yade_has_the_exact_bridges_at_the_ten_ratios(suffix, bridges):
    ratios, gaps, found = bridges[suffix]
    count = len(yade.RATIOS)
    ratios, gaps, found = ratios[:count], np.maximum(gaps[:, :count], 0.0), found[:, :, :count]
    pair = pl.Pair((SMALL, SMALL * ratios), ANGLES[suffix])
    held = {"suction": np.array(SUCTIONS)[:, None, None], "liquid": pl.Liquid(GAMMA)}
    tolerance = TOLERANCES[suffix]
    exact, contact, end = pl.bridge(pair, gaps, **held), pl.bridge(pair, 0.0, **held), pl.rupture(pair, **held)
    fraction = gaps / end.separation
    inside = fraction < 0.9801
    force, volume, delta1, delta2, nn11, nn33 = np.moveaxis(found, -1, 0)

    def largest(difference, scale):
        return np.max((np.abs(difference) / scale)[inside])

    assert largest(force - exact.force, contact.force) < tolerance
    assert largest(volume - exact.volume, contact.volume) < 10 * tolerance
    assert largest(nn11 - exact.capillary_tensor[..., 0], contact.liquid_gas_area) < 10 * tolerance
    assert largest(nn33 - exact.capillary_tensor[..., 1], contact.liquid_gas_area) < 10 * tolerance
    angles = np.rad2deg(exact.half_filling_angle)
    assert largest(delta1 - np.minimum(angles[..., 0], 90.0), 1.0) < 100 * tolerance
    assert largest(delta2 - angles[..., 1], 1.0) < 100 * tolerance
    assert np.all(force[fraction > 1.01] == 0.0)
    assert np.all(force[fraction < 0.99] > 0.0)


def test_between_the_ratios_and_above_ten(bridges):
    ratios, _, found = bridges[""]
    assert ratios[-1] == 10.5
    assert np.all(found[..., -1, :] == 0.0)  # no table, no word
    assert np.all(found[:, :2, -2, 0] > 0.0)


def test_without_suction_beyond_the_table_and_without_tables_there_is_no_force(tables, tmp_path):
    pairs = [{"radius1": SMALL, "radius2": SMALL, "separations": [-1e-7, 0.0]}]
    case = {"suffix": "", "pairs": pairs, "suctions": [0.0, -50.0, 1e8, 5e3], "surface_tension": GAMMA}
    force = np.array(run("two_grains.py", tables, cases=[case]))[:, 0]
    assert np.all(force[:-2] == 0.0)
    assert np.all(force[-2:] > 0.0)
    assert np.all(np.array(run("two_grains.py", tmp_path, cases=[case]))[:, 0] == 0.0)


def test_the_engine_of_points_has_the_exact_bridges(tables):
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    theta, count = ANGLES["_th20"], 20000
    smaller = np.where(random.random(count) < 0.2, 1.0, 10.0 ** random.uniform(-1.0, 0.0, count))
    suctions, fractions = 10.0 ** random.uniform(-2.0, 4.0, count), random.uniform(0.0, 1.0, count)
    gaps = fractions * yade.exact_rupture(1.0 / smaller, theta, suctions)
    exact, contact = (yade.exact_rows(1.0 / smaller, theta, gap, suctions) for gap in (gaps, 0.0))
    in_contact = [-0.09, -1e-6, 0.0]
    asked = {"path": "capillaryfile_th20.txt", "queries": np.column_stack([smaller, suctions, gaps]).tolist()}
    answer = run("points.py", tables, queries=asked | {"gaps": in_contact})
    force, volume = np.array(answer["alone"]).T
    error = np.abs(force / (2.0 * np.pi) - exact[:, 3]) / contact[:, 3]
    inner, outer = fractions < 0.8, (fractions >= 0.8) & (fractions < 0.98)
    print(f"force to 0.8 of rupture {error[inner].max():.2%}, to 0.98 {error[outer].max():.2%}")
    assert error[inner].max() < 0.005
    assert error[outer].max() < 0.08
    assert np.quantile(error[outer], 0.99) < 0.03
    assert np.max(np.abs(volume - exact[:, 2])[inner] / contact[inner, 2]) < 0.01
    held = pl.bridge(pl.Pair(1.0, theta), 0.0, suction=1.0, liquid=pl.Liquid(1.0))
    np.testing.assert_allclose(answer["simulated"], held.force, rtol=1e-4)  # also where the spheres overlap


def test_the_example_follows_the_exact_curve(tables):
    """With the tables for a contact angle of 0, which have no suffix."""
    example = Path(__file__).parents[1] / "examples" / "yade_pull.py"
    subprocess.run(["yade", "-n", "-x", str(example)], cwd=tables, capture_output=True, timeout=300, check=False)
    separation, force, _ = np.loadtxt(tables / "pull.csv", delimiter=",", skiprows=1).T
    held = {"suction": 5e3, "liquid": pl.Liquid(0.0728)}
    grains = pl.Pair((50e-6, 100e-6), 0.0)
    end, contact = pl.rupture(grains, **held).separation, pl.bridge(grains, 0.0, **held).force
    turn = int(np.argmin(separation))
    assert np.all(force[:turn][separation[:turn] > 0.0] == 0.0)  # no bridge before contact
    apart, pulled = separation[turn:], force[turn:]
    near = apart < 0.98 * end
    exact = pl.bridge(grains, np.maximum(apart[near], 0.0), **held).force
    assert np.max(np.abs(pulled[near] - exact)) < TOLERANCES[""] * contact
    assert np.all(pulled[apart > 1.01 * end] == 0.0)
