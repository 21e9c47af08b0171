"""How well the data fix what was fitted: covariance, correlation, what they do not tell apart, one-sided bounds."""

import math
from collections.abc import Callable, Sequence
from statistics import NormalDist
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import rules
from .unknowns import Unknown, outer, slope

__all__ = ["Errors", "errors_of", "secant_rates", "widening"]

Floats = NDArray[np.float64]


class Errors(NamedTuple):
    """What the data say of each unknown."""

    errors: Floats  # one standard error each; infinite where the data say nothing
    correlation: Floats
    upper: dict[str, float]  # upper bounds with 95 % confidence, of angles that may be 0
    notes: tuple[str, ...]


def errors_of(unknowns: Sequence[Unknown], variables: Floats, jacobian: Floats, scores: Floats, gain: Floats) -> Errors:
    r"""Errors at a minimum.

    The rows of the Jacobian and the scores, the first derivatives of the loss, are those of a unit of error. The gain
    of a score, its own derivative, is 1 for squares; the covariance is that of an M-estimator,
    :math:`(J^TJ)^{-1}\, \overline{\psi^2} / \overline{\psi'}^2`.
    """
    size = np.sqrt(np.sum(jacobian**2, axis=0))
    silent = size == 0.0
    size[silent] = 1.0
    scaled = jacobian / size
    values, vectors = np.linalg.eigh(scaled.T @ scaled)
    flat = values <= rules.SINGULAR**2 * max(values[-1], 1.0)
    inverse = (vectors[:, ~flat] / values[~flat]) @ vectors[:, ~flat].T
    widened = widening(scores, gain, len(unknowns))
    deviation = np.sqrt(widened * np.diag(inverse))
    lost = np.any(np.abs(vectors[:, flat]) > rules.NOT_FIXED, axis=1)
    step = -inverse @ (scaled.T @ scores) / np.mean(gain) / size
    correlation = widened * inverse / np.outer(*(2 * [np.where(deviation > 0.0, deviation, 1.0)]))
    correlation[lost] = correlation[:, lost] = math.nan
    np.fill_diagonal(correlation, 1.0)
    turn = np.array([-1.0 if unknown.kind in ("cosine", "humidity") else 1.0 for unknown in unknowns])
    correlation *= np.outer(turn, turn)
    notes = [_valley(unknowns, vectors[:, i], silent) for i in np.flatnonzero(flat)]
    errors, upper = np.empty(len(unknowns)), {}
    for i, unknown in enumerate(unknowns):
        error = math.inf if lost[i] else float(deviation[i] / size[i])
        errors[i], bound = _error_of(unknown, float(variables[i]), error, float(step[i]))
        if bound is not None:
            upper[unknown.name] = bound
            told = f"below {math.degrees(bound):.3g}° with 95 % confidence"
            notes.append(f"{unknown.name}: 0 is within its error; {told}")
    return Errors(errors, correlation, upper, (*notes, *_valleys(unknowns, correlation)))


def widening(scores: Floats, gain: Floats, free: int) -> float:
    """By how much a loss that is not squares makes the covariance wider; 1 for squares."""
    if not np.any(gain != 1.0):
        return 1.0
    return float(np.sum(scores**2) / max(scores.size - free, 1) / np.mean(gain) ** 2)


def secant_rates(
    residuals: Callable[[Floats], Floats],
    variables: Floats,
    jacobian: Floats,
    widened: float,
    low: Floats,
    high: Floats,
) -> Floats:
    """Rates of residuals by differences over one standard error along the axes of the covariance.

    Where the rates change within the errors, next to rupture or along a bent valley, these tell the width of the
    minimum better. The Jacobian is taken as it is where it leaves a direction open.
    """
    size = np.sqrt(np.sum(jacobian**2, axis=0))
    if not size.all():
        return jacobian
    values, vectors = np.linalg.eigh((jacobian / size).T @ (jacobian / size))
    if values[0] < rules.SINGULAR**2 * values[-1]:
        return jacobian
    axes = math.sqrt(widened) * vectors / np.sqrt(values) / size[:, None]
    columns = np.column_stack([_secant(residuals, variables, axis, low, high) for axis in axes.T])
    rates: Floats = jacobian if np.isnan(columns).any() else columns @ np.linalg.inv(axes)
    return rates


def _secant(residuals: Callable[[Floats], Floats], start: Floats, axis: Floats, low: Floats, high: Floats) -> Floats:
    """Rate of residuals along an axis, over as much of one length of it both ways as the bounds leave.

    NaN where they leave hardly any.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        room = np.where(axis > 0.0, (high - start) / axis, np.where(axis < 0.0, (low - start) / axis, np.inf))
        back = np.where(axis > 0.0, (start - low) / axis, np.where(axis < 0.0, (start - high) / axis, np.inf))
    forth, back_to = min(1.0, float(room.min())), -min(1.0, float(back.min()))
    width = forth - back_to
    if width < rules.LEAST_ROOM:
        return np.full(residuals(start).shape, np.nan)
    return (residuals(start + forth * axis) - residuals(start + back_to * axis)) / width


def _error_of(unknown: Unknown, variable: float, error: float, step: float) -> tuple[float, float | None]:
    """Standard error of a value; for an angle near 0 that of one side, and its upper bound."""
    value = outer(unknown, variable)
    if not math.isfinite(error):
        return math.inf, None
    if unknown.kind != "cosine":
        return abs(slope(unknown, value)) * error, None
    if variable + rules.NEAR_ZERO * error < 1.0:
        return max(abs(outer(unknown, variable + way) - value) for way in (-error, error)), None
    best = (
        max(variable, variable + step) if variable > 1.0 - rules.AT_BOUND * error else variable
    )  # as if none were there
    likely, sure = (math.acos(max(-1.0, _exceeded(best, error, share))) for share in (rules.LIKELY, rules.SURE))
    return max(likely - value, 0.0), sure


def _exceeded(mean: float, error: float, share: float) -> float:
    """The value that a normal variable, known to lie below 1, exceeds with a probability."""
    if mean > 1.0 + rules.FAR_BEYOND * error:  # its tail falls exponentially
        return 1.0 + math.log1p(-share) * error**2 / (mean - 1.0)
    normal = NormalDist(mean, error)
    return normal.inv_cdf((1.0 - share) * normal.cdf(1.0))


def _valley(unknowns: Sequence[Unknown], direction: Floats, silent: NDArray[np.bool_]) -> str:
    """One line for a direction in which nothing changes."""
    names = [unknown.name for unknown in unknowns]
    order = np.argsort(-np.abs(direction))
    if silent[order[0]] or len(names) == 1:
        return f"{names[order[0]]}: has no effect on these data"
    share = sorted(i for i in order if abs(direction[i]) > rules.NOT_FIXED * abs(direction[order[0]]))
    told = " and ".join(names[i] for i in share[:2])
    more = f", with {', '.join(names[i] for i in share[2:])}" if len(share) > 2 else ""
    return f"{told}: the data do not tell them apart{more}; fix one of them"


def _valleys(unknowns: Sequence[Unknown], correlation: Floats) -> list[str]:
    """One line for each pair that the data hardly tell apart."""
    notes = []
    for i in range(len(unknowns)):
        for j in range(i):
            if abs(correlation[i, j]) > rules.VALLEY:
                notes.append(
                    f"{unknowns[j].name} and {unknowns[i].name}: the data hardly tell them apart, correlation "
                    f"{correlation[i, j]:+.4f}"
                )
    return notes
