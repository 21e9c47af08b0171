"""A public question about solids of which one is neither a sphere nor a plane, answered one by one."""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..exact.batch import FAILED, FOUND, NO_BRIDGE
from ..exact.equations import SUCTION, VOLUME
from ..exact.shapes.answers import SPILLED, Answer, answer_to, curve_of
from ..exact.shapes.pieces import Body, body_of_sphere, is_flat
from ..exact.shapes.search import Question
from ..exact.state import State
from ..ground.check import broadcast, in_range, plain, quantity
from ..ground.warn import warn
from .liquid import Liquid
from .pair import Pair
from .problem import ASKED, LIMITS, Asked, Control, ConvergenceWarning, Limit, Problem, restore
from .result import Bridge
from .shapes import Shape

Floats = NDArray[np.float64]

_NOTHING = np.full(len(State._fields), np.nan)


def bridge_by_shape(
    pair: Pair, control: Control, liquid: Liquid, separation: ArrayLike | None, asked: Asked, limit: Limit
) -> Bridge:
    """Bridges at separations, or the ends of branches."""
    if separation is None and asked in ("stable", "unstable"):
        raise ValueError("separation: None given; a separation is needed")
    problem, questions = _reduced(pair, control, liquid, separation)
    answers = [
        answer_to(question, ASKED[asked], float(gap), LIMITS[limit])
        for question, gap in zip(questions, problem.rows[:, 0], strict=True)
    ]
    given = problem.separation if asked in ("stable", "unstable") else None
    return _restored(pair, problem, answers, given)


def curve_by_shape(pair: Pair, control: Control, liquid: Liquid, points: int, limit: Limit) -> Bridge:
    """Whole curves, of so many points each."""
    problem, questions = _reduced(pair, control, liquid, None)
    answers = [answer for question in questions for answer in curve_of(question, LIMITS[limit], points)]
    return _restored(pair, problem, answers, None, (points,))


def _reduced(
    pair: Pair, control: Control, liquid: Liquid, separation: ArrayLike | None
) -> tuple[Problem, list[Question]]:
    """Rows of a problem in a unit of length each, and what is asked of the solver."""
    given = {} if separation is None else {"separation": quantity("separation", separation, "m")}
    given[control.name] = control.value
    given |= {f"radius[{i}]": solid for i, solid in enumerate(pair.solids) if not isinstance(solid, Shape)}
    given |= {f"contact_angle[{i}]": angle for i, angle in enumerate(pair.contact_angles)}
    arrays = dict(zip(given, broadcast(**given), strict=True))
    shape = arrays[control.name].shape
    columns = {name: np.ravel(array).tolist() for name, array in arrays.items()}
    count = len(columns[control.name])
    held = VOLUME if control.name == "volume" else SUCTION
    rows, units, questions = np.empty((count, 6)), np.empty(count), []
    for i in range(count):
        gap, value = columns["separation"][i] if separation is not None else np.nan, columns[control.name][i]
        solids = [s if isinstance(s, Shape) else columns[f"radius[{k}]"][i] for k, s in enumerate(pair.solids)]
        angles = [columns[f"contact_angle[{k}]"][i] for k in (0, 1)]
        size = _size(solids)
        unit = _unit(held, value, liquid.surface_tension, size, gap)
        bodies = [_body(solid, unit, angle) for solid, angle in zip(solids, angles, strict=True)]
        if separation is not None:
            _refuse_overlap(gap, bodies)
        reduced = value / unit**3 if held == VOLUME else value * unit / liquid.surface_tension
        curvatures = [np.nan if isinstance(solid, Shape) else unit / solid for solid in solids]
        rows[i] = gap / unit, reduced, curvatures[0], angles[0], curvatures[1], angles[1]
        units[i] = unit
        kept = reduced / np.pi if held == VOLUME else reduced
        questions.append(Question(bodies[0], bodies[1], held, kept, size / unit))
    asked = arrays["separation"] if separation is not None else np.full(shape, np.nan)
    return Problem(rows, held, asked, units, liquid.surface_tension, shape), questions


def _size(solids: list[Shape | float]) -> float:
    """The smaller of the lengths of two solids, [m]; NaN if they have none."""
    sizes = [solid.size if isinstance(solid, Shape) else solid for solid in solids]
    return min((size for size in sizes if 0.0 < size < np.inf), default=np.nan)


def _unit(held: int, value: float, tension: float, size: float, separation: float) -> float:
    """Unit of length: of a volume its cube root, of a pressure the radius of curvature, else what there is."""
    if held == VOLUME:
        return float(np.cbrt(value))
    lengths = [tension / abs(value) if value != 0.0 else np.nan, size, separation]
    return next((length for length in lengths if length > 0.0), 1.0)


def _body(solid: Shape | float, unit: float, angle: float) -> Body:
    return solid.body(unit, angle) if isinstance(solid, Shape) else body_of_sphere(solid / unit, angle)


def _refuse_overlap(separation: float, bodies: list[Body]) -> None:
    if all(map(is_flat, bodies)):
        reason = "two flat ends in contact leave no room for liquid"
        in_range("separation", np.asarray(separation), 0.0, brackets="()", unit="m", low_hint=reason)
    in_range("separation", np.asarray(separation), 0.0, brackets="[)", unit="m")


def _restored(
    pair: Pair, problem: Problem, answers: list[Answer], separation: Floats | None, extra: tuple[int, ...] = ()
) -> Bridge:
    """The answers as a bridge in SI units."""
    states = np.array([_NOTHING if answer.state is None else answer.state for answer in answers])
    statuses = np.array([answer.status for answer in answers], np.int8)
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
