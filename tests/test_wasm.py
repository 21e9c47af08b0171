"""The exact solver in WebAssembly: its numbers in Node beside Python's, and what it refuses."""

import json
import math
import shutil
import subprocess
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from tools.code_blocks import code_blocks

import pendular as pl
from pendular.codes import wasm
from pendular.ground import webassembly
from pendular.laws._registry import is_of_the_house
from pendular.laws._rows import answer_of

pytestmark = [
    pytest.mark.needs("numba"),
    pytest.mark.skipif(webassembly.linker() is None, reason="wasm-ld is not installed: apt-get install lld"),
]
NODE = pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")

ROOT = Path(__file__).parents[1]
SEED = 20261129
TENSION = 0.0728
ASK = """
import { readFileSync } from "node:fs";
import { load } from "./pendular.mjs";
const solver = await load();
const answers = [];
for (const { ask, given } of JSON.parse(readFileSync(0), (_, value) => (value === "plane" ? Infinity : value))) {
  try {
    const [law, quantity] = ask.split(" ");
    answers.push(quantity ? solver.laws[law][quantity](...given) : solver[ask](...given));
  } catch (error) {
    answers.push(`${error.name}: ${error.message}`);
  }
}
console.log(JSON.stringify(answers, (_, value) => (ArrayBuffer.isView(value) ? [...value] : value)));
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """What the command writes, and a script that asks what stands on its input."""
    folder = tmp_path_factory.mktemp("wasm") / "page"
    scripts = ["pendular.mjs", "pendular.d.mts", "solids.mjs", "solids.d.mts"]
    assert [path.name for path in wasm.write(folder)] == ["pendular.wasm", "solids.wasm", *scripts]
    (folder / "ask.mjs").write_text(ASK)
    (folder / "ask_solids.mjs").write_text(
        ASK.replace("{ load }", "{ loadSolids }")
        .replace("./pendular", "./solids")
        .replace("await load()", "await loadSolids()")
    )
    return folder


@pytest.fixture(scope="module")
def answers_of(folder):
    """Answers of the module to questions."""

    def answers_of(questions, script="ask.mjs"):
        done = subprocess.run(
            ["node", script], cwd=folder, input=json.dumps(questions), capture_output=True, text=True, check=True
        )
        return json.loads(done.stdout)

    return answers_of


def question(ask, pair, *numbers, tension=TENSION, **control):
    radius = ["plane" if radius == math.inf else radius for radius in np.broadcast_to(pair.radius, 2).tolist()]
    angle = np.broadcast_to(pair.contact_angle, 2).tolist()
    held = {"surfaceTension": tension, **control}
    return {"ask": ask, "given": [{"radius": radius, "contactAngle": angle}, *numbers, held]}


def random_pair(rng):
    radius = rng.choice([50e-6, 80e-6, 1e-3, math.inf], 2, p=[0.4, 0.3, 0.2, 0.1])
    radius[rng.integers(2)] = 10.0 ** rng.uniform(-6, -3)
    return pl.Pair(tuple(radius), tuple(rng.uniform(0.0, 2.4, 2)))


def assert_same(found, bridge, unsure):
    """All that JavaScript is given of a bridge is what Python has of it, but for what has no digits there."""
    named = {"liquidGasArea": "liquid_gas_area", "capillaryTensor": "capillary_tensor"}
    energies = ("surfaceEnergy", "grandPotential")  # small differences of areas
    area = TENSION * np.max([*np.atleast_1d(bridge.wetted_area), bridge.liquid_gas_area])
    across = TENSION / np.min(bridge.contact_radius)  # the suction is what two curvatures leave of each other
    for name, value in found.items():
        if name == "meridian" or name in unsure:
            continue
        if name in energies:
            own = {"surfaceEnergy": bridge.surface_energy, "grandPotential": bridge.grand_potential}[name]
            assert value == pytest.approx(own, rel=1e-12, abs=1e-12 * area)
            continue
        own = named.get(name) or "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in name)
        wanted = np.asarray(getattr(bridge, own), float).tolist()
        value = math.nan if value is None else value  # JSON has no NaN
        scale = np.abs(np.asarray(wanted)).max()
        scale = max(scale, across) if name == "suction" else scale
        digits = 1e-10 if name == "stiffness" else 1e-12  # a quotient of determinants
        assert value == pytest.approx(wanted, rel=digits, abs=digits * scale, nan_ok=True), name


@NODE
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_numbers_are_those_of_python(answers_of, control):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    liquid, asked, bridges = pl.Liquid(surface_tension=TENSION), [], []
    for _ in range(150):
        pair = random_pair(rng)
        size = float(pair.derjaguin_radius)
        held = {"suction": 10.0 ** rng.uniform(-2, 4) * TENSION / size, "volume": 10.0 ** rng.uniform(-9, 0) * size**3}
        given = {control: float(held[control])}
        rupture = pl.rupture(pair, **given, liquid=liquid)
        asked.append(question("rupture", pair, **given))
        bridges.append(rupture)
        if not rupture.exists:
            continue
        for part in (0.2, 0.9, 1.1):
            gap = part * float(rupture.separation)
            asked.append(question("bridge", pair, gap, **given))
            bridges.append(pl.bridge(pair, gap, **given, liquid=liquid))
    found = answers_of(asked)
    assert sum(bool(bridge.exists) for bridge in bridges) > 300
    for answer, bridge, given in zip(found, bridges, asked, strict=True):
        assert (answer is not None) == bool(bridge.exists)
        if answer is not None:  # a stiffness at rupture is a division by nothing
            assert_same(answer, bridge, {"stiffness", "unstableDirections"} if given["ask"] == "rupture" else set())


@NODE
def test_bridges_in_a_row_are_the_same_one_by_one(answers_of):
    pair, liquid = pl.Pair((50e-6, math.inf), (0.3, 0.7)), pl.Liquid(surface_tension=TENSION)
    end = float(pl.rupture(pair, suction=5e3, liquid=liquid).separation)
    gaps = np.linspace(-0.1, 1.1, 60) * end
    other = question("bridge", pl.Pair(1e-3, 1.2), 0.0, suction=1.0)  # which leaves its state behind
    _, found = answers_of([other, question("bridges", pair, gaps.tolist(), suction=5e3)])
    bridges = pl.bridge(pair, gaps, suction=5e3, liquid=liquid)
    assert [answer is not None for answer in found] == bridges.exists.tolist()
    forces = [answer["force"] if answer else 0.0 for answer in found]
    np.testing.assert_allclose(forces, bridges.force, rtol=1e-11)


@NODE
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_curves_outlines_and_lower_ends_are_those_of_python(answers_of, control):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED + 1)
    liquid, asked, curves, ends, drawn = pl.Liquid(surface_tension=TENSION), [], [], 0, 0
    for _ in range(40):
        pair = random_pair(rng)
        size = float(pair.derjaguin_radius)
        held = {"suction": 10.0 ** rng.uniform(-2, 4) * TENSION / size, "volume": 10.0 ** rng.uniform(-6, 3) * size**3}
        given = {control: float(held[control])}
        curves.append((pair, given, pl.curve(pair, **given, liquid=liquid, points=41)))
        asked += [question(ask, pair, **given) for ask in ("lowerEnd", "curve")]
        asked[-1]["given"].append(41)
    found = answers_of(asked)
    profiles = []
    for (pair, given, wanted), end, states in zip(curves, found[::2], found[1::2], strict=True):
        own = pl.rupture(pair, **given, liquid=liquid, end="lower")
        assert (end is not None) == bool(own.exists)
        if end is not None:
            ends += 1
            assert_same(end, own, {"stiffness", "unstableDirections"})
        exists = wanted.exists.tolist()
        assert [state is not None for state in states] == (exists if states else [])
        assert states or not any(exists)
        forces = [state["force"] for state in states if state]
        np.testing.assert_allclose(forces, wanted.force[wanted.exists], rtol=1e-11, atol=1e-12 * abs(wanted.force[0]))
        drawn += len(forces)
        if states and states[0]:
            profiles.append((pair, given, states[0]))
    assert drawn > 500
    assert control == "suction" or ends > 3
    asked = [question("profile", pair, state, 33, **given) for pair, given, state in profiles]
    for one in asked:
        del one["given"][-1]
    for (pair, given, state), outline in zip(profiles, answers_of(asked), strict=True):
        own = pl.bridge(pair, state["separation"], **given, liquid=liquid)
        if not own.exists:  # rupture itself, to the last digit
            continue
        profile, scale = own.profile(33), float(np.max(own.contact_radius))
        np.testing.assert_allclose(outline["x"], profile.x, rtol=1e-9, atol=1e-9 * scale)
        np.testing.assert_allclose(outline["y"], profile.y, rtol=1e-9)


@NODE
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_rows_are_the_bridges_one_by_one(answers_of, control):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED + 4)
    pairs = [random_pair(rng) for _ in range(60)]
    gaps = [float(rng.uniform(0.0, 0.05) * min(pair.radius)) if rng.random() < 0.9 else 0.0 for pair in pairs]
    held = {"suction": 20e3} if control == "suction" else {"volume": 1e-15}
    asked = [question("bridge", pair, gap, **held) for pair, gap in zip(pairs, gaps, strict=True)]
    solids = [number for one in asked for part in ("radius", "contactAngle") for number in one["given"][0][part]]
    liquid = asked[0]["given"][-1]
    rows, *one_by_one = answers_of([{"ask": "rows", "given": [solids, gaps, liquid]}, *asked])
    assert [bool(there) for there in rows["exists"]] == [one is not None for one in one_by_one]
    table = np.array(rows["numbers"], float).reshape(len(pairs), -1)
    names = {"force": "force", "volume": "volume", "area": "liquidGasArea", "neck_radius": "neckRadius"}
    for row, one in zip(table, one_by_one, strict=True):
        for own, name in names.items():
            value = row[rows["fields"].index(own)]
            assert value == pytest.approx(math.nan if one is None or one[name] is None else one[name], nan_ok=True)
    assert sum(rows["exists"]) > 15
    refused = [[solids[1:], gaps, liquid], [solids, [-1.0, *gaps[1:]], liquid]]
    assert answers_of([{"ask": "rows", "given": given} for given in refused]) == [
        "RangeError: pairs: give two radii and two angles for each separation",
        "RangeError: pair, separation, suction or volume: out of range",
    ]


@NODE
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_rates_of_the_force_are_its_differences(answers_of, control):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED + 3)
    liquid, bridges, asked = pl.Liquid(surface_tension=TENSION), [], []
    while len(bridges) < 25:
        radii = 10.0 ** rng.uniform(-5, -4, 2)
        radii[1] = math.inf if rng.random() < 0.3 else radii[1]
        pair = pl.Pair(tuple(radii), tuple(rng.uniform(0.2, 1.2, 2)))
        size = float(pair.derjaguin_radius)
        held = {"suction": 10.0 ** rng.uniform(0, 2) * TENSION / size, "volume": 10.0 ** rng.uniform(-5, -2) * size**3}
        given = {control: float(held[control])}
        rupture = pl.rupture(pair, **given, liquid=liquid)
        if rupture.exists:
            gap = float(rng.uniform(0.1, 0.6) * rupture.separation)
            bridges.append((pair, gap, given))
            asked.append(question("bridge", pair, gap, **given))
    states = answers_of(asked)
    rates = answers_of(
        [question("forceRates", pair, state, **given) for (pair, _, given), state in zip(bridges, states, strict=True)]
    )
    for (pair, gap, given), found in zip(bridges, rates, strict=True):
        numbers = np.array([gap, given[control], *np.log(pair.radii), *np.cos(pair.contact_angles)])
        steps = np.array([1e-4 * gap, 1e-4 * given[control], 1e-4, 1e-4, 1e-4, 1e-4])
        for i, name in enumerate(("separation", "held", "logRadius1", "logRadius2", "cosAngle1", "cosAngle2")):
            if not math.isfinite(numbers[i]):  # of a plane
                assert found[name] == 0.0
                continue
            forces = []
            for way in (1.0, -1.0):
                place = numbers + way * steps * (np.arange(6) == i)
                moved = pl.Pair(tuple(np.exp(place[2:4])), tuple(np.arccos(place[4:])))
                forces.append(float(pl.bridge(moved, place[0], **{control: place[1]}, liquid=liquid).force))
            slope = (forces[0] - forces[1]) / (2.0 * steps[i])
            assert found[name] == pytest.approx(slope, rel=1e-5, abs=1e-7 * abs(forces[0]) / steps[i] * 1e-4), name


@NODE
def test_laws_are_those_of_python(answers_of):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED + 2)
    asked, wanted = [], []
    for law in pl.laws.values():
        for quantity, function in law.kernels.items():
            if quantity not in ("force", "rupture") or not is_of_the_house(law.name):
                continue
            for _ in range(60):
                kappa = rng.choice([0.0, 0.3, 1.0])
                angle = rng.uniform(0.0, 1.5) * rng.integers(2)
                control = 10.0 ** (rng.uniform(-1, 5) if law.control == "suction" else rng.uniform(-7, 0))
                row = [control, angle, angle, 2.0 - kappa, kappa]
                row = [10.0 ** rng.uniform(-5, 0) * rng.integers(2), *row] if quantity == "force" else row
                asked.append({"ask": f"{law.name} {quantity}", "given": row})
                wanted.append(answer_of(function, row))
    assert np.isfinite(wanted).sum() > 1000
    found = [math.nan if answer is None else answer for answer in answers_of(asked)]  # JSON has no NaN
    np.testing.assert_allclose(found, wanted, rtol=1e-12)


@NODE
def test_the_page_shows_what_its_scripts_print(folder):
    blocks = code_blocks((ROOT / "docs" / "howto" / "javascript.md").read_text(encoding="utf-8"))
    pairs = [pair for pair in pairwise(blocks) if pair[0].language == "js"]
    assert len(pairs) == 2
    for script, printed in pairs:
        (folder / "page.mjs").write_text(script.code, encoding="utf-8")
        done = subprocess.run(["node", "page.mjs"], cwd=folder, capture_output=True, text=True, check=True)
        assert done.stdout.strip() == printed.code.strip()


# -- Other solids ----------------------------------------------------------------------------------------------------


def told(solid):
    """A solid as JavaScript is told of it."""
    if isinstance(solid, pl.Cone):
        return {"kind": "cone", "halfAngle": solid.half_angle, "tipRadius": solid.tip_radius}
    if isinstance(solid, pl.Paraboloid):
        return {"kind": "paraboloid", "tipRadius": solid.tip_radius}
    if isinstance(solid, pl.Disc):
        return {"kind": "disc", "radius": solid.radius, "pinned": solid.pinned}
    return {"kind": "sphere", "radius": "plane" if math.isinf(solid) else float(solid)}


def question_of_solids(ask, pair, *numbers, **control):
    angles = [float(angle) for angle in pair.contact_angles]
    given = {"solids": [told(solid) for solid in pair.solids], "contactAngle": angles}
    return {"ask": ask, "given": [given, *numbers, {"surfaceTension": TENSION, **control}]}


def random_solid(rng):
    size, half = float(10.0 ** rng.uniform(-6.0, -4.0)), float(rng.uniform(0.3, 1.5))
    cones = pl.Cone(half), pl.Cone(half, size)
    others = pl.Paraboloid(size), pl.Disc(size), pl.Disc(size, pinned=True), size, math.inf
    return [*cones, *others][rng.integers(7)]


def random_pair_of_solids(rng):
    while True:
        solids = random_solid(rng), random_solid(rng)
        if not all(isinstance(solid, float) for solid in solids):
            return pl.Pair(solids, tuple(rng.uniform(0.05, 1.7, 2).tolist()))


@NODE
@pytest.mark.filterwarnings("ignore::pendular.ConvergenceWarning")
@pytest.mark.parametrize("control", ["suction", "volume"])
def test_numbers_of_other_solids_are_those_of_python(answers_of, control):
    print(f"seed {SEED}")
    rng, liquid, asked, bridges = np.random.default_rng(SEED + 4), pl.Liquid(surface_tension=TENSION), [], []
    for _ in range(60):
        pair = random_pair_of_solids(rng)
        size = 10.0 ** rng.uniform(-6.0, -4.5)
        given = {control: float(TENSION / size if control == "suction" else size**3)}
        end = pl.rupture(pair, **given, liquid=liquid)
        asked.append(question_of_solids("rupture", pair, **given))
        bridges.append(end)
        for part in (0.2, 0.9, 1.1) if end.exists else ():
            gap = part * float(end.separation)
            asked.append(question_of_solids("bridge", pair, gap, **given))
            bridges.append(pl.bridge(pair, gap, **given, liquid=liquid))
    found, stood = answers_of(asked, "ask_solids.mjs"), 0
    for answer, bridge, given in zip(found, bridges, asked, strict=True):
        if isinstance(answer, str):  # neither found nor excluded
            assert answer.startswith("Error: the ")
            assert math.isnan(bridge.force)
            continue
        assert (answer is not None) == bool(bridge.exists)
        if answer is not None:
            stood += 1
            assert_same(answer, bridge, {"stiffness", "unstableDirections"} if given["ask"] == "rupture" else set())
    print(f"{stood} bridges")
    assert stood > 60


@NODE
@pytest.mark.filterwarnings("ignore::pendular.ConvergenceWarning")
def test_curves_and_outlines_of_other_solids_are_those_of_python(answers_of):
    print(f"seed {SEED}")
    rng, liquid, asked, curves = np.random.default_rng(SEED + 5), pl.Liquid(surface_tension=TENSION), [], []
    for _ in range(16):
        pair = random_pair_of_solids(rng)
        given = {"volume": float(10.0 ** rng.uniform(-17.0, -14.0))}
        curves.append((pair, given, pl.curve(pair, **given, liquid=liquid, points=21)))
        asked.append(question_of_solids("curve", pair, **given))
        asked[-1]["given"].append(21)
    drawn, profiles = 0, []
    for (pair, given, wanted), states in zip(curves, answers_of(asked, "ask_solids.mjs"), strict=True):
        exists = wanted.exists.tolist()
        if isinstance(states, str):
            assert not any(exists)
            continue
        assert [state is not None for state in states] == (exists if states else [])
        forces = [state["force"] for state in states if state]
        scale = np.max(np.abs(wanted.force[wanted.exists]), initial=0.0)
        np.testing.assert_allclose(forces, wanted.force[wanted.exists], rtol=1e-9, atol=1e-9 * scale)
        drawn += len(forces)
        if states and states[3]:
            profiles.append((pair, given, states[3]))
    assert drawn > 150
    asked = [question_of_solids("profile", pair, state, 33) for pair, _, state in profiles]
    for one in asked:
        del one["given"][-1]
    checked = 0
    for (pair, given, state), outline in zip(profiles, answers_of(asked, "ask_solids.mjs"), strict=True):
        own = pl.bridge(pair, state["separation"], **given, liquid=liquid)
        if not own.exists or abs(own.contact_radius[0] / state["contactRadius"][0] - 1.0) > 1e-6:
            continue  # another bridge has less energy
        profile, scale = own.profile(33), float(np.max(own.contact_radius))
        np.testing.assert_allclose(outline["x"], profile.x, rtol=1e-8, atol=1e-8 * scale)
        np.testing.assert_allclose(outline["y"], profile.y, rtol=1e-8)
        checked += 1
    assert checked > 4


@NODE
def test_what_is_no_question_about_other_solids_is_refused(answers_of):
    disc, plate = pl.Disc(1e-5), math.inf
    flat, good = pl.Pair((disc, plate), 0.5), pl.Pair((pl.Cone(1.0), plate), 0.5)
    refused = [
        question_of_solids("bridge", flat, 0.0, volume=1e-15),
        question_of_solids("bridge", good, -1e-9, volume=1e-15),
        question_of_solids("bridge", good, 1e-9, volume=0.0),
        question_of_solids("rupture", pl.Pair((pl.Cone(1.0), plate), 0.5), volume=-1.0),
    ]
    unknown = question_of_solids("bridge", good, 1e-9, volume=1e-15)
    unknown["given"][0]["solids"][0] = {"kind": "cube", "radius": 1e-5}
    found = answers_of([*refused, unknown], "ask_solids.mjs")
    assert found[:-1] == ["RangeError: solids, separation, suction or volume: out of range"] * len(refused)
    assert found[-1] == "TypeError: solids: 'cube' is not one of sphere,cone,paraboloid,disc,pinned disc"


@NODE
def test_what_is_no_question_is_refused(answers_of):
    pair = pl.Pair(50e-6)
    good = question("bridge", pair, 1e-6, suction=5e3)
    cases = {
        "RangeError: pair, separation, suction or volume: out of range": [
            question("bridge", pair, 1e-6, volume=-1.0),
            question("bridge", pair, -1e-4, suction=5e3),
            question("bridge", pair, 1e-6, tension=0.0, suction=5e3),
        ],
        "TypeError: give suction or volume, one of them": [
            question("bridge", pair, 1e-6),
            question("rupture", pair, suction=1.0, volume=1.0),
        ],
        "TypeError: radius: give a number, or one for each solid": [
            {"ask": "bridge", "given": [{"radius": radius}, 0.0, good["given"][2]]} for radius in ("x", [1, 2, 3], None)
        ],
    }
    asked = [case for group in cases.values() for case in group]
    wanted = [message for message, group in cases.items() for _ in group]
    assert answers_of(asked) == wanted


def test_the_module_is_small_and_asks_its_host_for_elementary_functions_alone(folder):
    for module, script in ((wasm.MODULE, wasm.SCRIPT), (wasm.SOLIDS_MODULE, wasm.SOLIDS_SCRIPT)):
        assert (folder / module).stat().st_size < 150e3
        text = (folder / script).read_text()
        assert f"by Pendular {pl.__version__} " in text
        assert "$${" not in text


def test_what_is_missing_is_told_in_one_line(tmp_path, monkeypatch):
    monkeypatch.setattr(wasm, "linker", lambda: None)
    with pytest.raises(
        ValueError, match=r"^wasm: needs wasm-ld, which links it; apt-get install lld, or brew install lld$"
    ):
        wasm.write(tmp_path)
    failing = tmp_path / "wasm-ld"
    failing.write_text("#!/bin/sh\necho 'no such symbol' >&2\nexit 1\n")
    failing.chmod(0o755)
    monkeypatch.setattr(wasm, "linker", lambda: str(failing))
    with pytest.raises(ValueError, match=r"^wasm: .*wasm-ld cannot link the module: no such symbol$"):
        wasm.write(tmp_path)
