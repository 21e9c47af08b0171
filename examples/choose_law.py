"""Which law for my wet glass beads? ``python examples/choose_law.py [picture.svg]``.

Glass beads of 200 µm with 1 % of water by mass, all of it in bridges between the six neighbours that each bead has.
The volume of a bridge follows, and with it the law that is best over all that may happen to it: any contact angle that
water may show on glass, up to 25°, and any share of the liquid from a tenth to twice the mean.
"""

import sys
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.comparison.plots import comparison_figure
from pendular.show.picture import save

RADIUS = 100e-6
GLASS_DENSITY, WATER_DENSITY = 2500.0, 998.2  # [kg/m³]
MOISTURE, NEIGHBOURS = 0.01, 6
LARGEST_ANGLE = np.deg2rad(25)
BEADS = pl.Pair(radius=RADIUS, contact_angle=np.deg2rad(15))
WATER = pl.Liquid.water(temperature=293.15)


def bridge_volume() -> float:
    """Liquid of a bead over its half of each bridge, [m³]."""
    liquid = MOISTURE * GLASS_DENSITY / WATER_DENSITY * 4.0 / 3.0 * np.pi * RADIUS**3
    return liquid / (NEIGHBOURS / 2)


def main() -> None:
    """Print the ranking, and what the best law makes of the mean bridge."""
    volume = bridge_volume()
    reduced = volume / BEADS.derjaguin_radius**3
    print(f"a bridge holds {1e15 * volume:.2f} pL, V* = {reduced:.3g}")
    found = pl.recommend(reduced_volume=(0.1 * reduced, 2.0 * reduced), contact_angle=(0.0, LARGEST_ANGLE))
    for place, law in enumerate(found.ranked[:4], start=1):
        rupture = "gives none" if np.isnan(law.rupture_error) else f"within {law.rupture_error:.1%}"
        print(f"{place}. {law.name:<16} force within {law.largest_error:.1%}, rupture distance {rupture}")
    best = found.ranked[0].name
    for method in ("exact", best):
        force = pl.bridge(BEADS, [0.0, 10e-6, 30e-6], volume=volume, liquid=WATER, method=method).force
        end = pl.rupture(BEADS, volume=volume, liquid=WATER, method=method).separation
        told = ", ".join(f"{1e6 * value:.2f}" for value in force)
        print(f"{method:<10} {told} µN at gaps of 0, 10 and 30 µm; breaks at {1e6 * end:.1f} µm")
    if len(sys.argv) > 1:
        beads = pl.compare(BEADS, volume=volume, liquid=WATER)
        title = "Glass beads of 200 µm with 1 % of water"
        told = f"six bridges a bead, {1e15 * volume:.2f} pL each, contact angle 15°"
        save(comparison_figure(beads, title=title, subtitle=told), Path(sys.argv[1]))


if __name__ == "__main__":
    main()
