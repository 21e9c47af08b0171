"""Pieces of the page as HTML: the answer in a line, the table of numbers, errors of laws."""

from collections.abc import Iterable
from html import escape

from ...comparison.words import percent
from ...ground.units import show
from ...show.text import state_rows
from .answer import Answer, LawAnswer

__all__ = ["error_cells", "headline", "numbers", "paragraphs"]


def headline(answer: Answer) -> str:
    """Force and rupture distance, large; the other quantities that matter beside them."""
    state, end = answer.state, answer.rupture
    if not state.exists:
        nature = "no bridge at this separation" if end.exists else "no bridge between solids apart"
    else:
        nature = f"{'attraction' if state.force >= 0.0 else 'repulsion'}, {'stable' if state.stable else 'unstable'}"
    tiles = [_tile("Force", show(float(state.force), "N", 4), nature, "force")]
    if end.exists:
        tiles.append(_tile("Rupture at", show(float(end.separation), "m", 4), _stability(answer), "rupture"))
    other = "suction" if answer.view.control == "volume" else "volume"
    unit = "Pa" if other == "suction" else "m^3"
    if state.exists:
        tiles.append(_tile(other.capitalize(), show(float(getattr(state, other)), unit, 4), "", other))
    return "".join(tiles)


def _stability(answer: Answer) -> str:
    first = answer.lower_end
    return "" if first is None else f"begins at {show(float(first.separation), 'm', 4)}"


def _tile(name: str, value: str, note: str, role: str) -> str:
    return (
        f'<div class="tile {role}"><span class="name">{name}</span>'
        f'<output class="value">{_printed(value)}</output><span class="note">{note}</span></div>'
    )


def numbers(answer: Answer) -> str:
    """All fields of the bridge with their units and meanings."""
    more = {}
    if answer.rupture.exists:
        distance = show(float(answer.rupture.separation), "m")
        more["rupture distance"] = (distance, "separation at which the bridge breaks")
    rows = "".join(
        f'<tr><th scope="row">{name}<span class="meaning">{meaning}</span></th><td>{_parts(value)}</td></tr>'
        for name, value, meaning in state_rows(answer.state, more)
    )
    return f"<tbody>{rows}</tbody>"


def error_cells(answer: LawAnswer) -> str:
    """Errors of a law in force and rupture distance, and whether it is asked outside its range."""
    cells = "".join(
        f'<span class="error">{percent(error).removesuffix(" %")}</span>'
        for error in (answer.force_error, answer.rupture_error)
    )
    if not answer.outside:
        return cells
    return f'{cells}<span class="outside">{escape(_printed(answer.outside))}</span>'


def _parts(value: str) -> str:
    """Quantities of one row, none of them parted from its unit at the end of a line."""
    return ", ".join(f"<span>{_printed(part)}</span>" for part in value.split(", "))


def _printed(number: str) -> str:
    """Number with a minus sign of the length of a plus."""
    return number.replace("-", "\N{MINUS SIGN}")


def paragraphs(texts: Iterable[str]) -> str:
    """Texts one below the other."""
    return "".join(f"<p>{escape(text)}</p>" for text in texts)
