"""Every question of the domain is answered: random pairs of any ratio and angles, both controls, both branches."""

import numpy as np
import pytest
from pendular.exact.arrays import AT_FOLD, STABLE, UNSTABLE, path_range, suction_range
from pendular.exact.equilibrium import State
from pendular.exact.middle import VOLUME
from pendular.exact.states import FAILED, FOUND, NO_BRIDGE

from pendular._jit import in_chunks

SEED = 622634
D, FORCE, V, STABLE_FLAG = (State._fields.index(name) for name in ("separation", "force", "volume", "stable"))


def random_pairs(count, largest_angle, rng):
    """Rows of k1, θ1, k2, θ2: equal spheres, planes, and size ratios up to 1e4; half of them with equal angles."""
    k2 = rng.choice([1.0, 0.0, -1.0, -2.0], count)
    k2 = np.where(k2 == -1.0, rng.random(count), np.where(k2 == -2.0, 10.0 ** rng.uniform(-4, 0, count), k2))
    theta1, theta2 = np.deg2rad(rng.uniform(0, largest_angle, (2, count)))
    theta2 = np.where(rng.random(count) < 0.5, theta1, theta2)
    return np.ones(count), theta1, k2, theta2


def answers(solve, asked, questions, *more):
    states, statuses = np.empty((len(questions), len(State._fields))), np.empty(len(questions), np.int8)
    in_chunks(solve, len(questions), 64, asked, *more, questions, states, statuses)
    return states, statuses


def suction(asked, questions):
    return answers(suction_range, asked, questions)


def volume(asked, questions):
    return answers(path_range, asked, questions, VOLUME)


@pytest.mark.parametrize("largest_angle", [88, 120])
def test_constant_suction(largest_angle):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    count = 20000
    curvature = np.where(rng.random(count) < 0.05, 0.0, 10.0 ** rng.uniform(-6, 12, count))
    questions = np.column_stack([np.zeros(count), curvature, *random_pairs(count, largest_angle, rng)])
    folds, statuses = suction(AT_FOLD, questions)
    assert not np.any(statuses == FAILED)
    with_bridge = statuses == FOUND
    hydrophilic = np.cos(questions[:, 3]) + np.cos(questions[:, 5]) > 0.0
    assert np.all(with_bridge[hydrophilic & (curvature > 1e3) & (questions[:, [3, 5]].max(axis=1) < 1.5)])
    questions, rupture = questions[with_bridge], folds[with_bridge, D]
    assert np.all(rupture > 0.0)

    for asked, fraction in (
        (STABLE, rng.uniform(0, 0.9999, len(questions))),
        (UNSTABLE, rng.uniform(0.02, 0.999, len(questions))),
    ):
        questions[:, 0] = fraction * rupture
        states, statuses = suction(asked, questions)
        assert np.all(statuses == FOUND)
        # measured 2e-14 below 88°, 1e-11 where the two cosines nearly cancel
        assert np.max(np.abs(states[:, D] - questions[:, 0]) / rupture) < 1e-10
        assert np.all(states[:, STABLE_FLAG] == (asked == STABLE))
    questions[:, 0] = 1.0001 * rupture
    assert np.all(suction(STABLE, questions)[1] == NO_BRIDGE)


@pytest.mark.long
@pytest.mark.parametrize("largest_angle", [85, 120])
def test_constant_volume(largest_angle):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    count = 3000
    amount = 10.0 ** rng.uniform(-12, 0, count)
    questions = np.column_stack([np.zeros(count), amount, *random_pairs(count, largest_angle, rng)])
    folds, statuses = volume(AT_FOLD, questions)
    assert np.all(statuses == FOUND)
    rupture = folds[:, D]
    assert np.all(rupture > 0.0)
    for asked, fraction in ((STABLE, rng.uniform(0, 1, count)), (UNSTABLE, rng.uniform(0.85, 1, count))):
        questions[:, 0] = fraction * rupture
        states, statuses = volume(asked, questions)
        assert np.all(statuses == FOUND)
        assert np.max(np.abs(states[:, D] - questions[:, 0]) / rupture) < 1e-13  # measured 3e-15
        assert np.max(np.abs(states[:, V] / amount - 1.0)) < 1e-13  # measured 8e-15
    questions[:, 0] = 1.0001 * rupture
    assert np.all(volume(STABLE, questions)[1] == NO_BRIDGE)
