"""Public arguments: what passes, in which form, and the one line that refuses the rest."""

import math
import re

import numpy as np
import pint
import pytest

from pendular.ground.check import angle, broadcast, in_range, quantity, scalar

UNITS = pint.UnitRegistry()


def refused(message: str):
    """Expect a ValueError of exactly this one line."""
    return pytest.raises(ValueError, match=f"^{re.escape(message)}$")


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (3, 3.0),
        (np.float32(0.5), 0.5),
        ([1, 2.5], [1.0, 2.5]),
        ((1e-6, np.array(2e-6)), [1e-6, 2e-6]),
        (np.arange(6).reshape(2, 3), [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]),
        (50.0 * UNITS.um, 50e-6),
        ([1.0, 2.0] * UNITS.mm, [1e-3, 2e-3]),
        ([1.0 * UNITS.mm, 2.0 * UNITS.um, 3e-6], [1e-3, 2e-6, 3e-6]),
    ],
)
def test_numbers_become_si_arrays(value, expected):
    result = quantity("radius", value, "m")
    assert result.dtype == np.float64
    assert result.shape == np.shape(expected)
    np.testing.assert_allclose(result, expected, rtol=1e-15)


@pytest.mark.parametrize(
    ("value", "unit", "expected"),
    [
        (UNITS.Quantity(20.0, "degC"), "K", 293.15),
        (UNITS.Quantity(20.0, "degree"), "rad", math.pi / 9),
        (UNITS.Quantity(50.0, "percent"), "", 0.5),
        (UNITS.Quantity(1.0, "g/cm**3"), "kg/m**3", 1000.0),
        (UNITS.Quantity(72.8, "mN/m"), "N/m", 0.0728),
        (UNITS.Quantity(18.0, "g/mol"), "kg/mol", 0.018),
    ],
)
def test_every_unit_of_the_library_is_understood(value, unit, expected):
    assert scalar("x", value, unit) == pytest.approx(expected, rel=1e-14)


class OtherQuantity(np.ndarray):
    """Behaves as astropy's quantities do: an array with ``unit`` and ``to``, and no ``magnitude``."""

    unit = "um"

    def to(self, unit):
        """Return itself in another unit."""
        assert unit == "m"
        return 1e-6 * self


def test_units_of_another_package_are_not_stripped():
    assert quantity("radius", np.array([50.0]).view(OtherQuantity), "m") == pytest.approx([50e-6])


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (True, "radius: True is not a real number"),
        ([1.0, True], "radius: True is not a real number"),
        (np.bool_(False), "radius: False is not a real number"),
        (np.array([True]), "radius: an array of type bool does not hold real numbers"),
        (None, "radius: None is not a real number"),
        ([1.0, None], "radius: an array of type object does not hold real numbers"),
        ("50 um", "radius: '50 um' is not a real number"),
        (["1", "2"], "radius: an array of type <U1 does not hold real numbers"),
        (1j, "radius: 1j is not a real number"),
        ({"a": 1}, "radius: {'a': 1} is not a real number"),
        (math.nan, "radius: nan m is not a number"),
        ([1.0, math.nan], "radius[1]: nan m is not a number"),
        ([[1.0, 2.0], [3.0, -math.inf]], "radius[1, 1]: -inf m is not finite"),
        (math.inf, "radius: inf m is not finite"),
        ([], "radius: an array of shape (0,) holds no number"),
        (np.empty((2, 0)), "radius: an array of shape (2, 0) holds no number"),
        ([[1.0], [2.0, 3.0]], "radius: a nested sequence of unequal lengths is not an array"),
        (5.0 * UNITS.kPa, "radius: a quantity in kilopascal is not one in m"),
        ([1e-6, 5.0 * UNITS.s], "radius: a quantity in second is not one in m"),
    ],
)
def test_what_is_no_length_is_refused(value, message):
    with refused(message):
        quantity("radius", value, "m")


def test_a_length_is_no_pure_number():
    with refused("humidity: a quantity in meter is not a pure number"):
        quantity("humidity", 0.5 * UNITS.m, "")


def test_infinity_passes_where_it_has_a_meaning():
    assert quantity("radius", [1.0, math.inf], "m", allow_inf=True)[1] == math.inf
    with refused("radius: nan m is not a number"):
        quantity("radius", math.nan, "m", allow_inf=True)


def test_scalar_is_a_float_and_takes_no_array():
    assert type(scalar("temperature", np.array(300), "K")) is float
    with refused("temperature: an array of shape (1,) is given where one number is needed"):
        scalar("temperature", [300.0], "K")


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (("radius", -5e-05, 0.0), {"brackets": "()", "unit": "m"}, "radius: -5e-05 m is not > 0"),
        (("suction", -1.0, 0.0), {"unit": "Pa"}, "suction: -1.0 Pa is not >= 0"),
        (("x", 2.0, -math.inf, 1.0), {}, "x: 2.0 is not <= 1"),
        (("x", 1.0, -math.inf, 1.0), {"brackets": "()"}, "x: 1.0 is not < 1"),
        (("humidity", 1.2, 0.0, 1.0), {"brackets": "()"}, "humidity: 1.2 is not in (0, 1)"),
        (("humidity", 0.0, 0.0, 1.0), {"brackets": "(]"}, "humidity: 0.0 is not in (0, 1]"),
        (("x", np.array([0.5, 1.0, 3.0]), 0.0, 1.0), {"brackets": "[)"}, "x[1]: 1.0 is not in [0, 1)"),
        (("x", np.array([[0.5, 7.0]]), 0.0, 1.0), {}, "x[0, 1]: 7.0 is not in [0, 1]"),
        (("x", math.nan, 0.0, 1.0), {}, "x: nan is not in [0, 1]"),
        (("x", 2.0, 0.0, 1.0), {"high_hint": "not {value}", "low_hint": "more"}, "x: 2.0 is not in [0, 1]; not 2.0"),
        (("x", -2.0, 0.0, 1.0), {"high_hint": "less", "low_hint": "more"}, "x: -2.0 is not in [0, 1]; more"),
    ],
)
def test_values_outside_an_interval_are_named(arguments, options, message):
    with refused(message):
        in_range(*arguments, **options)


def test_values_inside_pass_unchanged():
    values = np.array([0.0, 0.5])
    assert in_range("x", values, 0.0, 1.0, brackets="[)") is values
    assert in_range("radius", math.inf, 0.0, brackets="(]") == math.inf


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (20.0, "contact_angle: 20.0 rad is not in [0, pi); for degrees use numpy.deg2rad(20.0)"),
        ([0.1, 40.0], "contact_angle[1]: 40.0 rad is not in [0, pi); for degrees use numpy.deg2rad(40.0)"),
        (-0.1, "contact_angle: -0.1 rad is not in [0, pi)"),
        (math.pi, f"contact_angle: {math.pi} rad is not in [0, pi)"),
        (180.0, "contact_angle: 180.0 rad is not in [0, pi)"),
    ],
)
def test_angles_outside_zero_to_pi_are_refused(value, message):
    with refused(message):
        angle("contact_angle", value)


def test_angles_inside_pass():
    np.testing.assert_array_equal(angle("contact_angle", [0.0, 3.1]), [0.0, 3.1])


def test_broadcast_keeps_the_order_and_names_all_shapes():
    gap, suction = broadcast(separation=np.zeros((2, 1)), suction=np.arange(3.0))
    assert gap.shape == suction.shape == (2, 3)
    np.testing.assert_array_equal(suction[1], [0.0, 1.0, 2.0])
    with refused("shapes do not broadcast: separation (2,), suction (3,), contact_angle ()"):
        broadcast(separation=np.zeros(2), suction=np.zeros(3), contact_angle=np.array(0.1))
