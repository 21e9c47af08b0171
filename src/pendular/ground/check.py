"""Checks of public arguments: numbers with or without units become SI float64 arrays, or one line refuses them."""

import math
import operator
from os import PathLike
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = TypeVar("Floats", float, NDArray[np.float64])

_LARGEST_IN_RADIANS = 3.2  # what is larger was not meant in radians; pi itself was


def quantity(name: str, value: object, unit: str, *, allow_inf: bool = False) -> NDArray[np.float64]:
    """Argument as an array of SI numbers, 0-d for a single number.

    Parameters
    ----------
    name : str
        The argument's name, for the messages.
    value : object
        A number, an array, a (nested) sequence of them, or any of these with units (pint or alike).
    unit : str
        The SI unit in which it is wanted; empty for a pure number.
    allow_inf : bool
        Whether infinite values pass, as the radius of a plane does.

    Returns
    -------
    ndarray
        Of the argument's own shape, [unit].

    Raises
    ------
    ValueError
        If it is not made of real numbers, is empty, is masked somewhere, has another dimension, or holds NaN or an
        unwanted inf.

    Examples
    --------
    >>> quantity("radius", [50e-6, 20e-6], "m")
    array([5.e-05, 2.e-05])
    >>> quantity("suction", "20 kPa", "Pa")
    Traceback (most recent call last):
        ...
    ValueError: suction: '20 kPa' is not a real number
    """
    if type(value) is float and math.isfinite(value):  # what is asked most
        return np.array(value)
    array = numbers(name, value, unit)
    if array.size == 0:
        raise ValueError(f"{name}: an array of shape {array.shape} holds no number")
    if not -math.inf < array.min() <= array.max() < math.inf:  # a NaN is the least and the largest
        _refuse_where(np.isnan(array), name, array, unit, "is not a number")
        if not allow_inf:
            _refuse_where(np.isinf(array), name, array, unit, "is not finite")
    return array


def numbers(name: str, value: object, unit: str) -> NDArray[np.float64]:
    """Argument as an array of SI numbers that may be empty, infinite or NaN, where a look at each costs too much.

    Parameters are those of `quantity`.

    Examples
    --------
    >>> numbers("separation", [1e-6, float("nan")], "m")
    array([1.e-06,    nan])
    """
    return _real_array(name, _without_units(name, value, unit))


def result_array(out: NDArray[np.float64] | None, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Array for a result: a new one, or that which the caller gives, if it fits.

    Examples
    --------
    >>> result_array(np.empty(3), (4,))
    Traceback (most recent call last):
        ...
    ValueError: out: is not a contiguous float64 array of shape (4,)
    """
    result = np.empty(shape) if out is None else out
    if result.shape != shape or result.dtype != np.float64 or not result.flags.c_contiguous:
        raise ValueError(f"out: is not a contiguous float64 array of shape {shape}")
    return result


def scalar(name: str, value: object, unit: str) -> float:
    """Argument as one finite SI number.

    Parameters and errors are those of `quantity`; an array is refused as well.

    Examples
    --------
    >>> scalar("temperature", 293.15, "K")
    293.15
    """
    array = quantity(name, value, unit)
    if array.ndim > 0:
        raise ValueError(f"{name}: an array of shape {array.shape} is given where one number is needed")
    return float(array)


def whole_number(name: str, value: object, low: int) -> int:
    """Argument as one whole number, at least ``low``.

    Examples
    --------
    >>> whole_number("points", 5.5, 5)
    Traceback (most recent call last):
        ...
    ValueError: points: 5.5 is not a whole number
    """
    number = in_range(name, scalar(name, value, ""), float(low))
    if not number.is_integer():
        raise ValueError(f"{name}: {number} is not a whole number")
    return int(number)


def instance(name: str, value: object, kind: type) -> None:
    """Refuse an object of another class.

    Examples
    --------
    >>> instance("table", None, Path)
    Traceback (most recent call last):
        ...
    ValueError: table: None is not a Path
    """
    if not isinstance(value, kind):
        home = "pendular." if kind.__module__.startswith("pendular.") else ""
        raise ValueError(f"{name}: {value!r} is not a {home}{kind.__name__}")


def as_path(name: str, value: object) -> Path:
    """Argument as a path.

    Examples
    --------
    >>> as_path("out", 3)
    Traceback (most recent call last):
        ...
    ValueError: out: 3 is not a path
    """
    if not isinstance(value, (str, PathLike)) or not str(value):
        raise ValueError(f"{name}: {value!r} is not a path")
    return Path(value)


def unmasked(name: str, value: Any) -> Any:
    """Value unchanged; one that is masked somewhere is refused, for NumPy would take what stands behind the mask.

    Examples
    --------
    >>> unmasked("suction", np.ma.masked_less([1e3, 2e4], 5e3))
    Traceback (most recent call last):
        ...
    ValueError: suction: 1 of 2 values are masked; give those that are not
    """
    if np.ma.is_masked(value):
        hidden = np.count_nonzero(np.ma.getmaskarray(value))
        raise ValueError(f"{name}: {hidden} of {np.size(value)} values are masked; give those that are not")
    return value


def in_range(
    name: str,
    values: Floats,
    low: float = -math.inf,
    high: float = math.inf,
    *,
    brackets: str = "[]",
    unit: str = "",
    high_hint: str = "",
    low_hint: str = "",
) -> Floats:
    """Values unchanged, if all of them lie in an interval.

    Parameters
    ----------
    name : str
        The argument's name, for the message.
    values : float or ndarray
        SI numbers, as `quantity` and `scalar` return them.
    low, high : float
        Ends of the interval, [unit].
    brackets : str
        Which ends belong to it: ``[]``, ``[)``, ``(]`` or ``()``.
    unit : str
        SI unit, for the message.
    high_hint, low_hint : str
        Advice for a value that is too large or too small; ``{value}`` stands for the value.

    Returns
    -------
    float or ndarray
        ``values``.

    Raises
    ------
    ValueError
        With the first value outside, its index and the interval.

    Examples
    --------
    >>> in_range("humidity", 1.2, 0.0, 1.0, brackets="()")
    Traceback (most recent call last):
        ...
    ValueError: humidity: 1.2 is not in (0, 1)
    """
    array = np.asarray(values)
    if array.ndim == 0 and low < array.item() < high:
        return values
    is_above = operator.ge if brackets[0] == "[" else operator.gt
    is_below = operator.le if brackets[1] == "]" else operator.lt
    if array.size == 0 or (is_above(array.min(), low) and is_below(array.max(), high)):
        return values
    reason = f"is not {_interval(low, high, brackets)}"
    _refuse_where(~is_above(array, low), name, array, unit, f"{reason}; {low_hint}" if low_hint else reason)
    _refuse_where(~is_below(array, high), name, array, unit, f"{reason}; {high_hint}" if high_hint else reason)
    return values


def angle(name: str, value: object) -> NDArray[np.float64]:
    """Angle in [0, π), the range of a contact angle; one that looks like degrees is answered with the conversion.

    Parameters
    ----------
    name : str
        The argument's name, for the messages.
    value : object
        As for `quantity`.

    Returns
    -------
    ndarray
        [rad].

    Examples
    --------
    >>> angle("contact_angle", 20.0)
    Traceback (most recent call last):
        ...
    ValueError: contact_angle: 20.0 rad is not in [0, pi); for degrees use numpy.deg2rad(20.0)
    """
    radians = quantity(name, value, "rad")
    if radians.ndim == 0 and 0.0 <= radians.item() < math.pi:
        return radians
    too_large = radians[radians >= math.pi]
    is_in_degrees = too_large.size and _LARGEST_IN_RADIANS < too_large[0] < 180.0
    hint = "for degrees use numpy.deg2rad({value})" if is_in_degrees else ""
    return in_range(name, radians, 0.0, math.pi, brackets="[)", unit="rad", high_hint=hint)


def broadcast(**arrays: NDArray[Any]) -> tuple[NDArray[Any], ...]:
    """Named arguments as arrays of one common shape, in the order given.

    Parameters
    ----------
    **arrays : ndarray
        The arguments under their public names.

    Returns
    -------
    tuple of ndarray
        Views, not to be written to.

    Raises
    ------
    ValueError
        With the shape of every argument, if they have no common one.

    Examples
    --------
    >>> gap, suction = broadcast(separation=np.zeros(3), suction=np.float64(2e4))
    >>> suction
    array([20000., 20000., 20000.])
    """
    if not any(np.ndim(array) for array in arrays.values()):
        return tuple(arrays.values())
    try:
        return np.broadcast_arrays(*arrays.values())
    except ValueError:
        shapes = ", ".join(f"{name} {np.shape(array)}" for name, array in arrays.items())
        raise ValueError(f"shapes do not broadcast: {shapes}") from None


def one_of(name: str, value: object, allowed: tuple[str, ...]) -> None:
    """Refuse a word that is not among the allowed ones.

    Examples
    --------
    >>> one_of("branch", "thin", ("stable", "unstable"))
    Traceback (most recent call last):
        ...
    ValueError: branch: 'thin' is not one of 'stable', 'unstable'
    """
    if not isinstance(value, str) or value not in allowed:
        raise ValueError(f"{name}: {value!r} is not one of {', '.join(map(repr, allowed))}")


def plain(array: Any) -> Any:
    """Python scalar of a 0-d array, the array itself otherwise.

    Examples
    --------
    >>> plain(np.array(2.5)), plain(np.array([True]))
    (2.5, array([ True]))
    """
    if isinstance(array, np.ndarray | np.generic):
        return array.item() if array.ndim == 0 else array
    return array


def _without_units(name: str, value: object, unit: str) -> object:
    """Value as bare SI numbers; what carries units is known by its behaviour, so that no unit package is imported."""
    if isinstance(value, (list, tuple)):
        return [_without_units(name, item, unit) for item in value]
    if isinstance(value, (bool, np.bool_)):  # NumPy would make True a 1.0 in a list of floats
        raise ValueError(f"{name}: {value} is not a real number")
    own_unit = getattr(value, "units", getattr(value, "unit", None))
    if own_unit is None or not hasattr(value, "to"):
        return unmasked(name, value)
    try:
        converted = value.to(unit)
    except Exception as error:  # every unit package raises an error of its own
        wanted = f"one in {unit}" if unit else "a pure number"
        raise ValueError(f"{name}: a quantity in {own_unit} is not {wanted}") from error
    return unmasked(name, getattr(converted, "magnitude", converted))


def _real_array(name: str, value: object) -> NDArray[np.float64]:
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise ValueError(f"{name}: a nested sequence of unequal lengths is not an array") from error
    if array.dtype.kind not in "iuf":
        if array.ndim > 0:
            raise ValueError(f"{name}: an array of type {array.dtype} does not hold real numbers")
        raise ValueError(f"{name}: {array.item()!r} is not a real number")
    return array.astype(np.float64, copy=False)


def _refuse_where(bad: NDArray[np.bool_], name: str, array: NDArray[np.float64], unit: str, reason: str) -> None:
    """Raise for the first bad element; ``{value}`` in the reason stands for it."""
    if not np.any(bad):
        return
    index = tuple(int(i) for i in np.argwhere(bad)[0])
    value = float(array[index])
    place = str(list(index)) if index else ""
    shown = f"{value} {unit}".rstrip()
    raise ValueError(f"{name}{place}: {shown} " + reason.replace("{value}", str(value)))


def _interval(low: float, high: float, brackets: str) -> str:
    if math.isinf(high):
        return f"{'>=' if brackets[0] == '[' else '>'} {_short(low)}"
    if math.isinf(low):
        return f"{'<=' if brackets[1] == ']' else '<'} {_short(high)}"
    return f"in {brackets[0]}{_short(low)}, {_short(high)}{brackets[1]}"


def _short(bound: float) -> str:
    return "pi" if bound == math.pi else f"{bound:.10g}"
