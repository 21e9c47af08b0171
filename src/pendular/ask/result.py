"""What is known about a bridge, and its shape to draw."""

from dataclasses import dataclass, field, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..exact.batch import lay
from ..ground.check import in_range, whole_number
from .mesh import SHOWN_OF_A_PLANE, Mesh, Outline, meniscus_rings, outline_of_sphere, turned
from .shapes import Shape

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints = NDArray[np.int_]


class Profile(NamedTuple):
    """A bridge to draw, [m]: the axis is x, the facing poles of the solids lie at x = 0 and x = D."""

    x: Floats  # meridian, from the first solid to the second, points on the last axis
    y: Floats
    solid_x: Floats  # outlines for y >= 0: solids on the axis before the last
    solid_y: Floats


def _of(unit: str, meaning: str, *, private: bool = False) -> Any:
    return field(metadata={"unit": unit, "meaning": meaning}, repr=not private)


@dataclass(frozen=True, eq=False)
class Bridge:
    """Equilibrium bridges: every field a float, or an array of the shape that the arguments broadcast to.

    A quantity that belongs to a solid has a trailing axis of two. Where there is no bridge, ``force`` is exactly 0.0,
    ``exists`` and ``stable`` are False, and everything else is NaN.
    """

    separation: float | Floats = _of("m", "whole gap, surface to surface")
    suction: float | Floats = _of("Pa", "gas pressure minus liquid pressure")
    volume: float | Floats = _of("m^3", "liquid volume")
    force: float | Floats = _of("N", "capillary force, attraction positive")
    exists: bool | Bools = _of("", "a bridge exists at this separation and control")
    stable: bool | Bools = _of("", "stable under the given control, sideways too")
    unstable_directions: int | Ints = _of("", "axisymmetric directions in which the energy falls")
    sideways_stable: bool | Bools = _of("", "the liquid does not slip to one side")
    neck_radius: float | Floats = _of("m", "smallest radius of the surface")
    neck_inside: bool | Bools = _of("", "the neck lies between the solids")
    contact_radius: Floats = _of("m", "radius of the contact circle")
    half_filling_angle: Floats = _of("rad", "half-filling angle, 0 on a plane")
    liquid_gas_area: float | Floats = _of("m^2", "area of the meniscus")
    wetted_area: Floats = _of("m^2", "liquid-solid area")
    surface_energy: float | Floats = _of("J", "surface energy against dry solids")
    grand_potential: float | Floats = _of("J", "surface energy + suction x volume")
    stiffness: float | Floats = _of("N/m", "dF/dD with the given control held")
    capillary_tensor: Floats = _of("m^2", "integral of n n over the meniscus, (n11, n33), 3 along the axis")
    _meridian: Floats = _of("m", "radius and slope in the middle of the meridian, half its length", private=True)
    _solid_radius: Floats = _of("m", "radii of the solids", private=True)
    _surface_tension: float = _of("N/m", "surface tension", private=True)
    _shapes: tuple[Shape | None, Shape | None] = field(default=(None, None), repr=False)  # solids without a radius

    def profile(self, points: int = 201) -> Profile:
        """Meridian of the bridge and outlines of the solids, for drawing.

        Parameters
        ----------
        points : int
            Points on the meridian and on each outline, at least 3.

        Returns
        -------
        Profile
            Arrays of shape (..., points) and (..., 2, points), [m]; NaN where there is no bridge.

        Examples
        --------
        >>> import pendular as pl
        >>> grains = pl.Pair(radius=50e-6, contact_angle=0.0)
        >>> b = pl.bridge(grains, 1e-6, suction=20e3, liquid=pl.Liquid(surface_tension=0.0728))
        >>> bool(np.isclose(b.profile().y.min(), b.neck_radius))
        True
        """
        count = whole_number("points", points, 3)
        shape = np.shape(self.separation)
        meridian = self._meridian.reshape(-1, 3)
        curvature = np.ravel(np.asarray(self.suction) / self._surface_tension)
        x, y = lay(np.column_stack([meridian, curvature]), count)
        x, y = x.reshape(*shape, count), y.reshape(*shape, count)
        x = x - self._depth(0)[..., None]
        reach = SHOWN_OF_A_PLANE * self.contact_radius.max(axis=-1)
        outlines = [self._outline(solid, reach, count) for solid in (0, 1)]
        solid_x, solid_y = (np.stack(both, axis=-2) for both in zip(*outlines, strict=True))
        solid_x[..., 1, :] = np.asarray(self.separation)[..., None] - solid_x[..., 1, :]
        return Profile(x, y, solid_x, solid_y)

    def _depth(self, solid: int) -> Floats:
        """Depth of a contact circle behind the pole of its solid."""
        shape, radius = self._shapes[solid], self._solid_radius[..., solid]
        if shape is not None:
            return shape.line_depth(self.contact_radius[..., solid], self.wetted_area[..., solid])
        with np.errstate(invalid="ignore"):
            sagitta: Floats = 2.0 * radius * np.sin(0.5 * self.half_filling_angle[..., solid]) ** 2
        return np.where(np.isinf(radius), 0.0, sagitta)

    def _outline(self, solid: int, reach: Floats, count: int) -> tuple[Floats, Floats]:
        """Upper half of a solid with its facing pole at x = 0 and its body at x < 0; a plane is a line."""
        shape = self._shapes[solid]
        if shape is None:
            return _outline(self._solid_radius[..., solid], reach, count)
        depth, radius = shape.outline(reach, count)
        return -depth, radius

    def mesh(self, around: int = 96) -> Mesh:
        """Surfaces of the liquid and of both solids as triangles, to print, to show, or to start other programs with.

        Areas and the volume are those of the bridge to the second order of the length of an edge.

        Parameters
        ----------
        around : int
            Points of a ring about the axis, 8 to 1000; they set the size of all triangles.

        Returns
        -------
        Mesh
            Points, triangles, and the surface that each belongs to.

        Raises
        ------
        ValueError
            For an array of bridges, where there is none, and for solids that overlap, whose wetted surfaces cross.

        Examples
        --------
        >>> import pendular as pl
        >>> grains = pl.Pair(radius=50e-6, contact_angle=0.3)
        >>> b = pl.bridge(grains, 1e-6, volume=1e-15, liquid=pl.Liquid(surface_tension=0.0728))
        >>> mesh = b.mesh()
        >>> corners = mesh.points[mesh.triangles[mesh.surface < 3]]
        >>> bool(np.isclose(np.linalg.det(corners).sum() / 6.0, b.volume, rtol=1e-2))
        True
        """
        count = whole_number("around", around, 8)
        in_range("around", count, 8, 1000)
        if np.ndim(self.separation):
            raise ValueError(f"mesh: is made of one bridge, not of an array of shape {np.shape(self.separation)}")
        if not self.exists:
            raise ValueError("mesh: there is no bridge")
        if self.separation < 0.0:
            raise ValueError(
                f"separation: {self.separation:.6g} m is below 0: the wetted surfaces of a mesh would cross"
            )
        radius, _slope, half_length = self._meridian
        profile = self.profile(meniscus_rings(2.0 * half_length, radius, count))
        outlines = self._rings(0, count), self._rings(1, count)
        return turned(np.stack([profile.x, profile.y]), outlines, float(self.separation), count)

    def _rings(self, solid: int, around: int) -> Outline:
        """Rings of the mesh of a solid."""
        shape, contact = self._shapes[solid], float(self.contact_radius[solid])
        if shape is None:
            filling = float(self.half_filling_angle[solid])
            return outline_of_sphere(float(self._solid_radius[solid]), filling, contact, around)
        return shape.rings(contact, float(self.wetted_area[solid]), around)


def _outline(radius: Floats, plane_height: Floats, count: int) -> tuple[Floats, Floats]:
    """Upper half of a sphere with its facing pole at x = 0 and its body at x < 0; a plane is a line."""
    turn = np.linspace(0.0, np.pi, count)
    is_plane = np.isinf(radius)[..., None]
    finite = np.where(np.isinf(radius), 0.0, radius)[..., None]
    rise = plane_height[..., None] * np.linspace(0.0, 1.0, count)
    x = np.where(is_plane, 0.0, finite * (np.cos(turn) - 1.0))
    y = np.where(is_plane, rise, finite * np.sin(turn))
    return x, y


# The fields that a person reads, with their units: the one table behind the command line and the documentation.
FIELDS = tuple(
    (f.name, f.metadata["unit"], f.metadata["meaning"]) for f in fields(Bridge) if not f.name.startswith("_")
)
