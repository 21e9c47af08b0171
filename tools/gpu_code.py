"""Code of all GPU kernels for GPUs that need not be here, and what the assembler tells of it.

``python -m tools.gpu_code 9.0`` compiles them for a compute capability and prints registers, spills and wide loads.
Spills are bytes of the memory of a thread, each written and read.
"""

import re
import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
from numba import cuda, typeof, types
from numba.core import config

import pendular as pl
from pendular.ask import cuda as ask_cuda
from pendular.ask.fields import room_for
from pendular.exact.batch import ALL, FORCE_ALONE
from pendular.exact.equations import SUCTION, VOLUME
from pendular.ground import device_groups
from pendular.packing import cuda as packing_cuda
from pendular.table import cuda as table_cuda
from pendular.table.packed import pack

_LOADS_OF_GLOBAL_MEMORY = (0x381, 0x981)  # operation, in the low 12 bits of an instruction of 128
_SIXTEEN_BYTES = 6  # in bits 73 to 75


class GpuKernel(NamedTuple):
    """A kernel that is launched."""

    name: str
    loop: Any
    signature: Any
    registers: int | None  # of a thread at most
    shares: bool  # whether threads share contacts, and read 16 bytes at a time


class Assembled(NamedTuple):
    """Machine code, by the assembler."""

    registers: int
    spilled: int  # bytes
    stack: int  # bytes, spills among them
    wide_loads: int  # of 16 bytes


def gpu_kernels(table: pl.Table) -> list[GpuKernel]:
    """All kernels of the package."""
    grid, packed = typeof(table.grid), typeof(pack(table.grid))
    row, limit = types.float64[::1], table_cuda.REGISTERS
    found = [
        GpuKernel(
            f"table: {scalar.__name__.strip('_')}",
            table_cuda.loop_by_warps(shared), types.void(grid, packed, *6 * (row,)), limit, True,
        )
        for scalar, shared in table_cuda.SHARED.items()
    ]  # fmt: skip
    found += [
        GpuKernel(
            f"table, one thread a contact: {scalar.__name__.strip('_')}",
            table_cuda.loop_of(scalar), types.void(grid, *6 * (row,)), None, False,
        )
        for scalar in table_cuda.SHARED
    ]  # fmt: skip
    whole, listed = types.float64[:, ::1], types.int64[:, ::1]
    stepping = (grid, packed, listed, whole, row, row, types.float64, types.float64, *4 * (row,), whole, whole)
    for name, with_energy, adds in (
        ("with its energy", True, True),
        ("without it", False, True),
        ("forces summed in order", False, False),
    ):
        pull, registers = packing_cuda.pull_by(with_energy)
        loop = packing_cuda.step_loop(pull, adds, registers)
        signature = types.void(*stepping, types.int64[::1], row)
        found.append(GpuKernel(f"step, {name}", loop, signature, registers, True))
    asking = (*6 * (row,), types.float64, whole, typeof(room_for(1, None)), types.int8[::1])
    for name, wanted in (("force", FORCE_ALONE), ("all fields", ALL)):
        for held, control in (("suction", SUCTION), ("volume", VOLUME)):
            loop = ask_cuda.loop(wanted, control)
            found.append(GpuKernel(f"solver at a {held}: {name}", loop, types.void(*asking), None, False))
    numbers = types.int64[::1]
    others = (
        ("table: cell of a contact", table_cuda.loop_of(table_cuda.cell_number), (grid, *5 * (row,), numbers)),
        ("groups: count", device_groups.count_items, (numbers, numbers)),
        ("groups: place", device_groups.place_items, (numbers, numbers, numbers)),
        ("groups: put in order", device_groups.put_in_order, (numbers, numbers)),
        ("step: clear", packing_cuda.clear, (whole, numbers)),
        ("step: add up in order", packing_cuda.add_up(), (numbers, numbers, listed, whole, row, whole)),
        ("step: carry to a new list", packing_cuda.carry, (numbers, numbers, listed, row, listed, row, numbers)),
        ("solver: put", ask_cuda.put, (numbers, row, row)),
    )
    return found + [GpuKernel(name, loop, types.void(*given), None, False) for name, loop, given in others]


def without_a_device(capability: tuple[int, int]) -> None:
    """Let Numba compile where no driver is; a line says what is missing, and the process ends."""
    import numba.cuda.cuda_paths
    import numba.cuda.dispatcher
    from numba.cuda.cudadrv.nvvm import NVVM

    numba.cuda.cuda_paths._get_nvrtc_path = lambda: None  # a compiler of C++, which Numba looks for at once
    try:
        NVVM()
    except (ImportError, OSError, RuntimeError) as reason:
        sys.exit(f"NVVM is not installed: {str(reason).strip().splitlines()[0]}")
    # A function that is called by another is compiled for the current device, which only a driver knows.
    config.FORCE_CUDA_CC = capability
    numba.cuda.dispatcher.get_current_device = lambda: SimpleNamespace(compute_capability=capability)


def ptx_of(loop: Any, signature: Any, capability: tuple[int, int]) -> str:
    """Code for a GPU of that compute capability."""
    text, _ = cuda.compile(loop.py_func, signature, device=False, abi="numba", cc=capability)
    return str(text)


def assembler() -> str | None:
    """Place of the assembler of the CUDA toolkit, None where there is none."""
    return shutil.which("ptxas")


def assembled(ptx: str, architecture: str, registers: int | None) -> Assembled:
    """What the assembler makes of code; it takes code of a newer compiler that uses nothing new."""
    program = assembler()
    assert program is not None
    with tempfile.TemporaryDirectory() as folder:
        source, code = Path(folder) / "kernel.ptx", Path(folder) / "kernel.cubin"
        limit = [] if registers is None else ["--maxrregcount", str(registers)]
        command = [program, "--verbose", f"--gpu-name={architecture}", *limit, str(source), "--output-file", str(code)]
        source.write_text(ptx)
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if version := re.search(r"Unsupported .version [\d.]+; current version is '([\d.]+)'", done.stderr):
            source.write_text(re.sub(r"^\.version [\d.]+", f".version {version[1]}", ptx, flags=re.MULTILINE))
            done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise RuntimeError(done.stderr)
        stack, spilled = re.findall(r"(\d+) bytes stack frame, (\d+) bytes spill stores", done.stderr)[0]
        used = re.findall(r"Used (\d+) registers", done.stderr)[0]
        return Assembled(int(used), int(spilled), int(stack), _wide_loads(code.read_bytes()))


def _wide_loads(code: bytes) -> int:
    return sum(
        low & 0xFFF in _LOADS_OF_GLOBAL_MEMORY and (high >> 9) & 7 == _SIXTEEN_BYTES
        for low, high in _instructions(code)
    )


def _instructions(code: bytes) -> Iterator[tuple[int, int]]:
    """Instructions of all sections of code in an ELF file, by halves."""
    (start,) = struct.unpack_from("<Q", code, 0x28)
    size, count, names = struct.unpack_from("<HHH", code, 0x3A)
    sections = [struct.unpack_from("<IIQQQQ", code, start + i * size) for i in range(count)]
    for name, _, _, _, offset, length in sections:
        if code.startswith(b".text.", sections[names][4] + name):
            yield from struct.iter_unpack("<QQ", code[offset : offset + length])


def table_of_code(table: pl.Table, capability: tuple[int, int], only: str = "") -> str:
    """Registers, spills and wide loads of all kernels, as a table."""
    architecture = "sm_{}{}".format(*capability)
    lines = ["| kernel | registers | bytes spilled | loads of 16 bytes |", "|---|---:|---:|---:|"]
    for name, loop, signature, registers, _ in gpu_kernels(table):
        if only not in name:
            continue
        found = assembled(ptx_of(loop, signature, capability), architecture, registers)
        lines.append(f"| {name} | {found.registers} | {found.spilled} | {found.wide_loads} |")
    return "\n".join(lines)


if __name__ == "__main__":
    major, minor = sys.argv[1].split(".")
    without_a_device((int(major), int(minor)))
    if assembler() is None:
        sys.exit("ptxas is not installed; it comes with the CUDA toolkit")
    some = pl.tabulate(np.deg2rad(20), reduced=(100.0, 200.0), radius_ratio=(1, 2), tolerance=1e-5)
    print(table_of_code(some, (int(major), int(minor)), *sys.argv[2:]))  # noqa: T201
