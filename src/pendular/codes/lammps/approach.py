"""Which pairs without a bridge have come near enough for one, without a look at all of them in each step."""

import math

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import compiled, kernel
from ...packing.forces import distance_of
from .forces import Bridges
from .neighbours import MIRROR, Candidates

__all__ = ["Approach"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_ROUNDING = 1.0 + 1e-12


@kernel
def _gaps(pairs: Candidates, x: Floats, radius: Floats) -> Floats:
    """Separation of each candidate."""
    out = np.empty(pairs.first.size)
    for c in range(out.size):
        i, j = pairs.first[c], pairs.second[c]
        out[c] = distance_of(x, i, j) - (radius[i] + radius[j])
    return out


@kernel
def _drift(x: Floats, radius: Floats, former_x: Floats, former_radius: Floats) -> float:
    """How much a gap may have shrunk: twice the longest way of an atom and twice the largest growth of a radius."""
    square, growth = 0.0, 0.0
    for i in range(former_radius.size):
        dx, dy, dz = x[i, 0] - former_x[i, 0], x[i, 1] - former_x[i, 1], x[i, 2] - former_x[i, 2]
        square = max(square, dx * dx + dy * dy + dz * dz)
        growth = max(growth, radius[i] - former_radius[i])
    return 2.0 * (math.sqrt(square) + growth)


@kernel
def _within(pairs: Candidates, bridges: Bridges, gap: Floats, horizon: float) -> Integers:
    """Candidates without a bridge, of those about which this rank decides, whose gap was within a horizon."""
    out = np.empty(gap.size, np.int64)
    count = 0
    for c in range(gap.size):
        if gap[c] <= horizon and bridges.slot[c] < 0 and pairs.target[c] != MIRROR:
            out[count] = c
            count += 1
    return out[:count].copy()


@kernel
def _near(
    chosen: Integers, pairs: Candidates, bridges: Bridges, formation_distance: float, x: Floats, radius: Floats
) -> Integers:
    """Those of the chosen candidates that are near enough for a bridge and have none."""
    out = np.empty(chosen.size, np.int64)
    count = 0
    for k in range(chosen.size):
        c = np.uintp(chosen[k])
        i, j = np.uintp(pairs.first[c]), np.uintp(pairs.second[c])
        reach = (radius[i] + radius[j] + formation_distance) * _ROUNDING
        dx, dy, dz = x[j, 0] - x[i, 0], x[j, 1] - x[i, 1], x[j, 2] - x[i, 2]
        if dx * dx + dy * dy + dz * dz <= reach * reach and bridges.slot[c] < 0:
            out[count] = chosen[k]
            count += 1
    return out[:count]


class Approach:
    """Candidates of one neighbour list that are watched.

    Only pairs are looked at whose gap was within a horizon when the list was new. The horizon is drawn anew, half as
    far again, when the atoms have moved so far that a pair from beyond it could have come near enough.
    """

    def __init__(self, pairs: Candidates, x: Floats, radius: Floats) -> None:
        self._pairs, self._former_x, self._former_radius = pairs, x.copy(), radius.copy()
        self._gaps, self._horizon = compiled(_gaps)(pairs, x, radius), -1.0
        self._watched = np.empty(0, np.int64)

    def near(self, bridges: Bridges, formation_distance: float, x: Floats, radius: Floats) -> Integers:
        """Candidates near enough for a bridge, but for rounding, that have none; mirrors are left out."""
        shrunk = compiled(_drift)(x, radius, self._former_x, self._former_radius)
        if not shrunk <= self._horizon:
            self._horizon = 1.5 * shrunk
            reach = (formation_distance + self._horizon) * _ROUNDING
            self._watched = compiled(_within)(self._pairs, bridges, self._gaps, reach)
        found: Integers = compiled(_near)(self._watched, self._pairs, bridges, formation_distance, x, radius)
        return found

    def watch(self, candidates: Integers) -> None:
        """Look at candidates whose bridges broke as well."""
        self._watched = np.concatenate([self._watched, candidates])
