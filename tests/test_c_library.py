"""The exact solver as a library for C: its numbers beside Python's, what it refuses, and programs that link it."""

import ctypes
import math
import re
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from tools.code_blocks import code_blocks

import pendular as pl
from pendular.exact import batch
from pendular.exact.equations import SUCTION, VOLUME
from pendular.exact.state import State
from pendular.front.cli import main
from pendular.ground.rows import by_machine_code

pytestmark = pytest.mark.needs("numba")

SEED = 1911
ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples" / "library"
WARNINGS = ("-Wall", "-Wextra", "-Werror", "-pedantic")
FOUND, NO_BRIDGE, FAILED, BAD_INPUT = range(4)
CONTROLS = {"suction": SUCTION, "volume": VOLUME}
PAIR = (50e-6, 80e-6, 0.3, 0.6, 0.0728)
# Of the C library, all of which any C compiler has.
MATHEMATICS = {
    "atan",
    "atan2",
    "cbrt",
    "cos",
    "exp",
    "expm1",
    "hypot",
    "log",
    "log1p",
    "pow",
    "sin",
    "sincos",
    "sqrt",
    "tan",
}


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The folder that the command writes."""
    folder = tmp_path_factory.mktemp("library") / "lib"
    with pytest.raises(SystemExit) as end:
        main(["export", "library", "--out", str(folder)])
    assert end.value.code == 0
    return folder


@pytest.fixture(scope="module")
def library(written):
    """The shared library, called with arrays."""
    path = written / "libpendular.so"
    if not path.exists():
        pytest.skip("no C compiler to link a shared library")
    return Library(path)


class Library:
    """Functions of the library on arrays of rows."""

    def __init__(self, path: Path) -> None:
        self.loaded = ctypes.CDLL(str(path))

    def rows(self, name, control, *inputs, states=None):
        """States and statuses of rows."""
        arrays = [np.ascontiguousarray(each, float) for each in inputs]
        count = len(arrays[0])
        states = np.full((count, len(State._fields)), 7.0) if states is None else states
        statuses = np.full(count, -1, np.int32)
        pointers = [ctypes.c_void_p(array.ctypes.data) for array in (*arrays, states, statuses)]
        worst = self.loaded[name](control, ctypes.c_size_t(count), *pointers)
        assert worst == statuses.max(initial=0)
        return states, statuses

    def one(self, name, control, *numbers, pair, state=None):
        """State and status of one question."""
        pair, state = np.array(pair, float), np.full(len(State._fields), 7.0) if state is None else state
        pointers = [ctypes.c_void_p(array.ctypes.data) for array in (pair, state)]
        status = self.loaded[name](control, *map(ctypes.c_double, numbers), *pointers)
        return State(*state.tolist()), status


def questions(control, count, seed=SEED):
    """Random reduced pairs, mirror images and planes among them: held values and pairs, with a smaller radius of 1."""
    print(f"seed {seed}")
    random = np.random.default_rng(seed + control)
    other = 10.0 ** random.uniform(0.0, 3.0, count)
    other[: count // 4], other[-count // 8 :] = 1.0, math.inf
    angles = random.uniform(0.0, 1.4, (2, count))
    angles[1, : count // 3] = angles[0, : count // 3]
    held = 10.0 ** (random.uniform(-7, 0, count) if control == VOLUME else random.uniform(-2, 4, count))
    return held, np.column_stack([np.ones(count), other, *angles, np.ones(count)])


def asked_of_python(asked, control, gap, held, pairs):
    """States in machine code, with the force and the stiffness of a surface tension of 1."""
    rows = np.column_stack([gap, held, 1.0 / pairs[:, 0], pairs[:, 2], 1.0 / pairs[:, 1], pairs[:, 3]])
    with by_machine_code():
        states, statuses = batch.answer(asked, control, rows)
    for name in ("force", "stiffness"):
        states[:, State._fields.index(name)] *= 2.0 * math.pi
    return states, statuses


# Numbers -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("control", CONTROLS.values(), ids=CONTROLS)
def test_it_is_equal_to_python(library, control):
    """Rows to the last bit."""
    held, pairs = questions(control, 3000)
    ends, statuses = library.rows("pendular_ruptures", control, held, pairs)
    expected, wanted = asked_of_python(batch.RUPTURE, control, np.zeros(len(held)), held, pairs)
    assert np.array_equal(statuses, wanted)
    assert np.array_equal(ends, expected, equal_nan=True)
    random = np.random.default_rng(SEED)
    gap = np.where(statuses == FOUND, ends[:, 0], 0.1) * random.uniform(0.0, 1.02, len(held))
    states, statuses = library.rows("pendular_bridges", control, gap, held, pairs)
    expected, wanted = asked_of_python(batch.STABLE, control, gap, held, pairs)
    assert np.array_equal(statuses, wanted)
    assert np.array_equal(states, expected, equal_nan=True)
    assert {FOUND, NO_BRIDGE} <= set(statuses.tolist())
    assert np.isnan(states[statuses != FOUND]).all()


@pytest.mark.parametrize("control", CONTROLS)
def test_si_units_are_those_of_python(library, control):
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    fields = {
        "separation": "separation", "force": "force", "volume": "volume", "liquid_gas_area": "area",
        "stiffness": "stiffness", "neck_radius": "neck_radius",
    }  # fmt: skip
    both = {"contact_radius": "radius", "half_filling_angle": "filling", "wetted_area": "wetted_area"}
    for _ in range(20):
        small, angles, tension = 10.0 ** random.uniform(-6, -3), random.uniform(0.0, 1.2, 2), random.uniform(0.02, 0.5)
        radii = random.permutation([small, small * random.choice([1.0, 3.0, math.inf])])
        held = 10.0 ** random.uniform(-4, -1) * small**3 if control == "volume" else 20.0 * tension / small
        pair, liquid = pl.Pair(tuple(radii), tuple(angles)), pl.Liquid(surface_tension=tension)
        numbers = (*radii, *angles, tension)
        end, status = library.one("pendular_rupture", CONTROLS[control], held, pair=numbers)
        expected = pl.rupture(pair, **{control: held}, liquid=liquid)
        assert status == FOUND
        assert end.separation == pytest.approx(expected.separation, rel=1e-12)
        gap = random.uniform(0.0, 0.9) * end.separation
        state, status = library.one("pendular_bridge", CONTROLS[control], gap, held, pair=numbers)
        expected = pl.bridge(pair, gap, **{control: held}, liquid=liquid)
        assert status == FOUND
        for name, field in fields.items():
            assert getattr(state, field) == pytest.approx(getattr(expected, name), rel=1e-11, nan_ok=True), name
        for name, field in both.items():
            found = [getattr(state, f"{field}{i}") for i in (1, 2)]
            assert found == pytest.approx(getattr(expected, name), rel=1e-11), name
        assert [state.across_tensor, state.axial_tensor] == pytest.approx(expected.capillary_tensor, rel=1e-11)
        assert tension * state.curvature == pytest.approx(expected.suction, rel=1e-11)
        meridian = expected._meridian
        assert [state.middle_radius, state.half_length] == pytest.approx([meridian[0], meridian[2]], rel=1e-11)
        assert bool(state.sideways_stable) == expected.sideways_stable


def test_one_is_equal_to_rows(library):
    """To rounding, as rows are answered abreast, also where rupture is near."""
    for control in CONTROLS.values():
        held, pairs = questions(control, 200)
        gap = np.full(200, 1e-3)
        states, statuses = library.rows("pendular_bridges", control, gap, held, pairs)
        ends, end_statuses = library.rows("pendular_ruptures", control, held, pairs)
        for i in range(200):
            state, status = library.one("pendular_bridge", control, gap[i], held[i], pair=pairs[i])
            assert status == statuses[i]
            np.testing.assert_allclose(state, states[i], rtol=1e-9, atol=1e-11)
            state, status = library.one("pendular_rupture", control, held[i], pair=pairs[i])
            assert status == end_statuses[i]
            np.testing.assert_allclose(state, ends[i], rtol=1e-9, atol=1e-11)


def test_a_bridge_that_is_near_leads_to_the_same(library):
    print(f"seed {SEED}")
    for control in CONTROLS.values():
        held, pairs = questions(control, 2000)
        ends, _ = library.rows("pendular_ruptures", control, held, pairs)
        random = np.random.default_rng(SEED)
        share = random.uniform(0.0, 0.95, len(held))
        near, before = library.rows("pendular_bridges", control, share * ends[:, 0], held, pairs)
        gap = (share + 0.02) * ends[:, 0]
        cold, wanted = library.rows("pendular_bridges", control, gap, held, pairs)
        assert (before == FOUND).sum() > 1500
        found, statuses = library.rows("pendular_bridges_near", control, gap, held, pairs, states=near.copy())
        assert np.array_equal(statuses, wanted)
        force = State._fields.index("force")
        unit = 2.0 * math.pi * np.maximum(np.abs(ends[:, State._fields.index("neck_radius")]), held ** (1.0 / 3.0))
        assert np.nanmax(np.abs(found[:, force] - cold[:, force]) / np.maximum(np.abs(cold[:, force]), unit)) < 1e-12
        for nothing in (np.full_like(near, math.nan), np.zeros_like(near)):  # no bridge to start from
            found, _ = library.rows("pendular_bridges_near", control, gap, held, pairs, states=nothing.copy())
            np.testing.assert_allclose(found, cold, rtol=1e-9, atol=1e-11)
            for i in range(20):
                asked = control, gap[i], held[i]
                alone, _ = library.one("pendular_bridge", *asked, pair=pairs[i])
                found, _ = library.one("pendular_bridge_near", *asked, pair=pairs[i], state=nothing[i])
                assert np.array_equal(found, alone, equal_nan=True)
        misled = random.uniform(
            -10.0, 10.0, near.shape
        )  # whatever it holds, what is answered is a bridge that is asked
        found, statuses = library.rows("pendular_bridges_near", control, gap, held, pairs, states=misled)
        assert np.array_equal(statuses, wanted)
        assert np.nanmax(np.abs(found[:, force] - cold[:, force]) / np.maximum(np.abs(cold[:, force]), unit)) < 1e-9


def test_threads_do_not_disturb_each_other(library):
    held, pairs = questions(VOLUME, 4000)
    gap = np.full(4000, 1e-3)
    alone = library.rows("pendular_bridges", VOLUME, gap, held, pairs)
    with ThreadPoolExecutor(4) as pool:  # ctypes lets go of the lock of Python
        each = [pool.submit(library.rows, "pendular_bridges", VOLUME, gap, held, pairs) for _ in range(8)]
    for found in each:
        for mine, other in zip(found.result(), alone, strict=True):
            assert np.array_equal(mine, other, equal_nan=True)


# Bad input ---------------------------------------------------------------------------------------------------------

R1, R2, A1, A2, TENSION = range(5)
BAD = {
    "radius 0": (SUCTION, 1e-6, 1e4, {R1: 0.0}),
    "radius below 0": (SUCTION, 1e-6, 1e4, {R2: -1e-6}),
    "radius nan": (SUCTION, 1e-6, 1e4, {R1: math.nan}),
    "angle below 0": (SUCTION, 1e-6, 1e4, {A1: -0.1}),
    "angle pi": (SUCTION, 1e-6, 1e4, {A2: math.pi}),
    "angle nan": (SUCTION, 1e-6, 1e4, {A2: math.nan}),
    "tension 0": (SUCTION, 1e-6, 1e4, {TENSION: 0.0}),
    "tension nan": (SUCTION, 1e-6, 1e4, {TENSION: math.nan}),
    "separation nan": (SUCTION, math.nan, 1e4, {}),
    "separation infinite": (SUCTION, math.inf, 1e4, {}),
    "overlap": (SUCTION, -25e-6, 1e4, {}),
    "suction nan": (SUCTION, 1e-6, math.nan, {}),
    "suction infinite": (SUCTION, 1e-6, math.inf, {}),
    "suction beyond": (SUCTION, 1e-6, 1e18, {}),
    "volume 0": (VOLUME, 1e-6, 0.0, {}),
    "volume below 0": (VOLUME, 1e-6, -1e-15, {}),
    "volume nan": (VOLUME, 1e-6, math.nan, {}),
    "volume beyond": (VOLUME, 1e-6, 1e-8, {}),
    "volume too small": (VOLUME, 1e-6, 1e-44, {}),
    "planes in touch": (VOLUME, 0.0, 1e-15, {R1: math.inf, R2: math.inf}),
    "planes too near": (VOLUME, 1e-11, 1e-15, {R1: math.inf, R2: math.inf}),
    "planes under suction": (SUCTION, 1e-6, 1e4, {R1: math.inf, R2: math.inf}),
}


@pytest.mark.parametrize("name", BAD)
def test_what_python_refuses_is_bad_input(library, name):
    control, separation, held, change = BAD[name]
    numbers = [change.get(i, number) for i, number in enumerate(PAIR)]
    state, status = library.one("pendular_bridge", control, separation, held, pair=numbers)
    assert status == BAD_INPUT
    assert np.isnan(state).all()
    asked = {"volume" if control == VOLUME else "suction": held}
    with pytest.raises(ValueError, match=r"^\S+: "):
        pl.bridge(pl.Pair(tuple(numbers[:2]), tuple(numbers[2:4])), separation, **asked, liquid=pl.Liquid(numbers[4]))


def test_a_control_that_is_none_is_bad_input(library):
    for control in (-1, 2, 1 << 20):
        assert library.one("pendular_bridge", control, 1e-6, 1e4, pair=PAIR)[1] == BAD_INPUT
        assert library.one("pendular_rupture", control, 1e4, pair=PAIR)[1] == BAD_INPUT


def test_a_bad_row_leaves_the_others(library):
    held, pairs = questions(VOLUME, 50)
    gap = np.full(50, 1e-3)
    alone, _ = library.rows("pendular_bridges", VOLUME, gap, held, pairs)
    gap[20] = math.nan
    found, statuses = library.rows("pendular_bridges", VOLUME, gap, held, pairs)
    assert statuses[20] == BAD_INPUT
    rest = np.arange(50) != 20
    assert np.array_equal(found[rest], alone[rest], equal_nan=True)


def test_solids_that_hold_nothing(library):
    dry = (*PAIR[:2], 2.0, 2.0, PAIR[4])
    assert library.one("pendular_bridge", SUCTION, 1e-6, 1e4, pair=dry)[1] == NO_BRIDGE
    assert library.one("pendular_rupture", SUCTION, 1e4, pair=dry)[1] == NO_BRIDGE
    assert library.rows("pendular_bridges", SUCTION, [], [], np.empty((0, 5)))[1].size == 0


# Files -------------------------------------------------------------------------------------------------------------


def test_the_header_names_all_fields_in_their_order(written):
    text = (written / "pendular.h").read_text()
    pair, state = re.findall(r"typedef struct \{(.*?)\}", text, re.DOTALL)
    named = [
        re.sub(r"/\*.*?\*/|double|[\s;]", lambda m: "," if m.group() == ";" else "", part) for part in (pair, state)
    ]
    names = [tuple(filter(None, part.split(","))) for part in named]
    assert names == [("radius1", "radius2", "contact_angle1", "contact_angle2", "surface_tension"), State._fields]
    assert "$" not in text
    for name in ("exact.f90", "exact.jl"):
        words = re.findall(
            r"\w+", (EXAMPLES / name).read_text().partition("state_type")[2] or (EXAMPLES / name).read_text()
        )
        places = [words.index(field) for field in State._fields[3:10]]
        assert places == sorted(places), name


@pytest.mark.skipif(shutil.which("nm") is None, reason="nm is not installed")
def test_it_needs_nothing_of_python(written):
    told = subprocess.run(
        ["nm", "--undefined-only", written / "libpendular.a"], check=True, capture_output=True, text=True
    )
    needed = {line.split()[-1] for line in told.stdout.splitlines() if " U " in line}
    assert needed
    assert needed <= MATHEMATICS
    told = subprocess.run(
        ["nm", "--extern-only", "--defined-only", written / "libpendular.a"], check=True, capture_output=True, text=True
    )
    defined = {line.split()[-1] for line in told.stdout.splitlines() if " T " in line}
    ends = ("bridge", "bridge_near", "rupture", "bridges", "bridges_near", "ruptures")
    assert defined == {f"pendular_{end}" for end in ends}
    header = (written / "pendular.h").read_text()
    assert defined == set(re.findall(r"^int (\w+)\(", header, re.MULTILINE))


def printed_rows(program, folder=None):
    """What an example prints: rupture, and rows."""
    told = subprocess.run(program, cwd=folder, check=True, capture_output=True, text=True).stdout.splitlines()
    assert told[0].startswith("breaks at ")
    return float(told[0].split()[2]), np.array([line.split() for line in told[2:]], float)


def assert_as_in_python(library, end, rows, control, held, last):
    pair = (50e-6, 100e-6, 0.35, 0.35, 0.0728)
    one, _ = library.one("pendular_rupture", control, held, pair=pair)
    assert end == pytest.approx(one.separation, rel=1e-13)
    assert len(rows) == 6
    for separation, status, *answers in rows:
        state, wanted = library.one("pendular_bridge", control, separation, held, pair=pair)
        assert status == wanted
        expected = [state.force, state.stiffness, getattr(state, last)]
        assert answers == pytest.approx(expected, rel=1e-12, nan_ok=True)
    assert {FOUND, NO_BRIDGE} == {int(row[1]) for row in rows}
    grains, water = pl.Pair((50e-6, 100e-6), 0.35), pl.Liquid(surface_tension=0.0728)
    asked = {"volume" if control == VOLUME else "suction": held}
    forces = pl.bridge(grains, rows[:, 0], **asked, liquid=water).force
    np.testing.assert_allclose(np.nan_to_num(rows[:, 2]), forces, rtol=1e-13)


@pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")
@pytest.mark.parametrize("static", [True, False], ids=["static", "shared"])
def test_the_example_in_c(written, library, tmp_path, static):
    linked = ["libpendular.a", "-lm"] if static else ["-L.", "-lpendular", f"-Wl,-rpath,{written}"]
    command = ["gcc", "-std=c99", "-O2", *WARNINGS, "-I.", "-o", tmp_path / "exact", EXAMPLES / "exact.c", *linked]
    done = subprocess.run(command, cwd=written, check=True, capture_output=True, text=True)
    assert done.stderr == ""
    assert_as_in_python(library, *printed_rows([tmp_path / "exact"]), SUCTION, 14e3, "volume")


@pytest.mark.skipif(shutil.which("g++") is None, reason="g++ is not installed")
def test_the_example_in_cpp(written, library, tmp_path):
    source, linked = EXAMPLES / "exact.cpp", "libpendular.a"
    command = ["g++", "-std=c++11", "-O2", *WARNINGS, "-I.", "-o", tmp_path / "exact", source, linked]
    subprocess.run(command, cwd=written, check=True)
    assert_as_in_python(library, *printed_rows([tmp_path / "exact"]), VOLUME, 5e-15, "curvature")


@pytest.mark.skipif(shutil.which("gfortran") is None, reason="gfortran is not installed")
def test_the_example_in_fortran(written, library, tmp_path):
    source, linked = EXAMPLES / "exact.f90", written / "libpendular.a"
    subprocess.run(["gfortran", "-std=f2008", "-Wall", "-O2", "-o", "exact", source, linked], cwd=tmp_path, check=True)
    assert_as_in_python(library, *printed_rows([tmp_path / "exact"]), SUCTION, 14e3, "volume")


@pytest.mark.skipif(shutil.which("julia") is None, reason="julia is not installed")
def test_the_example_in_julia(written, library):
    program = ["julia", EXAMPLES / "exact.jl", written / "libpendular.so"]
    assert_as_in_python(library, *printed_rows(program), SUCTION, 14e3, "volume")


@pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")
def test_the_code_of_the_page_runs(written, library, tmp_path):
    (block,) = [each for each in code_blocks((ROOT / "docs" / "c_library.md").read_text()) if each.language == "c"]
    include, _, body = block.code.partition("\n")
    program = f"#include <stdio.h>\n{include}\nint main(void)\n{{\n{body}return status;\n}}\n"
    (tmp_path / "main.c").write_text(program)
    command = ["gcc", *WARNINGS, "main.c", "-I", written, written / "libpendular.a", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    told = subprocess.run([tmp_path / "a.out"], check=True, capture_output=True, text=True).stdout
    state, _ = library.one("pendular_bridge", SUCTION, 1e-6, 14e3, pair=(50e-6, 100e-6, 0.35, 0.35, 0.0728))
    assert told == f"{state.force:g} N, {state.volume:g} m3\n"


# The command -------------------------------------------------------------------------------------------------------


def test_the_command_tells_what_it_wrote(written, run, tmp_path):
    code, told, _ = run("export", "library", "--out", tmp_path / "new" / "lib")
    assert code == 0
    for line, name in zip(told.splitlines(), ("pendular.h", "libpendular.a", "libpendular.so"), strict=True):
        assert re.fullmatch(rf"{re.escape(str(tmp_path / 'new' / 'lib' / name))}: \d+ kB", line)
    for name in ("pendular.h", "libpendular.a"):
        assert (tmp_path / "new" / "lib" / name).read_bytes() == (written / name).read_bytes()


def test_without_a_c_compiler_all_but_the_shared_library_is_written(written, run, tmp_path, monkeypatch):
    monkeypatch.setattr("pendular.ground.linking.shutil.which", lambda name: None)
    code, told, _ = run("export", "library", "--out", tmp_path)
    assert code == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["libpendular.a", "pendular.h"]
    assert told.splitlines()[2] == (
        "libpendular.so: not written, for there is no C compiler (cc, gcc or clang) to link it"
    )


def test_a_linker_that_fails_and_a_folder_that_is_none_are_told_in_one_line(written, run, tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    code, told, error = run("export", "library", "--out", tmp_path / "file")
    assert (code, told) == (2, "")
    assert error == f"pendular: out: '{tmp_path / 'file'}' cannot be written: File exists\n"
    linker = tmp_path / "cc"
    linker.write_text("#!/bin/sh\necho 'something' >&2\necho 'no such library' >&2\nexit 1\n")
    linker.chmod(0o755)
    monkeypatch.setattr("pendular.ground.linking.shutil.which", lambda name: str(linker))
    code, told, error = run("export", "library", "--out", tmp_path / "lib")
    assert (code, told) == (2, "")
    assert error == f"pendular: library: {linker} cannot link libpendular.so: no such library\n"
    assert not (tmp_path / "lib").exists()


def test_without_numba_it_is_refused_in_one_line(run, tmp_path, monkeypatch):
    monkeypatch.setattr("pendular.codes.library.write.has_compiler", lambda: False)
    code, told, error = run("export", "library", "--out", tmp_path / "lib")
    assert (code, told) == (2, "")
    assert error == "pendular: library: needs numba, which compiles it; pip install numba\n"
