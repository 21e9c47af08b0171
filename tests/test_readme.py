"""The README: its Python prints what it says, its command draws the picture that it shows."""

import contextlib
import io
import re
import shlex
from pathlib import Path

import pytest

from pendular.cli import main

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(heading: str) -> str:
    """The one code block under a heading."""
    (section,) = re.findall(rf"^## {heading}\n(.*?)(?=^## |\Z)", README, re.MULTILINE | re.DOTALL)
    (code,) = re.findall(r"^```\w+\n(.*?)^```", section, re.MULTILINE | re.DOTALL)
    return code


def test_python_prints_what_the_comments_say():
    code = block("In Python") + block("The paper behind it, and the laws")
    told = re.findall(r"^print\(.*\)  # (.+)$", code, re.MULTILINE)
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(code, {})
    assert printed.getvalue().splitlines() == told
    assert len(told) == code.count("print(")


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
