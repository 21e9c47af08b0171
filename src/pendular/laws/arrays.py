"""Laws on arrays, asked by their names."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import broadcast, numbers
from ._help import add_help
from ._record import Law, Quantity
from ._registry import LAWS
from ._rows import evaluate
from ._symbols import ANSWERS, CONTROL, LAW_NAME, SHARED

__all__ = ["damping_star", "force_star", "rupture_star", "rupture_work_star"]

Array = NDArray[np.float64]


def force_star(
    law: str | Law,
    separation_star: ArrayLike,
    control_star: ArrayLike,
    contact_angle1: ArrayLike,
    contact_angle2: ArrayLike,
    kappa1: ArrayLike,
    kappa2: ArrayLike,
) -> Array:
    r"""Force by a published law, on arrays.

    .. math:: \lambda^* = F/(2\pi\gamma\bar R)

    >>> force_star("zhao2020", [0.0, 0.01, 0.02], 100.0, 0.0, 0.0, 1.0, 1.0).round(4)
    array([0.9462, 0.4157, 0.    ])
    """
    return _evaluate(
        law,
        "force",
        separation_star=separation_star,
        control_star=control_star,
        contact_angle1=contact_angle1,
        contact_angle2=contact_angle2,
        kappa1=kappa1,
        kappa2=kappa2,
    )


def rupture_star(
    law: str | Law,
    control_star: ArrayLike,
    contact_angle1: ArrayLike,
    contact_angle2: ArrayLike,
    kappa1: ArrayLike,
    kappa2: ArrayLike,
) -> Array:
    r"""Rupture distance by a published law, on arrays.

    .. math:: D_c^* = D_c/\bar R

    >>> rupture_star("asymptotic", [100.0, 1e4], 0.0, 0.0, 1.0, 1.0).round(6)
    array([0.014592, 0.000188])
    """
    return _evaluate(
        law,
        "rupture",
        control_star=control_star,
        contact_angle1=contact_angle1,
        contact_angle2=contact_angle2,
        kappa1=kappa1,
        kappa2=kappa2,
    )


def rupture_work_star(
    law: str | Law,
    control_star: ArrayLike,
    contact_angle1: ArrayLike,
    contact_angle2: ArrayLike,
    kappa1: ArrayLike,
    kappa2: ArrayLike,
) -> Array:
    r"""Rupture work by a published law, on arrays.

    .. math:: W^* = W/(2\pi\gamma\bar R^2)

    >>> rupture_work_star("deboer2008", [100.0, 1e4], 0.0, 0.0, 1.0, 1.0)
    array([0.01  , 0.0001])
    """
    return _evaluate(
        law,
        "rupture_work",
        control_star=control_star,
        contact_angle1=contact_angle1,
        contact_angle2=contact_angle2,
        kappa1=kappa1,
        kappa2=kappa2,
    )


def damping_star(
    law: str | Law,
    separation_star: ArrayLike,
    control_star: ArrayLike,
    contact_angle1: ArrayLike,
    contact_angle2: ArrayLike,
    kappa1: ArrayLike,
    kappa2: ArrayLike,
) -> Array:
    r"""Viscous force over the speed at which the solids move apart, by a published law, on arrays.

    .. math:: c^* = F_v/(\mu\bar R\,\dot D)

    >>> damping_star("pitois2000", [0.001, 0.01, 0.1], 1e-3, 0.0, 0.0, 1.0, 1.0).round(3)
    array([4.346538e+03, 1.879560e+02, 4.400000e-02])
    """
    return _evaluate(
        law,
        "damping",
        separation_star=separation_star,
        control_star=control_star,
        contact_angle1=contact_angle1,
        contact_angle2=contact_angle2,
        kappa1=kappa1,
        kappa2=kappa2,
    )


def _evaluate(asked: str | Law, quantity: Quantity, **operands: ArrayLike) -> Array:
    law = asked if isinstance(asked, Law) else LAWS.get(asked) if isinstance(asked, str) else None
    if law is None or quantity not in law.gives:
        able = ", ".join(record.name for record in LAWS.values() if quantity in record.gives)
        told = asked.name if isinstance(asked, Law) else asked
        raise ValueError(f"law is {told!r}, the laws that give the {quantity.replace('_', ' ')} are {able}")
    arrays = {name: numbers(name, operand, "") for name, operand in operands.items()}
    shape = broadcast(**arrays)[0].shape
    out = np.full(shape, np.nan)
    # One array type for every call, hence one compilation; an operand of one element is not repeated.
    flat = {
        name: (array if array.size == 1 else np.broadcast_to(array, shape)).flatten() for name, array in arrays.items()
    }
    rows = np.flatnonzero(np.broadcast_to(_has_meaning(law, flat), out.size))
    if rows.size == out.size:
        evaluate(law.kernels[quantity], tuple(flat.values()), out.reshape(-1))
    elif rows.size:
        some = np.empty(rows.size)
        evaluate(law.kernels[quantity], tuple(x if x.size == 1 else x[rows] for x in flat.values()), some)
        out.reshape(-1)[rows] = some
    return out[()]


def _has_meaning(law: Law, operands: Mapping[str, Array]) -> NDArray[np.bool_]:
    """Which rows are within the hard limits of the law, so that a function from outside need not see to that."""
    limits = {variable.name: (variable.low, variable.high) for variable in law.variables}
    has = np.ones(1, bool)
    for name, values in operands.items():
        variable = name.rstrip("12").replace("control", law.control)
        low, high = limits.get(variable, (-np.inf, np.inf))
        has = has & (values >= low) & ((values < high) if variable == "contact_angle" else (values <= high))
    return has


for _quantity, _function in (
    ("force", force_star),
    ("rupture", rupture_star),
    ("rupture_work", rupture_work_star),
    ("damping", damping_star),
):
    add_help(
        _function,
        {**SHARED, "law": LAW_NAME, "control_star": CONTROL},
        rules={},
        returned=(ANSWERS[_quantity],),
        beside="of the common shape; NaN outside the domain of the law",
        validity="That of the law; nothing is clamped.",
        source="``laws[law].reference``.",
    )
