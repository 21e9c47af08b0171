"""Commands for many bridges at once: the data base, and the paper."""

import math
import re
import sys
from importlib import import_module
from pathlib import Path
from typing import Annotated

import typer

from ..options import read_contact_angle
from ._app import app, need_extra

__all__ = ["dataset", "paper"]


@app.command(epilog="\b\nExample:\n  pendular dataset bridges.zarr --workers 2 --check")
def dataset(
    path: Annotated[Path, typer.Argument(help="Zarr store to write, or to continue: bridges.zarr.")],
    shape: Annotated[str, typer.Option(help="Half-filling angles x neck ratios.", metavar="NxM")] = "240x200",
    ratio: Annotated[list[float] | None, typer.Option(help="Size ratio; may be repeated. 1, 2, 8, 128.")] = None,
    contact_angle: Annotated[
        list[str] | None,
        typer.Option(help="Contact angle: 20 or 20deg, 0.35rad; may be repeated. 0, 20, 40.", metavar="ANGLE"),
    ] = None,
    workers: Annotated[str | None, typer.Option(help="Processes, or the address of a Dask scheduler.")] = None,
    netcdf: Annotated[Path | None, typer.Option(help="Copy to a NetCDF file: bridges.nc.", metavar="FILE")] = None,
    check: Annotated[bool, typer.Option("--check", help="Print the error of its interpolation.")] = False,
) -> None:
    """Data base of bridges over half-filling angle and neck ratio."""
    from ...dataset import base as data
    from ...dataset.variables import VARIABLES
    from ...show.text import dataset_lines, interpolation_lines

    counts = re.fullmatch(r"(\d+)x(\d+)", shape)
    if counts is None:
        raise ValueError(f"shape: {shape!r} is not of the form 240x200")
    need_extra("data", "xarray", "zarr", "h5netcdf", "dask")
    degrees = None if contact_angle is None else sorted(read_contact_angle("contact-angle", a) for a in contact_angle)
    sizes = data.fill_store(
        path,
        shape=(int(counts[1]), int(counts[2])),
        size_ratio=sorted(ratio or data.PAPER_RATIOS),
        contact_angle=data.PAPER_ANGLES if degrees is None else [math.radians(angle) for angle in degrees],
        workers=int(workers) if workers is not None and workers.isdigit() else workers,
        progress=True,
    )
    if netcdf is not None:
        data.save_dataset(data.load_dataset(path), netcdf)
    typer.echo(dataset_lines(sizes, VARIABLES))
    if check:
        typer.echo(interpolation_lines(data.load_dataset(path)))


@app.command(epilog="\b\nExample:\n  pendular paper --out paper")
def paper(
    out: Annotated[Path, typer.Option(help="Folder for figures, claims.json and index.html.", metavar="DIR")],
) -> None:
    """The paper of Zhao, Kruyt and Millet, its figures drawn anew, its claims measured; in a copy of the source."""
    source = Path(__file__).parents[4]
    if not (source / "studies" / "paper").is_dir():
        raise ValueError("paper: it stands beside the source, not in the package; there, python -m studies.paper")
    sys.path.insert(0, str(source))
    typer.echo(import_module("studies.paper.__main__").write(out))
