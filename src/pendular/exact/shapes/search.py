"""Bridges between two solids at a separation: from the starts, on each pair of their pieces, by Newton's method."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import kernel, tried
from .. import curve, newton
from ..algebra import Four, distance
from ..curve import Curve
from ..equations import SUCTION, VOLUME, Held, curvature_of
from ..solids.surface import SIDE, Surface, is_pinning
from .pieces import are_alike, has_ends, is_flat, piece_of, pieces_of, rooms_on
from .retold import retold, system_as_if_liquid
from .side import has_side, height_of
from .starts import Scan, circle_through, free_at, meridian_of, missed, own_value, scan_of, start_between

Rows = NDArray[np.float64]

_MOST_STEPS = 20
_SHARES = (0.5, 0.2, 0.8, 0.1, 1.3, 0.03, 2.5, 0.01, 0.0, 1e-3)  # of the natural separation, where to look
_MOST_CHANGES = 40
_LEAST_CHANGE = 1e-3  # share of the way to what is asked
_MOST_THOROUGH = 4  # separations
_EVERY, _MOST_OTHERS = 3, 6  # of the circles that hold something else
_UPRIGHT = 1e-6  # slope in the middle of a bridge that is symmetric
_ON_PIECE = -1e-9  # a contact circle may lie past the end of its piece by rounding
_SAME = 1e-6  # difference of two arcs that are one

MOST_NODES = 1200  # of a way
NODE = 10  # numbers of a node: its arc, its pieces, how it is followed, its leg, and the place of a step
_MOST_FOUND, _FOUND_NUMBERS = 64, 6
_MOST_STARTS, _START_NUMBERS = 128, 3


class Question(NamedTuple):
    """Two solids, what is held between them (H, or V/π), and where to look for their bridge."""

    first: Surface
    second: Surface
    control: int
    value: float
    size: float  # of the smaller solid; NaN if neither has one


class On(NamedTuple):
    """The piece of each solid on which a contact circle lies, by its number."""

    first: int
    second: int


class Found(NamedTuple):
    """A bridge on a pair of pieces."""

    z: Four
    on: On


class Room(NamedTuple):
    """Where the solver writes on its way."""

    nodes: Rows
    found: Rows
    starts: Rows


def room_for_nodes() -> Rows:
    """Room for three ways."""
    return np.empty((3 * MOST_NODES, NODE))


def room_for_found() -> Rows:
    """Room for the bridges at a separation."""
    return np.empty((_MOST_FOUND, _FOUND_NUMBERS))


def room_for_starts() -> Rows:
    """Room for where to start from."""
    return np.empty((_MOST_STARTS, _START_NUMBERS))


_newton_to = tried(retold(newton.newton_to), (Four(math.nan, math.nan, math.nan, math.nan), False))
_stance_at = retold(curve.stance_at)


@kernel
def held_between(first: Surface, second: Surface, control: int, value: float) -> Held:
    """What is held between two surfaces."""
    return Held(first, second, control, value)  # type: ignore[arg-type]


@kernel
def held_on(question: Question, on: On) -> Held:
    """What is held between two pieces."""
    first, second = piece_of(question.first, on.first), piece_of(question.second, on.second)
    return held_between(first.surface, second.surface, question.control, question.value)


@kernel
def is_symmetric(question: Question, z: Four, on: On) -> bool:
    """Whether a bridge lies between mirror images, and is one of itself."""
    return abs(z.slope) < _UPRIGHT and on.first == on.second and are_alike(question.first, question.second)


@kernel
def rooms_at(question: Question, on: On, z: Four) -> tuple[float, float, float, float]:
    """How far both contact circles lie from the ends of their pieces: inner and outer end of each."""
    held = held_on(question, on)
    is_on_side = has_side(held)
    system = system_as_if_liquid(z, held, False, is_on_side)
    height = 0.0
    if is_on_side:
        height = height_of(system, held, held.first if held.first.kind == SIDE else held.second)  # type: ignore
    one = rooms_on(piece_of(question.first, on.first), system.first, height)
    other = rooms_on(piece_of(question.second, on.second), system.second, height)
    return one.inner, one.outer, other.inner, other.outer


@kernel
def least_room(question: Question, on: On, z: Four) -> float:
    """How far both contact circles lie at least from the ends of their pieces."""
    inner1, outer1, inner2, outer2 = rooms_at(question, on, z)
    return min(inner1, outer1, inner2, outer2)


@kernel
def lies_on(question: Question, on: On, z: Four) -> bool:
    """Whether both contact circles of a bridge lie on their pieces."""
    return not may_run_off(question, on) or least_room(question, on, z) >= _ON_PIECE


@kernel
def may_run_off(question: Question, on: On) -> bool:
    """Whether a contact circle can come to the end of its piece."""
    return has_ends(piece_of(question.first, on.first)) or has_ends(piece_of(question.second, on.second))


@kernel
def _reach(question: Question, separation: float) -> tuple[float, float]:
    """Least and largest length of a question."""
    size = question.size
    if question.control == VOLUME:
        own = math.pow(math.pi * question.value, 1.0 / 3.0)
        return own, max(own, min(size, 1e3 * own)) if size > 0.0 else own
    least, most = math.inf, 0.0
    for length in (1.0 / abs(question.value) if question.value != 0.0 else 0.0, size, separation):
        if length > 0.0:
            least, most = min(least, length), max(most, length)
    return least, most


@kernel
def _on_number(question: Question, number: int) -> On:
    """One of all choices of a piece of each solid."""
    choices = pieces_of(question.second)
    return On(number // choices, number % choices)


@kernel
def _is_searched(question: Question, on: On) -> bool:
    """Whether bridges are looked for on two pieces; those on a side beside an edge are followed to."""
    first, second = piece_of(question.first, on.first).surface, piece_of(question.second, on.second).surface
    if first.kind != SIDE and second.kind != SIDE:
        return True
    is_alone = first.kind != second.kind and not is_pinning(first) and not is_pinning(second)
    return question.control == VOLUME and is_alone


@kernel
def _with_this(question: Question, z: Four, on: On, found: Rows, count: int) -> int:
    """Store a bridge among those that were found, if it lies on its pieces, is stable and is none of them."""
    if count == found.shape[0] or not lies_on(question, on, z):
        return count
    for i in range(count):
        one = found_in(found, i)
        if one.on.first == on.first and one.on.second == on.second and not distance(one.z, z) > _SAME:
            return count
    stance = _stance_at(z, Curve(held_on(question, on), is_symmetric(question, z, on), 1.0))
    if stance.unstable != 0 or not stance.opening > 0.0:
        return count
    for k in range(4):
        found[count, k] = z[k]
    found[count, 4], found[count, 5] = on.first, on.second
    return count + 1


@kernel
def found_in(found: Rows, i: int) -> Found:
    """One of the bridges that were found."""
    z = Four(float(found[i, 0]), float(found[i, 1]), float(found[i, 2]), float(found[i, 3]))
    return Found(z, On(int(found[i, 4]), int(found[i, 5])))


@kernel
def stable_at(question: Question, separation: float, most: int, room: Room) -> int:
    """Find the stable bridges to which the starts lead at a separation, so many at most; their number."""
    least, largest = _reach(question, separation)
    count = 0
    for number in range(pieces_of(question.first) * pieces_of(question.second)):
        on = _on_number(question, number)
        if not _is_searched(question, on):
            continue
        held = held_on(question, on)
        scan = scan_of(piece_of(question.first, on.first), piece_of(question.second, on.second), least, largest)
        low, at_low = 0.0, math.nan
        for i in range(scan.number):
            high = free_at(scan, i)
            at_high = missed(held, separation, high)
            if at_low * at_high <= 0.0:
                z, is_met = _newton_to(start_between(held, separation, low, high), separation, held, _MOST_STEPS)
                if is_met:
                    count = _with_this(question, z, on, room.found, count)
                    if count >= most:
                        return count
            low, at_low = high, at_high
    return count


@kernel
def led_at(question: Question, separation: float, most: int, room: Room) -> int:
    """Find stable bridges to which those that hold something else lead, by small changes of it; their number."""
    least, largest = _reach(question, separation)
    count = 0
    for number in range(pieces_of(question.first) * pieces_of(question.second)):
        on = _on_number(question, number)
        if not _is_searched(question, on):
            continue
        held = held_on(question, on)
        scan = scan_of(piece_of(question.first, on.first), piece_of(question.second, on.second), least, largest)
        nearest = _nearest_others(held, separation, scan, room.starts)
        for i in range(nearest):
            own = held_between(held.first, held.second, held.control, float(room.starts[i, 2]))  # type: ignore
            start = meridian_of(circle_through(held, separation, float(room.starts[i, 1])), own)
            z, is_met = _changed(start, separation, own, held)
            if is_met:
                count = _with_this(question, z, on, room.found, count)
                if count >= most:
                    return count
        if held.control == SUCTION:
            volume = held_between(held.first, held.second, VOLUME, math.pow(least * largest, 1.5))  # type: ignore
            nearest = _nearest_others(volume, separation, scan, room.starts)
            for i in range(nearest):
                own = held_between(held.first, held.second, VOLUME, float(room.starts[i, 2]))  # type: ignore
                start = meridian_of(circle_through(volume, separation, float(room.starts[i, 1])), own)
                count = _swept(question, on, start, separation, own, held, most, room, count)
                if count >= most:
                    return count
    return count


@kernel
def _nearest_others(held: Held, separation: float, scan: Scan, starts: Rows) -> int:
    """Store circles that hold something else, the nearest first: how far off it is, their number, what it is."""
    count = 0
    for i in range(0, scan.number, _EVERY):
        free = free_at(scan, i)
        value = own_value(circle_through(held, separation, free), held.control)
        if count < starts.shape[0] and abs(value) < math.inf and (held.control == SUCTION or value > 0.0):
            far = abs(value - held.value) if held.control == SUCTION else abs(math.log(value / held.value))
            starts[count, 0], starts[count, 1], starts[count, 2] = far, free, value
            count += 1
    wanted = min(count, _MOST_OTHERS)
    for i in range(wanted):
        best = i
        for k in range(i + 1, count):
            if starts[k, 0] < starts[best, 0]:
                best = k
        for k in range(3):
            starts[i, k], starts[best, k] = starts[best, k], starts[i, k]
    return wanted


@kernel
def _swept(
    question: Question, on: On, start: Four, separation: float, held: Held, wanted: Held, most: int, room: Room,
    count: int,
) -> int:  # fmt: skip
    """Bridges of a suction among those that are stable at a volume: with less and less, and more and more liquid."""
    first, is_first_met = _stably(start, separation, held)
    for growth in (1.4, 1.0 / 1.4):
        z, is_met, value = first, is_first_met, held.value
        for _ in range(_MOST_CHANGES):
            if not is_met:
                break
            value *= growth
            after, is_met = _stably(
                z,
                separation,
                held_between(held.first, held.second, VOLUME, value),  # type: ignore
            )
            if is_met and (curvature_of(z) - wanted.value) * (curvature_of(after) - wanted.value) <= 0.0:
                there, is_there = _stably(after, separation, wanted)
                if is_there:
                    count = _with_this(question, there, on, room.found, count)
                    if count >= most:
                        return count
            z = after
    return count


@kernel
def _changed(z: Four, separation: float, easy: Held, hard: Held) -> tuple[Four, bool]:
    """The bridge that holds what is asked, from a start near to one that holds something else; False if it is lost."""
    share, step = 0.0, 0.25
    before, is_met = _stably(z, separation, easy)
    while is_met:
        ahead = min(share + step, 1.0)
        value = easy.value + ahead * (hard.value - easy.value)
        if hard.control == VOLUME:
            value = math.pow(easy.value, 1.0 - ahead) * math.pow(hard.value, ahead)
        after, is_after_met = _stably(
            before,
            separation,
            held_between(hard.first, hard.second, hard.control, value),  # type: ignore
        )
        if not is_after_met:
            step *= 0.4
            if step < _LEAST_CHANGE:
                return before, False
            continue
        if ahead == 1.0:
            return after, True
        before, share, step = after, ahead, 1.5 * step
    return before, False


@kernel
def _stable_from(z: Four, separation: float, held: Held) -> tuple[Four, bool]:
    """The stable bridge to which Newton's method leads, on two pieces without ends."""
    z, is_met = _newton_to(z, separation, held, _MOST_STEPS)
    return z, is_met and _stance_at(z, Curve(held, False, 1.0)).unstable == 0


_stably = tried(_stable_from, (Four(math.nan, math.nan, math.nan, math.nan), False))


@kernel
def _natural_of(question: Question, number: int) -> float:
    """One of two natural separations; NaN where there is none."""
    if question.control == SUCTION:
        if number == 0:
            return 1.0 / abs(question.value) if question.value != 0.0 else math.nan
        return question.size
    if number == 0:
        return math.pow(math.pi * question.value, 1.0 / 3.0)
    edge = _edge_of(question.first)
    if not edge > 0.0:
        edge = _edge_of(question.second)
    return question.value / (edge * edge)


@kernel
def _edge_of(solid: Surface) -> float:
    return solid.size if is_pinning(solid) else math.nan


class Anchor(NamedTuple):
    """A stable bridge, and its separation, if one was found."""

    is_known: bool
    found: Found
    separation: float


@kernel
def anchor(question: Question, room: Room) -> Anchor:
    """A stable bridge, wherever one is found."""
    are_flat = is_flat(question.first) and is_flat(question.second)
    for round_ in range(2):
        tries = 0
        for share in _SHARES:
            for number in range(2):
                separation = share * _natural_of(question, number)
                if not separation >= 0.0 or (separation == 0.0 and are_flat):
                    continue
                tries += 1
                if round_ == 0:
                    count = stable_at(question, separation, 1, room)
                elif tries > _MOST_THOROUGH:
                    break
                else:
                    count = led_at(question, separation, 1, room)
                if count > 0:
                    return Anchor(True, found_in(room.found, 0), separation)
    nowhere = Four(math.nan, math.nan, math.nan, math.nan)
    return Anchor(False, Found(nowhere, On(0, 0)), math.nan)
