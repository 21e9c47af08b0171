"""What `test_cuda.py` runs in processes of its own: ``python tests/on_cuda.py TASK FOLDER [more]``.

In Numba's simulator, which needs ``NUMBA_ENABLE_CUDASIM=1``, threads of the GPU run as Python; ``NUMBA_DISABLE_JIT=1``
makes Python of the scalar kernels as well.
"""

import json
import sys
from pathlib import Path

import numpy as np
from numba import cuda, typeof, types

import pendular as pl
from documents import assert_python_prints_what_it_says
from pendular.ask import cuda as solver_on_gpu
from pendular.table import cuda as table_on_gpu
from pendular.table import kernels

NAMES = ("force", "liquid", "stiffness", "energy", "rupture_distance")
PAGE = Path(__file__).parents[1] / "docs" / "howto" / "gpu.md"
PAGE_ASKS = {"contact_angle": np.deg2rad(20), "reduced": (1.0, 1e4)}
GAMMA = 0.0728


def kernel_arguments(name, arguments):
    """A rupture distance depends on all but the separation."""
    return arguments[1:] if name == "rupture_distance" else arguments


@cuda.jit
def work_of(grid, separation, control, radius1, radius2, out):
    """A kernel as users write them: two questions to the table in one thread."""
    i = cuda.grid(1)
    if i < out.size:
        force = kernels.force(grid, separation[i], control[i], radius1[i], radius2[i], 0.0728)
        stiffness = kernels.stiffness(grid, separation[i], control[i], radius1[i], radius2[i], 0.0728)
        out[i] = force + 1e-9 * stiffness


def refusal(function, *arguments, **options):
    """Words of the error that a call raises."""
    try:
        function(*arguments, **options)
    except ValueError as error:
        return str(error)
    return ""


def simulate(folder):
    """Answers of each table in the folder to its contacts, by all ways to ask."""
    for path in sorted(folder.glob("*.contacts.npz")):
        name = path.name.removesuffix(".contacts.npz")
        table = table_on_gpu.to_device(pl.load_table(folder / f"{name}.npz"))
        arguments = tuple(np.load(path).values())
        found = {
            asked: getattr(table, asked)(*kernel_arguments(asked, arguments), np.full(1, GAMMA)) for asked in NAMES
        }
        out = cuda.device_array(arguments[0].size)
        work_of[4, (out.size + 3) // 4](table.grid, *map(cuda.to_device, arguments), out)
        np.savez(folder / f"{name}.answers.npz", own_kernel=out.copy_to_host(), **found)
    check_arrays(table, *arguments)


def solve(folder):
    """Exact forces of the contacts in the folder, by the solver."""
    for held in ("suction", "volume"):
        arguments = tuple(np.load(folder / f"solver.{held}.npz").values())
        found = solver_on_gpu.bridge_force(*arguments, GAMMA, held=held)
        there = solver_on_gpu.bridge_force(*map(cuda.to_device, arguments), GAMMA, held=held)
        assert np.array_equal(there.copy_to_host(), found, equal_nan=True)
        np.save(folder / f"solver.{held}.npy", found)


def share(folder):
    """Answers of some contacts of each table by threads that share them, each in a cell of its own or all in one."""
    from simulated_warps import WARP, let_warps_exchange

    let_warps_exchange()
    table_on_gpu.THREADS = WARP
    table_on_gpu.blocks_for = lambda count: -(-count // WARP)
    for path in sorted(folder.glob("*.shared.npz")):
        table = table_on_gpu.to_device(pl.load_table(folder / path.name.replace(".shared", "")))
        arguments = np.load(path)["arguments"]
        found = {asked: getattr(table, asked)(*kernel_arguments(asked, arguments), GAMMA) for asked in NAMES}
        np.savez(folder / path.name.replace(".shared", ".by_warps"), **found)


def check_arrays(table, separation, control, radius1, radius2):
    """Numbers, arrays on the host and on the device, of any shape, go in and out alike."""
    pair = (control[0], radius1[0], radius2[0], GAMMA)
    expected = table.force(separation[:6], *pair)
    assert isinstance(expected, np.ndarray)
    assert expected.any()
    assert table.force(separation[0], *pair) == expected[0]
    gaps = cuda.to_device(separation[:6].reshape(2, 3))
    there = table.force(gaps, *pair)
    assert there.shape == (2, 3)
    assert np.array_equal(there.copy_to_host().ravel(), expected)
    on_device, on_host = cuda.device_array((2, 3)), np.empty((2, 3))
    assert table.force(gaps, *pair, out=on_device) is on_device
    assert np.array_equal(on_device.copy_to_host(), there.copy_to_host())
    assert table.force(gaps, *pair, out=on_host) is on_host
    assert np.array_equal(on_host, there.copy_to_host())
    rows = table.force(separation[:6].reshape(2, 3), control[:2].reshape(2, 1), *pair[1:])
    assert np.array_equal(rows[0], expected[:3], equal_nan=True)
    assert table.force(np.empty(0), *pair).shape == (0,)
    one = cuda.to_device(np.array(separation[0]))
    assert table.force(one, *pair).copy_to_host() == expected[0]

    assert "out: is not of shape (2, 3)" in refusal(table.force, gaps, *pair, out=cuda.device_array(1))
    assert "out: is not a contiguous float64" in refusal(table.force, gaps, *pair, out=np.empty(6))
    single = cuda.to_device(np.ones(6, np.float32))
    assert "separation: is not a contiguous float64 array" in refusal(table.force, single, *pair)
    few = cuda.to_device(control[:3])
    assert "of shape (3,) is not repeated to (2, 3)" in refusal(table.force, gaps, few, *pair[1:])


def run_page(folder):
    """The page of the documentation in the simulator, with its table from a file."""

    def tabulate(contact_angle, *, reduced):
        assert {"contact_angle": contact_angle, "reduced": reduced} == PAGE_ASKS
        return pl.load_table(folder / "page.npz")

    pl.tabulate = tabulate
    assert_python_prints_what_it_says(PAGE.read_text(encoding="utf-8"))


def compile_all(folder, capability):
    """Code for a GPU that need not be here: of all kernels, and of one as users write them."""
    from tools import gpu_code

    major, minor = (int(number) for number in capability.split("."))
    gpu_code.without_a_device((major, minor))
    table = pl.load_table(folder / "page.npz")
    row = types.float64[::1]
    own = gpu_code.GpuKernel("a kernel of one's own", work_of, types.void(typeof(table.grid), *5 * (row,)), None, False)
    found = {}
    for name, loop, signature, registers, shares in [*gpu_code.gpu_kernels(table), own]:
        text = gpu_code.ptx_of(loop, signature, (major, minor))
        found[name] = {"ptx": text, "shares": shares}
        if gpu_code.assembler():
            found[name] |= gpu_code.assembled(text, f"sm_{major}{minor}", registers)._asdict()
    (folder / f"code.{capability}.json").write_text(json.dumps(found))


TASKS = {"simulate": simulate, "share": share, "solve": solve, "page": run_page, "compile": compile_all}

if __name__ == "__main__":
    TASKS[sys.argv[1]](Path(sys.argv[2]), *sys.argv[3:])
