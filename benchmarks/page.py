"""How fast the explorer page is, in a headless Chromium: ``python -m benchmarks.page`` writes it into docs/explorer.md.

Latency is the time from a key that moves a slider to the first frame after pair and curve, or heap and curve, are
redrawn, seen in the browser. Transfer is what the browser takes over the wire on a first visit, and once more when the
heap is first asked for; the first picture is timed from the click.
A phone is a small window, and this machine with its processor throttled by the browser.
"""

import os
import shutil
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from playwright.sync_api import Browser, CDPSession, Page, sync_playwright

from benchmarks.sections import processor
from pendular.front.explorer.files import page_files
from pendular.front.explorer.server import server_of

DOCS = Path(__file__).parents[1] / "docs" / "explorer.md"
BEGIN, END = "<!-- written by python -m benchmarks.page -->", "<!-- end of what is written -->"
MOVES = 30
VISITS = 7
REST = 600  # until nothing is left to be done, [ms]
GOALS = {"transfer": 1.5e6, "first picture": 2.0, "desk": 0.030, "phone": 0.100}
PHONES = (4, 6)  # times slower
WINDOWS = ({"width": 1280, "height": 860}, {"width": 390, "height": 844})


class Case(NamedTuple):
    """A slider of a view."""

    query: str
    field: str
    drawn: str  # what changes in the page with the picture
    ready: str  # what is there when the page rests


def pair_case(query: str, field: str) -> Case:
    """A slider of the pair."""
    return Case(query, field, "picture", "#plan:not(.old)")


SUCTION, VOLUME = "#suction=5kPa&separation=3um", "#volume=5pL&separation=3um"
LAWS = f"{VOLUME}&laws=willett2000,zhao2020"
CASES = {
    "suction; suction": pair_case(SUCTION, "Suction"),
    "suction; separation": pair_case(SUCTION, "Separation"),
    "volume; volume": pair_case(VOLUME, "Volume"),
    "volume; separation": pair_case(VOLUME, "Separation"),
    "volume, with two laws; volume": pair_case(LAWS, "Volume"),
    "volume, with two laws; separation": pair_case(LAWS, "Separation"),
    "heap of 200 grains; suction": Case("#view=heap", "Suction", "heap-chart-now", "#heap-chart .drying"),
}

WATCH = """
let pressed;
addEventListener("keydown", () => { pressed = performance.now(); }, true);
window.redrawn = (id) => new Promise((resolve) => {
  // picture and curve are drawn in one go, and seen when the next frame begins
  const seen = () => requestAnimationFrame(() => setTimeout(() => resolve(performance.now() - pressed)));
  const watch = (_, observer) => { observer.disconnect(); seen(); };
  new MutationObserver(watch).observe(document.getElementById(id), { childList: true });
});
0;  // or the function itself would be called
"""
# The frame that follows the one in which the picture is drawn.
FIRST = """
new MutationObserver((_, observer) => {
  if (!document.querySelector("#picture .solid")) return;
  observer.disconnect();
  requestAnimationFrame(() => setTimeout(() => { window.firstPicture = performance.now(); }));
}).observe(document, { childList: true, subtree: true });
"""
# The frame that follows the one in which the heap is drawn, after a click on its link.
FIRST_HEAP = """() => new Promise((resolve) => {
  const start = performance.now();
  new MutationObserver((_, observer) => {
    if (!document.querySelector("#heap-tiles .tile")) return;
    observer.disconnect();
    requestAnimationFrame(() => setTimeout(() => resolve(performance.now() - start)));
  }).observe(document, { childList: true, subtree: true });
  document.getElementById("to-heap").click();
})"""


class Visit(NamedTuple):
    """A first visit, of the pair and then of the heap."""

    transfer: int  # bytes
    seconds: float  # until the first picture
    heap_transfer: int
    heap_seconds: float


Visits = dict[int, list[Visit]]  # by how much slower the machine is made
Moves = dict[int, dict[str, np.ndarray]]


@contextmanager
def served() -> Iterator[str]:
    """Address of the page."""
    with server_of("127.0.0.1", 0, page_files()) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}/"
        server.shutdown()


def visit(browser: Browser, url: str, slower: int) -> Visit:
    """Visit the page for the first time."""
    context = browser.new_context(viewport=WINDOWS[slower > 1], service_workers="block")
    page = context.new_page()
    throttle(page, slower)
    page.add_init_script(FIRST)
    weight: list[int] = []
    page.on("requestfinished", lambda request: weight.append(sum_of(request.sizes())))
    page.goto(url)
    page.wait_for_function("window.firstPicture")
    seconds = 1e-3 * page.evaluate("window.firstPicture")
    transfer = sum(weight)
    heap_seconds = 1e-3 * page.evaluate(FIRST_HEAP)
    context.close()
    return Visit(transfer, seconds, sum(weight) - transfer, heap_seconds)


def sum_of(sizes: Any) -> int:
    """Bytes of an answer, with its head."""
    return int(sizes["responseBodySize"] + sizes["responseHeadersSize"])


def throttle(page: Page, slower: int) -> None:
    """Make the processor of a page slower."""
    page.context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": slower})


def latency(page: Page, case: Case) -> np.ndarray:
    """Seconds from key to picture, for each move of a slider."""
    page.get_by_role("slider", name=case.field, exact=True).focus()
    times = []
    for move in range(MOVES):
        page.evaluate(f"window.drawing = window.redrawn('{case.drawn}'); 0")
        page.keyboard.press("ArrowRight" if move < MOVES // 2 else "ArrowLeft")
        times.append(1e-3 * page.evaluate("window.drawing"))
        page.wait_for_timeout(60)
    return np.array(times)


def work(browser: Browser, url: str) -> dict[str, float]:
    """Processor seconds of the page for a move of each slider, all that follows from it among them."""
    found = {}
    for name, case in CASES.items():
        page = opened(browser, url, case, 1)
        session = page.context.new_cdp_session(page)
        session.send("Performance.enable", {"timeDomain": "threadTicks"})

        def spent(session: CDPSession = session) -> float:
            metrics = session.send("Performance.getMetrics")["metrics"]
            return float(next(one["value"] for one in metrics if one["name"] == "TaskDuration"))

        before = spent()
        latency(page, case)
        found[name] = (spent() - before) / MOVES
        page.close()
    return found


def latencies(browser: Browser, url: str, slower: int) -> dict[str, np.ndarray]:
    """Latency of each slider."""
    found = {}
    for name, case in CASES.items():
        page = opened(browser, url, case, slower)
        found[name] = latency(page, case)
        page.close()
    return found


def opened(browser: Browser, url: str, case: Case, slower: int) -> Page:
    """The page with the view of a slider, watched."""
    page = browser.new_page(viewport=WINDOWS[slower > 1])
    page.goto(url + case.query)
    page.wait_for_selector(case.ready)
    page.wait_for_timeout(REST)
    throttle(page, slower)
    page.evaluate(WATCH)
    return page


def tell(visits: Visits, moves: Moves, worked: dict[str, float]) -> Iterator[str]:
    """The part of the page that is written."""
    yield f"On {os.cpu_count()} cores of {processor()} without a graphics card, shared with other work, in Chromium:"
    yield ""
    yield "| a first visit | " + " | ".join(map(speed_words, visits)) + " | goal |"
    yield "| --- |" + " ---: |" * (len(visits) + 1)
    empty, most = " |" * (len(visits) - 1), 1e-6 * GOALS["transfer"]
    yield f"| transfer | {1e-3 * heaviest(visits, 'transfer'):.0f} kB |{empty} {most:g} MB |"
    yield f"| first picture | {seconds_words(visits, 'seconds')} | {GOALS['first picture']:g} s |"
    yield f"| heap of grains, transfer | {1e-3 * heaviest(visits, 'heap_transfer'):.0f} kB |{empty} |"
    yield f"| heap of grains, first picture | {seconds_words(visits, 'heap_seconds')} | {GOALS['first picture']:g} s |"
    yield ""
    yield "From the key that moves a slider to the painted frame, median, the time that nine of ten are below, and the"
    yield "processor time of a move in all, which other work on the machine hardly changes:"
    yield ""
    yield "| held constant, and slider | " + " | ".join(map(speed_words, moves)) + " | work |"
    yield "| --- |" + " ---: |" * (len(moves) + 1)
    for case in next(iter(moves.values())):
        cells = [times_words(found[case]) for found in moves.values()]
        yield f"| {case} | " + " | ".join(cells) + f" | {1e3 * worked[case]:.0f} ms |"
    yield f"| goal, median | {1e3 * GOALS['desk']:.0f} ms |" + f" {1e3 * GOALS['phone']:.0f} ms |" * len(PHONES) + " |"


def heaviest(visits: Visits, field: str) -> int:
    """Most bytes of all visits."""
    return max(getattr(one, field) for found in visits.values() for one in found)


def middle(visits: list[Visit], field: str) -> float:
    """Median over visits."""
    return float(np.median([getattr(one, field) for one in visits]))


def seconds_words(visits: Visits, field: str) -> str:
    """Medians at each speed."""
    return " | ".join(f"{middle(found, field):.2f} s" for found in visits.values())


def speed_words(slower: int) -> str:
    """Name of a speed."""
    return "this machine" if slower == 1 else f"{slower} times slower"


def times_words(times: np.ndarray) -> str:
    """Median, and the time that nine of ten are below."""
    return f"{1e3 * np.median(times):.0f}, {1e3 * np.quantile(times, 0.9):.0f} ms"


def missed(visits: Visits, moves: Moves) -> list[str]:
    """Goals that are not met."""
    slowest = {slower: max(float(np.median(times)) for times in found.values()) for slower, found in moves.items()}
    checks = {
        "transfer": heaviest(visits, "transfer") + heaviest(visits, "heap_transfer") <= GOALS["transfer"],
        "first picture": max(middle(visits[1], name) for name in ("seconds", "heap_seconds")) <= GOALS["first picture"],
        "desk": slowest[1] <= GOALS["desk"],
        "phone": max(slowest[slower] for slower in PHONES) <= GOALS["phone"],
    }
    return [name for name, is_met in checks.items() if not is_met]


def main() -> int:
    """Measure, write and print."""
    with served() as url, sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox", "--disable-gpu"]
        )
        speeds = (1, *PHONES)
        visits = {slower: [visit(browser, url, slower) for _ in range(VISITS)] for slower in speeds}
        moves = {slower: latencies(browser, url, slower) for slower in speeds}
        worked = work(browser, url)
        browser.close()
    text = "\n".join(tell(visits, moves, worked))
    before, _, rest = DOCS.read_text(encoding="utf-8").partition(BEGIN)
    after = rest.partition(END)[2]
    DOCS.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{after}", encoding="utf-8")
    print(text)
    fails = missed(visits, moves)
    print(f"missed: {', '.join(fails)}" if fails else "all goals are met")
    return len(fails)


if __name__ == "__main__":
    sys.exit(main())
