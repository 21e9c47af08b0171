"""The list of laws, and the switches by which compiled code reaches them, one for each quantity that laws predict.

To add a law: write its file, append its record to `LAWS`, and give its position a branch in the switches. The position
is the code of the law in compiled code and in tables made from it, so the tuple only grows at its end. Numba can cache
a switch on an integer; it cannot cache a loop over a function that is handed in.
"""

import math

from ..ground.compile import kernel
from . import (
    asymptotic,
    asymptotic_rupture,
    bagheri2024,
    contact_limit,
    deboer2008,
    deboer2008_volume,
    lambert2008,
    lian1993,
    lian_seville2016,
    mikami1998,
    pendular2026,
    rabinovich2005,
    soulie2006,
    toroidal2020,
    weigert1999,
    willett2000,
    willett2000_simple,
    zhao2020,
)
from ._record import Law

__all__ = ["LAWS", "force_star_of", "rupture_star_of", "rupture_work_star_of"]

LAWS: tuple[Law, ...] = (
    zhao2020.LAW,
    toroidal2020.LAW,
    asymptotic.LAW,
    asymptotic_rupture.LAW,
    pendular2026.LAW,
    willett2000.LAW,
    willett2000_simple.LAW,
    lian1993.LAW,
    mikami1998.LAW,
    soulie2006.LAW,
    rabinovich2005.LAW,
    lambert2008.LAW,
    weigert1999.LAW,
    lian_seville2016.LAW,
    bagheri2024.LAW,
    contact_limit.LAW,
    deboer2008.LAW,
    deboer2008_volume.LAW,
)


@kernel
def force_star_of(  # noqa: C901 - one branch a law
    code: int,
    separation_star: float,
    control_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> float:
    """Force by the law at position `code`; arguments as in `Law`, NaN if the law gives no force."""
    x = (separation_star, control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 0:
        return zhao2020.force_star(*x)
    if code == 1:
        return toroidal2020.force_star(*x)
    if code == 2:
        return asymptotic.force_star(*x)
    if code == 4:
        return pendular2026.force_star(*x)
    if code == 5:
        return willett2000.force_star(*x)
    if code == 6:
        return willett2000_simple.force_star(*x)
    if code == 8:
        return mikami1998.force_star(*x)
    if code == 9:
        return soulie2006.force_star(*x)
    if code == 10:
        return rabinovich2005.force_star(*x)
    if code == 11:
        return lambert2008.force_star(*x)
    if code == 12:
        return weigert1999.force_star(*x)
    if code == 13:
        return lian_seville2016.force_star(*x)
    if code == 14:
        return bagheri2024.force_star(*x)
    if code == 15:
        return contact_limit.force_star(*x)
    return math.nan


@kernel
def rupture_star_of(
    code: int, control_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    """Rupture distance by the law at position `code`; arguments as in `Law`, NaN if the law gives none."""
    x = (control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 0:
        return zhao2020.rupture_star(*x)
    if code == 1:
        return toroidal2020.rupture_star(*x)
    if code == 2:
        return asymptotic.rupture_star(*x)
    if code == 3:
        return asymptotic_rupture.rupture_star(*x)
    if code == 4:
        return pendular2026.rupture_star(*x)
    if code == 5:
        return willett2000.rupture_star(*x)
    if code == 6:
        return willett2000_simple.rupture_star(*x)
    if code == 7:
        return lian1993.rupture_star(*x)
    if code == 8:
        return mikami1998.rupture_star(*x)
    if code == 13:
        return lian_seville2016.rupture_star(*x)
    if code == 14:
        return bagheri2024.rupture_star(*x)
    return math.nan


@kernel
def rupture_work_star_of(
    code: int, control_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    """Rupture work by the law at position `code`; arguments as in `Law`, NaN if the law gives none."""
    x = (control_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if code == 16:
        return deboer2008.rupture_work_star(*x)
    if code == 17:
        return deboer2008_volume.rupture_work_star(*x)
    return math.nan
