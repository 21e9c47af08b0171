"""The data base of bridges: a labelled grid, on disk as Zarr or NetCDF, computed in parallel on request.

The grid is that of Zhao, Kruyt & Millet (2020), Section 2.3: half-filling angle of the smaller sphere against neck
ratio, for pairs of spheres of one contact angle. All lengths are over the Derjaguin radius R, γ is 1 (stars).
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from importlib.metadata import version
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import angle, as_path, in_range, instance, quantity, whole_number
from ..ground.files import in_one_line, whole
from ..ground.rows import over_rows
from .grid import GridPoint, Solids, grid_range

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

Floats = NDArray[np.float64]
Workers = int | str | None
StrPath = str | PathLike[str]
Step = TypeVar("Step")

PAPER_RATIOS = (1.0, 2.0, 8.0, 128.0)
PAPER_ANGLES = (0.0, float(np.deg2rad(20.0)), float(np.deg2rad(40.0)))
PAPER_SHAPE = (240, 200)

PAIR_DIMS = ("size_ratio", "contact_angle")
_DIMS = (*PAIR_DIMS, "half_filling_angle", "neck_ratio")
_LARGEST_FILLING = np.deg2rad(60.0)
_DECADES = 5.0  # of half-filling angle: down to the rupture at H* = 2e7
_CROWDING = 3.0  # 1 - Q is the power of an even spacing: at H* = 1e6 a bridge at contact has 1 - Q = 7e-4
_POINTS_PER_TASK = 2**12  # of a thread
_POINTS_PER_CHUNK = 2**18  # about 30 MB of all variables: what one worker holds
_ALL_CHUNKS = {"array.write_empty_chunks": True}  # so that a chunk that is not there was lost
_COMPUTED = "computed"  # set for a block of rows after all of its variables are written

_COORDINATES = {
    "size_ratio": ("1", "radius of the larger sphere over that of the smaller one", "R_L/R_s"),
    "contact_angle": ("rad", "contact angle on both spheres", "theta"),
    "half_filling_angle": ("rad", "half-filling angle of the smaller sphere", "delta_s"),
    "neck_ratio": ("1", "neck radius over contact radius on the smaller sphere", "Y0/Ycs"),
}

# In the order of GridPoint: name, power of the Derjaguin radius in the unit, meaning, symbol of the paper.
_VARIABLES = (
    ("suction_star", "1/R", "suction over surface tension", "H*"),
    ("force_star", "R", "capillary force over 2 pi gamma, attraction positive", "lambda*"),
    ("gap_small_star", "R", "distance of the neck from the smaller sphere", "S_s*"),
    ("gap_large_star", "R", "distance of the neck from the larger sphere", "S_L*"),
    ("half_separation_star", "R", "half the gap between the spheres, negative in an overlap", "S*"),
    ("volume_small_star", "R^3", "liquid between the neck and the smaller sphere", "V_s*"),
    ("volume_large_star", "R^3", "liquid between the neck and the larger sphere", "V_L*"),
    ("volume_star", "R^3", "liquid volume", "V*"),
    ("area_small_star", "R^2", "liquid-gas area between the neck and the smaller sphere", "A_s*"),
    ("area_large_star", "R^2", "liquid-gas area between the neck and the larger sphere", "A_L*"),
    ("wetted_area_small_star", "R^2", "liquid-solid area on the smaller sphere", "A_ls,s*"),
    ("wetted_area_large_star", "R^2", "liquid-solid area on the larger sphere", "A_ls,L*"),
    ("half_filling_angle_large", "", "half-filling angle of the larger sphere", "delta_L"),
    ("surface_energy_star", "gamma R^2", "surface energy against dry solids", "E_surf*"),
    ("grand_potential_star", "gamma R^2", "surface energy + suction x volume", "E_surf* + H* V*"),
)


VARIABLES = tuple(name for name, *_ in _VARIABLES)


class _Block(NamedTuple):
    """Rows of one pair: the unit of work, and one chunk of every variable on disk."""

    ratio: int
    angle: int
    start: int
    stop: int

    @property
    def region(self) -> tuple[int, int, slice]:
        """Where the block lies among the first three dimensions."""
        return self.ratio, self.angle, slice(self.start, self.stop)


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
    return _in_memory(_grid(shape, size_ratio, contact_angle), progress)


def fill_store(
    path: StrPath,
    shape: tuple[int, int],
    size_ratio: ArrayLike,
    contact_angle: ArrayLike,
    workers: Workers,
    progress: bool,
) -> dict[str, int]:
    """Compute a data base into a store as `make_dataset` does, and tell how many values each coordinate has."""
    grid = _grid(shape, size_ratio, contact_angle)
    store = _zarr_path(path)
    with _hands(workers) as done_by, in_one_line("path", store):
        if not store.exists():
            _create(store, grid)
        _refuse_other(store, grid)
        blocks = _missing(store)
        for _ in _tracked(done_by(partial(_fill_block, _opened(store)), blocks), len(blocks), progress):
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
    with in_one_line("path", target), whole(target) as draft, damage_told("dataset", "it"):
        if target.suffix == ".zarr":
            _to_zarr(dataset, draft)
        else:
            checked = {name: {"fletcher32": True} for name in dataset.data_vars}
            dataset.chunk({}).to_netcdf(draft, engine="h5netcdf", encoding=checked)


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
            dataset = _from_zarr(_zarr_path(source))
        else:
            with damage_told("path", str(source)):
                dataset = xr.open_dataset(source, engine="h5netcdf")
    check_dataset(dataset, "path", str(source))
    return dataset


def check_dataset(dataset: object, name: str = "dataset", place: str = "it") -> None:
    """Refuse what is no data base of this kind."""
    import xarray as xr

    instance(name, dataset, xr.Dataset)
    held = dataset.variables  # type: ignore[attr-defined]
    for variable in (*_DIMS, *VARIABLES):
        if variable not in held:
            raise ValueError(f"{name}: {place} lacks {variable}, and is no data base of make_dataset")


@contextmanager
def damage_told(name: str, place: str) -> Iterator[None]:
    """Refuse in one line what cannot be read, whichever of the libraries below finds that, and however it says so.

    An error of the system, like that of a full disk, stays what it is.
    """
    try:
        yield
    except Exception as error:
        if isinstance(error, OSError) and error.errno is not None and not isinstance(error, FileNotFoundError):
            raise
        reason = str(error).partition("\n")[0] or type(error).__name__
        raise ValueError(f"{name}: {place} is damaged, or no data base: {reason}") from error


# -- the grid --------------------------------------------------------------------------------------------------------


def _grid(shape: tuple[int, int], size_ratio: ArrayLike, contact_angle: ArrayLike) -> dict[str, Floats]:
    """Coordinates of the data base."""
    counts = in_range("shape", quantity("shape", shape, ""), 8.0).astype(int)
    if counts.shape != (2,):
        raise ValueError(f"shape: {shape} is not a pair (half-filling angles, neck ratios)")
    ratios = in_range("size_ratio", np.atleast_1d(quantity("size_ratio", size_ratio, "")), 1.0)
    angles = np.atleast_1d(angle("contact_angle", contact_angle))
    in_range("contact_angle", angles, 0.0, 0.5 * np.pi, brackets="[)", unit="rad")
    for name, values in (("size_ratio", ratios), ("contact_angle", angles)):
        if values.ndim > 1 or np.any(np.diff(values) <= 0.0):
            raise ValueError(f"{name}: {values.tolist()} is not an increasing list")
    fillings = _LARGEST_FILLING * 10.0 ** (_DECADES * (np.linspace(0.0, 1.0, counts[0]) - 1.0))
    neck_ratios = 1.0 - np.linspace(1.0, 0.0, counts[1]) ** _CROWDING
    return dict(zip(_DIMS, (ratios, angles, fillings, neck_ratios), strict=True))


def curvatures(size_ratio: float) -> tuple[float, float]:
    """1/R_s and 1/R_L in units of the Derjaguin radius."""
    return 2.0 * size_ratio / (1.0 + size_ratio), 2.0 / (1.0 + size_ratio)


def solids_of(size_ratio: float, contact_angle: float) -> Solids:
    small, large = curvatures(size_ratio)
    return Solids(small, contact_angle, large, contact_angle)


def _compute(size_ratio: float, contact_angle: float, fillings: Floats, neck_ratios: Floats) -> Floats:
    """All variables of some rows of a pair."""
    values = np.empty((len(GridPoint._fields), fillings.size, neck_ratios.size))
    solids, count = solids_of(size_ratio, contact_angle), fillings.size * neck_ratios.size
    over_rows(grid_range, count, _POINTS_PER_TASK, fillings, neck_ratios, solids, values)
    return values


def _attributes(label: Sequence[str]) -> dict[str, str]:
    """Of a variable of the table above."""
    unit, long_name, symbol = label
    return {"units": unit or "rad", "long_name": long_name, "symbol": symbol}


def _provenance() -> dict[str, str]:
    return {
        "title": "Capillary bridges between two spheres",
        "source": f"pendular {version('pendular')}",
        "references": "C.-F. Zhao, N. P. Kruyt, O. Millet, Powder Technology 360 (2020) 622-634, Section 2.3",
        "equations": "H and lambda from Eq. 10, S and V from Eq. 12, E_surf and E_surf + H V from Eqs. 13 and 14, "
        "solutions of Eq. 8 in Carlson's elliptic integrals",
        "reduction": "R is the Derjaguin radius 2 R_s R_L/(R_s + R_L), gamma the surface tension; "
        "units name what a variable is divided by",
        "comment": "NaN where no bridge has its neck between the contact circles, and at Y0/Ycs = 0 and 1; "
        "the contact circle on the larger sphere is that of the smaller filling angle",
    }


def _labelled(grid: dict[str, Floats], arrays: Iterable[Any]) -> "xr.Dataset":
    """Dataset of arrays in the order of the variables."""
    import xarray as xr

    variables = {
        name: (_DIMS, array, _attributes(label)) for (name, *label), array in zip(_VARIABLES, arrays, strict=True)
    }
    coordinates = {name: (name, values, _attributes(_COORDINATES[name])) for name, values in grid.items()}
    return xr.Dataset(variables, coordinates, _provenance())


def _in_memory(grid: dict[str, Floats], progress: bool) -> "xr.Dataset":
    ratios, angles, fillings, neck_ratios = grid.values()
    values = np.empty((len(_VARIABLES), *(axis.size for axis in grid.values())))
    pairs = list(np.ndindex(ratios.size, angles.size))
    for i, j in _tracked(iter(pairs), len(pairs), progress):
        values[:, i, j] = _compute(float(ratios[i]), float(angles[j]), fillings, neck_ratios)
    return _labelled(grid, values)


# -- the store -------------------------------------------------------------------------------------------------------


def _zarr_path(path: StrPath) -> Path:
    store = as_path("path", path)
    if store.suffix != ".zarr":
        raise ValueError(f"path: {store.name} does not end in .zarr; save_dataset writes other formats")
    return store


def _create(store: Path, grid: dict[str, Floats]) -> None:
    """Write coordinates and attributes; the arrays stay empty. Of several runs that do so at once one is in time."""
    try:
        with whole(store) as draft:
            _write_empty(draft, grid)
    except OSError:
        if not store.is_dir():
            raise


def _write_empty(path: Path, grid: dict[str, Floats]) -> None:
    """Write a store by Zarr alone: to import what labels arrays takes longer than to compute them."""
    import zarr

    group: Any = zarr.create_group(path, attributes=_provenance())

    def add(name: str, dims: Sequence[str], chunks: tuple[int, ...], label: Sequence[str] = (), **kind: Any) -> Any:
        return group.create_array(
            name,
            shape=tuple(grid[dim].size for dim in dims),
            chunks=chunks,
            dimension_names=dims,
            attributes=_attributes(label) if label else None,
            compressors=_checked(),
            **kind,
        )

    for name, values in grid.items():
        with zarr.config.set(_ALL_CHUNKS):
            add(name, (name,), values.shape, _COORDINATES[name], dtype=np.float64, fill_value=np.nan)[:] = values
    ratios = grid[_DIMS[3]].size
    rows = min(max(_POINTS_PER_CHUNK // ratios, 1), grid[_DIMS[2]].size)
    for name, *label in _VARIABLES:
        add(name, _DIMS, (1, 1, rows, ratios), label, dtype=np.float64, fill_value=np.nan)
    add(_COMPUTED, _DIMS[:3], (1, 1, rows), dtype=bool, fill_value=False)


def _checked() -> tuple[Any, ...]:
    """Codecs of a chunk, and a checksum: bytes of one rank lie together, and then the quickest code is smallest."""
    from zarr.codecs import BloscCodec, Crc32cCodec

    return BloscCodec(cname="lz4", clevel=1), Crc32cCodec()


def _to_zarr(dataset: "xr.Dataset", path: Path) -> None:
    """Write a store in which every chunk carries a checksum, and none is left out for being empty."""
    import zarr

    checked: Any = {
        name: {"compressors": _checked(), "chunks": array.encoding.get("chunks")}
        for name, array in dataset.variables.items()
    }
    options: Any = {"mode": "w-", "consolidated": False, "encoding": checked}
    with zarr.config.set(_ALL_CHUNKS):
        dataset.to_zarr(path, **options)


def _from_zarr(store: Path) -> "xr.Dataset":
    """Open a store in which every chunk is there; Zarr itself would give NaN for one that is not."""
    import xarray as xr
    import zarr

    with damage_told("path", str(store)):
        group: Any = zarr.open_group(store, mode="r")
        dataset: xr.Dataset = xr.open_zarr(store, chunks=None, consolidated=False)
        done = group[_COMPUTED][:] if _COMPUTED in group else np.ones(1, bool)
        absent = [name for name, array in group.arrays() if array.nchunks_initialized < array.nchunks]
    if not done.all():
        raise ValueError(f"path: only {done.mean():.1%} of {store} is computed; make_dataset continues it")
    if absent:
        raise ValueError(f"path: {store} is damaged: chunks of {', '.join(absent)} are missing; make_dataset mends it")
    return dataset.drop_vars(_COMPUTED, errors="ignore")


def _refuse_other(store: Path, grid: dict[str, Floats]) -> None:
    """Refuse to continue a store of another grid, or of another version, whose numbers might differ."""
    import zarr

    with damage_told("path", str(store)):
        group: Any = zarr.open_group(store, mode="r")
        attributes = group.attrs.asdict()
        found = {name: np.asarray(group[name][:]) for name in grid if name in group}
    if attributes != _provenance():
        raise ValueError(f"path: {store} was written by {attributes.get('source', 'another program')}")
    if any(name not in found or not np.array_equal(found[name], values) for name, values in grid.items()):
        raise ValueError(f"path: {store} holds a data base with other coordinates")


def _missing(store: Path) -> list[_Block]:
    """Blocks of a store that have not been computed or cannot be read, all of a pair in turn."""
    import zarr

    with damage_told("path", str(store)):
        group: Any = zarr.open_group(store, mode="r")
        done = np.asarray(group[_COMPUTED][:], bool)
        rows = group[_COMPUTED].chunks[-1]
    blocks = (
        _Block(ratio, angle, start, min(start + rows, done.shape[2]))
        for ratio, angle in np.ndindex(*done.shape[:2])
        for start in range(0, done.shape[2], rows)
    )
    return [block for block in blocks if not (done[block.region].all() and _is_whole(group, block))]


def _is_whole(group: Any, block: _Block) -> bool:
    """Whether all chunks of a block are there, for a missing one reads as NaN, and none is damaged."""
    try:
        return all(np.isfinite(group[name][block.region]).any() for name in VARIABLES)
    except Exception:  # each codec raises an error of its own
        return False


class _Opened(NamedTuple):
    """A store, opened once for many blocks: to open its arrays takes as long as to compute some."""

    axes: list[Floats]
    arrays: list[Any]  # one for each variable
    computed: Any


def _opened(store: Path) -> _Opened:
    """Open a store to be written."""
    import zarr

    group: Any = zarr.open_group(store, mode="r+")
    axes = [np.asarray(group[name][:]) for name in _DIMS]
    return _Opened(axes, [group[name] for name in VARIABLES], group[_COMPUTED])


def _fill_block(store: _Opened, block: _Block) -> None:
    """Compute a block and write it; the mark that it is done comes last, so that a torn block is computed again."""
    import zarr

    ratios, angles, fillings, neck_ratios = store.axes
    rows = fillings[block.start : block.stop]
    values = _compute(float(ratios[block.ratio]), float(angles[block.angle]), rows, neck_ratios)
    with zarr.config.set(_ALL_CHUNKS):
        for array, content in zip(store.arrays, values, strict=True):
            array[block.region] = content
        store.computed[block.region] = True


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

        def completed(task: Callable[[_Block], None], blocks: Sequence[_Block]) -> Iterator[None]:
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
