"""The table of one pair for LAMMPS: its format, its numbers against exact bridges, and the command."""

import math

import numpy as np
import pytest

import pendular as pl
from pendular.codes.pair_table import pair_table, pair_table_text
from pendular.front.cli import main

GRAINS = pl.Pair((50e-6, 80e-6), math.radians(20))
WATER = pl.Liquid(surface_tension=0.0728)
HELD = {"suction": {"suction": 20e3}, "volume": {"volume": 5e-15}}


def read(text):
    """Keyword, header words and rows, as LAMMPS finds them: comments and one line with the keyword first."""
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return lines[0], lines[1].split(), np.array([line.split() for line in lines[2:]], float)


@pytest.mark.parametrize("control", HELD)
def test_rows_are_exact_bridges(control):
    table = pair_table(GRAINS, liquid=WATER, **HELD[control])
    exact = pl.bridge(GRAINS, table.distance[:-1] - 130e-6, liquid=WATER, **HELD[control])
    np.testing.assert_allclose(table.force[:-1], exact.force, rtol=1e-12)
    end = pl.rupture(GRAINS, liquid=WATER, **HELD[control])
    assert table.distance[-1] - 130e-6 == pytest.approx(end.separation, rel=1e-9)
    assert (table.force[-1], table.energy[-1]) == (end.force, 0.0)
    np.testing.assert_allclose(np.diff(table.distance**2), np.diff(table.distance**2).mean(), rtol=1e-8)


@pytest.mark.parametrize("control", HELD)
def test_force_is_the_rate_of_the_energy(control):
    table = pair_table(GRAINS, liquid=WATER, points=4000, **HELD[control])
    rate = (table.energy[2:] - table.energy[:-2]) / (table.distance[2:] - table.distance[:-2])
    inner = slice(0, -40)  # near rupture the force falls like a square root
    np.testing.assert_allclose(rate[inner], table.force[1:-1][inner], rtol=1e-4)


def test_the_stated_error_is_that_between_the_rows():
    table = pair_table(GRAINS, liquid=WATER, points=50, suction=20e3)
    print("seed 3")
    distance = np.random.default_rng(3).uniform(table.distance[0], table.distance[-1], 5000)
    linear = np.interp(distance**2, table.distance**2, table.force)
    exact = pl.bridge(GRAINS, distance - 130e-6, suction=20e3, liquid=WATER).force
    contact = pl.bridge(GRAINS, 0.0, suction=20e3, liquid=WATER).force
    worst = np.abs(linear - exact).max() / contact
    assert 0.8 * table.error < worst < 1.5 * table.error


def test_the_file_has_the_layout_that_lammps_reads():
    table = pair_table(GRAINS, liquid=WATER, points=20, suction=20e3)
    text = pair_table_text(table, "WET", "20 µm, 20°")
    assert text.startswith("# UNITS: si ")
    assert text.isascii()
    keyword, header, rows = read(text)
    assert (keyword, header[:3]) == ("WET", ["N", "20", "RSQ"])
    assert [float(word) for word in header[3:]] == [table.distance[0], table.distance[-1]]
    np.testing.assert_array_equal(rows, np.column_stack([range(1, 21), table.distance, table.energy, -table.force]))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"pair": pl.Pair((50e-6, math.inf), 0.3)}, "radius: a plane has no centre"),
        ({"overlap": 30e-6}, r"overlap: 3e-05 m is not in \[0, 2.5e-05\)"),
        ({"points": 5}, "points: 5.0 is not >= 10"),
        ({"pair": pl.Pair(50e-6, 2.0)}, "contact-angle: no bridge holds"),
    ],
)
def test_bad_input_is_refused(change, message):
    asked = {"pair": GRAINS, "liquid": WATER, "suction": 20e3} | change
    with pytest.raises(ValueError, match=f"^{message}"):
        pair_table(asked.pop("pair"), **asked)


def test_the_command_writes_the_file_and_says_how_to_use_it(tmp_path, capsys):
    path = tmp_path / "bridge.table"
    with pytest.raises(SystemExit) as end:
        main(["export", "pair-table", "--radius", "50um", "--suction", "20kPa", "--points", "100", "--out", str(path)])
    printed = capsys.readouterr().out.splitlines()
    assert end.value.code == 0
    _, header, rows = read(path.read_text())
    assert len(rows) == 100
    assert printed[2:] == ["pair_style table linear 100", f"pair_coeff 1 1 {path} BRIDGE {header[4]}"]
