"""Two grains that touch and are pulled apart, in YADE, under constant suction.

To be run by YADE in a folder with its tables for a contact angle of 20 degrees; `two_grains.py` does it all:

    pendular export yade --contact-angle 20 --out tables
    cd tables && yade -n -x ../examples/yade_pull.py

Writes ``pull.csv``: separation [m], capillary force [N] and liquid volume [m3] every twenty steps, first towards each
other, then apart until the bridge has broken.
"""

from yade import O
from yade.utils import sphere
from yade.wrapper import (
    Bo1_Sphere_Aabb,
    ForceResetter,
    FrictMat,
    Ig2_Sphere_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_CapillaryPhys,
    Law2_ScGeom_CapillaryPhys_Capillarity,
    Law2_ScGeom_FrictPhys_CundallStrack,
    NewtonIntegrator,
    PyRunner,
)

SMALL, LARGE = 50e-6, 100e-6  # radii, [m]
SUCTION, SURFACE_TENSION = 5e3, 0.0728  # [Pa], [N/m]
START, DEEPEST, END = 4e-6, -0.02e-6, 14e-6  # separations, [m]
SPEED, STEPS = 1e-3, 20  # [m/s], between two records

O.materials.append(FrictMat(young=1e7, poisson=0.3, density=2650, frictionAngle=0.5))
O.bodies.append(sphere((0, 0, 0), SMALL, fixed=True))
O.bodies.append(sphere((0, 0, SMALL + LARGE + START), LARGE, fixed=True))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.2)], verletDist=0),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.2)],
        [Ip2_FrictMat_FrictMat_CapillaryPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack(neverErase=True)],
    ),
    Law2_ScGeom_CapillaryPhys_Capillarity(capillaryPressure=SUCTION, surfaceTension=SURFACE_TENSION),
    PyRunner(command="record()", iterPeriod=STEPS),  # before the motion, at the separation of the forces
    NewtonIntegrator(damping=0),
]
O.dt = 1e-6
O.bodies[1].state.vel = (0, 0, -SPEED)
records = []


def record():
    """Keep the separation and the bridge; turn at contact, and stop at the end."""
    separation = O.bodies[1].state.pos[2] - SMALL - LARGE
    has_bridge = O.interactions.has(0, 1) and O.interactions[0, 1].isReal and O.interactions[0, 1].phys.meniscus
    physics = O.interactions[0, 1].phys if has_bridge else None
    records.append((separation, physics.fCap.norm(), physics.vMeniscus) if has_bridge else (separation, 0.0, 0.0))
    if separation <= DEEPEST:
        O.bodies[1].state.vel = (0, 0, SPEED)
    if separation >= END:
        O.pause()


O.run(wait=True)
with open("pull.csv", "w") as file:
    file.write("separation,force,volume\n")
    file.writelines("{:.17g},{:.17g},{:.17g}\n".format(*row) for row in records)
