"""The strength that bridges add to a packing, with liquid that comes and goes and with liquid that is shut in.

    python examples/wet_shear_picture.py docs/images/wet_shear.svg [grains]

Runs `wet_shear.py` in LAMMPS for dry beads and for three suctions, two runs at a time: the same packing of beads of 80
to 120 µm is sheared under 1 kPa, drained and undrained. The strength that is gained is set beside what the stress of
the bridges predicts, which presses the grains together as a load does (Badetti et al., Eur. Phys. J. E 41 (2018) 68,
doi:10.1140/epje/i2018-11677-8). Rumpf's formula estimates that stress from the number of bridges and their force at
contact (Rumpf, Chem. Ing. Tech. 42 (1970) 538, doi:10.1002/cite.330420806).
"""

import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Circle

import pendular as pl
from pendular.ground.colours import ACCENT, FAINT, GRAIN, GRAIN_EDGE, HAIR, INK, LIQUID, LIQUID_EDGE
from pendular.show.picture import save

SUCTIONS = (10e3, 40e3, 160e3)  # [Pa]
LOAD, SPEED, DIAMETER, DENSITY = 1e3, 0.02, 100e-6, 2500.0  # as in wet_shear.py
GRAINS = pl.Pair(radius=DIAMETER / 2, contact_angle=np.deg2rad(20))
WATER = pl.Liquid(surface_tension=0.0728)
SHADES = LinearSegmentedColormap.from_list("liquid", [LIQUID, LIQUID_EDGE, INK])
COLOURS = dict(zip(SUCTIONS, (to_hex(SHADES(place)) for place in (0.2, 0.5, 0.85)), strict=True))
STRAIN, SHEAR, CAPILLARY, COUNT, LIQUID_HELD = range(5)  # columns of a record


def simulate(grains: int) -> dict[float, dict[str, Any]]:
    """Results of all runs, by suction; dry is 0."""
    script, environment = Path(__file__).with_name("wet_shear.py").resolve(), os.environ | {"OMP_NUM_THREADS": "1"}
    with tempfile.TemporaryDirectory() as folder:

        def run(*words: str) -> None:
            subprocess.run([sys.executable, str(script), *words], cwd=folder, env=environment, check=True)

        run("pack", str(grains))
        with ThreadPoolExecutor(2) as two:
            list(two.map(lambda suction: run("shear", f"{suction:g}"), (*SUCTIONS, 0.0)))
        return {s: dict(np.load(Path(folder) / f"shear_{s:g}.npz")) for s in (0.0, *SUCTIONS)}


def steady(records: np.ndarray) -> np.ndarray:
    """Mean over the second half of the strain."""
    return records[len(records) // 2 :].mean(axis=0)


def cohesions(found: dict[float, dict[str, Any]]) -> dict[tuple[float, str], tuple[float, float, float]]:
    """Measured, from the stress of the bridges, and from Rumpf's formula, for each suction, drained and undrained."""
    friction = steady(found[0.0]["drained"])[SHEAR] / LOAD
    rows = {}
    for suction in SUCTIONS:
        run = found[suction]
        touching = pl.bridge(GRAINS, 0.0, suction=suction, liquid=WATER).force
        for state in ("drained", "undrained"):
            mean = steady(run[state])
            rumpf = mean[COUNT] / np.prod(run["box"]) * DIAMETER * touching / 3.0
            rows[suction, state] = mean[SHEAR] - friction * LOAD, friction * mean[CAPILLARY], friction * rumpf
    return rows


def report(found: dict[float, dict[str, Any]]) -> None:
    """Print a table of what was found, and how far it can be trusted."""
    count, height = len(found[SUCTIONS[0]]["radii"]) - 1, found[SUCTIONS[0]]["box"][2]
    print(f"{count} grains under {LOAD:g} Pa; shear stress dry {steady(found[0.0]['drained'])[SHEAR]:.0f} Pa")
    print("                    bridges   liquid, pL/grain  shear   strength gained, Pa")
    print("suction             a grain    first     last  stress   found  by stress  by Rumpf  found/by stress")
    for (suction, state), (gained, by_stress, by_rumpf) in cohesions(found).items():
        records = found[suction][state]
        mean, (first, last) = steady(records), 1e15 * records[[0, -1], LIQUID_HELD] / count
        held = f"{2 * mean[COUNT] / count:7.2f} {first:8.4f} {last:8.4f}"
        stresses = f"{mean[SHEAR]:6.0f} {gained:7.0f} {by_stress:10.0f} {by_rumpf:9.0f} {gained / by_stress:16.2f}"
        print(f"{1e-3 * suction:4.0f} kPa {state:10} {held}  {stresses}")
    rate = SPEED / height
    inertia = rate * DIAMETER * np.sqrt(DENSITY / LOAD)
    depths = np.concatenate([found[suction]["overlap"] for suction in SUCTIONS]) / (DIAMETER / 2)
    middle, deep = 100.0 * np.quantile(depths, (0.5, 0.99))
    print(f"shear rate {rate:.0f} 1/s, inertial number {inertia:.1e}; ", end="")
    print(f"overlap {middle:.2f} % of the radius, {deep:.2f} % in the deepest hundredth")


def draw_packing(axes: Axes, run: dict[str, Any]) -> None:
    """Draw the grains of a slice after the shear, in stripes that were upright before it, and their bridges."""
    start, end, radii, pairs = (run[name] for name in ("start", "end", "radii", "pairs"))
    width, depth, _ = run["box"]
    low, high = start[1:, 2].min() + DIAMETER, start[1:, 2].max() - DIAMETER
    is_glued = (start[:, 2] < low) | (start[:, 2] > high)
    is_dark = np.floor(4.0 * start[:, 0] / width) % 2 == 0
    shades = np.where(is_glued, HAIR, np.where(is_dark, GRAIN_EDGE, GRAIN))
    y = np.mod(end[:, 1], depth) - 0.5 * depth
    seen = np.flatnonzero((np.abs(y) < 0.5 * DIAMETER) & (radii > 0.0))
    for i in seen[np.argsort(-y[seen])]:
        centre = np.mod(end[i, 0], width)
        for x in (centre - width, centre, centre + width):
            disc = Circle((x, end[i, 2]), radii[i], facecolor=shades[i], edgecolor=INK, lw=0.4)
            axes.add_patch(disc)
    between = pairs[np.isin(pairs, seen).all(axis=1)]
    first, arms = end[between[:, 0]], end[between[:, 1]] - end[between[:, 0]]
    arms[:, :2] -= (width, depth) * np.round(arms[:, :2] / (width, depth))
    distances = np.linalg.norm(arms, axis=1)
    middle = radii[between[:, 0]] / (radii[between].sum(axis=1)) * distances
    for origin, arm, distance, place in zip(first, arms, distances, middle, strict=True):
        shift = np.mod(origin[0], width) - origin[0]
        ends = origin[:, None] + np.outer(arm, (place + np.array([-0.2, 0.2]) * DIAMETER) / distance)
        for x in (ends[0] + shift - width, ends[0] + shift, ends[0] + shift + width):
            axes.plot(x, ends[2], color=LIQUID_EDGE, lw=1.5, solid_capstyle="round")
    low, high = end[1:, 2].min() - 0.6 * DIAMETER, end[1:, 2].max() + 0.6 * DIAMETER
    axes.set(xlim=(0.0, width), ylim=(low, high), aspect="equal", xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    arrow = {"arrowstyle": "-|>", "color": ACCENT, "lw": 1.6, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (0.82, 1.04), (0.62, 1.04), xycoords="axes fraction", arrowprops=arrow)
    axes.annotate("", (0.2, 1.0), (0.2, 1.1), xycoords="axes fraction", arrowprops=arrow)
    axes.text(0.23, 1.05, "1 kPa", transform=axes.transAxes, size=9, color=ACCENT, va="center")


def draw_stresses(axes: Axes, found: dict[float, dict[str, Any]], state: str) -> None:
    """Draw the shear stress against the strain, dry and wet."""
    dry = found[0.0]["drained"]
    axes.plot(100.0 * dry[:, STRAIN], 1e-3 * dry[:, SHEAR], color=HAIR, lw=1.4)
    axes.text(25.3, 1e-3 * steady(dry)[SHEAR], "dry", size=9, color=FAINT, va="center")
    for suction in SUCTIONS:
        records = found[suction][state]
        strain, stress = 100.0 * records[:, STRAIN], 1e-3 * records[:, SHEAR]
        axes.plot(strain, stress, color=COLOURS[suction], lw=1.6, label=f"{1e-3 * suction:.0f} kPa")
    axes.text(0.0, 1.03, state, transform=axes.transAxes, size=10, color=INK, weight="bold")
    axes.set(xlim=(0.0, 25.0), ylim=(0.0, 1.2))
    axes.set_ylabel("shear stress (kPa)", color=FAINT, size=9)


def draw_cohesions(axes: Axes, found: dict[float, dict[str, Any]]) -> None:
    """Draw the strength gained against the suction, beside what is predicted for it."""
    rows = cohesions(found)
    kilopascals = 1e-3 * np.array(SUCTIONS)
    for state, dashes, fill in (("drained", "-", ACCENT), ("undrained", "--", "white")):
        measured, by_stress, by_rumpf = 1e-3 * np.array([rows[suction, state] for suction in SUCTIONS]).T
        axes.plot(kilopascals, by_rumpf, dashes, color=HAIR, lw=1.2)
        axes.plot(kilopascals, by_stress, dashes, color=LIQUID_EDGE, lw=1.4)
        axes.plot(kilopascals, measured, "o", color=ACCENT, mfc=fill, mew=1.4, ms=6, label=f"simulated, {state}")
    axes.plot([], [], color=LIQUID_EDGE, lw=1.4, label="friction × stress of the bridges")
    axes.plot([], [], color=HAIR, lw=1.2, label="friction × Rumpf's formula")
    axes.plot([], [], "--", color=FAINT, lw=1.2, label="the same, undrained")
    axes.legend(frameon=False, fontsize=8, labelcolor=FAINT, loc="lower left", labelspacing=0.3)
    axes.set(xscale="log", xlim=(7.0, 230.0), ylim=(0.0, 0.8), xticks=kilopascals)
    axes.set_xticks([], minor=True)
    axes.set_xticklabels([f"{value:.0f}" for value in kilopascals])
    axes.set_xlabel("suction (kPa)", color=FAINT, size=9)
    axes.set_ylabel("strength gained (kPa)", color=FAINT, size=9)


def draw(found: dict[float, dict[str, Any]], path: Path) -> None:
    """Draw the packing, the stresses and the strength."""
    drawing = Figure(figsize=(9.6, 6.6), facecolor="white")
    drawing.text(0.02, 0.965, "What bridges add to the strength of a packing", size=12, weight="bold", color=INK)
    count = len(found[SUCTIONS[0]]["radii"]) - 1
    told = f"{count} beads of 80 to 120 µm in LAMMPS, friction 0.3, contact angle 20°, sheared under 1 kPa"
    drawing.text(0.02, 0.93, told, size=9, color=FAINT)
    packing = drawing.add_axes((0.03, 0.43, 0.38, 0.43))
    draw_packing(packing, found[SUCTIONS[0]])
    drawing.text(0.02, 0.395, "a slice at 10 kPa, drained, after a shear of 25 %", size=9, color=FAINT)
    strength = drawing.add_axes((0.08, 0.08, 0.33, 0.27))
    draw_cohesions(strength, found)
    drained = drawing.add_axes((0.53, 0.51, 0.41, 0.34))
    undrained = drawing.add_axes((0.53, 0.08, 0.41, 0.34), sharex=drained)
    draw_stresses(drained, found, "drained")
    draw_stresses(undrained, found, "undrained")
    style = {"frameon": False, "fontsize": 9, "labelcolor": FAINT, "handlelength": 1.4, "columnspacing": 1.2}
    drained.legend(loc="lower right", bbox_to_anchor=(1.0, 0.99), ncols=3, **style)
    drained.tick_params(labelbottom=False)
    undrained.set_xlabel("shear strain (%)", color=FAINT, size=9)
    for axes in (strength, drained, undrained):
        axes.spines[["top", "right"]].set_visible(False)
        axes.spines[["left", "bottom"]].set(color=HAIR, lw=0.8)
        axes.tick_params(labelcolor=FAINT, labelsize=8, width=0.8, length=3, color=HAIR)
    save(drawing, path)


if __name__ == "__main__":
    started = time.perf_counter()
    results = simulate(int(sys.argv[2]) if len(sys.argv) > 2 else 1000)
    report(results)
    if len(sys.argv) > 1:
        draw(results, Path(sys.argv[1]))
    print(f"{time.perf_counter() - started:.0f} s")
