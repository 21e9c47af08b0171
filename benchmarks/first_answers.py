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
EMPTY_CACHES = ("PENDULAR_CACHE_DIR", "NUMBA_CACHE_DIR", "MPLCONFIGDIR", "XDG_CACHE_HOME", "HOME")

CALL = """
import statistics, sys, time
import pendular as pl
pair, water = pl.Pair(radius=50e-6, contact_angle=0.35), pl.Liquid(surface_tension=0.0728)
def ask(i):
    begin = time.process_time()
    pl.bridge(pair, 1e-6 + 1e-9 * i, suction=20e3, liquid=water)
    return 1e3 * (time.process_time() - begin)
ask(0)  # what is imported when it is first asked for
first = statistics.median(ask(i) for i in range(1, 6))
begin = time.process_time()
i = 0
while time.process_time() - begin < 0.8:  # until machine code is worth its loading
    ask(i := i + 1)
print(first, statistics.median(ask(i) for i in range(1000)))
"""
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
        raise RuntimeError(f"{arguments}: {said.decode()}")
    return usage.ru_utime + usage.ru_stime


def free_port() -> int:
    """Return a port that nobody listens on."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        return int(server.getsockname()[1])


def end_when_answered(process: subprocess.Popen[bytes], port: int) -> None:
    """End a server once its page holds the pair and its curve, or says that it cannot."""
    from playwright.sync_api import sync_playwright  # the page is filled in by a browser

    url = f"http://127.0.0.1:{port}/"
    with sync_playwright() as play, play.chromium.launch() as browser:
        while process.poll() is None:
            try:
                urllib.request.urlopen(url).close()
                break
            except OSError:
                time.sleep(0.02)
        page = browser.new_page()
        page.goto(url)
        page.wait_for_selector(".js-plotly-plot", timeout=300_000)
        process.terminate()


def medians(measure: Callable[[Path, Path], tuple[float, float]]) -> tuple[float, float]:
    """Medians of figures with empty caches, and with what the process before has left in them."""
    found = []
    for _ in range(ROUNDS):
        with tempfile.TemporaryDirectory() as caches, tempfile.TemporaryDirectory() as folder:
            found.append(measure(Path(caches), Path(folder)))
        if found[0][0] > LONG:
            break
    return statistics.median(cold for cold, _ in found), statistics.median(warm for _, warm in found)


def of_question(question: Question) -> tuple[float, float]:
    """Processor time of a question, cold and warm, [s]."""
    return medians(lambda caches, folder: (seconds(question.arguments, caches, folder),
                                           seconds(question.arguments, caches, folder)))  # fmt: skip


def of_call() -> tuple[float, float]:
    """Time of a scalar call in Python, with no machine code there and with it loaded, [ms]."""

    def measure(caches: Path, folder: Path) -> tuple[float, float]:
        seconds(("-c", MANY), caches, folder)  # leaves machine code behind
        warm = answers(caches, folder)[1]
        with tempfile.TemporaryDirectory() as empty:
            return answers(Path(empty), folder)[0], warm

    def answers(caches: Path, folder: Path) -> tuple[float, float]:
        command = [sys.executable, "-c", CALL]
        done = subprocess.run(command, cwd=folder, env=environment(caches), capture_output=True, text=True, check=True)
        first, later = map(float, done.stdout.split())
        return first, later

    return medians(measure)


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
    for question in QUESTIONS:
        if not chosen or any(part in question.name for part in chosen):
            rows.append(row(question.name, *of_question(question), (question.cold, question.warm), floor))
            sys.stderr.write(rows[-1] + "\n")
    if not chosen or "call" in chosen:
        rows.append(row("a scalar `pl.bridge(...)`", *of_call(), (GOALS["call cold"], GOALS["call warm"]), unit="ms"))
    versions = ", ".join(f"{name} {version(name.lower())}" for name in ("NumPy", "Numba", "Matplotlib"))
    return f"""# What a first answer costs

Written by `python -m benchmarks.first_answers`: processor seconds of the whole process, all its threads, on
{processor()}, {platform.system()}, Python {platform.python_version()}, {versions}. *Cold* is
a process that finds no machine code and no other cache of a user, as in a fresh container, on a node of a cluster or in
CI; the byte code of Python is there, as an installation leaves it. *Warm* is the same process again. Medians of
{ROUNDS}; of what takes more than {LONG:g} s, one run. `python -c pass` takes {floor:.3f} s here; the last column is
what a cold process takes beyond it. A ✗ marks what misses its goal.

| | cold | goal | warm | goal | cold, beyond `pass` |
|---|---:|---:|---:|---:|---:|
{chr(10).join(rows)}

A few questions are answered in plain Python, by the kernels as they stand, and compile nothing. Many are answered by
machine code, which is made once on a machine, or ahead of time by [`pendular compile`](start.md).
"""


if __name__ == "__main__":
    text = page(sys.argv[1:])
    sys.stdout.write(text)
    if not sys.argv[1:]:
        PAGE.write_text(text, encoding="utf-8")
