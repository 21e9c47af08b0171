"""Capillary bridges between particles: exact, fast, and wherever they are needed."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    __version__: str
    from . import laws
    from .bridges import Bridge, ConvergenceWarning, Pair, Profile, bridge, curve, rupture
    from .by_law import RangeWarning
    from .comparison import Comparison, ErrorMap, Recommendation, compare, error_map, recommend
    from .contacts import BridgeState, ContactForces, contact_energy, contact_forces
    from .dataset import load_dataset, make_dataset, save_dataset
    from .interpolation import interpolate, interpolate_rupture, interpolation_error
    from .liquid import KelvinWarning, Liquid, humidity_from_suction, suction_from_humidity

# The public names and where they live. Loaded on first use: the help text of the command needs none of them.
_HOME = {
    "Table": "table",
    "ToleranceWarning": "table",
    "load_table": "table",
    "tabulate": "table",
    "BridgeState": "contacts",
    "ContactForces": "contacts",
    "contact_energy": "contacts",
    "contact_forces": "contacts",
    "Bridge": "result",
    "Comparison": "comparison",
    "ErrorMap": "comparison",
    "Recommendation": "comparison",
    "compare": "comparison",
    "error_map": "comparison",
    "recommend": "comparison",
    "RangeWarning": "by_law",
    "ConvergenceWarning": "problem",
    "Pair": "pair",
    "Profile": "result",
    "bridge": "bridges",
    "curve": "bridges",
    "rupture": "bridges",
    "interpolate": "interpolation",
    "interpolate_rupture": "interpolation",
    "interpolation_error": "interpolation",
    "load_dataset": "dataset",
    "make_dataset": "dataset",
    "save_dataset": "dataset",
    "KelvinWarning": "liquid",
    "Liquid": "liquid",
    "humidity_from_suction": "liquid",
    "suction_from_humidity": "liquid",
}

__all__ = [
    "Bridge",
    "BridgeState",
    "Comparison",
    "ContactForces",
    "ConvergenceWarning",
    "ErrorMap",
    "KelvinWarning",
    "Liquid",
    "Pair",
    "Profile",
    "RangeWarning",
    "Recommendation",
    "Table",
    "ToleranceWarning",
    "__version__",
    "bridge",
    "compare",
    "contact_energy",
    "contact_forces",
    "curve",
    "error_map",
    "humidity_from_suction",
    "interpolate",
    "interpolate_rupture",
    "interpolation_error",
    "laws",
    "load_dataset",
    "load_table",
    "make_dataset",
    "recommend",
    "rupture",
    "save_dataset",
    "suction_from_humidity",
    "tabulate",
]


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("pendular")
    if name == "laws":
        return import_module(".laws", __name__)  # the package is the registry
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value: Any = getattr(import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(set(globals()) | set(__all__))
