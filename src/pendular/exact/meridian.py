"""An arc of a surface of constant mean curvature: length, volume, area. Knows no solids.

The meridian obeys X' = cos φ, Y' = sin φ, φ' = H + cos φ/Y over its arc length; Y cos φ + H Y²/2 = λ along it
(the first integral). Two ways to measure an arc are given:

- :func:`arc_from_neck`, closed, in Carlson's integrals, from the neck to a given point: one force, one suction;
- :func:`arc_across`, by quadrature, about any point of the meridian: every surface there is (nodoid, catenoid,
  unduloid, cylinder, sphere) with smooth derivatives, so that Newton's method can walk through all of them.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._jit import kernel
from .carlson import carlson_fd


class NeckArc(NamedTuple):
    """The arc from the neck to a point (Y, φ) of a surface with H ≥ 0; negative behind the neck."""

    neck_radius: float  # Y0
    length: float  # X, along the axis
    area: float  # A, of the surface
    volume: float  # π ∫ Y² dX
    length_rate: float  # ∂X/∂λ at fixed H and φ


@kernel
def arc_from_neck(curvature: float, radius: float, sin_slope: float, cos_slope: float) -> NeckArc:
    r"""Arc from the neck (Y0, φ = 0) to the point (Y, φ), in closed form.

    .. math::
        X = Y_0 J_0 - \tfrac12 H q J_2, \qquad A = 2\pi (Y_0^2 J_0 + q J_2), \qquad
        \frac{V_{rot}}{\pi} = \frac{2}{3H}\Bigl[Y^2\sin\varphi + \lambda X - \frac{A}{\pi}\Bigr]

    with :math:`q = \sqrt{1 + 2H\lambda}`, :math:`Y^2 = Y_0^2 + q\sigma^2`,
    :math:`J_0 = \sigma R_F(Y_0^2, Y^2, Y_0^2c^2)` and
    :math:`J_2 = \tfrac13 Y_0^2\sigma^3 R_D(Y^2, Y_0^2c^2, Y_0^2)`.

    The volume divides by HY and loses as many digits as that has zeros; ask :func:`arc_across` below 0.1.
    """
    h_radius = curvature * radius
    force = radius * (cos_slope + 0.5 * h_radius)
    versine = sin_slope * sin_slope / (1.0 + cos_slope) if cos_slope > 0.0 else 1.0 - cos_slope
    q = math.sqrt((1.0 + h_radius) * (1.0 + h_radius) - 2.0 * h_radius * versine)
    neck = 2.0 * force / (1.0 + q)  # never (q - 1)/H

    cos_phase = 1.0 + h_radius * cos_slope  # q cos Hs
    sin_phase = h_radius * sin_slope  # q sin Hs
    # c = cos(Hs/2), from the larger of the two forms of its square
    square = 0.5 * (q + cos_phase) / q if cos_phase > 0.0 else 0.5 * sin_phase * sin_phase / (q * (q - cos_phase))
    c = math.sqrt(square)
    sigma = radius * sin_slope / (q * c)  # (2/H) sin(Hs/2)

    rf, rd = carlson_fd(radius * radius, neck * neck * square, neck * neck)
    j0 = sigma * rf
    j2 = sigma * sigma * sigma * neck * neck * rd / 3.0
    length = neck * j0 - 0.5 * curvature * q * j2
    area = 2.0 * math.pi * (neck * neck * j0 + q * j2)
    volume = (
        math.pi * (2.0 / 3.0) * (radius * radius * sin_slope + force * length - area / math.pi) / curvature
        if curvature != 0.0
        else 0.5 * force * area
    )

    # ∫ cos²φ/r³ dφ with r = cos φ + HY = q b/Y, reduced to J0 and J2; e2 is ∫ sin²φ/r³ dφ.
    b = neck + 0.5 * curvature * sigma * sigma
    e2 = (sigma * c * radius / (neck * b) - j0 + 0.5 * q * curvature * j2 / neck) / (1.0 + q)
    length_rate = (j0 - 2.0 * curvature * force * e2) / (q * q)
    return NeckArc(neck, length, area, volume, length_rate)


class Across(NamedTuple):
    """The arc between two ends, in units of half its arc length ℓ, with its rates of change."""

    length: float  # X/ℓ
    volume: float  # π ∫ Y² dX / ℓ³
    area: float  # A/ℓ²
    tensor: float  # n11/ℓ², n11 = π ∫ Y cos²φ ds
    length_rates: tuple[float, float, float]  # with respect to ln y, φm, ω
    volume_rates: tuple[float, float, float]


@kernel
def _turn(phase: float, t: float) -> tuple[complex, complex]:
    """exp(iωt), and (exp(iωt) - 1)/ω without division by ω."""
    half = 0.5 * phase * t
    sin_half, cos_half = math.sin(half), math.cos(half)
    ratio = sin_half / half if abs(half) > 1e-8 else 1.0
    turned = complex(1.0 - 2.0 * sin_half * sin_half, 2.0 * sin_half * cos_half)
    return turned, t * ratio * complex(-sin_half, cos_half)


@kernel
def point_on_arc(y: float, slope: float, phase: float, t: float) -> complex:
    r"""ζ = Y exp(iφ) in units of ℓ, at the arc length t from the middle of an arc (-1 ≤ t ≤ 1).

    .. math:: \zeta = y\,e^{i(\varphi_m + \omega t)} + \frac{e^{i\omega t} - 1}{\omega}

    the solution of the meridian equations that has radius y = Ym/ℓ and slope φm in the middle, ω = Hℓ.
    """
    turned, catenary = _turn(phase, t)
    return complex(y * math.cos(slope), y * math.sin(slope)) * turned + catenary


@kernel
def point_and_rates(middle: complex, phase: float, t: float) -> tuple[complex, complex, complex]:
    """ζ for the middle y exp(iφm), ∂ζ/∂(ln y), and ∂ζ/∂ω; ∂ζ/∂φm is i ∂ζ/∂(ln y)."""
    turned, catenary = _turn(phase, t)
    to_y = middle * turned
    x = phase * t
    if abs(x) > 1e-3:
        to_phase = (1j * t * turned - catenary) / phase
    else:
        to_phase = t * t * complex(-0.5 + x * x / 8.0, -x / 3.0 + x * x * x / 30.0)
    return to_y + catenary, to_y, 1j * t * to_y + to_phase


@kernel
def _relative(change: complex, inverse: complex) -> tuple[float, float]:
    """δY/Y and δφ, the real and imaginary part of δζ/ζ."""
    ratio = change * inverse
    return ratio.real, ratio.imag


_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)
_NODES, _WEIGHTS = 0.5 * (_NODES + 1.0), 0.5 * _WEIGHTS  # on [0, 1]


@kernel
def _stretching(y: float, slope: float, phase: float) -> tuple[float, float]:
    """Position of the nearest neck and its stretch b = Y0/√q, with Y² ≈ Y0² (1 + (t - tn)²/b²) around it.

    A thin neck makes the integrands nearly singular in t; they are smooth in τ, t = tn + b sinh τ. A stretch of
    zero asks for no substitution: no neck near, or one so wide that t itself is good.
    """
    h = phase * y
    force = y * (math.cos(slope) + 0.5 * h)
    square = 1.0 + 2.0 * phase * force
    cos_phase = 1.0 + h * math.cos(slope)
    if not (force > 0.0 and square > 0.0 and cos_phase > 0.0):
        return 0.0, 0.0
    q = math.sqrt(square)
    stretch = 2.0 * force / ((1.0 + q) * math.sqrt(q))
    if stretch > 3.0:
        return 0.0, 0.0
    if abs(phase) < 1e-8:
        return -y * math.sin(slope) / cos_phase, stretch
    return -math.atan2(h * math.sin(slope), cos_phase) / phase, stretch


@kernel
def arc_across(y: float, slope: float, phase: float, symmetric: bool) -> Across:
    """Arc between its two ends at -ℓ and +ℓ, from its middle: radius y = Ym/ℓ, slope φm, phase ω = Hℓ.

    Gauss-Legendre on two panels, stretched about a thin neck; on one for a symmetric arc (φm = 0), twice its half.
    Any value of the three arguments that keeps Y > 0 is a piece of some surface, and nothing here divides by
    the suction or by the modulation of the surface: catenoid and cylinder need no case of their own.
    """
    neck, stretch = _stretching(y, slope, phase)
    if stretch > 0.0:
        low = 0.0 if symmetric else math.asinh((-1.0 - neck) / stretch)
        high = math.asinh((1.0 - neck) / stretch)
    else:
        low = 0.0 if symmetric else -1.0
        high = 1.0
    split = 0.0 if (stretch > 0.0 and low < 0.0 < high) else 0.5 * (low + high)
    middle = complex(y * math.cos(slope), y * math.sin(slope))

    length = volume = area = tensor = 0.0
    xy = xs = xp = vy = vs = vp = 0.0
    for panel in range(1 if symmetric else 2):
        start, end = (low, high) if symmetric else ((low, split) if panel == 0 else (split, high))
        width = end - start
        for j in range(_NODES.size):
            tau = start + width * _NODES[j]
            weight = width * _WEIGHTS[j]
            if stretch > 0.0:
                grown = math.exp(tau)
                t = neck + 0.5 * stretch * (grown - 1.0 / grown)
                weight *= 0.5 * stretch * (grown + 1.0 / grown)
            else:
                t = tau
            zeta, to_y, to_phase = point_and_rates(middle, phase, t)
            square = zeta.real * zeta.real + zeta.imag * zeta.imag
            radius = math.sqrt(square)
            over = 1.0 / radius
            cos_slope, sin_slope = zeta.real * over, zeta.imag * over
            inverse = complex(cos_slope * over, -sin_slope * over)  # 1/ζ
            length += weight * cos_slope
            area += weight * radius
            volume += weight * square * cos_slope
            tensor += weight * radius * cos_slope * cos_slope
            # δ(cos φ) = -sin φ δφ,   δ(Y² cos φ) = 2 Y cos φ δY - Y² sin φ δφ
            grow, turn = _relative(to_y, inverse)
            xy -= weight * sin_slope * turn
            vy += weight * square * (2.0 * cos_slope * grow - sin_slope * turn)
            grow, turn = _relative(1j * to_y, inverse)
            xs -= weight * sin_slope * turn
            vs += weight * square * (2.0 * cos_slope * grow - sin_slope * turn)
            grow, turn = _relative(to_phase, inverse)
            xp -= weight * sin_slope * turn
            vp += weight * square * (2.0 * cos_slope * grow - sin_slope * turn)

    sides = 2.0 if symmetric else 1.0
    pi_sides = sides * math.pi
    return Across(
        sides * length,
        pi_sides * volume,
        2.0 * pi_sides * area,
        pi_sides * tensor,
        (sides * xy, sides * xs, sides * xp),
        (pi_sides * vy, pi_sides * vs, pi_sides * vp),
    )


class Middle(NamedTuple):
    """The middle of an arc, as :func:`arc_across` wants it, and half its arc length."""

    y: float
    slope: float
    phase: float
    half_length: float


@kernel
def arc_length_from_neck(curvature: float, radius: float, sin_slope: float, cos_slope: float) -> float:
    """Arc length s from the neck to the point (Y, φ): tan(Hs/2) = HY sin φ/(q + 1 + HY cos φ)."""
    h_radius = curvature * radius
    q = math.sqrt(1.0 + 2.0 * curvature * radius * (cos_slope + 0.5 * h_radius))
    tangent = radius * sin_slope / (q + 1.0 + h_radius * cos_slope)  # tan(Hs/2)/H
    x = curvature * tangent
    return 2.0 * tangent * (math.atan(x) / x if abs(x) > 1e-8 else 1.0)


@kernel
def middle_between(curvature: float, neck: float, back: float, ahead: float) -> Middle:
    """Middle of the arc from the arc length -back to +ahead of a neck of radius Y0."""
    half_length = 0.5 * (back + ahead)
    phase = curvature * half_length
    zeta = point_on_arc(neck / half_length, 0.0, phase, 0.5 * (ahead - back) / half_length)
    return Middle(abs(zeta), math.atan2(zeta.imag, zeta.real), phase, half_length)


@kernel
def lay_meridian(middle: Middle, x: NDArray[np.float64], radius: NDArray[np.float64]) -> None:
    """Axial coordinate from the first end, and radius, at points evenly spaced along an arc."""
    last = x.size - 1
    x[0] = 0.0
    for i in range(last + 1):
        t = 2.0 * i / last - 1.0
        radius[i] = middle.half_length * abs(point_on_arc(middle.y, middle.slope, middle.phase, t))
        if i == last:
            break
        advance = 0.0
        for j in range(_NODES.size):
            zeta = point_on_arc(middle.y, middle.slope, middle.phase, t + 2.0 * _NODES[j] / last)
            advance += _WEIGHTS[j] * zeta.real / abs(zeta)
        x[i + 1] = x[i] + middle.half_length * advance * 2.0 / last
