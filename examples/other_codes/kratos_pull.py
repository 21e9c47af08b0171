"""Bridges in Kratos, from Python: two wet grains that move apart, until their bridge breaks.

    pip install KratosMultiphysics KratosDEMApplication
    python kratos_pull.py

The bridges of all pairs are external forces on the nodes, set before each step. One forms in touch and lives to its
rupture distance, which Kratos' own cohesive laws cannot do: they are asked in touch alone. Writes ``pull.csv``:
separation, and the two velocities along the axis.
"""

import json
import tempfile
from pathlib import Path

import KratosMultiphysics as Kratos
import numpy as np
from KratosMultiphysics import DEMApplication as Dem
from KratosMultiphysics.DEMApplication.DEM_analysis_stage import DEMAnalysisStage

import pendular as pl

RADII, OVERLAP, SPEED = (50e-6, 80e-6), 1e-9, 0.6  # [m], [m], [m/s]
SUCTION, TENSION, DENSITY = 5e3, 0.0728, 2500.0  # [Pa], [N/m], [kg/m3]
STEP, STEPS = 1e-7, 300  # [s]


class Bridges:
    """The bridges between all pairs of spheres of a model part."""

    def __init__(self, table: pl.Table, suction: float, surface_tension: float) -> None:
        self.table, self.asked = table, (suction, surface_tension)
        self.standing = np.empty(0, bool)

    def apply(self, nodes) -> None:
        """Set the external force of each node."""
        suction, tension = self.asked
        places = np.array([(node.X, node.Y, node.Z) for node in nodes])
        radii = np.array([node.GetSolutionStepValue(Kratos.RADIUS) for node in nodes])
        i, j = np.triu_indices(len(radii), 1)
        way = places[j] - places[i]
        distance = np.linalg.norm(way, axis=1)
        separation = distance - radii[i] - radii[j]
        if self.standing.size != i.size:
            self.standing = np.zeros(i.size, bool)
        self.standing |= separation <= 0.0
        force = np.where(self.standing, self.table.force(separation, suction, radii[i], radii[j], tension), 0.0)
        self.standing &= force != 0.0
        pull = way * (force / distance)[:, None]
        total = np.zeros_like(places)
        np.add.at(total, i, pull)
        np.add.at(total, j, -pull)
        for node, vector in zip(nodes, total.tolist(), strict=True):
            node.SetSolutionStepValue(Kratos.EXTERNAL_APPLIED_FORCE, Kratos.Array3(vector))


class Pull(DEMAnalysisStage):
    """Two spheres of Kratos, and their bridge."""

    def __init__(self, folder: Path, bridges: Bridges) -> None:
        self.folder, self.bridges, self.rows = folder, bridges, []
        (folder / "MaterialsDEM.json").write_text(json.dumps(materials()))
        super().__init__(Kratos.Model(), Kratos.Parameters(json.dumps(parameters())))

    def GetMainPath(self) -> str:
        """Where Kratos finds the materials."""
        return str(self.folder)

    def ReadModelParts(self, *_) -> None:
        """Make the two grains."""
        properties = Kratos.Properties(0)
        self.spheres_model_part.AddProperties(properties)
        Dem.SymplecticEulerScheme().SetTranslationalIntegrationSchemeInProperties(properties, True)
        Dem.SymplecticEulerScheme().SetRotationalIntegrationSchemeInProperties(properties, True)
        Dem.PropertiesProxiesManager().CreatePropertiesProxies(self.spheres_model_part)
        for place, radius in zip((0.0, sum(RADII) - OVERLAP), RADII, strict=True):
            centre = Kratos.Array3([place, 0.0, 0.0])
            self.creator_destructor.CreateSphericParticle(
                self.spheres_model_part, centre, properties, radius, "SphericParticle3D"
            )

    def Initialize(self) -> None:
        """Let one of them move away."""
        super().Initialize()
        for node, speed in zip(self.spheres_model_part.Nodes, (0.0, SPEED), strict=True):
            node.SetSolutionStepValue(Kratos.VELOCITY, Kratos.Array3([speed, 0.0, 0.0]))

    def InitializeSolutionStep(self) -> None:
        """Set the forces, and keep what is written."""
        super().InitializeSolutionStep()
        nodes = list(self.spheres_model_part.Nodes)
        self.bridges.apply(nodes)
        speeds = [node.GetSolutionStepValue(Kratos.VELOCITY_X) for node in nodes]
        self.rows.append((nodes[1].X - nodes[0].X - sum(RADII), *speeds))


def parameters() -> dict:
    """What Kratos wants to know of the run."""
    off = ("PeriodicDomainOption", "BoundingBoxOption", "dem_inlet_option", "RotationOption", "do_print_results_option")
    return {
        **dict.fromkeys(off, False),
        **dict.fromkeys(("GravityX", "GravityY", "GravityZ"), 0.0),
        "problem_name": "pull",
        "ElementType": "SphericPartDEMElement3D",
        "TranslationalIntegrationScheme": "Symplectic_Euler",
        "RotationalIntegrationScheme": "Direct_Integration",
        "MaxTimeStep": STEP,
        "FinalTime": STEP * (STEPS - 0.5),
        "NeighbourSearchFrequency": 1,
        "solver_settings": {
            "strategy": "sphere_strategy",
            "RemoveBallsInitiallyTouchingWalls": False,
            "material_import_settings": {"materials_filename": "MaterialsDEM.json"},
        },
    }


def materials() -> dict:
    """The grains: soft, and without damping."""
    grain = {"PARTICLE_DENSITY": DENSITY, "YOUNG_MODULUS": 5e6, "POISSON_RATIO": 0.3}
    contact = {
        "COEFFICIENT_OF_RESTITUTION": 1.0,
        "STATIC_FRICTION": 0.0,
        "DYNAMIC_FRICTION": 0.0,
        "FRICTION_DECAY": 500,
        "ROLLING_FRICTION": 0.0,
        "ROLLING_FRICTION_WITH_WALLS": 0.0,
        "DEM_DISCONTINUUM_CONSTITUTIVE_LAW_NAME": "DEM_D_Hertz_viscous_Coulomb",
    }
    return {
        "materials": [{"material_name": "grain", "material_id": 1, "Variables": grain}],
        "material_relations": [
            {"material_names_list": ["grain", "grain"], "material_ids_list": [1, 1], "Variables": contact}
        ],
        "material_assignation_table": [["SpheresPart", "grain"]],
    }


def main() -> None:
    """Run, and write what was found."""
    table = pl.tabulate(np.deg2rad(20.0), reduced=(1.0, 100.0), tolerance=1e-6)
    with tempfile.TemporaryDirectory() as folder:
        run = Pull(Path(folder), Bridges(table, SUCTION, TENSION))
        run.Run()
    np.savetxt("pull.csv", run.rows, delimiter=",", header="separation [m],speed 1 [m/s],speed 2 [m/s]")


if __name__ == "__main__":
    main()
