r"""Bridges at large suction, expanded without a fitted number, for any two solids.

In this file :math:`H` is the suction and :math:`\lambda` the force, reduced by the Derjaguin radius. On side
:math:`i` the liquid meets the solid of curvature :math:`\kappa_i` at the half-filling angle :math:`\delta_i`, where
the slope angle of the meridian, counted from the neck, is :math:`\varphi_i = \pi/2 - \delta_i - \theta_i`.

The axial length of the meridian from its neck to the contact is exactly

.. math:: H X = \sin\varphi - \int_0^{\varphi} \frac{\cos^2 u}{r(u)}\, du, \qquad
    r(u)^2 = r^2 + \cos^2 u - \cos^2\varphi, \qquad r = H Y + \cos\varphi .

At large suction :math:`r \gg 1`; the law keeps two terms of the expansion of :math:`1/r(u)` about the contact. Contact
and force are exact, so the two sides, which share the force, need not be alike.
"""

import math

from ..ground.compile import kernel
from ._record import ANY_SOLIDS, Law
from ._symbols import ANSWERS, CONTACT_ANGLE, SEPARATION, SIZE_RATIO, SUCTION, Variable
from .contact_circle import contact_at, force_rate, wetted_arc_of

__all__ = ["LAW", "force_star", "gap", "moments", "rupture_star"]

_MAX_STEPS = 100


@kernel
def moments(slope_angle: float) -> tuple[float, float]:
    r"""Coefficients of 1/r and 1/r³ in the length of a meridian.

    .. math::

        A(\varphi) &= \int_0^\varphi \cos^2 u\, du = (\varphi + \sin\varphi \cos\varphi)/2 \\
        B(\varphi) &= \frac12 \int_0^\varphi \cos^2 u\, (\cos^2 u - \cos^2\varphi)\, du

    >>> moments(0.5 * math.pi) == (math.pi / 4.0, 3.0 / 32.0 * math.pi)
    True
    """
    s, c = math.sin(slope_angle), math.cos(slope_angle)
    a = 0.5 * (slope_angle + s * c)
    # ∫cos⁴ = (cos³ sin + 3 A)/4
    return a, 0.125 * s * c**3 + (0.375 - 0.5 * c * c) * a


@kernel
def _half_gap(force_star: float, suction_star: float, contact_angle: float, kappa: float) -> tuple[float, float]:
    """H times the distance from the neck to the solid, and its derivative by the force."""
    arc = wetted_arc_of(force_star, suction_star, kappa, contact_angle)
    circle = contact_at(arc, kappa, contact_angle)
    phi = 0.5 * math.pi - kappa * arc - contact_angle
    s, c = circle.sin_slope, circle.cos_slope
    a, b = moments(phi)
    r = suction_star * circle.radius + c
    length = s - a / r + b / (r * r * r)

    # By the wetted arc: dφ = -κ, dY = cos δ, d(sagitta) = κY; dA = cos²φ dφ, dB = A sin φ cos φ dφ.
    d_r = suction_star * circle.cos_filling + s * kappa
    d_length = (a * c * s / (r * r * r) - c * c / r + c) * -kappa + (a - 3.0 * b / (r * r)) / (r * r) * d_r
    d_product = d_length - suction_star * kappa * circle.radius
    rate = force_rate(circle, suction_star, kappa)
    if abs(rate) <= 1e-15 * (1.0 + suction_star):  # the force is the largest that the solid can hold
        return math.nan, math.nan
    return length - suction_star * circle.sagitta, d_product / rate


@kernel
def gap(
    force_star: float, suction_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> tuple[float, float]:
    r"""Suction times gap of the bridge with a given force, and its derivative by the force.

    .. math:: H D = \sum_i \left[ \sin\varphi_i - \frac{A(\varphi_i)}{r_i} + \frac{B(\varphi_i)}{r_i^3}
        - \frac{H}{\kappa_i} (1 - \cos\delta_i) \right]

    NaN where the force exceeds what the solids can hold.

    >>> product, slope = gap(0.5, 1e4, 0.0, 0.0, 1.0, 1.0)
    >>> f"{product:.4f} {slope:.4f}"
    '0.9844 -1.9842'
    """
    product1, slope1 = _half_gap(force_star, suction_star, contact_angle1, kappa1)
    product2, slope2 = _half_gap(force_star, suction_star, contact_angle2, kappa2)
    return product1 + product2, slope1 + slope2


@kernel
def _force_of(w: float, suction_star: float) -> float:
    return 0.5 * w ** (-2.0 / 3.0) / suction_star


@kernel
def _fold(
    suction_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> tuple[float, float]:
    """Largest force at which the gap is stationary, and that gap; NaN where there is none.

    To leading order the slope of the gap is linear in w = (2Hλ)^(-3/2) and vanishes at w = 1/(A H); in truth it is
    concave in w, so that a secant started there climbs to the first zero without overshooting, or passes a summit.
    """
    if not (suction_star > 0.0 and 0.0 <= contact_angle1 < 0.5 * math.pi and 0.0 <= contact_angle2 < 0.5 * math.pi):
        return math.nan, math.nan
    moment = 0.5 * (moments(0.5 * math.pi - contact_angle1)[0] + moments(0.5 * math.pi - contact_angle2)[0])
    slope = moment * suction_star
    if slope == 0.0:  # two right angles
        return math.nan, math.nan
    w0 = 1.0 / slope
    f0 = gap(_force_of(w0, suction_star), suction_star, contact_angle1, contact_angle2, kappa1, kappa2)[1]
    w1 = w0 - 0.5 * w0 * f0
    for _ in range(_MAX_STEPS):
        f1 = gap(_force_of(w1, suction_star), suction_star, contact_angle1, contact_angle2, kappa1, kappa2)[1]
        if not (f1 - f0) * (w1 - w0) > 0.0:
            return math.nan, math.nan
        w0, f0, w1 = w1, f1, w1 - f1 * (w1 - w0) / (f1 - f0)
        # The gap is stationary there: half the digits of the force are all the digits of the gap.
        if abs(w1 - w0) <= 1e-9 * w1:
            force = _force_of(w1, suction_star)
            product = gap(force, suction_star, contact_angle1, contact_angle2, kappa1, kappa2)[0]
            return force, product / suction_star if product > 0.0 else math.nan
    return math.nan, math.nan


@kernel
def rupture_star(
    suction_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    r"""Largest gap of the expanded bridge at fixed suction.

    .. math:: D_c = \max_\lambda D(\lambda; H)

    NaN at low suction, where the expansion has no largest gap. Any two solids, angles up to 75 degrees: against exact
    bridges within 3.2 % for H* >= 10, 0.3 % for H* >= 30 and 0.04 % for H* >= 100.

    >>> f"{rupture_star(100.0, 0.0, 0.0, 1.0, 1.0):.6f}"  # exact: 0.0145895
    '0.014592'
    """
    return _fold(suction_star, contact_angle1, contact_angle2, kappa1, kappa2)[1]


@kernel
def force_star(
    separation_star: float,
    suction_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> float:
    """Force of the expanded bridge at fixed suction: the larger solution of D(λ; H) = D.

    Any two solids, angles up to 75 degrees: against exact bridges, up to 0.9 of the rupture distance, within 1.6 % for
    H* >= 10, 0.2 % for H* >= 30 and 0.02 % for H* >= 100.

    >>> f"{force_star(0.0, 100.0, 0.0, 0.0, 1.0, 1.0):.6f}"  # exact: 0.948027
    '0.948027'
    >>> force_star(0.015, 100.0, 0.0, 0.0, 1.0, 1.0)
    0.0
    """
    lowest, rupture = _fold(suction_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if math.isnan(rupture) or math.isnan(separation_star):
        return math.nan
    if separation_star > rupture:
        return 0.0
    target = suction_star * separation_star
    # The gap is concave in the force: Newton's steps from beyond the solution approach it from that side.
    force = max(2.0 * lowest, 0.5 * (math.cos(contact_angle1) + math.cos(contact_angle2) - target))
    for _ in range(_MAX_STEPS):
        product, slope = gap(force, suction_star, contact_angle1, contact_angle2, kappa1, kappa2)
        previous, force = force, force - (product - target) / slope
        if not force > lowest:
            force = 0.5 * (previous + lowest)
        # Close to rupture rounding of the gap, not the step, ends the search.
        if abs(force - previous) <= 1e-14 * force or abs(product - target) <= 4e-15:
            return force
    return math.nan


LAW = Law(
    name="asymptotic",
    title="Exact expansion for large suction, any two solids",
    control="suction",
    variables=(SEPARATION, SUCTION, CONTACT_ANGLE, SIZE_RATIO),
    valid={
        "separation_star": (0.0, math.inf),
        "suction_star": (10.0, math.inf),
        "contact_angle": (0.0, math.radians(75.0)),
    },
    valid_text="suction_star >= 10, angles up to 75 degrees",
    solids={"force": ANY_SOLIDS, "rupture": ANY_SOLIDS},
    reference="derived for this library",
    formula="""\
H D(λ) = Σᵢ [sin φᵢ - A(φᵢ)/rᵢ + B(φᵢ)/rᵢ³ - (H/κᵢ)(1 - cos δᵢ)]
  λ = Yᵢ sin(δᵢ + θᵢ) + H Yᵢ²/2,  Yᵢ = sin δᵢ/κᵢ,  φᵢ = π/2 - δᵢ - θᵢ,  rᵢ = H Yᵢ + cos φᵢ
  A(φ) = (φ + sin φ cos φ)/2,  B(φ) = sin φ cos³φ/8 + (3/8 - cos²φ/2) A(φ)
D_c = max D(λ)
λ = F/(2πγR̄), the larger solution of D(λ) = D
suction H, gap D, contact radii Yᵢ reduced by R̄ = 2R₁R₂/(R₁+R₂), κᵢ = R̄/Rᵢ, half-filling angles δᵢ, sides i = 1, 2""",
    provenance="derived for this library and compared with exact bridges",
    steps={
        moments: (Variable("A", "-", "A"), Variable("B", "-", "B")),
        gap: (
            Variable("product", "-", "suction times whole gap"),
            Variable("slope", "-", "its derivative by the force"),
        ),
    },
    symbols=(
        ANSWERS["force"],
        Variable(
            "slope_angle",
            "rad",
            "slope angle at the contact, negative where the neck lies outside the bridge",
            -math.pi,
            math.pi,
        ),
    ),
    force_star=force_star,
    rupture_star=rupture_star,
)
