"""The parts of the exact solver, each against another way to compute the same.

An arc of constant mean curvature is summed up anew here from its formula, ζ(s) = Y e^{iφ}, by quadrature on pieces
that are graded towards its necks. Real and imaginary part are written as analytic functions of the four numbers, so
that a step into the complex plane gives every rate without cancellation. That reference is itself held to mpmath and to
the differential equation.
"""

import json
import math
import warnings
from pathlib import Path
from typing import NamedTuple

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import pendular as pl
from pendular.exact import batch
from pendular.exact.algebra import Four, determinant, dot, largest, minors, normal, solve4
from pendular.exact.batch import FOUND, LOWER_END, RUPTURE, STABLE, answer
from pendular.exact.clearance import is_clear, opening_of
from pendular.exact.equations import (
    SUCTION,
    VOLUME,
    Held,
    curvature_of,
    curvature_rates,
    force_of,
    force_rates,
    held_row,
    system_at,
)
from pendular.exact.follow import FOLDS
from pendular.exact.guess import rupture_at_suction, rupture_at_volume
from pendular.exact.meridian import ends_of, extreme_phases, lay_meridian, measure_arc, panels_of, tensor_of
from pendular.exact.solids import solid_of
from pendular.exact.state import State, describe
from pendular.ground.rows import by_machine_code

UNIT = pl.Liquid(surface_tension=1.0)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)
COMPLEX_STEP = 1e-30
SEED = 20261


# -- the reference ---------------------------------------------------------------------------------------------------


def parts_at(z, share):
    """Re ζ and Im ζ, analytic in the four numbers, which may be complex."""
    radius, length, turn = np.exp(z[0]), np.exp(z[2]), z[3] * share
    half = 0.5 * turn
    square = half * half
    is_small = np.abs(half) < 0.05
    series = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0)))
    ratio = np.where(is_small, series, np.sin(half) / np.where(is_small, 1.0, half))
    run = length * share * ratio
    return (
        radius * np.cos(z[1] + turn) - run * np.sin(half),
        radius * np.sin(z[1] + turn) + run * np.cos(half),
    )


def radius_at(z, share):
    return np.hypot(*parts_at(np.asarray(z, float), share))


def graded_pieces(z):
    """Ends of pieces that become shorter towards each place where the radius is least."""
    grid = np.linspace(-1.0, 1.0, 4001)
    radius = radius_at(z, grid)
    least = [i for i in range(1, 4000) if radius[i] <= min(radius[i - 1], radius[i + 1])]
    ends = [np.linspace(-1.0, 1.0, 25)]
    for center in [grid[i] for i in least] + [-1.0, 1.0]:
        away = 2.0 * 0.5 ** np.arange(24)
        ends += [center + away, center - away]
    ends = np.unique(np.concatenate(ends))
    return ends[(ends >= -1.0) & (ends <= 1.0)]


class Sums(NamedTuple):
    """Integrals along an arc; those of magnitudes are what errors are compared with."""

    length: complex
    volume: complex  # over π
    across: complex
    axial: complex
    way: float
    content: float


def summed(z, like):
    """Integrals along the arc of z, on the pieces that suit the arc of another z."""
    ends = graded_pieces(like)
    share = (0.5 * (ends[1:] + ends[:-1])[:, None] + 0.5 * np.diff(ends)[:, None] * NODES).ravel()
    weight = (0.5 * np.diff(ends)[:, None] * WEIGHTS).ravel() * np.exp(z[2])
    real, imag = parts_at(z, share)
    square = real * real + imag * imag
    radius = np.sqrt(square)
    return Sums(
        np.sum(weight * real / radius),
        np.sum(weight * real * radius),
        math.pi * np.sum(weight * real * real / radius),
        2.0 * math.pi * np.sum(weight * imag * imag / radius),
        float(np.sum(np.abs(weight * real / radius))),
        float(np.sum(np.abs(weight * real * radius))),
    )


def quantities(z, solids, like):
    """All that a meridian and two solids are asked for, in the order of NAMES."""
    sums = summed(z, like)
    values, gap, liquid = [], sums.length, sums.volume
    gaps = []
    for side, (curvature, angle) in zip((-1.0, 1.0), solids, strict=True):
        real, imag = parts_at(z, side)
        radius = np.sqrt(real * real + imag * imag)
        cosine, sine = real / radius, side * imag / radius
        sin_filling = math.cos(angle) * cosine - math.sin(angle) * sine
        cos_filling = math.sin(angle) * cosine + math.cos(angle) * sine
        if curvature > 0.0 and cos_filling.real < -0.5:
            height = (1.0 - cos_filling) / curvature
        else:
            height = curvature * radius**2 / (1.0 + cos_filling)
        gap = gap - height
        gaps.append(gap)
        liquid = liquid - height * (3.0 * radius**2 + height**2) / 6.0
        slope = np.arctan(sine / cosine) if isinstance(z[0], complex) else math.atan2(sine.real, cosine.real)
        values += [curvature * radius - sin_filling, np.log(radius), slope]
    bend = z[3] * np.exp(-z[2])
    radius = np.exp(z[0])
    force = radius * (np.cos(z[1]) + 0.5 * bend * radius)
    return np.array([*values, sums.length, *gaps, liquid, bend, force])


NAMES = ("contact1", "ring1", "slope1", "contact2", "ring2", "slope2", "length", "first_gap", "separation", "volume")
NAMES += ("curvature", "force")


def rates_of(z, solids):
    """Rates of all quantities in the four numbers, by complex steps."""
    columns = []
    for i in range(4):
        step = np.asarray(z, complex)
        step[i] += 1j * COMPLEX_STEP
        columns.append(quantities(list(step), solids, z).imag / COMPLEX_STEP)
    return dict(zip(NAMES, np.array(columns).T, strict=True))


# -- arcs ------------------------------------------------------------------------------------------------------------


class Case(NamedTuple):
    """An arc, and two solids that it meets at their contact angles."""

    z: Four
    solids: tuple  # curvature and contact angle of each

    def held(self, control=VOLUME, value=1.0):
        """The solids with something held."""
        return Held(*(solid_of(*solid) for solid in self.solids), control, value)


def solid_at(rng, z, side):
    """A sphere or a plane that an end of an arc meets; None where it would lie on the wrong side."""
    real, imag = (float(part) for part in parts_at(np.asarray(z), side))
    slope = math.atan2(side * imag, real)
    if rng.random() < 0.15 and abs(slope) < math.pi / 2.0:
        return 0.0, math.pi / 2.0 - slope
    filling = rng.uniform(0.01, 3.0)
    angle = math.pi / 2.0 - slope - filling
    return (math.sin(filling) / math.hypot(real, imag), angle) if 0.0 <= angle <= math.pi else None


KINDS = ("usual", "straight", "wound", "thin", "overhang")


def draw_arc(rng, kind):
    slope, turn = rng.uniform(-1.2, 1.2), rng.uniform(-1.3, 1.3)
    radius, length = math.exp(rng.uniform(-2.0, 1.0)), math.exp(rng.uniform(-2.0, 1.0))
    if kind == "straight":
        turn = float(rng.choice([0.0, 1e-300, 1e-12, -1e-9, 1e-7, -1e-4]))
    if kind == "wound":
        turn = float(rng.choice([-1.0, 1.0])) * rng.uniform(1.3, 5.5)
    if kind == "thin":
        radius, length, slope = 1e-3, rng.uniform(0.5, 1.0), rng.uniform(-0.5, 0.5)
    if kind == "overhang":
        slope = float(rng.choice([-1.0, 1.0])) * rng.uniform(1.6, 2.5)
    return Four(math.log(radius), slope, math.log(length), turn)


def draw_case(rng, kind):
    while True:
        z = draw_arc(rng, kind)
        radius = radius_at(z, np.linspace(-1.0, 1.0, 2001))
        if radius.min() < 1e-3 * radius.max() * (0.3 if kind == "thin" else 10.0):
            continue
        solids = solid_at(rng, z, -1.0), solid_at(rng, z, 1.0)
        if None not in solids:
            return Case(z, solids)


def cases(kind, count, seed=SEED):
    print(f"seed {seed}, {kind}")
    rng = np.random.default_rng([seed, KINDS.index(kind)])
    return [draw_case(rng, kind) for _ in range(count)]


# -- the reference is right -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_the_reference_is_that_of_mpmath(kind):
    with mpmath.workdps(30):
        for case in cases(kind, 2):
            log_radius, slope, log_length, turn = (mpmath.mpf(x) for x in case.z)
            start, length = mpmath.exp(log_radius + 1j * slope), mpmath.exp(log_length)

            def zeta(f, start=start, length=length, turn=turn):
                rotor = mpmath.expj(turn * f)
                return start * rotor + length * (1j * f if turn * f == 0 else (rotor - 1) / turn)

            pieces = [mpmath.mpf(float(x)) for x in graded_pieces(case.z)[::4]]
            pieces = [mpmath.mpf(-1), *[x for x in pieces if -1 < x < 1], mpmath.mpf(1)]
            sums = summed(np.array(case.z), case.z)
            for value, integrand in (
                (sums.length, lambda v: v.real / abs(v)),
                (sums.volume, lambda v: v.real * abs(v)),
                (sums.across, lambda v: mpmath.pi * v.real**2 / abs(v)),
                (sums.axial, lambda v: 2 * mpmath.pi * v.imag**2 / abs(v)),
            ):
                exact = length * mpmath.quad(
                    lambda f, g=integrand: g(zeta(f)), pieces, method="gauss-legendre", maxdegree=4
                )
                assert abs(float(exact) - value) < 3e-14 * (sums.way + sums.content + abs(sums.axial))


@pytest.mark.parametrize("kind", KINDS)
def test_the_arc_solves_the_young_laplace_equation(kind):
    for case in cases(kind, 6):
        z, count = case.z, 9
        bend, half = curvature_of(z), math.exp(z.log_length)
        first, second = ends_of(z)
        slope = -math.atan2(first.sin_slope, first.cos_slope)

        def rates(_, u, bend=bend):
            cosine = math.cos(u[1])
            return math.sin(u[1]), bend + cosine / u[0], cosine, u[0] ** 2 * cosine

        at = np.linspace(0.0, 2.0 * half, count)
        solution = solve_ivp(
            rates, (0.0, 2.0 * half), (first.radius, slope, 0.0, 0.0), "DOP853", at, rtol=1e-12, atol=1e-14
        )
        radius, slopes, place, volume = solution.y
        laid_place, laid_radius = np.empty(4001), np.empty(4001)
        lay_meridian(z, laid_place, laid_radius)
        tolerance = 1e-6 if kind == "thin" else 1e-8  # of the integrator: it cannot hold more through a thin neck
        scale = max(radius.max(), 2.0 * half)
        np.testing.assert_allclose(laid_radius[::500], radius, rtol=0.0, atol=tolerance * scale)
        np.testing.assert_allclose(laid_place[::500], place, rtol=0.0, atol=tolerance * scale)
        assert second.radius == pytest.approx(radius[-1], abs=tolerance * scale)
        turned = math.atan2(second.sin_slope, second.cos_slope)
        assert abs(math.remainder(turned - slopes[-1], 2.0 * math.pi)) < 1e3 * tolerance
        length, liquid = measure_arc(z, True, True)
        assert length.value == pytest.approx(place[-1], abs=tolerance * scale)
        assert liquid.value == pytest.approx(volume[-1], abs=tolerance * scale**3)


# -- sums along the arc ----------------------------------------------------------------------------------------------


# the worst of four seeds are 4e-13 and 3e-8, of arcs that turn by 1.3 either way past a thin place
@pytest.mark.parametrize(("fine", "within"), [(True, 5e-13), (False, 5e-8)])
@pytest.mark.parametrize("kind", KINDS)
def test_length_and_volume(kind, fine, within):
    worst = 0.0
    for case in cases(kind, 100):
        sums = summed(np.array(case.z), case.z)
        length, liquid = measure_arc(case.z, fine, True)
        worst = max(worst, abs(length.value - sums.length) / sums.way, abs(liquid.value - sums.volume) / sums.content)
        alone, nothing = measure_arc(case.z, fine, False)
        assert alone.value == pytest.approx(length.value, rel=1e-13, abs=1e-14 * sums.way)
        np.testing.assert_allclose(alone.rates, length.rates, rtol=1e-11, atol=1e-11 * np.abs(length.rates).max())
        assert nothing.value == 0.0
    print(f"{kind}: {worst:.1e}")
    assert worst < within


@pytest.mark.parametrize("kind", KINDS)
def test_tensor(kind):
    for case in cases(kind, 50):
        sums = summed(np.array(case.z), case.z)
        across, axial = tensor_of(case.z)
        scale = 2.0 * sums.across + sums.axial
        assert across == pytest.approx(sums.across, rel=0.0, abs=1e-12 * scale)
        assert axial == pytest.approx(sums.axial, rel=0.0, abs=1e-12 * scale)


def test_a_long_arc_is_cut_into_panels():
    counts = [panels_of(case.z.turn) for case in cases("wound", 50)]
    assert min(counts) == 2
    assert max(counts) > 3


@pytest.mark.parametrize("kind", KINDS)
def test_necks_and_bulges_are_counted(kind):
    for case in cases(kind, 100):
        share = np.linspace(-1.0, 1.0, 20001)
        change = np.diff(radius_at(case.z, share))
        necks = int(np.sum((change[:-1] < 0.0) & (change[1:] > 0.0)))
        bulges = int(np.sum((change[:-1] > 0.0) & (change[1:] < 0.0)))
        assert extreme_phases(case.z) == (necks, bulges)


# -- rates -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("fine", "within"), [(True, 1e-11), (False, 1e-7)])
@pytest.mark.parametrize("kind", KINDS)
def test_rates(kind, fine, within):
    worst = dict.fromkeys(NAMES, 0.0)
    for case in cases(kind, 60):
        expected = rates_of(case.z, case.solids)
        system = system_at(case.z, case.held(), fine, True)
        got = {name: getattr(system, name).rates for name in ("contact1", "contact2", "separation", "volume")}
        got |= {name: getattr(system, name).rates for name in ("first_gap", "length")}
        got |= {"ring1": system.first.growth, "ring2": system.second.growth}
        got |= {"slope1": system.first.tilt, "slope2": system.second.tilt}
        got |= {"force": force_rates(case.z)}
        got |= {"curvature": np.array(curvature_rates(case.z)) * math.exp(-case.z.log_length)}
        assert set(got) == set(NAMES)
        for name in NAMES:
            scale = np.abs(expected[name]).max() + (1e-300 if name == "curvature" else 1e-12)
            worst[name] = max(worst[name], np.abs(np.array(got[name]) - expected[name]).max() / scale)
    print(kind, {name: f"{value:.0e}" for name, value in worst.items()})
    assert max(worst.values()) < within


@pytest.mark.parametrize("kind", KINDS)
def test_values(kind):
    for case in cases(kind, 60):
        expected = dict(zip(NAMES, quantities(np.array(case.z), case.solids, case.z), strict=True))
        system = system_at(case.z, case.held(), True, True)
        sums = summed(np.array(case.z), case.z)
        heights = abs(expected["length"] - expected["separation"])
        size = max(sums.way, heights, system.first.radius, system.second.radius)
        assert abs(system.contact1.value) < 1e-12  # the solids were put there
        assert abs(system.contact2.value) < 1e-12
        for name in ("length", "first_gap", "separation"):
            assert getattr(system, name).value == pytest.approx(expected[name], rel=0.0, abs=1e-12 * size)
        assert system.volume.value == pytest.approx(expected["volume"], rel=0.0, abs=1e-12 * size**3)
        assert math.log(system.first.radius) == pytest.approx(expected["ring1"], abs=1e-13)
        assert math.log(system.second.radius) == pytest.approx(expected["ring2"], abs=1e-13)
        assert force_of(case.z) == pytest.approx(expected["force"], rel=1e-13, abs=1e-14)
        assert curvature_of(case.z) == pytest.approx(expected["curvature"], rel=1e-14)


@pytest.mark.parametrize("control", [SUCTION, VOLUME])
def test_the_held_row(control):
    for case in cases("usual", 30):
        bend = curvature_of(case.z)
        system = system_at(case.z, case.held(), True, True)
        value = 1.1 * bend if control == SUCTION else 0.9 * abs(system.volume.value) + 1e-3
        held = case.held(control, value)
        row = held_row(case.z, system, held)
        half = math.exp(case.z.log_length)
        miss = half * (bend - value) if control == SUCTION else system.volume.value / value - 1.0
        assert row.value == pytest.approx(miss, rel=1e-12, abs=1e-14)
        for i in range(4):
            ahead, back = (Four(*(np.array(case.z) + sign * 1e-6 * np.eye(4)[i])) for sign in (1.0, -1.0))
            values = [held_row(z, system_at(z, held, True, True), held).value for z in (ahead, back)]
            assert row.rates[i] == pytest.approx((values[0] - values[1]) / 2e-6, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("kind", KINDS)
def test_maxwells_relation(kind):
    # dΩ = F dD + V dH along all bridges of two solids
    for case in cases(kind, 60):
        system = system_at(case.z, case.held(), True, True)
        contacts = np.array([system.contact1.rates, system.contact2.rates])
        force, separation = np.array(force_rates(case.z)), np.array(system.separation.rates)
        volume = math.pi * np.array(system.volume.rates)
        bend = np.array(curvature_rates(case.z)) * math.exp(-case.z.log_length)

        def det(a, b, contacts=contacts):
            return np.linalg.det(np.array([*contacts, a, b]))

        by_force = det(volume, bend) / det(force, bend)
        by_bend = det(separation, force) / det(bend, force)
        rows = [row / np.linalg.norm(row) for row in (*contacts, force, bend)]
        if abs(np.linalg.det(rows)) > 1e-5:
            assert by_force == pytest.approx(-2.0 * math.pi * by_bend, rel=1e-7)


# -- algebra ---------------------------------------------------------------------------------------------------------


def test_algebra():
    rng = np.random.default_rng(3)
    for _ in range(200):
        rows, right = rng.normal(size=(4, 4)), rng.normal(size=4)
        a, b, c, d = (Four(*map(float, row)) for row in rows)
        size = np.linalg.det(rows)
        assert determinant(a, b, c, d) == pytest.approx(size, rel=1e-11, abs=1e-13)
        x, by_solving = solve4(a, b, c, d, *map(float, right))
        assert by_solving == pytest.approx(size, rel=1e-11, abs=1e-13)
        np.testing.assert_allclose(x, np.linalg.solve(rows, right), rtol=1e-10, atol=1e-11 / abs(size))
        n = normal(minors(a, b), c)
        assert dot(n, d) == pytest.approx(size, rel=1e-11, abs=1e-13)
        np.testing.assert_allclose(rows[:3] @ np.array(n), 0.0, atol=1e-12 * np.linalg.norm(n))
        assert largest(a) == np.abs(rows[0]).max()
    assert math.isnan(largest(Four(1.0, math.nan, 2.0, 3.0)))


# -- guesses ---------------------------------------------------------------------------------------------------------


def random_rows(rng, count, control, most_angle, values, most_ratio):
    """Questions at contact: (D, H or V, k1, θ1, k2, θ2), the smaller radius being 1, solids that are wetted."""
    rows = []
    while len(rows) < count:
        second = 0.0 if rng.random() < 0.15 else 10.0 ** -rng.uniform(0.0, most_ratio)
        mean = 2.0 / (1.0 + second)
        first_angle, second_angle = rng.uniform(0.0, most_angle, 2)
        value = 10.0 ** rng.uniform(*values) * (mean**3 if control == VOLUME else 1.0 / mean)
        if math.cos(first_angle) + math.cos(second_angle) > 0.05:
            rows.append((0.0, value, 1.0, first_angle, second, second_angle))
    return np.array(rows)


def shares_of_rupture(control, values, guess):
    """Guesses of rupture over the exact one, for wetted solids."""
    rows = random_rows(np.random.default_rng(SEED), 300, control, math.pi / 2.0, values, 2.0)
    states, statuses = answer(RUPTURE, control, rows, FOLDS)
    assert (statuses == FOUND).all()
    guesses = []
    for row in rows:
        task = batch.task_of(row, control)
        solids = solid_of(task.curvature1, task.angle1), solid_of(task.curvature2, task.angle2)
        guesses.append(guess(Held(*solids, control, task.value)))
    shares = np.array(guesses) / states[:, 0]
    print(f"seed {SEED}: {shares.min():.3f} to {shares.max():.3f}")
    return shares


def test_the_guess_of_rupture_at_a_volume():
    shares = shares_of_rupture(VOLUME, (-9.0, 0.0), rupture_at_volume)
    assert shares.min() > 0.7
    assert shares.max() < 1.4


def test_the_guess_of_rupture_at_a_suction():
    shares = shares_of_rupture(SUCTION, (0.0, 6.0), rupture_at_suction)
    assert shares.min() > 0.5
    assert shares.max() < 2.0
    shares = shares_of_rupture(SUCTION, (4.0, 6.0), rupture_at_suction)  # a torus, in the end
    assert shares.min() > 0.9
    assert shares.max() < 1.1


# -- nearly equal solids ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("degrees", "volume"), [(40.0, 8e-3), (35.0, 1e-5), (60.0, 0.05), (82.7486, 0.0186287), (25.0, 1.0), (10.0, 1e-3)]
)
def test_rupture_of_nearly_equal_solids_tends_to_that_of_equal_ones(degrees, volume):
    angle = math.radians(degrees)
    equal = pl.rupture(pl.Pair(1.0, angle), volume=volume, liquid=UNIT).separation
    differences = 10.0 ** np.arange(-11.0, -1.0)
    for pair in (
        pl.Pair((1.0, 1.0 + differences), angle),
        pl.Pair(1.0, (angle, angle * (1.0 - differences))),
    ):
        ends = pl.rupture(pair, volume=volume, liquid=UNIT)
        assert ends.exists.all()
        lost = np.abs(ends.separation / equal - 1.0)
        assert (lost < 2.0 * differences ** (2.0 / 3.0) + 1e-10).all(), lost
        assert (np.diff(lost) > -1e-9).all(), lost
    if degrees == 40.0:
        assert equal == pytest.approx(0.27072647, abs=1e-8)


def test_rupture_of_solids_a_rounding_apart():
    angle = math.radians(40.0)
    for volume in (1e-9, 1e-5, 8e-3):
        equal = pl.rupture(pl.Pair(1.0, angle), volume=volume, liquid=UNIT).separation
        for second in (1.0 + 2e-16, 1.0 + 1e-15, 1.0 + 1e-14, 1.0 + 1e-13, 1.0 + 1e-12):
            end = pl.rupture(pl.Pair((1.0, second), angle), volume=volume, liquid=UNIT)
            assert end.separation == pytest.approx(equal, rel=1e-8)


# -- clearance -------------------------------------------------------------------------------------------------------


def depths_in_solids(drawn):
    """How deep arcs enter a solid, over their length: from points laid along them and the solids as sets of points."""
    arcs = [(math.exp(z.log_radius), z.slope, math.exp(z.log_length), curvature_of(z)) for z, _ in drawn]
    with by_machine_code():
        laid = batch.lay(np.array(arcs), 3001)
    return [depth_in_solids(*one) for one in zip(drawn, *laid, strict=True)]


def depth_in_solids(case, place, radius):
    system = system_at(case.z, case.held(), True, True)
    deepest = -math.inf
    heights = system.length.value - system.first_gap.value, system.first_gap.value - system.separation.value
    for (curvature, _), along, height in (
        (case.solids[0], place - heights[0], heights[0]),
        (case.solids[1], system.length.value - place - heights[1], heights[1]),
    ):
        center = 0.0 if curvature == 0.0 else 1.0 / curvature
        depth = -along if curvature == 0.0 else center - np.hypot(along + center, radius)
        deepest = max(deepest, depth[1:-1].max())
        assert height >= 0.0
    return deepest / math.exp(case.z.log_length)


@pytest.mark.parametrize("kind", KINDS)
def test_a_meniscus_that_enters_a_solid_is_seen(kind):
    seen = {True: 0, False: 0}
    drawn = []
    for case in cases(kind, 400):
        held = case.held()
        system = system_at(case.z, held, True, True)
        overlap = -system.separation.value * max(curvature for curvature, _ in case.solids)
        if opening_of(case.z, system, held) > 0.0 and not overlap > 0.5:
            drawn.append(case)
    for case, depth in zip(drawn, depths_in_solids(drawn), strict=True):
        if 1e-10 < depth < 1e-4:
            continue  # a touch
        held = case.held()
        clear = is_clear(case.z, system_at(case.z, held, True, True), held)
        assert clear == (depth <= 1e-10), (case, depth)
        seen[bool(clear)] += 1
    print(seen)
    assert seen[True] > {"overhang": 1}.get(kind, 50)
    assert seen[False] > {"wound": 10, "overhang": 10}.get(kind, -1)


def test_a_solution_that_has_entered_a_solid_is_no_bridge():
    # a curve of solutions goes on where a meniscus touches a solid, into it
    entered = 0
    for kind in ("wound", "overhang"):
        drawn = cases(kind, 100)
        for case, depth in zip(drawn, depths_in_solids(drawn), strict=True):
            held = case.held()
            system = system_at(case.z, held, True, True)
            if depth > 1e-3 and min(opening_of(case.z, system, held), system.separation.value) > 0.0:
                assert not describe(case.z, held, False).is_bridge
                entered += 1
    assert entered > 3


def test_known_bridges_are_clear():
    rows = json.loads((Path(__file__).parent / "data" / "oracle_bridges.json").read_text())
    checked = 0
    for row in [row for row in rows if "negative_volume" not in row["tags"]][::3]:
        radii = tuple(math.inf if row[name] is None else float(row[name]) for name in ("R1", "R2"))
        angles = tuple(float(row[name]) for name in ("theta1", "theta2"))
        asked = {row["control"]: float(row["H" if row["control"] == "suction" else "V"]), "branch": row["branch"]}
        bridge = pl.bridge(pl.Pair(radii, angles), float(row["gap"]), **asked, limit="fold", liquid=UNIT)
        radius, slope, half = map(float, bridge._meridian)
        z = Four(math.log(radius), slope, math.log(half), float(bridge.suction) * half)
        held = Case(z, tuple((1.0 / r, angle) for r, angle in zip(radii, angles, strict=True))).held()
        system = system_at(z, held, True, True)
        assert opening_of(z, system, held) > 0.0
        assert is_clear(z, system, held)
        checked += 1
    assert checked > 150


# -- extreme questions -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("control", "values", "most_angle", "most_ratio"),
    [
        (SUCTION, (-12.0, 12.0), math.pi, 9.0),
        (VOLUME, (-24.0, 1.0), math.pi, 6.0),
        (SUCTION, (-12.0, 12.0), math.pi / 2.0, 9.0),
        (VOLUME, (-16.0, 2.0), math.pi / 2.0, 9.0),
    ],
)
def test_extreme_questions_are_answered(control, values, most_angle, most_ratio):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    rows = random_rows(rng, 300, control, most_angle, values, most_ratio)
    ends, statuses = answer(RUPTURE, control, rows)
    assert (statuses == FOUND).all(), rows[statuses != FOUND]
    lowest, _ = answer(LOWER_END, control, rows)
    low = np.where(np.isfinite(lowest[:, 0]), lowest[:, 0], 0.0)
    rows[:, 0] = low + rng.uniform(0.01, 0.99, len(rows)) * (ends[:, 0] - low)
    states, statuses = answer(STABLE, control, rows)
    assert (statuses == FOUND).all(), rows[statuses != FOUND]
    state = dict(zip(State._fields, states.T, strict=True))
    held = state["volume"] if control == VOLUME else state["curvature"]
    np.testing.assert_allclose(held, rows[:, 1], rtol=1e-12)
    assert (np.abs(state["separation"] - rows[:, 0]) < 1e-12 * np.maximum(rows[:, 0], state["half_length"])).all()
    assert (state["unstable_directions"] == 0.0).all()


def test_a_sphere_as_flat_as_a_plane():
    gaps = np.linspace(0.0, 0.99, 100)
    for volume in 10.0 ** np.arange(-23.0, -15.0):
        held = {"volume": volume, "liquid": UNIT}
        plane, sphere = (pl.Pair((1.0, second), (1.3, 1.5)) for second in (math.inf, 1e9))
        end = pl.rupture(plane, **held)
        assert pl.rupture(sphere, **held).separation == pytest.approx(end.separation, rel=1e-6)
        bridges = pl.bridge(sphere, gaps * end.separation, **held)
        assert bridges.exists.all()
        np.testing.assert_allclose(bridges.force, pl.bridge(plane, gaps * end.separation, **held).force, rtol=1e-5)


@pytest.mark.parametrize("volume", [200.0, 300.0, 358.557088, 700.0])
def test_rupture_of_a_large_drop_on_a_hydrophobic_plane_is_found_or_said_to_be_lost(volume):
    # the bridge without force is a piece of a sphere, and stable: the drop that swallows most of the wetted sphere
    angles = (0.292292382, 2.68509419)

    def drop(radius):
        """The drop of a radius: gap, and volume without the lens that the sphere takes."""
        center = math.sqrt(radius**2 + 1.0 - 2.0 * radius * math.cos(angles[0]))
        lens = math.pi * (radius + 1.0 - center) ** 2 / (12.0 * center)
        lens *= center**2 + 2.0 * center * (radius + 1.0) - 3.0 * (radius - 1.0) ** 2
        cap = radius * (1.0 + math.cos(angles[1]))
        whole = 4.0 / 3.0 * math.pi * radius**3 - math.pi * cap**2 * (3.0 * radius - cap) / 3.0
        return center - radius * math.cos(angles[1]) - 1.0, whole - lens

    radius = brentq(lambda r: drop(r)[1] - volume, 1.0, 10.0)
    gap = drop(radius)[0]
    pair, held = pl.Pair((1.0, math.inf), angles), {"volume": volume, "liquid": UNIT}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        bridge, end = pl.bridge(pair, gap, **held), pl.rupture(pair, **held)
    lost = sum(issubclass(warning.category, pl.ConvergenceWarning) for warning in caught)
    found = int(bridge.exists) + int(end.exists)
    assert found + lost == 2
    if bridge.exists:
        assert bridge.unstable_directions == 0
        assert bridge.suction == pytest.approx(-2.0 / radius, rel=1e-9)
        assert abs(bridge.force) < 1e-9
    if end.exists:
        assert end.separation > gap
