"""Every page of the site as it was built, in Chromium and Firefox, from files and from a server, on a dark phone.

``python -m tools.site`` builds it. A page is silent on the console, asks for nothing that is not there, and is no wider
than the window.
"""

import functools
import http.server
import shutil
import threading
from pathlib import Path

import pytest
from playwright import sync_api as playwright

from firefox import Firefox

SITE = Path(__file__).parents[1] / "out" / "site"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
FIREFOX = shutil.which("firefox-esr") or shutil.which("firefox")
pytestmark = pytest.mark.long
BUILT = pytest.mark.skipif(not (SITE / "index.html").is_file(), reason="no site in out/site: python -m tools.site")
PAGES = sorted(path.relative_to(SITE).as_posix() for path in SITE.glob("**/*.html"))
WIDTH = 360  # of a small phone
LEFT = "net::ERR_ABORTED"  # what was still on its way when the next page was opened
# What reaches over the right edge and cannot be scrolled to within its own box; and pictures that are cut off.
TOO_WIDE = """
const edge = document.documentElement.clientWidth + 1;
const wide = [...document.querySelectorAll("body *")].filter((one) => one.getBoundingClientRect().right > edge);
const scrolls = (one) => /auto|scroll/.test(getComputedStyle(one).overflowX);
const isScrolled = (one) => one && (scrolls(one) || isScrolled(one.parentElement));
const pictures = [...document.querySelectorAll("img, svg, video")].filter((one) => {
  const box = one.getBoundingClientRect();
  return box.width > edge && box.height > 0 && !one.closest(":has(> img.rest)");
});
const nameOf = (one) => `${one.tagName}.${one.getAttribute("class") ?? ""} ${one.getAttribute("src") ?? ""}`;
const told = (one) => `${nameOf(one)} ${(one.textContent ?? "").trim().slice(0, 40)}`.trim();
const isOver = document.documentElement.scrollWidth > edge;
return [...(isOver ? wide.filter((one) => !isScrolled(one)).slice(0, 4) : []), ...pictures].map(told);
"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    """Files without a line for each."""

    def log_message(self, format: str, *words: object) -> None:
        """Say nothing."""


@pytest.fixture(scope="module", params=["files", "server"])
def site(request):
    """Address of the site."""
    if request.param == "files":
        yield SITE.as_uri()
        return
    handler = functools.partial(Quiet, directory=str(SITE))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}"
        server.shutdown()


@BUILT
@pytest.mark.skipif(CHROMIUM is None, reason="no chromium on the path: apt-get install chromium")
def test_chromium_shows_every_page(site):
    wrong = []
    with playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
        page = chromium.new_page(viewport={"width": WIDTH, "height": 740}, color_scheme="dark")
        page.on("pageerror", lambda error: wrong.append((page.url, str(error))))
        page.on("console", lambda told: told.type in ("error", "warning") and wrong.append((page.url, told.text)))
        page.on("requestfailed", lambda asked: asked.failure != LEFT and wrong.append((page.url, asked.url)))
        for name in PAGES:
            page.goto(f"{site}/{name}")
            wrong += [(name, f"too wide: {one}") for one in page.evaluate(f"(() => {{{TOO_WIDE}}})()")]
        chromium.close()
    assert len(PAGES) > 90
    assert not wrong, "\n".join(map(str, wrong))


@BUILT
@pytest.mark.skipif(FIREFOX is None, reason="no firefox on the path: apt-get install firefox-esr")
def test_firefox_shows_every_page(site, tmp_path):
    wrong = []
    with Firefox(FIREFOX, tmp_path, dark=True) as firefox:
        firefox.narrow(WIDTH)
        for name in PAGES:
            firefox.go(f"{site}/{name}")
            width, is_dark = firefox.run("return [innerWidth, matchMedia('(prefers-color-scheme: dark)').matches]")
            assert WIDTH - 5 < width <= WIDTH
            assert is_dark
            wrong += [(name, f"too wide: {one}") for one in firefox.run(TOO_WIDE)]
        wrong += [("somewhere", told) for told in firefox.complaints()]
    assert not wrong, "\n".join(map(str, wrong))


@pytest.mark.skipif(FIREFOX is None, reason="no firefox on the path: apt-get install firefox-esr")
def test_firefox_tells_what_is_wrong(tmp_path):
    """What looks at the pages sees what it looks for."""
    page = tmp_path / "wrong.html"
    page.write_text(
        "<!doctype html><meta name=viewport content='width=device-width'><p style='width:900px'>wide</p>"
        "<script>console.error('said'); absent();</script>"
    )
    with Firefox(FIREFOX, tmp_path) as firefox:
        firefox.narrow(WIDTH)
        firefox.go(page.as_uri())
        assert firefox.run(TOO_WIDE) == ["P.  wide"]
        told = firefox.complaints()
    assert any("absent is not defined" in one for one in told)
    assert any("said" in one for one in told)
