"""Cost of a heap: ``python -m benchmarks.packings [one|curves|blocks]``; without a word all three.

``one``: a million grains with three million bridges at one suction with all that is told of them, then at a further
one. ``curves``: their retention, 40 suctions both ways. ``blocks``: one and ten million grains by two Dask workers, in
blocks that are made where they are needed.
"""

import math
import resource
import sys
import time
from typing import NamedTuple

import numpy as np

import pendular as pl
from pendular.packing.blocks import wet_in_blocks
from pendular.packing.retention import retention_of
from pendular.packing.setting import setting_of

ANGLE, LIQUID = math.radians(20), pl.Liquid(surface_tension=0.0728)
RADIUS, SPACING, SHAKE = 50e-6, 2.02, 0.01  # the latter two over the radius
SIDE, SUCTION, SEED = 100, 10 * 0.0728 / 50e-6, 20261129
POINTS = 40


class Shaken(NamedTuple):
    """A simple cubic lattice whose grains are moved a little, by their numbers: any box of it can be made alone."""

    side: int

    @property
    def length(self):
        """Of the cell, [m]."""
        return self.side * SPACING * RADIUS

    def __call__(self, low, high):
        """Centres, radii and numbers of the grains in a box."""
        step = SPACING * RADIUS
        ranges = [np.arange(max(0, int(low[k] / step) - 1), min(self.side, int(high[k] / step) + 2)) for k in range(3)]
        place = np.stack(np.meshgrid(*ranges, indexing="ij"), axis=-1).reshape(-1, 3)
        number = (place[:, 0] * self.side + place[:, 1]) * self.side + place[:, 2]
        random = np.stack([np.sin(number * frequency) * 43758.5453 for frequency in (12.9898, 78.233, 37.719)], axis=-1)
        centres = (place + 0.5) * step + SHAKE * RADIUS * 3.4 * (random - np.floor(random) - 0.5)
        inside = np.flatnonzero(np.all((centres >= low) & (centres < high), axis=1))
        return centres[inside], np.full(len(inside), RADIUS), number[inside]


def heap_of(side):
    """All grains at once."""
    shaken = Shaken(side)
    return pl.Packing(shaken(np.zeros(3), np.full(3, shaken.length))[0], RADIUS, cell=3 * (shaken.length,))


def all_of(w):
    """All that is told of a heap."""
    return (
        w.saturation, w.stress, w.stress_shares, w.chi, w.interface_area, w.coordination, w.fabric, w.meetings,
    )  # fmt: skip


def timed(name, function):
    """Print the time of a call, on the clock and of the processors."""
    clock, cpu = time.perf_counter(), time.process_time()
    answer = function()
    print(f"{name:42s} {time.perf_counter() - clock:8.2f} s, of processors {time.process_time() - cpu:8.2f} s")
    return answer


def memory():
    """Most memory so far, [B]."""
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def one():
    """One suction, and a further one."""
    small = heap_of(30)
    timed(
        "27 000 grains, with compiling and a table",
        lambda: all_of(pl.wet(small, ANGLE, suction=SUCTION, liquid=LIQUID)),
    )
    before = memory()
    heap = timed("making a million grains", lambda: heap_of(SIDE))
    w = timed("one suction", lambda: pl.wet(heap, ANGLE, suction=SUCTION, liquid=LIQUID))
    timed("all that is told", lambda: all_of(w))
    print(w, w.table_error, sep="\n")
    v = timed("a further suction", lambda: pl.wet(heap, ANGLE, suction=1.2 * SUCTION, liquid=LIQUID, start=w))
    timed("all that is told", lambda: all_of(v))
    print(f"memory: {(memory() - before) / heap.count / 1e3:.2f} kB a grain above {before / 1e9:.2f} GB")


def curves():
    """Retention of a million grains."""
    heap = heap_of(SIDE)
    setting = setting_of(heap, ANGLE, LIQUID, 0.0, True, "auto")
    suctions = np.geomspace(0.3 * SUCTION, 30 * SUCTION, POINTS)
    found = timed(f"{POINTS} suctions, both main branches", lambda: retention_of(setting, suctions, []))
    print(f"saturation {found.walks[0].values['saturation'][0]:.6g} to {found.walks[0].values['saturation'][-1]:.6g}")


def blocks():
    """Heaps in blocks, by two workers."""
    from distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        for side, count in ((SIDE, 3), (216, 6)):
            shaken = Shaken(side)
            started = time.perf_counter()
            total = wet_in_blocks(
                shaken, ANGLE, suction=SUCTION, liquid=LIQUID, blocks=(count, count, count),
                cell=3 * (shaken.length,), radius_range=(RADIUS, RADIUS), client=client,
            )  # fmt: skip
            passed = time.perf_counter() - started
            most = max(client.run(memory).values())
            print(
                f"{total.grains} grains in {count**3} blocks: {passed:.1f} s, {1e6 * passed / total.grains:.2f} µs a "
                f"grain; a worker took at most {most / 1e9:.2f} GB; saturation {total.saturation:.12g}"
            )
        whole = pl.wet(heap_of(SIDE), ANGLE, suction=SUCTION, liquid=LIQUID)
        print(f"one block of {SIDE**3} grains: saturation {whole.saturation:.12g}")


if __name__ == "__main__":
    tasks = {"one": one, "curves": curves, "blocks": blocks}
    for name in sys.argv[1:] or tasks:
        print(f"--- {name}")
        tasks[name]()
