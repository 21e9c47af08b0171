"""Random packings: grains that grow in a periodic cube until they jam, then shrink until they barely touch."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import in_range, quantity, scalar, whole_number
from ..ground.compile import compiled
from .heap import Packing
from .neighbours import find_neighbours
from .settling import LOOSE, STALE, settle

__all__ = ["random_packing"]

Floats = NDArray[np.float64]

_FEWEST = 50  # grains that do not meet their own images
_FIRST_FRACTION = 0.3  # of solid, where growth starts
_FIRST_GROWTH = 0.01  # of the radii in a step
# Without friction and with it: mean overlap of contacts over the mean radius, at the end; part of the overlap that a
# step back takes; part of the load left after it. Contacts that slide let a heap go sooner.
_SMOOTH, _ROUGH = (2e-6, 0.7, 0.5), (1e-4, 0.4, 0.65)
_LOAD = 0.1  # overlaps a grain that are left of a step of growth where grains found room
_SKIN = 0.3  # of the median radius
_TOLERANCE = 1e-2  # of the forces left
_MOST_STEPS = 20_000  # of one state


class _Cell(NamedTuple):
    """Grains in a periodic unit cell, with what their contacts remember."""

    positions: Floats
    shapes: Floats  # radii over their mean
    masses: Floats
    friction: float


class _Contacts(NamedTuple):
    """Pairs that may touch, and their tangential springs."""

    pairs: NDArray[np.int32]
    springs: Floats


def random_packing(count: int, radii: ArrayLike, *, friction: float = 0.0, seed: int = 0) -> Packing:
    """Random packing of touching grains in a periodic cube: close without friction, loose with much of it.

    Random centres in a periodic cube; the radii grow together in steps of 1 %, and after each step the grains push each
    other apart until they rest or have no load. Once they rest under load they are jammed; the radii then go back until
    contacts overlap by 2e-6 of the mean radius on average [1]_. Friction holds looser heaps together [2]_; there the
    overlap is 1e-4.

    Parameters
    ----------
    count : int
        Grains, at least 50.
    radii : array_like
        One, or one of each grain, [m]. `sieved_radii` draws them from a sieve curve.
    friction : float
        Coefficient between grains while the heap is made, >= 0.
    seed : int
        Of the random centres; the same seed gives the same heap.

    Returns
    -------
    Packing
        With the cube as its cell.

    Raises
    ------
    ValueError
        For too few grains, radii that are not positive or too unequal for their number, a negative friction.

    Notes
    -----
    Of 1000 equal grains the solid fraction is 0.632 without friction, 0.578 at a friction of 0.3 and 0.547 at 10, with
    5.8, 4.6 and 4.0 contacts a held grain; ``python -m benchmarks.random_packings`` prints them.

    References
    ----------
    .. [1] C. S. O'Hern et al., Phys. Rev. E 68 (2003) 011306, doi 10.1103/PhysRevE.68.011306.
    .. [2] L. E. Silbert, Soft Matter 6 (2010) 2918, doi 10.1039/C001973A.

    Examples
    --------
    >>> heap = random_packing(100, 50e-6, seed=1)
    >>> bool(0.6 < np.sum(4 / 3 * np.pi * heap.radii**3) / heap.volume < 0.66)
    True
    """
    number = whole_number("count", count, _FEWEST)
    rubbing = float(in_range("friction", scalar("friction", friction, ""), 0.0))
    sizes = in_range("radii", quantity("radii", radii, "m"), 0.0, brackets="(]", unit="m")
    if sizes.shape not in ((), (number,)):
        raise ValueError(f"radii: an array of shape {sizes.shape} is not one radius for each of {number} grains")
    sizes = np.broadcast_to(sizes, number).astype(float)
    mean = float(sizes.mean())
    _refuse_large(sizes)
    rng = np.random.default_rng(whole_number("seed", seed, 0))
    shapes = sizes / mean
    cell = _Cell(rng.random((number, 3)), shapes, (shapes / shapes.min()) ** 2, rubbing)
    scale = _jammed(cell)
    side = mean / scale
    return Packing(cell.positions % 1.0 * side, sizes, np.full(3, side))


def _refuse_large(sizes: Floats) -> None:
    """Refuse a grain so large that it would meet its own image."""
    side = np.cbrt(4.0 / 3.0 * math.pi * np.sum(sizes**3) / 0.8)
    if 4.5 * sizes.max() > side:
        raise ValueError(
            f"count: {len(sizes)} grains make a cube of {side:.3g} m, too small for the largest radius of "
            f"{sizes.max():.3g} m; take more grains"
        )


def _jammed(cell: _Cell) -> float:
    """Mean radius at which the grains barely touch, in lengths of the cell, with the grains moved there."""
    volume = 4.0 / 3.0 * math.pi * float(np.sum(cell.shapes**3))
    scale, growth, was_jammed = math.cbrt(_FIRST_FRACTION / volume), _FIRST_GROWTH, False
    touching, released, load_left = _ROUGH if cell.friction > 0.0 else _SMOOTH
    contacts = None
    while True:
        end, overlap, contacts = _settled(cell, scale, contacts, _LOAD * growth)
        if end == LOOSE:
            growth = 0.5 * growth if was_jammed else min(1.5 * growth, _FIRST_GROWTH)
            factor = 1.0 + growth
        elif overlap <= touching * scale:
            return scale
        else:
            growth = released * overlap / (2.0 * scale)
            factor = 1.0 - growth
            contacts.springs[:] *= load_left  # else all contacts would slide
        was_jammed = end != LOOSE
        scale *= factor


def _settled(cell: _Cell, scale: float, contacts: _Contacts | None, loose: float) -> tuple[int, float, _Contacts]:
    """How the grains of this size come to rest, their mean overlap, and the contacts by then."""
    radii, left, end, overlap = scale * cell.shapes, _MOST_STEPS, STALE, 0.0
    while end == STALE:
        contacts = _looked_up(cell, scale, contacts)
        end, done, overlap = compiled(settle)(
            cell.positions, radii, cell.masses, contacts.pairs, contacts.springs, cell.friction,
            _TOLERANCE, loose, _skin(cell, scale), left,
        )  # fmt: skip
        left -= done
    assert contacts is not None
    return end, overlap, contacts


def _skin(cell: _Cell, scale: float) -> float:
    return _SKIN * scale * float(np.median(cell.shapes))


def _looked_up(cell: _Cell, scale: float, before: _Contacts | None) -> _Contacts:
    """Pairs that may touch soon; springs of contacts that stay are kept."""
    radii = scale * cell.shapes
    skin = _skin(cell, scale)
    heap = Packing(cell.positions, radii, np.ones(3))
    pairs = find_neighbours(heap, lambda first, second: np.full(np.shape(first), skin)).pairs
    springs = np.zeros((len(pairs), 3))
    if before is not None and cell.friction > 0.0:
        old, new = (p[:, 0].astype(np.int64) * len(radii) + p[:, 1] for p in (before.pairs, pairs))
        _, i, j = np.intersect1d(old, new, assume_unique=True, return_indices=True)
        springs[j] = before.springs[i]
    return _Contacts(pairs, springs)
