"""Liquid on the grains in LIGGGHTS: bridges take it and give it back, against the same rules told in Python."""

import math
import shutil
from pathlib import Path

import numpy as np
import pytest

from in_liggghts import (
    MODEL,
    SUCTION,
    TENSION,
    dumped,
    needs_liggghts,
    resumed,
    rows_of,
    save_tables,
    scene_of,
    simulated,
)
from test_liggghts_walls import mesh_walls, stl, strip

EXAMPLES = Path(__file__).parents[1] / "examples" / "liggghts"
pytestmark = [needs_liggghts, pytest.mark.long]
SIDE, VOLUME, SHARE = 3.2e-4, 4e-16, 0.7
COLUMNS = "f_film " + " ".join(f"f_pendular_walls[{5 * k + 1}]" for k in range(4))
COMPUTE = "compute b all pair/gran/local id history\n"
BRIDGES = "dump b all local 1 dump.bridges c_b[1] c_b[2] c_b[4]\n"
BRIDGES += 'dump_modify b format "%.17g %.17g %.17g"\n'
WORDS = f"film on share {SHARE}"


def heap(random, count=48):
    """Grains that fly about in a box that is periodic in x and y, between a mesh and a wall; some are dry."""
    places, radii = [], []
    while len(places) < count:
        radius = random.uniform(20e-6, 32e-6)
        place = random.uniform(0.0, SIDE, 3)
        place[2] = random.uniform(radius, SIDE - radius)
        way = np.array(places).reshape(-1, 3) - place
        way[:, :2] -= SIDE * np.round(way[:, :2] / SIDE)
        if np.all(np.linalg.norm(way, axis=1) > np.array(radii) + radius):
            places.append(place)
            radii.append(radius)
    film = np.where(random.random(count) < 0.2, 0.0, random.uniform(0.1, 1.5, count) * VOLUME)
    return [(1, tuple(place), radius) for place, radius in zip(places, radii, strict=True)], np.array(radii), film


def scene(folder, rows, film, velocity):
    """The scene of a heap, up to its runs."""
    lines = np.linspace(-0.2 * SIDE, 1.2 * SIDE, 4)
    stl_lines = np.clip(lines, 0.0, SIDE)
    stl(folder, "floor", strip(stl_lines, stl_lines))
    moves = "fix move all nve/sphere\nrun 0\n"  # LIGGGHTS has no numbers of grains to set before
    moves += "\n".join(f"set atom {i} property/atom film {each:.17g}" for i, each in enumerate(film, 1))
    for i, (x, y, z) in enumerate(velocity, 1):
        moves += f"\ngroup one id {i}\nvelocity one set {x:.9g} {y:.9g} {z:.9g}\ngroup one delete"
    top = f"fix top all wall/gran model {MODEL} primitive type 2 zplane {SIDE}\n"
    words = {
        "words": WORDS,
        "boundary": "p p f",
        "box": f"0 {SIDE} 0 {SIDE} 0 {SIDE}",
        "before": "fix film all property/atom film scalar yes no no 0.0",
        "walls": COMPUTE + top + mesh_walls("floor"),
        "moves": moves,
        "every": 1,
        "columns": COLUMNS,
    }
    return scene_of(rows, "volume", VOLUME, **words) + BRIDGES


def bridges_of(folder, count):
    """Liquid between two grains at each frame: {(i, j): volume}."""
    found, wanted = [], False
    for line in (folder / "dump.bridges").read_text().splitlines():
        if line.startswith("ITEM: TIMESTEP"):
            found.append({})
        if line.startswith("ITEM"):
            wanted = line.startswith("ITEM: ENTRIES")
        elif wanted:
            i, j, held = map(float, line.split())
            if held:
                pair = tuple(sorted((int(i) - 1, int(j) - 1)))
                assert pair not in found[-1]
                found[-1][pair] = held
    return found


class Rules:
    """The rules of the page, told once more."""

    def __init__(self, table, radii, film):
        self.table, self.radii, self.film = table, radii, film.copy()
        self.pairs, self.walls = {}, {}

    def end(self, held, *radii):
        """Rupture distance; 0 for less than the table knows."""
        mean = 2.0 / sum(1.0 / r for r in radii)
        if held < self.table.reduced[0] * mean**3:
            return 0.0
        return float(self.table.rupture_distance(held, *radii, TENSION))

    def gaps(self, places):
        """From surface to surface, of all pairs."""
        way = places[None] - places[:, None]
        way[..., :2] -= SIDE * np.round(way[..., :2] / SIDE)
        return np.linalg.norm(way, axis=-1) - self.radii[:, None] - self.radii

    def step(self, places):
        """What breaks and what forms at these places."""
        gaps = self.gaps(places)
        for wall, was_far in [(key, far) for key, (_, far) in self.walls.items()]:
            if was_far:  # seen at the end of the step before
                self.film[wall[0]] += self.walls.pop(wall)[0]
        for (i, j), held in list(self.pairs.items()):
            if gaps[i, j] >= self.end(held, self.radii[i], self.radii[j]):
                self.film[[i, j]] += 0.5 * self.pairs.pop((i, j))
        touching = [(i, j) for i, j in np.argwhere(gaps <= 0.0).tolist() if i < j and (i, j) not in self.pairs]
        count = np.bincount(np.ravel(touching).astype(int), minlength=len(self.radii))
        offer = SHARE * self.film / np.maximum(count, 1)
        for i, j in touching:
            held = min(VOLUME, offer[i] + offer[j])
            if self.end(held, self.radii[i], self.radii[j]) > 0.0:
                self.pairs[i, j] = held
                self.film[[i, j]] -= held * offer[[i, j]] / (offer[i] + offer[j])
        for side, distance in enumerate((places[:, 2], SIDE - places[:, 2])):
            for i, gap in enumerate(distance - self.radii):
                held = self.walls.get((i, side), (0.0, False))[0]
                if not held and gap <= 0.0:
                    held = min(VOLUME, SHARE * self.film[i])
                    if self.end(held, self.radii[i], math.inf) > 0.0:
                        self.film[i] -= held
                        self.walls[i, side] = held, False
                elif held:
                    self.walls[i, side] = held, gap >= self.end(held, self.radii[i], math.inf)


@pytest.mark.parametrize("ranks", [1, 2])
def test_liquid_goes_from_grains_to_bridges_and_back(liggghts, ranks, tmp_path):
    """Film and bridges of each grain, step by step, as the rules have it; the sum of all stays what it was."""
    table = save_tables(tmp_path, "volume", "equal")[1, 1]
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print("seed", seed)
    random = np.random.default_rng(seed)
    rows, radii, film = heap(random)
    script = scene(tmp_path, rows, film, random.normal(0.0, 1.5, (len(rows), 3)))
    done = simulated(liggghts, tmp_path, script + "run 600\n", ranks)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    numbers, bridges = dumped(tmp_path), bridges_of(tmp_path, len(rows))
    rules, events, former = Rules(table, radii, film), 0, {}
    total = film.sum()
    rules.step(numbers[0, :, :3])  # what LIGGGHTS does when a run begins
    for frame, told in zip(numbers, bridges, strict=True):
        if frame is not numbers[0]:
            rules.step(frame[:, :3])
        assert told.keys() == rules.pairs.keys()
        for pair, held in told.items():
            assert held == pytest.approx(rules.pairs[pair], rel=1e-9)
        np.testing.assert_allclose(frame[:, 6], rules.film, rtol=0.0, atol=1e-9 * VOLUME)
        assert frame[:, 6].min() > -1e-12 * VOLUME
        on_walls = np.zeros(len(rows))
        for (i, _), (held, _) in rules.walls.items():
            on_walls[i] += held
        np.testing.assert_allclose(frame[:, 7:].sum(axis=1), on_walls, rtol=0.0, atol=1e-9 * VOLUME)
        assert frame[:, 6:].sum() + sum(told.values()) == pytest.approx(total, rel=1e-12)
        events += len(former.keys() ^ told.keys())
        former = told
    assert events > 40
    assert len(rules.walls) > 2


@pytest.mark.parametrize(("writers", "readers"), [(1, 1), (2, 1), (1, 2)])
def test_bridges_and_films_outlive_a_restart(liggghts, writers, readers, tmp_path):
    save_tables(tmp_path, "volume", "equal")
    random = np.random.default_rng(5)
    rows, _, film = heap(random)
    script = scene(tmp_path, rows, film, random.normal(0.0, 1.5, (len(rows), 3)))
    done = simulated(liggghts, tmp_path, script + "run 250\nwrite_restart half\nrun 100\n", writers)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    whole, bridges = dumped(tmp_path)[-1], bridges_of(tmp_path, len(rows))[-1]
    done = simulated(liggghts, tmp_path, resumed(script) + "run 100\n", readers)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    again, told = dumped(tmp_path)[-1], bridges_of(tmp_path, len(rows))[-1]
    np.testing.assert_allclose(again[:, :3], whole[:, :3], rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(again[:, 6], whole[:, 6], rtol=0.0, atol=1e-9 * VOLUME)
    np.testing.assert_allclose(again[:, 7:].sum(axis=1), whole[:, 7:].sum(axis=1), rtol=0.0, atol=1e-9 * VOLUME)
    assert told.keys() == bridges.keys()
    assert len(told) > 3
    assert np.count_nonzero(whole[:, 7:]) > 2


def test_the_grain_that_is_left_has_half_of_the_liquid(liggghts, tmp_path):
    save_tables(tmp_path, "volume", "equal")
    radius = 25e-6
    rows = [(1, (0.0, 0.0, 0.0), radius), (1, (0.0, 0.0, 2 * radius * (1 - 1e-4)), radius)]
    words = {
        "words": "film on",
        "before": "fix film all property/atom film scalar yes no no 3e-16",
        "columns": "f_film",
    }
    script = scene_of(rows, "volume", VOLUME, every=1, **words)
    script += "group gone id 2\nrun 3\ndelete_atoms group gone compress no\nrun 2\n"
    assert simulated(liggghts, tmp_path, script).returncode == 0
    text = (tmp_path / "dump.pull").read_text()
    films = [float(line.split()[-1]) for line in text.splitlines() if line.startswith("1 ")]
    np.testing.assert_allclose(films, [3e-16] + 3 * [3e-16 - 0.5 * VOLUME] + 2 * [3e-16], rtol=1e-12)


def test_films_alone_may_say_how_much_a_bridge_holds(liggghts, tmp_path):
    """Neighbours are sought as far as the most liquid reaches that the table knows, where more than that is allowed."""
    table = save_tables(tmp_path, "volume", "equal")[1, 1]
    radius = 25e-6
    rows = [(1, (0.0, 0.0, 0.0), radius), (1, (0.0, 0.0, 2 * radius * (1 - 2e-3)), radius)]
    words = {"words": "film on", "before": "fix film all property/atom film scalar yes no no 3e-16"}
    script = scene_of(rows, "volume", 1e-6, upper=(2,), **words)
    numbers = rows_of(liggghts, tmp_path, script + "run 600\n")
    gap = numbers[:, 1, 2] - 2 * radius
    clear = (gap > 0.0) & (np.abs(gap / table.rupture_distance(6e-16, radius, radius, TENSION) - 1.0) > 1e-4)
    expected = table.force(gap, 6e-16, radius, radius, TENSION)
    np.testing.assert_allclose(numbers[clear, 0, 5], expected[clear], rtol=0.0, atol=1e-9 * expected.max())
    assert 0.0 < np.count_nonzero(expected[clear] == 0.0) < 0.8 * np.count_nonzero(clear)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"words": "film on"}, "film is not there; make it by 'fix ID all property/atom film scalar yes no no VOLUME'"),
        ({"words": "film on share 1.5"}, "share 1.5 is not in (0, 1]"),
        (
            {"words": "viscosity 1e-3"},
            "viscosity and smallest_gap go together: without a smallest gap the force has no",
        ),
        ({"words": "viscosity -1"}, "viscosity and smallest_gap are > 0"),
        ({"is_drained": True, "words": "film on"}, "film: a table at constant volume is missing"),
        ({"model": "hertz"}, "a wall has it, and so has to have pair_style gran"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(liggghts, change, reason, tmp_path):
    change = dict(change)
    held, value = ("suction", SUCTION) if change.pop("is_drained", False) else ("volume", VOLUME)
    save_tables(tmp_path, held, "equal")
    flat = f"fix flat all wall/gran model {MODEL} primitive type 2 zplane -1e-3"
    script = scene_of([(1, (0.0, 0.0, 0.0), 25e-6)], held, value, walls=flat, **change)
    done = simulated(liggghts, tmp_path, script + "run 1\n")
    assert done.returncode != 0
    (line,) = [line for line in done.stderr.splitlines() if line.startswith("cohesion model pendular: ")]
    assert line.removeprefix("cohesion model pendular: ").startswith(reason)


def test_the_example_runs_as_it_says(liggghts, tmp_path):
    save_tables(tmp_path, "volume", "equal")
    shutil.copy(EXAMPLES / "box.stl", tmp_path)
    done = simulated(liggghts, tmp_path, (EXAMPLES / "in.film").read_text())
    assert done.returncode == 0, done.stdout[-2000:]
    film, pairs, walls, total = np.loadtxt(tmp_path / "film.txt", skiprows=1).T
    np.testing.assert_allclose(film + pairs + walls, total, rtol=1e-13)
    np.testing.assert_allclose(total, 150 * 6e-16, rtol=1e-12)
    assert film[-1] < 0.6 * film[0]
    assert min(pairs[-1], walls[-1]) > 0.05 * film[0]
