"""What a table is made for."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_RUPTURE_SHARES = {False: 0.003, True: 0.03}  # of the tolerance, under suction and at constant volume, relative
_MOST_RUPTURE = 1e-7  # of 4e-6, up to where before rupture the bound of the force holds
_LEAST_COSINES = 1e-12  # cos θ1 + cos θ2, which is not quite 0 for two right angles


class Task(NamedTuple):
    """What is tabulated."""

    angles: tuple[float, float]
    is_volume: bool
    low: float
    high: float
    low_ratio: float
    high_ratio: float
    tolerance: float
    share: float  # of the tolerance for one coordinate

    @property
    def rupture_tolerance(self) -> float:
        """For one coordinate, relative; small, as a bridge near rupture feels the square root of the error."""
        return min(_RUPTURE_SHARES[self.is_volume] * self.tolerance, _MOST_RUPTURE)

    @property
    def is_dry(self) -> bool:
        """Whether the solids hold no bridge at all: under suction they have to be wetted."""
        return not self.is_volume and holds_none(self.angles)

    @property
    def sides(self) -> int:
        """Two if it matters which of the solids is the smaller."""
        return 1 if self.angles[0] == self.angles[1] else 2

    @property
    def size_power(self) -> float:
        """Power of s = (R1 - R2)/(R1 + R2) that is the size variable u."""
        if self.sides == 2:
            return 1.0
        return 2.0 / 3.0 if self.is_volume else 2.0

    @property
    def sizes(self) -> tuple[float, float]:
        """Range of the size variable u."""
        ratios = np.array([self.low_ratio, self.high_ratio])
        low, high = ((1.0 - 1.0 / ratios) / (1.0 + 1.0 / ratios)) ** self.size_power
        return float(low), float(high)

    def s_of(self, size: Floats) -> Floats:
        """|s| of sizes."""
        return np.asarray(np.maximum(size, 0.0) ** (1.0 / self.size_power))


def refuse_dry(angles: tuple[float, float]) -> None:
    """Refuse to write for others what says of solids of these contact angles that no suction holds a bridge."""
    if holds_none(angles):
        first, second = (math.degrees(angle) for angle in angles)
        raise ValueError(
            f"contact_angle: {first:.10g} and {second:.10g} deg are not below 180 deg together; "
            "no suction holds a bridge beyond"
        )


def holds_none(angles: tuple[float, float]) -> bool:
    """Whether no suction holds a bridge between solids of these contact angles."""
    return math.cos(angles[0]) + math.cos(angles[1]) <= _LEAST_COSINES
