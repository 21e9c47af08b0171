"""The page of all bounds: written by its command, and true of the tests that it names."""

import ast
import re
from pathlib import Path

import pytest
from tools import truth_page

TESTS = Path(__file__).parent
BOUNDS = [bound for bounds in truth_page.SUBJECTS.values() for bound in bounds]


def what_the_test_reads(file, function):
    """Source of a test, of its decorators, and of what else in its file it names."""
    tree = ast.parse((TESTS / file).read_text("utf-8"))
    parts = {}
    for node in tree.body:
        names = [node.name] if hasattr(node, "name") else []
        names += [target.id for target in getattr(node, "targets", ()) if isinstance(target, ast.Name)]
        parts |= dict.fromkeys(names, node)
    wanted, seen = [function], set()
    while wanted:
        name = wanted.pop()
        if name in parts and name not in seen:
            seen.add(name)
            wanted += [node.id for node in ast.walk(parts[name]) if isinstance(node, ast.Name)]
    return function in parts, "\n".join(ast.unparse(parts[name]) for name in seen)


@pytest.mark.parametrize("bound", BOUNDS, ids=lambda bound: bound.test)
def test_the_bound_is_that_of_a_test_that_is_there(bound):
    file, _, function = bound.test.partition("::")
    is_there, source = what_the_test_reads(file, function)
    assert is_there
    if bound.within:
        figures = {float(number) for number in re.findall(r"(?<![\w.])\d[\d.]*(?:e-?\d+)?(?![\w.])", source)}
        assert float(bound.within) in figures


def test_a_wrong_bound_is_seen():
    _, source = what_the_test_reads("test_oracle.py", "test_every_field")
    assert "3e-12" not in source


def test_the_page_is_what_the_command_writes():
    assert truth_page.PAGE.read_text("utf-8") == truth_page.page()
