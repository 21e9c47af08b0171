"""Solids of any shape by machine code: the answers of plain Python, and of the oracles; and what of it is shared."""

import math

import numpy as np
import pytest

import pendular as pl
import test_solids
from pendular.exact import batch, equations, meridian, newton
from pendular.exact.equations import SUCTION, VOLUME
from pendular.exact.shapes import rows as shape_rows
from pendular.exact.shapes.retold import retold
from pendular.exact.solids import drawn
from pendular.exact.solids.surface import DRAWN, NO_PROFILE, SPHERE, surface_of
from pendular.exact.state import State
from pendular.ground import rows
from pendular.ground.compile import tried

UNIT = test_solids.UNIT
COMPILER = pytest.mark.needs("numba")
FIELDS = (
    "separation", "suction", "volume", "force", "liquid_gas_area", "surface_energy", "contact_radius",
    "half_filling_angle", "wetted_area", "unstable_directions", "sideways_stable", "exists",
)  # fmt: skip


def asked(rng, i):
    """A random question of any kind about two random solids."""
    pair, _ = test_solids.random_pair(rng)
    volume = rng.random() < 0.5
    held = {"volume": 10.0 ** rng.uniform(-3.0, 0.5)} if volume else {"suction": 10.0 ** rng.uniform(-1.5, 2.0)}
    gap = 10.0 ** rng.uniform(-3.0, 0.3)
    if i % 6 == 5:
        return lambda: pl.curve(pair, **held, liquid=UNIT, points=9)
    if i % 6 >= 3:
        return lambda: pl.rupture(pair, **held, liquid=UNIT, end=("upper", "lower")[i % 2])
    return lambda: pl.bridge(pair, gap, **held, liquid=UNIT, branch=("stable", "stable", "unstable")[i % 3])


def plainly(monkeypatch, ask):
    with monkeypatch.context() as patch:
        patch.setattr(rows, "_machine_code", lambda *_: None)
        return ask()


@COMPILER
def test_plain_python_and_machine_code_agree(monkeypatch):
    seed, found = 51, 0
    rng = np.random.default_rng(seed)
    for i in range(48):
        ask = asked(rng, i)
        with test_solids.quietly():
            one = plainly(monkeypatch, ask)
            with rows.by_machine_code():
                other = ask()
        found += int(np.sum(one.exists))
        for name in FIELDS:
            a, b = np.asarray(getattr(one, name), float), np.asarray(getattr(other, name), float)
            scale = np.max(np.abs(np.nan_to_num(a)), initial=0.0)
            np.testing.assert_allclose(b, a, rtol=1e-9, atol=1e-10 * scale + 1e-14, err_msg=f"seed {seed}, {i}, {name}")
    print(f"seed {seed}: {found} bridges")
    assert found > 40


@COMPILER
@pytest.mark.parametrize("kind", test_solids.SHAPES)
def test_machine_code_makes_the_bridges_of_an_integrator(kind):
    with rows.by_machine_code():
        test_solids.check_against_made(52, kind, 5)


@COMPILER
def test_machine_code_makes_bridges_on_the_side_of_a_cylinder():
    with rows.by_machine_code():
        test_solids.check_on_a_side(53, 6)


@COMPILER
def test_every_answer_of_machine_code_solves_the_equation():
    with rows.by_machine_code():
        answered, silent = test_solids.check_questions(54, 60)
    assert answered > 20
    assert silent < 15


@COMPILER
def test_threads_and_rows_change_no_bit(monkeypatch):
    monkeypatch.setattr(shape_rows, "_CHUNK", 5)
    monkeypatch.setattr(rows, "thread_count", lambda: 3)
    tip, volumes = pl.Pair((pl.Cone(1.0, 0.1), pl.Disc(1.0)), (0.3, 0.7)), np.geomspace(1e-4, 1.0, 40)
    with rows.by_machine_code():
        many = pl.bridge(tip, 0.02, volume=volumes, liquid=UNIT)
        each = [pl.bridge(tip, 0.02, volume=volume, liquid=UNIT).force for volume in volumes]
    np.testing.assert_array_equal(many.force, each)


@pytest.mark.parametrize("control", [SUCTION, VOLUME])
@pytest.mark.parametrize("asked", [batch.STABLE, batch.RUPTURE])
def test_two_spheres_among_them_are_those_of_their_own_solver(control, asked, monkeypatch):
    seed, count = 55 + control, 12
    rng = np.random.default_rng(seed)
    value = 10.0 ** (rng.uniform(-4.0, -0.5, count) if control == VOLUME else rng.uniform(-0.5, 2.0, count))
    gap = 0.2 * np.cbrt(value) if control == VOLUME else 0.05 / value
    k2, angles = rng.uniform(0.1, 1.0, count), np.radians(rng.uniform(2.0, 70.0, (2, count)))
    own = np.column_stack([gap, value, np.ones(count), angles[0], k2, angles[1]])
    kinds, none = np.full(count, float(SPHERE)), np.zeros(count)
    told = (gap, value, np.ones(count), kinds, np.ones(count), none, angles[0], kinds, 1.0 / k2, none, angles[1])
    states, statuses = plainly(monkeypatch, lambda: batch.answer(asked, control, own))
    questions = np.column_stack(told)
    found, found_statuses = plainly(
        monkeypatch, lambda: shape_rows.answer(asked, control, questions, (NO_PROFILE, NO_PROFILE))
    )
    np.testing.assert_array_equal(statuses, found_statuses, err_msg=f"seed {seed}")
    assert np.sum(statuses == batch.FOUND) > 6
    for field in set(State._fields) - {"stiffness"}:  # infinite at rupture
        i = State._fields.index(field)
        scale = np.max(np.abs(np.nan_to_num(states[:, i])), initial=0.0)
        np.testing.assert_allclose(found[:, i], states[:, i], rtol=1e-9, atol=1e-9 * scale, err_msg=f"{seed} {field}")


def test_what_asks_nothing_of_a_solid_is_one_kernel_for_all():
    assert retold(meridian.measure_arc) is meridian.measure_arc
    assert retold(equations.system_of) is not equations.system_of
    assert retold(newton.newton_to) is retold(newton.newton_to)


def test_what_is_tried_gives_something_else_where_there_is_no_answer():
    root = tried(math.sqrt, math.nan)
    assert root(4.0) == 2.0
    assert math.isnan(root(-1.0))
    with pytest.raises(TypeError):
        root("4")


def test_the_rows_of_a_profile_are_its_spline_with_its_integrals():
    from scipy.integrate import quad
    from scipy.interpolate import CubicSpline

    knots = np.array([0.0, 0.3, 0.5, 1.1, 1.6, 2.0])
    spline = CubicSpline(knots, 0.4 * knots**2 + 0.1 * knots**4)
    solid = surface_of(DRAWN, 0.0, 2.0, 0.0, 0.3, drawn.profile_of(knots, spline.c))
    assert drawn.reach_of(solid) == 4.0
    for at in (0.0, 0.2, 0.5, 0.9, 1.99, 2.0):
        rise, slope = drawn.rise_of_drawn(solid, 2.0 * at), float(spline(at, 1))
        assert rise.height == pytest.approx(2.0 * float(spline(at)), rel=1e-13, abs=1e-15)
        assert rise.sin_slope / rise.cos_slope == pytest.approx(slope, rel=1e-13, abs=1e-15)
        assert rise.lift == pytest.approx(2.0 * at * slope, rel=1e-13, abs=1e-15)
        assert rise.bend * (1.0 + slope**2) == pytest.approx(at * float(spline(at, 2)), rel=1e-13, abs=1e-15)
        inside = [knot for knot in knots if knot < at] or [0.0]
        cap, _ = quad(lambda y: y * y * float(spline(y, 1)), 0.0, at, points=inside, epsabs=1e-13, limit=200)
        area, _ = quad(lambda y: y * math.hypot(1.0, float(spline(y, 1))), 0.0, at, points=inside, epsabs=1e-13)
        assert rise.cap == pytest.approx(8.0 * cap, rel=1e-12, abs=1e-14)
        assert drawn.wetted_of_drawn(solid, 2.0 * at) == pytest.approx(8.0 * math.pi * area, rel=1e-12, abs=1e-14)
