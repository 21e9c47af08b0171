"""Tables for YADE: the format, YADE's reading of it, the tolerance of what is written, the audit, and the command."""

import contextlib
import io
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from tools import yade_page
from tools.yade_default_grid import default_table

import pendular as pl
from pendular.codes import yade
from pendular.codes.yade import reader
from pendular.codes.yade.files import POINT_COLUMNS, parse_table

THETA = math.radians(20)
COARSE = {"tolerance": 0.02, "reduced_suction": 100.0}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A coarse set of tables, with a suffix."""
    path = tmp_path_factory.mktemp("tables")
    yade.export(path, THETA, suffix="_th20", **COARSE)
    return path


def small_table(ratio=1.0, gaps=(0.0, 0.1, 0.3), suctions=((0, 1, 4), (0, 1, 2), (0, 0.5)), seed=1):
    """Table of random numbers."""
    random = np.random.default_rng(seed)
    blocks = [
        np.column_stack([np.full(len(u), gap), u, random.uniform(1.0, 2.0, (len(u), 6))])
        for gap, u in zip(gaps, suctions, strict=True)
    ]
    return yade.Table(ratio, tuple(blocks))


# The file ----------------------------------------------------------------------------------------------------------


def test_names_of_the_ten_files_are_those_that_yade_opens():
    names = "M(r=1) M(r=1.1) M(r=1.25) M(r=1.5) M(r=1.75) M(r=2) M(r=3) M(r=4) M(r=5) M(r=10)"
    assert [yade.table_name(ratio) for ratio in yade.RATIOS] == names.split()


def test_a_table_survives_its_file(tmp_path):
    table = yade.make_table(3.0, THETA, **COARSE)
    path = tmp_path / yade.table_name(3.0)
    assert yade.write_table(path, table) == path.stat().st_size
    again = yade.read_table(path)
    assert again.ratio == 3.0
    assert [len(block) for block in again.blocks] == [len(block) for block in table.blocks]
    np.testing.assert_allclose(np.concatenate(again.blocks), np.concatenate(table.blocks), rtol=5e-8)


def test_a_file_has_the_layout_that_yade_reads(tmp_path):
    table = small_table(ratio=1.25)
    yade.write_table(tmp_path / "M", table)
    lines = (tmp_path / "M").read_text().splitlines()
    assert lines[:3] == ["1.25", "3", "\t".join("30000000")]
    assert [float(word) for word in lines[4].split("\t")] == pytest.approx(table.blocks[0][1], rel=1e-7)
    assert lines[6].split("\t")[0] == "3"
    assert len(lines) == 2 + (1 + 3) + (1 + 3) + (1 + 2)


def test_points_survive_their_file_and_do_not_end_in_a_newline(tmp_path):
    points = yade.make_points(THETA, reduced_suction=1.0)
    size = yade.write_points(tmp_path / "capillaryfile.txt", points)
    text = (tmp_path / "capillaryfile.txt").read_text()
    assert (len(text), text[-1] != "\n") == (size, True)
    np.testing.assert_allclose(yade.read_points(tmp_path / "capillaryfile.txt"), points, rtol=5e-8)


def test_points_of_another_width_are_refused(tmp_path):
    (tmp_path / "points.txt").write_text("1 2 3 4 5 6 7 8 9 0\n1 2 3\n")
    with pytest.raises(ValueError, match=r"points.txt: row 2 is not made of 10 numbers"):
        yade.read_points(tmp_path / "points.txt")


def lines_of(table):
    """Lines of the file of a table, to be spoilt."""
    lines = [f"{table.ratio:g}", str(len(table.blocks))]
    for block in table.blocks:
        lines += [f"{len(block)} 0 0 0 0 0 0 0", *(" ".join(map(str, row)) for row in block)]
    return lines


def replaced(index, line):
    return lambda lines: [*lines[:index], line, *lines[index + 1 :]]


FAULTS = {
    "six columns": (lambda lines: [*lines[:3], *(" ".join(line.split()[:6]) for line in lines[3:])], "six columns"),
    "no row": (replaced(2, "0 0 0 0 0 0 0 0"), "line 3: a block of '0 0 0 0 0 0 0 0' rows, at which YADE crashes"),
    "a word": (replaced(4, "0 one 2 3 4 5 6 7"), "line 5: '0 one 2 3 4 5 6 7' is not a row of 8 numbers"),
    "not a number": (replaced(4, "0 nan 2 3 4 5 6 7"), "line 5: '0 nan 2 3 4 5 6 7' is not a row of 8 numbers"),
    "no header": (replaced(0, "r = 1"), "the first two lines are not the ratio and the number of blocks"),
    "a torn end": (lambda lines: lines[:-1], "line 13: the file ends 1 rows before its block"),
    "too few blocks": (replaced(1, "2"), "2 blocks are announced and 3 more lines follow, which YADE ignores"),
    "too many blocks": (replaced(1, "4"), "4 blocks are announced, 3 found"),
    "first gap": (replaced(5, "0.01 4 2 1 1 1 1 1"), "the first block is at D* = 0.01, not 0: YADE crashes below it"),
    "a gap in a block": (replaced(4, "0.01 1 2 1 1 1 1 1"), "block 1: D* differs within the block; YADE takes 0"),
    "a descending gap": (replaced(9, "0 2 2 1 1 1 1 1"), "block 2: D* = 0 does not ascend from 0"),
    "no row without suction": (replaced(3, "0 0.5 2 1 1 1 1 1"), "block 1: the first row is at u* = 0.5, not 0"),
    "descending suctions": (replaced(4, "0 9 2 1 1 1 1 1"), "block 1: u* does not ascend: YADE takes wrong rows"),
    "a single row": (
        lambda lines: [*lines[:10], "1 0 0 0 0 0 0 0", lines[11]],
        "block 3: a single row, in which YADE finds nothing",
    ),
    "a ratio below 1": (replaced(0, "0.5"), "the ratio 0.5 in the first line is below 1"),
}


def test_a_good_file_has_no_fault():
    assert parse_table("\n".join(lines_of(small_table()))).faults == ()


@pytest.mark.parametrize("name", FAULTS)
def test_faults_are_named(name, tmp_path):
    spoil, said = FAULTS[name]
    path = tmp_path / "M(r=1)"
    path.write_text("\n".join(spoil(lines_of(small_table()))))
    assert said in " | ".join(parse_table(path.read_text()).faults)
    with pytest.raises(ValueError, match=r"^M\(r=1\): "):
        yade.read_table(path)


# YADE's reading ----------------------------------------------------------------------------------------------------


ZEROS = [0.0] * 8


def mixed(weight, low, high):
    return [a * (1 - weight) + weight * b for a, b in zip(low, high, strict=True)]


def rows_as_yade(rows, suction):
    for k in range(1, len(rows)):
        if rows[k][1] > suction:
            share = (suction - rows[k - 1][1]) / (rows[k][1] - rows[k - 1][1])
            return [a + share * (b - a) for a, b in zip(rows[k - 1], rows[k], strict=True)]
        if rows[k][1] == suction:
            return rows[k]
    return ZEROS


def table_as_yade(table, gap, suction):
    """One bridge of one table; None is a crash."""
    gaps = [block[-1][0] for block in table.blocks]
    for i, place in enumerate(gaps):
        if place > gap:
            if i == 0:
                return None
            low, high = (rows_as_yade(table.blocks[k].tolist(), suction) for k in (i - 1, i))
            return mixed((gap - gaps[i - 1]) / (place - gaps[i - 1]), low, high)
        if place == gap:
            return rows_as_yade(table.blocks[i].tolist(), suction)
    return ZEROS


def as_yade(tables, ratio, gap, suction):
    """One bridge, step by step as YADE finds it: an independent rendering of its three loops; None is a crash."""
    for i, table in enumerate(tables):
        if table.ratio > ratio:
            low, high = (table_as_yade(tables[k], gap, suction) for k in (i - 1, i))
            weight = (ratio - tables[i - 1].ratio) / (table.ratio - tables[i - 1].ratio)
            return None if low is None or high is None else mixed(weight, low, high)
        if table.ratio == ratio:
            return table_as_yade(table, gap, suction)
    return ZEROS


def assert_reads_alike(tables, ratios, gaps, suctions):
    asked = np.array([(r, d, u) for r in ratios for d in gaps for u in suctions], float)
    expected = [as_yade(tables, *row) for row in asked]
    expected = np.array([[np.nan] * 8 if row is None else row for row in expected])
    np.testing.assert_allclose(reader.interpolate(tables, *asked.T), expected, rtol=1e-13, atol=1e-13)


def test_interpolation_is_that_of_yade():
    tables = [
        small_table(),
        small_table(2.0, (0.0, 0.05, 0.2), seed=2),
        small_table(5.0, (0.0, 0.02), ((0, 1, 3), (0, 2)), 3),
    ]
    gaps = [0.0, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.31]
    assert_reads_alike(tables, [1.0, 1.3, 2.0, 4.0, 5.0, 5.1], gaps, [0.0, 0.3, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 4.1])


def test_interpolation_is_that_of_yade_in_disorder():
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    for _ in range(30):
        counts = random.integers(1, 5, random.integers(2, 6))
        gaps, suctions = random.uniform(0.0, 1.0, len(counts)), [random.uniform(-0.2, 2.0, n) for n in counts]
        table = small_table(1.0, gaps, suctions, int(random.integers(1 << 30)))
        highest = np.maximum.accumulate(gaps)
        inside = random.uniform(highest[0], highest[-1] + 0.1, 20)  # a crash below the first block is tested apart
        assert_reads_alike([table], [1.0], inside, random.uniform(0.0, 2.0, 20))


def test_numbers_worked_out_by_hand():
    rows = np.array([[0.0, 0, 4, 1, 30, 20, 1, 1], [0.0, 2, 2, 3, 20, 10, 1, 1]])
    table = yade.Table(1.0, (rows, rows + np.eye(8)[0] * 0.2))
    short = yade.Table(1.0, (rows, np.array([[0.2, 0, 4, 1, 30, 20, 1, 1], [0.2, 0.5, 2, 3, 20, 10, 1, 1]])))
    at = [np.array([value]) for value in (1.0, 0.05, 1.0)]
    assert reader.interpolate([table], *at)[0].tolist() == pytest.approx([0.05, 1, 3, 2, 25, 15, 1, 1])
    # A block that ends earlier counts as zeros: three quarters of the nearer one are left.
    assert reader.interpolate([short], *at)[0, 2:4].tolist() == pytest.approx([0.75 * 3, 0.75 * 2])
    assert reader.table_rupture(short, np.array([0.4, 1.0, 2.1])).tolist() == [0.2, 0.2, 0.0]


def test_below_the_first_block_yade_crashes():
    table = small_table(gaps=(0.05, 0.1, 0.3))
    assert np.isnan(reader.interpolate_table(table, np.array([0.04]), np.array([1.0]))).all()


def test_rupture_is_the_end_of_the_last_cell_with_a_row():
    table = small_table(gaps=(0.0, 0.1, 0.2, 0.3, 0.4), suctions=((0, 9), (0, 5), (0, 3), (0, 2), (0, 1)))
    found = reader.table_rupture(table, np.array([0.5, 1.5, 2.5, 4.0, 6.0, 10.0]))
    assert found.tolist() == [0.4, 0.4, 0.3, 0.2, 0.1, 0.0]
    edge = found[3] + np.array([-1e-9, 1e-9])
    volumes = reader.interpolate_table(table, edge, np.full(2, 4.0))[:, 2]
    assert volumes[0] > 0.0 == volumes[1]


def test_the_law_has_the_units_and_the_habits_of_yade():
    table = yade.make_table(2.0, THETA, **COARSE)
    gamma, small, large = 0.073, 1e-4, 2e-4
    ask = {"suction": 2e3, "surface_tension": gamma}
    found = yade.yade_bridge([table], large, small, [-1e-6, 0.0, 2e-6], **ask)
    exact = pl.bridge(pl.Pair((small, large), THETA), [0.0, 0.0, 2e-6], suction=2e3, liquid=pl.Liquid(gamma))
    np.testing.assert_allclose(found.force, exact.force, rtol=0.02)
    np.testing.assert_allclose(found.volume, exact.volume, rtol=0.1)
    np.testing.assert_allclose(found.nn11, exact.capillary_tensor[:, 0], rtol=0.1)
    assert np.all(found.delta1 > found.delta2)
    assert yade.yade_bridge([table], small, large, 0.0, suction=0.0, surface_tension=gamma).force == 0.0
    assert yade.yade_bridge([table], small, large, 0.0, suction=-5.0, surface_tension=gamma).force == 0.0
    assert yade.yade_bridge([table], small, 2.1 * small, 0.0, **ask).force == 0.0
    with pytest.raises(ValueError, match=r"radius1: -1.0 m is not > 0"):
        yade.yade_bridge([table], -1.0, large, 0.0, **ask)


# What is written ---------------------------------------------------------------------------------------------------


def test_rows_are_the_bridges_of_an_independent_solver():
    """Of tests/data/oracle_bridges.json, solved with 30 digits."""
    rows = json.loads((Path(__file__).parent / "data" / "oracle_bridges.json").read_text())
    checked = 0
    for row in rows:
        is_table_row = row["control"] == "suction" and row["branch"] == "stable" and row["theta1"] == row["theta2"]
        if not is_table_row or row["R2"] is None or float(row["H"]) < 0.0 or float(row["gap"]) < 0.0:
            continue
        n = {name: float(row[name]) for name in ("R1", "R2", "theta1", "H", "gap", "V", "lam", "n11", "n33")}
        size = max(n["R1"], n["R2"])
        found = yade.exact_rows(size / min(n["R1"], n["R2"]), n["theta1"], n["gap"] / size, n["H"] * size)
        angles = sorted((math.degrees(float(row["delta1"])), math.degrees(float(row["delta2"]))), reverse=True)
        expected = [n["gap"] / size, n["H"] * size, n["V"] / size**3, n["lam"] / size, *angles]
        np.testing.assert_allclose(found, [*expected, n["n11"] / size**2, n["n33"] / size**2], rtol=1e-9, atol=1e-15)
        checked += 1
    assert checked > 50


def test_published_rupture_distances_without_suction():
    quoted = {1.0: 0.3995, 1.1: 0.3808, 1.25: 0.3567, 1.5: 0.3241, 1.75: 0.2983}
    quoted |= {2.0: 0.2772, 3.0: 0.2199, 4.0: 0.1852, 5.0: 0.1615}  # of YADE's own generator, to its step
    for ratio, gap in quoted.items():
        assert float(yade.exact_rupture(ratio, 0.0, 0.0)) == pytest.approx(gap, rel=2e-3)


CASES = [
    (1.0, 0.0, 1e-3, 1e4),
    (10.0, 20.0, 1e-3, 1e4),
    (3.0, 60.0, 1e-2, 1e6),
    (1.5, 85.0, 1e-3, 1e3),
    (2.0, 40.0, 2e-4, 30.0),
]


@pytest.mark.parametrize(("ratio", "degrees", "tolerance", "reach"), CASES)
def test_the_tolerance_is_kept_where_nothing_was_built(ratio, degrees, tolerance, reach):
    seed = int(np.random.SeedSequence().generate_state(1)[0])
    print(f"seed {seed}")
    random = np.random.default_rng(seed)
    theta = math.radians(degrees)
    table = yade.make_table(ratio, theta, tolerance=tolerance, reduced_suction=reach)
    suctions = np.append(random.uniform(0.0, 1.0, 1000), 10.0 ** random.uniform(-1.0, math.log10(reach), 9000))
    ruptures = yade.exact_rupture(ratio, theta, suctions)
    gaps = ruptures * np.minimum(random.uniform(0.0, 1.0, suctions.size), 0.98)
    exact, contact = (yade.exact_rows(ratio, theta, gap, suctions) for gap in (gaps, 0.0))
    found = reader.interpolate_table(table, gaps, suctions)
    assert np.max(np.abs(found[:, 3] - exact[:, 3]) / contact[:, 3]) < tolerance
    assert np.max(np.abs(found[:, 2] - exact[:, 2]) / contact[:, 2]) < 10.0 * tolerance
    assert np.max(np.abs(reader.table_rupture(table, suctions) / ruptures - 1.0)) < 0.01
    assert not parse_table("\n".join(lines_of(table))).faults


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"contact_angle": 1.6}, r"contact_angle: 1.6 is not in \[0, 1.570796327\)"),
        ({"contact_angle": 20.0}, r"contact_angle: 20.0 rad is not in \[0, pi\); for degrees use numpy.deg2rad"),
        ({"tolerance": 1e-6}, r"tolerance: 1e-06 is not in \[0.0001, 0.1\]"),
        ({"reduced_suction": 0.1}, r"reduced_suction: 0.1 is not in \[1, 100000000\]"),
        ({"ratio": 0.5}, r"ratio: 0.5 is not >= 1"),
    ],
)
def test_bad_input_is_refused(given, said):
    with pytest.raises(ValueError, match=said):
        yade.make_table(**({"ratio": 1.0, "contact_angle": 0.3} | given))


def test_points_are_bridges_to_the_fold_and_contact_below():
    points = dict(zip(POINT_COLUMNS, yade.make_points(THETA, reduced_suction=10.0).T, strict=True))
    apart = points["D*"] >= 0.0
    exact = yade.exact_rows(1.0 / points["R"], THETA, np.maximum(points["D*"], 0.0), points["u*"])
    np.testing.assert_allclose(points["F+"], 2.0 * np.pi * exact[:, 3], rtol=1e-12)
    np.testing.assert_allclose(points["V*"], exact[:, 2], rtol=1e-12)
    cosines = np.cos(np.deg2rad(exact[:, 4:6]))
    wetted = 2.0 * np.pi * (points["R"] ** 2 * (1.0 - cosines[:, 0]) + 1.0 - cosines[:, 1])
    spheres = 4.0 * np.pi * (1.0 + points["R"] ** 2)
    liquid_gas = 2.0 * exact[:, 6] + exact[:, 7]
    np.testing.assert_allclose(points["S*"], liquid_gas + spheres - wetted, rtol=1e-12)
    is_fold = np.isclose(points["D*"], yade.exact_rupture(1.0 / points["R"], THETA, points["u*"]), rtol=1e-9)
    assert np.array_equal(points["ending"] == 1.0, is_fold)
    assert np.all(points["D*"][~apart] == -0.1 * points["R"][~apart])
    assert (points["R"].min() < 0.1, points["R"].max()) == (True, 1.0)


# The audit ---------------------------------------------------------------------------------------------------------


def test_the_audit_finds_what_was_measured_in_yade_with_its_default_grid():
    """Rupture 3.9 % late at u* = 100, 87 % at 300 and 189 % at 1000, read out of YADE 2023.02a with such a table."""
    table = default_table(1.0, 1493.0)
    suctions = np.array([100.0, 300.0, 1000.0])
    late = reader.table_rupture(table, suctions) / yade.exact_rupture(1.0, 0.0, suctions) - 1.0
    assert late == pytest.approx([0.039, 0.87, 1.89], abs=0.01)
    text = {"M(r=1)": "\n".join(lines_of(table))}
    (file,) = yade.audit(text).files
    assert (file.faults, file.strays) == ((), 0)
    assert file.at_rows.force < 1e-3  # five digits, next to the fold
    assert file.in_yade.force > 0.2
    assert file.rupture.high > 1.8
    assert not yade.audit(text).is_within(0.1)


@pytest.mark.parametrize("degrees", [0.0, 20.0, 45.0, 80.0])
def test_the_contact_angle_is_in_the_rows(degrees):
    table = yade.make_table(1.75, math.radians(degrees), **COARSE)
    assert math.degrees(yade.contact_angle_of(table)) == pytest.approx(degrees, abs=1e-9)


def test_errors_of_the_rows_are_those_that_were_put_in():
    table = yade.make_table(1.0, THETA, **COARSE)
    spoilt = [block.copy() for block in table.blocks]
    contact = yade.exact_rows(1.0, THETA, 0.0, spoilt[3][2, 1])
    spoilt[3][2] += [0, 0, 0.03 * contact[2], 0.02 * contact[3], 0.5, 0, 0, 0]
    (file,) = yade.audit({"M(r=1)": "\n".join(lines_of(yade.Table(1.0, tuple(spoilt))))}, THETA).files
    assert file.at_rows[:4] == pytest.approx((0.03, 0.02, 0.5, 0.0), rel=1e-4, abs=1e-6)
    spoilt[3][2:, 1] *= 10.0  # beyond the fold
    (file,) = yade.audit({"M(r=1)": "\n".join(lines_of(yade.Table(1.0, tuple(spoilt))))}, THETA).files
    assert file.strays > 0


def test_a_contact_angle_that_the_rows_do_not_have_is_asked_for():
    text = {"M(r=1)": "\n".join(lines_of(small_table()))}
    with pytest.raises(ValueError, match=r"^contact-angle: missing; the rows at contact speak of "):
        yade.audit(text)


def test_tables_of_six_columns_are_refused():
    texts = {"M(r=1)": None, "M(r=1.1)": "1.1\n1\n2\n0 0 1 1 1 1\n0 1 1 1 1 1\n"}
    with pytest.raises(ValueError, match=r"^check: no table can be read: M\(r=1.1\): line 4: six columns, the format"):
        yade.audit(texts)


def test_files_in_wrong_order_are_named(folder):
    texts = yade.folder_texts(folder, "_th20")
    names = list(texts)
    texts[names[0]], texts[names[4]] = texts[names[4]], texts[names[0]]
    found = yade.audit(texts, THETA)
    assert found.files[0].faults == ("the first ratio is 1.75, not 1: YADE crashes below it",)
    assert found.files[1].faults == ("the ratio 1.1 does not ascend: YADE takes wrong files",)
    assert found.between == ()


def test_between_the_ratios_the_error_is_larger(folder):
    found = yade.audit(yade.folder_texts(folder, "_th20"))
    assert [mixed.ratio for mixed in found.between] == pytest.approx(
        [math.sqrt(a * b) for a, b in zip(yade.RATIOS, yade.RATIOS[1:], strict=False)]
    )
    late = dict(zip(yade.RATIOS, found.between, strict=False))
    assert late[5.0].rupture.high > 0.2
    assert late[2.0].inner.force < late[2.0].in_yade.force


# The command -------------------------------------------------------------------------------------------------------


def test_the_command_writes_a_set_and_finds_it_in_order(run, tmp_path):
    out, picture = tmp_path / "new" / "tables", tmp_path / "error.png"
    status, output, errors = run(
        "export", "yade", "--contact-angle", 20, "--out", out, "--suffix", "_th20", "--tolerance", 0.02,
        "--reduced-suction", 100, "--plot", picture,
    )  # fmt: skip
    assert (status, errors) == (0, "")
    names = {f"M(r={ratio:g})_th20" for ratio in yade.RATIOS} | {"capillaryfile_th20.txt", "bridges_th20.txt"}
    assert {path.name for path in out.iterdir()} == names
    assert "all ten tables in order: force within 2 % of contact, rupture within 1 %" in output
    assert "contact angle       20 degrees" in (out / "bridges_th20.txt").read_text()
    assert picture.read_bytes().startswith(b"\x89PNG")
    status, output, errors = run("export", "yade", "--check", out, "--suffix", "_th20", "--tolerance", 0.02)
    assert (status, errors) == (0, "")
    assert "contact angle 20°, as the rows at contact have it" in output


def test_a_check_tells_what_is_wrong_by_its_status(run, folder, tmp_path):
    for name, text in yade.folder_texts(folder, "_th20").items():
        (tmp_path / name).write_text(text)
    (tmp_path / "M(r=3)_th20").unlink()
    (tmp_path / "M(r=5)_th20").write_text("5\n1\n2\n0 0 1 1 1 1\n0 1 1 1 1 1\n")
    status, output, _ = run("export", "yade", "--check", tmp_path, "--suffix", "_th20", "--tolerance", 0.02)
    assert status == 1
    assert "M(r=3)_th20: missing: YADE goes on without any force" in output
    assert "M(r=5)_th20: line 4: six columns" in output
    assert "NOT in order: 2 of 10 files have faults" in output
    assert "between the ten ratios" not in output


def test_a_check_against_another_contact_angle_fails(run, folder):
    status, output, _ = run(
        "export", "yade", "--check", folder, "--suffix", "_th20", "--contact-angle", 30, "--tolerance", 0.02
    )
    assert status == 1
    assert "NOT within: force within 2 % of contact" in output


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--contact-angle", "20"], "out: give a folder to write to, or one to check"),
        (["--out", "x"], "contact-angle: missing; write it like 20"),
        (["--out", "x", "--contact-angle", "95"], "contact-angle: 95 deg is not in [0, 90)"),
        (["--check", "nowhere"], "check: no file like 'M(r=1)' in 'nowhere'"),
        (["--check", "x", "--reduced-suction", "10"], "reduced-suction: has no effect beside check"),
        (["--out", "x", "--contact-angle", "20", "--plot", "error.gif"], "plot: 'error.gif' does not end in one of"),
        (["--out", "x", "--contact-angle", "20", "--tolerance", "0"], "tolerance: 0.0 is not in [0.0001, 0.1]"),
    ],
)
def test_bad_options_are_one_line(run, arguments, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    status, output, errors = run("export", "yade", *arguments)
    assert (status, output, errors.count("\n")) == (2, "", 1)
    assert errors.startswith(f"pendular: {said}")


# The page ----------------------------------------------------------------------------------------------------------


@pytest.mark.long
def test_the_page_shows_what_the_commands_print_and_its_code_runs(tmp_path, monkeypatch):
    page = yade_page.PAGE.read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert yade_page.printed(yade_page.EXPORT) in page
    (code,) = re.findall(r"^```python\n(import math.*?)^```", page, re.MULTILINE | re.DOTALL)
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(code, {})
    first, second = printed.getvalue().splitlines()
    exact = pl.bridge(pl.Pair((50e-6, 100e-6), THETA), 5e-6, suction=5e3, liquid=pl.Liquid(0.0728)).force
    assert (first, float(second.split()[0])) == ("True", pytest.approx(exact, rel=0.01))
