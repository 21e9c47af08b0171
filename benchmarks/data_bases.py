"""What `pendular dataset` takes, and what it took before the solver was direct, in one run.

The source of before is taken from the history of the repository. Both run in processes of their own, by turns, after
one turn that compiles; their time is that of the processor. ``python -m benchmarks.data_bases`` writes docs/speed.md.
"""

import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from benchmarks.sections import put
from benchmarks.solver import machine

HOUSE = Path(__file__).parent.parent
BEFORE = "59d7bc856c"  # the last commit whose grid was measured without the arcs of the direct solver
ROUNDS = 3
SHAPES = {"of the paper's size": "240x200", "ten times as many points": "2400x200"}
_COMMAND = "import sys; from pendular.front.cli import main; sys.argv[0] = 'pendular'; main()"


class Took(NamedTuple):
    """Time of a command, [s]."""

    processor: float
    wall: float


def took(source: Path, shape: str, folder: Path) -> Took:
    """Time of one command from a source, which keeps its machine code in a folder."""
    store = folder / "bridges.zarr"
    environment = os.environ | {
        "PYTHONPATH": str(source / "src"),
        "PYTHONPYCACHEPREFIX": str(folder / "bytecode"),
        "PENDULAR_CACHE_DIR": str(folder / "machine_code"),
    }
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    begin = time.perf_counter()
    process = subprocess.Popen(
        [sys.executable, "-c", _COMMAND, "dataset", str(store), "--shape", shape],
        env=environment, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - begin
    if status:
        raise RuntimeError(f"the command of {source} failed")
    shutil.rmtree(store)
    return Took(usage.ru_utime + usage.ru_stime, wall)


def medians(times: list[Took]) -> Took:
    """Median of each clock."""
    return Took(*(statistics.median(column) for column in zip(*times, strict=True)))


def row(what: str, shape: str, folders: dict[Path, Path]) -> str:
    """A row of the table: medians of turns, and their ratio."""
    times: dict[Path, list[Took]] = {source: [] for source in folders}
    for _ in range(ROUNDS):
        for source, folder in folders.items():
            times[source].append(took(source, shape, folder))
    before, now = (medians(times[source]) for source in folders)
    return (
        f"| {what} | {before.processor:.1f} | {now.processor:.1f} | {now.processor / before.processor:.2f} | "
        f"{before.wall:.1f} | {now.wall:.1f} | {now.wall / before.wall:.2f} |"
    )


def measure() -> str:
    """The section."""
    with tempfile.TemporaryDirectory() as folder:
        old, kept = Path(folder, "before"), {}
        subprocess.run(["git", "-C", HOUSE, "worktree", "add", "-q", "--detach", old, BEFORE], check=True)
        try:
            for source, name in ((old, "of_before"), (HOUSE, "of_now")):
                kept[source] = Path(folder, name)
                kept[source].mkdir()
                took(source, SHAPES["of the paper's size"], kept[source])
            rows = [row(what, shape, kept) for what, shape in SHAPES.items()]
        finally:
            subprocess.run(["git", "-C", HOUSE, "worktree", "remove", "--force", old], check=True)
    return f"""## Data bases

Written by `python -m benchmarks.data_bases` on: {machine()}.
The command `pendular dataset`, from its start to its end, and the same of commit {BEFORE}, from before the direct
solver, by turns in one run: seconds of the processor and by the clock on the wall, medians of {ROUNDS} turns. Machine
code is there, made by a turn before.

| grid | before, s | now, s | ratio | before, wall | now, wall | ratio |
|---|---:|---:|---:|---:|---:|---:|
{chr(10).join(rows)}
"""


if __name__ == "__main__":
    put("benchmarks.data_bases", measure())
