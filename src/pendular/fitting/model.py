r"""The force that is to be measured, by the exact solver or by a law, with its rates in the variables that are sought.

.. math:: F = s\,F_\text{bridge}(D + o) + F_0 + b D

A bridge that was measured beyond the rupture distance of the model is a contradiction that has to steer the search:
there the model holds the force of its rupture, and how far the curve goes beyond is a miss of its own.
"""

import warnings
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ask.by_law import RangeWarning
from ..ask.face import bridge, rupture
from ..ask.liquid import Liquid
from ..ask.pair import Pair
from ..ask.problem import Control, Problem, reduce
from ..exact import batch
from ..exact.equations import VOLUME
from ..exact.sensitivities import Rates, rates_of_force
from ..exact.state import State
from ..laws import laws
from . import rules
from .unknowns import Unknown, inner, outer

__all__ = ["Data", "Ends", "Model", "Prediction", "beside", "ends_at", "predict", "predict_by_law", "problem_of"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_JUST_BEFORE = 1e-9  # rupture, in parts of its distance
_LAMBDA, _SEPARATION = State._fields.index("force"), State._fields.index("separation")


class Data(NamedTuple):
    """A measured curve, and what is known of it."""

    separation: Floats
    force: Floats
    time: Floats
    broken: Bools  # beyond a measured rupture: base line alone
    judged: Bools  # whose force counts: next to rupture it falls infinitely fast, and the last tells that it was there
    last_time: Floats  # of the last bridge, one number
    rupture: tuple[float, float] | None  # its separation as measured, and the standard error of that
    jump_in: tuple[float, float] | None  # where the bridge formed on approach, and the standard error of that
    steepness: float  # force that a curve is worth that goes beyond the rupture of the model, [N/m]

    @property
    def farthest(self) -> float:
        """Largest separation with a bridge."""
        return float(self.separation[~self.broken].max())


class Model(NamedTuple):
    """A question, which of its numbers are free, and who answers it."""

    question: dict[str, float]
    unknowns: tuple[Unknown, ...]
    control: str  # volume or suction
    liquid: Liquid
    method: str

    def at(self, variables: Sequence[float] | Floats) -> dict[str, float]:
        """Numbers of the question at values of the variables."""
        moved = dict(self.question)
        for unknown, variable in zip(self.unknowns, variables, strict=True):
            value = outer(unknown, float(variable))
            if unknown.kind == "humidity":
                value = float(np.exp(variable))
            moved.update(dict.fromkeys(unknown.moves, value))
        return moved

    @property
    def knows_rupture(self) -> bool:
        """Whether a rupture distance is known under this control."""
        law = laws[self.method] if self.method != "exact" else None
        return law is None or ("rupture" in law.gives and law.control == self.control)

    @property
    def start(self) -> Floats:
        """Variables of the guess."""
        return np.array([inner(unknown, unknown.start) for unknown in self.unknowns])


class Ends(NamedTuple):
    """Rupture distance and the force there, with their rates in the variables on the last axis."""

    separation: float
    force: float
    separation_rates: Floats
    force_rates: Floats


class Prediction(NamedTuple):
    """Force at each separation with its rates, and how many places the model does not reach."""

    force: Floats
    rates: Floats  # (points, unknowns)
    unreached: int
    ends: Ends | None  # where it was asked for


def _held_values(numbers: Mapping[str, float], control: str, time: Floats, tension: float) -> Floats:
    """Volume at each time; or the suction that would hold the same bridge at the tension of the liquid."""
    if control == "volume":
        volume = numbers["volume"]
        return np.maximum(volume - numbers["evaporation_rate"] * time, rules.LEAST_LEFT * volume)
    return np.full(time.shape, numbers["suction"] * tension / numbers["surface_tension"])


def problem_of(model: Model, numbers: Mapping[str, float], separation: Floats | None, time: Floats) -> Problem:
    """The question of some numbers, reduced; at the tension of the liquid, of which the force is a multiple."""
    pair = Pair((numbers["radius1"], numbers["radius2"]), (numbers["contact_angle1"], numbers["contact_angle2"]))
    held: Any = Control(
        "volume" if model.control == "volume" else "suction",
        _held_values(numbers, model.control, time, model.liquid.surface_tension),
    )
    return reduce(pair, held, model.liquid, separation)


def predict(model: Model, data: Data, variables: Floats, *, with_rates: bool) -> Prediction:
    """Force of the exact bridges, and its rates."""
    numbers = model.at(variables)
    place = data.separation + numbers["offset"]
    problem = problem_of(model, numbers, place, data.time)
    states, _ = batch.answer(batch.STABLE, problem.held, problem.rows)
    reached = ~np.isnan(states[:, _LAMBDA])
    unit = 2.0 * np.pi * numbers["surface_tension"] * problem.length
    force = np.where(data.broken | ~reached, 0.0, unit * states[:, _LAMBDA])
    beyond = ~reached & ~data.broken
    ends = None
    if data.rupture is not None or beyond.any():
        ends = ends_at(model, data, variables, with_rates=with_rates)
    rates = np.zeros((place.size, len(model.unknowns)))
    if with_rates:
        by_number = _rates_of_numbers(model, numbers, problem, states, unit, data.time)
        for column, unknown in enumerate(model.unknowns):
            rates[:, column] = np.where(
                data.broken | ~reached, 0.0, sum(by_number.get(name, 0.0) for name in unknown.moves)
            )
    if ends is not None:
        beyond &= place > ends.separation
        force[beyond], rates[beyond] = ends.force, ends.force_rates
        reached |= beyond & (place - ends.separation < rules.TOUCHING * np.ptp(place))
    return _as_measured(model, data, numbers, force, rates, int(np.count_nonzero(~reached & ~data.broken)), ends)


def _rates_of_numbers(
    model: Model, numbers: Mapping[str, float], problem: Problem, states: Floats, unit: Floats, time: Floats
) -> dict[str, Floats]:
    """Rates of the force of the bridge in the variables of each number of the question."""
    rates = Rates(*rates_of_force(problem.held, problem.rows, states).T)
    length = problem.length
    held = problem.rows[:, 1]
    force = unit * states[:, _LAMBDA]
    by_held = unit * rates.held * held  # in the logarithm of what is held
    found = {
        "contact_angle1": unit * rates.cos_angle1,
        "contact_angle2": unit * rates.cos_angle2,
        "radius1": -unit * rates.curvature1 * problem.rows[:, 2],
        "radius2": -unit * rates.curvature2 * problem.rows[:, 4],
        "offset": unit * rates.separation / length,
        "surface_tension": force,
    }
    if problem.held == VOLUME:
        left = held * length**3
        found["volume"] = np.where(
            left > rules.LEAST_LEFT * numbers["volume"], by_held * numbers["volume"] / left, by_held
        )
        found["evaporation_rate"] = np.where(left > rules.LEAST_LEFT * numbers["volume"], -by_held / left * time, 0.0)
    else:
        found["surface_tension"] = force - by_held
        found["suction"] = by_held
    for unknown in model.unknowns:
        if unknown.kind == "linear" and unknown.name in found:
            per_value = found[unknown.name]
            if unknown.name == "suction":
                per_value = unit * rates.held * length / numbers["surface_tension"]
            found[unknown.name] = per_value * unknown.scale
    return found


def _as_measured(
    model: Model,
    data: Data,
    numbers: Mapping[str, float],
    force: Floats,
    rates: Floats,
    unreached: int,
    ends: Ends | None,
) -> Prediction:
    """Force on the scale of the instrument."""
    scale = numbers["force_scale"]
    rates = scale * rates
    for column, unknown in enumerate(model.unknowns):
        if unknown.name == "force_scale":
            rates[:, column] = scale * force
        elif unknown.name == "force_zero":
            rates[:, column] = unknown.scale
        elif unknown.name == "base_slope":
            rates[:, column] = unknown.scale * data.separation
    measured = scale * force + numbers["force_zero"] + numbers["base_slope"] * data.separation
    return Prediction(measured, rates, unreached, ends)


def ends_at(model: Model, data: Data, variables: Floats, *, with_rates: bool) -> Ends:
    """Rupture distance and the force there; their rates by differences, for a pitchfork has no others."""
    base = np.asarray(variables, dtype=np.float64)
    asked = beside(model, base)[0] if with_rates else base[None, :]
    problems = [problem_of(model, model.at(row), None, data.last_time) for row in asked]
    states, _ = batch.answer(batch.RUPTURE, problems[0].held, np.concatenate([problem.rows for problem in problems]))
    length = np.array([problem.length.item() for problem in problems])
    tension = np.array([model.at(row)["surface_tension"] for row in asked])
    separation = np.nan_to_num(states[:, _SEPARATION] * length)
    force = np.nan_to_num(2.0 * np.pi * tension * length * states[:, _LAMBDA])
    return _ends_of(separation, force, asked)


def _ends_of(separation: Floats, force: Floats, asked: Floats) -> Ends:
    """Ends at the first of several sets of variables, and the rates that the others tell."""
    count = asked.shape[1]
    if len(asked) == 1:
        return Ends(separation.item(), force.item(), np.zeros(count), np.zeros(count))
    forth, back = slice(1, count + 1), slice(count + 1, None)
    wide = np.diag(asked[forth] - asked[back])
    return Ends(
        float(separation[0]),
        float(force[0]),
        (separation[forth] - separation[back]) / wide,
        (force[forth] - force[back]) / wide,
    )


def predict_by_law(model: Model, data: Data, variables: Floats, *, with_rates: bool) -> Prediction:
    """Force by a law, and its rates by differences.

    Beyond the rupture distance of the law, if it gives one, its force is that at the last place before.
    """
    base = np.asarray(variables, dtype=np.float64)
    count = len(base)
    asked, wide = beside(model, base) if with_rates else (base[None, :], np.empty(0))
    force, is_known, ends = _force_by_law(model, data, asked)
    rates = np.zeros((data.separation.size, count))
    if with_rates:
        rates = ((force[1 : count + 1] - force[count + 1 :]) / wide[:, None]).T
    reached = is_known[0]
    if ends is not None:
        place = data.separation + model.at(base)["offset"]
        reached = reached | (place - ends.separation < rules.TOUCHING * np.ptp(place))
    return _as_measured(
        model, data, model.at(base), force[0], rates, int(np.count_nonzero(~reached & ~data.broken)), ends
    )


def beside(model: Model, base: Floats) -> tuple[Floats, Floats]:
    """Variables, and sets with one of them a step ahead, and a step behind; how far these are apart."""
    steps = rules.STEP * np.eye(base.size)
    ahead, behind = base + steps, base - steps
    for column, unknown in enumerate(model.unknowns):
        if unknown.kind == "cosine":
            ahead[column, column] = min(ahead[column, column], 1.0)
    return np.vstack([base, ahead, behind]), np.diag(ahead - behind)


def _force_by_law(model: Model, data: Data, asked: Floats) -> tuple[Floats, Bools, Ends | None]:
    """Force at several sets of variables, a row each; where the law says that there is a bridge; where that ends."""
    sets = [model.at(row) for row in asked]

    def column(name: str) -> Floats:
        return np.array([numbers[name] for numbers in sets])[:, None]

    pair = Pair((column("radius1"), column("radius2")), (column("contact_angle1"), column("contact_angle2")))
    tension = model.liquid.surface_tension
    place = data.separation + column("offset")
    ends = None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RangeWarning)
        if model.knows_rupture:
            last = np.stack([_held_values(numbers, model.control, data.last_time, tension) for numbers in sets])
            known: dict[str, Any] = {model.control: last, "liquid": model.liquid, "method": model.method}
            distance = np.asarray(rupture(pair, **known).separation)
            place = np.fmin(place, distance * (1.0 - _JUST_BEFORE))  # NaN where the law says nothing
            ends = _ends_of(np.nan_to_num(distance[:, 0]), np.zeros(len(sets)), asked)
        held = np.stack([_held_values(numbers, model.control, data.time, tension) for numbers in sets])
        known = {model.control: held, "liquid": model.liquid, "method": model.method}
        answer = bridge(pair, place, **known)
    force = np.nan_to_num(np.asarray(answer.force)) * column("surface_tension") / tension
    return np.where(data.broken, 0.0, force), np.asarray(answer.exists), ends
