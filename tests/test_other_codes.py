"""The example for MercuryDPM, with its names alone: what it adds, where a bridge forms and where it breaks."""

import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import pendular as pl
from table_reader import HEADERS, PROGRAMS, WARNED

EXAMPLES = Path(__file__).parents[1] / "examples" / "other_codes"
TENSION, SUCTION = 0.0728, 5e3

pytestmark = pytest.mark.skipif(shutil.which("g++") is None, reason="g++ is not installed")


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    folder = tmp_path_factory.mktemp("mercury")
    include = [f"-I{path}" for path in (PROGRAMS / "like_mercury", EXAMPLES, HEADERS)]
    source = PROGRAMS / "like_mercury" / "main.cpp"
    subprocess.run(["g++", "-std=c++14", "-O2", *WARNED, *include, "-o", folder / "main", source], check=True)
    return folder / "main"


def told(program, table, *numbers):
    """Lines that the program prints."""
    table.save(program.parent / "w.bridges")
    command = [program, program.parent / "w.bridges", *map(repr, map(float, numbers))]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()


@pytest.mark.parametrize("other", [50e-6, 80e-6, math.inf])
def test_bridges_form_in_touch_and_break_at_rupture(program, other):
    table = pl.tabulate(math.radians(20), reduced=(1.0, 100.0), tolerance=1e-4)
    radius = 50e-6
    end = float(table.rupture_distance(SUCTION, radius, other, TENSION))
    gaps = np.array([0.3, -0.01, 0.0, 0.3, 0.99, 1.01, 0.3]) * end
    reach, *forces = map(
        float, told(program, table, SUCTION, TENSION, radius, 0.0 if other == math.inf else other, *gaps)
    )
    expected = -np.asarray(table.force(gaps, SUCTION, radius, other, TENSION))
    expected[[0, -1]] = 0.0  # before it forms, and after it broke
    np.testing.assert_allclose(forces, expected, rtol=1e-12)
    assert reach >= end


def test_a_contact_out_of_range_is_an_error(program):
    table = pl.tabulate(math.radians(20), reduced=(1.0, 2.0), tolerance=1e-3)
    assert told(program, table, SUCTION, TENSION, 50e-6, 50e-6, 0.0)[1] == "a bridge is out of the range of its table"
