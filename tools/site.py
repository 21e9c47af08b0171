"""Build the site and check its pages: ``python -m tools.site [folder]``.

They load nothing from elsewhere, every link within the site leads to a page, a file or a place on a page, and the
search works from files. Addresses outside are listed in ``links.txt`` beside the site, with the pages that name them;
nothing is asked of the network.
"""

import re
import sys
import time
from collections import defaultdict
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from sphinx.cmd.build import build_main

ROOT = Path(__file__).parents[1]
LOADED = re.compile(r"<(?:script|link|img|iframe)\b[^>]*\b(?:src|href)=\"((?:https?:)?//[^\"]*)")


class Links(HTMLParser):
    """What a page links to or shows, and the places on it that can be linked to."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.targets: set[str] = set()
        self.places: set[str] = set()
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Take the addresses and the name of an element."""
        for name, value in attrs:
            if value and name == "id":
                self.places.add(value)
            elif value and (name == "href" or (name == "src" and tag in ("img", "script", "iframe"))):
                self.targets.add(value)


def main(folder: Path) -> int:
    """Build with warnings as errors; returns an exit status."""
    started = time.perf_counter()
    status = build_main(
        ["-q", "-W", "--keep-going", "-d", str(ROOT / "out" / "doctrees"), str(ROOT / "docs"), str(folder)]
    )
    if status:
        return status
    pages = {path: path.read_text("utf-8") for path in sorted(folder.glob("**/*.html"))}
    wrong = [f"{path.name} loads {address}" for path, html in pages.items() for address in loaded_from_outside(html)]
    links = {path: Links(html) for path, html in pages.items()}
    wrong += [*broken_links(folder, links), *why_not_searched(folder)]
    outside = links_outside(folder, links)
    lines = [f"{address}  {' '.join(sorted(naming))}" for address, naming in sorted(outside.items())]
    (folder.parent / "links.txt").write_text("\n".join([*lines, ""]), encoding="utf-8")
    told = f"{len(pages)} pages in {time.perf_counter() - started:.0f} s, {len(outside)} links outside"
    print("\n".join(wrong) or f"{told}: {folder}/index.html")  # noqa: T201
    return min(len(wrong), 1)


def loaded_from_outside(html: str) -> list[str]:
    """Addresses that a page makes a browser load from the network."""
    return LOADED.findall(html)


def broken_links(folder: Path, links: dict[Path, Links]) -> list[str]:
    """Links of pages that lead to no file of the site, or to no place on its page."""
    wrong = []
    for path, page in links.items():
        for target in sorted(page.targets):
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            file = path.parent / unquote(parts.path) if parts.path else path
            file = file.resolve()
            place = unquote(parts.fragment)
            if not file.is_file() or not file.is_relative_to(folder.resolve()):
                wrong.append(f"{path.relative_to(folder)}: {target} is not there")
            elif (
                place
                and "=" not in place  # else what a page is to show, as the explorer keeps it in its address
                and file.suffix == ".html"
                and place not in links[folder / file.relative_to(folder.resolve())].places
            ):
                wrong.append(f"{path.relative_to(folder)}: {target} has no such place")
    return wrong


def why_not_searched(folder: Path) -> list[str]:
    """Why the search fails where the site is opened from files: no index, or it asks for the pages that it finds."""
    index, options = folder / "searchindex.js", folder / "_static" / "documentation_options.js"
    missing = [f"{file.name} is not there" for file in (index, options) if not file.is_file()]
    if not missing and "SHOW_SEARCH_SUMMARY: false" not in options.read_text("utf-8"):
        return ["the search asks for pages, which a browser grants no file"]
    return missing


def links_outside(folder: Path, links: dict[Path, Links]) -> dict[str, set[str]]:
    """Addresses outside of the site, each with the pages that name it."""
    found: dict[str, set[str]] = defaultdict(set)
    for path, page in links.items():
        for target in page.targets:
            if urlsplit(target).scheme in ("http", "https"):
                found[target].add(str(path.relative_to(folder)))
    return found


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "out" / "site"))
