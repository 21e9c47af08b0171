"""What do water bridges do in a fine soil as it dries? ``python examples/soil_suction.py [picture.svg]``.

Two touching grains of 74 µm, the border between silt and sand, at suctions from 1 to 1000 kPa and a contact angle of
0°. Neighbours that touch at 60° to each other merge their bridges once the half-filling angle reaches 30°: above it a
bridge between two grains alone is no description of a soil. The last column is the error of a fit that is much used.
"""

import sys
import warnings
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ground.colours import ACCENT, FAINT, LIQUID
from pendular.ground.look import HELD, TITLE, panels
from pendular.show.picture import save

RADIUS = 37e-6
GRAINS = pl.Pair(radius=RADIUS, contact_angle=0.0)
WATER = pl.Liquid.water(temperature=293.15)
MERGING = np.deg2rad(30)


def report(suction: np.ndarray) -> None:
    """Print a line for each suction."""
    contact = pl.bridge(GRAINS, 0.0, suction=suction, liquid=WATER)
    end = pl.rupture(GRAINS, suction=suction, liquid=WATER)
    fit = pl.rupture(GRAINS, suction=suction, liquid=WATER, method="zhao2020")
    print("   suction      H*   half filling    force    volume  breaks at  zhao2020")
    for i, pressure in enumerate(suction):
        reduced = pressure * RADIUS / WATER.surface_tension
        angle = contact.half_filling_angle[i, 0]
        merged = "merged" if angle > MERGING else ""
        told = f"{1e-3 * pressure:>6.0f} kPa {reduced:>7.2f} {np.rad2deg(angle):>6.1f}° {merged:<7}"
        told += (
            f"{1e6 * contact.force[i]:>6.2f} µN {1e15 * contact.volume[i]:>6.4g} pL {1e6 * end.separation[i]:>6.2f} µm"
        )
        print(f"{told} {fit.separation[i] / end.separation[i] - 1:>+9.1%}")


def pendular_from() -> float:
    """Suction from which on the bridges of touching neighbours stay apart, [Pa], by bisection."""
    low, high = 1e3, 1e6
    while high / low > 1.0001:
        middle = (low * high) ** 0.5
        angle = pl.bridge(GRAINS, 0.0, suction=middle, liquid=WATER).half_filling_angle[0]
        low, high = (middle, high) if angle > MERGING else (low, middle)
    return high


def draw(path: Path) -> None:
    """Draw force and rupture distance against the suction."""
    suction = np.geomspace(1e3, 1e6, 121)
    drawing, (upper, lower) = panels(2.9, 2.7)
    gaps = (0.0, 0.1e-6, 1e-6, 5e-6)
    for gap, width in zip(gaps, (2.4, 1.8, 1.3, 0.9), strict=True):
        bridge = pl.bridge(GRAINS, gap, suction=suction, liquid=WATER)
        held = np.where(bridge.exists, 1e6 * bridge.force, np.nan)
        upper.semilogx(1e-3 * suction, held, color=HELD["suction"], lw=width)
        last = np.flatnonzero(bridge.exists)[-1]
        spot = (1e-3 * suction[last], held[last])
        label = "touching" if gap == 0.0 else f"{1e6 * gap:g} µm"
        upper.annotate(label, spot, (-4, 5 if gap == 0.0 else -10), textcoords="offset points", ha="right", size=9)
    upper.set(ylabel="force (µN)", ylim=(0, 18))
    upper.set_title("Force at four gaps, each until it breaks", **TITLE)
    exact = pl.rupture(GRAINS, suction=suction, liquid=WATER).separation
    fit = pl.rupture(GRAINS, suction=suction, liquid=WATER, method="zhao2020").separation
    lower.loglog(1e-3 * suction, 1e6 * exact, color=HELD["suction"], lw=2.4, label="exact")
    lower.loglog(1e-3 * suction, 1e6 * fit, color=ACCENT, lw=1.2, ls="--", label="zhao2020")
    lower.set(ylabel="rupture distance (µm)")
    lower.legend(frameon=False, fontsize=9)
    lower.yaxis.set_major_formatter("{x:g}")
    for axes in (upper, lower):
        axes.axvspan(1, 1e-3 * pendular_from(), color=LIQUID, alpha=0.35, lw=0)
        axes.set(xlabel="suction (kPa)", xlim=(1, 1000))
        axes.xaxis.set_major_formatter("{x:g}")
    upper.annotate("neighbours\nmerged", (1.15, 1.0), size=9, color=FAINT)
    save(drawing, path)


if __name__ == "__main__":
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pl.RangeWarning)  # the error of the fit outside its range is what is asked
        report(np.array([1e3, 3e3, 10e3, 30e3, 100e3, 300e3, 1000e3]))
        print(f"bridges of touching neighbours stay apart from {1e-3 * pendular_from():.2f} kPa on")
        if len(sys.argv) > 1:
            draw(Path(sys.argv[1]))
