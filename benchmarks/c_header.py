"""How long a contact takes in the exported C header: ``python -m benchmarks.c_header``.

The header is compiled with a loop over arrays and called through ctypes, as its tests do.
"""

import ctypes
import math
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import pendular as pl
from pendular.codes.c_header import c_header

Floats = NDArray[np.float64]

SEED = 50
CONTACTS, REPEATS = 100_000, 15
C, CPP = ("gcc", "-std=c99"), ("g++", "-std=c++17")
WARNINGS = ("-Wall", "-Wextra", "-Werror")
OPTIONS = (("-O2",), ("-O3", "-march=native"), ("-O3", "-march=native", "-ffp-contract=fast"))

_LOOP = """
{language} void run_{name}(long count, const double *separation, const double *control, const double *radius1,
    const double *radius2, const double *surface_tension, double *out)
{{
    long i;
    (void)separation;
    for (i = 0; i < count; ++i)
        out[i] = {prefix}{name}({separation}control[i], radius1[i], radius2[i], surface_tension[i]);
}}
"""


def has_compiler(compiler: tuple[str, ...]) -> bool:
    """Whether a compiler is installed."""
    return shutil.which(compiler[0]) is not None


def source_of(names: tuple[str, ...], compiler: tuple[str, ...], prefix: str) -> str:
    """Program text with one loop over contacts for each function of the header."""
    language = 'extern "C"' if compiler[0] == CPP[0] else ""
    loops = [
        _LOOP.format(
            name=name,
            prefix=prefix,
            language=language,
            separation="" if name == "rupture_distance" else "separation[i], ",
        )
        for name in names
    ]
    return '#include "bridge.h"\n' + "".join(loops)


def compiled(
    header: str,
    folder: Path,
    names: tuple[str, ...],
    compiler: tuple[str, ...] = C,
    options: tuple[str, ...] = ("-O2",),
    prefix: str = "pendular_",
) -> Callable[..., Floats]:
    """Compile a header; returns a function of a name and five operands that broadcast."""
    suffix = ".cpp" if compiler[0] == CPP[0] else ".c"
    program, library = (folder / f"bridge{end}" for end in (suffix, ".so"))
    (folder / "bridge.h").write_text(header, encoding="utf-8")
    program.write_text(source_of(names, compiler, prefix))
    command = [*compiler, *options, *WARNINGS, "-shared", "-fPIC", "-o", str(library), str(program), "-lm"]
    subprocess.run(command, check=True)
    loaded = ctypes.CDLL(str(library))

    def call(name: str, *operands: Any) -> Floats:
        arrays = [np.array(operand, float, order="C") for operand in np.broadcast_arrays(*operands)]
        out = np.empty(arrays[0].shape)
        pointers = [ctypes.c_void_p(array.ctypes.data) for array in (*arrays, out)]
        loaded[f"run_{name}"](ctypes.c_long(out.size), *pointers)
        return out

    return call


def contacts(table: Any, count: int, seed: int = SEED) -> tuple[Floats, ...]:
    """Random contacts in the range of a table: separation, control, two radii and the surface tension."""
    random = np.random.default_rng(seed)
    low, high = np.log(table.reduced)
    star = np.exp(random.uniform(low, high, count))
    inverse = random.uniform(1.0 / table.radius_ratio[1], 1.0 / table.radius_ratio[0], count)
    small = 10.0 ** random.uniform(-6.0, -3.0, count)
    radii = np.where(random.random(count) < 0.5, [small, small / inverse], [small / inverse, small])
    mean = 2.0 * small / (1.0 + inverse)
    gamma = random.uniform(0.02, 0.08, count)
    control = star * mean**3 if table.control == "volume" else star * gamma / mean
    rupture = table.rupture_distance(control, *radii, gamma)
    return random.uniform(-0.05, 1.05, count) * rupture, control, *radii, gamma


def nanoseconds(call: Callable[..., Floats], name: str, operands: tuple[Floats, ...]) -> float:
    """Least time of a contact."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        call(name, *operands)
        times.append(time.perf_counter() - start)
    return 1e9 * min(times) / operands[0].size


def main() -> None:
    """Print the nanoseconds of a contact for the functions and for two sets of options."""
    tables = {
        "suction": pl.tabulate(math.radians(20), reduced=(0.1, 1e4), tolerance=1e-6),
        "volume": pl.tabulate(
            math.radians(20), control="volume", reduced=(1e-3, 0.015), radius_ratio=(1.0, 1.2), tolerance=1e-4
        ),
    }
    print(f"{CONTACTS} random contacts, contact angle 20°, seed {SEED}, one thread; nanoseconds a contact")
    for control, table in tables.items():
        header = c_header(table)
        liquid = "suction" if control == "volume" else "volume"
        names = ("force", liquid, "stiffness", "rupture_distance")
        operands = contacts(table, CONTACTS)
        for options in OPTIONS:
            with tempfile.TemporaryDirectory() as folder:
                call = compiled(header, Path(folder), names, options=options)
                times = "   ".join(f"{name} {nanoseconds(call, name, operands):.1f}" for name in names)
            print(f"{control:8s} {len(header) / 1e6:.2f} MB   gcc {' '.join(options):44s} {times}")


if __name__ == "__main__":
    main()
