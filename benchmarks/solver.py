"""What a bridge costs in arrays, next to closed forms compiled in the same run: ``python -m benchmarks.solver``.

The rivals are laws that YADE and other codes use: the paper's closed form under suction, Willett's at a volume. Bridges
are drawn between a plane or a sphere and another one, with two random angles from 0 to 90 degrees, up to 0.98 of
rupture. Times are those of one thread, by its own clock: medians of rounds that run one after the other. Rows that the
straight way of the solver leaves to the rest of it are counted.
"""

import math
import statistics
import time
import tracemalloc
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray

import pendular as pl
from benchmarks.contacts import FIT, answer_room, paper_range, willett_range
from benchmarks.sections import machine, put
from pendular.exact import batch
from pendular.exact.equations import SUCTION, VOLUME
from pendular.exact.state import State

Floats = NDArray[np.float64]

SEED, COUNT, ROUNDS = 20261129, 50_000, 5
RADIUS, GAMMA = 50e-6, 0.0728
LIQUID = pl.Liquid(surface_tension=GAMMA)
MOVED = 1e-3  # of its separation, by which each pair moves in a step


class Sample(NamedTuple):
    """Random bridges of one control, in SI units."""

    name: str
    pair: pl.Pair
    held: Floats
    separation: Floats

    def ask(self, **options: Any) -> pl.Bridge:
        """All bridges, at their separations."""
        return pl.bridge(self.pair, self.separation, **{self.name: self.held}, liquid=LIQUID, **options)

    def rupture(self) -> pl.Bridge:
        """All ruptures."""
        return pl.rupture(self.pair, **{self.name: self.held}, liquid=LIQUID)


class Line(NamedTuple):
    """A measured line: what it is, ns a row, and what it should take."""

    what: str
    cost: float
    goal: float | None
    rival: float  # ns a row, in the same rounds
    note: str = ""


def draw(name: str, count: int = COUNT, angles: tuple[float, float] | None = None) -> Sample:
    """Planes, spheres up to a hundred times larger, and equal ones."""
    rng = np.random.default_rng(SEED)
    kind = rng.random(count)
    other = np.where(kind < 0.1, math.inf, np.where(kind < 0.3, 1.0, 10.0 ** rng.uniform(0.0, 2.0, count)))
    drawn = np.deg2rad(rng.uniform(0.0, 90.0, (2, count)))
    pair = pl.Pair((RADIUS, RADIUS * other), tuple(drawn) if angles is None else angles)
    mean = RADIUS * 2.0 / (1.0 + 1.0 / other)
    held = mean**3 * 10.0 ** rng.uniform(-9.0, 0.0, count)
    if name == "suction":
        held = GAMMA / mean * 10.0 ** rng.uniform(-2.0, 6.0, count)
    sample = Sample(name, pair, held, np.zeros(count))
    reach = np.nan_to_num(np.asarray(sample.rupture().separation))
    return sample._replace(separation=rng.uniform(0.0, 0.98, count) * reach)


def medians(ways: dict[str, Callable[[], object]], clock: Callable[[], float] = time.thread_time) -> dict[str, float]:
    """Median ns of each way, all of them run in turn, after a call of each that compiles."""
    for way in ways.values():
        way()
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(ROUNDS):
        for name, way in ways.items():
            begin = clock()
            way()
            times[name].append(clock() - begin)
    return {name: 1e9 * statistics.median(taken) for name, taken in times.items()}


def rival_of(sample: Sample) -> Callable[[], object]:
    """The closed form of the same control, on as many pairs of spheres."""
    count = sample.held.size
    rng = np.random.default_rng(SEED)
    radius1, radius2 = (RADIUS * rng.uniform(0.5, 1.5, count) for _ in range(2))
    gap, out = np.full(count, 0.01 * RADIUS), answer_room(count)
    ends = (gap, radius1, radius2, out, 0, count)
    if sample.name == "volume":
        return lambda: willett_range(0.35, 1e-3 * RADIUS**3, GAMMA, *ends)
    return lambda: paper_range(FIT, math.cos(0.35), 100.0 * GAMMA / RADIUS, GAMMA, *ends)


def questions_of(sample: Sample) -> tuple[int, Floats]:
    """The rows that the solver is asked."""
    radius1, radius2 = (np.broadcast_to(radius, sample.held.shape) for radius in sample.pair.radii)
    angle1, angle2 = (np.broadcast_to(angle, sample.held.shape) for angle in sample.pair.contact_angles)
    unit = np.minimum(radius1, radius2)
    held = sample.held / unit**3 if sample.name == "volume" else sample.held * unit / GAMMA
    rows = np.column_stack([sample.separation / unit, held, unit / radius1, angle1, unit / radius2, angle2])
    return VOLUME if sample.name == "volume" else SUCTION, rows


def left_open(sample: Sample, entry: Callable[..., None], *given: int) -> float:
    """Share of the rows that an entry leaves to the rest of the solver."""
    control, rows = questions_of(sample)
    states, statuses = np.empty((len(rows), len(State._fields))), np.empty(len(rows), np.int8)
    batch.over_rows(entry, len(rows), 4096, *given, control, rows, states, statuses, batch.ABREAST)
    return float(np.mean(statuses == batch.OPEN))


def step_of(sample: Sample) -> Callable[[], object]:
    """The forces of the next step of a simulation, from the bridges of this one."""
    before = sample.ask()
    moved = sample._replace(separation=sample.separation * (1.0 + MOVED))
    return lambda: moved.ask(fields=("force",), near=before)


def lines_of(name: str, goals: dict[str, float]) -> list[Line]:
    """Lines of a control."""
    sample = draw(name)
    ways: dict[str, Callable[[], object]] = {
        "force": lambda: sample.ask(fields=("force",)),
        "all fields": sample.ask,
        "rupture": sample.rupture,
        "force of the next step": step_of(sample),
        "rival": rival_of(sample),
    }
    if name == "suction":
        alike = draw(name, angles=(0.35, 0.35))
        ways["force, one pair of angles"] = lambda: alike.ask(fields=("force",))
    found = medians(ways)
    open_rows = {
        "force": left_open(sample, batch.stable_range, batch.FORCE_ALONE),
        "all fields": left_open(sample, batch.stable_range, batch.ALL),
        "rupture": left_open(sample, batch.summit_range, batch.RUPTURE, batch.BRANCH_ENDS),
    }
    return [
        Line(
            f"{name}: {what}",
            cost / COUNT,
            goals.get(what),
            found["rival"] / COUNT,
            f"{open_rows[what]:.2%} of the rows left to the rest" if what in open_rows else "",
        )
        for what, cost in found.items()
        if what != "rival"
    ]


def threads_note() -> list[str]:
    """Time by the clock on the wall on one thread and on more, and the memory that an array of bridges takes."""
    sample = draw("volume", 300_000)
    cores = numba.config.NUMBA_NUM_THREADS

    def on(threads: int) -> None:
        numba.set_num_threads(threads)
        sample.ask()

    ways = {str(threads): partial(on, threads) for threads in sorted({1, min(2, cores), cores})}
    taken = medians(ways, time.perf_counter)
    told = [f"{cost / sample.held.size:.0f} ns on {threads}" for threads, cost in taken.items()]
    numba.set_num_threads(1)
    tracemalloc.start()
    found = sample.ask()
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    own = sum(np.asarray(value).nbytes for value in vars(found).values())
    return [
        f"`pl.bridge` on {sample.held.size:.0e} rows, by the clock on the wall: {', '.join(told)} threads.",
        f"It takes {most / own:.2f} times the memory of the fields that it returns.",
    ]


GOALS = {
    "volume": {"force": 1500.0, "all fields": 2500.0, "rupture": 4000.0, "force of the next step": 600.0},
    "suction": {"force": 700.0, "all fields": 1000.0, "force, one pair of angles": 350.0},
}


def measure() -> str:
    """The page's section."""
    numba.set_num_threads(1)
    rows = [line for name, goals in GOALS.items() for line in lines_of(name, goals)]
    told = [
        f"| {row.what} | {row.cost:.0f} | {'' if row.goal is None else f'{row.goal:.0f}'} | {row.cost / row.rival:.0f} "
        f"| {row.note} |"
        for row in rows
    ]
    notes = "\n".join(threads_note())
    return f"""## Exact bridges in arrays

Written by `python -m benchmarks.solver` on: {machine()}. {COUNT:.0e} random bridges of each control through
`pl.bridge` on one thread, by the thread's own clock: planes, spheres up to 100 times larger and equal ones, two random
contact angles from 0 to 90°, volumes of 1e-9 to 1 R̄³ or suctions of 1e-2 to 1e6 γ/R̄, up to 0.98 of rupture, seed
{SEED}. The rivals are compiled in the same run: Willett's law at a volume ({rows[0].rival:.1f} ns), the paper's closed
form under suction ({rows[-1].rival:.1f} ns).

| | ns a bridge | goal | times the closed form | |
|---|---:|---:|---:|---|
{chr(10).join(told)}

{notes}
"""


if __name__ == "__main__":
    put("benchmarks.solver", measure())
