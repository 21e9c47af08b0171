"""A public question answered by a published closed form instead of the exact solver.

A law belongs to one control, but a force at a separation does not depend on what is held: under the other control the
exact solver turns the given suction into the volume of the bridge, or the volume into its suction, and the law is asked
with that. A rupture distance does depend on it. The bridges of one suction end before any of them reaches the rupture
distance of its volume; those of one volume pass the rupture distance of their suction and stay stable, but from there
on no law at constant suction speaks of them.
"""

import numpy as np
from numpy.typing import NDArray

from ._warn import warn
from .exact.equations import SUCTION
from .laws import Law, force_star, laws, rupture_star
from .laws.ranges import Outside, first_outside
from .problem import Problem, control_name, control_star, derjaguin_radius, partial_bridge, solve
from .result import Bridge

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


class RangeWarning(UserWarning):
    """A law is asked outside the range that its authors state, or in which it was measured.

    Attributes
    ----------
    outside : Outside
        The first variable that leaves its range, its value, and the two ends of the range.
    """

    def __init__(self, message: str, outside: Outside) -> None:
        super().__init__(message)
        self.outside = outside


def bridge_by_law(problem: Problem, name: str) -> Bridge:
    """Force at a separation by a law; what the law does not give is NaN."""
    law = _law(name, "force")
    solids = _solids(problem)
    mean_radius = derjaguin_radius(problem)
    separation = problem.rows[:, 0] * problem.length
    if law.control == control_name(problem):
        control = control_star(problem)
        force = np.asarray(force_star(name, separation / mean_radius, control, *solids))
        exists = force != 0.0
    else:
        control, exists, failed = _other_control(problem)
        by_law = np.asarray(force_star(name, separation / mean_radius, control, *solids))
        force = np.where(exists | failed, by_law, 0.0)
    _warn_outside(law, {"separation_star": separation / mean_radius, **_variables(law, control, solids)})
    return partial_bridge(problem, separation, force, exists)


def rupture_by_law(problem: Problem, name: str) -> Bridge:
    """Rupture distance by a law, and its force there if it gives one."""
    law = _law(name, "rupture")
    if law.control != control_name(problem):
        raise ValueError(
            f"method: {name!r} gives the rupture distance at constant {law.control}, not at constant "
            f"{control_name(problem)}"
        )
    solids, control = _solids(problem), control_star(problem)
    distance = np.asarray(rupture_star(name, control, *solids))
    force = np.full(distance.shape, np.nan)
    if "force" in law.gives:
        force = np.asarray(force_star(name, distance, control, *solids))
    _warn_outside(law, _variables(law, control, solids))
    return partial_bridge(problem, distance * derjaguin_radius(problem), force, ~np.isnan(distance))


def _law(name: str, wanted: str) -> Law:
    """Return a law that gives what is wanted."""
    law = laws[name]
    if wanted not in law.gives:
        given = " and the ".join(law.gives).replace("_", " ")
        raise ValueError(f"method: {name!r} gives no {wanted}, only the {given}")
    return law


def _solids(problem: Problem) -> tuple[Floats, ...]:
    """Contact angles and κ of both solids, one value a row."""
    scale = derjaguin_radius(problem) / problem.length
    k1, theta1, k2, theta2 = problem.rows[:, 2:].T
    return theta1, theta2, k1 * scale, k2 * scale


def _other_control(problem: Problem) -> tuple[Floats, Bools, Bools]:
    """Reduced volume of the exact bridges at given suction, or suction at given volume; which exist, which failed."""
    exact = solve(problem, "stable")
    if control_name(problem) == "suction":
        control = np.ravel(exact.volume) / derjaguin_radius(problem) ** 3
    else:
        control = _suction_star(problem, exact)
    return control, np.ravel(exact.exists), np.isnan(np.ravel(exact.force))


def _suction_star(problem: Problem, exact: Bridge) -> Floats:
    """Reduced suction of bridges of given volume; NaN where it would not hold them, since they are beyond its fold."""
    reduced = np.ravel(exact.suction) * problem.length / problem.surface_tension
    is_suction = reduced > 0.0
    rows = problem.rows.copy()
    rows[:, 1] = np.where(is_suction, reduced, 1.0)
    drained = solve(problem._replace(rows=rows, held=SUCTION), "stable")
    is_same = is_suction & np.isclose(np.ravel(drained.force), np.ravel(exact.force), rtol=1e-6, atol=0.0)
    suction: Floats = np.where(is_same | ~is_suction, reduced, np.nan) * derjaguin_radius(problem) / problem.length
    return suction


def _variables(law: Law, control: Floats, solids: tuple[Floats, ...]) -> dict[str, Floats]:
    theta1, theta2, kappa1, kappa2 = solids
    with np.errstate(divide="ignore"):
        ratio = np.maximum(kappa1, kappa2) / np.minimum(kappa1, kappa2)
    angles = np.concatenate([theta1, theta2])
    return {f"{law.control}_star": control, "contact_angle": angles, "size_ratio": ratio}


def _warn_outside(law: Law, variables: dict[str, Floats]) -> None:
    """Warn once, naming the first variable that leaves the range of the law."""
    outside = first_outside(law.valid, variables)
    if outside is not None:
        told = (
            f"{law.name}: {outside.name} {outside.value:.6g} is outside the range {outside.low:.6g} to "
            f"{outside.high:.6g} of the law; {law.valid_text}"
        )
        warn(RangeWarning(told, outside))
