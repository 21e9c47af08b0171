r"""Integrals over a panel of a meridian, with their rates, by Gauss's rule.

In the algebraic parameter v, over the half width τ of the panel, the arc is a Möbius map,
:math:`\zeta(v) = (\zeta_m(1 + iw) + iv)/(1 - iw)` with :math:`w = \eta v/2` and :math:`ds = dv/(1 + w^2)`: length,
volume and all their rates come from one loop of products and one square root a node. The branch points of Y, where a
neck is thin, are smoothed by a further variable, v = pole + spread·sinh t, in which a panel is cut where it is wide.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import constants, kernel, summing_kernel
from ..ground.lanes import choose

Nodes = NDArray[np.float64]

_WIDEST_CUT = 2.0  # half width in the sinh variable: thin necks are cut
_ONE_CUT = math.exp(2.0 * _WIDEST_CUT)
_FARTHEST_POLE = 2.5  # over the half width of the panel; beyond that the substitution would do nothing

NODES_16, WEIGHTS_16 = map(constants, np.polynomial.legendre.leggauss(16))
_NODES_24, _WEIGHTS_24 = map(constants, np.polynomial.legendre.leggauss(24))


class Cut(NamedTuple):
    """A piece of a panel in the variable t, v = pole + spread·sinh t."""

    pole: float
    spread: float
    middle: float  # e^t in its middle
    half: float  # half its width in t


class Node(NamedTuple):
    """A point of an arc with its share of the arc length, in units of τ."""

    zeta_real: float
    zeta_imag: float
    ds: float
    v: float
    w: float  # ηv/2
    p: float  # 1/(1 + w²)


class Sums(NamedTuple):
    """Length X and volume V/π of a panel in units of its τ, with rates in Re ζ, Im ζ and η."""

    length: float
    length_by_real: float
    length_by_imag: float
    length_by_eta: float
    volume: float
    volume_by_real: float
    volume_by_imag: float
    volume_by_eta: float


@kernel
def point_at(real: float, imag: float, h: float, v: float, dv: float) -> Node:
    """The point at v with its share dv of the parameter, h = η/2."""
    w = h * v
    p = 1.0 / (1.0 + w * w)
    nr, ni = real - v * h * imag, imag + v * (1.0 + h * real)
    return Node((nr - ni * w) * p, (ni + nr * w) * p, dv * p, v, w, p)


@kernel
def node_at(real: float, imag: float, h: float, cut: Cut, x: float, weight: float) -> Node:
    """The point at a node x in [-1, 1] of a cut, h = η/2."""
    t = 0.0625 * cut.half * x
    e = 1.0 + t * (
        1.0
        + t
        * (
            0.5
            + t * (1 / 6 + t * (1 / 24 + t * (1 / 120 + t * (1 / 720 + t * (1 / 5040 + t * (1 / 40320 + t / 362880))))))
        )
    )  # e^t by its series and four squarings: products alone, which a processor does several at a time
    e = e * e
    e = e * e
    e = e * e
    e = e * e * cut.middle
    inverse = 1.0 / e
    v = cut.pole + 0.5 * cut.spread * (e - inverse)
    return point_at(real, imag, h, v, 0.5 * cut.spread * cut.half * (e + inverse) * weight)


@summing_kernel
def _sum_length(real: float, imag: float, eta: float, cut: Cut, x: Nodes, weight: Nodes) -> Sums:
    """Length and its rates over a cut."""
    length = by_real = by_imag = by_eta = 0.0
    for j in range(len(x)):
        zr, zi, ds, v, w, p = node_at(real, imag, 0.5 * eta, cut, x[j], weight[j])
        inverse = 1.0 / math.sqrt(zr * zr + zi * zi)
        square = inverse * inverse
        cosine, sine = ds * zr * inverse, ds * zi * inverse
        er, ei = (1.0 - w * w) * p, 2.0 * w * p
        fr, fi = (er * zr + ei * zi) * square, (ei * zr - er * zi) * square
        turned = 0.5 * v * p * (2.0 * real * fr - (2.0 * imag + v) * fi)
        length += cosine
        by_real -= sine * fi
        by_imag -= sine * fr
        by_eta -= cosine * w * v * p + sine * turned
    return Sums(length, by_real, by_imag, by_eta, 0.0, 0.0, 0.0, 0.0)


@summing_kernel
def _sum_both(real: float, imag: float, eta: float, cut: Cut, x: Nodes, weight: Nodes) -> Sums:
    """Length and volume with their rates over a cut."""
    length = by_real = by_imag = by_eta = 0.0
    volume = v_real = v_imag = v_eta = 0.0
    for j in range(len(x)):
        zr, zi, ds, v, w, p = node_at(real, imag, 0.5 * eta, cut, x[j], weight[j])
        square = zr * zr + zi * zi
        inverse = 1.0 / math.sqrt(square)
        cosine, sine = ds * zr * inverse, ds * zi * inverse
        er, ei = (1.0 - w * w) * p, 2.0 * w * p
        fr, fi = (er * zr + ei * zi) * inverse * inverse, (ei * zr - er * zi) * inverse * inverse
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
    return Sums(length, by_real, by_imag, by_eta, volume, v_real, v_imag, v_eta)


@summing_kernel
def _sum_tensor(real: float, imag: float, eta: float, cut: Cut, x: Nodes, weight: Nodes) -> tuple[float, float]:
    """∫Y cos²φ ds and ∫Y sin²φ ds over a cut, in units of τ²."""
    across = axial = 0.0
    for j in range(len(x)):
        zr, zi, ds, _v, _w, _p = node_at(real, imag, 0.5 * eta, cut, x[j], weight[j])
        share = ds / math.sqrt(zr * zr + zi * zi)
        across += share * zr * zr
        axial += share * zi * zi
    return across, axial


@kernel
def branch_points(real: float, imag: float, h: float) -> tuple[float, float]:
    """The branch points of Y, pole ± i·spread, at the zeros of ζ: v = iζm/(1 + ηζm/2), and its conjugate; h = η/2.

    Far from the panel, or of a sphere, which has none, they do not matter: others are given.
    """
    cr, ci = 1.0 + h * real, h * imag
    square, aside = cr * cr + ci * ci, abs(real * cr + imag * ci)
    are_near = aside < _FARTHEST_POLE * square
    inverse = 1.0 / choose(are_near, square, 1.0)
    pole = choose(are_near, (real * ci - imag * cr) * inverse, 0.0)
    return pole, choose(are_near, max(aside * inverse, 1e-14), _FARTHEST_POLE)


@kernel
def cuts_of(real: float, imag: float, eta: float) -> tuple[Cut, float, int]:
    """First cut of a panel, growth of e^t from one to the next, number of cuts.

    The substitution smooths the branch points of Y.
    """
    pole, spread = branch_points(real, imag, 0.5 * eta)
    low, high = (-1.0 - pole) / spread, (1.0 - pole) / spread
    # e^{asinh x} without cancellation
    from_low = low + math.sqrt(1.0 + low * low) if low > 0.0 else 1.0 / (math.sqrt(1.0 + low * low) - low)
    to_high = high + math.sqrt(1.0 + high * high) if high > 0.0 else 1.0 / (math.sqrt(1.0 + high * high) - high)
    if from_low * _ONE_CUT > to_high:
        return Cut(pole, spread, math.sqrt(from_low * to_high), 0.5 * math.log(to_high / from_low)), 1.0, 1
    half = 0.5 * math.log(to_high / from_low)
    cuts = 1 + int(half / _WIDEST_CUT)
    half /= cuts
    return Cut(pole, spread, from_low * math.exp(half), half), math.exp(2.0 * half), cuts


@kernel
def _add(a: Sums, b: Sums) -> Sums:
    return Sums(a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5], a[6] + b[6], a[7] + b[7])


@kernel
def sum_panel(real: float, imag: float, eta: float, fine: bool, with_volume: bool) -> Sums:
    """Sums over one panel about ζ = real + i·imag, in units of its τ."""
    x, weight = (_NODES_24, _WEIGHTS_24) if fine else (NODES_16, WEIGHTS_16)
    cut, growth, cuts = cuts_of(real, imag, eta)
    total = Sums(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for _ in range(cuts):
        if with_volume:
            total = _add(total, _sum_both(real, imag, eta, cut, x, weight))
        else:
            total = _add(total, _sum_length(real, imag, eta, cut, x, weight))
        cut = Cut(cut.pole, cut.spread, cut.middle * growth, cut.half)
    return total


@kernel
def tensor_of_panel(real: float, imag: float, eta: float) -> tuple[float, float]:
    """∫Y cos²φ ds and ∫Y sin²φ ds over one panel, in units of its τ²."""
    across = axial = 0.0
    cut, growth, cuts = cuts_of(real, imag, eta)
    for _ in range(cuts):
        more_across, more_axial = _sum_tensor(real, imag, eta, cut, _NODES_24, _WEIGHTS_24)
        across += more_across
        axial += more_axial
        cut = Cut(cut.pole, cut.spread, cut.middle * growth, cut.half)
    return across, axial
