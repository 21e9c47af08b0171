"""LIGGGHTS with the cohesion model: how tests build it, run it, and read what it wrote."""

import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import pendular as pl

HEADERS = Path("/usr/include/liggghts")
TENSION, SUCTION, VOLUME = 0.0728, 5e3, 2e-16
MODEL = "hertz tangential history cohesion pendular"
ANGLES = {"equal": math.radians(20), "two": (math.radians(10), math.radians(40))}
needs_liggghts = pytest.mark.skipif(
    not HEADERS.is_dir() or not shutil.which("mpicxx.openmpi") or not shutil.which("make"),
    reason="LIGGGHTS is not installed: apt-get install -y --no-install-recommends "
    "liggghts libliggghts-dev libopenmpi-dev g++ make",
)

SCENE = """
units si
atom_style granular
atom_modify map array
boundary {boundary}
newton {newton}
communicate single vel yes
region box block {box} units box
create_box 2 box
neighbor 2e-5 bin
neigh_modify delay 0
{atoms}
fix m1 all property/global youngsModulus peratomtype 5e6 5e6
fix m2 all property/global poissonsRatio peratomtype 0.3 0.3
fix m3 all property/global coefficientRestitution peratomtypepair 2 0.5 0.5 0.5 0.5
fix m4 all property/global coefficientFriction peratomtypepair 2 0.5 0.5 0.5 0.5
fix tension all property/global surfaceTension scalar {tension}
fix held all property/global {held} scalar {value}
{before}
pair_style gran model {model} {words}
pair_coeff * *
{walls}
timestep 1e-7
{moves}
thermo_style custom step
dump d all custom {every} dump.pull id x y z fx fy fz {columns}
dump_modify d format "%d{formats}" sort id
"""


def built(folder):
    """The program, as the command and make build it."""
    from pendular.front.cli import main

    with pytest.raises(SystemExit) as end:
        main(["export", "liggghts", "--out", str(folder)])
    assert end.value.code == 0
    warned = "-std=c++11 -O2 -Wall -Wextra -Werror"
    made = subprocess.run(["make", f"CXXFLAGS={warned}"], cwd=folder, check=False, capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    return folder / "liggghts_pendular"


def simulated(program, folder, script, ranks=1):
    """Run a script in a folder; what it said."""
    (folder / "in.scene").write_text(script)
    command = [program, "-in", "in.scene"]
    if ranks > 1:
        allowed = ("--allow-run-as-root", "--oversubscribe")
        command = ["mpirun.openmpi", *allowed, "-n", str(ranks), *command]
    told = {"capture_output": True, "text": True, "errors": "replace"}  # errors of LIGGGHTS are garbled by chance
    return subprocess.run(command, cwd=folder, check=False, timeout=120, **told)


def rows_of(program, folder, script, ranks=1):
    """What a script that must run wrote into its dump, without the ids: (frames, atoms, numbers)."""
    done = simulated(program, folder, script, ranks)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return dumped(folder)


def dumped(folder):
    """Numbers of a dump: (frames, atoms, numbers)."""
    numbers, wanted = [], False
    for line in (folder / "dump.pull").read_text().splitlines():
        if line.startswith("ITEM"):
            wanted = line.startswith("ITEM: ATOMS")
        elif wanted:
            numbers.append([float(word) for word in line.split()])
    count = int(max(row[0] for row in numbers))
    return np.array(numbers).reshape(-1, count, len(numbers[0]))[..., 1:]


def frames(folder):
    """Heights and vertical forces of a dump: (frames, atoms)."""
    numbers = dumped(folder)
    return numbers[..., 2], numbers[..., 5]


def save_tables(folder, held, angles):
    """Tables of two types: one for all, or one for each pair of types."""
    control = "volume" if held == "volume" else "suction"
    ranges = {"reduced": (1e-4, 0.05)} if control == "volume" else {"reduced": (0.5, 50.0)}
    made = {}
    for i, j in ((1, 1), (1, 2), (2, 2)):
        theta = ANGLES["equal"] if angles == "equal" else (ANGLES["two"][i - 1], ANGLES["two"][j - 1])
        if angles != "equal" or not made:
            made[i, j] = pl.tabulate(theta, control, tolerance=1e-6, **ranges)
        else:
            made[i, j] = made[1, 1]
        made[i, j].save(folder / ("pendular.bridges" if angles == "equal" else f"pendular_{i}_{j}.bridges"))
    return made


def atoms_of(rows):
    """Grains of a list of (type, place, radius)."""
    lines = [f"create_atoms {kind} single {x:.17g} {y:.17g} {z:.17g} units box" for kind, (x, y, z), _ in rows]
    lines += [f"set atom {i} diameter {2 * r:.17g} density 2650" for i, (_, _, r) in enumerate(rows, 1)]
    return "\n".join(lines)


def scene_of(rows, held, value, *, upper=(), columns="", **words):
    """A scene of grains (type, place, radius); those of the group `upper` are pulled up."""
    atoms = atoms_of(rows)
    if upper:
        atoms += f"\ngroup upper id {' '.join(map(str, upper))}"
        words["moves"] = "fix pull upper move linear 0 0 0.2 units box"
    usual = {
        "boundary": "f f f",
        "newton": "off",
        "box": "-2e-3 2e-3 -2e-3 2e-3 -2e-3 2e-3",
        "before": "",
        "model": MODEL,
        "words": "",
        "walls": "",
        "moves": "",
        "every": 10,
        "tension": TENSION,
        "value": value,
        "held": "bridgeVolume" if held == "volume" else "bridgeSuction",
        "columns": columns,
        "formats": " %.17g" * (6 + len(columns.split())),
        "atoms": atoms,
    }
    return SCENE.format(**usual | words)


def resumed(script, name="half"):
    """The same scene from a restart file: what made its box and grains is left out."""
    _, _, setting = script.partition("fix m1")
    setting = "\n".join(line for line in setting.splitlines() if not line.startswith(("set ", "velocity ")))
    begin = "atom_style granular\natom_modify map array\nnewton off\ncommunicate single vel yes\n"
    return f"{begin}read_restart {name}\nneighbor 2e-5 bin\nneigh_modify delay 0\nfix m1{setting}\n"
