"""Functions around kernels, in LLVM: arrays as compiled code of Numba has them, and its calls."""

from collections.abc import Sequence
from typing import Any

__all__ = ["array_of", "call_of"]


def array_of(context: Any, builder: Any, kind: Any, place: Any, shape: Sequence[Any], strides: Sequence[Any]) -> Any:
    """An array of a type in the memory at a place, which nobody owns: code that returns nothing keeps none."""
    from llvmlite import ir
    from numba.np.arrayobj import populate_array

    array = context.make_array(kind)(context, builder)
    size = ir.IntType(64)(context.get_abi_sizeof(context.get_data_type(kind.dtype)))
    populate_array(array, builder.bitcast(place, array.data.type), shape, strides, size, None)
    return array._getvalue()


def call_of(context: Any, builder: Any, kernel: Any, values: Sequence[Any]) -> tuple[Any, Any]:
    """Call a kernel, of which Numba tells name and types: its status and its answer."""
    from numba.core.cgutils import get_or_insert_function

    kernel_type = context.call_conv.get_function_type(kernel.restype, kernel.argtypes)
    function = get_or_insert_function(builder.module, kernel_type, kernel.llvm_func_name)
    status, answer = context.call_conv.call_function(builder, function, kernel.restype, kernel.argtypes, values)
    return status, answer
