r"""The equations of a bridge whose line lies on the side of a cylinder.

At a volume its height h behind the end follows from what is held, :math:`R^2 h = V_{rot} - V_{cap} - V`, and Y = R
takes the place of the volume among the equations. As the limit of a steep cone, the ladder has -ln Y in the place of
the separation, and the volume at a separation that is held. Under suction the meridian is the same at all heights.
"""

from typing import NamedTuple

from ...ground.compile import kernel
from ..algebra import Four, scaled
from ..equations import SUCTION, Held, System
from ..meridian import End, Row
from ..solids.surface import SIDE, Surface


class AnySystem(NamedTuple):
    """All equations at one meridian, as :class:`System`, and whether a line lies on a side.

    There the volume has the rates of ln Y, and the first gap what stands for it in the ladder.
    """

    contact1: Row
    contact2: Row
    separation: Row
    volume: Row
    first_gap: Row
    length: Row
    first: End
    second: End
    is_on_side: bool


@kernel
def has_side(held: Held) -> bool:
    """Whether one of two surfaces is the side of a cylinder."""
    return held.first.kind == SIDE or held.second.kind == SIDE  # type: ignore[attr-defined]


@kernel
def off_side(system: System) -> AnySystem:
    """The equations of a bridge no line of which lies on a side."""
    return AnySystem(
        system.contact1,
        system.contact2,
        system.separation,
        system.volume,
        system.first_gap,
        system.length,
        system.first,
        system.second,
        False,
    )


@kernel
def height_of(system: System, held: Held, side: Surface) -> float:
    """Height of a line on a side, from the equations in which the volume behind the end is counted as liquid."""
    return side.height if held.control == SUCTION else (system.volume.value - held.value) / (side.size * side.size)


@kernel
def on_side(system: System, held: Held) -> AnySystem:
    """The equations of a bridge, from those in which the volume behind the end of the cylinder is counted as liquid."""
    is_first = held.first.kind == SIDE  # type: ignore[attr-defined]
    side: Surface = held.first if is_first else held.second  # type: ignore[assignment]
    end = system.first if is_first else system.second
    square, gap, volume = side.size * side.size, system.separation, system.volume
    height = height_of(system, held, side)
    share = end.radius / side.size
    less, more = volume.rates, gap.rates
    rates = Four(
        more[0] - less[0] / square, more[1] - less[1] / square, more[2] - less[2] / square, more[3] - less[3] / square
    )
    is_known = held.control == SUCTION
    liquid, weight = (volume.value - square * height, share) if is_known else (held.value * share, held.value * share)
    return AnySystem(
        system.contact1,
        system.contact2,
        Row(gap.value + side.height - height, rates),
        Row(liquid, scaled(weight, end.growth)),
        Row(0.0, scaled(-1.0, end.growth)) if is_first else system.first_gap,
        system.length,
        system.first,
        system.second,
        True,
    )


@kernel
def for_ladder(system: AnySystem) -> System:
    """What the ladder asks: on a side other equations, of which the signs of the rates matter alone."""
    is_on_side = system.is_on_side
    separation = Row(0.0, scaled(-1.0, system.volume.rates)) if is_on_side else system.separation
    volume = Row(0.0, scaled(-1.0, system.separation.rates)) if is_on_side else system.volume
    return System(
        system.contact1,
        system.contact2,
        separation,
        volume,
        system.first_gap,
        system.length,
        system.first,
        system.second,
    )
