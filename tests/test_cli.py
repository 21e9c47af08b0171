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

import pendular as pl
from pendular.bridges import FIELDS
from pendular.cli import main

GRAINS = ("--radius", "50um", "--contact-angle", "20")
SUCTION = (*GRAINS, "--suction", "20kPa")
STATE = ("bridge", *SUCTION, "--separation", "1um")

WATER = pl.Liquid.water()
PAIR = pl.Pair(radius=50e-6, contact_angle=math.radians(20))


@pytest.fixture
def run(capsys):
    """Run the command in this process; returns its exit status, output and errors."""

    def run_with(*arguments: str) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as end:
            main(arguments)
        return (end.value.code, *capsys.readouterr())

    return run_with


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
    assert "Two 50 µm spheres, contact angle 20°" in table
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


def test_rupture_under_suction_has_no_earlier_limit(answer):
    found = parsed(answer("rupture", *SUCTION, "--json"))
    assert found["separation"] == pl.rupture(PAIR, suction=20e3, liquid=WATER).separation
    assert found["stability_limit"] is None


def test_rupture_at_constant_volume_tells_the_earlier_loss_of_stability(answer):
    asked = ("rupture", "--radius", "50um", "--contact-angle", "40", "--volume", "125um^3")
    fold, first = rows_of(answer(*asked, "--csv"))
    assert (fold["limit"], first["limit"]) == ("fold", "stability")
    assert float(fold["separation [m]"]) / 50e-6 == pytest.approx(0.135843, abs=1e-6)
    assert float(first["separation [m]"]) / 50e-6 == pytest.approx(0.133586, abs=1e-6)
    assert parsed(answer(*asked, "--json"))["stability_limit"]["separation"] == float(first["separation [m]"])
    assert re.search(r"^stable to +6.6793 µm ", answer(*asked), re.MULTILINE)


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


# -- questions -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (("--contact-angle", "20"), ("--contact-angle", "20deg")),
        (("--contact-angle", "20"), ("--contact-angle", f"{math.radians(20)!r} rad")),
        (("--radius2", "inf"), ("--radius2", "plane")),
        (("--radius2", "50um"), ("--radius2", "0.05 mm")),
        (("--contact-angle2", "20"), ("--liquid", "water", "--temperature", "293.15K")),
        (("--temperature", "77degF"), ("--temperature", "25 °C")),
        (("--surface-tension", "72.8mN/m"), ("--surface-tension", "72.8 dyn/cm")),
    ],
)
def test_several_ways_to_say_the_same(answer, one, other):
    assert answer(*STATE, *one, "--csv") == answer(*STATE, *other, "--csv")


def test_humidity_and_its_suction_give_the_same_force(run):
    plate = ("bridge", "--radius", "10um", "--radius2", "plane", "--separation", "0nm", "--json")
    warm = pl.Liquid.water(298.15)
    status, output, _ = run(*plate, "--humidity", "90%", "--temperature", "25degC")
    pascals = float(pl.suction_from_humidity(0.9, warm))
    again = run(*plate, "--suction", f"{pascals!r}Pa", "--temperature", "25degC")
    assert status == 0
    assert parsed(output)["force"] == pytest.approx(parsed(again[1])["force"], rel=1e-12)


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


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--radius", "-50um"), "radius: -5e-05 m is not > 0"),
        (("--radius", "0um"), "radius: 0.0 m is not > 0"),
        (("--radius", "50"), "radius: '50' has no unit; write it like 50um"),
        (("--radius", "50foo"), "radius: '50foo' has the unknown unit 'foo'; write it like 50um"),
        (("--radius", "50N"), "radius: '50N' is not a quantity in m; write it like 50um"),
        (("--radius", "wide"), "radius: 'wide' does not begin with a number; write it like 50um"),
        (("--radius", "nan um"), "radius: nan m is not a number"),
        (("--radius", "inf"), "radius: inf and inf are two planes; one of the two radii must be finite"),
        (("--radius2", "-5um"), "radius2: -5e-06 m is not > 0"),
        (("--contact-angle", "180"), "contact-angle: 180 deg is not in [0, 180)"),
        (("--contact-angle", "nan"), "contact-angle: nan deg is not in [0, 180)"),
        (("--radius2", ""), "radius2: '' does not begin with a number; write it like 50um"),
        (("--contact-angle2", ""), "contact-angle2: '' does not begin with a number; write it like 20deg"),
        (("--temperature", ""), "temperature: '' does not begin with a number; write it like 20degC"),
        (("--contact-angle2", "4rad"), "contact-angle2: 229.1831181 deg is not in [0, 180)"),
        (("--suction", "20"), "suction: '20' has no unit; write it like 20kPa"),
        (("--suction", "inf Pa"), "suction: inf Pa is not finite"),
        (("--volume", "5pL"), "control: suction and volume given; exactly one of suction, volume, humidity is needed"),
        (("--liquid", "watr"), "liquid: 'watr' is not a known liquid; did you mean water?"),
        (("--liquid", "unobtainium"), "liquid: 'unobtainium' is not a known liquid"),
        (("--temperature", "20kPa"), "temperature: '20kPa' is not a quantity in K; write it like 20degC"),
        (("--temperature", "-10degC"), "temperature: 263.15 K is not in [273.15, 647.096)"),
        (("--surface-tension", "0mN/m"), "surface-tension: 0.0 N/m is not > 0"),
        (
            ("--surface-tension", "72.8mN/m", "--liquid", "water"),
            "liquid: has no effect beside surface-tension; give one of the two",
        ),
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
        ((), "control: none given; exactly one of suction, volume, humidity is needed"),
        (("--humidity", "120%"), "humidity: 1.2 is not in (0, 1)"),
        (("--humidity", "0"), "humidity: 0.0 is not in (0, 1)"),
        (("--humidity", "90"), "humidity: '90' is above 1; write it like 90% or 0.9"),
        (("--humidity", "90kPa"), "humidity: '90kPa' is not a pure number; write it like 90% or 0.9"),
        (
            ("--humidity", "90%", "--surface-tension", "72.8mN/m"),
            "surface-tension: not enough for humidity, which needs the density of a liquid given by name",
        ),
        (("--volume", "-5pL"), "volume: -5e-15 m^3 is not > 0"),
        (
            ("--volume", "1L"),
            "volume: 0.001 m^3 is not in (0, 3.20474e-12): a drop of that size encloses the solids",
        ),
    ],
)
def test_bad_control_is_one_line_and_status_2(run, arguments, message):
    assert run("bridge", *GRAINS, *AT_1_UM, *arguments) == (2, "", f"pendular: {message}\n")


@pytest.mark.parametrize(
    ("arguments", "part"),
    [
        (("bridge", *SUCTION), "--separation"),
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
from pendular.cli import main
try:
    main(["--help"])
finally:
    print(sorted({"numpy", "scipy", "numba", "matplotlib", "pint", "thermo", "rich.markdown"} & set(sys.modules)))
"""
    done = process(code)
    assert done.returncode == 0
    assert done.stdout.splitlines()[-1] == "[]"


def test_bad_input_ends_the_process_without_a_traceback():
    done = process("from pendular.cli import main; main(['bridge', '--radius', '50', '--separation', '1um'])")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == "pendular: radius: '50' has no unit; write it like 50um\n"


def test_version_and_help(answer):
    assert answer("--version") == f"pendular {pl.__version__}\n"
    assert answer() == answer("--help")
    for command in ("bridge", "rupture", "curve"):
        assert command in answer("--help")


@pytest.mark.parametrize("arguments", [(), ("bridge",), ("rupture",), ("curve",)])
def test_the_example_in_each_help_works(run, tmp_path, monkeypatch, arguments):
    monkeypatch.chdir(tmp_path)
    _, text, _ = run(*arguments, "--help")
    (example,) = re.findall(r"^ +pendular (.+)$", text, re.MULTILINE)
    status, output, _ = run(*shlex.split(example))
    assert status == 0
    assert output
    assert [path.name for path in Path().iterdir()] == (["bridge.svg"] if "--plot" in example else [])


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
