"""Laws asked through the public face: reduction, the other control, warnings, refusals."""

import re
import warnings

import numpy as np
import pytest

import pendular as pl
from pendular.laws import force_star, rupture_star

WATER = pl.Liquid(surface_tension=0.0728)
UNIT = pl.Liquid(surface_tension=1.0)
GRAINS = pl.Pair(radius=(40e-6, 100e-6), contact_angle=np.deg2rad(20))
EQUAL_DRY = pl.Pair(radius=50e-6, contact_angle=0.0)
# Of the same order: H* about 400, V* about 1e-3.
CONTROLS = {"suction": 5e5, "volume": 2e-16}
OTHER = {"suction": "volume", "volume": "suction"}
LAWS = list(pl.laws.values())
FORCE = [law for law in LAWS if "force" in law.gives]
RUPTURE = [law for law in LAWS if "rupture" in law.gives]


def by_name(law):
    return law.name


@pytest.fixture(autouse=True)
def _outside_is_no_matter():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pl.RangeWarning)
        yield


def reduced(pair, control, value):
    """Derjaguin radius, reduced control, angles and κ of a pair, written out again."""
    first, second = (float(radius) for radius in pair.radii)
    mean = 2.0 * first * second / (first + second)
    star = value * mean / 0.0728 if control == "suction" else value / mean**3
    return mean, star, *pair.contact_angles, mean / first, mean / second


def grains_for(law):
    """Grains of which the law knows something."""
    return EQUAL_DRY if law.solids["force"].angles == "zero" else GRAINS


@pytest.mark.parametrize("law", FORCE, ids=by_name)
def test_force_is_scaled_by_the_derjaguin_radius(law):
    pair, value = grains_for(law), CONTROLS[law.control]
    mean, *star = reduced(pair, law.control, value)
    gaps = np.array([0.0, 1e-8, 1e-5, 3e-5])
    b = pl.bridge(pair, gaps, **{law.control: value}, liquid=WATER, method=law.name)
    expected = 2.0 * np.pi * 0.0728 * mean * force_star(law.name, gaps / mean, *star)
    assert b.force == pytest.approx(expected, rel=1e-12, nan_ok=True)
    assert b.exists[0]
    np.testing.assert_array_equal(b.exists, (b.force != 0.0) & ~np.isnan(b.force))
    if "rupture" in law.gives:
        assert list(b.exists[[1, 3]]) == [True, False]
        assert b.force[-1] == 0.0
        assert np.isnan(b.separation[-1])


@pytest.mark.parametrize("law", RUPTURE, ids=by_name)
def test_rupture_is_scaled_by_the_derjaguin_radius(law):
    mean, *star = reduced(GRAINS, law.control, CONTROLS[law.control])
    r = pl.rupture(GRAINS, **{law.control: CONTROLS[law.control]}, liquid=WATER, method=law.name)
    assert r.separation == pytest.approx(float(mean * rupture_star(law.name, *star)), rel=1e-12)
    assert np.isnan(getattr(r, OTHER[law.control]))


@pytest.mark.parametrize("law", FORCE, ids=by_name)
@pytest.mark.parametrize("length", [1e-9, 1e-3, 1e3])
def test_units_scale(law, length):
    """Lengths times a, surface tension times b: force times ab."""
    angle, tension = (0.0 if law.solids["force"].angles == "zero" else 0.3), 0.05
    held = 300.0 if law.control == "suction" else 2e-3
    gaps = np.array([0.0, 1e-3, 2e-3, 0.5])
    small = pl.bridge(pl.Pair((1.0, 2.0), angle), gaps, **{law.control: held}, liquid=UNIT, method=law.name)
    unit = tension / length if law.control == "suction" else length**3
    large = pl.bridge(
        pl.Pair((length, 2.0 * length), angle),
        gaps * length,
        **{law.control: held * unit},
        liquid=pl.Liquid(surface_tension=tension),
        method=law.name,
    )
    assert large.force == pytest.approx(tension * length * small.force, rel=1e-11, nan_ok=True)
    np.testing.assert_array_equal(large.exists, small.exists)
    assert small.force[0] > 0.0


@pytest.mark.parametrize("law", FORCE, ids=by_name)
@pytest.mark.parametrize("control", CONTROLS)
def test_exchange_of_the_solids_changes_nothing(law, control):
    angles = (0.0, 0.0) if law.solids["force"].angles in ("equal", "zero") else (0.2, 0.7)
    for gap in (0.0, 2e-7):
        here, there = (
            pl.bridge(pl.Pair(radii, pair_angles), gap, **{control: CONTROLS[control]}, liquid=WATER, method=law.name)
            for radii, pair_angles in (((4e-5, 1e-4), angles), ((1e-4, 4e-5), angles[::-1]))
        )
        assert there.force == pytest.approx(here.force, rel=1e-10, nan_ok=True)
        assert there.exists == here.exists == (not np.isnan(here.force))
        assert here.exists or law.name == "contact_limit"


@pytest.mark.parametrize("name", [law.name for law in FORCE if law.control == "suction"])
def test_laws_approach_the_exact_force(name):
    pair = pl.Pair(radius=1e-3, contact_angle=np.deg2rad(20))  # H* = 1e6
    exact = pl.bridge(pair, 0.0, suction=7.28e7, liquid=WATER).force
    assert pl.bridge(pair, 0.0, suction=7.28e7, liquid=WATER, method=name).force == pytest.approx(exact, rel=1e-2)


@pytest.mark.parametrize("name", ["asymptotic", "bagheri2024"])
def test_humidity_is_a_suction_for_a_law_too(name):
    water = pl.Liquid.water()
    force = pl.bridge(EQUAL_DRY, 0.0, humidity=0.95, liquid=water, method=name).force
    suction = pl.suction_from_humidity(0.95, water)
    assert force == pl.bridge(EQUAL_DRY, 0.0, suction=suction, liquid=water, method=name).force
    assert force > 0.0


# --- the other control ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", FORCE, ids=by_name)
def test_under_the_other_control_the_law_is_asked_with_the_exact_bridge(law):
    given, pair = OTHER[law.control], grains_for(law)
    held = {given: CONTROLS[given]}
    gaps = np.array([[0.0], [3e-8]])
    exact = pl.bridge(pair, gaps, **held, liquid=WATER)
    b = pl.bridge(pair, gaps, **held, liquid=WATER, method=law.name)
    mean, star, *solids = reduced(pair, law.control, getattr(exact, law.control))
    expected = 2.0 * np.pi * 0.0728 * mean * force_star(law.name, gaps / mean, star, *solids)
    assert b.force == pytest.approx(expected, rel=1e-12, nan_ok=True)
    assert b.exists.tolist() == [[True], [law.name != "contact_limit"]]
    assert getattr(b, given)[b.exists] == pytest.approx(CONTROLS[given])
    assert b.force[0, 0] == pytest.approx(exact.force[0, 0], rel=0.25)


def test_existence_is_then_that_of_the_exact_bridge():
    fold = pl.rupture(EQUAL_DRY, suction=5e5, liquid=WATER).separation
    gaps = fold * np.array([1.0 - 1e-6, 1.0 + 1e-6])
    b = pl.bridge(EQUAL_DRY, gaps, suction=5e5, liquid=WATER, method="soulie2006")
    assert b.exists.tolist() == [True, False]
    assert b.force[0] > 0.0
    assert b.force[1] == 0.0
    assert np.isnan(b.separation[1])


def test_a_law_that_ends_early_has_no_bridge_where_the_exact_solver_has_one():
    pair, suction = pl.Pair(radius=1.0, contact_angle=np.deg2rad(40)), 10.0
    separation = 0.9 * pl.rupture(pair, suction=suction, liquid=UNIT).separation
    volume = pl.bridge(pair, separation, suction=suction, liquid=UNIT).volume
    b = pl.bridge(pair, separation, volume=volume, liquid=UNIT, method="toroidal2020")
    assert not b.exists
    assert b.force == 0.0


def test_law_at_constant_suction_knows_only_what_its_suction_holds():
    """Half-way to its rupture a bridge of this volume passes the fold of its suction; the law knows the thicker one."""
    limit = pl.rupture(EQUAL_DRY, volume=1e-16, liquid=WATER).separation
    fractions = np.array([0.4, 0.5, 0.9, 1.1])
    b = pl.bridge(EQUAL_DRY, fractions * limit, volume=1e-16, liquid=WATER, method="asymptotic")
    exact = pl.bridge(EQUAL_DRY, fractions * limit, volume=1e-16, liquid=WATER)
    assert b.force[0] == pytest.approx(exact.force[0], rel=0.01)
    assert np.isnan(b.force[1:3]).all()
    assert b.force[3] == 0.0
    assert b.exists.tolist() == [True, False, False, False]


def test_law_at_constant_suction_has_no_word_for_pressure():
    pair = pl.Pair(radius=50e-6, contact_angle=np.deg2rad(75))
    exact = pl.bridge(pair, 20e-6, volume=2e-14, liquid=WATER)
    assert exact.suction < 0.0
    for name in ("zhao2020", "asymptotic", "pendular2026"):
        b = pl.bridge(pair, 20e-6, volume=2e-14, liquid=WATER, method=name)
        assert np.isnan(b.force)
        assert not b.exists


@pytest.mark.parametrize("law", RUPTURE, ids=by_name)
def test_rupture_belongs_to_one_control(law):
    given = OTHER[law.control]
    with pytest.raises(
        ValueError, match=f"^method: '{law.name}' gives the rupture distance at constant {law.control}, not at constant"
    ):
        pl.rupture(GRAINS, **{given: CONTROLS[given]}, liquid=WATER, method=law.name)


# --- no silence beside a bridge ---------------------------------------------------------------------------------------

SEED = 20261101


def random_pair(rng):
    """Equal or unequal spheres or a sphere and a plane, of equal or different angles, a few beyond a right angle."""
    radius = 1e-5 * np.array([1.0, rng.choice([1.0, rng.uniform(1.0, 20.0), np.inf])])
    angles = rng.uniform(0.0, 1.7, 2) if rng.random() < 0.5 else np.full(2, rng.choice([0.0, rng.uniform(0.0, 1.7)]))
    return pl.Pair(tuple(rng.permutation(radius)), tuple(angles))


def random_states(control, count):
    """Pairs, each with a control and gaps from an overlap to beyond rupture."""
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    for _ in range(count):
        pair = random_pair(rng)
        mean = float(pair.derjaguin_radius)
        star = 10.0 ** (rng.uniform(-2.0, 6.0) if control == "suction" else rng.uniform(-7.0, 0.0))
        value = star * 0.0728 / mean if control == "suction" else star * mean**3
        reach = mean * (1.0 / (1.0 + star) if control == "suction" else np.cbrt(star))
        yield pair, {control: value}, reach * np.array([-1e-3, 0.0, 0.2, 0.7, 1.1, 1.6, 3.0])


def ask(function, *arguments, **options):
    """Answer and range warnings; None for solids that a law does not cover, refused in one line that says so."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            answer = function(*arguments, **options)
        except ValueError as refusal:
            line = rf"(contact_angle|radius): .* is not covered by '{options['method']}'; its \w+ is for .+"
            if not re.fullmatch(line, str(refusal)):
                raise
            return None, []
    return answer, [str(warning.message) for warning in caught if warning.category is pl.RangeWarning]


@pytest.mark.parametrize("law", FORCE, ids=by_name)
@pytest.mark.parametrize("control", CONTROLS)
def test_no_force_is_missing_beside_a_bridge(law, control):
    answered = 0
    for pair, held, gaps in random_states(control, 60):
        b, told = ask(pl.bridge, pair, gaps, **held, liquid=WATER, method=law.name)
        if b is None:
            continue
        answered += 1
        np.testing.assert_array_equal(b.exists, (b.force != 0.0) & ~np.isnan(b.force))
        np.testing.assert_array_equal(b.stable, b.exists)
        np.testing.assert_array_equal(b.sideways_stable, b.exists)
        np.testing.assert_array_equal(b.unstable_directions, 0)
        assert np.isnan(b.separation[~b.exists]).all()
        exact = pl.bridge(pair, gaps, **held, liquid=WATER)
        silent = np.isnan(b.force) & (exact.exists if control != law.control else True)
        assert bool(told) or not silent.any()
        if silent.any():
            assert f"it says nothing of {np.count_nonzero(silent)} out of {gaps.size} bridges" in told[0]
    assert answered > 3


@pytest.mark.parametrize("law", RUPTURE, ids=by_name)
def test_no_rupture_distance_is_missing_beside_a_bridge(law):
    answered = 0
    for pair, held, _ in random_states(law.control, 120):
        r, told = ask(pl.rupture, pair, **held, liquid=WATER, method=law.name)
        if r is None:
            continue
        answered += 1
        assert r.exists == (not np.isnan(r.separation))
        assert r.exists or told
    assert answered > 10


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_what_is_made_of_two_solids_that_differ_is_told(law):
    """Refused, answered as they are, or answered by a mean with a warning: by the record, and told by it."""
    differing = {
        "angles": pl.Pair(1e-5, (0.1, 0.2)),
        "spheres": pl.Pair((1e-5, 2e-5)),
        "plane": pl.Pair((1e-5, np.inf)),
    }
    gap, star = {"force": (0.0,), "rupture": ()}, {"suction": 1e5, "volume": 5e-3}[law.control]
    for quantity in (quantity for quantity in law.gives if quantity in gap):
        function = {"force": pl.bridge, "rupture": pl.rupture}[quantity]
        for what, pair in differing.items():
            rule = getattr(law.solids[quantity], what)
            mean = float(pair.derjaguin_radius)
            held = {law.control: star * 0.0728 / mean if law.control == "suction" else star * mean**3}
            answer, told = ask(function, pair, *gap[quantity], **held, liquid=WATER, method=law.name)
            if rule in ("equal", "zero", "none"):
                assert answer is None
                continue
            assert answer.exists
            stated = law.valid.get("size_ratio", (1.0, 1.0))[1]
            ratio = {"angles": 1.0, "spheres": 2.0, "plane": np.inf}[what]
            is_warned = rule.startswith("mean") and (what == "angles" or ratio > stated)
            assert bool(told) == is_warned
            if is_warned:
                words = law.solids[quantity].angle_words if what == "angles" else law.solids[quantity].size_words
                assert words in told[0]


@pytest.mark.parametrize("control", CONTROLS)
def test_the_comparison_and_the_bridge_by_a_law_agree_in_every_state(control):
    compared = 0
    for pair, held, _ in random_states(control, 40):
        if not (pl.rupture(pair, **held, liquid=WATER).exists and pl.bridge(pair, 0.0, **held, liquid=WATER).exists):
            continue
        found = pl.compare(pair, **held, liquid=WATER, points=9)
        gaps = found.separation[:-1]
        answers = {answer.name: answer.force[:-1] for answer in found.laws}
        for law in FORCE:
            b, _ = ask(pl.bridge, pair, gaps, **held, liquid=WATER, method=law.name)
            by_bridge = np.full(gaps.shape, np.nan) if b is None else b.force
            by_comparison = answers.get(law.name, np.full(gaps.shape, np.nan))
            np.testing.assert_allclose(by_comparison, by_bridge, rtol=1e-9, err_msg=f"{law.name} {pair} {held}")
            compared += np.count_nonzero(~np.isnan(by_bridge))
    assert compared > 500


# --- warnings and refusals --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ask", "start"),
    [
        (
            lambda: pl.bridge(GRAINS, [0.0, 1e-9], suction=[1.0, 2.0], liquid=WATER, method="zhao2020"),
            "suction_star 0.00078",
        ),
        (lambda: pl.bridge(GRAINS, 0.0, volume=[1e-20, 1e-21], liquid=WATER, method="willett2000"), "volume_star 5.3"),
        (lambda: pl.bridge(GRAINS, 0.0, suction=[1e7, 1e8], liquid=WATER, method="willett2000"), "volume_star "),
        (lambda: pl.rupture(GRAINS, volume=[1e-20, 1e-21], liquid=WATER, method="willett2000"), "volume_star 5.3"),
        (
            lambda: pl.bridge(GRAINS, [1e-9, 2e-9], suction=1e9, liquid=WATER, method="contact_limit"),
            "separation_star ",
        ),
    ],
)
def test_outside_the_range_one_warning_a_call(ask, start):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        ask()
    assert [warning.category for warning in caught] == [pl.RangeWarning]
    assert re.match(rf"\w+: {start}\S* is outside the range ", str(caught[0].message))
    assert caught[0].filename == __file__


def test_the_range_is_that_of_the_control_of_the_law():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pl.bridge(GRAINS, [0.0, 1e-9], volume=1e-20, liquid=WATER, method="zhao2020")
        pl.bridge(EQUAL_DRY, [0.0, 1e-9], suction=5e4, liquid=WATER, method="bagheri2024")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"method": "zhao"}, "method: 'zhao' is not one of 'exact', 'table', 'dataset', 'asymptotic', "),
        ({"method": "asymptotic_rupture"}, "method: 'asymptotic_rupture' gives no force, only the rupture"),
        ({"method": "lian1993"}, "method: 'lian1993' gives no force, only the rupture"),
        ({"method": "deboer2008"}, "method: 'deboer2008' gives no force, only the rupture work"),
        ({"method": "zhao2020", "branch": "unstable"}, "branch: 'unstable' is not one of 'stable'"),
    ],
)
def test_refusals(options, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        pl.bridge(GRAINS, 0.0, suction=CONTROLS["suction"], liquid=WATER, **options)


def test_a_law_of_the_force_alone_has_no_rupture():
    with pytest.raises(ValueError, match=r"^method: 'lambert2008' gives no rupture, only the force"):
        pl.rupture(GRAINS, volume=1e-16, liquid=WATER, method="lambert2008")
