r"""Weigert and Ripperger (1999): a toroidal bridge whose half-filling angle is fitted to the volume.

In this file :math:`V` is the volume, :math:`D` the gap and :math:`r_1, r_2` the radii of the meniscus, reduced by the
Derjaguin radius; :math:`\beta` is the half-filling angle.
"""

import math

from ..ground.compile import kernel
from ._domain import one_angle
from ._record import Law, Solids
from ._symbols import CONTACT_ANGLE, GAP, SIZE_RATIO, VOLUME

__all__ = ["LAW", "force_star"]


@kernel
def force_star(
    separation_star: float,
    volume_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> float:
    r"""Force at fixed volume, toroidal.

    .. math::

        V &= 0.96\, \sin^4\beta\, (1 + 3D)\, (1 + 1.1 \sin\theta) \qquad \text{(Eqs. 15 to 17)} \\
        r_1 &= \frac{2(1 - \cos\beta) + D}{2\cos(\beta + \theta)} \qquad \text{(Eq. 5)}, \qquad
        r_2 = \sin\beta + r_1 [\sin(\beta + \theta) - 1] \qquad \text{(Eq. 6)} \\
        \lambda &= \tfrac12 \sin^2\beta \left( \frac1{r_1} - \frac1{r_2} \right)
            + \sin\beta \sin(\beta + \theta) \qquad \text{(Eqs. 21, 22)}

    The domain ends where the meniscus is no longer concave and where its neck closes. Against exact bridges of equal
    spheres, V* = 1e-4 to 0.1 and angles up to 40 degrees: 0.2 to 6.9 % too small at contact. With a gap the force is
    far too large: at V* = 1e-4 and 0.65 of the rupture distance and more, 4.5 to 6.0 times the exact one. The law has
    no rupture distance: it gives a force wherever it has a bridge.

    >>> f"{force_star(0.0, 1e-2, 0.0, 0.0, 1.0, 1.0):.4f}"  # exact: 0.8844
    '0.8438'
    """
    if not (separation_star >= 0.0 and volume_star > 0.0):
        return math.nan
    theta = one_angle(contact_angle1, contact_angle2)
    squared = math.sqrt(
        volume_star / (0.96 * (1.0 + 3.0 * separation_star) * (1.0 + 1.1 * math.sin(theta)))
    )  # Eq. (15)
    if not squared < 1.0:
        return math.nan
    sine = math.sqrt(squared)
    beta = math.asin(sine)
    if not beta + theta < 0.5 * math.pi:
        return math.nan
    slope = math.sin(beta + theta)
    r1 = (2.0 * math.sin(0.5 * beta) ** 2 + 0.5 * separation_star) / math.cos(beta + theta)  # Eq. (5)
    r2 = sine + r1 * (slope - 1.0)  # Eq. (6)
    if not r2 > 0.0:
        return math.nan
    return 0.5 * squared * (1.0 / r1 - 1.0 / r2) + sine * slope  # Eqs. (21), (22)


LAW = Law(
    name="weigert1999",
    title="Torus of Weigert and Ripperger",
    control="volume",
    variables=(GAP, VOLUME, CONTACT_ANGLE, SIZE_RATIO),
    valid={
        "separation_star": (0.0, math.inf),
        "volume_star": (1e-4, 0.1),
        "contact_angle": (0.0, math.radians(40.0)),
    },
    valid_text="the statement of the authors was not seen; measured at contact for volume_star from 1e-4 to 0.1, "
    "angles up to 40 degrees; with a gap the force is far too large; no rupture distance",
    solids={"force": Solids("equal", "mean", "mean")},
    reference="T. Weigert, S. Ripperger, Particle & Particle Systems Characterization 16 (1999) 238-242",
    doi="10.1002/(SICI)1521-4117(199910)16:5<238::AID-PPSC238>3.0.CO;2-E",
    equations="5, 6, 15-17, 21, 22",
    formula="""\
V = 0.12 (2R)³ sin⁴β (1 + 6D/(2R)) (1 + 1.1 sin θ)                      (15, 16, 17)
r₁ = [2R (1 - cos β) + D]/(2 cos(β + θ))                                (5)
r₂ = R sin β + r₁ [sin(β + θ) - 1]                                      (6)
F = πR² sin²β γ (1/r₁ - 1/r₂) + 2πγR sin β sin(β + θ)                   (21, 22)
gap D, volume V, half-filling angle β, R = R̄ = 2R₁R₂/(R₁+R₂)""",
    provenance="transcribed from published source code, the article not seen; compared with exact bridges",
    errata=("A transcription with the sum of the two curvatures in place of their difference is in circulation.",),
    force_star=force_star,
)
