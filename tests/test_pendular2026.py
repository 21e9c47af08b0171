"""The re-fitted law: transcription, measured error by band, exact limits, and the script that made its numbers."""

import importlib.util
import itertools
import math
import sys
from pathlib import Path

import numpy as np
import pytest

from oracles.laws_mpmath import PENDULAR2026_COEFFICIENTS as PRINTED
from oracles.laws_mpmath import pendular2026 as oracle
from pendular.exact.batch import RUPTURE, STABLE, answer
from pendular.exact.equations import SUCTION
from pendular.exact.state import State
from pendular.laws import pendular2026
from pendular.laws.pendular2026 import COEFFICIENTS, LAW, evaluate, force_star, rupture_star

SEED = 20260801
EQUAL = (1.0, 1.0)
ANGLE_BANDS = ((0, 20), (20, 40), (40, 60), (60, 80))  # degrees
SUCTION_BANDS = ((0, 0), (1e-3, 1), (1, 10), (10, 100), (100, 1e4), (1e4, 1e8))
PER_BAND = 900

# Largest relative error in per cent on the sample of `bands`: rows by angle, columns by suction.
RUPTURE_ERROR = [
    [0.0483, 0.0681, 0.0695, 0.0274, 0.00772, 3.97e-5],
    [0.0633, 0.0646, 0.0690, 0.0225, 0.00272, 1.95e-5],
    [0.0590, 0.0585, 0.0439, 0.0227, 0.00188, 4.96e-6],
    [0.0212, 0.0211, 0.0178, 0.0137, 0.00191, 5.73e-6],
]
FORCE_ERROR = [
    [0.552, 0.549, 0.568, 0.338, 0.116, 0.0175],
    [0.534, 0.534, 0.506, 0.336, 0.0942, 0.00915],
    [0.496, 0.494, 0.301, 0.287, 0.0909, 0.00343],
    [0.274, 0.271, 0.137, 0.136, 0.0502, 9.32e-4],
]


def near(expected, tolerance):
    """Relative comparison alone: reduced forces and gaps can be tiny."""
    return pytest.approx(expected, rel=tolerance, abs=0.0)


def exact(asked, separation, suction, angle1, angle2, kappa1=1.0, kappa2=1.0):
    """Separation and force of exact bridges."""
    columns = np.broadcast_arrays(separation, suction, kappa1, angle1, kappa2, angle2)
    questions = np.column_stack([column.ravel() for column in columns]).astype(float)
    states, _ = answer(asked, SUCTION, questions)
    assert np.isfinite(states[:, State._fields.index("force")]).all()
    return states[:, State._fields.index("separation")], states[:, State._fields.index("force")]


def fractions(rng, count):
    """Separations over the rupture distance up to 0.99, both ends included often."""
    return np.where(rng.random(count) < 0.3, 0.99 * (rng.random(count) < 0.5), rng.uniform(0.0, 0.99, count))


def measured(coefficients, separation, suction, angle1, angle2, kappa1, kappa2, rupture, force):
    """Relative errors of both answers."""
    rows = np.column_stack(np.broadcast_arrays(separation, suction, angle1, angle2, kappa1, kappa2)).tolist()
    law = np.array([evaluate(coefficients, *row) for row in rows])
    return abs(law[:, 0] / rupture - 1.0), abs(law[:, 1] / force - 1.0)


@pytest.fixture(scope="module")
def bands():
    """Exact bridges between equal spheres, as many in each band of angle and suction."""
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    samples = []
    for low, high in ANGLE_BANDS:
        for least, most in SUCTION_BANDS:
            angle = np.deg2rad(rng.uniform(low, high, PER_BAND))
            suction = np.exp(rng.uniform(*np.log([least, most]), PER_BAND)) if least else np.zeros(PER_BAND)
            rupture, _ = exact(RUPTURE, 0.0, suction, angle, angle)
            separation = rupture * fractions(rng, PER_BAND)
            force = exact(STABLE, separation, suction, angle, angle)[1]
            samples.append((separation, suction, angle, angle, *EQUAL, rupture, force))
    return samples


def tables(coefficients, bands):
    """Largest errors in per cent, of rupture and force, by angle and suction."""
    errors = [[100.0 * error.max() for error in measured(coefficients, *sample)] for sample in bands]
    return np.array(errors).T.reshape(2, len(ANGLE_BANDS), len(SUCTION_BANDS))


# --- measured error ---------------------------------------------------------------------------------------------------


def test_error_is_below_one_per_cent_in_force_and_one_per_mille_in_rupture(bands):
    rupture, force = tables(COEFFICIENTS, bands)
    assert rupture.max() < 0.0700
    assert force.max() < 0.573


def test_error_by_angle_and_suction_is_as_stored(bands):
    np.testing.assert_allclose(tables(COEFFICIENTS, bands), [RUPTURE_ERROR, FORCE_ERROR], rtol=0.01)


@pytest.mark.parametrize("which", range(3))
@pytest.mark.parametrize("step", [-1, 1])
def test_changed_digit_breaks_the_stored_error(bands, which, step):
    changed = list(COEFFICIENTS)
    changed[which] += step * 10.0 ** -len(PRINTED[which].partition(".")[2])
    change = abs(tables(tuple(changed), bands) / [RUPTURE_ERROR, FORCE_ERROR] - 1.0)
    assert change.max() > 0.05


def test_coefficients_are_as_printed():
    assert tuple(map(float, PRINTED)) == COEFFICIENTS


@pytest.mark.parametrize(
    ("largest_kappa", "least", "of_rupture", "of_force"),
    [(1.0, 10.0, 0.014, 0.023), (2.0, 100.0, 0.004, 0.011), (2.0, 1e3, 2e-4, 1.2e-3)],
)
def test_error_of_unlike_solids_is_as_quoted(largest_kappa, least, of_rupture, of_force):
    rng = np.random.default_rng(SEED)
    count = 6000
    suction = least * 10.0 ** (4.0 * rng.random(count) ** 2)
    angle1, angle2 = np.deg2rad(rng.uniform(0.0, 80.0, (2, count)))
    kappa1 = rng.uniform(1.0, largest_kappa, count)
    kappa1[::3] = largest_kappa  # 2 and 0: a plane
    solids = (angle1, angle2, kappa1, 2.0 - kappa1)
    rupture, _ = exact(RUPTURE, 0.0, suction, *solids)
    separation = rupture * np.minimum(fractions(rng, count), 0.9)
    force = exact(STABLE, separation, suction, *solids)[1]
    errors = measured(COEFFICIENTS, separation, suction, *solids, rupture, force)
    assert 0.5 * of_rupture < errors[0].max() < of_rupture
    assert 0.5 * of_force < errors[1].max() < of_force


# --- transcription ----------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def pairs():
    """Random (H*, θ1, θ2, κ1, κ2): equal spheres, then any two solids."""
    rng = np.random.default_rng(SEED)
    suction = 10.0 ** rng.uniform(-3.0, 9.0, 40)
    suction[::8] = (0.0, 1e-9, 1.0, 1e12, 1e30)
    angles = np.deg2rad(rng.uniform(0.0, 80.0, (2, 40)))
    kappa1 = rng.uniform(1.0, 2.0, 40)
    angles[1, :20], kappa1[:20] = angles[0, :20], 1.0
    return np.column_stack([suction, *angles, kappa1, 2.0 - kappa1]).tolist()


@pytest.mark.parametrize("fraction", [-0.3, 0.0, 0.5, 0.9])
def test_law_equals_oracle(pairs, fraction):
    for pair in pairs:
        separation = fraction * rupture_star(*pair)
        rupture, force = oracle(separation, *pair)
        # Worst measured: 3e-16 and 2.2e-15.
        assert rupture_star(*pair) == near(float(rupture), 2e-15)
        assert force_star(separation, *pair) == near(float(force), 8e-15)


def test_equal_angles_have_a_short_form_of_the_third_coefficient():
    for angle in (0.0, 0.4, 1.3):
        a = 0.5 * (0.5 * math.pi - angle + math.sin(angle) * math.cos(angle))
        rho, s = a / math.cos(angle), math.sin(angle)
        _, cosine, c = pendular2026._pair(angle, angle, *EQUAL)
        assert (cosine, c) == near((math.cos(angle), rho * (0.375 + s * s) + s**3 / 8.0), 1e-13)


# --- exact limits -----------------------------------------------------------------------------------------------------


def expansion(suction, angle1, angle2, kappa1, kappa2):
    """Suction times rupture distance, three exact terms."""
    a, cosine, c = pendular2026._pair(angle1, angle2, kappa1, kappa2)
    return 2.0 * cosine - 3.0 * a ** (2.0 / 3.0) * suction ** (-1.0 / 3.0) + 2.0 * cosine * c / a / suction


SOLIDS = [
    (0.0, 0.0, 1.0, 1.0),
    (0.7, 0.7, 1.0, 1.0),
    (1.39, 1.39, 1.0, 1.0),
    (0.2, 1.2, 1.0, 1.0),
    (0.1, 0.9, 2.0, 0.0),
]


@pytest.mark.parametrize("solids", SOLIDS)
def test_rupture_has_the_exact_expansion(solids):
    for suction in (1e4, 1e6, 1e8):
        gap = suction * rupture_star(suction, *solids) - expansion(suction, *solids)
        assert abs(gap) < 5.0 * suction ** (-4.0 / 3.0)
    for suction in (1e12, 1e30, 1e100):
        assert suction * rupture_star(suction, *solids) == near(expansion(suction, *solids), 1e-14)


@pytest.mark.parametrize("solids", SOLIDS)
def test_exact_bridges_have_the_expansion_too(solids):
    suction = np.array([1e6, 1e8])
    rupture, _ = exact(RUPTURE, 0.0, suction, solids[0], solids[1], solids[2], solids[3])
    assert (abs(suction * rupture - expansion(suction, *solids)) < 5.0 * suction ** (-4.0 / 3.0) + 1e-14).all()


@pytest.mark.parametrize("solids", SOLIDS)
def test_force_at_contact_has_the_exact_expansion(solids):
    a, cosine, _ = pendular2026._pair(*solids)
    for suction in (1e4, 1e8, 1e12, 1e20):
        leading = cosine - a / math.sqrt(2.0 * suction * cosine)
        assert abs(force_star(0.0, suction, *solids) - leading) < 1.5 / suction + 5e-15


@pytest.mark.parametrize("degrees", [0.0, 40.0, 80.0])
def test_force_tends_to_the_exact_one_on_the_whole_branch(degrees):
    angle = math.radians(degrees)
    fraction = np.array([0.0, 0.5, 0.9, 0.99, 0.9999])
    # Worst measured: 8.8e-6, 1.1e-7 and 8.6e-10.
    for suction, allowed in ((1e6, 2e-5), (1e9, 2e-7), (1e12, 2e-9)):
        rupture, _ = exact(RUPTURE, 0.0, suction, angle, angle)
        force = exact(STABLE, fraction * rupture, suction, angle, angle)[1]
        law = [force_star(separation, suction, angle, angle, *EQUAL) for separation in (fraction * rupture).tolist()]
        np.testing.assert_allclose(law, force, rtol=allowed)


@pytest.mark.parametrize("suction", [0.0, 0.1, 10.0, 1e3, 1e5])
def test_grazing_contact_is_exact_at_any_suction(suction):
    """Flat bridges: m_f³ = 1 + H cos θ, H² D_c = (m_f - 1)² (2 m_f + 1), checked through the scale H cos θ."""
    angle = 0.5 * math.pi - 1e-4
    h = suction * 1e4
    m_f = (1.0 + h * math.cos(angle)) ** (1.0 / 3.0)
    y_f = math.cos(angle) / (1.0 + m_f + m_f * m_f)
    assert rupture_star(h, angle, angle, *EQUAL) == near(y_f * y_f * (2.0 * m_f + 1.0), 1e-7)
    y_0 = y_f * 1.5
    separation = y_f * y_f * (2.0 * m_f + 1.0) - (y_0 - y_f) ** 2 * (1.0 + 2.0 * m_f / (1.0 + h * y_0))
    force = y_0 + 0.5 * h * y_0 * y_0
    assert force_star(separation, h, angle, angle, *EQUAL) == near(force, 1e-7)
    if separation > 0.0:
        assert exact(STABLE, separation, h, angle, angle)[1][0] == near(force, 1e-7)


def test_limits_are_exact_without_fitted_numbers():
    for coefficients in ((0.0, 0.0, 0.0), COEFFICIENTS, (0.9, 0.0, 2.0)):
        rupture, force = evaluate(coefficients, 0.0, 1e30, 0.5, 0.5, *EQUAL)
        assert rupture * 1e30 == near(expansion(1e30, 0.5, 0.5, *EQUAL), 1e-14)
        assert force == near(math.cos(0.5), 1e-14)


def test_zero_suction_is_reached_smoothly():
    for angle, fraction in itertools.product((0.0, 0.6, 1.3), (0.0, 0.9)):
        at_zero = rupture_star(0.0, angle, angle, *EQUAL)
        separation = fraction * at_zero
        for suction in (5e-324, 1e-300, 1e-150, 1e-15):
            assert rupture_star(suction, angle, angle, *EQUAL) == near(at_zero, 1e-14)
            here = force_star(separation, suction, angle, angle, *EQUAL)
            assert here == near(force_star(separation, 0.0, angle, angle, *EQUAL), 1e-13)


# --- behaviour --------------------------------------------------------------------------------------------------------


def test_force_is_positive_and_falls_with_the_gap(pairs):
    for pair in pairs:
        rupture = rupture_star(*pair)
        force = np.array([force_star(f * rupture, *pair) for f in np.linspace(-0.5, 1.0, 301).tolist()])
        assert (force > 0.0).all()
        assert (np.diff(force) < 0.0).all()


def test_no_force_beyond_its_own_rupture(pairs):
    for pair in pairs:
        rupture = rupture_star(*pair)
        assert rupture > 0.0
        assert force_star(rupture, *pair) > 0.0
        assert [force_star(f * rupture, *pair) for f in (1.0 + 1e-12, 2.0, 1e9)] == [0.0, 0.0, 0.0]


def test_nan_outside_the_domain():
    right = (0.01, 10.0, 0.3, 0.4, 1.2, 0.8)
    wrong = [(1, -1e-9), (2, -0.1), (3, -0.1), (2, 0.5 * math.pi), (3, 2.0), *((i, math.nan) for i in range(6))]
    for i, value in wrong:
        row = (*right[:i], value, *right[i + 1 :])
        assert math.isnan(force_star(*row))
        assert math.isnan(rupture_star(*row[1:])) == (i > 0)


def test_exchange_of_the_solids_changes_nothing(pairs):
    for suction, angle1, angle2, kappa1, kappa2 in pairs:
        here, there = (suction, angle1, angle2, kappa1, kappa2), (suction, angle2, angle1, kappa2, kappa1)
        assert rupture_star(*here) == rupture_star(*there)
        assert force_star(0.0, *here) == force_star(0.0, *there)


def test_record_names_the_kernels():
    assert LAW.name == "pendular2026"
    assert (LAW.force_star, LAW.rupture_star) == (force_star, rupture_star)
    assert LAW.gives == ("force", "rupture")


# --- the script -------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def script():
    path = Path(__file__).parents[1] / "tools" / "fit_pendular2026.py"
    specification = importlib.util.spec_from_file_location(path.stem, path)
    module = sys.modules[path.stem] = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    yield module
    del sys.modules[path.stem]


def test_script_finds_the_coefficients_again(script):
    points = script.grid(41, 21, 14)
    optimum = script.fit(points)
    assert optimum == pytest.approx(COEFFICIENTS, abs=0.02)
    assert script.rounded(optimum, points) == COEFFICIENTS


def test_script_writes_one_line(script, tmp_path, monkeypatch):
    copy = tmp_path / "law.py"
    copy.write_text(Path(pendular2026.__file__).read_text("utf-8"), "utf-8")
    monkeypatch.setattr(script, "LAW_FILE", copy)
    before = copy.read_text("utf-8").splitlines()
    script.write(COEFFICIENTS)
    assert copy.read_text("utf-8").splitlines() == before
    script.write((0.1, 0.2, 0.3))
    changed = [(old, new) for old, new in zip(before, copy.read_text("utf-8").splitlines(), strict=True) if old != new]
    assert [new for _, new in changed] == ["COEFFICIENTS = (0.1, 0.2, 0.3)"]


def test_picture_is_drawn(script, tmp_path):
    script.picture(COEFFICIENTS, tmp_path / "error.png", fineness=1)
    assert (tmp_path / "error.png").stat().st_size > 10_000
