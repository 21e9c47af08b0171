"""What the library knows about a published law besides its formula: one frozen record per law."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import inf, pi
from typing import Literal

__all__ = ["CONTACT_ANGLE", "GAP", "SEPARATION", "SIZE_RATIO", "SUCTION", "VOLUME", "Law", "Variable"]

Kernel = Callable[..., float]


@dataclass(frozen=True)
class Variable:
    """A quantity that a law depends on, with its hard limits.

    Outside the limits the law has no meaning and its kernels return NaN; a limit itself belongs to the range where the
    formula holds there.

    Parameters
    ----------
    name : str
        Name of the argument of the kernels; ``contact_angle`` stands for both angles.
    unit : str
        Unit, "-" for a reduced quantity.
    low, high : float
        Hard limits.
    text : str
        Meaning, one line.
    """

    name: str
    unit: str
    low: float
    high: float
    text: str


SEPARATION = Variable("separation_star", "-", -inf, inf, "whole gap, surface to surface, over the Derjaguin radius")
GAP = replace(SEPARATION, low=0.0)  # of a law that does not speak of overlapping solids
SUCTION = Variable("suction_star", "-", 0.0, inf, "suction times the Derjaguin radius over the surface tension")
VOLUME = Variable("volume_star", "-", 0.0, inf, "liquid volume over the cube of the Derjaguin radius")
CONTACT_ANGLE = Variable("contact_angle", "rad", 0.0, pi / 2, "contact angle on either solid, through the liquid")
SIZE_RATIO = Variable("size_ratio", "-", 1.0, inf, "larger over smaller radius, infinite for a plane")


@dataclass(frozen=True, eq=False, kw_only=True)
class Law:
    r"""A published closed form for the force, the rupture distance or the rupture work of a capillary bridge.

    All lengths are reduced by the Derjaguin radius :math:`\bar R = 2R_1R_2/(R_1+R_2)` and the separation is the whole
    gap, whatever the article uses. A size is given by :math:`\kappa_i = \bar R/R_i`: 1 and 1 for equal spheres, 2 and
    0 for a sphere on a plane.

    Parameters
    ----------
    name : str
        ``author_year``, the key of the registry.
    title : str
        One line for people.
    control : {"suction", "volume"}
        The quantity that is held while the solids move apart.
    variables : tuple of Variable
        What the law depends on, with hard limits.
    valid : mapping of str to (float, float)
        Range stated by the authors for each variable that they restrict, or, where their statement was not seen, the
        range for which the law was compared with exact bridges.
    valid_text : str
        The same for people, with joint conditions that a box cannot express; it tells which of the two the range is.
    angle_rule, size_rule : str
        What the law does with two different contact angles, and with two different solids.
    reference, doi, equations : str
        Source, and the numbers of its equations that are used.
    formula : str
        The law as plain text, a line for each equation, in the symbols of the source; the last line defines them.
    provenance : str
        How the formula came here.
    errata : tuple of str
        Known problems of the source.
    force_star : callable, optional
        ``force_star(separation_star, control_star, contact_angle1, contact_angle2, kappa1, kappa2)``: the force
        :math:`\lambda^* = F/(2\pi\gamma\bar R)`, attraction positive, exactly 0.0 beyond rupture, NaN outside the
        domain of the formula.
    rupture_star : callable, optional
        ``rupture_star(control_star, contact_angle1, contact_angle2, kappa1, kappa2)``: the largest separation at
        which a bridge exists, NaN outside the domain of the formula.
    rupture_work_star : callable, optional
        ``rupture_work_star(control_star, contact_angle1, contact_angle2, kappa1, kappa2)``: the work
        :math:`W/(2\pi\gamma\bar R^2)` of the capillary force from contact to rupture, NaN outside the domain of the
        formula.

    Examples
    --------
    >>> from pendular.laws import laws
    >>> laws["zhao2020"].control, laws["zhao2020"].gives
    ('suction', ('force', 'rupture'))
    """

    name: str
    title: str
    control: Literal["suction", "volume"]
    variables: tuple[Variable, ...]
    valid: Mapping[str, tuple[float, float]]
    valid_text: str
    angle_rule: str
    size_rule: str
    reference: str
    doi: str
    equations: str
    formula: str
    provenance: str
    errata: tuple[str, ...] = ()
    force_star: Kernel | None = None
    rupture_star: Kernel | None = None
    rupture_work_star: Kernel | None = None

    @property
    def gives(self) -> tuple[str, ...]:
        """The quantities that the law predicts, out of "force", "rupture" and "rupture_work"."""
        kernels = {"force": self.force_star, "rupture": self.rupture_star, "rupture_work": self.rupture_work_star}
        return tuple(quantity for quantity, kernel in kernels.items() if kernel is not None)
