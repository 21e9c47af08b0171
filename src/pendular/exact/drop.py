r"""The bridge without a force: a spherical drop that two solids dip into.

A sphere of radius a meets a solid of curvature k at the contact angle θ in a circle of the half-filling angle δ, with

.. math:: c = \sqrt{1 - 2ak\cos\theta + (ak)^2}, \qquad \cos\delta = (1 - ak\cos\theta)/c, \quad
          \sin\delta = ak\sin\theta/c, \quad Y = a\sin\theta/c .

Of a large volume it is the bridge that is always known, between the separation at which the drop swallows a solid and
rupture; and of a pressure in the liquid, where its radius is -2/H.
"""

import math

from ..ground.compile import kernel
from .algebra import Four
from .equations import SUCTION, Held
from .meridian import ends_of
from .solids import Solid, contact_with

_MOST_DOUBLINGS, _MOST_HALVINGS = 60, 60
_LAST_DIGITS = 1e-15
_SHORTEST = 1e-3  # half turn of the arc below which its solids leave no room for it
_NOWHERE = Four(0.0, 0.0, 0.0, 0.0)


@kernel
def _slope_at(solid: Solid, radius: float) -> float:
    """Slope of the drop towards its middle where it meets a solid, θ + δ - π/2."""
    turned = radius * solid.curvature
    filling = math.atan2(turned * solid.sin_angle, 1.0 - turned * solid.cos_angle)
    return solid.contact_angle + filling - 0.5 * math.pi


@kernel
def _drop_of(held: Held, radius: float) -> Four:
    """Meridian of the drop of a radius: H = -2/a, Y = a cos φ; where it is no arc, ω ≥ 0."""
    slope1, slope2 = _slope_at(held.first, radius), _slope_at(held.second, radius)
    middle, half_turn = 0.5 * (slope1 - slope2), 0.5 * (slope1 + slope2)
    if not half_turn > _SHORTEST:
        return _NOWHERE
    return Four(math.log(radius * math.cos(middle)), middle, math.log(radius * half_turn), -2.0 * half_turn)


@kernel
def _volume_of(held: Held, radius: float, z: Four) -> float:
    """V/π of a drop: that between its contact circles less both caps."""
    first, second = ends_of(z)
    contact1 = contact_with(held.first, first.radius, first.cos_slope, first.sin_slope)
    contact2 = contact_with(held.second, second.radius, second.cos_slope, second.sin_slope)
    half_turn = -0.5 * z.turn
    sine1, sine2 = math.sin(z.slope + half_turn), math.sin(z.slope - half_turn)
    between = (sine1 - sine2) - (sine1**3 - sine2**3) / 3.0
    return radius**3 * between - contact1.cap - contact2.cap


@kernel
def drop_between(held: Held) -> tuple[Four, bool]:
    """The spherical drop that holds a volume or a pressure between two solids, and whether there is one."""
    if held.control == SUCTION:
        z = _drop_of(held, -2.0 / held.value) if held.value < 0.0 else _NOWHERE
        return z, z.turn < 0.0
    low, high = 0.0, held.value ** (1.0 / 3.0)
    for _ in range(_MOST_DOUBLINGS):
        z = _drop_of(held, high)
        if z.turn < 0.0 and _volume_of(held, high, z) > held.value:
            break
        low, high = high, 2.0 * high
    else:
        return _NOWHERE, False
    for _ in range(_MOST_HALVINGS):
        radius = 0.5 * (low + high)
        z = _drop_of(held, radius)
        if z.turn < 0.0 and _volume_of(held, radius, z) > held.value:
            high = radius
        else:
            low = radius
        if high - low < _LAST_DIGITS * high:
            break
    z = _drop_of(held, high)
    return z, z.turn < 0.0
