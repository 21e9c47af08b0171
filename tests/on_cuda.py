"""What `test_cuda.py` runs in processes of its own: ``python tests/on_cuda.py TASK FOLDER [more]``.

In Numba's simulator, which needs ``NUMBA_ENABLE_CUDASIM=1``, threads of the GPU run as Python; ``NUMBA_DISABLE_JIT=1``
makes Python of the scalar kernels as well.
"""

import json
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import ClassVar

import numpy as np
from numba import cuda, typeof, types

import pendular as pl
from documents import assert_python_prints_what_it_says
from pendular.ask import cuda as solver_on_gpu
from pendular.ground import device
from pendular.packing import cuda as packing_on_gpu
from pendular.table import cuda as table_on_gpu
from pendular.table import kernels

NAMES = ("force", "liquid", "stiffness", "energy", "rupture_distance")
PAGE = Path(__file__).parents[1] / "docs" / "howto" / "gpu.md"
PAGE_ASKS = {"contact_angle": np.deg2rad(20), "reduced": (1.0, 1e4)}
GAMMA = 0.0728
SOLVER_FIELDS = (
    "separation", "suction", "volume", "force", "exists", "stable", "unstable_directions", "sideways_stable",
    "neck_radius", "neck_inside", "contact_radius", "half_filling_angle", "liquid_gas_area", "wetted_area",
    "surface_energy", "grand_potential", "stiffness", "capillary_tensor",
)  # fmt: skip


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
    if device.IS_SIMULATED:
        check_lent(table, *arguments)
    check_order(table, *arguments)
    check_chunks(table, *arguments)


class Lent:
    """An array of some library on a device, which here is the memory of the host."""

    streams: ClassVar = []

    def __init__(self, array, number=0):
        self.array, self.number = array, number

    def __dlpack_device__(self):
        return 2, self.number

    def __dlpack__(self, *, stream=None, **options):
        self.streams.append(stream)
        return self.array.__dlpack__(**options)

    def __array_namespace__(self):
        return SimpleNamespace(from_dlpack=lambda other: Lent(np.from_dlpack(other)))


def check_lent(table, separation, control, radius1, radius2):
    """Arrays of another library are read in their memory, and so is the answer given to it."""
    gaps = Lent(separation[:6].reshape(2, 3).copy())
    pair = (control[0], radius1[0], radius2[0], GAMMA)
    expected = table.force(gaps.array, *pair)
    found = table.force(gaps, Lent(np.full(1, pair[0])), *pair[1:])
    assert isinstance(found, Lent)
    assert np.array_equal(found.array, expected)
    assert set(Lent.streams) == {1}, "that of the default, by its name in DLPack"
    view = device._viewed("separation", gaps, 0)
    gaps.array[0, 0] = 3.0
    assert view[0, 0] == 3.0
    out = Lent(np.empty((2, 3)))
    assert table.force(gaps, *pair, out=out) is out
    assert np.array_equal(out.array, table.force(gaps.array, *pair))
    host = np.empty((2, 3))
    assert table.force(gaps, *pair, out=host) is host
    assert np.array_equal(host, out.array)
    assert "separation: is not a contiguous" in refusal(table.force, Lent(gaps.array.T), *pair)
    assert "separation: lies on device 1, not on" in refusal(table.force, Lent(gaps.array, 1), *pair)
    assert "separation: is not a contiguous" in refusal(table.force, Lent(gaps.array.astype(np.float32)), *pair)


def check_order(table, *arguments):
    """Contacts in the order of their cells: each once, those of a cell together."""
    order = table.order(*arguments, GAMMA)
    assert np.array_equal(np.sort(order), np.arange(order.size))
    grid = table.grid._replace(
        **{name: getattr(table.grid, name).copy_to_host() for name in ("lines", "cuts", "rupture")}
    )
    cells = [table_on_gpu.cell_number(grid, *row, GAMMA) for row in np.column_stack(arguments)[order].tolist()]
    assert cells == sorted(cells)
    assert len(set(cells)) > 5
    there = table.order(cuda.to_device(arguments[0]), *arguments[1:], GAMMA)
    assert np.array_equal(np.sort(there.copy_to_host()), np.arange(order.size))


def check_chunks(table, *arguments):
    """Much on the host goes by chunks; one element for all stays."""
    expected = table.force(*arguments, GAMMA)
    device._CHUNK = 7
    assert np.array_equal(table.force(*arguments, GAMMA), expected, equal_nan=True)
    out = np.empty((6, 8))
    square = [argument.reshape(6, 8) for argument in arguments]
    assert table.force(*square, np.full((6, 1), GAMMA), out=out) is out
    assert np.array_equal(out.ravel(), expected, equal_nan=True)


def solve(folder):
    """Exact forces of the contacts in the folder, by the solver."""
    for held in ("suction", "volume"):
        arguments = tuple(np.load(folder / f"solver.{held}.npz").values())
        found = solver_on_gpu.bridge_force(*arguments, GAMMA, held=held)
        there = solver_on_gpu.bridge_force(*map(cuda.to_device, arguments), GAMMA, held=held)
        assert np.array_equal(there.copy_to_host(), found, equal_nan=True)
        np.save(folder / f"solver.{held}.npy", found)
        fields = solver_on_gpu.bridge_fields(*arguments, GAMMA, held=held, fields=SOLVER_FIELDS)
        np.savez(folder / f"solver.{held}.fields.npz", **fields)
    at_one = solver_on_gpu.bridge_fields(
        cuda.to_device(arguments[0][:4]), *(a[:1] for a in arguments[1:]), GAMMA, held=held
    )
    assert list(at_one) == ["force", "volume", "suction", "exists"]
    assert at_one["exists"].copy_to_host().dtype == bool
    assert "fields[0]: 'neck' is not" in refusal(solver_on_gpu.bridge_fields, *arguments, GAMMA, fields=("neck",))


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


def step(folder, kind):
    """Two steps of some grains, with forces added up in any order and in that of the list, and energy."""
    if kind == "shared":
        from simulated_warps import WARP, let_warps_exchange

        let_warps_exchange()
        packing_on_gpu.THREADS = WARP
        packing_on_gpu.blocks_for = lambda count: -(-count // WARP)
    for path in sorted(folder.glob("*.grains.npz")):
        table = table_on_gpu.to_device(pl.load_table(folder / path.name.replace(".grains", "")))
        pairs, positions, moved, other_pairs, radii, control, reach = np.load(path).values()
        asked = (radii, float(control), GAMMA)
        first = packing_on_gpu.contact_forces(
            table, pairs, positions, *asked, formation_distance=float(reach), with_energy=True
        )
        state = packing_on_gpu.carried(first.state, pairs, other_pairs, radii.size)
        assert "5 of 5" in refusal(packing_on_gpu.carried, np.ones(5), pairs[:5], other_pairs[:0], radii.size)
        again = packing_on_gpu.contact_forces(table, cuda.to_device(other_pairs), moved, *asked, state=state)
        sums = packing_on_gpu.sums_in_order(other_pairs, radii.size)
        summed = packing_on_gpu.contact_forces(table, other_pairs, moved, *asked, state=state, sums=sums)
        np.savez(
            folder / path.name.replace(".grains", f".step.{kind}"),
            force=first.force, virial=first.virial, energy=first.energy, attraction=first.attraction,
            moved=again.force.copy_to_host(), moved_virial=again.virial.copy_to_host(), summed=summed.force,
            stood=first.state, stands=again.state.copy_to_host(),
        )  # fmt: skip
    wrong = np.array([(0, 0), (0, radii.size), (-1, 2), (0, 1)])
    lost = packing_on_gpu.contact_forces(table, wrong, positions * 0.0, *asked, formation_distance=1.0)
    assert np.isnan(lost.attraction).all()
    assert not lost.force.any()
    nothing = packing_on_gpu.contact_forces(table, np.empty((0, 2), int), positions, *asked)
    assert not nothing.force.any()
    assert "positions: an array of shape (1, 3) is not" in refusal(
        packing_on_gpu.contact_forces, table, wrong, positions[:1], *asked
    )
    assert "pairs: an array of float64" in refusal(packing_on_gpu.contact_forces, table, wrong * 1.0, positions, *asked)


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


def mend_simulator():
    """One shared array for a line of a kernel, as threads that ask at once may each get one from the simulator."""
    from numba.cuda.simulator.kernelapi import FakeCUDAShared
    from numba.np.numpy_support import as_dtype

    def array(self, shape, dtype):
        frame = sys._getframe(1)
        line = (frame.f_code.co_filename, frame.f_lineno)
        return self._allocations.setdefault(line, np.empty(shape, as_dtype(dtype)))

    FakeCUDAShared.array = array


TASKS = {"simulate": simulate, "share": share, "step": step, "solve": solve, "page": run_page, "compile": compile_all}

if __name__ == "__main__":
    if device.IS_SIMULATED:
        mend_simulator()
    TASKS[sys.argv[1]](Path(sys.argv[2]), *sys.argv[3:])
