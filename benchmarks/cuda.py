"""What a contact costs on the GPU at hand: ``python -m benchmarks.cuda`` writes a section of docs/speed.md.

Without a GPU it compiles all kernels for one of compute capability 9.0, and tells registers and spills, and that
nothing was timed. With one, the contacts and the closed form of the paper are those of ``benchmarks.contacts``; the
form is compiled for the same GPU by the same compiler. Times are those between two events of the device, with all
arrays on it, over so many launches in a row that the device never waits for the host, after as long a time of the same
work: the first launches run at the clock of a device that idles. What is sent from the host and back is timed by the
clock on the wall. The bandwidth is that of a copy on the device in the same run.
"""

import math
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numba import cuda
from numpy.typing import NDArray

import pendular as pl
from benchmarks.contacts import (
    CONTACT_ANGLE,
    COUNT,
    FIT,
    GAMMA,
    MEAN_RADIUS,
    REDUCED_SUCTION,
    SCATTERED,
    SEED,
    paper_range,
    random_contacts,
)
from benchmarks.sections import put
from benchmarks.solver import Sample
from benchmarks.solver import draw as draw_bridges
from pendular.ask.cuda import bridge_force, loop
from pendular.ask.fields import room_for
from pendular.exact.batch import ALL, FORCE_ALONE, OPEN
from pendular.exact.equations import SUCTION as SUCTION_HELD
from pendular.exact.equations import VOLUME as VOLUME_HELD
from pendular.packing.cuda import contact_forces, sums_in_order
from pendular.table import kernels
from pendular.table.cuda import DeviceTable, loop_of, to_device

Floats = NDArray[np.float64]

NAME = "benchmarks.cuda"
ROUNDS = 11
LONG = 0.05  # time between two events, [s]: thousands of times that of a launch
BYTES = 4 * 8  # separation and two radii are read, the result is written
THREADS = 128
COSINE = math.cos(CONTACT_ANGLE)
SUCTION = REDUCED_SUCTION * GAMMA / MEAN_RADIUS
COMPARED = 100_000
SIDE = 160  # grains along the edge of a lattice
BRIDGES = 1_000_000
CAPABILITY = "9.0"
COPY, PAPER = "copy", "closed form of the paper, Eqs. 26, 29-32"
GOALS = "Wanted are at most 4 times the paper's form for the table, and 15 ns for the exact solver."
NOT_TIMED = f"""No GPU was at hand for this page, so **nothing was timed on one**: not the
table, with eight threads a contact or one, in the order of its cells or out of it; not a whole step; not the exact
solver, at a suction and at a volume; not the chunks of large arrays; and not a copy and the paper's form beside them.
The command measures all of these where there is a GPU.
{GOALS}"""


class Contacts(NamedTuple):
    """Random contacts, and the exact force of the first ones over that at contact."""

    separation: Floats
    radius1: Floats
    radius2: Floats
    exact: Floats
    at_contact: Floats


class Line(NamedTuple):
    """A line of the table."""

    name: str
    ask: Callable[[], Any]
    rows: int
    result: Any = None  # where forces of the contacts are found


def draw(table: pl.Table, count: int) -> Contacts:
    """The contacts of ``benchmarks.contacts``."""
    separation, radius1, radius2 = random_contacts(np.random.default_rng(SEED), table, SUCTION, count)
    pair = pl.Pair((radius1[:COMPARED], radius2[:COMPARED]), CONTACT_ANGLE)
    exact, at_contact = (
        pl.bridge(pair, gap, suction=SUCTION, liquid=pl.Liquid(surface_tension=GAMMA)).force
        for gap in (separation[:COMPARED], 0.0)
    )
    return Contacts(separation, radius1, radius2, exact, at_contact)


@cuda.jit
def paper_loop(suction, gamma, separation, radius1, radius2, out):
    """The paper's closed form, one contact for each thread."""
    i = cuda.grid(1)
    if i < out.size:
        paper_range(FIT, COSINE, suction, gamma, separation, radius1, radius2, out, i, i + 1)


def between_events(function: Callable[[], object], launches: int) -> float:
    """Time of the device for so many launches in a row, [s]."""
    begin, end = cuda.event(), cuda.event()
    begin.record()
    for _ in range(launches):
        function()
    end.record()
    end.synchronize()
    return 1e-3 * float(cuda.event_elapsed_time(begin, end))


def median_ns(function: Callable[[], object]) -> float:
    """Median time of a call, [ns], on a device that is warm and never waits."""
    function()
    launches, taken = 1, between_events(function, 1)
    while taken < LONG:  # doubled until it is long against a launch, which warms the device as well
        launches *= 2
        taken = between_events(function, launches)
    return statistics.median(between_events(function, launches) for _ in range(ROUNDS)) / launches * 1e9


def median_on_wall_ns(function: Callable[[], object]) -> float:
    """Median time of a call that waits for its answer, [ns], by the clock on the wall."""
    function()
    times = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        function()
        times.append(time.perf_counter() - begin)
    return statistics.median(times) * 1e9


def of_contacts(there: DeviceTable, contacts: Contacts) -> list[Line]:
    """The paper's form, the table in its forms, and a copy, over arrays that lie on the device."""
    gaps, radius1, radius2 = (cuda.to_device(array) for array in contacts[:3])
    count = gaps.size
    out, alone = cuda.device_array(count), cuda.device_array(count)
    suction, gamma = (cuda.to_device(np.full(1, value)) for value in (SUCTION, GAMMA))
    pair = (suction, radius1, radius2, gamma)
    blocks = -(-count // THREADS)
    by_one = loop_of(kernels.force)[blocks, THREADS]
    return [
        Line(PAPER, lambda: paper_loop[blocks, THREADS](SUCTION, GAMMA, gaps, radius1, radius2, out), count, out),
        Line("**table**", lambda: there.force(gaps, *pair, out=out), count, out),
        Line("table, one thread a contact", lambda: by_one(there.grid, gaps, *pair, alone), count, alone),
        Line("table, volume", lambda: there.liquid(gaps, *pair, out=out), count),
        Line("table, stiffness", lambda: there.stiffness(gaps, *pair, out=out), count),
        Line("table, energy", lambda: there.energy(gaps, *pair, out=out), count),
        Line(COPY, lambda: out.copy_to_device(gaps), count),
    ]  # fmt: skip


def of_scattered(there: DeviceTable, contacts: Contacts) -> list[Line]:
    """The table at a suction of each contact, so that all of its cells are in use, as they come and in their order."""
    reduced = np.exp(np.random.default_rng(SEED).uniform(*np.log(SCATTERED), contacts.separation.size))
    pair = (reduced * GAMMA / MEAN_RADIUS, contacts.radius1, contacts.radius2)
    gaps = np.random.default_rng(SEED + 1).uniform(0.0, 1.1, reduced.size) * there.rupture_distance(*pair, GAMMA)
    rows = [gaps, *pair]
    order = there.order(*rows, GAMMA)
    gamma, out = cuda.to_device(np.full(1, GAMMA)), cuda.device_array(order.size)
    apart = [cuda.to_device(row) for row in rows]
    sorted_rows = [cuda.to_device(row[order]) for row in rows]
    return [
        Line("table, scattered suctions", lambda: there.force(*apart, gamma, out=out), order.size),
        Line("the same, in the order of cells", lambda: there.force(*sorted_rows, gamma, out=out), order.size),
    ]


def lattice(side: int) -> tuple[NDArray[np.int64], Floats, Floats]:
    """Pairs, positions and radii of grains on a lattice, a little out of place."""
    random = np.random.default_rng(SEED)
    numbers = np.arange(side**3).reshape(side, side, side)
    pairs = [
        np.column_stack([np.delete(numbers, -1, axis).ravel(), np.delete(numbers, 0, axis).ravel()])
        for axis in range(3)
    ]
    radii = random.uniform(0.9, 1.0, side**3) * MEAN_RADIUS
    places = 2.0 * MEAN_RADIUS * np.stack(np.unravel_index(numbers.ravel(), numbers.shape), axis=-1)
    return np.concatenate(pairs), places + random.uniform(-0.02, 0.02, places.shape) * MEAN_RADIUS, radii


def of_steps(there: DeviceTable, side: int) -> list[Line]:
    """Whole steps of grains, from positions to forces on them: their pairs are the rows."""
    pairs, positions, radii = map(cuda.to_device, lattice(side))
    control, reach = cuda.to_device(np.full(1, SUCTION)), 0.1 * MEAN_RADIUS
    first = contact_forces(there, pairs, positions, radii, control, GAMMA, formation_distance=reach)
    sums = sums_in_order(pairs, radii.size)

    def step(**options: Any) -> Any:
        return contact_forces(there, pairs, positions, radii, control, GAMMA, state=first.state, **options)

    count = pairs.shape[0]
    return [
        Line("a whole step", step, count),
        Line("a whole step with its energy", lambda: step(with_energy=True), count),
        Line("a whole step, summed in order", lambda: step(sums=sums), count),
    ]


def of_bridges(sample: Sample) -> tuple[list[Line], str]:
    """The exact solver on the device, and what it leaves to the processor."""
    radii, angles = (
        [np.broadcast_to(part, sample.held.shape) for part in of]
        for of in (sample.pair.radii, sample.pair.contact_angles)
    )
    rows = [cuda.to_device(np.ascontiguousarray(row)) for row in (sample.separation, sample.held, *radii, *angles)]
    count, held = sample.held.size, SUCTION_HELD if sample.name == "suction" else VOLUME_HELD
    near, statuses = cuda.to_device(np.empty((4, 0))), cuda.device_array(count, np.int8)
    blocks = -(-count // THREADS)

    def launch(wanted: int, names: tuple[str, ...] | None) -> Callable[[], None]:
        room = room_for(count, names)
        there = room._replace(**{name: cuda.to_device(part) for name, part in room._asdict().items()})
        return lambda: loop(wanted, held)[blocks, THREADS](*rows, GAMMA, near, there, statuses)

    force = launch(FORCE_ALONE, ("force",))
    force()
    left = np.count_nonzero(statuses.copy_to_host() == OPEN) / count
    found = bridge_force(*rows[:6], GAMMA, held=sample.name).copy_to_host()[:COMPARED]
    exact = sample._replace(
        pair=pl.Pair(tuple(r[:COMPARED] for r in radii), tuple(a[:COMPARED] for a in angles)),
        held=sample.held[:COMPARED], separation=sample.separation[:COMPARED],
    ).ask(fields=("force",)).force  # fmt: skip
    error = np.max(np.abs(found - exact) / np.abs(exact).max())
    lines = [
        Line(f"exact solver at a {sample.name}: force", force, count),
        Line(f"exact solver at a {sample.name}: all fields", launch(ALL, None), count),
    ]
    return lines, (
        f"At a {sample.name} the device leaves {left:.2%} of the rows to the processor, and the forces of both "
        f"differ by {error:.1e} of the largest."
    )


def measured(lines: list[Line], contacts: Contacts) -> str:
    """Name, ns a row, ratio to the paper, share of the bandwidth and error of each line, as a table."""
    costs, errors = {}, {}
    for line in lines:
        costs[line.name] = median_ns(line.ask) / line.rows
        if line.result is not None:
            error = np.abs(line.result.copy_to_host()[: contacts.exact.size] - contacts.exact) / contacts.at_contact
            errors[line.name] = f"{np.max(error):.1e}"
    bandwidth = 2 * 8 / costs.pop(COPY)  # GB/s: a copy reads and writes
    shares = {line.name: f"{BYTES / costs[line.name] / bandwidth:.0%}" for line in lines if line.result is not None}
    rows = [
        f"| {name} | {cost:.4f} | {cost / costs[PAPER]:.2f} | {shares.get(name, '')} | {errors.get(name, '')} |"
        for name, cost in costs.items()
    ]
    return f"""A copy on the device moved {bandwidth:.0f} GB/s.
{GOALS}

| | ns a contact, pair or bridge | ratio to the paper's form | share of memory bandwidth | error |
|---|---:|---:|---:|---:|
{chr(10).join(rows)}"""


def from_host(there: DeviceTable, contacts: Contacts) -> str:
    """Arrays of the host, there and back, by chunks."""
    arrays, out = contacts[:3], np.empty(contacts.separation.size)
    cost = median_on_wall_ns(lambda: there.force(arrays[0], SUCTION, *arrays[1:], GAMMA, out=out)) / out.size
    return (
        f"From arrays of the host and back to one, by chunks, the table took {cost:.2f} ns a contact by the clock on "
        f"the wall, for {BYTES} bytes: {BYTES / cost:.1f} GB/s."
    )


def on_device(count: int, side: int, bridges: int) -> str:
    """All that is measured on the GPU at hand."""
    table = pl.tabulate(CONTACT_ANGLE)
    there, contacts = to_device(table), draw(table, count)
    solved = [of_bridges(draw_bridges(name, bridges)) for name in ("suction", "volume")]
    lines = of_contacts(there, contacts) + of_scattered(there, contacts) + of_steps(there, side)
    for more, _ in solved:
        lines += more
    name = cuda.get_current_device().name
    named = name.decode() if isinstance(name, bytes) else name
    return f"""On: {named}, {count:.0e} contacts, {bridges:.0e} bridges, seed {SEED}, medians of {ROUNDS} runs.

{measured(lines, contacts)}

{" ".join(said for _, said in solved)}
{from_host(there, contacts)}"""


def code_of_kernels() -> str:
    """Registers and spills of all kernels, compiled in a process that needs no device."""
    done = subprocess.run(
        [sys.executable, "-m", "tools.gpu_code", CAPABILITY], capture_output=True, text=True, check=False
    )
    if done.returncode:
        return f"The kernels could not be compiled: {done.stderr.strip().splitlines()[-1]}"
    return f"""The kernels as compiled for compute capability {CAPABILITY}, by `python -m tools.gpu_code {CAPABILITY}`.
Bytes that are spilled are written to and read from the memory of a thread, which lies in the first cache. Loads of 16
bytes are those of coefficients that eight threads share.

{done.stdout.strip()}"""


def main() -> None:
    """Measure, or tell what was not, and write the section."""
    told = on_device(COUNT, SIDE, BRIDGES) if cuda.is_available() else NOT_TIMED
    put(NAME, f"## On a GPU\n\nWritten by `python -m {NAME}`. {told}\n\n{code_of_kernels()}\n")


if __name__ == "__main__":
    main()
