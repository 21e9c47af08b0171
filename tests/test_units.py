"""Units that are read without pint mean what they mean to pint, digit by digit."""

import re
import subprocess
import sys

import numpy as np
import pint
import pytest

from pendular.ground import units

SEED = 20261130


@pytest.mark.parametrize("unit", units._USUAL)
def test_a_usual_unit_is_that_of_pint(unit):
    print(f"seed {SEED}")
    random, registry = np.random.default_rng(SEED), pint.UnitRegistry()
    for own, _ in units._usual(unit).items():
        number = float(f"{10 ** random.uniform(-4, 4):.6g}")
        by_pint = float(registry.Quantity(number, own).to(unit).magnitude)
        assert units.read("x", f"{number!r}{own}", unit, "1") == float(f"{by_pint:.15g}"), own


def test_temperatures_and_degrees_are_those_of_pint():
    registry = pint.UnitRegistry()
    for celsius in (0.0, 20.0, 25.0, 36.6, -10.5):
        by_pint = float(registry.Quantity(celsius, "degC").to("K").magnitude)
        assert units.read("x", f"{celsius!r} degC", "K", "1") == float(f"{by_pint:.15g}")
    assert units.read_angle("x", "20deg") == 20.0


@pytest.mark.parametrize(("text", "unit"), [("2psi", "Pa"), ("0.01inch", "m"), ("72.8dyn/cm", "N/m"), ("3 ft", "m")])
def test_other_units_are_left_to_pint(text, unit):
    number = pint.UnitRegistry().Quantity(text).to(unit).magnitude
    assert units.read("x", text, unit, "1") == pytest.approx(number, rel=1e-14)


@pytest.mark.parametrize(("text", "unit"), [("5mm", "Pa"), ("5L", "m"), ("5 kN", "N/m"), ("1um^3", "m"), ("1xm", "m")])
def test_another_dimension_is_refused(text, unit):
    with pytest.raises(ValueError, match=re.escape(f"x: '{text}'")):
        units.read("x", text, unit, "1mm")


def test_usual_units_are_read_without_pint():
    script = """
import sys
from pendular.ground.units import read, read_angle
read("radius", "50um", "m", "50um"), read("suction", "20 kPa", "Pa", ""), read("volume", "5pL", "m^3", "")
read("temperature", "25degC", "K", ""), read_angle("angle", "20deg"), read_angle("angle", "0.35")
assert "pint" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", script], check=True)
