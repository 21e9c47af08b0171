"""Random bridges between two planes, made from the Young–Laplace equation as those of ``made_bridges``.

The unit of length is the contact circle on the first plane, γ = 1. The shift of a bridge along the planes changes
nothing, so its mode m = 1 is neutral, and none is counted.
"""

import math
from typing import NamedTuple

import numpy as np

from .made_bridges import _STEEPEST, Arc, _mirrored_end, count_down, force_of, integrate


class Between(NamedTuple):
    """A bridge between two planes, with the number of axisymmetric directions in which its energy falls."""

    angles: tuple[float, float]
    suction: float  # H
    separation: float
    volume: float
    force: float
    down_at_suction: int
    down_at_volume: int


def draw(rng):
    """One random bridge with any contact angles, or None."""
    angles = np.where(rng.random(2) < 0.1, 0.0, rng.uniform(0.0, math.pi, 2))
    equal = rng.random() < 0.25
    suction = rng.choice((-1.0, 1.0)) * 10.0 ** rng.uniform(-2.0, 1.5) if rng.random() < 0.9 else 0.0
    share = rng.uniform(0.001, 1.0)
    slope = angles[0] - math.pi / 2.0
    if angles[0] > 0.0 and abs(slope) > _STEEPEST:
        return None
    meridian = integrate(1.0, 0.0, slope, suction, 8.0 + 4.0 / (abs(suction) + 0.5))
    end = _mirrored_end(meridian) if equal else share * meridian.t[-1]
    if end is None:
        return None
    _, separation, last_slope, volume = meridian.sol(end)
    second = angles[0] if equal else math.pi / 2.0 - last_slope
    between = meridian.sol(np.linspace(0.0, end, 80))
    is_wetted = equal and angles[0] == 0.0  # where the last slope is a right angle
    if (
        separation <= 0.0
        or (abs(last_slope) > _STEEPEST and not is_wetted)
        or np.any(np.abs(between[2]) > math.pi / 2.0 + 1e-9)
        or between[0].min() < 1e-3
    ):
        return None
    both = (float(angles[0]), float(second))
    arc = Arc(1.0, slope, suction, end, both, (math.inf, math.inf))
    at_suction, takes_one = count_down(arc, 0)
    force = force_of(1.0, slope, suction)
    numbers = map(float, (suction, separation, volume, force))
    return Between(both, *numbers, at_suction, at_suction - takes_one)


def made_between_planes(seed, count):
    """So many random bridges between two planes."""
    rng = np.random.default_rng(seed)
    while count:
        bridge = draw(rng)
        if bridge is not None:
            count -= 1
            yield bridge
