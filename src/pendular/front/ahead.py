"""Machine code ahead of its first use: one question of each kind is asked, and what answers it is compiled."""

from collections.abc import Callable, Iterator

import numpy as np

from ..ask.face import bridge, curve, rupture
from ..ask.liquid import Liquid
from ..ask.pair import Pair
from ..comparison import compare
from ..ground.rows import by_machine_code
from ..packing.forces import contact_forces
from ..packing.lattice import lattice_packing
from ..packing.wet import wet
from ..table import tabulate

__all__ = ["compile_ahead"]

_PAIR, _LIQUID = Pair(50e-6, 0.35), Liquid(0.0728)
_GAPS = np.array([1e-6, 2e-6])


def compile_ahead() -> Iterator[str]:
    """Compile the kernels of one kind of question after another, and say which are ready."""
    for name, ask in _QUESTIONS.items():
        with by_machine_code():
            ask()
        yield name


def _ask_bridges() -> None:
    bridge(_PAIR, _GAPS, suction=20e3, liquid=_LIQUID)
    bridge(_PAIR, 1e-6, volume=1e-15, liquid=_LIQUID).profile()
    rupture(_PAIR, suction=20e3, liquid=_LIQUID)
    bridge(_PAIR, _GAPS, suction=20e3, liquid=_LIQUID, branch="unstable")  # by the whole solver


def _ask_curve() -> None:
    curve(_PAIR, volume=1e-15, liquid=_LIQUID)


def _ask_filling_angle() -> None:
    bridge(_PAIR, half_filling_angle=np.array([0.2, 0.3]), suction=20e3, liquid=_LIQUID)


def _ask_table() -> None:
    table = tabulate(0.35, reduced=(1.0, 1.5))
    table.force(_GAPS, 5e3, 50e-6, 50e-6, 0.0728)
    positions = np.array([[0.0, 0.0, 0.0], [100e-6, 0.0, 0.0]])
    contact_forces(table, np.array([[0, 1]]), positions, np.full(2, 50e-6), 5e3, 0.0728)


def _ask_laws() -> None:
    compare(_PAIR, suction=20e3, liquid=_LIQUID)
    compare(_PAIR, volume=1e-15, liquid=_LIQUID)


def _ask_heap() -> None:
    wet(lattice_packing("simple_cubic", 3, 50e-6), 0.35, suction=20e3, liquid=_LIQUID)


_QUESTIONS: dict[str, Callable[[], None]] = {
    "bridges and rupture": _ask_bridges,
    "curves": _ask_curve,
    "bridges of a half-filling angle": _ask_filling_angle,
    "tables": _ask_table,
    "laws": _ask_laws,
    "heaps": _ask_heap,
}
