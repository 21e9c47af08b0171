"""The straight way to a bridge, or to rupture, for rows abreast, as many as a vector of the processor has lanes.

Nearly all rows are answered here; those for which anything is in doubt are left to `direct`, one by one. A room for
them holds a number of all lanes side by side: what is asked, where to start, and the arc that was found.
"""

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.lanes import choose, lanes, lanes_of, put_lanes
from .arc import LEAST_ROOM, NOWHERE, WIDEST_ETA, Arc, room_of
from .direct import ALL, start_of
from .equations import SUCTION, Held
from .fold import FEW_LOOKS, end_met
from .guess import arc_at_rupture, rupture_guess
from .locate import FOLD
from .search import are_alike
from .solids import Solid
from .suction import is_stable_at_suction, met_at_suction
from .volume import is_stable_at_volume, met_at_volume

Numbers = NDArray[np.float64]

_SEPARATION, _HELD, _FIRST, _SECOND, _ARC, _COUNT = 0, 1, 2, 6, 10, 14
ROOM_ABREAST = 8 * _COUNT  # for as many lanes as any processor has

_LEFT, _LEFT_OF_FORCE = 1e-14, 1e-12  # largest change that would follow
_NEXT_TO_RUPTURE = 0.98  # of the estimate, where to start
_FALL = 0.7  # of the slope along a curve, at a fold of which nothing is known
_ANY = Solid(1.0, 0.0, 1.0, 0.0)


@kernel
def ask_in_lane(room: Numbers, lane: int, separation: float, held: Held, near: Arc) -> None:
    """Ask for a bridge in a lane, from an arc near by, if its radius is above 0."""
    width = lanes()
    room[_SEPARATION * width + lane], room[_HELD * width + lane] = separation, held.value
    for j in range(4):
        room[(_FIRST + j) * width + lane] = held.first[j]
        room[(_SECOND + j) * width + lane] = held.second[j]
        room[(_ARC + j) * width + lane] = near[j]


@kernel
def ask_nothing(room: Numbers, lane: int, control: int) -> None:
    """Ask for any bridge in a lane, of which nobody wants to know."""
    ask_in_lane(room, lane, 0.0, Held(_ANY, _ANY, control, 0.1), Arc(0.1, 0.0, 0.1, 0.1))


@kernel
def asked_in_lane(room: Numbers, lane: int, control: int) -> tuple[float, Held]:
    """Separation and what is held in a lane."""
    width = lanes()
    first, second = _FIRST * width + lane, _SECOND * width + lane
    return room[_SEPARATION * width + lane], Held(
        Solid(room[first], room[first + width], room[first + 2 * width], room[first + 3 * width]),
        Solid(room[second], room[second + width], room[second + 2 * width], room[second + 3 * width]),
        control,
        room[_HELD * width + lane],
    )


@kernel
def found_in_lane(room: Numbers, lane: int) -> Arc:
    """The arc of the bridge in a lane, of radius 0 if it is left to others."""
    width = lanes()
    at = _ARC * width + lane
    return Arc(room[at], room[at + width], room[at + 2 * width], room[at + 3 * width])


@kernel
def _held_of(room: Numbers, control: int) -> Held:
    """What is held in all lanes."""
    width = lanes()
    first = Solid(
        lanes_of(room, _FIRST * width),
        lanes_of(room, (_FIRST + 1) * width),
        lanes_of(room, (_FIRST + 2) * width),
        lanes_of(room, (_FIRST + 3) * width),
    )
    second = Solid(
        lanes_of(room, _SECOND * width),
        lanes_of(room, (_SECOND + 1) * width),
        lanes_of(room, (_SECOND + 2) * width),
        lanes_of(room, (_SECOND + 3) * width),
    )
    return Held(first, second, control, lanes_of(room, _HELD * width))


@kernel
def _arc_of(room: Numbers) -> Arc:
    """The arc in all lanes."""
    width = lanes()
    return Arc(
        lanes_of(room, _ARC * width),
        lanes_of(room, (_ARC + 1) * width),
        lanes_of(room, (_ARC + 2) * width),
        lanes_of(room, (_ARC + 3) * width),
    )


@kernel
def answer_abreast(room: Numbers, control: int, wanted: int, is_near: bool) -> None:
    """Answer all lanes, from the closed guess or from an arc near by."""
    width, held = lanes(), _held_of(room, control)
    separation, left = lanes_of(room, _SEPARATION * width), _LEFT if wanted == ALL else _LEFT_OF_FORCE
    start = _arc_of(room) if is_near else start_of(held, separation, 1.0)
    if control == SUCTION:
        at_suction = met_at_suction(start, separation, held, left, is_near)
        _put(room, at_suction.arc, is_stable_at_suction(at_suction, held))
    else:
        at_volume = met_at_volume(start, separation, held, left, is_near)
        _put(room, at_volume.arc, is_stable_at_volume(at_volume, held))


@kernel
def ask_end_in_lane(room: Numbers, lane: int, held: Held) -> None:
    """Ask for the rupture in a lane, from about there."""
    if held.control == SUCTION:
        ask_in_lane(room, lane, _NEXT_TO_RUPTURE * rupture_guess(held), held, NOWHERE)
        return
    start, fall = arc_at_rupture(held)
    if not start.radius > 0.0:
        start, fall = start_of(held, _NEXT_TO_RUPTURE * rupture_guess(held), 1.0), _FALL
    ask_in_lane(room, lane, fall, held, start)


@kernel
def ask_no_end(room: Numbers, lane: int, control: int) -> None:
    """Ask for any rupture in a lane, of which nobody wants to know."""
    ask_end_in_lane(room, lane, Held(_ANY, _ANY, control, 0.1))


@kernel
def ends_abreast(room: Numbers, control: int) -> None:
    """Find the ruptures of all lanes."""
    width, held = lanes(), _held_of(room, control)
    told = lanes_of(room, _SEPARATION * width)
    start, fall = _arc_of(room), told
    if control == SUCTION:
        start, fall = start_of(held, told, 1.0), _FALL + 0.0 * told
    met = end_met(FOLD, start, fall, held, are_alike(held.first, held.second), FEW_LOOKS)
    _put(room, met.arc, met.is_met & (abs(met.arc.eta) < WIDEST_ETA) & (room_of(met.arc) > LEAST_ROOM))


@kernel
def _put(room: Numbers, arc: Arc, is_found: bool) -> None:
    width = lanes()
    put_lanes(room, _ARC * width, choose(is_found, arc.radius, NOWHERE.radius))
    put_lanes(room, (_ARC + 1) * width, arc.slope)
    put_lanes(room, (_ARC + 2) * width, arc.half_width)
    put_lanes(room, (_ARC + 3) * width, arc.eta)


@kernel
def cosines_in_lane(room: Numbers, lane: int) -> tuple[float, float]:
    """Cosines of both contact angles in a lane."""
    width = lanes()
    return room[(_FIRST + 2) * width + lane], room[(_SECOND + 2) * width + lane]
