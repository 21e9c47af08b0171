"""What a question about two solids of any shape leads to, checked before it is given."""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import kernel
from .. import clearance, curve, equations, state
from ..algebra import Four, moved, unit_vector
from ..answers import FAILED, FOUND, LARGEST_MISS, LOWER_END, MET, NO_BRIDGE, RUPTURE, STABLE, UNSTABLE
from ..equations import SUCTION, Held
from ..follow import BRANCH_ENDS, NOTHING, recorded
from ..locate import ARRIVED, ENDED, FOLD, PITCHFORK
from ..solids.surface import SIDE, Surface, is_pinning, with_height
from ..state import STIFFNESS, UNSTABLE_DIRECTIONS, State
from .pieces import is_flat, piece_of, pieces_of
from .retold import retold, system_as_if_liquid
from .search import (
    MOST_NODES,
    Found,
    On,
    Question,
    Room,
    anchor,
    found_in,
    held_between,
    held_on,
    led_at,
    lies_on,
    rooms_at,
    stable_at,
)
from .side import has_side, height_of
from .sideways import sideways_directions
from .surfaces import is_plane, shape_at, wetted_area
from .travel import OFF, Journey, Track, curve_on, go_beyond, is_step, nowhere, set_out, track_in, travel

Rows = NDArray[np.float64]
Statuses = NDArray[np.signedinteger[Any]]

SPILLED = 4  # status: the liquid would wet the sides of two discs, or run beyond a profile

_ROUNDING = 1e-15
_AT_EDGE = 1e-9  # room on an edge that is none
_MISS_OF_SEPARATION = 1e-10  # over ℓ
_CONTACT = 1e-12  # separation of a lower end that is contact, as that of two flat ends, whose gap is filled
_BEYOND = 1e-6  # over the end of a branch, where another may go on
_MOST_BRANCHES = 4
_WIDEST = 0.2  # gap between flat faces where their curve begins, over the rupture distance
_THREAD = 0.03  # thinnest circle of a drawn bridge over the widest of its branch
_STEP = 9  # column of a node that holds the place of a step
_UNKNOWN = -1  # index of a bridge, which is that of its own equations

_SEPARATION, _AREA, _CURVATURE, _VOLUME, _RADIUS1, _RADIUS2, _WETTED1, _WETTED2, _SIDEWAYS = (
    State._fields.index(name)
    for name in (
        "separation", "area", "curvature", "volume", "radius1", "radius2", "wetted_area1", "wetted_area2",
        "sideways_stable",
    )
)  # fmt: skip

_describe = retold(state.describe)
_corrected = retold(curve.corrected)
_radius_range = retold(clearance.radius_range)
_system_at = retold(equations.system_at)


@kernel
def reaches_no_farther(question: Question) -> float:
    """A separation beyond which there is no bridge; negative if there is none at all, infinite if none is known.

    Along a meridian of the length X, sin ψ1 + sin ψ2 is HX and more. On a tip the slopes ψ are the largest.
    """
    if question.control != SUCTION or question.value < 0.0:
        return math.inf
    sines = _largest_sine(question.first) + _largest_sine(question.second)
    if sines <= _ROUNDING:
        return -1.0
    return sines / question.value if question.value > 0.0 else math.inf


@kernel
def _largest_sine(solid: Surface) -> float:
    """Sine of the steepest slope with which a meridian can leave a solid."""
    tip = piece_of(solid, 0).surface
    if is_pinning(tip):
        return 1.0
    rise = shape_at(tip, 0.0)
    return tip.cos_angle * rise.cos_slope - tip.sin_angle * rise.sin_slope


@kernel
def _with_heights(z: Four, held: Held) -> Held:
    """What is held, with the height of a line on the side of a cylinder, which the place of its meridian depends on."""
    if not has_side(held) or held.control == SUCTION:
        return held
    first: Surface = held.first  # type: ignore[assignment]
    second: Surface = held.second  # type: ignore[assignment]
    height = height_of(system_as_if_liquid(z, held, True, True), held, first if first.kind == SIDE else second)
    return _raised(held, height)


@kernel
def _raised(held: Held, height: float) -> Held:
    """What is held, with the height of a line on the side of a cylinder."""
    first: Surface = held.first  # type: ignore[assignment]
    second: Surface = held.second  # type: ignore[assignment]
    return held_between(
        with_height(first, height) if first.kind == SIDE else first,
        with_height(second, height) if second.kind == SIDE else second,
        held.control,
        held.value,
    )


@kernel
def described(question: Question, on: On, z: Four, given: Held, symmetric: bool, unstable: int, row: Rows) -> int:
    """Store a bridge, if it holds what it should and is one; ``unstable`` where its index is known. The status."""
    held = _with_heights(z, given)
    found, is_bridge, miss = _describe(z, held, symmetric)
    if not miss <= LARGEST_MISS:
        return FAILED
    if not (is_bridge and lies_on(question, on, z)):
        return NO_BRIDGE
    for j, value in enumerate(found):
        row[j] = value
    first: Surface = held.first  # type: ignore[assignment]
    second: Surface = held.second  # type: ignore[assignment]
    row[_WETTED1] = wetted_area(first, row[_RADIUS1], row[_WETTED1])
    row[_WETTED2] = wetted_area(second, row[_RADIUS2], row[_WETTED2])
    system = _system_at(z, held, True, False)
    slides = is_plane(first) and is_plane(second)
    row[_SIDEWAYS] = 1.0 if slides or sideways_directions(z, system, held) == 0 else 0.0
    if unstable != _UNKNOWN:
        row[UNSTABLE_DIRECTIONS] = float(unstable)
    return FOUND


@kernel
def _described_on(question: Question, track: Track, z: Four, unstable: int, row: Rows) -> int:
    return described(question, track.on, z, held_on(question, track.on), track.symmetric, unstable, row)


@kernel
def answer_to(question: Question, asked: int, separation: float, limit: int, room: Room, row: Rows) -> int:
    """Store the bridge, or the end of a branch, that a question asks for; the status."""
    farthest = reaches_no_farther(question)
    if farthest < 0.0 or (asked in (STABLE, UNSTABLE) and separation > farthest * (1.0 + _ROUNDING)):
        return NO_BRIDGE
    if asked == STABLE:
        return _stable(question, separation, limit, room, row)
    if asked == LOWER_END:
        start = anchor(question, room)
        if not start.is_known:
            return FAILED
        return _end(question, asked, _way(question, start.found, -1.0, 0.0, limit, room), row)
    last = _last(question, limit, room)
    if not last.is_known:
        return FAILED
    top = last.top
    if asked == RUPTURE:
        return _end(question, asked, top, row)
    if top.event != FOLD and top.event != PITCHFORK:
        return SPILLED if top.event == OFF else FAILED
    if separation >= top.stance.separation:
        return NO_BRIDGE
    stance, track = go_beyond(question, top)
    return _arrived(question, travel(question, stance, track, separation, NOTHING, room.nodes), separation, row)


@kernel
def _stable(question: Question, separation: float, limit: int, room: Room, row: Rows) -> int:
    """The stable bridge at a separation, of several that of the least energy."""
    if _least(question, stable_at(question, separation, room.found.shape[0], room), room, row):
        return FOUND
    last = _last(question, limit, room)
    if not last.is_known:
        is_led = _least(question, led_at(question, separation, room.found.shape[0], room), room, row)
        return FOUND if is_led else FAILED
    if separation >= last.top.stance.separation:
        return _arrived(question, last.top, separation, row)
    going = 1.0 if separation > last.place else -1.0
    return _arrived(question, _way(question, last.start, going, separation, limit, room), separation, row)


@kernel
def _least(question: Question, count: int, room: Room, row: Rows) -> bool:
    """Store, of bridges that were found, that of the least energy; whether there is one."""
    least = math.inf
    best = -1
    for i in range(count):
        if _found_described(question, found_in(room.found, i), row) == FOUND:
            energy = _energy(question, row)
            if energy < least:
                best, least = i, energy
    if best >= 0 and best < count - 1:
        _found_described(question, found_in(room.found, best), row)
    return best >= 0


@kernel
def _found_described(question: Question, found: Found, row: Rows) -> int:
    _stance, track = set_out(question, found.z, found.on, 1.0)
    return _described_on(question, track, found.z, _UNKNOWN, row)


@kernel
def _energy(question: Question, row: Rows) -> float:
    """Surface energy over γ against dry solids, and that of the pressure where it is held."""
    energy = row[_AREA] - question.first.cos_angle * row[_WETTED1] - question.second.cos_angle * row[_WETTED2]
    return float(energy + (row[_CURVATURE] * row[_VOLUME] if question.control == SUCTION else 0.0))


class _Last(NamedTuple):
    """The end of the last stable branch, and a bridge on that branch with its separation, if one is known."""

    is_known: bool
    top: Journey
    start: Found
    place: float


@kernel
def _last(question: Question, limit: int, room: Room) -> _Last:
    """Up to the end of the stable branch, and of those that go on beyond it."""
    known = anchor(question, room)
    if not known.is_known:
        return _Last(False, nowhere(), known.found, math.nan)
    last = _Last(True, _up(question, known.found, limit, room), known.found, known.separation)
    for _ in range(_MOST_BRANCHES if limit == BRANCH_ENDS else 0):
        if last.top.event != FOLD and last.top.event != PITCHFORK:
            break
        beyond = last.top.stance.separation * (1.0 + _BEYOND)
        goes_on = False
        for i in range(stable_at(question, beyond, room.found.shape[0], room)):
            start = found_in(room.found, i)
            further = _up(question, start, limit, room)
            is_end = further.event == FOLD or further.event == PITCHFORK
            if is_end and further.stance.separation >= beyond:
                last = _Last(True, further, start, beyond)
                goes_on = True
                break
        if not goes_on:
            break
    return last


@kernel
def _up(question: Question, found: Found, limit: int, room: Room) -> Journey:
    return _way(question, found, 1.0, math.nan, limit, room)


@kernel
def _way(question: Question, found: Found, going: float, target: float, limit: int, room: Room) -> Journey:
    """The way from a bridge up or down, to a separation or the end of its branch."""
    stance, track = set_out(question, found.z, found.on, going)
    return travel(question, stance, track, target, limit, room.nodes[:MOST_NODES])


@kernel
def _arrived(question: Question, journey: Journey, separation: float, row: Rows) -> int:
    """The bridge at a separation at which a journey arrived."""
    stance, event = journey.stance, journey.event
    is_end = event in (FOLD, PITCHFORK)
    miss = abs(stance.separation - separation) * math.exp(-stance.z.log_length)
    if event == ARRIVED and miss > _MISS_OF_SEPARATION:
        return FAILED
    if event == ARRIVED or (is_end and miss <= MET):
        return _described_on(question, journey.track, stance.z, stance.unstable, row)
    if event == OFF:
        return _slid(question, journey, separation, row)
    return NO_BRIDGE if is_end or event == ENDED else FAILED


@kernel
def _slid(question: Question, journey: Journey, separation: float, row: Rows) -> int:
    """The bridge under suction whose line has come to the side of a cylinder, along which it slides as it is."""
    on, z, height = journey.track.on, journey.stance.z, journey.stance.separation - separation
    _inner1, outer1, _inner2, outer2 = rooms_at(question, on, z)
    after = On(on.first + (1 if outer1 < _AT_EDGE else 0), on.second + (1 if outer2 < _AT_EDGE else 0))
    if question.control != SUCTION or height < 0.0 or after.first - on.first + after.second - on.second != 1:
        return SPILLED
    if after.first >= pieces_of(question.first) or after.second >= pieces_of(question.second):
        return SPILLED
    status = described(question, after, z, _raised(held_on(question, after), height), False, _UNKNOWN, row)
    if status == FOUND and row[UNSTABLE_DIRECTIONS] > journey.stance.unstable:
        return NO_BRIDGE
    row[STIFFNESS] = 0.0
    return status


@kernel
def _end(question: Question, asked: int, journey: Journey, row: Rows) -> int:
    """The end of a branch at which a journey arrived: rupture, or a lower end if it does not go on to contact."""
    event = journey.event
    if asked == LOWER_END and event in (ARRIVED, OFF):
        goes_on = event == ARRIVED or _slid(question, journey, 0.0, row) == FOUND
        return NO_BRIDGE if goes_on else SPILLED
    if event != FOLD and event != PITCHFORK and event != ENDED:
        return SPILLED if event == OFF else FAILED
    if journey.stance.separation < (_CONTACT if asked == LOWER_END else 0.0):
        return NO_BRIDGE
    status = _described_on(question, journey.track, journey.stance.z, journey.stance.unstable, row)
    if status == FOUND and event == FOLD and not journey.is_corner:
        row[STIFFNESS] = math.inf if asked == LOWER_END else -math.inf
    return status


@kernel
def curve_of(question: Question, limit: int, room: Room, states: Rows, statuses: Statuses) -> None:
    """A whole curve: from contact, or the lower end, to the end of the stable branch, and down the unstable one."""
    points = states.shape[0]
    statuses[:] = NO_BRIDGE
    if reaches_no_farther(question) < 0.0:
        return
    start = anchor(question, room)
    if not start.is_known:
        statuses[:] = FAILED
        return
    up, down, on = room.nodes[:MOST_NODES], room.nodes[MOST_NODES : 2 * MOST_NODES], room.nodes[2 * MOST_NODES :]
    stance, track = set_out(question, start.found.z, start.found.on, 1.0)
    top = travel(question, stance, track, math.nan, limit, up)
    is_end = top.event == FOLD or top.event == PITCHFORK
    if not (is_end or top.event == ENDED) or not top.stance.separation > 0.0:
        statuses[:] = SPILLED if top.event == OFF else FAILED
        return
    are_flat = is_flat(question.first) and is_flat(question.second)
    stance, track = set_out(question, start.found.z, start.found.on, -1.0)
    lowest = _WIDEST * top.stance.separation if are_flat else 0.0
    bottom = travel(question, stance, track, lowest, limit, down)
    middle = points // 2
    below, above = _steps(down, bottom.nodes), _steps(up, top.nodes)
    for i in range(middle):
        place = (below + above) * i / middle
        step = min(int(place), below + above - 1)
        if step < 0:
            continue
        if step < below:
            statuses[i] = _between(question, down, below - 1 - step, 1.0 - (place - step), states[i])
        else:
            statuses[i] = _between(question, up, step - below, place - step, states[i])
    statuses[middle] = _end(question, RUPTURE, top, states[middle])
    if top.event != ENDED:
        stance, track = go_beyond(question, top)
        beyond = travel(question, stance, track, 0.0, NOTHING, on)
        count = _thinned(question, on, _steps(on, beyond.nodes))
        for i in range(points - middle - 1 if count > 0 else 0):
            place = count * (i + 1.0) / (points - middle - 1)
            step = min(int(place), count - 1)
            statuses[middle + 1 + i] = _between(question, on, step, place - step, states[middle + 1 + i])
    if bottom.event == ARRIVED and not are_flat and statuses[0] == FOUND:
        states[0, _SEPARATION] = 0.0  # which is met to rounding


@kernel
def _steps(nodes: Rows, count: int) -> int:
    """Store where each step of a way begins; the number of its steps."""
    steps = 0
    for i in range(count - 1):
        if is_step(nodes, i):
            nodes[steps, _STEP] = i
            steps += 1
    return steps


@kernel
def _thinned(question: Question, nodes: Rows, steps: int) -> int:
    """Number of the first steps of an unstable branch, up to a thread of liquid."""
    widest = 0.0
    for i in range(steps):
        place = int(nodes[i, _STEP])
        z, held = recorded(nodes, place), held_on(question, track_in(nodes, place).on)
        least, most = _radius_range(z, _system_at(z, held, False, False))
        widest = max(widest, most)
        if least < _THREAD * widest and i > 1:
            return i
    return steps


@kernel
def _between(question: Question, nodes: Rows, step: int, share: float, row: Rows) -> int:
    """Store the bridge at a share of a step; the status."""
    place = int(nodes[step, _STEP])
    track, before, after = track_in(nodes, place), recorded(nodes, place), recorded(nodes, place + 1)
    way = moved(after, -1.0, before)
    z = moved(before, share, way)
    if 0.0 < share < 1.0:
        z = _corrected(z, curve_on(question, track), unit_vector(way))[0]
    return _described_on(question, track, z, _UNKNOWN, row)
