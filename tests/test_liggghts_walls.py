"""Bridges with walls in LIGGGHTS: one for each grain and wall, whatever triangles the wall is made of."""

import itertools
import math

import numpy as np
import pytest

import pendular as pl
from in_liggghts import (
    ANGLES,
    MODEL,
    SUCTION,
    TENSION,
    VOLUME,
    needs_liggghts,
    rows_of,
    save_tables,
    scene_of,
    simulated,
)
from pendular.laws import damping_star

SEED = 1916
pytestmark = [needs_liggghts, pytest.mark.long]

# Walls ---------------------------------------------------------------------------------------------------------------


def stl(folder, name, triangles):
    """A mesh as a file."""
    lines = []
    for corners in triangles:
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        lines.append("facet normal {:.17g} {:.17g} {:.17g}\nouter loop".format(*normal / np.linalg.norm(normal)))
        lines += ["vertex {:.17g} {:.17g} {:.17g}".format(*corner) for corner in corners]
        lines.append("endloop\nendfacet")
    (folder / f"{name}.stl").write_text(f"solid {name}\n" + "\n".join(lines) + f"\nendsolid {name}\n")


def mesh_walls(*names, kind=2):
    """The lines that make walls of meshes."""
    lines = [f"fix {name} all mesh/surface file {name}.stl type {kind}" for name in names]
    return "\n".join(
        [*lines, f"fix walls all wall/gran model {MODEL} mesh n_meshes {len(names)} meshes {' '.join(names)}"]
    )


def strip(across, along, height=0.0):
    """A plane of rectangles between the lines x and y, each cut by a diagonal."""
    found = []
    for x0, x1 in itertools.pairwise(across):
        for y0, y1 in itertools.pairwise(along):
            a, b, c, d = np.array([(x0, y0, height), (x1, y0, height), (x1, y1, height), (x0, y1, height)])
            found += [(a, b, c), (a, c, d)]
    return np.array(found)


def block(half, turn):
    """A cuboid about the origin, its faces cut by diagonals, outwards."""
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return np.array([(corners[f[i]], corners[f[i + 1]], corners[f[0]]) for f in faces for i in (1, 2)]) @ turn.T


def turned(random):
    """A rotation by chance."""
    q, r = np.linalg.qr(random.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * np.linalg.det(q)


def to_block(places, half, turn):
    """Vectors from places outside of a cuboid to its nearest point."""
    own = places @ turn
    return (np.clip(own, -half, half) - own) @ turn.T


def one_by_one(table, gaps, value, radius, *, had=False):
    """Attraction to a plane, step by step: from the first touch to rupture."""
    end = float(table.rupture_distance(value, radius, math.inf, TENSION))
    force = np.asarray(table.force(np.maximum(gaps, 0.0), value, radius, math.inf, TENSION))
    found = np.zeros(len(gaps))
    for n, gap in enumerate(gaps):
        had = (had or gap <= 0.0) and gap < end
        found[n] = force[n] if had else 0.0
    return found


def led(places, radius, walls, **words):
    """A script that puts grains to one place after another: (grains, places, 3), with a frame for each."""
    rows = [(1, place, radius) for place in places[:, 0]]
    script = scene_of(rows, "suction", SUCTION, walls=walls, every=1, **words) + "run 1\n"
    for step in places[:, 1:].transpose(1, 0, 2):
        for i, (x, y, z) in enumerate(step, 1):
            script += f"set atom {i} x {x:.17g} y {y:.17g} z {z:.17g}\n"
        script += "run 1\n"
    return script


# Tests ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("held", "ranks"), [("suction", 1), ("suction", 2), ("volume", 1)])
def test_a_grain_on_a_flat_mesh_has_one_bridge_wherever_it_lies(liggghts, held, ranks, tmp_path):
    """On faces, edges, corners and on the seam of two meshes; those that never touched have none."""
    table = save_tables(tmp_path, held, "equal")[1, 1]
    value = VOLUME if held == "volume" else SUCTION
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    lines = np.linspace(-1.2e-3, 1.2e-3, 9)
    stl(tmp_path, "left", strip(lines[:5], lines))
    stl(tmp_path, "right", strip(lines[4:], lines))
    spots = [
        (lines[2], lines[3]),
        (lines[4], lines[2]),
        (0.0, 1e-4),
        (lines[3] + 5e-5, lines[5]),
        (lines[5], lines[6] + 7e-5),
    ]
    spots += [(lines[6] + 1e-4, lines[1] + 1e-4), (-5e-4, -5e-4), *random.uniform(-1e-3, 1e-3, (5, 2))]
    radii = random.uniform(20e-6, 40e-6, len(spots))
    above = np.where(np.arange(len(spots)) % 4 == 3, 5e-8, -1e-4 * radii)
    rows = [(1, (x, y, r + gap), r) for (x, y), r, gap in zip(spots, radii, above, strict=True)]
    apart = np.linalg.norm(np.subtract.outer(spots, spots)[:, [0, 1], :, [0, 1]], axis=0)
    assert np.min(apart + np.eye(len(spots))) > 1e-4, "grains must not meet"
    script = scene_of(rows, held, value, upper=range(1, len(rows) + 1), walls=mesh_walls("left", "right"))
    numbers = rows_of(liggghts, tmp_path, script + "run 2000\n", ranks)
    broken = 0
    for i, r in enumerate(radii):
        gaps = numbers[:, i, 2] - r
        expected = one_by_one(table, gaps, value, r)
        clear = gaps > 0.0
        unit = table.force(0.0, value, r, math.inf, TENSION)
        assert np.abs(-numbers[:, i, 5] - expected)[clear].max() < 1e-9 * unit, spots[i]
        assert np.abs(numbers[:, i, 3:5]).max() < 1e-9 * unit
        assert np.any(expected > 0.0) == (above[i] < 0.0)
        broken += expected[-1] == 0.0 < expected.max()
        inside = clear & (expected > 0.0) & (gaps < 0.99 * table.rupture_distance(value, r, math.inf, TENSION))
        if inside.any():
            solids = pl.Pair((r, math.inf), ANGLES["equal"])
            exact = pl.bridge(solids, gaps[inside], **{held: value}, liquid=pl.Liquid(TENSION)).force
            assert np.abs(-numbers[inside, i, 5] - exact).max() < 1e-5 * unit
    assert broken >= 6


def test_a_grain_with_more_bridges_than_there_is_room_for_ends_the_run(liggghts, tmp_path):
    save_tables(tmp_path, "suction", "equal")
    radius = 40e-6
    planes = [(axis, side) for axis in "xyz" for side in (-1, 1)][:5]
    walls = [
        f"fix {axis}{n} all wall/gran model {MODEL} primitive type 2 {axis}plane {side * 0.9999 * radius}"
        for n, (axis, side) in enumerate(planes)
    ]
    for count, code in ((4, 0), (5, 1)):
        script = scene_of([(1, (0.0, 0.0, 0.0), radius)], "suction", SUCTION, walls="\n".join(walls[:count]))
        done = simulated(liggghts, tmp_path, script + "run 1\n")
        assert done.returncode == code
    assert "cohesion model pendular: a grain touches walls in more than four directions\n" in done.stderr


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_bridge_goes_on_from_triangle_to_triangle_and_from_mesh_to_mesh(liggghts, ranks, tmp_path):
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    lines = np.linspace(-1.2e-3, 1.2e-3, 17)
    stl(tmp_path, "left", strip(lines[:9], lines))
    stl(tmp_path, "right", strip(lines[8:], lines))
    radius, gap = 50e-6, 1e-6
    rows = [(1, (-5e-4, y, radius - 1e-9), radius) for y in (-4.03e-4, 1.5e-4, 5.2e-4)]
    walls = mesh_walls("left", "right")
    script = scene_of(rows, "suction", SUCTION, upper=(1, 2, 3), walls=walls)
    script += "run 50\nunfix pull\nfix pull upper move linear 1.9 0.3 0 units box\nrun 5000\n"
    numbers = rows_of(liggghts, tmp_path, script, ranks)
    assert np.ptp(numbers[:, 0, 0]) > 9e-4
    gaps = numbers[..., 2] - radius
    after = gaps[:, 0] > 0.9 * gap
    assert after.sum() > 450
    expected = table.force(gaps[after], SUCTION, radius, math.inf, TENSION)
    np.testing.assert_allclose(-numbers[after][..., 5], expected, rtol=1e-9)
    assert np.abs(numbers[after][..., 3:5]).max() < 1e-9 * expected.max()


def around_a_corner(half, tilt, reach, count):
    """Places at a distance from a block: over its face z, about an edge or a corner, and down its face x."""
    angle, still = np.linspace(0.0, 0.5 * math.pi, count), np.ones(count)
    y = 0.3 * half[1] if tilt == 0.0 else half[1]
    legs = [
        (np.linspace(0.2, 1.0, count), still, 0.0 * angle),
        (still, still, angle),
        (still, np.linspace(1.0, 0.0, count), 0.5 * math.pi * still),
    ]
    places = []
    for x, z, turn in legs:
        spot = np.column_stack([x * half[0], y * still, z * half[2]])
        way = np.column_stack([np.sin(turn), np.tan(tilt) * still, np.cos(turn)]) * np.cos(tilt)
        places.append(spot + reach * way)
    return np.concatenate(places)


def test_a_grain_goes_around_a_block_with_one_bridge(liggghts, tmp_path):
    """Over faces, an edge and a corner: LIGGGHTS asks for several of them at once, and the nearest has the bridge."""
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    half, radius, turn = np.array([1.2e-4, 1.7e-4, 1.4e-4]), 40e-6, turned(np.random.default_rng(seed))
    stl(tmp_path, "block", block(half, turn))
    gap = 0.3 * float(table.rupture_distance(SUCTION, radius, math.inf, TENSION))
    places = np.array([around_a_corner(half, tilt, radius + gap, 40) for tilt in (0.0, 0.6)]) @ turn.T
    way = to_block(places, half, turn) / (radius + gap)
    np.testing.assert_allclose(np.linalg.norm(way, axis=-1), 1.0, rtol=1e-9)
    start = places[:, :1] + way[:, :1] * (gap + 1e-4 * radius)  # in touch
    script = led(np.concatenate([start, places], axis=1), radius, mesh_walls("block"))
    found = rows_of(liggghts, tmp_path, script)[2:].transpose(1, 0, 2)
    np.testing.assert_allclose(found[..., :3], places, rtol=0.0, atol=1e-12)
    expected = float(table.force(gap, SUCTION, radius, math.inf, TENSION))
    np.testing.assert_allclose(found[..., 3:], expected * way, rtol=0.0, atol=1e-6 * expected)


def test_walls_of_a_corner_hold_a_bridge_each(liggghts, tmp_path):
    """In a box of one mesh: three bridges, of which each forms where its wall is touched, and breaks alone."""
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    half, radius, turn = np.full(3, 2e-4), 40e-6, turned(np.random.default_rng(seed))
    stl(tmp_path, "box", block(half, turn))
    end = float(table.rupture_distance(SUCTION, radius, math.inf, TENSION))
    touch = -1e-4 * radius / end
    gaps = end * np.array(
        [(touch, 0.3, 0.4), (0.2, touch, 0.3), (0.3, 0.2, touch), (0.3, 0.2, 0.25), (1.01, 0.2, 0.25), (0.5, 0.9, 0.1)]
    )
    places = (half - radius - gaps) @ turn.T
    found = rows_of(liggghts, tmp_path, led(places[None], radius, mesh_walls("box")))[1:, 0]
    np.testing.assert_allclose(found[:, :3], places, rtol=0.0, atol=1e-12)
    force = np.asarray(table.force(np.maximum(gaps, 0.0), SUCTION, radius, math.inf, TENSION))
    force[4:, 0] = 0.0
    np.testing.assert_allclose(found[3:, 3:], force[3:] @ turn.T, rtol=0.0, atol=1e-6 * force.max())


def test_a_grain_in_a_drum_has_one_bridge_with_the_nearest_facet(liggghts, tmp_path):
    table = save_tables(tmp_path, "suction", "equal")[1, 1]
    count, inner, radius = 24, 3e-4, 40e-6
    corner = 2.0 * np.pi * np.arange(count + 1) / count
    ring = inner / math.cos(math.pi / count) * np.column_stack([np.cos(corner), np.sin(corner)])
    facets = []
    for (x0, y0), (x1, y1) in itertools.pairwise(ring):
        a, b, c, d = np.array([(x0, y0, -3e-4), (x1, y1, -3e-4), (x1, y1, 3e-4), (x0, y0, 3e-4)])
        facets += [(a, c, b), (a, d, c)]
    stl(tmp_path, "drum", np.array(facets))
    gap = 0.2 * float(table.rupture_distance(SUCTION, radius, math.inf, TENSION))
    angle = np.deg2rad(np.concatenate([[7.5], np.linspace(7.5, 52.0, 60)]))  # 0 and 15 are corners
    nearest = np.deg2rad(15.0) * (np.floor(angle / np.deg2rad(15.0)) + 0.5)
    away = (inner - radius - np.where(np.arange(angle.size) > 0, gap, -1e-4 * radius)) / np.cos(angle - nearest)
    places = np.column_stack([away * np.cos(angle), away * np.sin(angle), np.linspace(-1e-4, 1e-4, angle.size)])
    found = rows_of(liggghts, tmp_path, led(places[None], radius, mesh_walls("drum")))[2:, 0]
    expected = float(table.force(gap, SUCTION, radius, math.inf, TENSION))
    way = np.column_stack([np.cos(nearest), np.sin(nearest), 0.0 * nearest])[1:]
    np.testing.assert_allclose(found[:, 3:], expected * way, rtol=0.0, atol=1e-6 * expected)


@pytest.mark.parametrize("held", ["suction", "volume"])
def test_the_viscosity_of_the_liquid(liggghts, held, tmp_path):
    """Two grains, a grain and a wall at rest, and a grain and a mesh that moves."""
    table = save_tables(tmp_path, held, "equal")[1, 1]
    value, viscosity, smallest = VOLUME if held == "volume" else SUCTION, 1e-3, 4e-7
    lines = np.linspace(5e-4, 1.5e-3, 3)
    stl(tmp_path, "floor", strip(lines, np.linspace(-5e-4, 5e-4, 3), height=-1e-3))
    r1, r2 = 30e-6, 40e-6
    rows = [(1, (0.0, 0.0, 0.0), r1), (1, (0.0, 0.0, (r1 + r2) * (1 - 1e-4)), r2)]
    rows += [(1, (-1e-3, 0.0, -1.5e-3 + r1 * (1 - 1e-4)), r1), (1, (9e-4, 1e-5, -1e-3 + r2 * (1 - 1e-4)), r2)]
    flat = f"fix flat all wall/gran model {MODEL} primitive type 2 zplane -1.5e-3\n"
    walls = f"{flat}{mesh_walls('floor')}\nfix down all move/mesh mesh floor linear 0.05 0. -0.1"
    words = f"viscosity {viscosity} smallest_gap {smallest}"
    script = scene_of(rows, held, value, upper=(2, 3, 4), walls=walls, words=words)
    numbers = rows_of(liggghts, tmp_path, script + "run 800\n")[1:]
    z, force = numbers[..., 2], numbers[..., 5]
    assert np.array_equal(force[:, 0], -force[:, 1])
    time = 1e-6 * np.arange(1, len(z) + 1)
    for radii, gap, speed, found in (
        ((r2, r1), z[:, 1] - z[:, 0] - r1 - r2, 0.2, force[:, 0]),
        ((r1, math.inf), z[:, 2] + 1.5e-3 - r1, 0.2, -force[:, 2]),
        ((r2, math.inf), z[:, 3] + 1e-3 + 0.1 * time - r2, 0.3, -force[:, 3]),
    ):
        mean = 2.0 / (1.0 / radii[0] + 1.0 / radii[1])
        end = table.rupture_distance(value, *radii, TENSION)
        clear = (gap > 0.0) & (np.abs(gap / end - 1.0) > 1e-4)
        liquid = table.volume(gap, value, *radii, TENSION) if held == "suction" else np.full(gap.size, value)
        angle, gap_star = ANGLES["equal"], np.maximum(gap, smallest) / mean
        star = damping_star("pitois2000", gap_star, liquid / mean**3, angle, angle, 1.0, 1.0)
        drag = viscosity * mean * speed * np.nan_to_num(star)
        capillary = np.asarray(table.force(gap, value, *radii, TENSION))
        expected = np.where(gap < end, capillary + drag, 0.0)
        unit = capillary.max()
        assert np.abs(found - expected)[clear].max() < 1e-8 * unit
        assert np.any(expected[clear] == 0.0)
        assert drag[clear & (gap < end)].max() > 0.1 * unit
