"""The README: its Python prints what it says, its command draws the picture that it shows."""

import re
import shlex
from pathlib import Path

import pytest
from tools.code_blocks import code_blocks, section

from documents import assert_python_prints_what_it_says
from pendular.front.cli import main

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(heading: str) -> str:
    """The one code block under a heading."""
    (found,) = code_blocks(section(README, heading))
    return found.code


def test_python_prints_what_the_comments_say():
    assert_python_prints_what_it_says(README)


@pytest.mark.parametrize("heading", ["Run", "Test"])
def test_run_and_test_are_one_line_each(heading):
    assert block(heading).count("\n") == 1


def labels(picture: Path) -> list[str]:
    """The texts of a picture, which stand beside their outlines."""
    return re.findall(r"<!-- (.*?) -->", picture.read_text(encoding="utf-8"), re.DOTALL)


def test_the_picture_is_what_the_command_draws(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    _, command = block("Run").split("uv run pendular ")
    with pytest.raises(SystemExit) as end:
        main(shlex.split(command))
    assert (end.value.code, capsys.readouterr().err) == (0, "")
    (shown,) = re.findall(r"^!\[.*\]\((.*)\)$", README, re.MULTILINE)
    assert labels(tmp_path / Path(shown).name) == labels(ROOT / shown)
