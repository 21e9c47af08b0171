"""Laws asked through the public face: reduction, warnings, refusals."""

import warnings

import numpy as np
import pytest

import pendular as pl
from pendular.laws import force_star, rupture_star

WATER = pl.Liquid(surface_tension=0.0728)
GRAINS = pl.Pair(radius=(40e-6, 100e-6), contact_angle=np.deg2rad(20))
SUCTION = 5e5
FORCE_LAWS = [name for name, law in pl.laws.items() if "force" in law.gives and law.control == "suction"]
SUCTION_LAWS = [name for name, law in pl.laws.items() if law.control == "suction"]


@pytest.fixture(autouse=True)
def _outside_is_no_matter():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pl.RangeWarning)
        yield


def reduced(pair, suction):
    """Reduced suction, angles and κ of a pair, written out again."""
    first, second = 40e-6, 100e-6
    mean = 2.0 * first * second / (first + second)
    return mean, suction * mean / 0.0728, *pair.contact_angles, mean / first, mean / second


@pytest.mark.parametrize("name", FORCE_LAWS)
def test_force_is_scaled_by_the_derjaguin_radius(name):
    mean, *reduced_pair = reduced(GRAINS, SUCTION)
    gaps = np.array([0.0, 1e-8, 1e-5])
    b = pl.bridge(GRAINS, gaps, suction=SUCTION, liquid=WATER, method=name)
    expected = 2.0 * np.pi * 0.0728 * mean * force_star(name, gaps / mean, *reduced_pair)
    assert b.force == pytest.approx(expected, rel=1e-12)
    assert list(b.exists) == [True, True, False]
    assert b.force[-1] == 0.0
    assert np.isnan(b.separation[-1])


@pytest.mark.parametrize("name", SUCTION_LAWS)
def test_rupture_is_scaled_by_the_derjaguin_radius(name):
    mean, *reduced_pair = reduced(GRAINS, SUCTION)
    r = pl.rupture(GRAINS, suction=SUCTION, liquid=WATER, method=name)
    assert r.separation == pytest.approx(float(mean * rupture_star(name, *reduced_pair)), rel=1e-12)
    assert np.isnan(r.volume)


@pytest.mark.parametrize("name", FORCE_LAWS)
def test_laws_approach_the_exact_force(name):
    pair = pl.Pair(radius=1e-3, contact_angle=np.deg2rad(20))  # H* = 1e6
    exact = pl.bridge(pair, 0.0, suction=7.28e7, liquid=WATER).force
    assert pl.bridge(pair, 0.0, suction=7.28e7, liquid=WATER, method=name).force == pytest.approx(exact, rel=1e-2)


def test_humidity_is_a_suction_for_a_law_too():
    water = pl.Liquid.water()
    force = pl.bridge(GRAINS, 0.0, humidity=0.95, liquid=water, method="asymptotic").force
    suction = pl.suction_from_humidity(0.95, water)
    assert force == pl.bridge(GRAINS, 0.0, suction=suction, liquid=water, method="asymptotic").force


def test_outside_the_published_range_one_warning_a_call():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        b = pl.bridge(GRAINS, [0.0, 1e-9], suction=[1.0, 2.0], liquid=WATER, method="zhao2020")
    assert [warning.category for warning in caught] == [pl.RangeWarning]
    assert str(caught[0].message).startswith("zhao2020: suction_star 0.000784")
    assert caught[0].filename == __file__
    assert b.force.shape == (2,)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"method": "zhao"}, "method: 'zhao' is not one of 'exact', 'dataset', 'zhao2020', "),
        ({"method": "asymptotic_rupture"}, "method: 'asymptotic_rupture' gives no force, only the rupture"),
        ({"method": "zhao2020", "branch": "unstable"}, "branch: 'unstable' is not one of 'stable'"),
    ],
)
def test_refusals(options, message):
    with pytest.raises(ValueError, match="^" + message.replace("(", r"\(")):
        pl.bridge(GRAINS, 0.0, suction=SUCTION, liquid=WATER, **options)


def test_a_law_has_its_own_control():
    with pytest.raises(ValueError, match=r"^method: 'zhao2020' is a law at constant suction"):
        pl.bridge(GRAINS, 0.0, volume=1e-16, liquid=WATER, method="zhao2020")
