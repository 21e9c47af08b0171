"""What the view of a heap is told by the library: its quantities, and the packings that the page brings."""

import json
from importlib.resources import files
from typing import Any

from ...packing.retention import QUANTITIES

__all__ = ["heap_records", "packings"]

# Beside what a curve has: name, unit, meaning.
_OF_A_STATE = (
    ("bridges", "", "number of bridges"),
    ("liquid_volume", "m^3", "liquid in bridges"),
    ("mean_force", "N", "of a bridge"),
)


def heap_records() -> dict[str, Any]:
    """All of it, ready for JSON.

    Examples
    --------
    >>> [one["name"] for one in heap_records()["quantities"]][:4]
    ['saturation', 'water_content', 'suction_stress', 'chi']
    """
    known = [(name, *told, True) for name, told in QUANTITIES.items()]
    known += [(*told, False) for told in _OF_A_STATE]
    return {
        "quantities": [
            {"name": name, "unit": unit, "meaning": meaning, "isOfCurve": is_of_curve}
            for name, unit, meaning, is_of_curve in known
        ]
    }


def packings() -> dict[str, Any]:
    """Packings by their names: side of the cube, radii and places, over the mean radius.

    Examples
    --------
    >>> {name: len(heap["positions"]) // 3 for name, heap in packings().items()}
    {'loose': 200, 'close': 200, 'mixed': 200}
    """
    text = (files(__package__) / "static" / "heap" / "packings.json").read_text(encoding="utf-8")
    known: dict[str, Any] = json.loads(text)
    return known
