"""Worst errors against numbers worked out in high precision: ``python -m benchmarks.accuracy``.

The bridges are those of ``tests/data/oracle_bridges.json``, drawn over the whole domain and solved with 30 digits; the
rupture distances are in its rows, too, and in the tables of ``tests/data/reference_tables.json``.
"""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import pendular as pl

Floats = NDArray[np.float64]
Row = dict[str, Any]

DATA = Path(__file__).parents[1] / "tests" / "data"
UNIT = pl.Liquid(surface_tension=1.0)


def read(name: str) -> Any:
    """Contents of a file of exact numbers."""
    return json.loads((DATA / name).read_text())


def numbers(rows: list[Row], *keys: str) -> Floats:
    """Columns of the rows; a solid's own columns side by side. Null is the radius of a plane."""
    columns = [[np.inf if row[key] is None else float(row[key]) for row in rows] for key in keys]
    return np.array(columns[0]) if len(keys) == 1 else np.array(columns).T


def pair_of(rows: list[Row]) -> pl.Pair:
    """Solids of the rows."""
    radii, angles = (tuple(numbers(rows, name + "1", name + "2").T) for name in ("R", "theta"))
    return pl.Pair(radii, angles)


def control_of(rows: list[Row]) -> dict[str, Floats]:
    """What is held in the rows, all of one control."""
    return {"suction": numbers(rows, "H")} if rows[0]["control"] == "suction" else {"volume": numbers(rows, "V")}


# -- errors ----------------------------------------------------------------------------------------------------------


def relative(measured: Floats, exact: Floats, scale: Floats | float = 0.0) -> Floats:
    """Largest error of each row, relative to the exact number or to a larger scale; zero where there is no number."""
    error = np.abs(measured - exact)
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = np.where(error == 0.0, 0.0, error / np.maximum(np.abs(exact), scale))
    ratio = np.where(np.isnan(measured) & (np.isnan(exact) | (exact <= 0.0)), 0.0, ratio)
    return ratio if ratio.ndim == 1 else ratio.max(axis=-1)


def energy_terms(rows: list[Row]) -> Floats:
    """Sum of the terms of the surface energy without their signs, by which its error is measured."""
    wetting = np.abs(np.cos(numbers(rows, "theta1", "theta2"))) * numbers(rows, "wetted1", "wetted2")
    return numbers(rows, "area") + wetting.sum(axis=-1)


# Column of the table: its errors, from the answers and the exact rows.
ERRORS: dict[str, Callable[[pl.Bridge, list[Row]], Floats]] = {
    "force": lambda b, rows: relative(b.force, 2.0 * np.pi * numbers(rows, "lam")),
    "volume": lambda b, rows: relative(b.volume, numbers(rows, "V")),
    "suction": lambda b, rows: relative(b.suction, numbers(rows, "H"), 1.0 / numbers(rows, "Y1")),
    "area": lambda b, rows: relative(b.liquid_gas_area, numbers(rows, "area")),
    "neck": lambda b, rows: relative(b.neck_radius, numbers(rows, "Y0")),
    "contact": lambda b, rows: relative(b.contact_radius, numbers(rows, "Y1", "Y2")),
    "energy": lambda b, rows: relative(b.surface_energy, numbers(rows, "E"), energy_terms(rows)),
    "stiffness": lambda b, rows: relative(b.stiffness, 2.0 * np.pi * numbers(rows, "dlam_dgap")),
    "tensor": lambda b, rows: relative(b.capillary_tensor, numbers(rows, "n11", "n33"), numbers(rows, "n11", "n11")),
}


def errors_of(rows: list[Row]) -> dict[str, Floats]:
    """Errors of all fields for rows of one control and branch; infinite where no bridge was found.

    The rows go up to the fold, between equal solids past the place where the liquid slides to one of them.
    """
    asked = {"branch": rows[0]["branch"], "limit": "fold"}
    bridge = pl.bridge(pair_of(rows), numbers(rows, "gap"), **control_of(rows), liquid=UNIT, **asked)
    return {name: np.where(bridge.exists, error(bridge, rows), np.inf) for name, error in ERRORS.items()}


# -- tables ----------------------------------------------------------------------------------------------------------


def report_bridges(rows: list[Row]) -> None:
    """Print the worst error of each field, for all rows of a control and branch and for each of their tags."""
    for control, branch in dict.fromkeys((row["control"], row["branch"]) for row in rows):
        group = [row for row in rows if (row["control"], row["branch"]) == (control, branch)]
        errors = errors_of(group)
        print(f"\nconstant {control}, {branch} branch".ljust(30) + "".join(name.rjust(11) for name in ERRORS))
        for tag in ["all", *sorted({tag for row in group for tag in row["tags"]})]:
            chosen = np.array([tag == "all" or tag in row["tags"] for row in group])
            worst = "".join(f"{error[chosen].max():11.1e}" for error in errors.values())
            print(f"{chosen.sum():6d}  {tag:21}{worst}")


def report_rupture(what: str, rupture: pl.Bridge, exact: Floats) -> None:
    """Print the worst error of some rupture distances."""
    error = relative(np.atleast_1d(rupture.separation), exact)
    print(f"{exact.size:6d}  {what:45}{error.max():11.1e}")


def report_ruptures(rows: list[Row], tables: dict[str, list[Row]]) -> None:
    """Print the worst errors of the rupture distances."""
    print("\nrupture distance")
    for control in ("suction", "volume"):
        group = [row for row in rows if row["control"] == control and row["gap_max"] is not None]
        rupture = pl.rupture(pair_of(group), **control_of(group), liquid=UNIT, limit="fold")
        digits = "" if control == "suction" else ", known to 10 digits"
        report_rupture(f"constant {control}{digits}", rupture, numbers(group, "gap_max"))
    table = tables["suction_fold"]
    spheres = pl.Pair(1.0, np.deg2rad(numbers(table, "angle")))
    rupture = pl.rupture(spheres, suction=numbers(table, "suction"), liquid=UNIT)
    report_rupture("constant suction, 17-digit table", rupture, numbers(table, "gap"))
    for name, limit in (("fold", "fold"), ("pitchfork", "stability")):
        table = [row for row in tables["volume_limit"] if row["limit"] == name]
        spheres = pl.Pair(1.0, np.deg2rad(numbers(table, "angle")))
        rupture = pl.rupture(spheres, volume=numbers(table, "volume"), liquid=UNIT, limit=limit)
        report_rupture(f"constant volume, 17-digit table, {name}", rupture, numbers(table, "gap"))


def main() -> None:
    """Ask for all bridges and ruptures and print the errors."""
    # Without room for a meniscus inside an overlap, an equilibrium is one on paper only.
    rows = [row for row in read("oracle_bridges.json") if "negative_volume" not in row["tags"]]
    print(f"worst relative errors against {len(rows)} bridges solved with 30 digits;")
    print("energy: relative to the sum of its terms without their signs; suction: to 1/Y where that is larger")
    report_bridges(rows)
    report_ruptures(rows, read("reference_tables.json"))


if __name__ == "__main__":
    main()
