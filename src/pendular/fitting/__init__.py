"""Measured curves of the force: the bridge that fits one best, and what the curve says of it."""

from .controls import Controls, fit_controls
from .fitting import FitWarning, fit
from .result import Fit

__all__ = ["Controls", "Fit", "FitWarning", "fit", "fit_controls"]
