"""The symbols that laws share: the name, the unit and the meaning of each, and its hard limits."""

from dataclasses import dataclass, replace
from math import inf, pi

__all__ = [
    "ANSWERS",
    "CONTACT_ANGLE",
    "CONTROL",
    "GAP",
    "LAW_NAME",
    "SEPARATION",
    "SHARED",
    "SIZE_RATIO",
    "SUCTION",
    "VOLUME",
    "Variable",
    "arguments",
]


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
    text : str
        Meaning, one line.
    low, high : float
        Hard limits, none if nothing else is said.
    """

    name: str
    unit: str
    text: str
    low: float = -inf
    high: float = inf


SEPARATION = Variable("separation_star", "-", "whole gap, surface to surface, over the Derjaguin radius")
GAP = replace(SEPARATION, low=0.0)  # of a law that does not speak of overlapping solids
SUCTION = Variable("suction_star", "-", "suction times the Derjaguin radius over the surface tension", 0.0)
VOLUME = Variable("volume_star", "-", "liquid volume over the cube of the Derjaguin radius", 0.0)
CONTACT_ANGLE = Variable("contact_angle", "rad", "contact angle on either solid, through the liquid", 0.0, pi / 2)
SIZE_RATIO = Variable("size_ratio", "-", "larger over smaller radius, infinite for a plane", 1.0)
KAPPA = Variable("kappa", "-", "Derjaguin radius over the radius of either solid, 0 for a plane", 0.0, 2.0)
CONTROL = Variable("control_star", "-", "the suction or the volume, reduced, whichever the law holds", 0.0)
LAW_NAME = Variable("law", "", "name in the registry, or a record of its own")

# Arguments of kernels by their names.
SHARED = {symbol.name: symbol for symbol in (SEPARATION, SUCTION, VOLUME, CONTACT_ANGLE, KAPPA)} | {
    "contact_angle1": CONTACT_ANGLE,
    "contact_angle2": CONTACT_ANGLE,
    "kappa1": KAPPA,
    "kappa2": KAPPA,
}

# What kernels give, by the names of the quantities.
ANSWERS = {
    "force": Variable("force_star", "-", "force over 2πγ times the Derjaguin radius, attraction positive"),
    "rupture": Variable("rupture_star", "-", "whole gap at rupture over the Derjaguin radius", 0.0),
    "rupture_work": Variable(
        "rupture_work_star", "-", "work from contact to rupture over 2πγ times the square of that radius", 0.0
    ),
    "damping": Variable(
        "damping_star", "-", "viscous force over the rate of the gap, the viscosity and the Derjaguin radius", 0.0
    ),
}


def arguments(quantity: str, control: str) -> tuple[str, ...]:
    """Arguments of the function of a law for a quantity, in their order."""
    common = (f"{control}_star", "contact_angle1", "contact_angle2", "kappa1", "kappa2")
    return ("separation_star", *common) if quantity in ("force", "damping") else common
