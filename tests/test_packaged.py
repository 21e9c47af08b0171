"""Machine code in the package: a library that runs without Numba, made where a wheel is built."""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from pendular.front import ahead
from pendular.ground import linking, native, objects, packaged, rows, stamp

COMPILER = pytest.mark.needs("numba")
LINKER = pytest.mark.skipif(linking.linker() is None, reason="no C compiler to link a library with")
BUILT = pytest.mark.skipif(not packaged.FILE.exists(), reason="no machine code in the package: nox -s wheel")

OWN = """
from pendular.ground.rows import entry

@entry(plain_cost=1.0)
def scaled(factor, x, out, start, stop):
    for i in range(start, stop):
        out[i] = factor * x[i] ** 1.5
"""


@pytest.fixture
def scaled(tmp_path, monkeypatch):
    """An entry of its own, a folder without machine code, and a library that is not there yet."""
    (tmp_path / "own.py").write_text(OWN)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.setattr(rows, "ENTRIES", [])
    monkeypatch.setattr(native, "folder", lambda: tmp_path / "kept")
    monkeypatch.setattr(packaged, "FILE", tmp_path / "machine_code.so")
    packaged._library.cache_clear()
    import own

    yield own.scaled
    packaged._library.cache_clear()
    sys.modules.pop("own")
    for function in (stamp.source_stamp, stamp._sources_of):
        function.cache_clear()


def arguments():
    return 2.0, np.array([1.0, 4.0, 9.0]), np.zeros(3), 0, 3


def package(function):
    """Put machine code of an entry into the package."""
    with native.for_the_package() as made:
        native.build(function, arguments())
    native._loaded.clear()
    packaged.write(packaged.FILE, [objects.object_of_all(made, packaged.PROCESSOR)])
    return made


@COMPILER
@LINKER
def test_machine_code_of_the_package_answers_without_a_compiler(scaled, monkeypatch):
    assert len(package(scaled)) == 1
    monkeypatch.setattr(native, "has_compiler", lambda: False)
    monkeypatch.setattr(rows, "has_compiler", lambda: False)
    given = arguments()
    code = native.load(scaled, given)
    code(*given)
    assert given[2].tolist() == [2.0, 16.0, 54.0]
    rows.over_rows(scaled, 3, 1, *given[:3])
    assert native.load(scaled, given) is code
    assert not (native.folder()).exists()


@COMPILER
@LINKER
def test_what_is_made_for_this_processor_comes_before_that_of_the_package(scaled):
    package(scaled)
    assert native.load_own(scaled, arguments()) is None
    own = native.build(scaled, arguments())
    assert native.load(scaled, arguments()) is own
    native._loaded.clear()
    assert native.load_own(scaled, arguments()) is not None


@COMPILER
def test_a_kernel_may_be_compiled_under_several_names(scaled):
    codes = [objects.object_of(scaled, arguments(), name, objects.HOST) for name in ("one", "other", "one")]
    for name, code in zip(("one", "other", "one"), codes, strict=True):
        given = arguments()
        native._linked(name, code)(*given)
        assert given[2].tolist() == [2.0, 16.0, 54.0]
    with pytest.raises(RuntimeError, match="none"):
        native._linked("none", codes[0])


@COMPILER
def test_threads_may_load_machine_code_at_once(scaled):
    names = [f"kernel{i}" for i in range(4)]
    codes = [objects.object_of(scaled, arguments(), name, objects.HOST) for name in names]

    def answer(i):
        given = arguments()
        native._linked(names[i % 4], codes[i % 4])(*given)
        return given[2].tolist()

    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(answer, range(200))) == 200 * [[2.0, 16.0, 54.0]]


@COMPILER
@LINKER
def test_machine_code_of_other_source_or_types_is_not_used(scaled, tmp_path):
    package(scaled)
    short = 2.0, np.ones(3, np.float32), np.zeros(3), 0, 3
    assert native.load(scaled, short) is None
    (tmp_path / "own.py").write_text(OWN.replace("1.5", "2.5"))
    for function in (stamp.source_stamp, stamp._sources_of):
        function.cache_clear()
    assert native.load(scaled, arguments()) is None


@COMPILER
@LINKER
@pytest.mark.parametrize("fault", ["damaged", "of another processor"])
def test_a_library_that_does_not_run_here_is_not_used(scaled, fault, monkeypatch):
    if fault == "damaged":
        packaged.FILE.write_bytes(b"no library")
    else:
        monkeypatch.setattr(packaged, "_RUNS_HERE", "int pendular_runs_here(void) { return 0; }")
        package(scaled)
    assert native.load(scaled, arguments()) is None


def test_a_wheel_without_a_linker_is_refused_in_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(packaged, "linker", lambda: None)
    with pytest.raises(ValueError, match=r"^library: needs a C compiler, cc, gcc or clang, that links it$"):
        packaged.write(tmp_path / "machine_code.so", [])


@BUILT
@pytest.mark.parametrize("question", ahead.QUESTIONS)
def test_the_package_has_machine_code_of_all_entries(question, monkeypatch):
    absent, load = [], native.load

    def loaded(function, arguments):
        code = load(function, arguments)
        if code is None:
            absent.append(function.__name__)
        return code

    monkeypatch.setattr(native, "load", loaded)
    ahead.QUESTIONS[question]()
    assert not absent
