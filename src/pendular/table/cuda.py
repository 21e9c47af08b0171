"""A table on a GPU: its answers over arrays that lie there.

Numba compiles the scalar kernels of ``pendular.table.kernels`` for the GPU as they stand, here and in any kernel under
``@cuda.jit`` that calls them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from typing import Any, Literal

import numpy as np

try:
    from numba import config, cuda
except ModuleNotFoundError as absent:
    raise ModuleNotFoundError("pendular.table.cuda needs Numba, which is not installed; pip install numba") from absent
from numpy.typing import ArrayLike

from ..ground.check import numbers, result_array
from ..ground.compile import compiled, kernel, let_numba_call_kernels
from ..ground.rows import element
from . import kernels
from .kernels import Grid
from .table import Table, operands_of

__all__ = ["DeviceTable", "to_device"]

if not config.ENABLE_CUDASIM:  # type: ignore[attr-defined]
    from numba.cuda.descriptor import cuda_target

    let_numba_call_kernels(cuda_target.typing_context)  # in kernels under ``@cuda.jit``

Operand = ArrayLike | Any  # numbers, or any array on the device

THREADS = 128  # in a block


@kernel
def _rupture_distance(
    grid: Grid, separation: float, control: float, radius1: float, radius2: float, surface_tension: float
) -> float:
    """The kernel of that name with the arguments of the others."""
    return kernels.rupture_distance(grid, control, radius1, radius2, surface_tension)


@cache
def loop_of(scalar: Callable[..., float]) -> Any:
    """A scalar kernel over contacts, one for each thread of the GPU."""
    one, at = compiled(scalar), compiled(element)

    @cuda.jit
    def loop(
        grid: Grid, separation: Any, control: Any, radius1: Any, radius2: Any, surface_tension: Any, out: Any
    ) -> None:
        i = cuda.grid(1)  # type: ignore[attr-defined]
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


@dataclass(frozen=True, eq=False)
class DeviceTable:
    """A table on the GPU, made by :func:`to_device`.

    Each method takes numbers, NumPy arrays, or arrays on the device, of Numba, CuPy, PyTorch or any other library that
    has ``__cuda_array_interface__``: float64, contiguous, and of one shape or of one element for all contacts. If one
    of them is on the device the answer is left there, as an array of Numba, and the call does not wait for it; else it
    is a NumPy array. A pair or a control outside the range of the table gives NaN.

    Parameters
    ----------
    control : {"suction", "volume"}
        What is held constant.
    grid : Grid
        The cells, on the device: the first argument of the scalar kernels in ``pendular.table.kernels``.
    """

    control: Literal["suction", "volume"]
    grid: Grid

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

    def _ask(self, scalar: Callable[..., float], out: Any, *arguments: Operand) -> Any:
        shape, operands = operands_on_device(operands_of(self.control), arguments)
        result = result_on_device(out, shape)
        if result.size > 0:
            blocks = -(-result.size // THREADS)
            loop_of(scalar)[blocks, THREADS](self.grid, *operands, result.reshape(result.size))
        return returned(result, out, shape, any(map(is_on_device, arguments)))


def is_on_device(value: object) -> bool:
    """Whether an object is an array on the device; the simulator's have the first attribute only."""
    return hasattr(value, "__cuda_ndarray__") or hasattr(value, "__cuda_array_interface__")


def _on_device(name: str, value: Any) -> Any:
    """An array on the device as Numba's."""
    array = value if hasattr(value, "__cuda_ndarray__") else cuda.as_cuda_array(value)  # type: ignore[no-untyped-call]
    if array.dtype != np.float64 or not array.is_c_contiguous():
        raise ValueError(f"{name}: is not a contiguous float64 array on the device")
    return array


def _read(name: str, value: Operand, unit: str) -> Any:
    """An operand as an array, where it lies."""
    return _on_device(name, value) if is_on_device(value) else numbers(name, value, unit)


def _flat(name: str, operand: Any, shape: tuple[int, ...]) -> Any:
    """An operand on the device, in one row of one element or of as many as there are contacts."""
    if not is_on_device(operand):
        whole = operand if operand.size == 1 else np.broadcast_to(operand, shape)
        return cuda.to_device(np.ascontiguousarray(whole).reshape(-1))
    if operand.size != 1 and operand.shape != shape:
        raise ValueError(f"{name}: an array on the device of shape {operand.shape} is not repeated to {shape}")
    return operand.reshape(operand.size)


def operands_on_device(units: dict[str, str], arguments: tuple[Operand, ...]) -> tuple[tuple[int, ...], list[Any]]:
    """Shape of the answer, and what is named with its units in rows on the device."""
    read = [_read(name, value, units[name]) for name, value in zip(units, arguments, strict=True)]
    shape = np.broadcast_shapes(*(operand.shape for operand in read))
    return shape, [_flat(name, operand, shape) for name, operand in zip(units, read, strict=True)]


def result_on_device(out: Any, shape: tuple[int, ...]) -> Any:
    """Room for an answer on the device: what is given for it, if that lies there."""
    if is_on_device(out):
        result = _on_device("out", out)
        if result.shape != shape:
            raise ValueError(f"out: is not of shape {shape}")
        return result
    if out is not None:
        result_array(out, shape)
    return cuda.device_array(math.prod(shape))


def returned(result: Any, out: Any, shape: tuple[int, ...], stays: bool) -> Any:
    """An answer where it is wanted."""
    if out is None and stays:
        return result.reshape(shape or 1)
    if out is None:
        return result.copy_to_host().reshape(shape)[()]
    if not is_on_device(out):
        result.copy_to_host(out.reshape(-1))
    return out


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
    if find_spec("numba_cuda") is None and not config.ENABLE_CUDASIM:  # type: ignore[attr-defined]
        raise ModuleNotFoundError("numba-cuda is not installed; pip install 'pendular[cuda]'")
    arrays: dict[str, Any] = {
        name: cuda.to_device(value) for name, value in table.grid._asdict().items() if isinstance(value, np.ndarray)
    }
    return DeviceTable(table.control, table.grid._replace(**arrays))
