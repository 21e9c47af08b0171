"""The cohesion model for LIGGGHTS: built against an installed one, run, and compared with the table and exact bridges.

apt-get install -y --no-install-recommends liggghts libliggghts-dev libopenmpi-dev g++ make
"""

import math
from pathlib import Path

import numpy as np
import pytest
from tools.code_blocks import code_blocks

import pendular as pl
from in_liggghts import (
    ANGLES,
    SUCTION,
    TENSION,
    VOLUME,
    frames,
    needs_liggghts,
    resumed,
    save_tables,
    scene_of,
    simulated,
)
from pendular.codes.c_header import headers
from pendular.codes.liggghts import FILES

SEED = 1914
ROOT = Path(__file__).parents[1]
EXAMPLE = ROOT / "examples" / "liggghts" / "in.pull"


# The command and the files -----------------------------------------------------------------------------------------


def test_the_command_tells_what_it_wrote(run, tmp_path):
    code, told, _ = run("export", "liggghts", "--out", tmp_path / "new" / "model")
    assert code == 0
    names = [*FILES, *headers()]
    assert [line.split(":")[0] for line in told.splitlines()] == [str(tmp_path / "new" / "model" / n) for n in names]
    assert all((tmp_path / "new" / "model" / name).read_bytes() == text for name, text in headers().items())
    (tmp_path / "file").touch()
    code, told, error = run("export", "liggghts", "--out", tmp_path / "file")
    assert (code, told) == (2, "")
    assert error == f"pendular: out: '{tmp_path / 'file'}' cannot be written: File exists\n"


# Pairs and walls ---------------------------------------------------------------------------------------------------


@needs_liggghts
@pytest.mark.long
@pytest.mark.parametrize(
    ("held", "angles", "ranks"),
    [("suction", "equal", 1), ("suction", "equal", 2), ("suction", "two", 1), ("volume", "equal", 1)],
)
def test_pairs_have_the_force_of_the_table_up_to_rupture(liggghts, held, angles, ranks, tmp_path):
    """Pairs that touch have a bridge until it breaks; those that start apart have none."""
    tables = save_tables(tmp_path, held, angles)
    value = VOLUME if held == "volume" else SUCTION
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    count = 12
    rows, radii, kinds = [], [], []
    for i in range(count):
        r1, r2 = random.uniform(20e-6, 40e-6, 2) if held == "volume" else random.uniform(20e-6, 100e-6, 2)
        gap = -1e-4 * min(r1, r2) if i % 3 else 1e-6
        kind = random.integers(1, 3, 2)
        x, y = -1.5e-3 + 1e-3 * (i % 4), -1.2e-3 + 1e-3 * (i // 4)
        rows += [(kind[0], (x, y, 0.0), r1), (kind[1], (x, y, r1 + r2 + gap), r2)]
        radii.append((r1, r2))
        kinds.append(kind)
    script = scene_of(rows, held, value, upper=range(2, 2 * count + 1, 2)) + "run 3000\n"
    done = simulated(liggghts, tmp_path, script, ranks)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    z, force = frames(tmp_path)
    assert np.array_equal(force[:, 0::2], -force[:, 1::2])
    broken = 0
    for i, ((r1, r2), kind) in enumerate(zip(radii, kinds, strict=True)):
        gap = z[:, 2 * i + 1] - z[:, 2 * i] - r1 - r2
        found, apart = force[:, 2 * i], gap > 0.0
        if i % 3 == 0:
            assert np.all(found == 0.0), "a pair that never touched has a bridge"
            continue
        first = kind[0] <= kind[1]
        ordered = (r1, r2) if first else (r2, r1)
        table = tables[tuple(sorted(map(int, kind)))]
        expected = table.force(gap, value, *ordered, TENSION)
        unit = table.force(0.0, value, *ordered, TENSION)
        end = table.rupture_distance(value, *ordered, TENSION)
        clear = apart & (np.abs(gap / end - 1.0) > 1e-5)
        assert clear.sum() > 50
        assert np.abs(found - expected)[clear].max() < 1e-9 * unit
        broken += int(np.any(expected[clear] == 0.0))
        grains = pl.Pair(ordered, tuple(table.contact_angle))
        inside = clear & (gap < 0.99 * end)
        exact = pl.bridge(grains, gap[inside], **{held: value}, liquid=pl.Liquid(TENSION)).force
        assert np.abs(found[inside] - exact).max() < 1e-5 * unit
    assert broken >= 4


@needs_liggghts
@pytest.mark.long
@pytest.mark.parametrize("held", ["suction", "volume"])
def test_grains_have_bridges_with_flat_walls(liggghts, held, tmp_path):
    table = save_tables(tmp_path, held, "equal")[1, 1]
    value = VOLUME if held == "volume" else SUCTION
    radii = [25e-6, 30e-6, 40e-6]
    rows = [(1, (3e-4 * i, 0.0, r * (1.0 - 1e-4)), r) for i, r in enumerate(radii)]
    rows.append((1, (-9e-4, 0.0, 26e-6), 25e-6))  # near, and never in touch
    floor = "fix floor all wall/gran model hertz tangential history cohesion pendular primitive type 2 zplane 0.0"
    done = simulated(liggghts, tmp_path, scene_of(rows, held, value, upper=range(1, 5), walls=floor) + "run 2000\n")
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    z, force = frames(tmp_path)
    assert np.all(force[:, 3] == 0.0)
    for i, r in enumerate(radii):
        gap = z[:, i] - r
        end = table.rupture_distance(value, r, math.inf, TENSION)
        expected = table.force(gap, value, r, math.inf, TENSION)
        clear = (gap > 0.0) & (np.abs(gap / end - 1.0) > 1e-5)
        unit = table.force(0.0, value, r, math.inf, TENSION)
        assert np.abs(-force[:, i] - expected)[clear].max() < 1e-9 * unit
        assert np.any(expected[clear] == 0.0)
        assert np.any(expected[clear] > 0.0)


@needs_liggghts
@pytest.mark.long
def test_all_models_beside_it_have_the_same_bridges(liggghts, tmp_path):
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    rows = [(1, (0.0, 0.0, 0.0), 50e-6), (1, (0.0, 0.0, 99.99e-6), 50e-6)]
    for normal in ("hertz", "hooke"):
        slip, grip = "tangential no_history ", "tangential history "
        beside = (("", ""), (slip, ""), (grip, ""), (grip, " rolling_friction cdt"), (grip, " rolling_friction epsd2"))
        for tangential, rolling in beside:
            script = scene_of(rows, "suction", SUCTION, upper=(2,)) + "run 50\n"
            fixes = "fix r1 all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1\n"
            fixes += "fix r2 all property/global characteristicVelocity scalar 1.0\npair_style"
            script = script.replace("pair_style", fixes)
            model = f"{normal} {tangential}cohesion pendular{rolling}"
            script = script.replace("hertz tangential history cohesion pendular", model)
            done = simulated(liggghts, tmp_path, script)
            assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
            assert "unoptimized" not in done.stdout
            z, force = frames(tmp_path)
            expected = table.force(z[-1, 1] - z[-1, 0] - 100e-6, SUCTION, 50e-6, 50e-6, TENSION)
            assert force[-1, 0] == pytest.approx(expected, rel=1e-9), model


@needs_liggghts
@pytest.mark.long
def test_the_suction_may_change_between_two_runs(liggghts, tmp_path):
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    rows = [(1, (0.0, 0.0, 0.0), 50e-6), (1, (0.0, 0.0, 99.99e-6), 50e-6)]
    anew = f"fix held all property/global bridgeSuction scalar {2 * SUCTION}\n"
    script = scene_of(rows, "suction", SUCTION, upper=(2,)) + f"run 50\n{anew}run 50\n"
    done = simulated(liggghts, tmp_path, script)
    assert done.returncode == 0, done.stdout[-2000:]
    z, force = frames(tmp_path)
    gap = z[:, 1] - z[:, 0] - 100e-6
    for frame, suction in ((4, SUCTION), (-1, 2 * SUCTION)):
        expected = table.force(gap[frame], suction, 50e-6, 50e-6, TENSION)
        assert force[frame, 0] == pytest.approx(expected, rel=1e-9)


@needs_liggghts
@pytest.mark.long
def test_a_bridge_outlives_a_restart(liggghts, tmp_path):
    save_tables(tmp_path, "suction", "equal")
    rows = [(1, (0.0, 0.0, 0.0), 50e-6), (1, (0.0, 0.0, 99.99e-6), 50e-6), (1, (5e-4, 0.0, 0.0), 50e-6)]
    rows.append((1, (5e-4, 0.0, 100.5e-6), 50e-6))
    script = scene_of(rows, "suction", SUCTION, upper=(2, 4))
    assert simulated(liggghts, tmp_path, script + "run 100\nwrite_restart half\nrun 100\n").returncode == 0
    whole = frames(tmp_path)
    again = resumed(script).replace("fix m1", "group upper id 2 4\nfix m1") + "run 100\n"
    done = simulated(liggghts, tmp_path, again)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    z, force = frames(tmp_path)
    assert np.array_equal(force[:, 2:], np.zeros_like(force[:, 2:]))
    np.testing.assert_allclose(z[-1], whole[0][-1], rtol=1e-12, atol=1e-20)
    np.testing.assert_allclose(force[-1], whole[1][-1], rtol=1e-9)
    assert force[-1, 0] > 1e-6


# Refused -----------------------------------------------------------------------------------------------------------


@needs_liggghts
@pytest.mark.long
def test_what_cannot_be_is_refused_in_one_line(liggghts, tmp_path):
    rows = [(1, (0.0, 0.0, 0.0), 50e-6), (2, (0.0, 0.0, 99.99e-6), 50e-6)]
    script = scene_of(rows, "suction", SUCTION, upper=(2,)) + "run 10\n"

    def reason(text=script):
        done = simulated(liggghts, tmp_path, text)
        assert done.returncode != 0
        (line,) = [line for line in done.stderr.splitlines() if line.startswith("cohesion model pendular: ")]
        return line.partition("cohesion model pendular: ")[2]

    assert reason() == "pendular.bridges: the file cannot be read"
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    assert simulated(liggghts, tmp_path, script).returncode == 0
    content = (tmp_path / "pendular.bridges").read_bytes()
    (tmp_path / "pendular.bridges").write_bytes(content[:-8])
    assert reason() == "pendular.bridges: it is shorter or longer than it says"
    (tmp_path / "pendular.bridges").write_bytes(content)
    told = reason(script.replace(f"scalar {SUCTION}", "scalar 5e5"))
    assert told.startswith("the bridgeSuction 500000 with radii 5e-05 and 5e-05 and surface tension 0.0728 is out of")
    two = pl.tabulate(ANGLES["two"], reduced=table.reduced, tolerance=1e-3)
    two.save(tmp_path / "pendular_1_1.bridges")
    assert reason() == "solids of one type 1 have one contact angle, but their table has two"
    (tmp_path / "pendular_1_1.bridges").unlink()
    assert simulated(liggghts, tmp_path, script.replace("hertz", "hooke/stiffness")).returncode != 0


# The page ----------------------------------------------------------------------------------------------------------


def test_the_lines_of_the_page_are_those_of_the_examples():
    blocks = [each.code for each in code_blocks((ROOT / "docs" / "liggghts.md").read_text()) if each.language == "text"]
    for code, example in zip(blocks[:2], (EXAMPLE, EXAMPLE.with_name("in.film")), strict=True):
        script = [line.split() for line in example.read_text().splitlines()]
        assert all(line.split() in script for line in code.splitlines())


@needs_liggghts
@pytest.mark.long
def test_the_example_runs_as_it_says(liggghts, tmp_path):
    table = pl.tabulate(math.radians(20), reduced=(1.0, 100.0), tolerance=1e-5)
    table.save(tmp_path / "pendular.bridges")
    done = simulated(liggghts, tmp_path, EXAMPLE.read_text())
    assert done.returncode == 0, done.stdout[-2000:]
    gap, force = np.loadtxt(tmp_path / "pull.txt", skiprows=1).T
    grains, water = pl.Pair((50e-6, 100e-6), math.radians(20)), pl.Liquid(0.0728)
    exact = pl.bridge(grains, gap, suction=5e3, liquid=water).force
    np.testing.assert_allclose(force, exact, rtol=1e-4, atol=1e-12)
    assert np.any(force == 0.0)
    assert np.any(force > 2e-5)
