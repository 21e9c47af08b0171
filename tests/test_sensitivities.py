"""Rates of the force in each number of a question: against 30 digits, and against the solver's own differences."""

import math
from functools import partial

import numpy as np
import pytest
from mpmath import MPContext

from oracles import young_laplace
from oracles.young_laplace import Solid
from pendular.exact import batch
from pendular.exact.equations import SUCTION, VOLUME
from pendular.exact.sensitivities import Rates, rates_of_force
from pendular.exact.state import State
from pendular.ground import rows

SEED = 20360401
CONTROLS = {"suction": SUCTION, "volume": VOLUME}
ANGLES = (3, 5)
FORCE, FILLING = State._fields.index("force"), State._fields.index("filling1")


def random_questions(control, count, seed):
    """Random stable bridges: ratios to a plane, angles from 1 to 90 degrees, up to most of the rupture distance."""
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    second = random.choice([1.0, 0.0, 0.5], count) * random.uniform(0.1, 1.0, count)
    angles = np.radians(random.uniform(1.0, 90.0, (2, count)))
    value = 10.0 ** (random.uniform(-8, 0, count) if control == VOLUME else random.uniform(-2, 4, count))
    rows = np.column_stack([np.zeros(count), value, np.ones(count), angles[0], second, angles[1]])
    ends, statuses = batch.answer(batch.RUPTURE, control, rows)
    rows[:, 0] = random.uniform(0.05, 0.6, count) * ends[:, 0]
    return rows[statuses == batch.FOUND]


def moved_force(control, question, column, way):
    """λ of rows with one number moved; an angle by its cosine."""
    moved = question.copy()
    if column in ANGLES:
        moved[:, column] = np.arccos(np.cos(question[:, column]) + way)
    else:
        moved[:, column] += way
    return batch.answer(batch.STABLE, control, moved)[0][:, FORCE]


@pytest.mark.parametrize("control", CONTROLS)
def test_rates_are_the_slopes_of_the_solver(control):
    held = CONTROLS[control]
    question = random_questions(held, 1500, SEED)
    states, statuses = batch.answer(batch.STABLE, held, question)
    assert np.count_nonzero(statuses == batch.FOUND) > 1000
    rates = rates_of_force(held, question, states)
    for column, name in enumerate(Rates._fields):
        size = np.maximum(np.abs(question[:, column]), 0.0 if column < 2 else 1e-3)
        step = 1e-5 * (np.sin(question[:, column]) ** 2 if column in ANGLES else size)
        force = partial(moved_force, held, question, column)
        near, far = force(step) - force(-step), force(2 * step) - force(-2 * step)
        slope = (8.0 * near - far) / (12.0 * step)
        known = ~np.isnan(slope) & ~np.isnan(rates[:, column])
        scale = np.maximum(np.abs(rates[:, column]), np.abs(states[:, FORCE]) / size)
        error = np.abs(slope - rates[:, column])[known] / scale[known]
        assert known.sum() > (600 if name == "curvature2" else 1000), name  # a plane is not moved both ways
        assert np.quantile(error, 0.99) < 1e-6, name
        assert np.median(error) < 1e-8, name


class Oracle:
    """Forces with 30 digits: the bridge of a separation and a control by its suction and first contact circle."""

    def __init__(self, control, question, state):
        self.ctx = MPContext()
        self.ctx.dps = 30
        self.control = control
        self.question = [self.ctx.mpf(float(x)) for x in question]
        self.near = [self.ctx.mpf(float(state[State._fields.index("curvature")])), self.ctx.mpf(float(state[FILLING]))]
        self.near2 = self.ctx.mpf(float(state[FILLING + 1] if question[4] else state[State._fields.index("radius2")]))

    def force(self, column, way):
        """λ with one number moved."""
        question = list(self.question)
        question[column] += way
        separation, value, k1, angle1, k2, angle2 = question
        solids = (Solid(1 / k1, angle1), Solid(1 / k2 if k2 else self.ctx.inf, angle2))

        def bridge(suction, filling):
            second = self.near2 / k2 if k2 else self.near2
            return young_laplace.connect(self.ctx, solids, suction, filling / k1, second * (1 + self.ctx.mpf(10) ** -6))

        def misses(suction, filling):
            found = young_laplace.state(bridge(suction, filling))
            held = found.volume / value - 1 if self.control == VOLUME else suction / value - 1
            return [found.gap / separation - 1, held]

        return bridge(*self.root(misses)).force

    def root(self, misses):
        """Newton's method in two unknowns, with rates by differences."""
        place, step = self.ctx.matrix(self.near), self.ctx.mpf(10) ** -10
        for _ in range(12):
            at = self.ctx.matrix(misses(*place))
            rates = self.ctx.matrix(2, 2)
            for i in range(2):
                ahead = place.copy()
                ahead[i] *= 1 + step
                rates[:, i] = (self.ctx.matrix(misses(*ahead)) - at) / (place[i] * step)
            place -= self.ctx.lu_solve(rates, at)
            if max(map(abs, at)) < 1e-26:
                return place
        raise AssertionError(f"no root: {at}")

    def rate(self, column):
        """Slope by differences, for an angle in its cosine; at 0 that is the curvature in the angle."""
        at = partial(self.force, column)
        size = self.question[column]
        if column in ANGLES and size == 0:
            step = self.ctx.mpf(10) ** -6
            return -(2 * at(0) - 5 * at(step) + 4 * at(2 * step) - at(3 * step)) / step**2
        step = size * self.ctx.mpf(10) ** -10
        slope = (at(step) - at(-step)) / (2 * step)
        return slope / -self.ctx.sin(size) if column in ANGLES else slope


CASES = {  # D, H or V, k1, θ1, k2, θ2
    "equal spheres": (VOLUME, (0.05, 1e-3, 1.0, 0.6, 1.0, 0.35)),
    "wetted through": (VOLUME, (0.03, 2e-3, 1.0, 0.0, 0.5, 0.0)),
    "sphere on a plate": (VOLUME, (0.04, 4e-3, 1.0, 0.9, 0.0, 0.2)),
    "beyond the equator": (VOLUME, (0.5, 9.0, 1.0, 0.5, 0.8, 0.6)),
    "drained": (SUCTION, (0.005, 30.0, 1.0, 0.6, 0.7, 0.0)),
    "drained plate": (SUCTION, (0.02, 5.0, 1.0, 0.0, 0.0, 0.7)),
}


@pytest.mark.long
@pytest.mark.parametrize("case", CASES)
def test_rates_have_the_thirty_digits_behind_them(case):
    control, question = CASES[case]
    asked = np.array([question])
    states, statuses = batch.answer(batch.STABLE, control, asked)
    assert statuses[0] == batch.FOUND
    rates = rates_of_force(control, asked, states)[0]
    oracle = Oracle(control, question, states[0])
    for column in range(6):
        if question[column] == 0.0 and column == 4:
            continue  # a plane is not moved both ways
        exact = float(oracle.rate(column))
        assert rates[column] == pytest.approx(exact, rel=1e-10), Rates._fields[column]


def test_the_force_is_flat_in_an_angle_of_nothing():
    question = np.array([[0.05, 1e-3, 1.0, angle, 1.0, angle] for angle in (0.0, 1e-4, 1e-3)])
    states, _ = batch.answer(batch.STABLE, VOLUME, question)
    by_cosine = rates_of_force(VOLUME, question, states)[:, 3]
    assert by_cosine == pytest.approx(by_cosine[0], rel=1e-2)
    drop = (states[0, FORCE] - states[2, FORCE]) / (2.0 * (1.0 - math.cos(1e-3)))
    assert drop == pytest.approx(by_cosine[0], rel=1e-2)


def test_where_there_is_no_bridge_there_are_no_rates():
    question = np.array([[5.0, 1e-3, 1.0, 0.3, 1.0, 0.3]])
    states, statuses = batch.answer(batch.STABLE, VOLUME, question)
    assert statuses[0] == batch.NO_BRIDGE
    assert np.isnan(rates_of_force(VOLUME, question, states)).all()


@pytest.mark.needs("numba")
@pytest.mark.parametrize("control", CONTROLS)
def test_plain_python_and_machine_code_agree(control, monkeypatch):
    held = CONTROLS[control]
    question = random_questions(held, 12, SEED + 1)
    states, _ = batch.answer(batch.STABLE, held, question)
    with rows.by_machine_code():
        compiled = rates_of_force(held, question, states)
    monkeypatch.setattr(rows, "_machine_code", lambda *_: None)
    assert rates_of_force(held, question, states) == pytest.approx(compiled, rel=1e-11)
