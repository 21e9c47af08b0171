"""The command: answers for people and machines, the same as the library's; one line for everything that is wrong."""

import csv
import io
import json
import math
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from typer.main import get_command

import pendular as pl
from pendular.ask.face import FIELDS
from pendular.front.cli import app

GRAINS = ("--radius", "50um", "--contact-angle", "20")
SUCTION = (*GRAINS, "--suction", "20kPa")
LIBRARY = pytest.mark.needs("liquids")  # that are not kept in the package
STATE = ("bridge", *SUCTION, "--separation", "1um")

WATER = pl.Liquid.water()
PAIR = pl.Pair(radius=50e-6, contact_angle=math.radians(20))


@pytest.fixture
def answer(run):
    """Output of a run that succeeds without a word on stderr."""

    def answer_to(*arguments: str) -> str:
        status, output, errors = run(*arguments)
        assert (status, errors) == (0, "")
        return output

    return answer_to


def parsed(text: str) -> dict:
    """JSON as the standard has it: without NaN and Infinity."""
    return json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is not JSON"))


def rows_of(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


# -- answers ---------------------------------------------------------------------------------------------------------


def test_the_table_of_a_bridge_tells_force_and_rupture_distance(answer):
    table = answer(*STATE)
    b = pl.bridge(PAIR, 1e-6, suction=20e3, liquid=WATER)
    assert "Two spheres of radius 50 µm, contact angle 20°" in table
    assert "water at 20 °C, 72.74 mN/m  ·  suction 20 kPa" in table
    assert re.search(rf"^force +{1e6 * b.force:.5g} µN ", table, re.MULTILINE)
    assert re.search(r"^rupture distance +3.3132 µm ", table, re.MULTILINE)
    assert re.search(r"^half filling angle +15.678° each ", table, re.MULTILINE)


def test_json_is_the_answer_of_the_library_to_the_last_digit(answer):
    found = parsed(answer(*STATE, "--json"))
    b = pl.bridge(PAIR, 1e-6, suction=20e3, liquid=WATER)
    for name, unit, _ in FIELDS:
        assert np.array_equal(found[name], getattr(b, name))
        assert found["units"][name] == unit
    assert found["rupture_separation"] == pl.rupture(PAIR, suction=20e3, liquid=WATER).separation


def test_csv_has_one_row_of_named_numbers_with_units(answer):
    (row,) = rows_of(answer(*STATE, "--csv"))
    b = pl.bridge(PAIR, 1e-6, suction=20e3, liquid=WATER)
    assert float(row["force [N]"]) == b.force
    assert float(row["contact_radius_2 [m]"]) == b.contact_radius[1]
    assert row["stable"] == "true"


def test_beyond_rupture_there_is_no_bridge_and_no_error(answer):
    far = ("bridge", *SUCTION, "--separation", "5um")
    found = parsed(answer(*far, "--json"))
    assert (found["exists"], found["force"], found["volume"]) == (False, 0.0, None)
    table = answer(*far)
    assert re.search(r"^force +0 N ", table, re.MULTILINE)
    assert re.search(r"^exists +no ", table, re.MULTILINE)


def test_the_unstable_branch(answer):
    found = parsed(answer(*STATE, "--branch", "unstable", "--json"))
    assert found["force"] == pl.bridge(PAIR, 1e-6, suction=20e3, liquid=WATER, branch="unstable").force


def test_without_a_contact_angle_the_liquid_wets_all(answer):
    found = parsed(answer("rupture", "--radius", "50um", "--suction", "20kPa", "--json"))
    assert found["separation"] == pl.rupture(pl.Pair(50e-6), suction=20e3, liquid=WATER).separation
    assert pl.rupture(pl.Pair(50e-6, 0.0), suction=20e3, liquid=WATER).separation == found["separation"]


def test_rupture_under_suction_has_no_earlier_limit(answer):
    found = parsed(answer("rupture", *SUCTION, "--json"))
    assert found["separation"] == pl.rupture(PAIR, suction=20e3, liquid=WATER).separation
    assert found["lower_end"] is None
    assert found["fold"] is None


def test_rupture_at_constant_volume_tells_the_earlier_loss_of_stability(answer):
    asked = ("rupture", "--radius", "50um", "--contact-angle", "40", "--volume", "125um^3")
    first, fold = rows_of(answer(*asked, "--csv"))
    assert (first["limit"], fold["limit"]) == ("rupture", "fold")
    assert float(fold["separation [m]"]) / 50e-6 == pytest.approx(0.135843, abs=1e-6)
    assert float(first["separation [m]"]) / 50e-6 == pytest.approx(0.133586, abs=1e-6)
    assert parsed(answer(*asked, "--json"))["fold"]["separation"] == float(fold["separation [m]"])
    assert re.search(r"^rupture distance +6.6793 µm ", answer(*asked), re.MULTILINE)
    assert re.search(r"^symmetric to +6.7922 µm ", answer(*asked), re.MULTILINE)


def test_rupture_of_a_large_drop_tells_both_ends(answer):
    angles = ("--contact-angle", "16.4", "--contact-angle2", "90.9")
    asked = ("rupture", "--radius", "50um", *angles, "--volume", "1.2625nL")
    found = parsed(answer(*asked, "--json"))
    assert found["separation"] / 50e-6 == pytest.approx(2.035887, abs=1e-6)
    assert found["lower_end"]["separation"] / 50e-6 == pytest.approx(0.216203, abs=1e-6)
    assert found["volume"] == pytest.approx(1.2625e-12, rel=1e-12)
    assert re.search(r"^begins at +10.81 µm ", answer(*asked), re.MULTILINE)


def test_a_curve_goes_over_the_fold_and_back(answer):
    rows = rows_of(answer("curve", *SUCTION, "--points", "11", "--csv"))
    gaps = [float(row["separation [m]"]) for row in rows]
    assert len(rows) == 11
    assert gaps.index(max(gaps)) == 5
    assert len(parsed(answer("curve", *SUCTION, "--points", "11", "--json"))["force"]) == 11


def test_the_table_of_a_curve_is_short_and_shows_the_rupture(answer):
    table = answer("curve", *SUCTION)
    assert len(table.splitlines()) < 30
    assert re.search(r"^ +3.3132 .* rupture", table, re.MULTILINE)


def test_solids_that_hold_no_bridge_apart(answer):
    dry = ("--radius", "50um", "--contact-angle", "100", "--suction", "20kPa")
    assert "no bridge" in answer("curve", *dry)
    assert parsed(answer("rupture", *dry, "--json"))["separation"] is None


# -- sweeps ----------------------------------------------------------------------------------------------------------


def test_a_sweep_of_the_separation_has_a_row_for_each_point(answer):
    rows = rows_of(answer("bridge", *SUCTION, "--separation", "0:8um:5", "--csv"))
    gaps = np.array([0.0, 2e-6, 4e-6, 6e-6, 8e-6])
    b = pl.bridge(PAIR, gaps, suction=20e3, liquid=WATER)
    assert [float(row["separation [m]"]) for row in rows] == gaps.tolist()  # where there is no bridge, too
    assert [float(row["force [N]"]) for row in rows] == b.force.tolist()
    assert [row["exists"] == "true" for row in rows] == b.exists.tolist() == [True, True, False, False, False]
    end = pl.rupture(PAIR, suction=20e3, liquid=WATER).separation
    assert {float(row["rupture_separation [m]"]) for row in rows} == {end}


def test_the_json_of_a_sweep_has_lists_of_one_length(answer):
    found = parsed(answer("bridge", *GRAINS, "--volume", "1:5pL:3", "--separation", "1um", "--json"))
    b = pl.bridge(PAIR, 1e-6, volume=[1e-15, 3e-15, 5e-15], liquid=WATER)
    for name in ("separation", "volume", "force", "contact_radius", "stable"):
        assert np.array_equal(found[name], getattr(b, name))
    ends = pl.rupture(PAIR, volume=[1e-15, 3e-15, 5e-15], liquid=WATER).separation
    assert found["rupture_separation"] == ends.tolist()


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("0:2um:3", "0um,1um,2um"),
        ("0um:2um:3", "0um,1um,2um"),
        ("0um:2:3", "0um,1um,2um"),
        (" 0 : 2000 nm : 3 ", "0um, 1um, 2um"),
        ("2um:0:3", "2um,1um,0um"),
        ("-1um:1um:3", "-1um,0um,1um"),
        ("0:10um", "0um,1um,2um,3um,4um,5um,6um,7um,8um,9um,10um"),
    ],
)
def test_several_ways_to_write_a_sweep(answer, one, other):
    asked = ("bridge", *SUCTION, "--csv", "--separation")
    for row, same in zip(rows_of(answer(*asked, one)), rows_of(answer(*asked, other)), strict=True):
        numbers = [name for name, value in row.items() if value not in ("true", "false")]
        assert [float(row[name]) for name in numbers] == pytest.approx(
            [float(same[name]) for name in numbers], rel=1e-12, nan_ok=True
        )
        assert {**row, **dict.fromkeys(numbers)} == {**same, **dict.fromkeys(numbers)}


def test_separation_and_control_go_side_by_side(answer):
    rows = rows_of(answer("bridge", *GRAINS, "--suction", "1kPa,5kPa", "--separation", "1um,3um", "--csv"))
    b = pl.bridge(PAIR, [1e-6, 3e-6], suction=[1e3, 5e3], liquid=WATER)
    assert [float(row["force [N]"]) for row in rows] == b.force.tolist()


def test_a_sweep_of_humidity_tells_the_humidity(run):
    asked = ("bridge", *GRAINS, "--separation", "100nm", "--humidity", "98%:99.8%:3")
    rows = rows_of(run(*asked, "--csv")[1])
    assert [float(row["humidity"]) for row in rows] == [0.98, 0.989, 0.998]
    assert [row["exists"] for row in rows] == ["false", "false", "true"]
    assert parsed(run(*asked, "--json")[1])["humidity"] == [0.98, 0.989, 0.998]
    assert run(*asked)[1].splitlines()[3].startswith("humidity   separation   rupture distance ")


def test_rupture_distances_of_a_sweep(answer):
    held = [1e-15, 1.26e-12]
    angles = ("--contact-angle", "16.4", "--contact-angle2", "90.9")
    asked = ("rupture", "--radius", "50um", *angles, "--volume", "1pL,1.26nL")
    pair = pl.Pair(50e-6, (math.radians(16.4), math.radians(90.9)))
    upper = pl.rupture(pair, volume=held, liquid=WATER).separation
    lower = pl.rupture(pair, volume=held, liquid=WATER, end="lower").separation
    rows = rows_of(answer(*asked, "--csv"))
    assert [float(row["separation [m]"]) for row in rows] == pytest.approx(upper.tolist(), rel=1e-12)
    assert [float(row["lower_separation [m]"] or "nan") for row in rows] == pytest.approx(
        lower.tolist(), rel=1e-12, nan_ok=True
    )
    assert parsed(answer(*asked, "--json"))["lower_separation"][1] == pytest.approx(lower[1], rel=1e-12)
    assert re.search(r"^ +101.7 +10.745 ", answer(*asked), re.MULTILINE)


def test_the_table_of_a_sweep_tells_where_there_is_no_bridge(answer):
    table = answer("bridge", *SUCTION, "--separation", "0:8um:3")
    assert re.search(r"^separation +rupture distance +force +volume .* bridge *$", table, re.MULTILINE)
    assert re.search(r"^ +0 +3.3132 +\S+ .* stable *$", table, re.MULTILINE)
    assert re.search(r"^ +4 +3.3132 +0 +– +20 +– +none *$", table, re.MULTILINE)


def test_a_sweep_of_the_separation_is_drawn_as_the_curve(answer, tmp_path):
    answer("bridge", *SUCTION, "--separation", "0:3um", "--plot", str(tmp_path / "sweep.svg"))
    answer("curve", *SUCTION, "--plot", str(tmp_path / "curve.svg"))
    assert (tmp_path / "sweep.svg").read_bytes() == (tmp_path / "curve.svg").read_bytes()


_NO_FORM = "is neither a value, 1um, nor a sweep, first:last:points, 0:8um:5, nor a list, 1um,2um,5um"


@pytest.mark.parametrize(
    ("separation", "message"),
    [
        *((text, f"{text!r} {_NO_FORM}") for text in (":", "0:8um:", "0:8um:5:2", "1um,", "1um,2um:3um", ":8um")),
        *(
            (f"0:8um:{n}", f"'{n}' in '0:8um:{n}' is not a number of points from 2 to 100000; write it like 0:8um:5")
            for n in ("1", "5.5", "-3", "few", "100001")
        ),
        ("0:8", "'8' has no unit; write it like 1um"),
        ("0:8foo", "'8foo' has the unknown unit 'foo'; write it like 1um"),
        ("0:8kPa", "'8kPa' is not a quantity in m; write it like 1um"),
        ("0,5um", "'0' in '0,5um' has no unit; write a list like 1um,2um,5um, and decimals with a point"),
        ("wide:8um", "'wide' does not begin with a number; write it like 1um"),
    ],
)
def test_a_bad_sweep_is_one_line_and_status_2(run, separation, message):
    assert run("bridge", *SUCTION, "--separation", separation) == (2, "", f"pendular: separation: {message}\n")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ("bridge", "--suction", "1:9kPa:3", "--separation", "0:8um:5"),
            "separation: 5 values beside 3 of suction; sweeps go side by side and need as many",
        ),
        (
            ("curve", "--suction", "1:9kPa:3"),
            "suction: 3 values are given where one is needed; bridge and rupture take a sweep",
        ),
        (
            ("compare", "--volume", "1pL,2pL"),
            "volume: 2 values are given where one is needed; bridge and rupture take a sweep",
        ),
        (("rupture", "--humidity", "50:90%"), "humidity: '50:90%' has a % at one end only; write it like 50%:90%:5"),
        (("rupture", "--humidity", "0,9"), "humidity: '9' is above 1; per cent have their sign, 9%"),
        (
            ("rupture", "--suction", "1:9kPa:3", "--plot", "a.svg"),
            "plot: draws the bridges of one suction, not of a sweep of it",
        ),
    ],
)
def test_a_sweep_in_the_wrong_place_is_one_line_and_status_2(run, arguments, message):
    assert run(arguments[0], *GRAINS, *arguments[1:]) == (2, "", f"pendular: {message}\n")


# -- questions -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (("--contact-angle", "20"), ("--contact-angle", "20deg")),
        (("--contact-angle", "20"), ("--contact-angle", f"{math.radians(20)!r} rad")),
        (("--radius2", "inf"), ("--radius2", "plane")),
        (("--radius2", "50um"), ("--radius2", "0.05 mm")),
        (("--radius2", "inf"), ("--diameter2", "plane")),
        (("--radius2", "5um"), ("--diameter2", "10um")),
        (("--contact-angle2", "20"), ("--liquid", "water", "--temperature", "293.15K")),
        (("--temperature", "77degF"), ("--temperature", "25 °C")),
        (("--surface-tension", "72.8mN/m"), ("--surface-tension", "72.8 dyn/cm")),
    ],
)
def test_several_ways_to_say_the_same(answer, one, other):
    assert answer(*STATE, *one, "--csv") == answer(*STATE, *other, "--csv")


def test_a_diameter_is_twice_the_radius(answer):
    sizes = (("--radius", "50um"), ("--radius", "50um", "--radius2", "20um"), ("--radius2", "plane", "--radius", "3um"))
    twice = (("--diameter", "0.1mm"), ("--diameter", "100um", "--radius2", "20um"))
    for one, other in zip(sizes, (*twice, ("--diameter", "6um", "--diameter2", "plane")), strict=True):
        assert answer("rupture", *one, "--suction", "5kPa") == answer("rupture", *other, "--suction", "5kPa")


def test_the_title_calls_a_radius_a_radius(answer):
    for sizes, title in (
        (("--diameter", "100um"), "Two spheres of radius 50 µm"),
        (("--diameter", "100um", "--diameter2", "20um"), "Spheres of radius 50 µm and 10 µm"),
        (("--diameter", "100um", "--radius2", "plane"), "Sphere of radius 50 µm on a plate"),
        (("--radius", "plane", "--diameter2", "100um"), "Plate and sphere of radius 50 µm"),
    ):
        assert answer("rupture", *sizes, "--suction", "5kPa").startswith(f"{title}, contact angle 0°\n")


def test_humidity_and_its_suction_give_the_same_force(run):
    plate = ("bridge", "--radius", "10um", "--radius2", "plane", "--separation", "0nm", "--json")
    warm = pl.Liquid.water(298.15)
    status, output, _ = run(*plate, "--humidity", "90%", "--temperature", "25degC")
    pascals = float(pl.suction_from_humidity(0.9, warm))
    again = run(*plate, "--suction", f"{pascals!r}Pa", "--temperature", "25degC")
    assert status == 0
    assert parsed(output)["force"] == pytest.approx(parsed(again[1])["force"], rel=1e-12)


def test_a_measured_surface_tension_beside_the_name_of_the_liquid(run):
    asked = ("rupture", "--radius", "10um", "--humidity", "95%", "--temperature", "25degC")
    soapy = pl.Liquid.water(298.15, surface_tension=0.0523)
    expected = pl.rupture(pl.Pair(10e-6), humidity=0.95, liquid=soapy)
    _, output, _ = run(*asked, "--liquid", "water", "--surface-tension", "52.3mN/m", "--json")
    assert parsed(output)["separation"] == expected.separation
    volume = f"{soapy.molar_mass / soapy.density!r} m^3/mol"
    measured = ("--surface-tension", "52.3mN/m", "--molar-volume", volume)
    for more in ((), ("--liquid", "water")):
        _, output, _ = run(*asked, *measured, *more, "--json")
        assert parsed(output)["separation"] == pytest.approx(expected.separation, rel=1e-14)
    assert "\nliquid at 25 °C, 52.3 mN/m  ·  relative humidity 95 %\n" in run(*asked, *measured)[1]


def test_a_warning_is_one_line_on_stderr(run):
    status, output, errors = run("bridge", *GRAINS, "--humidity", "50%", "--separation", "0nm")
    assert status == 0
    assert "force" in output
    assert re.fullmatch(r"pendular: warning: curvature radius down to .* doubtful below 4 nm\n", errors)


# -- pictures --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("suffix", "begins"), [(".svg", b"<?xml"), (".png", b"\x89PNG"), (".pdf", b"%PDF")])
def test_the_format_of_a_picture_follows_its_name(answer, tmp_path, suffix, begins):
    path = tmp_path / f"bridge{suffix}"
    assert f"picture: {path}" in answer(*STATE, "--plot", str(path))
    first = path.read_bytes()
    assert first.startswith(begins)
    answer(*STATE, "--plot", str(path), "--json")
    assert path.read_bytes() == first


@pytest.mark.parametrize("command", ["rupture", "curve"])
def test_every_command_draws(answer, tmp_path, command):
    answer(command, *SUCTION, "--plot", str(tmp_path / "bridge.svg"))
    assert "<!-- rupture -->" in (tmp_path / "bridge.svg").read_text()


# -- bad input -------------------------------------------------------------------------------------------------------

AT_1_UM = ("--separation", "1um")
_NO_ANGLE = "is not in [0, 180) degrees; write it like 20, 20deg or 0.35rad"
_ONE_CONTROL = "write one of --suction 20kPa, --volume 5pL, --humidity 90%"
_HUMIDITY = "; 50 % are 0.5, and saturation is a suction of 0"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--radius", "-50um"), "radius: '-50um' is not > 0; write it like 50um"),
        (("--radius", "0um"), "radius: '0um' is not > 0; write it like 50um"),
        (("--radius", "50"), "radius: '50' has no unit; write it like 50um"),
        (("--radius", "50foo"), "radius: '50foo' has the unknown unit 'foo'; write it like 50um"),
        (("--radius", "50N"), "radius: '50N' is not a quantity in m; write it like 50um"),
        (("--radius", "wide"), "radius: 'wide' does not begin with a number; write it like 50um"),
        (("--radius", "nan um"), "radius: 'nan um' is not > 0; write it like 50um"),
        (
            ("--radius", "inf"),
            "suction: holds no stable bridge between two planes, which dries up or floods the gap; hold a volume, or "
            "ask pendular bridge --branch unstable for the one between the two",
        ),
        (
            ("--half-filling-angle", "180"),
            "half-filling-angle: 180° of '180' is not in (0, 180) degrees; write it like 30",
        ),
        (
            ("--half-filling-angle2", "0:20:3"),
            "half-filling-angle2: 0° of '0:20:3' is not in (0, 180) degrees; write it like 30",
        ),
        (("--half-filling-angle", "1um"), "half-filling-angle: '1um' is not a quantity in deg; write it like 20deg"),
        (
            ("--half-filling-angle", "10", "--half-filling-angle2", "10"),
            "half-filling-angle2: given together with half-filling-angle; one of the two is needed",
        ),
        (
            ("--radius", "plane", "--radius2", "50um", "--half-filling-angle", "10"),
            "half-filling-angle: the first solid is a plane, which has none; --half-filling-angle2 names the other",
        ),
        (("--radius2", "-5um"), "radius2: '-5um' is not > 0; write it like 50um"),
        (("--diameter", "100um"), "diameter: given together with radius; one of the two is needed"),
        (
            ("--radius2", "5um", "--diameter2", "9um"),
            "diameter2: given together with radius2; one of the two is needed",
        ),
        (("--diameter2", "-5um"), "diameter2: '-5um' is not > 0; write it like 100um"),
        (("--contact-angle", "180"), f"contact-angle: '180' {_NO_ANGLE}"),
        (("--contact-angle", "-5deg"), f"contact-angle: '-5deg' {_NO_ANGLE}"),
        (("--contact-angle", "nan"), f"contact-angle: 'nan' {_NO_ANGLE}"),
        (("--contact-angle2", "4rad"), f"contact-angle2: '4rad' {_NO_ANGLE}"),
        (("--radius2", ""), "radius2: '' does not begin with a number; write it like 50um"),
        (("--contact-angle2", ""), "contact-angle2: '' does not begin with a number; write it like 20deg"),
        (("--temperature", ""), "temperature: '' does not begin with a number; write it like 20degC"),
        (("--suction", "20"), "suction: '20' has no unit; write it like 20kPa"),
        (("--suction", "inf Pa"), "suction: inf Pa is not finite"),
        (("--volume", "5pL"), f"control: suction and volume given; {_ONE_CONTROL}"),
        pytest.param(("--liquid", "watr"), "liquid: 'watr' is not a known liquid; did you mean water?", marks=LIBRARY),
        pytest.param(
            ("--liquid", "unobtainium"),
            "liquid: 'unobtainium' is not a known liquid; give surface-tension in place of the name",
            marks=LIBRARY,
        ),
        (
            ("--liquid", "PDMS"),
            "liquid: 'PDMS' is a polymer, of which there are no data; give surface-tension in place of the name",
        ),
        pytest.param(
            ("--liquid", "sucrose"),
            "liquid: no surface tension is known for sucrose; give surface-tension as well",
            marks=LIBRARY,
        ),
        (("--temperature", "20kPa"), "temperature: '20kPa' is not a quantity in K; write it like 20degC"),
        (("--temperature", "-10degC"), "temperature: 263.15 K is not in [273.15, 647.096)"),
        (("--surface-tension", "0mN/m"), "surface-tension: 0.0 N/m is not > 0"),
        (
            ("--surface-tension", "72.8mN/m", "--temperature", "25degC"),
            "temperature: has no effect beside surface-tension; give one of the two",
        ),
        (("--molar-volume", "18cm^3/mol"), "molar-volume: has no effect without humidity"),
        (("--branch", "thick"), "branch: 'thick' is not one of 'stable', 'unstable'"),
        (("--plot", "bridge.gif"), "plot: 'bridge.gif' does not end in one of .svg, .png, .pdf"),
        (("--plot", "no/such/folder.svg"), "plot: 'no/such/folder.svg' cannot be written: No such file or directory"),
        (("--json", "--csv"), "json: given together with csv; one of the two is needed"),
    ],
)
def test_bad_input_is_one_line_and_status_2(run, arguments, message):
    assert run(*STATE, *arguments) == (2, "", f"pendular: {message}\n")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((), f"control: none given; {_ONE_CONTROL}"),
        (("--humidity", "120%"), f"humidity: 1.2 is not in (0, 1){_HUMIDITY}"),
        (("--humidity", "1"), f"humidity: 1.0 is not in (0, 1){_HUMIDITY}"),
        (("--humidity", "0"), "humidity: 0.0 is not in (0, 1)"),
        (("--humidity", "90"), "humidity: '90' is above 1; per cent have their sign, 90%"),
        (("--humidity", "900"), "humidity: '900' is above 1; write it like 90% or 0.9"),
        (("--humidity", "90kPa"), "humidity: '90kPa' is not a pure number; write it like 90% or 0.9"),
        (
            ("--humidity", "90%", "--surface-tension", "72.8mN/m"),
            "surface-tension: not enough for humidity; name the liquid as well, or write its molar-volume, like "
            "18cm^3/mol",
        ),
        (
            ("--humidity", "90%", "--molar-volume", "18cm^3/mol"),
            "surface-tension: missing beside molar-volume; write it like 72.8mN/m, or name the liquid",
        ),
        (
            ("--humidity", "90%", "--molar-volume", "18cm^3", "--liquid", "water"),
            "molar-volume: '18cm^3' is not a quantity in m^3/mol; write it like 18cm^3/mol",
        ),
        pytest.param(
            ("--humidity", "90%", "--liquid", "squalane"),
            "liquid: squalane lacks density (or molar_volume), needed for humidity; give molar-volume as well",
            marks=LIBRARY,
        ),
        (("--volume", "-5pL"), "volume: -5e-15 m^3 is not > 0"),
        (
            ("--volume", "1L"),
            "volume: 0.001 m^3 is not in [1.25e-43, 1.25e-09] m^3, 1e-30 to 10000 R³ with the mean radius R = 5e-05 m",
        ),
    ],
)
def test_bad_control_is_one_line_and_status_2(run, arguments, message):
    assert run("bridge", *GRAINS, *AT_1_UM, *arguments) == (2, "", f"pendular: {message}\n")


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (("bridge", *SUCTION), "separation: missing; write --separation 1um, or --half-filling-angle 30"),
        (("dataset",), "path: missing; zarr store to write, or to continue: bridges.zarr"),
        pytest.param(
            ("dataset", "a.zarr", "--contact-angle", "200"),
            f"contact-angle: '200' {_NO_ANGLE}",
            marks=pytest.mark.needs("data"),
        ),
        (("export", "c", "--contact-angle", "200", "--out", "b.h"), f"contact-angle: '200' {_NO_ANGLE}"),
        (("export", "c", "--out", "b.h"), "contact-angle: missing; contact angle: 20 or 20deg, 0.35rad"),
        (("bridge", *AT_1_UM, "--suction", "1kPa"), "--radius"),
        ((*STATE, "--radis", "50um"), "--radis"),
        (("brigde", *SUCTION), "brigde"),
        (("curve", *SUCTION, "--points", "few"), "--points"),
        (("curve", *SUCTION, "--points", "4"), "points: 4.0 is not >= 5"),
        (("bridge", *SUCTION, "--separation", "-40um"), "-4e-05 m is not > -2.5e-05"),
    ],
)
def test_a_command_that_is_not_understood_is_one_line_and_status_2(run, arguments, part):
    status, output, errors = run(*arguments)
    assert (status, output) == (2, "")
    assert re.fullmatch(rf"pendular: .*{re.escape(part)}.*\n", errors)


# -- the process -----------------------------------------------------------------------------------------------------


def process(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


def test_help_imports_nothing_heavy():
    code = """
import sys
from pendular.front.cli import app, main
try:
    main(["--help"])
finally:
    print(sorted({"numpy", "scipy", "numba", "matplotlib", "pint", "thermo", "rich.markdown"} & set(sys.modules)))
"""
    done = process(code)
    assert done.returncode == 0
    assert done.stdout.splitlines()[-1] == "[]"


def test_bad_input_ends_the_process_without_a_traceback():
    done = process("from pendular.front.cli import main; main(['bridge', '--radius', '50', '--separation', '1um'])")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "pendular: radius: '50' has no unit; write it like 50um\n"


def test_version_and_help(answer):
    assert answer("--version") == f"pendular {pl.__version__}\n"
    for command in ("bridge", "rupture", "curve"):
        assert command in answer("--help")


def commands_of(group, path=()):
    """Words of every command and group of commands, with those inside."""
    yield path
    for name, command in getattr(group, "commands", {}).items():
        yield from commands_of(command, (*path, name))


@pytest.mark.parametrize("arguments", list(commands_of(get_command(app))), ids=" ".join)
def test_every_command_has_its_help_by_a_letter_too(answer, arguments):
    text = answer(*arguments, "--help")
    assert f"Usage: {' '.join(('pendular', *arguments))} " in text
    assert answer(*arguments, "-h") == text


@pytest.mark.parametrize("arguments", [(), ("export",)], ids=["pendular", "pendular export"])
def test_a_group_alone_shows_its_help(answer, arguments):
    assert answer(*arguments) == answer(*arguments, "--help")


@pytest.mark.parametrize("arguments", [(), ("bridge",), ("rupture",), ("curve",)])
def test_the_example_in_each_help_works(run, tmp_path, monkeypatch, arguments):
    monkeypatch.chdir(tmp_path)
    _, text, _ = run(*arguments, "--help")
    examples = re.findall(r"^ +pendular (.+)$", text, re.MULTILINE)
    assert examples
    for example in examples:
        status, output, _ = run(*shlex.split(example))
        assert status == 0
        assert output
    assert [path.name for path in Path().iterdir()] == (["bridge.svg"] if "--plot" in text.split("Example:")[1] else [])


@pytest.mark.needs("data")
def test_dataset_writes_a_store_and_tells_what_it_holds(run, tmp_path):
    store = str(tmp_path / "bridges.zarr")
    arguments = ("dataset", store, "--shape", "40x30", "--ratio", "1", "--contact-angle", "20")
    status, output, _ = run(*arguments, "--netcdf", str(tmp_path / "bridges.nc"))
    assert status == 0
    assert output.startswith("1200 points: 1 size ratio x 1 contact angle x 40 half filling angle x 30 neck ratio\n")
    assert (tmp_path / "bridges.nc").exists()
    assert run(*arguments)[0] == 0  # continues, with nothing left to do
    status, _, errors = run("dataset", store, "--shape", "50x30")
    assert (status, errors) == (2, f"pendular: path: {store} holds a data base with other coordinates\n")
    assert run("dataset", store, "--shape", "50")[2] == "pendular: shape: '50' is not of the form 240x200\n"


# -- half-filling angles and plates ----------------------------------------------------------------------------------


def test_a_half_filling_angle_takes_the_place_of_the_separation(run):
    status, output, _ = run("bridge", *SUCTION, "--half-filling-angle", "15", "--json")
    answer = json.loads(output)
    assert status == 0
    assert answer["half_filling_angle"] == pytest.approx([math.radians(15)] * 2, rel=1e-12)
    again = json.loads(run("bridge", *SUCTION, "--separation", f"{answer['separation']!r}m", "--json")[1])
    assert again["force"] == pytest.approx(answer["force"], rel=1e-10)
    second = json.loads(run("bridge", *SUCTION, "--half-filling-angle2", "15", "--json")[1])
    assert second["force"] == pytest.approx(answer["force"], rel=1e-10)


def test_half_filling_angles_are_swept(run):
    status, output, _ = run("bridge", *SUCTION, "--half-filling-angle", "5:15:3", "--csv")
    rows = list(csv.DictReader(output.splitlines()))
    assert status == 0
    assert [float(row["half_filling_angle_1 [rad]"]) for row in rows] == pytest.approx(np.radians([5.0, 10.0, 15.0]))
    shown = run("bridge", *SUCTION, "--half-filling-angle", "5deg,170deg")[1]
    assert "half filling angle" in shown
    assert shown.splitlines()[-1].split()[0] == "170"
    assert shown.rstrip().endswith("none")


def test_of_two_bridges_with_one_angle_a_separation_chooses(run):
    asked = ("bridge", "--radius", "50um", "--contact-angle", "20", "--volume", "1pL", "--half-filling-angle", "10")
    status, _, complaint = run(*asked)
    assert status == 2
    assert complaint.startswith("pendular: half-filling-angle: 0.174533 rad, 10°, is that of 2 stable bridges, at ")
    assert complaint.endswith("m; write --separation near to the one that is meant, too\n")
    assert json.loads(run(*asked, "--separation", "6um", "--json")[1])["separation"] == pytest.approx(6.16686e-6)


def test_two_plates(run, tmp_path):
    plates = ("--radius", "plane", "--contact-angle", "40", "--volume", "1uL", "--surface-tension", "72.8mN/m")
    picture = tmp_path / "plates.svg"
    status, output, _ = run("bridge", *plates, "--separation", "0.4mm", "--plot", str(picture))
    assert status == 0
    assert output.startswith("Two plates, contact angle 40°\n")
    assert "875.69 µN" in output
    assert picture.stat().st_size > 1000
    assert "875.69 µN" not in run("rupture", *plates)[1]
    assert json.loads(run("curve", *plates, "--points", "11", "--json")[1])["exists"] == [True] * 11


def test_a_nucleus_between_plates_has_no_rupture_distance(run):
    plates = ("bridge", "--radius", "plane", "--contact-angle", "40", "--suction", "100Pa", "--separation", "0.4mm")
    status, output, _ = run(*plates, "--branch", "unstable")
    assert status == 0
    assert "rupture" not in output
    assert "166.8 nL" in output
    told = "plot: draws a bridge beside the stable ones, of which two planes under suction have none"
    assert run(*plates, "--branch", "unstable", "--plot", "x.svg") == (2, "", f"pendular: {told}\n")
