r"""The meridian of a bridge in its algebraic numbers, without a sine: what is asked most is answered in them.

With :math:`v = (2/H)\tan(Hs/2)` in the place of the arc length, over its half width τ, the arc of
:mod:`~pendular.exact.meridian` is one panel, and its four numbers are :math:`(\ln a, m, \ln\tau, \eta)`: radius times
cosine and tangent of the slope in the middle, :math:`\zeta_m = a(1 + im)`, and η = Hτ. Rates of quantities are rates in
these four. Sums over the panel are Gauss's, with as many nodes as the nearest of their singular points asks for: the
branch points of Y, where a neck is thin, and the ends of a circle, v = ±2i/η.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import constants, kernel, summing_kernel
from ..ground.lanes import choose
from .algebra import Four
from .crowd import sum_crowded
from .equations import SUCTION, Held, System, system_of
from .meridian import End, Row, tensor_of
from .quadrature import Cut, node_at, point_at

Nodes = NDArray[np.float64]

X8, W8 = map(constants, np.polynomial.legendre.leggauss(8))
X16, W16 = map(constants, np.polynomial.legendre.leggauss(16))
X24, W24 = map(constants, np.polynomial.legendre.leggauss(24))
X32, W32 = map(constants, np.polynomial.legendre.leggauss(32))
X48, W48 = map(constants, np.polynomial.legendre.leggauss(48))
X64, W64 = map(constants, np.polynomial.legendre.leggauss(64))
X96, W96 = map(constants, np.polynomial.legendre.leggauss(96))
# Distance of the nearest singular point from the panel, over its half width, from which on so many nodes leave an
# error of rounding, e = ρ^-2n with ρ = t + √(1 + t²); or one that a Newton step far from its end does not see.
_FINE_8, _FINE_16, _FINE_24, _FINE_32, _FINE_48, _FINE_64, LEAST_ROOM = 6.1, 1.61, 1.0, 0.665, 0.435, 0.325, 0.213
_THINNEST = 0.01  # of such a distance, where nodes that crowd do
_COARSE_8, _COARSE_16, _COARSE_24 = 0.85, 0.42, 0.26
WIDEST_ETA, _MOST_ETA = 2.6, 3.9  # of half an arc from its neck, and of any on its nodes
_WIDEST_CUT = 1.5  # half width of a cut in t, where a neck is thin
ROOM_FOR_24 = 0.85  # from which on so many nodes leave one in the values, if not in the last rates
HALF_A_TURN = 1.99  # η below which an arc makes less than half a turn
_SMALL = 1e-4  # ω below which tan(ω/2)/(ω/2) is a series


class Arc(NamedTuple):
    """A meridian."""

    radius: float  # a, cos φ times the radius in the middle
    slope: float  # m, tan φ there
    half_width: float  # τ
    eta: float  # Hτ


class Half(NamedTuple):
    """Length X, volume V/π and area A/2π of half an arc in units of τ."""

    length: float
    volume: float
    area: float


NOWHERE = Arc(0.0, 0.0, 0.0, 0.0)


class Sums(NamedTuple):
    """Length X, volume V/π and orientation of an arc in units of τ, with rates in Re ζm, Im ζm and η."""

    length: float
    length_by_real: float
    length_by_imag: float
    length_by_eta: float
    volume: float
    volume_by_real: float
    volume_by_imag: float
    volume_by_eta: float
    across: float  # ∫Y cos²φ ds
    axial: float  # ∫Y sin²φ ds


@kernel
def room_of(arc: Arc) -> float:
    """Distance of the singular points from the panel, over its half width, or less."""
    real, h = arc.radius / arc.half_width, 0.5 * arc.eta
    imag = real * arc.slope
    c_real, c_imag = 1.0 + h * real, h * imag
    branch = abs(real * c_real + imag * c_imag) / (c_real * c_real + c_imag * c_imag)
    return min(branch, 1.0 / max(abs(h), 1e-300))


@kernel
def is_fit(arc: Arc) -> bool:
    """Whether the sums over an arc are exact to rounding."""
    return arc.radius > 0.0 and abs(arc.eta) < _MOST_ETA and room_of(arc) > _THINNEST


@kernel
def has_room(arc: Arc, least: float) -> bool:
    """Whether an arc, which makes less than half a turn, has a room that its nodes ask for."""
    return (arc.radius > 0.0) & (abs(arc.eta) < HALF_A_TURN) & (room_of(arc) > least)


@kernel
def chosen(condition: bool, arc: Arc, other: Arc) -> Arc:
    """The first arc where a condition holds, else the other."""
    return Arc(
        choose(condition, arc.radius, other.radius),
        choose(condition, arc.slope, other.slope),
        choose(condition, arc.half_width, other.half_width),
        choose(condition, arc.eta, other.eta),
    )


@kernel
def _nodes_for(room: float, fine: bool) -> tuple[Nodes, Nodes]:
    if room > (_FINE_8 if fine else _COARSE_8):
        return X8, W8
    if room > (_FINE_16 if fine else _COARSE_16):
        return X16, W16
    if room > (_FINE_24 if fine else _COARSE_24):
        return X24, W24
    if room > _FINE_32 or not fine:
        return X32, W32
    if room > _FINE_48:
        return X48, W48
    if room > _FINE_64:
        return X64, W64
    return X96, W96


@summing_kernel
def _sum_length(real: float, imag: float, h: float, x: Nodes, weight: Nodes) -> Sums:
    """Length and its rates."""
    nothing = 0.0 * h  # in lanes, if that is in lanes
    length = by_real = by_imag = by_eta = nothing
    for j in range(len(x)):
        zr, zi, ds, v, w, p = point_at(real, imag, h, x[j], weight[j])
        square = 1.0 / (zr * zr + zi * zi)
        share = ds * math.sqrt(square)
        cosine, sine = share * zr, share * zi * square
        er, ei = (1.0 - w * w) * p, 2.0 * w * p
        fr, fi = er * zr + ei * zi, ei * zr - er * zi
        length += cosine
        by_real -= sine * fi
        by_imag -= sine * fr
        by_eta -= v * p * (cosine * w + 0.5 * sine * (2.0 * real * fr - (2.0 * imag + v) * fi))
    return Sums(length, by_real, by_imag, by_eta, nothing, nothing, nothing, nothing, nothing, nothing)


@summing_kernel
def _sum_all(real: float, imag: float, h: float, x: Nodes, weight: Nodes) -> Sums:
    """All of them."""
    nothing = 0.0 * h  # in lanes, if that is in lanes
    length = by_real = by_imag = by_eta = nothing
    volume = v_real = v_imag = v_eta = nothing
    across = axial = nothing
    for j in range(len(x)):
        zr, zi, ds, v, w, p = point_at(real, imag, h, x[j], weight[j])
        square = zr * zr + zi * zi
        inverse = 1.0 / square
        share = ds * math.sqrt(inverse)
        cosine, sine = share * zr, share * zi
        er, ei = (1.0 - w * w) * p, 2.0 * w * p
        fr, fi = (er * zr + ei * zi) * inverse, (ei * zr - er * zi) * inverse
        grown = -0.5 * v * p * ((2.0 * imag + v) * fr + 2.0 * real * fi)
        turned = 0.5 * v * p * (2.0 * real * fr - (2.0 * imag + v) * fi)
        lag = w * v * p
        disc, tilt = cosine * square, sine * square
        length += cosine
        by_real -= sine * fi
        by_imag -= sine * fr
        by_eta -= cosine * lag + sine * turned
        volume += disc
        v_real += 2.0 * disc * fr - tilt * fi
        v_imag -= 2.0 * disc * fi + tilt * fr
        v_eta += disc * (2.0 * grown - lag) - tilt * turned
        across += cosine * zr
        axial += sine * zi
    return Sums(length, by_real, by_imag, by_eta, volume, v_real, v_imag, v_eta, across, axial)


@summing_kernel
def _sum_half(neck: float, h: float, x: Nodes, weight: Nodes) -> Half:
    """Sums over the half of the nodes on one side of the neck, a root and a division for each."""
    length = volume = area = 0.0
    run = 1.0 + h * neck
    bent = h * run
    for j in range(len(x) // 2):
        square = x[j] * x[j]
        turned = 1.0 + h * h * square
        size = neck * neck + run * run * square
        root = math.sqrt(turned * size)
        inverse = 1.0 / (turned * root)
        over = root * inverse  # 1/(1 + w²)
        share = weight[j] * (neck - bent * square) * inverse
        length += share
        volume += share * size * over
        area += weight[j] * root * over * over
    return Half(length, volume, area)


@summing_kernel
def _sum_cut(neck: float, h: float, cut: Cut, x: Nodes, weight: Nodes) -> Half:
    """The same over a cut of a half whose neck is thin."""
    length = volume = area = 0.0
    for j in range(len(x)):
        zr, zi, ds, _v, _w, _p = node_at(neck, 0.0, h, cut, x[j], weight[j])
        square = zr * zr + zi * zi
        root = math.sqrt(square)
        share = ds * zr / root
        length += share
        volume += share * square
        area += ds * root
    return Half(length, volume, area)


@kernel
def half_from_neck(arc: Arc) -> Half:
    """Length, volume and area of half an arc whose middle is its neck, in units of τ; |η| is below the widest.

    Where the neck is thin, a variable t with v = b sinh t keeps away from the singular points ±ib.
    """
    neck, h, room = arc.radius / arc.half_width, 0.5 * arc.eta, room_of(arc)
    if room > LEAST_ROOM:
        x, weight = _nodes_for(room, True)
        return _sum_half(neck, h, x, weight)
    spread = neck / abs(1.0 + h * neck)
    end = math.log((1.0 + math.sqrt(1.0 + spread * spread)) / spread)
    cuts = 1 + int(0.5 * end / _WIDEST_CUT)
    half = 0.5 * end / cuts
    cut, growth = Cut(0.0, spread, math.exp(half), half), math.exp(2.0 * half)
    length = volume = area = 0.0
    for _ in range(cuts):
        part = _sum_cut(neck, h, cut, X24, W24)
        length, volume, area = length + part.length, volume + part.volume, area + part.area
        cut = Cut(cut.pole, cut.spread, cut.middle * growth, cut.half)
    return Half(length, volume, area)


@kernel
def sums_of(arc: Arc, room: float, fine: bool, with_all: bool) -> Sums:
    """Sums over the panel, whose singular points are as far away as `room_of` tells."""
    if room > LEAST_ROOM:
        x, weight = _nodes_for(room, fine)
        return sums_at(arc, x, weight, with_all)
    sums = crowded_at(arc, X48, W48, with_all)
    if not with_all:
        return sums
    across, axial = tensor_of(meridian_of(arc))
    area = math.pi * arc.half_width * arc.half_width
    return _with_orientation(sums, across / area, 0.5 * axial / area)


@kernel
def sums_at(arc: Arc, x: Nodes, weight: Nodes, with_all: bool) -> Sums:
    """Sums over so many nodes of the panel."""
    real, h = arc.radius / arc.half_width, 0.5 * arc.eta
    if with_all:
        return _sum_all(real, real * arc.slope, h, x, weight)
    return _sum_length(real, real * arc.slope, h, x, weight)


@kernel
def crowded_at(arc: Arc, x: Nodes, weight: Nodes, with_volume: bool) -> Sums:
    """Sums over so many nodes that crowd where the panel is thin, without its orientation."""
    real = arc.radius / arc.half_width
    s = sum_crowded(real, real * arc.slope, arc.eta, x, weight, with_volume)
    nothing = 0.0 * real  # in lanes, if that is in lanes
    return Sums(s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], nothing, nothing)


@kernel
def _with_orientation(s: Sums, across: float, axial: float) -> Sums:
    return Sums(s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7], across, axial)


@kernel
def _end_of(arc: Arc, side: float) -> End:
    """End of the arc on the first (side -1) or the second solid (+1)."""
    real, h = arc.radius / arc.half_width, 0.5 * arc.eta
    imag = real * arc.slope
    zr, zi, p, _v, w, _p = point_at(real, imag, h, side, 1.0)
    square = zr * zr + zi * zi
    inverse = 1.0 / square
    radius = math.sqrt(square)
    cosine = radius * inverse
    er, ei = (1.0 - w * w) * p, 2.0 * w * p
    fr, fi = (er * zr + ei * zi) * inverse, (ei * zr - er * zi) * inverse
    half, across = 0.5 * side * p, 2.0 * imag + side
    grown, turned = real * fr - imag * fi, real * fi + imag * fr
    return End(
        arc.half_width * radius,
        zr * cosine,
        side * zi * cosine,
        Four(grown, -real * fi, 1.0 - grown, -half * (across * fr + 2.0 * real * fi)),
        Four(side * turned, side * real * fr, -side * turned, side * half * (2.0 * real * fr - across * fi)),
    )


@kernel
def system_on(arc: Arc, held: Held, sums: Sums, with_volume: bool) -> System:
    """All equations at an arc, from its sums; without the volume its row holds nothing."""
    tau, real = arc.half_width, arc.radius / arc.half_width
    imag = real * arc.slope
    by_radius = sums.length_by_real * real + sums.length_by_imag * imag
    length = Row(
        tau * sums.length,
        Four(
            tau * by_radius,
            tau * sums.length_by_imag * real,
            tau * (sums.length - by_radius),
            tau * sums.length_by_eta,
        ),
    )
    cube = tau * tau * tau
    by_radius = sums.volume_by_real * real + sums.volume_by_imag * imag
    liquid = Row(
        cube * sums.volume,
        Four(
            cube * by_radius,
            cube * sums.volume_by_imag * real,
            cube * (3.0 * sums.volume - by_radius),
            cube * sums.volume_by_eta,
        ),
    )
    return system_of(length, liquid, _end_of(arc, -1.0), _end_of(arc, 1.0), held, with_volume)


@kernel
def force_on(arc: Arc) -> float:
    """λ = a + (H/2) a² (1 + m²), the first integral of the Young-Laplace equation."""
    half = 0.5 * arc.eta / arc.half_width
    return arc.radius * (1.0 + half * arc.radius * (1.0 + arc.slope * arc.slope))


@kernel
def ratio_of(arc: Arc) -> float:
    """|1 + Hζ|."""
    turned = arc.eta / arc.half_width * arc.radius
    real, imag = 1.0 + turned, turned * arc.slope
    return math.sqrt(real * real + imag * imag)


@kernel
def force_rates_on(arc: Arc) -> Four:
    """Rates of λ."""
    square = arc.radius * arc.radius
    bent = 0.5 * arc.eta / arc.half_width * square * (1.0 + arc.slope * arc.slope)
    return Four(
        arc.radius + 2.0 * bent,
        arc.eta / arc.half_width * square * arc.slope,
        -bent,
        0.5 * square * (1.0 + arc.slope * arc.slope) / arc.half_width,
    )


@kernel
def arc_after(arc: Arc, change: Four, step: float) -> Arc:
    """The arc after a share of a change of its four numbers, of 1 or less; logarithms to the second order of it."""
    by_radius, by_width = 0.5 * step * change.log_radius, 0.5 * step * change.log_length
    return Arc(
        arc.radius * ((1.0 + by_radius) / (1.0 - by_radius)),
        arc.slope + step * change.slope,
        arc.half_width * ((1.0 + by_width) / (1.0 - by_width)),
        arc.eta + step * change.turn,
    )


@kernel
def kept(arc: Arc, held: Held) -> Arc:
    """The arc with the suction that is held."""
    if held.control == SUCTION:
        return Arc(arc.radius, arc.slope, arc.half_width, held.value * arc.half_width)
    return arc


@kernel
def arc_through(radius: float, slope: float, half_length: float, curvature: float) -> Arc:
    """The arc with a radius and a slope angle in its middle, half a length, and a curvature H."""
    half = 0.5 * curvature * half_length
    tangent = math.tan(half)
    stretch = tangent / half if abs(half) > _SMALL else 1.0 + half * half / 3.0
    return Arc(radius * math.cos(slope), math.tan(slope), half_length * stretch, 2.0 * tangent)


@kernel
def half_length_of(arc: Arc) -> float:
    """ℓ, half the arc length."""
    h = 0.5 * arc.eta
    return arc.half_width * (math.atan(h) / h if abs(h) > _SMALL else 1.0 - h * h / 3.0)


@kernel
def meridian_of(arc: Arc) -> Four:
    """The numbers of `meridian`."""
    return Four(
        math.log(arc.radius) + 0.5 * math.log1p(arc.slope * arc.slope),
        math.atan(arc.slope),
        math.log(half_length_of(arc)),
        2.0 * math.atan(0.5 * arc.eta),
    )
