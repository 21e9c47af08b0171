"""Run by YADE: grains on their ways, some of them in clumps, in a periodic cell that is sheared or in none.

Reads ``moving.json``: cell, places, radii, velocities, clumps, the rate of the cell, places of walls, and what the
engine is given. Writes ``moved.json``: for each step the cell, the places, the ids and the forces on all grains, the
bridges with their volumes, and the films.
"""

import json
import sys

sys.path.append("engine")

from pendular_yade import Bridges
from yade import Matrix3, O, Quaternion, Vector3
from yade.utils import box, facet, sphere, wall
from yade.wrapper import ForceResetter, FrictMat, NewtonIntegrator, PyRunner

with open("moving.json") as file:
    given = json.load(file)

if given["cell"]:
    O.periodic = True
    O.cell.hSize = Matrix3(*[number for row in given["cell"] for number in row])
    O.cell.velGrad = Matrix3(*[number for row in given["rate"] for number in row])
O.materials.append(FrictMat(young=1e6, poisson=0.3, density=2500, frictionAngle=0.5))
for place, radius, velocity in zip(given["places"], given["radii"], given["velocities"]):  # noqa: B905 - old Python
    O.bodies[O.bodies.append(sphere(place, radius))].state.vel = velocity
for members in given["clumps"]:
    O.bodies.clump(members)
for place in given.get("walls", []):
    O.bodies.append(wall(place, axis=2))
surfaces = []
for each in given.get("surfaces", []):
    body = facet(each["corners"]) if "corners" in each else box(each["place"], each["half"], Quaternion(*each["turn"]))
    body.state.blockedDOFs = "xyzXYZ"
    body.state.vel, body.state.angVel = each["velocity"], each["spin"]
    surfaces.append(O.bodies.append(body))
if isinstance(given["engine"].get("film"), dict):
    given["engine"]["film"] = {int(number): volume for number, volume in given["engine"]["film"].items()}
bridges = Bridges(**given["engine"])
O.engines = [
    ForceResetter(),
    PyRunner(command="bridges.step()", iterPeriod=1, initRun=True),
    PyRunner(command="look()", iterPeriod=1, initRun=True),
    NewtonIntegrator(damping=0),
]
O.dt = given["step"]
steps = []


def look():
    """What the engine has just said, at the places for which it did."""
    grains = [body for body in O.bodies if body.shape.__class__.__name__ == "Sphere"]
    found = bridges.found()
    steps.append(
        {
            "cell": [[O.cell.hSize[i][k] for k in range(3)] for i in range(3)] if given["cell"] else None,
            "ids": [body.id for body in grains],
            "places": [list(body.state.pos) for body in grains],
            "forces": [list(O.forces.f(body.id)) for body in grains],
            "bridges": [row.tolist()[:4] for row in found],
            "volumes": found["volume"].tolist(),
            "films": bridges.films(),
            "surfaces": [corners_of(O.bodies[number]) for number in surfaces],
        }
    )


def corners_of(body):
    """Corners of a facet, or of a box, as YADE has them now."""
    shape = body.shape
    if hasattr(shape, "vertices"):
        own = shape.vertices
    else:
        x, y, z = shape.extents
        own = [Vector3(a * x, b * y, c * z) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    return [list(body.state.pos + body.state.ori * corner) for corner in own]


for step in range(given["steps"]):
    O.step()
    if str(step) in given["erased"]:
        O.bodies.erase(given["erased"][str(step)])
    if step == given["added_at"]:
        O.bodies.append(sphere(given["added"], given["radii"][0]))
with open("moved.json", "w") as file:
    json.dump(steps, file)
