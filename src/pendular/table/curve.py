"""A table at one pair and one control: a force curve as a single Chebyshev series in q, for a monodisperse packing."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .._check import numbers, result_array
from .._jit import in_chunks, kernel
from . import kernels
from .kernels import Grid

__all__ = ["ForceCurve", "curve_of"]

Floats = NDArray[np.float64]

_BLOCK, _CHUNK = 256, 65536
_MOST_TERMS = 128


@kernel
def _curve_range(rupture: float, series: Floats, separation: Floats, out: Floats, start: int, stop: int) -> None:
    """Clenshaw's sum, term by term for a block of contacts at once: the compiler makes vector instructions of it."""
    z, last, before = np.empty((3, _BLOCK))
    for begin in range(start, stop, _BLOCK):
        count = min(_BLOCK, stop - begin)
        for i in range(count):
            gap = separation[begin + i]
            z[i] = 2.0 * np.sqrt(1.0 - (0.0 if gap < 0.0 else gap) / rupture) - 1.0
            last[i], before[i] = 0.0, 0.0
        for k in range(series.size - 1, 0, -1):
            for i in range(count):
                following = 2.0 * z[i] * last[i] - before[i] + series[k]
                before[i] = last[i]
                last[i] = following
        for i in range(count):
            value = z[i] * last[i] - before[i] + series[0]
            out[begin + i] = 0.0 if separation[begin + i] >= rupture else value


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
        in_chunks(_curve_range, flat.size, _CHUNK, self.rupture_distance, self.series, flat, result.reshape(-1))
        return result[()]


def curve_of(
    grid: Grid, tolerance: float, control: float, radius1: float, radius2: float, surface_tension: float
) -> ForceCurve:
    """Collapse a table to one force curve, to a tenth of its tolerance."""
    rupture = kernels.rupture_distance(grid, control, radius1, radius2, surface_tension)
    terms = 8
    while True:
        q = 0.5 + 0.5 * np.cos(np.pi * (np.arange(terms) + 0.5) / terms)
        force = [
            kernels.force(grid, rupture * (1.0 - x * x), control, radius1, radius2, surface_tension) for x in q.tolist()
        ]
        series = np.polynomial.chebyshev.chebfit(2.0 * q - 1.0, force, terms - 1)
        if terms == _MOST_TERMS or np.abs(series[-2:]).max() < 0.05 * tolerance * force[0]:
            return ForceCurve(rupture, series)
        terms += 4
