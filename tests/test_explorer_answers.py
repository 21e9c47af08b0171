"""What the explorer page answers while a hand moves, by its modules in Node beside the library."""

import shutil

import numpy as np
import pytest

import pendular as pl
from page_modules import answer_of_script, write_modules
from pendular.ground import webassembly

pytestmark = [
    pytest.mark.needs("numba"),
    pytest.mark.skipif(webassembly.linker() is None, reason="wasm-ld is not installed: apt-get install lld"),
    pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed"),
]

# A machine on which a whole curve takes so many milliseconds, and a hand that changes the contact angle.
MOVING = """
import { readFileSync } from "node:fs";
import { answerTo } from "./answer.mjs";
import { load } from "./pendular.mjs";
import { viewAt } from "./view.mjs";
const { hash, other, slow } = JSON.parse(readFileSync(0));
const exact = await load();
const solver = { ...exact, curve: (...asked) => {
  const until = performance.now() + slow;
  while (performance.now() < until);
  return exact.curve(...asked);
} };
const before = answerTo(viewAt(hash), solver);
const moving = answerTo(viewAt(other), solver, before, true);
const again = answerTo(viewAt(other.replace("separation=1um", "separation=2um")), solver, moving, true);
const atRest = answerTo(viewAt(other), solver, moving);
const placesOf = (curve) => curve.map(({ separation, force }) => [separation, force]);
const told = ({ branch }) => ({ isWhole: branch.isWhole, curve: placesOf(branch.curve) });
console.log(JSON.stringify([before, moving, again, atRest].map(told)));
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    return write_modules(tmp_path_factory.mktemp("page"))


@pytest.mark.parametrize(("held", "degrees"), [("suction=5kPa", 40), ("volume=5pL", 40), ("volume=5pL", 100)])
def test_a_moving_hand_on_a_slow_machine_sees_the_stable_branch(page, held, degrees):
    hash = f"radius=50um&radius2=40um&contact-angle=20&{held}&separation=1um"
    other = hash.replace("angle=20", f"angle={degrees}")
    before, moving, again, at_rest = answer_of_script(page, MOVING, {"hash": hash, "other": other, "slow": 20})
    assert [one["isWhole"] for one in (before, moving, again, at_rest)] == [True, False, False, True]
    assert again == moving
    pair, liquid = pl.Pair((50e-6, 40e-6), np.deg2rad(degrees)), pl.Liquid.water()
    name = held.partition("=")[0]
    given = {name: {"volume": 5e-15, "suction": 5e3}[name]}
    gap, force = np.array(moving["curve"]).T
    assert gap.size == 34
    assert np.all(np.diff(gap) > 0.0)
    end = pl.rupture(pair, **given, liquid=liquid)
    assert [gap[-1], force[-1]] == pytest.approx([end.separation, end.force], rel=1e-9)
    lower = pl.rupture(pair, **given, liquid=liquid, end="lower")
    assert gap[0] == pytest.approx(lower.separation if lower.exists else 0.0, rel=1e-9, abs=1e-18)
    own = pl.bridge(pair, gap[1:-1], **given, liquid=liquid)
    np.testing.assert_allclose(force[1:-1], own.force, rtol=1e-9)


def test_a_quick_machine_shows_the_whole_curve_in_each_frame(page):
    hash = "radius=50um&radius2=40um&contact-angle=20&volume=5pL&separation=1um"
    asked = {"hash": hash, "other": hash.replace("angle=20", "angle=40"), "slow": 0}
    found = answer_of_script(page, MOVING.replace("performance.now() + slow", "0"), asked)
    assert len(found[0]["curve"]) == 97


def test_two_planes_are_traced_as_ever(page):
    hash = "radius=plane&radius2=plane&contact-angle=40&volume=1uL&separation=400um"
    asked = {"hash": hash, "other": hash.replace("angle=40", "angle=50"), "slow": 20}
    found = answer_of_script(page, MOVING, asked)
    assert all(one["isWhole"] for one in found)
