"""What a contact costs on the GPU at hand: ``python -m benchmarks.cuda``; without a GPU it says so and fails.

The contacts and the closed form of the paper are those of ``benchmarks.contacts``; the form is compiled for the same
GPU by the same compiler. Times are those between two events of the device, with all arrays on it, over so many launches
in a row that the device never waits for the host, after as long a time of the same work: the first launches run at the
clock of a device that idles. The bandwidth is that of a copy on the device in the same run.
"""

import math
import statistics
import sys
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
    SEED,
    paper_range,
    random_contacts,
)
from pendular.table.cuda import DeviceTable, to_device

Floats = NDArray[np.float64]

ROUNDS = 11
LONG = 0.05  # time between two events, [s]: thousands of times that of a launch
BYTES = 4 * 8  # separation and two radii are read, the result is written
THREADS = 128
COSINE = math.cos(CONTACT_ANGLE)
SUCTION = REDUCED_SUCTION * GAMMA / MEAN_RADIUS
COMPARED = 100_000
COPY = "copy"


class Contacts(NamedTuple):
    """Random contacts, and the exact force of the first ones over that at contact."""

    separation: Floats
    radius1: Floats
    radius2: Floats
    exact: Floats
    at_contact: Floats


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


def ways(there: DeviceTable, arrays: list[Any]) -> dict[str, Callable[[], Any]]:
    """What is measured, over gaps, radii and results that lie on the device: the first two give forces."""
    separation, radius1, radius2, out = arrays
    suction, gamma = (cuda.to_device(np.full(1, value)) for value in (SUCTION, GAMMA))
    arguments = (separation, suction, radius1, radius2, gamma)
    blocks = -(-out.size // THREADS)
    return {
        "closed form of the paper, Eqs. 26, 29-32": lambda: paper_loop[blocks, THREADS](
            SUCTION, GAMMA, separation, radius1, radius2, out
        ),
        "**table**": lambda: there.force(*arguments, out=out),
        "table, volume": lambda: there.liquid(*arguments, out=out),
        "table, stiffness": lambda: there.stiffness(*arguments, out=out),
        "table, energy": lambda: there.energy(*arguments, out=out),
        COPY: lambda: out.copy_to_device(separation),
    }


def measure(table: pl.Table, contacts: Contacts) -> str:
    """Name, ns a contact, ratio to the paper, share of the bandwidth and error of each way, as a table."""
    count = contacts.separation.size
    there = to_device(table)
    arrays = [*(cuda.to_device(array) for array in contacts[:3]), cuda.device_array(count)]
    costs, errors = {}, {}
    for name, way in ways(there, arrays).items():
        costs[name] = median_ns(way) / count
        if len(errors) < 2:
            error = np.abs(arrays[-1].copy_to_host()[:COMPARED] - contacts.exact) / contacts.at_contact
            errors[name] = f"{np.max(error):.1e}"
    bandwidth = 2 * 8 / costs.pop(COPY)  # GB/s: a copy reads and writes
    reference = next(iter(costs.values()))
    lines = [
        f"| {name} | {cost:.3f} | {cost / reference:.2f} | {BYTES / cost / bandwidth:.0%} | {errors.get(name, '')} |"
        for name, cost in costs.items()
    ]
    return f"""A copy on the device moved {bandwidth:.0f} GB/s.

| | ns a contact | ratio to the paper's form | share of memory bandwidth | error |
|---|---|---|---|---|
{chr(10).join(lines)}"""


def main() -> None:
    """Measure and print."""
    if not cuda.is_available():
        sys.exit("benchmarks.cuda: no CUDA device is at hand; nothing was measured")
    table = pl.tabulate(CONTACT_ANGLE)
    name = cuda.get_current_device().name
    print(f"{name.decode() if isinstance(name, bytes) else name}, {COUNT:.0e} contacts, seed {SEED}, {ROUNDS} runs.")
    print(measure(table, draw(table, COUNT)))


if __name__ == "__main__":
    main()
