"""A heap and its bridges as a file for other programs."""

from typing import Any

from ...ground.check import as_path, instance
from ...ground.files import in_one_line, whole
from ...packing.heap import Packing
from . import csv_write, vtk_write
from .bridge_table import Bridges
from .labelled import packing_dataset

__all__ = ["write_packing"]


def write_packing(path: Any, heap: Packing, bridges: Bridges | None = None) -> None:
    """Write a heap, and its bridges with their forces, volumes and suctions, in SI units.

    Parameters
    ----------
    path : path
        Its suffix tells the format: ``.vtu`` and ``.vtp`` for ParaView, with grains as points and bridges as lines;
        ``.csv``, with the bridges in a second table ``…_bridges.csv``; ``.nc``, the arrays of `packing_dataset` as
        netCDF.
    heap : Packing
        The grains.
    bridges : record, optional
        Bridges of the heap, ``w.bridges`` of a wetted one.

    Raises
    ------
    ValueError
        For another suffix, or a file that cannot be written.

    Notes
    -----
    A periodic bridge is drawn from the first grain to the image of the second, outside of the cell. `read_packing`
    reads all but ``.nc``.

    Examples
    --------
    >>> import pendular as pl
    >>> pl.write_packing("heap.xyz", pl.lattice_packing("simple_cubic", 3, 50e-6))
    Traceback (most recent call last):
        ...
    ValueError: path: 'heap.xyz' does not end in .vtu, .vtp, .csv or .nc
    """
    file = as_path("path", path)
    instance("heap", heap, Packing)
    suffix = file.suffix.lower()
    if suffix not in (".vtu", ".vtp", ".csv", ".nc"):
        raise ValueError(f"path: '{file}' does not end in .vtu, .vtp, .csv or .nc")
    with in_one_line("path", file):
        if suffix == ".csv":
            csv_write.write(file, heap, bridges)
        elif suffix == ".nc":
            with whole(file) as draft:
                packing_dataset(heap, bridges).to_netcdf(draft, engine="h5netcdf")
        else:
            vtk_write.write(file, heap, bridges)
