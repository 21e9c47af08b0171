r"""The work that breaks a bridge at constant suction, in the limit of small bridges.

P. C. T. de Boer and M. P. de Boer (2008) compare it with that of a bridge of constant volume, `deboer2008_volume`,
which is twice as large; the leading order given here was derived for this library.
"""

import math

from ..ground.compile import kernel
from ._domain import mean_cosine
from ._record import ANY_SOLIDS, Law
from ._symbols import CONTACT_ANGLE, SIZE_RATIO, SUCTION

__all__ = ["LAW", "rupture_work_star"]


@kernel
def rupture_work_star(
    suction_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    r"""Work of the capillary force from contact to rupture at fixed suction.

    .. math:: W = 2\pi\gamma\bar R^2 \cos^2\theta / H

    The exact work is 0.159, 0.525, 0.814, 0.979 and 0.998 of it at H* = 1, 10, 100, 1e4 and 1e6, for equal spheres and
    zero angle.

    >>> rupture_work_star(100.0, 0.0, 0.0, 1.0, 1.0)
    0.01
    """
    if not suction_star > 0.0:
        return math.nan
    return mean_cosine(contact_angle1, contact_angle2) ** 2 / suction_star


LAW = Law(
    name="deboer2008",
    title="Rupture work of small bridges at constant suction",
    control="suction",
    variables=(SUCTION, CONTACT_ANGLE, SIZE_RATIO),
    valid={"suction_star": (1e4, math.inf), "contact_angle": (0.0, math.radians(40.0))},
    valid_text="a leading order; measured: within 3 % for suction_star >= 1e4, angles up to 40 degrees",
    solids={"rupture_work": ANY_SOLIDS},
    reference="P. C. T. de Boer, M. P. de Boer, Langmuir 24 (2008) 160-169",
    formula="""\
W = 2πγR̄² cos²θ/H
suction H reduced by R̄ = 2R₁R₂/(R₁+R₂), cos θ = (cos θ₁ + cos θ₂)/2""",
    provenance="leading order derived for this library, compared with exact bridges; the article, of which only "
    "the abstract was seen, has a fit over a range of curvatures that is not used",
    rupture_work_star=rupture_work_star,
)
