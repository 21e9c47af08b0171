"""The domain of questions: what the solver was tried on, and what has a meaning for grains."""

import math

from ..exact.equations import SUCTION, VOLUME
from ..ground.compile import kernel

DEEPEST_OVERLAP = 0.5  # over the smaller radius
NARROWEST = 1e-5  # gap between two planes over the cube root of the volume
LEAST_VOLUME, MOST_VOLUME = 1e-30, 1e4  # over R̄³
MOST_SUCTION = 1e13  # or pressure, over γ/R̄


@kernel
def is_in_domain(control: int, separation: float, held: float, radius1: float, radius2: float, tension: float) -> bool:
    """Whether a question about the stable bridge of two solids is one: a NaN is none."""
    small = min(radius1, radius2)
    if not abs(separation) < math.inf or not abs(held) < math.inf:
        return False
    if small == math.inf:
        return control == VOLUME and held > 0.0 and separation >= NARROWEST * held ** (1.0 / 3.0)
    mean = 2.0 * small / (small / radius1 + small / radius2)
    is_near = separation > -DEEPEST_OVERLAP * small
    if control == VOLUME:
        cube = mean * mean * mean
        return is_near and LEAST_VOLUME * cube <= held <= MOST_VOLUME * cube
    return is_near and control == SUCTION and abs(held) * mean <= MOST_SUCTION * tension


@kernel
def length_unit(control: int, held: float, radius1: float, radius2: float) -> float:
    """Unit of length of a question: the smaller radius; between two planes the cube root of the volume."""
    small = min(radius1, radius2)
    return small if small < math.inf or control == SUCTION else held ** (1.0 / 3.0)


@kernel
def length_between(control: int, held: float, tension: float, size: float, separation: float) -> float:
    """The same between solids of any shape, the smaller of which has a size, or NaN.

    Of a volume it is the cube root, of a pressure the radius of curvature, else what there is.
    """
    if control == VOLUME:
        return math.pow(held, 1.0 / 3.0)
    if held != 0.0:
        return tension / abs(held)
    if size > 0.0:
        return size
    return separation if separation > 0.0 else 1.0


@kernel
def reduced(control: int, held: float, unit: float, tension: float) -> float:
    """What is held, in a unit of length: V/π, or H."""
    return held / (unit * unit * unit) / math.pi if control == VOLUME else held * unit / tension
