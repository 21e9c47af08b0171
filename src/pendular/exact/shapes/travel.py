"""Following the bridges that hold one thing from piece to piece of their solids, along their tangent.

On each pair of pieces the curve is smooth, and is followed as that between spheres is. Where a contact circle comes to
the end of its piece, the curve goes on, with a corner, on the next: there too the separation turns where, and only
where, the number of unstable directions changes by one, or an antisymmetric direction becomes unstable.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import kernel
from .. import curve, follow
from ..algebra import Four, moved, unit_vector
from ..bracket import MOST_NARROWINGS, Bracket, is_narrow, narrowed, secant_of
from ..curve import Curve, Stance
from ..equations import VOLUME
from ..follow import FOLDS, NOTHING, Walk, recorded
from ..locate import ARRIVED, FOLD, LOST, PITCHFORK
from ..solids.surface import SIDE
from .pieces import piece_of, pieces_of
from .retold import retold
from .search import On, Question, held_on, is_symmetric, least_room, may_run_off, rooms_at

Nodes = NDArray[np.float64]

OFF = 5  # event: a contact circle runs off the last piece of its solid

_MOST_PIECES = 12
_THERE = 1e-13  # miss of a separation, over ℓ, that is none
_PROBE = 1e-4  # way from a corner to where it is certain what follows
_AT_CORNER = 1e-9  # room that is none
_PAST = -1e-9  # room that is lost for certain
_NO_ROOM = 1e-14  # of a corner
_FIRST, _SECOND, _SYMMETRIC, _HAND, _LEG = 4, 5, 6, 7, 8  # columns of a node behind its arc

_stance_at = retold(curve.stance_at)
_stance_after = retold(curve.stance_after)
_corrected = retold(curve.corrected)
_follow = retold(follow.follow)
_beyond = retold(follow.beyond)


class Track(NamedTuple):
    """A curve of bridges on a pair of pieces, and how it is followed."""

    on: On
    symmetric: bool
    hand: float


class Journey(NamedTuple):
    """A way along a curve, and where it ended."""

    event: int
    stance: Stance
    track: Track
    going: float  # sign of the slope before the end
    is_corner: bool  # whether it ended at a corner
    goes_on: bool  # whether it is known what lies behind that corner:
    ahead: Stance
    ahead_track: Track
    nodes: int  # recorded


class _Turn(NamedTuple):
    """What follows at a corner."""

    goes_on: bool
    event: int
    stance: Stance
    track: Track


@kernel
def nowhere() -> Journey:
    """A way that leads nowhere."""
    no_arc = Four(math.nan, math.nan, math.nan, math.nan)
    stance, track = Stance(no_arc, no_arc, math.nan, math.nan, 0, 1.0, -1.0), Track(On(0, 0), False, 1.0)
    return Journey(LOST, stance, track, 1.0, False, False, stance, track, 0)


@kernel
def curve_on(question: Question, track: Track) -> Curve:
    """The curve of a track."""
    return Curve(held_on(question, track.on), track.symmetric, track.hand)


@kernel
def set_out(question: Question, z: Four, on: On, going: float) -> tuple[Stance, Track]:
    """A bridge, and the curve through it followed so that the separation grows (going > 0) or falls at first."""
    track = Track(on, is_symmetric(question, z, on), 1.0)
    stance = _stance_at(z, curve_on(question, track))
    if stance.slope * going < 0.0:
        track = Track(on, track.symmetric, -1.0)
        stance = _stance_at(z, curve_on(question, track))
    return stance, track


@kernel
def travel(question: Question, stance: Stance, track: Track, target: float, stops_at: int, nodes: Nodes) -> Journey:
    """Follow a curve until D meets its target, or what it stops at, or it ends."""
    if abs(stance.separation - target) <= _THERE * math.exp(stance.z.log_length):
        return Journey(ARRIVED, stance, track, 1.0, False, False, stance, track, 0)
    count = 0
    for leg in range(_MOST_PIECES):
        path = curve_on(question, track)
        walk = _follow(stance, path, target, stops_at, nodes[count:])
        end = count + walk.nodes
        cut = _first_off(question, track.on, nodes, count, end)
        if cut == end:
            _mark(nodes, count, end, track, leg)
            return Journey(walk.event, walk.stance, track, walk.going, False, False, walk.stance, track, end)
        z = _corner(question, track.on, recorded(nodes, cut - 1), recorded(nodes, cut), path)
        for k in range(4):
            nodes[cut, k] = z[k]
        _mark(nodes, count, cut + 1, track, leg)
        count = cut + 1
        last = _just_before(z, path)
        turn = _round_corner(question, track, last)
        going = 1.0 if last.slope > 0.0 else -1.0
        if turn.event == OFF or turn.event == LOST:
            return Journey(turn.event, last, track, going, True, False, last, track, count)
        if turn.event != ARRIVED and stops_at != NOTHING and (stops_at != FOLDS or turn.event == FOLD):
            return Journey(turn.event, last, track, going, True, True, turn.stance, turn.track, count)
        stance, track = turn.stance, turn.track
    return Journey(LOST, stance, track, 1.0, False, False, stance, track, count)


@kernel
def go_beyond(question: Question, journey: Journey) -> tuple[Stance, Track]:
    """Where a curve goes on after the end of a branch."""
    if journey.goes_on:
        return journey.ahead, journey.ahead_track
    walk = Walk(journey.event, journey.stance, curve_on(question, journey.track), 0, journey.going)
    stance, path = _beyond(walk)
    return stance, Track(journey.track.on, path.symmetric, path.hand)


@kernel
def _mark(nodes: Nodes, start: int, stop: int, track: Track, leg: int) -> None:
    """Tell of nodes on which pieces they lie, and how they are followed."""
    for i in range(start, stop):
        nodes[i, _FIRST], nodes[i, _SECOND] = track.on.first, track.on.second
        nodes[i, _SYMMETRIC], nodes[i, _HAND] = 1.0 if track.symmetric else 0.0, track.hand
        nodes[i, _LEG] = leg


@kernel
def track_in(nodes: Nodes, i: int) -> Track:
    """How a node is followed."""
    on = On(int(nodes[i, _FIRST]), int(nodes[i, _SECOND]))
    return Track(on, nodes[i, _SYMMETRIC] > 0.0, float(nodes[i, _HAND]))


@kernel
def is_step(nodes: Nodes, i: int) -> bool:
    """Whether a node and the next are neighbours on one pair of pieces."""
    return bool(nodes[i, _LEG] == nodes[i + 1, _LEG])


@kernel
def _first_off(question: Question, on: On, nodes: Nodes, start: int, stop: int) -> int:
    """The first of some nodes, after that at the start, with a contact circle past the end of its piece; else stop."""
    if may_run_off(question, on):
        for i in range(start + 1, stop):
            if least_room(question, on, recorded(nodes, i)) < _PAST:
                return i
    return stop


@kernel
def _corner(question: Question, on: On, before: Four, after: Four, path: Curve) -> Four:
    """The bridge between two others at which a contact circle comes to the end of its piece, by the Illinois rule."""
    way = moved(after, -1.0, before)
    along = unit_vector(way)
    best = _corrected(before, path, along)[0]
    at_low = least_room(question, on, best)
    if at_low <= 0.0:
        return before
    least = at_low
    bracket = Bracket(0.0, 1.0, at_low, least_room(question, on, _corrected(after, path, along)[0]), 0)
    for _ in range(MOST_NARROWINGS):
        share = secant_of(bracket)
        if not bracket.low < share < bracket.high:
            share = 0.5 * (bracket.low + bracket.high)
        z = _corrected(moved(before, share, way), path, along)[0]
        room = least_room(question, on, z)
        if abs(room) < abs(least):
            best, least = z, room
        bracket = narrowed(bracket, share, room)
        if abs(room) < _NO_ROOM or is_narrow(bracket):
            break
    return best


@kernel
def _seen_from(stance: Stance, near: Stance) -> Stance:
    """A bridge at a corner, with the slope and the stability that the way next to it has."""
    return Stance(
        stance.z, stance.tangent, stance.separation, near.slope, near.unstable, near.margin, stance.opening
    )  # fmt: skip


@kernel
def _just_before(z: Four, path: Curve) -> Stance:
    """The bridge at a corner, as the way to it has it."""
    stance = _stance_at(z, path)
    return _seen_from(stance, _stance_after(stance, -_PROBE, path)[0])


@kernel
def _shift(inner: float, outer: float) -> int:
    """Which piece follows for a contact circle, towards the tip or away from it."""
    if min(inner, outer) < _AT_CORNER:
        return -1 if inner < outer else 1
    return 0


@kernel
def _round_corner(question: Question, track: Track, last: Stance) -> _Turn:
    """What happens at a corner, and the bridge there as the first on the pieces that follow; OFF if none do."""
    inner1, outer1, inner2, outer2 = rooms_at(question, track.on, last.z)
    shift1, shift2 = _shift(inner1, outer1), _shift(inner2, outer2)
    best = _Turn(False, OFF, last, track)
    for one, other in ((1, 0), (0, 1), (1, 1)):
        after = On(track.on.first + one * shift1, track.on.second + other * shift2)
        if track.symmetric and one + other == 1:
            continue
        if (after.first == track.on.first and after.second == track.on.second) or not _is_answered(question, after):
            continue
        turn = _onward(question, after, last, track.symmetric)
        if turn.goes_on and turn.event == ARRIVED:
            return turn
        if turn.goes_on and (best.event == OFF or best.event == LOST):
            best = turn
    return best


@kernel
def _is_answered(question: Question, on: On) -> bool:
    """Whether there are two such pieces, of which one at most is the side of a cylinder, and that at a volume."""
    if not (0 <= on.first < pieces_of(question.first) and 0 <= on.second < pieces_of(question.second)):
        return False
    first, second = piece_of(question.first, on.first).surface.kind, piece_of(question.second, on.second).surface.kind
    return (first != SIDE and second != SIDE) or (first != second and question.control == VOLUME)


@kernel
def _onward(question: Question, after: On, last: Stance, symmetric: bool) -> _Turn:
    """The bridge at a corner on the pieces that follow, and the way on which both circles lie on them."""
    track = Track(after, symmetric or is_symmetric(question, last.z, after), 1.0)
    for hand in (1.0, -1.0):
        track = Track(after, track.symmetric, hand)
        path = curve_on(question, track)
        stance = _stance_at(last.z, path)
        probe, is_met = _stance_after(stance, _PROBE, path)
        if is_met and least_room(question, after, probe.z) > 0.0:
            seen = _seen_from(stance, probe)
            return _Turn(True, _event_between(last, seen, symmetric), seen, track)
    return _Turn(False, OFF, last, track)


@kernel
def _event_between(before: Stance, after: Stance, symmetric: bool) -> int:
    """What happens at a corner: ARRIVED if nothing does."""
    changes = abs(after.unstable - before.unstable)
    if before.slope * after.slope < 0.0:
        return FOLD if changes == 1 or (symmetric and (changes == 0 or changes == 2)) else LOST
    if changes == 0:
        return ARRIVED
    return PITCHFORK if changes == 1 and symmetric else LOST
