"""The exact solver as plain Python: the same answers as compiled, and no compiler for a few of them."""

import subprocess
import sys

import numpy as np
import pytest

import pendular as pl
from pendular import few
from pendular._plain.exact import batch as plain_batch
from pendular.exact import batch
from pendular.exact.equations import SUCTION, VOLUME
from pendular.exact.state import State

SEED = 20261129
ASKED = {"stable": batch.STABLE, "unstable": batch.UNSTABLE, "rupture": batch.RUPTURE, "lower": batch.LOWER_END}
FLAT = {"stiffness"}  # infinite at the end of a branch, and steep next to it


def questions(control):
    """Random pairs, a fifth of them mirror images, at a small part of their scale apart."""
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED + control)
    count = 12
    k2, angles = random.uniform(0.0, 1.0, count), np.radians(random.uniform(0.0, 90.0, (2, count)))
    k2[:3], angles[1, :3] = 1.0, angles[0, :3]
    value = 10.0 ** (random.uniform(-8, 0, count) if control == VOLUME else random.uniform(-2, 4, count))
    gap = 0.2 * np.cbrt(value) if control == VOLUME else 0.1 / (1.0 + value)
    return np.column_stack([gap, value, np.ones(count), angles[0], k2, angles[1]])


@pytest.mark.parametrize("asked", ASKED)
@pytest.mark.parametrize("control", [SUCTION, VOLUME])
def test_plain_and_compiled_agree(control, asked):
    rows = questions(control)
    plain, plain_statuses = plain_batch.answer(ASKED[asked], control, rows)
    compiled, statuses = batch.answer(ASKED[asked], control, rows)
    np.testing.assert_array_equal(plain_statuses, statuses)
    tolerance = 1e-14 if asked == "stable" else 1e-9  # where the slope at the end of a branch vanishes
    for field in set(State._fields) - FLAT:
        column = State._fields.index(field)
        np.testing.assert_allclose(plain[:, column], compiled[:, column], rtol=tolerance, atol=1e-12, err_msg=field)


def test_a_few_questions_compile_nothing():
    """One bridge, one rupture and one curve in a fresh interpreter without a cache."""
    script = (
        "import pendular as pl\n"
        "pair, liquid = pl.Pair(1.0, 0.3), pl.Liquid(surface_tension=1.0)\n"
        "pl.bridge(pair, 0.01, volume=1e-3, liquid=liquid), pl.rupture(pair, suction=1.0, liquid=liquid)\n"
        "pl.curve(pair, volume=1e-3, liquid=liquid, points=21)\n"
        "from pendular.exact.batch import bridge_range, curve_range\n"
        "print(len(bridge_range.signatures), len(curve_range.signatures))\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["0", "0"]


def test_a_step_out_of_a_domain_is_left_to_the_compiled_solver(monkeypatch):
    def fail(*_arguments):
        raise ZeroDivisionError

    monkeypatch.setattr(few, "_is_loaded", lambda *_: False)
    monkeypatch.setattr(few, "_spent", dict.fromkeys(few._spent, 0.0))
    monkeypatch.setattr(plain_batch, "answer", fail)
    bridge = pl.bridge(pl.Pair(1.0, 0.3), 0.01, suction=1.0, liquid=pl.Liquid(surface_tension=1.0))
    assert bridge.exists


def test_who_keeps_asking_is_answered_by_the_compiled_solver(monkeypatch):
    monkeypatch.setattr(few, "_is_loaded", lambda *_: False)
    monkeypatch.setattr(few, "_spent", dict.fromkeys(few._spent, 0.0))
    assert few.by_cost("batch", "answer", 1) is not batch.answer
    assert few.by_cost("batch", "answer", 10_000) is batch.answer
    monkeypatch.setattr(few, "_spent", dict.fromkeys(few._spent, 10.0))
    assert few.by_cost("batch", "answer", 1) is batch.answer


@pytest.mark.parametrize(("angle", "separation"), [(1.17, 0.59), (0.5, 0.32), (0.65, 0.78)])
def test_a_step_of_exactly_zero_is_no_error(angle, separation):
    """Newton's method from the bridge itself, between planes."""
    from pendular._plain.exact.equations import Held
    from pendular._plain.exact.guess import guess_at
    from pendular._plain.exact.newton import newton_to
    from pendular._plain.exact.solids import solid_of

    held = Held(solid_of(0.0, angle), solid_of(0.0, angle), VOLUME, 1.0)
    first, is_met = newton_to(guess_at(held, separation), separation, held, 14)
    assert is_met
    z = first
    for _ in range(5):
        z, is_met = newton_to(z, separation, held, 14)
        assert is_met
        np.testing.assert_allclose(z, first, rtol=0.0, atol=1e-14)
