"""Tables of tests, and the functions of `pendular_table.h` compiled and called from Python."""

import ctypes
import math
import shutil
import subprocess
from pathlib import Path

import numpy as np
from benchmarks.c_header import WARNINGS, C, contacts

from pendular.table import kernels

SEED = 20
HERE = Path(__file__).parent
PROGRAMS = HERE / "c_programs"
HEADERS = HERE.parent / "src" / "pendular" / "codes"
TABLES = {
    "any ratio": {"contact_angle": math.radians(20), "reduced": (0.1, 1e4), "tolerance": 1e-4},
    "two angles": {
        "contact_angle": np.deg2rad([20.0, 55.0]),
        "reduced": (10.0, 25.0),
        "radius_ratio": (1.0, 2.0),
        "tolerance": 1e-4,
    },
    "volume": {
        "contact_angle": math.radians(20),
        "control": "volume",
        "reduced": (0.01, 0.0156),
        "radius_ratio": (1.0, 1.2),
        "tolerance": 1e-4,
    },
    "dry": {"contact_angle": 2.0, "reduced": (1.0, 100.0), "tolerance": 1e-4},
}
RUPTURE, FORCE, LIQUID, STIFFNESS, ENERGY = 0, 1, 2, -1, -2
PLAIN = {
    RUPTURE: lambda grid, separation, *rest: kernels.rupture_distance(grid, *rest),
    FORCE: kernels.force,
    LIQUID: kernels.liquid,
    STIFFNESS: kernels.stiffness,
    ENERGY: kernels.energy,
}
SUFFIXES = {"gcc": ".c", "clang": ".c", "g++": ".cpp", "clang++": ".cpp", "nvcc": ".cu"}
WARNED = (*WARNINGS, "-pedantic")


class Reader:
    """The functions of the header, compiled and called from Python."""

    def __init__(self, folder: Path, compiler: tuple[str, ...] = C, options: tuple[str, ...] = ("-O2",)) -> None:
        source, library = folder / f"answers{SUFFIXES[compiler[0]]}", folder / "answers.so"
        shutil.copy(PROGRAMS / "answers.c", source)
        warned = WARNED if compiler[0] != "nvcc" else ("-Werror", "all-warnings", "-Wno-deprecated-gpu-targets")
        position = ("-fPIC",) if compiler[0] != "nvcc" else ("-Xcompiler", "-fPIC,-ffp-contract=off")
        include = ("-I", str(HEADERS), "-shared", *position, "-o", str(library))
        subprocess.run([*compiler, *options, *warned, *include, str(source), "-lm"], check=True)
        self.library = ctypes.CDLL(str(library))
        for name in ("error_of", "text_of"):
            getattr(self.library, name).restype = ctypes.c_char_p
        for name in ("bound_of", "ask_by_name"):
            getattr(self.library, name).restype = ctypes.c_double
        self.library.size_of_table.restype = ctypes.c_size_t

    def new(self) -> ctypes.Array:
        """Room for a table."""
        return ctypes.create_string_buffer(self.library.size_of_table())

    def code_of(self, content: bytes, offset: int = 0) -> str:
        """What is said of a file in memory that begins an offset behind a multiple of eight bytes."""
        room = np.zeros(len(content) // 8 + 2)
        place = room.ctypes.data + offset
        ctypes.memmove(place, content, len(content))
        code = self.library.open_bytes(ctypes.c_void_p(place), ctypes.c_size_t(len(content)), self.new())
        return self.library.error_of(code).decode()

    def open(self, path: Path) -> ctypes.Array:
        """The table of a file."""
        opened = self.new()
        code = self.library.open_path(str(path).encode(), opened)
        assert code == 0, self.library.error_of(code)
        return opened

    def ask(self, opened: ctypes.Array, asked: int, contact) -> np.ndarray:
        """Answers for contacts."""
        arrays = [np.array(operand, float, order="C") for operand in np.broadcast_arrays(*contact)]
        out = np.empty(arrays[0].shape)
        pointers = [ctypes.c_void_p(array.ctypes.data) for array in (*arrays, out)]
        self.library.ask(opened, asked, ctypes.c_size_t(out.size), *pointers)
        return out


def contacts_of(table, count, seed=SEED):
    print(f"seed {seed}")
    separation, *rest = contacts(table, count, seed)
    if table.rupture_distance(*rest).max() == 0.0:  # solids that hold nothing
        separation = np.random.default_rng(seed).uniform(-1e-6, 1e-6, count)
    return separation, *rest


def kernels_of(table, contact) -> dict[int, np.ndarray]:
    """What the kernels answer in plain Python, for all that is asked."""
    rows = [tuple(map(float, each)) for each in zip(*contact, strict=True)]
    return {asked: np.array([kernel(table.grid, *row) for row in rows]) for asked, kernel in PLAIN.items()}
