"""A table at one pair and one control: a force curve as a single Chebyshev series in q, for a monodisperse packing."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import numbers, result_array
from ..ground.rows import Own, entry, over_rows
from . import kernels
from .kernels import Grid, if_bridged, q_of

__all__ = ["ForceCurve", "curve_of"]

Floats = NDArray[np.float64]

_BLOCK, _CHUNK = 256, 65536
_TERMS, _MOST_TERMS = 8, 128


def _room() -> Floats:
    """Room for a block: places in the series, and the last two sums."""
    return np.empty((3, _BLOCK))


@entry(plain_cost=2e-5)
def _curve_range(
    rupture: float, series: Floats, separation: Floats, out: Floats, room: Floats, start: int, stop: int
) -> None:
    """Clenshaw's sum, eight terms at a time for a block of contacts: the compiler makes vector instructions of it."""
    z, last, before = room[0], room[1], room[2]
    for begin in range(start, stop, _BLOCK):
        count = min(_BLOCK, stop - begin)
        for i in range(count):
            z[i] = 2.0 * q_of(separation[begin + i], rupture, 0.0) - 1.0
            last[i], before[i] = 0.0, 0.0
        for end in range(series.size, 0, -_TERMS):
            for i in range(count):
                b1, b2 = last[i], before[i]
                for k in range(1, _TERMS + 1):
                    b1, b2 = 2.0 * z[i] * b1 - b2 + series[end - k], b1
                last[i], before[i] = b1, b2
        for i in range(count):
            value = last[i] - z[i] * before[i]
            out[begin + i] = if_bridged(value, separation[begin + i], rupture, 0.0)


@dataclass(frozen=True, eq=False)
class ForceCurve:
    """Force against separation of one pair at one control, made by :meth:`Table.curve`.

    Parameters
    ----------
    rupture_distance : float
        [m].
    series : ndarray
        Coefficients of the Chebyshev polynomials of 2q - 1, [N].
    """

    rupture_distance: float
    series: Floats

    def force(self, separation: ArrayLike, *, out: Floats | None = None) -> Floats:
        """Attraction at separations, [N]: 0 from the rupture distance on; an overlap counts as contact.

        Parameters
        ----------
        separation : array_like
            [m].
        out : ndarray, optional
            Where to store the result, contiguous.

        Returns
        -------
        ndarray or float
            [N].
        """
        gap = numbers("separation", separation, "m")
        result = result_array(out, gap.shape)
        flat = np.require(gap, None, ["C", "W"]).reshape(-1)
        over_rows(
            _curve_range, flat.size, _CHUNK, self.rupture_distance, self.series, flat, result.reshape(-1), Own(_room)
        )
        return result[()]


def curve_of(
    grid: Grid, tolerance: float, control: float, radius1: float, radius2: float, surface_tension: float
) -> ForceCurve:
    """Collapse a table to one force curve, to a tenth of its tolerance."""
    rupture = kernels.rupture_distance(grid, control, radius1, radius2, surface_tension)
    terms = _TERMS
    while True:
        q = 0.5 + 0.5 * np.cos(np.pi * (np.arange(terms) + 0.5) / terms)
        force = [
            kernels.force(grid, rupture * (1.0 - x * x), control, radius1, radius2, surface_tension) for x in q.tolist()
        ]
        series = np.asarray(np.polynomial.chebyshev.chebfit(2.0 * q - 1.0, force, terms - 1), np.float64)
        if terms == _MOST_TERMS or np.abs(series[-2:]).max() <= 0.05 * tolerance * np.abs(force).max():
            return ForceCurve(rupture, series)
        terms += _TERMS
