"""A bridge by its half-filling angle: the one that was made is found, every one of several, and no other is guessed."""

import math
import re
from collections import Counter

import numpy as np
import pytest

import pendular as pl
from oracles.made_bridges import made_bridges

UNIT = pl.Liquid(surface_tension=1.0)
WATER = pl.Liquid.water()
GRAINS = pl.Pair(50e-6, 0.35)
DROP = {"volume": 1.25e-16, "liquid": WATER}
NUMBERS = (
    *("force", "volume", "suction", "contact_radius", "half_filling_angle", "neck_radius", "liquid_gas_area"),
    *("wetted_area", "surface_energy", "grand_potential", "capillary_tensor"),
)


def refused(message):
    """Expect a ValueError of exactly this one line."""
    return pytest.raises(ValueError, match=f"^{re.escape(message)}$")


def assert_same(answer, other, tolerance=1e-9):
    """Two answers are one bridge in every field that does not vanish or end at a fold."""
    for name in NUMBERS:
        np.testing.assert_allclose(getattr(answer, name), getattr(other, name), tolerance, 1e-9, err_msg=name)
    for name in ("exists", "stable", "unstable_directions", "sideways_stable", "neck_inside"):
        np.testing.assert_array_equal(getattr(answer, name), getattr(other, name), err_msg=name)


# -- what is asked -------------------------------------------------------------------------------------------------


def test_the_angle_is_that_of_the_first_solid():
    pair = pl.Pair((50e-6, 80e-6), (0.2, 0.5))
    bridge = pl.bridge(pair, half_filling_angle=0.3, suction=5e3, liquid=WATER)
    assert bridge.half_filling_angle[0] == 0.3
    assert bridge.contact_radius[0] == pytest.approx(50e-6 * math.sin(0.3), rel=1e-12)
    assert_same(bridge, pl.bridge(pair, bridge.separation, suction=5e3, liquid=WATER))
    named = pl.bridge(pair, half_filling_angle=(0.3, None), suction=5e3, liquid=WATER)
    assert named.separation == bridge.separation


def test_a_tuple_names_the_second_solid():
    pair = pl.Pair((math.inf, 80e-6), (0.2, 0.5))
    bridge = pl.bridge(pair, half_filling_angle=(None, 0.4), suction=5e3, liquid=WATER)
    np.testing.assert_array_equal(bridge.half_filling_angle, [0.0, 0.4])
    exchanged = pl.bridge(pl.Pair((80e-6, math.inf), (0.5, 0.2)), half_filling_angle=0.4, suction=5e3, liquid=WATER)
    assert exchanged.force == pytest.approx(bridge.force, rel=1e-12)


def test_it_broadcasts():
    angles, suctions = np.array([[0.35], [0.45]]), np.array([2e3, 5e3, 9e3])
    bridge = pl.bridge(GRAINS, half_filling_angle=angles, suction=suctions, liquid=WATER)
    assert bridge.force.shape == (2, 3)
    assert bridge.exists.any()
    np.testing.assert_array_equal(bridge.half_filling_angle[bridge.exists, 0], (angles + 0.0 * suctions)[bridge.exists])
    for i, j in np.ndindex(2, 3):
        alone = pl.bridge(GRAINS, half_filling_angle=angles[i, 0], suction=suctions[j], liquid=WATER)
        assert alone.separation == pytest.approx(bridge.separation[i, j], rel=1e-10, nan_ok=True)


def test_humidity_serves_as_well():
    bridge = pl.bridge(pl.Pair(10e-6), half_filling_angle=0.03, humidity=0.9, liquid=WATER)
    assert_same(bridge, pl.bridge(pl.Pair(10e-6), bridge.separation, humidity=0.9, liquid=WATER))


def test_an_angle_that_no_bridge_has():
    bridge = pl.bridge(GRAINS, half_filling_angle=[0.4, 3.0], suction=5e3, liquid=WATER)
    np.testing.assert_array_equal(bridge.exists, [True, False])
    assert bridge.force[1] == 0.0
    assert math.isnan(bridge.separation[1])
    assert np.isnan(bridge.half_filling_angle[1]).all()


def test_an_overlap_is_answered():
    bridge = pl.bridge(GRAINS, half_filling_angle=0.35, volume=1.25e-16, liquid=WATER)
    assert bridge.separation < 0.0
    assert_same(bridge, pl.bridge(GRAINS, bridge.separation, **DROP))


# -- several bridges -------------------------------------------------------------------------------------------------


def test_of_two_bridges_none_is_guessed():
    told = "half_filling_angle: 0.09 rad, 5.15662°, is that of 2 stable bridges, at separations of "
    with pytest.raises(
        ValueError, match=rf"^{re.escape(told)}(\S+) and (\S+) m; give a separation near to the one"
    ) as error:
        pl.bridge(GRAINS, half_filling_angle=0.09, **DROP)
    for gap in map(float, re.findall(r"\d\.\d+e-\d+", str(error.value))):
        near = pl.bridge(GRAINS, 1.1 * gap, half_filling_angle=0.09, **DROP)
        assert near.separation == pytest.approx(gap, rel=1e-5)
        assert_same(near, pl.bridge(GRAINS, near.separation, **DROP))


def test_the_place_of_the_doubtful_one_is_told():
    with pytest.raises(ValueError, match=r"^half_filling_angle\[1, 0\]: 0\.09 rad, "):
        pl.bridge(GRAINS, half_filling_angle=[[0.3], [0.09]], **DROP)


@pytest.mark.parametrize("seed", [3, pytest.param(4, marks=pytest.mark.long)])
def test_as_many_bridges_as_the_curve_has(seed):
    """Crossings of the angle along a drawn stable branch, at random angles of it, each asked by its separation."""
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    several = 0
    for _ in range(8 if seed == 3 else 150):
        pair = pl.Pair((1.0, random.choice([1.0, 3.0, math.inf])), tuple(random.uniform(0.0, 1.5, 2)))
        held = {"volume": 10.0 ** random.uniform(-6.0, 0.0), "liquid": UNIT}
        curve = pl.curve(pair, points=201, **held)
        if not np.any(curve.exists):
            continue
        gaps, angles = curve.separation[:101], curve.half_filling_angle[:101, 0]
        angle = random.uniform(angles.min(), angles.max())
        passed = np.flatnonzero((angles[1:] - angle) * (angles[:-1] - angle) < 0.0)
        several += passed.size > 1
        for i in passed:
            share = (angle - angles[i]) / (angles[i + 1] - angles[i])
            gap = gaps[i] + share * (gaps[i + 1] - gaps[i])
            found = pl.bridge(pair, gap, half_filling_angle=angle, **held)
            slack = 1e-9 * gaps[100]
            assert min(gaps[i : i + 2]) - slack <= found.separation <= max(gaps[i : i + 2]) + slack
    assert several > 1


# -- the unstable branch -------------------------------------------------------------------------------------------


def test_an_unstable_bridge_is_found():
    bridge = pl.bridge(GRAINS, half_filling_angle=0.1, branch="unstable", **DROP)
    assert bridge.unstable_directions == 1
    assert not bridge.stable
    assert_same(bridge, pl.bridge(GRAINS, bridge.separation, branch="unstable", **DROP))


def test_beyond_a_pitchfork_either_solid_may_be_the_wetter():
    pair, held = pl.Pair(1.0, 1.21), {"volume": 3e-4, "liquid": UNIT, "branch": "unstable"}
    lean, rich = (pl.bridge(pair, half_filling_angle=angle, **held) for angle in (0.035, 0.05))
    for bridge in (lean, rich):
        assert bridge.half_filling_angle[0] != pytest.approx(bridge.half_filling_angle[1], rel=1e-2)
        other = pl.bridge(pair, bridge.separation, **held)
        assert other.force == pytest.approx(bridge.force, rel=1e-9)
        assert sorted(other.half_filling_angle) == pytest.approx(sorted(bridge.half_filling_angle), rel=1e-9)


# -- bad input -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"half_filling_angle": 0.0}, "half_filling_angle: 0.0 rad is not in (0, pi)"),
        ({"half_filling_angle": [0.1, -0.1]}, "half_filling_angle[1]: -0.1 rad is not in (0, pi)"),
        (
            {"half_filling_angle": 30.0},
            "half_filling_angle: 30.0 rad is not in (0, pi); for degrees use numpy.deg2rad(30.0)",
        ),
        ({"half_filling_angle": math.nan}, "half_filling_angle: nan rad is not a number"),
        (
            {"half_filling_angle": (0.1, 0.2)},
            "half_filling_angle: (0.1, 0.2) does not give one angle; write (angle, None) or (None, angle)",
        ),
        (
            {"half_filling_angle": (None, None)},
            "half_filling_angle: (None, None) does not give one angle; write (angle, None) or (None, angle)",
        ),
        (
            {"half_filling_angle": 0.1, "method": "willett2000"},
            "half_filling_angle: method 'willett2000' does not know it; 'exact' does",
        ),
        ({}, "separation: None given; a separation or a half_filling_angle is needed"),
        (
            {"half_filling_angle": [0.1, 0.2], "volume": [1e-16] * 3},
            "shapes do not broadcast: half_filling_angle (2,), volume (3,), radius[0] (), radius[1] (), "
            "contact_angle[0] (), contact_angle[1] ()",
        ),
    ],
)
def test_bad_angles_are_refused(asked, message):
    with refused(message):
        pl.bridge(GRAINS, **(DROP | asked))


def test_a_plane_has_none():
    pair = pl.Pair((math.inf, 50e-6), 0.3)
    with refused("half_filling_angle: the first solid is a plane, which has none; (None, angle) names the other"):
        pl.bridge(pair, half_filling_angle=0.1, **DROP)
    with refused("half_filling_angle: the second solid is a plane, which has none; (angle, None) names the other"):
        pl.bridge(pl.Pair((50e-6, math.inf)), half_filling_angle=(None, 0.1), **DROP)


# -- made bridges ----------------------------------------------------------------------------------------------------


def ask_made(seed, count, angles):
    """Faults of the answers to made bridges by the angle on solid 1, and how many of which kind there were."""
    faults, counts = [], Counter()
    for made in made_bridges(seed, count, 0.0, angles):
        pair = pl.Pair((1.0, made.second_radius), made.angles)
        for control in ("suction", "volume"):
            if made.down(control) > 0:
                continue
            held = {control: getattr(made, control), "liquid": UNIT}
            counts[control] += 1
            try:
                answer = pl.bridge(pair, half_filling_angle=made.filling, **held)
            except ValueError:  # several have it
                counts[f"several at one {control}"] += 1
                answer = pl.bridge(pair, made.separation, half_filling_angle=made.filling, **held)
            is_made = (
                answer.exists
                and abs(answer.separation - made.separation) < 1e-7 * (1.0 + made.separation)
                and abs(answer.force - made.force) < 1e-6 * (1.0 + abs(made.force))
                and abs(answer.contact_radius[0] / math.sin(made.filling) - 1.0) < 1e-12
            )
            if not is_made:
                faults.append((control, made))
                continue
            # by the separation it is the same in all fields; next to a fold the last digits of D move it
            again = pl.bridge(pair, answer.separation, **held)
            if again.exists:
                assert_same(answer, again, 1e-5)
    print(f"seed {seed}: {dict(counts)}")
    return faults, counts


@pytest.mark.parametrize(("seed", "angles"), [(71, math.pi / 2.0), (72, math.pi)])
def test_made_bridges_are_found(seed, angles):
    faults, counts = ask_made(seed, 25, angles)
    assert not faults, "\n".join(map(str, faults))
    assert counts["volume"] > 5
    assert counts["suction"] > 2


@pytest.mark.long
@pytest.mark.parametrize(("seed", "angles"), [(73, math.pi / 2.0), (74, math.pi)])
def test_many_made_bridges_are_found(seed, angles):
    faults, counts = ask_made(seed, 400, angles)
    assert not faults, "\n".join(map(str, faults))
    assert counts["volume"] > 120
    assert counts["suction"] > 40
    assert counts["several at one volume"] > 40
