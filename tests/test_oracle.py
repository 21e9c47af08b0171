"""Hundreds of bridges over the whole domain against an independent solution in 30 digits (oracles/make_bridges.py)."""

import json
from pathlib import Path

import numpy as np
import pytest

import pendular as pl

# A state without room for a meniscus inside an overlap is an equilibrium on paper only.
BRIDGES = [
    row
    for row in json.loads((Path(__file__).parent / "data" / "oracle_bridges.json").read_text())
    if "negative_volume" not in row["tags"]
]
UNIT = pl.Liquid(surface_tension=1.0)

# field of the answer: its value in the file, and the largest relative error allowed (measured)
FIELDS = {
    "force": (lambda n: 2.0 * np.pi * n["lam"], 2e-12),  # 1.4e-12 next to a fold at a gap of 0.01 contact radii
    "volume": (lambda n: n["V"], 2e-12),  # 1.5e-12, there too
    "liquid_gas_area": (lambda n: n["area"], 1e-12),  # 3e-14
    "neck_radius": (lambda n: n["Y0"], 1e-12),  # 6e-14
    "contact_radius": (lambda n: np.stack([n["Y1"], n["Y2"]], axis=-1), 1e-12),  # 5e-14
    "half_filling_angle": (lambda n: np.stack([n["delta1"], n["delta2"]], axis=-1), 1e-12),
    "wetted_area": (lambda n: np.stack([n["wetted1"], n["wetted2"]], axis=-1), 2e-12),  # 1.5e-12, there too
    "stiffness": (lambda n: 2.0 * np.pi * n["dlam_dgap"], 1e-9),  # 2e-11, near the fold
}


def ask(rows):
    """Public answer to the questions of some rows, and the numbers of these rows by name."""
    numbers = {
        key: np.array([np.inf if row[key] is None else float(row[key]) for row in rows])
        for key, value in rows[0].items()
        if isinstance(value, str) and key not in ("control", "branch")
    }
    numbers["R2"] = np.array([np.inf if row["R2"] is None else float(row["R2"]) for row in rows])
    n = numbers
    pair = pl.Pair(radius=(n["R1"], n["R2"]), contact_angle=(n["theta1"], n["theta2"]))
    control, branch = rows[0]["control"], rows[0]["branch"]
    held = {control: n["H"] if control == "suction" else n["V"]}
    # states past the pitchfork of mirror images belong to the branch that ends in the fold
    return pl.bridge(pair, n["gap"], **held, branch=branch, limit="fold", liquid=UNIT), n


def group(control, branch):
    return [row for row in BRIDGES if row["control"] == control and row["branch"] == branch]


GROUPS = [("suction", "stable"), ("suction", "unstable"), ("volume", "stable")]


def test_there_are_enough_of_them():
    assert len(BRIDGES) >= 500
    tags = {tag for row in BRIDGES for tag in row["tags"]}
    assert tags >= {"catenoid", "cylinder", "bulge", "inflection", "immersed", "neck_outside", "repulsive", "overlap"}
    assert max(float(row["H"]) for row in BRIDGES) > 1e10


@pytest.mark.parametrize(("control", "branch"), GROUPS)
def test_every_field(control, branch):
    answer, numbers = ask(group(control, branch))
    assert np.all(answer.exists)
    for field, (expected_of, tolerance) in FIELDS.items():
        expected, measured = expected_of(numbers), getattr(answer, field)
        known = np.isfinite(expected) & (expected != 0.0) & np.isfinite(measured)
        worst = np.max(np.abs(measured / np.where(known, expected, 1.0) - 1.0)[known])
        print(f"{control}, {branch}: {field} {worst:.1e}")
        assert worst < tolerance, field


@pytest.mark.parametrize(("control", "branch"), GROUPS)
def test_energy_and_tensor(control, branch):
    """Sums of terms of both signs, measured by their terms."""
    answer, n = ask(group(control, branch))
    terms = n["area"] + np.abs(np.cos(n["theta1"])) * n["wetted1"] + np.abs(np.cos(n["theta2"])) * n["wetted2"]
    assert np.max(np.abs(answer.surface_energy - n["E"]) / terms) < 2e-12  # 1.3e-12
    assert np.max(np.abs(answer.capillary_tensor[:, 0] / n["n11"] - 1.0)) < 1e-12
    assert np.max(np.abs(answer.capillary_tensor[:, 1] - n["n33"]) / n["area"]) < 1e-12


def test_suction_found_at_constant_volume():
    answer, n = ask(group("volume", "stable"))
    assert np.max(np.abs(answer.suction - n["H"]) * np.maximum(n["Y1"], 1.0 / np.maximum(np.abs(n["H"]), 1.0))) < 1e-9


@pytest.mark.parametrize(("control", "branch"), GROUPS)
def test_where_the_neck_is_and_what_is_stable(control, branch):
    rows = [row for row in group(control, branch) if "cylinder" not in row["tags"]]  # a cylinder is all neck
    answer, n = ask(rows)
    assert np.array_equal(answer.neck_inside, [row["neck_inside"] for row in rows])
    expected = np.full(len(rows), branch == "stable")
    if control == "volume":  # sideways stable where attractive, and mirror images must not slide to one side
        expected = (n["lam"] > 0.0) & [row.get("pitchfork_stable", True) for row in rows]
    assert np.array_equal(answer.stable, expected)
