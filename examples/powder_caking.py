"""From which humidity on does salt cake? ``python examples/powder_caking.py [picture.svg]``.

Two touching grains of table salt, 200 µm. Below 75 % relative humidity salt stays dry, yet where grains touch a bridge
of saturated solution condenses: salt in it lowers the vapour pressure to the water activity a, so that the suction of
the bridge is that of the humidity h/a. When the air dries, the salt of the bridge stays behind as a neck of crystal.
"""

import sys
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ground.colours import FAINT, INK
from pendular.ground.look import HELD, TITLE, panels
from pendular.show.picture import save

RADIUS, TEMPERATURE = 100e-6, 298.15
ACTIVITY = 0.7529  # of water over saturated solution, 25 °C: L. Greenspan, J. Res. NBS 81A (1977) 89
SOLUTION, CRYSTAL, SALT = 1197.0, 2165.0, 0.264  # densities [kg/m³]; mass of salt in a mass of solution
BRINE = pl.Liquid(surface_tension=0.080)  # K. G. Nayar et al., J. Phys. Chem. Ref. Data 43 (2014) 043103, carried on
WATER = pl.Liquid.water(temperature=TEMPERATURE)
GRAINS = pl.Pair(radius=RADIUS, contact_angle=0.0)
SALT_BREAKS = 2e6  # tension, [Pa], of the order of rock salt


def bridge_at(humidity: np.ndarray) -> pl.Bridge:
    """Bridges of saturated solution between touching grains in air of a humidity."""
    return pl.bridge(GRAINS, 0.0, suction=pl.suction_from_humidity(humidity / ACTIVITY, WATER), liquid=BRINE)


def neck_of(bridge: pl.Bridge) -> np.ndarray:
    """Radius of the neck of crystal that a bridge leaves, [m]: the gap of two spheres, r²/R, filled up to it."""
    crystal = SALT * SOLUTION / CRYSTAL * bridge.volume
    return (2.0 * RADIUS * crystal / np.pi) ** 0.25


def caking(strength: float) -> float:
    """Humidity from which on the dried neck is stronger than the bridge was, by bisection of its distance to a."""
    low, high = 1e-5, 0.2
    while high / low > 1.0001:
        middle = (low * high) ** 0.5
        bridge = bridge_at(ACTIVITY - middle)
        is_stronger = strength * np.pi * neck_of(bridge) ** 2 > bridge.force
        low, high = (middle, high) if is_stronger else (low, middle)
    return ACTIVITY - low


def tensile_strength(force: np.ndarray) -> np.ndarray:
    """Of a heap with 60 % of solid and 6 contacts a grain, by Rumpf's formula, [Pa]."""
    return 0.6 * 6.0 * force / (np.pi * (2.0 * RADIUS) ** 2)


def report() -> None:
    """Print a line for each humidity."""
    humidity = np.array([0.60, 0.65, 0.70, 0.73, 0.745, 0.75])
    bridge = bridge_at(humidity)
    neck = neck_of(bridge)
    print("humidity   meniscus   force wet   neck dried   force dried   strength wet   dried")
    for i, share in enumerate(humidity):
        wet, dried = bridge.force[i], SALT_BREAKS * np.pi * neck[i] ** 2
        told = f"{share:>7.1%} {1e9 * BRINE.surface_tension / bridge.suction[i]:>8.1f} nm {1e6 * wet:>8.1f} µN"
        told += f" {1e6 * neck[i]:>9.2f} µm {1e6 * dried:>10.1f} µN {1e-3 * tensile_strength(wet):>11.2f} kPa"
        print(f"{told} {1e-3 * tensile_strength(dried):>5.2f} kPa")
    for strength in (SALT_BREAKS, 10.0 * SALT_BREAKS):
        print(f"crystal of {1e-6 * strength:g} MPa: stronger dried than wet from {caking(strength):.1%} on")


def draw(path: Path) -> None:
    """Draw the forces wet and dried, and the radii of bridge and crystal, against the humidity."""
    humidity = ACTIVITY - np.geomspace(0.16, 5e-4, 200)
    bridge = bridge_at(humidity)
    neck = neck_of(bridge)
    drawing, (upper, lower) = panels(2.7, 2.6, share_x=True)
    upper.semilogy(100 * humidity, 1e6 * bridge.force, color=HELD["humidity"], lw=2)
    upper.semilogy(100 * humidity, 1e6 * SALT_BREAKS * np.pi * neck**2, color=INK, lw=1.6, ls=(0, (4, 2)))
    upper.annotate("liquid bridge", (62, 58), size=9, color=HELD["humidity"])
    upper.annotate("its salt, once dried", (61, 3), size=9, color=INK)
    upper.set(ylabel="force (µN)", ylim=(0.8, 300))
    upper.set_title("What holds two grains of salt", **TITLE)
    lower.semilogy(100 * humidity, 1e6 * bridge.neck_radius, color=HELD["humidity"], lw=2, label="neck of the bridge")
    lower.semilogy(100 * humidity, 1e6 * neck, color=INK, lw=1.6, ls=(0, (4, 2)), label="neck of crystal")
    lower.set(xlabel="relative humidity (%)", ylabel="radius (µm)", xlim=(60, 76))
    lower.legend(frameon=False, fontsize=9)
    for axes in (upper, lower):
        axes.axvline(100 * ACTIVITY, color=FAINT, lw=0.8)
        axes.yaxis.set_major_formatter("{x:g}")
    upper.annotate("salt\ndissolves", (100 * ACTIVITY, 1.0), (-4, 0), textcoords="offset points", ha="right", size=9)
    save(drawing, path)


if __name__ == "__main__":
    report()
    if len(sys.argv) > 1:
        draw(Path(sys.argv[1]))
