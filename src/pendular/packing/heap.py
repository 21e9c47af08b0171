"""A heap of grains: spheres in a cell, open or periodic, with walls."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import in_range, quantity, unmasked

__all__ = ["Packing", "PackingWarning", "Wall", "cell_of", "periodic_of", "wall_of"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_ROUNDING = 1e-9  # of an angle between a wall and a vector of the cell, [rad]


class PackingWarning(UserWarning):
    """A heap is asked for what its positions do not tell."""


class Wall(NamedTuple):
    """A plane that bounds a heap; grains meet it as one of infinite radius."""

    point: Floats  # (3,), on the wall, [m]
    normal: Floats  # (3,), towards the grains; its length does not matter


@dataclass(frozen=True, eq=False, repr=False)
class Packing:
    """Grains in a cell.

    Parameters
    ----------
    positions : array_like, (grains, 3)
        Centres, [m]; along a periodic direction they may lie outside the cell.
    radii : array_like, (grains,) or one number
        [m], > 0.
    cell : array_like, optional
        Three lengths of an upright box, or three vectors as rows of a matrix, [m]. Without a cell the heap is open, and
        the smallest upright box around the grains counts as its volume.
    periodic : bool or three of them
        Along which vectors of the cell the heap repeats.
    walls : sequence of Wall or (point, normal)
        Planes; the normal points towards the grains. A wall runs along all periodic directions.

    Raises
    ------
    ValueError
        For NaN, radii that are not positive, a flat cell, a wall across a periodic direction, a grain behind a wall.

    Examples
    --------
    >>> heap = Packing([(0, 0, 0), (1e-3, 1e-3, 1e-3)], 0.5e-3, cell=(2e-3, 2e-3, 2e-3))
    >>> heap
    Packing(2 grains of radius 0.0005 m, cell of 8e-09 m^3, periodic [True, True, True])
    """

    positions: Floats
    radii: Floats
    cell: Floats | None = None
    periodic: Bools = (True, True, True)  # type: ignore[assignment]  # any sequence of three is taken
    walls: tuple[Wall, ...] = ()

    def __post_init__(self) -> None:
        centres = _centres(self.positions)
        radii = in_range("radii", quantity("radii", self.radii, "m"), 0.0, brackets="(]", unit="m")
        if radii.shape not in ((), (len(centres),)):
            raise ValueError(
                f"radii: an array of shape {radii.shape} is not one radius for each of {len(centres)} grains"
            )
        cell = None if self.cell is None else cell_of(self.cell)
        periodic = periodic_of(self.periodic) if cell is not None else np.zeros(3, bool)
        walls = tuple(wall_of(i, wall, cell, periodic) for i, wall in enumerate(self.walls))
        checked = {
            "positions": np.ascontiguousarray(centres),
            "radii": np.full(len(centres), float(radii)) if radii.ndim == 0 else np.ascontiguousarray(radii),
            "cell": cell,
            "periodic": periodic,
            "walls": walls,
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        for i, wall in enumerate(walls):
            behind = np.flatnonzero((self.positions - wall.point) @ wall.normal <= 0.0)
            if behind.size:
                raise ValueError(
                    f"walls[{i}]: the centre of grain {behind[0]} lies behind it; the normal points to the grains"
                )

    def __repr__(self) -> str:
        radii = " to ".join(f"{radius:.4g}" for radius in np.unique([self.radii.min(), self.radii.max()]))
        cell = "no cell" if self.cell is None else f"cell of {self.volume:.4g} m^3, periodic {self.periodic.tolist()}"
        walls = f", walls {len(self.walls)}" if self.walls else ""
        return f"Packing({self.count} grains of radius {radii} m, {cell}{walls})"

    @property
    def count(self) -> int:
        """Number of grains."""
        return len(self.radii)

    @property
    def box(self) -> Floats:
        """Vectors of the cell, or of the smallest upright box around the grains, as rows, [m]."""
        if self.cell is not None:
            return self.cell
        reach = self.radii[:, None]
        return np.diag((self.positions + reach).max(axis=0) - (self.positions - reach).min(axis=0))

    @property
    def volume(self) -> float:
        """Of the cell, [m³]."""
        return abs(float(np.linalg.det(self.box)))

    def repeated(self, times: Sequence[int]) -> "Packing":
        """Heap of several cells, side by side.

        Parameters
        ----------
        times : three int
            Cells along each vector, at least 1; more than 1 only where the heap is periodic.

        Returns
        -------
        Packing

        Raises
        ------
        ValueError
            Without a cell, or along a direction that is not periodic.

        Examples
        --------
        >>> Packing([(0, 0, 0)], 1.0, cell=(2, 2, 2)).repeated((3, 3, 3)).count
        27
        """
        counts = np.asarray(times)
        if counts.shape != (3,) or counts.dtype.kind not in "iu" or np.any(counts < 1):
            raise ValueError(f"times: {times!r} is not three whole numbers from 1 on")
        if self.cell is None or np.any(counts[~self.periodic] > 1):
            raise ValueError(f"times: {times!r} repeats the heap where it is not periodic")
        steps = np.stack(np.meshgrid(*(np.arange(count) for count in counts), indexing="ij"), axis=-1).reshape(-1, 3)
        centres = (self.positions[None, :, :] + (steps @ self.cell)[:, None, :]).reshape(-1, 3)
        cell = counts[:, None] * self.cell
        return Packing(centres, np.tile(self.radii, len(steps)), cell, self.periodic, self.walls)


def _centres(positions: ArrayLike) -> Floats:
    centres = quantity("positions", positions, "m")
    if centres.ndim != 2 or centres.shape[1] != 3:
        raise ValueError(f"positions: an array of shape {centres.shape} is not of shape (grains, 3)")
    return centres


def cell_of(cell: ArrayLike) -> Floats:
    """Vectors of the cell as rows."""
    array = quantity("cell", cell, "m")
    if array.shape == (3,):
        array = np.diag(in_range("cell", array, 0.0, brackets="(]", unit="m"))
    if array.shape != (3, 3):
        raise ValueError(f"cell: an array of shape {array.shape} is not three lengths nor three vectors")
    lengths = np.linalg.norm(array, axis=1)
    if not abs(np.linalg.det(array)) > 1e-9 * np.prod(lengths):
        raise ValueError("cell: its three vectors lie in a plane")
    return array.copy()


def periodic_of(periodic: Any) -> Bools:
    """Which directions repeat."""
    array = np.asarray(unmasked("periodic", periodic))
    if array.dtype != np.bool_ or array.shape not in ((), (3,)):
        raise ValueError(f"periodic: {periodic!r} is not one or three of True and False")
    return np.broadcast_to(array, (3,)).copy()


def wall_of(i: int, wall: Any, cell: Floats | None, periodic: Bools) -> Wall:
    """Wall with a unit normal, along all periodic directions."""
    if not isinstance(wall, Sequence) or len(wall) != 2:
        raise ValueError(f"walls[{i}]: {wall!r} is not a point and a normal")
    point, normal = quantity(f"walls[{i}].point", wall[0], "m"), quantity(f"walls[{i}].normal", wall[1], "")
    length = float(np.linalg.norm(normal))
    if point.shape != (3,) or normal.shape != (3,) or length == 0.0:
        raise ValueError(f"walls[{i}]: {wall!r} is not a point and a normal of three numbers each, the latter not 0")
    unit = normal / length
    if cell is not None:
        across = np.abs(cell @ unit) > _ROUNDING * np.linalg.norm(cell, axis=1)
        crossed = np.flatnonzero(across & periodic)
        if crossed.size:
            raise ValueError(f"walls[{i}]: it stands across direction {crossed[0]} of the cell, which is periodic")
    return Wall(point, unit)
