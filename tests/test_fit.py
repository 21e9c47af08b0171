"""Fits find what made a curve, say how sure they are, and say what a curve does not tell."""

import math

import numpy as np
import pytest

import pendular as pl
from pendular.ask.problem import control_of
from pendular.fitting.model import predict, predict_by_law
from pendular.fitting.question import curve_of, model_of

WATER = pl.Liquid.water()
BEADS = pl.Pair(1e-3, 0.5)
VOLUME = 1e-11
END = float(pl.rupture(BEADS, volume=VOLUME, liquid=WATER).separation)
GAP = np.linspace(0.0, 0.95 * END, 60)
CURVE = pl.bridge(BEADS, GAP, volume=VOLUME, liquid=WATER).force
NOISE = 0.01 * CURVE.max()
NOISY = CURVE + NOISE * np.random.default_rng(20360401).normal(size=GAP.size)


def fitted(separation=GAP, force=NOISY, pair=BEADS, liquid=WATER, **options):
    if not options.keys() & {"suction", "humidity"}:
        options = {"volume": 0.7 * VOLUME, **options}
    return pl.fit(separation, force, pair, liquid=liquid, **options)


# What is free, and its truth.
TRUTHS = {
    "both angles as one": {"contact_angle": 0.5, "volume": VOLUME},
    "one angle": {"contact_angle2": 0.5, "volume": VOLUME},
    "the contact point": {"contact_angle": 0.5, "volume": VOLUME, "offset": 3e-6},
    "radius": {"radius": 1e-3, "volume": VOLUME},
    "one radius": {"radius2": 1e-3, "volume": VOLUME},
    "tension": {"surface_tension": WATER.surface_tension, "volume": VOLUME},
    "cantilever": {"volume": VOLUME, "force_scale": 1.2, "force_zero": 5e-6, "base_slope": -0.02},
}
GUESSES = {"contact_angle": 0.2, "contact_angle2": 0.3, "radius": 0.8e-3, "radius2": 0.8e-3, "surface_tension": 0.05}


def as_guessed(truth):
    """The pair and the liquid with other numbers in the place of those that are sought."""
    radius, angle, tension = 1e-3, 0.5, WATER.surface_tension
    if "radius" in truth:
        radius = GUESSES["radius"]
    if "radius2" in truth:
        radius = (1e-3, GUESSES["radius2"])
    if "contact_angle" in truth:
        angle = GUESSES["contact_angle"]
    if "contact_angle2" in truth:
        angle = (0.5, GUESSES["contact_angle2"])
    if "surface_tension" in truth:
        tension = GUESSES["surface_tension"]
    return pl.Pair(radius, angle), pl.Liquid(tension)


@pytest.mark.parametrize("case", TRUTHS)
def test_the_truth_is_found_from_a_bad_guess(case):
    truth = TRUTHS[case]
    offset = truth.get("offset", 0.0)
    measured = truth.get("force_scale", 1.0) * CURVE + truth.get("force_zero", 0.0)
    measured = measured + truth.get("base_slope", 0.0) * (GAP - offset)
    pair, liquid = as_guessed(truth)
    found = fitted(GAP - offset, measured, pair, liquid, free=tuple(truth))
    assert found.converged
    assert found.values == pytest.approx(truth, rel=1e-5, abs=1e-12)
    assert found.rms < 1e-7 * CURVE.max()


def test_under_suction_and_humidity():
    film = pl.Pair((20e-6, np.inf), (0.3, 0.1))
    end = float(pl.rupture(film, suction=2e5, liquid=WATER).separation)
    gap = np.linspace(0.0, 0.9 * end, 40)
    force = pl.bridge(film, gap, suction=2e5, liquid=WATER).force
    by_suction = pl.fit(gap, force, film, suction=1e5, liquid=WATER, free=("suction", "contact_angle1"))
    assert by_suction.values == pytest.approx({"suction": 2e5, "contact_angle1": 0.3}, rel=1e-5)
    humidity = float(pl.humidity_from_suction(2e5, WATER))
    by_humidity = pl.fit(gap, force, film, humidity=0.9993, liquid=WATER, free=("humidity",))
    assert by_humidity.values["humidity"] == pytest.approx(humidity, rel=1e-8)
    assert by_humidity.held == {"humidity": by_humidity.values["humidity"]}


def test_a_bridge_that_evaporates():
    time = np.linspace(0.0, 30.0, GAP.size)
    rate = 1e-13
    force = pl.bridge(BEADS, 0.7 * GAP, volume=VOLUME - rate * time, liquid=WATER).force
    found = fitted(0.7 * GAP, force, free=("volume", "evaporation_rate"), time=time)
    assert found.values == pytest.approx({"volume": VOLUME, "evaporation_rate": rate}, rel=1e-5)


def test_errors_that_reach_beyond_the_domain_are_those_of_the_rates():
    """One standard error away lies a sphere so small that no bridge of that volume is known."""
    gap = np.array([10.8, 22.9, 34.9, 48.1, 60.2, 72.2]) * 1e-9
    force = np.array([354.0, 181.0, 105.0, 66.4, 47.5, 36.2]) * 1e-9
    pair = pl.Pair((2.83e-6, 1.11e-6), 1.02)
    found = fitted(gap, force, pair, volume=7.6e-22, free=("radius2", "volume"), rupture=1.19e-7)
    assert found.converged
    assert min(found.errors.values()) > 0.0


def test_overlap_and_a_large_drop_below_its_lower_end_is_no_obstacle():
    gap = np.linspace(-0.02e-3, 0.5 * END, 40)
    force = pl.bridge(BEADS, gap, volume=VOLUME, liquid=WATER).force
    assert fitted(gap, force, free=("volume",)).values["volume"] == pytest.approx(VOLUME, rel=1e-6)


def slopes_of(predicting, model, data, variables):
    """Rates of the force by central differences, and those that the model tells."""
    step = 1e-5
    told = predicting(model, data, variables, with_rates=True).rates
    columns = []
    for i in range(len(variables)):
        way = step * np.eye(len(variables))[i]
        ahead, behind = (predicting(model, data, variables + s * way, with_rates=False).force for s in (1, -1))
        columns.append((ahead - behind) / (2 * step))
    return np.column_stack(columns), told


@pytest.mark.parametrize("method", ["exact", "willett2000"])
@pytest.mark.parametrize("held", ["volume", "suction", "humidity"])
def test_rates_of_the_model_are_its_slopes(method, held):
    pair = pl.Pair((30e-6, 20e-6), (0.4, 0.4))
    state = pl.bridge(pair, 1e-6, volume=1e-15, liquid=WATER)
    value = {"volume": 1e-15, "suction": float(state.suction)}
    value["humidity"] = float(pl.humidity_from_suction(value["suction"], WATER))
    gap = np.linspace(0.1e-6, 2e-6, 15)
    force = pl.bridge(pair, gap, volume=1e-15, liquid=WATER).force
    data = curve_of(gap, force, np.linspace(0.0, 1.0, 15), None, None, True)
    control = control_of(*(value[name] if name == held else None for name in ("suction", "volume", "humidity")), WATER)
    free = ["contact_angle", held, "surface_tension", "radius1", "radius2", "offset", "force_zero", "force_scale"]
    free += ["base_slope", *(["evaporation_rate"] if held == "volume" else [])]
    model = model_of(pair, control, WATER, free, None, None, method, data, held)
    predicting = predict if method == "exact" else predict_by_law
    slopes, told = slopes_of(predicting, model, data, model.start)
    scale = np.abs(slopes).max(axis=0)
    assert np.all(np.abs(told - slopes).max(axis=0) < 1e-5 * scale), free


def test_errors_shrink_with_the_noise_and_cover_the_truth():
    offset = 2e-6
    found = fitted(GAP - offset)
    truth = {"contact_angle": 0.5, "volume": VOLUME, "offset": offset}
    for name, value in truth.items():
        assert abs(found.values[name] - value) < 4.0 * found.errors[name]
    quiet = fitted(GAP - offset, CURVE + 0.1 * (NOISY - CURVE))
    for name in truth:
        assert quiet.errors[name] == pytest.approx(0.1 * found.errors[name], rel=0.2)
    assert found.force_error[0] == pytest.approx(NOISE, rel=0.25)
    known = fitted(GAP - offset, force_error=NOISE)
    assert known.chi_square == pytest.approx(found.chi_square * (found.force_error[0] / NOISE) ** 2, rel=1e-3)
    assert np.allclose(np.sqrt(np.diag(found.covariance)), list(found.errors.values()))


def test_weights_give_way_to_bad_points():
    bad = NOISY.copy()
    bad[::7] *= 1.5
    weights = np.ones(GAP.size)
    weights[::7] = 1e-8
    trusted = fitted(GAP, bad, weights=weights, free=("contact_angle", "volume"))
    without = fitted(np.delete(GAP, slice(None, None, 7)), np.delete(NOISY, slice(None, None, 7)), free=trusted.free)
    assert trusted.values == pytest.approx(without.values, rel=1e-4)


@pytest.mark.parametrize("loss", ["soft_l1", "huber", "cauchy"])
def test_a_robust_loss_does_not_follow_outliers(loss):
    bad = NOISY.copy()
    bad[30::5] += 0.2 * CURVE.max()
    robust = fitted(GAP, bad, loss=loss, free=("contact_angle", "volume"))
    squares = fitted(GAP, bad, free=("contact_angle", "volume"))
    assert abs(robust.values["contact_angle"] - 0.5) < 0.3 * abs(squares.values["contact_angle"] - 0.5)
    assert abs(robust.values["contact_angle"] - 0.5) < 4.0 * robust.errors["contact_angle"]


def test_rupture_is_a_datum():
    without = fitted(GAP[:30], NOISY[:30])
    near = fitted(GAP[:30], NOISY[:30], rupture=(END, 0.01 * END))
    assert near.measured_rupture == (END, 0.01 * END)
    assert near.errors["contact_angle"] < 0.7 * without.errors["contact_angle"]
    assert near.rupture_separation == pytest.approx(END, rel=0.03)
    assert near.degrees_of_freedom == without.degrees_of_freedom + 1


def test_a_jump_is_found_and_what_follows_is_base_line():
    step = GAP[1] - GAP[0]
    gap = np.append(GAP, END + step * np.arange(1, 15))
    noise = 0.3 * NOISE * np.random.default_rng(3).normal(size=gap.size)
    force = np.append(CURVE, np.zeros(14)) + noise + 4e-6
    found = fitted(gap, force, rupture="jump", free=("contact_angle", "volume", "force_zero"))
    assert GAP[-1] < found.measured_rupture[0] < END + step
    assert abs(found.values["force_zero"] - 4e-6) < 4.0 * found.errors["force_zero"]
    assert found.fitted[-1] == pytest.approx(found.values["force_zero"], rel=1e-9)
    with pytest.raises(ValueError, match="rupture: no clear jump"):
        fitted(rupture="jump")
    ended = fitted(rupture="end")
    assert ended.measured_rupture[0] == pytest.approx(GAP[-1] + 0.5 * step)


def test_condensation_on_approach_is_a_datum():
    tip = pl.Pair((1e-6, np.inf), (0.4, 0.4))
    suction = 5e6
    end = float(pl.rupture(tip, suction=suction, liquid=WATER).separation)
    low, high = 0.0, end
    for _ in range(60):  # the separation at which the bridge costs nothing, halved down to
        middle = 0.5 * (low + high)
        potential = pl.bridge(tip, middle, suction=suction, liquid=WATER).grand_potential
        low, high = (middle, high) if potential < 0.0 else (low, middle)
    assert 0.1 * end < low < end
    gap = np.linspace(0.0, 0.3 * end, 25)
    force = pl.bridge(tip, gap, suction=suction, liquid=WATER).force
    noisy = force + 0.01 * force.max() * np.random.default_rng(2).normal(size=gap.size)
    asked = {"suction": 4e6, "liquid": WATER, "free": ("contact_angle", "suction")}
    exact = pl.fit(gap, force, tip, jump_in=(low, 0.01 * end), **asked)
    assert exact.values == pytest.approx({"contact_angle": 0.4, "suction": suction}, rel=1e-9)
    without = pl.fit(gap, noisy, tip, **asked)
    found = pl.fit(gap, noisy, tip, jump_in=(low, 0.01 * end), **asked)
    assert found.errors["suction"] < 0.8 * without.errors["suction"]
    assert abs(found.values["suction"] - suction) < 4.0 * found.errors["suction"]
    with pytest.raises(ValueError, match="jump_in: is a datum of exact bridges"):
        fitted(jump_in=1e-6)


def test_an_angle_of_nothing_has_one_bound():
    wet = pl.Pair(1e-3, 0.0)
    gap = 0.8 * GAP
    force = pl.bridge(wet, gap, volume=VOLUME, liquid=WATER).force
    noisy = force + NOISE * np.random.default_rng(11).normal(size=GAP.size)
    found = pl.fit(gap, noisy, wet, volume=VOLUME, liquid=WATER, free=("contact_angle", "volume"))
    assert 0.0 < found.errors["contact_angle"] < found.upper["contact_angle"] < 0.6
    (note,) = [line for line in found.notes if line.startswith("contact_angle: 0 is within its error")]
    assert f"{math.degrees(found.upper['contact_angle']):.3g}°" in note
    assert np.all(np.isfinite(found.covariance))


def test_what_the_data_do_not_tell_apart_is_named():
    found = fitted(free=("surface_tension", "force_scale", "volume"))
    assert found.errors["surface_tension"] == found.errors["force_scale"] == math.inf
    assert found.errors["volume"] < 0.1 * VOLUME
    assert any(
        line.startswith("surface_tension and force_scale: the data do not tell them apart")
        or line.startswith("force_scale and surface_tension: the data do not tell them apart")
        for line in found.notes
    )
    short = fitted(GAP[:12], NOISY[:12], free=("contact_angle", "volume", "offset"))
    assert any("hardly tell them apart" in line for line in short.notes)
    pulled = pl.fit(GAP, NOISY, BEADS, volume=VOLUME, liquid=WATER, free=("volume", "evaporation_rate"), time=0.0 * GAP)
    assert "evaporation_rate: has no effect on these data" in pulled.notes


@pytest.mark.parametrize("zero", [0.7e-3, -3e-3])
def test_the_zero_of_the_stage_may_be_anywhere(zero):
    found = fitted(GAP + zero, CURVE, pair=pl.Pair(1e-3, 0.3))
    assert found.values == pytest.approx({"contact_angle": 0.5, "volume": VOLUME, "offset": -zero}, rel=1e-4)
    law = fitted(GAP + zero, CURVE, pair=pl.Pair(1e-3, 0.3), method="willett2000")
    assert law.values["offset"] == pytest.approx(-zero, abs=0.05 * END)


def test_a_curve_that_says_nothing_has_large_errors():
    noise = 1e-6 * np.random.default_rng(8).normal(size=GAP.size)
    with pytest.warns(pl.FitWarning, match="holds no bridge at"):
        found = pl.fit(GAP + 1.0, noise, BEADS, suction=50.0, liquid=WATER, free=("suction", "contact_angle1"))
    assert all(math.isfinite(value) for value in found.values.values())
    assert not any(error < 0.1 for error in found.errors.values())
    assert any("no bridge at" in note for note in found.notes)


def test_bounds_hold_and_are_told():
    found = fitted(free=("contact_angle", "volume"), bounds={"volume": (0.5 * VOLUME, 0.9 * VOLUME)})
    assert found.values["volume"] <= 0.9 * VOLUME
    assert any(line.startswith("volume: at its upper bound") for line in found.notes)


def test_a_law_puts_its_own_error_into_the_angle():
    wide = np.linspace(0.0, 0.8 * END, 50)
    force = pl.bridge(BEADS, wide, volume=VOLUME, liquid=WATER).force
    exact = pl.fit(wide, force, BEADS, volume=VOLUME, liquid=WATER, free=("contact_angle", "volume"))
    law = pl.fit(
        wide, force, BEADS, volume=VOLUME, liquid=WATER, free=("contact_angle", "volume"), method="willett2000"
    )
    assert exact.values["contact_angle"] == pytest.approx(0.5, abs=1e-6)
    assert 0.002 < abs(law.values["contact_angle"] - 0.5) < 0.2
    assert law.rupture_separation == pytest.approx(END, rel=0.1)
    assert law.predicted(wide) == pytest.approx(law.fitted)
    silent = pl.fit(wide, force, BEADS, volume=VOLUME, liquid=WATER, free=exact.free, method="lambert2008")
    assert math.isnan(silent.rupture_separation)


def test_which_control_made_a_curve():
    gap = GAP[:40]
    start = pl.bridge(BEADS, gap[20], volume=VOLUME, liquid=WATER)
    slow = pl.bridge(BEADS, gap, suction=start.suction, liquid=WATER)
    apart = gap[slow.exists]
    force = slow.force[slow.exists] + NOISE * np.random.default_rng(5).normal(size=apart.size)
    found = pl.fit_controls(apart, force, BEADS, volume=VOLUME, liquid=WATER, free=("volume", "contact_angle"))
    assert found.better == "suction"
    assert "constant suction fits better" in found.told
    assert pl.fit_controls(gap, NOISY[:40], BEADS, suction=start.suction, liquid=WATER).better == "volume"
    few = pl.fit_controls(gap[:8], NOISY[:8], BEADS, volume=VOLUME, liquid=WATER, free=("volume",))
    assert few.better == "neither"
    assert "does not tell" in few.told


def test_the_answer_can_be_asked_on():
    gap = GAP[:50] - 2e-6
    found = fitted(gap, NOISY[:50])
    again = pl.bridge(found.pair, gap + found.values["offset"], **found.held, liquid=found.liquid)
    assert again.force == pytest.approx(found.fitted)
    assert found.predicted(gap) == pytest.approx(found.fitted)
    assert found.free == ("contact_angle", "volume", "offset")
    assert found.residuals == pytest.approx(NOISY[:50] - found.fitted)


def test_the_picture_shows_curve_residuals_and_numbers(tmp_path):
    picture = fitted(rupture="end").plot()
    texts = {text.get_text() for text in picture.texts}
    assert {"contact angle", "volume", "offset"} <= texts
    assert [axes.get_ylabel() for axes in picture.axes] == ["force (µN)", "residual / error"]
    labels = {text.get_text() for text in picture.axes[0].get_legend().get_texts()}
    assert labels == {"measured", "fitted", "its rupture", "rupture as measured"}
    picture.savefig(tmp_path / "fit.svg")


BAD = {
    "force: 59 values": {"force": NOISY[1:]},
    "separation: an array of shape": {"separation": 0.0},
    "separation: all values": {"separation": 0.0 * GAP},
    "force: all values": {"force": 0.0 * GAP},
    "free: 'angle' is not one of": {"free": ("angle",)},
    "free: 'volume' is given twice": {"free": ("volume", "volume")},
    "free: 'suction' is not what is held": {"free": ("suction",)},
    "free: 'volume' is not a sequence": {"free": "volume"},
    "free: 'contact_angle' stands for": {"free": ("contact_angle", "contact_angle1")},
    "free: 'contact_angle' is 0.1 and 0.2": {"pair": pl.Pair(1e-3, (0.1, 0.2))},
    "free: 'radius2' is that of a plane": {"pair": pl.Pair((1e-3, np.inf)), "free": ("radius2",)},
    "free: 3 numbers need more": {"separation": GAP[:2], "force": NOISY[:2]},
    "time: needed": {"free": ("evaporation_rate",)},
    "weights: given together": {"weights": 1.0, "force_error": 1e-6},
    "force_error: 0.0 N is not > 0": {"force_error": 0.0},
    "rupture: 'break' is not one of": {"rupture": "break"},
    "rupture: -1 m lies before": {"rupture": -1.0},
    "rupture: a tuple of 3": {"rupture": (1.0, 1.0, 1.0)},
    r"bounds: 'offset' is not one of": {"free": ("volume",), "bounds": {"offset": (0.0, 1.0)}},
    r"bounds\[volume\]: 3 is not a pair": {"bounds": {"volume": 3}},
    r"start: 'volume' is not one of": {"start": {"volume": 1.0}},
    "method: 'toro' is neither": {"method": "toro"},
    "rupture: is no datum for the law": {"method": "lambert2008", "rupture": "end"},
    "loss: 'mean' is not one of": {"loss": "mean"},
    "starts: 0.0 is not >= 1": {"starts": 0},
    "pair: an array of radii": {"pair": pl.Pair([1e-3, 2e-3], 0.3)},
    "volume: .* is not in": {"bounds": {"volume": (2e-11, 3e-11)}},
}


@pytest.mark.parametrize("message", BAD)
def test_bad_input_is_refused_in_one_line(message):
    with pytest.raises(ValueError, match=rf"\A{message}[^\n]*\Z"):
        fitted(**BAD[message])


def test_without_scipy_one_line_says_what_to_install(monkeypatch):
    monkeypatch.setattr("pendular.fitting.fitting.find_spec", lambda name: None)
    with pytest.raises(ValueError, match=r"scipy is not installed; pip install 'pendular\[fit\]'"):
        fitted()


@pytest.mark.long
def test_errors_cover_the_truth_as_often_as_they_say():
    seed, count = 20360402, 300
    random = np.random.default_rng(seed)
    deviations = {"contact_angle": [], "volume": [], "offset": []}
    for _ in range(count):
        radius, ratio = 10.0 ** random.uniform(-6, -3), random.choice([1.0, 2.0, np.inf])
        angle = np.radians(random.uniform(0.0, 80.0))
        pair = pl.Pair((radius, ratio * radius), angle)
        volume = 10.0 ** random.uniform(-5, -1) * pair.derjaguin_radius**3
        end = float(pl.rupture(pair, volume=volume, liquid=WATER).separation)
        low = pl.rupture(pair, volume=volume, liquid=WATER, end="lower")
        begin = float(low.separation) if low.exists else 0.0
        gap = np.linspace(0.02, random.uniform(0.5, 0.99), random.integers(30, 120)) * (end - begin) + begin
        force = pl.bridge(pair, gap, volume=volume, liquid=WATER).force
        noise = random.uniform(0.002, 0.03) * force.max()
        offset = random.uniform(-0.02, 0.02) * gap[-1]
        measured = force + random.normal(0.0, noise, gap.size)
        guess = volume * np.exp(random.uniform(-0.7, 0.7))
        found = pl.fit(gap - offset, measured, pl.Pair(pair.radius, 0.5), volume=guess, liquid=WATER)
        for name, truth in (("contact_angle", angle), ("volume", volume), ("offset", offset)):
            if name in found.upper:  # one side: the two bounds stand for one and two standard errors
                sides = (found.values[name] + found.errors[name], found.upper[name])
                deviations[name].append(0.5 + sum(truth > side for side in sides))
            else:
                deviations[name].append(abs(found.values[name] - truth) / found.errors[name])
    for name, several in deviations.items():
        within = [float(np.mean(np.array(several) < errors)) for errors in (1.0, 2.0)]
        print(f"seed {seed}, {count} curves: {name} within its error {within[0]:.3f}, within two {within[1]:.3f}")
        assert 0.60 < within[0] < 0.76, name  # 0.683, and three of its own errors
        assert within[1] > 0.90, name
