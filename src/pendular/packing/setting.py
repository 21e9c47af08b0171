"""What a heap is wetted with: the liquid, contact angles by kind of grain, and the rules by which bridges form."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ask.face import rupture
from ..ask.liquid import Liquid
from ..ask.pair import Pair
from ..ground.check import angle, in_range, instance, one_of, scalar
from .heap import Packing
from .neighbours import Reach

__all__ = ["METHODS", "Setting", "reach_at", "setting_of"]

Floats = NDArray[np.float64]

METHODS = ("auto", "exact", "table")
_MARGIN = 1.05  # of the reach, over rupture distances at the ends of the ranges of radii and angles
_TOUCHING = 1e-9  # of the smallest radius: rounding of positions


class Setting(NamedTuple):
    """All that stays the same while suctions and amounts change."""

    heap: Packing
    liquid: Liquid
    angles: Floats  # contact angles, one a kind, [rad]
    kind: NDArray[np.int32]  # of each grain, then of each wall
    formation_distance: float  # [m]
    condensation: bool
    method: str
    radii: Floats  # of grains, then of walls, [m]

    @property
    def rounding(self) -> float:
        """Of a gap between grains that touch, [m]."""
        return _TOUCHING * float(self.heap.radii.min())

    def touching(self, gap: Floats) -> NDArray[np.bool_]:
        """Whether a gap is small enough for a bridge to form at once."""
        return np.asarray(gap <= self.formation_distance + self.rounding)


def setting_of(
    heap: Packing,
    contact_angle: ArrayLike,
    liquid: Liquid,
    formation_distance: float,
    condensation: bool,
    method: str,
) -> Setting:
    """Check what belongs to the heap as a whole."""
    instance("heap", heap, Packing)
    instance("liquid", liquid, Liquid)
    one_of("method", method, METHODS)
    if not isinstance(condensation, (bool, np.bool_)):
        raise ValueError(f"condensation: {condensation!r} is not True or False")
    film = in_range("formation_distance", scalar("formation_distance", formation_distance, "m"), 0.0, unit="m")
    given = angle("contact_angle", contact_angle)
    bodies = heap.count + len(heap.walls)
    if given.shape not in ((), (bodies,)):
        walls = f" and {len(heap.walls)} walls" if heap.walls else ""
        raise ValueError(
            f"contact_angle: an array of shape {given.shape} is not one angle nor one for each of "
            f"{heap.count} grains{walls}"
        )
    angles, kind = np.unique(np.broadcast_to(given, (bodies,)), return_inverse=True)
    radii = np.concatenate([heap.radii, np.full(len(heap.walls), np.inf)]) if heap.walls else heap.radii
    return Setting(heap, liquid, angles, kind.astype(np.int32), film, bool(condensation), method, radii)


def reach_at(setting: Setting, control: str, value: float) -> Reach:
    """Largest gap of a bridge between spheres at a suction, [Pa], or of a volume, [m³].

    Rupture distances grow with the radii and, under suction, fall with the contact angles; the ends of the range of
    angles and those between are asked all the same.
    """
    angles = np.unique(np.quantile(setting.angles, (0.0, 0.5, 1.0)))
    angle1, angle2 = (part.ravel() for part in np.meshgrid(angles, angles))

    def reach(radius1: Floats, radius2: Floats) -> Floats:
        pair = Pair((radius1[..., None], radius2[..., None]), (angle1, angle2))
        suction, volume = (value, None) if control == "suction" else (None, value)
        found = np.nan_to_num(rupture(pair, suction=suction, volume=volume, liquid=setting.liquid).separation)
        reached: Floats = np.maximum(_MARGIN * found.max(axis=-1), setting.formation_distance)
        return reached

    return reach
