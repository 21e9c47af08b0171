"""Every warning points at the line that asked, whichever public function it was, and however deep the warning arose."""

import inspect
import warnings

import numpy as np
import pytest

import pendular as pl
from pendular.ask import problem
from pendular.table.measure import Measured

GRAINS = pl.Pair(50e-6, 0.3)
WATER = pl.Liquid.water()
WET = {"suction": 2e4, "liquid": WATER}
DRY = {"humidity": 0.5, "liquid": WATER}
FAR = {"suction": 1.0, "liquid": WATER, "method": "zhao2020"}
NARROW = {"reduced": (20.0, 30.0), "radius_ratio": (1, 1), "tolerance": 1e-6}
GAPS = np.array([0.0, 1e-6])
TOO_FAR = np.array([0.0, 1e-6, 2e-6, 3e-6, 1e-3]), np.array([2e-5, 1.8e-5, 1.6e-5, 1.4e-5, 0.0])
OVERLAPPING = pl.Packing([(0.0, 0.0, 0.0), (9e-5, 0.0, 0.0)], 5e-5)

# What can warn, and a call that does: if the solver fails, beyond the Kelvin equation, and outside of a law's range.
CALLS = {
    ("bridge", "failure"): (lambda: pl.bridge(GRAINS, GAPS, **WET), pl.ConvergenceWarning),
    ("bridge", "volume"): (lambda: pl.bridge(GRAINS, GAPS, volume=1e-15, liquid=WATER), pl.ConvergenceWarning),
    ("bridge", "unstable"): (lambda: pl.bridge(GRAINS, GAPS, **WET, branch="unstable"), pl.ConvergenceWarning),
    ("bridge", "humidity"): (lambda: pl.bridge(GRAINS, GAPS, **DRY), pl.KelvinWarning),
    ("bridge", "law"): (lambda: pl.bridge(GRAINS, GAPS, **FAR), pl.RangeWarning),
    ("bridge", "law of volume"): (
        lambda: pl.bridge(GRAINS, GAPS, **(WET | {"method": "willett2000"})),
        pl.ConvergenceWarning,
    ),
    ("rupture", "failure"): (lambda: pl.rupture(GRAINS, **WET), pl.ConvergenceWarning),
    ("rupture", "humidity"): (lambda: pl.rupture(GRAINS, **DRY), pl.KelvinWarning),
    ("rupture", "law"): (lambda: pl.rupture(GRAINS, **FAR), pl.RangeWarning),
    ("curve", "failure"): (lambda: pl.curve(GRAINS, **WET, points=5), pl.ConvergenceWarning),
    ("curve", "volume"): (lambda: pl.curve(GRAINS, volume=1e-15, liquid=WATER, points=5), pl.ConvergenceWarning),
    ("curve", "humidity"): (lambda: pl.curve(GRAINS, **DRY, points=5), pl.KelvinWarning),
    ("compare", "failure"): (lambda: pl.compare(GRAINS, **WET, points=5), pl.ConvergenceWarning),
    ("error_map", "failure"): (
        lambda: pl.error_map("zhao2020", fraction=0.5, control_star=[10.0, 20.0], contact_angle=[0.1, 0.2]),
        pl.ConvergenceWarning,
    ),
    ("recommend", "failure"): (lambda: pl.recommend(reduced_suction=(10.0, 20.0)), pl.ConvergenceWarning),
    ("fit", "too far"): (
        lambda: pl.fit(*TOO_FAR, GRAINS, volume=1e-15, liquid=WATER, free=("volume",)),
        pl.FitWarning,
    ),
    ("fit_controls", "too far"): (
        lambda: pl.fit_controls(*TOO_FAR, GRAINS, volume=1e-15, liquid=WATER, free=("volume",)),
        pl.FitWarning,
    ),
    ("wet", "noise"): (
        lambda: pl.wet(OVERLAPPING, 0.0, suction=1e5, liquid=WATER, method="exact"),
        pl.PackingWarning,
    ),
    ("tabulate", "tolerance"): (lambda: pl.tabulate(0.3, **NARROW), pl.ToleranceWarning),
}
SILENT = {
    *("path", "film_thickness", "filmed", "condensation_separation"),
    *("contact_energy", "contact_forces", "humidity_from_suction", "suction_from_humidity", "load_table"),
    *("lattice_packing", "random_packing", "sieved_radii", "loosened", "centre_noise", "retention", "pendular_limit"),
    *("wet_in_blocks", "load_state", "read_packing", "write_packing", "write_mesh", "packing_dataset", "read_curve"),
    *("interpolate", "interpolate_rupture", "interpolation_error", "load_dataset", "make_dataset", "save_dataset"),
}


def test_no_function_is_left_out():
    functions = {name for name in pl.__all__ if inspect.isfunction(getattr(pl, name))}
    assert functions == SILENT | {name for name, _ in CALLS}


@pytest.mark.parametrize("case", CALLS, ids=" ".join)
def test_points_at_the_line_that_asked(case, monkeypatch):
    monkeypatch.setattr(problem, "FAILED", problem.FOUND)  # each bridge that is found counts as a failure
    monkeypatch.setattr(
        "pendular.table.table.measure",
        lambda grid, task, parts, searched=None: Measured(
            np.tile([3e-6, 1e-9, 1e-5], (parts.max() + 1, 1)), np.ones(parts.max() + 1, np.int64)
        ),
    )
    ask, category = CALLS[case]
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        ask()
    assert category in {one.category for one in caught}
    first = ask.__code__.co_firstlineno
    for one in caught:
        assert one.filename == __file__, one
        assert first <= one.lineno <= first + 1
