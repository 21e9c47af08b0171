"""A heap with gaps of all sizes, made of one whose grains touch."""

import numpy as np

from ..ground.check import in_range, instance, scalar, whole_number
from .heap import Packing

__all__ = ["loosened"]


def loosened(heap: Packing, strain: float, *, seed: int = 0) -> Packing:
    """Heap stretched in all directions, each grain moved at random as far as the stretch leaves room.

    With `Packing.repeated` it makes heaps of any size at once: a small random packing side by side, without the
    repetition of its gaps.

    Parameters
    ----------
    heap : Packing
        The grains.
    strain : float
        By which distances of centres grow; each grain then moves by up to as many of its radii.
    seed : int
        Of the moves.

    Returns
    -------
    Packing
        Gaps between touching grains are spread between 0 and twice the strain times the sum of their radii; no grains
        overlap that did not before.

    Raises
    ------
    ValueError
        For a strain outside of [0, 1].

    Examples
    --------
    >>> import pendular as pl
    >>> cell = pl.lattice_packing("simple_cubic", 10, 50e-6)
    >>> pl.loosened(cell.repeated((2, 2, 2)), 0.01, seed=1).count
    8000
    """
    instance("heap", heap, Packing)
    stretch = float(in_range("strain", scalar("strain", strain, ""), 0.0, 1.0))
    rng = np.random.default_rng(whole_number("seed", seed, 0))
    way = rng.normal(size=(heap.count, 3))
    way *= (np.cbrt(rng.random(heap.count)) * stretch * heap.radii / np.linalg.norm(way, axis=1))[:, None]
    cell = None if heap.cell is None else heap.cell * (1.0 + stretch)
    return Packing(heap.positions * (1.0 + stretch) + way, heap.radii, cell, heap.periodic)
