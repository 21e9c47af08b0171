"""The exact solver on a GPU: each thread answers a row, by the kernels that the processor runs.

They take the straight way to a bridge, which answers nearly all rows before rupture; what it leaves open is asked of
the whole solver, on the processor.
"""

import math
from functools import cache, partial
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..exact import batch
from ..exact.batch import OPEN
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
    in_chunks,
    is_large,
    is_on_device,
    on_host,
    read,
    result_for,
    returned,
    types,
)
from ..ground.rows import element
from .face import bridge
from .fields import Room, room_for
from .liquid import Liquid
from .many import BAD, fields_range
from .pair import Pair

__all__ = ["bridge_force"]

_FIELDS, _ABREAST = len(State._fields), batch.ROOM_ABREAST
_UNITS = {
    "separation": "m", "control": "", "radius1": "m", "radius2": "m", "contact_angle1": "rad", "contact_angle2": "rad",
}  # fmt: skip


@kernel
def _is_angle(angle: float) -> bool:
    return 0.0 <= angle < math.pi


@cache
def loop() -> Any:
    """Forces of rows, one for each thread of the GPU."""
    answer, at, is_angle = compiled(fields_range), compiled(element), compiled(_is_angle)

    @cuda.jit
    def fill(
        control: int, separation: Any, held: Any, radius1: Any, radius2: Any, angle1: Any, angle2: Any,
        tension: float, near: Any, room: Room, statuses: Any, out: Any,
    ) -> None:  # fmt: skip
        i = cuda.grid(1)
        row = cuda.local.array(_FIELDS, types.float64)
        abreast = cuda.local.array(_ABREAST, types.float64)
        if i < statuses.size:
            answer(
                batch.FORCE_ALONE, control, separation, held, radius1, radius2, angle1, angle2, tension, near, room,
                statuses, row, abreast, i, i + 1,
            )  # fmt: skip
            is_pair = is_angle(at(angle1, i)) and is_angle(at(angle2, i))
            if not is_pair:
                statuses[i] = BAD
            out[i] = room.numbers[0, i] if statuses[i] != BAD else math.nan

    return fill


@cuda.jit
def _put(places: Any, values: Any, out: Any) -> None:
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


def _fill(control: int, tension: float, operands: list[Any], out: Any, stream: Any) -> None:
    """Fill forces on the device, and let the processor answer what was left open."""
    room = Room(*(cuda.to_device(part, stream=stream) for part in room_for(out.size, ("force",))))
    statuses = cuda.device_array(out.size, np.int8, stream=stream)
    near = cuda.to_device(np.empty((4, 0)), stream=stream)
    loop()[blocks_for(out.size), THREADS, stream](control, *operands, tension, near, room, statuses, out)
    left = np.flatnonzero(on_host(statuses, stream) == OPEN)
    if left.size:
        gap, held, *solids = (_taken(on_host(operand, stream), left) for operand in operands)
        pair, liquid = Pair((solids[0], solids[1]), (solids[2], solids[3])), Liquid(surface_tension=tension)
        suction, volume = (None, held) if control == VOLUME else (held, None)
        force = bridge(pair, gap, suction=suction, volume=volume, liquid=liquid, fields=("force",)).force
        places, values = (cuda.to_device(each, stream=stream) for each in (left, np.asarray(force)))
        _put[blocks_for(left.size), THREADS, stream](places, values, out)


def _taken(operand: NDArray[np.float64], rows: NDArray[np.intp]) -> NDArray[np.float64]:
    return np.full(rows.size, operand[0]) if operand.size == 1 else operand[rows]
