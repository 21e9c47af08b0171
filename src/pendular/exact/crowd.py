r"""Length and volume of an arc by nodes that crowd where it is thin: a few serve, for one row or for one in each lane.

The branch points of Y lie at :math:`p \pm ib`, near the panel where a neck is thin. They are none in a variable t with
:math:`v = p + b\sinh t`, as :math:`\sinh t \mp i` has double zeros there. From one end of the arc to the other
:math:`e^t` is a constant times :math:`r^2`, with r(x) a Möbius map of the nodes' interval: a node takes neither a
logarithm nor an exponential.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..ground.compile import kernel, summing_kernel
from ..ground.lanes import choose
from .quadrature import Sums, branch_points

Nodes = NDArray[np.float64]


class Crowd(NamedTuple):
    """Where the nodes x lie: v = p + onwards·r² - back/r² with r = (1 + qx)/(1 - qx)."""

    pole: float  # p
    onwards: float
    back: float
    bend: float  # q


@kernel
def _exp_asinh(x: float) -> float:
    """Of asinh x the exponential, without cancellation."""
    large = abs(x) + math.sqrt(1.0 + x * x)
    return choose(x > 0.0, large, 1.0 / large)


@kernel
def _crowd_of(real: float, imag: float, h: float) -> Crowd:
    """The nodes of an arc, h = η/2."""
    pole, spread = branch_points(real, imag, h)
    inverse = 1.0 / spread
    first, last = _exp_asinh((-1.0 - pole) * inverse), _exp_asinh((1.0 - pole) * inverse)
    widened = math.sqrt(math.sqrt(last / first))  # r at the last end
    middle, half = math.sqrt(first * last), 0.5 * spread
    return Crowd(pole, half * middle, half / middle, (widened - 1.0) / (widened + 1.0))


class Node(NamedTuple):
    """A point of an arc, with its shares of the sums; Y and φ are radius and slope there."""

    v: float
    w: float  # ηv/2
    p: float  # 1/(1 + w²)
    square: float  # Y²
    cosine: float  # cos φ ds, of a node with its weight
    sine: float
    real: float  # of the rate of ln ζ in Re ζm
    imag: float


@kernel
def _node_at(real: float, imag: float, h: float, crowd: Crowd, x: float, weight: float) -> Node:
    """The point at a node x in [-1, 1]."""
    place = crowd.bend * x
    up, down = 1.0 + place, 1.0 - place
    over = 1.0 / (up * down)
    r, s = up * up * over, down * down * over
    ahead, behind = crowd.onwards * (r * r), crowd.back * (s * s)
    v, dv = crowd.pole + ahead - behind, (ahead + behind) * (4.0 * crowd.bend * over) * weight
    w = h * v
    nr, ni = real - h * imag * v, imag + (1.0 + h * real) * v
    turned, size = 1.0 + w * w, nr * nr + ni * ni
    inverse = 1.0 / (turned * size)
    p, shrunk = size * inverse, turned * inverse  # 1/(1 + w²), 1/|N|²
    share = dv * p * p * math.sqrt(turned * shrunk)
    return Node(
        v,
        w,
        p,
        size * p,
        share * (nr - ni * w),
        share * (ni + nr * w),
        (nr + w * ni) * shrunk,
        (w * nr - ni) * shrunk,
    )


@summing_kernel
def _sum_length(real: float, imag: float, h: float, crowd: Crowd, x: Nodes, weight: Nodes) -> Sums:
    """Length and its rates."""
    nothing = 0.0 * h  # in lanes, if that is in lanes
    length = by_real = by_imag = by_eta = nothing
    for j in range(len(x)):
        v, w, p, _square, cosine, sine, fr, fi = _node_at(real, imag, h, crowd, x[j], weight[j])
        length += cosine
        by_real -= sine * fi
        by_imag -= sine * fr
        by_eta -= v * p * (cosine * w + sine * (real * fr - (imag + 0.5 * v) * fi))
    return Sums(length, by_real, by_imag, by_eta, nothing, nothing, nothing, nothing)


@summing_kernel
def _sum_both(real: float, imag: float, h: float, crowd: Crowd, x: Nodes, weight: Nodes) -> Sums:
    """Length and volume with their rates."""
    nothing = 0.0 * h  # in lanes, if that is in lanes
    length = by_real = by_imag = by_eta = nothing
    volume = v_real = v_imag = v_eta = nothing
    for j in range(len(x)):
        v, w, p, square, cosine, sine, fr, fi = _node_at(real, imag, h, crowd, x[j], weight[j])
        reach, across = v * p, imag + 0.5 * v
        grown, bent = -reach * (across * fr + real * fi), reach * (real * fr - across * fi)
        lag = reach * w
        disc, tilt = cosine * square, sine * square
        length += cosine
        by_real -= sine * fi
        by_imag -= sine * fr
        by_eta -= cosine * lag + sine * bent
        volume += disc
        v_real += 2.0 * disc * fr - tilt * fi
        v_imag -= 2.0 * disc * fi + tilt * fr
        v_eta += disc * (2.0 * grown - lag) - tilt * bent
    return Sums(length, by_real, by_imag, by_eta, volume, v_real, v_imag, v_eta)


@kernel
def sum_crowded(real: float, imag: float, eta: float, x: Nodes, weight: Nodes, with_volume: bool) -> Sums:
    """Sums over one panel about ζ = real + i·imag, in units of its τ."""
    h = 0.5 * eta
    crowd = _crowd_of(real, imag, h)
    if with_volume:
        return _sum_both(real, imag, h, crowd, x, weight)
    return _sum_length(real, imag, h, crowd, x, weight)
