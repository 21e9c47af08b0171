"""Does it matter whether a bridge can exchange liquid with the air? ``python examples/evaporation.py [picture.svg]``.

Two grains of 50 µm are pulled apart from contact twice, from the same bridge of 2 pL. Slowly: the vapour keeps the
suction, and the bridge evaporates as it is stretched. Fast: it keeps its volume, and its suction changes.
"""

import sys
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ground.look import HELD, panels
from pendular.show.picture import save

GRAINS = pl.Pair(radius=50e-6, contact_angle=np.deg2rad(20))
WATER = pl.Liquid.water(temperature=293.15)
VOLUME = 2e-15
START = pl.bridge(GRAINS, 0.0, volume=VOLUME, liquid=WATER)
PULLS = {"suction": START.suction, "volume": VOLUME}


def report() -> None:
    """Print what the two pulls have in common and what not."""
    print(f"at contact: {1e6 * START.force:.3f} µN, {1e15 * VOLUME:g} pL, {1e-3 * START.suction:.3f} kPa")
    for held, value in PULLS.items():
        end = pl.rupture(GRAINS, **{held: value}, liquid=WATER)
        potential = "grand_potential" if held == "suction" else "surface_energy"  # whose slope is the force
        work = getattr(end, potential) - getattr(START, potential)
        curve = pl.curve(GRAINS, **{held: value}, liquid=WATER, points=4001)
        on = slice(0, np.argmax(curve.separation) + 1)
        by_force = np.trapezoid(curve.force[on], curve.separation[on])
        print(f"constant {held}: breaks at {1e6 * end.separation:.2f} µm with {1e15 * end.volume:.3f} pL at ", end="")
        print(f"{1e-3 * end.suction:.2f} kPa; work {1e12 * work:.2f} pJ, {1e12 * by_force:.2f} pJ by its force")


def draw(path: Path) -> None:
    """Draw force, volume and suction against the separation, for both pulls."""
    shown = {"force": (1e6, "force (µN)"), "volume": (1e15, "volume (pL)"), "suction": (1e-3, "suction (kPa)")}
    drawing, rows = panels(2.2, 2.0, 2.2, share_x=True)
    for held, value in PULLS.items():
        curve = pl.curve(GRAINS, **{held: value}, liquid=WATER, points=401)
        on = curve.stable
        for axes, (field, (scale, label)) in zip(rows, shown.items(), strict=True):
            x, y = 1e6 * curve.separation, scale * getattr(curve, field)
            axes.plot(x[on], y[on], color=HELD[held], lw=2, label=f"constant {held}")
            axes.plot(x[~on], y[~on], color=HELD[held], lw=1, ls="--")
            end = np.flatnonzero(on)[-1]
            axes.plot(x[end], y[end], "o", color=HELD[held], ms=5)
            axes.set(ylabel=label)
    rows[0].set(ylim=(0, None))
    rows[-1].set(xlabel="separation (µm)")
    rows[0].legend(frameon=False, fontsize=9)
    save(drawing, path)


if __name__ == "__main__":
    report()
    if len(sys.argv) > 1:
        draw(Path(sys.argv[1]))
