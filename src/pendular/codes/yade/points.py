"""Points of YADE's `CapillarityEngine`, which is linear in the tetrahedra between them."""

import numpy as np
from numpy.typing import NDArray

from .exact import exact_rupture, reduced_bridge
from .tables import REDUCED_SUCTION, acute_angle, last_suction

__all__ = ["make_points"]

Floats = NDArray[np.float64]

# Ratios, suctions a decade, gaps; finest towards rupture.
_RATIO_COUNT, _DECADE_COUNT, _GAP_COUNT = 24, 38, 18
_LEAST_SUCTION = 0.05
_LEAST_RATIO = 0.0999  # R1/R2; a pair of 0.1 is inside, however that is rounded
_OVERLAP = 0.1  # over the smaller radius, to which the force at contact is kept


def make_points(contact_angle: float, *, reduced_suction: float = REDUCED_SUCTION) -> Floats:
    """Points of `CapillarityEngine`, from a ratio R1/R2 of 0.1 to 1.

    Parameters
    ----------
    contact_angle : float
        θ of both spheres, [rad], below π/2.
    reduced_suction : float
        u R2/γ up to which they reach.

    Returns
    -------
    ndarray, shape (n, 10)
        Rows of `POINT_COLUMNS`. The bridges at the fold are marked as the last ones. Those at contact are repeated at
        a gap of minus a tenth of the smaller radius, as the engine finds nothing below the smallest gap of its points.

    Raises
    ------
    ValueError
        For bad input.
    """
    theta, last = acute_angle(contact_angle), last_suction(reduced_suction)
    count = int(np.ceil(_DECADE_COUNT * np.log10(last / _LEAST_SUCTION)))
    smaller = np.geomspace(_LEAST_RATIO, 1.0, _RATIO_COUNT)[:, None, None]
    suctions = np.append(0.0, np.geomspace(_LEAST_SUCTION, last, count))[:, None]
    ruptures = exact_rupture(1.0 / smaller, theta, suctions)
    place = 1.0 - (1.0 - np.linspace(0.0, 1.0, _GAP_COUNT)) ** 1.5
    gaps = ruptures * np.append(place[:-1], 1.0 - 1e-12)
    found = reduced_bridge(1.0 / smaller, theta, gaps, suctions)
    uncovered = 1.0 + np.cos(found.half_filling_angle)  # of each sphere's 2πR²
    dry = 2.0 * np.pi * (uncovered[..., 0] * smaller**2 + uncovered[..., 1])
    filling = np.rad2deg(found.half_filling_angle)
    is_last = np.arange(_GAP_COUNT) == _GAP_COUNT - 1
    area = np.asarray(found.liquid_gas_area) + dry
    columns = [suctions, found.force, gaps, found.volume, area, 0.0, filling[..., 0], filling[..., 1], smaller, is_last]
    points = np.stack(np.broadcast_arrays(*map(np.asarray, columns)), axis=-1)
    overlap = points[:, :, :1].copy()
    overlap[..., 2] = -_OVERLAP * smaller
    return np.concatenate([overlap, points], axis=2).reshape(-1, len(columns))
