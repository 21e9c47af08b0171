"""Time of the engines of YADE on a packing, to be run by YADE: ``yade -n -x yade_packing.py`` in a folder with it.

Reads ``packing.npz`` and the capillary tables, writes ``found.json``: menisci, and nanoseconds a step of each engine.
Where the folder ``engine`` of ``pendular export yade-engine`` is there, with ``w.bridges`` beside it, it is timed too.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np
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

STEPS = 100

packing = np.load("packing.npz")
O.materials.append(FrictMat(young=1e7, poisson=0.3, density=2500, frictionAngle=0.5))
O.bodies.append([sphere(x, r) for x, r in zip(packing["positions"].tolist(), packing["radii"].tolist(), strict=True)])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05)]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.05)],
        [Ip2_FrictMat_FrictMat_CapillaryPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack(neverErase=True)],
        label="contacts",
    ),
    Law2_ScGeom_CapillaryPhys_Capillarity(
        capillaryPressure=float(packing["suction"]),
        surfaceTension=float(packing["surface_tension"]),
        suffCapFiles="",
        label="bridges",
    ),
    NewtonIntegrator(damping=0.4),
]
O.dt = 1e-9
O.run(5, True)
O.timingEnabled = True
for engine in O.engines:
    engine.execTime, engine.execCount = 0, 0
O.run(STEPS, True)
menisci = sum(1 for i in O.interactions if i.isReal and i.phys.meniscus)
times = {engine.label: engine.execTime / STEPS for engine in O.engines if engine.label}
found = {"menisci": menisci, "times": times, "contacts": O.interactions.countReal()}


def processor_time(engines):
    """Nanoseconds of the processor a step, of the least of some runs."""
    O.engines = engines
    O.run(5, True)
    least = float("inf")
    for _ in range(5):
        begin = time.process_time()
        O.run(STEPS, True)
        least = min(least, time.process_time() - begin)
    return 1e9 * least / STEPS


if Path("engine").is_dir():
    sys.path.append("engine")
    from pendular_yade import Bridges

    held = {"suction": float(packing["suction"]), "surface_tension": float(packing["surface_tension"])}
    bridges = Bridges("w.bridges", **held, distant=True)
    runner = PyRunner(command="bridges.step()", iterPeriod=1, initRun=True)
    contact, law, motion = O.engines[:3], O.engines[3], O.engines[-1]
    O.timingEnabled = False
    alone, by_law, by_engine = (processor_time([*contact, *some, motion]) for some in ([], [law], [runner]))
    found |= {"bridges": len(bridges.found()), "law": by_law - alone, "engine": by_engine - alone, "alone": alone}

with open("found.json", "w") as file:
    json.dump(found, file)
