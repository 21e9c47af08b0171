"""What the plug-in for LAMMPS asks of one bridge in a step, as plain functions: on the host, and compiled for GPUs."""

import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import pendular.codes
import pendular.codes.lammps
from pendular.laws import damping_star

PROGRAM = Path(__file__).parent / "c_programs" / "like_kokkos.cpp"
CODES = Path(pendular.codes.__file__).parent
INCLUDED = ("-I", str(CODES), "-I", str(CODES / "lammps" / "plugin"), "-std=c++17")

HIP = """
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
__device__ double sqrt(double);
__device__ double fabs(double);
"""  # what the headers of HIP would bring, as far as it is asked for


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    if shutil.which("g++") is None:
        pytest.skip("no g++: apt-get install g++")
    path = tmp_path_factory.mktemp("contact") / "program"
    strict = ("-O2", "-Wall", "-Wextra", "-Werror")
    subprocess.run(["g++", *strict, *INCLUDED, PROGRAM, "-o", path, "-lm"], check=True)
    return path


def told(program, rows):
    text = "\n".join(" ".join(str(word) for word in row) for row in rows)
    done = subprocess.run([program], input=text, check=True, capture_output=True, text=True)
    return [[float(word) for word in line.split()] for line in done.stdout.splitlines()]


def test_the_damping_is_that_of_the_law(program):
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    rng = np.random.default_rng(seed)
    count = 2000
    radius1, viscosity = 10.0 ** rng.uniform(-8, -2, count), 10.0 ** rng.uniform(-4, 1, count)
    radius2 = np.where(rng.random(count) < 0.2, np.inf, radius1 * 10.0 ** rng.uniform(-3, 3, count))
    mean = 2.0 / (1.0 / radius1 + 1.0 / radius2)
    gap, volume = 10.0 ** rng.uniform(-7, 0, count) * mean, 10.0 ** rng.uniform(-9, -1, count) * mean**3
    asked = zip(gap.tolist(), volume.tolist(), radius1.tolist(), radius2.tolist(), viscosity.tolist(), strict=True)
    found = np.ravel(told(program, [("damping", *row) for row in asked]))
    by_law = damping_star("pitois2000", gap / mean, volume / mean**3, 0.1, 0.1, mean / radius1, mean / radius2)
    np.testing.assert_allclose(found, by_law * viscosity * mean, rtol=1e-14)


def test_a_bridge_holds_breaks_or_is_left_to_the_host(program):
    series = [0.3, -0.2, 0.05, 0.01, 0.0, 0.002, 0.0, -0.001]
    total, contact, rupture, offset, slope = 1e-4, 0.25, 2e-6, 0.1, 0.8
    gaps = [-1e-6, 0.0, 0.2e-6, 1.0e-6, 1.9e-6, 1.001 * rupture, 1.1 * rupture, math.nan]
    rows = [("cell", total, contact, rupture, offset, slope, *series), *(("pull", repr(total + gap)) for gap in gaps)]
    found = told(program, rows)
    for gap, (pull, is_left) in zip(gaps[:5], found[:5], strict=True):
        t = offset + slope * math.sqrt(1.0 - max(gap, 0.0) / rupture)
        expected = contact if gap <= 0.0 else sum(term * t**k for k, term in enumerate(series))
        assert pull == pytest.approx(expected, rel=1e-9)
        assert not is_left
    assert found[5:7] == [[0.0, 0.0], [0.0, 0.0]]
    assert math.isnan(found[7][0])
    assert found[7][1] == 1.0
    ((_, is_left),) = told(program, [("cell", total, contact, rupture, 1.5, slope, *series), ("pull", total + 1e-6)])
    assert is_left  # beyond the cell
    ((_, is_left),) = told(program, [("cell", "nan", "nan", rupture, "nan", "nan", *series), ("pull", total)])
    assert is_left  # a bridge that has to be made anew
    found = told(program, [("no_cell", total, contact), ("pull", total - 1e-6), ("pull", repr(total + 1e-9))])
    assert found[0] == [contact, 0.0]
    assert found[1][1] == 1.0  # the first time that its solids are apart


@pytest.mark.skipif(shutil.which("nvcc") is None, reason="nvcc is not installed")
def test_cuda_compiles_the_functor(tmp_path):
    """Compiled for host and device, not run: no GPU is asked for."""
    text = tmp_path / "functor.ptx"
    options = ("-x", "cu", "-Werror", "all-warnings", "-Wno-deprecated-gpu-targets", *INCLUDED)
    subprocess.run(["nvcc", *options, "-ptx", PROGRAM, "-o", text], check=True)
    assert text.read_text().count(".entry") == 1
    assert ".extern .func" not in text.read_text(), "calls what no GPU has"


@pytest.mark.skipif(shutil.which("clang++") is None, reason="clang++ is not installed")
@pytest.mark.parametrize("side", ["--cuda-host-only", "--cuda-device-only"])
def test_hip_knows_the_functor(side, tmp_path):
    """Checked, not compiled: the headers and libraries of HIP are not there."""
    (tmp_path / "hip.h").write_text(HIP)
    options = (
        "-x",
        "hip",
        side,
        "--offload-arch=gfx90a",
        "-nogpuinc",
        "-nogpulib",
        "-fsyntax-only",
        "-Wall",
        "-Werror",
    )
    subprocess.run(["clang++", *options, "-include", tmp_path / "hip.h", *INCLUDED, PROGRAM], check=True)
