"""The public face: shapes and types, units, both branches, rupture, profiles, threads, and what is refused."""

import dataclasses
import math
import re
import warnings

import numpy as np
import pint
import pytest

import pendular as pl

UNITS = pint.UnitRegistry()
LIQUID = pl.Liquid(surface_tension=0.0728)
WATER = pl.Liquid.water()
GRAINS = pl.Pair(radius=50e-6, contact_angle=math.radians(20.0))
PLATE = pl.Pair(radius=(50e-6, math.inf), contact_angle=(0.35, 0.9))
UNEQUAL = pl.Pair(radius=(50e-6, 400e-6), contact_angle=(0.2, 0.7))
PER_SOLID = ("contact_radius", "half_filling_angle", "wetted_area")
TRUTHS = ("exists", "stable", "sideways_stable", "neck_inside")
FIELDS = [field.name for field in dataclasses.fields(pl.Bridge) if not field.name.startswith("_")]

CONTROLS = pytest.mark.parametrize("control", [{"suction": 20e3}, {"suction": -500.0}, {"volume": 1e-15}])
PAIRS = pytest.mark.parametrize("pair", [GRAINS, PLATE, UNEQUAL])


def refused(message: str):
    """Expect a ValueError of exactly this one line."""
    return pytest.raises(ValueError, match=f"^{re.escape(message)}$")


def fields_of(bridge):
    """Every field under its name, as an array."""
    return {name: np.asarray(getattr(bridge, name)) for name in FIELDS}


def assert_same(bridge, other):
    """Both agree in every field, to the last bit."""
    for name, field in fields_of(bridge).items():
        np.testing.assert_array_equal(getattr(other, name), field, err_msg=name)


# -- shapes and types ------------------------------------------------------------------------------------------------


@CONTROLS
def test_numbers_in_python_scalars_out(control):
    bridge = pl.bridge(GRAINS, 1e-6, **control, liquid=LIQUID)
    for name in FIELDS:
        value = getattr(bridge, name)
        if name in (*PER_SOLID, "capillary_tensor"):
            assert value.shape == (2,), name
        else:
            kind = {"unstable_directions": int}.get(name, bool if name in TRUTHS else float)
            assert type(value) is kind, name


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_every_argument_broadcasts(control):
    radius = np.array([50e-6, 80e-6])[:, None, None, None]
    angle = np.array([0.1, 0.4, 0.7])[:, None, None]
    value = np.array({"suction": [2e3, 2e4], "volume": [1e-15, 2e-16]}[control])[:, None]
    gap = np.array([0.0, 5e-7, 1e-6])
    together = pl.bridge(pl.Pair((50e-6, radius), (angle, 0.2)), gap, **{control: value}, liquid=LIQUID)
    assert together.force.shape == (2, 3, 2, 3)
    assert together.capillary_tensor.shape == together.wetted_area.shape == (2, 3, 2, 3, 2)
    for i, j, k, n in np.ndindex(2, 3, 2, 3):
        pair = pl.Pair((50e-6, radius[i].item()), (angle[j].item(), 0.2))
        alone = pl.bridge(pair, gap[n], **{control: value[k].item()}, liquid=LIQUID)
        for name, field in fields_of(together).items():
            np.testing.assert_allclose(field[i, j, k, n], getattr(alone, name), rtol=1e-13, err_msg=name)


def test_suction_and_pressure_mix_in_one_array():
    bridge = pl.bridge(GRAINS, 1e-6, suction=[1e4, -500.0, 0.0], liquid=LIQUID)
    assert bridge.exists.all()
    np.testing.assert_allclose(bridge.suction, [1e4, -500.0, 0.0], rtol=1e-15)
    assert np.all(np.diff(bridge.force) != 0.0)


def test_sequences_stand_for_arrays_and_tuples_for_the_two_solids():
    pair = pl.Pair([50e-6, 80e-6], (0.1, [0.2, 0.3]))
    np.testing.assert_array_equal(pair.radii, [[50e-6, 80e-6]] * 2)
    np.testing.assert_array_equal(pair.contact_angles[1], [0.2, 0.3])
    assert pl.bridge(pair, 1e-6, suction=1e4, liquid=LIQUID).force.shape == (2,)


def test_derjaguin_radius_is_the_harmonic_mean():
    assert GRAINS.derjaguin_radius == 50e-6
    assert PLATE.derjaguin_radius == 100e-6
    np.testing.assert_allclose(pl.Pair((1.0, [2.0, math.inf]), 0.0).derjaguin_radius, [4.0 / 3.0, 2.0], rtol=1e-15)


def test_quantities_with_units_are_understood():
    plain = pl.bridge(UNEQUAL, 1e-6, suction=20e3, liquid=LIQUID)
    pair = pl.Pair((50.0 * UNITS.um, 0.4 * UNITS.mm), (0.2, UNITS.Quantity(np.rad2deg(0.7), "degree")))
    liquid = pl.Liquid(surface_tension=72.8 * UNITS.mN / UNITS.m)
    with_units = pl.bridge(pair, 1000.0 * UNITS.nm, suction=20.0 * UNITS.kPa, liquid=liquid)
    for name, field in fields_of(plain).items():
        np.testing.assert_allclose(getattr(with_units, name), field, rtol=1e-13, err_msg=name)
    by_volume = pl.bridge(GRAINS, 1e-6, volume=1.0 * UNITS.pL, liquid=LIQUID)
    assert by_volume.force == pytest.approx(pl.bridge(GRAINS, 1e-6, volume=1e-15, liquid=LIQUID).force, rel=1e-13)


# -- humidity --------------------------------------------------------------------------------------------------------


def test_humidity_is_a_suction_by_the_kelvin_equation():
    suction = pl.suction_from_humidity(0.9, WATER)
    for ask in (
        lambda **control: pl.bridge(GRAINS, 1e-9, **control, liquid=WATER),
        lambda **control: pl.rupture(GRAINS, **control, liquid=WATER),
        lambda **control: pl.curve(GRAINS, **control, liquid=WATER),
    ):
        assert_same(ask(humidity=0.9), ask(suction=suction))


def test_a_percentage_is_a_humidity():
    ninety = UNITS.Quantity(90.0, "percent")
    assert pl.bridge(GRAINS, 1e-9, humidity=ninety, liquid=WATER).exists


def test_a_doubtful_humidity_warns_at_the_line_that_asks():
    with pytest.warns(pl.KelvinWarning, match="Kelvin equation is doubtful below 4 nm") as caught:
        pl.bridge(GRAINS, 1e-10, humidity=0.5, liquid=WATER)
    assert caught[0].filename == __file__
    with pytest.warns(pl.KelvinWarning, match="an uncertainty of 0.1 % RH changes the force by up to"):
        pl.bridge(GRAINS, 1e-7, humidity=0.999, liquid=WATER)


# -- rupture and the two branches ------------------------------------------------------------------------------------


@CONTROLS
@PAIRS
def test_beyond_rupture_there_is_no_bridge_and_no_error(pair, control):
    rupture = pl.rupture(pair, **control, liquid=LIQUID).separation
    for branch in ("stable", "unstable"):
        beyond = pl.bridge(pair, [1.000001 * rupture, 10.0 * rupture], **control, liquid=LIQUID, branch=branch)
        for name, field in fields_of(beyond).items():
            if name == "force":
                np.testing.assert_array_equal(field, 0.0)
            elif field.dtype in (bool, int):
                assert not field.any(), name
            else:
                assert np.isnan(field).all(), name


def test_one_array_may_hold_bridges_and_none():
    bridge = pl.bridge(GRAINS, [1e-6, 1e-3, 2e-6], suction=20e3, liquid=LIQUID)
    np.testing.assert_array_equal(bridge.exists, [True, False, True])
    np.testing.assert_array_equal(bridge.force > 0.0, bridge.exists)
    np.testing.assert_array_equal(np.isnan(bridge.profile().x).all(axis=-1), ~bridge.exists)


@CONTROLS
@PAIRS
def test_both_branches_meet_at_rupture(pair, control):
    """The difference of their forces is of the order of the root of the distance to rupture."""
    rupture = pl.rupture(pair, **control, liquid=LIQUID)
    for distance in (1e-4, 1e-8):
        gap = (1.0 - distance) * rupture.separation
        stable, unstable = (pl.bridge(pair, gap, **control, liquid=LIQUID, branch=b) for b in ("stable", "unstable"))
        assert stable.exists
        assert unstable.exists
        assert not unstable.stable
        assert unstable.force < rupture.force < stable.force
        assert stable.force - unstable.force < 5.0 * math.sqrt(distance) * rupture.force
        potential = "surface_energy" if "volume" in control else "grand_potential"
        assert getattr(stable, potential) < getattr(unstable, potential)


@pytest.mark.parametrize("degrees", [35.0, 50.0, 80.0])
@pytest.mark.parametrize("volume", [1e-6, 0.05])
def test_stability_is_lost_before_the_fold_between_equal_solids(degrees, volume):
    pair = pl.Pair(1.0, math.radians(degrees))
    first = pl.rupture(pair, volume=volume, liquid=LIQUID).separation
    assert 0.5 < first / pl.rupture(pair, volume=volume, liquid=LIQUID, limit="fold").separation < 1.0
    gaps = [0.999 * first, 1.001 * first]
    around = pl.bridge(pair, gaps, volume=volume, liquid=LIQUID)
    np.testing.assert_array_equal(around.exists, [True, False])
    symmetric = pl.bridge(pair, gaps, volume=volume, liquid=LIQUID, limit="fold")
    np.testing.assert_array_equal(symmetric.exists, True)
    np.testing.assert_array_equal(symmetric.stable, [True, False])
    np.testing.assert_array_equal(symmetric.unstable_directions, [0, 1])


@pytest.mark.parametrize(
    ("pair", "control"),
    [
        (GRAINS, {"volume": 1e-15}),
        (UNEQUAL, {"volume": 1e-15}),
        (pl.Pair(50e-6, 1.2), {"suction": 1e4}),
        (pl.Pair(50e-6, 0.7), {"suction": -1e3}),
    ],
)
def test_elsewhere_stability_is_lost_at_the_fold(pair, control):
    first, fold = (pl.rupture(pair, **control, liquid=LIQUID, limit=limit) for limit in ("stability", "fold"))
    assert_same(first, fold)


def test_an_unstable_bridge_of_a_given_volume_may_end_before_contact():
    """Its contact circle on the first sphere shrinks to nothing at a quarter of the rupture distance."""
    pair, volume = pl.Pair((1.0, 6.1), 0.39), 2e-3
    gaps = np.linspace(0.05, 0.95, 37) * pl.rupture(pair, volume=volume, liquid=LIQUID).separation
    bridge = pl.bridge(pair, gaps, volume=volume, liquid=LIQUID, branch="unstable")
    assert not bridge.exists[:8].any()
    assert bridge.exists[10:].all()
    np.testing.assert_allclose(bridge.volume[bridge.exists], volume, rtol=1e-12)
    assert np.all(np.diff(bridge.force[10:]) > 0.0)


def test_under_pressure_the_liquid_floods_a_plane_that_it_wets():
    pair = pl.Pair((1.0, math.inf), (0.03, 0.02))
    for ruptured in (
        pl.rupture(pair, suction=-1e-3, liquid=LIQUID),
        pl.bridge(pair, 0.0, suction=-1e-3, liquid=LIQUID),
    ):
        assert not ruptured.exists
        assert ruptured.force == 0.0


@CONTROLS
@PAIRS
def test_a_curve_leads_from_contact_over_rupture_down_the_unstable_branch(pair, control):
    curve = pl.curve(pair, **control, liquid=LIQUID, points=31)
    rupture = pl.rupture(pair, **control, liquid=LIQUID)
    assert curve.force.shape == (31,)
    assert curve.contact_radius.shape == (31, 2)
    assert curve.separation[0] == pytest.approx(0.0, abs=1e-15 * 50e-6)
    assert curve.separation[15] == pytest.approx(rupture.separation, rel=1e-12)
    assert np.all(np.diff(curve.separation[:16]) > 0.0)
    assert np.all(np.diff(curve.separation[15:]) < 0.0)
    assert curve.stable[:15].all()
    assert not curve.stable[16:].any()
    for branch, part in (("stable", slice(1, 15)), ("unstable", slice(16, 20))):
        alone = pl.bridge(pair, curve.separation[part], **control, liquid=LIQUID, branch=branch)
        np.testing.assert_allclose(curve.force[part], alone.force, rtol=1e-9)


@pytest.mark.parametrize("points", [5, 6, 200])
def test_the_fold_of_a_curve_is_in_its_middle(points):
    curve = pl.curve(pl.Pair([50e-6, 80e-6], 0.2), volume=1e-15, liquid=LIQUID, points=points)
    assert curve.separation.shape == (2, points)
    np.testing.assert_array_equal(np.argmax(curve.separation, axis=-1), points // 2)


# -- geometry --------------------------------------------------------------------------------------------------------


def end_slopes(shape):
    """Slope angles of a meridian at its two ends, outwards, from a parabola through the last three points."""
    for outwards, last in ((-1.0, slice(0, 3)), (1.0, slice(-3, None))):
        parabola = np.polynomial.Polynomial.fit(shape.x[last], shape.y[last], 2)
        yield math.atan(outwards * parabola.deriv()(shape.x[0 if outwards < 0.0 else -1]))


@CONTROLS
@PAIRS
def test_a_profile_meets_the_solids_at_their_contact_angles(pair, control):
    """ψ = π/2 - δ - θ outwards, within the error of a parabola."""
    bridge = pl.bridge(pair, 2e-6, **control, liquid=LIQUID)
    shape = bridge.profile(2001)
    sagitta = bridge.contact_radius * np.tan(0.5 * bridge.half_filling_angle)
    np.testing.assert_allclose(shape.y[[0, -1]], bridge.contact_radius, rtol=1e-12)
    np.testing.assert_allclose(shape.x[[0, -1]], [-sagitta[0], 2e-6 + sagitta[1]], atol=1e-12 * 50e-6)
    outwards = 0.5 * math.pi - bridge.half_filling_angle - np.ravel(pair.contact_angles)
    np.testing.assert_allclose(list(end_slopes(shape)), outwards, atol=1e-5)


@CONTROLS
@PAIRS
def test_the_neck_is_the_thinnest_place_of_the_profile(pair, control):
    gaps = np.array([0.1, 0.9]) * pl.rupture(pair, **control, liquid=LIQUID).separation
    bridge = pl.bridge(pair, gaps, **control, liquid=LIQUID)
    thinnest = bridge.profile(4001).y.min(axis=-1)
    outside = ~bridge.neck_inside
    np.testing.assert_allclose(thinnest[~outside], bridge.neck_radius[~outside], rtol=1e-6)
    np.testing.assert_allclose(thinnest[outside], bridge.contact_radius.min(axis=-1)[outside], rtol=1e-12)
    assert np.all(bridge.neck_radius[outside] < thinnest[outside])


def test_a_profile_encloses_volume_and_area():
    bridge = pl.bridge(UNEQUAL, [0.0, 2e-6], suction=20e3, liquid=LIQUID)
    shape = bridge.profile(20001)
    radius = 0.5 * (shape.y[:, 1:] + shape.y[:, :-1])
    area = 2.0 * math.pi * np.sum(radius * np.hypot(np.diff(shape.x), np.diff(shape.y)), axis=-1)
    sagitta = bridge.contact_radius * np.tan(0.5 * bridge.half_filling_angle)
    caps = math.pi / 6.0 * sagitta * (3.0 * bridge.contact_radius**2 + sagitta**2)
    volume = math.pi * np.sum(radius**2 * np.diff(shape.x), axis=-1) - np.sum(caps, axis=-1)
    np.testing.assert_allclose(area, bridge.liquid_gas_area, rtol=1e-6)
    np.testing.assert_allclose(volume, bridge.volume, rtol=1e-6)


def test_outlines_are_those_of_the_solids():
    shape = pl.bridge(PLATE, [1e-6, 2e-6], suction=20e3, liquid=LIQUID).profile(101)
    assert shape.solid_x.shape == shape.solid_y.shape == (2, 2, 101)
    sphere, plate = shape.solid_x[1], shape.solid_y[1]
    np.testing.assert_allclose(np.hypot(shape.solid_x[1, 0] + 50e-6, shape.solid_y[1, 0]), 50e-6, rtol=1e-14)
    np.testing.assert_allclose(shape.solid_x[1, 1], 2e-6, rtol=1e-14)
    assert sphere[0].max() == 0.0
    assert plate[1].max() > shape.y[1].max()


@CONTROLS
def test_a_plane_has_a_contact_circle_and_no_filling_angle(control):
    bridge = pl.bridge(PLATE, 1e-6, **control, liquid=LIQUID)
    assert bridge.half_filling_angle[0] > 0.0
    assert bridge.half_filling_angle[1] == 0.0
    assert bridge.wetted_area[1] == pytest.approx(math.pi * bridge.contact_radius[1] ** 2, rel=1e-15)


@CONTROLS
def test_a_plane_is_the_limit_of_large_spheres(control):
    plane, sphere = (
        pl.bridge(pl.Pair((50e-6, radius), (0.35, 0.9)), 1e-6, **control, liquid=LIQUID) for radius in (math.inf, 50.0)
    )
    for name, field in fields_of(plane).items():
        np.testing.assert_allclose(
            1.0 * getattr(sphere, name), field, rtol=5e-5, atol=5e-5 * (name == "half_filling_angle")
        )


def test_a_sphere_may_be_more_than_half_immersed():
    pair = pl.Pair((1.0, 800.0), 0.0)
    gaps = np.array([0.0, 1e-6, 0.1, 0.4, 0.8]) * pl.rupture(pair, suction=0.0, liquid=LIQUID).separation
    bridge = pl.bridge(pair, gaps, suction=0.0, liquid=LIQUID)
    assert np.all(np.abs(bridge.half_filling_angle[:, 0] - 0.64 * math.pi) < 0.14 * math.pi)
    assert np.all(np.diff(bridge.half_filling_angle[:, 0]) < 0.0)
    assert not bridge.neck_inside.any()


@CONTROLS
@PAIRS
def test_the_second_solid_may_come_first(pair, control):
    swapped = pl.Pair(pair.radii[::-1], pair.contact_angles[::-1])
    bridge, mirrored = (pl.bridge(p, 1e-6, **control, liquid=LIQUID) for p in (pair, swapped))
    for name, field in fields_of(bridge).items():
        other = getattr(mirrored, name)
        np.testing.assert_allclose(1.0 * (other[::-1] if name in PER_SOLID else other), field, rtol=1e-12, err_msg=name)
    here, there = bridge.profile(), mirrored.profile()
    np.testing.assert_allclose(there.y[::-1], here.y, rtol=1e-12)
    np.testing.assert_allclose(1e-6 - there.x[::-1], here.x, atol=1e-12 * 50e-6)


@pytest.mark.parametrize("control", [{"suction": 20e3}, {"volume": 1e-15}])
@pytest.mark.parametrize("separation", [-1e-6, -1e-8])
def test_solids_may_overlap(control, separation):
    """The stable branch goes on smoothly through contact."""
    gaps = separation * np.array([1.1, 1.0, 0.9])
    bridge = pl.bridge(UNEQUAL, gaps, **control, liquid=LIQUID)
    potential = bridge.surface_energy if "volume" in control else bridge.grand_potential
    assert bridge.exists.all()
    assert np.all(bridge.force > pl.bridge(UNEQUAL, 0.0, **control, liquid=LIQUID).force)
    assert (potential[2] - potential[0]) / (gaps[2] - gaps[0]) == pytest.approx(bridge.force[1], rel=1e-3)


@pytest.mark.parametrize("control", [{"suction": 20e3}, {"suction": -500.0}, {"volume": 1e-15}])
@pytest.mark.parametrize("separation", [1e-12, 1e-18, 1e-22, 1e-40])
def test_a_gap_of_less_than_an_atom_is_contact(control, separation):
    contact = pl.bridge(GRAINS, 0.0, **control, liquid=LIQUID)
    assert pl.bridge(GRAINS, separation, **control, liquid=LIQUID).force == pytest.approx(contact.force, rel=1e-5)


# -- threads ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("control", "count"), [("suction", 10000), ("volume", 100)])
@pytest.mark.parametrize("branch", ["stable", "unstable"])
def test_results_do_not_depend_on_the_threads(monkeypatch, control, count, branch):
    rng = np.random.default_rng(20)
    pair = pl.Pair((50e-6, rng.choice([50e-6, 200e-6, math.inf], count)), (0.3, rng.uniform(0.0, 1.2, count)))
    held = {"suction": 10.0 ** rng.uniform(2, 7, count), "volume": 10.0 ** rng.uniform(-18, -14, count)}[control]
    rupture = pl.rupture(pair, **{control: held}, liquid=LIQUID).separation
    answers = []
    for number in (1, 3):
        monkeypatch.setattr("pendular.ground.rows.thread_count", lambda number=number: number)
        answers.append(pl.bridge(pair, 0.97 * rupture, **{control: held}, liquid=LIQUID, branch=branch))
    assert answers[0].exists.all()
    assert_same(*answers)


# -- bad input -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("radius", "angle", "message"),
    [
        (0.0, 0.1, "radius: 0.0 m is not > 0"),
        (-50e-6, 0.1, "radius: -5e-05 m is not > 0"),
        ((50e-6, -1.0), 0.1, "radius[1]: -1.0 m is not > 0"),
        ([50e-6, 0.0], 0.1, "radius[1]: 0.0 m is not > 0"),
        (math.nan, 0.1, "radius: nan m is not a number"),
        ([], 0.1, "radius: an array of shape (0,) holds no number"),
        ("50um", 0.1, "radius: '50um' is not a real number"),
        (50.0 * UNITS.kPa, 0.1, "radius: a quantity in kilopascal is not one in m"),
        ((1.0, 2.0, 3.0), 0.1, "radius: a tuple of 3 is not a pair (first solid, second solid)"),
        (([1.0, 2.0], [1.0, 2.0, 3.0]), 0.1, "shapes do not broadcast: radius[0] (2,), radius[1] (3,)"),
        (50e-6, -0.1, "contact_angle: -0.1 rad is not in [0, pi)"),
        (50e-6, 20.0, "contact_angle: 20.0 rad is not in [0, pi); for degrees use numpy.deg2rad(20.0)"),
        (
            50e-6,
            (0.1, math.pi),
            f"contact_angle[1]: {math.pi} rad is not in [0, pi)",
        ),
        (50e-6, math.nan, "contact_angle: nan rad is not a number"),
        (50e-6, math.inf, "contact_angle: inf rad is not finite"),
    ],
)
def test_bad_pairs_are_refused(radius, angle, message):
    with refused(message):
        pl.Pair(radius, angle)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "control: none given; exactly one of suction, volume, humidity is needed"),
        (
            {"suction": 1e4, "volume": 1e-15},
            "control: suction and volume given; exactly one of suction, volume, humidity is needed",
        ),
        (
            {"suction": 1e4, "volume": 1e-15, "humidity": 0.9},
            "control: suction and volume and humidity given; exactly one of suction, volume, humidity is needed",
        ),
        ({"suction": math.nan}, "suction: nan Pa is not a number"),
        ({"suction": math.inf}, "suction: inf Pa is not finite"),
        ({"suction": [1e4, -math.inf]}, "suction[1]: -inf Pa is not finite"),
        ({"suction": 20.0 * UNITS.um}, "suction: a quantity in micrometer is not one in Pa"),
        ({"suction": []}, "suction: an array of shape (0,) holds no number"),
        ({"volume": 0.0}, "volume: 0.0 m^3 is not > 0"),
        ({"volume": [1e-15, -1e-15]}, "volume[1]: -1e-15 m^3 is not > 0"),
        ({"volume": math.inf}, "volume: inf m**3 is not finite"),
        (
            {"volume": 1e-3},
            "volume: 0.001 m^3 is not in [1.25e-43, 1.25e-09] m^3, 1e-30 to 10000 R³ with the mean radius R = 5e-05 m",
        ),
        ({"humidity": 0.0}, "humidity: 0.0 is not in (0, 1)"),
        ({"humidity": 1.0}, "humidity: 1.0 is not in (0, 1); 50 % are 0.5, and saturation is a suction of 0"),
        ({"humidity": 90.0}, "humidity: 90.0 is not in (0, 1); 50 % are 0.5, and saturation is a suction of 0"),
        ({"humidity": math.nan}, "humidity: nan is not a number"),
        (
            {"humidity": 0.9, "liquid": LIQUID},
            "liquid: it lacks density and molar_mass (or molar_volume), temperature, needed for humidity; "
            "give it to Liquid(...)",
        ),
        (
            {"suction": 1e4, "liquid": "water"},
            "liquid: 'water' is not a pendular.Liquid; write Liquid.water() or Liquid.named(name)",
        ),
    ],
)
@pytest.mark.parametrize("ask", [pl.rupture, pl.curve, lambda pair, **given: pl.bridge(pair, 0.0, **given)])
def test_bad_controls_are_refused(ask, arguments, message):
    with refused(message):
        ask(GRAINS, **{"liquid": WATER, **arguments})


@pytest.mark.parametrize("ask", [pl.rupture, pl.curve, pl.compare, lambda pair, **given: pl.bridge(pair, 0.0, **given)])
def test_a_radius_alone_is_no_pair(ask):
    with refused("pair: 5e-05 is not a pendular.Pair; write Pair(radius) or Pair(radius, contact_angle)"):
        ask(50e-6, suction=1e4, liquid=WATER)


@pytest.mark.parametrize(
    ("separation", "message"),
    [
        (math.nan, "separation: nan m is not a number"),
        (math.inf, "separation: inf m is not finite"),
        ([], "separation: an array of shape (0,) holds no number"),
        (1.0 * UNITS.s, "separation: a quantity in second is not one in m"),
        (-25e-6, "separation: -2.5e-05 m is not > -2.5e-05; an overlap may reach half the smaller radius"),
        ([[0.0, -1.0]], "separation[0, 1]: -1.0 m is not > -2.5e-05; an overlap may reach half the smaller radius"),
    ],
)
def test_bad_separations_are_refused(separation, message):
    with refused(message):
        pl.bridge(GRAINS, separation, suction=1e4, liquid=LIQUID)


def test_shapes_that_do_not_broadcast_are_named():
    pair = pl.Pair([50e-6, 60e-6], 0.1)
    message = (
        "shapes do not broadcast: separation (3,), suction (), radius[0] (2,), radius[1] (2,), "
        "contact_angle[0] (), contact_angle[1] ()"
    )
    with refused(message):
        pl.bridge(pair, np.zeros(3), suction=1e4, liquid=LIQUID)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (
            lambda: pl.bridge(GRAINS, 0.0, suction=1e4, liquid=LIQUID, branch="thick"),
            "branch: 'thick' is not one of 'stable', 'unstable'",
        ),
        (
            lambda: pl.rupture(GRAINS, suction=1e4, liquid=LIQUID, limit="pitchfork"),
            "limit: 'pitchfork' is not one of 'stability', 'fold'",
        ),
        (lambda: pl.curve(GRAINS, suction=1e4, liquid=LIQUID, points=4), "points: 4.0 is not >= 5"),
        (lambda: pl.bridge(GRAINS, 0.0, suction=1e4, liquid=LIQUID).profile(2), "points: 2.0 is not >= 3"),
    ],
)
def test_bad_choices_are_refused(ask, message):
    with refused(message):
        ask()


@pytest.mark.needs("liquids")
def test_an_unknown_liquid_is_refused_with_the_names_that_are_close():
    with refused("name: 'ethanoll' is not a known liquid; did you mean ethanol or methanol or ethanethiol?"):
        pl.Liquid.named("ethanoll")


def test_what_is_good_raises_no_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pl.bridge(PLATE, [0.0, 1e-6, 1.0], suction=[[-1e3], [0.0], [1e6]], liquid=LIQUID).profile()
        pl.curve(UNEQUAL, volume=[1e-16, 1e-15], liquid=LIQUID).profile()


@pytest.mark.parametrize("degrees", [5.0, 20.0, 20.05, 28.0])
def test_below_31_degrees_the_fold_comes_first(degrees):
    pair = pl.Pair(radius=1e-4, contact_angle=np.deg2rad(degrees))
    volumes = np.geomspace(1e-6, 5e-3, 25) * 1e-12
    fold = pl.rupture(pair, volume=volumes, liquid=pl.Liquid(surface_tension=0.0728)).separation
    first = pl.rupture(pair, volume=volumes, liquid=pl.Liquid(surface_tension=0.0728), limit="stability").separation
    assert first == pytest.approx(fold, rel=1e-9)
