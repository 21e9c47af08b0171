"""Two solids on one axis."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import angle, broadcast, in_range, plain, quantity

Floats = NDArray[np.float64]
PerSolid = ArrayLike | tuple[ArrayLike, ArrayLike]


@dataclass(frozen=True, eq=False)
class Pair:
    """Two solids on one axis: spheres of any radii, a sphere and a plane, or two planes.

    Parameters
    ----------
    radius : array_like or tuple of two
        R, [m], > 0; ``inf`` is a plane. A tuple gives the two solids apart, anything else both at once; each value
        may be an array.
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

    radius: PerSolid
    contact_angle: PerSolid = 0.0

    def __post_init__(self) -> None:
        radii = _per_solid("radius", self.radius, _radius)
        _per_solid("contact_angle", self.contact_angle, angle)
        broadcast(**{"radius[0]": radii[0], "radius[1]": radii[1]})

    @property
    def radii(self) -> tuple[Floats, Floats]:
        """R of the first and of the second solid, [m]."""
        return _per_solid("radius", self.radius, _radius)

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


def _per_solid(name: str, value: PerSolid, check: Callable[[str, object], Floats]) -> tuple[Floats, Floats]:
    """Check a value that belongs to each solid: a tuple gives the two apart."""
    if not isinstance(value, tuple):
        both = check(name, value)
        return both, both
    if len(value) != 2:
        raise ValueError(f"{name}: a tuple of {len(value)} is not a pair (first solid, second solid)")
    return check(f"{name}[0]", value[0]), check(f"{name}[1]", value[1])


def _radius(name: str, value: object) -> Floats:
    return in_range(name, quantity(name, value, "m", allow_inf=True), 0.0, brackets="(]", unit="m")
