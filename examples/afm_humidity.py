"""How hard does humid air hold an AFM tip on a flat sample? ``python examples/afm_humidity.py [picture.svg]``.

A silicon tip of 20 nm on glass, at 40 to 90 % relative humidity and 20 °C: pull-off force, snap-off distance and the
radius of curvature of the meniscus, which tells down to where the Kelvin equation may be trusted.
"""

import sys
import warnings
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ask.liquid import DOUBTFUL_CURVATURE_RADIUS as DOUBTFUL
from pendular.ground.colours import FAINT, LIQUID
from pendular.ground.look import HELD, TITLE, panels
from pendular.show.picture import save

TIP = pl.Pair(radius=(20e-9, np.inf), contact_angle=(np.deg2rad(10), np.deg2rad(40)))
WATER = pl.Liquid.water(temperature=293.15)
HUMIDITY = np.array([0.4, 0.5, 0.6, 0.7, 0.8, 0.9])


def report() -> None:
    """Print a line for each humidity."""
    contact = pl.bridge(TIP, 0.0, humidity=HUMIDITY, liquid=WATER)
    end = pl.rupture(TIP, humidity=HUMIDITY, liquid=WATER)
    radius = WATER.surface_tension / contact.suction
    print("humidity   suction   meniscus     force   snaps off at")
    rows = zip(HUMIDITY, contact.suction, radius, contact.force, end.separation, strict=True)
    for humidity, suction, curvature, force, gap in rows:
        note = "  continuum doubtful" if curvature < DOUBTFUL else ""
        told = f"{humidity:>8.0%} {1e-6 * suction:>6.1f} MPa {1e9 * curvature:>7.2f} nm"
        print(f"{told} {1e9 * force:>6.2f} nN {1e9 * gap:>11.2f} nm{note}")


def draw(path: Path) -> None:
    """Draw the force against the gap at each humidity, and at contact against the humidity."""
    drawing, (upper, lower) = panels(2.9, 2.6)
    curve = pl.curve(TIP, humidity=HUMIDITY, liquid=WATER, points=201)
    for i, humidity in enumerate(HUMIDITY):
        on = curve.stable[i]
        upper.plot(1e9 * curve.separation[i, on], 1e9 * curve.force[i, on], color=HELD["humidity"], lw=1 + i / 3)
        gap, force = 1e9 * curve.separation[i, on][-1], 1e9 * curve.force[i, on][-1]
        below = -21 if i == 1 else -11  # the first ones end close together
        upper.annotate(f"{humidity:.0%}", (gap, force), (0, below), textcoords="offset points", ha="center", size=9)
    upper.set(xlabel="gap (nm)", ylabel="force (nN)", ylim=(-0.8, None))
    upper.set_title("A tip of 20 nm pulled off a plate", **TITLE)
    many = np.linspace(0.4, 0.95, 56)
    contact = pl.bridge(TIP, 0.0, humidity=many, liquid=WATER)
    radius = WATER.surface_tension / contact.suction
    lower.plot(100 * many, 1e9 * contact.force, color=HELD["humidity"], lw=2)
    trusted = 100 * np.interp(DOUBTFUL, radius, many)
    lower.axvspan(40, trusted, color=LIQUID, alpha=0.35, lw=0)
    lower.annotate(
        "meniscus below 4 nm:\ncontinuum doubtful", (41, 0.06 * 1e9 * contact.force.max()), size=9, color=FAINT
    )
    lower.set(xlabel="relative humidity (%)", ylabel="force (nN)", ylim=(0, None), xlim=(40, 95))
    lower.set_title("Force at contact", **TITLE)
    save(drawing, path)


if __name__ == "__main__":
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pl.KelvinWarning)  # the last column says the same
        report()
        if len(sys.argv) > 1:
            draw(Path(sys.argv[1]))
