"""Fit the three numbers of the law ``pendular2026`` to the exact solution, and show what error is left.

    python tools/fit_pendular2026.py                      # fit, compare with the numbers in the law, print the error
    python tools/fit_pendular2026.py --write              # put the fitted numbers into the file of the law
    python tools/fit_pendular2026.py --picture FILE       # map of the error over suction and contact angle
    python tools/fit_pendular2026.py --cost               # time of a contact, beside that of the law zhao2020

The largest relative error over the sample is minimised itself: first that of the rupture distance, which depends on a1
alone, then that of the force over a2 and a3. Numbers are kept to the digits that matter, the best such neighbours of
the optimum.
"""

import argparse
import itertools
import re
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.optimize import minimize, minimize_scalar

from pendular.exact.batch import RUPTURE, STABLE, answer
from pendular.exact.equations import SUCTION
from pendular.exact.state import State
from pendular.laws import pendular2026, zhao2020

LAW_FILE = Path(pendular2026.__file__)
LARGEST_ANGLE = np.deg2rad(80.0)
LARGEST_SUCTION = 1e8
NEAREST = 0.1  # √(1 - D/D_c) at 0.99 of the rupture distance
DIGITS = (3, 2, 2)

Array = NDArray[np.float64]


class Sample(NamedTuple):
    """Exact bridges between two equal spheres; the arrays broadcast against each other."""

    suction: Array
    angle: Array
    separation: Array
    rupture: Array
    force: Array


class Errors(NamedTuple):
    """Relative errors of the law over a sample, in per cent."""

    rupture: Array
    force: Array


def exact(asked: int, separation: Array, suction: Array, angle: Array) -> tuple[Array, Array]:
    """Separation and force of exact bridges between two equal spheres."""
    separation, suction, angle = np.broadcast_arrays(separation, suction, angle)
    one = np.ones(suction.size)
    questions = np.column_stack([separation.ravel(), suction.ravel(), one, angle.ravel(), one, angle.ravel()])
    states, _ = answer(asked, SUCTION, questions)
    found = [states[:, State._fields.index(field)].reshape(suction.shape) for field in ("separation", "force")]
    if not np.isfinite(found).all():
        raise RuntimeError("an exact bridge was not found")
    return found[0], found[1]


def sample(suction: Array, angle: Array, closeness: Array) -> Sample:
    """Exact bridges at D = (1 - q²) D_c for the closeness q to rupture."""
    rupture, _ = exact(RUPTURE, np.zeros(1), suction, angle)
    separation = rupture * (1.0 - closeness**2)
    return Sample(suction, angle, separation, rupture, exact(STABLE, separation, suction, angle)[1])


def grid(suctions: int, angles: int, closenesses: int) -> Sample:
    """Sample that is dense where errors peak: at the ends of the angles and of the stable branch."""
    suction = np.concatenate([[0.0], np.geomspace(1e-2, LARGEST_SUCTION, suctions)])
    angle = LARGEST_ANGLE * chebyshev(angles)
    closeness = NEAREST + (1.0 - NEAREST) * chebyshev(closenesses)
    return sample(suction[:, None, None], angle[:, None], closeness)


def chebyshev(count: int) -> Array:
    """Extrema of a Chebyshev polynomial, from 0 to 1."""
    return np.sin(np.linspace(0.0, 0.5 * np.pi, count)) ** 2


@njit(error_model="numpy")
def _evaluate(coefficients, separation, suction, angle, rupture, force):  # type: ignore[no-untyped-def]
    for i in range(separation.size):
        rupture[i], force[i] = pendular2026.evaluate(
            coefficients, separation[i], suction[i], angle[i], angle[i], 1.0, 1.0
        )


def errors(coefficients: tuple[float, ...], points: Sample) -> Errors:
    """Relative errors of the law with the given coefficients."""
    operands = [np.ascontiguousarray(x).ravel() for x in np.broadcast_arrays(*points[2::-1])]
    separation, angle, suction = operands
    rupture, force = np.empty((2, separation.size))
    _evaluate(tuple(map(float, coefficients)), separation, suction, angle, rupture, force)
    shape = points.separation.shape
    return Errors(
        100.0 * (rupture.reshape(shape) / points.rupture - 1.0), 100.0 * (force.reshape(shape) / points.force - 1.0)
    )


def fit(points: Sample) -> tuple[float, float, float]:
    """The coefficients of least maximum error, before rounding."""

    def of_rupture(a1: float) -> float:
        return abs(errors((a1, 0.0, 0.0), points).rupture).max()

    a1 = minimize_scalar(of_rupture, bounds=(0.0, 1.0), method="bounded", options={"xatol": 1e-5}).x

    def of_force(a: Array) -> float:
        return abs(errors((a1, a[0], a[1]), points).force).max()

    a2, a3 = minimize(of_force, (0.8, 0.3), method="Nelder-Mead", options={"xatol": 1e-4, "fatol": 1e-5}).x
    return float(a1), float(a2), float(a3)


def rounded(coefficients: tuple[float, float, float], points: Sample) -> tuple[float, float, float]:
    """The neighbours with few digits that serve best, the rupture distance first."""

    def around(value: float, digits: int) -> set[float]:
        return {round(value + step * 10.0**-digits, digits) for step in (-1, 0, 1)}

    def worst(trial: tuple[float, ...], quantity: str) -> float:
        return abs(getattr(errors(trial, points), quantity)).max()

    choices = [around(value, digits) for value, digits in zip(coefficients, DIGITS, strict=True)]
    a1 = min(choices[0], key=lambda a: worst((a, 0.0, 0.0), "rupture"))
    return min(itertools.product((a1,), *choices[1:]), key=lambda trial: worst(trial, "force"))


def write(coefficients: tuple[float, float, float]) -> None:
    """Put the coefficients into the file of the law."""
    text, count = re.subn(r"(?m)^COEFFICIENTS = .*$", f"COEFFICIENTS = {coefficients}", LAW_FILE.read_text("utf-8"))
    if count != 1:
        raise RuntimeError(f"{LAW_FILE} holds {count} lines of coefficients, not one")
    LAW_FILE.write_text(text, "utf-8")


def worst(relative: Array, points: Sample) -> str:
    """The largest error and where it is."""
    suction, angle, separation, rupture, _ = (array.ravel() for array in np.broadcast_arrays(*points))
    i = abs(relative).argmax()
    where = f"H* = {suction[i]:.3g}, {np.rad2deg(angle[i]):.0f} degrees, D/D_c = {separation[i] / rupture[i]:.2f}"
    return f"{relative.ravel()[i]:+.3f} % at {where}"


def picture(coefficients: tuple[float, float, float], path: Path, fineness: int = 8) -> None:
    """Draw the error over suction and angle, that of the force as the worst over the gap."""
    import matplotlib.pyplot as plt

    suction = np.geomspace(1e-2, LARGEST_SUCTION, 30 * fineness + 1)
    angle = np.linspace(0.0, LARGEST_ANGLE, 15 * fineness + 1)
    closeness = np.linspace(NEAREST, 1.0, 46)
    left = errors(coefficients, sample(suction[:, None, None], angle[:, None], closeness))
    maps = (
        ("Force, worst of 0 ≤ D ≤ 0.99 $D_c$", left.force, np.arange(0.0, 0.61, 0.05)),
        ("Rupture distance $D_c$", left.rupture, np.arange(0.0, 0.071, 0.005)),
    )
    figure, axes = plt.subplots(1, 2, figsize=(10.4, 4.0), layout="constrained", sharey=True)
    for axis, (title, error, levels) in zip(axes, maps, strict=True):
        shown = abs(error).max(axis=2).T
        filled = axis.contourf(suction, np.rad2deg(angle), shown, levels, cmap="viridis_r", extend="max")
        axis.set(xscale="log", xlabel="suction H*", title=title)
        figure.colorbar(filled, ax=axis, label="error, %", ticks=levels[::2])
    axes[0].set_ylabel("contact angle, degrees")
    figure.savefig(path, dpi=120)


@njit(error_model="numpy")
def _time_of(kernel, contacts, force):  # type: ignore[no-untyped-def]
    for i in range(force.size):
        separation, suction, angle = contacts[i]
        force[i] = kernel(separation, suction, angle, angle, 1.0, 1.0)


def cost(count: int = 1_000_000, repeats: int = 9) -> tuple[float, float]:
    """Seconds for one force, rupture distance included, by this law and by zhao2020, on random contacts."""
    rng = np.random.default_rng(2026)
    suction, angle = 10.0 ** rng.uniform(0.0, 6.0, count), rng.uniform(0.0, np.deg2rad(40.0), count)
    rupture, _ = exact(RUPTURE, np.zeros(1), suction, angle)
    contacts = np.column_stack([rng.uniform(0.0, 0.9, count) * rupture, suction, angle])
    force = np.empty(count)
    kernels = (pendular2026.force_star, zhao2020.force_star)
    seconds = np.empty((repeats + 1, 2))
    for run, which in np.ndindex(*seconds.shape):  # in turns, so that a busy machine hits both
        start = perf_counter()
        _time_of(kernels[which], contacts, force)
        seconds[run, which] = perf_counter() - start
    here, there = seconds[1:].min(axis=0) / count
    return float(here), float(there)


def main() -> None:
    """Fit, report and, when asked, write or draw."""
    parser = argparse.ArgumentParser(description="Fit the law pendular2026 to the exact solution.")
    parser.add_argument("--write", action="store_true", help="put the fitted numbers into the file of the law")
    parser.add_argument("--picture", type=Path, help="draw the error over suction and contact angle")
    parser.add_argument("--cost", action="store_true", help="time the law beside zhao2020")
    arguments = parser.parse_args()

    points = grid(101, 41, 24)
    optimum = fit(points)
    coefficients = rounded(optimum, points)
    lines = [
        f"optimum  {optimum[0]:.4f} {optimum[1]:.4f} {optimum[2]:.4f}",
        f"rounded  {coefficients}, in the law {pendular2026.COEFFICIENTS}",
    ]
    lines += [f"{name:8s} {worst(error, points)}" for name, error in errors(coefficients, points)._asdict().items()]
    if arguments.cost:
        here, there = cost()
        lines.append(f"cost     {1e9 * here:.0f} ns, zhao2020 {1e9 * there:.0f} ns, ratio {here / there:.2f}")
    if arguments.write:
        write(coefficients)
    if arguments.picture:
        picture(coefficients, arguments.picture)
    print(*lines, sep="\n")  # noqa: T201


if __name__ == "__main__":
    main()
