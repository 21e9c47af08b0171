r"""The curve of bridges under a load that grows: separation and what is held go from one pair of values to another.

With a share t of the load, D = D0 + t ΔD and c = c0 + t Δc, where c is what is held. Bridges on the way obey the rows
of both contact lines and one that says that D and c are in step; a fourth row along the tangent makes of a fold in t,
at which the bridge breaks, a point like any other.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from .algebra import Four, dot, minors, moved, normal, scaled, solve4, unit_vector
from .clearance import opening_of
from .equations import SUCTION, VOLUME, System, curvature_of
from .lines import Lines, angle_of, angle_rate, first_row_on, held_at, motion_of, system_on
from .meridian import Row
from .stability import ladder_at

MOST_CORRECTIONS = 8
CLOSED = 1e-6  # contact circle over ℓ at which it has closed
_LEFT = 1e-16
_STALLED = 0.1
_SMALL_CORRECTION = 1e-9
_LARGEST_CORRECTION = 0.4  # over the step
_LEAST_COSINE = 0.95
_FLAT = 1e-6  # slope or margin where the signs of the ladder are those of rounding errors


class Load(NamedTuple):
    """A load that grows by its share t from 0 to 1; ``value`` is H, or V/π."""

    control: int
    separation: float
    value: float
    more_separation: float
    more_value: float
    length: float  # units of both
    unit: float


class Moment(NamedTuple):
    """A bridge under a share of a load, and where it goes from there."""

    z: Four
    tangent: Four
    share: float  # t
    slope: float  # dt/ds
    unstable: int
    margin: float  # of a symmetric bridge against the antisymmetric direction, else 1
    opening: float  # the smaller contact circle over ℓ; negative past the far pole of a solid, or for an arc wound up
    angle1: float
    angle2: float
    turning1: float  # rates of the angles
    turning2: float
    motion1: float  # rates of the ways of the lines, outwards
    motion2: float


class Rows(NamedTuple):
    """The two rows of a load: D and c in step, and the share t."""

    step: Row
    share: Row


@kernel
def load_between(z: Four, control: int, start: tuple[float, float], end: tuple[float, float]) -> Load:
    """The load from one separation and value to another, in units of a meridian on the way."""
    length = math.exp(z.log_length)
    unit = 1.0 / length if control == SUCTION else start[1]
    return Load(control, start[0], start[1], end[0] - start[0], end[1] - start[1], length, unit)


@kernel
def _held_of(z: Four, system: System, control: int) -> Row:
    """H, or V/π."""
    if control == VOLUME:
        return system.volume
    curvature = curvature_of(z)
    return Row(curvature, Four(0.0, 0.0, -curvature, math.exp(-z.log_length)))


@kernel
def load_rows(z: Four, system: System, load: Load) -> Rows:
    """Both rows at a meridian."""
    gap, held = system.separation, _held_of(z, system, load.control)
    along, across = load.more_separation / load.length, load.more_value / load.unit
    size = math.sqrt(along * along + across * across)
    by_gap, by_held = across / (size * load.length), -along / (size * load.unit)
    gap_share = along / (size * size * load.length)
    held_share = across / (size * size * load.unit)
    more_gap, more_held = gap.value - load.separation, held.value - load.value
    return Rows(
        Row(by_gap * more_gap + by_held * more_held, moved(scaled(by_gap, gap.rates), by_held, held.rates)),
        Row(gap_share * more_gap + held_share * more_held, moved(scaled(gap_share, gap.rates), held_share, held.rates)),
    )


@kernel
def moment_at(z: Four, lines: Lines, load: Load, hand: float) -> Moment:
    """The bridge at a point of the curve of a load, followed in the sense of ``hand``; 0 is that of a growing share."""
    system = system_on(z, lines, True, True)
    rows = load_rows(z, system, load)
    rings = minors(first_row_on(z, system, lines).rates, system.contact2.rates)
    tangent = unit_vector(normal(rings, rows.step.rates))
    slope = dot(tangent, rows.share.rates)
    if hand < 0.0 or (hand == 0.0 and slope < 0.0):
        tangent, slope = scaled(-1.0, tangent), -slope
    ladder = ladder_at(z, system)
    first, second = system.first, system.second
    held = held_at(lines, first, second, load.control, load.value)
    return Moment(
        z,
        tangent,
        rows.share.value,
        slope,
        ladder.at_suction if load.control == SUCTION else ladder.at_volume,
        system.contact2.rates.slope if lines.symmetric else 1.0,
        opening_of(z, system, held),
        angle_of(lines.first, first),
        angle_of(lines.second, second),
        angle_rate(lines.first, first, tangent),
        angle_rate(lines.second, second, tangent),
        motion_of(lines.first, first, tangent),
        motion_of(lines.second, second, tangent),
    )


@kernel
def hand_of(moment: Moment, lines: Lines, load: Load) -> float:
    """The sense in which a moment goes along its curve."""
    return 1.0 if dot(moment_at(moment.z, lines, load, 1.0).tangent, moment.tangent) > 0.0 else -1.0


@kernel
def corrected_on(z: Four, lines: Lines, load: Load, along: Four) -> tuple[Four, bool, float]:
    """Newton's method back to the curve in the plane normal to a direction, whether it was met, and the way moved."""
    way, before = 0.0, math.inf
    for _ in range(MOST_CORRECTIONS):
        system = system_on(z, lines, True, True)
        first, step = first_row_on(z, system, lines), load_rows(z, system, load).step
        change, _det = solve4(
            first.rates,
            system.contact2.rates,
            step.rates,
            along,
            -first.value,
            -system.contact2.value,
            -step.value,
            0.0,
        )
        size = math.sqrt(dot(change, change))
        if not size < 2.0:
            return z, False, way
        z = moved(z, 1.0, change)
        way += size
        if size < _SMALL_CORRECTION and (size * (size / before) ** 2 < _LEFT or size > _STALLED * before):
            return z, True, way
        before = size
    return z, False, way


@kernel
def moment_after(start: Moment, step: float, lines: Lines, load: Load, hand: float) -> tuple[Moment, bool]:
    """The bridge a step further, and whether there is one."""
    z, is_met, _way = corrected_on(moved(start.z, step, start.tangent), lines, load, start.tangent)
    return moment_at(z, lines, load, hand), is_met


@kernel
def _obeys(before: Moment, after: Moment) -> bool:
    """The rule of folds, from a stable bridge on: its index is the number of folds and forks passed."""
    folds = 1 if after.slope < 0.0 else 0
    forks = 1 if before.margin * after.margin < 0.0 else 0
    if abs(after.slope) < _FLAT * abs(before.slope) or abs(after.margin) < _FLAT * abs(before.margin):
        return True
    return after.unstable == folds + forks


@kernel
def step_on(start: Moment, step: float, lines: Lines, load: Load, hand: float) -> tuple[Moment, bool]:
    """One step along the curve of a load: where it leads, and whether it can be trusted."""
    z, is_met, way = corrected_on(moved(start.z, step, start.tangent), lines, load, start.tangent)
    if not is_met or way > _LARGEST_CORRECTION * step:
        return start, False
    after = moment_at(z, lines, load, hand)
    if after.opening < CLOSED:
        return after, True
    return after, dot(start.tangent, after.tangent) > _LEAST_COSINE and _obeys(start, after)


@kernel
def arrived_on(z: Four, lines: Lines, load: Load) -> Four:
    """The bridge under the whole load, from one that is very near."""
    before = 1e-3
    for _ in range(MOST_CORRECTIONS):
        system = system_on(z, lines, True, True)
        first, gap, held = first_row_on(z, system, lines), system.separation, _held_of(z, system, load.control)
        change, _det = solve4(
            first.rates,
            system.contact2.rates,
            scaled(1.0 / load.length, gap.rates),
            scaled(1.0 / load.unit, held.rates),
            -first.value,
            -system.contact2.value,
            (load.separation + load.more_separation - gap.value) / load.length,
            (load.value + load.more_value - held.value) / load.unit,
        )
        size = math.sqrt(dot(change, change))
        if not size < 0.5 * before:  # next to a fold, where shares are all the same, none is of use
            break
        z, before = moved(z, 1.0, change), size
        if size == 0.0:
            break
    return z
