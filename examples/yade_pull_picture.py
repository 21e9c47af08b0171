"""Run `yade_pull.py` in YADE with tables written for it, and draw its force on the exact curve.

uv run python examples/yade_pull_picture.py docs/images/yade_pull.png
"""

import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import pendular as pl
from pendular.colours import ACCENT, FAINT, HAIR, INK, LIQUID, LIQUID_EDGE
from pendular.dem import yade
from pendular.plot import draw_pair, save

GRAINS = pl.Pair(radius=(50e-6, 100e-6), contact_angle=np.deg2rad(20))
HELD = {"suction": 5e3, "liquid": pl.Liquid(surface_tension=0.0728)}  # as in yade_pull.py


def pull(folder: Path) -> np.ndarray:
    """Separation, force and volume of the pull in YADE."""
    script = Path(__file__).with_name("yade_pull.py").resolve()
    done = subprocess.run(["yade", "-n", "-x", str(script)], cwd=folder, check=False, capture_output=True, text=True)
    if not (folder / "pull.csv").is_file():
        sys.exit(f"YADE ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return np.loadtxt(folder / "pull.csv", delimiter=",", skiprows=1)


def draw(records: np.ndarray, path: Path) -> None:
    """Draw the pair, the force of YADE on the exact curve, and its error."""
    separation, force = records[:, 0], records[:, 1]
    curve, end = pl.curve(GRAINS, **HELD, points=801), pl.rupture(GRAINS, **HELD)
    state = pl.bridge(GRAINS, 5e-6, **HELD)
    drawing = Figure(figsize=(9.6, 4.4), facecolor="white")
    drawing.text(0.02, 0.95, "Two grains pulled apart in YADE", size=12, weight="bold", color=INK, va="center")
    told = "radii 50 µm and 100 µm, contact angle 20°, suction 5 kPa, 72.8 mN/m"
    drawing.text(0.02, 0.895, told, size=9, color=FAINT, va="center")
    draw_pair(drawing.add_axes((0.02, 0.06, 0.42, 0.76)), GRAINS, state, 5e-6)
    upper = drawing.add_axes((0.56, 0.4, 0.42, 0.42))
    lower = drawing.add_axes((0.56, 0.14, 0.42, 0.18), sharex=upper)
    stable = np.asarray(curve.stable)
    upper.plot(1e6 * curve.separation[stable], 1e6 * curve.force[stable], color=LIQUID, lw=7)
    upper.plot(1e6 * separation, 1e6 * force, color=ACCENT, lw=1.2)
    upper.text(2.0, 1.0, "no bridge\nbefore contact", size=8, color=FAINT, ha="center")
    upper.text(9.2, 18.5, "exact, to rupture", size=9, color=LIQUID_EDGE)
    upper.text(9.2, 15.0, "YADE, there and back", size=9, color=ACCENT)
    upper.axvline(1e6 * end.separation, color=HAIR, lw=0.8, ls=(0, (4, 3)))
    upper.set_ylabel("force (µN)", color=FAINT, size=9)
    upper.tick_params(labelbottom=False)
    held = (force > 0.0) & (separation < end.separation)
    exact = pl.bridge(GRAINS, np.maximum(separation[held], 0.0), **HELD)
    contact = pl.bridge(GRAINS, 0.0, **HELD)
    lower.plot(1e6 * separation[held], 100.0 * (force[held] - exact.force) / contact.force, color=ACCENT, lw=1.0)
    lower.set_ylim(-0.12, 0.12)
    lower.set_ylabel("error\n(% of contact)", color=FAINT, size=8)
    lower.set_xlabel("separation (µm)", color=FAINT, size=9)
    for axes in (upper, lower):
        axes.spines[["top", "right"]].set_visible(False)
        axes.spines[["left", "bottom"]].set(color=HAIR, lw=0.8)
        axes.tick_params(labelcolor=FAINT, labelsize=8, width=0.8, length=3, color=HAIR)
    save(drawing, path)
    near = separation[held] <= 0.98 * end.separation
    worst = np.max(np.abs(force[held] - exact.force)[near]) / contact.force
    broken = separation[np.flatnonzero(force > 0.0)[-1]]
    print(f"{held.sum()} records of a bridge; force to 0.98 of rupture {worst:.2e} of contact off")
    print(f"rupture in YADE {broken * 1e6:.3f} um, exact {end.separation * 1e6:.3f} um")


if __name__ == "__main__":
    if shutil.which("yade") is None:
        sys.exit("yade is not installed: apt-get install -y --no-install-recommends yade")
    started = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        yade.export(Path(folder), GRAINS.contact_angles[0].item())
        draw(pull(Path(folder)), Path(sys.argv[1] if len(sys.argv) > 1 else "yade_pull.png"))
    print(f"{time.perf_counter() - started:.0f} s")
