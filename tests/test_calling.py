"""Arguments of all kinds arrive in machine code as they are in Python."""

import gc
from typing import NamedTuple

import numpy as np
import pytest

from pendular.ground import calling, native
from pendular.ground.compile import kernel

pytestmark = pytest.mark.needs("numba")


class Inner(NamedTuple):
    """Some arguments."""

    row: np.ndarray
    weight: float


class Outer(NamedTuple):
    """More of them, among them others."""

    count: int
    inner: Inner
    flag: bool
    flags: np.ndarray


@kernel
def _fill(out, outer, pair, matrix, plain, start, stop):
    """Some of everything, that depends on each."""
    for i in range(start, stop):
        total = outer.inner.row[i] * outer.inner.weight + outer.count
        total += 1000.0 * outer.flags[i] if outer.flag else 0.25
        for j in range(matrix.shape[1]):
            total += matrix[i, j] * (j + 1)
        out[i] = total + pair[0][i] * pair[1] + plain.sum()


ROWS = 7


def arguments_of(random):
    """Arguments with arrays of any layout and size, that may be written to or not."""
    matrix = random.normal(size=(2 * ROWS, 6))
    matrices = [matrix[:ROWS], matrix[::2], matrix[:ROWS, ::-2], np.asfortranarray(matrix[:ROWS]), matrix[:ROWS, :0]]
    rows = [random.normal(size=ROWS), random.normal(size=3 * ROWS)[::3], random.normal(size=ROWS)[::-1]]
    rows.append(np.broadcast_to(random.normal(), ROWS))
    chosen = matrices[random.integers(len(matrices))]
    if random.random() < 0.5:
        chosen.flags.writeable = False
    inner = Inner(rows[random.integers(len(rows))], float(random.normal()))
    count = int(random.integers(-(2**40), 2**40))
    outer = Outer(count, inner, bool(random.random() < 0.5), random.integers(-9, 9, ROWS).astype(np.int8))
    pair = random.integers(-(2**62), 2**62, ROWS) // 2**50, random.normal()
    return np.empty(ROWS), outer, pair, chosen, random.normal(size=int(random.integers(3)))


def test_arguments_arrive_as_they_are():
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    kinds = set()
    for _ in range(40):
        arguments = arguments_of(random)
        out, *rest = arguments
        wanted = np.full(ROWS, -1.0)
        _fill(wanted, *rest, 1, ROWS)
        out[:] = -1.0
        native.build(_fill, (*arguments, 1, ROWS))(*arguments, 1, ROWS)
        np.testing.assert_allclose(out, wanted, rtol=1e-14)
        kinds.add(calling.types_of(arguments))
    assert len(kinds) > 5


def test_what_is_laid_out_stays_there_while_it_can_be_called():
    out, outer, pair, matrix, plain = arguments_of(np.random.default_rng(1))
    wanted = np.empty(ROWS)
    _fill(wanted, outer, pair, matrix, plain, 0, ROWS)
    code = native.build(_fill, (out, outer, pair, matrix, plain, 0, ROWS)).of_rows((out, outer, pair, matrix, plain))
    del outer, pair, matrix, plain
    np.ones((100, ROWS)).sum()
    code(0, ROWS)
    np.testing.assert_allclose(out, wanted, rtol=1e-14)


def test_arrays_are_let_go_with_the_call():
    """At once, not when the collector comes by: rooms of tens of MB would be asked of the system for each step."""
    out, *rest = arguments_of(np.random.default_rng(2))
    code = native.build(_fill, (out, *rest, 0, ROWS))
    code(out, *rest, 0, ROWS)
    assert not [other for other in gc.get_objects() if isinstance(other, tuple) and any(x is out for x in other)]


def test_what_no_word_stands_for_is_refused():
    out, outer, pair, matrix, plain = arguments_of(np.random.default_rng(3))
    code = native.build(_fill, (out, outer, pair, matrix, plain, 0, ROWS))
    with pytest.raises(TypeError, match="float32"):
        code.of_rows((out, outer, (pair[0], np.float32(0.5)), matrix, plain))
