r"""Stability without integration: the ladder of equations.

The number of axisymmetric directions in which the energy of a bridge falls follows from the signs of four determinants
of the rates of its equations. Each rung frees what the one before holds: both contact circles and the suction held,
then one circle free, then both, then the volume held in the place of the suction. With Y1, Y2 the contact radii, X the
length, h1 the height of the first cap, c1, c2 the contact equations, D, V, H separation, volume and curvature:

.. math:: & d_0 = \det(\ln Y_1, \ln Y_2, X, H), \quad d_1 = \det(c_1, \ln Y_2, X - h_1, H), \\
          & d_2 = \det(c_1, c_2, D, H), \quad d_3 = \det(c_1, c_2, D, V)

and with k extrema of the radius strictly inside the arc, n_D = k if d0 has the sign of (-1)^k, else k - 1, there are

.. math:: n_s = n_D + [d_0 d_1 < 0] + [d_1 d_2 < 0], \qquad n_v = n_s - [d_2 d_3 > 0]

unstable directions at fixed suction and at fixed volume. Sideways (the mode that shifts the liquid to one side) a
bridge is unstable exactly where it pushes the solids apart.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel
from ..ground.lanes import choose
from .algebra import Four, determinant
from .equations import System
from .meridian import extreme_phases


class Ladder(NamedTuple):
    """Unstable axisymmetric directions."""

    at_suction: int
    at_volume: int


class _Three(NamedTuple):
    """Rates at a suction that is held: of the length at a turn that grows with it."""

    by_radius: float
    by_slope: float
    by_length: float


@kernel
def _at_suction(rates: Four, turn: float) -> _Three:
    return _Three(rates[0], rates[1], rates[2] + turn * rates[3])


@kernel
def _determinant(a: _Three, b: _Three, c: _Three) -> float:
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])


@kernel
def directions_at_suction(extrema: float, held_rings: float, one_free: float, both_free: float) -> float:
    """n_s, from the extrema of the radius and the determinants d0, d1 and d2."""
    parity = 1.0 - 2.0 * (extrema - 2.0 * math.floor(0.5 * extrema))
    count = extrema - choose(held_rings * parity > 0.0, 0.0, 1.0)
    return count + _differ(held_rings, one_free) + _differ(one_free, both_free)


@kernel
def _differ(one: float, other: float) -> float:
    """1 where one of two numbers is above zero and the other is not."""
    return abs(choose(one > 0.0, 1.0, 0.0) - choose(other > 0.0, 1.0, 0.0))


@kernel
def directions_of(system: System, turn: float, extrema: float, with_volume: bool) -> tuple[float, float]:
    """Unstable directions at fixed suction and at fixed volume, as numbers; those of `ladder_of`."""
    c1, c2 = _at_suction(system.contact1.rates, turn), _at_suction(system.contact2.rates, turn)
    ring1, ring2 = _at_suction(system.first.growth, turn), _at_suction(system.second.growth, turn)
    held_rings = _determinant(ring1, ring2, _at_suction(system.length.rates, turn))
    one_free = _determinant(c1, ring2, _at_suction(system.first_gap.rates, turn))
    both_free = _determinant(c1, c2, _at_suction(system.separation.rates, turn))
    at_suction = directions_at_suction(extrema, held_rings, one_free, both_free)
    if not with_volume:
        return at_suction, at_suction
    volume_held = determinant(
        system.contact1.rates, system.contact2.rates, system.separation.rates, system.volume.rates
    )
    return at_suction, at_suction - 1.0 + _differ(both_free, volume_held)


@kernel
def ladder_of(system: System, turn: float, extrema: int, with_volume: bool) -> Ladder:
    """Unstable directions of a bridge whose meridian has so many extrema of its radius; ``turn`` is the fourth number.

    Without the volume in its system, ``at_volume`` means nothing.
    """
    at_suction, at_volume = directions_of(system, turn, float(extrema), with_volume)
    return Ladder(int(at_suction), int(at_volume))


@kernel
def ladder_at(z: Four, system: System) -> Ladder:
    """Unstable directions of a bridge; without the volume in its system, ``at_volume`` means nothing."""
    necks, bulges = extreme_phases(z)
    return ladder_of(system, z.turn, necks + bulges, True)
