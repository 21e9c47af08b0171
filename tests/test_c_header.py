"""The C header: compiled by others, compared with the table it is written from and with exact bridges."""

import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from benchmarks.c_header import CPP, WARNINGS, C, compiled, contacts, has_compiler

import pendular as pl
from pendular.codes.c_header import LARGEST, c_header
from pendular.front.cli import main

SEED = 71
COUNT = 100_000
EXAMPLE = Path(__file__).parents[1] / "examples" / "c" / "main.c"
FUNCTIONS = {"suction": ("force", "stiffness", "rupture_distance", "volume")}
FUNCTIONS["volume"] = ("force", "stiffness", "rupture_distance", "suction")
TABLES = {
    "any ratio": {"contact_angle": math.radians(20), "reduced": (0.1, 1e4), "tolerance": 1e-6},
    "two angles": {
        "contact_angle": np.deg2rad([20.0, 55.0]),
        "reduced": (0.5, 50.0),
        "radius_ratio": (1.0, 8.0),
        "tolerance": 1e-5,
    },
    "volume": {
        "contact_angle": math.radians(20),
        "control": "volume",
        "reduced": (0.01, 0.0156),
        "radius_ratio": (1.0, 1.2),
        "tolerance": 1e-4,
    },
}

pytestmark = pytest.mark.skipif(not has_compiler(C), reason="gcc is not installed")


@pytest.fixture(scope="module", params=TABLES)
def table(request):
    return pl.tabulate(**TABLES[request.param])


@pytest.fixture(scope="module")
def suction_table():
    return pl.tabulate(**TABLES["any ratio"])


@pytest.fixture(scope="module")
def call(suction_table, tmp_path_factory):
    """Functions of the header of the table under suction."""
    return compiled(c_header(suction_table), tmp_path_factory.mktemp("c"), FUNCTIONS["suction"])


def asked_of(table, name, contact):
    return getattr(table, name)(*(contact[1:] if name == "rupture_distance" else contact))


# Agreement ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("degrees", ["120", "90"])
def test_solids_that_no_suction_holds_are_refused(tmp_path, capsys, degrees):
    path = tmp_path / "bridge.h"
    with pytest.raises(SystemExit) as end:
        main(["export", "c", "--contact-angle", degrees, "--reduced-suction", "10", "100", "--out", str(path)])
    assert end.value.code == 2
    line = f"pendular: contact-angle: {degrees} and {degrees} deg are not below 180 deg together; no suction"
    assert capsys.readouterr().err.startswith(line)
    assert not path.exists()


@pytest.mark.parametrize("options", [("-O2",), ("-O3", "-march=native")], ids=" ".join)
@pytest.mark.parametrize("compiler", [C, CPP], ids=" ".join)
def test_c_answers_what_the_table_answers(table, compiler, options, tmp_path):
    if not has_compiler(compiler):
        pytest.skip(f"{compiler[0]} is not installed")
    print(f"seed {SEED}")
    contact = contacts(table, COUNT, SEED)
    names = FUNCTIONS[table.control]
    call = compiled(c_header(table), tmp_path, names, compiler, options)
    left = 1.0 - np.maximum(contact[0], 0.0) / asked_of(table, "rupture_distance", contact)
    at_contact = (np.zeros(COUNT), *contact[1:])
    slope = np.abs(asked_of(table, "force", at_contact)) / asked_of(table, "rupture_distance", contact)
    bounds = {"rupture_distance": 0.0, "volume": table.bound.liquid, "suction": table.bound.liquid}
    for name in names:
        found, expected = call(name, *contact), asked_of(table, name, contact)
        # The rate of √(1 - D/D_c) amplifies the rounding of D_c as rupture comes near.
        allowed = 1e-12 + (1e-15 / np.abs(left) if name == "stiffness" else 0.0)
        allowed += 1e-3 * bounds.get(name, table.bound.force)  # small terms are summed in single precision
        assert np.array_equal(np.isnan(found), np.isnan(expected)), name
        assert np.array_equal(found == 0.0, expected == 0.0), name
        size = np.maximum(np.abs(expected), slope if name == "stiffness" else np.abs(asked_of(table, name, at_contact)))
        if name == "suction":  # at constant volume it passes through 0
            size = np.maximum(size, contact[4] / contact[2])
        error = np.abs(found - expected) / size
        worst = np.nanargmax(error / allowed)
        assert error[worst] < np.broadcast_to(allowed, error.shape)[worst], (name, [float(x[worst]) for x in contact])


def test_c_answers_the_exact_force(call, suction_table):
    print(f"seed {SEED}")
    separation, suction, radius1, radius2, gamma = contacts(suction_table, 2000, SEED)
    separation = np.maximum(separation, 0.0)
    pairs, one = pl.Pair((radius1, radius2), math.radians(20)), pl.Liquid(surface_tension=1.0)
    exact, touching = (
        gamma * pl.bridge(pairs, gaps, suction=suction / gamma, liquid=one).force for gaps in (separation, 0.0)
    )
    rupture = call("rupture_distance", separation, suction, radius1, radius2, gamma)
    is_clear = np.abs(separation / rupture - 1.0) > 1e-5  # of rupture, on whose side the two may differ
    found = call("force", separation, suction, radius1, radius2, gamma)
    assert (np.abs(found - exact) / touching)[is_clear].max() < 1e-6


# Where there is no answer ------------------------------------------------------------------------------------------

CONTACT = (1e-6, 2e4, 50e-6, 80e-6, 0.0728)


@pytest.mark.parametrize("place", range(5))
@pytest.mark.parametrize("name", FUNCTIONS["suction"])
def test_nan_is_answered_with_nan(call, name, place):
    if name == "rupture_distance" and place == 0:
        pytest.skip("takes no separation")
    contact = list(CONTACT)
    contact[place] = math.nan
    assert np.isnan(call(name, *contact))


@pytest.mark.parametrize("name", FUNCTIONS["suction"])
def test_out_of_range_is_nan(call, name):
    mean, gamma = 50e-6, 0.0728
    for star, is_covered in ((0.0999, False), (0.1001, True), (9999.0, True), (10001.0, False), (-1.0, False)):
        found = call(name, 0.0, star * gamma / mean, mean, mean, gamma)
        assert np.isfinite(found) == is_covered, star


def test_a_ratio_out_of_range_is_nan(tmp_path):
    call = compiled(c_header(pl.tabulate(**TABLES["two angles"])), tmp_path, ("force",))
    for ratio, is_covered in ((1.0, True), (7.99, True), (8.01, False), (math.inf, False)):
        for radii in ((50e-6, ratio * 50e-6), (ratio * 50e-6, 50e-6)):
            assert np.isfinite(call("force", 0.0, 5e3, *radii, 0.0728)) == is_covered


def test_rupture_is_where_the_force_ends(call):
    rest = CONTACT[1:]
    rupture = float(call("rupture_distance", 0.0, *rest))
    before = np.nextafter(rupture, 0.0)
    assert call("force", before, *rest) > 0.0
    assert call("volume", before, *rest) > 0.0
    for separation in (rupture, 2.0 * rupture, math.inf):
        assert call("force", separation, *rest) == 0.0
        assert np.isnan(call("volume", separation, *rest))
        assert np.isnan(call("stiffness", separation, *rest))


def test_an_overlap_counts_as_contact(call):
    rest = CONTACT[1:]
    assert call("force", -1e-6, *rest) == call("force", 0.0, *rest)
    assert call("stiffness", -1e-6, *rest) == 0.0


def test_a_plane_is_a_sphere_of_infinite_radius(call):
    plane = call("force", 1e-6, 2e4, 50e-6, math.inf, 0.0728)
    exact = pl.bridge(
        pl.Pair((50e-6, math.inf), math.radians(20)), 1e-6, suction=2e4, liquid=pl.Liquid(surface_tension=0.0728)
    )
    assert plane == pytest.approx(exact.force, rel=2e-6)
    assert call("force", 1e-6, 2e4, math.inf, 50e-6, 0.0728) == plane


# The file ----------------------------------------------------------------------------------------------------------


def test_two_headers_live_in_one_program(suction_table, tmp_path):
    other = pl.tabulate(**TABLES["two angles"])
    (tmp_path / "a.h").write_text(c_header(suction_table))
    (tmp_path / "b.h").write_text(c_header(other, prefix="wall_"))
    (tmp_path / "main.c").write_text(
        '#include "a.h"\n#include "b.h"\n#include "a.h"\n'
        "int main(void) { return pendular_force(0, 5e3, 5e-5, 5e-5, 0.07) > wall_force(0, 5e3, 5e-5, 5e-5, 0.07); }\n"
    )
    subprocess.run([*C, *WARNINGS, "-o", "main", "main.c", "-lm"], cwd=tmp_path, check=True)
    assert subprocess.run([tmp_path / "main"], check=False).returncode == 1  # more wetting, more force


def test_the_header_is_ascii_and_small(suction_table):
    text = c_header(suction_table)
    assert text.isascii()
    assert len(text) < LARGEST
    assert max(map(len, text.splitlines())) <= 240


def test_arithmetic_without_nan_is_refused(suction_table, tmp_path):
    (tmp_path / "main.c").write_text('#include "bridge.h"\nint main(void) { return 0; }\n')
    (tmp_path / "bridge.h").write_text(c_header(suction_table))
    command = [*C, "-ffast-math", "-c", "main.c"]
    refused = subprocess.run(command, cwd=tmp_path, check=False, capture_output=True, text=True)
    assert refused.returncode != 0
    assert "compile without -ffast-math, or add -fno-finite-math-only" in refused.stderr
    subprocess.run([*command, "-fno-finite-math-only"], cwd=tmp_path, check=True)


@pytest.mark.skipif(shutil.which("nvcc") is None, reason="nvcc is not installed")
def test_cuda_compiles_the_header_for_host_and_device(suction_table, tmp_path):
    (tmp_path / "bridge.h").write_text(c_header(suction_table))
    (tmp_path / "main.cu").write_text(
        '#include "bridge.h"\n'
        "__global__ void forces(double *out) { out[threadIdx.x] = pendular_force(1e-6, 2e4, 5e-5, 5e-5, 0.07); }\n"
        "double on_host(void) { return pendular_force(1e-6, 2e4, 5e-5, 5e-5, 0.07); }\n"
    )
    command = ["nvcc", "-Werror", "all-warnings", "-Wno-deprecated-gpu-targets", "-c", "main.cu"]
    subprocess.run(command, cwd=tmp_path, check=True)


@pytest.mark.parametrize("prefix", ["", "9_", "two words", "a-b", "é"])
def test_a_prefix_that_begins_no_name_is_refused(suction_table, prefix):
    with pytest.raises(ValueError, match=r"^prefix: .* does not begin a name in C"):
        c_header(suction_table, prefix=prefix)


# The command -------------------------------------------------------------------------------------------------------


def test_the_command_writes_a_header_of_constant_volume(run, tmp_path):
    ranges = ("--reduced-volume", 0.01, 0.0156, "--radius-ratio", 1, 1.2, "--tolerance", 1e-4)
    code, _, _ = run("export", "c", "--contact-angle", "20", "--out", tmp_path / "wet.h", "--prefix", "wet_", *ranges)
    assert code == 0
    call = compiled((tmp_path / "wet.h").read_text(), tmp_path, FUNCTIONS["volume"], prefix="wet_")
    radius, volume = 50e-6, 0.012 * 50e-6**3
    exact = pl.bridge(pl.Pair(radius, math.radians(20)), 2e-6, volume=volume, liquid=pl.Liquid(surface_tension=0.0728))
    contact = (2e-6, volume, radius, radius, 0.0728)
    assert call("force", *contact) == pytest.approx(exact.force, rel=2e-4)
    assert call("suction", *contact) == pytest.approx(exact.suction, rel=2e-3)


def test_the_example_runs_as_it_says(run, tmp_path):
    code, out, _ = run("export", "c", "--contact-angle", "20", "--out", tmp_path / "bridge.h")
    assert code == 0
    assert out.startswith(f"{tmp_path / 'bridge.h'}: 0.")
    shutil.copy(EXAMPLE, tmp_path)
    subprocess.run([*C, "-O2", *WARNINGS, "-o", "main", "main.c", "-lm"], cwd=tmp_path, check=True)
    printed = subprocess.run([tmp_path / "main"], check=True, capture_output=True, text=True).stdout.splitlines()
    grains = pl.Pair((50e-6, 100e-6), math.radians(20))
    held = {"suction": 5e3, "liquid": pl.Liquid(surface_tension=0.0728)}
    assert float(printed[0].split()[2]) == pytest.approx(pl.rupture(grains, **held).separation, rel=1e-6)
    rows = np.array([line.split() for line in printed[2:]], float)
    exact = pl.bridge(grains, rows[:5, 0], **held)
    np.testing.assert_allclose(rows[:5, 1], exact.force, rtol=2e-6)
    np.testing.assert_allclose(rows[1:5, 2], exact.stiffness[1:], rtol=1e-4)
    np.testing.assert_allclose(rows[:5, 3], exact.volume, rtol=1e-5)
    assert rows[5, 1] == 0.0
    assert np.isnan(rows[5, 2:]).all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--reduced-suction", "1", "10", "--reduced-volume", "0.01", "0.1"], "reduced-volume: given together with"),
        (["--tolerance", "1e-8"], "tolerance: 1e-08 makes a header of 1."),
    ],
)
def test_bad_options_are_refused_in_one_line(run, options, message, tmp_path):
    code, out, err = run("export", "c", "--contact-angle", "20", "--out", tmp_path / "bridge.h", *options)
    assert (code, out) == (2, "")
    assert err.startswith(f"pendular: {message}")
    assert err.count("\n") == 1
    assert not (tmp_path / "bridge.h").exists()
