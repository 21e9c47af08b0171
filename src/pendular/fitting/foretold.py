"""The curve of a fit at other separations than the measured ones."""

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..ask.by_law import RangeWarning
from ..ask.face import bridge
from ..ground.check import quantity

if TYPE_CHECKING:
    from .result import Fit

__all__ = ["foretold_force"]


def foretold_force(fit: "Fit", separation: Any) -> NDArray[np.float64]:
    """Force of a fit at measured separations."""
    place = quantity("separation", separation, "m")
    held: dict[str, Any] = dict(fit.held)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)
        found = bridge(fit.pair, place + fit.numbers["offset"], **held, liquid=fit.liquid, method=fit.method)
    numbers = fit.numbers
    return np.asarray(
        numbers["force_scale"] * np.asarray(found.force) + numbers["force_zero"] + numbers["base_slope"] * place
    )
