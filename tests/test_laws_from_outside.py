"""A law from outside, registered or brought by an installed package, is seen wherever laws are."""

import json
import math
import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tools import law_pages, site_parts

import pendular as pl
from pendular.comparison.measured import measured_errors
from pendular.front.cli import main
from pendular.laws import _registry, laws

GRAINS = ("--radius", "50um", "--contact-angle", "20", "--volume", "1pL")
PAIR, WATER = pl.Pair(50e-6, np.radians(20.0)), pl.Liquid.water()

# The simple law of Willett et al. with the rupture distance of Lian et al.: what each gives is known.
SOURCE = '''
"""Laws of someone else."""

import math

from pendular.laws import CONTACT_ANGLE, GAP, SIZE_RATIO, VOLUME, Law, Solids


def force_star(separation_star, volume_star, contact_angle1, contact_angle2, kappa1, kappa2):
    """Force at fixed volume.

    >>> force_star(0.0, 0.01, 0.0, 0.0, 1.0, 1.0)
    1.0
    """
    if separation_star > rupture_star(volume_star, contact_angle1, contact_angle2, kappa1, kappa2):
        return 0.0
    s = 0.5 * separation_star / math.sqrt(volume_star)
    return math.cos(contact_angle1) / (1.0 + 2.1 * s + 10.0 * s * s)


def rupture_star(volume_star, contact_angle1, contact_angle2, kappa1, kappa2):
    """Rupture distance at fixed volume."""
    return (1.0 + 0.5 * contact_angle1) * volume_star ** (1.0 / 3.0)


LAW = Law(
    name="smith2030",
    title="Law of Smith",
    control="volume",
    variables=(GAP, VOLUME, CONTACT_ANGLE, SIZE_RATIO),
    valid={"volume_star": (1e-4, 0.1), "contact_angle": (0.0, math.radians(40.0))},
    valid_text="volume_star from 1e-4 to 0.1, angles up to 40 degrees",
    solids={"force": Solids("equal", "mean", "mean"), "rupture": Solids("equal", "mean", "mean")},
    reference="A. Smith, Journal of Bridges 1 (2030) 1",
    doi="10.0000/smith",
    formula="F/(2πγR̄) = cos θ/(1 + 2.1 s + 10 s²),  s = (D/2)/√V\\nD_c = (1 + θ/2) V^(1/3)",
    force_star=force_star,
    rupture_star=rupture_star,
)
'''


def forget_packages():
    _registry._installed.cache_clear()
    _registry._of_a_package.cache_clear()


def install(folder, name, source, points):
    """A package with its metadata, as an installer leaves it in a folder of the path."""
    (folder / f"{name}.py").write_text(source, encoding="utf-8")
    info = folder / f"{name}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[pendular.laws]\n" + "".join(f"{point}\n" for point in points))


@pytest.fixture
def packages(tmp_path, monkeypatch):
    """Folder of the path whose packages are forgotten after the test."""
    forget_packages()
    monkeypatch.syspath_prepend(tmp_path)
    yield tmp_path
    sys.modules.pop("smith_laws", None)
    forget_packages()


@pytest.fixture
def record(monkeypatch):
    """Record from outside, and a registry that forgets it after the test."""
    monkeypatch.setattr(_registry, "_registered", {})
    scope = {"__name__": "smith_laws"}
    exec(SOURCE, scope)
    return scope["LAW"]


@pytest.fixture(params=["registered", "installed"])
def outside(request, record, packages):
    """A law from outside, either way."""
    if request.param == "registered":
        pl.laws.register(record)
    else:
        install(packages, "smith_laws", SOURCE, ["smith2030 = smith_laws:LAW"])
    return laws["smith2030"]


def printed(capsys, *arguments):
    with pytest.raises(SystemExit) as end:
        main(arguments)
    output = capsys.readouterr()
    assert (end.value.code, output.err) == (0, "")
    return output.out


# -- where it is seen --------------------------------------------------------------------------------------------------


def test_in_the_registry(outside):
    assert list(laws)[-1] == "smith2030"
    assert "smith2030" in pl.laws
    assert pl.laws["smith2030"] is outside
    assert len(pl.laws) == len(_registry.house_laws()) + 1
    assert outside in pl.laws.values()


def test_on_arrays_with_nan_where_python_has_no_answer(outside):
    volume = np.array([0.01, -0.01, 0.0, math.nan])
    computed = pl.laws.force_star("smith2030", [[0.0], [0.05]], volume, 0.2, 0.2, 1.0, 1.0)
    s = 0.025 / 0.1
    assert computed[:, 0] == pytest.approx(math.cos(0.2) / np.array([1.0, 1.0 + 2.1 * s + 10.0 * s * s]), rel=1e-15)
    assert np.isnan(computed[:, [1, 3]]).all()
    assert math.isnan(computed[0, 2])  # division by zero
    assert computed[1, 2] == 0.0  # beyond the rupture distance of no volume
    assert math.isnan(pl.laws.rupture_star("smith2030", -0.01, 0.2, 0.2, 1.0, 1.0))


def test_as_a_method(outside):
    bridge = pl.bridge(PAIR, 1e-6, volume=1e-15, liquid=WATER, method="smith2030")
    s = 0.5 * 1e-6 * math.sqrt(50e-6 / 1e-15)
    force = math.cos(PAIR.contact_angles[0]) / (1.0 + 2.1 * s + 10.0 * s * s)
    assert bridge.force == pytest.approx(2.0 * math.pi * WATER.surface_tension * 50e-6 * force, rel=1e-12)
    with pytest.warns(pl.RangeWarning, match="smith2030: volume_star 8"):
        pl.rupture(PAIR, volume=1e-11, liquid=WATER, method="smith2030")


def test_in_a_comparison_a_map_and_a_ranking(outside):
    (answer,) = [one for one in pl.compare(PAIR, volume=1e-15, liquid=WATER).laws if one.name == "smith2030"]
    twin = next(one for one in pl.compare(PAIR, volume=1e-15, liquid=WATER).laws if one.name == "willett2000_simple")
    known = (answer.force > 0.0) & (twin.force > 0.0)
    assert answer.force[known] == pytest.approx(twin.force[known], rel=1e-12)
    assert answer.rupture_separation > 0.0
    assert pl.error_map("smith2030").error.shape == pl.error_map("willett2000_simple").error.shape
    ranked = pl.recommend(reduced_volume=(1e-3, 1e-2), contact_angle=0.3, up_to=0.8)
    assert "smith2030" in {one.name for one in ranked.ranked} | set(ranked.disqualified)


def test_its_errors_are_measured_on_demand(outside):
    measured, twin = measured_errors(outside), measured_errors(laws["willett2000_simple"])
    here = measured.control_star[:, None] == twin.control_star
    here &= measured.contact_angle[:, None] == twin.contact_angle
    here &= measured.smaller_over_larger[:, None] == twin.smaller_over_larger
    mine, others = np.nonzero(here)
    assert mine.size > 20
    assert measured.errors.force[mine, :3] == pytest.approx(twin.errors.force[others, :3], rel=1e-8)
    assert measured_errors(outside) is measured


def test_what_cannot_be_measured_is_told(record, capsys):
    """A range beyond the grid, a function that fails."""
    pl.laws.register(replace(record, valid={"volume_star": (10.0, math.inf), "contact_angle": (1.2, 1.3)}))
    pl.laws.register(replace(record, name="broken2030", rupture_star=lambda v, t1, t2, k1, k2: v["broken"]))
    pl.laws.register(replace(record, name="silent2030", force_star=lambda d, v, t1, t2, k1, k2: math.nan))
    with pytest.warns(UserWarning, match="law 'broken2030' is not measured, as it fails: TypeError: 'float' object"):
        assert measured_errors(laws["broken2030"]).control_star.size == 0
    text = printed(capsys, "laws")
    for name in ("smith2030", "broken2030", "silent2030"):
        assert re.search(rf"^{name} +volume +force, rupture +", text, re.MULTILINE)
    assert re.search(r"^broken2030 +volume +force, rupture +– +– +– ", text, re.MULTILINE)
    assert "no error is measured" in re.sub(r"\s+", " ", printed(capsys, "laws", "broken2030"))
    assert "\nno error is measured" in law_pages.law_page(laws["broken2030"])


def test_in_the_commands(outside, capsys):
    assert re.search(r"^smith2030 +volume +force, rupture ", printed(capsys, "laws"), re.MULTILINE)
    page = printed(capsys, "laws", "smith2030")
    assert "Journal of Bridges" in page
    found = json.loads(printed(capsys, "laws", "smith2030", "--json"))
    assert len(found["measured_errors"]["force"]) == measured_errors(outside).control_star.size
    assert re.search(r"^smith2030 ", printed(capsys, "compare", *GRAINS), re.MULTILINE)


def test_in_pictures(outside, capsys, tmp_path):
    printed(capsys, "compare", *GRAINS, "--plot", str(tmp_path / "laws.svg"))
    assert "<!-- smith2030" in (tmp_path / "laws.svg").read_text("utf-8")


def test_in_the_documents(outside):
    assert "| [`smith2030`](laws/smith2030.md) | volume |" in law_pages.page()
    assert law_pages.law_page(laws["smith2030"]).startswith("# smith2030\n")
    assert ".. autofunction:: smith_laws.force_star" in list(site_parts.law_functions())


def test_its_help_is_completed(outside):
    for function in (outside.force_star, outside.rupture_star):
        assert "volume_star : float\n    Liquid volume over the cube of the Derjaguin radius, [-]" in function.__doc__
        assert "doi:10.0000/smith" in function.__doc__
    assert outside.force_star.__doc__.endswith(">>> force_star(0.0, 0.01, 0.0, 0.0, 1.0, 1.0)\n1.0\n")


def test_its_arguments_may_have_any_names(record):
    def force(*x):
        """Force."""
        return record.force_star(*x)

    def rupture(v, t1, t2, k1, k2):
        """Rupture distance."""
        return record.rupture_star(v, t1, t2, k1, k2)

    pl.laws.register(replace(record, force_star=force, rupture_star=rupture))
    assert pl.laws.force_star("smith2030", 0.0, 0.01, 0.0, 0.0, 1.0, 1.0) == 1.0
    for function in (force, rupture):
        assert "\nvolume_star : float\n    Liquid volume over the cube of the Derjaguin radius" in function.__doc__


# -- without a registration ------------------------------------------------------------------------------------------


def test_a_record_is_compared_as_it_is(record):
    found = pl.compare(PAIR, volume=1e-15, liquid=WATER, laws=[record, "willett2000"])
    assert {answer.name for answer in found.laws} == {"smith2030", "willett2000"}
    assert record.name not in laws
    pl.laws.register(record)
    (registered,) = pl.compare(PAIR, volume=1e-15, liquid=WATER, laws=["smith2030"]).laws
    (given,) = (answer for answer in found.laws if answer.name == "smith2030")
    assert np.array_equal(given.force, registered.force)


@pytest.mark.parametrize(
    ("chosen", "message"),
    [
        ("zhao2020", "laws: 'zhao2020' is not a sequence of names and records of laws"),
        (["zhao"], "laws: 'zhao' is not one of 'asymptotic', "),
        ([None], "laws: None is not one of 'asymptotic', "),
    ],
)
def test_what_is_no_law_is_refused(chosen, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        pl.compare(PAIR, volume=1e-15, liquid=WATER, laws=chosen)


def test_the_command_takes_a_law_of_a_file(record, tmp_path, capsys):
    (tmp_path / "smith.py").write_text(SOURCE, encoding="utf-8")
    told = printed(capsys, "compare", *GRAINS, "--law", f"{tmp_path / 'smith.py'}:LAW", "--json")
    assert "smith2030" in json.loads(told)["laws"]


@pytest.mark.parametrize(
    ("source", "place", "message"),
    [
        ("", "smith.py", "law: 'smith.py' is not FILE:NAME, like laws.py:my_law"),
        ("", "smith.py:LAW", "law: smith.py has no LAW"),
        ("LAW = 3", "smith.py:LAW", "law: 3 is not a record, pendular.laws.Law"),
        ("1 / 0", "smith.py:LAW", "law: smith.py fails with ZeroDivisionError: division by zero"),
        ("", "none.py:LAW", "law: 'none.py' cannot be read: No such file or directory"),
    ],
)
def test_the_command_refuses_in_one_line(source, place, message, tmp_path, monkeypatch, run):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "smith.py").write_text(source, encoding="utf-8")
    status, _, errors = run("compare", *GRAINS, "--law", place)
    assert (status, errors) == (2, f"pendular: {message}\n")


# -- in a process of its own -------------------------------------------------------------------------------------------


@pytest.fixture
def environment(tmp_path):
    """Environment of a process that has the package installed."""
    install(tmp_path, "smith_laws", SOURCE, ["smith2030 = smith_laws:LAW"])
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST")}
    return {**kept, "PYTHONPATH": str(tmp_path)}


def test_a_package_is_found_without_a_word(environment):
    code = "from pendular.front.cli import main; main(['laws', 'smith2030'])"
    run = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, encoding="utf-8")
    assert (run.returncode, run.stderr) == (0, "")
    assert "Law of Smith" in run.stdout


def test_no_law_is_loaded_before_it_is_asked_for(environment):
    code = """
import sys, pendular as pl
pl.laws.force_star("lian_seville2016", 0.0, 0.01, 0.0, 0.0, 1.0, 1.0)
pl.bridge(pl.Pair(5e-5), 1e-6, volume=1e-15, liquid=pl.Liquid.water())
loaded = {name.rpartition(".")[2] for name in sys.modules if name.startswith("pendular.laws.")}
print(sorted(loaded & set(pl.laws)), "smith_laws" in sys.modules)
"""
    run = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, encoding="utf-8")
    # One law is written with another.
    assert (run.returncode, run.stdout) == (0, "['lian_seville2016', 'willett2000'] False\n"), run.stderr


# -- Numba and Python --------------------------------------------------------------------------------------------------


@pytest.fixture
def compiled(record):
    """The law with functions that Numba compiles by the rules of Python, which raise where they divide by zero."""
    numba = pytest.importorskip("numba")
    rupture = numba.njit(record.rupture_star)
    scope = {"math": math, "rupture_star": rupture}
    exec(SOURCE[SOURCE.index("def force_star") : SOURCE.index("def rupture_star")], scope)
    return replace(record, name="smith2030_numba", force_star=numba.njit(scope["force_star"]), rupture_star=rupture)


@pytest.mark.parametrize("many", [0, 1_000_000])
def test_a_kernel_of_numba_answers_as_the_plain_function(record, compiled, many, monkeypatch):
    monkeypatch.setattr("pendular.laws._rows._MANY", many)
    pl.laws.register(record)
    pl.laws.register(compiled)
    rng = np.random.default_rng(8)
    print("seed 8")
    volume, gap = 10.0 ** rng.uniform(-4, -1, 500), rng.uniform(0.0, 0.3, 500)
    for asked in (volume, np.append(volume[:-1], 0.0)):
        both = [pl.laws.force_star(name, gap, asked, 0.3, 0.3, 1.0, 1.0) for name in ("smith2030", "smith2030_numba")]
        np.testing.assert_allclose(both[1], both[0], rtol=1e-14)


# -- what is refused ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "holder"), [("zhao2020", "a law of pendular"), ("exact", "a method"), ("table", "a method")]
)
def test_a_name_that_is_taken_is_refused(record, name, holder):
    with pytest.raises(ValueError, match=f"^law: the name '{name}' is taken by {holder}"):
        pl.laws.register(replace(record, name=name))
    assert len(laws) == len(_registry.house_laws())


def test_a_law_is_registered_once(record):
    pl.laws.register(record)
    with pytest.raises(ValueError, match=r"^law: the name 'smith2030' is taken by a law that was registered before$"):
        pl.laws.register(record)
    with pytest.raises(ValueError, match=r"^law: 'smith2030' is not a record"):
        pl.laws.register("smith2030")


def test_a_package_keeps_its_name(record, packages):
    install(packages, "smith_laws", SOURCE, ["smith2030 = smith_laws:LAW"])
    with pytest.raises(ValueError, match=r"^law: the name 'smith2030' is taken by the installed package smith_laws$"):
        pl.laws.register(record)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (["zhao2020 = smith_laws:LAW"], "the name 'zhao2020' in the installed package smith_laws is taken by a law of"),
        (["smith2031 = smith_laws:LAW"], "'smith2031' of the installed package smith_laws calls itself 'smith2030'"),
        (["smith2030 = smith_laws:force_star"], "'smith2030' of the installed package smith_laws is no record"),
        (["smith2030 = smith_laws:NONE"], "'smith2030' of the installed package smith_laws cannot be loaded: module"),
    ],
)
def test_a_package_that_is_wrong_is_one_line(packages, points, message, capsys):
    install(packages, "smith_laws", SOURCE, points)
    with pytest.raises(SystemExit) as end:
        main(["laws"])
    errors = capsys.readouterr().err
    assert end.value.code == 2
    assert errors.startswith(f"pendular: law: {message}")
    assert errors.count("\n") == 1


def test_two_packages_of_one_name_are_refused(packages):
    install(packages, "smith_laws", SOURCE, ["smith2030 = smith_laws:LAW"])
    install(packages, "more_laws", SOURCE, ["smith2030 = more_laws:LAW"])
    with pytest.raises(ValueError, match=r"taken by two installed packages, (smith|more)_laws and (smith|more)_laws"):
        list(laws)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"name": "Smith 2030"}, "name of law 'Smith 2030': it is not made of lower-case letters"),
        ({"control": "humidity"}, "control of law 'smith2030': 'humidity' is not one of 'suction', 'volume'"),
        ({"force_star": None, "rupture_star": None, "solids": {}}, "functions of law 'smith2030': none of force_star"),
        ({"rupture_star": None}, r"solids of law 'smith2030': given are those of \['force', 'rupture'\], the law"),
        (
            {"force_star": lambda gap, volume: 0.0},
            r"force_star of law 'smith2030': it does not take \(separation_star,",
        ),
        ({"variables": ()}, "variables of law 'smith2030': volume_star is missing"),
        ({"valid": {"volume_star": (1e-4, 0.1)}}, "valid of law 'smith2030': contact_angle is missing"),
        ({"valid": {"volume_star": (0.1, 1e-4)}}, "volume_star from 0.1 to 0.0001 is not a range in its hard limits"),
        ({"valid": {"contact_angle": (0.0, 90.0)}}, "contact_angle from 0 to 90 is not a range in its hard limits"),
        ({"valid": {"suction_star": (1.0, 2.0)}}, "valid of law 'smith2030': suction_star is not among the variables"),
    ],
)
def test_a_record_that_contradicts_itself_is_one_line(record, change, message):
    if change.get("valid", {}).keys() - {"volume_star"} or "from 0.1" in message:
        change = {"valid": {**record.valid, **change["valid"]}}
    with pytest.raises(ValueError, match=message):
        replace(record, **change)


# -- the folder --------------------------------------------------------------------------------------------------------


def test_every_file_of_the_folder_is_a_law_or_known_not_to_be():
    folder = Path(pl.laws.__file__).parent
    files = {path.stem for path in folder.glob("*.py") if not path.stem.startswith("_")}
    assert files == {*(law.name for law in _registry.house_laws()), *_registry._NO_LAWS}
    for name in _registry._NO_LAWS:
        assert "\nLAW = " not in (folder / f"{name}.py").read_text("utf-8")
