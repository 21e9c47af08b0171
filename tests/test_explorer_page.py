"""The explorer page in a headless Chromium, as a person uses it, and its numbers beside Python's."""

import contextlib
import csv
import io
import json
import math
import re
import shlex
import shutil
import subprocess
import sys
import threading
import time
import urllib.request
import warnings

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright import sync_api as playwright

import pendular as pl
from firefox import Firefox
from pendular.front.cli import main
from pendular.front.explorer.files import page_files, write_page
from pendular.front.explorer.server import server_of
from pendular.ground import webassembly
from pendular.ground.units import read, show

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FIREFOX = shutil.which("firefox-esr") or shutil.which("firefox")
pytestmark = [
    pytest.mark.long,
    pytest.mark.needs("numba"),
    pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the path: apt-get install chromium"),
    pytest.mark.skipif(webassembly.linker() is None, reason="wasm-ld is not installed: apt-get install lld"),
]

START = "#radius=50um&radius2=50um&contact-angle=20&liquid=water&temperature=20degC&suction=5kPa&separation=3um"
WATER = pl.Liquid.water()
GRAINS = pl.Pair(50e-6, np.deg2rad(20.0))
MINUS = "\u2212"
SIZES = ((360, 740), (390, 844), (768, 1024), (1280, 860), (1920, 1080), (2560, 1300))
SEED = 20261130


@pytest.fixture(scope="module")
def url():
    with server_of("127.0.0.1", 0, page_files()) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}/"
        server.shutdown()


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        yield chromium
        chromium.close()


class Seen:
    """A page with all that it complained of and whom it asked."""

    def __init__(self, browser, url: str, **options):
        self.url = url
        self.complaints, self.asked = [], []
        self.page = browser.new_page(**options)
        self.page.set_viewport_size({"width": 1280, "height": 860})
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on(
            "console", lambda said: self.complaints.append(said.text) if said.type in ("error", "warning") else None
        )
        self.page.on("request", lambda request: self.asked.append(request.url))

    def show(self, query: str) -> None:
        """Open an address."""
        self.page.goto("about:blank")
        self.page.goto(self.url + query)
        self.page.wait_for_selector("#picture .solid")

    def number(self, name: str) -> str:
        """Value in the table of numbers."""
        row = self.page.locator(".numbers tr", has=self.page.locator(f"th:text-matches('^{name}', '')")).first
        return row.locator("td").inner_text().replace(MINUS, "-").replace("\u00a0", " ")

    def wait_for(self, name: str, value: str) -> None:
        """Wait until the table of numbers says so."""
        seen = None
        for _ in range(100):
            seen = self.number(name)
            if seen == value:
                return
            self.page.wait_for_timeout(30)
        pytest.fail(f"{name} is {seen}, not {value}")

    def text(self, name: str):
        """Text field of a name."""
        return self.page.get_by_role("textbox", name=name, exact=True).or_(
            self.page.get_by_role("combobox", name=name, exact=True)
        )

    def slider(self, name: str):
        """Slider of a name."""
        return self.page.get_by_role("slider", name=name, exact=True)

    def slide(self, name: str, key: str) -> str:
        """Move a slider by a key; the text that its field shows then."""
        before = self.text(name).input_value()
        self.slider(name).focus()
        self.page.keyboard.press(key)
        playwright.expect(self.text(name)).not_to_have_value(before)
        return self.text(name).input_value()

    def write(self, name: str, text: str) -> None:
        """Write into a field and finish with Enter."""
        self.text(name).fill(text)
        self.text(name).press("Enter")

    def choose(self, name: str) -> None:
        """Choose one of several by its name."""
        self.page.get_by_role("radio", name=name, exact=True).click(force=True)

    def expect_open_to_all(self) -> None:
        """Contrast of all text, in pictures too, and what axe-core looks for."""
        assert self.page.evaluate(CONTRAST) == []
        found = Axe().run(self.page).response
        assert len(found["passes"]) > 30
        assert [(one["id"], one["impact"]) for one in found["violations"]] == []

    def reached_by_keyboard(self) -> list[tuple[str, bool]]:
        """Names of what is reached, one Tab after the other, and whether it shows that it is."""
        reached = []
        for _ in range(60):
            self.page.keyboard.press("Tab")
            reached.append(tuple(self.page.evaluate(FOCUSED)))
        print([name for name, _ in reached])
        return reached

    def shrink_to(self, width: int, height: int) -> None:
        """Give the window a size, until nothing is wider."""
        self.page.set_viewport_size({"width": width, "height": height})
        self.page.wait_for_function("document.documentElement.scrollWidth <= innerWidth")

    def centre(self, selector: str) -> tuple[float, float]:
        """Middle of what is seen of an element."""
        box = self.page.locator(selector).bounding_box()
        return box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]

    def drag(self, start: tuple[float, float], across: float, down: float = 0.0) -> None:
        """Pull from a place."""
        self.page.mouse.move(*start)
        self.page.mouse.down()
        self.page.mouse.move(start[0] + across, start[1] + down, steps=5)
        self.page.mouse.up()


@pytest.fixture
def blank(browser, url):
    seen = Seen(browser, url)
    yield seen
    seen.page.close()
    assert seen.complaints == []
    assert all(address.startswith((url, "data:", "blob:", "about:")) for address in seen.asked)


@pytest.fixture
def desk(blank):
    blank.show(START)
    return blank


def force_of(pair=GRAINS, separation=3e-6, liquid=WATER, **control: float) -> str:
    return show(float(pl.bridge(pair, separation, liquid=liquid, **control).force), "N")


# -- Numbers ---------------------------------------------------------------------------------------------------------

ANSWER = """(hash) => {
  const answer = window.explorer.answerAt(hash);
  const exact = (key, value) => (typeof value === "number" && !Number.isFinite(value) ? String(value) : value);
  return JSON.stringify(answer, exact);
}"""


def answer_of(seen, hash: str) -> dict:
    """What the page computes for an address."""
    return json.loads(seen.page.evaluate(ANSWER, hash), parse_constant=float)


def random_question(rng):
    """A question as it is typed, and the same for the library."""
    radii = [10.0 ** rng.uniform(-6, -3.5) for _ in range(2)]
    if rng.random() < 0.3:
        radii[1] = math.inf
    elif rng.random() < 0.4:
        radii[1] = radii[0]
    degrees = [float(rng.integers(0, 70)) for _ in range(2)]
    if rng.random() < 0.6:
        degrees[1] = degrees[0]
    pair = pl.Pair(tuple(radii), tuple(np.deg2rad(degrees)))
    size = float(pair.derjaguin_radius)
    name = str(rng.choice(["water", "ethanol", "glycerol"]))
    kelvin = float(rng.integers(292, 320))
    liquid = pl.Liquid.named(name, kelvin)
    control = str(rng.choice(["suction", "volume", "humidity"]))
    value = {
        "suction": 10.0 ** rng.uniform(-1, 2) * liquid.surface_tension / size,
        "volume": 10.0 ** rng.uniform(-6, -1) * size**3,
        "humidity": float(rng.uniform(0.9, 0.9999)),
    }[control]
    text = {"suction": f"{value!r}Pa", "volume": f"{value!r}m^3", "humidity": f"{value!r}"}[control]
    gap = 10.0 ** rng.uniform(-4, -0.5) * size
    words = {
        "radius": f"{radii[0]!r}m",
        "radius2": "plane" if math.isinf(radii[1]) else f"{radii[1]!r}m",
        "contact-angle": f"{degrees[0]!r}deg",
        "contact-angle2": f"{degrees[1]!r}deg",
        "liquid": name,
        "temperature": f"{kelvin!r}K",
        control: text,
        "separation": f"{gap!r}m",
    }
    return "&".join(f"{key}={word}" for key, word in words.items()), (pair, gap, {control: value}, liquid)


def number_of(value) -> float:
    return float(value.replace("Infinity", "inf")) if isinstance(value, str) else float(value)


def test_numbers_are_those_of_python(desk):
    print(f"seed {SEED}")
    rng = np.random.default_rng(SEED)
    stood = spoken = 0
    for _ in range(80):
        words, (pair, gap, held, liquid) = random_question(rng)
        found = answer_of(desk, words)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", pl.KelvinWarning)
            # ln h is exact to its last digit, which near h = 1 is a larger part of the suction
            wanted, end = pl.bridge(pair, gap, liquid=liquid, **held), pl.rupture(pair, liquid=liquid, **held)
        assert (found["state"] is not None) == bool(wanted.exists), words
        assert (found["rupture"] is not None) == bool(end.exists), words
        if end.exists:
            assert found["rupture"]["separation"] == pytest.approx(end.separation, rel=1e-12), words
        if not wanted.exists:
            continue
        stood += 1
        for name, own in (
            ("force", "force"),
            ("volume", "volume"),
            ("suction", "suction"),
            ("neckRadius", "neck_radius"),
        ):
            assert number_of(found["state"][name]) == pytest.approx(getattr(wanted, own), rel=2e-12, nan_ok=True), (
                name,
                words,
            )
        for told in found["laws"]:
            error = number_of(told["forceError"])
            if math.isnan(error):
                continue
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                law = pl.bridge(pair, gap, liquid=liquid, method=told["law"], **held)
            assert 1.0 + error == pytest.approx(float(law.force) / float(wanted.force), rel=1e-11), (told, words)
            spoken += 1
    assert stood > 30
    assert spoken > 200


def test_what_the_page_says_of_laws_is_what_python_says(desk):
    """Which laws are silent, refused, or outside of their range."""
    rng = np.random.default_rng(SEED + 1)
    told_outside = 0
    for _ in range(25):
        words, (pair, gap, held, liquid) = random_question(rng)
        found = answer_of(desk, words)
        if found["state"] is None:
            continue
        for told in found["laws"]:
            law = pl.laws[told["law"]]
            if "force" not in law.gives:
                continue
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                try:
                    said, refused = pl.bridge(pair, gap, liquid=liquid, method=law.name, **held), False
                except ValueError:
                    refused = True
            error = number_of(told["forceError"])
            if refused:
                assert math.isnan(error), (told, words)
                assert told["outside"].startswith("its force is for "), (told, words)
                continue
            assert math.isnan(error) == math.isnan(float(said.force)), (told, words)
            ranges = [w.message for w in caught if isinstance(w.message, pl.RangeWarning) and w.message.outside]
            if ranges:
                told_outside += 1
                assert "; the law is for " in told["outside"], (told, words)
    assert told_outside > 10


@pytest.mark.parametrize("name", ["water", "ethanol", "n-dodecane", "67-56-1", "glycerol", "isopropanol"])
def test_liquids_are_those_of_python(desk, name):
    for kelvin in (293.15, 300.0, 333.0):
        found = answer_of(desk, f"radius=50um&liquid={name}&temperature={kelvin}K&suction=1kPa&separation=1um")
        wanted = pl.Liquid.named(name, kelvin)
        assert found["question"]["liquid"]["surfaceTension"] == pytest.approx(wanted.surface_tension, rel=1e-13)
        assert found["question"]["liquid"]["density"] == pytest.approx(wanted.density, rel=1e-13)


@pytest.mark.parametrize(
    ("field", "text", "value"),
    [
        ("radius", "50um", 50e-6),
        ("radius", "50 µm", 50e-6),
        ("radius", "0.002 in", 50.8e-6),
        ("radius", ".05 mm", 50e-6),
        ("radius", "5e4 nm", 50e-6),
        ("suction", "5 kPa", 5e3),
        ("suction", "50 mbar", 5e3),
        ("suction", "0.05 bar", 5e3),
        ("volume", "5 pL", 5e-15),
        ("volume", "5000 um^3", 5e-15),
        ("volume", "5000 µm³", 5e-15),
        ("volume", "5000um**3", 5e-15),
        ("surface-tension", "72.8 mN/m", 0.0728),
        ("surface-tension", "72.8 dyn/cm", 0.0728),
        ("temperature", "25 °C", 298.15),
        ("temperature", "25degC", 298.15),
        ("temperature", "77 degF", 298.15),
        ("contact-angle", "0.35rad", math.degrees(0.35)),
        ("contact-angle", "20", 20.0),
        ("humidity", "90%", 0.9),
        ("humidity", "0.9", 0.9),
    ],
)
def test_units_are_read_as_typed(desk, field, text, value):
    words = {"radius": "50um", "suction": "5kPa", "separation": "0um"}
    if field in ("volume", "humidity"):
        del words["suction"]
    words[field] = text
    found = answer_of(desk, "&".join(f"{name}={word.replace('%', '%25')}" for name, word in words.items()))["question"]
    seen = {
        "radius": found["pair"]["radius"][0],
        "surface-tension": found["liquid"]["surfaceTension"],
        "temperature": found["liquid"].get("temperature"),
        "contact-angle": found["degrees"][0],
    }
    assert seen.get(field, found["value"]) == pytest.approx(value, rel=1e-14)


# -- What a person does ----------------------------------------------------------------------------------------------


def test_a_slider_moves_number_and_picture(desk):
    desk.wait_for("force", force_of(suction=5e3))
    before = desk.page.locator("#picture").inner_html()
    text = desk.slide("Suction", "ArrowRight")
    moved = read("suction", text, "Pa", "20kPa")
    assert moved > 5e3
    desk.wait_for("force", force_of(suction=moved))
    assert desk.number("force") != force_of(suction=5e3)
    assert desk.page.locator("#picture").inner_html() != before
    assert desk.slider("Suction").get_attribute("aria-valuetext") == text


def test_the_separation_reaches_from_contact_to_beyond_rupture(desk):
    assert desk.slide("Separation", "Home") == "0 m"
    desk.wait_for("force", force_of(separation=0.0, suction=5e3))
    last = read("separation", desk.slide("Separation", "End"), "m", "3um")
    assert 1.1 < last / pl.rupture(GRAINS, suction=5e3, liquid=WATER).separation < 1.5
    desk.wait_for("force", "0 N")
    playwright.expect(desk.page.locator(".tile.force .note")).to_have_text("no bridge at this separation")


def test_a_grain_is_pulled_until_the_bridge_breaks_and_pushed_back(desk):
    before = desk.page.locator(".tile.force .value").inner_text()
    x, y = desk.centre("#picture")
    desk.drag((x + 100, y), 10)
    playwright.expect(desk.text("Separation")).not_to_have_value("3 µm")
    pulled = read("separation", desk.text("Separation").input_value(), "m", "3um")
    assert pulled > 3e-6
    desk.wait_for("force", force_of(separation=pulled, suction=5e3))
    assert desk.page.locator(".tile.force .value").inner_text() != before
    desk.drag((x - 100, y), -150)  # the other grain, to the other side
    playwright.expect(desk.page.locator(".tile.force .note")).to_have_text("no bridge at this separation")
    desk.drag((x + 100, y), -300)
    playwright.expect(desk.text("Separation")).to_have_value("0 m")


def test_the_grain_under_the_hand_follows_it(desk):
    """Half of the gap is the way of each grain, in the scale that the bar of length shows."""
    x, y = desk.centre("#picture")
    metre = desk.page.evaluate("window.explorer.picture().metre * document.getElementById('picture').clientWidth / 268")
    desk.drag((x + 120, y), 6)
    playwright.expect(desk.text("Separation")).not_to_have_value("3 µm")
    pulled = read("separation", desk.text("Separation").input_value(), "m", "3um")
    assert 0.5 * (pulled - 3e-6) * metre == pytest.approx(6.0, rel=1e-2)


def test_a_plate_is_pulled_upright(blank):
    blank.show("#radius=50um&radius2=plane&volume=5pL&separation=6um")
    x, y = blank.centre("#picture")
    blank.drag((x, y - 60), 0, -20)
    playwright.expect(blank.text("Separation")).not_to_have_value("6 µm")
    assert read("separation", blank.text("Separation").input_value(), "m", "3um") > 6e-6


def test_a_place_on_the_curve_is_gone_to(desk):
    box = desk.page.locator("#chart .now").bounding_box()
    desk.drag((box["x"] + 5, box["y"] + 5), 30)
    playwright.expect(desk.text("Separation")).not_to_have_value("3 µm")
    moved = read("separation", desk.text("Separation").input_value(), "m", "3um")
    assert moved > 3e-6
    desk.wait_for("force", force_of(separation=moved, suction=5e3))


def test_a_place_on_the_map_is_gone_to_and_the_map_is_true(desk):
    desk.page.wait_for_selector("#plan:not(.old)")
    x, y = desk.centre("#frame .now")
    desk.page.mouse.click(x - 20, y - 30)
    playwright.expect(desk.text("Suction")).not_to_have_value("5 kPa")
    suction = read("suction", desk.text("Suction").input_value(), "Pa", "3kPa")
    degrees = float(desk.text("Contact angle").input_value().removesuffix("°"))
    assert suction < 5e3
    assert degrees > 20.0
    desk.wait_for("force", force_of(pl.Pair(50e-6, np.deg2rad(degrees)), suction=suction))
    desk.page.select_option("#map-choice", "rupture")
    playwright.expect(desk.page.locator("#frame")).to_have_attribute("aria-label", re.compile("^Map of the rupture"))
    high = desk.page.locator("#map-key span").nth(2).inner_text().replace("\u00a0", " ")
    control = 10.0 ** (-1.0 + 5.0 * 0.5 / 80) * WATER.surface_tension / 50e-6  # the first column, the lowest row
    largest = pl.rupture(pl.Pair(50e-6, np.deg2rad(1.0)), suction=control, liquid=WATER).separation
    assert read("rupture", high, "m", "1um") == pytest.approx(float(largest), rel=0.1)
    for choice in ("zhao2020", "force"):
        desk.page.select_option("#map-choice", choice)
        desk.page.select_option("#across", "separation" if choice == "zhao2020" else "control")
        desk.page.wait_for_selector("#plan:not(.old)")


def test_a_fast_hand_ends_with_the_last_position(desk):
    box = desk.slider("Suction").bounding_box()
    middle = box["y"] + 0.5 * box["height"]
    desk.page.mouse.move(box["x"] + 0.4 * box["width"], middle)
    desk.page.mouse.down()
    for step in range(40):
        desk.page.mouse.move(box["x"] + (0.4 + 0.01 * step) * box["width"], middle)
    desk.page.mouse.up()
    position = float(desk.slider("Suction").input_value())
    last = show(10.0 * 1e7 ** (position / 350.0), "Pa", 3)
    playwright.expect(desk.text("Suction")).to_have_value(last)
    desk.wait_for("force", force_of(suction=read("suction", last, "Pa", "20kPa")))


def test_another_control_shows_the_same_bridge(desk):
    for control, name, unit in (("volume", "Volume", "m^3"), ("suction", "Suction", "Pa")):
        desk.choose(control)
        playwright.expect(desk.text(name)).to_be_visible()
        value = read(control, desk.text(name).input_value(), unit, "")
        desk.wait_for("force", force_of(**{control: value}))
        assert value == pytest.approx(getattr(pl.bridge(GRAINS, 3e-6, suction=5e3, liquid=WATER), control), rel=1e-4)
    desk.choose("humidity")
    playwright.expect(desk.text("Humidity")).to_have_value(re.compile(r"99\.99\d+ %"))
    playwright.expect(desk.page.locator("#notices")).to_contain_text("control the suction or the volume instead")


def test_a_plane_and_two_angles(desk):
    desk.page.select_option("#kind2", "plane")
    playwright.expect(desk.text("Radius 2")).to_be_hidden()
    desk.page.get_by_role("checkbox", name="Same contact angle on both").uncheck()
    desk.write("Contact angle 2", "60")
    tip = pl.Pair((50e-6, np.inf), (np.deg2rad(20.0), np.deg2rad(60.0)))
    desk.wait_for("force", force_of(tip, suction=5e3))


def test_two_planes_hold_a_volume_alone(blank):
    blank.show("#radius=plane&radius2=plane&contact-angle=40&volume=1uL&separation=400um")
    plates = pl.Pair(np.inf, np.deg2rad(40.0))
    blank.wait_for("force", force_of(plates, 4e-4, volume=1e-9))
    blank.choose("suction")
    words = "suction: holds no stable bridge between two planes"
    playwright.expect(blank.page.get_by_role("alert").filter(has_text=words)).to_be_visible()
    blank.wait_for("force", force_of(plates, 4e-4, volume=1e-9))


def test_another_liquid_and_a_given_tension(desk):
    desk.write("Liquid", "ethanol")
    desk.wait_for("force", force_of(liquid=pl.Liquid.named("ethanol"), suction=5e3))
    desk.choose("surface tension")
    desk.write("Surface tension", "50 mN/m")
    desk.wait_for("force", force_of(liquid=pl.Liquid(surface_tension=0.05), suction=5e3))
    desk.choose("humidity")  # which needs a density
    playwright.expect(desk.page.get_by_role("alert").filter(has_text="lacks density")).to_be_visible()
    assert desk.page.get_by_role("radio", name="suction", exact=True).is_checked()


def test_a_sent_address_shows_the_same(desk, browser, url):
    desk.write("Radius 2", "20 µm")
    desk.slide("Suction", "PageUp")
    desk.page.get_by_role("checkbox", name="zhao2020").check()
    desk.page.select_option("#plot", "force")
    desk.page.wait_for_url("**laws=zhao2020*")
    other = Seen(browser, url)
    other.show(desk.page.url.removeprefix(url))
    for name in ("Suction", "Separation", "Radius 1", "Radius 2", "Contact angle", "Liquid", "Temperature"):
        assert other.text(name).input_value() == desk.text(name).input_value()
    assert other.page.locator(".numbers").inner_text() == desk.page.locator(".numbers").inner_text()
    assert other.page.get_by_role("checkbox", name="zhao2020").is_checked()
    playwright.expect(other.page.locator("#chart text.key")).to_have_text(["zhao2020"])
    other.page.close()


def test_an_address_of_before_is_understood(blank):
    blank.show(START.replace("#", "?").replace("suction=5kPa", "volume=5pL"))
    blank.wait_for("force", force_of(volume=5e-15))


def test_an_address_with_a_mistake_is_told(blank):
    blank.show("#radius=<b>50</b>")
    playwright.expect(blank.page.locator("#notices")).to_contain_text(
        "radius: '<b>50</b>' does not begin with a number"
    )
    blank.wait_for("force", force_of(suction=5e3))  # as the page starts without an address
    for query, words in (
        ("#suction=5kPa&volume=1pL", "control: suction and volume given"),
        ("#laws=newton1687", "laws: 'newton1687' is not one of"),
        ("#colour=red", "address: 'colour' is not one of"),
    ):
        blank.show(query)
        playwright.expect(blank.page.locator("#notices")).to_contain_text(words)


def test_a_bad_value_leaves_the_rest_usable(desk):
    desk.write("Radius 1", "50")
    message = desk.page.get_by_role("alert").filter(has_text="radius: '50' has no unit; write it like 50um")
    playwright.expect(message).to_be_visible()
    desk.wait_for("force", force_of(suction=5e3))
    moved = read("suction", desk.slide("Suction", "ArrowRight"), "Pa", "20kPa")
    desk.wait_for("force", force_of(suction=moved))
    assert desk.text("Radius 1").input_value() == "50"
    playwright.expect(message).to_be_visible()
    desk.write("Radius 1", "40 um")
    playwright.expect(message).to_be_hidden()
    desk.wait_for("force", force_of(pl.Pair((40e-6, 50e-6), np.deg2rad(20.0)), suction=moved))


def test_the_page_says_what_is_wrong(desk):
    for field, text, words in (
        ("Suction", "5 km", "suction: '5 km' is not a quantity in Pa; write it like 20kPa"),
        ("Suction", "5 quux", "suction: '5 quux' has the unknown unit 'quux'; write it like 20kPa"),
        ("Suction", "1e30 Pa", "suction: 1e+30 Pa is not in ["),
        ("Separation", "-30um", "separation: -0.00003 m is not > -0.000025"),
        ("Contact angle", "190", "contact-angle: '190' is not in [0, 180) degrees"),
        ("Liquid", "wather", "liquid: 'wather' is not a known liquid"),
        ("Temperature", "500 °C", "temperature: 773.15 K is not in [273.15, 647.096)"),
        ("Radius 2", "-1um", "radius2: '-1um' is not > 0"),
    ):
        desk.write(field, text)
        playwright.expect(desk.page.get_by_role("alert").filter(has_text=words)).to_be_visible()
        assert desk.text(field).get_attribute("aria-invalid") == "true"
    desk.wait_for("force", force_of(suction=5e3))


FAILING = """
const instantiate = WebAssembly.instantiate;
WebAssembly.instantiate = async (...given) => {
  const { instance } = await instantiate.apply(WebAssembly, given);
  const failed = () => 2;
  return { instance: { exports: { ...instance.exports, pendular_bridge: failed, pendular_curve: failed } } };
};
"""


def test_where_the_solver_fails_the_page_says_so(blank):
    blank.page.add_init_script(FAILING)
    blank.show(START)
    playwright.expect(blank.page.locator("#notices")).to_contain_text("The solver found no answer to this question")
    playwright.expect(blank.page.locator(".tile.force .value")).to_have_text("–")
    playwright.expect(blank.page.locator(".tile.rupture .value")).to_have_text("7.675\u00a0µm")
    assert blank.number("force") == "–"


@pytest.mark.parametrize("plotted", ["volume", "suction", "neck radius", "surface energy", "stiffness"])
def test_another_quantity_is_drawn(desk, plotted):
    desk.page.select_option("#plot", label=plotted)
    playwright.expect(desk.page.locator("#chart text.title").last).to_have_text(re.compile(f"^{plotted} "))
    assert "NaN" not in desk.page.locator("#chart").inner_html()


# -- To take away ----------------------------------------------------------------------------------------------------


def saved(desk, button: str) -> tuple[str, str]:
    with desk.page.expect_download() as download:
        desk.page.get_by_role("button", name=button).click()
    return download.value.suggested_filename, download.value.path().read_text(encoding="utf-8")


def test_what_is_taken_away_gives_the_same_number(desk):
    exact = pl.bridge(GRAINS, 3e-6, suction=5e3, liquid=WATER).force
    name, table = saved(desk, "Curve, CSV")
    with contextlib.redirect_stdout(io.StringIO()) as out, pytest.raises(SystemExit):
        main(shlex.split("curve --radius 50um --contact-angle 20 --suction 5kPa --csv"))
    rows, wanted = (list(csv.DictReader(io.StringIO(text))) for text in (table, out.getvalue()))
    assert name == "curve.csv"
    assert len(rows) == len(wanted)
    assert list(rows[0]) == list(wanted[0])
    for row, own in zip(rows, wanted, strict=True):
        assert row["stable"] == own["stable"]
        assert float(row["force [N]"]) == pytest.approx(float(own["force [N]"]), rel=1e-11)

    name, picture = saved(desk, "Picture, SVG")
    assert name == "bridge.svg"
    assert picture.startswith("<svg xmlns=")
    assert "var(" not in picture
    assert "NaN" not in picture

    name, program = saved(desk, "Program, Python")
    names: dict = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(program, names)
    assert (name, names["b"].force) == ("bridge.py", pytest.approx(exact, rel=1e-12))
    assert desk.page.locator("#program").text_content() == program

    command = desk.page.locator("#command").text_content()
    with contextlib.redirect_stdout(io.StringIO()) as out, pytest.raises(SystemExit):
        main([*shlex.split(command)[1:], "--json"])
    assert json.loads(out.getvalue())["force"] == pytest.approx(exact, rel=1e-12)


def test_a_link_is_copied(browser, url):
    context = browser.new_context(permissions=["clipboard-read", "clipboard-write"])
    seen = Seen(context, url)
    seen.show(START)
    seen.page.get_by_role("button", name="Copy link").click()
    playwright.expect(seen.page.locator("#copy-link")).to_have_text("Copied")
    link = seen.page.evaluate("navigator.clipboard.readText()")
    assert link.startswith(f"{url}#radius=50um&radius2=50um")
    context.close()


# -- Where it runs ---------------------------------------------------------------------------------------------------


def test_it_opens_again_without_a_network(browser, url):
    context = browser.new_context()
    seen = Seen(context, url)
    seen.show(START)
    seen.page.evaluate("navigator.serviceWorker.ready.then(() => true)")
    seen.page.wait_for_function("navigator.serviceWorker.controller !== null")
    context.set_offline(True)
    seen.page.reload()
    seen.page.wait_for_selector("#picture .solid")
    seen.wait_for("force", force_of(suction=5e3))
    context.close()


@pytest.mark.skipif(FIREFOX is None, reason="no firefox on the path: apt-get install firefox-esr")
def test_firefox_shows_the_same(url, tmp_path):
    with Firefox(FIREFOX, tmp_path) as firefox:
        write_page(tmp_path / "page")
        for address in (url, (tmp_path / "page" / "index.html").as_uri()):
            firefox.go(address + "#radius=50um&radius2=plane&volume=5pL&separation=6um&laws=zhao2020")
            firefox.wait_for("document.querySelector('#plan:not(.old)')")
            tip = pl.Pair((50e-6, np.inf), np.deg2rad(20.0))
            exact = pl.bridge(tip, 6e-6, volume=5e-15, liquid=WATER)
            force = firefox.run("return window.explorer.answerAt(location.hash.slice(1)).state.force")
            assert force == pytest.approx(exact.force, rel=1e-12)
            told = firefox.run("return document.querySelector('.tile.force .value').textContent")
            assert told.replace("\u00a0", " ") == show(float(exact.force), "N", 4)
            before = firefox.run("return document.getElementById('picture').innerHTML")
            firefox.run(
                "const slider = document.getElementById('slider-separation');"
                "slider.stepUp(9); slider.dispatchEvent(new Event('input'))"
            )
            firefox.wait_for(f"document.getElementById('picture').innerHTML !== {json.dumps(before)}")
            assert firefox.run("return document.documentElement.scrollWidth <= innerWidth")


def test_it_opens_from_a_file(browser, tmp_path):
    write_page(tmp_path)
    seen = Seen(browser, tmp_path.as_uri() + "/index.html")
    seen.show(START)
    seen.wait_for("force", force_of(suction=5e3))
    assert seen.complaints == []
    seen.page.close()


def test_the_command_serves_it():
    code = "from pendular.front.cli import main; main(['explore', '--no-browser', '--port', '0'])"
    refused = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert refused.returncode == 2
    with server_of("127.0.0.1", 0, {"index.html": b"x"}) as taken:
        port = taken.server_address[1]
    with subprocess.Popen(
        [sys.executable, "-c", code.replace("'0'", f"'{port}'")], stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            assert "Pendular explorer at http://127.0.0.1:" in process.stdout.readline()
            until = time.monotonic() + 20.0
            while time.monotonic() < until:
                with contextlib.suppress(OSError):
                    answer = urllib.request.urlopen(f"http://127.0.0.1:{port}/")
                    assert b"<title>Pendular explorer</title>" in answer.read()
                    break
            with pytest.raises(urllib.error.HTTPError, match="404"):
                urllib.request.urlopen(f"http://127.0.0.1:{port}/../pyproject.toml")
        finally:
            process.terminate()


# -- For everyone ----------------------------------------------------------------------------------------------------

FOCUSED = """() => {
  const e = document.activeElement;
  const ring = getComputedStyle(e).outlineStyle !== "none" || e.matches(".choice input");
  const name = e.getAttribute("aria-label") || e.labels?.[0]?.innerText.trim() || e.innerText?.trim();
  return [name, ring];
}"""

CONTRAST = """() => {
  const channel = (c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
  const light = (rgb) => [0.2126, 0.7152, 0.0722].reduce((sum, w, i) => sum + w * channel(rgb[i] / 255), 0);
  const parse = (text) => text.match(/[\\d.]+/g).map(Number);
  const behind = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const colour = parse(getComputedStyle(e).backgroundColor);
      if (colour.length < 4 || colour[3] === 1) return colour;
    }
    return [255, 255, 255];
  };
  const poor = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const element = walker.currentNode.parentElement;
    const style = getComputedStyle(element);
    if (!walker.currentNode.data.trim() || element.closest("script, .picture, .unseen, .skip, [hidden]")) continue;
    const front = light(parse(element.closest("svg") ? style.fill : style.color));
    const back = light(behind(element));
    const ratio = (Math.max(front, back) + 0.05) / (Math.min(front, back) + 0.05);
    if (ratio < 4.5) poor.push([walker.currentNode.data.trim().slice(0, 30), ratio.toFixed(2)]);
  }
  return poor;
}"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nobody_is_shut_out(browser, url, scheme):
    seen = Seen(browser, url, color_scheme=scheme)
    seen.show(START + "&laws=zhao2020,willett2000")
    seen.page.wait_for_selector("#plan:not(.old)")
    seen.write("Radius 1", "50")  # a message of what is wrong has contrast too
    playwright.expect(seen.page.locator("#wrong-radius")).not_to_be_empty()
    seen.expect_open_to_all()
    seen.page.close()


def test_all_is_reached_by_keyboard(desk):
    reached = desk.reached_by_keyboard()
    names = [name for name, _ in reached]
    for name in (
        "suction",
        "Suction",
        "Separation",
        "Radius 1",
        "Solid 2",
        "Liquid",
        "Quantity",
        "zhao2020",
    ):
        assert any(name in one for one in names), name
    assert all(name and ring for name, ring in reached[:40])


@pytest.mark.parametrize("view", [START, "#radius=50um&radius2=plane&volume=5pL&separation=6um&laws=zhao2020"])
def test_it_fits_every_window(blank, view):
    blank.show(view)
    for width, height in SIZES:
        blank.shrink_to(width, height)
        assert blank.page.evaluate("innerWidth") == width
        seen = blank.page.locator("#picture").bounding_box()
        assert seen["x"] >= 0
        assert seen["x"] + seen["width"] <= width
        assert seen["y"] < height / 2
