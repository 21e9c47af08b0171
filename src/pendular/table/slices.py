"""The polynomial of a cell at one control and one pair: eight coefficients in q, for a bridge that is asked again."""

import numpy as np
from numpy.typing import NDArray

from .._jit import kernel
from .kernels import CELLS, Q0, Q1, Q_COUNT, Q_FIRST, Q_SHIFT, Grid, Place, cell_of, edge
from .polynomial import CELL, CONTROL_TERMS, LANES, LEAST_SIZE_TERMS

Floats = NDArray[np.float64]


@kernel
def slice_at(grid: Grid, place: Place, q: float, out: Floats) -> tuple[float, float]:
    """Coefficients of λ/R̄ in t, lowest power first, of the cell at q, and a and b of t = a + b q in it."""
    cell, _ = cell_of(grid, place, q)
    cut, line = grid.cuts[place.row], grid.lines[place.row]
    q_cell = (cell - cut[CELLS]) % cut[Q_COUNT]
    low = edge(q_cell, cut[Q_SHIFT], cut[Q_FIRST])
    scale = 2.0 / (edge(q_cell + 1, cut[Q_SHIFT], cut[Q_FIRST]) - low)
    row = cell * CELL
    of_y = np.empty(LANES)
    for k in range(LANES):
        out[k] = 0.0
    for i in range(CONTROL_TERMS):
        for k in range(LANES):
            of_y[k] = 0.0
        for _ in range(LEAST_SIZE_TERMS + i):
            for k in range(LANES):
                of_y[k] = of_y[k] * place.y + grid.force[row + k]
            row += LANES
        for k in range(LANES):
            out[k] = out[k] * place.x + of_y[k]
    return scale * (line[Q0] - low) - 1.0, scale * line[Q1]
