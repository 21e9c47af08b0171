"""Angles, volumes and contact points from a measured curve of the force, with their errors."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.liquid import Liquid
from ..ask.pair import Pair, check_pair
from ..ask.problem import control_of
from ..ground.check import in_range, one_of, whole_number
from ..ground.warn import warn
from . import rules
from .errors import errors_of, secant_rates, widening
from .model import Data, Model, ends_at
from .question import curve_of, errors_given, model_of
from .result import Fit
from .rules import Loss
from .search import Minimum, Misses, gain_of, limits_of, minimum_of, scores_of
from .unknowns import Unknown, outer

__all__ = ["FitWarning", "fit"]

Floats = NDArray[np.float64]

_MOST_STARTS = 100


class FitWarning(UserWarning):
    """A fit did not settle, or its model does not reach all points of the curve."""


def fit(
    separation: ArrayLike,
    force: ArrayLike,
    pair: Pair,
    *,
    volume: ArrayLike | None = None,
    suction: ArrayLike | None = None,
    humidity: ArrayLike | None = None,
    liquid: Liquid,
    free: Sequence[str] | None = None,
    force_error: ArrayLike | None = None,
    weights: ArrayLike | None = None,
    rupture: Any = None,
    jump_in: Any = None,
    time: ArrayLike | None = None,
    start: Mapping[str, Any] | None = None,
    bounds: Mapping[str, Any] | None = None,
    loss: Loss = "linear",
    starts: int = rules.STARTS,
    method: str = "exact",
) -> Fit:
    r"""Contact angle, volume, contact point and more from a measured curve, with honest errors.

    .. math:: F(D) = s\,F_\text{bridge}(D + o) + F_0 + b\,D

    Parameters
    ----------
    separation : array_like
        As measured, [m]; the true one is this plus the ``offset`` o.
    force : array_like
        As measured, attraction positive, [N].
    pair : Pair
        The solids; what is free begins here.
    volume, suction, humidity : float, optional
        What the bridges hold, [m³], [Pa] or [-]; exactly one of them. A guess where it is free.
    liquid : Liquid
        Surface tension, and for humidity density and molar mass.
    free : sequence of str, optional
        What is fitted, of ``contact_angle`` (of both solids, ``contact_angle1``, ``contact_angle2``), ``volume``,
        ``suction``, ``humidity``, ``surface_tension``, ``radius`` (``radius1``, ``radius2``), ``offset``,
        ``force_zero`` F0, ``force_scale`` s, ``base_slope`` b, ``evaporation_rate``; contact angle, what is held and
        offset if not given.
    force_error : array_like, optional
        Standard error of the forces, one or each, [N]; else the residuals tell it.
    weights : array_like, optional
        In its place, the inverse squares of errors whose common size the residuals tell.
    rupture : float, tuple or str, optional
        Where the bridge broke, on the scale of the separation, as a datum: a length, [m]; a length with its standard
        error; ``"end"`` of the curve; or the largest ``"jump"`` of the force. Points beyond it are base line.
    jump_in : float or tuple, optional
        Separation at which the bridge formed on approach, at a suction or humidity, as a datum: with its standard error
        or without. It is taken for that of equilibrium, Ω = 0; a nucleus that has to wait jumps later.
    time : array_like, optional
        Of each point, [s], for an evaporation rate [m³/s]; the volume is that at time 0.
    start : mapping, optional
        Values of ``offset``, ``force_zero``, ``force_scale``, ``base_slope``, ``evaporation_rate`` other than 0 and 1:
        guesses where they are free.
    bounds : mapping, optional
        Pairs (low, high) for what is free.
    loss : {"linear", "soft_l1", "huber", "cauchy"}
        Squares, or one that heeds outliers less.
    starts : int
        From how many places the search begins: the guess, and others about it.
    method : str
        ``"exact"``, or a law: what that law would have made of the curve.

    Returns
    -------
    Fit

    Raises
    ------
    ValueError
        For bad input, and without SciPy.

    Warns
    -----
    FitWarning
        Where the search did not settle, or the model holds no bridge at some of the points.

    Notes
    -----
    The rates of the force come from the matrix of the exact solver. Errors are those of an M-estimator, with the rates
    at the minimum. **Validity.** They cover the truth as often as they say where the rates change little within the
    errors; a test prints how often.

    Examples
    --------
    >>> from pendular import bridge
    >>> gap = np.linspace(0.0, 90e-6, 40)
    >>> beads, water = Pair(radius=1e-3, contact_angle=0.5), Liquid.water()
    >>> truth = bridge(beads, gap, volume=10e-12, liquid=water).force
    >>> found = fit(gap - 2e-6, truth, Pair(1e-3, 0.3), volume=7e-12, liquid=water)
    >>> print(", ".join(f"{name} {value:.4g}" for name, value in found.values.items()))
    contact_angle 0.5, volume 1e-11, offset 2e-06
    """
    if find_spec("scipy") is None:
        raise ValueError("fit: scipy is not installed; pip install 'pendular[fit]'")
    one_of("loss", loss, tuple(rules.LOSSES))
    count = int(in_range("starts", whole_number("starts", starts, 1), 1, _MOST_STARTS))
    check_pair(pair)
    control = control_of(suction, volume, humidity, liquid)
    named = "humidity" if humidity is not None else control.name
    data = curve_of(
        separation, force, time, rupture, jump_in, isinstance(free, Sequence) and "evaporation_rate" in free
    )
    errors, is_absolute = errors_given(force_error, weights, data.force.size)
    model = model_of(pair, control, liquid, free, start, bounds, method, data, named)
    found, errors = _settled(model, data, errors, is_absolute, loss, count)
    return _told(model, data, found, errors, loss, is_absolute)


def _settled(
    model: Model, data: Data, errors: Floats, is_absolute: bool, loss: Loss, starts: int
) -> tuple[Minimum, Floats]:
    """The minimum, and the errors of the forces, told by its own residuals if they are not given."""
    if is_absolute:
        return minimum_of(model, data, errors, loss, starts, None), errors
    height = float(np.max(np.abs(data.force)))
    size = rules.FIRST_ERROR * height
    found = minimum_of(model, data, size * errors, loss, starts, None)
    for _ in range(rules.MOST_ROUNDS):
        told = max(_size_of(model, data, found, errors, loss), rules.LEAST_ERROR * height)
        is_settled = abs(told - size) < rules.SETTLED * size
        if loss == "linear" and data.rupture is None and data.jump_in is None:  # no size moves the minimum of squares
            rescaled = size / told
            is_settled = True
            found = found._replace(residuals=rescaled * found.residuals, jacobian=rescaled * found.jacobian)
        size = told
        if is_settled:
            break
        again = minimum_of(model, data, size * errors, loss, 1, found.variables)
        found = again._replace(evaluations=found.evaluations + again.evaluations)
    return found, size * errors


def _size_of(model: Model, data: Data, found: Minimum, errors: Floats, loss: Loss) -> float:
    """Common size of the errors of the forces, by the residuals."""
    misses = ((data.force - found.prediction.force) / errors)[data.judged]
    lost = math.sqrt(misses.size / max(misses.size - len(model.unknowns), 1))
    if loss == "linear":
        return lost * float(np.sqrt(np.mean(misses**2)))
    return lost * rules.OF_MEDIAN * float(np.median(np.abs(misses)))


def _told(model: Model, data: Data, found: Minimum, errors: Floats, loss: Loss, is_absolute: bool) -> Fit:
    """The answer of a search."""
    scores, gain = scores_of(loss, found.residuals), gain_of(loss, found.residuals)
    misses = Misses(model, data, errors)
    misses.searched(found.variables)  # from here on NaN where nothing is known
    rates = secant_rates(
        misses.residuals,
        found.variables,
        found.jacobian,
        widening(scores, gain, len(model.unknowns)),
        *limits_of(model),
    )
    told = errors_of(model.unknowns, found.variables, rates, scores, gain)
    numbers = model.at(found.variables)
    values = {one.name: outer(one, float(u)) for one, u in zip(model.unknowns, found.variables, strict=True)}
    notes = [*told.notes, *(line for one in model.unknowns if (line := _at_bound(one, values[one.name])))]
    unreached = found.prediction.unreached
    if unreached:
        notes.append(f"at these values there is no bridge at {unreached} of {data.force.size} points")
        warn(f"the fit holds no bridge at {unreached} of {data.force.size} points", FitWarning)
    if not found.converged:
        warn(f"the fit did not settle: {found.message}", FitWarning)
    ends = found.prediction.ends
    if ends is None and model.method == "exact":
        ends = ends_at(model, data, found.variables, with_rates=False)
    places = (data.rupture is not None) + (data.jump_in is not None)
    freedom = int(np.count_nonzero(data.judged)) + places - len(model.unknowns)
    size = np.array([told.errors])
    with np.errstate(invalid="ignore"):
        covariance = told.correlation * size * size.T
    named = next((one.name for one in model.unknowns if one.kind == "humidity"), model.control)
    return Fit(
        values=values,
        errors=dict(zip(values, told.errors.tolist(), strict=True)),
        upper=told.upper,
        correlation=told.correlation,
        covariance=covariance,
        notes=tuple(notes),
        separation=data.separation,
        force=data.force,
        fitted=found.prediction.force,
        residuals=data.force - found.prediction.force,
        force_error=errors,
        rupture_separation=math.nan if ends is None else ends.separation - numbers["offset"],
        measured_rupture=data.rupture,
        pair=Pair((numbers["radius1"], numbers["radius2"]), (numbers["contact_angle1"], numbers["contact_angle2"])),
        liquid=replace(model.liquid, surface_tension=numbers["surface_tension"]),
        held={named: values[named] if named == "humidity" else numbers[model.control]},
        numbers=numbers,
        method=model.method,
        chi_square=float(np.sum(found.residuals**2)),
        degrees_of_freedom=freedom,
        criterion=_criterion(found.residuals, errors[data.judged], len(model.unknowns), is_absolute),
        converged=found.converged,
        evaluations=found.evaluations,
    )


def _criterion(residuals: Floats, errors: Floats, free: int, is_absolute: bool) -> float:
    """Akaike's criterion, -2 ln likelihood of normal errors and a cost of each free number; of 1 N."""
    count = errors.size
    number = free + (not is_absolute)
    likelihood = float(np.sum(residuals**2) + 2.0 * np.sum(np.log(errors)))
    return likelihood + 2.0 * number * count / max(count - number - 1, 1)


def _at_bound(unknown: Unknown, value: float) -> str:
    """One line for a value that has met its bound."""
    for end, word in ((unknown.low, "lower"), (unknown.high, "upper")):
        if unknown.kind == "cosine" and end == 0.0:
            continue  # told by its upper bound
        if abs(value - end) <= rules.BOUND_MET * max(
            abs(end), abs(unknown.high - unknown.low) if unknown.kind != "log" else 0.0
        ):
            return f"{unknown.name}: at its {word} bound, {end:.6g} {unknown.unit}".rstrip()
    return ""
