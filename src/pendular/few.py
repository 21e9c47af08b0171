"""Whether to ask the exact solver compiled, or for a few questions as plain Python.

Compiling the solver takes a minute of one core, and loading it from disk seconds; the plain one answers a question in
milliseconds. Both run the same source and agree to rounding.
"""

from collections.abc import Callable
from importlib import import_module
from typing import Any

__all__ = ["by_cost"]

_PLAIN_COST = {"answer": 5.0, "draw": 500.0, "lay_meridian": 5.0}  # of a row, [ms]
_WORTH_COMPILING = 1000.0  # [ms]


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
    if rows * _PLAIN_COST[name] > _WORTH_COMPILING:
        return _function_of(f"pendular.exact.{module}", name)
    plain = _function_of(f"pendular._plain.exact.{module}", name)

    def answer(*arguments: Any) -> Any:
        try:
            return plain(*arguments)
        except (
            ArithmeticError,
            ValueError,
        ):  # out of a domain: inf or NaN where compiled
            return _function_of(f"pendular.exact.{module}", name)(*arguments)

    return answer


def _function_of(module: str, name: str) -> Callable[..., Any]:
    function: Callable[..., Any] = getattr(import_module(module), name)
    return function
