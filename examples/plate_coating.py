"""How thin does a drop between two plates spread, and how hard are they to part? ``python examples/plate_coating.py``.

A drop of 5 µl of resin between a slide and a cover glass of 18 mm. Its own suction draws the plates together; a spacer
holds them at a gap. For each gap: how wide the drop spreads, how hard it pulls, what the usual formula, the pressure
2γ cosθ/D over the wetted area, makes of that, and the weight of the liquid over its suction, which is left out.
At last the plates are drawn apart until the liquid parts.
"""

import sys
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ground.colours import ACCENT, INK
from pendular.ground.look import TITLE, angle_colour, panels
from pendular.show.picture import save

VOLUME, ANGLES = 5e-9, (20.0, 60.0, 80.0)  # [m³]; [degrees]
RESIN = pl.Liquid(surface_tension=0.035)  # an uncured acrylic or epoxy resin, of that order
COVER = 9e-3  # half the width of the cover glass, [m]
DENSITY, GRAVITY = 1100.0, 9.81


def plates(degrees: float) -> pl.Pair:
    """Two plates of one contact angle."""
    return pl.Pair(radius=np.inf, contact_angle=np.deg2rad(degrees))


def usual(gap: np.ndarray, degrees: float) -> np.ndarray:
    """Force by the pressure of a thin film, [N]."""
    return 2.0 * RESIN.surface_tension * np.cos(np.deg2rad(degrees)) * VOLUME / gap**2


def report() -> None:
    """Print a line for each gap at 20°, and where the resin parts at each angle."""
    gaps = np.array([10e-6, 20e-6, 50e-6, 100e-6, 200e-6, 500e-6, 1e-3])
    bridge = pl.bridge(plates(20.0), gaps, volume=VOLUME, liquid=RESIN)
    print("    gap   wetted to   suction       force   usual formula   weight")
    for i, gap in enumerate(gaps):
        told = f"{1e6 * gap:>4.0f} µm {1e3 * bridge.contact_radius[i, 0]:>8.2f} mm {bridge.suction[i]:>7.0f} Pa"
        told += f" {1e3 * bridge.force[i]:>8.2f} mN {usual(gap, 20.0) / bridge.force[i] - 1:>+12.1%}"
        told += f" {DENSITY * GRAVITY * gap / bridge.suction[i]:>11.1%}"
        print(told + ("   runs out" if bridge.contact_radius[i, 0] > COVER else ""))
    for degrees in ANGLES:
        end = pl.rupture(plates(degrees), volume=VOLUME, liquid=RESIN)
        print(f"{degrees:g}°: parts at {1e3 * end.separation:.2f} mm, were it without weight")


def draw(path: Path) -> None:
    """Draw force and wetted radius against the gap."""
    drawing, (upper, lower) = panels(2.9, 2.5, share_x=True)
    for degrees in ANGLES:
        end = float(pl.rupture(plates(degrees), volume=VOLUME, liquid=RESIN).separation)
        gaps = np.geomspace(10e-6, end, 150)
        bridge = pl.bridge(plates(degrees), gaps, volume=VOLUME, liquid=RESIN)
        colour = angle_colour(degrees)
        upper.loglog(1e6 * gaps, 1e3 * bridge.force, color=colour, lw=2, label=f"contact angle {degrees:g}°")
        upper.loglog(1e6 * gaps, 1e3 * usual(gaps, degrees), color=colour, lw=1, ls=(0, (4, 2)))
        upper.plot(1e6 * gaps[-1], 1e3 * bridge.force[-1], "o", color=colour, ms=5)
        lower.loglog(1e6 * gaps, 1e3 * bridge.contact_radius[:, 0], color=colour, lw=2)
    upper.plot([], [], color=INK, lw=1, ls=(0, (4, 2)), label="usual formula")
    upper.set(ylabel="force (mN)")
    upper.legend(frameon=False, fontsize=9, loc="lower left")
    upper.set_title("5 µl of resin between two plates", **TITLE)
    lower.axhline(1e3 * COVER, color=ACCENT, lw=1)
    place = (150, 1e3 * COVER)
    lower.annotate("edge of the cover glass", place, (0, 4), textcoords="offset points", size=9, color=ACCENT)
    lower.set(xlabel="gap (µm)", ylabel="wetted radius (mm)", yticks=(2, 5, 10, 20))
    lower.set_yticks([], minor=True)
    for axes in (upper, lower):
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter("{x:g}")
    save(drawing, path)


if __name__ == "__main__":
    report()
    if len(sys.argv) > 1:
        draw(Path(sys.argv[1]))
