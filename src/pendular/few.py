"""Whether to ask the exact solver compiled, or for a few questions as plain Python.

Compiling the solver takes a minute of one core, and loading it from disk seconds; the plain one answers a question in
milliseconds. Both run the same source and agree to rounding. A process that keeps asking has the compiled solver after
it has spent on plain answers what loading costs.
"""

import sys
from collections.abc import Callable
from importlib import import_module
from time import perf_counter
from typing import Any

__all__ = ["by_cost"]

_PLAIN_COST = {"answer": 0.005, "answer_filling": 0.5, "draw": 0.5, "lay_meridian": 0.005}  # of a row, [s]
_KERNELS = {
    "answer": "bridge_range",
    "answer_filling": "filling_range",
    "draw": "curve_range",
    "lay_meridian": "lay_meridian",
}
_PATIENCE = 3.0  # [s]

_spent = dict.fromkeys(_PLAIN_COST, 0.0)  # on plain answers so far, [s]


def by_cost(module: str, name: str, rows: int) -> Callable[..., Any]:
    """Return a function of a module of the exact solver, in the form that answers so many rows sooner.

    Examples
    --------
    >>> import numpy as np
    >>> answer = by_cost("batch", "answer", 1)
    >>> states, statuses = answer(0, 0, np.array([[0.01, 10.0, 1.0, 0.3, 1.0, 0.3]]))
    >>> statuses
    array([0], dtype=int8)
    """
    if _is_loaded(module, name) or _spent[name] + rows * _PLAIN_COST[name] > _PATIENCE:
        return _function_of(f"pendular.exact.{module}", name)
    plain = _function_of(f"pendular._plain.exact.{module}", name)

    def answer(*arguments: Any) -> Any:
        start = perf_counter()
        try:
            return plain(*arguments)
        except (ArithmeticError, ValueError):  # out of a domain: inf or NaN where compiled
            return _function_of(f"pendular.exact.{module}", name)(*arguments)
        finally:
            _spent[name] += perf_counter() - start

    return answer


def _is_loaded(module: str, name: str) -> bool:
    """Whether the compiled form has run in this process."""
    loaded = sys.modules.get(f"pendular.exact.{module}")
    return bool(loaded and getattr(getattr(loaded, _KERNELS[name]), "signatures", ()))


def _function_of(module: str, name: str) -> Callable[..., Any]:
    function: Callable[..., Any] = getattr(import_module(module), name)
    return function
