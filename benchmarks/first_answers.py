"""What a first answer costs: processor seconds of whole processes, with empty caches and again.

A cold process finds no machine code of this package, none of Numba and no caches of a user: it is a container, a node
of a cluster, a run of CI. ``python -m benchmarks.first_answers`` writes docs/first_answers.md; names after it choose.
"""

import os
import platform
import re
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

PAGE = Path(__file__).parent.parent / "docs" / "first_answers.md"
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
    command("`paper`", "paper", "--out", "paper", cold=40.0, warm=40.0),
)  # fmt: skip


def environment(caches: Path) -> dict[str, str]:
    """Variables of a process whose caches are all in a folder."""
    for name in EMPTY_CACHES:
        (caches / name).mkdir(exist_ok=True)
    ours = ("PENDULAR_", "NUMBA_", "PYTHONDONTWRITEBYTECODE")
    kept = {name: value for name, value in os.environ.items() if not name.startswith(ours)}
    return kept | {name: str(caches / name) for name in EMPTY_CACHES} | {"MPLBACKEND": "agg"}


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


def medians(measure: Callable[[Path], float], ready: Path) -> tuple[float, float]:
    """Medians of a figure with empty caches, and with all machine code made ahead; one of each of what takes long."""
    found: list[list[float]] = [[], []]
    for figures, caches in zip(found, (None, ready), strict=True):
        while len(figures) < (ROUNDS if not figures or figures[0] < LONG else 1):
            with tempfile.TemporaryDirectory() as empty:
                figures.append(measure(caches or Path(empty)))
    return statistics.median(found[0]), statistics.median(found[1])


def time_of(arguments: tuple[str, ...]) -> Callable[[Path], float]:
    """How the processor time of a process is measured, [s]."""

    def measure(caches: Path) -> float:
        with tempfile.TemporaryDirectory() as folder:
            return seconds(arguments, caches, Path(folder))

    return measure


def of_call(call: str, ready: Path) -> tuple[float, float]:
    """Time of a scalar call in Python, with no machine code there and with it loaded, [ms]."""

    def answers(caches: Path) -> tuple[float, float]:
        own = environment(caches)
        script = TIMED.replace("CALL", call)
        done = subprocess.run([sys.executable, "-c", script], env=own, capture_output=True, text=True, check=True)
        first, later = map(float, done.stdout.split())
        return first, later

    return medians(lambda caches: answers(caches)[0 if caches != ready else 1], ready)


def row(name: str, cold: float, warm: float, goals: tuple[float, float], floor: float = 0.0, unit: str = "s") -> str:
    """A line of the table, with what meets its goal and what does not; a floor is what every process takes."""
    digits = 2 if unit == "s" else 3

    def shown(value: float, goal: float) -> str:
        mark = "" if value <= goal else " ✗"
        return f"{value:.{digits}f} {unit}{mark} | {goal:g} {unit}"

    above = f"{cold - floor:.2f} s" if unit == "s" else ""
    return f"| {name} | {shown(cold, goals[0])} | {shown(warm, goals[1])} | {above} |"


def processor() -> str:
    """Name of the processor."""
    with Path("/proc/cpuinfo").open(encoding="utf-8") if Path("/proc/cpuinfo").exists() else open(os.devnull) as file:
        named = re.search(r"model name\s*:\s*(.+)", file.read())
    return named[1] if named else platform.processor() or platform.machine()


def page(chosen: list[str]) -> str:
    """Measure, and write the page."""
    with tempfile.TemporaryDirectory() as empty:
        floors = [seconds(("-c", "pass"), Path(empty), Path(empty)) for _ in range(2 * ROUNDS + 1)]
    floor = statistics.median(floors)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        ready = Path(folder)
        compiling = time_of(COMPILE)(ready)
        for question in QUESTIONS:
            if not chosen or any(part in question.name for part in chosen):
                found = medians(time_of(question.arguments), ready)
                rows.append(row(question.name, *found, (question.cold, question.warm), floor))
                sys.stderr.write(rows[-1] + "\n")
        for name, call in CALLS.items():
            if not chosen or "call" in chosen:
                goals = (GOALS["call cold"], GOALS["call warm"])
                rows.append(row(name, *of_call(call, ready), goals, unit="ms"))
    versions = ", ".join(f"{name} {version(name.lower())}" for name in ("NumPy", "Numba", "Matplotlib"))
    return f"""# What a first answer costs

Written by `python -m benchmarks.first_answers`: processor seconds of the whole process, all its threads, on
{processor()}, {platform.system()}, Python {platform.python_version()}, {versions}. *Cold* is
a process that finds no machine code and no other cache of a user, as in a fresh container, on a node of a cluster or
in CI; the byte code of Python is there, as an installation leaves it. *Warm* is a process that finds all machine code,
made by `pendular compile` in {compiling:.0f} s. Medians of {ROUNDS}; of what takes more than {LONG:g} s, one run.
`python -c pass` takes {floor:.3f} s here; the last column is what a cold process takes beyond it.
A ✗ marks what misses its goal.

| | cold | goal | warm | goal | cold, beyond `pass` |
|---|---:|---:|---:|---:|---:|
{chr(10).join(rows)}

A few questions are answered in plain Python, by the kernels as they stand, and compile nothing. Many are answered by
machine code, which is made once on a machine, or [ahead of time](howto/compile_ahead.md).
"""


if __name__ == "__main__":
    text = page(sys.argv[1:])
    sys.stdout.write(text)
    if not sys.argv[1:]:
        PAGE.write_text(text, encoding="utf-8")
