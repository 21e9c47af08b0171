"""The commands for the laws: the same answers as the library's, and one line for what is wrong."""

import csv
import io
import json
import re
import shlex

import numpy as np
import pytest

import pendular as pl
from pendular.laws import laws

GRAINS = ("compare", "--radius", "50um", "--contact-angle", "20", "--volume", "1pL")
RANKED = ("compare", "--recommend", "--reduced-suction", "10", "1e4", "--contact-angle-range", "0", "40")
WATER = pl.Liquid.water()
PAIR = pl.Pair(50e-6, np.radians(20.0))


@pytest.fixture
def answer(run):
    """Output of a run that succeeds without a word on stderr."""

    def answer_to(*arguments):
        status, output, errors = run(*arguments)
        assert (status, errors) == (0, "")
        return output

    return answer_to


def parsed(text):
    return json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is not JSON"))


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


def numbers(values):
    """JSON without its nulls."""
    return np.array(values, dtype=np.float64)


# -- laws ------------------------------------------------------------------------------------------------------------


def test_the_list_has_every_law_with_its_largest_error(answer):
    text = answer("laws")
    for name, law in laws.items():
        assert re.search(rf"^{name} +{law.control} +", text, re.MULTILINE)
    assert re.search(r"^willett2000 +volume +force, rupture +8\.4 % +3\.9 % +– ", text, re.MULTILINE)


@pytest.mark.parametrize("name", list(laws))
def test_all_of_one_law_is_told(answer, name):
    text, law = answer("laws", name), laws[name]
    unwrapped = re.sub(r"\s+", " ", text)
    for line in law.formula.splitlines():
        assert re.sub(r"\s+", " ", line.strip()) in unwrapped
    for variable in law.variables:
        assert variable.name in text
    assert law.reference.split(",")[0] in text
    assert text.count("erratum") == len(law.errata)
    found = parsed(answer("laws", name, "--json"))
    assert found["formula"] == law.formula
    assert found["reference"] == law.reference
    assert len(found["measured_errors"]["force"]) == len(found["measured_errors"][f"{law.control}_star"])
    assert all(len(row) == 5 for row in found["measured_errors"]["force"])


def test_the_json_of_all_laws_is_that_of_each(answer):
    found = parsed(answer("laws", "--json"))
    assert list(found) == list(laws)
    assert found["zhao2020"] == parsed(answer("laws", "zhao2020", "--json"))


def test_an_unknown_law_is_one_line(run):
    status, output, errors = run("laws", "zhao")
    assert (status, output) == (2, "")
    assert re.fullmatch(r"pendular: law: 'zhao' is not one of 'asymptotic', .*\n", errors)


# -- compare ---------------------------------------------------------------------------------------------------------


def test_the_table_of_a_pair_tells_the_errors(answer):
    text = answer(*GRAINS)
    found = pl.compare(PAIR, volume=1e-15, liquid=WATER)
    assert "Two spheres of radius 50 µm, contact angle 20°" in text
    for law in found.laws:
        assert re.search(rf"^{law.name} ", text, re.MULTILINE)
        assert ("by exact suction" in re.search(rf"^{law.name} .*", text, re.MULTILINE)[0]) == law.converted
    for name in found.refused:
        assert f"not asked: {name}, " in text
    best = found.laws[0]
    assert re.search(rf"^{best.name} .* {100.0 * best.largest_error:.1f} % ", text, re.MULTILINE)


def test_json_of_a_pair_is_the_answer_of_the_library(answer):
    found, direct = parsed(answer(*GRAINS, "--json")), pl.compare(PAIR, volume=1e-15, liquid=WATER)
    assert np.array_equal(found["force"], direct.force)
    assert list(found["laws"]) == [law.name for law in direct.laws]
    assert found["refused"] == direct.refused
    for law in direct.laws:
        assert np.array_equal(numbers(found["laws"][law.name]["error"]), law.error, equal_nan=True)


def test_csv_of_a_pair_has_a_column_for_each_force(answer):
    rows, direct = rows_of(answer(*GRAINS, "--csv")), pl.compare(PAIR, volume=1e-15, liquid=WATER)
    assert [float(row["force [N]"]) for row in rows] == direct.force.tolist()
    law = direct.laws[0]
    assert [float(row[f"{law.name} [N]"]) for row in rows] == law.force.tolist()
    assert [float(row[f"{law.name} error"]) for row in rows] == law.error.tolist()


def test_map_is_that_of_the_library(answer):
    found, direct = parsed(answer("compare", "--map", "asymptotic", "--json")), pl.error_map("asymptotic")
    assert (found["fraction"], found["quantity"]) == (0.5, "force")
    assert np.array_equal(numbers(found["error"]), direct.error, equal_nan=True)
    rows = rows_of(answer("compare", "--map", "asymptotic", "--fraction", "0", "--csv"))
    at_contact = pl.error_map("asymptotic", fraction=0.0)
    i, j = 100, 7
    row = rows[i * at_contact.contact_angle.size + j]
    assert float(row["suction_star"]) == at_contact.control_star[i]
    assert float(row["contact_angle [rad]"]) == at_contact.contact_angle[j]
    assert float(row["error"]) == at_contact.error[i, j]
    assert re.search(r"^ +0° ", answer("compare", "--map", "lian1993"), re.MULTILINE)


def test_recommendation_is_that_of_the_library(answer):
    direct = pl.recommend(reduced_suction=(10.0, 1e4), contact_angle=(0.0, np.radians(40.0)))
    found = parsed(answer(*RANKED, "--json"))
    assert [law["name"] for law in found["ranked"]] == [law.name for law in direct.ranked]
    assert [law["largest_error"] for law in found["ranked"]] == [law.largest_error for law in direct.ranked]
    assert found["disqualified"] == direct.disqualified
    text = answer(*RANKED)
    assert f"best: {direct.ranked[0].name}\n" in text
    assert "2475 exact bridges" in text
    assert [row["name"] for row in rows_of(answer(*RANKED, "--csv"))] == [law.name for law in direct.ranked]


@pytest.mark.parametrize("arguments", [GRAINS, ("compare", "--map", "willett2000")])
def test_pictures_are_written(answer, tmp_path, arguments):
    picture = tmp_path / "laws.png"
    assert f"picture: {picture}" in answer(*arguments, "--plot", str(picture))
    assert picture.stat().st_size > 20_000


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("compare", "--volume", "1pL"), "radius: missing; write --radius 50um, or --diameter 100um"),
        (
            ("compare", "--radius", "50um"),
            "control: none given; write one of --suction 20kPa, --volume 5pL, --humidity 90%",
        ),
        ((*GRAINS, "--fraction", "0.5"), "fraction: has no effect without map"),
        ((*GRAINS, "--up-to", "0.5"), "up-to: has no effect without recommend"),
        ((*GRAINS, "--map", "zhao2020"), "radius: has no effect beside map"),
        (("compare", "--map", "zhao2020", "--recommend"), "recommend: has no effect beside map"),
        ((*RANKED, "--plot", "x.svg"), "plot: has no effect beside recommend"),
        ((*RANKED, "--suction", "1kPa"), "suction: has no effect beside recommend"),
        ((*RANKED, "--up-to", "1"), "up_to: 1.0 is not in [0, 1)"),
        (
            ("compare", "--recommend"),
            "control: exactly one of reduced-suction and reduced-volume is needed, none is given",
        ),
        (("compare", "--map", "zhao2020", "--plot", "x.gif"), "plot: 'x.gif' does not end in one of .svg, .png, .pdf"),
    ],
)
def test_what_is_wrong_is_one_line_and_status_2(run, arguments, message):
    assert run(*arguments) == (2, "", f"pendular: {message}\n")


@pytest.mark.parametrize("command", ["laws", "compare"])
def test_the_examples_in_the_help_work(run, tmp_path, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    _, text, _ = run(command, "--help")
    (tmp_path / "laws.py").write_text(
        "from dataclasses import replace\nfrom pendular.laws import laws\n"
        "my_law = replace(laws['zhao2020'], name='my_law')\n"
    )
    monkeypatch.setattr("pendular.laws._registry._registered", {})
    examples = re.findall(r"^ +pendular (.+)$", text, re.MULTILINE)
    assert len(examples) == {"laws": 1, "compare": 4}[command]
    for example in examples:
        status, output, errors = run(*shlex.split(example))
        assert (status, errors) == (0, "")
        assert output
