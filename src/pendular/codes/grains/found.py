"""What a file tells about its grains, in the file's own unit of length."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Found", "in_order", "optional", "refusal"]

Floats = NDArray[np.float64]


class Found(NamedTuple):
    """Grains of one file; what it does not tell is None."""

    positions: Floats  # (grains, 3)
    radii: Floats | None = None  # (grains,)
    cell: Floats | None = None  # (3, 3), its vectors as rows
    periodic: NDArray[np.bool_] | None = None  # (3,)
    unit: str | None = None  # of length


def in_order(ids: Floats | None, positions: Floats, radii: Floats | None) -> tuple[Floats, Floats | None]:
    """Grains by their numbers: programs that run in parallel write them in another order each time."""
    if ids is None or np.all(ids[1:] >= ids[:-1]):
        return positions, radii
    order = np.argsort(ids, kind="stable")
    return positions[order], None if radii is None else radii[order]


def refusal(reason: str) -> ValueError:
    """Error for a file that is damaged or tells too little, to be completed with its path.

    Examples
    --------
    >>> raise refusal("it ends within the frame")
    Traceback (most recent call last):
        ...
    ValueError: it ends within the frame
    """
    return ValueError(reason)


def optional(module: str) -> Any:
    """Module of a package that not everybody has, or one line how to get it."""
    from importlib import import_module

    try:
        return import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        raise ValueError(f"it takes the package {package}: pip install 'pendular[grains]' ({error})") from error
