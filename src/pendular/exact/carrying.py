"""A bridge carried through a load: what its contact lines do, what happens on the way, and where it breaks.

Where a line may stay or slide, it does what the load makes it do: a line that slides moves outwards at its advancing
and inwards at its receding angle, one that stays has its angle between the two, and the bridge is stable with those
lines free that slide. The share of the load at which one begins to slide, or stops, or the bridge breaks is found, not
stepped over.
"""

from typing import NamedTuple

from ..ground.compile import kernel
from .algebra import Four, dot
from .bracket import MOST_NARROWINGS, Bracket, is_narrow, narrowed, secant_of
from .lines import FREE, PINNED, RECEDING, Line, Lines, has_choice, placed, set_sliding, slid_on, with_limit
from .loading import CLOSED, Load, Moment, arrived_on, hand_of, moment_after, moment_at, step_on
from .meridian import ends_of
from .search import are_alike

# What may happen on the way, in this order where it happens at once; and how else a bridge may end.
ARRIVED, FOLD, PITCHFORK, UP1, DOWN1, UP2, DOWN2, STOP1, STOP2 = 0, 1, 2, 3, 4, 5, 6, 7, 8
UNSTABLE, CLOSES, TOUCHES, LOST = 9, 10, 11, 12
_EVENTS = 9

_FIRST_STEP, _LONGEST_STEP, _SHORTEST_STEP = 0.05, 0.3, 1e-9
_MOST_STEPS, _MOST_EVENTS = 2000, 60
_REACHED = 1e-12  # of an angle, past its limit
_AT_LIMIT = 1e-9  # of an angle that is at its limit
_AT_REST = 1e-9  # of a rate that is none
_MIRRORED = 1e-7  # slope in the middle of a bridge that is symmetric but for what it has gone through
_SURE_STEP = 1e-4  # below which nothing happens within a step and is over at its end
_NEARLY_CLOSED = 1e-2
_VANISHES = 1e-15


class Choice(NamedTuple):
    """What both lines do, and where that leads."""

    lines: Lines
    moment: Moment
    hand: float
    is_found: bool


@kernel
def _may(line: Line, turning: float, motion: float) -> bool:
    """Whether a line may do what it does."""
    if line.mode == FREE:
        return True
    if line.mode == PINNED:
        return line.limit * turning < _AT_REST
    return (motion if line.mode != RECEDING else -motion) > -_AT_REST


@kernel
def _mirrored(z: Four, one: Line, other: Line) -> bool:
    """Whether two lines slide on mirror images, from a bridge that is symmetric."""
    slide_alike = one.mode == other.mode and one.mode != PINNED
    return slide_alike and abs(z.slope) < _MIRRORED and are_alike(slid_on(one), slid_on(other))


@kernel
def _choose(z: Four, lines: Lines, load: Load, stays1: bool, stays2: bool, parts: bool) -> Choice:
    """What the lines do under a load: both slide if they can, else one, else none."""
    first, second = lines.first, lines.second
    rest = Lines(set_sliding(first, False), set_sliding(second, False), lines.symmetric and not parts)
    may1, may2 = has_choice(first) and not stays1, has_choice(second) and not stays2
    if rest.symmetric:
        may1 = may2 = may1 and may2
    for attempt in range(4):
        slides1, slides2 = may1 and attempt in (0, 1), may2 and attempt in (0, 2)
        if parts and slides1 and slides2:
            continue
        one, other = set_sliding(first, slides1), set_sliding(second, slides2)
        alike = rest.symmetric and slides1 == slides2
        tried = Lines(one, other, alike or (not parts and _mirrored(z, one, other)))
        moment = moment_at(z, tried, load, 0.0)
        if (
            moment.unstable == 0
            and _may(tried.first, moment.turning1, moment.motion1)
            and _may(tried.second, moment.turning2, moment.motion2)
        ):
            return Choice(tried, moment, hand_of(moment, tried, load), True)
    return Choice(rest, moment_at(z, rest, load, 0.0), 1.0, False)


@kernel
def _excess(event: int, moment: Moment, lines: Lines) -> float:
    """What is positive before an event, and negative after it."""
    if event == ARRIVED:
        return 1.0 - moment.share
    if event == FOLD:
        return moment.slope
    if event == PITCHFORK:
        return moment.margin
    if event == UP1:
        return lines.first.advancing.contact_angle - moment.angle1
    if event == DOWN1:
        return moment.angle1 - lines.first.receding.contact_angle
    if event == UP2:
        return lines.second.advancing.contact_angle - moment.angle2
    if event == DOWN2:
        return moment.angle2 - lines.second.receding.contact_angle
    if event == STOP1:
        return moment.motion1 if lines.first.mode != RECEDING else -moment.motion1
    return moment.motion2 if lines.second.mode != RECEDING else -moment.motion2


@kernel
def _occurs(event: int, start: Moment, after: Moment, lines: Lines) -> bool:
    """Whether an event lies between two moments."""
    if event == PITCHFORK:
        return lines.symmetric and start.margin * after.margin < 0.0
    value = _excess(event, after, lines)
    if event in (ARRIVED, FOLD):
        return value < 0.0
    line = lines.first if event in (UP1, DOWN1, STOP1) else lines.second
    if line.mode == FREE:
        return False
    if event in (STOP1, STOP2):
        return line.mode != PINNED and value < 0.0
    return line.mode == PINNED and value < -_REACHED


@kernel
def _locate(event: int, start: Moment, step: float, end: Moment, choice: Choice, load: Load) -> tuple[Moment, float]:
    """The event between the start and the end of a step, by the Illinois rule, and the length to it."""
    lines, hand = choice.lines, choice.hand
    bracket = Bracket(0.0, step, _excess(event, start, lines), _excess(event, end, lines), 0)
    best, length = end, step
    if (bracket.at_low > 0.0) == (bracket.at_high > 0.0):
        return start, 0.0
    for _ in range(MOST_NARROWINGS):
        middle = secant_of(bracket)
        if not bracket.low < middle < bracket.high:
            break
        best, _is_met = moment_after(start, middle, lines, load, hand)
        length = middle
        value = _excess(event, best, lines)
        bracket = narrowed(bracket, middle, value)
        if abs(value) < _VANISHES or is_narrow(bracket):
            break
    return best, length


@kernel
def _first_event(start: Moment, step: float, after: Moment, choice: Choice, load: Load) -> tuple[int, Moment]:
    """The first event within a step, -1 if there is none, and the moment there."""
    which, length = -1, step
    for _ in range(2):  # an event may come to light where another shortened the step
        for event in range(_EVENTS):
            if event != which and _occurs(event, start, after, choice.lines):
                there, way = _locate(event, start, length, after, choice, load)
                if way < length or which < 0:
                    which, after, length = event, there, way
    return which, after


@kernel
def _hides(line: Line, angle: float, rate: float, end: float, end_rate: float, step: float) -> bool:
    """Whether the angle of a pinned line may have been past a limit within a step and come back, or inside and left.

    It comes back where its tangents at both ends meet outside.
    """
    if line.mode != PINNED:
        return False
    low, high = line.receding.contact_angle, line.advancing.contact_angle
    if (high - angle < _AT_LIMIT and rate < _AT_REST and end > high + _REACHED) or (
        angle - low < _AT_LIMIT and rate > -_AT_REST and end < low - _REACHED
    ):
        return True
    if rate * end_rate >= 0.0:
        return False
    top = angle + rate * (end - angle - end_rate * step) / (rate - end_rate)
    return step > _SURE_STEP and (top > high if rate > 0.0 else top < low)


@kernel
def _hides_an_event(start: Moment, after: Moment, step: float, lines: Lines) -> bool:
    return _hides(lines.first, start.angle1, start.turning1, after.angle1, after.turning1, step) or _hides(
        lines.second, start.angle2, start.turning2, after.angle2, after.turning2, step
    )


@kernel
def _limit_of(line: Line, angle: float, reaches: int) -> Line:
    """A line that is told whether its angle is at a limit."""
    if line.mode != PINNED:
        return line
    if reaches != 0:
        return with_limit(line, reaches)
    above, below = line.advancing.contact_angle - angle, angle - line.receding.contact_angle
    if above < _AT_LIMIT:
        return with_limit(line, 1)
    return with_limit(line, -1 if below < _AT_LIMIT else 0)


@kernel
def _settled(lines: Lines, moment: Moment, event: int) -> Lines:
    """The lines at a moment, where an event may have brought one to its limit."""
    first, second = ends_of(moment.z)
    lines = placed(lines, first, second)
    reaches1 = 1 if event == UP1 else (-1 if event == DOWN1 else 0)
    reaches2 = 1 if event == UP2 else (-1 if event == DOWN2 else 0)
    if lines.symmetric:
        reaches1 = reaches2 = reaches1 if reaches1 != 0 else reaches2
    return Lines(
        _limit_of(lines.first, moment.angle1, reaches1),
        _limit_of(lines.second, moment.angle2, reaches2),
        lines.symmetric,
    )


class Leg(NamedTuple):
    """Where a load has led."""

    event: int  # ARRIVED, or how the bridge ended
    z: Four
    lines: Lines
    share: float


@kernel
def _trusted_step(start: Moment, step: float, choice: Choice, load: Load) -> tuple[Moment, float]:
    """The longest step up to a given one that can be trusted, and its length; 0 where there is none."""
    while step >= _SHORTEST_STEP:
        after, is_trusted = step_on(start, step, choice.lines, load, choice.hand)
        if is_trusted and not _hides_an_event(start, after, step, choice.lines):
            return after, step
        step *= 0.4
    return start, 0.0


@kernel
def carried(z: Four, lines: Lines, load: Load) -> Leg:
    """From a bridge through a whole load, or to where it breaks."""
    choice = _choose(z, lines, load, False, False, False)
    if not choice.is_found:
        return Leg(UNSTABLE, z, lines, 0.0)
    moment, following, events = choice.moment, _FIRST_STEP, 0
    for _ in range(_MOST_STEPS):
        ahead = 1.05 * (1.0 - moment.share) / moment.slope if moment.slope > 0.0 else _LONGEST_STEP
        after, step = _trusted_step(moment, max(min(following, ahead), _SHORTEST_STEP), choice, load)
        if step == 0.0:
            reason = CLOSES if moment.opening < _NEARLY_CLOSED else LOST
            return Leg(reason, moment.z, _settled(choice.lines, moment, -1), moment.share)
        if after.opening < CLOSED:
            return Leg(CLOSES, moment.z, _settled(choice.lines, moment, -1), moment.share)
        event, there = _first_event(moment, step, after, choice, load)
        if event < 0:
            if step >= following:
                following = min(_LONGEST_STEP, 1.6 * step) if dot(moment.tangent, after.tangent) > 0.99 else step
            else:
                following = max(step, 0.5 * following)
            moment = after
            continue
        if event == ARRIVED:
            z = arrived_on(there.z, choice.lines, load)
            end = moment_at(z, choice.lines, load, choice.hand)
            return Leg(ARRIVED, z, _settled(choice.lines, end, -1), 1.0)
        settled = _settled(choice.lines, there, event)
        if event == FOLD or (event == PITCHFORK and not has_choice(settled.first)):
            return Leg(event, there.z, settled, there.share)
        events += 1
        if events > _MOST_EVENTS:
            return Leg(LOST, there.z, settled, there.share)
        choice = _choose(there.z, settled, load, event == STOP1, event == STOP2, event == PITCHFORK)
        if not choice.is_found:
            return Leg(UNSTABLE, there.z, settled, there.share)
        moment, following = choice.moment, min(following, _FIRST_STEP)
    return Leg(LOST, moment.z, _settled(choice.lines, moment, -1), moment.share)
