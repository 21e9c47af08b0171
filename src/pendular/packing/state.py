"""What one step of a heap hands to the next: which pairs hold a bridge, and its liquid."""

import zipfile
from dataclasses import dataclass
from os import PathLike
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.check import as_path
from ..ground.compile import compiled, kernel
from .neighbours import Neighbours

__all__ = ["Book", "Standing", "State", "load_state", "standing_of"]

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_ARRAYS = ("pairs", "volume", "suction", "unheld", "bodies")


@dataclass(frozen=True, eq=False)
class State:
    """Bridges of a heap, as :func:`wet` takes them up again by ``start=``."""

    pairs: NDArray[np.int32]  # (n, 2), ascending; a number from the grains on is a wall
    volume: Floats  # (n,), [m³]
    suction: Floats  # (n,), [Pa]
    unheld: float  # liquid beside the bridges, [m³]
    bodies: int  # grains and walls

    @property
    def liquid_volume(self) -> float:
        """All liquid, [m³]."""
        return float(np.sum(self.volume)) + self.unheld

    def save(self, path: str | PathLike[str]) -> None:
        """Write the state to a file that :func:`load_state` reads."""
        with open(as_path("path", path), "wb") as file:
            np.savez(file, **{name: getattr(self, name) for name in _ARRAYS})


class Book(NamedTuple):
    """Where the liquid went in a step, [m³]: before + supplied = held + released + unheld."""

    before: float  # in the state that was taken up
    supplied: float  # from outside; negative where liquid was taken away
    held: float  # in bridges now
    released: float  # by bridges that broke, to the outside
    unheld: float  # beside the bridges: no bridge takes it


class Standing(NamedTuple):
    """The bridges of a state among the pairs of a heap."""

    bridge: NDArray[np.int64]  # number of the bridge in the state for each pair, or -1
    gone: NDArray[np.int64]  # bridges whose grains are out of reach now

    @property
    def has(self) -> Bools:
        """Whether a pair held a bridge."""
        return np.asarray(self.bridge >= 0)


def standing_of(state: State, neighbours: Neighbours) -> Standing:
    """Find the bridges of a state among pairs; both are in the order of their indices."""
    bridge, is_there = np.full(len(neighbours.gap), -1), np.zeros(len(state.volume), bool)
    compiled(_match)(state.pairs, neighbours.pairs, bridge, is_there)
    return Standing(bridge, np.flatnonzero(~is_there))


@kernel
def _match(
    old: NDArray[np.integer], new: NDArray[np.integer], bridge: NDArray[np.int64], is_there: NDArray[np.bool_]
) -> None:
    """Number in the old list of each pair of the new one, and whether an old one is there; both are in order."""
    k = 0
    for row in range(new.shape[0]):
        i, j = new[row, 0], new[row, 1]
        while k < old.shape[0] and (old[k, 0] < i or (old[k, 0] == i and old[k, 1] < j)):
            k += 1
        if k < old.shape[0] and old[k, 0] == i and old[k, 1] == j:
            bridge[row] = k
            is_there[k] = True


def load_state(path: str | PathLike[str]) -> State:
    """Load the state of a heap.

    Parameters
    ----------
    path : path
        Of a file that ``Wet.save`` wrote.

    Returns
    -------
    State
        For ``wet(heap, ..., start=state)``.

    Raises
    ------
    ValueError
        If the file is not such a one.
    """
    file = as_path("path", path)
    try:
        with np.load(file, allow_pickle=False) as found:
            arrays = {name: found[name] for name in _ARRAYS}
    except (OSError, ValueError, KeyError, TypeError, zipfile.BadZipFile) as error:
        raise ValueError(f"path: {str(file)!r} is not a state of a heap ({error})") from error
    return State(
        arrays["pairs"].astype(np.int32),
        arrays["volume"],
        arrays["suction"],
        float(arrays["unheld"]),
        int(arrays["bodies"]),
    )
