"""What a first answer costs: processor seconds of whole processes, with empty caches and again.

A cold process finds no caches of a user: it is a container, a node of a cluster, a run of CI. It is measured with the
machine code that a wheel brings along, and without it, as an installation from the source has none.
``python -m benchmarks.first_answers`` writes docs/first_answers.md; names after it choose. It needs an environment of
such a wheel (``nox -s wheel`` builds one): ``pip install "pendular-...-py3-none-....whl"``.
"""

import os
import platform
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

from benchmarks.sections import processor
from pendular.ground import packaged

ROOT = Path(__file__).parent.parent
PAGE = ROOT / "docs" / "first_answers.md"
ROUNDS = 3  # cold, and warm; of what takes long, one
LONG = 15.0  # s
GOALS = {"command": 0.6, "call cold": 20.0, "call warm": 0.2}  # s, ms, ms
PAIR = ("--radius", "50um", "--contact-angle", "20")
TABLE = "import pendular as pl; pl.tabulate(0.35)"
ADVANCE = "The solver is being prepared"  # what the page says until it can answer
EMPTY_CACHES = ("PENDULAR_CACHE_DIR", "NUMBA_CACHE_DIR", "MPLCONFIGDIR", "XDG_CACHE_HOME", "HOME")

TIMED = """
import time
import pendular as pl
pair, water = pl.Pair(radius=50e-6, contact_angle=0.35), pl.Liquid(surface_tension=0.0728)
def ask(count):
    begin = time.process_time()
    for i in range(count):
        CALL
    return 1e3 * (time.process_time() - begin) / count
ask(1)  # what is imported when it is first asked for
first = ask(5)
for _ in range(8):  # until machine code is worth its loading
    ask(50)
print(first, min(ask(200) for _ in range(5)))
"""
CALLS = {
    "a scalar `pl.bridge(...)` at a suction": "pl.bridge(pair, 1e-6 + 1e-9 * i, suction=20e3, liquid=water)",
    "a scalar `pl.bridge(...)` at a volume": "pl.bridge(pair, 1e-6 + 1e-9 * i, volume=5e-15, liquid=water)",
    "a scalar `pl.rupture(...)`": "pl.rupture(pair, suction=20e3 + i, liquid=water)",
}
MANY = """
import numpy as np
import pendular as pl
random = np.random.default_rng(1)
pl.bridge(pl.Pair(50e-6, 0.35), random.uniform(0, 2e-6, 10_000), suction=20e3, liquid=pl.Liquid(surface_tension=0.0728))
"""


class Question(NamedTuple):
    """A command, or a script, and the most that it may take with empty caches and afterwards, [s]."""

    name: str
    arguments: tuple[str, ...]
    cold: float
    warm: float = GOALS["command"]


def command(name: str, *arguments: str, cold: float, warm: float = GOALS["command"]) -> Question:
    """A command line."""
    entry = "import sys; from pendular.front.cli import main; main()"
    return Question(name, ("-c", entry, *arguments), cold, warm)


COMPILE = command("", "compile", cold=0.0).arguments
QUESTIONS = (
    command("`pendular --help`", "--help", cold=0.25, warm=0.25),
    command("`bridge` at a suction", "bridge", *PAIR, "--suction", "20kPa", "--separation", "1um", cold=1.0),
    command("`bridge` at a volume", "bridge", *PAIR, "--volume", "5pL", "--separation", "1um", cold=1.0),
    command("`bridge` at a humidity", "bridge", *PAIR, "--humidity", "90%", "--separation", "1nm", cold=1.0),
    command("`rupture` at a suction", "rupture", *PAIR, "--suction", "20kPa", cold=1.0),
    command("`rupture` at a volume", "rupture", *PAIR, "--volume", "5pL", cold=1.0),
    command("`curve` at a volume, with a picture", "curve", *PAIR, "--volume", "5pL", "--plot", "c.svg", cold=2.5),
    command("`compare`", "compare", *PAIR, "--volume", "1pL", cold=6.0),
    command(
        "`compare --recommend`", "compare", "--recommend", "--reduced-volume", "1e-4", "1e-2",
        "--contact-angle-range", "0", "40", cold=10.0,
    ),
    command("`compare --map`", "compare", "--map", "zhao2020", cold=10.0),
    command("`export c`", "export", "c", "--contact-angle", "20", "--out", "b.h", cold=20.0, warm=20.0),
    command("`export yade`", "export", "yade", "--contact-angle", "20", "--out", "tables", cold=20.0, warm=20.0),
    Question("`pl.tabulate(0.35)`", ("-c", TABLE), 20.0, 20.0),
    Question("10 000 bridges, one call of `pl.bridge`", ("-c", MANY), 20.0, GOALS["command"]),
    command("`explore`, until its first page", "explore", "--no-browser", "--port", "PORT", cold=3.0, warm=3.0),
    Question("`python -m studies.paper`", ("-m", "studies.paper", "--out", "paper"), 40.0, 40.0),
)  # fmt: skip


def environment(caches: Path) -> dict[str, str]:
    """Variables of a process whose caches are all in a folder."""
    for name in EMPTY_CACHES:
        (caches / name).mkdir(exist_ok=True)
    inherited = ("PENDULAR_", "NUMBA_", "PYTHONDONTWRITEBYTECODE")
    kept = {name: value for name, value in os.environ.items() if not name.startswith(inherited)}
    ours = {name: str(caches / name) for name in EMPTY_CACHES}
    return kept | ours | {"MPLBACKEND": "agg", "PYTHONPATH": str(ROOT)}  # where the studies stand


def seconds(arguments: tuple[str, ...], caches: Path, folder: Path) -> float:
    """Processor time of a process and all that it started, [s]."""
    port = free_port()
    arguments = tuple(str(port) if argument == "PORT" else argument for argument in arguments)
    process = subprocess.Popen(
        [sys.executable, *arguments],
        cwd=folder,
        env=environment(caches),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )
    if str(port) in arguments:
        threading.Thread(target=end_when_answered, args=(process, port), daemon=True).start()
    assert process.stderr is not None
    said = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0 and str(port) not in arguments:
        raise RuntimeError(f"{arguments} left with {process.returncode}: {said.decode()}")
    return usage.ru_utime + usage.ru_stime


def free_port() -> int:
    """Return a port that nobody listens on."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        return int(server.getsockname()[1])


def end_when_answered(process: subprocess.Popen[bytes], port: int) -> None:
    """End a server once its first page has come."""
    while process.poll() is None:
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/") as answer:
                page = answer.read().decode()
        except OSError:
            time.sleep(0.02)
            continue
        if ADVANCE not in page:  # the pair and its curve are on it
            break
        time.sleep(0.1)
    process.terminate()


class Found(NamedTuple):
    """A figure with empty caches, of a wheel with machine code and without it, and with all of it made here."""

    wheel: float
    source: float
    warm: float


def medians(measure: Callable[[Path], float], ready: Path) -> Found:
    """Medians of a figure; one of each of what takes long."""
    wheel = median_of(measure, None)
    with without_machine_code():
        return Found(wheel, median_of(measure, None), median_of(measure, ready))


def median_of(measure: Callable[[Path], float], caches: Path | None) -> float:
    """Median of a figure, with empty caches where none are given."""
    figures: list[float] = []
    while len(figures) < (ROUNDS if not figures or figures[0] < LONG else 1):
        with tempfile.TemporaryDirectory() as empty:
            figures.append(measure(caches or Path(empty)))
    return statistics.median(figures)


@contextmanager
def without_machine_code() -> Iterator[None]:
    """Put the machine code of the package aside, as if it were installed from its source."""
    aside = packaged.FILE.with_suffix(".aside")
    packaged.FILE.rename(aside)
    try:
        yield
    finally:
        aside.rename(packaged.FILE)


def time_of(arguments: tuple[str, ...]) -> Callable[[Path], float]:
    """How the processor time of a process is measured, [s]."""

    def measure(caches: Path) -> float:
        with tempfile.TemporaryDirectory() as folder:
            return seconds(arguments, caches, Path(folder))

    return measure


def of_call(call: str, ready: Path) -> Found:
    """Time of a scalar call in Python, with no machine code there and with it loaded, [ms]."""

    def answers(caches: Path) -> tuple[float, float]:
        own = environment(caches)
        script = TIMED.replace("CALL", call)
        done = subprocess.run([sys.executable, "-c", script], env=own, capture_output=True, text=True, check=True)
        first, later = map(float, done.stdout.split())
        return first, later

    return medians(lambda caches: answers(caches)[0 if caches != ready else 1], ready)


def row(name: str, found: Found, goals: tuple[float, float], unit: str = "s") -> str:
    """A line of the table, with what meets its goal and what does not."""
    digits = 2 if unit == "s" else 3

    def shown(value: float, goal: float) -> str:
        return f"{value:.{digits}f} {unit}{'' if value <= goal else ' ✗'}"

    cold, warm = goals
    cells = shown(found.wheel, cold), shown(found.source, cold), f"{cold:g} {unit}", shown(found.warm, warm)
    return f"| {name} | {' | '.join(cells)} | {warm:g} {unit} |"


def page(chosen: list[str]) -> str:
    """Measure, and write the page."""
    with tempfile.TemporaryDirectory() as empty:
        floors = [seconds(("-c", "pass"), Path(empty), Path(empty)) for _ in range(2 * ROUNDS + 1)]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        ready = Path(folder)
        compiling = time_of(COMPILE)(ready)
        for question in QUESTIONS:
            if not chosen or any(part in question.name for part in chosen):
                found = medians(time_of(question.arguments), ready)
                rows.append(row(question.name, found, (question.cold, question.warm)))
                sys.stderr.write(rows[-1] + "\n")
        for name, call in CALLS.items():
            if not chosen or "call" in chosen:
                rows.append(row(name, of_call(call, ready), (GOALS["call cold"], GOALS["call warm"]), unit="ms"))
    versions = ", ".join(f"{name} {version(name.lower())}" for name in ("NumPy", "Numba", "Matplotlib"))
    return f"""# What a first answer costs

Written by `python -m benchmarks.first_answers`: processor seconds of the whole process, all its threads, on
{processor()}, {platform.system()}, Python {platform.python_version()}, {versions}. *Cold* is
a process that finds no cache of a user, as in a fresh container, on a node of a cluster or in CI; the byte code of
Python is there, as an installation leaves it.
A wheel can [bring machine code along](howto/compile_ahead.md#in-a-wheel); an installation
from the source makes it when it first pays. *Warm* is a process that finds machine code made by
`pendular compile`, in {compiling:.0f} s, for this very processor. Medians of {ROUNDS}; of what takes more than
{LONG:g} s, one run. `python -c pass` takes {statistics.median(floors):.3f} s here. A ✗ marks what misses its goal.

| | cold, from a wheel with machine code | cold, from the source | goal | warm | goal |
|---|---:|---:|---:|---:|---:|
{chr(10).join(rows)}

A few questions are answered in plain Python, by the kernels as they stand, and compile nothing.
"""


if __name__ == "__main__":
    if not packaged.FILE.exists():
        sys.exit("first_answers: needs an installation with machine code: PENDULAR_MACHINE_CODE=1 uv build --wheel")
    text = page(sys.argv[1:])
    sys.stdout.write(text)
    if not sys.argv[1:]:
        PAGE.write_text(text, encoding="utf-8")
