"""Newton's method to the bridge at a separation."""

import math

from ..ground.compile import kernel
from .algebra import Four, largest, moved, solve4
from .arc import W8, W16, W24, X8, X16, X24, Nodes
from .equations import VOLUME, Held, System, held_row, system_at
from .meridian import Row

LONGEST_STEP = 1.0
MOST_STEPS, _COARSE_STEPS = 7, 3  # of rows abreast
_MOST_TURN = 9.0  # |ω| beyond which an arc winds about itself
_COARSE_STEP = 1e-4  # from which on the finer nodes are used
NO_STEP = 1e-20  # a guess may be the bridge itself
_LEFT = 1e-16  # largest change that would follow
NEARLY_HELD = 0.3  # share of the volume above which its logarithm is what is corrected


@kernel
def held_target(row: Row, held: Held) -> float:
    """Right side of the held row: V/V0 in logarithm, as it may be far off at first."""
    if held.control == VOLUME and row.value > NEARLY_HELD - 1.0:
        return -(1.0 + row.value) * math.log1p(row.value)
    return -row.value


@kernel
def step_to(separation: float, system: System, rates: Four, target: float) -> Four:
    """Newton's step to the bridge at a separation, by the rates of what is held."""
    step, _det = solve4(
        system.contact1.rates,
        system.contact2.rates,
        system.separation.rates,
        rates,
        -system.contact1.value,
        -system.contact2.value,
        separation - system.separation.value,
        target,
    )
    return step


@kernel
def left_after(size: float, before: float) -> float:
    """What is left after a step: its square, by the factor that made it the square of the one before."""
    shrunk = size / before
    return size * shrunk * shrunk


@kernel
def is_fine_step(step: int, is_near: bool) -> bool:
    """Whether rows abreast, from a guess or from bridges near by, are in need of sums that hold for any arc."""
    return is_near or step >= _COARSE_STEPS


@kernel
def nodes_of_step(step: int, is_near: bool) -> tuple[Nodes, Nodes]:
    """Nodes and weights for rows abreast: the first step is never the last, and takes fewer."""
    if not is_fine_step(step, is_near):
        return X8, W8
    return (X16, W16) if step == 0 else (X24, W24)


@kernel
def newton_to(z: Four, separation: float, held: Held, most: int) -> tuple[Four, bool]:
    """From a guess to the bridge at a separation, and whether it was reached."""
    with_volume, fine, before = held.control == VOLUME, False, math.inf
    for _ in range(most):
        system = system_at(z, held, fine, with_volume)
        row = held_row(z, system, held)
        change = step_to(separation, system, row.rates, held_target(row, held))
        size = largest(change)
        if not size < 1e6:
            break
        z = moved(z, LONGEST_STEP / max(size, LONGEST_STEP), change)
        if not abs(z.turn) < _MOST_TURN:
            break
        if fine and left_after(size, before) < _LEFT:
            return z, True
        fine, before = size < _COARSE_STEP, max(size, NO_STEP)
    return z, False
