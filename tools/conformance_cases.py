"""The questions of the conformance table, and their answers in 40 digits.

The answers come from ``tests/oracles/young_laplace.py``, which shares nothing with the library; the library only gives
the values from which Newton's method starts.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from tests.oracles.young_laplace import EXACT, Bridge, Solid, antisymmetric_mode_is_stable, arc_integrals, connect

import pendular as pl

Number = Any  # of mpmath

# Radii and contact angles of the two solids, in m and rad.
PAIRS = (
    ((50e-6, 50e-6), (0.0, 0.0)),
    ((50e-6, 50e-6), (0.35, 0.35)),
    ((1e-3, 1e-3), (0.7, 0.7)),
    ((50e-6, 50e-6), (1.2, 1.2)),
    ((2e-6, 2e-6), (0.1, 0.9)),
    ((50e-6, 75e-6), (0.35, 0.35)),
    ((50e-6, 400e-6), (0.0, 0.5)),
    ((10e-6, np.inf), (0.0, 0.0)),
    ((50e-6, np.inf), (0.6, 1.0)),
)
TENSION = 0.0728  # N/m
SUCTIONS = (0.1, 1.0, 10.0, 100.0, 1e3, 1e5)  # reduced by R̄ and the surface tension
VOLUMES = (1e-6, 1e-4, 1e-3, 1e-2, 0.1)  # reduced by the cube of R̄
PARTS = (0.0, 0.5, 0.99)  # of the rupture distance

_STEP = EXACT.mpf("1e-20")  # of derivatives, relative
_FOLD_STEP = EXACT.mpf("1e-7")  # between contact circles around the fold, relative
_MISS = EXACT.mpf("1e-22")  # that Newton's method may leave, relative


class Question(NamedTuple):
    """A pair and what is held, in SI units; inputs have few digits."""

    control: str
    radii: tuple[float, float]
    angles: tuple[float, float]
    held: float  # suction or volume


class Answer(NamedTuple):
    """Exact numbers in SI units, with many digits."""

    suction: Number
    volume: Number
    force: Number
    rupture_distance: Number


class _Reduced(NamedTuple):
    """A question in units of the first radius and of the surface tension."""

    solids: tuple[Solid, Solid]
    unit: Number
    suction: Number | None
    volume: Number | None


def cases() -> Iterator[tuple[Question, float]]:
    """All questions and separations: each pair at each control, at contact, half way and near rupture."""
    for radii, angles in PAIRS:
        mean = 2.0 / (1.0 / radii[0] + 1.0 / radii[1])
        held = [("suction", star * TENSION / mean) for star in SUCTIONS]
        held += [("volume", star * mean**3) for star in VOLUMES]
        for control, value in held:
            question = Question(control, radii, angles, float(f"{value:.3g}"))
            limit = by_library(pl.rupture, question).separation
            for part in PARTS:
                yield question, float(f"{part * limit:.4g}")


def by_library(function: Callable[..., pl.Bridge], question: Question, *separation: float, **options: str) -> Any:
    """Ask the library."""
    pair, liquid = pl.Pair(question.radii, question.angles), pl.Liquid(surface_tension=TENSION)
    return function(pair, *separation, **{question.control: question.held}, liquid=liquid, **options)


def solve(question: Question, separation: float) -> Answer:
    """Answer a question in 40 digits."""
    reduced = _reduce(question)
    start = by_library(pl.bridge, question, separation)
    reaches, suction = _coordinates(start, question)
    gap = EXACT.mpf(separation) / reduced.unit
    if reduced.volume is None:

        def bridge(unknown: Sequence[Number]) -> Bridge:
            return connect(EXACT, reduced.solids, reduced.suction, unknown[0], reaches[1])

        found = bridge(_newton(lambda x: [_gap(bridge(x)) - gap], [reaches[0]], [reaches[0] ** 2]))
    else:

        def bridge(unknown: Sequence[Number]) -> Bridge:
            return connect(EXACT, reduced.solids, unknown[1], unknown[0], reaches[1])

        def missed(unknown: Sequence[Number]) -> list[Number]:
            return [_gap(bridge(unknown)) - gap, _volume(bridge(unknown)) - reduced.volume]

        found = bridge(_newton(missed, [reaches[0], suction], [reaches[0] ** 2, reduced.volume]))
    tension = EXACT.mpf(TENSION)
    return Answer(
        suction=found.suction * tension / reduced.unit,
        volume=_volume(found) * reduced.unit**3,
        force=2 * EXACT.pi * tension * found.force * reduced.unit,
        rupture_distance=_end_of_stability(question) * reduced.unit,
    )


def _reduce(question: Question) -> _Reduced:
    mp = EXACT.mpf
    unit = mp(question.radii[0])
    first, second = (
        Solid(np.inf if np.isinf(radius) else mp(radius) / unit, mp(angle))
        for radius, angle in zip(question.radii, question.angles, strict=True)
    )
    held = mp(question.held)
    if question.control == "suction":
        return _Reduced((first, second), unit, held * unit / mp(TENSION), None)
    return _Reduced((first, second), unit, None, held / unit**3)


def _coordinates(state: pl.Bridge, question: Question) -> tuple[list[Number], Number]:
    """Distances of the contact circles from the apexes along the solids, and suction, from the library."""
    unit = question.radii[0]
    reaches = [
        circle / unit if np.isinf(radius) else radius / unit * angle
        for radius, angle, circle in zip(question.radii, state.half_filling_angle, state.contact_radius, strict=True)
    ]
    return [EXACT.mpf(float(reach)) for reach in reaches], EXACT.mpf(float(state.suction) * unit / TENSION)


def _gap(bridge: Bridge) -> Number:
    return arc_integrals(bridge)[0] - sum(circle.cap_height for circle in bridge.contacts)


def _volume(bridge: Bridge) -> Number:
    return arc_integrals(bridge)[1] - sum(circle.cap_volume for circle in bridge.contacts)


def _newton(missed: Callable[[list[Number]], list[Number]], start: list[Number], scales: list[Number]) -> list[Number]:
    """Solve for as many unknowns as there are misses, measured by their scales."""
    unknown = list(start)
    for _ in range(6):
        miss = missed(unknown)
        if all(abs(one) < _MISS * scale for one, scale in zip(miss, scales, strict=True)):
            return unknown
        columns = []
        for i, value in enumerate(unknown):
            step = _STEP * max(abs(value), EXACT.mpf("1e-3"))
            moved = [*unknown[:i], value + step, *unknown[i + 1 :]]
            columns.append([(after - before) / step for after, before in zip(missed(moved), miss, strict=True)])
        slopes = EXACT.matrix(columns).T
        change = EXACT.lu_solve(slopes, EXACT.matrix(miss))
        unknown = [value - change[i] for i, value in enumerate(unknown)]
    raise ArithmeticError("Newton's method did not converge")


@cache
def _end_of_stability(question: Question) -> Number:
    """Gap at the fold, or where the liquid of given volume slides to one of two equal solids if that comes first."""
    reduced = _reduce(question)
    reaches, suction = _coordinates(by_library(pl.rupture, question, limit="fold"), question)

    def bridge(reach: Number) -> Bridge:
        def held(unknown: Sequence[Number]) -> Bridge:
            return connect(EXACT, reduced.solids, unknown[0], reach, reaches[1])

        if reduced.volume is None:
            return held([reduced.suction])
        return held(_newton(lambda x: [_volume(held(x)) - reduced.volume], [suction], [reduced.volume]))

    first, second = reduced.solids
    if reduced.volume is not None and first == second and not antisymmetric_mode_is_stable(bridge(reaches[0])):
        return _gap_of_sliding(question)
    below, middle, above = (_gap(bridge(reaches[0] * (1 + i * _FOLD_STEP))) for i in (-1, 0, 1))
    return middle + (above - below) ** 2 / (8 * (2 * middle - above - below))


def _gap_of_sliding(question: Question) -> Number:
    """Gap where two equal solids stop being alike.

    The force and the suction of a surface allow two contact circles on a sphere, at the roots of a quadratic in the
    cotangent of the half-filling angle. Where they are one, a bridge that is not its mirror image branches off.
    """
    reduced = _reduce(question)
    reaches, suction = _coordinates(by_library(pl.rupture, question), question)
    sine = EXACT.sin(reduced.solids[0].angle)

    def bridge(unknown: Sequence[Number]) -> Bridge:
        return connect(EXACT, reduced.solids, unknown[1], unknown[0])

    def missed(unknown: Sequence[Number]) -> list[Number]:
        found = bridge(unknown)
        cotangent = EXACT.cot(found.contacts[0].filling_angle)
        return [2 * found.force * cotangent - sine, _volume(found) - reduced.volume]

    return _gap(bridge(_newton(missed, [reaches[0], suction], [sine, reduced.volume])))
