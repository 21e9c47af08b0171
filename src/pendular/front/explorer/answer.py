"""What the library says to the question of a view: all that the page shows."""

import math
import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ask.by_law import RangeWarning
from ...ask.face import Bridge, ConvergenceWarning, bridge, curve, rupture
from ...ask.liquid import KelvinWarning
from ...comparison.words import limit_words, variable_words
from ...ground.units import read
from ...laws import Law, laws
from ..options import Question
from .view import View, question

__all__ = ["Answer", "LawAnswer", "answer_to"]

Floats = NDArray[np.float64]

_CURVE_POINTS, _LAW_POINTS = 121, 121  # enough to look smooth at the width of a screen
_OTHER_POINTS = 41  # of a law of the other control, which needs an exact bridge for each
_BEYOND = 1.3  # over the exact rupture distance: where a law that knows none is drawn to


class LawAnswer(NamedTuple):
    """What a law says at the state of a view, beside the exact answer."""

    law: Law
    force_error: float  # relative, -1 where the law has no bridge; NaN where either says nothing
    rupture_error: float
    outside: str  # why the law is not meant for this state; empty if it is
    separation: Floats  # its curve, [m]; empty unless it is wanted
    force: Floats  # [N], NaN where it says nothing


class Answer(NamedTuple):
    """A view, and the bridges that it asks for."""

    view: View
    question: Question
    separation: float  # [m]
    state: Bridge
    curve: Bridge
    rupture: Bridge
    lower_end: Bridge | None
    laws: tuple[LawAnswer, ...]
    notices: tuple[str, ...]  # warnings of the library


def answer_to(view: View) -> Answer:
    """Ask the library what a view shows; ValueError in one line for what cannot be meant."""
    asked = question(view)
    gap = read("separation", view.separation, "m", "3um")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("ignore")
        for category in (KelvinWarning, ConvergenceWarning):
            warnings.simplefilter("always", category)
        state, end = asked.put_to(bridge, gap), asked.put_to(rupture)
        states = asked.put_to(curve, points=_CURVE_POINTS)
        first = asked.lower_end() if end.exists else None
    notices = tuple(dict.fromkeys(str(warning.message) for warning in caught))
    lawful = tuple(_ask_law(law, view, asked, state, end) for law in laws.values())
    return Answer(view, asked, gap, state, states, end, first, lawful, notices)


def _ask_law(law: Law, view: View, asked: Question, state: Bridge, end: Bridge) -> LawAnswer:
    """Errors of a law at a state, and its curve if it is to be drawn."""
    force_error = rupture_error = last = math.nan
    separation = force = np.empty(0)
    refusals: list[str] = []

    def say(function: Callable[..., Bridge], *gap: Any) -> Bridge | None:
        try:
            return asked.put_to(function, *gap, method=law.name)
        except ValueError as refusal:  # of the law: the exact solver has answered the same question
            refusals.append(str(refusal))
            return None

    is_own = (law.control == "volume") == (view.control == "volume")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        if "force" in law.gives and state.exists and (said := say(bridge, state.separation)):
            force_error = _relative(said.force, state.force)
        if "rupture" in law.gives and is_own and (said := say(rupture)):
            last = float(said.separation)
            rupture_error = _relative(last, end.separation) if end.exists else math.nan
        outside = refusals[0] if refusals else _outside(law, caught)  # the state; its curve may well leave the range
        if "force" in law.gives and law.name in view.laws:
            reach = last if last > 0.0 else float(end.separation) * (_BEYOND if is_own else 1.0)
            if math.isfinite(reach):
                # Dense towards rupture, where forces are steep.
                gaps = reach * np.sin(np.linspace(0.0, 0.5 * math.pi, _LAW_POINTS if is_own else _OTHER_POINTS))
                if drawn := say(bridge, gaps):
                    separation, force = gaps, np.where(drawn.exists, drawn.force, np.nan)
    return LawAnswer(law, force_error, rupture_error, outside, separation, force)


def _outside(law: Law, caught: list[warnings.WarningMessage]) -> str:
    """What leaves the range of a law by the warnings it gave, in words."""
    for warning in caught:
        if isinstance(warning.message, RangeWarning):
            if warning.message.outside is None:
                return str(warning.message).removeprefix(f"{law.name}: ")
            name, value, low, high = warning.message.outside
            limits = limit_words(name, low, high).replace(">=", "≥")
            return f"{variable_words(name, value)}; the law is for {limits}"
    return ""


def _relative(value: Any, exact: Any) -> float:
    """(value - exact)/exact."""
    return float(value) / float(exact) - 1.0 if exact else math.nan
