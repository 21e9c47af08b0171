"""Numbers of 7 to 17 digits that were worked out in high precision, table by table, through the public face."""

import json
from pathlib import Path

import numpy as np
import pytest

import pendular as pl

TABLES = json.loads((Path(__file__).parent / "data" / "reference_tables.json").read_text())
UNIT = pl.Liquid(surface_tension=1.0)


def column(table, key):
    return np.array([float(row[key]) for row in TABLES[table]])


def equal_spheres(table):
    return pl.Pair(radius=1.0, contact_angle=np.deg2rad(column(table, "angle")))


def assert_close(measured, expected, tolerance):
    worst = np.max(np.abs(np.asarray(measured) / expected - 1.0))
    assert worst < tolerance, worst


def test_rupture_at_constant_suction():
    name = "suction_fold"
    r = pl.rupture(equal_spheres(name), suction=column(name, "suction"), liquid=UNIT)
    assert_close(r.separation, column(name, "gap"), 4e-15)  # a last digit of the arc is some of D: 3e-15 in lanes
    assert_close(r.volume, column(name, "volume"), 1e-11)  # the fold is flat in D: 5e-12 at H* = 1e12
    assert_close(r.force / (2.0 * np.pi), column(name, "force"), 1e-11)
    assert_close(r.half_filling_angle[:, 0], column(name, "filling_angle"), 1e-11)


def test_contact_at_constant_suction():
    name = "suction_contact"
    b = pl.bridge(equal_spheres(name), 0.0, suction=column(name, "suction"), liquid=UNIT)
    assert_close(b.force / (2.0 * np.pi), column(name, "force"), 5e-14)
    assert_close(b.volume, column(name, "volume"), 5e-13)
    assert_close(b.neck_radius, column(name, "neck_radius"), 5e-14)


@pytest.mark.parametrize("row", TABLES["suction_fold_other_pairs"], ids=lambda row: f"R2={row['radius2']}")
def test_rupture_of_other_pairs(row):
    radius2 = float(row["radius2"] or "inf")
    angles = tuple(np.deg2rad(float(angle)) for angle in row["angles"])
    r = pl.rupture(pl.Pair(radius=(1.0, radius2), contact_angle=angles), suction=float(row["suction"]), liquid=UNIT)
    assert r.separation == pytest.approx(float(row["gap"]), rel=2e-15)
    assert r.volume == pytest.approx(float(row["volume"]), rel=1e-12)
    assert r.force / (2.0 * np.pi) == pytest.approx(float(row["force"]), rel=1e-12)
    assert r.surface_energy == pytest.approx(float(row["energy"]), rel=1e-12)


@pytest.mark.parametrize("row", TABLES["volume_limit"], ids=lambda row: f"V={row['volume']}, {row['angle']}")
def test_limits_at_constant_volume(row):
    pair = pl.Pair(radius=1.0, contact_angle=np.deg2rad(float(row["angle"])))
    limit = "fold" if row["limit"] == "fold" else "stability"
    r = pl.rupture(pair, volume=float(row["volume"]), liquid=UNIT, limit=limit)
    assert r.separation == pytest.approx(float(row["gap"]), rel=5e-15)
    assert r.suction == pytest.approx(float(row["suction"]), rel=1e-12)
    assert r.force / (2.0 * np.pi) == pytest.approx(float(row["force"]), rel=1e-12)


def test_fold_and_pitchfork():
    name = "volume_fold_and_pitchfork_over_cube_root"
    volume, pair = column(name, "volume"), equal_spheres(name)
    for limit, key in (("fold", "fold"), ("stability", "pitchfork")):
        r = pl.rupture(pair, volume=volume, liquid=UNIT, limit=limit)
        assert np.asarray(r.separation) / np.cbrt(volume) == pytest.approx(column(name, key), abs=6e-6)


def test_small_volumes_approach_parallel_plates():
    rows = [row for row in TABLES["plates_fold"] if float(row["angle"]) <= 60]
    volume = 1e-15  # the correction is of the order of the cube root
    for row in rows:
        pair = pl.Pair(radius=1.0, contact_angle=np.deg2rad(float(row["angle"])))
        r = pl.rupture(pair, volume=volume, liquid=UNIT, limit="fold")
        assert r.separation / np.cbrt(volume) == pytest.approx(float(row["fold"]), rel=1e-5)
        if row["pitchfork"] is not None:
            first = pl.rupture(pair, volume=volume, liquid=UNIT, limit="stability")
            assert first.separation / np.cbrt(volume) == pytest.approx(float(row["pitchfork"]), rel=1e-5)


def test_work_of_rupture():
    name = "rupture_work_over_leading_order"
    suction, pair = column(name, "suction"), equal_spheres(name)
    work = (
        np.asarray(pl.rupture(pair, suction=suction, liquid=UNIT).grand_potential)
        - pl.bridge(pair, 0.0, suction=suction, liquid=UNIT).grand_potential
    )
    leading = 2.0 * np.pi * np.cos(pair.contact_angles[0]) ** 2 / suction
    assert work / leading == pytest.approx(column(name, "ratio"), abs=6e-4)


def test_work_at_constant_volume_over_work_at_constant_suction():
    name = "rupture_work_volume_over_suction"
    suction, pair = column(name, "suction"), equal_spheres(name)
    contact = pl.bridge(pair, 0.0, suction=suction, liquid=UNIT)
    drained = pl.rupture(pair, suction=suction, liquid=UNIT).grand_potential - contact.grand_potential
    undrained = pl.rupture(pair, volume=contact.volume, liquid=UNIT).surface_energy - contact.surface_energy
    assert undrained / drained == pytest.approx(column(name, "ratio"), abs=6e-4)


@pytest.mark.parametrize("row", TABLES["even_potential_gap_over_fold_gap"], ids=str)
def test_where_bridge_and_dry_solids_have_one_potential(row):
    from scipy.optimize import brentq

    pair = pl.Pair(radius=1.0, contact_angle=np.deg2rad(float(row["angle"])))
    suction = float(row["suction"])
    top = pl.rupture(pair, suction=suction, liquid=UNIT).separation
    ratio = brentq(lambda d: pl.bridge(pair, d * top, suction=suction, liquid=UNIT).grand_potential, 0.5, 0.9999)
    assert ratio == pytest.approx(float(row["ratio"]), abs=6e-5)


def test_anchors():
    name = "suction_fold_anchors"
    r = pl.rupture(equal_spheres(name), suction=column(name, "suction"), liquid=UNIT)
    assert np.asarray(r.separation) == pytest.approx(column(name, "gap"), abs=6e-8)
    point = TABLES["one_point"]
    b = pl.bridge(pl.Pair(radius=1.0, contact_angle=0.0), 0.1, suction=1.0, liquid=UNIT)
    assert (b.volume, b.force) == pytest.approx((float(point["volume"]), float(point["force_over_tension"])), rel=1e-15)


def test_filling_angle_at_contact():
    for row in TABLES["contact_filling_angles"]:
        radius2, angle = float(row["radius2"] or "inf"), float(row["angle"])
        pair = pl.Pair(radius=(1.0, radius2), contact_angle=np.deg2rad(angle))
        b = pl.bridge(pair, 0.0, suction=float(row["suction"]) / pair.derjaguin_radius, liquid=UNIT)
        beta = np.rad2deg(b.half_filling_angle[0]) + angle
        assert beta == pytest.approx(float(row["filling_plus_contact_angle"]), abs=0.051)
