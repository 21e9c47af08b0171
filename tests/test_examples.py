"""The examples: each runs, prints its numbers, and leaves a picture where it is asked to."""

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from tools.site_parts import run_script

FOLDER = Path(__file__).parents[1] / "examples"
ELSEWHERE = {  # run by test_yade_run.py, test_yade_engine.py and test_lammps_examples.py
    "yade_pull.py",
    "yade_engine.py",
    "two_grains.py",
    "wet_shear.py",
    "wet_shear_picture.py",
}
SCRIPTS = sorted(path for path in FOLDER.glob("*.py") if path.name not in ELSEWHERE)


def by_stem(path):
    return path.stem


def printed_by(name, capsys):
    run_script(FOLDER / name, [])
    return capsys.readouterr().out


@pytest.mark.parametrize("script", SCRIPTS, ids=by_stem)
def test_example_is_short_and_draws(script, tmp_path, capsys):
    assert len(script.read_text("utf-8").splitlines()) < 100
    picture = tmp_path / "picture.svg"
    run_script(script, [str(picture)])
    output, errors = capsys.readouterr()
    assert len(re.findall(r"\d", output)) > 20
    assert "nan" not in output
    assert errors == ""
    assert ElementTree.parse(picture).getroot().tag.endswith("svg")


def test_tip_feels_less_and_reaches_farther_in_humid_air(capsys):
    rows = re.findall(
        r"(\d+)% +([\d.]+) MPa +([\d.]+) nm +([\d.]+) nN +([\d.]+) nm", printed_by("afm_humidity.py", capsys)
    )
    humidity, suction, radius, force, gap = np.array(rows, float).T
    assert humidity.tolist() == [40, 50, 60, 70, 80, 90]
    assert np.all(np.diff(force) < 0.0)
    assert np.all(np.diff(gap) > 0.0)
    assert suction == pytest.approx(-998.16 * 461.526e-6 * 293.15 * np.log(humidity / 100.0), abs=0.06)  # Kelvin
    assert radius == pytest.approx(72.736 / suction, rel=6e-3)  # mN/m over MPa, to the digits printed


def test_soil_starts_where_bridges_part(capsys):
    (suction,) = re.findall(r"apart from ([\d.]+) kPa", printed_by("soil_suction.py", capsys))
    assert float(suction) == pytest.approx(4.533478 * 0.0727361 / 37e-6 / 1e3, abs=0.006)  # H* of a 30 degree bridge


def test_beads_hold_the_liquid_of_their_moisture(capsys):
    output = printed_by("choose_law.py", capsys)
    (volume,) = re.findall(r"holds ([\d.]+) pL", output)
    bead = 4.0 / 3.0 * np.pi * 0.1**3  # mm3
    assert float(volume) == pytest.approx(0.01 * bead * 2500.0 / 998.2 / 3.0 * 1e6, abs=0.006)
    errors = [float(error) for error in re.findall(r"force within ([\d.]+)%", output)]
    assert errors == sorted(errors)


def test_work_of_the_pulls_is_that_of_their_force(capsys):
    output = printed_by("evaporation.py", capsys)
    works = re.findall(r"work ([\d.]+) pJ, ([\d.]+) pJ by its force", output)
    assert len(works) == 2
    for potential, by_force in works:
        assert float(potential) == pytest.approx(float(by_force), rel=1e-3)
    slow, fast = (float(work) for work, _ in works)
    assert 1.5 < fast / slow < 2.1  # twice in the limit of small bridges


def test_the_truth_of_a_made_curve_is_found(capsys):
    lines = printed_by("fit_curve.py", capsys).splitlines()
    told = {line.partition(":")[0]: [float(x) for x in re.findall(r"[\d.]+", line.partition(":")[2])] for line in lines}
    for fit in ("force alone", "and rupture"):
        angle, error, volume, volume_error, offset, offset_error = told[fit]
        assert abs(angle - 28.0) < 3.0 * error
        assert abs(volume - 10.0) < 3.0 * volume_error
        assert abs(offset - 3.0) < 3.0 * offset_error
    assert told["and rupture"][1] < told["force alone"][1]
    assert abs(told["by a law"][0] - 28.0) > 2.0 * told["by a law"][1]
