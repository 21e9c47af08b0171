"""The help of the functions of a law: all that repeats from one to the next is written from the law's record.

The docstring of a kernel has its formula, what is special about it, and an example. Parameters, returned quantity,
validity and source are added here, so that each symbol has its name, unit and meaning in one place.
"""

import inspect
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from textwrap import fill, indent
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._symbols import ANSWERS, SHARED, Variable, arguments

if TYPE_CHECKING:
    from ._record import Law

__all__ = ["add_help", "add_help_of"]

_WIDTH = 100
_KINDS: dict[Any, str] = {
    str: "str",
    tuple[float, float, float]: "tuple of float",
    ArrayLike: "array_like",
    NDArray[np.float64]: "ndarray or float",
}
_ANGLES = {0.5 * math.pi: "π/2"}
_TOGETHER = (("contact_angle1", "contact_angle2"), ("kappa1", "kappa2"))  # two arguments that have one line


def add_help_of(law: "Law") -> None:
    """Complete the docstrings of the functions of a law."""
    limits = {variable.name: variable for variable in law.variables}
    returned = {symbol.name: symbol for answers in law.steps.values() for symbol in answers}
    symbols: dict[str, Variable] = {**SHARED, **limits, **returned, **{symbol.name: symbol for symbol in law.symbols}}
    about = {
        "validity": f"{_as_sentence(law.valid_text)}.",
        "source": f"{_as_sentence(law.reference)}{f', doi:{law.doi}' if law.doi else ''}.",
    }
    for quantity, kernel in law.kernels.items():
        solids, ends = law.solids[quantity], quantity == "force" and "rupture" in law.gives
        add_help(
            kernel,
            symbols,
            names=arguments(quantity, law.control),
            rules={"contact_angle1": solids.angle_words, "kappa1": solids.size_words},
            returned=(ANSWERS[quantity],),
            beside=f"{'exactly 0.0 beyond rupture, ' if ends else ''}NaN outside the domain",
            **about,
        )
    for step, answers in law.steps.items():
        add_help(step, symbols, rules={}, returned=answers, **about)


def add_help(
    function: Callable[..., Any],
    symbols: Mapping[str, Variable],
    *,
    rules: Mapping[str, str],
    returned: Iterable[Variable],
    validity: str,
    source: str,
    names: Iterable[str] = (),
    beside: str = "",
) -> None:
    """Complete the docstring of a function, unless it lists its parameters already.

    Parameters
    ----------
    function : callable
        Plain or compiled, with a docstring of words, and examples after them.
    symbols : mapping of str to Variable
        What its arguments mean.
    rules : mapping of str to str
        What is added to the meaning of an argument.
    returned : iterable of Variable
        What it returns.
    validity, source : str
        Sentences for all functions of the law.
    names : iterable of str
        Its arguments, if it may call them otherwise.
    beside : str
        Values that it returns beside those that are meant.
    """
    told = inspect.cleandoc(function.__doc__ or "")
    if not told or "\nParameters\n---" in told:
        return
    words, prompt, examples = told.partition("\n\n>>> ")
    sections = {
        "Parameters": "\n".join(_parameters(function, list(names), symbols, rules)),
        "Returns": _returns(function, tuple(returned), beside),
        "Notes": fill(f"**Validity.** {validity}", _WIDTH),
        "References": indent(fill(f".. [1] {source}", _WIDTH), "   ").lstrip(),
        "Examples": f">>> {examples}" if prompt else "",
    }
    parts = [f"{name}\n{'-' * len(name)}\n{text}" for name, text in sections.items() if text]
    with suppress(AttributeError):  # of a callable that takes no docstring
        function.__doc__ = "\n\n".join([words, *parts]) + "\n"


def _parameters(
    function: Callable[..., Any], names: list[str], symbols: Mapping[str, Variable], rules: Mapping[str, str]
) -> Iterator[str]:
    kinds = {name: _KINDS.get(given.annotation) for name, given in inspect.signature(function).parameters.items()}
    names = names or list(kinds)
    while names:
        together = next((pair for pair in _TOGETHER if tuple(names[:2]) == pair), tuple(names[:1]))
        names = names[len(together) :]
        symbol = symbols.get(together[0])
        if symbol is None:
            raise ValueError(f"symbols: {together[0]!r}, an argument of {function.__name__}, is not among them")
        yield f"{', '.join(together)} : {kinds.get(together[0]) or 'float'}"
        yield _described(symbol, rules.get(together[0], ""))


def _described(symbol: Variable, rule: str) -> str:
    parts = [symbol.text, *([f"[{symbol.unit}]"] if symbol.unit else [])]
    if symbol.low > -math.inf:
        parts.append(f"from {symbol.low:g}" if math.isinf(symbol.high) else f"{symbol.low:g} to {_limit(symbol.high)}")
    return _block(", ".join(parts) + (f"; {rule}" if rule else "") + ".")


def _limit(value: float) -> str:
    return _ANGLES.get(value, f"{value:g}")


def _returns(function: Callable[..., Any], returned: tuple[Variable, ...], beside: str) -> str:
    kind = _KINDS.get(inspect.signature(function).return_annotation, "float")
    told = "; ".join([*(f"{symbol.text}, [{symbol.unit}]" for symbol in returned), *filter(None, [beside])])
    return f"{kind if len(returned) == 1 else 'tuple of float'}\n{_block(f'{told}.')}"


def _block(text: str) -> str:
    """Sentence under the name of a parameter."""
    return indent(fill(_as_sentence(text), _WIDTH - 4), "    ")


def _as_sentence(text: str) -> str:
    """Text with a capital in front, unless it begins with the name of a variable."""
    return text if "_" in text.partition(" ")[0] else text[0].upper() + text[1:]
