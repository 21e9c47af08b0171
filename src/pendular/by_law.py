"""A public question answered by a published closed form instead of the exact solver."""

import warnings

import numpy as np
from numpy.typing import NDArray

from .laws import Law, force_star, laws, rupture_star
from .problem import Problem, control_name, control_star, derjaguin_radius, partial_bridge
from .result import Bridge

Floats = NDArray[np.float64]


class RangeWarning(UserWarning):
    """A law is asked outside the range that its authors state."""


def bridge_by_law(problem: Problem, name: str) -> Bridge:
    """Force at a separation by a law; what the law does not give is NaN."""
    law, control, solids = _prepare(problem, name, "force")
    mean_radius = derjaguin_radius(problem)
    separation = problem.rows[:, 0] * problem.length
    force = force_star(name, separation / mean_radius, control, *solids)
    _warn_outside(law, {"separation_star": separation / mean_radius, **_variables(law, control, solids)})
    return partial_bridge(problem, separation, force, np.asarray(force) != 0.0)


def rupture_by_law(problem: Problem, name: str) -> Bridge:
    """Rupture distance by a law, and its force there if it gives one."""
    law, control, solids = _prepare(problem, name, "rupture")
    distance = np.asarray(rupture_star(name, control, *solids))
    force = np.full(distance.shape, np.nan)
    if "force" in law.gives:
        force = np.asarray(force_star(name, distance, control, *solids))
    _warn_outside(law, _variables(law, control, solids))
    return partial_bridge(problem, distance * derjaguin_radius(problem), force, ~np.isnan(distance))


def _prepare(problem: Problem, name: str, wanted: str) -> tuple[Law, Floats, tuple[Floats, ...]]:
    """Return the law, its reduced control, and its contact angles and sizes, one value a row."""
    law = laws[name]
    if wanted not in law.gives:
        raise ValueError(f"method: {name!r} gives no {wanted}, only the {' and the '.join(law.gives)}")
    control = control_name(problem)
    if law.control != control:
        raise ValueError(f"method: {name!r} is a law at constant {law.control}, not at constant {control}")
    scale = derjaguin_radius(problem) / problem.length
    k1, theta1, k2, theta2 = problem.rows[:, 2:].T
    return law, control_star(problem), (theta1, theta2, k1 * scale, k2 * scale)


def _variables(law: Law, control: Floats, solids: tuple[Floats, ...]) -> dict[str, Floats]:
    theta1, theta2, kappa1, kappa2 = solids
    with np.errstate(divide="ignore"):
        ratio = np.maximum(kappa1, kappa2) / np.minimum(kappa1, kappa2)
    angles = np.concatenate([theta1, theta2])
    return {f"{law.control}_star": control, "contact_angle": angles, "size_ratio": ratio}


def _warn_outside(law: Law, variables: dict[str, Floats]) -> None:
    """Warn once, naming the first variable that leaves the range stated by the authors."""
    slack = 1e-12  # of an angle of 40° in radians, say
    for name, values in variables.items():
        low, high = law.valid.get(name, (-np.inf, np.inf))
        outside = values[(values < low - slack * abs(low)) | (values > high + slack * abs(high))]
        if outside.size:
            warnings.warn(
                f"{law.name}: {name} {outside[0]:.6g} is outside the published range {low:.6g} to {high:.6g}; "
                f"{law.valid_text}",
                RangeWarning,
                stacklevel=4,
            )
            return
