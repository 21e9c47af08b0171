"""Arrays on a GPU, of Numba or of another library: read where they lie, and answers handed back in kind.

Arrays of CuPy, PyTorch, JAX and any other library come in by DLPack or ``__cuda_array_interface__``, without a copy.
Work is done on the stream of the first of them, and an answer goes back to its library by DLPack.
"""

import ctypes
import math
import sys
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

try:
    import numba.cuda
    from numba import config
except ModuleNotFoundError as absent:
    raise ModuleNotFoundError("a GPU needs Numba, which is not installed; pip install numba") from absent
from numpy.typing import ArrayLike

from .check import numbers, result_array
from .compile import let_numba_call_kernels

__all__ = [
    "IS_SIMULATED",
    "THREADS",
    "Operand",
    "Work",
    "at_most",
    "blocks_for",
    "cuda",
    "flat",
    "handed_back",
    "home_of",
    "in_chunks",
    "is_large",
    "is_on_device",
    "on_host",
    "read",
    "read_one",
    "result_for",
    "returned",
    "types",
    "wait_for",
]


cuda: Any = numba.cuda  # which has few types of its own
types: Any = numba.types

Operand = ArrayLike | Any  # numbers, or any array on the device

THREADS = 128  # in a block

_CUDA, _CUDA_MANAGED = 2, 13  # kinds of device of DLPack
_LEGACY_DEFAULT, _PER_THREAD_DEFAULT = 1, 2  # names of streams there
IS_SIMULATED: bool = config.ENABLE_CUDASIM  # type: ignore[attr-defined]


if not IS_SIMULATED:
    from numba.cuda.descriptor import cuda_target

    let_numba_call_kernels(cuda_target.typing_context)  # in kernels under ``@cuda.jit``


class Work(NamedTuple):
    """What a call works on."""

    shape: tuple[int, ...]  # of the answer
    operands: list[Any]  # arrays of Numba, and numbers on the host
    like: Any  # the first array on the device, None if there is none: the answer is of its library
    stream: Any
    waits: bool  # whether some library does not know of the stream, and might use its memory before the work is done


def at_most(registers: int) -> dict[str, int]:
    """Options of ``@cuda.jit`` for so many registers of a thread; the simulator has none."""
    return {} if IS_SIMULATED else {"max_registers": registers}


def blocks_for(count: int) -> int:
    """Blocks of threads, one for each element."""
    return -(-count // THREADS)


def is_on_device(value: Any) -> bool:
    """Whether an object is an array on a GPU; the simulator's have the first attribute only."""
    if hasattr(value, "__cuda_ndarray__"):
        return True
    if hasattr(value, "__dlpack_device__"):
        return value.__dlpack_device__()[0] in (_CUDA, _CUDA_MANAGED)
    return hasattr(value, "__cuda_array_interface__")


class _Lent:
    """Memory of another library, for Numba; it is held as long as this is."""

    def __init__(self, view: Any) -> None:
        size = view.dtype.itemsize
        strides = None if view.strides is None else tuple(size * stride for stride in view.strides)
        self.owner = view
        self.__cuda_array_interface__ = {
            "shape": tuple(view.shape),
            "typestr": view.dtype.str,
            "data": (view.ptr, view.readonly),
            "strides": strides,
            "version": 3,
        }


def _library_of(array: Any) -> str:
    return type(array).__module__.partition(".")[0]


def _pointer_of_stream(array: Any) -> int:
    """The current stream of the library of an array, 0 for the default one."""
    library = _library_of(array)
    if library == "torch":
        return int(sys.modules["torch"].cuda.current_stream(array.device).cuda_stream)
    if library == "cupy":
        return int(sys.modules["cupy"].cuda.get_current_stream().ptr)
    return 0


def _knows_streams(array: Any) -> bool:
    return hasattr(array, "__cuda_ndarray__") or _library_of(array) in ("torch", "cupy")


def _stream_of(array: Any) -> Any:
    """Stream on which an array is worked on."""
    if array is None:
        return 0
    if hasattr(array, "__cuda_ndarray__"):
        return getattr(array, "stream", 0)
    pointer = _pointer_of_stream(array)
    return cuda.external_stream(pointer) if pointer and not IS_SIMULATED else 0


def _viewed(name: str, array: Any, stream: Any) -> Any:
    """An array of another library as Numba's, in the same memory, once what was done to it before is done."""
    if not hasattr(array, "__dlpack__"):
        return cuda.as_cuda_array(array)
    from cuda.core.utils import StridedMemoryView  # comes with numba-cuda

    number = array.__dlpack_device__()[1]
    current = 0 if IS_SIMULATED else cuda.get_current_device().id
    if number != current:
        raise ValueError(f"{name}: lies on device {number}, not on the current one, {current}")
    pointer = int(stream) if stream else 0
    lent = _Lent(StridedMemoryView.from_dlpack(array, stream_ptr=pointer or _LEGACY_DEFAULT))
    return _simulated(lent) if IS_SIMULATED else cuda.as_cuda_array(lent)


def _simulated(lent: _Lent) -> Any:
    """Memory of the host as an array of the simulator."""
    from numba.cuda.simulator.cudadrv import devicearray

    described = lent.__cuda_array_interface__
    dtype, shape = np.dtype(described["typestr"]), described["shape"]
    address = (ctypes.c_char * (dtype.itemsize * math.prod(shape))).from_address(described["data"][0])
    array = np.ndarray(shape, dtype, address, strides=described["strides"])
    fake: Any = devicearray.FakeCUDAArray  # a class without types
    whole = fake(array)
    whole.owner = lent
    return whole


def read_one(name: str, value: Operand, unit: str, stream: Any, kinds: str = "float64") -> Any:
    """An operand as an array, where it lies."""
    if not is_on_device(value):
        return numbers(name, value, unit)
    array: Any = value if hasattr(value, "__cuda_ndarray__") else _viewed(name, value, stream)
    if array.dtype not in [np.dtype(kind) for kind in kinds.split()] or not array.is_c_contiguous():
        raise ValueError(f"{name}: is not a contiguous {kinds.replace(' ', ' or ')} array on the device")
    return array


def home_of(arguments: Sequence[Any]) -> tuple[Any, Any, bool]:
    """The first array on the device, its stream, and whether the work has to be waited for."""
    there = [argument for argument in arguments if is_on_device(argument)]
    like = there[0] if there else None
    return like, _stream_of(like), not all(map(_knows_streams, there))


def read(units: dict[str, str], arguments: Sequence[Operand]) -> Work:
    """What is named with its units, as arrays where they lie, and the shape of the answer."""
    like, stream, waits = home_of(arguments)
    operands = [
        read_one(name, value, unit, stream) for (name, unit), value in zip(units.items(), arguments, strict=True)
    ]
    shape = np.broadcast_shapes(*(operand.shape for operand in operands))
    for name, operand in zip(units, operands, strict=True):
        if is_on_device(operand) and operand.size != 1 and operand.shape != shape:
            raise ValueError(f"{name}: an array on the device of shape {operand.shape} is not repeated to {shape}")
    return Work(shape, operands, like, stream, waits)


def flat(work: Work) -> list[Any]:
    """Operands on the device, each in one row of one element or of as many as the answer has."""
    return [_flat(operand, work.shape, work.stream) for operand in work.operands]


def _flat(operand: Any, shape: tuple[int, ...], stream: Any) -> Any:
    if is_on_device(operand):
        return operand.reshape(operand.size)
    whole = operand if operand.size == 1 else np.broadcast_to(operand, shape)
    return cuda.to_device(np.ascontiguousarray(whole).reshape(-1), stream=stream)


def result_for(out: Any, work: Work) -> Any:
    """Room for an answer on the device: what is given for it, if that lies there."""
    if is_on_device(out):
        result = read_one("out", out, "", work.stream)
        if result.shape != work.shape:
            raise ValueError(f"out: is not of shape {work.shape}")
        return result
    if out is not None:
        result_array(out, work.shape)
    return cuda.device_array(math.prod(work.shape), stream=work.stream)


def returned(result: Any, out: Any, work: Work) -> Any:
    """An answer where it is wanted."""
    if work.waits or (is_on_device(out) and not _knows_streams(out)):
        wait_for(work.stream)
    if out is None and work.like is not None:
        return handed_back(result.reshape(work.shape or 1), work.like, work.stream)
    if out is None:
        return on_host(result, work.stream).reshape(work.shape)[()]
    if not is_on_device(out):
        on_host(result, work.stream, out.reshape(-1))
    return out


_CHUNK = 1 << 20  # rows that are sent at once
_LANES = 3  # chunks on the way: one comes, one is worked on, one goes


class _Slot(NamedTuple):
    """Memory for a chunk that is on the way: on the host, from which the device copies by itself, and on the device."""

    stream: Any
    sent: list[Any]  # None for an operand of one element
    there: list[Any]
    result: Any
    back: Any


def is_large(work: Work) -> bool:
    """Whether all is on the host, and so much that copies are worth to go on beside the work."""
    return work.like is None and math.prod(work.shape) > _CHUNK


def in_chunks(work: Work, result: Any, launch: Callable[[list[Any], Any, Any], None]) -> Any:
    """Fill an array of the host by chunks: one is copied while another is worked on.

    ``launch`` takes operands on the device in rows, room for the result, and the stream.
    """
    size = math.prod(work.shape)
    rows = [
        operand if operand.size == 1 else np.broadcast_to(operand, work.shape).reshape(-1) for operand in work.operands
    ]
    flat_result = result.reshape(-1)
    slots = [_slot(rows) for _ in range(_LANES)]
    going: list[tuple[_Slot, int, int]] = []
    for number, begin in enumerate(range(0, size, _CHUNK)):
        end = min(begin + _CHUNK, size)
        if len(going) == _LANES:
            _take(*going.pop(0), flat_result)
        slot = slots[number % _LANES]
        _send(slot, rows, begin, end)
        operands = [
            there if row.size == 1 else there[: end - begin] for row, there in zip(rows, slot.there, strict=True)
        ]
        launch(operands, slot.result[: end - begin], slot.stream)
        slot.result[: end - begin].copy_to_host(slot.back[: end - begin], stream=slot.stream)
        going.append((slot, begin, end))
    for each in going:
        _take(*each, flat_result)
    return result


def _slot(rows: list[Any]) -> _Slot:
    """Room for a chunk of such rows; an operand of one element is sent here, once."""
    stream = cuda.stream()
    return _Slot(
        stream,
        [None if row.size == 1 else cuda.pinned_array(_CHUNK) for row in rows],
        [
            cuda.to_device(np.ascontiguousarray(row).reshape(-1), stream=stream)
            if row.size == 1
            else cuda.device_array(_CHUNK, stream=stream)
            for row in rows
        ],
        cuda.device_array(_CHUNK, stream=stream),
        cuda.pinned_array(_CHUNK),
    )


def _send(slot: _Slot, rows: list[Any], begin: int, end: int) -> None:
    """Begin to copy a chunk to the device."""
    for row, sent, there in zip(rows, slot.sent, slot.there, strict=True):
        if sent is not None:
            sent[: end - begin] = row[begin:end]
            there[: end - begin].copy_to_device(sent[: end - begin], stream=slot.stream)


def _take(slot: _Slot, begin: int, end: int, result: Any) -> None:
    """Wait for a chunk, and put it in its place."""
    wait_for(slot.stream)
    result[begin:end] = slot.back[: end - begin]


def on_host(array: Any, stream: Any, into: Any = None) -> Any:
    """An array of the device on the host, once the work on its stream is done."""
    copy = array.copy_to_host(into, stream=stream)
    wait_for(stream)
    return copy


def wait_for(stream: Any) -> None:
    """Wait until the work on a stream is done."""
    if stream:
        stream.synchronize()
    else:
        cuda.synchronize()


class _HandedBack:
    """An array of Numba for DLPack, ready on the stream of the library that takes it."""

    def __init__(self, array: Any, stream: Any) -> None:
        self._array, self._stream = array, stream

    def __dlpack_device__(self) -> tuple[int, int]:
        return self._view().__dlpack_device__()

    def __dlpack__(self, *, stream: int | None = None, **options: Any) -> Any:
        if not IS_SIMULATED and stream != -1:
            theirs = _stream_named(_LEGACY_DEFAULT if stream is None else stream)
            event = cuda.event(timing=False)
            event.record(self._stream)
            event.wait(theirs)
        return self._view().__dlpack__(**options)

    def _view(self) -> Any:
        if IS_SIMULATED:
            return self._array._ary
        from cuda.core.utils import StridedMemoryView

        return StridedMemoryView.from_cuda_array_interface(self._array, stream_ptr=-1)


def _stream_named(number: int) -> Any:
    """Stream that DLPack names so."""
    if number == _LEGACY_DEFAULT:
        return cuda.legacy_default_stream()
    if number == _PER_THREAD_DEFAULT:
        return cuda.per_thread_default_stream()
    return cuda.external_stream(number)


def handed_back(array: Any, like: Any, stream: Any) -> Any:
    """An array of Numba as one of the library of another array, in the same memory."""
    if hasattr(like, "__cuda_ndarray__"):
        return array
    own = getattr(like, "__array_namespace__", None)  # that PyTorch has not
    library = own() if own else sys.modules[_library_of(like)]
    return library.from_dlpack(_HandedBack(array, stream)) if hasattr(library, "from_dlpack") else array
