"""Curves found from their neighbours against the same curves walked from contact, each for itself."""

import math

import numpy as np
import pytest
from pendular.exact.arrays import STABLE, suction_range
from pendular.exact.equilibrium import State
from pendular.exact.fractions import fractions_range
from pendular.exact.middle import CURVATURE, VOLUME
from pendular.exact.neighbours import BLOCK, blocks_range
from pendular.exact.states import FOUND

SEED = 20261123
Q = 0.5 - 0.5 * np.cos(np.pi * (np.arange(24) + 0.5) / 24)


def from_neighbours(held, pairs):
    rupture, values = np.empty(len(pairs)), np.empty((len(pairs), Q.size, 2))
    walked = np.zeros(-(-len(pairs) // BLOCK), np.int64)
    blocks_range(held, pairs, Q, rupture, values, walked, 0, walked.size)
    return rupture, values, walked


def each_for_itself(held, pairs, rupture):
    """Curves at the same separations, which are stretched at a volume: asinh(D/d) takes the place of D."""
    q = np.broadcast_to(Q, (len(pairs), Q.size))
    if held == VOLUME:
        stretch = np.sqrt(2.0 * pairs[:, :1] / math.pi)  # R̄ = 1
        reach = rupture[:, None]
        separation = stretch * np.sinh(np.arcsinh(reach / stretch) * (1.0 - Q * Q))
        q = np.sqrt(1.0 - separation / reach)
    found, values = np.empty(len(pairs)), np.empty((len(pairs), Q.size, 2))
    fractions_range(held, pairs, np.ascontiguousarray(q), found, values, 0, len(pairs))
    return found, values


def similar_pairs(random, control, angles):
    """An octave of the control, and a panel of the size ratio: from pairs of all ratios to nearly equal ones."""
    depth = random.integers(0, 6)
    low = random.integers(0, 2**depth) / 2.0**depth
    s = (low + 0.5**depth * np.sort(random.uniform(size=12))) ** 1.5
    grid, controls = (each.ravel() for each in np.meshgrid(s, control * 2.0 ** random.uniform(size=8), indexing="ij"))
    side = random.choice([-1.0, 1.0])
    theta1, theta2 = np.full((2, grid.size), np.array(angles)[:, None])
    return np.column_stack([controls, 1.0 + side * grid, theta1, 1.0 - side * grid, theta2])


def test_same_curves_at_a_volume():
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    rows = walked_rows = 0
    for i in range(25):
        angles = random.uniform(0.0, math.radians(60), 2)
        if i % 3:
            angles[1] = angles[0]
        pairs = similar_pairs(random, 10.0 ** random.uniform(-9.0, -0.3), angles)
        rupture, values, walked = from_neighbours(VOLUME, pairs)
        some = random.choice(len(pairs), 8, replace=False)
        truth, at_truth = each_for_itself(VOLUME, pairs[some], rupture[some])
        assert rupture[some] == pytest.approx(truth, rel=1e-12)
        error = np.abs(values[some] - at_truth) / np.abs(at_truth[:, -1:])
        assert error[..., 0].max() < 1e-9
        assert error[..., 1].max() < 1e-8
        rows += len(pairs)
        walked_rows += walked.sum()
    assert walked_rows < 0.1 * rows  # a walk is the exception


@pytest.mark.parametrize("degrees", [0, 20, 40, 60])
def test_mirror_images_end_where_they_lose_stability(degrees):
    theta = math.radians(degrees)
    volumes = np.geomspace(1e-3, 4e-3, 12)
    pairs = np.column_stack([volumes, *(np.full(12, number) for number in (1.0, theta, 1.0, theta))])
    rupture, values, walked = from_neighbours(VOLUME, pairs)
    truth, at_truth = each_for_itself(VOLUME, pairs, rupture)
    assert rupture == pytest.approx(truth, rel=1e-12)
    assert values[..., 0] == pytest.approx(at_truth[..., 0], rel=1e-7)
    is_pitchfork = degrees > 31
    assert (walked.sum() == 12) == is_pitchfork


def test_same_bridges_under_suction():
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    for _ in range(40):
        pairs = similar_pairs(random, 10.0 ** random.uniform(-2.0, 8.0), random.uniform(0.0, math.radians(80), 2))
        rupture, values, _ = from_neighbours(CURVATURE, pairs)
        questions = np.repeat(np.column_stack([rupture, pairs]), Q.size, axis=0)
        questions[:, 0] *= np.tile(1.0 - Q * Q, len(pairs))
        states, statuses = np.empty((len(questions), len(State._fields))), np.empty(len(questions), np.int8)
        suction_range(STABLE, questions, states, statuses, 0, len(questions))
        assert np.all(statuses == FOUND)
        for i, name in enumerate(("force", "volume")):
            each = states[:, State._fields.index(name)].reshape(len(pairs), Q.size)
            # Next to rupture both routes lose half of the digits: D has its maximum there.
            allowed = 1e-13 + 1e-14 / Q
            assert np.all(np.abs(values[..., i] - each) < allowed * np.abs(each[:, -1:]))
