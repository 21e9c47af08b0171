r"""Lambert, Chau, Delchambre and Régnier (2008): the force of a bridge of given volume as a liquid cylinder.

In this file :math:`V` is the volume and :math:`D` the gap, reduced by the Derjaguin radius. The liquid fills the gap
between the solids out to a radius :math:`y` with :math:`V = \pi y^2 D + \pi y^4/2`; the force is the change of the
wetted area with the gap.
"""

import math

from ..ground.compile import kernel
from ._domain import mean_cosine
from ._record import Law, Solids
from ._symbols import CONTACT_ANGLE, GAP, SIZE_RATIO, VOLUME, Variable

__all__ = ["LAW", "force_star", "wetted_radius_squared"]


@kernel
def wetted_radius_squared(separation_star: float, volume_star: float) -> float:
    r"""Square of the radius to which the liquid cylinder wets the solids.

    .. math:: y^2 = -D + \sqrt{D^2 + 2V/\pi}, \qquad y^2 = \sqrt{2V/\pi} \text{ at contact}

    >>> f"{wetted_radius_squared(0.0, 0.5 * math.pi):.1f}"
    '1.0'
    """
    if not (separation_star >= 0.0 and volume_star > 0.0):
        return math.nan
    squared = 2.0 * volume_star / math.pi
    return squared / (separation_star + math.sqrt(separation_star * separation_star + squared))


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

    .. math:: \lambda = \frac{\cos\theta}{1 + D/(2d)}, \quad
        d = \frac D2 \left( -1 + \sqrt{1 + \frac{2V}{\pi D^2}} \right) \qquad \text{(Eq. 65)}

    which is :math:`\cos\theta\, [1 - D/\sqrt{D^2 + 2V/\pi}]`, and :math:`\cos\theta` at contact.

    At contact the volume does not enter. Against exact bridges of equal spheres, V* = 1e-4 to 0.1 and angles up to 40
    degrees: 3.7 to 45 % too large at contact, 18 to 54 % too small from 0.6 of the rupture distance on. The law has no
    rupture distance: it gives a force at every separation, and the work to infinity is 2γ cos θ √(2πR̄V).

    >>> f"{force_star(0.066, 1e-2, 0.0, 0.0, 1.0, 1.0):.4f}"  # exact: 0.3820
    '0.3626'
    """
    squared = wetted_radius_squared(separation_star, volume_star)
    # y²/(D + y²) is the bracket, without the difference of two nearly equal numbers at large separation.
    return mean_cosine(contact_angle1, contact_angle2) * squared / (separation_star + squared)


LAW = Law(
    name="lambert2008",
    title="Cylinder of Lambert, Chau, Delchambre and Régnier",
    control="volume",
    variables=(GAP, VOLUME, CONTACT_ANGLE, SIZE_RATIO),
    valid={
        "separation_star": (0.0, math.inf),
        "volume_star": (0.0, 0.1),
        "contact_angle": (0.0, math.radians(40.0)),
    },
    valid_text="the statement of the authors was not seen; measured for volume_star <= 0.1, angles up to 40 degrees, "
    "rough everywhere; no rupture distance, the force is given at every separation",
    solids={"force": Solids("mean cosine", "mean", "mean")},
    reference="P. Lambert, A. Chau, A. Delchambre, S. Régnier, Langmuir 24 (2008) 3157-3163",
    doi="10.1021/la7036444",
    equations="65",
    formula="""\
F/(2πγR̄) = cos θ/(1 + D/(2d)),  d = (D/2) [-1 + √(1 + 2V/(πD²))]        (65)
         = cos θ [1 - D/√(D² + 2V/π)]
gap D and volume V reduced by R̄ = 2R₁R₂/(R₁+R₂)""",
    provenance="transcribed from published source code, the article not seen; compared with exact bridges",
    steps={
        wetted_radius_squared: (
            Variable("wetted_radius_squared_star", "-", "square of the radius over the Derjaguin radius", 0.0),
        )
    },
    force_star=force_star,
)
