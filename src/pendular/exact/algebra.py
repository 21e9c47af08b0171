"""Linear algebra of four unknowns, without arrays: vectors are named by the unknowns of a meridian."""

import math
from typing import NamedTuple

from ..ground.compile import kernel


class Four(NamedTuple):
    """A meridian, a step between two of them, or the rates of a quantity with respect to its four numbers."""

    log_radius: float  # ln Ym, radius in the middle of the arc
    slope: float  # φm, slope angle there
    log_length: float  # ln ℓ, half the length of the arc
    turn: float  # ω = Hℓ


class Minors(NamedTuple):
    """The six 2×2 minors of two rows, by their columns."""

    m01: float
    m02: float
    m03: float
    m12: float
    m13: float
    m23: float


@kernel
def dot(a: Four, b: Four) -> float:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]


@kernel
def largest_of(a: Four) -> float:
    """Largest magnitude of the components; what is NaN may count for nothing."""
    return max(max(abs(a[0]), abs(a[1])), max(abs(a[2]), abs(a[3])))


@kernel
def largest(a: Four) -> float:
    """Largest magnitude of the components; NaN if one of them is."""
    return largest_of(a) if a[0] + a[1] + a[2] + a[3] == a[0] + a[1] + a[2] + a[3] else math.nan


@kernel
def distance(a: Four, b: Four) -> float:
    """Largest difference of the components."""
    return largest(Four(a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]))


@kernel
def moved(start: Four, step: float, direction: Four) -> Four:
    """Return start + step·direction."""
    return Four(
        start[0] + step * direction[0],
        start[1] + step * direction[1],
        start[2] + step * direction[2],
        start[3] + step * direction[3],
    )


@kernel
def ratio(a: float, b: float) -> float:
    """a/b, infinite where b vanishes."""
    if b != 0.0:
        return a / b
    return math.copysign(math.inf, a) * math.copysign(1.0, b) if a != 0.0 else math.nan


@kernel
def scaled(factor: float, a: Four) -> Four:
    """Return factor·a."""
    return Four(factor * a[0], factor * a[1], factor * a[2], factor * a[3])


@kernel
def unit_vector(a: Four) -> Four:
    """Return a over its length."""
    return scaled(1.0 / math.sqrt(dot(a, a)), a)


@kernel
def minors(a: Four, b: Four) -> Minors:
    """Minors of the rows a and b."""
    return Minors(
        a[0] * b[1] - a[1] * b[0],
        a[0] * b[2] - a[2] * b[0],
        a[0] * b[3] - a[3] * b[0],
        a[1] * b[2] - a[2] * b[1],
        a[1] * b[3] - a[3] * b[1],
        a[2] * b[3] - a[3] * b[2],
    )


@kernel
def joined(s: Minors, c: Minors) -> float:
    """Determinant of four rows from the minors of the first two and of the last two (Laplace)."""
    return s.m01 * c.m23 - s.m02 * c.m13 + s.m03 * c.m12 + s.m12 * c.m03 - s.m13 * c.m02 + s.m23 * c.m01


@kernel
def normal(s: Minors, c: Four) -> Four:
    """The vector n with n·x = det(a, b, c, x) for every x, from the minors of a and b."""
    return Four(
        -s.m12 * c[3] + s.m13 * c[2] - s.m23 * c[1],
        s.m02 * c[3] - s.m03 * c[2] + s.m23 * c[0],
        -s.m01 * c[3] + s.m03 * c[1] - s.m13 * c[0],
        s.m01 * c[2] - s.m02 * c[1] + s.m12 * c[0],
    )


@kernel
def determinant(a: Four, b: Four, c: Four, d: Four) -> float:
    """Determinant of four rows."""
    return joined(minors(a, b), minors(c, d))


@kernel
def solve4(
    a: Four, b: Four, c: Four, d: Four, at_a: float, at_b: float, at_c: float, at_d: float
) -> tuple[Four, float]:
    """The x with a·x = at_a, b·x = at_b, c·x = at_c, d·x = at_d (Cramer), and the determinant."""
    upper, lower = minors(a, b), minors(c, d)
    size = joined(upper, lower)
    by_a, by_b, by_c, by_d = normal(lower, b), normal(lower, a), normal(upper, d), normal(upper, c)
    x = Four(
        (-at_a * by_a[0] + at_b * by_b[0] - at_c * by_c[0] + at_d * by_d[0]) / size,
        (-at_a * by_a[1] + at_b * by_b[1] - at_c * by_c[1] + at_d * by_d[1]) / size,
        (-at_a * by_a[2] + at_b * by_b[2] - at_c * by_c[2] + at_d * by_d[2]) / size,
        (-at_a * by_a[3] + at_b * by_b[3] - at_c * by_c[3] + at_d * by_d[3]) / size,
    )
    return x, size
