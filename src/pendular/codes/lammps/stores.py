"""What the bridges that form in a step hold, and the liquid that they take from the particles and give back.

All ranks see all events of a step in the same order and keep the same stores, so that they agree to the last bit.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...ground.compile import kernel
from ...table import kernels
from .forces import Liquid

__all__ = ["EVENT", "HELD", "LARGER", "SEPARATION", "SMALLER", "Supply", "may_form", "settle"]

Floats = NDArray[np.float64]

# Columns of an event: two tags, the separation of a pair that is near enough for a bridge or NaN for one that broke,
# two radii, and what the bridge holds or held.
SMALLER, LARGER, SEPARATION, RADIUS1, RADIUS2, HELD = range(6)
EVENT = 6


class Supply(NamedTuple):
    """What new bridges are made of."""

    control: float
    share: float
    stores: Floats  # liquid on each particle, by tag, or none


@kernel
def _supplied(liquid: Liquid, supply: Supply, event: Floats) -> float:
    """Control of a bridge that would form: NaN for none, inf outside the range of the table."""
    held, stores = supply.control, supply.stores
    radius1, radius2 = event[RADIUS1], event[RADIUS2]
    rupture = kernels.rupture_distance(liquid.grid, held, radius1, radius2, liquid.surface_tension)
    if math.isnan(rupture):
        return math.inf
    if stores.size:
        offered = supply.share * (stores[int(event[SMALLER])] + stores[int(event[LARGER])])
        if offered < held:  # NaN if it is too little for the table
            held = offered
            rupture = kernels.rupture_distance(liquid.grid, held, radius1, radius2, liquid.surface_tension)
    forms = event[SEPARATION] <= liquid.formation_distance and event[SEPARATION] < rupture
    return held if forms else math.nan


@kernel
def may_form(liquid: Liquid, supply: Supply, events: Floats) -> None:
    """Set what each bridge that forms would hold if it were the only one."""
    for event in events:
        event[HELD] = _supplied(liquid, supply, event)


@kernel
def settle(liquid: Liquid, supply: Supply, events: Floats) -> None:
    """Give the liquid of broken bridges back, half to each particle, then take that of new ones, in their order."""
    stores = supply.stores
    for event in events:
        if math.isnan(event[SEPARATION]):
            stores[int(event[SMALLER])] += 0.5 * event[HELD]
            stores[int(event[LARGER])] += 0.5 * event[HELD]
    for event in events:
        if not math.isnan(event[SEPARATION]):
            i, j = int(event[SMALLER]), int(event[LARGER])
            held = event[HELD] = _supplied(liquid, supply, event)
            if math.isfinite(held):
                part = held / (stores[i] + stores[j])
                stores[i] -= part * stores[i]
                stores[j] -= part * stores[j]
