"""How much does a heap remember whether it was wet or dry? ``python examples/retention_hysteresis.py [picture.svg]``.

A heap of grains of 0.2 mm, whose contacts are open by up to 2 % of a diameter, as in a sand that was stirred. On drying
a bridge lasts until it breaks; on wetting one forms where grains touch, or where vapour condenses, which needs it to be
the lower state. Where there is no time for vapour, only grains that touch get one.
"""

import sys
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ground.colours import ACCENT, FAINT, INK, LIQUID_EDGE
from pendular.ground.look import panels
from pendular.show.picture import save

RADIUS, ANGLE = 100e-6, np.deg2rad(20)
WATER = pl.Liquid.water(temperature=293.15)
HEAP = pl.loosened(pl.random_packing(200, RADIUS, friction=0.5), 0.01)
SUCTION = np.geomspace(2e3, 60e3, 16)
WAYS = {
    "drying": {"path": "drying"},
    "wetting, from vapour": {"path": "wetting"},
    "wetting, at contact": {"path": "wetting", "condensation": False, "formation_distance": 1e-6},
}
COLOURS = dict(zip(WAYS, (LIQUID_EDGE, ACCENT, INK), strict=True))


def follow(path: str, suctions: np.ndarray, **how: object) -> list[pl.Wet]:
    """States of the heap along a path, each taking up the one before."""
    states = []
    for suction in suctions:
        start = {"start": states[-1]} if states else {"path": path}
        states.append(pl.wet(HEAP, ANGLE, suction=float(suction), liquid=WATER, **start, **how))
    return states


def all_ways() -> dict[str, list[pl.Wet]]:
    """States over the suctions, each way from its own end: dried from the wettest, wetted from the driest."""
    dried = follow(**WAYS["drying"], suctions=SUCTION)
    return {"drying": dried} | {
        name: follow(**how, suctions=SUCTION[::-1])[::-1] for name, how in WAYS.items() if name != "drying"
    }


def report(found: dict[str, list[pl.Wet]]) -> None:
    """Print water, bridges and stress on each way."""
    print(f"{HEAP.count} grains, {1 - found['drying'][0].porosity:.1%} solid")
    print("  suction    " + "   ".join(f"{name:>24}" for name in WAYS))
    print(" " * 13 + "   ".join(f"{'water  bridges  stress':>24}" for _ in WAYS))
    for i in (0, 4, 8, 12, 15):
        told = (
            f"{state[i].saturation:>9.4%} {state[i].coordination:>5.2f} {state[i].suction_stress:>5.0f} Pa"
            for state in found.values()
        )
        print(f"{1e-3 * SUCTION[i]:>5.1f} kPa    " + "   ".join(told))


def draw(found: dict[str, list[pl.Wet]], path: Path) -> None:
    """Draw water and stress against the suction."""
    drawing, (upper, middle, lower) = panels(2.3, 1.7, 2.2, share_x=True)
    drying = np.array([state.saturation for state in found["drying"]])
    for name, states in found.items():
        colour = COLOURS[name]
        water = np.array([state.saturation for state in states])
        upper.loglog(1e-3 * SUCTION, 100 * water, color=colour, lw=2, label=name)
        middle.semilogx(1e-3 * SUCTION, water / drying, color=colour, lw=2)
        lower.semilogx(1e-3 * SUCTION, [state.suction_stress for state in states], color=colour, lw=2)
    upper.set(ylabel="water in pores (%)")
    upper.legend(frameon=False, fontsize=9, loc="lower left")
    middle.set(ylabel="over drying", ylim=(0, 1.05))
    lower.set(xlabel="suction (kPa)", ylabel="stress (Pa)", ylim=(0, None))
    lower.set_xticks((2, 5, 10, 20, 50), ("2", "5", "10", "20", "50"))
    lower.set_xticks([], minor=True)
    upper.yaxis.set_major_formatter("{x:g}")
    upper.tick_params(labelcolor=FAINT)
    save(drawing, path)


if __name__ == "__main__":
    FOUND = all_ways()
    report(FOUND)
    if len(sys.argv) > 1:
        draw(FOUND, Path(sys.argv[1]))
