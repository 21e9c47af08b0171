"""The least squares of a curve: residuals in units of their error, a loss, and starts from several places."""

from collections.abc import Callable
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import rules
from .formation import formation_at
from .model import Data, Ends, Model, Prediction, predict, predict_by_law
from .rules import Loss
from .unknowns import inner

__all__ = ["Minimum", "Misses", "gain_of", "limits_of", "minimum_of", "scores_of"]

Floats = NDArray[np.float64]


class Minimum(NamedTuple):
    """Where the search ended."""

    variables: Floats
    prediction: Prediction
    residuals: Floats  # of the force and of the rupture, in units of their errors
    jacobian: Floats
    converged: bool
    message: str
    evaluations: int


class Misses:
    """Residuals of a model in units of their errors, those of the force first, then those of rupture and jump-in.

    The last one, of the search alone, tells how far the curve goes beyond the rupture of the model.
    """

    def __init__(self, model: Model, data: Data, errors: Floats) -> None:
        self._model, self._data, self._errors = model, data, errors
        self._worth = data.steepness / float(np.median(errors))
        self._predict: Callable[..., Prediction] = predict if model.method == "exact" else predict_by_law
        self._known = 0  # residuals
        self.evaluations = 0

    def searched(self, variables: Floats) -> Floats:
        """All residuals, for the optimiser; after the start NaN where the solver or the law knows no answer."""
        self.evaluations += 1
        try:
            found = self.prediction(variables, with_rates=False)
            told = self._of(found, variables)
        except ValueError:
            if not self._known:
                raise
            return np.full(self._known, np.nan)
        self._known = told.size + 1
        return np.append(told, self._worth * self._excess(found, variables))

    def searched_rates(self, variables: Floats) -> Floats:
        """Their rates."""
        found = self.prediction(variables, with_rates=True)
        last = np.zeros(len(self._model.unknowns))
        if found.ends is not None and self._excess(found, variables) > 0.0:
            last = -self._worth * self._measured(found.ends.separation_rates)
        return np.vstack([self._rates_of(found, variables), last])

    def prediction(self, variables: Floats, *, with_rates: bool) -> Prediction:
        """Force of the model, and its rates."""
        return self._predict(self._model, self._data, variables, with_rates=with_rates)

    def residuals(self, variables: Floats) -> Floats:
        """Those of the data."""
        return self.searched(variables)[:-1]

    def told(self, variables: Floats) -> tuple[Prediction, Floats, Floats]:
        """Prediction, residuals of the data and their rates."""
        found = self.prediction(variables, with_rates=True)
        return found, self._of(found, variables), self._rates_of(found, variables)

    def _reach(self, ends: Ends, variables: Floats) -> float:
        """Rupture distance on the scale of the measured separation."""
        return ends.separation - self._model.at(variables)["offset"]

    def _excess(self, found: Prediction, variables: Floats) -> float:
        if found.ends is None:
            return 0.0
        return max(self._data.farthest - self._reach(found.ends, variables), 0.0)

    def _of(self, found: Prediction, variables: Floats) -> Floats:
        misses = np.where(self._data.judged, (found.force - self._data.force) / self._errors, 0.0)
        if self._data.rupture is not None and found.ends is not None:
            place, error = self._data.rupture
            misses = np.append(misses, (self._reach(found.ends, variables) - place) / error)
        if self._data.jump_in is not None:
            place, error = self._data.jump_in
            distance, _ = formation_at(self._model, self._data, variables, with_rates=False)
            misses = np.append(misses, (distance - self._model.at(variables)["offset"] - place) / error)
        return misses

    def _rates_of(self, found: Prediction, variables: Floats) -> Floats:
        rates = np.where(self._data.judged[:, None], found.rates / self._errors[:, None], 0.0)
        if self._data.rupture is not None and found.ends is not None:
            rates = np.vstack([rates, self._measured(found.ends.separation_rates) / self._data.rupture[1]])
        if self._data.jump_in is not None:
            _, of_distance = formation_at(self._model, self._data, variables, with_rates=True)
            rates = np.vstack([rates, self._measured(of_distance) / self._data.jump_in[1]])
        return rates

    def _measured(self, rates: Floats) -> Floats:
        """Rates of a distance on the scale of the measured separation."""
        measured = rates.copy()
        for column, unknown in enumerate(self._model.unknowns):
            if unknown.name == "offset":
                measured[column] -= unknown.scale
        return measured


def scores_of(loss: Loss, residuals: Floats) -> Floats:
    """First derivatives of the loss."""
    square = (residuals / rules.LOSSES[loss]) ** 2
    if loss == "soft_l1":
        return residuals / np.sqrt(1.0 + square)
    if loss == "huber":
        return residuals / np.sqrt(np.maximum(square, 1.0))
    if loss == "cauchy":
        return residuals / (1.0 + square)
    return residuals


def gain_of(loss: Loss, residuals: Floats) -> Floats:
    """Second derivatives of the loss.

    Examples
    --------
    >>> gain_of("huber", np.array([0.5, 3.0]))
    array([1., 0.])
    """
    square = (residuals / rules.LOSSES[loss]) ** 2
    gains: dict[Loss, Floats] = {
        "linear": np.ones_like(square),
        "soft_l1": (1.0 + square) ** -1.5,
        "huber": np.where(square <= 1.0, 1.0, 0.0),
        "cauchy": (1.0 - square) / (1.0 + square) ** 2,
    }
    return gains[loss]


def minimum_of(model: Model, data: Data, errors: Floats, loss: Loss, starts: int, begin: Floats | None) -> Minimum:
    """The least loss; the search starts from the guess, and is tried from more places on few of the points."""
    misses = Misses(model, data, errors)
    low, high = limits_of(model)
    first = np.clip(model.start if begin is None else begin, low, high)
    evaluations, likeliest = 0, [first]
    if starts > 1:
        few = _few_of(data)
        scan = Misses(model, few, errors[_chosen(data)])
        tried = [_searched(scan, first, low, high, loss, rules.SCAN)]
        for start in _starts(model, data, first, low, high, starts):
            with suppress(ValueError):  # where there is no answer
                tried.append(_searched(scan, start, low, high, loss, rules.SCAN))
        likeliest, evaluations = _apart(sorted(tried, key=lambda one: float(one.cost))), scan.evaluations
    polished = [_searched(misses, place, low, high, loss, rules.POLISH) for place in likeliest]
    best = min(polished, key=lambda one: float(one.cost))
    prediction, residuals, rates = misses.told(best.x)
    evaluations += misses.evaluations
    return Minimum(best.x, prediction, residuals, rates, bool(best.status > 0), str(best.message), evaluations)


def _apart(tried: list[Any]) -> list[Floats]:
    """The best place, and the next best, if it is another one and nearly as good."""
    best, most = tried[0].x, rules.NEARLY * float(tried[0].cost) + rules.SLIGHT
    other = [one.x for one in tried[1:] if np.max(np.abs(one.x - best)) > rules.SAME and one.cost < most]
    return [best, *other[:1]]


def _searched(misses: Misses, start: Floats, low: Floats, high: Floats, loss: Loss, stops: dict[str, Any]) -> Any:
    from scipy.optimize import least_squares

    return least_squares(
        misses.searched,
        start,
        jac=misses.searched_rates,
        bounds=(low, high),
        loss=loss,
        f_scale=rules.LOSSES[loss],
        x_scale="jac",
        **stops,
    )


def _chosen(data: Data) -> NDArray[np.int_]:
    """Some of the points, evenly along the curve, with its end."""
    order = np.argsort(data.separation, kind="stable")
    order = order[~data.broken[order]]
    chosen: NDArray[np.int_] = order[np.unique(np.linspace(0, order.size - 1, rules.FEW).round().astype(int))]
    return chosen


def _few_of(data: Data) -> Data:
    some = _chosen(data)
    return data._replace(
        separation=data.separation[some],
        force=data.force[some],
        time=data.time[some],
        broken=data.broken[some],
        judged=data.judged[some],
    )


def limits_of(model: Model) -> tuple[Floats, Floats]:
    """Bounds of the variables."""
    ends = np.array([[inner(one, end) for end in (one.low, one.high)] for one in model.unknowns])
    return ends.min(axis=1), ends.max(axis=1)


def _starts(model: Model, data: Data, first: Floats, low: Floats, high: Floats, count: int) -> list[Floats]:
    """Places to start from beside the guess, about it; angles anywhere up to a right one.

    Half of them begin in contact, for the zero of a stage may be anywhere.
    """
    random = np.random.default_rng(rules.SEED)
    starts = []
    touching = first.copy()
    for i, unknown in enumerate(model.unknowns):
        if unknown.name == "offset":
            touching[i] = -float(data.separation.min()) / unknown.scale
    for number in range(count - 1):
        place = (touching if number % 2 else first).copy()
        for i, unknown in enumerate(model.unknowns):
            if unknown.kind == "cosine":
                place[i] = np.cos(random.uniform(0.0, 0.5 * np.pi))
            else:
                place[i] += random.uniform(-1.0, 1.0) * rules.SPREAD[unknown.kind]
        starts.append(np.clip(place, low, high))
    return starts
