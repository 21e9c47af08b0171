"""The examples: each runs, prints its numbers, and leaves a picture where it is asked to."""

import re
import runpy
import warnings
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from tools.site_parts import run_script

import pendular as pl

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


def numbers(line):
    return [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", line)]


def test_salt_bridges_obey_kelvin_and_leave_their_salt(capsys):
    output = printed_by("powder_caking.py", capsys)
    for humidity, radius, wet, neck, dried, strength, _ in map(numbers, output.splitlines()[1:7]):
        suction = 997.05 * 461.526 * 298.15 * np.log(75.29 / humidity)  # Kelvin, over the activity
        assert radius == pytest.approx(1e9 * 0.080 / suction, rel=0.02, abs=0.06)
        assert wet == pytest.approx(2e6 * np.pi * 0.080 * 100e-6, rel=0.025)  # the limit of small bridges
        assert dried == pytest.approx(2.0 * np.pi * neck**2, rel=0.02, abs=0.06)
        assert strength == pytest.approx(0.6 * 6 * wet / (np.pi * 200**2) * 1e3, abs=0.006)  # Rumpf
    weak, strong = re.findall(r"from ([\d.]+)% on", output)
    assert 70.0 < float(strong) < float(weak) < 75.29


def test_the_salt_of_a_bridge_fills_the_gap_up_to_the_neck():
    script = runpy.run_path(str(FOLDER / "powder_caking.py"))
    bridge = script["bridge_at"](0.745)
    neck = script["neck_of"](bridge)
    radius = script["RADIUS"]
    filled = 2.0 * quad(lambda r: 2.0 * np.pi * r * (radius - np.sqrt(radius**2 - r**2)), 0.0, float(neck))[0]
    assert filled == pytest.approx(script["SALT"] * 1197.0 / 2165.0 * float(bridge.volume), rel=1e-3)


def test_a_castle_bears_its_weight_on_its_foot(capsys):
    output = printed_by("sand_castle.py", capsys)
    (solid,) = re.findall(r"([\d.]+)% of the heap", output)
    heights = []
    for water, _, _, bridges, stress, cohesion, column, cut in map(numbers, output.splitlines()[2:]):
        assert cohesion == pytest.approx(stress * np.tan(np.deg2rad(35)), abs=1.0)
        weight = 9.81 * (float(solid) / 100 * 2650.0 + water / 100 * 998.2)
        assert column == pytest.approx(2.0 * cohesion * np.tan(np.deg2rad(62.5)) / weight, rel=0.01)
        assert cut == pytest.approx(2.0 * column, abs=0.002)
        most = float(solid) / 100 * bridges * 2.0 * 0.07274 * 100e-6 / 200e-6**2  # by Rumpf, were all at contact
        assert 0.5 * most < stress < most
        heights.append(column)
    assert max(heights) < 1.1 * min(heights)


def test_a_drop_between_plates_spreads_as_it_is_thin(capsys):
    lines = printed_by("plate_coating.py", capsys).splitlines()
    for gap, radius, suction, force, error, weight in map(numbers, lines[1:8]):
        assert radius == pytest.approx(1e3 * np.sqrt(5e-9 / (np.pi * gap * 1e-6)), rel=0.25 * gap / 500)
        usual = 2e3 * 0.035 * np.cos(np.deg2rad(20)) * 5e-9 / (gap * 1e-6) ** 2
        assert error == pytest.approx(100.0 * (usual / force - 1.0), abs=0.1 + 0.6 / force)
        assert weight == pytest.approx(100.0 * 1100 * 9.81 * gap * 1e-6 / suction, abs=0.06 + 50 / suction)


def test_the_ball_goes_to_the_side_that_holds_harder(capsys):
    output = printed_by("microgripper.py", capsys)
    weight, seat = numbers(output.splitlines()[0])[:2]
    rows = re.findall(r"^ *(\d+)° +([\d.]+) nl +([\d.]+) µN .* (seat|tool)$", output, re.MULTILINE)
    assert len(rows) == 9
    for angle, volume, held, goes in rows:
        assert goes == ("seat" if seat + weight > float(held) else "tool")
        limit = 2e6 * np.pi * 0.25e-3 * 0.072736 * (np.cos(np.deg2rad(30)) + np.cos(np.deg2rad(float(angle))))
        most = float(held)
        assert most < limit
        pair = pl.Pair((0.25e-3, np.inf), (np.deg2rad(30), np.deg2rad(float(angle))))
        held = {"volume": float(volume) * 1e-12, "liquid": pl.Liquid.water(temperature=293.15)}
        gaps = np.linspace(0.0, 0.9999, 401) * pl.rupture(pair, **held).separation
        force = pl.bridge(pair, gaps, **held).force
        assert 1e6 * force.max() == pytest.approx(most, abs=0.06)
        assert np.all(np.diff(force)[np.argmax(force) :] < 0.0)  # else what gives way might hold again
        assert force[0] > 0.98 * force.max()


def test_a_heap_remembers_little_with_vapour_and_much_without(capsys):
    lines = printed_by("retention_hysteresis.py", capsys).splitlines()
    rows = [re.findall(r"([\d.]+)% +([\d.]+) +(\d+) Pa", line) for line in lines[3:]]
    drying, vapour, contact = np.array(rows, float).transpose(1, 2, 0)
    assert np.all(drying >= vapour)
    assert np.all(vapour >= contact)
    loss = 1.0 - vapour[0] / drying[0]
    assert np.all(loss[:3] < 0.021)
    assert 0.05 < loss[-1] < 0.15
    assert contact[0, 0] / drying[0, 0] < 0.06


def test_rough_beads_slide_where_weight_beats_friction(capsys):
    lines = printed_by("humid_friction.py", capsys).splitlines()
    script = runpy.run_path(str(FOLDER / "humid_friction.py"))
    humidity = np.array([0.3, 0.6, 0.8, 0.9, 0.95, 0.99, 0.999])
    weight = 0.6 * 2500.0 * 9.81 * 0.01
    gaps = -np.log1p(-(np.arange(4000) + 0.5) / 4000)  # of contacts by their rank, over the mean gap
    for roughness, told in zip((0.0, 10e-9, 100e-9, 1e-6), np.split(np.array(lines[1:]), 4), strict=True):
        stress, slope = (numbers(line.partition(word)[2]) for line, word in zip(told[1:], ("Pa", "at"), strict=True))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", pl.KelvinWarning)
            force = pl.bridge(script["BEADS"], roughness * gaps, humidity=0.99, liquid=script["WATER"]).force
        assert stress[5] == pytest.approx(0.6 * 6 * force.mean() / (np.pi * 200e-6**2), rel=0.01)
        for pressed, angle in zip(stress, slope, strict=True):
            pulls = weight * np.sin(np.deg2rad(angle))
            holds = np.tan(np.deg2rad(25)) * (weight * np.cos(np.deg2rad(angle)) + pressed)
            assert holds >= pulls - 0.6 if angle == 90.0 else holds == pytest.approx(pulls, abs=0.6)
    assert humidity.size == len(stress)
