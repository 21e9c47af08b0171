"""A grain on another one of twenty times its size, and one on a wall, pulled apart in YADE with exact bridges.

To be run by YADE, in a folder with the engine and a table:

    pendular export yade-engine --out engine
    pendular export table --contact-angle 20 --out w.bridges
    yade -n -x ../examples/yade_engine.py

Writes ``pull.csv``: separation [m], force on the grain on the other one [N], and on that on the wall [N].
"""

import sys

sys.path.append("engine")

from pendular_yade import Bridges
from yade import O
from yade.utils import sphere, wall
from yade.wrapper import (
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    ForceResetter,
    FrictMat,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack,
    NewtonIntegrator,
    PyRunner,
)

SMALL, LARGE = 50e-6, 1e-3  # radii, [m]
SUCTION, SURFACE_TENSION = 5e3, 0.0728  # [Pa], [N/m]
START, SPEED, STEPS = -0.1e-6, 1e-3, 20  # separation, [m]; [m/s]; between two records

O.materials.append(FrictMat(young=1e7, poisson=0.3, density=2650, frictionAngle=0.5))
O.bodies.append(sphere((0, 0, -LARGE), LARGE, fixed=True))
O.bodies.append(sphere((0, 0, SMALL + START), SMALL, fixed=True))
O.bodies.append(wall(2e-3, axis=0, sense=-1))
O.bodies.append(sphere((2e-3 - SMALL - START, 0, 0), SMALL, fixed=True))
bridges = Bridges("w.bridges", suction=SUCTION, surface_tension=SURFACE_TENSION)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack()],
    ),
    PyRunner(command="bridges.step()", iterPeriod=1, initRun=True),
    PyRunner(command="record()", iterPeriod=STEPS, initRun=True),
    NewtonIntegrator(damping=0),
]
O.dt = 1e-6
O.bodies[1].state.vel = (0, 0, SPEED)
O.bodies[3].state.vel = (-SPEED, 0, 0)
records = []


def record():
    """Keep the separation and the bridges, until both have broken."""
    held = {(row["id1"], row["id2"]): row["force"] for row in bridges.found()}
    records.append((O.bodies[1].state.pos[2] - SMALL, held.get((0, 1), held.get((1, 0), 0.0)), held.get((3, 2), 0.0)))
    if not held:
        O.pause()


O.run(wait=True)
with open("pull.csv", "w") as file:
    file.write("separation,on_grain,on_wall\n")
    file.writelines("{:.17g},{:.17g},{:.17g}\n".format(*row) for row in records)
