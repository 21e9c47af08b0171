"""Machine code ahead of its first use: one question of each kind is asked, and what answers it is compiled."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from ..ask.face import bridge, curve, rupture
from ..ask.liquid import Liquid
from ..ask.pair import Pair
from ..ask.shapes import Cone
from ..dataset.grid import GridPoint, Solids, grid_range
from ..exact.batch import STABLE, answer
from ..exact.branch import branches
from ..exact.equations import SUCTION, VOLUME
from ..exact.sensitivities import rates_of_force
from ..ground.rows import by_machine_code, over_rows
from ..laws import damping_star, force_star, laws, rupture_star, rupture_work_star
from ..packing.forces import contact_energy, contact_forces
from ..packing.lattice import lattice_packing
from ..packing.wet import wet
from ..paths import path
from ..table import tabulate

__all__ = ["QUESTIONS", "Made", "compile_ahead"]

_PAIR, _LIQUID = Pair(50e-6, 0.35), Liquid(0.0728)
_GAPS = np.array([1e-6, 2e-6])

# Nearly equal spheres at a small suction: no leaps from a guess lead to their rupture, which the whole solver seeks.
_NOT_FORETOLD = np.array([[0.06310137, 1.99986632, 0.35, 1.3368e-4, 0.35]])
_QUESTION = np.array([[0.05, 1e-3, 1.0, 0.35, 1.0, 0.35]])


class Made(NamedTuple):
    """Machine code of one kind of rows."""

    name: str
    seconds: float  # that it took; 0 where it was there


def _tell_nobody(_made: Made) -> None:
    pass


def compile_ahead(told: Callable[[Made], None] = _tell_nobody) -> Iterator[str]:
    """Compile the kernels of one kind of question after another; tell of each, and say which questions are ready."""
    known: set[str] = set()

    def tell(function: Callable[..., None], seconds: float) -> None:
        name = f"{function.__module__.removeprefix('pendular.')}.{function.__name__}"
        if name not in known or seconds:
            known.add(name)
            told(Made(name, seconds))

    for name, ask in QUESTIONS.items():
        with by_machine_code(tell):
            ask()
        yield name


def _ask_bridges() -> None:
    bridge(_PAIR, _GAPS, suction=20e3, liquid=_LIQUID)
    bridge(_PAIR, 1e-6, volume=1e-15, liquid=_LIQUID).profile()
    rupture(_PAIR, suction=np.array([20e3, 30e3]), liquid=_LIQUID)
    rupture(Pair(50e-6, 0.7), volume=1e-16, liquid=_LIQUID, limit="fold")  # past a pitchfork
    bridge(_PAIR, _GAPS, suction=20e3, liquid=_LIQUID, branch="unstable")  # by the whole solver


def _ask_curve() -> None:
    curve(_PAIR, volume=1e-15, liquid=_LIQUID)


def _ask_filling_angle() -> None:
    bridge(_PAIR, half_filling_angle=np.array([0.2, 0.3]), suction=20e3, liquid=_LIQUID)


def _ask_solids() -> None:
    tip = Pair((Cone(1.0, 10e-6), np.inf), 0.35)
    bridge(tip, _GAPS, volume=1e-15, liquid=_LIQUID)


def _ask_table() -> None:
    table = tabulate(0.35, reduced=(1.0, 1.5))
    for gaps in (0.0, _GAPS):  # by rows and by blocks
        table.force(gaps, 1.8e3, 50e-6, 50e-6, 0.0728)
        table.volume(gaps, 1.8e3, 50e-6, 50e-6, 0.0728)
    table.curve(1.8e3, 50e-6, 50e-6, 0.0728).force(_GAPS)
    branches(SUCTION, False, _NOT_FORETOLD, np.array([0.1, 0.5, 1.0]), 1)
    positions = np.array([[0.0, 0.0, 0.0], [100e-6, 0.0, 0.0]])
    step = contact_forces(table, np.array([[0, 1]]), positions, np.full(2, 50e-6), 1.8e3, 0.0728)
    contact_energy(table, step.state, positions, np.full(2, 50e-6), 0.0728)


def _ask_laws() -> None:
    asked: dict[str, Callable[..., object]] = {
        "force": force_star, "rupture": rupture_star, "rupture_work": rupture_work_star,
        "damping": damping_star,
    }  # fmt: skip
    control, gap = np.array([0.01, 0.02]), np.zeros(2)
    for law in laws.values():
        for quantity in law.gives:
            place = (gap, control) if quantity in ("force", "damping") else (control,)
            asked[quantity](law.name, *place, 0.1, 0.1, 1.0, 1.0)


def _ask_heap() -> None:
    heap = lattice_packing("face_centred_cubic", 3, 50e-6)
    found = wet(heap, 0.35, suction=20e3, liquid=_LIQUID, method="table")
    _ = found.stress_shares, found.meetings, found.interface_area


def _ask_grid() -> None:
    point = np.empty((len(GridPoint._fields), 1, 1))
    over_rows(grid_range, 1, 1, np.array([0.3]), np.array([0.5]), Solids(1.0, 0.35, 1.0, 0.35), point)


def _ask_fit() -> None:
    rates_of_force(VOLUME, _QUESTION, answer(STABLE, VOLUME, _QUESTION)[0])


def _ask_path() -> None:
    path(_PAIR, _GAPS, volume=1e-15, contact_line="pinned", liquid=_LIQUID)


QUESTIONS: dict[str, Callable[[], None]] = {
    "bridges and rupture": _ask_bridges,
    "curves": _ask_curve,
    "bridges of a half-filling angle": _ask_filling_angle,
    "other solids": _ask_solids,
    "tables": _ask_table,
    "laws": _ask_laws,
    "heaps": _ask_heap,
    "data bases": _ask_grid,
    "fits": _ask_fit,
    "paths": _ask_path,
}
