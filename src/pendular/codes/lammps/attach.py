"""The way into a running LAMMPS: what is asked is checked, and its fix is made."""

import io
import zipfile
import zlib
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...ground.check import as_path, in_range, instance, quantity, scalar
from ...ground.files import in_one_line
from ...packing.forces import BridgeState
from ...table import Table
from .checks import check_run, control_of, reach_of
from .coupling import Coupling
from .failures import guard
from .forces import Liquid
from .stores import Supply
from .walls import watch_walls

__all__ = ["couple"]

Floats = NDArray[np.float64]


def couple(
    lmp: Any,
    table: Table,
    control: float,
    surface_tension: float,
    *,
    formation_distance: float = 0.0,
    stores: ArrayLike | None = None,
    share: float = 1.0,
    state: str | PathLike[str] | BridgeState | None = None,
    cutoff: float | None = None,
    fix: str = "pendular",
) -> Coupling:
    r"""Let exact bridges act between the particles of a running LAMMPS.

    .. math:: \mathbf F_i = \sum_j F_{ij}\,\mathbf n_{ij}

    A bridge forms where a separation is at most the formation distance, and stays until the rupture distance, as in
    :func:`pendular.contact_forces`. The input of LAMMPS must say ``newton off`` and have a neighbour list that reaches
    as far as the bridges::

        newton off
        pair_style hybrid/overlay granular zero CUTOFF nocoeff
        pair_coeff * * granular ...
        pair_coeff * * zero

    Parameters
    ----------
    lmp : lammps.lammps
        With ``units si``, spheres with radii, and a box.
    table : Table
        Exact bridges of one contact angle, of :func:`pendular.tabulate`.
    control : float
        Suction in all bridges, [Pa], or the liquid volume that a new bridge takes, [m³], as the table has it.
    surface_tension : float
        [N/m].
    formation_distance : float
        [m].
    stores : array_like, (largest id + 1,), optional
        Liquid on each particle, by its id, [m³]; under volume control only. A new bridge takes a share of the stores of
        its two particles, in proportion to these and no more than ``control``; a bridge that breaks gives half of its
        liquid to each. Where the share is too little for the table there is no bridge.
    share : float
        Of the stores, in (0, 1].
    state : path or BridgeState, optional
        Bridges to begin with, by the ids of their atoms: what ``Coupling.save`` wrote, with the stores, or
        ``Coupling.bridges``. No bridges by default.
    cutoff : float
        How far the neighbour list reaches, between centres, [m]: the number after ``zero``. By default what bridges
        between the largest particles need; to be given if there are no particles yet, or if larger ones or lower
        suctions will come. LAMMPS checks at each run that its list reaches so far.
    fix : str
        Name of the fix ``external`` that is made.

    Returns
    -------
    Coupling
        To read bridges, energy and liquid from, to set another suction, and to save.

    Raises
    ------
    ValueError
        For bad input and for settings of LAMMPS under which the forces would be wrong. Later, the command that runs
        LAMMPS raises it where a pair leaves the range of the table; that run ends, and LAMMPS makes no other.

    Warns
    -----
    UserWarning
        Of each fix of a style ``wall...``, now or when it is made: walls are dry, bridges join grains to grains.

    Notes
    -----
    **Validity.** As the table. There are no bridges to walls, unless these are made of grains. The forces exert no
    torque. Under suction a reservoir supplies the liquid. Energies and virials, total and of each atom, count in
    ``pe``, ``press``, ``compute pe/atom`` and ``compute stress/atom``.
    Under MPI the ranks agree in every step on the bridges that form and break.

    Examples
    --------
    >>> from mpi4py import MPI  # before LAMMPS, so that this finds the library
    >>> from lammps import lammps
    >>> from pendular import tabulate
    >>> table = tabulate(0.35, reduced=(20.0, 40.0), radius_ratio=(1, 1), tolerance=1e-6)
    >>> lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    >>> lmp.commands_string('''
    ... units si
    ... atom_style sphere
    ... newton off
    ... region box block 0 1e-3 0 1e-3 0 1e-3
    ... create_box 1 box
    ... create_atoms 1 single 0.4e-3 0.5e-3 0.5e-3
    ... create_atoms 1 single 0.6e-3 0.5e-3 0.5e-3
    ... set group all diameter 2e-4 density 2500
    ... pair_style hybrid/overlay granular zero 2.1e-4 nocoeff
    ... pair_coeff * * granular hooke 1000 0 tangential linear_nohistory 0 0 damping velocity
    ... pair_coeff * * zero
    ... comm_modify vel yes
    ... neighbor 1e-4 bin
    ... timestep 1e-7
    ... fix move all nve/sphere
    ... ''')
    >>> coupling = couple(lmp, table, 2e4, 0.0728)
    >>> lmp.command("run 10")
    >>> coupling.bridges.pairs.tolist(), f"{coupling.energy:.3e} J"
    ([[1, 2]], '-9.683e-11 J')
    """
    instance("table", table, Table)
    tension = scalar("surface_tension", surface_tension, "N/m")
    in_range("surface_tension", tension, 0.0, brackets="(]", unit="N/m")
    formation = scalar("formation_distance", formation_distance, "m")
    in_range("formation_distance", formation, 0.0, unit="m")
    part = in_range("share", scalar("share", share, ""), 0.0, 1.0, brackets="(]")
    held = control_of(table, control)
    bridges, stored = _read(state)
    if stores is not None:
        stored = np.array(quantity("stores", stores, "m**3"), ndmin=1)
        in_range("stores", stored, 0.0, unit="m**3")
    if table.control == "suction":
        bridges = bridges._replace(control=np.full(len(bridges.pairs), held))
        if stored.size:
            raise ValueError("stores: go with a table of volumes; under suction a reservoir holds the liquid")
    check_run(lmp, table, fix)
    reach = reach_of(table, lmp, held, tension, formation)
    limit = reach if cutoff is None else scalar("cutoff", cutoff, "m")
    if limit == 0.0:
        raise ValueError("cutoff: without atoms it is unknown; give the number after 'zero' in pair_style")
    in_range("cutoff", limit, reach, unit="m")
    coupling = Coupling(
        lmp, table, Liquid(table.grid, tension, formation, limit), Supply(held, part, stored), bridges, fix
    )
    lmp.command(f"fix {fix} all external pf/callback 1 1")
    lmp.command(f"fix_modify {fix} energy yes virial yes")
    lmp.command(f"compute {fix} all coord/atom cutoff {limit!r}")  # refused at a run where the list is shorter
    lmp.set_fix_external_callback(fix, coupling.step, lmp)
    guard(lmp)
    watch_walls(lmp)
    return coupling


def _read(state: str | PathLike[str] | BridgeState | None) -> tuple[BridgeState, Floats]:
    """Bridges and stores that a simulation begins with."""
    stored = np.empty(0)
    if state is None:
        return BridgeState(np.empty((0, 2), np.int64), np.empty(0)), stored
    if isinstance(state, BridgeState):
        pairs, control = np.asarray(state.pairs), np.asarray(state.control, float)
    else:
        place = as_path("state", state)
        with in_one_line("state", place, "read"):
            content = place.read_bytes()
        try:
            with np.load(io.BytesIO(content)) as found:
                pairs, control, stored = found["pairs"], found["control"], found["stores"]
        except (KeyError, ValueError, EOFError, TypeError, zipfile.BadZipFile, zlib.error) as error:
            raise ValueError(f"state: '{place}' is not what a coupling saved, or damaged") from error
    if pairs.shape != (control.size, 2) or pairs.dtype.kind not in "iu":
        raise ValueError(f"state: {control.size} controls and pairs of shape {pairs.shape} are no bridges")
    return BridgeState(pairs.astype(np.int64), control), stored
