"""The bridge that moves on the front page, in a browser: its numbers, its sliders, a hand that pulls, all widths."""

import re
import shutil
from pathlib import Path

import pytest
from tools.live_bridge import fragment

import pendular as pl
from pendular.ground import webassembly

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
pytestmark = [
    pytest.mark.long,
    pytest.mark.needs("numba"),
    pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the path"),
    pytest.mark.skipif(webassembly.linker() is None, reason="wasm-ld is not installed: apt-get install lld"),
]

STYLE = Path(__file__).parents[1] / "docs" / "static" / "site.css"
PREFIXES = {"f": 1e-15, "p": 1e-12, "n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3, "M": 1e6}
WATER = pl.Liquid(surface_tension=0.0728)


@pytest.fixture(scope="module")
def browser():
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        yield chromium
        chromium.close()


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """A page with nothing but the fragment, as a file."""
    page = tmp_path_factory.mktemp("live") / "index.html"
    head = f'<!doctype html><html lang="en"><meta charset="utf-8"><title>live</title><style>{STYLE.read_text()}</style>'
    page.write_text(f'{head}<meta name="viewport" content="width=device-width"><body>{fragment()}')
    return page.as_uri()


@pytest.fixture
def opened(browser, address):
    """The page at a width, and what the console says."""
    contexts, said = [], []

    def opened(width=900, motion="reduce"):
        context = browser.new_context(viewport={"width": width, "height": 700}, reduced_motion=motion)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.goto(address)
        page.wait_for_selector("#live-bridge:not([hidden])")
        return page

    yield opened
    for context in contexts:
        context.close()
    assert said == []


def move(page, **values):
    """Move sliders."""
    for name, value in values.items():
        page.evaluate(
            "([name, value]) => { const slider = document.getElementById('live-' + name);"
            " slider.value = value; slider.dispatchEvent(new Event('input')); }",
            [name, value],
        )


def told(page):
    """Force, volume and rupture distance, as the page tells them."""
    numbers = re.findall(r"([-\d.e]+)\xa0([fpnµmkM]?)([NLm])", page.text_content("#live-told"))
    names = {"N": "force", "L": "volume", "m": "separation"}
    return {
        names[unit]: float(value) * PREFIXES[prefix] / (1e3 if unit == "L" else 1.0) for value, prefix, unit in numbers
    }


@pytest.mark.needs("page")
@pytest.mark.parametrize(
    ("suction", "angle", "size", "radius2"),
    [(3.3, 20, 0, 50e-6), (4.5, 70, 1, float("inf")), (2.6, 0, 0.5, 223.607e-6)],
)
def test_it_shows_the_numbers_of_python(opened, suction, angle, size, radius2):
    page = opened()
    move(page, suction=suction, angle=angle, size=size, gap=0.4)
    pair = pl.Pair((50e-6, radius2), angle * 3.141592653589793 / 180)
    end = pl.rupture(pair, suction=10**suction, liquid=WATER)
    state = pl.bridge(pair, 0.4 * 1.25 * end.separation, suction=10**suction, liquid=WATER)
    found = told(page)
    assert found["force"] == pytest.approx(state.force, rel=6e-3)  # three digits are shown
    assert found["volume"] == pytest.approx(state.volume, rel=6e-3)
    assert found["separation"] == pytest.approx(end.separation, rel=6e-3)


@pytest.mark.needs("page")
def test_a_hand_pulls_the_grain_until_the_bridge_breaks(opened):
    page = opened()
    box = page.query_selector("#live-solid2").bounding_box()
    middle = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]
    before = told(page)["force"]
    page.mouse.move(*middle)
    page.mouse.down()
    page.mouse.move(middle[0] + 3, middle[1], steps=3)
    assert told(page)["force"] < before
    page.mouse.move(middle[0] + 200, middle[1], steps=5)
    page.mouse.up()
    assert page.text_content("#live-told").startswith("No bridge: it broke at ")
    assert page.get_attribute("#live-liquid", "d") == ""


@pytest.mark.needs("page")
@pytest.mark.parametrize("width", [320, 375, 768, 1440])
def test_it_fits_every_width_and_can_be_used_by_keys(opened, width):
    page = opened(width)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.focus("#live-angle")
    before = page.text_content("#live-told")
    page.keyboard.press("ArrowRight")
    assert page.text_content("#live-angle-told") == "21°"
    assert page.text_content("#live-told") != before
    for label in page.query_selector_all(".live-sliders label"):
        assert label.text_content().strip()


@pytest.mark.needs("page")
def test_it_moves_until_a_reader_takes_over(opened):
    page = opened(motion="no-preference")
    places = set()
    for _ in range(5):
        page.wait_for_timeout(200)
        places.add(page.input_value("#live-gap"))
    assert len(places) > 2
    move(page, angle=40)
    place = page.input_value("#live-gap")
    page.wait_for_timeout(300)
    assert page.input_value("#live-gap") == place
