"""The solver for solids of any shape over rows of questions: in plain Python, or by machine code on all threads.

A row of questions holds D, H or V, the size of the smaller solid, and of each solid its kind, its size, its half angle
and its contact angle, in one unit of length; profiles, if the solids have them, are the same for all rows.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import kernel
from ...ground.rows import Own, entry, over_rows
from ..answers import FAILED, FOUND, STABLE
from ..equations import VOLUME
from ..follow import BRANCH_ENDS
from ..solids.surface import Profile
from ..state import State
from .answers import answer_to, curve_of, found_straight
from .pieces import solid_from
from .search import Question, Room, room_for_found, room_for_nodes, room_for_starts

__all__ = ["COLUMNS", "answer", "draw"]

Rows = NDArray[np.float64]
Statuses = NDArray[np.int8]

COLUMNS = 11

_OPEN = -1  # status of a row that a part of the solver leaves to the whole of it
_CHUNK = 64  # bridges that one thread takes at a time


@kernel
def question_in(row: Rows, control: int, profile1: Profile, profile2: Profile) -> Question:
    """The question in a row."""
    value = float(row[1]) / math.pi if control == VOLUME else float(row[1])
    first = solid_from(int(row[3]), float(row[4]), float(row[5]), float(row[6]), profile1)
    second = solid_from(int(row[7]), float(row[8]), float(row[9]), float(row[10]), profile2)
    return Question(first, second, control, value, float(row[2]))


@entry(plain_cost=4e-3, patience=12.0)
def stable_shapes_range(
    control: int, questions: Rows, profile1: Profile, profile2: Profile, states: Rows, statuses: Statuses,
    nodes: Rows, found: Rows, starts: Rows, start: int, stop: int,
) -> None:  # fmt: skip
    """Stable bridges of the rows to which starts lead at once; others stay open."""
    room = Room(nodes, found, starts)
    for i in range(start, stop):
        question = question_in(questions[i], control, profile1, profile2)
        status = found_straight(question, float(questions[i, 0]), room, states[i])
        statuses[i] = _OPEN if status == FAILED else status
        if status != FOUND:
            states[i, :] = math.nan


@entry(plain_cost=0.02, patience=15.0)
def shapes_range(
    asked: int, limit: int, control: int, questions: Rows, profile1: Profile, profile2: Profile, states: Rows,
    statuses: Statuses, nodes: Rows, found: Rows, starts: Rows, start: int, stop: int,
) -> None:  # fmt: skip
    """Answer the rows from start to stop."""
    room = Room(nodes, found, starts)
    for i in range(start, stop):
        question = question_in(questions[i], control, profile1, profile2)
        status = answer_to(question, asked, float(questions[i, 0]), limit, room, states[i])
        statuses[i] = status
        if status != FOUND:
            states[i, :] = math.nan


@entry(plain_cost=0.15, patience=15.0)
def shape_curves_range(
    limit: int, control: int, questions: Rows, profile1: Profile, profile2: Profile, states: NDArray[np.float64],
    statuses: NDArray[np.int8], nodes: Rows, found: Rows, starts: Rows, start: int, stop: int,
) -> None:  # fmt: skip
    """Whole curves for the rows from start to stop; states and statuses have an axis of points more."""
    room = Room(nodes, found, starts)
    for i in range(start, stop):
        states[i] = math.nan
        curve_of(question_in(questions[i], control, profile1, profile2), limit, room, states[i], statuses[i])
        for k in range(statuses.shape[1]):
            if statuses[i, k] != FOUND:
                states[i, k, :] = math.nan


_ROOM = (Own(room_for_nodes), Own(room_for_found), Own(room_for_starts))


def answer(
    asked: int, control: int, questions: Rows, profiles: tuple[Profile, Profile], limit: int = BRANCH_ENDS
) -> tuple[Rows, Statuses]:
    """Answer rows of questions on all threads: their states and statuses."""
    states, statuses = np.empty((len(questions), len(State._fields))), np.full(len(questions), _OPEN, np.int8)
    if asked == STABLE:
        _over(stable_shapes_range, (control, questions, *profiles), states, statuses)
    rows = np.flatnonzero(statuses == _OPEN)
    if rows.size:
        part = np.empty((rows.size, states.shape[1])), np.empty(rows.size, np.int8)
        _over(shapes_range, (asked, limit, control, questions[rows], *profiles), *part)
        states[rows], statuses[rows] = part
    return states, statuses


def draw(
    control: int, questions: Rows, profiles: tuple[Profile, Profile], points: int, limit: int = BRANCH_ENDS
) -> tuple[NDArray[np.float64], Statuses]:
    """Whole curves for rows of questions, on all threads: (rows, points, fields), and the status of each point."""
    states = np.empty((len(questions), points, len(State._fields)))
    statuses = np.empty((len(questions), points), np.int8)
    _over(shape_curves_range, (limit, control, questions, *profiles), states, statuses)
    return states, statuses


def _over(function: Callable[..., None], given: tuple[Any, ...], states: Rows, statuses: Statuses) -> None:
    chunk = 1 if states.ndim > 2 else _CHUNK
    plainly = partial(_plainly, function, states, statuses)
    over_rows(function, len(states), chunk, *given, states, statuses, *_ROOM, plainly=plainly)


def _plainly(function: Callable[..., None], states: Rows, statuses: Statuses, *asking: Any) -> None:
    """Answer the rows one by one in plain Python; where its arithmetic has no answer, as 1/0, the solver has failed."""
    for i in range(len(statuses)):
        try:
            function(*asking[:-2], i, i + 1)
        except (ArithmeticError, ValueError):
            states[i], statuses[i] = math.nan, _OPEN if function is stable_shapes_range else FAILED
