"""What a table answers, for one contact: scalar kernels, to be called from compiled code of one's own.

A table is a set of cells, each with a polynomial. A cell is found without a logarithm or a search: the cells of a
coordinate are equal parts of the octaves of a number w, which are read off the bits of the floating-point number.
Octaves resolve what happens near w = 0. The three coordinates:

- the control c*: suction ΔpR̄/γ, or volume V/R̄³; w = c*. In a cell the polynomial is one of about log c*;
- the size u of a pair, with s = (R1 - R2)/(R1 + R2): s² under suction; |s|^(2/3) at constant volume, where equal
  spheres may lose their stability by sliding; |s| where the two contact angles differ; w = u₀ + u₁u;
- q = √(1 - D/D_c), 0 at rupture and 1 at contact; at constant volume √((1 - D/D_c)/(1 + D/d)), stretched as
  :mod:`pendular.exact.branch` tells; w = q₀ + q₁q.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..exact.branch import STRETCH
from ..ground.compile import kernel
from .polynomial import Cells, in_three, in_two, rate_in_three

__all__ = ["Grid", "energy", "force", "liquid", "rupture_distance", "stiffness"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# Columns of the two headers, one row for each part of an octave of the control; some rows share their cells.
X0, X1, U0, U1, Q0, Q1 = range(6)
U_SHIFT, U_FIRST, U_COUNT, Q_SHIFT, Q_FIRST, Q_COUNT, SIZE_CELLS, CELLS = range(8)

_MANTISSA = 52
_MANTISSA_BITS, _BITS_OF_ONE = (1 << _MANTISSA) - 1, 1023 << _MANTISSA
# Eight points of Gauss and Legendre are exact for the product of q and a polynomial of the seventh degree, and nearly
# so where the rate of D in q is a fraction.
POINTS = 8
_ABSCISSAE, _WEIGHTS = (tuple(each.tolist()) for each in np.polynomial.legendre.leggauss(POINTS))
_STRETCH = STRETCH * math.sqrt(2.0 / math.pi)  # d over R̄√c*
# About the third of the high half of the bits of a number are those of its cube root.
_THIRD, _CUBE_ROOT_BITS = 0x55555556, 0x2A9F789300000000
_LEAST_SQUARE = 1e-60  # of s; what is added is lost by rounding


class Grid(NamedTuple):
    """A table as compiled code sees it: the argument of all kernels."""

    lines: Floats  # (rows, 6): x₀, x₁ of the control from -1 to 1, then u₀, u₁, q₀, q₁
    cuts: Integers  # (rows, 8): how w is cut into cells, and the number of cells before those of the row
    rupture: Floats  # coefficients of D_c/R̄
    force: Cells  # of λ/R̄
    liquid: Cells  # of c*²V/R̄³ under suction, of √c* ΔpR̄/γ at constant volume, which vary slowly
    shift: int  # cut of the control
    first: int
    cells: int
    low: float  # range of the control
    high: float
    least_ratio: float  # range of the smaller radius over the larger
    largest_ratio: float
    sides: int  # 1 if the contact angles are equal; 2 if it matters which solid is the smaller
    is_volume: bool


class Reduced(NamedTuple):
    """Two solids and a control, reduced and kept inside the range of the table, where all cells lie."""

    radius: float  # R̄, NaN outside the range
    control: float  # c*
    size: float  # u
    side: int


class Place(NamedTuple):
    """Where a pair lies in the table."""

    row: int  # of the headers
    size_cell: int  # among all of the table
    x: float  # control in its cell, -1 to 1
    y: float  # size in its cell, -1 to 1


@kernel
def locate(w: float, shift: int, first: int) -> tuple[int, float]:
    """Cell of a number and the coordinate in it, from -1 to 1."""
    bits = np.float64(w).view(np.int64)
    within = ((bits << (_MANTISSA - shift)) & _MANTISSA_BITS) | _BITS_OF_ONE
    cell: int = (bits >> shift) - first  # type: ignore[assignment]
    place: float = 2.0 * np.int64(within).view(np.float64) - 3.0
    return cell, place


@kernel
def edge(cell: int, shift: int, first: int) -> float:
    """Lower end of a cell."""
    return np.int64((first + cell) << shift).view(np.float64)


@kernel
def within(number: float, low: float, high: float) -> float:
    """The number, or the end of the range next to it; a NaN goes to the low end."""
    from_low = number if number > low else low
    return from_low if from_low < high else high


@kernel
def cube_root(number: float) -> float:
    """Cube root of a positive number, to 14 digits: the same bits everywhere, which a library does not promise."""
    bits = np.float64(number).view(np.int64)
    third = ((bits >> 32) * _THIRD) >> 32
    root: float = np.int64((third << 32) + _CUBE_ROOT_BITS).view(np.float64)
    for _ in range(2):
        cube = root * root * root
        root = root * ((cube + 2.0 * number) / (2.0 * cube + number))
    return root


@kernel
def size_of(grid: Grid, s: float) -> float:
    """The size variable u of s = (R1 - R2)/(R1 + R2)."""
    if grid.sides == 2:
        return s
    return cube_root(s * s + _LEAST_SQUARE) if grid.is_volume else s * s


@kernel
def logarithmic(control: float, middle: float) -> float:
    """About a third of the logarithm of a control over the middle of its cell."""
    return (control - middle) * (control + middle) / (control * (control + 4.0 * middle) + middle * middle)


@kernel
def reduce_pair(grid: Grid, control: float, radius1: float, radius2: float, surface_tension: float) -> Reduced:
    """R̄, c* and u of a pair. It has no branches, so that the compiler makes vector instructions of a loop over it."""
    small = radius1 if radius1 < radius2 else radius2
    large = radius2 if radius1 < radius2 else radius1
    ratio = small / large
    inner = within(ratio, grid.least_ratio, grid.largest_ratio)
    share = 1.0 / (1.0 + inner)  # divisions are what the loop takes its time for
    radius = 2.0 * small * share
    reduced = control / (radius * radius * radius) if grid.is_volume else control / surface_tension * radius
    held = within(reduced, grid.low, grid.high)
    is_covered = (held == reduced) & (inner == ratio)
    return Reduced(
        radius if is_covered else math.nan,
        held,
        size_of(grid, (1.0 - inner) * share),
        1 if (grid.sides == 2) & (radius1 > radius2) else 0,
    )


@kernel
def place_of(grid: Grid, control: float, size: float, side: int) -> Place:
    """Cells and coordinates of the control and of the size.

    An unsigned row needs no test for an index from the end.
    """
    row = np.uint64(side * grid.cells + locate(control, grid.shift, grid.first)[0])
    w = grid.lines[row, U0] + grid.lines[row, U1] * size
    size_cell, y = locate(w, grid.cuts[row, U_SHIFT], grid.cuts[row, U_FIRST])
    x = grid.lines[row, X1] * logarithmic(control, grid.lines[row, X0])
    return Place(np.int64(row), size_cell + grid.cuts[row, SIZE_CELLS], x, y)  # type: ignore[arg-type]


@kernel
def bend_of(grid: Grid, control: float, rupture: float) -> float:
    """D_c/d of a reduced control and a rupture distance over R̄; 0 under suction, where q is not stretched."""
    return rupture / (_STRETCH * math.sqrt(control)) if grid.is_volume else 0.0


@kernel
def q_of(separation: float, rupture: float, bend: float) -> float:
    """√((1 - D/D_c)/(1 + D/d)), 0 beyond rupture or where none is known; solids that overlap count as touching."""
    share = (separation if separation > 0.0 else 0.0) / rupture
    inner = share if (share >= 0.0) & (share < 1.0) else 1.0  # never NaN: a cell is read at q
    left = 1.0 - inner
    # The compiler leaves the division out of a loop under suction.
    return math.sqrt(left if bend == 0.0 else left / (1.0 + bend * inner))


@kernel
def cell_of(grid: Grid, place: Place, q: float) -> tuple[int, float]:
    """Cell among all of the table at q, and the coordinate in it."""
    row = np.uint64(place.row)
    w = grid.lines[row, Q0] + grid.lines[row, Q1] * q
    q_cell, t = locate(w, grid.cuts[row, Q_SHIFT], grid.cuts[row, Q_FIRST])
    size_cell = place.size_cell - grid.cuts[row, SIZE_CELLS]
    return grid.cuts[row, CELLS] + size_cell * grid.cuts[row, Q_COUNT] + q_cell, t


@kernel
def ends_of(grid: Grid, row: int, cell: int) -> tuple[float, float]:
    """Where a cell begins and ends, in w of q."""
    cut = grid.cuts[row]
    q_cell = (cell - cut[CELLS]) % cut[Q_COUNT]
    return edge(q_cell, cut[Q_SHIFT], cut[Q_FIRST]), edge(q_cell + 1, cut[Q_SHIFT], cut[Q_FIRST])


@kernel
def gap_of(separation: float) -> float:
    """The separation, 0 in an overlap: solids hold no bridge there if D_c is 0, so that those in touch hold none."""
    return 0.0 if separation < 0.0 else separation


@kernel
def if_bridged(value: float, separation: float, rupture: float, beyond: float) -> float:
    """A value before rupture, another one beyond, NaN if one of the two lengths is NaN."""
    gap = gap_of(separation)
    other = beyond if gap >= rupture else math.nan
    return value if gap < rupture else other


@kernel
def rupture_star(grid: Grid, place: Place) -> float:
    """D_c/R̄."""
    return in_two(grid.rupture, place.size_cell, place.x, place.y)


class Found(NamedTuple):
    """A pair in the table."""

    pair: Reduced
    place: Place
    rupture: float  # D_c, [m]
    bend: float  # D_c/d


@kernel
def find(grid: Grid, control: float, radius1: float, radius2: float, surface_tension: float) -> Found:
    """Reduce a pair, and find where it lies in the table, and where its bridge breaks."""
    pair = reduce_pair(grid, control, radius1, radius2, surface_tension)
    place = place_of(grid, pair.control, pair.size, pair.side)
    rupture = rupture_star(grid, place)
    return Found(pair, place, pair.radius * rupture, bend_of(grid, pair.control, rupture))


@kernel
def rupture_distance(grid: Grid, control: float, radius1: float, radius2: float, surface_tension: float) -> float:
    """Separation at which the bridge breaks, [m]; 0 where there is none."""
    return find(grid, control, radius1, radius2, surface_tension).rupture


@kernel
def force(
    grid: Grid, separation: float, control: float, radius1: float, radius2: float, surface_tension: float
) -> float:
    """Attraction of two solids, [N]: 0 from the rupture distance on."""
    pair, place, rupture, bend = find(grid, control, radius1, radius2, surface_tension)
    if not gap_of(separation) < rupture:
        return 0.0 if gap_of(separation) >= rupture else math.nan
    cell, t = cell_of(grid, place, q_of(separation, rupture, bend))
    return 2.0 * math.pi * surface_tension * pair.radius * in_three(grid.force, cell, place.x, place.y, t)


@kernel
def liquid_unit(grid: Grid, control: float, radius: float, surface_tension: float) -> float:
    """Unit of the quantity that goes with the control: R̄³/c*² of a volume, γ/(R̄√c*) of a suction."""
    if grid.is_volume:
        return surface_tension / (radius * math.sqrt(control))
    return radius * radius * radius / (control * control)


@kernel
def liquid(
    grid: Grid, separation: float, control: float, radius1: float, radius2: float, surface_tension: float
) -> float:
    """Liquid volume under suction, [m³], or suction at constant volume, [Pa]; NaN where there is no bridge."""
    pair, place, rupture, bend = find(grid, control, radius1, radius2, surface_tension)
    if not gap_of(separation) < rupture:
        return math.nan
    cell, t = cell_of(grid, place, q_of(separation, rupture, bend))
    unit = liquid_unit(grid, pair.control, pair.radius, surface_tension)
    return unit * in_three(grid.liquid, cell, place.x, place.y, t)


@kernel
def t_rate(grid: Grid, row: int, cell: int, q: float, separation: float, rupture: float, bend: float) -> float:
    """Rate of the last coordinate of a cell in the separation: dq/dD = -(1 + D_c/d)/(2 q D_c (1 + D/d)²)."""
    low, high = ends_of(grid, row, cell)
    stretched = 1.0 + bend * (separation / rupture)
    q_rate = -0.5 * (1.0 + bend) / (q * rupture * stretched * stretched)
    return 2.0 / (high - low) * grid.lines[row, Q1] * q_rate


@kernel
def stiffness(
    grid: Grid, separation: float, control: float, radius1: float, radius2: float, surface_tension: float
) -> float:
    """Rate dF/dD with the control held, [N/m]: 0 in an overlap, as the force is that at contact; NaN without bridge."""
    pair, place, rupture, bend = find(grid, control, radius1, radius2, surface_tension)
    if not gap_of(separation) < rupture:
        return math.nan
    if separation < 0.0:
        return 0.0
    q = q_of(separation, rupture, bend)
    cell, t = cell_of(grid, place, q)
    rate = rate_in_three(grid.force, cell, place.x, place.y, t) * t_rate(
        grid, place.row, cell, q, separation, rupture, bend
    )
    return 2.0 * math.pi * surface_tension * pair.radius * rate


class Pieces(NamedTuple):
    """Cells between rupture and a place on the branch, in their order."""

    first: int  # at rupture
    last: int
    step: int  # from one to the next: cells count up or down with q


@kernel
def pieces_to(grid: Grid, place: Place, end: float) -> Pieces:
    """Cells from rupture to an end in q."""
    at_rupture, _ = cell_of(grid, place, 0.0)
    last, _ = cell_of(grid, place, end)
    return Pieces(at_rupture, last, 1 if grid.lines[place.row, Q1] > 0.0 else -1)


@kernel
def end_of_piece(grid: Grid, row: int, pieces: Pieces, cell: int, end: float) -> float:
    """Where a piece ends in q."""
    ends = ends_of(grid, row, cell)
    far = ends[1] if pieces.step > 0 else ends[0]
    return end if cell == pieces.last else (far - grid.lines[row, Q0]) / grid.lines[row, Q1]


@kernel
def work_point(grid: Grid, row: int, bend: float, low: float, high: float, point: int) -> tuple[float, float]:
    """Coordinate in a cell and weight of a point of the quadrature of ∫ λ* q (1 + b)/(1 + b q²)² dq, with b = D_c/d."""
    half = 0.5 * (high - low)
    q = 0.5 * (low + high) + half * _ABSCISSAE[point]
    _, t = locate(grid.lines[row, Q0] + grid.lines[row, Q1] * q, grid.cuts[row, Q_SHIFT], grid.cuts[row, Q_FIRST])
    bent = 1.0 + bend * q * q
    return t, half * _WEIGHTS[point] * q * (1.0 + bend) / (bent * bent)


@kernel
def _integral(grid: Grid, place: Place, bend: float, end: float) -> float:
    """∫ λ* q (1 + b)/(1 + b q²)² dq from rupture to an end, piece by piece."""
    pieces = pieces_to(grid, place, end)
    total, low = 0.0, 0.0
    for i in range(abs(pieces.last - pieces.first) + 1):
        cell = pieces.first + pieces.step * i
        high = end_of_piece(grid, place.row, pieces, cell, end)
        for point in range(POINTS):
            t, weight = work_point(grid, place.row, bend, low, high, point)
            total += weight * in_three(grid.force, cell, place.x, place.y, t)
        low = high
    return total


@kernel
def energy(
    grid: Grid, separation: float, control: float, radius1: float, radius2: float, surface_tension: float
) -> float:
    """Potential with F = dE/dD, [J]: minus the work that breaks the bridge, 0 from the rupture distance on.

    E(D) = -∫ F dD from D to D_c, with dD/dq = -2 D_c q (1 + b)/(1 + b q²)².
    """
    pair, place, rupture, bend = find(grid, control, radius1, radius2, surface_tension)
    if not gap_of(separation) < rupture:
        return 0.0 if gap_of(separation) >= rupture else math.nan
    unit = 2.0 * math.pi * surface_tension * pair.radius
    work = 2.0 * rupture * unit * _integral(grid, place, bend, q_of(separation, rupture, bend))
    overlap = -separation if separation < 0.0 else 0.0
    return -work - overlap * force(grid, 0.0, control, radius1, radius2, surface_tension)
