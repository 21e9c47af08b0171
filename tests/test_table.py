"""The table against the exact solver, which it was made from, at bridges it was not made from."""

import math
import warnings
from contextlib import suppress

import numpy as np
import pytest

import pendular as pl
from pendular.table import arrays, kernels
from pendular.table.measure import Bound, Measured
from pendular.table.polynomial import cell_count

GAMMA = 0.0728
SEED = 20261122


@pytest.fixture(scope="module")
def table():
    return pl.tabulate(math.radians(20), reduced=(0.1, 1e5))


@pytest.fixture(scope="module")
def two_angles():
    return pl.tabulate((0.2, 0.9), reduced=(1.0, 1e3), tolerance=1e-7)


@pytest.fixture(scope="module")
def volume_table():
    return pl.tabulate(math.radians(20), "volume", reduced=(1e-3, 4e-3), radius_ratio=(1.5, 4), tolerance=1e-6)


@pytest.fixture(scope="module")
def all_volumes():
    return pl.tabulate(0.0, "volume", tolerance=1e-6)


@pytest.fixture(scope="module")
def volumes_of_two_angles():
    return pl.tabulate((0.2, 0.9), "volume", reduced=(1e-6, 1e-2), tolerance=1e-7)


def contacts(count, table, largest_ratio=8.0, beyond=1.0):
    """Random radii and controls in the range of a table, and gaps up to a share of the rupture distance."""
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    low_ratio = max(1.001, table.radius_ratio[0])
    radius1 = 10.0 ** random.uniform(-6, -4, count)
    radius2 = radius1 * random.uniform(low_ratio, min(largest_ratio, table.radius_ratio[1]), count)
    radius1, radius2 = np.where(random.uniform(size=count) < 0.5, (radius1, radius2), (radius2, radius1))
    mean = 2.0 * radius1 * radius2 / (radius1 + radius2)
    reduced = np.exp(random.uniform(*np.log(table.reduced), count))
    control = reduced * mean**3 if table.control == "volume" else reduced * GAMMA / mean
    rupture = table.rupture_distance(control, radius1, radius2, GAMMA)
    q = random.uniform(0.01, 1.0, count)
    return rupture * (1.0 - q * q) * beyond, control, radius1, radius2


def exact(table, separation, control, radius1, radius2):
    pair = pl.Pair((radius1, radius2), table.contact_angle)
    liquid = pl.Liquid(surface_tension=GAMMA)
    return pl.bridge(pair, separation, **{table.control: control}, liquid=liquid)


@pytest.mark.parametrize("name", ["table", "two_angles", "volume_table", "all_volumes", "volumes_of_two_angles"])
def test_bound_holds_in_si_units(name, request):
    table = request.getfixturevalue(name)
    x = contacts(400 if table.control == "volume" else 4000, table)
    bridge = exact(table, *x)
    contact = exact(table, 0.0, *x[1:])
    assert table.bound.force <= table.tolerance
    error = np.abs(table.force(*x, GAMMA) - bridge.force) / contact.force
    assert error.max() <= table.bound.force
    liquid = table.suction if table.control == "volume" else table.volume
    truth, at_contact = (getattr(b, "suction" if table.control == "volume" else "volume") for b in (bridge, contact))
    unit = GAMMA * np.sqrt(2.0 / (1.0 / x[2] + 1.0 / x[3]) / x[1]) if table.control == "volume" else at_contact
    assert (np.abs(liquid(*x, GAMMA) - truth) / unit).max() <= table.bound.liquid


ANGLES = [(0, 0), (20, 20), (40, 40), pytest.param((0, 60), marks=pytest.mark.long), (30, 75), (60, 10)]


def unseen(table, count, seed):
    """Random pairs of a table, planes and equal solids and ends of the ranges among them; each with its own gap."""
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    reduced = np.clip(np.exp(random.uniform(*np.log(table.reduced), count)), *table.reduced)
    least, most = 1.0 / table.radius_ratio[1], 1.0 / table.radius_ratio[0]
    ratio = most - (most - least) * random.uniform(0.0, 1.0, count) ** random.choice([0.3, 1.0, 3.0], count)
    for place, value in ((0, least), (1, most)):
        ratio[place::16] = value
    reduced[2::16], reduced[3::16] = table.reduced
    with np.errstate(divide="ignore"):
        radius1, radius2 = 0.5 * (1.0 + ratio), 0.5 * (1.0 + ratio) / ratio
    flipped = random.uniform(size=count) < 0.5
    radius1, radius2 = np.where(flipped, radius2, radius1), np.where(flipped, radius1, radius2)
    q = random.uniform(0.002, 1.0, count)
    q[::3] = 1.0 - 10.0 ** random.uniform(-5.0, 0.0, q[::3].size)
    q[::7], q[1::7] = 1.0, 0.002
    return reduced, radius1, radius2, np.clip(q, 0.002, 1.0)


def worst_over_bounds(table, count, seed):
    """Largest errors of force, rupture distance and liquid over their bounds, at R̄ = 1 and γ = 1."""
    reduced, radius1, radius2, q = unseen(table, count, seed)
    liquid = pl.Liquid(surface_tension=1.0)
    asked = (pl.Pair((radius1, radius2), table.contact_angle),)
    known = {table.control: reduced, "liquid": liquid}
    end = pl.rupture(*asked, **known).separation
    gap = end * (1.0 - q * q)
    bridge, contact = pl.bridge(*asked, gap, **known), pl.bridge(*asked, 0.0, **known)
    assert bridge.exists.all()
    other = "suction" if table.control == "volume" else "volume"
    unit = 1.0 / np.sqrt(reduced) if table.control == "volume" else contact.volume
    arguments = (reduced, radius1, radius2, 1.0)
    largest = np.maximum(np.abs(contact.force), np.abs(bridge.force))
    errors = (
        np.abs(table.force(gap, *arguments) - bridge.force) / largest,
        np.abs(table.rupture_distance(*arguments) / end - 1.0),
        np.abs(getattr(table, other)(gap, *arguments) - getattr(bridge, other)) / unit,
    )
    bounds = table.bound
    found = [e.max() / b for e, b in zip(errors, (bounds.force, bounds.rupture, bounds.liquid), strict=True)]
    print(f"{table.contact_angle} {table.control} {bounds} worst over bound {found}")
    return max(found)


@pytest.mark.parametrize("degrees", ANGLES)
def test_bounds_hold_at_places_that_were_not_searched(degrees):
    table = pl.tabulate(np.deg2rad(degrees), reduced=(0.05, 500.0), tolerance=1e-6)
    assert worst_over_bounds(table, 3000, SEED) <= 1.0


@pytest.mark.parametrize("tolerance", [1e-4, 1e-2])
@pytest.mark.parametrize(("degrees", "control"), [(0, "volume"), (20, "volume"), (20, "suction")])
def test_a_coarse_tolerance_is_reached_next_to_rupture_too(degrees, control, tolerance):
    table = pl.tabulate(np.deg2rad(degrees), control, tolerance=tolerance)
    assert table.bound.force <= tolerance
    assert worst_over_bounds(table, 3000, SEED) <= 1.0


@pytest.mark.long
def test_all_volumes_are_a_small_file(tmp_path):
    path = tmp_path / "v.npz"
    pl.tabulate(0.0, "volume").save(path)
    assert path.stat().st_size < 2e6


def test_the_cube_root_is_one():
    print(f"seed {SEED}")
    numbers = np.concatenate([10.0 ** np.random.default_rng(SEED).uniform(-60.0, 1.0, 2000), [1e-60, 1.0, 8.0]])
    roots = np.array([kernels.cube_root(number) for number in numbers.tolist()])
    assert np.abs(roots**3 / numbers - 1.0).max() < 1e-13


@pytest.mark.long
@pytest.mark.parametrize("control", ["suction", "volume"])
@pytest.mark.parametrize("degrees", ANGLES)
def test_bounds_hold_over_the_whole_range(degrees, control):
    ratios = (1.02, math.inf) if control == "volume" and degrees[0] == degrees[1] else (1.0, math.inf)
    reduced = {"suction": (1e-2, 1e8), "volume": (1e-9, 0.1)}[control]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pl.ToleranceWarning)  # the bound is what is tested
        table = pl.tabulate(np.deg2rad(degrees), control, reduced=reduced, radius_ratio=ratios)
    assert worst_over_bounds(table, 100_000, SEED) <= 1.0


@pytest.mark.parametrize("angles", [2.0, math.pi / 2, (0.5, math.pi - 0.4)])
def test_solids_that_no_suction_holds_have_no_force(angles):
    table = pl.tabulate(angles)
    gaps = [-1e-6, 0.0, 1e-9, math.inf]
    for radius2 in (1e-5, 3e-5, math.inf):
        asked = (1e4, 1e-5, radius2, GAMMA)
        assert table.force(gaps, *asked).tolist() == table.energy(gaps, *asked).tolist() == 4 * [0.0]
        assert table.rupture_distance(*asked) == 0.0
        assert np.isnan(table.volume(gaps, *asked)).all()
        assert np.isnan(table.stiffness(gaps, *asked)).all()
    assert table.curve(1e4, 1e-5, 2e-5, GAMMA).force(gaps).tolist() == 4 * [0.0]
    assert math.isnan(table.force(math.nan, 1e4, 1e-5, 1e-5, GAMMA))
    with pytest.raises(ValueError, match="reduced suction"):
        table.force(0.0, 1e14, 1e-5, 1e-5, GAMMA)


def test_volumes_without_a_bridge_at_contact_are_refused():
    angles = np.deg2rad([0.0, 120.0])
    with pytest.raises(ValueError, match=r"reduced: \(1e-09, 1\) ends above 0\.523\d*, the largest volume") as refused:
        pl.tabulate(angles, "volume")
    largest = float(str(refused.value).split("ends above ")[1].split(",")[0])
    pair, one = pl.Pair((0.5, math.inf), (0.0, math.radians(120.0))), pl.Liquid(surface_tension=1.0)
    below, above = (pl.bridge(pair, 0.0, volume=share * largest, liquid=one) for share in (0.99, 1.01))
    assert (below.exists, above.exists) == (True, False)
    with pytest.raises(ValueError, match=r"reduced: a volume of 0\.9 holds no bridge at contact"):
        pl.tabulate(angles, "volume", reduced=(0.9, 1.0))


def test_rupture_distance(table):
    _, control, radius1, radius2 = contacts(2000, table)
    pair = pl.Pair((radius1, radius2), table.contact_angle)
    fold = pl.rupture(pair, suction=control, liquid=pl.Liquid(surface_tension=GAMMA)).separation
    assert table.rupture_distance(control, radius1, radius2, GAMMA) == pytest.approx(fold, rel=1e-9)


def test_stiffness_is_that_of_the_bridge(table):
    x = contacts(500, table)
    bridge = exact(table, *x)
    mean = 2.0 * x[2] * x[3] / (x[2] + x[3])
    rupture = table.rupture_distance(*x[1:], GAMMA)
    far = x[0] < 0.99 * rupture
    error = np.abs(table.stiffness(*x, GAMMA) - bridge.stiffness) * rupture / (GAMMA * mean)
    assert error[far].max() < 1e-5


@pytest.mark.parametrize("name", ["table", "volume_table"])
def test_force_is_the_rate_of_the_energy(name, request):
    table = request.getfixturevalue(name)
    x = contacts(300, table)
    inside = x[0] < 0.98 * table.rupture_distance(*x[1:], GAMMA)
    separation, control, radius1, radius2 = (operand[inside] for operand in x)
    step = 1e-5 * separation
    higher, lower = (table.energy(separation + s, control, radius1, radius2, GAMMA) for s in (step, -step))
    force = table.force(separation, control, radius1, radius2, GAMMA)
    assert (higher - lower) / (2.0 * step) == pytest.approx(force, rel=1e-5)


def test_energy_is_the_grand_potential_below_that_at_rupture(table):
    x = contacts(300, table)
    pair = pl.Pair((x[2], x[3]), table.contact_angle)
    end = pl.rupture(pair, suction=x[1], liquid=pl.Liquid(surface_tension=GAMMA))
    work = end.grand_potential - exact(table, *x).grand_potential
    largest = end.grand_potential - exact(table, 0.0, *x[1:]).grand_potential
    assert np.max(np.abs(-table.energy(*x, GAMMA) - work) / largest) < 1e-7


def test_plane_and_equal_spheres(table):
    for radii in ((1e-5, math.inf), (math.inf, 1e-5), (1e-5, 1e-5)):
        bridge = exact(table, 1e-7, 1e4, *radii)
        assert table.force(1e-7, 1e4, *radii, GAMMA) == pytest.approx(bridge.force, rel=1e-7)


def test_exchange_of_the_solids(two_angles):
    mirrored = pl.tabulate(two_angles.contact_angle[::-1], reduced=(1.0, 1e3), tolerance=1e-7)
    separation, control, radius1, radius2 = contacts(500, two_angles)
    here = two_angles.force(separation, control, radius1, radius2, GAMMA)
    assert mirrored.force(separation, control, radius2, radius1, GAMMA) == pytest.approx(here, rel=1e-6)


def test_nothing_beyond_rupture(table):
    rupture = table.rupture_distance(1e4, 1e-5, 2e-5, GAMMA)
    gaps = [rupture * 1.0000001, 1.0, math.inf]
    assert table.force(gaps, 1e4, 1e-5, 2e-5, GAMMA).tolist() == [0.0, 0.0, 0.0]
    assert table.energy(gaps, 1e4, 1e-5, 2e-5, GAMMA).tolist() == [0.0, 0.0, 0.0]
    assert np.isnan(table.volume(gaps, 1e4, 1e-5, 2e-5, GAMMA)).all()
    assert np.isnan(table.stiffness(gaps, 1e4, 1e-5, 2e-5, GAMMA)).all()


def test_overlap_counts_as_contact(table):
    force = table.force([0.0, -1e-8, -1e-6], 1e4, 1e-5, 2e-5, GAMMA)
    assert force[0] == force[1] == force[2] > 0.0
    energy = table.energy([0.0, -1e-8], 1e4, 1e-5, 2e-5, GAMMA)
    assert energy[0] - energy[1] == pytest.approx(force[0] * 1e-8, rel=1e-6)


@pytest.mark.parametrize("place", range(5))
def test_nan_in_nan_out(table, place):
    arguments = [1e-7, 1e4, 1e-5, 2e-5, GAMMA]
    arguments[place] = math.nan
    assert math.isnan(table.force(*arguments))
    assert math.isnan(kernels.force(table.grid, *arguments))
    out = np.empty(3)
    operands = tuple(np.array([argument]) for argument in arguments)
    arrays.evaluate(arrays.FORCE, table.grid, operands, out)
    assert np.isnan(out).all()


@pytest.mark.parametrize("name", ["table", "two_angles", "volume_table", "all_volumes", "volumes_of_two_angles"])
def test_whatever_is_asked_only_cells_of_the_table_are_read(name, request):
    asked = request.getfixturevalue(name)
    rng = np.random.default_rng(SEED)
    control = 5e-18 if asked.control == "volume" else 1e4
    numbers, cells = arrays.block_room(500)
    for row, usual in enumerate((1e-7, control, 1e-5, 2e-5, GAMMA)):
        numbers[row] = rng.choice([usual, usual, usual, -usual, 0.0, 1e-300, 1e300, math.inf, -math.inf, math.nan], 500)
    with np.errstate(all="ignore"):
        arrays.answer_block(arrays.FORCE, asked.grid, numbers, cells, 500)
    assert np.all((cells[2] >= 0) & (cells[2] < cell_count(asked.grid.force))), f"seed {SEED}"
    assert 0 < np.isnan(numbers[-1]).sum() < 500


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.0, 1e12, 1e-5, 1e-5, GAMMA), "reduced suction"),
        ((0.0, 0.0, 1e-5, 1e-5, GAMMA), "reduced suction: 0 is not in"),
        ((0.0, -1e4, 1e-5, 1e-5, GAMMA), "reduced suction: -"),
    ],
)
def test_outside_the_range_is_refused(table, arguments, message):
    with pytest.raises(ValueError, match=message):
        table.force(*arguments)


def test_size_ratio_outside_the_range_is_refused(volume_table):
    with pytest.raises(ValueError, match=r"radius ratio: 1 is not in \[1.5, 4\]"):
        volume_table.force(0.0, 1e-18, 1e-5, 1e-5, GAMMA)


def test_scalar_kernel_is_the_array(table):
    x = contacts(300, table, beyond=1.05)
    force = table.force(*x, GAMMA)
    one_by_one = [kernels.force(table.grid, *row, GAMMA) for row in np.column_stack(x).tolist()]
    assert one_by_one == pytest.approx(force, rel=1e-9, abs=1e-9 * np.abs(force).max())


def test_threads_change_nothing(table):
    x = contacts(200_000, table)
    whole = table.force(*x, GAMMA)
    parts = [table.force(*(operand[i : i + 977] for operand in x), GAMMA) for i in range(0, 200_000, 977)]
    assert np.array_equal(whole, np.concatenate(parts))


def test_out_is_filled(table):
    out = np.empty(3)
    assert table.force([0.0, 1e-8, 1e-7], 1e4, 1e-5, 1e-5, GAMMA, out=out) is not None
    assert out.tolist() == table.force([0.0, 1e-8, 1e-7], 1e4, 1e-5, 1e-5, GAMMA).tolist()
    with pytest.raises(ValueError, match=r"out: is not a contiguous float64 array of shape \(3,\)"):
        table.force([0.0, 1e-8, 1e-7], 1e4, 1e-5, 1e-5, GAMMA, out=np.empty(4))


@pytest.mark.parametrize("control", [1e3, 1e5, 1e8])
def test_curve_is_the_table_at_one_pair(table, control):
    curve = table.curve(control, 1e-5, 3e-5, GAMMA)
    gaps = np.linspace(-0.1, 1.1, 1000) * curve.rupture_distance
    force = table.force(gaps, control, 1e-5, 3e-5, GAMMA)
    assert np.abs(curve.force(gaps) - force).max() < table.tolerance * force[0]
    assert curve.force(math.inf) == 0.0
    assert math.isnan(curve.force(math.nan))
    with pytest.raises(ValueError, match="reduced suction"):
        table.curve(1e15, 1e-5, 3e-5, GAMMA)


def test_file_gives_the_same_table(table, tmp_path):
    path = tmp_path / "glass.npz"
    table.save(path)
    loaded = pl.load_table(path)
    assert path.stat().st_size < 5e6
    assert (loaded.bound, loaded.contact_angle, loaded.reduced) == (table.bound, table.contact_angle, table.reduced)
    x = contacts(100, table)
    assert np.array_equal(loaded.force(*x, GAMMA), table.force(*x, GAMMA))


def test_damaged_file_is_refused(volume_table, tmp_path):
    path = tmp_path / "t.npz"
    volume_table.save(path)
    whole = path.read_bytes()
    for place in np.linspace(50, len(whole) - 50, 40).astype(int):
        damaged = bytearray(whole)
        damaged[place] ^= 0x10
        path.write_bytes(damaged)
        with suppress(ValueError):  # unless the byte is of the archive's own directory and says nothing about the table
            assert all(map(np.array_equal, pl.load_table(path).grid.force, volume_table.grid.force))
    path.write_bytes(whole[:-100])
    with pytest.raises(ValueError, match=r"path: '.*t.npz' is not a table, or damaged"):
        pl.load_table(path)
    path.write_bytes(b"no table")
    with pytest.raises(ValueError, match="is not a table, or damaged"):
        pl.load_table(path)


def test_a_bound_that_is_not_reached_is_said(monkeypatch):
    reached = Measured(np.array([[3e-6, 1e-9, 1e-5]]), np.array([1]))
    monkeypatch.setattr("pendular.table.table.measure", lambda grid, task, parts, searched=None: reached)
    with pytest.warns(pl.ToleranceWarning, match="error of the force is 3.0e-06, not below 1.0e-06"):
        table = pl.tabulate(0.3, reduced=(20.0, 30.0), radius_ratio=(1, 2), tolerance=1e-6)
    assert table.bound == Bound(force=3e-6, rupture=1e-9, liquid=1e-5, bridges=1)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"control": "humidity"}, "control: 'humidity' is not one of"),
        ({"reduced": (2.0, 1.0)}, "reduced: .* is not two ascending numbers"),
        ({"reduced": (0.0, 1.0)}, "reduced"),
        ({"radius_ratio": (0.5, 2.0)}, "radius_ratio"),
        ({"tolerance": 1e-20}, "tolerance"),
    ],
)
def test_bad_input(options, message):
    with pytest.raises(ValueError, match=message):
        pl.tabulate(0.3, **options)
