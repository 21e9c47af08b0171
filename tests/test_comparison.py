"""Laws side by side with the exact solution: for a pair, as a map, ranked; and the pictures of it."""

import itertools
import re

import numpy as np
import pytest

import pendular as pl
from pendular.comparison import plots
from pendular.comparison.one_pair import MARKS, UP_TO
from pendular.comparison.sample import exact_sample, law_errors
from pendular.laws import laws

WATER = pl.Liquid(surface_tension=0.0728)
GRAINS = pl.Pair(50e-6, np.radians(20.0))
UNEQUAL = pl.Pair((40e-6, 100e-6), (0.2, 0.5))
SEED = 20260101

pytestmark = pytest.mark.filterwarnings("ignore::pendular.RangeWarning")


def by_name(found):
    return {answer.name: answer for answer in found.laws}


# -- the sample ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_the_rupture_work_is_the_integral_of_the_force(control):
    """By Gauss's rule in x, D = D_c (1 - x²), which takes away the infinite slope at the fold."""
    nodes, weights = np.polynomial.legendre.leggauss(80)
    x, w = 0.5 * (nodes + 1.0), 0.5 * weights
    sample = exact_sample(control, [1e-3, 0.05, 10.0][control == "suction" :][:2], [0.0, 0.6], [1.0, 4.0], 1.0 - x**2)
    work = sample.rupture_star * np.sum(w * 2.0 * x * sample.force_star, axis=1)
    assert sample.rupture_work_star == pytest.approx(work, rel=1e-6)


def test_the_sample_is_that_of_the_public_functions():
    sample = exact_sample("volume", 0.01, 0.3, np.inf, [0.0, 0.5])
    plane = pl.Pair((50e-6, np.inf), 0.3)
    volume = 0.01 * (100e-6) ** 3
    end = pl.rupture(plane, volume=volume, liquid=WATER)
    force = pl.bridge(plane, np.array([0.0, 0.5]) * end.separation, volume=volume, liquid=WATER).force
    assert sample.rupture_star == pytest.approx(end.separation / 100e-6, rel=1e-9)
    assert sample.force_star[0] == pytest.approx(force / (2.0 * np.pi * 0.0728 * 100e-6), rel=1e-9)


# -- one pair --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("control", [{"suction": 2e5}, {"volume": 1e-17}])
@pytest.mark.parametrize("pair", [GRAINS, UNEQUAL], ids=["equal", "unequal"])
def test_forces_and_rupture_distances_are_those_of_the_public_functions(pair, control):
    found = pl.compare(pair, **control, liquid=WATER)
    exact = pl.bridge(pair, found.separation[:-1], **control, liquid=WATER)
    assert found.force[:-1] == pytest.approx(exact.force, rel=1e-13)
    for answer in found.laws:
        law = laws[answer.name]
        assert answer.converted == (law.control not in control)
        if "force" in law.gives:
            told = ~np.isnan(answer.force[:-1])
            if not told.any():  # its force is for other angles, its rupture distance for all
                assert law.solids["force"] != law.solids["rupture"]
                continue
            gaps = found.separation[:-1][told]
            force = pl.bridge(pair, gaps, **control, liquid=WATER, method=answer.name).force
            assert answer.force[:-1][told] == pytest.approx(force, rel=1e-9), answer.name
            assert answer.error[:-1][told] == pytest.approx(force / exact.force[told] - 1.0, abs=1e-9)
        if "rupture" in law.gives and not answer.converted:
            end = pl.rupture(pair, **control, liquid=WATER, method=answer.name)
            assert answer.rupture_separation == pytest.approx(end.separation, rel=1e-12)
            assert answer.rupture_error == pytest.approx(end.separation / found.separation[-1] - 1.0, abs=1e-12)
        else:
            assert np.isnan(answer.rupture_error)


@pytest.mark.parametrize("control", [{"suction": 20e3}, {"volume": 1e-15}])
def test_each_law_answers_or_is_refused_with_a_reason(control):
    for pair in (GRAINS, UNEQUAL, pl.Pair((10e-6, np.inf), 0.1)):
        found = pl.compare(pair, **control, liquid=WATER)
        assert sorted([*by_name(found), *found.refused]) == sorted(laws)
        assert all(found.refused.values())


def test_laws_are_in_order_and_their_errors_are_what_the_names_say():
    found = pl.compare(GRAINS, volume=1e-15, liquid=WATER)
    own = [answer for answer in found.laws if not answer.converted]
    assert [answer.converted for answer in found.laws] == [False] * len(own) + [True] * (len(found.laws) - len(own))
    sizes = [answer.largest_error for answer in own if not np.isnan(answer.largest_error)]
    assert sizes == sorted(sizes)
    for answer in found.laws:
        near = answer.error[answer.judged]
        if not np.all(np.isnan(near)):
            assert answer.largest_error == np.nanmax(np.abs(near))
        for mark, error in zip(MARKS, answer.error_at_marks, strict=True):
            assert np.array_equal(answer.error[found.fraction == mark], [error], equal_nan=True)


def test_a_law_of_suction_is_asked_where_its_suction_holds_the_bridge_and_judged_well_inside():
    found = pl.compare(GRAINS, volume=1e-15, liquid=WATER)
    limits = pl.rupture(GRAINS, suction=found.suction, liquid=WATER).separation
    stable = pl.bridge(GRAINS, found.separation, suction=found.suction, liquid=WATER).force
    for answer in found.laws:
        if answer.converted:
            told = ~np.isnan(answer.force)
            assert told.any()
            assert np.all(found.separation[told] <= limits[told] * (1.0 + 1e-9))
            assert found.force[told] == pytest.approx(stable[told], rel=1e-6)
            assert np.all(found.separation[answer.judged] <= UP_TO * limits[answer.judged])
            assert answer.judged[0]
    assert 0.2 < by_name(found)["asymptotic"].answered_to < 0.5


def test_only_reduced_numbers_matter():
    small = pl.compare(pl.Pair((50e-6, 100e-6), 0.3), suction=20e3, liquid=WATER)
    large = pl.compare(pl.Pair((5e-3, 1e-2), 0.3), suction=400.0, liquid=pl.Liquid(surface_tension=0.1456))
    for one, other in zip(small.laws, large.laws, strict=True):
        assert one.name == other.name
        assert one.error == pytest.approx(other.error, abs=1e-9, nan_ok=True)
        assert one.rupture_error == pytest.approx(other.rupture_error, abs=1e-9, nan_ok=True)


def test_humidity_is_a_suction():
    water = pl.Liquid.water()
    humid = pl.compare(GRAINS, humidity=0.99, liquid=water)
    assert humid.control == "suction"
    assert humid.value == pytest.approx(pl.suction_from_humidity(0.99, water))


def test_the_stated_range_is_told():
    found = by_name(pl.compare(GRAINS, suction=20e3, liquid=WATER))
    assert found["toroidal2020"].outside == "H* = 13.74 is not >= 1e4"
    assert found["zhao2020"].outside == ""


@pytest.mark.parametrize(
    ("pair", "control", "message"),
    [
        (GRAINS, {}, "control: none given"),
        (GRAINS, {"suction": [1e3, 2e3]}, "pair: an array of radii, angles or suction"),
        (pl.Pair([1e-6, 2e-6], 0.0), {"suction": 1e3}, "pair: an array of radii, angles or suction"),
        (pl.Pair(1e-6, 2.0), {"suction": 1e3}, "pair: these solids hold no bridge apart"),
        (GRAINS, {"suction": 1e3, "points": 4}, "points: 4.0 is not >= 5"),
    ],
)
def test_refusals_of_a_comparison(pair, control, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        pl.compare(pair, **control, liquid=WATER)


# -- maps ------------------------------------------------------------------------------------------------------------


def test_a_map_holds_the_errors_of_single_pairs():
    found = pl.error_map("willett2000", fraction=0.3, control_star=[1e-3, 1e-2], contact_angle=[0.0, 0.4, 0.6])
    for i, j in itertools.product(range(2), range(3)):
        pair = pl.Pair(1.0, found.contact_angle[j])
        one = pl.compare(pair, volume=found.control_star[i], liquid=WATER)
        error = np.interp(0.3, one.fraction, by_name(one)["willett2000"].error)
        assert found.error[i, j] == pytest.approx(error, abs=2e-4)  # between two points of the comparison


@pytest.mark.parametrize("name", [law.name for law in laws.values() if law.gives != ("damping",)])
def test_each_law_has_a_map(name):
    low, high = laws[name].valid.get(f"{laws[name].control}_star", (1e-3, 1.0))
    middle = np.sqrt(max(low, 1e-6) * min(high, 1e6))
    at_contact = {"fraction": 0.0} if "force" in laws[name].gives else {}
    found = pl.error_map(name, **at_contact, control_star=middle, contact_angle=0.0)
    assert found.error.shape == (1, 1)
    assert abs(found.error[0, 0]) < 0.35
    sample = exact_sample(laws[name].control, middle, 0.0, 1.0, 0.0)
    assert found.error[0, 0] == np.ravel(getattr(law_errors(laws[name], sample), found.quantity))[0]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("zhao",), "law: 'zhao' is not one of 'asymptotic', "),
        (("zhao2020", 1.0), "fraction: 1.0 is not in [0, 1)"),
        (("lian1993", 0.5), "fraction: lian1993 gives no force, its error is that of the rupture"),
    ],
)
def test_refusals_of_a_map(arguments, message):
    name, *fraction = arguments
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        pl.error_map(name, fraction=fraction[0] if fraction else None)


def test_a_map_is_empty_where_solids_hold_no_bridge_apart():
    found = pl.error_map("deboer2008_volume", control_star=[1e-5], contact_angle=np.radians([10.0, 100.0]))
    assert np.isnan(found.error).tolist() == [[False, True]]
    dry = pl.error_map("pendular2026", control_star=[10.0], contact_angle=np.radians([10.0, 100.0]))
    assert np.isnan(dry.error).tolist() == [[False, True]]


# -- recommendations -------------------------------------------------------------------------------------------------

RANGES = [
    {"reduced_suction": (10.0, 1e4), "contact_angle": (0.0, 0.7)},
    {"reduced_suction": (100.0, 1e4), "contact_angle": 0.3, "size_ratio": (1.0, np.inf), "up_to": 0.5},
    {"reduced_volume": (1e-3, 1e-2), "contact_angle": (0.0, 0.3)},
]


@pytest.fixture(scope="module", params=RANGES, ids=str)
def ranked(request):
    return request.param, pl.recommend(**request.param)


def draw(rng, ends, *, is_log=False):
    low, high = np.broadcast_to(ends, 2)
    return np.exp(rng.uniform(np.log(low), np.log(high))) if is_log else low + rng.uniform() * (high - low)


def test_no_error_at_random_places_is_much_larger(ranked):
    asked, found = ranked
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    key = f"reduced_{found.control}"
    count = 200
    control = np.array([draw(rng, asked[key], is_log=True) for _ in range(count)])
    angle = np.array([draw(rng, asked.get("contact_angle", 0.0)) for _ in range(count)])
    ratio = 1.0 / np.array([draw(rng, 1.0 / np.asarray(asked.get("size_ratio", 1.0))) for _ in range(count)])
    fractions = np.append(np.sort(rng.uniform(0.0, asked.get("up_to", 0.9), 7)), asked.get("up_to", 0.9))
    sample = exact_sample(found.control, control, angle, ratio, fractions)
    assert found.ranked
    for law in found.ranked:
        worst = np.max(np.abs(law_errors(laws[law.name], sample).force))
        assert 0.1 * law.largest_error < worst < 1.02 * law.largest_error + 1e-6, law.name


def test_the_place_of_the_largest_error_is_told(ranked):
    _, found = ranked
    for law in found.ranked:
        sample = exact_sample(found.control, law.control_star, law.contact_angle, law.size_ratio, law.fraction)
        errors = law_errors(laws[law.name], sample)
        assert abs(errors.force[0, 0]) == pytest.approx(law.largest_error, rel=1e-9)
    assert [law.largest_error for law in found.ranked] == sorted(law.largest_error for law in found.ranked)


def test_every_law_of_the_control_is_ranked_or_out(ranked):
    _, found = ranked
    of_control = [name for name, law in laws.items() if law.control == found.control]
    assert sorted([*(law.name for law in found.ranked), *found.disqualified]) == sorted(of_control)
    assert found.bridges == np.prod([len(np.atleast_1d(getattr(found, n))) for n in found._fields[3:]])


def test_a_law_without_a_bridge_in_the_range_is_out():
    found = pl.recommend(reduced_suction=(1.0, 100.0))
    assert found.disqualified["zhao2020"].startswith("has no bridge at H* = 1, θ = 0°, equal spheres, ")
    assert found.disqualified["asymptotic_rupture"] == "gives no force, only the rupture"
    assert found.disqualified["contact_limit"].startswith("D* = ")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({}, "control: exactly one of reduced_suction and reduced_volume is needed, none is given"),
        ({"reduced_suction": 1.0, "reduced_volume": 1.0}, "control: exactly one of"),
        ({"reduced_suction": (2.0, 1.0)}, "reduced_suction: [2.0, 1.0] is neither a number nor a range"),
        ({"reduced_suction": 0.0}, "reduced_suction[0]: 0.0 is not > 0"),
        ({"reduced_suction": 1.0, "size_ratio": 0.5}, "size_ratio[0]: 0.5 is not >= 1"),
        ({"reduced_suction": 1.0, "up_to": 1.0}, "up_to: 1.0 is not in [0, 1)"),
        (
            {"reduced_suction": 1.0, "contact_angle": (0.0, 2.0)},
            "reduced_suction: 1 holds no bridge apart at θ = 100.3°, equal spheres; narrow the ranges",
        ),
    ],
)
def test_refusals_of_a_recommendation(options, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        pl.recommend(**options)


# -- pictures --------------------------------------------------------------------------------------------------------

PICTURES = [
    (GRAINS, {"suction": 20e3}),
    (GRAINS, {"volume": 1e-15}),
    (pl.Pair(50e-6, 0.0), {"suction": 1e6}),
    (UNEQUAL, {"volume": 1e-17}),
    (pl.Pair((10e-6, np.inf), 0.0), {"volume": 1e-18}),
]


@pytest.mark.parametrize(("pair", "control"), PICTURES)
def test_all_labels_are_inside_the_picture_and_apart(pair, control):
    found = pl.compare(pair, **control, liquid=WATER)
    drawing = plots.comparison_figure(found, title="A title", subtitle="and another line")
    drawing.draw_without_rendering()
    texts = [text for axes in drawing.axes for text in axes.texts] + drawing.texts
    boxes = {text.get_text(): text.get_window_extent() for text in texts if text.get_text()}
    for words, box in boxes.items():
        assert drawing.bbox.containsx(box.x0) & drawing.bbox.containsx(box.x1), words
        assert drawing.bbox.containsy(box.y0) & drawing.bbox.containsy(box.y1), words
    for (one, first), (other, second) in itertools.combinations(boxes.items(), 2):
        assert not first.overlaps(second), (one, other)
    upper, lower = ([text.get_text() for text in axes.texts] for axes in drawing.axes)
    for answer in found.laws:
        assert (answer.name in lower) == (not np.isnan(answer.largest_error))
        assert (answer.name in upper) == (not np.isnan(answer.rupture_error))


def test_no_two_laws_look_alike():
    styles = [plots.style_of(name) for name in laws]
    assert len(set(styles)) == len(laws)


def test_lines_show_what_was_compared():
    found = pl.compare(GRAINS, suction=20e3, liquid=WATER)
    drawing = plots.comparison_figure(found)
    drawn = [line for line in drawing.axes[1].lines if len(line.get_xdata()) == found.fraction.size]
    errors = [100.0 * answer.error for answer in found.laws]
    near = found.fraction <= 0.9
    for line in drawn:
        shown = np.asarray(line.get_ydata())[near]
        known = ~np.isnan(shown)
        assert any(np.allclose(shown[known], error[near][known]) for error in errors)
    assert drawing.axes[1].get_xlabel() == "separation (µm)"


@pytest.mark.parametrize("name", ["zhao2020", "lian1993", "pendular2026"])
def test_a_map_is_drawn_with_its_range(name):
    grid = np.geomspace(1.0, 100.0, 5) if laws[name].control == "suction" else np.geomspace(1e-4, 1e-2, 5)
    found = pl.error_map(name, control_star=grid, contact_angle=np.radians([0.0, 30.0, 60.0]))
    drawing = plots.map_figure(found)
    drawing.draw_without_rendering()
    axes = drawing.axes[0]
    assert axes.get_legend().get_texts()[0].get_text() == "range stated for the law"
    assert axes.get_xlim() == (grid[0], grid[-1])
    assert found.in_words in drawing.texts[1].get_text()
