"""Where to start looking for a bridge between two surfaces: circular meridians that hold about what is asked.

One number is left free, the radius of a contact circle or, between two edges, the bend of the circle; it is scanned,
and wherever the circle holds what is asked there is a start.
"""

import math
from typing import NamedTuple

from ...ground.compile import kernel
from ..algebra import Four
from ..equations import SUCTION, Held
from ..solids.surface import SIDE, SPHERE, Surface, is_pinning
from .pieces import Piece
from .surfaces import shape_at

_PER_E = 8 / math.log(10.0)  # contact circles that are looked at, eight in a decade,
_NARROWEST, _WIDEST = 1e-3, 30.0  # over the lengths of the question
_BENDS = 25  # half turns between two edges
_MOST_BEND = 2.9
_ROUNDS = 4
_MOST_TILT = 1.2
_MOST_TURN = 3.0  # |ω|
_HALVINGS = 12


class Circle(NamedTuple):
    """A circular meridian."""

    radius1: float
    radius2: float
    gap: float  # length along the axis
    half_turn: float  # x, positive for a neck
    tilt: float  # σ of its chord
    caps: float  # volume over π of the caps behind its contact circles


class Scan(NamedTuple):
    """The free numbers that are looked at."""

    low: float
    high: float
    number: int
    is_even: bool  # else in even ratios


class _End(NamedTuple):
    """An end of a circle on a surface."""

    radius: float
    slope: float  # asked of the meridian; NaN where it is pinned
    depth: float
    cap: float


@kernel
def _chord(circle: Circle) -> float:
    """Half the chord."""
    return 0.5 * math.hypot(circle.gap, circle.radius2 - circle.radius1)


@kernel
def _bow(x: float) -> float:
    """x/sin x, and kept within bounds."""
    return x / math.sin(x) if abs(x) > 1e-6 else 1.0


@kernel
def _volume(circle: Circle) -> float:
    """V/π between the solids: the frustum of the chord less the segment, by the rule of Pappus, less the caps."""
    a, b, x = circle.radius1, circle.radius2, circle.half_turn
    chord = _chord(circle)
    frustum = circle.gap * (a * a + a * b + b * b) / 3.0
    if abs(x) < 1e-2:
        segment, moment = chord**2 * 2.0 * x / 3.0, chord**3 * 4.0 * x * x / 15.0
    else:
        radius = chord / math.sin(x)
        sector = x - math.sin(x) * math.cos(x)
        segment = radius**2 * sector
        moment = radius**3 * (2.0 * math.sin(x) ** 3 / 3.0 - math.cos(x) * sector)
    return frustum - (segment * (a + b) - 2.0 * moment * math.cos(circle.tilt)) - circle.caps


@kernel
def _middle(circle: Circle) -> float:
    """Radius in the middle of the arc."""
    sagitta = _chord(circle) * math.tan(0.5 * circle.half_turn)
    mean = 0.5 * (circle.radius1 + circle.radius2)
    return max(mean - sagitta * math.cos(circle.tilt), 0.1 * mean)


@kernel
def _suction(circle: Circle) -> float:
    """H, about: that of the circle less the mean of cos φ over the radius."""
    x, middle = circle.half_turn, _middle(circle)
    mean = middle + (0.5 * (circle.radius1 + circle.radius2) - middle) / 3.0
    bend = 0.5 * (_bow(x) + math.cos(x)) * math.cos(circle.tilt)
    return math.sin(x) / _chord(circle) - bend / mean


@kernel
def meridian_of(circle: Circle, held: Held) -> Four:
    """The numbers of an arc of constant mean curvature that is about the circle."""
    middle = _middle(circle)
    length = _chord(circle) * abs(_bow(circle.half_turn))
    if held.control == SUCTION:
        turn = held.value * length
        if abs(turn) > _MOST_TURN:
            length, turn = _MOST_TURN / abs(held.value), math.copysign(_MOST_TURN, turn)
    else:
        turn = circle.half_turn - math.cos(circle.tilt) * length / middle
        turn = max(-_MOST_TURN, min(_MOST_TURN, turn))
    return Four(math.log(middle), circle.tilt, math.log(length), turn)


@kernel
def _bounded(value: float, most: float) -> float:
    return max(-most, min(most, value))


@kernel
def _end_on(surface: Surface, radius: float) -> _End:
    """The end of a circle of a radius on a surface."""
    if is_pinning(surface) or surface.kind == SIDE:
        return _End(surface.size, math.nan, 0.0, 0.0)
    rise = shape_at(surface, radius)
    slope = 0.5 * math.pi - surface.contact_angle - math.atan2(rise.sin_slope, rise.cos_slope)
    return _End(radius, slope, rise.height, rise.cap)


@kernel
def circle_through(held: Held, separation: float, free: float) -> Circle:
    """The circle with a free number: a contact radius, or between two edges its half turn."""
    first: Surface = held.first  # type: ignore[assignment]
    second: Surface = held.second  # type: ignore[assignment]
    pinned1, pinned2 = is_pinning(first), is_pinning(second)
    if pinned1 and pinned2:
        return Circle(first.size, second.size, separation, free, math.atan2(second.size - first.size, separation), 0.0)
    if first.kind == SIDE:
        return _circle_from_side(first, second, separation, free)
    if second.kind == SIDE:
        back = _circle_from_side(second, first, separation, free)
        return Circle(back.radius2, back.radius1, back.gap, back.half_turn, -back.tilt, back.caps)
    end1, end2 = _end_on(first, free), _end_on(second, free)
    gap = separation + end1.depth + end2.depth
    if pinned1 or pinned2:
        tilt = math.atan2(end2.radius - end1.radius, gap)
        x = end2.slope - tilt if pinned1 else end1.slope + tilt
    else:
        x, tilt = 0.5 * (end1.slope + end2.slope), _bounded(0.5 * (end2.slope - end1.slope), _MOST_TILT)
        for _ in range(_ROUNDS - 1):
            shift = _bounded(0.5 * gap * math.tan(tilt), 0.6 * free)
            end1, end2 = _end_on(first, free - shift), _end_on(second, free + shift)
            gap = separation + end1.depth + end2.depth
            x, tilt = 0.5 * (end1.slope + end2.slope), _bounded(0.5 * (end2.slope - end1.slope), _MOST_TILT)
    return Circle(
        end1.radius, end2.radius, gap, _bounded(x, _MOST_BEND), _bounded(tilt, _MOST_TILT), end1.cap + end2.cap
    )


@kernel
def _circle_from_side(side: Surface, other: Surface, separation: float, free: float) -> Circle:
    """The circle from the side of a cylinder to another surface, whose slopes leave it one place."""
    end = _end_on(other, free)
    x, tilt = 0.5 * (end.slope - side.contact_angle), 0.5 * (end.slope + side.contact_angle)
    rise = math.tan(tilt)
    gap = (end.radius - side.size) / rise if rise != 0.0 else math.nan
    caps = end.cap + side.size * side.size * (gap - separation - end.depth)
    return Circle(side.size, end.radius, gap, x, _bounded(tilt, _MOST_TILT), caps)


@kernel
def own_value(circle: Circle, control: int) -> float:
    """What a circle holds; NaN where its solids leave no room for it."""
    if not circle.gap > 0.0:
        return math.nan
    return _suction(circle) if control == SUCTION else _volume(circle)


@kernel
def missed(held: Held, separation: float, free: float) -> float:
    """How far a circle is from what is asked to be held."""
    return own_value(circle_through(held, separation, free), held.control) - held.value


@kernel
def start_between(held: Held, separation: float, low: float, high: float) -> Four:
    """The arc to start from where, between two free numbers, a circle holds what is asked, to a few digits."""
    at_low = missed(held, separation, low)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if (missed(held, separation, middle) > 0.0) == (at_low > 0.0):
            low = middle
        else:
            high = middle
    return meridian_of(circle_through(held, separation, 0.5 * (low + high)), held)


@kernel
def _narrowest_of(piece: Piece) -> float:
    """Contact radius from which on circles are looked at on a piece; 0 where a line is pinned."""
    return 0.0 if is_pinning(piece.surface) or piece.surface.kind == SIDE else 0.7 * piece.inner


@kernel
def _widest_of(piece: Piece) -> float:
    """Contact radius up to which they are."""
    surface = piece.surface
    if is_pinning(surface) or surface.kind == SIDE:
        return math.inf
    equator = 1.0 / surface.curvature if surface.kind == SPHERE and surface.curvature > 0.0 else math.inf
    return min(1.3 * piece.outer, equator)


@kernel
def scan_of(first: Piece, second: Piece, least: float, most: float) -> Scan:
    """The free numbers that are looked at between two pieces, for lengths of a question between two."""
    if is_pinning(first.surface) and is_pinning(second.surface):
        return Scan(-_MOST_BEND, _MOST_BEND, _BENDS, True)
    low = max(_narrowest_of(first), _narrowest_of(second), _NARROWEST * least)
    high = min(_widest_of(first), _widest_of(second), _WIDEST * most)
    if low >= high:
        low = 0.3 * high
    if not 0.0 < low < high < math.inf:
        return Scan(0.0, 0.0, 0, False)
    return Scan(low, high, 2 + int(_PER_E * math.log(high / low)), False)


@kernel
def free_at(scan: Scan, i: int) -> float:
    """One of the numbers that are looked at."""
    share = i / (scan.number - 1)
    if scan.is_even:
        return scan.low + share * (scan.high - scan.low)
    return scan.low * math.pow(scan.high / scan.low, share)
