"""Heaps and bridges written for other programs, read back by their libraries and by our own reader."""

from types import SimpleNamespace

import numpy as np
import pytest

import pendular as pl
from pendular.codes.grains.bridge_table import ends_of

SEED = 21
RNG = np.random.default_rng(SEED)
HEAP = pl.Packing(
    RNG.random((50, 3)) * 1e-2,
    RNG.uniform(1.0, 2.0, 50) * 1e-4,
    cell=[[1e-2, 0, 0], [1e-3, 1.1e-2, 0], [0, 2e-3, 1.2e-2]],
    periodic=(True, True, False),
    walls=[((0.0, 0.0, -1e-3), (0.0, 0.0, 1.0))],
)
BRIDGES = SimpleNamespace(
    pairs=np.array([[0, 1], [2, 30], [3, 50]]),
    image=np.array([[0, 0, 0], [1, -1, 0], [0, 0, 0]]),
    separation=np.array([1e-6, 2e-6, 3e-6]),
    force=np.array([1e-5, 2e-5, 3e-5]),
    volume=np.array([1e-15, 2e-15, 3e-15]),
    suction=np.broadcast_to(1e4, 3),
)


def same(heap):
    np.testing.assert_array_equal(heap.positions, HEAP.positions)
    np.testing.assert_array_equal(heap.radii, HEAP.radii)


def test_lines_end_where_the_partner_is():
    ends = ends_of(HEAP, BRIDGES)
    points = np.concatenate([HEAP.positions, ends.points])
    assert ends.lines.tolist() == [[0, 1], [2, 50], [3, 51]]
    image = HEAP.positions[30] + HEAP.cell[0] - HEAP.cell[1]
    np.testing.assert_allclose(points[50], image, rtol=1e-15)
    np.testing.assert_allclose(points[51], [*HEAP.positions[3, :2], -1e-3], rtol=1e-15)


@pytest.mark.parametrize("name", ["heap.vtu", "heap.vtp"])
@pytest.mark.parametrize("bridges", [None, BRIDGES], ids=["grains", "bridges"])
def test_vtk_comes_back(tmp_path, name, bridges):
    pl.write_packing(tmp_path / name, HEAP, bridges)
    heap = pl.read_packing(tmp_path / name)
    same(heap)
    np.testing.assert_array_equal(heap.cell, HEAP.cell)
    assert heap.periodic.tolist() == HEAP.periodic.tolist()


@pytest.mark.needs("grains")
def test_meshio_reads_grid(tmp_path):
    import meshio

    pl.write_packing(tmp_path / "heap.vtu", HEAP, BRIDGES)
    mesh = meshio.read(tmp_path / "heap.vtu")
    assert [(block.type, len(block.data)) for block in mesh.cells] == [("vertex", 50), ("line", 3)]
    np.testing.assert_array_equal(mesh.cells[1].data, ends_of(HEAP, BRIDGES).lines)
    np.testing.assert_array_equal(mesh.point_data["radius"], [*HEAP.radii, 0.0, 0.0])
    for name in ("separation", "force", "volume", "suction"):
        grains, lines = mesh.cell_data[name]
        assert np.isnan(grains).all()
        np.testing.assert_array_equal(lines, getattr(BRIDGES, name))


def test_csv(tmp_path):
    pl.write_packing(tmp_path / "heap.csv", HEAP, BRIDGES)
    same(pl.read_packing(tmp_path / "heap.csv"))
    text = (tmp_path / "heap_bridges.csv").read_text()
    assert (
        text.splitlines()[0] == "first,second,image_a,image_b,image_c,separation [m],force [N],volume [m3],suction [Pa]"
    )
    rows = np.loadtxt(text.splitlines()[1:], delimiter=",")
    np.testing.assert_array_equal(rows[:, :2], BRIDGES.pairs)
    np.testing.assert_array_equal(
        rows[:, 5:], np.column_stack([BRIDGES.separation, BRIDGES.force, BRIDGES.volume, [1e4] * 3])
    )


@pytest.mark.needs("data")
def test_labelled_arrays(tmp_path):
    import xarray

    pl.write_packing(tmp_path / "heap.nc", HEAP, BRIDGES)
    found = xarray.load_dataset(tmp_path / "heap.nc")
    xarray.testing.assert_identical(found, pl.packing_dataset(HEAP, BRIDGES))
    assert found.force.attrs["units"] == "N"
    assert dict(found.sizes) == {"grain": 50, "axis": 3, "vector": 3, "bridge": 3, "end": 2}


def test_refusals(tmp_path):
    for path, heap, told in (
        (tmp_path / "heap.xyz", HEAP, "does not end in .vtu, .vtp, .csv or .nc"),
        (tmp_path / "no" / "heap.csv", HEAP, "cannot be written: No such file"),
        (tmp_path / "heap.csv", 3, "heap: 3 is not a pendular.Packing"),
    ):
        with pytest.raises(ValueError, match=told):
            pl.write_packing(path, heap)
