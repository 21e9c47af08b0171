"""Answers as text: tables for people, JSON and CSV for machines."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from ..ask.face import FIELDS, Bridge
from ..ground.check import plain
from ..ground.units import Scale, scale_of, show

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import ArrayLike, NDArray
    from rich.table import Table

__all__ = [
    "ENDINGS",
    "UNITS",
    "Column",
    "column_of",
    "columns",
    "csv_text",
    "curve_table",
    "dataset_lines",
    "interpolation_lines",
    "json_text",
    "plain_fields",
    "rupture_table",
    "spread",
    "state_rows",
    "state_table",
    "sweep_table",
    "table_of",
    "with_asked",
]

UNITS = {name: unit for name, unit, _ in FIELDS}

# Fields with a last axis of two; but for the tensor, one for each solid.
ENDINGS = {
    "contact_radius": ("1", "2"),
    "half_filling_angle": ("1", "2"),
    "wetted_area": ("1", "2"),
    "capillary_tensor": ("11", "33"),
}
_CURVE_FIELDS = ("separation", "force", "volume", "suction", "neck_radius")
_BUT_SEPARATION = ["force", *(name for name in UNITS if name not in ("separation", "force"))]
_WITHOUT_BRIDGE = ["force", "exists"]
_MOST_ROWS = 24  # of a curve in a table for people

AnyBridge = TypeVar("AnyBridge", bound=Bridge)
Row = tuple[str, str, str]  # name, value with unit, meaning


class Column(NamedTuple):
    """A number of an answer, or an array of them, in SI units."""

    name: str
    unit: str
    values: Any


def columns(bridge: Bridge) -> list[Column]:
    """Fields of an answer in their order, those of two solids taken apart.

    Examples
    --------
    >>> import pendular as pl
    >>> grains, water = pl.Pair(radius=50e-6, contact_angle=0.0), pl.Liquid(surface_tension=0.0728)
    >>> answer = columns(pl.bridge(grains, 1e-6, suction=20e3, liquid=water))
    >>> [column.name for column in answer][10:12]
    ['contact_radius_1', 'contact_radius_2']
    """
    return [column for name, unit in UNITS.items() for column in _apart(name, unit, getattr(bridge, name))]


def _apart(name: str, unit: str, values: Any) -> Iterator[Column]:
    if name not in ENDINGS:
        yield Column(name, unit, values)
        return
    for i, ending in enumerate(ENDINGS[name]):
        yield Column(f"{name}_{ending}", unit, values[..., i])


def column_of(name: str, bridge: Bridge) -> Column:
    """Column of a field that is one number."""
    return Column(name, UNITS[name], getattr(bridge, name))


def spread(name: str, unit: str, values: Any, bridge: Bridge) -> Column:
    """Column of as many values as there are bridges."""
    return Column(name, unit, np.broadcast_to(values, np.shape(bridge.exists)))


def with_asked(bridge: AnyBridge, **asked: ArrayLike) -> AnyBridge:
    """Answer that tells what was asked also where there is no bridge, so that each point is known.

    Parameters
    ----------
    bridge : Bridge
        The answer.
    **asked : array_like
        Arguments under their names; those that are no fields are passed over.

    Returns
    -------
    Bridge

    Examples
    --------
    >>> import pendular as pl
    >>> grains, water = pl.Pair(radius=50e-6), pl.Liquid(surface_tension=0.0728)
    >>> far = pl.bridge(grains, 1e-3, suction=20e3, liquid=water)
    >>> far.separation, with_asked(far, separation=1e-3).separation
    (nan, 0.001)
    """
    kept = {
        name: plain(np.where(_each(bridge.exists, name), getattr(bridge, name), values))
        for name, values in asked.items()
        if name in UNITS
    }
    return replace(bridge, **kept)


def _each(exists: Any, name: str) -> Any:
    """Whether there is a bridge, for each number of a field."""
    return np.asarray(exists)[..., None] if name in ENDINGS else exists


def on_solid(values: ArrayLike, solid: int, bridge: Bridge) -> NDArray[np.float64]:
    """Values that are known of one solid, 0 or 1, with the axis of both."""
    both = np.full((*np.shape(bridge.exists), 2), math.nan)
    both[..., solid] = values
    return both


def csv_text(*tables: list[Column]) -> str:
    """Rows of one or more tables of the same columns, under a line of names with units.

    Examples
    --------
    >>> print(csv_text([Column("force", "N", [1e-6, 2e-6]), Column("stable", "", [True, False])]), end="")
    force [N],stable
    1e-06,true
    2e-06,false
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(f"{name} [{unit}]" if unit else name for name, unit, _ in tables[0])
    for table in tables:
        for row in zip(*(np.atleast_1d(column.values).tolist() for column in table), strict=True):
            writer.writerow(str(cell).lower() if isinstance(cell, bool) else cell for cell in row)
    return text.getvalue()


def dataset_lines(sizes: Mapping[str, int], variables: Iterable[str]) -> str:
    """What a data base holds, as lines of text.

    Examples
    --------
    >>> print(dataset_lines({"half_filling_angle": 240, "neck_ratio": 200}, ["force_star"]))
    48000 points: 240 half filling angle x 200 neck ratio
    variables: force_star
    """
    axes = " x ".join(f"{count} {name.replace('_', ' ')}" for name, count in sizes.items())
    return f"{math.prod(sizes.values())} points: {axes}\nvariables: {', '.join(variables)}"


def interpolation_lines(dataset: xr.Dataset) -> str:
    """Measured error of the interpolation of a data base, as lines of text."""
    from ..dataset.interpolation import interpolation_error

    rows = interpolation_error(dataset).to_dataframe().to_string(float_format=lambda x: f"{x:.2g}")
    return f"\nrelative error of the interpolation against the exact solution\n{rows}"


def plain_fields(bridge: Bridge) -> dict[str, Any]:
    """Fields of an answer by name.

    Examples
    --------
    >>> import pendular as pl
    >>> grains, water = pl.Pair(radius=50e-6, contact_angle=0.0), pl.Liquid(surface_tension=0.0728)
    >>> list(plain_fields(pl.bridge(grains, 1e-6, suction=20e3, liquid=water)))[:3]
    ['separation', 'suction', 'volume']
    """
    return {name: getattr(bridge, name) for name in UNITS}


def json_text(answer: Mapping[str, Any]) -> str:
    """Numbers, arrays and mappings of them as JSON, where null is what is not a finite number.

    Examples
    --------
    >>> json_text({"force": 0.0, "neck_radius": math.nan, "contact_radius": np.array([1e-6, 2e-6])}).split()
    ['{', '"force":', '0.0,', '"neck_radius":', 'null,', '"contact_radius":', '[', '1e-06,', '2e-06', ']', '}']
    """
    return json.dumps(_jsonable(answer), indent=2, allow_nan=False)


def _jsonable(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _jsonable(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [_jsonable(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def state_table(bridge: Bridge, more: Mapping[str, tuple[str, str]]) -> Table:
    """Table of one bridge: name, value with unit, meaning.

    Parameters
    ----------
    bridge : Bridge
        Of single numbers. Where it does not exist, only that and the force are told.
    more : mapping
        Further rows to stand after the force: from their name to their value and meaning, in words.

    Returns
    -------
    rich.table.Table
    """
    return _table_of_rows(state_rows(bridge, more))


def state_rows(bridge: Bridge, more: Mapping[str, tuple[str, str]]) -> list[Row]:
    """Rows of the table of one bridge, as `state_table`: name, value with unit, meaning.

    Examples
    --------
    >>> import pendular as pl
    >>> grains, water = pl.Pair(radius=50e-6, contact_angle=0.0), pl.Liquid(surface_tension=0.0728)
    >>> state_rows(pl.bridge(grains, 1e-6, suction=20e3, liquid=water), {})[0]
    ('separation', '1 µm', 'whole gap, surface to surface')
    """
    return _rows(["separation", *_BUT_SEPARATION] if bridge.exists else _WITHOUT_BRIDGE, bridge, more)


def rupture_table(bridge: Bridge, more: Mapping[str, tuple[str, str]]) -> Table:
    """Table of a bridge at its fold, as `state_table`, with the distance first; the stiffness is beyond all numbers."""
    if not bridge.exists:
        return _table_of_rows(_rows(_WITHOUT_BRIDGE, bridge, {}))
    distance = ("rupture distance", show(float(bridge.separation), "m"), "separation at which the bridge breaks")
    names = [name for name in _BUT_SEPARATION if name != "stiffness"]
    extra = [(name, words, meaning) for name, (words, meaning) in more.items()]
    return _table_of_rows([distance, *extra, *_rows(names, bridge, {})])


def _rows(names: Iterable[str], bridge: Bridge, more: Mapping[str, tuple[str, str]]) -> list[Row]:
    meanings = {name: meaning for name, _, meaning in FIELDS}
    rows = []
    for name in names:
        rows.append((name.replace("_", " "), _in_words(name, getattr(bridge, name)), meanings[name]))
        if name == "force":
            rows += [(extra, words, meaning) for extra, (words, meaning) in more.items()]
    return rows


def _table_of_rows(rows: Iterable[Row]) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), show_header=False)
    table.add_column(style="bold", no_wrap=True)
    table.add_column(no_wrap=True)
    table.add_column(style="dim")
    for row in rows:
        table.add_row(*row)
    return table


def _in_words(name: str, value: Any) -> str:
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if name not in ENDINGS:
        return show(float(value), UNITS[name])
    first, second = (show(float(one), UNITS[name]) for one in value)
    return f"{first} each" if first == second and name != "capillary_tensor" else f"{first}, {second}"


def curve_table(curve: Bridge) -> Table:
    """Table of the states of a curve, thinned out to what a person reads; the fold stays in it.

    Parameters
    ----------
    curve : Bridge
        One axis of states, from `pendular.curve`.

    Returns
    -------
    rich.table.Table
    """
    values = {name: np.asarray(getattr(curve, name)) for name in _CURVE_FIELDS}
    stable = np.asarray(curve.stable)
    fold, step = stable.size // 2, -(-stable.size // _MOST_ROWS)
    table = _table_of_columns([Column(name, UNITS[name], values[name]) for name in _CURVE_FIELDS], "stable")
    cells = [_cells(UNITS[name], values[name]) for name in _CURVE_FIELDS]
    for i in range(fold % step, stable.size, step):
        word = "rupture" if i == fold else "yes" if stable[i] else "no"
        table.add_row(*(column[i] for column in cells), word, style="bold" if i == fold else None)
    return table


def sweep_table(columns: list[Column], bridge: Bridge) -> Table:
    """Table of the states of a sweep, a row each, and whether there is a bridge.

    Parameters
    ----------
    columns : list of Column
        What is told of each state.
    bridge : Bridge
        One axis of states.

    Returns
    -------
    rich.table.Table
    """
    words = np.where(bridge.exists, np.where(bridge.stable, "stable", "unstable"), "none")
    return table_of(columns, "bridge", words.tolist())


def table_of(columns: list[Column], last: str, words: list[str]) -> Table:
    """Table of numbers, a column each under its name and unit, and a last column of words."""
    table = _table_of_columns(columns, last)
    for row in zip(*(_cells(column.unit, column.values) for column in columns), words, strict=True):
        table.add_row(*row)
    return table


def _table_of_columns(columns: list[Column], last: str) -> Table:
    """Table without rows: a column for each quantity under its name and unit, and one for a word."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 3, 0, 0), header_style="bold")
    for name, unit, values in columns:
        table.add_column(f"{name.replace('_', ' ')}\n{_scale_of_all(unit, values).unit}", justify="right")
    table.add_column(f"{last}\n")
    return table


def _cells(unit: str, values: Any) -> list[str]:
    """Numbers of a column in the unit that stands above them; a dash for what is not a number."""
    factor = _scale_of_all(unit, values).factor
    # Rounded, so that contact is 0 and not the last digit of a sum; and 0 is not -0.
    return ["–" if math.isnan(one) else f"{round(one * factor, 9) + 0.0:.5g}" for one in np.asarray(values).tolist()]


def _scale_of_all(unit: str, values: Any) -> Scale:
    return scale_of(float(np.max(np.abs(values), initial=0.0, where=~np.isnan(values))), unit)
