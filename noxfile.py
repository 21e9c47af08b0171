"""What must hold, by name: ``uv run --group nox nox -s quick lint``, and ``nox -l`` for a list.

A session brings what it needs into the project's own environment and removes nothing from it, so that it starts at
once. Those that need another interpreter, or an environment that lacks something, make one of their own.
"""

import tempfile
import tomllib
from pathlib import Path

import nox

nox.needs_version = ">=2025.2.9"
nox.options.default_venv_backend = "none"
nox.options.reuse_existing_virtualenvs = True
nox.options.sessions = ["quick", "lint", "types", "imports"]

PROJECT = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))
VERSIONS = ("3.11", "3.12", "3.13", "3.14")
ON_ALL_CORES = ("-n", "auto")
WITHOUT_NUMBA = [line for line in PROJECT["project"]["dependencies"] if not line.startswith("numba")]
BRIDGE = ("bridge", "--radius", "50um", "--contact-angle", "20", "--suction", "20kPa", "--separation", "1um", "--json")
LARGEST_WHEEL = 1.5  # MB

# Kernels, laws and first answers: what has to be the same where Numba cannot be had, at a thousandth of the speed.
PLAIN = (
    "tests/test_root.py",
    "tests/test_check.py",
    "tests/test_public_names.py",
    "tests/test_rows.py",
    "tests/test_laws.py",
    "tests/test_plain_laws.py",
    "tests/test_two_planes.py",
    "tests/test_exact.py",
    "tests/test_stability.py",
    "tests/test_pressure.py",
    "tests/test_half_filling_angle.py",
    "tests/test_large_bridges.py",
    "tests/test_oracle.py",
)

# What machine code answers, in a wheel that has it.
MACHINE = (
    "tests/test_packaged.py",
    "tests/test_identities.py",
    "tests/test_hard_cases.py",
    "tests/test_table.py",
    "tests/test_packing.py",
    "tests/test_explorer.py",
)


def in_project(session: nox.Session, group: str, *command: str) -> None:
    """Run a command in the project's environment, with a dependency group brought into it."""
    session.run("uv", "run", "--group", group, *command, external=True)


@nox.session
def tests(session: nox.Session) -> None:
    """All tests, on all cores."""
    in_project(session, "test", "pytest", *ON_ALL_CORES, *session.posargs)


@nox.session
def quick(session: nox.Session) -> None:
    """Tests without the long ones."""
    in_project(session, "test", "pytest", *ON_ALL_CORES, "-m", "not long", *session.posargs)


@nox.session
def long(session: nox.Session) -> None:
    """The long tests alone."""
    in_project(session, "test", "pytest", *ON_ALL_CORES, "-m", "long", *session.posargs)


@nox.session
def lint(session: nox.Session) -> None:
    """Style."""
    in_project(session, "lint", "ruff", "check")
    in_project(session, "lint", "ruff", "format", "--check")


@nox.session
def types(session: nox.Session) -> None:
    """Types."""
    in_project(session, "all", "mypy")


@nox.session
def imports(session: nox.Session) -> None:
    """Direction of imports."""
    in_project(session, "lint", "lint-imports")


@nox.session
def site(session: nox.Session) -> None:
    """The site, warnings as errors, and each of its pages in Chromium and Firefox, from files and from a server."""
    in_project(session, "docs", "python", "-m", "tools.site")
    in_project(session, "all", "pytest", *ON_ALL_CORES, "tests/test_site_pages.py")


@nox.session(venv_backend="uv")
def without_numba(session: nox.Session) -> None:
    """Kernels, laws and first answers in plain Python, where neither Numba nor llvmlite is installed."""
    session.install(*WITHOUT_NUMBA, *PROJECT["dependency-groups"]["test"])
    session.install("--no-deps", "--editable", ".")
    session.run(
        "python", "-c", "from importlib.util import find_spec as f; assert not f('numba') and not f('llvmlite')"
    )
    session.run("pytest", *ON_ALL_CORES, "-m", "not long", *(session.posargs or PLAIN))


@nox.session(venv_backend="uv")
def wheel(session: nox.Session) -> None:
    """A wheel with machine code, and the source that it is built from, without Numba: kernels, tables and heaps."""
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder)
        session.run("uv", "build", "--quiet", "--out-dir", made, env={"PENDULAR_MACHINE_CODE": "1"}, external=True)
        (file,) = made.glob("*.whl")
        see_size(session, file)
        session.install(*WITHOUT_NUMBA, *PROJECT["dependency-groups"]["test"])
        session.install("--no-deps", "--reinstall", str(file))
    session.run("pytest", *ON_ALL_CORES, "-m", "not long", *(session.posargs or MACHINE))


@nox.session(venv_backend="uv")
def packages(session: nox.Session) -> None:
    """Source and wheel as they are published: checked as an index does, then each in an empty environment."""
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder)
        session.run("uv", "build", "--quiet", "--out-dir", made, external=True)
        (source,), (file,) = made.glob("*.tar.gz"), made.glob("*.whl")
        see_size(session, file)
        session.run("uv", "tool", "run", "twine", "check", "--strict", source, file, external=True)
        session.run("uv", "tool", "run", "cffconvert", "--validate", "-i", "CITATION.cff", external=True)
        for package in (source, file):
            session.run("uv", "venv", "--quiet", "--clear", session.virtualenv.location, external=True)
            session.install(package)
            session.run("pendular", *BRIDGE)


def see_size(session: nox.Session, wheel: Path) -> None:
    """Refuse a wheel of more than 1.5 MB."""
    size = wheel.stat().st_size / 1e6
    session.log(f"{wheel.name}: {size:.2f} MB")
    if size > LARGEST_WHEEL:
        session.error(f"{wheel.name} is larger than {LARGEST_WHEEL} MB")


@nox.session(venv_backend="uv", python=VERSIONS)
def pythons(session: nox.Session) -> None:
    """Tests without the long ones, in the light environment of each Python; uv brings those that are not there."""
    session.install("--editable", ".", *PROJECT["dependency-groups"]["test"])
    session.run("pytest", *ON_ALL_CORES, "-m", "not long", *session.posargs)
