"""The arc: Carlson's integrals against SciPy, the closed form against the quadrature, both against quad and mpmath."""

import math

import mpmath
import numpy as np
import pytest
from pendular.exact.carlson import carlson_fd
from pendular.exact.contact import cap_volume, contact_at, force_at, force_rate, wetted_arc_of, wetted_area
from scipy.integrate import quad
from scipy.special import elliprd, elliprf

from pendular.exact.meridian import (
    arc_across,
    arc_from_neck,
    arc_length_from_neck,
    lay_meridian,
    middle_between,
    point_on_arc,
)

SEED = 20200622


def arguments_of_carlson():
    rng = np.random.default_rng(SEED)
    print(f"seed {SEED}")
    spread = 10.0 ** rng.uniform(-8, 8, (3000, 3))
    nearly_equal = 1.0 + 1e-3 * rng.random((1000, 3))
    with_zero = np.column_stack([np.zeros(500), 10.0 ** rng.uniform(-8, 8, (500, 2))])
    return np.vstack([spread, nearly_equal, with_zero])


def test_carlson_agrees_with_scipy():
    rows = arguments_of_carlson()
    ours = np.array([carlson_fd(*row) for row in rows])
    theirs = np.column_stack([elliprf(*rows.T), elliprd(*rows.T)])
    assert np.max(np.abs(ours / theirs - 1.0)) < 2e-15  # measured 9e-16


def test_carlson_is_homogeneous():
    rf, rd = carlson_fd(0.3, 1.7, 2.9)
    rf4, rd4 = carlson_fd(1.2, 6.8, 11.6)
    assert rf4 == pytest.approx(rf / 2.0, rel=1e-15)
    assert rd4 == pytest.approx(rd / 8.0, rel=1e-15)


def slope_angle_integrals(curvature, radius, sin_slope, cos_slope):
    """Section 4.1: X, A, V and ∂X/∂λ by mpmath, over the slope angle instead of the phase."""
    with mpmath.workdps(30):
        h, y = mpmath.mpf(curvature), mpmath.mpf(radius)
        end = mpmath.atan2(sin_slope, cos_slope)
        force = y * (mpmath.cos(end) + h * y / 2)

        def r(phi):
            return mpmath.sqrt(mpmath.cos(phi) ** 2 + 2 * h * force)

        def width(phi):
            return 2 * force / (mpmath.cos(phi) + r(phi))

        def over(integrand):
            return mpmath.quad(integrand, mpmath.linspace(0, end, 4))

        return [
            float(value)
            for value in (
                over(lambda phi: width(phi) * mpmath.cos(phi) / r(phi)),
                2 * mpmath.pi * over(lambda phi: width(phi) ** 2 / r(phi)),
                mpmath.pi * over(lambda phi: width(phi) ** 3 * mpmath.cos(phi) / r(phi)),
                over(lambda phi: mpmath.cos(phi) ** 2 / r(phi) ** 3),
            )
        ]


@pytest.mark.parametrize("curvature", [0.0, 1e-9, 0.3, 1.0, 30.0, 1e4, 1e8, 1e12])
@pytest.mark.parametrize("slope", [1.55, 0.9, 0.1, -0.4, -1.5])
def test_arc_from_neck(curvature, slope):
    radius = min(0.5, 1.0 / math.sqrt(curvature)) if curvature else 0.5  # from a bridge at contact, Y ~ √(1/H)
    arc = arc_from_neck(curvature, radius, math.sin(slope), math.cos(slope))
    length, area, volume, rate = slope_angle_integrals(curvature, radius, math.sin(slope), math.cos(slope))
    assert arc.length == pytest.approx(length, rel=5e-15)
    assert arc.area == pytest.approx(area, rel=5e-15)
    if curvature == 0.0 or curvature * radius > 0.1:
        assert arc.volume == pytest.approx(volume, rel=5e-14)
    # ∂X/∂λ loses a factor HY, and is then as much smaller than the contact's share of dD/dλ
    assert arc.length_rate == pytest.approx(rate, rel=2e-15 * (10.0 + curvature * radius))


def by_quad(y, slope, phase):
    def over(integrand):
        return quad(lambda t: integrand(point_on_arc(y, slope, phase, t)), -1, 1, epsabs=0, epsrel=1e-12, limit=400)[0]

    return (
        over(lambda z: z.real / abs(z)),
        math.pi * over(lambda z: z.real * abs(z)),
        2.0 * math.pi * over(abs),
        math.pi * over(lambda z: z.real**2 / abs(z)),
    )


# name: y = Ym/ℓ, φm, ω = Hℓ
ARCS = {
    "catenoid": (0.8, 0.3, 0.0),
    "catenoid, thin neck": (0.02, 0.1, 0.0),
    "almost a catenoid": (0.8, 0.3, 1e-10),
    "nodoid": (0.5, -0.2, 0.7),
    "torus": (1e3, 0.1, 1.4),
    "cylinder": (1.5, 0.0, -1 / 1.5),
    "almost a cylinder": (1.5, 1e-7, -1 / 1.5),
    "unduloid from its neck": (0.4, 0.0, -1.2),
    "unduloid from its bulge": (1.2, 0.0, -1.4),
    "sphere": (1.0, 0.0, -2.0 * 0.7),
    "convex nodoid": (1.0, 0.0, -2.6),
    "neck outside": (0.6, 1.0, 0.4),
}


@pytest.mark.parametrize("name", ARCS)
def test_arc_across(name):
    y, slope, phase = ARCS[name]
    arc = arc_across(y, slope, phase, False)
    expected = by_quad(y, slope, phase)
    measured = (arc.length, arc.volume, arc.area, arc.tensor)
    assert measured == pytest.approx(expected, rel=2e-12)


@pytest.mark.parametrize("name", ARCS)
def test_rates_of_arc_across(name):
    y, slope, phase = ARCS[name]
    step = 1e-5
    arc = arc_across(y, slope, phase, False)
    for i, (dy, ds, dp) in enumerate(np.eye(3) * step):
        ahead = arc_across(y * math.exp(dy), slope + ds, phase + dp, False)
        back = arc_across(y * math.exp(-dy), slope - ds, phase - dp, False)
        scale = 1.0 + y * y
        assert arc.length_rates[i] == pytest.approx((ahead.length - back.length) / (2 * step), abs=1e-8)
        assert arc.volume_rates[i] == pytest.approx((ahead.volume - back.volume) / (2 * step), abs=2e-8 * scale * y)


def test_symmetric_arc_is_twice_its_half():
    half, whole = arc_across(0.7, 0.0, 0.4, True), arc_across(0.7, 0.0, 0.4, False)
    assert half[:4] == pytest.approx(whole[:4], rel=1e-15)


@pytest.mark.parametrize(("curvature", "slopes"), [(0.0, (0.9, 0.4)), (3.0, (1.2, -0.3)), (200.0, (1.5, 1.4))])
def test_closed_form_and_quadrature_are_one_arc(curvature, slopes):
    neck = 0.2
    ends = []
    for slope in slopes:  # the radius that the surface of this neck has at the slope
        force = neck * (1.0 + 0.5 * curvature * neck)
        r = math.sqrt(math.cos(slope) ** 2 + 2.0 * curvature * force)
        ends.append((2.0 * force / (math.cos(slope) + r), math.sin(slope), math.cos(slope)))
    arcs = [arc_from_neck(curvature, *end) for end in ends]
    lengths = [arc_length_from_neck(curvature, *end) for end in ends]
    middle = middle_between(curvature, neck, *lengths)
    across = arc_across(middle.y, middle.slope, middle.phase, False)
    assert [arc.neck_radius for arc in arcs] == pytest.approx([neck, neck], rel=1e-14)
    assert across.length * middle.half_length == pytest.approx(arcs[0].length + arcs[1].length, rel=1e-14)
    assert across.area * middle.half_length**2 == pytest.approx(arcs[0].area + arcs[1].area, rel=1e-14)

    x, radius = np.empty(64), np.empty(64)
    lay_meridian(middle, x, radius)
    assert x[-1] == pytest.approx(arcs[0].length + arcs[1].length, rel=1e-14)
    assert radius[[0, -1]] == pytest.approx([ends[0][0], ends[1][0]], rel=1e-14)


@pytest.mark.parametrize("k", [0.0, 1e-3, 1.0])
def test_contact_closed_form_inverts_the_force(k):
    for arc in (1e-8, 1e-3, 0.4):
        for curvature in (0.0, 2.0, 1e6):
            contact = contact_at(arc, k, 0.3)
            force = force_at(contact, curvature)
            assert wetted_arc_of(force, curvature, k, 0.3) == pytest.approx(arc, rel=1e-14)


def test_force_rate_is_the_derivative():
    k, theta, curvature, arc, step = 1.0, 0.4, 3.0, 0.7, 1e-6
    ahead, back = (force_at(contact_at(arc + s, k, theta), curvature) for s in (step, -step))
    assert force_rate(contact_at(arc, k, theta), curvature, k) == pytest.approx((ahead - back) / (2 * step), rel=1e-9)


def test_cap_of_a_sphere():
    half = contact_at(0.5 * math.pi, 1.0, 0.2)
    assert cap_volume(half) == pytest.approx(2.0 / 3.0 * math.pi, rel=1e-15)
    assert wetted_area(half) == pytest.approx(2.0 * math.pi, rel=1e-15)


def test_no_contact_where_the_force_is_too_large():
    assert math.isnan(wetted_arc_of(2.0, 0.0, 1.0, 0.0))
