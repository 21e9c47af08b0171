r"""Rabinovich, Esayanur and Moudgil (2005): the force of a bridge of given volume, with a term for the meniscus.

In this file :math:`V` is the volume and :math:`D` the gap, reduced by the Derjaguin radius.
"""

import math

from ..ground.compile import kernel
from ._domain import mean_angle
from ._record import Law, Solids
from ._symbols import CONTACT_ANGLE, GAP, SIZE_RATIO, VOLUME
from .lambert2008 import wetted_radius_squared

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
    r"""Force at fixed volume, rough.

    .. math::

        \lambda &= \frac{\cos\theta}{1 + D/(2d)} + \sin a \sin(a + \theta) \qquad \text{(Eq. 19)} \\
        d &= \frac D2 \left( -1 + \sqrt{1 + \frac{2V}{\pi D^2}} \right) \qquad \text{(Eq. 20)}, \qquad
        a = \sqrt{2d} \qquad \text{(Eq. A3)}

    At contact the first term is :math:`\cos\theta` and :math:`a = (2V/\pi)^{1/4}`.

    Against exact bridges of equal spheres, V* = 1e-4 to 0.1 and angles up to 40 degrees: 4.5 to 130 % too large at
    contact. The law has no rupture distance: it gives a force at every separation.

    >>> f"{force_star(0.066, 1e-2, 0.0, 0.0, 1.0, 1.0):.4f}"  # exact: 0.3820
    '0.3997'
    """
    theta = mean_angle(contact_angle1, contact_angle2)
    squared = wetted_radius_squared(separation_star, volume_star)  # 2d
    a = math.sqrt(squared)  # Eq. (A3)
    return math.cos(theta) * squared / (separation_star + squared) + math.sin(a) * math.sin(a + theta)


LAW = Law(
    name="rabinovich2005",
    title="Law of Rabinovich, Esayanur and Moudgil",
    control="volume",
    variables=(GAP, VOLUME, CONTACT_ANGLE, SIZE_RATIO),
    valid={
        "separation_star": (0.0, math.inf),
        "volume_star": (0.0, 0.1),
        "contact_angle": (0.0, math.radians(40.0)),
    },
    valid_text="the statement of the authors was not seen; measured for volume_star <= 0.1, angles up to 40 degrees, "
    "rough everywhere; no rupture distance, the force is given at every separation",
    solids={"force": Solids("mean angle", "mean", "mean")},
    reference="Y. I. Rabinovich, M. S. Esayanur, B. M. Moudgil, Langmuir 21 (2005) 10992-10997",
    equations="19, 20, A3",
    formula="""\
F/(2πγR̄) = cos θ/(1 + D/(2d)) + sin a sin(a + θ)                        (19)
  d = (D/2) [-1 + √(1 + 2V/(πD²))]                                      (20)
  a = √(2d),  at contact (2V/π)^(1/4)                                   (A3)
gap D and volume V reduced by R̄ = 2R₁R₂/(R₁+R₂)""",
    provenance="transcribed from published source code, the article not seen; compared with exact bridges",
    errata=(
        "The second term counts the surface tension twice where the contact angle is not zero; `lambert2008` is the "
        "law without it.",
        "Transcriptions that drop the second term at contact are in circulation: their force jumps at the first gap.",
        "A transcription with R₁R₂/(R₁+R₂), half the Derjaguin radius, in the prefactor is in circulation; it halves "
        "the force.",
    ),
    force_star=force_star,
)
