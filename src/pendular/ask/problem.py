"""A public question reduced to numbers, answered by the exact solver, and scaled back to SI units.

Lengths are divided by the smaller radius and γ is 1: each row of a problem is (D, H or V, k1, θ1, k2, θ2). Between two
planes they are divided by the cube root of the volume, or under suction by the gap.
"""

from collections.abc import Callable
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..exact import batch
from ..exact.batch import FAILED, FOUND
from ..exact.equations import SUCTION, VOLUME
from ..exact.follow import BRANCH_ENDS, FOLDS
from ..exact.state import State
from ..ground.check import broadcast, in_range, plain, quantity
from ..ground.warn import warn
from .domain import DEEPEST_OVERLAP, LEAST_VOLUME, MOST_SUCTION, MOST_VOLUME, NARROWEST
from .fields import bridge_of, restore_rows, room_for
from .liquid import Liquid, suction_from_humidity
from .pair import Pair, check_pair, has_planes
from .result import FIELDS, Bridge

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Asked = Literal["stable", "unstable", "upper", "lower"]
Limit = Literal["stability", "fold"]

_PER_SOLID = ("contact_radius", "half_filling_angle", "wetted_area", "capillary_tensor")
LIKELY_BETWEEN_PLANES = 0.3  # separation over the cube root of the volume

ASKED: dict[Asked, int] = {
    "stable": batch.STABLE,
    "unstable": batch.UNSTABLE,
    "upper": batch.RUPTURE,
    "lower": batch.LOWER_END,
}
LIMITS: dict[Limit, int] = {"stability": BRANCH_ENDS, "fold": FOLDS}


class ConvergenceWarning(RuntimeWarning):
    """The solver did not find, or exclude, some of the bridges; all their fields are NaN."""


class Control(NamedTuple):
    """The quantity that is held constant; humidity has become a suction."""

    name: Literal["suction", "volume"]
    value: Floats


class _Way(NamedTuple):
    """What is done in one way to Python's numbers, for a single question, and in another to arrays of them."""

    flat: Callable[[NDArray[Any]], Any]  # what a question with an array asks, one after the other
    choose: Callable[[Any, Any, Any], Any]  # the first where a condition holds, else the second
    together: Callable[..., Floats]  # on a last axis
    any: Callable[[Any], Any]
    whole: Callable[[Any], Any]


def _choose(condition: bool, first: Any, second: Any) -> Any:
    return first if condition else second


_ONE = _Way(np.ndarray.item, _choose, lambda *numbers: np.array(numbers), bool, int)
_MANY = _Way(
    np.ravel, np.where, lambda *columns: np.stack(columns, axis=-1), np.any, lambda numbers: numbers.astype(int)
)


class Problem(NamedTuple):
    """A public question, reduced: rows of (D, H or V, k1, θ1, k2, θ2) in a unit of length each, and in that of γ."""

    rows: Floats
    held: int
    separation: Floats  # as asked
    length: Floats  # unit of length, one a row
    surface_tension: float
    shape: tuple[int, ...]


def control_of(
    suction: ArrayLike | None, volume: ArrayLike | None, humidity: ArrayLike | None, liquid: Liquid
) -> Control:
    """Return the one control that was given; humidity becomes a suction."""
    given = [
        name for name, value in (("suction", suction), ("volume", volume), ("humidity", humidity)) if value is not None
    ]
    if len(given) != 1:
        raise ValueError(
            f"control: {' and '.join(given) or 'none'} given; exactly one of suction, volume, humidity is needed"
        )
    if not isinstance(liquid, Liquid):
        raise ValueError(f"liquid: {liquid!r} is not a pendular.Liquid; write Liquid.water() or Liquid.named(name)")
    if humidity is not None:
        return Control("suction", np.asarray(suction_from_humidity(humidity, liquid)))
    if volume is not None:
        return Control("volume", in_range("volume", quantity("volume", volume, "m**3"), 0.0, brackets="()", unit="m^3"))
    return Control("suction", quantity("suction", suction, "Pa"))


def reduce(
    pair: Pair, control: Control, liquid: Liquid, separation: ArrayLike | None, filling: Floats | None = None
) -> Problem:
    """Check what depends on several arguments, broadcast, and divide by a unit of length.

    Without a separation the rows have one at which a bridge is likely. A half-filling angle only lends its shape.
    """
    check_pair(pair)
    (radius1, radius2), (angle1, angle2) = pair.radii, pair.contact_angles
    given = {"separation": separation if separation is None else quantity("separation", separation, "m")}
    given["half_filling_angle"] = filling
    named = {name: array for name, array in given.items() if array is not None}
    named |= {control.name: control.value, "radius[0]": radius1, "radius[1]": radius2}
    named |= {"contact_angle[0]": angle1, "contact_angle[1]": angle2}
    arrays = dict(zip(named, broadcast(**named), strict=True))
    shape = arrays[control.name].shape
    way = _MANY if shape else _ONE
    value, radius1, radius2, angle1, angle2 = (way.flat(array) for array in list(arrays.values())[-5:])
    gap = 0.0 * value if separation is None else way.flat(arrays["separation"])
    smaller = way.choose(radius1 < radius2, radius1, radius2)
    are_planes = smaller == np.inf
    if separation is not None:
        _refuse_deep_overlap(gap, smaller, shape, way)
    with np.errstate(invalid="ignore"):
        mean_radius = 2.0 * smaller / (smaller / radius1 + smaller / radius2)  # NaN of planes
    _refuse_beyond_domain(control, value, mean_radius, gap, liquid, way)
    length = smaller
    if control.name == "volume":
        length = way.choose(are_planes, np.cbrt(value), smaller)
        held, reduced = VOLUME, value / length**3
    else:
        if separation is not None:
            length = way.choose(are_planes, gap, smaller)
        held, reduced = SUCTION, value * length / liquid.surface_tension
    if separation is None:
        gap = way.choose(are_planes, LIKELY_BETWEEN_PLANES * length, gap)
    rows = way.together(gap / length, reduced, length / radius1, angle1, length / radius2, angle2).reshape(-1, 6)
    asked = arrays["separation"] if separation is not None else np.reshape(gap, shape)
    return Problem(rows, held, asked, np.ravel(length), liquid.surface_tension, shape)


def refuse_drained_planes(pair: Pair, named: str) -> None:
    """Refuse to look for a stable bridge between two planes under suction: there is none.

    Examples
    --------
    >>> refuse_drained_planes(Pair(np.inf), "suction")
    Traceback (most recent call last):
        ...
    ValueError: suction: holds no stable bridge between two planes, which dries up or floods the gap; hold a volume, \
or ask bridge(branch='unstable') for the one between the two
    """
    if has_planes(pair):
        raise ValueError(
            f"{named}: holds no stable bridge between two planes, which dries up or floods the gap; hold a volume, "
            "or ask bridge(branch='unstable') for the one between the two"
        )


def _refuse_deep_overlap(separation: Any, smaller_radius: Any, shape: tuple[int, ...], way: _Way) -> None:
    """Refuse an overlap of half the smaller radius or more, which is no contact of grains, and any of two planes."""
    lowest = way.choose(smaller_radius == np.inf, 0.0, -DEEPEST_OVERLAP * smaller_radius)
    is_too_deep = separation <= lowest
    if way.any(is_too_deep):
        i = _first(is_too_deep)
        index = np.unravel_index(i, shape)
        place = str(list(map(int, index))) if index else ""
        if np.ravel(smaller_radius)[i] == np.inf:
            reason = "0; two planes in contact leave no room for liquid"
        else:
            reason = f"{np.ravel(lowest)[i]:.6g}; an overlap may reach half the smaller radius"
        raise ValueError(f"separation{place}: {np.ravel(separation)[i]} m is not > {reason}")


def _refuse_beyond_domain(
    control: Control, value: Any, mean_radius: Any, separation: Any, liquid: Liquid, way: _Way
) -> None:
    """Refuse what the solver was not tried on: it has no meaning for grains either."""
    if control.name == "volume":
        lowest = NARROWEST * np.cbrt(value)
        is_narrow = (mean_radius != mean_radius) & (separation != 0.0) & (separation < lowest)
        if way.any(is_narrow):
            i = _first(is_narrow)
            raise ValueError(
                f"separation: {np.ravel(separation)[i]:.6g} m is not >= {np.ravel(lowest)[i]:.6g}, {NARROWEST:g} of "
                f"the cube root of the volume, where the domain between two planes ends"
            )
        unit, symbol, scale = mean_radius * mean_radius * mean_radius, "m^3", "R³"
        low, high = LEAST_VOLUME, MOST_VOLUME
    else:
        unit, low, high = liquid.surface_tension / mean_radius, -MOST_SUCTION, MOST_SUCTION
        symbol, scale = "Pa", "γ/R"
    is_strange = (value < low * unit) | (value > high * unit)
    if way.any(is_strange):
        i = _first(is_strange)
        asked, unit, mean = (np.ravel(one)[i] for one in (value, unit, mean_radius))
        raise ValueError(
            f"{control.name}: {asked:.6g} {symbol} is not in [{low * unit:.6g}, {high * unit:.6g}] {symbol}, "
            f"{low:g} to {high:g} {scale} with the mean radius R = {mean:.6g} m"
        )


def _first(condition: Any) -> int:
    return int(np.flatnonzero(condition)[0])


def solve(problem: Problem, asked: Asked, limit: Limit = "stability") -> Bridge:
    """Answer all rows."""
    states, statuses = batch.answer(ASKED[asked], problem.held, problem.rows, LIMITS[limit])
    separation = problem.separation if asked in ("stable", "unstable") else None
    return restore(problem, states, statuses, separation)


def trace(problem: Problem, points: int, limit: Limit) -> Bridge:
    """Answer all rows with whole curves, of so many points each."""
    states, statuses = batch.draw(problem.held, problem.rows, points, LIMITS[limit])
    return restore(problem, states, statuses, extra=(points,))


def restore(
    problem: Problem,
    states: Floats,
    statuses: NDArray[np.int8],
    separation: Floats | None = None,
    extra: tuple[int, ...] = (),
) -> Bridge:
    """Turn reduced states into a bridge in SI units, of the shape of the question and the extra axes.

    It has the control that was asked, and the separation if one was, not those that the solver met to the last digits.
    """
    shape = problem.shape + extra
    warn_of_failures(statuses)
    asked: dict[str, Any] = {control_name(problem): control_si(problem)}
    if separation is not None:
        asked["separation"] = separation
    if not shape:
        row, unit = problem.rows[0].tolist(), problem.length.item()
        met = {name: value.item() for name, value in asked.items()}
        return _in_si(State(*states[0].tolist()), row, unit, statuses.item(), met, problem.surface_tension, _ONE)
    if not extra:
        return _restored(problem, states, statuses, separation)
    apart = problem.shape + (1,) * len(extra)
    state = State(*np.moveaxis(states.reshape(*shape, -1), -1, 0))
    rows = np.moveaxis(np.broadcast_to(problem.rows.reshape(*apart, 6), (*shape, 6)), -1, 0)
    units = np.broadcast_to(problem.length.reshape(apart), shape)
    met = {name: value.reshape(apart) for name, value in asked.items()}
    return _in_si(state, rows, units, statuses.reshape(shape), met, problem.surface_tension, _MANY)


def _restored(problem: Problem, states: Floats, statuses: NDArray[np.int8], separation: Floats | None) -> Bridge:
    """The same for an array of single bridges, filled row by row."""
    room = room_for(len(states), None)
    gap = np.array([np.nan]) if separation is None else np.ravel(separation)
    angle1, angle2 = problem.rows[:, 3], problem.rows[:, 5]
    asked = (gap, control_si(problem), problem.length, angle1, angle2, problem.surface_tension)
    restore_rows(room, np.arange(len(states)), problem.held, *asked, states, statuses)
    with np.errstate(divide="ignore"):
        radii = (problem.length / problem.rows[:, column] for column in (2, 4))
        solid_radius = tuple(radius.reshape(problem.shape) for radius in radii)
    return bridge_of(room, problem.shape, (solid_radius[0], solid_radius[1]), problem.surface_tension, None)


def warn_of_failures(statuses: NDArray[np.int8]) -> None:
    """Warn where the solver failed."""
    failed = int(np.count_nonzero(statuses == FAILED))
    if failed:
        warn(f"the solver failed for {failed} of {statuses.size} bridges", ConvergenceWarning)


def _in_si(state: State, row: Any, unit: Any, status: Any, met: dict[str, Any], gamma: float, way: _Way) -> Bridge:
    """Bridge in SI units, of numbers or arrays of a reduced state; ``met`` is what is known to the last digit."""
    exists = status == FOUND
    square = unit * unit
    dry = np.cos(row[3]) * state.wetted_area1 + np.cos(row[5]) * state.wetted_area2
    energy = state.area - dry  # zero for dry and separate solids
    units = way.together(unit, unit)
    with np.errstate(divide="ignore"):
        radii = units / way.together(row[2], row[4])
    sideways = state.sideways_stable == 1.0
    values: dict[str, Any] = {
        "separation": state.separation * unit,
        "suction": gamma * state.curvature / unit,
        "volume": state.volume * square * unit,
        "force": way.choose(
            exists, 2.0 * np.pi * gamma * unit * state.force, way.choose(status == FAILED, np.nan, 0.0)
        ),
        "exists": exists,
        "stable": (state.unstable_directions == 0.0) & sideways,
        "unstable_directions": way.whole(way.choose(exists, state.unstable_directions, 0.0)),
        "sideways_stable": sideways,
        "neck_radius": state.neck_radius * unit,
        "neck_inside": state.neck_inside == 1.0,
        "liquid_gas_area": state.area * square,
        "surface_energy": gamma * energy * square,
        "grand_potential": gamma * (energy + state.curvature * state.volume) * square,
        "stiffness": 2.0 * np.pi * gamma * state.stiffness,
    }
    values |= {name: way.choose(exists, value, np.nan) for name, value in met.items()}
    return Bridge(
        **{name: plain(value) for name, value in values.items()},
        contact_radius=way.together(state.radius1, state.radius2) * units,
        half_filling_angle=way.together(state.filling1, state.filling2),
        wetted_area=way.together(state.wetted_area1, state.wetted_area2) * units * units,
        capillary_tensor=way.together(state.across_tensor, state.axial_tensor) * units * units,
        _meridian=way.together(state.middle_radius * unit, state.middle_slope, state.half_length * unit),
        _solid_radius=radii,
        _surface_tension=gamma,
    )


def control_name(problem: Problem) -> Literal["suction", "volume"]:
    """Name of the quantity that a problem holds."""
    return "volume" if problem.held == VOLUME else "suction"


def derjaguin_radius(problem: Problem) -> Floats:
    """R̄ = 2/(1/R1 + 1/R2), [m]; the rows hold the curvatures of the solids over that of the smaller one."""
    curvatures: Floats = problem.rows[:, 2] + problem.rows[:, 4]
    return 2.0 * problem.length / curvatures


def control_star(problem: Problem) -> Floats:
    """H R̄ or V/R̄³, one a row: what laws and data base are asked with."""
    scale = derjaguin_radius(problem) / problem.length
    held: Floats = problem.rows[:, 1]
    return held / scale**3 if control_name(problem) == "volume" else held * scale


def control_si(problem: Problem) -> Floats:
    """Volume, [m³], or suction, [Pa], one a row."""
    held: Floats = problem.rows[:, 1]
    if control_name(problem) == "volume":
        return held * problem.length**3
    return problem.surface_tension * held / problem.length


def partial_bridge(problem: Problem, separation: Floats, force_star: Any, exists: Bools) -> Bridge:
    """Bridge in SI units with the few fields that a law or a table knows: force and separation at one control.

    They speak of stable bridges only.
    """
    shape, gamma = problem.shape, problem.surface_tension
    known = exists & ~np.isnan(np.asarray(separation))
    fields: dict[str, Any] = {
        "separation": np.where(known, separation, np.nan),
        control_name(problem): np.where(known, control_si(problem), np.nan),
        "force": 2.0 * np.pi * gamma * derjaguin_radius(problem) * np.asarray(force_star),
        "exists": known,
        "stable": known,
        "unstable_directions": np.zeros(known.shape, int),
        "sideways_stable": known,
    }
    empty = np.full(shape, np.nan)
    answer: dict[str, Any] = {field: plain(empty) for field, _, _ in FIELDS}
    answer |= {field: np.full((*shape, 2), np.nan) for field in _PER_SOLID}
    answer |= {field: plain(np.reshape(value, shape)) for field, value in fields.items()}
    answer["neck_inside"] = plain(np.zeros(shape, bool))
    return Bridge(
        **answer,
        _meridian=np.full((*shape, 3), np.nan),
        _solid_radius=np.full((*shape, 2), np.nan),
        _surface_tension=gamma,
    )
