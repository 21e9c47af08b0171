"""Rupture in algebraic numbers: leaps from a bridge next to it to where the separation is largest, proven and stored.

What is not beyond doubt is left to the rest of the solver.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .arc import NOWHERE, Arc, is_fit
from .direct import all_stored, start_of
from .equations import Held
from .fold import end_met
from .follow import BRANCH_ENDS
from .guess import rupture_guess
from .locate import FOLD, LOST, PITCHFORK
from .state import STIFFNESS

Rows = NDArray[np.float64]

_SHARES = (0.85, 0.64, 0.48, 0.36)  # of the estimate, where to start
_MOST_LOOKS = 40
_FALL = 1.0  # of what vanishes at an end of which nothing is known


@kernel
def summit_of(held: Held, symmetric: bool, stops_at: int) -> tuple[Arc, int]:
    """The end of the stable branch, and whether it is a FOLD or a PITCHFORK beyond doubt; else LOST."""
    estimate = rupture_guess(held)
    for share in _SHARES:
        start = start_of(held, share * estimate, 1.0)
        met, event = end_met(FOLD, start, _FALL, held, symmetric, _MOST_LOOKS), FOLD
        if met.has_forked:
            if stops_at != BRANCH_ENDS:
                break
            met, event = end_met(PITCHFORK, start, _FALL, held, symmetric, _MOST_LOOKS), PITCHFORK
        if met.is_met and is_fit(met.arc):
            return met.arc, event
    return NOWHERE, LOST


@kernel
def summit_stored(held: Held, symmetric: bool, stops_at: int, row: Rows) -> bool:
    """Store the bridge at rupture, where that is beyond doubt."""
    arc, event = summit_of(held, symmetric, stops_at)
    return event != LOST and end_stored(arc, event, held, symmetric, row)


@kernel
def end_stored(arc: Arc, event: int, held: Held, symmetric: bool, row: Rows) -> bool:
    """Store a bridge at rupture; at a fold the force falls infinitely fast."""
    if not all_stored(arc, held, symmetric, True, row):
        return False
    if event == FOLD:
        row[STIFFNESS] = -math.inf
    return True
