"""Published closed forms for capillary bridges, each with its source, its range and its known errors.

The package is also the registry: ``pendular.laws["zhao2020"].reference``. A file of this folder whose name begins with
no underscore is a law; each is loaded when it is asked for.
"""

import sys
from collections.abc import Iterator
from importlib import import_module
from types import ModuleType
from typing import Any

from ._record import ANY_SOLIDS, Law, Quantity, Solids
from ._registry import LAWS as laws
from ._registry import is_of_the_house, register
from ._symbols import CONTACT_ANGLE, GAP, SEPARATION, SIZE_RATIO, SUCTION, VOLUME, Variable
from .arrays import damping_star, force_star, rupture_star, rupture_work_star

__all__ = [
    "ANY_SOLIDS",
    "CONTACT_ANGLE",
    "GAP",
    "SEPARATION",
    "SIZE_RATIO",
    "SUCTION",
    "VOLUME",
    "Law",
    "Quantity",
    "Solids",
    "Variable",
    "damping_star",
    "force_star",
    "laws",
    "register",
    "rupture_star",
    "rupture_work_star",
]

keys, values, items = laws.keys, laws.values, laws.items


class Registry(ModuleType):
    """Importing any law binds `pendular.laws` to this package, so the package has to answer as the registry."""

    def __getitem__(self, name: str) -> Law:
        return laws[name]

    def __contains__(self, name: object) -> bool:
        return name in laws

    def __iter__(self) -> Iterator[str]:
        return iter(laws)

    def __len__(self) -> int:
        return len(laws)

    def __getattr__(self, name: str) -> Any:
        if is_of_the_house(name):  # its file: loaded when it is asked for
            return import_module(f"{__package__}.{name}")
        raise AttributeError(f"module {__package__!r} has no attribute {name!r}")


sys.modules[__name__].__class__ = Registry
