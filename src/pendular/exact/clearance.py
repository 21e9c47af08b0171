"""Whether a meniscus stays outside both solids between its two contact circles.

The equations know the solids at the contact circles only. Along the arc the curvature of the meridian is H/2 + λ/Y². A
meridian that runs forward along the axis and is nowhere bent more tightly towards a solid than that solid itself cannot
come back to it, nor one that nowhere is narrower than the contact circle, or as steep as the solid there. Where none is
certain, points are looked at.
"""

import math
from typing import Protocol

from ..ground.compile import kernel
from ..ground.lanes import choose
from .algebra import Four
from .equations import Held, System, curvature_of, force_of
from .meridian import extreme_phases, middle_of, panel_of, panels_of
from .quadrature import Cut, cuts_of, node_at
from .solids import Solid, contact_with, depth_inside, half_filling_angle, half_filling_cosine, half_filling_sine

_MOST_TURN = 6.3  # |ω|: an arc of a whole wave
_FARTHEST = 60.0  # |ln Ym| and |ln ℓ|
_CLOSED_NECK = 1e-6  # over ℓ: a thread that holds nothing
_PIECES = 16  # of a cut, at whose ends the meridian is looked at
_DEEPEST = 1e-7  # over the arc length; contact circles themselves lie at zero
_ROUNDING = 1e-13  # of a sine
_TINY = 1e-300
_GAUSS = ((-math.sqrt(0.6), 5.0 / 9.0), (0.0, 8.0 / 9.0), (math.sqrt(0.6), 5.0 / 9.0))


class Rim(Protocol):
    """A contact circle, and the slope ψ of the meridian there, outwards."""

    @property
    def radius(self) -> float:
        """Y."""

    @property
    def cos_slope(self) -> float:
        """Of ψ."""

    @property
    def sin_slope(self) -> float:
        """Of ψ."""


@kernel
def radius_range(z: Four, system: System) -> tuple[float, float]:
    """Least and largest radius of the arc."""
    necks, bulges = extreme_phases(z)
    middle, curvature = middle_of(z), curvature_of(z)
    ratio = math.hypot(1.0 + curvature * middle.real, curvature * middle.imag)
    return radii_between(system.first, system.second, necks, bulges, force_of(z), curvature, ratio)


@kernel
def radii_between(
    first: Rim, second: Rim, necks: float, bulges: float, force: float, curvature: float, ratio: float
) -> tuple[float, float]:
    """Least and largest radius of an arc with so many necks and bulges; the ratio is |1 + Hζ|."""
    least, most = min(first.radius, second.radius), max(first.radius, second.radius)
    return (
        choose(necks > 0, min(least, 2.0 * abs(force) / (1.0 + ratio)), least),
        choose(bulges > 0, max(most, (1.0 + ratio) / max(abs(curvature), _TINY)), most),
    )


@kernel
def opening_of(z: Four, system: System, held: Held) -> float:
    """The smaller contact circle over ℓ; negative past a far pole, at a closed neck, or for an arc wound up."""
    first, second = system.first, system.second
    filling1 = half_filling_angle(held.first, first.radius, first.cos_slope, first.sin_slope)
    filling2 = half_filling_angle(held.second, second.radius, second.cos_slope, second.sin_slope)
    least = radius_range(z, system)[0] * math.exp(-z.log_length)
    is_regular = (
        least > _CLOSED_NECK
        and abs(z.turn) < _MOST_TURN
        and abs(z.log_radius) < _FARTHEST
        and abs(z.log_length) < _FARTHEST
        and min(filling1, filling2) >= 0.0
        and max(filling1, filling2) < math.pi
    )
    return min(first.radius, second.radius) * math.exp(-z.log_length) if is_regular else -1.0


@kernel
def _is_certain(rim: Rim, solid: Solid, least: float, bend: float, steepest: float) -> bool:
    """Whether a meridian that runs forward stays clear of a solid.

    By its largest bend, by its least radius, or as it nowhere is as steep as the solid at its contact circle, given the
    cosine of its steepest slope: it lies beyond the tangent there.
    """
    cos_filling = half_filling_cosine(solid, rim.cos_slope, rim.sin_slope)
    is_beyond = (rim.radius <= least) | (steepest > solid.curvature * rim.radius)
    return (bend >= -solid.curvature) | ((cos_filling >= 0.0) & is_beyond)


@kernel
def is_clear(z: Four, system: System, held: Held) -> bool:
    """Whether the meniscus enters neither solid."""
    least, most = radius_range(z, system)
    force, curvature = force_of(z), curvature_of(z)
    return is_clearly_outside(system.first, system.second, held, least, most, force, curvature) or _stays_outside(
        z, system, held
    )


@kernel
def is_clearly_outside(
    first: Rim, second: Rim, held: Held, least: float, most: float, force: float, curvature: float
) -> bool:
    """Whether the bounds of its radius and its bend tell that a meniscus enters neither solid."""
    half = 0.5 * curvature
    at_least, at_most = force / least - half * least, force / most - half * most  # cosine of the slope
    inside = (-half * least * least < force) & (force < -half * most * most)  # where the meridian is straight
    steepest = choose(inside, 2.0 * math.sqrt(max(-half * force, 0.0)), min(at_least, at_most))
    bend = half + min(force / (least * least), force / (most * most))
    return (
        (min(at_least, at_most) > 0.0)
        & _is_certain(first, held.first, least, bend, steepest)
        & _is_certain(second, held.second, least, bend, steepest)
    )


@kernel
def extrema_between(first: Rim, second: Rim) -> tuple[float, float]:
    """Numbers of necks and bulges in less than half a turn: there is one, where both ends lean the same way."""
    necks = choose((first.sin_slope > 0.0) & (second.sin_slope > 0.0), 1.0, 0.0)
    return necks, choose((first.sin_slope < 0.0) & (second.sin_slope < 0.0), 1.0, 0.0)


@kernel
def _is_forward(rim: Rim, solid: Solid) -> bool:
    """Whether a contact circle is on the right side of its solid, before a far pole."""
    sine = half_filling_sine(solid, rim.cos_slope, rim.sin_slope)
    cosine = half_filling_cosine(solid, rim.cos_slope, rim.sin_slope)
    return choose(solid.curvature > 0.0, sine, cosine) > -_ROUNDING


@kernel
def is_beyond_doubt(
    first: Rim,
    second: Rim,
    held: Held,
    necks: float,
    bulges: float,
    force: float,
    curvature: float,
    ratio: float,
    half_width: float,
) -> bool:
    """Whether bounds tell that an arc is a bridge that enters neither solid; the ratio is |1 + Hζ|."""
    least, most = radii_between(first, second, necks, bulges, force, curvature, ratio)
    return (
        _is_forward(first, held.first)
        & _is_forward(second, held.second)
        & (least > _CLOSED_NECK * half_width)
        & is_clearly_outside(first, second, held, max(least, _TINY), most, force, curvature)
    )


@kernel
def _stays_outside(z: Four, system: System, held: Held) -> bool:
    """Whether points along the meniscus lie outside both solids, but for the last, on the second contact circle."""
    first, separation = system.first, system.separation.value
    place = -contact_with(held.first, first.radius, first.cos_slope, first.sin_slope).height
    most = _DEEPEST * math.exp(z.log_length)
    panels = panels_of(z.turn)
    for number in range(panels):
        panel = panel_of(z, number, panels)
        tau, half_eta = panel.tau, 0.5 * panel.eta
        real, imag = panel.place.zeta.real / tau, panel.place.zeta.imag / tau
        cut, growth, cuts = cuts_of(real, imag, panel.eta)
        for _ in range(cuts):
            for i in range(_PIECES):
                end = -1.0 + 2.0 * (i + 1.0) / _PIECES
                for shift, weight in _GAUSS:
                    node = node_at(real, imag, half_eta, cut, end - (1.0 - shift) / _PIECES, weight / _PIECES)
                    place += tau * node.ds * node.zeta_real / math.hypot(node.zeta_real, node.zeta_imag)
                node = node_at(real, imag, half_eta, cut, end, 0.0)
                radius = tau * math.hypot(node.zeta_real, node.zeta_imag)
                inside = max(
                    depth_inside(held.first, place, radius), depth_inside(held.second, separation - place, radius)
                )
                if inside > most:
                    return False
            cut = Cut(cut.pole, cut.spread, cut.middle * growth, cut.half)
    return True
