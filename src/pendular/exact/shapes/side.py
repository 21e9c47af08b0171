r"""The equations of a bridge whose line lies on the side of a cylinder.

At a volume its height h behind the end follows from what is held, :math:`R^2 h = V_{rot} - V_{cap} - V`, and Y = R
takes the place of the volume among the equations. As the limit of a steep cone, the ladder has -ln Y in the place of
the separation, and the volume at a separation that is held. Under suction the meridian is the same at all heights.
"""

from ..algebra import Four
from ..equations import SUCTION, Held, System
from ..meridian import Row
from ..solids.edge import Side


class Sided(System):
    """All equations of a bridge on a side, those of its ladder, and the height of its line."""

    ladder: System
    height: float


def _mixed(a: float, x: Four, b: float, y: Four) -> Four:
    return Four(a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2], a * x[3] + b * y[3])


def has_side(held: Held) -> bool:
    """Whether one of two surfaces is the side of a cylinder."""
    return isinstance(held.first, Side) or isinstance(held.second, Side)


def on_side(system: System, held: Held) -> Sided:
    """The equations of a bridge, from those in which the volume behind the end of the cylinder is counted as liquid."""
    is_first = isinstance(held.first, Side)
    side: Side = held.first if is_first else held.second  # type: ignore[assignment]
    end = system.first if is_first else system.second
    square, volume, gap = side.radius**2, system.volume, system.separation
    reach = gap.value + side.height
    height = side.height if held.control == SUCTION else (volume.value - held.value) / square
    share = end.radius / side.radius
    shrinking = Row(0.0, _mixed(-1.0, end.growth, 0.0, end.growth))
    sided = Sided(
        system.contact1,
        system.contact2,
        Row(reach - height, _mixed(1.0, gap.rates, -1.0 / square, volume.rates)),
        Row(volume.value - square * height, volume.rates)
        if held.control == SUCTION
        else Row(held.value * share, _mixed(held.value * share, end.growth, 0.0, end.growth)),
        system.first_gap,
        system.length,
        system.first,
        system.second,
    )
    sided.height = height
    sided.ladder = system._replace(
        separation=shrinking,
        first_gap=shrinking if is_first else system.first_gap,
        volume=Row(0.0, _mixed(1.0, volume.rates, -square, gap.rates)),
    )
    return sided
