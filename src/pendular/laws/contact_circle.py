"""Where a surface (H, λ) meets a sphere or a plane.

A solid is a curvature ``k = 1/R`` (zero for a plane) and a contact angle ``theta``. The coordinate on it is
the wetted arc ``a`` from the axis to the contact line, ``a = Rδ`` on a sphere and the radius on a plane: every
formula below holds for both.
"""

import math
from typing import NamedTuple

from ..ground.compile import kernel


class Contact(NamedTuple):
    """A contact circle, all lengths in the unit of ``1/k``."""

    radius: float  # Y, of the contact circle
    sagitta: float  # h, height of the wetted cap
    cos_filling: float  # cos δ
    sin_slope: float  # sin ψ, ψ = π/2 - δ - θ is the slope of the meridian, outwards
    cos_slope: float  # cos ψ


@kernel
def contact_at(wetted_arc: float, k: float, theta: float) -> Contact:
    """Contact circle at a wetted arc, for a sphere (k > 0) or a plane (k = 0)."""
    filling = k * wetted_arc
    half = 0.5 * filling
    sin_half = math.sin(half)
    sin_ratio = sin_half / half if half > 0.0 else 1.0
    radius = wetted_arc * sin_ratio * math.cos(half)  # sin δ / k
    sagitta = 0.5 * wetted_arc * filling * sin_ratio * sin_ratio  # (1 - cos δ) / k, without cancellation
    return Contact(radius, sagitta, 1.0 - k * sagitta, math.cos(filling + theta), math.sin(filling + theta))


@kernel
def force_rate(contact: Contact, curvature: float, k: float) -> float:
    """∂λ/∂a at fixed H: sin(2δ+θ) + H Y cos δ. It vanishes where the two contact circles of one λ merge."""
    # sin(2δ+θ) = sin δ cos β + cos δ sin β with β = δ + θ
    return k * contact.radius * contact.sin_slope + contact.cos_filling * (
        contact.cos_slope + curvature * contact.radius
    )


@kernel
def wetted_arc_of(force: float, curvature: float, k: float, theta: float) -> float:
    """Wetted arc of the contact circle with the smaller filling angle, for given λ and H.

    Closed form in λ and H, without division by k; NaN where the surface does not meet the solid.
    """
    sin_theta = math.sin(theta)
    discriminant = sin_theta * sin_theta + 4.0 * force * (k * math.cos(theta) + 0.5 * curvature - k * k * force)
    if not (discriminant >= 0.0 and force >= 0.0):
        return math.nan
    root = sin_theta + math.sqrt(discriminant)
    if root == 0.0:  # δ = π/2, the largest force that a sphere holds; or no force at all
        return 0.5 * math.pi / k if k > 0.0 and force > 0.0 else math.nan
    tangent = 2.0 * force / root  # tan δ / k
    return math.atan(k * tangent) / k if k > 0.0 else tangent


@kernel
def cap_volume(contact: Contact) -> float:
    """Volume of the solid's cap inside the contact circle."""
    h = contact.sagitta
    return math.pi * h * (3.0 * contact.radius * contact.radius + h * h) / 6.0


@kernel
def wetted_area(contact: Contact) -> float:
    """Liquid-solid area, π (Y² + h²): a cap on a sphere, a disc on a plane."""
    return math.pi * (contact.radius * contact.radius + contact.sagitta * contact.sagitta)
