"""A curve of bridges that hold one thing: the bridges on it, its tangent, a step along it, and the rule of folds.

Along a curve of bridges at one suction or one volume the separation turns where, and only where, the number of unstable
directions changes, by one. A step that breaks this rule has leapt to another curve. A bridge between mirror images is
kept symmetric; it may lose its symmetry as well, at a pitchfork, where an antisymmetric direction becomes unstable and
the separation does not turn.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from .algebra import Four, dot, minors, moved, normal, scaled, solve4, unit_vector
from .clearance import opening_of
from .equations import SUCTION, VOLUME, Held, System, first_row, held_row, system_at
from .stability import ladder_at

MOST_CORRECTIONS = 6
CLOSED = 1e-6  # contact circle over ℓ at which it has closed
_LARGEST_CORRECTION = 0.4  # over the step
_LEAST_COSINE = 0.95  # of the turn of the tangent in a step
_SMALL_CORRECTION = 1e-9
_LEFT = 1e-16  # largest correction that would follow
_STALLED = 0.1  # of the correction before: one that is rounding


class Stance(NamedTuple):
    """A bridge on a curve, and where the curve goes from it."""

    z: Four
    tangent: Four
    separation: float
    slope: float  # dD/ds over ℓ
    unstable: int  # directions in which the energy falls, under what is held
    margin: float  # of a symmetric bridge against the antisymmetric direction: it changes its sign there; else 1
    opening: float  # the smaller contact circle over ℓ; negative past the far pole of a solid, or for an arc wound up


class Curve(NamedTuple):
    """A curve of bridges that hold one thing, and the sense in which it is followed."""

    held: Held
    symmetric: bool  # kept so, between mirror images
    hand: float


@kernel
def stance_at(z: Four, curve: Curve) -> Stance:
    """The bridge at a point of a curve."""
    held, symmetric = curve.held, curve.symmetric
    system = system_at(z, held, True, True)
    rows = minors(first_row(z, system, symmetric).rates, system.contact2.rates)
    tangent = scaled(curve.hand, unit_vector(normal(rows, held_row(z, system, held).rates)))
    return stance_of(z, system, tangent, opening_of(z, system, held), curve)


@kernel
def stance_of(z: Four, system: System, tangent: Four, opening: float, curve: Curve) -> Stance:
    """The bridge at a point whose system and tangent are known."""
    ladder = ladder_at(z, system)
    return Stance(
        z,
        tangent,
        system.separation.value,
        dot(tangent, system.separation.rates) * math.exp(-z.log_length),
        ladder.at_suction if curve.held.control == SUCTION else ladder.at_volume,
        system.contact2.rates.slope if curve.symmetric else 1.0,
        opening,
    )


@kernel
def with_unstable(stance: Stance, unstable: int) -> Stance:
    """A stance whose stability is known from its neighbours: next to a fold its own is the sign of a rounding error."""
    return Stance(stance.z, stance.tangent, stance.separation, stance.slope, unstable, stance.margin, stance.opening)


@kernel
def set_out(z: Four, held: Held, symmetric: bool, going: float) -> tuple[Stance, Curve]:
    """A bridge, and the curve through it followed so that D grows (going > 0) or falls at first."""
    curve = Curve(held, symmetric, 1.0)
    stance = stance_at(z, curve)
    if stance.slope * going < 0.0:
        curve = Curve(held, symmetric, -1.0)
        stance = stance_at(z, curve)
    return stance, curve


@kernel
def corrected(z: Four, curve: Curve, along: Four) -> tuple[Four, int, float]:
    """Newton's method back to the curve in the plane normal to a direction: the point, the steps, the way moved.

    Steps are 0 where it failed.
    """
    held = curve.held
    way, before = 0.0, math.inf
    for step in range(1, MOST_CORRECTIONS + 1):
        system = system_at(z, held, True, held.control == VOLUME)
        first, row = first_row(z, system, curve.symmetric), held_row(z, system, held)
        change, _ = solve4(
            first.rates,
            system.contact2.rates,
            row.rates,
            along,
            -first.value,
            -system.contact2.value,
            -row.value,
            0.0,
        )
        size = math.sqrt(dot(change, change))
        if not size < 2.0:
            return z, 0, way
        z = moved(z, 1.0, change)
        way += size
        # where a contact circle is small, what is left after a step is its square by a large factor, or rounding
        if size < _SMALL_CORRECTION and (size * (size / before) ** 2 < _LEFT or size > _STALLED * before):
            return z, step, way
        before = size
    return z, 0, way


@kernel
def stance_after(start: Stance, step: float, curve: Curve) -> tuple[Stance, bool]:
    """The bridge a step further, and whether there is one."""
    z, steps, _way = corrected(moved(start.z, step, start.tangent), curve, start.tangent)
    return stance_at(z, curve), steps > 0


@kernel
def _obeys(before: Stance, after: Stance) -> bool:
    """The rule of folds."""
    folds = before.slope * after.slope < 0.0
    forks = before.margin * after.margin < 0.0
    if folds and forks:
        return False
    return abs(after.unstable - before.unstable) == (1 if folds or forks else 0)


@kernel
def stride(start: Stance, step: float, curve: Curve) -> tuple[Stance, bool, bool]:
    """One step along a curve: where it leads, whether it can be trusted, and whether the next may be longer."""
    z, steps, way = corrected(moved(start.z, step, start.tangent), curve, start.tangent)
    if steps == 0 or way > _LARGEST_CORRECTION * step:
        return start, False, False
    after = stance_at(z, curve)
    cosine = dot(start.tangent, after.tangent)
    trusted = after.opening < CLOSED or (cosine > _LEAST_COSINE and _obeys(start, after))
    return after, trusted, steps <= 3 and cosine > 0.99
