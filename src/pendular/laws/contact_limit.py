r"""The force of an infinitely small bridge between touching solids, the number that every law should tend to."""

import math

from ..ground.compile import kernel
from ._domain import mean_cosine
from ._record import ANY_SOLIDS, Law
from ._symbols import CONTACT_ANGLE, GAP, SIZE_RATIO, SUCTION

__all__ = ["LAW", "force_star"]


@kernel
def force_star(
    separation_star: float,
    suction_star: float,
    contact_angle1: float,
    contact_angle2: float,
    kappa1: float,
    kappa2: float,
) -> float:
    r"""Force at contact in the limit of infinite suction, or of no volume.

    .. math:: F = 2\pi\gamma\bar R\, \tfrac12 (\cos\theta_1 + \cos\theta_2)

    NaN off contact, of which the limit says nothing. Against exact bridges of equal spheres the limit is 0.56 to 0.72 %
    too large at H* = 1e4 and 5.5 to 7.0 % at H* = 100, for angles of 0 to 40 degrees.

    >>> force_star(0.0, 1e4, 0.0, 0.0, 1.0, 1.0)  # exact: 0.9945
    1.0
    >>> force_star(1e-6, 1e4, 0.0, 0.0, 1.0, 1.0)
    nan
    """
    if not (separation_star == 0.0 and suction_star >= 0.0):
        return math.nan
    return mean_cosine(contact_angle1, contact_angle2)


LAW = Law(
    name="contact_limit",
    title="Limit of small bridges at contact",
    control="suction",
    variables=(GAP, SUCTION, CONTACT_ANGLE, SIZE_RATIO),
    valid={
        "separation_star": (0.0, 0.0),
        "suction_star": (1e4, math.inf),
        "contact_angle": (0.0, math.radians(40.0)),
    },
    valid_text="a limit, at contact only; measured: within 0.8 % for suction_star >= 1e4, angles up to 40 degrees",
    solids={"force": ANY_SOLIDS},
    reference="the limit of the exact solution",
    formula="""\
F = 2πγR̄ (cos θ₁ + cos θ₂)/2  at D = 0
R̄ = 2R₁R₂/(R₁+R₂)""",
    provenance="exact limit, compared with exact bridges",
    errata=("With R₁R₂/(R₁+R₂) in place of R̄ the factor is 4π, not 2π.",),
    force_star=force_star,
)
