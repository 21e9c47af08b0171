"""Which control a measured curve obeys: constant volume, as of a fast pull, or constant suction, as of a slow one."""

import math
import warnings
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..ask.face import bridge
from ..ask.liquid import Liquid
from ..ask.pair import Pair
from ..ask.problem import Control, control_of
from .fitting import FitWarning, fit
from .result import Fit

__all__ = ["Controls", "fit_controls"]

_NOTHING = 2.0  # difference of the criterion that says nothing
_MOST = 700.0  # of an exponent


class Controls(NamedTuple):
    """One curve fitted at constant volume and at constant suction."""

    volume: Fit
    suction: Fit
    better: str  # "volume", "suction", or "neither"
    odds: float  # of the better one, to 1

    @property
    def told(self) -> str:
        """The evidence in one line."""
        if self.better == "neither":
            return f"volume or suction: the curve does not tell, odds {self.odds:.2g} to 1"
        worse = self.suction if self.better == "volume" else self.volume
        fit = self.volume if self.better == "volume" else self.suction
        odds = f"{self.odds:.2g}" if self.odds < 1e6 else "more than a million"
        return (
            f"constant {self.better} fits better, odds {odds} to 1; residuals {fit.rms:.3g} N against {worse.rms:.3g} N"
        )


def fit_controls(
    separation: ArrayLike,
    force: ArrayLike,
    pair: Pair,
    *,
    volume: ArrayLike | None = None,
    suction: ArrayLike | None = None,
    liquid: Liquid,
    free: Any = None,
    **options: Any,
) -> Controls:
    r"""Fit a curve at constant volume and at constant suction, and weigh the evidence.

    .. math:: \text{odds} = e^{\,|\text{AIC}_V - \text{AIC}_s|/2}

    Parameters
    ----------
    separation, force, pair, liquid
        As for :func:`fit`.
    volume, suction : float
        Guess of one of the two, [m³] or [Pa]; that of the other is of the same bridge, halfway along the curve.
    free : sequence of str, optional
        As for :func:`fit`; ``volume`` or ``suction`` in it stands for what is held.
    **options
        Further arguments of :func:`fit`.

    Returns
    -------
    Controls
        Both fits, which is better, and its odds by Akaike's criterion.

    Raises
    ------
    ValueError
        For bad input.

    Notes
    -----
    **Validity.** The odds are those of independent normal errors; a fit whose residuals have a trend is too sure.

    Examples
    --------
    >>> beads, water = Pair(1e-3, 0.4), Liquid.water()
    >>> gap = np.linspace(0.0, 0.2e-3, 40)
    >>> noise = 2e-6 * np.random.default_rng(1).normal(size=40)
    >>> curve = bridge(beads, gap, volume=1e-11, liquid=water).force + noise
    >>> fit_controls(gap, curve, beads, volume=1e-11, liquid=water).better
    'volume'
    """
    control = control_of(suction, volume, None, liquid)
    first = _first_of(control.name, free)
    given: dict[str, Any] = {control.name: control.value}
    one = fit(separation, force, pair, **given, liquid=liquid, free=first, **options)
    other = "suction" if control.name == "volume" else "volume"
    guess: dict[str, Any] = {other: _other_held(one, pair, control, liquid, other)}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FitWarning)  # that the other control does not reach all points is the evidence
        second = tuple(other if name == control.name else name for name in first)
        two = fit(separation, force, pair, **guess, liquid=liquid, free=second, **options)
    found = {control.name: one, other: two}
    difference = found["suction"].criterion - found["volume"].criterion
    better = "neither" if abs(difference) < _NOTHING else "volume" if difference > 0.0 else "suction"
    return Controls(found["volume"], found["suction"], better, math.exp(min(0.5 * abs(difference), _MOST)))


def _other_held(fitted: Fit, pair: Pair, control: Control, liquid: Liquid, other: str) -> float:
    """Suction or volume of the bridge halfway along the curve, as fitted or as guessed."""
    middle = float(np.median(fitted.separation))
    guessed: dict[str, Any] = {control.name: float(control.value)}
    for solids, place, held in (
        (fitted.pair, middle + fitted.numbers["offset"], dict(fitted.held)),
        (pair, middle, guessed),
    ):
        state = bridge(solids, place, **held, liquid=liquid)
        if state.exists and getattr(state, other) > 0.0:
            return float(getattr(state, other))
    raise ValueError(f"{control.name}: {control.value:.6g} holds no bridge halfway along the curve that has a {other}")


def _first_of(control: str, free: Any) -> tuple[str, ...]:
    if free is None:
        return ("contact_angle", control, "offset")
    if isinstance(free, str) or not hasattr(free, "__iter__"):
        raise ValueError(f"free: {free!r} is not a sequence of names")
    names = tuple(free)
    if "evaporation_rate" in names:
        raise ValueError("free: 'evaporation_rate' is of a volume, and no suction has one")
    return tuple(control if name in ("volume", "suction") else name for name in names)
