"""Where laws come from: the files of this folder, installed packages, and whoever registers one.

A law of this folder is a module with a record ``LAW``. A package brings laws by entry points of the group
``pendular.laws``, each named as its record. Names are known without loading what they stand for.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from pkgutil import iter_modules

from ._record import Law

__all__ = ["LAWS", "house_laws", "is_of_the_house", "register"]

GROUP = "pendular.laws"

_NO_LAWS = ("arrays", "contact_circle", "ranges")  # of this folder, beside those with an underscore
_METHODS = ("exact", "table", "dataset")  # that may be asked where a law may be

_registered: dict[str, Law] = {}


class Laws(Mapping[str, Law]):
    """All laws by their names: those of this folder, then those of packages, then those that were registered."""

    def __getitem__(self, name: str) -> Law:
        if name in _house():
            return _of_the_house(name)
        if name in _registered:
            return _registered[name]
        if name in _installed():
            return _of_a_package(name)
        raise KeyError(f"law: {name!r} is not one of {', '.join(self)}")

    def __contains__(self, name: object) -> bool:
        return name in _house() or name in _registered or name in _installed()

    def __iter__(self) -> Iterator[str]:
        yield from _house()
        yield from _installed()
        yield from _registered

    def __len__(self) -> int:
        return len(_house()) + len(_installed()) + len(_registered)


LAWS = Laws()


def register(law: Law) -> None:
    """Add a law from outside to the registry of this process: it is compared, ranked, mapped and drawn as all others.

    Parameters
    ----------
    law : Law
        With functions in plain Python or compiled by Numba.

    Raises
    ------
    ValueError
        If there is a law of this name, or a method that `pendular.bridge` calls so.

    Examples
    --------
    >>> register(LAWS["zhao2020"])
    Traceback (most recent call last):
    ...
    ValueError: law: the name 'zhao2020' is taken by a law of pendular
    """
    if not isinstance(law, Law):
        raise ValueError(f"law: {law!r} is not a record, pendular.laws.Law")
    if law.name in _registered:
        raise ValueError(f"law: the name {law.name!r} is taken by a law that was registered before")
    _refuse_taken(law.name)
    if law.name in _installed():
        raise ValueError(f"law: the name {law.name!r} is taken by the installed package {_package(law.name)}")
    _registered[law.name] = law


def house_laws() -> list[Law]:
    """Return the laws that come with this package, whatever is there beside them."""
    return [LAWS[name] for name in _house()]


def is_of_the_house(name: str) -> bool:
    """Whether a law comes with this package."""
    return name in _house()


def _refuse_taken(name: str, origin: str = "") -> None:
    """Refuse a name that means something without any law from outside."""
    holder = "a law" if name in _house() else "a method" if name in _METHODS else None
    if holder:
        raise ValueError(f"law: the name {name!r}{origin} is taken by {holder} of pendular")


@cache
def _house() -> dict[str, None]:
    """Names of the laws in this folder, in their order."""
    modules = sorted(module.name for module in iter_modules(import_module(__package__).__path__))
    return dict.fromkeys(name for name in modules if not name.startswith("_") and name not in _NO_LAWS)


def _of_the_house(name: str) -> Law:
    law: Law = import_module(f"{__package__}.{name}").LAW
    return law


@cache
def _installed() -> dict[str, EntryPoint]:
    """Entry points of packages by the names of their laws."""
    found: dict[str, EntryPoint] = {}
    for point in sorted(entry_points(group=GROUP), key=lambda point: point.name):
        _refuse_taken(point.name, f" in the installed package {_name_of(point)}")
        if point.name in found and point.value != found[point.name].value:
            raise ValueError(
                f"law: the name {point.name!r} is taken by two installed packages, {_name_of(found[point.name])} and "
                f"{_name_of(point)}"
            )
        found[point.name] = point
    return found


@cache
def _of_a_package(name: str) -> Law:
    """Load a law of a package; whatever goes wrong there is told in one line."""
    origin = f"law: {name!r} of the installed package {_package(name)}"
    try:
        law = _installed()[name].load()
    except Exception as error:  # of someone else's code
        raise ValueError(f"{origin} cannot be loaded: {error}") from error
    if not isinstance(law, Law):
        raise ValueError(f"{origin} is no record, pendular.laws.Law")
    if law.name != name:
        raise ValueError(f"{origin} calls itself {law.name!r}")
    return law


def _package(name: str) -> str:
    return _name_of(_installed()[name])


def _name_of(point: EntryPoint) -> str:
    return point.dist.name if point.dist is not None else point.module
