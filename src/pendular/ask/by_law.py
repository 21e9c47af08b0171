"""A public question answered by a published closed form instead of the exact solver.

Of solids that a law does not cover it is not asked. Where its formula says nothing, or no constant suction holds the
bridge of a law at suction, the force is NaN and there is no bridge. A rupture distance depends on what is held: the
bridges of one suction end before any of them reaches the rupture distance of its volume.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ..ground.warn import warn
from ..laws import Law, Quantity, force_star, laws, rupture_star
from ..laws.ranges import Outside, asked_ranges, asked_solids, first_outside, first_uncovered
from .other_control import other_control_star
from .problem import Problem, control_name, control_star, derjaguin_radius, partial_bridge, solve
from .result import Bridge

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


class RangeWarning(UserWarning):
    """A law is asked outside the range that its authors state, or in which it was measured, or says nothing.

    Attributes
    ----------
    outside : Outside or None
        The first variable that leaves its range, its value, and the two ends of the range; None if none does.
    """

    def __init__(self, message: str, outside: Outside | None) -> None:
        super().__init__(message)
        self.outside = outside


def bridge_by_law(problem: Problem, name: str) -> Bridge:
    """Force at a separation by a law; what the law does not give is NaN, and so is a force of which it says nothing."""
    law, solids = _law(name, "force"), _solids(problem)
    _refuse_uncovered(law, "force", solids)
    separation = problem.rows[:, 0] * problem.length
    gap = separation / derjaguin_radius(problem)
    if law.control == control_name(problem):
        control = control_star(problem)
        force = np.asarray(force_star(name, gap, control, *solids))
        is_silent = np.isnan(force)
    else:
        exact = solve(problem, "stable")
        control = other_control_star(problem, exact)
        by_law = np.asarray(force_star(name, gap, control, *solids))
        is_known = np.ravel(exact.exists)
        force = np.where(np.ravel(exact.force) != 0.0, by_law, 0.0)
        is_silent = is_known & np.isnan(by_law)
    asked = {"separation_star": gap, f"{law.control}_star": control}
    _warn_outside(law, "force", asked, solids, is_silent)
    return partial_bridge(problem, separation, force, (force != 0.0) & ~np.isnan(force))


def rupture_by_law(problem: Problem, name: str) -> Bridge:
    """Rupture distance by a law, and its force there if it gives one."""
    law = _law(name, "rupture")
    if law.control != control_name(problem):
        raise ValueError(
            f"method: {name!r} gives the rupture distance at constant {law.control}, not at constant "
            f"{control_name(problem)}"
        )
    solids, control = _solids(problem), control_star(problem)
    _refuse_uncovered(law, "rupture", solids)
    distance = np.asarray(rupture_star(name, control, *solids))
    force = np.full(distance.shape, np.nan)
    if "force" in law.gives:
        force = np.asarray(force_star(name, distance, control, *solids))
    is_silent = np.isnan(distance)
    _warn_outside(law, "rupture", {f"{law.control}_star": control}, solids, is_silent)
    return partial_bridge(problem, distance * derjaguin_radius(problem), force, ~is_silent)


def _law(name: str, wanted: Quantity) -> Law:
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


def _pairs(solids: tuple[Floats, ...]) -> tuple[Floats, Floats, Floats]:
    """Contact angles and size ratio, one a row."""
    theta1, theta2, kappa1, kappa2 = solids
    with np.errstate(divide="ignore"):
        return theta1, theta2, np.maximum(kappa1, kappa2) / np.minimum(kappa1, kappa2)


def _refuse_uncovered(law: Law, quantity: Quantity, solids: tuple[Floats, ...]) -> None:
    """Refuse solids of which the law does not speak."""
    uncovered = first_uncovered(law, quantity, *_pairs(solids))
    if uncovered is not None:
        argument, value, rule = uncovered
        raise ValueError(f"{argument}: {value} is not covered by {law.name!r}; its {quantity} is for {rule}")


def _warn_outside(
    law: Law, quantity: Quantity, asked: Mapping[str, Floats], solids: tuple[Floats, ...], is_silent: Bools
) -> None:
    """Warn once, naming the first variable that leaves the range of the law, and of how much it says nothing."""
    variables = {**asked, **asked_solids(law, quantity, *_pairs(solids))}
    outside = first_outside(asked_ranges(law), variables)
    told = []
    if outside is not None:
        variable, value, low, high = outside
        told.append(f"{variable} {value:.6g} is outside the range {low:.6g} to {high:.6g} of the law")
    if is_silent.any():
        told.append(f"it says nothing of {np.count_nonzero(is_silent)} out of {is_silent.size} bridges")
    if not told:
        return
    told.append(law.valid_text)
    if np.any(variables["size_ratio"] != 1.0):
        told.append(f"two sizes: {law.solids[quantity].size_words}")
    if np.any(variables["angle_difference"] != 0.0):
        told.append(f"two angles: {law.solids[quantity].angle_words}")
    warn(RangeWarning(f"{law.name}: {'; '.join(told)}", outside))
