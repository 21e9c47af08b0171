"""Lanes of the processor, for Numba: a number of a kernel as a vector of eight, and what is done with it.

Products and sums may be done in one instruction, each lane like every other: what a row gives does not depend on those
beside it.
"""

import math
import operator
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.imputils import lower_builtin, lower_cast
from numba.core.typeconv.castgraph import Conversion
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, models, overload, register_model
from numpy.typing import NDArray

from .compile import compiled, rebound
from .lanes import choose, every, lanes, lanes_of, put_lanes

Floats = NDArray[np.float64]

LANES = 8  # one register of AVX-512, two of AVX2

_CONTRACTED = ("contract",)
_LONG = ir.IntType(64)


class _Numbers(types.Type):
    """A number in each lane."""

    def __init__(self) -> None:
        super().__init__(name=f"Numbers{LANES}")

    def can_convert_from(self, _context: Any, other: Any) -> Any:
        return Conversion.safe if isinstance(other, types.Number) else None

    def unify(self, _context: Any, other: Any) -> Any:
        return self if isinstance(other, types.Number) else None


class _Conditions(types.Type):
    """True or false in each lane."""

    def __init__(self) -> None:
        super().__init__(name=f"Conditions{LANES}")


NUMBERS, CONDITIONS = _Numbers(), _Conditions()
_NUMBERS, _CONDITIONS = ir.VectorType(ir.DoubleType(), LANES), ir.VectorType(ir.IntType(1), LANES)


@register_model(_Numbers)
class _NumbersModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _NUMBERS)  # type: ignore[no-untyped-call]


@register_model(_Conditions)
class _ConditionsModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _CONDITIONS)  # type: ignore[no-untyped-call]


def _splat(builder: Any, value: Any) -> Any:
    first = builder.insert_element(ir.Constant(_NUMBERS, ir.Undefined), value, ir.Constant(_LONG, 0))
    zeros = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return builder.shuffle_vector(first, ir.Constant(_NUMBERS, ir.Undefined), zeros)


@lower_cast(types.Float, _Numbers)  # type: ignore[no-untyped-call, untyped-decorator]
@lower_cast(types.Integer, _Numbers)  # type: ignore[no-untyped-call, untyped-decorator]
def _as_lanes(context: Any, builder: Any, source: Any, _target: Any, value: Any) -> Any:
    return _splat(builder, context.cast(builder, value, source, types.float64))


# -- operations ------------------------------------------------------------------------------------------------------


def _can(operation: Any, result: Any, *operands: Any) -> None:
    """Let Numba know of an operation."""

    class Template(ConcreteTemplate):
        key = operation
        cases: ClassVar[list[Any]] = [signature(result, *operands)]  # type: ignore[no-untyped-call]

    infer_global(operation)(Template)  # type: ignore[no-untyped-call]


def _call(builder: Any, name: str, *values: Any) -> Any:
    kind = values[0].type
    function = cgutils.get_or_insert_function(  # type: ignore[no-untyped-call]
        builder.module, ir.FunctionType(kind, [kind] * len(values)), f"llvm.{name}.v{LANES}f64"
    )
    return builder.call(function, values)


_ARITHMETIC = {
    operator.add: "fadd", operator.iadd: "fadd",
    operator.sub: "fsub", operator.isub: "fsub",
    operator.mul: "fmul", operator.imul: "fmul",
    operator.truediv: "fdiv", operator.itruediv: "fdiv",
}  # fmt: skip
_COMPARED = {operator.lt: "<", operator.gt: ">", operator.le: "<=", operator.ge: ">="}
_JOINED = {operator.and_: "and_", operator.or_: "or_"}


def _arithmetic(operation: Any, name: str) -> None:
    _can(operation, NUMBERS, NUMBERS, NUMBERS)

    @lower_builtin(operation, NUMBERS, NUMBERS)  # type: ignore[no-untyped-call, untyped-decorator]
    def lower(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
        return getattr(builder, name)(*values, flags=_CONTRACTED)


def _compared(operation: Any, sign: str) -> None:
    _can(operation, CONDITIONS, NUMBERS, NUMBERS)

    @lower_builtin(operation, NUMBERS, NUMBERS)  # type: ignore[no-untyped-call, untyped-decorator]
    def lower(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
        return builder.fcmp_ordered(sign, *values)


def _joined(operation: Any, name: str) -> None:
    _can(operation, CONDITIONS, CONDITIONS, CONDITIONS)

    @lower_builtin(operation, CONDITIONS, CONDITIONS)  # type: ignore[no-untyped-call, untyped-decorator]
    def lower(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
        return getattr(builder, name)(*values)


for _operation, _name in _ARITHMETIC.items():
    _arithmetic(_operation, _name)
for _operation, _name in _COMPARED.items():
    _compared(_operation, _name)
for _operation, _name in _JOINED.items():
    _joined(_operation, _name)

_can(operator.neg, NUMBERS, NUMBERS)
_can(abs, NUMBERS, NUMBERS)
_can(math.sqrt, NUMBERS, NUMBERS)
_can(math.floor, NUMBERS, NUMBERS)
_can(min, NUMBERS, NUMBERS, NUMBERS)
_can(max, NUMBERS, NUMBERS, NUMBERS)


@lower_builtin(operator.neg, NUMBERS)  # type: ignore[no-untyped-call, untyped-decorator]
def _negative(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
    return builder.fneg(values[0])


@lower_builtin(abs, NUMBERS)  # type: ignore[no-untyped-call, untyped-decorator]
def _magnitude(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
    return _call(builder, "fabs", *values)


@lower_builtin(math.sqrt, NUMBERS)  # type: ignore[no-untyped-call, untyped-decorator]
def _root(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
    return _call(builder, "sqrt", *values)


@lower_builtin(math.floor, NUMBERS)  # type: ignore[no-untyped-call, untyped-decorator]
def _floor(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
    return _call(builder, "floor", *values)


@lower_builtin(min, NUMBERS, NUMBERS)  # type: ignore[no-untyped-call, untyped-decorator]
def _smaller(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
    first, second = values
    return builder.select(builder.fcmp_ordered("<", second, first), second, first)  # as Python's own


@lower_builtin(max, NUMBERS, NUMBERS)  # type: ignore[no-untyped-call, untyped-decorator]
def _larger(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
    first, second = values
    return builder.select(builder.fcmp_ordered(">", second, first), second, first)


# -- what lanes are told by ------------------------------------------------------------------------------------------


def _pointer(context: Any, builder: Any, kind: Any, array: Any, start: Any) -> Any:
    data = context.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [start]), _NUMBERS.as_pointer())


def _loaded(_typing: Any, array: Any, start: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        return builder.load(_pointer(context, builder, signature.args[0], *values), align=8)

    return NUMBERS(array, types.int64), generate


def _stored(_typing: Any, array: Any, start: Any, numbers: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        builder.store(values[2], _pointer(context, builder, signature.args[0], *values[:2]), align=8)
        return context.get_dummy_value()

    return types.void(array, types.int64, NUMBERS), generate


def _selected(_typing: Any, condition: Any, number: Any, other: Any) -> Any:
    def generate(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
        return builder.select(*values)

    return NUMBERS(CONDITIONS, NUMBERS, NUMBERS), generate


def _all_hold(_typing: Any, condition: Any) -> Any:
    def generate(_context: Any, builder: Any, _signature: Any, values: Any) -> Any:
        bits = builder.bitcast(values[0], ir.IntType(LANES))
        return builder.icmp_unsigned("==", bits, ir.Constant(ir.IntType(LANES), -1))

    return types.boolean(CONDITIONS), generate


_load: Any = intrinsic(_loaded)
_store: Any = intrinsic(_stored)
_select: Any = intrinsic(_selected)
_all: Any = intrinsic(_all_hold)


def _is_of_lanes(kind: Any) -> bool:
    return isinstance(kind, _Conditions)


@overload(choose)
def _choose(condition: bool, number: float, other: float) -> Callable[..., Any]:
    def in_lanes(condition: bool, number: float, other: float) -> float:
        chosen: float = _select(condition, number, other)
        return chosen

    return in_lanes if _is_of_lanes(condition) else rebound(choose, compiled)


@overload(every)
def _every(condition: bool) -> Callable[..., Any]:
    def in_lanes(condition: bool) -> bool:
        holds: bool = _all(condition)
        return holds

    return in_lanes if _is_of_lanes(condition) else rebound(every, compiled)


@overload(lanes)
def _lanes() -> Callable[..., int]:
    return rebound(lanes, compiled)


@overload(lanes, target="cpu")
def _lanes_on_cpu() -> Callable[..., int]:
    def in_lanes() -> int:
        return LANES

    return in_lanes


@overload(lanes_of)
def _lanes_of(array: Floats, start: int) -> Callable[..., Any]:
    return rebound(lanes_of, compiled)


@overload(lanes_of, target="cpu")
def _lanes_of_on_cpu(array: Floats, start: int) -> Callable[..., Any]:
    def in_lanes(array: Floats, start: int) -> float:
        numbers: float = _load(array, start)
        return numbers

    return in_lanes


@overload(put_lanes)
def _put_lanes(array: Floats, start: int, numbers: float) -> Callable[..., None]:
    return rebound(put_lanes, compiled)


@overload(put_lanes, target="cpu")
def _put_lanes_on_cpu(array: Floats, start: int, numbers: float) -> Callable[..., None]:
    def in_lanes(array: Floats, start: int, numbers: float) -> None:
        _store(array, start, numbers)

    return in_lanes
