"""Curves of the force as they were measured: tables with units in their headers, and files of force microscopes.

Files of JPK, Asylum (Igor) and HDF5 are read by afmformats; what an instrument exports as text is a table.
"""

import csv
import re
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground import units
from ..ground.check import as_path, one_of, whole_number
from ..ground.files import in_one_line

__all__ = ["MeasuredCurve", "read_curve"]

Floats = NDArray[np.float64]

_INSTRUMENTS = (".h5", ".ibw", ".jpk-force", ".jpk-force-map", ".jpk-qi-data", ".jpk-qi-series", ".zip")
_TABLES = (".csv", ".txt", ".tsv", ".tab", ".dat", ".asc", "")
_UNIT = {"separation": "m", "force": "N", "error": "N", "time": "s"}
_NAMES = {
    "separation": {"separation", "distance", "gap", "d", "tip position", "tip sample separation", "displacement", "z"},
    "force": {"force", "f", "load", "pull", "adhesion"},
    "error": {"force error", "error", "sigma", "standard error", "uncertainty", "std"},
    "time": {"time", "t"},
}
_IN_BRACKETS = re.compile(r"(.*?)\s*[\[(]\s*([^\])]+?)\s*[\])]\s*")
_AFTER_STROKE = re.compile(r"(.*?)\s*/\s*(\S+)\s*")
_MOST_HEAD = 500  # lines before the numbers


class MeasuredCurve(NamedTuple):
    """A measured curve in SI units, attraction positive, in the order of the file."""

    separation: Floats  # [m]
    force: Floats  # [N]
    force_error: Floats | None  # [N], where the file tells it
    time: Floats | None  # [s]


class _Column(NamedTuple):
    name: str  # as in the file, without its unit
    unit: str
    values: Floats


def read_curve(
    path: Any,
    *,
    columns: tuple[str, str] | None = None,
    units: tuple[str, str] | None = None,
    attraction: str = "positive",
    segment: str = "retract",
    index: int = 0,
) -> MeasuredCurve:
    r"""Measured curve from a file.

    Parameters
    ----------
    path : path
        A table as text, with a line of names above the numbers: ``separation (µm),force (nN)``; ``[µm]``, ``/ µm`` and
        ``_um`` will do as well. Or a force curve of JPK, Asylum or HDF5, which takes ``pip install 'pendular[fit]'``.
    columns : tuple of two str, optional
        Names of separation and force, where those of the file do not tell; of a table also their numbers, from "1" on.
    units : tuple of two str, optional
        Their units, where the file tells none: ``("um", "nN")``.
    attraction : {"positive", "negative"}
        Sign of an attractive force in the table. Files of instruments have their own, negative.
    segment : {"retract", "approach"}
        Which part of a force curve of an instrument.
    index : int
        Which of several curves in such a file, from 0 on.

    Returns
    -------
    MeasuredCurve

    Raises
    ------
    ValueError
        If the file cannot be read, has no such columns, or tells no unit.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "curve.csv"
    ...     _ = file.write_text("gap (um);force (nN)\n0,5;12,0\n1,0;9,5\n")
    ...     read_curve(file).force.round(12)
    array([1.2e-08, 9.5e-09])
    """
    place = as_path("path", path)
    one_of("attraction", attraction, ("positive", "negative"))
    one_of("segment", segment, ("retract", "approach"))
    chosen, told = _pair("columns", columns), _pair("units", units)
    number = whole_number("index", index, 0)
    suffix = place.suffix.lower()
    if suffix in _INSTRUMENTS:
        return _of_instrument(place, chosen, segment, number)
    if suffix not in _TABLES:
        raise ValueError(f"path: '{place}' does not end in one of {', '.join((*_TABLES[:-1], *_INSTRUMENTS))}")
    with in_one_line("path", place, "read"):
        text = place.read_bytes().decode("utf-8-sig", "replace")
    table = _table_of(text, place)
    curve = _curve_of(table, chosen, told, place)
    sign = 1.0 if attraction == "positive" else -1.0
    return curve._replace(force=sign * curve.force)


def _pair(name: str, value: Any) -> tuple[str, str] | None:
    if value is None:
        return None
    if not isinstance(value, tuple | list) or len(value) != 2 or not all(isinstance(one, str) for one in value):
        raise ValueError(f"{name}: {value!r} is not a pair of texts, for separation and force")
    return value[0].strip(), value[1].strip()


def _table_of(text: str, place: Path) -> list[_Column]:
    """Columns of a table."""
    lines = [line for line in text.splitlines() if line.strip()]
    first = next((i for i, line in enumerate(lines[:_MOST_HEAD]) if _numbers(line) is not None), None)
    if first is None:
        raise ValueError(f"path: '{place}' holds no row of numbers in its first {_MOST_HEAD} lines")
    mark = _mark_of(lines[first])
    rows: list[list[float]] = []
    for i, line in enumerate(lines[first:], first + 1):
        row = _numbers(line, mark)
        if row is None or (rows and len(row) != len(rows[0])):
            if line.lstrip().startswith("#"):
                continue
            raise ValueError(f"path: '{place}' has no {len(rows[0])} numbers in its row {i}, {line.strip()[:40]!r}")
        rows.append(row)
    count = len(rows[0])
    heads = [_cells(line.lstrip("# "), mark) for line in lines[:first]]
    names = next((head for head in reversed(heads) if len(head) == count), [""] * count)
    values = np.array(rows)
    return [_Column(*_name_and_unit(name), values[:, i]) for i, name in enumerate(names)]


def _mark_of(line: str) -> str | None:
    """What stands between the cells."""
    return next((mark for mark in ("\t", ";") if mark in line.strip()), "," if _is_comma_table(line) else None)


def _is_comma_table(line: str) -> bool:
    """Whether commas are between cells; between digits alone, beside spaces, they are decimal."""
    return "," in line and not re.fullmatch(r"\s*[-+\d,eE]+(\s+[-+\d,eE]+)+\s*", line)


def _cells(line: str, mark: str | None) -> list[str]:
    if mark is None:
        apart = re.sub(r"\s+(?=[\[(/])|(?<=/)\s+", "", line)  # a unit stays with its name
        return apart.split()
    return [cell.strip() for cell in next(csv.reader([line], delimiter=mark))]


def _numbers(line: str, mark: str | None = None) -> list[float] | None:
    """Numbers of a row; None if it is not one."""
    mark = mark or _mark_of(line)
    cells = line.split() if mark is None else _cells(line, mark)
    while len(cells) > 1 and not cells[-1]:
        cells.pop()
    try:
        return [float(cell if mark == "," else cell.replace(",", ".")) for cell in cells]
    except ValueError:
        return None


def _name_and_unit(head: str) -> tuple[str, str]:
    """Name of a column and its unit, empty if it tells none.

    Examples
    --------
    >>> [_name_and_unit(head) for head in ("gap [µm]", "F / mN", "Defl_pN_Rt", "time")]
    [('gap', 'µm'), ('F', 'mN'), ('Defl_Rt', 'pN'), ('time', '')]
    """
    for form in (_IN_BRACKETS, _AFTER_STROKE):
        match = form.fullmatch(head)
        if match:
            return match[1], match[2]
    parts = head.split("_")
    for i, part in enumerate(parts[1:], 1):
        if any(_size_of(part, unit) for unit in ("m", "N", "s")) and len(part) < 4:
            return "_".join(parts[:i] + parts[i + 1 :]), part
    return head, ""


@cache
def _size_of(own: str, unit: str) -> float:
    """Size of a unit in an SI unit; 0 if it is of another dimension or none."""
    try:
        return units.read("unit", f"1 {own}", unit, unit) if own else 0.0
    except ValueError:
        return 0.0


def _curve_of(
    table: list[_Column], chosen: tuple[str, str] | None, told: tuple[str, str] | None, place: Path
) -> MeasuredCurve:
    """Separation and force among the columns, and what else the table tells."""
    found = {}
    for i, what in enumerate(("separation", "force")):
        column = _named(table, chosen[i], place) if chosen else _likely(table, what, place, told is not None)
        unit = told[i] if told else column.unit
        if not unit:
            raise ValueError(
                f"units: column {column.name!r} of '{place}' has none; write {column.name} (um) in its header"
            )
        size = _size_of(unit, _UNIT[what])
        if not size:
            raise ValueError(f"units: {unit!r} of column {column.name!r} is not a unit of {what}")
        found[what] = column.values * size
    for what in ("error", "time"):
        likely = [one for one in table if _key(one.name) in _NAMES[what] and _size_of(one.unit, _UNIT[what])]
        if len(likely) == 1:
            found[what] = likely[0].values * _size_of(likely[0].unit, _UNIT[what])
    for what, values in found.items():
        if not np.isfinite(values).all():
            raise ValueError(
                f"path: '{place}' has no number in row {int(np.argmin(np.isfinite(values))) + 1} of {what}"
            )
    return MeasuredCurve(found["separation"], found["force"], found.get("error"), found.get("time"))


def _key(name: str) -> str:
    return re.sub(r"[\s_-]+", " ", name).strip().lower()


def _named(table: list[_Column], name: str, place: Path) -> _Column:
    """The column of a name, or of a number."""
    for column in table:
        if _key(column.name) == _key(name):
            return column
    if name.isdigit() and 1 <= int(name) <= len(table):
        return table[int(name) - 1]
    known = ", ".join(repr(column.name) for column in table if column.name) or f"1 to {len(table)}"
    raise ValueError(f"columns: {name!r} is none of '{place}', which has {known}")


def _likely(table: list[_Column], what: str, place: Path, has_units: bool) -> _Column:
    """The one column of a quantity by its name, or by its unit."""
    by_name = [column for column in table if _key(column.name) in _NAMES[what]]
    by_unit = [
        column for column in table if _size_of(column.unit, _UNIT[what]) and _key(column.name) not in _NAMES["error"]
    ]
    for likely in (by_name, by_unit):
        if len(likely) == 1:
            return likely[0]
    if len(table) == 2 and has_units:
        return table[0 if what == "separation" else 1]
    known = ", ".join(repr(column.name) for column in table if column.name) or f"{len(table)} columns without names"
    raise ValueError(f"columns: which of '{place}' is the {what} is not told by its header, {known}; name both columns")


def _of_instrument(place: Path, chosen: tuple[str, str] | None, segment: str, number: int) -> MeasuredCurve:
    """One segment of a force curve, read by afmformats."""
    if find_spec("afmformats") is None:
        raise ValueError(f"path: '{place}' needs afmformats; pip install 'pendular[fit]'")
    with in_one_line("path", place, "read"):
        place.open("rb").close()
    import afmformats
    from afmformats.errors import AFMFileFormatError, MissingMetaDataError

    try:
        curves = afmformats.load_data(place)
    except (Exception, AFMFileFormatError, MissingMetaDataError) as error:  # its own are no kind of Exception
        told = " ".join(str(error).split())
        raise ValueError(f"path: '{place}' is not a force curve: {type(error).__name__}: {told}") from error
    if number >= len(curves):
        raise ValueError(f"index: {number} is not below {len(curves)}, the curves of '{place}'")
    curve = curves[number]
    rows = np.asarray(curve["segment"]).astype(int) == (1 if segment == "retract" else 0)
    if not rows.any():
        raise ValueError(f"segment: '{place}' has no {segment}")
    force = np.asarray(curve[chosen[1] if chosen else "force"], dtype=np.float64)
    separation = (
        _tip_position(curve, force, place) if chosen is None else np.asarray(curve[chosen[0]], dtype=np.float64)
    )
    time = np.asarray(curve["time"], dtype=np.float64)[rows] if "time" in curve.columns else None
    return MeasuredCurve(separation[rows], -force[rows], None, time)


def _tip_position(curve: Any, force: Floats, place: Path) -> Floats:
    """Height of the tip: as told, or that of the cantilever's base and its deflection."""
    if "tip position" in curve.columns:
        return np.asarray(curve["tip position"], dtype=np.float64)
    stiffness = curve.metadata.get("spring constant", np.nan)
    for name in ("height (measured)", "height (piezo)"):
        if name in curve.columns and stiffness > 0.0:
            base: Floats = np.asarray(curve[name], dtype=np.float64)
            return base + force / float(stiffness)
    raise ValueError(f"columns: '{place}' tells no height of the tip, nor that of its base with a spring constant")
