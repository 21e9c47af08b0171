r"""Zhao, Kruyt and Millet (2020): the torus as meridian of a bridge under suction control, no fitted number.

In this file :math:`H` is the suction, :math:`S` half the gap, :math:`Y_c` the radius of the contact circle and
:math:`Y_0` that of the neck, all reduced by the Derjaguin radius; :math:`T = \tan\theta` and :math:`r = \sqrt{T^2+1}`.
With a circle as meridian and :math:`P = |X_c|/Y_c`, :math:`Q = Y_0/Y_c` the geometry closes as
:math:`P = (r+T)(1-Q)` (Eq. 18); with :math:`P = S/Y_c + Y_c/2` for small bridges (Eq. 20) and the balance of forces
(Eq. 22) there remains one quartic equation for :math:`Y_c`.
"""

import math

from ..ground.compile import kernel
from ._record import Law, Solids
from ._symbols import CONTACT_ANGLE, SEPARATION, SIZE_RATIO, SUCTION, Variable

__all__ = [
    "LAW",
    "beta_series",
    "beta_torus",
    "contact_radius",
    "force_star",
    "half_gap",
    "half_gap_at_rupture",
    "neck_radius",
    "quartic_coefficients",
    "quartic_discriminant",
    "rupture_star",
]


@kernel
def neck_radius(contact_radius_star: float, suction_star: float, contact_angle: float) -> float:
    r"""Neck radius that balances the axial forces for a given contact radius.

    .. math:: Y_0 = -\frac1H + \sqrt{\frac{2 Y_c (T+Y_c)}{H r} + \frac1{H^2} + Y_c^2} \qquad \text{(Eq. 22)}

    Small bridges: the balance is linearised in the contact radius.

    >>> f"{neck_radius(0.014, 1e4, 0.0):.6f}"
    '0.013902'
    """
    t = math.tan(contact_angle)
    balance = 2.0 * contact_radius_star * (t + contact_radius_star) / (suction_star * math.sqrt(t * t + 1.0))
    return (
        math.sqrt(balance + 1.0 / (suction_star * suction_star) + contact_radius_star * contact_radius_star)
        - 1.0 / suction_star
    )


@kernel
def half_gap(contact_radius_star: float, suction_star: float, contact_angle: float) -> float:
    r"""Half gap of the toroidal bridge with a given contact radius.

    .. math:: S = (r+T) Y_c - Y_c^2/2 - (r+T)\, Y_0(Y_c, H) \qquad \text{(Eqs. 21, 23)}

    >>> f"{half_gap(0.002, 1e4, 0.0):.3e}"
    '9.530e-05'
    """
    t = math.tan(contact_angle)
    slope = math.sqrt(t * t + 1.0) + t
    neck = neck_radius(contact_radius_star, suction_star, contact_angle)
    return slope * (contact_radius_star - neck) - 0.5 * contact_radius_star * contact_radius_star


@kernel
def quartic_coefficients(
    half_gap_star: float, suction_star: float, contact_angle: float
) -> tuple[float, float, float, float, float]:
    r"""Coefficients of the quartic equation for the contact radius.

    .. math:: K_4 Y_c^4 + K_3 Y_c^3 + K_2 Y_c^2 + K_1 Y_c + K_0 = 0 \qquad \text{(Eqs. 24, 34)}

    Same roots as `half_gap`, besides those that squaring adds.

    >>> quartic_coefficients(0.0, 2.0, 0.0)
    (2.0, -8.0, -12.0, 8.0, -0.0)
    """
    h, s, t = suction_star, half_gap_star, math.tan(contact_angle)
    r = math.sqrt(t * t + 1.0)
    k4 = h * (2.0 * r * t**2 - 2.0 * t**3 + r - 2.0 * t)
    k3 = -4.0 * h * (t**2 - r * t + 1.0)
    k2 = (8.0 * h * s * t**2 + 4.0 * h * s + 4.0 * t) * r - 8.0 * h * s * t**3 - 8.0 * h * s * t - 4.0 * t**2 - 12.0
    k1 = (8.0 * h * s * t + 8.0) * r - (8.0 * t**2 + 8.0) * s * h - 8.0 * t
    k0 = -4.0 * s * (((-2.0 * h * t**2 - h) * s - 2.0 * t) * r + 2.0 * (t**2 + 1.0) * (h * s * t + 1.0))
    return k4, k3, k2, k1, k0


@kernel
def quartic_discriminant(half_gap_star: float, suction_star: float, contact_angle: float) -> float:
    r"""Discriminant of the quartic equation: positive while two bridges exist, zero at rupture, then negative.

    .. math:: \Delta = (4 I^3 - J^2)/27, \quad I = 12 K_4 K_0 - 3 K_3 K_1 + K_2^2, \quad
        J = 72 K_4 K_2 K_0 + 9 K_3 K_2 K_1 - 27 K_4 K_1^2 - 27 K_3^2 K_0 - 2 K_2^3

    Exact for Eq. (24). Eq. (25) is the leading expansion of its zero for large suction.

    >>> quartic_discriminant(0.9e-4, 1e4, 0.0) > 0.0 > quartic_discriminant(1.0e-4, 1e4, 0.0)
    True
    """
    k4, k3, k2, k1, k0 = quartic_coefficients(half_gap_star, suction_star, contact_angle)
    i = 12.0 * k4 * k0 - 3.0 * k3 * k1 + k2 * k2
    j = 72.0 * k4 * k2 * k0 + 9.0 * k3 * k2 * k1 - 27.0 * (k4 * k1 * k1 + k3 * k3 * k0) - 2.0 * k2 * k2 * k2
    return (4.0 * i * i * i - j * j) / 27.0


@kernel
def contact_radius(half_gap_star: float, suction_star: float, contact_angle: float) -> float:
    r"""Contact radius of the stable toroidal bridge, from the quartic without its fourth power (Eq. 27).

    .. math::

        Y_c &= -\frac{2}{3K_3} \sqrt{K_2^2 - 3 K_1 K_3}\, \cos\varphi - \frac{K_2}{3K_3}, \\
        \cos 3\varphi &= \frac{27 K_0 K_3^2 - 9 K_1 K_2 K_3 + 2 K_2^3}{2 \sqrt{(K_2^2 - 3 K_1 K_3)^3}}
        \qquad \text{(Eq. 28)}

    NaN where the cubic has one real root only.

    >>> f"{contact_radius(0.0, 1e4, 0.0):.6f}"
    '0.013993'
    """
    _, k3, k2, k1, k0 = quartic_coefficients(half_gap_star, suction_star, contact_angle)
    spread = k2 * k2 - 3.0 * k1 * k3
    if not spread > 0.0:
        return math.nan
    cos_3phi = (27.0 * k0 * k3 * k3 - 9.0 * k1 * k2 * k3 + 2.0 * k2 * k2 * k2) / (2.0 * spread * math.sqrt(spread))
    if not abs(cos_3phi) <= 1.0:
        return math.nan
    # With K3 < 0 the principal angle gives the largest root, the thick bridge.
    phi = math.acos(cos_3phi) / 3.0
    return -(2.0 * math.sqrt(spread) * math.cos(phi) + k2) / (3.0 * k3)


@kernel
def beta_series(contact_angle: float) -> float:
    r"""Coefficient of the rupture distance as the article gives it.

    .. math:: \beta = \frac{27}{32} + \frac{27}{16} T + \frac{81}{64} T^2 \qquad \text{(Eq. 36)}

    Expansion of `beta_torus` for small angles, stated for angles up to 40 degrees.

    >>> beta_series(0.0)
    0.84375
    """
    t = math.tan(contact_angle)
    return 27.0 / 32.0 + 27.0 / 16.0 * t + 81.0 / 64.0 * t * t


@kernel
def beta_torus(contact_angle: float) -> float:
    r"""Coefficient of the rupture distance that the torus has without expansion in the angle.

    .. math:: \beta = \frac{27}{32} \frac{(1+\sin\theta)^2}{\cos\theta}

    The zero of `quartic_discriminant` for large suction; not in the article.

    >>> beta_torus(0.0) == beta_series(0.0)
    True
    """
    return 27.0 / 32.0 * (1.0 + math.sin(contact_angle)) ** 2 / math.cos(contact_angle)


@kernel
def half_gap_at_rupture(beta: float, suction_star: float, contact_angle: float) -> float:
    r"""Half gap at rupture for a given coefficient.

    .. math:: S_c = \frac{1}{H r} \left\{ 1 - (\beta/H)^{1/3} \right\} \qquad \text{(Eqs. 25, 35)}

    NaN for H* <= β. Two terms of an expansion for large suction.

    >>> f"{half_gap_at_rupture(beta_series(0.0), 1e4, 0.0):.4e}"
    '9.5614e-05'
    """
    if not suction_star > beta:
        return math.nan
    # 1/√(T²+1) = cos θ
    return math.cos(contact_angle) / suction_star * (1.0 - (beta / suction_star) ** (1.0 / 3.0))


@kernel
def rupture_star(
    suction_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    r"""Rupture distance of the toroidal bridge at fixed suction.

    .. math:: 2S_c = \frac{2}{H r} \left\{ 1 - \left[ \left( \frac{27}{32} + \frac{27}{16} T + \frac{81}{64} T^2 \right)
        \frac1H \right]^{1/3} \right\} \qquad \text{(Eq. 25)}

    NaN where the expansion is negative.

    >>> f"{rupture_star(1e4, 0.0, 0.0, 1.0, 1.0):.4e}"
    '1.9123e-04'
    """
    if not (suction_star > 0.0 and 0.0 <= contact_angle1 < 0.5 * math.pi and contact_angle1 == contact_angle2):
        return math.nan
    return 2.0 * half_gap_at_rupture(beta_series(contact_angle1), suction_star, contact_angle1)


@kernel
def force_star(
    separation_star: float,
    suction_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> float:
    r"""Force of the toroidal bridge at fixed suction.

    .. math:: \lambda = Y_0 + H Y_0^2/2 \qquad \text{(Eqs. 22, 26, 28)}

    Where Eq. (25) overestimates the fold of the cubic a sliver below rupture has no answer and gives NaN.

    >>> f"{force_star(0.0, 1e4, 0.0, 0.0, 1.0, 1.0):.4f}"
    '0.9792'
    >>> force_star(2e-4, 1e4, 0.0, 0.0, 1.0, 1.0)
    0.0
    """
    rupture = rupture_star(suction_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if math.isnan(rupture):
        return math.nan
    if separation_star > rupture:
        return 0.0
    # The article's S is half the gap.
    y_c = contact_radius(0.5 * separation_star, suction_star, contact_angle1)
    y_0 = neck_radius(y_c, suction_star, contact_angle1)
    return y_0 + 0.5 * suction_star * y_0 * y_0  # Eq. (26)


NECK_RADIUS = Variable("neck_radius_star", "-", "radius of the neck over the Derjaguin radius", 0.0)
CONTACT_RADIUS = Variable("contact_radius_star", "-", "radius of the contact circle over the Derjaguin radius", 0.0)
HALF_GAP = Variable("half_gap_star", "-", "half the gap over the Derjaguin radius")
BETA = Variable("beta", "-", "coefficient of the rupture distance", 0.0)

LAW = Law(
    name="toroidal2020",
    title="Toroidal theory of Zhao, Kruyt and Millet",
    control="suction",
    variables=(SEPARATION, SUCTION, CONTACT_ANGLE, SIZE_RATIO),
    valid={
        "separation_star": (0.0, math.inf),
        "suction_star": (1e4, math.inf),
        "contact_angle": (0.0, math.radians(40.0)),
        "size_ratio": (1.0, 128.0),
    },
    valid_text="suction_star >= 1e4, angles up to 40 degrees",
    solids={"force": Solids("equal", "mean", "mean"), "rupture": Solids("equal", "mean", "mean")},
    reference="C.-F. Zhao, N. P. Kruyt, O. Millet, Powder Technology 360 (2020) 622-634",
    equations="17-28, 34-36",
    formula="""\
2S_c = (2/H) (1/r) {1 - [(27/32 + (27/16) T + (81/64) T²)/H]^(1/3)}     (25, 35, 36)
S = (r+T) Y_c - Y_c²/2 - (r+T) Y0                                       (21, 23)
Y0 = -1/H + √(2 Y_c (T + Y_c)/(H r) + 1/H² + Y_c²)                      (22)
Y_c = -(2/(3 K3)) √(K2² - 3 K1 K3) cos φ - K2/(3 K3)                    (28)
cos 3φ = (27 K0 K3² - 9 K1 K2 K3 + 2 K2³)/(2 √(-(3 K1 K3 - K2²)³))
K3 Y_c³ + K2 Y_c² + K1 Y_c + K0 = 0                                     (27)
  K3 = -4 H (T² - r T + 1)                                              (34)
  K2 = (8 H S T² + 4 H S + 4 T) r - 8 H S T³ - 8 H S T - 4 T² - 12
  K1 = (8 H S T + 8) r + (-8 T² - 8) S H - 8 T
  K0 = -4 S {[(-2 H T² - H) S - 2 T] r + 2 (T² + 1)(H S T + 1)}
F/(2πγR̄) = Y0 + H Y0²/2                                                 (26)
T = tan θ, r = √(T²+1); suction H, half gap S, neck and contact radius Y0, Y_c reduced by R̄ = 2R₁R₂/(R₁+R₂)""",
    provenance="transcribed from the article and compared with its text",
    errata=(
        "The coefficient of H^(-1/3) in Eq. (25) is that of the torus; the exact one is larger by a factor of 1.35 at "
        "zero angle, so that the rupture distance is too large.",
        "Eq. (27) is said to have three real roots; just below the rupture distance of Eq. (25) it can have one only.",
    ),
    steps={
        neck_radius: (NECK_RADIUS,),
        half_gap: (HALF_GAP,),
        quartic_coefficients: tuple(Variable(f"K{power}", "-", f"K{power}") for power in (4, 3, 2, 1, 0)),
        quartic_discriminant: (Variable("discriminant", "-", "the discriminant"),),
        contact_radius: (CONTACT_RADIUS,),
        beta_series: (BETA,),
        beta_torus: (BETA,),
        half_gap_at_rupture: (HALF_GAP,),
    },
    force_star=force_star,
    rupture_star=rupture_star,
)
