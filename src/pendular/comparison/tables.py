"""Laws and their errors as tables for people."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from ..laws import Law, Variable
from .error_maps import ErrorMap
from .measured import FRACTIONS, MeasuredErrors, measured_errors
from .one_pair import MARKS, UP_TO, Comparison, LawAnswer
from .recommendation import Recommendation
from .words import SYMBOLS, limit_words, number, percent, range_words, size_words

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table

__all__ = [
    "NOT_MEASURED",
    "comparison_table",
    "law_page",
    "laws_table",
    "map_table",
    "recommendation_table",
    "sample_words",
]

NOT_MEASURED = "no error is measured: the law says nothing of bridges at rest, at the points of the grid in its range"

_FACTS = ("valid_text", "angle_rule", "size_rule", "reference", "doi", "equations", "provenance")
_SHORT = {"force": "F", "rupture": "D_c", "rupture_work": "W", "damping": "c"}
_NAMES = {"valid_text": "range", "angle_rule": "two angles", "size_rule": "two sizes", "doi": "DOI"}


def laws_table(laws: Iterable[Law]) -> RenderableType:
    """All laws: what each gives, its range, and its largest error between equal spheres in it."""
    from rich.console import Group

    table = _table(
        "law", "control", "gives", "largest\nforce", "error of\nrupture", "the\nwork", "range", right=(3, 4, 5)
    )
    for law in laws:
        largest = (percent(float(error), signed=False) for error in measured_errors(law).of_equal_spheres.largest)
        table.add_row(
            law.name, law.control, ", ".join(given.replace("_", " ") for given in law.gives), *largest, law.valid_text
        )
    note = (
        "errors: the largest between equal spheres at the points of a grid in that range, its ends included, of the "
        f"force from contact to {UP_TO} of rupture"
    )
    return Group(table, "", note)


def law_page(law: Law) -> RenderableType:
    """All that is known of one law."""
    from rich.console import Group
    from rich.padding import Padding

    facts = _table("", "", head=False)
    facts.add_row("control", law.control)
    facts.add_row("gives", ", ".join(given.replace("_", " ") for given in law.gives))
    for name in _FACTS:
        if getattr(law, name):
            facts.add_row(_NAMES.get(name, name), getattr(law, name))
    for erratum in law.errata:
        facts.add_row("erratum", erratum)
    variables = _table("variable", "unit", "limits", "range", "meaning")
    for variable in law.variables:
        variables.add_row(*_variable_row(law, variable))
    measured = measured_errors(law)
    errors = _error_table(measured) if measured.control_star.size else NOT_MEASURED
    parts: list[Any] = [Padding(law.formula, (0, 0, 0, 2)), "", facts, "", variables, "", errors]
    if np.any(measured.smaller_over_larger != 1.0):
        parts += ["", _size_table(law, measured)]
    return Group(*parts)


def _variable_row(law: Law, variable: Variable) -> tuple[str, ...]:
    stated = law.valid.get(variable.name)
    limits = limit_words(variable.name, variable.low, variable.high)
    valid = limit_words(variable.name, *stated) if stated else ""
    return variable.name, "°" if variable.unit == "rad" else variable.unit, limits, valid, variable.text


def _error_table(measured: MeasuredErrors) -> Table:
    """Errors between equal spheres, a row a pair."""
    has_work = bool(np.any(~np.isnan(measured.errors.rupture_work)))
    heads = [SYMBOLS[measured.control], "angle", *(f"F at {part:g} D_c" for part in FRACTIONS), "D_c"]
    table = _table(*heads, *(["W"] if has_work else []), right=range(10))
    for i in np.flatnonzero(measured.smaller_over_larger == 1.0):
        errors = [*measured.errors.force[i], measured.errors.rupture[i], measured.errors.rupture_work[i]]
        shown = (percent(float(error)) for error in (errors if has_work else errors[:-1]))
        table.add_row(number(measured.control_star[i]), f"{measured.contact_angle[i]:g}°", *shown)
    return table


def _size_table(law: Law, measured: MeasuredErrors) -> Table:
    """Largest errors over all angles, for each pair of sizes."""
    ratios = list(dict.fromkeys(measured.smaller_over_larger.tolist()))
    table = _table(
        f"largest, {', '.join(_SHORT[given] for given in law.gives)}",
        *(size_words(ratio) for ratio in ratios),
        right=range(1, 4),
    )
    for control in dict.fromkeys(measured.control_star.tolist()):
        cells = []
        for ratio in ratios:
            chosen = (measured.control_star == control) & (measured.smaller_over_larger == ratio)
            largest = (float(error) for error in measured.chosen(chosen).largest)
            cells.append(", ".join(percent(error, signed=False) for error in largest if not np.isnan(error)) or "–")
        table.add_row(f"{SYMBOLS[measured.control]} = {number(control)}", *cells)
    return table


def comparison_table(comparison: Comparison) -> RenderableType:
    """Errors of all laws for one pair."""
    from rich.console import Group

    works = any(not np.isnan(answer.rupture_work_error) for answer in comparison.laws)
    heads = ["law", "at contact", *(f"at {mark:g} D_c" for mark in MARKS[1:]), f"largest to {UP_TO:g}", "rupture D_c"]
    table = _table(*heads, *(["work"] if works else []), "remarks", right=range(1, 6 + works))
    for i, answer in enumerate(comparison.laws):
        if answer.converted and not comparison.laws[i - 1].converted:
            table.add_section()
        errors = [*map(percent, answer.error_at_marks), percent(answer.largest_error, signed=False)]
        errors += [percent(answer.rupture_error), *([percent(answer.rupture_work_error)] if works else [])]
        table.add_row(answer.name, *errors, _remarks(answer, comparison), style="dim" if answer.converted else None)
    refused = [f"not asked: {name}, {reason}" for name, reason in comparison.refused.items()]
    note = "errors of the force at parts of the exact rupture distance D_c, and of the rupture distance"
    return Group(table, "", note, *refused)


def _remarks(answer: LawAnswer, comparison: Comparison) -> str:
    other = "volume" if comparison.control == "suction" else "suction"
    remarks = [f"by exact {other}"] if answer.converted else []
    judged = comparison.fraction[answer.judged & ~np.isnan(answer.error)]
    if judged.size and 0.0 < judged[-1] < UP_TO:
        remarks.append(f"to {judged[-1]:.2f} D_c")
    if answer.outside:
        remarks.append(answer.outside)
    return "; ".join(remarks)


def map_table(found: ErrorMap) -> Table:
    """Errors at about every tenth degree and at the decades of the control."""
    decades = np.unique(np.round(np.log10(found.control_star)))
    columns = [int(np.argmin(np.abs(np.log10(found.control_star) - decade))) for decade in decades]
    tens = np.unique(np.round(np.degrees(found.contact_angle) / 10.0))
    rows = [int(np.argmin(np.abs(np.degrees(found.contact_angle) - 10.0 * ten))) for ten in tens]
    heads = (f"{SYMBOLS[found.control]} = {number(found.control_star[i])}" for i in columns)
    table = _table("angle", *heads, right=range(len(columns) + 1))
    for j in rows:
        angle = f"{np.degrees(found.contact_angle[j]):.3g}°"
        table.add_row(angle, *(percent(float(found.error[i, j])) for i in columns))
    return table


def recommendation_table(found: Recommendation) -> RenderableType:
    """Laws in their order, and the sample on which they were judged."""
    from rich.console import Group

    table = _table("", "law", "largest error", "at", "rupture D_c", right=(0, 2, 4))
    for place, law in enumerate(found.ranked, 1):
        where = (
            f"{SYMBOLS[found.control]} = {number(law.control_star)}, θ = {np.degrees(law.contact_angle):.3g}°, "
            f"{size_words(1.0 / law.size_ratio)}, {law.fraction:.3g} D_c"
        )
        error = percent(law.largest_error, signed=False)
        table.add_row(f"{place}.", law.name, error, where, percent(law.rupture_error, signed=False))
    best = f"best: {found.ranked[0].name}" if found.ranked else "no law is fit for all of this range"
    out = [f"not fit: {name}, {reason}" for name, reason in found.disqualified.items()]
    return Group(best, "", table, *([""] if out else []), *out)


def sample_words(found: Recommendation) -> str:
    """On how many bridges the laws were judged, and where."""
    symbol = SYMBOLS[found.control]
    parts = [
        f"{found.control_star.size} values of {symbol} ({range_words(found.control_star[0], found.control_star[-1])})",
        f"{found.contact_angle.size} of the contact angle ({range_words(*np.degrees(found.contact_angle[[0, -1]]))}°)",
        f"{found.size_ratio.size} of the size ratio ({range_words(found.size_ratio[0], found.size_ratio[-1])})",
        f"{found.fraction.size} of the separation (to {found.fraction[-1]:g} of the rupture distance D_c)",
    ]
    return f"computed on {found.bridges} exact bridges: {', '.join(parts)}"


def _table(*heads: str, right: Iterable[int] = (), head: bool = True) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), show_header=head, header_style="bold")
    chosen = set(right)
    for i, name in enumerate(heads):
        is_words = name in ("", "range", "remarks", "meaning")
        table.add_column(name, justify="right" if i in chosen else "left", no_wrap=not is_words)
    return table
