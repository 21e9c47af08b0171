"""One way to compile: a kernel is a plain function with a mark, and Numba makes machine code of it where that pays.

Every kernel is a scalar function of floats. Plain Python calls it as it stands. Compiled, it follows the error model of
NumPy: a division by zero gives inf or NaN, as NaN marks "outside the domain" throughout. Numba is imported when a
kernel is to be compiled, not before.
"""

from collections.abc import Callable
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from types import CellType, FunctionType, ModuleType
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Kernel", "compiled", "constants", "fastmath_of", "has_compiler", "is_kernel", "kernel", "kernel_written_in",
    "let_numba_call_kernels", "marked_as", "rebound", "summing_kernel", "tried",
]  # fmt: skip

Kernel = TypeVar("Kernel", bound=Callable[..., Any])

# Sums may be added up in any order, several at once; NaN, infinity and every other rule of arithmetic stay.
_ANY_ORDER = frozenset({"reassoc", "contract"})

_fastmath: dict[Any, frozenset[str]] = {}  # of each kernel
_writers: dict[Any, str] = {}  # of the compiled form of a few
_copies: set[Any] = set()  # kernels whose file does not tell what they call
_tried: dict[Any, Any] = {}  # what is tried, by what tries it
_typing_contexts: list[Any] = []  # of Numba, that know the kernels


def kernel(function: Kernel) -> Kernel:
    """Mark a function that compiled code may call."""
    return _marked(function, frozenset())


def summing_kernel(function: Kernel) -> Kernel:
    """Mark a kernel whose loop adds up many terms, in the lanes of the processor."""
    return _marked(function, _ANY_ORDER)


def kernel_written_in(module: str) -> Callable[[Kernel], Kernel]:
    """Mark a kernel whose compiled form is written by hand, as an overload for Numba, in a module of that name."""

    def mark(function: Kernel) -> Kernel:
        _writers[function] = module
        return kernel(function)

    return mark


def marked_as(original: Callable[..., Any], copy: Kernel) -> Kernel:
    """Mark a copy of a kernel that calls others than the kernel itself."""
    _copies.add(copy)
    _fastmath[copy] = _fastmath[original]
    return copy


def tried(function: Kernel, otherwise: Any) -> Kernel:
    """A kernel that gives something else where plain Python finds no answer, as to 1/0.

    Compiled code gives infinity or NaN in its place, and goes on.
    """

    def attempt(*arguments: Any) -> Any:
        try:
            return function(*arguments)
        except (ArithmeticError, ValueError):
            return otherwise

    _tried[attempt] = function
    return attempt  # type: ignore[return-value]


def _marked(function: Kernel, fastmath: frozenset[str]) -> Kernel:
    _fastmath[function] = fastmath
    for context in _typing_contexts:
        _introduce(context, function)
    return function


class _Constants(list[float]):
    """Numbers that a kernel looks up: plain floats, which cost a third of NumPy's, an array in compiled code."""


def constants(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Numbers that a kernel looks up."""
    return _Constants(values.tolist())  # type: ignore[return-value]


def is_kernel(function: Any) -> bool:
    """Whether a function has the mark."""
    return isinstance(function, FunctionType) and function in _fastmath


@cache
def has_compiler() -> bool:
    """Whether Numba is installed."""
    return find_spec("numba") is not None


@cache
def compiled(function: Callable[..., Any]) -> Any:
    """Return the dispatcher of Numba for a kernel, which keeps its code on disk until a source that enters it changes.

    Without Numba this is the kernel as it stands.
    """
    if not has_compiler():
        return function
    from numba import njit

    from .cache import keep_on_disk

    source = rebound(function, compiled)
    dispatcher = njit(error_model="numpy", nogil=True, fastmath=fastmath_of(function))(source)
    if dispatcher is not source and function not in _copies:  # it is with the compiler off
        keep_on_disk(dispatcher)
    return dispatcher


def rebound(function: Callable[..., Any], into: Callable[[Any], Any]) -> Callable[..., Any]:
    """Copy a kernel so that all it calls, or looks up, is the compiled form of it; ``into`` gives that of a kernel."""
    assert isinstance(function, FunctionType)
    for module in set(_writers.values()):  # Numba learns of overloads before it begins, not on the way
        import_module(module)
    closure = tuple(CellType(_form(cell.cell_contents, into)) for cell in function.__closure__ or ())
    scope = _Scope(function.__globals__, into)
    copy = FunctionType(function.__code__, scope, function.__name__, function.__defaults__, closure)
    for name in ("__kwdefaults__", "__qualname__", "__module__", "__annotations__"):
        setattr(copy, name, getattr(function, name))
    return copy


class _Scope(dict[str, Any]):
    """Global names of a kernel as compiled code sees them, each when it is looked up."""

    def __init__(self, names: dict[str, Any], into: Callable[[Any], Any]) -> None:
        super().__init__()
        self._names, self._into = names, into

    def __missing__(self, name: str) -> Any:
        value = self[name] = _form(self._names[name], self._into)
        return value


def _form(value: Any, into: Callable[[Any], Any]) -> Any:
    if isinstance(value, _Constants):
        return np.array(value)
    if isinstance(value, FunctionType) and value in _tried:
        value = _tried[value]
    if is_kernel(value) and value not in _writers:
        return into(value)
    if isinstance(value, ModuleType) and value.__name__.startswith(f"{__package__.partition('.')[0]}."):
        return _Rebound(value, into)
    return value


class _Rebound(ModuleType):
    """A module of kernels as compiled code sees it."""

    def __init__(self, module: ModuleType, into: Callable[[Any], Any]) -> None:
        super().__init__(module.__name__)
        self.__dict__.update(_module=module, _into=into)

    def __getattr__(self, name: str) -> Any:
        value = _form(getattr(self._module, name), self._into)
        self.__dict__[name] = value
        return value


def let_numba_call_kernels(context: Any = None) -> None:
    """Let compiled code of anyone call kernels as they stand; Numba calls this when it compiles for the first time.

    ``context`` is the typing context of another target than the processor.
    """
    if context is None:
        from numba.core.registry import cpu_target

        context = cpu_target.typing_context
    if context not in _typing_contexts:
        _typing_contexts.append(context)
        for function in _fastmath:
            _introduce(context, function)


def _introduce(context: Any, function: Callable[..., Any]) -> None:
    if function not in _writers:
        context.insert_global(function, context.resolve_value_type(compiled(function)))


def fastmath_of(function: Callable[..., Any]) -> set[str]:
    """Rules of arithmetic that a kernel does without."""
    return set(_fastmath[function])
