"""The page of speeds, of which each benchmark writes a section of its own."""

import os
import platform
import sys
from importlib.metadata import version
from pathlib import Path

PAGE = Path(__file__).parent.parent / "docs" / "speed.md"
_BEGIN, _END = "<!-- written by python -m {name} -->", "<!-- end of {name} -->"


def put(name: str, text: str) -> None:
    """Print a section, and put it in the place of the one that the same command wrote before, or at the end."""
    sys.stdout.write(text)
    begin, end = _BEGIN.format(name=name), _END.format(name=name)
    section = f"{begin}\n{text.strip()}\n{end}\n"
    page = PAGE.read_text(encoding="utf-8")
    if begin in page:
        before, _, rest = page.partition(begin)
        page = before + section + rest.partition(f"{end}\n")[2]
    else:
        page = f"{page.rstrip()}\n\n{section}"
    PAGE.write_text(page, encoding="utf-8")


def processor() -> str:
    """Name of the processor."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def machine() -> str:
    """The machine in words."""
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    return f"{processor()}, {os.cpu_count()} cores{load}, Numba {version('numba')}"
