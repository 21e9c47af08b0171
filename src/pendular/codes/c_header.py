"""A table as one C header without dependencies, for particle codes of one's own."""

import math
import re
from collections.abc import Iterator
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import __version__
from ..table.binary import CHANNELS
from ..table.kernels import CELLS, Q_COUNT, SIZE_CELLS, U_COUNT, Grid
from ..table.measure import SAFETY
from ..table.polynomial import CELL, LANES, RUPTURE_CELL, coefficients_of
from ..table.task import refuse_dry

if TYPE_CHECKING:
    from ..table import Table

__all__ = ["LARGEST", "bound_lines", "c_header", "headers", "table_header"]

LARGEST = 1_000_000  # [bytes]

Floats = NDArray[np.float64]
_INTEGER = 2.0**31  # below it, a coefficient is written as an int
_NUMBERS = ("rupture", "force", "liquid_numbers")  # arrays of the grid that are channels of the header
_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_TAKEN = "pendular_table_"
_LICENCE = "Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty."


class _Control(NamedTuple):
    """What differs between tables for one control and for the other."""

    control_star: str
    unit: str
    liquid: str
    liquid_meaning: str
    liquid_comment: str


_CONTROLS = {
    "suction": _Control(
        control_star="suction Rm/gamma",
        unit="Pa: gas pressure minus liquid pressure",
        liquid="volume",
        liquid_meaning="of the liquid [m3]",
        liquid_comment="Volume of the liquid [m3]",
    ),
    "volume": _Control(
        control_star="volume/Rm^3",
        unit="m3",
        liquid="suction",
        liquid_meaning="gas pressure minus liquid pressure [Pa]",
        liquid_comment="Gas pressure minus liquid pressure [Pa]",
    ),
}


def table_header() -> str:
    """Text of `pendular_table.h`, the C header that opens tables and answers what they answer."""
    return (files(__package__) / "pendular_table.h").read_text(encoding="utf-8")


def headers() -> dict[str, bytes]:
    """The C headers that programs with bridges of their own include, by their names."""
    names = ("pendular_table.h", "pendular_viscous.h")
    return {name: (files(__package__) / name).read_bytes() for name in names}


def c_header(table: "Table", *, prefix: str = "pendular_") -> str:
    """Text of a C header that answers what a table answers, in C99, C++11 and CUDA.

    It is the text of :func:`table_header` with the numbers of the table, and functions that know them. The numbers of a
    cell are stored as integers times a power of two, as far as they are: that is short, and exact.

    Parameters
    ----------
    table : Table
        As `pendular.tabulate` makes it; a tolerance of 1e-6 is right for most.
    prefix : str
        Begins all names of the header, so that one program may use several.

    Returns
    -------
    str
        Functions ``force``, ``stiffness``, ``energy``, ``rupture_distance``, and ``volume``, or ``suction`` for a table
        of constant volume, each after the prefix.

    Raises
    ------
    ValueError
        If the prefix is no identifier of C, the table holds no bridge, or the header would be larger than a megabyte.

    Examples
    --------
    >>> import pendular as pl
    >>> text = c_header(pl.tabulate(0.35, reduced=(1.0, 10.0), tolerance=1e-4))
    >>> "static inline" in text, "pendular_force(" in text
    (True, True)
    """
    if not _IDENTIFIER.fullmatch(prefix):
        raise ValueError(f"prefix: {prefix!r} does not begin a name in C; write it like pendular_")
    if prefix == _TAKEN:
        raise ValueError(f"prefix: {prefix!r} begins names of the header itself; choose another one")
    if table.control == "suction":
        refuse_dry(table.contact_angle)
    template = Template((files(__package__) / "header.h.in").read_text(encoding="utf-8"))
    words = _CONTROLS[table.control]._asdict() | _about(table) | _numbers(table.grid)
    text = template.substitute(words, prefix=prefix, guard_stem=prefix.upper().rstrip("_"))
    if len(text) > LARGEST:
        size = f"{len(text) / 1e6:.2f} MB; more than {LARGEST / 1e6:g} MB is refused"
        advice = f"give a larger one, or a shorter range of the {table.control} or of the radius ratio"
        raise ValueError(f"tolerance: {table.tolerance:g} makes a header of {size}; {advice}")
    return text


def _about(table: "Table") -> dict[str, object]:
    """What the comment says of the table, and the constants of the functions."""
    grid, liquid = table.grid, _CONTROLS[table.control].liquid
    first, second = (f"{math.degrees(angle):.10g}" for angle in table.contact_angle)
    return {
        "version": __version__,
        "licence": f"   {_LICENCE}",
        "control": table.control,
        "angles": f"{first} degrees" if first == second else f"{first} degrees on solid 1, {second} degrees on solid 2",
        "range_low": f"{grid.low:.10g}",
        "range_high": f"{grid.high:.10g}",
        "ratios": _ratios(grid),
        "liquid_gap": " " * (len("stiffness") - len(liquid) + 3),
        "bounds": "\n".join(f"   {line}" for line in bound_lines(table)),
        "evaluator": table_header(),
        "table": ", ".join(_members(table)),
        "channels": ", ".join(_channels(table)),
    }


def _channels(table: "Table") -> Iterator[str]:
    """Initialisers of the channels, in their order."""
    names = (("rupture_distance", "rupture"), ("force", "force"), (_CONTROLS[table.control].liquid, "liquid"))
    for channel, name in names:
        _, _, factor, *powers = CHANNELS[channel]
        bound = _number(getattr(table.bound, name))
        yield f"{{{name}, {_decimal(factor)}, {bound}, {', '.join(str(int(power)) for power in powers)}}}"


def _members(table: "Table") -> Iterator[str]:
    """Initialisers of the members of a table after its channels."""
    grid = table.grid
    yield from map(_decimal, (grid.low, grid.high, grid.least_ratio, grid.largest_ratio))
    yield from map(str, (grid.shift, grid.first, grid.cells, grid.sides, len(_NUMBERS), int(grid.is_volume)))
    for pair in (table.contact_angle, table.reduced, table.radius_ratio):
        yield f"{{{', '.join(map(_number, pair))}}}"
    yield _decimal(table.tolerance)


def _ratios(grid: Grid) -> str:
    low = f"{1.0 / grid.largest_ratio:.10g}"
    return f"{low} to {1.0 / grid.least_ratio:.10g}" if grid.least_ratio > 0.0 else f"from {low}"


def _numbers(grid: Grid) -> dict[str, str]:
    """Rows and coefficients, these in units of the largest power of two that divides all of a row."""
    force, liquid = (coefficients_of(cells).reshape(-1, CELL) for cells in (grid.force, grid.liquid))
    arrays = [grid.rupture.reshape(-1, RUPTURE_CELL), force, liquid]
    scaled = [array.copy() for array in arrays]
    units = np.empty((len(grid.lines), len(arrays)))
    for row, cut in enumerate(grid.cuts):
        size_cells = slice(cut[SIZE_CELLS], cut[SIZE_CELLS] + cut[U_COUNT])
        cells = slice(cut[CELLS], cut[CELLS] + cut[U_COUNT] * cut[Q_COUNT])
        for channel, part in enumerate((size_cells, cells, cells)):
            units[row, channel] = _unit(arrays[channel][part])
            scaled[channel][part] = arrays[channel][part] / units[row, channel]
    rows = {"lines": grid.lines, "cuts": grid.cuts, "units": units}
    texts = {name: array.tolist() for name, array in rows.items()}
    texts |= {name: array.reshape(-1, LANES).tolist() for name, array in zip(_NUMBERS, scaled, strict=True)}
    return {name: ",\n".join(",".join(map(_coefficient, row)) for row in text) for name, text in texts.items()}


def _coefficient(number: float) -> str:
    """Shortest of the texts that C reads as the number."""
    return str(int(number)) if float(number).is_integer() and abs(number) < _INTEGER else _decimal(number)


def _number(number: float) -> str:
    """A decimal, or the name of C for infinity."""
    return "INFINITY" if math.isinf(number) else _decimal(number)


def _decimal(number: float) -> str:
    """Shortest decimal that is read as the number."""
    return repr(float(number))


def _unit(numbers: Floats) -> float:
    """Largest power of two of which all numbers are whole multiples."""
    mantissa, exponent = np.frexp(numbers[numbers != 0.0])
    whole = np.ldexp(mantissa, 53).astype(np.int64)
    lowest_bit = np.frexp((whole & -whole).astype(float))[1] - 1
    return 2.0 ** int((exponent - 53 + lowest_bit).min(initial=0))


def bound_lines(table: "Table") -> list[str]:
    """Errors of a table for people, a line each."""
    liquid, bound = _CONTROLS[table.control].liquid, table.bound
    unit = "of that at contact" if table.control == "suction" else "of gamma sqrt(Rm/V)"
    return [
        f"Bounds of error  force {bound.force:.1e} of the largest, mostly that at contact (asked {table.tolerance:g}),",
        f"                 rupture distance {bound.rupture:.1e} of itself, {liquid} {bound.liquid:.1e} {unit};",
        f"                 {SAFETY:g} times the worst of {bound.bridges} exact bridges, sought in all cells",
    ]
