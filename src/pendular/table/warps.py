"""What a table answers, asked by a whole warp of a GPU: eight threads share a contact.

The formulas and their pieces are those of `kernels`; only the polynomials of the cells are worked out together.
"""

import math
from typing import Any, NamedTuple

from ..ground.device import cuda, types
from .kernels import (
    POINTS,
    Found,
    Grid,
    bend_of,
    cell_of,
    end_of_piece,
    gap_of,
    if_bridged,
    liquid_unit,
    pieces_to,
    place_of,
    q_of,
    reduce_pair,
    t_rate,
    work_point,
)
from .packed import WHOLE_WARP, Packed, lanes_in_three, lanes_in_two
from .polynomial import LANES, by_halves, rate_by_halves

__all__ = ["Pull", "energy", "force", "liquid", "pull", "rupture_distance", "stiffness"]


class Pull(NamedTuple):
    """What a bridge does to its solids."""

    force: float
    energy: float


@cuda.jit(device=True)
def _find(
    grid: Grid, packed: Packed, control: float, radius1: float, radius2: float, surface_tension: float, lanes: Any
) -> Found:
    pair = reduce_pair(grid, control, radius1, radius2, surface_tension)
    place = place_of(grid, pair.control, pair.size, pair.side)
    lanes_in_two(packed.rupture, place.size_cell, place.y, lanes)
    rupture = by_halves(lanes, place.x)
    return Found(pair, place, pair.radius * rupture, bend_of(grid, pair.control, rupture))


@cuda.jit(device=True)
def rupture_distance(
    grid: Grid,
    packed: Packed,
    separation: float,
    control: float,
    radius1: float,
    radius2: float,
    surface_tension: float,
) -> float:
    """Separation at which the bridge breaks, [m]; 0 where there is none."""
    lanes = cuda.local.array(LANES, types.float64)
    return _find(grid, packed, control, radius1, radius2, surface_tension, lanes).rupture


@cuda.jit(device=True)
def force(
    grid: Grid,
    packed: Packed,
    separation: float,
    control: float,
    radius1: float,
    radius2: float,
    surface_tension: float,
) -> float:
    """Attraction of two solids, [N]: 0 from the rupture distance on."""
    lanes = cuda.local.array(LANES, types.float64)
    pair, place, rupture, bend = _find(grid, packed, control, radius1, radius2, surface_tension, lanes)
    cell, t = cell_of(grid, place, q_of(separation, rupture, bend))
    lanes_in_three(packed.force, cell, place.x, place.y, lanes)
    value = 2.0 * math.pi * surface_tension * pair.radius * by_halves(lanes, t)
    return if_bridged(value, separation, rupture, 0.0)


@cuda.jit(device=True)
def liquid(
    grid: Grid,
    packed: Packed,
    separation: float,
    control: float,
    radius1: float,
    radius2: float,
    surface_tension: float,
) -> float:
    """Liquid volume under suction, [m³], or suction at constant volume, [Pa]; NaN where there is no bridge."""
    lanes = cuda.local.array(LANES, types.float64)
    pair, place, rupture, bend = _find(grid, packed, control, radius1, radius2, surface_tension, lanes)
    cell, t = cell_of(grid, place, q_of(separation, rupture, bend))
    lanes_in_three(packed.liquid, cell, place.x, place.y, lanes)
    value = liquid_unit(grid, pair.control, pair.radius, surface_tension) * by_halves(lanes, t)
    return if_bridged(value, separation, rupture, math.nan)


@cuda.jit(device=True)
def stiffness(
    grid: Grid,
    packed: Packed,
    separation: float,
    control: float,
    radius1: float,
    radius2: float,
    surface_tension: float,
) -> float:
    """Rate dF/dD with the control held, [N/m]; 0 in an overlap, NaN without bridge."""
    lanes = cuda.local.array(LANES, types.float64)
    pair, place, rupture, bend = _find(grid, packed, control, radius1, radius2, surface_tension, lanes)
    q = q_of(separation, rupture, bend)
    cell, t = cell_of(grid, place, q)
    lanes_in_three(packed.force, cell, place.x, place.y, lanes)
    if not gap_of(separation) < rupture:
        return math.nan
    if separation < 0.0:
        return 0.0
    rate = rate_by_halves(lanes, t) * t_rate(grid, place.row, cell, q, separation, rupture, bend)
    return 2.0 * math.pi * surface_tension * pair.radius * rate


@cuda.jit(device=True)
def pull(
    grid: Grid,
    packed: Packed,
    separation: float,
    control: float,
    radius1: float,
    radius2: float,
    surface_tension: float,
) -> Pull:
    """Attraction, [N], and potential, [J], both 0 from the rupture distance on.

    A cell's polynomial in the last variable, once known, serves all points of the quadrature in it.
    """
    lanes = cuda.local.array(LANES, types.float64)
    pair, place, rupture, bend = _find(grid, packed, control, radius1, radius2, surface_tension, lanes)
    end = q_of(separation, rupture, bend)
    pieces = pieces_to(grid, place, end)
    most = abs(pieces.last - pieces.first)
    total, low, piece = 0.0, 0.0, 0
    while cuda.any_sync(WHOLE_WARP, piece <= most):
        cell = pieces.first + pieces.step * min(piece, most)
        lanes_in_three(packed.force, cell, place.x, place.y, lanes)
        if piece <= most:
            high = end_of_piece(grid, place.row, pieces, cell, end)
            for point in range(POINTS):
                t, weight = work_point(grid, place.row, bend, low, high, point)
                total += weight * by_halves(lanes, t)
            low = high
        piece += 1
    unit = 2.0 * math.pi * surface_tension * pair.radius
    attraction = unit * by_halves(lanes, cell_of(grid, place, end)[1])
    work = 2.0 * rupture * unit * total + (gap_of(separation) - separation) * attraction
    return Pull(if_bridged(attraction, separation, rupture, 0.0), if_bridged(-work, separation, rupture, 0.0))


@cuda.jit(device=True)
def energy(
    grid: Grid,
    packed: Packed,
    separation: float,
    control: float,
    radius1: float,
    radius2: float,
    surface_tension: float,
) -> float:
    """Potential with F = dE/dD, [J]: minus the work that breaks the bridge, 0 from the rupture distance on."""
    return pull(grid, packed, separation, control, radius1, radius2, surface_tension).energy
