"""The heap of the explorer page in Node: its grains, water and stress beside Python's, and what it refuses."""

import csv
import io
import itertools
import json
import re
import shutil
import subprocess
import warnings
from importlib.resources import files

import numpy as np
import pytest
from tools.explorer_packings import GRAINS, written

import pendular as pl
from pendular.codes import wasm
from pendular.front.explorer.files import page_files
from pendular.front.explorer.heap_records import heap_records, packings
from pendular.front.explorer.records import records
from pendular.ground import webassembly
from pendular.packing.report import curves_csv
from pendular.packing.retention import retention_of
from pendular.packing.setting import setting_of

pytestmark = [
    pytest.mark.needs("numba"),
    pytest.mark.skipif(webassembly.linker() is None, reason="wasm-ld is not installed: apt-get install lld"),
    pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed"),
]

SEED = 20261201
LEAST = 0.1  # ΔpR/γ at the lower end of the page's curve
ASK = """
import { readFileSync } from "node:fs";
import { load } from "./pendular.mjs";
import { wholeCurvesOf, suctionsBetween } from "./heap/curves.mjs";
import { grainsOf, linesOf, packingNamed } from "./heap/grains.mjs";
import { answersAt, membersOf, settingOf, wettedOf } from "./heap/wetted.mjs";
import { heapAnswerTo, rangeOf } from "./heap/heap_answer.mjs";
import { heapAt, heapHashOf } from "./heap/heap_view.mjs";
import { heapCsvOf, heapProgramOf } from "./heap/heap_words.mjs";
const solver = await load();
const heapOf = (asked) => (asked.name ? packingNamed(asked.name, asked.radius) : grainsOf(asked.text, asked.unit));
const ASKS = {
  state(asked) {
    const setting = settingOf(heapOf(asked), asked.angle, asked.tension, asked.suction, solver, asked.condensation);
    const answers = answersAt(setting, asked.suction, solver);
    const members = membersOf(answers, asked.path);
    const pairs = members.map((row) => [setting.pairs.first[row], setting.pairs.second[row]]);
    return { ...wettedOf(setting, answers, members), pairs };
  },
  curves(asked) {
    const setting = settingOf(heapOf(asked), asked.angle, asked.tension, asked.low, solver);
    const curves = wholeCurvesOf(setting, suctionsBetween(asked.low, asked.high, asked.count), solver);
    return { ...curves, csv: heapCsvOf(curves) };
  },
  lines: (asked) => linesOf(heapOf(asked)),
  view(asked) {
    const view = heapAt(asked.hash);
    const answer = heapAnswerTo(view, asked.own, solver);
    const range = rangeOf(answer);
    const { values, notices } = answer;
    return { hash: heapHashOf(view), values, notices, range, program: heapProgramOf(answer, range, 5) };
  },
};
const answers = JSON.parse(readFileSync(0)).map((asked) => {
  try {
    return ASKS[asked.ask](asked);
  } catch (error) {
    return `${error.name}: ${error.message}`;
  }
});
console.log(JSON.stringify(answers));
"""


@pytest.fixture(scope="module")
def answers_of(tmp_path_factory):
    """Answers of the page's modules to questions."""
    folder = tmp_path_factory.mktemp("page")
    static = files("pendular.front.explorer") / "static"
    shutil.copytree(str(static), folder, dirs_exist_ok=True)
    wasm.write(folder)
    (folder / "records.mjs").write_text(f"export const RECORDS = {json.dumps(records())};")
    told = (
        f"export const HEAP_RECORDS = {json.dumps(heap_records())};\nexport const PACKINGS = {json.dumps(packings())};"
    )
    (folder / "heap" / "heap_records.mjs").write_text(told)
    (folder / "ask.mjs").write_text(ASK)

    def answers_of(asked):
        done = subprocess.run(
            ["node", "ask.mjs"], cwd=folder, input=json.dumps(asked), capture_output=True, text=True, check=True
        )
        return json.loads(done.stdout)

    return answers_of


def lines_of(heap: pl.Packing, unit: float = 1.0) -> str:
    """Grains as a person pastes them, with all digits."""
    cell = "" if heap.cell is None else "cell " + " ".join(map(repr, (np.diag(heap.cell) / unit).tolist())) + "\n"
    rows = np.column_stack([heap.positions, heap.radii]) / unit
    return cell + "\n".join(" ".join(map(repr, row)) for row in rows.tolist()) + "\n"


def random_heap(rng) -> pl.Packing:
    """Grains on a lattice that is shaken: some overlap, some touch nearly, some are far; open, or in a cell."""
    size = 10.0 ** rng.uniform(-6, -3)
    side, pitch = int(rng.integers(4, 6)), rng.uniform(1.9, 2.4)
    places = np.stack(np.meshgrid(*(np.arange(side),) * 3, indexing="ij"), axis=-1).reshape(-1, 3) * pitch
    places = places + rng.uniform(-0.12, 0.12, places.shape) * rng.integers(2)
    radii = size * rng.uniform(0.9, 1.1, len(places)) if rng.random() < 0.7 else np.full(len(places), size)
    cell = None if rng.random() < 0.4 else (side * pitch * size,) * 3
    return pl.Packing(places * size, radii, cell=cell)


def test_water_and_stress_are_those_of_python(answers_of):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    heaps = [random_heap(rng) for _ in range(24)]
    radii = 1e-4 * rng.uniform(0.8, 1.2, 80)
    heaps += [pl.random_packing(80, radii, friction=friction, seed=SEED) for friction in (0.0, 0.4)]
    asked, wanted = [], []
    for heap in heaps:
        liquid = pl.Liquid(surface_tension=float(rng.uniform(0.02, 0.08)))
        angle = float(np.deg2rad(rng.choice([0.0, rng.uniform(0.0, 75.0)])))
        suction = float(10.0 ** rng.uniform(-0.5, 2.3) * liquid.surface_tension / np.mean(heap.radii))
        for path in ("drying", "wetting"):
            held = {"angle": angle, "tension": liquid.surface_tension, "suction": suction, "path": path}
            held["condensation"] = condensation = bool(rng.random() < 0.7)
            asked.append({"ask": "state", "text": lines_of(heap), "unit": "m", **held})
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", pl.PackingWarning)  # of the shaken ones, on purpose
                wanted.append(pl.wet(heap, angle, suction=suction, liquid=liquid, path=path, condensation=condensation))
    bridges = differ = meeting = 0
    for question, found, w in zip(asked, answers_of(asked), wanted, strict=True):
        assert isinstance(found, dict), (found, question["suction"])
        assert found["pairs"] == w.bridges.pairs.tolist()
        assert found["bridges"] == len(w.bridges)
        if not len(w.bridges):
            continue
        own = {
            name: getattr(w, name)
            for name in (
                "liquid_volume",
                "saturation",
                "water_content",
                "suction_stress",
                "chi",
                "interface_area",
                "coordination",
                "porosity",
            )
        }
        own |= {"mean_force": np.mean(w.bridges.force)}
        own |= {"meeting_grains": w.meetings.grains, "meeting_liquid": w.meetings.liquid}
        for name, value in own.items():
            assert found[name] == pytest.approx(float(value), rel=1e-12), name
        stress = w.stress[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        assert found["stress"] == pytest.approx(stress.tolist(), rel=1e-12, abs=1e-12 * np.abs(stress).max())
        bridges += len(w.bridges)
        meeting += w.meetings.any
    for drying, wetting in zip(wanted[::2], wanted[1::2], strict=True):
        differ += len(drying.bridges) != len(wetting.bridges)
    print(f"{bridges} bridges, {differ} heaps with a history, {meeting} states with meetings")
    assert bridges > 3000
    assert differ > 3
    assert meeting > 3


def test_curves_are_those_of_python(answers_of):
    water = pl.Liquid.water()
    angle = float(np.deg2rad(20.0))
    for name in packings():
        heap = packed(name, 50e-6)
        unit = water.surface_tension / 50e-6
        held = {"angle": angle, "tension": water.surface_tension, "low": LEAST * unit, "high": 300.0 * unit}
        (found,) = answers_of([{"ask": "curves", "name": name, "radius": 50e-6, "count": 13, **held}])
        setting = setting_of(heap, angle, water, 0.0, True, "exact")
        own = retention_of(setting, np.geomspace(held["low"], held["high"], 13), [])
        for path, limit in own.limits.items():
            assert np.isfinite(limit)
            assert found["limits"][path] == pytest.approx(limit, rel=5e-9)
        rows, wanted = (list(csv.reader(io.StringIO(text))) for text in (found["csv"], curves_csv(own)))
        assert rows[0] == wanted[0]
        assert [row[0] for row in rows] == [row[0] for row in wanted]
        numbers = [np.array([row[1:] for row in table[1:]], float) for table in (rows, wanted)]
        scale = np.abs(numbers[1]).max(axis=0)
        np.testing.assert_allclose(numbers[0], numbers[1], rtol=1e-12, atol=1e-12 * scale.max())
        np.testing.assert_allclose(numbers[0][:, :9], numbers[1][:, :9], rtol=1e-12)


def packed(name: str, radius: float) -> pl.Packing:
    """A packing of the page as Python makes it of the same numbers."""
    told = packings()[name]
    positions = np.reshape(told["positions"], (-1, 3)) * radius
    radii = np.broadcast_to(np.array(told["radii"]) * radius, len(positions))
    return pl.Packing(positions, radii, cell=(told["side"] * radius,) * 3)


@pytest.mark.parametrize(
    ("name", "friction", "contacts"), [("loose", 0.5, 3.7), ("close", 0.0, 5.7), ("mixed", 0.3, 3.2)]
)
def test_packings_of_the_page_are_as_the_package_makes_them(name, friction, contacts):
    heap = packed(name, 1.0)
    assert heap.count == GRAINS
    assert heap.radii.mean() == pytest.approx(1.0, rel=1e-9)
    again = pl.random_packing(GRAINS, heap.radii, friction=friction, seed=2)
    solid = 4.0 / 3.0 * np.pi * np.sum(heap.radii**3)
    assert solid / heap.volume == pytest.approx(solid / again.volume, abs=0.02)
    dry = pl.Liquid(surface_tension=1.0)
    first = pl.wet(heap, 0.0, suction=1e3, liquid=dry)
    assert contacts < first.contacts < 6.0  # as friction lets them rest, and no more than hold them
    overlap = float(-first.bridges.separation.min())
    assert overlap < 1e-3
    rounded = pl.Packing(heap.positions.round(9), heap.radii, cell=heap.cell)
    assert pl.wet(rounded, 0.0, suction=1e3, liquid=dry).contacts == pytest.approx(first.contacts, abs=0.2)
    assert written(heap)["positions"] == packings()[name]["positions"]


def test_grains_come_back_as_they_are_written(answers_of, tmp_path):
    rng = np.random.default_rng(SEED + 1)
    for heap in [random_heap(rng) for _ in range(6)]:
        (lines,) = answers_of([{"ask": "lines", "text": lines_of(heap), "unit": "m"}])
        assert answers_of([{"ask": "lines", "text": lines, "unit": "m"}]) == [lines]
        (tmp_path / "grains.txt").write_text(lines)
        table = np.loadtxt(tmp_path / "grains.txt")
        np.testing.assert_array_equal(table, np.column_stack([heap.positions, heap.radii]))
        if heap.cell is not None:
            told = re.search(r"^# cell (.*)$", lines, re.MULTILINE)
            assert list(map(float, told[1].split())) == np.diag(heap.cell).tolist()


def test_grains_beyond_their_cell_are_those_inside(answers_of):
    rng = np.random.default_rng(SEED + 3)
    heap = next(heap for heap in iter(lambda: random_heap(rng), None) if heap.cell is not None)
    moved = pl.Packing(heap.positions + rng.integers(-2, 3, (heap.count, 3)) @ heap.cell, heap.radii, cell=heap.cell)
    held = {"ask": "state", "unit": "m", "angle": 0.3, "tension": 0.07, "path": "drying"}
    held["suction"] = 0.7 / float(heap.radii.mean())
    found = answers_of([{**held, "text": lines_of(one)} for one in (heap, moved)])
    assert found[0]["pairs"] == found[1]["pairs"]
    for name in ("saturation", "suction_stress", "interface_area"):
        assert found[1][name] == pytest.approx(found[0][name], rel=1e-10)


def test_units_are_those_typed(answers_of):
    rng = np.random.default_rng(SEED + 2)
    heap = random_heap(rng)
    held = {"ask": "state", "angle": 0.3, "tension": 0.07, "suction": 0.7 / float(heap.radii.mean()), "path": "drying"}
    units = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "nm": 1e-9}
    found = answers_of([{**held, "text": lines_of(heap, size), "unit": unit} for unit, size in units.items()])
    for other in found[1:]:
        assert other["saturation"] == pytest.approx(found[0]["saturation"], rel=1e-9)


@pytest.mark.needs("data")
def test_the_program_gives_the_same_numbers(answers_of, tmp_path, monkeypatch, capsys):
    grains = "packing=mixed&radius=80um&contact-angle=35&liquid=ethanol&temperature=25degC"
    hash = f"view=heap&{grains}&suction=4kPa&path=wetting&condensation=no"
    (found,) = answers_of([{"ask": "view", "hash": hash}])
    assert found["hash"] == hash
    (lines,) = answers_of([{"ask": "lines", "name": "mixed", "radius": 80e-6}])
    (tmp_path / "grains.txt").write_text(lines)
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    exec(found["program"], names)
    assert names["w"].saturation == pytest.approx(found["values"]["saturation"], rel=1e-12)
    assert names["w"].suction_stress == pytest.approx(found["values"]["suction_stress"], rel=1e-12)
    assert len(names["w"].bridges) == found["values"]["bridges"]
    assert f"{found['values']['bridges']} bridges, saturation " in capsys.readouterr().out
    assert names["curves"].suction.values[[0, -1]] == pytest.approx([found["range"]["low"], found["range"]["high"]])


def test_what_positions_do_not_tell_is_told_as_python_tells_it(answers_of):
    asked, wanted = [], []
    for digits in (1, 2, 5, 9):
        for stretch, suction in itertools.product((1.01, 1.0, 0.97), (1e4, 1e6, 2e7)):
            heap = packed("close", 50.0)
            heap = pl.Packing((heap.positions * stretch).round(digits), 50.0, cell=heap.cell * stretch)
            told = f"packing=own&contact-angle=20&surface-tension=70mN/m&suction={suction!r}Pa"
            asked.append({"ask": "view", "hash": told, "own": {"text": lines_of(heap), "unit": "um"}})
            metres = pl.Packing(heap.positions * 1e-6, 50e-6, cell=heap.cell * 1e-6)
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                pl.wet(metres, np.deg2rad(20.0), suction=suction, liquid=pl.Liquid(surface_tension=0.07))
            wanted.append([str(one.message).partition(":")[2].split()[0] for one in caught])
    found = [[notice.removeprefix("The ").split()[0] for notice in one["notices"]] for one in answers_of(asked)]
    print(wanted)
    assert {"grains", "their"} <= {word for words in wanted for word in words}
    assert [[{"Grains": "grains", "digits": "their"}[word] for word in words] for words in found] == wanted


PAIR = "0 0 0 1\n2 0 0 1\n"


@pytest.mark.parametrize(
    ("text", "unit", "words"),
    [
        ("0 0 0 1\n2 0 x 1", "mm", "grains: line 2, '2 0 x 1', is not x y z r"),
        ("0 0 0 1\n2 0 0", "mm", "grains: line 2, '2 0 0', is not x y z r"),
        ("0 0 0 1", "mm", "grains: 1 lines are not 2 to 2000 of x y z r"),
        (PAIR * 1001, "mm", "grains: 2002 lines are not 2 to 2000 of x y z r"),
        ("0 0 0 1\n2 0 0 -1", "mm", "grains: the radius of grain 1, -0.001 m, is not > 0"),
        ("0 0 0 1\n0 0 0 1", "mm", "grains: 0 and 1 (counted from 0) have the same centre"),
        ("0 0 0 3\n1 0 0 1", "mm", "grains: 1 lies inside 0 (counted from 0)"),
        ("cell 4 4\n" + PAIR, "mm", "grains: line 1, 'cell 4 4', is not cell a b c"),
        ("cell 4 4 -4\n" + PAIR, "mm", "cell: one of its sides is not > 0"),
        ("cell 4 4 4\n" + PAIR, "mm", "cell: its side of 4\u00a0mm is less than twice the reach of a bridge"),
        (PAIR, "mmm", "unit: '1 mmm' has the unknown unit 'mmm'; write it like 1mm"),
        (PAIR, "Pa", "unit: '1 Pa' is not a quantity in m; write it like 1mm"),
    ],
)
def test_what_are_no_grains_is_refused(answers_of, text, unit, words):
    held = {"angle": 0.0, "tension": 0.07, "suction": 100.0, "path": "drying"}
    (found,) = answers_of([{"ask": "state", "text": text, "unit": unit, **held}])
    assert found.startswith(f"RangeError: {words}")


@pytest.mark.parametrize(
    ("hash", "words"),
    [
        ("packing=dense", "packing: 'dense' is not one of loose, close, mixed, own"),
        ("packing=own", "packing: own grains are not in an address"),
        ("suction=-1Pa", "suction: -1 Pa is not > 0"),
        ("suction=1e30Pa", "suction: '1e30 Pa' is not <= "),
        ("radius=0um", "radius: '0 µm' is not > 0"),
        ("contact-angle=190", "contact-angle: '190°' is not in [0, 180) degrees"),
        ("colour=red", "address: 'colour' is not one of packing, radius"),
        ("seen=1,2", "seen: '1,2' is not a turn and a tilt in degrees and a zoom"),
        ("plot=colour", "plot: 'colour' is not one of saturation"),
    ],
)
def test_what_is_no_view_is_refused(answers_of, hash, words):
    (found,) = answers_of([{"ask": "view", "hash": f"view=heap&{hash}"}])
    assert found.startswith(f"RangeError: {words}")


def test_the_script_of_the_heap_is_small_and_loads_nothing(tmp_path):
    contents = page_files()
    script = contents["heap.js"].decode()
    assert len(script) < 150e3
    assert not re.findall(r"(?m)^(?:import|export) ", script)
    assert "url(" not in script
    for name in ("heap.js",):
        (tmp_path / name).write_text(script, encoding="utf-8")
        subprocess.run(["node", "--check", str(tmp_path / name)], check=True)
    assert '"heap.js"' in contents["offline.js"].decode()
