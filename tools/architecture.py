"""Write the diagrams of ``docs/architecture.md``: ``python -m tools.architecture``.

They are the import contracts of ``pyproject.toml`` and the first lines of the modules' docstrings.
"""

import ast
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "architecture.md"
BEGIN, END = "<!-- written by python -m tools.architecture -->", "<!-- end of what is written -->"


def contracts() -> list[dict[str, object]]:
    """Import contracts of the project."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]["contracts"]


def names(layer: str) -> list[str]:
    """Modules of a layer."""
    return re.split(r" [|:] ", layer)


def full_name(contract: dict[str, object], name: str) -> str:
    """Name of a layer's module by which it is imported."""
    return ".".join([*contract.get("containers", ()), name])


def path_of(module: str) -> Path:
    """Folder of a package, or a module without its suffix."""
    return (ROOT if module.startswith("studies") else ROOT / "src").joinpath(*module.split("."))


def purpose(module: str) -> str:
    """First line of the docstring of a module or package."""
    path = path_of(module)
    source = path.with_suffix(".py") if path.with_suffix(".py").is_file() else path / "__init__.py"
    if not source.is_file():
        return ""
    return (ast.get_docstring(ast.parse(source.read_text(encoding="utf-8"))) or "").split("\n", 1)[0]


def diagram(layers: list[str]) -> Iterator[str]:
    """Layers as a stack of boxes, the importing ones on top."""
    width = max(map(len, layers)) + 2
    yield f"┌{'─' * width}┐"
    for layer in layers:
        yield f"│{layer:^{width}}│"
        yield f"├{'─' * width}┤" if layer is not layers[-1] else f"└{'─' * width}┘"


def exceptions(contract: dict[str, object]) -> str:
    """Imports that a contract allows nevertheless, by module."""
    allowed: dict[str, list[str]] = {}
    for line in contract.get("ignore_imports", ()):
        importer, imported = line.split(" -> ")
        allowed.setdefault(importer, []).append(f"`{imported}`")
    which = ", ".join(f"`{importer}` ({' and '.join(names)})" for importer, names in allowed.items())
    return f", except in {which}" if which else ""


def part() -> Iterator[str]:
    """All contracts as Markdown."""
    for contract in contracts():
        yield from (f"## {contract['name']}", "")
        if contract["type"] == "layers":
            yield from ("```text", *diagram(contract["layers"]), "```", "", "| module | what it is |", "| --- | --- |")
            for name in (name for layer in contract["layers"] for name in names(layer)):
                yield f"| `{name}` | {purpose(full_name(contract, name))} |"
        else:
            importers, imported = (
                ", ".join(f"`{n}`" for n in contract[f"{kind}_modules"]) for kind in ("source", "forbidden")
            )
            yield f"{importers} never import {imported}{exceptions(contract)}."
        yield ""


def page(text: str) -> str:
    """The page with its written part made anew."""
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    return "\n".join([before + BEGIN, "", *part()]) + END + after


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
