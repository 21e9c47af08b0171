"""Liquid between two planes: at a volume, where it is stable up to rupture, and under suction, where it never is."""

import math
import re
from collections import Counter

import numpy as np
import pytest

import pendular as pl
from oracles.made_between_planes import made_between_planes

LIQUID = pl.Liquid(surface_tension=0.0728)
UNIT = pl.Liquid(surface_tension=1.0)
WATER = pl.Liquid.water()
PLATES = pl.Pair(math.inf, math.radians(40.0))
DROP = {"volume": 1e-9, "liquid": LIQUID}
UNSTABLE_ONLY = (
    "holds no stable bridge between two planes, which dries up or floods the gap; hold a volume, or ask "
    "bridge(branch='unstable') for the one between the two"
)


def refused(message):
    """Expect a ValueError of exactly this one line."""
    return pytest.raises(ValueError, match=f"^{re.escape(message)}$")


# -- at a volume ---------------------------------------------------------------------------------------------------


def test_a_microlitre_between_plates():
    bridge = pl.bridge(PLATES, 0.4e-3, **DROP)
    assert 1e6 * bridge.force == pytest.approx(875.6914, abs=5e-5)
    assert bridge.stable
    assert bridge.sideways_stable
    np.testing.assert_array_equal(bridge.half_filling_angle, 0.0)
    np.testing.assert_array_equal(pl.bridge(pl.Pair((math.inf, math.inf), (0.7, 0.7)), 4e-4, **DROP).exists, True)


def test_a_cylinder_breaks_where_it_is_half_a_wave_long():
    """V = πR²D and D = πR: the end of stability of Plateau's cylinder between planes that it meets at a right angle."""
    plates = pl.Pair(math.inf, math.pi / 2.0)
    end = pl.rupture(plates, volume=1.0, liquid=UNIT)
    assert end.separation == pytest.approx(math.pi ** (1.0 / 3.0), rel=1e-11)
    assert end.suction * end.contact_radius[0] == pytest.approx(-1.0, rel=1e-11)
    assert pl.bridge(plates, 0.999 * end.separation, volume=1.0, liquid=UNIT).stable
    assert not pl.bridge(plates, 1.001 * end.separation, volume=1.0, liquid=UNIT).exists
    symmetric = pl.bridge(plates, 1.001 * end.separation, volume=1.0, liquid=UNIT, limit="fold")
    assert symmetric.exists
    assert not symmetric.stable


@pytest.mark.parametrize("degrees", [(0, 0), (40, 40), (20, 110), (0, 150), (130, 130)])
def test_the_force_is_the_slope_of_the_energy(degrees):
    plates = pl.Pair(math.inf, tuple(map(math.radians, degrees)))
    distance = 0.6 * pl.rupture(plates, volume=1.0, liquid=UNIT).separation
    step = 1e-4 * distance
    gaps = distance + step * np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
    bridge = pl.bridge(plates, gaps, volume=1.0, liquid=UNIT)
    slope = np.dot([1.0, -8.0, 0.0, 8.0, -1.0], bridge.surface_energy) / (12.0 * step)
    assert bridge.force[2] == pytest.approx(slope, rel=1e-8, abs=1e-9)
    stiffness = np.dot([1.0, -8.0, 0.0, 8.0, -1.0], bridge.force) / (12.0 * step)
    assert bridge.stiffness[2] == pytest.approx(stiffness, rel=1e-8)


def test_each_plate_is_pulled_by_its_line_and_by_the_pressure():
    """F = 2πγ Y sin θ + π Y² Δp at either plate, in gaps of any width."""
    angles = np.array([[0.0, 0.3], [0.7, 0.7], [1.2, 2.9], [2.2, 0.0], [3.0, 3.0]])
    pair = pl.Pair(math.inf, (angles[:, None, 0], angles[:, None, 1]))
    gaps = np.geomspace(1.0001e-5, 0.06, 12)  # from just inside the domain
    bridge = pl.bridge(pair, gaps, volume=1.0, liquid=UNIT)
    assert bridge.exists.all()
    assert bridge.stable.all()
    for solid in (0, 1):
        radius, sine = bridge.contact_radius[..., solid], np.sin(angles[:, None, solid])
        pulled = 2.0 * math.pi * radius * sine + math.pi * radius**2 * bridge.suction
        scale = 2.0 * math.pi * radius + math.pi * radius**2 * np.abs(bridge.suction)
        np.testing.assert_allclose(bridge.force / scale, pulled / scale, rtol=0.0, atol=1e-11)


def test_a_very_large_sphere_is_a_plane():
    sphere = pl.Pair((1e6, math.inf), (0.4, 1.0))
    plates = pl.Pair(math.inf, (0.4, 1.0))
    for gap in (0.1, 0.5):
        between = pl.bridge(plates, gap, volume=1.0, liquid=UNIT)
        assert pl.bridge(sphere, gap, volume=1.0, liquid=UNIT).force == pytest.approx(between.force, rel=5e-5)
    reach = [pl.rupture(pair, volume=1.0, liquid=UNIT).separation for pair in (sphere, plates)]
    assert reach[0] == pytest.approx(reach[1], rel=1e-5)


def test_the_curve_goes_from_a_fifth_of_the_rupture_distance_to_it_and_down():
    curve, end = pl.curve(PLATES, points=21, **DROP), pl.rupture(PLATES, **DROP)
    assert np.argmax(curve.separation) == 10
    assert curve.separation[10] == pytest.approx(end.separation, rel=1e-12)
    assert curve.separation[0] == pytest.approx(0.2 * end.separation, rel=1e-12)
    assert curve.stable[:10].all()
    assert not curve.stable[11:].any()
    np.testing.assert_allclose(curve.volume, 1e-9, rtol=1e-12)


def test_there_is_no_lower_end():
    assert not pl.rupture(PLATES, end="lower", **DROP).exists
    assert pl.bridge(PLATES, 2e-5 * 1e-3, **DROP).exists


def test_the_profile_ends_on_the_plates():
    bridge = pl.bridge(PLATES, 0.4e-3, **DROP)
    profile = bridge.profile(101)
    np.testing.assert_allclose(profile.x[[0, -1]], [0.0, 0.4e-3], rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(profile.y[[0, -1]], bridge.contact_radius, rtol=1e-12)
    np.testing.assert_allclose(profile.solid_x, [[0.0] * 101, [0.4e-3] * 101], rtol=0.0, atol=1e-15)


def test_planes_and_spheres_mix_in_one_array():
    pair = pl.Pair(([1e-3, math.inf], math.inf), 0.5)
    together = pl.bridge(pair, [[1e-4], [4e-4]], **DROP)
    assert together.exists.all()
    for i, radius in enumerate((1e-3, math.inf)):
        alone = pl.bridge(pl.Pair((radius, math.inf), 0.5), [1e-4, 4e-4], **DROP)
        np.testing.assert_array_equal(together.force[:, i], alone.force)


# -- under suction -------------------------------------------------------------------------------------------------


def test_a_nucleus_is_answered_as_the_unstable_bridge():
    nucleus = pl.bridge(PLATES, 4e-4, suction=[100.0, 0.0, -50.0], liquid=LIQUID, branch="unstable")
    assert nucleus.exists.all()
    np.testing.assert_array_equal(nucleus.unstable_directions, 1)
    assert not nucleus.stable.any()
    held = pl.bridge(PLATES, 4e-4, volume=nucleus.volume, liquid=LIQUID)
    assert held.stable.all()
    np.testing.assert_allclose(held.suction, nucleus.suction, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(held.force, nucleus.force, rtol=1e-11)


def test_no_nucleus_where_the_suction_empties_any_gap():
    """Even a bridge without end has a suction of 2γ cos θ/D."""
    highest = 2.0 * 0.0728 * math.cos(math.radians(40.0)) / 4e-4
    asked = {"liquid": LIQUID, "branch": "unstable"}
    found = pl.bridge(PLATES, 4e-4, suction=highest * np.array([0.99, 1.01]), **asked)
    np.testing.assert_array_equal(found.exists, [True, False])
    np.testing.assert_array_equal(pl.bridge(pl.Pair(math.inf, 2.0), 4e-4, suction=0.0, **asked).exists, False)


# -- what is refused -------------------------------------------------------------------------------------------------


def test_no_bridge_under_suction_is_stable():
    held = {"suction": 0.0, "liquid": LIQUID}
    for ask in (lambda: pl.bridge(PLATES, 1e-4, **held), lambda: pl.rupture(PLATES, **held)):
        with refused(f"suction: {UNSTABLE_ONLY}"):
            ask()
    with refused(f"humidity: {UNSTABLE_ONLY}"):
        pl.curve(PLATES, humidity=0.5, liquid=WATER)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (
            lambda: pl.bridge(PLATES, 0.0, **DROP),
            "separation: 0.0 m is not > 0; two planes in contact leave no room for liquid",
        ),
        (
            lambda: pl.bridge(PLATES, [1e-4, -1e-6], **DROP),
            "separation[1]: -1e-06 m is not > 0; two planes in contact leave no room for liquid",
        ),
        (
            lambda: pl.bridge(PLATES, 0.9e-8, **DROP),
            "separation: 9e-09 m is not >= 1e-08, 1e-05 of the cube root of the volume, where the domain between two "
            "planes ends",
        ),
        *(
            (
                lambda method=method: pl.bridge(PLATES, 1e-4, method=method, **DROP),
                f"radius: inf and inf are two planes, which method {method!r} does not know; method 'exact' does",
            )
            for method in ("willett2000", "table", "dataset")
        ),
        (
            lambda: pl.rupture(PLATES, method="willett2000", **DROP),
            "radius: inf and inf are two planes, which method 'willett2000' does not know; method 'exact' does",
        ),
        (
            lambda: pl.compare(PLATES, **DROP),
            "radius: inf and inf are two planes, which no law knows; method 'exact' does",
        ),
        (
            lambda: pl.bridge(PLATES, half_filling_angle=0.2, **DROP),
            "half_filling_angle: the first solid is a plane, which has none",
        ),
    ],
)
def test_what_two_planes_do_not_have(ask, message):
    with refused(message):
        ask()


# -- made bridges ----------------------------------------------------------------------------------------------------


def is_same(answer, made):
    return (
        abs(answer.force - made.force) < 1e-6 * (2.0 * math.pi + abs(made.force))
        and abs(answer.volume - made.volume) < 1e-6 * made.volume
        and abs(answer.suction - made.suction) < 1e-6 * (1.0 + abs(made.suction))
    )


def ask_made(seed, count):
    """Faults of the answers to made bridges, and how many of which kind there were."""
    faults, counts = [], Counter()
    for made in made_between_planes(seed, count):
        pair = pl.Pair(math.inf, made.angles)
        assert made.down_at_suction > 0, "a stable bridge under suction"
        counts["under suction", made.down_at_suction] += 1
        counts["at a volume", made.down_at_volume] += 1
        at_volume = pl.bridge(pair, made.separation, volume=made.volume, liquid=UNIT)
        if made.down_at_volume == 0 and not (at_volume.exists and at_volume.stable and is_same(at_volume, made)):
            faults.append(("at a volume", made))
        if made.down_at_volume and at_volume.exists and is_same(at_volume, made):
            faults.append(("not stable", made))
        if made.down_at_suction == 1:
            nucleus = pl.bridge(pair, made.separation, suction=made.suction, liquid=UNIT, branch="unstable")
            if not (nucleus.exists and is_same(nucleus, made)):
                faults.append(("under suction", made))
    print(f"seed {seed}: {dict(counts)}")
    return faults, counts


def test_made_bridges_are_found():
    faults, counts = ask_made(61, 60)
    assert not faults, "\n".join(map(str, faults))
    assert counts["at a volume", 0] > 15
    assert counts["under suction", 1] > 30


@pytest.mark.long
def test_many_made_bridges_are_found():
    faults, counts = ask_made(62, 600)
    assert not faults, "\n".join(map(str, faults))
    assert counts["at a volume", 0] > 200
