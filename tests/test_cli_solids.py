"""Other solids than spheres on the command line."""

import json
import math

import pytest

import pendular as pl

WATER = pl.Liquid.water()


@pytest.fixture
def answer(run):
    """JSON of a run that succeeds without a word on stderr."""

    def answer_to(*arguments):
        status, output, errors = run(*arguments, "--json")
        assert (status, errors) == (0, "")
        return json.loads(output)

    return answer_to


@pytest.mark.parametrize(
    ("options", "solids"),
    [
        (("--solid", "cone:60deg", "--radius2", "plane"), (pl.Cone(math.radians(60.0)), math.inf)),
        (("--solid", "cone:60:20um", "--solid2", "sphere:0.1mm"), (pl.Cone(math.radians(60.0), 20e-6), 1e-4)),
        (("--radius", "plane", "--solid2", "paraboloid:50um"), (math.inf, pl.Paraboloid(50e-6))),
        (("--solid", "Disc:0.2mm"), (pl.Disc(0.2e-3), pl.Disc(0.2e-3))),
        (("--solid", "disc:0.1mm:pinned", "--diameter2", "1mm"), (pl.Disc(1e-4, pinned=True), 0.5e-3)),
    ],
)
def test_a_solid_in_the_place_of_a_radius(answer, options, solids):
    found = answer("bridge", *options, "--contact-angle", "20", "--volume", "1nL", "--separation", "20um")
    expected = pl.bridge(pl.Pair(solids, math.radians(20.0)), 20e-6, volume=1e-12, liquid=WATER)
    assert found["force"] == expected.force
    assert found["contact_radius"] == expected.contact_radius.tolist()


def test_the_title_names_the_solids(run):
    arguments = ("--contact-angle", "20", "--volume", "1nL", "--separation", "20um")
    _, output, _ = run("bridge", "--solid", "cone:60deg:20nm", "--solid2", "disc:1mm:pinned", *arguments)
    title = "Cone of half angle 60° and tip radius 20 nm and pinned disc of radius 1 mm, contact angle 20°\n"
    assert output.startswith(title)
    _, output, _ = run("bridge", "--solid", "paraboloid:50um", *arguments)
    assert output.startswith("Paraboloid of tip radius 50 µm on both sides, contact angle 20°\n")


def test_a_pair_of_solids_is_drawn(run, tmp_path):
    path = tmp_path / "cone.svg"
    solids = ("--solid", "cone:60deg", "--solid2", "disc:0.2mm", "--contact-angle", "30")
    status, _, errors = run("curve", *solids, "--volume", "1nL", "--plot", str(path))
    assert (status, errors) == (0, "")
    assert path.read_text("utf-8").count("<path") > 20


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--solid", "cube:1mm"), "solid: 'cube:1mm' is not one of cone:30deg"),
        (("--solid", "cone:120deg"), "solid: half angle '120deg' is not in (0, 90] degrees; write it like cone:30deg"),
        (("--solid", "disc:plane"), "solid: 'plane' is no length; write it like 1mm"),
        (("--solid", "disc:-1mm"), "solid: '-1mm' is not > 0; write it like 1mm"),
        (("--radius", "1mm", "--solid", "disc:1mm"), "solid: given together with radius; one of the two is needed"),
        (("--solid", "disc:1mm:glued"), "solid: 'disc:1mm:glued' is not one of"),
        (("--solid2", "disc:1mm"), "radius: missing; write --radius 50um, or --diameter 100um"),
    ],
)
def test_a_solid_that_cannot_be_meant_is_one_line(run, options, message):
    status, output, errors = run("bridge", *options, "--volume", "1nL", "--separation", "20um")
    assert (status, output) == (2, "")
    assert message in errors
    assert errors.count("\n") == 1


def test_laws_refuse_a_cone_in_one_line(run):
    status, output, errors = run("compare", "--solid", "cone:60deg", "--volume", "1nL")
    assert (status, output) == (2, "")
    assert "Cone(half_angle=1.0471975511965976, tip_radius=0.0) is neither a sphere nor a plane" in errors
    assert errors.count("\n") == 1
