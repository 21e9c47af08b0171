"""What a question about two solids of any shape leads to, checked before it is given."""

import math
from collections.abc import Iterable
from typing import NamedTuple

from ..algebra import Four, moved, unit_vector
from ..answers import FAILED, FOUND, LARGEST_MISS, LOWER_END, MET, NO_BRIDGE, RUPTURE, STABLE, UNSTABLE
from ..clearance import radius_range
from ..curve import Curve, corrected
from ..equations import SUCTION, Held, system_at
from ..follow import BRANCH_ENDS, NOTHING
from ..locate import ARRIVED, ENDED, FOLD, PITCHFORK
from ..solids import Solid
from ..solids.edge import Edge, Side
from ..state import State, describe
from .pieces import is_flat
from .retold import retold
from .search import Found, Indices, Question, anchor, held_on, lies_on, rooms_at, stable_at
from .side import has_side
from .sideways import sideways_directions
from .surfaces import Surface, shape_at, wetted_area
from .travel import OFF, Journey, Leg, go_beyond, set_out, travel

SPILLED = 4  # status: the liquid would wet the sides of two discs, or run beyond a profile

_ROUNDING = 1e-15
_AT_EDGE = 1e-9  # room on an edge that is none
_MISS_OF_SEPARATION = 1e-10  # over ℓ
_BEYOND = 1e-6  # over the end of a branch, where another may go on
_MOST_BRANCHES = 4
_WIDEST = 0.2  # gap between flat faces where their curve begins, over the rupture distance
_THREAD = 0.03  # thinnest circle of a drawn bridge over the widest of its branch


class Answer(NamedTuple):
    """A status, and a bridge if one was found."""

    status: int
    state: State | None = None


_NOTHING, _FAILED, _SPILLED = Answer(NO_BRIDGE), Answer(FAILED), Answer(SPILLED)


def reaches_no_farther(question: Question) -> float:
    """A separation beyond which there is no bridge; negative if there is none at all, infinite if none is known.

    Along a meridian of the length X, sin ψ1 + sin ψ2 is HX and more. On a tip the slopes ψ are the largest.
    """
    if question.control != SUCTION or question.value < 0.0:
        return math.inf
    sines = 0.0
    for body in (question.first, question.second):
        surface = body[0].surface
        if isinstance(surface, Edge):
            sines += 1.0
        else:
            rise = shape_at(surface, 0.0)
            sines += surface.cos_angle * rise.cos_slope - surface.sin_angle * rise.sin_slope
    if sines <= _ROUNDING:
        return -1.0
    return sines / question.value if question.value > 0.0 else math.inf


def _is_plane(surface: Surface) -> bool:
    return isinstance(surface, Solid) and surface.curvature == 0.0


def _wetted(surface: Surface, radius: float, as_sphere: float) -> float:
    return as_sphere if isinstance(surface, Solid | Edge) else wetted_area(surface, radius)


def described(question: Question, on: Indices, z: Four, curve: Curve, unstable: int | None = None) -> Answer:
    """A bridge as an answer, if it holds what it should and is one; ``unstable`` where its index is known."""
    held = _with_height(z, curve.held)
    state, is_bridge, miss = retold(describe)(z, held, curve.symmetric)
    if not miss <= LARGEST_MISS:
        return _FAILED
    if not (is_bridge and lies_on(question, on, z)):
        return _NOTHING
    system = retold(system_at)(z, held, True, False)
    slides = _is_plane(held.first) and _is_plane(held.second)
    whole = state._replace(
        wetted_area1=_wetted(held.first, state.radius1, state.wetted_area1),
        wetted_area2=_wetted(held.second, state.radius2, state.wetted_area2),
        sideways_stable=1.0 if slides or sideways_directions(z, system, held) == 0 else 0.0,
    )
    return Answer(FOUND, whole if unstable is None else whole._replace(unstable_directions=float(unstable)))


def _with_height(z: Four, held: Held) -> Held:
    """What is held, with the height of a line on the side of a cylinder, which the place of its meridian depends on."""
    if not has_side(held) or held.control == SUCTION:
        return held
    height = retold(system_at)(z, held, True, True).height
    first, second = ((s._replace(height=height) if isinstance(s, Side) else s) for s in (held.first, held.second))
    return Held(first, second, held.control, held.value)


def answer_to(question: Question, asked: int, separation: float, limit: int) -> Answer:
    """The bridge, or the end of a branch, that a question asks for."""
    farthest = reaches_no_farther(question)
    if farthest < 0.0 or (asked in (STABLE, UNSTABLE) and separation > farthest * (1.0 + _ROUNDING)):
        return _NOTHING
    if asked == STABLE:
        return _stable(question, separation, limit)
    if asked == LOWER_END:
        start = anchor(question)
        return _FAILED if start is None else _end(question, asked, _down(question, start[0], limit, 0.0))
    last = _last(question, limit)
    if last is None:
        return _FAILED
    top = last.top
    if asked == RUPTURE:
        return _end(question, asked, top)
    if top.event not in (FOLD, PITCHFORK):
        return _SPILLED if top.event == OFF else _FAILED
    if separation >= top.stance.separation:
        return _NOTHING
    return _arrived(question, travel(question, go_beyond(question, top), separation, NOTHING), separation)


def _stable(question: Question, separation: float, limit: int) -> Answer:
    """The stable bridge at a separation, of several that of the least energy."""
    answer = _least(question, stable_at(question, separation))
    if answer.status == FOUND:
        return answer
    last = _last(question, limit)
    if last is None:
        answer = _least(question, stable_at(question, separation, thoroughly=True))
        return answer if answer.status == FOUND else _FAILED
    top, start, place = last
    if separation >= top.stance.separation:
        return _arrived(question, top, separation)
    stance, curve = set_out(question, start, 1.0 if separation > place else -1.0)
    return _arrived(question, travel(question, (stance, curve, start.on), separation, limit), separation)


def _least(question: Question, bridges: Iterable[Found]) -> Answer:
    """Of bridges that were found, that of the least energy."""
    answers = [described(question, found.on, found.z, set_out(question, found, 1.0)[1]) for found in bridges]
    energies = [(_energy(question, one.state), i) for i, one in enumerate(answers) if one.state is not None]
    return answers[min(energies)[1]] if energies else _NOTHING


def _energy(question: Question, state: State) -> float:
    """Surface energy over γ against dry solids, and that of the pressure where it is held."""
    cosines = [body[0].surface.cos_angle for body in (question.first, question.second)]
    energy = state.area - cosines[0] * state.wetted_area1 - cosines[1] * state.wetted_area2
    return energy + (state.curvature * state.volume if question.control == SUCTION else 0.0)


class _Last(NamedTuple):
    """The end of the last stable branch, and a bridge on that branch with its separation."""

    top: Journey
    start: Found
    place: float


def _last(question: Question, limit: int) -> _Last | None:
    """Up to the end of the stable branch, and of those that go on beyond it; None if no stable bridge is known."""
    known = anchor(question)
    if known is None:
        return None
    last = _Last(_up(question, known[0], limit), *known)
    for _ in range(_MOST_BRANCHES if limit == BRANCH_ENDS and last.top.event in (FOLD, PITCHFORK) else 0):
        beyond = last.top.stance.separation * (1.0 + _BEYOND)
        for found in stable_at(question, beyond):
            further = _up(question, found, limit)
            if further.event in (FOLD, PITCHFORK) and further.stance.separation >= beyond:
                last = _Last(further, found, beyond)
                break
        else:
            break
    return last


def _up(question: Question, found: Found, limit: int) -> Journey:
    stance, curve = set_out(question, found, 1.0)
    return travel(question, (stance, curve, found.on), math.nan, limit)


def _down(question: Question, found: Found, limit: int, target: float) -> Journey:
    stance, curve = set_out(question, found, -1.0)
    return travel(question, (stance, curve, found.on), target, limit)


def _arrived(question: Question, journey: Journey, separation: float) -> Answer:
    """The bridge at a separation at which a journey arrived."""
    stance = journey.stance
    miss = abs(stance.separation - separation) * math.exp(-stance.z.log_length)
    if journey.event == ARRIVED and miss > _MISS_OF_SEPARATION:
        return _FAILED
    if journey.event == ARRIVED or (journey.event in (FOLD, PITCHFORK) and miss <= MET):
        return described(question, journey.on, stance.z, journey.curve, stance.unstable)
    if journey.event == OFF:
        return _slid(question, journey, separation)
    return _NOTHING if journey.event in (FOLD, PITCHFORK, ENDED) else _FAILED


def _slid(question: Question, journey: Journey, separation: float) -> Answer:
    """The bridge under suction whose line has come to the side of a cylinder, along which it slides as it is."""
    on, height = journey.on, journey.stance.separation - separation
    rooms = rooms_at(question, on, journey.stance.z)
    after = on[0] + int(rooms[1] < _AT_EDGE), on[1] + int(rooms[3] < _AT_EDGE)
    bodies = question.first, question.second
    if question.control != SUCTION or height < 0.0 or after[0] - on[0] + after[1] - on[1] != 1:
        return _SPILLED
    if any(number >= len(body) for number, body in zip(after, bodies, strict=True)):
        return _SPILLED
    held = held_on(question, after)
    first, second = (s._replace(height=height) if isinstance(s, Side) else s for s in (held.first, held.second))
    curve = Curve(Held(first, second, question.control, question.value), False, 1.0)
    answer = described(question, after, journey.stance.z, curve)
    if answer.state is None or answer.state.unstable_directions > journey.stance.unstable:
        return _NOTHING if answer.state is not None else answer
    return answer._replace(state=answer.state._replace(stiffness=0.0))


def _end(question: Question, asked: int, journey: Journey) -> Answer:
    """The end of a branch at which a journey arrived: rupture, or a lower end if it does not go on to contact."""
    if asked == LOWER_END and journey.event in (ARRIVED, OFF):
        goes_on = journey.event == ARRIVED or _slid(question, journey, 0.0).status == FOUND
        return _NOTHING if goes_on else _SPILLED
    if journey.event not in (FOLD, PITCHFORK, ENDED):
        return _SPILLED if journey.event == OFF else _FAILED
    if journey.stance.separation < 0.0:
        return _NOTHING
    answer = described(question, journey.on, journey.stance.z, journey.curve, journey.stance.unstable)
    if answer.state is None or journey.event != FOLD or journey.is_corner:
        return answer
    return answer._replace(state=answer.state._replace(stiffness=math.inf if asked == LOWER_END else -math.inf))


_Steps = list[tuple[Indices, Curve, Four, Four]]  # neighbours on curves


def curve_of(question: Question, limit: int, points: int) -> list[Answer]:
    """A whole curve: from contact, or the lower end, to the end of the stable branch, and down the unstable one."""
    if reaches_no_farther(question) < 0.0:
        return [_NOTHING] * points
    start = anchor(question)
    if start is None:
        return [_FAILED] * points
    found = start[0]
    top = _up(question, found, limit)
    if top.event not in (FOLD, PITCHFORK, ENDED) or not top.stance.separation > 0.0:
        return [_SPILLED if top.event == OFF else _FAILED] * points
    are_flat = is_flat(question.first) and is_flat(question.second)
    bottom = _down(question, found, limit, _WIDEST * top.stance.separation if are_flat else 0.0)
    middle = points // 2
    stable = _steps_back(bottom.legs) + _steps(top.legs)
    answers = _spread(question, stable, middle, 0.0)
    answers.append(_end(question, RUPTURE, top))
    down = [] if top.event == ENDED else travel(question, go_beyond(question, top), 0.0, NOTHING).legs
    answers += _spread(question, _thinning(_steps(down)), points - middle - 1, 1.0)
    first = answers[0].state
    if bottom.event == ARRIVED and not are_flat and first is not None:
        answers[0] = answers[0]._replace(state=first._replace(separation=0.0))  # which is met to rounding
    return answers


def _steps(legs: list[Leg]) -> _Steps:
    """Pairs of neighbours along a way."""
    return [
        (leg.on, leg.curve, Four(*leg.nodes[i].tolist()), Four(*leg.nodes[i + 1].tolist()))
        for leg in legs
        for i in range(len(leg.nodes) - 1)
    ]


def _steps_back(legs: list[Leg]) -> _Steps:
    return [(on, curve, after, before) for on, curve, before, after in reversed(_steps(legs))]


def _thinning(steps: _Steps) -> _Steps:
    """The first steps of an unstable branch, up to a thread of liquid."""
    widest = 0.0
    for i, (_on, curve, z, _after) in enumerate(steps):
        least, most = retold(radius_range)(z, retold(system_at)(z, curve.held, False, False))
        widest = max(widest, most)
        if least < _THREAD * widest and i > 1:
            return steps[:i]
    return steps


def _spread(question: Question, steps: _Steps, count: int, skipped: float) -> list[Answer]:
    """Bridges evenly spread over steps, without the last of them or, ``skipped``, without the first."""
    if not steps:
        return [_NOTHING] * count
    answers = []
    for i in range(count):
        place = len(steps) * (i + skipped) / count
        step = min(int(place), len(steps) - 1)
        on, curve, before, after = steps[step]
        way = moved(after, -1.0, before)
        z = moved(before, place - step, way)
        if 0.0 < place - step < 1.0:
            z = retold(corrected)(z, curve, unit_vector(way))[0]
        answers.append(described(question, on, z, curve))
    return answers
