"""What the second module answers, for pairs with other solids than spheres and planes."""

import math

from ...ask.domain import length_between, reduced
from ...exact.answers import FOUND, LOWER_END, RUPTURE, STABLE
from ...exact.equations import SUCTION, VOLUME
from ...exact.follow import BRANCH_ENDS
from ...exact.shapes.answers import answer_to, curve_of
from ...exact.shapes.pieces import is_flat, solid_from
from ...exact.shapes.search import Question, Room, room_for_found, room_for_nodes, room_for_starts
from ...exact.solids.surface import CONE, EDGE, PARABOLOID, RING, SPHERE, Surface
from ...ground.compile import kernel
from ...ground.linkable import Array, Count, Function, Integer, Real
from ..library.kernels import BAD_INPUT, STATES, Floats, Integers, in_units
from .functions import meridian

__all__ = ["KINDS", "PAIR", "ROOM", "functions"]

# Numbers of a row: of each solid its kind, its radius, its half angle and its contact angle; and the surface tension.
PAIR = ("kind1", "size1", "half_angle1", "contact_angle1", "kind2", "size2", "half_angle2", "contact_angle2", "tension")
KINDS = {"sphere": SPHERE, "cone": CONE, "paraboloid": PARABOLOID, "disc": EDGE, "pinned disc": RING}
ROOM = tuple(room.shape for room in (room_for_nodes(), room_for_found(), room_for_starts()))  # to write in on the way

_SECOND, _TENSION = 4, 8  # places in a row


@kernel
def _is_solid(pair: Floats, place: int) -> bool:
    """Whether the numbers of a row, from a place on, tell a solid that is known here."""
    kind, size = int(pair[place]), float(pair[place + 1])
    half_angle, angle = float(pair[place + 2]), float(pair[place + 3])
    if not 0.0 <= angle < math.pi:
        return False
    if kind == CONE:
        return 0.0 <= size < math.inf and 0.0 < half_angle <= 0.5 * math.pi
    if kind == SPHERE:
        return size > 0.0
    return 0.0 < size < math.inf and kind in (PARABOLOID, EDGE, RING)


@kernel
def _solid_in(pair: Floats, place: int, unit: float, room: Room) -> Surface:
    """A solid of a row in a unit of length."""
    kind, size = int(pair[place]), pair[place + 1] / unit
    return solid_from(kind, size, pair[place + 2], pair[place + 3], room.nodes[:0])  # no profile


@kernel
def _are_flat(pair: Floats, room: Room) -> bool:
    return is_flat(_solid_in(pair, 0, 1.0, room)) and is_flat(_solid_in(pair, _SECOND, 1.0, room))


@kernel
def _is_fit(control: int, held: float, pair: Floats) -> bool:
    """Whether a question is one: what `ask.by_shape` refuses is none, nor is what is not a number."""
    are_solids = _is_solid(pair, 0) and _is_solid(pair, _SECOND) and 0.0 < pair[_TENSION] < math.inf
    return are_solids and abs(held) < math.inf and (control == SUCTION or (control == VOLUME and held > 0.0))


@kernel
def _unit_of(control: int, separation: float, held: float, pair: Floats) -> float:
    """Unit of length of a question."""
    return length_between(control, held, pair[_TENSION], _size_of(pair), separation)


@kernel
def _size_of(pair: Floats) -> float:
    """The smaller of the lengths of two solids; NaN if they have none."""
    least = math.inf
    for size in (pair[1], pair[_SECOND + 1]):
        if size > 0.0:
            least = min(least, size)
    return least if least < math.inf else math.nan


@kernel
def _question_in(control: int, held: float, pair: Floats, unit: float, room: Room) -> Question:
    """The question in a unit of length."""
    first, second = _solid_in(pair, 0, unit, room), _solid_in(pair, _SECOND, unit, room)
    return Question(first, second, control, reduced(control, held, unit, pair[_TENSION]), _size_of(pair) / unit)


@kernel
def _answered(
    asked: int, control: int, separation: float, held: float, pairs: Floats, states: Floats, room: Room
) -> int:
    """Answer the question of a row; the status."""
    pair, state = pairs[0], states[0]
    state[:] = math.nan
    if not _is_fit(control, held, pair):
        return BAD_INPUT
    is_met = separation > 0.0 or (separation == 0.0 and not _are_flat(pair, room))
    if asked == STABLE and not (is_met and separation < math.inf):
        return BAD_INPUT
    unit = _unit_of(control, separation, held, pair)
    question = _question_in(control, held, pair, unit, room)
    status = answer_to(question, asked, separation / unit, BRANCH_ENDS, room, state)
    if status == FOUND:
        in_units(state, unit, pair[_TENSION])
    return status


@kernel
def bridge(
    control: int, separation: float, held: float, pairs: Floats, states: Floats, nodes: Floats, found: Floats,
    starts: Floats,
) -> int:  # fmt: skip
    """The stable bridge of two solids at a separation that holds a suction or a volume; the status."""
    return _answered(STABLE, control, separation, held, pairs, states, Room(nodes, found, starts))


@kernel
def rupture(
    control: int, held: float, pairs: Floats, states: Floats, nodes: Floats, found: Floats, starts: Floats
) -> int:
    """The bridge at the end of its stable branch; the status."""
    return _answered(RUPTURE, control, math.nan, held, pairs, states, Room(nodes, found, starts))


@kernel
def lower_end(
    control: int, held: float, pairs: Floats, states: Floats, nodes: Floats, found: Floats, starts: Floats
) -> int:
    """The bridge at which the stable branch begins, if that is not at contact; the status."""
    return _answered(LOWER_END, control, math.nan, held, pairs, states, Room(nodes, found, starts))


@kernel
def curve(
    control: int, held: float, pairs: Floats, states: Floats, statuses: Integers, nodes: Floats, found: Floats,
    starts: Floats,
) -> int:  # fmt: skip
    """Bridges from contact, or the lower end, to rupture in the middle, and down the unstable branch; the status."""
    pair, room = pairs[0], Room(nodes, found, starts)
    states[:] = math.nan
    if not _is_fit(control, held, pair):
        return BAD_INPUT
    unit = _unit_of(control, math.nan, held, pair)
    curve_of(_question_in(control, held, pair, unit, room), BRANCH_ENDS, room, states, statuses)
    best = int(statuses[0])
    for i in range(statuses.size):
        if statuses[i] == FOUND:
            best = FOUND
            in_units(states[i], unit, pair[_TENSION])
        else:
            states[i, :] = math.nan
    return best


_PAIRS, _STATUSES = Array(len(PAIR)), Array(kind="int32")
_ROOM = tuple(one for shape in ROOM for one in (Count(), Array(shape[1])))


def functions() -> tuple[Function, ...]:
    """All functions of the module."""
    end = (Integer(), Real(), _PAIRS, STATES, *_ROOM)
    return (
        Function("solids_bridge", bridge, (Integer(), Real(), Real(), _PAIRS, STATES, *_ROOM)),
        Function("solids_rupture", rupture, end),
        Function("solids_lower_end", lower_end, end),
        Function("solids_curve", curve, (Integer(), Real(), _PAIRS, Count(), STATES, _STATUSES, *_ROOM)),
        Function("pendular_meridian", meridian, (Array(), Count(), Array(), Array())),
    )
