"""What the ranks of a parallel run tell each other; without a world there is one rank."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["added_up", "first_failure", "gathered", "largest"]

Floats = NDArray[np.float64]


def gathered(world: Any, rows: Floats) -> Floats:
    """Rows of all ranks, in the order of the ranks."""
    if world is None:
        return rows
    counts = np.empty(world.size, np.int64)
    world.Allgather(np.array([rows.size], np.int64), counts)
    out = np.empty((int(counts.sum()) // rows.shape[1], rows.shape[1]))
    world.Allgatherv(np.ascontiguousarray(rows), [out, counts])
    return out


def added_up(world: Any, values: Floats) -> Floats:
    """Sum of the values of all ranks."""
    if world is None:
        return values
    out = np.empty_like(values)
    world.Allreduce(values, out)
    return out


def largest(world: Any, value: float) -> float:
    """Largest value of all ranks."""
    if world is None:
        return value
    from mpi4py import MPI

    out = np.empty(1)
    world.Allreduce(np.array([float(value)]), out, op=MPI.MAX)
    return float(out[0])


def first_failure(world: Any, failure: Exception | None) -> Exception:
    """Error of the first rank that has one."""
    failures = [failure] if world is None else world.allgather(failure)
    return next(error for error in failures if error is not None)
