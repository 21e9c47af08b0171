"""The error of a law over its control and the contact angle."""

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import angle, in_range, one_of, quantity, scalar
from ..laws import Law, laws
from .sample import exact_sample, law_errors

__all__ = ["ErrorMap", "error_map"]

Floats = NDArray[np.float64]

# Where a map is drawn if nothing else is asked: what people have, a little beyond what laws are made for.
_SUCTIONS = np.geomspace(0.1, 1e7, 193)
_VOLUMES = np.geomspace(1e-6, 1.0, 121)
_ANGLES = np.radians(np.linspace(0.0, 80.0, 81))


class ErrorMap(NamedTuple):
    """Relative error of a law for equal spheres: (law - exact)/exact."""

    law: str
    control: Literal["suction", "volume"]
    quantity: Literal["force", "rupture", "rupture_work"]
    fraction: float  # D/D_c at which the force is taken; NaN for the other two
    control_star: Floats  # (n,) H* or V*
    contact_angle: Floats  # (m,) [rad]
    error: Floats  # (n, m); -1 where the law has no bridge, NaN where it says nothing or the solids hold none apart

    @property
    def in_words(self) -> str:
        """Of which quantity the error is."""
        if self.quantity == "force":
            return f"force at {self.fraction:g} of the rupture distance"
        return "rupture distance" if self.quantity == "rupture" else "work from contact to rupture"


def error_map(
    law: str,
    *,
    fraction: float | None = None,
    control_star: ArrayLike | None = None,
    contact_angle: ArrayLike | None = None,
) -> ErrorMap:
    r"""Error of a law against the exact solution, over its control and the contact angle, for two equal spheres.

    .. math:: e(H^*\text{ or }V^*, \theta) = F_\text{law}/F_\text{exact} - 1 \quad\text{at}\quad D = f D_c

    Parameters
    ----------
    law : str
        Name in ``pendular.laws``. Of one that gives no force it is the error of the rupture distance or work.
    fraction : float, optional
        f, of the exact rupture distance, [-], from 0 to below 1; 0.5 if not given.
    control_star : array_like, optional
        H* or V*, [-], ascending; by default 0.1 to 1e7, or 1e-6 to 1.
    contact_angle : array_like, optional
        θ, [rad], ascending; by default 0° to 80°.

    Returns
    -------
    ErrorMap

    Raises
    ------
    ValueError
        For bad input.

    Examples
    --------
    >>> found = error_map("zhao2020", control_star=[10.0, 1e3], contact_angle=[0.0, 0.35])
    >>> (100.0 * found.error).round(2)
    array([[ 1.15,  1.34],
           [-1.36, -1.47]])
    """
    one_of("law", law, tuple(laws))
    record = laws[law]
    measured = _quantity(record)
    if measured != "force" and fraction is not None:
        raise ValueError(f"fraction: {law} gives no force, its error is that of the {measured.replace('_', ' ')}")
    part = in_range("fraction", scalar("fraction", 0.5 if fraction is None else fraction, ""), 0.0, 1.0, brackets="[)")
    by_default = _SUCTIONS if record.control == "suction" else _VOLUMES
    name = f"{record.control}_star"
    controls = np.atleast_1d(quantity(name, by_default if control_star is None else control_star, ""))
    angles = np.atleast_1d(angle("contact_angle", _ANGLES if contact_angle is None else contact_angle))
    in_range(name, controls, 0.0, brackets="()")
    sample = exact_sample(record.control, controls[:, None], angles, 1.0, [part])
    errors = getattr(law_errors(record, sample), measured).reshape(controls.size, angles.size)
    return ErrorMap(
        law=law,
        control=record.control,
        quantity=measured,
        fraction=part if measured == "force" else np.nan,
        control_star=controls,
        contact_angle=angles,
        error=errors,
    )


def _quantity(law: Law) -> Literal["force", "rupture", "rupture_work"]:
    """What a map is of: the force, or else what the law gives."""
    for compared in ("force", "rupture", "rupture_work"):
        if compared in law.gives:
            return compared
    raise ValueError(f"law: {law.name} gives only the {law.gives[0]}, which no bridge at rest has")
