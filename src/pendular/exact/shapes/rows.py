"""The solver for solids of any shape over rows of questions: in plain Python, or by machine code on all threads.

A row of questions holds D, H or V, the size of the smaller solid, and of each solid its kind, its size, its half angle
and its contact angle, in one unit of length; profiles, if the solids have them, are the same for all rows.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import kernel
from ...ground.rows import Own, entry, over_rows
from ..answers import FAILED, FOUND
from ..equations import VOLUME
from ..follow import BRANCH_ENDS
from ..solids.surface import Profile
from ..state import State
from .answers import answer_to, curve_of
from .pieces import solid_from
from .search import Question, Room, room_for_found, room_for_nodes, room_for_starts

__all__ = ["COLUMNS", "answer", "draw"]

Rows = NDArray[np.float64]
Statuses = NDArray[np.int8]

COLUMNS = 11

CURVE = 4  # asked beside what `answers` knows
_CHUNK = 64  # bridges that one thread takes at a time


@kernel
def question_in(row: Rows, control: int, profile1: Profile, profile2: Profile) -> Question:
    """The question in a row."""
    value = float(row[1]) / math.pi if control == VOLUME else float(row[1])
    first = solid_from(int(row[3]), float(row[4]), float(row[5]), float(row[6]), profile1)
    second = solid_from(int(row[7]), float(row[8]), float(row[9]), float(row[10]), profile2)
    return Question(first, second, control, value, float(row[2]))


@entry(plain_cost=0.02, patience=15.0)
def shapes_range(
    asked: int, limit: int, control: int, questions: Rows, profile1: Profile, profile2: Profile,
    states: NDArray[np.float64], statuses: Statuses, nodes: Rows, found: Rows, starts: Rows, start: int, stop: int,
) -> None:  # fmt: skip
    """Answer the rows from start to stop, each by one bridge or, of a CURVE, by so many as there is room for.

    All is one entry, as nearly all of its code serves all that can be asked.
    """
    room = Room(nodes, found, starts)
    for i in range(start, stop):
        question = question_in(questions[i], control, profile1, profile2)
        if asked == CURVE:
            states[i] = math.nan
            curve_of(question, limit, room, states[i], statuses[i])
        else:
            statuses[i, 0] = answer_to(question, asked, float(questions[i, 0]), limit, room, states[i, 0])
        for k in range(statuses.shape[1]):
            if statuses[i, k] != FOUND:
                states[i, k, :] = math.nan


_ROOM = (Own(room_for_nodes), Own(room_for_found), Own(room_for_starts))


def answer(
    asked: int, control: int, questions: Rows, profiles: tuple[Profile, Profile], limit: int = BRANCH_ENDS
) -> tuple[Rows, Statuses]:
    """Answer rows of questions on all threads: their states and statuses."""
    states, statuses = _answered(asked, control, questions, profiles, limit, 1)
    return states[:, 0], statuses[:, 0]


def draw(
    control: int, questions: Rows, profiles: tuple[Profile, Profile], points: int, limit: int = BRANCH_ENDS
) -> tuple[NDArray[np.float64], Statuses]:
    """Whole curves for rows of questions, on all threads: (rows, points, fields), and the status of each point."""
    return _answered(CURVE, control, questions, profiles, limit, points)


def _answered(
    asked: int, control: int, questions: Rows, profiles: tuple[Profile, Profile], limit: int, points: int
) -> tuple[NDArray[np.float64], Statuses]:
    states = np.empty((len(questions), points, len(State._fields)))
    statuses = np.empty((len(questions), points), np.int8)
    asking = asked, limit, control, questions, *profiles, states, statuses, *_ROOM
    over_rows(shapes_range, len(states), 1 if asked == CURVE else _CHUNK, *asking, plainly=_plainly)
    return states, statuses


def _plainly(*asking: Any) -> None:
    """Answer the rows one by one in plain Python; where its arithmetic has no answer, as 1/0, the solver has failed."""
    *given, start, stop = asking
    states, statuses = given[6:8]
    for i in range(start, stop):
        try:
            shapes_range(*(*given, i, i + 1))
        except (ArithmeticError, ValueError):
            states[i], statuses[i] = math.nan, FAILED
