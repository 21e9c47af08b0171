"""The page of the architecture shows the import contract, and the contract covers every module."""

import re
from pathlib import Path

import pytest
from tools import architecture

import pendular

PACKAGE = Path(pendular.__file__).parent
LAYERED = [contract for contract in architecture.contracts() if contract["type"] == "layers"]


def by_name(contract):
    return contract["name"]


def modules(container):
    """Modules in a package, by the files on disk."""
    folder = architecture.path_of(container)
    files = {path.stem for path in folder.glob("*.py")}
    packages = {path.name for path in folder.iterdir() if any(path.glob("*.py"))}
    return (files | packages) - {"__init__"}


def test_the_page_is_what_the_command_writes():
    text = architecture.PAGE.read_text("utf-8")
    assert text == architecture.page(text), "run python -m tools.architecture"


@pytest.mark.parametrize("contract", [contract for contract in LAYERED if "containers" in contract], ids=by_name)
def test_every_module_has_its_place(contract):
    (container,) = contract["containers"]
    named = [name for layer in contract["layers"] for name in architecture.names(layer)]
    assert len(named) == len(set(named))
    assert set(named) == modules(container)


@pytest.mark.parametrize("contract", LAYERED, ids=by_name)
def test_every_module_says_what_it_is(contract):
    for layer in contract["layers"]:
        for name in architecture.names(layer):
            assert architecture.purpose(architecture.full_name(contract, name)).endswith("."), name


def test_no_module_stands_loose_beside_the_face():
    assert {path.name for path in PACKAGE.glob("*.py")} == {"__init__.py", "_version.py"}


def test_the_diagram_stacks_the_layers_in_order():
    text = architecture.PAGE.read_text("utf-8")
    for contract in LAYERED:
        rows = [line.strip("│").strip() for line in architecture.diagram(contract["layers"]) if line.startswith("│")]
        assert rows == contract["layers"]
        assert "\n".join(architecture.diagram(contract["layers"])) in text


def test_every_exception_of_a_contract_is_told():
    text = architecture.PAGE.read_text("utf-8")
    for contract in architecture.contracts():
        for line in contract.get("ignore_imports", ()):
            importer, imported = line.split(" -> ")
            section = text.partition(f"## {contract['name']}\n")[2].partition("\n## ")[0]
            assert f"`{importer}`" in section
            assert f"`{imported}`" in section


def test_every_module_that_the_page_names_exists():
    """A room named in the text is there: ``ask.face``, or a file of ``exact``."""
    text, _, _ = architecture.PAGE.read_text("utf-8").partition(architecture.BEGIN)
    _, _, formulas = text.partition("## Where a formula lives")
    named = re.findall(r"`((?:front|ask|exact|ground|codes|show|table)\.[a-z]+)", text)
    named += [f"exact.{name.replace('/', '.')}" for name in re.findall(r"\| `([\w/]+)` \|$", formulas, re.MULTILINE)]
    assert len(named) > 25
    for name in named:
        path = PACKAGE.joinpath(*name.split("."))
        assert path.with_suffix(".py").is_file() or path.is_dir(), name
