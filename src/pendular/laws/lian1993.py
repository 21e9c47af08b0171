r"""Lian, Thornton and Adams (1993): the rupture distance of a bridge of given volume."""

import math

from ..ground.compile import kernel
from ._domain import mean_angle
from ._record import Law, Solids
from ._symbols import CONTACT_ANGLE, SIZE_RATIO, VOLUME

__all__ = ["LAW", "rupture_star"]


@kernel
def rupture_star(
    volume_star: float, contact_angle1: float, contact_angle2: float, kappa1: float, kappa2: float
) -> float:
    r"""Rupture distance at fixed volume, whatever the sizes of the solids.

    .. math:: D_c = (1 + \theta/2)\, V^{1/3}

    Against the end of stability of exact bridges of equal spheres, V* = 1e-4 to 0.1: 0.5 to 4.9 % too small at zero
    angle, -4.3 to +3.3 % up to 40 degrees. A sphere on a plane at zero angle: within 3.8 % up to V = 0.01 of the cube
    of its radius.

    >>> f"{rupture_star(1e-3, 0.0, 0.0, 1.0, 1.0):.5f}"  # exact: 0.10083
    '0.10000'
    """
    if not volume_star > 0.0:
        return math.nan
    return (1.0 + 0.5 * mean_angle(contact_angle1, contact_angle2)) * volume_star ** (1.0 / 3.0)


LAW = Law(
    name="lian1993",
    title="Rupture distance of Lian, Thornton and Adams",
    control="volume",
    variables=(VOLUME, CONTACT_ANGLE, SIZE_RATIO),
    valid={"volume_star": (0.0, 0.1), "contact_angle": (0.0, math.radians(40.0))},
    valid_text="the statement of the authors was not seen; measured: within 5 % for volume_star <= 0.1, angles up to "
    "40 degrees",
    solids={"rupture": Solids("mean angle", "mean", "mean")},
    reference="G. Lian, C. Thornton, M. J. Adams, Journal of Colloid and Interface Science 161 (1993) 138-147",
    formula="""\
D_c = (1 + θ/2) V^(1/3)
gap D_c, volume V""",
    provenance="transcribed from published source code, the article not seen; compared with exact bridges",
    errata=("A transcription with the product instead of the mean of two contact angles was in circulation.",),
    rupture_star=rupture_star,
)
