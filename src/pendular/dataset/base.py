"""The data base of bridges: a labelled grid, on disk as Zarr or NetCDF, computed in parallel on request.

The grid is that of Zhao, Kruyt & Millet (2020), Section 2.3: half-filling angle of the smaller sphere against neck
ratio, for pairs of spheres of one contact angle. All lengths are over the Derjaguin radius R, γ is 1 (stars).
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..ground.check import as_path, whole_number
from ..ground.files import in_one_line, whole
from ..ground.threads import thread_count
from . import store as stores
from .variables import LABELS, Coordinates, check_dataset, compute, coordinates, labelled

if TYPE_CHECKING:
    import xarray as xr

__all__ = [
    "PAPER_ANGLES",
    "PAPER_RATIOS",
    "PAPER_SHAPE",
    "load_dataset",
    "make_dataset",
    "save_dataset",
]

Workers = int | str | None
StrPath = str | PathLike[str]
Step = TypeVar("Step")

PAPER_RATIOS = (1.0, 2.0, 8.0, 128.0)
PAPER_ANGLES = (0.0, float(np.deg2rad(20.0)), float(np.deg2rad(40.0)))
PAPER_SHAPE = (240, 200)


def make_dataset(
    path: StrPath | None = None,
    *,
    shape: tuple[int, int] = PAPER_SHAPE,
    size_ratio: ArrayLike = PAPER_RATIOS,
    contact_angle: ArrayLike = PAPER_ANGLES,
    workers: Workers = None,
    progress: bool = False,
) -> "xr.Dataset":
    r"""Data base of bridges over half-filling angle and neck ratio.

    .. math:: H = \frac{2(Y_0 - Y_{cs}\sin\beta_s)}{Y_{cs}^2 - Y_0^2}, \qquad \lambda = Y_0 + \tfrac12 H Y_0^2
              \qquad \text{(Zhao et al. 2020, Eq. 10)}, \qquad 2S = S_s + S_L \qquad \text{(Eq. 12)}

    Parameters
    ----------
    path : path-like, optional
        A Zarr store, ``*.zarr``, to compute into chunk by chunk. If it holds part of the same data base, the chunks
        that are there and whole are kept, and several runs may fill it at once. Without it the data base is computed
        in memory.
    shape : tuple of int
        Half-filling angles and neck ratios, at least 8 each.
    size_ratio : array_like
        Radius of the larger over that of the smaller sphere, [-], >= 1, increasing.
    contact_angle : array_like
        On both spheres, [rad], in [0, π/2), increasing.
    workers : int or str, optional
        Number of processes of a local Dask cluster, or the address of a Dask scheduler whose workers see the path.
        The numbers are the same, bit for bit.
    progress : bool
        Show a progress bar on the error stream.

    Returns
    -------
    xarray.Dataset
        Read lazily if it lies on disk.

    Raises
    ------
    ValueError
        For bad input, if the store holds something else or cannot be written, or if the workers cannot be reached.

    Notes
    -----
    Everything is a closed form; nothing is solved or integrated by steps, save the volume at vanishing suction.
    The angles are evenly spaced in their logarithm, over five decades up to 60°; the neck ratios crowd at 1.

    **Validity.** The neck lies between the two contact circles, as in the paper; elsewhere, and on the edges Q = 0 (the
    neck has closed) and Q = 1 (the suction is infinite), all variables are NaN. Of the two circles in which a surface
    may meet the larger sphere the one of the smaller filling angle is taken; between equal spheres the mirror image of
    the other. Unstable bridges are included. Where the spheres overlap the volume counts the liquid outside the two
    caps, each of them whole.

    References
    ----------
    .. [1] C.-F. Zhao, N. P. Kruyt, O. Millet, Powder Technology 360 (2020) 622.

    Examples
    --------
    >>> data = make_dataset(shape=(60, 40), size_ratio=1.0, contact_angle=0.0)
    >>> dict(data.sizes)
    {'size_ratio': 1, 'contact_angle': 1, 'half_filling_angle': 60, 'neck_ratio': 40}
    >>> data.force_star.attrs["units"], data.force_star.attrs["long_name"]
    ('R', 'capillary force over 2 pi gamma, attraction positive')
    """
    if path is not None:
        fill_store(path, shape, size_ratio, contact_angle, workers, progress)
        return load_dataset(path)
    if workers is not None:
        raise ValueError(f"workers: {workers!r} given without a path; workers write into a Zarr store")
    return _in_memory(coordinates(shape, size_ratio, contact_angle), progress)


def fill_store(
    path: StrPath,
    shape: tuple[int, int],
    size_ratio: ArrayLike,
    contact_angle: ArrayLike,
    workers: Workers,
    progress: bool,
) -> dict[str, int]:
    """Compute a data base into a store as `make_dataset` does, and tell how many values each coordinate has."""
    grid = coordinates(shape, size_ratio, contact_angle)
    store = _zarr_path(path)
    with _hands(workers) as done_by, in_one_line("path", store):
        if not store.exists():
            stores.create(store, grid)
        stores.refuse_other(store, grid)
        blocks = stores.missing(store)
        for _ in _tracked(done_by(partial(stores.fill, stores.opened(store)), blocks), len(blocks), progress):
            pass
    return {name: values.size for name, values in grid.items()}


def save_dataset(dataset: "xr.Dataset", path: StrPath) -> None:
    """Write a data base to a new file, in constant memory if it is read from a Zarr store.

    Parameters
    ----------
    dataset : xarray.Dataset
        From `make_dataset` or `load_dataset`.
    path : path-like
        ``*.nc`` for NetCDF 4, ``*.zarr`` for Zarr; must not exist.

    Raises
    ------
    ValueError
        If the suffix is another one, or the path exists.
    """
    target = as_path("path", path)
    if target.exists():
        raise ValueError(f"path: {target} exists already")
    if target.suffix not in (".zarr", ".nc"):
        raise ValueError(f"path: {target.name} ends neither in .zarr nor in .nc")
    check_dataset(dataset)
    with in_one_line("path", target), whole(target) as draft, _own_threads(), stores.damage_told("dataset", "it"):
        if target.suffix == ".zarr":
            stores.write(dataset, draft)
        else:
            checked = {name: {"fletcher32": True} for name in dataset.data_vars}
            dataset.chunk({}).to_netcdf(draft, engine="h5netcdf", encoding=checked)


@contextmanager
def _own_threads() -> Iterator[None]:
    """Threads for Dask that end here: after an error its own go on, and would write to a file that has been removed."""
    import dask

    with ThreadPoolExecutor(thread_count()) as pool, dask.config.set(pool=pool):
        yield


def load_dataset(path: StrPath) -> "xr.Dataset":
    """Open a data base; its arrays are read when they are used.

    Parameters
    ----------
    path : path-like
        ``*.zarr`` or ``*.nc``.

    Returns
    -------
    xarray.Dataset
        The data base.

    Raises
    ------
    ValueError
        If there is none, it is damaged, or a part of it has not been computed yet.
    """
    import xarray as xr

    source = as_path("path", path)
    if not source.exists():
        raise ValueError(f"path: {source} does not exist")
    with in_one_line("path", source, "read"):
        if source.suffix != ".nc":
            dataset = stores.read(_zarr_path(source))
        else:
            with stores.damage_told("path", str(source)):
                dataset = xr.open_dataset(source, engine="h5netcdf")
    check_dataset(dataset, "path", str(source))
    return dataset


def _in_memory(grid: Coordinates, progress: bool) -> "xr.Dataset":
    ratios, angles, fillings, neck_ratios = grid.values()
    values = np.empty((len(LABELS), *(axis.size for axis in grid.values())))
    pairs = list(np.ndindex(ratios.size, angles.size))
    for i, j in _tracked(iter(pairs), len(pairs), progress):
        values[:, i, j] = compute(float(ratios[i]), float(angles[j]), fillings, neck_ratios)
    return labelled(grid, values)


def _zarr_path(path: StrPath) -> Path:
    store = as_path("path", path)
    if store.suffix != ".zarr":
        raise ValueError(f"path: {store.name} does not end in .zarr; save_dataset writes other formats")
    return store


@contextmanager
def _hands(workers: Workers) -> Iterator[Callable[..., Iterator[None]]]:
    """What does a task for all blocks, here or by Dask, and yields after each."""
    if workers is None:
        yield map
        return
    from distributed import Client, KilledWorker, LocalCluster, as_completed

    with ExitStack() as stack:
        address: Any = workers
        if not isinstance(workers, str):
            count = whole_number("workers", workers, 1)
            # One thread each: what was asked for is a number of processes.
            cluster = LocalCluster(n_workers=count, threads_per_worker=1, dashboard_address=None)
            address = stack.enter_context(cluster)
        try:
            client = stack.enter_context(Client(address))
        except (OSError, ValueError) as error:
            raise ValueError(f"workers: {workers!r} cannot be reached: {error}") from error

        def completed(task: Callable[[stores.Block], None], blocks: Sequence[stores.Block]) -> Iterator[None]:
            try:
                for future in as_completed(client.map(task, blocks, pure=False)):
                    yield future.result()
            except KilledWorker as error:
                raise ValueError(f"workers: {workers!r} ended before the work was done: {error}") from error

        yield completed


def _tracked(steps: Iterator[Step], total: int, progress: bool) -> Iterator[Step]:
    """Draw a progress bar on the error stream while the steps are taken."""
    if not progress:
        return steps
    from rich.console import Console
    from rich.progress import track

    return iter(track(steps, "bridges", total, console=Console(stderr=True)))
