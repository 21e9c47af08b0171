"""Pairs of any solids on the explorer page: their numbers beside Python's, what a person does, what is taken away."""

import contextlib
import csv
import io
import json
import math
import shlex
import warnings

import numpy as np
import pytest
from playwright import sync_api as playwright

import pendular as pl
from firefox import Firefox
from pendular.codes import wasm
from pendular.front.cli import main
from pendular.front.explorer.files import write_page
from pendular.ground.units import read, show
from test_explorer_page import (
    FIREFOX,
    SIZES,
    START,
    WATER,
    Seen,
    answer_of,
    blank,
    browser,
    desk,
    number_of,
    pytestmark,
    saved,
    url,
)

__all__ = ["blank", "browser", "desk", "pytestmark", "url"]  # fixtures and marks of the page

SEED = 20261201
TIP = "#solid=cone:60deg:20nm&radius2=plane&contact-angle=30&contact-angle2=10&volume=1e-23m^3&separation=1nm"
TIP_PAIR = pl.Pair((pl.Cone(math.radians(60.0), 20e-9), math.inf), (math.radians(30.0), math.radians(10.0)))
TIP_HELD = {"volume": 1e-23, "liquid": WATER}
ROD = "#solid=disc:1mm&radius2=plane&contact-angle=40&volume=3uL&separation=0.3mm"


@pytest.fixture(scope="module", autouse=True)
def solver():
    """Made before a browser asks for it, whose patience may end sooner."""
    wasm.solids_module()


def random_solid(rng):
    """A solid as it is typed, and for the library."""
    size = 10.0 ** rng.uniform(-0.7, 0.7)
    degrees = float(rng.integers(15, 90))
    kinds = {
        "sharp cone": (f"solid=cone:{degrees!r}deg", pl.Cone(math.radians(degrees))),
        "cone": (f"solid=cone:{degrees!r}deg:{size!r}m", pl.Cone(math.radians(degrees), size)),
        "paraboloid": (f"solid=paraboloid:{size!r}m", pl.Paraboloid(size)),
        "disc": (f"solid=disc:{size!r}m", pl.Disc(size)),
        "pinned disc": (f"solid=disc:{size!r}m:pinned", pl.Disc(size, pinned=True)),
        "sphere": (f"radius={size!r}m", size),
        "plane": ("radius=plane", math.inf),
    }
    return kinds[str(rng.choice(list(kinds)))]


def random_question(rng):
    """A question about two solids in metres, of which one is no sphere and no plane, as typed and for Python."""
    while True:
        (first, one), (second, other) = random_solid(rng), random_solid(rng)
        if not (isinstance(one, float) and isinstance(other, float)):
            break
    degrees = [float(rng.integers(2, 100)) for _ in range(2)]
    control = str(rng.choice(["suction", "volume"]))
    value = 10.0 ** (rng.uniform(-1.5, 1.5) if control == "suction" else rng.uniform(-3.0, 0.5))
    gap = 10.0 ** rng.uniform(-3.0, 0.3)
    words = [first, second.replace("=", "2=", 1), f"contact-angle={degrees[0]!r}", f"contact-angle2={degrees[1]!r}"]
    words += [f"{control}={value!r}{'Pa' if control == 'suction' else 'm^3'}", f"separation={gap!r}m"]
    pair = pl.Pair((one, other), tuple(np.deg2rad(degrees)))
    return "&".join([*words, "surface-tension=1N/m"]), (pair, gap, {control: value})


FIELDS = {
    "force": "force", "volume": "volume", "suction": "suction", "neckRadius": "neck_radius",
    "liquidGasArea": "liquid_gas_area", "surfaceEnergy": "surface_energy", "contactRadius": "contact_radius",
    "wettedArea": "wetted_area", "halfFillingAngle": "half_filling_angle",
}  # fmt: skip


def test_numbers_of_other_solids_are_those_of_python(blank):
    print(f"seed {SEED}")
    blank.show(TIP)
    rng, liquid, stood, ends = np.random.default_rng(SEED), pl.Liquid(surface_tension=1.0), 0, 0
    for _ in range(120):
        words, (pair, gap, held) = random_question(rng)
        found = answer_of(blank, words)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", pl.ConvergenceWarning)
            wanted, end = pl.bridge(pair, gap, liquid=liquid, **held), pl.rupture(pair, liquid=liquid, **held)
        assert (found["state"] is not None) == bool(wanted.exists), words
        assert (found["rupture"] is not None) == bool(end.exists), words
        if end.exists:
            ends += 1
            assert found["rupture"]["separation"] == pytest.approx(end.separation, rel=1e-12), words
        if not wanted.exists:
            continue
        stood += 1
        size = float(np.max(wanted.contact_radius))
        scales = {"surfaceEnergy": size**2, "liquidGasArea": size**2, "volume": size**3, "suction": 1.0 / size}
        for name, own in FIELDS.items():
            told = np.array([number_of(one) for one in np.atleast_1d(np.array(found["state"][name], dtype=object))])
            wanted_told = np.atleast_1d(getattr(wanted, own))
            slack = 1e-12 * scales.get(name, size)
            np.testing.assert_allclose(told, wanted_told, rtol=1e-12, atol=slack, err_msg=f"{name} {words}")
        assert found["state"]["stable"] == bool(wanted.stable), words
        assert all(math.isnan(number_of(law["forceError"])) for law in found["laws"]), words
    print(f"{stood} bridges, {ends} ruptures")
    assert stood > 40
    assert ends > 60


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("solid=cube:1mm", "solid: 'cube:1mm' is not one of cone:30deg"),
        ("solid=cone:120deg", "half-angle: '120°' is not in (0, 90] degrees; write it like 60deg"),
        ("solid=disc:-1mm", "radius: '-1 mm' is not > 0; write it like 50um"),
        ("solid=disc:1mm:glued", "solid: 'disc:1mm:glued' is not one of"),
        ("radius=1mm&solid=disc:1mm", "solid: given together with radius; one of the two is needed"),
        ("solid=disc:1mm&radius2=plane&separation=0um", "two flat ends in contact leave no room for liquid"),
        (
            "solid=cone:60deg&separation=-1um",
            "separation: -0.000001 m is not >= 0; only spheres and planes may overlap",
        ),
    ],
)
def test_a_solid_that_cannot_be_meant_is_told(blank, words, message):
    blank.show(f"#{words}")
    playwright.expect(blank.page.locator("#notices")).to_contain_text(message)


# -- What a person does ----------------------------------------------------------------------------------------------


def test_spheres_load_no_other_solver(desk):
    assert not any("solids.js" in address for address in desk.asked)
    desk.page.select_option("#kind", "cone")
    playwright.expect(desk.text("Half angle 1")).to_be_visible()
    assert any("solids.js" in address for address in desk.asked)


def test_solids_are_picked(desk):
    desk.page.select_option("#kind2", "plane")
    playwright.expect(desk.text("Radius 2")).to_be_hidden()
    desk.page.select_option("#kind", "cone")
    playwright.expect(desk.text("Half angle 1")).to_be_visible()
    desk.write("Half angle 1", "50")
    desk.write("Tip radius 1", "10 um")
    pair = pl.Pair((pl.Cone(math.radians(50.0), 10e-6), math.inf), np.deg2rad(20.0))
    held = {"suction": 5e3, "liquid": WATER}
    desk.wait_for("force", show(float(pl.bridge(pair, 3e-6, **held).force), "N"))
    moved = math.radians(read("angle", desk.slide("Half angle 1", "ArrowRight").replace("°", "deg"), "deg", "20deg"))
    wider = pl.Pair((pl.Cone(moved, 10e-6), math.inf), np.deg2rad(20.0))
    desk.wait_for("force", show(float(pl.bridge(wider, 3e-6, **held).force), "N"))
    assert desk.slide("Tip radius 1", "Home") == "0 m"
    sharp = pl.Pair((pl.Cone(moved), math.inf), np.deg2rad(20.0))
    desk.wait_for("force", show(float(pl.bridge(sharp, 3e-6, **held).force), "N"))
    for kind, solid in (
        ("paraboloid", pl.Paraboloid(50e-6)),
        ("disc", pl.Disc(50e-6)),
        ("pinned disc", pl.Disc(50e-6, pinned=True)),
        ("sphere", 50e-6),
    ):
        desk.page.select_option("#kind", kind)
        desk.wait_for(
            "force", show(float(pl.bridge(pl.Pair((solid, math.inf), np.deg2rad(20.0)), 3e-6, **held).force), "N")
        )
    playwright.expect(desk.text("Radius 1")).to_be_visible()


@pytest.mark.parametrize("control", ["suction", "volume", "humidity"])
def test_what_is_held_is_changed(blank, control):
    blank.show(TIP)
    force = blank.number("force")
    blank.choose(control)
    playwright.expect(blank.page.get_by_role("radio", name=control, exact=True)).to_be_checked()
    blank.page.wait_for_url(f"**{control}=*")
    before, after = (float(text.split()[0]) for text in (force, blank.number("force")))
    assert after == pytest.approx(before, rel=1e-2)  # as near as the value that is written
    blank.slide(control.capitalize(), "ArrowRight")
    assert blank.number("force") != ""


def test_a_tip_is_pulled_until_the_bridge_breaks(blank):
    blank.show(TIP)
    x, y = blank.centre("#picture")
    blank.drag((x, y - 60), 0, -20)
    playwright.expect(blank.text("Separation")).not_to_have_value("1 nm")
    pulled = read("separation", blank.text("Separation").input_value(), "m", "3um")
    assert pulled > 1e-9
    blank.wait_for("force", show(float(pl.bridge(TIP_PAIR, pulled, **TIP_HELD).force), "N"))
    blank.drag((x, y - 60), 0, -400)
    playwright.expect(blank.page.locator(".tile.force .note")).to_have_text("no bridge at this separation")


@pytest.mark.parametrize(
    "view", [TIP, ROD, "#solid=paraboloid:1mm&solid2=disc:0.5mm:pinned&volume=0.2uL&separation=0.1mm"]
)
def test_the_picture_is_to_scale(blank, view):
    """Where the meniscus begins and ends in the drawing is where its contact circles are."""
    blank.show(view)
    found = answer_of(blank, view[1:])
    metre = blank.page.evaluate("window.explorer.picture().metre")
    points = blank.page.locator("#picture > polyline.meniscus").first.get_attribute("points").split()
    upright = "upright" in blank.page.locator("#picture").get_attribute("class")
    ends = [float(points[i].split(",")[0 if upright else 1]) for i in (0, -1)]
    wanted = [radius * metre for radius in found["state"]["contactRadius"]]
    assert [abs(end) for end in ends] == pytest.approx(wanted, abs=0.02)
    for solid in (1, 2):
        assert "NaN" not in blank.page.locator(f"#picture > .solid{solid}").get_attribute("points")


def test_laws_are_said_to_be_for_spheres(blank):
    blank.show(START + "&laws=zhao2020&map=zhao2020")
    playwright.expect(blank.page.get_by_role("checkbox", name="zhao2020")).to_be_visible()
    blank.page.select_option("#kind", "paraboloid")
    playwright.expect(blank.page.get_by_role("checkbox", name="zhao2020")).to_be_hidden()
    playwright.expect(blank.page.get_by_text("The laws are for spheres and planes")).to_be_visible()
    playwright.expect(blank.page.locator("#map-choice")).to_have_value("force")
    playwright.expect(blank.page.locator("#map-choice option[value=zhao2020]")).to_be_disabled()
    assert blank.page.locator("#chart .law").count() == 0
    blank.page.select_option("#kind", "sphere")
    playwright.expect(blank.page.get_by_role("checkbox", name="zhao2020")).to_be_visible()


@pytest.mark.parametrize("across", ["control", "separation"])
@pytest.mark.parametrize("view", [TIP, "#solid=cone:70deg&radius2=plane&volume=1pL&separation=2um"])
def test_a_map_of_other_solids_is_drawn(blank, view, across):
    blank.show(f"{view}&across={across}")
    blank.page.wait_for_selector("#plan:not(.old)", timeout=60000)
    playwright.expect(blank.page.locator("#map-key")).to_contain_text("N")
    assert blank.page.locator("#frame .now").count() == 1


def test_the_page_says_what_is_wrong_with_a_cone(blank):
    blank.show(TIP)
    blank.write("Half angle 1", "95")
    message = "half-angle: '95' is not in (0, 90] degrees; write it like 60deg"
    playwright.expect(blank.page.get_by_role("alert").filter(has_text=message)).to_be_visible()
    blank.write("Half angle 1", "60")
    blank.write("Separation", "-1 nm")
    words = "is not >= 0; only spheres and planes may overlap"
    playwright.expect(blank.page.get_by_role("alert").filter(has_text=words)).to_be_visible()
    blank.wait_for("force", show(float(pl.bridge(TIP_PAIR, 1e-9, **TIP_HELD).force), "N"))


def test_a_solver_that_cannot_be_loaded_is_told(browser, url):
    seen = Seen(browser, url, service_workers="block")  # one would ask past the route
    seen.page.route("**/solids.js", lambda route: route.abort())
    seen.show(START)
    seen.page.select_option("#kind", "cone")
    playwright.expect(seen.page.get_by_role("alert").filter(has_text="Other solids need solids.js")).to_be_visible()
    playwright.expect(seen.page.locator("#kind")).to_have_value("sphere")
    seen.page.unroute("**/solids.js")
    seen.page.select_option("#kind", "cone")
    playwright.expect(seen.text("Half angle 1")).to_be_visible()
    seen.page.close()


# -- To take away ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "view", [TIP, ROD, "#radius=80um&solid2=disc:40um:pinned&contact-angle=35&suction=1kPa&separation=9um"]
)
def test_what_is_taken_away_gives_the_same_number(blank, view):
    blank.show(view)
    exact = number_of(answer_of(blank, view[1:])["state"]["force"])
    command = blank.page.locator("#command").text_content()
    assert "--solid" in command
    with contextlib.redirect_stdout(io.StringIO()) as out, pytest.raises(SystemExit):
        main([*shlex.split(command)[1:], "--json"])
    assert json.loads(out.getvalue())["force"] == pytest.approx(exact, rel=1e-12)

    _, program = saved(blank, "Program, Python")
    names: dict = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(program, names)
    assert names["b"].force == pytest.approx(exact, rel=1e-12)

    _, table = saved(blank, "Curve, CSV")
    words = shlex.split(command.replace("pendular bridge", "curve"))
    place = words.index("--separation")
    with contextlib.redirect_stdout(io.StringIO()) as out, pytest.raises(SystemExit):
        main([*words[:place], *words[place + 2 :], "--csv"])
    rows, wanted = (list(csv.DictReader(io.StringIO(text))) for text in (table, out.getvalue()))
    assert list(rows[0]) == list(wanted[0])
    known = [row for row in wanted if row["exists"].lower() == "true"]
    assert len(rows) == len(known)
    for row, own in zip(rows, known, strict=True):
        assert float(row["force [N]"]) == pytest.approx(float(own["force [N]"]), rel=1e-10)

    name, picture = saved(blank, "Picture, SVG")
    assert name == "bridge.svg"
    assert picture.startswith("<svg xmlns=")
    assert "var(" not in picture
    assert "NaN" not in picture


def test_a_sent_address_shows_the_same(blank, browser, url):
    blank.show(TIP)
    blank.page.select_option("#kind2", "pinned disc")
    blank.write("Radius 2", "100 nm")
    blank.write("Half angle 1", "1 rad")
    blank.page.wait_for_url("**solid=cone:1rad:20nm&solid2=disc:100nm:pinned*")
    blank.page.wait_for_timeout(200)
    other = Seen(browser, url)
    other.show(blank.page.url.removeprefix(url))
    for name in ("Volume", "Separation", "Half angle 1", "Tip radius 1", "Radius 2"):
        assert other.text(name).input_value() == blank.text(name).input_value()
    assert other.page.locator("#kind2").input_value() == "pinned disc"
    assert other.page.locator(".numbers").inner_text() == blank.page.locator(".numbers").inner_text()
    other.page.close()


# -- Where it runs, and for everyone -----------------------------------------------------------------------------------


def test_it_opens_again_without_a_network(browser, url):
    context = browser.new_context()
    seen = Seen(context, url)
    seen.show(START)
    seen.page.evaluate("navigator.serviceWorker.ready.then(() => true)")
    seen.page.wait_for_function("navigator.serviceWorker.controller !== null")
    seen.page.select_option("#kind", "cone")
    playwright.expect(seen.text("Half angle 1")).to_be_visible()
    context.set_offline(True)
    seen.show(TIP)
    seen.wait_for("force", show(float(pl.bridge(TIP_PAIR, 1e-9, **TIP_HELD).force), "N"))
    context.close()


def test_it_opens_from_a_file(browser, tmp_path):
    write_page(tmp_path)
    seen = Seen(browser, tmp_path.as_uri() + "/index.html")
    seen.show(TIP)
    seen.wait_for("force", show(float(pl.bridge(TIP_PAIR, 1e-9, **TIP_HELD).force), "N"))
    assert seen.complaints == []
    seen.page.close()


@pytest.mark.skipif(FIREFOX is None, reason="no firefox on the path: apt-get install firefox-esr")
def test_firefox_shows_the_same(tmp_path):
    with Firefox(FIREFOX, tmp_path) as firefox:
        write_page(tmp_path / "page")
        firefox.go((tmp_path / "page" / "index.html").as_uri() + TIP)
        firefox.wait_for("document.querySelector('.tile.force .value')")
        force = firefox.run("return window.explorer.answerAt(location.hash.slice(1)).state.force")
        assert force == pytest.approx(pl.bridge(TIP_PAIR, 1e-9, **TIP_HELD).force, rel=1e-12)
        assert firefox.run("return document.getElementById('kind').value") == "cone"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nobody_is_shut_out(browser, url, scheme):
    seen = Seen(browser, url, color_scheme=scheme)
    seen.show(TIP)
    seen.page.wait_for_selector("#plan:not(.old)", timeout=60000)
    seen.write("Half angle 1", "95")
    playwright.expect(seen.page.locator("#wrong-half-angle")).not_to_be_empty()
    seen.expect_open_to_all()
    seen.page.close()


@pytest.mark.parametrize("view", [TIP, ROD])
def test_it_fits_every_window(blank, view):
    blank.show(view)
    for width, height in SIZES:
        blank.shrink_to(width, height)
        seen = blank.page.locator("#picture").bounding_box()
        assert seen["x"] >= 0
        assert seen["x"] + seen["width"] <= width
        assert seen["y"] < height / 2
