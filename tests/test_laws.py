"""The published laws, generated over the registry: records, transcription, domain, limits and arrays."""

import importlib
import inspect
import math
import re
from pathlib import Path

import numpy as np
import pytest

import pendular
from law_samples import EQUAL, assert_close, by_name, kappas, reach, sample
from oracles.laws_mpmath import ORACLES
from pendular.ground import rows as rows_of_entries
from pendular.laws import arrays, laws, zhao2020

LAWS = list(laws.values())
FORCE = [law for law in LAWS if "force" in law.gives]
RUPTURE = [law for law in LAWS if "rupture" in law.gives]
WORK = [law for law in LAWS if "rupture_work" in law.gives]
DAMPING = [law for law in LAWS if "damping" in law.gives]
ENDS = [law for law in FORCE if "rupture" in law.gives]
ENDLESS = [law for law in FORCE if "rupture" not in law.gives]


def middle(law):
    """Control in the middle of the range of a law."""
    return sorted(pair[0] for pair in sample(law, 9))[4]


def kernels(law):
    """Kernels of a law with arguments for which it has an answer."""
    pair = [middle(law), 0.0, 0.0, *EQUAL]
    given = ((law.force_star, [0.0, *pair]), (law.rupture_star, pair), (law.rupture_work_star, pair))
    given += ((law.damping_star, [0.01, *pair]),)
    return [(kernel, arguments) for kernel, arguments in given if kernel]


def quantity_of(law, kernel):
    """Quantity that a kernel of a law gives."""
    return next(quantity for quantity in law.gives if getattr(law, f"{quantity}_star") is kernel)


# --- the registry -----------------------------------------------------------------------------------------------------


def test_published_names_never_change():
    published = {"zhao2020", "toroidal2020", "asymptotic", "asymptotic_rupture", "pendular2026"}
    published |= {"willett2000", "willett2000_simple", "lian1993", "mikami1998", "soulie2006", "rabinovich2005"}
    published |= {"lambert2008", "weigert1999", "lian_seville2016", "bagheri2024", "contact_limit"}
    published |= {"deboer2008", "deboer2008_volume", "pitois2000"}
    assert published <= set(laws)


def test_package_is_the_registry():
    assert pendular.laws["zhao2020"] is zhao2020.LAW
    assert dict(pendular.laws) == laws
    assert len(pendular.laws) == len(LAWS)
    with pytest.raises(KeyError, match=r"law: 'zhao' is not one of asymptotic, asymptotic_rupture, "):
        pendular.laws["zhao"]


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_law_has_its_own_file(law):
    assert importlib.import_module(f"pendular.laws.{law.name}").LAW is law


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_law_has_an_oracle(law):
    assert law.gives == tuple(quantity for quantity, f in ORACLES[law.name]._asdict().items() if f)


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_record_is_complete(law):
    texts = (law.title, law.valid_text, law.angle_rule, law.size_rule, law.reference, law.formula, law.provenance)
    assert all(texts)
    assert law.gives == tuple(law.solids)
    assert f"{law.control}_star" in law.valid
    assert max(map(len, law.formula.splitlines())) <= 120


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_numbers_of_the_formula_are_those_of_the_oracle(law):
    sources = Path(__file__).with_name("oracles").glob("*laws_mpmath.py")
    known = re.findall(r"\d+\.\d+", "".join(path.read_text() for path in sources))
    assert set(re.findall(r"\d+\.\d+", law.formula)) <= set(known)


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_range_lies_within_hard_limits(law):
    limits = {variable.name: variable for variable in law.variables}
    for name, (low, high) in law.valid.items():
        assert limits[name].low <= low <= high <= limits[name].high


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_kernels_have_the_common_signature(law):
    common = ["separation_star", f"{law.control}_star", "contact_angle1", "contact_angle2", "kappa1", "kappa2"]
    for kernel, names in (
        (law.force_star, common),
        (law.rupture_star, common[1:]),
        (law.rupture_work_star, common[1:]),
        (law.damping_star, common),
    ):
        assert kernel is None or list(inspect.signature(kernel).parameters) == names


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_help_of_every_function_has_all_that_the_record_knows(law):
    for function in (*law.kernels.values(), *law.steps):
        told = inspect.getdoc(function)
        for name in inspect.signature(function).parameters:
            assert re.search(rf"^(\w+, )?{name}(, \w+)? : (float|tuple of float)\n    [A-Z].*\[", told, re.MULTILINE)
        sections = re.findall(r"^(\w+)\n-+$", told, re.MULTILINE)
        assert sections == ["Parameters", "Returns", "Notes", "References", "Examples"]
        owner = laws[function.__module__.rpartition(".")[2]]  # another law, where its function serves here as well
        one_line = re.sub(r"\s+", " ", told)
        assert owner.valid_text[1:] in one_line
        assert owner.reference[1:] in one_line
        assert owner.doi in told.replace("\n", "")


# --- transcription ----------------------------------------------------------------------------------------------------


# Worst measured in all: 1e-15 for rupture distance and work, 5e-15 for the force.
@pytest.mark.parametrize("law", RUPTURE, ids=by_name)
def test_rupture_equals_oracle(law):
    for pair in sample(law, 24):
        assert_close(law.rupture_star(*pair), ORACLES[law.name].rupture(*pair), 5e-15)


@pytest.mark.parametrize("law", WORK, ids=by_name)
def test_rupture_work_equals_oracle(law):
    for pair in sample(law, 24):
        assert_close(law.rupture_work_star(*pair), ORACLES[law.name].rupture_work(*pair), 5e-15)


@pytest.mark.parametrize("law", FORCE, ids=by_name)
def test_force_equals_oracle(law):
    for pair in sample(law, 16):
        for fraction in (0.0, 0.4, 0.85, 1.001):
            separation = fraction * reach(law, pair)
            assert_close(law.force_star(separation, *pair), ORACLES[law.name].force(separation, *pair), 5e-14)


@pytest.mark.parametrize("law", DAMPING, ids=by_name)
def test_damping_equals_oracle(law):
    for pair in sample(law, 24):
        for separation in np.geomspace(1e-6, 10.0, 12).tolist():
            assert_close(law.damping_star(separation, *pair), ORACLES[law.name].damping(separation, *pair), 5e-15)


# --- domain and limits ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_equal_spheres_of_zero_angle_are_answered(law):
    for control, *_ in sample(law, 16):
        answers = [kernel(*arguments[:-5], control, *arguments[-4:]) for kernel, arguments in kernels(law)]
        assert min(answers) > 0.0
        assert max(answers) < (math.inf if law in DAMPING else 2.0)


@pytest.mark.parametrize("law", ENDS, ids=by_name)
def test_no_force_beyond_rupture(law):
    for pair in sample(law, 16):
        beyond = [law.force_star(factor * law.rupture_star(*pair), *pair) for factor in (1.0 + 1e-9, 1e6)]
        assert beyond == [0.0, 0.0] or all(map(math.isnan, beyond))


@pytest.mark.parametrize("law", ENDLESS, ids=by_name)
def test_law_without_rupture_distance_never_says_zero(law):
    for pair in sample(law, 16):
        forces = [law.force_star(factor * reach(law, pair), *pair) for factor in (1.0, 10.0, 1e6)]
        assert all(force > 0.0 or math.isnan(force) for force in forces)


@pytest.mark.parametrize("law", FORCE, ids=by_name)
def test_force_attracts_and_falls_with_the_gap(law):
    for pair in sample(law, 16):
        fractions = np.linspace(0.0, 0.85, 18) * reach(law, pair)
        force = np.array([law.force_star(separation, *pair) for separation in fractions.tolist()])
        force = force[~np.isnan(force)]
        assert (force > 0.0).all()
        assert (np.diff(force) < 0.0).all()


@pytest.mark.parametrize("law", FORCE, ids=by_name)
def test_contact_is_the_limit_of_small_gaps(law):
    for pair in sample(law, 16):
        contact, near = (law.force_star(separation * reach(law, pair), *pair) for separation in (0.0, 1e-12))
        assert (
            math.isnan(near) if law.name == "contact_limit" else near == pytest.approx(contact, rel=1e-6, nan_ok=True)
        )


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_nan_in_nan_out(law):
    for kernel, arguments in kernels(law):
        assert math.isfinite(kernel(*arguments))
        for i in range(len(arguments) - 2):
            assert math.isnan(kernel(*arguments[:i], math.nan, *arguments[i + 1 :]))


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_nan_outside_hard_limits(law):
    limits = {variable.name: variable for variable in law.variables}
    control, angle = limits[f"{law.control}_star"], limits["contact_angle"]
    outside = [(control.low - 1.0, 0.0), (middle(law), angle.low - 0.1), (middle(law), angle.high)]
    outside += [(0.0, 0.0)] if law.control == "volume" else []
    for kernel, arguments in kernels(law):
        for value, theta in outside:
            assert math.isnan(kernel(*arguments[:-5], value, theta, theta, *EQUAL))
        if kernel is law.force_star and limits["separation_star"].low == 0.0:
            assert math.isnan(kernel(-1e-9, *arguments[1:]))


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_unequal_angles_follow_the_stated_rule(law):
    means = {"mean angle": 0.25, "mean cosine": math.acos(0.5 * (math.cos(0.2) + math.cos(0.3)))}
    for kernel, (*first, _, _, kappa1, kappa2) in kernels(law):
        rule = law.solids[quantity_of(law, kernel)].angles
        assert math.isnan(kernel(*first, 0.2, 0.3, kappa1, kappa2)) == (rule in ("equal", "zero"))
        assert math.isnan(kernel(*first, 0.2, 0.2, kappa1, kappa2)) == (rule == "zero")
        if rule in means:
            mean = means[rule]
            assert_close(kernel(*first, 0.2, 0.3, *EQUAL), kernel(*first, mean, mean, *EQUAL), 1e-14)


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_unequal_sizes_follow_the_stated_rule(law):
    for kernel, (*first, _, _) in kernels(law):
        rule, equal = law.solids[quantity_of(law, kernel)], kernel(*first, *EQUAL)
        assert math.isnan(kernel(*first, *kappas(math.inf))) == (rule.plane == "none")
        for stated, size_ratio in ((rule.spheres, 3.0), (rule.plane, math.inf)):
            if stated == "mean":
                assert_close(kernel(*first, *kappas(size_ratio)), equal, 1e-14)


@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_exchange_of_the_solids_changes_nothing(law):
    for control, angle1, angle2, kappa1, kappa2 in sample(law, 16):
        here, there = (control, angle1, angle2, kappa1, kappa2), (control, angle2, angle1, kappa2, kappa1)
        for kernel in filter(None, (law.rupture_star, law.rupture_work_star)):
            assert_close(kernel(*there), kernel(*here), 1e-15)
        if law.force_star:
            for gap in (0.0, 0.5 * reach(law, here)):
                assert_close(law.force_star(gap, *there), law.force_star(gap, *here), 1e-13)


# --- arrays -----------------------------------------------------------------------------------------------------------


@pytest.fixture(params=["few", "many"])
def rows(request, monkeypatch):
    """Ask laws row by row in plain Python, or by machine code."""
    for cost in ("_LOADING", "_PATIENCE"):
        monkeypatch.setattr(rows_of_entries, cost, math.inf if request.param == "few" else -1.0)


# One by one rows are asked in plain Python, whose powers differ in the last digit: 1e-14, worst measured 2e-15.
@pytest.mark.parametrize("law", LAWS, ids=by_name)
def test_arrays_equal_kernels(law, rows):
    pairs = np.array(sample(law, 12))
    for quantity, kernel in law.kernels.items():
        on_arrays, gaps = getattr(arrays, f"{quantity}_star"), [[0.0], [1e-9], [1.0]]
        if quantity not in ("force", "damping"):
            computed = on_arrays(law.name, *pairs.T)
            expected = [kernel(*pair) for pair in pairs.tolist()]
        else:
            computed = on_arrays(law.name, gaps, *pairs.T)
            expected = [[kernel(*gap, *pair) for pair in pairs.tolist()] for gap in gaps]
        np.testing.assert_allclose(computed, expected, rtol=1e-14, atol=0.0)
        assert computed.shape == np.shape(expected)


def test_threads_change_nothing(monkeypatch):
    monkeypatch.setattr(rows_of_entries, "_LOADING", -1.0)
    monkeypatch.setattr(rows_of_entries, "_PATIENCE", -1.0)
    suction = np.geomspace(10.0, 1e6, 200_000)  # several chunks
    at_once = arrays.rupture_star("zhao2020", suction, 0.3, 0.3, 1, 1)
    piecewise = [arrays.rupture_star("zhao2020", part, 0.3, 0.3, 1, 1) for part in np.split(suction, 100)]
    np.testing.assert_array_equal(at_once, np.concatenate(piecewise))


def test_numbers_give_a_number():
    assert np.ndim(arrays.force_star("zhao2020", 0.0, 100.0, 0.0, 0.0, 1.0, 1.0)) == 0


@pytest.mark.parametrize("shape", [(0,), (3, 0)])
def test_empty_arrays(shape):
    assert arrays.rupture_star("zhao2020", np.empty(shape), 0.0, 0.0, 1.0, 1.0).shape == shape


def test_law_that_does_not_give_the_quantity_is_refused():
    with pytest.raises(ValueError, match="'asymptotic_rupture', the laws that give the force are asymptotic, "):
        arrays.force_star("asymptotic_rupture", 0.0, 100.0, 0.0, 0.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="'zhao2020', the laws that give the rupture work are deboer2008, "):
        arrays.rupture_work_star("zhao2020", 100.0, 0.0, 0.0, 1.0, 1.0)
