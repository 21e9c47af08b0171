"""Measured curves from files: tables as people and instruments write them, and force curves of microscopes."""

import numpy as np
import pytest

import pendular as pl

GAP, FORCE = np.array([0.0, 0.5e-6, 1e-6]), np.array([12e-9, 9.5e-9, 8e-9])
TABLES = {
    "csv": "separation (µm),force (nN)\n0,12\n0.5,9.5\n1.0,8\n",
    "square brackets": "distance [um]\tF [nN]\n0\t12\n0.5\t9.5\n1.0\t8\n",
    "strokes and spaces": "# a pull\ngap / um   F / nN\n0 12\n0.5 9.5\n1.0 8\n",
    "units in names": "d_nm,force_pN\n0,12e3\n500,9500\n1e3,8000\n",
    "decimal commas": "Gap (µm);Load (nN)\n0,0;12,0\n0,5;9,5\n1,0;8,0\n",
    "decimal commas between tabs": "gap (um)\tforce (nN)\n0,0\t12,0\n0,5\t9,5\n1,0\t8,0\n",
    "comments and a tail": "# sample 3\n# 20 C\nforce (nN),gap (um)\n12,0\n9.5,0.5\n# paused\n8,1.0\n\n",
    "by their units": "stage (um),signal (nN),note (1)\n0,12,1\n0.5,9.5,1\n1,8,1\n",
    "a byte order mark": "\ufeffgap (m),force (N)\n0,12e-9\n5e-7,9.5e-9\n1e-6,8e-9\n",
}


def written(folder, text, name="curve.csv"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("kind", TABLES)
def test_tables_are_read_in_si_units(kind, tmp_path):
    curve = pl.read_curve(written(tmp_path, TABLES[kind]))
    assert curve.separation == pytest.approx(GAP, abs=1e-18)
    assert curve.force == pytest.approx(FORCE)


def test_errors_and_times_are_read_beside(tmp_path):
    text = "t (ms),gap (um),force (nN),error (pN)\n0,0,12,100\n10,0.5,9.5,100\n20,1,8,200\n"
    curve = pl.read_curve(written(tmp_path, text))
    assert curve.time == pytest.approx([0.0, 0.01, 0.02])
    assert curve.force_error == pytest.approx([1e-10, 1e-10, 2e-10])


def test_columns_and_units_can_be_told(tmp_path):
    bare = written(tmp_path, "0 3 12\n0.5 3 9.5\n1 3 8\n", "bare.txt")
    curve = pl.read_curve(bare, columns=("1", "3"), units=("um", "nN"))
    assert curve.separation == pytest.approx(GAP, abs=1e-18)
    assert curve.force == pytest.approx(FORCE)
    exported = "Height_nm_Ex,Height_nm_Rt,Defl_nN_Ex,Defl_nN_Rt\n0,0,1,-12\n1,500,1,-9.5\n2,1000,1,-8\n"
    curve = pl.read_curve(written(tmp_path, exported), columns=("Height_Rt", "Defl_Rt"), attraction="negative")
    assert curve.separation == pytest.approx(GAP, abs=1e-18)
    assert curve.force == pytest.approx(FORCE)


BAD = {
    "units: column 'force' of": ("gap (um),force\n0,1\n1,2\n", {}),
    "units: 'um' of column 'force' is not a unit of force": ("gap (um),force (um)\n0,1\n1,2\n", {}),
    "columns: which of": ("a (um),b (um),c (nN)\n0,1,2\n1,2,3\n", {}),
    "columns: 'z' is none of": ("gap (um),force (nN)\n0,1\n1,2\n", {"columns": ("z", "force")}),
    "columns: 'gap' is not a pair": ("gap (um),force (nN)\n0,1\n1,2\n", {"columns": "gap"}),
    "path: .* holds no row of numbers": ("gap (um),force (nN)\n", {}),
    "path: .* has no 2 numbers in its row 3, '1,'": ("gap (um),force (nN)\n0,1\n1,\n", {}),
    "path: .* has no number in row 2 of force": ("gap (um),force (nN)\n0,1\n1,nan\n", {}),
    "attraction: 'up' is not one of": ("gap (um),force (nN)\n0,1\n1,2\n", {"attraction": "up"}),
}


@pytest.mark.parametrize("message", BAD)
def test_what_cannot_be_read_is_refused_in_one_line(message, tmp_path):
    text, options = BAD[message]
    with pytest.raises(ValueError, match=rf"\A{message}[^\n]*\Z"):
        pl.read_curve(written(tmp_path, text), **options)


def test_files_that_are_none_are_refused(tmp_path):
    with pytest.raises(ValueError, match="does not end in one of"):
        pl.read_curve(written(tmp_path, "", "curve.docx"))
    with pytest.raises(ValueError, match="cannot be read: No such file"):
        pl.read_curve(tmp_path / "none.csv")


@pytest.fixture
def microscope_file(tmp_path):
    """Force curve of a cantilever of 0.05 N/m, approach and retract, in the sign of an instrument."""
    h5py = pytest.importorskip("h5py", reason="h5py is not installed")
    path = tmp_path / "curve.h5"
    with h5py.File(path, "w") as file:
        file.attrs["software"] = "made"
        file.attrs["software version"] = "1"
        data = file.create_group("0")
        data["force"] = np.array([0.0, -1e-9, -4e-9, -2e-9, 0.0])
        data["height (measured)"] = np.array([2e-6, 1e-6, 1e-6, 1.5e-6, 2e-6])
        data["time"] = np.arange(5.0)
        data["segment"] = np.array([0, 0, 1, 1, 1])
        data.attrs["spring constant"] = 0.05
        data.attrs["imaging mode"] = "force-distance"
    return path


@pytest.mark.needs("fit")
def test_a_force_curve_of_an_instrument(microscope_file):
    back = pl.read_curve(microscope_file)
    assert back.force == pytest.approx([4e-9, 2e-9, 0.0])
    assert back.separation == pytest.approx([1e-6 - 8e-8, 1.5e-6 - 4e-8, 2e-6])  # the tip hangs F/k below its base
    assert back.time == pytest.approx([2.0, 3.0, 4.0])
    there = pl.read_curve(microscope_file, segment="approach")
    assert there.force == pytest.approx([0.0, 1e-9])
    base = pl.read_curve(microscope_file, columns=("height (measured)", "force"))
    assert base.separation == pytest.approx([1e-6, 1.5e-6, 2e-6])
    with pytest.raises(ValueError, match="index: 3 is not below 1"):
        pl.read_curve(microscope_file, index=3)


@pytest.mark.needs("fit")
def test_a_damaged_file_of_an_instrument_is_refused(tmp_path):
    for name in ("curve.h5", "curve.jpk-force", "curve.ibw"):
        with pytest.raises(ValueError, match=r"\Apath: .* is not a force curve: [^\n]*\Z"):
            pl.read_curve(written(tmp_path, "no data", name))


def test_without_afmformats_one_line_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr("pendular.codes.measured_curve.find_spec", lambda name: None)
    with pytest.raises(ValueError, match=r"needs afmformats; pip install 'pendular\[fit\]'"):
        pl.read_curve(written(tmp_path, "", "curve.jpk-force"))
