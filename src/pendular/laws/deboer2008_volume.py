r"""The work that breaks a bridge of constant volume, in the limit of small bridges.

P. C. T. de Boer and M. P. de Boer (2008) compare it with that of a bridge at constant suction, `deboer2008`, which is
half as large; the leading order given here was derived for this library.
"""

import math

from ..ground.compile import kernel
from ._domain import mean_cosine
from ._record import ANY_SOLIDS, Law
from ._symbols import CONTACT_ANGLE, SIZE_RATIO, VOLUME

__all__ = ["LAW", "rupture_work_star"]


@kernel
def rupture_work_star(
    volume_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    r"""Work of the capillary force from contact to rupture at fixed volume.

    .. math:: W = 2\gamma \cos\theta\, \sqrt{2\pi\bar R V}

    The exact work is 0.853, 0.954, 0.988 and 0.998 of it at V* = 1e-2, 1e-4, 1e-6 and 1e-8, for equal spheres and zero
    angle.

    >>> f"{rupture_work_star(1e-4, 0.0, 0.0, 1.0, 1.0):.6f}"
    '0.007979'
    """
    if not volume_star > 0.0:
        return math.nan
    return mean_cosine(contact_angle1, contact_angle2) * math.sqrt(2.0 * volume_star / math.pi)


LAW = Law(
    name="deboer2008_volume",
    title="Rupture work of small bridges of constant volume",
    control="volume",
    variables=(VOLUME, CONTACT_ANGLE, SIZE_RATIO),
    valid={"volume_star": (0.0, 1e-4), "contact_angle": (0.0, math.radians(40.0))},
    valid_text="a leading order; measured: within 5 % for volume_star <= 1e-4, angles up to 40 degrees",
    solids={"rupture_work": ANY_SOLIDS},
    reference="P. C. T. de Boer, M. P. de Boer, Langmuir 24 (2008) 160-169",
    formula="""\
W = 2γ cos θ √(2πR̄V)
volume V, R̄ = 2R₁R₂/(R₁+R₂), cos θ = (cos θ₁ + cos θ₂)/2""",
    provenance="leading order derived for this library, compared with exact bridges; the article, of which only "
    "the abstract was seen, has a fit over a range of curvatures that is not used",
    rupture_work_star=rupture_work_star,
)
