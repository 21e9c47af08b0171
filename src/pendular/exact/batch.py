"""The exact solver over arrays: the only door for many questions at once.

A row of ``questions`` is a :class:`Task` without its control: D, H or V, k1, θ1, k2, θ2; a row of ``states`` holds the
fields of :class:`State`.
"""

import math

import numpy as np
from numpy.typing import NDArray

from .._jit import in_chunks, kernel
from .answers import (
    FAILED,
    FOUND,
    LOWER_END,
    NO_BRIDGE,
    RUPTURE,
    STABLE,
    STIFFNESS,
    UNSTABLE,
    answer_to,
    directly_stored,
    holds_nothing,
    store_end,
)
from .equations import SUCTION, VOLUME
from .filling import MOST_FOUND, SEVERAL, Filling, store_filling
from .follow import BRANCH_ENDS, FOLD
from .morph import Task
from .nucleus import nucleus_stored
from .search import are_planes
from .state import State
from .tracing import trace

__all__ = [
    "FAILED",
    "FOUND",
    "LOWER_END",
    "NO_BRIDGE",
    "RUPTURE",
    "SEVERAL",
    "STABLE",
    "UNSTABLE",
    "answer",
    "answer_filling",
    "draw",
]

Rows = NDArray[np.float64]
Statuses = NDArray[np.int8]

_MOST_NODES = 1200
_CHUNK = 1024  # bridges that one thread takes at a time: some milliseconds, against which its start is nothing


@kernel
def task_of(row: Rows, control: int) -> Task:
    """The task in a row of questions."""
    value = float(row[1]) / math.pi if control == VOLUME else float(row[1])
    return Task(float(row[0]), value, float(row[2]), float(row[3]), float(row[4]), float(row[5]), control)


@kernel
def bridge_range(
    asked: int, limit: int, control: int, questions: Rows, states: Rows, statuses: Statuses, start: int, stop: int
) -> None:
    """Answer the rows from start to stop."""
    nodes = np.empty((0, 4))
    for i in range(start, stop):
        task = task_of(questions[i], control)
        status = NO_BRIDGE
        if control == SUCTION and are_planes(task):
            if asked == UNSTABLE:
                status = nucleus_stored(task, states[i])
        elif not holds_nothing(task):
            status = directly_stored(task, states[i]) if asked == STABLE else FAILED
            if status != FOUND:
                end = answer_to(asked, limit, task, nodes)
                status = end.status
                if status == FOUND:
                    status = store_end(end, states[i])
                    if end.event == FOLD:
                        states[i, STIFFNESS] = math.inf if asked == LOWER_END else -math.inf
                elif status == FAILED and control == SUCTION and task.value < 0.0:
                    status = NO_BRIDGE  # under pressure most pairs hold no bridge; one that exists is found
        statuses[i] = status
        if status != FOUND:
            states[i, :] = math.nan


def answer(asked: int, control: int, questions: Rows, limit: int = BRANCH_ENDS) -> tuple[Rows, Statuses]:
    """Answer rows of questions on all threads: their states and statuses."""
    count = len(questions)
    states, statuses = np.empty((count, len(State._fields))), np.empty(count, np.int8)
    in_chunks(bridge_range, count, _CHUNK, asked, limit, control, questions, states, statuses)
    return states, statuses


@kernel
def curve_range(
    limit: int,
    control: int,
    questions: Rows,
    states: NDArray[np.float64],
    statuses: Statuses,
    start: int,
    stop: int,
) -> None:
    """Whole curves for the rows from start to stop; ``states`` has an axis of points before that of the fields."""
    nodes = np.empty((_MOST_NODES, 4))
    for i in range(start, stop):
        task = task_of(questions[i], control)
        status = NO_BRIDGE if holds_nothing(task) else trace(limit, task, states[i], nodes)
        if status == FAILED and control == SUCTION and task.value < 0.0:
            status = NO_BRIDGE
        statuses[i] = status
        if status != FOUND:
            states[i] = math.nan


def draw(control: int, questions: Rows, points: int, limit: int = BRANCH_ENDS) -> tuple[NDArray[np.float64], Statuses]:
    """Whole curves for rows of questions, on all threads: (rows, points, fields), and the status of each point."""
    count = len(questions)
    states, statuses = np.empty((count, points, len(State._fields))), np.empty(count, np.int8)
    in_chunks(curve_range, count, 1, limit, control, questions, states, statuses)
    each = np.repeat(statuses[:, None], points, axis=1)
    each[(each == FOUND) & np.isnan(states[..., 0])] = NO_BRIDGE
    return states, each


@kernel
def filling_range(
    asked: int,
    limit: int,
    control: int,
    solid: int,
    angles: NDArray[np.float64],
    questions: Rows,
    states: Rows,
    separations: Rows,
    statuses: Statuses,
    start: int,
    stop: int,
) -> None:
    """Bridges that have a half-filling angle, for the rows from start to stop."""
    nodes, found = np.empty((_MOST_NODES, 4)), np.empty((MOST_FOUND, 4))
    for i in range(start, stop):
        task, angle = task_of(questions[i], control), float(angles[i])
        status = NO_BRIDGE
        if not holds_nothing(task):
            filling = Filling(solid, angle, math.sin(angle), math.cos(angle))
            status = store_filling(asked, limit, task, filling, nodes, found, states[i], separations[i])
            if status == FAILED and control == SUCTION and task.value < 0.0:
                status = NO_BRIDGE
        statuses[i] = status
        if status != FOUND:
            states[i, :] = math.nan


def answer_filling(
    asked: int, control: int, solid: int, angles: NDArray[np.float64], questions: Rows, limit: int = BRANCH_ENDS
) -> tuple[Rows, Statuses, Rows]:
    """Bridges that have a half-filling angle on a solid, 0 or 1: their states and statuses.

    The separation in a row of questions is NaN, or near to that of the bridge that is meant. The separations of all
    bridges with the angle are the third result; where there are several and none is meant, the status is SEVERAL.
    """
    count = len(questions)
    states, statuses = np.empty((count, len(State._fields))), np.empty(count, np.int8)
    separations = np.full((count, MOST_FOUND), math.nan)
    in_chunks(filling_range, count, 16, asked, limit, control, solid, angles, questions, states, separations, statuses)
    return states, statuses, separations
