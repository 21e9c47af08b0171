"""The explorer page in a headless Chromium, as a person uses it."""

import contextlib
import csv
import io
import json
import os
import re
import shlex
import shutil
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request

import numpy as np
import pytest
from playwright import sync_api as playwright

import pendular as pl
from pendular.front.cli import main
from pendular.ground.units import read, show

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
pytestmark = [pytest.mark.long, pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the path")]

START = "?radius=50um&radius2=50um&contact-angle=20&liquid=water&temperature=20degC&suction=5kPa&separation=3um"
WATER = pl.Liquid.water()
GRAINS = pl.Pair(50e-6, np.deg2rad(20.0))
MINUS = "\u2212"


@pytest.fixture(scope="module")
def url():
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    code = f"from pendular.front.cli import main; main(['explore', '--no-browser', '--port', '{port}'])"
    # NiceGUI behaves otherwise where it finds itself under pytest.
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST")}
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.DEVNULL, env=environment) as server:
        try:
            address = f"http://127.0.0.1:{port}/"
            until = time.monotonic() + 60.0
            while server.poll() is None and time.monotonic() < until:
                with contextlib.suppress(urllib.error.URLError, ConnectionError):
                    urllib.request.urlopen(address).close()
                    break
                time.sleep(0.1)
            assert server.poll() is None
            yield address
        finally:
            server.terminate()


@pytest.fixture(scope="module")
def browser(url):
    with playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        context = chromium.new_context()  # one for all, whose cache keeps what is large
        first = context.new_page()
        first.goto(url)
        first.wait_for_selector(".picture svg .solid", timeout=300_000)  # the solver may have to be compiled
        first.close()
        yield context
        chromium.close()


class Seen:
    """A page with all that it complained of and whom it asked."""

    def __init__(self, browser, url: str):
        self.url = url
        self.complaints, self.hosts = [], set()
        self.page = browser.new_page()
        self.page.set_viewport_size({"width": 1280, "height": 860})
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on(
            "console", lambda said: self.complaints.append(said.text) if said.type in ("error", "warning") else None
        )
        self.page.on("request", lambda request: self.hosts.add(re.match(r"\w+:(?://([^:/]*))?", request.url)[1]))
        self.page.on("websocket", lambda socket: self.hosts.add(re.match(r"ws://([^:/]*)", socket.url)[1]))

    def show(self, query: str) -> None:
        """Open an address."""
        self.page.goto(self.url + query, wait_until="commit")
        self.page.wait_for_selector(".picture svg .solid")
        self.page.wait_for_selector(".curve .main-svg")

    def number(self, name: str) -> str:
        """Value in the table of numbers."""
        row = self.page.locator(".numbers tr", has=self.page.locator(f"th:text-matches('^{name}', '')")).first
        return row.locator("td").inner_text().replace(MINUS, "-")

    def wait_for(self, name: str, value: str) -> None:
        """Wait until the table of numbers says so."""
        seen = None
        for _ in range(300):
            seen = self.number(name)
            if seen == value:
                return
            self.page.wait_for_timeout(30)
        pytest.fail(f"{name} is {seen}, not {value}")

    def text(self, name: str):
        """Text field of a name."""
        return self.page.get_by_role("textbox", name=name, exact=True)

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


@pytest.fixture
def blank(browser, url):
    seen = Seen(browser, url)
    yield seen
    seen.page.close()
    assert seen.complaints == []
    assert seen.hosts <= {"127.0.0.1", None}  # None: an address that names no host, such as data:


@pytest.fixture
def desk(blank):
    blank.show(START)
    return blank


def force_of(**control: float) -> str:
    return show(float(pl.bridge(GRAINS, 3e-6, liquid=WATER, **control).force), "N")


def test_a_slider_moves_number_and_picture(desk):
    desk.wait_for("force", force_of(suction=5e3))
    before = desk.page.locator(".picture svg").inner_html()
    text = desk.slide("Suction", "ArrowRight")
    moved = read("suction", text, "Pa", "20kPa")
    assert moved > 5e3
    desk.wait_for("force", force_of(suction=moved))
    assert desk.number("force") != force_of(suction=5e3)
    assert desk.page.locator(".picture svg").inner_html() != before
    assert desk.slider("Suction").get_attribute("aria-valuetext") == text


def test_the_separation_reaches_from_contact_to_beyond_rupture(desk):
    assert desk.slide("Separation", "Home") == "0 m"
    contact = pl.bridge(GRAINS, 0.0, suction=5e3, liquid=WATER)
    desk.wait_for("force", show(float(contact.force), "N"))
    last = read("separation", desk.slide("Separation", "End"), "m", "3um")
    assert 1.1 < last / pl.rupture(GRAINS, suction=5e3, liquid=WATER).separation < 1.5
    desk.wait_for("force", "0 N")
    playwright.expect(desk.page.locator(".tile.force .note")).to_have_text("no bridge at this separation")


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
    moved = read("suction", last, "Pa", "20kPa")
    desk.wait_for("force", force_of(suction=moved))


def test_another_control_shows_the_same_bridge(desk):
    for control, name, unit in (("volume", "Volume", "m^3"), ("suction", "Suction", "Pa")):
        desk.page.get_by_role("button", name=control, exact=True).click()
        playwright.expect(desk.text(name)).to_be_visible()
        value = read(control, desk.text(name).input_value(), unit, "")
        desk.wait_for("force", force_of(**{control: value}))
        assert value == pytest.approx(getattr(pl.bridge(GRAINS, 3e-6, suction=5e3, liquid=WATER), control), rel=1e-4)
    desk.page.get_by_role("button", name="humidity", exact=True).click()
    playwright.expect(desk.text("Humidity")).to_have_value(re.compile(r"99\.99\d+ %"))


def test_a_plane_and_two_angles(desk):
    desk.page.get_by_role("switch", name="Solid 2 is a plane").click()
    playwright.expect(desk.text("Radius 2")).to_be_hidden()
    desk.page.get_by_role("switch", name="Same contact angle on both").click()
    desk.write("Contact angle 2", "60")
    tip = pl.Pair((50e-6, np.inf), (np.deg2rad(20.0), np.deg2rad(60.0)))
    desk.wait_for("force", show(float(pl.bridge(tip, 3e-6, suction=5e3, liquid=WATER).force), "N"))


def test_another_liquid_and_a_given_tension(desk):
    desk.write("Liquid", "ethanol")
    ethanol = pl.Liquid.named("ethanol")
    desk.wait_for("force", show(float(pl.bridge(GRAINS, 3e-6, suction=5e3, liquid=ethanol).force), "N"))
    desk.page.get_by_role("button", name="surface tension", exact=True).click()
    desk.write("Surface tension", "50 mN/m")
    given = pl.Liquid(surface_tension=0.05)
    desk.wait_for("force", show(float(pl.bridge(GRAINS, 3e-6, suction=5e3, liquid=given).force), "N"))
    desk.page.get_by_role("button", name="humidity", exact=True).click()  # which needs a density
    playwright.expect(desk.page.get_by_role("alert").filter(has_text="lacks density")).to_be_visible()
    assert desk.page.get_by_role("button", name="suction", exact=True).get_attribute("aria-pressed") == "true"


def test_a_sent_address_shows_the_same(desk, browser, url):
    desk.write("Radius 2", "20 µm")
    desk.slide("Suction", "PageUp")
    desk.page.get_by_role("checkbox", name="zhao2020").click()
    desk.page.wait_for_url("**laws=zhao2020*")
    other = Seen(browser, url)
    other.show(desk.page.url.removeprefix(url))
    for name in ("Suction", "Separation", "Radius 1", "Radius 2", "Contact angle 1", "Liquid", "Temperature"):
        assert other.text(name).input_value() == desk.text(name).input_value()
    assert other.page.locator(".numbers").inner_text() == desk.page.locator(".numbers").inner_text()
    assert other.page.get_by_role("checkbox", name="zhao2020").get_attribute("aria-checked") == "true"
    playwright.expect(other.page.locator(".curve .legendtext")).to_have_text(["zhao2020"])
    other.page.close()


def test_an_address_with_a_mistake_is_told(blank):
    blank.show("?radius=<b>50</b>")
    playwright.expect(blank.page.locator(".notices")).to_contain_text(
        "radius: '<b>50</b>' does not begin with a number"
    )
    blank.wait_for("force", force_of(suction=5e3))  # as the page starts without an address


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
    grains = pl.Pair((40e-6, 50e-6), np.deg2rad(20.0))
    desk.wait_for("force", show(float(pl.bridge(grains, 3e-6, suction=moved, liquid=WATER).force), "N"))


def test_the_library_says_what_is_wrong(desk):
    for field, text, words in (
        ("Suction", "5 km", "suction: '5 km' is not a quantity in Pa; write it like 20kPa"),
        ("Separation", "-30um", "separation: -3e-05 m is not > -2.5e-05"),
        ("Contact angle 1", "190", "contact-angle: '190' is not in [0, 180) degrees"),
        ("Liquid", "wather", "liquid: 'wather' is not a known liquid"),
        ("Temperature", "500 °C", "temperature: 773.15 K is not in [273.15, 647.096)"),
        ("Radius 2", "-1um", "radius2: '-1um' is not > 0"),
    ):
        desk.write(field, text)
        playwright.expect(desk.page.get_by_role("alert").filter(has_text=words)).to_be_visible()
        assert desk.text(field).get_attribute("aria-invalid") == "true"
    desk.wait_for("force", force_of(suction=5e3))


def saved(desk, button: str) -> tuple[str, str]:
    with desk.page.expect_download() as download:
        desk.page.get_by_role("button", name=button).click()
    return download.value.suggested_filename, download.value.path().read_text(encoding="utf-8")


def test_what_is_taken_away_gives_the_same_number(desk):
    exact = pl.bridge(GRAINS, 3e-6, suction=5e3, liquid=WATER).force
    name, table = saved(desk, "Curve, CSV")
    rows = list(csv.DictReader(io.StringIO(table)))
    gaps, forces = (np.array([float(row[key]) for row in rows]) for key in ("separation [m]", "force [N]"))
    fold = int(np.argmax(gaps))
    assert (name, fold) == ("curve.csv", 100)
    assert np.interp(3e-6, gaps[:fold], forces[:fold]) == pytest.approx(exact, rel=1e-4)

    name, picture = saved(desk, "Picture, SVG")
    assert name == "bridge.svg"
    assert picture.lstrip().startswith("<?xml")
    assert "</svg>" in picture

    name, program = saved(desk, "Program, Python")
    names: dict = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(program, names)
    assert (name, names["b"].force) == ("bridge.py", pytest.approx(exact, rel=1e-12))
    shown = desk.page.locator(".take pre").nth(1).text_content()
    assert shown == program

    command = desk.page.locator(".take pre").first.text_content()
    with contextlib.redirect_stdout(io.StringIO()) as out, pytest.raises(SystemExit):
        main([*shlex.split(command)[1:], "--json"])
    assert json.loads(out.getvalue())["force"] == pytest.approx(exact, rel=1e-12)


def test_all_is_reached_by_keyboard_has_a_name_and_fits_the_window(desk):
    reached = []
    for _ in range(24):
        desk.page.keyboard.press("Tab")
        reached.append(
            desk.page.evaluate(
                """() => { const e = document.activeElement;
                return e.getAttribute("aria-label") || e.labels?.[0]?.innerText || e.innerText.trim(); }"""
            )
        )
    print(reached)
    assert all(reached)
    for name in ("suction", "Suction", "Separation", "Radius 1", "Solid 2 is a plane", "Liquid", "Quantity"):
        assert name in reached

    for width in (390, 768, 1280):
        desk.page.set_viewport_size({"width": width, "height": 844})
        desk.page.wait_for_function("document.documentElement.scrollWidth <= innerWidth")
        assert desk.page.evaluate("innerWidth") == width
