"""Cost of the capillary force of a contact: the table of the exact answer against its rivals, in one run.

All on the same random contacts and threads: the paper's closed form (Eqs. 26, 29 to 32) and Willett's law, compiled by
the same compiler with all that depends only on the contact angle taken out of the loop; SciPy's splines on a grid; the
exact solver; the table; and the table collapsed to one pair. ``python -m benchmarks.contacts`` writes docs/speed.md.
"""

import math
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numba import njit
from scipy.interpolate import RegularGridInterpolator

import pendular as pl
from benchmarks.sections import machine, put
from pendular.exact import batch as exact
from pendular.exact.equations import SUCTION
from pendular.ground.threads import helpers, thread_count
from pendular.laws import willett2000, zhao2020

CONTACT_ANGLE = math.radians(20)
GAMMA, MEAN_RADIUS, REDUCED_SUCTION = 0.0728, 50e-6, 100.0
SCATTERED = (1.0, 1e6)  # reduced suctions
SEED, COUNT, ROUNDS = 20261122, 10_000_000, 5
WARM_TURNS, TURNS = 20, 60  # of a step and its rival
WARM_UP = 0.5  # [s]
# Contact angles, control and ranges of tables that are built.
TABLES: tuple[tuple[object, str, dict[str, tuple[float, float]]], ...] = (
    (0, "suction", {}),
    (20, "suction", {}),
    (40, "suction", {}),
    ((0, 60), "suction", {}),
    (0, "volume", {}),
    (20, "volume", {"reduced": (1e-9, 0.1)}),
    (40, "volume", {"radius_ratio": (1.0, 1.0)}),
    (40, "volume", {"radius_ratio": (1.02, math.inf)}),
    ((0, 60), "volume", {"reduced": (1e-9, 0.1)}),
)
SIDE, SMALL_SIDE = 64, 8  # spheres along the edge of the packing, and of one where the call counts
GAP = 8  # numbers between an answer and what lies beside it in memory
BYTES = 5 * 8  # separation, two radii, and the result, which is read before it is written


@njit(error_model="numpy", nogil=True)
def _quadratic(coefficients, t):
    return (coefficients[0] * t + coefficients[1]) * t + coefficients[2]


FIT = tuple(
    _quadratic(getattr(zhao2020, name), math.tan(CONTACT_ANGLE))
    for name in ("C1", "C2", "P1", "P2", "P3", "A1", "A2", "A3", "B1", "B2", "B3")
)


@njit(error_model="numpy", nogil=True)
def _paper_force(fit, cosine, suction, gamma, separation, radius1, radius2):
    """Zhao et al. (2020), Eqs. 29 to 32 and 26."""
    c1, c2, p1, p2, p3, a1, a2, a3, b1, b2, b3 = fit
    radius = 2.0 * radius1 * radius2 / (radius1 + radius2)
    h = suction / gamma * radius
    root = h ** (-1.0 / 3.0)
    rupture = 2.0 / h * cosine * (1.0 + (c1 + c2 * root) * root)
    x = max(separation, 0.0) / radius / rupture
    if x > 1.0:
        return 0.0
    log = math.log(h)
    a, b = (a1 * log + a2) * log + a3, (b1 * log + b2) * log + b3
    contact = math.sqrt(2.0 / h) * (p1 * math.exp(-p2 / math.sqrt(h)) + p3)
    neck = contact * (1.0 + a * (math.sqrt(1.0 - x) - 1.0) + b * x)
    return 2.0 * math.pi * gamma * radius * (neck + 0.5 * h * neck * neck)


@njit(error_model="numpy", nogil=True)
def paper_range(fit, cosine, suction, gamma, separation, radius1, radius2, out, start, stop):
    """The paper's closed form at one suction."""
    for i in range(start, stop):
        out[i] = _paper_force(fit, cosine, suction, gamma, separation[i], radius1[i], radius2[i])


@njit(error_model="numpy", nogil=True)
def scattered_range(fit, cosine, suction, gamma, separation, radius1, radius2, out, start, stop):
    """The same at a suction of each contact."""
    for i in range(start, stop):
        out[i] = _paper_force(fit, cosine, suction[i], gamma, separation[i], radius1[i], radius2[i])


@njit(error_model="numpy", nogil=True)
def willett_range(theta, volume, gamma, separation, radius1, radius2, out, start, stop):
    """Willett et al. (2000), the full law, as the kernel of the registry has it."""
    for i in range(start, stop):
        mean = 2.0 * radius1[i] * radius2[i] / (radius1[i] + radius2[i])
        gap, held = max(separation[i], 0.0) / mean, volume / mean**3
        kappa1, kappa2 = mean / radius1[i], mean / radius2[i]
        star = willett2000.force_star(gap, held, theta, theta, kappa1, kappa2)
        out[i] = 2.0 * math.pi * gamma * mean * star


def answer_room(count: int) -> np.ndarray:
    """Room for answers, apart from all other arrays.

    A loop of the compiler asks when it runs whether what it writes lies within a vector of what it reads, and then
    takes no vectors: the paper's form takes half as long again.
    """
    return np.empty(count + 2 * GAP)[GAP:-GAP]


def in_chunks(function: Callable[..., None], count: int, chunk: int, *arguments: object) -> None:
    """Run machine code over rows, by chunks that threads share, as the library does with its own."""
    for _ in helpers(thread_count()).map(
        lambda at: function(*arguments, at, min(count, at + chunk)), range(0, count, chunk)
    ):
        pass


def median_ns(function: Callable[[], object], count: int) -> float:
    """Median time a contact, [ns], after calls that compile, and bring the processor and the memory to their pace."""
    begin = time.perf_counter()
    while time.perf_counter() < begin + WARM_UP:
        function()
    times = []
    for _ in range(ROUNDS):
        begin = time.perf_counter()
        function()
        times.append(time.perf_counter() - begin)
    return statistics.median(times) / count * 1e9


def by_turns(functions: tuple[Callable[[], object], ...], count: int) -> list[float]:
    """Median times a contact of functions that run one after another, [ns]: a machine does not keep its pace."""
    times: list[list[float]] = [[] for _ in functions]
    for _ in range(WARM_TURNS + TURNS):
        for function, took in zip(functions, times, strict=True):
            begin = time.perf_counter()
            function()
            took.append(time.perf_counter() - begin)
    return [statistics.median(took[WARM_TURNS:]) / count * 1e9 for took in times]


def spline(table: pl.Table, suction: float) -> tuple[Callable[..., np.ndarray], str]:
    """SciPy's cubic splines of the force on a grid of q, ln H* and s², and the size of the grid."""
    q, log_h = np.linspace(0.0, 1.0, 60), np.linspace(math.log(40.0), math.log(160.0), 24)
    u = np.linspace(0.0, 0.3, 8)
    q_, log_, u_ = (axis.ravel() for axis in np.meshgrid(q, log_h, u, indexing="ij"))
    s = np.sqrt(u_)
    mean = np.exp(log_) * GAMMA / suction
    radius1, radius2 = mean / (1.0 + s), mean / (1.0 - s)
    rupture = table.rupture_distance(suction, radius1, radius2, GAMMA)
    gap = rupture * (1.0 - q_ * q_) * (1.0 - 1e-15)
    star = (table.force(gap, suction, radius1, radius2, GAMMA) / mean).reshape(q.size, log_h.size, u.size)
    interpolator = RegularGridInterpolator((q, log_h, u), star, method="cubic")
    ruptures = RegularGridInterpolator(
        (log_h, u), (rupture / mean).reshape(q.size, log_h.size, u.size)[0], method="cubic"
    )

    def force(separation, radius1, radius2):
        mean = 2.0 * radius1 * radius2 / (radius1 + radius2)
        u = ((radius1 - radius2) / (radius1 + radius2)) ** 2
        log_h = np.log(suction * mean / GAMMA)
        x = separation / (mean * ruptures((log_h, u)))
        inside = x < 1.0
        out = np.zeros_like(separation)
        q = np.sqrt(1.0 - x[inside])
        out[inside] = mean[inside] * interpolator((q, log_h[inside], u[inside]))
        return out

    return force, "60 x 24 x 8"


def random_contacts(
    random: np.random.Generator, table: pl.Table, suction: float, count: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Separations and the two radii of random contacts."""
    radius1, radius2 = (random.uniform(0.5, 1.5, count) * MEAN_RADIUS for _ in range(2))
    rupture = table.rupture_distance(suction, MEAN_RADIUS, MEAN_RADIUS, GAMMA)
    return random.uniform(0.0, 1.1, count) * rupture, radius1, radius2


def scattered_cost(random: np.random.Generator, table: pl.Table, chunk: int) -> tuple[float, float]:
    """Time of a contact in the table, [ns], and over that of the paper's form, where each has a suction of its own."""
    count = COUNT // 10
    suction = np.exp(random.uniform(*np.log(SCATTERED), count)) * GAMMA / MEAN_RADIUS
    radius1, radius2 = (random.uniform(0.5, 1.5, count) * MEAN_RADIUS for _ in range(2))
    separation = random.uniform(0.0, 1.1, count) * table.rupture_distance(suction, radius1, radius2, GAMMA)
    out, cosine = answer_room(count), math.cos(CONTACT_ANGLE)
    asked = (FIT, cosine, suction, GAMMA, separation, radius1, radius2, out)
    rival, cost = by_turns(
        (
            lambda: in_chunks(scattered_range, count, chunk, *asked),
            lambda: table.force(separation, suction, radius1, radius2, GAMMA, out=out),
        ),
        count,
    )
    return cost, cost / rival


def packing(random: np.random.Generator, side: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pairs, centres and radii of spheres that stand shaken on a cubic lattice, so that a part of the pairs touch."""
    radii = random.uniform(0.9, 1.1, side**3) * MEAN_RADIUS
    places = np.stack(np.meshgrid(*3 * [np.arange(side)], indexing="ij"), axis=-1).reshape(-1, 3)
    centres = (2.02 * places + random.uniform(-0.02, 0.02, places.shape)) * MEAN_RADIUS
    number = np.arange(side**3).reshape(3 * (side,))
    steps = [np.moveaxis(number, axis, 0) for axis in range(3)]
    pairs = np.concatenate([np.column_stack([along[:-1].ravel(), along[1:].ravel()]) for along in steps])
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))], centres, radii


def small_step_cost(random: np.random.Generator, table: pl.Table, suction: float, reach: float) -> tuple[int, float]:
    """Pairs of a small packing, and the time of a whole step of it, [s]."""
    pairs, centres, radii = packing(random, SMALL_SIDE)
    asked = table, pairs, centres, radii, suction, GAMMA
    before = pl.contact_forces(*asked, formation_distance=reach).state
    cost = median_ns(lambda: pl.contact_forces(*asked, state=before, formation_distance=reach), 1)
    return len(pairs), cost * 1e-9


def builds() -> str:
    """Rows of what tables of other angles and controls take, with their errors."""
    lines = []
    for degrees, control, options in TABLES:
        begin = time.perf_counter()
        table = pl.tabulate(np.deg2rad(degrees), control, **options)
        took = time.perf_counter() - begin
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "table"
            table.save(path)
            size = path.stat().st_size / 1e6
        angles = " and ".join(f"{angle}°" for angle in np.atleast_1d(degrees))
        (low, high), (least, most) = table.reduced, table.radius_ratio
        ratios = f"{least:g} to {'∞' if math.isinf(most) else f'{most:g}'}"
        lines.append(
            f"| {angles} | {control} {low:g} to {high:g} | {ratios} | {took:.1f} s | {size:.1f} MB | "
            f"{table.bound.force:.1e} | {table.bound.rupture:.1e} |"
        )
    return "\n".join(lines)


def measure() -> str:
    """The page."""
    random = np.random.default_rng(SEED)
    suction = REDUCED_SUCTION * GAMMA / MEAN_RADIUS
    begin = time.perf_counter()
    table = pl.tabulate(CONTACT_ANGLE)
    build = time.perf_counter() - begin
    begin = time.perf_counter()
    table = pl.tabulate(CONTACT_ANGLE)
    build = min(build, time.perf_counter() - begin)
    rupture = table.rupture_distance(suction, MEAN_RADIUS, MEAN_RADIUS, GAMMA)
    separation, radius1, radius2 = random_contacts(random, table, suction, COUNT)
    out = answer_room(COUNT)
    volume = float(table.volume(0.0, suction, MEAN_RADIUS, MEAN_RADIUS, GAMMA))
    few = 100_000
    pair = pl.Pair((radius1[:few], radius2[:few]), CONTACT_ANGLE)
    liquid = pl.Liquid(surface_tension=GAMMA)
    truth = pl.bridge(pair, separation[:few], suction=suction, liquid=liquid).force
    at_contact = pl.bridge(pair, 0.0, suction=suction, liquid=liquid).force

    chunk = 65536
    cosine = math.cos(CONTACT_ANGLE)
    ends = (separation, radius1, radius2, out)

    def error(force: np.ndarray) -> str:
        return f"{np.max(np.abs(force[:few] - truth) / at_contact):.1e}"

    rows = []

    def add(name: str, cost: float, wrong: str) -> None:
        rows.append((name, cost, wrong))

    reference, of_table = by_turns(
        (
            lambda: in_chunks(paper_range, COUNT, chunk, FIT, cosine, suction, GAMMA, *ends),
            lambda: table.force(separation, suction, radius1, radius2, GAMMA, out=out),
        ),
        COUNT,
    )
    in_chunks(paper_range, COUNT, chunk, FIT, cosine, suction, GAMMA, *ends)
    add("closed form of the paper, Eqs. 26, 29-32", reference, error(out))
    cost = median_ns(lambda: in_chunks(willett_range, COUNT, chunk, CONTACT_ANGLE, volume, GAMMA, *ends), COUNT)
    add("Willett's law (constant volume)", cost, "another control")
    by_spline, grid = spline(table, suction)
    part = (separation[:few], radius1[:few], radius2[:few])
    cost = median_ns(lambda: by_spline(*part), few)
    add(f"SciPy, cubic splines on {grid} points, one thread", cost, error(by_spline(*part)))
    length = np.minimum(radius1, radius2)[: 10 * few]
    questions = np.column_stack(
        [
            separation[: 10 * few] / length,
            suction * length / GAMMA,
            length / radius1[: 10 * few],
            np.full(10 * few, CONTACT_ANGLE),
            length / radius2[: 10 * few],
            np.full(10 * few, CONTACT_ANGLE),
        ]
    )
    cost = median_ns(lambda: exact.answer(exact.STABLE, SUCTION, questions), 10 * few)
    add("exact solver, all quantities", cost, "0")
    table.force(separation, suction, radius1, radius2, GAMMA, out=out)
    add("**table**", of_table, error(out))
    curve = table.curve(suction, MEAN_RADIUS, MEAN_RADIUS, GAMMA)
    cost = median_ns(lambda: curve.force(separation, out=out), COUNT)
    one = pl.Pair(MEAN_RADIUS, CONTACT_ANGLE)
    here = pl.bridge(one, separation[:few], suction=suction, liquid=liquid).force
    wrong = np.max(np.abs(out[:few] - here)) / pl.bridge(one, 0.0, suction=suction, liquid=liquid).force
    add(f"**table at one pair**, {curve.series.size} terms", cost, f"{wrong:.1e}")
    pairs, centres, radii = packing(random, SIDE)
    reach = 0.5 * rupture
    before = pl.contact_forces(table, pairs, centres, radii, suction, GAMMA, formation_distance=reach).state
    some = tuple(array[: len(pairs)] for array in ends)
    rival, step = by_turns(
        (
            lambda: in_chunks(paper_range, len(pairs), chunk, FIT, cosine, suction, GAMMA, *some),
            lambda: pl.contact_forces(
                table, pairs, centres, radii, suction, GAMMA, state=before, formation_distance=reach
            ),
        ),
        len(pairs),
    )
    few_pairs, small_step = small_step_cost(random, table, suction, reach)
    scattered, scattered_ratio = scattered_cost(random, table, chunk)
    copy = median_ns(lambda: np.copyto(out, separation), COUNT)
    bandwidth = 3 * 8 / copy  # GB/s: copying reads both and writes one
    lines = [
        f"| {name} | {cost:.1f} | {cost / reference:.2f} | {BYTES / cost / bandwidth:.0%} | {wrong} |"
        for name, cost, wrong in rows
    ]
    mib = sum(array.nbytes for array in (*table.grid.force, table.grid.rupture)) / 2**20
    bound = table.bound
    return f"""## Tables

Written by `python -m benchmarks.contacts` on: {machine()}.
{COUNT:.0e} random contacts with radii of 25 to 75 µm at a reduced suction of {REDUCED_SUCTION:g} (mean pair), contact
angle {math.degrees(CONTACT_ANGLE):.0f}°, gaps from 0 to 1.1 of the mean rupture distance, seed {SEED},
{thread_count()} threads, medians of {ROUNDS} runs; of {TURNS} turns of both for the paper's form and the table. The
rival laws are compiled by the same compiler; what depends on the contact angle alone is taken out of the paper's loop.
The error is the largest one over the force at contact. Copying an array moved {bandwidth:.0f} GB/s in the same run; the
fourth column is the share of that which a contact's {BYTES} bytes take.

| | ns a contact | ratio to the paper's form | share of memory bandwidth | error |
|---|---:|---:|---:|---:|
{chr(10).join(lines)}

Where each contact has a suction of its own, scattered over reduced ones of {SCATTERED[0]:g} to {SCATTERED[1]:g}, the
table takes {scattered:.1f} ns, {scattered_ratio:.2f} times the paper's form on the same contacts: medians of {TURNS}
turns of both.

A whole step of `pendular.contact_forces`, from a list of {len(pairs):.1e} pairs and {len(before.pairs):.1e} bridges
of the step before to forces, virial and bridges of this one, took {step:.0f} ns a pair, {step / rival:.2f} times
the paper's form on as many contacts: medians of {TURNS} turns of both. A step of {few_pairs} pairs took
{small_step * 1e3:.2f} ms, most of which is the call.

The table was built in {build:.1f} s, for reduced suctions from {table.reduced[0]:g} to {table.reduced[1]:g} and all
size ratios up to the plane; its forces take {mib:.1f} MiB. On {bound.bridges} bridges that it was not made from, its
force is within **{bound.force:.1e}** of the force at contact up to 1 - D/D_c = 4e-6, its rupture distance within
**{bound.rupture:.1e}**, relative, and its volume within {bound.liquid:.1e} of that at contact. They are measured anew
for each table that is built, and stored in it.

### Tables of other angles and controls

Each with the default tolerance of the force, 1e-8 of that at contact.
Suctions are in units of γ/R̄, volumes of R̄³.

| contact angle | reduced | size ratio | built in | file | error of the force | of the rupture distance |
|---|---|---|---:|---:|---:|---:|
{builds()}
"""


if __name__ == "__main__":
    put("benchmarks.contacts", measure())
