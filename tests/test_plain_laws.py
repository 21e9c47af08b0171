"""Laws without the compiler: the same source as plain Python answers as the compiled functions do."""

import math

import numpy as np
import pytest

from law_samples import by_name, kappas
from pendular.ground.compile import compiled
from pendular.laws import laws
from pendular.laws._rows import answer_of

SEED = 20260117
LAWS = list(laws.values())
SPECIAL = (0.0, -1.0, math.nan, math.inf, -math.inf, 1e-300, 1e300, 5e-324, math.pi / 2, math.nextafter(math.pi / 2, 0))


def asked(law, quantity, rng):
    """A question from anywhere: within the range of a law, far beyond it, and where nothing has a meaning."""
    control = 10.0 ** (rng.uniform(-12.0, 12.0) if rng.random() < 0.7 else rng.uniform(-300.0, 300.0))
    angles = rng.uniform(0.0, 0.5 * math.pi, 2)
    if rng.random() < 0.7:
        angles[1] = angles[0] = rng.choice([0.0, angles[0]])
    pair = [control, *angles.tolist(), *kappas(rng.choice([1.0, rng.uniform(1.0, 100.0), 1e15, math.inf]))]
    if rng.random() < 0.2:
        pair[rng.integers(3)] = SPECIAL[rng.integers(len(SPECIAL))]
    if quantity not in ("force", "damping"):
        return pair
    gap = 10.0 ** rng.uniform(-12.0, 3.0) * rng.choice([0.0, 1.0, 1.0, 1.0, -1.0])
    if law.rupture_star and rng.random() < 0.5:
        gap = answer_of(law.rupture_star, [float(number) for number in pair]) * rng.uniform(0.0, 1.05)
    if rng.random() < 0.05:
        gap = SPECIAL[rng.integers(len(SPECIAL))]
    return [gap, *pair]


# Worst measured in 20 000 questions: 3e-15, toroidal2020 with overlapping solids 6e-13, bagheri2024 4e-12 where two
# powers cancel. The expansion for large suction is asked at any: where the suction is small and contact grazing its
# fold is lost in rounding, 2e-10.
LARGEST = {"asymptotic": 1e-8, "bagheri2024": 1e-10, "toroidal2020": 1e-10}


@pytest.mark.needs("numba")
@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_plain_python_answers_as_compiled(law):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    for quantity, kernel in law.kernels.items():
        by_numba = compiled(kernel)
        answered = 0
        for _ in range(1500):
            arguments = [float(number) for number in asked(law, quantity, rng)]  # no scalars of NumPy: they warn
            expected = by_numba(*arguments)
            assert answer_of(kernel, arguments) == pytest.approx(
                expected, rel=LARGEST.get(law.name, 1e-14), abs=0.0, nan_ok=True
            ), arguments
            answered += not math.isnan(expected)
        assert answered > 50


def test_largest_force_that_a_sphere_holds_is_no_answer_to_another_question():
    """Newton's steps that begin at that force, where the gap has no slope, ended there: 19.026."""
    force = laws["asymptotic"].force_star
    assert force(-1.0, 36.0521913149635, 0.0, 0.0, 1.0, 1.0) == pytest.approx(14.515644, rel=1e-6)
    assert force(-1.0, 36.0521913149635, 0.0, 0.0, 1.0, 1.0) == pytest.approx(
        force(-1.0 + 1e-9, 36.0521913149635, 0.0, 0.0, 1.0, 1.0), rel=1e-8
    )


@pytest.mark.parametrize("name", ["bagheri2024", "willett2000"])
def test_no_force_is_infinite(name):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    law = laws[name]
    for exponent in rng.uniform(-300.0, 300.0, 2000):
        volume, angle = 10.0**exponent, rng.uniform(0.0, 1.5)
        gap = rng.choice([0.0, rng.uniform(0.0, 1.0)]) * law.rupture_star(volume, angle, angle, 1.0, 1.0)
        assert not math.isinf(law.force_star(gap, volume, angle, angle, 1.0, 1.0))
