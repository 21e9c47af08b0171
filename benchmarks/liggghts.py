"""What bridges cost in LIGGGHTS, beside its own: ``python -m benchmarks.liggghts``.

Processor time of a step of grains at rest on a cubic lattice, one rank, without bridges, with the model ``pendular``,
and with LIGGGHTS' own model ``washino``; of two runs of different length, so that the start is left out.
"""

import resource
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import pendular as pl
from benchmarks.yade_engine import CONTACT_ANGLE, GAMMA, GRAINS, RADIUS, SEED, SUCTION, packing
from pendular.codes.liggghts import write

STEPS, ROUNDS = (20, 220), 3
SCENE = """
units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
neighbor 5e-6 bin
neigh_modify delay 0
read_data grains.data
fix m1 all property/global youngsModulus peratomtype 5e6
fix m2 all property/global poissonsRatio peratomtype 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 1 0.5
fix m4 all property/global coefficientFriction peratomtypepair 1 0.5
fix f1 all property/global surfaceTension scalar {gamma}
fix f2 all property/global bridgeSuction scalar {suction}
fix f3 all property/global fluidViscosity scalar 0.0
fix f4 all property/global contactAngle peratomtype 0.0
fix f5 all property/global surfaceLiquidContentInitial scalar 0.01
fix f6 all property/global minSeparationDistanceRatio scalar 1.01
fix f7 all property/global maxSeparationDistanceRatio scalar 1.05
pair_style gran model hertz tangential history {cohesion}
pair_coeff * *
timestep 1e-9
fix move all nve/sphere
thermo 1000
run {steps}
"""


def data(positions: np.ndarray, radii: np.ndarray) -> str:
    """The grains in a box, as LIGGGHTS reads them."""
    low, high = positions.min() - 2 * RADIUS, positions.max() + 2 * RADIUS
    box = "\n".join(f"{low:.9g} {high:.9g} {axis}lo {axis}hi" for axis in "xyz")
    rows = zip(radii, positions, strict=True)
    lines = [f"{i} 1 {2 * r:.9g} 2500 {x[0]:.9g} {x[1]:.9g} {x[2]:.9g}" for i, (r, x) in enumerate(rows, 1)]
    return f"grains\n\n{len(radii)} atoms\n\n1 atom types\n\n{box}\n\nAtoms\n\n" + "\n".join(lines) + "\n"


def seconds(folder: Path, cohesion: str, steps: int) -> float:
    """Processor time of a run."""
    words = {"gamma": GAMMA, "suction": SUCTION, "cohesion": cohesion, "steps": steps}
    (folder / "in.scene").write_text(SCENE.format(**words))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = ["./liggghts_pendular", "-in", "in.scene", "-screen", "none"]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Print nanoseconds a contact."""
    grains = packing(np.random.default_rng(SEED))
    side = round(GRAINS ** (1 / 3))
    contacts = 3 * side * side * (side - 1)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write(folder)
        subprocess.run(["make"], cwd=folder, check=True, capture_output=True)
        pl.tabulate(CONTACT_ANGLE, reduced=(1.0, 1e3), tolerance=1e-6).save(folder / "pendular.bridges")
        (folder / "grains.data").write_text(data(**grains))
        print(f"{GRAINS} grains, {contacts} contacts, seed {SEED}; nanoseconds a contact and step")
        models = {"none": "", "pendular": "cohesion pendular", "washino": "cohesion washino/capillary/viscous"}
        for _ in range(ROUNDS):
            told = []
            for title, cohesion in models.items():
                short, long = (seconds(folder, cohesion, steps) for steps in STEPS)
                told.append(f"{title} {1e9 * (long - short) / (STEPS[1] - STEPS[0]) / contacts:.0f}")
            print("   ".join(told))


if __name__ == "__main__":
    main()
