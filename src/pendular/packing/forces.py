"""Forces of all bridges in one step of a DEM code: which contacts hold a bridge, and what it does to the particles.

Contacts are worked on in the order of their two particles, whatever the order of the list, and forces are added up in
that order: a result depends neither on the list nor on the number of threads, to the last bit.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..ground.check import in_range, instance, numbers, quantity, scalar, unmasked
from ..ground.compile import compiled, kernel
from ..ground.rows import entry, over_rows
from ..table import Table
from .contacts import distance_of, ends_of
from .finding import CHUNK, Question
from .step import Step, take_step

__all__ = ["BridgeState", "ContactForces", "contact_energy", "contact_forces"]

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


class BridgeState(NamedTuple):
    """Which pairs of particles hold a bridge: all that one step hands to the next.

    It is stored by ``np.savez(path, **state._asdict())`` and read back by ``BridgeState(**np.load(path))``.
    """

    pairs: Integers  # (bridges, 2): indices of the particles, each pair once
    control: Floats  # (bridges,): suction at the last step, [Pa], or volume since the bridge formed, [m³]


class ContactForces(NamedTuple):
    """What :func:`contact_forces` returns."""

    state: BridgeState  # for the next step
    force: Floats  # (particles, 3), [N]
    virial: Floats  # (3, 3), symmetric, [J]
    separation: Floats  # (bridges,): gap of each bridge, in the order of ``state.pairs``, [m]
    attraction: Floats  # (bridges,): its force, positive if the particles are pulled together, [N]


@kernel
def _first_wrong(pairs: Integers, particles: int) -> int:
    """First pair that does not join two of the particles, or -1."""
    for contact in range(pairs.size // 2):
        low, high = ends_of(pairs, contact)
        if low < 0 or high >= particles or low == high:
            return contact
    return -1


@kernel
def _ascends(pairs: Integers) -> bool:
    """Whether the pairs are in order, each there once."""
    ascends = True
    for contact in range(1, pairs.size // 2):
        ascends = ascends and ends_of(pairs, contact - 1) < ends_of(pairs, contact)
    return ascends


@kernel
def _order_of(pairs: Integers, particles: int) -> Integers:
    """Order of the pairs by their smaller, then their larger index: two counting sorts, the lesser key first."""
    order = np.arange(pairs.size // 2)
    for key in (1, 0):
        start = np.zeros(particles + 1, np.int64)
        for contact in order:
            start[ends_of(pairs, int(contact))[key] + 1] += 1
        for particle in range(particles):
            start[particle + 1] += start[particle]
        sorted_order = np.empty_like(order)
        for contact in order:
            end = ends_of(pairs, int(contact))[key]
            sorted_order[start[end]] = contact
            start[end] += 1
        order = sorted_order
    return order


@kernel
def _first_twin(pairs: Integers) -> int:
    """First of the ordered pairs that stands there twice, or -1."""
    for contact in range(1, pairs.size // 2):
        if ends_of(pairs, contact - 1) == ends_of(pairs, contact):
            return contact
    return -1


@kernel
def _not_among(pairs: Integers, listed: Integers) -> Integers:
    """Which of ordered pairs have no equal in another ordered list."""
    missing = np.empty(pairs.size // 2, np.int64)
    other, count = 0, 0
    for pair in range(pairs.size // 2):
        ends = ends_of(pairs, pair)
        while other < listed.size // 2 and ends_of(listed, other) < ends:
            other += 1
        if other == listed.size // 2 or ends_of(listed, other) != ends:
            missing[count] = pair
            count += 1
    return missing[:count]


@entry(plain_cost=2e-6)
def _separation_range(
    pairs: Integers, positions: Floats, radii: Floats, separation: Floats, start: int, stop: int
) -> None:
    """Gaps from start to stop, NaN where two centres coincide and no direction joins them."""
    for contact in range(start, stop):
        first, second = pairs[2 * contact], pairs[2 * contact + 1]
        distance = distance_of(positions, first, second)
        separation[contact] = distance - (radii[first] + radii[second]) if distance > 0.0 else math.nan


def contact_forces(
    table: Table,
    pairs: ArrayLike,
    positions: ArrayLike,
    radii: ArrayLike,
    control: ArrayLike,
    surface_tension: float,
    *,
    state: BridgeState | None = None,
    formation_distance: float = 0.0,
) -> ContactForces:
    r"""Forces of the liquid bridges between spheres, with the hysteresis of their formation and rupture.

    .. math:: \mathbf F_i = \sum_j F_{ij}\,\mathbf n_{ij}, \qquad
              \mathbf W = -\sum_{i<j} F_{ij}\, d_{ij}\,\mathbf n_{ij} \otimes \mathbf n_{ij}

    A bridge forms where a separation is at most the formation distance, and stays until the rupture distance of the
    table.

    Parameters
    ----------
    table : Table
        Exact bridges, of :func:`tabulate`. If its contact angles differ, the first holds for the first of a pair.
    pairs : array_like of int, (contacts, 2)
        Particles that are close, each pair once, in any order. It must hold all pairs that still have a bridge.
    positions : array_like, (particles, 3)
        Centres, [m].
    radii : array_like, (particles,)
        [m].
    control : array_like, scalar or (contacts,)
        Suction in each bridge, [Pa], or the liquid volume, [m³], of those that form now: a bridge under volume control
        keeps its own.
    surface_tension : float
        [N/m].
    state : BridgeState, optional
        Of the step before; no bridge by default.
    formation_distance : float
        [m].

    Returns
    -------
    ContactForces
        Force on every particle, the virial, bridges with their separation and force, and the state for the next step.
        With ``virial`` the stress of a volume V is -virial/V, tension positive.

    Raises
    ------
    ValueError
        For bad input, a bridge outside the range of the table, or one that still stands and is not in the list.

    Notes
    -----
    **Validity.** As the table. Forces act along the line of centres and exert no torque. Liquid of a bridge that
    breaks is not handed to others.

    Examples
    --------
    >>> from pendular import tabulate
    >>> table = tabulate(0.35, reduced=(50.0, 200.0), radius_ratio=(1, 2), tolerance=1e-6)
    >>> pairs, radii = [(0, 1)], [100e-6, 120e-6]
    >>> apart = [(0.0, 0.0, 0.0), (221e-6, 0.0, 0.0)]  # 1 µm between the surfaces
    >>> contact_forces(table, pairs, apart, radii, 1e5, 0.0728).force[0, 0]  # no bridge yet
    np.float64(0.0)
    >>> touching = contact_forces(table, pairs, [(0.0, 0.0, 0.0), (220e-6, 0.0, 0.0)], radii, 1e5, 0.0728)
    >>> pulled = contact_forces(table, pairs, apart, radii, 1e5, 0.0728, state=touching.state)
    >>> print(f"{pulled.force[0, 0]:.3e} {pulled.force[1, 0]:.3e}")
    6.639e-06 -6.639e-06
    """
    instance("table", table, Table)
    centres, sizes = _particles(positions, radii)
    contacts = _listed("pairs", pairs)
    given = _per_contact("control", control, len(contacts), "Pa" if table.control == "suction" else "m**3")
    tension = scalar("surface_tension", surface_tension, "N/m")
    in_range("surface_tension", tension, 0.0, brackets="(]", unit="N/m")
    reach = scalar("formation_distance", formation_distance, "m")
    in_range("formation_distance", reach, 0.0, unit="m")
    before = _listed_state(state)

    asked = Question(
        table.grid, contacts.reshape(-1), before.pairs.reshape(-1), before.control, centres.reshape(-1), sizes, reach,
        given.reshape(-1), tension,
    )  # fmt: skip
    bridges, force, virial = _step(table, asked, given)
    held = BridgeState(bridges.pairs.reshape(-1, 2), bridges.control)
    if not np.isfinite(virial).all():
        _refuse_particles(centres, sizes)
        _attractions(table, held, bridges.separation, sizes, tension)  # refuses a bridge, in words
    return ContactForces(held, force.reshape(-1, 3), virial, bridges.separation, bridges.attraction)


def contact_energy(
    table: Table, state: BridgeState, positions: ArrayLike, radii: ArrayLike, surface_tension: float
) -> float:
    r"""Potential of all bridges at their controls, of which the forces are minus the gradient.

    .. math:: E = -\sum_b \int_{D_b}^{D_c} F\,\mathrm dD

    Parameters
    ----------
    table, positions, radii, surface_tension
        As for :func:`contact_forces`.
    state : BridgeState
        That step's.

    Returns
    -------
    float
        [J], minus the work that breaks all bridges.

    Raises
    ------
    ValueError
        For bad input or a bridge outside the range of the table.

    Examples
    --------
    >>> from pendular import tabulate
    >>> table = tabulate(0.35, reduced=(50.0, 200.0), radius_ratio=(1, 2), tolerance=1e-6)
    >>> state = BridgeState(np.array([(0, 1)]), np.array([1e5]))
    >>> energy = contact_energy(table, state, [(0, 0, 0), (220e-6, 0, 0)], [100e-6, 120e-6], 0.0728)
    >>> print(f"{energy:.3e}")
    -2.675e-11
    """
    instance("table", table, Table)
    centres, sizes = _particles(positions, radii)
    _refuse_particles(centres, sizes)
    bridges = _checked(_listed_state(state), len(sizes))
    if not bridges.control.size:
        return 0.0
    separation = _separations(bridges.pairs, centres, sizes)
    first, second = bridges.pairs.T
    return float(np.sum(table.energy(separation, bridges.control, sizes[first], sizes[second], surface_tension)))


def _attractions(
    table: Table, bridges: BridgeState, separation: Floats, radii: Floats, surface_tension: float
) -> Floats:
    """Force of each bridge, 0.0 for one that breaks."""
    if not separation.size:
        return np.empty(0)
    first, second = bridges.pairs.T
    return table.force(separation, bridges.control, radii.take(first), radii.take(second), surface_tension)


def _separations(pairs: Integers, positions: Floats, radii: Floats) -> Floats:
    separation = np.empty(len(pairs))
    over_rows(_separation_range, len(pairs), CHUNK, pairs.reshape(-1), positions.reshape(-1), radii, separation)
    if np.isnan(np.sum(separation)):
        first, second = pairs[np.flatnonzero(np.isnan(separation))[0]]
        raise ValueError(f"positions: particles {first} and {second} have the same centre")
    return separation


def _step(table: Table, asked: Question, given: Floats) -> Step:
    """Answer a question as it is, or in order."""
    step = take_step(asked)
    if step is None:
        _refuse_particles(asked.positions, asked.radii)
        step = take_step(_in_order(table, asked, given))
    assert step is not None  # all is in order
    return step


def _in_order(table: Table, asked: Question, given: Floats) -> Question:
    """The same question with pairs and bridges in their order, all of them contacts; wrong ones are refused."""
    contacts, order = _ordered("pairs", asked.pairs.reshape(-1, 2), len(asked.radii))
    before = _checked(BridgeState(asked.former_pairs.reshape(-1, 2), asked.former_control), len(asked.radii))
    _separations(contacts, asked.positions, asked.radii)
    missing = compiled(_not_among)(before.pairs.reshape(-1), contacts.reshape(-1))
    if missing.size:
        is_held = table.control == "volume" or given.ndim > 0
        last = before.control[missing] if is_held else np.full(missing.size, given)
        _refuse_standing(table, BridgeState(before.pairs[missing], last), asked.positions, asked.radii, asked.tension)
        before = BridgeState(np.delete(before.pairs, missing, axis=0), np.delete(before.control, missing))
    return asked._replace(
        pairs=contacts.reshape(-1),
        former_pairs=before.pairs.reshape(-1),
        former_control=before.control,
        given=asked.given if given.ndim == 0 else np.ascontiguousarray(given[order]),
    )


def _refuse_standing(
    table: Table, bridges: BridgeState, positions: Floats, radii: Floats, surface_tension: float
) -> None:
    """Refuse a list without pairs whose bridges have not broken."""
    separation = _separations(bridges.pairs, positions, radii)
    standing = np.flatnonzero(_attractions(table, bridges, separation, radii, surface_tension))
    if standing.size:
        pair, gap = tuple(bridges.pairs[standing[0]].tolist()), separation[standing[0]]
        raise ValueError(f"pairs: {pair} is not there, but its bridge still stands at a separation of {gap:.6g} m")


def _particles(positions: ArrayLike, radii: ArrayLike) -> tuple[Floats, Floats]:
    """Centres and radii as arrays that belong together; a look at their numbers is left to the sums over them."""
    sizes, centres = numbers("radii", radii, "m"), numbers("positions", positions, "m")
    if sizes.ndim != 1 or not sizes.size:
        raise ValueError(f"radii: an array of shape {sizes.shape} is not one radius for each particle")
    if centres.shape != (sizes.size, 3):
        raise ValueError(f"positions: an array of shape {centres.shape} is not of shape ({sizes.size}, 3)")
    return np.ascontiguousarray(centres), np.ascontiguousarray(sizes)


def _refuse_particles(positions: Floats, radii: Floats) -> None:
    """Refuse positions and radii that are none."""
    in_range("radii", quantity("radii", radii, "m"), 0.0, brackets="(]", unit="m")
    quantity("positions", positions, "m")


def _listed(name: str, pairs: Any) -> Integers:
    """Pairs as an array."""
    array = np.asarray(unmasked(name, pairs))
    if array.size == 0:
        array = np.empty((0, 2), np.int64)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        given = f"an array of {array.dtype} of shape {array.shape}"
        raise ValueError(f"{name}: {given} is not one of integers of shape (contacts, 2)")
    return np.ascontiguousarray(array, np.int64)


def _ordered(name: str, listed: Integers, particles: int) -> tuple[Integers, Integers | slice]:
    """Pairs in the order of their particles, and where each of them stood."""
    flat = listed.reshape(-1)
    wrong = compiled(_first_wrong)(flat, particles)
    if wrong >= 0:
        pair = tuple(listed[wrong].tolist())
        raise ValueError(f"{name}[{wrong}]: {pair} is not two of the particles 0 to {particles - 1}")
    if compiled(_ascends)(flat):
        return listed, slice(None)
    order = compiled(_order_of)(flat, particles)
    ordered = listed.take(order, axis=0)
    twin = compiled(_first_twin)(ordered.reshape(-1))
    if twin >= 0:
        raise ValueError(f"{name}: {tuple(ordered[twin].tolist())} is there twice")
    return ordered, order


def _per_contact(name: str, value: Any, count: int, unit: str) -> Floats:
    """One number for all contacts, 0-d, or one for each."""
    if count == 0 and np.shape(value) == (0,):
        return np.empty(0)
    array = quantity(name, value, unit)
    if array.shape not in ((), (count,)):
        raise ValueError(f"{name}: an array of shape {array.shape} is not one number nor one for each of {count} pairs")
    return array


def _listed_state(state: BridgeState | None) -> BridgeState:
    """State as arrays."""
    if state is None:
        return BridgeState(np.empty((0, 2), np.int64), np.empty(0))
    instance("state", state, BridgeState)
    pairs = _listed("state.pairs", state.pairs)
    control = _per_contact("state.control", state.control, len(pairs), "")
    return BridgeState(pairs, np.full(len(pairs), control) if control.ndim == 0 else np.ascontiguousarray(control))


def _checked(state: BridgeState, particles: int) -> BridgeState:
    """State with its bridges in the order of their particles."""
    pairs, order = _ordered("state.pairs", state.pairs, particles)
    return BridgeState(pairs, state.control[order])
