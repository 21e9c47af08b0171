"""The engine that gives YADE exact bridges: its neighbours and refusals here, its forces in YADE itself.

apt-get install -y --no-install-recommends yade gcc && uv run --group test pytest -m yade
"""

import itertools
import json
import math
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import pendular as pl
from pendular.codes.yade.engine import SHARED, pendular_yade, write

SEED = 1915
ROOT = Path(__file__).parents[1]
SCRIPT = ROOT / "tests" / "yade_scripts" / "engine.py"
EXAMPLE = ROOT / "examples" / "yade_engine.py"
TENSION, SUCTION, VOLUME = 0.0728, 5e3, 1e-16
needs_c = pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")


def in_yade(function):
    """Mark a test that runs YADE."""
    missing = shutil.which("yade") is None
    reason = "YADE is not installed: apt-get install -y --no-install-recommends yade"
    return pytest.mark.yade(pytest.mark.long(pytest.mark.skipif(missing, reason=reason)(function)))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The engine, and tables under suction, at constant volume, and for walls of another angle."""
    path = tmp_path_factory.mktemp("yade")
    write(path / "engine")
    for name, table in tables().items():
        table.save(path / f"{name}.bridges")
    return path


def tables():
    return {
        "suction": pl.tabulate(math.radians(20), reduced=(0.05, 100.0), tolerance=1e-6),
        "volume": pl.tabulate(math.radians(20), "volume", reduced=(1e-4, 0.05), tolerance=1e-6),
        "walls": pl.tabulate(np.deg2rad([20.0, 60.0]), reduced=(0.05, 100.0), tolerance=1e-6),
    }


def simulated(folder, script):
    """What YADE says of a script."""
    done = subprocess.run(
        ["yade", "-n", "-x", str(script)], cwd=folder, capture_output=True, text=True, timeout=300, check=False
    )
    return done.stdout + done.stderr


# The command -------------------------------------------------------------------------------------------------------


def test_the_command_tells_what_it_wrote(run, tmp_path, monkeypatch):
    code, told, _ = run("export", "yade-engine", "--out", tmp_path / "engine")
    assert code == 0
    names = ["pendular_yade.py", "pendular_yade.c", "pendular_table.h"]
    assert [Path(line.split(":")[0]).name for line in told.splitlines()][:3] == names
    monkeypatch.setattr("pendular.ground.linking.shutil.which", lambda name: None)
    code, told, _ = run("export", "yade-engine", "--out", tmp_path / "bare")
    assert told.splitlines()[3] == f"{SHARED}: not written, for there is no C compiler (cc, gcc or clang) to make it"
    monkeypatch.setattr(pendular_yade, "_HERE", tmp_path / "bare")
    with pytest.raises(ValueError, match=r"^engine: '.*libpendular_yade\.so' is not there; in its folder: cc -O3"):
        pendular_yade.Bridges("w.bridges", suction=SUCTION, surface_tension=TENSION)


@needs_c
def test_the_loop_compiles_without_a_warning(folder, tmp_path):
    warned = ("-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic")
    subprocess.run(["gcc", *warned, "-c", "-o", tmp_path / "o", folder / "engine" / "pendular_yade.c"], check=True)


# Neighbours and refusals -------------------------------------------------------------------------------------------


def test_neighbours_are_all_that_are_near():
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    for spread in (0.0, 1.0, 5.0):
        radii = 1e-5 * np.exp(spread * random.random(400))
        places = random.uniform(0.0, 20.0, (400, 3)) * np.median(radii)
        numbers, far = 7 + np.arange(400), 0.3 * np.median(radii)
        found = np.concatenate([*pendular_yade._near_spheres(numbers, places, radii, far)])
        apart = np.linalg.norm(places[:, None] - places[None], axis=-1) - radii[:, None] - radii
        expected = {(i + 7, j + 7) for i, j in np.argwhere(apart < far) if i < j}
        assert {tuple(sorted(pair)) for pair in found.tolist()} == expected
        assert len(found) == len(expected) > 100


def test_neighbours_over_the_faces_of_a_cell_are_all_that_are_near():
    """Against all images of all pairs, in a skew cell, of places that have left it."""
    print(f"seed {SEED}")
    random = np.random.default_rng(SEED)
    for spread in (0.0, 1.5):
        radii = 1e-5 * np.exp(spread * random.random(150))
        cell = (np.eye(3) + random.uniform(-0.3, 0.3, (3, 3))) * 12.0 * np.max(radii)
        places = random.uniform(-2.0, 3.0, (150, 3)) @ cell.T
        far = 0.3 * np.median(radii)
        one, other, shift = pendular_yade._near_in_cell(places, radii, far, cell)
        found = np.linalg.norm(places[other] + shift @ cell.T - places[one], axis=1) - radii[one] - radii[other]
        apart = np.linalg.norm(shortest(places[None] - places[:, None], cell), axis=-1) - radii[:, None] - radii
        expected = {(i, j) for i, j in np.argwhere(apart < far) if i < j}
        pairs = np.sort(np.column_stack([one, other]), axis=1)
        assert {tuple(pair) for pair in pairs.tolist()} == expected
        assert len(pairs) == len(expected) > 30
        np.testing.assert_allclose(found, apart[one, other], rtol=1e-9, atol=1e-9 * far)
    with pytest.raises(ValueError, match=r"^cell: its width .* is less than twice .*, how far bridges reach$"):
        pendular_yade._near_in_cell(places, radii, far, 0.3 * cell)


def shortest(vectors, cell):
    """The shortest of all periodic images of vectors."""
    images = vectors - np.floor(vectors @ np.linalg.inv(cell).T) @ cell.T
    steps = (np.stack(np.meshgrid(*[np.arange(-2, 3)] * 3), -1).reshape(-1, 3)) @ cell.T
    images = images[..., None, :] + steps
    nearest = np.linalg.norm(images, axis=-1).argmin(axis=-1)
    return np.take_along_axis(images, nearest[..., None, None], axis=-2)[..., 0, :]


@needs_c
def test_what_cannot_be_is_refused_in_one_line(folder, monkeypatch):
    monkeypatch.setattr(pendular_yade, "_HERE", folder / "engine")
    suction, volume, walls, tension = (
        str(folder / "suction.bridges"), str(folder / "volume.bridges"), str(folder / "walls.bridges"),
        {"surface_tension": TENSION},
    )  # fmt: skip
    for given, reason in (
        ({"table": "none.bridges", "suction": 1.0, **tension}, r"table: 'none.bridges': the file cannot be read"),
        ({"table": suction, **tension}, r"suction: is what .* holds; give it, and it alone"),
        ({"table": suction, "suction": 1.0, "volume": 1.0, **tension}, r"suction: is what .* and it alone"),
        ({"table": volume, "suction": 1.0, **tension}, r"volume: is what .* holds; give it, and it alone"),
        ({"table": walls, "suction": 1.0, **tension}, r"table: .* has two contact angles; grains have one"),
        ({"table": suction, "wall_table": volume, "suction": 1.0, **tension}, r"wall_table: .* does not hold"),
        ({"table": suction, "suction": 1.0, "surface_tension": 0.0}, r"surface_tension: 0.0 is not positive"),
        ({"table": suction, "suction": 1.0, "film": 1e-15, **tension}, r"film: .* holds the suction, and a reservoir"),
        ({"table": volume, "volume": 1.0, "film": 1e-15, "share": 1.5, **tension}, r"share: 1.5 is not in \(0, 1\]"),
    ):
        with pytest.raises(ValueError, match=rf"^{reason}[^\n]*$"):
            pendular_yade.Bridges(**given)


@needs_c
def test_films_alone_may_say_how_much_a_bridge_holds(folder, monkeypatch):
    """Neighbours are sought as far as the most liquid reaches that the table knows, where more than that is allowed."""
    monkeypatch.setattr(pendular_yade, "_HERE", folder / "engine")
    bridges = pendular_yade.Bridges(folder / "volume.bridges", volume=1.0, film=1e-15, surface_tension=TENSION)
    bridges._planes = np.empty(0, int)
    farthest = tables()["volume"].rupture_distance(0.0499 * 30e-6**3, 30e-6, 30e-6, TENSION)
    assert bridges._reach(np.array([20e-6, 30e-6])) == pytest.approx(1.02 * farthest, rel=1e-3)


# In YADE -----------------------------------------------------------------------------------------------------------

SHARES = np.array([-0.01, 0.0, 0.3, 0.6, 0.95, 0.999, 1.001, 0.5])  # of the rupture distance, one step after another


@in_yade
def test_forces_in_yade_are_those_of_the_table(folder):
    """Any ratio of radii to 1000, both controls, walls of the same angle and of another one, the memory of a bridge."""
    made, random = tables(), np.random.default_rng(SEED)
    print(f"seed {SEED}")
    cases, expected = [], []
    for name, wall_table, distant in (
        ("suction", None, False), ("suction", "walls", False), ("volume", None, False), ("suction", None, True),
    ):  # fmt: skip
        held = VOLUME if name == "volume" else SUCTION
        small = random.uniform(15e-6, 30e-6, 12)
        ratio = np.geomspace(1.0, 60.0 if name == "suction" else 4.0, 12)
        pairs = [(r, r * x) for r, x in zip(small, ratio, strict=True)] + [(1e-6, 1e-3)] * (name == "suction")
        pairs += [(r, math.inf) for r in small[:4]]
        forces, gaps, energies = [], [], []
        for r1, r2 in pairs:
            table = made[name] if r2 < math.inf or wall_table is None else made[wall_table]
            end = float(table.rupture_distance(held, r1, r2, TENSION))
            gap = (SHARES[3:] if distant else SHARES) * end
            force = np.asarray(table.force(gap, held, r1, r2, TENSION))
            force[-1] = 0.0  # the bridge broke the step before
            forces.append(force)
            gaps.append(gap)
            energies.append(float(table.energy(gap[0], held, r1, r2, TENSION)))
        given = {"table": f"{name}.bridges", name: held, "surface_tension": TENSION, "distant": distant}
        given |= {"wall_table": f"{wall_table}.bridges"} if wall_table else {}
        rows = [(r1, None if r2 == math.inf else r2) for r1, r2 in pairs]
        cases.append({"pairs": rows, "separations": np.array(gaps).T.tolist(), **given})
        expected.append(np.array(forces).T)
        cases.append({"pairs": rows, "separations": [np.array(gaps)[:, 0].tolist()], **given})
        expected.append(energies)
    (folder / "cases.json").write_text(json.dumps(cases))
    said = simulated(folder, SCRIPT)
    assert (folder / "found.json").is_file(), said
    found = json.loads((folder / "found.json").read_text())
    for (answer, wanted), (first, energies) in zip(
        zip(found[0::2], expected[0::2], strict=True), zip(found[1::2], expected[1::2], strict=True), strict=True
    ):
        forces = -np.array(answer["forces"])
        np.testing.assert_allclose(forces, wanted, rtol=2e-9, atol=0.0)
        assert answer["bridges"] == []
        energy = [next(row for row in first["bridges"] if number in row[:2])[5] for number in first["ids"]]
        np.testing.assert_allclose(energy, energies, rtol=1e-9)
        assert len(first["bridges"]) == len(first["ids"])


@in_yade
def test_what_is_held_may_change_from_step_to_step(folder):
    table, held, gap = tables()["suction"], [2e3, 5e3, 8e3], 1e-6
    case = {"pairs": [(50e-6, 80e-6)], "separations": [[-1e-8], [gap], [gap]], "held": held}
    given = {"table": "suction.bridges", "suction": 1e3, "surface_tension": TENSION}
    (folder / "cases.json").write_text(json.dumps([case | given]))
    said = simulated(folder, SCRIPT)
    assert (folder / "found.json").read_text(), said
    forces = -np.ravel(json.loads((folder / "found.json").read_text())[0]["forces"])
    expected = [
        table.force(at, suction, 50e-6, 80e-6, TENSION) for at, suction in zip((0.0, gap, gap), held, strict=True)
    ]
    np.testing.assert_allclose(forces, expected, rtol=2e-9)


@in_yade
@pytest.mark.parametrize("is_periodic", [True, False])
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_grains_on_their_ways_have_bridges_over_faces_and_beside_clumps(folder, is_periodic, control):
    """Every step against all images of all pairs: a sheared cell, clumps, grains that come and grains that go."""
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    random, table = np.random.default_rng(seed), tables()[control]
    count, radius, held = 50, 50e-6, {"suction": 20e3, "volume": 2e-16}[control]
    radii = random.uniform(0.7, 1.0, count) * radius
    cell = (np.eye(3) + random.uniform(-0.1, 0.1, (3, 3))) * 7.0 * radius
    clumps = [[0, 1, 2], [3, 4]]
    given = {
        "cell": cell.tolist() if is_periodic else None,
        "rate": (4e3 * random.uniform(-1.0, 1.0, (3, 3))).tolist(),
        "places": (random.uniform(0.0, 1.0, (count, 3)) @ cell.T).tolist(),
        "radii": radii.tolist(),
        "velocities": random.normal(0.0, 2.0, (count, 3)).tolist(),
        "clumps": clumps,
        "engine": {"table": f"{control}.bridges", control: held, "surface_tension": TENSION, "skin": 2e-6},
        "step": 1e-6,
        "steps": 16,
        "erased": {"5": 40},
        "added_at": 10,
        "added": (0.5 * cell.sum(axis=1)).tolist(),
    }
    (folder / "moving.json").write_text(json.dumps(given))
    said = simulated(folder, SCRIPT.with_name("moving.py"))
    assert (folder / "moved.json").is_file(), said
    steps = json.loads((folder / "moved.json").read_text())
    (folder / "moved.json").unlink()
    assert len(steps) == 16
    clump_of = {member: n for n, members in enumerate(clumps) for member in members}
    radius_of = dict(enumerate(radii.tolist()))
    bridged, seen = set(), 0
    for step in steps:
        ids, places = np.array(step["ids"]), np.array(step["places"])
        own = np.array([radius_of.get(number, radii[0]) for number in step["ids"]])
        way = places[None] - places[:, None]
        way = shortest(way, np.array(step["cell"])) if is_periodic else way
        distance = np.linalg.norm(way, axis=-1)
        forces, now = np.zeros_like(places), set()
        for i, j in zip(*np.triu_indices(len(ids), 1), strict=True):
            pair = (int(ids[i]), int(ids[j]))
            gap = distance[i, j] - own[i] - own[j]
            is_one_clump = pair[0] in clump_of and clump_of[pair[0]] == clump_of.get(pair[1])
            if is_one_clump or (gap > 0.0 and pair not in bridged):
                continue
            force = float(table.force(gap, held, own[i], own[j], TENSION))
            if force > 0.0:
                now.add(pair)
                forces[i] += force * way[i, j] / distance[i, j]
                forces[j] -= force * way[i, j] / distance[i, j]
        assert {tuple(sorted(map(int, row[:2]))) for row in step["bridges"]} == now
        np.testing.assert_allclose(step["forces"], forces, rtol=0.0, atol=1e-8 * np.abs(forces).max())
        seen += len(bridged ^ now)
        bridged = now
    assert seen > 20
    assert len(bridged) > 20


TRIANGLES = [
    (0, 1, 3),
    (0, 3, 2),
    (4, 5, 7),
    (4, 7, 6),
    (0, 1, 5),
    (0, 5, 4),
    (2, 3, 7),
    (2, 7, 6),
    (0, 2, 6),
    (0, 6, 4),
]
TRIANGLES += [(1, 3, 7), (1, 7, 5)]  # of a box, by its corners


def to_triangle(points, corners):
    """Vectors from points to the nearest point of a triangle: the least of those to its plane, edges and corners."""
    ways = [np.asarray(corner) - points for corner in corners]
    for a, b in ((0, 1), (1, 2), (2, 0)):
        edge = corners[b] - corners[a]
        share = ((points - corners[a]) @ edge) / (edge @ edge)
        on_it = corners[a] + share[:, None] * edge - points
        ways.append(np.where(((share > 0.0) & (share < 1.0))[:, None], on_it, np.inf))
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    foot = points - ((points - corners[0]) @ normal / (normal @ normal))[:, None] * normal
    sides = [np.cross(corners[b] - corners[a], foot - corners[a]) @ normal for a, b in ((0, 1), (1, 2), (2, 0))]
    ways.append(np.where((np.min(sides, axis=0) > 0.0)[:, None], foot - points, np.inf))
    ways = np.array(ways)
    nearest = np.linalg.norm(ways, axis=-1).argmin(axis=0)
    return ways[nearest, np.arange(len(points))]


@in_yade
def test_grains_have_one_bridge_with_facets_and_boxes_in_a_direction(folder):
    """A floor of facets that sinks, a box and a facet that turn: the nearest part in a direction has the force."""
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    random, table, suction, radius = np.random.default_rng(seed), tables()["suction"], 20e3, 50e-6
    count, side = 40, np.linspace(-5.0, 5.0, 6) * radius
    radii = random.uniform(0.7, 1.0, count) * radius
    places = np.column_stack([*random.uniform(-5.0, 5.0, (2, count)), random.uniform(0.9, 1.8, count)]) * radius
    surfaces = []
    for x0, x1 in itertools.pairwise(side):
        for y0, y1 in itertools.pairwise(side):
            a, b, c, d = [(x0, y0, 0.0), (x1, y0, 0.0), (x1, y1, 0.0), (x0, y1, 0.0)]
            surfaces += [
                {"corners": corners, "velocity": [0, 0, -0.1], "spin": [0, 0, 0]} for corners in ([a, b, c], [a, c, d])
            ]
    turn = random.normal(size=4)
    surfaces.append(
        {"place": [0.0, 0.0, 5.5 * radius], "half": [2.0 * radius, 3.0 * radius, 2.5 * radius],
         "turn": (turn / np.linalg.norm(turn)).tolist(), "velocity": [0.0, 0.0, 0.0], "spin": [2e3, -3e3, 1e3]}
    )  # fmt: skip
    surfaces.append(
        {"corners": (radius * np.array([(-6.0, -6.0, 3.0), (-5.0, 6.0, 3.0), (-6.0, 0.0, 0.0)])).tolist(),
         "velocity": [0.0, 0.3, 0.0], "spin": [0.0, 4e3, 2e3]}
    )  # fmt: skip
    given = {
        "cell": None, "places": places.tolist(), "radii": radii.tolist(), "clumps": [], "surfaces": surfaces,
        "velocities": random.normal(0.0, 1.5, (count, 3)).tolist(),
        "engine": {"table": "suction.bridges", "suction": suction, "surface_tension": TENSION, "skin": 2e-6},
        "step": 1e-6, "steps": 40, "erased": {}, "added_at": -1,
    }  # fmt: skip
    (folder / "moving.json").write_text(json.dumps(given))
    said = simulated(folder, SCRIPT.with_name("moving.py"))
    assert (folder / "moved.json").is_file(), said
    steps = json.loads((folder / "moved.json").read_text())
    (folder / "moved.json").unlink()
    pairs, walls, most, seen = set(), {i: [] for i in range(count)}, 0, 0
    for step in steps:
        at, forces = np.array(step["places"]), np.zeros((count, 3))
        distance = np.linalg.norm(at[None] - at[:, None], axis=-1)
        for i, j in zip(*np.triu_indices(count, 1), strict=True):
            gap = distance[i, j] - radii[i] - radii[j]
            force = (
                float(table.force(gap, suction, radii[i], radii[j], TENSION)) if gap <= 0.0 or (i, j) in pairs else 0.0
            )
            (pairs.add if force else pairs.discard)((i, j))
            pull = force * (at[j] - at[i]) / distance[i, j]
            forces[i] += pull
            forces[j] -= pull
        ways = []
        for corners in map(np.array, step["surfaces"]):
            parts = [corners] if len(corners) == 3 else [corners[list(three)] for three in TRIANGLES]
            each = np.array([to_triangle(at, part) for part in parts])
            ways.append(each[np.linalg.norm(each, axis=-1).argmin(axis=0), np.arange(count)])
        ways, block = np.array(ways), np.array(next(each for each in step["surfaces"] if len(each) == 8))
        lengths = np.linalg.norm(ways, axis=-1)
        edges = block[[4, 2, 1]] - block[0]
        share = (at - block[0]) @ edges.T / (edges * edges).sum(axis=1)
        is_within = ((share > 0.0) & (share < 1.0)).all(axis=1)
        lengths[-2, is_within] *= -1.0  # a grain in the box is pulled further in, as it overlaps
        for i in range(count):
            order = [n for n in np.argsort(lengths[:, i], kind="stable") if lengths[n, i] < 2.0 * radius]
            unit = ways[:, i] / lengths[:, i, None]

            def at_one_point(n, m, unit=unit, near=lengths[:, i]):
                return abs(near[n] - near[m]) <= 1e-9 * radius and np.allclose(unit[n], unit[m], atol=1e-9)

            def shown(n, unit=unit, near=lengths[:, i], order=order, at_one_point=at_one_point):
                """The part that has the bridge of this one: the nearest beside it, unless that is hidden too."""
                beside = (m for m in order if unit[n] @ unit[m] > math.sqrt(0.5) and near[m] < near[n])
                nearest = next((m for m in beside if not at_one_point(n, m)), None)
                return n if nearest is None else shown(nearest)

            had, kept = {shown(n) for n in walls[i] if n in order}, []
            for n in order:
                if shown(n) != n or any(at_one_point(n, m) for m in kept):
                    continue
                gap = lengths[n, i] - radii[i]
                is_wet = gap <= 0.0 or any(at_one_point(n, m) for m in had)
                force = float(table.force(gap, suction, radii[i], math.inf, TENSION)) if is_wet else 0.0
                forces[i] += force * unit[n]
                if force:
                    kept.append(n)
            walls[i] = kept
            most = max(most, len(kept))
        np.testing.assert_allclose(step["forces"], forces, rtol=0.0, atol=1e-7 * np.abs(forces).max())
        seen += sum(map(len, walls.values()))
    assert most >= 1
    assert seen > 100


def liquid_of_a_step(table, gaps, former, films, most, share):
    """Bridges and films after a step, by the rules of the page: {(i, j): volume}, with j negative for a wall."""

    def end(pair, volume):
        radii = tuple(films[n][1] if n >= 0 else math.inf for n in pair)
        mean = 2.0 / sum(1.0 / r for r in radii)
        return 0.0 if volume < table.reduced[0] * mean**3 else float(table.rupture_distance(volume, *radii, TENSION))

    liquid = {number: volume for number, (volume, _) in films.items()}
    bridges = {}
    for pair, volume in former.items():
        if all(n < 0 or n in liquid for n in pair) and gaps[pair] < end(pair, volume):
            bridges[pair] = volume
            continue
        for n in pair:  # one of a grain that is gone leaves half
            if n in liquid:
                liquid[n] += volume * (1.0 if min(pair) < 0 else 0.5)
    forming = [pair for pair, gap in gaps.items() if gap <= 0.0 and pair not in bridges]
    count = {number: sum(number in pair for pair in forming) for number in liquid}
    offer = {number: share * liquid[number] / max(count[number], 1) for number in liquid}
    for pair in forming:
        offered = [offer.get(n, 0.0) for n in pair]
        volume = min(most, sum(offered))
        if end(pair, volume) > max(gaps[pair], 0.0):
            bridges[pair] = volume
            for n, part in zip(pair, offered, strict=True):
                if n in liquid:
                    liquid[n] -= volume * part / sum(offered)
    return bridges, liquid


@in_yade
@pytest.mark.parametrize("is_periodic", [True, False])
def test_liquid_goes_from_grains_to_bridges_and_back(folder, is_periodic):
    """Films and volumes of every step as the rules have them; the sum stays, but for a grain that goes with its own."""
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    random, table = np.random.default_rng(seed), tables()["volume"]
    count, radius, most, share = 50, 50e-6, 2e-15, 0.6
    radii = random.uniform(0.7, 1.0, count) * radius
    cell = np.eye(3) * 7.0 * radius
    films = np.where(random.random(count) < 0.2, 0.0, random.uniform(0.1, 1.5, count) * most)
    walls = [] if is_periodic else [1.0 * radius, 6.0 * radius]
    given = {
        "cell": cell.tolist() if is_periodic else None,
        "rate": (2e3 * random.uniform(-1.0, 1.0, (3, 3))).tolist(),
        "places": random.uniform(0.0, 7.0 * radius, (count, 3)).tolist(),
        "radii": radii.tolist(),
        "velocities": random.normal(0.0, 2.0, (count, 3)).tolist(),
        "clumps": [[0, 1, 2], [3, 4]],
        "walls": walls,
        "engine": {
            "table": "volume.bridges", "volume": most, "surface_tension": TENSION, "skin": 2e-6, "share": share,
            "film": {str(n): volume for n, volume in enumerate(films.tolist())},
        },
        "step": 1e-6,
        "steps": 24,
        "erased": {"5": 40},
        "added_at": 10,
        "added": (0.5 * cell.sum(axis=1)).tolist(),
    }  # fmt: skip
    (folder / "moving.json").write_text(json.dumps(given))
    said = simulated(folder, SCRIPT.with_name("moving.py"))
    assert (folder / "moved.json").is_file(), said
    steps = json.loads((folder / "moved.json").read_text())
    (folder / "moved.json").unlink()
    clump_of = {member: n for n, members in enumerate(given["clumps"]) for member in members}
    sizes, bridges, liquid, seen = dict(enumerate(radii.tolist())), {}, dict(enumerate(films.tolist())), 0
    total, last = films.sum(), set(range(count))
    side_of = {count + len(given["clumps"]) + n: -1 - n for n in range(len(walls))}  # ids of walls
    for step in steps:
        ids, places = step["ids"], np.array(step["places"])
        way = places[None] - places[:, None]
        distance = np.linalg.norm(shortest(way, np.array(step["cell"])) if is_periodic else way, axis=-1)
        gaps = {
            (i, j): distance[a, b] - sizes.get(i, radii[0]) - sizes.get(j, radii[0])
            for a, i in enumerate(ids) for b, j in enumerate(ids)
            if i < j and not (i in clump_of and clump_of[i] == clump_of.get(j))
        }  # fmt: skip
        gaps |= {
            (i, -1 - n): abs(places[a, 2] - at) - sizes.get(i, radii[0])
            for n, at in enumerate(walls) for a, i in enumerate(ids)
        }  # fmt: skip
        gone = last - set(ids)
        total -= sum(
            liquid[n] + sum(0.5 * v for pair, v in bridges.items() if n in pair and min(pair) >= 0) for n in gone
        )
        total -= sum(v for pair, v in bridges.items() for n in gone if n in pair and min(pair) < 0)
        last = set(ids)
        known = {number: (liquid.get(number, 0.0), sizes.get(number, radii[0])) for number in ids}
        now, liquid = liquid_of_a_step(table, gaps, bridges, known, most, share)
        told = {
            tuple(sorted((int(one), side_of.get(int(other), int(other))), reverse=int(other) in side_of)): volume
            for (one, other, *_), volume in zip(step["bridges"], step["volumes"], strict=True)
        }
        assert told.keys() == now.keys()
        assert all(volume == pytest.approx(now[pair], rel=1e-9) for pair, volume in told.items())
        found = {int(number): volume for number, volume in step["films"].items()}
        assert found.keys() == liquid.keys()
        np.testing.assert_allclose([found[n] for n in ids], [liquid[n] for n in ids], rtol=0.0, atol=1e-9 * most)
        assert sum(found.values()) + sum(told.values()) == pytest.approx(total, rel=1e-12)
        seen += len(bridges.keys() ^ now.keys())
        bridges = now
    assert seen > 40
    assert len(bridges) > 10
    assert is_periodic or any(min(pair) < 0 for pair in bridges)


@in_yade
@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"suction": 1e9}, "suction: 1e+09 with radii 5e-06 and 5e-06 and surface tension 0.0728 is out of the range"),
        (
            {"scene": "periodic", "pairs": [(5e-6, 5e-6), (5e-6, None)]},
            "bodies: walls have no place in a periodic cell",
        ),
    ],
)
def test_what_has_no_bridge_ends_the_run_with_one_line(folder, change, reason):
    case = {"pairs": 2 * [(5e-6, 5e-6)], "separations": [[0.0, 0.0]], "table": "suction.bridges", "suction": SUCTION}
    (folder / "cases.json").write_text(json.dumps([case | {"surface_tension": TENSION} | change]))
    assert f"ValueError: {reason}" in re.sub(r"\x1b\[[\d;]*m", "", simulated(folder, SCRIPT))


@in_yade
def test_the_example_runs_as_it_says(folder):
    shutil.copy(folder / "suction.bridges", folder / "w.bridges")
    said = simulated(folder, EXAMPLE)
    assert (folder / "pull.csv").is_file(), said
    gap, on_grain, on_wall = np.loadtxt(folder / "pull.csv", delimiter=",", skiprows=1).T
    held = {"suction": 5e3, "liquid": pl.Liquid(TENSION)}
    for force, other in ((on_grain, 1e-3), (on_wall, math.inf)):
        grains = pl.Pair((50e-6, other), math.radians(20))
        exact = pl.bridge(grains, np.maximum(gap, 0.0), **held).force
        inside = gap < 0.999 * pl.rupture(grains, **held).separation
        np.testing.assert_allclose(force[inside], exact[inside], rtol=1e-5)
        assert inside.sum() > 100
        assert force[-1] == 0.0
