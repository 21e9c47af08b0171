"""Does it matter whether a bridge can exchange liquid with the air? ``python examples/evaporation.py [picture.svg]``.

Two grains of 50 µm are pulled apart from contact twice, from the same bridge of 2 pL. Slowly: the vapour keeps the
suction, and the bridge evaporates as it is stretched. Fast: it keeps its volume, and its suction changes.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

import pendular as pl
from pendular.ground.colours import ACCENT, HAIR, LIQUID_EDGE

GRAINS = pl.Pair(radius=50e-6, contact_angle=np.deg2rad(20))
WATER = pl.Liquid.water(temperature=293.15)
VOLUME = 2e-15
START = pl.bridge(GRAINS, 0.0, volume=VOLUME, liquid=WATER)
HELD = {"constant suction": {"suction": START.suction}, "constant volume": {"volume": VOLUME}}


def report() -> None:
    """Print what the two pulls have in common and what not."""
    print(f"at contact: {1e6 * START.force:.3f} µN, {1e15 * VOLUME:g} pL, {1e-3 * START.suction:.3f} kPa")
    for name, held in HELD.items():
        end = pl.rupture(GRAINS, **held, liquid=WATER)
        potential = "grand_potential" if "suction" in held else "surface_energy"  # whose slope is the force
        work = getattr(end, potential) - getattr(START, potential)
        curve = pl.curve(GRAINS, **held, liquid=WATER, points=4001)
        on = slice(0, np.argmax(curve.separation) + 1)
        by_force = np.trapezoid(curve.force[on], curve.separation[on])
        print(f"{name}: breaks at {1e6 * end.separation:.2f} µm with {1e15 * end.volume:.3f} pL at ", end="")
        print(f"{1e-3 * end.suction:.2f} kPa; work {1e12 * work:.2f} pJ, {1e12 * by_force:.2f} pJ by its force")


def draw(path: Path) -> None:
    """Draw force, volume and suction against the separation, for both pulls."""
    shown = {"force": (1e6, "force (µN)"), "volume": (1e15, "volume (pL)"), "suction": (1e-3, "suction (kPa)")}
    with rc_context({"axes.spines.top": False, "axes.spines.right": False, "svg.fonttype": "path"}):
        drawing = Figure(figsize=(5.2, 7.4), layout="constrained")
        panels = drawing.subplots(3, 1, sharex=True)
    for (name, held), color in zip(HELD.items(), (LIQUID_EDGE, ACCENT), strict=True):
        curve = pl.curve(GRAINS, **held, liquid=WATER, points=401)
        on = curve.stable
        for axes, (field, (scale, label)) in zip(panels, shown.items(), strict=True):
            gap, value = 1e6 * curve.separation, scale * getattr(curve, field)
            axes.plot(gap[on], value[on], color=color, lw=2, label=name)
            axes.plot(gap[~on], value[~on], color=color, lw=1, ls="--")
            end = np.flatnonzero(on)[-1]
            axes.plot(gap[end], value[end], "o", color=color, ms=5)
            axes.set(ylabel=label)
            axes.grid(color=HAIR, alpha=0.25, lw=0.6)
    panels[0].set(ylim=(0, None))
    panels[-1].set(xlabel="separation (µm)")
    panels[0].legend(frameon=False, fontsize=9)
    drawing.savefig(path)


if __name__ == "__main__":
    report()
    if len(sys.argv) > 1:
        draw(Path(sys.argv[1]))
