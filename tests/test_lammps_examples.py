"""The examples that run LAMMPS: two grains on the exact curve, and a packing that its bridges hold together."""

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from tools.site_parts import run_script

import pendular as pl

pytestmark = pytest.mark.long

FOLDER = Path(__file__).parents[1] / "examples"


def run(name, picture, capfd, *arguments):
    """Numbers printed by an example, which leaves a picture."""
    run_script(FOLDER / name, [str(picture), *arguments])
    assert ElementTree.parse(picture).getroot().tag.endswith("svg")
    return capfd.readouterr().out


def test_two_grains_break_where_the_exact_bridge_does(tmp_path, capfd):
    output = run("two_grains.py", tmp_path / "two.svg", capfd)
    grains = pl.Pair((50e-6, 100e-6), np.deg2rad(20))
    end = 1e6 * pl.rupture(grains, suction=5e3, liquid=pl.Liquid(surface_tension=0.0728)).separation
    found = re.findall(r"(\w+) +breaks between ([\d.]+) and ([\d.]+) um, .* within (\S+) of", output)
    codes = {code: (float(before), float(after), float(error)) for code, before, after, error in found}
    before, after, error = codes["LAMMPS"]
    assert before < end <= after
    assert after - before < 0.021
    assert error < 1e-8  # what the table was asked for
    if "YADE" in codes:
        before, after, error = codes["YADE"]
        assert before == pytest.approx(end, rel=0.01)
        assert error < 1e-3


def test_a_wet_packing_is_stronger_by_the_stress_of_its_bridges(tmp_path, capfd):
    output = run("wet_shear_picture.py", tmp_path / "shear.svg", capfd, "216")
    (dry,) = re.findall(r"216 grains under 1000 Pa; shear stress dry (\d+) Pa", output)
    assert 200 < float(dry) < 600
    rows = re.findall(r"^ *(\d+) kPa (\w+) +(.*)$", output, re.MULTILINE)
    assert [row[:2] for row in rows] == [(s, state) for s in ("10", "40", "160") for state in ("drained", "undrained")]
    by_stress, by_rumpf = [], []
    for _, state, numbers in rows:
        bridges, first, last, stress, gained, _, rumpf, ratio = (float(number) for number in numbers.split())
        assert 3.0 < bridges < 7.0
        assert stress > 1.8 * float(dry)
        assert gained == pytest.approx(stress - float(dry), abs=1.1)
        by_stress.append(ratio)
        by_rumpf.append(gained / rumpf)
        if state == "undrained":
            assert first == last  # of the liquid nothing is lost
    # So few grains shear by chance, from one run to another by a fifth: six runs together do not.
    print("found over predicted:", by_stress, by_rumpf)
    assert 0.6 < np.mean(by_stress) < 1.6
    assert 0.6 < np.mean(by_rumpf) < 1.6
    (inertia,) = re.findall(r"inertial number (\S+);", output)
    assert float(inertia) < 1e-2
