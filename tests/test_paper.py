"""The article, drawn anew and audited: verdicts, figures, and the page."""

import json
import re
from functools import partial
from html import escape

import numpy as np
import pytest
from studies.paper import sample
from studies.paper.claims import measure
from studies.paper.figures import FIGURES
from studies.paper.report import json_text, write_report

from pendular.front.cli import data

DENSITY = 0.1  # of the full sample

# What is known from the reference tables of the exact solution; the numbers of a claim are checked below.
HOLDS = {
    "torus_rupture_1e4": True,
    "torus_rupture_1e6": True,
    "torus_coefficient": False,
    "fit_rupture_high": False,
    "fit_rupture_low": False,
    "torus_ratios": True,
    "fit_ratios": True,
    "derjaguin": True,
    "neck_at_contact": True,
    "fit_force_pointwise_exact": False,
    "fit_force_pointwise_printed": False,
    "fit_force_at_contact_exact": False,
    "fit_force_at_contact_printed": False,
    "torus_force": False,
    "torus_force_ratios": True,
    "fit_force_ratios": False,
    "force_falls_with_suction": False,
    "force_small_below_1": False,
    "coefficients": True,
    "cubic_roots": False,
    "quartic_roots": True,
    "cubic_for_quartic": True,
    "beta_series": True,
    "closure": True,
    "maximum_of_p": False,
    "surface_energy_volume": True,
    "potential_suction": True,
    "surface_energy_suction": True,
    "surface_energy_criterion": False,
    "potential_volume": False,
    "size_suction": True,
    "volume_and_suction": False,
    "neck_inside": False,
    "kelvin": True,
    "humidity_control": True,
    "soil": False,
}

NUMBERS = [
    ("torus_rupture_1e4", "0 deg", 1.63, 0.01),
    ("torus_rupture_1e4", "20 deg", 0.82, 0.01),
    ("torus_rupture_1e4", "40 deg", 0.25, 0.01),
    ("torus_rupture_1e6", "0 deg", 0.34, 0.01),
    ("torus_coefficient", "0 deg", 100.0 * (0.84375 / 2.0818696 - 1.0), 0.01),
    ("fit_rupture_high", "40 deg", -0.54, 0.01),
    ("fit_rupture_low", "0 deg", -28.8, 0.1),
    ("fit_rupture_low", "20 deg", -25.1, 0.1),
    ("derjaguin", "H* = 1", -18.7, 0.1),
    ("fit_force_pointwise_exact", "H* = 10³", -7.8, 0.1),
    ("fit_force_pointwise_exact", "H* = 10⁵", -26.0, 0.5),
    ("fit_force_pointwise_printed", "H* = 10³", -21.0, 0.5),
    ("torus_force", "H* = 10⁴, 40 deg", -1.67, 0.01),
    ("coefficients", "largest K4/H*", 1.0, 1e-12),
    ("coefficients", "smallest K3/H*", -4.0, 1e-12),
    ("quartic_roots", "physical roots at 0.999 S_crit", 2.0, 0.0),
    ("quartic_roots", "physical roots at 1.001 S_crit", 0.0, 0.0),
    ("beta_series", "order of the rest", 4.0, 0.05),
    ("surface_energy_criterion", "stable E_surf", 0.577959, 1e-6),
    ("surface_energy_criterion", "unstable E_surf", 0.462122, 1e-6),
    ("surface_energy_criterion", "stable potential", 0.317396, 1e-6),
    ("surface_energy_criterion", "unstable potential", 0.321867, 1e-6),
    ("maximum_of_p", "0 deg", -7.8, 0.5),  # the table is that of vanishing volume
    ("maximum_of_p", "20 deg", -2.4, 0.3),
    ("neck_inside", "outside", 2.0, 0.0),
    ("humidity_control", "h = 0.99", 10.1, 0.1),
    ("soil", "0 deg", 4.533, 0.05),
    ("soil", "20 deg", 2.810, 0.05),
    ("soil", "40 deg", 0.5276, 0.01),
]

LABELS = {
    2: [("$Q = Y_0/Y_c$", "$P = |X_c|/Y_c$")] * 2,
    3: [("$H^*$", "$2S^*_{crit}\\,H^*$")],
    4: [("$S^*$", "$\\lambda^*$")] * 2,
    5: [("$H^*$", "$2S^*_{crit}\\,H^*$")],
    6: [("$H^*$", "$(H^*/2)^{1/2}\\,Y_0^*(S^*=0)$")],
    7: [("$S^*/S^*_{crit}$", "$Y_0^*/Y_0^*(S^*=0)$")] * 2,
    8: [("$S^*/S^*_{crit}$", "$\\lambda^*$")] * 2,
    9: [("$H^*$", "$2S^*_{crit}\\,H^*$")] * 2,
    10: [("$S^*$", "$\\lambda^*$")] * 2,
    11: [("$S^*$", "$\\lambda^*$"), ("$S^*$", "$E^*_{surf}$"), ("$S^*$", "$E^*_{surf+\\Delta pV}$")],
    12: [("$S^*$", "$\\lambda^*$"), ("$S^*$", "$E^*_{surf}$"), ("$S^*$", "$E^*_{surf+\\Delta pV}$")],
}


@pytest.fixture(scope="module")
def claims():
    return {claim.name: claim for group in measure(DENSITY).values() for claim in group}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    steps = []
    home = tmp_path_factory.mktemp("paper") / "out"
    paths = write_report(home, density=DENSITY, progress=lambda done, share: steps.append(share))
    assert all(path.stat().st_size for path in paths)
    assert steps == sorted(steps)
    assert steps[-1] == 1.0
    return home


def test_every_claim_has_its_own_name_and_a_verdict_that_is_known(claims):
    assert {name: claim.holds for name, claim in claims.items()} == HOLDS


@pytest.mark.parametrize(("name", "key", "expected", "tolerance"), NUMBERS, ids=lambda value: str(value))
def test_claims_measure_what_the_reference_tables_say(claims, name, key, expected, tolerance):
    assert claims[name].numbers[key] == pytest.approx(expected, abs=tolerance, rel=0)


def test_the_cubic_fails_just_below_the_rupture_distance_of_the_torus(claims):
    assert 0.99 <= claims["cubic_roots"].numbers["first failure, S/S_crit"] < 1.0


def test_a_failed_claim_says_why(claims):
    for claim in claims.values():
        assert claim.why.endswith("."), claim.name
        assert claim.measured, claim.name


def test_the_samples_agree_on_the_fold_and_tell_the_branches_apart():
    states, fold = sample.all_states(20.0, suction=50.0)
    end = sample.end_of(20.0, suction=50.0)
    assert states.separation[fold] == pytest.approx(end.separation, rel=1e-9)
    stable, unstable = sample.both_branches(np.array([0.5]), 20.0, suction=50.0)
    assert stable.force > unstable.force


def test_pairs_have_a_derjaguin_radius_of_one():
    assert sample.pair_of(10.0, sample.RATIOS).derjaguin_radius == pytest.approx(1.0)


@pytest.mark.parametrize("drawing", FIGURES, ids=lambda drawing: drawing.name)
def test_every_figure_has_the_axes_of_the_article(drawing):
    figure = drawing.draw()
    figure.draw_without_rendering()
    panels = [(axes.get_xlabel(), axes.get_ylabel()) for axes in figure.axes if axes.get_xlabel()]
    assert panels == LABELS.get(drawing.number, [])
    assert drawing.caption.endswith(".")


def test_figures_are_numbered_as_in_the_article():
    assert [drawing.number for drawing in FIGURES] == list(range(1, 13))


def test_the_page_needs_no_other_file(folder):
    page = (folder / "index.html").read_text(encoding="utf-8")
    sources = re.findall(r"""(?:src|href|url)\s*[=(]\s*["']?([^"')>\s]+)""", page)
    assert len(sources) == len(FIGURES)
    assert all(source.startswith("data:image/svg+xml;base64,") for source in sources)
    assert "http://" not in page
    assert "https://" not in page


def test_the_page_and_the_json_tell_every_claim(folder):
    page = (folder / "index.html").read_text(encoding="utf-8")
    rows = json.loads((folder / "claims.json").read_text(encoding="utf-8"))
    assert [row["name"] for row in rows] == list(HOLDS)
    for row in rows:
        assert f'id="{row["name"]}"' in page
        assert all(escape(row[part]) in page for part in ("where", "says", "measured", "why", "better"))
    assert page.count("✓ holds") == sum(row["holds"] for row in rows)
    assert page.count("✗ does not hold") == sum(not row["holds"] for row in rows)


def test_a_report_can_be_made_again_to_the_last_digit(folder):
    assert json_text(measure(DENSITY)) == (folder / "claims.json").read_text(encoding="utf-8")


def test_the_command_writes_it_in_a_copy_of_the_source(run, tmp_path, monkeypatch):
    monkeypatch.setattr("studies.paper.__main__.write_report", partial(write_report, density=0.05))
    status, told, _ = run("paper", "--out", tmp_path)
    assert (status, told) == (0, f"14 files; open {tmp_path / 'index.html'}\n")
    assert len(list(tmp_path.iterdir())) == 14


def test_the_command_of_the_package_alone_says_where_it_stands(run, tmp_path, monkeypatch):
    monkeypatch.setattr(
        data, "__file__", str(tmp_path / "lib" / "site-packages" / "pendular" / "front" / "cli" / "data.py")
    )
    status, _, told = run("paper", "--out", tmp_path)
    assert (status, told.count("\n")) == (2, 1)
    assert "python -m studies.paper" in told
    assert not list(tmp_path.iterdir())
