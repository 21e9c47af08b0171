"""The exact solver on a GPU: each thread answers a row, by the kernels that the processor runs.

They take the straight way to a bridge, which answers nearly all rows before rupture; what it leaves open is asked of
the whole solver, on the processor.
"""

import math
from collections.abc import Iterator
from functools import cache, partial
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..exact.batch import ALL, FAILED, FORCE_ALONE, OPEN, ROOM_ABREAST
from ..exact.equations import SUCTION, VOLUME
from ..exact.state import State
from ..ground.check import one_of, result_array, scalar
from ..ground.compile import compiled, kernel
from ..ground.device import (
    THREADS,
    Operand,
    blocks_for,
    cuda,
    flat,
    handed_back,
    in_chunks,
    is_large,
    is_on_device,
    on_host,
    read,
    result_for,
    returned,
    types,
    wait_for,
)  # fmt: skip
from ..ground.rows import element
from .face import bridge
from .fields import KINDS, Room, asks_for_force_alone, checked_fields, leave_empty, numbers_of, places_of
from .liquid import Liquid
from .many import BAD, fields_range
from .pair import Pair
from .result import Bridge

__all__ = ["bridge_fields", "bridge_force"]

_FIELDS = len(State._fields)
_UNITS = {
    "separation": "m", "control": "", "radius1": "m", "radius2": "m", "contact_angle1": "rad", "contact_angle2": "rad",
}  # fmt: skip


@kernel
def _is_angle(angle: float) -> bool:
    return 0.0 <= angle < math.pi


@cache
def loop(wanted: int, control: int) -> Any:
    """Fields of rows, or what is known with the force, one row for each thread of the GPU.

    Compiled for one control it needs less registers.
    """
    answer, at, is_angle, leave = compiled(fields_range), compiled(element), compiled(_is_angle), compiled(leave_empty)

    @cuda.jit
    def fill(
        separation: Any, held: Any, radius1: Any, radius2: Any, angle1: Any, angle2: Any,
        tension: float, near: Any, room: Room, statuses: Any,
    ) -> None:  # fmt: skip
        i = cuda.grid(1)
        row = cuda.local.array(_FIELDS, types.float64)
        abreast = cuda.local.array(ROOM_ABREAST, types.float64)
        if i < statuses.size:
            answer(
                wanted, control, separation, held, radius1, radius2, angle1, angle2, tension, near, room, statuses,
                row, abreast, i, i + 1,
            )  # fmt: skip
            is_pair = is_angle(at(angle1, i)) and is_angle(at(angle2, i))
            if not is_pair:
                statuses[i] = BAD
            if statuses[i] == BAD:
                leave(room, i, FAILED)

    return fill


@cuda.jit
def put(places: Any, values: Any, out: Any) -> None:
    i = cuda.grid(1)
    if i < places.size:
        out[places[i]] = values[i]


def bridge_force(
    separation: Operand,
    control: Operand,
    radius1: Operand,
    radius2: Operand,
    contact_angle1: Operand,
    contact_angle2: Operand,
    surface_tension: float,
    *,
    held: Literal["suction", "volume"] = "suction",
    out: Any = None,
) -> Any:
    """Exact attraction of stable bridges, on a GPU.

    Numbers, NumPy arrays or arrays on the device as for :class:`pendular.table.cuda.DeviceTable`, contiguous and of one
    shape or of one element for all. The call waits for the answers.

    Parameters
    ----------
    separation : array
        Whole gap, [m].
    control : array
        Suction, [Pa], or volume, [m³].
    radius1, radius2 : array
        Radii, [m], infinite for a plane.
    contact_angle1, contact_angle2 : array
        [rad].
    surface_tension : float
        [N/m].
    held : {"suction", "volume"}
        What the control is.
    out : array, optional
        Where to store the result, on the device or not.

    Returns
    -------
    array
        [N]; 0 where there is no bridge, NaN where a row is no question: an argument is NaN or out of range.

    Raises
    ------
    ValueError
        For an array on the device of another kind, or shapes that do not go together.
    """
    one_of("held", held, ("suction", "volume"))
    tension = scalar("surface_tension", surface_tension, "N/m")
    arguments = (separation, control, radius1, radius2, contact_angle1, contact_angle2)
    work = read(_UNITS, arguments)
    fill = partial(_fill, VOLUME if held == "volume" else SUCTION, tension)
    if is_large(work) and not is_on_device(out):
        return in_chunks(work, result_array(out, work.shape), fill)
    result = result_for(out, work)
    if result.size:
        fill(flat(work), result.reshape(result.size), work.stream)
    return returned(result, out, work)


def bridge_fields(
    separation: Operand,
    control: Operand,
    radius1: Operand,
    radius2: Operand,
    contact_angle1: Operand,
    contact_angle2: Operand,
    surface_tension: float,
    *,
    held: Literal["suction", "volume"] = "suction",
    fields: tuple[str, ...] = ("force", "volume", "suction", "exists"),
) -> dict[str, Any]:
    """Fields of exact stable bridges, on a GPU.

    Parameters
    ----------
    separation, control, radius1, radius2, contact_angle1, contact_angle2, surface_tension, held
        As for :func:`bridge_force`.
    fields : tuple of str
        Names of fields of :class:`pendular.Bridge`.

    Returns
    -------
    dict
        An array for each name. What belongs to each solid, or has two components, has an axis of 2 in front. A row that
        is no question has NaN, and False.

    Raises
    ------
    ValueError
        For a name that is no field, an array on the device of another kind, or shapes that do not go together.
    """
    one_of("held", held, ("suction", "volume"))
    names = checked_fields(fields) or ()
    tension = scalar("surface_tension", surface_tension, "N/m")
    work = read(_UNITS, (separation, control, radius1, radius2, contact_angle1, contact_angle2))
    rows = numbers_of(names)
    size = math.prod(work.shape)
    numbers = cuda.device_array((sum(length for _, length in rows.values()), size), stream=work.stream)
    room = _answer(VOLUME if held == "volume" else SUCTION, tension, names, flat(work), numbers, work.stream)
    if work.waits:
        wait_for(work.stream)

    def given(part: Any, shape: tuple[int, ...]) -> Any:
        if work.like is None:
            return on_host(part, work.stream).reshape(shape)[()]
        return handed_back(part.reshape(shape or 1), work.like, work.stream)

    found = {}
    for name in names:
        if name in rows:
            first, length = rows[name]
            found[name] = given(room.numbers[first : first + length], (2, *work.shape) if length == 2 else work.shape)
        elif name in KINDS:
            found[name] = given(room.kinds[KINDS.index(name)], work.shape)
        else:
            found[name] = given(room.unstable, work.shape)
    return found


def _fill(control: int, tension: float, operands: list[Any], out: Any, stream: Any) -> None:
    """Fill forces on the device."""
    _answer(control, tension, ("force",), operands, out.reshape((1, out.size)), stream)


def _answer(
    control: int, tension: float, names: tuple[str, ...], operands: list[Any], numbers: Any, stream: Any
) -> Room:
    """Fill fields on the device, and let the processor answer what was left open."""
    size = numbers.shape[1]
    room = Room(
        cuda.to_device(places_of(names), stream=stream),
        numbers,
        cuda.device_array((len(KINDS), size), np.bool_, stream=stream),
        cuda.device_array(size, np.int64, stream=stream),
    )
    if not size:
        return room
    wanted = FORCE_ALONE if asks_for_force_alone(names, "volume" if control == VOLUME else "suction") else ALL
    statuses = cuda.device_array(size, np.int8, stream=stream)
    near = cuda.to_device(np.empty((4, 0)), stream=stream)
    loop(wanted, control)[blocks_for(size), THREADS, stream](*operands, tension, near, room, statuses)
    left = np.flatnonzero(on_host(statuses, stream) == OPEN)
    if left.size:
        gap, held, *solids = (_taken(on_host(operand, stream), left) for operand in operands)
        pair, liquid = Pair((solids[0], solids[1]), (solids[2], solids[3])), Liquid(surface_tension=tension)
        suction, volume = (None, held) if control == VOLUME else (held, None)
        found = bridge(pair, gap, suction=suction, volume=volume, liquid=liquid, fields=names)
        for array, row, values in _columns(found, names, room):
            places = cuda.to_device(left + row * size, stream=stream)
            column = cuda.to_device(np.ascontiguousarray(values), stream=stream)
            put[blocks_for(left.size), THREADS, stream](places, column, array.reshape(array.size))
    return room


def _columns(found: Bridge, names: tuple[str, ...], room: Room) -> Iterator[tuple[Any, int, Any]]:
    """What belongs into a room: its array, the row in it, and the values."""
    for name, (first, length) in numbers_of(names).items():
        values = np.asarray(getattr(found, name))
        for part in range(length):
            yield room.numbers, first + part, values if length == 1 else values[:, part]
    for row, kind in enumerate(KINDS):
        yield room.kinds, row, np.asarray(getattr(found, kind))
    yield room.unstable, 0, np.asarray(found.unstable_directions)


def _taken(operand: NDArray[np.float64], rows: NDArray[np.intp]) -> NDArray[np.float64]:
    return np.full(rows.size, operand[0]) if operand.size == 1 else operand[rows]
