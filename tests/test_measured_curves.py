"""Fits of curves that others measured and published: they are not ours to give away, so a variable names the file.

``PENDULAR_MEASURED_CURVES`` is a table of digitised curves with the columns source, R1_mm, R2_mm, gamma_mN_per_m,
theta1_deg, theta2_deg, V_uL, D_mm, F_mN; of a source named in µm, µN and µm³ the numbers are in these.
"""

import csv
import os
from itertools import groupby
from pathlib import Path

import numpy as np
import pytest

import pendular as pl

FILE = os.environ.get("PENDULAR_MEASURED_CURVES", "")
pytestmark = pytest.mark.skipif(
    not Path(FILE).is_file(), reason="PENDULAR_MEASURED_CURVES names no file of published curves"
)
HEAD = ("source", "R1_mm", "R2_mm", "gamma_mN_per_m", "theta1_deg", "theta2_deg", "V_uL")


def curves():
    """Pair, volume, liquid, separations and forces of each curve, under its source and volume."""
    if not Path(FILE).is_file():
        return {}
    with open(FILE, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found = {}
    for head, several in groupby(rows, key=lambda row: tuple(row[name] for name in HEAD)):
        source, volume = head[0], float(head[6])
        length, cube, newton = (1e-6, 1e-18, 1e-6) if "um,uN" in source else (1e-3, 1e-9, 1e-3)
        points = np.array([(float(row["D_mm"]), float(row["F_mN"])) for row in several])
        pair = pl.Pair(
            (float(head[1]) * length, float(head[2]) * length), tuple(np.radians([float(head[4]), float(head[5])]))
        )
        liquid = pl.Liquid(1e-3 * float(head[3]))
        found[f"{source} {volume}"] = (pair, volume * cube, liquid, points[:, 0] * length, points[:, 1] * newton)
    return found


CURVES = curves()


def before_rupture(name):
    """A curve without the points that lie beyond the rupture of the bridge that was told."""
    pair, volume, liquid, gap, force = CURVES[name]
    inside = gap < float(pl.rupture(pair, volume=volume, liquid=liquid).separation)
    return pair, volume, liquid, gap[inside], force[inside]


SILICONE = [name for name in CURVES if name.startswith("Willett2000")]


@pytest.mark.parametrize("name", SILICONE)
def test_a_perfectly_wetting_oil_is_found_to_wet(name):
    pair, volume, liquid, gap, force = CURVES[name]
    guess = pl.Pair(pair.radius, 0.3)
    found = pl.fit(gap, force, guess, volume=1.5 * volume, liquid=liquid)
    told = {key: (found.values[key], found.errors[key]) for key in found.values}
    print(f"{name}: {told}, rms {found.rms / force.max():.4f} of the largest force")
    assert found.values["volume"] == pytest.approx(volume, rel=0.06)
    assert np.degrees(found.values["contact_angle"]) < 12.0
    assert 0.0 <= found.values["offset"] < 5e-6  # rough spheres touch before they are in contact
    assert found.rms < 0.009 * force.max()
    assert found.rupture_separation > gap[-1]


@pytest.mark.parametrize("name", SILICONE)
def test_the_pull_kept_the_volume(name):
    pair, volume, liquid, gap, force = CURVES[name]
    found = pl.fit_controls(gap, force, pair, volume=volume, liquid=liquid, free=("volume", "offset"))
    print(f"{name}: {found.told}")
    assert found.better == "volume"


@pytest.mark.parametrize("name", [name for name in CURVES if name not in SILICONE])
def test_a_fit_is_nearer_than_the_numbers_told(name):
    pair, volume, liquid, gap, force = before_rupture(name)
    nominal = pl.bridge(pair, gap, volume=volume, liquid=liquid).force - force
    found = pl.fit(gap, force, pl.Pair(pair.radius, 0.3), volume=volume, liquid=liquid)
    before, after = float(np.sqrt(np.mean(nominal**2))), found.rms
    print(f"{name}: rms {before / force.max():.4f} as told, {after / force.max():.4f} fitted: {found.values}")
    assert after < 0.7 * before


GUIDE = Path(__file__).parents[1] / "docs" / "howto" / "fit.md"
SHOWN = {  # words of the guide
    "Willett2000 R=1:1 0.0136": ("Willett 2000, spheres of 2.381 mm, oil", "0°, 13.6 nL"),
    "Willett2000 R=1:1 0.0313": ("the same", "0°, 31.3 nL"),
    "Willett2000 R=1:1 0.0742": ("the same", "0°, 74.2 nL"),
    "Willett2000 sphere-flat 0.1624": ("Willett 2000, the sphere on a plate", "0°, 162.4 nL"),
    "Lambert2008 case1 0.065": ("Lambert 2008, spheres of 2 and 3.95 mm", "0° and 14.3°, 65 nL"),
    "Lambert2008 case2 1.4": ("the same", "0° and 14.3°, 1.4 µL"),
    "Rabinovich2005(um,uN,um3) 0.2": ("Rabinovich 2005, spheres of 19 and 35 µm", "10°, 0.2 µm³"),
    "Rabinovich2005(um,uN,um3) 1.2": ("Rabinovich 2005, spheres of 19 and 32.5 µm", "10°, 1.2 µm³"),
    "Rabinovich2005(um,uN,um3) 3.6": ("Rabinovich 2005, spheres of 19 and 27.5 µm", "10°, 3.6 µm³"),
}


@pytest.mark.parametrize("name", list(SHOWN))
def test_the_guide_shows_what_is_found(name):
    pair, volume, liquid, gap, force = before_rupture(name)
    found = pl.fit(gap, force, pl.Pair(pair.radius, 0.3), volume=volume, liquid=liquid)
    angle, error = (np.rad2deg(of["contact_angle"]) for of in (found.values, found.errors))
    cells = (
        *SHOWN[name],
        f"< {np.rad2deg(found.upper['contact_angle']):.0f}°" if found.upper else f"{angle:.0f} ± {error:.0f}°",
        f"{found.values['volume'] / volume:.2f} ± {found.errors['volume'] / volume:.2f}",
        f"{1e6 * found.values['offset']:.2g} ± {1e6 * found.errors['offset']:.2g}",
        f"{100.0 * found.rms / force.max():.1f} %",
    )
    line = f"| {' | '.join(cells)} |"
    assert line in GUIDE.read_text(encoding="utf-8"), line
