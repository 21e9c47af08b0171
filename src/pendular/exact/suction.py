r"""A bridge under suction in numbers of its own, for one row or for one in each lane.

With H held, a meridian changes in three ways: :math:`1 + H\zeta` grows by the share Hα all along, and each end runs on
by a length tᵢ. Both contacts depend on α and on the run of their own end, so that Newton's step is a solution of three
equations with two zeros; and with φ the slope angle

.. math:: dX = \alpha\Big(\int\frac{ds}{Y} + HX - [\sin\varphi]\Big) + t_2\cos\varphi_2 - t_1\cos\varphi_1, \qquad
          d\ln Y = \alpha\,\varphi' + t\,\frac{\sin\varphi}{Y}, \quad
          d\varphi = t\,\varphi' - \alpha\frac{\sin\varphi}{Y}, \quad \varphi' = \frac{\cos\varphi}{Y} + H :

two sums over the arc tell its length with all rates. Nothing here decides by a branch, so that lanes may disagree.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel, summing_kernel
from ..ground.lanes import every
from .algebra import Four, dot, largest_of, scaled
from .arc import ROOM_FOR_24, W24, X24, Arc, Nodes, arc_after, chosen, force_on, has_room, ratio_of
from .clearance import extrema_between, is_beyond_doubt
from .equations import Held
from .newton import LONGEST_STEP, MOST_STEPS, NO_STEP, is_fine_step, left_after, nodes_of_step
from .solids import Solid, contact_with
from .stability import directions_at_suction

_TRIED = 0.1  # way along a curve, to see how it bends
_FARTHEST = 1.5


class Reach(NamedTuple):
    """Two sums over an arc."""

    length: float  # X over τ
    winding: float  # ∫ds/Y


class Foot(NamedTuple):
    """An end of the arc on its solid; rates are those in α and in the run of this end."""

    radius: float  # Y
    cos_slope: float  # of ψ, outwards
    sin_slope: float
    growth: float  # of ln Y by α: φ'
    run: float  # of ln Y by t: sin φ/Y
    miss: float  # of the contact
    miss_growth: float
    miss_run: float
    height: float  # of the cap
    height_growth: float
    height_run: float


class Stand(NamedTuple):
    """A meridian under suction between its solids."""

    first: Foot
    second: Foot
    length: float  # X
    length_growth: float  # its rate in α
    separation: float  # D = X - h1 - h2


class Met(NamedTuple):
    """Where Newton's method ended."""

    arc: Arc
    stand: Stand  # of the step before
    is_met: bool


@summing_kernel
def _reach_of(real: float, imag: float, h: float, x: Nodes, weight: Nodes) -> Reach:
    """Both sums, h = η/2: |N|² and the others are polynomials in v, with N the numerator of ζ."""
    length = winding = 0.0 * h  # in lanes, if that is in lanes
    run = 1.0 + h * real
    square, twist = h * h, h * imag
    least, most = real * real + imag * imag, run * run + twist * twist
    for j in range(len(x)):
        v = x[j]
        turned = 1.0 + square * (v * v)
        size = least + v * (2.0 * imag + most * v)
        share = weight[j] / (turned * math.sqrt(turned * size))
        length += share * (real - v * (2.0 * twist + h * run * v))
        winding += share * turned
    return Reach(length, winding)


@kernel
def _foot_of(arc: Arc, real: float, imag: float, h: float, side: float, curvature: float, solid: Solid) -> Foot:
    """The end on the first (side -1) or the second solid (+1)."""
    nr, ni, w = real - side * h * imag, imag + side * (1.0 + h * real), side * h
    turned = 1.0 + h * h
    inverse = 1.0 / math.sqrt(turned * (nr * nr + ni * ni))
    cosine, sine = (nr - ni * w) * inverse, (ni + nr * w) * inverse
    over = turned * inverse / arc.half_width  # 1/Y
    radius = arc.half_width * (nr * nr + ni * ni) * inverse
    growth, run = cosine * over + curvature, sine * over
    outward = side * sine
    contact = contact_with(solid, radius, cosine, outward)
    miss_turn, height_turn = side * contact.mismatch_by_slope, side * contact.height_by_slope  # rates in φ
    return Foot(
        radius,
        cosine,
        outward,
        growth,
        run,
        contact.mismatch,
        contact.mismatch_by_radius * growth - miss_turn * run,
        contact.mismatch_by_radius * run + miss_turn * growth,
        contact.height,
        contact.height_by_radius * growth - height_turn * run,
        contact.height_by_radius * run + height_turn * growth,
    )


@kernel
def stand_of(arc: Arc, held: Held, x: Nodes, weight: Nodes) -> Stand:
    """The meridian of an arc, whose η is Hτ."""
    h, curvature = 0.5 * arc.eta, held.value
    real = arc.radius / arc.half_width
    imag = real * arc.slope
    reach = _reach_of(real, imag, h, x, weight)
    first = _foot_of(arc, real, imag, h, -1.0, curvature, held.first)
    second = _foot_of(arc, real, imag, h, 1.0, curvature, held.second)
    length = arc.half_width * reach.length
    by_growth = reach.winding + curvature * length - (first.sin_slope + second.sin_slope)
    return Stand(first, second, length, by_growth, length - first.height - second.height)


@kernel
def _determinant(a1: float, b1: float, a2: float, b2: float, a3: float, e1: float, e2: float) -> float:
    """Of the rows (a1, b1, 0), (a2, 0, b2), (a3, e1, e2)."""
    return (a3 * b1 - e1 * a1) * b2 - e2 * a2 * b1


@kernel
def _step_to(stand: Stand, arc: Arc, separation: float) -> Four:
    """Newton's step to a separation, in the numbers of the arc."""
    first, second = stand.first, stand.second
    a1, b1, a2, b2 = first.miss_growth, first.miss_run, second.miss_growth, second.miss_run
    a3 = stand.length_growth - first.height_growth - second.height_growth
    e1, e2 = -first.cos_slope - first.height_run, second.cos_slope - second.height_run
    at1, at2, at3 = -first.miss, -second.miss, separation - stand.separation
    inverse = 1.0 / _determinant(a1, b1, a2, b2, a3, e1, e2)
    growth = ((at3 * b1 - e1 * at1) * b2 - e2 * at2 * b1) * inverse
    run1 = (at1 * (a3 * b2 - a2 * e2) - a1 * (at3 * b2 - at2 * e2)) * inverse
    run2 = (at2 * (a3 * b1 - a1 * e1) - a2 * (at3 * b1 - at1 * e1)) * inverse
    return _change_of(arc, growth, run1, run2)


@kernel
def _change_of(arc: Arc, growth: float, run1: float, run2: float) -> Four:
    """Changes of the numbers of an arc that grows and whose ends run on."""
    shift = 0.5 * (run1 + run2)
    turned = arc.eta / arc.half_width * arc.radius  # of 1 + Hζ in the middle
    real, imag = 1.0 + turned, turned * arc.slope
    along, across = growth * real - shift * imag, growth * imag + shift * real
    inverse = 1.0 / arc.radius
    widened = along * inverse
    lengthened = 0.5 * (run2 - run1) * (1.0 + 0.25 * arc.eta * arc.eta) / arc.half_width
    return Four(widened, across * inverse - arc.slope * widened, lengthened, arc.eta * lengthened)


@kernel
def _onwards(arc: Arc, held: Held) -> tuple[Four, float]:
    """The tangent of the curve of bridges at an arc, its largest number 1, and the rate of the separation along it."""
    stand = stand_of(arc, held, X24, W24)
    first, second = stand.first, stand.second
    a1, b1, a2, b2 = first.miss_growth, first.miss_run, second.miss_growth, second.miss_run
    change = _change_of(arc, b1 * b2, -a1 * b2, -a2 * b1)
    inverse = 1.0 / largest_of(change)
    return scaled(inverse, change), inverse * _determinant_of(stand)


@kernel
def beyond_fold(arc: Arc, held: Held) -> Arc:
    """About where the curve of bridges through an unstable one, with growing D, comes back to it beyond the fold."""
    tangent, rate = _onwards(arc, held)
    if rate < 0.0:
        tangent, rate = scaled(-1.0, tangent), -rate
    tried, later = _onwards(_moved(arc, tangent, _TRIED, held), held)
    bend = (later if dot(tangent, tried) > 0.0 else -later) - rate
    way = min(_FARTHEST, -2.0 * rate * _TRIED / bend) if bend < 0.0 else _FARTHEST
    return _moved(arc, tangent, way, held)


@kernel
def _moved(arc: Arc, direction: Four, way: float, held: Held) -> Arc:
    """The arc after a way, under the suction that is held."""
    moved = arc_after(arc, direction, way)
    return Arc(moved.radius, moved.slope, moved.half_width, held.value * moved.half_width)


@kernel
def met_at_suction(arc: Arc, separation: float, held: Held, left: float, is_near: bool) -> Met:
    """From a guess to the bridge at a separation, but for what is left; from a bridge near by on fine nodes at once."""
    is_met, before = arc.radius < 0.0, math.nan * arc.radius
    for step in range(MOST_STEPS):
        x, weight = nodes_of_step(step, is_near)
        stand = stand_of(arc, held, x, weight)
        change = _step_to(stand, arc, separation)
        size = max(largest_of(change), NO_STEP)
        moved = arc_after(arc, change, LONGEST_STEP / max(size, LONGEST_STEP))
        arc = chosen(is_met, arc, Arc(moved.radius, moved.slope, moved.half_width, held.value * moved.half_width))
        if is_fine_step(step, is_near):
            is_met = is_met | (left_after(size, before) < left)
            if every(is_met):
                break
        before = size
    return Met(arc, stand, is_met)


@kernel
def _determinant_of(stand: Stand) -> float:
    """Of the rates of both contacts and of the separation."""
    first, second = stand.first, stand.second
    return _determinant(
        first.miss_growth,
        first.miss_run,
        second.miss_growth,
        second.miss_run,
        stand.length_growth - first.height_growth - second.height_growth,
        -first.cos_slope - first.height_run,
        second.cos_slope - second.height_run,
    )


@kernel
def _directions_of(stand: Stand, extrema: float) -> float:
    """Unstable directions, by the ladder of `stability`."""
    first, second = stand.first, stand.second
    freed = stand.length_growth - first.height_growth
    held_rings = _determinant(
        first.growth, first.run, second.growth, second.run, stand.length_growth, -first.cos_slope, second.cos_slope
    )
    one_free = _determinant(
        first.miss_growth,
        first.miss_run,
        second.growth,
        second.run,
        freed,
        -first.cos_slope - first.height_run,
        second.cos_slope,
    )
    both_free = _determinant_of(stand)
    return directions_at_suction(extrema, held_rings, one_free, both_free)


@kernel
def is_stable_at_suction(met: Met, held: Held) -> bool:
    """Whether Newton's method ended beyond doubt on a stable bridge."""
    arc, first, second = met.arc, met.stand.first, met.stand.second
    necks, bulges = extrema_between(first, second)
    return (
        met.is_met
        & has_room(arc, ROOM_FOR_24)
        & (abs(_directions_of(met.stand, necks + bulges)) < 0.5)
        & is_beyond_doubt(first, second, held, necks, bulges, force_on(arc), held.value, ratio_of(arc), arc.half_width)
    )
