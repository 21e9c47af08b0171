"""Exact bridges of reduced pairs, and how far a law is from them.

Everything is reduced by the Derjaguin radius; errors are relative, (law - exact)/exact.
"""

from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.face import bridge, rupture
from ..ask.liquid import Liquid
from ..ask.pair import Pair
from ..ask.result import Bridge
from ..laws import Law, force_star, rupture_star, rupture_work_star

__all__ = ["NO_BRIDGE", "Errors", "Sample", "exact_sample", "law_errors", "rupture_work"]

Floats = NDArray[np.float64]
ControlName = Literal["suction", "volume"]

NO_BRIDGE = -1.0  # the error of a law that has no bridge where there is one

_UNIT = Liquid(surface_tension=1.0)


class Sample(NamedTuple):
    """Exact bridges of n pairs, each with equal contact angles, at m separations; NaN of pairs that hold none apart."""

    control: ControlName
    control_star: Floats  # (n,) H* or V*
    contact_angle: Floats  # (n,) [rad]
    size_ratio: Floats  # (n,) larger over smaller radius
    fraction: Floats  # (m,) separation over rupture distance
    rupture_star: Floats  # (n,) D_c/R̄
    rupture_work_star: Floats  # (n,) W/(2πγR̄²), from contact to rupture
    force_star: Floats  # (n, m) F/(2πγR̄)

    @property
    def kappa(self) -> tuple[Floats, Floats]:
        """R̄ over the radius of either solid."""
        smaller = 1.0 / self.size_ratio
        return 2.0 / (1.0 + smaller), 2.0 * smaller / (1.0 + smaller)


class Errors(NamedTuple):
    """Relative errors of a law over a sample, NaN where the law says nothing."""

    force: Floats  # (n, m)
    rupture: Floats  # (n,)
    rupture_work: Floats  # (n,)


def exact_sample(
    control: ControlName,
    control_star: ArrayLike,
    contact_angle: ArrayLike,
    size_ratio: ArrayLike,
    fraction: ArrayLike,
) -> Sample:
    """Exact bridges at fractions of their rupture distance.

    Parameters
    ----------
    control : {"suction", "volume"}
        What is held.
    control_star, contact_angle, size_ratio : array_like
        H* or V*, [-], θ on both solids, [rad], and R2/R1 >= 1, [-], infinite for a plane; broadcast and flattened.
    fraction : array_like
        D/D_c, [-], from 0 to below 1.

    Returns
    -------
    Sample

    Examples
    --------
    >>> sample = exact_sample("suction", [10.0, 100.0], 0.0, 1.0, [0.0, 0.5])
    >>> sample.force_star.round(4)
    array([[0.8604, 0.5869],
           [0.948 , 0.5657]])
    """
    control_star, contact_angle, size_ratio = (
        np.ravel(values).astype(np.float64) for values in np.broadcast_arrays(control_star, contact_angle, size_ratio)
    )
    fraction = np.atleast_1d(np.asarray(fraction, np.float64))
    empty = np.full(control_star.size, np.nan)
    sample = Sample(control, control_star, contact_angle, size_ratio, fraction, empty, empty, np.empty((0, 0)))
    with np.errstate(divide="ignore"):
        radii = tuple(1.0 / kappa for kappa in sample.kappa)
    pair = Pair(radii, contact_angle)
    held: dict[str, Any] = {control: control_star, "liquid": _UNIT}
    end, contact = rupture(pair, **held), bridge(pair, 0.0, **held)
    wide = Pair(tuple(radius[:, None] for radius in radii), contact_angle[:, None])
    holds = np.asarray(end.exists) & np.asarray(contact.exists)
    distance = np.where(holds, end.separation, np.nan)
    gaps = np.where(holds, distance, 0.0)[:, None] * fraction
    states = bridge(wide, gaps, **(held | {control: control_star[:, None]}))
    return sample._replace(
        rupture_star=distance,
        rupture_work_star=rupture_work(control, contact, end) / (2.0 * np.pi),
        force_star=np.where(holds[:, None], states.force, np.nan) / (2.0 * np.pi),
    )


def rupture_work(control: ControlName, contact: Bridge, end: Bridge) -> Floats:
    r"""Work of the capillary force from contact to rupture.

    .. math:: W = \int_0^{D_c} F\, dD = \Omega(D_c) - \Omega(0) \quad\text{or}\quad E(D_c) - E(0)

    Parameters
    ----------
    control : {"suction", "volume"}
        What is held: then it is the grand potential, or the surface energy, that the work changes.
    contact, end : Bridge
        Bridges at contact and at rupture.

    Returns
    -------
    ndarray
        [J].
    """
    energy = "grand_potential" if control == "suction" else "surface_energy"
    work: Floats = np.asarray(getattr(end, energy)) - np.asarray(getattr(contact, energy))
    return work


def law_errors(law: Law, sample: Sample) -> Errors:
    """Relative errors of a law over a sample of its own control.

    Examples
    --------
    >>> from pendular.laws import laws
    >>> sample = exact_sample("suction", 100.0, 0.0, 1.0, [0.0, 0.5, 0.9])
    >>> (100.0 * law_errors(laws["zhao2020"], sample).force).round(2)
    array([[-0.19, -0.54, -1.48]])
    """
    solids = (sample.contact_angle, sample.contact_angle, *sample.kappa)
    one = np.full(sample.control_star.size, np.nan)
    errors = Errors(np.full(sample.force_star.shape, np.nan), one, one)
    if "force" in law.gives:
        gaps = sample.rupture_star[:, None] * sample.fraction
        force = force_star(law.name, gaps, sample.control_star[:, None], *(value[:, None] for value in solids))
        errors = errors._replace(force=force / sample.force_star - 1.0)
    if "rupture" in law.gives:
        distance = rupture_star(law.name, sample.control_star, *solids)
        errors = errors._replace(rupture=distance / sample.rupture_star - 1.0)
    if "rupture_work" in law.gives:
        work = rupture_work_star(law.name, sample.control_star, *solids)
        errors = errors._replace(rupture_work=work / sample.rupture_work_star - 1.0)
    return errors
