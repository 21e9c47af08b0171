"""How long a bridge takes, next to the same question put to SciPy: ``python -m benchmarks.speed``.

The rival integrates the Young-Laplace equation along the meridian with ``solve_ivp``, from the contact circle of a
trial half-filling angle to the neck, and finds the angle that gives the separation with ``brentq``. As it does not know
where rupture is, it first steps from the thick side until the separation is too large. It finds the force only.
"""

import math
import os
import time
from collections.abc import Callable
from typing import NamedTuple

import numba
import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import pendular as pl
from pendular.exact import batch
from pendular.exact.equations import SUCTION

Floats = NDArray[np.float64]

SEED = 20
BRIDGES, VOLUME_BRIDGES, RIVAL_BRIDGES = 100_000, 2_000, 20
REPEATS = 9
UNIT = pl.Liquid(surface_tension=1.0)

GOAL, GOAL_RATIO = 2e-6, 3000.0


class Sample(NamedTuple):
    """Random bridges between equal spheres, in units of their radius and of γ."""

    angle: Floats
    suction: Floats
    separation: Floats

    @property
    def pair(self) -> pl.Pair:
        """The solids."""
        return pl.Pair(1.0, self.angle)


def draw(count: int) -> Sample:
    """Bridges of any magnitude of suction, wetting, and distance from rupture."""
    rng = np.random.default_rng(SEED)
    suction = 10.0 ** rng.uniform(-2.0, 8.0, count)
    angle = np.deg2rad(rng.uniform(0.0, 70.0, count))
    rupture = pl.rupture(pl.Pair(1.0, angle), suction=suction, liquid=UNIT).separation
    return Sample(angle, suction, rng.uniform(0.0, 0.999, count) * rupture)


def seconds(function: Callable[[], object], clock: Callable[[], float], repeats: int = REPEATS) -> float:
    """Median time of a call, after one that compiles."""
    function()
    times = []
    for _ in range(repeats):
        start = clock()
        function()
        times.append(clock() - start)
    return float(np.median(times))


# -- the rival -------------------------------------------------------------------------------------------------------


def half_separation(filling: float, angle: float, suction: float) -> float:
    """Half the separation of two unit spheres at a half-filling angle, along the meridian from contact to neck."""
    contact = math.sin(filling)  # also the unit of length, so that one tolerance suits all suctions
    curvature = suction * contact

    def rates(_: float, point: Floats) -> list[float]:
        _, radius, slope = point
        return [math.cos(slope), math.sin(slope), curvature + math.cos(slope) / radius]

    def neck(_: float, point: Floats) -> float:
        return float(point[2])

    neck.terminal = True  # type: ignore[attr-defined]
    start = [0.0, 1.0, filling + angle - 0.5 * math.pi]
    path = solve_ivp(rates, (0.0, 10.0), start, "DOP853", events=neck, rtol=1e-10, atol=1e-12)
    return contact * float(path.y_events[0][0][0]) - 2.0 * math.sin(0.5 * filling) ** 2


def rival_force(separation: float, angle: float, suction: float) -> float:
    """Force of the stable bridge."""

    def excess(filling: float) -> float:
        return 2.0 * half_separation(filling, angle, suction) - separation

    thick = min(0.99 * (0.5 * math.pi - angle), 2.0 * math.sqrt(2.0 * math.cos(angle) / suction))
    while excess(0.8 * thick) < 0.0:
        thick *= 0.8
    filling = brentq(excess, 0.8 * thick, thick, xtol=1e-12 * thick)
    contact = math.sin(filling)
    return 2.0 * math.pi * contact * math.sin(filling + angle) + math.pi * contact**2 * suction


def time_rival(sample: Sample) -> tuple[float, float]:
    """Median seconds a bridge, and the largest relative difference of its force."""
    times, forces = [], []
    for row in zip(sample.separation, sample.angle, sample.suction, strict=True):
        start = time.thread_time()
        forces.append(rival_force(*map(float, row)))
        times.append(time.thread_time() - start)
    exact = pl.bridge(sample.pair, sample.separation, suction=sample.suction, liquid=UNIT).force
    return float(np.median(times)), float(np.max(np.abs(np.array(forces) / exact - 1.0)))


# -- the library -----------------------------------------------------------------------------------------------------


def time_kernel(sample: Sample) -> float:
    """Seconds a bridge in compiled code, numbers in and numbers out."""
    one = np.ones_like(sample.angle)
    questions = np.column_stack([sample.separation, sample.suction, one, sample.angle, one, sample.angle])
    return seconds(lambda: batch.answer(batch.STABLE, SUCTION, questions), time.thread_time) / len(one)


def report(what: str, each: float, note: str = "") -> None:
    """Print one line of the table."""
    print(f"{what:<58}{1e9 * each:>12.0f} ns   {note}".rstrip())


def main() -> None:
    """Measure and print."""
    print(f"{BRIDGES} random bridges between equal spheres, seed {SEED}; medians of {REPEATS} runs")
    print("contact angle 0 to 70 deg, reduced suction 1e-2 to 1e8, separation 0 to 0.999 of rupture")
    print("time of one core for one bridge:\n")
    sample = draw(BRIDGES)
    pair, suction = sample.pair, sample.suction
    few = Sample(*(field[:VOLUME_BRIDGES] for field in sample))
    volume = pl.bridge(few.pair, few.separation, suction=few.suction, liquid=UNIT).volume

    def ask() -> pl.Bridge:
        return pl.bridge(pair, sample.separation, suction=suction, liquid=UNIT)

    numba.set_num_threads(1)
    exact = seconds(ask, time.thread_time) / BRIDGES
    report("bridge at a suction: compiled solver", time_kernel(sample))
    report("bridge at a suction: pl.bridge", exact, f"goal: {1e9 * GOAL:.0f} ns")
    each = seconds(lambda: pl.rupture(pair, suction=suction, liquid=UNIT), time.thread_time) / BRIDGES
    report("rupture at a suction: pl.rupture", each)
    each = seconds(lambda: pl.bridge(few.pair, few.separation, volume=volume, liquid=UNIT), time.thread_time, 3)
    report(f"bridge at a volume: pl.bridge, {VOLUME_BRIDGES} of them", each / VOLUME_BRIDGES)
    each = seconds(lambda: pl.rupture(few.pair, volume=volume, liquid=UNIT), time.thread_time, 3)
    report(f"rupture at a volume: pl.rupture, {VOLUME_BRIDGES} of them", each / VOLUME_BRIDGES)
    each = seconds(lambda: pl.bridge(pl.Pair(1.0, 0.3), 0.01, suction=10.0, liquid=UNIT), time.thread_time, 201)
    report("one bridge at a suction, alone", each)

    rival, difference = time_rival(Sample(*(field[:RIVAL_BRIDGES] for field in sample)))
    report(f"bridge at a suction: solve_ivp + brentq, {RIVAL_BRIDGES} of them", rival)
    print(f"\n{rival / exact:.0f} times faster (goal: {GOAL_RATIO:.0f}); the forces differ by at most {difference:.1e}")

    cores = min(os.cpu_count() or 1, numba.config.NUMBA_NUM_THREADS)
    print("\nby the clock on the wall, other work on the machine included:")
    for threads in sorted({1, min(2, cores), cores}):
        numba.set_num_threads(threads)
        each = seconds(ask, time.perf_counter) / BRIDGES
        report(f"bridge at a suction: pl.bridge, threads: {threads}", each)


if __name__ == "__main__":
    main()
