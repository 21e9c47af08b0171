"""What laws make of two contact angles; NaN where an angle is outside the hard limits."""

import math

from ..ground.compile import kernel

__all__ = ["mean_angle", "mean_cosine", "one_angle"]


@kernel
def one_angle(contact_angle1: float, contact_angle2: float) -> float:
    """Contact angle of a law that knows only one, NaN where they differ."""
    if 0.0 <= contact_angle1 < 0.5 * math.pi and contact_angle1 == contact_angle2:
        return contact_angle1
    return math.nan


@kernel
def mean_angle(contact_angle1: float, contact_angle2: float) -> float:
    """Mean of two contact angles."""
    if 0.0 <= contact_angle1 < 0.5 * math.pi and 0.0 <= contact_angle2 < 0.5 * math.pi:
        return 0.5 * (contact_angle1 + contact_angle2)
    return math.nan


@kernel
def mean_cosine(contact_angle1: float, contact_angle2: float) -> float:
    """Mean of the cosines of two contact angles, on which small bridges depend."""
    if 0.0 <= contact_angle1 < 0.5 * math.pi and 0.0 <= contact_angle2 < 0.5 * math.pi:
        return 0.5 * (math.cos(contact_angle1) + math.cos(contact_angle2))
    return math.nan
