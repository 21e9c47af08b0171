"""Heaps of grains against lattices, brute force, and the strain derivative of their potential."""

import itertools
import math

import numpy as np
import pytest

import pendular as pl
from pendular.packing.history import pairs_at
from pendular.packing.neighbours import arms_of, find_neighbours
from pendular.packing.setting import setting_of

UNIT = pl.Liquid(surface_tension=1.0)
SEED = 20260117


def simple_cubic(times=3, radius=1.0):
    return pl.Packing([(0, 0, 0)], radius, cell=3 * (2 * radius,)).repeated(3 * (times,))


def face_centred(times=2, radius=1.0):
    edge = math.sqrt(8.0) * radius
    basis = np.array([(0, 0, 0), (0, 0.5, 0.5), (0.5, 0, 0.5), (0.5, 0.5, 0)])
    return pl.Packing(edge * basis, radius, cell=3 * (edge,)).repeated(3 * (times,))


def body_centred(times=3, radius=1.0):
    edge = 4.0 / math.sqrt(3.0) * radius
    return pl.Packing(edge * np.array([(0, 0, 0), (0.5, 0.5, 0.5)]), radius, cell=3 * (edge,)).repeated(3 * (times,))


def loose(count=200, seed=SEED, spread=2.0, density=0.45, cell=None):
    """Grains of different sizes with gaps of all signs but no deep overlap, by pushing overlaps apart."""
    random = np.random.default_rng(seed)
    print("seed", seed)
    radii = random.uniform(1.0, spread, count)
    volume = np.sum(4.0 / 3.0 * np.pi * radii**3) / density
    shape = np.eye(3) if cell is None else cell
    cell = shape * np.cbrt(volume / abs(np.linalg.det(shape)))
    places = random.uniform(0, 1, (count, 3)) @ cell
    for _ in range(400):
        heap = pl.Packing(places, radii, cell=cell)
        near = find_neighbours(heap, lambda first, second: 0.0 * first)
        push = 0.25 * np.minimum(near.gap, 0.0)[:, None] * arms_of(heap, near)[0]
        np.add.at(places, near.pairs[:, 0], push)
        np.add.at(places, near.pairs[:, 1], -push)
    near = find_neighbours(heap, lambda first, second: 0.0 * first)
    shrink = 1.0 - 1e-9 + min(0.0, float((near.gap / (radii[near.pairs].sum(axis=1))).min(initial=0.0)))
    return pl.Packing(places, shrink * radii, cell=cell)


# --- lattices ---


@pytest.mark.parametrize(
    ("heap", "contacts", "solid"),
    [(simple_cubic(), 6, math.pi / 6), (face_centred(), 12, math.pi / math.sqrt(18))],
    ids=["sc", "fcc"],
)
@pytest.mark.parametrize("angle", [0.0, 0.35, 0.7])
@pytest.mark.parametrize("curvature", [10.0, 100.0])
def test_a_lattice_meets_its_closed_values(heap, contacts, solid, angle, curvature):
    one = pl.bridge(pl.Pair(1.0, angle), 0.0, suction=curvature, liquid=UNIT)
    w = pl.wet(heap, angle, suction=curvature, liquid=UNIT, path="wetting", condensation=False)
    sphere = 4.0 / 3.0 * math.pi
    assert w.coordination == w.contacts == contacts
    assert w.porosity == pytest.approx(1.0 - solid, rel=1e-12)
    assert w.saturation == pytest.approx(contacts / 2 * one.volume * solid / (sphere * (1 - solid)), rel=1e-9)
    stress = contacts * solid * one.force / (4 * math.pi)
    assert w.suction_stress == pytest.approx(stress, rel=1e-9)
    np.testing.assert_allclose(w.stress, stress * np.eye(3), rtol=1e-9, atol=1e-9 * stress)
    assert w.chi == pytest.approx(stress / curvature, rel=1e-9)
    np.testing.assert_allclose(w.fabric, np.eye(3) / 3, atol=1e-12)
    area = contacts / 2 * one.liquid_gas_area * solid / sphere
    assert w.interface_area == pytest.approx(area, rel=1e-9)


@pytest.mark.parametrize(
    ("heap", "saturation", "stress"),
    [(simple_cubic(), 3.51444e-4, 1.48916), (face_centred(), 1.82475e-3, 4.21197)],
    ids=["sc", "fcc"],
)
def test_a_lattice_meets_printed_values(heap, saturation, stress):
    w = pl.wet(heap, 0.0, suction=100.0, liquid=UNIT)
    assert w.saturation == pytest.approx(saturation, rel=3e-6)
    assert w.suction_stress == pytest.approx(stress, rel=3e-6)


@pytest.mark.parametrize(
    ("heap", "degrees", "limit", "saturation"),
    [
        (simple_cubic(), 0.0, 0.9458, 0.17457),
        (face_centred(), 0.0, 4.5335, 0.23598),
        (face_centred(), 20.0, 2.8099, 0.30711),
        (face_centred(), 40.0, 0.5276, 0.36564),
    ],
)
def test_bridges_meet_from_the_limit_on(heap, degrees, limit, saturation):
    for suction, meet in ((limit * (1 - 1e-4), True), (limit * (1 + 1e-4), False)):
        w = pl.wet(heap, np.deg2rad(degrees), suction=suction, liquid=UNIT, path="wetting", condensation=False)
        assert w.is_pendular is not meet
        assert w.meetings.grains == w.meetings.liquid == float(meet)
        assert w.saturation == pytest.approx(saturation, rel=3e-4)


def test_second_neighbours_hold_bridges_on_drying_alone():
    heap = body_centred()
    gap = 4 / math.sqrt(3) - 2
    reach = pl.rupture(pl.Pair(1.0), suction=[0.5, 10.0], liquid=UNIT).separation
    assert reach[0] > gap > reach[1]
    assert pl.wet(heap, 0.0, suction=0.5, liquid=UNIT).coordination == 14
    assert pl.wet(heap, 0.0, suction=10.0, liquid=UNIT).coordination == 8
    dry = pl.wet(heap, 0.0, suction=0.5, liquid=UNIT, path="wetting", condensation=False)
    assert dry.coordination == 8


# --- a heap of different grains against each pair alone ---


@pytest.mark.parametrize("path", ["drying", "wetting"])
@pytest.mark.parametrize("two_angles", [False, True])
def test_a_heap_is_the_sum_of_its_pairs(path, two_angles):
    heap = loose()
    random = np.random.default_rng(SEED)
    angles = random.choice([0.1, 0.9], heap.count) if two_angles else np.full(heap.count, 0.4)
    w = pl.wet(heap, angles if two_angles else 0.4, suction=3.0, liquid=UNIT, path=path)
    stress, volume, bridges, surface = np.zeros((3, 3)), 0.0, 0, 0.0
    first, second = np.triu_indices(heap.count, 1)
    shifts = np.array(list(itertools.product((-1, 0, 1), repeat=3))) @ heap.cell
    arms = heap.positions[second] - heap.positions[first]
    for shift in shifts:
        branch = arms + shift
        length = np.linalg.norm(branch, axis=1)
        gap = length - heap.radii[first] - heap.radii[second]
        near = np.flatnonzero(gap < 1.5)
        if not near.size:
            continue
        i, j = first[near], second[near]
        pair = pl.Pair((heap.radii[i], heap.radii[j]), (angles[i], angles[j]))
        b = pl.bridge(pair, gap[near], suction=3.0, liquid=UNIT)
        holds = b.exists & ((path == "drying") | (gap[near] <= 0.0) | (np.nan_to_num(b.grand_potential, nan=1) <= 0))
        normal = branch[near] / length[near, None]
        weight = np.where(holds, b.force * length[near], 0.0)
        stress += np.einsum("b,bi,bj->ij", weight, normal, normal)
        volume += b.volume[holds].sum()
        surface += b.liquid_gas_area[holds].sum()
        bridges += np.count_nonzero(holds)
    assert len(w.bridges) == bridges > 100
    cell = abs(np.linalg.det(heap.cell))
    np.testing.assert_allclose(w.stress, stress / cell, rtol=1e-9, atol=1e-9 * abs(stress).max() / cell)
    assert w.liquid_volume == pytest.approx(volume, rel=1e-9)
    assert w.interface_area == pytest.approx(surface / cell, rel=1e-9)


def test_shares_of_the_stress_add_up():
    heap = loose(cell=np.array([(1.0, 0, 0), (0.3, 1.2, 0), (0.1, -0.2, 0.9)]))
    angles = np.random.default_rng(SEED).choice([0.2, 0.6, 1.1], heap.count)
    for suction in (0.5, 5.0, 50.0):
        w = pl.wet(heap, angles, suction=suction, liquid=UNIT)
        shares = w.stress_shares
        np.testing.assert_allclose(sum(shares), w.stress, atol=1e-10 * abs(w.stress).max())
        assert np.trace(shares.liquid) / 3 == pytest.approx(suction * w.water_content, rel=1e-12)


def strained(heap, strain):
    change = np.eye(3) + strain
    return pl.Packing(heap.positions @ change, heap.radii, cell=heap.cell @ change)


@pytest.mark.parametrize("control", ["suction", "volume"])
def test_the_stress_is_the_rate_of_the_potential_with_the_strain(control):
    heap = loose()
    before = pl.wet(heap, 0.4, suction=3.0, liquid=UNIT, path="drying", method="exact")
    random = np.random.default_rng(SEED)
    for _ in range(3):
        direction = random.normal(size=(3, 3))
        direction = 0.5 * (direction + direction.T)
        energies, step = [], 1e-6
        for side in (-1, 1):
            moved = strained(heap, side * step * direction)
            given = {"suction": 3.0} if control == "suction" else {"volume": 0.0}
            w = pl.wet(moved, 0.4, **given, liquid=UNIT, start=before, condensation=False, method="exact")
            assert len(w.bridges) == len(before.bridges)
            energies.append(w.grand_potential if control == "suction" else w.surface_energy)
        rate = (energies[1] - energies[0]) / (2 * step) / heap.volume
        assert rate == pytest.approx(np.sum(before.stress * direction), rel=3e-6)


# --- what must not matter ---


def test_a_change_of_units_scales_all():
    heap = loose(count=60)
    w = pl.wet(heap, 0.4, suction=3.0, liquid=UNIT)
    length, tension = 1e-4, 0.0728
    other = pl.Packing(length * heap.positions, length * heap.radii, cell=length * heap.cell)
    v = pl.wet(other, 0.4, suction=3.0 * tension / length, liquid=pl.Liquid(surface_tension=tension))
    assert v.saturation == pytest.approx(w.saturation, rel=1e-10)
    np.testing.assert_allclose(v.stress, w.stress * tension / length, rtol=1e-9)
    assert v.meetings == pytest.approx(w.meetings)


def test_order_and_image_of_grains_do_not_matter():
    heap = loose(count=60)
    random = np.random.default_rng(SEED)
    angles = random.choice([0.1, 0.9], heap.count)
    w = pl.wet(heap, angles, suction=3.0, liquid=UNIT)
    order = random.permutation(heap.count)
    moved = heap.positions + random.integers(-3, 4, (heap.count, 3)) @ heap.cell
    other = pl.Packing(moved[order], heap.radii[order], cell=heap.cell)
    v = pl.wet(other, angles[order], suction=3.0, liquid=UNIT)
    assert len(v.bridges) == len(w.bridges)
    assert v.liquid_volume == pytest.approx(w.liquid_volume, rel=1e-10)
    np.testing.assert_allclose(v.stress, w.stress, atol=1e-10 * abs(w.stress).max())
    assert v.meetings == pytest.approx(w.meetings)
    ends = [other.positions[v.bridges.pairs[:, k]] for k in (0, 1)]
    branch = ends[1] + v.bridges.image @ heap.cell - ends[0]
    np.testing.assert_allclose(branch, v.bridges.normal * v.bridges.length[:, None], atol=1e-10)


def test_pairs_are_found_in_any_cell():
    random = np.random.default_rng(SEED)
    print("seed", SEED)
    for turn in range(40):
        count = int(random.integers(2, 120))
        radii = 0.5 * 10 ** random.uniform(-1.3 if turn % 2 else -0.05, 0.0, count)
        cell = np.diag(random.uniform(6, 9, 3)) + (random.normal(0, 0.7, (3, 3)) if turn % 3 else 0.0)
        periodic = tuple((random.random(3) < 0.5).tolist())
        heap = pl.Packing(
            random.uniform(-1, 2, (count, 3)) @ cell, radii, cell=cell if turn % 5 else None, periodic=periodic
        )
        near = find_neighbours(heap, lambda first, second: np.full(first.shape, 0.1))
        wraps = np.where(heap.periodic, np.floor(heap.positions @ np.linalg.inv(heap.box)), 0.0)
        inside = heap.positions - wraps @ heap.box
        found = {tuple(pair): gap for pair, gap in zip(near.pairs.tolist(), near.gap, strict=True)}
        expected = {}
        for image in itertools.product(*(((-1, 0, 1) if along else (0,)) for along in heap.periodic)):
            arm = inside[None] + np.array(image) @ heap.box - inside[:, None]
            gap = np.linalg.norm(arm, axis=-1) - radii[:, None] - radii
            expected |= {(i, j): gap[i, j] for i, j in np.argwhere(gap <= 0.1).tolist() if i < j}
        assert found.keys() == expected.keys()
        for pair, gap in expected.items():
            assert found[pair] == pytest.approx(gap, abs=1e-12)


# --- walls ---


def test_a_wall_is_a_grain_of_infinite_radius():
    heap = pl.Packing([(0, 0, 1.02), (9, 0, 1.3)], [1.0, 1.3], walls=[((5, 5, 0), (0, 0, 2.0))])
    w = pl.wet(heap, [0.2, 0.4, 0.7], suction=5.0, liquid=UNIT)
    b = pl.bridge(pl.Pair(([1.0, 1.3], np.inf), ([0.2, 0.4], 0.7)), [0.02, 0.0], suction=5.0, liquid=UNIT)
    assert w.bridges.pairs.tolist() == [[0, 2], [1, 2]]
    np.testing.assert_allclose(w.bridges.force, b.force, rtol=1e-9)
    np.testing.assert_allclose(w.bridges.normal, [(0, 0, -1), (0, 0, -1)])
    assert w.stress[2, 2] == pytest.approx(np.sum(b.force * [1.02, 1.3]) / heap.volume, rel=1e-9)
    np.testing.assert_allclose(sum(w.stress_shares), w.stress, atol=1e-12)


@pytest.mark.parametrize("radii", [(1.0, 1.0), (1.0, 0.4)])
@pytest.mark.parametrize("image", [0, 1])
def test_bridges_meet_on_a_wall_where_their_contact_circles_do(radii, image):
    b = pl.bridge(pl.Pair((radii, np.inf), (0.9, 0.1)), 0.0, suction=0.05, liquid=UNIT)
    apart = b.contact_radius[:, 1].sum()
    assert apart > 2 * math.sqrt(radii[0] * radii[1])  # the grains themselves do not touch
    wall = [((0, 0, -0.3), (0, 0, 3.0))]
    for factor, meets in ((1 - 1e-9, True), (1 + 1e-9, False)):
        far = factor * apart * np.array([0.6, 0.8]) + image * np.array([200.0, 0.0])
        places = [(1, 1, radii[0] - 0.3), (1 + far[0], 1 + far[1], radii[1] - 0.3), (80, 80, 0.7)]
        heap = pl.Packing(places, [*radii, 1.0], (200, 200, 20), (True, True, False), wall)
        w = pl.wet(heap, [0.9, 0.9, 0.9, 0.1], suction=0.05, liquid=UNIT, path="wetting", condensation=False)
        assert len(w.bridges) == 3
        assert w.is_pendular is not meets
        assert w.meetings.pairs == meets
        assert w.meetings.grains == pytest.approx(2 / 3 * meets)
        share = w.bridges.volume[:2].sum() / w.liquid_volume
        assert w.meetings.liquid == pytest.approx(share * meets)


def test_bridges_of_two_grains_on_a_wall_meet_on_it_and_then_on_the_grains():
    """Two grains that touch each other and a wall: contact circles on it of their radius, then a right angle."""
    heap = pl.Packing([(0, 0, 1), (2, 0, 1)], 1.0, walls=[((0, 0, 0), (0, 0, 1))])
    given = {"liquid": UNIT, "path": "wetting"}
    found = pl.pendular_limit(heap, 0.0, **given)
    beside = pl.bridge(pl.Pair((1.0, np.inf)), 0.0, suction=found, liquid=UNIT)
    assert beside.contact_radius[1] == pytest.approx(1.0, abs=1e-9)
    limit = found
    for _ in range(60):
        between = pl.bridge(pl.Pair(1.0), 0.0, suction=limit, liquid=UNIT)
        below = pl.bridge(pl.Pair((1.0, np.inf)), 0.0, suction=limit, liquid=UNIT)
        limit *= (between.half_filling_angle[0] + below.half_filling_angle[0]) / (0.5 * math.pi)
    for suction, pairs in ((1.001 * found, 0), (0.999 * found, 1), (1.001 * limit, 1), (0.999 * limit, 3)):
        w = pl.wet(heap, 0.0, suction=suction, **given)
        assert w.meetings.pairs == pairs
        assert w.meetings.grains == float(pairs > 0)
        assert w.meetings.liquid == pytest.approx(
            {0: 0.0, 1: w.bridges.volume[1:].sum() / w.liquid_volume, 3: 1.0}[pairs]
        )


def test_a_bridge_may_meet_its_own_image_on_a_wall():
    given = {"contact_angle": [1.2, 0.0], "liquid": UNIT, "path": "wetting"}
    radius = pl.bridge(pl.Pair((1.0, np.inf), (1.2, 0.0)), 0.0, suction=1e-3, liquid=UNIT).contact_radius[1]
    for factor, meets in ((0.999, True), (1.001, False)):
        edge = 2 * radius * factor
        heap = pl.Packing([(0, 0, 1)], 1.0, (edge, 4 * radius, 9), (True, True, False), [((0, 0, 0), (0, 0, 1))])
        w = pl.wet(heap, suction=1e-3, **given)
        assert w.meetings == (float(meets), float(meets), int(meets))


# --- tables ---


@pytest.mark.parametrize("two_angles", [False, True])
def test_a_table_errs_no_more_than_it_says(two_angles):
    heap = loose()
    angles = np.random.default_rng(SEED).choice([0.1, 0.5], heap.count) if two_angles else 0.4
    exact = pl.wet(heap, angles, suction=3.0, liquid=UNIT, method="exact")
    table = pl.wet(heap, angles, suction=3.0, liquid=UNIT, method="table")
    assert exact.table_error.bridges == 0 < table.table_error.bridges
    assert table.table_error.force < 1e-7
    for name in ("force", "volume", "liquid_gas_area", "grand_potential"):
        true, found = getattr(exact.bridges, name), getattr(table.bridges, name)
        bound = max(getattr(table.table_error, name), 1e-12)
        assert np.max(np.abs(found - true)) <= 3 * bound * np.max(np.abs(true)), name
    for name in ("half_filling_angle", "wetted_area", "capillary_tensor"):
        true, found = getattr(exact.bridges, name), getattr(table.bridges, name)
        np.testing.assert_allclose(found, true, atol=1e-6 * np.max(np.abs(true)), err_msg=name)


# --- history ---


def test_the_two_main_branches_bound_all_paths():
    heap = loose()
    kept = {"contact_angle": 0.3, "liquid": UNIT}
    suctions = np.geomspace(0.7, 30.0, 9)
    drying = [pl.wet(heap, suction=s, path="drying", **kept) for s in suctions]
    wetting = [pl.wet(heap, suction=s, path="wetting", **kept) for s in suctions]
    assert all(w.saturation < d.saturation for w, d in zip(wetting[2:-3], drying[2:-3], strict=True))
    step = drying[0]
    for suction, direct in zip(suctions[1:], drying[1:], strict=True):
        step = pl.wet(heap, suction=suction, start=step, **kept)
        assert step.liquid_volume == pytest.approx(direct.liquid_volume, rel=1e-12)
        assert step.book.before + step.book.supplied == pytest.approx(step.book.held + step.book.released)
    step = wetting[-1]
    for suction, direct in zip(suctions[-2::-1], wetting[-2::-1], strict=True):
        step = pl.wet(heap, suction=suction, start=step, **kept)
        assert step.liquid_volume == pytest.approx(direct.liquid_volume, rel=1e-12)
    scanning = drying[4]
    for k in (3, 2, 1):
        scanning = pl.wet(heap, suction=suctions[k], start=scanning, **kept)
        assert wetting[k].saturation <= scanning.saturation <= drying[k].saturation
    turned = pl.wet(heap, suction=suctions[4], start=scanning, **kept)
    assert wetting[4].saturation <= turned.saturation <= drying[4].saturation


def test_a_state_is_saved_and_taken_up(tmp_path):
    heap = loose(count=60)
    w = pl.wet(heap, 0.3, suction=2.0, liquid=UNIT)
    w.save(tmp_path / "state.npz")
    state = pl.load_state(tmp_path / "state.npz")
    assert np.array_equal(state.volume, w.bridges.volume)
    first = pl.wet(heap, 0.3, volume=0.0, liquid=UNIT, start=w)
    second = pl.wet(heap, 0.3, volume=0.0, liquid=UNIT, path=state)
    assert np.array_equal(first.bridges.volume, second.bridges.volume)
    assert np.array_equal(first.bridges.volume, w.bridges.volume)
    (tmp_path / "other.npz").write_bytes(b"nothing")
    with pytest.raises(ValueError, match="is not a state of a heap"):
        pl.load_state(tmp_path / "other.npz")


# --- given amounts ---


@pytest.mark.parametrize("path", ["drying", "wetting"])
def test_a_given_amount_finds_its_suction(path):
    heap = loose()
    kept = {"contact_angle": 0.3, "liquid": UNIT, "path": path}
    for suction in (1.0, 4.0, 16.0):
        w = pl.wet(heap, suction=suction, **kept)
        v = pl.wet(heap, saturation=w.saturation, **kept)
        assert v.liquid_volume == pytest.approx(w.liquid_volume, rel=1e-12)
        assert len(v.bridges) == len(w.bridges)
        assert v.suction == pytest.approx(suction, rel=1e-8)
    water = pl.Liquid(surface_tension=1.0, density=1000.0)
    w = pl.wet(heap, 0.3, saturation=0.02, liquid=water, grain_density=2500.0, path=path)
    for name in ("water_content", "mass_ratio", "mass_fraction", "liquid_volume"):
        v = pl.wet(heap, 0.3, **{name: getattr(w, name)}, liquid=water, grain_density=2500.0, path=path)
        assert v.saturation == pytest.approx(0.02, rel=1e-12)


def test_liquid_is_kept_through_ruptures_and_births():
    heap = loose()
    random = np.random.default_rng(SEED)
    w = pl.wet(heap, 0.3, saturation=0.03, liquid=UNIT)
    amount = w.liquid_volume
    counts = set()
    for turn in range(6):
        places = heap.positions + random.normal(0.0, 0.03, heap.positions.shape)
        moved = strained(pl.Packing(places, heap.radii, cell=heap.cell), 0.01 * (turn - 2) * np.eye(3))
        w = pl.wet(moved, 0.3, liquid_volume=amount, liquid=UNIT, start=w)
        assert w.liquid_volume + w.unheld == pytest.approx(amount, rel=1e-12)
        assert w.book.supplied == pytest.approx(0.0, abs=1e-12 * amount)
        assert np.ptp(w.bridges.suction) <= 1e-12 * w.suction
        counts.add(len(w.bridges))
    assert len(counts) > 3
    for turn in range(6):
        places = heap.positions + random.normal(0.0, 0.03, heap.positions.shape)
        moved = strained(pl.Packing(places, heap.radii, cell=heap.cell), 0.01 * turn * np.eye(3))
        volume = 0.0 if turn % 2 else 1e-3
        w = pl.wet(moved, 0.3, volume=volume, liquid=UNIT, start=w, rule="shared" if turn < 4 else "lost")
        book = w.book
        assert book.before + book.supplied == pytest.approx(book.held + book.released + book.unheld, rel=1e-12)


def test_liquid_of_a_step_goes_to_the_others_or_comes_from_them():
    """Three pairs: one touches, one stands apart."""
    heap = pl.Packing([(0, 0, 0), (2, 0, 0), (40, 0, 0), (42.1, 0, 0)], 1.0)
    rupture = float(pl.rupture(pl.Pair(1.0), suction=1.0, liquid=UNIT).separation)
    breaks = 1.0
    while pl.rupture(pl.Pair(1.0), suction=breaks, liquid=UNIT).separation > heap.positions[3, 0] - 42.0:
        breaks *= 1.01
    assert rupture > 0.1
    before = pl.wet(heap, 0.0, suction=breaks / 1.01, liquid=UNIT)
    after = pl.wet(heap, 0.0, suction=breaks, liquid=UNIT)
    assert (len(before.bridges), len(after.bridges)) == (2, 1)
    amount = 0.5 * (before.liquid_volume + after.liquid_volume)
    w = pl.wet(heap, 0.0, liquid_volume=amount, liquid=UNIT)
    assert len(w.bridges) == 1
    assert w.suction < before.suction
    assert w.liquid_volume == pytest.approx(amount, rel=1e-12)
    lost = pl.wet(heap, 0.0, liquid_volume=1e3, liquid=UNIT)
    assert lost.unheld > 0
    assert lost.liquid_volume + lost.unheld == pytest.approx(1e3, rel=1e-12)


def test_the_liquid_of_a_broken_bridge_is_shared_or_lost():
    """A chain of three: the second bridge breaks."""
    near = pl.Packing([(0, 0, 0), (2, 0, 0), (4, 0, 0)], 1.0)
    far = pl.Packing([(0, 0, 0), (2, 0, 0), (7, 0, 0)], 1.0)
    w = pl.wet(near, 0.3, volume=1e-2, liquid=UNIT)
    assert w.bridges.volume.tolist() == [1e-2, 1e-2]
    shared = pl.wet(far, 0.3, volume=0.0, liquid=UNIT, start=w)
    assert shared.bridges.volume == pytest.approx([2e-2])
    lost = pl.wet(far, 0.3, volume=0.0, liquid=UNIT, start=w, rule="lost")
    assert lost.bridges.volume == pytest.approx([1e-2])
    assert lost.book.released == pytest.approx(1e-2)
    apart = pl.Packing([(0, 0, 0), (5, 0, 0), (10, 0, 0)], 1.0)
    none = pl.wet(apart, 0.3, volume=0.0, liquid=UNIT, start=w)
    assert len(none.bridges) == 0
    assert none.unheld == pytest.approx(2e-2)


# --- bad input ---


def wet_one(**changes):
    given = {"positions": [(0, 0, 0), (2, 0, 0)], "radii": 1.0}
    packing = {name: changes.pop(name, given.get(name)) for name in ("positions", "radii")}
    packing |= {name: changes.pop(name) for name in ("cell", "periodic", "walls") if name in changes}
    heap = pl.Packing(**packing)
    return pl.wet(heap, changes.pop("angle", 0.1), **({"suction": 10.0, "liquid": UNIT} | changes))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"positions": [(0, 0, math.nan), (1, 1, 1)]}, r"positions\[0, 2\]: nan m is not a number"),
        ({"positions": [(0, 0), (1, 1)]}, r"positions: an array of shape \(2, 2\)"),
        ({"radii": [1.0, -1.0]}, r"radii\[1\]: -1.0 m is not > 0"),
        ({"radii": [1.0, 1.0, 1.0]}, r"radii: an array of shape \(3,\)"),
        ({"cell": (1, 2)}, r"cell: an array of shape \(2,\)"),
        ({"cell": (4, 4, 0)}, r"cell\[2\]: 0.0 m is not > 0"),
        ({"cell": [(1, 0, 0), (0, 1, 0), (1, 1, 0)]}, r"cell: its three vectors lie in a plane"),
        ({"cell": (4, 20, 20)}, r"cell: its width of 4 m along direction 0 is less than twice the reach"),
        ({"cell": (9, 9, 9), "periodic": (1, 0, 1)}, r"periodic: \(1, 0, 1\) is not"),
        ({"walls": [(0, 0, 0)]}, r"walls\[0\]: \(0, 0, 0\) is not a point and a normal"),
        ({"walls": [((0, 0, 1), (0, 0, 1))]}, r"walls\[0\]: the centre of grain 0 lies behind it"),
        ({"cell": (9, 9, 9), "walls": [((0, 0, -1), (0, 0, 1))]}, r"walls\[0\]: it stands across direction 2"),
        ({"positions": [(0, 0, 0), (0, 0, 0)]}, r"positions: grains 0 and 1 have the same centre"),
        ({"positions": [(0, 0, 0), (0.1, 0, 0)], "radii": [1.0, 0.5]}, r"positions: grain 1 lies inside grain 0"),
        ({"angle": [0.1, 0.2, 0.3]}, r"contact_angle: an array of shape \(3,\) .* each of 2 grains"),
        ({"angle": 20.0}, r"contact_angle: 20.0 rad is not in \[0, pi\)"),
        ({"suction": None}, r"control: none given; exactly one of suction, humidity"),
        ({"saturation": 0.1}, r"control: suction and saturation given"),
        ({"suction": 0.0}, r"suction: 0.0 Pa is not > 0"),
        ({"suction": None, "humidity": 1.2}, r"humidity: 1.2 is not in \(0, 1\)"),
        ({"suction": None, "volume": 0.0}, r"volume: 0.0 m\^3 is not > 0 without a state"),
        ({"suction": None, "mass_ratio": 0.1}, r"mass_ratio: needs grain_density and a liquid with a density"),
        ({"path": "sideways"}, r"path: 'sideways' is not one of"),
        ({"start": 3}, r"start: 3 is not a state of a heap"),
        ({"method": "zhao2020"}, r"method: 'zhao2020' is not one of"),
        ({"rule": "burnt"}, r"rule: 'burnt' is not one of"),
        ({"formation_distance": -1.0}, r"formation_distance: -1.0 m is not >= 0"),
        ({"liquid": 0.07}, r"liquid: 0.07 is not a pendular.Liquid"),
    ],
)
def test_bad_input_is_refused_in_one_line(changes, message):
    with pytest.raises(ValueError, match=f"^{message}") as refused:
        wet_one(**changes)
    assert "\n" not in str(refused.value)


def test_a_heap_without_pores_and_one_with_noise_are_told():
    full = pl.Packing([(0, 0, 0)], 2.0, cell=(3, 3, 3), periodic=False)
    with pytest.raises(ValueError, match="there are no pores"):
        pl.wet(full, 0.1, suction=1e3, liquid=UNIT)
    with pytest.warns(pl.PackingWarning, match="more than a bridge spans"):
        pl.wet(pl.Packing([(0, 0, 0), (1.95, 0, 0)], 1.0), 0.1, suction=1e2, liquid=UNIT)
    pl.wet(pl.Packing([(0, 0, 0), (2 - 1e-12, 0, 0)], 1.0), 1.7, suction=1e2, liquid=UNIT)  # no bridge, and no noise


def test_digits_that_hide_gaps_are_told():
    heap = loose(count=120)
    cut = pl.Packing(heap.positions.round(2), 0.99 * heap.radii, cell=heap.cell)
    pl.wet(cut, 0.3, suction=2.0, liquid=UNIT)
    with pytest.warns(pl.PackingWarning, match="^positions: their digits tell gaps to 0.01 m, no better than a bridge"):
        pl.wet(cut, 0.3, suction=500.0, liquid=UNIT)


def test_a_search_serves_narrower_ones():
    heap = loose(count=60)
    setting = setting_of(heap, 0.3, UNIT, 0.0, True, "auto")
    wide = pairs_at(setting, "suction", 1.0)
    narrow = pairs_at(setting, "suction", 10.0)
    fresh = pl.Packing(heap.positions, heap.radii, cell=heap.cell)
    again = pairs_at(setting_of(fresh, 0.3, UNIT, 0.0, True, "auto"), "suction", 10.0)
    assert len(wide.gap) > len(narrow.gap) >= len(again.gap)
    limit = again.gap.max()
    assert np.count_nonzero(narrow.gap <= limit) == len(again.gap)


def test_a_table_that_fails_leaves_its_bridges_to_the_exact_solver():
    """At a volume liquid between equal grains slides to one side from 31° on, and no table holds that."""
    heap = face_centred(3)
    w = pl.wet(heap, 0.9, volume=1e-4, liquid=UNIT, method="table", path="wetting")
    one = pl.bridge(pl.Pair(1.0, 0.9), 0.0, volume=1e-4, liquid=UNIT)
    np.testing.assert_allclose(w.bridges.force, one.force, rtol=1e-6)
    np.testing.assert_allclose(w.bridges.suction, one.suction, rtol=1e-6)
