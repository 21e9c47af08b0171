"""Forces on a list of contacts against a plain loop over exact bridges, and the hysteresis of their formation."""

import math

import numpy as np
import pytest

import pendular as pl
from pendular.packing.finding import CHUNK
from pendular.packing.forces import BridgeState, contact_energy, contact_forces

ANGLE, TENSION = 0.35, 0.0728
WATER = pl.Liquid(surface_tension=TENSION)
SUCTION, VOLUME = 2e4, 2e-15  # for grains of about 0.1 mm


RANGES = {"suction": ((1.0, 1e3), (1, 4), 1e-6), "volume": ((1e-4, 3e-2), (1, 2), 1e-5)}


class Tables(dict):
    """One table for each control, made when first asked for."""

    def __missing__(self, control):
        reduced, radius_ratio, tolerance = RANGES[control]
        self[control] = pl.tabulate(ANGLE, control, reduced=reduced, radius_ratio=radius_ratio, tolerance=tolerance)
        return self[control]


@pytest.fixture(scope="module")
def tables():
    return Tables()


def packing(seed, cells=5):
    """Grains near the points of a lattice, some in touch and some apart, with a shuffled list of neighbours."""
    print("seed", seed)
    rng = np.random.default_rng(seed)
    index = np.arange(cells**3).reshape(cells, cells, cells)
    lattice = np.stack(np.meshgrid(*[np.arange(cells)] * 3, indexing="ij"), -1).reshape(-1, 3)
    neighbours = [(index.take(range(cells - 1), axis), index.take(range(1, cells), axis)) for axis in range(3)]
    pairs = np.concatenate([np.stack([low.ravel(), high.ravel()], 1) for low, high in neighbours])
    pairs = rng.permutation(pairs)
    flipped = rng.random(len(pairs)) < 0.5
    pairs[flipped] = pairs[flipped, ::-1]
    radii = rng.uniform(90e-6, 110e-6, cells**3)
    return rng, pairs, lattice * 200e-6 + rng.normal(0.0, 2e-6, lattice.shape), radii


class PlainLoop:
    """The same step in plain Python: a dictionary of bridges, exact answers, one contact after another."""

    def __init__(self, control, formation_distance):
        self.control, self.formation_distance, self.bridges = control, formation_distance, {}

    def step(self, pairs, positions, radii, values):
        """Force on each particle, virial and energy."""
        force, virial, energy, bridges = np.zeros(positions.shape), np.zeros((3, 3)), 0.0, {}
        for (i, j), value in zip(pairs.tolist(), values, strict=True):
            key = (min(i, j), max(i, j))
            arm = positions[i] - positions[j]
            gap = math.dist(positions[i], positions[j]) - radii[i] - radii[j]
            if key not in self.bridges and gap > self.formation_distance:
                continue
            held = self.bridges.get(key, value) if self.control == "volume" else value
            grains = pl.Pair((radii[i], radii[j]), ANGLE)
            known = {self.control: held, "liquid": WATER}
            if gap >= pl.rupture(grains, **known).separation:
                continue
            bridge = pl.bridge(grains, max(gap, 0.0), **known)
            pull = -bridge.force * arm / np.linalg.norm(arm)
            force[i] += pull
            force[j] -= pull
            virial += np.outer(arm, pull)
            energy += self.work_left(gap, bridge.force, grains, known)
            bridges[key] = held
        self.bridges = bridges
        return force, virial, energy

    @staticmethod
    def work_left(gap, force, grains, known):
        """Minus the integral of the force up to rupture, by Gauss points in q, where D = D_c(1 - q²)."""
        end = pl.rupture(grains, **known).separation
        nodes, weights = np.polynomial.legendre.leggauss(16)
        top = math.sqrt(1.0 - max(gap, 0.0) / end)
        q = 0.5 * top * (nodes + 1.0)
        forces = pl.bridge(grains, end * (1.0 - q * q), **known).force
        return -end * top * np.sum(weights * forces * q) + min(gap, 0.0) * force


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_steps_agree_with_a_plain_loop_over_exact_bridges(tables, control):
    rng, pairs, positions, radii = packing(11, cells=4)
    low, high, stretch = {"suction": (1e4, 4e4, 1.01), "volume": (1e-15, 4e-15, 1.035)}[control]
    tolerance = 6 * RANGES[control][2]
    loop, state, broken = PlainLoop(control, 1e-6), None, 0
    for _ in range(3):
        values = rng.uniform(low, high, len(pairs))
        expected, virial, energy = loop.step(pairs, positions, radii, values)
        former = 0 if state is None else len(state.pairs)
        found = contact_forces(
            tables[control], pairs, positions, radii, values, TENSION, state=state, formation_distance=1e-6
        )
        state = found.state
        bridges = {(min(p), max(p)): held for p, held in zip(state.pairs.tolist(), state.control, strict=True)}
        assert bridges == loop.bridges
        broken += max(0, former - len(bridges))
        strongest = np.abs(found.attraction).max()
        np.testing.assert_allclose(found.force, expected, atol=tolerance * strongest)
        np.testing.assert_allclose(found.virial, virial, atol=tolerance * np.abs(virial).max())
        own = contact_energy(tables[control], state, positions, radii, TENSION)
        assert own == pytest.approx(energy, rel=tolerance)
        positions = positions * stretch + rng.normal(0.0, 1e-6, positions.shape)
        pairs = rng.permutation(pairs)
    assert bridges
    assert broken > 0


def test_forces_are_exactly_opposite_and_added_in_the_order_of_the_particles(tables):
    _, pairs, positions, radii = packing(12)
    found = contact_forces(tables["suction"], pairs, positions, radii, SUCTION, TENSION)
    expected = np.zeros(positions.shape)
    for (i, j), attraction in zip(found.state.pairs, found.attraction, strict=True):
        arm = positions[j] - positions[i]
        x, y, z = arm.tolist()
        pull = attraction / math.sqrt(x * x + y * y + z * z) * arm
        expected[i] += pull
        expected[j] -= pull
    np.testing.assert_array_equal(found.force, expected)
    for pair in found.state.pairs[:20]:
        alone = contact_forces(tables["suction"], [pair], positions, radii, SUCTION, TENSION).force
        np.testing.assert_array_equal(alone[pair[0]], -alone[pair[1]])
        assert np.count_nonzero(alone) == 6
    np.testing.assert_array_equal(found.virial, found.virial.T)
    assert np.trace(found.virial) == pytest.approx(
        -np.sum(found.attraction * (found.separation + radii[found.state.pairs].sum(axis=1))), rel=1e-12
    )


def test_neither_threads_nor_the_order_of_the_list_change_a_bit(tables, monkeypatch):
    rng, pairs, positions, radii = packing(13, cells=24)
    assert len(pairs) > 2 * CHUNK
    results = []
    for count in (1, 3):
        for module in ("ground.rows", "packing.finding", "packing.adding"):
            monkeypatch.setattr(f"pendular.{module}.thread_count", lambda count=count: count)
        for order in (np.arange(len(pairs)), rng.permutation(len(pairs))):
            volumes = VOLUME * (1.0 + (pairs.sum(axis=1)[order] % 7))
            results.append(contact_forces(tables["volume"], pairs[order], positions, radii, volumes, TENSION))
    assert len(results[0].attraction) > 300
    for other in results[1:]:
        for name in ("force", "virial", "separation", "attraction"):
            np.testing.assert_array_equal(getattr(other, name), getattr(results[0], name))
        np.testing.assert_array_equal(other.state.control, results[0].state.control)


def chains(seed):
    """Chains of grains that touch, with numbers far apart between two chains, listed shuffled; some grains alone."""
    print("seed", seed)
    rng = np.random.default_rng(seed)
    lengths, spaces = rng.integers(2, 4000, 30), rng.integers(0, 30000, 30)
    starts = np.cumsum(lengths + spaces) - lengths
    positions = rng.uniform(1.0, 2.0, (starts[-1] + lengths[-1] + 20000, 3))
    for row, (start, length) in enumerate(zip(starts, lengths, strict=True)):
        positions[start : start + length] = 0.0
        positions[start : start + length, 0] = np.cumsum(rng.uniform(199e-6, 201e-6, length))
        positions[start : start + length, 1] = row * 1e-3
    pairs = np.concatenate(
        [
            np.column_stack([np.arange(s, s + n - 1), np.arange(s + 1, s + n)])
            for s, n in zip(starts, lengths, strict=True)
        ]
    )
    return rng.permutation(pairs), positions, np.full(len(positions), 100e-6)


@pytest.mark.parametrize(("chunks", "threads"), [(1, 3), (2, 1), (3, 2)])
def test_runs_of_contacts_change_no_bit(tables, monkeypatch, chunks, threads):
    pairs, positions, radii = chains(17)
    assert len(pairs) > 3 * CHUNK
    asked = (tables["suction"], pairs, positions, radii, SUCTION, TENSION)
    whole = contact_forces(*asked, formation_distance=0.5e-6)
    near, lies = (np.zeros(len(positions), bool) for _ in range(2))
    near[whole.state.pairs], lies[pairs] = True, True
    assert CHUNK < len(whole.state.pairs) < len(pairs)
    assert not whole.force[~near].any()
    assert not lies.all()
    monkeypatch.setattr("pendular.packing.step.run_length", lambda: chunks * CHUNK)
    for module in ("ground.rows", "packing.finding", "packing.adding"):
        monkeypatch.setattr(f"pendular.{module}.thread_count", lambda: threads)
    for state in (None, whole.state, BridgeState(whole.state.pairs[:100], whole.state.control[:100])):
        part = contact_forces(*asked, formation_distance=0.5e-6, state=state)
        for name in ("force", "virial", "separation", "attraction"):
            np.testing.assert_array_equal(getattr(part, name), getattr(whole, name))
        np.testing.assert_array_equal(part.state.pairs, whole.state.pairs)


@pytest.mark.parametrize("place", [0, 1, -1])
def test_a_grain_without_contact_that_is_none_is_refused(tables, place):
    pairs, positions, radii = chains(18)
    alone = np.setdiff1d(np.arange(len(radii)), pairs)[place]
    for name, wrong in (("positions", math.nan), ("positions", math.inf), ("radii", 0.0), ("radii", math.nan)):
        arrays = {"positions": positions.copy(), "radii": radii.copy()}
        arrays[name][alone] = wrong
        with pytest.raises(ValueError, match=name):
            contact_forces(tables["suction"], pairs, *arrays.values(), SUCTION, TENSION)


def test_a_former_bridge_that_is_no_pair_stands_for_no_other(tables):
    _, pairs, positions, radii = packing(19)
    low, high = sorted(pairs[0].tolist())
    for wrong in ((low - 1, high + len(radii)), (low + 1, high - len(radii))):
        state = BridgeState(np.array([wrong]), np.array([SUCTION]))
        with pytest.raises(ValueError, match=r"state.pairs\[0\]: .* is not two of the particles"):
            contact_forces(tables["suction"], pairs, positions, radii, SUCTION, TENSION, state=state)


def at(gap, radii):
    return np.array([(0.0, 0.0, 0.0), (0.0, 0.0, radii[0] + radii[1] + gap)])


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_a_bridge_forms_at_contact_stays_until_rupture_and_needs_contact_again(tables, control):
    radii, held = (100e-6, 150e-6), {"suction": SUCTION, "volume": VOLUME}[control]
    end = tables[control].rupture_distance(held, *radii, TENSION)
    path = [
        (0.5, False),
        (1e-6, False),
        (-0.01, True),
        (0.5, True),
        (0.999, True),
        (1.001, False),
        (0.5, False),
        (0.01, False),
        (-1e-3, True),
        (0.9, True),
    ]
    state = None
    for share, has_bridge in path:
        found = contact_forces(tables[control], [(1, 0)], at(share * end, radii), radii, held, TENSION, state=state)
        state = found.state
        assert len(state.pairs) == has_bridge
        expected = tables[control].force(found.separation, held, *radii, TENSION) if has_bridge else 0.0
        assert found.force[0, 2] == pytest.approx(expected, rel=1e-12)
        assert found.force[1, 2] == -found.force[0, 2]


def test_a_formation_distance_beyond_rupture_makes_no_bridge(tables):
    radii = (100e-6, 100e-6)
    end = tables["suction"].rupture_distance(SUCTION, *radii, TENSION)
    for share, count in ((0.7, 1), (0.9, 0), (1.1, 0)):
        found = contact_forces(
            tables["suction"], [(0, 1)], at(share * end, radii), radii, SUCTION, TENSION, formation_distance=0.8 * end
        )
        assert len(found.attraction) == count
    beyond = contact_forces(
        tables["suction"], [(0, 1)], at(1.1 * end, radii), radii, SUCTION, TENSION, formation_distance=2.0 * end
    )
    assert len(beyond.state.pairs) == 0


def test_a_bridge_keeps_its_volume_and_takes_a_new_suction(tables):
    radii = (100e-6, 150e-6)
    for control, first, second, kept in (("volume", VOLUME, 2 * VOLUME, VOLUME), ("suction", 2e4, 1e4, 1e4)):
        state = contact_forces(tables[control], [(0, 1)], at(0.0, radii), radii, first, TENSION).state
        assert state.control == [first]
        later = contact_forces(tables[control], [(0, 1)], at(1e-6, radii), radii, second, TENSION, state=state)
        assert later.state.control == [kept]
        assert later.attraction[0] == pytest.approx(tables[control].force(1e-6, kept, *radii, TENSION), rel=1e-6)


def test_drained_bridges_go_on_with_their_liquid(tables):
    """From constant suction to constant volume: the force does not jump."""
    radii = (100e-6, 150e-6)
    drained = contact_forces(tables["suction"], [(0, 1)], at(0.0, radii), radii, SUCTION, TENSION)
    liquid = tables["suction"].volume(drained.separation, drained.state.control, *radii, TENSION)
    state = BridgeState(drained.state.pairs, liquid)
    closed = contact_forces(tables["volume"], [(0, 1)], at(0.0, radii), radii, 1e-15, TENSION, state=state)
    np.testing.assert_allclose(closed.force, drained.force, rtol=1e-4)


def test_a_restart_continues_to_the_last_bit(tables, tmp_path):
    _, pairs, positions, radii = packing(14)
    state = contact_forces(tables["volume"], pairs, positions, radii, VOLUME, TENSION).state
    np.savez(tmp_path / "state.npz", **state._asdict())
    with np.load(tmp_path / "state.npz") as file:
        loaded = BridgeState(**file)
    one, two = (
        contact_forces(tables["volume"], pairs, positions * 1.01, radii, 2 * VOLUME, TENSION, state=known)
        for known in (state, loaded)
    )
    assert 0 < len(one.attraction) <= len(state.pairs)
    np.testing.assert_array_equal(one.force, two.force)
    assert np.any(one.force != 0.0)


def test_a_particle_with_very_many_contacts(tables):
    """One large grain amid small ones, each of which touches it only."""
    print("seed 15")
    direction = np.random.default_rng(15).normal(size=(2000, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    positions = np.vstack([np.zeros(3), direction * 399e-6])
    radii = np.array([300e-6] + [100e-6] * 2000)
    pairs = np.array([(k, 0) for k in range(2000, 0, -1)])
    found = contact_forces(tables["suction"], pairs, positions, radii, SUCTION, TENSION)
    assert found.state.pairs[:, 0].tolist() == list(range(1, 2001))
    each = float(tables["suction"].force(0.0, SUCTION, 100e-6, 300e-6, TENSION))
    np.testing.assert_allclose(found.force[1:], -each * direction, atol=1e-12 * each)
    np.testing.assert_allclose(found.force[0], each * direction.sum(axis=0), atol=1e-9 * each)


def test_different_contact_angles_belong_to_the_order_of_a_pair():
    table = pl.tabulate((0.0, 1.0), reduced=(10.0, 100.0), radius_ratio=(1, 2), tolerance=1e-5)
    radii = np.array([100e-6, 150e-6])
    for pair in ((0, 1), (1, 0)):
        found = contact_forces(table, [pair], at(0.0, radii), radii, SUCTION, TENSION)
        grains = pl.Pair(tuple(radii[list(pair)]), (0.0, 1.0))
        exact = pl.bridge(grains, 0.0, suction=SUCTION, liquid=WATER).force
        assert found.force[0, 2] == pytest.approx(exact, rel=1e-5)


@pytest.mark.parametrize("pairs", [[], np.empty((0, 2), int)])
def test_an_empty_list(tables, pairs):
    found = contact_forces(tables["suction"], pairs, at(0.0, (1e-4, 1e-4)), (1e-4, 1e-4), [], TENSION)
    assert found.state.pairs.shape == (0, 2)
    assert not found.force.any()
    assert not found.virial.any()
    assert contact_energy(tables["suction"], found.state, at(0.0, (1e-4, 1e-4)), (1e-4, 1e-4), TENSION) == 0.0


GOOD = {
    "pairs": [(0, 1)], "positions": at(0.0, (1e-4, 1e-4)), "radii": (1e-4, 1e-4), "control": SUCTION,
    "surface_tension": TENSION,
}  # fmt: skip
STATE = BridgeState(np.array([(0, 1)]), np.array([SUCTION]))


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        ({"pairs": [(0, 2)]}, r"pairs\[0\]: \(0, 2\) is not two of the particles 0 to 1"),
        ({"pairs": [(0, 1), (-1, 0)]}, r"pairs\[1\]: \(-1, 0\) is not two of the particles 0 to 1"),
        ({"pairs": [(1, 1)]}, r"pairs\[0\]: \(1, 1\) is not two of the particles"),
        ({"pairs": [(0, 1), (1, 0)]}, r"pairs: \(1, 0\) is there twice"),
        ({"pairs": [(0.0, 1.0)]}, "pairs: an array of float64 of shape"),
        ({"pairs": [0, 1]}, r"pairs: an array of int64 of shape \(2,\)"),
        ({"positions": np.zeros((3, 3))}, r"positions: an array of shape \(3, 3\) is not of shape \(2, 3\)"),
        ({"positions": np.zeros((2, 3))}, "positions: particles 0 and 1 have the same centre"),
        ({"positions": at(math.nan, (1e-4, 1e-4))}, "positions.*is not a number"),
        ({"radii": (1e-4, 0.0)}, r"radii\[1\]: 0.0 m is not > 0"),
        ({"radii": (1e-4, math.inf)}, r"radii\[1\]: inf m is not finite"),
        ({"radii": 1e-4}, r"radii: an array of shape \(\) is not one radius for each particle"),
        ({"control": [SUCTION, SUCTION]}, r"control: an array of shape \(2,\) is not one number nor one for each of 1"),
        ({"control": 1.0}, "reduced suction: .* is not in .*, the range of the table"),
        ({"surface_tension": 0.0}, "surface_tension: 0.0 N/m is not > 0"),
        ({"formation_distance": -1e-9}, "formation_distance: -1e-09 m is not >= 0"),
        ({"pairs": [], "state": STATE}, r"pairs: \(0, 1\) is not there, but its bridge still stands"),
        ({"state": BridgeState(np.array([(0, 5)]), np.array([SUCTION]))}, r"state.pairs\[0\]: \(0, 5\) is not two of"),
        ({"state": BridgeState(np.array([(0, 1)]), np.empty(3))}, "state.control: an array of shape"),
    ],
)
def test_bad_input_is_refused_in_one_line(tables, bad, message):
    with pytest.raises(ValueError, match=message) as caught:
        contact_forces(tables["suction"], **(GOOD | bad))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_where_a_list_leaves_out_broken_bridges_the_others_go_on(tables, control):
    rng, pairs, positions, radii = packing(16)
    values = rng.uniform(*{"suction": (1e4, 4e4), "volume": (1e-15, 4e-15)}[control], len(pairs))
    state = contact_forces(tables[control], pairs, positions, radii, values, TENSION).state
    positions[positions[:, 0] > 500e-6] += (100e-6, 0.0, 0.0)  # a layer goes away
    gaps = np.linalg.norm(positions[pairs[:, 0]] - positions[pairs[:, 1]], axis=1) - radii[pairs].sum(axis=1)
    near = gaps < 50e-6
    assert not near.all()
    whole, part = (
        contact_forces(tables[control], pairs[kept], positions, radii, values[kept], TENSION, state=state)
        for kept in (slice(None), near)
    )
    assert 0 < len(whole.state.pairs) < len(state.pairs)
    np.testing.assert_array_equal(whole.force, part.force)
    for former, found in zip(whole.state, part.state, strict=True):
        np.testing.assert_array_equal(former, found)


def test_a_list_may_leave_out_bridges_that_broke(tables):
    far = at(1e-4, (1e-4, 1e-4))
    found = contact_forces(tables["suction"], [], far, (1e-4, 1e-4), SUCTION, TENSION, state=STATE)
    assert len(found.state.pairs) == 0
