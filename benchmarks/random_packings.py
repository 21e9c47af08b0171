"""Random packings as they come out: solid fraction, contacts a grain, overlap and time, against the friction.

    python -m benchmarks.random_packings [GRAINS]

Contacts are counted among grains that are held, by four others or more without friction, by two with it.
"""

import sys
import time

import numpy as np
from numpy.typing import NDArray

import pendular as pl
from pendular.packing.heap import Packing
from pendular.packing.neighbours import find_neighbours

FRICTIONS = (0.0, 0.1, 0.3, 1.0, 10.0)


def held(pairs: NDArray[np.int32], count: int, least: int) -> NDArray[np.bool_]:
    """Grains that touch so many or more others that are held themselves."""
    grains = np.ones(count, bool)
    while True:
        number = np.bincount(pairs[grains[pairs].all(axis=1)].ravel(), minlength=count)
        if not np.any(grains & (number < least)):
            return grains
        grains &= number >= least


def describe(heap: Packing, friction: float, seconds: float) -> str:
    """Line of the table."""
    found = find_neighbours(heap, lambda first, second: np.zeros(np.shape(first)))
    grains = held(found.pairs, heap.count, 2 if friction > 0.0 else 4)
    contacts = 2.0 * np.count_nonzero(grains[found.pairs].all(axis=1)) / max(1, np.count_nonzero(grains))
    solid = np.sum(4.0 / 3.0 * np.pi * heap.radii**3) / heap.volume
    overlap = -found.gap.mean() / heap.radii.mean()
    return f"{friction:8g} {solid:8.4f} {contacts:8.3f} {1.0 - grains.mean():9.3f} {overlap:9.1e} {seconds:9.1f} s"


def main(count: int) -> None:
    """Print the table."""
    pl.random_packing(60, 1.0, friction=0.1)  # compiles
    print(f"{count} equal grains\nfriction    solid contacts  rattlers   overlap  time of one core")
    for friction in FRICTIONS:
        start = time.process_time()
        heap = pl.random_packing(count, 1.0, friction=friction, seed=1)
        print(describe(heap, friction, time.process_time() - start), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)
