"""Run by YADE: pairs of fixed spheres under suction, with the tables of the working directory.

Reads ``cases.json``: for each suffix of the tables a list of pairs (radius1, radius2, separations), the suctions and
the surface tension. Writes ``found.json`` with the bridges as YADE's law reports them, in the order suffix, suction,
separation, pair.
"""

import json

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
)

LAW_FIELDS = ("vMeniscus", "Delta1", "Delta2", "nn11", "nn33")
ASIDE = 10.0  # between two pairs, over the larger radius


def run(suffix, pairs, suctions, surface_tension):
    """Bridges of all pairs at all suctions and separations."""
    O.reset()
    O.materials.append(FrictMat(young=1e6, poisson=0.3, density=2500, frictionAngle=0.5))
    aside = ASIDE * max(max(pair["radius1"], pair["radius2"]) for pair in pairs)
    ids = []
    for n, pair in enumerate(pairs):
        radii = pair["radius1"], pair["radius2"]
        ids.append([O.bodies.append(sphere((n * aside, 0, 0), radius, fixed=True)) for radius in radii])
    law = Law2_ScGeom_CapillaryPhys_Capillarity(surfaceTension=surface_tension, suffCapFiles=suffix)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.6)], verletDist=0),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.6)],
            [Ip2_FrictMat_FrictMat_CapillaryPhys()],
            [Law2_ScGeom_FrictPhys_CundallStrack(neverErase=True)],
        ),
        law,
        NewtonIntegrator(damping=0),
    ]
    O.dt = 1e-12
    found = []
    for suction in suctions:
        law.capillaryPressure = suction
        for k in range(len(pairs[0]["separations"])):
            for n, (pair, (_, second)) in enumerate(zip(pairs, ids, strict=True)):
                distance = pair["radius1"] + pair["radius2"] + pair["separations"][k]
                O.bodies[second].state.pos = (n * aside, 0, distance)
            law.createDistantMeniscii = True
            O.step()
            found.extend(bridge_of(first, second) for first, second in ids)
    return found


def bridge_of(first, second):
    """Force on the first body along the axis, and what the law says of the bridge; zeros where there is none."""
    if not (O.interactions.has(first, second) and O.interactions[first, second].isReal):
        return [0.0] * (1 + len(LAW_FIELDS))
    physics = O.interactions[first, second].phys
    if not physics.meniscus:
        return [0.0] * (1 + len(LAW_FIELDS))
    force = O.forces.f(first)[2] + physics.normalForce[2]  # less the elastic part
    return [force, *(getattr(physics, field) for field in LAW_FIELDS)]


with open("cases.json") as file:
    cases = json.load(file)
with open("found.json", "w") as file:
    json.dump([row for case in cases for row in run(**case)], file)
