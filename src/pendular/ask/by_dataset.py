"""A public question answered by interpolation of the data base, as the paper did, instead of the exact solver."""

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..dataset.base import make_dataset
from ..dataset.interpolation import interpolate, interpolate_rupture
from .problem import Problem, control_name, control_star, derjaguin_radius, partial_bridge
from .result import Bridge

if TYPE_CHECKING:
    import xarray as xr

Floats = NDArray[np.float64]


def bridge_by_dataset(problem: Problem) -> Bridge:
    """Force at a separation by interpolation; NaN, and no bridge, where the grid of the data base does not reach."""
    mean_radius, values, ratios, angles = _prepare(problem)
    separation = problem.rows[:, 0] * problem.length
    forces = np.empty(values.shape)
    for chosen, data in _pairs(ratios, angles):
        pair = ratios[chosen][0], angles[chosen][0]
        gaps = (separation / mean_radius)[chosen]
        forces[chosen] = interpolate(data, control_name(problem), values[chosen], gaps, *pair)
    return partial_bridge(problem, separation, forces, (forces != 0.0) & ~np.isnan(forces))


def rupture_by_dataset(problem: Problem) -> Bridge:
    """Rupture distance by interpolation; NaN where the data base shows no fold."""
    mean_radius, values, ratios, angles = _prepare(problem)
    distances = np.empty(values.shape)
    for chosen, data in _pairs(ratios, angles):
        pair = ratios[chosen][0], angles[chosen][0]
        distances[chosen] = interpolate_rupture(data, control_name(problem), values[chosen], *pair)
    unknown = np.full(values.shape, np.nan)
    return partial_bridge(problem, distances * mean_radius, unknown, ~np.isnan(distances))


def _prepare(problem: Problem) -> tuple[Floats, Floats, Floats, Floats]:
    """Derjaguin radius, reduced control, size ratio and contact angle, one a row."""
    k1, theta1, k2, theta2 = problem.rows[:, 2:].T
    if np.any(theta1 != theta2):
        raise ValueError("method: 'dataset' holds pairs of one contact angle; here the two angles differ")
    if np.any(np.minimum(k1, k2) == 0.0):
        raise ValueError("method: 'dataset' holds pairs of spheres; here one solid is a plane")
    return derjaguin_radius(problem), control_star(problem), np.maximum(k1, k2) / np.minimum(k1, k2), theta1


def _pairs(ratios: Floats, angles: Floats) -> "list[tuple[NDArray[np.bool_], xr.Dataset]]":
    """Rows of each pair of solids, and its data base."""
    pairs = np.unique(np.column_stack([ratios, angles]), axis=0)
    return [((ratios == ratio) & (angles == angle), _dataset_of(ratio, angle)) for ratio, angle in pairs]


@lru_cache(maxsize=64)
def _dataset_of(size_ratio: float, contact_angle: float) -> "xr.Dataset":
    """The data base of one pair at the default resolution: made in some 20 ms, and kept."""
    return make_dataset(size_ratio=size_ratio, contact_angle=contact_angle)
