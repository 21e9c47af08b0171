"""Compiled code on disk is used while it is right, made anew where it is not, and never a reason to fail."""

import ast
import os
import subprocess
import sys
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
print(scaled(np.array([1.0, 4.0]), 1), sum(scaled.stats.cache_hits.values()))
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


def test_a_second_process_compiles_nothing(script):
    assert answer(script) == (8.0, 0)
    assert answer(script) == (8.0, 1)


@pytest.mark.parametrize("damage", [lambda b: b"", lambda b: b[: len(b) // 2], lambda b: b[:-9] + b"damaged!!"])
def test_damaged_files_are_written_anew(script, damage):
    answer(script)
    for kind in ("nbc", "nbi"):
        for path in (script.parent / "kept").rglob(f"*.{kind}"):
            path.write_bytes(damage(path.read_bytes()))
        assert answer(script) == (8.0, 0), kind
    assert answer(script) == (8.0, 1)


def test_code_of_another_processor_or_function_is_not_run(script):
    """All data files exchanged: each is whole, and none is what its index says."""
    answer(script)
    files = sorted((script.parent / "kept").rglob("*.nbc"))
    assert len(files) > 1
    contents = [path.read_bytes() for path in files]
    for path, content in zip(files, contents[1:] + contents[:1], strict=True):
        path.write_bytes(content)
    assert answer(script) == (8.0, 0)


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
    assert {finished(process)[0] for process in [started(script) for _ in range(6)]} == {8.0}
    assert answer(script) == (8.0, 1)


def test_a_neighbour_of_ones_own_kernel_outdates_it(script):
    assert answer(script)[0] == 8.0
    changed_in_silence(script.parent / "factor.py", "2.0", "3.0")
    assert answer(script) == (12.0, 0)


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


@pytest.mark.parametrize(
    ("file", "before", "after", "expected"),
    [
        (
            "ground/rows.py",
            "return float(operand[min(i, operand.size - 1)])",
            "return float(operand[min(0, operand.size - 1)])",
            2.0,
        ),
        ("rooms/constants.py", "2.0", "5.0", 20.0),
    ],
)
def test_a_change_anywhere_below_a_kernel_outdates_it(small_package, file, before, after, expected):
    alone = {"PYTHONDONTWRITEBYTECODE": "1"}
    assert answer(small_package, **alone)[0] == 8.0
    changed_in_silence(small_package.parent / "pendular" / file, before, after)
    assert answer(small_package, **alone) == (expected, 0)


def test_a_change_beside_it_does_not(small_package):
    answer(small_package)
    changed_in_silence(small_package.parent / "pendular" / "page.py", "no", "0 ")
    assert answer(small_package) == (8.0, 1)


def parsed_imports(path, modules):
    """Modules of the package that a file imports, by Python's own parser."""
    name = stamp._module_name(path)
    package = name if path.stem == "__init__" else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom):
            origin = resolve_name("." * node.level + (node.module or ""), package)
            yield from {origin, *(f"{origin}.{alias.name}" for alias in node.names)} & set(modules)
        elif isinstance(node, ast.Import):
            yield from {alias.name for alias in node.names} & set(modules)


def test_the_stamp_covers_all_that_a_kernel_can_reach():
    modules = {stamp._module_name(path): path for path in PACKAGE.rglob("*.py")}
    with_kernels = [path for path in modules.values() if "@kernel\n" in path.read_text()]
    assert len(with_kernels) > 30
    for path in with_kernels:
        covered = stamp._sources_of(path)
        assert {path, PACKAGE / "ground" / "compile.py"} <= covered
        for source in covered:
            assert {modules[name] for name in parsed_imports(source, modules)} <= covered, (path, source)
