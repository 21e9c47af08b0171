"""The straight way of the solver against the rest of it: arcs, bridges and ruptures in algebraic numbers."""

import math

import numpy as np
import pytest

from pendular.exact import batch
from pendular.exact.arc import (
    LEAST_ROOM,
    W48,
    X48,
    Arc,
    crowded_at,
    force_on,
    force_rates_on,
    half_from_neck,
    meridian_of,
    room_of,
    sums_of,
    system_on,
)
from pendular.exact.equations import SUCTION, VOLUME, Held, force_of, system_at
from pendular.exact.fold import extrema_on
from pendular.exact.meridian import extreme_phases, measure_arc, tensor_of
from pendular.exact.solids import solid_of
from pendular.exact.state import State

SEED = 20261130


def random_arcs(count):
    """Arcs of all shapes that one panel serves, between two solids."""
    rng = np.random.default_rng(SEED)
    while count:
        half = 10.0 ** rng.uniform(-3.0, 1.0)
        arc = Arc(half * 10.0 ** rng.uniform(-0.6, 2.0), rng.uniform(-2.0, 2.0), half, rng.uniform(-2.5, 2.5))
        if room_of(arc) > LEAST_ROOM:
            count -= 1
            solids = [solid_of(10.0 ** rng.uniform(-2.0, 0.0), rng.uniform(0.0, 2.0)) for _ in range(2)]
            yield arc, Held(*solids, VOLUME, 1.0)


def moved(arc, j, step):
    """The arc with one of its numbers changed."""
    numbers = [math.log(arc.radius), arc.slope, math.log(arc.half_width), arc.eta]
    numbers[j] += step
    return Arc(math.exp(numbers[0]), numbers[1], math.exp(numbers[2]), numbers[3])


def values_of(arc, held):
    """All equations and the force."""
    system = system_on(arc, held, sums_of(arc, room_of(arc), True, True), True)
    names = ("contact1", "contact2", "separation", "volume", "first_gap", "length")
    return np.array([getattr(system, name).value for name in names] + [force_on(arc)]), system


def test_equations_of_an_arc_are_those_of_its_meridian():
    print("seed", SEED)
    for arc, held in random_arcs(300):
        found, system = values_of(arc, held)
        z = meridian_of(arc)
        other = system_at(z, held, True, True)
        names = ("contact1", "contact2", "separation", "volume", "first_gap", "length")
        known = np.array([getattr(other, name).value for name in names] + [force_of(z)])
        size = math.exp(z.log_length) + math.exp(z.log_radius)
        scale = np.array([1.0 + size, 1.0 + size, size, size**3, size, size, size * (1.0 + abs(arc.eta))])
        scale = np.maximum(scale, np.abs(known))
        np.testing.assert_allclose(found / scale, known / scale, rtol=0.0, atol=2e-12)
        assert system.first.radius == pytest.approx(other.first.radius, rel=1e-12)


def any_arcs(count, thinnest):
    """Arcs of up to more than half a turn, with necks down to so much of their width."""
    rng = np.random.default_rng(SEED)
    while count:
        half = 10.0 ** rng.uniform(-3.0, 1.0)
        arc = Arc(half * 10.0 ** rng.uniform(-2.0, 1.0), rng.uniform(-2.0, 2.0), half, rng.uniform(-3.8, 3.8))
        if room_of(arc) > thinnest:
            count -= 1
            yield arc, Held(*[solid_of(10.0 ** rng.uniform(-2.0, 0.0), 1.0) for _ in range(2)], VOLUME, 1.0)


def test_nodes_that_crowd_tell_the_equations_of_thin_arcs():
    print("seed", SEED)
    thin = 0
    for arc, held in any_arcs(300, 0.02):
        thin += room_of(arc) < LEAST_ROOM
        found = system_on(arc, held, crowded_at(arc, X48, W48, True), True)
        without = system_on(arc, held, crowded_at(arc, X48, W48, False), False)
        known = system_at(meridian_of(arc), held, True, True)
        size = max(arc.half_width, known.first.radius, known.second.radius)
        for name, unit in (("separation", size), ("length", size), ("volume", size**3)):
            scale = unit + abs(getattr(known, name).value)
            assert getattr(found, name).value == pytest.approx(getattr(known, name).value, abs=3e-11 * scale)
        np.testing.assert_allclose(without.length.rates, found.length.rates, rtol=1e-9, atol=1e-11 * size)
        sums, measured = sums_of(arc, room_of(arc), True, True), tensor_of(meridian_of(arc))
        area = np.pi * arc.half_width**2
        np.testing.assert_allclose([area * sums.across, 2.0 * area * sums.axial], measured, rtol=1e-9)
    assert thin > 30


def test_extrema_are_the_roots_of_a_square_polynomial():
    print("seed", SEED)
    seen = set()
    for arc, _held in any_arcs(2000, 0.0):
        necks, bulges = extreme_phases(meridian_of(arc))
        assert extrema_on(arc) == necks + bulges
        seen.add(necks + bulges)
    assert seen == {0, 1, 2}


def test_half_an_arc_from_its_neck_is_half_of_the_whole():
    """Necks down to a ten thousandth of the width among them."""
    print("seed", SEED)
    rng = np.random.default_rng(SEED)
    for _ in range(300):
        tau, eta = 10.0 ** rng.uniform(-2.0, 1.0), rng.uniform(-1.0, 2.5)
        arc = Arc(tau * 10.0 ** rng.uniform(-4.0, 0.5), 0.0, tau, eta)
        half, z = half_from_neck(arc), meridian_of(arc)
        length, liquid = measure_arc(z, True, True)
        across, axial = tensor_of(z)
        size = 2.0 * tau
        np.testing.assert_allclose(size * half.length, length.value, rtol=1e-12, atol=1e-13 * size)
        np.testing.assert_allclose(size * tau**2 * half.volume, liquid.value, rtol=1e-12, atol=1e-13 * size**3)
        np.testing.assert_allclose(4.0 * np.pi * tau**2 * half.area, 2.0 * across + axial, rtol=1e-12)


def test_rates_of_an_arc_are_those_of_differences():
    print("seed", SEED)
    for arc, held in random_arcs(100):
        _, system = values_of(arc, held)
        rates = np.array(
            [system.contact1.rates, system.contact2.rates, system.separation.rates, system.volume.rates,
             system.first_gap.rates, system.length.rates, force_rates_on(arc)]
        )  # fmt: skip
        for j in range(4):
            step = 1e-5
            above, below = (values_of(moved(arc, j, sign * step), held)[0] for sign in (1.0, -1.0))
            scale = np.abs(above) + np.abs(below) + np.abs(rates[:, j]) + 1e-3 * np.abs(rates).max(axis=1)
            np.testing.assert_allclose((above - below) / (2.0 * step) / scale, rates[:, j] / scale, atol=2e-7)


def random_rows(count, control, alike):
    """Questions at contact: pairs of all ratios, planes among them."""
    rng = np.random.default_rng(SEED + alike)
    k2 = np.ones(count) if alike else np.where(rng.random(count) < 0.2, 0.0, 10.0 ** rng.uniform(-3.0, 0.0, count))
    one, other = np.deg2rad(rng.uniform(0.0, 90.0, (2, count)))
    mean = 0.5 * (1.0 + k2)
    held = 10.0 ** rng.uniform(-9.0, 0.5, count) / mean**3 if control == VOLUME else 10.0 ** rng.uniform(-2, 6, count)
    return np.column_stack([np.zeros(count), held, np.ones(count), one, k2, one if alike else other])


@pytest.mark.needs("numba")
@pytest.mark.parametrize("control", [SUCTION, VOLUME])
@pytest.mark.parametrize("alike", [False, True])
def test_ruptures_by_leaps_are_those_of_the_walk(control, alike):
    """And nearly all are found so: of the rest the walk is asked."""
    print("seed", SEED)
    rows = random_rows(3000, control, alike)
    found, statuses = batch.answer(batch.RUPTURE, control, rows)
    left, open_rows = np.empty((len(rows), len(State._fields))), np.empty(len(rows), np.int8)
    asking = (batch.RUPTURE, batch.BRANCH_ENDS, control, rows, left, open_rows, batch.ABREAST)
    batch.over_rows(batch.summit_range, len(rows), 1024, *asking)
    walked, by_walk = np.empty_like(left), np.empty_like(open_rows)
    asking = (batch.RUPTURE, batch.BRANCH_ENDS, control, rows, walked, by_walk)
    batch.over_rows(batch.end_range, len(rows), 1024, *asking)
    both = (open_rows == batch.FOUND) & (by_walk == batch.FOUND)
    assert both.mean() > (0.6 if alike and control == VOLUME else 0.95)
    np.testing.assert_allclose(left[both, 0], walked[both, 0], rtol=3e-12)
    for name in ("force", "curvature", "volume", "area", "radius1"):
        j = State._fields.index(name)
        np.testing.assert_allclose(left[both, j], walked[both, j], rtol=1e-8, atol=1e-12)
    assert np.mean(statuses == batch.FOUND) > 0.99
    # no bridge beyond, and one just before
    sure = (statuses == batch.FOUND) & (found[:, 0] > 0.0)
    sure &= np.cumsum(sure) <= 300
    for factor, expected in ((1.0 + 1e-7, batch.NO_BRIDGE), (1.0 - 1e-6, batch.FOUND)):
        asked = rows[sure].copy()
        asked[:, 0] = factor * found[sure, 0]
        assert np.mean(batch.answer(batch.STABLE, control, asked)[1] == expected) == 1.0


@pytest.mark.needs("numba")
@pytest.mark.parametrize("control", [SUCTION, VOLUME])
def test_the_straight_way_finds_nearly_all_bridges_and_no_other(control):
    print("seed", SEED)
    rows = random_rows(3000, control, False)
    ends, statuses = batch.answer(batch.RUPTURE, control, rows)
    rows = rows[statuses == batch.FOUND]
    rows[:, 0] = np.random.default_rng(SEED).uniform(0.0, 0.98, len(rows)) * ends[statuses == batch.FOUND, 0]
    states, found = np.empty((len(rows), len(State._fields))), np.empty(len(rows), np.int8)
    batch.over_rows(batch.stable_range, len(rows), 1024, batch.ALL, control, rows, states, found, batch.ABREAST)
    rest, by_rest = np.empty_like(states), np.empty_like(found)
    batch.over_rows(batch.end_range, len(rows), 1024, batch.STABLE, batch.BRANCH_ENDS, control, rows, rest, by_rest)
    is_found = found == batch.FOUND
    assert is_found.mean() > 0.98
    is_found &= by_rest == batch.FOUND
    assert is_found.mean() > 0.97
    for name in ("force", "curvature", "volume", "area", "axial_tensor", "stiffness", "filling1", "wetted_area2"):
        j = State._fields.index(name)
        scale = np.abs(rest[is_found, j]) + (np.abs(rest[is_found, 10]) ** -1.0 * 1e-3 if name == "curvature" else 0.0)
        tolerance = 1e-7 if name == "stiffness" else 1e-9
        np.testing.assert_allclose(states[is_found, j] / scale, rest[is_found, j] / scale, rtol=tolerance, atol=1e-11)
