"""What the page is told by the library: laws, liquids, fields and limits, as their own records have them."""

from typing import Any

import numpy as np

from ... import __version__
from ...ask import domain, kept_liquids, liquid
from ...ask.result import FIELDS
from ...codes.wasm.functions import ASKED
from ...fitting import rules
from ...laws import Law
from ...laws._registry import house_laws
from ...laws.ranges import asked_ranges
from ...show.text import ENDINGS

__all__ = ["records"]

# What can be drawn against the separation: all that is one number.
PLOTTED = (
    "force",
    "volume",
    "suction",
    "neck_radius",
    "liquid_gas_area",
    "surface_energy",
    "grand_potential",
    "stiffness",
)


def records() -> dict[str, Any]:
    """All of it, ready for JSON with infinite numbers.

    Examples
    --------
    >>> known = records()
    >>> [law["name"] for law in known["laws"]][-1], known["laws"][-1]["gives"], known["liquids"][0]["name"]
    ('zhao2020', ['force', 'rupture'], 'methanol')
    """
    return {
        "version": __version__,
        "plotted": PLOTTED,
        "fields": [
            {"name": name, "unit": unit, "meaning": meaning, "endings": ENDINGS.get(name, ())}
            for name, unit, meaning in FIELDS
        ],
        "laws": [_law(law) for law in house_laws() if set(ASKED) & set(law.gives)],
        "liquids": [_liquid(one) for one in kept_liquids.kept_liquids()],
        "water": {
            "critical": kept_liquids.WATER_CRITICAL_TEMPERATURE,
            "criticalDensity": kept_liquids.WATER_CRITICAL_DENSITY,
            "freezing": liquid.WATER_FREEZING_POINT,
            "molarMass": kept_liquids.WATER_MOLAR_MASS,
            "tension": kept_liquids.WATER_TENSION,
            "density": kept_liquids.WATER_DENSITY,
        },
        "gasConstant": liquid.GAS_CONSTANT,
        "kelvin": {
            "doubtfulRadius": liquid.DOUBTFUL_CURVATURE_RADIUS,
            "humidityUncertainty": liquid.HUMIDITY_UNCERTAINTY,
            "largeChange": liquid.LARGE_FORCE_CHANGE,
        },
        "domain": {
            "deepestOverlap": domain.DEEPEST_OVERLAP,
            "narrowest": domain.NARROWEST,
            "leastVolume": domain.LEAST_VOLUME,
            "mostVolume": domain.MOST_VOLUME,
            "mostSuction": domain.MOST_SUCTION,
        },
        "fitting": {name: getattr(rules, name) for name in rules.__all__ if name.isupper()} | {"RANDOM": _random()},
    }


def _random() -> list[float]:
    """Random numbers of the starts of a fit, as many as are ever drawn."""
    random: list[float] = np.random.default_rng(rules.SEED).random((rules.STARTS - 1) * len(rules.UNITS)).tolist()
    return random


def _law(law: Law) -> dict[str, Any]:
    (angle,) = (variable for variable in law.variables if variable.name == "contact_angle")
    return {
        "name": law.name,
        "title": law.title,
        "control": law.control,
        "gives": [quantity for quantity in law.gives if quantity in ASKED],
        "reference": law.reference,
        "doi": law.doi,
        "ranges": asked_ranges(law),
        "knowsSizeRatio": "size_ratio" in law.valid,
        "angleLimits": (angle.low, angle.high),
        "solids": {
            quantity: {
                "angles": solids.angles,
                "spheres": solids.spheres,
                "plane": solids.plane,
                "angleWords": solids.angle_words,
                "sizeWords": solids.size_words,
            }
            for quantity, solids in law.solids.items()
        },
    }


def _liquid(kept: kept_liquids.KeptLiquid) -> dict[str, Any]:
    return {
        "name": kept.name,
        "cas": kept.cas,
        "otherNames": kept.other_names,
        "molarMass": kept.molar_mass,
        "tension": kept.tension._asdict(),
        "density": kept.density._asdict(),
    }
