"""Rows in plain Python and by machine code: the same answers, and no compiler where there is none or it is no gain."""

import itertools
import json
import math
import os
import runpy
import subprocess
import sys

import numpy as np
import pytest

import pendular as pl
from pendular.exact import batch
from pendular.exact.equations import SUCTION, VOLUME, Held
from pendular.exact.guess import guess_at
from pendular.exact.newton import newton_to
from pendular.exact.solids import solid_of
from pendular.exact.state import State
from pendular.ground import calling, native, rows, stamp

SEED = 20261129
COMPILER = pytest.mark.needs("numba")
ASKED = {"stable": batch.STABLE, "unstable": batch.UNSTABLE, "rupture": batch.RUPTURE, "lower": batch.LOWER_END}
FLAT = {"stiffness"}  # infinite at the end of a branch, and steep next to it
WITHOUT_NUMBA = """
import sys
from importlib.abc import MetaPathFinder

class NoCompiler(MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in ("numba", "llvmlite"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

sys.meta_path.insert(0, NoCompiler())
from pendular.ground import compile, native
compile.find_spec = lambda name: None
"""


def questions(control, count=12):
    """Random pairs, a fifth of them mirror images, at a small part of their scale apart."""
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED + control)
    k2, angles = random.uniform(0.0, 1.0, count), np.radians(random.uniform(0.0, 90.0, (2, count)))
    k2[: count // 4], angles[1, : count // 4] = 1.0, angles[0, : count // 4]
    value = 10.0 ** (random.uniform(-8, 0, count) if control == VOLUME else random.uniform(-2, 4, count))
    gap = 0.2 * np.cbrt(value) if control == VOLUME else 0.1 / (1.0 + value)
    return np.column_stack([gap, value, np.ones(count), angles[0], k2, angles[1]])


@pytest.fixture
def plain(monkeypatch):
    """Everything in plain Python."""

    def ask(*question):
        with monkeypatch.context() as patch:
            patch.setattr(rows, "_machine_code", lambda *_: None)
            return batch.answer(*question)

    return ask


@pytest.fixture
def by_machine():
    """Everything by machine code."""

    def ask(*question):
        with rows.by_machine_code():
            return batch.answer(*question)

    return ask


@COMPILER
@pytest.mark.parametrize("asked", ASKED)
@pytest.mark.parametrize("control", [SUCTION, VOLUME])
def test_plain_python_and_machine_code_agree(control, asked, plain, by_machine):
    question = questions(control)
    plainly, plain_statuses = plain(ASKED[asked], control, question)
    compiled, statuses = by_machine(ASKED[asked], control, question)
    np.testing.assert_array_equal(plain_statuses, statuses)
    tolerance = 1e-14 if asked == "stable" else 1e-9  # where the slope at the end of a branch vanishes
    for field in set(State._fields) - FLAT:
        column = State._fields.index(field)
        np.testing.assert_allclose(plainly[:, column], compiled[:, column], rtol=tolerance, atol=1e-12, err_msg=field)


def spread(control):
    """Questions from overlap to beyond rupture, planes among them, and solids that hold nothing."""
    random = np.random.default_rng(SEED + 10 + control)
    question = questions(control, 40)
    question[:, 0] *= random.uniform(-0.2, 12.0, len(question))
    question[::13, 4] = 0.0
    question[::17, 3] = 3.0
    return question


@pytest.mark.parametrize("asked", ["stable", "rupture"])
@pytest.mark.parametrize("control", [SUCTION, VOLUME])
@pytest.mark.parametrize("way", ["plain", pytest.param("by_machine", marks=COMPILER)])
def test_parts_of_the_solver_answer_as_the_whole(way, control, asked, request, monkeypatch):
    """What the small parts answer in numbers of their own is what the whole would; they leave little to it."""
    ask, question, left = request.getfixturevalue(way), spread(control), []
    over_open = batch._over_open

    def watched(function, *rest):
        left.append(int(np.count_nonzero(rest[3] == batch.OPEN)))
        over_open(function, *rest)

    with monkeypatch.context() as patch:
        patch.setattr(batch, "_over_open", watched)
        in_parts, statuses = ask(ASKED[asked], control, question)
    assert left[0] == len(question)
    assert left[-1] < 0.25 * len(question), left
    monkeypatch.setattr(batch, "_over_open", lambda f, *rest: f is batch.bridge_range and over_open(f, *rest))
    whole, whole_statuses = ask(ASKED[asked], control, question)
    np.testing.assert_array_equal(statuses, whole_statuses)
    assert batch.FOUND in statuses
    assert batch.NO_BRIDGE in statuses or asked == "rupture"
    tolerance = 2e-13 if asked == "stable" else 1e-9  # where the slope at the end of a branch vanishes
    for field in set(State._fields) - FLAT:
        column = State._fields.index(field)
        np.testing.assert_allclose(in_parts[:, column], whole[:, column], rtol=tolerance, atol=1e-12, err_msg=field)


@COMPILER
@pytest.mark.parametrize("threads", ["1", "2", "5"])
def test_the_number_of_threads_changes_no_bit(threads, by_machine, monkeypatch):
    monkeypatch.setattr(batch, "_CHUNK", 7)
    monkeypatch.setattr(rows, "thread_count", lambda: int(threads))
    question = questions(VOLUME, 50)
    states, _ = by_machine(batch.STABLE, VOLUME, question)
    monkeypatch.setattr(batch, "_CHUNK", 1000)
    np.testing.assert_array_equal(states, by_machine(batch.STABLE, VOLUME, question)[0])


class Watched:
    """Code of an entry that tells which rows are asked of it, in which room."""

    def __init__(self, fails_at=-1):
        self.parts, self.fails_at = [], fails_at

    def of_rows(self, arguments):
        """As a function of start and stop."""
        return lambda start, stop: self.answer(start, stop, *arguments)

    def answer(self, start, stop, room):
        """Note the rows."""
        self.parts.append((start, stop, room))
        if start == self.fails_at:
            raise RuntimeError("it failed")


@pytest.mark.parametrize("threads", [2, 3, 40])
def test_threads_take_all_chunks_once_in_a_room_of_their_own(threads, monkeypatch):
    rooms, code = itertools.count(), Watched()
    monkeypatch.setattr(rows, "_machine_code", lambda *_: code)
    monkeypatch.setattr(rows, "thread_count", lambda: threads)
    rows.over_rows(None, 100, 7, rows.Own(lambda: next(rooms)))
    assert sorted(part[:2] for part in code.parts) == [(at, min(at + 7, 100)) for at in range(0, 100, 7)]
    assert next(rooms) == min(threads, 15)
    assert {room for *_, room in code.parts} <= set(range(min(threads, 15)))


@pytest.mark.parametrize("start", [0, 49, 98])
def test_an_error_of_one_thread_is_told(start, monkeypatch):
    monkeypatch.setattr(rows, "_machine_code", lambda *_: Watched(start))
    monkeypatch.setattr(rows, "thread_count", lambda: 3)
    with pytest.raises(RuntimeError, match="it failed"):
        rows.over_rows(None, 100, 7, 0)


ASK_WITH_THREADS = """
import os, sys, threading, warnings
import numpy as np
from pendular.ground import rows, threads
class Sum:
    def of_rows(self, arguments):
        return lambda start, stop: arguments[0].append(sum(range(start, stop)))
rows._machine_code, rows.thread_count = (lambda *_: Sum()), (lambda: 3)
def total():
    parts = []
    rows.over_rows(None, 10_000, 7, parts)
    return sum(parts)
wanted = sum(range(10_000))
assert total() == wanted
assert all(total() == wanted for _ in range(50))
assert threading.active_count() <= 3
askers = [threading.Thread(target=lambda: totals.append(total())) for _ in range(20)]
totals = []
for asker in askers:
    asker.start()
for asker in askers:
    asker.join()
assert totals == 20 * [wanted]
warnings.simplefilter("ignore", DeprecationWarning)  # of a fork beside threads
child = os.fork() if hasattr(os, "fork") else None
if child == 0:
    os._exit(0 if total() == wanted else 3)
assert child is None or os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
assert total() == wanted
"""


def test_threads_are_kept_shared_by_those_who_ask_at_once_and_new_in_a_child():
    done = subprocess.run(
        [sys.executable, "-c", ASK_WITH_THREADS], capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 0, done.stderr


ASK_A_FEW = """
import json, sys
import numpy as np
import pendular as pl
pair, liquid = pl.Pair(1.0, 0.3), pl.Liquid(surface_tension=1.0)
answers = [
    pl.bridge(pair, 0.01, volume=1e-3, liquid=liquid).force,
    pl.rupture(pair, suction=1.0, liquid=liquid).separation,
    pl.curve(pair, volume=1e-3, liquid=liquid, points=21).force[3],
    pl.bridge(pair, 0.01, suction=1.0, liquid=liquid).profile(5).y[2],
    float(pl.laws.force_star("willett2000", 0.01, 1e-3, 0.0, 0.0, 1.0, 1.0)),
    float(len(pl.compare(pair, volume=1e-3, liquid=liquid).laws)),
]
print(json.dumps([float(x) for x in answers] + ["numba" in sys.modules]))
"""


def answers_of(script):
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_a_few_questions_need_no_compiler():
    """One bridge, rupture, curve, profile, law and comparison in a fresh interpreter, and in one without Numba."""
    *with_numba, imported = answers_of(ASK_A_FEW)
    assert not imported
    *without, imported = answers_of(WITHOUT_NUMBA + ASK_A_FEW)
    assert not imported
    assert without == pytest.approx(with_numba, rel=1e-13)


def test_many_questions_are_answered_without_a_compiler_too():
    """A hundred bridges, contact forces and a table's force need no Numba, but time."""
    script = """
import json
import numpy as np
import pendular as pl
volume = np.geomspace(1e-6, 1e-2, 100)
bridge = pl.bridge(pl.Pair(1.0, 0.3), 0.0, volume=volume, liquid=pl.Liquid(surface_tension=1.0))
print(json.dumps([float(bridge.force.sum())]))
"""
    (found,) = answers_of(WITHOUT_NUMBA + script)
    volume = np.geomspace(1e-6, 1e-2, 100)
    force = pl.bridge(pl.Pair(1.0, 0.3), 0.0, volume=volume, liquid=pl.Liquid(surface_tension=1.0)).force
    assert found == pytest.approx(force.sum(), rel=1e-13)


@COMPILER
@pytest.mark.skipif(sys.platform == "win32", reason="no such mappings on Windows")
def test_memory_in_pieces_is_no_error(by_machine):
    """A process with room for numbers far from where it has room for code: 4 kB here and there, then none for 3 GB."""
    script = """
import json
from mmap import MAP_ANONYMOUS, MAP_PRIVATE, PROT_READ, PROT_WRITE, mmap
import pendular as pl
from pendular.ground import rows
rows._LOADING = 0.0
kinds = (PROT_READ, PROT_READ | PROT_WRITE)  # side by side they stay apart
pieces = [mmap(-1, 16384, MAP_PRIVATE | MAP_ANONYMOUS, prot=kinds[i % 2]) for i in range(400)]
large = [mmap(-1, 1 << 30, MAP_PRIVATE | MAP_ANONYMOUS, prot=PROT_READ) for _ in range(3)]
for piece in pieces[::2]:
    piece.close()
pair, liquid = pl.Pair(1.0, 0.3), pl.Liquid(surface_tension=1.0)
answers = [
    pl.bridge(pair, 0.01, volume=1e-3, liquid=liquid).force,
    pl.rupture(pair, volume=1e-3, liquid=liquid).separation,
    pl.curve(pair, volume=1e-3, liquid=liquid, points=21).force[3],
    pl.bridge(pair, 0.01, suction=1.0, liquid=liquid, branch="unstable").force,
]
print(json.dumps([float(x) for x in answers]))
"""
    found, (pair, liquid) = answers_of(script), (pl.Pair(1.0, 0.3), pl.Liquid(surface_tension=1.0))
    assert found[0] == pytest.approx(pl.bridge(pair, 0.01, volume=1e-3, liquid=liquid).force, rel=1e-13)
    assert found[1] == pytest.approx(pl.rupture(pair, volume=1e-3, liquid=liquid).separation, rel=1e-13)


@COMPILER
def test_who_keeps_asking_is_answered_by_machine_code(monkeypatch):
    chosen = []
    monkeypatch.setattr(native, "load", lambda *_: chosen.append("load"))
    monkeypatch.setattr(native, "build", lambda *_: chosen.append("build"))
    monkeypatch.setattr(rows, "_LOADING", 0.15)
    monkeypatch.setattr(rows, "_spent", dict.fromkeys(rows._spent, 0.0))
    batch.answer(batch.STABLE, SUCTION, questions(SUCTION, 2))
    assert chosen == []
    rows._spent[batch.stable_range] = 1.0
    batch.answer(batch.STABLE, SUCTION, questions(SUCTION, 2))
    assert chosen == ["load"]
    rows._spent[batch.stable_range] = 10.0
    batch.answer(batch.STABLE, SUCTION, questions(SUCTION, 2))
    assert chosen == ["load", "load", "build"]


@COMPILER
@pytest.mark.long
def test_what_is_compiled_ahead_is_found_on_disk_by_later_processes(tmp_path):
    """One file for each kind of kernel, and a later process that is not patient loads it in place of compiling."""
    environment = os.environ | {"PENDULAR_CACHE_DIR": str(tmp_path)}
    script = """
from itertools import islice
from pendular.front.ahead import compile_ahead
print(*islice(compile_ahead(), 2))
"""
    done = [
        subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=environment, check=True)
        for _ in range(2)
    ]
    assert [process.stdout.split() for process in done] == [["bridges", "and", "rupture", "curves"]] * 2
    assert sorted(path.stem.rpartition("_")[0] for path in tmp_path.glob("*.o")) == [
        "bridge_range",
        "curve_range",
        "end_range",
        "fields_range",
        "meridian_range",
        "restored_range",
        "stable_range",
        "summit_range",
    ]


# -- machine code on disk ----------------------------------------------------------------------------------------------

SMALL = """
import sys
from pathlib import Path
import numpy as np
from pendular.ground import native, rows
from own import double

compiled = native.object_of
def told(*question):
    with open(Path(__file__).with_name("compiled"), "a") as file:
        file.write("x")
    return compiled(*question)
native.object_of = told
out = np.zeros(3)
loads = native.load(double, (np.array([1.0, 2.0, 3.0]), out, 0, 3)) is not None
with rows.by_machine_code():
    rows.over_rows(double, 3, 2, np.array([1.0, 2.0, 3.0]), out)
result = float(out.sum()), int(loads)
print(*result)
"""
OWN = """
from factor import FACTOR
from pendular.ground.compile import kernel
from pendular.ground.rows import entry

@kernel
def doubled(x):
    return FACTOR * x

@entry(plain_cost=1.0)
def double(x, out, start, stop):
    for i in range(start, stop):
        out[i] = doubled(x[i])
"""


@pytest.fixture
def small(tmp_path):
    (tmp_path / "own.py").write_text(OWN)
    (tmp_path / "factor.py").write_text("FACTOR = 2.0\n")
    (tmp_path / "run.py").write_text(SMALL)
    return tmp_path


def started(folder, cache="kept"):
    environment = os.environ | {"PENDULAR_CACHE_DIR": str(folder / cache), "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.Popen(
        [sys.executable, "-W", "error", folder / "run.py"],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def finished(process):
    out, err = process.communicate(timeout=300)
    assert process.returncode == 0, err
    assert not err
    total, loads = out.split()
    return float(total), int(loads)


@pytest.fixture
def again(small, monkeypatch):
    """Run the script in this process, as if it were a new one: nothing of it is remembered but what is on disk."""
    remembered = stamp.stamp_of, stamp.source_stamp, stamp._sources_of
    monkeypatch.setattr(native, "folder", lambda: small / "kept")
    monkeypatch.setattr(native, "object_of", native.object_of)  # the script puts its own in its place
    monkeypatch.setattr(rows, "ENTRIES", [])
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.syspath_prepend(small)

    def forgotten():
        for module in ("own", "factor"):
            sys.modules.pop(module, None)
        for function in remembered:
            function.cache_clear()

    def run():
        forgotten()
        return runpy.run_path(str(small / "run.py"))["result"]

    yield run
    forgotten()


@COMPILER
def test_machine_code_of_other_source_is_not_used(small, again):
    assert again() == (12.0, 0)
    assert again() == (12.0, 1)
    (small / "factor.py").write_text("FACTOR = 5.0\n")
    assert again() == (30.0, 0)


@COMPILER
@pytest.mark.parametrize("damage", [lambda code: b"", lambda code: code[:-9], lambda code: code[:-1] + b"x"])
def test_damaged_machine_code_is_made_anew(small, again, damage):
    again()
    (file,) = (small / "kept").glob("*.o")
    file.write_bytes(damage(file.read_bytes()))
    assert again() == (12.0, 0)
    assert again() == (12.0, 1)


@COMPILER
def test_a_folder_that_cannot_be_written_only_costs_time(small, again):
    (small / "kept").write_text("a file")
    assert again() == (12.0, 0)
    assert again() == (12.0, 0)


@COMPILER
def test_of_processes_that_start_at_once_one_compiles(small):
    assert {finished(process)[0] for process in [started(small) for _ in range(3)]} == {12.0}
    assert (small / "compiled").read_text() == "x"
    assert finished(started(small)) == (12.0, 1)


def test_types_are_told_apart():
    row = np.zeros((3, 4))
    kinds = [row, row[:, ::2], row[0], row.astype(np.int8), 1, 1.0, True, (row, 1), np.broadcast_to(0.0, 3)]
    assert len({calling.types_of((kind,)) for kind in kinds}) == len(kinds)


@COMPILER
def test_an_infinite_stiffness_at_rupture_passes_through_machine_code(by_machine):
    states, statuses = by_machine(batch.RUPTURE, SUCTION, questions(SUCTION, 8))
    assert (statuses == batch.FOUND).all()
    assert (states[2:, State._fields.index("stiffness")] == -math.inf).all()


@pytest.mark.parametrize(("angle", "separation"), [(1.17, 0.59), (0.5, 0.32), (0.65, 0.78)])
def test_a_step_of_exactly_zero_is_no_error(angle, separation):
    """Newton's method from the bridge itself, between planes, in plain Python."""
    held = Held(solid_of(0.0, angle), solid_of(0.0, angle), VOLUME, 1.0)
    first, is_met = newton_to(guess_at(held, separation), separation, held, 14)
    assert is_met
    z = first
    for _ in range(5):
        z, is_met = newton_to(z, separation, held, 14)
        assert is_met
        np.testing.assert_allclose(z, first, rtol=0.0, atol=1e-14)


def test_an_exact_sphere_is_no_error(plain):
    """The drop of a pressure has no branch points, and no radius of curvature but one."""
    (state,), (status,) = plain(batch.STABLE, SUCTION, np.array([[0.02, -0.34, 1.0, 0.35, 1.0, 0.35]]))
    assert status == batch.FOUND
    assert state[State._fields.index("curvature")] == pytest.approx(-0.34)
