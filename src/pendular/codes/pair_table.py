"""Force and energy of one pair of grains over their distance, in the format of LAMMPS' ``pair_style table``."""

from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import __version__
from ..ask.face import Bridge, Pair, bridge, rupture
from ..ask.liquid import Liquid
from ..ground.check import in_range, instance, quantity, whole_number

__all__ = ["PairTable", "pair_table", "pair_table_text"]

Floats = NDArray[np.float64]

_ASCII = str.maketrans({"µ": "u", "°": "deg", "·": "-"})  # LAMMPS warns of other characters


class PairTable(NamedTuple):
    """Rows from the deepest overlap to rupture, at equal steps of r²."""

    distance: Floats  # r, centre to centre, [m]
    energy: Floats  # 0 at rupture, [J]
    force: Floats  # attraction, [N]
    contact_distance: float  # R1 + R2, [m]
    error: float  # of the force between the rows, largest, over the force at contact


def pair_table(
    pair: Pair,
    *,
    liquid: Liquid,
    suction: float | None = None,
    volume: float | None = None,
    humidity: float | None = None,
    overlap: float | None = None,
    points: int = 1000,
) -> PairTable:
    """Exact force and energy of two spheres, as a code reads them that knows only the distance of their centres.

    The energy is minus the work that breaks the bridge: the grand potential under suction, the surface energy at
    constant volume, less its value at rupture.

    Parameters
    ----------
    pair : Pair
        Two spheres.
    liquid : Liquid
        As for `pendular.bridge`, with one of the three controls.
    suction, volume, humidity : float, optional
        What is held constant, [Pa], [m³] or [-].
    overlap : float, optional
        Depth at which the table begins, [m], less than half the smaller radius; a tenth of that radius by default.
    points : int
        Rows, at least 10.

    Returns
    -------
    PairTable

    Raises
    ------
    ValueError
        For bad input, a plane, or a pair that no bridge holds together from the deepest overlap to rupture.

    Examples
    --------
    >>> grains = Pair(radius=50e-6, contact_angle=0.35)
    >>> table = pair_table(grains, suction=20e3, liquid=Liquid(surface_tension=0.0728))
    >>> f"{table.distance[-1] - table.contact_distance:.3e} m, error {table.error:.1e}"
    '3.314e-06 m, error 4.2e-03'
    """
    instance("pair", pair, Pair)
    radii = np.broadcast_to(np.asarray(pair.radius, float), 2)
    if np.isinf(radii).any():
        raise ValueError("radius: a plane has no centre, and a table of pairs needs the distance of two centres")
    smallest = float(radii.min())
    depth = 0.1 * smallest if overlap is None else float(quantity("overlap", overlap, "m"))
    in_range("overlap", depth, 0.0, 0.5 * smallest, brackets="[)", unit="m")
    count = whole_number("points", points, 10)
    at = partial(bridge, pair, suction=suction, volume=volume, humidity=humidity, liquid=liquid)
    end = rupture(pair, suction=suction, volume=volume, humidity=humidity, liquid=liquid)
    if not end.exists:
        raise ValueError("contact-angle: no bridge holds these grains apart, so there is no table")
    contact = float(radii.sum())
    first, last = contact - depth, contact + float(end.separation)
    distance = np.sqrt(np.linspace(first * first, last * last, count))
    between = np.sqrt(0.5 * (distance[:-1] ** 2 + distance[1:] ** 2))
    rows, middles, touching = at(distance[:-1] - contact), at(between - contact), at(0.0)
    for gaps, found in ((distance[:-1], rows), (between, middles)):
        missing = gaps[~found.exists] - contact
        if missing.size:
            raise ValueError(
                f"pair: no bridge holds these grains at a separation of {missing[0]:.6g} m, nearer than rupture"
            )
    force = np.append(rows.force, end.force)
    is_volume = volume is not None
    energy = np.append(_potential(rows, is_volume) - _potential(end, is_volume), 0.0)
    error = np.abs(0.5 * (force[:-1] + force[1:]) - middles.force).max() / abs(touching.force)
    return PairTable(distance, energy, force, contact, float(error))


def _potential(state: Bridge, is_volume: bool) -> float | Floats:
    return state.surface_energy if is_volume else state.grand_potential


def pair_table_text(table: PairTable, keyword: str, *notes: str) -> str:
    """Table as LAMMPS reads it: index, distance, energy, and force, which is negative where it attracts.

    With ``pair_style table linear N`` for the N rows, and the last distance for the cutoff, LAMMPS takes the rows as
    they are, without interpolation to rows of its own.

    Examples
    --------
    >>> rows = PairTable(np.array([1.0, 2.0]), np.array([-1.0, 0.0]), np.array([1.0, 0.5]), 1.0, 0.0)
    >>> print(pair_table_text(rows, "BRIDGE", "two unit spheres"), end="")  # doctest: +ELLIPSIS
    # UNITS: si ...
    # two unit spheres
    # r [m], energy [J], force [N], which is negative: attraction
    <BLANKLINE>
    BRIDGE
    N 2 RSQ 1.0 2.0
    <BLANKLINE>
    1 1.0 -1.0 -1.0
    2 2.0 0.0 -0.5
    """
    low, high = (float(distance) for distance in table.distance[[0, -1]])
    head = [
        f"# UNITS: si  written by Pendular {__version__}",
        *(f"# {note.translate(_ASCII)}" for note in notes),
        "# r [m], energy [J], force [N], which is negative: attraction",
        "",
        keyword,
        f"N {table.distance.size} RSQ {low!r} {high!r}",
        "",
    ]
    columns = (table.distance.tolist(), table.energy.tolist(), (-table.force).tolist())
    rows = [f"{i} {r!r} {energy!r} {force!r}" for i, (r, energy, force) in enumerate(zip(*columns, strict=True), 1)]
    return "\n".join([*head, *rows]) + "\n"
