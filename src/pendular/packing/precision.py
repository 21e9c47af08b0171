"""How exactly the centres of grains are known: files round them, and a bridge near contact feels it."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import quantity

__all__ = ["centre_noise"]

_SAMPLE = 1000
_DIGITS = 12  # a number of more digits is not taken for a rounded one
_UNITS = (1.0, 1e2, 1e3, 1e6, 1e9, 1e10)  # numbers in single precision were so in the file's unit


def centre_noise(positions: ArrayLike) -> float:
    """Largest error of a coordinate by the digits it was written with, [m]; 0 where none were cut.

    Parameters
    ----------
    positions : array_like, (grains, 3)
        Centres, [m].

    Returns
    -------
    float
        Half a unit of the last decimal of the largest coordinates, or of single precision. The noise of a measurement
        is not seen in the digits.

    Raises
    ------
    ValueError
        If they are not numbers.

    Notes
    -----
    Numbers of a lattice have few digits of their own. Where half of the coordinates looked at occur again, nothing is
    said to be cut.

    Examples
    --------
    >>> centres = np.random.default_rng(1).random((500, 3))
    >>> centre_noise(centres), f"{centre_noise(centres.round(6)):.0e}"
    (0.0, '5e-07')
    """
    values = np.abs(quantity("positions", positions, "m").ravel())
    values = values[values > 0.0]
    sample = values[:: max(1, values.size // _SAMPLE)]
    if sample.size == 0 or np.unique(sample).size < 0.5 * sample.size:
        return 0.0
    exponent = int(np.floor(np.log10(sample.max())))
    largest = sample[sample >= 10.0**exponent]
    digits = next((count for count in range(1, _DIGITS + 1) if _rounded(largest, count - 1 - exponent)), None)
    if digits is not None:
        return 0.5 * 10.0 ** (exponent - digits + 1)
    single = any(_single(sample * factor) for factor in _UNITS)  # whole numbers that are not long would pass as well
    return float(values.max()) * float(np.finfo(np.float32).eps) / 2.0 if single else 0.0


def _single(values: NDArray[np.float64]) -> bool:
    near = values.astype(np.float32).astype(float)
    return bool(np.all(np.abs(near - values) <= 1e-15 * values))


def _rounded(values: NDArray[np.float64], decimals: int) -> bool:
    scaled = values * 10.0**decimals
    return bool(np.all(np.abs(scaled - np.rint(scaled)) <= 1e-15 * scaled + 1e-9))
