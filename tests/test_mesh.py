"""Surfaces of a bridge as triangles.

Oracles: the sums over the triangles converge to the areas and the volume of the bridge with the square of the length of
an edge; every edge belongs to two triangles; and Surface Evolver, where it is installed, finds the energy and the
pressure of the bridge from the mesh alone.
"""

import math
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest

import pendular as pl
from pendular.ask.mesh import SURFACES

UNIT = pl.Liquid(surface_tension=1.0)
STATES = {
    "unequal spheres": (pl.Pair((1.0, 0.6), (0.3, 0.7)), 0.02, 0.008),
    "on a plane, in contact": (pl.Pair((1.0, math.inf), (0.3, 0.0)), 0.0, 0.008),
    "a bulge": (pl.Pair(1.0, 2.0), 1.0, 5.0),
    "two planes": (pl.Pair(math.inf, 0.7), 1.0, 6.0),
    "very unequal": (pl.Pair((1.0, 200.0), (0.0, 0.5)), 0.01, 1e-3),
}


def bridge_of(name):
    pair, separation, volume = STATES[name]
    return pl.bridge(pair, separation, volume=volume, liquid=UNIT)


def area(mesh, *names):
    a, b, c = np.moveaxis(mesh.points[mesh.triangles[np.isin(mesh.surface, [SURFACES.index(n) for n in names])]], 1, 0)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()


def enclosed(mesh, triangles):
    return np.linalg.det(mesh.points[triangles]).sum() / 6.0


def is_closed(triangles):
    """Whether each edge is passed once in either direction."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).tolist()
    passed = set(map(tuple, edges))
    return len(passed) == len(edges) and all((b, a) in passed for a, b in passed)


@pytest.mark.parametrize("name", STATES)
def test_areas_and_volume_converge_with_the_square_of_an_edge(name):
    b = bridge_of(name)
    errors = []
    for around in (48, 96, 192):
        mesh = b.mesh(around)
        liquid = mesh.triangles[mesh.surface < 3]
        assert is_closed(liquid)
        told = [
            enclosed(mesh, liquid) / b.volume,
            area(mesh, "liquid_gas") / b.liquid_gas_area,
            area(mesh, "wetted1") / b.wetted_area[0],
            area(mesh, "wetted2") / b.wetted_area[1],
        ]
        errors.append(np.abs(np.array(told) - 1.0))
    assert errors[1].max() < 0.01
    np.testing.assert_allclose(errors[0] / errors[1], 4.0, rtol=0.1)
    np.testing.assert_allclose(errors[1] / errors[2], 4.0, rtol=0.05)


@pytest.mark.parametrize("name", ["unequal spheres", "very unequal"])
def test_wetted_and_dry_surfaces_make_whole_spheres(name):
    pair, *_ = STATES[name]
    mesh = bridge_of(name).mesh(192)
    for solid in (0, 1):
        wetted = mesh.triangles[mesh.surface == SURFACES.index(f"wetted{solid + 1}")]
        whole = np.concatenate([mesh.triangles[mesh.surface == SURFACES.index(f"dry{solid + 1}")], wetted[:, ::-1]])
        assert is_closed(whole)
        radius = float(pair.radii[solid])
        assert enclosed(mesh, whole) == pytest.approx(4.0 / 3.0 * math.pi * radius**3, rel=1e-3)


def test_a_plane_is_shown_around_the_bridge():
    b = bridge_of("on a plane, in contact")
    mesh = b.mesh()
    plate = mesh.points[np.unique(mesh.triangles[mesh.surface == SURFACES.index("dry2")])]
    np.testing.assert_allclose(plate[:, 0], 0.0, atol=1e-15)
    assert np.hypot(plate[:, 1], plate[:, 2]).max() == pytest.approx(4.0 * b.contact_radius[1])


def test_no_triangle_is_flat_and_no_point_is_left_over():
    for name in STATES:
        mesh = bridge_of(name).mesh(32)
        a, b, c = np.moveaxis(mesh.points[mesh.triangles], 1, 0)
        assert np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > 0.0
        assert np.array_equal(np.unique(mesh.triangles), np.arange(len(mesh.points)))


@pytest.mark.parametrize(
    ("separation", "around", "message"),
    [
        ([0.0, 0.02], 96, "mesh: is made of one bridge, not of an array of shape (2,)"),
        (5.0, 96, "mesh: there is no bridge"),
        (-0.01, 96, "separation: -0.01 m is below 0: the wetted surfaces of a mesh would cross"),
        (0.02, 7, "around: 7.0 is not >= 8"),
        (0.02, 1001, "around: 1001.0 is not in [8, 1000]"),
        (0.02, 20.5, "around: 20.5 is not a whole number"),
    ],
)
def test_what_has_no_mesh_is_refused(separation, around, message):
    b = pl.bridge(STATES["unequal spheres"][0], separation, volume=0.008, liquid=UNIT)
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        b.mesh(around)


# -- files -----------------------------------------------------------------------------------------------------------


@pytest.mark.needs("grains")
@pytest.mark.parametrize("suffix", [".vtu", ".stl", ".obj", ".ply"])
def test_files_hold_the_same_surfaces(tmp_path, suffix):
    import meshio

    pair, *_ = STATES["unequal spheres"]
    b = bridge_of("unequal spheres")
    pl.write_mesh(tmp_path / f"b{suffix}", pair, b, around=24)
    mesh, found = b.mesh(24), meshio.read(tmp_path / f"b{suffix}")
    corners = found.points[found.cells_dict["triangle"]]
    np.testing.assert_allclose(corners, mesh.points[mesh.triangles], rtol=1e-5, atol=1e-6)
    if suffix == ".vtu":
        assert np.array_equal(found.cell_data["surface"][0], mesh.surface)


@pytest.mark.needs("grains")
def test_the_command_writes_a_mesh(tmp_path, run):
    asked = ("bridge", "--radius", "50um", "--volume", "50pL", "--separation", "2um", "--mesh")
    status, output, _ = run(*asked, tmp_path / "b.stl")
    assert status == 0
    assert output.endswith(f"\nmesh: {tmp_path / 'b.stl'}\n")
    assert (tmp_path / "b.stl").stat().st_size > 1e5


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--separation", "0:2um:3", "--mesh", "b.stl"], "pendular: mesh: holds one bridge, not a sweep\n"),
        (["--separation", "2mm", "--mesh", "b.stl"], "pendular: mesh: there is no bridge\n"),
        (
            ["--separation", "2um", "--mesh", "b.step"],
            "pendular: path: 'b.step' does not end in .vtu, .stl, .obj, .ply or .fe\n",
        ),
    ],
)
def test_the_command_refuses_in_one_line(options, message, tmp_path, monkeypatch, run):
    monkeypatch.chdir(tmp_path)
    status, _, errors = run("bridge", "--radius", "50um", "--volume", "50pL", *options)
    assert (status, errors) == (2, message)
    assert list(tmp_path.iterdir()) == []


def test_a_library_that_is_not_there_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "meshio", None)
    message = "path: for .stl it takes the package meshio: pip install 'pendular[grains]'"
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        pl.write_mesh(tmp_path / "b.stl", STATES["unequal spheres"][0], bridge_of("unequal spheres"))


def evolved(path):
    """Energy, volume and pressure that Surface Evolver comes to in a few steps from a start file."""
    done = subprocess.run(["evolver", str(path)], input="g 10\nv\nq\n\n", capture_output=True, text=True, timeout=120)
    assert "WARNING" not in done.stderr
    energy = float(re.findall(r"energy:\s+(\S+)", done.stdout)[-1])
    target, volume, pressure = map(float, re.search(r"\n\s+1\s+(\S+)\s+(\S+)\s+(\S+)\n", done.stdout).groups())
    assert volume == pytest.approx(target, rel=1e-6)
    return energy, volume, pressure


@pytest.mark.skipif(
    shutil.which("evolver") is None, reason="Surface Evolver is not installed: apt-get install evolver-nox"
)
@pytest.mark.parametrize("name", ["unequal spheres", "on a plane, in contact"])
def test_surface_evolver_finds_the_same_bridge(tmp_path, name):
    pair, *_ = STATES[name]
    b = bridge_of(name)
    unit = b.contact_radius.max()
    misses = []
    for around in (16, 32):
        pl.write_mesh(tmp_path / "b.fe", pair, b, around)
        energy, volume, pressure = evolved(tmp_path / "b.fe")
        assert volume == pytest.approx(b.volume / unit**3, rel=1e-6)
        misses.append(abs(energy / (b.surface_energy / unit**2) - 1.0))
    assert misses[1] < 0.02
    assert misses[0] / misses[1] == pytest.approx(4.0, rel=0.25)
    assert pressure == pytest.approx(-b.suction * unit, rel=0.1)
