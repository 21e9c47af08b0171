r"""Rupture distance and force at fixed suction: two exact limits, joined by three fitted numbers.

In this file :math:`H` is the suction, :math:`D` the gap, :math:`Y_0` the radius of the neck and :math:`\lambda` the
force, reduced by the Derjaguin radius. Two solids with contact angles :math:`\theta_i` enter through

.. math::

    \cos\theta = \tfrac12 (\cos\theta_1 + \cos\theta_2), \qquad
    A = \tfrac12 (A_1 + A_2), \quad A_i = \tfrac12 (\tfrac\pi2 - \theta_i + \sin\theta_i \cos\theta_i), \qquad
    \rho = A/\cos\theta .

**The idea.** Bridges at fixed suction are simple in the coordinate :math:`m = 1 + HY_0 = \sqrt{1 + 2H\lambda}`. They
are known exactly in two limits: at large suction for any angle, and for grazing contact, :math:`\theta \to \pi/2`, at
any suction, where :math:`m_f^3 = 1 + AH` at rupture. In both the gap is the same function of :math:`m`,

.. math:: H^2 (D_c - D) = (m - m_f)^2\, (1 + 2 m_f/m),

and the law takes this form everywhere: :math:`D` is a rational function of the neck radius, the neck radius the root of
a cubic. Every correction is a product of :math:`1 - \rho`, which falls from 0.215 at zero angle to 0 at grazing
contact, and of powers of :math:`x = (1 + AH)^{-1/3}`, which falls from 1 at zero suction to 0 at infinite suction, so
that both limits stay exact.

**The law.**

.. math::

    D_c &= \frac{2 A \cos\theta\; x^3}{1 + kx + k^2 x^2 + (k^3 - 1 - C)\, x^3 + w x^4}, \qquad
        k = \tfrac32 \rho, \quad w = \frac{9}{16 + 8x} - a_1 (1 - \rho^5) \\
    Y_f &= \frac{A x^2}{1 + x + x^2}\, \bigl[ 1 + a_2 (1 - \rho)\, x^2 \bigr], \qquad m_f = 1 + H Y_f \\
    D_c - D &= \frac{(Y_0 - Y_f)^2}{1 + a_3 (1 - \rho)\, x^3} \left( 1 + \frac{2 m_f}{1 + H Y_0} \right) \\
    \lambda &= Y_0 + \tfrac12 H Y_0^2

where :math:`C = \rho\, C_3/2` with the :math:`C_3` of `pendular.laws.asymptotic_rupture`; for equal angles :math:`C =
\rho\, (\tfrac38 + \sin^2\theta) + \tfrac18 \sin^3\theta`. At large suction, for any two solids,

.. math::

    H D_c &= 2\cos\theta - 3 A^{2/3} H^{-1/3} + 0\, H^{-2/3} + C_3 H^{-1} + O(H^{-4/3}) \\
    \lambda(D = 0) &= \cos\theta - A/\sqrt{2 H \cos\theta} + O(H^{-1}) .

The map of its error is ``docs/images/pendular2026_error.png``.
"""

import math

from ..ground.compile import kernel
from ._record import ANY_SOLIDS, Law
from ._symbols import ANSWERS, CONTACT_ANGLE, SEPARATION, SIZE_RATIO, SUCTION, Variable
from .asymptotic import moments

__all__ = ["COEFFICIENTS", "LAW", "evaluate", "force_star", "rupture_star"]

# Of a1, a2, a3, fitted to the exact solution by tools/fit_pendular2026.py, which writes the next line.
COEFFICIENTS = (0.494, 0.75, 0.42)


@kernel
def _solid(contact_angle: float) -> tuple[float, float, float]:
    """Both moments and the cosine of the contact angle."""
    slope_angle = 0.5 * math.pi - contact_angle
    a, b = moments(slope_angle)
    return a, b, math.sin(slope_angle)


@kernel
def _pair(contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float) -> tuple[float, float, float]:
    """A, cos θ and C of two solids."""
    first = _solid(contact_angle1)
    second = first if contact_angle2 == contact_angle1 else _solid(contact_angle2)
    a, cosine = 0.5 * (first[0] + second[0]), 0.5 * (first[2] + second[2])
    share1 = (1.0 - first[2] ** 2) * (kappa1 * a + 0.5 * first[0]) + first[1]
    share2 = (1.0 - second[2] ** 2) * (kappa2 * a + 0.5 * second[0]) + second[1]
    return a, cosine, 0.5 * (share1 + share2) / cosine


@kernel
def _halley(u: float, sigma: float) -> float:
    t = sigma * u
    excess = (3.0 + t) * u * u - 3.0 * (1.0 + t)
    slope = 3.0 * sigma * (u * u - 1.0) + 6.0 * u
    return u - 2.0 * excess * slope / (2.0 * slope * slope - 6.0 * (1.0 + t) * excess)


@kernel
def _stretch(sigma: float) -> float:
    """Positive root of (3 + σu) u² = 3 (1 + σu), from 1 at σ = 0 to √3 at infinity.

    The start is right at both ends and within 1.4 % between; two steps of Halley's method reach the rounding error, at
    a fraction of the cost of the trigonometric root, which also cancels at small σ.
    """
    start = math.sqrt(3.0) * (1.0 + sigma) / (math.sqrt(3.0) + sigma)
    return _halley(_halley(start, sigma), sigma)


@kernel
def evaluate(
    coefficients: tuple[float, float, float],
    separation_star: float,
    suction_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> tuple[float, float]:
    """Rupture distance and force of the law with any coefficients.

    Without fitted numbers, (0, 0, 0), the limits remain exact.

    >>> rupture, force = evaluate((0.0, 0.0, 0.0), 0.14054448, 1.0, 0.0, 0.0, 1.0, 1.0)
    >>> f"{rupture:.4f} {force:.4f}"  # exact: 0.2811 0.5839
    '0.2675 0.5226'
    """
    if not (suction_star >= 0.0 and 0.0 <= contact_angle1 < 0.5 * math.pi and 0.0 <= contact_angle2 < 0.5 * math.pi):
        return math.nan, math.nan
    a1, a2, a3 = coefficients
    a, cosine, c = _pair(contact_angle1, contact_angle2, kappa1, kappa2)
    x = (1.0 + a * suction_star) ** (-1.0 / 3.0)
    rho = a / cosine
    k = 1.5 * rho
    w = 9.0 / (16.0 + 8.0 * x) - a1 * (1.0 - rho**5)
    series = 1.0 + (k + k * k * x) * x + (k**3 - 1.0 - c + w * x) * x**3
    # The leading x³ is the exact 1/(1 + AH): a power errs with the logarithm of its base.
    rupture = 2.0 * a * cosine / ((1.0 + a * suction_star) * series)
    if separation_star > rupture:
        return rupture, 0.0
    y_f = a * x * x / (1.0 + x + x * x) * (1.0 + a2 * (1.0 - rho) * x * x)
    m_f = 1.0 + suction_star * y_f
    # Y0 - Yf at zero suction; elsewhere the cubic stretches it.
    rise = math.sqrt((1.0 + a3 * (1.0 - rho) * x**3) * (rupture - separation_star) / 3.0)
    y_0 = y_f + rise * _stretch(suction_star * rise / m_f)
    return rupture, y_0 + 0.5 * suction_star * y_0 * y_0


@kernel
def rupture_star(
    suction_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    r"""Rupture distance at fixed suction.

    .. math:: D_c = 2 A \cos\theta\, x^3 \big/ \left[ 1 + kx + k^2 x^2 + (k^3 - 1 - C)\, x^3 + w x^4 \right]

    Equal spheres and angles: within 0.070 % of exact bridges at any suction, up to 80 degrees, and closer still beyond.
    Equal spheres with two angles: within 1.4 % for H* >= 10, 9.1 % at any suction. Any two solids: within 0.4 % for H*
    >= 100 and 0.02 % for H* >= 1000.

    >>> f"{rupture_star(100.0, 0.0, 0.0, 1.0, 1.0):.7f}"  # exact: 0.0145895
    '0.0145883'
    """
    return evaluate(COEFFICIENTS, 0.0, suction_star, contact_angle1, contact_angle2, kappa1, kappa2)[0]


@kernel
def force_star(
    separation_star: float,
    suction_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> float:
    r"""Force at fixed suction.

    .. math::

        \lambda &= Y_0 + \tfrac12 H Y_0^2, \qquad Y_0 = Y_f + us, \qquad (3 + \sigma u)\, u^2 = 3\, (1 + \sigma u) \\
        s^2 &= \tfrac13 \left[ 1 + a_3 (1 - \rho)\, x^3 \right] (D_c - D), \qquad \sigma = H s/m_f

    Equal spheres and angles, up to 0.99 of the rupture distance: within 0.57 % of exact bridges at any suction, up to
    80 degrees, and closer still beyond. Up to 0.9 of the rupture distance: equal spheres with two angles within 2.3 %
    for H* >= 10, any two solids within 1.1 % for H* >= 100 and 0.12 % for H* >= 1000.

    >>> f"{force_star(0.0, 100.0, 0.0, 0.0, 1.0, 1.0):.6f}"  # exact: 0.948027
    '0.947600'
    >>> force_star(0.015, 100.0, 0.0, 0.0, 1.0, 1.0)
    0.0
    """
    return evaluate(COEFFICIENTS, separation_star, suction_star, contact_angle1, contact_angle2, kappa1, kappa2)[1]


LAW = Law(
    name="pendular2026",
    title="Two exact limits joined by three fitted numbers",
    control="suction",
    variables=(SEPARATION, SUCTION, CONTACT_ANGLE, SIZE_RATIO),
    valid={
        "separation_star": (0.0, math.inf),
        "suction_star": (0.0, math.inf),
        "contact_angle": (0.0, math.radians(80.0)),
    },
    valid_text="equal spheres and angles at any suction; any two solids for suction_star >= 100",
    solids={"force": ANY_SOLIDS, "rupture": ANY_SOLIDS},
    reference="derived for this library",
    formula="""\
D_c = 2 A cos θ x³/[1 + k x + k² x² + (k³ - 1 - C) x³ + w x⁴]
  x = (1 + A H)^(-1/3),  k = 3ρ/2,  ρ = A/cos θ,  w = 9/(16 + 8x) - a₁ (1 - ρ⁵)
Y_f = A x²/(1 + x + x²) [1 + a₂ (1 - ρ) x²],  m_f = 1 + H Y_f
D_c - D = (Y0 - Y_f)²/[1 + a₃ (1 - ρ) x³] [1 + 2 m_f/(1 + H Y0)]
F/(2πγR̄) = Y0 + H Y0²/2
  C = (ρ/2) Σᵢ [sin²θᵢ (κᵢ + Aᵢ/(2A)) + Bᵢ/A]
  cos θ = (cos θ₁ + cos θ₂)/2,  A = (A₁ + A₂)/2
  Aᵢ = (φ + sin φ cos φ)/2,  Bᵢ = sin φ cos³φ/8 + (3/8 - cos²φ/2) Aᵢ  at  φ = π/2 - θᵢ
a₁ = {}, a₂ = {}, a₃ = {}
suction H, gap D, neck radius Y0 reduced by R̄ = 2R₁R₂/(R₁+R₂), κᵢ = R̄/Rᵢ, sides i = 1, 2""".format(*COEFFICIENTS),
    provenance="exact limits derived for this library; three numbers fitted to exact bridges of equal spheres",
    steps={evaluate: (ANSWERS["rupture"], ANSWERS["force"])},
    symbols=(Variable("coefficients", "-", "the numbers a₁, a₂, a₃"),),
    force_star=force_star,
    rupture_star=rupture_star,
)
