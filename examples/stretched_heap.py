"""Does a wet heap that was pulled apart hold again? ``python examples/stretched_heap.py [picture.svg]``.

A loose heap of 200 grains of 50 µm is stretched in one direction by a fifth and pushed back, three times from the same
state: its liquid exchanged with vapour of one suction; its liquid shut in and shared by all bridges; and each bridge
with its own liquid, which goes to neighbours when it breaks. Each step takes up the bridges of the one before; new ones
form at contact alone.
"""

import sys
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ground.colours import INK
from pendular.ground.look import HELD, panels
from pendular.show.picture import save

ANGLE, WATER = np.deg2rad(20), pl.Liquid.water(temperature=293.15)
HEAP = pl.random_packing(200, 50e-6, friction=0.5)
FIRST = pl.wet(HEAP, ANGLE, saturation=0.02, liquid=WATER, path="wetting")
STRETCHES = np.concatenate([np.linspace(0.0, 0.2, 17), np.linspace(0.2, 0.0, 17)[1:]])
WAYS = {
    "common suction held": {"suction": FIRST.suction},
    "all liquid held": {"liquid_volume": FIRST.liquid_volume},
    "each bridge keeps its own": {"volume": 0.0},
}


def stretched(stretch: float) -> pl.Packing:
    """Heap with all lengths in one direction longer."""
    change = np.diag([1.0 + stretch, 1.0, 1.0])
    return pl.Packing(HEAP.positions @ change, HEAP.radii, cell=HEAP.cell @ change)


def pull(held: dict[str, float]) -> np.ndarray:
    """Stress in the direction of the stretch, [Pa], and number of bridges, at each step."""
    state, found = FIRST, []
    for stretch in STRETCHES:
        state = pl.wet(stretched(stretch), ANGLE, **held, liquid=WATER, start=state, condensation=False)
        found.append((state.stress[0, 0], len(state.bridges)))
    return np.array(found)


def report(pulls: dict[str, np.ndarray]) -> None:
    """Print stress and bridges at the start, when stretched, and at the end."""
    print(f"{len(FIRST.bridges)} bridges at {FIRST.suction / 1e3:.2f} kPa, saturation {FIRST.saturation:.3f}")
    for name, found in pulls.items():
        stress, bridges = found[[0, len(found) // 2, -1]].T
        print(f"{name}: {' '.join(f'{value:.0f}' for value in stress)} Pa with {bridges.astype(int).tolist()} bridges")


def draw(pulls: dict[str, np.ndarray], path: Path) -> None:
    """Draw stress and bridges against the stretch."""
    drawing, rows = panels(2.6, 2.4, share_x=True)
    for (name, found), colour in zip(pulls.items(), (HELD["suction"], INK, HELD["volume"]), strict=True):
        turn = len(STRETCHES) // 2 + 1
        for axes, values in zip(rows, (found[:, 0] / 1e3, found[:, 1] / HEAP.count), strict=True):
            axes.plot(100 * STRETCHES[:turn], values[:turn], color=colour, lw=1.8, label=name)
            axes.plot(100 * STRETCHES[turn - 1 :], values[turn - 1 :], color=colour, lw=1.2, ls="--")
    for axes, label in zip(rows, ("stress (kPa)", "bridges over grains"), strict=True):
        axes.set(ylabel=label, ylim=(0, None))
    rows[1].set(xlabel="stretch (%); dashed: pushed back")
    rows[0].legend(frameon=False, fontsize=9)
    save(drawing, path)


if __name__ == "__main__":
    PULLS = {name: pull(held) for name, held in WAYS.items()}
    report(PULLS)
    if len(sys.argv) > 1:
        draw(PULLS, Path(sys.argv[1]))
