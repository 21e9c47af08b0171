"""What machine code of a kernel depends on: all source that can enter it, and what compiles it."""

import hashlib
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from importlib.util import resolve_name
from pathlib import Path
from typing import Any

__all__ = ["name_of", "source_stamp", "stamp_of"]

_HOME = Path(__file__).parent.parent
_PACKAGE = _HOME.name
_WRITTEN_IN = re.compile(r'kernel_written_in\("([\w.]+)"\)')
_IMPORT = re.compile(r"^[ \t]*(?:from[ \t]+(\S+)[ \t]+)?import[ \t]+(\([^)]*\)|.*)", re.MULTILINE)


@cache
def stamp_of(file: Path) -> str:
    """Hash of all source that a kernel of a file can take anything from, and of what compiles it.

    The processor is not in it.
    """
    tools = f"{sys.version} {version('numba')} {version('llvmlite')}"
    return hashlib.sha256(f"{tools} {source_stamp(file)}".encode()).hexdigest()


def name_of(function: Callable[..., Any], *facts: str) -> str:
    """Name of the machine code of a kernel: its own, and the hash of all that decides on it."""
    key = hashlib.sha256(" ".join(facts).encode()).hexdigest()
    return f"{function.__name__}_{key[:24]}"


@cache
def source_stamp(file: Path) -> str:
    """Hash of all source that a kernel of a file can take anything from."""
    digest = hashlib.sha256()
    for source in sorted(_sources_of(file)):
        digest.update(f"\0{source.name}\0".encode() + source.read_bytes())
    return digest.hexdigest()


@cache
def _sources_of(file: Path) -> frozenset[Path]:
    """Files from which a kernel of a file can take anything: other kernels, constants, types.

    In the package these are the ones that its imports reach. A file of someone else may reach the package in many
    ways, and others beside it.
    """
    modules = _modules()
    names = {path: name for name, path in modules.items()}
    if file not in names:
        return frozenset([file, *file.parent.glob("*.py"), *modules.values()])
    reached: set[str] = set()
    ahead = [names[file]]
    while ahead:
        name = ahead.pop()
        if name not in reached:
            reached.add(name)
            ahead += [other for other in _imported_by(name) if other in modules]
    return frozenset(modules[name] for name in reached)


@cache
def _modules() -> dict[str, Path]:
    """Modules of the package and their files."""
    return {_module_name(path): path for path in _HOME.rglob("*.py")}


def _module_name(path: Path) -> str:
    parts = path.relative_to(_HOME).with_suffix("").parts
    return ".".join((_PACKAGE, *parts)).removesuffix(".__init__")


@cache
def _imported_by(name: str) -> frozenset[str]:
    """All that the imports of a module may name, modules and what they hold."""
    path = _modules()[name]
    package = name if path.stem == "__init__" else name.rpartition(".")[0]
    return frozenset(_named_in(path.read_text(encoding="utf-8"), package))


def _named_in(source: str, package: str) -> Iterator[str]:
    """Names in import statements, and modules in which the compiled form of a kernel is written.

    A parser would tell imports from the words around, and take a quarter of a second.
    """
    yield from _WRITTEN_IN.findall(source)
    for origin, rest in _IMPORT.findall(source):
        words = re.findall(r"[\w.]+", rest)
        if not origin:
            yield from words
            continue
        with suppress(ImportError):  # a sentence that looks like an import
            home = resolve_name(origin, package)
            yield home
            yield from (f"{home}.{word}" for word in words)
