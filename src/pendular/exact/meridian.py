r"""The meridian of a bridge: an arc of constant mean curvature, given by four numbers about its middle.

With s the arc length from the middle, Y the radius, φ the slope angle against the axis and
:math:`\zeta = Y e^{i\varphi}`, the Young–Laplace equation has the solution (Kenmotsu's form)

.. math:: 1 + H\zeta(s) = (1 + H\zeta_m)\,e^{iHs}, \qquad \zeta(s) = \zeta_m e^{i\omega f} + \ell f\,
          \frac{e^{i\omega f} - 1}{\omega f}, \quad f = s/\ell, \; \omega = H\ell .

The four numbers are :math:`(\ln Y_m, \varphi_m, \ln\ell, \omega)`; nothing in them is singular at a catenoid, a
cylinder, a sphere, a neck, a bulge or an inflection. In the algebraic parameter :math:`v = (2/H)\tan(Hs/2)`, over its
half width τ, the arc is a Möbius map, :math:`\zeta(v) = (\zeta_m(1 + iw) + iv)/(1 - iw)` with :math:`w = \eta v/2`, η
= Hτ and
:math:`ds = dv/(1 + w^2)`: length, volume and all their rates come from one loop of products and one square root a node.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel
from .algebra import Four
from .quadrature import NODES_16, WEIGHTS_16, sum_panel, tensor_of_panel

Nodes = NDArray[np.float64]

_WIDEST_PANEL = 1.3  # half turn ω of a panel: wider arcs are cut, where tan(ω/2) would stretch them
_STRAIGHT = 1e-9  # half turn below which an arc is a catenoid
_SMALL_TURN = 0.1  # below which the slope of sin(x)/x is a series


class Turn(NamedTuple):
    """What the turn of an arc from its middle amounts to: e^{iu/2}, sin(u/2)/(u/2) and the slope of that."""

    rotor: complex
    ratio: float
    ratio_slope: float


class Place(NamedTuple):
    """A point of the arc, ζ = Y e^{iφ}, with its rates; that in φm is i times that in ln Ym."""

    zeta: complex
    by_log_radius: complex
    by_log_length: complex
    by_turn: complex


class Row(NamedTuple):
    """A quantity and its rates in the four numbers."""

    value: float
    rates: Four


class End(NamedTuple):
    """An end of the arc: contact circle, and slope ψ of the meridian against the axis, outwards."""

    radius: float  # Y
    cos_slope: float
    sin_slope: float
    growth: Four  # rates of ln Y
    tilt: Four  # rates of ψ


@kernel
def turn_of(angle: float) -> Turn:
    """The turn by an angle u."""
    half = 0.5 * angle
    cosine, sine = math.cos(half), math.sin(half)
    square = half * half
    if square < _SMALL_TURN * _SMALL_TURN:
        ratio = 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0))
        slope = -half / 3.0 * (1.0 - square / 10.0 * (1.0 - square / 28.0 * (1.0 - square / 54.0)))
    else:
        ratio = sine / half
        slope = (cosine - ratio) / half
    return Turn(complex(cosine, sine), ratio, slope)


@kernel
def place_after(middle: complex, length: float, share: float, turn: Turn) -> Place:
    """The point at a share f of the half length, where the arc has made the turn ωf."""
    rotor, ratio, slope = turn
    rotated = middle * rotor * rotor
    run = length * share
    step = 1j * rotor * ratio  # (e^{iu} - 1)/u
    rate = 0.5 * rotor * complex(-ratio, slope)  # its slope
    return Place(rotated + run * step, rotated, run * step, share * (1j * rotated + run * rate))


@kernel
def _end_at(place: Place, side: float) -> End:
    """End of the arc on the first (side -1) or the second solid (+1)."""
    zeta = place.zeta
    square = zeta.real * zeta.real + zeta.imag * zeta.imag
    radius = math.sqrt(square)
    inverse = complex(zeta.real / square, -zeta.imag / square)
    by_radius = place.by_log_radius * inverse
    by_length = place.by_log_length * inverse
    by_turn = place.by_turn * inverse
    return End(
        radius,
        zeta.real / radius,
        side * zeta.imag / radius,
        Four(by_radius.real, -by_radius.imag, by_length.real, by_turn.real),
        Four(side * by_radius.imag, side * by_radius.real, side * by_length.imag, side * by_turn.imag),
    )


@kernel
def middle_of(z: Four) -> complex:
    """Radius and slope in the middle, ζm = Ym e^{iφm}."""
    radius = math.exp(z.log_radius)
    return complex(radius * math.cos(z.slope), radius * math.sin(z.slope))


@kernel
def ends_of(z: Four) -> tuple[End, End]:
    """Both ends of the arc."""
    middle, length = middle_of(z), math.exp(z.log_length)
    forth = turn_of(z.turn)
    back = Turn(complex(forth.rotor.real, -forth.rotor.imag), forth.ratio, -forth.ratio_slope)
    return _end_at(place_after(middle, length, -1.0, back), -1.0), _end_at(place_after(middle, length, 1.0, forth), 1.0)


@kernel
def _plus(row: Row, value: float, rates: Four) -> Row:
    old = row.rates
    return Row(row.value + value, Four(old[0] + rates[0], old[1] + rates[1], old[2] + rates[2], old[3] + rates[3]))


@kernel
def panels_of(turn: float) -> int:
    """Number of panels of an arc."""
    return 1 + int(abs(turn) / _WIDEST_PANEL)


class Panel(NamedTuple):
    """One of the equal panels of an arc, in the algebraic parameter."""

    place: Place  # of its middle
    tau: float
    eta: float
    tau_rate: float  # in ω
    eta_rate: float


@kernel
def panel_of(z: Four, number: int, panels: int) -> Panel:
    """The panel with a number: τ = ℓ tan(h)/h and η = 2 tan h, with ℓ over the panels and h half the turn of one."""
    middle, length = middle_of(z), math.exp(z.log_length)
    turn = turn_of(z.turn / panels)
    tangent = turn.rotor.imag / turn.rotor.real
    tau = length / panels * turn.ratio / turn.rotor.real
    if panels == 1:
        place = Place(middle, middle, 0j, 0j)
    else:
        share = (2.0 * number + 1.0 - panels) / panels
        place = place_after(middle, length, share, turn_of(z.turn * share))
    return Panel(
        place,
        tau,
        2.0 * tangent,
        (tangent + turn.ratio_slope / turn.ratio) * tau * 0.5 / panels,
        (1.0 + tangent * tangent) / panels,
    )


@kernel
def measure_arc(z: Four, fine: bool, with_volume: bool) -> tuple[Row, Row]:
    """Length X = ∫cos φ ds between the contact circles, and V/π = ∫Y² cos φ ds (zero without volume), with rates."""
    nothing = Four(0.0, 0.0, 0.0, 0.0)
    along, liquid = Row(0.0, nothing), Row(0.0, nothing)
    panels = panels_of(z.turn)
    for number in range(panels):
        panel = panel_of(z, number, panels)
        tau, square = panel.tau, panel.tau * panel.tau
        real, imag = panel.place.zeta.real / tau, panel.place.zeta.imag / tau
        s = sum_panel(real, imag, panel.eta, fine, with_volume)
        by_tau = s.length - s.length_by_real * real - s.length_by_imag * imag
        rates = _chain(panel, s.length_by_real, s.length_by_imag, by_tau, tau * s.length_by_eta)
        along = _plus(along, tau * s.length, rates)
        if with_volume:
            by_tau = square * (3.0 * s.volume - s.volume_by_real * real - s.volume_by_imag * imag)
            by_real, by_imag = square * s.volume_by_real, square * s.volume_by_imag
            rates = _chain(panel, by_real, by_imag, by_tau, square * tau * s.volume_by_eta)
            liquid = _plus(liquid, square * tau * s.volume, rates)
    return along, liquid


@kernel
def _chain(panel: Panel, by_real: float, by_imag: float, by_tau: float, by_eta: float) -> Four:
    """Rates in the four numbers from those in the ζ, τ and η of a panel."""
    a, b, c = panel.place.by_log_radius, panel.place.by_log_length, panel.place.by_turn
    return Four(
        by_real * a.real + by_imag * a.imag,
        -by_real * a.imag + by_imag * a.real,
        by_real * b.real + by_imag * b.imag + by_tau * panel.tau,
        by_real * c.real + by_imag * c.imag + by_tau * panel.tau_rate + by_eta * panel.eta_rate,
    )


@kernel
def tensor_of(z: Four) -> tuple[float, float]:
    """Orientation of the meniscus: n11 = π∫Y cos²φ ds and n33 = 2π∫Y sin²φ ds; its area is 2 n11 + n33."""
    across = axial = 0.0
    panels = panels_of(z.turn)
    for number in range(panels):
        panel = panel_of(z, number, panels)
        tau = panel.tau
        real, imag = panel.place.zeta.real / tau, panel.place.zeta.imag / tau
        more_across, more_axial = tensor_of_panel(real, imag, panel.eta)
        across += tau * tau * more_across
        axial += tau * tau * more_axial
    return math.pi * across, 2.0 * math.pi * axial


@kernel
def extreme_phases(z: Four) -> tuple[int, int]:
    """Numbers of necks and of bulges strictly inside the arc.

    The phase arg(1 + Hζ) is a multiple of 2π at a neck and an odd one of π at a bulge.
    """
    middle, length = middle_of(z), math.exp(z.log_length)
    if abs(z.turn) < _STRAIGHT:  # a catenoid
        return (1 if abs(middle.imag) < length else 0), 0
    curvature = z.turn / length
    phase = math.atan2(curvature * middle.imag, 1.0 + curvature * middle.real)
    return _multiples(phase, abs(z.turn)), _multiples(phase - math.pi, abs(z.turn))


@kernel
def _multiples(phase: float, reach: float) -> int:
    """How many multiples of 2π lie strictly within a reach of a phase."""
    low, high = (phase - reach) / (2.0 * math.pi), (phase + reach) / (2.0 * math.pi)
    return int(math.ceil(high) - 1.0 - math.floor(low))


@kernel
def lay_meridian(z: Four, place: Nodes, radius: Nodes) -> None:
    """Place on the axis from the first end, and radius, at points evenly spaced along the arc."""
    middle, length = middle_of(z), math.exp(z.log_length)
    last = place.size - 1
    place[0] = 0.0
    for i in range(last + 1):
        share = 2.0 * i / last - 1.0
        radius[i] = abs(place_after(middle, length, share, turn_of(z.turn * share)).zeta)
        if i == last:
            break
        advance = 0.0
        for j in range(len(NODES_16)):
            between = share + (1.0 + NODES_16[j]) / last
            zeta = place_after(middle, length, between, turn_of(z.turn * between)).zeta
            advance += WEIGHTS_16[j] * zeta.real / abs(zeta)
        place[i + 1] = place[i] + length * advance / last
