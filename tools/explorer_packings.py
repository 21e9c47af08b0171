"""The packings that the explorer page brings: ``python -m tools.explorer_packings`` makes them and writes them down.

They are not made anew with each page: how grains settle depends on the last digit of a processor, and takes Numba.
"""

import json
from pathlib import Path

import numpy as np

import pendular as pl

OUT = Path(__file__).parents[1] / "src" / "pendular" / "front" / "explorer" / "static" / "heap" / "packings.json"
DIGITS = 11  # after the point, of lengths over the mean radius: a hundredth of what counts as touching
GRAINS = 200
SIEVES = ([0.7, 1.0, 1.4], [0, 40, 100])  # of mixed sizes: openings over any length, and what passes, [%]


def packings() -> dict[str, pl.Packing]:
    """Each by its name, with a mean radius of one."""
    mixed = pl.sieved_radii(GRAINS, *SIEVES)
    return {
        "loose": pl.random_packing(GRAINS, 1.0, friction=0.5, seed=1),
        "close": pl.random_packing(GRAINS, 1.0, seed=1),
        "mixed": pl.random_packing(GRAINS, mixed / mixed.mean(), friction=0.3, seed=1),
    }


def written(heap: pl.Packing) -> dict[str, object]:
    """Grain by grain x, y and z; one radius if all are equal; the side of the cube."""
    radii = np.unique(heap.radii) if np.ptp(heap.radii) == 0.0 else heap.radii
    return {
        "side": round(float(heap.box[0, 0]), DIGITS),
        "radii": np.round(radii, DIGITS).tolist(),
        "positions": np.round(heap.positions.ravel(), DIGITS).tolist(),
    }


def main() -> None:
    """Write the file."""
    text = json.dumps({name: written(heap) for name, heap in packings().items()}, separators=(",", ":"))
    OUT.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
