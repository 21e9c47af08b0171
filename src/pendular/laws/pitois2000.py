r"""Pitois, Moucheront and Chateau (2000): the viscous force of a bridge between spheres that move apart.

In this file :math:`V` is the volume and :math:`D` the gap, reduced by the Derjaguin radius, which is
the radius of the equal spheres of the article.
"""

import math

from ..ground.compile import kernel
from ._domain import mean_cosine
from ._record import Law, Solids
from ._symbols import CONTACT_ANGLE, GAP, SIZE_RATIO, VOLUME

__all__ = ["LAW", "damping_star"]


@kernel
def damping_star(
    separation_star: float,
    volume_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> float:
    r"""Viscous force over the speed at which the solids move apart.

    .. math:: \frac{F_v}{\mu\bar R\,\dot D} = \frac{3\pi}{2D} \left(1 - \frac{1}{\sqrt{1 + 2V/(\pi D^2)}}\right)^2

    Reynolds' equation between two parabolas, in a liquid that ends where these hold the volume, with the pressure of
    the gas there; of much liquid it is the lubrication force of two spheres. NaN at contact, where the force has no
    bound: the gap is kept above the roughness of the solids. Against Reynolds' equation between equal spheres, at gaps
    up to the cube root of the volume: 0 to 0.45 % too large for V* <= 1e-3, up to 1.5 % at 1e-2 and 4.7 % at 0.1.

    >>> f"{damping_star(0.01, 1e-3, 0.0, 0.0, 1.0, 1.0):.4f}"
    '187.9563'
    >>> damping_star(0.0, 1e-3, 0.0, 0.0, 1.0, 1.0)
    nan
    """
    if not (separation_star > 0.0 and volume_star > 0.0 and mean_cosine(contact_angle1, contact_angle2) > 0.0):
        return math.nan
    x = 2.0 * volume_star / (math.pi * (separation_star * separation_star))
    root = math.sqrt(1.0 + x)
    part = x / (root * (1.0 + root))
    return 1.5 * math.pi * (part * part) / separation_star


LAW = Law(
    name="pitois2000",
    title="Viscous force of Pitois, Moucheront and Chateau",
    control="volume",
    variables=(GAP, VOLUME, CONTACT_ANGLE, SIZE_RATIO),
    valid={"volume_star": (0.0, 0.1), "contact_angle": (0.0, math.radians(20.0))},
    valid_text=(
        "the statement of the authors was not seen; compared with Reynolds' equation for volume_star <= 0.1, and meant "
        "for small angles, up to 20 degrees"
    ),
    solids={"damping": Solids("any", "mean", "any")},
    reference="O. Pitois, P. Moucheront, X. Chateau, J. Colloid Interface Sci. 231 (2000) 26-31",
    doi="10.1006/jcis.2000.7096",
    formula="""\
F_v = (3/2) π μ R̄² (dD/dt)/D · [1 - 1/√(1 + 2V/(πR̄D²))]²
gap D, volume V, viscosity μ; R̄ = 2R₁R₂/(R₁+R₂), the radius of equal spheres""",
    provenance="the article not seen; derived anew from Reynolds' equation",
    damping_star=damping_star,
)
