"""A root between two places: against SciPy's, of smooth functions and of steps."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from pendular.ground.root import root_between

FUNCTIONS = {
    "cosine": (lambda x: math.cos(x) - x, 0.0, 2.0),
    "cube": (lambda x: x**3 - 2.0, -3.0, 2.0),
    "flat": (lambda x: math.exp(-50.0 * x) - 1e-9, 0.0, 1.0),
    "falling": (lambda x: 1.0 / x - 3.0, 1e-3, 9.0),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_agrees_with_scipy(name):
    function, low, high = FUNCTIONS[name]
    root = root_between(function, low, high, 1e-15)
    assert root == pytest.approx(brentq(function, low, high, xtol=1e-15, rtol=9e-16), rel=2e-15)


def test_a_step_is_found_within_rounding():
    print("seed 5")
    for place in np.random.default_rng(5).uniform(-1.0, 1.0, 50):
        calls = []

        def step(x, place=place, calls=calls):
            calls.append(x)
            return 1.0 if x > place else -1.0

        assert root_between(step, -1.0, 1.0, 1e-15) == pytest.approx(place, abs=1e-15)
        assert len(calls) < 70


def test_one_sign_is_refused():
    with pytest.raises(ValueError, match=r"^low, high: the function has one sign at 1 and 2"):
        root_between(lambda x: x, 1.0, 2.0, 1e-9)
