"""The laws in C, compiled and beside their kernels: in their ranges, and far outside of them."""

import ctypes
import math
import shutil
import subprocess

import numpy as np
import pytest
from tools import law_in_c

from law_samples import by_name, reach, sample
from pendular.laws import laws
from pendular.laws._rows import answer_of

LAWS = list(laws.values())
COMPILER = shutil.which("gcc") or shutil.which("cc")
STRICT = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-ffp-contract=off")
SEED, COUNT = 20261130, 3000

needs_compiler = pytest.mark.skipif(COMPILER is None, reason="no C compiler on the path")


@pytest.fixture(scope="module")
def compiled(tmp_path_factory):
    """Functions of a law in a shared library, by quantity."""
    folder = tmp_path_factory.mktemp("laws")

    def functions(law):
        file, library = folder / f"{law.name}.c", folder / f"{law.name}.so"
        file.write_text(law_in_c.source(law), encoding="utf-8")
        subprocess.run([COMPILER, *STRICT, "-fPIC", "-shared", "-o", library, file, "-lm"], check=True)
        opened = ctypes.CDLL(str(library))
        found = {}
        for quantity in law.gives:
            function = getattr(opened, f"{law.name}_{law_in_c.QUANTITIES[quantity]}")
            function.argtypes = [ctypes.c_double] * (6 if takes_a_gap(quantity) else 5)
            function.restype = ctypes.c_double
            found[quantity] = function
        return found

    return functions


def takes_a_gap(quantity):
    return quantity in ("force", "damping")


def wild(count):
    """Questions that mostly make no sense: all orders of magnitude, all angles, negative gaps, nothing and NaN."""
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    rows = np.column_stack(
        [
            rng.choice([-1.0, 0.0, 1.0, 1.0], count) * 10.0 ** rng.uniform(-12, 12, count),
            rng.choice([-1.0, 1.0, 1.0, 1.0, 1.0], count) * 10.0 ** rng.uniform(-12, 12, count),
            rng.uniform(-0.5, 3.5, count),
            rng.uniform(-0.5, 3.5, count),
            *rng.uniform(0.0, 2.0, (2, count)),
        ]
    )
    rows[::3, 3] = rows[::3, 2]
    rows[::5, 4:] = 1.0
    rows[rng.integers(0, count, 50), rng.integers(0, 6, 50)] = math.nan
    return rows.tolist()


@needs_compiler
@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_c_answers_what_the_kernel_answers(law, compiled):
    functions = compiled(law)
    rng = np.random.default_rng(SEED)
    inside = [[rng.uniform(0.0, 1.1) * reach(law, row), *row] for row in sample(law, COUNT)]
    inside = [[0.0, *row[1:]] if i % 3 == 0 else row for i, row in enumerate(inside) if not math.isnan(row[0])]
    told = 0
    for quantity, function in functions.items():
        kernel = law.kernels[quantity]
        for row in [*inside, *wild(COUNT)]:
            arguments = row if takes_a_gap(quantity) else row[1:]
            plain, answer = answer_of(kernel, arguments), function(*arguments)
            if math.isnan(plain):
                assert not math.isfinite(answer), (quantity, arguments, answer)
            else:
                told += 1
                assert answer == pytest.approx(plain, rel=1e-12, abs=1e-300), (quantity, arguments)
    assert told > COUNT // 4


def test_what_has_no_c_is_refused():
    def kernel(x: float) -> float:
        return sum([x, x])

    with pytest.raises(ValueError, match="has no C here"):
        law_in_c._Function(kernel, {kernel: "kernel"}, laws["willett2000"]).text()


def test_the_command_prints_a_file(capsys, monkeypatch):
    monkeypatch.setattr("sys.argv", ["law_in_c", "lian1993"])
    law_in_c.main()
    assert capsys.readouterr().out == law_in_c.source(laws["lian1993"])
