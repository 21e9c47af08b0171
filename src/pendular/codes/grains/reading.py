"""Grains of a file of another program as a packing: the format is known by the content, the unit by the user's word."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...ground import units
from ...ground.check import as_path, in_range, quantity
from ...ground.files import in_one_line
from ...packing.heap import Packing
from . import gsd_frames, lammps_data, lammps_dump, mercury, others, parquet, rows, text_table, vtk_legacy, vtk_xml
from .found import Found

__all__ = ["read_packing"]

_SMALLEST, _LARGEST = 1e-9, 1.0  # radii of grains, [m]
_TABLES = (".txt", ".csv", ".tsv", ".dat", ".xyzr", ".spheres", ".yade", "")
_MESHES = (".xdmf", ".xmf", ".ply", ".msh", ".h5m", ".e", ".exo", ".med", ".inp", ".vol", ".obj", ".stl", ".off")


def read_packing(
    path: Any,
    *,
    unit: str | float | None = None,
    radius: ArrayLike | None = None,
    cell: ArrayLike | None = None,
    periodic: Any = None,
    frame: int = -1,
) -> Packing:
    r"""Packing of the grains in a file of another program.

    Known by their content are dumps of LAMMPS and LIGGGHTS, data files of LAMMPS, texts of YADE, files ``.data`` of
    MercuryDPM, VTK (``.vtk``, ``.vtu``, ``.vtp``), GSD, Parquet, and tables as text with named columns or ``x y z r``;
    what else ase and meshio read is read by them. Texts may be packed by gzip.

    Parameters
    ----------
    path : path
        The file.
    unit : str or float, optional
        Length that the file's 1 means, ``"mm"`` or 1e-3 m. Without it that which the file tells, else the metre.
    radius : array_like, optional
        Of all grains or of each, [m], in place of what the file tells.
    cell : array_like, optional
        Three lengths or three vectors as rows, [m], in place of what the file tells.
    periodic : bool or three of them, optional
        Along which vectors of the cell the heap repeats, in place of what the file tells.
    frame : int
        Of a file of several: from 0 on, or from the end by -1 and below.

    Returns
    -------
    Packing
        Grains in the order of their numbers where the file has them, else in the file's order.

    Raises
    ------
    ValueError
        In one line: a file that is not there, of no known format, damaged, cut off, without radii where none are given,
        or with radii outside of [1 nm, 1 m], which another unit explains.

    Notes
    -----
    A data file of LAMMPS does not tell what repeats, and counts as periodic in all directions, as there; a file of
    MercuryDPM as periodic in none. Tables and VTK tell no cell.

    Examples
    --------
    >>> from pathlib import Path; from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "heap.txt")
    ...     _ = path.write_text("#format x_y_z_r\n0 0 0 0.5\n0 0 1.01 0.5\n")
    ...     read_packing(path, unit="mm").positions[1]
    array([0.     , 0.     , 0.00101])
    """
    file = as_path("path", path)
    if isinstance(frame, bool) or not isinstance(frame, (int, np.integer)):
        raise ValueError(f"frame: {frame!r} is not a whole number")
    with in_one_line("path", file, "read"):
        reader = _reader(file, int(frame))
        try:
            found = reader()
        except (ValueError, EOFError) as error:
            raise ValueError(f"path: '{file}' cannot be read: {error}") from error
    if len(found.positions) == 0:
        raise ValueError(f"path: '{file}' holds no grain")
    scale = _scale(file, unit, found.unit)
    radii = _radii(file, found, radius, scale)
    box: Any = found.cell * scale if cell is None and found.cell is not None else cell
    repeats: Any = next((told for told in (periodic, found.periodic) if told is not None), True)
    return Packing(found.positions * scale, radii, box, repeats)


def _scale(file: Path, unit: str | float | None, own: str | None) -> float:
    """Metres that the file's 1 means."""
    if unit is None:
        return 1.0 if own is None else units.read("unit", f"1 {own}", "m", "1mm")
    if isinstance(unit, str):
        said = units.read("unit", f"1 {unit}", "m", "mm")
    else:
        said = float(in_range("unit", quantity("unit", unit, "m"), 0.0, brackets="(]", unit="m"))
    told = said if own is None else units.read("unit", f"1 {own}", "m", "1mm")
    if abs(said / told - 1.0) > 1e-9:
        raise ValueError(f"unit: {unit!r} is not the unit that '{file}' tells, {own}")
    return said


def _radii(file: Path, found: Found, radius: ArrayLike | None, scale: float) -> NDArray[np.float64]:
    if radius is not None:
        return quantity("radius", radius, "m")
    if found.radii is None:
        raise ValueError(f"radius: '{file}' tells no radii; give them, like radius=50e-6 or --radius 50um")
    radii = in_range("radii", found.radii * scale, 0.0, brackets="()", unit="m")
    low, high = float(radii.min()), float(radii.max())
    if low < _SMALLEST or high > _LARGEST:
        raise ValueError(
            f"unit: the radii of '{file}' would be {low:.3g} to {high:.3g} m, which is not in [1 nm, 1 m]; "
            "say what the file's 1 means, like unit='mm'"
        )
    return radii


def _reader(file: Path, frame: int) -> Callable[[], Found]:
    """Reader of the format, by the first bytes where they tell, else by the name."""
    raw = _start(file)
    text = raw.decode("utf-8-sig", "replace")
    suffix = next((ending for ending in reversed(file.suffixes) if ending != ".gz"), "").lower()
    known: tuple[tuple[bool, Callable[[], Found]], ...] = (
        (text.startswith("ITEM:"), lambda: lammps_dump.read(file, frame)),
        (raw.startswith(b"PAR1"), lambda: parquet.read(file)),
        (raw.startswith(b"\xdf\x65" * 4), lambda: gsd_frames.read(file, frame)),
        (text.startswith("# vtk DataFile"), lambda: vtk_legacy.read(file)),
        ("<VTKFile" in text, lambda: vtk_xml.read(file)),
        (mercury.looks_like(text), lambda: mercury.read(file, frame)),
        (lammps_data.looks_like(text), lambda: lammps_data.read(file)),
        (suffix in _MESHES, lambda: others.read_meshio(file)),
        (suffix in _TABLES or text.startswith("#format"), lambda: text_table.read(file)),
    )
    found = next((reader for is_it, reader in known if is_it), None)
    return found or (lambda: others.read_ase(file, frame))


def _start(file: Path) -> bytes:
    """First bytes of what the file holds."""
    if not file.is_file():
        raise ValueError(f"path: '{file}' is not a file")
    with rows.opened(file) as content:
        try:
            start = content.read(4096)
        except EOFError as error:
            raise ValueError(f"path: '{file}' is cut off: {error}") from error
    if not start:
        raise ValueError(f"path: '{file}' is empty")
    return start
