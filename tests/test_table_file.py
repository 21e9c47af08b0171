"""The binary file of a table, and `pendular_table.h`, which reads and answers it in C, C++ and CUDA."""

import ctypes
import math
import shutil
import struct
import subprocess
import threading
import warnings
import zlib
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from benchmarks.c_header import CPP, C, compiled, has_compiler

import pendular as pl
from pendular.codes.c_header import c_header, table_header
from pendular.table import binary, kernels, storage
from pendular.table.channels import known
from pendular.table.polynomial import Cells, cell_count, coefficients_of
from table_reader import (
    ENERGY,
    FORCE,
    LIQUID,
    PLAIN,
    RUPTURE,
    SEED,
    STIFFNESS,
    TABLES,
    WARNED,
    Reader,
    contacts_of,
    kernels_of,
)

NVCC = ("nvcc",)
OTHERS = [("g++", "-std=c++11"), ("clang", "-std=c99"), ("clang", "-std=c2x"), ("clang++", "-std=c++11"), NVCC]
COMPILERS = [C, CPP, *(pytest.param(other, marks=pytest.mark.long) for other in OTHERS)]
needs_c = pytest.mark.skipif(not has_compiler(C), reason="gcc is not installed")


@pytest.fixture(scope="module", params=TABLES)
def table(request):
    return pl.tabulate(**TABLES[request.param])


@pytest.fixture(scope="module")
def suction_table():
    return pl.tabulate(**TABLES["two angles"])


@pytest.fixture(scope="module")
def content(suction_table, tmp_path_factory):
    """Bytes of a file."""
    path = tmp_path_factory.mktemp("file") / "w.bridges"
    suction_table.save(path)
    return path.read_bytes()


@pytest.fixture(scope="module")
def reader(tmp_path_factory):
    return Reader(tmp_path_factory.mktemp("c"))


def sealed(content: bytes) -> bytes:
    """The bytes with the size and the checksum that belong to them."""
    body = content[:16] + struct.pack("<Q", len(content)) + content[24:-4]
    return body + zlib.crc32(body).to_bytes(4, "little")


def changed(content: bytes, place: int, new: bytes) -> bytes:
    return content[:place] + new + content[place + len(new) :]


def asked_of(table, asked, contact):
    """What the table of Python answers."""
    liquid = "suction" if table.control == "volume" else "volume"
    name = {RUPTURE: "rupture_distance", FORCE: "force", LIQUID: liquid, STIFFNESS: "stiffness", ENERGY: "energy"}[
        asked
    ]
    return getattr(table, name)(*(contact[1:] if asked == RUPTURE else contact))


# Python ------------------------------------------------------------------------------------------------------------


def parts_of(grid):
    """Arrays and numbers."""
    for value in grid:
        yield from value if isinstance(value, Cells) else (value,)


def test_the_file_gives_the_same_table(table, tmp_path):
    table.save(tmp_path / "w.bridges")
    table.save(tmp_path / "w.npz")
    (tmp_path / "w.bridges").rename(tmp_path / "renamed.npz")  # the first bytes tell, not the name
    for path in (tmp_path / "renamed.npz", tmp_path / "w.npz"):
        found = pl.load_table(path)
        for name in ("contact_angle", "control", "reduced", "radius_ratio", "tolerance", "bound", "version"):
            assert getattr(found, name) == getattr(table, name), name
        for mine, other in zip(parts_of(found.grid), parts_of(table.grid), strict=True):
            assert np.array_equal(mine, other)
            assert getattr(mine, "dtype", None) == getattr(other, "dtype", None)
    assert (tmp_path / "renamed.npz").stat().st_size % 64 == 4


def test_each_truncation_and_each_change_is_refused(content):
    for size in range(len(content)):
        with pytest.raises(ValueError, match=r"^(is|has) "):
            binary.unpacked(content[:size])
    with pytest.raises(ValueError, match=r"^is shorter or longer than it says"):
        binary.unpacked(content + bytes(64))
    damaged = bytearray(content)
    for place in range(len(content)):
        damaged[place] ^= 0x10
        with pytest.raises(ValueError, match=r"^(is|has) "):
            binary.unpacked(bytes(damaged))
        damaged[place] ^= 0x10


def assert_all_cells_are_there(cuts, rupture, force, liquid):
    assert (cuts >= 0).all()
    size_cells = cuts[:, kernels.SIZE_CELLS] + cuts[:, kernels.U_COUNT]
    cells = cuts[:, kernels.CELLS] + cuts[:, kernels.U_COUNT] * cuts[:, kernels.Q_COUNT]
    assert size_cells.max() * 64 == rupture.size
    assert cells.max() * 160 == force.size == liquid.size


def start_of_numbers(content, table):
    grid = table.grid
    return len(content) - 4 - grid.rupture.nbytes - 2 * 8 * 160 * cell_count(grid.force)


def test_wrong_headers_under_a_right_checksum_are_refused_or_held(content, suction_table):
    """What is opened has all its cells: a table without them would read memory that is not its own."""
    random = np.random.default_rng(SEED)
    print(f"seed {SEED}")
    headers = start_of_numbers(content, suction_table)
    opened = 0
    for _ in range(1500):
        place, number = 24 + 4 * random.integers((headers - 24) // 4), random.choice([0, 1, 2, 2**31 - 1, 0x7FF00000])
        arrays = {}
        with suppress(ValueError):
            _, arrays = binary.unpacked(sealed(changed(content, place, struct.pack("<I", number))))
        if not arrays:
            continue
        opened += 1
        assert_all_cells_are_there(*(arrays[name] for name in ("cuts", "rupture", "force", "liquid")))
    assert 0 < opened < 1500


# Archives of NumPy --------------------------------------------------------------------------------------------------


@pytest.fixture
def archive(suction_table, tmp_path):
    path = tmp_path / "w.npz"
    suction_table.save(path)
    return path


def loaded(path):
    """A table, if the file is one: other damage than a reason why not fails the test."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of NumPy, that a header is not what it wrote
        with suppress(ValueError):
            return pl.load_table(path)


def test_each_truncation_and_each_change_of_an_archive_is_refused_or_harmless(archive, suction_table):
    """The archive holds bytes that no reader looks at, as the time of its parts."""
    content = archive.read_bytes()
    random = np.random.default_rng(SEED)
    print(f"seed {SEED}")
    for size in random.choice(len(content), 150, replace=False):
        archive.write_bytes(content[:size])
        assert loaded(archive) is None
    names = [place + i for place in places_of(content, b"PK") for i in range(60) if place + i < len(content)]
    for place in (*names, *random.choice(len(content), 400)):
        archive.write_bytes(changed(content, int(place), bytes([content[place] ^ 0x10])))
        found = loaded(archive)
        if found is not None:
            assert all(map(np.array_equal, parts_of(found.grid), parts_of(suction_table.grid)))
            assert found.bound == suction_table.bound


def places_of(content: bytes, mark: bytes):
    place = content.find(mark)
    while place >= 0:
        yield place
        place = content.find(mark, place + 1)


def resealed(path, change):
    """Write a file with a change of its description and arrays under a right checksum."""
    found, arrays = storage.load(path)
    description = {key: value for key, value in found.items() if key not in ("format", "arrays")}
    change(description, arrays)
    storage.save(path, description, arrays)


ARCHIVE_FAULTS = {
    "control": (lambda d, a: d.update(control="wetness"), "has a control that is neither suction nor volume"),
    "angle": (lambda d, a: d.update(contact_angle=[4.0, 0.1]), "has a number in its header that is out of range"),
    "nan": (lambda d, a: d.update(range=[math.nan] * 4), "has a number in its header that is out of range"),
    "text": (lambda d, a: d.update(tolerance="much"), "is not a table, or damaged"),
    "missing": (lambda d, a: d.pop("range"), "is not a table, or damaged"),
    "part": (lambda d, a: d.update(cut=[52.5, *d["cut"][1:]]), "has a number in its header that is out of range"),
    "huge": (lambda d, a: d.update(cut=[10**30, *d["cut"][1:]]), "is not a table, or damaged"),
    "first": (lambda d, a: d.update(cut=[d["cut"][0], 0, d["cut"][2]]), "has cells that do not cover its range"),
    "rows": (lambda d, a: a.update(cuts=a["cuts"][1:]), "has arrays that are not laid out as it says"),
    "kind": (lambda d, a: a.update(cuts=a["cuts"].astype(float)), "has arrays that are not laid out as it says"),
    "cell": (lambda d, a: a["cuts"].__setitem__((0, kernels.CELLS), 10**9), "has cells that do not cover its range"),
    "short": (lambda d, a: a.update(force=a["force"][:-160]), "has arrays that are not laid out as it says"),
    "both": (lambda d, a: a.update(force=a["force"][160:], liquid=a["liquid"][160:]), "has cells that do not cover"),
    "infinite": (lambda d, a: a["force"].__setitem__(5, math.inf), "has a number that is not finite"),
    "large": (lambda d, a: a["force"].__setitem__(5, 1e39), r"has a coefficient of 1e\+39, too large for any bridge"),
}


@pytest.mark.parametrize("fault", ARCHIVE_FAULTS)
def test_a_fault_of_an_archive_is_named(archive, fault):
    change, reason = ARCHIVE_FAULTS[fault]
    resealed(archive, change)
    with pytest.raises(ValueError, match=rf"^path: '.*w\.npz' {reason}[^\n]*$"):
        pl.load_table(archive)


def test_wrong_cuts_of_an_archive_under_a_right_checksum_are_refused_or_held(archive):
    random = np.random.default_rng(SEED)
    print(f"seed {SEED}")
    content, opened = archive.read_bytes(), 0

    def change(description, arrays):
        if random.random() < 0.5:
            cuts = arrays["cuts"]
            cuts[random.integers(len(cuts)), random.integers(8)] = random.choice([0, 1, 2, 2**31, -1, 1 << 62])
        else:
            lines = arrays["lines"]
            lines[random.integers(len(lines)), random.integers(6)] *= random.choice([0.0, -1.0, 1.5, 1e300])

    for _ in range(300):
        archive.write_bytes(content)
        resealed(archive, change)
        table = loaded(archive)
        if table is not None:
            opened += 1
            force, liquid = map(coefficients_of, (table.grid.force, table.grid.liquid))
            assert_all_cells_are_there(table.grid.cuts, table.grid.rupture, force, liquid)
    assert 0 < opened < 300


FAULTS = {
    "no table": (0, b"\x88", "it is not a table of bridges"),
    "turned bytes": (8, b"\x01\x02\x03\x04", "its order of bytes is not that of this machine"),
    "version": (12, b"\x01", "its version of the format is not known"),
    "size": (16, b"\x01", "it is shorter or longer than it says"),
    "bytes": (3000, b"\xff\xff", "it is damaged: its checksum does not agree"),
}
SEALED_FAULTS = {
    "control": (24, struct.pack("<I", 2), "a number of its header is out of range"),
    "sides": (28, struct.pack("<I", 1), "a number of its header is out of range"),
    "angle": (56, struct.pack("<d", 4.0), "a number of its header is out of range"),
    "channels": (36, struct.pack("<I", 17), "a number of its header is out of range"),
    "cells": (52, struct.pack("<I", 1), "it is shorter or longer than it says"),
    "name": (176, b"Rupture", "a channel is not described as it has to be"),
    "first": (44, struct.pack("<i", 0), "its cells do not cover its range one after another"),
    "range": (112, struct.pack("<d", 1e6), "its cells do not cover its range one after another"),
    "nan": (-12, struct.pack("<d", math.nan), "a number of it is not finite"),
}


@pytest.mark.parametrize("fault", [*FAULTS, *SEALED_FAULTS])
@needs_c
def test_a_fault_is_named_in_python_and_in_c(reader, content, tmp_path, fault):
    place, new, reason = (FAULTS | SEALED_FAULTS)[fault]
    damaged = changed(content, place % len(content), new)
    damaged = sealed(damaged) if fault in SEALED_FAULTS else damaged
    assert reader.code_of(damaged) == reason
    path = tmp_path / "w.bridges"
    path.write_bytes(damaged)
    with pytest.raises(ValueError, match=r"^path: '.*w\.bridges' (is|has) "):
        pl.load_table(path)


# C -----------------------------------------------------------------------------------------------------------------


@needs_c
@pytest.mark.parametrize("compiler", COMPILERS, ids=" ".join)
def test_c_is_equal_to_the_kernels_to_the_last_bit(table, compiler, tmp_path):
    if not has_compiler(compiler):
        pytest.skip(f"{compiler[0]} is not installed")
    reader = Reader(tmp_path, compiler, ("-O2",) if compiler == NVCC else ("-O2", "-ffp-contract=off"))
    table.save(tmp_path / "w.bridges")
    opened = reader.open(tmp_path / "w.bridges")
    contact = contacts_of(table, 1500)
    for asked, expected in kernels_of(table, contact).items():
        found = reader.ask(opened, asked, contact)
        assert np.array_equal(found, expected, equal_nan=True), asked
        assert np.isnan(found).sum() < found.size or table.bound.bridges == 0
    reader.library.close_table(opened)


@needs_c
@pytest.mark.parametrize("options", [("-O2",), ("-O3", "-march=native", "-ffp-contract=fast")], ids=" ".join)
def test_c_is_equal_to_the_compiled_table(table, options, tmp_path):
    """But for the rounding of sums, which differs where a processor multiplies and adds at once."""
    reader = Reader(tmp_path, C, options)
    table.save(tmp_path / "w.bridges")
    opened = reader.open(tmp_path / "w.bridges")
    contact = contacts_of(table, 100_000)
    at_contact = (np.zeros(100_000), *contact[1:])
    rupture = asked_of(table, RUPTURE, contact)
    with np.errstate(invalid="ignore", divide="ignore"):
        q = np.sqrt(1.0 - np.maximum(contact[0], 0.0) / rupture)
    for asked in PLAIN:
        found, expected = reader.ask(opened, asked, contact), asked_of(table, asked, contact)
        assert np.array_equal(np.isnan(found), np.isnan(expected)), asked
        assert np.array_equal(found == 0.0, expected == 0.0), asked
        is_there = np.isfinite(expected) & (expected != 0.0)
        if not is_there.any():
            continue
        unit = np.abs(asked_of(table, asked, at_contact))
        if asked == LIQUID and table.control == "volume":  # it passes through 0, as does the stiffness
            unit = np.maximum(unit, contact[4] / contact[2])
        if asked == STIFFNESS:
            unit = np.maximum(unit, np.abs(asked_of(table, FORCE, at_contact)) / rupture)
        # The root of 1 - D/D_c amplifies the rounding of D_c as rupture comes near: by 1/q, its rate by 1/q³.
        amplified = {RUPTURE: 1.0, STIFFNESS: 1.0 + q**-3}.get(asked, 1.0 + 1.0 / q)
        error = np.where(is_there, np.abs(found - expected) / unit / amplified, 0.0)
        # Most is of single precision, which sums small terms of all but rupture distances.
        bound = {RUPTURE: 1e-12, LIQUID: table.bound.liquid}.get(asked, table.bound.force)
        print(asked, error.max() / bound)
        assert error.max() < 1e-3 * bound, asked


@needs_c
@pytest.mark.parametrize("options", [("-O2",), ("-O3", "-march=native", "-ffp-contract=fast")], ids=" ".join)
@pytest.mark.parametrize("name", ["any ratio", "two angles", "volume"])
def test_a_header_with_numbers_has_the_bits_of_the_file(name, options, tmp_path):
    """Both are one text: what `export c` writes as integers times a power of two loses nothing."""
    table = pl.tabulate(**TABLES[name])
    liquid = "suction" if table.control == "volume" else "volume"
    names = {RUPTURE: "rupture_distance", FORCE: "force", LIQUID: liquid, STIFFNESS: "stiffness", ENERGY: "energy"}
    call = compiled(c_header(table), tmp_path, tuple(names.values()), C, options)
    table.save(tmp_path / "w.bridges")
    reader = Reader(tmp_path, C, options)
    opened = reader.open(tmp_path / "w.bridges")
    contact = contacts_of(table, 20_000)
    for asked, name in names.items():
        assert np.array_equal(call(name, *contact), reader.ask(opened, asked, contact), equal_nan=True), name


@needs_c
def test_blocks_names_and_threads_answer_alike(reader, suction_table, content, tmp_path):
    path = tmp_path / "w.bridges"
    path.write_bytes(content)
    opened = reader.open(path)
    contact = (*contacts_of(suction_table, 50_000)[:4], np.full(50_000, 0.07))
    alone = {asked: reader.ask(opened, asked, contact) for asked in PLAIN}
    pointers = [ctypes.c_void_p(np.ascontiguousarray(array).ctypes.data) for array in contact[:4]]
    for asked, expected in alone.items():
        out = np.empty(50_000)
        rest = (ctypes.c_double(0.07), ctypes.c_void_p(out.ctypes.data))
        reader.library.ask_block(opened, asked, ctypes.c_size_t(out.size), *pointers, *rest)
        assert np.array_equal(out, expected, equal_nan=True)
        numbers = [ctypes.c_double(array[7]) for array in contact]
        assert np.array_equal(reader.library.ask_by_name(opened, asked, *numbers), expected[7], equal_nan=True)
    found: dict[int, np.ndarray] = {}

    def work(number: int) -> None:
        found[number] = reader.ask(opened, list(PLAIN)[number % 5], contact)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(10)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number, answer in found.items():
        assert np.array_equal(answer, list(alone.values())[number % 5], equal_nan=True)


@needs_c
def test_no_answer_is_nan(reader, suction_table, content, tmp_path):
    (tmp_path / "w.bridges").write_bytes(content)
    opened = reader.open(tmp_path / "w.bridges")
    whole = (1e-7, 20.0 * 0.07 / 1e-4, 1e-4, 1e-4, 0.07)
    assert np.isfinite(reader.ask(opened, FORCE, whole))
    odd = {place: [math.nan] for place in range(5)} | {1: [math.nan, 0.0, -1e4, math.inf, 1e3, 1e6]}
    odd[2] = odd[3] = [math.nan, 0.0, -1e-4, math.inf, 1e-3]
    odd[4] = [math.nan, 0.0, -0.07, math.inf]
    for place, numbers in odd.items():
        for number in numbers:
            contact = [*whole[:place], number, *whole[place + 1 :]]
            for asked in (FORCE, LIQUID, STIFFNESS, ENERGY, *([RUPTURE] if place else [])):
                assert np.isnan(reader.ask(opened, asked, contact)), (asked, contact)
    assert reader.ask(opened, FORCE, (math.inf, *whole[1:])) == 0.0
    for asked in (-3, 3, 99):
        assert np.isnan(reader.ask(opened, asked, whole))


@needs_c
def test_the_file_describes_its_channels(reader, table, tmp_path):
    table.save(tmp_path / "w.bridges")
    opened = reader.open(tmp_path / "w.bridges")
    liquid = "suction" if table.control == "volume" else "volume"
    bounds = (table.bound.rupture, table.bound.force, table.bound.liquid)
    for channel, name in enumerate(("rupture_distance", "force", liquid)):
        known = binary.CHANNELS[name]
        told = [reader.library.text_of(opened, channel, which).decode() for which in range(3)]
        assert told == [name, known.unit, known.bound_of]
        assert reader.library.bound_of(opened, channel) == bounds[channel]
        assert reader.library.channel_of(opened, name.encode()) == channel
    assert reader.library.channel_of(opened, b"neck_radius") == -1
    assert reader.library.text_of(opened, 3, 0) is None


@needs_c
def test_a_further_channel_is_answered_by_its_name(reader, suction_table, content, tmp_path):
    """A quantity that this version does not know: 3 R̄² √c* times the polynomial of the force."""
    start = start_of_numbers(content, suction_table)
    rows = content[176 + 3 * 112 : 176 + 3 * 112 + len(suction_table.grid.lines) * (6 * 8 + 8 * 4)]
    added = struct.pack("<24s16s40s2d4i", b"wetness", b"m2", b"nothing", 3.0, 0.5, 1, 0, 2, 1)
    headers = content[:36] + struct.pack("<I", 4) + content[40 : 176 + 3 * 112] + added + rows
    padded = headers + bytes(-len(headers) % 64)
    longer = sealed(padded + content[start:-4] + coefficients_of(suction_table.grid.force).tobytes() + bytes(4))
    path = tmp_path / "w.bridges"
    path.write_bytes(longer)
    opened = reader.open(path)
    assert reader.library.channel_of(opened, b"wetness") == 3
    contact = contacts_of(suction_table, 1000)
    force, wetness = (reader.ask(opened, asked, contact) for asked in (FORCE, 3))
    mean = 2.0 / (1.0 / contact[2] + 1.0 / contact[3])
    star = contact[1] * mean / contact[4]
    is_there = force > 0.0
    expected = force / (2.0 * math.pi * contact[4] * mean) * 3.0 * mean**2 * np.sqrt(star)
    np.testing.assert_allclose(wetness[is_there], expected[is_there], rtol=1e-14)
    assert np.isnan(wetness[~is_there]).all()
    assert all(map(np.array_equal, pl.load_table(path).grid.force, suction_table.grid.force))


def more_of(table, contact):
    """Exact values of the channels beside force and liquid, each with what its bound is relative to."""
    gap, control, radius1, radius2, tension = contact
    grains, liquid = pl.Pair((radius1, radius2), tuple(table.contact_angle)), pl.Liquid(surface_tension=tension)
    bridge, touching = (pl.bridge(grains, at, **{table.control: control}, liquid=liquid) for at in (gap, 0.0))
    values = {
        "neck_radius": (bridge.neck_radius, touching.neck_radius),
        "area": (bridge.liquid_gas_area, touching.liquid_gas_area),
        "across_tensor": (bridge.capillary_tensor[0], touching.capillary_tensor[0]),
        "axial_tensor": (bridge.capillary_tensor[1], touching.capillary_tensor[1]),
    }
    first, second = bridge.half_filling_angle
    if table.grid.sides == 2:
        return values | {"half_filling1": (first, 1.0), "half_filling2": (second, 1.0)}
    s = abs(radius1 - radius2) / (radius1 + radius2) if math.isfinite(radius1 + radius2) else 1.0
    values["half_filling_mean"] = 0.5 * (first + second), 1.0
    if s > 0.0:  # equal spheres have no difference
        slope = (first - second if radius1 < radius2 else second - first) / s
        values["half_filling_slope"] = slope, 2.0 / s
    return values


@needs_c
@pytest.mark.parametrize("name", ["any ratio", "two angles", "volume"])
def test_more_channels_are_exact_within_their_bounds(reader, name, tmp_path):
    table = pl.tabulate(**TABLES[name])
    names = tuple(known(table.grid.sides))
    table.save(tmp_path / "w.bridges")
    plain = (tmp_path / "w.bridges").read_bytes()
    table.save(tmp_path / "w.bridges", channels=names)
    assert (tmp_path / "w.bridges").stat().st_size > 2 * len(plain)
    assert all(map(np.array_equal, pl.load_table(tmp_path / "w.bridges").grid.force, table.grid.force))
    opened = reader.open(tmp_path / "w.bridges")
    told = {name: bound for name, bound, _ in binary.told_channels(tmp_path / "w.bridges")}
    contact = np.array(contacts_of(table, 200))
    contact[3, :5] = contact[2, :5]  # equal spheres, and planes
    contact[3, 5:10] = math.inf if name == "any ratio" else contact[3, 5:10]
    mean, star = 2.0 / (1.0 / contact[2] + 1.0 / contact[3]), math.sqrt(math.prod(table.reduced))
    contact[1, :10] = (star * mean**3 if name == "volume" else star * contact[4] / mean)[:10]
    rupture = table.rupture_distance(*contact[1:])
    contact[0] = np.random.default_rng(SEED).uniform(0.0, 0.999, 200) * rupture
    found = {each: reader.ask(opened, reader.library.channel_of(opened, each.encode()), contact) for each in names}
    for i in range(200):
        for each, (exact, unit) in more_of(table, contact[:, i].tolist()).items():
            assert abs(found[each][i] - exact) <= told[each] * unit, (each, contact[:, i].tolist())
    beyond = contact.copy()
    beyond[0] = 1.01 * rupture
    for each in names:
        assert np.isnan(reader.ask(opened, reader.library.channel_of(opened, each.encode()), beyond)).all()


def test_channels_that_cannot_be_are_refused(suction_table, tmp_path):
    path = tmp_path / "w.bridges"
    with pytest.raises(ValueError, match=r"^channels: 'wetness' is not one of [^\n]*neck_radius[^\n]*half_filling1"):
        suction_table.save(path, channels=("wetness",))
    with pytest.raises(ValueError, match=r"^channels: \('area', 'area'\) names one twice$"):
        suction_table.save(path, channels=("area", "area"))
    with pytest.raises(ValueError, match=r"^channels: are of files that end in \.bridges, not of '.*w\.npz'$"):
        suction_table.save(tmp_path / "w.npz", channels=("area",))
    pushing = pl.tabulate(math.radians(110), "volume", reduced=(0.01, 0.0156), radius_ratio=(1.0, 1.0), tolerance=1e-3)
    with pytest.raises(ValueError, match=r"^channels: 'neck_radius' is not there for some bridges"):
        pushing.save(path, channels=("neck_radius",))
    with pytest.raises(ValueError, match=r"^contact_angle: "):
        pl.tabulate(**TABLES["dry"]).save(path, channels=("area",))
    assert list(tmp_path.iterdir()) == []


@needs_c
def test_a_moved_table_is_the_same(reader, content, suction_table, tmp_path):
    (tmp_path / "w.bridges").write_bytes(content)
    opened, moved = reader.open(tmp_path / "w.bridges"), reader.new()
    room = np.frombuffer(content[: len(content) // 8 * 8], float).copy()
    reader.library.moved_to(opened, ctypes.c_void_p(room.ctypes.data), moved)
    contact = contacts_of(suction_table, 1000)
    expected = {asked: reader.ask(opened, asked, contact) for asked in PLAIN}
    reader.library.close_table(opened)
    for asked, answer in expected.items():
        assert np.array_equal(reader.ask(moved, asked, contact), answer, equal_nan=True)


@needs_c
def test_files_that_cannot_be_opened(reader, content, tmp_path):
    (tmp_path / "empty").write_bytes(b"")
    reasons = {tmp_path / "none": "the file cannot be read", tmp_path: "the file cannot be read"}
    reasons[tmp_path / "empty"] = "it is not a table of bridges"
    for path, reason in reasons.items():
        code = reader.library.open_path(str(path).encode(), reader.new())
        assert reader.library.error_of(code).decode() == reason
    assert reader.code_of(content) == "no error"
    assert reader.code_of(content, 1) == "the memory does not begin at a multiple of eight bytes"
    texts = [reader.library.error_of(code).decode() for code in range(14)]
    assert len(set(texts)) == 14
    assert texts[13] == "no code of an error"


@needs_c
def test_the_example_runs_as_it_says(suction_table, content, tmp_path):
    (tmp_path / "w.bridges").write_bytes(content)
    (tmp_path / "cut.bridges").write_bytes(content[:-1])
    (tmp_path / "pendular_table.h").write_text(table_header())
    shutil.copy(Path(__file__).parents[1] / "examples" / "c" / "from_file.c", tmp_path)
    command = [*C, "-O2", *WARNED, "-o", "from_file", "from_file.c", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    program = str(tmp_path / "from_file")
    refused = subprocess.run([program, tmp_path / "cut.bridges"], check=False, capture_output=True, text=True)
    assert refused.returncode == 1
    assert refused.stderr.endswith("cut.bridges: it is shorter or longer than it says\n")
    done = subprocess.run([program, tmp_path / "w.bridges"], check=True, capture_output=True, text=True)
    rows = np.array([line.split() for line in done.stdout.splitlines()[3:]], float)
    pair = (14e3, 50e-6, 100e-6, 0.0728)
    for column, name in enumerate(("force", "stiffness", "energy", "volume"), 1):
        expected = getattr(suction_table, name)(rows[:5, 0], *pair)
        np.testing.assert_allclose(rows[:5, column], expected, rtol=2e-6)
    assert rows[5, 1] == 0.0


# The command -------------------------------------------------------------------------------------------------------


def test_the_command_writes_a_table_and_what_reads_it(run, tmp_path):
    out, header = tmp_path / "w.bridges", tmp_path / "pendular_table.h"
    ranges = ("--contact-angle2", 50, "--reduced-suction", 10, 20, "--radius-ratio", 1, 2, "--tolerance", 1e-4)
    code, told, _ = run("export", "table", "--contact-angle", "20", *ranges, "--out", out, "--header", header)
    assert code == 0
    assert told.startswith(f"{out}: 0.0")
    assert "Bounds of error  force " in told
    assert header.read_text() == table_header()
    found = pl.load_table(out)
    assert found.contact_angle == (math.radians(20), math.radians(50))
    assert (found.control, found.reduced, found.radius_ratio) == ("suction", (10.0, 20.0), (1.0, 2.0))
    grains = pl.Pair((50e-6, 80e-6), (math.radians(20), math.radians(50)))
    exact = pl.bridge(grains, 1e-6, suction=18e3, liquid=pl.Liquid(surface_tension=0.0728))
    at_contact = found.force(0.0, 18e3, 50e-6, 80e-6, 0.0728)
    assert found.force(1e-6, 18e3, 50e-6, 80e-6, 0.0728) == pytest.approx(exact.force, abs=1e-4 * at_contact)


def test_the_command_writes_a_table_of_constant_volume(run, tmp_path):
    out = tmp_path / "v.bridges"
    ranges = ("--volume", 0.01, 0.0156, "--radius-ratio", 1, 1.2, "--tolerance", 1e-4)
    assert run("export", "table", "--contact-angle", "20", *ranges, "--out", out)[0] == 0
    assert pl.load_table(out).control == "volume"


def test_the_command_adds_channels_by_name(run, tmp_path):
    out = tmp_path / "w.bridges"
    ranges = ("--reduced-suction", 10, 20, "--radius-ratio", 1, 2, "--tolerance", 1e-4)
    code, told, _ = run(
        "export",
        "table",
        "--contact-angle",
        "20",
        *ranges,
        "--out",
        out,
        "--channel",
        "area",
        "--channel",
        "neck_radius",
    )
    assert code == 0
    assert [line.split()[0] for line in told.splitlines()[-2:]] == ["area", "neck_radius"]
    assert all(line.endswith(" of its value at contact") for line in told.splitlines()[-2:])
    assert [name for name, *_ in binary.told_channels(out)] == [
        "rupture_distance", "force", "volume", "area", "neck_radius",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--out", "w.npz"], "out: 'w.npz' does not end in .bridges"),
        (["--out", "none/w.bridges"], "out: 'none' is not a folder to write to"),
        (["--out", "w.bridges", "--reduced-suction", "1", "2", "--reduced-volume", "1", "2"], "reduced-volume: given"),
        (["--out", "w.bridges", "--tolerance", "1"], "tolerance: 1.0 is not in"),
        (["--out", "w.bridges", "--channel", "wetness"], "channel: 'wetness' is not one of"),
        (["--out", "w.bridges", "--contact-angle2", "181"], "contact-angle2: "),
        (["--out", "w.bridges", "--contact-angle2", "160"], "contact-angle: 20 and 160 deg are not below 180 deg"),
    ],
)
def test_bad_options_are_refused_in_one_line(run, options, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = run("export", "table", "--contact-angle", "20", *options)
    assert (code, out) == (2, "")
    assert err.startswith(f"pendular: {message}")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
