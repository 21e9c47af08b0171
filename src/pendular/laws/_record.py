"""What the library knows about a published law besides its formula: one frozen record per law."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from ._help import add_help_of
from ._refusals import refuse_contradictions
from ._symbols import Variable

__all__ = ["ANY_SOLIDS", "Kernel", "Law", "Quantity", "Solids"]

Kernel = Callable[..., Any]
Quantity = Literal["force", "rupture", "rupture_work", "damping"]

_QUANTITIES: tuple[Quantity, ...] = ("force", "rupture", "rupture_work", "damping")

_ANGLE_WORDS = {
    "any": "any two angles",
    "mean angle": "mean of two angles",
    "mean cosine": "mean cosine of two angles",
    "equal": "equal angles only",
    "zero": "zero angles only",
}
_SPHERE_WORDS = {"any": "any two spheres", "mean": "two equal spheres of the Derjaguin radius"}
_PLANE_WORDS = {"any": ", a sphere on a plane as it is", "mean": "", "none": ", no plane"}


@dataclass(frozen=True)
class Solids:
    """Of which two solids a law speaks, and what it makes of two that differ.

    A law is refused for solids of which it does not speak, and tells of a mean that it takes.

    Parameters
    ----------
    angles : {"any", "mean angle", "mean cosine", "equal", "zero"}
        Two contact angles: both as they are, one mean of them, or none that differ, or that differ from zero.
    spheres : {"any", "mean"}
        Two spheres: both as they are, or as two equal ones of the Derjaguin radius.
    plane : {"any", "mean", "none"}
        A sphere and a plane: as they are, as two equal spheres, or not at all.
    """

    angles: Literal["any", "mean angle", "mean cosine", "equal", "zero"]
    spheres: Literal["any", "mean"]
    plane: Literal["any", "mean", "none"]

    @property
    def angle_words(self) -> str:
        """What is made of two angles."""
        return _ANGLE_WORDS[self.angles]

    @property
    def size_words(self) -> str:
        """What is made of two sizes."""
        return _SPHERE_WORDS[self.spheres] + _PLANE_WORDS[self.plane]


ANY_SOLIDS = Solids("any", "any", "any")


@dataclass(frozen=True, eq=False, kw_only=True)
class Law:
    r"""A published closed form for the force, the rupture distance, the rupture work or the damping of a bridge.

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
    solids : mapping of str to Solids
        Of which two solids each of the quantities speaks that the law gives.
    reference, doi, equations : str
        Source, and the numbers of its equations that are used; empty for a source that has none.
    formula : str
        The law as plain text, a line for each equation, in the symbols of the source; the last line defines them.
    provenance : str
        How the formula came here.
    errata : tuple of str
        Known problems of the source.
    steps : mapping of callable to tuple of Variable
        Further functions that belong to the law, and what each returns.
    symbols : tuple of Variable
        Arguments of the steps that are neither shared by laws nor returned by a step.
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
    damping_star : callable, optional
        Of the arguments of ``force_star``: the viscous force over the rate of the gap, :math:`F_v/(\mu\bar R\dot D)`,
        attraction of solids that move apart, NaN outside the domain of the formula.

    Raises
    ------
    ValueError
        In one line, for a record that contradicts itself.

    Notes
    -----
    The functions take numbers and return one. They are plain Python or compiled by Numba with
    ``error_model="numpy"``. A plain one may raise ArithmeticError or ValueError for what is outside its domain, as
    ``math.log(-1.0)`` does. Their docstrings, and those of the steps, are completed from the record.

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
    solids: Mapping[Quantity, Solids]
    reference: str
    doi: str = ""
    equations: str = ""
    formula: str
    provenance: str = ""
    errata: tuple[str, ...] = ()
    steps: Mapping[Kernel, tuple[Variable, ...]] = field(default_factory=dict)
    symbols: tuple[Variable, ...] = ()
    force_star: Kernel | None = None
    rupture_star: Kernel | None = None
    rupture_work_star: Kernel | None = None
    damping_star: Kernel | None = None

    def __post_init__(self) -> None:
        refuse_contradictions(self)
        add_help_of(self)

    @property
    def kernels(self) -> dict[Quantity, Kernel]:
        """The functions that are given, by their quantities."""
        given = ((quantity, getattr(self, f"{quantity}_star")) for quantity in _QUANTITIES)
        return {quantity: kernel for quantity, kernel in given if kernel is not None}

    @property
    def gives(self) -> tuple[Quantity, ...]:
        """The quantities that the law predicts, out of "force", "rupture", "rupture_work" and "damping"."""
        return tuple(self.kernels)

    @property
    def angle_rule(self) -> str:
        """What the law does with two different contact angles, in words."""
        return _joined({quantity: solids.angle_words for quantity, solids in self.solids.items()})

    @property
    def size_rule(self) -> str:
        """What the law does with two different solids, in words."""
        return _joined({quantity: solids.size_words for quantity, solids in self.solids.items()})


def _joined(rules: Mapping[Quantity, str]) -> str:
    """Rule of a law, told once where it is that of all its quantities."""
    words = list(dict.fromkeys(rules.values()))
    if len(words) == 1:
        return words[0]
    return "; ".join(f"{quantity.replace('_', ' ')}: {rule}" for quantity, rule in rules.items())
