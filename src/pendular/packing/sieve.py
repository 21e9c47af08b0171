"""Radii of grains from a sieve curve: mass that passes each size."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import in_range, quantity, whole_number

__all__ = ["passing", "sieved_radii"]

Floats = NDArray[np.float64]


def sieved_radii(count: int, sizes: ArrayLike, passing: ArrayLike) -> Floats:
    """Radii of grains whose mass passes the sieves as given.

    Between two sieves the mass that passes grows with the logarithm of the size, as the curve is drawn. So the number
    of grains grows as size^-3 towards small ones: most grains of a wide curve are as small as its smallest.

    Parameters
    ----------
    count : int
        Grains.
    sizes : array_like
        Openings of the sieves, which are diameters, ascending, [m].
    passing : array_like
        Mass passing each, in per cent: from 0 at the first to 100 at the last, ascending.

    Returns
    -------
    ndarray, (count,)
        [m], ascending. They lie evenly in the distribution of numbers, so that the curve is met as well as the count
        allows, without chance.

    Raises
    ------
    ValueError
        For a curve that is no curve, or too few grains for one in the coarsest part of it.

    Examples
    --------
    >>> radii = sieved_radii(2000, [0.2e-3, 0.4e-3, 0.8e-3], [0, 30, 100])
    >>> passing(radii, [0.2e-3, 0.4e-3, 0.8e-3]).round(1)
    array([  0.,  30., 100.])
    """
    number = whole_number("count", count, 1)
    openings = in_range("sizes", quantity("sizes", sizes, "m"), 0.0, brackets="(]", unit="m")
    mass = in_range("passing", quantity("passing", passing, ""), 0.0, 100.0)
    if openings.ndim != 1 or openings.shape != mass.shape or len(openings) < 2:
        raise ValueError(
            f"passing: {mass.size} values for {openings.size} sizes; give one for each of two sieves or more"
        )
    if np.any(np.diff(openings) <= 0.0) or np.any(np.diff(mass) < 0.0):
        raise ValueError("sizes: they do not ascend with the mass that passes")
    if mass[0] != 0.0 or mass[-1] != 100.0:
        raise ValueError(
            f"passing: it goes from {mass[0]:g} to {mass[-1]:g} %, not from 0 to 100; add the missing sieves"
        )
    numbers = _numbers(openings, mass)
    ends = np.concatenate([[0.0], np.cumsum(numbers)]) / numbers.sum()
    expected = number * numbers[mass[1:] > mass[:-1]][-1] / numbers.sum()
    if expected < 0.5:
        raise ValueError(
            f"count: {number} grains hold none of the coarsest part; take {int(np.ceil(number / expected))}"
        )
    place = (np.arange(number) + 0.5) / number
    row = np.clip(np.searchsorted(ends, place, side="right") - 1, 0, len(numbers) - 1)
    share = (place - ends[row]) / (ends[row + 1] - ends[row])
    return 0.5 * _cut(openings[row], openings[row + 1], share)


def passing(radii: ArrayLike, sizes: ArrayLike) -> Floats:
    """Mass of grains that passes sieves, in per cent.

    Parameters
    ----------
    radii : array_like
        Of the grains, [m].
    sizes : array_like
        Openings of the sieves, [m].

    Returns
    -------
    ndarray
        In the shape of the sizes.

    Raises
    ------
    ValueError
        For values that are not positive.

    Examples
    --------
    >>> passing([1.0, 2.0], [1.0, 2.0, 4.0]).round(1)
    array([  0. ,  11.1, 100. ])
    """
    diameters = np.sort(2.0 * in_range("radii", quantity("radii", radii, "m"), 0.0, brackets="(]", unit="m").ravel())
    openings = in_range("sizes", quantity("sizes", sizes, "m"), 0.0, brackets="(]", unit="m")
    mass = np.concatenate([[0.0], np.cumsum(diameters**3)])
    found: Floats = 100.0 * mass[np.searchsorted(diameters, openings, side="right")] / mass[-1]
    return found


def _numbers(openings: Floats, mass: Floats) -> Floats:
    """Numbers of grains between sieves over those of the finest size that would have all the mass: ∫ d^-3 dm."""
    low, high = openings[:-1] / openings[0], openings[1:] / openings[0]
    found: Floats = np.diff(mass) * (low**-3 - high**-3) / (3.0 * np.log(high / low))
    return found


def _cut(low: Floats, high: Floats, share: Floats) -> Floats:
    """Size below which a share of the grains between two sieves lies, when numbers grow as size^-4."""
    return (low**-3 - share * (low**-3 - high**-3)) ** (-1.0 / 3.0)
