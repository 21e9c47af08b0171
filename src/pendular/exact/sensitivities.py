r"""How the force of a bridge follows each number of its question: the matrix of the bridge, solved once more.

With z the four numbers of a meridian and E(z; p) = 0 the four equations of the question, a change of a number p moves
the force by

.. math:: \frac{d\lambda}{dp} = -\sum_i w_i \frac{\partial E_i}{\partial p}, \qquad
          \sum_i w_i \nabla E_i = \nabla\lambda ,

one solution w for all p. The rate in a contact angle is that of the wetted area, since the energy falls by
:math:`\cos\theta\, A`: :math:`2\pi\, d\lambda/d\cos\theta = -dA/dD`, which is regular at θ = 0, where
:math:`d\lambda/d\theta` vanishes.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import entry, over_rows
from .algebra import Four, determinant, dot, minors, normal
from .batch import task_of
from .equations import SUCTION, Held, force_rates, held_row, system_at
from .meridian import End
from .morph import held_of
from .solids import Contact, Solid, contact_with
from .state import State

__all__ = ["Rates", "rates_of_force"]

Rows = NDArray[np.float64]

_MIDDLE, _SLOPE, _LENGTH, _CURVATURE = (
    State._fields.index(name) for name in ("middle_radius", "middle_slope", "half_length", "curvature")
)
_CHUNK = 1024
_PAST_EQUATOR = -0.5  # cos δ below which the cap is measured from the far pole


class Rates(NamedTuple):
    """Rates of λ, reduced, in the numbers of a row of questions; in the cosines of the contact angles."""

    separation: float
    held: float  # H, or V
    curvature1: float
    cos_angle1: float
    curvature2: float
    cos_angle2: float


@kernel
def _height_by_curvature(solid: Solid, contact: Contact, end: End) -> float:
    """Rate of the height of a cap in k, for a contact circle that stays."""
    cosine = solid.sin_angle * end.cos_slope + solid.cos_angle * end.sin_slope
    if solid.curvature != 0.0 and cosine < _PAST_EQUATOR:
        return -contact.height / solid.curvature
    return end.radius * end.radius / (1.0 + cosine)


@kernel
def _area_along(contact: Contact, end: End, tangent: Four) -> float:
    """Rate of the wetted area over 2π along a direction."""
    widening, tilting = dot(end.growth, tangent), dot(end.tilt, tangent)
    rising = contact.height_by_radius * widening + contact.height_by_slope * tilting
    return end.radius * end.radius * widening + contact.height * rising


@kernel
def rates_at(z: Four, held: Held) -> Rates:
    """Rates of λ at a bridge."""
    system = system_at(z, held, True, True)
    row = held_row(z, system, held)
    a, b, c, d = system.contact1.rates, system.contact2.rates, system.separation.rates, row.rates
    force = force_rates(z)
    size = determinant(a, b, c, d)
    at_contact1 = determinant(force, b, c, d) / size
    at_contact2 = determinant(a, force, c, d) / size
    at_separation = determinant(a, b, force, d) / size
    at_held = determinant(a, b, c, force) / size
    first, second = system.first, system.second
    contact1 = contact_with(held.first, first.radius, first.cos_slope, first.sin_slope)
    contact2 = contact_with(held.second, second.radius, second.cos_slope, second.sin_slope)
    higher1 = _height_by_curvature(held.first, contact1, first)
    higher2 = _height_by_curvature(held.second, contact2, second)
    swelling1 = swelling2 = 0.0  # of what is held
    if held.control == SUCTION:
        by_value = at_held * math.exp(z.log_length)
    else:
        by_value = at_held / (math.pi * held.value)
        swelling1 = 0.5 * (first.radius * first.radius + contact1.height * contact1.height) * higher1 / held.value
        swelling2 = 0.5 * (second.radius * second.radius + contact2.height * contact2.height) * higher2 / held.value
    tangent = normal(minors(a, b), d)
    opening = dot(c, tangent)
    return Rates(
        at_separation,
        by_value,
        at_separation * higher1 + at_held * swelling1 - at_contact1 * first.radius,
        -_area_along(contact1, first, tangent) / opening,
        at_separation * higher2 + at_held * swelling2 - at_contact2 * second.radius,
        -_area_along(contact2, second, tangent) / opening,
    )


@entry(plain_cost=6e-4)
def rates_range(control: int, questions: Rows, states: Rows, rates: Rows, start: int, stop: int) -> None:
    """Rates of the rows from start to stop; NaN where there is no bridge."""
    for i in range(start, stop):
        middle, length = float(states[i, _MIDDLE]), float(states[i, _LENGTH])
        if not middle > 0.0:
            rates[i, :] = math.nan
            continue
        z = Four(math.log(middle), float(states[i, _SLOPE]), math.log(length), float(states[i, _CURVATURE]) * length)
        for j, rate in enumerate(rates_at(z, held_of(task_of(questions[i], control)))):
            rates[i, j] = rate


def rates_of_force(control: int, questions: Rows, states: Rows) -> Rows:
    """Rates of λ for rows of questions and the states that answer them, as `Rates`."""
    rates = np.empty((len(questions), len(Rates._fields)))
    over_rows(rates_range, len(questions), _CHUNK, control, questions, states, rates)
    return rates
