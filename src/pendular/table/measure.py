"""The error of a table, measured on exact bridges that it was not made from."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._jit import in_chunks
from .arrays import FORCE, LIQUID, RUPTURE, block_range, scalar_range
from .kernels import Grid
from .samples import exact_curves
from .task import Task

Floats = NDArray[np.float64]

_SUCTION_CURVES, _VOLUME_CURVES = 4000, 1000
_SEED = 20260
_NEAREST_RUPTURE = 0.002  # in q: 1 - D/D_c = 4e-6
_CHUNK = 65536


class Bound(NamedTuple):
    """Largest errors found."""

    force: float  # over the force at contact, up to 1 - D/D_c = 4e-6
    rupture: float  # of the rupture distance, relative
    liquid: float  # of volume or suction, over that at contact
    bridges: int  # number of bridges that were compared


def measure(grid: Grid, task: Task) -> Bound:
    """Compare a table with exact bridges at random controls, sizes and separations."""
    random = np.random.default_rng(_SEED)
    count = _VOLUME_CURVES if task.is_volume else _SUCTION_CURVES
    low, high = task.sizes
    near_contact = 1.0 - 10.0 ** random.uniform(-3.5, -1.0, 4)  # where the force of a small volume falls fast
    q = np.concatenate([[_NEAREST_RUPTURE, 1.0], random.uniform(_NEAREST_RUPTURE, 1.0, 6), near_contact])
    worst = np.zeros(3)
    for side in range(task.sides):
        control = np.exp(random.uniform(math.log(task.low), math.log(task.high), count))
        share = random.uniform(0.0, 1.0, count)
        share[::4] = 1.0 - 10.0 ** random.uniform(-6.0, 0.0, share[::4].size)  # next to the largest ratio
        share[1::8] = 0.0
        control[:4], share[:4] = np.repeat([task.low, task.high], 2), [0.0, 1.0, 0.0, 1.0]  # and at the corners
        size = low + (high - low) * share
        worst = np.maximum(worst, _errors(grid, task, control, size, side, q))
    force, rupture, liquid = worst.tolist()
    return Bound(force, rupture, liquid, task.sides * count * q.size)


def _errors(grid: Grid, task: Task, control: Floats, size: Floats, side: int, q: Floats) -> Floats:
    """Largest errors of force, rupture distance and liquid on curves at random q, contact being the second."""
    exact = exact_curves(task, control, size, side, q)
    s = np.sqrt(size) if task.sides == 1 else size
    with np.errstate(divide="ignore"):
        radii = (1.0 / (1.0 + s), 1.0 / (1.0 - s))  # of R̄ = 1
    radius1, radius2 = radii if side == 0 else radii[::-1]
    gap = exact.rupture[:, None] * (1.0 - q * q)
    shape, one = gap.shape, np.ones(1)

    def answer(asked: int, columns: int) -> Floats:
        each = [np.repeat(operand, columns) for operand in (control, radius1, radius2)]
        out = np.empty(control.size * columns)
        loop = scalar_range if asked == RUPTURE else block_range
        in_chunks(loop, out.size, _CHUNK, asked, grid, (gap[:, :columns].ravel(), *each, one), out)
        return out.reshape(-1, columns)

    force, liquid = answer(FORCE, shape[1]) / (2.0 * math.pi), answer(LIQUID, shape[1])
    at_contact = exact.values[:, 1:2]
    of_force = np.abs(force - exact.values[..., 0]) / at_contact[..., 0]
    of_liquid = np.abs(liquid - exact.values[..., 1]) / np.abs(at_contact[..., 1])
    of_rupture = np.abs(answer(RUPTURE, 1)[:, 0] / exact.rupture - 1.0)
    return np.array([errors.max() for errors in (of_force, of_rupture, of_liquid)])
