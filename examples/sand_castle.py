"""How high does a wall of wet sand stand? ``python examples/sand_castle.py [picture.svg]``.

A random heap of spheres is wetted with more and more water. The stress of its bridges presses the grains together as
a load does: with the friction of the sand that is a cohesion, and the cohesion carries a wall. All scales with 1/R, so
one heap answers for all sizes of grains.
"""

import sys
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ground.colours import FAINT, INK
from pendular.ground.look import HELD, TITLE, panels
from pendular.show.picture import save

RADIUS = 100e-6  # of medium sand
ANGLE, FRICTION = np.deg2rad(20), np.deg2rad(35)  # water on quartz; of dry sand
GRAIN_DENSITY, GRAVITY = 2650.0, 9.81
WATER = pl.Liquid.water(temperature=293.15)
HEAP = pl.random_packing(200, RADIUS, friction=0.5)
SHARES = (0.0001, 0.001, 0.003, 0.01, 0.03, 0.05)  # of water in the volume of the heap


def heights(state: pl.Wet) -> tuple[float, float]:
    """Heights of a free column and of a vertical cut in a bank, [m].

    A column bears its weight on its foot, 2c tan(45° + φ/2); a bank slides on a plane, which takes twice the height.
    """
    strength = 2.0 * state.cohesion(FRICTION) * np.tan(np.pi / 4 + FRICTION / 2)
    density = (1.0 - state.porosity) * GRAIN_DENSITY + state.water_content * WATER.density
    return strength / (density * GRAVITY), 2.0 * strength / (density * GRAVITY)


def wetted(share: float) -> pl.Wet:
    """The heap with water added to dry sand."""
    return pl.wet(HEAP, ANGLE, water_content=share, liquid=WATER, path="wetting")


def report(states: list[pl.Wet]) -> None:
    """Print a line for each amount of water."""
    print(f"spheres of {2e3 * RADIUS:g} mm, {1 - states[0].porosity:.1%} of the heap is solid")
    print("water   saturation    suction   bridges    stress   cohesion   column    cut")
    for share, state in zip(SHARES, states, strict=True):
        column, cut = heights(state)
        told = f"{share:>5.2%} {state.saturation:>11.2%} {1e-3 * state.suction:>7.2f} kPa {state.coordination:>6.2f}"
        told += f" {state.suction_stress:>9.0f} Pa {state.cohesion(FRICTION):>6.0f} Pa {column:>6.3f} m {cut:>6.3f} m"
        print(told + ("" if state.is_pendular else "  bridges meet"))


def draw(states: list[pl.Wet], path: Path) -> None:
    """Draw the height of a column against the water, and against the size of the grains."""
    drawing, (upper, lower) = panels(2.6, 2.6)
    columns = np.array([heights(state)[0] for state in states])
    upper.semilogx([100 * share for share in SHARES], 100 * columns, "o-", color=HELD["volume"], lw=2, ms=4)
    meet = next(share for share, state in zip(SHARES, states, strict=True) if not state.is_pendular)
    upper.axvspan(100 * meet, 10, color=FAINT, alpha=0.15, lw=0)
    upper.annotate("bridges\nmeet", (9.5, 2), size=9, color=FAINT, ha="right")
    upper.set(xlabel="water in the heap (% by volume)", ylabel="height (cm)", xlim=(0.01, 10), ylim=(0, 25))
    upper.xaxis.set_major_formatter("{x:g}")
    upper.set_title("A free column of spheres of 0.2 mm", **TITLE)
    diameters = np.geomspace(0.05, 2.0, 30)  # mm
    best = 100 * columns[SHARES.index(0.01)] * 2e3 * RADIUS / diameters
    lower.loglog(diameters, best, color=HELD["volume"], lw=2, label="column")
    lower.loglog(diameters, 2 * best, color=INK, lw=1.4, ls=(0, (4, 2)), label="vertical cut in a bank")
    lower.set(xlabel="diameter of the grains (mm)", ylabel="height (cm)", xlim=(0.05, 2.0))
    lower.set_title("with 1 % of water", **TITLE)
    lower.legend(frameon=False, fontsize=9)
    lower.set_xticks((0.05, 0.1, 0.2, 0.5, 1, 2), ("0.05", "0.1", "0.2", "0.5", "1", "2"))
    lower.set_yticks((2, 5, 10, 20, 50, 100), ("2", "5", "10", "20", "50", "100"))
    for axis in (lower.xaxis, lower.yaxis):
        axis.set_ticks([], minor=True)
    save(drawing, path)


if __name__ == "__main__":
    STATES = [wetted(share) for share in SHARES]
    report(STATES)
    if len(sys.argv) > 1:
        draw(STATES, Path(sys.argv[1]))
