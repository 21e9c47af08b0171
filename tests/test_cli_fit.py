"""The command fit: a curve in a file becomes numbers with errors, a table, a picture."""

import csv
import io
import json
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import pendular as pl

WATER = pl.Liquid.water()
BEADS = pl.Pair(1e-3, 0.5)
ASKED = ("--radius", "1mm", "--volume", "7nL", "--contact-angle", "10")


@pytest.fixture(scope="module")
def curve(tmp_path_factory):
    """A made curve of 10 nL between beads of 1 mm and 0.5 rad, 2 µm off, broken at its end."""
    end = pl.rupture(BEADS, volume=1e-11, liquid=WATER).separation
    gap = np.linspace(0.0, 1.1 * end, 70)
    force = pl.bridge(BEADS, gap, volume=1e-11, liquid=WATER).force
    force = force + 0.003 * force.max() * np.random.default_rng(20360403).normal(size=gap.size)
    path = tmp_path_factory.mktemp("curves") / "curve.csv"
    rows = np.column_stack([1e6 * gap - 2.0, 1e6 * force])
    np.savetxt(path, rows, delimiter=",", header="separation (um),force (uN)", comments="", fmt="%.5f")
    return path


def test_table_and_picture(curve, run, tmp_path):
    picture = tmp_path / "fit.svg"
    asked = ("--free", "contact-angle,volume,offset", "--rupture", "jump", "--plot", picture)
    status, output, errors = run("fit", curve, *ASKED, *asked)
    assert (status, errors) == (0, "")
    for word in ("contact angle", "volume", "offset", "rupture", "residuals", "correlation", "degrees of freedom"):
        assert word in output
    assert "°  ± 0." in output
    assert ElementTree.parse(picture).getroot().tag.endswith("svg")


def test_json_has_values_errors_and_units(curve, run):
    status, output, _ = run("fit", curve, *ASKED, "--rupture", "jump", "--json")
    found = json.loads(output)
    assert status == 0
    for name, truth in (("contact_angle", 0.5), ("volume", 1e-11), ("offset", 2e-6)):
        assert abs(found["values"][name] - truth) < 4.0 * found["errors"][name]
    assert found["units"] == {"contact_angle": "rad", "volume": "m^3", "offset": "m"}
    assert found["converged"]


def test_csv_has_the_curve(curve, run):
    _, output, _ = run("fit", curve, *ASKED, "--rupture", "jump", "--csv")
    rows = list(csv.DictReader(io.StringIO(output)))
    assert len(rows) == 70
    assert list(rows[0]) == ["separation [m]", "force [N]", "force_error [N]", "fitted [N]", "residuals [N]"]
    assert all(
        float(row["force [N]"]) - float(row["fitted [N]"]) == pytest.approx(float(row["residuals [N]"])) for row in rows
    )


def test_both_controls(curve, run):
    status, output, _ = run("fit", curve, *ASKED, "--rupture", "jump", "--control", "both")
    assert status == 0
    assert "constant volume fits better, odds more than a million to 1" in output
    _, output, _ = run("fit", curve, *ASKED, "--rupture", "jump", "--control", "both", "--json")
    assert json.loads(output)["better"] == "volume"


def test_bounds_and_law(curve, run):
    bounds = ("--bounds", "contact-angle=0:20", "--bounds", "volume=5nL:20nL")
    _, output, _ = run("fit", curve, *ASKED, "--free", "contact-angle,volume", "--rupture", "jump", *bounds)
    assert "note: contact_angle: at its upper bound" in output
    status, output, _ = run("fit", curve, *ASKED, "--free", "volume", "--method", "willett2000", "--json")
    assert status == 0
    assert json.loads(output)["method"] == "willett2000"


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        (("--free", "angle"), "free: 'angle' is not one of"),
        (("--columns", "gap"), "columns: 'gap' is not two names"),
        (("--rupture", "soon"), "rupture: 'soon' does not begin with a number"),
        (("--rupture", "1um,2um,3um"), "rupture: '1um,2um,3um' is not a length"),
        (("--jump-in", "5nm"), "jump-in: is a datum of exact bridges"),
        (("--bounds", "volume"), "bounds: 'volume' is not NAME=LOW:HIGH"),
        (("--bounds", "volume=1:2"), "bounds: '1' has no unit"),
        (("--bounds", "force-scale=a:2"), "bounds: 'a' is not a number"),
        (("--force-error", "1um"), "force-error: '1um' is not a quantity in N"),
        (("--control", "none"), "control: 'none' is not one of"),
        (("--method", "toro"), "method: 'toro' is neither"),
    ],
)
def test_bad_input_is_one_line(curve, run, asked, message):
    status, output, errors = run("fit", curve, *ASKED, *asked)
    assert (status, output) == (2, "")
    assert errors.startswith(f"pendular: {message}"), errors
    assert errors.count("\n") == 1


def test_a_missing_file_is_one_line(run):
    status, _, errors = run("fit", "none.csv", *ASKED)
    assert status == 2
    assert errors == "pendular: path: 'none.csv' cannot be read: No such file or directory\n"
