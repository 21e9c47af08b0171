"""Does a drop on a tool set the ball down again? ``python examples/microgripper.py [picture.svg]``.

A steel ball of 0.5 mm, as in the bearing of a watch, hangs by a drop of water on a flat tool that is hard to wet. It is
to be set down on a seat with a drop of its own. Drawn apart, both bridges bear the same force, up to the weight of the
ball. Each holds up to its largest pull, at contact or next to it; beyond, it pulls less with every step, and gives way.
"""

import sys
from pathlib import Path

import numpy as np

import pendular as pl
from pendular.ground.colours import FAINT, INK
from pendular.ground.look import TITLE, angle_colour, panels
from pendular.show.picture import save

RADIUS, STEEL, GRAVITY = 0.25e-3, 7800.0, 9.81
BALL, SEAT = 30.0, 20.0  # contact angles, [degrees]
TOOLS = (30.0, 60.0, 90.0)
SEAT_VOLUME = 1e-12  # 1 nl
WEIGHT = 4.0 / 3.0 * np.pi * RADIUS**3 * STEEL * GRAVITY
WATER = pl.Liquid.water(temperature=293.15)


def on(degrees: float) -> pl.Pair:
    """The ball on a flat solid."""
    return pl.Pair(radius=(RADIUS, np.inf), contact_angle=(np.deg2rad(BALL), np.deg2rad(degrees)))


def pull(degrees: float, volume: float, gap: float) -> float:
    """Force of a drop on a flat solid, [N]."""
    return float(pl.bridge(on(degrees), gap, volume=volume, liquid=WATER).force)


def hold(degrees: float, volume: np.ndarray | float) -> np.ndarray:
    """Largest force of a drop between contact and half of its rupture distance, [N]."""
    end = pl.rupture(on(degrees), volume=volume, liquid=WATER).separation
    gaps = np.multiply.outer(np.linspace(0.0, 0.5, 51), end)
    return pl.bridge(on(degrees), gaps, volume=volume, liquid=WATER).force.max(axis=0)


def report() -> None:
    """Print what holds the ball on each tool, and whether the seat takes it."""
    seat = float(hold(SEAT, SEAT_VOLUME))
    print(f"weight {1e6 * WEIGHT:.2f} µN; the seat holds {1e6 * seat:.2f} µN with {1e12 * SEAT_VOLUME:g} nl")
    print("tool    drop     holds   times the weight   reaches   ball goes to")
    for degrees in TOOLS:
        for volume in (0.1e-12, 1e-12, 5e-12):
            held, end = float(hold(degrees, volume)), pl.rupture(on(degrees), volume=volume, liquid=WATER)
            goes = "seat" if seat + WEIGHT > held else "tool"
            told = f"{degrees:>3g}° {1e12 * volume:>5.1f} nl {1e6 * held:>6.1f} µN {held / WEIGHT:>14.1f}"
            print(f"{told} {1e6 * end.separation:>14.1f} µm   {goes}")
    rough = [pull(90.0, volume, 2e-6) / pull(90.0, volume, 0.0) for volume in (1e-12, 1e-16)]
    print(f"left at a roughness of 2 µm: {rough[0]:.0%} of the force with 1 nl, {rough[1]:.0%} with 0.0001 nl")


def draw(path: Path) -> None:
    """Draw the hold of each tool and of the seat against the volume, and their curves for 1 nl."""
    drawing, (upper, lower) = panels(2.8, 2.6)
    volumes = np.geomspace(1e-14, 1e-11, 120)
    seat = 1e6 * float(hold(SEAT, SEAT_VOLUME))
    for degrees in TOOLS:
        colour = angle_colour(degrees)
        upper.semilogx(1e12 * volumes, 1e6 * hold(degrees, volumes), color=colour, lw=2, label=f"tool {degrees:g}°")
        end = float(pl.rupture(on(degrees), volume=1e-12, liquid=WATER).separation)
        gaps = np.linspace(0.0, end, 200)
        force = pl.bridge(on(degrees), gaps, volume=1e-12, liquid=WATER).force
        lower.plot(1e6 * gaps, 1e6 * force, color=colour, lw=2)
        lower.plot(1e6 * gaps[-1], 1e6 * force[-1], "o", color=colour, ms=5)
    upper.axhline(seat, color=INK, lw=1.4, ls=(0, (4, 2)), label="seat 20°, 1 nl")
    upper.set(xlabel="drop on the tool (nl)", ylabel="largest force (µN)", ylim=(0, None), xlim=(0.01, 10))
    upper.xaxis.set_major_formatter("{x:g}")
    upper.legend(frameon=False, fontsize=9, ncols=2, loc="lower left")
    upper.set_title("What holds the ball", **TITLE)
    lower.axhline(1e6 * WEIGHT, color=FAINT, lw=1)
    lower.annotate("weight of the ball", (1, 1e6 * WEIGHT), (0, 3), textcoords="offset points", size=9, color=FAINT)
    lower.set(xlabel="gap (µm)", ylabel="force (µN)", ylim=(0, None))
    lower.set_title("Drawn away, 1 nl", **TITLE)
    save(drawing, path)


if __name__ == "__main__":
    report()
    if len(sys.argv) > 1:
        draw(Path(sys.argv[1]))
