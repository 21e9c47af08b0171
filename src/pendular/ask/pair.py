"""Two solids on one axis."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import angle, broadcast, in_range, plain, quantity
from .shapes import Shape

Floats = NDArray[np.float64]
PerSolid = ArrayLike | tuple[ArrayLike, ArrayLike]
Checked = TypeVar("Checked")
Solids = ArrayLike | Shape | tuple[ArrayLike | Shape, ArrayLike | Shape]


@dataclass(frozen=True, eq=False)
class Pair:
    """Two solids on one axis: spheres of any radii, planes, cones, paraboloids, and the flat ends of cylinders.

    Parameters
    ----------
    radius : array_like, Cone, Paraboloid, Disc, or tuple of two
        R, [m], > 0; ``inf`` is a plane. A tuple gives the two solids apart, anything else both at once; each value
        may be an array. Another solid takes the place of a radius.
    contact_angle : array_like or tuple of two
        θ through the liquid, [rad], in [0, π); 0, a liquid that wets all, if not given.

    Raises
    ------
    ValueError
        If a value is out of range.

    Examples
    --------
    >>> Pair(radius=50e-6, contact_angle=np.deg2rad(20)).derjaguin_radius
    5e-05
    >>> [float(angle) for angle in Pair(50e-6).contact_angles]
    [0.0, 0.0]
    >>> float(Pair(radius=(50e-6, np.inf), contact_angle=(0.35, 0.0)).derjaguin_radius)
    0.0001
    """

    radius: Solids
    contact_angle: PerSolid = 0.0

    def __post_init__(self) -> None:
        _per_solid("contact_angle", self.contact_angle, angle)
        radii = [solid for solid in self.solids if not isinstance(solid, Shape)]
        broadcast(**{f"radius[{i}]": radius for i, radius in enumerate(radii)})

    @property
    def solids(self) -> tuple[Floats | Shape, Floats | Shape]:
        """The first and the second solid: a radius, [m], or another shape."""
        return _per_solid("radius", self.radius, _solid)

    @property
    def shape(self) -> Shape | None:
        """The first of its solids that is neither a sphere nor a plane, if there is one."""
        given = self.radius if isinstance(self.radius, tuple) else (self.radius,)
        return next((solid for solid in given if isinstance(solid, Shape)), None)

    @property
    def radii(self) -> tuple[Floats, Floats]:
        """R of the first and of the second solid, [m]."""
        first, second = self.solids
        if isinstance(first, Shape) or isinstance(second, Shape):
            raise ValueError(
                f"radius: {self.shape} is neither a sphere nor a plane; bridge, rupture and curve know it, by the "
                "method 'exact', and nothing else does"
            )
        return first, second

    @property
    def contact_angles(self) -> tuple[Floats, Floats]:
        """θ on the first and on the second solid, [rad]."""
        return _per_solid("contact_angle", self.contact_angle, angle)

    @property
    def derjaguin_radius(self) -> float | Floats:
        """R̄ = 2 R1 R2/(R1 + R2), [m]: R for equal spheres, 2R for a sphere and a plane, infinite for two planes."""
        first, second = self.radii
        with np.errstate(divide="ignore"):
            mean: float | Floats = plain(2.0 / (1.0 / first + 1.0 / second))
        return mean


def check_pair(pair: object) -> None:
    """Refuse what is not a pair, such as a radius alone.

    Examples
    --------
    >>> check_pair(50e-6)
    Traceback (most recent call last):
        ...
    ValueError: pair: 5e-05 is not a pendular.Pair; write Pair(radius) or Pair(radius, contact_angle)
    """
    if not isinstance(pair, Pair):
        raise ValueError(f"pair: {pair!r} is not a pendular.Pair; write Pair(radius) or Pair(radius, contact_angle)")


def has_planes(pair: Pair) -> bool:
    """Whether both solids are planes, somewhere.

    Examples
    --------
    >>> has_planes(Pair((1.0, [1.0, np.inf]))), has_planes(Pair(np.inf))
    (False, True)
    """
    return math.isinf(np.minimum(*pair.radii).max())


def refuse_planes(pair: Pair, unknown: str) -> None:
    """Refuse two planes, with who does not know them.

    Examples
    --------
    >>> refuse_planes(Pair(np.inf), "method 'table' does not know")
    Traceback (most recent call last):
        ...
    ValueError: radius: inf and inf are two planes, which method 'table' does not know; method 'exact' does
    """
    if has_planes(pair):
        raise ValueError(f"radius: inf and inf are two planes, which {unknown}; method 'exact' does")


def _per_solid(name: str, value: Any, check: Callable[[str, object], Checked]) -> tuple[Checked, Checked]:
    """Check a value that belongs to each solid: a tuple gives the two apart."""
    if not isinstance(value, tuple):
        both = check(name, value)
        return both, both
    if len(value) != 2:
        raise ValueError(f"{name}: a tuple of {len(value)} is not a pair (first solid, second solid)")
    return check(f"{name}[0]", value[0]), check(f"{name}[1]", value[1])


def _solid(name: str, value: object) -> Floats | Shape:
    return value if isinstance(value, Shape) else _radius(name, value)


def _radius(name: str, value: object) -> Floats:
    return in_range(name, quantity(name, value, "m", allow_inf=True), 0.0, brackets="(]", unit="m")
