"""Rows abreast, in the lanes of a vector: the same answers as one by one, whatever stands beside them."""

import numpy as np
import pytest

import pendular as pl
from pendular.exact import batch
from pendular.exact.arc import W24, X24, Arc, has_room, room_of, sums_of, system_on
from pendular.exact.direct import _change_at_suction, start_of
from pendular.exact.equations import SUCTION, VOLUME, Held
from pendular.exact.stability import ladder_of
from pendular.exact.suction import _directions_of, _step_to, stand_of
from pendular.exact.volume import volume_target
from pendular.ground.rows import by_machine_code
from test_direct import random_arcs

SEED = 20261130
UNIT = pl.Liquid(surface_tension=1.0)


def under_suction(count):
    """Arcs with enough room for 24 nodes, and what is held where they are bridges."""
    for arc, held in random_arcs(2 * count):
        curvature = arc.eta / arc.half_width
        if has_room(arc, 0.85):
            yield arc, Held(held.first, held.second, SUCTION, curvature)


def test_the_numbers_of_suction_are_those_of_the_equations():
    """Two sums over the arc, instead of four, tell the length and all rates: Newton's step and the ladder agree."""
    seen = set()
    for arc, held in under_suction(300):
        system = system_on(arc, held, sums_of(arc, room_of(arc), True, False), False)
        stand = stand_of(arc, held, X24, W24)
        size = abs(system.length.value) + system.first.radius + system.second.radius
        np.testing.assert_allclose(
            [stand.separation, stand.length, stand.first.miss, stand.second.miss],
            [system.separation.value, system.length.value, system.contact1.value, system.contact2.value],
            rtol=1e-11,
            atol=1e-12 * (1.0 + size),
        )
        separation = system.separation.value + 0.01 * size
        known, found = _change_at_suction(system, arc.eta, separation), _step_to(stand, arc, separation)
        np.testing.assert_allclose(found, known, rtol=1e-7, atol=1e-9 * np.abs(known).max())
        for extrema in (0, 1, 2, 3):
            directions = ladder_of(system, arc.eta, extrema, False).at_suction
            assert _directions_of(stand, float(extrema)) == directions
            seen.add(directions)
    assert {0, 1, 2} <= seen


@pytest.mark.parametrize("excess", [1e-12, -1e-6, 0.01, -0.5, 0.9])
def test_the_logarithm_that_corrects_a_volume(excess):
    exactly = -(1.0 + excess) * np.log1p(excess)
    assert volume_target(excess) == pytest.approx(exactly, rel=1e-3 if abs(excess) > 0.1 else 1e-9)


def questions(count, control):
    """Random pairs, planes among them, some beyond rupture."""
    rng = np.random.default_rng(SEED)
    radius = np.where(rng.random(count) < 0.1, np.inf, 10.0 ** rng.uniform(0.0, 2.0, count))
    angles = tuple(np.deg2rad(rng.uniform(0.0, 120.0, (2, count))))
    scale = 2.0 / (1.0 + 1.0 / radius)
    if control == "volume":
        held = scale**3 * 10.0 ** rng.uniform(-9.0, 0.5, count)
        gap = np.cbrt(held) * rng.uniform(0.0, 1.2, count)
    else:
        held = 10.0 ** rng.uniform(-2.0, 5.0, count) / scale
        gap = rng.uniform(0.0, 1.2, count) / (held + 2.0)
    return gap, held, radius, angles


def asked(control, rows, fields):
    gap, held, radius, angles = rows
    with by_machine_code():
        return pl.bridge(pl.Pair((1.0, radius), angles), gap, **{control: held}, liquid=UNIT, fields=fields)


@pytest.mark.needs("numba")
@pytest.mark.parametrize("fields", [("force",), None])
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_an_answer_does_not_depend_on_those_beside_it(control, fields):
    print("seed", SEED)
    gap, held, radius, angles = questions(203, control)
    whole = asked(control, (gap, held, radius, angles), fields).force
    order = np.random.default_rng(SEED).permutation(gap.size)[:101]
    part = asked(control, (gap[order], held[order], radius[order], tuple(a[order] for a in angles)), fields).force
    np.testing.assert_array_equal(whole[order], part)
    for i in range(0, gap.size, 40):
        one = asked(
            control, (gap[i : i + 1], held[i : i + 1], radius[i : i + 1], tuple(a[i : i + 1] for a in angles)), fields
        )
        assert one.force[0] == whole[i]
    assert 0.3 < np.mean(whole > 0.0) < 1.0


@pytest.mark.needs("numba")
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_a_rupture_does_not_depend_on_those_beside_it(control):
    print("seed", SEED)
    _, held, radius, angles = questions(203, control)

    def ruptures(which):
        pair = pl.Pair((1.0, radius[which]), tuple(angle[which] for angle in angles))
        with by_machine_code():
            return pl.rupture(pair, **{control: held[which]}, liquid=UNIT)

    whole = ruptures(np.arange(held.size))
    order = np.random.default_rng(SEED).permutation(held.size)[:101]
    part = ruptures(order)
    for name in ("separation", "force", "suction", "liquid_gas_area"):
        np.testing.assert_array_equal(getattr(whole, name)[order], getattr(part, name))
    for i in range(0, held.size, 40):
        np.testing.assert_array_equal(ruptures(np.array([i])).separation, whole.separation[i : i + 1])
    assert np.mean(whole.exists) > 0.5


@pytest.mark.needs("numba")
@pytest.mark.parametrize("control", [SUCTION, VOLUME])
def test_rows_abreast_are_answered_as_one_by_one(control):
    """And what they find holds: all equations are met."""
    print("seed", SEED)
    gap, held, radius, angles = questions(2000, "volume" if control == VOLUME else "suction")
    rows = np.column_stack([gap, held, np.ones(gap.size), angles[0], 1.0 / radius, angles[1]])
    with by_machine_code():
        states, statuses = batch.answer(batch.STABLE, control, rows)
        rest, by_rest = batch.answer_rest(batch.STABLE, control, rows, batch.BRANCH_ENDS)
    np.testing.assert_array_equal(statuses, by_rest)
    found = statuses == batch.FOUND
    np.testing.assert_allclose(states[found, 2], rest[found, 2], rtol=1e-9, atol=1e-12)


@pytest.mark.needs("numba")
def test_bridges_beyond_the_fold_of_the_one_that_newton_meets():
    """Wide bridges on a well wetted plane, whose closed guess leads to the unstable one, are found without a walk."""
    gap = np.array([0.323, 0.542, 0.539, 0.777, 0.229, 0.387])
    held = np.array([0.0401, 0.00606, 0.0852, 0.0273, 0.454, 0.0806])
    one = np.deg2rad([73.9, 76.6, 65.2, 69.3, 85.4, 69.6])
    other = np.deg2rad([22.8, 17.0, 11.6, 4.9, 18.0, 27.7])
    rows = np.column_stack([gap, held, np.ones(gap.size), one, np.zeros(gap.size), other])
    states, statuses = np.empty((gap.size, len(batch.State._fields))), np.empty(gap.size, np.int8)
    with by_machine_code():
        batch.over_rows(batch.stable_range, gap.size, 64, batch.ALL, SUCTION, rows, states, statuses, batch.ABREAST)
        rest, _ = batch.answer_rest(batch.STABLE, SUCTION, rows, batch.BRANCH_ENDS)
    assert (statuses == batch.FOUND).all()
    np.testing.assert_allclose(states[:, 2], rest[:, 2], rtol=1e-10)


def test_the_closed_guess_is_an_arc_of_the_suction_that_is_held():
    for arc, held in under_suction(30):
        start = start_of(held, 0.1, 1.0)
        assert isinstance(start, Arc)
        assert start.eta == pytest.approx(held.value * start.half_width, rel=1e-12)
        assert arc.radius > 0.0
