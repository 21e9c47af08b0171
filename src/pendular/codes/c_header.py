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
from ..table.kernels import CELLS, Q_COUNT, SIZE_CELLS, U_COUNT, Grid
from ..table.polynomial import CELL, CONTROL_TERMS, LANES, LEAST_SIZE_TERMS, RUPTURE_CELL, RUPTURE_SIZE_TERMS
from ..table.task import holds_none

if TYPE_CHECKING:
    from ..table import Table

__all__ = ["LARGEST", "bound_lines", "c_header"]

LARGEST = 1_000_000  # [bytes]

Floats = NDArray[np.float64]
_INTEGER = 2.0**31  # below it, a coefficient is written as an int
_ALMOST_ONE = 1.0 - 2.0**-53
_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_LICENCE = "Copyright (c) 2026, the Pendular developers. SPDX-License-Identifier: BSD-3-Clause. Without any warranty."


class _Control(NamedTuple):
    """What differs between tables for one control and for the other."""

    control_star: str
    unit: str
    reduce: str
    liquid: str
    liquid_meaning: str
    liquid_comment: str
    liquid_scale: str


_CONTROLS = {
    "suction": _Control(
        control_star="suction Rm/gamma",
        unit="Pa: gas pressure minus liquid pressure",
        reduce="return suction / surface_tension * mean_radius;",
        liquid="volume",
        liquid_meaning="of the liquid [m3]",
        liquid_comment="Liquid volume [m3]; NaN where there is no bridge.",
        liquid_scale="place.radius * place.radius * place.radius / (place.control * place.control)",
    ),
    "volume": _Control(
        control_star="volume/Rm^3",
        unit="m3",
        reduce="(void)surface_tension;\n    return volume / (mean_radius * mean_radius * mean_radius);",
        liquid="suction",
        liquid_meaning="gas pressure minus liquid pressure [Pa]",
        liquid_comment="Suction [Pa]; NaN where there is no bridge.",
        liquid_scale="surface_tension / (place.radius * sqrt(place.control))",
    ),
}


def c_header(table: "Table", *, prefix: str = "pendular_") -> str:
    """Text of a C header that answers what a table answers, in C99, C++11 and CUDA.

    The numbers of a cell are stored as integers times a power of two, as far as they are: that is short, exact, and
    evaluated in the order of the Python kernels.

    Parameters
    ----------
    table : Table
        As `pendular.tabulate` makes it; a tolerance of 1e-6 is right for most.
    prefix : str
        Begins all names of the header, so that one program may use several.

    Returns
    -------
    str
        Functions ``force``, ``stiffness``, ``rupture_distance``, and ``volume``, or ``suction`` for a table of
        constant volume, each after the prefix.

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
    if table.control == "suction" and holds_none(table.contact_angle):
        first, second = np.rad2deg(table.contact_angle)
        raise ValueError(
            f"contact_angle: {first:.10g} and {second:.10g} deg are not below 180 deg together; "
            "no suction holds a bridge beyond"
        )
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
        "low": _decimal(grid.low),
        "high": _decimal(grid.high),
        "is_ratio_covered": _ratio_condition(grid),
        "side": f"(radius1 > radius2 ? {grid.cells} : 0) + " if grid.sides == 2 else "",
        "size": "(s * s)" if grid.sides == 1 else "s",
        "shift": grid.shift,
        "first": grid.first,
        "count": grid.cells,
        "almost_one": _decimal(_ALMOST_ONE),
        "two_pi": _decimal(2.0 * math.pi),
        "lanes": LANES,
        "rupture_cell": RUPTURE_CELL,
        "rupture_size_terms": RUPTURE_SIZE_TERMS,
        "cell": CELL,
        "control_terms": CONTROL_TERMS,
        "least_size_terms": LEAST_SIZE_TERMS,
    }


def _ratios(grid: Grid) -> str:
    low = f"{1.0 / grid.largest_ratio:.10g}"
    return f"{low} to {1.0 / grid.least_ratio:.10g}" if grid.least_ratio > 0.0 else f"from {low}"


def _ratio_condition(grid: Grid) -> str:
    """Condition on the smaller over the larger radius; a plane has ratio 0."""
    return f"ratio >= {_decimal(grid.least_ratio)} && ratio <= {_decimal(grid.largest_ratio)}"


def _numbers(grid: Grid) -> dict[str, str]:
    """Rows and coefficients, these in units of the largest power of two that divides all of a row."""
    arrays = [grid.rupture.reshape(-1, RUPTURE_CELL), grid.force.reshape(-1, CELL), grid.liquid.reshape(-1, CELL)]
    scaled = [array.copy() for array in arrays]
    rows = []
    for line, cut in zip(grid.lines, grid.cuts, strict=True):
        size_cells = slice(cut[SIZE_CELLS], cut[SIZE_CELLS] + cut[U_COUNT])
        cells = slice(cut[CELLS], cut[CELLS] + cut[U_COUNT] * cut[Q_COUNT])
        units = []
        for part, source, target in zip((size_cells, cells, cells), arrays, scaled, strict=True):
            unit = _unit(source[part])
            target[part] = source[part] / unit
            units.append(unit)
        rows.append(f"{{{','.join([*map(_decimal, [*line, *units]), *map(str, cut)])}}}")
    names = ("rupture_numbers", "force_numbers", "liquid_numbers")
    return {"rows": ",\n".join(rows)} | {
        name: ",\n".join(_lines(array)) for name, array in zip(names, scaled, strict=True)
    }


def _lines(numbers: Floats) -> Iterator[str]:
    for row in numbers.reshape(-1, LANES).tolist():
        yield ",".join(map(_coefficient, row))


def _coefficient(number: float) -> str:
    """Shortest of the texts that C reads as the number."""
    return str(int(number)) if number.is_integer() and abs(number) < _INTEGER else _decimal(number)


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
        f"                 half as much again as the worst of {bound.bridges} exact bridges, sought in all cells",
    ]
