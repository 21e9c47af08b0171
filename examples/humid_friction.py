"""Does humid air make sand steeper? ``python examples/humid_friction.py [picture.svg]``.

A layer of glass beads of 0.2 mm on a slope. Bridges that condense from the air press the beads together; the layer
slides where its weight along the slope beats friction, which bears on weight and bridges. Real beads are rough: they
touch at asperities, which leave a gap at each contact, here of an exponential distribution. A bridge spans it, or not.
"""

import sys
import warnings
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ground.colours import FAINT, HAIR, INK
from pendular.ground.look import HELD, TITLE, panels
from pendular.show.picture import save

RADIUS, ANGLE = 100e-6, np.deg2rad(20)
SOLID, CONTACTS, DENSITY, GRAVITY = 0.6, 6.0, 2500.0, 9.81
LAYER, DRY = 10e-3, np.deg2rad(25)  # thickness [m], and the slope at which it slides dry
ROUGHNESS = (0.0, 10e-9, 100e-9, 1e-6)  # mean gap, [m]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(48)
BEADS, WATER = pl.Pair(radius=RADIUS, contact_angle=ANGLE), pl.Liquid.water(temperature=293.15)


def bridged(humidity: np.ndarray, roughness: float) -> tuple[np.ndarray, np.ndarray]:
    """Share of the contacts that hold a bridge, and the stress of all by Rumpf's formula, [Pa]."""
    if roughness == 0.0:
        force = pl.bridge(BEADS, 0.0, humidity=humidity, liquid=WATER).force
        share = np.ones(humidity.size)
    else:
        end = pl.rupture(BEADS, humidity=humidity, liquid=WATER).separation[:, None]
        q = 0.5 * (NODES + 1.0)  # the gap is (1 - q²) of the rupture distance: the force is smooth in q
        gaps = end * (1.0 - q**2)
        density = np.exp(-gaps / roughness) / roughness * end * q * WEIGHTS
        force = (pl.bridge(BEADS, gaps, humidity=humidity[:, None], liquid=WATER).force * density).sum(axis=1)
        share = -np.expm1(-end[:, 0] / roughness)
    return share, SOLID * CONTACTS * force / (np.pi * (2.0 * RADIUS) ** 2)


def steepest(stress: np.ndarray) -> np.ndarray:
    """Slope at which the layer slides, [rad]: ρgh sin α = tan φ (ρgh cos α + σ); a right angle where it holds at any.

    With s = sin φ σ/(ρgh) it is sin(α - φ) = s.
    """
    lift = np.sin(DRY) * stress / (SOLID * DENSITY * GRAVITY * LAYER)
    return np.minimum(DRY + np.arcsin(np.minimum(lift, 1.0)), 0.5 * np.pi)


def report() -> None:
    """Print bridged contacts, stress and slope for each roughness at some humidities."""
    humidity = np.array([0.3, 0.6, 0.8, 0.9, 0.95, 0.99, 0.999])
    print("mean gap              ", "".join(f"{share:>9.1%}" for share in humidity))
    for roughness in ROUGHNESS:
        share, stress = bridged(humidity, roughness)
        slope = np.rad2deg(steepest(stress))
        print(f"{1e9 * roughness:>5.0f} nm    bridged    ", "".join(f"{value:>9.1%}" for value in share))
        print("            stress, Pa ", "".join(f"{value:>9.1f}" for value in stress))
        print("            slides at   ", "".join(f"{value:>8.1f}°" for value in slope))


def draw(path: Path) -> None:
    """Draw the steepest slope against the humidity."""
    drawing, (axes,) = panels(3.4)
    humidity = np.concatenate([np.linspace(0.2, 0.95, 76), 1.0 - np.geomspace(0.05, 2e-4, 60)])
    for roughness, width in zip(ROUGHNESS, (2.6, 2.0, 1.5, 1.0), strict=True):
        slope = np.rad2deg(steepest(bridged(humidity, roughness)[1]))
        axes.plot(100 * humidity, slope, color=HELD["humidity"], lw=width)
    for text, place in (("smooth", (22, 86)), ("10 nm", (62, 68)), ("100 nm", (77, 42)), ("1 µm", (85, 22.5))):
        axes.annotate(text, place, size=9, color=INK)
    axes.axhline(np.rad2deg(DRY), color=HAIR, lw=1, zorder=1)
    axes.annotate("dry", (21, 22.5), size=9, color=FAINT)
    axes.set(xlim=(20, 100), ylim=(20, 92), ylabel="slides at a slope of (°)", xlabel="relative humidity (%)")
    axes.set_title("A layer of 10 mm, beads of 0.2 mm", **TITLE)
    save(drawing, path)


if __name__ == "__main__":
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pl.KelvinWarning)  # the answer says where
        report()
        if len(sys.argv) > 1:
            draw(Path(sys.argv[1]))
