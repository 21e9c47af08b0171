"""Compiled code on disk is used while it is right, made anew where it is not, and never a reason to fail."""

import ast
import os
import runpy
import subprocess
import sys
from functools import cache
from importlib.util import resolve_name
from pathlib import Path
from shutil import copy

import pytest

import pendular
from pendular.ground import cache as _cache
from pendular.ground import stamp

PACKAGE = Path(pendular.__file__).parent
OWN_KERNEL = """
from pendular.ground.compile import compiled, kernel
from pendular.ground.rows import element
from factor import FACTOR
import numpy as np

@kernel
def scaled(operand, i):
    return FACTOR * element(operand, i)

scaled = compiled(scaled)
result = scaled(np.array([1.0, 4.0]), 1), sum(scaled.stats.cache_hits.values())
print(*result)
"""
ALONE = """
import numpy as np
from pendular.ground.compile import compiled
from pendular.rooms.law import force
force = compiled(force)
print(force(np.array([1.0, 4.0]), 1), sum(force.stats.cache_hits.values()))
"""
LAW = """
from ..ground.compile import kernel
from ..ground.rows import element
from .constants import (  # as the laws have them
    FACTOR,
)

@kernel
def force(operand, i):
    return FACTOR * element(operand, i)
"""


@pytest.fixture
def script(tmp_path):
    """A kernel of one's own that uses one of the package and a constant of a neighbour."""
    (tmp_path / "factor.py").write_text("FACTOR = 2.0\n")
    path = tmp_path / "own.py"
    path.write_text(OWN_KERNEL)
    return path


def started(path, **environment):
    return subprocess.Popen(
        [sys.executable, "-W", "error", path],
        env=os.environ | {"NUMBA_CACHE_DIR": str(path.parent / "kept")} | environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def finished(process):
    """The number that a script printed, and how often a kernel came from disk."""
    out, err = process.communicate(timeout=300)
    assert process.returncode == 0, err
    assert not err
    number, loads = out.split()
    return float(number), int(loads)


def answer(path, **environment):
    return finished(started(path, **environment))


@pytest.fixture
def again(script, monkeypatch):
    """Run the script in this process, as if it were a new one: nothing of it is remembered but what is on disk."""
    config = pytest.importorskip("numba.core.config")
    monkeypatch.setattr(config, "CACHE_DIR", str(script.parent / "kept"))
    monkeypatch.syspath_prepend(script.parent)

    def run():
        sys.modules.pop("factor", None)
        for remembered in (stamp.stamp_of, stamp.source_stamp, stamp._sources_of, stamp._modules, stamp._imported_by):
            remembered.cache_clear()
        return runpy.run_path(str(script))["result"]

    yield run
    sys.modules.pop("factor", None)


@pytest.mark.parametrize("damage", [lambda b: b"", lambda b: b[: len(b) // 2], lambda b: b[:-9] + b"damaged!!"])
def test_damaged_files_are_written_anew(script, again, damage):
    again()
    for kind in ("nbc", "nbi"):
        for path in (script.parent / "kept").rglob(f"*.{kind}"):
            path.write_bytes(damage(path.read_bytes()))
        assert again() == (8.0, 0), kind
    assert again() == (8.0, 1)


def test_code_of_another_processor_or_function_is_not_run(script, again):
    """All data files exchanged: each is whole, and none is what its index says."""
    again()
    script.write_text(OWN_KERNEL.replace("scaled", "other"))
    again()
    script.write_text(OWN_KERNEL)
    files = sorted((script.parent / "kept").rglob("*.nbc"))
    assert len(files) > 1
    contents = [path.read_bytes() for path in files]
    for path, content in zip(files, contents[1:] + contents[:1], strict=True):
        path.write_bytes(content)
    assert again() == (8.0, 0)


def test_two_that_save_at_once_do_not_answer_for_each_other(tmp_path):
    one, other = (_cache._SealedFiles(str(tmp_path), "kernel", "stamp") for _ in range(2))
    one.save("for one", 1)
    index = (tmp_path / "kernel.nbi").read_bytes()
    (tmp_path / "kernel.nbi").unlink()  # as it looked to the other when that began to save
    other.save("for the other", 2)
    assert other.load("for the other") == 2
    (tmp_path / "kernel.nbi").write_bytes(index)
    assert one.load("for one") is None
    one.save("for one", 1)
    assert one.load("for one") == 1


def test_without_any_folder_it_compiles(script):
    (script.parent / "__pycache__").write_text("a file, where no folder can be made")
    nowhere = {"NUMBA_CACHE_DIR": os.devnull, "XDG_CACHE_HOME": os.devnull}
    assert answer(script, **nowhere) == (8.0, 0)


def test_the_users_own_folder_serves_a_package_that_cannot_be_written(script):
    (script.parent / "__pycache__").write_text("a file, where no folder can be made")
    where = {"NUMBA_CACHE_DIR": "", "XDG_CACHE_HOME": str(script.parent / "home")}
    assert answer(script, **where)[0] == 8.0
    assert answer(script, **where) == (8.0, 1)


def test_a_folder_that_goes_while_the_kernel_compiles(script):
    script.write_text(
        OWN_KERNEL.replace(
            "print(",
            "import pathlib, shutil; kept = pathlib.Path(__file__).parent / 'kept'\n"
            "shutil.rmtree(kept); kept.write_text('')\nprint(",
        )
    )
    assert answer(script) == (8.0, 0)


def test_many_processes_on_an_empty_cache(script):
    assert {finished(process)[0] for process in [started(script) for _ in range(3)]} == {8.0}
    assert answer(script) == (8.0, 1)


def test_a_neighbour_of_ones_own_kernel_outdates_it(script, again, monkeypatch):
    monkeypatch.setattr(sys, "dont_write_bytecode", True)  # Python trusts size and times
    assert again() == (8.0, 0)
    changed_in_silence(script.parent / "factor.py", "2.0", "3.0")
    assert again() == (12.0, 0)


@pytest.fixture
def small_package(tmp_path):
    """The compile decorator with one law in another folder, and a script that asks it."""
    package = tmp_path / "pendular"
    (package / "rooms").mkdir(parents=True)
    (package / "ground").mkdir()
    for file in (PACKAGE / "ground").glob("*.py"):
        copy(file, package / "ground")
    (package / "__init__.py").touch()
    (package / "rooms" / "__init__.py").touch()
    (package / "rooms" / "constants.py").write_text("FACTOR = 2.0\n")
    (package / "rooms" / "law.py").write_text(LAW)
    (package / "page.py").write_text("TITLE = 'no kernel'\n")
    path = tmp_path / "alone.py"
    path.write_text(ALONE)
    return path


def changed_in_silence(path, before, after):
    """Change a file, and leave its size and its times as they are."""
    times = path.stat()
    text = path.read_text()
    assert before in text
    assert len(before) == len(after)
    path.write_text(text.replace(before, after))
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))


def test_a_change_anywhere_below_a_kernel_outdates_it_and_one_beside_it_does_not(small_package):
    alone = {"PYTHONDONTWRITEBYTECODE": "1"}
    package = small_package.parent / "pendular"
    assert answer(small_package, **alone) == (8.0, 0)
    changed_in_silence(package / "page.py", "no", "0 ")
    assert answer(small_package, **alone) == (8.0, 1)
    changed_in_silence(package / "rooms" / "constants.py", "2.0", "5.0")
    assert answer(small_package, **alone) == (20.0, 0)
    changed_in_silence(package / "ground" / "rows.py", "min(i, operand.size - 1)", "min(0, operand.size - 1)")
    assert answer(small_package, **alone) == (5.0, 0)


@cache
def parsed_imports(path):
    """All that the imports of a file may name, by Python's own parser."""
    name = stamp._module_name(path)
    package = name if path.stem == "__init__" else name.rpartition(".")[0]
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom):
            origin = resolve_name("." * node.level + (node.module or ""), package)
            names |= {origin, *(f"{origin}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
    return names


def test_the_stamp_covers_all_that_a_kernel_can_reach():
    modules = {stamp._module_name(path): path for path in PACKAGE.rglob("*.py")}
    with_kernels = [path for path in modules.values() if "@kernel\n" in path.read_text()]
    assert len(with_kernels) > 30
    for path in with_kernels:
        covered = stamp._sources_of(path)
        assert {path, PACKAGE / "ground" / "compile.py"} <= covered
        for source in covered:
            assert {modules[name] for name in parsed_imports(source) & set(modules)} <= covered, (path, source)


@pytest.mark.parametrize(
    ("kernels", "written"), [("exact/abreast.py", "ground/vectors.py"), ("table/kernels.py", "table/lanes.py")]
)
def test_the_stamp_covers_where_the_compiled_form_of_a_kernel_is_written(kernels, written):
    assert PACKAGE / written in stamp._sources_of(PACKAGE / kernels)


@pytest.mark.parametrize("room", ["exact", "laws", "table"])
def test_no_kernel_depends_on_what_is_above_it(room):
    """Else a change of a command would compile the solver anew."""
    solver = {"exact", "ground"}
    below = {"exact": solver, "laws": solver | {"laws"}, "table": solver | {"table", "_version.py"}}
    for path in (PACKAGE / room).rglob("*.py"):
        if "@kernel\n" in path.read_text():
            reached = {source.relative_to(PACKAGE).parts[0] for source in stamp._sources_of(path)}
            assert reached <= below[room], path
