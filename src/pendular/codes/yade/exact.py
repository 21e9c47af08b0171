"""The exact solution in the reduced numbers of YADE's tables."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...ask.face import bridge, rupture
from ...ask.liquid import Liquid
from ...ask.pair import Pair
from ...ask.result import Bridge

__all__ = ["exact_rows", "exact_rupture", "reduced_bridge"]

Floats = NDArray[np.float64]


def exact_rows(ratio: ArrayLike, contact_angle: float, gap_star: ArrayLike, suction_star: ArrayLike) -> Floats:
    """Exact bridges as rows of `COLUMNS`.

    Parameters
    ----------
    ratio : array_like
        R2/R1 >= 1, larger over smaller radius.
    contact_angle : float
        θ of both spheres, [rad].
    gap_star, suction_star : array_like
        D/R2 and u R2/γ.

    Returns
    -------
    ndarray, shape (..., 8)
        The force is 0 and the rest NaN where there is no bridge.

    Examples
    --------
    >>> exact_rows(1.0, 0.0, 0.1, 1.0).round(6)[2:4]
    array([0.223091, 0.633335])
    """
    found = reduced_bridge(ratio, contact_angle, gap_star, suction_star)
    columns = np.broadcast_arrays(
        *(np.asarray(value, float) for value in (gap_star, suction_star)),
        np.asarray(found.volume),
        np.asarray(found.force) / (2.0 * np.pi),
        *np.moveaxis(np.rad2deg(found.half_filling_angle), -1, 0),
        *np.moveaxis(found.capillary_tensor, -1, 0),
    )
    return np.stack(columns, axis=-1)


def reduced_bridge(ratio: ArrayLike, contact_angle: float, gap_star: ArrayLike, suction_star: ArrayLike) -> Bridge:
    """Bridge between a small and a large sphere of radius 1, with a surface tension of 1."""
    pair = Pair((1.0 / np.asarray(ratio, float), 1.0), contact_angle)
    return bridge(pair, gap_star, suction=suction_star, liquid=Liquid(surface_tension=1.0))


def exact_rupture(ratio: ArrayLike, contact_angle: float, suction_star: ArrayLike) -> Floats:
    """Exact rupture distance over the larger radius.

    Parameters
    ----------
    ratio, contact_angle, suction_star
        As for `exact_rows`.

    Returns
    -------
    ndarray

    Examples
    --------
    >>> exact_rupture(1.0, 0.0, 0.0).round(5).item()
    0.39936
    """
    pair = Pair((1.0 / np.asarray(ratio, float), 1.0), contact_angle)
    return np.asarray(rupture(pair, suction=suction_star, liquid=Liquid(surface_tension=1.0)).separation)
