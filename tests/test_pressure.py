"""Bridges whose liquid is at a pressure above that outside, H < 0, under suction control.

Oracle: the bridge of a volume. It is stable under suction, too, where its suction falls when liquid is added.
"""

import math

import numpy as np
import pytest

import pendular as pl

UNIT = pl.Liquid(surface_tension=1.0)


# Each was lost: Newton's method leads from all guesses to unstable bridges, from which no fold leads to the stable one.
@pytest.mark.parametrize(
    ("radius", "angles", "separation", "suction"),
    [
        (1.0, (1.1237112553364355, 1.3904673957531841), 0.012660603681771484, -3.4407429494841204),
        (440.04041196206805, (1.2358446126676028, 1.4549590950712095), 0.009149993429377255, -2.3982634545857047),
        (1.0, (1.2578527907801795, 1.2578527907801795), 0.00041717570546396577, -3.6215929378450533),
        (1.0, (1.5575497886271774, 0.9473107908937359), 0.031305897691032536, -3.2796401351218654),
        (14.907180399932217, (1.198339540278956, 1.198339540278956), 0.023021116363490912, -1.489693199635955),
        (3.5541222939925476, (1.087109076990758, 1.5642065725027505), 0.028924265248359882, -2.7685919401766435),
    ],
)
def test_a_bridge_that_was_lost_is_found(radius, angles, separation, suction):
    pair = pl.Pair((1.0, radius), angles)
    under_suction = pl.bridge(pair, separation, suction=suction, liquid=UNIT)
    assert under_suction.stable
    assert under_suction.suction == pytest.approx(suction, rel=1e-12)
    at_volume = pl.bridge(pair, separation, volume=under_suction.volume, liquid=UNIT)
    assert at_volume.suction == pytest.approx(suction, rel=1e-9)
    end = pl.rupture(pair, suction=suction, liquid=UNIT)
    assert end.separation > separation
    assert pl.bridge(pair, end.separation, suction=suction, liquid=UNIT).exists
    assert not pl.bridge(pair, 1.0001 * end.separation, suction=suction, liquid=UNIT).exists


def lost(seed, count, largest_angle, volumes):
    """Bridges at a volume that are stable under suction, too, and not found there; and how many were asked."""
    rng = np.random.default_rng(seed)
    angles = rng.uniform(0.0, largest_angle, (2, count))
    angles[1] = np.where(rng.random(count) < 0.2, angles[0], angles[1])
    radius = np.where(rng.random(count) < 0.2, 1.0, 10.0 ** rng.uniform(0.0, 3.0, count))
    radius = np.where(rng.random(count) < 0.1, math.inf, radius)
    mean = 2.0 / (1.0 + 1.0 / radius)
    pair = pl.Pair((1.0, radius), (angles[0], angles[1]))
    volume = mean**3 * 10.0 ** rng.uniform(*np.log10(volumes), count)
    end = pl.rupture(pair, volume=volume, liquid=UNIT)
    gap = np.maximum(end.separation, 0.0) * rng.uniform(0.0, 1.0, count)
    held, more = (pl.bridge(pair, gap, volume=part * volume, liquid=UNIT) for part in (1.0, 1.0 + 1e-5))
    fall = (more.suction - held.suction) / (1e-5 * np.abs(held.suction))
    asked = held.exists & more.exists & (gap > 0.0) & (held.suction < 0.0) & (fall < -1e-4)
    answer = pl.bridge(pair, gap, suction=np.where(asked, held.suction, 1.0), liquid=UNIT)
    is_found = answer.exists & (np.abs(answer.volume / held.volume - 1.0) < 1e-3)
    return np.flatnonzero(asked & ~is_found), int(asked.sum())


@pytest.mark.parametrize(("seed", "largest_angle"), [(81, math.pi / 2.0), (82, 0.99 * math.pi)])
def test_bridges_at_a_volume_are_found_under_suction(seed, largest_angle):
    missed, asked = lost(seed, 600, largest_angle, (1e-4, 1.0))
    assert missed.size == 0, f"seed {seed}: {missed}"
    assert asked > 20


@pytest.mark.long
@pytest.mark.parametrize(
    ("seed", "largest_angle", "volumes"),
    [
        (83, math.pi / 2.0, (1e-3, 1.0)),
        (84, 0.99 * math.pi, (1e-3, 1.0)),
        (85, math.pi / 2.0, (1.0, 100.0)),
    ],
)
def test_many_bridges_at_a_volume_are_found_under_suction(seed, largest_angle, volumes):
    missed, asked = lost(seed, 20_000, largest_angle, volumes)
    assert missed.size == 0, f"seed {seed}: {missed}"
    assert asked > 500
