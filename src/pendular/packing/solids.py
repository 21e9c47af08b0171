"""What the grains themselves fill, and what is wrong with them."""

import numpy as np
from numpy.typing import NDArray

from .heap import Packing
from .neighbours import Neighbours

__all__ = ["check_overlaps", "pore_volume_of", "solid_volume_of"]

Floats = NDArray[np.float64]


def check_overlaps(heap: Packing, neighbours: Neighbours, numbers: NDArray[np.integer] | None = None) -> None:
    """Refuse grains in one place, and one inside another; ``numbers`` are their names if they have others."""
    overlap = np.flatnonzero(neighbours.gap < 0.0)
    i, j = neighbours.pairs[overlap].T
    between = j < heap.count
    overlap, i, j = overlap[between], i[between], j[between]
    distance = neighbours.gap[overlap] + heap.radii[i] + heap.radii[j]
    inside = np.flatnonzero(distance <= np.abs(heap.radii[i] - heap.radii[j]) + 1e-12 * heap.radii[i])
    if inside.size:
        pair = sorted((int(i[inside[0]]), int(j[inside[0]])), key=lambda grain: heap.radii[grain])
        small, large = pair if numbers is None else (int(numbers[grain]) for grain in pair)
        if distance[inside[0]] <= 1e-12 * heap.radii[pair[0]]:
            raise ValueError(f"positions: grains {small} and {large} have the same centre")
        raise ValueError(f"positions: grain {small} lies inside grain {large}")


def solid_volume_of(heap: Packing, neighbours: Neighbours) -> float:
    """Of all grains, [m³], with the lens of each overlap counted once and without caps behind a wall."""
    total = float(np.sum(4.0 / 3.0 * np.pi * heap.radii**3))
    overlap = np.flatnonzero(neighbours.gap < 0.0)
    depth = -neighbours.gap[overlap]
    i, j = neighbours.pairs[overlap].T
    at_wall = j >= heap.count
    caps = np.pi * depth[at_wall] ** 2 * (heap.radii[i[at_wall]] - depth[at_wall] / 3.0)
    r1, r2, h = heap.radii[i[~at_wall]], heap.radii[j[~at_wall]], depth[~at_wall]
    d = r1 + r2 - h
    lenses = np.pi * h**2 * (d**2 + 2.0 * d * (r1 + r2) - 3.0 * (r1 - r2) ** 2) / (12.0 * d)
    return total - float(np.sum(caps)) - float(np.sum(lenses))


def pore_volume_of(heap: Packing, solid_volume: float) -> float:
    """Of the cell without the grains, [m³]."""
    pores = heap.volume - solid_volume
    if not pores > 0.0:
        raise ValueError(
            f"heap: the grains fill {solid_volume:.6g} m^3 of a cell of {heap.volume:.6g} m^3; there are no pores"
        )
    return pores
