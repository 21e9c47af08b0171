"""The command film: thickness, condensation and rupture beside the bridge between the films."""

import csv
import io
import json

import pytest

import pendular as pl

ASKED = ("--radius", "1um", "--radius2", "plane", "--separation", "2nm")
WATER = pl.Liquid.water()
TIP = pl.Pair((1e-6, float("inf")))


def test_all_forms_tell_the_films_and_the_bridge(run):
    asked = (*ASKED, "--humidity", "90%", "--hamaker", "1e-20J")
    status, output, errors = run("film", *asked)
    assert status == 0
    assert "pendular: warning" in errors or errors == ""
    for words in ("film thickness           334.08 pm", "condensation separation", "rupture separation", "force"):
        assert words in output
    _, output, _ = run("film", *asked, "--json")
    found = json.loads(output)
    suction = pl.suction_from_humidity(0.9, WATER)
    deep = pl.film_thickness(suction, 1e-20)
    thick, shift = pl.filmed(TIP, deep)
    wanted = pl.bridge(thick, 2e-9 - shift, suction=suction, liquid=WATER)
    assert found["film_thickness"] == pytest.approx(deep)
    assert found["force"] == pytest.approx(wanted.force)
    assert found["units"]["condensation_separation"] == "m"
    gap = pl.condensation_separation(TIP, suction=suction, liquid=WATER, hamaker_constant=1e-20)
    assert found["condensation_separation"] == pytest.approx(gap)
    _, output, _ = run("film", *ASKED, "--suction", "10MPa", "--thickness", "1nm", "--csv")
    (row,) = csv.DictReader(io.StringIO(output))
    assert float(row["film_thickness [m]"]) == pytest.approx(1e-9)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            ["--suction", "10MPa"],
            "thickness: a film has one, 1nm, or a constant, --hamaker 1e-20J; write one of the two",
        ),
        (
            ["--volume", "1aL", "--thickness", "1nm"],
            "volume: films are in balance at a suction or a humidity; write one of these in its place",
        ),
        (["--suction", "10MPa", "--hamaker", "-1e-20J"], "hamaker: -1e-20 J is not > 0"),
        (["--suction", "10MPa", "--thickness", "1um"], "thickness: 1e-06 m is not in [0, 1e-07)"),
    ],
)
def test_bad_options_are_told_in_one_line(run, options, message):
    status, output, errors = run("film", *ASKED, *options)
    assert (status, output) == (2, "")
    assert errors == f"pendular: {message}\n"
