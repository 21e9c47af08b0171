"""Forces of all bridges in one step of a DEM code, on a GPU: one launch from positions to forces, energy and virial.

Each thread takes a contact: it measures the gap, tells whether a bridge stands there, asks the table together with the
threads beside it, and adds the pull to its two particles by atomic additions in float64, whose order is any. Sums over
all bridges are those of threads, then of blocks, in a fixed order. With :func:`sums_in_order`
forces too are the same in every run, to the last bit: each particle then adds up its own contacts, in a second launch.
"""

import math
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from ..ground.check import in_range, scalar
from ..ground.compile import compiled, kernel
from ..ground.device import (
    IS_SIMULATED,
    THREADS,
    at_most,
    blocks_for,
    cuda,
    handed_back,
    home_of,
    is_on_device,
    on_host,
    read_one,
    types,
    wait_for,
)  # fmt: skip
from ..ground.device_groups import Groups, group
from ..ground.rows import element
from ..table import kernels, warps
from ..table.cuda import REGISTERS, DeviceTable, has_warps
from ..table.kernels import Grid
from ..table.packed import WHOLE_WARP, Packed
from ..table.table import operands_of

__all__ = ["DeviceForces", "carried", "contact_forces", "sums_in_order"]

_SUMS = 7  # of all bridges: energy, and the virial in xx, yy, zz, xy, xz, yz
_BLOCKS = 4  # for each multiprocessor, which holds so many of 128 threads with 128 registers
_REGISTERS_WITH_ENERGY = 168  # with 128 a thread moves 216 bytes to and from its memory


class DeviceForces(NamedTuple):
    """What :func:`contact_forces` returns: arrays on the device if one of its arguments lies there, else NumPy's."""

    state: Any  # (contacts,): control of the bridge of each, NaN where there is none; for the next step
    force: Any  # (particles, 3), [N]
    virial: Any  # (3, 3), symmetric, [J]
    energy: Any  # (1,), minus the work that breaks all bridges, [J]; None if it was not asked
    separation: Any  # (contacts,): gap of each, [m]
    attraction: Any  # (contacts,): 0 where there is no bridge, NaN of a pair that is none or out of range, [N]


@kernel
def _distance_of(positions: Any, first: int, second: int) -> float:
    """Between two centres."""
    x = positions[second, 0] - positions[first, 0]
    y = positions[second, 1] - positions[first, 1]
    z = positions[second, 2] - positions[first, 2]
    return math.sqrt(x * x + y * y + z * z)


@kernel
def _is_pair(first: int, second: int, particles: int) -> bool:
    return 0 <= first < particles and 0 <= second < particles and first != second


@cuda.jit(device=True)
def _pull_shared(
    grid: Grid, packed: Packed, gap: float, control: float, radius1: float, radius2: float, tension: float
) -> warps.Pull:
    """Attraction and energy, by threads that share contacts."""
    if not cuda.any_sync(WHOLE_WARP, gap < math.inf):
        return warps.Pull(0.0, 0.0)
    return warps.pull(grid, packed, gap, control, radius1, radius2, tension)


@cuda.jit(device=True)
def _force_shared(
    grid: Grid, packed: Packed, gap: float, control: float, radius1: float, radius2: float, tension: float
) -> warps.Pull:
    """Attraction without the energy."""
    if not cuda.any_sync(WHOLE_WARP, gap < math.inf):
        return warps.Pull(0.0, 0.0)
    return warps.Pull(warps.force(grid, packed, gap, control, radius1, radius2, tension), 0.0)


@cache
def _pull_alone() -> Any:
    """Attraction and energy, by one thread alone."""
    force, energy = compiled(kernels.force), compiled(kernels.energy)

    @cuda.jit(device=True)
    def pull(
        grid: Grid, packed: Packed, gap: float, control: float, radius1: float, radius2: float, tension: float
    ) -> warps.Pull:
        return warps.Pull(
            force(grid, gap, control, radius1, radius2, tension), energy(grid, gap, control, radius1, radius2, tension)
        )

    return pull


def pull_by(with_energy: bool) -> tuple[Any, int]:
    """How bridges are asked of a table, and how many registers that needs."""
    if not has_warps():
        return _pull_alone(), REGISTERS
    return (_pull_shared, _REGISTERS_WITH_ENERGY) if with_energy else (_force_shared, REGISTERS)


@cuda.jit(device=True)
def _sum_up(sums: Any, thread: int) -> None:
    """Sums of the threads of a block, in row 0."""
    half = THREADS // 2
    while half:
        cuda.syncthreads()
        if thread < half:
            for k in range(_SUMS):
                sums[thread, k] += sums[thread + half, k]
        half //= 2
    cuda.syncthreads()


@cuda.jit(device=True)
def _add_to(force: Any, particle: int, x: float, y: float, z: float) -> None:
    cuda.atomic.add(force, (particle, 0), x)
    cuda.atomic.add(force, (particle, 1), y)
    cuda.atomic.add(force, (particle, 2), z)


@cuda.jit(device=True)
def _total(sums: Any, parts: Any, finished: Any, totals: Any) -> None:
    """Energy and virial of all blocks, by the one that is done last."""
    thread = cuda.threadIdx.x
    is_last = cuda.shared.array(1, types.int64)
    cuda.threadfence()
    cuda.syncthreads()
    if thread == 0:
        is_last[0] = cuda.atomic.add(finished, 0, 1) == cuda.gridDim.x - 1
    cuda.syncthreads()
    if not is_last[0]:
        return
    cuda.threadfence()  # what other blocks wrote is read anew
    for k in range(_SUMS):
        sums[thread, k] = 0.0
        for block in range(thread, cuda.gridDim.x, THREADS):
            sums[thread, k] += parts[block, k]
    _sum_up(sums, thread)
    if thread == 0:
        totals[0] = sums[0, 0]
        for k in range(3):
            totals[1 + 4 * k] = sums[0, 1 + k]
        totals[2], totals[4] = sums[0, 4], sums[0, 4]
        totals[3], totals[7] = sums[0, 5], sums[0, 5]
        totals[6], totals[8] = sums[0, 6], sums[0, 6]


@cache
def step_loop(pull: Any, adds: bool, registers: int) -> Any:
    """Contacts, one for each thread at a time; with sums for the particles, or for those of all bridges alone."""
    at, is_pair, distance_between = compiled(element), compiled(_is_pair), compiled(_distance_of)

    @cuda.jit(**at_most(registers))
    def loop(
        grid: Grid, packed: Packed, pairs: Any, positions: Any, radii: Any, control: Any, tension: float, reach: float,
        former: Any, state: Any, separation: Any, attraction: Any, force: Any, parts: Any, finished: Any,
        totals: Any,
    ) -> None:  # fmt: skip
        count, thread = separation.size, cuda.threadIdx.x
        energy = xx = yy = zz = xy = xz = yz = 0.0
        for begin in range(cuda.blockIdx.x * THREADS, count, cuda.gridDim.x * THREADS):
            contact = min(begin + thread, count - 1)  # threads beyond the last one keep their warp whole
            is_own = begin + thread < count
            first, second = pairs[contact, 0], pairs[contact, 1]
            joins = is_pair(first, second, radii.size)
            low, high = (first, second) if joins else (0, 0)
            distance = distance_between(positions, low, high)
            joins = joins and distance > 0.0
            gap = distance - (radii[low] + radii[high])
            before = former[contact] if former.size else math.nan
            kept = before == before
            holds = joins and (kept or gap <= reach)
            held = before if kept and grid.is_volume else at(control, contact)
            found = pull(grid, packed, gap if holds else math.inf, held, radii[low], radii[high], tension)
            drawn = found.force if holds else 0.0
            if is_own:
                separation[contact] = gap if joins else math.nan
                attraction[contact] = drawn if joins else math.nan
                state[contact] = held if drawn != 0.0 else math.nan
            if is_own and drawn != 0.0:
                x = positions[high, 0] - positions[low, 0]
                y = positions[high, 1] - positions[low, 1]
                z = positions[high, 2] - positions[low, 2]
                along = drawn / distance
                energy += found.energy
                xx, yy, zz = xx - along * x * x, yy - along * y * y, zz - along * z * z
                xy, xz, yz = xy - along * x * y, xz - along * x * z, yz - along * y * z
                if adds:
                    _add_to(force, low, along * x, along * y, along * z)
                    _add_to(force, high, -along * x, -along * y, -along * z)
        sums = cuda.shared.array((THREADS, _SUMS), types.float64)
        sums[thread, 0], sums[thread, 1], sums[thread, 2], sums[thread, 3] = energy, xx, yy, zz
        sums[thread, 4], sums[thread, 5], sums[thread, 6] = xy, xz, yz
        _sum_up(sums, thread)
        if thread < _SUMS:
            parts[cuda.blockIdx.x, thread] = sums[0, thread]
        _total(sums, parts, finished, totals)

    return loop


@cuda.jit
def clear(force: Any, finished: Any) -> None:
    i = cuda.grid(1)
    if i == 0:
        finished[0] = 0
    if i < force.shape[0]:
        for k in range(3):
            force[i, k] = 0.0


@cache
def add_up() -> Any:
    """Pulls of the contacts of each particle, in their order, one particle for each thread."""
    is_pair, distance_between = compiled(_is_pair), compiled(_distance_of)

    @cuda.jit
    def loop(start: Any, items: Any, pairs: Any, positions: Any, attraction: Any, force: Any) -> None:
        particle = cuda.grid(1)
        if particle >= force.shape[0]:
            return
        x = y = z = 0.0
        for place in range(start[particle], start[particle + 1]):
            contact = items[place] // 2
            other = pairs[contact, 1 - items[place] % 2]
            drawn = attraction[contact]
            if drawn != 0.0 and is_pair(particle, other, force.shape[0]):
                along = drawn / distance_between(positions, particle, other)
                x += along * (positions[other, 0] - positions[particle, 0])
                y += along * (positions[other, 1] - positions[particle, 1])
                z += along * (positions[other, 2] - positions[particle, 2])
        force[particle, 0], force[particle, 1], force[particle, 2] = x, y, z

    return loop


@cuda.jit
def carry(start: Any, items: Any, former_pairs: Any, former: Any, pairs: Any, state: Any, counts: Any) -> None:
    """States of the same pairs in a former list; counts of those that stood and of those that were found."""
    i = cuda.grid(1)
    if i < former.size and former[i] == former[i]:
        cuda.atomic.add(counts, 0, 1)
    if i < state.size:
        state[i] = math.nan
        first, second = pairs[i, 0], pairs[i, 1]
        if 0 <= first < start.size - 1:
            for place in range(start[first], start[first + 1]):
                contact = items[place] // 2
                if former_pairs[contact, 1 - items[place] % 2] == second:
                    state[i] = former[contact]
        if state[i] == state[i]:
            cuda.atomic.add(counts, 1, 1)


def _there(name: str, value: Any, unit: str, shape: tuple[int | None, ...], stream: Any) -> Any:
    """An argument on the device, of a shape in which None is any length."""
    array = read_one(name, value, unit, stream)
    if len(array.shape) != len(shape) or any(
        want not in (None, have) for want, have in zip(shape, array.shape, strict=True)
    ):
        wanted = str(shape).replace("None", "any")
        raise ValueError(f"{name}: an array of shape {tuple(array.shape)} is not of shape {wanted}")
    return array if is_on_device(array) else cuda.to_device(np.ascontiguousarray(array), stream=stream)


def _listed(name: str, pairs: Any, stream: Any) -> Any:
    """Pairs on the device."""
    if is_on_device(pairs):
        array = read_one(name, pairs, "", stream, "int64 int32")
    else:
        array = np.ascontiguousarray(pairs)
        array = array if array.size else np.empty((0, 2), np.int64)
    if len(array.shape) != 2 or array.shape[1] != 2 or array.dtype.kind != "i":
        given = f"an array of {array.dtype} of shape {tuple(array.shape)}"
        raise ValueError(f"{name}: {given} is not one of integers of shape (contacts, 2)")
    return array if is_on_device(array) else cuda.to_device(array, stream=stream)


def _control(table: DeviceTable, control: Any, contacts: int, stream: Any) -> Any:
    """One number for all contacts, or one for each, on the device."""
    unit = operands_of(table.control)[table.control]
    is_number = not is_on_device(control) and np.ndim(control) == 0
    given = np.full(1, scalar("control", control, unit)) if is_number else control
    array = _there("control", given, unit, (None,), stream)
    if array.size not in (1, contacts):
        raise ValueError(
            f"control: an array of shape {tuple(array.shape)} is not one number for each of {contacts} pairs"
        )
    return array


def _most_blocks() -> int:
    processors = 1 if IS_SIMULATED else cuda.get_current_device().MULTIPROCESSOR_COUNT
    return _BLOCKS * int(processors)


def contact_forces(
    table: DeviceTable,
    pairs: Any,
    positions: Any,
    radii: Any,
    control: Any,
    surface_tension: float,
    *,
    state: Any = None,
    formation_distance: float = 0.0,
    with_energy: bool = False,
    sums: Groups | None = None,
) -> DeviceForces:
    """Forces of the liquid bridges between spheres, as those of :func:`pendular.contact_forces`, on a GPU.

    Arrays on the device of any library or NumPy arrays, contiguous. Nothing is refused there but shapes and types: a
    pair that does not join two particles with centres apart gives NaN and pulls at none, a bridge out of the range of
    the table gives NaN to both of its particles, and one that is listed twice pulls twice.

    Parameters
    ----------
    table : DeviceTable
        Made by :func:`pendular.table.cuda.to_device`.
    pairs : array of int64 or int32, (contacts, 2)
        Particles that are close, each pair once, in any order.
    positions : array, (particles, 3)
        Centres, [m].
    radii : array, (particles,)
        [m].
    control : float or array, (contacts,) or (1,)
        Suction in each bridge, [Pa], or the volume, [m³], of those that form now.
    surface_tension : float
        [N/m].
    state : array, (contacts,), optional
        That of the step before with the same list, or :func:`carried` to this one; no bridges by default.
    formation_distance : float
        [m].
    with_energy : bool
        Whether the potential is worked out, which costs some more cells of the table for each bridge.
    sums : Groups, optional
        Of :func:`sums_in_order` for this list: forces are then the same in every run to the last bit.

    Returns
    -------
    DeviceForces

    Raises
    ------
    ValueError
        For shapes and types that are not those above.
    """
    tension = scalar("surface_tension", surface_tension, "N/m")
    in_range("surface_tension", tension, 0.0, brackets="(]", unit="N/m")
    reach = scalar("formation_distance", formation_distance, "m")
    in_range("formation_distance", reach, 0.0, unit="m")
    like, stream, waits = home_of((pairs, positions, radii, control, state))
    listed = _listed("pairs", pairs, stream)
    contacts = listed.shape[0]
    sizes = _there("radii", radii, "m", (None,), stream)
    centres = _there("positions", positions, "m", (sizes.size, 3), stream)
    held = _control(table, control, contacts, stream)
    former = _there("state", np.empty(0) if state is None else state, "", (0 if state is None else contacts,), stream)
    rows = [cuda.device_array(max(contacts, 1), stream=stream)[:contacts] for _ in range(3)]
    force, totals = cuda.device_array((sizes.size, 3), stream=stream), cuda.device_array(10, stream=stream)
    blocks = min(max(blocks_for(contacts), 1), _most_blocks())
    parts, finished = cuda.device_array((blocks, _SUMS), stream=stream), cuda.device_array(1, np.int64, stream=stream)
    clear[blocks_for(sizes.size + 1), THREADS, stream](force, finished)
    pull, registers = pull_by(with_energy)
    step_loop(pull, sums is None, registers)[blocks, THREADS, stream](
        table.grid, table.packed, listed, centres, sizes, held, tension, reach, former, *rows, force, parts, finished,
        totals,
    )  # fmt: skip
    if sums is not None and sizes.size:
        add_up()[blocks_for(sizes.size), THREADS, stream](*sums, listed, centres, rows[2], force)
    energy = totals[:1] if with_energy else None
    found = (rows[0], force, totals[1:].reshape((3, 3)), energy, rows[1], rows[2])
    if like is None:
        return DeviceForces(*(None if array is None else on_host(array, stream) for array in found))
    if waits:
        wait_for(stream)
    return DeviceForces(*(None if array is None else handed_back(array, like, stream) for array in found))


def sums_in_order(pairs: Any, particles: int) -> Groups:
    """Which contacts are those of each particle, in their order, for sums that are the same in every run.

    It serves as long as the list of pairs stays, and waits once for the device.

    Parameters
    ----------
    pairs : array of int64 or int32, (contacts, 2)
        As for :func:`contact_forces`.
    particles : int
        How many there are.

    Returns
    -------
    Groups
        For ``sums`` of :func:`contact_forces`.
    """
    _, stream, _ = home_of((pairs,))
    listed = _listed("pairs", pairs, stream)
    return group(listed.reshape(listed.size), particles, stream, in_order=True)


def carried(state: Any, former_pairs: Any, pairs: Any, particles: int) -> Any:
    """The state of a step in the order of a new list of pairs; it waits for the device.

    Parameters
    ----------
    state : array, (contacts,)
        That of :func:`contact_forces`.
    former_pairs, pairs : array of int64 or int32, (contacts, 2)
        The list to which the state belongs, and the new one; the two of a pair may change places.
    particles : int
        How many there are.

    Returns
    -------
    array
        The state for the new list.

    Raises
    ------
    ValueError
        If a bridge that stood is of a pair that the new list has not.
    """
    like, stream, _ = home_of((state, former_pairs, pairs))
    listed, former_list = _listed("pairs", pairs, stream), _listed("former_pairs", former_pairs, stream)
    former = _there("state", state, "", (former_list.shape[0],), stream)
    groups = group(former_list.reshape(former_list.size), particles, stream, in_order=False)
    fresh = cuda.device_array(max(listed.shape[0], 1), stream=stream)[: listed.shape[0]]
    counts = cuda.to_device(np.zeros(2, np.int64), stream=stream)
    blocks = max(blocks_for(max(former.size, fresh.size)), 1)
    carry[blocks, THREADS, stream](*groups, former_list, former, listed, fresh, counts)
    stood, found = on_host(counts, stream).tolist()
    if found < stood:
        raise ValueError(f"pairs: {stood - found} of {stood} bridges stand between pairs that are not there")
    return on_host(fresh, stream) if like is None else handed_back(fresh, like, stream)
