"""Run by YADE: its `CapillarityEngine` with the points of the working directory.

Reads ``queries.json``: the file of points, queries (small radius, suction, gap) with a large radius and a surface
tension of 1, and gaps of two equal spheres of radius 1 in a simulation under a suction of 1. Writes ``found.json``:
force and volume of each query, and the force of each gap.
"""

import json

from yade import O
from yade.utils import sphere
from yade.wrapper import (
    Bo1_Sphere_Aabb,
    CapillarityEngine,
    ForceResetter,
    FrictMat,
    Ig2_Sphere_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_CapillaryPhysDelaunay,
    Law2_ScGeom_FrictPhys_CundallStrack,
    NewtonIntegrator,
)

SUCTION = 1.0


def in_simulation(path, gap):
    """Capillary force between two fixed spheres of radius 1."""
    O.reset()
    O.materials.append(FrictMat(young=1e6, poisson=0.3, density=2500, frictionAngle=0.5))
    O.bodies.append([sphere((0, 0, z), 1.0, fixed=True) for z in (0, 2 + gap)])
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.6)]),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.6)],
            [Ip2_FrictMat_FrictMat_CapillaryPhysDelaunay()],
            [Law2_ScGeom_FrictPhys_CundallStrack(neverErase=True)],
        ),
        CapillarityEngine(capillaryPressure=SUCTION, liquidTension=1.0, createDistantMeniscii=True, inputFilename=path),
        NewtonIntegrator(damping=0),
    ]
    O.dt = 1e-12
    O.step()
    has_bridge = O.interactions.has(0, 1) and O.interactions[0, 1].isReal and O.interactions[0, 1].phys.meniscus
    return O.interactions[0, 1].phys.fCap.norm() if has_bridge else 0.0


with open("queries.json") as file:
    asked = json.load(file)
engine = CapillarityEngine(inputFilename=asked["path"], liquidTension=1.0)
alone = [engine.solveStandalone(1.0, *query) for query in asked["queries"]]
answer = {
    "alone": [(bridge.fCap[0], bridge.vMeniscus) for bridge in alone],
    "simulated": [in_simulation(asked["path"], gap) for gap in asked["gaps"]],
}
with open("found.json", "w") as file:
    json.dump(answer, file)
