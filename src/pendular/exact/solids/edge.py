"""The edge of the flat end of a cylinder, and its side.

On the edge a contact line is pinned: Y/R - 1 takes the place of the contact angle. On the side the slope is a right
angle, cos δ = 0, and Y = R as well; how far behind the end the line lies, the meridian does not tell.
"""

from ...ground.compile import kernel
from .sphere import Contact
from .surface import Surface


@kernel
def contact_with_edge(edge: Surface, radius: float) -> Contact:
    """What a contact circle of radius Y amounts to: it lies on the edge where Y/R - 1 = 0."""
    share = radius / edge.size
    return Contact(share - 1.0, share, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def contact_with_side(side: Surface, cosine: float, sine: float) -> Contact:
    """What a contact circle amounts to, whose meridian asks for the slope with a cosine and a sine."""
    return Contact(cosine, 0.0, sine, side.height, 0.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def leaves_freely(cos_slope: float, sin_slope: float) -> bool:
    """Whether a meridian of the outward slope ψ leaves the edge of a flat cylinder away from it: -π < ψ < π/2."""
    return cos_slope > 0.0 or sin_slope < 0.0
