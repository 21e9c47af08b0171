"""Solids of revolution that are neither spheres nor planes, in the place of a radius."""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..exact.solids.drawn import profile_of
from ..exact.solids.surface import CONE, DRAWN, EDGE, NO_PROFILE, PARABOLOID, RING, Profile
from ..ground.check import in_range, quantity, scalar
from .mesh import SHOWN_OF_A_PLANE, Outline, steps

__all__ = ["Cone", "Convex", "Disc", "Paraboloid", "Shape"]

Floats = NDArray[np.float64]

_SMOOTH = 1e-3  # slope of a spline at the axis, over the steepest, below which the tip is smooth
_SLACK = 1e-6  # of its second derivative, over the steepest slope and its reach


class Told(NamedTuple):
    """A solid as the solver is told of it, but for its contact angle."""

    kind: int
    size: Any  # a radius, [m]: that of its tip, where it has one; an array of those of spheres
    half_angle: float  # of a cone, [rad]


class Shape(ABC):
    """A solid of revolution with its tip on the axis, convex."""

    @property
    @abstractmethod
    def told(self) -> Told:
        """What the solver is told of it."""

    @property
    def profile(self) -> Profile:
        """Rows of its spline, where it is drawn, [m]."""
        return NO_PROFILE

    @property
    @abstractmethod
    def size(self) -> float:
        """A length of the solid, [m]; NaN if it has none."""

    @abstractmethod
    def depth(self, radius: Floats) -> Floats:
        """Depth of its surface behind the tip at distances from the axis, [m]."""

    def line_depth(self, radius: Floats, wetted: Floats) -> Floats:
        """Depth of a contact line of a radius and a wetted area behind the tip, [m]."""
        return self.depth(radius)

    def rings(self, radius: float, wetted: float, around: int) -> Outline:
        """Rings of a mesh inside and outside of a contact circle of a radius and a wetted area."""
        within = radius * np.linspace(0.0, 1.0, around // 6, endpoint=False)
        without = radius * np.exp(steps(0.0, math.log(SHOWN_OF_A_PLANE), around))
        return Outline(np.stack([self.depth(within), within]), np.stack([self.depth(without), without]))

    def outline(self, reach: Floats, points: int) -> tuple[Floats, Floats]:
        """Depths and radii of its surface from the tip out to a distance from the axis, on a further last axis."""
        radius = np.asarray(reach)[..., None] * np.linspace(0.0, 1.0, points)
        return self.depth(radius), radius


@dataclass(frozen=True)
class Cone(Shape):
    """A cone with its tip towards the other solid, sharp or rounded off by a sphere that touches it.

    Parameters
    ----------
    half_angle : float
        Between the axis and the surface, [rad], in (0, π/2]; π/2 is a plane. A pyramid is about the cone of the same
        cross-section at each height: tan β = tan α √(4/π) of a square one whose faces lie at α to the axis.
    tip_radius : float
        Radius of the sphere, [m]; 0, a sharp tip, if not given. The separation is that of the rounded tip.

    Raises
    ------
    ValueError
        If a value is out of range.

    Examples
    --------
    >>> import pendular as pl
    >>> probe = pl.Pair((pl.Cone(np.deg2rad(60), tip_radius=20e-9), np.inf), contact_angle=(0.5, 0.2))
    >>> water = pl.Liquid(surface_tension=0.0728)
    >>> print(f"{pl.bridge(probe, 1e-9, volume=1e-23, liquid=water).force:.4e} N")
    1.9898e-08 N
    """

    half_angle: float
    tip_radius: float = 0.0

    def __post_init__(self) -> None:
        angle = in_range(
            "half_angle", scalar("half_angle", self.half_angle, "rad"), 0.0, 0.5 * math.pi, brackets="(]", unit="rad",
            high_hint="for degrees use numpy.deg2rad({value})",
        )  # fmt: skip
        radius = in_range("tip_radius", scalar("tip_radius", self.tip_radius, "m"), 0.0, brackets="[)", unit="m")
        object.__setattr__(self, "half_angle", float(angle))
        object.__setattr__(self, "tip_radius", float(radius))

    @property
    def size(self) -> float:
        """Radius of its tip, [m]; NaN if it is sharp."""
        return self.tip_radius or math.nan

    @property
    def told(self) -> Told:
        """What the solver is told of it."""
        return Told(CONE, self.tip_radius, self.half_angle)

    def depth(self, radius: Floats) -> Floats:
        """Depth of its surface behind the tip at distances from the axis, [m]."""
        start = self.tip_radius * math.cos(self.half_angle)
        inside = np.minimum(radius, start)
        cap = self.tip_radius - np.sqrt(self.tip_radius**2 - inside**2)
        return cap + np.maximum(radius - start, 0.0) / math.tan(self.half_angle)


@dataclass(frozen=True)
class Paraboloid(Shape):
    """A paraboloid with its tip towards the other solid: the depth behind the tip is Y²/(2r).

    Parameters
    ----------
    tip_radius : float
        Radius r of curvature at the tip, [m], > 0.

    Raises
    ------
    ValueError
        If it is out of range.

    Examples
    --------
    >>> import pendular as pl
    >>> tip, ball = (pl.Pair((solid, np.inf), 0.3) for solid in (pl.Paraboloid(1e-6), 1e-6))
    >>> held = {"volume": 1e-24, "liquid": pl.Liquid(surface_tension=0.0728)}
    >>> bool(np.isclose(pl.bridge(tip, 0.0, **held).force, pl.bridge(ball, 0.0, **held).force, rtol=1e-2))
    True
    """

    tip_radius: float

    def __post_init__(self) -> None:
        radius = in_range("tip_radius", scalar("tip_radius", self.tip_radius, "m"), 0.0, brackets="()", unit="m")
        object.__setattr__(self, "tip_radius", float(radius))

    @property
    def size(self) -> float:
        """Radius of curvature at the tip, [m]."""
        return self.tip_radius

    @property
    def told(self) -> Told:
        """What the solver is told of it."""
        return Told(PARABOLOID, self.tip_radius, 0.0)

    def depth(self, radius: Floats) -> Floats:
        """Depth of its surface behind the tip at distances from the axis, [m]."""
        return radius * radius / (2.0 * self.tip_radius)


@dataclass(frozen=True)
class Disc(Shape):
    """The flat end of a cylinder.

    As a bridge grows it wets the face, is then pinned at the edge, at any angle between those at which it would recede
    over the face and advance over the side, and at last wets the side. On the sides of two discs at once it is not
    answered.

    Parameters
    ----------
    radius : float
        R, [m], > 0.
    pinned : bool
        Whether the line is held on the edge whatever the contact angle, as by a face that the liquid wets altogether
        and a side that it does not.

    Raises
    ------
    ValueError
        If the radius is out of range.

    Examples
    --------
    The catenoid between two rings ends at D = 1.32548684 R:

    >>> import pendular as pl
    >>> rings = pl.Pair(pl.Disc(1e-3, pinned=True))
    >>> print(f"{pl.rupture(rings, suction=0.0, liquid=pl.Liquid.water()).separation:.8e}")
    1.32548684e-03
    """

    radius: float
    pinned: bool = False

    def __post_init__(self) -> None:
        radius = in_range("radius", scalar("radius", self.radius, "m"), 0.0, brackets="()", unit="m")
        object.__setattr__(self, "radius", float(radius))
        if not isinstance(self.pinned, bool | np.bool_):
            raise ValueError(f"pinned: {self.pinned!r} is not True or False")

    @property
    def size(self) -> float:
        """Radius of the disc, [m]."""
        return self.radius

    @property
    def told(self) -> Told:
        """What the solver is told of it."""
        return Told(RING if self.pinned else EDGE, self.radius, 0.0)

    def depth(self, radius: Floats) -> Floats:
        """Depth of its face, 0."""
        return 0.0 * radius

    def line_depth(self, radius: Floats, wetted: Floats) -> Floats:
        """Depth of a contact line behind the face, [m]: on the side the area tells it."""
        depth: Floats = wetted / (2.0 * math.pi * self.radius) - 0.5 * self.radius
        return np.where(radius < self.radius * (1.0 - 1e-9), 0.0, np.maximum(depth, 0.0))

    def rings(self, radius: float, wetted: float, around: int) -> Outline:
        """Rings of a mesh inside and outside of a contact circle of a radius and a wetted area."""
        edge, behind = self.radius, float(self.line_depth(np.array(radius), np.array(wetted)))
        within = radius * np.linspace(0.0, 1.0, around // 6, endpoint=False)
        inner = np.stack([0.0 * within, within])
        if behind > 0.0:
            up = np.linspace(0.0, behind, 1 + math.ceil(behind / edge * around / 6), endpoint=False)
            inner = np.append(inner, np.stack([up, np.full_like(up, edge)]), axis=1)
        out = (
            radius * np.exp(steps(0.0, math.log(edge / radius), around))
            if radius < edge * (1.0 - 1e-9)
            else np.empty(0)
        )
        back = behind + edge * np.linspace(0.0, SHOWN_OF_A_PLANE, around // 3)[1:]
        return Outline(inner, np.append(np.stack([0.0 * out, out]), np.stack([back, np.full_like(back, edge)]), axis=1))

    def outline(self, reach: Floats, points: int) -> tuple[Floats, Floats]:
        """Depths and radii of the face and the side, as far back as a length."""
        way = np.linspace(0.0, 1.0, points)
        radius = np.broadcast_to(np.minimum(2.0 * way, 1.0) * self.radius, (*np.shape(reach), points))
        return np.asarray(reach)[..., None] * np.maximum(2.0 * way - 1.0, 0.0), radius


class Convex(Shape):
    """A convex solid of revolution by its own profile: a cubic spline through points of it.

    SciPy makes the spline: ``pip install "pendular[fit]"``. What is answered is the spline; many points of a smooth
    profile, a hundred or more, are as good as the profile itself. A slope at the axis of less than a thousandth of the
    steepest is taken for a smooth tip.

    Parameters
    ----------
    radius : array_like
        Distances from the axis, [m], from 0 on, increasing, at least four. No line lies beyond the last.
    depth : array_like or callable
        Depth of the surface behind the tip at each, [m], or the function that gives it.

    Raises
    ------
    ValueError
        Where the profile is concave or comes back towards the tip, naming the radius.

    Examples
    --------
    >>> import pendular as pl
    >>> lens = pl.Convex(np.linspace(0.0, 0.9e-3, 200), lambda y: 1e-3 - np.sqrt(1e-6 - y * y))
    >>> held = {"volume": 1e-11, "liquid": pl.Liquid.water()}
    >>> drawn, ball = (pl.bridge(pl.Pair((solid, np.inf), 0.3), 1e-5, **held) for solid in (lens, 1e-3))
    >>> bool(np.isclose(drawn.force, ball.force, rtol=1e-7))
    True
    """

    def __init__(self, radius: ArrayLike, depth: ArrayLike | Callable[[Floats], ArrayLike]) -> None:
        at = np.atleast_1d(quantity("radius", radius, "m"))
        if at.ndim != 1 or at.size < 4 or at[0] != 0.0 or np.any(np.diff(at) <= 0.0):
            raise ValueError("radius: is not a row of at least four increasing distances from the axis, from 0 on")
        given = quantity("depth", depth(at) if callable(depth) else depth, "m")
        if given.shape != at.shape:
            raise ValueError(f"depth: an array of shape {given.shape} is not one depth for each of {at.size} radii")
        self._spline = _spline_through(at, given)
        self._profile = profile_of(self._spline.x, self._spline.c)

    def __repr__(self) -> str:
        return f"Convex({len(self._profile)} points up to {self.size:g} m)"

    @property
    def size(self) -> float:
        """The last of its radii, [m]."""
        return float(self._profile[-1, 0])

    @property
    def told(self) -> Told:
        """What the solver is told of it: that its unit of length is a metre."""
        return Told(DRAWN, 1.0, 0.0)

    @property
    def profile(self) -> Profile:
        """Rows of its spline, [m]."""
        return self._profile

    def depth(self, radius: Floats) -> Floats:
        """Depth of its surface behind the tip at distances from the axis, [m]; beyond its end, that at the end."""
        found: Floats = self._spline(np.minimum(radius, self.size))
        return found

    def rings(self, radius: float, wetted: float, around: int) -> Outline:
        """Rings of a mesh inside and outside of a contact circle, out to the end of what is known."""
        whole = super().rings(radius, wetted, around)
        end = np.array([[float(self.depth(np.array(self.size)))], [self.size]])
        known = whole.outer[:, whole.outer[1] < self.size * (1.0 - 1e-9)]
        return Outline(whole.inner, np.append(known, end, axis=1) if radius < self.size else whole.outer)

    def outline(self, reach: Floats, points: int) -> tuple[Floats, Floats]:
        """Depths and radii of its surface from the tip to its end, or to a distance from the axis."""
        return super().outline(np.minimum(reach, self.size), points)


def _spline_through(radius: Floats, depth: Floats) -> Any:
    """Cubic spline of a profile, which has to be convex."""
    try:
        from scipy.interpolate import CubicSpline
    except ImportError:
        raise ImportError('Convex: a profile needs SciPy; pip install "pendular[fit]"') from None
    spline = CubicSpline(radius, depth - depth[0])
    steepest = max(abs(float(spline(radius[-1], 1))), 1e-300)
    at_axis = float(spline(0.0, 1))
    if at_axis < -_SMOOTH * steepest:
        raise ValueError(f"depth: comes back towards the tip at radius 0 m, where its slope is {at_axis:.3g}")
    if at_axis < _SMOOTH * steepest:
        spline = CubicSpline(radius, depth - depth[0], bc_type=((1, 0.0), "not-a-knot"))
    is_concave = spline(radius, 2) * radius[-1] < -_SLACK * steepest
    if np.any(is_concave):
        raise ValueError(
            f"depth: is concave at radius {radius[np.argmax(is_concave)]:.6g} m; smooth it, or leave it out"
        )
    return spline
