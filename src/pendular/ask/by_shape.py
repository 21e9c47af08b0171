"""A public question about solids of which one is neither a sphere nor a plane, answered one by one."""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..exact.batch import FAILED, FOUND, NO_BRIDGE
from ..exact.equations import SUCTION, VOLUME
from ..exact.shapes.answers import SPILLED
from ..exact.shapes.pieces import is_flat, solid_from
from ..exact.shapes.rows import COLUMNS, answer, draw
from ..exact.solids.surface import NO_PROFILE, SPHERE, Profile
from ..exact.state import State
from ..ground.check import broadcast, in_range, plain, quantity
from ..ground.warn import warn
from .domain import length_between
from .liquid import Liquid
from .pair import Pair
from .problem import ASKED, LIMITS, Asked, Control, ConvergenceWarning, Limit, Problem, restore
from .result import Bridge
from .shapes import Shape, Told

Floats = NDArray[np.float64]
Statuses = NDArray[np.int8]


def bridge_by_shape(
    pair: Pair, control: Control, liquid: Liquid, separation: ArrayLike | None, asked: Asked, limit: Limit
) -> Bridge:
    """Bridges at separations, or the ends of branches."""
    if separation is None and asked in ("stable", "unstable"):
        raise ValueError("separation: None given; a separation is needed")
    problem, questions = _reduced(pair, control, liquid, separation)
    answers = answer(ASKED[asked], problem.held, questions, _profiles_of(pair), LIMITS[limit])
    given = problem.separation if asked in ("stable", "unstable") else None
    return _restored(pair, problem, *answers, given)


def curve_by_shape(pair: Pair, control: Control, liquid: Liquid, points: int, limit: Limit) -> Bridge:
    """Whole curves, of so many points each."""
    problem, questions = _reduced(pair, control, liquid, None)
    states, statuses = draw(problem.held, questions, _profiles_of(pair), points, LIMITS[limit])
    return _restored(pair, problem, states.reshape(-1, len(State._fields)), np.ravel(statuses), None, (points,))


def _profiles_of(pair: Pair) -> tuple[Profile, Profile]:
    first, second = (solid.profile if isinstance(solid, Shape) else NO_PROFILE for solid in pair.solids)
    return first, second


def _reduced(pair: Pair, control: Control, liquid: Liquid, separation: ArrayLike | None) -> tuple[Problem, Floats]:
    """Rows of a problem in a unit of length each, and what is asked of the solver."""
    given = {} if separation is None else {"separation": quantity("separation", separation, "m")}
    given[control.name] = control.value
    given |= {f"radius[{i}]": solid for i, solid in enumerate(pair.solids) if not isinstance(solid, Shape)}
    given |= {f"contact_angle[{i}]": angle for i, angle in enumerate(pair.contact_angles)}
    arrays = dict(zip(given, broadcast(**given), strict=True))
    shape = arrays[control.name].shape
    columns = {name: np.ravel(array) for name, array in arrays.items()}
    value = columns[control.name]
    gap = columns.get("separation", np.full(value.size, np.nan))
    told = [
        solid.told if isinstance(solid, Shape) else Told(SPHERE, columns[f"radius[{i}]"], 0.0)
        for i, solid in enumerate(pair.solids)
    ]
    if separation is not None:
        _refuse_overlap(
            arrays["separation"], [np.reshape(_is_flat(one), shape if np.ndim(one.size) else ()) for one in told]
        )
    held = VOLUME if control.name == "volume" else SUCTION
    sizes = [solid.size if isinstance(solid, Shape) else one.size for solid, one in zip(pair.solids, told, strict=True)]
    size = np.broadcast_to(_smaller(*sizes), value.shape)
    asking = zip(value.tolist(), size.tolist(), gap.tolist(), strict=True)
    tension = liquid.surface_tension
    unit = np.array([length_between(held, value, tension, size, gap) for value, size, gap in asking])
    with np.errstate(divide="ignore", over="ignore"):
        reduced = value / unit**3 if held == VOLUME else value * unit / tension
    angles = [columns[f"contact_angle[{i}]"] for i in (0, 1)]
    rows, questions = np.empty((value.size, 6)), np.empty((value.size, COLUMNS))
    both = [column for one, angle in zip(told, angles, strict=True) for column in _columns(one, unit, angle)]
    for i, column in enumerate((gap / unit, reduced, size / unit, *both)):
        questions[:, i] = column
    curvatures = [
        np.nan if isinstance(solid, Shape) else unit / one.size for solid, one in zip(pair.solids, told, strict=True)
    ]
    for i, column in enumerate((gap / unit, reduced, curvatures[0], angles[0], curvatures[1], angles[1])):
        rows[:, i] = column
    asked = arrays["separation"] if separation is not None else np.full(shape, np.nan)
    return Problem(rows, held, asked, unit, tension, shape), questions


def _columns(told: Told, unit: Floats, angle: Floats) -> tuple[float, Floats, float, Floats]:
    """A solid in rows of questions."""
    return float(told.kind), told.size / unit, told.half_angle, angle


def _smaller(first: ArrayLike, second: ArrayLike) -> Floats:
    """The smaller of the lengths of two solids, [m]; NaN if they have none."""
    smaller: Floats = np.fmin(*(np.where(np.isinf(size), np.nan, size) for size in (first, second)))
    return smaller


def _is_flat(told: Told) -> NDArray[np.bool_]:
    """Whether a solid has a flat end."""
    return np.isinf(told.size) if told.kind == SPHERE else np.array(is_flat(solid_from(*told, 0.0, NO_PROFILE)))


def _refuse_overlap(separation: Floats, flat: list[NDArray[np.bool_]]) -> None:
    apart = np.where(flat[0] & flat[1], separation, 1.0)
    reason = "two flat ends in contact leave no room for liquid"
    in_range("separation", apart, 0.0, brackets="()", unit="m", low_hint=reason)
    in_range("separation", separation, 0.0, brackets="[)", unit="m")


def _restored(
    pair: Pair,
    problem: Problem,
    states: Floats,
    statuses: Statuses,
    separation: Floats | None,
    extra: tuple[int, ...] = (),
) -> Bridge:
    """The answers as a bridge in SI units."""
    _warn_where(
        statuses == SPILLED, "would run over the edge of a disc, or beyond the end of a profile, which is not answered"
    )
    _warn_where(statuses == FAILED, "were neither found nor excluded")
    is_known = (statuses == FOUND) | (statuses == NO_BRIDGE)
    shapes = [solid if isinstance(solid, Shape) else None for solid in pair.solids]
    bridge = restore(problem, states, np.where(is_known, statuses, NO_BRIDGE).astype(np.int8), separation, extra)
    force = np.where(is_known.reshape(np.shape(bridge.force)), bridge.force, np.nan)
    return replace(bridge, force=plain(force), _shapes=(shapes[0], shapes[1]))


def _warn_where(condition: NDArray[np.bool_], what: str) -> None:
    count = int(np.count_nonzero(condition))
    if count:
        warn(f"{count} of {condition.size} bridges {what}", ConvergenceWarning)
