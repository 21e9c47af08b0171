"""Bridges that are large for their pair, up to the largest volume of the domain, 1e4 R̄³.

Oracle: a bridge without a force is a sphere of liquid. With its radius a and its centre at the distance c from that of
a solid of radius R, the law of cosines with the contact angle says c² = a² + R² - 2aR cos θ, and the volume is that of
the sphere less two lenses.
"""

import math

import numpy as np
import pytest

import pendular as pl

UNIT = pl.Liquid(surface_tension=1.0)


def lens(a, b, distance):
    """Volume that two spheres share."""
    near = (a + b - distance) ** 2
    return math.pi * near * (distance**2 + 2.0 * distance * (a + b) - 3.0 * (a - b) ** 2) / (12.0 * distance)


def drop(a, radii, angles):
    """Separation and volume of a drop of radius a between two spheres."""
    distances = [math.sqrt(a * a + r * r - 2.0 * a * r * math.cos(t)) for r, t in zip(radii, angles, strict=True)]
    separation = sum(c - r for c, r in zip(distances, radii, strict=True))
    wetted = sum(lens(a, r, c) for c, r in zip(distances, radii, strict=True))
    return separation, 4.0 / 3.0 * math.pi * a**3 - wetted


def drops(seed, count):
    rng = np.random.default_rng(seed)
    print(f"seed {seed}")
    while count:
        radii = (1.0, math.exp(rng.uniform(0.0, math.log(30.0))))
        angles = tuple(np.radians(rng.uniform(10.0, 170.0, 2)))
        a = math.exp(rng.uniform(math.log(0.5), math.log(40.0)))
        separation, volume = drop(a, radii, angles)
        volume_star = volume * ((1.0 + 1.0 / radii[1]) / 2.0) ** 3
        if separation > 0.0 and 1e-2 < volume_star < 1e4:
            count -= 1
            yield a, radii, angles, separation, volume


def test_a_drop_between_two_spheres_is_found():
    for a, radii, angles, separation, volume in drops(91, 12):
        pair = pl.Pair(radii, angles)
        bridge = pl.bridge(pair, separation, volume=volume, liquid=UNIT)
        assert bridge.exists
        assert bridge.unstable_directions == 0
        assert bridge.suction == pytest.approx(-2.0 / a, rel=1e-9)
        assert abs(bridge.force) < 1e-8 * a
        assert pl.rupture(pair, volume=volume, liquid=UNIT).separation > separation


# R2, angles, V: each was lost once. The last three distances are those of the first version of the solver.
LOST = [
    (1.0, 65.83, 1.58, 498.0, None),
    (1.0067, 83.14, 0.0, 985.0, None),
    (1.21251, 69.35, 165.24, 869.0, None),
    (60.191, 179.68520074, 99.18842793, 749.0722086886924, None),
    (1.0, 175.01, 0.0, 0.01215, None),
    (115.4402, 0.0, 179.5575577, 0.018811969231555214, None),
    (90.9083, 179.229, 0.0, 0.0309667, 0.000338056),
    (811.581, 179.8306, 0.0, 0.000103763, 1.68125e-05),
    (56.6465, 177.9158, 0.0, 0.475927, 0.00227765),
]


@pytest.mark.parametrize(("radius", "angle1", "angle2", "volume", "distance"), LOST)
def test_a_bridge_that_was_lost_is_found(radius, angle1, angle2, volume, distance):
    pair = pl.Pair((1.0, radius), (math.radians(angle1), math.radians(angle2)))
    end = pl.rupture(pair, volume=volume, liquid=UNIT)
    assert end.exists
    assert end.separation > 0.0
    if distance is not None:
        assert end.separation == pytest.approx(distance, rel=1e-2)
    low = pl.rupture(pair, volume=volume, liquid=UNIT, end="lower")
    start = low.separation if low.exists else 0.0
    assert start < end.separation
    between = pl.bridge(pair, 0.5 * (start + end.separation), volume=volume, liquid=UNIT)
    assert between.exists
    assert between.unstable_directions == 0
    assert not pl.bridge(pair, 1.01 * end.separation, volume=volume, liquid=UNIT).exists
