r"""The rupture distance at fixed suction, expanded in :math:`H^{-1/3}` with exact coefficients, for any two solids.

It is the fold of the theory in `asymptotic`, to the first correction that knows the sizes of the solids.
"""

import math

from ..ground.compile import kernel
from ._record import ANY_SOLIDS, Law
from ._symbols import CONTACT_ANGLE, SIZE_RATIO, SUCTION, Variable
from .asymptotic import moments

__all__ = ["LAW", "beta_exact", "rupture_star"]


@kernel
def beta_exact(contact_angle: float) -> float:
    r"""Exact coefficient for the two-term form of the rupture distance of equal spheres.

    .. math:: D_c = \frac{2\cos\theta}{H} \left\{ 1 - (\beta/H)^{1/3} \right\}, \qquad
        \beta = \frac{27}{32} \frac{(\pi/2 - \theta + \sin\theta \cos\theta)^2}{\cos^3\theta}

    Exact limit for large suction; `pendular.laws.toroidal2020` has the coefficient of a torus there.

    >>> f"{beta_exact(0.0):.5f}"
    '2.08187'
    """
    return 27.0 / 8.0 * moments(0.5 * math.pi - contact_angle)[0] ** 2 / math.cos(contact_angle) ** 3


@kernel
def _third_coefficient(contact_angle: float, kappa: float, mean_moment: float) -> float:
    a, b = moments(0.5 * math.pi - contact_angle)
    return math.sin(contact_angle) ** 2 * (kappa + 0.5 * a / mean_moment) + b / mean_moment


@kernel
def rupture_star(
    suction_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    r"""Rupture distance at fixed suction, three terms.

    .. math::

        H D_c &= \cos\theta_1 + \cos\theta_2 - 3 \bar A^{2/3} H^{-1/3} + C_3 H^{-1}, \\
        C_3 &= \sum_i \left\{ \sin^2\theta_i \left[ \kappa_i + \frac{A_i}{2\bar A} \right]
            + \frac{B_i}{\bar A} \right\}

    with :math:`A_i, B_i` the `moments` at :math:`\pi/2 - \theta_i` and
    :math:`\bar A = (A_1 + A_2)/2`.

    NaN where the expansion is negative. Any two solids; against exact bridges within 1.6 % for H* >= 30 and 0.25 % for
    H* >= 100 at angles up to 40 degrees. The error grows with the angle: 3.4 % and 0.5 % where both are 60 degrees.

    >>> f"{rupture_star(100.0, 0.0, 0.0, 1.0, 1.0):.6f}"  # exact: 0.0145895
    '0.014573'
    """
    if not (suction_star > 0.0 and 0.0 <= contact_angle1 < 0.5 * math.pi and 0.0 <= contact_angle2 < 0.5 * math.pi):
        return math.nan
    moment = 0.5 * (moments(0.5 * math.pi - contact_angle1)[0] + moments(0.5 * math.pi - contact_angle2)[0])
    third = _third_coefficient(contact_angle1, kappa1, moment) + _third_coefficient(contact_angle2, kappa2, moment)
    product = math.cos(contact_angle1) + math.cos(contact_angle2)
    product += third / suction_star - 3.0 * (moment * moment / suction_star) ** (1.0 / 3.0)
    return product / suction_star if product > 0.0 else math.nan


LAW = Law(
    name="asymptotic_rupture",
    title="Explicit rupture distance for large suction, any two solids",
    control="suction",
    variables=(SUCTION, CONTACT_ANGLE, SIZE_RATIO),
    valid={"suction_star": (30.0, math.inf), "contact_angle": (0.0, math.radians(40.0))},
    valid_text="suction_star >= 30, angles up to 40 degrees; larger angles need larger suction",
    solids={"rupture": ANY_SOLIDS},
    reference="derived for this library",
    formula="""\
H D_c = cos θ₁ + cos θ₂ - 3 A^(2/3) H^(-1/3) + C₃/H
  C₃ = Σᵢ {sin²θᵢ [κᵢ + Aᵢ/(2A)] + Bᵢ/A},  A = (A₁ + A₂)/2
  Aᵢ = (φ + sin φ cos φ)/2,  Bᵢ = sin φ cos³φ/8 + (3/8 - cos²φ/2) Aᵢ  at  φ = π/2 - θᵢ
suction H and gap D_c reduced by R̄ = 2R₁R₂/(R₁+R₂), κᵢ = R̄/Rᵢ, sides i = 1, 2""",
    provenance="derived for this library and compared with exact bridges",
    steps={beta_exact: (Variable("beta", "-", "coefficient of the rupture distance", 0.0),)},
    rupture_star=rupture_star,
)
