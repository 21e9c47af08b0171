"""The kernels of a table in loops over arrays.

Forces and what goes with them run in blocks that pass through the first cache several times. The compiler makes vector
instructions of the passes that are plain arithmetic, and the processor need not wait for one contact before it begins
with the next.
"""

import math

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import Own, copy_part, element, entry, over_rows
from . import kernels
from .kernels import Grid, Place, bend_of, cell_of, if_bridged, liquid_unit, place_of, q_of, reduce_pair
from .polynomial import in_three, in_two

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Operands = tuple[Floats, Floats, Floats, Floats, Floats]  # separation, control, radius 1, radius 2, surface tension

# What is asked.
FORCE, LIQUID, STIFFNESS, ENERGY, RUPTURE = range(5)

BLOCK = 64
_CHUNK = 65536  # contacts that one thread takes at a time


def block_room(contacts: int = BLOCK) -> tuple[Floats, Integers]:
    """Room for `answer_block`, for so many contacts at a time: numbers and cells."""
    return np.empty((13, contacts)), np.empty((3, contacts), np.int64)


@kernel
def answer_block(asked: int, grid: Grid, numbers: Floats, cells: Integers, count: int) -> None:
    """Forces, or what goes with them, of as many contacts as the first cache holds.

    The first five rows of the numbers are the operands, the last one is the answer; all are worked in.
    """
    separation, control, radius1, radius2, gamma = numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]
    size, radius, rupture, q, star = numbers[5], numbers[6], numbers[7], numbers[8], numbers[12]
    at_x, at_y, at_t = numbers[9], numbers[10], numbers[11]
    row, size_cell, cell = cells[0], cells[1], cells[2]
    coefficients = grid.force if asked == FORCE else grid.liquid
    beyond = 0.0 if asked == FORCE else math.nan
    for i in range(count):
        pair = reduce_pair(grid, control[i], radius1[i], radius2[i], gamma[i])
        control[i], size[i], row[i], radius[i] = pair.control, pair.size, pair.side, pair.radius
    for i in range(count):
        row[i], size_cell[i], at_x[i], at_y[i] = place_of(grid, control[i], size[i], row[i])
    for i in range(count):
        star[i] = in_two(grid.rupture, size_cell[i], at_x[i], at_y[i])
    for i in range(count):
        rupture[i] = radius[i] * star[i]
        q[i] = q_of(separation[i], rupture[i], bend_of(grid, control[i], star[i]))
    for i in range(count):
        cell[i], at_t[i] = cell_of(grid, Place(row[i], size_cell[i], at_x[i], at_y[i]), q[i])
    for i in range(count):
        star[i] = in_three(coefficients, cell[i], at_x[i], at_y[i], at_t[i])
    for i in range(count):
        if asked == FORCE:
            unit = 2.0 * math.pi * gamma[i] * radius[i]
        else:
            unit = liquid_unit(grid, control[i], radius[i], gamma[i])
        star[i] = if_bridged(unit * star[i], separation[i], rupture[i], beyond)


@entry(plain_cost=1e-4, patience=1.0)
def block_range(
    asked: int, grid: Grid, x: Operands, out: Floats, numbers: Floats, cells: Integers, start: int, stop: int
) -> None:
    """Forces, or what goes with them, of the contacts from start to stop, in blocks worked out in numbers and cells."""
    for begin in range(start, stop, BLOCK):
        count = min(BLOCK, stop - begin)
        for j, operand in enumerate(x):
            copy_part(operand, begin, numbers[j], 0, count)
        answer_block(asked, grid, numbers, cells, count)
        copy_part(numbers[-1], 0, out, begin, count)


@entry(plain_cost=1e-4, patience=1.0)
def scalar_range(asked: int, grid: Grid, x: Operands, out: Floats, start: int, stop: int) -> None:
    """Stiffnesses, energies or rupture distances of the contacts from start to stop."""
    for i in range(start, stop):
        control, radius1, radius2, gamma = element(x[1], i), element(x[2], i), element(x[3], i), element(x[4], i)
        if asked == RUPTURE:
            out[i] = kernels.rupture_distance(grid, control, radius1, radius2, gamma)
        elif asked == STIFFNESS:
            out[i] = kernels.stiffness(grid, element(x[0], i), control, radius1, radius2, gamma)
        else:
            out[i] = kernels.energy(grid, element(x[0], i), control, radius1, radius2, gamma)


def evaluate(asked: int, grid: Grid, x: tuple[Floats, ...], out: Floats) -> None:
    """Fill ``out`` with what is asked, on all threads; an operand of one element counts for all contacts."""
    if asked in (FORCE, LIQUID):
        room = Own(lambda: block_room()[0]), Own(lambda: block_room()[1])
        over_rows(block_range, out.size, _CHUNK, asked, grid, x, out, *room)
    else:
        over_rows(scalar_range, out.size, _CHUNK, asked, grid, x, out)
