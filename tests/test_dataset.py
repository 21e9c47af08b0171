"""The data base: its numbers against independent solutions, its stores, its interpolation."""

import re
import subprocess
import sys
import time
from collections import Counter

import dask
import numpy as np
import pytest
import xarray as xr
import zarr
from distributed import LocalCluster

import pendular as pl
from oracles.young_laplace import EXACT, Solid, connect, state
from pendular.dataset import base as ds
from pendular.dataset import interpolation, variables
from pendular.dataset import store as stores
from pendular.dataset.grid import GridPoint, Solids, grid_point

UNIT = pl.Liquid(surface_tension=1.0)
SMALL = {"shape": (24, 16), "size_ratio": (1.0, 8.0), "contact_angle": np.deg2rad([0.0, 40.0])}


@pytest.fixture(scope="module")
def paper():
    """Data base of the default resolution, in memory."""
    return ds.make_dataset()


@pytest.fixture
def short_chunks(monkeypatch):
    """Blocks of five rows, so that the small grid has five chunks a pair."""
    monkeypatch.setattr(stores, "_POINTS_PER_CHUNK", 80)


def refused(message: str):
    """Expect a ValueError that starts with this text."""
    return pytest.raises(ValueError, match=f"^{re.escape(message)}")


def spheres(ratio, theta):
    """Two spheres with a Derjaguin radius of 1."""
    small, large = 0.5 * (1.0 + 1.0 / ratio), 0.5 * (1.0 + ratio)
    return pl.Pair((small, large) if ratio > 1.0 else 1.0, theta)


def random_points(dataset, count, seed):
    """Indices of random points off the edges in Q."""
    generator = np.random.default_rng(seed)
    sizes = list(dataset.sizes.values())
    return np.column_stack(
        [generator.integers(0, n, count) for n in sizes[:3]] + [generator.integers(1, sizes[3] - 1, count)]
    )


# -- the numbers -----------------------------------------------------------------------------------------------------


def expected_point(ratio, theta, filling, neck_ratio):
    """The same bridge in 40 digits, and the size of what is subtracted in each variable; None if there is none."""
    mp = EXACT
    small, large = mp.mpf(1 + 1 / ratio) / 2, mp.mpf(1 + ratio) / 2
    radius = small * mp.sin(mp.mpf(filling))
    suction = 2 * (neck_ratio - mp.sin(mp.mpf(filling) + theta)) / (radius * (1 - mp.mpf(neck_ratio) ** 2))
    found = connect(mp, (Solid(small, theta), Solid(large, theta)), suction, small * mp.mpf(filling))
    if found is None or any(circle.slope <= 0 for circle in found.contacts):
        return None
    s, caps = state(found), [(c.cap_height, c.cap_volume) for c in found.contacts]
    heights, volumes = (sum(column) for column in zip(*caps, strict=True))
    values = {
        "suction_star": (suction, suction),
        "force_star": (s.force, s.force),
        "half_separation_star": (s.gap / 2, s.gap / 2 + heights),
        "volume_star": (s.volume, s.volume + volumes),
        "wetted_area_small_star": (s.wetted_areas[0], s.wetted_areas[0]),
        "wetted_area_large_star": (s.wetted_areas[1], s.wetted_areas[1]),
        "half_filling_angle_large": (found.contacts[1].filling_angle, 1),
        "surface_energy_star": (s.energy, s.area + sum(s.wetted_areas)),
        "grand_potential_star": (
            s.energy + suction * s.volume,
            s.area + sum(s.wetted_areas) + abs(suction) * (s.volume + volumes),
        ),
    }
    return {name: (float(value), abs(float(scale))) for name, (value, scale) in values.items()}


def test_points_against_forty_digits(paper):
    none = 0
    for index in random_points(paper, 40, seed=3):
        point = paper.isel(dict(zip(paper.sizes, index, strict=True)))
        expected = expected_point(*(float(point[name]) for name in paper.sizes))
        if expected is None:
            none += 1
            assert all(np.isnan(point[name]) for name in point)
            continue
        for name, (value, scale) in expected.items():
            assert abs(float(point[name]) - value) < 2e-12 * scale, (name, index)  # 2e-13 over 600 points
    assert 0 < none < 10


@pytest.mark.parametrize("ratio", ds.PAPER_RATIOS)
@pytest.mark.parametrize("theta", ds.PAPER_ANGLES)
def test_points_against_the_exact_solver(paper, ratio, theta):
    pair = paper.sel(size_ratio=ratio, contact_angle=theta)
    inside = (pair.half_separation_star >= 0.0) & (pair.suction_star > 0.0) & (pair.suction_star < 1e7)
    chosen = np.random.default_rng(5).choice(np.flatnonzero(inside), 60)
    suction, half, force, volume, area, energy = (
        pair[f"{name}_star"].to_numpy().ravel()[chosen]
        for name in ("suction", "half_separation", "force", "volume", "area_small", "surface_energy")
    )
    answers = [
        pl.bridge(spheres(ratio, theta), 2.0 * half, suction=suction, liquid=UNIT, branch=branch)
        for branch in ("stable", "unstable")
    ]
    # Beside the fold a rounding error of D is a root of it in λ; and where the gap is small beside the contact circle,
    # the rounding error of a slope is one of the gap.
    off = [np.where(b.exists, np.abs(b.force / (2.0 * np.pi * force) - 1.0), np.inf) for b in answers]
    assert np.quantile(np.min(off, axis=0), 0.95) < 1e-10
    assert np.min(off, axis=0).max() < 1e-6
    nearer = np.argmin(off, axis=0)
    for name, expected in (("volume", volume), ("surface_energy", energy)):
        measured = np.where(nearer == 0, *(getattr(b, name) for b in answers))
        assert np.quantile(np.abs(measured - expected) / (area if name == "surface_energy" else volume), 0.95) < 1e-10


def test_parts_add_up(paper):
    close = dict(rtol=1e-14, equal_nan=True)
    assert np.allclose(2.0 * paper.half_separation_star, paper.gap_small_star + paper.gap_large_star, **close)
    assert np.allclose(paper.volume_star, paper.volume_small_star + paper.volume_large_star, **close)
    area = paper.area_small_star + paper.area_large_star
    wetted = paper.wetted_area_small_star + paper.wetted_area_large_star
    assert np.allclose(paper.surface_energy_star, area - np.cos(paper.contact_angle) * wetted, atol=1e-15, **close)
    grand_potential = paper.surface_energy_star + paper.suction_star * paper.volume_star
    assert np.allclose(paper.grand_potential_star, grand_potential, atol=1e-15, **close)
    equal = paper.sel(size_ratio=1.0)
    for name in ("gap", "volume", "area", "wetted_area"):
        assert np.array_equal(equal[f"{name}_small_star"], equal[f"{name}_large_star"], equal_nan=True)
    missing = [np.isnan(paper[name].to_numpy()) for name in paper]
    assert all(np.array_equal(each, missing[0]) for each in missing)


def test_force_and_volume_are_slopes_of_the_grand_potential():
    """dΩ = 2πλ dD + V dH in any direction on the grid, whatever the sign of H, inflections included."""
    generator = np.random.default_rng(7)
    offsets, weights = np.array([-3, -2, -1, 1, 2, 3]), np.array([-1, 9, -45, 45, -9, 1]) / 60.0
    tested = 0
    for _ in range(300):
        ratio, theta = generator.choice(ds.PAPER_RATIOS), generator.choice(ds.PAPER_ANGLES)
        solids = Solids(2.0 * ratio / (1.0 + ratio), theta, 2.0 / (1.0 + ratio), theta)
        filling, neck_ratio = 10.0 ** generator.uniform(-3.0, 0.0), generator.uniform(0.05, 0.95)
        step = 1e-3 * min(neck_ratio, 1.0 - neck_ratio)
        steps = generator.choice([(1e-3 * filling, 0.0), (0.0, step)])
        points = [GridPoint(*grid_point(filling + i * steps[0], neck_ratio + i * steps[1], solids)) for i in offsets]
        here = GridPoint(*grid_point(filling, neck_ratio, solids))
        slope = {
            name: np.dot(weights, [getattr(p, name) for p in points])
            for name in ("half_separation", "curvature", "grand_potential")
        }
        if np.isnan(slope["grand_potential"]):
            continue
        tested += 1
        work = 4.0 * np.pi * here.force * slope["half_separation"] + here.volume * slope["curvature"]
        assert abs(slope["grand_potential"] - work) < 1e-9 * here.area_small  # 4e-11 over 6000 points
    assert tested > 200


def test_edges_are_not_bridges(paper):
    assert float(paper.neck_ratio[0]) == 0.0
    assert float(paper.neck_ratio[-1]) == 1.0
    assert np.degrees(paper.half_filling_angle[-1]) == pytest.approx(60.0, abs=1e-12)
    assert np.isnan(paper.isel(neck_ratio=[0, -1]).force_star).all()
    behind = paper.half_filling_angle + paper.contact_angle >= 0.5 * np.pi
    assert np.isnan(paper.force_star.where(behind)).all()
    assert float(np.isfinite(paper.force_star).mean()) > 0.85


def test_catenoids_are_on_the_grid():
    solids = Solids(1.0, 0.0, 1.0, 0.0)
    filling = 0.5
    point = GridPoint(*grid_point(filling, np.sin(filling), solids))
    neck = np.sin(filling) ** 2
    assert point.curvature == 0.0
    assert point.force == pytest.approx(neck, rel=1e-15)
    length = neck * np.arccosh(1.0 / np.sin(filling))
    assert point.half_separation == pytest.approx(length - 2.0 * np.sin(0.25) ** 2, rel=1e-14)
    rotated = 0.5 * np.pi * neck**2 * (length + 0.5 * neck * np.sinh(2.0 * length / neck))
    cap = np.pi * (1.0 - np.cos(filling)) ** 2 * (2.0 + np.cos(filling)) / 3.0
    assert point.volume == pytest.approx(2.0 * (rotated - cap), rel=1e-13)


# -- the stores ------------------------------------------------------------------------------------------------------


def test_labels_and_provenance(paper):
    for name in (*paper, *paper.coords):
        assert set(paper[name].attrs) == {"units", "long_name", "symbol"}, name
    assert paper.attrs["source"] == f"pendular {pl.__version__}"
    assert "Eq. 10" in paper.attrs["equations"]
    assert len(paper) == len(GridPoint._fields)


@pytest.mark.parametrize("suffix", ["zarr", "nc"])
def test_round_trip(tmp_path, suffix):
    memory = ds.make_dataset(**SMALL)
    path = tmp_path / f"bridges.{suffix}"
    ds.save_dataset(memory, path)
    with ds.load_dataset(path) as loaded:
        assert memory.identical(loaded)
    with refused(f"path: {path} exists already"):
        ds.save_dataset(memory, path)


def test_store_equals_memory(tmp_path, short_chunks):
    stored = ds.make_dataset(tmp_path / "bridges.zarr", **SMALL)
    assert ds.make_dataset(**SMALL).identical(stored)
    array = zarr.open_array(tmp_path / "bridges.zarr", path="force_star", mode="r")
    assert array.chunks == (1, 1, 5, 16)
    ds.save_dataset(stored, tmp_path / "bridges.nc")
    with ds.load_dataset(tmp_path / "bridges.nc") as copied:
        assert stored.identical(copied)


def test_small_pairs_share_a_chunk(tmp_path, monkeypatch):
    """Two of three angles in a chunk: a store that lost a chunk mends both, and the last chunk is not full."""
    grid = SMALL | {"contact_angle": np.deg2rad([0.0, 20.0, 40.0])}
    path, whole = tmp_path / "bridges.zarr", ds.make_dataset(**grid)
    monkeypatch.setattr(stores, "_POINTS_PER_CHUNK", 2 * 24 * 16 + 15)
    assert whole.identical(ds.make_dataset(path, **grid))
    assert zarr.open_array(path, path="force_star", mode="r").chunks == (1, 2, 24, 16)
    asked = []
    monkeypatch.setattr(stores, "compute", lambda *pair: asked.append(pair[:2]) or variables.compute(*pair))
    chunks_of(path, "force_star")[0].unlink()
    assert whole.identical(ds.make_dataset(path, **grid))
    assert asked == [(1.0, 0.0), (1.0, pytest.approx(np.deg2rad(20.0)))]


def test_an_interruption_costs_only_the_chunk_that_was_under_way(tmp_path, short_chunks, monkeypatch):
    path = tmp_path / "bridges.zarr"
    compute, calls = variables.compute, Counter()

    def interrupted(*args):
        calls["first"] += 1
        if calls["first"] > 7:
            raise KeyboardInterrupt
        return compute(*args)

    monkeypatch.setattr(stores, "compute", interrupted)
    with pytest.raises(KeyboardInterrupt):
        ds.make_dataset(path, **SMALL)
    with refused(f"path: only 35.4% of {path} is computed"):  # 34 of 96 rows: a pair ends with a chunk of 4
        ds.load_dataset(path)
    # A torn chunk: some of its variables are there, the mark is not.
    zarr.open_group(path, mode="r+")["force_star"][1, 0, 10:15] = -1.0

    def counted(*args):
        calls["second"] += 1
        return compute(*args)

    monkeypatch.setattr(stores, "compute", counted)
    continued = ds.make_dataset(path, **SMALL)
    assert calls["second"] == 20 - 7
    monkeypatch.setattr(stores, "compute", compute)
    assert ds.make_dataset(**SMALL).identical(continued)


def test_continuing_another_data_base_is_refused(tmp_path, monkeypatch):
    path = tmp_path / "bridges.zarr"
    ds.make_dataset(path, **SMALL)
    with refused(f"path: {path} holds a data base with other coordinates"):
        ds.make_dataset(path, **{**SMALL, "shape": (24, 17)})
    monkeypatch.setattr(variables, "version", lambda _: "0.0.1")
    with refused(f"path: {path} was written by pendular {pl.__version__}"):
        ds.make_dataset(path, **SMALL)


def test_a_local_cluster_gives_the_same_bits(tmp_path, short_chunks):
    distributed = ds.make_dataset(tmp_path / "bridges.zarr", workers=1, **SMALL)
    assert ds.make_dataset(**SMALL).identical(distributed)


def test_a_running_scheduler_is_used(tmp_path, short_chunks, capsys):
    with LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        path = tmp_path / "bridges.zarr"
        distributed = ds.make_dataset(path, workers=cluster.scheduler_address, progress=True, **SMALL)
    assert ds.make_dataset(**SMALL).identical(distributed)
    shown = capsys.readouterr()
    assert "100%" in shown.err
    assert shown.out == ""


# -- damage ----------------------------------------------------------------------------------------------------------


def test_a_scheduler_that_is_not_there(tmp_path):
    with dask.config.set({"distributed.comm.timeouts.connect": "1s"}), refused("workers: 'nohost:1' cannot be reached"):
        ds.make_dataset(tmp_path / "bridges.zarr", workers="nohost:1", **SMALL)
    assert not list(tmp_path.iterdir())


def flip(content):
    """One bit changed in the middle."""
    return content[: len(content) // 2] + bytes([content[len(content) // 2] ^ 1]) + content[len(content) // 2 + 1 :]


def chunks_of(store, variable):
    return sorted(path for path in (store / variable / "c").rglob("*") if path.is_file())


@pytest.mark.parametrize("variable", ["force_star", "size_ratio", "contact_angle"])
def test_a_missing_chunk_is_never_nan(tmp_path, short_chunks, variable):
    path = tmp_path / "bridges.zarr"
    ds.make_dataset(path, **SMALL)
    chunks_of(path, variable)[0].unlink()
    with refused(f"path: {path} is damaged: chunks of {variable} are missing; make_dataset mends it"):
        pl.load_dataset(path)


@pytest.mark.parametrize("damage", [lambda content: b"", flip, lambda content: content[:-5], None])
def test_a_damaged_chunk_is_computed_anew(tmp_path, short_chunks, damage):
    path = tmp_path / "bridges.zarr"
    ds.make_dataset(path, **SMALL)
    for chunk in chunks_of(path, "force_star")[::3]:
        chunk.write_bytes(damage(chunk.read_bytes())) if damage else chunk.unlink()
    if damage:
        with refused("dataset: it is damaged, or no data base: "):
            pl.interpolate(pl.load_dataset(path), "suction", 10.0, 0.0, 1.0, 0.0)
        with refused("dataset: it is damaged, or no data base: "):
            pl.save_dataset(pl.load_dataset(path), tmp_path / "bridges.nc")
        time.sleep(0.1)  # for threads that might go on
        assert [entry.name for entry in tmp_path.iterdir()] == ["bridges.zarr"]
    assert ds.make_dataset(path, **SMALL).identical(ds.make_dataset(**SMALL))


@pytest.mark.parametrize("content", [b"", b"{", b"{}", b'{"zarr_format": 3, "node_type": "group"}'])
def test_a_store_that_is_none(tmp_path, content):
    path = tmp_path / "bridges.zarr"
    path.mkdir()
    (path / "zarr.json").write_bytes(content)
    for ask in (pl.load_dataset, lambda path: ds.make_dataset(path, **SMALL)):
        with pytest.raises(ValueError, match=f"^path: {re.escape(str(path))} [^\n]*$"):
            ask(path)


@pytest.mark.parametrize("damage", [lambda b: b"", lambda b: b[: len(b) // 2], lambda b: b"no data base"])
def test_a_damaged_file(tmp_path, damage):
    path = tmp_path / "bridges.nc"
    pl.save_dataset(ds.make_dataset(**SMALL), path)
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(ValueError, match=rf"^path: {re.escape(str(path))} is damaged, or no data base: [^\n]*$"):
        pl.load_dataset(path)


def test_a_changed_bit_in_a_file(tmp_path):
    path = tmp_path / "bridges.nc"
    data = ds.make_dataset(**SMALL)
    pl.save_dataset(data, path)
    content = path.read_bytes()
    largest = np.nanmax(data.force_star).tobytes()
    assert content.count(largest) > 0
    path.write_bytes(content.replace(largest, flip(largest)))
    with refused("dataset: it is damaged, or no data base: "):
        pl.interpolate(pl.load_dataset(path), "suction", 10.0, 0.0, SMALL["size_ratio"], 0.0)


def test_a_file_of_something_else(tmp_path):
    path = tmp_path / "other.nc"
    xr.Dataset({"depth": ("x", [1.0])}).to_netcdf(path, engine="h5netcdf")
    with refused(f"path: {path} lacks size_ratio, and is no data base of make_dataset"):
        pl.load_dataset(path)


@pytest.mark.parametrize("name", ["bridges.zarr", "bridges.nc"])
def test_a_place_that_cannot_be_written(tmp_path, name):
    (tmp_path / "file").touch()
    path = tmp_path / "file" / name
    data = ds.make_dataset(**SMALL)
    with refused(f"path: '{path}' cannot be written: "):
        pl.save_dataset(data, path)
    if path.suffix == ".zarr":
        with refused(f"path: '{path}' cannot be written: "):
            ds.make_dataset(path, **SMALL)


def test_two_runs_may_make_one_store(tmp_path):
    path = tmp_path / "bridges.zarr"
    code = (
        f"from pendular import make_dataset as m; m({str(path)!r}, shape=(24, 16), size_ratio=1.0, contact_angle=0.0)"
    )
    runs = [subprocess.Popen([sys.executable, "-W", "error", "-c", code], stderr=subprocess.PIPE) for _ in range(4)]
    assert [run.communicate()[1] for run in runs] == [b""] * 4
    assert [run.returncode for run in runs] == [0] * 4
    alone = ds.make_dataset(shape=(24, 16), size_ratio=1.0, contact_angle=0.0)
    assert alone.identical(pl.load_dataset(path))
    assert [entry.name for entry in tmp_path.iterdir()] == ["bridges.zarr"]


def test_of_two_that_create_a_store_one_is_in_time(tmp_path, monkeypatch):
    path = tmp_path / "bridges.zarr"
    create = stores._write_empty

    def slow(*arguments):
        if not path.exists():
            monkeypatch.setattr(stores, "_write_empty", create)
            ds.make_dataset(path, **SMALL)
        create(*arguments)

    monkeypatch.setattr(stores, "_write_empty", slow)
    assert ds.make_dataset(path, **SMALL).identical(ds.make_dataset(**SMALL))
    assert [entry.name for entry in tmp_path.iterdir()] == ["bridges.zarr"]


# -- interpolation ---------------------------------------------------------------------------------------------------

# Largest relative errors of the default data base, with a margin of about 3 over what is measured on 1000 bridges each.
FORCE_BOUND = {"suction": 5e-5, "volume": 5e-4}
RUPTURE_BOUND = {"suction": 5e-6, "volume": 1e-4}


def test_interpolation_error_is_measured_and_bounded(paper):
    table = interpolation.interpolation_error(paper, samples=30)
    assert table.sizes == {"control": 2, "size_ratio": 4, "contact_angle": 3}
    for control in ("suction", "volume"):
        row = table.sel(control=control)
        assert float(row.largest_force_error.max()) < FORCE_BOUND[control]
        assert float(row.largest_rupture_error.max()) < RUPTURE_BOUND[control]
        assert float(row.median_force_error.max()) < 1e-6
    assert float(table.share_inside.min()) > 0.8
    # The fold at constant volume is on the other sheet there, and nowhere else.
    unseen = np.isnan(table.largest_rupture_error)
    assert np.array_equal(np.argwhere(unseen.to_numpy()), [[1, 1, 2], [1, 2, 2], [1, 3, 2]])
    linear = interpolation.interpolation_error(paper, samples=30, order="linear")
    assert 1e-3 < float(linear.largest_force_error.max()) < 2e-2


@pytest.mark.parametrize(
    ("suction", "degrees", "gap"),
    [
        (0.0, 0, 0.39935728051546767),
        (1.0, 0, 0.28108895921166809),
        (10.0, 20, 0.082466023241017988),
        (100.0, 40, 0.010472836652100414),
        (1e4, 0, 1.8815435545739513e-4),
        (1e6, 40, 1.5088344011891236e-6),
    ],
)
def test_rupture_of_equal_spheres(paper, suction, degrees, gap):
    theta = np.deg2rad(degrees)
    assert interpolation.interpolate_rupture(paper, "suction", suction, 1.0, theta) == pytest.approx(gap, rel=5e-6)
    assert interpolation.interpolate(paper, "suction", suction, 1.0001 * gap, 1.0, theta) == 0.0
    assert interpolation.interpolate(paper, "suction", suction, 0.9999 * gap, 1.0, theta) > 0.0


@pytest.mark.parametrize(
    ("volume", "degrees", "gap"),
    [(1e-6, 0, 0.010037989547464903), (1e-2, 0, 0.21904882198572414), (1e-3, 20, 0.11430831604265857)],
)
def test_rupture_at_constant_volume(paper, volume, degrees, gap):
    assert interpolation.interpolate_rupture(paper, "volume", volume, 1.0, np.deg2rad(degrees)) == pytest.approx(
        gap, rel=2e-6
    )


def test_force_under_pressure_and_in_an_overlap(paper):
    theta = np.deg2rad(20.0)
    for suction, gap in ((-0.5, 0.2), (-0.2, 0.0), (100.0, -0.002)):
        exact = pl.bridge(spheres(1.0, theta), gap, suction=suction, liquid=UNIT).force / (2.0 * np.pi)
        assert interpolation.interpolate(paper, "suction", suction, gap, 1.0, theta) == pytest.approx(exact, rel=2e-5)


def test_interpolation_broadcasts(paper):
    suction, gap = np.array([[10.0], [100.0]]), np.array([0.0, 0.005, 1.0])
    forces = interpolation.interpolate(paper, "suction", suction, gap, [[[1.0]], [[8.0]]], 0.0)
    assert forces.shape == (2, 2, 3)
    assert np.all(forces[..., 2] == 0.0)
    for (i, j, k), force in np.ndenumerate(forces):
        single = interpolation.interpolate(paper, "suction", suction[j, 0], gap[k], (1.0, 8.0)[i], 0.0)
        assert np.ndim(single) == 0
        assert single == force


def test_outside_the_grid_is_nan(paper):
    assert np.isnan(interpolation.interpolate(paper, "suction", 1e9, 1.99e-9, 1.0, 0.0))
    assert np.isnan(interpolation.interpolate_rupture(paper, "suction", 1e9, 1.0, 0.0))
    # At contact of a sphere with a large one under low suction the half-filling angle exceeds 60°.
    assert np.isnan(interpolation.interpolate(paper, "suction", 1.0, 0.0, 128.0, 0.0))


# -- bad input -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"shape": (7, 20)}, "shape[0]: 7.0 is not >= 8"),
        ({"shape": (20, 20, 20)}, "shape: (20, 20, 20) is not a pair"),
        ({"size_ratio": 0.5}, "size_ratio[0]: 0.5 is not >= 1"),
        ({"size_ratio": [2.0, 1.0]}, "size_ratio: [2.0, 1.0] is not an increasing list"),
        ({"contact_angle": 20.0}, "contact_angle: 20.0 rad is not in [0, pi); for degrees use numpy.deg2rad(20.0)"),
        ({"contact_angle": 1.7}, "contact_angle[0]: 1.7 rad is not in [0, 1.570796327)"),
        ({"workers": 2}, "workers: 2 given without a path"),
        ({"path": "bridges.nc"}, "path: bridges.nc does not end in .zarr"),
    ],
)
def test_bad_grids(arguments, message):
    with refused(message):
        ds.make_dataset(**arguments)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("humidity", 1.0, 0.0, 1.0, 0.0), "control: 'humidity' is not one of"),
        (("volume", 0.0, 0.0, 1.0, 0.0), "value_star: 0.0 is not > 0"),
        (("suction", 1.0, 0.0, 3.0, 0.0), "size_ratio: 3 is not in the data base, which holds [1.0, 2.0, 8.0, 128.0]"),
        (("suction", 1.0, 0.0, 1.0, 0.1), "contact_angle: 0.1 is not in the data base, which holds [0.0, "),
        (("suction", [1.0, 2.0], [0.0] * 3, 1.0, 0.0), "shapes do not broadcast"),
        (("suction", np.nan, 0.0, 1.0, 0.0), "value_star: nan is not a number"),
    ],
)
def test_bad_questions(paper, arguments, message):
    with refused(message):
        interpolation.interpolate(paper, *arguments)


def test_bad_files(tmp_path):
    with refused(f"path: {tmp_path / 'no.zarr'} does not exist"):
        ds.load_dataset(tmp_path / "no.zarr")
    with refused("path: bridges.csv ends neither in .zarr nor in .nc"):
        ds.save_dataset(xr.Dataset(), tmp_path / "bridges.csv")
    with refused("workers: 0.0 is not >= 1"):
        ds.make_dataset(tmp_path / "bridges.zarr", workers=0, **SMALL)
