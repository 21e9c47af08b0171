"""Retention curves of a heap, their command and their pictures."""

import json
from functools import partial

import numpy as np
import pytest

import pendular as pl
from pendular.packing.blocks import wet_in_blocks
from pendular.packing.pictures import draw_heap
from pendular.packing.rendering import image_of, view_of
from pendular.packing.retention import QUANTITIES, retention_of
from pendular.packing.scene import scene_image
from pendular.packing.setting import setting_of
from test_packing import SEED, UNIT, body_centred, face_centred, loose, simple_cubic

WATER = pl.Liquid.water()


@pytest.mark.needs("data")
def test_curves_are_what_single_steps_lead_to():
    heap = loose(count=120)
    suctions = np.geomspace(0.6, 30.0, 7)
    turn = 4.0
    r = pl.retention(heap, 0.3, suctions, liquid=UNIT, reversals=[turn])
    assert r.saturation.dims == ("path", "suction")
    assert set(QUANTITIES) <= set(r.data_vars)
    names = r.path.values.tolist()
    assert names == ["drying", "wetting", "wetting from 4 Pa", "drying from 4 Pa"]
    for name, path, order in ((names[2], "drying", suctions[::-1]), (names[3], "wetting", suctions)):
        w = pl.wet(heap, 0.3, suction=turn, liquid=UNIT, path=path)
        for suction in order:
            on_the_way = suction <= turn if path == "drying" else suction >= turn
            value = float(r.saturation.sel(path=name, suction=suction))
            if not on_the_way:
                assert np.isnan(value)
                continue
            w = pl.wet(heap, 0.3, suction=suction, liquid=UNIT, start=w)
            assert value == pytest.approx(w.saturation, rel=1e-12)
            np.testing.assert_allclose(r.stress.sel(path=name, suction=suction), w.stress, rtol=1e-12, atol=1e-12)
    for path in names[:2]:
        for suction in suctions:
            w = pl.wet(heap, 0.3, suction=suction, liquid=UNIT, path=path)
            here = r.sel(path=path, suction=suction)
            assert float(here.saturation) == pytest.approx(w.saturation, rel=1e-12)
            assert float(here.chi) == pytest.approx(w.chi, rel=1e-12)
            assert float(here.coordination) == w.coordination
            assert float(here.meeting_grains) == w.meetings.grains
    limit = float(r.pendular_limit.sel(path="drying"))
    assert limit == pytest.approx(pl.pendular_limit(heap, 0.3, liquid=UNIT), rel=1e-8)


@pytest.mark.parametrize(
    ("heap", "degrees", "limit"),
    [(simple_cubic(), 0.0, 0.9458), (face_centred(), 0.0, 4.5335), (face_centred(), 20.0, 2.8099)],
)
def test_the_pendular_limit_of_lattices(heap, degrees, limit):
    found = pl.pendular_limit(heap, np.deg2rad(degrees), liquid=UNIT, path="wetting")
    assert found == pytest.approx(limit, abs=6e-5)


def test_second_neighbours_set_the_limit_on_drying():
    assert pl.pendular_limit(body_centred(), 0.0, liquid=UNIT) >= pl.pendular_limit(
        body_centred(), 0.0, liquid=UNIT, path="wetting", condensation=False
    )


def test_bad_suctions_are_refused():
    setting = setting_of(simple_cubic(), 0.1, UNIT, 0.0, True, "auto")
    with pytest.raises(ValueError, match=r"suctions\[0\]: -1.0 Pa is not > 0"):
        retention_of(setting, [-1.0, 2.0], None)
    with pytest.raises(ValueError, match=r"reversals\[0\]: 9.0 is not|reversals\[0\]: 9.0 Pa is not in \[1, 3\]"):
        retention_of(setting, [1.0, 3.0], [9.0])


# --- the command ---


@pytest.fixture
def run(run):
    """Run `pendular packing`."""
    return partial(run, "packing")


def test_the_command_tells_a_state(run):
    status, output, errors = run(
        "--made", "fcc", "--contact-angle", "20", "--suction", "20kPa", "--stress", "--friction-angle", "30"
    )
    assert (status, errors) == (0, "")
    heap = pl.lattice_packing("face_centred_cubic", 4, 50e-6)
    w = pl.wet(heap, np.deg2rad(20), suction=20e3, liquid=WATER)
    assert f"{pl.pendular_limit(heap, np.deg2rad(20), liquid=WATER) / 1e3:.4g} kPa" in output
    for text in (
        "256 grains of radius 50 µm, solid fraction 0.7405",
        f"{w.porosity:.4f}",
        f"{100 * w.saturation:.4g} %",
        f"{w.chi:.4g}",
    ):
        assert text in output
    assert "cohesion" in output
    assert "no two bridges meet" in output


def test_the_command_gives_numbers_to_machines(run):
    status, output, _ = run("--made", "sc", "--saturation", "0.1%", "--json")
    assert status == 0
    answer = json.loads(output)
    assert answer["saturation"] == pytest.approx(1e-3, rel=1e-12)
    assert answer["mass_ratio"] is None
    heap = pl.lattice_packing("simple_cubic", 4, 50e-6)
    assert answer["pendular_limit"] == pytest.approx(pl.pendular_limit(heap, 0.0, liquid=WATER), rel=1e-8)
    status, output, _ = run("--made", "sc", "--suction", "20kPa", "--csv")
    rows = output.splitlines()
    assert len(rows) == 1 + 3 * 64
    assert rows[0].startswith("first,second,image_1")


def test_one_command_on_a_dump_gives_curves_and_a_picture(run, tmp_path, capsys):
    heap = loose(count=60, seed=SEED + 1)
    dump, picture = tmp_path / "grains.dump", tmp_path / "r.svg"
    lines = ["ITEM: TIMESTEP", "0", "ITEM: NUMBER OF ATOMS", str(heap.count), "ITEM: BOX BOUNDS pp pp pp"]
    lines += [f"0 {float(heap.cell[k, k])!r}" for k in range(3)] + ["ITEM: ATOMS id type radius x y z"]
    lines += [
        f"{i + 1} 1 {float(heap.radii[i])!r} " + " ".join(repr(float(x)) for x in heap.positions[i])
        for i in range(heap.count)
    ]
    dump.write_text("\n".join(lines) + "\n")
    capsys.readouterr()
    status, output, errors = run(
        str(dump), "--unit", "mm", "--retention", "60Pa", "2kPa", "--points", "8", "--csv", "--plot", str(picture)
    )
    assert (status, errors) == (0, "")
    assert picture.read_text().startswith("<?xml")
    rows = [line.split(",") for line in output.splitlines()]
    paths = {row[0] for row in rows[1:]}
    assert len(paths) == 4
    first = {row[0]: float(row[2]) for row in rows[1:] if float(row[1]) == pytest.approx(60.0)}
    assert first["wetting"] < first["drying"]


def test_the_command_doubts_large_grains_of_a_file_without_a_unit(run, tmp_path):
    file = tmp_path / "grains.txt"
    file.write_text("0 0 0 0.05\n0 0 0.1 0.05\n")
    status, _, errors = run(str(file), "--suction", "20Pa")
    assert status == 0
    assert errors == ("pendular: warning: unit: grains have a radius of 50 mm; if not, say what the file's 1 means\n")
    assert run(str(file), "--suction", "20kPa", "--unit", "mm")[2] == ""


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--made", "diamond"], "made: 'diamond' is not one of loose, close, sc, bcc, fcc, hcp"),
        (["--made", "sc", "--suction", "2"], "suction: '2' has no unit; write it like 2kPa"),
        (["--made", "sc", "--suction", "2kPa", "--humidity", "90%"], "control: suction and humidity given"),
        (
            ["--made", "sc", "--suction", "2kPa", "--retention", "1kPa", "2kPa"],
            "retention: given together with suction",
        ),
        (["--made", "sc", "--retention", "2kPa", "2kPa"], "retention: 2kPa and 2kPa are not two different suctions"),
        (["--unit", "mm"], "unit: has no effect without a file"),
        (["nothing.dump"], "path: 'nothing.dump' is not a file"),
        (["--made", "sc", "--retention", "1kPa", "2kPa", "--out", "a.vtu"], "out: writes one state"),
    ],
)
def test_the_command_refuses_in_one_line(run, arguments, message):
    status, output, errors = run(*arguments)
    assert (status, output) == (2, "")
    assert errors.startswith(f"pendular: {message}")
    assert errors.count("\n") == 1


# --- the picture ---


def test_grains_and_bridges_are_drawn_to_scale():
    """Two touching grains side by side: the picture is as wide as both, the liquid as wide as its contact circles."""
    w = pl.wet(pl.Packing([(0, 0, 0), (2, 0, 0)], 1.0), 0.3, suction=2.0, liquid=UNIT)
    view = view_of(w)._replace(axes=np.array([(1.0, 0, 0), (0, 0, 1.0), (0, -1.0, 0)]), low=np.array([-1.0, -1.0]))
    view = view._replace(size=np.array([4.0, 2.0]))
    image = image_of(w, view, 800, (np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), np.array([0, 1.0, 0])))
    assert image.shape == (400, 800, 3)
    grain, liquid = image[..., 0] > 0, image[..., 2] > 0
    grains = np.flatnonzero(grain.any(axis=0))
    assert (grains[0], grains[-1]) == (0, 799)
    rows = np.flatnonzero(liquid.any(axis=1)) / 200.0 - 1.0
    circle = float(np.sin(w.bridges.half_filling_angle[0, 0]))
    assert rows[-1] == pytest.approx(circle, abs=0.02)
    columns = np.flatnonzero(liquid.any(axis=0)) / 200.0 - 2.0
    height = 1.0 - float(np.cos(w.bridges.half_filling_angle[0, 0]))
    assert columns[-1] == pytest.approx(height, abs=0.02)
    neck = np.flatnonzero(liquid[:, 400]) / 200.0 - 1.0
    exact = pl.bridge(pl.Pair(1.0, 0.3), 0.0, suction=2.0, liquid=UNIT).neck_radius
    assert neck[-1] == pytest.approx(exact, abs=0.02)
    assert len(draw_heap(w, "two grains").axes) == 1


@pytest.mark.needs("pictures")
def test_pyvista_draws_the_same_picture():
    """Two ways to draw: pixels of our own and a mesh of VTK."""
    heap = pl.Packing(
        [(0, 0, 1), (2, 0, 1), (1, 1.9, 1.5), (3, 2, 2)], [1, 1, 1.2, 0.7], walls=[((0, 0, 0), (0, 0, 1))]
    )
    w = pl.wet(heap, 0.3, suction=2.0, liquid=UNIT)
    colours = np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), np.array([0, 1.0, 0])
    view = view_of(w)
    theirs, ours = scene_image(w, view, 300, colours), np.clip(image_of(w, view, 300, colours), 0.0, 1.0)
    if theirs is None:
        pytest.skip("PyVista cannot draw here: no driver of OpenGL")
    assert theirs.shape == ours.shape
    for k in range(3):  # grains, bridges, ground
        differ = (theirs[..., k] > 0.25) != (ours[..., k] > 0.25)
        print("pixels that differ:", np.count_nonzero(differ), "of", np.count_nonzero(ours[..., k] > 0.25))
        assert np.count_nonzero(differ) < 0.02 * differ.size
        assert np.count_nonzero(ours[..., k] > 0.25) > 500


@pytest.mark.needs("pictures")
def test_a_picture_without_a_driver_is_drawn_all_the_same(monkeypatch):
    monkeypatch.setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent")
    monkeypatch.setenv("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    w = pl.wet(pl.Packing([(0, 0, 0), (2, 0, 0)], 1.0), 0.3, suction=2.0, liquid=UNIT)
    assert scene_image(w, view_of(w), 50, 3 * (np.zeros(3),)) is None
    assert len(draw_heap(w).axes) == 1


# --- blocks ---


@pytest.mark.parametrize("path", ["drying", "wetting"])
@pytest.mark.parametrize("blocks", [(1, 1, 1), (2, 1, 3), (3, 3, 2)])
def test_blocks_add_up_to_the_heap(path, blocks):
    heap = loose(count=700, density=0.5)
    w = pl.wet(heap, 0.3, suction=2.0, liquid=UNIT, path=path)
    total = wet_in_blocks(heap, 0.3, suction=2.0, liquid=UNIT, blocks=blocks, path=path)
    assert (total.grains, total.bridges) == (heap.count, len(w.bridges))
    assert total.coordination == pytest.approx(w.coordination, rel=1e-14)
    for name in ("saturation", "water_content", "porosity", "interface_area", "chi"):
        assert getattr(total, name) == pytest.approx(getattr(w, name), rel=1e-11), name
    np.testing.assert_allclose(total.stress, w.stress, atol=1e-11 * abs(w.stress).max())
    assert total.meeting_grains == w.meetings.grains > 0.0


@pytest.mark.parametrize("path", ["drying", "wetting"])
def test_blocks_with_walls_and_angles_by_grain_add_up(path):
    """A slab between two walls, of grains with three contact angles and walls with their own."""
    heap = loose(count=700, density=0.5)
    height = heap.cell[2, 2]
    inside = heap.positions - np.floor(heap.positions / np.diag(heap.cell)) * np.diag(heap.cell)
    kept = np.flatnonzero((inside[:, 2] > heap.radii) & (inside[:, 2] < height - heap.radii))
    touching = np.argsort(inside[kept, 2] - heap.radii[kept])[:3]
    inside[kept[touching], 2] = heap.radii[kept[touching]]
    walls = [((0, 0, 0), (0, 0, 1)), ((0, 0, height), (0, 0, -1))]
    slab = pl.Packing(inside[kept], heap.radii[kept], heap.cell, (True, True, False), walls)
    random = np.random.default_rng(SEED)
    angles = np.append(random.choice([0.2, 0.5, 0.9], slab.count), [0.1, 0.7])
    w = pl.wet(slab, angles, suction=1.0, liquid=UNIT, path=path)
    at_wall = np.count_nonzero(w.bridges.pairs[:, 1] >= slab.count)
    assert at_wall > (10 if path == "drying" else 2)
    totals = [
        wet_in_blocks(slab, angles, suction=1.0, liquid=UNIT, blocks=blocks, path=path)
        for blocks in ((1, 1, 1), (2, 2, 1), (1, 2, 2))
    ]
    order = random.permutation(slab.count)

    def grains_in(low, high):
        chosen = order[np.all((slab.positions[order] >= low) & (slab.positions[order] < high), axis=1)]
        return slab.positions[chosen], slab.radii[chosen], chosen

    given = {"cell": np.diag(slab.cell), "periodic": slab.periodic.tolist(), "walls": walls, "radius_range": (1, 2)}
    totals.append(wet_in_blocks(grains_in, angles, suction=1.0, liquid=UNIT, blocks=(2, 1, 2), path=path, **given))
    for total in totals:
        assert (total.grains, total.bridges) == (slab.count, len(w.bridges))
        for name in ("saturation", "porosity", "interface_area", "chi", "coordination"):
            assert getattr(total, name) == pytest.approx(getattr(w, name), rel=1e-11), name
        np.testing.assert_allclose(total.stress, w.stress, atol=1e-11 * abs(w.stress).max())
        assert total.meeting_grains == w.meetings.grains > 0.0


def test_an_open_heap_goes_by_blocks():
    periodic = loose(count=300, density=0.5)
    heap = pl.Packing(periodic.positions - 7.0, periodic.radii)
    w = pl.wet(heap, 0.3, suction=2.0, liquid=UNIT)
    total = wet_in_blocks(heap, 0.3, suction=2.0, liquid=UNIT, blocks=(2, 1, 2))
    assert (total.grains, total.bridges) == (heap.count, len(w.bridges))
    assert total.saturation == pytest.approx(w.saturation, rel=1e-11)
    np.testing.assert_allclose(total.stress, w.stress, atol=1e-11 * abs(w.stress).max())


def test_blocks_that_are_too_narrow_are_refused():
    with pytest.raises(ValueError, match="blocks: 5 along direction 0 are narrower than twice their halo"):
        wet_in_blocks(loose(count=60), 0.3, suction=2.0, liquid=UNIT, blocks=(5, 1, 1))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"contact_angle": [0.1, 0.2]}, r"contact_angle: an array of shape \(2,\) is not one angle nor one for each"),
        ({"cell": (9, 9, 9)}, "cell: has no effect beside a Packing"),
        ({"blocks": 2}, "blocks: 2 is not three numbers"),
        ({"source": pl.Packing([(0, 0, 0)], 1.0, cell=[(9, 0, 0), (1, 9, 0), (0, 0, 9)])}, "cell: it is not upright"),
        ({"source": lambda low, high: None}, "source: a function needs cell and radius_range beside it"),
    ],
)
def test_bad_blocks_are_refused(changes, message):
    given = {"source": simple_cubic(6), "contact_angle": 0.3, "suction": 2.0, "liquid": UNIT, "blocks": (1, 1, 1)}
    with pytest.raises(ValueError, match=f"^{message}") as refused:
        wet_in_blocks(**(given | changes))
    assert "\n" not in str(refused.value)


def test_blocks_name_wrong_grains_by_their_numbers():
    heap = simple_cubic(8)
    centres = heap.positions.copy()
    centres[400] = centres[401]
    with pytest.raises(ValueError, match=r"^positions: grains 400 and 401 have the same centre"):
        wet_in_blocks(pl.Packing(centres, 1.0, cell=heap.cell), 0.3, suction=20.0, liquid=UNIT, blocks=(2, 2, 2))
