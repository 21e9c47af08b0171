"""The cohesion model for LIGGGHTS: built against an installed one, run, and compared with the table and exact bridges.

apt-get install -y --no-install-recommends liggghts libliggghts-dev libopenmpi-dev g++ make
"""

import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from tools.code_blocks import code_blocks

import pendular as pl
from pendular.codes.c_header import table_header
from pendular.codes.liggghts import FILES

SEED = 1914
ROOT = Path(__file__).parents[1]
EXAMPLE = ROOT / "examples" / "liggghts" / "in.pull"
HEADERS = Path("/usr/include/liggghts")
TENSION, SUCTION, VOLUME = 0.0728, 5e3, 2e-16
ANGLES = {"equal": math.radians(20), "two": (math.radians(10), math.radians(40))}
needs_liggghts = pytest.mark.skipif(
    not HEADERS.is_dir() or not shutil.which("mpicxx.openmpi") or not shutil.which("make"),
    reason="LIGGGHTS and its headers, mpicxx.openmpi or make are not installed",
)

SCENE = """
units si
atom_style granular
atom_modify map array
boundary f f f
newton {newton}
communicate single vel yes
region box block -2e-3 2e-3 -2e-3 2e-3 -2e-3 2e-3 units box
create_box 2 box
neighbor 2e-5 bin
neigh_modify delay 0
{atoms}
fix m1 all property/global youngsModulus peratomtype 5e6 5e6
fix m2 all property/global poissonsRatio peratomtype 0.3 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5
fix m4 all property/global coefficientFriction peratomtypepair 2 0.5 0.5 0.5 0.5
fix tension all property/global surfaceTension scalar {tension}
fix held all property/global {held} scalar {value}
pair_style gran model hertz tangential history cohesion pendular
pair_coeff * *
{walls}
timestep 1e-7
fix pull upper move linear 0 0 0.2 units box
thermo_style custom step
dump d all custom 10 dump.pull id z fz
dump_modify d format "%d %.17g %.17g" sort id
"""


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    """LIGGGHTS with the model, as the command and make build it."""
    from pendular.front.cli import main

    folder = tmp_path_factory.mktemp("model")
    with pytest.raises(SystemExit) as end:
        main(["export", "liggghts", "--out", str(folder)])
    assert end.value.code == 0
    warned = "-std=c++11 -O2 -Wall -Wextra -Werror"
    made = subprocess.run(["make", f"CXXFLAGS={warned}"], cwd=folder, check=False, capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    return folder / "liggghts_pendular"


def simulated(program, folder, script, ranks=1):
    """Run a script in a folder; what it said."""
    (folder / "in.scene").write_text(script)
    command = [program, "-in", "in.scene"]
    if ranks > 1:
        allowed = ("--allow-run-as-root", "--oversubscribe")
        command = ["mpirun.openmpi", *allowed, "-n", str(ranks), *command]
    told = {"capture_output": True, "text": True, "errors": "replace"}  # errors of LIGGGHTS are garbled by chance
    return subprocess.run(command, cwd=folder, check=False, timeout=120, **told)


def frames(folder):
    """Heights and forces of a dump: (frames, atoms)."""
    numbers, wanted = [], False
    for line in (folder / "dump.pull").read_text().splitlines():
        if line.startswith("ITEM"):
            wanted = line.startswith("ITEM: ATOMS")
        elif wanted:
            numbers.append([float(word) for word in line.split()])
    table = np.array(numbers).reshape(-1, int(max(row[0] for row in numbers)), 3)
    return table[..., 1], table[..., 2]


def save_tables(folder, held, angles):
    """Tables of two types: one for all, or one for each pair of types."""
    control = "volume" if held == "volume" else "suction"
    ranges = {"reduced": (1e-4, 0.05)} if control == "volume" else {"reduced": (0.5, 50.0)}
    made = {}
    for i, j in ((1, 1), (1, 2), (2, 2)):
        theta = ANGLES["equal"] if angles == "equal" else (ANGLES["two"][i - 1], ANGLES["two"][j - 1])
        if angles != "equal" or not made:
            made[i, j] = pl.tabulate(theta, control, tolerance=1e-6, **ranges)
        else:
            made[i, j] = made[1, 1]
        made[i, j].save(folder / ("pendular.bridges" if angles == "equal" else f"pendular_{i}_{j}.bridges"))
    return made


def atoms_of(rows):
    """Grains of a list of (type, place, radius)."""
    lines = [f"create_atoms {kind} single {x:.9g} {y:.9g} {z:.17g} units box" for kind, (x, y, z), _ in rows]
    lines += [f"set atom {i} diameter {2 * r:.17g} density 2650" for i, (_, _, r) in enumerate(rows, 1)]
    return "\n".join(lines)


def scene_of(rows, upper, held, value, newton="off", walls=""):
    atoms = f"{atoms_of(rows)}\ngroup upper id {' '.join(map(str, upper))}"
    words = {"newton": newton, "atoms": atoms, "tension": TENSION, "value": value, "walls": walls}
    return SCENE.format(held="bridgeVolume" if held == "volume" else "bridgeSuction", **words)


# The command and the files -----------------------------------------------------------------------------------------


def test_the_command_tells_what_it_wrote(run, tmp_path):
    code, told, _ = run("export", "liggghts", "--out", tmp_path / "new" / "model")
    assert code == 0
    names = [*FILES, "pendular_table.h"]
    assert [line.split(":")[0] for line in told.splitlines()] == [str(tmp_path / "new" / "model" / n) for n in names]
    assert (tmp_path / "new" / "model" / "pendular_table.h").read_text() == table_header()
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
def test_pairs_have_the_force_of_the_table_up_to_rupture(program, held, angles, ranks, tmp_path):
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
    script = scene_of(rows, range(2, 2 * count + 1, 2), held, value) + "run 3000\n"
    done = simulated(program, tmp_path, script, ranks)
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
def test_grains_have_bridges_with_flat_walls(program, held, tmp_path):
    table = save_tables(tmp_path, held, "equal")[1, 1]
    value = VOLUME if held == "volume" else SUCTION
    radii = [25e-6, 30e-6, 40e-6]
    rows = [(1, (3e-4 * i, 0.0, r * (1.0 - 1e-4)), r) for i, r in enumerate(radii)]
    rows.append((1, (-9e-4, 0.0, 26e-6), 25e-6))  # near, and never in touch
    floor = "fix floor all wall/gran model hertz tangential history cohesion pendular primitive type 2 zplane 0.0"
    done = simulated(program, tmp_path, scene_of(rows, range(1, 5), held, value, walls=floor) + "run 2000\n")
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
def test_all_models_beside_it_have_the_same_bridges(program, tmp_path):
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    rows = [(1, (0.0, 0.0, 0.0), 50e-6), (1, (0.0, 0.0, 99.99e-6), 50e-6)]
    for normal in ("hertz", "hooke"):
        slip, grip = "tangential no_history ", "tangential history "
        beside = (("", ""), (slip, ""), (grip, ""), (grip, " rolling_friction cdt"), (grip, " rolling_friction epsd2"))
        for tangential, rolling in beside:
            script = scene_of(rows, (2,), "suction", SUCTION) + "run 50\n"
            fixes = "fix r1 all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 0.1 0.1\n"
            fixes += "fix r2 all property/global characteristicVelocity scalar 1.0\npair_style"
            script = script.replace("pair_style", fixes)
            model = f"{normal} {tangential}cohesion pendular{rolling}"
            script = script.replace("hertz tangential history cohesion pendular", model)
            done = simulated(program, tmp_path, script)
            assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
            assert "unoptimized" not in done.stdout
            z, force = frames(tmp_path)
            expected = table.force(z[-1, 1] - z[-1, 0] - 100e-6, SUCTION, 50e-6, 50e-6, TENSION)
            assert force[-1, 0] == pytest.approx(expected, rel=1e-9), model


@needs_liggghts
@pytest.mark.long
def test_the_suction_may_change_between_two_runs(program, tmp_path):
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    rows = [(1, (0.0, 0.0, 0.0), 50e-6), (1, (0.0, 0.0, 99.99e-6), 50e-6)]
    anew = f"fix held all property/global bridgeSuction scalar {2 * SUCTION}\n"
    script = scene_of(rows, (2,), "suction", SUCTION) + f"run 50\n{anew}run 50\n"
    done = simulated(program, tmp_path, script)
    assert done.returncode == 0, done.stdout[-2000:]
    z, force = frames(tmp_path)
    gap = z[:, 1] - z[:, 0] - 100e-6
    for frame, suction in ((4, SUCTION), (-1, 2 * SUCTION)):
        expected = table.force(gap[frame], suction, 50e-6, 50e-6, TENSION)
        assert force[frame, 0] == pytest.approx(expected, rel=1e-9)


@needs_liggghts
@pytest.mark.long
def test_a_bridge_outlives_a_restart(program, tmp_path):
    save_tables(tmp_path, "suction", "equal")
    rows = [(1, (0.0, 0.0, 0.0), 50e-6), (1, (0.0, 0.0, 99.99e-6), 50e-6), (1, (5e-4, 0.0, 0.0), 50e-6)]
    rows.append((1, (5e-4, 0.0, 100.5e-6), 50e-6))
    script = scene_of(rows, (2, 4), "suction", SUCTION)
    assert simulated(program, tmp_path, script + "run 100\nwrite_restart half\nrun 100\n").returncode == 0
    whole = frames(tmp_path)
    _, _, setting = script.partition("fix m1")
    again = "atom_style granular\natom_modify map array\nnewton off\ncommunicate single vel yes\nread_restart half\n"
    again += f"neighbor 2e-5 bin\nneigh_modify delay 0\ngroup upper id 2 4\nfix m1{setting}run 100\n"
    done = simulated(program, tmp_path, again)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    z, force = frames(tmp_path)
    assert np.array_equal(force[:, 2:], np.zeros_like(force[:, 2:]))
    np.testing.assert_allclose(z[-1], whole[0][-1], rtol=1e-12, atol=1e-20)
    np.testing.assert_allclose(force[-1], whole[1][-1], rtol=1e-9)
    assert force[-1, 0] > 1e-6


# Refused -----------------------------------------------------------------------------------------------------------


@needs_liggghts
@pytest.mark.long
def test_what_cannot_be_is_refused_in_one_line(program, tmp_path):
    rows = [(1, (0.0, 0.0, 0.0), 50e-6), (2, (0.0, 0.0, 99.99e-6), 50e-6)]
    script = scene_of(rows, (2,), "suction", SUCTION) + "run 10\n"

    def reason(text=script):
        done = simulated(program, tmp_path, text)
        assert done.returncode != 0
        (line,) = [line for line in done.stderr.splitlines() if line.startswith("cohesion model pendular: ")]
        return line.partition("cohesion model pendular: ")[2]

    assert reason() == "pendular.bridges: the file cannot be read"
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    assert simulated(program, tmp_path, script).returncode == 0
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
    corners = "\n".join(f"vertex {x} {y} -49.9e-6" for x, y in ((-1e-3, -1e-3), (1e-3, -1e-3), (0.0, 1e-3)))
    facet = f"facet normal 0 0 1\nouter loop\n{corners}\nendloop\nendfacet"
    (tmp_path / "floor.stl").write_text(f"solid floor\n{facet}\nendsolid floor\n")
    wall = "fix wall all wall/gran model hertz tangential history cohesion pendular mesh n_meshes 1 meshes floor"
    floor = f"fix floor all mesh/surface file floor.stl type 1\n{wall}\ntimestep"
    assert reason(script.replace("timestep", floor)).startswith("a wall is a plane, primitive xplane")
    assert simulated(program, tmp_path, script.replace("hertz", "hooke/stiffness")).returncode != 0


# The page ----------------------------------------------------------------------------------------------------------


def test_the_lines_of_the_page_are_those_of_the_example():
    block, _ = [each for each in code_blocks((ROOT / "docs" / "liggghts.md").read_text()) if each.language == "text"]
    script = [line.split() for line in EXAMPLE.read_text().splitlines()]
    assert all(line.split() in script for line in block.code.splitlines())


@needs_liggghts
@pytest.mark.long
def test_the_example_runs_as_it_says(program, tmp_path):
    table = pl.tabulate(math.radians(20), reduced=(1.0, 100.0), tolerance=1e-5)
    table.save(tmp_path / "pendular.bridges")
    done = simulated(program, tmp_path, EXAMPLE.read_text())
    assert done.returncode == 0, done.stdout[-2000:]
    gap, force = np.loadtxt(tmp_path / "pull.txt", skiprows=1).T
    grains, water = pl.Pair((50e-6, 100e-6), math.radians(20)), pl.Liquid(0.0728)
    exact = pl.bridge(grains, gap, suction=5e3, liquid=water).force
    np.testing.assert_allclose(force, exact, rtol=1e-4, atol=1e-12)
    assert np.any(force == 0.0)
    assert np.any(force > 2e-5)
