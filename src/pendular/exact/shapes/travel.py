"""Following the bridges that hold one thing from piece to piece of their solids, along their tangent.

On each pair of pieces the curve is smooth, and is followed as that between spheres is. Where a contact circle comes to
the end of its piece, the curve goes on, with a corner, on the next: there too the separation turns where, and only
where, the number of unstable directions changes by one, or an antisymmetric direction becomes unstable.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.root import root_between
from ..algebra import Four, moved, unit_vector
from ..curve import Curve, Stance, corrected, stance_after, stance_at
from ..equations import VOLUME
from ..follow import FOLDS, NOTHING, Walk, beyond, follow
from ..locate import ARRIVED, FOLD, LOST, PITCHFORK
from ..solids.edge import Side
from .retold import retold
from .search import Found, Indices, Question, curve_through, held_on, is_symmetric, pieces_on, rooms_at

Nodes = NDArray[np.float64]

OFF = 5  # event: a contact circle runs off the last piece of its solid

_MOST_NODES = 1200
_MOST_PIECES = 12
_THERE = 1e-13  # miss of a separation, over ℓ, that is none
_PROBE = 1e-4  # way from a corner to where it is certain what follows
_AT_CORNER = 1e-9  # room that is none
_PAST = -1e-9  # room that is lost for certain


class Leg(NamedTuple):
    """A stretch of a journey on one pair of pieces."""

    on: Indices
    curve: Curve
    nodes: Nodes


class Journey(NamedTuple):
    """A way along a curve, and where it ended."""

    legs: list[Leg]
    event: int
    stance: Stance
    curve: Curve
    on: Indices
    going: float  # sign of the slope before the end
    is_corner: bool  # whether it ended at a corner
    ahead: tuple[Stance, Curve, Indices] | None  # at a corner: what lies behind it


def set_out(question: Question, found: Found, going: float) -> tuple[Stance, Curve]:
    """A bridge, and the curve through it followed so that the separation grows (going > 0) or falls at first."""
    curve = curve_through(question, found)
    stance = retold(stance_at)(found.z, curve)
    if stance.slope * going < 0.0:
        curve = Curve(curve.held, curve.symmetric, -1.0)
        stance = retold(stance_at)(found.z, curve)
    return stance, curve


def travel(question: Question, start: tuple[Stance, Curve, Indices], target: float, stops_at: int) -> Journey:
    """Follow a curve until D meets its target, or what it stops at, or it ends."""
    stance, curve, on = start
    if abs(stance.separation - target) <= _THERE * math.exp(stance.z.log_length):
        return Journey([], ARRIVED, stance, curve, on, 1.0, False, None)
    legs: list[Leg] = []
    for _ in range(_MOST_PIECES):
        nodes = np.empty((_MOST_NODES, 4))
        walk = retold(follow)(stance, curve, target, stops_at, nodes)
        cut = _first_off(question, on, nodes[: walk.nodes])
        if cut is None:
            legs.append(Leg(on, curve, nodes[: walk.nodes]))
            return Journey(legs, walk.event, walk.stance, walk.curve, on, walk.going, False, None)
        before, after = _four(nodes[cut - 1]), _four(nodes[cut])
        z = _corner(question, on, before, after, curve)
        nodes[cut] = z
        legs.append(Leg(on, curve, nodes[: cut + 1]))
        last = _just_before(z, curve)
        turned = _round_corner(question, on, last, curve)
        if turned is None or turned[0] == LOST:
            return Journey(legs, OFF if turned is None else LOST, last, curve, on, _sign(last.slope), True, None)
        event, onward = turned
        if event != ARRIVED and stops_at != NOTHING and (stops_at != FOLDS or event == FOLD):
            return Journey(legs, event, last, curve, on, _sign(last.slope), True, onward)
        stance, curve, on = onward
    return Journey(legs, LOST, stance, curve, on, 1.0, False, None)


def go_beyond(question: Question, journey: Journey) -> tuple[Stance, Curve, Indices]:
    """Where a curve goes on after the end of a branch."""
    if journey.ahead is not None:
        return journey.ahead
    walk = Walk(journey.event, journey.stance, journey.curve, 0, journey.going)
    stance, curve = retold(beyond)(walk)
    return stance, curve, journey.on


def _sign(value: float) -> float:
    return 1.0 if value > 0.0 else -1.0


def _four(row: Nodes) -> Four:
    return Four(*row.tolist())


def _first_off(question: Question, on: Indices, nodes: Nodes) -> int | None:
    """The first of the nodes, after that at the start, with a contact circle that lies past the end of its piece."""
    if all(math.isinf(room) for room in rooms_at(question, on, _four(nodes[0]))):
        return None
    for i in range(1, len(nodes)):
        if min(rooms_at(question, on, _four(nodes[i]))) < _PAST:
            return i
    return None


def _corner(question: Question, on: Indices, before: Four, after: Four, curve: Curve) -> Four:
    """The bridge between two others at which a contact circle comes to the end of its piece."""
    way = moved(after, -1.0, before)
    along = unit_vector(way)

    def at(share: float) -> Four:
        z: Four = retold(corrected)(moved(before, share, way), curve, along)[0]
        return z

    def room(share: float) -> float:
        return min(rooms_at(question, on, at(share)))

    if room(0.0) <= 0.0:
        return before
    return at(root_between(room, 0.0, 1.0, 1e-14))


def _just_before(z: Four, curve: Curve) -> Stance:
    """The bridge at a corner, with the slope and the stability that the way to it has."""
    stance: Stance = retold(stance_at)(z, curve)
    near: Stance = retold(stance_after)(stance, -_PROBE, curve)[0]
    return Stance(z, stance.tangent, stance.separation, near.slope, near.unstable, near.margin, stance.opening)


def _round_corner(
    question: Question, on: Indices, last: Stance, curve: Curve
) -> tuple[int, tuple[Stance, Curve, Indices]] | None:
    """What happens at a corner, and the bridge there as the first on the pieces that follow; None if none do."""
    rooms = rooms_at(question, on, last.z)
    shift = [0, 0]
    for solid in range(2):
        inner, outer = rooms[2 * solid], rooms[2 * solid + 1]
        if min(inner, outer) < _AT_CORNER:
            shift[solid] = -1 if inner < outer else 1
    best = None
    for one, other in ((1, 1),) if curve.symmetric else ((1, 0), (0, 1), (1, 1)):
        after = on[0] + one * shift[0], on[1] + other * shift[1]
        if after == on or not _is_answered(question, after):
            continue
        onward = _onward(question, after, last.z, curve.symmetric)
        if onward is None:
            continue
        event = _event_between(last, onward[0], curve)
        if event == ARRIVED:
            return event, onward
        if best is None or best[0] == LOST:
            best = event, onward
    return best


def _is_answered(question: Question, on: Indices) -> bool:
    """Whether there are two such pieces, of which one at most is the side of a cylinder, and that at a volume."""
    if not (0 <= on[0] < len(question.first) and 0 <= on[1] < len(question.second)):
        return False
    sides = sum(isinstance(piece.surface, Side) for piece in pieces_on(question, on))
    return sides == 0 or (sides == 1 and question.control == VOLUME)


def _onward(question: Question, after: Indices, z: Four, symmetric: bool) -> tuple[Stance, Curve, Indices] | None:
    """The bridge at a corner on the pieces that follow, and the way on which both circles lie on them."""
    symmetric = symmetric or is_symmetric(question, Found(z, after))
    for hand in (1.0, -1.0):
        curve = Curve(held_on(question, after), symmetric, hand)
        stance: Stance = retold(stance_at)(z, curve)
        probe, is_met = retold(stance_after)(stance, _PROBE, curve)
        if is_met and min(rooms_at(question, after, probe.z)) > 0.0:
            seen = Stance(
                z, stance.tangent, stance.separation, probe.slope, probe.unstable, probe.margin, stance.opening
            )
            return seen, curve, after
    return None


def _event_between(before: Stance, after: Stance, curve: Curve) -> int:
    """What happens at a corner: ARRIVED if nothing does."""
    changes = abs(after.unstable - before.unstable)
    if before.slope * after.slope < 0.0:
        return FOLD if changes == 1 or (curve.symmetric and changes in (0, 2)) else LOST
    if changes == 0:
        return ARRIVED
    return PITCHFORK if changes == 1 and curve.symmetric else LOST
