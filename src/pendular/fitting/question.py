"""What a fit is asked, read and checked: the curve, the question and its unknowns, the datum of a rupture."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.liquid import Liquid
from ..ask.pair import Pair, check_pair, has_planes
from ..ask.problem import Control
from ..ground.check import in_range, one_of, quantity, scalar
from ..laws import laws
from . import rules
from .model import Data, Model
from .unknowns import NAMES, first_offset, unknown_of

__all__ = ["curve_of", "errors_given", "model_of"]

Floats = NDArray[np.float64]

_CLOSEST_OF_LAW = 1e-3  # separation over the length of the curve; laws know no overlap


def curve_of(
    separation: ArrayLike, force: ArrayLike, time: ArrayLike | None, rupture: Any, jump_in: Any, has_rate: bool
) -> Data:
    """The measured curve."""
    places, forces = _column("separation", separation, "m", None), _column("force", force, "N", None)
    if places.size != forces.size:
        raise ValueError(f"force: {forces.size} values beside {places.size} of separation")
    if has_rate and time is None:
        raise ValueError("time: needed for an evaporation_rate")
    times = np.zeros(places.size) if time is None else _column("time", time, "s", places.size)
    span, height = float(np.ptp(places)), float(np.max(np.abs(forces)))
    if not span > 0.0 or not height > 0.0:
        raise ValueError(f"{'separation' if span == 0.0 else 'force'}: all values are the same")
    datum = _rupture_of(rupture, places, forces)
    broken = np.zeros(places.size, bool) if datum is None else places > datum[0]
    if broken.all():
        raise ValueError(f"rupture: {datum[0]:.6g} m lies before all separations" if datum else "")
    last = np.flatnonzero(~broken)[np.argmax(places[~broken])]
    judged = broken | (places < places[last])
    formed = None if jump_in is None else _place_of("jump_in", jump_in, float(np.median(np.diff(np.sort(places)))))
    return Data(
        places, forces, times, broken, judged, times[last : last + 1], datum, formed, rules.STEEP * height / span
    )


def _column(name: str, values: ArrayLike, unit: str, count: int | None) -> Floats:
    array = quantity(name, values, unit)
    if array.ndim != 1 or array.size < 2:
        raise ValueError(f"{name}: an array of shape {array.shape} is not a curve of at least 2 points")
    if count is not None and array.size != count:
        raise ValueError(f"{name}: {array.size} values beside {count} of separation")
    return array


def _rupture_of(rupture: Any, places: Floats, forces: Floats) -> tuple[float, float] | None:
    """Separation of the rupture and its standard error, where it is a datum."""
    if rupture is None:
        return None
    order = np.argsort(places, kind="stable")
    place, force = places[order], forces[order]
    steps = np.diff(place)
    if isinstance(rupture, str):
        one_of("rupture", rupture, ("end", "jump"))
        if rupture == "end":
            return float(place[-1] + 0.5 * steps[-1]), max(float(steps[-1]), 1e-9 * float(place[-1])) / rules.OF_UNIFORM
        drops = -np.diff(force)
        i = int(np.argmax(drops))
        if not drops[i] > rules.CLEAR_JUMP * float(np.median(np.abs(drops))):
            raise ValueError(
                f"rupture: no clear jump of the force; the largest is {drops[i]:.3g} N at {place[i]:.6g} m"
            )
        return float(0.5 * (place[i] + place[i + 1])), float(steps[i]) / rules.OF_UNIFORM
    return _place_of("rupture", rupture, float(np.median(steps)))


def _place_of(name: str, value: Any, step: float) -> tuple[float, float]:
    """A separation and its standard error, which by default is that of a place between two points."""
    if not isinstance(value, tuple):
        return scalar(name, value, "m"), step / rules.OF_UNIFORM
    if len(value) != 2:
        raise ValueError(f"{name}: a tuple of {len(value)} is not (separation, standard error)")
    error = in_range(f"{name}[1]", scalar(f"{name}[1]", value[1], "m"), 0.0, brackets="()", unit="m")
    return scalar(f"{name}[0]", value[0], "m"), error


def errors_given(force_error: ArrayLike | None, weights: ArrayLike | None, count: int) -> tuple[Floats, bool]:
    """Errors of the forces, and whether they are absolute; without any they are equal, and so are they by weights."""
    if force_error is not None and weights is not None:
        raise ValueError("weights: given together with force_error; one of the two is needed")
    if force_error is not None:
        return _each("force_error", force_error, "N", count), True
    if weights is None:
        return np.ones(count), False
    return 1.0 / np.sqrt(_each("weights", weights, "", count)), False


def _each(name: str, values: ArrayLike, unit: str, count: int) -> Floats:
    array = in_range(name, quantity(name, values, unit), 0.0, brackets="()", unit=unit)
    if array.ndim > 1 or array.size not in (1, count):
        raise ValueError(f"{name}: an array of shape {array.shape} beside {count} separations")
    return np.broadcast_to(array, count).astype(np.float64)


def model_of(
    pair: Pair,
    control: Control,
    liquid: Liquid,
    free: Sequence[str] | None,
    start: Mapping[str, Any] | None,
    bounds: Mapping[str, Any] | None,
    method: str,
    data: Data,
    named: str,
) -> Model:
    """The question and its unknowns; ``named`` is the control as it was given."""
    check_pair(pair)
    if method != "exact" and (not isinstance(method, str) or method not in laws or "force" not in laws[method].gives):
        able = ", ".join(name for name, law in laws.items() if "force" in law.gives)
        raise ValueError(f"method: {method!r} is neither 'exact' nor one of the laws that give a force, {able}")
    numbers = (control.value, *pair.radii, *pair.contact_angles)
    if any(np.ndim(number) for number in numbers):
        raise ValueError(f"pair: an array of radii, angles or {named} is given where single numbers are needed")
    question = dict(rules.INSTRUMENT)
    for name, value in _mapping("start", start).items():
        one_of("start", name, tuple(rules.INSTRUMENT))
        question[name] = scalar(f"start[{name}]", value, rules.UNITS[name])
    question |= {f"radius{i}": float(radius) for i, radius in enumerate(pair.radii, 1)}
    question |= {f"contact_angle{i}": float(angle) for i, angle in enumerate(pair.contact_angles, 1)}
    question |= {control.name: float(control.value), "surface_tension": liquid.surface_tension}
    names = _free(free, named, control.name, data)
    limits = _mapping("bounds", bounds)
    for name in limits:
        one_of("bounds", name, names)
    span, height = float(np.ptp(data.separation)), float(np.max(np.abs(data.force)))
    scales = {"offset": span, "force_zero": height, "base_slope": height / span}
    scales["least"] = float(data.separation[~data.broken].min())
    if "evaporation_rate" in names:
        scales["evaporation_rate"] = question["volume"] / max(float(np.ptp(data.time)), 1e-300)
    if method != "exact":
        scales["closest"] = _CLOSEST_OF_LAW * span
    if "offset" in names and "offset" not in _mapping("start", start):
        question["offset"] = first_offset(question, scales)
    unknowns = tuple(unknown_of(name, question, liquid, scales, limits.get(name)) for name in names)
    model = Model(question, unknowns, control.name, liquid, method)
    if data.rupture is not None and not model.knows_rupture:
        raise ValueError(f"rupture: is no datum for the law {method!r}, which gives none at constant {control.name}")
    if data.jump_in is not None and (control.name == "volume" or method != "exact" or has_planes(pair)):
        raise ValueError("jump_in: is a datum of exact bridges of a sphere at constant suction, where they condense")
    return model


def _mapping(name: str, value: Any) -> dict[str, Any]:
    if value is None:
        return {}
    if not isinstance(value, Mapping) or not all(isinstance(key, str) for key in value):
        raise ValueError(f"{name}: {value!r} is not a mapping from names to values")
    return dict(value)


def _free(free: Any, named: str, control: str, data: Data) -> tuple[str, ...]:
    """Names of what is free, each once, and none that the control does not know."""
    free = ("contact_angle", named, "offset") if free is None else free
    if isinstance(free, str) or not isinstance(free, Sequence) or not free:
        raise ValueError(f"free: {free!r} is not a sequence of names, of {', '.join(NAMES)}")
    names = tuple(free)
    for i, name in enumerate(names):
        one_of("free", name, NAMES)
        if name in names[:i]:
            raise ValueError(f"free: {name!r} is given twice")
        if name in ("volume", "suction", "humidity") and name != named:
            raise ValueError(f"free: {name!r} is not what is held, which is the {named}")
        if name == "evaporation_rate" and control != "volume":
            raise ValueError(f"free: 'evaporation_rate' is of a volume; what is held is the {named}")
    for both in ("contact_angle", "radius"):
        if both in names and {f"{both}1", f"{both}2"} & set(names):
            raise ValueError(f"free: {both!r} stands for that of both solids, beside that of one of them")
    points = int(np.count_nonzero(data.judged)) + (data.rupture is not None) + (data.jump_in is not None)
    if len(names) >= points:
        raise ValueError(f"free: {len(names)} numbers need more than {points} points beside the last")
    return names
