"""How long bridges of other solids take, compiled and in plain Python: ``python -m benchmarks.solids``.

Both run the same kernels on the same questions, in turns, on one thread, by the clock of the process.
"""

import math
import time
from collections.abc import Callable
from unittest.mock import patch

import numpy as np

import pendular as pl
from benchmarks.sections import machine, put
from pendular.ground import rows

SEED, REPEATS = 20261130, 9
COUNTS = {"bridge": (400, 3), "rupture": (200, 3), "curve": (40, 1)}  # by machine code, and in plain Python
MOST = 400
UNIT = pl.Liquid(surface_tension=1.0)
PAIRS = {
    "sharp cone on a plane": pl.Pair((pl.Cone(math.radians(60.0)), math.inf), (0.5, 0.2)),
    "cone with a round tip on a plane": pl.Pair((pl.Cone(math.radians(60.0), 0.1), math.inf), (0.5, 0.2)),
    "paraboloid on a sphere": pl.Pair((pl.Paraboloid(1.0), 2.0), (0.5, 0.2)),
    "disc on a disc": pl.Pair(pl.Disc(1.0), 1.0),
    "pinned disc on a sphere": pl.Pair((pl.Disc(1.0, pinned=True), 1.5), 0.3),
    "sphere on a plane, its own solver": pl.Pair((1.0, math.inf), (0.5, 0.2)),
}


def seconds(ask: Callable[[], object]) -> float:
    """Time of a call on this one thread."""
    start = time.process_time()
    with patch.object(rows, "thread_count", lambda: 1):
        ask()
    return time.process_time() - start


def times_of(ask: Callable[[int], object], many: int, few: int) -> tuple[float, float]:
    """Median seconds of a question by machine code, and in plain Python."""

    def compiled() -> None:
        with rows.by_machine_code():
            ask(many)

    def plain() -> None:
        with patch.object(rows, "_machine_code", lambda *_: None):
            ask(few)

    compiled()
    turns = [(seconds(compiled) / many, seconds(plain) / few) for _ in range(REPEATS)]
    fast, slow = np.median(turns, axis=0)
    return float(fast), float(slow)


def questions(pair: pl.Pair) -> dict[str, Callable[[int], object]]:
    """What is asked of a pair, so many times."""
    volumes = 10.0 ** np.random.default_rng(SEED).uniform(-2.0, 0.0, MOST)
    own = pair.solids[0] == pl.Disc(1.0, pinned=True)  # a wide ring holds no little liquid
    volume = 1.0 + volumes if own else volumes

    def bridges(count: int) -> object:
        return pl.bridge(pair, 0.05 * np.cbrt(volume[:count]), volume=volume[:count], liquid=UNIT)

    def ruptures(count: int) -> object:
        return pl.rupture(pair, volume=volume[:count], liquid=UNIT)

    def curves(count: int) -> object:
        return pl.curve(pair, volume=volume[:count], liquid=UNIT, points=51)

    return {"bridge": bridges, "rupture": ruptures, "curve": curves}


def main() -> None:
    """Measure, print and put into the page of speeds."""
    lines = []
    for name, pair in PAIRS.items():
        cells = []
        for what, ask in questions(pair).items():
            fast, slow = times_of(ask, *COUNTS[what])
            cells.append(f"{1e6 * fast:.0f} | {slow / fast:.0f}")
        lines.append(f"| {name} | {' | '.join(cells)} |")
    table = "\n".join(lines)
    put(
        "benchmarks.solids",
        f"""## Other solids

Written by `python -m benchmarks.solids` on: {machine()}.
Random volumes of 0.01 to 1 (of 1 to 2 for the pinned disc) in units of the
solids, a gap of 0.05 cube roots of each, through `pl.bridge`, `pl.rupture` and `pl.curve` (51 points) on one thread, by
the clock of the process, medians of {REPEATS} turns. Beside each time of machine code
stands how many times longer the same kernels take in plain Python in the same run.

| | bridge, µs | plain, times | rupture, µs | plain, times | curve, µs | plain, times |
|---|---:|---:|---:|---:|---:|---:|
{table}
""",
    )


if __name__ == "__main__":
    main()
