"""A table on a GPU: its answers over arrays that lie there.

Numba compiles the scalar kernels of ``pendular.table.kernels`` for the GPU as they stand, here and in any kernel under
``@cuda.jit`` that calls them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from importlib.util import find_spec
from typing import Any, Literal

import numpy as np

from ..ground.check import result_array
from ..ground.compile import compiled, kernel
from ..ground.device import (
    IS_SIMULATED,
    THREADS,
    Operand,
    at_most,
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
)
from ..ground.device_groups import group
from ..ground.rows import element
from . import kernels, warps
from .kernels import Grid
from .packed import Packed, pack
from .polynomial import Cells, cell_count
from .table import Table, operands_of

__all__ = ["DeviceTable", "to_device"]

REGISTERS = 128  # of a thread at most: 16 warps find room where a multiprocessor has 65536


@kernel
def _rupture_distance(
    grid: Grid, separation: float, control: float, radius1: float, radius2: float, surface_tension: float
) -> float:
    """The kernel of that name with the arguments of the others."""
    return kernels.rupture_distance(grid, control, radius1, radius2, surface_tension)


@kernel
def cell_number(
    grid: Grid, separation: float, control: float, radius1: float, radius2: float, surface_tension: float
) -> int:
    """Cell in which the force of a contact is found."""
    _, place, rupture, bend = kernels.find(grid, control, radius1, radius2, surface_tension)
    return kernels.cell_of(grid, place, kernels.q_of(separation, rupture, bend))[0]


@cache
def loop_of(scalar: Callable[..., float]) -> Any:
    """A scalar kernel over contacts, one for each thread of the GPU, which works alone."""
    one, at = compiled(scalar), compiled(element)

    @cuda.jit
    def loop(
        grid: Grid, separation: Any, control: Any, radius1: Any, radius2: Any, surface_tension: Any, out: Any
    ) -> None:
        i = cuda.grid(1)
        if i < out.size:
            out[i] = one(
                grid,
                at(separation, i),
                at(control, i),
                at(radius1, i),
                at(radius2, i),
                at(surface_tension, i),
            )

    return loop


@cache
def loop_by_warps(shared: Any) -> Any:
    """A function of `warps` over contacts, one for each thread; threads beyond the last keep their warp whole."""
    at = compiled(element)

    @cuda.jit(**at_most(REGISTERS))
    def loop(
        grid: Grid, packed: Packed, separation: Any, control: Any, radius1: Any, radius2: Any, surface_tension: Any,
        out: Any,
    ) -> None:  # fmt: skip
        i = cuda.grid(1)
        k = min(i, out.size - 1)
        found = shared(
            grid, packed, at(separation, k), at(control, k), at(radius1, k), at(radius2, k), at(surface_tension, k)
        )
        if i < out.size:
            out[i] = found

    return loop


def has_warps() -> bool:
    """Whether threads can hand on numbers to one another, which those of Numba's simulator cannot."""
    return hasattr(cuda, "shfl_sync")


SHARED = {
    kernels.force: warps.force,
    kernels.liquid: warps.liquid,
    kernels.stiffness: warps.stiffness,
    kernels.energy: warps.energy,
    _rupture_distance: warps.rupture_distance,
}


@dataclass(frozen=True, eq=False)
class DeviceTable:
    """A table on the GPU, made by :func:`to_device`.

    Each method takes numbers, NumPy arrays, or arrays on the device, of Numba, CuPy, PyTorch, JAX or any other library
    that has DLPack or ``__cuda_array_interface__``: float64, contiguous, and of one shape or of one element for all
    contacts. They are read where they lie. If one of them is on the device the answer is left there, as an array of
    the library of the first, worked out on its current stream, and the call does not wait for it; else it is a NumPy
    array. A pair or a control outside the range of the table gives NaN.

    Parameters
    ----------
    control : {"suction", "volume"}
        What is held constant.
    grid : Grid
        The cells, on the device: the first argument of the scalar kernels in ``pendular.table.kernels``.
    packed : Packed
        Their coefficients once more, as threads that share a contact read them.
    """

    control: Literal["suction", "volume"]
    grid: Grid
    packed: Packed

    def force(
        self,
        separation: Operand,
        control: Operand,
        radius1: Operand,
        radius2: Operand,
        surface_tension: Operand,
        *,
        out: Any = None,
    ) -> Any:
        """Attraction of two solids, exactly 0.0 from the rupture distance on.

        Parameters
        ----------
        separation : array
            Whole gap, [m]. Solids that overlap count as touching.
        control : array
            Suction, [Pa], or liquid volume, [m³].
        radius1, radius2 : array
            Radii, [m], infinite for a plane.
        surface_tension : array
            [N/m].
        out : array, optional
            Where to store the result, on the device or not: float64, contiguous, of the shape of the contacts.

        Returns
        -------
        array
            [N], NaN where an argument is NaN or out of range.

        Raises
        ------
        ValueError
            For an array on the device of another kind, or shapes that do not go together.
        """
        return self._ask(kernels.force, out, separation, control, radius1, radius2, surface_tension)

    def liquid(
        self,
        separation: Operand,
        control: Operand,
        radius1: Operand,
        radius2: Operand,
        surface_tension: Operand,
        *,
        out: Any = None,
    ) -> Any:
        """Liquid volume under suction, [m³], or suction at constant volume, [Pa]; NaN where there is no bridge."""
        return self._ask(kernels.liquid, out, separation, control, radius1, radius2, surface_tension)

    def stiffness(
        self,
        separation: Operand,
        control: Operand,
        radius1: Operand,
        radius2: Operand,
        surface_tension: Operand,
        *,
        out: Any = None,
    ) -> Any:
        """Rate dF/dD with the control held, [N/m]; 0 in an overlap, NaN where there is no bridge."""
        return self._ask(kernels.stiffness, out, separation, control, radius1, radius2, surface_tension)

    def energy(
        self,
        separation: Operand,
        control: Operand,
        radius1: Operand,
        radius2: Operand,
        surface_tension: Operand,
        *,
        out: Any = None,
    ) -> Any:
        """Potential with F = dE/dD, [J]: minus the work that breaks the bridge, 0 from the rupture distance on."""
        return self._ask(kernels.energy, out, separation, control, radius1, radius2, surface_tension)

    def rupture_distance(
        self, control: Operand, radius1: Operand, radius2: Operand, surface_tension: Operand, *, out: Any = None
    ) -> Any:
        """Separation at which the bridge breaks, [m]."""
        return self._ask(_rupture_distance, out, 0.0, control, radius1, radius2, surface_tension)

    def order(
        self, separation: Operand, control: Operand, radius1: Operand, radius2: Operand, surface_tension: Operand
    ) -> Any:
        """Order of contacts by the cells of the table, in which they cost least; their order in a cell is any.

        It waits for the device. Contacts change their cells slowly, so an order serves for many steps: take arrays, or
        a list of pairs, in it.

        Returns
        -------
        array
            Numbers of the contacts, int64.
        """
        work = read(operands_of(self.control), (separation, control, radius1, radius2, surface_tension))
        size = math.prod(work.shape)
        cells = cuda.device_array(max(size, 1), np.int64, stream=work.stream)[:size]
        if size:
            loop_of(cell_number)[blocks_for(size), THREADS, work.stream](self.grid, *flat(work), cells)
        found = group(cells, cell_count(self.grid.force), work.stream, in_order=False).items[:size]
        return on_host(found, work.stream) if work.like is None else handed_back(found, work.like, work.stream)

    def _ask(self, scalar: Callable[..., float], out: Any, *arguments: Operand) -> Any:
        work = read(operands_of(self.control), arguments)
        if is_large(work) and not is_on_device(out):
            return in_chunks(work, result_array(out, work.shape), partial(self._fill, scalar))
        result = result_for(out, work)
        if result.size > 0:
            self._fill(scalar, flat(work), result.reshape(result.size), work.stream)
        return returned(result, out, work)

    def _fill(self, scalar: Callable[..., float], operands: list[Any], result: Any, stream: Any) -> None:
        """Launch a question about operands in rows."""
        launch = blocks_for(result.size), THREADS, stream
        if has_warps():
            loop_by_warps(SHARED[scalar])[launch](self.grid, self.packed, *operands, result)
        else:
            loop_of(scalar)[launch](self.grid, *operands, result)


def to_device(table: Table) -> DeviceTable:
    """Put a table on the current GPU, once for all calls.

    Parameters
    ----------
    table : Table
        Made by :func:`pendular.tabulate`.

    Returns
    -------
    DeviceTable

    Raises
    ------
    ModuleNotFoundError
        If numba-cuda is not installed.
    """
    if find_spec("numba_cuda") is None and not IS_SIMULATED:
        raise ModuleNotFoundError("numba-cuda is not installed; pip install 'pendular[cuda]'")
    packed = Packed(*map(cuda.to_device, pack(table.grid)))
    return DeviceTable(table.control, Grid(*map(_there, table.grid)), packed)


def _there(value: Any) -> Any:
    """What a kernel reads, on the device."""
    if isinstance(value, Cells):
        return Cells(*map(cuda.to_device, value))
    return cuda.to_device(value) if isinstance(value, np.ndarray) else value
