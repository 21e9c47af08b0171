"""How many directions lead down from a bridge, against the second variation of its energy.

For a displacement u along the normal, with s the arc length, Y the radius and κ1, κ2 the curvatures,

    δ²Ω/2πγ = ∫ Y (u'² + m²u²/Y² - (κ1² + κ2²) u²) ds + Σ Y χ u² ,   χ = (k + κ1 cos θ)/sin θ

where the sum is over the contact circles, which slide along solids of curvature k at the contact angle θ. A held volume
allows only u with ∫ Y u ds = 0.
"""

import math

import numpy as np
import pytest

import pendular as pl

UNIT = pl.Liquid(surface_tension=1.0)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(160)
DEGREE = 60
SEED = 11


def directions_down(bridge, curvatures, angles, *, volume_held=False, mode=0):
    """Negative eigenvalues of the second variation, in Legendre polynomials of the arc length."""
    radius, slope, half = bridge._meridian
    curvature = float(bridge.suction)

    def along(share):
        turn = curvature * half * share
        step = 1j * half * share * np.exp(0.5j * turn) * np.sinc(turn / (2.0 * np.pi))
        return radius * np.exp(1j * (slope + turn)) + step

    def bends(zeta):
        across = zeta.real / abs(zeta) ** 2
        return curvature + across, across

    zeta = along(NODES)
    first, second = bends(zeta)
    each = np.eye(DEGREE)
    values = np.polynomial.legendre.legval(NODES, each)
    slopes = np.polynomial.legendre.legval(NODES, np.polynomial.legendre.legder(each)) / half
    weight = WEIGHTS * half * abs(zeta)
    form = (slopes * weight) @ slopes.T
    form += (values * weight * (mode**2 / abs(zeta) ** 2 - first**2 - second**2)) @ values.T
    for share, solid, angle in zip((-1.0, 1.0), curvatures, angles, strict=True):
        end = along(share)
        at_end = np.polynomial.legendre.legval(share, each)
        stiffness = (solid + bends(end)[0] * math.cos(angle)) / math.sin(angle)
        form += abs(end) * stiffness * np.outer(at_end, at_end)
    if volume_held:
        constraint = values @ weight
        others = np.linalg.svd(constraint[None, :])[2][1:]
        form = others @ form @ others.T
    return int(np.sum(np.linalg.eigvalsh(form) < 0.0))


def random_pairs(count):
    rng = np.random.default_rng(SEED)
    for _ in range(count):
        second = rng.choice([1.0, rng.uniform(0.3, 3.0), math.inf])
        angles = np.deg2rad(rng.uniform(5.0, 170.0, 2))
        if second == 1.0:
            angles[1] = angles[0]
        yield rng, pl.Pair((1.0, second), tuple(map(float, angles))), (1.0, 1.0 / second), angles


def check(bridge, curvatures, angles, *, volume_held):
    if not bridge.exists:
        return 0
    down = directions_down(bridge, curvatures, angles, volume_held=volume_held)
    assert bridge.unstable_directions == down, (SEED, bridge)
    if abs(bridge.force) > 1e-6:
        sideways = directions_down(bridge, curvatures, angles, mode=1)
        assert bridge.sideways_stable == (sideways == 0), (SEED, bridge)
    assert bridge.stable == (down == 0 and bridge.force >= 0.0)
    return 1


@pytest.mark.parametrize("branch", ["stable", "unstable"])
@pytest.mark.parametrize("limit", ["stability", "fold"])
def test_at_a_volume(branch, limit):
    found = 0
    for rng, pair, curvatures, angles in random_pairs(60):
        held = {"volume": 10.0 ** rng.uniform(-4.0, 1.0), "liquid": UNIT, "limit": limit}
        end = pl.rupture(pair, **held)
        if end.exists:
            gap = rng.uniform(0.2, 0.98) * end.separation
            found += check(pl.bridge(pair, gap, branch=branch, **held), curvatures, angles, volume_held=True)
    assert found > 25


@pytest.mark.parametrize("branch", ["stable", "unstable"])
def test_under_suction(branch):
    found = 0
    for rng, pair, curvatures, angles in random_pairs(60):
        held = {"suction": rng.choice([-1.0, 1.0, 1.0]) * 10.0 ** rng.uniform(-2.0, 2.0), "liquid": UNIT}
        end = pl.rupture(pair, **held)
        if end.exists:
            gap = rng.uniform(0.2, 0.98) * end.separation
            found += check(pl.bridge(pair, gap, branch=branch, **held), curvatures, angles, volume_held=False)
    assert found > 10


# Equal solids at the angle where the pitchfork moves past the fold: both lie within the probe that tells the index.
@pytest.mark.parametrize(
    ("angle", "volume", "separation"),
    [
        (0.5033385737425603, 0.05423572372236782, 0.24731564231477),
        (0.5388318076770949, 0.0002127283390363022, 0.03546983140028875),
    ],
)
def test_the_unstable_branch_goes_on_where_fold_and_pitchfork_meet(angle, volume, separation):
    held = {"volume": volume, "liquid": pl.Liquid(surface_tension=1.0), "branch": "unstable"}
    before, there = (pl.bridge(pl.Pair(1.0, a), separation, **held) for a in (angle - 1e-4, angle))
    assert there.exists
    assert there.volume == pytest.approx(volume, rel=1e-9)
    assert there.force == pytest.approx(before.force, rel=0.01)
    assert there.unstable_directions == before.unstable_directions
