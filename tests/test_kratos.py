"""The example for Kratos, in Kratos: what moves its grains is the exact bridge, up to rupture."""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pendular as pl

EXAMPLE = Path(__file__).parents[1] / "examples" / "other_codes" / "kratos_pull.py"


@pytest.mark.long
def test_two_grains_in_kratos_have_the_exact_bridge(tmp_path):
    """Each step changes the speeds by the force at its begin: that of an exact bridge, and none after it broke."""
    done = subprocess.run(
        [sys.executable, EXAMPLE],
        cwd=tmp_path,
        env=os.environ | {"OMP_NUM_THREADS": "1"},
        check=False,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout[-1000:] + done.stderr[-1000:]
    gap, *speeds = np.loadtxt(tmp_path / "pull.csv", delimiter=",").T
    grains, held = pl.Pair((50e-6, 80e-6), math.radians(20)), {"suction": 5e3, "liquid": pl.Liquid(0.0728)}
    end = float(pl.rupture(grains, **held).separation)
    apart = gap[:-1] > 0.0
    force = np.where(gap[:-1] < end, pl.bridge(grains, np.clip(gap[:-1], 0.0, 0.99 * end), **held).force, 0.0)
    clear = apart & (np.abs(gap[:-1] / end - 1.0) > 0.02)
    for radius, speed, sign in zip((50e-6, 80e-6), speeds, (1.0, -1.0), strict=True):
        mass = 2500.0 * 4.0 / 3.0 * math.pi * radius**3
        found = sign * mass * np.diff(speed) / 1e-7
        np.testing.assert_allclose(found[clear], force[clear], rtol=0.0, atol=1e-6 * force.max())
    assert np.count_nonzero(clear & (force > 0.0)) > 50
    assert np.count_nonzero(clear & (force == 0.0)) > 50
