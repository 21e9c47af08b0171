"""The examples for MercuryDPM, MUSEN and Chrono, with their names alone: where a bridge forms, pulls and breaks."""

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
def programs(tmp_path_factory):
    """The three programs, by the code that they are like."""
    folder = tmp_path_factory.mktemp("codes")
    for name in ("mercury", "musen", "chrono"):
        include = [f"-I{path}" for path in (PROGRAMS / f"like_{name}", EXAMPLES, HEADERS)]
        source = PROGRAMS / f"like_{name}" / "main.cpp"
        subprocess.run(["g++", "-std=c++14", "-O2", *WARNED, *include, "-o", folder / name, source], check=True)
    return folder


def told(program, table, *numbers):
    """Lines that the program prints."""
    table.save(program.parent / "w.bridges")
    command = [program, program.parent / "w.bridges", *map(repr, map(float, numbers))]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()


@pytest.mark.parametrize("other", [50e-6, 80e-6, math.inf])
def test_bridges_of_mercury_form_in_touch_and_break_at_rupture(programs, other):
    table = pl.tabulate(math.radians(20), reduced=(1.0, 100.0), tolerance=1e-4)
    radius = 50e-6
    end = float(table.rupture_distance(SUCTION, radius, other, TENSION))
    gaps = np.array([0.3, -0.01, 0.0, 0.3, 0.99, 1.01, 0.3]) * end
    reach, *forces = map(
        float, told(programs / "mercury", table, SUCTION, TENSION, radius, 0.0 if other == math.inf else other, *gaps)
    )
    expected = -np.asarray(table.force(gaps, SUCTION, radius, other, TENSION))
    expected[[0, -1]] = 0.0  # before it forms, and after it broke
    np.testing.assert_allclose(forces, expected, rtol=1e-9)
    assert reach >= end


def test_bridges_of_chrono_form_in_touch_and_break_at_rupture(programs):
    table = pl.tabulate(math.radians(20), reduced=(1.0, 100.0), tolerance=1e-4)
    end = float(table.rupture_distance(SUCTION, 50e-6, 80e-6, TENSION))
    gaps = np.array([0.3, -0.01, 0.0, 0.3, 0.99, 1.01, 0.3]) * end
    forces = np.array(told(programs / "chrono", table, SUCTION, TENSION, 50e-6, 80e-6, *gaps), float)
    expected = np.asarray(table.force(gaps, SUCTION, 50e-6, 80e-6, TENSION))
    expected[[0, -1]] = 0.0
    np.testing.assert_allclose(forces, expected, rtol=1e-9)


def test_liquid_bonds_of_musen_are_bridges_of_their_volume(programs):
    table, volume = pl.tabulate(math.radians(20), "volume", reduced=(1e-4, 0.05), tolerance=1e-4), 5e-16
    end = float(table.rupture_distance(volume, 50e-6, 80e-6, TENSION))
    gaps = np.array([-0.01, 0.0, 0.3, 0.99, 1.01]) * end
    rows = [line.split() for line in told(programs / "musen", table, volume, TENSION, 50e-6, 80e-6, *gaps)]
    forces, broken = np.array(rows, float).T
    np.testing.assert_allclose(forces, table.force(gaps, volume, 50e-6, 80e-6, TENSION), rtol=1e-9)
    assert broken.tolist() == [0, 0, 0, 0, 1]


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("mercury", "a bridge is out of the range of its table"),
        ("chrono", "a bridge is out of the range of its table"),
        ("musen", "a liquid bond is out of the range of its table"),
    ],
)
def test_a_contact_out_of_range_is_an_error(programs, name, reason):
    table = pl.tabulate(math.radians(20), reduced=(1.0, 2.0), tolerance=1e-3)
    assert told(programs / name, table, SUCTION, TENSION, 50e-6, 50e-6, 0.0)[-1] == reason
