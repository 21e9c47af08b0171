"""What a fit found, with what the data say of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..ask.liquid import Liquid
from ..ask.pair import Pair

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["Fit"]

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Fit:
    """A curve of the force as measured, and the bridge that fits it best.

    Attributes
    ----------
    values, errors : dict
        Of each free number by its name, in SI units and radians: the value, and its standard error. The error of what
        the data do not fix is infinite; that of an angle that may be 0 reaches upwards from its value and holds with
        68 %.
    upper : dict
        Upper bounds with 95 % confidence, of the contact angles that may be 0.
    correlation, covariance : ndarray
        Of the free numbers in their order.
    notes : tuple of str
        What one has to know of these numbers, a line each: what the data do not tell apart, bounds that are met.
    separation, force : ndarray
        As measured, [m] and [N].
    fitted, residuals : ndarray
        Force of the fit at these separations, and measured minus fitted, [N].
    force_error : ndarray
        Standard errors of the measured forces, [N], given or told by the residuals.
    rupture_separation : float
        Rupture distance of the fit on the scale of the measured separation, [m].
    measured_rupture : tuple or None
        Rupture distance that was used as a datum, and its standard error, [m].
    pair, liquid, held
        The question with the values found: ``pl.bridge(fit.pair, separation, **fit.held, liquid=fit.liquid)``.
    numbers : dict
        All numbers of the question, free or not.
    method : str
        ``"exact"``, or the law that was fitted.
    chi_square, degrees_of_freedom : float, int
        Sum of the squares of the residuals over their errors, and points minus free numbers.
    criterion : float
        Akaike's, with its correction for few points: of two fits of one curve the smaller is the likelier, by
        exp(half the difference).
    converged : bool
        Whether the search ended at a minimum.
    evaluations : int
        How often the curve was computed.
    """

    values: dict[str, float]
    errors: dict[str, float]
    upper: dict[str, float]
    correlation: Floats
    covariance: Floats
    notes: tuple[str, ...]
    separation: Floats
    force: Floats
    fitted: Floats
    residuals: Floats
    force_error: Floats
    rupture_separation: float
    measured_rupture: tuple[float, float] | None
    pair: Pair
    liquid: Liquid
    held: dict[str, float]
    numbers: dict[str, float]
    method: str
    chi_square: float
    degrees_of_freedom: int
    criterion: float
    converged: bool
    evaluations: int

    @property
    def free(self) -> tuple[str, ...]:
        """Names of the free numbers, in the order of covariance and correlation."""
        return tuple(self.values)

    @property
    def rms(self) -> float:
        """Root of the mean square of the residuals, [N]."""
        return float(np.sqrt(np.mean(self.residuals**2)))

    def plot(self) -> Figure:
        """Picture of the curve, the fit and the residuals.

        Returns
        -------
        matplotlib.figure.Figure
            Tied to no window: ``fit.plot().savefig("fit.svg")``.
        """
        from .plots import fit_figure

        return fit_figure(self)

    def predicted(self, separation: Any) -> Floats:
        """Force that the fit foretells at measured separations, on the scale of the instrument, [N].

        Of a bridge that evaporates it is that of its first volume.
        """
        from .foretold import foretold_force

        return foretold_force(self, separation)
