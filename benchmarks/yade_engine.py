"""What bridges cost in YADE, by its own law and by the engine: ``python -m benchmarks.yade_engine``.

On a packing of grains at rest, one thread: processor time of a step with either, less that of a step with neither.
"""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.codes import yade
from pendular.codes.yade.engine import write

SCRIPT = Path(__file__).parent / "yade_packing.py"
GRAINS, RADIUS, GAMMA, SUCTION, CONTACT_ANGLE = 8000, 50e-6, 0.0728, 1e5, 0.0
SEED, ROUNDS = 20261129, 3


def packing(random: np.random.Generator) -> dict[str, np.ndarray]:
    """Grains of 49 to 50 um on a cubic lattice, each in touch with six others, which is about what a heap has."""
    side = round(GRAINS ** (1 / 3))
    places = np.stack(np.meshgrid(*3 * [np.arange(side)], indexing="ij"), axis=-1).reshape(-1, 3)
    radii = random.uniform(0.98, 1.0, len(places)) * RADIUS
    shaken = 1.96 * RADIUS * (places + random.uniform(-0.002, 0.002, places.shape))
    return {"positions": shaken, "radii": radii}


def main() -> None:
    """Print nanoseconds a bridge."""
    grains = packing(np.random.default_rng(SEED))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        yade.export(folder, CONTACT_ANGLE)
        write(folder / "engine")
        pl.tabulate(CONTACT_ANGLE, reduced=(1.0, 1e3), tolerance=1e-6).save(folder / "w.bridges")
        np.savez(folder / "packing.npz", **grains, suction=SUCTION, surface_tension=GAMMA)
        print(f"{len(grains['radii'])} grains, seed {SEED}; nanoseconds a bridge and step")
        for _ in range(ROUNDS):
            subprocess.run(
                ["yade", "-n", "-x", str(SCRIPT)], cwd=folder, capture_output=True, timeout=1200, check=False
            )
            found = json.loads((folder / "found.json").read_text())
            menisci, bridges = found["menisci"], found["bridges"]
            print(
                f"its law {found['law'] / menisci:.0f} ({menisci} menisci)   "
                f"engine {found['engine'] / bridges:.0f} ({bridges} bridges)   all else {found['alone'] / menisci:.0f}"
            )


if __name__ == "__main__":
    main()
