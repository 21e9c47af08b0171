"""Write the figures and the claims of the article, and one page with both: ``python -m studies.paper --out DIR``."""

import argparse
from pathlib import Path

from rich.console import Console
from rich.progress import Progress

from .report import write_report


def write(out: Path) -> str:
    """Write all files, with a bar while it takes; returns what was written."""
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        paths = write_report(out, progress=lambda done, share: bar.update(task, description=done, completed=share))
    return f"{len(paths)} files; open {out / 'index.html'}"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m studies.paper", description=__doc__)
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder for the files")
    asked = parser.parse_args()
    try:
        print(write(asked.out))  # noqa: T201
    except ValueError as error:
        parser.error(str(error))
