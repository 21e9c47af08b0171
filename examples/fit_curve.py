"""What does a pull-off curve tell of angle and volume? ``python examples/fit_curve.py [picture.svg]``.

A made curve: two glass beads of 1 mm with 10 nL of water and a contact angle of 28° are pulled apart by a balance whose
zero of the gap is 3 µm off and whose noise is 1 µN. Three fits of it: without and with the rupture as a datum, and by a
law in the place of the exact bridge.
"""

import sys
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.fitting.plots import fit_figure
from pendular.show.picture import save

BEADS, WATER = pl.Pair(radius=1e-3, contact_angle=np.deg2rad(28)), pl.Liquid.water(temperature=293.15)
VOLUME, SHIFT, NOISE = 10e-12, 3e-6, 1e-6


def made_curve() -> tuple[np.ndarray, np.ndarray]:
    """Separation and force as the balance tells them, up to some way beyond rupture."""
    end = pl.rupture(BEADS, volume=VOLUME, liquid=WATER).separation
    gap = np.linspace(0.0, 1.15 * end, 60)
    force = pl.bridge(BEADS, gap, volume=VOLUME, liquid=WATER).force
    return gap - SHIFT, force + NOISE * np.random.default_rng(28).normal(size=gap.size)


def told(fit: pl.Fit) -> str:
    """The numbers of a fit in one line."""
    angle, volume, offset = (
        f"{factor * fit.values[name]:.{digits}f} ± {factor * fit.errors[name]:.{digits}f} {unit}"
        for name, factor, digits, unit in (
            ("contact_angle", 180.0 / np.pi, 1, "deg"),
            ("volume", 1e12, 2, "nL"),
            ("offset", 1e6, 1, "µm"),
        )
    )
    return f"angle {angle}, volume {volume}, offset {offset}"


def main() -> None:
    """Print the three fits beside the truth."""
    separation, force = made_curve()
    apart = force > 10.0 * NOISE
    guess = pl.Pair(radius=1e-3, contact_angle=0.1)
    print(f"truth: angle 28 deg, volume {1e12 * VOLUME:g} nL, offset {1e6 * SHIFT:g} µm")
    asked = {"volume": 5e-12, "liquid": WATER}
    force_alone = pl.fit(separation[apart], force[apart], guess, **asked)
    print(f"force alone: {told(force_alone)}")
    with_rupture = pl.fit(separation, force, guess, rupture="jump", **asked)
    print(f"and rupture: {told(with_rupture)}")
    by_law = pl.fit(separation[apart], force[apart], guess, method="willett2000", **asked)
    print(f"by a law:    {told(by_law)}")
    for note in force_alone.notes:
        print(f"note: {note}")
    if len(sys.argv) > 1:
        picture = fit_figure(with_rupture, title="Two beads of 1 mm", subtitle="water, made curve, rupture as a datum")
        save(picture, Path(sys.argv[1]))


if __name__ == "__main__":
    main()
