"""The viscous force of Pitois et al. against Reynolds' equation, solved between spheres, and against its limits."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import pendular as pl
from pendular.laws import damping_star, laws
from pendular.laws.pitois2000 import LAW

STATED = {
    1e-6: 4.5e-3,
    1e-4: 4.5e-3,
    1e-3: 4.5e-3,
    1e-2: 1.5e-2,
    0.1: 4.7e-2,
}  # volume: largest error, as the help says


def by_reynolds(separation, volume):
    """Force of a liquid of that volume in a cylinder between two spheres of radius 1, over viscosity and speed.

    r h³ dp/dr = 6 μ r² dh/dt, with the pressure of the gas at the edge; the force is the integral of π r² dp.
    """

    def height(r):
        return separation + 2.0 * r * r / (1.0 + math.sqrt(1.0 - r * r))

    def volume_to(edge):
        cap = 1.0 / 3.0 - (1.0 - edge * edge) ** 1.5 / 3.0  # of r sqrt(1 - r²)
        return 2.0 * math.pi * ((0.5 * separation + 1.0) * edge * edge - 2.0 * cap)

    edge = brentq(lambda r: volume_to(r) - volume, 1e-12, 1.0 - 1e-12, xtol=1e-15)
    # in the logarithm of r, for most of it comes from r² near the gap
    ends = math.log(edge) - 40.0, math.log(edge)
    inside, _ = quad(lambda u: (math.exp(u) ** 4) / height(math.exp(u)) ** 3, *ends, limit=400, epsrel=1e-10)
    return 6.0 * math.pi * inside


@pytest.mark.parametrize("volume", STATED)
def test_the_error_against_reynolds_is_the_one_that_the_help_states(volume):
    gaps = np.geomspace(1e-5, 1.0, 41) * volume ** (1.0 / 3.0)
    exact = np.array([by_reynolds(gap, volume) for gap in gaps.tolist()])
    error = damping_star("pitois2000", gaps, volume, 0.0, 0.0, 1.0, 1.0) / exact - 1.0
    assert np.all(error > -1e-7)
    assert error.max() < STATED[volume]


def test_much_liquid_gives_the_lubrication_force_of_two_spheres_and_of_a_sphere_on_a_plane():
    """6 π μ R² dD/dt / D, R = R1 R2/(R1 + R2)."""
    gap = 1e-9
    found = float(damping_star("pitois2000", gap, 0.1, 0.0, 0.0, 1.0, 1.0))
    assert found == pytest.approx(6.0 * math.pi * 0.5**2 / gap, rel=1e-7)


def test_a_far_gap_gives_the_force_of_a_disc_of_liquid():
    """Between planes, 3 π μ b⁴/(2 D³) dD/dt, and the volume is π b² D."""
    gap, volume = 1e4, 1.0
    expected = 1.5 * math.pi * (volume / math.pi / gap) ** 2 / gap**3
    assert float(damping_star("pitois2000", gap, volume, 0.0, 0.0, 1.0, 1.0)) == pytest.approx(expected, rel=1e-7)


def test_no_bridge_at_rest_has_it():
    water = pl.Liquid(surface_tension=0.0728)
    assert laws["pitois2000"] is LAW
    with pytest.raises(ValueError, match="law: pitois2000 gives only the damping, which no bridge at rest has"):
        pl.error_map("pitois2000")
    with pytest.raises(ValueError, match="method: 'pitois2000' gives no force, only the damping"):
        pl.bridge(pl.Pair(50e-6), 1e-6, volume=1e-15, liquid=water, method="pitois2000")
    found = pl.compare(pl.Pair(50e-6), volume=1e-15, liquid=water)
    assert found.refused["pitois2000"] == "its damping belongs to solids that move"
