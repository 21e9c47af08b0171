"""Samples of exact bridges and of the laws, reduced: everything that the figures and the claims look at.

The liquid has a surface tension of 1 and the pairs a Derjaguin radius of 1, so that what the library returns in SI
units is the reduced (starred) quantity of the article. Suctions, angles, ratios and separations broadcast.
"""

from typing import Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pendular import Bridge, Liquid, Pair, bridge, curve, rupture
from pendular.laws import force_star, rupture_star, toroidal2020, zhao2020
from pendular.laws._registry import house_laws

Floats = NDArray[np.float64]

LIQUID = Liquid(surface_tension=1.0)
ANGLES = (0.0, 20.0, 40.0)  # [degrees], those of the article, as are the ratios of the radii and the suctions
RATIOS = (1.0, 2.0, 8.0, 128.0)
SUCTIONS = (1.0, 25.0, 1e3, 1e5)
OURS = tuple(
    law.name for law in house_laws() if law.control == "suction" and law.name not in ("zhao2020", "toroidal2020")
)


def count(points: float, density: float) -> int:
    """Points of a sample that is thinned out, but keeps its two ends and a middle."""
    return max(3, round(points * density))


def decades(low: float, high: float, density: float, per_decade: int = 24) -> Floats:
    """Evenly spaced on a logarithmic axis, ends included."""
    return np.geomspace(low, high, count(per_decade * np.log10(high / low), density) + 1)


def fractions(density: float, end: float = 0.99, points: int = 100) -> Floats:
    """Separations over the rupture distance, from contact to ``end``."""
    return np.linspace(0.0, end, count(points, density) + 1)


def pair_of(degrees: ArrayLike = 0.0, ratio: ArrayLike = 1.0) -> Pair:
    """Spheres of one contact angle, the smaller one first, with a Derjaguin radius of 1."""
    small, large = radii_of(ratio)
    return Pair(radius=(small, large), contact_angle=np.deg2rad(degrees))


def radii_of(ratio: ArrayLike) -> tuple[Floats, Floats]:
    """Radii of the smaller and of the larger sphere."""
    small = np.asarray(0.5 * (1.0 + 1.0 / np.asarray(ratio, float)))
    return small, small * np.asarray(ratio, float)


def state(separation: ArrayLike, degrees: ArrayLike = 0.0, ratio: ArrayLike = 1.0, **control: Any) -> Bridge:
    """Exact bridges; the control and the branch as for `pendular.bridge`."""
    return bridge(pair_of(degrees, ratio), separation, liquid=LIQUID, **control)


def force(separation: ArrayLike, suction: ArrayLike, degrees: ArrayLike = 0.0, ratio: ArrayLike = 1.0) -> Floats:
    """Exact force λ*, on the stable branch."""
    return force_of(state(separation, degrees, ratio, suction=suction))


def force_of(states: Bridge) -> Floats:
    """λ* of bridges."""
    return np.asarray(states.force) / (2.0 * np.pi)


def end_of(degrees: ArrayLike = 0.0, ratio: ArrayLike = 1.0, **control: Any) -> Bridge:
    """Exact bridges at rupture; the control and the limit as for `pendular.rupture`."""
    return rupture(pair_of(degrees, ratio), liquid=LIQUID, **control)


def rupture_distance(suction: ArrayLike, degrees: ArrayLike = 0.0, ratio: ArrayLike = 1.0) -> Floats:
    """Exact 2S*_crit, the whole gap."""
    return np.asarray(end_of(degrees, ratio, suction=suction).separation)


def all_states(degrees: float = 0.0, ratio: float = 1.0, points: int = 201, **control: Any) -> tuple[Bridge, int]:
    """Exact bridges from contact to the fold and down the unstable branch, and the index of the fold."""
    return curve(pair_of(degrees, ratio), points=points, liquid=LIQUID, limit="fold", **control), points // 2


def both_branches(
    part: ArrayLike, degrees: ArrayLike = 0.0, ratio: ArrayLike = 1.0, **control: Any
) -> tuple[Bridge, Bridge]:
    """Bridges of the branch from contact and of the other one, at parts of the fold, at which the article ends both."""
    separation = part * np.asarray(end_of(degrees, ratio, limit="fold", **control).separation)
    stable, unstable = (
        state(separation, degrees, ratio, branch=side, limit="fold", **control) for side in ("stable", "unstable")
    )
    return stable, unstable


def scaled_shape(states: Bridge) -> tuple[Floats, Floats]:
    """P = X_c/Y_c and Q = Y0/Y_c of bridges between equal spheres (Eq. 17)."""
    sagitta = 2.0 * np.sin(0.5 * states.half_filling_angle[..., 0]) ** 2
    contact = states.contact_radius[..., 0]
    return (0.5 * np.asarray(states.separation) + sagitta) / contact, np.asarray(states.neck_radius) / contact


def law_force(
    law: str, separation: ArrayLike, suction: ArrayLike, degrees: ArrayLike = 0.0, ratio: ArrayLike = 1.0
) -> Floats:
    """λ* by a law of the registry: 0 beyond its rupture, NaN outside its domain."""
    angle, (small, large) = np.deg2rad(degrees), radii_of(ratio)
    return force_star(law, separation, suction, angle, angle, 1.0 / small, 1.0 / large)


def law_rupture(law: str, suction: ArrayLike, degrees: ArrayLike = 0.0, ratio: ArrayLike = 1.0) -> Floats:
    """2S*_crit by a law of the registry."""
    angle, (small, large) = np.deg2rad(degrees), radii_of(ratio)
    return rupture_star(law, suction, angle, angle, 1.0 / small, 1.0 / large)


def fitted_force(separation: ArrayLike, rupture: ArrayLike, suction: ArrayLike, degrees: ArrayLike) -> Floats:
    """λ* by Eqs. (26), (30) and (31) with a given rupture distance."""
    return _each(zhao2020.force_star_given_rupture, separation, rupture, suction, np.deg2rad(degrees))


def fitted_neck(suction: ArrayLike, degrees: ArrayLike) -> Floats:
    """Y0* at contact by Eq. (30)."""
    return _each(zhao2020.neck_radius_at_contact, suction, np.deg2rad(degrees))


def neck_of_force(force: Floats, suction: ArrayLike) -> Floats:
    """Y0* of a force λ* = Y0* + H* Y0*²/2 (Eq. 26), the way back."""
    return 2.0 * force / (1.0 + np.sqrt(1.0 + 2.0 * np.asarray(suction) * force))


def quartic(half_gap: ArrayLike, suction: ArrayLike, degrees: ArrayLike) -> Floats:
    """Coefficients K4 ... K0 of Eqs. (24) and (34), on a new last axis."""
    kernel = np.vectorize(toroidal2020.quartic_coefficients, otypes=[float] * 5)
    return np.stack(kernel(half_gap, suction, np.deg2rad(degrees)), axis=-1)


def torus_line(necks: Floats, degrees: float) -> Floats:
    """P(Q) of the torus (Eq. 18)."""
    tangent = np.tan(np.deg2rad(degrees))
    return cast("Floats", (np.hypot(tangent, 1.0) + tangent) * (1.0 - necks))


def beta(kind: Literal["series", "torus", "exact"], degrees: ArrayLike) -> Floats:
    """Coefficient of Eq. (35): of Eq. (36), of the torus without expansion, and the exact one."""
    from pendular.laws.asymptotic_rupture import beta_exact

    kernels = {"series": toroidal2020.beta_series, "torus": toroidal2020.beta_torus, "exact": beta_exact}
    return _each(kernels[kind], np.deg2rad(degrees))


def _each(kernel: Any, *operands: ArrayLike) -> Floats:
    """Evaluate a compiled scalar function on arrays."""
    return np.asarray(np.vectorize(kernel, otypes=[float])(*operands))
