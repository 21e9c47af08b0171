"""A path of separations, suctions or volumes, along which contact lines are free, pinned, or stick and slide."""

import math
from dataclasses import fields, replace
from typing import Any, Literal, NamedTuple, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.liquid import Liquid
from ..ask.pair import Pair, PerSolid, check_pair, has_planes
from ..ask.problem import Problem, control_name, control_of, reduce, refuse_drained_planes, restore
from ..ask.result import Bridge
from ..exact import batch
from ..exact.batch import FOUND
from ..exact.equations import SUCTION, VOLUME
from ..exact.path import ARRIVED, CLOSES, FOLD, LOST, PITCHFORK, TOUCHES, UNSTABLE, Walked, walk_paths
from ..exact.state import UNSTABLE_DIRECTIONS, State
from ..ground.check import angle, one_of, plain, quantity
from .result import MODES, BridgePath

__all__ = ["path"]

Floats = NDArray[np.float64]
ContactLine = Literal["wetting", "pinned", "hysteresis"]

_LINES = ("wetting", "pinned", "hysteresis")
_ENDINGS = {
    ARRIVED: "",
    FOLD: "no equilibrium is left beyond",
    PITCHFORK: "the liquid slides to one solid",
    UNSTABLE: "a line that begins to slide does not come to rest",
    CLOSES: "a contact circle closes",
    TOUCHES: "the meniscus touches a solid",
    LOST: "the solver lost it",
}


class _Angles(NamedTuple):
    """Angles of both solids, [rad]: with which the path starts, and at which lines slide."""

    starting: tuple[float, float]
    advancing: tuple[float, float]
    receding: tuple[float, float]


def path(
    pair: Pair,
    separation: ArrayLike,
    *,
    suction: ArrayLike | None = None,
    volume: ArrayLike | None = None,
    humidity: ArrayLike | None = None,
    contact_line: ContactLine = "wetting",
    advancing_angle: PerSolid | None = None,
    receding_angle: PerSolid | None = None,
    liquid: Liquid,
) -> BridgePath:
    r"""Bridge along a path of separations, suctions or volumes, whose contact lines may stick and slide.

    A line that is pinned on a circle of radius r stays there while its angle lies between the receding and the
    advancing angle; at one of them it slides, inwards or outwards:

    .. math:: Y = r, \quad \theta_r \le \theta \le \theta_a; \qquad \theta = \theta_a, \ \dot r \ge 0; \qquad
              \theta = \theta_r, \ \dot r \le 0 .

    Parameters
    ----------
    pair : Pair
        The solids, one pair. Its contact angles are those of the bridge at the first step, and those that count in the
        surface energy. A bridge that has just spread or condensed has its advancing angles.
    separation : array_like
        D of each step, in order, [m]; or one for all.
    suction, volume, humidity : array_like
        What is held at each step, exactly one of the three, as for :func:`bridge`; or one value for all. From step to
        step both go in proportion; the suction does where a humidity is given.
    contact_line : {"wetting", "pinned", "hysteresis"}
        ``"wetting"``: lines move freely at the contact angles of the pair. ``"pinned"``: lines stay where they are at
        the first step; one that is drawn to 0, or pushed to 180°, moves on at that angle, as no meniscus could leave
        the solid. ``"hysteresis"``: lines slide at the angles that follow.
    advancing_angle, receding_angle : array_like or tuple of two
        [rad], in [0, π), for hysteresis; a tuple gives the two solids apart.
    liquid : Liquid
        As for :func:`bridge`. Of two immiscible liquids the tension and the angles are yours to give; no density is
        needed.

    Returns
    -------
    BridgePath
        One state a step.

    Raises
    ------
    ValueError
        For bad input, and where no stable bridge holds at the first step. Between two planes under suction that is the
        bridge of ``branch="unstable"``, which is stable while its lines are held.

    Warns
    -----
    ConvergenceWarning
        Where the solver lost the path; fields are NaN from there on.

    Notes
    -----
    **Validity.** Quasi-static, no gravity. The path is exact between the steps, too: where a line begins to slide or
    stops, and where the bridge breaks, is found and not stepped over. A path ends where no equilibrium follows; what
    the liquid does then is not told. Two mirror images stay so until the symmetric motion of both lines is unstable;
    then the first line slides and the second stays.

    The dissipated work depends on the angles of the pair, but not that of a closed loop,
    :math:`\gamma\sum(\cos\theta_r - \cos\theta_a)\,\Delta A` with the area ΔA that a line wets and leaves again.

    Examples
    --------
    >>> grains = Pair(radius=50e-6, contact_angle=np.deg2rad(60))
    >>> gaps = np.concatenate([np.linspace(5e-6, 1e-6, 5), np.linspace(1.2e-6, 5e-6, 5)])
    >>> loop = path(grains, gaps, volume=1e-15, contact_line="hysteresis", advancing_angle=np.deg2rad(60),
    ...     receding_angle=np.deg2rad(30), liquid=Liquid(surface_tension=0.0728))
    >>> loop.line[3:7, 0].tolist()
    ['advancing', 'advancing', 'pinned', 'receding']
    >>> print(f"{loop.force[0]:.3e} N on the way in, {loop.force[-1]:.3e} N on the way out")
    3.169e-06 N on the way in, 4.580e-06 N on the way out
    """
    check_pair(pair)
    one_of("contact_line", contact_line, _LINES)
    angles = _angles_of(pair, contact_line, advancing_angle, receding_angle)
    control = control_of(suction, volume, humidity, liquid)
    if contact_line == "wetting" and control.name == "suction":
        refuse_drained_planes(pair, "suction" if humidity is None else "humidity")
    problem = reduce(pair, control, liquid, quantity("separation", separation, "m"))
    if len(problem.shape) != 1 or problem.shape[0] < 2:
        raise ValueError(
            f"separation: a path has two or more steps along one axis, not the shape {problem.shape}; "
            "give a list of separations, or of what is held"
        )
    problem = _in_one_unit(problem)
    start = _first_step(problem, pair)
    turn = start.curvature * start.half_length
    meridian = [math.log(start.middle_radius), start.middle_slope, math.log(start.half_length), turn]
    both = [*_of_solid(problem, angles, 0), *_of_solid(problem, angles, 1)]
    paths = walk_paths(problem.held, np.array([both]), problem.rows[None, :, :2], np.array([meridian]))
    walked = Walked(*(part[0] for part in paths))
    if walked.states[0, UNSTABLE_DIRECTIONS] > 0.0:
        _refuse_start(problem)
    return _path_of(problem, walked)


def _angles_of(pair: Pair, contact_line: ContactLine, advancing: PerSolid | None, receding: PerSolid | None) -> _Angles:
    """Angles at which the lines start and slide, checked."""
    if any(np.ndim(value) for value in (*pair.radii, *pair.contact_angles)):
        raise ValueError("pair: a path is that of one pair; arrays of radii or angles are not possible")
    start = tuple(float(value) for value in pair.contact_angles)
    starting = (start[0], start[1])
    given = {"advancing_angle": advancing, "receding_angle": receding}
    if contact_line != "hysteresis":
        for name, value in given.items():
            if value is not None:
                raise ValueError(f"{name}: has no effect with contact_line {contact_line!r}; 'hysteresis' heeds it")
        if contact_line == "wetting":
            return _Angles(starting, starting, starting)
        return _Angles(starting, (math.pi, math.pi), (0.0, 0.0))
    missing = [name for name, value in given.items() if value is None]
    if missing:
        raise ValueError(f"{missing[0]}: missing; contact_line 'hysteresis' needs advancing_angle and receding_angle")
    outer, inner = (_of_both(name, value) for name, value in given.items())
    for solid in (0, 1):
        low, high, angle_there = inner[solid], outer[solid], starting[solid]
        if low > high:
            raise ValueError(f"receding_angle[{solid}]: {_shown(low)} is not <= {_shown(high)}, the advancing angle")
        if not low <= angle_there <= high:
            raise ValueError(
                f"contact_angle[{solid}]: {_shown(angle_there)}, with which the path starts, is not between the "
                f"receding angle, {_shown(low)}, and the advancing one, {_shown(high)}"
            )
    return _Angles(starting, outer, inner)


def _shown(radians: float) -> str:
    return f"{radians:.6g} rad ({math.degrees(radians):.4g}°)"


def _of_both(name: str, value: Any) -> tuple[float, float]:
    """One angle for both solids, or a tuple of two."""
    several = value if isinstance(value, tuple) else (value, value)
    if len(several) != 2:
        raise ValueError(f"{name}: a tuple of {len(several)} is not a pair (first solid, second solid)")
    both = [angle(f"{name}[{solid}]" if isinstance(value, tuple) else name, one) for solid, one in enumerate(several)]
    if any(one.ndim for one in both):
        raise ValueError(f"{name}: a path has one angle a solid; arrays are not possible")
    return float(both[0]), float(both[1])


def _in_one_unit(problem: Problem) -> Problem:
    """The problem with the unit of length of its first step; that of two planes changes with what is held."""
    ratio = problem.length / problem.length[:1]
    rows = problem.rows.copy()
    rows[:, 0] *= ratio
    rows[:, 1] *= ratio**3 if problem.held == VOLUME else 1.0 / ratio
    rows[:, [2, 4]] /= ratio[:, None]
    return problem._replace(rows=rows, length=np.full(len(rows), problem.length[0]))


def _first_step(problem: Problem, pair: Pair) -> State:
    """The bridge that the path starts with.

    Between two planes under suction it is the nucleus, which is stable while its lines are held.
    """
    asked = batch.UNSTABLE if problem.held == SUCTION and has_planes(pair) else batch.STABLE
    states, statuses = batch.answer(asked, problem.held, problem.rows[:1])
    if statuses[0] != FOUND:
        _refuse_start(problem)
    return State(*states[0].tolist())


def _refuse_start(problem: Problem) -> NoReturn:
    raise ValueError(
        f"separation[0]: {problem.separation[0]:.6g} m is where the path starts, and no stable bridge holds there"
    )


def _of_solid(problem: Problem, angles: _Angles, solid: int) -> tuple[float, float, float, float]:
    """Curvature of a solid, and its three angles."""
    curvature = float(problem.rows[0, 2 + 2 * solid])
    return curvature, angles.starting[solid], angles.advancing[solid], angles.receding[solid]


def _as_it_broke(problem: Problem, state: Floats) -> Problem:
    """The question that the bridge answers as it breaks."""
    now = State(*state.tolist())
    row = problem.rows[0].copy()
    row[0], row[1] = now.separation, now.volume if problem.held == VOLUME else now.curvature
    place = np.asarray(now.separation * problem.length[0])
    return problem._replace(rows=row[None], separation=place, length=problem.length[:1], shape=())


def _path_of(problem: Problem, walked: Walked) -> BridgePath:
    """The record of a path, in SI units."""
    event = int(walked.end[0])
    steps = _recorded(problem, walked.states[:-1], walked.told[:-1], walked.statuses)
    first = float(np.ravel(steps.surface_energy)[0])
    rupture = None
    if not math.isnan(walked.states[-1, 0]):
        broken = _as_it_broke(problem, walked.states[-1])
        rupture = _counted(_recorded(broken, walked.states[-1:], walked.told[-1:], np.array([FOUND], np.int8)), first)
    return replace(_counted(steps, first), rupture=rupture, ending=_ENDINGS[event])


def _recorded(problem: Problem, states: Floats, told: Floats, statuses: NDArray[np.int8]) -> BridgePath:
    """Bridges and what their lines do, with no work yet."""
    bridges = restore(problem, states, statuses, problem.separation)
    shape, square = problem.shape, problem.surface_tension * float(problem.length[0]) ** 2
    modes = np.where(np.isnan(told[:, 2:4]), len(MODES), told[:, 2:4]).astype(int)
    dissipated = plain(np.reshape(square * (told[:, 4] + told[:, 5]), shape))
    return BridgePath(
        **{field.name: getattr(bridges, field.name) for field in fields(Bridge)},
        contact_angle=told[:, :2].reshape(*shape, 2),
        line=np.array([*MODES, ""])[modes].reshape(*shape, 2),
        work=dissipated,
        dissipated=dissipated,
        control=control_name(problem),
        rupture=None,
        ending="",
    )


def _counted(bridges: BridgePath, first: float) -> BridgePath:
    """The same with the work since the surface energy was that of the first step."""
    return replace(bridges, work=bridges.surface_energy - first + bridges.dissipated)
