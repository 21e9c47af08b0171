"""The data base on disk, a Zarr store that is filled block by block, by several runs at once if need be."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..ground.files import whole
from .variables import COORDINATES, DIMS, LABELS, VARIABLES, Coordinates, Floats, attributes_of, compute, provenance

if TYPE_CHECKING:
    import xarray as xr

_POINTS_PER_CHUNK = 2**18  # about 30 MB of all variables: what one worker holds
_ALL_CHUNKS = {"array.write_empty_chunks": True}  # so that a chunk that is not there was lost
_COMPUTED = "computed"  # set for a block of rows after all of its variables are written


class Block(NamedTuple):
    """Rows of one pair, or all rows of some: the unit of work, and one chunk of every variable on disk."""

    ratio: int
    angles: slice
    rows: slice


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


def create(store: Path, grid: Coordinates) -> None:
    """Write coordinates and attributes; the arrays stay empty. Of several runs that do so at once one is in time."""
    try:
        with whole(store) as draft:
            _write_empty(draft, grid)
    except OSError:
        if not store.is_dir():
            raise


def _write_empty(path: Path, grid: Coordinates) -> None:
    """Write a store by Zarr alone: to import what labels arrays takes longer than to compute them."""
    import zarr

    group: Any = zarr.create_group(path, attributes=provenance())

    def add(name: str, dims: Sequence[str], chunks: tuple[int, ...], label: Sequence[str] = (), **kind: Any) -> Any:
        return group.create_array(
            name,
            shape=tuple(grid[dim].size for dim in dims),
            chunks=chunks,
            dimension_names=dims,
            attributes=attributes_of(label) if label else None,
            compressors=_checked(),
            **kind,
        )

    for name, values in grid.items():
        with zarr.config.set(_ALL_CHUNKS):
            add(name, (name,), values.shape, COORDINATES[name], dtype=np.float64, fill_value=np.nan)[:] = values
    _, angles, rows, columns = (grid[dim].size for dim in DIMS)
    in_chunk = max(_POINTS_PER_CHUNK // columns, 1)  # rows: a file for each pair would take longer than its bridges
    chunk = (1, min(max(in_chunk // rows, 1), angles), min(in_chunk, rows))
    for name, *label in LABELS:
        add(name, DIMS, (*chunk, columns), label, dtype=np.float64, fill_value=np.nan)
    add(_COMPUTED, DIMS[:3], chunk, dtype=bool, fill_value=False)


def _checked() -> tuple[Any, ...]:
    """Codecs of a chunk, and a checksum: bytes of one rank lie together, and then the quickest code is smallest."""
    from zarr.codecs import BloscCodec, Crc32cCodec

    return BloscCodec(cname="lz4", clevel=1), Crc32cCodec()


def write(dataset: "xr.Dataset", path: Path) -> None:
    """Write a store in which every chunk carries a checksum, and none is left out for being empty."""
    import zarr

    checked: Any = {
        name: {"compressors": _checked(), "chunks": array.encoding.get("chunks")}
        for name, array in dataset.variables.items()
    }
    options: Any = {"mode": "w-", "consolidated": False, "encoding": checked}
    with zarr.config.set(_ALL_CHUNKS):
        dataset.to_zarr(path, **options)


def read(store: Path) -> "xr.Dataset":
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


def refuse_other(store: Path, grid: Coordinates) -> None:
    """Refuse to continue a store of another grid, or of another version, whose numbers might differ."""
    import zarr

    with damage_told("path", str(store)):
        group: Any = zarr.open_group(store, mode="r")
        attributes = group.attrs.asdict()
        found = {name: np.asarray(group[name][:]) for name in grid if name in group}
    if attributes != provenance():
        raise ValueError(f"path: {store} was written by {attributes.get('source', 'another program')}")
    if any(name not in found or not np.array_equal(found[name], values) for name, values in grid.items()):
        raise ValueError(f"path: {store} holds a data base with other coordinates")


def missing(store: Path) -> list[Block]:
    """Blocks of a store that have not been computed or cannot be read, all of a size ratio in turn."""
    import zarr

    with damage_told("path", str(store)):
        group: Any = zarr.open_group(store, mode="r")
        done = np.asarray(group[_COMPUTED][:], bool)
        _, angles, rows = group[_COMPUTED].chunks
    blocks = (
        Block(ratio, slice(angle, min(angle + angles, done.shape[1])), slice(row, min(row + rows, done.shape[2])))
        for ratio in range(done.shape[0])
        for angle in range(0, done.shape[1], angles)
        for row in range(0, done.shape[2], rows)
    )
    return [block for block in blocks if not (done[block].all() and _is_whole(group, block))]


def _is_whole(group: Any, block: Block) -> bool:
    """Whether all chunks of a block are there, for a missing one reads as NaN, and none is damaged."""
    try:
        return all(np.isfinite(group[name][block]).any() for name in VARIABLES)
    except Exception:  # each codec raises an error of its own
        return False


class Opened(NamedTuple):
    """A store, opened once for many blocks: to open its arrays takes as long as to compute some."""

    axes: list[Floats]
    arrays: list[Any]  # one for each variable
    computed: Any


def opened(store: Path) -> Opened:
    """Open a store to be written."""
    import zarr

    group: Any = zarr.open_group(store, mode="r+")
    axes = [np.asarray(group[name][:]) for name in DIMS]
    return Opened(axes, [group[name] for name in VARIABLES], group[_COMPUTED])


def fill(store: Opened, block: Block) -> None:
    """Compute a block and write it; the mark that it is done comes last, so that a torn block is computed again."""
    import zarr

    ratios, angles, fillings, neck_ratios = store.axes
    ratio, rows = float(ratios[block.ratio]), fillings[block.rows]
    pairs = [compute(ratio, float(angle), rows, neck_ratios) for angle in angles[block.angles]]
    with zarr.config.set(_ALL_CHUNKS):
        for array, *content in zip(store.arrays, *pairs, strict=True):
            array[block] = np.stack(content)
        store.computed[block] = True
