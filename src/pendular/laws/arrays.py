"""A law evaluated on arrays, by loops that are compiled once for all laws."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import broadcast, numbers
from ..ground.compile import element, in_chunks, kernel
from ._registry import LAWS, force_star_of, rupture_star_of, rupture_work_star_of

__all__ = ["force_star", "rupture_star", "rupture_work_star"]

Array = NDArray[np.float64]
Operands = tuple[Array, ...]

_CODES = {law.name: code for code, law in enumerate(LAWS)}
_CHUNK = 65536  # elements that one thread takes at a time


@kernel
def _force_range(code: int, x: Operands, out: Array, start: int, stop: int) -> None:
    for i in range(start, stop):
        out[i] = force_star_of(
            code,
            element(x[0], i),
            element(x[1], i),
            element(x[2], i),
            element(x[3], i),
            element(x[4], i),
            element(x[5], i),
        )


@kernel
def _rupture_range(code: int, x: Operands, out: Array, start: int, stop: int) -> None:
    for i in range(start, stop):
        out[i] = rupture_star_of(
            code, element(x[0], i), element(x[1], i), element(x[2], i), element(x[3], i), element(x[4], i)
        )


@kernel
def _rupture_work_range(code: int, x: Operands, out: Array, start: int, stop: int) -> None:
    for i in range(start, stop):
        out[i] = rupture_work_star_of(
            code, element(x[0], i), element(x[1], i), element(x[2], i), element(x[3], i), element(x[4], i)
        )


def force_star(
    law: str,
    separation_star: ArrayLike,
    control_star: ArrayLike,
    contact_angle1: ArrayLike,
    contact_angle2: ArrayLike,
    kappa1: ArrayLike,
    kappa2: ArrayLike,
) -> Array:
    r"""Force by a published law, on arrays.

    .. math:: \lambda^* = F/(2\pi\gamma\bar R)

    Parameters
    ----------
    law : str
        Name in the registry.
    separation_star : array_like
        Whole gap over the Derjaguin radius, [-].
    control_star : array_like
        Suction times the Derjaguin radius over the surface tension, or liquid volume over its cube, [-].
    contact_angle1, contact_angle2 : array_like
        Contact angles, [rad].
    kappa1, kappa2 : array_like
        Derjaguin radius over the radius of each solid, [-], 0 for a plane.

    Returns
    -------
    ndarray or float
        The force, [-], of the common shape: exactly 0.0 beyond rupture, NaN outside the domain of the law.

    Notes
    -----
    **Validity.** That of the law; nothing is clamped.

    References
    ----------
    .. [1] ``laws[law].reference``.

    Examples
    --------
    >>> force_star("zhao2020", [0.0, 0.01, 0.02], 100.0, 0.0, 0.0, 1.0, 1.0).round(4)
    array([0.9462, 0.4157, 0.    ])
    """
    return _evaluate(
        _force_range,
        _code(law, "force"),
        separation_star=separation_star,
        control_star=control_star,
        contact_angle1=contact_angle1,
        contact_angle2=contact_angle2,
        kappa1=kappa1,
        kappa2=kappa2,
    )


def rupture_star(
    law: str,
    control_star: ArrayLike,
    contact_angle1: ArrayLike,
    contact_angle2: ArrayLike,
    kappa1: ArrayLike,
    kappa2: ArrayLike,
) -> Array:
    r"""Rupture distance by a published law, on arrays.

    .. math:: D_c^* = D_c/\bar R

    Parameters
    ----------
    law : str
        Name in the registry.
    control_star : array_like
        Suction times the Derjaguin radius over the surface tension, or liquid volume over its cube, [-].
    contact_angle1, contact_angle2 : array_like
        Contact angles, [rad].
    kappa1, kappa2 : array_like
        Derjaguin radius over the radius of each solid, [-], 0 for a plane.

    Returns
    -------
    ndarray or float
        Whole gap at rupture, [-], of the common shape; NaN outside the domain of the law.

    Notes
    -----
    **Validity.** That of the law; nothing is clamped.

    References
    ----------
    .. [1] ``laws[law].reference``.

    Examples
    --------
    >>> rupture_star("asymptotic", [100.0, 1e4], 0.0, 0.0, 1.0, 1.0).round(6)
    array([0.014592, 0.000188])
    """
    return _evaluate(
        _rupture_range,
        _code(law, "rupture"),
        control_star=control_star,
        contact_angle1=contact_angle1,
        contact_angle2=contact_angle2,
        kappa1=kappa1,
        kappa2=kappa2,
    )


def rupture_work_star(
    law: str,
    control_star: ArrayLike,
    contact_angle1: ArrayLike,
    contact_angle2: ArrayLike,
    kappa1: ArrayLike,
    kappa2: ArrayLike,
) -> Array:
    r"""Rupture work by a published law, on arrays.

    .. math:: W^* = W/(2\pi\gamma\bar R^2)

    Parameters
    ----------
    law : str
        Name in the registry.
    control_star : array_like
        Suction times the Derjaguin radius over the surface tension, or liquid volume over its cube, [-].
    contact_angle1, contact_angle2 : array_like
        Contact angles, [rad].
    kappa1, kappa2 : array_like
        Derjaguin radius over the radius of each solid, [-], 0 for a plane.

    Returns
    -------
    ndarray or float
        Work of the capillary force from contact to rupture, [-], of the common shape; NaN outside the domain of the
        law.

    Notes
    -----
    **Validity.** That of the law; nothing is clamped.

    References
    ----------
    .. [1] ``laws[law].reference``.

    Examples
    --------
    >>> rupture_work_star("deboer2008", [100.0, 1e4], 0.0, 0.0, 1.0, 1.0)
    array([0.01  , 0.0001])
    """
    return _evaluate(
        _rupture_work_range,
        _code(law, "rupture_work"),
        control_star=control_star,
        contact_angle1=contact_angle1,
        contact_angle2=contact_angle2,
        kappa1=kappa1,
        kappa2=kappa2,
    )


def _code(law: str, quantity: str) -> int:
    able = [record.name for record in LAWS if quantity in record.gives]
    if law not in able:
        raise ValueError(f"law is {law!r}, the laws that give the {quantity.replace('_', ' ')} are {', '.join(able)}")
    return _CODES[law]


def _evaluate(loop: Callable[..., None], code: int, **operands: ArrayLike) -> Array:
    arrays = {name: numbers(name, operand, "") for name, operand in operands.items()}
    shape = broadcast(**arrays)[0].shape
    out = np.empty(shape)
    # One array type for every call, hence one compilation; an operand of one element is not repeated.
    flat = tuple((array if array.size == 1 else np.broadcast_to(array, shape)).flatten() for array in arrays.values())
    in_chunks(loop, out.size, _CHUNK, code, flat, out.reshape(-1))
    return out[()]
