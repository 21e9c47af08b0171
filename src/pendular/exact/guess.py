"""Where to start looking for a bridge: a circular meridian between contact circles of nearly one radius.

At a volume the radius is that of a cylinder of liquid, corrected once for the circle; at a suction it is the largest
root of the balance of a torus, whose second curvature is 1/Y, corrected once as well.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from ..ground.lanes import choose, every
from .algebra import Four
from .arc import NOWHERE, Arc
from .equations import SUCTION, Held
from .solids import Solid

Table = tuple[tuple[float, ...], ...]

_LARGEST_SINE = 0.97  # of a half-filling angle
_LEAST_COSINE = 0.7  # of the slope of the chord between the contact circles
_MOST_TURN = 1.5  # |ω|
_FARTHEST_SHIFT = 0.6  # of a contact radius from their mean, over it
_THINNEST_MIDDLE = 0.25  # over the mean contact radius
_LEAST_ROOM = 1e-12  # Σ cos θ - DH between planes, where a bridge is wider than all bounds
_STRAIGHT = 1e-3  # half turn below which its sine is itself
_TINY = 1e-30
_DEEPEST_BEND = -0.9  # cos of the half turn beyond which the sagitta of the circle is not used


class Circle(NamedTuple):
    """A circular meridian between two solids."""

    middle: float  # radius in its middle
    cos_tilt: float  # of the chord
    tan_tilt: float
    half_chord: float
    cos_turn: float  # of half the turn of the slope
    sin_turn: float
    gap: float  # length along the axis
    height1: float  # of the caps
    height2: float
    shift: float  # half the difference of the contact radii


@kernel
def _height_and_slope(solid: Solid, radius: float) -> tuple[float, float, float]:
    """Height of the cap of a contact circle, and cosine and sine of the outward slope ψ there."""
    sine = min(solid.curvature * radius, _LARGEST_SINE)
    cosine = math.sqrt(1.0 - sine * sine)
    c, s = solid.cos_angle, solid.sin_angle
    return sine * radius / (1.0 + cosine), sine * c + cosine * s, cosine * c - sine * s


@kernel
def circle_between(held: Held, separation: float, radius: float, shift: float) -> Circle:
    """Circular meridian from a contact circle of radius Y - shift to one of Y + shift."""
    height1, cos1, sin1 = _height_and_slope(held.first, radius - shift)
    height2, cos2, sin2 = _height_and_slope(held.second, radius + shift)
    gap = separation + height1 + height2
    x, y = cos1 + cos2, sin1 + sin2
    size = math.sqrt(x * x + y * y)
    inverse = 1.0 / max(size, 1e-9)
    cos_turn, sin_turn = x * inverse, y * inverse
    across = sin2 * cos_turn - cos2 * sin_turn
    cosine = max(0.5 * size, _LEAST_COSINE)
    tangent = choose(0.5 * size > _LEAST_COSINE, across / cosine, choose(across > 0.0, 1.0, -1.0))
    half_chord = 0.5 * gap / cosine
    sagitta = half_chord * choose(cos_turn > _DEEPEST_BEND, sin_turn / max(1.0 + cos_turn, 1.0 + _DEEPEST_BEND), 0.0)
    most = _FARTHEST_SHIFT * radius
    return Circle(
        max(radius - sagitta * cosine, _THINNEST_MIDDLE * radius),
        cosine,
        tangent,
        half_chord,
        cos_turn,
        sin_turn,
        gap,
        height1,
        height2,
        max(-most, min(most, 0.5 * gap * tangent)),
    )


class Start(NamedTuple):
    """A meridian to start from."""

    middle: float  # radius in its middle
    cos_tilt: float  # of the slope there
    tan_tilt: float
    half_length: float
    turn: float  # ω


@kernel
def _half_turn(circle: Circle) -> float:
    """Half the turn of the slope, to three digits."""
    rise, run = abs(circle.sin_turn), 1.0 + circle.cos_turn
    t = min(rise, run) / max(rise, run)  # tangent of a quarter of the turn, or of what it lacks to 45 degrees twice
    square = t * t
    half = t * (1.99957 + square * (-0.65147 + square * (0.31077 + square * -0.0884)))
    half = choose(rise > run, math.pi - half, half)
    return choose(circle.sin_turn < 0.0, -half, half)


@kernel
def _arc_of(circle: Circle, half_turn: float) -> float:
    """Half length of a circular arc over its half chord: x/sin x."""
    is_bent = abs(half_turn) > _STRAIGHT
    return circle.half_chord * choose(is_bent, half_turn / choose(is_bent, circle.sin_turn, 1.0), 1.0)


@kernel
def _bend_of(circle: Circle) -> float:
    """(x/sin x + cos x)/2 of the half turn x: the sine of the slope over the half length, averaged."""
    return _bend(_half_turn(circle), circle.sin_turn, circle.cos_turn)


@kernel
def _bend(half_turn: float, sine: float, cosine: float) -> float:
    is_bent = abs(half_turn) > _STRAIGHT
    return choose(is_bent, 0.5 * (half_turn / choose(is_bent, sine, 1.0) + cosine), 1.0)


@kernel
def _grown(exponent: float, most: float) -> float:
    """About the exponential of a number, which is kept between -most and most."""
    half = 0.5 * max(-most, min(most, exponent))
    return (1.0 + half) / (1.0 - half)


@kernel
def start_at_volume(held: Held, separation: float) -> Start:
    """Meridian of a bridge that holds about the volume at a separation."""
    volume = held.value
    mean = 0.5 * (held.first.curvature + held.second.curvature)
    radius = math.sqrt(2.0 * volume / (separation + math.sqrt(separation * separation + 2.0 * mean * volume)))
    circle = circle_between(held, separation, radius, 0.0)
    shift, middle, gap = circle.shift, circle.middle, circle.gap
    h1, h2 = circle.height1, circle.height2
    caps = h1 * (3.0 * radius * radius + h1 * h1) + h2 * (3.0 * radius * radius + h2 * h2)
    inside = (gap * (2.0 * (radius * radius + shift * shift) + 4.0 * middle * middle) - caps) / 6.0
    is_some = inside > 0.05 * volume
    logarithm = 2.0 * (volume - inside) / (volume + choose(is_some, inside, volume))  # of their ratio, about
    radius = radius * choose(is_some, _grown(logarithm / (2.0 + 2.0 * (h1 + h2) / gap), 0.5), 1.3)
    circle = circle_between(held, separation, radius, shift)
    half_turn = _half_turn(circle)
    length = _arc_of(circle, half_turn)
    turn = half_turn - circle.cos_tilt * length / circle.middle
    return Start(circle.middle, circle.cos_tilt, circle.tan_tilt, length, max(-_MOST_TURN, min(_MOST_TURN, turn)))


class Torus(NamedTuple):
    """The balance of a torus between two solids, whose second curvature is 1/Y: D = (C - BY)Y/(HY + β) - k̄Y²."""

    mean: float  # k̄
    cosines: float  # C = Σ cos θ
    sines: float  # B = Σ k sin θ
    bend: float  # β of the half turn x = (π - θ1 - θ2)/2, (x/sin x + cos x)/2


@kernel
def _torus_between(one: Solid, other: Solid) -> Torus:
    cosines, across = one.cos_angle + other.cos_angle, one.sin_angle + other.sin_angle
    size = math.sqrt(across * across + cosines * cosines)
    sine, cosine = cosines / size, across / size
    half_turn = 0.5 * (math.pi - one.contact_angle - other.contact_angle)
    return Torus(
        0.5 * (one.curvature + other.curvature),
        cosines,
        one.curvature * one.sin_angle + other.curvature * other.sin_angle,
        _bend(half_turn, sine, cosine),
    )


@kernel
def _torus_radius(held: Held, separation: float) -> float:
    """Largest root Y of the torus, k̄HY³ + (k̄β + B)Y² + (DH - C)Y + βD = 0."""
    mean, cosines, sines, bend = _torus_between(held.first, held.second)
    suction = held.value
    positive = max(suction, 0.0)
    linear = mean * bend + sines
    room = max(cosines - separation * positive, 0.02 * cosines)
    radius = 2.0 * room / max(linear + math.sqrt(linear * linear + 4.0 * mean * positive * room), _TINY)
    is_lost, is_met = radius < 0.0, radius < 0.0
    for _ in range(4):
        value = ((mean * suction * radius + linear) * radius + (separation * suction - cosines)) * radius
        value += bend * separation
        rate = (3.0 * mean * suction * radius + 2.0 * linear) * radius + (separation * suction - cosines)
        is_lost = is_lost | (rate <= 0.0)
        step = choose(is_lost | is_met, 0.0, min(value / choose(rate > 0.0, rate, 1.0), 0.5 * radius))
        radius = radius - step
        is_met = is_met | is_lost | (abs(step) < 0.02 * radius)
        if every(is_met):
            break
    between_planes = bend * separation / max(cosines - separation * suction, _LEAST_ROOM)  # the one root
    return choose(mean > 0.0, choose(is_lost, 1.1 * radius, radius), between_planes)


@kernel
def start_at_suction(held: Held, separation: float, corrected: bool, widened: float) -> Start:
    """Meridian of a bridge under about the suction at a separation, with its contact circles widened by a factor."""
    suction = held.value
    one, other = held.first, held.second
    radius = _torus_radius(held, separation) * widened
    radius = choose(radius > 0.0, radius, 0.5 / max(max(one.curvature, other.curvature), _TINY))
    circle = circle_between(held, separation, radius, 0.0)
    if corrected:
        gap, heights = circle.gap, circle.height1 + circle.height2
        bend = _bend_of(circle) * circle.cos_tilt
        mean = circle.middle + (radius - circle.middle) / 3.0
        sines = 2.0 * circle.sin_turn * circle.cos_tilt  # sin ψ1 + sin ψ2
        excess = gap * (suction * mean + bend) - sines * mean
        slopes = one.curvature * one.sin_angle + other.curvature * other.sin_angle
        rate = 2.0 * heights / radius * (suction * mean + bend) + gap * suction - sines + mean * slopes
        is_steep = rate > 0.0
        exponent = choose(is_steep, -excess / (choose(is_steep, rate, 1.0) * radius), 0.0)
        radius = radius * _grown(exponent, 0.4)
        circle = circle_between(held, separation, radius, circle.shift)
    half_turn = _half_turn(circle)
    length = _arc_of(circle, half_turn)
    turn = suction * length
    # an arc that would turn farther is cut
    cut = _MOST_TURN / max(abs(turn), _MOST_TURN)
    return Start(circle.middle, circle.cos_tilt, circle.tan_tilt, length * cut, turn * cut)


@kernel
def start_at(held: Held, separation: float) -> Start:
    """Meridian of a bridge at a separation that holds about what is held."""
    if held.control == SUCTION:
        return start_at_suction(held, separation, True, 1.0)
    return start_at_volume(held, separation)


@kernel
def _meridian_of(start: Start) -> Four:
    return Four(math.log(start.middle), math.atan(start.tan_tilt), math.log(start.half_length), start.turn)


@kernel
def guess_at_suction(held: Held, separation: float, widened: float) -> Four:
    """Meridian of a bridge under about the suction at a separation, with its contact circles widened by a factor."""
    return _meridian_of(start_at_suction(held, separation, True, widened))


@kernel
def guess_at(held: Held, separation: float) -> Four:
    """Meridian of a bridge at a separation that holds about what is held."""
    return _meridian_of(start_at(held, separation))


# ln(D_c/V^(1/3)) at a volume, fitted to 20000 exact ruptures: products of two of
# (1, (θ1+θ2)/2, |θ1-θ2|, V^(1/3)/R̄, κ², (θ1-θ2)κ) with κ = (k1-k2)/(k1+k2).
_RUPTURE_FIT = (
    (0.0677, 0.3019, -0.3501, -0.1807, -0.0689, -0.1384),
    (0.0, -0.0748, -0.2517, 0.1597, 0.0246, 0.0202),
    (0.0, 0.0, 0.0229, 0.3218, 0.1480, 0.1033),
    (0.0, 0.0, 0.0, -0.0554, -0.1666, -0.5349),
    (0.0, 0.0, 0.0, 0.0, 0.0052, 0.0222),
    (0.0, 0.0, 0.0, 0.0, 0.0, -0.0655),
)
# The arc there in the same products, fitted to 60000 others: a and τ over V^(1/3), η, and the logarithm of how fast
# dD/ds over τ falls along the curve of bridges; and m in these six times the sign of θ1-θ2, times θ1-θ2 and times κ.
_AT_RUPTURE_RADIUS = (
    (0.2509, 0.0984, 0.1442, 0.0936, 0.0118, 0.0044),
    (0.0, 0.0228, -0.0542, -0.0158, 0.0024, -0.0006),
    (0.0, 0.0, -0.0854, 0.0748, -0.025, -0.0088),
    (0.0, 0.0, 0.0, -0.028, -0.1014, -0.1283),
    (0.0, 0.0, 0.0, 0.0, -0.0033, -0.0026),
    (0.0, 0.0, 0.0, 0.0, 0.0, 0.0108),
)
_AT_RUPTURE_WIDTH = (
    (1.2107, -0.8479, -0.2494, 0.015, -0.0542, -0.0456),
    (0.0, 0.4254, -0.2347, 0.1439, 0.0101, -0.0208),
    (0.0, 0.0, 0.2641, 0.3009, 0.1228, 0.0439),
    (0.0, 0.0, 0.0, -0.0179, -0.2196, -0.1728),
    (0.0, 0.0, 0.0, 0.0, 0.0123, 0.0194),
    (0.0, 0.0, 0.0, 0.0, 0.0, -0.0627),
)
_AT_RUPTURE_ETA = (
    (0.2268, -1.0912, 0.7566, -1.21, 0.1212, 0.1423),
    (0.0, -0.1252, 0.3997, 0.1031, -0.0381, -0.0087),
    (0.0, 0.0, -0.3122, -0.9511, -0.2445, -0.0851),
    (0.0, 0.0, 0.0, 0.2537, 0.7753, 1.0457),
    (0.0, 0.0, 0.0, 0.0, -0.0255, -0.0408),
    (0.0, 0.0, 0.0, 0.0, 0.0, 0.1177),
)
_AT_RUPTURE_FALL = (
    (-2.0734, 4.029, -1.5674, 1.2115, -0.0604, -0.3882),
    (0.0, -1.4842, 1.0155, -0.4728, 0.1761, 0.3803),
    (0.0, 0.0, -0.5159, 1.2585, 0.0649, 0.0176),
    (0.0, 0.0, 0.0, -0.8708, -0.4618, -0.9598),
    (0.0, 0.0, 0.0, 0.0, -0.0863, -0.0712),
    (0.0, 0.0, 0.0, 0.0, 0.0, -0.1484),
)
_AT_RUPTURE_SLOPE = (
    (0.4499, -0.1072, 1.0606, -0.3042, -0.0662, -0.1672),
    (1.0606, -1.1201, -0.0195, -0.5937, 0.0619, 0.2945),
    (0.2325, -0.1869, -0.1672, 1.5244, 0.0239, 0.0619),
)
_LARGEST_FITTED = 1.3  # V^(1/3)/R̄
_LEAST_FITTED = 0.1  # a and τ over V^(1/3)
_WIDEST_FITTED = 2.0  # |η|


class _Terms(NamedTuple):
    """What ruptures at a volume are fitted in."""

    one: float
    mean_angle: float
    apart: float  # the angles
    size: float  # V^(1/3)/R̄
    unlike: float  # κ²
    aligned: float  # (θ1-θ2)κ


@kernel
def _terms_of(held: Held, difference: float, kappa: float, size: float) -> _Terms:
    one, other = held.first, held.second
    return _Terms(
        1.0,
        0.5 * (one.contact_angle + other.contact_angle),
        abs(difference),
        size * 0.5 * (one.curvature + other.curvature),
        kappa * kappa,
        difference * kappa,
    )


@kernel
def _kappa_of(held: Held) -> float:
    """(k1-k2)/(k1+k2)."""
    total = held.first.curvature + held.second.curvature
    return (held.first.curvature - held.second.curvature) / total if total > 0.0 else 0.0


@kernel
def _fitted(table: Table, terms: _Terms) -> float:
    """Sum of the products of two terms."""
    total = 0.0
    for i in range(6):
        for j in range(i, 6):
            total += table[i][j] * terms[i] * terms[j]
    return total


@kernel
def _size_of(held: Held) -> float:
    """V^(1/3)."""
    return (math.pi * held.value) ** (1.0 / 3.0)


@kernel
def rupture_at_volume(held: Held) -> float:
    """Rupture distance at a volume, within about a fifth for angles up to 90° and V up to R̄³."""
    size, difference = _size_of(held), held.first.contact_angle - held.second.contact_angle
    return size * math.exp(_fitted(_RUPTURE_FIT, _terms_of(held, difference, _kappa_of(held), size)))


@kernel
def arc_at_rupture(held: Held) -> tuple[Arc, float]:
    """The arc at rupture at a volume, about, and how fast dD/ds over τ falls there.

    Its radius is 0 where none was fitted.
    """
    size, difference, kappa = _size_of(held), held.first.contact_angle - held.second.contact_angle, _kappa_of(held)
    terms = _terms_of(held, difference, kappa, size)
    if min(held.first.cos_angle, held.second.cos_angle) < -1e-9 or terms.size > _LARGEST_FITTED:
        return NOWHERE, 0.0
    sign = (1.0 if difference > 0.0 else 0.0) - (1.0 if difference < 0.0 else 0.0)
    slope = 0.0
    for j in range(6):
        slope += terms[j] * (
            _AT_RUPTURE_SLOPE[0][j] * sign + _AT_RUPTURE_SLOPE[1][j] * difference + _AT_RUPTURE_SLOPE[2][j] * kappa
        )
    arc = Arc(
        size * max(_fitted(_AT_RUPTURE_RADIUS, terms), _LEAST_FITTED),
        slope,
        size * max(_fitted(_AT_RUPTURE_WIDTH, terms), _LEAST_FITTED),
        max(-_WIDEST_FITTED, min(_WIDEST_FITTED, _fitted(_AT_RUPTURE_ETA, terms))),
    )
    return arc, math.exp(_fitted(_AT_RUPTURE_FALL, terms))


@kernel
def rupture_at_suction(held: Held) -> float:
    """Rupture distance at a suction: the largest D = (C - BY) Y/(HY + β) - k̄Y² of the torus of the guess."""
    mean, cosines, sines, bend = _torus_between(held.first, held.second)
    suction = max(held.value, 0.0)
    radius = cosines / (2.0 * (sines + mean * bend))
    if suction > 0.0:
        radius = min(radius, (0.5 * cosines * bend / (mean * suction * suction)) ** (1.0 / 3.0))
    for _ in range(6):
        u = suction * radius + bend
        value = (
            (cosines - 2.0 * sines * radius) * bend - sines * suction * radius * radius - 2.0 * mean * radius * u * u
        )
        rate = -2.0 * sines * u - 2.0 * mean * u * u - 4.0 * mean * radius * u * suction
        radius = max(radius - value / rate, 0.2 * radius)
    return (cosines - sines * radius) * radius / (suction * radius + bend) - mean * radius * radius


@kernel
def rupture_guess(held: Held) -> float:
    """Rupture distance, about."""
    return rupture_at_suction(held) if held.control == SUCTION else rupture_at_volume(held)
