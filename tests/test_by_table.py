"""Public questions answered from tables, beside the exact answers."""

import math
import re

import numpy as np
import pytest

import pendular as pl

WATER = pl.Liquid(surface_tension=0.0728)
SEED = 20261123


def questions(count):
    """Random pairs of two contact angles, planes among them, and gaps below the rupture distance at a suction."""
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    radius1, radius2 = 10.0 ** random.uniform(-6, -4, (2, count))
    radius1[::10] = math.inf
    angle = np.where(random.uniform(size=count) < 0.5, 0.2, 0.6)
    pair = pl.Pair((radius1, radius2), angle)
    suction = 10.0 ** random.uniform(3, 6, count)
    rupture = pl.rupture(pair, suction=suction, liquid=WATER).separation
    return pair, suction, rupture, rupture * random.uniform(0.0, 1.3, count)


def test_answers_are_exact_to_the_bound_of_the_table():
    pair, suction, rupture, separation = questions(2000)
    exact = pl.bridge(pair, separation, suction=suction, liquid=WATER)
    contact = pl.bridge(pair, 0.0, suction=suction, liquid=WATER)
    by_table = pl.bridge(pair, separation, suction=suction, liquid=WATER, method="table")
    np.testing.assert_array_equal(by_table.exists, separation < rupture)
    assert np.max(np.abs(by_table.force - exact.force) / contact.force) < 2e-8
    inside = separation < 0.99 * rupture
    assert np.nanmax(np.abs(by_table.volume - exact.volume) / contact.volume) < 1e-5
    np.testing.assert_allclose(by_table.stiffness[inside], exact.stiffness[inside], rtol=1e-4)
    assert np.isnan(by_table.volume[~by_table.exists]).all()
    folds = pl.rupture(pair, suction=suction, liquid=WATER, method="table")
    np.testing.assert_allclose(folds.separation, rupture, rtol=1e-9)


def test_solids_that_no_suction_holds():
    pair = pl.Pair(50e-6, 2.0)
    dry = pl.bridge(pair, [0.0, 1e-6], suction=1e4, liquid=WATER, method="table")
    assert dry.exists.tolist() == [False, False]
    assert dry.force.tolist() == [0.0, 0.0]
    end = pl.rupture(pair, suction=1e4, liquid=WATER, method="table")
    assert not end.exists
    assert math.isnan(end.separation)


def test_humidity_is_a_suction():
    grains = pl.Pair(50e-6, 0.2)
    water = pl.Liquid.named("water", 293.15)
    by_table, exact = (pl.bridge(grains, 0.0, humidity=0.99, liquid=water, method=m) for m in ("table", "exact"))
    assert by_table.force == pytest.approx(exact.force, rel=1e-7)
    assert by_table.suction == pytest.approx(exact.suction, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"separation": -1e-9}, "separation: -1e-09 m is not >= 0, where method 'table' ends; 'exact' knows overlaps"),
        ({"suction": 1e-3}, "reduced suction: 6.86813e-07 is not in [0.01, 1e+08], the range of the table"),
        ({"branch": "unstable"}, "branch: 'unstable' is not one of 'stable'"),
    ],
)
def test_what_a_table_does_not_know_is_refused(change, line):
    with pytest.raises(ValueError, match=re.escape(line)):
        pl.bridge(pl.Pair(50e-6, 0.2), **{"separation": 0.0, "suction": 1e4, **change}, liquid=WATER, method="table")


def test_the_fold_at_constant_volume_is_refused():
    with pytest.raises(ValueError, match="limit: 'fold' is not one of 'stability'"):
        pl.rupture(pl.Pair(50e-6, 0.2), volume=1e-16, liquid=WATER, method="table", limit="fold")
