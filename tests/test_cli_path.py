"""The command path: a loop with units becomes a table, a file, a picture."""

import csv
import io
import json
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

import pendular as pl

ASKED = ("--radius", "50um", "--contact-angle", "60", "--volume", "1pL", "--surface-tension", "72.8mN/m")
SLIDES = ("--advancing-angle", "60", "--receding-angle", "30")
LOOP = ("--separation", "5um,1um,20um", "--steps", "8")


def the_same():
    """The path that the options ask for."""
    gaps = np.concatenate([np.linspace(5e-6, 1e-6, 9), np.linspace(1e-6, 20e-6, 9)[1:]])
    angles = {"advancing_angle": np.deg2rad(60.0), "receding_angle": np.deg2rad(30.0)}
    pair = pl.Pair(50e-6, np.deg2rad(60.0))
    return pl.path(pair, gaps, volume=1e-15, contact_line="hysteresis", **angles, liquid=pl.Liquid(0.0728))


def test_table_tells_the_loop_and_its_end(run, tmp_path):
    picture = tmp_path / "loop.svg"
    status, output, errors = run("path", *ASKED, *SLIDES, *LOOP, "--plot", picture)
    assert (status, errors) == (0, "")
    for words in (
        "separation 5 µm to 1 µm to 20 µm",
        "advancing 60°  ·  receding 30°",
        "breaks at 14.055 µm, volume 1 pL: no equilibrium is left beyond",
        "of which 13.413 pJ dissipated up to the step before",
    ):
        assert words in output
    assert output.count("advancing\n") == 8
    assert ElementTree.parse(picture).getroot().tag.endswith("svg")


def test_csv_and_json_hold_all_steps(run):
    wanted = the_same()
    _, output, _ = run("path", *ASKED, *SLIDES, *LOOP, "--csv")
    rows = list(csv.DictReader(io.StringIO(output)))
    assert len(rows) == 17
    np.testing.assert_allclose([float(row["force [N]"]) for row in rows], wanted.force)
    np.testing.assert_allclose([float(row["contact_angle_2 [rad]"]) for row in rows], wanted.contact_angle[:, 1])
    assert [row["line_1"] for row in rows] == wanted.line[:, 0].tolist()
    assert float(rows[-1]["separation [m]"]) == pytest.approx(20e-6)  # what was asked, also where it is broken
    _, output, _ = run("path", *ASKED, *SLIDES, *LOOP, "--json")
    found = json.loads(output)
    assert found["rupture"]["separation"] == pytest.approx(wanted.rupture.separation)
    assert found["ending"] == wanted.ending
    assert found["units"]["dissipated"] == "J"


def test_lines_may_be_pinned_or_free(run):
    _, pinned, _ = run("path", *ASKED, "--separation", "3um,2um", "--steps", "1", "--contact-line", "pinned", "--csv")
    assert "pinned" in pinned.splitlines()[2]
    _, free, _ = run("path", *ASKED, "--separation", "3um,2um", "--steps", "1", "--csv")
    assert "free,free" in free.splitlines()[2]


def test_suction_goes_from_value_to_value_between_unlike_solids(run):
    asked = ("--radius", "50um", "--radius2", "plate", "--contact-angle", "40", "--separation", "1um")
    slides = ("--advancing-angle", "60", "--receding-angle", "30", "--receding-angle2", "10", "--steps", "4")
    status, output, errors = run("path", *asked, *slides, "--suction", "5kPa,50kPa,5kPa")
    assert (status, errors) == (0, "")
    for words in (
        "suction 5 kPa to 50 kPa to 5 kPa · separation 1 µm",
        "receding 30° and 10°",
        "angle 2",
        "radius 1",
    ):
        assert words in " ".join(output.split())


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ([*ASKED, "--separation", "5um"], "separation: a path goes from place to place; write it like 5um,1um,20um"),
        (
            [*ASKED, "--separation", "5um,1um", "--advancing-angle", "60"],
            "receding-angle: missing; contact-line 'hysteresis' needs advancing-angle and receding-angle",
        ),
        (
            [*ASKED, "--separation", "5um,1um", "--advancing-angle2", "60"],
            "advancing-angle2: given without advancing-angle",
        ),
        (
            [*ASKED, "--separation", "5um,1um", "--advancing-angle", "50", "--receding-angle", "30"],
            "contact-angle[0]: 1.0472 rad (60°), with which the path starts, is not between the receding angle, "
            "0.523599 rad (30°), and the advancing one, 0.872665 rad (50°)",
        ),
        ([*ASKED, "--separation", "5um,1um", "--steps", "0"], "steps: 0.0 is not >= 1"),
    ],
)
def test_bad_options_are_told_in_one_line(run, options, message):
    status, output, errors = run("path", *options)
    assert (status, output) == (2, "")
    assert errors == f"pendular: {message}\n"
