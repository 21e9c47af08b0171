"""Bridges that are hard to find, against values of another method (level sets of the filling angles, 36 digits).

``data/hard_cases.csv`` has 103 of them: (a) large drops at a volume, which exist apart only; (b) suctions that a pair
with one hydrophobic solid hardly holds; (c) whole curves under pressure; (d) the fold itself; (e) a hydrophobic plane;
(f) the unstable branch at a volume. Lengths are in units of the first radius, and the surface tension is 1.
"""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

import pendular as pl

UNIT = pl.Liquid(surface_tension=1.0)
CLOSE = 1e-9
AT_A_FOLD = 1e-6  # the tangent is vertical there: a rounding of D moves the force by its root


def read_cases():
    text = (Path(__file__).parent / "data" / "hard_cases.csv").read_text()
    return list(csv.DictReader(text.splitlines()))


CASES = read_cases()


def of_kind(*kinds):
    cases = [case for case in CASES if case["kind"] in kinds]
    return pytest.mark.parametrize("case", cases, ids=name_of)


def with_lower_end():
    cases = [case for case in CASES if case["minimal_separation"] and case["exists"] == "1"]
    return pytest.mark.parametrize("case", cases, ids=name_of)


def name_of(case):
    return "{kind}-{r2}-{angle1_deg}-{angle2_deg}-{control}-{value}-{separation}".format(**case)


def question_of(case):
    """The pair of a case, and what is asked about it."""
    angles = (math.radians(float(case["angle1_deg"])), math.radians(float(case["angle2_deg"])))
    held = {case["control"]: float(case["value"]), "liquid": UNIT}
    are_equal = float(case["r2"]) == 1.0 and angles[0] == angles[1]
    if case["kind"] == "f" and are_equal:
        held["limit"] = "fold"  # the values are those of the symmetric branch
    return pl.Pair((1.0, float(case["r2"])), angles), held


def number(case, column):
    return float(case[column])


def bridge_of(case):
    pair, held = question_of(case)
    branch = "unstable" if case["branch"] == "unstable" else "stable"
    return pl.bridge(pair, number(case, "separation"), branch=branch, **held)


def close(value, case, column, tolerance=CLOSE):
    assert value == pytest.approx(number(case, column), rel=tolerance, abs=0.0), column


def test_all_cases_are_there():
    assert len(CASES) == 103
    assert {case["kind"] for case in CASES} == set("abcdef")


@of_kind(*"abcdef")
def test_the_bridge(case):
    bridge = bridge_of(case)
    assert bridge.exists == (case["exists"] == "1")
    assert bridge.stable == (case["stable"] == "1")
    if not bridge.exists:
        assert bridge.force == 0.0
        assert math.isnan(bridge.suction)
        assert math.isnan(bridge.volume)
        return
    tolerance = AT_A_FOLD if case["kind"] == "d" else CLOSE
    other = "volume" if case["control"] == "suction" else "suction"
    close(bridge.force, case, "force", tolerance)
    close(getattr(bridge, other), case, "other", tolerance)
    assert getattr(bridge, case["control"]) == number(case, "value")
    assert bridge.separation == number(case, "separation")


@of_kind(*"abcdef")
def test_what_is_returned_holds_what_was_asked(case):
    # the caps and the meridian that are returned, summed up anew
    bridge = bridge_of(case)
    if not bridge.exists:
        return
    outline = bridge.profile(4001)
    volume = np.trapezoid(math.pi * outline.y**2, outline.x)
    for radius, height in zip(
        bridge.contact_radius, np.abs([outline.x[0], outline.x[-1] - bridge.separation]), strict=True
    ):
        volume -= math.pi * height * (3.0 * radius**2 + height**2) / 6.0
    scale = math.pi * max(bridge.contact_radius) ** 2 * np.ptp(outline.x)
    assert volume == pytest.approx(bridge.volume, rel=1e-6, abs=1e-6 * scale)


@of_kind(*"abcdef")
def test_rupture(case):
    pair, held = question_of(case)
    end = pl.rupture(pair, **held)
    assert end.exists
    close(end.separation, case, "rupture_separation")
    close(end.force, case, "rupture_force")


@of_kind(*"abcdef")
def test_the_lower_end(case):
    pair, held = question_of(case)
    end = pl.rupture(pair, end="lower", **held)
    assert end.exists == (case["minimal_separation"] != "")
    if end.exists:
        close(end.separation, case, "minimal_separation")
        close(end.force, case, "minimal_force")
        assert getattr(end, case["control"]) == pytest.approx(number(case, "value"), rel=1e-12)


@of_kind("a", "e")
def test_the_bridge_slips_sideways_where_it_pushes(case):
    pair, held = question_of(case)
    free = number(case, "zero_force_separation")
    below, above = pl.bridge(pair, 0.999 * free, **held), pl.bridge(pair, 1.001 * free, **held)
    assert below.exists
    assert above.exists
    assert below.force < 0.0 < above.force
    assert above.stable
    assert not below.stable
    assert below.unstable_directions == 0
    assert abs(pl.bridge(pair, free, **held).force) < 1e-9


@of_kind("f")
def test_the_unstable_branch_ends(case):
    pair, held = question_of(case)
    last = number(case, "unstable_branch_end")
    below, above = (pl.bridge(pair, share * last, branch="unstable", **held) for share in (0.999, 1.001))
    assert not below.exists
    assert below.force == 0.0
    assert above.exists
    assert above.unstable_directions >= 1
    assert 0.0 < above.force < number(case, "rupture_force")


@of_kind("d")
def test_the_bridge_at_its_own_rupture(case):
    pair, held = question_of(case)
    end = pl.rupture(pair, **held)
    bridge = pl.bridge(pair, end.separation, **held)
    assert bridge.exists
    close(bridge.force, case, "rupture_force", AT_A_FOLD)
    beyond = pl.bridge(pair, (1.0 + 1e-9) * end.separation, **held)
    assert not beyond.exists


@of_kind("c")
def test_a_curve_under_pressure_reaches_its_rupture(case):
    pair, held = question_of(case)
    drawn = pl.curve(pair, points=101, **held)
    there = np.asarray(drawn.exists)
    assert there[:51].all()
    assert there.sum() > 60
    assert np.argmax(np.where(there, drawn.separation, -math.inf)) == 50
    end = pl.rupture(pair, **held)
    assert drawn.separation[50] == pytest.approx(end.separation, rel=CLOSE)
    assert drawn.separation[0] == 0.0
    np.testing.assert_allclose(drawn.suction[there], number(case, "value"), rtol=CLOSE)
    assert drawn.stable[:50].all()
    assert not drawn.stable[51:].any()
    # points of the stable branch are the bridges that one asks for by their separation
    asked = pl.bridge(pair, drawn.separation[:50:7], **held)
    np.testing.assert_allclose(drawn.force[:50:7], asked.force, rtol=1e-8)


# -- the lower end of large drops ------------------------------------------------------------------------------------


def ends_of(case):
    pair, held = question_of(case)
    return pair, held, pl.rupture(pair, end="lower", **held), pl.rupture(pair, **held)


@with_lower_end()
def test_there_are_bridges_between_both_ends_and_nowhere_else(case):
    pair, held, low, high = ends_of(case)
    shares = np.array(
        [0.999 * low.separation, 1.001 * low.separation, 0.999 * high.separation, 1.001 * high.separation]
    )
    assert pl.bridge(pair, shares, **held).exists.tolist() == [False, True, True, False]
    inside = np.linspace(low.separation, high.separation, 23)[1:-1]
    bridges = pl.bridge(pair, inside, **held)
    assert bridges.exists.all()
    assert (bridges.unstable_directions == 0).all()
    assert not pl.bridge(pair, np.linspace(0.0, 0.99 * low.separation, 7), **held).exists.any()


@with_lower_end()
def test_the_force_meets_both_ends_as_a_square_root(case):
    pair, held, low, high = ends_of(case)
    width = high.separation - low.separation
    for end, inward in ((low, 1.0), (high, -1.0)):
        steps = inward * width * np.array([1e-9, 4e-9, 1.6e-8])
        change = np.abs(pl.bridge(pair, end.separation + steps, **held).force - end.force)
        np.testing.assert_allclose(change[1:] / change[:-1], 2.0, rtol=5e-3)
        assert end.stiffness == inward * math.inf


@with_lower_end()
def test_the_force_is_the_slope_of_the_energy_from_end_to_end(case):
    pair, held, low, high = ends_of(case)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    turn = 0.5 * math.pi * (nodes + 1.0)  # in which a root at either end is smooth
    half = 0.5 * (high.separation - low.separation)
    force = pl.bridge(pair, low.separation + half * (1.0 - np.cos(turn)), **held).force
    work = 0.5 * math.pi * half * np.sum(weights * np.sin(turn) * force)
    gained = high.surface_energy - low.surface_energy
    assert work == pytest.approx(gained, rel=1e-8, abs=1e-8 * abs(high.force) * half)


@pytest.mark.parametrize(
    ("second", "degrees", "large"),
    [(1.0, (16.4, 90.9), 10.0), (5.0, (17.0, 142.0), 4.0), (20.0, (71.0, 71.0), 130.0), (math.inf, (32.0, 118.0), 9.8)],
)
def test_the_lower_end_begins_at_contact(second, degrees, large):
    pair = pl.Pair((1.0, second), tuple(np.deg2rad(degrees)))

    def lower(volume):
        return pl.rupture(pair, volume=volume, liquid=UNIT, end="lower")

    none, some = 0.2 * large, large
    assert not lower(none).exists
    assert lower(some).exists
    for _ in range(45):
        middle = 0.5 * (none + some)
        none, some = (none, middle) if lower(middle).exists else (middle, some)
    most = 0.5 * (none + some)
    excess = np.array([1e-2, 1e-3, 1e-4, 1e-5])
    ends = lower(most * (1.0 + excess))
    assert ends.exists.all()
    rates = ends.separation / excess
    assert rates[-1] > 0.0
    np.testing.assert_allclose(rates[1:], rates[-1], rtol=2e-2)
    for excess, is_there in ((-1e-6, True), (1e-6, False)):
        assert pl.bridge(pair, 0.0, volume=most * (1.0 + excess), liquid=UNIT).exists == is_there
