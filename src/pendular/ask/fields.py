"""Room for the fields of many bridges in SI units: for those that are asked, filled row by row."""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..exact.batch import FAILED, FOUND
from ..exact.equations import VOLUME
from ..exact.state import State, state_in
from ..ground.check import one_of
from ..ground.compile import kernel
from ..ground.rows import element, entry, over_rows
from .result import FIELDS, Bridge

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Integers = NDArray[np.int64]

# Fields that are numbers, and how many of them each bridge has; the others tell what kind of bridge it is.
_LENGTHS = {
    "separation": 1, "suction": 1, "volume": 1, "force": 1, "neck_radius": 1, "liquid_gas_area": 1,
    "surface_energy": 1, "grand_potential": 1, "stiffness": 1, "contact_radius": 2, "half_filling_angle": 2,
    "wetted_area": 2, "capillary_tensor": 2, "_meridian": 3,
}  # fmt: skip
KINDS = ("exists", "stable", "sideways_stable", "neck_inside")
_ALWAYS = ("exists", "stable", "unstable_directions", "sideways_stable")
TO_GO_ON = ("suction", "_meridian")  # what is kept of a bridge, so that others may be looked for near it
_CHUNK = 16384  # rows that one thread takes at a time
_NAMES = tuple(name for name, _, _ in FIELDS)
(
    _SEPARATION, _SUCTION, _VOLUME, _FORCE, _NECK, _AREA, _ENERGY, _POTENTIAL, _STIFFNESS, _RADII, _FILLINGS, _WETTED,
    _TENSOR, _MERIDIAN,
) = range(len(_LENGTHS))  # fmt: skip
_EXISTS, _STABLE, _SIDEWAYS, _NECK_INSIDE = range(len(KINDS))


class Room(NamedTuple):
    """Fields of rows of bridges, as a kernel fills them."""

    places: Integers  # first row among the numbers of each field, -1 of one that is not asked
    numbers: Floats  # (all, rows)
    kinds: Bools  # (4, rows)
    unstable: Integers  # (rows,)


def checked_fields(fields: Any) -> tuple[str, ...] | None:
    """Names of the fields that are asked, None for all.

    Examples
    --------
    >>> checked_fields(("force", "neck"))
    Traceback (most recent call last):
        ...
    ValueError: fields[1]: 'neck' is not one of 'separation', 'suction', 'volume', 'force', 'exists', 'stable', \
'unstable_directions', 'sideways_stable', 'neck_radius', 'neck_inside', 'contact_radius', 'half_filling_angle', \
'liquid_gas_area', 'wetted_area', 'surface_energy', 'grand_potential', 'stiffness', 'capillary_tensor'
    """
    if fields is None:
        return None
    names = (fields,) if isinstance(fields, str) else tuple(fields)
    for i, name in enumerate(names):
        one_of(f"fields[{i}]", name, _NAMES)
    return names


def numbers_of(fields: tuple[str, ...] | None) -> dict[str, tuple[int, int]]:
    """Fields that are numbers, among those that are asked: the first of their rows in a room, and how many they are."""
    rows, count = {}, 0
    for name, length in _LENGTHS.items():
        if fields is None or name in fields:
            rows[name], count = (count, length), count + length
    return rows


def places_of(fields: tuple[str, ...] | None) -> Integers:
    """The first row of each field, for a room."""
    rows = numbers_of(fields)
    return np.array([rows[name][0] if name in rows else -1 for name in _LENGTHS])


def room_for(rows: int, fields: tuple[str, ...] | None) -> Room:
    """Room for the fields of so many bridges."""
    count = sum(length for _, length in numbers_of(fields).values())
    kinds = np.empty((len(KINDS), rows), bool)
    return Room(places_of(fields), np.empty((count, rows)), kinds, np.empty(rows, np.int64))


@kernel
def _set(room: Room, field: int, i: int, number: float) -> None:
    if room.places[field] >= 0:
        room.numbers[room.places[field], i] = number


@kernel
def _set_two(room: Room, field: int, i: int, first: float, second: float) -> None:
    if room.places[field] >= 0:
        room.numbers[room.places[field], i] = first
        room.numbers[room.places[field] + 1, i] = second


@kernel
def leave_empty(room: Room, i: int, status: int) -> None:
    """Fill a row in which there is no bridge, or where the solver failed."""
    for row in range(room.numbers.shape[0]):
        room.numbers[row, i] = math.nan
    _set(room, _FORCE, i, math.nan if status == FAILED else 0.0)
    for kind in range(room.kinds.shape[0]):
        room.kinds[kind, i] = False
    room.unstable[i] = 0


@kernel
def fill(
    room: Room,
    i: int,
    state: State,
    control: int,
    separation: float,
    held: float,
    unit: float,
    tension: float,
    cosine1: float,
    cosine2: float,
) -> None:
    """Fill a row from a reduced state, a unit of length, and what was asked: separation and suction or volume."""
    square = unit * unit
    is_stable_sideways = state.sideways_stable == 1.0
    room.kinds[_EXISTS, i] = True
    room.kinds[_STABLE, i] = state.unstable_directions == 0.0 and is_stable_sideways
    room.kinds[_SIDEWAYS, i] = is_stable_sideways
    room.kinds[_NECK_INSIDE, i] = state.neck_inside == 1.0
    room.unstable[i] = int(state.unstable_directions)
    _set(room, _SEPARATION, i, separation)
    _set(room, _SUCTION, i, tension * state.curvature / unit if control == VOLUME else held)
    _set(room, _VOLUME, i, held if control == VOLUME else state.volume * square * unit)
    _set(room, _FORCE, i, 2.0 * math.pi * tension * unit * state.force)
    _set(room, _NECK, i, state.neck_radius * unit)
    _set(room, _AREA, i, state.area * square)
    energy = state.area - (cosine1 * state.wetted_area1 + cosine2 * state.wetted_area2)  # 0 of dry solids apart
    _set(room, _ENERGY, i, tension * energy * square)
    _set(room, _POTENTIAL, i, tension * (energy + state.curvature * state.volume) * square)
    _set(room, _STIFFNESS, i, 2.0 * math.pi * tension * state.stiffness)
    _set_two(room, _RADII, i, state.radius1 * unit, state.radius2 * unit)
    _set_two(room, _FILLINGS, i, state.filling1, state.filling2)
    _set_two(room, _WETTED, i, state.wetted_area1 * square, state.wetted_area2 * square)
    _set_two(room, _TENSOR, i, state.across_tensor * square, state.axial_tensor * square)
    if room.places[_MERIDIAN] >= 0:
        row = room.places[_MERIDIAN]
        room.numbers[row, i], room.numbers[row + 1, i] = state.middle_radius * unit, state.middle_slope
        room.numbers[row + 2, i] = state.half_length * unit


@entry(plain_cost=3e-5)
def restored_range(
    control: int,
    places: NDArray[np.int64],
    separation: Floats,
    values: Floats,
    units: Floats,
    angle1: Floats,
    angle2: Floats,
    tension: float,
    states: Floats,
    statuses: NDArray[np.int8],
    room: Room,
    start: int,
    stop: int,
) -> None:
    """Fields of rows of states, each at its place in the room, of separations that were asked or are NaN."""
    for k in range(start, stop):
        i = places[k]
        if statuses[k] != FOUND:
            leave_empty(room, i, statuses[k])
            continue
        cosine1, cosine2 = math.cos(angle1[k]), math.cos(angle2[k])
        gap = element(separation, k)
        if math.isnan(gap):  # none was asked
            gap = states[k, 0] * units[k]
        asked = (gap, float(values[k]), float(units[k]), tension, cosine1, cosine2)
        fill(room, i, state_in(states[k]), control, asked[0], asked[1], asked[2], asked[3], asked[4], asked[5])


def restore_rows(
    room: Room,
    places: NDArray[np.int64],
    control: int,
    separation: Floats,
    values: Floats,
    units: Floats,
    angle1: Floats,
    angle2: Floats,
    tension: float,
    states: Floats,
    statuses: NDArray[np.int8],
) -> None:
    """Fill rows of a room from reduced states, on all threads."""
    columns = [np.ascontiguousarray(column) for column in (separation, values, units, angle1, angle2)]
    asking = (control, places, *columns, float(tension), states, statuses, room)
    over_rows(restored_range, places.size, _CHUNK, *asking)


def asks_for_force_alone(fields: tuple[str, ...] | None, control: str) -> bool:
    """Whether what is asked is known with the force."""
    return fields is not None and set(fields) <= {"force", "separation", "suction", control, *_ALWAYS}


def bridge_of(
    room: Room,
    shape: tuple[int, ...],
    solid_radius: tuple[Floats, Floats],
    tension: float,
    fields: tuple[str, ...] | None,
) -> Bridge:
    """The bridges of a room; fields that were not asked are NaN, or False."""
    nothing = np.broadcast_to(np.nan, shape)
    values: dict[str, Any] = {}
    for i, (name, length) in enumerate(_LENGTHS.items()):
        first, own = room.places[i], () if length == 1 else (length,)
        if first < 0:
            values[name] = np.broadcast_to(nothing[..., None], (*shape, *own)) if own else nothing
        elif own:
            values[name] = np.moveaxis(room.numbers[first : first + length].reshape(length, *shape), 0, -1)
        else:
            values[name] = room.numbers[first].reshape(shape)
    values |= {name: kind.reshape(shape) for name, kind in zip(KINDS, room.kinds, strict=True)}
    if fields is not None and "neck_inside" not in fields:
        values["neck_inside"] = np.broadcast_to(np.bool_(False), shape)
    radii = [np.broadcast_to(radius, shape) for radius in solid_radius]
    is_common = all(radius.ndim == 0 for radius in solid_radius)
    return Bridge(
        **values,
        unstable_directions=room.unstable.reshape(shape),
        _solid_radius=np.broadcast_to(np.array(solid_radius), (*shape, 2)) if is_common else np.stack(radii, axis=-1),
        _surface_tension=tension,
    )


def narrowed(bridge: Bridge, fields: tuple[str, ...] | None) -> Bridge:
    """The bridge with all other fields NaN, or False: those that were not asked, of a method that answers them all."""
    if fields is None:
        return bridge
    values = dict(bridge.__dict__)
    for name in _NAMES:
        if name in fields or name in _ALWAYS:
            continue
        old = np.asarray(values[name])
        empty = np.broadcast_to(np.bool_(False) if name == "neck_inside" else np.nan, old.shape)
        values[name] = empty if old.ndim else empty.item()
    if "_meridian" not in fields:
        values["_meridian"] = np.full(np.shape(values["_meridian"]), np.nan)
    return Bridge(**values)
