"""Fields that are asked for alone, and arrays against single questions."""

import math

import numpy as np
import pytest

import pendular as pl
from pendular.ask.result import FIELDS

UNIT = pl.Liquid(surface_tension=1.0)
SEED = 20261129
NAMES = [name for name, _, _ in FIELDS]
ALWAYS = {"exists", "stable", "unstable_directions", "sideways_stable"}


def questions(count, control):
    """Random pairs of all kinds, some beyond rupture, some far from the straight way."""
    rng = np.random.default_rng(SEED)
    radius = np.where(rng.random(count) < 0.2, math.inf, 10.0 ** rng.uniform(0.0, 2.0, count))
    radius[rng.random(count) < 0.2] = 1.0
    angles = tuple(np.deg2rad(rng.uniform(0.0, 100.0, (2, count))))
    scale = 2.0 / (1.0 + 1.0 / radius)
    if control == "volume":
        held = scale**3 * 10.0 ** rng.uniform(-9.0, 1.0, count)
        gap = np.cbrt(held) * rng.uniform(0.0, 1.3, count)
    else:
        held = 10.0 ** rng.uniform(-2.0, 5.0, count) / scale
        gap = rng.uniform(0.0, 1.0, count) / (held + 2.0)
    return pl.Pair((1.0, radius), angles), gap, {control: held}


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_arrays_say_what_single_questions_say(control):
    print("seed", SEED)
    pair, gap, held = questions(300, control)
    many = pl.bridge(pair, gap, **held, liquid=UNIT)
    assert 0.2 < many.exists.mean() < 1.0
    for i in range(gap.size):
        one = pl.bridge(
            pl.Pair((1.0, float(pair.radius[1][i])), tuple(float(angle[i]) for angle in pair.contact_angle)),
            float(gap[i]),
            **{control: float(held[control][i])},
            liquid=UNIT,
        )
        for name in NAMES:
            single, among = np.asarray(getattr(one, name), float), np.asarray(getattr(many, name)[i], float)
            np.testing.assert_allclose(among, single, rtol=1e-8, atol=1e-14 * abs(one.force), err_msg=f"{name} {i}")


@pytest.mark.parametrize("control", ["suction", "volume"])
@pytest.mark.parametrize("fields", [("force",), ("stiffness", "wetted_area"), "neck_radius", ("volume",), ()])
def test_fields_alone_are_those_of_all(control, fields):
    print("seed", SEED)
    pair, gap, held = questions(500, control)
    whole = pl.bridge(pair, gap, **held, liquid=UNIT)
    part = pl.bridge(pair, gap, **held, liquid=UNIT, fields=fields)
    asked = {fields} if isinstance(fields, str) else set(fields)
    for name in NAMES:
        found, known = getattr(part, name), getattr(whole, name)
        assert found.shape == known.shape
        if name in asked | ALWAYS:
            np.testing.assert_allclose(np.asarray(found, float), np.asarray(known, float), rtol=1e-11, err_msg=name)
        elif name == "neck_inside":
            assert not found.any()
        else:
            assert np.isnan(found).all(), name


def test_fields_of_a_single_bridge_and_of_a_law():
    grains = pl.Pair(1.0, 0.3)
    for method in ("exact", "willett2000"):
        one = pl.bridge(grains, 0.01, volume=1e-3, liquid=UNIT, method=method, fields=("force",))
        assert one.force == pl.bridge(grains, 0.01, volume=1e-3, liquid=UNIT, method=method).force
        assert math.isnan(one.stiffness)
        assert math.isnan(one.volume)
        assert one.exists


def test_unknown_fields_are_refused():
    with pytest.raises(ValueError, match=r"^fields\[1\]: 'neck' is not one of 'separation', .*'capillary_tensor'$"):
        pl.bridge(pl.Pair(1.0), [0.0, 0.1], suction=1.0, liquid=UNIT, fields=("force", "neck"))


def test_arguments_of_any_shapes_broadcast():
    gap, held, angle = np.array([0.0, 0.01])[:, None, None], np.array([1.0, 10.0, 1e3]), np.array([[[0.1]], [[0.4]]])
    many = pl.bridge(pl.Pair(1.0, (angle[0], angle[1])), gap, suction=held, liquid=UNIT)
    assert many.force.shape == (2, 1, 3)
    assert many.contact_radius.shape == (2, 1, 3, 2)
    one = pl.bridge(pl.Pair(1.0, (0.1, 0.4)), 0.01, suction=10.0, liquid=UNIT)
    assert many.force[1, 0, 1] == pytest.approx(one.force, rel=1e-12)
    np.testing.assert_allclose(many.wetted_area[1, 0, 1], one.wetted_area, rtol=1e-12)
    assert many.profile(11).x.shape == (2, 1, 3, 11)


@pytest.mark.parametrize(
    ("gap", "told"),
    [
        ([0.1, -0.6], r"^separation\[1\]: -0.6 m is not > -0.5; an overlap may reach half the smaller radius$"),
        ([[0.1], [math.nan]], r"^separation\[1, 0\]: nan m is not a number$"),
    ],
)
def test_bad_elements_are_named(gap, told):
    with pytest.raises(ValueError, match=told):
        pl.bridge(pl.Pair(1.0), gap, suction=1.0, liquid=UNIT)


def test_volumes_beyond_the_domain_are_named():
    with pytest.raises(ValueError, match=r"^volume: 100000 m\^3 is not in \[1e-30, 10000\] m\^3"):
        pl.bridge(pl.Pair(1.0), 0.1, volume=[1.0, 1e5], liquid=UNIT)


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_a_start_near_by_changes_no_answer(control):
    """Not even where bridges broke in between, stood nowhere before, or are far away."""
    print("seed", SEED)
    pair, gap, held = questions(400, control)
    before = pl.bridge(pair, gap, **held, liquid=UNIT)
    moved = gap * np.random.default_rng(SEED).choice([0.5, 0.99, 1.001, 1.02, 1.5], gap.size)
    for fields in (None, ("force",)):
        plainly = pl.bridge(pair, moved, **held, liquid=UNIT, fields=fields)
        found = pl.bridge(pair, moved, **held, liquid=UNIT, fields=fields, near=before)
        np.testing.assert_array_equal(found.exists, plainly.exists)
        np.testing.assert_allclose(found.force, plainly.force, rtol=1e-10)
    again = pl.bridge(pair, gap, **held, liquid=UNIT, fields=("force",), near=found)
    np.testing.assert_allclose(again.force, before.force, rtol=1e-10)


def test_bridges_near_by_have_to_fit():
    pair, alone = pl.Pair(1.0), {"suction": 1.0, "liquid": UNIT}
    before = pl.bridge(pair, [0.0, 0.1], **alone)
    with pytest.raises(ValueError, match=r"^near: bridges of shape \(2,\) are not of that of the question, \(3,\)$"):
        pl.bridge(pair, [0.0, 0.1, 0.2], **alone, near=before)
    with pytest.raises(ValueError, match=r"^near: 3 is not a pendular.Bridge$"):
        pl.bridge(pair, [0.0, 0.1], **alone, near=3)
    with pytest.raises(ValueError, match=r"^near: these bridges do not know their meridians"):
        pl.bridge(pair, [0.0, 0.1], **alone, near=pl.bridge(pair, [0.0, 0.1], **alone, fields=("force",)))


def test_fields_alone_in_humid_air():
    water, pair = pl.Liquid.water(), pl.Pair(1e-4, 0.3)
    gap = np.array([0.0, 1e-9])
    whole = pl.bridge(pair, gap, humidity=0.9, liquid=water)
    part = pl.bridge(pair, gap, humidity=0.9, liquid=water, fields=("volume",))
    np.testing.assert_array_equal(part.volume, whole.volume)
    assert np.isnan(part.force).all()
    again = pl.bridge(pair, gap, humidity=0.9, liquid=water, fields=("force",), near=whole)
    np.testing.assert_allclose(again.force, whole.force, rtol=1e-10)
