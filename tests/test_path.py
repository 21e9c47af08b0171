"""Paths: contact lines that stay on their circle until an angle is reached, and then slide."""

import math
import re

import numpy as np
import pytest

import pendular as pl
from oracles.contact_lines import advanced, misses
from pendular.exact.batch import FOUND, STABLE, answer
from pendular.exact.carrying import ARRIVED, LOST
from pendular.exact.equations import SUCTION, VOLUME
from pendular.exact.path import walk_paths
from pendular.exact.state import State

UNIT = pl.Liquid(surface_tension=1.0)
WATER = pl.Liquid(surface_tension=0.0728)
GRAINS = pl.Pair(50e-6, math.radians(60.0))
HYSTERESIS = {
    "contact_line": "hysteresis",
    "advancing_angle": math.radians(60.0),
    "receding_angle": math.radians(30.0),
    "liquid": WATER,
}
LOOP = np.concatenate([np.linspace(5e-6, 1e-6, 41), np.linspace(1e-6, 5e-6, 42)[1:]])
KINDS = ("spheres", "plate", "plates")
MODES = {"pinned": 0, "advancing": 1, "receding": -1}


def refused(message):
    """Expect a ValueError of exactly this one line."""
    return pytest.raises(ValueError, match=f"^{re.escape(message)}$")


def random_path(rng, kind, control, steps):
    """A path of loads that grow and fall by about a quarter, one that does not end; with its angles."""
    while True:
        radii = {"spheres": (1.0, rng.uniform(0.3, 3.0)), "plate": (1.0, math.inf), "plates": (math.inf, math.inf)}[
            kind
        ]
        angles = np.sort(rng.uniform(0.15, 1.4, (2, 3)), axis=1)
        held = 1.0 if kind == "plates" else 10.0 ** rng.uniform(-3.0, -1.0)
        gap = held ** (1.0 / 3.0) * rng.uniform(0.1, 0.5)
        if control == "suction":
            held = 10.0 ** rng.uniform(-0.5, 1.0)
            gap = rng.uniform(0.05, 0.4) / (held + 2.0)
        shares = np.exp(np.cumsum(rng.normal(0.0, 0.25, (2, steps)), axis=1))
        shares /= shares[:, :1]
        if rng.random() < 0.5:
            shares[rng.integers(2)] = 1.0
        pair = pl.Pair(radii, (angles[0, 1], angles[1, 1]))
        given = {"advancing_angle": tuple(angles[:, 2]), "receding_angle": tuple(angles[:, 0])}
        question = {"contact_line": "hysteresis", "liquid": UNIT, **given, control: held * shares[1]}
        try:
            found = pl.path(pair, gap * shares[0], **question)
        except ValueError:  # no bridge to start from
            continue
        if not found.ending:
            return pair, angles, gap * shares[0], held * shares[1], found


def places(pair, found):
    """A path as the oracle knows it: reach of both rings, both angles, H and the length of the meridian."""
    k = 1.0 / np.array([float(radius) for radius in pair.radii])
    reach = np.where(k > 0.0, found.half_filling_angle / np.where(k > 0.0, k, 1.0), found.contact_radius)
    length = 2.0 * found._meridian[:, 2:]
    return np.concatenate([reach, found.contact_angle, found.suction[:, None], length], axis=1)


def made_paths(seed, control, count, steps):
    """Paths of all kinds of pairs, and the solids as the oracle knows them."""
    rng = np.random.default_rng(seed)
    made = [random_path(rng, kind, control, steps) for kind in KINDS for _ in range(count)]
    k = np.array([[1.0 / float(radius) for radius in pair.radii] for pair, *_ in made])
    angles = np.array([one[1] for one in made])
    solids = np.stack([k[:, 0], angles[:, 0, 2], angles[:, 0, 0], k[:, 1], angles[:, 1, 2], angles[:, 1, 0]], axis=1)
    return made, solids


# -- against the Young-Laplace equation ----------------------------------------------------------------------------


@pytest.mark.parametrize("control", ["volume", "suction"])
def test_every_bridge_obeys_the_equation_between_its_rings(control):
    """Integrated from ring to ring: the worst miss measured over 66 paths of five steps is 2e-11."""
    made, solids = made_paths(3, control, 11, 5)
    for (pair, _angles, gap, held, found), solid in zip(made, solids, strict=True):
        rows = np.repeat(solid[None], len(gap), axis=0)
        assert np.abs(misses(rows, places(pair, found), gap, held, control, steps=800)).max() < 1e-9
        np.testing.assert_allclose(found.separation, gap, rtol=1e-11)
        np.testing.assert_allclose(getattr(found, control), held, rtol=1e-11)


@pytest.mark.long
@pytest.mark.parametrize("control", ["volume", "suction"])
def test_a_path_is_that_of_many_small_steps(control):
    """66 paths; a line that turns within a small step is off by as much as the step is long, all others by rounding."""
    made, solids = made_paths(3, control, 11, 4)
    gap, held = (np.array([one[i] for one in made]) for i in (2, 3))
    wanted = np.array([places(one[0], one[4]) for one in made])
    place, parts = wanted[:, 0].copy(), 24
    for step in range(1, gap.shape[1]):
        for share in np.arange(1, parts + 1) / parts:
            now = [past[:, step - 1] * (1.0 - share) + past[:, step] * share for past in (gap, held)]
            place, modes = advanced(solids, place, *now, control)
        told = np.array([[MODES[word] for word in one[4].line[step].tolist()] for one in made])
        np.testing.assert_array_equal(told, modes)
        off = np.abs(place / wanted[:, step] - 1.0).max(axis=1)
        assert np.quantile(off, 0.9) < 1e-8, np.sort(off)[-8:]
        assert off.max() < 2e-3, np.sort(off)[-8:]


# -- limits that are known -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("control", [{"volume": 1e-15}, {"suction": 5e3}])
@pytest.mark.parametrize("radii", [50e-6, (50e-6, 20e-6), (50e-6, math.inf)])
def test_without_hysteresis_it_is_the_curve(control, radii):
    pair = pl.Pair(radii, (0.7, 0.2))
    end = pl.rupture(pair, **control, liquid=WATER)
    gaps = np.concatenate([np.linspace(0.0, 0.98, 15), np.linspace(0.9, 1.2, 8)]) * end.separation
    free = pl.path(pair, gaps, **control, liquid=WATER)
    angles = {"advancing_angle": (0.7, 0.2), "receding_angle": (0.7, 0.2)}
    same = pl.path(pair, gaps, **control, contact_line="hysteresis", **angles, liquid=WATER)
    wanted = pl.bridge(pair, gaps, **control, liquid=WATER)
    for found in (free, same):
        for name in ("force", "volume", "suction", "contact_radius", "surface_energy", "stiffness"):
            rtol = 1e-10 if name != "stiffness" else 1e-8
            np.testing.assert_allclose(getattr(found, name), getattr(wanted, name), rtol=rtol)
        np.testing.assert_array_equal(found.exists, wanted.exists)
        assert found.rupture.separation == pytest.approx(end.separation, rel=1e-11)
        assert (found.line[found.exists] == "free").all()
        assert (found.dissipated[found.exists] == 0.0).all()


def test_a_catenoid_between_pinned_rings_ends_where_it_must():
    plates = pl.Pair(math.inf, 1.2)
    found = pl.path(plates, [0.5, 10.0], suction=0.0, contact_line="pinned", liquid=UNIT)
    assert found.rupture.separation / found.rupture.contact_radius[0] == pytest.approx(1.325486838, abs=1e-9)
    assert found.ending == "no equilibrium is left beyond"


@pytest.mark.parametrize(("contact_line", "waves"), [("pinned", 1.0), ("wetting", 0.5)])
def test_a_cylinder_breaks_at_a_wave_or_at_half_of_one(contact_line, waves):
    """Separation and volume grow together, in one step: between them the bridge stays the cylinder of radius 1."""
    plates = pl.Pair(math.inf, 0.5 * math.pi)
    found = pl.path(plates, [1.0, 8.0], volume=[math.pi, 8.0 * math.pi], contact_line=contact_line, liquid=UNIT)
    assert found.rupture.separation == pytest.approx(2.0 * math.pi * waves, rel=1e-12)
    np.testing.assert_allclose(found.rupture.contact_radius, 1.0, rtol=1e-12)


def test_hysteresis_holds_mirror_images_that_would_slide():
    pair, gaps = pl.Pair(1.0, math.radians(50.0)), np.linspace(0.01, 0.5, 30)
    free = pl.path(pair, gaps, volume=0.01, liquid=UNIT)
    assert free.ending == "the liquid slides to one solid"
    angles = {"advancing_angle": math.radians(50.0), "receding_angle": math.radians(40.0)}
    held = pl.path(pair, gaps, volume=0.01, contact_line="hysteresis", **angles, liquid=UNIT)
    assert held.rupture.separation > free.rupture.separation


def lowest_sideways(found, step, points=160):
    """Least eigenvalue of the second variation of the area sideways, cos(azimuth), between rings that are held."""
    middle, slope, half = found._meridian[step]
    suction, s = found.suction[step], np.linspace(-half, half, points + 2)
    turned = np.exp(1j * suction * s)
    zeta = middle * np.exp(1j * slope) * turned + (turned - 1.0) / suction
    radius, phi, h = np.abs(zeta), np.angle(zeta), s[1] - s[0]
    across = np.cos(phi) / radius
    weight = 1.0 / radius - radius * ((suction + across) ** 2 + across**2)
    between = 0.5 * (radius[1:] + radius[:-1]) / h**2
    matrix = np.diag(between[1:] + between[:-1] + weight[1:-1])
    matrix -= np.diag(between[1:-1], 1) + np.diag(between[1:-1], -1)
    scale = 1.0 / np.sqrt(radius[1:-1])
    return np.linalg.eigvalsh(scale[:, None] * matrix * scale)[0] * half**2


def test_pinned_lines_hold_the_liquid_sideways_as_the_second_variation_says():
    rng, seen = np.random.default_rng(5), []
    while len(seen) < 40 or all(seen):
        radii = [(math.inf, math.inf), (1.0, math.inf), (1.0, rng.uniform(0.5, 3.0))][rng.integers(3)]
        angles, volume = tuple(rng.uniform(0.3, 2.8, 2)), rng.uniform(0.02, 0.5)
        gaps = np.linspace(rng.uniform(0.3, 1.0), 0.15, 6) * volume ** (1.0 / 3.0)
        held = volume * np.linspace(1.0, rng.uniform(0.7, 3.0), 6)
        try:
            found = pl.path(pl.Pair(radii, angles), gaps, volume=held, contact_line="pinned", liquid=UNIT)
        except ValueError:  # no bridge to start from
            continue
        for step in np.flatnonzero(found.exists):
            least = lowest_sideways(found, step)
            if abs(least) > 1e-3:  # at 180° between planes it is 0
                assert (least > 0.0) == found.sideways_stable[step]
                seen.append(least > 0.0)


# -- energy --------------------------------------------------------------------------------------------------------


def test_what_a_loop_takes_is_what_it_dissipates():
    loop = pl.path(GRAINS, LOOP, volume=1e-15, **HYSTERESIS)
    area = np.trapezoid(loop.force, loop.separation)
    assert loop.work[-1] == pytest.approx(area, rel=2e-3)
    assert loop.work[-1] == pytest.approx(loop.dissipated[-1] + loop.surface_energy[-1] - loop.surface_energy[0])
    spent = np.diff(loop.dissipated)
    both_stay = (loop.line[1:] == "pinned").all(axis=1) & (loop.line[:-1] == "pinned").all(axis=1)
    assert (spent >= 0.0).all()
    assert spent[-1] > 0.0
    assert (spent[both_stay] == 0.0).all()


@pytest.mark.parametrize("control", ["volume", "suction"])
def test_work_is_the_integral_of_force_and_suction(control):
    """∫F dD - ∫Δp dV by Simpson's rule over steps along which no line begins or stops."""
    rng = np.random.default_rng(5)
    for kind in KINDS:
        pair, angles, gap, held, found = random_path(rng, kind, control, 3)
        question = {"advancing_angle": tuple(angles[:, 2]), "receding_angle": tuple(angles[:, 0]), "liquid": UNIT}
        share = np.linspace(0.0, 2.0, 2001)
        fine = {name: np.interp(share, [0.0, 1.0, 2.0], values) for name, values in (("gap", gap), ("held", held))}
        found = pl.path(pair, fine["gap"], **{control: fine["held"]}, contact_line="hysteresis", **question)
        pulled = np.cumsum(0.5 * (found.force[1:] + found.force[:-1]) * np.diff(found.separation))
        supplied = -np.cumsum(0.5 * (found.suction[1:] + found.suction[:-1]) * np.diff(found.volume))
        size = np.abs(found.work).max()
        np.testing.assert_allclose(found.work[1:], pulled + supplied, atol=1e-5 * size)
        assert np.diff(found.dissipated).min() >= -1e-15 * size


@pytest.mark.parametrize("radii", [(1.0, 0.4), (1.0, math.inf), (math.inf, math.inf)])
def test_the_force_is_the_slope_of_the_energy_while_lines_stay(radii):
    pair = pl.Pair(radii, (0.9, 0.7))
    step = 1e-4
    gaps = 0.2 + step * np.array([0.0, 1.0, 2.0, 3.0, 4.0])
    found = pl.path(pair, gaps, volume=0.05, contact_line="pinned", liquid=UNIT)
    assert np.ptp(found.contact_radius, axis=0).max() < 1e-14
    energy, force = found.surface_energy, found.force
    slope = (energy[0] - 8.0 * energy[1] + 8.0 * energy[3] - energy[4]) / (12.0 * step)
    assert slope == pytest.approx(force[2], rel=1e-9)
    stiffness = (force[0] - 8.0 * force[1] + 8.0 * force[3] - force[4]) / (12.0 * step)
    assert stiffness == pytest.approx(found.stiffness[2], rel=1e-7)
    assert (found.dissipated == 0.0).all()


# -- rules of motion, over very many paths ---------------------------------------------------------------------------


def many_questions(rng, control, count, steps):
    """Pairs and points of paths: all shapes, angles up to 150°, steps that grow and fall by half."""
    k = np.stack([np.ones(count), rng.choice([1.0, 0.3, 0.02, 0.0], count)], axis=1)
    angles = np.sort(rng.uniform(0.0, rng.choice([1.5, 2.6], (count, 1, 1)), (count, 2, 3)), axis=2)
    alike = rng.random(count) < 0.3
    k[alike, 1], angles[alike, 1] = 1.0, angles[alike, 0]
    pinned = rng.random(count) < 0.2
    angles[pinned, :, 0], angles[pinned, :, 2] = 0.0, math.pi
    at_limit = rng.random((count, 2)) < 0.3
    angles[at_limit, 1] = angles[at_limit, 2]
    held = 10.0 ** (rng.uniform(-6.0, -0.5, count) if control == VOLUME else rng.uniform(-1.0, 3.0, count))
    gap = rng.uniform(0.0, 0.6, count)
    gap *= held ** (1.0 / 3.0) if control == VOLUME else 1.0 / (held + 2.0)
    walks = np.exp(np.cumsum(rng.normal(0.0, 0.5, (2, count, steps)), axis=2))
    walks /= walks[:, :, :1]
    points = np.stack([gap[:, None] * walks[0], held[:, None] * walks[1]], axis=2)
    points[: count // 3, :, 0] = points[: count // 3, :1, 0]
    points[count // 3 : 2 * count // 3, :, 1] = points[count // 3 : 2 * count // 3, :1, 1]
    order = [1, 2, 0]  # starting, advancing, receding
    pairs = np.concatenate([k[:, :1], angles[:, 0, order], k[:, 1:], angles[:, 1, order]], axis=1)
    return pairs, points


@pytest.mark.long
@pytest.mark.parametrize("control", [VOLUME, SUCTION])
def test_thousands_of_paths_keep_the_rules(control):
    seed = np.random.SeedSequence().entropy
    print(f"seed {seed}")
    pairs, points = many_questions(np.random.default_rng(seed), control, 3000, 10)
    questions = np.column_stack([points[:, 0], pairs[:, [0, 1, 4, 5]]])
    starts, statuses = answer(STABLE, control, questions)
    holds = statuses == FOUND
    pairs, points, first = pairs[holds], points[holds], State(*starts[holds].T)
    turn = first.curvature * first.half_length
    meridians = np.stack([np.log(first.middle_radius), first.middle_slope, np.log(first.half_length), turn], axis=1)
    walked = walk_paths(control, pairs, points, meridians)
    found, state = walked.statuses == FOUND, State(*np.moveaxis(walked.states[:, :-1], -1, 0))
    told, ends = walked.told[:, :-1], walked.end
    assert (ends[:, 0] == LOST).sum() <= 1, pairs[ends[:, 0] == LOST]
    assert ((ends[:, 0] == ARRIVED) == found.all(axis=1)).all()
    held = state.volume if control == VOLUME else state.curvature
    assert np.abs((state.separation - points[..., 0]) / state.half_length)[found].max() < 1e-10
    assert np.abs(held / points[..., 1] - 1.0)[found].max() < 1e-10
    assert (state.unstable_directions[found] == 0.0).all()
    both = found[:, 1:] & found[:, :-1]
    fillings, radii = (state.filling1, state.filling2), (state.radius1, state.radius2)
    for solid in (0, 1):
        k, high, low = (pairs[:, 4 * solid + column, None] for column in (0, 2, 3))
        angle, mode = told[..., solid], told[..., 2 + solid]
        assert (angle - high)[found].max() < 1e-12
        assert (low - angle)[found].max() < 1e-12
        assert np.abs(angle - high)[found & (mode == 1)].max() < 1e-12
        assert np.abs(angle - low)[found & (mode == 2)].max() < 1e-12
        # where a line dissipates nothing it stays, or slides at the angle that counts in the energy
        way = np.diff(np.where(k > 0.0, fillings[solid], radii[solid]), axis=1)
        spent = np.diff(told[..., 4 + solid], axis=1)
        counts = (
            np.minimum(np.abs(pairs[:, 4 * solid + 1, None] - high), np.abs(pairs[:, 4 * solid + 1, None] - low))
        ) > 1e-6
        assert np.abs(way)[both & counts & (spent == 0.0)].max() < 1e-9
        assert (np.diff(told[..., 4 + solid], axis=1)[both] >= -1e-12).all()


# -- after the end, and bad input ----------------------------------------------------------------------------------


def test_after_the_end_there_is_nothing():
    found = pl.path(GRAINS, [2e-6, 10e-6, 30e-6, 2e-6], volume=1e-15, **HYSTERESIS)
    np.testing.assert_array_equal(found.exists, [True, True, False, False])
    np.testing.assert_array_equal(found.force[2:], 0.0)
    assert np.isnan(found.contact_angle[2:]).all()
    assert (found.line[2:] == "").all()
    assert 10e-6 < found.rupture.separation < 30e-6
    assert found.rupture.volume == pytest.approx(1e-15, rel=1e-11)
    assert found.rupture.work > found.work[1]
    whole = pl.path(GRAINS, [2e-6, 10e-6], volume=1e-15, **HYSTERESIS)
    assert whole.rupture is None
    assert whole.ending == ""


def test_a_humidity_is_a_suction():
    liquid = pl.Liquid.water()
    wet = pl.path(GRAINS, [1e-9, 2e-9, 1e-9], humidity=[0.7, 0.8, 0.75], liquid=liquid)
    dry = pl.path(GRAINS, [1e-9, 2e-9, 1e-9], suction=pl.suction_from_humidity([0.7, 0.8, 0.75], liquid), liquid=liquid)
    np.testing.assert_array_equal(wet.force, dry.force)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"contact_line": "sticky"}, "contact_line: 'sticky' is not one of 'wetting', 'pinned', 'hysteresis'"),
        (
            {"receding_angle": None},
            "receding_angle: missing; contact_line 'hysteresis' needs advancing_angle and receding_angle",
        ),
        (
            {"contact_line": "pinned"},
            "advancing_angle: has no effect with contact_line 'pinned'; 'hysteresis' heeds it",
        ),
        (
            {"receding_angle": 1.2},
            "receding_angle[0]: 1.2 rad (68.75°) is not <= 1.0472 rad (60°), the advancing angle",
        ),
        (
            {"advancing_angle": (1.1, 0.9)},
            "contact_angle[1]: 1.0472 rad (60°), with which the path starts, is not between the receding angle, "
            "0.523599 rad (30°), and the advancing one, 0.9 rad (51.57°)",
        ),
        (
            {"advancing_angle": (1.1, 1.2, 1.3)},
            "advancing_angle: a tuple of 3 is not a pair (first solid, second solid)",
        ),
        ({"advancing_angle": [1.1, 1.2]}, "advancing_angle: a path has one angle a solid; arrays are not possible"),
    ],
)
def test_bad_lines_are_refused(changed, message):
    with refused(message):
        pl.path(GRAINS, [1e-6, 2e-6], volume=1e-15, **{**HYSTERESIS, **changed})


def test_bad_paths_are_refused():
    with refused("separation[0]: 0.0001 m is where the path starts, and no stable bridge holds there"):
        pl.path(GRAINS, [1e-4, 1e-6], volume=1e-15, **HYSTERESIS)
    steps = "separation: a path has two or more steps along one axis, not the shape {}; give a list of separations, "
    with refused(steps.format("()") + "or of what is held"):
        pl.path(GRAINS, 1e-6, volume=1e-15, **HYSTERESIS)
    with refused("pair: a path is that of one pair; arrays of radii or angles are not possible"):
        pl.path(pl.Pair([50e-6, 40e-6], 0.1), [1e-6, 2e-6], volume=1e-15, liquid=WATER)
    with pytest.raises(ValueError, match=r"^suction: holds no stable bridge between two planes"):
        pl.path(pl.Pair(math.inf, 0.1), [1e-6, 2e-6], suction=1e3, liquid=WATER)


def test_a_picture_has_the_loop_and_both_lines(tmp_path):
    pair = pl.Pair((50e-6, math.inf), (1.0, 0.5))
    angles = {"advancing_angle": (1.0, 0.5), "receding_angle": (0.6, 0.2)}
    found = pl.path(pair, LOOP, volume=1e-15, contact_line="hysteresis", **angles, liquid=WATER)
    drawing = found.plot(title="A loop", subtitle="of a sphere and a plate")
    large, upper, lower = drawing.axes
    assert large.get_xlabel() == "separation (µm)"
    assert {text.get_text() for text in large.get_legend().get_texts()} >= {"advancing", "receding", "start"}
    pieces = sum(1 + np.count_nonzero(words[2:] != words[1:-1]) for words in found.line.T)
    assert len(upper.lines) == len(lower.lines) == pieces
    assert sum(len(line.get_xdata()) - 1 for line in upper.lines) == 2 * (len(LOOP) - 1)
    drawing.savefig(tmp_path / "loop.svg")
    swept = pl.path(pair, 1e-6, suction=np.geomspace(1e3, 1e5, 9), contact_line="hysteresis", **angles, liquid=WATER)
    assert swept.plot().axes[0].get_xlabel().startswith("suction")
