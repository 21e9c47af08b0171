"""No argument of a public function takes what it cannot mean: one line names it, for an object of any other kind."""

import inspect
import re

import numpy as np
import pytest

import pendular as pl

pytestmark = pytest.mark.needs("data")

GRAINS = pl.Pair(50e-6, 0.3)
WATER = pl.Liquid.water()
WET = {"pair": GRAINS, "suction": 2e4, "liquid": WATER}
PLACES = [(0.0, 0.0, 0.0), (1e-4, 0.0, 0.0)]


@pytest.fixture(scope="module")
def known():
    """Objects that some functions take."""
    table = pl.tabulate(0.3, reduced=(20.0, 30.0), radius_ratio=(1, 1), tolerance=1e-5)
    packing = {"table": table, "positions": PLACES, "radii": [5e-5, 5e-5], "surface_tension": 0.07}
    state = pl.contact_forces(pairs=[(0, 1)], control=3e4, **packing).state
    data = pl.make_dataset(shape=(10, 10), size_ratio=1.0, contact_angle=0.3)
    heap = pl.lattice_packing("simple_cubic", 3, 5e-5)
    return {"table": table, "packing": packing, "state": state, "data": data, "heap": heap}


FITTED = {
    "separation": [0.0, 1e-6, 2e-6, 3e-6],
    "force": [2e-5, 1e-5, 8e-6, 7e-6],
    "pair": GRAINS,
    "volume": 1e-15,
    "liquid": WATER,
}
IN_DATA = {"control": "suction", "value_star": 20.0, "size_ratio": 1.0, "contact_angle": 0.3}
ON_LAW = {"law": "zhao2020", "control_star": 10.0, "contact_angle1": 0.0, "contact_angle2": 0.0}
CALLS = {
    "Pair": lambda known: (pl.Pair, {"radius": 1e-5, "contact_angle": 0.1}),
    "Liquid": lambda known: (pl.Liquid, {"surface_tension": 0.07}),
    "Liquid.water": lambda known: (pl.Liquid.water, {"temperature": 293.0}),
    "Liquid.named": lambda known: (pl.Liquid.named, {"name": "ethanol", "temperature": 293.0}),
    "bridge": lambda known: (pl.bridge, WET | {"separation": 0.0, "branch": "stable", "method": "exact"}),
    "rupture": lambda known: (pl.rupture, WET | {"limit": "fold", "method": "exact"}),
    "curve": lambda known: (pl.curve, WET | {"points": 5}),
    "path": lambda known: (
        pl.path,
        WET | {"separation": [0.0, 1e-6], "contact_line": "hysteresis", "advancing_angle": 0.4, "receding_angle": 0.2},
    ),
    "film_thickness": lambda known: (pl.film_thickness, {"suction": 1e6, "hamaker_constant": 1e-20}),
    "filmed": lambda known: (pl.filmed, {"pair": GRAINS, "thickness": 1e-9}),
    "condensation_separation": lambda known: (pl.condensation_separation, WET | {"thickness": 1e-9}),
    "Bridge.profile": lambda known: (pl.bridge(separation=0.0, **WET).profile, {"points": 5}),
    "compare": lambda known: (pl.compare, WET | {"points": 5}),
    "error_map": lambda known: (pl.error_map, {"law": "zhao2020", "fraction": 0.5}),
    "recommend": lambda known: (
        pl.recommend,
        {"reduced_suction": (10.0, 20.0), "contact_angle": 0.1, "size_ratio": 1.0, "up_to": 0.9},
    ),
    "tabulate": lambda known: (
        pl.tabulate,
        {"contact_angle": 0.3, "control": "suction", "reduced": (20.0, 30.0), "radius_ratio": (1, 1)},
    ),
    "load_table": lambda known: (pl.load_table, {"path": "no.npz"}),
    "Table.save": lambda known: (known["table"].save, {"path": "no.npz"}),
    "contact_forces": lambda known: (
        pl.contact_forces,
        known["packing"] | {"pairs": [(0, 1)], "control": 3e4, "formation_distance": 0.0, "state": known["state"]},
    ),
    "contact_energy": lambda known: (pl.contact_energy, known["packing"] | {"state": known["state"]}),
    "humidity_from_suction": lambda known: (pl.humidity_from_suction, {"suction": 1e5, "liquid": WATER}),
    "suction_from_humidity": lambda known: (pl.suction_from_humidity, {"humidity": 0.5, "liquid": WATER}),
    "make_dataset": lambda known: (pl.make_dataset, {"shape": (10, 10), "size_ratio": 1.0, "contact_angle": 0.1}),
    "save_dataset": lambda known: (pl.save_dataset, {"dataset": known["data"], "path": "no.nc"}),
    "load_dataset": lambda known: (pl.load_dataset, {"path": "no.nc"}),
    "interpolate": lambda known: (pl.interpolate, IN_DATA | {"dataset": known["data"], "separation_star": 0.0}),
    "interpolate_rupture": lambda known: (pl.interpolate_rupture, IN_DATA | {"dataset": known["data"]}),
    "interpolation_error": lambda known: (
        pl.interpolation_error,
        {"dataset": known["data"], "samples": 5, "order": "linear", "seed": 0},
    ),
    "laws.force_star": lambda known: (
        pl.laws.force_star,
        ON_LAW | {"separation_star": 0.0, "kappa1": 1.0, "kappa2": 1.0},
    ),
    "laws.rupture_star": lambda known: (pl.laws.rupture_star, ON_LAW | {"kappa1": 1.0, "kappa2": 1.0}),
    "lattice_packing": lambda known: (
        pl.lattice_packing,
        {"kind": "simple_cubic", "cells": 3, "radius": 5e-5, "gap": 0.0},
    ),
    "random_packing": lambda known: (pl.random_packing, {"count": 60, "radii": 5e-5, "friction": 0.0, "seed": 0}),
    "sieved_radii": lambda known: (
        pl.sieved_radii,
        {"count": 100, "sizes": [1e-4, 2e-4], "passing": [0.0, 100.0]},
    ),
    "loosened": lambda known: (pl.loosened, {"heap": known["heap"], "strain": 1e-3, "seed": 0}),
    "centre_noise": lambda known: (pl.centre_noise, {"positions": PLACES}),
    "wet": lambda known: (
        pl.wet,
        {"heap": known["heap"], "contact_angle": 0.1, "suction": 2e4, "liquid": WATER, "path": "drying"}
        | {"formation_distance": 0.0, "method": "exact"},
    ),
    "retention": lambda known: (
        pl.retention,
        {"heap": known["heap"], "contact_angle": 0.1, "suctions": [1e4, 2e4], "liquid": WATER, "method": "exact"},
    ),
    "pendular_limit": lambda known: (
        pl.pendular_limit,
        {"heap": known["heap"], "contact_angle": 0.1, "liquid": WATER, "path": "drying", "method": "exact"},
    ),
    "wet_in_blocks": lambda known: (
        pl.wet_in_blocks,
        {"source": known["heap"], "contact_angle": 0.1, "suction": 2e4, "liquid": WATER, "blocks": (1, 1, 1)},
    ),
    "load_state": lambda known: (pl.load_state, {"path": "no.npz"}),
    "read_packing": lambda known: (pl.read_packing, {"path": "no.dump"}),
    "write_packing": lambda known: (pl.write_packing, {"path": "no.vtu", "heap": known["heap"]}),
    "write_mesh": lambda _known: (
        pl.write_mesh,
        {"path": "no.vtu", "pair": GRAINS, "bridge": pl.bridge(GRAINS, 0.0, suction=2e4, liquid=WATER), "around": 16},
    ),
    "fit": lambda _known: (pl.fit, FITTED | {"free": ("volume",), "rupture": "end", "loss": "linear", "starts": 1}),
    "fit_controls": lambda _known: (pl.fit_controls, FITTED | {"free": ("volume",)}),
    "read_curve": lambda _known: (pl.read_curve, {"path": "no.csv"}),
    "packing_dataset": lambda known: (pl.packing_dataset, {"heap": known["heap"]}),
}
MAY_BE_NONE = {("contact_energy", "state"), ("wet", "suction")}


def refusal(function, arguments):
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as caught:
        function(**arguments)
    return str(caught.value)


@pytest.mark.parametrize("name", CALLS)
def test_an_object_of_no_meaning_is_refused_by_name(name, known):
    function, arguments = CALLS[name](known)
    defaults = inspect.signature(function).parameters
    for argument in arguments:
        for wrong in (None, object(), {"a": 1.0}):
            if wrong is None and (defaults[argument].default is None or (name, argument) in MAY_BE_NONE):
                continue  # it stands for nothing
            told = refusal(function, arguments | {argument: wrong})
            assert re.match(rf"{argument}\b", told), told


def test_every_function_is_called():
    functions = {name for name in pl.__all__ if inspect.isfunction(getattr(pl, name))}
    assert functions <= set(CALLS)


MASKED = np.ma.masked_array([1e-6, 2e-6], [False, True])


@pytest.mark.parametrize(
    ("ask", "name"),
    [
        (lambda x: pl.bridge(GRAINS, x, suction=2e4, liquid=WATER), "separation"),
        (lambda x: pl.bridge(GRAINS, 0.0, suction=x, liquid=WATER), "suction"),
        (lambda x: pl.rupture(GRAINS, volume=1e-9 * x, liquid=WATER), "volume"),
        (lambda x: pl.suction_from_humidity(x, WATER), "humidity"),
        (lambda x: pl.Pair(x, 0.3), "radius"),
        (lambda x: pl.Pair((x, 1e-6), 0.3), r"radius\[0\]"),
        (lambda x: pl.Pair([x, x], 0.3), "radius"),
        (lambda x: pl.Pair(1e-6, x), "contact_angle"),
        (lambda x: pl.laws.force_star("zhao2020", x, 1e3, 0.0, 0.0, 1.0, 1.0), "separation_star"),
        (lambda x: pl.humidity_from_suction(x, WATER), "suction"),
    ],
)
def test_a_mask_is_not_dropped(ask, name):
    with pytest.raises(ValueError, match=rf"^{name}: 1 of 2 values are masked; give those that are not$"):
        ask(MASKED)
    ask(np.ma.masked_array([1e-6, 2e-6], False)[:1])


def test_masked_contacts_are_refused(known):
    pairs = np.ma.masked_array([(0, 1), (1, 0)], [(False, False), (True, True)])
    with pytest.raises(ValueError, match="pairs: 2 of 4 values are masked"):
        pl.contact_forces(pairs=pairs, control=3e4, **known["packing"])


@pytest.mark.parametrize("ask", [pl.curve, pl.compare])
@pytest.mark.parametrize(
    ("points", "reason"),
    [
        ([5, 6], r"an array of shape \(2,\) is given where one number is needed"),
        (5.5, "5.5 is not a whole number"),
        (4, "4.0 is not >= 5"),
        (True, "True is not a real number"),
        ("5", "'5' is not a real number"),
    ],
)
def test_points_are_one_whole_number(ask, points, reason):
    with pytest.raises(ValueError, match=f"^points: {reason}$"):
        ask(points=points, **WET)
