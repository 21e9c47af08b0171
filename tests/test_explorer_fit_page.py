"""The fit of a measured curve on the explorer page, in browsers, beside the library's own."""

import contextlib
import csv
import io
import json
import shlex

import numpy as np
import pytest
from playwright import sync_api as playwright

import pendular as pl
import test_explorer_page as page
from firefox import Firefox
from pendular.front.cli import main
from pendular.front.explorer.files import write_page

pytestmark = page.pytestmark
browser, url, blank = page.browser, page.url, page.blank

FITTED = "#fit-found:not([hidden])"
SAME = 0.01  # of a standard error


@pytest.fixture
def fitted(blank):
    """The page with its example fitted."""
    blank.show("")
    run_example(blank)
    return blank


def run_example(seen) -> None:
    seen.page.click("#fit-example")
    playwright.expect(seen.text("Volume")).to_have_value("5 nL")
    seen.page.click("#fit-run")
    seen.page.wait_for_selector(FITTED)


def found_on(seen) -> dict:
    return seen.page.evaluate("window.explorer.fit()")


def assert_same(found: dict, own: pl.Fit) -> None:
    for name, error in own.errors.items():
        assert abs(found["values"][name] - own.values[name]) < SAME * error
        assert found["errors"][name] == pytest.approx(error, rel=SAME)


def test_what_is_taken_away_finds_the_same(fitted, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = found_on(fitted)
    assert abs(found["values"]["contact_angle"] - np.deg2rad(28.0)) < 3.0 * found["errors"]["contact_angle"]
    name, text = page.saved(fitted, "Measured points, CSV")
    (tmp_path / name).write_text(text, encoding="utf-8")
    name, program = page.saved(fitted, "Python program of the fit")
    names: dict = {}
    with contextlib.redirect_stdout(io.StringIO()):
        exec(program, names)
    assert (name, fitted.page.locator("#fit-program").text_content()) == ("fit.py", program)
    assert_same(found, names["fit"])
    assert found["notes"] == list(names["fit"].notes)
    command = shlex.split(fitted.page.locator("#fit-command").text_content())
    with contextlib.redirect_stdout(io.StringIO()) as out, pytest.raises(SystemExit):
        main([*command[1:], "--json"])
    assert json.loads(out.getvalue())["values"] == pytest.approx(names["fit"].values, rel=1e-9)
    _, table = page.saved(fitted, "Fit and residuals, CSV")
    with contextlib.redirect_stdout(io.StringIO()) as out, pytest.raises(SystemExit):
        main([*command[1:], "--csv"])
    rows, wanted = (list(csv.DictReader(io.StringIO(text))) for text in (table, out.getvalue()))
    assert list(rows[0]) == list(wanted[0])
    assert len(rows) == len(wanted) == 60
    for row, own in zip(rows, wanted, strict=True):
        for title, value in row.items():
            assert float(value) == pytest.approx(float(own[title]), rel=1e-3, abs=1e-9), title


def test_the_fitted_bridge_is_shown(fitted):
    found = found_on(fitted)
    playwright.expect(fitted.text("Volume")).to_have_value(page.show(found["values"]["volume"], "m^3"))
    degrees = float(fitted.text("Contact angle").input_value().removesuffix("°"))
    assert degrees == pytest.approx(np.rad2deg(found["values"]["contact_angle"]), rel=1e-3)
    pair = pl.Pair(1e-3, np.deg2rad(degrees))
    volume = page.read("volume", fitted.text("Volume").input_value(), "m^3", "")
    fitted.wait_for("force", page.force_of(pair, 5e-5, volume=volume))
    words = fitted.page.locator("#fit-chart").get_attribute("aria-label")
    assert words.startswith("60 measured points of the force with the fitted bridge up to its rupture at 26")
    assert "NaN" not in fitted.page.locator("#fit-chart").inner_html()
    assert fitted.page.locator("#fit-numbers tr").first.inner_text().startswith("contact angle\t28.")


def test_a_valley_is_told_and_another_question_is_fitted(blank, tmp_path):
    blank.show("#radius=20um&radius2=plane&contact-angle=0.3rad&suction=100kPa&separation=0um")
    film, water = pl.Pair((20e-6, np.inf), 0.3), pl.Liquid.water()
    end = float(pl.rupture(film, suction=2e5, liquid=water).separation)
    gap = np.linspace(0.0, 0.9 * end, 40)
    force = pl.bridge(film, gap, suction=2e5, liquid=water).force
    file = tmp_path / "pull.txt"
    file.write_text(
        "\n".join(["z [nm]\tF [nN]", *(f"{1e9 * x:.6f}\t{-1e9 * f:.6f}" for x, f in zip(gap, force, strict=True))])
    )
    blank.page.set_input_files("#fit-file", file)
    blank.page.select_option("#fit-attraction", "negative")
    for name in ("contact angle", "offset"):
        blank.page.get_by_role("checkbox", name=name, exact=True).uncheck()
    blank.page.get_by_role("button", name="Fit", exact=True).click()
    blank.page.wait_for_selector(FITTED)
    assert found_on(blank)["values"] == pytest.approx({"suction": 2e5}, rel=1e-6)
    assert "--attraction negative" in blank.page.locator("#fit-command").text_content()
    for name in ("surface tension", "force scale"):
        blank.page.get_by_role("checkbox", name=name, exact=True).check()
    blank.page.get_by_role("button", name="Fit", exact=True).click()
    playwright.expect(blank.page.locator("#fit-lines .note").first).to_contain_text("the data do not tell them apart")
    playwright.expect(blank.page.locator("#fit-numbers")).to_contain_text("not fixed by these data")


DROP = """(text) => {
  const data = new DataTransfer();
  data.items.add(new File([text], "pull.csv", { type: "text/csv" }));
  document.getElementById("fit-text").dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
}"""


def test_a_file_is_dropped(blank):
    blank.show("")
    blank.page.evaluate(DROP, "gap (um);F (uN);error (uN);time (s)\n0,0;3,0;0,1;0\n1,0;2,0;0,1;1\n2,0;1,5;0,1;2\n")
    chart = blank.page.locator("#fit-chart")
    playwright.expect(chart).to_have_attribute("aria-label", "3 measured points of the force")
    blank.choose("volume")
    playwright.expect(blank.page.get_by_role("checkbox", name="evaporation rate")).to_be_visible()  # it has times
    blank.page.evaluate(DROP, "jpk\0\1\2")
    told = "curve: 'pull.csv' is no text; files of instruments are read by pendular fit"
    playwright.expect(blank.page.locator("#fit-wrong-text")).to_have_text(told)


def test_what_is_wrong_is_said_beside_its_field(blank):
    blank.show("")
    field = blank.page.get_by_role("textbox", name="Measured curve")
    run = blank.page.get_by_role("button", name="Fit", exact=True)
    run.click()
    playwright.expect(blank.page.locator("#fit-wrong-run")).to_have_text(
        "curve: there is none yet; paste one, or open a file"
    )
    field.fill("gap,F\n1,2\n3,4\n")
    playwright.expect(blank.page.locator("#fit-wrong-text")).to_contain_text("column 'gap' has none; write gap (um)")
    assert field.get_attribute("aria-invalid") == "true"
    field.fill("a (um),b (um),F (nN)\n1,2,3\n2,3,2\n3,4,1\n4,5,1\n5,6,1\n")
    playwright.expect(blank.page.locator("#fit-wrong-text")).to_contain_text("choose both columns")
    blank.page.select_option("#fit-column-separation", label="a (um)")
    playwright.expect(blank.page.locator("#fit-wrong-text")).to_be_empty()
    blank.page.fill("#fit-error", "1 um")
    run.click()
    playwright.expect(blank.page.locator("#fit-wrong-run")).to_contain_text(
        "force-error: '1 um' is not a quantity in N"
    )
    blank.page.fill("#fit-error", "")
    for tick in blank.page.locator("#fit-free input").all():
        tick.uncheck()
    run.click()
    playwright.expect(blank.page.locator("#fit-wrong-run")).to_have_text("free: nothing is; choose what is to be found")


def test_the_page_answers_while_it_fits(blank, tmp_path):
    """A curve of 20000 points takes a while, and can be stopped."""
    blank.show("#radius=1mm&radius2=1mm&contact-angle=10&volume=5nL&separation=50um")
    beads = pl.Pair(1e-3, 0.5)
    gap = np.linspace(0.0, 0.2e-3, 20000)
    force = pl.bridge(beads, gap, volume=1e-11, liquid=pl.Liquid.water()).force
    noisy = force + 1e-6 * np.random.default_rng(1).normal(size=gap.size)
    text = "\n".join(["gap (um),F (uN)", *(f"{1e6 * x:.5f},{1e6 * f:.5f}" for x, f in zip(gap, noisy, strict=True))])
    (tmp_path / "long.csv").write_text(text)
    blank.page.set_input_files("#fit-file", tmp_path / "long.csv")
    playwright.expect(blank.page.locator("#fit-chart")).to_have_attribute(
        "aria-label", "20000 measured points of the force"
    )
    blank.page.click("#fit-run")
    playwright.expect(blank.page.locator("#fit-status")).to_have_text("Fitting…")
    blank.slide("Separation", "ArrowRight")
    playwright.expect(blank.page.locator("#fit-stop")).to_be_visible()  # it is not ready yet
    blank.page.click("#fit-stop")
    playwright.expect(blank.page.locator("#fit-status")).to_be_empty()
    assert found_on(blank) is None


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nobody_is_shut_out_of_it(browser, url, scheme):
    seen = page.Seen(browser, url, color_scheme=scheme)
    seen.show("")
    run_example(seen)
    seen.page.wait_for_selector("#plan:not(.old)")
    seen.expect_open_to_all()
    seen.page.focus("#fit-text")
    reached = []
    for _ in range(30):
        seen.page.keyboard.press("Tab")
        reached.append(seen.page.evaluate("document.activeElement.id || document.activeElement.value"))
    for name in ("fit-open", "fit-example", "contact_angle", "force_zero", "fit-rupture", "fit-loss", "fit-run"):
        assert name in reached
    for width, height in page.SIZES:
        seen.shrink_to(width, height)
    assert seen.complaints == []
    seen.page.close()


def test_from_a_file_in_chromium(browser, tmp_path):
    write_page(tmp_path)
    seen = page.Seen(browser, tmp_path.as_uri() + "/index.html")
    seen.show("")
    run_example(seen)
    assert seen.complaints == []
    seen.page.close()


@pytest.mark.skipif(page.FIREFOX is None, reason="no firefox on the path: apt-get install firefox-esr")
def test_firefox_finds_the_same(fitted, url, tmp_path):
    own = found_on(fitted)["values"]
    with Firefox(page.FIREFOX, tmp_path) as firefox:
        write_page(tmp_path / "page")
        for address in (url, (tmp_path / "page" / "index.html").as_uri()):
            firefox.go(address)
            firefox.wait_for("document.querySelector('#picture .solid')")
            firefox.run("document.getElementById('fit-example').click()")
            firefox.wait_for("document.getElementById('text-value').value === '5 nL'")
            firefox.run("document.getElementById('fit-run').click()")
            firefox.wait_for("window.explorer.fit()")
            assert firefox.run("return window.explorer.fit().values") == pytest.approx(own, rel=1e-9)
