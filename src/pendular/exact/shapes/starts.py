"""Where to start looking for a bridge between two surfaces: circular meridians that hold about what is asked.

One number is left free, the radius of a contact circle or, between two edges, the bend of the circle; it is scanned,
and wherever the circle holds what is asked there is a start.
"""

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from ..algebra import Four
from ..equations import SUCTION, Held
from ..solids import Solid
from ..solids.edge import Edge, Side
from .pieces import Piece
from .surfaces import Surface, shape_at

_PER_DECADE = 8  # contact circles that are looked at,
_NARROWEST, _WIDEST = 1e-3, 30.0  # over the lengths of the question
_BENDS = 25  # half turns between two edges
_MOST_BEND = 2.9
_ROUNDS = 4
_EVERY, _MOST_OTHERS = 3, 6
_MOST_TILT = 1.2
_MOST_TURN = 3.0  # |ω|


class Circle(NamedTuple):
    """A circular meridian."""

    radius1: float
    radius2: float
    gap: float  # length along the axis
    half_turn: float  # x, positive for a neck
    tilt: float  # σ of its chord
    caps: float  # volume over π of the caps behind its contact circles


def _chord(circle: Circle) -> float:
    """Half the chord."""
    return 0.5 * math.hypot(circle.gap, circle.radius2 - circle.radius1)


def _bow(x: float) -> float:
    """x/sin x, and kept within bounds."""
    return x / math.sin(x) if abs(x) > 1e-6 else 1.0


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


def _middle(circle: Circle) -> float:
    """Radius in the middle of the arc."""
    sagitta = _chord(circle) * math.tan(0.5 * circle.half_turn)
    mean = 0.5 * (circle.radius1 + circle.radius2)
    return max(mean - sagitta * math.cos(circle.tilt), 0.1 * mean)


def _suction(circle: Circle) -> float:
    """H, about: that of the circle less the mean of cos φ over the radius."""
    x, middle = circle.half_turn, _middle(circle)
    mean = middle + (0.5 * (circle.radius1 + circle.radius2) - middle) / 3.0
    bend = 0.5 * (_bow(x) + math.cos(x)) * math.cos(circle.tilt)
    return math.sin(x) / _chord(circle) - bend / mean


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


def _ends(held: Held, radius1: float, radius2: float) -> list[tuple[float, float, float, float]]:
    """Of both circles: radius, slope asked of the meridian (NaN on an edge), depth and cap over π."""
    ends = []
    both: tuple[tuple[Surface, float], ...] = (held.first, radius1), (held.second, radius2)
    for surface, radius in both:
        if isinstance(surface, Edge | Side):
            ends.append((surface.radius, math.nan, 0.0, 0.0))
        else:
            rise = shape_at(surface, radius)
            slope = 0.5 * math.pi - surface.contact_angle - math.atan2(rise.sin_slope, rise.cos_slope)
            ends.append((radius, slope, rise.height, rise.cap))
    return ends


def circle_through(held: Held, separation: float, free: float) -> Circle:
    """The circle with a free number: a contact radius, or between two edges its half turn."""
    first: Surface = held.first
    second: Surface = held.second
    pinned1, pinned2 = isinstance(first, Edge), isinstance(second, Edge)
    if pinned1 and pinned2:
        a, b = first.radius, second.radius
        return Circle(a, b, separation, free, math.atan2(b - a, separation), 0.0)
    if isinstance(first, Side) or isinstance(second, Side):
        return _circle_from_side(held, separation, free)
    radius1 = radius2 = free
    for _ in range(_ROUNDS):
        (a, slope1, h1, cap1), (b, slope2, h2, cap2) = _ends(held, radius1, radius2)
        gap = separation + h1 + h2
        if pinned1 or pinned2:
            tilt = math.atan2(b - a, gap)
            x = slope2 - tilt if pinned1 else slope1 + tilt
            break
        x, tilt = 0.5 * (slope1 + slope2), 0.5 * (slope2 - slope1)
        tilt = max(-_MOST_TILT, min(_MOST_TILT, tilt))
        shift = max(-0.6 * free, min(0.6 * free, 0.5 * gap * math.tan(tilt)))
        radius1, radius2 = free - shift, free + shift
    tilt = max(-_MOST_TILT, min(_MOST_TILT, tilt))
    return Circle(a, b, gap, max(-_MOST_BEND, min(_MOST_BEND, x)), tilt, cap1 + cap2)


def _circle_from_side(held: Held, separation: float, free: float) -> Circle:
    """The circle from the side of a cylinder to another surface, whose slopes leave it one place."""
    first: Surface = held.first
    is_first = isinstance(first, Side)
    side: Surface = first if is_first else held.second
    ends = _ends(held, free, free)
    radius, slope, depth, cap = ends[1] if is_first else ends[0]
    x, tilt = 0.5 * (slope - side.contact_angle), 0.5 * (slope + side.contact_angle)
    rise = math.tan(tilt)
    gap = (radius - side.radius) / rise if rise != 0.0 else math.nan
    caps = cap + side.radius**2 * (gap - separation - depth)
    tilt = max(-_MOST_TILT, min(_MOST_TILT, tilt))
    if is_first:
        return Circle(side.radius, radius, gap, x, tilt, caps)
    return Circle(radius, side.radius, gap, x, -tilt, caps)


def _own_value(circle: Circle, control: int) -> float:
    """What a circle holds; NaN where its solids leave no room for it."""
    if not circle.gap > 0.0:
        return math.nan
    return _suction(circle) if control == SUCTION else _volume(circle)


def starts(held: Held, separation: float, pieces: tuple[Piece, Piece], reach: tuple[float, float]) -> Iterator[Four]:
    """Arcs to start from, at a separation."""

    def miss(free: float) -> float:
        return _own_value(circle_through(held, separation, free), held.control) - held.value

    frees = _scanned(held, pieces, reach)
    values = [miss(free) for free in frees]
    for low, high, at_low, at_high in zip(frees[:-1], frees[1:], values[:-1], values[1:], strict=True):
        if at_low * at_high <= 0.0:
            yield meridian_of(circle_through(held, separation, _between(miss, low, high)), held)


def others(
    held: Held, separation: float, pieces: tuple[Piece, Piece], reach: tuple[float, float]
) -> Iterator[tuple[Four, Held]]:
    """Arcs to start from to bridges that hold something else, and what they hold, the nearest first."""
    found = []
    for free in _scanned(held, pieces, reach)[::_EVERY]:
        circle = circle_through(held, separation, free)
        value = _own_value(circle, held.control)
        if math.isfinite(value) and (held.control == SUCTION or value > 0.0):
            own = Held(held.first, held.second, held.control, value)
            far = abs(value - held.value) if held.control == SUCTION else abs(math.log(value / held.value))
            found.append((far, meridian_of(circle, own), own))
    for _far, start, own in sorted(found)[:_MOST_OTHERS]:
        yield start, own


def _between(miss: Callable[[float], float], low: float, high: float) -> float:
    """Where a circle holds what is asked, to a few digits."""
    at_low = miss(low)
    for _ in range(12):
        middle = 0.5 * (low + high)
        if (miss(middle) > 0.0) == (at_low > 0.0):
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def _equator(surface: Surface) -> float:
    """Radius beyond which a surface does not reach."""
    return 1.0 / surface.curvature if isinstance(surface, Solid) and surface.curvature > 0.0 else math.inf


def _scanned(held: Held, pieces: tuple[Piece, Piece], reach: tuple[float, float]) -> list[float]:
    """The free numbers that are looked at."""
    free = [piece for piece in pieces if not isinstance(piece.surface, Edge | Side)]
    if not free:
        return [_MOST_BEND * (2.0 * i / (_BENDS - 1) - 1.0) for i in range(_BENDS)]
    outer = min(min(1.3 * piece.outer, _equator(piece.surface)) for piece in free)
    inner = max(0.7 * piece.inner for piece in free)
    low, high = max(inner, _NARROWEST * reach[0]), min(outer, _WIDEST * reach[1])
    if low >= high:
        low = 0.3 * high
    count = 2 + int(_PER_DECADE * math.log10(high / low))
    return [low * (high / low) ** (i / (count - 1)) for i in range(count)]
