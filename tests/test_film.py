"""Adsorbed films: thicker solids in a narrower gap, and where a bridge takes the place of two films."""

import math
import re

import numpy as np
import pytest

import pendular as pl

UNIT = pl.Liquid(surface_tension=1.0)
WATER = pl.Liquid.water()
TIP = pl.Pair((1e-6, math.inf))


def refused(message):
    """Expect a ValueError of exactly this one line."""
    return pytest.raises(ValueError, match=f"^{re.escape(message)}$")


def test_the_disjoining_pressure_of_a_film_is_the_suction():
    rng = np.random.default_rng(11)
    suction, constant = 10.0 ** rng.uniform(4, 8, 50), 10.0 ** rng.uniform(-21, -19, 50)
    thickness = pl.film_thickness(suction, constant)
    np.testing.assert_allclose(constant / (6.0 * math.pi * thickness**3), suction, rtol=1e-14)
    assert isinstance(pl.film_thickness(1e6, 1e-20), float)


def test_films_make_spheres_thicker_and_the_gap_narrower():
    pair, shift = pl.filmed(pl.Pair((1e-6, 2e-6), (0.1, 0.2)), (2e-9, 3e-9))
    np.testing.assert_allclose(pair.radii, (1.002e-6, 2.003e-6), rtol=1e-15)
    assert pair.contact_angles == (0.1, 0.2)
    assert shift == pytest.approx(5e-9, rel=1e-15)
    many, shifts = pl.filmed(TIP, np.array([0.0, 1e-9]))
    assert many.radii[0].shape == shifts.shape == (2,)
    assert np.isinf(many.radii[1]).all()


@pytest.mark.parametrize("radii", [1e-6, (1e-6, 3e-6), (1e-6, math.inf)])
@pytest.mark.parametrize("degrees", [0, 30, 70])
def test_a_bridge_costs_nothing_where_it_condenses(radii, degrees):
    """By the integral of the force: what it takes to pull the bridge from there to contact is its energy there."""
    pair = pl.Pair(radii, math.radians(degrees))
    gap = pl.condensation_separation(pair, suction=1e7, liquid=WATER)
    end = pl.rupture(pair, suction=1e7, liquid=WATER).separation
    assert 0.0 < gap < end
    there, contact = (pl.bridge(pair, place, suction=1e7, liquid=WATER) for place in (gap, 0.0))
    assert abs(there.grand_potential) < 1e-12 * abs(contact.grand_potential)
    places = 0.5 * gap * (1.0 + np.polynomial.legendre.leggauss(40)[0])
    weights = 0.5 * gap * np.polynomial.legendre.leggauss(40)[1]
    work = weights @ pl.bridge(pair, places, suction=1e7, liquid=WATER).force
    assert work == pytest.approx(-contact.grand_potential, rel=1e-9)


def test_films_move_it_by_both_thicknesses_and_their_energy_by_one_more():
    """Derjaguin: planes at a suction fill at 2γ/Δp + 3t; his limit of large spheres, as printed at 1 m: 3 - 1.4e-7."""
    suction, constant, large = 1e6, 1e-20, pl.Pair(1.0)
    t = pl.film_thickness(suction, constant)
    bare, thick, held = (
        pl.condensation_separation(large, suction=suction, liquid=pl.Liquid(0.072), **films)
        for films in ({}, {"thickness": t}, {"hamaker_constant": constant})
    )
    assert (thick - bare) / t == pytest.approx(2.0, abs=1e-8)
    assert (held - bare) / t == pytest.approx(3.0, abs=1e-6)
    assert bare * suction / (2.0 * 0.072) == pytest.approx(1.0, abs=0.01)


def test_it_broadcasts_and_knows_humidity_and_where_there_is_none():
    suction = np.array([1e6, 1e7])
    both = pl.condensation_separation(TIP, suction=suction, liquid=WATER, hamaker_constant=1e-20)
    each = [pl.condensation_separation(TIP, suction=s, liquid=WATER, hamaker_constant=1e-20) for s in suction.tolist()]
    np.testing.assert_allclose(both, each, rtol=1e-12)
    moist = pl.condensation_separation(TIP, humidity=0.95, liquid=WATER)
    assert moist == pl.condensation_separation(TIP, suction=pl.suction_from_humidity(0.95, WATER), liquid=WATER)
    assert math.isnan(pl.condensation_separation(pl.Pair(1e-6, 2.0), suction=1e7, liquid=WATER))


def test_bad_films_are_refused():
    with refused("thickness: 2e-07 m is not in [0, 1e-07)"):
        pl.filmed(TIP, 2e-7)
    with refused("thickness: a tuple of 3 is not a pair (first solid, second solid)"):
        pl.filmed(TIP, (1e-9, 1e-9, 1e-9))
    with refused("thickness: given together with hamaker_constant; one of the two is needed"):
        pl.condensation_separation(TIP, suction=1e6, liquid=WATER, thickness=1e-9, hamaker_constant=1e-20)
    with refused("pair: two planes hold no stable bridge at a suction; a sphere is needed"):
        pl.condensation_separation(pl.Pair(math.inf), suction=1e6, liquid=WATER)
    with pytest.raises(ValueError, match=r"^suction: 0\.0 Pa is not > 0"):
        pl.film_thickness(0.0, 1e-20)
