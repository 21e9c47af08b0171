"""The list of laws, and the two switches by which compiled code reaches them.

To add a law: write its file, append its record to `LAWS`, and give its position a branch in the switches. The position
is the code of the law in compiled code and in tables made from it, so the tuple only grows at its end. Numba can cache
a switch on an integer; it cannot cache a loop over a function that is handed in.
"""

import math

from .._jit import kernel
from . import asymptotic, asymptotic_rupture, pendular2026, toroidal2020, zhao2020
from ._record import Law

__all__ = ["LAWS", "force_star_of", "rupture_star_of"]

LAWS: tuple[Law, ...] = (
    zhao2020.LAW,
    toroidal2020.LAW,
    asymptotic.LAW,
    asymptotic_rupture.LAW,
    pendular2026.LAW,
)


@kernel
def force_star_of(
    code: int,
    separation_star: float,
    control_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> float:
    """Force by the law at position `code`; arguments as in `Law`, NaN if the law gives no force."""
    if code == 0:
        return zhao2020.force_star(separation_star, control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 1:
        return toroidal2020.force_star(separation_star, control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 2:
        return asymptotic.force_star(separation_star, control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 4:
        return pendular2026.force_star(separation_star, control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    return math.nan


@kernel
def rupture_star_of(
    code: int, control_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    """Rupture distance by the law at position `code`; arguments as in `Law`, NaN if the law gives none."""
    if code == 0:
        return zhao2020.rupture_star(control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 1:
        return toroidal2020.rupture_star(control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 2:
        return asymptotic.rupture_star(control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 3:
        return asymptotic_rupture.rupture_star(control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 4:
        return pendular2026.rupture_star(control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    return math.nan
