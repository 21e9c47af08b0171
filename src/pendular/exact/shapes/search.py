"""Bridges between two solids at a separation: from the starts, on each pair of their pieces, by Newton's method."""

import math
from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

from ..algebra import Four
from ..curve import Curve, Stance, stance_at
from ..equations import SUCTION, VOLUME, Held, curvature_of, system_at
from ..newton import newton_to
from ..solids.edge import Edge, Side
from .pieces import Body, Piece, is_flat, rooms
from .retold import retold
from .side import Sided
from .starts import others, starts

_MOST_STEPS = 20
_SHARES = (0.5, 0.2, 0.8, 0.1, 1.3, 0.03, 2.5, 0.01, 0.0, 1e-3)  # of the natural separation, where to look
_MOST_CHANGES = 40
_LEAST_CHANGE = 1e-3  # share of the way to what is asked
_MOST_THOROUGH = 4  # separations
_UPRIGHT = 1e-6  # slope in the middle of a bridge that is symmetric
_ON_PIECE = -1e-9  # a contact circle may lie past the end of its piece by rounding


class Question(NamedTuple):
    """Two solids, what is held between them (H, or V/π), and where to look for their bridge."""

    first: Body
    second: Body
    control: int
    value: float
    size: float  # of the smaller solid; NaN if neither has one


Indices = tuple[int, int]  # of the piece of each solid on which a contact circle lies


class Found(NamedTuple):
    """A bridge on a pair of pieces."""

    z: Four
    on: Indices


def held_on(question: Question, on: Indices) -> Held:
    """What is held between two pieces."""
    return Held(question.first[on[0]].surface, question.second[on[1]].surface, question.control, question.value)


def pieces_on(question: Question, on: Indices) -> tuple[Piece, Piece]:
    """The two pieces."""
    return question.first[on[0]], question.second[on[1]]


def is_symmetric(question: Question, found: Found) -> bool:
    """Whether a bridge lies between mirror images, and is one of itself."""
    return question.first == question.second and found.on[0] == found.on[1] and abs(found.z.slope) < _UPRIGHT


def curve_through(question: Question, found: Found, hand: float = 1.0) -> Curve:
    """The curve of bridges through one of them."""
    return Curve(held_on(question, found.on), is_symmetric(question, found), hand)


def rooms_at(question: Question, on: Indices, z: Four) -> tuple[float, float, float, float]:
    """How far both contact circles lie from the ends of their pieces: inner and outer end of each."""
    system = retold(system_at)(z, held_on(question, on), False, False)
    first, second = pieces_on(question, on)
    height = system.height if isinstance(system, Sided) else 0.0
    return *rooms(first, system.first, height), *rooms(second, system.second, height)


def lies_on(question: Question, on: Indices, z: Four) -> bool:
    """Whether both contact circles of a bridge lie on their pieces."""
    return min(rooms_at(question, on, z)) >= _ON_PIECE


def _reach(question: Question, separation: float) -> tuple[float, float]:
    """Least and largest length of a question."""
    own = 1.0 / abs(question.value) if question.control == SUCTION and question.value != 0.0 else math.nan
    if question.control == VOLUME:
        own = (math.pi * question.value) ** (1.0 / 3.0)
    lengths = [length for length in (own, question.size, separation) if length > 0.0]
    if question.control == VOLUME:
        lengths = [own, max(own, min(question.size, 1e3 * own)) if question.size > 0.0 else own]
    return min(lengths), max(lengths)


def _pairs(question: Question) -> Iterator[Indices]:
    """Pairs of pieces on which bridges are looked for; to a side beside an edge they are followed."""
    for on in product(range(len(question.first)), range(len(question.second))):
        kinds = [type(piece.surface) for piece in pieces_on(question, on)]
        if Side not in kinds or (question.control == VOLUME and kinds.count(Side) == 1 and Edge not in kinds):
            yield on


def bridges_at(question: Question, separation: float) -> Iterator[Found]:
    """All bridges that the starts lead to at a separation, stable or not."""
    for on in _pairs(question):
        held = held_on(question, on)
        seen: list[Four] = []
        for start in starts(held, separation, pieces_on(question, on), _reach(question, separation)):
            try:
                z, is_met = retold(newton_to)(start, separation, held, _MOST_STEPS)
            except (ArithmeticError, ValueError):
                continue
            if is_met and lies_on(question, on, z) and all(max(map(abs, _less(z, one))) > 1e-6 for one in seen):
                seen.append(z)
                yield Found(z, on)


def _led_at(question: Question, separation: float) -> Iterator[Found]:
    """Bridges to which those that hold something else lead, by small changes of it, while they stay stable."""
    lengths = _reach(question, separation)
    for on in _pairs(question):
        held, pieces = held_on(question, on), pieces_on(question, on)
        for start, own in others(held, separation, pieces, lengths):
            z = _changed(start, separation, own, held)
            if z is not None and lies_on(question, on, z):
                yield Found(z, on)
        if held.control == SUCTION:
            volume = Held(held.first, held.second, VOLUME, (lengths[0] * lengths[1]) ** 1.5)
            for start, own in others(volume, separation, pieces, lengths):
                for z in _swept(start, separation, own, held):
                    if lies_on(question, on, z):
                        yield Found(z, on)


def _swept(start: Four, separation: float, held: Held, wanted: Held) -> Iterator[Four]:
    """Bridges of a suction among those that are stable at a volume: with less and less, and more and more liquid."""
    first = _stably(start, separation, held)
    for growth in (1.4, 1.0 / 1.4):
        z, value = first, held.value
        for _ in range(_MOST_CHANGES):
            if z is None:
                break
            value *= growth
            after = _stably(z, separation, held._replace(value=value))
            if after is not None and (curvature_of(z) - wanted.value) * (curvature_of(after) - wanted.value) <= 0.0:
                met = _stably(after, separation, wanted)
                if met is not None:
                    yield met
            z = after


def _changed(z: Four, separation: float, easy: Held, hard: Held) -> Four | None:
    """The bridge that holds what is asked, from a start near to one that holds something else; None if it is lost."""
    share, step = 0.0, 0.25
    before = _stably(z, separation, easy)
    while before is not None:
        ahead = min(share + step, 1.0)
        value = easy.value + ahead * (hard.value - easy.value)
        if hard.control == VOLUME:
            value = easy.value ** (1.0 - ahead) * hard.value**ahead
        after = _stably(before, separation, Held(hard.first, hard.second, hard.control, value))
        if after is None:
            step *= 0.4
            if step < _LEAST_CHANGE:
                return None
            continue
        if ahead == 1.0:
            return after
        before, share, step = after, ahead, 1.5 * step
    return None


def _stably(z: Four, separation: float, held: Held) -> Four | None:
    """The stable bridge to which Newton's method leads, on two pieces without ends."""
    try:
        z, is_met = retold(newton_to)(z, separation, held, _MOST_STEPS)
        return z if is_met and retold(stance_at)(z, Curve(held, False, 1.0)).unstable == 0 else None
    except (ArithmeticError, ValueError):
        return None


def _less(a: Four, b: Four) -> tuple[float, ...]:
    return tuple(x - y for x, y in zip(a, b, strict=True))


def _stance_of(question: Question, found: Found) -> Stance:
    """A bridge as one on a curve."""
    stance: Stance = retold(stance_at)(found.z, curve_through(question, found))
    return stance


def stable_at(question: Question, separation: float, *, thoroughly: bool = False) -> Iterator[Found]:
    """The stable bridges that the starts lead to at a separation, or ``thoroughly`` those of other bridges."""
    for found in (_led_at if thoroughly else bridges_at)(question, separation):
        stance = _stance_of(question, found)
        if stance.unstable == 0 and stance.opening > 0.0:
            yield found


def _separations_to_try(question: Question) -> Iterator[float]:
    """Where a stable bridge is likely."""
    are_flat = is_flat(question.first) and is_flat(question.second)
    pieces = (*question.first, *question.second)
    edges = [piece.surface.radius for piece in pieces if isinstance(piece.surface, Edge)]
    if question.control == VOLUME:
        naturals = [(math.pi * question.value) ** (1.0 / 3.0)]
        naturals += [question.value / edge**2 for edge in edges[:1]]
    else:
        naturals = [1.0 / abs(question.value)] if question.value != 0.0 else []
        naturals += [question.size] if question.size > 0.0 else []
    for share in _SHARES:
        for natural in naturals:
            if share > 0.0 or not are_flat:
                yield share * natural


def anchor(question: Question) -> tuple[Found, float] | None:
    """A stable bridge, wherever one is found, and its separation."""
    for thoroughly in (False, True):
        for i, separation in enumerate(_separations_to_try(question)):
            if thoroughly and i == _MOST_THOROUGH:
                return None
            for found in stable_at(question, separation, thoroughly=thoroughly):
                return found, separation
    return None
