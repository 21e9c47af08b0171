r"""Willett, Adams, Johnson and Seville (2000): the simple force law for small bridges of given volume.

In this file :math:`V` is the volume and :math:`D` the gap, reduced by the Derjaguin radius; :math:`s = (D/2)/\sqrt V`
as in the article, which takes half the gap.
"""

import math

from ..ground.compile import kernel
from ._record import Law, Solids
from ._symbols import CONTACT_ANGLE, GAP, SIZE_RATIO, VOLUME
from .willett2000 import rupture_star

__all__ = ["LAW", "force_star", "rupture_star"]


@kernel
def force_star(
    separation_star: float,
    volume_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> float:
    r"""Force at fixed volume, rough.

    .. math:: \lambda = \frac{\cos\theta}{1 + 2.1\, s + 10\, s^2} \qquad \text{(Eq. 12)}

    At contact the volume does not enter. Against exact bridges of equal spheres, V* = 1e-4 to 0.1 and angles up to 40
    degrees: 3.7 to 45 % too large at contact, 12 to 51 % too small from 0.65 of the rupture distance on.

    >>> f"{force_star(0.066, 1e-2, 0.0, 0.0, 1.0, 1.0):.4f}"  # exact: 0.3820
    '0.3595'
    >>> force_star(0.3, 1e-2, 0.0, 0.0, 1.0, 1.0)
    0.0
    """
    rupture = rupture_star(volume_star, contact_angle1, contact_angle2, kappa1, kappa2)
    if math.isnan(rupture) or not separation_star >= 0.0:
        return math.nan
    if separation_star > rupture:
        return 0.0
    s = 0.5 * separation_star / math.sqrt(volume_star)
    return math.cos(contact_angle1) / (1.0 + (2.1 + 10.0 * s) * s)  # Eq. (12)


LAW = Law(
    name="willett2000_simple",
    title="Simple law of Willett, Adams, Johnson and Seville",
    control="volume",
    variables=(GAP, VOLUME, CONTACT_ANGLE, SIZE_RATIO),
    valid={
        "separation_star": (0.0, math.inf),
        "volume_star": (0.0, 0.1),
        "contact_angle": (0.0, math.radians(50.0)),
    },
    valid_text="volume_star < 0.1 and angles below 50 degrees as stated for the full fit; rough everywhere",
    solids={"force": Solids("equal", "mean", "mean"), "rupture": Solids("equal", "any", "any")},
    reference="C. D. Willett, M. J. Adams, S. A. Johnson, J. P. K. Seville, Langmuir 16 (2000) 9396-9405",
    doi="10.1021/la000657y",
    equations="12, 13, 15, 16",
    formula="""\
F/(2πγR̄) = cos θ/(1 + 2.1 s + 10 s²),  s = (D/2)/√V                     (12, 13)
D_c = [1 + (θ/4)(1 + r)] [V^(1/3) + (r/2 - 2/5) V^(2/3)]                (16; 15 at r = 1)
gap D and volume V reduced by R̄ = 2R₁R₂/(R₁+R₂); r smaller over larger radius""",
    provenance="transcribed from published source code, the article not seen; compared with exact bridges",
    errata=(
        "A transcription with R₁R₂/(R₁+R₂), half the Derjaguin radius, in place of R is in circulation; it halves the "
        "force at contact.",
    ),
    force_star=force_star,
    rupture_star=rupture_star,
)
