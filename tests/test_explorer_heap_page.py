"""The heap of the explorer page in a headless Chromium, as a person uses it, beside Python's numbers."""

import csv
import io
import re
import struct
import warnings

import numpy as np
import pytest
from playwright import sync_api as playwright

import pendular as pl
import test_explorer_page as page
from firefox import Firefox
from pendular.front.explorer.files import write_page
from pendular.ground.units import read, show
from test_explorer_heap import lines_of, packed, random_heap

pytestmark = page.pytestmark
url, browser = page.url, page.browser

START = "#view=heap&packing=loose&radius=50um&contact-angle=20&liquid=water&temperature=20degC&suction=15kPa"
WATER = pl.Liquid.water()
ANGLE = np.deg2rad(20.0)
SEED = 20261202
# The pixels of the heap, read from a copy: of a canvas that is read often browsers complain.
PIXELS = """
const shown = document.getElementById("heap-canvas");
const copy = Object.assign(document.createElement("canvas"), { width: shown.width, height: shown.height });
const context = copy.getContext("2d", { willReadFrequently: true });
context.drawImage(shown, 0, 0);
const { width, height } = copy;
const { data } = context.getImageData(0, 0, width, height);
"""
PICTURE = f"""() => {{ {PIXELS}
  let sum = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i + 3]) sum = (sum * 31 + data[i] + 7 * data[i + 1] + i) % 1e9;
  return sum;
}}"""


RESTED = """() => {
  const canvas = document.getElementById("heap-canvas");
  return canvas.width > 1.5 * canvas.clientWidth;
}"""


class Heap(page.Seen):
    """The view of the heap."""

    def show(self, query: str) -> None:
        """Open an address, until its curves are there."""
        self.page.goto("about:blank")
        self.page.goto(self.url + query)
        self.page.wait_for_selector("#heap-chart .drying")

    def tile(self, role: str) -> str:
        """What is written large."""
        return self.page.locator(f"#heap-tiles .{role} .value").inner_text()

    def expect_tile(self, role: str, value: str) -> None:
        """Wait for what is written large."""
        playwright.expect(self.page.locator(f"#heap-tiles .{role} .value")).to_have_text(value)

    def picture(self) -> int:
        """A sum over what is drawn, once the hand rests."""
        self.page.wait_for_timeout(300)
        self.page.wait_for_function(RESTED)
        return int(self.page.evaluate(PICTURE))


@pytest.fixture
def blank(browser, url):
    seen = Heap(browser, url)
    yield seen
    seen.page.close()
    assert seen.complaints == []
    assert all(address.startswith((url, "data:", "blob:", "about:")) for address in seen.asked)


@pytest.fixture
def desk(blank):
    blank.show(START)
    return blank


def wet(suction: float, path: str = "drying", name: str = "loose") -> pl.Wet:
    return pl.wet(packed(name, 50e-6), ANGLE, suction=suction, liquid=WATER, path=path)


def expect_state(desk, w) -> None:
    """The tiles and the table tell a state of Python."""
    desk.expect_tile("bridges", str(len(w.bridges)))
    desk.expect_tile("saturation", f"{float(f'{100 * w.saturation:.4g}'):.10g}\u00a0%")
    desk.expect_tile("force", show(w.suction_stress, "Pa", 4).replace(" ", "\u00a0"))
    shown = {
        "liquid volume": show(w.liquid_volume, "m^3", 4),
        "mean force": show(float(np.mean(w.bridges.force)), "N", 4),
        "suction stress": show(w.suction_stress, "Pa", 4),
    }
    for name, value in shown.items():
        row = desk.page.locator("#heap-numbers tr", has=desk.page.locator(f"th:text-matches('^{name}', '')")).first
        playwright.expect(row.locator("td")).to_have_text(value.replace(" ", "\u00a0"))


# -- Water and bridges -----------------------------------------------------------------------------------------------


def test_a_slider_moves_bridges_and_numbers(desk):
    expect_state(desk, wet(15e3))
    before = desk.picture()
    text = desk.slide("Suction", "PageUp")
    moved = read("suction", text, "Pa", "20kPa")
    assert moved > 15e3
    expect_state(desk, wet(moved))
    assert len(wet(moved).bridges) < len(wet(15e3).bridges)
    assert desk.picture() != before
    desk.slide("Suction", "Home")
    lowest = read("suction", desk.text("Suction").input_value(), "Pa", "20kPa")
    expect_state(desk, wet(lowest))
    meeting = f"bridges meet on {100 * wet(lowest).meetings.grains:.4g}\u00a0%"
    playwright.expect(desk.page.locator("#heap-tiles .saturation .note")).to_have_text(meeting)


def test_history_is_told_and_coloured(desk):
    drying, wetting = wet(15e3), wet(15e3, "wetting")
    note = desk.page.locator("#heap-tiles .bridges .note")
    playwright.expect(note).to_have_text(f"{len(drying.bridges) - len(wetting.bridges)} on drying alone")
    before = desk.picture()
    desk.choose("wetting")
    expect_state(desk, wetting)
    playwright.expect(note).to_have_text(f"{len(drying.bridges)} on drying")
    desk.page.wait_for_url("**&path=wetting*")
    assert desk.picture() != before
    desk.page.get_by_role("checkbox", name="Bridges also condense").uncheck()
    dry = pl.wet(packed("loose", 50e-6), ANGLE, suction=15e3, liquid=WATER, path="wetting", condensation=False)
    assert len(dry.bridges) < 0.8 * len(wetting.bridges)
    expect_state(desk, dry)
    desk.page.wait_for_url("**&path=wetting&condensation=no*")


def test_other_grains_liquids_and_angles(desk):
    for name in ("close", "mixed"):
        desk.choose(name)
        expect_state(desk, wet(15e3, name=name))
    desk.write("Mean radius", "1 mm")
    desk.write("Suction", "300 Pa")
    desk.write("Contact angle", "40")
    desk.write("Liquid", "ethanol")
    heap, ethanol = packed("mixed", 1e-3), pl.Liquid.named("ethanol")
    expect_state(desk, pl.wet(heap, np.deg2rad(40.0), suction=300.0, liquid=ethanol))
    desk.page.locator("#heap-source").get_by_role("radio", name="surface tension").click(force=True)
    desk.write("Surface tension", "50 mN/m")
    expect_state(desk, pl.wet(heap, np.deg2rad(40.0), suction=300.0, liquid=pl.Liquid(surface_tension=0.05)))


def test_a_place_on_the_curve_is_gone_to(desk):
    box = desk.page.locator("#heap-chart .now").bounding_box()
    desk.drag((box["x"] + 5, box["y"] + 5), 40)
    playwright.expect(desk.text("Suction")).not_to_have_value("15 kPa")
    moved = read("suction", desk.text("Suction").input_value(), "Pa", "20kPa")
    assert moved > 15e3
    expect_state(desk, wet(moved))


@pytest.mark.parametrize(
    "plotted", ["water content", "suction stress", "chi", "coordination", "meeting grains", "mean force"]
)
def test_another_quantity_is_drawn(desk, plotted):
    desk.page.select_option("#heap-plot", label=plotted)
    playwright.expect(desk.page.locator("#heap-chart")).to_have_attribute("aria-label", re.compile(f"^{plotted} "))
    drawn = desk.page.locator("#heap-chart").inner_html()
    assert "NaN" not in drawn
    assert "Infinity" not in drawn


def test_a_bad_value_leaves_the_rest_usable(desk):
    desk.write("Suction", "5 km")
    message = desk.page.get_by_role("alert").filter(has_text="suction: '5 km' is not a quantity in Pa")
    playwright.expect(message).to_be_visible()
    expect_state(desk, wet(15e3))
    desk.write("Suction", "20 kPa")
    playwright.expect(message).to_be_hidden()
    expect_state(desk, wet(20e3))


FAILING = """
const instantiate = WebAssembly.instantiate;
WebAssembly.instantiate = async (...given) => {
  const { instance } = await instantiate.apply(WebAssembly, given);
  const own = instance.exports.pendular_bridges;
  const failed = (...asked) => (window.isFailing ? 2 : own(...asked));
  return { instance: { exports: { ...instance.exports, pendular_bridges: failed } } };
};
"""


def test_where_the_solver_fails_the_page_says_so(blank):
    blank.page.add_init_script(FAILING)
    blank.show(START)
    blank.page.evaluate("window.isFailing = true")
    blank.write("Suction", "20 kPa")
    words = "the solver did not find, or exclude, the bridge"
    playwright.expect(blank.page.locator("#wrong-heap-suction")).to_have_text(words)
    blank.page.evaluate("window.isFailing = false")
    blank.write("Suction", "21 kPa")
    expect_state(blank, wet(21e3))


# -- Turning ---------------------------------------------------------------------------------------------------------


def test_the_heap_is_turned_by_hand_and_by_keys(desk):
    seen = {desk.picture()}
    x, y = desk.centre("#heap-canvas")
    desk.drag((x, y), 60, 20)
    seen.add(desk.picture())
    desk.page.wait_for_url("**&seen=11,33,1*")
    desk.page.locator("#heap-canvas").focus()
    for key in ("ArrowRight", "ArrowUp", "+"):
        desk.page.keyboard.press(key)
        seen.add(desk.picture())
    desk.page.wait_for_url("**&seen=16,38,1.15*")
    desk.page.get_by_role("button", name="Farther").click()
    seen.add(desk.picture())
    desk.page.get_by_role("checkbox", name="See through the grains").check()
    seen.add(desk.picture())
    assert len(seen) == 6  # nearer and farther again
    expect_state(desk, wet(15e3))
    desk.page.get_by_role("button", name="As at first").click()
    desk.page.wait_for_function("!location.hash.includes('seen')")


def test_menisci_stand_where_python_has_them(blank):
    """Liquid is drawn in the gap of two grains, as wide as the neck of their bridge, and nowhere beside it."""
    blank.show("#view=heap&seen=0,0,1")
    own = pl.bridge(pl.Pair(1e-3, ANGLE), 0.1e-3, suction=200.0, liquid=WATER)
    blank.page.locator("#heap-own summary").click()
    blank.write("Suction", "200 Pa")
    blank.page.locator("#heap-text").fill("0 0 0 1\n2.1 0 0 1\n")
    blank.page.get_by_role("button", name="Use them").click()
    blank.expect_tile("bridges", "1")
    blank.expect_tile("force", show(own.force * 2.1e-3 / 3.0 / (4.1e-3 * 2e-3 * 2e-3), "Pa", 4).replace(" ", "\u00a0"))
    blank.page.wait_for_timeout(300)
    blank.page.wait_for_function(RESTED)
    high, metre = blank.page.evaluate(
        f"""() => {{ {PIXELS}
        const isSolid = (column, row) => Number(data[4 * (row * width + column) + 3] > 0);
        let [high, across] = [0, 0];
        for (let row = 0; row < height; row++) high += isSolid(width / 2, row);
        for (let column = 0; column < width; column++) across += isSolid(column, height / 2);
        return [high, across / 4.1e-3];
        }}"""
    )
    assert metre > 2e4
    assert high / metre == pytest.approx(2.0 * float(own.neck_radius), rel=0.03)


# -- Own grains ------------------------------------------------------------------------------------------------------


def test_own_grains_are_pasted_or_read(desk, tmp_path):
    rng = np.random.default_rng(SEED)
    print(f"seed {SEED}")
    heaps = [random_heap(rng) for _ in range(4)]
    desk.page.locator("#heap-own summary").click()
    for i, heap in enumerate(heaps):
        suction = 5.0 * WATER.surface_tension / float(heap.radii.mean())
        desk.page.locator("#heap-unit").fill("um")
        if i % 2:
            (tmp_path / f"grains{i}.txt").write_text(lines_of(heap, 1e-6))
            desk.page.locator("#heap-file").set_input_files(tmp_path / f"grains{i}.txt")
        else:
            desk.page.locator("#heap-text").fill(lines_of(heap, 1e-6))
            desk.page.get_by_role("button", name="Use them").click()
        playwright.expect(desk.page.locator("#heap-text-wrong")).to_be_empty()
        playwright.expect(desk.page.get_by_role("radio", name="own")).to_be_checked()
        playwright.expect(desk.page.locator("#heap-packing-words")).to_contain_text(f"{heap.count} grains")
        desk.write("Suction", f"{suction!r} Pa")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", pl.PackingWarning)
            expect_state(desk, pl.wet(heap, ANGLE, suction=suction, liquid=WATER))
    desk.page.locator("#heap-text").fill("0 0 0\n")
    desk.page.get_by_role("button", name="Use them").click()
    playwright.expect(desk.page.locator("#heap-text-wrong")).to_have_text("grains: line 1, '0 0 0', is not x y z r")
    desk.choose("loose")
    playwright.expect(desk.page.get_by_role("radio", name="loose")).to_be_checked()


# -- The two views ---------------------------------------------------------------------------------------------------


def test_the_pair_is_shown_first_and_asks_for_no_more(browser, url):
    seen = page.Seen(browser, url)
    seen.show(page.START)
    assert not [address for address in seen.asked if "heap" in address]
    seen.page.close()


def test_views_are_left_and_come_back_as_they_were(blank):
    page.Seen.show(blank, page.START)
    blank.slide("Separation", "PageUp")
    pair = blank.text("Separation").input_value()
    blank.page.get_by_role("link", name="A heap of grains").click()
    blank.page.wait_for_selector("#heap-chart .drying")
    playwright.expect(blank.page.locator("#pair-view")).to_be_hidden()
    expect_state(blank, wet(15e3))
    blank.page.locator("#heap-view").get_by_role("radio", name="close").click(force=True)
    blank.page.wait_for_url("**packing=close*")
    blank.page.get_by_role("link", name="A pair").click()
    playwright.expect(blank.page.locator("#heap-view")).to_be_hidden()
    playwright.expect(blank.text("Separation")).to_have_value(pair)
    for _ in range(10):  # whatever the heap was about to do
        blank.page.wait_for_timeout(150)
        assert "view=heap" not in blank.page.url
    blank.page.get_by_role("link", name="A heap of grains").click()
    playwright.expect(blank.page.locator("#heap-view").get_by_role("radio", name="close")).to_be_checked()
    blank.page.go_back()
    playwright.expect(blank.page.locator("#pair-view")).to_be_visible()


def test_the_pair_comes_after_the_heap(desk):
    desk.page.get_by_role("link", name="A pair").click()
    desk.page.wait_for_selector("#picture .solid")
    desk.wait_for("force", page.force_of(suction=5e3))
    desk.page.wait_for_selector("#plan:not(.old)")
    assert desk.page.locator("#chart .stable").bounding_box()["width"] > 100


def test_the_skip_link_leaves_the_address(desk):
    desk.page.keyboard.press("Tab")
    desk.page.keyboard.press("Enter")
    assert desk.page.evaluate("document.activeElement.id") == "heap-settings"
    page.Seen.show(desk, page.START)
    desk.page.keyboard.press("Tab")
    desk.page.keyboard.press("Enter")
    assert desk.page.evaluate("document.activeElement.id") == "settings"
    playwright.expect(desk.page.locator("#notices")).to_be_empty()


def test_a_sent_address_shows_the_same(desk, browser, url):
    desk.choose("mixed")
    desk.choose("wetting")
    desk.page.select_option("#heap-plot", "suction_stress")
    desk.slide("Suction", "PageDown")
    desk.page.wait_for_url("**plot=suction_stress*")
    desk.page.wait_for_timeout(500)
    other = Heap(browser, url)
    other.show(desk.page.url.removeprefix(url))
    for one in (desk, other):  # the limit comes with the curves, a little after them
        playwright.expect(one.page.locator("#heap-numbers")).not_to_contain_text("…")
    assert other.page.locator("#heap-numbers").inner_text() == desk.page.locator("#heap-numbers").inner_text()
    assert other.text("Suction").input_value() == desk.text("Suction").input_value()
    assert other.page.locator("#heap-plot").input_value() == "suction_stress"
    other.page.close()


def test_an_address_with_a_mistake_is_told(blank):
    for query, words in (
        ("packing=dense", "packing: 'dense' is not one of loose, close, mixed, own"),
        ("packing=own", "packing: own grains are not in an address"),
        ("suction=<b>5</b>", "suction: '<b>5</b>' does not begin with a number"),
    ):
        blank.show(f"#view=heap&{query}")
        playwright.expect(blank.page.locator("#heap-notices")).to_contain_text(words)
        expect_state(blank, wet(15e3))


def test_a_script_that_is_missing_is_told(browser, url):
    context = browser.new_context(service_workers="block")
    seen = page.Seen(context, url)
    seen.page.route("**/heap.js", lambda route: route.abort())
    seen.show(page.START)
    seen.page.get_by_role("link", name="A heap of grains").click()
    playwright.expect(seen.page.locator("#view-notice")).to_contain_text("heap.js beside this page could not be loaded")
    seen.page.unroute("**/heap.js")
    seen.page.get_by_role("link", name="A pair").click()
    playwright.expect(seen.page.locator("#view-notice")).to_be_hidden()
    seen.page.get_by_role("link", name="A heap of grains").click()
    seen.page.wait_for_selector("#heap-chart .drying")
    context.close()


# -- To take away ----------------------------------------------------------------------------------------------------


def test_what_is_taken_away_gives_the_same_numbers(desk, tmp_path, monkeypatch, capsys):
    saved = {}
    for button in ("Curves, CSV", "Picture, PNG", "Grains, text", "Program, Python"):
        with desk.page.expect_download() as download:
            desk.page.get_by_role("button", name=button).click()
        saved[download.value.suggested_filename] = download.value.path().read_bytes()
    assert list(saved) == ["retention.csv", "heap.png", "grains.txt", "heap.py"]
    assert struct.unpack(">II", saved["heap.png"][16:24]) == (1400, 1200)
    (tmp_path / "grains.txt").write_bytes(saved["grains.txt"])
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    exec(saved["heap.py"].decode(), names)
    w = wet(15e3)
    assert names["w"].suction_stress == pytest.approx(w.suction_stress, rel=1e-12)
    assert capsys.readouterr().out.startswith(f"{len(w.bridges)} bridges, saturation {w.saturation:.6e}")
    rows = list(csv.DictReader(io.StringIO(saved["retention.csv"].decode())))
    curves = names["curves"]
    assert len(rows) == 2 * curves.suction.size
    for row in rows:
        own = curves.sel(path=row["path"]).sel(suction=float(row["suction"]), method="nearest")
        for name in ("saturation", "suction_stress", "interface_area", "meeting_liquid"):
            assert float(row[name]) == pytest.approx(float(own[name]), rel=1e-11), (row["suction"], name)
    assert desk.page.locator("#heap-program").text_content() == saved["heap.py"].decode()


def test_a_link_is_copied(browser, url):
    context = browser.new_context(permissions=["clipboard-read", "clipboard-write"])
    seen = Heap(context, url)
    seen.show(START)
    seen.page.get_by_role("button", name="Copy link").click()
    playwright.expect(seen.page.locator("#copy-link")).to_have_text("Copied")
    assert seen.page.evaluate("navigator.clipboard.readText()") == f"{url}{START}"
    context.close()


# -- Where it runs ---------------------------------------------------------------------------------------------------


def test_it_opens_without_a_network_after_a_visit_of_the_pair(browser, url):
    context = browser.new_context()
    seen = Heap(context, url)
    page.Seen.show(seen, page.START)
    seen.page.evaluate("navigator.serviceWorker.ready.then(() => true)")
    seen.page.wait_for_function("navigator.serviceWorker.controller !== null")
    context.set_offline(True)
    seen.show(START)
    expect_state(seen, wet(15e3))
    context.close()


def test_it_opens_from_a_file(browser, tmp_path):
    write_page(tmp_path)
    seen = Heap(browser, tmp_path.as_uri() + "/index.html")
    seen.show(START)
    expect_state(seen, wet(15e3))
    assert seen.complaints == []
    seen.page.close()


@pytest.mark.skipif(page.FIREFOX is None, reason="no firefox on the path: apt-get install firefox-esr")
def test_firefox_shows_the_same(url, tmp_path):
    with Firefox(page.FIREFOX, tmp_path) as firefox:
        write_page(tmp_path / "page")
        for address in (url, (tmp_path / "page" / "index.html").as_uri()):
            firefox.go("about:blank")
            firefox.go(address + START)
            firefox.wait_for("document.querySelector('#heap-chart .drying')")
            w = wet(15e3)
            assert firefox.run("return document.querySelector('#heap-tiles .bridges .value').textContent") == str(
                len(w.bridges)
            )
            told = firefox.run("return document.querySelector('#heap-tiles .force .value').textContent")
            assert told.replace("\u00a0", " ") == show(w.suction_stress, "Pa", 4)
            before = firefox.run(f"return ({PICTURE})()")
            assert before > 0
            firefox.run(
                "const slider = document.getElementById('slider-heap-suction');"
                "slider.stepUp(9); slider.dispatchEvent(new Event('input'))"
            )
            firefox.wait_for(f"({PICTURE})() !== {before}")
            assert firefox.run("return document.documentElement.scrollWidth <= innerWidth")


# -- For everyone ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nobody_is_shut_out(browser, url, scheme):
    seen = Heap(browser, url, color_scheme=scheme)
    seen.show(START)
    seen.page.locator("#heap-own summary").click()
    seen.page.get_by_role("button", name="Use them").click()
    playwright.expect(seen.page.locator("#heap-text-wrong")).not_to_be_empty()
    seen.expect_open_to_all()
    seen.page.close()


def test_all_is_reached_by_keyboard(desk):
    reached = desk.reached_by_keyboard()
    names = [name for name, _ in reached]
    for name in (
        "A pair",
        "A heap of grains",
        "grains of radius",
        "Nearer",
        "Quantity",
        "drying",
        "Suction",
        "loose",
        "Mean radius",
        "Own grains",
        "Contact angle",
        "Liquid",
        "Curves, CSV",
    ):
        assert any(name in one for one in names), name
    assert all(name and ring for name, ring in reached[:28])


def test_it_fits_every_window(blank):
    blank.show(START)
    for width, height in page.SIZES:
        blank.shrink_to(width, height)
        seen = blank.page.locator("#heap-canvas").bounding_box()
        assert seen["x"] >= 0
        assert seen["x"] + seen["width"] <= width
        assert seen["y"] < height / 2
        assert seen["height"] > 150
