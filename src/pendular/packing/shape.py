r"""The whole geometry of a bridge from its force and its volume, in closed form.

A table knows force and volume. Everything else follows from equilibrium. The force at a contact circle gives the
half-filling angle,

.. math:: \frac{F}{2\pi\gamma} = \frac H2 R^2\sin^2\delta + R\sin\delta\sin(\delta+\theta)
          = R B \sin\delta\sin(\delta+\psi), \qquad B e^{i\psi} = \tfrac12 HR + e^{i\theta},

and the moments of all forces on liquid and meniscus about the facing poles of the solids give the meniscus:

.. math:: F D\,\mathbf n\otimes\mathbf n = \Delta p V\,\mathbf I
          + \gamma\int(\mathbf I - \mathbf n\otimes\mathbf n)\,\mathrm dA + \mathbf M,

with M the moments of the pull of liquid and meniscus on the two solids.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from ..ground.rows import element, entry

__all__ = ["COLUMNS", "LEAST_SUCTION", "Cap", "cap_of", "moments_of", "plane_cap", "potential_of", "shape_range"]

Floats = NDArray[np.float64]

# Columns of the geometry of a bridge.
AREA, FILLING_1, FILLING_2, WETTED_1, WETTED_2, ACROSS, AXIAL = range(7)
COLUMNS = 7

# ΔpR/γ of the smaller solid. Below 0.386 a grain beside a much larger one may be more than half immersed, where two
# half-filling angles give the same force.
LEAST_SUCTION = 0.5


class Cap(NamedTuple):
    """What a bridge wets of a solid."""

    filling: float  # δ, 0 on a plane
    radius: float  # of the contact circle
    area: float
    axial_moment: float  # of the pull on the solid about its pole, along the axis and across it, over γ
    across_moment: float


@kernel
def cap_at(force: float, curvature: float, radius: float, cosine: float, sine: float) -> Cap:
    """Cap from λ = F/(2πγ), H = Δp/γ, the solid's radius, and cosine and sine of its contact angle."""
    if math.isinf(radius):
        # λ = (H/2) r² + r sin θ
        circle = 2.0 * force / (sine + math.sqrt(sine * sine + 2.0 * curvature * force))
        return plane_cap(math.pi * circle * circle, cosine)
    along = 0.5 * curvature * radius + cosine
    size = math.sqrt(along * along + sine * sine)
    share = force / (radius * size)
    sine_psi, cosine_psi = sine / size, along / size
    root = math.sqrt(max(sine_psi * sine_psi + 4.0 * share * (cosine_psi - share), 0.0))
    rise, run = 2.0 * share, sine_psi + root
    length = math.sqrt(rise * rise + run * run)
    return cap_of(math.atan2(rise, run), run / length, rise / length, curvature, radius, cosine, sine)


@kernel
def caps_at(
    force: float,
    curvature: float,
    radius1: float,
    radius2: float,
    cosines: tuple[float, float],
    sines: tuple[float, float],
) -> tuple[Cap, Cap]:
    """Caps of both solids; those of equal ones are found once."""
    first = cap_at(force, curvature, radius1, cosines[0], sines[0])
    if radius2 == radius1 and cosines[1] == cosines[0]:
        return first, first
    return first, cap_at(force, curvature, radius2, cosines[1], sines[1])


@kernel
def plane_cap(area: float, cosine: float) -> Cap:
    """Disc that a bridge wets of a plane."""
    return Cap(0.0, math.sqrt(area / math.pi), area, 0.0, -area * cosine)


@kernel
def cap_of(
    filling: float,
    cosine_filling: float,
    sine_filling: float,
    curvature: float,
    radius: float,
    cosine: float,
    sine: float,
) -> Cap:
    """Cap of a sphere from its half-filling angle, given with cosine and sine as is its contact angle."""
    square = sine_filling * sine_filling
    height = square / (1.0 + cosine_filling) if cosine_filling > 0.0 else 1.0 - cosine_filling  # over R
    sine_of_sum = sine_filling * cosine + cosine_filling * sine
    cosine_of_sum = cosine_filling * cosine - sine_filling * sine
    # Pressure on the cap, H∫ n ⊗ (x - pole) dA, and the line, ∮ t ⊗ (x - pole) dl.
    unit = math.pi * radius * radius
    pressed = unit * curvature * radius * height * height
    axial = pressed * (2.0 * height / 3.0 - 1.0) - 2.0 * unit * sine_filling * height * sine_of_sum
    across = pressed * (1.0 - height / 3.0) - unit * square * cosine_of_sum
    return Cap(filling, radius * sine_filling, 2.0 * unit * height, axial, across)


@kernel
def moments_of(first: Cap, second: Cap) -> tuple[float, float]:
    """M over γ, along the axis and across it."""
    return first.axial_moment + second.axial_moment, first.across_moment + second.across_moment


@kernel
def meniscus_of(
    gap: float, curvature: float, pull: float, volume: float, first: Cap, second: Cap
) -> tuple[float, float]:
    """Capillary tensor of the meniscus, across the axis and along it, from F/γ and the caps."""
    axial, across = moments_of(first, second)
    liquid = curvature * volume
    n11 = 0.5 * (pull * gap - liquid - axial)
    return n11, -liquid - across - n11


@kernel
def potential_of(
    gap: float,
    suction: float,
    force: float,
    volume: float,
    radius1: float,
    radius2: float,
    cosines: tuple[float, float],
    sines: tuple[float, float],
    tension: float,
) -> float:
    """Grand potential; in an overlap it goes on with the force of contact, so that this is its rate."""
    curvature, pull = suction / tension, force / tension
    first, second = caps_at(0.5 * pull / math.pi, curvature, radius1, radius2, cosines, sines)
    n11, n33 = meniscus_of(max(gap, 0.0), curvature, pull, volume, first, second)
    wetted = cosines[0] * first.area + cosines[1] * second.area
    return tension * (2.0 * n11 + n33 - wetted + curvature * volume + pull * min(gap, 0.0))


@entry(plain_cost=3e-05)
def shape_range(
    pairs: NDArray[np.int32],
    gaps: Floats,
    radii: Floats,
    kind: NDArray[np.int32],
    cosines: Floats,
    sines: Floats,
    suctions: Floats,
    forces: Floats,
    volumes: Floats,
    tension: float,
    out: Floats,
    start: int,
    stop: int,
) -> None:
    """Geometry of the bridges from start to stop."""
    for row in range(start, stop):
        i, j = pairs[row, 0], pairs[row, 1]
        curvature, pull = element(suctions, row) / tension, forces[row] / tension
        first, second = caps_at(
            0.5 * pull / math.pi, curvature, radii[i], radii[j],
            (cosines[kind[i]], cosines[kind[j]]), (sines[kind[i]], sines[kind[j]]),
        )  # fmt: skip
        n11, n33 = meniscus_of(max(gaps[row], 0.0), curvature, pull, volumes[row], first, second)
        out[row, AREA] = 2.0 * n11 + n33
        out[row, FILLING_1], out[row, FILLING_2] = first.filling, second.filling
        out[row, WETTED_1], out[row, WETTED_2] = first.area, second.area
        out[row, ACROSS], out[row, AXIAL] = n11, n33
