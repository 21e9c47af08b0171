"""The laws at constant suction: coefficients, the torus and the expansion behind them, measured error, limits."""

import math
from itertools import combinations

import numpy as np
import pytest

from law_samples import EQUAL, SEED, assert_close, assert_error, by_name, kappas, sample
from oracles import laws_mpmath as oracle
from oracles import young_laplace
from oracles.young_laplace import Solid
from pendular.laws import asymptotic, asymptotic_rupture, laws, toroidal2020, zhao2020

FITS_AND_THEORIES = [laws[name] for name in ("zhao2020", "toroidal2020", "asymptotic", "pendular2026")]
RUPTURE = [*FITS_AND_THEORIES, asymptotic_rupture.LAW]

# Bridges at their fold and at contact, equal spheres, 17 digits computed independently: (H*, degrees) -> D*, λ*.
EXACT_RUPTURE = {
    (1.0, 0): 0.28108895922166809,
    (10.0, 0): 0.091566163224323188,
    (100.0, 0): 0.014589479430623081,
    (1e4, 0): 1.8815435545739513e-4,
    (1e6, 0): 1.9744630940771013e-6,
    (1e12, 0): 1.9997446233566393e-12,
    (1.0, 20): 0.24385112514207946,
    (10.0, 20): 0.082466023241017988,
    (100.0, 20): 0.013469263362121307,
    (1e4, 20): 1.7623489647918132e-4,
    (1e6, 20): 1.8541493919368723e-6,
    (1e12, 20): 1.879132873045003e-12,
    (1.0, 40): 0.16082637342725778,
    (10.0, 40): 0.060055550938462679,
    (100.0, 40): 0.010472836652100414,
    (1e4, 40): 1.4243084512151321e-4,
    (1e6, 40): 1.5088344011891236e-6,
    (1e12, 40): 1.531856324881544e-12,
    (10.0, 60): 0.031693557473770346,
    (100.0, 60): 0.0062578096188590884,
    (1e4, 60): 9.1507119782280245e-5,
    (1e6, 60): 9.816542829147685e-7,
}
EXACT_CONTACT = {
    (1.0, 0): 0.73870711160100338,
    (10.0, 0): 0.86040139506725039,
    (100.0, 0): 0.94802699144065851,
    (1e4, 0): 0.9944811078617204,
    (1.0, 20): 0.68763586022137191,
    (10.0, 20): 0.80133164138529715,
    (100.0, 20): 0.88739965384751883,
    (1e4, 20): 0.93410362205599548,
    (1.0, 40): 0.549727347270494,
    (10.0, 40): 0.6389849767854874,
    (100.0, 40): 0.71594653193731393,
    (1e4, 40): 0.76058106065885496,
}
# Unlike solids at their fold: R2/R1, angles in degrees, then H, D and λ for R1 = 1.
EXACT_PAIRS = [
    (2.0, 0, 0, 7.5, 0.12236288870946885, 0.22964535713926663),
    (8.0, 20, 20, 56.25, 0.02395970236398704, 0.15576391368381974),
    (math.inf, 0, 0, 5.0, 0.18698186124951121, 0.35489576380630803),
    (math.inf, 0, 40, 50.0, 0.025019621085445692, 0.1694164533541706),
    (1.0, 10, 70, 100.0, 0.0090390393656825296, 0.069735662100919892),
]

# Measured errors of the laws in per cent, as quoted in the documentation.
RUPTURE_ERROR = {
    "toroidal2020": {
        (10.0, 0): "+23",
        (10.0, 20): "+3.5",
        (10.0, 40): "-18",
        (100.0, 0): "+9.2",
        (100.0, 20): "+4.2",
        (100.0, 40): "+0.09",
        (1e4, 0): "+1.63",
        (1e4, 20): "+0.82",
        (1e4, 40): "+0.25",
        (1e6, 0): "+0.34",
        (1e6, 20): "+0.17",
        (1e6, 40): "+0.05",
    },
    "zhao2020": {
        (1.0, 0): "-28.8",
        (1.0, 20): "-25.1",
        (1.0, 40): "-9.9",
        (10.0, 0): "+2.3",
        (10.0, 20): "+2.35",
        (10.0, 40): "+2.3",
        (100.0, 0): "-0.11",
        (100.0, 20): "-0.11",
        (100.0, 40): "-0.035",
        (1e4, 0): "-0.30",
        (1e4, 20): "-0.33",
        (1e4, 40): "-0.38",
        (1e6, 0): "-0.08",
        (1e6, 20): "-0.09",
        (1e6, 40): "-0.10",
    },
    "asymptotic_rupture": {
        (10.0, 0): "-2.84",
        (10.0, 20): "-2.07",
        (10.0, 40): "+2.86",
        (10.0, 60): "+23",
        (100.0, 0): "-0.112",
        (100.0, 20): "-0.096",
        (100.0, 40): "+0.026",
        (100.0, 60): "+0.50",
        (1e4, 0): "-0.0002",
        (1e4, 20): "-0.0002",
        (1e4, 60): "+0.0007",
        (1e6, 0): "0.000000",
        (1e12, 40): "0.0000000000",
    },
    "asymptotic": {
        (10.0, 0): "+1.6",
        (10.0, 20): "+0.91",
        (10.0, 40): "+0.38",
        (100.0, 0): "+0.02",
        (100.0, 20): "+0.01",
        (100.0, 40): "+0.01",
        (1e4, 0): "0.0000",
        (1e6, 40): "0.000000",
        (1e12, 0): "0.0000000000",
        (1e12, 40): "0.0000000000",
    },
}
CONTACT_ERROR = {
    "toroidal2020": {(1e4, 0): "-1.54", (1e4, 20): "-1.56", (1e4, 40): "-1.67"},
    "zhao2020": {
        (1.0, 0): "-0.65",
        (1.0, 40): "-0.65",
        (10.0, 0): "-0.02",
        (10.0, 40): "+0.07",
        (100.0, 0): "-0.19",
        (100.0, 40): "-0.12",
        (1e4, 0): "+0.31",
        (1e4, 40): "+0.37",
    },
    "asymptotic": {
        (10.0, 0): "+0.01",
        (10.0, 20): "+0.01",
        (100.0, 0): "0.0000",
        (100.0, 40): "0.0000",
        (1e4, 20): "0.000000",
    },
}


# --- transcription ----------------------------------------------------------------------------------------------------


def test_zhao2020_force_with_given_rupture_equals_oracle():
    for pair in sample(zhao2020.LAW, 16):
        rupture = 1.1 * asymptotic_rupture.rupture_star(pair[0] + 10.0, pair[1], pair[1], *EQUAL)
        expected = oracle.in_40_digits(oracle.zhao2020_force)(
            0.6 * rupture, pair[0], pair[1], pair[1], *EQUAL, rupture=rupture
        )
        assert_close(zhao2020.force_star_given_rupture(0.6 * rupture, rupture, *pair[:2]), expected, 2e-14)


@pytest.mark.parametrize(
    ("table", "rows"),
    [
        (oracle.EQ_37, (zhao2020.C1, zhao2020.C2)),
        (oracle.EQ_38, (zhao2020.P1, zhao2020.P2, zhao2020.P3)),
        (oracle.EQ_39, (zhao2020.A1, zhao2020.A2, zhao2020.A3)),
        (oracle.EQ_40, (zhao2020.B1, zhao2020.B2, zhao2020.B3)),
    ],
    ids=["Eq. 37", "Eq. 38", "Eq. 39", "Eq. 40"],
)
def test_zhao2020_coefficients(table, rows):
    assert rows == tuple(tuple(map(float, row)) for row in table)


def with_last_digit_changed(number):
    return number[:-1] + str((int(number[-1]) + 1) % 10)


def changed(tables):
    """Every copy of the tables in which one coefficient differs in its last digit."""
    for equation, table in tables.items():
        for i, row in enumerate(table):
            for j, number in enumerate(row):
                new_row = (*row[:j], with_last_digit_changed(number), *row[j + 1 :])
                yield {**tables, equation: (*table[:i], new_row, *table[i + 1 :])}


def test_comparison_sees_the_last_digit_of_every_coefficient():
    point = tuple(map(oracle.mpf, (0.01, 30.0, 0.6, 0.6, 1.0, 1.0)))
    right = oracle.zhao2020_force(*point)
    wrong = [oracle.zhao2020_force(*point, tables=tables) for tables in changed(oracle.ZHAO2020)]
    assert len(wrong) == 33
    assert min(abs(value / right - 1) for value in wrong) > 1e-7


@pytest.fixture
def tori():
    """Random contact radii, suctions and angles of toroidal bridges."""
    rng = np.random.default_rng(SEED)
    suction = 10.0 ** rng.uniform(4.0, 7.0, 20)
    radius = rng.uniform(0.3, 1.0, 20) * np.sqrt(2.0 / suction)
    return np.column_stack([radius, suction, rng.uniform(0.0, 0.7, 20)]).tolist()


def test_torus_equals_oracle(tori):
    for radius, suction, angle in tori:
        for kernel, equation in (
            (toroidal2020.neck_radius, oracle.toroidal2020_neck_radius),
            (toroidal2020.half_gap, oracle.toroidal2020_half_gap),
        ):
            expected = oracle.in_40_digits(lambda y, h, a, f=equation: f(y, h, oracle.tan(a)))(radius, suction, angle)
            # The half gap is a difference of two radii.
            assert kernel(radius, suction, angle) == pytest.approx(float(expected), rel=0.0, abs=1e-15 * radius)


def test_quartic_coefficients_follow_from_clearing_the_root(tori):
    for radius, suction, angle in tori:
        gap = toroidal2020.half_gap(radius, suction, angle)
        expected = oracle.in_40_digits(lambda *x: oracle.toroidal2020_quartic(*x[:2], oracle.tan(x[2])))
        derived = expected(gap, suction, angle)
        scale = toroidal2020.quartic_coefficients(gap, suction, angle)[1] / float(derived[1])
        computed = toroidal2020.quartic_coefficients(gap, suction, angle)
        assert computed == pytest.approx([scale * float(k) for k in derived], rel=1e-11)


def test_quartic_reproduces_the_equation_with_the_root(tori):
    for radius, suction, angle in tori:
        gap = toroidal2020.half_gap(radius, suction, angle)
        roots = np.roots(toroidal2020.quartic_coefficients(gap, suction, angle))
        assert np.abs(roots / radius - 1.0).min() < 1e-10


def test_trigonometric_root_is_the_largest_of_the_cubic(tori):
    for radius, suction, angle in tori:
        gap = toroidal2020.half_gap(radius, suction, angle)
        roots = np.roots(toroidal2020.quartic_coefficients(gap, suction, angle)[1:])
        assert toroidal2020.contact_radius(gap, suction, angle) == pytest.approx(roots.real.max(), rel=1e-11)
        assert np.isreal(roots).all()


@pytest.mark.parametrize("half_gap", [0.005, 0.02])
def test_discriminant_is_the_product_of_root_differences(half_gap):
    leading, *_ = coefficients = toroidal2020.quartic_coefficients(half_gap, 40.0, 0.5)
    differences = [a - b for a, b in combinations(np.roots(coefficients), 2)]
    expected = leading**6 * np.prod(differences) ** 2
    assert toroidal2020.quartic_discriminant(half_gap, 40.0, 0.5) == pytest.approx(expected.real, rel=1e-10)


@pytest.mark.parametrize("angle", [0.0, 0.35, 0.7])
def test_discriminant_vanishes_at_the_largest_half_gap(angle):
    radii = np.linspace(1e-4, 0.02, 20001)
    largest = max(toroidal2020.half_gap(radius, 1e4, angle) for radius in radii.tolist())
    below, beyond = (toroidal2020.quartic_discriminant(f * largest, 1e4, angle) for f in (1.0 - 1e-6, 1.0 + 1e-6))
    assert below > 0.0 > beyond


@pytest.mark.parametrize("angle", [0.0, 0.35, 0.7])
def test_unexpanded_beta_is_the_limit_of_the_discriminant(angle):
    rupture = toroidal2020.half_gap_at_rupture(toroidal2020.beta_torus(angle), 1e9, angle)
    assert toroidal2020.quartic_discriminant((1.0 - 1e-5) * rupture, 1e9, angle) > 0.0
    assert toroidal2020.quartic_discriminant((1.0 + 1e-5) * rupture, 1e9, angle) < 0.0


def test_beta_series_is_the_expansion_of_the_torus():
    for angle in (1e-3, 1e-2):
        difference = toroidal2020.beta_torus(angle) - toroidal2020.beta_series(angle)
        assert abs(difference) < 2.0 * angle**3


@pytest.mark.parametrize(("degrees", "third"), [(0, 0.75), (20, 0.99614), (40, 1.65087), (60, 2.41974), (80, 2.92968)])
def test_third_coefficient_of_equal_spheres(degrees, third):
    angle, suction = math.radians(degrees), 1e3
    leading = 2.0 * math.cos(angle) * (1.0 - (asymptotic_rupture.beta_exact(angle) / suction) ** (1.0 / 3.0))
    product = suction * asymptotic_rupture.rupture_star(suction, angle, angle, *EQUAL)
    assert suction * (product - leading) == pytest.approx(third, abs=6e-6)


# --- measured error ---------------------------------------------------------------------------------------------------


def cases(errors):
    return [(name, *key, quoted) for name, table in errors.items() for key, quoted in table.items()]


@pytest.mark.parametrize(("name", "suction", "degrees", "quoted"), cases(RUPTURE_ERROR))
def test_error_of_rupture_is_as_quoted(name, suction, degrees, quoted):
    angle = math.radians(degrees)
    computed = laws[name].rupture_star(suction, angle, angle, *EQUAL)
    assert_error(computed, EXACT_RUPTURE[suction, degrees], quoted)


@pytest.mark.parametrize(("name", "suction", "degrees", "quoted"), cases(CONTACT_ERROR))
def test_error_of_contact_force_is_as_quoted(name, suction, degrees, quoted):
    angle = math.radians(degrees)
    computed = laws[name].force_star(0.0, suction, angle, angle, *EQUAL)
    assert_error(computed, EXACT_CONTACT[suction, degrees], quoted)


@pytest.mark.parametrize(("ratio", "degrees1", "degrees2", "suction", "separation", "force"), EXACT_PAIRS)
def test_expansion_holds_for_unlike_solids(ratio, degrees1, degrees2, suction, separation, force):
    derjaguin = 2.0 / (1.0 + 1.0 / ratio)
    suction_star = suction * derjaguin
    solids = (math.radians(degrees1), math.radians(degrees2), *kappas(ratio))
    product, slope = asymptotic.gap(force / derjaguin, suction_star, *solids)
    # Worst measured: 1.2 % at H* = 10, 0.023 % at 100.
    allowed = 0.015 * (10.0 / suction_star) ** 1.6
    assert product == pytest.approx(suction * separation, rel=allowed)
    assert asymptotic.rupture_star(suction_star, *solids) == pytest.approx(separation / derjaguin, rel=1.2 * allowed)
    assert abs(slope) < 1.5


def test_expansion_against_exact_bridges():
    ctx = young_laplace.DOUBLE
    for suction, angle1, angle2, kappa1, kappa2 in sample(asymptotic.LAW, 24):
        pair = (suction, angle1, angle2, kappa1, kappa2)
        solids = (Solid(1.0 / kappa1, angle1), Solid(1.0 / kappa2 if kappa2 else math.inf, angle2))
        force = asymptotic.force_star(0.9 * asymptotic.rupture_star(*pair), *pair)
        reach = young_laplace.landings(ctx, solids[0], suction, force)[0]
        separation = young_laplace.state(young_laplace.connect(ctx, solids, suction, reach)).gap
        # Worst measured: 1.5 % at H* = 10, 0.16 % at 30, 0.014 % at 100.
        allowed = max(0.016 * (10.0 / suction) ** 1.9, 1e-10)
        assert asymptotic.force_star(separation, *pair) == pytest.approx(force, rel=allowed)


# --- domain and limits ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", FITS_AND_THEORIES, ids=by_name)
@pytest.mark.parametrize("angle", [0.0, 0.3, 0.6])
def test_contact_force_tends_to_the_cosine(law, angle):
    tolerance = 0.02 if law is zhao2020.LAW else 1e-5
    assert law.force_star(0.0, 1e12, angle, angle, *EQUAL) == pytest.approx(math.cos(angle), rel=tolerance)


@pytest.mark.parametrize("law", RUPTURE, ids=by_name)
@pytest.mark.parametrize("angle", [0.0, 0.3, 0.6])
def test_rupture_tends_to_twice_the_cosine_over_the_suction(law, angle):
    assert law.rupture_star(1e14, angle, angle, *EQUAL) == pytest.approx(2.0 * math.cos(angle) / 1e14, rel=1e-4)


def test_expansion_needs_a_fold():
    assert math.isnan(asymptotic.rupture_star(3.0, 0.0, 0.0, *EQUAL))
    assert math.isnan(asymptotic.force_star(0.0, 3.0, 0.0, 0.0, *EQUAL))
    assert math.isfinite(asymptotic.rupture_star(8.0, 0.0, 0.0, *EQUAL))


@pytest.mark.parametrize("pair", [(10.0, 0.0, 0.0, 1.0, 1.0), (1e3, 0.1, 1.0, 2.0, 0.0), (1e12, 0.6, 0.6, 1.0, 1.0)])
def test_expansion_is_solved_up_to_its_fold(pair):
    rupture = asymptotic.rupture_star(*pair)
    force = np.array([asymptotic.force_star(rupture * (1.0 - 0.1**k), *pair) for k in range(17)])
    assert (np.diff(force) <= 1e-7 * force[:-1]).all()
    assert (asymptotic.gap(force[-1], *pair)[0] / pair[0]) == pytest.approx(rupture, rel=1e-13)


def test_expansion_is_solved_for_overlapping_solids():
    force = asymptotic.force_star(-1e-3, 1e4, 0.2, 0.5, 2.0, 0.0)
    assert asymptotic.gap(force, 1e4, 0.2, 0.5, 2.0, 0.0)[0] == pytest.approx(-10.0, rel=1e-13)


def test_derivative_of_the_gap():
    for suction, *solids in sample(asymptotic.LAW, 12):
        below, at, above = (asymptotic.gap(0.4 * (1.0 + step), suction, *solids) for step in (-1e-5, 0.0, 1e-5))
        assert at[1] == pytest.approx((above[0] - below[0]) / 0.8e-5, rel=1e-8)


def test_cubic_of_the_torus_ends_before_its_rupture_distance():
    rupture = toroidal2020.rupture_star(1e4, 0.0, 0.0, *EQUAL)
    assert math.isnan(toroidal2020.force_star(0.999 * rupture, 1e4, 0.0, 0.0, *EQUAL))
    assert toroidal2020.force_star(0.998 * rupture, 1e4, 0.0, 0.0, *EQUAL) > 0.0


def test_fit_needs_a_rupture_distance():
    for rupture in (0.0, -1.0, math.nan):
        assert math.isnan(zhao2020.force_star_given_rupture(0.0, rupture, 100.0, 0.0))


def test_fitted_neck_without_radius_is_no_answer():
    rupture = zhao2020.rupture_star(1e9, 0.0, 0.0, *EQUAL)
    assert math.isnan(zhao2020.force_star(rupture, 1e9, 0.0, 0.0, *EQUAL))
