"""Published closed forms for capillary bridges, each with its source, its range and its known errors.

The package is also the registry: ``pendular.laws["zhao2020"].reference``.
"""

import sys
from collections.abc import Iterator
from types import ModuleType

from ._record import Law, Quantity, Solids, Variable
from ._registry import LAWS
from .arrays import force_star, rupture_star, rupture_work_star

__all__ = ["Law", "Quantity", "Solids", "Variable", "force_star", "laws", "rupture_star", "rupture_work_star"]

laws: dict[str, Law] = {law.name: law for law in LAWS}
keys, values, items = laws.keys, laws.values, laws.items


class Registry(ModuleType):
    """Importing any law binds `pendular.laws` to this package, so the package has to answer as the registry."""

    def __getitem__(self, name: str) -> Law:
        if name not in laws:
            raise KeyError(f"law: {name!r} is not one of {', '.join(laws)}")
        return laws[name]

    def __iter__(self) -> Iterator[str]:
        return iter(laws)

    def __len__(self) -> int:
        return len(laws)


sys.modules[__name__].__class__ = Registry
