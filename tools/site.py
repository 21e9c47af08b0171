"""Build the site and see that its pages load nothing from elsewhere: ``python -m tools.site [folder]``."""

import re
import sys
import time
from pathlib import Path

from sphinx.cmd.build import build_main

ROOT = Path(__file__).parents[1]
LOADED = re.compile(r"<(?:script|link|img|iframe)\b[^>]*\b(?:src|href)=\"((?:https?:)?//[^\"]*)")


def main(folder: Path) -> int:
    """Build with warnings as errors; returns an exit status."""
    started = time.perf_counter()
    status = build_main(
        ["-q", "-W", "--keep-going", "-d", str(ROOT / "out" / "doctrees"), str(ROOT / "docs"), str(folder)]
    )
    if status:
        return status
    pages = sorted(folder.glob("**/*.html"))
    outside = [f"{page.name}: {address}" for page in pages for address in loaded_from_outside(page.read_text("utf-8"))]
    print("\n".join(outside) or f"{len(pages)} pages in {time.perf_counter() - started:.0f} s: {folder}/index.html")  # noqa: T201
    return len(outside)


def loaded_from_outside(html: str) -> list[str]:
    """Addresses that a page makes a browser load from the network."""
    return LOADED.findall(html)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "out" / "site"))
