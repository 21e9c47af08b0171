"""Grains and bridges as labelled arrays."""

from typing import TYPE_CHECKING

import numpy as np

from ...ground.check import instance
from ...packing.heap import Packing
from .bridge_table import UNITS, Bridges, quantities

if TYPE_CHECKING:
    import xarray

__all__ = ["packing_dataset"]


def packing_dataset(heap: Packing, bridges: Bridges | None = None) -> "xarray.Dataset":
    """Labelled arrays of the grains of a heap and of its bridges, with units as attributes.

    Parameters
    ----------
    heap : Packing
        The grains.
    bridges : record, optional
        Bridges of the heap, ``w.bridges`` of a wetted one.

    Returns
    -------
    xarray.Dataset
        ``position`` (grain, axis) and ``radius`` (grain); ``cell`` (vector, axis) and ``periodic`` (vector) of a heap
        with a cell; ``pairs`` (bridge, end), ``image`` (bridge, vector), ``separation``, ``force``, ``volume`` and
        ``suction`` (bridge).

    Raises
    ------
    ValueError
        Without xarray.

    Examples
    --------
    >>> import pendular as pl
    >>> heap = pl.lattice_packing("simple_cubic", 3, 50e-6)
    >>> packing_dataset(heap).radius.attrs["units"]
    'm'
    """
    instance("heap", heap, Packing)
    try:
        import xarray
    except ImportError as error:
        raise ValueError("packing_dataset: it takes the package xarray: pip install 'pendular[data]'") from error
    metres = {"units": "m"}
    found = xarray.Dataset(
        {"position": (("grain", "axis"), heap.positions, metres), "radius": (("grain",), heap.radii, metres)},
        coords={"axis": list("xyz")},
    )
    if heap.cell is not None:
        found["cell"] = (("vector", "axis"), heap.cell, metres)
        found["periodic"] = (("vector",), heap.periodic)
    if bridges is not None:
        found["pairs"] = (("bridge", "end"), np.asarray(bridges.pairs))
        found["image"] = (("bridge", "vector"), np.asarray(bridges.image))
        for name, values in quantities(bridges).items():
            found[name] = (("bridge",), np.array(values), {"units": UNITS[name]})
    return found
