"""Random pairs for a law, and comparisons, shared by the tests of the laws."""

import math

import numpy as np
import pytest

SEED = 20200115
EQUAL = (1.0, 1.0)


def by_name(law):
    return law.name


def kappas(size_ratio):
    return 2.0 / (1.0 + 1.0 / size_ratio), 2.0 - 2.0 / (1.0 + 1.0 / size_ratio)


def sample(law, count):
    """Random (control*, θ1, θ2, κ1, κ2) in the range of the law: equal spheres, then any two solids."""
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    low, high = law.valid[f"{law.control}_star"]
    least, most = {"suction": (1e-3, 1e7), "volume": (1e-7, 1.0)}[law.control]
    control = np.exp(rng.uniform(math.log(max(low, least)), math.log(min(high, most)), count))
    angles = rng.uniform(*law.valid["contact_angle"], (2, count))
    size = np.where(rng.random(count) < 0.2, math.inf, rng.uniform(1.0, 10.0, count))
    alike = np.arange(count) < count // 2
    angles[1] = np.where(alike, angles[0], angles[1])
    angles[:, ::4] = 0.0
    kappa = np.where(alike, 1.0, kappas(size))
    return np.column_stack([control, *angles, *kappa]).tolist()


def reach(law, pair):
    """Rupture distance by the law, and for one that gives none a distance of that order."""
    if law.rupture_star:
        return law.rupture_star(*pair)
    return pair[0] ** (1.0 / 3.0) if law.control == "volume" else 1.0 / pair[0]


def assert_close(computed, expected, tolerance):
    assert computed == pytest.approx(float(expected), rel=tolerance, abs=0.0, nan_ok=True)


def assert_error(computed, exact, quoted):
    """Compare the relative error in per cent with a number as printed, to half a unit of its last digit."""
    digits = len(quoted.partition(".")[2])
    assert 100.0 * (computed / exact - 1.0) == pytest.approx(float(quoted), rel=0.0, abs=0.51 * 10.0**-digits)
