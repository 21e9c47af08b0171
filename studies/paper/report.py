"""The report: all figures as files, the claims as JSON, and one page with everything that needs no other file."""

import json
from base64 import b64encode
from collections.abc import Callable
from dataclasses import asdict
from html import escape
from io import BytesIO
from os import PathLike
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING

import matplotlib as mpl

from pendular.ground.files import in_one_line, whole

from .claims import Claim, measure
from .figures import FIGURES, Drawing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["write_report"]

Claims = dict[str, tuple[Claim, ...]]

_TEMPLATE = Path(__file__).with_name("page.html")
_VERDICT = {True: '<td class="holds">✓ holds</td>', False: '<td class="fails">✗ does not hold</td>'}
_COLUMNS = ("where", "says", "measured")


def write_report(
    folder: str | PathLike[str], density: float = 1.0, progress: Callable[[str, float], None] | None = None
) -> tuple[Path, ...]:
    """Write the figures, the claims and the page.

    Parameters
    ----------
    folder : path
        Where to write; made if it does not exist.
    density : float
        Share of the full sample behind the claims, in (0, 1].
    progress : callable, optional
        Told what has been done, and the share of the whole, after every step.

    Returns
    -------
    tuple of Path
        ``index.html``, ``claims.json`` and the figures, in this order.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [path.name for path in write_report(folder, density=0.05)][:3]
    ['index.html', 'claims.json', 'figure01.svg']
    """
    home = Path(folder)
    with in_one_line("out", home, "written to"):
        home.mkdir(parents=True, exist_ok=True)
    tell = progress or (lambda done, share: None)
    steps = len(FIGURES) + 1
    claims = measure(density)
    tell("claims", 1 / steps)
    pictures = {}
    for step, drawing in enumerate(FIGURES, start=2):
        pictures[drawing] = svg(drawing.draw())
        tell(f"figure {drawing.number}", step / steps)
    files = {
        "index.html": page(claims, pictures).encode(),
        "claims.json": json_text(claims).encode(),
        **{f"{drawing.name}.svg": picture for drawing, picture in pictures.items()},
    }
    for name, content in files.items():
        with in_one_line("out", home / name), whole(home / name) as draft:
            draft.write_bytes(content)
    return tuple(home / name for name in files)


def svg(figure: "Figure") -> bytes:
    """A figure as SVG: letters as outlines, so that it looks the same everywhere, and no date."""
    buffer = BytesIO()
    with mpl.rc_context({"svg.fonttype": "path", "svg.hashsalt": "pendular"}):
        figure.savefig(buffer, format="svg", metadata={"Date": None})
    return buffer.getvalue()


def json_text(claims: Claims) -> str:
    """The claims in the order of the page, each with its subject."""
    rows = [{"subject": subject, **asdict(claim)} for subject, group in claims.items() for claim in group]
    return json.dumps(rows, ensure_ascii=False, indent=2) + "\n"


def page(claims: Claims, pictures: dict[Drawing, bytes]) -> str:
    """The page, with its pictures inside."""
    every = [claim for group in claims.values() for claim in group]
    return Template(_TEMPLATE.read_text(encoding="utf-8")).substitute(
        total=len(every),
        holds=sum(claim.holds for claim in every),
        fails=sum(not claim.holds for claim in every),
        claims="\n".join(_table(subject, group) for subject, group in claims.items()),
        figures="\n".join(_figure(drawing, picture) for drawing, picture in pictures.items()),
    )


def _table(subject: str, claims: tuple[Claim, ...]) -> str:
    rows = "\n".join(map(_row, claims))
    head = "".join(
        f'<th scope="col">{name}</th>' for name in ("Where", "What it says", "Measured here", "Verdict", "Why")
    )
    return f"<h3>{escape(subject)}</h3>\n<table><thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody></table>"


def _row(claim: Claim) -> str:
    told = "".join(f'<td class="{name}">{escape(getattr(claim, name))}</td>' for name in _COLUMNS)
    better = f'<p class="better">{escape(claim.better)}</p>' if claim.better else ""
    return f'<tr id="{claim.name}">{told}{_VERDICT[claim.holds]}<td class="why">{escape(claim.why)}{better}</td></tr>'


def _figure(drawing: Drawing, picture: bytes) -> str:
    data = b64encode(picture).decode()
    title = escape(f"Figure {drawing.number}. {drawing.title}.")
    return (
        f'<figure id="{drawing.name}"><img alt="{title}" src="data:image/svg+xml;base64,{data}">'
        f"<figcaption><b>{title}</b> {escape(drawing.caption)}</figcaption></figure>"
    )
