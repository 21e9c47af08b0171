"""A convex solid that is drawn: its depth h(Y) behind the tip is a cubic spline, whose integrals are known."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .rise import Rise

Floats = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)


@dataclass(frozen=True, eq=False)
class Spline:
    """A depth as a cubic spline of the radius, with its first two integrals, and areas up to the knots."""

    knots: Floats
    depth: Any  # piecewise polynomials
    slope: Any
    bend: Any
    integral: Any
    second_integral: Any

    def cap(self, radius: float) -> float:
        """Volume over π between the tip and a circle, ∫y²h' dy = Y²h - 2(Y∫h - ∬h)."""
        moment = radius * float(self.integral(radius)) - float(self.second_integral(radius))
        return radius * radius * float(self.depth(radius)) - 2.0 * moment

    def area(self, radius: float) -> float:
        """Area within a circle, by Gauss's rule between the knots."""
        ends = np.append(self.knots[self.knots < radius], radius)
        half = 0.5 * np.diff(ends)
        y = 0.5 * (ends[1:] + ends[:-1]) + half * _NODES[:, None]
        return float(2.0 * math.pi * np.sum(half * (_WEIGHTS @ (y * np.hypot(1.0, self.slope(y))))))


@dataclass(frozen=True)
class Drawn:
    """A solid of a spline, in a unit of length, with its contact angle."""

    contact_angle: float
    cos_angle: float
    sin_angle: float
    spline: Spline
    unit: float

    def rise(self, radius: float) -> Rise:
        """Return how the surface rises at a distance from its axis."""
        spline, unit = self.spline, self.unit
        at = radius * unit
        steepness, bend = float(spline.slope(at)), float(spline.bend(at)) * at
        square = 1.0 + steepness * steepness
        cosine = 1.0 / math.sqrt(square)
        depth, cap = float(spline.depth(at)) / unit, spline.cap(at) / unit**3
        return Rise(cosine, steepness * cosine, bend / square, depth, radius * steepness, cap)

    def wetted(self, radius: float) -> float:
        """Area within a circle."""
        return self.spline.area(radius * self.unit) / self.unit**2


def drawn_of(spline: Spline, unit: float, contact_angle: float) -> Drawn:
    """A spline in a unit of length, with a contact angle."""
    return Drawn(contact_angle, math.cos(contact_angle), math.sin(contact_angle), spline, unit)
