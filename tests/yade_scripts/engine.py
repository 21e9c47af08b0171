"""Run by YADE: bridges of the engine between fixed spheres, and between spheres and a wall; nothing else pulls.

Reads ``cases.json``: for each case what the engine is given, and pairs (radius1, radius2) with their separations, step
by step; a radius2 of null is a wall. Writes ``found.json``: for each case the forces on the upper partner of each pair,
and the bridges of the last step as the engine tells them.
"""

import json
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
    InsertionSortCollider,
    NewtonIntegrator,
    PyRunner,
)

ASIDE = 3e-3  # between two pairs


def run(pairs, separations, held=None, scene=None, **options):
    """Forces step by step, and bridges of the last; each step may hold something else."""
    global bridges
    O.reset()
    O.materials.append(FrictMat(young=1e6, poisson=0.3, density=2500, frictionAngle=0.5))
    ids = []
    if any(radius2 is None for _, radius2 in pairs):
        O.bodies.append(wall(0.0, axis=2))
    for n, (radius1, radius2) in enumerate(pairs):
        place = (n % 8 * ASIDE, n // 8 * ASIDE)
        low = 0.0 if radius2 is None else -5e-3
        lower = None if radius2 is None else O.bodies.append(sphere((*place, low), radius2, fixed=True))
        start = low + (radius2 or 0.0) + radius1
        ids.append((lower, O.bodies.append(sphere((*place, start), radius1, fixed=True)), place, start))
    if scene == "periodic":
        O.periodic = True
    bridges = Bridges(**options)
    O.engines = [
        ForceResetter(),
        *([] if scene == "periodic" else [InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()])]),
        PyRunner(command="bridges.step()", iterPeriod=1, initRun=True),
        NewtonIntegrator(damping=0),
    ]
    O.dt = 1e-12
    forces = []
    for step, row in enumerate(separations):
        bridges.held = held[step] if held else bridges.held
        for (_, upper, place, start), gap in zip(ids, row):  # noqa: B905 - no word of it in this Python
            O.bodies[upper].state.pos = (*place, start + gap)
        O.step()
        forces.append([O.forces.f(upper)[2] for _, upper, _, _ in ids])
        for lower, upper, _, _ in ids:
            assert lower is None or O.forces.f(lower)[2] == -O.forces.f(upper)[2]
    told = bridges.found()
    return {"forces": forces, "bridges": [row.tolist() for row in told], "ids": [upper for _, upper, _, _ in ids]}


with open("cases.json") as file:
    cases = json.load(file)
with open("found.json", "w") as file:
    json.dump([run(**case) for case in cases], file)
